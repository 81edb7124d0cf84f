//! A scene on the device: what it keeps there, what each frame writes, and the host's edits.

mod content;
mod dynamics;
mod frame_values;
mod geometry;
mod material;
mod motion;
mod resources;
mod scene;
mod stream;
mod texture;

pub(crate) use dynamics::LONGEST_STEP_S;
pub(crate) use motion::DynamicsStep;
pub(crate) use resources::{DrawnScene, FrameRequest, HostShadowAtlas, SceneResources};
pub use scene::{DeviceScene, InstanceDesc, InstanceId};
pub use stream::{ABSENT, Stream, StreamPose, inputs};
