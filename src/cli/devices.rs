//! `vair devices`.

use super::output;
use anyhow::Result;
use clap::Args;
use serde_json::json;

#[derive(Debug, Args)]
pub struct DevicesArguments {
    /// Prints one JSON object.
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &DevicesArguments) -> Result<()> {
    let devices = vair::gpu::devices()?;
    if arguments.json {
        let list: Vec<_> = devices
            .iter()
            .map(|device| {
                json!({
                    "name": device.name, "driver": device.driver, "api": device.api, "kind": device.kind.to_string(),
                    "usable": device.missing.is_empty(), "missing": device.missing,
                })
            })
            .collect();
        return output::print_json(&json!({ "devices": list }));
    }
    let mut text = String::new();
    for device in &devices {
        text += &format!("{} ({}, {}, Vulkan {})\n", device.name, device.kind, device.driver, device.api);
        text += &match device.missing.as_slice() {
            [] => "    usable\n".to_owned(),
            missing => format!("    refused: it lacks {}\n", missing.join(", ")),
        };
    }
    if devices.is_empty() {
        text += "no Vulkan device; install a driver, for example the package mesa-vulkan-drivers\n";
    }
    output::print(&text)
}
