//! Layered as its shader reads it: maps of a lobe that is off are off, too.

use super::map::{Fallback, Map, transform};
use super::{FamilyShader, SurfaceFamily};
use crate::material::Layered;
use crate::shader::layout::LayeredUniforms;
use crate::shader::{Defines, ShaderFile};

impl SurfaceFamily for Layered {
    type Uniforms = LayeredUniforms;
    const BLOCK: &'static str = "LayeredBlock";

    fn shader(&self) -> FamilyShader {
        let switches = [
            ("ANISOTROPY", self.has_anisotropy()),
            ("IRIDESCENCE", self.has_iridescence()),
            ("DIFFUSE_TRANSMISSION", self.has_diffuse_transmission()),
            ("TRANSMISSION", self.has_transmission()),
            ("VOLUME", self.has_volume()),
            ("CLEARCOAT", self.has_clearcoat()),
        ];
        FamilyShader {
            file: ShaderFile::LayeredFrag,
            maps: maps(self),
            constants: switches.map(|(name, on)| (name, on.into())).to_vec(),
            defines: Defines::NONE.with(Defines::SHEEN, self.has_sheen()),
            tables: self.has_sheen().then_some(&super::sheen::TABLE).into_iter().collect(),
            blends: self.has_transmission(),
            reads_rest: false,
            is_in_gbuffer: true,
            shadow: None,
        }
    }

    fn uniforms(&self) -> LayeredUniforms {
        let (sine, cosine) = self.anisotropy_rotation.to_radians().sin_cos();
        LayeredUniforms {
            specular_color: self.specular_color.to_array(),
            specular: self.specular,
            sheen_color: self.sheen_color.to_array(),
            sheen_roughness: self.sheen_roughness,
            diffuse_transmission_color: self.diffuse_transmission_color.to_array(),
            diffuse_transmission: self.diffuse_transmission,
            anisotropy_direction: [cosine, sine],
            anisotropy: self.anisotropy,
            ior: self.ior,
            iridescence: self.iridescence,
            iridescence_ior: self.iridescence_ior,
            iridescence_thickness_min: self.iridescence_thickness_min,
            iridescence_thickness_max: self.iridescence_thickness_max,
            clearcoat: self.clearcoat,
            clearcoat_roughness: self.clearcoat_roughness,
            clearcoat_normal_scale: self.clearcoat_normal_scale,
            transmission: self.transmission,
            attenuation_color: self.attenuation_color.to_array(),
            thickness_over_distance: self.thickness / self.attenuation_distance,
            specular_transform: transform(self.specular_texture),
            specular_color_transform: transform(self.specular_color_texture),
            anisotropy_transform: transform(self.anisotropy_texture),
            iridescence_transform: transform(self.iridescence_texture),
            iridescence_thickness_transform: transform(self.iridescence_thickness_texture),
            diffuse_transmission_transform: transform(self.diffuse_transmission_texture),
            diffuse_transmission_color_transform: transform(self.diffuse_transmission_color_texture),
            transmission_transform: transform(self.transmission_texture),
            thickness_transform: transform(self.thickness_texture),
            sheen_color_transform: transform(self.sheen_color_texture),
            sheen_roughness_transform: transform(self.sheen_roughness_texture),
            clearcoat_transform: transform(self.clearcoat_texture),
            clearcoat_roughness_transform: transform(self.clearcoat_roughness_texture),
            clearcoat_normal_transform: transform(self.clearcoat_normal_texture),
        }
    }
}

fn maps(layered: &Layered) -> Vec<Map> {
    let has_film = layered.has_iridescence();
    let has_scattering = layered.has_diffuse_transmission();
    let has_fuzz = layered.has_sheen();
    let has_coat = layered.has_clearcoat();
    vec![
        Map::data("specular", "HAS_SPECULAR_MAP", layered.specular_texture),
        Map::color("specular_color", "HAS_SPECULAR_COLOR_MAP", layered.specular_color_texture),
        Map::data("anisotropy", "HAS_ANISOTROPY_MAP", layered.anisotropy_texture)
            .when(layered.has_anisotropy())
            .or(Fallback::NoDirection),
        Map::data("iridescence", "HAS_IRIDESCENCE_MAP", layered.iridescence_texture).when(has_film),
        Map::data("iridescence_thickness", "HAS_IRIDESCENCE_THICKNESS_MAP", layered.iridescence_thickness_texture)
            .when(has_film),
        Map::data("diffuse_transmission", "HAS_DIFFUSE_TRANSMISSION_MAP", layered.diffuse_transmission_texture)
            .when(has_scattering),
        Map::color(
            "diffuse_transmission_color",
            "HAS_DIFFUSE_TRANSMISSION_COLOR_MAP",
            layered.diffuse_transmission_color_texture,
        )
        .when(has_scattering),
        Map::data("transmission", "HAS_TRANSMISSION_MAP", layered.transmission_texture)
            .when(layered.has_transmission()),
        Map::data("thickness", "HAS_THICKNESS_MAP", layered.thickness_texture).when(layered.has_volume()),
        Map::color("sheen_color", "HAS_SHEEN_COLOR_MAP", layered.sheen_color_texture).when(has_fuzz),
        Map::data("sheen_roughness", "HAS_SHEEN_ROUGHNESS_MAP", layered.sheen_roughness_texture).when(has_fuzz),
        Map::data("clearcoat", "HAS_CLEARCOAT_MAP", layered.clearcoat_texture).when(has_coat),
        Map::data("clearcoat_roughness", "HAS_CLEARCOAT_ROUGHNESS_MAP", layered.clearcoat_roughness_texture)
            .when(has_coat),
        Map::data("clearcoat_normal", "HAS_CLEARCOAT_NORMAL_MAP", layered.clearcoat_normal_texture)
            .when(has_coat)
            .or(Fallback::FlatNormal),
    ]
}
