//! `vair devices`.

use super::json;
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
        return json::print(&json!({ "devices": list }));
    }
    for device in &devices {
        println!("{} ({}, {}, Vulkan {})", device.name, device.kind, device.driver, device.api);
        match device.missing.as_slice() {
            [] => println!("    usable"),
            missing => println!("    refused: it lacks {}", missing.join(", ")),
        }
    }
    if devices.is_empty() {
        println!("no Vulkan device; install a driver, for example the package mesa-vulkan-drivers");
    }
    Ok(())
}
