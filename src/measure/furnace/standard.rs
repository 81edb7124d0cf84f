//! Property checks of the standard surface.

use super::property_check::{Input, PropertyCheck};
use super::quadrature::{direction, over_cosines, over_normals, over_reflections};
use super::{ALBEDO_LIMIT, light};
use crate::material::Standard;
use crate::measure::twin::albedo::Fit;
use crate::measure::twin::ggx;
use crate::measure::twin::standard::Surface;
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::LazyLock;

static FIT: LazyLock<Fit> = LazyLock::new(Fit::shipped);

/// A grey surface, from the first three inputs of every check here.
fn surface(x: &[f64]) -> Surface {
    Surface { base_color: DVec3::splat(x[0]), metallic: x[1], roughness: x[2] }
}

/// Everything that `checks` promises.
pub fn checks() -> Vec<PropertyCheck> {
    let surface_inputs = || {
        vec![Input::of::<Standard>("base_color"), Input::of::<Standard>("metallic"), Input::of::<Standard>("roughness")]
    };
    let with = |more: Vec<Input>| [surface_inputs(), more].concat();
    let check = |property, limit, inputs, value| PropertyCheck {
        material: "standard",
        property,
        classic: false,
        limit,
        inputs,
        value,
    };
    let both = || with(vec![Input::cosine("cosine_to_eye"), Input::cosine("cosine_to_light")]);
    let lit = with(vec![
        Input::cosine("cosine_to_eye"),
        Input::signed_cosine("cosine_to_light"),
        Input::turn("eye_to_light_deg"),
    ]);
    let mut checks = vec![
        check(
            "directional albedo",
            Some(ALBEDO_LIMIT),
            with(vec![Input::cosine("cosine_to_eye")]),
            Box::new(|x| albedo(&surface(x), x[3], Surface::single_scattering_times_cosine)),
        ),
        check(
            "radiance under white ambient light",
            Some(ALBEDO_LIMIT),
            with(vec![Input::cosine("cosine_to_eye")]),
            Box::new(|x| surface(x).ambient(&FIT, x[3]).max_element()),
        ),
        check(
            "integral of the normals, off 1 by",
            Some(1e-4),
            vec![Input::of::<Standard>("roughness"), Input::between("anisotropy", (-1.0, 1.0))],
            Box::new(|x| {
                let (ax, ay) = ggx::anisotropic_alpha(x[0], x[1]);
                (over_normals((ax, ay), |h| ggx::ndf(h, ax, ay) * h.z) - 1.0).abs()
            }),
        ),
        check(
            "diffuse lobe, off reciprocal by",
            Some(1e-6),
            both(),
            Box::new(|x| {
                let (there, back) =
                    (surface(x).diffuse_brdf(&FIT, x[3], x[4]).x, surface(x).diffuse_brdf(&FIT, x[4], x[3]).x);
                (there - back).abs() / there.max(back).max(f64::MIN_POSITIVE)
            }),
        ),
        check(
            "single scattering, off reciprocal by",
            Some(1e-6),
            both(),
            Box::new(|x| {
                let (v, l) = (direction(x[3], 0.0), direction(x[4], PI));
                let lobe = |v, l: DVec3| surface(x).single_scattering_times_cosine(v, l).x / l.z;
                let (there, back) = (lobe(v, l), lobe(l, v));
                (there - back).abs() / there.max(back).max(f64::MIN_POSITIVE)
            }),
        ),
        // Turquin's compensation asks the eye's side only: this is how far the whole is from reciprocal, by design.
        check(
            "compensation over itself swapped",
            None,
            both(),
            Box::new(|x| {
                let compensation = |mu| surface(x).specular_compensation(&FIT, mu).x;
                compensation(x[3]) / compensation(x[4])
            }),
        ),
    ];
    checks.extend(light::checks("standard", false, &lit, |x, irradiance| {
        let (v, l) = (direction(x[3], 0.0), direction(x[4], x[5].to_radians()));
        irradiance * (surface(x).brdf_times_cosine(&FIT, v, l) + surface(x).ambient(&FIT, x[3]))
    }));
    checks
}

/// Share of white light that comes back to an eye at the cosine `mu`, with that lobe in the place of single scattering.
fn albedo(surface: &Surface, mu: f64, lobe: impl Fn(&Surface, DVec3, DVec3) -> DVec3) -> f64 {
    let alpha = ggx::alpha_of_roughness(surface.roughness);
    let v = direction(mu, 0.0);
    let reflected = over_reflections(v, (alpha, alpha), |l| lobe(surface, v, l).x);
    let diffuse = over_cosines(|mu_l| surface.diffuse_brdf(&FIT, mu, mu_l).x * mu_l);
    surface.specular_compensation(&FIT, mu).x * reflected + diffuse
}

#[cfg(test)]
mod tests {
    use super::super::quadrature::over_hemisphere;
    use super::*;

    fn judged(lobe: fn(&Surface, DVec3, DVec3) -> DVec3) -> super::super::Property {
        let mut check = checks().remove(0);
        check.value = Box::new(move |x| albedo(&surface(x), x[3], lobe));
        check.judge(50)
    }

    #[test]
    fn a_doubled_lobe_fails() {
        assert!(judged(Surface::single_scattering_times_cosine).pass);
        let doubled = judged(|surface, v, l| 2.0 * surface.single_scattering_times_cosine(v, l));
        assert!(doubled.fails() && (1.9..2.1).contains(&doubled.worst), "{doubled}");
    }

    #[test]
    fn a_lobe_that_is_half_a_percent_too_strong_fails() {
        let strong = judged(|surface, v, l| 1.005 * surface.single_scattering_times_cosine(v, l));
        assert!(strong.fails(), "{strong}");
    }

    #[test]
    fn a_lobe_of_nothing_but_nan_fails() {
        let broken = judged(|_, _, _| DVec3::NAN);
        assert!(broken.fails() && broken.worst.is_finite() && broken.nonfinite == broken.samples, "{broken}");
    }

    #[test]
    fn the_lobes_are_those_of_the_whole_brdf() {
        let surface = Surface { base_color: DVec3::splat(0.7), metallic: 0.3, roughness: 0.8 };
        let v = direction(0.4, 0.0);
        let whole = over_hemisphere(|l| surface.brdf_times_cosine(&FIT, v, l).x);
        let parts = albedo(&surface, 0.4, Surface::single_scattering_times_cosine);
        assert!((whole - parts).abs() < 4e-4, "two settled integrals: {whole} {parts}");
    }
}
