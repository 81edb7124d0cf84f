//! Property checks of glint: of the flakes in the mean, and of what single pixels see of them.

use super::property_check::{Input, PropertyCheck};
use super::quadrature::{direction, over_cosines, over_reflections};
use super::{ALBEDO_LIMIT, light};
use crate::material::{Flakes, Glint, Standard};
use crate::measure::twin::albedo::Fit;
use crate::measure::twin::ggx;
use crate::measure::twin::glint::{self, Covered, Footprint};
use crate::measure::twin::standard::Surface;
use glam::{DVec2, DVec3};
use std::sync::LazyLock;

static FIT: LazyLock<Fit> = LazyLock::new(Fit::shipped);

/// White flakes on a white cloth, from the first three inputs of every check here.
fn covered(x: &[f64]) -> Covered {
    let cloth = Surface { base_color: DVec3::ONE, metallic: 0.0, roughness: 0.5 };
    Covered { cloth, color: DVec3::splat(x[0]), roughness: x[1], coverage: x[2], intensity: 1.0 }
}

/// Those flakes' places.
fn flakes(x: &[f64]) -> Flakes {
    Glint { flake_roughness: x[1] as f32, coverage: x[2] as f32, ..Glint::default() }.flakes()
}

/// A pixel that wide in rhombi, in a place that the same number chooses.
fn pixel(flakes: &Flakes, width: f64) -> Footprint {
    let place = DVec2::new(1e3 * width, 777.0 * width).fract_gl() * 100.0;
    Footprint::new(flakes, place, DVec2::X * width, DVec2::Y * width)
}

/// Everything that `checks` promises.
pub fn checks() -> Vec<PropertyCheck> {
    let with = |more: Vec<Input>| {
        let of_all = ["flake_color", "flake_roughness", "coverage"].map(Input::of::<Glint>);
        [of_all.to_vec(), vec![Input::cosine("cosine_to_eye")], more].concat()
    };
    let width = || Input { grazing: true, ..Input::between("pixel_width", (1e-2, 20.0)) };
    let lit = with(vec![Input::signed_cosine("cosine_to_light"), Input::turn("eye_to_light_deg"), width()]);
    let check = |property, inputs, value| PropertyCheck::ours("glint", property, ALBEDO_LIMIT, inputs, value);
    let mut checks = vec![
        check("directional albedo", with(Vec::new()), Box::new(|x| albedo(&covered(x), x[3]))),
        check(
            "radiance under white ambient light",
            with(["base_color", "metallic", "roughness"].map(Input::of::<Standard>).to_vec()),
            Box::new(|x| {
                let cloth = Surface { base_color: DVec3::splat(x[4]), metallic: x[5], roughness: x[6] };
                Covered { cloth, ..covered(x) }.ambient(&FIT, x[3], (DVec3::ONE, 1.0)).max_element()
            }),
        ),
        check(
            "the same, of one pixel",
            with(vec![width()]),
            Box::new(|x| {
                let flakes = flakes(x);
                let pixel = pixel(&flakes, x[4]);
                let cover = glint::cover(&flakes, &glint::discs(&flakes, &pixel, 0), glint::apart(&pixel));
                covered(x).ambient(&FIT, x[3], cover).max_element()
            }),
        ),
    ];
    let both = vec![
        Input::of::<Glint>("flake_color"),
        Input::of::<Glint>("flake_roughness"),
        Input::cosine("cosine_to_eye"),
        Input::cosine("cosine_to_light"),
        Input::turn("eye_to_light_deg"),
    ];
    checks.push(PropertyCheck {
        limit: Some(1e-6),
        ..check(
            "single scattering, off reciprocal by",
            both,
            Box::new(|x| {
                // The factor of the flakes is one of the half vector alone.
                let (v, l) = (direction(x[2], 0.0), direction(x[3], x[4].to_radians()));
                let alpha = ggx::alpha_of_roughness(x[1]);
                let lobe =
                    |v, l: DVec3| glint::smooth_times_cosine(DVec3::splat(x[0]), DVec3::ONE, alpha, v, l).x / l.z;
                let (there, back) = (lobe(v, l), lobe(l, v));
                (there - back).abs() / there.max(back).max(f64::MIN_POSITIVE)
            }),
        )
    });
    checks.extend(light::checks("glint", false, &lit, |x, irradiance| {
        let (flakes, v, l) = (flakes(x), direction(x[3], 0.0), direction(x[4], x[5].to_radians()));
        let pixel = pixel(&flakes, x[6]);
        let square = glint::square(ggx::half_vector(v, l), ggx::alpha_of_roughness(x[1]));
        let flash = glint::flash(&flakes, &pixel, 0, square, 0.0);
        irradiance * covered(x).brdf_times_cosine(&FIT, v, l, 1.0, flash)
    }));
    checks
}

/// Share of white light that comes back to an eye at the cosine `mu`, in the mean.
fn albedo(covered: &Covered, mu: f64) -> f64 {
    let v = direction(mu, 0.0);
    let of_lobe = |surface: Surface| {
        let alpha = ggx::alpha_of_roughness(surface.roughness);
        let lobe = over_reflections(v, (alpha, alpha), |l| surface.single_scattering_times_cosine(v, l).x);
        lobe * surface.specular_compensation(&FIT, mu).x
    };
    let metal = Surface { base_color: covered.color, metallic: 1.0, roughness: covered.roughness };
    let diffuse = over_cosines(|mu_l| covered.cloth.diffuse_brdf(&FIT, mu, mu_l).x * mu_l);
    (1.0 - covered.coverage) * (of_lobe(covered.cloth) + diffuse) + covered.coverage * of_lobe(metal)
}
