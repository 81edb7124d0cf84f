//! Cotton: cloth with fuzz, from jersey to felt.

use super::kind::{Map, Number, OneOf, Rgb, Switch};
use super::sheen::SheenModel;
use crate::asset::TextureRef;
use glam::Vec3;

const UNBOUNDED: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
const UNIT: (f64, f64) = (0.0, 1.0);

crate::parameters! {
    /// Cotton. The surface's roughness is that of the pile that lies on the cloth; base colour and maps are the surface's.
    pub struct Cotton {
        sheen: SheenModel as OneOf<SheenModel> = SheenModel::Ltc, UNBOUNDED, "", "How the fuzz scatters light: ltc, charlie or inverted.";
        sheen_color: Vec3 as Rgb = Vec3::splat(0.25), UNIT, "", "Linear colour of the standing fibres: a soft glow towards the outline; black: no fibres stand.";
        sheen_color_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Colour of the standing fibres, sRGB-decoded; times sheen_color.";
        sheen_map: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: R is how densely fibres stand, the structure of the fuzz; times sheen_color.";
        sheen_roughness: f32 as Number = 0.5, UNIT, "", "How wide the glow of the standing fibres is: 0 a thin rim, 1 all over.";
        sheen_roughness_map: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: R is a factor on sheen_roughness.";
        env_rotation: f32 as Number = 0.0, (-36e3, 36e3), "deg", "Turns the environment that this cloth sees, counter-clockwise seen from above.";
        classic: bool as Switch = false, UNBOUNDED, "", "The formula of older engines, for looks that were tuned to it: it gains light and knows no other sheen.";
    }
}
