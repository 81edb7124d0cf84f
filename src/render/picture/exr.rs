//! EXR files: linear light, premultiplied, and the layers beside it, all as 32-bit floats.

use super::Picture;
use crate::render::RenderError;
use exr::prelude::*;
use glam::Vec4;

/// The picture as an EXR file: channels R, G, B, A before exposure and tone curve, the background behind them; then
/// those of its layers.
///
/// # Errors
/// When the encoder refuses, or the radiance was not asked for.
pub fn encode(picture: &Picture) -> std::result::Result<Vec<u8>, RenderError> {
    let failed = |problem: String| RenderError::Encode { format: "EXR", problem };
    let [width, height] = picture.size.map(|side| side as usize);
    if picture.radiance.len() != width * height {
        return Err(failed("the frame kept no linear radiance".to_owned()));
    }
    let over = |(index, color): (usize, &Vec4)| {
        let (x, y) = ((index % width) as u32, (index / width) as u32);
        *color + picture.background.at(x, y) * (1.0 - color.w)
    };
    let shown: Vec<Vec4> = picture.radiance.iter().enumerate().map(over).collect();
    let color = ["R", "G", "B", "A"].iter().enumerate();
    let color = color.map(|(index, name)| (*name, shown.iter().map(|pixel| pixel[index]).collect::<Vec<f32>>()));
    let channels = color.chain(picture.aovs.channels());
    let channels = channels.map(|(name, values)| AnyChannel::new(name, FlatSamples::F32(values))).collect();
    let mut bytes = Vec::new();
    Image::from_channels((width, height), AnyChannels::sort(channels))
        .write()
        .to_buffered(std::io::Cursor::new(&mut bytes))
        .map_err(|error| failed(error.to_string()))?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::super::{AovPixels, EMPTY_DEPTH_M, PictureBackground};
    use super::*;
    use glam::{Vec2, Vec3};

    fn picture(background: PictureBackground, aovs: AovPixels) -> Picture {
        let radiance = vec![Vec4::new(4.0, 1e-6, 70_000.0, 0.5), Vec4::ZERO];
        Picture { size: [2, 1], rgba: vec![0; 8], radiance, background, aovs }
    }

    /// Names and values of the channels that the file holds.
    fn read(bytes: &[u8]) -> Vec<(String, Vec<f32>)> {
        let file = exr::prelude::read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer();
        let image = file.all_attributes().from_buffered(std::io::Cursor::new(bytes)).unwrap();
        let channels = image.layer_data.channel_data.list.iter();
        channels.map(|channel| (channel.name.to_string(), channel.sample_data.values_as_f32().collect())).collect()
    }

    #[test]
    fn light_is_kept_premultiplied_to_the_bit_and_the_background_lies_behind() {
        let transparent = read(&encode(&picture(PictureBackground::Transparent, AovPixels::default())).unwrap());
        let expected = [("A", [0.5, 0.0]), ("B", [70_000.0, 0.0]), ("G", [1e-6, 0.0]), ("R", [4.0, 0.0])];
        assert_eq!(transparent, expected.map(|(name, values)| (name.to_owned(), values.to_vec())));
        let behind =
            read(&encode(&picture(PictureBackground::Color(Vec3::new(2.0, 0.0, 0.0)), AovPixels::default())).unwrap());
        assert_eq!(behind[0].1, [1.0, 1.0]);
        assert_eq!(behind[3].1, [5.0, 2.0]);
    }

    #[test]
    fn layers_stand_beside_the_colour_in_full_precision() {
        let aovs = AovPixels {
            depth_m: vec![1.0 / 3.0, EMPTY_DEPTH_M],
            normal_in_world: vec![Vec3::new(0.1, -0.2, 0.3), Vec3::ZERO],
            motion_px: vec![Vec2::new(-12.345, 1e-7), Vec2::ZERO],
            occlusion: vec![0.25, 1.0],
        };
        let channels = read(&encode(&picture(PictureBackground::Transparent, aovs)).unwrap());
        let names: Vec<&str> = channels.iter().map(|(name, _)| name.as_str()).collect();
        let layers = ["depth.Z", "motion.X", "motion.Y", "normal.X", "normal.Y", "normal.Z", "occlusion.V"];
        assert_eq!(names, [&["A", "B", "G", "R"], &layers[..]].concat());
        assert_eq!(channels[4].1, [1.0 / 3.0, EMPTY_DEPTH_M]);
        assert_eq!([channels[5].1[0], channels[6].1[0]], [-12.345, 1e-7]);
        assert_eq!([channels[7].1[0], channels[8].1[0], channels[9].1[0]], [0.1, -0.2, 0.3]);
        assert_eq!(channels[10].1, [0.25, 1.0]);
    }
}
