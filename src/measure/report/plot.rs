//! Plots of error over time, one a feature and camera, as SVG.

use super::ReportError;
use super::curve::Curve;
use super::feature::{Clock, Feature, Point, Report};
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::prelude::*;
use std::ops::Range;

/// Width of a plot and height without its legend, SVG units.
const SIZE: (u32, u32) = (720, 420);
/// Height of a line of the legend, SVG units.
const LEGEND_LINE: u32 = 20;
/// Okabe & Ito 2008, "Color Universal Design": told apart by colour-blind eyes, on white and on black.
const COLORS: [RGBColor; 4] =
    [RGBColor(0, 114, 178), RGBColor(213, 94, 0), RGBColor(0, 158, 115), RGBColor(204, 121, 167)];
/// What others do.
const GREYS: [RGBColor; 3] = [RGBColor(120, 120, 120), RGBColor(160, 160, 160), RGBColor(90, 90, 90)];

/// One plot.
#[derive(Debug, Clone)]
pub struct Plot {
    /// Name of its file, without ending.
    pub stem: String,
    /// Name of its feature.
    pub feature: &'static str,
    /// Camera.
    pub camera: &'static str,
    /// The picture.
    pub svg: String,
}

impl Report {
    /// Every feature before every camera.
    pub(super) fn plots(&self) -> Result<Vec<Plot>, ReportError> {
        let mut plots = Vec::new();
        for feature in &self.features {
            for camera in feature.cameras() {
                let stem = format!("{} {camera}", feature.name).replace(' ', "-");
                let mut svg = String::new();
                draw(&mut svg, feature, camera, self.clock)
                    .map_err(|problem| ReportError::Plot { plot: stem.clone(), problem })?;
                plots.push(Plot { stem, feature: feature.name, camera, svg });
            }
        }
        Ok(plots)
    }
}

fn draw(svg: &mut String, feature: &Feature, camera: &str, clock: Clock) -> Result<(), String> {
    let say = |error: &dyn std::fmt::Display| error.to_string();
    let curves = feature.curves(camera);
    let height = SIZE.1 + LEGEND_LINE * (curves.len() as u32 + 1);
    let root = SVGBackend::with_string(svg, (SIZE.0, height)).into_drawing_area();
    root.fill(&WHITE).map_err(|error| say(&error))?;
    // Below the plot: over it the legend would hide points.
    let (upper, lower) = root.split_vertically(SIZE.1);
    // An error of 0 has no place on a log axis.
    let points = || curves.iter().flat_map(|curve| &curve.points).filter(|point| is_shown(point));
    let times = LogAxis::around(points().flat_map(|point| point.ms.interval));
    let errors = LogAxis::around(points().map(|point| point.relmse));
    let mut chart = ChartBuilder::on(&upper)
        .caption(format!("{}: {camera}", feature.name), ("sans-serif", 20))
        .margin(12)
        .x_label_area_size(46)
        .y_label_area_size(76)
        .build_cartesian_2d(times, errors)
        .map_err(|error| say(&error))?;
    let clock = match clock {
        _ if feature.name == "dynamics" => "ms of one host thread",
        Clock::Device => "ms (device timestamps: opaque + fur)",
        Clock::Wall => "ms (wall clock, whole frame)",
    };
    chart
        .configure_mesh()
        .x_desc(clock)
        .y_desc("relMSE")
        .label_style(("sans-serif", 14))
        .light_line_style(TRANSPARENT)
        .draw()
        .map_err(|error| say(&error))?;

    let mut own = COLORS.iter().cycle();
    let mut grey = GREYS.iter().cycle();
    for (line, curve) in (0..).zip(&curves) {
        let Some(&color) = (if curve.is_classic { grey.next() } else { own.next() }) else { continue };
        let shown: Vec<&Point> = curve.points.iter().copied().filter(|point| is_shown(point)).collect();
        let at = |point: &Point| (point.ms.median, point.relmse);
        chart
            .draw_series(LineSeries::new(shown.iter().map(|point| at(point)), color.stroke_width(2)))
            .map_err(|error| say(&error))?;
        let y = (LEGEND_LINE * line + LEGEND_LINE / 2) as i32;
        lower
            .draw(&PathElement::new([(90, y), (118, y)], color.stroke_width(3)))
            .and_then(|()| lower.draw(&Text::new(legend(curve), (128, y - 6), ("sans-serif", 14))))
            .map_err(|error| say(&error))?;
        let bar = |point: &&Point| PathElement::new(point.ms.interval.map(|ms| (ms, point.relmse)), color);
        chart.draw_series(shown.iter().map(bar)).map_err(|error| say(&error))?;
        // Hollow at the floor: the true error may be smaller.
        let style = |point: &Point| if point.is_at_floor { color.stroke_width(1) } else { color.filled() };
        chart
            .draw_series(shown.iter().map(|point| Circle::new(at(point), 3, style(point))))
            .map_err(|error| say(&error))?;
        let front = shown.iter().filter(|point| point.is_on_front);
        chart.draw_series(front.map(|point| Circle::new(at(point), 7, BLACK))).map_err(|error| say(&error))?;
        let setting = |point: &Point| Text::new(point.knob.1.to_string(), (8, -13), ("sans-serif", 12));
        let text = |point: &&Point| EmptyElement::at(at(point)) + setting(point);
        chart.draw_series(shown.iter().map(text)).map_err(|error| say(&error))?;
    }
    root.present().map_err(|error| say(&error))
}

fn is_shown(point: &Point) -> bool {
    point.relmse > 0.0 && point.ms.min > 0.0
}

fn legend(curve: &Curve) -> String {
    match curve.slope_over_ms() {
        Some(slope) => format!("{}, slope {slope:.2}", curve.method),
        None => curve.method.to_owned(),
    }
}

/// A log axis with readable ticks: more steps of a decade where it spans few.
struct LogAxis {
    range: Range<f64>,
}

impl LogAxis {
    /// A little wider than the values, and never less than a factor of two.
    fn around(values: impl Iterator<Item = f64>) -> Self {
        let (least, most) = values.fold((f64::INFINITY, 0.0), |(a, b): (f64, f64), v| (a.min(v), b.max(v)));
        if !(least > 0.0 && least <= most && most.is_finite()) {
            return Self { range: 0.1..10.0 };
        }
        let margin = (most / least).powf(0.08).max(1.2);
        Self { range: least / margin..most * margin }
    }
}

impl Ranged for LogAxis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let share = (value / self.range.start).ln() / (self.range.end / self.range.start).ln();
        limit.0 + (share.clamp(0.0, 1.0) * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() && hint.max_num_points() > 20 {
            return Vec::new();
        }
        let decades = self.range.start.log10().floor() as i32..=self.range.end.log10().ceil() as i32;
        let steps: &[f64] = match (self.range.end / self.range.start).log10() {
            0.0..1.0 => &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0],
            1.0..4.0 => &[1.0, 2.0, 5.0],
            _ => &[1.0],
        };
        let ticks = decades.flat_map(|decade| steps.iter().map(move |step| step * 10f64.powi(decade)));
        ticks.filter(|tick| self.range.contains(tick)).collect()
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

impl ValueFormatter<f64> for LogAxis {
    fn format_ext(&self, value: &f64) -> String {
        if (1e-3..1e4).contains(value) { format!("{}", (value * 1e6).round() / 1e6) } else { format!("{value:e}") }
    }
}
