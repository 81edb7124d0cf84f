//! Claims of the standard surface.

use super::claim::{Claim, Input};
use super::quadrature::{direction, over_cosines, over_normals, over_reflections};
use super::{ALBEDO_LIMIT, light};
use crate::material::Standard;
use crate::material::reference::albedo::Fit;
use crate::material::reference::ggx;
use crate::material::reference::standard::Surface;
use glam::DVec3;
use std::sync::LazyLock;

static FIT: LazyLock<Fit> = LazyLock::new(Fit::shipped);

/// A grey surface, from the first three inputs of every claim here.
fn surface(x: &[f64]) -> Surface {
    Surface { base_color: DVec3::splat(x[0]), metallic: x[1], roughness: x[2] }
}

/// Everything that `claims` promises.
pub fn claims() -> Vec<Claim> {
    let surface_inputs = || {
        vec![Input::of::<Standard>("base_color"), Input::of::<Standard>("metallic"), Input::of::<Standard>("roughness")]
    };
    let with = |more: Vec<Input>| [surface_inputs(), more].concat();
    let claim =
        |property, limit, inputs, value| Claim { material: "standard", property, classic: false, limit, inputs, value };
    let both = || with(vec![Input::cosine("cosine_to_eye"), Input::cosine("cosine_to_light")]);
    let lit = with(vec![
        Input::cosine("cosine_to_eye"),
        Input::signed_cosine("cosine_to_light"),
        Input::turn("eye_to_light_deg"),
    ]);
    let mut claims = vec![
        claim(
            "directional albedo",
            Some(ALBEDO_LIMIT),
            with(vec![Input::cosine("cosine_to_eye")]),
            Box::new(|x| albedo(&surface(x), x[3], Surface::specular_times_cosine)),
        ),
        claim(
            "radiance under white ambient light",
            Some(ALBEDO_LIMIT),
            with(vec![Input::cosine("cosine_to_eye")]),
            Box::new(|x| surface(x).ambient(&FIT, x[3]).max_element()),
        ),
        claim(
            "integral of the normals, off 1 by",
            Some(1e-4),
            vec![Input::of::<Standard>("roughness"), Input::between("anisotropy", (-1.0, 1.0))],
            Box::new(|x| {
                let (ax, ay) = ggx::anisotropic_alpha(x[0], x[1]);
                (over_normals((ax, ay), |h| ggx::ndf(h, ax, ay) * h.z) - 1.0).abs()
            }),
        ),
        claim(
            "diffuse lobe, off reciprocal by",
            Some(1e-6),
            both(),
            Box::new(|x| {
                let (there, back) =
                    (surface(x).diffuse_brdf(&FIT, x[3], x[4]).x, surface(x).diffuse_brdf(&FIT, x[4], x[3]).x);
                (there - back).abs() / there.max(back).max(f64::MIN_POSITIVE)
            }),
        ),
        // Turquin's compensation asks the eye's side only: not reciprocal, by design.
        claim(
            "specular lobe over itself swapped",
            None,
            both(),
            Box::new(|x| {
                let (v, l) = (direction(x[3], 0.0), direction(x[4], std::f64::consts::PI));
                let specular = |v, l: DVec3| surface(x).specular_times_cosine(&FIT, v, l).x / l.z;
                specular(v, l) / specular(l, v)
            }),
        ),
    ];
    claims.extend(light::claims("standard", false, &lit, |x, irradiance| {
        let (v, l) = (direction(x[3], 0.0), direction(x[4], x[5].to_radians()));
        irradiance * (surface(x).brdf_times_cosine(&FIT, v, l) + surface(x).ambient(&FIT, x[3]))
    }));
    claims
}

/// Share of white light that comes back to an eye at the cosine `mu`, with that specular lobe over the shipped diffuse.
fn albedo(surface: &Surface, mu: f64, specular: impl Fn(&Surface, &Fit, DVec3, DVec3) -> DVec3) -> f64 {
    let alpha = ggx::alpha_of_roughness(surface.roughness);
    let v = direction(mu, 0.0);
    let reflected = over_reflections(v, (alpha, alpha), |l| specular(surface, &FIT, v, l).x);
    reflected + over_cosines(|mu_l| surface.diffuse_brdf(&FIT, mu, mu_l).x * mu_l)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judged(specular: fn(&Surface, &Fit, DVec3, DVec3) -> DVec3) -> crate::verify::Property {
        let mut claim = claims().remove(0);
        claim.value = Box::new(move |x| albedo(&surface(x), x[3], specular));
        claim.judge(200)
    }

    #[test]
    fn a_doubled_lobe_fails() {
        assert!(judged(Surface::specular_times_cosine).pass);
        let doubled = judged(|surface, fit, v, l| 2.0 * surface.specular_times_cosine(fit, v, l));
        assert!(doubled.fails() && (1.9..2.1).contains(&doubled.worst), "{doubled}");
    }

    #[test]
    fn a_lobe_that_is_half_a_percent_too_strong_fails() {
        let strong = judged(|surface, fit, v, l| 1.005 * surface.specular_times_cosine(fit, v, l));
        assert!(strong.fails(), "{strong}");
    }

    #[test]
    fn a_lobe_of_nothing_but_nan_fails() {
        let broken = judged(|_, _, _, _| DVec3::NAN);
        assert!(broken.fails() && broken.worst.is_finite() && broken.nonfinite == broken.samples, "{broken}");
    }
}
