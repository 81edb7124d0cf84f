//! Options that choose a device; every command that opens one shares them.

use anyhow::{Result, bail};
use clap::Args;
use std::path::PathBuf;
use vair::gpu::GpuOptions;

/// Which device, and whether it is watched.
#[derive(Debug, Args)]
pub struct DeviceArguments {
    /// Device by a part of its name.
    #[arg(long, value_name = "SUBSTRING")]
    device: Option<String>,
    /// Runs with the validation layer; any message makes the exit status 1.
    #[arg(long)]
    validate: bool,
}

impl DeviceArguments {
    /// The device that these options ask for; `None` keeps the pipeline cache in memory.
    pub fn options(&self, pipeline_cache_dir: Option<PathBuf>) -> GpuOptions {
        GpuOptions { device: self.device.clone(), validate: self.validate, pipeline_cache_dir }
    }
}

/// Fails where the validation layer has said something.
pub fn check_validation(messages: &[String]) -> Result<()> {
    match messages.first() {
        None => Ok(()),
        Some(first) => bail!("{} validation messages; the first: {first}", messages.len()),
    }
}
