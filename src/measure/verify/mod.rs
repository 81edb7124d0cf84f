//! Every shader function against its double-precision twin, on the device; and what the formulas themselves promise.
//!
//! `build.rs` makes one compute shader of every function of `shaders_glsl/lib` ([`crate::shader::function`]); a
//! [`Twin`] says for each what its test inputs are drawn from, what it should answer and how far it may be off. [`run`]
//! gives the device [`SAMPLES`] seeded inputs and the extremes, all of a function in one dispatch, and judges every
//! answer: an error is at most `abs + rel |x|`, and a result that is not finite is always a failure. The
//! [`furnace`] then asks the twins what no comparison can: that materials give no more light than they get.

mod dispatch;
mod error;
mod judge;
mod samples;

pub use error::VerifyError;
pub use judge::{FunctionReport, Worst};

use crate::gpu::Gpu;
use crate::material::nearest;
use crate::measure::furnace::{self, Property, RANDOM_POINTS};
use crate::measure::twin::{Twin, twins};
use crate::shader::function::{self, Function};
use std::time::Instant;

/// Seeded inputs a function, the extremes not counted.
pub const SAMPLES: u32 = 1 << 18;

/// What [`run`] found.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Name of the device.
    pub device: String,
    /// Seconds that it took, pipelines included.
    pub seconds: f64,
    /// One entry a function, in the order of [`twins`].
    pub functions: Vec<FunctionReport>,
    /// What the formulas promise; empty where single functions were asked for.
    pub properties: Vec<Property>,
}

impl Report {
    /// Every function meets its limit, and every formula of ours keeps its promises.
    pub fn pass(&self) -> bool {
        self.functions.iter().all(|function| function.pass) && !self.properties.iter().any(Property::fails)
    }
}

/// Evaluates the functions whose names contain `only` on the device and judges them; without, all functions and then the
/// formulas.
///
/// # Errors
/// [`VerifyError::UnknownFunction`] where no name contains `only`, [`VerifyError::NoTwin`] where a function of the library
/// has none, [`VerifyError::Gpu`] what the device answers. A function that misses its limit is no error: see
/// [`Report::pass`].
pub fn run(gpu: &Gpu, only: Option<&str>) -> Result<Report, VerifyError> {
    let started = Instant::now();
    let report = run_with(gpu, only, SAMPLES)?;
    let properties = if only.is_none() { furnace::run(RANDOM_POINTS) } else { Vec::new() };
    Ok(Report { properties, seconds: started.elapsed().as_secs_f64(), ..report })
}

/// The functions alone, with another number of seeded inputs each.
///
/// # Errors
/// See [`run`].
pub fn run_with(gpu: &Gpu, only: Option<&str>, samples: u32) -> Result<Report, VerifyError> {
    let started = Instant::now();
    if let Some(problem) = unpaired().into_iter().next() {
        return Err(problem);
    }
    let chosen = chosen(only)?;
    let functions = chosen.into_iter().map(|twin| check(gpu, twin, samples)).collect::<Result<_, _>>()?;
    let (device, seconds) = (gpu.info().name.clone(), started.elapsed().as_secs_f64());
    Ok(Report { device, seconds, functions, properties: Vec::new() })
}

/// Evaluates one function on the device and judges it by `twin`.
///
/// # Errors
/// See [`run`]; [`VerifyError::Domains`] where the twin's domains are not those of the function's arguments.
pub fn check(gpu: &Gpu, twin: &Twin, samples: u32) -> Result<FunctionReport, VerifyError> {
    let function = function_of(twin)?;
    let inputs = samples::inputs(function, twin, samples)?;
    let found = dispatch::evaluate(gpu, function, &inputs.words, inputs.count())?;
    Ok(judge::judge(function, twin, &inputs, &found))
}

/// Functions without a twin and twins without a function; empty in a library that is whole.
pub fn unpaired() -> Vec<VerifyError> {
    let without_twin = function::ALL.iter().filter(|function| twins().all(|twin| twin.name != function.name));
    let no_twin = |function: &Function| VerifyError::NoTwin { name: function.name, file: function.file };
    without_twin.map(no_twin).chain(twins().filter_map(|twin| function_of(twin).err())).collect()
}

/// Twins whose names contain `only` (all, without); one alone where it is the whole name.
///
/// # Errors
/// [`VerifyError::UnknownFunction`] where no name contains it.
pub fn chosen(only: Option<&str>) -> Result<Vec<&'static Twin>, VerifyError> {
    let Some(only) = only else { return Ok(twins().collect()) };
    if let Some(twin) = twins().find(|twin| twin.name == only) {
        return Ok(vec![twin]);
    }
    let chosen: Vec<_> = twins().filter(|twin| twin.name.contains(only)).collect();
    if chosen.is_empty() {
        let nearest = nearest(only, twins().map(|twin| twin.name));
        return Err(VerifyError::UnknownFunction { name: only.to_owned(), nearest });
    }
    Ok(chosen)
}

fn function_of(twin: &Twin) -> Result<&'static Function, VerifyError> {
    let found = function::ALL.iter().find(|function| function.name == twin.name);
    found.ok_or_else(|| VerifyError::NoFunction { name: twin.name.to_owned() })
}
