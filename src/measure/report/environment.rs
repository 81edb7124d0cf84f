//! How finely an environment is prepared against what that costs once: pictures of balls that show its blurred levels,
//! against quadrature in double precision, and the table of lobes against the lobes.

use super::feature::{Feature, Point, mark_fronts};
use super::metric::{Radiance, picture_error};
use super::statistics::Spread;
use super::{Effort, Progress, ReportError};
use crate::asset::Environment;
use crate::gpu::{Gpu, GpuError};
use crate::measure::twin::environment::{self as twin, LobeEntry};
use crate::render::{EnvironmentQuality, PreparedEnvironment, RenderError, compute_environment, compute_lobes};
use glam::{DVec2, DVec3, DVec4};
use half::f16;
use rayon::prelude::*;
use std::time::Instant;

const FACES_PX: [u32; 4] = [32, 64, 128, 256];
const SAMPLES: [u32; 5] = [4, 16, 64, 256, 1024];
const TABLES_PX: [u32; 4] = [8, 16, 32, 64];
/// Perceptual roughness of each ball.
const BALLS: [f64; 5] = [0.15, 0.3, 0.5, 0.75, 1.0];
/// Side of a ball's picture, pixels.
const BALL_PX: u32 = 32;
/// Cosines and roughness at which the table is asked, between the nodes of every size.
const LOBE_PLACES: [f64; 5] = [0.17, 0.37, 0.55, 0.73, 0.91];

/// The feature's points.
///
/// # Errors
/// When the device fails.
pub fn feature(gpu: &Gpu, effort: &Effort, progress: &mut Progress) -> Result<Feature, ReportError> {
    let studio = Environment::studio();
    let default = EnvironmentQuality::default();
    progress("environment", 0, 3);
    let truth = balls(|direction, roughness| {
        twin::prefiltered(direction, roughness * roughness, |d| studio.radiance(d.as_vec3()).as_dvec3())
    });
    let mut points = Vec::new();
    let faces = FACES_PX.map(|face_px| ("face_px", face_px, EnvironmentQuality { face_px, ..default }));
    let samples = SAMPLES.map(|samples| ("samples", samples, EnvironmentQuality { samples, ..default }));
    progress("environment", 1, 3);
    for (knob, value, quality) in faces.into_iter().chain(samples) {
        let (prepared, ms) = timed(effort, || compute_environment(gpu, &studio, &quality))?;
        let picture = balls(|direction, roughness| radiance(&prepared, direction, roughness));
        let error = picture_error(&picture, &truth, DVec3::ZERO);
        points.push(Point { relmse: error.relmse, flip: Some(error.flip), ..point("studio", (knob, value), ms) });
    }
    progress("environment", 2, 3);
    let places = || LOBE_PLACES.iter().flat_map(|root| LOBE_PLACES.map(|roughness| (root * root, roughness)));
    let lobes: Vec<LobeEntry> = places().map(|(mu, roughness)| twin::ggx_entry(mu, roughness)).collect();
    for table_px in TABLES_PX {
        let quality = EnvironmentQuality { table_px, ..default };
        let (texels, ms) = timed(effort, || compute_lobes(gpu, &quality))?;
        let (mut relmse, mut worst) = (0.0, 0.0f64);
        for ((mu, roughness), lobe) in places().zip(&lobes) {
            let found = entry(&texels, table_px as usize, mu.sqrt(), roughness);
            let off = found - DVec4::new(lobe.mirror, lobe.roughness, lobe.albedo, lobe.fresnel);
            let truth = DVec4::new(lobe.mirror, lobe.roughness, lobe.albedo, lobe.fresnel);
            relmse += (off * off / (truth * truth + 0.01)).element_sum() / (4.0 * lobes.len() as f64);
            worst = worst.max(off.abs().max_element());
        }
        points.push(Point { relmse, max_error: Some(worst), ..point("lobes of GGX", ("table_px", table_px), ms) });
    }
    mark_fronts(&mut points);
    Ok(Feature {
        name: "environment",
        reference: "quadrature in double precision; ms to prepare the studio, or the table, once, without the cache"
            .to_owned(),
        reference_noise: 0.0,
        points,
        notes: vec![format!(
            "a frame costs the same with every setting; the studio has {} x {} texels, which faces above {} px do not show",
            studio.size[0],
            studio.size[1],
            studio.size[0] / 4
        )],
    })
}

fn point(camera: &'static str, knob: (&'static str, u32), ms: Spread) -> Point {
    Point::new("prefiltered (default)", knob, camera, ms)
}

/// What is made, and the milliseconds of making it; the first time warms up.
fn timed<T>(effort: &Effort, make: impl Fn() -> Result<T, GpuError>) -> Result<(T, Spread), ReportError> {
    let mut made = make().map_err(RenderError::from)?;
    let mut times = Vec::new();
    for _ in 0..effort.rounds.min(3) {
        let start = Instant::now();
        made = make().map_err(RenderError::from)?;
        times.push(start.elapsed().as_secs_f64() * 1e3);
    }
    Ok((made, Spread::of(&times)))
}

/// Balls beside each other, seen by parallel rays, each of the radiance about the mirrored ray.
fn balls(radiance: impl Fn(DVec3, f64) -> DVec3 + Sync) -> Radiance {
    let size = [BALL_PX * BALLS.len() as u32, BALL_PX];
    let pixel = |index: u32| {
        let (x, y) = (index % size[0], index / size[0]);
        let place = (DVec2::new(f64::from(x % BALL_PX), f64::from(y)) + 0.5) * (2.0 / f64::from(BALL_PX)) - 1.0;
        let squared = place.length_squared();
        if squared >= 1.0 {
            return DVec4::ZERO;
        }
        let normal = DVec3::new(place.x, -place.y, (1.0 - squared).sqrt());
        radiance(2.0 * normal.z * normal - DVec3::Z, BALLS[(x / BALL_PX) as usize]).extend(1.0)
    };
    Radiance { size, pixels: (0..size[0] * size[1]).into_par_iter().map(pixel).collect() }
}

/// As a texture unit reads the cube, but for the edges of faces, beyond which it reads no further.
fn radiance(prepared: &PreparedEnvironment, direction: DVec3, roughness: f64) -> DVec3 {
    let level = twin::level(roughness, f64::from(prepared.last_level())).min(f64::from(prepared.last_level()));
    let (face, place) = twin::face_place(direction);
    let at = |level: usize| {
        let side = prepared.face_px as usize >> level;
        let texel = ((place * 0.5 + 0.5) * side as f64 - 0.5).clamp(DVec2::ZERO, DVec2::splat((side - 1) as f64));
        bilinear(&prepared.levels[level][face * side * side * 8..], side, [side, side], texel).truncate()
    };
    let first = (level as usize).min(prepared.levels.len().saturating_sub(2));
    let second = (first + 1).min(prepared.levels.len() - 1);
    at(first).lerp(at(second), level - first as f64) * prepared.scale.as_dvec3()
}

/// An entry of GGX between nodes.
fn entry(texels: &[u8], nodes: usize, root: f64, roughness: f64) -> DVec4 {
    bilinear(texels, nodes, [nodes, nodes], DVec2::new(root, roughness) * (nodes - 1) as f64)
}

/// Between texels of half floats; `at` counts in texels from the middle of the first.
fn bilinear(texels: &[u8], columns: usize, [width, height]: [usize; 2], at: DVec2) -> DVec4 {
    let first = [(at.x as usize).min(width.saturating_sub(2)), (at.y as usize).min(height.saturating_sub(2))];
    let part = at - DVec2::new(first[0] as f64, first[1] as f64);
    let texel = |dx: usize, dy: usize| {
        let (x, y) = ((first[0] + dx).min(width - 1), (first[1] + dy).min(height - 1));
        let start = (y * columns + x) * 8;
        DVec4::from_array(std::array::from_fn(|i| {
            f16::from_le_bytes([texels[start + 2 * i], texels[start + 2 * i + 1]]).to_f64()
        }))
    };
    texel(0, 0).lerp(texel(1, 0), part.x).lerp(texel(0, 1).lerp(texel(1, 1), part.x), part.y)
}
