//! What the light of a frame takes, decided once for all its draws.

use super::options::FrameOptions;
use crate::asset::Topology;
use crate::material::{AlphaMode, Cloth};
use crate::scene::{Instance, Scene, ShadowMaps};

/// What the light of a frame takes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Lit {
    /// Shadow maps.
    pub shadows: bool,
    /// Some of what casts shadows lets light through in part.
    pub translucent_shadows: bool,
    /// Radius of the filter of shadows, texels.
    pub shadow_filter_px: u32,
    /// Screen-space occlusion.
    pub screen_occlusion: bool,
}

impl Lit {
    /// What lights with these shadow maps take on `instances`.
    pub fn new(scene: &Scene, instances: &[Instance], maps: &ShadowMaps, options: &FrameOptions) -> Self {
        let shadows = options.shadows.are_cast && (options.everything || !maps.maps.is_empty());
        let is_translucent = |instance: &Instance| {
            let material = &scene.materials()[instance.material];
            let is_solid =
                scene.asset().meshes[instance.mesh].primitives[instance.primitive].topology == Topology::Triangles;
            let blends =
                material.standard.alpha_mode == AlphaMode::Blend || matches!(material.cloth, Some(Cloth::Gauze(_)));
            is_solid && (material.fur.is_some() || blends)
        };
        Self {
            shadows,
            translucent_shadows: shadows && (options.everything || instances.iter().any(is_translucent)),
            shadow_filter_px: options.shadows.filter_px,
            screen_occlusion: options.screen_occlusion.is_some(),
        }
    }

    /// Something hides light: shaders then have the OCCLUDED bindings.
    pub fn is_occluded(self) -> bool {
        self.shadows || self.screen_occlusion
    }

    /// Switches of the shaders, by constant; those that are off are left out.
    pub fn constants(self) -> impl Iterator<Item = (&'static str, u32)> {
        let constants = [
            ("HAS_SHADOWS", self.shadows.into()),
            ("HAS_TRANSLUCENT_SHADOWS", self.translucent_shadows.into()),
            ("SHADOW_FILTER_PX", if self.shadows { self.shadow_filter_px } else { 0 }),
            ("HAS_SCREEN_OCCLUSION", self.screen_occlusion.into()),
        ];
        constants.into_iter().filter(|(_, value)| *value != 0)
    }
}
