//! Glint: flakes on the standard surface, which is the cloth under them: sequins, lurex, glitter yarn.
//!
//! Older manuals left this family empty, so that it has no classic form. See `shaders_glsl/lib/glint.glsl` for the model.

use super::kind::{Map, Number, Rgb};
use crate::asset::TextureRef;
use glam::Vec3;
use std::f32::consts::PI;

const UNBOUNDED: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
const UNIT: (f64, f64) = (0.0, 1.0);

crate::parameters! {
    /// Flakes on cloth.
    pub struct Glint {
        density: f32 as Number = 21.0, (0.0, 32.0), "log2(1/m^2)", "Flakes per square metre, as a power of two: 14 is sequins of 8 mm, 21 glitter of 0.7 mm, 27 lurex; in metres of the rest pose.";
        coverage: f32 as Number = 0.5, (0.0, 0.9), "", "Share of the cloth that flakes cover; round flakes cover at most 0.9.";
        flake_roughness: f32 as Number = 0.5, UNIT, "", "How far flakes lean away from the cloth: the roughness of the highlight that they make up from afar.";
        microfacet_roughness: f32 as Number = 0.15, UNIT, "", "Roughness of a single flake; small flakes like mirrors flash rarely and brightly. Counts between 0.045 and 0.6 of flake_roughness.";
        flake_color: Vec3 as Rgb = Vec3::new(0.95, 0.93, 0.88), UNIT, "", "Linear colour of the metal that flakes are made of.";
        color_variation: f32 as Number = 0.2, UNIT, "", "How much darker each flake's red, green and blue may be at random: 0 all alike, 1 every colour.";
        intensity: f32 as Number = 1.0, UNIT, "", "Share of its light that a flake gives back: 1 new metal, 0 none.";
        mask_map: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: R is the share of flakes that is there, as for yarn of lurex in plain cloth; none: all.";
    }
}

/// Where flakes are and how wide they shine: what the shader needs of the parameters, evaluated once a material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flakes {
    /// Rhombi of 60 degrees a metre along their edges, one flake each.
    pub cells_per_metre: f32,
    /// GGX width of the flakes' normals.
    pub alpha: f32,
    /// Radius of a disc over the edge of its rhombus, [0, 0.5].
    pub radius: f32,
    /// How far discs stray from the middle of their rhombus, as a share of its edge, [0, 1]: they never overlap.
    pub jitter: f32,
    /// Radius of one flake's lobe, in cells of the square of normals, [0.25, 0.5].
    pub lobe: f32,
    /// [`Glint::color_variation`].
    pub variation: f32,
    /// log2 of the cells along the square of normals, and of the flakes along a tile, 2 to 8.
    pub fineness: u32,
}

/// Area of a rhombus of 60 degrees with edges of length 1, and its height.
const RHOMBUS: f32 = 0.866_025_4;
/// Radius of the bump `(1 - u)^2`, in slopes over a flake's GGX width: both fall to half at the same slope,
/// sqrt(sqrt(2) - 1) of the width and sqrt(1 - 1 / sqrt(2)) of the radius.
const BUMP: f32 = 1.189_207;
/// Normals fill a unit disc; mapped to the square with sides of length 2, it grows by the inverse of this.
const SQUARE: f32 = 0.886_226_9;
/// Fineness of the largest and the smallest lobe. Four flakes along a tile keep a disc of its size within one.
const FINENESS: (f32, f32) = (2.0, 8.0);

impl Glint {
    /// What the shader needs of the parameters, which are within their ranges.
    pub fn flakes(&self) -> Flakes {
        let width = |roughness: f32| (roughness * roughness).clamp(1e-3, 1.0);
        let radius = (self.coverage * RHOMBUS / PI).sqrt();
        let lobe = BUMP / SQUARE * width(self.microfacet_roughness) / width(self.flake_roughness);
        let fineness = (-lobe.log2()).floor().clamp(FINENESS.0, FINENESS.1);
        Flakes {
            cells_per_metre: (self.density.exp2() * RHOMBUS).sqrt(),
            alpha: width(self.flake_roughness),
            radius,
            // The nearest that neighbours come, where one strays against the other, is the height that is left.
            jitter: (1.0 - radius / (0.5 * RHOMBUS)).max(0.0),
            lobe: (lobe * (fineness - 1.0).exp2()).clamp(0.25, 0.5),
            variation: self.color_variation,
            fineness: fineness as u32,
        }
    }
}
