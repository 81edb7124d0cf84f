//! `vair render`.

use super::json::{self, milliseconds};
use super::scene::SceneArguments;
use super::values;
use anyhow::{Context, Result, bail};
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde_json::{Value, json};
use std::io::{IsTerminal, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::Instant;
use vair::gpu::GpuOptions;
use vair::render::{FrameOptions, FrameReport, PictureFormat, Renderer};
use vair::scene::Scene;

#[derive(Debug, Args)]
pub struct RenderArguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Frames A up to, not including, B of the animation.
    #[arg(long, value_name = "A..B", value_parser = values::frames)]
    frames: Option<Range<u32>>,
    /// Frames a second of a sequence.
    #[arg(long, value_name = "F", default_value = "30", value_parser = values::frame_rate)]
    fps: f32,
    /// Of a sequence, only the frames whose number divided by N leaves I.
    #[arg(long, value_name = "I/N", value_parser = values::shard, requires = "frames")]
    shard: Option<(u32, u32)>,
    /// The picture: .png or .exr (linear light); of a sequence, {frame} becomes the number; - is standard output.
    #[arg(long, value_name = "FILE", default_value = "vair.png")]
    out: PathBuf,
    /// After a warm-up, N timed frames.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000), conflicts_with = "frames")]
    bench: Option<u32>,
    /// Device by a part of its name.
    #[arg(long, value_name = "SUBSTRING")]
    device: Option<String>,
    /// Runs with the validation layer; any message makes the exit status 1.
    #[arg(long)]
    validate: bool,
    /// Prints one JSON object.
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &RenderArguments) -> Result<()> {
    let to_stdout = arguments.out == Path::new("-");
    if to_stdout && arguments.json {
        bail!("--out - and --json both want standard output; give the picture a file name");
    }
    if to_stdout && arguments.frames.is_some() {
        bail!("--out -: a sequence needs a file name");
    }
    let format = if to_stdout { PictureFormat::Png } else { PictureFormat::of(&arguments.out)? };

    let start = Instant::now();
    let scene = arguments.scene.load()?;
    let load_ms = start.elapsed().as_secs_f64() * 1e3;
    let options = arguments.scene.frame_options(&scene)?;
    if !arguments.json {
        for warning in &scene.asset.warnings {
            eprintln!("vair: warning: {warning}");
        }
    }

    let mut renderer = Renderer::new(&GpuOptions {
        device: arguments.device.clone(),
        validate: arguments.validate,
        ..GpuOptions::default()
    })?;
    let mut frames_ms = Vec::new();
    let mut last = None;
    let shots = shots(arguments, &options);
    let progress = progress(shots.len());
    for (path, options) in &shots {
        let (picture, report) = renderer.render_reported(&scene, options, format == PictureFormat::Exr)?;
        if to_stdout {
            std::io::stdout().write_all(&picture.encode(format)?).context("standard output")?;
        } else {
            picture.save(path)?;
        }
        frames_ms.push(report.frame_ms);
        last = Some((path.clone(), report));
        progress.inc(1);
    }
    progress.finish_and_clear();
    let Some((path, mut report)) = last else { bail!("--shard leaves no frame of this sequence") };
    let first_ms = frames_ms[0];

    if let Some(count) = arguments.bench {
        frames_ms.clear();
        for _ in 0..count {
            (_, report) = renderer.render_reported(&scene, &options, false)?;
            frames_ms.push(report.frame_ms);
        }
    }

    let messages = renderer.gpu().validation_messages();
    if arguments.json {
        let times = FrameTimes { load_ms, first_ms, frames_ms: &frames_ms };
        json::print(&summary(&renderer, &scene, &path, &options, &report, &times))?;
    } else if !to_stdout {
        print_text(&path, shots.len(), &report, &frames_ms, arguments.bench.is_some());
    }
    if let Some(first) = messages.first() {
        bail!("{} validation messages; the first: {first}", messages.len());
    }
    Ok(())
}

/// The files to write and the frame of each.
fn shots(arguments: &RenderArguments, options: &FrameOptions) -> Vec<(PathBuf, FrameOptions)> {
    let Some(frames) = arguments.frames.clone() else {
        return vec![(arguments.out.clone(), options.clone())];
    };
    frames
        .filter(|frame| arguments.shard.is_none_or(|(part, parts)| frame % parts == part))
        .map(|frame| {
            let time_s = options.time_s + frame as f32 / arguments.fps;
            (numbered(&arguments.out, frame), FrameOptions { time_s, ..options.clone() })
        })
        .collect()
}

/// `{frame}` becomes the number; without it the number goes before the ending.
fn numbered(path: &Path, frame: u32) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let number = format!("{frame:04}");
    let name = if name.contains("{frame}") {
        name.replace("{frame}", &number)
    } else {
        match name.rsplit_once('.') {
            Some((stem, ending)) => format!("{stem}{number}.{ending}"),
            None => name + &number,
        }
    };
    path.with_file_name(name)
}

fn progress(frames: usize) -> ProgressBar {
    if frames < 2 || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} frames, {eta} left");
    let bar = ProgressBar::with_draw_target(Some(frames as u64), ProgressDrawTarget::stderr());
    match style {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

struct FrameTimes<'a> {
    load_ms: f64,
    first_ms: f64,
    frames_ms: &'a [f64],
}

/// Smallest, middle and largest.
fn spread(values: &[f64]) -> (f64, f64, f64) {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    let median = if sorted.len() % 2 == 1 { sorted[middle] } else { 0.5 * (sorted[middle - 1] + sorted[middle]) };
    (sorted[0], median, sorted[sorted.len() - 1])
}

fn summary(
    renderer: &Renderer,
    scene: &Scene,
    path: &Path,
    options: &FrameOptions,
    report: &FrameReport,
    times: &FrameTimes,
) -> Value {
    let info = renderer.gpu().info();
    let (min, median, max) = spread(times.frames_ms);
    let passes: Vec<Value> = report
        .passes
        .iter()
        .map(|pass| {
            json!({
                "name": pass.name, "gpu_ms": pass.gpu_ms.map(milliseconds), "draws": pass.draws,
                "instances": pass.instances, "triangles": pass.triangles,
                "fragments": pass.statistics.as_ref().map(|statistics| statistics.fragment_invocations),
            })
        })
        .collect();
    let fur: Vec<Value> = report
        .fur
        .iter()
        .map(|coat| {
            json!({
                "material": coat.material, "layers": coat.layers, "instances": coat.instances,
                "vertices_stored": coat.vertices_stored,
            })
        })
        .collect();
    let left_out: Vec<Value> =
        report.left_out.iter().map(|left| json!({ "what": left.what, "why": left.why })).collect();
    json!({
        "device": { "name": info.name, "driver": info.driver, "api": info.api },
        "image": { "path": path, "width": options.size[0], "height": options.size[1] },
        "ms": {
            "load": milliseconds(times.load_ms), "pipelines": milliseconds(report.pipelines_ms),
            "first_frame": milliseconds(times.first_ms), "frame_min": milliseconds(min),
            "frame_median": milliseconds(median), "frame_max": milliseconds(max), "frames": times.frames_ms.len(),
        },
        "passes": passes,
        "fur": fur,
        "memory": { "device_bytes": report.memory.device_bytes, "host_peak_bytes": host_peak_bytes() },
        "left_out": left_out,
        "warnings": scene.asset.warnings,
        "validation_messages": renderer.gpu().validation_messages(),
    })
}

/// The most memory this process has held, where the system tells.
fn host_peak_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix(" kB")?.trim().parse::<u64>().ok().map(|kib| kib * 1024)
}

fn print_text(path: &Path, count: usize, report: &FrameReport, frames_ms: &[f64], bench: bool) {
    let written =
        if count == 1 { path.display().to_string() } else { format!("{count} frames, the last {}", path.display()) };
    let (min, median, max) = spread(frames_ms);
    println!("{written}");
    if bench || count > 1 {
        println!("frame: median {median:.1} ms, {min:.1} to {max:.1} ms over {} frames", frames_ms.len());
    } else {
        println!("frame: {median:.1} ms, the first one, with uploads and pipelines ({:.1} ms)", report.pipelines_ms);
    }
    for pass in &report.passes {
        let time = pass.gpu_ms.map_or_else(|| "not timed".to_owned(), |ms| format!("{ms:.2} ms"));
        println!(
            "  {:<12} {time:>12}  {} draws, {} instances, {} triangles",
            pass.name, pass.draws, pass.instances, pass.triangles
        );
    }
    println!("device memory: {:.1} MiB", report.memory.device_bytes as f64 / f64::from(1 << 20));
}
