//! A frame plan as text that stays the same as long as the plan does.

use std::fmt::Write;
use vair::render::{Draw, Plan};
use vair::scene::Scene;

/// Passes, draws, pipelines, streams, textures and what was left out.
pub fn plan_text(scene: &Scene, plan: &Plan) -> String {
    let mut text = String::new();
    let mut line = |line: String| writeln!(text, "{line}").unwrap_or_else(|error| panic!("{error}"));
    line(format!("passes: {}", plan.passes.iter().map(|pass| pass.name()).collect::<Vec<_>>().join(", ")));
    line("attachments:".to_owned());
    for attachment in &plan.attachments {
        line(format!("  {}: {:?}, {} samples", attachment.name, attachment.format, attachment.samples));
    }
    for (name, format) in plan.shadows.images() {
        line(format!("  {name}: {format:?}, {:?} texels", plan.shadows.size()));
    }
    line(format!("lights: {:?}, by instance {:?}", plan.lights.lights, plan.lights.ranges));
    for map in &plan.shadows.maps {
        let kind = if map.is_orthographic { "parallel" } else { "perspective" };
        line(format!("shadow map: light {}, {kind}", map.light));
    }
    line("instances:".to_owned());
    for instance in &plan.instances {
        let (mesh, primitive) = (instance.mesh, instance.primitive);
        let material = &scene.materials()[instance.material].name;
        let mirrored = if instance.mirrored { ", mirrored" } else { "" };
        let skinned = if instance.skin.is_some() { ", skinned" } else { "" };
        let morphs = instance.morph_weights.len();
        line(format!("  mesh {mesh}.{primitive}, {material:?}{mirrored}{skinned}, {morphs} morph targets"));
    }
    let shown =
        [("guide", &plan.guide[..]), ("opaque", &plan.opaque), ("fur", &plan.fur), ("transparent", &plan.transparent)];
    for (name, draws) in plan.shadows.lists().map(|(pass, draws)| (pass.name(), draws)).into_iter().chain(shown) {
        line(format!("{name} draws: {}", draws.len()));
        for Draw { instance, pipeline, kind, faces } in draws {
            line(format!("  instance {instance}, pipeline {pipeline}, {kind:?}, {faces:?}"));
        }
    }
    line("pipelines:".to_owned());
    for (index, spec) in plan.pipelines.iter().enumerate() {
        let constants: Vec<String> = spec.constants.iter().map(|(name, value)| format!("{name}={value}")).collect();
        line(format!("  {index}: {} -> {}, {:?}", spec.vertex, spec.fragment, spec.topology));
        line(format!("     {}", constants.join(" ")));
        let blend = if spec.blend { "blended" } else { "not blended" };
        line(format!("     {blend}, depth {:?}, {} samples, {:?}", spec.depth, spec.samples, spec.color_format));
    }
    line("compute pipelines:".to_owned());
    for (index, spec) in plan.compute_pipelines.iter().enumerate() {
        line(format!("  {index}: {} {:?}", spec.shader, spec.constants));
    }
    line("deformed streams:".to_owned());
    for deform in &plan.deforms {
        line(format!("  instance {}, {:?}, compute pipeline {}", deform.instance, deform.stream, deform.pipeline));
    }
    for sway in &plan.sways {
        line(format!("swaying coat: instance {}, compute pipeline {}", sway.instance, sway.pipeline));
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
    line(format!("stand-ins: {:?}, absent streams: {}", plan.stand_ins, plan.has_absent_streams));
    line("left out:".to_owned());
    for left_out in &plan.left_out {
        line(format!("  {}: {}", left_out.what, left_out.why));
    }
    text
}
