//! How many fragments a frame shades: an instrumented frame that counts where the ordinary one lights.
//!
//! Pipeline statistics cannot tell: some drivers count only what survives `discard`, or count wrongly. Here every draw
//! of the frame is drawn by its counting pipeline ([`PipelineSpec::counting`]), which keeps what decides coverage and
//! does the depth test itself, before the coverage is known, as early depth tests do; `host/count.glsl` says how.

use super::frame_data::{FrameData, LightMaps};
use super::options::Shadows;
use super::pass::{Frame, draws};
use super::plan::Pass;
use super::{Aovs, FrameOptions, PipelineSpec, RenderError, Renderer, Shot, frame};
use crate::gpu::{BindGroup, Buffer, ColorTarget, GpuError, ImageDesc, Load, Memory, RenderPassDesc, Resource, Upload};
use crate::scene::Scene;
use crate::shader::layout::{FragmentCounts, RowCounts};
use ash::vk;

/// Fragments of one pass. A fragment is one invocation of the fragment shader: a triangle and a pixel, however many of
/// the pixel's samples the triangle covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PassFragments {
    /// Which pass.
    pub pass: Pass,
    /// What the pass rasterises: its shader invocations if no depth test rejected any.
    pub rasterized: u64,
    /// Shader invocations before `discard`: what depth tests before the shader let through.
    pub shaded: u64,
    /// Pixels where some shaded fragment also survived, and thus wrote.
    pub covered_pixels: u64,
}

impl PassFragments {
    /// Shaded fragments a covered pixel; `None` where nothing is covered.
    pub fn overdraw(&self) -> Option<f64> {
        (self.covered_pixels > 0).then(|| self.shaded as f64 / self.covered_pixels as f64)
    }
}

/// What the shader reads and writes for one pass.
struct PassCounter {
    counts: Buffer,
    readback: Buffer,
    group: BindGroup,
}

impl Renderer {
    /// Whether the device can count the fragments of such a frame: its fragment shaders write memory, and one buffer holds
    /// a depth a sample.
    pub fn can_count_fragments(&self, options: &FrameOptions) -> bool {
        let info = self.gpu.info();
        info.fragment_stores && pixel_bytes(options) <= info.max_storage_bytes
    }

    /// Counts the fragments of the frame that these options ask for, at their samples, without making a picture. The
    /// passes that draw come in order; tone mapping is one fragment a pixel by construction.
    ///
    /// The counts are those of a device that takes a pixel's fragments in draw order, as software devices do: exact
    /// there. A device that runs them out of order may test a fragment before or after its neighbour in that order, and
    /// `shaded` lies then between 1 a surface and `rasterized`; the other counts of opaque passes stay exact.
    ///
    /// # Errors
    /// [`GpuError::Unsupported`] where [`Self::can_count_fragments`] says no, and those of [`Shot::new`] and the device.
    pub fn count_fragments(
        &mut self,
        scene: &Scene,
        options: &FrameOptions,
    ) -> Result<Vec<PassFragments>, RenderError> {
        if !self.can_count_fragments(options) {
            let problem =
                "counting needs fragment shaders that write memory, and room for every sample's depth".to_owned();
            return Err(GpuError::Unsupported { name: "fragment counts".to_owned(), problem }.into());
        }
        // Shading alone is counted; shadows cast no fragments of the picture.
        let shadows = Shadows { are_cast: false, ..options.shadows };
        let options = &FrameOptions { aovs: Aovs::default(), screen_occlusion: None, shadows, ..options.clone() };
        let mut shot = Shot::new(scene, options)?;
        shot.plan.guide.clear();
        for spec in &mut shot.plan.pipelines {
            *spec = spec.counting();
        }
        let motion = self.prepare_motion(scene, &shot, options)?;
        let data = FrameData::new(&self.gpu, &self.resources, LightMaps::default(), scene, &shot, options.size)?;
        let resources = &self.resources;
        let frame = Frame {
            scene,
            shot: &shot,
            options,
            resources,
            motion: &motion,
            data: &data,
            atlas: None,
            composition: None,
        };
        let lists = frame::draw_lists(&frame);
        let counters = self.counters(&shot, options, lists.len())?;
        let target = self.gpu.image(&ImageDesc {
            name: "fragment counts",
            size: options.size,
            format: PipelineSpec::COUNTING_FORMAT,
            mip_levels: 1,
            samples: options.msaa,
            usage: vk::ImageUsageFlags::COLOR_ATTACHMENT,
            is_cube: false,
        })?;

        let mut encoder = self.gpu.encoder("fragment counts")?;
        frame::record_motion(&mut encoder, &frame.moving());
        for ((pass, list), counter) in lists.iter().zip(&counters) {
            let color = [ColorTarget { image: &target, load: Load::Discard, store: false, resolve: None }];
            let desc =
                RenderPassDesc { name: pass.name(), size: options.size, color: &color, depth: None, sampled: &[] };
            encoder.render_pass(&desc, |render_pass| {
                render_pass.bind(3, &counter.group);
                draws::record(render_pass, list, &frame, 0);
            });
        }
        for counter in &counters {
            encoder.copy_buffer(&counter.counts, &counter.readback);
        }
        encoder.submit()?.wait(super::FRAME_TIMEOUT_MS)?;

        let mut fragments = Vec::new();
        for (index, (pass, _)) in lists.iter().enumerate() {
            fragments.push(match counters.get(index) {
                Some(counter) => sum(*pass, &counter.readback.read::<u8>()?),
                None => PassFragments { pass: *pass, rasterized: 0, shaded: 0, covered_pixels: 0 },
            });
        }
        self.keep(scene, options);
        let pixels = options.size.iter().map(|side| u64::from(*side)).product();
        if shot.plan.composition.is_some() {
            // One fragment a pixel, too; with several samples it is dropped where nothing blends.
            let blended = fragments.iter().find(|counted| counted.pass == Pass::Transparent);
            let covered_pixels = blended.filter(|_| options.msaa > 1).map_or(pixels, |counted| counted.covered_pixels);
            let pass = Pass::Transparency;
            fragments.push(PassFragments { pass, rasterized: pixels, shaded: pixels, covered_pixels });
        }
        fragments.push(PassFragments {
            pass: Pass::Tonemap,
            rasterized: pixels,
            shaded: pixels,
            covered_pixels: pixels,
        });
        Ok(fragments)
    }

    /// Zeroed counters; none where nothing is drawn.
    fn counters(&self, shot: &Shot, options: &FrameOptions, pass_count: usize) -> Result<Vec<PassCounter>, GpuError> {
        let Some(spec) = shot.plan.pipelines.first() else { return Ok(Vec::new()) };
        let [width, height] = options.size.map(|side| side as usize);
        let mut upload = self.gpu.upload();
        let zeros = vec![0; pixel_bytes(options) as usize];
        let pixels = self.filled(&mut upload, "fragment pixels", &zeros)?;
        let mut counters = Vec::new();
        for number in 1..=pass_count {
            let header = FragmentCounts { pass_number: number as u32, width: width as u32 };
            let mut bytes = bytemuck::bytes_of(&header).to_vec();
            bytes.resize(bytes.len() + height * size_of::<RowCounts>(), 0);
            let counts = self.filled(&mut upload, "fragment counts", &bytes)?;
            let usage = vk::BufferUsageFlags::TRANSFER_DST;
            let readback = self.gpu.buffer("fragment counts", counts.bytes(), usage, Memory::Readback)?;
            let offered =
                [("FragmentCounts", Resource::Buffer(&counts)), ("FragmentPixels", Resource::Buffer(&pixels))];
            let group = self.gpu.bind_group(self.resources.pipeline(spec), 3, "fragment counts", &offered)?;
            counters.push(PassCounter { counts, readback, group });
        }
        upload.finish()?;
        Ok(counters)
    }

    fn filled(&self, upload: &mut Upload, name: &str, bytes: &[u8]) -> Result<Buffer, GpuError> {
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER;
        let buffer = self.gpu.buffer(name, bytes.len() as u64, usage, Memory::Device)?;
        upload.buffer(&buffer, 0, bytes);
        Ok(buffer)
    }
}

/// For each pixel the depths of its samples, and the last pass that covered it.
fn pixel_bytes(options: &FrameOptions) -> u64 {
    let pixels = options.size.iter().map(|side| u64::from(*side)).product::<u64>();
    pixels * (u64::from(options.msaa) + 1) * size_of::<u32>() as u64
}

/// Rows together: their sums may not fit in 32 bits.
fn sum(pass: Pass, bytes: &[u8]) -> PassFragments {
    let mut fragments = PassFragments { pass, rasterized: 0, shaded: 0, covered_pixels: 0 };
    for row in bytes[size_of::<FragmentCounts>()..].chunks_exact(size_of::<RowCounts>()) {
        let row: RowCounts = bytemuck::pod_read_unaligned(row);
        fragments.rasterized += u64::from(row.rasterized);
        fragments.shaded += u64::from(row.shaded);
        fragments.covered_pixels += u64::from(row.covered_pixels);
    }
    fragments
}
