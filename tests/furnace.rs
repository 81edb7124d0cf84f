//! No material gives more light than it gets; what older formulas give is known and pinned.

use std::f64::consts::SQRT_2;
use vair::material::KINDS;
use vair::measure::furnace::{self, Input, PropertyCheck, checks};
use vair::measure::twin::classic::{fur, gauze, satin};

#[test]
fn ours_keep_every_promise_and_classic_ones_decide_nothing() {
    let properties = furnace::run(100);
    for (material, _) in KINDS {
        assert!(properties.iter().filter(|property| property.material == *material && !property.classic).count() >= 5);
    }
    for property in &properties {
        assert!(!property.fails(), "{property}");
        assert!(property.samples >= 1 && property.nonfinite == 0, "{property}");
        let json = serde_json::to_value(property).unwrap();
        assert!(json["worst"].is_number() && json["at"].is_object(), "{json}");
    }
    for material in ["gauze", "laser", "satin", "cotton", "velvet", "fur", "thin hair"] {
        assert!(properties.iter().any(|property| property.classic && property.material == material && !property.pass));
    }
}

fn broken_where(bad: fn(f64) -> bool) -> PropertyCheck {
    PropertyCheck {
        material: "planted",
        property: "stays below 1",
        classic: false,
        limit: Some(1.0),
        inputs: vec![Input::between("nothing", (0.0, 1.0)), Input::between("x", (-1.0, 1.0))],
        value: Box::new(move |x: &[f64]| if bad(x[1]) { 2.0 } else { 0.5 }),
    }
}

#[test]
fn planted_faults_are_found() {
    assert!(broken_where(|_| false).judge(1000).pass);
    let corner = broken_where(|x| x == 1.0).judge(0);
    assert!(corner.fails() && corner.at == [("nothing", 0.0), ("x", 1.0)], "{corner}");
    // A hundredth of the range, between the corners.
    let between = broken_where(|x| (0.31..0.33).contains(&x)).judge(1000);
    assert!(between.fails() && (0.31..0.33).contains(&between.at[1].1), "{between}");
    let mut nan = broken_where(|_| false);
    nan.value = Box::new(|x| if x[1] == 0.0 { f64::NAN } else { 0.5 });
    let nan = nan.judge(0);
    assert!(nan.fails() && nan.nonfinite == 3 && nan.worst == 0.5, "{nan}");
    let mut classic = broken_where(|_| true);
    classic.classic = true;
    let classic = classic.judge(0);
    assert!(!classic.pass && !classic.fails() && classic.to_string().starts_with("classic"), "{classic}");
}

/// Cosine to an eye that is nearly in the surface.
const GRAZING: f64 = 1e-4;
/// Strength of the force at which a strand that is pushed straight down is shortest.
const SHORTEST: f64 = SQRT_2 / 4.0;

/// One value of a classic check beside the figure that is known of it.
struct Pin(&'static str, &'static str, &'static [f64], f64, f64);

#[test]
fn classic_defects_are_those_that_are_known() {
    const ALBEDO: &str = "directional albedo";
    const NORMALS: &str = "integral of the normals, off 1 by";
    // The tolerance is half a unit of the last digit of the figure; an integral is settled to far less.
    let pins = [
        Pin("laser", "turns of hue from a pixel to the next", &[5.0, 100.0], 0.5, 5e-3),
        // The printed one is 0 where the sine is 1.
        Pin("laser", "printed sine, short of the sine by", &[1e-3], 1.0, 2e-3),
        Pin("satin", ALBEDO, &[30.0, 1.0, 0.0, 1.0, 0.02, 0.0], 27.6, 0.05),
        Pin("satin", "directional albedo, two ways", &[30.0, 1.0, 0.0, 1.0, 0.02, 0.0], 55.0, 0.5),
        Pin("satin", ALBEDO, &[30.0, 1.0, 0.0, 0.04, 0.02, 0.0], 2.2, 0.05),
        Pin("satin", ALBEDO, &[20.0, 0.5, 0.8, 1.0, 0.05, 0.0], 0.43, 5e-3),
        // ax ay = 6.25e-2 and 1.19e-2.
        Pin("satin", NORMALS, &[0.5, 0.0], 1.0 - 6.25e-2, 5e-5),
        Pin("satin", NORMALS, &[0.5, 0.9], 1.0 - 1.19e-2, 5e-5),
        Pin("satin", "red and green under blue light", &[1.0, 0.0], 0.036, 5e-4),
        Pin("cotton", "directional albedo, fuzz alone", &[0.1, GRAZING], 1.35, 5e-3),
        Pin("cotton", "directional albedo, fuzz alone", &[0.05, GRAZING], 1.85, 5e-3),
        Pin("cotton", "directional albedo, fuzz alone", &[0.005, GRAZING], 5.6, 0.05),
        Pin("cotton", ALBEDO, &[1.0, 1.0, 1.0, 0.05, GRAZING], 1.85, 5e-3),
        // In the limit of GRAZING, 1 / (2 alpha) times the integral of D over all lights, 2.77796.
        Pin("velvet", ALBEDO, &[0.0, 1.0, 0.1, 0.0, 0.0, 1e-7], 138.9, 0.05),
        Pin("velvet", ALBEDO, &[0.0, 1.0, 0.5, 0.0, 0.0, GRAZING], 5.5, 0.05),
        Pin("velvet", ALBEDO, &[0.0, 1.0, 1.0, 0.0, 0.0, GRAZING], 1.39, 5e-3),
        Pin("velvet", ALBEDO, &[0.96, 0.04, 1.0, 1.0, 0.0, GRAZING], 2.57, 5e-3),
        Pin("velvet", NORMALS, &[], 1.0 - 0.6817, 5e-5),
        Pin("velvet", "radiance with lights off", &[0.0, 0.0, 1.0, 1.0, 0.0, GRAZING, 0.0, 0.0], 0.5, 5e-3),
        Pin("thin hair", "light scattered, diffuse", &[], 9.87, 5e-3),
        Pin("thin hair", "light scattered, highlight", &[1.0, 0.0], 8.4, 0.05),
        Pin("thin hair", "light scattered, highlight", &[128.0, 0.0], 1.38, 5e-3),
        Pin("thin hair", "light scattered, highlight", &[1000.0, 0.0], 0.50, 5e-3),
        Pin("fur", "coverage of a column outside 0 to 1, by", &[0.0, 1.0], 138.0, 0.5),
        Pin("fur", "tip under the skin, in lengths", &[1.0, 180.0], 1.0, 1e-12),
        // A strand pushed straight down turns back at height 1 / (8 s): its length 1 / (4 s) - 1 + 2 s is least, sqrt(2) - 1,
        // at s = sqrt(2) / 4;
        // 256 chords cut the turn by less than one of their lengths.
        Pin("fur", "length of a strand, off 1 by", &[SHORTEST, 180.0], 2.0 - SQRT_2, 1.0 / 256.0),
        Pin("fur", "length of a strand, off 1 by", &[1.0, 145.0], 0.26, 5e-3),
    ];
    let checks = checks();
    for Pin(material, property, inputs, known, tolerance) in pins {
        let check = checks
            .iter()
            .find(|check| check.classic && (check.material, check.property) == (material, property))
            .unwrap_or_else(|| panic!("{material}: {property}"));
        assert_eq!(check.inputs.len(), inputs.len(), "{material}: {property}");
        let found = (check.value)(inputs);
        assert!((found - known).abs() <= tolerance, "{material}: {property} at {inputs:?}: {found} for {known}");
    }
}

#[test]
fn classic_shells_leave_the_range_of_opacity() {
    for (height, cosine_to_eye, edge_fade, known) in
        [(0.05, 1.0, 0.0, 1.9975), (0.95, 0.0, 1.0, -0.9025), (0.95, -1.0, 1.0, -1.9025)]
    {
        assert!((fur::opacity(height, cosine_to_eye, edge_fade) - known).abs() < 1e-12);
    }
}

#[test]
fn classic_gauze_is_a_rim() {
    assert_eq!(gauze::opacity(200.0, 1.0), 0.0);
    let half = gauze::half_opacity_cosine(200.0);
    assert!((half.acos().to_degrees() - 85.2).abs() < 0.05 && (gauze::opacity(200.0, half) - 0.5).abs() < 1e-12);
    for (density, known) in [(1.0, 0.451), (10.0, 0.221), (200.0, 0.056), (1000.0, 0.025)] {
        assert!((1.0 - gauze::facing_transmittance_of_a_weave(density) - known).abs() < 5e-4);
    }
}

#[test]
fn classic_satin_vanishes_or_divides_by_zero_at_full_anisotropy() {
    let (ax, ay) = satin::widths(0.5, 1.0);
    assert_eq!(ay, 0.0);
    assert!(satin::ndf(glam::DVec3::Z, ax, ay).is_nan(), "0 / 0 in the mirror direction");
}
