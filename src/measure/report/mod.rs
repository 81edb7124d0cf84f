//! Error against run time: sweeps of the knobs that trade one for the other.
//!
//! A [`Sweep`] names methods, knobs and views; [`measure`] answers all of them against the reference and gives a
//! [`Report`], which [`save`] writes as tables, plots and one page. Data flows that way and never back.

mod case;
mod curve;
mod dynamics;
mod environment;
mod feature;
mod folder;
mod measurement;
pub mod metric;
mod page;
mod plot;
mod shadow;
pub mod statistics;
mod summary;
mod sweep;
mod table;
mod transparency;

pub use case::View;
pub use curve::Curve;
pub use feature::{Clock, Feature, Point, Report};
pub use folder::{check_folder, save};
pub use summary::{LAYERS_4X, Summary};
pub use sweep::{CLASSIC_LAYERS, Method, Sweep};

use crate::gpu::Gpu;
use crate::measure::furnace::RANDOM_POINTS;
use crate::measure::oracle::OracleError;
use crate::render::RenderError;
use crate::scene::SceneError;
use case::Cases;
use std::path::PathBuf;
use std::time::Duration;

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// A frame failed.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// A scene cannot be made.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A reference cannot be made.
    #[error(transparent)]
    Oracle(#[from] OracleError),
    /// The gallery lacks what is measured.
    #[error("gallery: has no furred object \"{lacks}\", which reports measure; restore it")]
    Gallery {
        /// Name of the object.
        lacks: &'static str,
    },
    /// The folder holds something else.
    #[error("{}: holds files that are no report; choose a new or empty folder, or one with an earlier report", path.display())]
    Foreign {
        /// The folder.
        path: PathBuf,
    },
    /// A file cannot be written.
    #[error("{}: {source}; choose a folder that can be written", path.display())]
    Write {
        /// File or folder.
        path: PathBuf,
        /// Cause.
        source: std::io::Error,
    },
    /// A plot cannot be drawn.
    #[error("plot {plot}: {problem}; please report it")]
    Plot {
        /// Which.
        plot: String,
        /// What the plotter said.
        problem: String,
    },
}

/// How much work a report is worth.
#[derive(Debug, Clone, PartialEq)]
pub struct Effort {
    /// Pixels of the pictures of the knot.
    pub size: [u32; 2],
    /// Pixels of the pictures of the swatch, which looks the same all over: fewer tell as much.
    pub swatch_size: [u32; 2],
    /// Numbers of shells of the default method.
    pub layers: Vec<u32>,
    /// Numbers of shells of the other methods.
    pub layers_of_others: Vec<u32>,
    /// Samples a pixel of the reference, an even number of at least 2.
    pub reference_samples: u32,
    /// Rounds of timing.
    pub rounds: usize,
    /// When no further round begins, from three rounds on.
    pub time_limit: Option<Duration>,
    /// Random points at which each promise of a formula is tried, beside the corners of its parameters.
    pub furnace_points: usize,
}

impl Effort {
    /// Two minutes on two cores.
    pub fn quick() -> Self {
        Self {
            size: [256, 144],
            swatch_size: [96, 54],
            layers: vec![1, 2, 4, 8, 16, 32],
            layers_of_others: vec![4, 8, 16],
            reference_samples: 24,
            rounds: 9,
            time_limit: Some(Duration::from_secs(30)),
            furnace_points: 300,
        }
    }

    /// The whole range of shells.
    pub fn full() -> Self {
        Self {
            size: [512, 288],
            swatch_size: [256, 144],
            layers: vec![1, 2, 4, 8, 16, 32, 64, 128, 256],
            layers_of_others: vec![4, 8, 16, 32, 64, 128, 256],
            reference_samples: 256,
            rounds: 31,
            time_limit: None,
            furnace_points: RANDOM_POINTS,
        }
    }

    /// Pixels of a view's pictures.
    pub(crate) fn size_of(&self, view: View) -> [u32; 2] {
        if view.stage() == case::Stage::Swatch { self.swatch_size } else { self.size }
    }
}

/// Hears what is being done: the stage, how many parts of it are done, and how many there are.
pub type Progress<'a> = dyn FnMut(&'static str, usize, usize) + 'a;

/// Measures all points of `sweeps`, the dynamics, and what the summary needs.
///
/// # Errors
/// When the device fails or a reference cannot be made.
pub fn measure(gpu: &Gpu, sweeps: &[Sweep], effort: &Effort, progress: &mut Progress) -> Result<Report, ReportError> {
    let cases = Cases::new()?;
    let mut points: Vec<_> = sweeps.iter().flat_map(feature::sweep_points).collect();
    points.extend(summary::sweep_points(cases.default_layers));
    let measurements = measurement::measure(gpu, &cases, &points, effort, progress)?;
    progress("furnace", 0, 1);
    let mut report = Report::new(gpu.info(), sweeps, &cases, &measurements, effort);
    report.features.push(environment::feature(gpu, effort, progress)?);
    report.features.push(transparency::feature(gpu, effort, report.clock, progress)?);
    report.features.push(shadow::feature(gpu, effort, report.clock, progress)?);
    Ok(report)
}
