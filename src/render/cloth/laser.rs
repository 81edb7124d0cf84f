//! Laser cloth as its shader reads it.

use super::ClothShader;
use crate::material::{ColorMode, FilmKind, HueCurve, HueDirection, Laser};
use crate::render::map::Map;
use crate::render::material::transform;
use crate::shader::layout::LaserUniforms;
use glam::Vec2;

pub fn shader(laser: &Laser) -> ClothShader {
    let is_thin_film = laser.film == FilmKind::ThinFilm;
    let is_directional = laser.directional != HueDirection::Off;
    let is_painted = !is_thin_film;
    let has_ramp = is_painted && laser.color_mode == ColorMode::Ramp;
    let has_direction_map = is_painted && laser.directional == HueDirection::Map;
    ClothShader {
        file: "laser.frag",
        block: "LaserBlock",
        maps: vec![
            Map::data("offset", "HAS_OFFSET_MAP", laser.offset_map).when(is_painted),
            Map::color("hue_ramp", "HAS_HUE_RAMP_MAP", laser.hue_ramp).when(has_ramp),
            Map::data("direction", "HAS_DIRECTION_MAP", laser.direction_map).when(has_direction_map),
            Map::data("film_thickness", "HAS_FILM_THICKNESS_MAP", laser.film_thickness_map).when(is_thin_film),
        ],
        constants: vec![
            ("IS_THIN_FILM", is_thin_film.into()),
            ("IS_SINE", (laser.curve == HueCurve::Sin).into()),
            ("IS_DIRECTIONAL", is_directional.into()),
            ("CLASSIC", laser.classic.into()),
        ],
        defines: &[],
        tables: Vec::new(),
        blends: false,
        reads_rest: false,
    }
}

pub fn uniforms(laser: &Laser) -> LaserUniforms {
    LaserUniforms {
        saturation: laser.saturation,
        brightness: laser.brightness,
        hue_span: laser.hue_span,
        hue_offset: laser.hue_offset,
        direction: Vec2::from_angle(laser.color_direction.to_radians()).to_array(),
        film_thickness_nm: laser.film_thickness,
        film_thickness_min_nm: laser.film_thickness_min,
        film_ior: laser.film_ior,
        base_f0: ((laser.base_ior - 1.0) / (laser.base_ior + 1.0)).powi(2),
        offset_transform: transform(laser.offset_map),
        hue_ramp_transform: transform(laser.hue_ramp),
        direction_transform: transform(laser.direction_map),
        film_thickness_transform: transform(laser.film_thickness_map),
        ..Default::default()
    }
}
