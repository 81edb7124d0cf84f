//! The compiled shaders and what they ask of a pipeline.
//!
//! `build.rs` compiles every line of `shaders_glsl/permutations` to SPIR-V, reflects it and writes
//! what is generated here: [`table`] (one [`Shader`] per permutation), the types of [`ShaderKey`] that name them, and
//! [`layout`] (one `repr(C)` struct per uniform, storage or push-constant block, with offset asserts).

#[cfg(feature = "measure")]
pub mod function;
mod key;
pub mod layout;
mod spirv;
pub mod table;

pub use key::{Defines, ShaderFile, ShaderKey};
pub use spirv::{Pack, Spirv};

/// One compiled permutation: SPIR-V and its interface.
#[derive(Debug)]
pub struct Shader {
    /// `<pass stem>.<stage>[+DEFINE...]`, for example `standard.frag+UV+COLOR`.
    pub name: &'static str,
    /// Stage.
    pub stage: Stage,
    /// Where its SPIR-V is; [`Self::spirv`] gives it.
    pub spirv: Spirv,
    /// Tells apart what was compiled: FNV-1a of the words' bytes.
    pub spirv_hash: u64,
    /// Descriptors, ordered by (set, binding).
    pub bindings: &'static [Binding],
    /// Bytes of push constants, 0 without.
    pub push_constant_bytes: u32,
    /// Specialization constants, ordered by id.
    pub constants: &'static [SpecConstant],
    /// Vertex inputs, ordered by location; empty for other stages.
    pub inputs: &'static [VertexInput],
    /// Workgroup size of a compute shader, otherwise 0.
    pub workgroup_size: [u32; 3],
}

impl Shader {
    /// SPIR-V; the entry point is `main`. Shaders of a file are unpacked together when one is first asked for, which
    /// takes some milliseconds.
    pub fn spirv(&self) -> &'static [u32] {
        self.spirv.words()
    }
}

/// Pipeline stage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Vertex.
    Vertex,
    /// Fragment.
    Fragment,
    /// Compute.
    Compute,
}

/// One descriptor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Binding {
    /// Descriptor set.
    pub set: u32,
    /// Binding in the set.
    pub binding: u32,
    /// Name in the GLSL.
    pub name: &'static str,
    /// What is bound.
    pub kind: BindingKind,
}

/// What a descriptor holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BindingKind {
    /// Uniform block of that many bytes.
    Uniform {
        /// Size of the block.
        bytes: u32,
    },
    /// Storage block.
    Storage {
        /// The shader does not write it.
        readonly: bool,
    },
    /// `texture2D` and the like, without its sampler.
    Texture,
    /// `textureCube`, without its sampler.
    Cube,
    /// `sampler`.
    Sampler,
    /// Storage image.
    StorageImage,
}

/// One specialization constant; all are 32 bits wide.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SpecConstant {
    /// Name in the GLSL.
    pub name: &'static str,
    /// `constant_id`.
    pub id: u32,
    /// Bits of the default value.
    pub default_bits: u32,
}

/// One vertex input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct VertexInput {
    /// Name in the GLSL.
    pub name: &'static str,
    /// Location.
    pub location: u32,
    /// Component type and count.
    pub format: VertexFormat,
}

/// Type of a vertex input as the shader sees it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum VertexFormat {
    /// `float`.
    Float,
    /// `vec2`.
    Vec2,
    /// `vec3`.
    Vec3,
    /// `vec4`.
    Vec4,
    /// `uint`.
    Uint,
}
