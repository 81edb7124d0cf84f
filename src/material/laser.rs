//! Laser cloth: a film whose colour follows the angle of view.

use super::kind::{Map, Number, OneOf, Switch};
use crate::asset::TextureRef;

crate::choices! {
    /// Where the colours of the film come from.
    pub enum ColorMode {
        Wheel = "wheel", "The wheel of hues.";
        Ramp = "ramp", "The painted colours of hue_ramp.";
    }
}

crate::choices! {
    /// What drives the colour from facing to grazing.
    pub enum HueCurve {
        OneMinusCos = "one_minus_cos", "1 - cosine of the view angle: most of the change is at the outline.";
        Sin = "sin", "The sine of the view angle: spreads the colours evenly across a ball.";
    }
}

crate::choices! {
    /// Whether the colour follows all of the view angle.
    pub enum HueDirection {
        Off = "off", "All of the view angle counts.";
        Value = "value", "Only the part of it along color_direction counts.";
        Map = "map", "Only the part of it along the direction of direction_map counts.";
    }
}

crate::choices! {
    /// What the film is.
    pub enum FilmKind {
        None = "none", "Paint: the colours of color_mode.";
        ThinFilm = "thin_film", "A clear film that interferes with itself; what says hue, saturation, brightness and direction does not count.";
    }
}

const UNBOUNDED: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
const UNIT: (f64, f64) = (0.0, 1.0);
/// Thicker films show no colour.
const THICKNESS: (f64, f64) = (0.0, 2000.0);

crate::parameters! {
    /// Laser cloth.
    pub struct Laser {
        saturation: f32 as Number = 0.7, UNIT, "", "Strength of the colours; 0 is the plain cloth.";
        brightness: f32 as Number = 1.0, UNIT, "", "Brightness of the colours; 0 is black.";
        hue_span: f32 as Number = 1.0, (0.2, 5.0), "", "Turns of the wheel of hues from facing to grazing.";
        hue_offset: f32 as Number = 0.0, UNIT, "", "Hue where the cloth faces the eye: 0 red, 1/3 green, 2/3 blue, 1 red again; turns the hues of a ramp.";
        offset_map: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: R and G are added to hue_offset, one film layer each, and the layers' colours averaged; draws patterns in the film.";
        color_mode: ColorMode as OneOf<ColorMode> = ColorMode::Wheel, UNBOUNDED, "", "Where the colours come from: wheel or ramp.";
        hue_ramp: Option<TextureRef> as Map = None, UNBOUNDED, "", "Painted colours, left facing, right grazing, sRGB-decoded; for color_mode = ramp, which is a wheel without.";
        curve: HueCurve as OneOf<HueCurve> = HueCurve::OneMinusCos, UNBOUNDED, "", "What drives the colour: one_minus_cos or sin.";
        directional: HueDirection as OneOf<HueDirection> = HueDirection::Off, UNBOUNDED, "", "Colour follows all of the view angle (off), or its part along one direction: value or map.";
        color_direction: f32 as Number = 0.0, (0.0, 180.0), "deg", "That direction in the cloth, from the tangent towards the bitangent.";
        direction_map: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: R from 0 to 1 is that direction from 0 to 180 degrees, for directional = map, which is color_direction without.";
        film: FilmKind as OneOf<FilmKind> = FilmKind::None, UNBOUNDED, "", "none: painted colours; thin_film: a clear film like oil, soap or anodised metal.";
        film_thickness: f32 as Number = 450.0, THICKNESS, "nm", "Thickness of the film, the largest where film_thickness_map says less.";
        film_thickness_min: f32 as Number = 100.0, THICKNESS, "nm", "Thickness where film_thickness_map is 0.";
        film_thickness_map: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: G from 0 to 1 is the thickness from film_thickness_min to film_thickness.";
        film_ior: f32 as Number = 2.0, (1.0, 3.0), "", "Refractive index of the film: the more it differs from the base's, the stronger the colours.";
        base_ior: f32 as Number = 1.5, (1.0, 3.0), "", "Refractive index of the cloth under the film; metals have their own, of their colour: greys around 0.5 show the strongest film.";
        classic: bool as Switch = false, UNBOUNDED, "", "The formula of older engines: hues that a pixel cannot hold stay and sparkle.";
    }
}
