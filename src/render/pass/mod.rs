//! The passes, one file each, and what they share.

pub mod deform;
pub mod draws;
pub mod guide;
pub mod order;
pub mod screen_occlusion;
pub mod shadow;
pub mod sway;
pub mod tonemap;
pub mod transparency;

use super::Shot;
use super::frame_data::FrameData;
use super::motion::Motion;
use super::options::FrameOptions;
use super::resources::Resources;
use super::shadow::ShadowAtlas;
use crate::scene::Scene;
use transparency::Composition;

/// What the passes that move vertices share.
pub struct Moving<'a> {
    /// What moves.
    pub scene: &'a Scene,
    /// When, and what it takes.
    pub shot: &'a Shot,
    /// What the scene keeps on the device.
    pub resources: &'a Resources,
    /// What they read and write.
    pub motion: &'a Motion,
}

impl<'a> Frame<'a> {
    /// Its part that moves.
    pub fn moving(&self) -> Moving<'a> {
        let Self { scene, shot, resources, motion, .. } = *self;
        Moving { scene, shot, resources, motion }
    }
}

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
    /// Moved vertices.
    pub motion: &'a Motion,
    /// What this frame alone reads.
    pub data: &'a FrameData,
    /// Shadow maps, where lights cast any.
    pub atlas: Option<&'a ShadowAtlas>,
    /// Where what blends goes; `None` where nothing is listed, or fragments are only counted.
    pub composition: Option<&'a Composition<'a>>,
}
