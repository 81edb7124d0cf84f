//! The kinds of parameters: how each reads a value of a file, shows it, and is brought into its range.

use super::nearest::nearest;
use super::parameter::{Parameter, ParameterError};
use super::texture::{self, ImageName};
use super::value::Value;
use crate::asset::TextureRef;
use crate::math::linear_from_srgb_byte;
use glam::{Vec2, Vec3, Vec4};
use std::marker::PhantomData;

/// Where textures come from while parameters are read.
pub trait TextureSource {
    /// Index into [`Asset::textures`](crate::asset::Asset::textures) of a texture that shows that image.
    ///
    /// # Errors
    /// One line: why the image cannot be had.
    fn texture(&mut self, image: &ImageName) -> Result<usize, String>;
}

/// What a file writes for a value, as far as a schema can tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// A number.
    Number,
    /// A whole number.
    Count,
    /// true or false.
    Switch,
    /// A list of that many numbers.
    Vector(usize),
    /// A list of three numbers, or "#rrggbb".
    Rgb,
    /// A list of three or four numbers, or "#rrggbb", or "#rrggbbaa".
    Rgba,
    /// A number, or text that ends with %.
    Distance,
    /// A file name, or a table.
    Map,
    /// One of [`Kind::CHOICES`].
    Choice,
}

/// How the values of one kind of parameter are read, shown and limited.
pub trait Kind {
    /// What the struct holds.
    type Stored;
    /// How a file writes it.
    const SYNTAX: &'static str;
    /// The same for programs.
    const FORM: Form;
    /// Names to choose from, if it is a choice.
    const CHOICES: &'static [&'static str] = &[];

    /// Reads a value of a file.
    ///
    /// # Errors
    /// A value of the wrong type or outside the range of `parameter`; a texture that cannot be had.
    fn read(
        value: &Value,
        parameter: &Parameter,
        textures: &mut dyn TextureSource,
    ) -> Result<Self::Stored, ParameterError>;

    /// As a file would write it.
    fn show(stored: &Self::Stored) -> String;

    /// Brings it into the range; what is not finite becomes the default.
    fn clamp(stored: &mut Self::Stored, default: Self::Stored, range: (f64, f64));

    /// The texture that it is, if it is one.
    fn texture(_: &Self::Stored) -> Option<TextureRef> {
        None
    }
}

pub(crate) fn wrong_type(parameter: &Parameter, value: &Value) -> ParameterError {
    ParameterError::WrongType {
        key: parameter.name.to_owned(),
        expected: parameter.kind.to_owned(),
        found: value.kind(),
    }
}

fn in_range(number: f64, parameter: &Parameter) -> Result<f32, ParameterError> {
    let (smallest, largest) = parameter.range;
    // Written so that NaN fails; the conversion must stay finite too.
    if number >= smallest && number <= largest && (number as f32).is_finite() {
        return Ok(number as f32);
    }
    let (smallest, largest) = (smallest.max(f64::from(f32::MIN)), largest.min(f64::from(f32::MAX)));
    Err(ParameterError::OutOfRange {
        key: parameter.name.to_owned(),
        found: number,
        smallest,
        largest,
        unit: parameter.unit,
    })
}

fn components<const N: usize>(value: &Value, parameter: &Parameter) -> Result<[f32; N], ParameterError> {
    let Value::List(items) = value else {
        return Err(wrong_type(parameter, value));
    };
    let mut out = [0.0; N];
    if items.len() != N {
        return Err(wrong_type(parameter, value));
    }
    for (slot, item) in out.iter_mut().zip(items) {
        let Value::Number(number) = item else {
            return Err(wrong_type(parameter, value));
        };
        *slot = in_range(*number, parameter)?;
    }
    Ok(out)
}

fn clamp_component(stored: &mut f32, default: f32, (smallest, largest): (f64, f64)) {
    if !stored.is_finite() {
        *stored = if default.is_finite() { default } else { 0.0 };
    }
    *stored = f64::from(*stored).clamp(smallest, largest) as f32;
}

fn list(components: &[f32]) -> String {
    format!("[{}]", components.iter().map(f32::to_string).collect::<Vec<_>>().join(", "))
}

/// A number.
#[derive(Debug)]
pub struct Number;

impl Kind for Number {
    type Stored = f32;
    const SYNTAX: &'static str = "a number";
    const FORM: Form = Form::Number;

    fn read(value: &Value, parameter: &Parameter, _: &mut dyn TextureSource) -> Result<f32, ParameterError> {
        match value {
            Value::Number(number) => in_range(*number, parameter),
            _ => Err(wrong_type(parameter, value)),
        }
    }

    fn show(stored: &f32) -> String {
        stored.to_string()
    }

    fn clamp(stored: &mut f32, default: f32, range: (f64, f64)) {
        clamp_component(stored, default, range);
    }
}

/// A whole number.
#[derive(Debug)]
pub struct Count;

impl Kind for Count {
    type Stored = u32;
    const SYNTAX: &'static str = "a whole number";
    const FORM: Form = Form::Count;

    fn read(value: &Value, parameter: &Parameter, _: &mut dyn TextureSource) -> Result<u32, ParameterError> {
        match value {
            Value::Number(number) if number.fract() == 0.0 || !number.is_finite() => {
                in_range(*number, parameter)?;
                Ok(*number as u32)
            }
            _ => Err(wrong_type(parameter, value)),
        }
    }

    fn show(stored: &u32) -> String {
        stored.to_string()
    }

    fn clamp(stored: &mut u32, _: u32, (smallest, largest): (f64, f64)) {
        *stored = (*stored).clamp(smallest as u32, largest as u32);
    }
}

/// On or off.
#[derive(Debug)]
pub struct Switch;

impl Kind for Switch {
    type Stored = bool;
    const SYNTAX: &'static str = "true or false";
    const FORM: Form = Form::Switch;

    fn read(value: &Value, parameter: &Parameter, _: &mut dyn TextureSource) -> Result<bool, ParameterError> {
        match value {
            Value::Switch(value) => Ok(*value),
            _ => Err(wrong_type(parameter, value)),
        }
    }

    fn show(stored: &bool) -> String {
        stored.to_string()
    }

    fn clamp(_: &mut bool, _: bool, _: (f64, f64)) {}
}

/// Two components.
#[derive(Debug)]
pub struct Vector2;

impl Kind for Vector2 {
    type Stored = Vec2;
    const SYNTAX: &'static str = "[x, y]";
    const FORM: Form = Form::Vector(2);

    fn read(value: &Value, parameter: &Parameter, _: &mut dyn TextureSource) -> Result<Vec2, ParameterError> {
        components(value, parameter).map(Vec2::from_array)
    }

    fn show(stored: &Vec2) -> String {
        list(&stored.to_array())
    }

    fn clamp(stored: &mut Vec2, default: Vec2, range: (f64, f64)) {
        clamp_component(&mut stored.x, default.x, range);
        clamp_component(&mut stored.y, default.y, range);
    }
}

/// Three components.
#[derive(Debug)]
pub struct Vector3;

impl Kind for Vector3 {
    type Stored = Vec3;
    const SYNTAX: &'static str = "[x, y, z]";
    const FORM: Form = Form::Vector(3);

    fn read(value: &Value, parameter: &Parameter, _: &mut dyn TextureSource) -> Result<Vec3, ParameterError> {
        components(value, parameter).map(Vec3::from_array)
    }

    fn show(stored: &Vec3) -> String {
        list(&stored.to_array())
    }

    fn clamp(stored: &mut Vec3, default: Vec3, range: (f64, f64)) {
        let mut out = stored.to_array();
        out.iter_mut().zip(default.to_array()).for_each(|(slot, default)| clamp_component(slot, default, range));
        *stored = Vec3::from_array(out);
    }
}

/// A linear colour; `"#rrggbb"` is sRGB-coded and is decoded.
#[derive(Debug)]
pub struct Rgb;

impl Kind for Rgb {
    type Stored = Vec3;
    const SYNTAX: &'static str = "linear [r, g, b] or sRGB \"#rrggbb\"";
    const FORM: Form = Form::Rgb;

    fn read(value: &Value, parameter: &Parameter, _: &mut dyn TextureSource) -> Result<Vec3, ParameterError> {
        match value {
            Value::Text(text) => match hexadecimal(text) {
                Some([r, g, b, None]) => Ok(decoded(r, g, b)),
                _ => Err(wrong_type(parameter, value)),
            },
            _ => components(value, parameter).map(Vec3::from_array),
        }
    }

    fn show(stored: &Vec3) -> String {
        list(&stored.to_array())
    }

    fn clamp(stored: &mut Vec3, default: Vec3, range: (f64, f64)) {
        Vector3::clamp(stored, default, range);
    }
}

/// A linear colour with opacity, 1 where the file leaves it out.
#[derive(Debug)]
pub struct Rgba;

impl Kind for Rgba {
    type Stored = Vec4;
    const SYNTAX: &'static str = "linear [r, g, b] or [r, g, b, a], or sRGB \"#rrggbb\" or \"#rrggbbaa\"";
    const FORM: Form = Form::Rgba;

    fn read(value: &Value, parameter: &Parameter, _: &mut dyn TextureSource) -> Result<Vec4, ParameterError> {
        match value {
            Value::Text(text) => match hexadecimal(text) {
                Some([r, g, b, alpha]) => Ok(decoded(r, g, b).extend(f32::from(alpha.unwrap_or(255)) / 255.0)),
                None => Err(wrong_type(parameter, value)),
            },
            Value::List(items) if items.len() == 3 => {
                components(value, parameter).map(|rgb| Vec3::from_array(rgb).extend(1.0))
            }
            _ => components(value, parameter).map(Vec4::from_array),
        }
    }

    fn show(stored: &Vec4) -> String {
        list(&stored.to_array())
    }

    fn clamp(stored: &mut Vec4, default: Vec4, range: (f64, f64)) {
        let mut out = stored.to_array();
        out.iter_mut().zip(default.to_array()).for_each(|(slot, default)| clamp_component(slot, default, range));
        *stored = Vec4::from_array(out);
    }
}

/// The bytes of `#rrggbb` or `#rrggbbaa`; the first three are always there.
fn hexadecimal(text: &str) -> Option<[Option<u8>; 4]> {
    let digits = text.strip_prefix('#')?;
    if !matches!(digits.len(), 6 | 8) || !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return None;
    }
    Some([0, 2, 4, 6].map(|at| digits.get(at..at + 2).and_then(|pair| u8::from_str_radix(pair, 16).ok())))
}

fn decoded(r: Option<u8>, g: Option<u8>, b: Option<u8>) -> Vec3 {
    Vec3::from_array([r, g, b].map(|byte| linear_from_srgb_byte(byte.unwrap_or(0))))
}

/// A length, absolute or relative to the size of what it is on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Length {
    /// Metres.
    Metres(f32),
    /// Share of the radius of the mesh's bounding sphere, 0.02 = 2 %.
    Relative(f32),
}

impl Length {
    /// In metres, on a mesh with that bounding radius.
    pub fn metres(self, bounding_radius_m: f32) -> f32 {
        match self {
            Self::Metres(metres) => metres,
            Self::Relative(share) => share * bounding_radius_m,
        }
    }
}

/// A [`Length`].
#[derive(Debug)]
pub struct Distance;

impl Kind for Distance {
    type Stored = Length;
    const SYNTAX: &'static str = "metres, or \"2%\" of the bounding radius";
    const FORM: Form = Form::Distance;

    fn read(value: &Value, parameter: &Parameter, _: &mut dyn TextureSource) -> Result<Length, ParameterError> {
        match value {
            Value::Number(metres) => in_range(*metres, parameter).map(Length::Metres),
            Value::Text(text) => {
                let percent = text.trim().strip_suffix('%').and_then(|number| number.trim().parse::<f64>().ok());
                let percent = percent.ok_or_else(|| wrong_type(parameter, value))?;
                in_range(percent / 100.0, parameter).map(Length::Relative)
            }
            _ => Err(wrong_type(parameter, value)),
        }
    }

    fn show(stored: &Length) -> String {
        match stored {
            Length::Metres(metres) => metres.to_string(),
            // Rounded to undo the binary share: 0.006 shows as 0.6%.
            Length::Relative(share) => format!("\"{}%\"", (f64::from(*share) * 1e7).round() / 1e5),
        }
    }

    fn clamp(stored: &mut Length, default: Length, range: (f64, f64)) {
        match stored {
            Length::Metres(value) | Length::Relative(value) if value.is_finite() => clamp_component(value, 0.0, range),
            _ => *stored = default,
        }
    }
}

/// A texture, or none.
#[derive(Debug)]
pub struct Map;

impl Kind for Map {
    type Stored = Option<TextureRef>;
    const SYNTAX: &'static str = "\"file.png\", \"none\", or { file = \"file.png\" or procedural = \"NAME\", tiling = [1, 1], offset = [0, 0], rotation = 0, uv_set = 0 }";
    const FORM: Form = Form::Map;

    fn read(
        value: &Value,
        parameter: &Parameter,
        textures: &mut dyn TextureSource,
    ) -> Result<Self::Stored, ParameterError> {
        match value {
            Value::Text(text) if text == "none" => Ok(None),
            _ => texture::read(value, parameter, textures).map(Some),
        }
    }

    fn show(_: &Self::Stored) -> String {
        "none".to_owned()
    }

    fn texture(stored: &Self::Stored) -> Option<TextureRef> {
        *stored
    }

    fn clamp(stored: &mut Self::Stored, _: Self::Stored, _: (f64, f64)) {
        if let Some(map) = stored {
            let finite = map.offset.is_finite() && map.scale.is_finite() && map.rotation.is_finite();
            if !finite {
                (map.offset, map.scale, map.rotation) = (Vec2::ZERO, Vec2::ONE, 0.0);
            }
        }
    }
}

/// A value that may be left to something else, which the help line names.
#[derive(Debug)]
pub struct Optional<K>(PhantomData<K>);

impl<K: Kind<Stored: Clone>> Kind for Optional<K> {
    type Stored = Option<K::Stored>;
    const SYNTAX: &'static str = K::SYNTAX;
    const FORM: Form = K::FORM;
    const CHOICES: &'static [&'static str] = K::CHOICES;

    fn read(
        value: &Value,
        parameter: &Parameter,
        textures: &mut dyn TextureSource,
    ) -> Result<Self::Stored, ParameterError> {
        K::read(value, parameter, textures).map(Some)
    }

    fn show(stored: &Self::Stored) -> String {
        stored.as_ref().map_or("none".to_owned(), K::show)
    }

    fn clamp(stored: &mut Self::Stored, default: Self::Stored, range: (f64, f64)) {
        if let Some(value) = stored {
            let fallback = default.unwrap_or_else(|| value.clone());
            K::clamp(value, fallback, range);
        }
    }
}

/// An enum that [`choices!`](crate::choices) declares.
pub trait Choice: Copy {
    /// All names, in the order of declaration.
    const NAMES: &'static [&'static str];
    /// The variant of that name.
    fn named(name: &str) -> Option<Self>;
    /// The name of the variant.
    fn name(self) -> &'static str;
}

/// One of the names of a [`Choice`].
#[derive(Debug)]
pub struct OneOf<C>(PhantomData<C>);

impl<C: Choice> Kind for OneOf<C> {
    type Stored = C;
    const SYNTAX: &'static str = "a name";
    const FORM: Form = Form::Choice;
    const CHOICES: &'static [&'static str] = C::NAMES;

    fn read(value: &Value, parameter: &Parameter, _: &mut dyn TextureSource) -> Result<C, ParameterError> {
        let Value::Text(text) = value else {
            return Err(wrong_type(parameter, value));
        };
        C::named(text).ok_or_else(|| ParameterError::NotAChoice {
            key: parameter.name.to_owned(),
            found: text.clone(),
            choices: C::NAMES.into(),
            nearest: nearest(text, C::NAMES.iter().copied()).map(str::to_owned),
        })
    }

    fn show(stored: &C) -> String {
        format!("\"{}\"", stored.name())
    }

    fn clamp(_: &mut C, _: C, _: (f64, f64)) {}
}
