//! Promise: every function of the shader library is judged by its twin on the device, and a fault on either side shows.
//!
//! Needs a Vulkan device and the validation layer; without them these tests fail and say what to install.
#![cfg(feature = "measure")]

use std::collections::HashSet;
use vair::gpu::{Gpu, GpuOptions};
use vair::measure::twin::{Domain, Limit, Rule, TestInputs, Twin, twins};
use vair::measure::verify::{self, VerifyError};
use vair::shader::function;

/// Seeded inputs a function; the grids of extremes are whole.
const SAMPLES: u32 = 1 << 13;

/// Lends a device and fails when the validation layer says anything.
#[track_caller]
fn on_device(check: impl FnOnce(&Gpu)) {
    let gpu = Gpu::new(&GpuOptions { validate: true, ..GpuOptions::default() })
        .unwrap_or_else(|error| panic!("{error}; tools/setup installs what the tests need"));
    let log = gpu.validation_log();
    check(&gpu);
    drop(gpu);
    assert_eq!(log.messages(), Vec::<String>::new());
}

fn twin(name: &str) -> Twin {
    *twins().find(|twin| twin.name == name).unwrap()
}

#[test]
fn every_function_agrees_with_its_twin() {
    on_device(|gpu| {
        let report = verify::run_with(gpu, None, SAMPLES).unwrap();
        let failed: Vec<_> = report.functions.iter().filter(|function| !function.pass).collect();
        assert!(failed.is_empty() && report.pass(), "{failed:#?}");
        assert_eq!(report.functions.len(), function::ALL.len());
        for function in &report.functions {
            assert_eq!((function.seeded, function.nonfinite), (SAMPLES as usize, 0), "{}", function.name);
            assert!(function.samples > function.seeded, "{} sees no extremes", function.name);
            assert!(function.p999_rel <= function.max_rel && function.max_rel_seeded <= function.max_rel);
            assert!(function.of_limit <= 1.0 || function.missed > 0, "{}: {:e}", function.name, function.of_limit);
        }
    });
}

#[test]
fn every_function_of_the_library_has_one_twin() {
    assert!(verify::unpaired().is_empty(), "{:?}", verify::unpaired());
    let names: HashSet<_> = twins().map(|twin| twin.name).collect();
    assert_eq!(names.len(), twins().count(), "a function has two twins");
    // Counted without the reader that made the list: bodies end with a line that is a brace alone.
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders_glsl/lib");
    let bodies = std::fs::read_dir(folder).unwrap().map(|entry| {
        let text = std::fs::read_to_string(entry.unwrap().path()).unwrap();
        text.lines().filter(|line| *line == "}").count()
    });
    assert_eq!(bodies.sum::<usize>(), function::ALL.len());
}

#[test]
fn planted_faults_fail() {
    on_device(|gpu| {
        let check = |twin: Twin| verify::check(gpu, &twin, 1024).unwrap();
        assert!(check(twin("luminance")).pass);
        let off = check(Twin { value: |inputs| vec![inputs.number() * inputs.number() + 1e-4], ..twin("ggx_alpha") });
        assert!(!off.pass && off.missed > 0 && off.max_rel > off.limit.rel, "{off:?}");
        let exact = check(Twin { limit: Limit::EXACT, ..twin("srgb_from_linear") });
        assert!(!exact.pass && exact.of_limit > 1.0 && exact.nonfinite == 0, "{exact:?}");
        let endless = check(Twin { domains: &[Domain::Uniform(0.0, 1.0, &[f32::INFINITY])], ..twin("luminance") });
        assert!(!endless.pass && endless.nonfinite > 0, "{endless:?}");
        assert!(endless.worst.unwrap().inputs[0].1.contains(&f64::INFINITY));
        let silent = check(Twin { value: |_| vec![f64::NAN], missed: 0.5, ..twin("luminance") });
        assert!(!silent.pass, "a twin that answers nothing proves nothing");
        let short = check(Twin { value: |_| Vec::new(), ..twin("luminance") });
        assert!(!short.pass, "{short:?}");
    });
}

#[test]
fn a_rule_forgives_rounding_and_nothing_else() {
    on_device(|gpu| {
        let check = |twin: Twin| verify::check(gpu, &twin, SAMPLES).unwrap();
        // A sum may fall on the other side of a step; a count too few is a fault all the same.
        let fault = Twin {
            value: |inputs| {
                let value = (twin_of_masks())(inputs);
                vec![if value[0] == 15.0 { 11.0 } else { value[0] }]
            },
            ..twin("coverage_mask")
        };
        assert!(check(twin("coverage_mask")).pass && !check(fault).pass);
        // The edge of a spot's cone stretches the rounding of a cosine: the plain limit does not know it.
        assert!(check(twin("light_sample")).by_rule > 0);
        assert!(!check(Twin { rule: Rule::Plain, ..twin("light_sample") }).pass);
    });
}

fn twin_of_masks() -> fn(&mut TestInputs<'_>) -> Vec<f64> {
    twin("coverage_mask").value
}

#[test]
fn the_same_inputs_every_time() {
    on_device(|gpu| {
        let once = || verify::check(gpu, &twin("fibre_scattering"), SAMPLES).unwrap();
        assert_eq!(once(), once());
    });
}

#[test]
fn what_cannot_be_judged_is_an_error() {
    on_device(|gpu| {
        let error = verify::run_with(gpu, Some("schlik"), 1).unwrap_err().to_string();
        assert_eq!(error, "no shader function is called 'schlik'; did you mean 'schlick'?; --list names them");
        let report = verify::run_with(gpu, Some("schlick"), 64).unwrap();
        assert_eq!(report.functions.iter().map(|function| function.name).collect::<Vec<_>>(), ["schlick"]);
        assert!(verify::run_with(gpu, Some("strand_"), 64).unwrap().functions.len() > 1);
        let check = |twin: Twin| verify::check(gpu, &twin, 64).unwrap_err();
        let unknown = check(Twin { name: "nothing", ..twin("luminance") });
        assert!(matches!(unknown, VerifyError::NoFunction { .. }), "{unknown}");
        for domains in [&[][..], &[Domain::Bits], &[Domain::Direction, Domain::Direction]] {
            let wrong = check(Twin { domains, ..twin("luminance") });
            assert!(matches!(wrong, VerifyError::Domains { .. }), "{wrong}");
        }
        assert!(matches!(
            check(Twin { domains: &[Domain::Direction], ..twin("ggx_alpha") }),
            VerifyError::Domains { .. }
        ));
    });
}
