//! The standard surface: metallic-roughness, the base of all other families (glTF 2.0, section 3.9).

use super::kind::{Map, Number, OneOf, Rgb, Rgba, Switch};
use crate::asset::{self, TextureRef};
use glam::{Vec3, Vec4};

crate::choices! {
    /// What the opacity of the base colour does.
    pub enum AlphaMode {
        Opaque = "opaque", "Opacity is ignored.";
        Mask = "mask", "Shown where opacity >= alpha_cutoff.";
        Blend = "blend", "Blended over what lies behind.";
    }
}

const UNBOUNDED: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
const UNIT: (f64, f64) = (0.0, 1.0);

crate::parameters! {
    /// The standard surface.
    pub struct Standard {
        base_color: Vec4 as Rgba = Vec4::ONE, UNIT, "", "Linear albedo (or metal colour) and opacity; times the texture and the vertex colour.";
        base_color_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Base colour and opacity, sRGB-decoded.";
        alpha_mode: AlphaMode as OneOf<AlphaMode> = AlphaMode::Opaque, UNBOUNDED, "", "What opacity does: opaque, mask or blend.";
        alpha_cutoff: f32 as Number = 0.5, UNIT, "", "Least opacity that is shown with alpha_mode = mask.";
        metallic: f32 as Number = 0.0, UNIT, "", "0 dielectric, 1 metal; times B of the metallic-roughness texture.";
        roughness: f32 as Number = 0.5, UNIT, "", "Perceptual roughness, 1 - smoothness; times G of the metallic-roughness texture.";
        metallic_roughness_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: G roughness, B metallic.";
        normal_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: tangent-space normal, OpenGL convention.";
        normal_scale: f32 as Number = 1.0, (-10.0, 10.0), "", "Scale of the normal map's x and y.";
        occlusion_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: R is the share of ambient light that arrives.";
        occlusion_strength: f32 as Number = 1.0, UNIT, "", "How much of the occlusion texture counts.";
        emissive: Vec3 as Rgb = Vec3::ZERO, (0.0, 1e6), "", "Linear radiance that the surface sends out; times the texture.";
        emissive_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Emission, sRGB-decoded.";
        detail_albedo_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Secondary albedo with its own tiling, sRGB-decoded; mid grey (0.5 as stored) changes nothing.";
        detail_normal_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: secondary normal map with its own tiling.";
        detail_normal_scale: f32 as Number = 1.0, (-10.0, 10.0), "", "Scale of the detail normal map's x and y.";
        double_sided: bool as Switch = false, UNBOUNDED, "", "Both faces are drawn, the back one with its normal flipped.";
        unlit: bool as Switch = false, UNBOUNDED, "", "Shows the base colour without light.";
    }
}

impl Standard {
    /// The same without colour, metal, roughness and their textures; its relief, occlusion, opacity and sides stay.
    pub fn undyed(&self) -> Self {
        let Self { base_color, roughness, metallic, .. } = Self::default();
        Self {
            base_color: base_color.with_w(self.base_color.w),
            base_color_texture: None,
            roughness,
            metallic,
            metallic_roughness_texture: None,
            ..self.clone()
        }
    }
}

impl From<&asset::Material> for Standard {
    fn from(material: &asset::Material) -> Self {
        let (alpha_mode, alpha_cutoff) = match material.alpha_mode {
            asset::AlphaMode::Opaque => (AlphaMode::Opaque, 0.5),
            asset::AlphaMode::Mask(cutoff) => (AlphaMode::Mask, cutoff),
            asset::AlphaMode::Blend => (AlphaMode::Blend, 0.5),
        };
        Self {
            base_color: material.base_color,
            base_color_texture: material.base_color_texture,
            alpha_mode,
            alpha_cutoff,
            metallic: material.metallic,
            roughness: material.roughness,
            metallic_roughness_texture: material.metallic_roughness_texture,
            normal_texture: material.normal_texture,
            normal_scale: material.normal_scale,
            occlusion_texture: material.occlusion_texture,
            occlusion_strength: material.occlusion_strength,
            emissive: material.emissive,
            emissive_texture: material.emissive_texture,
            double_sided: material.double_sided,
            unlit: material.unlit,
            ..Self::default()
        }
    }
}
