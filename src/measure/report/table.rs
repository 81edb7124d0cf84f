//! A report as JSON and as CSV.

use super::feature::{Clock, Feature, Point, Report};
use super::statistics::Spread;
use serde_json::{Map, Value, json};

impl Report {
    /// One JSON object; no number in it is NaN or infinite.
    pub fn json(&self) -> Value {
        let summary = &self.summary;
        json!({
            "device": {
                "name": self.device.name, "driver": self.device.driver, "api": self.device.api,
                "is_on_processor": self.is_on_processor(),
            },
            "date": self.date, "threads": self.threads, "size": self.sizes[0], "swatch_size": self.sizes[1], "rounds": self.rounds,
            "clock": match self.clock { Clock::Device => "device", Clock::Wall => "wall" },
            "features": self.features.iter().map(feature_json).collect::<Vec<_>>(),
            "headline": {
                "fur_equal_error_speedup": summary.equal_error_speedup.map(rounded),
                "fur_layers_4x_cost": summary.layers_4x_cost.map(rounded),
                "fur_vs_one_layer": summary.vs_one_layer.map(rounded),
            },
            "notes": summary.notes,
            "furnace": self.furnace,
        })
    }

    /// One line a point.
    pub fn csv(&self) -> String {
        let mut text = String::from(
            "feature,method,knob,setting,camera,ms_median,ms_min,ms_max,ms_low,ms_high,wall_ms_median,relmse,flip,max_error,\
             pareto,at_floor\n",
        );
        for feature in &self.features {
            for point in &feature.points {
                let Spread { median, min, max, interval: [low, high] } = point.ms;
                let ms =
                    [median, min, max, low, high, point.wall_ms.median].map(|ms| rounded(ms).to_string()).join(",");
                let optional = |value: Option<f64>| value.map(|value| rounded(value).to_string()).unwrap_or_default();
                let (knob, setting) = point.knob;
                // Names hold commas.
                text += &format!(
                    "\"{}\",\"{}\",{knob},{setting},\"{}\",{ms},{},{},{},{},{}\n",
                    feature.name,
                    point.method,
                    point.camera,
                    rounded(point.relmse),
                    optional(point.flip),
                    optional(point.max_error),
                    point.is_on_front,
                    point.is_at_floor,
                );
            }
        }
        text
    }
}

fn feature_json(feature: &Feature) -> Value {
    let slopes = feature.cameras().into_iter().flat_map(|camera| {
        feature.curves(camera).into_iter().map(move |curve| {
            json!({
                "method": curve.method, "camera": camera, "error_over_ms": curve.slope_over_ms().map(rounded),
                "error_over_knob": curve.slope_over_knob().map(rounded),
            })
        })
    });
    json!({
        "name": feature.name, "reference": feature.reference, "reference_noise": rounded(feature.reference_noise),
        "points": feature.points.iter().map(point_json).collect::<Vec<_>>(),
        "slopes": slopes.collect::<Vec<_>>(), "notes": feature.notes,
    })
}

fn point_json(point: &Point) -> Value {
    let (knob, setting) = point.knob;
    json!({
        "method": point.method, "knobs": Map::from_iter([(knob.to_owned(), json!(setting))]), "camera": point.camera,
        "ms_median": rounded(point.ms.median), "ms_min": rounded(point.ms.min), "ms_max": rounded(point.ms.max),
        "ms_interval": point.ms.interval.map(rounded), "wall_ms_median": rounded(point.wall_ms.median),
        "relmse": rounded(point.relmse), "flip": point.flip.map(rounded), "max_error": point.max_error.map(rounded),
        "pareto": point.is_on_front, "classic": point.is_classic, "at_floor": point.is_at_floor,
    })
}

/// Six significant digits: more are noise.
fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}
