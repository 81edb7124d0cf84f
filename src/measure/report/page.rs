//! One page that a person reads in a minute; it needs no other file.

use super::feature::{Clock, Point, Report};
use super::plot::Plot;
use super::statistics::pareto_front;
use super::{LAYERS_4X, Method, View};
use crate::measure::furnace::{Property, short};
use std::collections::BTreeSet;

const STYLE: &str = "\
:root{color-scheme:light dark;--ink:#1b1b1b;--soft:#666;--line:#ccc;--paper:#fff}\
@media(prefers-color-scheme:dark){:root{--ink:#e8e8e8;--soft:#aaa;--line:#444;--paper:#141414}}\
body{font:16px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--paper);max-width:46rem;margin:0 auto;padding:1rem}\
h1{font-size:1.5rem;margin:.3rem 0}h2{font-size:1.1rem;margin:1.6rem 0 .4rem}p{margin:.4rem 0}.soft{color:var(--soft)}\
.figures{display:flex;flex-wrap:wrap;gap:1rem}.figures div{flex:1 1 11rem}.figures b{display:block;font-size:1.7rem}\
.wide{overflow-x:auto}table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums}\
td,th{text-align:left;padding:.25rem .6rem .25rem 0;border-bottom:1px solid var(--line)}\
svg{width:100%;height:auto}svg text{fill:var(--ink)}svg [stroke='#000000']{stroke:var(--ink)}svg [fill='#FFFFFF']{fill:none}\
summary{cursor:pointer;padding:.3rem 0}";

impl Report {
    /// The page as HTML.
    pub(super) fn page(&self, plots: &[Plot]) -> String {
        let mut html = format!(
            "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
             <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\
             <title>vair: error against time</title><style>{STYLE}</style></head><body>\n<h1>Error against time</h1>\n"
        );
        html += &self.conditions();
        html += &self.figures();
        html += "<h2>What to choose</h2>\n";
        html += &self.choices();
        html += &self.defaults();
        let first = plots.iter().position(|plot| plot.camera == View::Gallery.name()).unwrap_or(0);
        if let Some(plot) = plots.get(first) {
            html += &format!("<h2>{}</h2>\n{}\n", escaped(plot.feature), plot.svg);
        }
        html += "<p class=\"soft\">Down and left is better. Numbers at the points are layers (dynamics: steps a second; \
                 transparency: samples; shadow: texels of a map). \
                 Grey: what others do. Ringed: no other point is as fast and as right. Hollow: the reference's noise is more \
                 than a tenth of the error. Bars: 95 % interval of the median; of fewer than \
                 six rounds that is all of them.</p>\n<h2>All plots</h2>\n";
        for (_, plot) in plots.iter().enumerate().filter(|(index, _)| *index != first) {
            let title = format!("{}: {}", plot.feature, plot.camera);
            html += &format!("<details><summary>{}</summary>\n{}\n</details>\n", escaped(&title), plot.svg);
        }
        for note in self.features.iter().flat_map(|feature| &feature.notes) {
            html += &format!("<p class=\"soft\">Not plotted: {}.</p>\n", escaped(note));
        }
        html += "<h2>What the formulas promise</h2>\n";
        html += &self.promises();
        html + "</body></html>\n"
    }

    fn conditions(&self) -> String {
        let clock = match self.clock {
            Clock::Device => "the device's timestamps around the opaque and fur passes",
            Clock::Wall => "the wall clock around whole frames, since this device has no timestamps",
        };
        let processor = if self.is_on_processor() {
            " <strong>This device is a program on the processor: its times are processor times and say nothing about \
             graphics hardware.</strong>"
        } else {
            ""
        };
        let device = escaped(&format!("{}, {}, Vulkan {}", self.device.name, self.device.driver, self.device.api));
        let [[width, height], [swatch_width, swatch_height]] = self.sizes;
        format!(
            "<p class=\"soft\">{device}; {} host threads; {}; {width}x{height} pixels (swatch {swatch_width}x{swatch_height}); median of {} rounds over all \
             points; times by {clock}.{processor}</p>\n",
            self.threads, self.date, self.rounds
        )
    }

    fn figures(&self) -> String {
        let (summary, [few, many]) = (&self.summary, LAYERS_4X);
        let figure = |value: Option<f64>, text: &str| {
            let value = value.map_or_else(|| "not measured".to_owned(), |value| format!("{value:.2}&times;"));
            format!("<div><b>{value}</b>{text}</div>")
        };
        let mut html = format!(
            "<div class=\"figures\">{}{}{}</div>\n",
            figure(summary.equal_error_speedup, "as fast as 20 classic draws at the same error"),
            figure(summary.layers_4x_cost, &format!("the time for {many} layers in place of {few}")),
            figure(summary.vs_one_layer, "the time of one opaque layer for the whole fur"),
        );
        for note in &summary.notes {
            html += &format!("<p class=\"soft\">{}.</p>\n", escaped(note));
        }
        html
    }

    /// The Pareto front over all methods of all features before the gallery's camera: budget and choice.
    fn choices(&self) -> String {
        let mut points: Vec<&Point> = Vec::new();
        for point in self.features.iter().flat_map(|feature| &feature.points) {
            // Other features name the default method again: equal measurements are one row.
            let is_known = |known: &&Point| (known.ms, known.relmse) == (point.ms, point.relmse);
            if point.camera == View::Gallery.name() && !points.iter().any(is_known) {
                points.push(point);
            }
        }
        let costs: Vec<_> = points.iter().map(|point| [point.ms.median, point.relmse]).collect();
        let is_default = |point: &Point| point.method == Method::ours().name && point.knob.1 == self.default_layers;
        let chosen = points.iter().zip(pareto_front(&costs)).filter(|(point, on_front)| *on_front || is_default(point));
        let mut front: Vec<&Point> = chosen.map(|(point, _)| *point).collect();
        front.sort_by(|a, b| a.ms.median.total_cmp(&b.ms.median));
        let mut html = String::from(
            "<div class=\"wide\"><table><tr><th>from</th><th>choose</th><th>layers</th><th>relMSE</th><th>FLIP</th></tr>\n",
        );
        for point in front {
            let flip = point.flip.map(|flip| format!("{flip:.3}")).unwrap_or_default();
            let mark = if point.is_at_floor { " &deg;" } else { "" };
            let name = if is_default(point) { "the default" } else { point.method };
            html += &format!(
                "<tr><td>{:.1} ms</td><td>{}</td><td>{}</td><td>{:.4}{mark}</td><td>{flip}</td></tr>\n",
                point.ms.median,
                escaped(name),
                point.knob.1,
                point.relmse
            );
        }
        html + "</table></div>\n<p class=\"soft\">By relMSE, and the default wherever it stands; &deg; where the reference's own \
                noise is more than a tenth of the error, so that such rows are alike. Layers are <code>--layers</code> or a \
                fur's <code>layers</code>, samples <code>--msaa</code>; shells that blend are <code>blend = \"blend\"</code> \
                in a look: as good on still pictures, but they write no depth.</p>\n"
    }

    /// One row a promise: the worst that was found of ours, and of the formula of older engines.
    fn promises(&self) -> String {
        let mut rows: Vec<(&str, &str)> =
            self.furnace.iter().map(|property| (property.material, property.property)).collect();
        rows.sort_by_key(|(material, _)| self.furnace.iter().position(|property| property.material == *material));
        let mut seen = BTreeSet::new();
        rows.retain(|row| seen.insert(*row));
        let mut html = String::from(
            "<p>The worst found over all corners of the parameters and random points between them. An albedo over 1 makes light \
             out of nothing.</p>\n<div class=\"wide\"><table><tr><th>kind</th><th>promise</th><th>limit</th><th>default</th>\
             <th>classic = true</th></tr>\n",
        );
        for (material, promise) in rows {
            let of = |classic: bool| {
                let same = |known: &&Property| (known.material, known.property) == (material, promise);
                self.furnace.iter().find(|known| same(known) && known.classic == classic)
            };
            let worst = |classic| {
                of(classic).map_or_else(String::new, |known| match known.pass {
                    true => short(known.worst),
                    false => format!("<strong>{}</strong>", short(known.worst)),
                })
            };
            let limit =
                [false, true].into_iter().find_map(|classic| of(classic)?.limit).map_or_else(String::new, short);
            html += &format!(
                "<tr><td>{}</td><td>{}</td><td>{limit}</td><td>{}</td><td>{}</td></tr>\n",
                escaped(material),
                escaped(promise),
                worst(false),
                worst(true)
            );
        }
        html + "</table></div>\n"
    }

    fn defaults(&self) -> String {
        let Method { shells, msaa, .. } = Method::ours();
        let words = |value: &dyn std::fmt::Debug| escaped(&format!("{value:?}").to_lowercase());
        format!(
            "<p>Defaults: {} layers (the fur's own), {} sampling, {} alpha, {} submission, {}, {msaa} samples a pixel.</p>\n",
            self.default_layers,
            words(&shells.sampling),
            words(&shells.alpha),
            words(&shells.submission),
            words(&shells.order).replace("first", " first"),
        )
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
