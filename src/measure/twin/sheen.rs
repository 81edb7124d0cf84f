//! Twin of `sheen.glsl`: the lobes of fuzz, and what they leave to the cloth below.
//!
//! Zeltner, Burley & Chiang 2022, "Practical Multiple-Scattering Sheen Using Linearly Transformed Cosines"; Estevez &
//! Kulla 2017, "Production Friendly Microfacet Sheen BRDF" (Charlie), its shadowing as KHR_materials_sheen prints it;
//! Ashikhmin, Premoze & Shirley 2000, "A Microfacet-Based BRDF Generator", and Neubelt & Pettineo 2013, "Crafting a
//! Next-Gen Material Pipeline for The Order: 1886" (velvet, and the visibility of cloth).

use super::domain::{COSINE, Domain, ROUGHNESS, UNIT};
use super::ggx::half_vector;
use super::{TestInputs, Twin, ggx};
use crate::material::{Sheen, SheenEntry, SheenTable};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Smallest width of Charlie: narrower, its shadowing no longer keeps the albedo below 1.
pub const SMALLEST_CHARLIE_ALPHA: f64 = 0.07;
/// Most grazing cosine that Charlie's shadowing is asked for: the fit is finite at 0, and 1 / mu is not.
pub const SMALLEST_COSINE: f64 = 1e-3;

/// Charlie's distribution of normals; its integral with the cosine is 1. 0 for a zero-length `h`.
pub fn charlie_ndf(h: DVec3, alpha: f64) -> f64 {
    if h == DVec3::ZERO {
        return 0.0;
    }
    (2.0 + 1.0 / alpha) * h.truncate().length().powf(1.0 / alpha) / (2.0 * PI)
}

/// Smith's Lambda of Charlie, as fitted by Estevez & Kulla: in two halves that meet at the cosine 1/2.
pub fn charlie_lambda(mu: f64, alpha: f64) -> f64 {
    const SHARP: [f64; 5] = [25.3245, 3.32435, 0.16801, -1.27393, -4.85967];
    const WIDE: [f64; 5] = [21.5473, 3.82987, 0.19823, -1.97760, -4.32054];
    let share = (1.0 - alpha).powi(2);
    let [a, b, c, d, e] = std::array::from_fn(|i| WIDE[i] + (SHARP[i] - WIDE[i]) * share);
    let l = |x: f64| a / (1.0 + b * x.powf(c)) + d * x + e;
    if mu < 0.5 { l(mu).exp() } else { (2.0 * l(0.5) - l(1.0 - mu)).exp() }
}

/// The inverted Gaussian of velvet; its integral with the cosine is 1. 0 for a zero-length `h`.
pub fn inverted_ndf(h: DVec3, alpha: f64) -> f64 {
    if h == DVec3::ZERO {
        return 0.0;
    }
    let sine_squared = h.truncate().length_squared();
    // Straight up there is nothing but the even part.
    let rim = if sine_squared > 0.0 {
        (-h.z * h.z / (sine_squared * alpha * alpha)).exp() / sine_squared.powi(2)
    } else {
        0.0
    };
    (1.0 + 4.0 * rim) / (PI * (1.0 + 4.0 * alpha * alpha))
}

/// `G / (4 mu_v mu_l)` of cloth, which knows no roughness; not both cosines are 0.
pub fn cloth_visibility(mu_v: f64, mu_l: f64) -> f64 {
    1.0 / (4.0 * (mu_l + mu_v - mu_l * mu_v))
}

/// Unit projection of the view; any direction for a view along the normal.
pub fn view_axis(v: DVec3) -> DVec2 {
    if v.truncate().length() > 1e-7 { v.truncate().normalize() } else { DVec2::X }
}

/// The transformed cosine times the cosine of `l`; its integral over the hemisphere is 1. 0 where the transform is none.
pub fn ltc_times_cosine(a: f64, b: f64, view_axis: DVec2, l: DVec3) -> f64 {
    if a < 1e-5 || l.z <= 0.0 {
        return 0.0;
    }
    let (along, across) = (view_axis.dot(l.truncate()), view_axis.perp_dot(l.truncate()));
    let w = DVec3::new(a * along + b * l.z, a * across, l.z);
    // The cosine lobe of the transformed direction, times the Jacobian det / |w|^3.
    w.normalize().z / PI * a * a / w.length().powi(3)
}

/// The width that a lobe is evaluated with; the sheet [`Sheen::Volume`] takes the roughness itself.
pub fn alpha_of_roughness(sheet: Sheen, roughness: f64) -> f64 {
    match sheet {
        Sheen::Volume => roughness,
        Sheen::Charlie => (roughness * roughness).max(SMALLEST_CHARLIE_ALPHA),
        Sheen::Inverted => ggx::alpha_of_roughness(roughness),
        Sheen::Classic => roughness.max(super::classic::cotton::ROUGHNESS.0),
    }
}

/// A white lobe times the cosine of `l`; 0 where a direction is at or below the horizon.
pub fn lobe_times_cosine(sheet: Sheen, entry: SheenEntry, roughness: f64, v: DVec3, l: DVec3) -> f64 {
    if v.z <= 0.0 || l.z <= 0.0 {
        return 0.0;
    }
    let alpha = alpha_of_roughness(sheet, roughness);
    let h = ggx::half_vector(v, l);
    match sheet {
        Sheen::Volume => entry.albedo * ltc_times_cosine(entry.a, entry.b, view_axis(v), l),
        Sheen::Charlie => {
            let shadowing = 1.0 / (1.0 + charlie_lambda(v.z, alpha) + charlie_lambda(l.z, alpha));
            charlie_ndf(h, alpha) * shadowing / (4.0 * v.z.max(SMALLEST_COSINE))
        }
        Sheen::Inverted => inverted_ndf(h, alpha) * cloth_visibility(v.z, l.z) * l.z,
        Sheen::Classic => charlie_ndf(h, alpha) * cloth_visibility(v.z, l.z) * l.z,
    }
}

/// What the fuzz leaves of a Lambert base: `(1 - S(v)) (1 - S(l)) / (1 - S_average)`, reciprocal, S the albedo of all
/// fuzz. With a white base all light comes back.
pub fn coupling(albedo_v: f64, albedo_l: f64, average: f64) -> f64 {
    (1.0 - albedo_v) * (1.0 - albedo_l) / (1.0 - average).max(1e-4)
}

/// A white lobe of one roughness with its table.
#[derive(Debug, Clone, Copy)]
pub struct Lobe<'a> {
    /// Where its albedo stands.
    pub table: &'a SheenTable,
    /// Model of the fuzz.
    pub sheet: Sheen,
    /// Perceptual, in [0, 1]: the same in the lobe and in its table.
    pub roughness: f64,
}

impl Lobe<'_> {
    /// The table's entry for a view.
    pub fn entry(&self, mu: f64) -> SheenEntry {
        self.table.at(self.sheet, mu, self.roughness)
    }

    /// The lobe times the cosine of `l`.
    pub fn times_cosine(&self, v: DVec3, l: DVec3) -> f64 {
        lobe_times_cosine(self.sheet, self.entry(v.z), self.roughness, v, l)
    }
}

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
pub(super) struct SheenLobe {
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
        use crate::measure::twin::sheen::{AVERAGE, AXIS, FLOORED_ALPHA, LAMBDA, TRANSFORM};
        &[
            $($before,)*
            UNIT, AVERAGE, TRANSFORM, AXIS, FLOORED_ALPHA, LAMBDA,
            UNIT, AVERAGE, TRANSFORM, AXIS, FLOORED_ALPHA, LAMBDA,
            $($after,)*
        ]
    }};
}
pub(super) use around_two_lobes;

impl SheenLobe {
    pub(super) fn new(inputs: &mut TestInputs<'_>) -> Self {
        Self {
            albedo: inputs.number(),
            average: inputs.number(),
            ltc: inputs.vec2(),
            view_axis: inputs.vec2(),
            alpha: inputs.number(),
            lambda: inputs.number(),
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
            Sheen::Volume => self.albedo * ltc_times_cosine(self.ltc.x, self.ltc.y, self.view_axis, l),
            Sheen::Charlie => {
                let lambda = self.lambda + charlie_lambda(l.z.min(1.0), self.alpha);
                let ndf = charlie_ndf(half_vector(v, l), self.alpha);
                ndf / ((1.0 + lambda) * 4.0 * v.z.max(SMALLEST_COSINE))
            }
            Sheen::Inverted => inverted_ndf(half_vector(v, l), self.alpha) * cloth_visibility(v.z, l.z) * l.z,
            Sheen::Classic => charlie_ndf(half_vector(v, l), self.alpha) * cloth_visibility(v.z, l.z) * l.z,
        }
    }
}

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("sheen_table_uv", &[MODEL, COSINE, ROUGHNESS], |inputs| {
        let (sheet, mu, roughness) = (inputs.uint(), inputs.number(), inputs.number());
        let nodes = SheenTable::NODES as f64;
        let texel = |place: f64| place * (nodes - 1.0) + 0.5;
        let rows = nodes * Sheen::ALL.len() as f64;
        vec![texel(mu.sqrt()) / nodes, (texel(roughness) + f64::from(sheet) * nodes) / rows]
    }),
    Twin::new("sheen_charlie_ndf", &[Domain::Hemisphere, CHARLIE_ALPHA], |inputs| {
        let (h, alpha) = (inputs.vec3(), inputs.number());
        vec![charlie_ndf(h, alpha)]
    }),
    // Above 1/2 nothing asks for it: there Lambda is its mirror image.
    Twin::new(
        "sheen_charlie_log_lambda",
        &[Domain::Uniform(0.0, 0.5, &[0.0, 1e-40, 1e-7, 1e-3, 0.5]), FLOORED_ALPHA],
        |inputs| {
            let (x, alpha) = (inputs.number(), inputs.number());
            vec![charlie_lambda(x, alpha).ln()]
        },
    )
    // An error of the logarithm is Lambda's relative one.
    .limit(2e-5, 2e-5),
    Twin::new("sheen_charlie_lambda", &[COSINE, FLOORED_ALPHA], |inputs| {
        let (mu, alpha) = (inputs.number(), inputs.number());
        vec![charlie_lambda(mu, alpha)]
    }),
    Twin::new("sheen_inverted_ndf", &[Domain::Hemisphere, INVERTED_ALPHA], |inputs| {
        let (h, alpha) = (inputs.vec3(), inputs.number());
        vec![inverted_ndf(h, alpha)]
    }),
    Twin::new("sheen_cloth_visibility_times_cosine", &[SEEN, COSINE], |inputs| {
        let (mu_v, mu_l) = (inputs.number(), inputs.number());
        vec![cloth_visibility(mu_v, mu_l) * mu_l]
    }),
    Twin::new("sheen_ltc_times_cosine", &[TRANSFORM, AXIS, Domain::Hemisphere], |inputs| {
        let (ltc, axis, l) = (inputs.vec2(), inputs.vec2(), inputs.vec3());
        vec![ltc_times_cosine(ltc.x, ltc.y, axis, l)]
    }),
    Twin::new("sheen_lobe", &[MODEL, ROUGHNESS, Domain::Above, UNIT], |inputs| {
        let (model, roughness, v) = (inputs.uint(), inputs.number(), inputs.vec3());
        let [albedo, a, b, average] = [inputs.number(), inputs.number(), inputs.number(), inputs.number()];
        let sheet = Sheen::ALL[model as usize];
        let alpha = alpha_of_roughness(sheet, roughness);
        let axis = if sheet == Sheen::Volume { view_axis(v) } else { DVec2::X };
        let lambda = if sheet == Sheen::Charlie { charlie_lambda(v.z.min(1.0), alpha) } else { 0.0 };
        vec![albedo, average, a, b, axis.x, axis.y, alpha, lambda]
    }),
    Twin::new(
        "sheen_brdf_times_cosine",
        &[MODEL, UNIT, AVERAGE, TRANSFORM, AXIS, FLOORED_ALPHA, LAMBDA, Domain::Hemisphere, Domain::Hemisphere],
        |inputs| {
            let (model, lobe) = (inputs.uint(), SheenLobe::new(inputs));
            let (v, l) = (inputs.vec3(), inputs.vec3());
            vec![lobe.brdf_times_cosine(model, v, l)]
        },
    ),
    Twin::new("sheen_base_scale", &[UNIT, UNIT], |inputs| {
        let (albedo, average) = (inputs.vec3(), inputs.vec3());
        ((1.0 - albedo) / (1.0 - average).max(DVec3::splat(1e-4))).to_array().to_vec()
    }),
];
