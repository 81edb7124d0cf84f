//! Lighting features that select shader variants, decided once for all draws of a frame.

use crate::asset::Topology;
use crate::material::AlphaMode;
use crate::render::plan::PlanInput;
use crate::render::surface::family_shader;
use crate::scene::Part;

/// Lighting features of a frame.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct LightingFeatures {
    /// Shadow maps.
    pub shadows: bool,
    /// Some of what casts shadows lets light through in part.
    pub translucent_shadows: bool,
    /// Radius of the filter of shadows, texels.
    pub shadow_filter_px: u32,
    /// Screen-space ambient occlusion.
    pub ssao: bool,
}

impl LightingFeatures {
    /// Those of what is drawn, where lights have that many shadow maps.
    pub fn new(input: &PlanInput) -> Self {
        let PlanInput { scene, parts, options, shadow_map_count, .. } = *input;
        let shadows = options.shadows.are_cast && (options.everything || shadow_map_count > 0);
        let is_translucent = |part: &Part| {
            let material = &scene.materials()[part.material];
            let is_solid = scene.asset().meshes[part.mesh].primitives[part.primitive].topology == Topology::Triangles;
            let is_sheer = || material.family.as_ref().is_some_and(|family| family_shader(family).shadow.is_some());
            let blends = material.standard.alpha_mode == AlphaMode::Blend || is_sheer();
            is_solid && (material.fur.is_some() || blends)
        };
        Self {
            shadows,
            translucent_shadows: shadows
                && !options.has_host_shadows
                && (options.everything || parts.iter().any(is_translucent)),
            shadow_filter_px: options.shadows.filter_px,
            ssao: options.has_ssao(),
        }
    }

    /// Something hides light: shaders then have the OCCLUDED bindings.
    pub fn is_occluded(self) -> bool {
        self.shadows || self.ssao
    }

    /// Switches of the shaders, by constant; those that are off are left out.
    pub fn constants(self) -> impl Iterator<Item = (&'static str, u32)> {
        let constants = [
            ("HAS_SHADOWS", self.shadows.into()),
            ("HAS_TRANSLUCENT_SHADOWS", self.translucent_shadows.into()),
            ("SHADOW_FILTER_PX", if self.shadows { self.shadow_filter_px } else { 0 }),
            ("HAS_SCREEN_OCCLUSION", self.ssao.into()),
        ];
        constants.into_iter().filter(|(_, value)| *value != 0)
    }
}
