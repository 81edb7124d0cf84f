//! Laser cloth as its shader reads it.

use super::ClothShader;
use crate::material::{ColorMode, FilmKind, HueCurve, HueDirection, Laser, Standard};
use crate::render::map::Map;
use crate::render::material::transform;
use crate::shader::layout::LaserUniforms;
use glam::Vec2;

pub fn shader(laser: &Laser, _: &Standard) -> ClothShader {
    let is_thin_film = laser.film == FilmKind::ThinFilm;
    let is_directional = laser.directional != HueDirection::Off;
    // A map of a part that is off is neither bound nor fetched.
    let used = |is_used: bool, map| if is_used { map } else { None };
    let offset = used(!is_thin_film, laser.offset_map);
    let hue_ramp = used(!is_thin_film && laser.color_mode == ColorMode::Ramp, laser.hue_ramp);
    let direction = used(!is_thin_film && laser.directional == HueDirection::Map, laser.direction_map);
    let film_thickness = used(is_thin_film, laser.film_thickness_map);
    let uniforms = LaserUniforms {
        saturation: laser.saturation,
        brightness: laser.brightness,
        hue_span: laser.hue_span,
        hue_offset: laser.hue_offset,
        direction: Vec2::from_angle(laser.color_direction.to_radians()).to_array(),
        film_thickness_nm: laser.film_thickness,
        film_thickness_min_nm: laser.film_thickness_min,
        film_ior: laser.film_ior,
        base_f0: ((laser.base_ior - 1.0) / (laser.base_ior + 1.0)).powi(2),
        offset_transform: transform(offset),
        hue_ramp_transform: transform(hue_ramp),
        direction_transform: transform(direction),
        film_thickness_transform: transform(film_thickness),
        ..Default::default()
    };
    ClothShader {
        file: "laser.frag",
        block: "LaserBlock",
        uniforms: bytemuck::bytes_of(&uniforms).to_vec(),
        maps: vec![
            Map::data("offset", "HAS_OFFSET_MAP", offset),
            Map::color("hue_ramp", "HAS_HUE_RAMP_MAP", hue_ramp),
            Map::data("direction", "HAS_DIRECTION_MAP", direction),
            Map::data("film_thickness", "HAS_FILM_THICKNESS_MAP", film_thickness),
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
