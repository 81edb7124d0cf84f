//! A frame setup as text that stays the same as long as its plan does.

use std::fmt::Write;
use vair::gpu::vk;
use vair::render::{Blending, Draw, FrameSetup, Pass};
use vair::scene::Scene;

/// The passes that draw the scene.
const DRAWING: [Pass; 9] = [
    Pass::ShadowMap,
    Pass::TranslucentShadowFront,
    Pass::TranslucentShadowBack,
    Pass::TranslucentShadowTransmittance,
    Pass::GBuffer,
    Pass::Opaque,
    Pass::Fur,
    Pass::OitBuild,
    Pass::Transparent,
];

/// Passes, draws, pipelines, streams, textures and what was skipped.
pub fn plan_text(scene: &Scene, setup: &FrameSetup) -> String {
    let (staging, plan) = (&setup.staging, &setup.staging.plan);
    let mut text = String::new();
    let mut line = |line: String| writeln!(text, "{line}").unwrap_or_else(|error| panic!("{error}"));
    line(format!("passes: {}", plan.passes.iter().map(|pass| pass.name()).collect::<Vec<_>>().join(", ")));
    line("attachments:".to_owned());
    for attachment in &plan.attachments {
        line(format!("  {}: {:?}, {} samples", attachment.name, attachment.format, attachment.samples));
    }
    for (name, format, size) in plan.shadow_images() {
        line(format!("  {name}: {format:?}, {size:?} texels"));
    }
    line(format!("lights: {:?}, by part {:?}", staging.light_lists.lights, staging.light_lists.ranges));
    for map in &staging.shadow_maps.maps {
        let kind = if map.is_orthographic { "parallel" } else { "perspective" };
        line(format!("shadow map: light {}, {kind}", map.light));
    }
    line("parts:".to_owned());
    for part in &plan.parts {
        let (mesh, primitive, instance) = (part.mesh, part.primitive, &staging.instances[part.instance]);
        let material = &scene.materials()[part.material].name;
        let mirrored = if instance.mirrored { ", mirrored" } else { "" };
        let skinned = if instance.skin.is_some() { ", skinned" } else { "" };
        let morphs = instance.morph_weights.len();
        line(format!("  mesh {mesh}.{primitive}, {material:?}{mirrored}{skinned}, {morphs} morph targets"));
    }
    assert!(plan.draws.keys().all(|pass| DRAWING.contains(pass)), "{:?}", plan.draws.keys());
    for pass in DRAWING {
        let draws = plan.draws_of(pass);
        line(format!("{} draws: {}", pass.name(), draws.len()));
        for Draw { part, pipeline, kind, faces } in draws {
            line(format!("  part {part}, pipeline {pipeline}, {kind:?}, {faces:?}"));
        }
    }
    line("pipelines:".to_owned());
    for (index, spec) in plan.pipelines.iter().enumerate() {
        let constants: Vec<String> = spec.constants.iter().map(|(name, value)| format!("{name}={value}")).collect();
        line(format!("  {index}: {} -> {}, {:?}", spec.vertex, spec.fragment, spec.topology));
        line(format!("     {}", constants.join(" ")));
        let blend = match spec.blending {
            Blending::Replace => "not blended",
            Blending::Over => "blended",
            Blending::Sum => "summed",
        };
        let used = |format: &&vk::Format| **format != vk::Format::UNDEFINED;
        let formats: Vec<_> = spec.targets.color.iter().take_while(used).collect();
        let (depth, samples) = (spec.depth, spec.targets.samples);
        line(format!("     {blend}, depth {depth:?}, {samples} samples, {formats:?}"));
    }
    line("compute pipelines:".to_owned());
    for (index, spec) in plan.compute_pipelines.iter().enumerate() {
        line(format!("  {index}: {} {:?}", spec.shader, spec.constants));
    }
    line("skinned streams:".to_owned());
    for deform in &plan.deforms {
        line(format!("  part {}, {:?}, compute pipeline {}", deform.part, deform.stream, deform.pipeline));
    }
    for dynamics in &plan.dynamics {
        line(format!("strand dynamics: part {}, compute pipeline {}", dynamics.part, dynamics.pipeline));
    }
    line("vertex streams:".to_owned());
    for ((mesh, primitive), streams) in &plan.streams {
        line(format!("  mesh {mesh}.{primitive}: {streams:?}"));
    }
    line(format!(
        "bytes: {} of streams, {} of indices",
        plan.stream_bytes(scene.asset()),
        plan.index_bytes(scene.asset())
    ));
    line("textures:".to_owned());
    for texture in &plan.textures {
        let coding = if texture.srgb { "colour" } else { "data" };
        line(format!("  {:?}, {coding}", scene.asset().images[texture.image].name));
    }
    if !plan.tables.is_empty() {
        line(format!("tables: {:?}", plan.tables.keys()));
    }
    line(format!("fallbacks: {:?}, absent streams: {}", plan.fallbacks, plan.has_absent_streams));
    line("skipped:".to_owned());
    for skipped in setup.skipped(scene) {
        line(format!("  {}: {}", skipped.what, skipped.why));
    }
    text
}
