//! Pictures: a host of the backend that owns its targets and adds the background, tone mapping and read-back; and their
//! files.

mod aov;
mod capture;
mod exr;
mod file;
mod host;
mod radiance;
mod report;
mod skybox;
mod targets;

pub use aov::{AovPixels, Aovs, EMPTY_DEPTH_M};
pub use file::write_file;
pub(super) use host::PictureHost;
pub use report::{CpuPhases, FrameReport, FurReport};
pub use skybox::{PictureBackground, Skybox, SkyboxImage, skybox_bytes};
pub(super) use targets::{HDR, PictureTargets, SKYBOX, SKYBOX_SAMPLER};

use super::RenderError;
use ash::vk;
use glam::Vec4;
use std::path::Path;

/// Format of the display colour of a picture.
pub const PICTURE_FORMAT: vk::Format = vk::Format::R8G8B8A8_UNORM;
/// Its name on the device.
pub(super) const PICTURE_NAME: &str = "picture";

/// A rendered picture.
#[derive(Debug, Clone)]
pub struct Picture {
    /// Pixels: width, height.
    pub size: [u32; 2],
    /// Display colour, sRGB-coded, `width * height * 4` bytes, rows from the top; alpha is not premultiplied.
    pub rgba: Vec<u8>,
    /// Linear HDR radiance before exposure and tone curve, premultiplied, rows from the top; empty unless asked for.
    pub radiance: Vec<Vec4>,
    /// The background where nothing was drawn.
    pub background: PictureBackground,
    /// The layers beside the colour that were asked for.
    pub aovs: AovPixels,
}

impl Picture {
    /// Display colour alone: `width * height * 4` sRGB-coded bytes, rows from the top.
    pub fn new(size: [u32; 2], rgba: Vec<u8>) -> Self {
        Self {
            size,
            rgba,
            radiance: Vec::new(),
            background: PictureBackground::Transparent,
            aovs: AovPixels::default(),
        }
    }

    /// The display colour of a pixel.
    ///
    /// # Panics
    /// Outside the picture.
    pub fn pixel(&self, x: u32, y: u32) -> [u8; 4] {
        let first = (y as usize * self.size[0] as usize + x as usize) * 4;
        [0, 1, 2, 3].map(|channel| self.rgba[first + channel])
    }

    /// The linear radiance of a pixel, premultiplied.
    ///
    /// # Panics
    /// Outside the picture, or when radiance was not asked for.
    pub fn radiance(&self, x: u32, y: u32) -> Vec4 {
        self.radiance[y as usize * self.size[0] as usize + x as usize]
    }

    /// The file as bytes: PNG (display colour) or EXR (linear radiance, 32-bit float, background behind it, and layers).
    ///
    /// # Errors
    /// When the encoder refuses, or `format` is EXR and the radiance was not asked for.
    pub fn encode(&self, format: PictureFormat) -> Result<Vec<u8>, RenderError> {
        let mut bytes = Vec::new();
        match format {
            PictureFormat::Png => {
                let encoder = image::codecs::png::PngEncoder::new(&mut bytes);
                let [width, height] = self.size;
                image::ImageEncoder::write_image(encoder, &self.rgba, width, height, image::ExtendedColorType::Rgba8)
                    .map_err(|error| RenderError::Encode { format: "PNG", problem: error.to_string() })?;
            }
            PictureFormat::Exr => bytes = exr::encode(self)?,
        }
        Ok(bytes)
    }

    /// Writes the file whole or not at all: to a temporary file beside it, then renamed.
    ///
    /// # Errors
    /// When the ending is neither .png nor .exr, the encoder refuses, or the folder cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), RenderError> {
        let path = path.as_ref();
        let bytes = self.encode(PictureFormat::of(path)?)?;
        write_file(path, &bytes)
    }
}

/// File format of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PictureFormat {
    /// 8-bit display colour.
    Png,
    /// 32-bit linear radiance.
    Exr,
}

impl PictureFormat {
    /// By the file's ending.
    ///
    /// # Errors
    /// When it is neither .png nor .exr.
    pub fn of(path: &Path) -> Result<Self, RenderError> {
        match path.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase).as_deref() {
            Some("png") => Ok(Self::Png),
            Some("exr") => Ok(Self::Exr),
            _ => Err(RenderError::Ending { path: path.to_owned() }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture() -> Picture {
        Picture::new([2, 1], vec![1, 2, 3, 255, 4, 5, 6, 255])
    }

    #[test]
    fn a_saved_picture_reads_back_and_leaves_nothing_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture.png");
        picture().save(&path).unwrap();
        assert_eq!(image::open(&path).unwrap().into_rgba8().into_raw(), picture().rgba);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn a_saved_picture_is_as_readable_as_any_new_file() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (saved, plain) = (folder.path().join("saved.png"), folder.path().join("plain.txt"));
        picture().save(&saved).unwrap();
        std::fs::write(&plain, "").unwrap();
        let mode = |path: &Path| std::fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&saved), mode(&plain));
    }

    #[test]
    fn other_endings_and_absent_radiance_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        assert!(matches!(picture().save(folder.path().join("picture.gif")), Err(RenderError::Ending { .. })));
        assert!(matches!(picture().save(folder.path().join("picture.exr")), Err(RenderError::Encode { .. })));
        assert!(matches!(picture().save(folder.path().join("nowhere/picture.png")), Err(RenderError::Write { .. })));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
