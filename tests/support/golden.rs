//! Pictures against goldens: pictures that were looked at once and committed.

use std::path::{Path, PathBuf};
use vair::gpu::DeviceInfo;
use vair::render::Picture;

/// How far a picture may be from its golden.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    /// Difference of a channel, in steps of 8 bits, beyond which a pixel is an outlier.
    pub max_difference: u8,
    /// Share of the pixels that may be outliers.
    pub outlier_share: f64,
    /// Mean of FLIP (Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images").
    pub flip_mean: f64,
    /// 99th percentile of FLIP over the pixels.
    pub flip_p99: f64,
}

/// Differences found.
#[derive(Debug, Clone, Copy)]
pub struct Difference {
    /// Share of the outliers.
    pub outlier_share: f64,
    /// Largest difference of a channel.
    pub largest: u8,
    /// Mean of FLIP.
    pub flip_mean: f64,
    /// 99th percentile of FLIP.
    pub flip_p99: f64,
}

impl std::fmt::Display for Difference {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { outlier_share, largest, flip_mean, flip_p99 } = self;
        write!(f, "{outlier_share:.4} outliers, {largest} the largest, FLIP {flip_mean:.4} mean, {flip_p99:.4} at 99 %")
    }
}

/// Folder of the committed goldens.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden")
}

/// The driver that goldens are made on: lavapipe of Mesa 22.3.6, whose pictures are the same bytes everywhere.
pub fn is_pinned(device: &DeviceInfo) -> bool {
    device.name.contains("llvmpipe") && device.driver.contains("22.3.6")
}

/// Compares a picture with `<folder>/<name>.png`; what fails is written beside the build, with the difference.
pub fn compare(folder: &Path, name: &str, picture: &Picture, limits: &Limits) -> Result<Difference, String> {
    let path = folder.join(name).with_extension("png");
    let golden = image::open(&path)
        .map_err(|error| format!("golden {}: {error}; tools/bless makes it", path.display()))?
        .into_rgba8();
    let size = [golden.width(), golden.height()];
    if size != picture.size {
        return Err(format!(
            "golden {name} is {size:?} pixels large and the picture {:?}; tools/bless remakes it",
            picture.size
        ));
    }
    let (difference, flip) = measure(&golden, picture, limits.max_difference);
    let is_near = difference.outlier_share <= limits.outlier_share
        && difference.flip_mean <= limits.flip_mean
        && difference.flip_p99 <= limits.flip_p99;
    if is_near {
        return Ok(difference);
    }
    let kept = keep(name, picture, &flip);
    Err(format!("{name} is not its golden: {difference}; beyond {limits:?}; see {kept}"))
}

fn measure(golden: &image::RgbaImage, picture: &Picture, max_difference: u8) -> (Difference, nv_flip::FlipImageFloat) {
    let largest_of = |(a, b): (&[u8], &[u8])| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
    let pixels = || golden.as_raw().chunks_exact(4).zip(picture.rgba.chunks_exact(4)).map(largest_of);
    let outliers = pixels().filter(|difference| *difference > max_difference).count();
    let rgb = |rgba: &[u8]| {
        let rgb: Vec<u8> = rgba.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        nv_flip::FlipImageRgb8::with_data(picture.size[0], picture.size[1], &rgb)
    };
    let flip = nv_flip::flip(rgb(golden.as_raw()), rgb(&picture.rgba), nv_flip::DEFAULT_PIXELS_PER_DEGREE);
    let mut errors = flip.to_vec();
    errors.sort_by(f32::total_cmp);
    let difference = Difference {
        outlier_share: outliers as f64 / errors.len() as f64,
        largest: pixels().max().unwrap_or(0),
        flip_mean: errors.iter().map(|error| f64::from(*error)).sum::<f64>() / errors.len() as f64,
        flip_p99: f64::from(errors[(errors.len() * 99 / 100).min(errors.len() - 1)]),
    };
    (difference, flip)
}

/// Writes the picture and FLIP's map for looking at; says where.
fn keep(name: &str, picture: &Picture, flip: &nv_flip::FlipImageFloat) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/golden-failures");
    let write = || -> Result<(), String> {
        std::fs::create_dir_all(&folder).map_err(|error| error.to_string())?;
        picture.save(folder.join(format!("{name}.actual.png"))).map_err(|error| error.to_string())?;
        let shown = flip.apply_color_lut(&nv_flip::magma_lut()).to_vec();
        let map = image::RgbImage::from_raw(picture.size[0], picture.size[1], shown).ok_or("an empty map")?;
        map.save(folder.join(format!("{name}.difference.png"))).map_err(|error| error.to_string())
    };
    match write() {
        Ok(()) => format!("{}/{name}.{{actual,difference}}.png", folder.display()),
        Err(error) => format!("nothing, since {} cannot be written: {error}", folder.display()),
    }
}

/// Makes a picture the golden of that name, whole or not at all.
///
/// Only the pinned driver may: limits mean nothing when goldens come from several.
pub fn bless(folder: &Path, name: &str, picture: &Picture, device: &DeviceInfo) -> Result<(), String> {
    if !is_pinned(device) {
        return Err(format!("{} ({}) may not make goldens: bless on lavapipe 22.3.6", device.name, device.driver));
    }
    std::fs::create_dir_all(folder).map_err(|error| error.to_string())?;
    picture.save(folder.join(name).with_extension("png")).map_err(|error| error.to_string())
}
