//! One JSON object on standard output.

use anyhow::{Context, Result};
use serde_json::Value;
use std::io::Write;

/// Prints the object and a line end; a number that is not finite never gets here, since `json!` makes it null.
pub fn print(value: &Value) -> Result<()> {
    let mut out = std::io::stdout().lock();
    writeln!(out, "{value:#}").context("standard output")
}

/// Milliseconds with three digits: more are noise.
pub fn milliseconds(value: f64) -> Value {
    ((value * 1e3).round() / 1e3).into()
}
