//! A host's frame: vair records into the host's command buffers, inside the host's own passes, and the host submits.
//!
//! ```no_run
//! use vair::gpu::{HostCommands, HostDevice, HostRendering, vk};
//! use vair::render::{DeviceScene, FrameDesc, InstanceDesc, Target, View};
//! use vair::{Gpu, Renderer, Scene};
//!
//! # fn frame(host: HostDevice, commands: vk::CommandBuffer, view: View) -> Result<(), vair::Error> {
//! // SAFETY: the host's handles belong together and outlive `gpu`.
//! let mut renderer = Renderer::with_gpu(unsafe { Gpu::from_host(host)? });
//! let mut scene = DeviceScene::new(Scene::gallery());
//! let knot = scene.add(&InstanceDesc::default())?;
//!
//! // SAFETY: the command buffer is recording, outside of a pass, and is submitted after this.
//! let mut frame = renderer.frame(unsafe { HostCommands::recording(commands) })?;
//! let target = Target::hdr(1);
//! frame.prepare(&mut scene, &FrameDesc { views: &[view], target, ..FrameDesc::default() })?;
//! // The host begins its pass on its colour and depth.
//! // SAFETY: `commands` is inside a dynamic rendering pass of that target.
//! let pass = unsafe { HostRendering::begun(commands, target.formats()) };
//! frame.draw_opaque(pass, &scene, 0)?;
//! frame.draw_fur(pass, &scene, 0)?;
//! frame.draw_transparent(pass, &scene, 0)?;
//! // The host ends its pass and its command buffer, and submits. Once its fence has passed:
//! let token = frame.finish()?;
//! // SAFETY: the device is done with the frame.
//! unsafe { renderer.gpu().frame_passed(token)? };
//! # Ok(())
//! # }
//! ```

use super::device_scene::{DeviceScene, DrawnScene, FrameRequest, HostShadowAtlas};
use super::pass::{Pass, draw, shadow_map, skinning, strand_dynamics};
use super::pass::{translucent_shadow_back, translucent_shadow_front, translucent_shadow_transmittance};
use super::plan::{Draw, PlanOptions};
use super::target::{DepthOrder, Target};
use super::view::View;
use super::{
    MAX_LAYERS, RenderError, Renderer, SHADOW_FILTERS_PX, SHADOW_RESOLUTIONS_PX, Shadows, Shells, Transparency,
};
use crate::gpu::{
    Encoder, FrameToken, HostCommands, HostPass, HostRendering, Image, Sampler, SamplerDesc, TargetFormats,
};
use crate::math::Sphere;
use crate::scene::{Light, ShadowMap};
use crate::shader::layout::ShadowSource;
use ash::vk;
use glam::Mat4;

/// Frames whose tokens have not been given back, at most: more are a leak.
pub const MAX_FRAMES_IN_FLIGHT: usize = 64;

/// What a host's frame is.
#[derive(Clone, Copy)]
pub struct FrameDesc<'a> {
    /// Cameras, lights' eyes among them, at least one; draws name them by their place here. The first one decides where
    /// vair's own shadow maps are fine.
    pub views: &'a [View],
    /// What is drawn into.
    pub target: Target,
    /// Punctual lights, in world space.
    pub lights: &'a [Light],
    /// Shadows of these lights, in maps of vair's own.
    pub shadows: Shadows,
    /// What vair's shadow maps show, in world space: all that casts or receives a shadow. A host that knows a sphere that
    /// stays keeps the maps' texels in place while things move; `None`: what is around all instances now.
    pub shadow_bounds: Option<Sphere>,
    /// The host's own shadow maps, in the place of vair's; read where [`Shadows::are_cast`] is on.
    pub host_shadows: Option<HostShadows<'a>>,
    /// The host's depth format for [`Frame::cast_shadows`], where it casts vair's things into maps of its own.
    pub cast_into: Option<CastTarget>,
    /// Seconds since the last frame, for strands that lag behind their roots; 0 holds them still.
    pub step_s: f32,
    /// Shells of fur; `None` = what each material says.
    pub layers: Option<u32>,
    /// Factor on the shells that each material says, > 0.
    pub layer_scale: f32,
    /// How shells are drawn.
    pub shells: Shells,
}

impl Default for FrameDesc<'_> {
    /// No view yet; half floats at 4 samples, shadows, no lights.
    fn default() -> Self {
        Self {
            views: &[],
            target: Target::hdr(4),
            lights: &[],
            shadows: Shadows::default(),
            shadow_bounds: None,
            host_shadows: None,
            cast_into: None,
            step_s: 0.0,
            layers: None,
            layer_scale: 1.0,
            shells: Shells::default(),
        }
    }
}

/// A depth target of the host's that vair's things cast into.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct CastTarget {
    /// Its format.
    pub format: vk::Format,
    /// Which depth is near.
    pub depth_order: DepthOrder,
}

/// Shadow maps that the host has made: one image, in which each map has a square tile.
#[derive(Clone, Copy)]
pub struct HostShadows<'a> {
    /// Depth of the nearest surfaces, reversed (1 at the light), in shader-read layout.
    pub image: &'a Image,
    /// Tiles; those of one light stand together, the finest first.
    pub maps: &'a [HostShadowMap],
}

/// A shadow map of the host's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HostShadowMap {
    /// Index of the light.
    pub light: usize,
    /// Clip space up, reversed depth; w is 1 for parallel rays and otherwise the distance along the axis, metres.
    pub clip_from_world: Mat4,
    /// Top left corner of the tile, texels.
    pub origin_px: [u32; 2],
    /// Its side, texels.
    pub size_px: u32,
}

/// A frame being recorded. [`Self::prepare`] comes first, outside of a pass; draws come inside the host's own passes, in the
/// order that it likes; [`Self::finish`] last. One that is dropped instead keeps what it used until the device's end.
///
/// It is `Send`, as all of a frame is: recording may move to another thread, and stays with one at a time.
pub struct Frame<'r> {
    renderer: &'r mut Renderer,
    encoder: Encoder,
    sampler: Option<Sampler>,
}

impl Renderer {
    /// Starts a frame of a host's.
    ///
    /// # Errors
    /// When [`MAX_FRAMES_IN_FLIGHT`] frames wait for their tokens.
    pub fn frame(&mut self, commands: HostCommands) -> Result<Frame<'_>, RenderError> {
        let waiting = self.gpu().host_frames_in_flight();
        if waiting >= MAX_FRAMES_IN_FLIGHT {
            let problem = format!("{waiting} have not passed; give each token to `Gpu::frame_passed` or to a timeline");
            return Err(RenderError::Option { option: "frames in flight", problem });
        }
        let encoder = self.gpu().encoder_on_host("vair", commands);
        Ok(Frame { renderer: self, encoder, sampler: None })
    }
}

impl Frame<'_> {
    /// Uploads what has changed, poses, moves strands, casts vair's own shadow maps: all that happens outside of passes. A
    /// scene is prepared once a frame, for all its views.
    ///
    /// # Errors
    /// A view, target, light or option that cannot be right, named before anything is recorded; a scene that lives on
    /// another device; a device out of memory or lost.
    pub fn prepare(&mut self, scene: &mut DeviceScene, desc: &FrameDesc) -> Result<(), RenderError> {
        let options = self.check(scene, desc)?;
        let gpu = self.renderer.gpu().clone();
        scene.device = Some(gpu.id());
        scene.list_parts();
        let Some(first) = desc.views.first() else { return Ok(()) };
        if options.has_motion() && scene.staging.previous.len() != scene.staging.instances.len() {
            scene.staging.previous.clone_from(&scene.staging.instances);
        }
        scene.staging.lights.clear();
        scene.staging.lights.extend_from_slice(desc.lights);
        let host_maps = desc.host_shadows.map(|shadows| shadows.maps.iter().map(shadow_map_of).collect::<Vec<_>>());
        let camera = first.camera();
        scene.staging.update_for_host(&scene.scene, &options, &camera, desc.shadow_bounds, host_maps);

        let sources: Vec<ShadowSource> =
            desc.host_shadows.iter().flat_map(|shadows| shadows.maps.iter().map(source_of)).collect();
        if desc.host_shadows.is_some() && self.sampler.is_none() {
            self.sampler = Some(gpu.sampler(&nearest())?);
        }
        let host_shadows = desc.host_shadows.zip(self.sampler.as_ref()).map(|(shadows, sampler)| HostShadowAtlas {
            image: shadows.image,
            sampler,
            sources: &sources,
        });
        let step = scene.step(desc.step_s);
        let (environment, quality) = scene.environment();
        let (environment, host_environment) = (environment.clone(), scene.host_environment().cloned());
        let request = FrameRequest {
            views: desc.views,
            environment: &environment,
            quality,
            host_environment: host_environment.as_ref(),
            host_shadows,
            shows_environment_mean: false,
            ssao: None,
            step,
        };
        let DeviceScene { scene: content, staging, resources, .. } = scene;
        resources.prepare(&mut self.renderer.shared, &mut self.encoder, content, staging, &request)?;
        let drawn = DrawnScene { scene: content, staging, resources };
        skinning::record(&mut self.encoder, &drawn);
        strand_dynamics::record(&mut self.encoder, &drawn);
        if desc.host_shadows.is_none() {
            shadow_map::record(&mut self.encoder, &drawn);
            translucent_shadow_front::record(&mut self.encoder, &drawn);
            translucent_shadow_back::record(&mut self.encoder, &drawn);
            translucent_shadow_transmittance::record(&mut self.encoder, &drawn);
            resources.make_shadows_readable(&mut self.encoder);
        }
        self.encoder.before_host_passes();
        resources.keep();
        scene.prepared = Some((self.encoder.number(), desc.views.len()));
        scene.keep_previous();
        match self.encoder.take_problem() {
            Some(problem) => {
                scene.resources.fail();
                scene.prepared = None;
                Err(problem.into())
            }
            None => Ok(()),
        }
    }

    /// Draws opaque and masked surfaces, the skin under fur among them; depth is tested and written.
    ///
    /// # Errors
    /// A scene that was not prepared in this frame, a view that it was not prepared for, a pass whose targets are not of the
    /// formats and samples that it was prepared for.
    pub fn draw_opaque(&mut self, pass: HostRendering, scene: &DeviceScene, view: usize) -> Result<(), RenderError> {
        self.draw(pass, scene, view, Pass::Opaque)
    }

    /// Draws shells of fur that does not blend; depth is tested and written.
    ///
    /// # Errors
    /// Those of [`Self::draw_opaque`].
    pub fn draw_fur(&mut self, pass: HostRendering, scene: &DeviceScene, view: usize) -> Result<(), RenderError> {
        self.draw(pass, scene, view, Pass::Fur)
    }

    /// Draws what blends over what there is, from far to near as objects are sorted; depth is tested and not written. What
    /// passes is dimmed, not tinted.
    ///
    /// # Errors
    /// Those of [`Self::draw_opaque`].
    pub fn draw_transparent(
        &mut self,
        pass: HostRendering,
        scene: &DeviceScene,
        view: usize,
    ) -> Result<(), RenderError> {
        self.draw(pass, scene, view, Pass::Transparent)
    }

    /// Draws motion vectors of what is not farther than the depth that there is: after [`Self::draw_opaque`] and
    /// [`Self::draw_fur`], in a pass on [`Target::motion`] and that depth.
    ///
    /// # Errors
    /// Those of [`Self::draw_opaque`]; a target without motion.
    pub fn draw_motion(&mut self, pass: HostRendering, scene: &DeviceScene, view: usize) -> Result<(), RenderError> {
        self.draw(pass, scene, view, Pass::GBuffer)
    }

    /// Draws depth alone of all that casts shadows, fur by its outermost strands, into a shadow map of the host's; `view` is
    /// the light's eye.
    ///
    /// # Errors
    /// Those of [`Self::draw_opaque`]; a frame without [`FrameDesc::cast_into`].
    pub fn cast_shadows(&mut self, pass: HostRendering, scene: &DeviceScene, view: usize) -> Result<(), RenderError> {
        self.draw(pass, scene, view, Pass::HostShadow)
    }

    /// Ends the frame. The host ends and submits its command buffers, and gives the token back when the device is done.
    ///
    /// # Errors
    /// Recording failed: what was recorded is valid, and something is missing in it. The token then is still the frame's,
    /// and comes back in [`RenderError::Frame`].
    pub fn finish(self) -> Result<FrameToken, RenderError> {
        let (token, recorded) = self.encoder.finish_on_host();
        match recorded {
            Ok(()) => Ok(token),
            Err(source) => Err(RenderError::Frame { token, source }),
        }
    }

    fn draw(
        &mut self,
        rendering: HostRendering,
        scene: &DeviceScene,
        view: usize,
        pass: Pass,
    ) -> Result<(), RenderError> {
        let wrong = |option, problem: String| Err(RenderError::Option { option, problem });
        let Some((_, views)) = scene.prepared.filter(|(frame, _)| *frame == self.encoder.number()) else {
            return wrong("scene", "was not prepared in this frame; call `prepare` first".to_owned());
        };
        let Some(prepared) = scene.resources.view(view).filter(|_| view < views) else {
            return wrong("view", format!("there is no view {view}; the scene was prepared for {views}"));
        };
        let options = scene.staging.options();
        let formats = match pass {
            Pass::GBuffer => match options.target.motion_formats() {
                Some(formats) => formats,
                None => return wrong("target.motion", "is not set; prepare the scene with a motion format".to_owned()),
            },
            Pass::HostShadow => match options.cast_into {
                Some(target) => TargetFormats::new([], Some(target.format), 1),
                None => return wrong("cast_into", "is not set; prepare the scene with a depth format".to_owned()),
            },
            _ => options.target.formats(),
        };
        if rendering.formats() != formats {
            let problem =
                format!("the host's pass has {:?} and the scene was prepared for {formats:?}", rendering.formats());
            return wrong("pass", problem);
        }
        let draws: &[Draw] = match pass {
            Pass::Transparent => scene.resources.far_to_near(view),
            pass => scene.staging.plan.draws_of(pass),
        };
        if draws.is_empty() {
            return Ok(());
        }
        let drawn = DrawnScene { scene: &scene.scene, staging: &scene.staging, resources: &scene.resources };
        let super::view::Viewport { origin, size } = prepared.viewport;
        let desc = HostPass { name: pass.name(), rendering, origin, size, is_y_down: prepared.is_y_down };
        self.encoder.host_pass(&desc, |pass| draw::record(pass, draws, &drawn, view));
        match self.encoder.take_problem() {
            Some(problem) => Err(problem.into()),
            None => Ok(()),
        }
    }

    /// Says what cannot be right, before anything is recorded.
    fn check(&self, scene: &DeviceScene, desc: &FrameDesc) -> Result<PlanOptions, RenderError> {
        let wrong = |option, problem: &str| Err(RenderError::Option { option, problem: problem.to_owned() });
        let gpu = self.renderer.gpu();
        if scene.device.is_some_and(|device| device != gpu.id()) {
            return wrong("scene", "lives on another device; make one for each device");
        }
        if desc.views.is_empty() {
            return wrong("views", "there is none; give at least one");
        }
        desc.views.iter().try_for_each(View::check)?;
        desc.target.check(gpu)?;
        if let Some(target) = desc.cast_into {
            target.check(gpu)?;
        }
        if desc.lights.iter().any(|light| !light.is_finite()) {
            return wrong("lights", "places, directions and intensities must be finite");
        }
        let Shadows { resolution_px, filter_px, .. } = desc.shadows;
        if !SHADOW_RESOLUTIONS_PX.contains(&resolution_px) || !SHADOW_FILTERS_PX.contains(&filter_px) {
            return wrong("shadows", "maps have 64 to 4096 texels a side, filters a radius of 1 to 3");
        }
        let is_sphere = |sphere: Sphere| sphere.radius > 0.0 && sphere.radius.is_finite() && sphere.center.is_finite();
        if !desc.shadow_bounds.is_none_or(is_sphere) {
            return wrong("shadow_bounds", "must be a finite sphere of a radius greater than 0, or None");
        }
        for map in desc.host_shadows.iter().flat_map(|shadows| shadows.maps) {
            if map.light >= desc.lights.len() || map.size_px == 0 || !map.clip_from_world.is_finite() {
                return wrong("host_shadows", "each map names a light of the frame, has texels and a finite matrix");
            }
        }
        if !(desc.step_s >= 0.0 && desc.step_s.is_finite()) {
            return wrong("step_s", "must be a finite number of seconds, 0 or more");
        }
        if desc.layers.is_some_and(|layers| !(1..=MAX_LAYERS).contains(&layers)) {
            return wrong("layers", "the number of shells must be 1 to 256");
        }
        if !(desc.layer_scale > 0.0 && desc.layer_scale.is_finite()) {
            return wrong("layer_scale", "must be a finite number greater than 0");
        }
        if desc.shells.submission == super::ShellSubmission::Duplicated {
            return wrong("shells", "a host's frame has no duplicated shells; submit them instanced or as draws");
        }
        Ok(PlanOptions {
            target: desc.target,
            layers: desc.layers,
            layer_scale: desc.layer_scale,
            shells: desc.shells,
            transparency: Transparency::Sorted,
            shadows: desc.shadows,
            has_dynamics: true,
            everything: false,
            cast_into: desc.cast_into,
            has_host_shadows: desc.host_shadows.is_some(),
            picture: None,
        })
    }
}

impl CastTarget {
    fn check(&self, gpu: &crate::gpu::Gpu) -> Result<(), RenderError> {
        if gpu.can_be_target(self.format, vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT) {
            return Ok(());
        }
        let problem = format!("this device cannot draw into {:?}; choose another depth format", self.format);
        Err(RenderError::Option { option: "cast_into", problem })
    }
}

/// What of a host's map a scene asks for: which light it is of.
fn shadow_map_of(map: &HostShadowMap) -> ShadowMap {
    ShadowMap {
        light: map.light,
        clip_from_world: map.clip_from_world,
        eye_in_world: glam::Vec3::ZERO,
        direction_to_light: glam::Vec3::Y,
        is_orthographic: map.clip_from_world.row(3) == glam::Vec4::W,
        texel_m: 0.0,
    }
}

fn source_of(map: &HostShadowMap) -> ShadowSource {
    // How far x in clip space changes a metre: a texel is 2 / size of it.
    let across = map.clip_from_world.row(0).truncate().length().max(f32::MIN_POSITIVE);
    ShadowSource {
        clip_from_world: map.clip_from_world.to_cols_array_2d(),
        origin_px: map.origin_px.map(|side| side as f32),
        size_px: map.size_px as f32,
        texel_m: 2.0 / (across * map.size_px as f32),
    }
}

/// Every texel of a shadow map is read as it is.
fn nearest() -> SamplerDesc {
    SamplerDesc {
        wrap: [vk::SamplerAddressMode::CLAMP_TO_EDGE; 2],
        mag: vk::Filter::NEAREST,
        min: vk::Filter::NEAREST,
        mip_mode: vk::SamplerMipmapMode::NEAREST,
        max_lod: 0.0,
        ..SamplerDesc::default()
    }
}
