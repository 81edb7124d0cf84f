//! From a loaded file to what one frame shows: pose, instances, lights, camera, bounds.
//!
//! Everything here is a pure function of an [`Asset`](crate::asset::Asset) and a [`Pose`]; nothing knows the GPU.
//! Matrices are named `to_from_source`, lengths are metres, angles radians unless a name says otherwise.

mod animation;
mod bounds;
mod camera;
mod choice;
mod deform;
mod environment_light;
mod error;
mod facing;
mod instance;
mod light;
mod light_reach;
mod lint;
mod load;
mod shadow;
mod shell;

pub use animation::{Pose, pose};
pub use bounds::{JointBoxes, object_scale, world_hull, world_scale};
pub use camera::{Camera, CameraChoice, DEFAULT_FOV_DEG, DEFAULT_PHI_DEG, DEFAULT_THETA_DEG, camera};
pub use choice::{find_animation, find_camera, find_scene, find_variant};
pub use deform::deform;
pub use environment_light::EnvironmentLight;
pub use error::SceneError;
pub use facing::{Clusters, Side};
pub use instance::{Instance, Part, instances, joint_matrices, nodes_of_scene, parts, pose_instances};
pub use light::{Incident, Light, LightKind, Lighting, light_of_node, lights};
pub use light_reach::LightLists;
pub use load::{Scene, Size};
pub use shadow::{MAX_SHADOW_MAPS, SHADOW_BORDER_PX, ShadowMap, ShadowMaps, bounding_sphere, shadow_maps};
pub use shell::{shell_directions, shell_directions_of_mesh};
