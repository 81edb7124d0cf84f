//! `vair report`: metrics on pictures whose error is known, statistics on data whose answer is known, and a tiny run from
//! end to end.
#![cfg(feature = "measure")]

use glam::{DVec3, DVec4};
use serde_json::Value;
use std::fs;
use std::path::Path;
use vair::gpu::{Gpu, GpuOptions};
use vair::measure::report::metric::{Radiance, change_error, noise, picture_error};
use vair::measure::report::statistics::{Spread, log_log_slope, pareto_front};
use vair::measure::report::{self, Effort, Method, Report, ReportError, Sweep, View};

const SIZE: [u32; 2] = [16, 16];

/// Every pixel covered, of one radiance.
fn even(radiance: f64) -> Radiance {
    let pixel = DVec3::splat(radiance).extend(1.0);
    Radiance { size: SIZE, pixels: vec![pixel; (SIZE[0] * SIZE[1]) as usize] }
}

#[test]
fn equal_pictures_have_no_error() {
    let error = picture_error(&even(0.4), &even(0.4), DVec3::ZERO);
    assert_eq!((error.relmse, error.flip), (0.0, 0.0));
}

#[test]
fn relmse_is_its_formula_over_covered_pixels_alone() {
    let (mut picture, mut reference) = (even(0.5), even(0.4));
    // What neither covers does not count; what one covers does.
    (picture.pixels[0], reference.pixels[0]) = (DVec4::ZERO, DVec4::ZERO);
    picture.pixels[1] = DVec4::ZERO;
    let error = picture_error(&picture, &reference, DVec3::ZERO);
    let (off, missing) = (0.01 / (0.16 + 0.01), 0.16 / (0.16 + 0.01));
    let expected = (254.0 * off + missing) / 255.0;
    assert!((error.relmse - expected).abs() < 1e-12, "{} instead of {expected}", error.relmse);
    assert!(error.flip > 0.0 && error.flip < 1.0);
}

#[test]
fn noise_counts_over_covered_pixels_alone() {
    let mut reference = even(0.4);
    reference.pixels[..128].fill(DVec4::ZERO);
    let variance = [vec![DVec3::ZERO; 128], vec![DVec3::splat(0.034); 128]].concat();
    assert!((noise(&reference, &variance) - 0.2).abs() < 1e-12);
}

#[test]
fn flip_grows_with_the_difference() {
    let flip = |radiance| picture_error(&even(radiance), &even(0.1), DVec3::ZERO).flip;
    assert!(flip(0.12) > 0.0 && flip(0.2) > 2.0 * flip(0.12));
}

#[test]
fn what_stands_behind_is_seen_through_gaps() {
    let nothing = Radiance { size: SIZE, pixels: vec![DVec4::ZERO; 256] };
    let flip = |background| picture_error(&nothing, &even(0.3), DVec3::splat(background)).flip;
    assert!(flip(0.3) < 1e-6 && flip(0.0) > 0.1);
}

#[test]
fn a_steady_error_does_not_shimmer() {
    // Wrong by the same in both frames: the change is right.
    let error = change_error([&even(0.5), &even(0.7)], [&even(0.4), &even(0.6)], DVec3::ZERO);
    assert!(error.relmse < 1e-20, "{}", error.relmse);
    let error = change_error([&even(0.4), &even(0.4)], [&even(0.4), &even(0.6)], DVec3::ZERO);
    assert!((error.relmse - 0.04 / 0.17).abs() < 1e-12, "{}", error.relmse);
    assert!(error.flip > 0.0);
}

#[test]
fn slopes_of_powers_are_their_exponents() {
    let power = |exponent: f64| -> Vec<[f64; 2]> {
        (1..6).map(|i| [f64::from(i), 3.0 * f64::from(i).powf(exponent)]).collect()
    };
    for exponent in [-2.0, -0.5, 1.0] {
        assert!((log_log_slope(&power(exponent)).unwrap() - exponent).abs() < 1e-12);
    }
    // Two points fit any line; zeros have no logarithm; a standing x has no slope.
    assert_eq!(log_log_slope(&power(-1.0)[..2]), None);
    assert_eq!(log_log_slope(&[[1.0, 1.0], [2.0, 0.5], [4.0, 0.0]]), None);
    assert_eq!(log_log_slope(&[[1.0, 1.0], [1.0, 2.0], [1.0, 3.0]]), None);
}

#[test]
fn the_front_holds_what_nothing_beats() {
    let points = [[1.0, 5.0], [2.0, 3.0], [3.0, 3.0], [4.0, 1.0], [5.0, 2.0], [1.0, 5.0]];
    assert_eq!(pareto_front(&points), [true, true, false, true, false, true]);
    assert!(pareto_front(&[]).is_empty());
}

#[test]
fn intervals_hold_the_median_and_narrow_with_more_values() {
    let noisy = |count: u32| -> Spread {
        Spread::of(
            &(0..count).map(|i| 10.0 + f64::from(i.wrapping_mul(2_654_435_761) >> 16) / 65_536.0).collect::<Vec<_>>(),
        )
    };
    let width = |spread: &Spread| spread.interval[1] - spread.interval[0];
    let (few, many) = (noisy(9), noisy(400));
    for spread in [few, many] {
        assert!(spread.min <= spread.interval[0] && spread.interval[0] <= spread.median);
        assert!(spread.median <= spread.interval[1] && spread.interval[1] <= spread.max);
    }
    // Of 400 even values the median's deviation is 1 / (2 sqrt(400)) = 0.025: the interval is four of these wide.
    assert!(width(&few) > 2.0 * width(&many), "{few:?} {many:?}");
    assert!((width(&many) - 0.1).abs() < 0.05, "{many:?}");
    assert_eq!(Spread::of(&[3.0]), Spread { median: 3.0, min: 3.0, max: 3.0, interval: [3.0, 3.0] });
    assert_eq!(Spread::of(&[4.0, 1.0, 3.0, 2.0]).median, 2.5);
}

fn tiny_report() -> Report {
    let effort = Effort {
        size: [64, 36],
        swatch_size: [32, 18],
        layers: vec![2, 4, 6],
        layers_of_others: vec![3, 5],
        reference_samples: 2,
        rounds: 3,
        time_limit: None,
        furnace_points: 1,
    };
    let sweep = Sweep {
        name: "fur layers",
        methods: vec![Method::ours(), Method::classic_draws()],
        layers: effort.layers.clone(),
        layers_of_others: effort.layers_of_others.clone(),
        views: vec![View::Gallery, View::Moving],
    };
    let gpu = Gpu::new(&GpuOptions { validate: true, ..GpuOptions::default() }).unwrap();
    let mut stages = Vec::new();
    let report = report::measure(&gpu, &[sweep], &effort, &mut |stage, done, count| {
        assert!(done < count);
        if stages.last() != Some(&stage) {
            stages.push(stage);
        }
    })
    .unwrap();
    assert_eq!(stages, ["references", "errors", "times", "furnace", "environment", "transparency", "shadow"]);
    let messages = gpu.validation_log().messages();
    assert!(messages.is_empty(), "{messages:?}");
    report
}

/// Whatever way blends, the compositor in double precision is the judge; per pixel it finds the picture's own sampling
/// alone.
fn check_transparency(report: &Report) {
    let feature = report.features.iter().find(|feature| feature.name == "transparency").unwrap();
    let relmse = |method: &str, camera: &str, samples: u32| {
        let mut of_method = feature.points.iter().filter(|point| point.method.starts_with(method));
        of_method.find(|point| point.camera == camera && point.knob.1 == samples).unwrap().relmse
    };
    for samples in [1, 4] {
        let of_method = |method| relmse(method, "crossed sheets", samples);
        let [ours, weighted, sorted] = ["per pixel", "weighted", "sorted"].map(of_method);
        assert!(ours < weighted && ours < sorted, "{samples} samples: {ours} {weighted} {sorted}");
    }
}

#[test]
fn a_tiny_run_writes_every_file() {
    let parent = tempfile::tempdir().unwrap();
    let folder = parent.path().join("report");
    let report = tiny_report();
    check_transparency(&report);
    report::save(&report, &folder).unwrap();
    // An earlier report gives way.
    report::save(&report, &folder).unwrap();
    assert_eq!(fs::read_dir(parent.path()).unwrap().count(), 1, "something is left beside the report");

    check_json(&serde_json::from_str(&read(&folder, "report.json")).unwrap());
    let csv = read(&folder, "report.csv");
    let points: usize = report.features.iter().map(|feature| feature.points.len()).sum();
    assert_eq!(csv.lines().count(), 1 + points);
    let columns = |line: &str| line.replace(", ", "").matches(',').count();
    assert!(csv.lines().all(|line| columns(line) == columns(&csv[..csv.find('\n').unwrap()])), "{csv}");

    let page = read(&folder, "index.html");
    let mut plots = 0;
    for entry in fs::read_dir(folder.join("plots")).unwrap() {
        let svg = fs::read_to_string(entry.unwrap().path()).unwrap();
        assert!(svg.starts_with("<svg") && svg.contains("<polyline") && svg.contains("relMSE"));
        assert!(page.contains(&svg), "a plot is not on the page");
        plots += 1;
    }
    assert_eq!(plots, 10, "two cameras, two strands, the studio, its table, three scenes of what blends, shadows");
    assert!(page.contains(&report.device.name) && page.contains(&report.date));
    assert_eq!(page.contains("processor times"), report.is_on_processor());
    for outside in ["src=", "href=", "url(", "@import"] {
        assert!(!page.contains(outside), "{outside} points out of the page");
    }
    assert!(!page.contains("NaN") && !csv.contains("NaN") && !csv.contains("inf"));
}

fn read(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap()
}

fn check_json(json: &Value) {
    let features = json["features"].as_array().unwrap();
    let names: Vec<&str> = features.iter().filter_map(|feature| feature["name"].as_str()).collect();
    assert_eq!(names, ["fur layers", "dynamics", "environment", "transparency", "shadow"]);
    assert!(json["device"]["name"].is_string());
    for feature in features {
        assert!(feature["reference"].is_string() && feature["reference_noise"].is_f64(), "{feature}");
        let points = feature["points"].as_array().unwrap();
        assert!(points.iter().any(|point| point["pareto"] == true));
        for point in points {
            assert!(point["method"].is_string() && point["camera"].is_string() && point["pareto"].is_boolean());
            assert!(point["knobs"].as_object().is_some_and(|knobs| !knobs.is_empty()));
            let ms = ["ms_min", "ms_median", "ms_max"].map(|key| point[key].as_f64().unwrap());
            assert!(ms[0] > 0.0 && ms[0] <= ms[1] && ms[1] <= ms[2], "{point}");
            assert!(point["relmse"].as_f64().unwrap() > 0.0, "{point}");
            // Strands and tables are no pictures.
            let is_picture = feature["name"] != "dynamics" && point["camera"] != "lobes of GGX";
            assert_eq!(point["flip"].is_f64(), is_picture, "{point}");
        }
    }
    assert_eq!(features[0]["points"].as_array().unwrap().len(), 2 * (3 + 3), "classic methods have 20 layers, too");
    let furnace = json["furnace"].as_array().unwrap();
    assert!(
        furnace.iter().any(|property| property["classic"] == true && property["pass"] == false),
        "satin gains light"
    );
    assert!(furnace.iter().all(|property| property["classic"] == true || property["pass"] == true));
    // 8, 32 and the fur's own layers are measured for the summary whatever the sweeps ask for.
    let summary = json["headline"].as_object().unwrap();
    let keys: Vec<&str> = summary.keys().map(String::as_str).collect();
    assert_eq!(keys, ["fur_equal_error_speedup", "fur_layers_4x_cost", "fur_vs_one_layer"]);
    assert!(summary["fur_layers_4x_cost"].as_f64().unwrap() > 1.0, "{summary:?}");
    assert!(summary["fur_vs_one_layer"].as_f64().unwrap() > 0.0, "{summary:?}");
}

#[test]
fn a_folder_with_other_things_is_left_alone() {
    let parent = tempfile::tempdir().unwrap();
    let foreign = |folder: &Path| matches!(report::check_folder(folder), Err(ReportError::Foreign { .. }));
    assert!(report::check_folder(&parent.path().join("new")).is_ok());
    assert!(report::check_folder(parent.path()).is_ok());
    fs::write(parent.path().join("index.html"), "someone's page").unwrap();
    assert!(foreign(parent.path()), "a page alone is no report");
    fs::write(parent.path().join("report.json"), "{}").unwrap();
    assert!(report::check_folder(parent.path()).is_ok());
    fs::write(parent.path().join("thesis.tex"), "").unwrap();
    assert!(foreign(parent.path()));
    assert!(matches!(report::check_folder(&parent.path().join("thesis.tex/report")), Err(ReportError::Write { .. })));
    assert!(matches!(report::check_folder(&parent.path().join("a/b")), Err(ReportError::Write { .. })));
}
