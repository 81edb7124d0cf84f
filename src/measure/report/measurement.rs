//! The measuring: references, one picture of every point for its error, then rounds over all points for their times.

use super::case::{Cases, Stage, View};
use super::metric::{self, PictureError, Radiance, change_error, picture_error};
use super::sweep::SweepPoint;
use super::{Effort, Progress, ReportError};
use crate::gpu::Gpu;
use crate::measure::oracle::{self, OracleOptions};
use crate::render::{FrameReport, FrameSetup, Pass, Renderer};
use glam::DVec3;
use std::collections::HashMap;
use std::time::Instant;

/// Rounds below which a median says nothing, whatever the time limit.
const LEAST_ROUNDS: usize = 3;

/// Times of one frame, milliseconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameMs {
    /// Opaque, fur and transparent passes by the device's timestamps; `None` without them.
    pub passes: Option<f64>,
    /// The fur's own passes: fur and transparent.
    pub fur: Option<f64>,
    /// The whole frame by the wall clock.
    pub wall: f64,
}

impl FrameMs {
    fn new(report: &FrameReport) -> Self {
        let fur = [Pass::Fur, Pass::OitBuild];
        Self { fur: sum(report, &fur), ..Self::of(report, &[Pass::Opaque, fur[0], fur[1]]) }
    }

    /// With these passes, and no fur.
    pub fn of(report: &FrameReport, passes: &[Pass]) -> Self {
        Self { passes: sum(report, passes), fur: None, wall: report.frame_ms }
    }
}

/// Milliseconds of passes by the device's timestamps.
fn sum(report: &FrameReport, wanted: &[Pass]) -> Option<f64> {
    let passes = report.passes.iter().filter(|pass| wanted.iter().any(|wanted| wanted.name() == pass.name));
    passes.map(|pass| pass.gpu_ms).sum()
}

/// What was measured of a point of a sweep.
#[derive(Debug, Clone, Default)]
pub struct Measurement {
    /// Against the view's reference; `None` for a view without.
    pub error: Option<PictureError>,
    /// One of every round.
    pub frames: Vec<FrameMs>,
}

/// Truth of a view.
struct Reference {
    frames: Vec<Radiance>,
    /// relMSE that its own noise is worth.
    noise: f64,
    background: DVec3,
}

/// Everything measured.
pub struct Measurements {
    /// By point.
    pub by_point: HashMap<SweepPoint, Measurement>,
    /// relMSE of each reference's noise.
    pub noise: HashMap<View, f64>,
    /// Rounds of timing.
    pub rounds: usize,
}

/// Measures points of sweeps; each once, however often it is listed.
pub fn measure(
    gpu: &Gpu,
    cases: &Cases,
    points: &[SweepPoint],
    effort: &Effort,
    progress: &mut Progress,
) -> Result<Measurements, ReportError> {
    let mut unique: Vec<SweepPoint> = Vec::new();
    for point in points {
        if !unique.contains(point) {
            unique.push(*point);
        }
    }
    let references = references(cases, &unique, effort, progress)?;

    // A renderer keeps one scene on the device: one for each, or every frame of a round would upload it anew.
    let mut renderers = HashMap::new();
    let mut by_point = HashMap::new();
    for (done, point) in unique.iter().enumerate() {
        progress("errors", done, unique.len());
        let renderer = renderer_of(&mut renderers, gpu, point.view.stage())?;
        let error = error_of(renderer, cases, point, references.get(&point.view), effort)?;
        by_point.insert(*point, Measurement { error, frames: Vec::new() });
    }

    let start = Instant::now();
    let mut rounds = 0;
    while rounds < effort.rounds {
        let is_late = effort.time_limit.is_some_and(|limit| start.elapsed() > limit);
        if rounds >= LEAST_ROUNDS && is_late {
            break;
        }
        // There and back: a drift that is even in time falls on all points alike.
        let order: Vec<&SweepPoint> =
            if rounds % 2 == 0 { unique.iter().collect() } else { unique.iter().rev().collect() };
        for (done, point) in order.into_iter().enumerate() {
            progress("times", rounds * unique.len() + done, effort.rounds * unique.len());
            let renderer = renderer_of(&mut renderers, gpu, point.view.stage())?;
            let options = &point.frames(cases, effort)[0];
            let (_, report) = renderer.render_reported(cases.scene(point.view.stage()), options, false)?;
            by_point.entry(*point).or_default().frames.push(FrameMs::new(&report));
        }
        rounds += 1;
    }
    let noise = references.iter().map(|(view, reference)| (*view, reference.noise)).collect();
    Ok(Measurements { by_point, noise, rounds })
}

fn renderer_of<'a>(
    renderers: &'a mut HashMap<Stage, Renderer>,
    gpu: &Gpu,
    stage: Stage,
) -> Result<&'a mut Renderer, ReportError> {
    Ok(match renderers.entry(stage) {
        std::collections::hash_map::Entry::Occupied(entry) => entry.into_mut(),
        std::collections::hash_map::Entry::Vacant(entry) => entry.insert(Renderer::with_gpu(gpu.clone())),
    })
}

fn references(
    cases: &Cases,
    points: &[SweepPoint],
    effort: &Effort,
    progress: &mut Progress,
) -> Result<HashMap<View, Reference>, ReportError> {
    let mut references = HashMap::new();
    let asked: Vec<&SweepPoint> =
        View::ALL.iter().filter_map(|view| points.iter().find(|point| point.view == *view)).collect();
    for (done, point) in asked.iter().enumerate() {
        progress("references", done, asked.len());
        let scene = cases.scene(point.view.stage());
        let (mut frames, mut noise, mut background) = (Vec::new(), 0.0, DVec3::ZERO);
        for (index, options) in point.frames(cases, effort).iter().enumerate() {
            let shot = FrameSetup::new(scene, options)?;
            let (size, samples) = (options.size, effort.reference_samples);
            // Frames of one view are independent: what they share would hide in the change between them.
            let oracle_options = OracleOptions { size, samples, seed: index as u32 };
            let scene_index = scene.asset().default_scene;
            let picture = oracle::render(
                scene,
                scene_index,
                &shot.pose,
                &shot.camera,
                &shot.lighting(options),
                None,
                &oracle_options,
            )?;
            background = options.environment.constant_radiance().unwrap_or_default().as_dvec3();
            let frame = Radiance { size, pixels: picture.radiance };
            // The noise of a difference is that of both.
            noise += metric::noise(&frame, &picture.variance);
            frames.push(frame);
        }
        references.insert(point.view, Reference { frames, noise, background });
    }
    Ok(references)
}

fn error_of(
    renderer: &mut Renderer,
    cases: &Cases,
    point: &SweepPoint,
    reference: Option<&Reference>,
    effort: &Effort,
) -> Result<Option<PictureError>, ReportError> {
    let mut frames = Vec::new();
    for options in point.frames(cases, effort) {
        let (picture, _) = renderer.render_reported(cases.scene(point.view.stage()), &options, true)?;
        frames.push(Radiance::of(&picture));
    }
    let Some(reference) = reference else { return Ok(None) };
    Ok(match (&frames[..], &reference.frames[..]) {
        ([frame], [truth]) => Some(picture_error(frame, truth, reference.background)),
        ([first, second], [truth, next]) => Some(change_error([first, second], [truth, next], reference.background)),
        _ => None,
    })
}
