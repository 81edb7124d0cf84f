//! `vair report`.

use super::cache::pipeline_cache_dir;
use super::output;
use anyhow::{Result, bail};
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::path::PathBuf;
use vair::gpu::{Gpu, GpuOptions};
use vair::report::{self, Effort, LAYERS_4X, Question, Report};

#[derive(Debug, Args)]
pub struct ReportArguments {
    /// Folder for tables, plots and the page; new, empty, or with an earlier report.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Small pictures and few points: two minutes on two cores.
    #[arg(long)]
    quick: bool,
    /// Device by a part of its name.
    #[arg(long, value_name = "SUBSTRING")]
    device: Option<String>,
    /// Runs with the validation layer; any message makes the exit status 1, and times mean less.
    #[arg(long)]
    validate: bool,
    /// Prints one JSON object: that of report.json.
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &ReportArguments) -> Result<()> {
    // Nobody should wait for a report in vain.
    report::check_folder(&arguments.out)?;
    let effort = if arguments.quick { Effort::quick() } else { Effort::full() };
    let gpu = Gpu::new(&GpuOptions {
        device: arguments.device.clone(),
        validate: arguments.validate,
        pipeline_cache_dir: pipeline_cache_dir(),
    })?;
    let bar = progress_bar();
    let measured = report::measure(&gpu, &Question::all(&effort), &effort, &mut |stage, done, count| {
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
    let messages = log.messages();
    if let Some(first) = messages.first() {
        bail!("{} validation messages; the first: {first}", messages.len());
    }
    Ok(())
}

fn progress_bar() -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(1), ProgressDrawTarget::stderr());
    match ProgressStyle::with_template("{bar:40} {msg} {pos}/{len}") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

fn as_text(report: &Report, arguments: &ReportArguments) -> String {
    let figure = |value: Option<f64>| value.map_or_else(|| "not measured".to_owned(), |value| format!("{value:.2}"));
    let headline = &report.headline;
    let mut text = format!("{}\n", arguments.out.join("index.html").display());
    text += &format!("speed at the error of 20 classic draws: {} times\n", figure(headline.equal_error_speedup));
    let [few, many] = LAYERS_4X;
    text += &format!("{many} layers over {few}: {} times the time\n", figure(headline.layers_4x_cost));
    text += &format!("whole coat over one opaque layer: {} times the time\n", figure(headline.vs_one_layer));
    for note in &headline.notes {
        text += &format!("{note}\n");
    }
    text
}
