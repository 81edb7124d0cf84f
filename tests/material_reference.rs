//! The double-precision twins meet the limits of the shading formulas: normalised, reciprocal, never gaining energy,
//! finite at the extremes; and what the shader does in single precision stays beside them.

use glam::DVec3;
use std::f64::consts::PI;
use vair::measure::twin::albedo::{Fit, directional_albedo, gauss_legendre, largest_roughness_power, scaled_cosine};
use vair::measure::twin::ggx::*;
use vair::measure::twin::standard::Surface;
use vair::measure::twin::{color, tone_mapping};

/// Seeded numbers in [0, 1): SplitMix64 (Steele, Lea & Flood 2014, "Fast Splittable Pseudorandom Number Generators").
fn random() -> impl FnMut() -> f64 {
    let mut state = 7u64;
    move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn direction(cosine: f64, azimuth: f64) -> DVec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    DVec3::new(sine * azimuth.cos(), sine * azimuth.sin(), cosine)
}

/// Integral over all half vectors of `value(h) d omega`, in slopes stretched by the lobe: slope = alpha rho, rho = u / (1 - u).
fn over_half_vectors(ax: f64, ay: f64, points: usize, value: impl Fn(DVec3) -> f64) -> f64 {
    let rule = gauss_legendre(points);
    let mut sum = 0.0;
    for &(u, weight_u) in &rule {
        let rho = u / (1.0 - u);
        for turn in 0..2 * points {
            let (sin, cos) = (2.0 * PI * (turn as f64 + 0.5) / (2 * points) as f64).sin_cos();
            let h = DVec3::new(ax * rho * cos, ay * rho * sin, 1.0).normalize();
            let area = ax * ay * rho / ((1.0 - u) * (1.0 - u)) * h.z.powi(3);
            sum += weight_u * PI / points as f64 * area * value(h);
        }
    }
    sum
}

/// Single-scattering albedo with F = 1, by the twin's own D and G.
fn albedo_of_the_lobe(v: DVec3, ax: f64, ay: f64, points: usize) -> f64 {
    over_half_vectors(ax, ay, points, |h| {
        let v_dot_h = v.dot(h);
        if v_dot_h <= 0.0 {
            return 0.0;
        }
        let l = 2.0 * v_dot_h * h - v;
        ndf(h, ax, ay) * masking_shadowing_times_cosine(v, l, ax, ay) * 4.0 * v_dot_h
    })
}

#[test]
fn ggx_norm() {
    for roughness in [0.05, 0.3, 0.6, 1.0] {
        for anisotropy in [0.0, 0.5, -0.9] {
            let (ax, ay) = anisotropic_alpha(roughness, anisotropy);
            let norm = over_half_vectors(ax, ay, 64, |h| ndf(h, ax, ay) * h.z);
            assert!((norm - 1.0).abs() <= 1e-6, "r {roughness} a {anisotropy}: {norm}");
        }
    }
}

#[test]
fn ggx_norm_extreme() {
    for roughness in [0.0, 0.1, 0.5, 1.0] {
        for anisotropy in [0.999, -0.999, 1.0, -1.0] {
            let (ax, ay) = anisotropic_alpha(roughness, anisotropy);
            let norm = over_half_vectors(ax, ay, 64, |h| ndf(h, ax, ay) * h.z);
            assert!((norm - 1.0).abs() <= 1e-4, "r {roughness} a {anisotropy}: {norm}");
        }
    }
}

/// D and G of the shader, in single precision, from the formulas.
fn single(v: [f32; 3], l: [f32; 3], h: [f32; 3], ax: f32, ay: f32) -> (f32, f32) {
    let s = (h[0] / ax) * (h[0] / ax) + (h[1] / ay) * (h[1] / ay) + h[2] * h[2];
    let q = 1.0 / (s * (ax * ay).sqrt());
    let length = |w: [f32; 3]| ((ax * w[0]) * (ax * w[0]) + (ay * w[1]) * (ay * w[1]) + w[2] * w[2]).sqrt();
    (q * q / std::f32::consts::PI, 0.5 * l[2] / (l[2] * length(v) + v[2] * length(l)).max(1e-30))
}

#[test]
fn ggx_fp32_and_reciprocity() {
    let mut next = random();
    let (mut worst, mut worst_swap) = (0.0f64, 0.0f64);
    for index in 0..1 << 18 {
        let roughness = [0.0, 1.0, next(), next() * 0.1][index % 4];
        let anisotropy = [1.0, -1.0, 2.0 * next() - 1.0][index % 3];
        let mut cosine = || [1e-7, 1.0, next(), next() * 1e-3][(next() * 4.0) as usize];
        let (mu_v, mu_l) = (cosine(), cosine());
        let v = direction(mu_v, 2.0 * PI * next()).as_vec3();
        let l = direction(mu_l, 2.0 * PI * next()).as_vec3();
        let sum = v + l;
        if sum.length() < 1e-3 {
            continue;
        }
        let h = sum.normalize();
        let (ax, ay) = anisotropic_alpha(roughness, anisotropy);
        let (ax, ay) = (ax as f32, ay as f32);
        let (d, g) = single(v.to_array(), l.to_array(), h.to_array(), ax, ay);
        assert!(d.is_finite() && g.is_finite(), "r {roughness} a {anisotropy} mu {mu_v} {mu_l}");
        let (wide_x, wide_y) = (f64::from(ax), f64::from(ay));
        let true_d = ndf(h.as_dvec3(), wide_x, wide_y);
        let true_g = masking_shadowing_times_cosine(v.as_dvec3(), l.as_dvec3(), wide_x, wide_y);
        // Lambda of a horizontal direction cancels in no form of it; the twin's own rounding is far below the limit.
        worst = worst.max((f64::from(d) / true_d - 1.0).abs()).max((f64::from(g) / true_g - 1.0).abs());
        let (_, back) = single(l.to_array(), v.to_array(), h.to_array(), ax, ay);
        let swap = (f64::from(g) / f64::from(l.z)) / (f64::from(back) / f64::from(v.z));
        worst_swap = worst_swap.max((swap - 1.0).abs());
    }
    assert!(worst <= 2e-5, "largest relative error {worst:e}");
    assert!(worst_swap <= 1e-6, "largest relative difference {worst_swap:e}");
}

#[test]
fn ggx_furnace_single_scattering() {
    for roughness in [0.0, 0.2, 0.5, 1.0] {
        for anisotropy in [0.0, 0.7, -1.0, 1.0] {
            let (ax, ay) = anisotropic_alpha(roughness, anisotropy);
            for mu in [1e-7, 1e-3, 0.1, 0.5, 1.0] {
                for azimuth in [0.0, 0.6, PI / 2.0] {
                    let albedo = albedo_of_the_lobe(direction(mu, azimuth), ax, ay, 96);
                    assert!(albedo <= 1.0 + 1e-3, "r {roughness} a {anisotropy} mu {mu}: {albedo}");
                }
            }
        }
    }
}

#[test]
fn two_quadratures_agree() {
    let rule = gauss_legendre(96);
    for (mu, alpha) in [(0.05, 0.3), (0.3, 1.0), (0.7, 0.1), (1.0, 1.0)] {
        let (scale, bias) = directional_albedo(mu, alpha, &rule);
        let direct = albedo_of_the_lobe(direction(mu, 0.0), alpha, alpha, 256);
        assert!((scale + bias - direct).abs() < 1e-4, "mu {mu} alpha {alpha}: {} {direct}", scale + bias);
    }
    let (scale, bias) = directional_albedo(1.0, 1.0, &rule);
    assert!((scale + bias - 0.307).abs() < 1e-3, "published value 0.307, here {}", scale + bias);
}

/// (roughness, mu) between and beyond the nodes of the fit.
fn fit_points() -> Vec<(f64, f64)> {
    let mut next = random();
    let mut points: Vec<_> = (0..1500).map(|_| (next(), 10f64.powf(-3.0 * next()))).collect();
    for roughness in [0.0, 0.0316, 0.032, 0.1, 0.5, 1.0] {
        points.extend([1e-3, 2e-3, 0.01, 0.1, 0.5, 0.99, 1.0].map(|mu| (roughness, mu)));
    }
    points
}

#[test]
fn fit_limits() {
    let (fit, rule) = (Fit::shipped(), gauss_legendre(64));
    for (roughness, mu) in fit_points() {
        let (scale, bias) = directional_albedo(mu, alpha_of_roughness(roughness), &rule);
        let (fit_scale, fit_bias) = fit.directional_albedo(mu, roughness);
        let at = format!("r {roughness} mu {mu}: {scale} {bias}, fit {fit_scale} {fit_bias}");
        assert!((fit_scale - scale).abs() <= 0.004 && (fit_bias - bias).abs() <= 0.004, "{at}");
        let ratio = (scale + bias) / (fit_scale + fit_bias);
        // Also the multiple-scattering furnace at F0 = 1, which is this ratio.
        assert!((ratio - 1.0).abs() <= 0.01 && ratio <= 1.001, "{at}");
    }
}

#[test]
fn fit_in_single_precision() {
    let fit = Fit::shipped();
    for (roughness, mu) in fit_points() {
        let alpha = alpha_of_roughness(roughness) as f32;
        let (mu_32, r) = (mu as f32, alpha.sqrt());
        let t = scaled_cosine(mu, f64::from(alpha)) as f32;
        let white = fit.white.iter().rev().fold(0.0f32, |sum, c| {
            let [a, b, c, d] = c.map(|c| c as f32);
            sum * t + (a + alpha * b + alpha * alpha * c + alpha * alpha * alpha * d)
        });
        let mut q = 0.0f32;
        let mut coefficients = fit.fresnel.iter().map(|&c| c as f32);
        for i in (0..=5).rev() {
            let mut row = 0.0f32;
            for j in (0..=5 - i).rev() {
                row = row * t
                    + (0..=largest_roughness_power(i, j) as i32)
                        .map(|k| coefficients.next().unwrap() * r.powi(k))
                        .sum::<f32>();
            }
            q = q * mu_32 + row;
        }
        let (wide_white, wide_fresnel) = fit.terms(mu, roughness);
        let (white, fresnel) = (white.clamp(0.0, 1.0), q.clamp(0.0, 1.0).powi(5));
        let error = (f64::from(white) - wide_white).abs().max((f64::from(fresnel) - wide_fresnel).abs());
        assert!(error < 5e-5, "r {roughness} mu {mu}: {error:e}");
    }
}

#[test]
fn anisotropy_swaps_and_vanishes() {
    let mut next = random();
    for _ in 0..1 << 14 {
        let (roughness, anisotropy) = (next(), 2.0 * next() - 1.0);
        let (v, l) = (direction(next(), 2.0 * PI * next()), direction(next(), 2.0 * PI * next()));
        let h = half_vector(v, l);
        let lobe = |v: DVec3, l: DVec3, h: DVec3, (ax, ay): (f64, f64)| {
            ndf(h, ax, ay) * masking_shadowing_times_cosine(v, l, ax, ay)
        };
        let turned = |w: DVec3| DVec3::new(w.y, -w.x, w.z);
        let (here, there) = (
            lobe(v, l, h, anisotropic_alpha(roughness, anisotropy)),
            lobe(turned(v), turned(l), turned(h), anisotropic_alpha(roughness, -anisotropy)),
        );
        assert!((here - there).abs() <= 1e-5 * here, "{here} {there}");
        let alpha = alpha_of_roughness(roughness);
        let (round, plain) = (lobe(v, l, h, anisotropic_alpha(roughness, 0.0)), lobe(v, l, h, (alpha, alpha)));
        assert!((round - plain).abs() <= 1e-6 * plain, "{round} {plain}");
    }
}

#[test]
fn mirror_and_opposed() {
    for mu in [1e-7, 1e-3, 0.5, 1.0] {
        let (v, l) = (direction(mu, 0.0), direction(mu, PI));
        let peak = ndf(half_vector(v, l), SMALLEST_ALPHA, SMALLEST_ALPHA)
            * masking_shadowing_times_cosine(v, l, SMALLEST_ALPHA, SMALLEST_ALPHA);
        assert!(peak.is_finite() && peak <= 0.5 / (PI * 1e-9), "{peak}");
    }
    let v = direction(0.4, 1.0);
    assert_eq!(half_vector(v, -v), DVec3::ZERO);
    assert_eq!(ndf(DVec3::ZERO, 0.1, 0.1), 0.0);
}

#[test]
fn schlick_by_multiplication() {
    let mut next = random();
    for _ in 0..1 << 16 {
        let f = next() as f32;
        let f2 = f * f;
        let (product, exact) = (f2 * f2 * f, f64::from(f).powi(5) as f32);
        assert!((i64::from(product.to_bits()) - i64::from(exact.to_bits())).abs() <= 4, "{f}: {product} {exact}");
    }
}

/// Albedo of the whole surface in one channel: the specular part by quadrature of the truth, the diffuse by one of the
/// coupled lobe.
fn whole_albedo(fit: &Fit, surface: &Surface, mu: f64, rule: &[(f64, f64)]) -> f64 {
    let (scale, bias) = directional_albedo(mu, alpha_of_roughness(surface.roughness), rule);
    let f0 = 0.04 + (surface.base_color.x - 0.04) * surface.metallic;
    let (white, _) = fit.terms(mu, surface.roughness);
    let specular = (f0 * scale + bias) * (1.0 + f0 * (1.0 - white) / white);
    let diffuse: f64 =
        rule.iter().map(|&(mu_l, weight)| weight * 2.0 * PI * mu_l * surface.diffuse_brdf(fit, mu, mu_l).x).sum();
    specular + diffuse
}

#[test]
fn furnace_of_the_whole_surface() {
    let (fit, rule) = (Fit::shipped(), gauss_legendre(64));
    let mut next = random();
    let mut cases = Vec::new();
    for roughness in [0.0, 0.03, 0.1, 0.3, 0.6, 1.0] {
        for mu in [1e-7, 1e-3, 0.05, 0.3, 1.0] {
            for (base, metallic) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (1.0, 0.5), (0.5, 0.5), (0.0, 1.0)] {
                cases.push((roughness, mu, base, metallic));
            }
        }
    }
    cases.extend((0..400).map(|_| (next(), 10f64.powf(-4.0 * next()), next().sqrt(), next())));
    for (roughness, mu, base, metallic) in cases {
        let surface = Surface { base_color: DVec3::splat(base), metallic, roughness };
        let albedo = whole_albedo(&fit, &surface, mu, &rule);
        let at = format!("r {roughness} mu {mu} base {base} metallic {metallic}: {albedo}");
        assert!(albedo <= 1.0 + 1e-3, "{at}");
        if (1e-3..).contains(&mu) {
            let ambient = surface.ambient(&fit, mu).x;
            assert!((ambient - albedo).abs() <= 0.01, "{at}, ambient {ambient}");
        }
        if base == 1.0 && (1e-3..).contains(&mu) && (metallic == 0.0 || metallic == 1.0) {
            assert!(albedo >= 0.985, "white must stay white, {at}");
        }
    }
}

#[test]
fn the_brdf_integrates_to_its_parts() {
    let (fit, rule) = (Fit::shipped(), gauss_legendre(96));
    let surface = Surface { base_color: DVec3::splat(0.7), metallic: 0.3, roughness: 0.8 };
    for mu in [0.2, 0.9] {
        let v = direction(mu, 0.0);
        let mut direct = 0.0;
        for &(mu_l, weight) in &rule {
            for turn in 0..192 {
                let l = direction(mu_l, 2.0 * PI * (f64::from(turn) + 0.5) / 192.0);
                direct += weight * 2.0 * PI / 192.0 * surface.brdf_times_cosine(&fit, v, l).x;
            }
        }
        let parts = whole_albedo(&fit, &surface, mu, &rule);
        assert!((direct - parts).abs() < 2e-4, "mu {mu}: {direct} {parts}");
        assert_eq!(surface.brdf_times_cosine(&fit, v, -v), DVec3::ZERO);
    }
}

#[test]
fn diffuse_is_reciprocal_and_light_is_linear() {
    let fit = Fit::shipped();
    let mut next = random();
    for _ in 0..2000 {
        let surface = Surface { base_color: DVec3::new(next(), next(), next()), metallic: next(), roughness: next() };
        let (a, b) = (next(), next());
        let (there, back) = (surface.diffuse_brdf(&fit, a, b), surface.diffuse_brdf(&fit, b, a));
        assert!((there - back).abs().max_element() <= 1e-6 * there.max_element(), "{there} {back}");
        let (v, l) = (direction(a, 0.0), direction(b, 2.0 * PI * next()));
        let brdf = surface.brdf_times_cosine(&fit, v, l);
        let light = DVec3::new(3.0, 0.0, 0.5);
        let (once, twice) = (brdf * light, brdf * (2.0 * light));
        assert_eq!(once.y, 0.0, "no green light, no green");
        assert!((twice - 2.0 * once).abs().max_element() <= 1e-6 * twice.max_element());
        assert!(brdf.min_element() >= 0.0 && brdf.is_finite());
    }
}

#[test]
fn tone_maps_are_monotone_bounded_and_finite() {
    type Curve = fn(DVec3) -> DVec3;
    let curves: [(&str, Curve); 4] = [
        ("none", tone_mapping::none),
        ("aces", tone_mapping::aces),
        ("agx", tone_mapping::agx),
        ("neutral", tone_mapping::neutral),
    ];
    let mut next = random();
    for (name, curve) in curves {
        let mut before = -1.0;
        for step in 0..4000 {
            let value = 10f64.powf(-6.0 + 44.0 * f64::from(step) / 3999.0);
            let shown = curve(DVec3::splat(value));
            assert!(shown.is_finite() && shown.min_element() >= 0.0 && shown.max_element() <= 1.0, "{name} {value}");
            // The matrices of aces and agx are rounded: their greys drift by a few 1e-4 between channels.
            assert!(shown.x >= before - 1e-9, "{name} falls at {value}: {} after {before}", shown.x);
            assert!(shown.max_element() - shown.min_element() < 2e-3, "{name} tints grey {value}: {shown}");
            before = shown.x;
        }
        assert!(before > 0.97, "{name} ends at {before}");
        for _ in 0..20_000 {
            let color =
                DVec3::new(next(), next(), next()) * 10f64.powf(-6.0 + 44.0 * next()) - DVec3::splat(1e-3 * next());
            let shown = curve(color);
            assert!(shown.is_finite() && shown.min_element() >= 0.0 && shown.max_element() <= 1.0, "{name} {color}");
        }
    }
}

#[test]
fn neutral_keeps_colours_below_its_start() {
    let mut next = random();
    for _ in 0..10_000 {
        let color = DVec3::new(next(), next(), next()) * 0.8;
        let shown = tone_mapping::neutral(color);
        let least = color.min_element();
        let offset = if least < 0.08 { least - 6.25 * least * least } else { 0.04 };
        if color.max_element() - offset < 0.76 {
            assert!((shown - (color - offset)).abs().max_element() < 1e-12, "{color}: {shown}");
        }
    }
}

#[test]
fn srgb_round_trip_and_luminance() {
    for byte in 0..=255 {
        let coded = f64::from(byte) / 255.0;
        assert!((color::srgb_from_linear(color::linear_from_srgb(coded)) - coded).abs() < 1e-7);
    }
    assert!((color::linear_from_srgb(0.5) - 0.214_041_140_482_232).abs() < 1e-9);
    assert!((color::luminance(DVec3::ONE) - 1.0).abs() < 1e-12);
}
