//! Frames as a trace for chrome://tracing and Perfetto.
//!
//! Source: Duca and Sinclair 2016, "Trace Event Format": complete events ("X"), counters ("C") and names ("M"), times in
//! microseconds.

use super::{PassProfile, Profile, TimedFrame};
use crate::render::{RenderError, write_file};
use serde_json::{Value, json};
use std::path::Path;

/// Rows of the trace.
const HOST: u32 = 1;
const DEVICE: u32 = 2;

impl Profile {
    /// The timed frames as one JSON object. A row of the host holds each frame with its phases; a row of the device holds
    /// the passes, put where the frame was submitted: the two clocks have no common zero.
    pub fn trace(&self) -> Value {
        let name = |what: &str, row: u32, name: &str| json!({ "ph": "M", "pid": 1, "tid": row, "ts": 0, "name": what, "args": { "name": name } });
        let mut events = vec![
            name("process_name", HOST, "vair"),
            name("thread_name", HOST, "host"),
            name("thread_name", DEVICE, &self.device.name),
        ];
        for (index, frame) in self.frames.iter().enumerate() {
            self.add_frame(&mut events, index, frame);
        }
        json!({ "displayTimeUnit": "ms", "traceEvents": events })
    }

    /// Writes the trace whole or not at all.
    ///
    /// # Errors
    /// [`RenderError::Write`].
    pub fn write_trace(&self, path: &Path) -> Result<(), RenderError> {
        write_file(path, self.trace().to_string().as_bytes())
    }

    fn add_frame(&self, events: &mut Vec<Value>, index: usize, frame: &TimedFrame) {
        let report = &frame.report;
        let mut phases = Vec::new();
        let (mut at_ms, mut submitted_ms) = (frame.start_ms, frame.start_ms);
        for (phase, ms) in report.cpu.named() {
            if phase == "submit" {
                submitted_ms = at_ms;
            }
            phases.push(complete(HOST, phase, [at_ms, at_ms + ms], json!({})));
            at_ms += ms;
        }
        events.push(complete(HOST, "frame", [frame.start_ms, at_ms], json!({ "number": index })));
        events.append(&mut phases);

        let mut end_ms = submitted_ms;
        for pass in &report.passes {
            let (Some(start_ms), Some(ms)) = (pass.gpu_start_ms, pass.gpu_ms) else { continue };
            // Rounded sums must not make one pass start before the end of the one before.
            let start_ms = end_ms.max(submitted_ms + start_ms);
            end_ms = start_ms + ms;
            let counts = json!({ "draws": pass.draws, "instances": pass.instances, "triangles": pass.triangles });
            events.push(complete(DEVICE, &pass.name, [start_ms, end_ms], counts));
        }
        events.push(counter("draws", frame.start_ms, self.each_pass(|pass| Some(pass.draws.into()))));
        // All frames of a profile show the same, so that one count serves them.
        let shaded = self.each_pass(|pass| pass.fragments.map(|fragments| fragments.shaded));
        events.push(counter("shaded fragments", frame.start_ms, shaded));
    }

    fn each_pass(&self, value: fn(&PassProfile) -> Option<u64>) -> Value {
        self.passes.iter().filter_map(|pass| Some((pass.name.clone(), Value::from(value(pass)?)))).collect()
    }
}

/// Whole nanoseconds, so that what ends together does so in the file, too.
fn nanoseconds(ms: f64) -> f64 {
    (ms * 1e6).round()
}

fn complete(row: u32, name: &str, [start_ms, end_ms]: [f64; 2], arguments: Value) -> Value {
    let (start, end) = (nanoseconds(start_ms), nanoseconds(end_ms));
    let (start_us, duration_us) = (start / 1e3, (end - start) / 1e3);
    json!({ "ph": "X", "pid": 1, "tid": row, "name": name, "ts": start_us, "dur": duration_us, "args": arguments })
}

fn counter(name: &str, at_ms: f64, values: Value) -> Value {
    json!({ "ph": "C", "pid": 1, "tid": HOST, "name": name, "ts": nanoseconds(at_ms) / 1e3, "args": values })
}
