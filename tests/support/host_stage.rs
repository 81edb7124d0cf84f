//! A host's frame for checks: targets, a renderer on the host's device, and pixels read back.

use crate::host::{Host, Pass, RenderTarget, messages};
use glam::Vec4;
use vair::Renderer;
use vair::gpu::{Gpu, HostCommands, HostRendering, Image, vk};
use vair::render::{DeviceScene, Frame, FrameDesc, RenderError, Target};

const COLOR_LAYOUT: vk::ImageLayout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
const DEPTH_LAYOUT: vk::ImageLayout = vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL;

/// A host with targets, and a renderer on its device.
pub struct HostStage {
    /// The renderer.
    pub renderer: Renderer,
    /// What is drawn into.
    pub target: Target,
    /// What the colour is before anything is drawn.
    pub clear_color: [f32; 4],
    /// What the depth is.
    pub clear_depth: f32,
    pub host: Host,
    color: RenderTarget,
    resolved: Option<RenderTarget>,
    depth: RenderTarget,
}

/// What is inside of the host's pass.
pub struct InPass<'a, 'r> {
    /// The host.
    pub host: &'a Host,
    /// Its commands.
    pub commands: vk::CommandBuffer,
    /// vair's frame.
    pub frame: &'a mut Frame<'r>,
    /// The pass.
    pub pass: HostRendering,
}

/// What follows the host's pass.
pub struct AfterPass<'a, 'r> {
    /// The host.
    pub host: &'a Host,
    /// Its commands.
    pub commands: vk::CommandBuffer,
    /// vair's frame.
    pub frame: &'a mut Frame<'r>,
    /// The depth of the pass.
    pub depth: &'a RenderTarget,
}

impl InPass<'_, '_> {
    /// All that a view sees.
    pub fn draw(&mut self, scene: &DeviceScene, view: usize) {
        self.frame.draw_opaque(self.pass, scene, view).unwrap_or_else(|error| panic!("{error}"));
        self.frame.draw_fur(self.pass, scene, view).unwrap_or_else(|error| panic!("{error}"));
        self.frame.draw_transparent(self.pass, scene, view).unwrap_or_else(|error| panic!("{error}"));
    }
}

/// Runs `check` on a host whose targets are of this size, and fails when the validation layer says anything.
#[track_caller]
pub fn host_stage(size: [u32; 2], target: Target, check: impl FnOnce(&mut HostStage)) {
    let host = Host::new();
    let mut lent = host.lend();
    // What is made of an environment once serves every test.
    lent.pipeline_cache_dir = Some(env!("CARGO_TARGET_TMPDIR").into());
    // SAFETY: the handles belong together and outlive every object made from them.
    let gpu = unsafe { Gpu::from_host(lent) }.unwrap_or_else(|error| panic!("{error}"));
    let read = vk::ImageUsageFlags::TRANSFER_SRC;
    let color_use = vk::ImageUsageFlags::COLOR_ATTACHMENT | read;
    let depth_use = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT | read;
    let engine = &host.engine;
    let color = engine.target(target.color, size, target.samples, color_use).unwrap();
    let depth = engine.target(target.depth, size, target.samples, depth_use).unwrap();
    let resolved = (target.samples > 1).then(|| engine.target(target.color, size, 1, color_use).unwrap());
    let clear_depth = if target.depth_order == vair::render::DepthOrder::Reversed { 0.0 } else { 1.0 };
    let renderer = Renderer::with_gpu(gpu);
    let mut stage = HostStage { renderer, target, clear_color: [0.0; 4], clear_depth, host, color, resolved, depth };
    check(&mut stage);
    let HostStage { renderer, host, color, resolved, depth, .. } = stage;
    drop(renderer);
    [Some(color), resolved, Some(depth)].iter().flatten().for_each(|target| host.engine.destroy_target(target));
    host.destroy();
    let said = messages();
    assert!(said.is_empty(), "the validation layer says:\n{}", said.join("\n"));
}

impl HostStage {
    /// The device.
    pub fn gpu(&self) -> Gpu {
        self.renderer.gpu().clone()
    }

    /// One frame, waited for: `record` before the host's pass, `draw` inside of it, both with `scene`.
    pub fn frame<S, T>(
        &mut self,
        scene: &mut S,
        record: impl FnOnce(&mut Frame<'_>, &mut S) -> T,
        draw: impl FnOnce(&mut InPass<'_, '_>, &S),
    ) -> T {
        self.frame_with(scene, record, draw, |_, _| {})
    }

    /// The same, and `after` what follows the pass.
    pub fn frame_with<S, T>(
        &mut self,
        scene: &mut S,
        record: impl FnOnce(&mut Frame<'_>, &mut S) -> T,
        draw: impl FnOnce(&mut InPass<'_, '_>, &S),
        after: impl FnOnce(&mut AfterPass<'_, '_>, &S),
    ) -> T {
        let Self { renderer, host, color, resolved, depth, clear_color, clear_depth, target, .. } = self;
        let gpu = renderer.gpu().clone();
        let mut recorded = None;
        let mut token = None;
        host.run(|commands| {
            // SAFETY: the command buffer is recording, outside of a pass, and submitted once, before any later one.
            let mut frame = renderer.frame(unsafe { HostCommands::recording(commands) }).unwrap();
            recorded = Some(record(&mut frame, scene));
            for color in std::iter::once(&*color).chain(resolved.as_ref()) {
                host.engine.barrier(commands, color, vk::ImageLayout::UNDEFINED, COLOR_LAYOUT);
            }
            host.engine.barrier(commands, depth, vk::ImageLayout::UNDEFINED, DEPTH_LAYOUT);
            let pass = Pass {
                color: Some(color),
                resolve: resolved.as_ref(),
                depth: Some(depth),
                clear_color: *clear_color,
                clear_depth: Some(*clear_depth),
            };
            host.engine.begin_rendering(commands, &pass);
            // SAFETY: inside a pass of these formats and samples.
            let pass = unsafe { HostRendering::begun(commands, target.formats()) };
            draw(&mut InPass { host, commands, frame: &mut frame, pass }, scene);
            host.engine.end_rendering(commands);
            after(&mut AfterPass { host, commands, frame: &mut frame, depth }, scene);
            token = Some(frame.finish().unwrap_or_else(|error| panic!("{error}")));
        });
        // SAFETY: the host has waited.
        unsafe { gpu.frame_passed(token.unwrap()) }.unwrap();
        recorded.unwrap()
    }

    /// Draws a scene through the first view of a frame.
    pub fn draw(&mut self, scene: &mut DeviceScene, desc: &FrameDesc) -> Vec<Vec4> {
        self.frame(scene, |frame, scene| prepare(frame, scene, desc), |pass, scene| pass.draw(scene, 0));
        self.pixels()
    }

    /// What is said about a frame that cannot be prepared; nothing is recorded then.
    pub fn refused(&mut self, scene: &mut DeviceScene, desc: &FrameDesc) -> String {
        let gpu = self.gpu();
        self.frame(
            scene,
            |frame, scene| {
                let before = gpu.calls();
                let error = frame.prepare(scene, desc).expect_err("it cannot be right");
                assert_eq!(commands(&gpu, &before), 0, "{error}");
                error_text(error)
            },
            |_, _| {},
        )
    }

    /// The host's colour, as vair is told of it.
    pub fn described(&self) -> vair::gpu::HostImage<'static> {
        self.color.described("host's", COLOR_LAYOUT)
    }

    /// Linear colour, rows from the top.
    pub fn pixels(&mut self) -> Vec<Vec4> {
        let image = self.resolved.as_ref().unwrap_or(&self.color);
        let bytes = read(self.renderer.gpu(), image, COLOR_LAYOUT);
        halves(&bytes)
    }

    /// Depth, rows from the top; of one sample a pixel.
    pub fn depth(&mut self) -> Vec<f32> {
        floats(&read(self.renderer.gpu(), &self.depth, DEPTH_LAYOUT))
    }
}

/// Prepares a frame that is right.
#[track_caller]
pub fn prepare(frame: &mut Frame<'_>, scene: &mut DeviceScene, desc: &FrameDesc) {
    frame.prepare(scene, desc).unwrap_or_else(|error| panic!("{error}"));
}

/// Commands recorded since `before`.
pub fn commands(gpu: &Gpu, before: &vair::gpu::CallCounts) -> u64 {
    let since = gpu.calls().since(before);
    since.by_name.iter().filter(|(name, _)| name.starts_with("vkCmd")).map(|(_, count)| count).sum()
}

/// The text of a typed error about an argument.
pub fn error_text(error: RenderError) -> String {
    assert!(matches!(error, RenderError::Option { .. }), "{error:?}");
    error.to_string()
}

/// All texels of a target of the host's that is in that layout.
pub fn read(gpu: &Gpu, target: &RenderTarget, layout: vk::ImageLayout) -> Vec<u8> {
    // SAFETY: image and view are alive, in that layout, and may be copied from.
    let image = unsafe { Image::from_host(gpu, &target.described("host's", layout)) };
    gpu.read_image(&image).unwrap_or_else(|error| panic!("{error}"))
}

/// Texels of four half floats.
pub fn halves(bytes: &[u8]) -> Vec<Vec4> {
    let half =
        |texel: &[u8], channel: usize| half::f16::from_le_bytes([texel[2 * channel], texel[2 * channel + 1]]).to_f32();
    bytes.chunks_exact(8).map(|texel| Vec4::from_array([0, 1, 2, 3].map(|channel| half(texel, channel)))).collect()
}

/// Texels of one float.
pub fn floats(bytes: &[u8]) -> Vec<f32> {
    bytes.chunks_exact(4).map(|texel| f32::from_le_bytes([texel[0], texel[1], texel[2], texel[3]])).collect()
}
