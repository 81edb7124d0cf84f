//! Twin of `environment.glsl`, and the quadratures that the compute shaders of environments approach.
//!
//! Ramamoorthi & Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps" (harmonics); Karis 2013,
//! "Real Shading in Unreal Engine 4" (prefiltered radiance); Lagarde & de Rousiers 2014, "Moving Frostbite to Physically
//! Based Rendering" (a lobe's dominant direction); Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical
//! Caps".

use super::domain::{ALPHA, COSINE, Domain, ROUGHNESS};
use super::sheen::Lobe;
use super::{Rule, Twin, ULP, ggx};
use glam::{DMat3, DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Bands of the harmonics.
pub const BANDS: usize = 5;
/// Sheets of the table of lobes: GGX and three models of sheen.
pub const SHEETS: usize = 4;

/// A world's direction in an environment that is turned by `radians` about +Y.
pub fn from_world(direction: DVec3, radians: f64) -> DVec3 {
    DMat3::from_rotation_y(-radians) * direction
}

/// Column and row, in [0, 1], of a direction in an equirectangular picture.
pub fn uv(direction: DVec3) -> DVec2 {
    let polar = direction.x.hypot(direction.z).atan2(direction.y);
    DVec2::new(direction.z.atan2(direction.x) / TAU + 0.5, polar / PI)
}

/// The direction at a place, in [-1, 1], of a cube's face (Vulkan 1.3, "Cube Map Face Selection and Transformations").
pub fn face_direction(face: usize, place: DVec2) -> DVec3 {
    // Major axis, axis of the column, axis of the row.
    let [major, s, t] = [
        [DVec3::X, DVec3::NEG_Z, DVec3::NEG_Y],
        [DVec3::NEG_X, DVec3::Z, DVec3::NEG_Y],
        [DVec3::Y, DVec3::X, DVec3::Z],
        [DVec3::NEG_Y, DVec3::X, DVec3::NEG_Z],
        [DVec3::Z, DVec3::X, DVec3::NEG_Y],
        [DVec3::NEG_Z, DVec3::NEG_X, DVec3::NEG_Y],
    ][face];
    (major + s * place.x + t * place.y).normalize()
}

/// The inverse: the face of the largest component, x before y before z, and the place there.
pub fn face_place(direction: DVec3) -> (usize, DVec2) {
    let size = direction.abs();
    let axis = if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    let face = 2 * axis + usize::from(direction[axis] <= 0.0);
    let d = direction / size[axis];
    let place = match face {
        0 => (-d.z, -d.y),
        1 => (d.z, -d.y),
        2 => (d.x, d.z),
        3 => (d.x, -d.z),
        4 => (d.x, -d.y),
        _ => (-d.x, -d.y),
    };
    (face, place.into())
}

/// Real spherical harmonic without the Condon-Shortley sign, by the associated Legendre recurrence; polar axis z.
pub fn harmonic(band: usize, order: i32, direction: DVec3) -> f64 {
    let m = order.unsigned_abs() as usize;
    // P_m^m without its factor sin^m, which the Cartesian cosines and sines below carry.
    let double_factorial = |n: usize| (1..=n).rev().step_by(2).map(|k| k as f64).product::<f64>();
    let mut legendre = [0.0, double_factorial((2 * m).saturating_sub(1))];
    for l in m + 1..=band {
        let next = (direction.z * (2 * l - 1) as f64 * legendre[1] - (l + m - 1) as f64 * legendre[0]) / (l - m) as f64;
        legendre = [legendre[1], next];
    }
    let (mut cosine, mut sine) = (1.0, 0.0);
    for _ in 0..m {
        (cosine, sine) = (cosine * direction.x - sine * direction.y, sine * direction.x + cosine * direction.y);
    }
    let factorial = |n: usize| (1..=n).map(|k| k as f64).product::<f64>();
    let norm = ((2 * band + 1) as f64 / (4.0 * PI) * factorial(band - m) / factorial(band + m)).sqrt();
    let (norm, around) = match order {
        0 => (norm, 1.0),
        1.. => (norm * 2f64.sqrt(), cosine),
        _ => (norm * 2f64.sqrt(), sine),
    };
    norm * legendre[1] * around
}

/// Band and order of an index of the harmonics.
pub fn band_and_order(index: usize) -> (usize, i32) {
    let band = index.isqrt();
    (band, index as i32 - (band * band + band) as i32)
}

/// `2 int_0^1 t P_l(t) dt`: what the clamped cosine over pi makes of a band.
pub fn cosine_band(band: usize) -> f64 {
    match band {
        0 => 1.0,
        1 => 2.0 / 3.0,
        band if band % 2 == 1 => 0.0,
        band => {
            // Ramamoorthi & Hanrahan 2001, equation 8, over pi.
            let factorial = |n: usize| (1..=n).map(|k| k as f64).product::<f64>();
            let half = band / 2;
            let sign = if half % 2 == 1 { 1.0 } else { -1.0 };
            2.0 * sign / ((band + 2) * (band - 1)) as f64 * factorial(band)
                / (2f64.powi(band as i32) * factorial(half).powi(2))
        }
    }
}

/// Radical inverse of base 2.
pub fn radical_inverse(index: u32) -> f64 {
    (0..32).filter(|bit| index >> bit & 1 == 1).map(|bit| 0.5f64.powi(bit + 1)).sum()
}

/// The facet that `v` sees, by a point of the square.
pub fn visible_facet(u: DVec2, v: DVec3, alpha: f64) -> DVec3 {
    let stretched = DVec3::new(v.x * alpha, v.y * alpha, v.z).normalize();
    // A point of the spherical cap above -stretched.z, seen from it.
    let z = (1.0 - u.y) * (1.0 + stretched.z) - stretched.z;
    let cap = (DVec2::from_angle(TAU * u.x) * (1.0 - z * z).max(0.0).sqrt()).extend(z);
    let facet = cap + stretched;
    DVec3::new(facet.x * alpha, facet.y * alpha, facet.z).normalize()
}

/// Smith's G1 of isotropic GGX; mu in (0, 1].
pub fn masking(mu: f64, alpha: f64) -> f64 {
    let slope = (1.0 - mu * mu).max(0.0).sqrt() / mu;
    2.0 / (1.0 + (1.0 + (alpha * slope).powi(2)).sqrt())
}

/// Weight per solid angle, of any scale, of a direction that is `cosine` off the axis in the GGX lobe seen from the front.
pub fn front_lobe(cosine: f64, alpha: f64) -> f64 {
    if cosine <= 0.0 {
        return 0.0;
    }
    let half = (0.5 * (1.0 + cosine)).sqrt();
    ggx::ndf(DVec3::new((1.0 - half * half).max(0.0).sqrt(), 0.0, half), alpha, alpha) * masking(cosine, alpha)
}

/// Mean of `radiance` under that lobe about the unit vector `axis`: midpoint rule in the logarithm of the facet's tangent,
/// and around the axis. The cube's texels approach it.
pub fn prefiltered(axis: DVec3, alpha: f64, radiance: impl Fn(DVec3) -> DVec3) -> DVec3 {
    const RINGS: usize = 96;
    const AROUND: usize = 128;
    let frame = DMat3::from_cols_array_2d(&{
        let (x, y) = axis.any_orthonormal_pair();
        [x.to_array(), y.to_array(), axis.to_array()]
    });
    let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
    front_rings(alpha, RINGS, |weight, cosine| {
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let ring = (0..AROUND).map(|i| {
            let (y, x) = ((i as f64 + 0.5) / AROUND as f64 * TAU).sin_cos();
            radiance(frame * DVec3::new(sine * x, sine * y, cosine))
        });
        sum += ring.sum::<DVec3>() * (weight / AROUND as f64);
        weights += weight;
    });
    sum / weights
}

/// 1 - the length of the mean direction of that lobe, weighted by its density to the power of 3/2: of the core of the
/// lobe, which its picture is made of, rather than of its long tail.
pub fn front_spread(alpha: f64) -> f64 {
    let (mut sum, mut weights) = (0.0, 0.0);
    front_rings(alpha, 2000, |weight, cosine| {
        let weight = weight * front_lobe(cosine, alpha).sqrt();
        sum += weight * (1.0 - cosine);
        weights += weight;
    });
    sum / weights
}

/// Rings around the axis: weight and cosine of each. With `t = alpha^2 (e^s - 1)` the tangent squared of the facet's
/// angle, the density of facets in s is `e^-s`.
fn front_rings(alpha: f64, rings: usize, mut ring: impl FnMut(f64, f64)) {
    let end = (1.0 + 1.0 / (alpha * alpha)).ln();
    for i in 0..rings {
        let s = (i as f64 + 0.5) / rings as f64 * end;
        let tangent_squared = alpha * alpha * s.exp_m1();
        let cosine = (1.0 - tangent_squared) / (1.0 + tangent_squared);
        ring((-s).exp() * masking(cosine.max(1e-12), alpha), cosine);
    }
}

/// Level of the cube for a roughness, `last` being its last.
pub fn level(roughness: f64, last: f64) -> f64 {
    (roughness.powi(2) * (last.exp2() - 1.0)).ln_1p() / std::f64::consts::LN_2
}

/// What the table of lobes says of one lobe seen under one cosine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LobeEntry {
    /// Sine of the mean direction, by density^1.5, over the eye's; positive towards the mirror direction.
    pub mirror: f64,
    /// Perceptual roughness of the front-seen GGX lobe with the same spread, at most 1.
    pub roughness: f64,
    /// Integral of the lobe with the cosine (GGX: with F = 1).
    pub albedo: f64,
    /// Share of it that Schlick's `(1 - v.h)^5` takes; GGX alone.
    pub fresnel: f64,
}

/// The entry of GGX, mu in (0, 1).
pub fn ggx_entry(mu: f64, roughness: f64) -> LobeEntry {
    let alpha = ggx::alpha_of_roughness(roughness);
    let v = DVec3::new((1.0 - mu * mu).max(0.0).sqrt(), 0.0, mu);
    const SIDE: usize = 256;
    let (mut sum, mut weights, mut albedo, mut fresnel) = (DVec3::ZERO, 0.0, 0.0, 0.0);
    for i in 0..SIDE * SIDE {
        let u = (DVec2::new((i % SIDE) as f64, (i / SIDE) as f64) + 0.5) / SIDE as f64;
        let h = visible_facet(u, v, alpha);
        let l = 2.0 * v.dot(h) * h - v;
        if l.z > 0.0 {
            // G2 / G1(v), by what the density of facets leaves of the lobe.
            let lobe = ggx::ndf(h, alpha, alpha) * ggx::masking_shadowing_times_cosine(v, l, alpha, alpha);
            let weight = lobe * 4.0 * v.z / (ggx::ndf(h, alpha, alpha) * masking(v.z, alpha));
            sum += weight * lobe.sqrt() * l;
            weights += weight * lobe.sqrt();
            albedo += weight;
            fresnel += weight * ggx::schlick(0.0, v.dot(h));
        }
    }
    let is_mirror = roughness == 0.0;
    LobeEntry {
        mirror: if is_mirror { 1.0 } else { -sum.x / (sum.length() * v.x) },
        roughness: if is_mirror { 0.0 } else { roughness_of_spread(1.0 - sum.length() / weights) },
        albedo: albedo / (SIDE * SIDE) as f64,
        fresnel: fresnel / albedo,
    }
}

/// The entry of a lobe of sheen, mu in (0, 1): quadrature over the hemisphere of light.
pub fn sheen_entry(lobe: &Lobe, mu: f64) -> LobeEntry {
    const SIDE: usize = 400;
    let v = DVec3::new((1.0 - mu * mu).max(0.0).sqrt(), 0.0, mu);
    let (mut sum, mut weights, mut albedo) = (DVec3::ZERO, 0.0, 0.0);
    for i in 0..SIDE * SIDE {
        let z = ((i % SIDE) as f64 + 0.5) / SIDE as f64;
        let (y, x) = (((i / SIDE) as f64 + 0.5) / SIDE as f64 * TAU).sin_cos();
        let sine = (1.0 - z * z).sqrt();
        let l = DVec3::new(sine * x, sine * y, z);
        let density = lobe.times_cosine(v, l);
        sum += density.powf(1.5) * l;
        weights += density.powf(1.5);
        albedo += density;
    }
    if weights == 0.0 {
        return LobeEntry { mirror: 0.0, roughness: 1.0, albedo: 0.0, fresnel: 0.0 };
    }
    LobeEntry {
        mirror: -sum.x / (sum.length() * v.x),
        roughness: roughness_of_spread(1.0 - sum.length() / weights),
        albedo: albedo * TAU / (SIDE * SIDE) as f64,
        fresnel: 0.0,
    }
}

/// Perceptual roughness whose front-seen lobe spreads so much, at most 1.
pub fn roughness_of_spread(spread: f64) -> f64 {
    let (mut from, mut to) = (ggx::SMALLEST_ALPHA.sqrt(), 1.0);
    for _ in 0..40 {
        let middle = 0.5 * (from + to);
        if front_spread(middle * middle) < spread { from = middle } else { to = middle }
    }
    0.5 * (from + to)
}

/// Mean direction of a lobe, by the table's ratio of sines.
pub fn lobe_axis(v: DVec3, mirror: f64) -> DVec3 {
    let across = -mirror * v.truncate();
    across.extend((1.0 - across.length_squared()).max(0.0).sqrt())
}

/// Of a face.
const PLACE: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1e-7, 1.0]);
const FACE: Domain = Domain::Choice(&[0, 1, 2, 3, 4, 5]);
/// The points that Hammersley gives keep away from the edges of the square.
const INSIDE: Domain = Domain::Uniform(1e-3, 0.999, &[1e-3, 0.5, 0.999]);
/// Last level of a cube: faces of 4 to 1024 texels.
const LAST: Domain = Domain::Uniform(0.0, 8.0, &[0.0, 4.0, 6.0, 8.0]);
const LAST_ABOVE_0: Domain = Domain::Uniform(1.0, 8.0, &[1.0, 6.0, 8.0]);
/// Of the harmonics.
const INDICES: [u32; 25] = {
    let mut indices = [0; 25];
    let mut index = 0;
    while index < 25 {
        indices[index] = index as u32;
        index += 1;
    }
    indices
};

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    // Cosine and sine of any length: the formula asks for none.
    Twin::new("environment_from_world", &[Domain::Direction, PLACE], |inputs| {
        let (direction, rotation) = (inputs.vec3(), inputs.vec2());
        let turned = from_world(direction, rotation.to_angle()) * rotation.length();
        vec![turned.x, direction.y, turned.z]
    }),
    Twin::new("environment_uv", &[Domain::Direction], |inputs| uv(inputs.vec3()).to_array().to_vec()),
    Twin::new("environment_face_direction", &[FACE, PLACE], |inputs| {
        let face = inputs.uint() as usize;
        face_direction(face, inputs.vec2()).to_array().to_vec()
    }),
    Twin::new("environment_face_place", &[Domain::Direction], |inputs| {
        let (face, place) = face_place(inputs.vec3());
        vec![place.x, place.y, face as f64]
    }),
    // The volume of the cone over an area of the face grows as the cube of its slant.
    Twin::new("environment_face_density", &[PLACE], |inputs| vec![inputs.vec2().extend(1.0).length().powi(-3)]),
    Twin::new("environment_sh", &[Domain::Choice(&INDICES), Domain::Direction], |inputs| {
        let (band, order) = band_and_order(inputs.uint() as usize);
        vec![harmonic(band, order, inputs.vec3())]
    }),
    Twin::new("environment_cosine_band", &[Domain::Choice(&[0, 1, 2, 3, 4])], |inputs| {
        vec![cosine_band(inputs.uint() as usize)]
    }),
    Twin::new(
        "environment_hammersley",
        &[Domain::Choice(&[0, 1, 2, 3, 5, 17, 62, 63]), Domain::Choice(&[64, 100, 1024])],
        |inputs| {
            let (index, count) = (inputs.uint(), inputs.uint());
            let half = 0.5 / f64::from(count);
            vec![(f64::from(index) + 0.5) / f64::from(count), radical_inverse(index) + half]
        },
    ),
    Twin::new("environment_visible_facet", &[INSIDE, Domain::Hemisphere, ALPHA], |inputs| {
        let (u, v): (DVec2, DVec3) = (inputs.vec2(), inputs.vec3());
        visible_facet(u, v, inputs.number()).to_array().to_vec()
    })
    // Cap and view cancel down to what stands above the horizon, (1 - u.y) (1 + v'.z) with v' the stretched view: an error
    // of two units in the last place of 1 is that much larger of the facet.
    .allowance(|inputs| {
        let (u, v, alpha) = (inputs.vec2(), inputs.vec3(), inputs.number());
        let stretched = DVec3::new(v.x * alpha, v.y * alpha, v.z).normalize();
        vec![2.0 * ULP / ((1.0 - u.y) * (1.0 + stretched.z)); 3]
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("environment_masking", &[Domain::Uniform(1e-7, 1.0, &[1e-7, 1e-3, 1.0]), ALPHA], |inputs| {
        let (mu, alpha) = (inputs.number(), inputs.number());
        vec![masking(mu, alpha)]
    }),
    Twin::new("environment_level", &[ROUGHNESS, LAST], |inputs| {
        let (roughness, last) = (inputs.number(), inputs.number());
        vec![level(roughness, last)]
    }),
    Twin::new("environment_alpha_of_level", &[Domain::Uniform(0.0, 8.0, &[0.0, 1.0, 8.0]), LAST_ABOVE_0], |inputs| {
        let (level, last) = (inputs.number(), inputs.number());
        vec![(level.exp2() - 1.0) / (last.exp2() - 1.0)]
    }),
    Twin::new(
        "environment_table_uv",
        &[Domain::Choice(&[0, 1, 2, 3]), COSINE, ROUGHNESS, Domain::Uniform(8.0, 64.0, &[8.0, 32.0, 64.0])],
        |inputs| {
            let (sheet, mu, roughness, nodes) = (inputs.uint(), inputs.number(), inputs.number(), inputs.number());
            let texel = |place: f64| place * (nodes - 1.0) + 0.5;
            let rows = nodes * SHEETS as f64;
            vec![texel(mu.sqrt()) / nodes, (texel(roughness) + f64::from(sheet) * nodes) / rows]
        },
    ),
    Twin::new("environment_lobe_axis", &[Domain::Above, Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1.0])], |inputs| {
        let v = inputs.vec3();
        lobe_axis(v, inputs.number()).to_array().to_vec()
    })
    .rule(Rule::Conditioned(4)),
];
