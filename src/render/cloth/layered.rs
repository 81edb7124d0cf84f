//! Layered as its shader reads it: maps of a lobe that is off are off, too.

use super::ClothShader;
use crate::material::{Layered, Standard};
use crate::render::map::{Map, StandIn};
use crate::render::material::transform;
use crate::shader::layout::LayeredUniforms;

pub fn shader(layered: &Layered, _: &Standard) -> ClothShader {
    let switches = [
        ("ANISOTROPY", layered.has_anisotropy()),
        ("IRIDESCENCE", layered.has_iridescence()),
        ("DIFFUSE_TRANSMISSION", layered.has_diffuse_transmission()),
        ("TRANSMISSION", layered.has_transmission()),
        ("CLEARCOAT", layered.has_clearcoat()),
    ];
    ClothShader {
        file: "layered.frag",
        block: "LayeredBlock",
        uniforms: bytemuck::bytes_of(&uniforms(layered)).to_vec(),
        maps: maps(layered),
        constants: switches.map(|(name, on)| (name, on.into())).to_vec(),
        defines: if layered.has_sheen() { &["SHEEN"] } else { &[] },
        tables: layered.has_sheen().then_some(&super::sheen::TABLE).into_iter().collect(),
        blends: layered.has_transmission(),
        reads_rest: false,
    }
}

fn maps(layered: &Layered) -> Vec<Map> {
    let streak = layered.anisotropy_texture.filter(|_| layered.has_anisotropy());
    let film = |map| Some(layered.has_iridescence()).filter(|on| *on).and(map);
    let scattered = |map| Some(layered.has_diffuse_transmission()).filter(|on| *on).and(map);
    let through = layered.transmission_texture.filter(|_| layered.has_transmission());
    let fuzz = |map| Some(layered.has_sheen()).filter(|on| *on).and(map);
    let coat = |map| Some(layered.has_clearcoat()).filter(|on| *on).and(map);
    vec![
        Map::data("specular", "HAS_SPECULAR_MAP", layered.specular_texture),
        Map::color("specular_color", "HAS_SPECULAR_COLOR_MAP", layered.specular_color_texture),
        Map::data("anisotropy", "HAS_ANISOTROPY_MAP", streak).or(StandIn::NoDirection),
        Map::data("iridescence", "HAS_IRIDESCENCE_MAP", film(layered.iridescence_texture)),
        Map::data(
            "iridescence_thickness",
            "HAS_IRIDESCENCE_THICKNESS_MAP",
            film(layered.iridescence_thickness_texture),
        ),
        Map::data(
            "diffuse_transmission",
            "HAS_DIFFUSE_TRANSMISSION_MAP",
            scattered(layered.diffuse_transmission_texture),
        ),
        Map::color(
            "diffuse_transmission_color",
            "HAS_DIFFUSE_TRANSMISSION_COLOR_MAP",
            scattered(layered.diffuse_transmission_color_texture),
        ),
        Map::data("transmission", "HAS_TRANSMISSION_MAP", through),
        Map::color("sheen_color", "HAS_SHEEN_COLOR_MAP", fuzz(layered.sheen_color_texture)),
        Map::data("sheen_roughness", "HAS_SHEEN_ROUGHNESS_MAP", fuzz(layered.sheen_roughness_texture)),
        Map::data("clearcoat", "HAS_CLEARCOAT_MAP", coat(layered.clearcoat_texture)),
        Map::data("clearcoat_roughness", "HAS_CLEARCOAT_ROUGHNESS_MAP", coat(layered.clearcoat_roughness_texture)),
        Map::data("clearcoat_normal", "HAS_CLEARCOAT_NORMAL_MAP", coat(layered.clearcoat_normal_texture))
            .or(StandIn::FlatNormal),
    ]
}

fn uniforms(layered: &Layered) -> LayeredUniforms {
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
        specular_transform: transform(layered.specular_texture),
        specular_color_transform: transform(layered.specular_color_texture),
        anisotropy_transform: transform(layered.anisotropy_texture),
        iridescence_transform: transform(layered.iridescence_texture),
        iridescence_thickness_transform: transform(layered.iridescence_thickness_texture),
        diffuse_transmission_transform: transform(layered.diffuse_transmission_texture),
        diffuse_transmission_color_transform: transform(layered.diffuse_transmission_color_texture),
        transmission_transform: transform(layered.transmission_texture),
        sheen_color_transform: transform(layered.sheen_color_texture),
        sheen_roughness_transform: transform(layered.sheen_roughness_texture),
        clearcoat_transform: transform(layered.clearcoat_texture),
        clearcoat_roughness_transform: transform(layered.clearcoat_roughness_texture),
        clearcoat_normal_transform: transform(layered.clearcoat_normal_texture),
    }
}
