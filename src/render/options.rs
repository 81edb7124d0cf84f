//! What one frame is asked to be.

use super::light::EnvironmentQuality;
use super::pass::ssao::ScreenOcclusion;
use super::picture::Aovs;
use super::plan::{PictureOptions, PlanOptions};
use super::{RenderError, Target};
use crate::asset::Asset;
use crate::scene::{CameraChoice, EnvironmentLight, Light};
use glam::Vec3;
use std::ops::RangeInclusive;

/// Depth of our own targets is 32-bit float, reversed: 1 at the near plane.
pub const DEPTH_FORMAT: ash::vk::Format = ash::vk::Format::D32_SFLOAT;

/// Most shells of fur.
pub const MAX_LAYERS: u32 = 256;

/// Everything that a frame depends on beside its scene. `Default` is a 1280 x 720 picture of the rest pose.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameOptions {
    /// Pixels, each at least 1 and at most what the device allows.
    pub size: [u32; 2],
    /// Camera to render from.
    pub camera: CameraChoice,
    /// Index of the scene; `None` = the file's default.
    pub scene: Option<usize>,
    /// Index of the animation clip; `None` = rest pose.
    pub animation: Option<usize>,
    /// Seconds into the clip; beyond its end it starts again. Fur with inertia sways where frames follow each other closely
    /// ([`Renderer::advance`](super::Renderer::advance)).
    pub time_s: f32,
    /// Index of the KHR_materials_variants variant.
    pub variant: Option<usize>,
    /// Tone curve.
    pub tonemap: Tonemap,
    /// Stops; radiance is multiplied by 2^exposure.
    pub exposure_ev: f32,
    /// The environment that lights the scene and stands behind it.
    pub environment: EnvironmentLight,
    /// Lights beside those of the file, in world space.
    pub lights: Vec<Light>,
    /// Shadows of lights.
    pub shadows: Shadows,
    /// How finely the environment is prepared.
    pub environment_quality: EnvironmentQuality,
    /// What is shown where nothing was drawn.
    pub background: Background,
    /// Format of the linear colour target.
    pub hdr_format: HdrFormat,
    /// Shells of fur; `None` = what each material says.
    pub layers: Option<u32>,
    /// Factor on the shells that each material says, > 0; the product is rounded and kept within 1 to 256. Without
    /// effect where `layers` is given.
    pub layer_scale: f32,
    /// How shells are drawn.
    pub shells: Shells,
    /// How what blends is laid over each other.
    pub transparency: Transparency,
    /// Samples a pixel: 1 or 4.
    pub msaa: u32,
    /// Ambient occlusion from what the screen shows; `None`: materials' own maps alone.
    pub screen_occlusion: Option<ScreenOcclusion>,
    /// Layers kept beside the colour.
    pub aovs: Aovs,
    /// Seconds into the clip of the frame before, from which motion is counted; `None`: the same moment.
    pub previous_time_s: Option<f32>,
    /// Draws the frame with everything that a plan can leave out: every pass, the largest permutations with texels that
    /// change nothing, all vertex streams. The same picture; what leaving out saves is the difference.
    pub everything: bool,
}

impl Default for FrameOptions {
    fn default() -> Self {
        Self {
            size: [1280, 720],
            camera: CameraChoice::Auto,
            scene: None,
            animation: None,
            time_s: 0.0,
            variant: None,
            tonemap: Tonemap::Neutral,
            exposure_ev: 0.0,
            environment: EnvironmentLight::default(),
            lights: Vec::new(),
            shadows: Shadows::default(),
            environment_quality: EnvironmentQuality::default(),
            background: Background::Environment,
            hdr_format: HdrFormat::Rgba16f,
            layers: None,
            layer_scale: 1.0,
            shells: Shells::default(),
            transparency: Transparency::default(),
            msaa: 4,
            screen_occlusion: None,
            aovs: Aovs::default(),
            previous_time_s: None,
            everything: false,
        }
    }
}

impl FrameOptions {
    /// Whether the picture shows the environment where nothing was drawn. A constant one is just a colour, and a format
    /// without alpha cannot tell where that is: there the environment's mean stands behind.
    pub fn shows_environment(&self) -> bool {
        self.background == Background::Environment
            && self.hdr_format.has_alpha()
            && self.environment.constant_radiance().is_none()
    }

    /// What of these options a plan depends on.
    pub fn plan_options(&self) -> PlanOptions {
        PlanOptions {
            target: Target { color: self.hdr_format.vulkan(), ..Target::hdr(self.msaa) },
            layers: self.layers,
            layer_scale: self.layer_scale,
            shells: self.shells,
            transparency: self.transparency,
            shadows: self.shadows,
            has_dynamics: self.animation.is_some(),
            everything: self.everything,
            cast_into: None,
            has_host_shadows: false,
            picture: Some(PictureOptions {
                aovs: self.aovs,
                has_ssao: self.screen_occlusion.is_some(),
                tonemap: self.tonemap,
                hdr_format: self.hdr_format,
                shows_environment: self.shows_environment(),
            }),
        }
    }

    /// Says which option is out of its range or names what the file lacks.
    pub(super) fn check(&self, asset: &Asset) -> Result<(), RenderError> {
        let wrong = |option, problem: String| Err(RenderError::Option { option, problem });
        if self.size.contains(&0) {
            return wrong(
                "size",
                format!("{}x{} has no pixels; both sides must be at least 1", self.size[0], self.size[1]),
            );
        }
        if !matches!(self.msaa, 1 | 4) {
            return wrong("msaa", format!("{} samples are not supported; choose 1 or 4", self.msaa));
        }
        if let Some(occlusion) = self.screen_occlusion {
            occlusion.check()?;
        }
        if self.layers.is_some_and(|layers| !(1..=MAX_LAYERS).contains(&layers)) {
            return wrong("layers", format!("the number of shells must be 1 to {MAX_LAYERS}"));
        }
        if !(self.layer_scale > 0.0 && self.layer_scale.is_finite()) {
            return wrong("layer scale", format!("{} is not a finite number greater than 0", self.layer_scale));
        }
        let EnvironmentLight { strength, rotation_deg, .. } = self.environment;
        if !(strength >= 0.0 && strength.is_finite() && rotation_deg.is_finite()) {
            return wrong("environment", "strength and rotation must be finite, the strength not negative".to_owned());
        }
        if let Some(problem) = self.environment_quality.problem() {
            return wrong("environment quality", problem);
        }
        if self.lights.iter().any(|light| !light.is_finite()) {
            return wrong("lights", "places, directions and intensities must be finite".to_owned());
        }
        let Shadows { resolution_px, filter_px, .. } = self.shadows;
        if !SHADOW_RESOLUTIONS_PX.contains(&resolution_px) || !SHADOW_FILTERS_PX.contains(&filter_px) {
            let (maps, filters) = (SHADOW_RESOLUTIONS_PX, SHADOW_FILTERS_PX);
            let problem = format!(
                "maps have {} to {} texels a side, filters a radius of {} to {}",
                maps.start(),
                maps.end(),
                filters.start(),
                filters.end()
            );
            return wrong("shadows", problem);
        }
        let times_s = [self.time_s, self.previous_time_s.unwrap_or_default()];
        if !times_s.iter().all(|time_s| time_s.is_finite()) || !self.exposure_ev.is_finite() {
            return wrong("time and exposure", "must be finite numbers".to_owned());
        }
        if self.background == Background::Transparent && !self.hdr_format.has_alpha() {
            return wrong("background", "b10g11r11 has no alpha; use rgba16f for a transparent background".to_owned());
        }
        for (option, index, count) in [
            ("scene", self.scene, asset.scenes.len()),
            ("animation", self.animation, asset.animations.len()),
            ("variant", self.variant, asset.variants.len()),
        ] {
            if let Some(index) = index.filter(|index| *index >= count) {
                return wrong(option, format!("there is no {option} {index}; the file has {count}"));
            }
        }
        Ok(())
    }
}

/// Sides of a shadow map, texels.
pub const SHADOW_RESOLUTIONS_PX: RangeInclusive<u32> = 64..=4096;
/// Radii of the filter of shadows, texels.
pub const SHADOW_FILTERS_PX: RangeInclusive<u32> = 1..=3;

/// Shadows of lights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Shadows {
    /// Lights cast shadows where something can receive them.
    pub are_cast: bool,
    /// Texels of a map's sides, in [`SHADOW_RESOLUTIONS_PX`]. A map takes 4 bytes a texel, 28 where something lets light
    /// through in part.
    pub resolution_px: u32,
    /// Radius of the filter, texels of the map, in [`SHADOW_FILTERS_PX`]. A radius of r reads 4 r^2 texels by r^2 fetches
    /// a lit fragment and light.
    pub filter_px: u32,
}

impl Default for Shadows {
    fn default() -> Self {
        Self { are_cast: true, resolution_px: 1024, filter_px: 2 }
    }
}

/// How layers that blend are laid over each other. The default is right wherever they cross and whatever the order of the
/// file; the others are the ways of other renderers, there to be measured against it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Transparency {
    /// Sample by sample, sorted by depth, in colours. Falls back to [`Self::Sorted`] where fragment shaders cannot write
    /// memory.
    #[default]
    PerPixel,
    /// Sample by sample, unsorted: by weights that fall with the distance (McGuire & Bavoil 2013).
    Weighted,
    /// Object by object, each side of a surface by its mean depth; what passes is dimmed, not tinted.
    Sorted,
}

/// How shells are made and drawn. The default is what vair is for; the others are the ways of other renderers, and ours
/// without one of its parts, there to be measured against it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Shells {
    /// What a shell knows of the strands.
    pub sampling: ShellSampling,
    /// From strands to opacity.
    pub alpha: ShellAlpha,
    /// How shells reach the device.
    pub submission: ShellSubmission,
    /// Which shell comes first.
    pub order: ShellOrder,
}

/// What a shell knows of the strands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum ShellSampling {
    /// All that the view ray meets in the slab that the shell stands for.
    #[default]
    Slab,
    /// What is at one point of it.
    Point,
}

/// From strands to opacity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum ShellAlpha {
    /// Edges as wide as a pixel; from afar the mean coverage, with what the shells of one strand have in common.
    #[default]
    Correlated,
    /// The same, but from afar every shell's mean coverage as if it had nothing in common with the next.
    Independent,
    /// A strand or nothing.
    Step,
}

/// How shells reach the device.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum ShellSubmission {
    /// One draw with an instance a shell.
    #[default]
    Instanced,
    /// One draw a shell.
    Draws,
    /// One draw of a mesh that holds its vertices once a shell.
    Duplicated,
}

/// Which shell comes first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum ShellOrder {
    /// The outermost: depth tests then reject what it hides. Fur that blends starts with the innermost all the same.
    #[default]
    OuterFirst,
    /// The innermost.
    InnerFirst,
    /// The innermost, and shells blend over each other whatever the material says.
    Blended,
}

/// Tone curve from linear radiance to display light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Tonemap {
    /// Clamped.
    None,
    /// ACES, Hill's fit, exposed by the usual 1 / 0.6.
    Aces,
    /// AgX.
    Agx,
    /// Khronos PBR Neutral: colours below 0.8 stay as they are.
    Neutral,
}

impl Tonemap {
    /// Value of the shader's OPERATOR constant.
    pub(crate) fn operator(self) -> u32 {
        match self {
            Self::None => 0,
            Self::Aces => 1,
            Self::Agx => 2,
            Self::Neutral => 3,
        }
    }
}

/// What is shown where nothing was drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Background {
    /// The environment.
    Environment,
    /// Nothing: the picture has an alpha channel.
    Transparent,
    /// A colour, linear RGB, shown as it is (no tone curve). With [`HdrFormat::B10g11r11`], which cannot tell what was
    /// drawn, it is light instead: exposure and tone curve apply.
    Color(Vec3),
}

/// Format of the linear colour target.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum HdrFormat {
    /// Half floats with alpha.
    Rgba16f,
    /// 11, 11 and 10 bits without alpha: half the memory, 2 % (R, G) and 5 % (B) loss over 20 blends.
    B10g11r11,
}

impl HdrFormat {
    /// Whether coverage is kept beside colour.
    pub fn has_alpha(self) -> bool {
        self == Self::Rgba16f
    }

    /// The Vulkan format.
    pub(crate) fn vulkan(self) -> ash::vk::Format {
        match self {
            Self::Rgba16f => ash::vk::Format::R16G16B16A16_SFLOAT,
            Self::B10g11r11 => ash::vk::Format::B10G11R11_UFLOAT_PACK32,
        }
    }
}
