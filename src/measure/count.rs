//! How many fragments a frame shades: an instrumented frame that counts where the ordinary one lights.
//!
//! Pipeline statistics cannot tell: some drivers count only what survives `discard`, or count wrongly. Here every draw
//! of the frame is drawn by its counting variant, which keeps what decides coverage and does the depth test itself, before
//! the coverage is known, as early depth tests do; `host/count.glsl` says how.

use crate::gpu::{
    BindGroup, Buffer, ColorTarget, Gpu, GpuError, ImageDesc, Load, Memory, Pipeline, RenderPassDesc, Resource,
    TargetFormats, Upload,
};
use crate::material::AlphaMode;
use crate::render::instrument::{Instrumented, alpha_constant};
use crate::render::{
    Aovs, Blending, DepthUse, FrameOptions, FrameSetup, Pass, PipelineSpec, RenderError, Renderer, Shadows,
};
use crate::scene::Scene;
use crate::shader::layout::{FragmentCounts, RowCounts};
use ash::vk;

/// Format of the counting pipelines' target, which nobody reads: Vulkan wants one where samples matter.
pub const COUNTING_FORMAT: vk::Format = vk::Format::R8_UNORM;
/// Longest wait for one frame.
const TIMEOUT_MS: u64 = 600_000;
/// Descriptor set of the counters.
const COUNT_SET: u32 = 3;

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

/// The pipeline that counts the fragments of one of the scene's, instead of shading them. It keeps what decides where they
/// are and how much of them survives, and tests depth by itself.
pub fn counting_pipeline(shading: &PipelineSpec) -> Option<PipelineSpec> {
    let fragment = shading.variants?.count;
    let mut constants = shading.constants_of([shading.vertex, fragment]);
    // What blends leaves no depth behind, whatever opacity does: sheer families blend in every mode.
    if shading.blending != Blending::Replace {
        let modes = constants.iter_mut().filter(|(name, _)| *name == "ALPHA_MODE");
        modes.for_each(|(_, value)| *value = alpha_constant(AlphaMode::Blend));
    }
    Some(PipelineSpec {
        fragment,
        constants,
        depth: DepthUse::None,
        targets: TargetFormats::new([COUNTING_FORMAT], None, shading.targets.samples),
        ..shading.clone()
    })
}

/// What the shader reads and writes for one pass.
struct PassCounter {
    counts: Buffer,
    readback: Buffer,
    group: BindGroup,
}

/// Whether the device can count the fragments of such a frame: its fragment shaders write memory, and one buffer holds
/// a depth a sample.
pub fn can_count_fragments(gpu: &Gpu, options: &FrameOptions) -> bool {
    gpu.info().fragment_stores && pixel_bytes(options) <= gpu.info().max_storage_bytes
}

/// Counts the fragments of the frame that these options ask for, at their samples, without making a picture. The
/// passes that draw come in order; tone mapping is one fragment a pixel by construction.
///
/// The counts are those of a device that takes a pixel's fragments in draw order, as software devices do: exact
/// there. A device that runs them out of order may test a fragment before or after its neighbour in that order, and
/// `shaded` lies then between 1 a surface and `rasterized`; the other counts of opaque passes stay exact.
///
/// # Errors
/// [`GpuError::Unsupported`] where [`can_count_fragments`] says no, and those of [`FrameSetup::new`] and the device.
pub fn count_fragments(
    renderer: &mut Renderer,
    scene: &Scene,
    options: &FrameOptions,
) -> Result<Vec<PassFragments>, RenderError> {
    let gpu = renderer.gpu().clone();
    if !can_count_fragments(&gpu, options) {
        let problem = "counting needs fragment shaders that write memory, and room for every sample's depth".to_owned();
        return Err(GpuError::Unsupported { name: "fragment counts".to_owned(), problem }.into());
    }
    // Shading alone is counted; shadows cast no fragments of the picture.
    let shadows = Shadows { are_cast: false, ..options.shadows };
    let options = &FrameOptions { aovs: Aovs::default(), screen_occlusion: None, shadows, ..options.clone() };
    let mut setup = FrameSetup::new(scene, options)?;
    let passes: Vec<Pass> = [Pass::Opaque, Pass::Fur, Pass::OitBuild, Pass::Transparent]
        .into_iter()
        .filter(|pass| setup.staging.plan.passes.contains(pass))
        .collect();
    let plan = &mut setup.staging.plan;
    plan.draws.retain(|pass, _| passes.contains(pass));
    for spec in &mut plan.pipelines {
        if let Some(counting) = counting_pipeline(spec) {
            *spec = counting;
        }
    }
    let builds_lists = !plan.draws_of(Pass::OitBuild).is_empty();

    let mut encoder = gpu.encoder("fragment counts")?;
    let instrumented = Instrumented::prepare(renderer, &mut encoder, scene, &setup, options)?;
    let counters = counters(&gpu, instrumented.first_pipeline(), options, passes.len())?;
    let target = gpu.image(&ImageDesc {
        name: "fragment counts",
        size: options.size,
        format: COUNTING_FORMAT,
        mip_levels: 1,
        samples: options.msaa,
        usage: vk::ImageUsageFlags::COLOR_ATTACHMENT,
        is_cube: false,
    })?;
    instrumented.record_motion(&mut encoder);
    for (pass, counter) in passes.iter().zip(&counters) {
        let color = [ColorTarget { image: &target, load: Load::Discard, store: false, resolve: None }];
        let desc = RenderPassDesc { name: pass.name(), size: options.size, color: &color, depth: None, sampled: &[] };
        encoder.render_pass(&desc, |render_pass| {
            render_pass.bind(COUNT_SET, &counter.group);
            instrumented.record_draws(render_pass, *pass);
        });
    }
    for counter in &counters {
        encoder.copy_buffer(&counter.counts, &counter.readback);
    }
    encoder.submit()?.wait(TIMEOUT_MS)?;

    let mut fragments = Vec::new();
    for (index, pass) in passes.iter().enumerate() {
        fragments.push(match counters.get(index) {
            Some(counter) => sum(*pass, &counter.readback.read::<u8>()?),
            None => PassFragments { pass: *pass, rasterized: 0, shaded: 0, covered_pixels: 0 },
        });
    }
    let pixels = options.size.iter().map(|side| u64::from(*side)).product();
    if builds_lists {
        // One fragment a pixel, too; with several samples it is dropped where nothing blends.
        let blended = fragments.iter().find(|counted| counted.pass == Pass::OitBuild);
        let covered_pixels = blended.filter(|_| options.msaa > 1).map_or(pixels, |counted| counted.covered_pixels);
        let pass = Pass::OitResolve;
        fragments.push(PassFragments { pass, rasterized: pixels, shaded: pixels, covered_pixels });
    }
    let pass = Pass::ToneMapping;
    fragments.push(PassFragments { pass, rasterized: pixels, shaded: pixels, covered_pixels: pixels });
    Ok(fragments)
}

/// Zeroed counters; none where nothing is drawn.
fn counters(
    gpu: &Gpu,
    pipeline: Option<&Pipeline>,
    options: &FrameOptions,
    pass_count: usize,
) -> Result<Vec<PassCounter>, GpuError> {
    let Some(pipeline) = pipeline else { return Ok(Vec::new()) };
    let [width, height] = options.size.map(|side| side as usize);
    let mut upload = gpu.upload();
    let zeros = vec![0; pixel_bytes(options) as usize];
    let pixels = filled(gpu, &mut upload, "fragment pixels", &zeros)?;
    let mut counters = Vec::new();
    for number in 1..=pass_count {
        let header = FragmentCounts { pass_number: number as u32, width: width as u32 };
        let mut bytes = bytemuck::bytes_of(&header).to_vec();
        bytes.resize(bytes.len() + height * size_of::<RowCounts>(), 0);
        let counts = filled(gpu, &mut upload, "fragment counts", &bytes)?;
        let usage = vk::BufferUsageFlags::TRANSFER_DST;
        let readback = gpu.buffer("fragment counts", counts.bytes(), usage, Memory::Readback)?;
        let offered = [("FragmentCounts", Resource::Buffer(&counts)), ("FragmentPixels", Resource::Buffer(&pixels))];
        let group = gpu.bind_group(pipeline, COUNT_SET, "fragment counts", &offered)?;
        counters.push(PassCounter { counts, readback, group });
    }
    upload.finish()?;
    Ok(counters)
}

fn filled(gpu: &Gpu, upload: &mut Upload, name: &str, bytes: &[u8]) -> Result<Buffer, GpuError> {
    let buffer = gpu.buffer(name, bytes.len() as u64, vk::BufferUsageFlags::STORAGE_BUFFER, Memory::Device)?;
    upload.buffer(&buffer, 0, bytes);
    Ok(buffer)
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
