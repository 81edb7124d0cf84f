//! The pipeline of the shells, and how other passes draw them.

use crate::asset::{Primitive, Topology};
use crate::material::{Blend, Fur, Shape, Standard};
use crate::render::light::LightingFeatures;
use crate::render::options::{ShellOrder, Shells};
use crate::render::plan::{Blending, DepthUse, Eye, PipelineSpec, PlanOptions, Variants};
use crate::render::surface::{Fallback, Map};
use crate::shader::{Defines, ShaderFile, ShaderKey};
use glam::Vec2;

/// Fur casts its shadow with this share of its shells, by density: single strands are finer than texels.
const CASTING_SHARE: u32 = 4;
/// And with no fewer than these.
const LEAST_CASTING_LAYERS: u32 = 4;

/// Shells with which fur of `layers` casts its shadow.
pub fn casting_layers(layers: u32) -> u32 {
    (layers / CASTING_SHARE).max(LEAST_CASTING_LAYERS).min(layers)
}

/// Maps of fur over a surface, whose base colour texture it takes where it has none of its own.
pub fn fur_maps(fur: &Fur, standard: &Standard) -> [Map; 5] {
    [
        Map::data("height", "HAS_HEIGHT_MAP", fur.height_map),
        Map::data("distribution", "HAS_DISTRIBUTION_MAP", fur.distribution_map),
        Map::color("base_color", "HAS_BASE_COLOR_MAP", fur.color_over(standard).1),
        Map::data("spot", "HAS_SPOT_MAP", fur.spot_map).or(Fallback::Black),
        Map::data("comb", "HAS_COMB_MAP", fur.comb_map).or(Fallback::NoDirection),
    ]
}

/// The pipeline of the shells of `fur` over the surface `standard` of `primitive`.
pub fn fur_pipeline(
    fur: &Fur,
    standard: &Standard,
    primitive: &Primitive,
    lighting: LightingFeatures,
    options: &PlanOptions,
) -> PipelineSpec {
    let Shells { sampling, alpha, submission, order } = options.shells;
    let blends = fur.blend == Blend::Blend || order == ShellOrder::Blended;
    let all_maps = fur_maps(fur, standard);
    // A distribution map is another way to place strands, so it has no fallback.
    let is_sampled = |map: &&Map| map.texture.is_some() || options.everything && map.constant != "HAS_DISTRIBUTION_MAP";
    let maps: Vec<&Map> = all_maps.iter().filter(is_sampled).collect();
    let has_maps = !maps.is_empty();
    let color = options.everything || !primitive.vertices.colors.is_empty();
    let combed = options.everything || fur.comb != Vec2::ZERO || fur.comb_map.is_some();
    let both = Defines::NONE.with(Defines::MAPS, has_maps).with(Defines::COLOR, color);
    let vertex_defines = both.with(Defines::COMB, combed).with(Defines::STRAND_DYNAMICS, options.has_dynamics(fur));
    let fragment_defines =
        both.with(Defines::OCCLUDED, lighting.is_occluded()).with(Defines::LIST, blends && options.lists_what_blends());
    let mut constants = vec![("SAMPLE_COUNT", options.target.samples)];
    let switches = [
        ("INNER_FIRST", blends || order == ShellOrder::InnerFirst),
        ("BLEND", blends),
        ("KEEP_PARTIAL", fur.blend == Blend::Coverage),
        ("PARABOLOID", fur.shape == Shape::Paraboloid),
        ("HAS_LOCKS", fur.clump > 0.0 || fur.curl > 0.0),
        ("PROJECT_UV", has_maps && primitive.vertices.uv_sets.is_empty()),
    ];
    constants.extend(switches.into_iter().filter(|(_, holds)| *holds).map(|(name, _)| (name, 1)));
    constants.extend(maps.iter().map(|map| (map.constant, 1)));
    let choices = [("SAMPLING", sampling as u32), ("ALPHA", alpha as u32), ("SHELL_SOURCE", submission as u32)];
    constants.extend(choices.into_iter().filter(|(_, choice)| *choice != 0));
    constants.extend(lighting.constants());
    let vertex = ShaderKey::new(ShaderFile::FurVert, vertex_defines);
    let own_maps = fragment_defines.intersection(Defines::MAPS);
    PipelineSpec {
        vertex,
        fragment: ShaderKey::new(ShaderFile::FurFrag, fragment_defines),
        constants,
        topology: Topology::Triangles,
        eye: Eye::Camera,
        blending: if blends { Blending::Over } else { Blending::Replace },
        depth: if blends { DepthUse::Test } else { DepthUse::TestAndWrite },
        compare: options.target.depth_order.into(),
        targets: options.target.formats(),
        variants: Some(Variants {
            gbuffer: Some([vertex, ShaderKey::new(ShaderFile::FurFrag, Defines::GBUFFER | own_maps)]),
            shadow: [vertex, ShaderKey::new(ShaderFile::FurShadowFrag, own_maps)],
            casts_in_part: true,
            // The colours of vertices reach the fur's length, and no further.
            count: ShaderKey::new(ShaderFile::FurFrag, Defines::COUNT | own_maps),
        }),
    }
}
