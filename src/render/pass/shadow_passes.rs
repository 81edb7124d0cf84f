//! What the four shadow passes share: they draw every caster once a map, all maps in one atlas.
//!
//! In: vertex streams, the materials' masks and opacities, one view a map. Sources: Williams 1978, "Casting Curved Shadows
//! on Curved Surfaces"; Yuksel & Keyser 2008, "Deep Opacity Maps".

use super::{Pass, draw};
use crate::asset::Topology;
use crate::gpu::{ColorTarget, DepthTarget, Encoder, Image, Load, RenderPassDesc, TargetFormats};
use crate::render::device_scene::DrawnScene;
use crate::render::fur::casting_layers;
use crate::render::plan::{
    Blending, DepthCompare, DepthUse, Draw, DrawKind, Eye, Faces, PipelineSpec, Plan, PlanInput, Variants,
};
use crate::scene::Side;

/// Why a frame has no shadow passes.
pub(in crate::render) fn why_no_shadows(plan: &Plan, input: &PlanInput) -> &'static str {
    match () {
        () if !input.options.shadows.are_cast => "shadows were not asked for",
        () if !plan.is_lit() => "nothing that is drawn is lit",
        () if !input.is_reached_by_light => "no light reaches anything",
        () => "no light that reaches anything can have a map",
    }
}

/// Whether the frame has shadow maps.
pub(super) fn wanted(plan: &Plan, input: &PlanInput) -> Result<(), &'static str> {
    match plan.lighting.shadows {
        true if input.options.has_host_shadows => Err("the host brings its own"),
        true => Ok(()),
        false => Err(why_no_shadows(plan, input)),
    }
}

/// Whether it has maps of what lets light through in part.
pub(super) fn wanted_translucent(plan: &Plan, input: &PlanInput) -> Result<(), &'static str> {
    wanted(plan, input)?;
    if plan.lighting.translucent_shadows { Ok(()) } else { Err("nothing lets light through in part") }
}

/// How a pass draws its casters.
pub(super) struct Casting {
    pub(super) pass: Pass,
    /// Those that let light through in part; otherwise the opaque ones.
    pub(super) is_translucent: bool,
    pub(super) targets: TargetFormats,
    pub(super) blending: Blending,
    pub(super) compare: DepthCompare,
    /// The fragment shader's define.
    pub(super) defines: crate::shader::Defines,
}

/// What is drawn casts a shadow, too; all faces of it, as a sheet has no thickness to tell its sides apart by.
pub(super) fn add_casters(plan: &mut Plan, input: &PlanInput, casting: &Casting) {
    // A host's own map is drawn whether lights of this frame cast shadows or not.
    let is_wanted = plan.lighting.shadows && !input.options.has_host_shadows || casting.pass == Pass::HostShadow;
    if !is_wanted || casting.is_translucent && casting.pass != Pass::HostShadow && !plan.lighting.translucent_shadows {
        return;
    }
    let shown: Vec<Draw> = plan.shown().copied().collect();
    let mut casters = Vec::new();
    for draw in shown {
        let shown = &plan.pipelines[draw.pipeline];
        let blends = shown.blending != Blending::Replace;
        // Of two sides that blend one after the other, one stands for both.
        if shown.topology != Topology::Triangles || blends && draw.faces == Faces::One(Side::Back) {
            continue;
        }
        let Some(Variants { shadow: [vertex, fragment], casts_in_part, .. }) = shown.variants else { continue };
        if casts_in_part != casting.is_translucent {
            continue;
        }
        let kind = match draw.kind {
            DrawKind::Fur { material, layers } => DrawKind::Fur { material, layers: casting_layers(layers) },
            surface => surface,
        };
        let mut fragment = fragment;
        fragment.defines = fragment.defines | casting.defines;
        let spec = PipelineSpec {
            vertex,
            fragment,
            // A texel of a map is one sample.
            constants: shown.constants_at_one_sample([vertex, fragment]),
            topology: shown.topology,
            eye: Eye::Light,
            blending: casting.blending,
            depth: if casting.targets.depth.is_some() { DepthUse::TestAndWrite } else { DepthUse::None },
            compare: casting.compare,
            targets: casting.targets,
            variants: None,
        };
        let pipeline = plan.add_pipeline(input, draw.part, spec);
        casters.push(Draw { pipeline, kind, faces: Faces::Both, ..draw });
    }
    plan.draws.entry(casting.pass).or_default().extend(casters);
}

/// Records one of the passes into the atlas: its images by their place in [`ShadowAtlas::images`](
/// crate::render::light::ShadowAtlas::images).
pub(super) fn record(
    encoder: &mut Encoder,
    drawn: &DrawnScene,
    pass: Pass,
    depth: Option<(usize, f32)>,
    colors: &[usize],
    sampled: &[usize],
) {
    let Some(atlas) = drawn.resources.shadow_atlas().filter(|_| drawn.staging.plan.passes.contains(&pass)) else {
        return;
    };
    let image = |index: &usize| atlas.images.get(*index);
    let depth = depth.and_then(|(index, clear)| {
        Some(DepthTarget { image: image(&index)?, load: Load::Clear([clear; 4]), store: true })
    });
    let target = |image| ColorTarget { image, load: Load::Clear([0.0; 4]), store: true, resolve: None };
    let color: Vec<ColorTarget> = colors.iter().filter_map(image).map(target).collect();
    let sampled: Vec<&Image> = sampled.iter().filter_map(image).collect();
    let staging = drawn.staging;
    let draws = staging.plan.draws_of(pass);
    let desc = RenderPassDesc { name: pass.name(), size: atlas.size(), color: &color, depth, sampled: &sampled };
    encoder.render_pass(&desc, |pass| {
        for (index, map) in staging.shadow_maps.maps.iter().enumerate() {
            let (origin, side) = atlas.tile(index);
            pass.viewport(origin, [side; 2]);
            // What a light does not reach stands between it and nothing that it does reach.
            draw::record_reached(pass, draws, drawn, drawn.resources.view_of_map(index), map.light);
        }
    });
}
