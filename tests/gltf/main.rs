//! Promise: any glTF file becomes plain checked data or one clear line; none panics.

mod builder;
mod check;
mod container;
mod content;
mod hostile;
mod lenient;
mod material_extension;
mod mesh;
mod real;
