//! What each family of material costs beside the standard surface: the same pixels, shaded by each in turn.

use super::{ProfileError, Spread, WARM_UP_FRAMES, end};
use crate::gpu::{DeviceInfo, GpuOptions};
use crate::material::Family;
use crate::render::{FrameOptions, FrameReport, Renderer};
use crate::scene::Scene;

/// The passes that shade surfaces.
const SURFACE_PASSES: [&str; 2] = ["opaque", "transparent"];

/// One family's cost.
#[derive(Debug, Clone, PartialEq)]
pub struct FamilyCost {
    /// What files call it.
    pub kind: &'static str,
    /// Opaque and transparent pass together on the device, ms.
    pub surface_ms: Spread,
    /// Over that of the standard surface in the same round.
    pub to_standard: Spread,
}

/// The costs of all families in one run.
#[derive(Debug, Clone)]
pub struct FamilyProfile {
    /// The device.
    pub device: DeviceInfo,
    /// One entry a family, the standard surface first; empty on devices without timestamps.
    pub families: Vec<FamilyCost>,
    /// What the validation layer said, to the end of the device.
    pub validation_messages: Vec<String>,
}

impl FamilyProfile {
    /// The families that are measured, the standard surface first. Fur is none: it draws other pixels.
    pub fn kinds() -> impl Iterator<Item = &'static str> {
        std::iter::once("standard").chain(Family::KINDS.iter().copied())
    }

    /// Measures `rounds` rounds (at least 1) after warm-up. A round draws each scene once, so that what slows the machine
    /// for a while slows all families alike. The scenes differ in nothing but the family, and are in the order of
    /// [`FamilyProfile::kinds`].
    ///
    /// # Errors
    /// Those of rendering.
    pub fn measure(
        device: &GpuOptions,
        scenes: &[Scene],
        options: &FrameOptions,
        rounds: u32,
    ) -> Result<Self, ProfileError> {
        let mut renderer = Renderer::new(device)?;
        for _ in 0..=WARM_UP_FRAMES {
            for scene in scenes {
                renderer.render_reported(scene, options, false)?;
            }
        }
        let mut times = vec![Vec::new(); scenes.len()];
        for _ in 0..rounds.max(1) {
            for (times, scene) in times.iter_mut().zip(scenes) {
                let (_, report) = renderer.render_reported(scene, options, false)?;
                times.extend(surface_ms(&report));
            }
        }
        let info = renderer.gpu().info().clone();
        let mut validation_messages = Vec::new();
        end(renderer, &mut validation_messages);
        let standard = times.first().cloned().unwrap_or_default();
        let cost = |(kind, times): (_, &Vec<f64>)| {
            let ratios: Vec<f64> =
                times.iter().zip(&standard).map(|(time, standard)| time / standard.max(1e-9)).collect();
            Some(FamilyCost { kind, surface_ms: Spread::of(times)?, to_standard: Spread::of(&ratios)? })
        };
        let families = Self::kinds().zip(&times).filter_map(cost).collect();
        Ok(Self { device: info, families, validation_messages })
    }
}

/// `None` without timestamps.
fn surface_ms(report: &FrameReport) -> Option<f64> {
    let passes = report.passes.iter().filter(|pass| SURFACE_PASSES.contains(&pass.name.as_str()));
    passes.map(|pass| pass.gpu_ms).sum()
}
