//! `vair render`.

use super::cache::pipeline_cache_dir;
use super::device::{DeviceArguments, check_validation};
use super::output::{self, milliseconds};
use super::scene::SceneArguments;
use super::sequence::{self, Shard};
use super::{UsageError, values};
use anyhow::{Result, bail};
use clap::Args;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::Instant;

use vair::gpu::DeviceInfo;
use vair::material::Material;
use vair::measure::profile::Spread;
use vair::measure::{PassFragments, can_count_fragments, count_fragments};
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
    #[command(flatten)]
    device: DeviceArguments,
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
    if arguments.scene.aovs().any() && format != PictureFormat::Exr {
        return Err(UsageError("--aov: only EXR files hold layers; name the picture .exr with --out").into());
    }
    if arguments.scene.aovs().occlusion && !arguments.scene.has_screen_occlusion() {
        return Err(UsageError("--aov occlusion shows screen-space occlusion; turn it on with --ssao on").into());
    }
    let count = arguments.frame_numbers().map_or(1, Iterator::count);
    let Some(first) = arguments.shots().next() else {
        bail!("--shard: no frame of this sequence is in that part; use fewer parts than frames");
    };
    if !to_stdout {
        output::check_writable(&first.path, "vair.png")?;
    }

    let start = Instant::now();
    let scene = arguments.scene.load()?;
    let load_ms = start.elapsed().as_secs_f64() * 1e3;
    let options = arguments.scene.frame_options(&scene, arguments.frames.is_some())?;
    if !arguments.json {
        arguments.scene.complain(&scene);
    }

    let mut renderer = Renderer::new(&arguments.device.options(pipeline_cache_dir()))?;
    let mut times = FrameTimes { load_ms, ..FrameTimes::default() };
    let mut last = None;
    let progress = output::progress(count > 1, "{bar:40} {pos}/{len} frames, {eta} left");
    progress.set_length(count as u64);
    let at = |offset_s: f64| {
        let time_s = f64::from(options.time_s) + offset_s;
        let previous_time_s = Some((time_s - 1.0 / f64::from(arguments.fps)) as f32);
        FrameOptions { time_s: time_s as f32, previous_time_s, ..options.clone() }
    };
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
        times.add(&report);
        last = Some((path, options, report));
        progress.inc(1);
    }
    progress.finish_and_clear();
    let Some((path, options, mut report)) = last else { bail!("no frame was asked for") };
    let first_ms = times.frames_ms[0];
    // The first frame uploads and compiles: it is told apart.
    times.drop_first();

    // The picture's own frame was the warm-up.
    if let Some(count) = arguments.bench {
        times = FrameTimes { load_ms, ..FrameTimes::default() };
        for _ in 0..count {
            (_, report) = renderer.render_reported(&scene, &options, false)?;
            times.add(&report);
        }
    }

    let info = renderer.gpu().info().clone();
    let host_peak_bytes = host_peak_bytes();
    // Last: counting takes pipelines and memory of its own.
    let fragments = match arguments.json && can_count_fragments(renderer.gpu(), &options) {
        true => count_fragments(&mut renderer, &scene, &options)?,
        false => Vec::new(),
    };
    // What the end of the device brings up counts, too.
    let log = renderer.gpu().validation_log();
    drop(renderer);
    let messages = log.messages();
    times.first_ms = first_ms;
    if arguments.json {
        output::print_json(&summary(&Rendered {
            info: &info,
            messages: &messages,
            scene: &scene,
            path: &path,
            options: &options,
            report: &report,
            times: &times,
            fragments: &fragments,
            host_peak_bytes,
        }))?;
    } else if !to_stdout {
        output::print(&as_text(&path, count, &report, &times))?;
    }
    check_validation(&messages)
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

/// Times of the frames that count: with --bench the timed ones, otherwise all.
#[derive(Default)]
struct FrameTimes {
    load_ms: f64,
    first_ms: f64,
    frames_ms: Vec<f64>,
    /// By name of the pass.
    passes_ms: BTreeMap<String, Vec<f64>>,
}

impl FrameTimes {
    fn add(&mut self, report: &FrameReport) {
        self.frames_ms.push(report.frame_ms);
        for pass in &report.passes {
            self.passes_ms.entry(pass.name.clone()).or_default().extend(pass.gpu_ms);
        }
    }

    /// Where there are others.
    fn drop_first(&mut self) {
        for times in self.passes_ms.values_mut().chain([&mut self.frames_ms]).filter(|times| times.len() > 1) {
            times.remove(0);
        }
    }

    fn of_pass(&self, name: &str) -> Option<Spread> {
        Spread::of(self.passes_ms.get(name)?)
    }
}

/// What `--json` tells of.
struct Rendered<'a> {
    info: &'a DeviceInfo,
    messages: &'a [String],
    scene: &'a Scene,
    path: &'a Path,
    options: &'a FrameOptions,
    report: &'a FrameReport,
    times: &'a FrameTimes,
    fragments: &'a [PassFragments],
    host_peak_bytes: Option<u64>,
}

fn summary(rendered: &Rendered) -> Value {
    let Rendered { info, messages, scene, path, options, report, times, fragments, host_peak_bytes } = *rendered;
    let frames = Spread::of(&times.frames_ms);
    let frame = |value: fn(&Spread) -> f64| frames.as_ref().map(|spread| milliseconds(value(spread)));
    let passes = report.passes.iter().map(|pass| {
        let spread = times.of_pass(&pass.name);
        let gpu_ms = |value: fn(&Spread) -> f64| spread.as_ref().map(|spread| milliseconds(value(spread)));
        let fragments = fragments.iter().find(|counted| counted.pass.name() == pass.name);
        json!({
            "name": pass.name, "gpu_ms": gpu_ms(|spread| spread.median), "gpu_ms_min": gpu_ms(|spread| spread.min),
            "gpu_ms_max": gpu_ms(|spread| spread.max), "gpu_ms_count": spread.map_or(0, |spread| spread.count),
            "draws": pass.draws, "instances": pass.instances, "triangles": pass.triangles,
            "fragments": fragments.map(|counted| counted.shaded).or((pass.triangles == 0).then_some(0)),
        })
    });
    json!({
        "device": output::device(info),
        // A name that is not UTF-8 cannot be JSON as it is.
        "image": { "path": path.to_string_lossy(), "width": options.size[0], "height": options.size[1] },
        "ms": {
            "load": milliseconds(times.load_ms), "pipelines": milliseconds(report.pipelines_ms),
            "first_frame": milliseconds(times.first_ms), "frame_min": frame(|spread| spread.min),
            "frame_median": frame(|spread| spread.median), "frame_max": frame(|spread| spread.max),
            "frame_count": times.frames_ms.len(),
        },
        "passes": passes.collect::<Vec<_>>(),
        "fur": output::fur(&report.fur),
        "transparency": report.lists.map(|lists| json!({ "fragments": lists.fragments, "entries": lists.entries })),
        "memory": { "device_bytes": report.memory.device_bytes, "host_peak_bytes": host_peak_bytes },
        "left_out": output::left_out(&report.skipped),
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
    let mut text = match count {
        1 => format!("{}\n", path.display()),
        _ => format!("{count} frames, the last {}\n", path.display()),
    };
    if let Some(Spread { median, min, max, count }) = Spread::of(&times.frames_ms) {
        text += &match count {
            1 if median == times.first_ms => {
                format!("frame: {median:.1} ms, with uploads and pipelines ({:.1} ms)\n", report.pipelines_ms)
            }
            _ => format!("frame: median {median:.1} ms, {min:.1} to {max:.1} ms over {count} frames\n"),
        };
    }
    for pass in &report.passes {
        let median = times.of_pass(&pass.name).map(|spread| spread.median);
        let time = median.map_or_else(|| "not timed".to_owned(), |ms| format!("{ms:.2} ms"));
        let (name, draws, instances, triangles) = (pass.name.as_str(), pass.draws, pass.instances, pass.triangles);
        text += &format!("  {name:<12} {time:>12}  {draws} draws, {instances} instances, {triangles} triangles\n");
    }
    if let Some(lists) = report.lists.filter(|lists| lists.fragments > lists.entries) {
        let missed = lists.fragments - lists.entries;
        text +=
            &format!("{missed} of {} fragments that blend are sorted by objects: too many a pixel\n", lists.fragments);
    }
    text += &format!("device memory: {:.1} MiB\n", report.memory.device_bytes as f64 / f64::from(1 << 20));
    text
}
