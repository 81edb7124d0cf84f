//! What lights a frame: the environment, shadow maps, and the lighting features that select shader variants.

mod environment;
mod features;
mod shadow_atlas;
mod source;

pub use environment::{
    EnvironmentMaps, EnvironmentQuality, HostEnvironment, LobeTable, PreparedEnvironment, SH_COEFFICIENTS,
    compute_environment, compute_lobes, environment_bytes, prepare_environment, prepare_lobes,
};
pub(in crate::render) use environment::{LARGEST_TEXEL, RADIANCE_FORMAT, halves, is_same, sampled_image};
pub use features::LightingFeatures;
pub use shadow_atlas::{ShadowAtlas, TRANSMITTANCE_FORMAT, shadow_images, shadow_size};
pub use source::{first_shadows, light_source};
