//! `vair profile`: the object, the table and the trace.

use crate::program::{SMALL, with_quad};
use serde_json::Value;
use std::collections::BTreeMap;
use vair::measure::profile::FamilyProfile;

const FRAMES: usize = 3;

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}

/// Milliseconds with median, smallest, largest and count.
#[track_caller]
fn is_spread(value: &Value) {
    let [median, min, max] = ["median", "min", "max"].map(|name| number(&value[name]));
    assert!(0.0 <= min && min <= median && median <= max, "{value}");
    assert_eq!(value["count"], FRAMES);
}

#[test]
fn the_object_has_times_counts_memory_and_starts() {
    let folder = with_quad();
    let mut arguments = vec!["profile", "quad.gltf", "--preset", "fox", "--json", "--validate", "--bench", "3"];
    arguments.extend(SMALL);
    let profile = folder.run(arguments).success().json();
    is_spread(&profile["ms"]["frame"]);
    is_spread(&profile["ms"]["gpu"]);
    let phases: Vec<_> = profile["ms"]["cpu"].as_object().unwrap().keys().cloned().collect();
    assert_eq!(phases, ["plan", "prepare", "record", "submit", "wait"]);
    phases.iter().for_each(|phase| is_spread(&profile["ms"]["cpu"][phase]));

    let passes = profile["passes"].as_array().unwrap();
    assert_eq!(passes.iter().map(|pass| &pass["name"]).collect::<Vec<_>>(), ["opaque", "fur", "tone mapping"]);
    for pass in passes {
        is_spread(&pass["gpu_ms"]);
        let [shaded, rasterized, covered] =
            ["fragments", "fragments_rasterized", "covered_pixels"].map(|name| number(&pass[name]));
        assert!(0.0 < covered && covered <= shaded && shaded <= rasterized, "{pass}");
        assert!((number(&pass["overdraw"]) - shaded / covered).abs() <= 5e-4, "{pass}");
        assert!(number(&pass["vertices"]) > 0.0 && number(&pass["triangles"]) > 0.0);
    }
    // Two triangles a shell; six indices.
    let shells = number(&profile["fur"][0]["layers"]);
    assert_eq!(
        [&passes[1]["instances"], &passes[1]["triangles"], &passes[1]["vertices"]].map(number),
        [shells, 2.0 * shells, 6.0 * shells]
    );
    assert_eq!(passes[2]["fragments"], 16 * 9);

    let memory = &profile["memory"];
    let sum = |name: &str| memory[name].as_object().unwrap().values().map(number).sum::<f64>();
    assert_eq!(sum("by_use"), number(&memory["device_bytes"]));
    assert_eq!(sum("by_owner"), number(&memory["device_bytes"]));
    assert!(number(&memory["by_use"]["targets"]) >= f64::from(16 * 9 * (8 + 4 + 4)));
    assert!(number(&profile["calls"]["total"]) > 0.0 && number(&profile["calls"]["uploaded_bytes"]) > 0.0);
    for start in ["cold", "warm"] {
        let [pipelines, first] = ["pipelines_ms", "first_frame_ms"].map(|name| number(&profile["start"][start][name]));
        assert!(0.0 < pipelines && pipelines < first, "{start}");
    }
    assert!(!profile["left_out"].as_array().unwrap().is_empty());
    assert_eq!(profile["validation_messages"], Value::Array(Vec::new()));
    assert_eq!(folder.names(), ["quad.gltf"]);
}

/// Start and end in whole nanoseconds.
fn interval(event: &Value) -> [i64; 2] {
    let [start, duration] = ["ts", "dur"].map(|name| (number(&event[name]) * 1e3).round() as i64);
    assert!(start >= 0 && duration >= 0, "{event}");
    [start, start + duration]
}

#[test]
fn the_trace_is_complete_in_order_and_nested() {
    let folder = with_quad();
    let mut arguments = vec!["profile", "quad.gltf", "--preset", "fox", "--bench", "3", "--trace", "trace.json"];
    arguments.extend(SMALL);
    let text = folder.run(arguments).success().text();
    assert!(text.contains("overdraw") && text.contains("\nfur "), "{text}");
    assert_eq!(folder.names(), ["quad.gltf", "trace.json"]);

    let trace: Value = serde_json::from_slice(&std::fs::read(folder.path().join("trace.json")).unwrap()).unwrap();
    let mut rows: BTreeMap<u64, Vec<&Value>> = BTreeMap::new();
    let mut counters = Vec::new();
    let mut names = Vec::new();
    for event in trace["traceEvents"].as_array().unwrap() {
        let row = event["tid"].as_u64().unwrap();
        assert!(event["pid"].is_u64() && event["name"].is_string() && event["args"].is_object(), "{event}");
        match event["ph"].as_str().unwrap() {
            "X" => rows.entry(row).or_default().push(event),
            "C" => counters.push(event),
            "M" => names.push(event["args"]["name"].as_str().unwrap()),
            other => panic!("an event of kind {other}"),
        }
    }
    assert!(names.contains(&"host") && names.len() == 3, "{names:?}");
    let [host, device] = [&rows[&1], &rows[&2]];
    assert_eq!(rows.len(), 2);

    let phases = ["frame", "plan", "prepare", "record", "submit", "wait"];
    assert_eq!(host.len(), FRAMES * phases.len());
    let mut last_end = 0;
    for frame in host.chunks(phases.len()) {
        assert_eq!(frame.iter().map(|event| event["name"].as_str().unwrap()).collect::<Vec<_>>(), phases);
        let [start, end] = interval(frame[0]);
        assert!(last_end <= start, "a frame starts before the end of the one before");
        let mut at = start;
        for phase in &frame[1..] {
            assert_eq!(interval(phase)[0], at, "{phase}");
            at = interval(phase)[1];
        }
        assert_eq!(at, end);
        last_end = end;
    }
    assert_eq!(device.len(), FRAMES * 3);
    let mut last_end = 0;
    for (event, name) in device.iter().zip(["opaque", "fur", "tone mapping"].iter().cycle()) {
        assert_eq!(event["name"], *name);
        let [start, end] = interval(event);
        assert!(last_end <= start, "{event}");
        last_end = end;
    }
    // Work starts on the device once it is submitted.
    for (passes, frame) in device.chunks(3).zip(host.chunks(phases.len())) {
        assert!(interval(passes[0])[0] >= interval(frame[4])[0]);
    }
    assert_eq!(counters.len(), 2 * FRAMES);
    assert!(counters.iter().all(|counter| number(&counter["args"]["fur"]) > 0.0));
}

#[test]
fn a_trace_that_cannot_be_written_fails_first() {
    let folder = with_quad();
    folder.fails(1, ["profile", "quad.gltf", "--trace", "nowhere/trace.json"], &["nowhere", "folder"]);
    folder.fails(2, ["profile", "quad.gltf", "--bench", "0"], &["--bench"]);
}

#[test]
fn families_stand_beside_the_standard_surface() {
    let folder = with_quad();
    for scene in [&[][..], &["quad.gltf"]] {
        let arguments = [&["profile", "--families", "--json", "--validate", "--bench", "3"], scene, &SMALL].concat();
        let profile = folder.run(arguments).success().json();
        let families = profile["families"].as_array().unwrap();
        let kinds: Vec<_> = families.iter().map(|family| family["kind"].as_str().unwrap()).collect();
        assert_eq!(kinds, FamilyProfile::kinds().collect::<Vec<_>>());
        for family in families {
            is_spread(&family["surface_ms"]);
            is_spread(&family["to_standard"]);
            assert!(number(&family["surface_ms"]["min"]) > 0.0, "{family}");
        }
        assert_eq!(families[0]["to_standard"]["median"], 1.0);
    }
    let text = folder.run(["profile", "--families", "--bench", "1", "--size", "16x9"]).success().text();
    assert!(text.contains("laser") && text.contains("to standard"), "{text}");
}
