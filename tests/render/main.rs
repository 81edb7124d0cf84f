//! Promise: a scene becomes the picture that the formulas say, on a real device, without a word from the validation
//! layer.
//!
//! Needs a Vulkan device and the validation layer; without them these tests fail and say what to install.
#[path = "../support/glsl.rs"]
mod glsl;
#[path = "../support/golden.rs"]
mod golden;
#[path = "../support/headless.rs"]
mod headless;
#[path = "../support/limit.rs"]
mod limit;
#[path = "../support/plan_text.rs"]
mod plan_text;
#[path = "../support/stage.rs"]
mod stage;

mod blending;
mod camera;
mod cloth;
mod coat;
mod count;
mod deform;
mod determinism;
mod display;
mod edges;
mod environment;
mod everything;
mod fuzz;
mod gauze;
mod glint;
mod goldens;
mod guide;
mod laser;
mod layered;
mod lean;
mod light;
mod order;
mod plans;
mod planted;
mod presets;
mod satin;
mod scenes;
mod screen_occlusion;
mod shadow;
mod shells;
mod submission;
mod surface;
mod sway;
mod texture;
mod transparency;
mod turned;
mod variants;
