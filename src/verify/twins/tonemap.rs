//! Judges `tonemap.glsl`.

use super::super::domain::Domain;
use super::super::twin::Twin;
use crate::material::reference::tonemap;
use glam::DVec3;

/// A channel of scene-referred radiance, at the joints of the curves, and beyond what a target holds.
const RADIANCE: Domain =
    Domain::Log(1e-6, 1e6, &[-1e30, -1.0, 0.0, 1e-40, 1e-10, 0.08, 0.76, 1.0, 65504.0, 1e30, f32::MAX]);

pub(super) const TWINS: &[Twin] = &[
    Twin::new("tonemap_limited", &[RADIANCE], |given| {
        given.vec3().clamp(DVec3::ZERO, DVec3::splat(tonemap::LARGEST_INPUT)).to_array().to_vec()
    }),
    Twin::new("tonemap_none", &[RADIANCE], |given| tonemap::none(given.vec3()).to_array().to_vec()),
    Twin::new("tonemap_aces", &[RADIANCE], |given| tonemap::aces(given.vec3()).to_array().to_vec()),
    Twin::new("tonemap_agx", &[RADIANCE], |given| tonemap::agx(given.vec3()).to_array().to_vec())
        .limit(2e-5, AGX_ROUNDING),
    Twin::new("tonemap_neutral", &[RADIANCE], |given| tonemap::neutral(given.vec3()).to_array().to_vec()),
];

/// The sigmoid's coefficients have magnitudes of 95 together, each rounded by half a unit of 2^-23 in its running sum;
/// the outset adds up 1.4 of it and the power of 2.2 stretches it by as much.
const AGX_ROUNDING: f64 = 95.0 * super::ULP / 2.0 * 1.4 * 2.2;
