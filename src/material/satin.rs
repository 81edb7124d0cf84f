//! Satin: silk, charmeuse, taffeta, brocade. Long threads mirror light into a streak across their run.

use super::kind::{Map, Number, Rgb, Switch};
use crate::asset::TextureRef;
use glam::Vec3;

const UNBOUNDED: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
const UNIT: (f64, f64) = (0.0, 1.0);

crate::parameters! {
    /// Satin.
    pub struct Satin {
        anisotropy: f32 as Number = 0.6, (-1.0, 1.0), "", "Length and direction of the highlight: stretched along u of the texture at 1, round at 0, across it at -1.";
        specular_strength: f32 as Number = 7.0, (0.0, 30.0), "", "Strength of the highlight: 1 is plain plastic, 7 to 20 silk, 25 and more metal thread; 0 none.";
        specular_color: Vec3 as Rgb = Vec3::ONE, UNIT, "", "Linear colour of the narrow, bright highlight; black switches it off.";
        secondary_color: Vec3 as Rgb = Vec3::splat(0.5), UNIT, "", "Linear colour of the wide, dim highlight; black switches it off.";
        secondary_width: f32 as Number = 1.5, (1.0, 10.0), "", "Roughness of the wide highlight, in that of the narrow one.";
        two_way: bool as Switch = false, UNBOUNDED, "", "Cross weaves: half of the highlight is stretched the other way, as warp and weft both shine.";
        light_tint: f32 as Number = 0.5, UNIT, "", "How much of the light's own colour stays in the highlight; 0: as coloured as specular_color says.";
        specular_noise: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: R is the local strength of the highlight, 0 = half of it, 1 = all of it.";
        classic: bool as Switch = false, UNBOUNDED, "", "Evaluates the formula of older engines, which is not normalised, so that a look can be carried over.";
    }
}
