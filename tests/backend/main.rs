//! A host draws vair's things into its own frames, under the validation layer: any message fails.
#![allow(unsafe_code)]
#[path = "../support/host.rs"]
mod host;
#[path = "../support/host_stage.rs"]
mod host_stage;

mod arguments;
mod depth;
mod motion;
mod same_pixels;
mod shadow;
mod things;
mod threads;
mod token;
mod upload;
mod views;
