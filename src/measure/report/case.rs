//! What is looked at: two scenes with one fur, and the cameras before them.

use super::ReportError;
use crate::asset::procedural::{gallery, plane};
use crate::asset::{Asset, Node, Transform};
use crate::scene::{CameraChoice, Scene, instances, pose};
use glam::{Quat, Vec3};

/// Name of the gallery's object, and of its material.
const FUR: [&str; 2] = ["knot", "fur"];
/// Vertical field of view, degrees: long enough for the angle of the view to hold over the picture.
const FOV_DEG: f32 = 12.0;
/// Pixels from strand to strand where strands are seen one by one.
const NEAR_SPACING_PX: f32 = 4.0;
/// The same from afar.
const FAR_SPACING_PX: f32 = 0.2;
/// Pan between the two frames of the moving view, pixels; no simple share of a pixel.
const PAN_PX: f32 = 0.37;
/// Half a side of the swatch: seen at 80 degrees it still reaches beyond both edges of a picture 288 pixels high.
const SWATCH_HALF_M: f32 = 1.0;

/// A scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Stage {
    /// The gallery's knot under the gallery's lights.
    Knot,
    /// A flat piece of the same fur.
    Swatch,
    /// The knot with one closed shell in place of its fur.
    OuterSurface,
}

/// A camera before a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum View {
    /// The knot fills the picture.
    Gallery,
    /// Down on the swatch.
    Front,
    /// 60 degrees from its normal.
    Degrees60,
    /// 80 degrees from its normal.
    Degrees80,
    /// From so far that strands are smaller than pixels.
    Far,
    /// Down on the swatch, two frames.
    Moving,
    /// The knot without its fur; it has no reference.
    OuterSurface,
}

impl View {
    /// Those with a reference.
    pub const ALL: [Self; 6] = [Self::Gallery, Self::Front, Self::Degrees60, Self::Degrees80, Self::Far, Self::Moving];

    /// Name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Gallery => "gallery",
            Self::Front => "front",
            Self::Degrees60 => "60 degrees",
            Self::Degrees80 => "80 degrees",
            Self::Far => "far",
            Self::Moving => "moving",
            Self::OuterSurface => "outer surface",
        }
    }

    /// What stands before it.
    pub fn stage(self) -> Stage {
        match self {
            Self::Gallery => Stage::Knot,
            Self::OuterSurface => Stage::OuterSurface,
            _ => Stage::Swatch,
        }
    }
}

/// The scenes.
pub struct Cases {
    knot: Scene,
    swatch: Scene,
    outer_surface: Scene,
    /// Mean spacing of the fur's strands, metres.
    strand_spacing_m: f32,
    /// Where the swatch lies.
    middle: Vec3,
    /// Shells that the fur's own material asks for.
    pub default_layers: u32,
}

impl Cases {
    /// From the gallery.
    ///
    /// # Errors
    /// When the gallery has no such fur.
    pub fn new() -> Result<Self, ReportError> {
        let lacks = || ReportError::Gallery { lacks: FUR[0] };
        let mut asset = gallery();
        let furred = asset.nodes.iter().position(|node| is_named(node, FUR[0])).ok_or_else(lacks)?;
        // What is no root is not in the scene.
        let shown = |index: usize| index == furred || asset.nodes[index].light.is_some();
        let roots = (0..asset.nodes.len()).filter(|&index| shown(index)).collect();
        asset.scenes[asset.default_scene].roots = roots;
        let knot = Scene::from_asset(asset.clone())?;
        let material = asset.materials.iter().position(|m| m.name.as_deref() == Some(FUR[1])).ok_or_else(lacks)?;
        let fur = instances(&asset, asset.default_scene, &pose(&asset, None, 0.0));
        let radius_m = knot.size(fur.first().ok_or_else(lacks)?).world_radius_m();
        let mut fur = knot.materials()[material].fur.clone().ok_or_else(lacks)?;
        let default_layers = fur.layers;

        let mut outer_surface = Scene::from_asset(asset.clone())?;
        if let Some(fur) = &mut outer_surface.materials_mut()[material].fur {
            (fur.cutoff_start, fur.cutoff_end, fur.taper, fur.edge_fade, fur.tip_fade) = (0.0, 0.0, 0.0, 0.0, 0.0);
        }

        let middle = lay_flat(&mut asset, furred);
        let mut swatch = Scene::from_asset(asset)?;
        let metres = |length: crate::material::Length| crate::material::Length::Metres(length.metres(radius_m));
        (fur.length, fur.strand_spacing) = (metres(fur.length), metres(fur.strand_spacing));
        let strand_spacing_m = fur.strand_spacing.metres(radius_m);
        swatch.materials_mut()[material].fur = Some(fur);
        Ok(Self { knot, swatch, outer_surface, strand_spacing_m, middle, default_layers })
    }

    /// The scene before a view.
    pub fn scene(&self, stage: Stage) -> &Scene {
        match stage {
            Stage::Knot => &self.knot,
            Stage::Swatch => &self.swatch,
            Stage::OuterSurface => &self.outer_surface,
        }
    }

    /// Camera of each frame of a view, for pictures `height_px` high.
    pub fn cameras(&self, view: View, height_px: u32) -> Vec<CameraChoice> {
        let swatch = |angle_deg: f32, spacing_px: f32, pan_px: f32| {
            let pixel_m = self.strand_spacing_m / spacing_px;
            let half_height = (0.5 * FOV_DEG).to_radians().tan();
            CameraChoice::Orbit {
                theta_deg: 0.0,
                phi_deg: angle_deg,
                radius_m: Some(0.5 * height_px as f32 * pixel_m / half_height),
                target: Some(self.middle + Vec3::X * (pan_px * pixel_m)),
                fov_deg: FOV_DEG,
            }
        };
        match view {
            View::Gallery | View::OuterSurface => vec![CameraChoice::Orbit {
                theta_deg: 0.0,
                phi_deg: 80.0,
                radius_m: None,
                target: None,
                fov_deg: FOV_DEG,
            }],
            View::Front => vec![swatch(0.0, NEAR_SPACING_PX, 0.0)],
            View::Degrees60 => vec![swatch(60.0, NEAR_SPACING_PX, 0.0)],
            View::Degrees80 => vec![swatch(80.0, NEAR_SPACING_PX, 0.0)],
            View::Far => vec![swatch(0.0, FAR_SPACING_PX, 0.0)],
            View::Moving => [0.0, PAN_PX].map(|pan_px| swatch(0.0, NEAR_SPACING_PX, pan_px)).to_vec(),
        }
    }
}

fn is_named(node: &Node, name: &str) -> bool {
    node.name.as_deref() == Some(name)
}

/// Puts a flat piece, facing up, in a node's place, and says where.
fn lay_flat(asset: &mut Asset, node: usize) -> Vec3 {
    let Node { mesh: Some(mesh), transform: Transform::Trs { translation, .. }, .. } = asset.nodes[node] else {
        return Vec3::ZERO;
    };
    for primitive in &mut asset.meshes[mesh].primitives {
        let material = primitive.material;
        *primitive = crate::asset::Primitive { material, ..plane(SWATCH_HALF_M, SWATCH_HALF_M, 8) };
    }
    asset.nodes[node].transform = Transform::Trs { translation, rotation: Quat::IDENTITY, scale: Vec3::ONE };
    translation
}
