//! What bends strands: their own force, and their inertia.

use crate::material::{ForceSpace, Fur};
use crate::scene::{Instance, Size};
use crate::shader::layout::StrandDynamicsDraw;
use glam::{Mat4, Vec3};

/// Longest step between two frames that follow each other, seconds: strands of a longer one start from rest
/// (`STRAND_LONGEST_STEP_S` of `strand_dynamics.glsl`).
pub const LONGEST_STEP_S: f32 = 0.1;

/// Unit direction times strength. A force of the object turns with its node, or with the first joint of its skin: a rig
/// turns as a whole.
pub fn force_in_world(fur: &Fur, instance: &Instance) -> Vec3 {
    let carrier = match fur.force_space {
        ForceSpace::World => Mat4::IDENTITY,
        ForceSpace::Object => instance.joints.first().copied().unwrap_or(instance.world_from_object),
    };
    carrier.transform_vector3(fur.force).normalize_or(Vec3::ZERO) * fur.force_strength
}

/// The dispatch over `vertex_count` strands of `fur`.
pub fn strand_dynamics_draw(
    fur: &Fur,
    instance: &Instance,
    size: Size,
    vertex_count: u32,
    is_reset: bool,
    step_s: f32,
) -> StrandDynamicsDraw {
    let length_m = fur.length.metres(size.world_radius_m());
    StrandDynamicsDraw {
        world_from_object: instance.world_from_object.to_cols_array_2d(),
        vertex_count,
        reset: is_reset.into(),
        step_s,
        stiffness: fur.stiffness,
        damping: fur.damping,
        // A lag of a strand's length lays it flat.
        force_per_m: if length_m > 0.0 { (fur.inertia / length_m).min(f32::MAX) } else { 0.0 },
        _padding_0: [0; 2],
    }
}
