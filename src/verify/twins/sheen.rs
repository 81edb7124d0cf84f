//! Judges `sheen.glsl`.

use super::super::domain::{COSINE, Domain, ROUGHNESS, UNIT};
use super::super::twin::{Given, Twin};
use crate::material::reference::ggx::half_vector;
use crate::material::reference::sheen;
use crate::material::{Sheen, SheenTable};
use glam::{DVec2, DVec3};

/// A model of fuzz.
pub(super) const MODEL: Domain = Domain::Choice(&[0, 1, 2, 3]);
/// Widths that Charlie is evaluated with, the classic ones included.
const CHARLIE_ALPHA: Domain = Domain::Log(0.005, 1.0, &[0.005, 0.07, 0.5, 1.0]);
/// Of Charlie's shadowing.
pub(super) const FLOORED_ALPHA: Domain = Domain::Log(0.07, 1.0, &[0.07, 0.5, 1.0]);
/// Widths of the inverted Gaussian.
const INVERTED_ALPHA: Domain = Domain::Log(1e-3, 1.0, &[1e-3, 0.05, 1.0]);
/// a and b of the table: 0 where there is no lobe, and what it holds.
pub(super) const TRANSFORM: Domain = Domain::Uniform(-0.25, 1.0, &[-0.25, 0.0, 1e-6, 0.03, 1.0]);
/// Of the projection of a view; the formula asks for some length, not for 1.
pub(super) const AXIS: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, 0.6, 1.0]);

/// Members of `SheenLobe`.
pub(super) struct Lobe {
    pub(super) albedo: f64,
    pub(super) average: f64,
    ltc: DVec2,
    view_axis: DVec2,
    alpha: f64,
    lambda: f64,
}

/// A cosine above the horizon.
const SEEN: Domain = Domain::Uniform(1e-7, 1.0, &[1e-7, 1e-3, 1.0]);
/// Averages of the albedo: the table's are below 1/2.
pub(super) const AVERAGE: Domain = Domain::Uniform(0.0, 0.5, &[0.0, 1e-8, 0.5]);
/// Charlie's Lambda.
pub(super) const LAMBDA: Domain = Domain::Log(1e-6, 1e6, &[0.0, 1e-6, 1e6]);

/// Domains of a function that takes the lobes of pile and fibre (two `SheenLobe`) between other arguments.
macro_rules! around_two_lobes {
    ([$($before:expr),* $(,)?], [$($after:expr),* $(,)?]) => {{
        use super::sheen::{AVERAGE, AXIS, FLOORED_ALPHA, LAMBDA, TRANSFORM};
        &[
            $($before,)*
            UNIT, AVERAGE, TRANSFORM, AXIS, FLOORED_ALPHA, LAMBDA,
            UNIT, AVERAGE, TRANSFORM, AXIS, FLOORED_ALPHA, LAMBDA,
            $($after,)*
        ]
    }};
}
pub(super) use around_two_lobes;

impl Lobe {
    pub(super) fn new(given: &mut Given<'_>) -> Self {
        Self {
            albedo: given.number(),
            average: given.number(),
            ltc: given.vec2(),
            view_axis: given.vec2(),
            alpha: given.number(),
            lambda: given.number(),
        }
    }

    pub(super) fn words(&self) -> [f64; 8] {
        let (ltc, axis) = (self.ltc, self.view_axis);
        [self.albedo, self.average, ltc.x, ltc.y, axis.x, axis.y, self.alpha, self.lambda]
    }

    pub(super) fn brdf_times_cosine(&self, model: u32, v: DVec3, l: DVec3) -> f64 {
        if v.z <= 0.0 || l.z <= 0.0 {
            return 0.0;
        }
        match Sheen::ALL[model as usize] {
            Sheen::Volume => self.albedo * sheen::ltc_times_cosine(self.ltc.x, self.ltc.y, self.view_axis, l),
            Sheen::Charlie => {
                let lambda = self.lambda + sheen::charlie_lambda(l.z.min(1.0), self.alpha);
                let ndf = sheen::charlie_ndf(half_vector(v, l), self.alpha);
                ndf / ((1.0 + lambda) * 4.0 * v.z.max(sheen::SMALLEST_COSINE))
            }
            Sheen::Inverted => {
                sheen::inverted_ndf(half_vector(v, l), self.alpha) * sheen::cloth_visibility(v.z, l.z) * l.z
            }
            Sheen::Classic => {
                sheen::charlie_ndf(half_vector(v, l), self.alpha) * sheen::cloth_visibility(v.z, l.z) * l.z
            }
        }
    }
}

pub(super) const TWINS: &[Twin] = &[
    Twin::new("sheen_table_uv", &[MODEL, COSINE, ROUGHNESS], |given| {
        let (sheet, mu, roughness) = (given.uint(), given.number(), given.number());
        let nodes = SheenTable::NODES as f64;
        let texel = |place: f64| place * (nodes - 1.0) + 0.5;
        let rows = nodes * Sheen::ALL.len() as f64;
        vec![texel(mu.sqrt()) / nodes, (texel(roughness) + f64::from(sheet) * nodes) / rows]
    }),
    Twin::new("sheen_charlie_ndf", &[Domain::Hemisphere, CHARLIE_ALPHA], |given| {
        let (h, alpha) = (given.vec3(), given.number());
        vec![sheen::charlie_ndf(h, alpha)]
    }),
    // Above 1/2 nothing asks for it: there Lambda is its mirror image.
    Twin::new(
        "sheen_charlie_log_lambda",
        &[Domain::Uniform(0.0, 0.5, &[0.0, 1e-40, 1e-7, 1e-3, 0.5]), FLOORED_ALPHA],
        |given| {
            let (x, alpha) = (given.number(), given.number());
            vec![sheen::charlie_lambda(x, alpha).ln()]
        },
    )
    // An error of the logarithm is Lambda's relative one.
    .limit(2e-5, 2e-5),
    Twin::new("sheen_charlie_lambda", &[COSINE, FLOORED_ALPHA], |given| {
        let (mu, alpha) = (given.number(), given.number());
        vec![sheen::charlie_lambda(mu, alpha)]
    }),
    Twin::new("sheen_inverted_ndf", &[Domain::Hemisphere, INVERTED_ALPHA], |given| {
        let (h, alpha) = (given.vec3(), given.number());
        vec![sheen::inverted_ndf(h, alpha)]
    }),
    Twin::new("sheen_cloth_visibility_times_cosine", &[SEEN, COSINE], |given| {
        let (mu_v, mu_l) = (given.number(), given.number());
        vec![sheen::cloth_visibility(mu_v, mu_l) * mu_l]
    }),
    Twin::new("sheen_ltc_times_cosine", &[TRANSFORM, AXIS, Domain::Hemisphere], |given| {
        let (ltc, axis, l) = (given.vec2(), given.vec2(), given.vec3());
        vec![sheen::ltc_times_cosine(ltc.x, ltc.y, axis, l)]
    }),
    Twin::new("sheen_lobe", &[MODEL, ROUGHNESS, Domain::Above, UNIT], |given| {
        let (model, roughness, v) = (given.uint(), given.number(), given.vec3());
        let [albedo, a, b, average] = [given.number(), given.number(), given.number(), given.number()];
        let sheet = Sheen::ALL[model as usize];
        let alpha = sheen::alpha_of_roughness(sheet, roughness);
        let axis = if sheet == Sheen::Volume { sheen::view_axis(v) } else { DVec2::X };
        let lambda = if sheet == Sheen::Charlie { sheen::charlie_lambda(v.z.min(1.0), alpha) } else { 0.0 };
        vec![albedo, average, a, b, axis.x, axis.y, alpha, lambda]
    }),
    Twin::new(
        "sheen_brdf_times_cosine",
        &[MODEL, UNIT, AVERAGE, TRANSFORM, AXIS, FLOORED_ALPHA, LAMBDA, Domain::Hemisphere, Domain::Hemisphere],
        |given| {
            let (model, lobe) = (given.uint(), Lobe::new(given));
            let (v, l) = (given.vec3(), given.vec3());
            vec![lobe.brdf_times_cosine(model, v, l)]
        },
    ),
    Twin::new("sheen_base_scale", &[UNIT, UNIT], |given| {
        let (albedo, average) = (given.vec3(), given.vec3());
        ((1.0 - albedo) / (1.0 - average).max(DVec3::splat(1e-4))).to_array().to_vec()
    }),
];
