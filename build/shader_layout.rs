/// GLSL `CottonBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct CottonBlock {
    /// GLSL `cotton`.
    pub r#cotton: CottonUniforms,
}
const _: () = {
    assert!(core::mem::offset_of!(CottonBlock, r#cotton) == 0);
    assert!(core::mem::size_of::<CottonBlock>() == 128);
};
impl Default for CottonBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `CottonUniforms`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct CottonUniforms {
    /// linear RGB factor, in [0, 1]
    pub r#sheen_color: [f32; 3],
    /// perceptual roughness factor in [0, 1]
    pub r#sheen_roughness: f32,
    /// cosine and sine of the environment's own rotation around +Y
    pub r#environment_turn: [f32; 2],
    /// GLSL `_reserved_0`.
    pub r#_reserved_0: f32,
    /// GLSL `_reserved_1`.
    pub r#_reserved_1: f32,
    /// GLSL `sheen_color_transform`.
    pub r#sheen_color_transform: TextureTransform,
    /// GLSL `sheen_transform`.
    pub r#sheen_transform: TextureTransform,
    /// GLSL `sheen_roughness_transform`.
    pub r#sheen_roughness_transform: TextureTransform,
}
const _: () = {
    assert!(core::mem::offset_of!(CottonUniforms, r#sheen_color) == 0);
    assert!(core::mem::offset_of!(CottonUniforms, r#sheen_roughness) == 12);
    assert!(core::mem::offset_of!(CottonUniforms, r#environment_turn) == 16);
    assert!(core::mem::offset_of!(CottonUniforms, r#_reserved_0) == 24);
    assert!(core::mem::offset_of!(CottonUniforms, r#_reserved_1) == 28);
    assert!(core::mem::offset_of!(CottonUniforms, r#sheen_color_transform) == 32);
    assert!(core::mem::offset_of!(CottonUniforms, r#sheen_transform) == 64);
    assert!(core::mem::offset_of!(CottonUniforms, r#sheen_roughness_transform) == 96);
    assert!(core::mem::size_of::<CottonUniforms>() == 128);
};
impl Default for CottonUniforms {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `DrawBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct DrawBlock {
    /// GLSL `draw`.
    pub r#draw: ObjectDraw,
}
const _: () = {
    assert!(core::mem::offset_of!(DrawBlock, r#draw) == 0);
    assert!(core::mem::size_of::<DrawBlock>() == 32);
};
impl Default for DrawBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `EnvironmentCubeBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct EnvironmentCubeBlock {
    /// GLSL `draw`.
    pub r#draw: EnvironmentCubeDraw,
}
const _: () = {
    assert!(core::mem::offset_of!(EnvironmentCubeBlock, r#draw) == 0);
    assert!(core::mem::size_of::<EnvironmentCubeBlock>() == 16);
};
impl Default for EnvironmentCubeBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `EnvironmentCubeDraw`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct EnvironmentCubeDraw {
    /// of the picture
    pub r#columns: u32,
    /// GLSL `rows`.
    pub r#rows: u32,
    /// GLSL `face_px`.
    pub r#face_px: u32,
    /// of the grid in a texel
    pub r#directions_a_side: u32,
}
const _: () = {
    assert!(core::mem::offset_of!(EnvironmentCubeDraw, r#columns) == 0);
    assert!(core::mem::offset_of!(EnvironmentCubeDraw, r#rows) == 4);
    assert!(core::mem::offset_of!(EnvironmentCubeDraw, r#face_px) == 8);
    assert!(core::mem::offset_of!(EnvironmentCubeDraw, r#directions_a_side) == 12);
    assert!(core::mem::size_of::<EnvironmentCubeDraw>() == 16);
};
impl Default for EnvironmentCubeDraw {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `EnvironmentHalveBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct EnvironmentHalveBlock {
    /// GLSL `draw`.
    pub r#draw: EnvironmentHalveDraw,
}
const _: () = {
    assert!(core::mem::offset_of!(EnvironmentHalveBlock, r#draw) == 0);
    assert!(core::mem::size_of::<EnvironmentHalveBlock>() == 8);
};
impl Default for EnvironmentHalveBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `EnvironmentHalveDraw`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct EnvironmentHalveDraw {
    /// of level 0
    pub r#face_px: u32,
    /// to make, at least 1
    pub r#level: u32,
}
const _: () = {
    assert!(core::mem::offset_of!(EnvironmentHalveDraw, r#face_px) == 0);
    assert!(core::mem::offset_of!(EnvironmentHalveDraw, r#level) == 4);
    assert!(core::mem::size_of::<EnvironmentHalveDraw>() == 8);
};
impl Default for EnvironmentHalveDraw {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `EnvironmentIrradianceBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct EnvironmentIrradianceBlock {
    /// GLSL `draw`.
    pub r#draw: EnvironmentIrradianceDraw,
}
const _: () = {
    assert!(core::mem::offset_of!(EnvironmentIrradianceBlock, r#draw) == 0);
    assert!(core::mem::size_of::<EnvironmentIrradianceBlock>() == 8);
};
impl Default for EnvironmentIrradianceBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `EnvironmentIrradianceDraw`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct EnvironmentIrradianceDraw {
    /// of level 0
    pub r#face_px: u32,
    /// of the cube that is summed
    pub r#level: u32,
}
const _: () = {
    assert!(core::mem::offset_of!(EnvironmentIrradianceDraw, r#face_px) == 0);
    assert!(core::mem::offset_of!(EnvironmentIrradianceDraw, r#level) == 4);
    assert!(core::mem::size_of::<EnvironmentIrradianceDraw>() == 8);
};
impl Default for EnvironmentIrradianceDraw {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `EnvironmentLobesBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct EnvironmentLobesBlock {
    /// GLSL `draw`.
    pub r#draw: EnvironmentLobesDraw,
}
const _: () = {
    assert!(core::mem::offset_of!(EnvironmentLobesBlock, r#draw) == 0);
    assert!(core::mem::size_of::<EnvironmentLobesBlock>() == 8);
};
impl Default for EnvironmentLobesBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `EnvironmentLobesDraw`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct EnvironmentLobesDraw {
    /// along the cosine and along the roughness
    pub r#nodes: u32,
    /// of GGX, in pairs
    pub r#samples: u32,
}
const _: () = {
    assert!(core::mem::offset_of!(EnvironmentLobesDraw, r#nodes) == 0);
    assert!(core::mem::offset_of!(EnvironmentLobesDraw, r#samples) == 4);
    assert!(core::mem::size_of::<EnvironmentLobesDraw>() == 8);
};
impl Default for EnvironmentLobesDraw {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `EnvironmentPrefilterBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct EnvironmentPrefilterBlock {
    /// GLSL `draw`.
    pub r#draw: EnvironmentPrefilterDraw,
}
const _: () = {
    assert!(core::mem::offset_of!(EnvironmentPrefilterBlock, r#draw) == 0);
    assert!(core::mem::size_of::<EnvironmentPrefilterBlock>() == 16);
};
impl Default for EnvironmentPrefilterBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `EnvironmentPrefilterDraw`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct EnvironmentPrefilterDraw {
    /// of level 0
    pub r#face_px: u32,
    /// to make
    pub r#level: u32,
    /// GLSL `last_level`.
    pub r#last_level: u32,
    /// a texel
    pub r#samples: u32,
}
const _: () = {
    assert!(core::mem::offset_of!(EnvironmentPrefilterDraw, r#face_px) == 0);
    assert!(core::mem::offset_of!(EnvironmentPrefilterDraw, r#level) == 4);
    assert!(core::mem::offset_of!(EnvironmentPrefilterDraw, r#last_level) == 8);
    assert!(core::mem::offset_of!(EnvironmentPrefilterDraw, r#samples) == 12);
    assert!(core::mem::size_of::<EnvironmentPrefilterDraw>() == 16);
};
impl Default for EnvironmentPrefilterDraw {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// One pass. A row's sums fit in 32 bits for up to 2^32 / width fragments a pixel, a million at 4096 pixels.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct FragmentCounts {
    /// from 1
    pub r#pass_number: u32,
    /// pixels
    pub r#width: u32,
}
const _: () = {
    assert!(core::mem::offset_of!(FragmentCounts, r#pass_number) == 0);
    assert!(core::mem::offset_of!(FragmentCounts, r#width) == 4);
    assert!(core::mem::size_of::<FragmentCounts>() == 8);
};
impl Default for FragmentCounts {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `FrameBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct FrameBlock {
    /// GLSL `frame`.
    pub r#frame: FrameUniforms,
}
const _: () = {
    assert!(core::mem::offset_of!(FrameBlock, r#frame) == 0);
    assert!(core::mem::size_of::<FrameBlock>() == 528);
};
impl Default for FrameBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `FrameUniforms`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct FrameUniforms {
    /// of our own views reversed Z, Y up; of a host's views as the host has it
    pub r#clip_from_world: [[f32; 4]; 4],
    /// metres
    pub r#eye_in_world: [f32; 3],
    /// factor on all radiance that is written
    pub r#pre_exposure: f32,
    /// unit vector against the view direction; the view vector of a parallel camera
    pub r#view_in_world: [f32; 3],
    /// 1 for a parallel camera, 0 for perspective
    pub r#orthographic: f32,
    /// linear RGB radiance of a texel of 1 in the environment's map
    pub r#environment_scale: [f32; 3],
    /// number of the map's last level
    pub r#environment_levels: f32,
    /// cosine and sine of the environment's rotation around +Y
    pub r#environment_turn: [f32; 2],
    /// GLSL `_reserved_0`.
    pub r#_reserved_0: f32,
    /// GLSL `_reserved_1`.
    pub r#_reserved_1: f32,
    /// GLSL `environment_harmonics`.
    pub r#environment_harmonics: [[f32; 4]; 25],
}
const _: () = {
    assert!(core::mem::offset_of!(FrameUniforms, r#clip_from_world) == 0);
    assert!(core::mem::offset_of!(FrameUniforms, r#eye_in_world) == 64);
    assert!(core::mem::offset_of!(FrameUniforms, r#pre_exposure) == 76);
    assert!(core::mem::offset_of!(FrameUniforms, r#view_in_world) == 80);
    assert!(core::mem::offset_of!(FrameUniforms, r#orthographic) == 92);
    assert!(core::mem::offset_of!(FrameUniforms, r#environment_scale) == 96);
    assert!(core::mem::offset_of!(FrameUniforms, r#environment_levels) == 108);
    assert!(core::mem::offset_of!(FrameUniforms, r#environment_turn) == 112);
    assert!(core::mem::offset_of!(FrameUniforms, r#_reserved_0) == 120);
    assert!(core::mem::offset_of!(FrameUniforms, r#_reserved_1) == 124);
    assert!(core::mem::offset_of!(FrameUniforms, r#environment_harmonics) == 128);
    assert!(core::mem::size_of::<FrameUniforms>() == 528);
};
impl Default for FrameUniforms {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `FurBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct FurBlock {
    /// GLSL `fur`.
    pub r#fur: FurUniforms,
}
const _: () = {
    assert!(core::mem::offset_of!(FurBlock, r#fur) == 0);
    assert!(core::mem::size_of::<FurBlock>() == 320);
};
impl Default for FurBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `FurUniforms`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct FurUniforms {
    /// linear RGB factor
    pub r#base_color: [f32; 3],
    /// GLSL `_reserved_3`.
    pub r#_reserved_3: f32,
    /// linear RGB factor at the skin
    pub r#root_color: [f32; 3],
    /// strand length in world units
    pub r#length_m: f32,
    /// linear RGB factor at the tip
    pub r#tip_color: [f32; 3],
    /// mean spacing of procedural strands, in units of the rest pose
    pub r#strand_spacing: f32,
    /// linear RGB the spot map blends to
    pub r#spot_color: [f32; 3],
    /// root radius of procedural strands over their spacing, in (0, 0.5]
    pub r#strand_radius: f32,
    /// unit direction times strength in [0, 1], world space
    pub r#force: [f32; 3],
    /// brightness variation between strands, in [0, 1]
    pub r#color_variation: f32,
    /// lie of the fur in the tangent plane, length in [0, 1]
    pub r#comb: [f32; 2],
    /// threshold at the root
    pub r#cutoff_start: f32,
    /// threshold at the tip
    pub r#cutoff_end: f32,
    /// fades strands at grazing angles, in [0, 1]
    pub r#edge_fade: f32,
    /// transparency towards the tip, in [0, 1]
    pub r#tip_fade: f32,
    /// how fast strands thin beyond their shape, >= 0
    pub r#taper: f32,
    /// 0 none .. 1 darkest root
    pub r#occlusion: f32,
    /// strength of the strand highlights, in [0, 1]
    pub r#specular: f32,
    /// longitudinal roughness of a strand, in [0, 1]
    pub r#roughness: f32,
    /// how much the height map shortens strands, in [0, 1]
    pub r#height_strength: f32,
    /// strands gather towards their lock's middle, in [0, 1]
    pub r#clump: f32,
    /// radius of a coil at the tip, in strand spacings, in [0, 1]
    pub r#curl: f32,
    /// UV units per rest-pose unit where the mesh has no UVs
    pub r#projection_scale: f32,
    /// number of shells
    pub r#layers: u32,
    /// strength of the transmitted lobe, in [0, 1]
    pub r#transmission: f32,
    /// GLSL `_reserved_1`.
    pub r#_reserved_1: f32,
    /// GLSL `_reserved_2`.
    pub r#_reserved_2: f32,
    #[doc(hidden)]
    pub _padding_0: [u32; 2],
    /// GLSL `distribution_transform`.
    pub r#distribution_transform: TextureTransform,
    /// GLSL `base_color_transform`.
    pub r#base_color_transform: TextureTransform,
    /// GLSL `height_transform`.
    pub r#height_transform: TextureTransform,
    /// GLSL `spot_transform`.
    pub r#spot_transform: TextureTransform,
    /// GLSL `comb_transform`.
    pub r#comb_transform: TextureTransform,
}
const _: () = {
    assert!(core::mem::offset_of!(FurUniforms, r#base_color) == 0);
    assert!(core::mem::offset_of!(FurUniforms, r#_reserved_3) == 12);
    assert!(core::mem::offset_of!(FurUniforms, r#root_color) == 16);
    assert!(core::mem::offset_of!(FurUniforms, r#length_m) == 28);
    assert!(core::mem::offset_of!(FurUniforms, r#tip_color) == 32);
    assert!(core::mem::offset_of!(FurUniforms, r#strand_spacing) == 44);
    assert!(core::mem::offset_of!(FurUniforms, r#spot_color) == 48);
    assert!(core::mem::offset_of!(FurUniforms, r#strand_radius) == 60);
    assert!(core::mem::offset_of!(FurUniforms, r#force) == 64);
    assert!(core::mem::offset_of!(FurUniforms, r#color_variation) == 76);
    assert!(core::mem::offset_of!(FurUniforms, r#comb) == 80);
    assert!(core::mem::offset_of!(FurUniforms, r#cutoff_start) == 88);
    assert!(core::mem::offset_of!(FurUniforms, r#cutoff_end) == 92);
    assert!(core::mem::offset_of!(FurUniforms, r#edge_fade) == 96);
    assert!(core::mem::offset_of!(FurUniforms, r#tip_fade) == 100);
    assert!(core::mem::offset_of!(FurUniforms, r#taper) == 104);
    assert!(core::mem::offset_of!(FurUniforms, r#occlusion) == 108);
    assert!(core::mem::offset_of!(FurUniforms, r#specular) == 112);
    assert!(core::mem::offset_of!(FurUniforms, r#roughness) == 116);
    assert!(core::mem::offset_of!(FurUniforms, r#height_strength) == 120);
    assert!(core::mem::offset_of!(FurUniforms, r#clump) == 124);
    assert!(core::mem::offset_of!(FurUniforms, r#curl) == 128);
    assert!(core::mem::offset_of!(FurUniforms, r#projection_scale) == 132);
    assert!(core::mem::offset_of!(FurUniforms, r#layers) == 136);
    assert!(core::mem::offset_of!(FurUniforms, r#transmission) == 140);
    assert!(core::mem::offset_of!(FurUniforms, r#_reserved_1) == 144);
    assert!(core::mem::offset_of!(FurUniforms, r#_reserved_2) == 148);
    assert!(core::mem::offset_of!(FurUniforms, r#distribution_transform) == 160);
    assert!(core::mem::offset_of!(FurUniforms, r#base_color_transform) == 192);
    assert!(core::mem::offset_of!(FurUniforms, r#height_transform) == 224);
    assert!(core::mem::offset_of!(FurUniforms, r#spot_transform) == 256);
    assert!(core::mem::offset_of!(FurUniforms, r#comb_transform) == 288);
    assert!(core::mem::size_of::<FurUniforms>() == 320);
};
impl Default for FurUniforms {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `GauzeBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct GauzeBlock {
    /// GLSL `gauze`.
    pub r#gauze: GauzeUniforms,
}
const _: () = {
    assert!(core::mem::offset_of!(GauzeBlock, r#gauze) == 0);
    assert!(core::mem::size_of::<GauzeBlock>() == 144);
};
impl Default for GauzeBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `GauzeUniforms`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct GauzeUniforms {
    /// 0.04 times the strengths and the colour of the highlight, linear, may exceed 1
    pub r#specular: [f32; 3],
    /// in [-1, 1]
    pub r#anisotropy: f32,
    /// cosine and sine of the angle between crossing threads
    pub r#thread_turn: [f32; 2],
    /// in [0, 1]
    pub r#thread_threshold: f32,
    /// share of the weave that transmittance leaves, in (0, 1]
    pub r#cover: f32,
    /// depth of matted yarn from the front; cover of crossed threads; exponent of classic gauze
    pub r#weave: f32,
    /// cosine-weighted mean over all directions
    pub r#mean_opacity: f32,
    /// GLSL `_reserved_0`.
    pub r#_reserved_0: f32,
    /// GLSL `_reserved_1`.
    pub r#_reserved_1: f32,
    /// GLSL `mesh_transform`.
    pub r#mesh_transform: TextureTransform,
    /// GLSL `specular_noise_transform`.
    pub r#specular_noise_transform: TextureTransform,
    /// GLSL `thread_pattern_transform`.
    pub r#thread_pattern_transform: TextureTransform,
}
const _: () = {
    assert!(core::mem::offset_of!(GauzeUniforms, r#specular) == 0);
    assert!(core::mem::offset_of!(GauzeUniforms, r#anisotropy) == 12);
    assert!(core::mem::offset_of!(GauzeUniforms, r#thread_turn) == 16);
    assert!(core::mem::offset_of!(GauzeUniforms, r#thread_threshold) == 24);
    assert!(core::mem::offset_of!(GauzeUniforms, r#cover) == 28);
    assert!(core::mem::offset_of!(GauzeUniforms, r#weave) == 32);
    assert!(core::mem::offset_of!(GauzeUniforms, r#mean_opacity) == 36);
    assert!(core::mem::offset_of!(GauzeUniforms, r#_reserved_0) == 40);
    assert!(core::mem::offset_of!(GauzeUniforms, r#_reserved_1) == 44);
    assert!(core::mem::offset_of!(GauzeUniforms, r#mesh_transform) == 48);
    assert!(core::mem::offset_of!(GauzeUniforms, r#specular_noise_transform) == 80);
    assert!(core::mem::offset_of!(GauzeUniforms, r#thread_pattern_transform) == 112);
    assert!(core::mem::size_of::<GauzeUniforms>() == 144);
};
impl Default for GauzeUniforms {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `GlintBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct GlintBlock {
    /// GLSL `glint`.
    pub r#glint: GlintUniforms,
}
const _: () = {
    assert!(core::mem::offset_of!(GlintBlock, r#glint) == 0);
    assert!(core::mem::size_of::<GlintBlock>() == 80);
};
impl Default for GlintBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `GlintUniforms`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct GlintUniforms {
    /// linear reflectance of the metal at normal incidence
    pub r#flake_color: [f32; 3],
    /// mean share of the cloth that flakes cover, in [0, 0.9]
    pub r#coverage: f32,
    /// share of its light that a flake gives back, in [0, 1]
    pub r#intensity: f32,
    /// perceptual, of the lobe that all flakes make up
    pub r#flake_roughness: f32,
    /// rhombi of the flakes' lattice along their edges
    pub r#cells_per_metre: f32,
    /// as in GlintFlakes
    pub r#radius: f32,
    /// GLSL `jitter`.
    pub r#jitter: f32,
    /// GLSL `lobe`.
    pub r#lobe: f32,
    /// GLSL `variation`.
    pub r#variation: f32,
    /// GLSL `fineness`.
    pub r#fineness: u32,
    /// GLSL `mask_transform`.
    pub r#mask_transform: TextureTransform,
}
const _: () = {
    assert!(core::mem::offset_of!(GlintUniforms, r#flake_color) == 0);
    assert!(core::mem::offset_of!(GlintUniforms, r#coverage) == 12);
    assert!(core::mem::offset_of!(GlintUniforms, r#intensity) == 16);
    assert!(core::mem::offset_of!(GlintUniforms, r#flake_roughness) == 20);
    assert!(core::mem::offset_of!(GlintUniforms, r#cells_per_metre) == 24);
    assert!(core::mem::offset_of!(GlintUniforms, r#radius) == 28);
    assert!(core::mem::offset_of!(GlintUniforms, r#jitter) == 32);
    assert!(core::mem::offset_of!(GlintUniforms, r#lobe) == 36);
    assert!(core::mem::offset_of!(GlintUniforms, r#variation) == 40);
    assert!(core::mem::offset_of!(GlintUniforms, r#fineness) == 44);
    assert!(core::mem::offset_of!(GlintUniforms, r#mask_transform) == 48);
    assert!(core::mem::size_of::<GlintUniforms>() == 80);
};
impl Default for GlintUniforms {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `LaserBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct LaserBlock {
    /// GLSL `laser`.
    pub r#laser: LaserUniforms,
}
const _: () = {
    assert!(core::mem::offset_of!(LaserBlock, r#laser) == 0);
    assert!(core::mem::size_of::<LaserBlock>() == 176);
};
impl Default for LaserBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `LaserUniforms`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct LaserUniforms {
    /// in [0, 1]
    pub r#saturation: f32,
    /// in [0, 1]
    pub r#brightness: f32,
    /// turns
    pub r#hue_span: f32,
    /// turns
    pub r#hue_offset: f32,
    /// unit, in the tangent plane
    pub r#direction: [f32; 2],
    /// where the map says 1
    pub r#film_thickness_nm: f32,
    /// where it says 0
    pub r#film_thickness_min_nm: f32,
    /// GLSL `film_ior`.
    pub r#film_ior: f32,
    /// of the dielectric under the film
    pub r#base_f0: f32,
    /// GLSL `_reserved_0`.
    pub r#_reserved_0: f32,
    /// GLSL `_reserved_1`.
    pub r#_reserved_1: f32,
    /// GLSL `offset_transform`.
    pub r#offset_transform: TextureTransform,
    /// GLSL `hue_ramp_transform`.
    pub r#hue_ramp_transform: TextureTransform,
    /// GLSL `direction_transform`.
    pub r#direction_transform: TextureTransform,
    /// GLSL `film_thickness_transform`.
    pub r#film_thickness_transform: TextureTransform,
}
const _: () = {
    assert!(core::mem::offset_of!(LaserUniforms, r#saturation) == 0);
    assert!(core::mem::offset_of!(LaserUniforms, r#brightness) == 4);
    assert!(core::mem::offset_of!(LaserUniforms, r#hue_span) == 8);
    assert!(core::mem::offset_of!(LaserUniforms, r#hue_offset) == 12);
    assert!(core::mem::offset_of!(LaserUniforms, r#direction) == 16);
    assert!(core::mem::offset_of!(LaserUniforms, r#film_thickness_nm) == 24);
    assert!(core::mem::offset_of!(LaserUniforms, r#film_thickness_min_nm) == 28);
    assert!(core::mem::offset_of!(LaserUniforms, r#film_ior) == 32);
    assert!(core::mem::offset_of!(LaserUniforms, r#base_f0) == 36);
    assert!(core::mem::offset_of!(LaserUniforms, r#_reserved_0) == 40);
    assert!(core::mem::offset_of!(LaserUniforms, r#_reserved_1) == 44);
    assert!(core::mem::offset_of!(LaserUniforms, r#offset_transform) == 48);
    assert!(core::mem::offset_of!(LaserUniforms, r#hue_ramp_transform) == 80);
    assert!(core::mem::offset_of!(LaserUniforms, r#direction_transform) == 112);
    assert!(core::mem::offset_of!(LaserUniforms, r#film_thickness_transform) == 144);
    assert!(core::mem::size_of::<LaserUniforms>() == 176);
};
impl Default for LaserUniforms {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `LayeredBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct LayeredBlock {
    /// GLSL `layered`.
    pub r#layered: LayeredUniforms,
}
const _: () = {
    assert!(core::mem::offset_of!(LayeredBlock, r#layered) == 0);
    assert!(core::mem::size_of::<LayeredBlock>() == 560);
};
impl Default for LayeredBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `LayeredUniforms`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct LayeredUniforms {
    /// factor on the reflectance at normal incidence, linear, >= 0
    pub r#specular_color: [f32; 3],
    /// strength of a dielectric's reflection, [0, 1]
    pub r#specular: f32,
    /// linear
    pub r#sheen_color: [f32; 3],
    /// perceptual
    pub r#sheen_roughness: f32,
    /// linear
    pub r#diffuse_transmission_color: [f32; 3],
    /// share of the scattered light, [0, 1]
    pub r#diffuse_transmission: f32,
    /// unit, of the streak, from the tangent
    pub r#anisotropy_direction: [f32; 2],
    /// [0, 1]
    pub r#anisotropy: f32,
    /// of the base; 0 reflects everything
    pub r#ior: f32,
    /// share of the film, [0, 1]
    pub r#iridescence: f32,
    /// of the film
    pub r#iridescence_ior: f32,
    /// nm, where the map is 0
    pub r#iridescence_thickness_min: f32,
    /// nm, where it is 1
    pub r#iridescence_thickness_max: f32,
    /// share of the varnish, [0, 1]
    pub r#clearcoat: f32,
    /// perceptual
    pub r#clearcoat_roughness: f32,
    /// of its normal map's x and y
    pub r#clearcoat_normal_scale: f32,
    /// share of what goes straight through, [0, 1]
    pub r#transmission: f32,
    /// linear, of the body after its distance of attenuation
    pub r#attenuation_color: [f32; 3],
    /// ways of that distance in the body's thickness, a metre a unit of the mesh
    pub r#thickness_over_distance: f32,
    /// GLSL `specular_transform`.
    pub r#specular_transform: TextureTransform,
    /// GLSL `specular_color_transform`.
    pub r#specular_color_transform: TextureTransform,
    /// GLSL `anisotropy_transform`.
    pub r#anisotropy_transform: TextureTransform,
    /// GLSL `iridescence_transform`.
    pub r#iridescence_transform: TextureTransform,
    /// GLSL `iridescence_thickness_transform`.
    pub r#iridescence_thickness_transform: TextureTransform,
    /// GLSL `diffuse_transmission_transform`.
    pub r#diffuse_transmission_transform: TextureTransform,
    /// GLSL `diffuse_transmission_color_transform`.
    pub r#diffuse_transmission_color_transform: TextureTransform,
    /// GLSL `transmission_transform`.
    pub r#transmission_transform: TextureTransform,
    /// GLSL `thickness_transform`.
    pub r#thickness_transform: TextureTransform,
    /// GLSL `sheen_color_transform`.
    pub r#sheen_color_transform: TextureTransform,
    /// GLSL `sheen_roughness_transform`.
    pub r#sheen_roughness_transform: TextureTransform,
    /// GLSL `clearcoat_transform`.
    pub r#clearcoat_transform: TextureTransform,
    /// GLSL `clearcoat_roughness_transform`.
    pub r#clearcoat_roughness_transform: TextureTransform,
    /// GLSL `clearcoat_normal_transform`.
    pub r#clearcoat_normal_transform: TextureTransform,
}
const _: () = {
    assert!(core::mem::offset_of!(LayeredUniforms, r#specular_color) == 0);
    assert!(core::mem::offset_of!(LayeredUniforms, r#specular) == 12);
    assert!(core::mem::offset_of!(LayeredUniforms, r#sheen_color) == 16);
    assert!(core::mem::offset_of!(LayeredUniforms, r#sheen_roughness) == 28);
    assert!(core::mem::offset_of!(LayeredUniforms, r#diffuse_transmission_color) == 32);
    assert!(core::mem::offset_of!(LayeredUniforms, r#diffuse_transmission) == 44);
    assert!(core::mem::offset_of!(LayeredUniforms, r#anisotropy_direction) == 48);
    assert!(core::mem::offset_of!(LayeredUniforms, r#anisotropy) == 56);
    assert!(core::mem::offset_of!(LayeredUniforms, r#ior) == 60);
    assert!(core::mem::offset_of!(LayeredUniforms, r#iridescence) == 64);
    assert!(core::mem::offset_of!(LayeredUniforms, r#iridescence_ior) == 68);
    assert!(core::mem::offset_of!(LayeredUniforms, r#iridescence_thickness_min) == 72);
    assert!(core::mem::offset_of!(LayeredUniforms, r#iridescence_thickness_max) == 76);
    assert!(core::mem::offset_of!(LayeredUniforms, r#clearcoat) == 80);
    assert!(core::mem::offset_of!(LayeredUniforms, r#clearcoat_roughness) == 84);
    assert!(core::mem::offset_of!(LayeredUniforms, r#clearcoat_normal_scale) == 88);
    assert!(core::mem::offset_of!(LayeredUniforms, r#transmission) == 92);
    assert!(core::mem::offset_of!(LayeredUniforms, r#attenuation_color) == 96);
    assert!(core::mem::offset_of!(LayeredUniforms, r#thickness_over_distance) == 108);
    assert!(core::mem::offset_of!(LayeredUniforms, r#specular_transform) == 112);
    assert!(core::mem::offset_of!(LayeredUniforms, r#specular_color_transform) == 144);
    assert!(core::mem::offset_of!(LayeredUniforms, r#anisotropy_transform) == 176);
    assert!(core::mem::offset_of!(LayeredUniforms, r#iridescence_transform) == 208);
    assert!(core::mem::offset_of!(LayeredUniforms, r#iridescence_thickness_transform) == 240);
    assert!(core::mem::offset_of!(LayeredUniforms, r#diffuse_transmission_transform) == 272);
    assert!(core::mem::offset_of!(LayeredUniforms, r#diffuse_transmission_color_transform) == 304);
    assert!(core::mem::offset_of!(LayeredUniforms, r#transmission_transform) == 336);
    assert!(core::mem::offset_of!(LayeredUniforms, r#thickness_transform) == 368);
    assert!(core::mem::offset_of!(LayeredUniforms, r#sheen_color_transform) == 400);
    assert!(core::mem::offset_of!(LayeredUniforms, r#sheen_roughness_transform) == 432);
    assert!(core::mem::offset_of!(LayeredUniforms, r#clearcoat_transform) == 464);
    assert!(core::mem::offset_of!(LayeredUniforms, r#clearcoat_roughness_transform) == 496);
    assert!(core::mem::offset_of!(LayeredUniforms, r#clearcoat_normal_transform) == 528);
    assert!(core::mem::size_of::<LayeredUniforms>() == 560);
};
impl Default for LayeredUniforms {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `LightSource`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct LightSource {
    /// metres; point and spot
    pub r#position_in_world: [f32; 3],
    /// metres; 0 = infinite
    pub r#range_m: f32,
    /// unit vector; directional: towards the light, spot: against its axis
    pub r#direction_to_light: [f32; 3],
    /// LIGHT_*
    pub r#kind: u32,
    /// linear RGB: lux (directional) or candela (point, spot)
    pub r#intensity: [f32; 3],
    /// 1 / (cos inner - cos outer)
    pub r#spot_scale: f32,
    /// -cos outer * spot_scale
    pub r#spot_offset: f32,
    /// entry of the shadow list
    pub r#first_shadow: u32,
    /// entries from there on, the finest map first
    pub r#shadow_count: u32,
    /// GLSL `_reserved_0`.
    pub r#_reserved_0: f32,
}
const _: () = {
    assert!(core::mem::offset_of!(LightSource, r#position_in_world) == 0);
    assert!(core::mem::offset_of!(LightSource, r#range_m) == 12);
    assert!(core::mem::offset_of!(LightSource, r#direction_to_light) == 16);
    assert!(core::mem::offset_of!(LightSource, r#kind) == 28);
    assert!(core::mem::offset_of!(LightSource, r#intensity) == 32);
    assert!(core::mem::offset_of!(LightSource, r#spot_scale) == 44);
    assert!(core::mem::offset_of!(LightSource, r#spot_offset) == 48);
    assert!(core::mem::offset_of!(LightSource, r#first_shadow) == 52);
    assert!(core::mem::offset_of!(LightSource, r#shadow_count) == 56);
    assert!(core::mem::offset_of!(LightSource, r#_reserved_0) == 60);
    assert!(core::mem::size_of::<LightSource>() == 64);
};
impl Default for LightSource {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `ObjectDraw`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct ObjectDraw {
    /// entry of the object list
    pub r#object_index: u32,
    /// entry of the previous frame's object list
    pub r#previous_object_index: u32,
    /// number of the shell, where every shell is a draw of its own
    pub r#shell: u32,
    /// where the mesh holds its vertices once a shell
    pub r#vertices_per_shell: u32,
    /// entry of the light list
    pub r#first_light: u32,
    /// entries from there on: the lights that reach the object
    pub r#light_count: u32,
    /// of what blends, which lies over which where they are equally far: the higher
    pub r#rank: u32,
    /// of the mesh
    pub r#metres_per_unit: f32,
}
const _: () = {
    assert!(core::mem::offset_of!(ObjectDraw, r#object_index) == 0);
    assert!(core::mem::offset_of!(ObjectDraw, r#previous_object_index) == 4);
    assert!(core::mem::offset_of!(ObjectDraw, r#shell) == 8);
    assert!(core::mem::offset_of!(ObjectDraw, r#vertices_per_shell) == 12);
    assert!(core::mem::offset_of!(ObjectDraw, r#first_light) == 16);
    assert!(core::mem::offset_of!(ObjectDraw, r#light_count) == 20);
    assert!(core::mem::offset_of!(ObjectDraw, r#rank) == 24);
    assert!(core::mem::offset_of!(ObjectDraw, r#metres_per_unit) == 28);
    assert!(core::mem::size_of::<ObjectDraw>() == 32);
};
impl Default for ObjectDraw {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `ObjectUniforms`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct ObjectUniforms {
    /// identity for skinned objects: the deform pass already wrote world space
    pub r#world_from_object: [[f32; 4]; 4],
    /// cofactor matrix of world_from_object, for normals
    pub r#normal_from_object: [[f32; 4]; 4],
    /// -1 where world_from_object mirrors, otherwise 1
    pub r#handedness: f32,
    /// metres per unit of the rest pose
    pub r#world_from_rest: f32,
    /// GLSL `_reserved_1`.
    pub r#_reserved_1: f32,
    /// GLSL `_reserved_2`.
    pub r#_reserved_2: f32,
}
const _: () = {
    assert!(core::mem::offset_of!(ObjectUniforms, r#world_from_object) == 0);
    assert!(core::mem::offset_of!(ObjectUniforms, r#normal_from_object) == 64);
    assert!(core::mem::offset_of!(ObjectUniforms, r#handedness) == 128);
    assert!(core::mem::offset_of!(ObjectUniforms, r#world_from_rest) == 132);
    assert!(core::mem::offset_of!(ObjectUniforms, r#_reserved_1) == 136);
    assert!(core::mem::offset_of!(ObjectUniforms, r#_reserved_2) == 140);
    assert!(core::mem::size_of::<ObjectUniforms>() == 144);
};
impl Default for ObjectUniforms {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `PreviousFrame`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct PreviousFrame {
    /// GLSL `clip_from_world`.
    pub r#clip_from_world: [[f32; 4]; 4],
    /// half the picture's size; y negative, as rows count downwards
    pub r#pixels_from_clip: [f32; 2],
    /// GLSL `_reserved_0`.
    pub r#_reserved_0: f32,
    /// GLSL `_reserved_1`.
    pub r#_reserved_1: f32,
}
const _: () = {
    assert!(core::mem::offset_of!(PreviousFrame, r#clip_from_world) == 0);
    assert!(core::mem::offset_of!(PreviousFrame, r#pixels_from_clip) == 64);
    assert!(core::mem::offset_of!(PreviousFrame, r#_reserved_0) == 72);
    assert!(core::mem::offset_of!(PreviousFrame, r#_reserved_1) == 76);
    assert!(core::mem::size_of::<PreviousFrame>() == 80);
};
impl Default for PreviousFrame {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `PreviousFrameBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct PreviousFrameBlock {
    /// GLSL `previous_frame`.
    pub r#previous_frame: PreviousFrame,
}
const _: () = {
    assert!(core::mem::offset_of!(PreviousFrameBlock, r#previous_frame) == 0);
    assert!(core::mem::size_of::<PreviousFrameBlock>() == 80);
};
impl Default for PreviousFrameBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// Fragments of one row of pixels.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct RowCounts {
    /// fragment shader invocations if nothing were hidden
    pub r#rasterized: u32,
    /// those that early depth tests let through
    pub r#shaded: u32,
    /// pixels where a shaded fragment also survived the coverage
    pub r#covered_pixels: u32,
}
const _: () = {
    assert!(core::mem::offset_of!(RowCounts, r#rasterized) == 0);
    assert!(core::mem::offset_of!(RowCounts, r#shaded) == 4);
    assert!(core::mem::offset_of!(RowCounts, r#covered_pixels) == 8);
    assert!(core::mem::size_of::<RowCounts>() == 12);
};
impl Default for RowCounts {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `SatinBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct SatinBlock {
    /// GLSL `satin`.
    pub r#satin: SatinUniforms,
}
const _: () = {
    assert!(core::mem::offset_of!(SatinBlock, r#satin) == 0);
    assert!(core::mem::size_of::<SatinBlock>() == 80);
};
impl Default for SatinBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `SatinUniforms`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct SatinUniforms {
    /// linear, of the narrow lobe
    pub r#specular_color: [f32; 3],
    /// in [0, 30]
    pub r#specular_strength: f32,
    /// linear, of the wide lobe
    pub r#secondary_color: [f32; 3],
    /// roughness of the wide lobe, in that of the narrow one, >= 1
    pub r#secondary_width: f32,
    /// in [-1, 1]
    pub r#anisotropy: f32,
    /// share of the light's own colour, in [0, 1]
    pub r#light_tint: f32,
    /// GLSL `_reserved_0`.
    pub r#_reserved_0: f32,
    /// GLSL `_reserved_1`.
    pub r#_reserved_1: f32,
    /// GLSL `specular_noise_transform`.
    pub r#specular_noise_transform: TextureTransform,
}
const _: () = {
    assert!(core::mem::offset_of!(SatinUniforms, r#specular_color) == 0);
    assert!(core::mem::offset_of!(SatinUniforms, r#specular_strength) == 12);
    assert!(core::mem::offset_of!(SatinUniforms, r#secondary_color) == 16);
    assert!(core::mem::offset_of!(SatinUniforms, r#secondary_width) == 28);
    assert!(core::mem::offset_of!(SatinUniforms, r#anisotropy) == 32);
    assert!(core::mem::offset_of!(SatinUniforms, r#light_tint) == 36);
    assert!(core::mem::offset_of!(SatinUniforms, r#_reserved_0) == 40);
    assert!(core::mem::offset_of!(SatinUniforms, r#_reserved_1) == 44);
    assert!(core::mem::offset_of!(SatinUniforms, r#specular_noise_transform) == 48);
    assert!(core::mem::size_of::<SatinUniforms>() == 80);
};
impl Default for SatinUniforms {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `ShadowSource`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct ShadowSource {
    /// reversed Z, Y up; w is 1 for parallel rays, otherwise metres along the axis
    pub r#clip_from_world: [[f32; 4]; 4],
    /// of the map's tile in the atlas
    pub r#origin_px: [f32; 2],
    /// of its sides
    pub r#size_px: f32,
    /// width of a texel times 1 / w
    pub r#texel_m: f32,
}
const _: () = {
    assert!(core::mem::offset_of!(ShadowSource, r#clip_from_world) == 0);
    assert!(core::mem::offset_of!(ShadowSource, r#origin_px) == 64);
    assert!(core::mem::offset_of!(ShadowSource, r#size_px) == 72);
    assert!(core::mem::offset_of!(ShadowSource, r#texel_m) == 76);
    assert!(core::mem::size_of::<ShadowSource>() == 80);
};
impl Default for ShadowSource {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `SkinningBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct SkinningBlock {
    /// GLSL `draw`.
    pub r#draw: SkinningDraw,
}
const _: () = {
    assert!(core::mem::offset_of!(SkinningBlock, r#draw) == 0);
    assert!(core::mem::size_of::<SkinningBlock>() == 20);
};
impl Default for SkinningBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `SkinningDraw`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct SkinningDraw {
    /// GLSL `vertex_count`.
    pub r#vertex_count: u32,
    /// joints a vertex; a multiple of 4
    pub r#influences_per_vertex: u32,
    /// morph targets
    pub r#target_count: u32,
    /// entry of the joint list
    pub r#first_joint: u32,
    /// entry of the morph weights
    pub r#first_weight: u32,
}
const _: () = {
    assert!(core::mem::offset_of!(SkinningDraw, r#vertex_count) == 0);
    assert!(core::mem::offset_of!(SkinningDraw, r#influences_per_vertex) == 4);
    assert!(core::mem::offset_of!(SkinningDraw, r#target_count) == 8);
    assert!(core::mem::offset_of!(SkinningDraw, r#first_joint) == 12);
    assert!(core::mem::offset_of!(SkinningDraw, r#first_weight) == 16);
    assert!(core::mem::size_of::<SkinningDraw>() == 20);
};
impl Default for SkinningDraw {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `SsaoBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct SsaoBlock {
    /// GLSL `draw`.
    pub r#draw: SsaoDraw,
}
const _: () = {
    assert!(core::mem::offset_of!(SsaoBlock, r#draw) == 0);
    assert!(core::mem::size_of::<SsaoBlock>() == 80);
};
impl Default for SsaoBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `SsaoDraw`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct SsaoDraw {
    /// rotation
    pub r#camera_from_world: [[f32; 4]; 3],
    /// clip x and y of a view position at distance 1 (perspective) or at any (parallel)
    pub r#focal: [f32; 2],
    /// clip z = depth.x * view z + depth.y
    pub r#depth: [f32; 2],
    /// 1 for a parallel camera, 0 for perspective
    pub r#orthographic: f32,
    /// of what occludes
    pub r#radius_m: f32,
    /// GLSL `slices`.
    pub r#slices: u32,
    /// a side of a slice
    pub r#steps: u32,
}
const _: () = {
    assert!(core::mem::offset_of!(SsaoDraw, r#camera_from_world) == 0);
    assert!(core::mem::offset_of!(SsaoDraw, r#focal) == 48);
    assert!(core::mem::offset_of!(SsaoDraw, r#depth) == 56);
    assert!(core::mem::offset_of!(SsaoDraw, r#orthographic) == 64);
    assert!(core::mem::offset_of!(SsaoDraw, r#radius_m) == 68);
    assert!(core::mem::offset_of!(SsaoDraw, r#slices) == 72);
    assert!(core::mem::offset_of!(SsaoDraw, r#steps) == 76);
    assert!(core::mem::size_of::<SsaoDraw>() == 80);
};
impl Default for SsaoDraw {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `StandardBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct StandardBlock {
    /// GLSL `material`.
    pub r#material: StandardUniforms,
}
const _: () = {
    assert!(core::mem::offset_of!(StandardBlock, r#material) == 0);
    assert!(core::mem::size_of::<StandardBlock>() == 288);
};
impl Default for StandardBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `StandardUniforms`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct StandardUniforms {
    /// linear RGBA factor
    pub r#base_color: [f32; 4],
    /// linear RGB factor, >= 0
    pub r#emissive: [f32; 3],
    /// shown where alpha >= cutoff (mask mode)
    pub r#alpha_cutoff: f32,
    /// factor in [0, 1]
    pub r#metallic: f32,
    /// perceptual roughness factor in [0, 1]
    pub r#roughness: f32,
    /// of the normal map's x and y
    pub r#normal_scale: f32,
    /// in [0, 1]
    pub r#occlusion_strength: f32,
    /// of the detail normal map's x and y
    pub r#detail_normal_scale: f32,
    /// GLSL `_reserved_0`.
    pub r#_reserved_0: f32,
    /// GLSL `_reserved_1`.
    pub r#_reserved_1: f32,
    /// GLSL `_reserved_2`.
    pub r#_reserved_2: f32,
    /// GLSL `base_color_transform`.
    pub r#base_color_transform: TextureTransform,
    /// GLSL `metallic_roughness_transform`.
    pub r#metallic_roughness_transform: TextureTransform,
    /// GLSL `normal_transform`.
    pub r#normal_transform: TextureTransform,
    /// GLSL `occlusion_transform`.
    pub r#occlusion_transform: TextureTransform,
    /// GLSL `emissive_transform`.
    pub r#emissive_transform: TextureTransform,
    /// GLSL `detail_albedo_transform`.
    pub r#detail_albedo_transform: TextureTransform,
    /// GLSL `detail_normal_transform`.
    pub r#detail_normal_transform: TextureTransform,
}
const _: () = {
    assert!(core::mem::offset_of!(StandardUniforms, r#base_color) == 0);
    assert!(core::mem::offset_of!(StandardUniforms, r#emissive) == 16);
    assert!(core::mem::offset_of!(StandardUniforms, r#alpha_cutoff) == 28);
    assert!(core::mem::offset_of!(StandardUniforms, r#metallic) == 32);
    assert!(core::mem::offset_of!(StandardUniforms, r#roughness) == 36);
    assert!(core::mem::offset_of!(StandardUniforms, r#normal_scale) == 40);
    assert!(core::mem::offset_of!(StandardUniforms, r#occlusion_strength) == 44);
    assert!(core::mem::offset_of!(StandardUniforms, r#detail_normal_scale) == 48);
    assert!(core::mem::offset_of!(StandardUniforms, r#_reserved_0) == 52);
    assert!(core::mem::offset_of!(StandardUniforms, r#_reserved_1) == 56);
    assert!(core::mem::offset_of!(StandardUniforms, r#_reserved_2) == 60);
    assert!(core::mem::offset_of!(StandardUniforms, r#base_color_transform) == 64);
    assert!(core::mem::offset_of!(StandardUniforms, r#metallic_roughness_transform) == 96);
    assert!(core::mem::offset_of!(StandardUniforms, r#normal_transform) == 128);
    assert!(core::mem::offset_of!(StandardUniforms, r#occlusion_transform) == 160);
    assert!(core::mem::offset_of!(StandardUniforms, r#emissive_transform) == 192);
    assert!(core::mem::offset_of!(StandardUniforms, r#detail_albedo_transform) == 224);
    assert!(core::mem::offset_of!(StandardUniforms, r#detail_normal_transform) == 256);
    assert!(core::mem::size_of::<StandardUniforms>() == 288);
};
impl Default for StandardUniforms {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `StrandDynamicsBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct StrandDynamicsBlock {
    /// GLSL `draw`.
    pub r#draw: StrandDynamicsDraw,
}
const _: () = {
    assert!(core::mem::offset_of!(StrandDynamicsBlock, r#draw) == 0);
    assert!(core::mem::size_of::<StrandDynamicsBlock>() == 96);
};
impl Default for StrandDynamicsBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `StrandDynamicsDraw`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct StrandDynamicsDraw {
    /// identity where the positions are in world space
    pub r#world_from_object: [[f32; 4]; 4],
    /// GLSL `vertex_count`.
    pub r#vertex_count: u32,
    /// 1: come to rest
    pub r#reset: u32,
    /// seconds since the last step; 0: none, the strands hold still
    pub r#step_s: f32,
    /// 1/s^2
    pub r#stiffness: f32,
    /// ratio; 1 is critical
    pub r#damping: f32,
    /// bending force a metre of lag, >= 0
    pub r#force_per_m: f32,
    #[doc(hidden)]
    pub _padding_0: [u32; 2],
}
const _: () = {
    assert!(core::mem::offset_of!(StrandDynamicsDraw, r#world_from_object) == 0);
    assert!(core::mem::offset_of!(StrandDynamicsDraw, r#vertex_count) == 64);
    assert!(core::mem::offset_of!(StrandDynamicsDraw, r#reset) == 68);
    assert!(core::mem::offset_of!(StrandDynamicsDraw, r#step_s) == 72);
    assert!(core::mem::offset_of!(StrandDynamicsDraw, r#stiffness) == 76);
    assert!(core::mem::offset_of!(StrandDynamicsDraw, r#damping) == 80);
    assert!(core::mem::offset_of!(StrandDynamicsDraw, r#force_per_m) == 84);
    assert!(core::mem::size_of::<StrandDynamicsDraw>() == 96);
};
impl Default for StrandDynamicsDraw {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `StrandVertex`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct StrandVertex {
    /// metres, at the last step
    pub r#root_in_world: [f32; 3],
    #[doc(hidden)]
    pub _padding_0: [u32; 1],
    /// metres, world space
    pub r#lag: [f32; 3],
    #[doc(hidden)]
    pub _padding_1: [u32; 1],
    /// of the tip, metres a second, world space
    pub r#velocity: [f32; 3],
    #[doc(hidden)]
    pub _padding_2: [u32; 1],
}
const _: () = {
    assert!(core::mem::offset_of!(StrandVertex, r#root_in_world) == 0);
    assert!(core::mem::offset_of!(StrandVertex, r#lag) == 16);
    assert!(core::mem::offset_of!(StrandVertex, r#velocity) == 32);
    assert!(core::mem::size_of::<StrandVertex>() == 48);
};
impl Default for StrandVertex {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// One texture: which UV set, and KHR_texture_transform as two rows of a 2x3 matrix.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct TextureTransform {
    /// u' = dot(row_u, (u, v, 1))
    pub r#row_u: [f32; 3],
    /// 0 or 1
    pub r#uv_set: u32,
    /// v' = dot(row_v, (u, v, 1))
    pub r#row_v: [f32; 3],
    /// GLSL `_reserved`.
    pub r#_reserved: f32,
}
const _: () = {
    assert!(core::mem::offset_of!(TextureTransform, r#row_u) == 0);
    assert!(core::mem::offset_of!(TextureTransform, r#uv_set) == 12);
    assert!(core::mem::offset_of!(TextureTransform, r#row_v) == 16);
    assert!(core::mem::offset_of!(TextureTransform, r#_reserved) == 28);
    assert!(core::mem::size_of::<TextureTransform>() == 32);
};
impl Default for TextureTransform {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `ToneMappingBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct ToneMappingBlock {
    /// GLSL `draw`.
    pub r#draw: ToneMappingDraw,
}
const _: () = {
    assert!(core::mem::offset_of!(ToneMappingBlock, r#draw) == 0);
    assert!(core::mem::size_of::<ToneMappingBlock>() == 80);
};
impl Default for ToneMappingBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `ToneMappingDraw`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct ToneMappingDraw {
    /// linear RGB shown where nothing was drawn, display light
    pub r#background: [f32; 3],
    /// factor on radiance
    pub r#exposure: f32,
    /// 0: the picture keeps its alpha (not premultiplied)
    pub r#background_opacity: f32,
    /// 1: the background is radiance and goes through exposure and tone curve
    pub r#background_is_light: f32,
    /// SKYBOX: radiance of a texel of 1
    pub r#skybox_scale: f32,
    /// GLSL `_reserved_1`.
    pub r#_reserved_1: f32,
    /// from the eye, in the environment's axes, through the picture's top left corner
    pub r#skybox_corner: [f32; 3],
    /// GLSL `_reserved_2`.
    pub r#_reserved_2: f32,
    /// to the next pixel
    pub r#skybox_right: [f32; 3],
    /// GLSL `_reserved_3`.
    pub r#_reserved_3: f32,
    /// GLSL `skybox_down`.
    pub r#skybox_down: [f32; 3],
    /// GLSL `_reserved_4`.
    pub r#_reserved_4: f32,
}
const _: () = {
    assert!(core::mem::offset_of!(ToneMappingDraw, r#background) == 0);
    assert!(core::mem::offset_of!(ToneMappingDraw, r#exposure) == 12);
    assert!(core::mem::offset_of!(ToneMappingDraw, r#background_opacity) == 16);
    assert!(core::mem::offset_of!(ToneMappingDraw, r#background_is_light) == 20);
    assert!(core::mem::offset_of!(ToneMappingDraw, r#skybox_scale) == 24);
    assert!(core::mem::offset_of!(ToneMappingDraw, r#_reserved_1) == 28);
    assert!(core::mem::offset_of!(ToneMappingDraw, r#skybox_corner) == 32);
    assert!(core::mem::offset_of!(ToneMappingDraw, r#_reserved_2) == 44);
    assert!(core::mem::offset_of!(ToneMappingDraw, r#skybox_right) == 48);
    assert!(core::mem::offset_of!(ToneMappingDraw, r#_reserved_3) == 60);
    assert!(core::mem::offset_of!(ToneMappingDraw, r#skybox_down) == 64);
    assert!(core::mem::offset_of!(ToneMappingDraw, r#_reserved_4) == 76);
    assert!(core::mem::size_of::<ToneMappingDraw>() == 80);
};
impl Default for ToneMappingDraw {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `TransparencyCount`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct TransparencyCount {
    /// GLSL `fragment_count`.
    pub r#fragment_count: u32,
}
const _: () = {
    assert!(core::mem::offset_of!(TransparencyCount, r#fragment_count) == 0);
    assert!(core::mem::size_of::<TransparencyCount>() == 4);
};
impl Default for TransparencyCount {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `TransparencyEntries`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct TransparencyEntries {
    /// pixels
    pub r#width: u32,
    /// entries that there are
    pub r#capacity: u32,
}
const _: () = {
    assert!(core::mem::offset_of!(TransparencyEntries, r#width) == 0);
    assert!(core::mem::offset_of!(TransparencyEntries, r#capacity) == 4);
    assert!(core::mem::size_of::<TransparencyEntries>() == 8);
};
impl Default for TransparencyEntries {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// A fragment in its pixel's list.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct TransparencyEntry {
    /// entry that was there before, counted from 1; 0 = none
    pub r#next: u32,
    /// reversed, in the middle of the pixel
    pub r#depth: f32,
    /// what it changes by a pixel to the right and down, over itself: two halves
    pub r#slope: u32,
    /// packed channel; beside it the samples, a bit each
    pub r#red: u32,
    /// packed channel; beside it the low bits of the rank
    pub r#green: u32,
    /// packed channel; beside it the high bits of the rank
    pub r#blue: u32,
}
const _: () = {
    assert!(core::mem::offset_of!(TransparencyEntry, r#next) == 0);
    assert!(core::mem::offset_of!(TransparencyEntry, r#depth) == 4);
    assert!(core::mem::offset_of!(TransparencyEntry, r#slope) == 8);
    assert!(core::mem::offset_of!(TransparencyEntry, r#red) == 12);
    assert!(core::mem::offset_of!(TransparencyEntry, r#green) == 16);
    assert!(core::mem::offset_of!(TransparencyEntry, r#blue) == 20);
    assert!(core::mem::size_of::<TransparencyEntry>() == 24);
};
impl Default for TransparencyEntry {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `VelvetBlock`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct VelvetBlock {
    /// GLSL `velvet`.
    pub r#velvet: VelvetUniforms,
}
const _: () = {
    assert!(core::mem::offset_of!(VelvetBlock, r#velvet) == 0);
    assert!(core::mem::size_of::<VelvetBlock>() == 32);
};
impl Default for VelvetBlock {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
/// GLSL `VelvetUniforms`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct VelvetUniforms {
    /// linear RGB, in [0, 1]
    pub r#scatter_color: [f32; 3],
    /// perceptual roughness of the scattering fibres, in [0, 1]
    pub r#scatter_roughness: f32,
    /// width of the classic rim, in [0, 1]
    pub r#scatter_scale: f32,
    /// GLSL `_reserved_0`.
    pub r#_reserved_0: f32,
    /// GLSL `_reserved_1`.
    pub r#_reserved_1: f32,
    /// GLSL `_reserved_2`.
    pub r#_reserved_2: f32,
}
const _: () = {
    assert!(core::mem::offset_of!(VelvetUniforms, r#scatter_color) == 0);
    assert!(core::mem::offset_of!(VelvetUniforms, r#scatter_roughness) == 12);
    assert!(core::mem::offset_of!(VelvetUniforms, r#scatter_scale) == 16);
    assert!(core::mem::offset_of!(VelvetUniforms, r#_reserved_0) == 20);
    assert!(core::mem::offset_of!(VelvetUniforms, r#_reserved_1) == 24);
    assert!(core::mem::offset_of!(VelvetUniforms, r#_reserved_2) == 28);
    assert!(core::mem::size_of::<VelvetUniforms>() == 32);
};
impl Default for VelvetUniforms {
    /// All zero.
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}
