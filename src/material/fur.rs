//! Fur: strands that stand on the standard surface, drawn as instanced shell layers.
//!
//! Lengyel et al. 2001, "Real-Time Fur over Arbitrary Surfaces". k is the height in the fur: 0 at the skin, 1 at the
//! tip; `map` is the strand distribution: large inside a strand, 0 between strands.

use super::kind::{Count, Distance, Length, Map, Number, OneOf, Optional, Rgb, Vector2, Vector3};
use crate::asset::TextureRef;
use glam::{Vec2, Vec3};

crate::choices! {
    /// How a strand thins towards its tip.
    pub enum Shape {
        Cone = "cone", "Strands thin evenly: shown where map >= threshold(k).";
        Paraboloid = "paraboloid", "Strands stay thick for longer: shown where map >= threshold(k^2).";
    }
}

crate::choices! {
    /// How layers meet the frame.
    pub enum Blend {
        Cutout = "cutout", "A sample is strand or it is not; writes depth.";
        Coverage = "coverage", "Partial coverage goes to the samples of the pixel; writes depth.";
        Blend = "blend", "Layers blend over each other, innermost first.";
    }
}

crate::choices! {
    /// The space that the force is given in.
    pub enum ForceSpace {
        World = "world", "The force keeps its direction when the object turns.";
        Object = "object", "The force turns with the object.";
    }
}

const UNBOUNDED: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
const UNIT: (f64, f64) = (0.0, 1.0);

crate::parameters! {
    /// Fur.
    pub struct Fur {
        length: Length as Distance = Length::Relative(0.04), (0.0, 1e6), "m", "Length of the strands; times vertex colour alpha and height_map.";
        height_map: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: R is the local length, 1 = full.";
        height_strength: f32 as Number = 1.0, UNIT, "", "How much of height_map counts.";
        layers: u32 as Count = 8, (1.0, 256.0), "", "Shell layers; layer i of N stands for the heights i/N to (i+1)/N. 8 are the knee of error over time; coarse meshes with long fur, and grazing views, gain from more.";
        distribution_map: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: R says where strands stand and how thick; its tiling sets their density. None: procedural strands.";
        strand_spacing: Length as Distance = Length::Relative(0.01), (0.0, 1e6), "m", "Mean spacing of the procedural strands.";
        thickness: f32 as Number = 0.7, UNIT, "", "Radius of the procedural strands, relative to half their spacing.";
        shape: Shape as OneOf<Shape> = Shape::Cone, UNBOUNDED, "", "How strands thin towards the tip: cone or paraboloid.";
        cutoff_start: f32 as Number = 0.0, UNIT, "", "Threshold at the root; higher thins the roots.";
        cutoff_end: f32 as Number = 1.0, UNIT, "", "Threshold at the tip; higher sharpens the tips.";
        edge_fade: f32 as Number = 0.0, UNIT, "", "Fades strands where the surface turns from the eye, softens the outline.";
        tip_fade: f32 as Number = 0.0, UNIT, "", "Transparency of the tip: coverage *= 1 - tip_fade k.";
        taper: f32 as Number = 0.0, (0.0, 16.0), "", "How fast strands thin beside shape: map -= taper k^2 / 2.";
        occlusion: f32 as Number = 0.7, UNIT, "", "Darkness of the root, 1 = darkest: light *= lerp(1 - occlusion, 1, k).";
        base_color: Option<Vec3> as Optional<Rgb> = None, UNIT, "", "Linear colour of the strands, in place of the surface's colour and texture; none: those.";
        base_color_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Colour of the strands, sRGB-decoded; none: the surface's own texture.";
        root_color: Vec3 as Rgb = Vec3::ONE, UNIT, "", "Factor on the base colour at the root.";
        tip_color: Vec3 as Rgb = Vec3::ONE, UNIT, "", "Factor on the base colour at the tip.";
        color_variation: f32 as Number = 0.2, UNIT, "", "Variation of brightness from strand to strand.";
        spot_color: Vec3 as Rgb = Vec3::ZERO, UNIT, "", "Linear colour of the fur pattern.";
        spot_map: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: R is the weight of spot_color over the base colour of the strands (the skin has none); none: no spots.";
        force: Vec3 as Vector3 = Vec3::NEG_Y, (-1e3, 1e3), "", "Direction of a constant force, gravity by default.";
        force_strength: f32 as Number = 0.25, UNIT, "", "How far the force bends the strands, 1 = a right angle at the tip.";
        force_space: ForceSpace as OneOf<ForceSpace> = ForceSpace::World, UNBOUNDED, "", "The space of force: world or object.";
        inertia: f32 as Number = 0.0, UNIT, "", "How far strands lag behind an animated surface and settle after it, 0 = not at all.";
        stiffness: f32 as Number = 400.0, (1e-2, 1e8), "1/s^2", "How fast lagging strands spring back: the square of their angular frequency.";
        damping: f32 as Number = 0.25, (0.0, 1e4), "", "How soon strands stop swaying, 1 = without ever swinging past their rest.";
        comb: Vec2 as Vector2 = Vec2::ZERO, (-1.0, 1.0), "", "Lie of the fur, 1 = flat on the skin: around the vertical of the rest pose, and up along the surface.";
        comb_map: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: RG is the local lie, (lie + 1) / 2; added to comb.";
        blend: Blend as OneOf<Blend> = Blend::Cutout, UNBOUNDED, "", "How layers meet the frame: cutout, coverage or blend.";
        curl: f32 as Number = 0.0, UNIT, "", "How far strands coil, 1 = by their own spacing.";
        clump: f32 as Number = 0.0, UNIT, "", "How far tips of neighbouring strands draw together into locks.";
        specular: f32 as Number = 0.5, UNIT, "", "Strength of the highlights along the strands: a white one off their surface, a coloured one from inside.";
        transmission: f32 as Number = 0.5, UNIT, "", "Strength of the glow of strands with the light behind them.";
        roughness: f32 as Number = 0.35, UNIT, "", "Roughness of the strands along their length.";
    }
}
