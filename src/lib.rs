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
//! A host with a device of its own lends it ([`Gpu::from_host`]) and gets the frame recorded into its own command
//! buffer and image, between its own passes:
//!
//! ```no_run
//! use vair::gpu::{HostDevice, Image, ImageUse, vk};
//! use vair::{FrameOptions, Gpu, Renderer, Scene};
//!
//! # fn frame(
//! #     host: HostDevice, command_buffer: vk::CommandBuffer, image: vk::Image, view: vk::ImageView,
//! # ) -> Result<(), vair::Error> {
//! // SAFETY: the host's handles belong together and outlive `gpu`.
//! let gpu = unsafe { Gpu::from_host(host)? };
//! let mut renderer = Renderer::with_gpu(gpu.clone())?;
//! let scene = Scene::gallery();
//! let options = FrameOptions { size: [1280, 720], ..FrameOptions::default() };
//!
//! let (format, layout) = (vk::Format::R8G8B8A8_SRGB, vk::ImageLayout::UNDEFINED);
//! // SAFETY: image and view are alive and as described.
//! let target = unsafe { Image::from_host(&gpu, "host", image, view, format, options.size, layout) };
//! // SAFETY: the command buffer is recording; the host submits it once and then calls `host_idle`.
//! let mut encoder = unsafe { gpu.encoder_on_host("vair", command_buffer) };
//! renderer.record(&mut encoder, &scene, &options, &target)?;
//! encoder.transition(&target, ImageUse::Host(vk::ImageLayout::PRESENT_SRC_KHR));
//! encoder.finish_on_host()?;
//! # Ok(())
//! # }
//! ```
//!
//! # Rooms
//! Each sees only those before it; a test keeps it so.
//!
//! | room | is |
//! |---|---|
//! | [`math`] | spaces and bounds |
//! | [`shader`] | the compiled shaders and what reflection knows of them |
//! | [`gpu`] | the only unsafe code; knows Vulkan, knows no fur |
//! | [`asset`] | files to plain data; trusts nothing |
//! | [`material`] | parameters declared once, looks, presets, and double-precision twins of the shading |
//! | [`scene`] | pose, instances, lights, camera; pure functions |
//! | [`render`] | what one frame needs, and the frame |
//! | `oracle` | what shells approach: coats ray-cast in double precision |
//! | `verify` | every shader function against its twin on the device; what the formulas promise |
//! | `profile` | where a frame's time, fragments and memory go |
//! | `report` | error against run time |
//!
//! The last four judge the others. They come with the feature `measure`, which the program has and an embedding engine
//! leaves out.
//!
//! # A frame
//! [`FrameOptions`] and a [`Scene`] make a [`render::Shot`]: pose, camera, light, and the [`render::Plan`], which lists
//! draws, pipelines, vertex streams and textures, and what is left out and why. Nothing has touched the device yet:
//! `vair inspect` prints just this. The resources then make what the plan lists and nothing else, and the frame records
//! its passes: deform (skins and morphs, in compute), sway (strands that lag behind), guide (depth, normal and motion) and
//! screen occlusion where they are asked for, shadow (what lights see, up to four passes into one atlas), opaque, fur,
//! transparent (what blends, into lists) and transparency (the lists, sorted and composed), tone mapping.
//!
//! # Fur
//! A coat is strands on a lattice of the rest pose and a few shells over the mesh, one instance each, the outermost
//! first. A shell is the upper boundary of a slab: its fragments walk the cells of the lattice that the view ray crosses
//! within the slab and find the strand that it meets, and where. So a handful of shells shows what infinitely many
//! would; `vair report` says how nearly and at which cost, beside the ways of other renderers ([`render::Shells`]).
//!
//! A strand reflects light, lets it through and returns it, in three normalised lobes about its tangent; the rest goes from
//! strand to strand and is diffuse, so that a white coat in white surroundings is white. Along the light the coat counts by
//! its optical depth, along the view by the shells that are drawn, and by nothing else.
//!
//! # Cloth
//! A family of cloth ([`material::Cloth`]) takes the place of the standard surface's lobes and keeps its maps and
//! parameters. It is one stem throughout: `satin` is a file of parameters in [`material`], a uniform block in
//! `shaders_glsl/host`, functions in `lib`, a fragment shader in `pass` over what all share (`surface.glsl`), a file of
//! [`render`] that binds the two, a twin, and a judge. What it does not use is not in its pipeline. glTF's own material
//! extensions are a family, too: `layered`. Lobes are coupled by directional albedo, so that nothing that is worn gives more
//! light than it gets; `classic = true` evaluates the formula of older engines instead, which does.
//!
//! # Conventions
//! - World space is right-handed, Y up, metres, seconds. Angles are radians inside and degrees where a person writes
//!   them. Names say space and unit: `normal_in_world`, `length_m`, `frame_ms`; matrices are `to_from_source`.
//! - Clip space is Y up; depth runs from 1 at the near plane to 0.
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

#[allow(unsafe_code)]
pub mod gpu;

pub mod asset;
mod error;
pub mod material;
pub mod math;
#[cfg(feature = "measure")]
pub mod oracle;
#[cfg(feature = "measure")]
pub mod profile;
pub mod render;
#[cfg(feature = "measure")]
pub mod report;
pub mod scene;
pub mod shader;
#[cfg(feature = "measure")]
pub mod verify;

pub use asset::LoadOptions;
pub use error::Error;
pub use gpu::{Gpu, GpuOptions};
pub use material::Look;
pub use render::{FrameOptions, Picture, Renderer};
pub use scene::Scene;
