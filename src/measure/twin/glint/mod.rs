//! Twin of `glint.glsl`: flakes as points spread evenly over cloth and normals.
//!
//! Deliot & Belcour 2023, "Real-Time Rendering of Glinty Appearances using Distributed Binomial Laws on Anisotropic
//! Grids"; Kemppinen et al. 2025, "Glinty NDFs in Constant Time"; Shirley & Chiu 1997, "A Low Distortion Map Between Disk
//! and Square".

pub(super) mod disc;
pub(super) mod footprint;
mod inputs;
pub(super) mod lattice;
pub(super) mod tile;

pub use disc::{Disc, apart, cover, disc, disc_flash, discs, discs_flash};
pub use footprint::{Footprint, flake, flake_at};
pub use lattice::{chance, chart, edges, in_chart, normal, shuffle, square, unshuffle};
pub use tile::{LAST_LEVEL, Tiles, level, levels, lobe_profile, seed, shift, tile, tiles_flash};

use crate::material::Flakes;
use crate::measure::twin::albedo::Fit;
use crate::measure::twin::domain::{ALPHA, Domain, UNIT};
use crate::measure::twin::{Rule, Twin, ggx, standard};
use glam::{DVec2, DVec3};
use inputs::{FLAKES, SPREAD, WIDE_LOBE, join, read_flakes, words3};

/// Radius of the lobe, in cells, where the half vector's place in the square varies within the pixel.
pub fn lobe(flakes: &Flakes, spread: f64) -> f64 {
    let cells = 0.5 * f64::from(1u32 << flakes.fineness);
    (f64::from(flakes.lobe).powi(2) + spread.min(8.0) * cells * cells).sqrt()
}

/// Mean tint.
pub fn mean_tint(flakes: &Flakes) -> f64 {
    1.0 - 0.5 * f64::from(flakes.variation)
}

/// log2 of the cells along the square of normals, so few that a lobe of that radius, in cells of the finest, fits in one.
pub fn fineness(flakes: &Flakes, lobe: f64) -> u32 {
    // Rounding must not halve a square whose lobe just fits.
    (0..=flakes.fineness)
        .rev()
        .find(|fineness| lobe * 0.5f64.powi((flakes.fineness - fineness) as i32) <= 0.50004)
        .unwrap_or(0)
}

/// The factor on the smooth lobe in a pixel; `spread` as in [`lobe`].
pub fn flash(flakes: &Flakes, footprint: &Footprint, chart: u32, square: DVec2, spread: f64) -> DVec3 {
    let lobe = lobe(flakes, spread);
    if apart(footprint) > 0.0 {
        return discs_flash(flakes, &discs(flakes, footprint, chart), square, lobe);
    }
    let seen = Flakes { fineness: fineness(flakes, lobe), ..*flakes };
    let (first, near, far) = levels(footprint.reach, seen.fineness);
    let tiles = |level| Tiles::new(footprint.cell, seen.fineness, level, chart);
    let in_cells = lobe * 0.5f64.powi((flakes.fineness - seen.fineness) as i32);
    tiles_flash(&seen, footprint, &[(near, tiles(first)), (far, tiles(first + 1))], square, in_cells)
}

/// The smooth lobe times the cosine of `l`: compensated GGX of metal of that colour.
pub fn smooth_times_cosine(color: DVec3, compensation: DVec3, alpha: f64, v: DVec3, l: DVec3) -> DVec3 {
    let h = ggx::half_vector(v, l);
    let lobe = ggx::ndf(h, alpha, alpha) * ggx::masking_shadowing_times_cosine(v, l, alpha, alpha);
    color.map(|f0| ggx::schlick(f0, v.dot(h))) * compensation * lobe
}

/// Flakes over a standard surface.
#[derive(Debug, Clone, Copy)]
pub struct Covered {
    /// The cloth under them.
    pub cloth: standard::Surface,
    /// Linear reflectance of the flakes' metal.
    pub color: DVec3,
    /// Perceptual, of the lobe that all flakes make up.
    pub roughness: f64,
    /// Mean share of the cloth that they cover.
    pub coverage: f64,
    /// Share of its light that a flake gives back.
    pub intensity: f64,
}

impl Covered {
    /// Share of the cloth that shows, where flakes cover that share of their mean.
    fn bare(&self, cover: f64) -> f64 {
        1.0 - (self.coverage * cover).min(1.0)
    }

    /// BRDF times `mu_l` in a pixel of that cover and flash; 0 where a direction is at or below the horizon.
    pub fn brdf_times_cosine(&self, fit: &Fit, v: DVec3, l: DVec3, cover: f64, flash: DVec3) -> DVec3 {
        let metal = standard::Surface { base_color: self.color, metallic: 1.0, roughness: self.roughness };
        let compensation = metal.specular_compensation(fit, v.z);
        let lobe = smooth_times_cosine(self.color, compensation, ggx::alpha_of_roughness(self.roughness), v, l);
        self.cloth.brdf_times_cosine(fit, v, l) * self.bare(cover) + lobe * flash * self.coverage * self.intensity
    }

    /// Radiance under constant white radiance 1, of a pixel that flakes cover so and with that tint.
    pub fn ambient(&self, fit: &Fit, mu_v: f64, (tint, cover): (DVec3, f64)) -> DVec3 {
        let metal = self.color.map(|f0| fit.compensated_albedo(f0, mu_v, self.roughness));
        self.cloth.ambient(fit, mu_v) * self.bare(cover) + metal * tint * self.coverage * self.intensity
    }
}

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("glint_mean_tint", &FLAKES, |inputs| vec![mean_tint(&read_flakes(inputs))]),
    Twin::new("glint_lobe", &join::<6>(&[&FLAKES, &[SPREAD]]), |inputs| {
        vec![lobe(&read_flakes(inputs), inputs.number())]
    }),
    // Log2 is off by 2^-21 between 1/2 and 2, and the lobe that just fits is where it steps.
    Twin::new("glint_fineness", &join::<6>(&[&FLAKES, &[WIDE_LOBE]]), |inputs| {
        vec![f64::from(fineness(&read_flakes(inputs), inputs.number()))]
    })
    .limit(0.0, 0.0)
    .rule(Rule::Stepped(8)),
    Twin::new(
        "glint_smooth_times_cosine",
        &[UNIT, Domain::Uniform(1.0, 3.3, &[1.0, 3.3]), ALPHA, Domain::Hemisphere, Domain::Hemisphere],
        |inputs| {
            let (color, compensation, alpha) = (inputs.vec3(), inputs.vec3(), inputs.number());
            words3(smooth_times_cosine(color, compensation, alpha, inputs.vec3(), inputs.vec3()))
        },
    ),
];
