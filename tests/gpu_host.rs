//! A host brings its own instance, device and queue; the crate draws into the host's image in the host's command
//! buffer, and destroys nothing that is not its own. The whole runs under the validation layer.
#![allow(unsafe_code)]
#[path = "support/host.rs"]
mod host;

use host::{FORMAT, Host, messages};
use vair::gpu::vk;
use vair::gpu::*;
use vair::render::{FrameOptions, Renderer};
use vair::scene::Scene;

const SIZE: [u32; 2] = [4, 2];

#[test]
fn the_host_keeps_what_is_its_own() {
    let host = Host::new();
    let handles = host.image(SIZE);
    // SAFETY: the handles belong together and outlive every object made from them below.
    let gpu = unsafe { Gpu::from_host(host.lend()) }.unwrap_or_else(|error| panic!("{error}"));
    let (raw, _, view) = handles;
    // SAFETY: image and view are alive, of this format and size, and undefined.
    let image = unsafe { Image::from_host(&gpu, "host's", raw, view, FORMAT, SIZE, vk::ImageLayout::UNDEFINED) };

    let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT;
    let own_desc =
        ImageDesc { name: "own", size: SIZE, format: FORMAT, mip_levels: 1, samples: 4, usage, is_cube: false };
    let own = gpu.image(&own_desc).unwrap();
    host.run(|command_buffer| {
        // SAFETY: the command buffer is recording, outside of a pass, and submitted once right after.
        let mut encoder = unsafe { gpu.encoder_on_host("frame", command_buffer) };
        let load = Load::Clear([0.2, 0.4, 0.6, 1.0]);
        let color = [ColorTarget { image: &own, load, store: false, resolve: Some(&image) }];
        let desc = RenderPassDesc { name: "clear", size: SIZE, color: &color, depth: None, sampled: &[] };
        encoder.render_pass(&desc, |_| ());
        encoder.transition(&image, ImageUse::Host(vk::ImageLayout::GENERAL));
        let times = encoder.finish_on_host().unwrap();
        assert_eq!(times.passes.len(), 1);
    });
    drop(own);
    assert!(gpu.memory().by_owner.iter().any(|(name, _)| name == "own"), "kept until the host says so");
    // SAFETY: the host has just waited for its queue.
    unsafe { gpu.host_idle() };
    assert!(gpu.memory().by_owner.is_empty(), "{:?}", gpu.memory());

    assert_eq!(gpu.read_image(&image).unwrap(), [51, 102, 153, 255].repeat(8));
    drop(image);
    drop(gpu);

    // Image, device and queue still serve the host.
    host.run(|_| ());
    host.end(handles);
    assert_eq!(messages(), Vec::<String>::new());
}

#[test]
fn an_encoder_on_the_hosts_command_buffer_cannot_submit() {
    let host = Host::new();
    let handles = host.image(SIZE);
    // SAFETY: the handles belong together and outlive every object made from them below.
    let gpu = unsafe { Gpu::from_host(host.lend()) }.unwrap();
    host.run(|command_buffer| {
        // SAFETY: the command buffer is recording and submitted once right after.
        let encoder = unsafe { gpu.encoder_on_host("frame", command_buffer) };
        assert!(matches!(encoder.submit(), Err(GpuError::HostSubmits { .. })));
    });
    drop(gpu);
    let mut lacking = host.lend();
    lacking.features = Features::default();
    // SAFETY: as above.
    let error = unsafe { Gpu::from_host(lacking) }.err().unwrap();
    assert!(error.to_string().contains("dynamic_rendering"), "{error}");
    host.end(handles);
}

#[test]
fn a_frame_in_the_hosts_command_buffer_is_the_renderers_own_picture() {
    let options = FrameOptions { size: [96, 54], ..FrameOptions::default() };
    let host = Host::new();
    let handles = host.image(options.size);
    // SAFETY: the handles belong together and outlive every object made from them below.
    let gpu = unsafe { Gpu::from_host(host.lend()) }.unwrap_or_else(|error| panic!("{error}"));
    let (raw, _, view) = handles;
    // SAFETY: image and view are alive, of this format and size, and undefined.
    let image =
        unsafe { Image::from_host(&gpu, "host's", raw, view, FORMAT, options.size, vk::ImageLayout::UNDEFINED) };
    let gallery = Scene::gallery();
    let mut renderer = Renderer::with_gpu(gpu.clone()).unwrap_or_else(|error| panic!("{error}"));
    // Twice: the second frame finds everything made.
    for _ in 0..2 {
        host.run(|command_buffer| {
            // SAFETY: the command buffer is recording, outside of a pass, and submitted once right after.
            let mut encoder = unsafe { gpu.encoder_on_host("frame", command_buffer) };
            renderer.record(&mut encoder, &gallery, &options, &image).unwrap_or_else(|error| panic!("{error}"));
            encoder.transition(&image, ImageUse::Host(vk::ImageLayout::GENERAL));
            let times = encoder.finish_on_host().unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(times.passes.last().map(|pass| pass.name.as_str()), Some("tonemap"));
        });
        // SAFETY: the host has just waited for its queue.
        unsafe { gpu.host_idle() };
    }
    let in_host = gpu.read_image(&image).unwrap_or_else(|error| panic!("{error}"));
    drop((image, renderer, gpu));
    host.end(handles);
    assert_eq!(messages(), Vec::<String>::new());

    let mut own = Renderer::new(&GpuOptions::default()).unwrap_or_else(|error| panic!("{error}"));
    let picture = own.render(&gallery, &options).unwrap_or_else(|error| panic!("{error}"));
    assert!(picture.rgba == in_host, "the host's image is not the renderer's picture");
}
