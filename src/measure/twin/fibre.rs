//! How the strands of fur scatter light (Marschner et al. 2003; d'Eon et al. 2011; Chiang et al. 2016; Zinke et al. 2008).

use super::domain::{Domain, ROUGHNESS, UNIT};
use super::{Rule, TestInputs, Twin};
use glam::DVec3;
use std::f64::consts::PI;

/// A lobe of one fibre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lobe {
    /// Angle from the plane across the tangent to the cone around which it lies: its sine.
    pub sine: f64,
    /// Its cosine, at least 0.
    pub cosine: f64,
    /// Variance along the fibre.
    pub variance: f64,
    /// Share of white light.
    pub share: f64,
    /// How much of it the body below leaves open, in [0, 1].
    pub seen: f64,
}

/// What the three lobes differ in: reflected, returned and transmitted light.
struct Kind {
    /// Widens the variance.
    widening: f64,
    /// Tilt by the cuticle's scales, radians.
    tilt: f64,
    /// Most of white light.
    share: f64,
    /// Means of cos(phi) and cos(2 phi) around the fibre.
    around: [f64; 2],
}

const SIDE: [f64; 2] = [1.0 / 3.0, -1.0 / 15.0];
const KINDS: [Kind; 3] = [
    Kind { widening: 1.0, tilt: -0.08, share: 0.1, around: SIDE },
    Kind { widening: 4.0, tilt: 0.12, share: 0.1, around: SIDE },
    Kind { widening: 0.25, tilt: 0.04, share: 0.3, around: [-0.8, 0.4] },
];
const WRAP: f64 = 0.3;

/// A fibre as the eye sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fibre {
    /// Of the fur, unit vector.
    pub normal: DVec3,
    /// Of the strand, unit vector.
    pub tangent: DVec3,
    /// Unit vector to the eye across the tangent; 0 where the eye looks along it.
    pub across: DVec3,
    /// Reflected, returned and transmitted light.
    pub lobes: [Lobe; 3],
}

/// Variance of the lobe R from longitudinal roughness (Chiang et al. 2016, equation 7).
pub fn variance(roughness: f64) -> f64 {
    let b = roughness.clamp(0.1, 1.0);
    (0.726 * b + 0.812 * b * b + 3.7 * b.powi(20)).powi(2)
}

/// Coefficients of I0(x) in powers of (x / 2)^2: 1 / k!^2.
const NEAR: [f64; 40] = {
    let mut series = [1.0; 40];
    let mut k = 1;
    while k < series.len() {
        series[k] = series[k - 1] / (k * k) as f64;
        k += 1;
    }
    series
};

/// Coefficients of I0(x) exp(-x) sqrt(2 pi x) in powers of 1 / x.
const FAR: [f64; 14] = {
    let mut series = [1.0; 14];
    let mut k = 1;
    while k < series.len() {
        series[k] = series[k - 1] * ((2 * k - 1) * (2 * k - 1)) as f64 / (8 * k) as f64;
        k += 1;
    }
    series
};

/// I0(x) exp(-x) for x >= 0, by its series, or from 12 by its asymptotic one, which is good to 1e-10 there.
pub fn bessel(x: f64) -> f64 {
    let sum = |series: &[f64], power: f64| series.iter().rev().fold(0.0, |sum, term| sum * power + term);
    if x < 12.0 { sum(&NEAR, 0.25 * x * x) * (-x).exp() } else { sum(&FAR, 1.0 / x) / (2.0 * PI * x).sqrt() }
}

/// Longitudinal lobe; its integral over the light's sine is 1.
pub fn along(sine: f64, cosine: f64, variance: f64, light_sine: f64, light_cosine: f64) -> f64 {
    let away = (sine - light_sine).powi(2) + (cosine - light_cosine).powi(2);
    let norm = -variance * (-2.0 / variance).exp_m1();
    bessel(cosine * light_cosine / variance) * (-away / (2.0 * variance)).exp() / norm
}

/// Azimuthal lobes per radian: reflected and returned light, and transmitted light.
pub fn around(eye_across: DVec3, light_across: DVec3) -> [f64; 2] {
    if eye_across.length_squared() < 0.5 || light_across.length_squared() < 1e-12 {
        return [0.5 / PI; 2];
    }
    let cosine = eye_across.dot(light_across) / (eye_across.length() * light_across.length());
    let half_angle = 0.5 * cosine.clamp(-1.0, 1.0).acos();
    [0.25 * half_angle.cos(), 64.0 / (35.0 * PI) * half_angle.sin().powi(8)]
}

/// How much light from that cosine the body below the fur lets by.
pub fn horizon(cosine_to_light: f64) -> f64 {
    let x = (cosine_to_light + 0.5).clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// Mean of [`horizon`] over the lobe of that kind, from mean and variance of the cosine that it sees.
fn seen(kind: &Kind, sine: f64, variance: f64, facing: f64, aside: f64) -> f64 {
    let first = 1.0 / (1.0 / variance).tanh() - variance;
    let second = 1.0 - 3.0 * variance * first;
    let (mean_sine, mean_square) = (first * sine, ((1.0 - second) / 3.0 + second * sine * sine).clamp(0.0, 1.0));
    let [once, twice] = kind.around;
    let across = (1.0 - mean_square).sqrt() * once * aside;
    let mean = mean_sine * facing + across;
    let square_across = 0.5 * (1.0 - facing * facing) + twice * (aside * aside - 0.5 * (1.0 - facing * facing));
    let spread =
        facing * facing * (mean_square - mean_sine * mean_sine) + (1.0 - mean_square) * square_across - across * across;
    let x = (mean / (2.1 * (spread.max(0.0) + 0.08).sqrt())).clamp(-1.0, 1.0);
    0.5 + 0.75 * x - 0.25 * x.powi(3)
}

/// The same for the three lobes.
pub fn seen_of_lobes(sine: DVec3, variance: DVec3, facing: f64, aside: f64) -> [f64; 3] {
    [0, 1, 2].map(|lobe| seen(&KINDS[lobe], sine[lobe], variance[lobe], facing, aside))
}

/// Diffuse light that fur of that optical depth leaves.
pub fn passed_on(color: f64, depth: f64) -> f64 {
    (-depth * (1.5 - 0.5 * color)).exp()
}

/// Light that went straight on through fur of that optical depth, and through one fibre.
pub fn ahead(transmittance: f64, depth: f64) -> f64 {
    transmittance * (-depth * (1.0 - 0.5 * transmittance)).exp()
}

/// What one way through a fibre leaves of light, for fur of that colour (Chiang et al. 2016, equation 9).
pub fn transmittance(color: f64) -> f64 {
    let b: f64 = 0.3;
    let scale = 5.969 - 0.215 * b + 2.532 * b.powi(2) - 10.73 * b.powi(3) + 5.574 * b.powi(4) + 0.245 * b.powi(5);
    (-1.85 * (color.clamp(1e-4, 1.0).ln() / scale).powi(2)).exp()
}

impl Fibre {
    /// `variance` is that of the reflected lobe.
    pub fn new(normal: DVec3, tangent: DVec3, to_eye: DVec3, specular: f64, transmission: f64, variance: f64) -> Self {
        let eye_sine = tangent.dot(to_eye);
        let across = to_eye - eye_sine * tangent;
        let eye_cosine = across.length();
        let across = if eye_cosine > 1e-3 { across / eye_cosine } else { DVec3::ZERO };
        let (facing, aside) = (normal.dot(tangent), normal.dot(across));
        let strengths = [specular, specular, transmission];
        let lobes = [0, 1, 2].map(|index| {
            let kind = &KINDS[index];
            let angle = kind.tilt - eye_sine.atan2(eye_cosine);
            let (sine, variance) = (angle.sin(), variance * kind.widening);
            let seen = seen(kind, sine, variance, facing, aside);
            Lobe { sine, cosine: angle.cos().abs(), variance, share: kind.share * strengths[index], seen }
        });
        Self { normal, tangent, across, lobes }
    }

    /// Radiance per unit irradiance of single scattering by the three lobes, white and unhindered but for the body below.
    pub fn lobes(&self, to_light: DVec3) -> [f64; 3] {
        let light_sine = self.tangent.dot(to_light);
        let light_across = to_light - light_sine * self.tangent;
        let [side, ahead] = around(self.across, light_across);
        let open = horizon(self.normal.dot(to_light));
        let azimuth = [side, side, ahead];
        [0, 1, 2].map(|index| {
            let Lobe { sine, cosine, variance, share, .. } = self.lobes[index];
            share * open * azimuth[index] * along(sine, cosine, variance, light_sine, light_across.length())
        })
    }

    /// Diffuse kernel, per steradian; its integral over all directions is 1.
    pub fn diffuse(&self, to_light: DVec3, light_cosine: f64) -> f64 {
        let cosine = self.normal.dot(to_light);
        let wrapped = (cosine + WRAP).max(0.0) / (PI * (1.0 + WRAP).powi(2));
        let cylindrical = 2.0 / (PI * PI) * light_cosine * horizon(cosine);
        wrapped + 0.35 * (cylindrical - wrapped)
    }

    /// Share of white light that is left for the diffuse part; `margin` 1 takes off what [`Lobe::seen`] may err by.
    pub fn rest(&self, margin: f64) -> f64 {
        let lobes: f64 = self.lobes.iter().map(|lobe| lobe.share).sum();
        let seen: f64 = self.lobes.iter().map(|lobe| lobe.share * lobe.seen).sum();
        1.0 - seen - margin * (0.08 * lobes).min(0.024)
    }

    /// Radiance per unit irradiance of strands of that colour (one channel), below fur of that optical depth.
    pub fn scattering(&self, color: f64, to_light: DVec3, depth: f64) -> f64 {
        let [reflected, returned, transmitted] = self.lobes(to_light);
        let once = transmittance(color);
        let diffuse = color * self.rest(1.0) * self.diffuse(to_light, self.tangent.cross(to_light).length());
        (-depth).exp() * (reflected + returned * once * once)
            + transmitted * ahead(once, depth)
            + passed_on(color, depth) * diffuse
    }

    /// The same for an environment, of which the diffuse part, the transmitted lobe and the highlights see those means.
    pub fn environment(&self, color: f64, diffuse: f64, behind: f64, mirrored: f64, depth: f64) -> f64 {
        let [reflected, returned, transmitted] = self.lobes.map(|lobe| lobe.share * lobe.seen);
        let once = transmittance(color);
        (-depth).exp() * (reflected + returned * once * once) * mirrored
            + transmitted * ahead(once, depth) * behind
            + passed_on(color, depth) * self.rest(0.0) * color * diffuse
    }
}

const SINE: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, -0.0, 1e-40, 1e-7, 0.5, 1.0]);
/// Of the three lobes at roughness 0.1 to 1.
const VARIANCE: Domain = Domain::Log(1.6e-3, 112.0, &[1.6e-3, 112.0]);
/// Of the lobe R.
const VARIANCE_OF_R: Domain = Domain::Log(6.5e-3, 28.0, &[6.5e-3, 28.0]);
/// And far below: what the longitudinal lobe itself stands.
const ANY_VARIANCE: Domain = Domain::Log(1e-7, 112.0, &[1e-7, 4.0, 112.0]);
const DEPTH: Domain = Domain::Log(1e-3, 50.0, &[0.0, 1e-40, 1e-7, 1e30]);
const SHARE: Domain = Domain::Uniform(0.0, 0.3, &[0.0, 0.1, 0.3]);
/// In the order of the shader's struct.
const FIBRE: [Domain; 8] =
    [Domain::Direction, Domain::Direction, Domain::DirectionOrZero, SINE, UNIT, VARIANCE, SHARE, UNIT];

fn fibre(inputs: &mut TestInputs) -> Fibre {
    let (normal, tangent, across) = (inputs.vec3(), inputs.vec3(), inputs.vec3());
    let [sine, cosine, variance, share, seen] = std::array::from_fn(|_| inputs.vec3());
    let lobes = [0, 1, 2].map(|index| Lobe {
        sine: sine[index],
        cosine: cosine[index],
        variance: variance[index],
        share: share[index],
        seen: seen[index],
    });
    Fibre { normal, tangent, across, lobes }
}

fn of_colors(color: DVec3, value: impl Fn(f64) -> f64) -> Vec<f64> {
    color.to_array().map(value).to_vec()
}

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("fibre_variance", &[ROUGHNESS], |inputs| vec![variance(inputs.number())]),
    // Abramowitz & Stegun's bound, 1.9e-7, is one of sqrt(x) times this.
    Twin::new("fibre_bessel", &[Domain::Log(1e-4, 1e7, &[0.0, 1e-40, 3.75, 1e7])], |inputs| {
        of_colors(inputs.vec3(), bessel)
    }),
    Twin::new("fibre_along", &[SINE, UNIT, ANY_VARIANCE, SINE, UNIT], |inputs| {
        let (sine, cosine, variance) = (inputs.vec3(), inputs.vec3(), inputs.vec3());
        let (light_sine, light_cosine) = (inputs.number(), inputs.number());
        [0, 1, 2].map(|at| along(sine[at], cosine[at], variance[at], light_sine, light_cosine)).to_vec()
    }),
    Twin::new(
        "fibre_around",
        &[Domain::DirectionOrZero, Domain::Uniform(-0.6, 0.6, &[-0.5, 0.0, 1e-40, 0.5])],
        |inputs| {
            let [side, ahead] = around(inputs.vec3(), inputs.vec3());
            vec![side, side, ahead]
        },
    ),
    Twin::new("fibre_horizon", &[SINE], |inputs| vec![horizon(inputs.number())]),
    Twin::new("fibre_seen", &[SINE, VARIANCE, SINE, SINE], |inputs| {
        let (sine, variance) = (inputs.vec3(), inputs.vec3());
        seen_of_lobes(sine, variance, inputs.number(), inputs.number()).to_vec()
    })
    .limit(2e-5, 2e-5),
    Twin::new(
        "fibre_to_eye",
        &[Domain::Direction, Domain::Direction, Domain::Direction, UNIT, UNIT, VARIANCE_OF_R],
        |inputs| {
            let (normal, tangent, to_eye) = (inputs.vec3(), inputs.vec3(), inputs.vec3());
            let fibre = Fibre::new(normal, tangent, to_eye, inputs.number(), inputs.number(), inputs.number());
            let of_lobes = |value: fn(Lobe) -> f64| fibre.lobes.map(value);
            [
                fibre.normal.to_array(),
                fibre.tangent.to_array(),
                fibre.across.to_array(),
                of_lobes(|lobe| lobe.sine),
                of_lobes(|lobe| lobe.cosine),
                of_lobes(|lobe| lobe.variance),
                of_lobes(|lobe| lobe.share),
                of_lobes(|lobe| lobe.seen),
            ]
            .concat()
        },
    )
    .limit(2e-5, 2e-5)
    .rule(Rule::Stepped(4)),
    Twin::new("fibre_transmittance", &[UNIT], |inputs| of_colors(inputs.vec3(), transmittance)),
    Twin::new("fibre_passed_on", &[UNIT, DEPTH], |inputs| {
        let (color, depth) = (inputs.vec3(), inputs.number());
        of_colors(color, |color| passed_on(color, depth))
    }),
    Twin::new("fibre_ahead", &[UNIT, DEPTH], |inputs| {
        let (transmittance, depth) = (inputs.vec3(), inputs.number());
        of_colors(transmittance, |transmittance| ahead(transmittance, depth))
    }),
    Twin::new(
        "fibre_diffuse",
        &[FIBRE[0], FIBRE[1], FIBRE[2], FIBRE[3], FIBRE[4], FIBRE[5], FIBRE[6], FIBRE[7], Domain::Direction, UNIT],
        |inputs| {
            let fibre = fibre(inputs);
            vec![fibre.diffuse(inputs.vec3(), inputs.number())]
        },
    ),
    Twin::new(
        "fibre_rest",
        &[FIBRE[0], FIBRE[1], FIBRE[2], FIBRE[3], FIBRE[4], FIBRE[5], FIBRE[6], FIBRE[7], UNIT],
        |inputs| {
            let fibre = fibre(inputs);
            vec![fibre.rest(inputs.number())]
        },
    ),
    // Sines of directions are off by two units in the last place of 1, over a deviation of 0.04: 4e-5 of the lobe six
    // deviations out, where nothing is left of it.
    Twin::new(
        "fibre_scattering",
        &[
            FIBRE[0],
            FIBRE[1],
            FIBRE[2],
            FIBRE[3],
            FIBRE[4],
            FIBRE[5],
            FIBRE[6],
            FIBRE[7],
            UNIT,
            Domain::Direction,
            DEPTH,
        ],
        |inputs| {
            let (fibre, color, to_light) = (fibre(inputs), inputs.vec3(), inputs.vec3());
            let depth = inputs.number();
            of_colors(color, |color| fibre.scattering(color, to_light, depth))
        },
    )
    .limit(6e-5, 2e-6),
    Twin::new(
        "fibre_environment",
        &[
            FIBRE[0], FIBRE[1], FIBRE[2], FIBRE[3], FIBRE[4], FIBRE[5], FIBRE[6], FIBRE[7], UNIT, UNIT, UNIT, UNIT,
            DEPTH,
        ],
        |inputs| {
            let (fibre, color) = (fibre(inputs), inputs.vec3());
            let (diffuse, ahead, mirrored, depth) = (inputs.vec3(), inputs.vec3(), inputs.vec3(), inputs.number());
            [0, 1, 2].map(|at| fibre.environment(color[at], diffuse[at], ahead[at], mirrored[at], depth)).to_vec()
        },
    ),
];
