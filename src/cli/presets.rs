//! `vair presets`.

use super::output;
use anyhow::Result;
use clap::Args;
use serde_json::{Value, json};
use vair::material::{KINDS, Parameter, presets};

#[derive(Debug, Args)]
pub struct PresetsArguments {
    /// Every parameter that a look may set, with unit, range and default.
    #[arg(long)]
    parameters: bool,
    /// Prints one JSON object.
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &PresetsArguments) -> Result<()> {
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

fn parameter(entry: &Parameter) -> Value {
    let bound = |value: f64| if value.is_finite() { Value::from(value) } else { Value::Null };
    json!({
        "name": entry.name, "kind": entry.kind, "choices": entry.choices, "unit": entry.unit,
        "range": [bound(entry.range.0), bound(entry.range.1)], "default": (entry.default)(), "help": entry.help,
    })
}
