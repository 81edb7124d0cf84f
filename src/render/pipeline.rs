//! Which pipeline a draw needs: shader permutations, constants and fixed state, decided before the device is
//! asked. Two draws that need the same are equal here.

use super::cloth::ClothShader;
use super::lit::Lit;
use super::map::{Map, fur_maps, surface_maps};
use super::options::{FrameOptions, HdrFormat, ShellOrder, Shells, Tonemap, Transparency};
use super::shadow::LAYER_FORMAT;
use super::table::Table;
use crate::asset::{Primitive, Topology};
use crate::gpu::{BlendState, ColorState, DepthState, Gpu, GpuError, GraphicsDesc, Pipeline};
use crate::material::{AlphaMode, Blend, Fur, Shape, Standard};
use crate::shader::{Shader, table};
use ash::vk;
use glam::Vec2;
use std::collections::BTreeSet;

/// Descriptor sets that every device has (Vulkan 1.3, "Required Limits", maxBoundDescriptorSets).
const SET_COUNT: u32 = 4;

/// Depth is 32-bit float, reversed: 1 at the near plane.
pub const DEPTH_FORMAT: vk::Format = vk::Format::D32_SFLOAT;

/// Share of the ambient light.
pub const OCCLUSION_FORMAT: vk::Format = vk::Format::R16_SFLOAT;

/// An octahedral normal, and motion beside it.
pub fn guide_format(motion: bool) -> vk::Format {
    if motion { vk::Format::R32G32B32A32_SFLOAT } else { vk::Format::R32G32_SFLOAT }
}

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

/// What a pipeline draws into.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Target {
    /// A colour.
    Color,
    /// The nearest depth of a shadow map.
    ShadowFront,
    /// The farthest.
    ShadowBack,
    /// Two colours that add up: optical depths between the two.
    ShadowLayers,
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
    /// What it draws into.
    pub target: Target,
    /// Premultiplied over-blending.
    pub blend: bool,
    /// Use of depth.
    pub depth: DepthUse,
    /// Samples a pixel.
    pub samples: u32,
    /// Format of the colour targets, if there are any.
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
    /// The pipeline that shows `standard`, woven as `cloth` says, on `primitive`.
    pub fn surface(
        standard: &Standard,
        cloth: Option<&ClothShader>,
        primitive: &Primitive,
        lit: Lit,
        options: &FrameOptions,
    ) -> Self {
        let vertices = &primitive.vertices;
        let unlit = standard.unlit || vertices.normals.is_empty();
        let has_uv = !vertices.uv_sets.is_empty();
        let has_tangent = !vertices.tangents.is_empty();
        // Without light there is nothing to tell a cloth by.
        let cloth = cloth.filter(|_| !unlit);
        let maps = surface_maps(standard, cloth);
        let is_of_cloth = |map: &Map| cloth.is_some_and(|cloth| cloth.maps.iter().any(|own| own.name == map.name));
        let is_shown = |map: &Map| match map.name {
            "base_color" => has_uv,
            "normal" | "detail_albedo" | "detail_normal" => has_uv && has_tangent && !unlit,
            _ => has_uv && !unlit,
        };
        let needs_light = |map: &Map| unlit && map.name != "base_color";
        // A map that the mesh has no coordinates for must stay off: such a material is drawn as it would be anyway.
        let everything =
            options.everything && maps.iter().all(|map| map.texture.is_none() || is_shown(map) || needs_light(map));
        let is_sampled = |map: &&Map| match everything {
            // What would stand in for a map of cloth is another look.
            true => !needs_light(map) && (!is_of_cloth(map) || map.texture.is_some()),
            false => map.texture.is_some() && is_shown(map),
        };
        let sampled: Vec<&Map> = maps.iter().filter(is_sampled).collect();
        let has = |name: &str| sampled.iter().any(|map| map.name == name);
        let detail = has("detail_albedo") || has("detail_normal");
        let own_maps = sampled.iter().any(|map| is_of_cloth(map));
        let tangent = detail || has("normal") || cloth.is_some();
        let uv = !sampled.is_empty();
        let color = everything || !vertices.colors.is_empty();
        let blends = cloth.is_some_and(|cloth| cloth.blends);
        let blend = standard.alpha_mode == AlphaMode::Blend || blends;

        let rest = cloth.is_some_and(|cloth| cloth.reads_rest);
        let vertex_defines = [("UNLIT", unlit), ("UV", uv), ("TANGENT", tangent), ("REST", rest), ("COLOR", color)];
        let mut fragment_defines = vec![
            ("UNLIT", unlit),
            ("UV", uv),
            ("TANGENT", tangent),
            ("DETAIL", detail),
            ("MAPS", own_maps),
            ("COLOR", color),
        ];
        fragment_defines.extend(cloth.into_iter().flat_map(|cloth| cloth.defines).map(|define| (*define, true)));
        fragment_defines.push(("OCCLUDED", lit.is_occluded() && !unlit));
        fragment_defines.push(("LIST", options.lists(blend)));
        let mut constants = vec![("ALPHA_MODE", alpha_constant(standard.alpha_mode)), ("SAMPLE_COUNT", options.msaa)];
        if !unlit {
            constants.push(("DOUBLE_SIDED", standard.double_sided.into()));
            constants.extend(lit.constants());
        }
        constants.extend(sampled.iter().map(|map| (map.constant, 1)));
        constants.extend(cloth.into_iter().flat_map(|cloth| &cloth.constants).filter(|(_, value)| *value != 0));
        let file = cloth.map_or("standard.frag", |cloth| cloth.file);
        Self {
            vertex: permutation("standard.vert", &vertex_defines),
            fragment: permutation(file, &fragment_defines),
            constants,
            topology: primitive.topology,
            target: Target::Color,
            blend,
            depth: if blend { DepthUse::Test } else { DepthUse::TestAndWrite },
            samples: options.msaa,
            color_format: options.hdr_format.vulkan(),
        }
    }

    /// The pipeline of the shells of `fur` over the surface `standard` of `primitive`.
    pub fn fur(fur: &Fur, standard: &Standard, primitive: &Primitive, lit: Lit, options: &FrameOptions) -> Self {
        let Shells { sampling, alpha, submission, order } = options.shells;
        let blend = fur.blend == Blend::Blend || order == ShellOrder::Blended;
        let all_maps = fur_maps(fur, standard);
        // A distribution map is another way to place strands, so nothing can stand in for it.
        let is_sampled =
            |map: &&Map| map.texture.is_some() || options.everything && map.constant != "HAS_DISTRIBUTION_MAP";
        let maps: Vec<&Map> = all_maps.iter().filter(is_sampled).collect();
        let has_maps = !maps.is_empty();
        let color = options.everything || !primitive.vertices.colors.is_empty();
        let combed = options.everything || fur.comb != Vec2::ZERO || fur.comb_map.is_some();
        let vertex_defines = [("MAPS", has_maps), ("COMB", combed), ("SWAY", options.sways(fur)), ("COLOR", color)];
        let mut constants = vec![("SAMPLE_COUNT", options.msaa)];
        let switches = [
            ("INNER_FIRST", blend || order == ShellOrder::InnerFirst),
            ("BLEND", blend),
            ("KEEP_PARTIAL", fur.blend == Blend::Coverage),
            ("PARABOLOID", fur.shape == Shape::Paraboloid),
            ("HAS_LOCKS", fur.clump > 0.0 || fur.curl > 0.0),
            ("PROJECT_UV", has_maps && primitive.vertices.uv_sets.is_empty()),
        ];
        constants.extend(switches.into_iter().filter(|(_, holds)| *holds).map(|(name, _)| (name, 1)));
        constants.extend(maps.iter().map(|map| (map.constant, 1)));
        let choices = [("SAMPLING", sampling as u32), ("ALPHA", alpha as u32), ("SHELL_SOURCE", submission as u32)];
        constants.extend(choices.into_iter().filter(|(_, choice)| *choice != 0));
        constants.extend(lit.constants());
        Self {
            vertex: permutation("fur.vert", &vertex_defines),
            fragment: permutation(
                "fur.frag",
                &[
                    ("MAPS", has_maps),
                    ("COLOR", color),
                    ("OCCLUDED", lit.is_occluded()),
                    ("LIST", options.lists(blend)),
                ],
            ),
            constants,
            topology: Topology::Triangles,
            target: Target::Color,
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
        // The colours of vertices reach a coat's length, and no further. Of a surface it is the base colour's opacity
        // that decides, whatever it is woven of.
        let (file, kept): (_, &[&str]) =
            if file == "fur.frag" { (file, &["MAPS"]) } else { ("standard.frag", &["UV", "COLOR"]) };
        let kept = kept.iter().map(|define| (*define, defines.split('+').any(|given| given == *define)));
        let fragment = permutation(file, &[("COUNT", true)].into_iter().chain(kept).collect::<Vec<_>>());
        let is_known = is_known_by([&self.vertex, &fragment]);
        // What blends leaves no depth behind, whatever opacity does: gauze blends in every mode.
        let of_blended = |(name, value): (&'static str, u32)| match name {
            "ALPHA_MODE" if self.blend => (name, alpha_constant(AlphaMode::Blend)),
            _ => (name, value),
        };
        Self {
            vertex: self.vertex.clone(),
            constants: self.constants.iter().filter(|(name, _)| is_known(name)).copied().map(of_blended).collect(),
            fragment,
            depth: DepthUse::None,
            color_format: Self::COUNTING_FORMAT,
            ..*self
        }
    }

    /// The pipeline that draws depth, normal and, where that is wanted, motion of what this one shows, at one sample a
    /// pixel. `None` for gauze, which mostly shows what lies behind it.
    pub fn guide(&self, motion: bool) -> Option<Self> {
        let (file, defines) = self.fragment.split_once('+').unwrap_or((&self.fragment, ""));
        let has = |define: &str| defines.split('+').any(|given| given == define);
        let (vertex, fragment) = match file {
            "gauze.frag" => return None,
            "fur.frag" => {
                let defines = [("GUIDE", true), ("MAPS", has("MAPS")), ("MOTION", motion)];
                (permutation(&self.vertex, &[("MOTION", motion)]), permutation("fur.frag", &defines))
            }
            _ => {
                // Colour matters where it says what is covered.
                let is_cut = self.constants.iter().any(|(name, value)| *name == "ALPHA_MODE" && *value != 0);
                let (uv, color) = (is_cut && has("UV"), is_cut && has("COLOR"));
                let defines = [("UNLIT", has("UNLIT")), ("UV", uv), ("COLOR", color), ("MOTION", motion)];
                (permutation("standard.vert", &defines), permutation("guide.frag", &defines))
            }
        };
        let constants = self.constants_at_one_sample([&vertex, &fragment]);
        let (depth, color_format) = (DepthUse::TestAndWrite, guide_format(motion));
        Some(Self { vertex, fragment, constants, blend: false, depth, samples: 1, color_format, ..*self })
    }

    /// Those of its constants that these shaders have, too, for one sample a pixel.
    fn constants_at_one_sample(&self, shaders: [&str; 2]) -> Vec<(&'static str, u32)> {
        let is_known = is_known_by(shaders);
        let known = self.constants.iter().filter(|(name, _)| is_known(name));
        known.map(|&(name, value)| (name, if name == "SAMPLE_COUNT" { 1 } else { value })).collect()
    }

    /// The pipelines of screen-space occlusion: its slices, and their mean.
    pub fn screen_occlusion() -> [Self; 2] {
        ["screen_occlusion.frag", "screen_occlusion_blur.frag"].map(|fragment| Self {
            vertex: "tonemap.vert".to_owned(),
            fragment: fragment.to_owned(),
            constants: Vec::new(),
            topology: Topology::Triangles,
            target: Target::Color,
            blend: false,
            depth: DepthUse::None,
            samples: 1,
            color_format: OCCLUSION_FORMAT,
        })
    }

    /// Whether what it draws lets light through in part: coats, gauze, and what blends by its alpha. What transmits light
    /// otherwise casts the shadow of something opaque.
    pub fn casts_in_part(&self) -> bool {
        let has_alpha = self.constants.contains(&("ALPHA_MODE", alpha_constant(AlphaMode::Blend)));
        has_alpha || ["fur.frag", "gauze.frag"].iter().any(|file| self.fragment.starts_with(file))
    }

    /// The pipeline by which what this one draws casts its shadow into `target`. It keeps what decides where it lets light
    /// through, and reads nothing else.
    pub fn casting(&self, target: Target) -> Self {
        let (file, defines) = self.fragment.split_once('+').unwrap_or((&self.fragment, ""));
        let is_opaque = self.constants.contains(&("ALPHA_MODE", alpha_constant(AlphaMode::Opaque)));
        let has_map = self.constants.contains(&("HAS_BASE_COLOR_MAP", 1));
        let layers = ("LAYERS", target == Target::ShadowLayers);
        let given = |define: &'static str| (define, defines.split('+').any(|given| given == define));
        let plain = [("UV", has_map && !is_opaque), ("COLOR", given("COLOR").1 && !is_opaque)];
        let (vertex, fragment) = match file {
            "fur.frag" => (self.vertex.clone(), permutation("fur_shadow.frag", &[given("MAPS"), layers])),
            "gauze.frag" => {
                let defines = [given("UV"), given("TANGENT"), given("MAPS"), given("COLOR"), layers];
                (self.vertex.clone(), permutation("gauze_shadow.frag", &defines))
            }
            _ => {
                let [uv, color] = plain;
                let vertex = permutation("standard.vert", &[("UNLIT", true), uv, color]);
                (vertex, permutation("shadow.frag", &[uv, color, layers]))
            }
        };
        Self {
            // A texel of a map is one sample.
            constants: self.constants_at_one_sample([&vertex, &fragment]),
            vertex,
            fragment,
            topology: self.topology,
            target,
            blend: false,
            depth: if layers.1 { DepthUse::None } else { DepthUse::TestAndWrite },
            samples: 1,
            color_format: if layers.1 { LAYER_FORMAT } else { vk::Format::UNDEFINED },
        }
    }

    /// The pipeline that composes the lists of what blends over the opaque picture.
    pub fn composition(options: &FrameOptions) -> Self {
        Self {
            vertex: "tonemap.vert".to_owned(),
            fragment: permutation("transparency.frag", &[("MULTISAMPLE", options.msaa > 1)]),
            constants: vec![("WEIGHTED", u32::from(options.transparency == Transparency::Weighted))],
            topology: Topology::Triangles,
            target: Target::Color,
            blend: false,
            depth: DepthUse::None,
            samples: 1,
            color_format: options.hdr_format.vulkan(),
        }
    }

    /// Whether its fragments go to lists instead of the picture.
    pub fn lists(&self) -> bool {
        self.fragment.split('+').any(|define| define == "LIST")
    }

    /// The pipeline that makes a picture of `target_format` from the HDR image.
    pub fn tonemap(tonemap: Tonemap, hdr_format: HdrFormat, target_format: vk::Format, backdrop: bool) -> Self {
        Self {
            vertex: "tonemap.vert".to_owned(),
            fragment: if backdrop { "tonemap.frag+BACKDROP" } else { "tonemap.frag" }.to_owned(),
            constants: vec![
                ("OPERATOR", tonemap.operator()),
                ("ENCODE_SRGB", u32::from(!is_srgb(target_format))),
                ("HAS_ALPHA", u32::from(hdr_format == HdrFormat::Rgba16f)),
            ],
            topology: Topology::Triangles,
            target: Target::Color,
            blend: false,
            depth: DepthUse::None,
            samples: 1,
            color_format: target_format,
        }
    }

    /// Whether its shaders sample the map.
    pub fn samples_map(&self, map: &Map) -> bool {
        self.constants.iter().any(|(name, value)| *name == map.constant && *value != 0)
    }

    /// Whether its shaders have the map's bindings, sampled or not.
    pub fn binds_map(&self, map: &Map) -> bool {
        self.bindings().contains(format!("{}_map", map.name).as_str())
    }

    /// Whether its shaders look something up in the table.
    pub fn binds_table(&self, table: &Table) -> bool {
        self.bindings().contains(format!("{}_table", table.name).as_str())
    }

    /// Names of its descriptors.
    pub fn bindings(&self) -> BTreeSet<&'static str> {
        (0..SET_COUNT).flat_map(|set| self.bindings_of(set)).collect()
    }

    /// Names of the descriptors of one set. Pipelines that have the same can share a bind group.
    pub fn bindings_of(&self, set: u32) -> BTreeSet<&'static str> {
        let bindings = [&self.vertex, &self.fragment].map(|name| shader(name).bindings);
        bindings.into_iter().flatten().filter(|binding| binding.set == set).map(|binding| binding.name).collect()
    }

    /// Names of its vertex inputs.
    pub fn inputs(&self) -> BTreeSet<&'static str> {
        shader(&self.vertex).inputs.iter().map(|input| input.name).collect()
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
        let blend = match self.target {
            Target::ShadowLayers => Some(BlendState::SUM),
            _ => self.blend.then_some(BlendState::PREMULTIPLIED_OVER),
        };
        let color = [ColorState { blend, ..ColorState::replace(self.color_format) }; 2];
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
            color: match self.target {
                Target::Color => &color[..1],
                Target::ShadowFront | Target::ShadowBack => &[],
                Target::ShadowLayers => &color,
            },
            depth: (self.depth != DepthUse::None).then_some(DepthState {
                format: DEPTH_FORMAT,
                write: self.depth == DepthUse::TestAndWrite,
                compare: match self.target {
                    Target::ShadowBack => vk::CompareOp::LESS_OR_EQUAL,
                    _ => vk::CompareOp::GREATER_OR_EQUAL,
                },
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

    /// The pipeline that lets strands lag behind their roots.
    pub fn sway() -> Self {
        Self { shader: "sway.comp".to_owned(), constants: Vec::new() }
    }

    /// Makes it.
    ///
    /// # Errors
    /// Those of [`Gpu::compute_pipeline`].
    pub fn create(&self, gpu: &Gpu) -> Result<Pipeline, GpuError> {
        gpu.compute_pipeline(&self.shader, shader(&self.shader), &self.constants)
    }
}

/// Whether a specialization constant is one of these shaders'.
fn is_known_by(shaders: [&str; 2]) -> impl Fn(&str) -> bool + use<> {
    let stages = shaders.map(shader);
    move |name| stages.iter().any(|stage| stage.constants.iter().any(|known| known.name == name))
}

fn is_srgb(format: vk::Format) -> bool {
    matches!(format, vk::Format::R8G8B8A8_SRGB | vk::Format::B8G8R8A8_SRGB)
}
