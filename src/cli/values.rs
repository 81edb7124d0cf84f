//! Values of options, parsed where clap can still say "usage".

use glam::Vec3;
use vair::render::Background;
use vair::scene::CameraChoice;

/// `1280x720`.
pub fn size(text: &str) -> Result<[u32; 2], String> {
    let (width, height) = text.split_once(['x', 'X']).ok_or("write it as WIDTHxHEIGHT, for example 1280x720")?;
    let side = |text: &str| text.parse::<u32>().map_err(|_| format!("{text:?} is not a number of pixels"));
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
            let linear =
                |coded: f32| if coded <= 0.04045 { coded / 12.92 } else { ((coded + 0.055) / 1.055).powf(2.4) };
            Ok(Background::Color(Vec3::from_array(color.map(linear))))
        }
    }
}

/// A number of shells.
pub fn layers(text: &str) -> Result<Option<u32>, String> {
    if text == "auto" {
        return Ok(None);
    }
    match text.parse() {
        Ok(layers @ 1..=256) => Ok(Some(layers)),
        _ => Err("the number of shells must be 1 to 256, or auto (what the material says)".to_owned()),
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

/// Frames a second, > 0.
pub fn frame_rate(text: &str) -> Result<f32, String> {
    finite(text)?;
    text.parse::<f32>().ok().filter(|rate| *rate > 0.0).ok_or_else(|| "must be greater than 0".to_owned())
}

/// A camera by name or index, as [`vair::scene::CameraChoice`].
pub fn camera(text: &str) -> Result<CameraChoice, String> {
    Ok(text.parse().map_or_else(|_| CameraChoice::Named(text.to_owned()), CameraChoice::Index))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_orbits_and_colours() {
        assert_eq!(size("640x480"), Ok([640, 480]));
        assert!(size("640").is_err() && size("-1x4").is_err() && size("x").is_err());
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
        assert_eq!(layers("auto"), Ok(None));
        assert!(layers("0").is_err() && layers("257").is_err());
    }
}
