//! What is printed, what the commands' JSON has in common, and the check that a file can be written before it is made.

use anyhow::{Context, Result, bail};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde_json::{Value, json};
use std::io::{ErrorKind, IsTerminal, Write};
use std::path::Path;
use vair::gpu::DeviceInfo;
use vair::render::{FurReport, Skipped};

/// Prints to standard output. A closed pipe is the reader's choice, not a failure.
pub fn print(text: &str) -> Result<()> {
    print_bytes(harmless(text).as_bytes())
}

/// Prints bytes, such as a picture.
pub fn print_bytes(bytes: &[u8]) -> Result<()> {
    let mut out = std::io::stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error).context("standard output"),
        _ => Ok(()),
    }
}

/// Prints the one JSON object. A number that is not finite never gets here: `json!` makes it null.
pub fn print_json(value: &Value) -> Result<()> {
    print_bytes(format!("{value:#}\n").as_bytes())
}

/// Text for a terminal: names come from files, and a control character in one could command the terminal.
fn harmless(text: &str) -> String {
    let show = |c: char| if c.is_control() && c != '\n' { c.escape_default().to_string() } else { c.to_string() };
    text.chars().map(show).collect()
}

/// Prints one line on standard error, whatever the message holds; nobody may be listening there either.
pub fn complain(message: &str) {
    let line = harmless(&message.split_whitespace().collect::<Vec<_>>().join(" "));
    let _ = writeln!(std::io::stderr(), "vair: {line}");
}

/// Milliseconds with three digits: more are noise.
pub fn milliseconds(value: f64) -> Value {
    ((value * 1e3).round() / 1e3).into()
}

/// Fails when a file of that name could not be written, so that nobody waits for a picture in vain.
pub fn check_writable(path: &Path, example: &str) -> Result<()> {
    if path.is_dir() {
        bail!("{}: is a folder; name a file in it, such as {}", path.display(), path.join(example).display());
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        bail!("{}: there is no folder {}; make it or choose another", path.display(), folder.display());
    }
    tempfile::NamedTempFile::new_in(folder).map(drop).map_err(|error| {
        // The temporary file's own name, which the error holds, would only confuse.
        let reason = error.kind();
        anyhow::anyhow!("{}: {reason}; choose a folder that can be written", path.display())
    })
}

/// A bar on standard error, where that is a terminal and the bar `is_wanted`.
pub fn progress(is_wanted: bool, template: &str) -> ProgressBar {
    if !is_wanted || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(1), ProgressDrawTarget::stderr());
    match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// A device in JSON.
pub fn device(info: &DeviceInfo) -> Value {
    json!({ "name": info.name, "driver": info.driver, "api": info.api })
}

/// Fur in JSON.
pub fn fur(reports: &[FurReport]) -> Value {
    let one = |fur: &FurReport| {
        json!({
            "material": fur.material, "layers": fur.layers, "instances": fur.instances,
            "vertices_stored": fur.vertices_stored,
        })
    };
    reports.iter().map(one).collect()
}

/// What a frame does without, in JSON.
pub fn left_out(list: &[Skipped]) -> Value {
    list.iter().map(|left| json!({ "what": left.what, "why": left.why })).collect()
}
