//! Values of options, parsed where clap can still say "usage".

use clap::builder::TypedValueParser;
use clap::{Arg, Command};
use glam::Vec3;
use std::ffi::OsStr;
use std::path::PathBuf;
use vair::math::linear_from_srgb;
use vair::render::{Background, MAX_LAYERS, PictureFormat, RenderError};

/// Shell layers of fur.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layers {
    /// What each material says.
    Auto,
    /// 1 to [`MAX_LAYERS`].
    Count(u32),
}

/// `1280x720`.
pub fn size(text: &str) -> Result<[u32; 2], String> {
    let (width, height) = text.split_once(['x', 'X']).ok_or("write it as WIDTHxHEIGHT, for example 1280x720")?;
    let side = |text: &str| match text.parse::<u32>() {
        Ok(0) => Err("both sides must be at least 1 pixel".to_owned()),
        Ok(side) => Ok(side),
        Err(_) => Err(format!("{text:?} is not a number of pixels")),
    };
    Ok([side(width)?, side(height)?])
}

fn numbers<const N: usize>(text: &str, form: &str) -> Result<[f32; N], String> {
    let parsed: Vec<f32> = text
        .split(',')
        .map(|part| part.trim().parse::<f32>().ok().filter(|number| number.is_finite()))
        .collect::<Option<_>>()
        .ok_or_else(|| format!("write it as {form}"))?;
    parsed.try_into().map_err(|_| format!("write it as {form}"))
}

/// `X,Y,Z`.
pub fn point(text: &str) -> Result<Vec3, String> {
    numbers::<3>(text, "X,Y,Z in metres").map(Vec3::from_array)
}

/// `THETA,PHI,RADIUS` in degrees and metres; the radius may be left out, which frames the scene.
pub fn orbit(text: &str) -> Result<(f32, f32, Option<f32>), String> {
    if let Ok([theta, phi]) = numbers::<2>(text, "") {
        return Ok((theta, phi, None));
    }
    let [theta, phi, radius] = numbers::<3>(text, "THETA,PHI,RADIUS in degrees and metres (or THETA,PHI)")?;
    if radius > 0.0 { Ok((theta, phi, Some(radius))) } else { Err("the radius must be greater than 0".to_owned()) }
}

/// `env`, `transparent` or `R,G,B` in sRGB.
pub fn background(text: &str) -> Result<Background, String> {
    match text {
        "env" => Ok(Background::Environment),
        "transparent" => Ok(Background::Transparent),
        color => {
            let color = numbers::<3>(color, "env, transparent or R,G,B in [0, 1]")?;
            if color.iter().any(|channel| !(0.0..=1.0).contains(channel)) {
                return Err("each of R,G,B must lie in [0, 1]".to_owned());
            }
            Ok(Background::Color(Vec3::from_array(color.map(linear_from_srgb))))
        }
    }
}

/// A number of shells, or `auto`.
pub fn layers(text: &str) -> Result<Layers, String> {
    match text.parse() {
        _ if text == "auto" => Ok(Layers::Auto),
        Ok(layers @ 1..=MAX_LAYERS) => Ok(Layers::Count(layers)),
        _ => Err(format!("the number of shells must be 1 to {MAX_LAYERS}, or auto (what the material says)")),
    }
}

/// `A..B`: frames A up to, not including, B; or one frame.
pub fn frames(text: &str) -> Result<std::ops::Range<u32>, String> {
    let form = "write it as A..B: frames A up to, not including, B";
    let number = |text: &str| text.trim().parse::<u32>().map_err(|_| form.to_owned());
    let (first, end) = text.split_once("..").ok_or(form)?;
    let range = number(first)?..number(end)?;
    if range.is_empty() { Err(format!("{text} holds no frame; {form}")) } else { Ok(range) }
}

/// `I/N`: part I of N, counted from 0.
pub fn shard(text: &str) -> Result<(u32, u32), String> {
    let form = "write it as I/N with I below N: of every N frames, the one whose number leaves I";
    let (part, parts) = text.split_once('/').ok_or(form)?;
    match (part.parse::<u32>(), parts.parse::<u32>()) {
        (Ok(part), Ok(parts)) if part < parts => Ok((part, parts)),
        _ => Err(form.to_owned()),
    }
}

/// Degrees strictly between 0 and 180.
pub fn field_of_view(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(degrees) if degrees > 0.0 && degrees < 180.0 => Ok(degrees),
        _ => Err("the vertical field of view must lie between 0 and 180 degrees".to_owned()),
    }
}

/// Seconds or stops: any finite number.
pub fn finite(text: &str) -> Result<f32, String> {
    text.parse::<f32>().ok().filter(|number| number.is_finite()).ok_or_else(|| "not a finite number".to_owned())
}

/// A factor, >= 0.
pub fn not_negative(text: &str) -> Result<f32, String> {
    finite(text).and_then(|factor| if factor >= 0.0 { Ok(factor) } else { Err("must be at least 0".to_owned()) })
}

/// Frames a second, > 0.
pub fn frame_rate(text: &str) -> Result<f32, String> {
    finite(text).and_then(|rate| if rate > 0.0 { Ok(rate) } else { Err("must be greater than 0".to_owned()) })
}

/// Bytes, with or without a suffix: `1048576`, `512MiB`, `4GiB`.
pub fn bytes(text: &str) -> Result<u64, String> {
    const SUFFIXES: [(&str, u64); 3] = [("KiB", 1 << 10), ("MiB", 1 << 20), ("GiB", 1 << 30)];
    let suffix = SUFFIXES.iter().find_map(|(suffix, unit)| Some((text.strip_suffix(suffix)?, *unit)));
    let (number, unit) = suffix.unwrap_or((text, 1));
    let bytes = number.trim().parse::<u64>().ok().and_then(|number| number.checked_mul(unit));
    bytes.ok_or_else(|| "write it in bytes, or with KiB, MiB or GiB, for example 512MiB".to_owned())
}

/// The file of a picture: its ending names the format; `-` is a PNG on standard output.
pub fn picture_file(text: &OsStr) -> Result<PathBuf, RenderError> {
    let path = PathBuf::from(text);
    if text != "-" {
        PictureFormat::of(&path)?;
    }
    Ok(path)
}

/// [`picture_file`] for clap, which hands over names that are not UTF-8 only to its own trait.
#[derive(Debug, Clone)]
pub struct PictureFile;

impl TypedValueParser for PictureFile {
    type Value = PathBuf;

    fn parse_ref(&self, command: &Command, argument: Option<&Arg>, value: &OsStr) -> Result<PathBuf, clap::Error> {
        picture_file(value).map_err(|error| {
            let name = argument.map(Arg::to_string).unwrap_or_default();
            clap::Error::raw(clap::error::ErrorKind::ValueValidation, format!("{name}: {error}\n")).with_cmd(command)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_orbits_and_colours() {
        assert_eq!(size("640x480"), Ok([640, 480]));
        assert!(size("640").is_err() && size("-1x4").is_err() && size("0x4").is_err() && size("x").is_err());
        assert_eq!(orbit("30,60,2"), Ok((30.0, 60.0, Some(2.0))));
        assert_eq!(orbit("30,60"), Ok((30.0, 60.0, None)));
        assert!(orbit("30").is_err() && orbit("1,2,0").is_err() && orbit("nan,1,1").is_err());
        assert_eq!(background("1,1,1"), Ok(Background::Color(Vec3::ONE)));
        assert!(background("2,0,0").is_err() && background("blue").is_err());
    }

    #[test]
    fn sequences() {
        assert_eq!(frames("3..7"), Ok(3..7));
        assert!(frames("7..3").is_err() && frames("3").is_err());
        assert_eq!(shard("0/2"), Ok((0, 2)));
        assert!(shard("2/2").is_err() && shard("1").is_err());
        assert_eq!(layers("auto"), Ok(Layers::Auto));
        assert_eq!(layers("256"), Ok(Layers::Count(256)));
        assert!(layers("0").is_err() && layers("257").is_err());
    }

    #[test]
    fn memory() {
        assert_eq!(bytes("4GiB"), Ok(4 << 30));
        assert_eq!(bytes("512 MiB"), Ok(512 << 20));
        assert_eq!(bytes("77"), Ok(77));
        assert!(bytes("4GB").is_err() && bytes("-1").is_err() && bytes("99999999999GiB").is_err());
    }

    #[test]
    fn picture_names() {
        assert!(picture_file("-".as_ref()).is_ok() && picture_file("a.PNG".as_ref()).is_ok());
        assert!(picture_file("a.jpg".as_ref()).is_err() && picture_file("png".as_ref()).is_err());
    }
}
