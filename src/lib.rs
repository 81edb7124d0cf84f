//! vair renders fur and cloth with Vulkan, and says what that cost.
//!
//! It reads glTF, dresses materials from glTF, look files or presets, and draws them on any Vulkan 1.3 device, software
//! devices included. A picture takes ten lines:
//!
//! ```no_run
//! use vair::{FrameOptions, GpuOptions, LoadOptions, Look, Renderer, Scene};
//!
//! # fn main() -> Result<(), vair::Error> {
//! let mut scene = Scene::load("fox.glb", &LoadOptions::default())?;
//! scene.apply(&Look::preset("fox", None)?, ".".as_ref(), &LoadOptions::default())?;
//!
//! let mut renderer = Renderer::new(&GpuOptions::default())?;
//! let options = FrameOptions { animation: Some(0), time_s: 0.5, ..FrameOptions::default() };
//! renderer.render(&scene, &options)?.save("fox.png")?;
//! # Ok(())
//! # }
//! ```
//!
//! An engine lends its device and gets fur and cloth drawn inside its own frame, on its own colour and depth:
//! `docs/embedding.md` is the way there ([`mod@embedding`] here), [`render::Frame`] the calls.
//!
//! # Rooms
//! Each sees only those before it; a test keeps it so.
//!
//! | room | is |
//! |---|---|
//! | [`math`] | spaces and bounds, and how numbers are coded |
//! | [`shader`] | the compiled shaders and what reflection knows of them |
//! | [`gpu`] | the only unsafe code; knows Vulkan, knows no fur |
//! | [`asset`] | files to plain data; trusts nothing |
//! | [`material`] | parameters declared once, looks, presets |
//! | [`scene`] | pose, instances, lights, camera; pure functions |
//! | [`render`] | what one frame needs, and the frame |
//! | `measure` | what judges the others, in rooms of its own: |
//! | `measure::twin` | the shading in double precision, and what each shader function is held to |
//! | `measure::oracle` | what shells approach: fur ray-cast in double precision |
//! | `measure::furnace` | what the formulas promise: no light from nothing |
//! | `measure::verify` | every shader function against its twin, on the device |
//! | `measure::profile` | where a frame's time, fragments and memory go |
//! | `measure::report` | error against run time |
//!
//! `measure` comes with the feature of that name, which the program has and an embedding engine leaves out: nothing that
//! draws sees it.
//!
//! # A frame
//! [`FrameOptions`] and a [`Scene`] make a [`render::FrameSetup`]: pose, camera, lights, and the [`render::Plan`], which lists
//! draws, pipelines, vertex streams and textures. Nothing has touched the device yet: `vair inspect` prints just this, and what
//! is skipped and why. A host's [`render::DeviceScene`] comes to a plan by its own edits. The device then makes what the plan
//! lists and nothing else; each frame writes its values and records the passes of [`render::Pass`] that are wanted, in the
//! order of that list. A plan stays while a scene only moves, and with it all that was made for it.
//!
//! # Fur
//! Fur is strands on a lattice of the rest pose and a few shells over the mesh, one instance each, the outermost
//! first. A shell is the upper boundary of a slab: its fragments walk the cells of the lattice that the view ray crosses
//! within the slab and find the strand that it meets, and where. So a handful of shells shows what infinitely many
//! would; `vair report` says how nearly and at which cost, beside the ways of other renderers ([`render::Shells`]).
//!
//! A strand reflects light, lets it through and returns it, in three normalised lobes about its tangent; the rest goes from
//! strand to strand and is diffuse, so that white fur in a white environment is white. Along the light fur counts by its
//! optical depth, along the view by the shells that are drawn, and by nothing else.
//!
//! # Family
//! A material family ([`material::Family`]) takes the place of the standard surface's lobes and keeps its maps and
//! parameters. It is one stem throughout: `satin` is a file of parameters in [`material`], a uniform block in
//! `shaders_glsl/host`, functions in `lib`, a fragment shader in `pass` over what all share (`surface.glsl`), a file of
//! [`render`] that binds the two and says what it casts, a twin, and a judge. What it does not use is not in its pipeline. glTF's
//! own material extensions are a family, too: `layered`. Lobes are coupled by directional albedo, so that nothing that is worn
//! gives more light than it gets; `classic = true` evaluates the formula of older engines instead, which does.
//!
//! # Conventions
//! - World space is right-handed, Y up, metres, seconds. Angles are radians inside and degrees where a person writes
//!   them. Names say space and unit: `normal_in_world`, `length_m`, `frame_ms`; matrices are `to_from_source`.
//! - Clip space is Y up and depth runs from 1 at the near plane to 0; a host's views and targets may declare otherwise.
//! - Colours are linear RGB with the primaries of sRGB. Colour textures are decoded when sampled, data never.
//!   Compositing is premultiplied.
//! - A length in a look is metres, or a share of the mesh's bounding radius (`"4%"`).
//!
//! # Errors and trust
//! Each room has one error enum; [`Error`] holds them all. A message is one line: what, where, what to do. Nothing that
//! a file says can panic, read outside the file's folder, or allocate beyond [`LoadOptions::memory_limit_bytes`].
//!
//! # Sources
//! Shells: Lengyel et al. 2001, "Real-Time Fur over Arbitrary Surfaces". Strands: Marschner et al. 2003, "Light
//! Scattering from Human Hair Fibers"; d'Eon et al. 2011, "An Energy-Conserving Hair Reflectance Model"; Chiang et al. 2016,
//! "A Practical and Controllable Hair and Fur Model for Production Path Tracing"; Zinke et al. 2008, "Dual Scattering
//! Approximation for Fast Multiple Scattering in Hair". Surfaces: Walter et al. 2007, "Microfacet Models for Refraction through Rough
//! Surfaces"; Turquin 2019, "Practical multiple scattering compensation for microfacet models". Files: Khronos 2021,
//! "glTF 2.0 Specification". Sheen: Zeltner, Burley & Chiang 2022, "Practical Multiple-Scattering Sheen Using Linearly
//! Transformed Cosines". Films: Belcour & Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of
//! Varying Iridescence". Glints: Kemppinen et al. 2025, "Glinty NDFs in Constant Time". Each function cites its own.

#[cfg(any(doc, doctest))]
#[doc = include_str!("../docs/embedding.md")]
pub mod embedding {}

#[allow(unsafe_code)]
pub mod gpu;

pub mod asset;
mod error;
pub mod material;
pub mod math;
#[cfg(feature = "measure")]
pub mod measure;
pub mod render;
pub mod scene;
pub mod shader;

pub use asset::LoadOptions;
pub use error::Error;
pub use gpu::{Gpu, GpuOptions};
pub use material::Look;
pub use render::{FrameOptions, Picture, Renderer};
pub use scene::Scene;
