//! Which pipeline a draw needs: shader permutations, constants and fixed state, decided before the device is asked. Two
//! draws that need the same are equal here.

use crate::asset::Topology;
use crate::gpu::{BlendState, ColorState, DepthState, Gpu, GpuError, GraphicsDesc, Pipeline, TargetFormats};
use crate::render::surface::{Map, Table};
use crate::shader::{Defines, Shader, ShaderFile, ShaderKey};
use ash::vk;
use std::collections::BTreeSet;

/// Descriptor sets that every device has (Vulkan 1.3, "Required Limits", maxBoundDescriptorSets).
const SET_COUNT: u32 = 4;

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

/// Which of two fragments a depth test keeps; of equals the later.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum DepthCompare {
    /// The greater depth: the nearer where depth is reversed (1 at the near plane).
    #[default]
    Greater,
    /// The smaller depth: the nearer where depth is standard (0 at the near plane).
    Less,
}

/// How a fragment meets what its target holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Blending {
    /// It takes its place.
    #[default]
    Replace,
    /// It lies over it, premultiplied.
    Over,
    /// They add up.
    Sum,
}

/// What a pipeline draws for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Eye {
    /// The views of the frame.
    #[default]
    Camera,
    /// The shadow maps.
    Light,
}

/// The shaders by which passes that do not shade draw the same thing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Variants {
    /// Vertex and fragment shader into the G-buffer, without `MOTION`; `None` for what is not in it.
    pub gbuffer: Option<[ShaderKey; 2]>,
    /// Into shadow maps, without `LAYERS`.
    pub shadow: [ShaderKey; 2],
    /// It lets light through in part: fur, sheer families, and what blends by its alpha. What transmits light otherwise
    /// casts the shadow of something opaque.
    pub casts_in_part: bool,
    /// The fragment shader that counts instead of shading. It keeps what decides where fragments are and survive.
    pub count: ShaderKey,
}

/// A graphics pipeline.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct PipelineSpec {
    /// Vertex shader.
    pub vertex: ShaderKey,
    /// Fragment shader.
    pub fragment: ShaderKey,
    /// Specialization constants by GLSL name; those left out keep the shader's default.
    pub constants: Vec<(&'static str, u32)>,
    /// Points, lines or triangles.
    pub topology: Topology,
    /// What it draws for.
    pub eye: Eye,
    /// How its fragments meet the colour targets.
    pub blending: Blending,
    /// Use of depth.
    pub depth: DepthUse,
    /// Depth test.
    pub compare: DepthCompare,
    /// Formats and samples of the targets.
    pub targets: TargetFormats,
    /// How other passes draw the same; `None` for what is not part of the scene.
    pub variants: Option<Variants>,
}

/// A compute pipeline.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct ComputeSpec {
    /// Shader.
    pub shader: ShaderKey,
    /// Specialization constants by GLSL name.
    pub constants: Vec<(&'static str, u32)>,
}

impl PipelineSpec {
    /// A triangle over the whole of one target, at one sample a pixel, by that fragment shader.
    pub fn full_screen(fragment: ShaderKey, constants: Vec<(&'static str, u32)>, format: vk::Format) -> Self {
        Self {
            vertex: ShaderKey::new(ShaderFile::ToneMappingVert, Defines::NONE),
            fragment,
            constants,
            topology: Topology::Triangles,
            eye: Eye::Camera,
            blending: Blending::Replace,
            depth: DepthUse::None,
            compare: DepthCompare::default(),
            targets: TargetFormats::new([format], None, 1),
            variants: None,
        }
    }

    /// Whether its fragments go to the pixels' linked lists instead of the targets.
    pub fn builds_lists(&self) -> bool {
        self.fragment.defines.contains(Defines::LIST)
    }

    /// Whether it shows light: draws for a camera, and is not unlit.
    pub fn is_lit(&self) -> bool {
        self.eye == Eye::Camera && !self.fragment.defines.contains(Defines::UNLIT)
    }

    /// The value of a constant that it gives.
    pub fn constant(&self, name: &str) -> Option<u32> {
        self.constants.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
    }

    /// Those of its constants that these shaders have, too.
    pub fn constants_of(&self, shaders: [ShaderKey; 2]) -> Vec<(&'static str, u32)> {
        let stages = shaders.map(ShaderKey::shader);
        let is_known = |name: &str| stages.iter().any(|stage| stage.constants.iter().any(|known| known.name == name));
        self.constants.iter().filter(|(name, _)| is_known(name)).copied().collect()
    }

    /// [`Self::constants_of`] for one sample a pixel.
    pub fn constants_at_one_sample(&self, shaders: [ShaderKey; 2]) -> Vec<(&'static str, u32)> {
        let mut constants = self.constants_of(shaders);
        for (name, value) in &mut constants {
            if *name == "SAMPLE_COUNT" {
                *value = 1;
            }
        }
        constants
    }

    /// Whether its shaders sample the map.
    pub fn samples_map(&self, map: &Map) -> bool {
        self.constant(map.constant).is_some_and(|value| value != 0)
    }

    /// Whether its shaders have the map's bindings, sampled or not.
    pub fn binds_map(&self, map: &Map) -> bool {
        self.binds(&map.texture_name())
    }

    /// Whether its shaders look something up in the table.
    pub fn binds_table(&self, table: &Table) -> bool {
        self.binds(&table.texture_name())
    }

    /// Whether its shaders have a descriptor of that name.
    pub fn binds(&self, name: &str) -> bool {
        self.shaders().iter().flat_map(|shader| shader.bindings).any(|binding| binding.name == name)
    }

    /// Names of its descriptors.
    pub fn bindings(&self) -> BTreeSet<&'static str> {
        (0..SET_COUNT).flat_map(|set| self.bindings_of(set)).collect()
    }

    /// Descriptor sets that it has anything in.
    pub fn sets(&self) -> BTreeSet<u32> {
        self.shaders().into_iter().flat_map(|shader| shader.bindings).map(|binding| binding.set).collect()
    }

    /// Names of the descriptors of one set. Pipelines that have the same can share a bind group.
    pub fn bindings_of(&self, set: u32) -> BTreeSet<&'static str> {
        let bindings = self.shaders().into_iter().flat_map(|shader| shader.bindings);
        bindings.filter(|binding| binding.set == set).map(|binding| binding.name).collect()
    }

    /// Names of its vertex inputs.
    pub fn inputs(&self) -> BTreeSet<&'static str> {
        self.vertex.shader().inputs.iter().map(|input| input.name).collect()
    }

    /// Short name for labels and reports: the fragment shader's permutation.
    pub fn name(&self) -> &'static str {
        self.fragment.shader().name
    }

    fn shaders(&self) -> [&'static Shader; 2] {
        [self.vertex.shader(), self.fragment.shader()]
    }

    /// Makes it.
    ///
    /// # Errors
    /// Those of [`Gpu::graphics_pipeline`].
    pub fn create(&self, gpu: &Gpu) -> Result<Pipeline, GpuError> {
        let blend = match self.blending {
            Blending::Replace => None,
            Blending::Over => Some(BlendState::PREMULTIPLIED_OVER),
            Blending::Sum => Some(BlendState::SUM),
        };
        let formats = self.targets.color.iter().take_while(|format| **format != vk::Format::UNDEFINED);
        let color: Vec<_> = formats.map(|format| ColorState { blend, ..ColorState::replace(*format) }).collect();
        gpu.graphics_pipeline(&GraphicsDesc {
            name: self.name(),
            vertex: self.vertex.shader(),
            fragment: Some(self.fragment.shader()),
            constants: &self.constants,
            topology: match self.topology {
                Topology::Points => vk::PrimitiveTopology::POINT_LIST,
                Topology::Lines => vk::PrimitiveTopology::LINE_LIST,
                Topology::Triangles => vk::PrimitiveTopology::TRIANGLE_LIST,
            },
            samples: self.targets.samples,
            color: &color,
            depth: self.targets.depth.filter(|_| self.depth != DepthUse::None).map(|format| DepthState {
                format,
                write: self.depth == DepthUse::TestAndWrite,
                compare: match self.compare {
                    DepthCompare::Greater => vk::CompareOp::GREATER_OR_EQUAL,
                    DepthCompare::Less => vk::CompareOp::LESS_OR_EQUAL,
                },
            }),
        })
    }
}

impl ComputeSpec {
    /// Makes it.
    ///
    /// # Errors
    /// Those of [`Gpu::compute_pipeline`].
    pub fn create(&self, gpu: &Gpu) -> Result<Pipeline, GpuError> {
        let shader = self.shader.shader();
        gpu.compute_pipeline(shader.name, shader, &self.constants)
    }
}
