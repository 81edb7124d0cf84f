//! How fur is drawn: shells over the mesh, one instance each, and what they cast.

mod pipeline;
mod uniforms;

pub use pipeline::{casting_layers, fur_maps, fur_pipeline};
pub use uniforms::fur_uniforms;
