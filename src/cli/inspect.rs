//! `vair inspect`.

use super::json;
use super::scene::SceneArguments;
use anyhow::Result;
use clap::Args;
use serde_json::{Value, json};
use vair::asset::Asset;
use vair::render::{Pass, PipelineSpec, Plan, Shot, TextureUse};
use vair::scene::Scene;

#[derive(Debug, Args)]
pub struct InspectArguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Prints one JSON object.
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &InspectArguments) -> Result<()> {
    let scene = arguments.scene.load()?;
    let options = arguments.scene.frame_options(&scene)?;
    let shot = Shot::new(&scene, &options)?;
    if arguments.json {
        json::print(&as_json(&scene, &shot.plan, options.size, options.msaa))
    } else {
        print_text(&scene, &shot.plan);
        Ok(())
    }
}

fn as_json(scene: &Scene, plan: &Plan, size: [u32; 2], samples: u32) -> Value {
    let pipelines: Vec<Value> = plan
        .pipelines
        .iter()
        .map(pipeline)
        .chain(
            plan.compute_pipelines
                .iter()
                .map(|spec| json!({ "name": spec.shader, "state": { "constants": constants(&spec.constants) } })),
        )
        .collect();
    let textures: Vec<Value> = plan.textures.iter().map(|texture| {
        json!({ "name": scene.asset.images[texture.image].name, "format": format(texture), "bytes": texture_bytes(&scene.asset, texture) })
    }).collect();
    json!({
        "passes": plan.passes.iter().map(|pass| json!({ "name": pass.name(), "draws": draws(plan, *pass) })).collect::<Vec<_>>(),
        "pipelines": pipelines,
        "textures": textures,
        "memory": {
            "vertex_bytes": plan.stream_bytes(&scene.asset), "index_bytes": plan.index_bytes(&scene.asset),
            "texture_bytes": plan.textures.iter().map(|texture| texture_bytes(&scene.asset, texture)).sum::<u64>(),
            "target_bytes": target_bytes(size, samples),
        },
        "left_out": plan.left_out.iter().map(|left| json!({ "what": left.what, "why": left.why })).collect::<Vec<_>>(),
        "lint": scene.asset.warnings,
    })
}

fn print_text(scene: &Scene, plan: &Plan) {
    println!("passes");
    for pass in &plan.passes {
        println!("  {:<12} {} draws", pass.name(), draws(plan, *pass));
    }
    println!("pipelines");
    for spec in &plan.pipelines {
        println!("  {} with {} ({})", spec.fragment, spec.vertex, constants_text(&spec.constants));
    }
    for spec in &plan.compute_pipelines {
        println!("  {} ({})", spec.shader, constants_text(&spec.constants));
    }
    println!(
        "vertex streams: {} bytes, indices: {} bytes",
        plan.stream_bytes(&scene.asset),
        plan.index_bytes(&scene.asset)
    );
    for ((mesh, primitive), streams) in &plan.streams {
        let name = scene.asset.meshes[*mesh].name.as_deref().unwrap_or("mesh");
        println!("  {name}.{primitive}: {streams:?}");
    }
    println!("textures");
    for texture in &plan.textures {
        println!(
            "  {} ({}, {} bytes)",
            scene.asset.images[texture.image].name,
            format(texture),
            texture_bytes(&scene.asset, texture)
        );
    }
    println!("left out");
    for left in &plan.left_out {
        println!("  {}: {}", left.what, left.why);
    }
    for warning in &scene.asset.warnings {
        println!("warning: {warning}");
    }
}

fn draws(plan: &Plan, pass: Pass) -> usize {
    match pass {
        Pass::Deform => plan.deforms.len(),
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

/// All mip levels: the first one and a third more.
fn texture_bytes(asset: &Asset, texture: &TextureUse) -> u64 {
    let image = &asset.images[texture.image];
    let (mut width, mut height) = (u64::from(image.width.max(1)), u64::from(image.height.max(1)));
    let mut bytes = width * height * 4;
    while width > 1 || height > 1 {
        (width, height) = ((width / 2).max(1), (height / 2).max(1));
        bytes += width * height * 4;
    }
    bytes
}

/// HDR colour (8 bytes) and depth (4) at every sample, the resolved colour, the picture.
fn target_bytes(size: [u32; 2], samples: u32) -> u64 {
    let pixels = u64::from(size[0]) * u64::from(size[1]);
    pixels * (12 * u64::from(samples) + if samples > 1 { 8 } else { 0 } + 4)
}
