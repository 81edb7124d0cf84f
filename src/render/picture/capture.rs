//! From a scene to a picture, waited for and read back.

use super::radiance::decode_radiance;
use super::{AovPixels, CpuPhases, FrameReport, Picture, PictureBackground, Skybox};
use crate::gpu::{Buffer, CallCounts, FrameTimes, Gpu, GpuError, Image, Memory, format_bytes};
use crate::render::renderer::Renderer;
use crate::render::{Background, FrameOptions, RenderError, Transparency};
use crate::scene::Scene;
use ash::vk;
use std::borrow::Cow;
use std::collections::HashMap;
use std::time::Instant;

/// Longest wait for one frame: a software device may take long, a lost one must not hang the caller.
pub(crate) const FRAME_TIMEOUT_MS: u64 = 600_000;

/// Buffers that images are read back through, kept from picture to picture.
#[derive(Default)]
pub(crate) struct Readback(HashMap<String, Buffer>);

impl Readback {
    /// Reads an image.
    ///
    /// # Errors
    /// Those of [`Gpu::read_image`].
    pub(super) fn read(&mut self, gpu: &Gpu, image: &Image) -> Result<Vec<u8>, GpuError> {
        let bytes = format_bytes(image.format(), image.size()).unwrap_or(0);
        if self.0.get(image.name()).is_none_or(|buffer| buffer.bytes() != bytes) {
            self.0.remove(image.name());
            let usage = vk::BufferUsageFlags::TRANSFER_DST;
            self.0.insert(image.name().to_owned(), gpu.buffer("readback", bytes, usage, Memory::Readback)?);
        }
        gpu.read_image_through(image, &self.0[image.name()])
    }
}

/// What drawing a frame took.
struct Drawn {
    times: FrameTimes,
    cpu: CpuPhases,
    calls: CallCounts,
}

impl Renderer {
    /// One picture, waited for.
    ///
    /// # Errors
    /// Those of [`FrameSetup::new`](crate::render::FrameSetup::new) and of the device.
    pub fn render(&mut self, scene: &Scene, options: &FrameOptions) -> Result<Picture, RenderError> {
        let options = &*self.options_here(options);
        self.draw(scene, options)?;
        self.read_picture(options, false)
    }

    /// One picture and its report; `keep_radiance` reads the linear colour back, too.
    ///
    /// # Errors
    /// Those of [`Self::render`].
    pub fn render_reported(
        &mut self,
        scene: &Scene,
        options: &FrameOptions,
        keep_radiance: bool,
    ) -> Result<(Picture, FrameReport), RenderError> {
        let options = &*self.options_here(options);
        let before = self.gpu().calls();
        let Drawn { times, cpu, mut calls } = self.draw(scene, options)?;
        calls = calls.since(&before);
        let picture = self.read_picture(options, keep_radiance)?;
        let Some(setup) = self.picture.setup() else { return Err(missing("the frame")) };
        let (pipelines_ms, memory) = (self.shared.pipelines.creation_ms(), self.gpu().memory());
        let mut report = FrameReport::new(scene, setup, times, cpu, pipelines_ms, memory, calls);
        let lists = self.picture.targets.as_ref().and_then(|targets| targets.lists.as_ref());
        report.lists = lists.map(|(lists, _)| lists.in_use()).transpose()?;
        Ok((picture, report))
    }

    /// Moves strands that lag behind on to `options.time_s` without drawing anything, on a submission of its own that is
    /// waited for; where there are no such strands it does nothing.
    ///
    /// A frame or step of the same clip follows the one before where its time is later by at most 0.1 s, and holds still
    /// where it is the same; at any other time strands start from rest. Shorter steps follow the motion more closely.
    ///
    /// # Errors
    /// Those of [`Self::render`].
    pub fn advance(&mut self, scene: &Scene, options: &FrameOptions) -> Result<(), RenderError> {
        let Self { shared, picture } = self;
        picture.set_up(scene, options)?;
        if !picture.has_dynamics() {
            return Ok(());
        }
        let mut encoder = shared.gpu.encoder("advance")?;
        let move_on = || -> Result<(), RenderError> {
            picture.prepare(shared, &mut encoder, scene, options)?;
            picture.record_motion(&mut encoder, scene, options);
            encoder.submit()?.wait(FRAME_TIMEOUT_MS)?;
            Ok(())
        };
        let moved = move_on();
        moved.inspect_err(|_| picture.fail())
    }

    /// Makes what an environment is on the device ahead of the first frame that it lights, which may wait seconds for it
    /// where no cache has it.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub fn prepare_environment(&mut self, options: &FrameOptions) -> Result<(), RenderError> {
        self.shared.environment(&options.environment.map, options.environment_quality)?;
        self.shared.lobes(&options.environment_quality)?;
        Ok(())
    }

    /// Draws a frame and waits for it.
    fn draw(&mut self, scene: &Scene, options: &FrameOptions) -> Result<Drawn, RenderError> {
        let (mut cpu, mut clock) = (CpuPhases::default(), Instant::now());
        let Self { shared, picture } = self;
        picture.set_up(scene, options)?;
        cpu.plan_ms = lap_ms(&mut clock);
        let mut draw = || -> Result<FrameTimes, RenderError> {
            // Again where more blends than there was room for, which is known once it is drawn.
            loop {
                let mut encoder = shared.gpu.encoder("frame")?;
                picture.prepare(shared, &mut encoder, scene, options)?;
                cpu.prepare_ms += lap_ms(&mut clock);
                picture.record(&mut encoder, scene, options);
                cpu.record_ms += lap_ms(&mut clock);
                let submission = encoder.submit()?;
                cpu.submit_ms += lap_ms(&mut clock);
                let times = submission.wait(FRAME_TIMEOUT_MS)?;
                cpu.wait_ms += lap_ms(&mut clock);
                if picture.larger_lists(&shared.gpu)?.is_none() {
                    return Ok(times);
                }
            }
        };
        let drawn = draw();
        let times = drawn.inspect_err(|_| picture.fail())?;
        Ok(Drawn { times, cpu, calls: self.gpu().calls() })
    }

    fn read_picture(&mut self, options: &FrameOptions, keep_radiance: bool) -> Result<Picture, RenderError> {
        let gpu = self.shared.gpu.clone();
        let mut readback = std::mem::take(&mut self.picture.readback);
        let host = &self.picture;
        let (Some(setup), Some(targets), Some(image)) = (host.setup(), &host.targets, host.image()) else {
            return Err(missing("the picture"));
        };
        let mut radiance = Vec::new();
        if let Some(hdr) = targets.hdr().filter(|_| keep_radiance) {
            radiance = decode_radiance(options.hdr_format, &readback.read(&gpu, hdr)?);
        }
        let background = match options.background {
            Background::Environment => match options.environment.constant_radiance() {
                Some(radiance) => PictureBackground::Color(radiance),
                None => {
                    let skybox = Skybox::new(&options.environment, &setup.camera, options.size);
                    PictureBackground::Environment(skybox)
                }
            },
            Background::Color(color) => PictureBackground::Color(color),
            Background::Transparent => PictureBackground::Transparent,
        };
        let aovs = AovPixels::read(&gpu, targets, &setup.camera, options)?;
        let rgba = readback.read(&gpu, image)?;
        self.picture.readback = readback;
        Ok(Picture { size: options.size, rgba, radiance, background, aovs })
    }

    /// The options as this device can meet them: lists need fragment shaders that write memory.
    fn options_here<'a>(&self, options: &'a FrameOptions) -> Cow<'a, FrameOptions> {
        match self.gpu().info().fragment_stores || options.transparency == Transparency::Sorted {
            true => Cow::Borrowed(options),
            false => Cow::Owned(FrameOptions { transparency: Transparency::Sorted, ..options.clone() }),
        }
    }
}

/// What a frame that was drawn always has.
fn missing(what: &str) -> RenderError {
    RenderError::Option { option: "size", problem: format!("{what} was not drawn; draw it first") }
}

/// Milliseconds since `clock`, which starts anew.
fn lap_ms(clock: &mut Instant) -> f64 {
    let now = Instant::now();
    let ms = now.duration_since(*clock).as_secs_f64() * 1e3;
    *clock = now;
    ms
}
