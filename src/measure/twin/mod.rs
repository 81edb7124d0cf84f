//! Double-precision twins of the shader functions, written from the formulas and sharing no code with the shaders; and what
//! each function is held to.
//!
//! Each file is named after the GLSL file in `shaders_glsl/lib` that it judges: first the formulas, then a [`Twin`] a
//! function, which says where it is evaluated and how far off it may be. The one thing both sides share is data:
//! [`albedo::Fit`] reads the fitted coefficients out of `albedo.glsl`, so that there is one declaration of them. All
//! directions are unit vectors in the tangent frame (z = normal) and point away from the surface.

mod domain;
mod limit;
mod test_inputs;

pub mod albedo;
pub mod anisotropy;
pub mod classic;
pub mod color;
pub mod coverage;
pub mod direction;
pub mod environment;
pub mod environment_lobe;
pub mod fibre;
pub mod film;
pub mod fuzz;
pub mod gauze;
pub mod ggx;
pub mod glint;
pub mod hash;
pub mod horizon;
pub mod hsv;
pub mod laser;
pub mod layered;
pub mod light;
pub mod lock;
pub mod occlusion;
pub mod octahedral;
pub mod satin;
pub mod shadow;
pub mod sheen;
pub mod standard;
pub mod strand;
pub mod strand_dynamics;
pub mod tone_mapping;
pub mod transparency;
pub mod uv;

pub use domain::Domain;
pub(in crate::measure) use domain::Random;
pub use limit::{Limit, Rule};
pub use test_inputs::TestInputs;

/// What one function is held to: where it is evaluated, what it should answer, and how far off it may be.
#[derive(Debug, Clone, Copy)]
pub struct Twin {
    /// Name of the function in `shaders_glsl/lib`.
    pub name: &'static str,
    /// One an argument, or a member where an argument is a struct (padding aside), in their order.
    pub domains: &'static [Domain],
    /// How far a result may be off.
    pub limit: Limit,
    /// What of a result's error is allowed beside the limit, a component: of the same inputs.
    pub allowance: Option<fn(&mut TestInputs<'_>) -> Vec<f64>>,
    /// What an error is measured against.
    pub rule: Rule,
    /// Share of the samples that may miss the limit: nothing but where the function leaves out on purpose what the twin
    /// does not.
    pub missed: f64,
    /// The function in double precision: results in their order, matrices column by column.
    pub value: fn(&mut TestInputs<'_>) -> Vec<f64>,
    /// What of a result is used, applied to found and expected alike.
    pub used: fn(&mut [f64]),
}

impl Twin {
    /// A twin with the limit that holds where nothing else is said.
    pub(super) const fn new(
        name: &'static str,
        domains: &'static [Domain],
        value: fn(&mut TestInputs<'_>) -> Vec<f64>,
    ) -> Self {
        Self {
            name,
            domains,
            limit: Limit::DEFAULT,
            allowance: None,
            rule: Rule::Plain,
            missed: 0.0,
            value,
            used: |_| {},
        }
    }

    pub(super) const fn limit(mut self, rel: f64, abs: f64) -> Self {
        self.limit = Limit { rel, abs };
        self
    }

    pub(super) const fn rule(mut self, rule: Rule) -> Self {
        self.rule = rule;
        self
    }

    pub(super) const fn allowance(mut self, allowance: fn(&mut TestInputs<'_>) -> Vec<f64>) -> Self {
        self.allowance = Some(allowance);
        self
    }

    pub(super) const fn missed(mut self, share: f64) -> Self {
        self.missed = share;
        self
    }

    pub(super) const fn used(mut self, used: fn(&mut [f64])) -> Self {
        self.used = used;
        self
    }

    /// What is allowed beside the limit, for that many components.
    pub(in crate::measure) fn allowed(&self, words: &[u32], components: usize) -> Vec<f64> {
        self.allowance.map_or_else(|| vec![0.0; components], |allowance| allowance(&mut TestInputs::new(words)))
    }

    /// The twin's value for one invocation's words.
    pub(in crate::measure) fn expected(&self, words: &[u32]) -> Vec<f64> {
        let mut value = (self.value)(&mut TestInputs::new(words));
        (self.used)(&mut value);
        value
    }
}

/// Every file's.
const FILES: &[&[Twin]] = &[
    albedo::TWINS,
    anisotropy::TWINS,
    color::TWINS,
    classic::cotton::TWINS,
    coverage::TWINS,
    direction::TWINS,
    environment_lobe::TWINS,
    fibre::TWINS,
    environment::TWINS,
    film::TWINS,
    fuzz::TWINS,
    gauze::TWINS,
    classic::gauze::TWINS,
    ggx::TWINS,
    glint::lattice::TWINS,
    glint::footprint::TWINS,
    glint::tile::TWINS,
    glint::disc::TWINS,
    glint::TWINS,
    hash::TWINS,
    horizon::TWINS,
    hsv::TWINS,
    laser::TWINS,
    layered::TWINS,
    light::TWINS,
    lock::TWINS,
    occlusion::TWINS,
    octahedral::TWINS,
    satin::TWINS,
    classic::satin::TWINS,
    shadow::TWINS,
    sheen::TWINS,
    standard::TWINS,
    strand::TWINS,
    strand_dynamics::TWINS,
    tone_mapping::TWINS,
    transparency::TWINS,
    uv::TWINS,
    classic::velvet::TWINS,
];

/// Every twin, by file.
pub fn twins() -> impl Iterator<Item = &'static Twin> {
    FILES.iter().copied().flatten()
}

/// One unit in the last place, relative.
const ULP: f64 = f32::EPSILON as f64;
