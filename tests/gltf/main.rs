//! Promise: any glTF file becomes plain checked data or one clear line; none panics.

mod builder;
mod container;
mod content;
mod hostile;
mod material_extension;
mod mesh;
mod real;
