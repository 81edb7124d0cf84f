//! How the strands of a coat scatter light (Marschner et al. 2003; d'Eon et al. 2011; Chiang et al. 2016; Zinke et al. 2008).

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
    /// Of the coat, unit vector.
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

/// I0(x) exp(-x) for x >= 0, by its series, or far out by its asymptotic one, which is good to 1e-10 there.
pub fn bessel(x: f64) -> f64 {
    let (mut term, mut sum) = (1.0, 1.0);
    if x < 12.0 {
        let mut k = 1.0;
        while term > 1e-17 * sum {
            term *= (0.5 * x / k).powi(2);
            sum += term;
            k += 1.0;
        }
        return sum * (-x).exp();
    }
    for k in 1..14 {
        term *= f64::from(2 * k - 1).powi(2) / (f64::from(8 * k) * x);
        sum += term;
    }
    sum / (2.0 * PI * x).sqrt()
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

/// How much light from that cosine the body below the coat lets by.
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

/// Light that comes through a coat of that optical depth from fibre to fibre.
pub fn passed_on(color: f64, depth: f64) -> f64 {
    (-depth * (1.0 - 0.5 * color)).exp()
}

/// What one way through a fibre leaves of light, for a coat of that colour (Chiang et al. 2016, equation 9).
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

    /// Radiance per unit irradiance of strands of that colour (one channel), below a coat of that optical depth.
    pub fn scattering(&self, color: f64, to_light: DVec3, depth: f64) -> f64 {
        let [reflected, returned, transmitted] = self.lobes(to_light);
        let once = transmittance(color);
        let diffuse = color * self.rest(1.0) * self.diffuse(to_light, self.tangent.cross(to_light).length());
        (-depth).exp() * (reflected + returned * once * once) + passed_on(color, depth) * (transmitted * once + diffuse)
    }

    /// The same for surroundings, of which the diffuse part, the transmitted lobe and the highlights see those means.
    pub fn surroundings(&self, color: f64, diffuse: f64, ahead: f64, mirrored: f64, depth: f64) -> f64 {
        let [reflected, returned, transmitted] = self.lobes.map(|lobe| lobe.share * lobe.seen);
        let once = transmittance(color);
        (-depth).exp() * (reflected + returned * once * once) * mirrored
            + passed_on(color, depth) * (transmitted * once * ahead + self.rest(0.0) * color * diffuse)
    }
}
