//! Property checks of the taps of an anisotropic lobe: together they read all of a constant environment, each above the horizon of its
//! normal, and a lobe that is round is read where it was.

use super::property_check::{Input, PropertyCheck};
use super::quadrature::direction;
use crate::measure::twin::environment_lobe::{Tap, taps};
use crate::measure::twin::ggx;
use glam::DVec3;

/// Everything that is promised of them.
pub fn checks() -> Vec<PropertyCheck> {
    let inputs = [
        Input::between("roughness", (0.0, 1.0)),
        Input::between("anisotropy", (-1.0, 1.0)),
        Input::between("mirror", (-0.2, 1.0)),
        Input::cosine("cosine_to_eye"),
        Input::turn("along_to_eye_deg"),
    ];
    let check = |property, limit, value: fn(&[f64]) -> f64| {
        PropertyCheck::ours("anisotropic taps", property, limit, inputs.to_vec(), Box::new(value))
    };
    vec![
        check("share of a constant environment, off 1 by", 1e-12, |x| {
            let off = |count| (read(x, count).iter().map(|tap| tap.weight).sum::<f64>() - 1.0).abs();
            // Few taps are the hardest, as all may lie where the lobe has no light: a share of nothing is not a number.
            [1, 2, 5, 7].map(off).into_iter().sum()
        }),
        check("direction, off unit length by", 1e-6, |x| {
            read(x, 5).iter().map(|tap| (tap.direction.length() - 1.0).abs()).fold(0.0, f64::max)
        }),
        check("round lobe, off its mirror by", 1e-6, |x| {
            let v = direction(x[3], x[4].to_radians());
            let alpha = ggx::anisotropic_alpha(x[0], 0.0);
            let mirror = DVec3::new(-v.x, -v.y, v.z);
            taps(v, alpha, 3, 1.0).iter().map(|tap| (tap.direction - mirror).length()).fold(0.0, f64::max)
        }),
    ]
}

fn read(x: &[f64], count: u32) -> Vec<Tap> {
    taps(direction(x[3], x[4].to_radians()), ggx::anisotropic_alpha(x[0], x[1]), count, x[2])
}
