//! From a scene to a frame: into a host's own, or as a picture.
//!
//! A frame goes one way. What stands where, in which light, is [`Staging`]: a host's [`DeviceScene`] fills it by its edits, a
//! picture's [`FrameSetup`] by poses of a file. From it follows the [`Plan`], plain data, which stays while a scene only
//! moves. The device makes what the plan lists and nothing else, each frame writes its values, and the passes
//! (`pass`, one file each, in the order of their list) are recorded.
//!
//! | file | is |
//! |---|---|
//! | `renderer` | what belongs to a device: pipelines, tables, environments |
//! | `device_scene` | what belongs to a scene, and the host's edits |
//! | `view`, `target`, `frame` | a host's frame: cameras, formats, recording |
//! | `plan` | what a frame needs, what it skips and why, and how much memory it takes |
//! | `surface`, `fur`, `light` | how each is drawn: shaders, uniforms, what it casts |
//! | `pass` | the passes |
//! | `picture` | pictures, their files, and how one is made: one more host |

mod device_scene;
mod error;
mod frame;
mod fur;
#[cfg(feature = "measure")]
pub(crate) mod instrument;
mod light;
mod options;
mod pass;
mod picture;
mod plan;
mod renderer;
mod surface;
mod target;
mod view;

pub use device_scene::{DeviceScene, InstanceDesc, InstanceId, Stream, StreamPose};
pub use error::RenderError;
pub use frame::{CastTarget, Frame, FrameDesc, HostShadowMap, HostShadows, MAX_FRAMES_IN_FLIGHT};
pub use light::{
    EnvironmentQuality, HostEnvironment, LightingFeatures, PreparedEnvironment, SH_COEFFICIENTS, compute_environment,
    compute_lobes, prepare_environment, prepare_lobes,
};
pub use options::{
    Background, FrameOptions, HdrFormat, MAX_LAYERS, SHADOW_FILTERS_PX, SHADOW_RESOLUTIONS_PX, Shadows, ShellAlpha,
    ShellOrder, ShellSampling, ShellSubmission, Shells, Tonemap, Transparency,
};
pub use pass::Pass;
pub use pass::oit_resolve::ListUse;
pub use pass::ssao::{MAX_OCCLUSION_SAMPLES, ScreenOcclusion};
pub use picture::{
    AovPixels, Aovs, CpuPhases, EMPTY_DEPTH_M, FrameReport, FurReport, PICTURE_FORMAT, Picture, PictureBackground,
    PictureFormat, Skybox, write_file,
};
pub use plan::{
    Attachment, Blending, ComputeSpec, Deform, DepthCompare, DepthUse, Draw, DrawKind, Dynamics, Eye, Faces,
    FrameSetup, PictureOptions, PipelineSpec, Plan, PlanInput, PlanOptions, ShadowPlan, Skipped, Staging, SurfaceUse,
    TextureUse, Variants,
};
pub use renderer::Renderer;
pub use surface::{Fallback, Table};
pub use target::{DepthOrder, Target};
pub use view::{View, Viewport};
