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
mod coat;
mod count;
mod determinism;
mod edges;
mod environment;
mod everything;
mod family;
mod fuzz;
mod gauze;
mod gbuffer;
mod glint;
mod goldens;
mod laser;
mod layered;
mod lean;
mod light;
mod oit;
mod order;
mod plans;
mod planted;
mod presets;
mod satin;
mod scenes;
mod shadow;
mod shells;
mod skinning;
mod ssao;
mod strand_dynamics;
mod submission;
mod surface;
mod texture;
mod tone_mapping;
mod turned;
mod variants;
