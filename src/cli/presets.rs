//! `vair presets`.

use super::cache::pipeline_cache_dir;
use super::device::{DeviceArguments, check_validation};
use super::output;
use anyhow::{Result, bail};
use clap::Args;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use vair::asset::procedural::SWATCH_CAMERA;
use vair::material::{KINDS, Parameter, presets};
use vair::scene::{CameraChoice, Scene};
use vair::{FrameOptions, Renderer};

#[derive(Debug, Args)]
pub struct PresetsArguments {
    /// Every parameter that a look may set, with unit, range and default.
    #[arg(long)]
    parameters: bool,
    /// Renders a picture of each preset, NAME.png, into the folder.
    #[arg(long, value_name = "DIR", conflicts_with_all = ["parameters", "json"])]
    pictures: Option<PathBuf>,
    /// Side of those pictures, pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 320, value_parser = clap::value_parser!(u32).range(16..=4096), requires = "pictures")]
    side: u32,
    /// Only the presets whose names contain this.
    #[arg(long, value_name = "NAME", requires = "pictures")]
    only: Option<String>,
    #[command(flatten)]
    device: DeviceArguments,
    /// Prints one JSON object.
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &PresetsArguments) -> Result<()> {
    if let Some(folder) = &arguments.pictures {
        return save_pictures(arguments, folder);
    }
    if arguments.json {
        let list: Vec<Value> = presets()
            .iter()
            .map(|preset| {
                let parameters: serde_json::Map<String, Value> =
                    preset.parameters().map(|(key, value)| (key.to_owned(), value.into())).collect();
                json!({ "name": preset.name, "kind": preset.kind(), "help": preset.help, "parameters": parameters })
            })
            .collect();
        let families: serde_json::Map<String, Value> =
            KINDS.iter().map(|(kind, list)| ((*kind).to_owned(), list.iter().map(parameter).collect())).collect();
        return output::print_json(&json!({
            "presets": list,
            "parameters": families,
        }));
    }
    let mut text = String::new();
    if arguments.parameters {
        for (kind, list) in KINDS {
            text += &format!("{kind}\n");
            for entry in *list {
                let choices =
                    if entry.choices.is_empty() { String::new() } else { format!(" ({})", entry.choices.join(", ")) };
                let unit = if entry.unit.is_empty() { String::new() } else { format!(" {}", entry.unit) };
                let range = match entry.range {
                    (least, most) if least.is_finite() && most.is_finite() => format!(", {least} to {most}{unit}"),
                    _ => unit,
                };
                let (name, kind, default) = (entry.name, entry.kind, (entry.default)());
                text += &format!("  {name:<28} {kind}{choices}{range} [{default}]: {}\n", entry.help);
            }
        }
        return output::print(&text);
    }
    for preset in presets() {
        text += &format!("{} ({}): {}\n", preset.name, preset.kind(), preset.help);
        for (key, value) in preset.parameters() {
            text += &format!("    {key} = {value}\n");
        }
    }
    output::print(&text)
}

/// A sample of each preset, as its picture in the README shows it.
fn save_pictures(arguments: &PresetsArguments, folder: &Path) -> Result<()> {
    let wanted = |name: &str| arguments.only.as_ref().is_none_or(|part| name.contains(part.as_str()));
    let chosen: Vec<_> = presets().iter().filter(|preset| wanted(&preset.name)).collect();
    if chosen.is_empty() {
        bail!("--only: no preset's name contains it; `vair presets` lists them");
    }
    output::check_writable(&folder.join("fox.png"), "fox.png")?;
    let mut renderer = Renderer::new(&arguments.device.options(pipeline_cache_dir()))?;
    let bar = output::progress(true, "{bar:40} {msg} {pos}/{len}");
    bar.set_length(chosen.len() as u64);
    let camera = CameraChoice::Named(SWATCH_CAMERA.to_owned());
    let options = FrameOptions { size: [arguments.side; 2], camera, ..FrameOptions::default() };
    for preset in chosen {
        bar.set_message(preset.name.clone());
        let picture = renderer.render(&Scene::swatch(&preset.name)?, &options)?;
        picture.save(folder.join(format!("{}.png", preset.hyphenated())))?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    check_validation(&renderer.gpu().validation_messages())
}

fn parameter(entry: &Parameter) -> Value {
    let bound = |value: f64| if value.is_finite() { Value::from(value) } else { Value::Null };
    json!({
        "name": entry.name, "kind": entry.kind, "choices": entry.choices, "unit": entry.unit,
        "range": [bound(entry.range.0), bound(entry.range.1)], "default": (entry.default)(), "help": entry.help,
    })
}
