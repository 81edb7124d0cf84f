//! Which pipeline a draw needs: shader permutations, constants and fixed state, decided before the device is
//! asked. Two draws that need the same are equal here.

use super::options::{FrameOptions, HdrFormat, ShellOrder, Shells, Tonemap};
use crate::asset::{Primitive, Topology};
use crate::gpu::{BlendState, ColorState, DepthState, Gpu, GpuError, GraphicsDesc, Pipeline};
use crate::material::{AlphaMode, Blend, Fur, Shape, Standard};
use crate::shader::{Shader, table};
use ash::vk;
use glam::Vec2;

/// Depth is 32-bit float, reversed: 1 at the near plane.
pub const DEPTH_FORMAT: vk::Format = vk::Format::D32_SFLOAT;

/// What a pipeline does with depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum DepthUse {
    /// No depth target.
    None,
    /// Hidden fragments are rejected.
    Test,
    /// Hidden fragments are rejected, others are recorded.
    TestAndWrite,
}

/// A graphics pipeline.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct PipelineSpec {
    /// `<file>+<define>...` of the vertex shader, as in `shaders_glsl/permutations`.
    pub vertex: String,
    /// The same for the fragment shader.
    pub fragment: String,
    /// Specialization constants by GLSL name; those left out keep the shader's default.
    pub constants: Vec<(&'static str, u32)>,
    /// Points, lines or triangles.
    pub topology: Topology,
    /// Premultiplied over-blending.
    pub blend: bool,
    /// Use of depth.
    pub depth: DepthUse,
    /// Samples a pixel.
    pub samples: u32,
    /// Format of the colour target.
    pub color_format: vk::Format,
}

/// A compute pipeline.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct ComputeSpec {
    /// `<file>+<define>...` of the shader.
    pub shader: String,
    /// Specialization constants by GLSL name.
    pub constants: Vec<(&'static str, u32)>,
}

/// `standard.frag` and the defines that hold: `standard.frag+UV+COLOR`.
fn permutation(file: &str, defines: &[(&str, bool)]) -> String {
    let mut name = file.to_owned();
    for (define, _) in defines.iter().filter(|(_, holds)| *holds) {
        name.push('+');
        name.push_str(define);
    }
    name
}

/// The compiled shader of that name.
///
/// # Panics
/// When `shaders_glsl/permutations` does not list it; a test walks every combination that this file makes.
pub fn shader(name: &str) -> &'static Shader {
    table::ALL.iter().find(|shader| shader.name == name).unwrap_or_else(|| panic!("no shader permutation {name}"))
}

/// Alpha mode as the shader's ALPHA_MODE constant.
fn alpha_constant(mode: AlphaMode) -> u32 {
    match mode {
        AlphaMode::Opaque => 0,
        AlphaMode::Mask => 1,
        AlphaMode::Blend => 2,
    }
}

impl PipelineSpec {
    /// The pipeline that shows `standard` on `primitive`.
    pub fn surface(standard: &Standard, primitive: &Primitive, options: &FrameOptions) -> Self {
        let vertices = &primitive.vertices;
        let unlit = standard.unlit || vertices.normals.is_empty();
        let has_uv = !vertices.uv_sets.is_empty();
        let has_tangent = !vertices.tangents.is_empty();
        let base = has_uv && standard.base_color_texture.is_some();
        let metallic_roughness = has_uv && !unlit && standard.metallic_roughness_texture.is_some();
        let occlusion = has_uv && !unlit && standard.occlusion_texture.is_some();
        let emissive = has_uv && !unlit && standard.emissive_texture.is_some();
        let tangent_space = has_uv && !unlit && has_tangent;
        let normal = tangent_space && standard.normal_texture.is_some();
        let detail_albedo = tangent_space && standard.detail_albedo_texture.is_some();
        let detail_normal = tangent_space && standard.detail_normal_texture.is_some();
        let detail = detail_albedo || detail_normal;
        let tangent = normal || detail;
        let uv = base || metallic_roughness || occlusion || emissive || tangent;
        let color = !vertices.colors.is_empty();
        let blend = standard.alpha_mode == AlphaMode::Blend;

        let vertex_defines = [("UNLIT", unlit), ("UV", uv), ("TANGENT", tangent), ("COLOR", color)];
        let fragment_defines =
            [("UNLIT", unlit), ("UV", uv), ("TANGENT", tangent), ("DETAIL", detail), ("COLOR", color)];
        let mut constants = vec![("ALPHA_MODE", alpha_constant(standard.alpha_mode)), ("SAMPLE_COUNT", options.msaa)];
        if !unlit {
            constants.push(("DOUBLE_SIDED", standard.double_sided.into()));
        }
        for (name, holds) in [
            ("HAS_BASE_COLOR_MAP", base),
            ("HAS_METALLIC_ROUGHNESS_MAP", metallic_roughness),
            ("HAS_OCCLUSION_MAP", occlusion),
            ("HAS_EMISSIVE_MAP", emissive),
            ("HAS_NORMAL_MAP", normal),
            ("HAS_DETAIL_ALBEDO_MAP", detail_albedo),
            ("HAS_DETAIL_NORMAL_MAP", detail_normal),
        ] {
            if holds {
                constants.push((name, 1));
            }
        }
        Self {
            vertex: permutation("standard.vert", &vertex_defines),
            fragment: permutation("standard.frag", &fragment_defines),
            constants,
            topology: primitive.topology,
            blend,
            depth: if blend { DepthUse::Test } else { DepthUse::TestAndWrite },
            samples: options.msaa,
            color_format: options.hdr_format.vulkan(),
        }
    }

    /// The pipeline of the shells of `fur` over the surface `standard` of `primitive`.
    pub fn fur(fur: &Fur, standard: &Standard, primitive: &Primitive, options: &FrameOptions) -> Self {
        let Shells { sampling, alpha, submission, order } = options.shells;
        let blend = fur.blend == Blend::Blend || order == ShellOrder::Blended;
        let maps = [
            ("HAS_HEIGHT_MAP", fur.height_map.is_some()),
            ("HAS_DISTRIBUTION_MAP", fur.distribution_map.is_some()),
            ("HAS_BASE_COLOR_MAP", fur.color_over(standard).1.is_some()),
            ("HAS_SPOT_MAP", fur.spot_map.is_some()),
            ("HAS_COMB_MAP", fur.comb_map.is_some()),
        ];
        let has_maps = maps.iter().any(|(_, has)| *has);
        let color = !primitive.vertices.colors.is_empty();
        let combed = fur.comb != Vec2::ZERO || fur.comb_map.is_some();
        let mut constants = vec![("SAMPLE_COUNT", options.msaa)];
        let switches = [
            ("INNER_FIRST", blend || order == ShellOrder::InnerFirst),
            ("BLEND", blend),
            ("KEEP_PARTIAL", fur.blend == Blend::Coverage),
            ("PARABOLOID", fur.shape == Shape::Paraboloid),
            ("HAS_LOCKS", fur.clump > 0.0 || fur.curl > 0.0),
            ("PROJECT_UV", has_maps && primitive.vertices.uv_sets.is_empty()),
        ];
        constants.extend(switches.iter().chain(&maps).filter(|(_, holds)| *holds).map(|(name, _)| (*name, 1)));
        let choices = [("SAMPLING", sampling as u32), ("ALPHA", alpha as u32), ("SHELL_SOURCE", submission as u32)];
        constants.extend(choices.into_iter().filter(|(_, choice)| *choice != 0));
        Self {
            vertex: permutation("fur.vert", &[("MAPS", has_maps), ("COMB", combed), ("COLOR", color)]),
            fragment: permutation("fur.frag", &[("MAPS", has_maps), ("COLOR", color)]),
            constants,
            topology: Topology::Triangles,
            blend,
            depth: if blend { DepthUse::Test } else { DepthUse::TestAndWrite },
            samples: options.msaa,
            color_format: options.hdr_format.vulkan(),
        }
    }

    /// Format of the counting pipelines' target, which nobody reads: Vulkan wants one where samples matter.
    pub const COUNTING_FORMAT: vk::Format = vk::Format::R8_UNORM;

    /// The pipeline that counts the fragments of this one of a surface or coat instead of shading them. It keeps what
    /// decides where they are and how much of them survives, and tests depth by itself.
    pub fn counting(&self) -> Self {
        let (file, defines) = self.fragment.split_once('+').unwrap_or((&self.fragment, ""));
        // The colours of vertices reach a coat's length, and no further.
        let kept: &[&str] = if file == "fur.frag" { &["MAPS"] } else { &["UV", "COLOR"] };
        let kept = kept.iter().map(|define| (*define, defines.split('+').any(|given| given == *define)));
        let fragment = permutation(file, &[("COUNT", true)].into_iter().chain(kept).collect::<Vec<_>>());
        let stages = [shader(&self.vertex), shader(&fragment)];
        let is_known = |name: &str| stages.iter().any(|stage| stage.constants.iter().any(|known| known.name == name));
        Self {
            vertex: self.vertex.clone(),
            constants: self.constants.iter().filter(|(name, _)| is_known(name)).copied().collect(),
            fragment,
            depth: DepthUse::None,
            color_format: Self::COUNTING_FORMAT,
            ..*self
        }
    }

    /// The pipeline that makes a picture of `target_format` from the HDR image.
    pub fn tonemap(tonemap: Tonemap, hdr_format: HdrFormat, target_format: vk::Format) -> Self {
        Self {
            vertex: "tonemap.vert".to_owned(),
            fragment: "tonemap.frag".to_owned(),
            constants: vec![
                ("OPERATOR", tonemap.operator()),
                ("ENCODE_SRGB", u32::from(!is_srgb(target_format))),
                ("HAS_ALPHA", u32::from(hdr_format == HdrFormat::Rgba16f)),
            ],
            topology: Topology::Triangles,
            blend: false,
            depth: DepthUse::None,
            samples: 1,
            color_format: target_format,
        }
    }

    /// Whether its shaders sample the map that they call `<name>_map`.
    pub fn samples_map(&self, name: &str) -> bool {
        let constant = format!("HAS_{}_MAP", name.to_uppercase());
        self.constants.iter().any(|(name, value)| *name == constant && *value != 0)
    }

    /// Short name for labels and reports: the fragment shader's permutation.
    pub fn name(&self) -> &str {
        &self.fragment
    }

    /// Makes it.
    ///
    /// # Errors
    /// Those of [`Gpu::graphics_pipeline`].
    pub fn create(&self, gpu: &Gpu) -> Result<Pipeline, GpuError> {
        gpu.graphics_pipeline(&GraphicsDesc {
            name: self.name(),
            vertex: shader(&self.vertex),
            fragment: Some(shader(&self.fragment)),
            constants: &self.constants,
            topology: match self.topology {
                Topology::Points => vk::PrimitiveTopology::POINT_LIST,
                Topology::Lines => vk::PrimitiveTopology::LINE_LIST,
                Topology::Triangles => vk::PrimitiveTopology::TRIANGLE_LIST,
            },
            samples: self.samples,
            color: &[ColorState {
                format: self.color_format,
                blend: self.blend.then_some(BlendState::PREMULTIPLIED_OVER),
                write_mask: vk::ColorComponentFlags::RGBA,
            }],
            depth: (self.depth != DepthUse::None).then_some(DepthState {
                format: DEPTH_FORMAT,
                write: self.depth == DepthUse::TestAndWrite,
                compare: vk::CompareOp::GREATER_OR_EQUAL,
            }),
        })
    }
}

impl ComputeSpec {
    /// The pipeline that moves one stream: `stream` 0 positions, 1 normals and shell directions, 2 tangents.
    pub fn deform(skin: bool, morph: bool, stream: u32) -> Self {
        Self {
            shader: permutation("deform.comp", &[("SKIN", skin), ("MORPH", morph)]),
            constants: vec![("STREAM", stream)],
        }
    }

    /// Makes it.
    ///
    /// # Errors
    /// Those of [`Gpu::compute_pipeline`].
    pub fn create(&self, gpu: &Gpu) -> Result<Pipeline, GpuError> {
        gpu.compute_pipeline(&self.shader, shader(&self.shader), &self.constants)
    }
}

fn is_srgb(format: vk::Format) -> bool {
    matches!(format, vk::Format::R8G8B8A8_SRGB | vk::Format::B8G8R8A8_SRGB)
}
