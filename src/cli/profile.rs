//! `vair profile`.

use super::device::{DeviceArguments, check_validation};
use super::families;
use super::output::{self, milliseconds};
use super::scene::SceneArguments;
use anyhow::Result;
use clap::Args;
use serde_json::{Value, json};
use std::path::PathBuf;
use vair::measure::PassFragments;
use vair::measure::profile::{DEFAULT_FRAMES, PassProfile, Profile, Spread, Start};

const COLUMNS: [&str; 11] = [
    "pass",
    "device ms",
    "min",
    "max",
    "draws",
    "instances",
    "vertices",
    "triangles",
    "shaded",
    "rasterized",
    "overdraw",
];

const MIB: f64 = (1 << 20) as f64;

#[derive(Debug, Args)]
pub struct ProfileArguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Timed frames, after a warm-up.
    #[arg(long, value_name = "N", default_value_t = DEFAULT_FRAMES, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    bench: u32,
    #[command(flatten)]
    device: DeviceArguments,
    /// Compares the families of material instead: all surfaces of the scene, or of a quad that fills the picture, are
    /// shaded by each in turn.
    #[arg(long, conflicts_with = "trace")]
    families: bool,
    /// Writes the timed frames for chrome://tracing or Perfetto.
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Prints one JSON object.
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &ProfileArguments) -> Result<()> {
    if arguments.families {
        return families::run(&arguments.scene, &arguments.device, arguments.bench, arguments.json);
    }
    if let Some(path) = &arguments.trace {
        output::check_writable(path, "trace.json")?;
    }
    let scene = arguments.scene.load()?;
    let options = arguments.scene.frame_options(&scene, false)?;
    if !arguments.json {
        arguments.scene.complain(&scene);
    }
    // The profile measures a cache of its own.
    let device = arguments.device.options(None);
    let profile = Profile::measure(&device, &scene, &options, arguments.bench)?;
    if let Some(path) = &arguments.trace {
        profile.write_trace(path)?;
    }
    if arguments.json {
        output::print_json(&as_json(&profile, options.size, options.msaa))?;
    } else {
        output::print(&as_text(&profile, options.size, options.msaa))?;
    }
    check_validation(&profile.validation_messages)
}

fn as_json(profile: &Profile, [width, height]: [u32; 2], samples: u32) -> Value {
    let passes = profile.passes.iter().map(|pass| {
        let count = |value: fn(&PassFragments) -> u64| pass.fragments.as_ref().map(value);
        json!({
            "name": pass.name, "gpu_ms": pass.gpu_ms.map(spread), "draws": pass.draws, "instances": pass.instances,
            "vertices": pass.vertices, "vertex_invocations": pass.vertex_invocations, "triangles": pass.triangles,
            "fragments": count(|fragments| fragments.shaded),
            "fragments_rasterized": count(|fragments| fragments.rasterized),
            "covered_pixels": count(|fragments| fragments.covered_pixels),
            "overdraw": pass.fragments.and_then(|fragments| fragments.overdraw()).map(milliseconds),
        })
    });
    let cpu: serde_json::Map<_, _> =
        profile.cpu_ms.iter().map(|(phase, ms)| ((*phase).to_owned(), spread(*ms))).collect();
    let memory = &profile.memory;
    let by_use: serde_json::Map<_, _> =
        memory.by_use.iter().map(|(memory_use, bytes)| (memory_use.name().to_owned(), (*bytes).into())).collect();
    let by_owner: serde_json::Map<_, _> =
        memory.by_owner.iter().map(|(name, bytes)| (name.clone(), (*bytes).into())).collect();
    json!({
        "device": output::device(&profile.device),
        "image": { "width": width, "height": height, "samples": samples },
        "ms": { "frame": spread(profile.frame_ms), "gpu": profile.gpu_ms.map(spread), "cpu": cpu },
        "passes": passes.collect::<Vec<_>>(),
        "fur": output::fur(&profile.fur),
        "memory": {
            "device_bytes": memory.device_bytes, "peak_bytes": memory.peak_bytes, "by_use": by_use,
            "by_owner": by_owner,
        },
        "calls": {
            "total": profile.calls.total(), "uploaded_bytes": profile.calls.uploaded_bytes,
            "by_name": profile.calls.by_name,
        },
        "start": { "cold": start(profile.cold), "warm": start(profile.warm) },
        "left_out": output::left_out(&profile.left_out),
        "validation_messages": profile.validation_messages,
    })
}

pub fn spread(spread: Spread) -> Value {
    json!({
        "median": milliseconds(spread.median), "min": milliseconds(spread.min), "max": milliseconds(spread.max),
        "count": spread.count,
    })
}

fn start(start: Start) -> Value {
    json!({ "pipelines_ms": milliseconds(start.pipelines_ms), "first_frame_ms": milliseconds(start.first_frame_ms) })
}

fn as_text(profile: &Profile, [width, height]: [u32; 2], samples: u32) -> String {
    let Spread { median, min, max, count } = profile.frame_ms;
    let mut text = format!("{}, {width}x{height}, samples a pixel: {samples}\n", profile.device.name);
    text += &format!("frame   median {median:.2} ms, {min:.2} to {max:.2} ms over {count} frames\n");
    let phases = profile.cpu_ms.iter().map(|(phase, ms)| format!("{phase} {:.2}", ms.median)).collect::<Vec<_>>();
    text += &format!("host    {} ms\n\n", phases.join(", "));

    text += &row(&COLUMNS);
    for pass in &profile.passes {
        text += &pass_row(pass);
    }
    text += "shaded: shader invocations before discard; overdraw: those for each pixel that the pass covers\n\n";

    for (name, start) in [("cold", profile.cold), ("warm", profile.warm)] {
        let Start { pipelines_ms, first_frame_ms } = start;
        text += &format!("{name}    pipelines {pipelines_ms:.1} ms, first frame {first_frame_ms:.1} ms\n");
    }
    let memory = &profile.memory;
    let uses = memory.by_use.iter().map(|(memory_use, bytes)| format!("{} {:.2}", memory_use.name(), mib(*bytes)));
    let uses = uses.collect::<Vec<_>>().join(", ");
    text += &format!("memory  {:.2} MiB: {uses}\n", mib(memory.device_bytes));
    let mut owners = memory.by_owner.clone();
    owners.sort_by_key(|(_, bytes)| std::cmp::Reverse(*bytes));
    for (name, bytes) in owners.iter().take(8) {
        text += &format!("  {:>8.2} MiB  {name}\n", mib(*bytes));
    }
    let (calls, uploaded) = (profile.calls.total(), profile.calls.uploaded_bytes);
    text += &format!("calls   {calls} to Vulkan a frame, {uploaded} bytes uploaded\n");
    text += "left out\n";
    for left in &profile.left_out {
        text += &format!("  {}: {}\n", left.what, left.why);
    }
    text
}

fn pass_row(pass: &PassProfile) -> String {
    let ms = |value: fn(&Spread) -> f64| pass.gpu_ms.as_ref().map_or("-".to_owned(), |ms| format!("{:.3}", value(ms)));
    let fragments = |value: fn(&PassFragments) -> u64| {
        pass.fragments.as_ref().map_or("-".to_owned(), |fragments| value(fragments).to_string())
    };
    let overdraw = pass.fragments.and_then(|fragments| fragments.overdraw());
    let overdraw = overdraw.map_or("-".to_owned(), |overdraw| format!("{overdraw:.2}"));
    let [median, min, max] = [ms(|ms| ms.median), ms(|ms| ms.min), ms(|ms| ms.max)];
    let [draws, instances, vertices, triangles] =
        [pass.draws.into(), pass.instances, pass.vertices, pass.triangles].map(|count: u64| count.to_string());
    let [shaded, rasterized] = [fragments(|counted| counted.shaded), fragments(|counted| counted.rasterized)];
    row(&[&pass.name, &median, &min, &max, &draws, &instances, &vertices, &triangles, &shaded, &rasterized, &overdraw])
}

/// The first column starts at the left, the others end at the right.
fn row(cells: &[&str; COLUMNS.len()]) -> String {
    let numbers: String = cells[1..].iter().map(|cell| format!("{cell:>11}")).collect();
    format!("{:<12}{numbers}\n", cells[0])
}

fn mib(bytes: u64) -> f64 {
    bytes as f64 / MIB
}
