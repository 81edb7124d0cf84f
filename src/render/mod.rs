//! From a scene to a picture.
//!
//! A frame goes one way: [`FrameOptions`] and a [`Scene`] make a [`Shot`] (pose, camera, light and the [`Plan`] of
//! what is needed), the resources make what the plan lists, and the frame records the passes.

mod aov;
mod cloth;
mod count;
mod environment;
mod exr;
mod file;
mod frame;
mod frame_data;
mod geometry;
mod left_out;
mod lit;
mod map;
mod material;
mod memory;
mod motion;
mod occlusion;
mod options;
mod pass;
mod picture;
mod pipeline;
mod plan;
mod previous;
mod report;
mod resources;
mod shadow;
mod stream;
mod sway;
mod table;
mod targets;
mod texture;

pub use aov::{AovPixels, Aovs, EMPTY_DEPTH_M};
pub use count::PassFragments;
pub use environment::{
    Backdrop, Behind, EnvironmentQuality, HARMONICS, PreparedEnvironment, make_environment, make_lobes,
    prepare_environment, prepare_lobes,
};
pub use file::write_file;
pub use left_out::LeftOut;
pub use map::StandIn;
pub use memory::PICTURE_FORMAT;
pub use occlusion::{MAX_OCCLUSION_SAMPLES, ScreenOcclusion};
pub use options::{
    Background, FrameOptions, HdrFormat, MAX_LAYERS, SHADOW_FILTERS_PX, SHADOW_RESOLUTIONS_PX, Shadows, ShellAlpha,
    ShellOrder, ShellSampling, ShellSubmission, Shells, Tonemap, Transparency,
};
pub use pass::transparency::ListUse;
pub use picture::{Picture, PictureFormat};
pub use pipeline::{ComputeSpec, DepthUse, PipelineSpec, Target};
pub use plan::{Deform, Draw, DrawKind, Pass, Plan, SurfaceUse, Sway, TextureUse};
pub use previous::Previous;
pub use report::{CoatReport, CpuPhases, FrameReport};
pub use shadow::ShadowPlan;
pub use stream::{Moment, Stream};
pub use table::Table;
pub use targets::Attachment;

use crate::asset::Asset;
use crate::gpu::{Encoder, Gpu, GpuError, GpuOptions, Image, ImageDesc};
use crate::scene::{self, Camera, LightLists, Lighting, Pose, Scene, SceneError, ShadowMaps};
use ash::vk;
use environment::{BackdropImage, EnvironmentMaps, LobeTable};
use frame_data::{FrameData, LightMaps};
use glam::Vec4;
use memory::PICTURE_NAME;
use motion::Motion;
use pass::screen_occlusion::Occluders;
use pass::tonemap::Display;
use pass::transparency::{Composition, Lists};
use pass::{Frame, Moving};
use resources::Resources;
use shadow::ShadowAtlas;
use std::borrow::Cow;
use std::path::PathBuf;
use std::time::Instant;
use sway::SwayMemory;
use targets::Targets;

/// Longest wait for one frame: a software device may take long, a lost one must not hang the caller.
const FRAME_TIMEOUT_MS: u64 = 600_000;

/// Why a picture could not be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The scene lacks what the options name.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An option is out of its range.
    #[error("{option}: {problem}")]
    Option {
        /// Which.
        option: &'static str,
        /// What is wrong and what to do.
        problem: String,
    },
    /// A picture could not be encoded.
    #[error("{format} encoder: {problem}")]
    Encode {
        /// File format.
        format: &'static str,
        /// What it said.
        problem: String,
    },
    /// A file name has no ending that names a picture format.
    #[error("{}: name the picture .png (display colour) or .exr (linear light)", path.display())]
    Ending {
        /// The file.
        path: PathBuf,
    },
    /// A picture could not be written.
    #[error("{}: {source}; choose a folder that exists and can be written", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Cause.
        source: std::io::Error,
    },
}

/// A scene at one moment through one camera, and what drawing it takes. Plain data, made without a device.
pub struct Shot {
    /// Where every node is.
    pub pose: Pose,
    /// Whose eye.
    pub camera: Camera,
    /// Lights and surroundings.
    pub lighting: Lighting,
    /// Where everything was before, where motion is asked for.
    pub previous: Option<Previous>,
    /// Bounding radius of what the scene shows, metres.
    pub radius_m: f32,
    /// What the frame needs.
    pub plan: Plan,
}

impl Shot {
    /// Poses, frames and plans.
    ///
    /// # Errors
    /// When an option is out of range or names what the scene lacks.
    pub fn new(scene: &Scene, options: &FrameOptions) -> Result<Self, RenderError> {
        options.check(scene.asset())?;
        let asset = &scene.asset();
        let scene_index = options.scene.unwrap_or(asset.default_scene);
        let time_s = clip_time_s(asset, options.animation, options.time_s);
        let pose = scene::pose(asset, options.animation, time_s);
        let instances = scene::instances(asset, scene_index, &pose, options.variant);
        options.check_coats(scene, &instances)?;
        let shown = scene.outline(scene_index, options.animation);
        let aspect = options.size[0] as f32 / options.size[1] as f32;
        let mut lights = scene::lights(asset, scene_index, &pose);
        lights.extend(options.lights.iter().cloned());
        let lighting = Lighting { lights, surroundings: options.surroundings.clone() };
        let camera = scene::camera(asset, scene_index, &pose, &options.camera, aspect, &shown)?;
        let ball = scene::ball(&shown);
        let reach = LightLists::new(&lighting.lights, instances.iter().map(|instance| scene.ball(instance, ball)));
        let maps = match ball.filter(|_| options.shadows.are_cast) {
            Some(ball) => {
                let casts = |light| reach.is_used(light);
                scene::shadow_maps(&lighting.lights, casts, ball, &camera, options.shadows.resolution_px)
            }
            None => ShadowMaps::default(),
        };
        Ok(Self {
            camera,
            previous: Previous::new(scene, &instances, options)?,
            radius_m: shown.bounds().sphere().radius,
            plan: Plan::new(scene, instances, reach, maps, options),
            lighting,
            pose,
        })
    }

    /// What the camera sees of the surroundings.
    fn backdrop(&self, size: [u32; 2]) -> Backdrop {
        Backdrop::new(&self.lighting.surroundings, &self.camera, size)
    }
}

/// Beyond its end a clip starts again.
fn clip_time_s(asset: &Asset, animation: Option<usize>, time_s: f32) -> f32 {
    match animation.map(|index| asset.animations[index].duration_s) {
        Some(duration_s) if duration_s > 0.0 && time_s > duration_s => time_s.rem_euclid(duration_s),
        _ => time_s,
    }
}

/// What one frame reads, made and not yet recorded.
struct Prepared {
    motion: Motion,
    data: FrameData,
    tonemap: PipelineSpec,
}

/// Renders scenes on one device. What a scene keeps there stays until another scene is rendered.
pub struct Renderer {
    gpu: Gpu,
    resources: Resources,
    targets: Option<Targets>,
    picture: Option<Image>,
    /// Which scene the resources belong to.
    scene: Option<u64>,
    /// Light from all around, of the last frame.
    environment: Option<EnvironmentMaps>,
    /// Shadow maps, of the last frame.
    atlas: Option<ShadowAtlas>,
    lobes: Option<LobeTable>,
    /// What stands behind the scene.
    backdrop: Option<BackdropImage>,
    /// Strands that lag behind.
    sway: SwayMemory,
    /// What blends, where the last frame had any.
    lists: Option<Lists>,
}

impl Renderer {
    /// On a device of its own.
    ///
    /// # Errors
    /// When there is no usable Vulkan 1.3 device; the error says what each one lacks.
    pub fn new(options: &GpuOptions) -> Result<Self, RenderError> {
        Self::with_gpu(Gpu::new(options)?)
    }

    /// On a device that is there already, such as the host's ([`Gpu::from_host`]).
    ///
    /// # Errors
    /// None: nothing is made before a plan asks for it.
    pub fn with_gpu(gpu: Gpu) -> Result<Self, RenderError> {
        let resources = Resources::new(&gpu);
        Ok(Self {
            resources,
            gpu,
            targets: None,
            picture: None,
            scene: None,
            environment: None,
            atlas: None,
            lobes: None,
            backdrop: None,
            sway: SwayMemory::default(),
            lists: None,
        })
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Text of every pipeline made so far: whole state and interface, sorted.
    pub fn pipeline_descriptions(&self) -> Vec<String> {
        let mut all: Vec<String> =
            self.resources.pipelines().map(|pipeline| pipeline.description().to_owned()).collect();
        all.sort();
        all
    }

    /// One picture, waited for.
    ///
    /// # Errors
    /// Those of [`Shot::new`] and of the device.
    pub fn render(&mut self, scene: &Scene, options: &FrameOptions) -> Result<Picture, RenderError> {
        Ok(self.render_reported(scene, options, false)?.0)
    }

    /// One picture and its report; `keep_radiance` reads the linear colour back, too.
    ///
    /// # Errors
    /// Those of [`Shot::new`] and of the device.
    pub fn render_reported(
        &mut self,
        scene: &Scene,
        options: &FrameOptions,
        keep_radiance: bool,
    ) -> Result<(Picture, FrameReport), RenderError> {
        let (mut cpu, mut clock, before) = (CpuPhases::default(), Instant::now(), self.gpu.calls());
        let options = &*self.options_here(options);
        let shot = Shot::new(scene, options)?;
        cpu.plan_ms = lap_ms(&mut clock);
        let target = self.take_picture_target(options.size)?;
        // Again where more blends than there was room for, which is known once it is drawn.
        let times = loop {
            let mut encoder = self.gpu.encoder("frame")?;
            let prepared = self.prepare(scene, &shot, options, target.format())?;
            cpu.prepare_ms += lap_ms(&mut clock);
            self.record_prepared(&mut encoder, scene, &shot, options, prepared, &target)?;
            cpu.record_ms += lap_ms(&mut clock);
            let submission = encoder.submit()?;
            cpu.submit_ms += lap_ms(&mut clock);
            let times = submission.wait(FRAME_TIMEOUT_MS)?;
            cpu.wait_ms += lap_ms(&mut clock);
            if self.larger_lists()?.is_none() {
                break times;
            }
        };
        let calls = self.gpu.calls().since(&before);

        let mut radiance = Vec::new();
        if keep_radiance && let Some(targets) = &self.targets {
            radiance = decode_radiance(options.hdr_format, &self.gpu.read_image(targets.hdr())?);
        }
        let picture = Picture {
            size: options.size,
            rgba: self.gpu.read_image(self.picture.insert(target))?,
            radiance,
            behind: match options.background {
                Background::Environment => match shot.lighting.surroundings.constant_radiance() {
                    Some(radiance) => Behind::Color(radiance),
                    None => Behind::Environment(shot.backdrop(options.size)),
                },
                Background::Color(color) => Behind::Color(color),
                Background::Transparent => Behind::Transparent,
            },
            aovs: match &self.targets {
                Some(Targets { guide: Some(guide), occlusion, .. }) if options.aovs.any() => {
                    AovPixels::read(&self.gpu, guide, occlusion.as_ref(), &shot.camera, options)?
                }
                _ => AovPixels::default(),
            },
        };
        let pipelines_ms = self.resources.pipelines().map(crate::gpu::Pipeline::creation_ms).sum();
        let mut report = FrameReport::new(scene, &shot.plan, times, cpu, pipelines_ms, self.gpu.memory(), calls);
        report.lists = self.lists.as_ref().map(Lists::in_use).transpose()?;
        Ok((picture, report))
    }

    /// Records one frame into an encoder, which may be on the host's own command buffer
    /// ([`Gpu::encoder_on_host`]); `target` is a colour attachment of `options.size`.
    ///
    /// # Errors
    /// Those of [`Shot::new`] and of the device.
    pub fn record(
        &mut self,
        encoder: &mut Encoder,
        scene: &Scene,
        options: &FrameOptions,
        target: &Image,
    ) -> Result<(), RenderError> {
        let options = &*self.options_here(options);
        let shot = Shot::new(scene, options)?;
        let prepared = self.prepare(scene, &shot, options, target.format())?;
        self.record_prepared(encoder, scene, &shot, options, prepared, target)
    }

    /// Moves strands that lag behind on to `options.time_s` without drawing anything, on a submission of its own that is
    /// waited for; where nothing sways it does nothing.
    ///
    /// A frame or step of the same clip follows the one before where its time is later by at most 0.1 s, and holds still
    /// where it is the same; at any other time strands start from rest. Shorter steps follow the motion more closely.
    ///
    /// # Errors
    /// Those of [`Shot::new`] and of the device.
    pub fn advance(&mut self, scene: &Scene, options: &FrameOptions) -> Result<(), RenderError> {
        let mut shot = Shot::new(scene, options)?;
        let Plan { deforms, sways, .. } = &mut shot.plan;
        if sways.is_empty() {
            return Ok(());
        }
        // Strands only ask where their roots are.
        deforms.retain(|deform| {
            (deform.stream, deform.moment) == (Stream::Position, Moment::Frame)
                && sways.iter().any(|sway| sway.instance == deform.instance)
        });
        let motion = self.prepare_motion(scene, &shot, options)?;
        let mut encoder = self.gpu.encoder("advance")?;
        let moving = Moving { scene, shot: &shot, resources: &self.resources, motion: &motion };
        frame::record_motion(&mut encoder, &moving);
        encoder.submit()?.wait(FRAME_TIMEOUT_MS)?;
        self.keep(scene, options);
        Ok(())
    }

    /// Makes what the shot needs and is not there yet.
    fn prepare(
        &mut self,
        scene: &Scene,
        shot: &Shot,
        options: &FrameOptions,
        target_format: vk::Format,
    ) -> Result<Prepared, RenderError> {
        let lists = shot.plan.composition.is_some();
        // The old ones go first: two sets need not fit at once.
        if !self.targets.as_ref().is_some_and(|targets| targets.fit(options, lists)) {
            self.targets = None;
        }
        let larger = self.larger_lists()?;
        if larger.is_some() || !self.lists.as_ref().is_some_and(|kept| lists && kept.fit(options.size)) {
            self.lists = None;
        }
        let motion = self.prepare_motion(scene, shot, options)?;
        if self.targets.is_none() {
            self.targets = Some(Targets::new(&self.gpu, options, lists)?);
        }
        if lists && self.lists.is_none() {
            let capacity = larger.unwrap_or(Lists::first_capacity(options.size));
            self.lists = Some(Lists::new(&self.gpu, options.size, capacity)?);
        }
        let has_backdrop = options.shows_environment();
        let tonemap = PipelineSpec::tonemap(options.tonemap, options.hdr_format, target_format, has_backdrop);
        for spec in [Some(&tonemap), shot.plan.composition.as_ref()].into_iter().flatten() {
            self.resources.make_pipeline(spec)?;
        }
        // A format without alpha has the mean of the surroundings for its background.
        let is_shown = options.background == Background::Environment && !options.hdr_format.has_alpha();
        self.prepare_environment(shot.plan.is_lit() || is_shown, shot.plan.binds_lobes(), options)?;
        self.prepare_atlas(&shot.plan.shadows)?;
        let occlusion = self.targets.as_ref().and_then(|targets| targets.occlusion.as_ref());
        if occlusion.is_some() {
            for spec in PipelineSpec::screen_occlusion() {
                self.resources.make_pipeline(&spec)?;
            }
        }
        let maps = LightMaps {
            environment: self.environment.as_ref(),
            lobes: self.lobes.as_ref(),
            occlusion: occlusion.map(|targets| &targets.visibility),
            atlas: self.atlas.as_ref(),
        };
        let data = FrameData::new(&self.gpu, &self.resources, maps, scene, shot, options.size)?;
        Ok(Prepared { motion, data, tonemap })
    }

    /// Makes the images of the shadow maps, if the last frame had others.
    fn prepare_atlas(&mut self, plan: &ShadowPlan) -> Result<(), RenderError> {
        if !self.atlas.as_ref().is_some_and(|atlas| atlas.fits(plan)) {
            // The old ones go first: two need not fit at once.
            self.atlas = None;
            if plan.is_bound {
                self.atlas = Some(ShadowAtlas::new(&self.gpu, plan)?);
            }
        }
        Ok(())
    }

    /// Makes what the surroundings are on the device ahead of the first frame that they light, which may wait seconds for
    /// it where no cache has them.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub fn prepare_surroundings(&mut self, options: &FrameOptions) -> Result<(), RenderError> {
        self.prepare_environment(true, true, options)
    }

    /// Makes what the environment is on the device, if the last frame had another one; the old one goes first, as two
    /// need not fit at once.
    fn prepare_environment(
        &mut self,
        is_lit: bool,
        has_lobes: bool,
        options: &FrameOptions,
    ) -> Result<(), RenderError> {
        let (gpu, environment, quality) = (&self.gpu, &options.surroundings.environment, options.environment_quality);
        if is_lit && !self.environment.as_ref().is_some_and(|maps| maps.are_of(environment, quality)) {
            self.environment = None;
            self.environment = Some(EnvironmentMaps::new(gpu, environment, quality)?);
        }
        if has_lobes && !self.lobes.as_ref().is_some_and(|lobes| lobes.is_of(&quality)) {
            self.lobes = Some(LobeTable::new(gpu, &quality)?);
        }
        if options.shows_environment() && !self.backdrop.as_ref().is_some_and(|image| image.is_of(environment)) {
            self.backdrop = None;
            self.backdrop = Some(BackdropImage::new(gpu, environment)?);
        }
        Ok(())
    }

    /// Makes what the plan lists, and what moves in it. Until [`Self::keep`], nothing counts as made: a frame that failed
    /// half-way may have left streams and images without their contents.
    fn prepare_motion(&mut self, scene: &Scene, shot: &Shot, options: &FrameOptions) -> Result<Motion, RenderError> {
        if self.scene.take() != Some(scene.id()) {
            self.resources.forget_scene();
        }
        self.resources.prepare(scene, &shot.plan)?;
        Ok(Motion::new(&self.gpu, &self.resources, scene, shot, options, &mut self.sway)?)
    }

    /// The frame's commands are complete.
    fn keep(&mut self, scene: &Scene, options: &FrameOptions) {
        self.scene = Some(scene.id());
        self.sway.keep(scene, options);
    }

    fn record_prepared(
        &mut self,
        encoder: &mut Encoder,
        scene: &Scene,
        shot: &Shot,
        options: &FrameOptions,
        Prepared { motion, data, tonemap }: Prepared,
        target: &Image,
    ) -> Result<(), RenderError> {
        let (Some(targets), resources) = (&self.targets, &self.resources) else { return Ok(()) };
        let display =
            Display::new(&self.gpu, resources.pipeline(&tonemap), targets.hdr(), self.backdrop.as_ref(), target)?;
        let composition = Composition::new(&self.gpu, resources, &shot.plan, targets, self.lists.as_ref())?;
        let (composition, atlas) = (composition.as_ref(), self.atlas.as_ref());
        let frame = Frame { scene, shot, options, resources, motion: &motion, data: &data, atlas, composition };
        let occluders = match (&targets.guide, &targets.occlusion) {
            (Some(guide), Some(occlusion)) => Some(Occluders::new(&self.gpu, resources, guide, occlusion)?),
            _ => None,
        };
        frame::record(encoder, &frame, targets, occluders.as_ref(), &display);
        self.lists.iter_mut().for_each(Lists::keep_count);
        self.keep(scene, options);
        Ok(())
    }

    /// The options as this device can meet them: lists need fragment shaders that write memory.
    fn options_here<'a>(&self, options: &'a FrameOptions) -> Cow<'a, FrameOptions> {
        match self.gpu.info().fragment_stores || options.transparency == Transparency::Sorted {
            true => Cow::Borrowed(options),
            false => Cow::Owned(FrameOptions { transparency: Transparency::Sorted, ..options.clone() }),
        }
    }

    /// Entries that the last frame would have needed, where there can be more than there are. A frame of the host's tells
    /// the next one, once it has been drawn.
    fn larger_lists(&self) -> Result<Option<u32>, RenderError> {
        Ok(self.lists.as_ref().map(|lists| lists.larger_capacity(&self.gpu)).transpose()?.flatten())
    }

    /// The picture's image; put it back into `self.picture` for the next frame.
    fn take_picture_target(&mut self, size: [u32; 2]) -> Result<Image, RenderError> {
        if let Some(picture) = self.picture.take().filter(|picture| picture.size() == size) {
            return Ok(picture);
        }
        Ok(self.gpu.image(&ImageDesc {
            name: PICTURE_NAME,
            size,
            format: PICTURE_FORMAT,
            mip_levels: 1,
            samples: 1,
            usage: vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC,
            is_cube: false,
        })?)
    }
}

/// Milliseconds since `clock`, which starts anew.
fn lap_ms(clock: &mut Instant) -> f64 {
    let now = Instant::now();
    let ms = now.duration_since(*clock).as_secs_f64() * 1e3;
    *clock = now;
    ms
}

/// HDR texels as floats.
fn decode_radiance(format: HdrFormat, bytes: &[u8]) -> Vec<Vec4> {
    match format {
        HdrFormat::Rgba16f => bytes
            .chunks_exact(8)
            .map(|texel| {
                let half = |index: usize| half::f16::from_le_bytes([texel[index * 2], texel[index * 2 + 1]]).to_f32();
                Vec4::new(half(0), half(1), half(2), half(3))
            })
            .collect(),
        HdrFormat::B10g11r11 => bytes
            .chunks_exact(4)
            .map(|texel| {
                let word = u32::from_le_bytes([texel[0], texel[1], texel[2], texel[3]]);
                Vec4::new(
                    small_float(word & 0x7ff, 6),
                    small_float((word >> 11) & 0x7ff, 6),
                    small_float(word >> 22, 5),
                    1.0,
                )
            })
            .collect(),
    }
}

/// Unsigned float of five exponent bits and `mantissa_bits` (Vulkan 1.3, "Unsigned 11-Bit Floating-Point Numbers").
fn small_float(bits: u32, mantissa_bits: u32) -> f32 {
    let mantissa = (bits & ((1 << mantissa_bits) - 1)) as f32 / (1 << mantissa_bits) as f32;
    match bits >> mantissa_bits {
        0 => mantissa * 2f32.powi(-14),
        31 if mantissa == 0.0 => f32::INFINITY,
        31 => f32::NAN,
        exponent => (1.0 + mantissa) * 2f32.powi(exponent as i32 - 15),
    }
}
