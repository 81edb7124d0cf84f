//! Options that choose a scene and a view of it; `render` and `inspect` share them.

use super::quality::Quality;
use super::values::{self, Layers};
use super::{UsageError, output};
use anyhow::{Context, Result};
use clap::{Args, ValueEnum};
use glam::Vec3;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use vair::asset::procedural::GALLERY_CAMERA;
use vair::asset::{Asset, Environment, LoadOptions};
use vair::material::Look;
use vair::render::{
    Aovs, Background, EnvironmentQuality, FrameOptions, HdrFormat, ScreenOcclusion, Shadows, Shells, Tonemap,
    Transparency,
};
use vair::scene::{self, CameraChoice, EnvironmentLight, Scene, SceneError};

/// What to show.
#[derive(Debug, Args)]
pub struct SceneArguments {
    /// A .gltf or .glb file; without one, the embedded gallery.
    #[arg(value_name = "SCENE")]
    scene_file: Option<PathBuf>,
    /// Materials for glTF material names, in TOML.
    #[arg(long, value_name = "FILE.toml")]
    look: Option<PathBuf>,
    /// A preset for every material, or for one.
    #[arg(long, value_name = "NAME[=MATERIAL]")]
    preset: Option<String>,
    /// Lets a scene or look read files outside its own folder.
    #[arg(long)]
    allow_outside: bool,
    /// Most memory that a scene's data may take: bytes, or with KiB, MiB, GiB.
    #[arg(long, value_name = "BYTES", default_value = "4GiB", value_parser = values::bytes)]
    memory_limit: u64,
    /// Scene of the file, by name or index.
    #[arg(long, value_name = "NAME/INDEX")]
    scene: Option<String>,
    /// Animation clip, by name or index; with --time or --frames, the first one where none is named.
    #[arg(long, value_name = "NAME/INDEX")]
    animation: Option<String>,
    /// Seconds into the clip.
    #[arg(long, value_name = "S", default_value = "0", value_parser = values::finite, allow_negative_numbers = true)]
    time: f32,
    /// KHR_materials_variants variant, by name or index.
    #[arg(long, value_name = "NAME/INDEX")]
    variant: Option<String>,
    /// Pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = values::size)]
    size: [u32; 2],
    /// A camera of the file, by name or index; without one, the scene is framed.
    #[arg(long, value_name = "NAME/INDEX", conflicts_with_all = ["orbit", "target", "fov"])]
    camera: Option<String>,
    /// Eye on a sphere around the target: degrees around Y, degrees from Y, metres.
    #[arg(long, value_name = "THETA,PHI,RADIUS", value_parser = values::orbit, allow_hyphen_values = true)]
    orbit: Option<(f32, f32, Option<f32>)>,
    /// What the eye looks at; without one, the middle of the scene.
    #[arg(long, value_name = "X,Y,Z", value_parser = values::point, allow_hyphen_values = true)]
    target: Option<Vec3>,
    /// Vertical field of view in degrees.
    #[arg(long, value_name = "DEG", value_parser = values::field_of_view)]
    fov: Option<f32>,
    /// A bundle of samples and shells: draft 1 sample and half the shells, normal 4 samples and the shells that each
    /// material says, high 1.5 times the shells, reference 3 times.
    #[arg(long, value_enum, default_value_t = Quality::Normal, hide_possible_values = true, value_name = "draft/normal/high/reference")]
    quality: Quality,
    /// Shell layers of fur, or auto for what each material says; wins over --quality.
    #[arg(long, value_name = "N/auto", value_parser = values::layers)]
    layers: Option<Layers>,
    /// Samples a pixel; wins over --quality.
    #[arg(long, value_name = "1/4", value_parser = ["1", "4"])]
    msaa: Option<String>,
    /// Ambient occlusion from what the screen shows.
    #[arg(long, value_enum, default_value_t = Switch::Off, value_name = "on/off", hide_possible_values = true)]
    ssao: Switch,
    /// Layers beside the colour, in the same .exr: depth (metres along the view direction, 1e10 where nothing is), normal
    /// (world space), motion (pixels since the frame before, at --fps; x to the right, y down), occlusion (of --ssao on).
    #[arg(
        long,
        value_enum,
        value_delimiter = ',',
        value_name = "depth,normal,motion,occlusion",
        hide_possible_values = true
    )]
    aov: Vec<AovChoice>,
    /// Format of the linear colour target.
    #[arg(long, value_enum, default_value_t = HdrChoice::Rgba16f)]
    hdr_format: HdrChoice,
    /// Tone curve.
    #[arg(long, value_enum, default_value_t = TonemapChoice::Neutral)]
    tonemap: TonemapChoice,
    /// How layers that blend lie over each other: sorted pixel by pixel; weighted by depth (McGuire & Bavoil) and not
    /// sorted; or sorted object by object.
    #[arg(long, value_enum, default_value_t = TransparencyChoice::PerPixel)]
    transparency: TransparencyChoice,
    /// Exposure in stops.
    #[arg(long, value_name = "EV", default_value = "0", value_parser = values::finite, allow_negative_numbers = true)]
    exposure: f32,
    /// Whether lights cast shadows.
    #[arg(long, value_enum, default_value_t = Switch::On, value_name = "on/off", hide_possible_values = true)]
    shadows: Switch,
    /// Light from all around: an equirectangular .hdr or .exr picture; without one, the embedded studio.
    #[arg(long, value_name = "FILE.hdr/.exr")]
    env: Option<PathBuf>,
    /// Turns the environment around +Y, degrees, counter-clockwise seen from above.
    #[arg(long, value_name = "DEG", default_value = "0", value_parser = values::finite, allow_negative_numbers = true)]
    env_rotation: f32,
    /// Factor on the environment's radiance, at least 0.
    #[arg(long, value_name = "X", default_value = "1", value_parser = values::not_negative, allow_negative_numbers = true)]
    env_strength: f32,
    /// What stands behind: env, transparent, or a colour in sRGB.
    #[arg(long, value_name = "env/transparent/R,G,B", default_value = "env", value_parser = values::background)]
    background: Background,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Switch {
    On,
    Off,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum AovChoice {
    Depth,
    Normal,
    Motion,
    Occlusion,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum HdrChoice {
    Rgba16f,
    B10g11r11,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum TransparencyChoice {
    PerPixel,
    Weighted,
    Sorted,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum TonemapChoice {
    Aces,
    Agx,
    Neutral,
    None,
}

impl SceneArguments {
    /// Loads the scene and puts look and preset on it.
    pub fn load(&self) -> Result<Scene> {
        self.load_or(Scene::gallery)
    }

    /// Layers beside the colour.
    pub fn aovs(&self) -> Aovs {
        let has = |choice| self.aov.contains(&choice);
        Aovs {
            depth: has(AovChoice::Depth),
            normal: has(AovChoice::Normal),
            motion: has(AovChoice::Motion),
            occlusion: has(AovChoice::Occlusion),
        }
    }

    /// No file is named.
    pub fn is_embedded(&self) -> bool {
        self.scene_file.is_none()
    }

    /// The same with another scene in the place of the gallery.
    pub fn load_or(&self, embedded: impl FnOnce() -> Scene) -> Result<Scene> {
        if self.background == Background::Transparent && matches!(self.hdr_format, HdrChoice::B10g11r11) {
            let text = "--hdr-format b10g11r11 has no alpha; use rgba16f with --background transparent";
            return Err(UsageError(text).into());
        }
        let limits = self.limits();
        let mut scene = match &self.scene_file {
            Some(path) => Scene::load(path, &limits)?,
            None => embedded(),
        };
        if let Some(preset) = &self.preset {
            let (name, material) =
                preset.split_once('=').map_or((preset.as_str(), None), |(name, material)| (name, Some(material)));
            scene.apply(&Look::preset(name, material)?, Path::new("."), &limits)?;
        }
        if let Some(path) = &self.look {
            scene.apply_file(path, &limits)?;
        }
        Ok(scene)
    }

    /// What a loaded scene has to say, one line each.
    pub fn complain(&self, scene: &Scene) {
        for warning in &scene.asset().warnings {
            let file = self.scene_file.as_deref().unwrap_or(Path::new("gallery")).display();
            output::complain(&format!("warning: {file}: {warning}"));
        }
    }

    /// The frame that these options ask for; `moves` where it is the first of a sequence.
    pub fn frame_options(&self, scene: &Scene, moves: bool) -> Result<FrameOptions> {
        let file = || self.scene_file.as_deref().unwrap_or(Path::new("gallery")).display().to_string();
        let asset = scene.asset();
        let named = |text: &Option<String>, find: fn(&Asset, &str) -> Result<usize, SceneError>| {
            text.as_deref().map(|text| find(asset, text)).transpose().with_context(file)
        };
        let camera = named(&self.camera, scene::find_camera)?;
        Ok(FrameOptions {
            size: self.size,
            camera: camera.map_or_else(|| self.view(), CameraChoice::Index),
            scene: named(&self.scene, scene::find_scene)?,
            animation: named(&self.animation, scene::find_animation)?
                .or_else(|| ((moves || self.time != 0.0) && !asset.animations.is_empty()).then_some(0)),
            time_s: self.time,
            variant: named(&self.variant, scene::find_variant)?,
            tonemap: match self.tonemap {
                TonemapChoice::Aces => Tonemap::Aces,
                TonemapChoice::Agx => Tonemap::Agx,
                TonemapChoice::Neutral => Tonemap::Neutral,
                TonemapChoice::None => Tonemap::None,
            },
            exposure_ev: self.exposure,
            environment: self.environment()?,
            environment_quality: EnvironmentQuality::default(),
            lights: Vec::new(),
            shadows: Shadows { are_cast: self.shadows == Switch::On, ..Shadows::default() },
            background: self.background,
            hdr_format: match self.hdr_format {
                HdrChoice::Rgba16f => HdrFormat::Rgba16f,
                HdrChoice::B10g11r11 => HdrFormat::B10g11r11,
            },
            layers: match self.layers {
                Some(Layers::Count(layers)) => Some(layers),
                Some(Layers::Auto) | None => None,
            },
            layer_scale: if self.layers.is_some() { 1.0 } else { self.quality.layer_scale() },
            shells: Shells::default(),
            transparency: match self.transparency {
                TransparencyChoice::PerPixel => Transparency::PerPixel,
                TransparencyChoice::Weighted => Transparency::Weighted,
                TransparencyChoice::Sorted => Transparency::Sorted,
            },
            msaa: match self.msaa.as_deref() {
                Some("1") => 1,
                Some(_) => 4,
                None => self.quality.msaa(),
            },
            screen_occlusion: (self.ssao == Switch::On).then(ScreenOcclusion::default),
            aovs: self.aovs(),
            previous_time_s: None,
            everything: false,
        })
    }

    /// Whether the screen hides ambient light.
    pub fn has_screen_occlusion(&self) -> bool {
        self.ssao == Switch::On
    }

    /// What is all around; says what was odd about its file.
    fn environment(&self) -> Result<EnvironmentLight> {
        let mut light = EnvironmentLight::studio();
        if let Some(path) = &self.env {
            let (environment, warnings) = Environment::load(path, &self.limits())?;
            for warning in warnings {
                output::complain(&format!("warning: {}: {warning}", path.display()));
            }
            light = EnvironmentLight::new(Arc::new(environment));
        }
        Ok(EnvironmentLight { rotation_deg: self.env_rotation, strength: self.env_strength, ..light })
    }

    fn limits(&self) -> LoadOptions {
        LoadOptions { allow_outside: self.allow_outside, memory_limit_bytes: self.memory_limit }
    }

    /// Without a camera of the file.
    fn view(&self) -> CameraChoice {
        if self.orbit.is_none() && self.target.is_none() && self.fov.is_none() {
            // The gallery is composed for one view; its background is not what should fill the picture.
            return match self.scene_file {
                Some(_) => CameraChoice::Auto,
                None => CameraChoice::Named(GALLERY_CAMERA.to_owned()),
            };
        }
        let (theta_deg, phi_deg, radius_m) =
            self.orbit.unwrap_or((scene::DEFAULT_THETA_DEG, scene::DEFAULT_PHI_DEG, None));
        CameraChoice::Orbit {
            theta_deg,
            phi_deg,
            radius_m,
            target: self.target,
            fov_deg: self.fov.unwrap_or(scene::DEFAULT_FOV_DEG),
        }
    }
}
