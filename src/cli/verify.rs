//! `vair verify`.

use super::device::{DeviceArguments, check_validation};
use super::output;
use anyhow::{Result, bail};
use clap::Args;
use serde_json::{Map, Value, json};
use vair::gpu::Gpu;
use vair::measure::verify::{self, FunctionReport, Report, Worst};

#[derive(Debug, Args)]
pub struct VerifyArguments {
    /// Names the functions, and evaluates nothing.
    #[arg(long, conflicts_with_all = ["device", "validate"])]
    list: bool,
    /// A function, or those whose names contain this.
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    #[command(flatten)]
    device: DeviceArguments,
    /// Prints one JSON object.
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &VerifyArguments) -> Result<()> {
    if arguments.list {
        return list(arguments);
    }
    let gpu = Gpu::new(&arguments.device.options(None))?;
    let log = gpu.validation_log();
    let report = verify::run(&gpu, arguments.only.as_deref())?;
    drop(gpu);
    if arguments.json {
        output::print_json(&as_json(&report))?;
    } else {
        output::print(&as_text(&report))?;
    }
    check_validation(&log.messages())?;
    if let Some(broken) = report.properties.iter().find(|property| property.fails()) {
        bail!("a formula breaks its promise: {broken}");
    }
    let failed: Vec<_> =
        report.functions.iter().filter(|function| !function.pass).map(|function| function.name).collect();
    match failed.as_slice() {
        [] => Ok(()),
        [first, ..] => bail!(
            "{} of {} functions miss their limits on {}, {first} among them; --only {first} shows where",
            failed.len(),
            report.functions.len(),
            report.device
        ),
    }
}

fn list(arguments: &VerifyArguments) -> Result<()> {
    let names: Vec<_> = verify::chosen(arguments.only.as_deref())?.iter().map(|twin| twin.name).collect();
    if arguments.json {
        return output::print_json(&json!({ "functions": names }));
    }
    output::print(&(names.join("\n") + "\n"))
}

fn as_text(report: &Report) -> String {
    let mut text = format!(
        "{:<36} {:>8} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
        "function", "samples", "max rel", "p99.9", "max abs", "limit rel", "abs"
    );
    for function in &report.functions {
        text += &format!(
            "{:<36} {:>8} {:>9.1e} {:>9.1e} {:>9.1e} {:>9.1e} {:>9.1e}{}\n",
            function.name,
            function.samples,
            function.max_rel,
            function.p999_rel,
            function.max_abs,
            function.limit.rel,
            function.limit.abs,
            match (function.pass, function.missed) {
                (true, 0) => String::new(),
                (true, missed) => format!("  {missed} missed, as allowed"),
                (false, _) => "  FAIL".to_owned(),
            }
        );
        if !function.pass {
            text += &failure(function);
        }
    }
    if !report.properties.is_empty() {
        text += "\nmaterials, by their formulas; `classic` is what older engines evaluate\n";
        for property in &report.properties {
            text += &format!("{property}\n");
        }
        text += "\n";
    }
    let passed = report.functions.iter().filter(|function| function.pass).count();
    let (count, device, seconds) = (report.functions.len(), &report.device, report.seconds);
    text + &format!("{passed} of {count} functions meet their limits on {device}, {seconds:.1} s\n")
}

fn failure(function: &FunctionReport) -> String {
    let (missed, nonfinite) = (function.missed, function.nonfinite);
    let mut text = format!("    {missed} samples miss the limit, {nonfinite} are not finite; the worst:\n");
    if let Some(Worst { inputs, found, expected }) = &function.worst {
        for (name, values) in inputs {
            text += &format!("    {name} = {values:?}\n");
        }
        text += &format!("    gives {found:?}\n    not   {expected:?}\n");
    }
    text
}

fn as_json(report: &Report) -> Value {
    json!({
        "device": report.device, "seconds": (report.seconds * 1e3).round() / 1e3, "pass": report.pass(),
        "functions": report.functions.iter().map(function_as_json).collect::<Vec<_>>(),
        "furnace": report.properties,
    })
}

fn function_as_json(function: &FunctionReport) -> Value {
    json!({
        "name": function.name, "file": function.file, "samples": function.samples, "seeded": function.seeded,
        "max_rel": function.max_rel, "max_rel_seeded": function.max_rel_seeded, "p999_rel": function.p999_rel,
        "max_abs": function.max_abs, "of_limit": function.of_limit, "nonfinite": function.nonfinite,
        "by_rule": function.by_rule, "missed": function.missed, "missed_allowed": function.missed_allowed, "limit": function.limit.rel,
        "limit_abs": function.limit.abs, "pass": function.pass,
        "worst": function.worst.as_ref().map(|worst| json!({
            "inputs": worst.inputs.iter().map(|(name, values)| ((*name).to_owned(), numbers(values))).collect::<Map<_, _>>(),
            "found": worst.found, "expected": worst.expected,
        })),
    })
}

/// Inputs may be what JSON has no number for.
fn numbers(values: &[f64]) -> Value {
    values.iter().map(|&value| if value.is_finite() { json!(value) } else { json!(value.to_string()) }).collect()
}
