//! Fits the directional albedo of GGX and prints the text that stands between `// fit: begin` and `// fit: end` in
//! `shaders_glsl/lib/albedo.glsl`: `cargo run --example fit_albedo`.
//!
//! Minimax fits by iteratively reweighted least squares (Lawson 1961). Limits are unequal on purpose: where a fit is
//! below the truth the surface would gain energy, so that side is held closer than the other.

use vair::measure::twin::albedo::{
    AVERAGE_TERMS, FRESNEL_DEGREE, FRESNEL_TERMS, Fit, WHITE_ROWS, directional_albedo, fitted_roughness, fresnel_basis,
    gauss_legendre, largest_roughness_power, scaled_cosine,
};
use vair::measure::twin::ggx::alpha_of_roughness;

struct Sample {
    mu: f64,
    roughness: f64,
    scale: f64,
    bias: f64,
}

fn main() {
    let samples = samples();
    let mut fit =
        Fit { white: [[0.0; 4]; WHITE_ROWS], fresnel: [0.0; FRESNEL_TERMS], averages: [[0.0; 3]; AVERAGE_TERMS] };

    let rows = samples.iter().map(|s| white_basis(s.mu, s.roughness)).collect();
    let targets = samples.iter().map(|s| s.scale + s.bias).collect::<Vec<_>>();
    let limits = targets.iter().map(|&e| (0.0007 * e, (0.009 * e).min(0.003))).collect::<Vec<_>>();
    for (index, c) in minimax(rows, &targets, &limits).into_iter().enumerate() {
        fit.white[index / 4][index % 4] = c;
    }

    // What the iteration left below its limit is lifted out as a whole: there the surface would gain energy.
    let lack = samples.iter().map(|s| (s.scale + s.bias) / fit.terms(s.mu, s.roughness).0).fold(0.0, f64::max);
    fit.white.iter_mut().flatten().for_each(|c| *c *= (lack / 1.0007).max(1.0));

    // The Fresnel share corrects for what the white fit misses: its target is the bias itself.
    let rows = samples
        .iter()
        .map(|s| fresnel_basis(s.mu, scaled_cosine(s.mu, alpha_of_roughness(s.roughness)), s.roughness).to_vec());
    let (mut targets, mut limits) = (Vec::new(), Vec::new());
    for s in &samples {
        let (white, _) = fit.terms(s.mu, s.roughness);
        let q = (s.bias / white).clamp(0.0, 1.0).powf(0.2);
        // d bias / d q, floored: where the bias is next to nothing q may be anything small.
        let slope = 5.0 * q.max(0.3).powi(4) * white;
        targets.push(q);
        limits.push((0.0006 / slope, 0.0025 / slope));
    }
    fit.fresnel.copy_from_slice(&minimax(rows.collect(), &targets, &limits));

    // Averages are those of the fit, not of the truth, so that the diffuse coupling integrates to one.
    let rule = gauss_legendre(64);
    let knots =
        (0..=60).map(|i| fitted_roughness(0.0) + (1.0 - fitted_roughness(0.0)) * i as f64 / 60.0).collect::<Vec<_>>();
    for part in 0..3 {
        let rows = knots.iter().map(|&r| (0..AVERAGE_TERMS as i32).map(|i| r.powi(i)).collect()).collect();
        let targets = knots
            .iter()
            .map(|&r| {
                rule.iter()
                    .map(|&(mu, weight)| {
                        let (white, fresnel) = fit.terms(mu, r);
                        2.0 * mu * weight * [white * fresnel, white, fresnel][part]
                    })
                    .sum()
            })
            .collect::<Vec<f64>>();
        for (index, c) in minimax(rows, &targets, &vec![(1.0, 1.0); knots.len()]).into_iter().enumerate() {
            fit.averages[index][part] = c;
        }
        let error = knots.iter().zip(&targets).map(|(&r, t)| (fit.averages(r)[part] - t).abs()).fold(0.0, f64::max);
        eprintln!("average {part}: max error {error:.1e}");
    }

    print(&fit);
    let worst = |error: &dyn Fn(&Sample, (f64, f64)) -> f64| {
        samples.iter().map(|s| error(s, fit.directional_albedo(s.mu, s.roughness))).fold(0.0, f64::max)
    };
    eprintln!("scale: max error {:.5}", worst(&|s, e| (e.0 - s.scale).abs()));
    eprintln!("bias: max error {:.5}", worst(&|s, e| (e.1 - s.bias).abs()));
    eprintln!("sum: max relative error {:.5}", worst(&|s, e| ((e.0 + e.1) / (s.scale + s.bias) - 1.0).abs()));
    eprintln!("energy gained, dielectric: {:.5}", worst(&|s, e| 0.04 * (s.scale - e.0) + s.bias - e.1));
}

/// The grid: dense in mu where the albedo turns, down to 1e-4.
fn samples() -> Vec<Sample> {
    let rule = gauss_legendre(96);
    let roughness = (0..=36).map(|i| fitted_roughness(0.0) + (1.0 - fitted_roughness(0.0)) * i as f64 / 36.0);
    let mu = (0..36).map(|i| 10f64.powf(-4.0 + 3.0 * i as f64 / 36.0)).chain((0..=36).map(|i| 0.1 + 0.025 * i as f64));
    let mu = mu.collect::<Vec<_>>();
    roughness
        .flat_map(|roughness| mu.iter().map(move |&mu| (roughness, mu.min(1.0))))
        .map(|(roughness, mu)| {
            let (scale, bias) = directional_albedo(mu, alpha_of_roughness(roughness), &rule);
            Sample { mu, roughness, scale, bias }
        })
        .collect()
}

fn white_basis(mu: f64, roughness: f64) -> Vec<f64> {
    let alpha = alpha_of_roughness(roughness);
    let t = scaled_cosine(mu, alpha);
    (0..WHITE_ROWS as i32).flat_map(|i| (0..4).map(move |j| t.powi(i) * alpha.powi(j))).collect()
}

/// Coefficients whose error lies in `target - limits.0 ..= target + limits.1`, stretched as little as possible.
fn minimax(rows: Vec<Vec<f64>>, targets: &[f64], limits: &[(f64, f64)]) -> Vec<f64> {
    let centre = targets.iter().zip(limits).map(|(t, (below, above))| t + 0.5 * (above - below)).collect::<Vec<_>>();
    let mut weights = vec![1.0f64; rows.len()];
    let mut best = (f64::INFINITY, Vec::new());
    for _ in 0..1000 {
        let solution = least_squares(&rows, &centre, &weights);
        let errors = rows.iter().zip(&centre).zip(limits).map(|((row, centre), (below, above))| {
            let value: f64 = row.iter().zip(&solution).map(|(a, b)| a * b).sum();
            (value - centre).abs() / (0.5 * (above + below))
        });
        let errors = errors.collect::<Vec<_>>();
        let worst = errors.iter().copied().fold(0.0, f64::max);
        for (weight, error) in weights.iter_mut().zip(&errors) {
            *weight = (*weight * (error / worst + 0.5)).max(1e-9);
        }
        let mean = weights.iter().sum::<f64>() / weights.len() as f64;
        weights.iter_mut().for_each(|weight| *weight /= mean);
        if worst < best.0 {
            best = (worst, solution);
        }
    }
    best.1
}

/// Weighted linear least squares by Householder reflections (Golub & Van Loan 2013, "Matrix Computations", 5.3).
fn least_squares(rows: &[Vec<f64>], targets: &[f64], weights: &[f64]) -> Vec<f64> {
    let columns = rows[0].len();
    let mut matrix = rows.iter().zip(targets).zip(weights).map(|((row, target), weight)| {
        row.iter().chain(std::iter::once(target)).map(|value| value * weight.sqrt()).collect::<Vec<_>>()
    });
    let mut matrix = matrix.by_ref().collect::<Vec<_>>();
    for k in 0..columns {
        let norm = matrix[k..].iter().map(|row| row[k] * row[k]).sum::<f64>().sqrt();
        let pivot = if matrix[k][k] > 0.0 { -norm } else { norm };
        let mut reflector = matrix[k..].iter().map(|row| row[k]).collect::<Vec<_>>();
        reflector[0] -= pivot;
        let square: f64 = reflector.iter().map(|x| x * x).sum();
        if square == 0.0 {
            continue;
        }
        for column in k..=columns {
            let along: f64 = reflector.iter().zip(&matrix[k..]).map(|(r, row)| r * row[column]).sum();
            for (r, row) in reflector.iter().zip(&mut matrix[k..]) {
                row[column] -= 2.0 * along / square * r;
            }
        }
    }
    let mut solution = vec![0.0; columns];
    for k in (0..columns).rev() {
        let known: f64 = (k + 1..columns).map(|j| matrix[k][j] * solution[j]).sum();
        solution[k] = (matrix[k][columns] - known) / matrix[k][k];
    }
    solution
}

/// GLSL of the three functions, coefficients in the order that [`Fit::parse`] reads.
fn print(fit: &Fit) {
    let list = |c: &[f64]| c.iter().map(|c| format!("{c:.6}")).collect::<Vec<_>>().join(", ");
    println!("float ggx_fit_white(float t, float alpha) {{");
    println!("    vec4 a = vec4(1, alpha, alpha * alpha, alpha * alpha * alpha);");
    for (index, row) in fit.white.iter().rev().enumerate() {
        let before = if index == 0 { "float e =" } else { "e = e * t +" };
        println!("    {before} dot(vec4({}), a);", list(row));
    }
    println!("    return clamp(e, 0, 1);\n}}\n");

    println!("float ggx_fit_fresnel_root(float mu, float t, float roughness) {{");
    println!("    vec4 r = vec4(1, roughness, roughness * roughness, roughness * roughness * roughness);");
    println!("    float r4 = r.z * r.z;\n    float q = 0;\n    float row = 0;");
    let mut coefficients = &fit.fresnel[..];
    for i in (0..=FRESNEL_DEGREE).rev() {
        for j in (0..=FRESNEL_DEGREE - i).rev() {
            let (now, rest) = coefficients.split_at(largest_roughness_power(i, j) + 1);
            coefficients = rest;
            let polynomial = match now {
                [a] => format!("({a:.6})"),
                [_, _] => format!("dot(vec2({}), r.xy)", list(now)),
                [_, _, _] => format!("dot(vec3({}), r.xyz)", list(now)),
                [a, b, c, d, e] => format!("dot(vec4({}), r) + r4 * ({e:.6})", list(&[*a, *b, *c, *d])),
                [a, b, c, d, e, f] => {
                    format!("dot(vec4({}), r) + r4 * ({e:.6} + ({f:.6}) * r.y)", list(&[*a, *b, *c, *d]))
                }
                _ => format!("dot(vec4({}), r)", list(now)),
            };
            println!("    row = {}{polynomial};", if j == FRESNEL_DEGREE - i { "" } else { "row * t + " });
        }
        println!("    q = q * mu + row;");
    }
    println!("    return clamp(q, 0, 1);\n}}\n");

    println!("vec3 ggx_fit_averages(float r) {{");
    for (index, row) in fit.averages.iter().rev().enumerate() {
        println!("    {} vec3({});", if index == 0 { "vec3 e =" } else { "e = e * r +" }, list(row));
    }
    println!("    return e;\n}}");
}
