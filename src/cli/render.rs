//! `vair render`.

use super::cache::pipeline_cache_dir;
use super::output::{self, milliseconds};
use super::scene::SceneArguments;
use super::sequence::{self, Shard};
use super::{UsageError, values};
use anyhow::{Result, bail};
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde_json::{Value, json};
use std::io::IsTerminal;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::Instant;

use vair::gpu::{DeviceInfo, GpuOptions};
use vair::material::Material;
use vair::render::{FrameOptions, FrameReport, PictureFormat, Renderer};
use vair::scene::Scene;

#[derive(Debug, Args)]
pub struct RenderArguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Frames A up to, not including, B of the animation.
    #[arg(long, value_name = "A..B", value_parser = values::frames)]
    frames: Option<Range<u32>>,
    /// Frames a second of a sequence; frame 0 is at --time.
    #[arg(long, value_name = "F", default_value = "30", value_parser = values::frame_rate)]
    fps: f32,
    /// Of a sequence, only the frames whose number divided by N leaves I.
    #[arg(long, value_name = "I/N", value_parser = values::shard, requires = "frames")]
    shard: Option<Shard>,
    /// The picture: .png or .exr (linear light); of a sequence, {frame} becomes the number; - is standard output.
    #[arg(long, value_name = "FILE", default_value = "vair.png", value_parser = values::PictureFile)]
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
        return Err(UsageError("--out - and --json both want standard output; give the picture a file name").into());
    }
    if to_stdout && arguments.frames.is_some() {
        return Err(UsageError("--out - holds one picture; give a sequence a file name").into());
    }
    let format = if to_stdout { PictureFormat::Png } else { PictureFormat::of(&arguments.out)? };
    let count = arguments.frame_numbers().map_or(1, Iterator::count);
    let Some(first) = arguments.shots().next() else {
        bail!("--shard: no frame of this sequence is in that part; use fewer parts than frames");
    };
    if !to_stdout {
        output::check_writable(&first.path)?;
    }

    let start = Instant::now();
    let scene = arguments.scene.load()?;
    let load_ms = start.elapsed().as_secs_f64() * 1e3;
    let options = arguments.scene.frame_options(&scene, arguments.frames.is_some())?;
    if !arguments.json {
        arguments.scene.complain(&scene);
    }

    let mut renderer = Renderer::new(&GpuOptions {
        device: arguments.device.clone(),
        validate: arguments.validate,
        pipeline_cache_dir: pipeline_cache_dir(),
    })?;
    let mut frames_ms = Vec::new();
    let mut last = None;
    let progress = progress(count);
    let at = |offset_s: f64| FrameOptions { time_s: (f64::from(options.time_s) + offset_s) as f32, ..options.clone() };
    let sways = |material: &Material| material.fur.as_ref().is_some_and(|fur| fur.inertia > 0.0);
    let sways = scene.materials().iter().any(sways);
    let mut reached = arguments.frames.as_ref().map_or(0, |frames| frames.start);
    for Shot { path, frame, offset_s } in arguments.shots() {
        // Strands come here on the same way whatever is drawn of it.
        for offset_s in sequence::steps(reached, frame, arguments.fps).take_while(|_| sways) {
            renderer.advance(&scene, &at(offset_s))?;
        }
        reached = frame;
        let options = at(offset_s);
        let (picture, report) = renderer.render_reported(&scene, &options, format == PictureFormat::Exr)?;
        if to_stdout {
            output::print_bytes(&picture.encode(format)?)?;
        } else {
            picture.save(&path)?;
        }
        frames_ms.push(report.frame_ms);
        last = Some((path, report));
        progress.inc(1);
    }
    progress.finish_and_clear();
    let Some((path, mut report)) = last else { bail!("no frame was asked for") };
    let first_ms = frames_ms[0];

    // The picture's own frame was the warm-up.
    if let Some(count) = arguments.bench {
        frames_ms.clear();
        for _ in 0..count {
            (_, report) = renderer.render_reported(&scene, &options, false)?;
            frames_ms.push(report.frame_ms);
        }
    }

    let info = renderer.gpu().info().clone();
    // What the end of the device brings up counts, too.
    let log = renderer.gpu().validation_log();
    drop(renderer);
    let messages = log.messages();
    let times = FrameTimes { load_ms, first_ms, frames_ms: &frames_ms };
    if arguments.json {
        output::print_json(&summary(&info, &messages, &scene, &path, &options, &report, &times))?;
    } else if !to_stdout {
        output::print(&as_text(&path, count, &report, &times))?;
    }
    if let Some(first) = messages.first() {
        bail!("{} validation messages; the first: {first}", messages.len());
    }
    Ok(())
}

/// One picture to make.
struct Shot {
    path: PathBuf,
    /// Number in the sequence.
    frame: u32,
    /// Seconds after `--time`.
    offset_s: f64,
}

impl RenderArguments {
    /// Numbers of a sequence's frames; `None` without a sequence.
    fn frame_numbers(&self) -> Option<impl Iterator<Item = u32>> {
        self.frames.clone().map(|range| sequence::frames(range, self.shard))
    }

    fn shots(&self) -> Box<dyn Iterator<Item = Shot> + '_> {
        match self.frame_numbers() {
            None => Box::new(std::iter::once(Shot { path: self.out.clone(), frame: 0, offset_s: 0.0 })),
            Some(frames) => Box::new(frames.map(|frame| Shot {
                path: sequence::file(&self.out, frame),
                frame,
                offset_s: f64::from(frame) / f64::from(self.fps),
            })),
        }
    }
}

fn progress(frames: usize) -> ProgressBar {
    if frames < 2 || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(frames as u64), ProgressDrawTarget::stderr());
    match ProgressStyle::with_template("{bar:40} {pos}/{len} frames, {eta} left") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

struct FrameTimes<'a> {
    load_ms: f64,
    first_ms: f64,
    frames_ms: &'a [f64],
}

/// Smallest, middle and largest of at least one value.
fn spread(values: &[f64]) -> (f64, f64, f64) {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    let median = if sorted.len() % 2 == 1 { sorted[middle] } else { 0.5 * (sorted[middle - 1] + sorted[middle]) };
    (sorted[0], median, sorted[sorted.len() - 1])
}

fn summary(
    info: &DeviceInfo,
    messages: &[String],
    scene: &Scene,
    path: &Path,
    options: &FrameOptions,
    report: &FrameReport,
    times: &FrameTimes,
) -> Value {
    let (min, median, max) = spread(times.frames_ms);
    let passes = report.passes.iter().map(|pass| {
        json!({
            "name": pass.name, "gpu_ms": pass.gpu_ms.map(milliseconds), "draws": pass.draws,
            "instances": pass.instances, "triangles": pass.triangles,
            "fragments": pass.statistics.as_ref().map(|statistics| statistics.fragment_invocations),
        })
    });
    let fur = report.fur.iter().map(|coat| {
        json!({
            "material": coat.material, "layers": coat.layers, "instances": coat.instances,
            "vertices_stored": coat.vertices_stored,
        })
    });
    let left_out = report.left_out.iter().map(|left| json!({ "what": left.what, "why": left.why }));
    json!({
        "device": { "name": info.name, "driver": info.driver, "api": info.api },
        // A name that is not UTF-8 cannot be JSON as it is.
        "image": { "path": path.to_string_lossy(), "width": options.size[0], "height": options.size[1] },
        "ms": {
            "load": milliseconds(times.load_ms), "pipelines": milliseconds(report.pipelines_ms),
            "first_frame": milliseconds(times.first_ms), "frame_min": milliseconds(min),
            "frame_median": milliseconds(median), "frame_max": milliseconds(max),
            "frame_count": times.frames_ms.len(),
        },
        "passes": passes.collect::<Vec<_>>(),
        "fur": fur.collect::<Vec<_>>(),
        "memory": { "device_bytes": report.memory.device_bytes, "host_peak_bytes": host_peak_bytes() },
        "left_out": left_out.collect::<Vec<_>>(),
        "warnings": scene.asset().warnings,
        "validation_messages": messages,
    })
}

/// The most memory this process has held, where the system tells.
fn host_peak_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix(" kB")?.trim().parse::<u64>().ok().map(|kib| kib * 1024)
}

fn as_text(path: &Path, count: usize, report: &FrameReport, times: &FrameTimes) -> String {
    let (min, median, max) = spread(times.frames_ms);
    let mut text = match count {
        1 => format!("{}\n", path.display()),
        _ => format!("{count} frames, the last {}\n", path.display()),
    };
    text += &match times.frames_ms {
        [_] => format!("frame: {median:.1} ms, with uploads and pipelines ({:.1} ms)\n", report.pipelines_ms),
        all => format!("frame: median {median:.1} ms, {min:.1} to {max:.1} ms over {} frames\n", all.len()),
    };
    for pass in &report.passes {
        let time = pass.gpu_ms.map_or_else(|| "not timed".to_owned(), |ms| format!("{ms:.2} ms"));
        let (name, draws, instances, triangles) = (pass.name.as_str(), pass.draws, pass.instances, pass.triangles);
        text += &format!("  {name:<12} {time:>12}  {draws} draws, {instances} instances, {triangles} triangles\n");
    }
    text += &format!("device memory: {:.1} MiB\n", report.memory.device_bytes as f64 / f64::from(1 << 20));
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_of_an_even_number_lies_between() {
        assert_eq!(spread(&[4.0, 1.0, 3.0, 2.0]), (1.0, 2.5, 4.0));
        assert_eq!(spread(&[5.0]), (5.0, 5.0, 5.0));
    }
}
