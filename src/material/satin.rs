//! Satin: silk, charmeuse, taffeta.

use super::kind::{Map, Number};
use crate::asset::TextureRef;

crate::parameters! {
    /// Satin.
    pub struct Satin {
        anisotropy: f32 as Number = 0.8, (-1.0, 1.0), "", "Direction and length of the highlight: across the threads at 1, along them at -1.";
        specular_noise: Option<TextureRef> as Map = None, (f64::NEG_INFINITY, f64::INFINITY), "", "Data: R is the local strength of the highlight, from half to all of it.";
    }
}
