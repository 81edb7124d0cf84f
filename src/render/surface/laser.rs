//! Laser cloth as its shader reads it.

use super::map::{Map, transform};
use super::{FamilyShader, SurfaceFamily};
use crate::material::{ColorMode, FilmKind, HueCurve, HueDirection, Laser};
use crate::shader::layout::LaserUniforms;
use crate::shader::{Defines, ShaderFile};
use glam::Vec2;

impl SurfaceFamily for Laser {
    type Uniforms = LaserUniforms;
    const BLOCK: &'static str = "LaserBlock";

    fn shader(&self) -> FamilyShader {
        let is_thin_film = self.film == FilmKind::ThinFilm;
        let is_directional = self.directional != HueDirection::Off;
        let is_painted = !is_thin_film;
        let has_ramp = is_painted && self.color_mode == ColorMode::Ramp;
        let has_direction_map = is_painted && self.directional == HueDirection::Map;
        FamilyShader {
            file: ShaderFile::LaserFrag,
            maps: vec![
                Map::data("offset", "HAS_OFFSET_MAP", self.offset_map).when(is_painted),
                Map::color("hue_ramp", "HAS_HUE_RAMP_MAP", self.hue_ramp).when(has_ramp),
                Map::data("direction", "HAS_DIRECTION_MAP", self.direction_map).when(has_direction_map),
                Map::data("film_thickness", "HAS_FILM_THICKNESS_MAP", self.film_thickness_map).when(is_thin_film),
            ],
            constants: vec![
                ("IS_THIN_FILM", is_thin_film.into()),
                ("IS_SINE", (self.curve == HueCurve::Sin).into()),
                ("IS_DIRECTIONAL", is_directional.into()),
                ("CLASSIC", self.classic.into()),
            ],
            defines: Defines::NONE,
            tables: Vec::new(),
            blends: false,
            reads_rest: false,
            is_in_gbuffer: true,
            shadow: None,
        }
    }

    fn uniforms(&self) -> LaserUniforms {
        LaserUniforms {
            saturation: self.saturation,
            brightness: self.brightness,
            hue_span: self.hue_span,
            hue_offset: self.hue_offset,
            direction: Vec2::from_angle(self.color_direction.to_radians()).to_array(),
            film_thickness_nm: self.film_thickness,
            film_thickness_min_nm: self.film_thickness_min,
            film_ior: self.film_ior,
            base_f0: ((self.base_ior - 1.0) / (self.base_ior + 1.0)).powi(2),
            offset_transform: transform(self.offset_map),
            hue_ramp_transform: transform(self.hue_ramp),
            direction_transform: transform(self.direction_map),
            film_thickness_transform: transform(self.film_thickness_map),
            _reserved_0: 0.0,
            _reserved_1: 0.0,
        }
    }
}
