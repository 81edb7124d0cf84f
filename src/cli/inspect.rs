//! `vair inspect`.

use super::output;
use super::scene::SceneArguments;
use anyhow::Result;
use clap::Args;
use serde_json::{Value, json};
use vair::asset::Asset;
use vair::gpu::{format_bytes, level_size, vk};
use vair::render::{FrameOptions, HdrFormat, Pass, PipelineSpec, Plan, Shot, TextureUse};
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
    let plan = Shot::new(&scene, &options)?.plan;
    if arguments.json {
        return output::print_json(&as_json(&scene, &plan, &options));
    }
    output::print(&as_text(&scene, &plan, &options))
}

fn as_json(scene: &Scene, plan: &Plan, options: &FrameOptions) -> Value {
    let passes = plan.passes.iter().map(|pass| json!({ "name": pass.name(), "draws": draws(plan, *pass) }));
    let compute = plan
        .compute_pipelines
        .iter()
        .map(|spec| json!({ "name": spec.shader, "state": { "constants": constants(&spec.constants) } }));
    let tonemap = tonemap(options);
    let pipelines = compute.chain(plan.pipelines.iter().chain([&tonemap]).map(pipeline));
    let textures = plan.textures.iter().map(|texture| {
        let name = &scene.asset().images[texture.image].name;
        json!({ "name": name, "format": format(texture), "bytes": texture_bytes(scene.asset(), texture) })
    });
    json!({
        "passes": passes.collect::<Vec<_>>(),
        "pipelines": pipelines.collect::<Vec<_>>(),
        "textures": textures.collect::<Vec<_>>(),
        "memory": {
            "vertex_bytes": plan.stream_bytes(scene.asset()), "index_bytes": plan.index_bytes(scene.asset()),
            "texture_bytes": plan.textures.iter().map(|texture| texture_bytes(scene.asset(), texture)).sum::<u64>(),
            "target_bytes": target_bytes(options),
        },
        "left_out": plan.left_out.iter().map(|left| json!({ "what": left.what, "why": left.why })).collect::<Vec<_>>(),
        "lint": scene.asset().warnings,
    })
}

fn as_text(scene: &Scene, plan: &Plan, options: &FrameOptions) -> String {
    let mut text = "passes\n".to_owned();
    for pass in &plan.passes {
        text += &format!("  {:<12} {} draws\n", pass.name(), draws(plan, *pass));
    }
    text += "pipelines\n";
    for spec in &plan.compute_pipelines {
        text += &format!("  {} ({})\n", spec.shader, constants_text(&spec.constants));
    }
    for spec in plan.pipelines.iter().chain([&tonemap(options)]) {
        text += &format!("  {} with {} ({})\n", spec.fragment, spec.vertex, constants_text(&spec.constants));
    }
    let (streams, indices) = (plan.stream_bytes(scene.asset()), plan.index_bytes(scene.asset()));
    text += &format!("vertex streams: {streams} bytes, indices: {indices} bytes\n");
    for ((mesh, primitive), streams) in &plan.streams {
        let name = scene.asset().meshes[*mesh].name.as_deref().unwrap_or("mesh");
        text += &format!("  {name}.{primitive}: {streams:?}\n");
    }
    text += &format!("targets: {} bytes\ntextures\n", target_bytes(options));
    for texture in &plan.textures {
        let (name, bytes) = (&scene.asset().images[texture.image].name, texture_bytes(scene.asset(), texture));
        text += &format!("  {name} ({}, {bytes} bytes)\n", format(texture));
    }
    text += "left out\n";
    for left in &plan.left_out {
        text += &format!("  {}: {}\n", left.what, left.why);
    }
    for warning in &scene.asset().warnings {
        text += &format!("warning: {warning}\n");
    }
    text
}

/// The tone mapping is no part of the plan, since it depends on the target; `vair render` draws into this one.
fn tonemap(options: &FrameOptions) -> PipelineSpec {
    PipelineSpec::tonemap(options.tonemap, options.hdr_format, vk::Format::R8G8B8A8_UNORM)
}

fn draws(plan: &Plan, pass: Pass) -> usize {
    match pass {
        Pass::Deform => plan.deforms.len(),
        Pass::Sway => plan.sways.len(),
        Pass::Opaque => plan.opaque.len(),
        Pass::Fur => plan.fur.len(),
        Pass::Transparent => plan.transparent.len(),
        Pass::Tonemap => 1,
    }
}

fn pipeline(spec: &PipelineSpec) -> Value {
    json!({
        "name": spec.name(),
        "state": {
            "vertex": spec.vertex, "fragment": spec.fragment, "constants": constants(&spec.constants),
            "topology": format!("{:?}", spec.topology), "blend": spec.blend, "depth": format!("{:?}", spec.depth),
            "samples": spec.samples, "color_format": format!("{:?}", spec.color_format),
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

/// All mip levels, down to one texel.
fn texture_bytes(asset: &Asset, texture: &TextureUse) -> u64 {
    let image = &asset.images[texture.image];
    let size = [image.width, image.height].map(|side| side.max(1));
    let levels = 32 - size[0].max(size[1]).leading_zeros();
    (0..levels).filter_map(|level| format_bytes(vk::Format::R8G8B8A8_UNORM, level_size(size, level))).sum()
}

/// Colour and depth at every sample, the resolved colour, and the picture.
fn target_bytes(options: &FrameOptions) -> u64 {
    let pixels = options.size.iter().map(|side| u64::from(*side)).product::<u64>();
    let color = match options.hdr_format {
        HdrFormat::Rgba16f => 8,
        HdrFormat::B10g11r11 => 4,
    };
    let (depth, picture) = (4, 4);
    let resolved = if options.msaa > 1 { color } else { 0 };
    pixels * (u64::from(options.msaa) * (color + depth) + resolved + picture)
}
