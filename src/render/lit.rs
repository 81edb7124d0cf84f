//! What the light of a frame takes, decided once for all its draws.

use super::options::FrameOptions;
use crate::scene::Lighting;

/// What the light of a frame takes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Lit {
    /// Shadow maps.
    pub shadows: bool,
    /// Screen-space occlusion.
    pub screen_occlusion: bool,
}

impl Lit {
    /// What `lighting` takes with these options.
    pub fn new(_lighting: &Lighting, _options: &FrameOptions) -> Self {
        Self::default()
    }

    /// Something hides light: shaders then have the OCCLUDED bindings.
    pub fn is_occluded(self) -> bool {
        self.shadows || self.screen_occlusion
    }

    /// Switches of the shaders, by constant; those that are off are left out.
    pub fn constants(self) -> impl Iterator<Item = (&'static str, u32)> {
        let switches = [("HAS_SHADOWS", self.shadows), ("HAS_SCREEN_OCCLUSION", self.screen_occlusion)];
        switches.into_iter().filter(|(_, holds)| *holds).map(|(name, _)| (name, 1))
    }
}
