//! `vair report`.

use super::cache::pipeline_cache_dir;
use super::device::{DeviceArguments, check_validation};
use super::output;
use anyhow::Result;
use clap::Args;
use std::path::PathBuf;
use vair::gpu::Gpu;
use vair::measure::report::{self, Effort, LAYERS_4X, Report, Sweep};

#[derive(Debug, Args)]
pub struct ReportArguments {
    /// Folder for tables, plots and the page; new, empty, or with an earlier report.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Small pictures and few points: two minutes on two cores.
    #[arg(long)]
    quick: bool,
    #[command(flatten)]
    device: DeviceArguments,
    /// Prints one JSON object: that of report.json.
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &ReportArguments) -> Result<()> {
    // Nobody should wait for a report in vain.
    report::check_folder(&arguments.out)?;
    let effort = if arguments.quick { Effort::quick() } else { Effort::full() };
    let gpu = Gpu::new(&arguments.device.options(pipeline_cache_dir()))?;
    let bar = output::progress(true, "{bar:40} {msg} {pos}/{len}");
    let measured = report::measure(&gpu, &Sweep::all(&effort), &effort, &mut |stage, done, count| {
        bar.set_length(count as u64);
        bar.set_position(done as u64);
        bar.set_message(stage);
    })?;
    bar.finish_and_clear();
    let log = gpu.validation_log();
    // What the end of the device brings up counts, too.
    drop(gpu);
    report::save(&measured, &arguments.out)?;
    if arguments.json {
        output::print_json(&measured.json())?;
    } else {
        output::print(&as_text(&measured, arguments))?;
    }
    check_validation(&log.messages())
}

fn as_text(report: &Report, arguments: &ReportArguments) -> String {
    let figure = |value: Option<f64>| value.map_or_else(|| "not measured".to_owned(), |value| format!("{value:.2}"));
    let summary = &report.summary;
    let mut text = format!("{}\n", arguments.out.join("index.html").display());
    text += &format!("speed at the error of 20 classic draws: {} times\n", figure(summary.equal_error_speedup));
    let [few, many] = LAYERS_4X;
    text += &format!("{many} layers over {few}: {} times the time\n", figure(summary.layers_4x_cost));
    text += &format!("whole fur over one opaque layer: {} times the time\n", figure(summary.vs_one_layer));
    for note in &summary.notes {
        text += &format!("{note}\n");
    }
    text
}
