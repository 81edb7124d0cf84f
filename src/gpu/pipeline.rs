//! Graphics and compute pipelines, built from reflected shaders.

use super::device::{Context, Gpu, lock};
use super::error::GpuError;
use super::interface::{Interface, SET_COUNT, specialize, stage_flags};
use crate::shader::{BindingKind, Shader, Stage, VertexFormat};
use ash::vk;
use std::fmt::Write;
use std::sync::Arc;
use std::time::Instant;

/// State of a graphics pipeline. Viewport, scissor, culling, front face and vertex strides are dynamic.
#[derive(Clone, Copy)]
pub struct GraphicsDesc<'a> {
    /// Name.
    pub name: &'a str,
    /// Vertex stage.
    pub vertex: &'static Shader,
    /// Fragment stage; `None` writes depth only.
    pub fragment: Option<&'static Shader>,
    /// Specialization constants by their GLSL name, as bits; those not named keep their defaults.
    pub constants: &'a [(&'a str, u32)],
    /// Topology.
    pub topology: vk::PrimitiveTopology,
    /// Samples per texel of the targets.
    pub samples: u32,
    /// Colour targets in order, with the same blending and channels.
    pub color: &'a [ColorState],
    /// Depth target.
    pub depth: Option<DepthState>,
}

/// One colour target of a pipeline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ColorState {
    /// Format of the target.
    pub format: vk::Format,
    /// Blending; `None` replaces.
    pub blend: Option<BlendState>,
    /// Channels that are written.
    pub write_mask: vk::ColorComponentFlags,
}

impl ColorState {
    /// Replaces all channels.
    pub const fn replace(format: vk::Format) -> Self {
        Self { format, blend: None, write_mask: vk::ColorComponentFlags::RGBA }
    }
}

/// Blending: result = source * source factor (op) target * target factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BlendState {
    /// Factor of the source colour.
    pub src_color: vk::BlendFactor,
    /// Factor of the target colour.
    pub dst_color: vk::BlendFactor,
    /// How colours combine.
    pub color_op: vk::BlendOp,
    /// Factor of the source alpha.
    pub src_alpha: vk::BlendFactor,
    /// Factor of the target alpha.
    pub dst_alpha: vk::BlendFactor,
    /// How alphas combine.
    pub alpha_op: vk::BlendOp,
}

impl BlendState {
    /// Colours and alphas add up.
    pub const SUM: Self = Self {
        src_color: vk::BlendFactor::ONE,
        dst_color: vk::BlendFactor::ONE,
        color_op: vk::BlendOp::ADD,
        src_alpha: vk::BlendFactor::ONE,
        dst_alpha: vk::BlendFactor::ONE,
        alpha_op: vk::BlendOp::ADD,
    };

    /// Over, for colour already multiplied by alpha (Porter and Duff 1984, "Compositing digital images").
    pub const PREMULTIPLIED_OVER: Self = Self {
        src_color: vk::BlendFactor::ONE,
        dst_color: vk::BlendFactor::ONE_MINUS_SRC_ALPHA,
        color_op: vk::BlendOp::ADD,
        src_alpha: vk::BlendFactor::ONE,
        dst_alpha: vk::BlendFactor::ONE_MINUS_SRC_ALPHA,
        alpha_op: vk::BlendOp::ADD,
    };
}

/// The depth target of a pipeline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DepthState {
    /// Format of the target.
    pub format: vk::Format,
    /// Passing fragments write their depth.
    pub write: bool,
    /// Fragment depth (op) target depth passes; [`vk::CompareOp::ALWAYS`] is off.
    pub compare: vk::CompareOp,
}

/// A pipeline.
pub struct Pipeline(pub(crate) Arc<PipelineInner>);

pub(crate) struct PipelineInner {
    context: Arc<Context>,
    pub(crate) raw: vk::Pipeline,
    pub(crate) layout: vk::PipelineLayout,
    pub(crate) set_layouts: [vk::DescriptorSetLayout; SET_COUNT],
    pub(crate) interface: Interface,
    pub(crate) name: String,
    pub(crate) bind_point: vk::PipelineBindPoint,
    pub(crate) targets: TargetFormats,
    pub(crate) topology: vk::PrimitiveTopology,
    description: String,
    creation_ms: f64,
}

/// Colour targets of one pass, at most; every device has so many ("Vulkan 1.3", table "Required Limits",
/// maxColorAttachments).
pub const MAX_COLOR_TARGETS: usize = 4;

/// What a render pass and a pipeline must agree on.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub struct TargetFormats {
    /// Formats of the colour targets, in order; `UNDEFINED` beyond the last.
    pub color: [vk::Format; MAX_COLOR_TARGETS],
    /// Format of the depth target.
    pub depth: Option<vk::Format>,
    /// Samples a texel.
    pub samples: u32,
}

impl TargetFormats {
    /// Of these colour targets, in order, and depth. More than `MAX_COLOR_TARGETS` fit nothing.
    pub fn new(color: impl IntoIterator<Item = vk::Format>, depth: Option<vk::Format>, samples: u32) -> Self {
        let mut formats = Self { color: Default::default(), depth, samples };
        for (slot, format) in formats.color.iter_mut().zip(color) {
            *slot = format;
        }
        formats
    }
}

impl Pipeline {
    /// The whole state and interface as stable text of several lines, for snapshots.
    pub fn description(&self) -> &str {
        &self.0.description
    }

    /// How long the driver took to create it, ms. Some drivers compile at the first draw instead.
    pub fn creation_ms(&self) -> f64 {
        self.0.creation_ms
    }

    /// Name given at creation.
    pub fn name(&self) -> &str {
        &self.0.name
    }
}

impl Drop for PipelineInner {
    fn drop(&mut self) {
        // SAFETY: the last owner is gone, submissions in flight among them.
        unsafe { self.context.device.destroy_pipeline(self.raw, None) };
    }
}

/// A stage being put together: a module that is destroyed on drop, and its constants.
struct StageParts<'a> {
    context: &'a Context,
    module: vk::ShaderModule,
    stage: vk::ShaderStageFlags,
    entries: Vec<vk::SpecializationMapEntry>,
    data: Vec<u32>,
}

impl<'a> StageParts<'a> {
    fn new(context: &'a Context, shader: &'static Shader, constants: &[(u32, u32)]) -> Result<Self, GpuError> {
        let info = vk::ShaderModuleCreateInfo::default().code(shader.spirv());
        // SAFETY: the shader table holds what the SPIR-V compiler wrote for this API version.
        let module = unsafe { context.device.create_shader_module(&info, None) }
            .map_err(|result| GpuError::from_vk("creating shader", shader.name, result))?;
        context.set_name(module, shader.name);
        let entry = |(index, (id, _)): (usize, &(u32, u32))| {
            vk::SpecializationMapEntry::default().constant_id(*id).offset(index as u32 * 4).size(4)
        };
        Ok(Self {
            context,
            module,
            stage: stage_flags(shader.stage),
            entries: constants.iter().enumerate().map(entry).collect(),
            data: constants.iter().map(|(_, bits)| *bits).collect(),
        })
    }

    fn constants(&self) -> vk::SpecializationInfo<'_> {
        vk::SpecializationInfo::default().map_entries(&self.entries).data(bytemuck::cast_slice(&self.data))
    }

    fn info<'b>(&self, constants: &'b vk::SpecializationInfo<'b>) -> vk::PipelineShaderStageCreateInfo<'b> {
        vk::PipelineShaderStageCreateInfo::default()
            .stage(self.stage)
            .module(self.module)
            .name(c"main")
            .specialization_info(constants)
    }
}

impl Drop for StageParts<'_> {
    fn drop(&mut self) {
        // SAFETY: a module may be destroyed once pipelines have been created from it.
        unsafe { self.context.device.destroy_shader_module(self.module, None) };
    }
}

fn expect_stage(pipeline: &str, shader: &Shader, stage: Stage) -> Result<(), GpuError> {
    if shader.spirv().is_empty() {
        return Err(GpuError::NoShaders { pipeline: pipeline.to_owned() });
    }
    if shader.stage == stage {
        return Ok(());
    }
    let problem = format!("{} is a {:?} shader where {stage:?} is expected", shader.name, shader.stage);
    Err(GpuError::Interface { pipeline: pipeline.to_owned(), problem })
}

/// What is wrong where a shader reads more textures than the device lets one stage read.
fn too_many_textures(shader: &Shader, limit: u32) -> Option<String> {
    let count = shader
        .bindings
        .iter()
        .filter(|binding| matches!(binding.kind, BindingKind::Texture | BindingKind::Cube))
        .count();
    (count > limit as usize).then(|| format!("{count} textures in one shader (reads at most {limit})"))
}

fn describe_shaders(kind: &str, name: &str, shaders: &[&'static Shader], constants: &[Vec<(u32, u32)>]) -> String {
    let mut text = format!("{kind} '{name}'\n");
    for (shader, given) in shaders.iter().zip(constants) {
        let _ = writeln!(text, "  {:?} shader: {}", shader.stage, shader.name);
        for constant in shader.constants {
            let bits = given.iter().find(|(id, _)| *id == constant.id).map(|(_, bits)| *bits);
            let (value, origin) = bits.map_or((constant.default_bits, " (default)"), |bits| (bits, ""));
            let _ = writeln!(text, "    constant {} {} = 0x{value:08x}{origin}", constant.id, constant.name);
        }
    }
    text
}

fn describe_state(desc: &GraphicsDesc<'_>) -> String {
    let mut text = format!("  topology: {:?}\n  samples: {}\n", desc.topology, desc.samples);
    for (index, color) in desc.color.iter().enumerate() {
        let blend = color.blend.map_or("none".to_owned(), |b| {
            let alpha = format!("{:?} {:?} {:?}", b.src_alpha, b.alpha_op, b.dst_alpha);
            format!("{:?} {:?} {:?}, alpha {alpha}", b.src_color, b.color_op, b.dst_color)
        });
        let _ = writeln!(text, "  color {index}: {:?} write {:?} blend {blend}", color.format, color.write_mask);
    }
    let depth = desc.depth.map_or("none".to_owned(), |d| format!("{:?} write {} {:?}", d.format, d.write, d.compare));
    let _ = writeln!(text, "  depth: {depth}");
    text
}

fn vertex_format(format: VertexFormat) -> vk::Format {
    match format {
        VertexFormat::Float => vk::Format::R32_SFLOAT,
        VertexFormat::Vec2 => vk::Format::R32G32_SFLOAT,
        VertexFormat::Vec3 => vk::Format::R32G32B32_SFLOAT,
        VertexFormat::Vec4 => vk::Format::R32G32B32A32_SFLOAT,
        VertexFormat::Uint => vk::Format::R32_UINT,
    }
}

/// Size of one value of a vertex stream; all are made of 32-bit components.
pub(crate) fn vertex_bytes(format: VertexFormat) -> u64 {
    match format {
        VertexFormat::Float | VertexFormat::Uint => 4,
        VertexFormat::Vec2 => 8,
        VertexFormat::Vec3 => 12,
        VertexFormat::Vec4 => 16,
    }
}

fn blend_attachment(color: &ColorState) -> vk::PipelineColorBlendAttachmentState {
    let attachment = vk::PipelineColorBlendAttachmentState::default().color_write_mask(color.write_mask);
    match color.blend {
        None => attachment,
        Some(blend) => attachment
            .blend_enable(true)
            .src_color_blend_factor(blend.src_color)
            .dst_color_blend_factor(blend.dst_color)
            .color_blend_op(blend.color_op)
            .src_alpha_blend_factor(blend.src_alpha)
            .dst_alpha_blend_factor(blend.dst_alpha)
            .alpha_blend_op(blend.alpha_op),
    }
}

impl Gpu {
    /// Creates a graphics pipeline. Each vertex input is a binding of its own: binding number = location, one tightly
    /// packed stream, stride given when it is bound.
    ///
    /// # Errors
    /// [`GpuError::Interface`] for stages that disagree, an unknown constant, or more than 4 sets or 128 push-constant
    /// bytes; [`GpuError::Unsupported`] for a sample count or unequal colour states; [`GpuError::OutOfMemory`]; or the driver's answer.
    pub fn graphics_pipeline(&self, desc: &GraphicsDesc<'_>) -> Result<Pipeline, GpuError> {
        expect_stage(desc.name, desc.vertex, Stage::Vertex)?;
        let mut shaders = vec![desc.vertex];
        if let Some(fragment) = desc.fragment {
            expect_stage(desc.name, fragment, Stage::Fragment)?;
            shaders.push(fragment);
        }
        let context = self.context();
        if !context.info.samples.contains(&desc.samples) {
            let problem = format!("{} samples (has {:?})", desc.samples, context.info.samples);
            return Err(GpuError::Unsupported { name: desc.name.to_owned(), problem });
        }
        if let Some(problem) =
            desc.fragment.and_then(|shader| too_many_textures(shader, context.info.max_textures_per_stage))
        {
            return Err(GpuError::Unsupported { name: desc.name.to_owned(), problem });
        }
        // Without `independentBlend`, which nothing here needs, all attachments have one state.
        if desc.color.windows(2).any(|pair| (pair[0].blend, pair[0].write_mask) != (pair[1].blend, pair[1].write_mask))
        {
            let problem = "colour targets with unequal blending or channels".to_owned();
            return Err(GpuError::Unsupported { name: desc.name.to_owned(), problem });
        }
        let interface = Interface::merge(desc.name, &shaders)?;
        let constants = specialize(desc.name, &shaders, desc.constants)?;
        let (set_layouts, layout) = lock(&context.layouts).of(&context.device, desc.name, &interface)?;

        let started = Instant::now();
        let parts = shaders
            .iter()
            .zip(&constants)
            .map(|(shader, constants)| StageParts::new(context, shader, constants))
            .collect::<Result<Vec<_>, _>>()?;
        let specializations: Vec<_> = parts.iter().map(StageParts::constants).collect();
        let stages: Vec<_> = parts.iter().zip(&specializations).map(|(part, info)| part.info(info)).collect();

        let bindings: Vec<_> = interface
            .inputs
            .iter()
            .map(|input| vk::VertexInputBindingDescription::default().binding(input.location))
            .collect();
        let attributes: Vec<_> = interface
            .inputs
            .iter()
            .map(|input| {
                vk::VertexInputAttributeDescription::default()
                    .location(input.location)
                    .binding(input.location)
                    .format(vertex_format(input.format))
            })
            .collect();
        let vertex_input = vk::PipelineVertexInputStateCreateInfo::default()
            .vertex_binding_descriptions(&bindings)
            .vertex_attribute_descriptions(&attributes);
        let assembly = vk::PipelineInputAssemblyStateCreateInfo::default().topology(desc.topology);
        let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
        let raster = vk::PipelineRasterizationStateCreateInfo::default().line_width(1.0);
        let multisample = vk::PipelineMultisampleStateCreateInfo::default()
            .rasterization_samples(vk::SampleCountFlags::from_raw(desc.samples));
        let depth = desc.depth.map_or(vk::PipelineDepthStencilStateCreateInfo::default(), |depth| {
            vk::PipelineDepthStencilStateCreateInfo::default()
                .depth_test_enable(true)
                .depth_write_enable(depth.write)
                .depth_compare_op(depth.compare)
        });
        let attachments: Vec<_> = desc.color.iter().map(blend_attachment).collect();
        let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&attachments);
        let states = [
            vk::DynamicState::VIEWPORT,
            vk::DynamicState::SCISSOR,
            vk::DynamicState::CULL_MODE,
            vk::DynamicState::FRONT_FACE,
            vk::DynamicState::VERTEX_INPUT_BINDING_STRIDE,
        ];
        // Without vertex bindings no stride is ever set, so it must not be dynamic.
        let state_count = if bindings.is_empty() { states.len() - 1 } else { states.len() };
        let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&states[..state_count]);
        if desc.color.len() > MAX_COLOR_TARGETS {
            let problem = format!("{} colour targets (at most {MAX_COLOR_TARGETS})", desc.color.len());
            return Err(GpuError::Unsupported { name: desc.name.to_owned(), problem });
        }
        let colors = desc.color.iter().map(|color| color.format);
        let targets = TargetFormats::new(colors, desc.depth.map(|depth| depth.format), desc.samples);
        let mut rendering = vk::PipelineRenderingCreateInfo::default()
            .color_attachment_formats(&targets.color[..desc.color.len()])
            .depth_attachment_format(targets.depth.unwrap_or_default());
        let info = vk::GraphicsPipelineCreateInfo::default()
            .stages(&stages)
            .vertex_input_state(&vertex_input)
            .input_assembly_state(&assembly)
            .viewport_state(&viewport)
            .rasterization_state(&raster)
            .multisample_state(&multisample)
            .depth_stencil_state(&depth)
            .color_blend_state(&blend)
            .dynamic_state(&dynamic)
            .layout(layout)
            .push_next(&mut rendering);
        // SAFETY: every pointer lives until the call returns; interface and layout come from the same reflection.
        let created = unsafe { context.device.create_graphics_pipelines(context.cache.raw, &[info], None) };
        let raw = first(desc.name, created)?;
        let creation_ms = started.elapsed().as_secs_f64() * 1e3;
        context.set_name(raw, desc.name);
        let head = describe_shaders("graphics", desc.name, &shaders, &constants);
        let description = head + &interface.describe() + &describe_state(desc);
        Ok(Pipeline(Arc::new(PipelineInner {
            context: context.clone(),
            raw,
            layout,
            set_layouts,
            interface,
            name: desc.name.to_owned(),
            bind_point: vk::PipelineBindPoint::GRAPHICS,
            targets,
            topology: desc.topology,
            description,
            creation_ms,
        })))
    }

    /// Creates a compute pipeline; `constants` as in [`GraphicsDesc`].
    ///
    /// # Errors
    /// As [`Gpu::graphics_pipeline`].
    pub fn compute_pipeline(
        &self,
        name: &str,
        shader: &'static Shader,
        constants: &[(&str, u32)],
    ) -> Result<Pipeline, GpuError> {
        expect_stage(name, shader, Stage::Compute)?;
        let context = self.context();
        let interface = Interface::merge(name, &[shader])?;
        let constants = specialize(name, &[shader], constants)?;
        let (set_layouts, layout) = lock(&context.layouts).of(&context.device, name, &interface)?;
        let started = Instant::now();
        let part = StageParts::new(context, shader, constants.first().map_or(&[], Vec::as_slice))?;
        let specialization = part.constants();
        let info = vk::ComputePipelineCreateInfo::default().stage(part.info(&specialization)).layout(layout);
        // SAFETY: every pointer lives until the call returns; interface and layout come from the same reflection.
        let created = unsafe { context.device.create_compute_pipelines(context.cache.raw, &[info], None) };
        let raw = first(name, created)?;
        let creation_ms = started.elapsed().as_secs_f64() * 1e3;
        context.set_name(raw, name);
        let [x, y, z] = shader.workgroup_size;
        let head = describe_shaders("compute", name, &[shader], &constants);
        let description = head + &interface.describe() + &format!("  workgroup: {x}x{y}x{z}\n");
        Ok(Pipeline(Arc::new(PipelineInner {
            context: context.clone(),
            raw,
            layout,
            set_layouts,
            interface,
            name: name.to_owned(),
            bind_point: vk::PipelineBindPoint::COMPUTE,
            targets: TargetFormats::default(),
            topology: vk::PrimitiveTopology::default(),
            description,
            creation_ms,
        })))
    }
}

/// The one pipeline that was asked for; a failed creation yields only null handles, which need no destruction.
fn first(
    name: &str,
    created: Result<Vec<vk::Pipeline>, (Vec<vk::Pipeline>, vk::Result)>,
) -> Result<vk::Pipeline, GpuError> {
    let failed = |result| GpuError::from_vk("creating pipeline", name, result);
    let pipelines = created.map_err(|(_, result)| failed(result))?;
    pipelines.first().copied().ok_or_else(|| failed(vk::Result::ERROR_UNKNOWN))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shader::{Defines, ShaderFile, ShaderKey, Spirv};

    #[test]
    fn more_textures_than_a_stage_reads_are_refused() {
        let defines = Defines::UV | Defines::TANGENT | Defines::MAPS | Defines::SHEEN;
        let layered = ShaderKey::new(ShaderFile::LayeredFrag, defines).shader();
        let problem = too_many_textures(layered, 16).unwrap();
        assert!(problem.ends_with("textures in one shader (reads at most 16)"), "{problem}");
        assert_eq!(too_many_textures(layered, 32), None);
    }

    #[test]
    fn a_crate_without_shaders_says_so() {
        let built = ShaderKey::new(ShaderFile::ToneMappingVert, Defines::NONE).shader();
        assert!(expect_stage("tonemap", built, Stage::Vertex).is_ok());
        let empty = Shader { spirv: Spirv::Plain(&[]), ..*built };
        let error = expect_stage("tonemap", &empty, Stage::Vertex).unwrap_err().to_string();
        assert!(error.starts_with("pipeline 'tonemap': vair was built without shaders: build it where"), "{error}");
    }
}
