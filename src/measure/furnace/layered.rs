//! Property checks of the standard surface under glTF's further lobes.

use super::ALBEDO_LIMIT;
use super::property_check::{Input, Measure, PropertyCheck};
use super::quadrature::{direction, over_hemisphere, over_reflections};
use crate::material::SheenTable;
use crate::measure::twin::albedo::Fit;
use crate::measure::twin::layered::{Base, Parameters, Stack};
use glam::DVec3;
use std::sync::LazyLock;

static FIT: LazyLock<Fit> = LazyLock::new(Fit::shipped);
static TABLE: LazyLock<SheenTable> = LazyLock::new(SheenTable::shipped);

/// Factor on the reflectance of a dielectric of index 1.5 that makes it a mirror.
const MIRROR: f64 = 25.0;

/// An input whose corners are few, as they multiply.
fn few(name: &'static str, range: (f64, f64), corners: &[f64]) -> Input {
    Input { corners: corners.to_vec(), ..Input::between(name, range) }
}

fn base_inputs() -> Vec<Input> {
    let unit = |name, corners| few(name, (0.0, 1.0), corners);
    vec![
        // What is not white takes light.
        unit("base_color", &[1.0]),
        unit("metallic", &[0.0, 1.0]),
        unit("roughness", &[0.0, 0.5, 1.0]),
        unit("anisotropy", &[0.0, 1.0]),
        unit("specular", &[1.0]),
        few("specular_color", (0.0, MIRROR), &[0.0, MIRROR]),
        unit("diffuse_transmission", &[0.0, 1.0]),
        few("cosine_to_eye", (1e-3, 1.0), &[1e-3, 0.05, 0.4, 1.0]),
        few("streak_to_eye_deg", (0.0, 90.0), &[0.0, 90.0]),
    ]
}

fn base(x: &[f64]) -> (Base, DVec3) {
    let [base_color, metallic, roughness, anisotropy, specular, specular_color, diffuse_transmission] =
        std::array::from_fn(|at| x[at]);
    let parameters = Parameters {
        base_color,
        metallic,
        roughness,
        anisotropy,
        ior: 1.5,
        specular,
        specular_color,
        diffuse_transmission,
    };
    (Base::new(&parameters), direction(x[7], x[8].to_radians()))
}

/// The same under fuzz and varnish, of the four inputs that follow.
fn stack(x: &[f64]) -> (Stack<'static>, DVec3) {
    let (base, v) = base(x);
    let [sheen_color, sheen_roughness, clearcoat, clearcoat_roughness] = std::array::from_fn(|at| x[9 + at]);
    (Stack { base, sheen_color, sheen_roughness, clearcoat, clearcoat_roughness, table: &TABLE }, v)
}

fn stack_inputs() -> Vec<Input> {
    let mut inputs = base_inputs();
    // The base alone has been asked at all of its corners.
    inputs[3].corners = vec![0.7];
    inputs[5].corners = vec![1.0];
    inputs[6].corners = vec![0.0];
    inputs[7].corners = vec![1e-3, 0.2, 1.0];
    inputs[8].corners = vec![0.0];
    let unit = |name, corners| few(name, (0.0, 1.0), corners);
    inputs.extend([
        unit("sheen_color", &[0.0, 1.0]),
        unit("sheen_roughness", &[0.0, 1.0]),
        unit("clearcoat", &[0.0, 1.0]),
        unit("clearcoat_roughness", &[0.0, 1.0]),
    ]);
    inputs
}

/// Share of white light from everywhere that comes to `v`, by parts that each have variables of their own.
fn stack_albedo(stack: &Stack<'_>, v: DVec3) -> f64 {
    let alpha = |roughness: f64| (roughness * roughness).clamp(1e-3, 1.0);
    let clearcoat_width = alpha(stack.clearcoat_roughness);
    let varnish = over_reflections(v, (clearcoat_width, clearcoat_width), |l| stack.clearcoat_times_cosine(&FIT, v, l));
    let fuzz = over_hemisphere(|l| stack.left(&FIT, v, l).0 * stack.fuzz_times_cosine(v, l));
    let highlight = over_reflections(v, stack.base.lobe.alpha, |l| {
        stack.left(&FIT, v, l).1 * stack.base.lobe.times_cosine(&FIT, v, l).x
    });
    let scattered = over_hemisphere(|l| {
        let sides = [l, l.with_z(-l.z)].map(|l| stack.base.scattered(&FIT, v, l).x);
        stack.left(&FIT, v, l).1 * (sides[0] + sides[1]) * l.z
    });
    varnish + fuzz + highlight + scattered
}

/// Everything that is promised of layered materials.
pub fn checks() -> Vec<PropertyCheck> {
    let check =
        |property, limit, inputs, value: Measure| PropertyCheck::ours("layered", property, limit, inputs, value);
    let off = |there: f64, back: f64| (there - back).abs() / there.max(back).max(f64::MIN_POSITIVE);
    let with_light = |mut inputs: Vec<Input>| {
        inputs.extend([Input::cosine("cosine_to_light"), Input::turn("streak_to_light_deg")]);
        inputs
    };
    vec![
        check(
            "directional albedo, base alone",
            ALBEDO_LIMIT,
            base_inputs(),
            Box::new(|x| {
                let (base, v) = base(x);
                let bare = Stack {
                    base,
                    sheen_color: 0.0,
                    sheen_roughness: 0.5,
                    clearcoat: 0.0,
                    clearcoat_roughness: 0.5,
                    table: &TABLE,
                };
                stack_albedo(&bare, v)
            }),
        ),
        check(
            "directional albedo",
            ALBEDO_LIMIT,
            stack_inputs(),
            Box::new(|x| {
                let (stack, v) = stack(x);
                stack_albedo(&stack, v)
            }),
        ),
        check(
            "radiance under white ambient light",
            ALBEDO_LIMIT,
            stack_inputs(),
            Box::new(|x| {
                let (stack, v) = stack(x);
                stack.ambient(&FIT, v)
            }),
        ),
        check(
            "scattered light, off reciprocal by",
            1e-6,
            with_light(stack_inputs()),
            Box::new(move |x| {
                let ((stack, v), l) = (stack(x), direction(x[13], x[14].to_radians()));
                let seen = |v, l| stack.left(&FIT, v, l).1 * stack.base.scattered(&FIT, v, l).x;
                off(seen(v, l), seen(l, v))
            }),
        ),
        check(
            "single scattering, off reciprocal by",
            1e-6,
            with_light(base_inputs()),
            Box::new(move |x| {
                let ((base, v), l) = (base(x), direction(x[9], x[10].to_radians()));
                let seen = |v, l: DVec3| base.lobe.single_scattering_times_cosine(v, l).x / l.z;
                off(seen(v, l), seen(l, v))
            }),
        ),
    ]
}
