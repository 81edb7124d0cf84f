//! Velvet: a dense pile of standing fibres, dark where it faces the eye and bright at its folds.

use super::kind::{Number, OneOf, Rgb, Switch};
use super::sheen::SheenModel;
use glam::Vec3;

const UNBOUNDED: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
const UNIT: (f64, f64) = (0.0, 1.0);

/// Roughness of the scattering fibres, thin and wide: there the sheen has fallen to half of what it is at the horizon at the
/// cosines 0.159 and 0.5, where the two rims that the classic scale blends, (1 - n.v)^4 and 1 - n.v, have.
const SCATTER_ROUGHNESS: [f32; 2] = [0.355, 0.77];

crate::parameters! {
    /// Velvet. The surface's metallic turns its colour from that of the ground to that of the pile, its roughness is the
    /// width of the pile's highlight; there is no mirror in it.
    pub struct Velvet {
        sheen: SheenModel as OneOf<SheenModel> = SheenModel::Ltc, UNBOUNDED, "", "How the pile scatters light: ltc, charlie or inverted.";
        scatter_color: Vec3 as Rgb = Vec3::splat(0.5), UNIT, "", "Linear colour of the light that the pile scatters at its rim; black: none.";
        scatter_scale: f32 as Number = 0.5, UNIT, "", "Width of that rim: 0 thin, 1 wide.";
        classic: bool as Switch = false, UNBOUNDED, "", "The formula of older engines, for looks that were tuned to it: its rim glows without light, and sheen does nothing.";
    }
}

impl Velvet {
    /// Perceptual roughness of the scattering fibres.
    pub fn scatter_roughness(&self) -> f32 {
        let [thin, wide] = SCATTER_ROUGHNESS;
        thin + (wide - thin) * self.scatter_scale
    }
}
