//! Every shader function against its double-precision twin, on the device.

mod furnace;

pub use furnace::{ALBEDO_LIMIT, Claim, Input, Measure, Property, RANDOM_POINTS, claims, furnace};
