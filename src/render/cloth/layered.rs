//! Layered as its shader reads it: maps of a lobe that is off are off, too.

use super::ClothShader;
use crate::material::Layered;
use crate::render::map::{Map, StandIn};
use crate::render::material::transform;
use crate::shader::layout::LayeredUniforms;

pub fn shader(layered: &Layered) -> ClothShader {
    let switches = [
        ("ANISOTROPY", layered.has_anisotropy()),
        ("IRIDESCENCE", layered.has_iridescence()),
        ("DIFFUSE_TRANSMISSION", layered.has_diffuse_transmission()),
        ("TRANSMISSION", layered.has_transmission()),
        ("VOLUME", layered.has_volume()),
        ("CLEARCOAT", layered.has_clearcoat()),
    ];
    ClothShader {
        file: "layered.frag",
        block: "LayeredBlock",
        maps: maps(layered),
        constants: switches.map(|(name, on)| (name, on.into())).to_vec(),
        defines: if layered.has_sheen() { &["SHEEN"] } else { &[] },
        tables: layered.has_sheen().then_some(&super::sheen::TABLE).into_iter().collect(),
        blends: layered.has_transmission(),
        reads_rest: false,
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
            .or(StandIn::NoDirection),
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
            .or(StandIn::FlatNormal),
    ]
}

pub fn uniforms(layered: &Layered) -> LayeredUniforms {
    let (sine, cosine) = layered.anisotropy_rotation.to_radians().sin_cos();
    LayeredUniforms {
        specular_color: layered.specular_color.to_array(),
        specular: layered.specular,
        sheen_color: layered.sheen_color.to_array(),
        sheen_roughness: layered.sheen_roughness,
        diffuse_transmission_color: layered.diffuse_transmission_color.to_array(),
        diffuse_transmission: layered.diffuse_transmission,
        anisotropy_direction: [cosine, sine],
        anisotropy: layered.anisotropy,
        ior: layered.ior,
        iridescence: layered.iridescence,
        iridescence_ior: layered.iridescence_ior,
        iridescence_thickness_min: layered.iridescence_thickness_min,
        iridescence_thickness_max: layered.iridescence_thickness_max,
        clearcoat: layered.clearcoat,
        clearcoat_roughness: layered.clearcoat_roughness,
        clearcoat_normal_scale: layered.clearcoat_normal_scale,
        transmission: layered.transmission,
        attenuation_color: layered.attenuation_color.to_array(),
        thickness_over_distance: layered.thickness / layered.attenuation_distance,
        specular_transform: transform(layered.specular_texture),
        specular_color_transform: transform(layered.specular_color_texture),
        anisotropy_transform: transform(layered.anisotropy_texture),
        iridescence_transform: transform(layered.iridescence_texture),
        iridescence_thickness_transform: transform(layered.iridescence_thickness_texture),
        diffuse_transmission_transform: transform(layered.diffuse_transmission_texture),
        diffuse_transmission_color_transform: transform(layered.diffuse_transmission_color_texture),
        transmission_transform: transform(layered.transmission_texture),
        thickness_transform: transform(layered.thickness_texture),
        sheen_color_transform: transform(layered.sheen_color_texture),
        sheen_roughness_transform: transform(layered.sheen_roughness_texture),
        clearcoat_transform: transform(layered.clearcoat_texture),
        clearcoat_roughness_transform: transform(layered.clearcoat_roughness_texture),
        clearcoat_normal_transform: transform(layered.clearcoat_normal_texture),
    }
}
