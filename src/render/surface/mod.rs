//! How surfaces are drawn: the standard one, and the material families, each with its fragment shader, its uniform block,
//! its maps and tables, and what of it is decided when the pipeline is made.
//!
//! A family is one file here that implements [`SurfaceFamily`]; no other file asks which family it has before it.

mod cotton;
mod gauze;
mod glint;
mod laser;
mod layered;
mod map;
mod satin;
mod sheen;
mod standard;
mod table;
mod velvet;

pub use map::{Fallback, Map, surface_maps, transform};
pub use standard::standard_uniforms;
pub use table::Table;

use super::light::LightingFeatures;
use super::plan::{Blending, DepthUse, Eye, PipelineSpec, PlanOptions, Variants};
use crate::asset::Primitive;
use crate::material::{AlphaMode, Family, Standard, families};
use crate::shader::{Defines, ShaderFile, ShaderKey};
use bytemuck::{NoUninit, bytes_of};

/// What a family adds to the draw of the standard surface.
#[derive(Debug, Clone)]
pub struct FamilyShader {
    /// Fragment shader.
    pub file: ShaderFile,
    /// Its own maps.
    pub maps: Vec<Map>,
    /// Specialization constants beside those of the maps, by GLSL name; those that are 0 may be left out.
    pub constants: Vec<(&'static str, u32)>,
    /// Defines of its own.
    pub defines: Defines,
    /// Look-up tables that its lobes need.
    pub tables: Vec<&'static Table>,
    /// It lets light through whatever the base colour's opacity is.
    pub blends: bool,
    /// It asks the vertices where they are in the rest pose.
    pub reads_rest: bool,
    /// It is a surface that the G-buffer shows.
    pub is_in_gbuffer: bool,
    /// The fragment shader by which it casts a shadow of its own kind, and the defines that this shares with its own; `None`:
    /// as the standard surface does.
    pub shadow: Option<(ShaderFile, Defines)>,
}

/// A material family as it is drawn.
pub trait SurfaceFamily {
    /// Its uniform block.
    type Uniforms: NoUninit;
    /// GLSL name of the block, in set 1.
    const BLOCK: &'static str;

    /// How it is drawn.
    fn shader(&self) -> FamilyShader;

    /// The values of its block.
    fn uniforms(&self) -> Self::Uniforms;
}

/// Reaches the family that a material has.
macro_rules! dispatch {
    ($($(#[doc = $doc:literal])* $family:ident = $kind:literal;)*) => {
        /// How a family is drawn.
        pub fn family_shader(family: &Family) -> FamilyShader {
            match family {
                $(Family::$family(family) => family.shader(),)*
            }
        }

        /// The name and the bytes of its uniform block.
        pub fn family_uniforms(family: &Family) -> (&'static str, Vec<u8>) {
            fn of<F: SurfaceFamily>(family: &F) -> (&'static str, Vec<u8>) {
                (F::BLOCK, bytes_of(&family.uniforms()).to_vec())
            }
            match family {
                $(Family::$family(family) => of(family),)*
            }
        }
    };
}
families!(dispatch);

/// Alpha mode as the shaders' ALPHA_MODE constant.
pub fn alpha_constant(mode: AlphaMode) -> u32 {
    match mode {
        AlphaMode::Opaque => 0,
        AlphaMode::Mask => 1,
        AlphaMode::Blend => 2,
    }
}

/// The pipeline that shows `standard`, with the lobes of a family, on `primitive`.
pub fn surface_pipeline(
    standard: &Standard,
    family: Option<&FamilyShader>,
    primitive: &Primitive,
    lighting: LightingFeatures,
    options: &PlanOptions,
) -> PipelineSpec {
    let vertices = &primitive.vertices;
    let unlit = standard.unlit || vertices.normals.is_empty();
    let has_uv = !vertices.uv_sets.is_empty();
    let has_tangent = !vertices.tangents.is_empty();
    // Without light there is nothing to tell a family by.
    let family = family.filter(|_| !unlit);
    let maps = surface_maps(standard, family);
    let is_of_family = |map: &Map| family.is_some_and(|family| family.maps.iter().any(|own| own.name == map.name));
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
        // A fallback for a map of a family is another look.
        true => !needs_light(map) && (!is_of_family(map) || map.texture.is_some()),
        false => map.texture.is_some() && is_shown(map),
    };
    let sampled: Vec<&Map> = maps.iter().filter(is_sampled).collect();
    let has = |name: &str| sampled.iter().any(|map| map.name == name);
    let detail = has("detail_albedo") || has("detail_normal");
    let blends = standard.alpha_mode == AlphaMode::Blend || family.is_some_and(|family| family.blends);

    let both = Defines::NONE
        .with(Defines::UNLIT, unlit)
        .with(Defines::UV, !sampled.is_empty())
        .with(Defines::TANGENT, detail || has("normal") || family.is_some())
        .with(Defines::COLOR, everything || !vertices.colors.is_empty());
    let fragment_defines = family
        .map_or(both, |family| both | family.defines)
        .with(Defines::DETAIL, detail)
        .with(Defines::MAPS, sampled.iter().any(|map| is_of_family(map)))
        .with(Defines::OCCLUDED, lighting.is_occluded() && !unlit)
        .with(Defines::LIST, blends && options.lists_what_blends());
    let samples = options.target.samples;
    let mut constants = vec![("ALPHA_MODE", alpha_constant(standard.alpha_mode)), ("SAMPLE_COUNT", samples)];
    if !unlit {
        constants.push(("DOUBLE_SIDED", standard.double_sided.into()));
        constants.extend(lighting.constants());
    }
    constants.extend(sampled.iter().map(|map| (map.constant, 1)));
    constants.extend(family.into_iter().flat_map(|family| &family.constants).filter(|(_, value)| *value != 0));
    let vertex_defines = both.with(Defines::REST, family.is_some_and(|family| family.reads_rest));
    let vertex = ShaderKey::new(ShaderFile::StandardVert, vertex_defines);
    let file = family.map_or(ShaderFile::StandardFrag, |family| family.file);
    PipelineSpec {
        vertex,
        fragment: ShaderKey::new(file, fragment_defines),
        topology: primitive.topology,
        eye: Eye::Camera,
        blending: if blends { Blending::Over } else { Blending::Replace },
        depth: if blends { DepthUse::Test } else { DepthUse::TestAndWrite },
        compare: options.target.depth_order.into(),
        targets: options.target.formats(),
        variants: Some(variants(standard.alpha_mode, vertex, fragment_defines, has("base_color"), family)),
        constants,
    }
}

fn variants(
    alpha_mode: AlphaMode,
    vertex: ShaderKey,
    fragment_defines: Defines,
    has_color_map: bool,
    family: Option<&FamilyShader>,
) -> Variants {
    let kept = |defines| fragment_defines.intersection(defines);
    // Colour matters where it says what is covered.
    let covering = kept(Defines::UV | Defines::COLOR);
    let gbuffer_defines = kept(Defines::UNLIT) | if alpha_mode == AlphaMode::Opaque { Defines::NONE } else { covering };
    let gbuffer = [ShaderFile::StandardVert, ShaderFile::GbufferFrag].map(|file| ShaderKey::new(file, gbuffer_defines));
    let shadow = match family.and_then(|family| family.shadow) {
        Some((file, defines)) => [vertex, ShaderKey::new(file, kept(defines))],
        None => {
            let defines = match alpha_mode {
                AlphaMode::Opaque => Defines::NONE,
                _ => kept(Defines::COLOR).with(Defines::UV, has_color_map),
            };
            let vertex = ShaderKey::new(ShaderFile::StandardVert, Defines::UNLIT | defines);
            [vertex, ShaderKey::new(ShaderFile::ShadowMapFrag, defines)]
        }
    };
    Variants {
        gbuffer: family.is_none_or(|family| family.is_in_gbuffer).then_some(gbuffer),
        shadow,
        casts_in_part: alpha_mode == AlphaMode::Blend || family.is_some_and(|family| family.shadow.is_some()),
        // It is the base colour's opacity that decides, whatever the family.
        count: ShaderKey::new(ShaderFile::StandardFrag, Defines::COUNT | covering),
    }
}
