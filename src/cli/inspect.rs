//! `vair inspect`.

use super::output;
use super::scene::SceneArguments;
use anyhow::Result;
use clap::Args;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use vair::gpu::format_bytes;
use vair::render::{Attachment, Blending, FrameOptions, FrameSetup, PICTURE_FORMAT, PipelineSpec, Plan, TextureUse};
use vair::scene::Scene;

#[derive(Debug, Args)]
pub struct InspectArguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Prints the JSON schema of look files, and nothing else.
    #[arg(long)]
    schema: bool,
    /// Prints one JSON object.
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &InspectArguments) -> Result<()> {
    if arguments.schema {
        return output::print_json(&vair::material::look_schema());
    }
    let scene = arguments.scene.load()?;
    let options = arguments.scene.frame_options(&scene, false)?;
    let setup = FrameSetup::new(&scene, &options)?;
    if arguments.json {
        return output::print_json(&as_json(&scene, &setup, &options));
    }
    output::print(&as_text(&scene, &setup, &options))
}

fn as_json(scene: &Scene, setup: &FrameSetup, options: &FrameOptions) -> Value {
    let (plan, plan_options) = (&setup.staging.plan, options.plan_options());
    let passes =
        plan.passes.iter().map(|pass| json!({ "name": pass.name(), "draws": plan.draw_count(*pass, &plan_options) }));
    let compute = plan
        .compute_pipelines
        .iter()
        .map(|spec| json!({ "name": spec.shader.to_string(), "state": { "constants": constants(&spec.constants) } }));
    let full_screen = plan.full_screen(&plan_options);
    let pipelines = compute.chain(plan.pipelines.iter().chain(&full_screen).map(pipeline));
    let textures = plan.textures.iter().map(|texture| {
        let name = &scene.asset().images[texture.image].name;
        json!({ "name": name, "format": format(texture), "bytes": texture.bytes(scene.asset()) })
    });
    let tables = plan
        .tables
        .values()
        .map(|table| json!({ "name": table.name, "format": "rgba16f, table", "bytes": table.texels.len() }));
    json!({
        "passes": passes.collect::<Vec<_>>(),
        "attachments": plan.attachments.iter().map(|attachment| json!({
            "name": attachment.name, "format": format!("{:?}", attachment.format), "samples": attachment.samples,
            "bytes": attachment.bytes(options.size),
        })).collect::<Vec<_>>(),
        "pipelines": pipelines.collect::<Vec<_>>(),
        "textures": textures.chain(tables).collect::<Vec<_>>(),
        "memory": {
            "vertex_bytes": plan.stream_bytes(scene.asset()), "index_bytes": plan.index_bytes(scene.asset()),
            "texture_bytes": plan.textures.iter().map(|texture| texture.bytes(scene.asset())).sum::<u64>(),
            "target_bytes": target_bytes(plan, options), "by_owner": plan.memory(scene, options),
        },
        "left_out": output::left_out(&setup.skipped(scene)),
        "lint": scene.asset().warnings,
    })
}

fn as_text(scene: &Scene, setup: &FrameSetup, options: &FrameOptions) -> String {
    let (plan, plan_options) = (&setup.staging.plan, options.plan_options());
    let mut text = "passes\n".to_owned();
    for pass in &plan.passes {
        text += &format!("  {:<34} {} draws\n", pass.name(), plan.draw_count(*pass, &plan_options));
    }
    text += "attachments\n";
    for Attachment { name, format, samples, .. } in &plan.attachments {
        text += &format!("  {name} {format:?}, {samples} samples\n");
    }
    for (name, format, size) in plan.shadow_images() {
        text += &format!("  {name} {format:?}, {size:?} texels\n");
    }
    text += "pipelines\n";
    for spec in &plan.compute_pipelines {
        text += &format!("  {} ({})\n", spec.shader, constants_text(&spec.constants));
    }
    for spec in plan.pipelines.iter().chain(&plan.full_screen(&plan_options)) {
        text += &format!("  {} with {} ({})\n", spec.fragment, spec.vertex, constants_text(&spec.constants));
        let names = |set: BTreeSet<&str>| set.into_iter().collect::<Vec<_>>().join(" ");
        text += &format!("    binds {}, reads {}\n", names(spec.bindings()), names(spec.inputs()));
    }
    text += "vertex streams\n";
    for ((mesh, primitive), streams) in &plan.streams {
        let name = scene.asset().meshes[*mesh].name.as_deref().unwrap_or("mesh");
        text += &format!("  {name}.{primitive}: {streams:?}\n");
    }
    text += "memory, bytes\n";
    for (owner, bytes) in plan.memory(scene, options) {
        text += &format!("  {bytes:>12} {owner}\n");
    }
    text += "left out\n";
    for left in setup.skipped(scene) {
        text += &format!("  {}: {}\n", left.what, left.why);
    }
    for warning in &scene.asset().warnings {
        text += &format!("warning: {warning}\n");
    }
    text
}

fn pipeline(spec: &PipelineSpec) -> Value {
    json!({
        "name": spec.name(),
        "state": {
            "vertex": spec.vertex.to_string(), "fragment": spec.fragment.to_string(), "constants": constants(&spec.constants),
            "topology": format!("{:?}", spec.topology), "blend": spec.blending != Blending::Replace, "depth": format!("{:?}", spec.depth),
            "bindings": spec.bindings(), "inputs": spec.inputs(), "samples": spec.targets.samples, "color_format": format!("{:?}", spec.targets.color[0]),
        },
    })
}

fn constants(list: &[(&'static str, u32)]) -> Value {
    list.iter().map(|(name, value)| ((*name).to_owned(), Value::from(*value))).collect::<serde_json::Map<_, _>>().into()
}

fn constants_text(list: &[(&'static str, u32)]) -> String {
    list.iter().map(|(name, value)| format!("{name}={value}")).collect::<Vec<_>>().join(" ")
}

fn format(texture: &TextureUse) -> &'static str {
    if texture.srgb { "rgba8 srgb" } else { "rgba8 data" }
}

/// What the frame draws into, and the picture.
fn target_bytes(plan: &Plan, options: &FrameOptions) -> u64 {
    let picture = format_bytes(PICTURE_FORMAT, options.size).unwrap_or(0);
    let shadows: u64 = plan.shadow_images().filter_map(|(_, format, size)| format_bytes(format, size)).sum();
    plan.attachments.iter().map(|attachment| attachment.bytes(options.size)).sum::<u64>() + shadows + picture
}
