//! Twin of `shadow.glsl`: what reading a shadow map takes. Depth is reversed: 1 at the light, 0 far away.

use super::domain::{ALMOST_ONE, Domain, UNIT};
use super::{Rule, Twin};
use glam::DVec3;

/// Optical depth of what lets nothing through.
pub const OPAQUE_DEPTH: f64 = 16.0;
/// Share of the way from the first translucent surface to the last that counts as being at either.
pub const AT: f64 = 0.01;
/// Where depths are collected, as shares of that way.
pub const KNOTS: [f64; 4] = [AT, 1.0 / 3.0, 2.0 / 3.0, 1.0 - AT];

/// How far along the normal a point on a plane is moved so that the plane clears it by no less than nothing wherever a
/// texel within `reach` of it is read; `cosine` is that of plane and light.
pub fn normal_step(reach: f64, cosine: f64) -> f64 {
    // h / cos = reach tan, and h = reach sin.
    reach * cosine.abs().min(1.0).acos().sin()
}

/// Weight of a texel at a distance, texels, in a tent of `radius` texels.
pub fn filter_weight(distance: f64, radius: f64) -> f64 {
    if distance.abs() < radius { (1.0 - distance.abs() / radius) / radius } else { 0.0 }
}

/// Optical depth of a share of light.
pub fn optical_depth(transmittance: DVec3) -> DVec3 {
    transmittance
        .to_array()
        .map(|share| if share > 0.0 { (-share.ln()).min(OPAQUE_DEPTH) } else { OPAQUE_DEPTH })
        .into()
}

/// Where a depth lies between those of the first surface and the last.
pub fn place(depth: f64, nearest: f64, farthest: f64) -> f64 {
    (nearest - depth) / (nearest - farthest).max(1e-6)
}

/// What a surface at a place adds to the depths collected at the knots.
pub fn layers(optical_depth: f64, place: f64) -> [f64; 4] {
    KNOTS.map(|knot| if place <= knot { optical_depth } else { 0.0 })
}

/// Share of all optical depth before a place: a line through what was collected at 0, 1/3, 2/3 and 1.
pub fn crossed(depths: [f64; 4], total: f64, place: f64) -> f64 {
    if place <= AT {
        return 0.0;
    }
    if place > 1.0 + AT {
        return 1.0;
    }
    let at = 3.0 * place.min(1.0);
    let below = (at as usize).min(2);
    let depth = depths[below] + (at - below as f64) * (depths[below + 1] - depths[below]);
    (depth / total.max(1e-6)).clamp(0.0, 1.0)
}

/// Metres, or texels.
const REACH: Domain = Domain::Log(1e-6, 1e3, &[0.0, 1e-30, 1.0, 1e30]);
const COSINE: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, -1e-7, 0.0, 1e-40, 0.5, 1.0]);
/// Texels.
const DISTANCE: Domain = Domain::Uniform(-4.0, 4.0, &[-3.0, -1.0, 0.0, 1e-40, 1.0, 2.0, 1e30]);
/// Of a map, reversed.
const DEPTH: Domain = Domain::Uniform(0.0, 1.0, &[0.0, 1e-7, 0.5, ALMOST_ONE, 1.0]);
const OPTICAL_DEPTH: Domain = Domain::Log(1e-4, 64.0, &[0.0, 1e-30, 1.0, 16.0, 6e4]);
const PLACE: Domain = Domain::Uniform(-0.5, 1.5, &[-1e6, 0.0, 0.01, 0.5, 1.0, 1e6]);

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    // 1 - c^2 loses what c is rounded by.
    Twin::new("shadow_normal_step", &[REACH, COSINE], |inputs| vec![normal_step(inputs.number(), inputs.number())])
        .rule(Rule::Conditioned(4)),
    Twin::new("shadow_filter_weight", &[DISTANCE, Domain::Uniform(1.0, 3.0, &[1.0, 2.0, 3.0])], |inputs| {
        vec![filter_weight(inputs.number(), inputs.number())]
    }),
    Twin::new("shadow_passed", &[DEPTH, DEPTH], |inputs| vec![f64::from(u8::from(inputs.number() <= inputs.number()))]),
    Twin::new("shadow_optical_depth", &[UNIT], |inputs| optical_depth(inputs.vec3()).to_array().to_vec())
        // Vulkan has the logarithm within 2^-21 where it is near 0.
        .limit(2e-5, 2e-6),
    Twin::new("shadow_place", &[DEPTH, DEPTH, DEPTH], |inputs| {
        vec![place(inputs.number(), inputs.number(), inputs.number())]
    })
    // The difference of two depths decides.
    .rule(Rule::Conditioned(2)),
    Twin::new("shadow_layers", &[OPTICAL_DEPTH, PLACE], |inputs| layers(inputs.number(), inputs.number()).to_vec())
        .rule(Rule::Stepped(1)),
    Twin::new("shadow_crossed", &[OPTICAL_DEPTH, OPTICAL_DEPTH, PLACE], |inputs| {
        let depths = std::array::from_fn(|_| inputs.number());
        vec![crossed(depths, inputs.number(), inputs.number())]
    })
    // Steps at both ends, and differences of collected depths between them.
    .rule(Rule::Conditioned(4))
    .limit(2e-5, 2e-6),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_of_all_texels_add_up_to_one_wherever_the_point_is() {
        for radius in [1, 2, 3] {
            for step in 0..50 {
                let at = f64::from(step) / 50.0;
                let sum: f64 = (-8..8).map(|texel| filter_weight(f64::from(texel) - at, f64::from(radius))).sum();
                assert!((sum - 1.0).abs() < 1e-12, "{radius} {at}: {sum}");
            }
        }
    }

    #[test]
    fn a_plane_never_shadows_itself() {
        for degrees in 0..90 {
            let angle = f64::from(degrees).to_radians();
            let reach = 0.7;
            // The light is along y: where the plane rises towards the texel, and how high the moved point is there.
            let step = normal_step(reach, angle.cos());
            let (moved_aside, moved_up) = (-step * angle.sin(), step * angle.cos());
            let plane_at_texel = (moved_aside + reach) * angle.tan();
            assert!(moved_up >= plane_at_texel - 1e-9, "{degrees}: {moved_up} {plane_at_texel}");
        }
    }

    /// What is collected of surfaces, each a place and an optical depth.
    fn collected(surfaces: &[(f64, f64)]) -> ([f64; 4], f64) {
        let mut depths = [0.0; 4];
        for &(place, depth) in surfaces {
            for (sum, layer) in depths.iter_mut().zip(layers(depth, place)) {
                *sum += layer;
            }
        }
        (depths, surfaces.iter().map(|(_, depth)| depth).sum())
    }

    #[test]
    fn two_sheets_are_told_apart_exactly() {
        let (depths, total) = collected(&[(0.0, 0.5), (1.0, 1.5)]);
        let at = |place| total * crossed(depths, total, place);
        assert_eq!(at(-0.1), 0.0);
        // The first sheet itself, all that lies between, the second one, and what is behind.
        assert_eq!(at(0.0), 0.0);
        for place in [0.05, 0.4, 0.9, 1.0] {
            assert!((at(place) - 0.5).abs() < 1e-12, "{place}: {}", at(place));
        }
        assert_eq!(at(1.5), 2.0);
    }

    #[test]
    fn light_fades_steadily_through_fur() {
        let slabs: Vec<_> = (0..8).map(|slab| (f64::from(slab) / 7.0, 0.25)).collect();
        let (depths, total) = collected(&slabs);
        let mut before = 0.0;
        for step in 0..=120 {
            let now = crossed(depths, total, f64::from(step) / 100.0);
            assert!(now >= before && now <= 1.0);
            before = now;
        }
        assert!((crossed(depths, total, 0.5) - 0.5).abs() < 0.1);
    }
}
