//! The strands of a coat: every lobe is normalised, and white strands lose next to nothing of white light.

use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};
use vair::measure::twin::albedo::gauss_legendre;
use vair::measure::twin::fibre::{Fibre, along, around, variance};

/// Strands that stand, lean and lie.
const STRAND_TO_NORMAL_DEG: [f64; 4] = [0.0, 30.0, 65.0, 90.0];
const ROUGHNESSES: [f64; 4] = [0.1, 0.35, 0.7, 1.0];

/// The direction at a cosine from z and a turn around it.
fn direction(cosine: f64, turn: f64) -> DVec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    DVec3::new(sine * turn.cos(), sine * turn.sin(), cosine)
}

/// Integral over all directions, in the fibre's angles.
fn over_sphere(fibre: &Fibre, value: impl Fn(DVec3) -> f64) -> f64 {
    let (x, y) = fibre.tangent.any_orthonormal_pair();
    let (rule, turns) = (gauss_legendre(128), 64);
    let ring = |cosine| {
        let at = |turn| {
            let along = direction(cosine, 2.0 * PI * (f64::from(turn) + 0.5) / f64::from(turns));
            value(along.x * x + along.y * y + along.z * fibre.tangent)
        };
        (0..turns).map(at).sum::<f64>() * 2.0 * PI / f64::from(turns)
    };
    rule.iter().map(|&(u, weight)| 2.0 * weight * ring(2.0 * u - 1.0)).sum()
}

/// Strands seen from all sides, in white and with every lobe at that strength.
fn fibres(strength: f64) -> impl Iterator<Item = (Fibre, String)> {
    let eyes = [1.0, 0.7, 0.3, 0.0, -0.3].into_iter().flat_map(|cosine| [0.0, 1.1, 2.3, PI].map(|turn| (cosine, turn)));
    let strands =
        STRAND_TO_NORMAL_DEG.into_iter().flat_map(|tilt_deg| ROUGHNESSES.map(|roughness| (tilt_deg, roughness)));
    strands.flat_map(move |(tilt_deg, roughness)| {
        eyes.clone().map(move |(cosine, turn)| {
            let tangent = direction(f64::to_radians(tilt_deg).cos(), 0.0);
            let eye = direction(cosine, turn);
            let name = format!("tilt {tilt_deg}, roughness {roughness}, eye at cosine {cosine}, turn {turn}");
            (Fibre::new(DVec3::Z, tangent, eye, strength, strength, variance(roughness)), name)
        })
    })
}

/// The longitudinal lobe is 1 over the sine, at the widths that roughness gives and far below.
#[expect(non_snake_case, reason = "the name that formulas go by")]
#[test]
fn hair_Mp() {
    let rule = gauss_legendre(64);
    for variance in [1e-7, 1e-5, 1e-3, 0.0065, 0.125, 1.0, 4.0, 28.0, 112.0] {
        for angle in [0.0, 0.3, -0.8, 1.3, FRAC_PI_2] {
            // Pieces of a quarter of a deviation around the cone, then of the rest.
            let reach = (12.0 * f64::sqrt(variance)).min(2.0 * PI);
            let (from, to) = ((angle - reach).max(-FRAC_PI_2), (angle + reach).min(FRAC_PI_2));
            let integral: f64 = (0..64)
                .flat_map(|piece| {
                    let width = (to - from) / 64.0;
                    let start = from + f64::from(piece) * width;
                    rule.iter().map(move |&(u, weight)| (start + u * width, weight * width))
                })
                .map(|(theta, weight)| {
                    weight * theta.cos() * along(angle.sin(), angle.cos(), variance, theta.sin(), theta.cos())
                })
                .sum();
            assert!((integral - 1.0).abs() < 1e-6, "{integral} at variance {variance}, angle {angle}");
        }
    }
}

#[test]
fn azimuthal_lobes_are_normalised() {
    let turns = 2000;
    let mut sums = [0.0; 2];
    for turn in 0..turns {
        let (sine, cosine) = (2.0 * PI * (f64::from(turn) + 0.5) / f64::from(turns)).sin_cos();
        let found = around(DVec3::X, 0.3 * DVec3::new(cosine, sine, 0.0));
        sums = [0, 1].map(|lobe| sums[lobe] + found[lobe] * 2.0 * PI / f64::from(turns));
    }
    assert!(sums.iter().all(|sum| (sum - 1.0).abs() < 1e-5), "{sums:?}");
    assert_eq!(around(DVec3::ZERO, DVec3::X), [0.5 / PI; 2]);
}

/// White strands over a body, without absorption or root darkening, from all sides.
#[test]
fn hair_furnace() {
    let [mut least, mut most] = [f64::MAX, f64::MIN];
    for (fibre, name) in fibres(1.0) {
        let coat = over_sphere(&fibre, |light| fibre.scattering(1.0, light, 0.0));
        (least, most) = (least.min(coat), most.max(coat));
        assert!((0.95..=1.001).contains(&coat), "a white coat shows {coat} in a white furnace: {name}");
        assert!((fibre.environment(1.0, 1.0, 1.0, 1.0, 0.0) - 1.0).abs() < 1e-12, "{name}");
        for depth in [0.3, 3.0] {
            assert!(over_sphere(&fibre, |light| fibre.scattering(1.0, light, depth)) < coat, "{name}: depth darkens");
        }
    }
    println!("white coats show {least:.4} to {most:.4}");
}

/// The diffuse part holds the sine of Kajiya & Kay 1989, "Rendering Fur with Three Dimensional Textures", normalised.
#[test]
fn kk_furnace() {
    for (fibre, name) in fibres(0.0) {
        let sine_to = |light: DVec3| fibre.tangent.cross(light).length();
        let diffuse = over_sphere(&fibre, |light| fibre.diffuse(light, sine_to(light)));
        assert!((diffuse - 1.0).abs() < 1e-3, "{diffuse} for {name}");
    }
}

#[test]
fn the_mean_horizon_is_near_the_lobes_own() {
    let mut worst = 0.0f64;
    for (fibre, name) in fibres(1.0) {
        for index in 0..3 {
            let share = fibre.lobes[index].share;
            let seen = over_sphere(&fibre, |light| fibre.lobes(light)[index]) / share;
            let error = (fibre.lobes[index].seen - seen).abs();
            worst = worst.max(error);
            assert!(error < 0.075, "lobe {index} sees {seen}, fitted {:?}: {name}", fibre.lobes[index].seen);
        }
    }
    println!("within {worst:.4}");
}
