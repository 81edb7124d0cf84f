//! From a loaded file to what one frame shows: pose, instances, lights, camera, bounds.
//!
//! Everything here is a pure function of an [`Asset`](crate::asset::Asset) and a [`Pose`]; nothing knows the GPU.
//! Matrices are named `to_from_source`, lengths are metres, angles radians unless a name says otherwise.

mod animation;
mod bounds;
mod camera;
mod choice;
mod deform;
mod error;
mod facing;
mod instance;
mod light;
mod light_reach;
mod lint;
mod load;
mod shadow;
mod shell;
mod surroundings;

pub use animation::{Pose, pose};
pub use bounds::{object_scale, world_hull};
pub use camera::{Camera, CameraChoice, DEFAULT_FOV_DEG, DEFAULT_PHI_DEG, DEFAULT_THETA_DEG, camera};
pub use choice::{find_animation, find_camera, find_scene, find_variant};
pub use deform::deform;
pub use error::SceneError;
pub use facing::{Patches, Side};
pub use instance::{Instance, instances, joint_matrices, nodes_of_scene};
pub use light::{Incident, Light, LightKind, Lighting, lights};
pub use light_reach::LightLists;
pub use load::{Scene, Size};
pub use shadow::{MAX_SHADOW_MAPS, SHADOW_BORDER_PX, ShadowMap, ShadowMaps, ball, shadow_maps};
pub use shell::{shell_directions, shell_directions_of_mesh};
pub use surroundings::Surroundings;
