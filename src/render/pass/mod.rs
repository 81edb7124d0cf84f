//! The passes, one file each, and what they share.

pub mod deform;
pub mod draws;
pub mod tonemap;

use super::Shot;
use super::frame_data::FrameData;
use super::options::FrameOptions;
use super::resources::Resources;
use crate::scene::Scene;

/// What the passes of one frame share.
pub struct Frame<'a> {
    /// What is shown.
    pub scene: &'a Scene,
    /// When and through whose eye, and what it takes.
    pub shot: &'a Shot,
    /// How.
    pub options: &'a FrameOptions,
    /// What the scene keeps on the device.
    pub resources: &'a Resources,
    /// What this frame alone reads.
    pub data: &'a FrameData,
}
