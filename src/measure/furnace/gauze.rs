//! Property checks of gauze.

use super::anisotropy::{FIT, reflected};
use super::property_check::{Input, PropertyCheck};
use super::quadrature::{direction, over_hemisphere};
use super::{ALBEDO_LIMIT, light};
use crate::material::{self, Standard};
use crate::measure::twin::anisotropy::Lobe;
use crate::measure::twin::gauze::{Gauze, Weave, met_by_both};
use crate::measure::twin::{ggx, satin};
use glam::DVec3;

/// White gauze with a grey highlight, from the first four inputs of every check here.
fn gauze(x: &[f64], weave: fn(f64) -> Weave) -> Gauze {
    let f0 = satin::f0(satin::reflectance(DVec3::ONE, x[1], 0.0), 1.0);
    let lobe = Lobe { f0, f90: satin::f90(f0), alpha: ggx::anisotropic_alpha(x[2], x[3]) };
    Gauze { diffuse: DVec3::ONE, weave: weave(x[0]), lobe }
}

/// What reaches `v` of white light from everywhere: reflected, shone through, and let through.
fn leaving(gauze: &Gauze, v: DVec3) -> f64 {
    let (mean, met) = (gauze.weave.mean_opacity(), gauze.weave.opacity(v));
    let highlight = match gauze.lobe.f90 {
        0.0 => 0.0,
        _ => reflected(&gauze.lobe, v, |l| met_by_both(met, gauze.weave.opacity(l))),
    };
    let scattered = over_hemisphere(|l| {
        let behind = DVec3::new(l.x, l.y, -l.z);
        (gauze.diffuse_bsdf(&FIT, mean, v, l).x + gauze.diffuse_bsdf(&FIT, mean, v, behind).x) * l.z
    });
    highlight + scattered + 1.0 - met
}

/// Everything that is promised of gauze.
pub fn checks() -> Vec<PropertyCheck> {
    let at = |input: Input, corners: &[f64]| Input { corners: corners.to_vec(), ..input };
    let inputs = vec![
        // Also nearly 0, which is not opaque.
        at(Input::of::<material::Gauze>("weave_density"), &[0.0, 1e-3, 2.0, 200.0]),
        // Up to where more changes nothing, the scatter's strength counted in.
        at(Input::between("specular_strength", (0.0, 25.0)), &[0.0, 25.0]),
        Input::of::<Standard>("roughness"),
        Input::of::<material::Gauze>("anisotropy"),
        at(Input::cosine("cosine_to_eye"), &[1e-3, 0.05, 0.3, 1.0]),
        at(Input::turn("along_to_eye_deg"), &[0.0, 45.0]),
    ];
    // Light in the plane of the sheet is on neither side.
    let to_light = at(Input::signed_cosine("cosine_to_light"), &[-1.0, -0.3, -0.01, 0.05, 0.5, 1.0]);
    let lit = [inputs.clone(), vec![to_light, Input::turn("along_to_light_deg")]].concat();
    let albedo = |property, weave: fn(f64) -> Weave| PropertyCheck {
        material: "gauze",
        property,
        classic: false,
        limit: Some(ALBEDO_LIMIT),
        inputs: inputs.clone(),
        value: Box::new(move |x| leaving(&gauze(x, weave), direction(x[4], x[5].to_radians()))),
    };
    let mut checks = vec![
        albedo("reflected, through and between threads", Weave::matted),
        albedo("the same of crossed threads", Weave::crossed),
        PropertyCheck {
            property: "radiance under white ambient light",
            value: Box::new(|x| {
                let (gauze, v) = (gauze(x, Weave::matted), direction(x[4], x[5].to_radians()));
                gauze.ambient(&FIT, v).x + 1.0 - gauze.weave.opacity(v)
            }),
            ..albedo("", Weave::matted)
        },
        PropertyCheck {
            property: "diffuse scattering, off reciprocal by",
            limit: Some(1e-6),
            inputs: lit.clone(),
            value: Box::new(|x| {
                let (v, l) = (direction(x[4], x[5].to_radians()), direction(x[6], x[7].to_radians()));
                let gauze = gauze(x, Weave::crossed);
                // Seen from behind, the frame is turned over with the eye.
                let side = if l.z < 0.0 { DVec3::new(1.0, 1.0, -1.0) } else { DVec3::ONE };
                // The mean is a factor of both.
                let there = gauze.diffuse_bsdf(&FIT, 1.0, v, l).x;
                let back = gauze.diffuse_bsdf(&FIT, 1.0, l * side, v * side).x;
                (there - back).abs() / there.max(back).max(f64::MIN_POSITIVE)
            }),
            ..albedo("", Weave::crossed)
        },
    ];
    checks.extend(light::checks("gauze", false, &lit, |x, irradiance| {
        let (v, l) = (direction(x[4], x[5].to_radians()), direction(x[6], x[7].to_radians()));
        let gauze = gauze(x, Weave::matted);
        irradiance * (gauze.bsdf_times_cosine(&FIT, gauze.weave.mean_opacity(), v, l) + gauze.ambient(&FIT, v))
    }));
    checks
}
