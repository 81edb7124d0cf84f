//! Twin of `albedo.glsl`: directional albedo of the GGX lobe, by quadrature and by the fit that the shader evaluates.

use super::domain::{ALPHA, COSINE, Domain, ROUGHNESS, UNIT};
use super::ggx::alpha_of_roughness;
use super::{Twin, ULP};
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Nodes and weights of Gauss-Legendre quadrature on [0, 1] with `count` points.
///
/// Newton's iteration on the Legendre polynomial, from the usual cosine start (Press et al. 2007, "Numerical
/// Recipes", section 4.6).
pub fn gauss_legendre(count: usize) -> Vec<(f64, f64)> {
    let n = count as f64;
    (0..count)
        .map(|i| {
            let mut x = (PI * (i as f64 + 0.75) / (n + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..100 {
                let (mut p, mut previous) = (1.0, 0.0);
                for j in 0..count {
                    let j = j as f64;
                    (p, previous) = (((2.0 * j + 1.0) * x * p - j * previous) / (j + 1.0), p);
                }
                slope = n * (x * p - previous) / (x * x - 1.0);
                let step = p / slope;
                x -= step;
                if step.abs() < 1e-15 {
                    break;
                }
            }
            (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

/// Directional albedo of isotropic GGX with height-correlated Smith, single scattering, by quadrature:
/// `(scale, bias)` with `E(F0) = F0 scale + bias` (Schlick, F90 = 1). `mu` = cosine of the view angle in (0, 1].
///
/// Integrates over the visible normals (Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps"),
/// where the integrand is smooth; `rule` comes from [`gauss_legendre`], 96 points give 1e-4.
pub fn directional_albedo(mu: f64, alpha: f64, rule: &[(f64, f64)]) -> (f64, f64) {
    let view = DVec3::new((1.0 - mu * mu).max(0.0).sqrt(), 0.0, mu);
    let stretched = DVec3::new(alpha * view.x, 0.0, view.z).normalize();
    let lambda = |cosine: f64| 0.5 * ((1.0 + alpha * alpha * (1.0 / (cosine * cosine) - 1.0)).max(1.0).sqrt() - 1.0);
    let lambda_view = lambda(mu);
    let (mut scale, mut bias) = (0.0, 0.0);
    for &(s, weight_s) in rule {
        // The share of the cap, as a cube: grazing normals, where the lobe turns within alpha, get most points.
        let (rest, weight_u) = (s * s * s, 3.0 * s * s * weight_s);
        let z = rest * (1.0 + stretched.z) - stretched.z;
        let radius = (1.0 - z * z).max(0.0).sqrt();
        for &(p, weight_p) in rule {
            let (sin, cos) = (p * PI).sin_cos();
            let cap = DVec3::new(radius * cos, radius * sin, z) + stretched;
            let h = DVec3::new(alpha * cap.x, alpha * cap.y, cap.z.max(1e-12)).normalize();
            let v_dot_h = view.dot(h);
            let mu_l = 2.0 * v_dot_h * h.z - mu;
            if mu_l <= 0.0 {
                continue;
            }
            let shadowing = (1.0 + lambda_view) / (1.0 + lambda_view + lambda(mu_l.min(1.0)));
            let weight = weight_u * weight_p * shadowing;
            let fresnel = (1.0 - v_dot_h.clamp(0.0, 1.0)).powi(5);
            scale += weight * (1.0 - fresnel);
            bias += weight * fresnel;
        }
    }
    (scale, bias)
}

/// Rows of the loss polynomial: powers of t from 0; each row holds powers 0..=3 of alpha.
pub const WHITE_ROWS: usize = 9;
/// Total degree of the Fresnel polynomial in (mu, t, roughness).
pub const FRESNEL_DEGREE: usize = 5;
/// Coefficients of the Fresnel polynomial.
pub const FRESNEL_TERMS: usize = 46;
/// Powers 0.. of roughness in the average polynomials.
pub const AVERAGE_TERMS: usize = 9;
/// Share of alpha in the variable `t = (mu - k alpha) / (mu + k alpha)`, which follows the lobe's own scale.
pub const ALPHA_SHARE: f64 = 0.7;

/// Coefficients of the fits in `albedo.glsl`.
///
/// White albedo `E1 = sum white[i][j] t^i alpha^j`; Fresnel share `Q = q^5`, q a polynomial in (mu, t, roughness);
/// then `bias = E1 Q`, `scale = E1 (1 - Q)`.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// `[power of t][power of alpha]`.
    pub white: [[f64; 4]; WHITE_ROWS],
    /// In the order of [`fresnel_basis`].
    pub fresnel: [f64; FRESNEL_TERMS],
    /// `[power of roughness]` -> cosine-weighted averages of (E1 Q, E1, Q).
    pub averages: [[f64; 3]; AVERAGE_TERMS],
}

/// Roughness as the fits take it: below the square root of the smallest alpha nothing changes.
pub fn fitted_roughness(roughness: f64) -> f64 {
    alpha_of_roughness(roughness).sqrt()
}

/// t of the fits.
pub fn scaled_cosine(mu: f64, alpha: f64) -> f64 {
    (mu - ALPHA_SHARE * alpha) / (mu + ALPHA_SHARE * alpha)
}

/// Largest power of roughness beside `mu^i t^j`.
///
/// The definition of t is itself a polynomial identity, `t mu + k t r^2 = mu - k r^2`, so monomials with `t r^2` are
/// combinations of the others: with them the fit would have no unique coefficients.
pub fn largest_roughness_power(i: usize, j: usize) -> usize {
    let left = FRESNEL_DEGREE.saturating_sub(i + j);
    if j == 0 { left } else { left.min(1) }
}

/// Monomials of the Fresnel polynomial, in the order of the file: powers of mu from high to low, in it powers of t
/// from high to low, in it powers of roughness from low to high.
pub fn fresnel_basis(mu: f64, t: f64, roughness: f64) -> [f64; FRESNEL_TERMS] {
    let mut terms = [0.0; FRESNEL_TERMS];
    let mut next = terms.iter_mut();
    let [mu, t, roughness] = [mu, t, roughness].map(powers);
    for i in (0..=FRESNEL_DEGREE).rev() {
        for j in (0..=FRESNEL_DEGREE - i).rev() {
            for roughness in &roughness[..=largest_roughness_power(i, j)] {
                if let Some(term) = next.next() {
                    *term = mu[i] * t[j] * roughness;
                }
            }
        }
    }
    terms
}

/// Powers 0.. of `x`.
fn powers(x: f64) -> [f64; FRESNEL_DEGREE + 1] {
    let mut powers = [1.0; FRESNEL_DEGREE + 1];
    for exponent in 1..powers.len() {
        powers[exponent] = powers[exponent - 1] * x;
    }
    powers
}

impl Fit {
    /// Reads the coefficients out of the text of `albedo.glsl`: all numbers between the lines `// fit: begin` and
    /// `// fit: end`. `None` if there are not exactly as many as a fit has.
    pub fn parse(glsl: &str) -> Option<Self> {
        let (_, text) = glsl.split_once("// fit: begin")?;
        let (text, _) = text.split_once("// fit: end")?;
        // Every coefficient is a signed literal with a point, inside a constructor or alone; other numbers have none.
        let mut numbers = text
            .lines()
            .filter(|line| !line.trim_start().starts_with("//"))
            .flat_map(|line| line.split(|c: char| !(c.is_ascii_alphanumeric() || ".+-_".contains(c))))
            .filter(|word| word.contains('.') && word.contains(|c: char| c.is_ascii_digit()))
            .filter_map(|word| word.parse::<f64>().ok());
        let mut white = [[0.0; 4]; WHITE_ROWS];
        for row in white.iter_mut().rev() {
            for coefficient in row {
                *coefficient = numbers.next()?;
            }
        }
        let mut fresnel = [0.0; FRESNEL_TERMS];
        for coefficient in &mut fresnel {
            *coefficient = numbers.next()?;
        }
        let mut averages = [[0.0; 3]; AVERAGE_TERMS];
        for row in averages.iter_mut().rev() {
            for coefficient in row {
                *coefficient = numbers.next()?;
            }
        }
        numbers.next().is_none().then_some(Self { white, fresnel, averages })
    }

    /// The fit that the shaders are built with.
    ///
    /// # Panics
    /// If the embedded `albedo.glsl` holds no fit; a test of this module keeps it whole.
    pub fn shipped() -> Self {
        Self::parse(include_str!("../../../shaders_glsl/lib/albedo.glsl")).expect("albedo.glsl holds one whole fit")
    }

    /// `(E1, Q)` at the cosine `mu` and the perceptual `roughness`, both in [0, 1].
    pub fn terms(&self, mu: f64, roughness: f64) -> (f64, f64) {
        let mu = mu.clamp(0.0, 1.0);
        let alpha = alpha_of_roughness(roughness);
        let t = scaled_cosine(mu, alpha);
        let row = |c: &[f64; 4]| c[0] + alpha * (c[1] + alpha * (c[2] + alpha * c[3]));
        let white = self.white.iter().rev().fold(0.0, |sum, c| sum * t + row(c));
        let basis = fresnel_basis(mu, t, alpha.sqrt());
        let q: f64 = basis.iter().zip(&self.fresnel).map(|(term, c)| term * c).sum();
        (white.clamp(0.0, 1.0), q.clamp(0.0, 1.0).powi(5))
    }

    /// `(scale, bias)`: `E(F0) = F0 scale + bias`, single scattering.
    pub fn directional_albedo(&self, mu: f64, roughness: f64) -> (f64, f64) {
        let (white, fresnel) = self.terms(mu, roughness);
        (white * (1.0 - fresnel), white * fresnel)
    }

    /// Albedo with Turquin's energy compensation: `E(F0) (1 + F0 (1 - E1) / E1)`, in [0, 1].
    pub fn compensated_albedo(&self, f0: f64, mu: f64, roughness: f64) -> f64 {
        let (white, fresnel) = self.terms(mu, roughness);
        (f0 + (1.0 - f0) * fresnel) * (white + f0 * (1.0 - white))
    }

    /// Cosine-weighted averages of (E1 Q, E1, Q) over the hemisphere.
    pub fn averages(&self, roughness: f64) -> [f64; 3] {
        let roughness = fitted_roughness(roughness);
        let mut sum = [0.0; 3];
        for row in self.averages.iter().rev() {
            for (value, c) in sum.iter_mut().zip(row) {
                *value = *value * roughness + c;
            }
        }
        sum
    }

    /// Cosine-weighted average of [`Fit::compensated_albedo`].
    pub fn average_compensated_albedo(&self, f0: f64, roughness: f64) -> f64 {
        let [both, white, fresnel] = self.averages(roughness);
        both + f0 * ((white + fresnel - 2.0 * both) + f0 * (1.0 - white - fresnel + both))
    }
}

pub(super) static FIT: LazyLock<Fit> = LazyLock::new(Fit::shipped);

/// t of the fits.
const SCALED_COSINE: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1e-7, 1.0]);
/// Roughness where the fits take it: from the square root of the smallest alpha.
const FITTED_ROUGHNESS: Domain = Domain::Uniform(0.0316228, 1.0, &[0.0316228, 1.0]);

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("ggx_fit_white", &[SCALED_COSINE, ALPHA], |inputs| {
        let (t, alpha) = (inputs.number(), inputs.number());
        let powers = FIT.white.iter().enumerate().flat_map(|(i, row)| row.iter().enumerate().map(move |at| (i, at)));
        let sum: f64 = powers.map(|(i, (j, c))| c * t.powi(i as i32) * alpha.powi(j as i32)).sum();
        vec![sum.clamp(0.0, 1.0)]
    })
    .limit(2e-5, WHITE_ROUNDING),
    Twin::new("ggx_fit_fresnel_root", &[COSINE, SCALED_COSINE, FITTED_ROUGHNESS], |inputs| {
        let basis = fresnel_basis(inputs.number(), inputs.number(), inputs.number());
        let sum: f64 = basis.iter().zip(&FIT.fresnel).map(|(term, c)| term * c).sum();
        vec![sum.clamp(0.0, 1.0)]
    })
    .limit(2e-5, ROOT_ROUNDING),
    Twin::new("ggx_fit_averages", &[FITTED_ROUGHNESS], |inputs| FIT.averages(inputs.number()).to_vec())
        .limit(2e-5, AVERAGE_ROUNDING),
    Twin::new("ggx_albedo_terms", &[COSINE, ROUGHNESS], |inputs| {
        let (white, fresnel) = FIT.terms(inputs.number(), inputs.number());
        vec![white, fresnel]
    })
    .limit(2e-5, WHITE_ROUNDING),
    Twin::new("ggx_directional_albedo", &[COSINE, ROUGHNESS], |inputs| {
        let (scale, bias) = FIT.directional_albedo(inputs.number(), inputs.number());
        vec![scale, bias]
    })
    .limit(2e-5, WHITE_ROUNDING),
    Twin::new("ggx_average_terms", &[ROUGHNESS], |inputs| FIT.averages(inputs.number()).to_vec())
        .limit(2e-5, AVERAGE_ROUNDING),
    Twin::new("ggx_average_albedo", &[ROUGHNESS], |inputs| {
        let [both, white, _] = FIT.averages(inputs.number());
        vec![white - both, both]
    })
    .limit(2e-5, AVERAGE_ROUNDING),
    Twin::new("standard_specular_compensation", &[UNIT, UNIT], |inputs| {
        let (f0, white) = (inputs.vec3(), inputs.number());
        (1.0 + f0 * (1.0 - white) / white.max(1e-3)).to_array().to_vec()
    }),
    Twin::new("compensated_albedo", &[UNIT, UNIT, UNIT], |inputs| {
        let (f0, f90, terms) = (inputs.vec3(), inputs.number(), inputs.vec2());
        (f0.lerp(DVec3::splat(f90), terms.y) * f0.lerp(DVec3::ONE, terms.x)).to_array().to_vec()
    }),
    Twin::new("average_compensated_albedo", &[UNIT, UNIT, UNIT], |inputs| {
        let (f0, f90, terms) = (inputs.vec3(), inputs.number(), inputs.vec3());
        let (both, white, fresnel) = (terms.x, terms.y, terms.z);
        // The average of (F0 + (F90 - F0) Q) (F0 + (1 - F0) E1), term by term.
        let rest = f90 - f0;
        (f0 * f0 + f0 * (1.0 - f0) * white + rest * f0 * fresnel + rest * (1.0 - f0) * both).to_array().to_vec()
    }),
];

// A polynomial is as good as if each of its terms had been rounded once: half a unit in the last place of the sum of
// their magnitudes, all variables at their largest.

/// E1.
pub(super) const WHITE_ROUNDING: f64 = 118.0 * ULP / 2.0;
/// The root of Q.
const ROOT_ROUNDING: f64 = 1304.0 * ULP / 2.0;
/// Q = root^5, which multiplies the root's error by 5 root^4: the root is small where the terms cancel most.
pub(super) const FRESNEL_ROUNDING: f64 = 68.0 * ULP / 2.0;
/// The averages.
pub(super) const AVERAGE_ROUNDING: f64 = 173.0 * ULP / 2.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_fit_is_whole() {
        let text = include_str!("../../../shaders_glsl/lib/albedo.glsl");
        assert!(Fit::parse(text).is_some());
        assert!(Fit::parse(&text.replacen("vec4(", "vec4(1.5, ", 3)).is_none(), "a stray number must be noticed");
    }

    #[test]
    fn gauss_legendre_integrates_polynomials_exactly() {
        let rule = gauss_legendre(8);
        let integral: f64 = rule.iter().map(|(x, w)| w * x.powi(15)).sum();
        assert!((integral - 1.0 / 16.0).abs() < 1e-14, "{integral}");
    }

    #[test]
    fn quadrature_has_converged() {
        let (coarse, fine) = (gauss_legendre(96), gauss_legendre(200));
        for (mu, alpha) in
            [(1e-3, 1e-3), (1e-3, 0.3), (0.05, 1.0), (0.3, 0.1), (0.7, 0.1), (0.7, 0.03), (1.0, 0.01), (1.0, 1.0)]
        {
            let (a, b) = (directional_albedo(mu, alpha, &coarse), directional_albedo(mu, alpha, &fine));
            assert!((a.0 - b.0).abs() < 1e-4 && (a.1 - b.1).abs() < 1e-4, "{mu} {alpha}: {a:?} {b:?}");
        }
    }

    #[test]
    fn the_magnitudes_are_those_of_the_fit() {
        let near = |rounding: f64, sum: f64| assert!((0.98..=1.0).contains(&(sum / (rounding * 2.0 / ULP))), "{sum}");
        near(WHITE_ROUNDING, FIT.white.iter().flatten().map(|c| c.abs()).sum());
        near(ROOT_ROUNDING, FIT.fresnel.iter().map(|c| c.abs()).sum());
        near(AVERAGE_ROUNDING, FIT.averages.iter().map(|row| row[1].abs()).sum());
        let mut most: f64 = 0.0;
        for index in 0..250_000 {
            let (mu, roughness) = (f64::from(index % 500) / 499.0, f64::from(index / 500) / 499.0);
            let r = fitted_roughness(roughness);
            let basis = fresnel_basis(mu, scaled_cosine(mu, r * r), r);
            let terms = basis.into_iter().zip(FIT.fresnel).map(|(term, c)| c * term);
            let root = terms.clone().sum::<f64>().clamp(0.0, 1.0);
            most = most.max(5.0 * root.powi(4) * terms.map(f64::abs).sum::<f64>());
        }
        near(FRESNEL_ROUNDING, most);
    }
}
