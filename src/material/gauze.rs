//! Gauze: organza, chiffon, tulle. Seen through from the front, dense at its edges, aglow with light from behind.

use super::kind::{Map, Number, OneOf, Rgb, Switch};
use crate::asset::TextureRef;
use glam::Vec3;

crate::choices! {
    /// How threads lie.
    pub enum Weave {
        Matted = "matted", "Yarn lies every way: opacity depends on the angle of view alone.";
        Crossed = "crossed", "A grid of round threads along u and v: clearer between them than across.";
    }
}

const UNBOUNDED: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
const UNIT: (f64, f64) = (0.0, 1.0);

crate::parameters! {
    /// Gauze.
    pub struct Gauze {
        weave_density: f32 as Number = 6.0, (0.0, 200.0), "", "How clear the cloth is face on, the larger the clearer; it is half opaque where sin(angle)^weave_density = 1/2. 0 is opaque.";
        transmittance: f32 as Number = 1.0, (1.0, 1000.0), "", "Clears the cloth evenly at all angles: opacity is divided by log2(1 + transmittance).";
        weave: Weave as OneOf<Weave> = Weave::Matted, UNBOUNDED, "", "How the threads lie: matted or crossed.";
        mesh_map: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: R is the grid of threads (1) and holes (0).";
        anisotropy: f32 as Number = 0.8, (-1.0, 1.0), "", "Length and direction of the highlight: stretched along u of the texture at 1, round at 0, across it at -1.";
        specular_strength: f32 as Number = 1.0, (0.0, 20.0), "", "Strength of the highlight: 1 is plain plastic; 0 none.";
        specular_noise: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: R is the local strength of the highlight, 0 = half of it (none where classic), 1 = all of it.";
        scatter_color: Vec3 as Rgb = Vec3::ONE, UNIT, "", "Linear tint of the highlight alone; the cloth keeps its base colour. Black switches the highlight off.";
        scatter_strength: f32 as Number = 1.0, (0.0, 10.0), "", "Factor on that tint.";
        thread_pattern: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: where R is above thread_threshold the highlight is turned by thread_angle, so that crossing threads glint in two directions.";
        thread_threshold: f32 as Number = 0.5, UNIT, "", "Where thread_pattern parts the threads.";
        thread_angle: f32 as Number = 90.0, (-180.0, 180.0), "deg", "Angle between the crossing threads.";
        sampling_density: f32 as Number = 1.0, (1e-3, 1e4), "", "One more tiling of thread_pattern, specular_noise and mesh_map together.";
        classic: bool as Switch = false, UNBOUNDED, "", "Evaluates the formulas of older engines, which hide nothing face on and are not normalised, so that a look can be carried over.";
    }
}
