//! What judges the renderer: twins of the shading in double precision, a ray caster, time, memory and error. Comes with the
//! feature `measure`.
//!
//! Nothing that draws sees this room, and nothing that is judged is computed here: where the renderer needs a number of a
//! twin's, each side has its own, and a test compares the two.

mod count;
pub mod furnace;
pub mod oracle;
pub mod profile;
pub mod report;
pub mod twin;
pub mod verify;

pub use count::{PassFragments, can_count_fragments, count_fragments, counting_pipeline};
