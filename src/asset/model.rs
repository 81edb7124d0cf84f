//! Plain data of a loaded file: no file handles, no GPU types, no glTF types.
//!
//! Everything here has been checked once, at load: every index lies inside the list it points
//! into, every number is finite, node parents form a forest. Later rooms rely on that and check
//! nothing again. Units are metres, seconds and radians; space is right-handed, Y up (glTF 2.0,
//! section 3.4).

use super::MaterialExtensions;
use glam::{Mat4, Quat, Vec2, Vec3, Vec4};

/// A whole file.
#[derive(Debug, Clone, Default)]
pub struct Asset {
    /// At least one scene; a file without any gets one that holds every root node.
    pub scenes: Vec<AssetScene>,
    /// Index into `scenes`.
    pub default_scene: usize,
    /// All nodes; `children` of each come from here.
    pub nodes: Vec<Node>,
    /// All meshes.
    pub meshes: Vec<Mesh>,
    /// All materials. A primitive without a material points to an appended default one.
    pub materials: Vec<Material>,
    /// Texture = image + sampler.
    pub textures: Vec<Texture>,
    /// Decoded images that some texture of some material uses; others stay empty (0 x 0).
    pub images: Vec<Image>,
    /// Cameras.
    pub cameras: Vec<Camera>,
    /// KHR_lights_punctual.
    pub lights: Vec<Light>,
    /// Skins.
    pub skins: Vec<Skin>,
    /// Animation clips.
    pub animations: Vec<Animation>,
    /// KHR_materials_variants: names.
    pub variants: Vec<String>,
    /// Non-fatal oddities, one line each: what, where, what was done instead.
    pub warnings: Vec<String>,
    /// What counts against [`super::LoadOptions::memory_limit_bytes`] so far; 0 for data made in memory.
    pub loaded_bytes: u64,
}

/// One scene: its root nodes.
#[derive(Debug, Clone, Default)]
pub struct AssetScene {
    /// Name in the file.
    pub name: Option<String>,
    /// Indices into [`Asset::nodes`].
    pub roots: Vec<usize>,
}

/// One node of the forest.
#[derive(Debug, Clone, Default)]
pub struct Node {
    /// Name in the file.
    pub name: Option<String>,
    /// Indices into [`Asset::nodes`]; a node has at most one parent.
    pub children: Vec<usize>,
    /// Rest pose.
    pub transform: Transform,
    /// Index into [`Asset::meshes`].
    pub mesh: Option<usize>,
    /// Index into [`Asset::skins`].
    pub skin: Option<usize>,
    /// Index into [`Asset::cameras`].
    pub camera: Option<usize>,
    /// Index into [`Asset::lights`].
    pub light: Option<usize>,
    /// Morph weights of this instance; empty = those of the mesh.
    pub weights: Vec<f32>,
}

/// Local transform: translation, rotation, scale, or a matrix that has none (shear).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Transform {
    /// Translation, rotation (unit length), scale. Animations drive only this form.
    Trs {
        /// Metres.
        translation: Vec3,
        /// Unit quaternion.
        rotation: Quat,
        /// Factor per axis; may be negative or 0.
        scale: Vec3,
    },
    /// A matrix as the file gives it.
    Matrix(Mat4),
}

impl Default for Transform {
    fn default() -> Self {
        Self::Trs { translation: Vec3::ZERO, rotation: Quat::IDENTITY, scale: Vec3::ONE }
    }
}

impl Transform {
    /// `parent_from_local`.
    pub fn matrix(&self) -> Mat4 {
        match *self {
            Self::Trs { translation, rotation, scale } => {
                Mat4::from_scale_rotation_translation(scale, rotation, translation)
            }
            Self::Matrix(matrix) => matrix,
        }
    }
}

/// A mesh: primitives that share morph weights.
#[derive(Debug, Clone, Default)]
pub struct Mesh {
    /// Name in the file.
    pub name: Option<String>,
    /// At least one, unless each was skipped with a warning.
    pub primitives: Vec<Primitive>,
    /// Default morph weights, one per target.
    pub weights: Vec<f32>,
}

/// What an index list means after strips, loops and fans were unrolled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Topology {
    /// One vertex each.
    Points,
    /// Two vertices each.
    Lines,
    /// Three vertices each, counter-clockwise front.
    #[default]
    Triangles,
}

/// One draw: one material, one vertex set.
#[derive(Debug, Clone, Default)]
pub struct Primitive {
    /// Index into [`Asset::materials`].
    pub material: usize,
    /// (variant, material) of KHR_materials_variants.
    pub variant_materials: Vec<(usize, usize)>,
    /// What `indices` means.
    pub topology: Topology,
    /// Always present (generated 0.. when the file has none); a multiple of the topology's count;
    /// each below `vertices.positions.len()`.
    pub indices: Vec<u32>,
    /// Vertex attributes.
    pub vertices: Vertices,
    /// One per morph target of the mesh.
    pub morph_targets: Vec<MorphTarget>,
}

/// Vertex attributes; each list is empty (absent) or as long as `positions`.
#[derive(Debug, Clone, Default)]
pub struct Vertices {
    /// Metres, object space.
    pub positions: Vec<Vec3>,
    /// Unit length. Present for triangles always: a file without normals gets flat ones (its
    /// vertices are then unshared, glTF 2.0 section 3.7.2.1). May be empty for points and lines,
    /// which are then shown unlit.
    pub normals: Vec<Vec3>,
    /// xyz unit length, w = +1 or -1: bitangent = w cross(normal, tangent). Present where the file
    /// has them or where the material needs them (MikkTSpace, Mikkelsen 2008).
    pub tangents: Vec<Vec4>,
    /// TEXCOORD_0, TEXCOORD_1, ... ; at most [`MAX_UV_SETS`].
    pub uv_sets: Vec<Vec<Vec2>>,
    /// COLOR_0, linear RGBA in [0, 1].
    pub colors: Vec<Vec4>,
    /// Joint influences: `influences_per_vertex` entries a vertex, (joint of the skin, weight),
    /// weights sum to 1. Joint indices lie inside every skin that draws this primitive.
    pub joints: Vec<(u16, f32)>,
    /// 0 without a skin, otherwise 4 per joint set of the file.
    pub influences_per_vertex: usize,
}

/// UV sets that are kept; more are dropped with a warning.
pub const MAX_UV_SETS: usize = 2;

/// Offsets that a morph weight scales; each list is empty or as long as the positions.
#[derive(Debug, Clone, Default)]
pub struct MorphTarget {
    /// Metres.
    pub positions: Vec<Vec3>,
    /// Added to the unit normal.
    pub normals: Vec<Vec3>,
    /// Added to the tangent's xyz.
    pub tangents: Vec<Vec3>,
}

/// A texture: which image, sampled how.
#[derive(Debug, Clone, Default)]
pub struct Texture {
    /// Index into [`Asset::images`].
    pub image: usize,
    /// Filters and wrap modes.
    pub sampler: Sampler,
}

/// Wrap mode of one axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Wrap {
    /// Tiles.
    #[default]
    Repeat,
    /// Tiles, every second one mirrored.
    Mirror,
    /// The border texel goes on.
    Clamp,
}

/// Filters and wrap modes of a texture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Sampler {
    /// Wrap of u and v.
    pub wrap: [Wrap; 2],
    /// Linear magnification.
    pub mag_linear: bool,
    /// Linear minification.
    pub min_linear: bool,
    /// `None` = level 0 alone, `Some(linear between levels)`.
    pub mip_linear: Option<bool>,
}

impl Default for Sampler {
    fn default() -> Self {
        Self { wrap: [Wrap::Repeat; 2], mag_linear: true, min_linear: true, mip_linear: Some(true) }
    }
}

/// A decoded picture: 8-bit RGBA, rows from the top, as stored (sRGB or data: the user of it knows).
#[derive(Debug, Clone, Default)]
pub struct Image {
    /// Name in the file, or its URI, or "image N".
    pub name: String,
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// `width * height * 4` bytes.
    pub rgba: Vec<u8>,
}

/// Where a material reads a texture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextureRef {
    /// Index into [`Asset::textures`].
    pub texture: usize,
    /// UV set, below [`MAX_UV_SETS`]; a primitive that lacks it reads uv (0, 0).
    pub uv_set: u32,
    /// KHR_texture_transform: `uv' = translation + rotation(scale * uv)`.
    pub offset: Vec2,
    /// Radians, counter-clockwise as that extension defines it.
    pub rotation: f32,
    /// Factor per axis.
    pub scale: Vec2,
}

/// Alpha mode of a glTF material.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum AlphaMode {
    /// Alpha is ignored.
    #[default]
    Opaque,
    /// Shown where alpha >= cutoff.
    Mask(f32),
    /// Over-blending.
    Blend,
}

/// A glTF material, as the file says it. Colours are linear.
#[derive(Debug, Clone)]
pub struct Material {
    /// Name in the file.
    pub name: Option<String>,
    /// Linear RGBA factor.
    pub base_color: Vec4,
    /// sRGB-coded texture.
    pub base_color_texture: Option<TextureRef>,
    /// Factor in [0, 1].
    pub metallic: f32,
    /// Perceptual roughness factor in [0, 1].
    pub roughness: f32,
    /// Data: G = roughness, B = metallic.
    pub metallic_roughness_texture: Option<TextureRef>,
    /// Data: tangent-space normal, OpenGL convention.
    pub normal_texture: Option<TextureRef>,
    /// Scale of the normal map's x and y.
    pub normal_scale: f32,
    /// Data: R = occlusion.
    pub occlusion_texture: Option<TextureRef>,
    /// Strength in [0, 1].
    pub occlusion_strength: f32,
    /// Linear RGB, times KHR_materials_emissive_strength; >= 0.
    pub emissive: Vec3,
    /// sRGB-coded texture.
    pub emissive_texture: Option<TextureRef>,
    /// Alpha mode.
    pub alpha_mode: AlphaMode,
    /// Both faces are drawn; the back one with its normal flipped.
    pub double_sided: bool,
    /// KHR_materials_unlit.
    pub unlit: bool,
    /// What it has beside the standard surface.
    pub extensions: MaterialExtensions,
    /// `extras.vair` and `extensions.VAIR_material` merged (the extension wins): look keys.
    pub vair: Option<serde_json::Map<String, serde_json::Value>>,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: None,
            base_color: Vec4::ONE,
            base_color_texture: None,
            metallic: 1.0,
            roughness: 1.0,
            metallic_roughness_texture: None,
            normal_texture: None,
            normal_scale: 1.0,
            occlusion_texture: None,
            occlusion_strength: 1.0,
            emissive: Vec3::ZERO,
            emissive_texture: None,
            alpha_mode: AlphaMode::Opaque,
            double_sided: false,
            unlit: false,
            extensions: MaterialExtensions::default(),
            vair: None,
        }
    }
}

/// A camera; it looks along -Z of its node.
#[derive(Debug, Clone, Default)]
pub struct Camera {
    /// Name in the file.
    pub name: Option<String>,
    /// Projection.
    pub projection: Projection,
}

/// Projection of a camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Vertical field of view.
    Perspective {
        /// Radians.
        vertical_fov: f32,
        /// Width over height; `None` = that of the picture.
        aspect: Option<f32>,
        /// Metres, > 0.
        near_m: f32,
        /// Metres; `None` = infinite.
        far_m: Option<f32>,
    },
    /// Parallel.
    Orthographic {
        /// Half the width, metres.
        half_width_m: f32,
        /// Half the height, metres.
        half_height_m: f32,
        /// Metres.
        near_m: f32,
        /// Metres.
        far_m: f32,
    },
}

impl Default for Projection {
    fn default() -> Self {
        Self::Perspective { vertical_fov: 0.8, aspect: None, near_m: 0.01, far_m: None }
    }
}

/// A punctual light; it shines along -Z of its node (KHR_lights_punctual).
#[derive(Debug, Clone, Default)]
pub struct Light {
    /// Name in the file.
    pub name: Option<String>,
    /// Linear RGB.
    pub color: Vec3,
    /// Lux for directional, candela for point and spot.
    pub intensity: f32,
    /// Kind.
    pub kind: LightKind,
}

/// Kind of a punctual light.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum LightKind {
    /// Infinitely far away.
    #[default]
    Directional,
    /// All directions.
    Point {
        /// Metres; `None` = infinite.
        range_m: Option<f32>,
    },
    /// A cone.
    Spot {
        /// Metres; `None` = infinite.
        range_m: Option<f32>,
        /// Radians from the axis: full intensity inside.
        inner_angle: f32,
        /// Radians from the axis: nothing outside; > inner.
        outer_angle: f32,
    },
}

/// A skin: joints and their inverse bind matrices.
#[derive(Debug, Clone, Default)]
pub struct Skin {
    /// Indices into [`Asset::nodes`].
    pub joints: Vec<usize>,
    /// `joint_from_mesh` in the bind pose, one per joint.
    pub inverse_bind: Vec<Mat4>,
}

/// An animation clip.
#[derive(Debug, Clone, Default)]
pub struct Animation {
    /// Name in the file.
    pub name: Option<String>,
    /// Seconds: the last key of any channel.
    pub duration_s: f32,
    /// Channels.
    pub channels: Vec<Channel>,
}

/// One animated property of one node.
#[derive(Debug, Clone)]
pub struct Channel {
    /// Index into [`Asset::nodes`].
    pub node: usize,
    /// Key times in seconds, strictly increasing, not empty.
    pub times_s: Vec<f32>,
    /// Interpolation.
    pub interpolation: Interpolation,
    /// Values.
    pub values: Keys,
}

/// Interpolation between keys (glTF 2.0, appendix C).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interpolation {
    /// Holds the key.
    Step,
    /// Linear; rotations by slerp.
    Linear,
    /// Cubic Hermite: each key is (in-tangent, value, out-tangent).
    CubicSpline,
}

/// Values of a channel: one per key, or three per key for cubic splines.
#[derive(Debug, Clone)]
pub enum Keys {
    /// Metres.
    Translation(Vec<Vec3>),
    /// Quaternions.
    Rotation(Vec<Quat>),
    /// Factors.
    Scale(Vec<Vec3>),
    /// Morph weights, `targets` a value.
    Weights {
        /// Morph targets of the node's mesh.
        targets: usize,
        /// `targets` numbers a value.
        values: Vec<f32>,
    },
}
