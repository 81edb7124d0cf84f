//! The same checks of the formulas of older engines, whose ranges are those of their own manuals.

use super::fur::outside;
use super::property_check::{Input, PropertyCheck};
use super::quadrature::{direction, over_hemisphere, over_normals, over_reflections, over_sphere};
use super::{ALBEDO_LIMIT, light};
use crate::measure::twin::classic::{cotton, fur, gauze, laser, satin, velvet};
use glam::DVec3;
use std::f64::consts::PI;

fn check(
    material: &'static str,
    property: &'static str,
    limit: f64,
    inputs: Vec<Input>,
    value: impl Fn(&[f64]) -> f64 + Send + Sync + 'static,
) -> PropertyCheck {
    PropertyCheck { material, property, classic: true, limit: Some(limit), inputs, value: Box::new(value) }
}

/// Everything that is measured of the classic formulas.
pub fn checks() -> Vec<PropertyCheck> {
    [gauze(), laser(), satin(), cotton(), velvet(), fur()].into_iter().flatten().collect()
}

/// The highlight of gauze and satin, from four inputs.
fn lobe(x: &[f64], two_way: bool) -> satin::Lobe {
    satin::Lobe { strength: x[0], roughness: x[1], anisotropy: x[2], f0: x[3], two_way }
}

/// Inputs of [`lobe`], and the eye.
fn lobe_inputs(strength: (f64, f64)) -> Vec<Input> {
    vec![
        Input::between("strength", strength),
        Input::between("roughness", satin::ROUGHNESS),
        Input::between("anisotropy", satin::ANISOTROPY),
        Input::between("f0", satin::F0),
        Input::cosine("cosine_to_eye"),
        Input::turn("along_to_eye_deg"),
    ]
}

/// Albedo of that highlight towards `v`.
fn lobe_albedo(lobe: &satin::Lobe, v: DVec3) -> f64 {
    let one = |anisotropy| {
        let lobe = satin::Lobe { anisotropy, two_way: false, ..*lobe };
        let (ax, ay) = satin::widths(lobe.roughness, anisotropy);
        // Widths of 0 have no reflections to follow; the lobe itself is asked as it is.
        over_reflections(v, (ax.max(1e-4), ay.max(1e-4)), |l| lobe.times_cosine(v, l))
    };
    one(lobe.anisotropy) + if lobe.two_way { one(-lobe.anisotropy) } else { 0.0 }
}

fn gauze() -> Vec<PropertyCheck> {
    let mut inputs = lobe_inputs(gauze::STRENGTH);
    inputs.push(Input::between("scatter_strength", gauze::SCATTER_STRENGTH));
    // From 1, as 0 means opaque gauze, not a weave.
    let density = Input::between("weave_density", (1.0, gauze::DENSITY.1));
    vec![
        check("gauze", "directional albedo", ALBEDO_LIMIT, inputs, |x| {
            lobe_albedo(&gauze::highlight(lobe(x, false), x[6]), direction(x[4], x[5].to_radians()))
        }),
        check("gauze", "light from the front beyond a weave's", 1e-3, vec![density], |x| {
            1.0 - gauze::opacity(x[0], 1.0) - gauze::facing_transmittance_of_a_weave(x[0])
        }),
    ]
}

fn laser() -> Vec<PropertyCheck> {
    let span = Input::between("hue_span", laser::HUE_SPAN);
    let radius = Input::between("radius_px", (10.0, 100.0));
    vec![
        // A quarter of a turn between neighbours is the most that keeps neighbouring hues in their order.
        check("laser", "turns of hue from a pixel to the next", 0.25, vec![span, radius], |x| {
            laser::turns_a_pixel(x[0], x[1], 0.5)
        }),
        check("laser", "printed sine, short of the sine by", 1e-3, vec![Input::cosine("cosine_to_eye")], |x| {
            (1.0 - x[0] * x[0]).sqrt() - laser::printed_sine(x[0])
        }),
    ]
}

fn satin() -> Vec<PropertyCheck> {
    let albedo = |two_way| move |x: &[f64]| lobe_albedo(&lobe(x, two_way), direction(x[4], x[5].to_radians()));
    let widths = vec![Input::between("roughness", (0.1, 1.0)), Input::between("anisotropy", (-0.98, 0.98))];
    let inputs = || lobe_inputs(satin::STRENGTH);
    let mut checks = vec![
        check("satin", "directional albedo", ALBEDO_LIMIT, inputs(), albedo(false)),
        check("satin", "directional albedo, two ways", ALBEDO_LIMIT, inputs(), albedo(true)),
        check("satin", "integral of the normals, off 1 by", 1e-4, widths, |x| {
            let (ax, ay) = satin::widths(x[0], x[1]);
            (over_normals((ax, ay), |h| satin::ndf(h, ax, ay) * h.z) - 1.0).abs()
        }),
    ];
    let tint = [Input::between("tint_red", (0.0, 1.0)), Input::between("tint_green", (0.0, 1.0))];
    checks.extend(light::checks("satin", true, &tint, |x, irradiance| {
        satin::tinted(DVec3::new(x[0], x[1], 0.0), irradiance)
    }));
    checks
}

fn cotton() -> Vec<PropertyCheck> {
    let roughness = |name| Input::between(name, cotton::ROUGHNESS);
    let color = |name| Input::between(name, cotton::COLOR);
    let eye = || Input::cosine("cosine_to_eye");
    let inputs =
        vec![color("base_color"), color("sheen_color"), roughness("roughness"), roughness("sheen_roughness"), eye()];
    vec![
        check("cotton", "directional albedo", ALBEDO_LIMIT, inputs, |x| {
            let cotton = cotton::Cotton { base_color: x[0], sheen_color: x[1], roughness: x[2], sheen_roughness: x[3] };
            let v = direction(x[4], 0.0);
            let table = fuzz_albedo(x[3], x[4]).min(1.0);
            over_hemisphere(|l| cotton.brdf_times_cosine(table, v, l))
        }),
        check("cotton", "directional albedo, fuzz alone", ALBEDO_LIMIT, vec![roughness("alpha"), eye()], |x| {
            fuzz_albedo(x[0], x[1])
        }),
        check("cotton", "integral of the normals, off 1 by", 1e-4, vec![roughness("alpha")], |x| {
            (over_hemisphere(|h| cotton::ndf(h, x[0]) * h.z) - 1.0).abs()
        }),
    ]
}

fn fuzz_albedo(alpha: f64, mu: f64) -> f64 {
    let v = direction(mu, 0.0);
    over_hemisphere(|l| cotton::fuzz_times_cosine(v, l, alpha))
}

fn velvet() -> Vec<PropertyCheck> {
    let inputs = vec![
        Input::between("base_color", velvet::COLOR),
        Input::between("f0", velvet::COLOR),
        Input::between("roughness", velvet::ROUGHNESS),
        Input::between("scatter_color", velvet::COLOR),
        Input::between("scatter_scale", velvet::SCATTER_SCALE),
        Input::cosine("cosine_to_eye"),
    ];
    let material = |x: &[f64]| velvet::Velvet {
        base_color: x[0],
        f0: x[1],
        roughness: x[2],
        scatter_color: x[3],
        scatter_scale: x[4],
    };
    let lit = [inputs.clone(), vec![Input::signed_cosine("cosine_to_light"), Input::turn("eye_to_light_deg")]].concat();
    let mut checks = vec![
        check("velvet", "directional albedo", ALBEDO_LIMIT, inputs, move |x| {
            let (velvet, v) = (material(x), direction(x[5], 0.0));
            over_hemisphere(|l| velvet.brdf_times_cosine(v, l))
        }),
        check("velvet", "integral of the normals, off 1 by", 1e-4, Vec::new(), |_| {
            (over_hemisphere(|h| velvet::ndf(h) * h.z) - 1.0).abs()
        }),
    ];
    checks.extend(light::checks("velvet", true, &lit, move |x, irradiance| {
        let (v, l) = (direction(x[5], 0.0), direction(x[6], x[7].to_radians()));
        let velvet = material(x);
        irradiance.to_array().map(|light| velvet.radiance(v, l, light)).into()
    }));
    checks
}

fn fur() -> Vec<PropertyCheck> {
    let eye = || Input::signed_cosine("cosine_to_eye");
    let share = |name| Input::between(name, fur::SHARE);
    let force = || vec![share("force_strength"), Input::turn("root_to_force_deg")];
    let thin = || vec![Input::between("exponent", fur::EXPONENT), Input::signed_cosine("sine_to_eye")];
    vec![
        check(
            "fur",
            "opacity outside 0 to 1, by",
            0.0,
            vec![Input::between("height", fur::HEIGHT), eye(), share("edge_fade")],
            |x| outside(fur::opacity(x[0], x[1], x[2])),
        ),
        check("fur", "coverage of a column outside 0 to 1, by", 0.0, vec![eye(), share("edge_fade")], |x| {
            outside(fur::column_coverage(x[0], x[1]))
        }),
        check("fur", "tip under the skin, in lengths", 0.0, force(), |x| -fur::place(1.0, x[0], x[1].to_radians())[0]),
        check("fur", "length of a strand, off 1 by", 1e-5, force(), |x| {
            let place = |step: i32| fur::place(f64::from(step) / 256.0, x[0], x[1].to_radians());
            let piece = |step| (place(step + 1)[0] - place(step)[0]).hypot(place(step + 1)[1] - place(step)[1]);
            ((0..256).map(piece).sum::<f64>() - 1.0).abs()
        }),
        check("thin hair", "light scattered, diffuse", ALBEDO_LIMIT, Vec::new(), |_| {
            over_sphere(DVec3::Z, DVec3::X, |light| fur::thin_diffuse(DVec3::Z, light))
        }),
        check("thin hair", "light scattered, highlight", ALBEDO_LIMIT, thin(), |x| {
            let eye = direction(x[1], PI);
            over_sphere(DVec3::Z, eye, |light| fur::thin_highlight(DVec3::Z, eye, light, x[0]))
        }),
    ]
}
