//! A host brings its own instance, device and queue; the crate draws into the host's image in the host's command
//! buffer, and destroys nothing that is not its own. The whole runs under the validation layer.
#![allow(unsafe_code)]
#[path = "support/colored.rs"]
mod colored;
#[path = "support/glsl.rs"]
mod glsl;
#[path = "support/host.rs"]
mod host;

use colored::{COLORED_FRAG, COLORED_VERT};
use host::{Host, Pass, RenderTarget, messages};
use vair::gpu::vk;
use vair::gpu::*;

const FORMAT: vk::Format = vk::Format::R8G8B8A8_UNORM;
const SIZE: [u32; 2] = [4, 2];
/// 51, 102, 153 and 255 of 255.
const COLOR: [f32; 4] = [0.2, 0.4, 0.6, 1.0];
const COLOR_BYTES: [u8; 4] = [51, 102, 153, 255];

/// The host's image as the crate is told of it.
fn host_image(target: &RenderTarget, layout: vk::ImageLayout) -> HostImage<'static> {
    target.described("host's", layout)
}

/// The host's image.
fn image(host: &Host) -> RenderTarget {
    let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC;
    host.engine.target(FORMAT, SIZE, 1, usage).unwrap()
}

/// A pass of the host's own over its image, which is cleared to 0 before and in the layout `GENERAL` afterwards.
fn draw_into(
    host: &Host,
    command_buffer: vk::CommandBuffer,
    image: &RenderTarget,
    record: impl FnOnce(vk::CommandBuffer),
) {
    let layout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
    host.engine.barrier(command_buffer, image, vk::ImageLayout::UNDEFINED, layout);
    let pass = Pass { color: Some(image), resolve: None, depth: None, clear_color: [0.0; 4], clear_depth: None };
    host.engine.begin_rendering(command_buffer, &pass);
    record(command_buffer);
    host.engine.end_rendering(command_buffer);
    host.engine.barrier(command_buffer, image, layout, vk::ImageLayout::GENERAL);
}

/// Destroys everything; the crate has let go of it.
fn end(host: Host, image: &RenderTarget) {
    host.engine.destroy_target(image);
    host.destroy();
}

/// Records nothing but the use of a buffer of that name; the host submits it, or never does.
fn frame_with(gpu: &Gpu, host: &Host, name: &str) -> FrameToken {
    let buffer = gpu.buffer(name, 16, vk::BufferUsageFlags::TRANSFER_DST, Memory::Device).unwrap();
    let mut token = None;
    host.run(|command_buffer| {
        // SAFETY: the command buffer is recording, outside of a pass, and submitted once right after.
        let mut encoder = gpu.encoder_on_host(name, unsafe { HostCommands::recording(command_buffer) });
        encoder.clear_buffers(name, &[&buffer]);
        let (recorded, result) = encoder.finish_on_host();
        result.unwrap();
        token = Some(recorded);
    });
    token.unwrap()
}

fn owners(gpu: &Gpu) -> Vec<String> {
    gpu.memory().by_owner.into_iter().map(|(name, _)| name).collect()
}

#[test]
fn the_host_keeps_what_is_its_own() {
    let host = Host::new();
    let handles = image(&host);
    // SAFETY: the handles belong together and outlive every object made from them below.
    let gpu = unsafe { Gpu::from_host(host.lend()) }.unwrap_or_else(|error| panic!("{error}"));
    // SAFETY: image and view are alive, of this format and size, and undefined.
    let image = unsafe { Image::from_host(&gpu, &host_image(&handles, vk::ImageLayout::UNDEFINED)) };

    let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT;
    let own_desc =
        ImageDesc { name: "own", size: SIZE, format: FORMAT, mip_levels: 1, samples: 4, usage, is_cube: false };
    let own = gpu.image(&own_desc).unwrap();
    let mut token = None;
    host.run(|command_buffer| {
        // SAFETY: the command buffer is recording, outside of a pass, and submitted once right after.
        let mut encoder = gpu.encoder_on_host("frame", unsafe { HostCommands::recording(command_buffer) });
        let load = Load::Clear(COLOR);
        let color = [ColorTarget { image: &own, load, store: false, resolve: Some(&image) }];
        let desc = RenderPassDesc { name: "clear", size: SIZE, color: &color, depth: None, sampled: &[] };
        encoder.render_pass(&desc, |_| ());
        encoder.transition(&image, ImageUse::Host(vk::ImageLayout::GENERAL));
        let (recorded, result) = encoder.finish_on_host();
        result.unwrap_or_else(|error| panic!("{error}"));
        token = Some(recorded);
    });
    drop(own);
    assert!(gpu.memory().by_owner.iter().any(|(name, _)| name == "own"), "kept until the host says so");
    // SAFETY: the host has just waited for its queue.
    unsafe { gpu.frame_passed(token.unwrap()) }.unwrap();
    assert!(gpu.memory().by_owner.is_empty(), "{:?}", gpu.memory());

    assert_eq!(gpu.read_image(&image).unwrap(), COLOR_BYTES.repeat(8));
    drop(image);
    drop(gpu);

    // Image, device and queue still serve the host.
    host.run(|_| ());
    end(host, &handles);
    assert_eq!(messages(), Vec::<String>::new());
}

#[test]
fn an_encoder_on_the_hosts_command_buffer_cannot_submit() {
    let host = Host::new();
    let handles = image(&host);
    // SAFETY: the handles belong together and outlive every object made from them below.
    let gpu = unsafe { Gpu::from_host(host.lend()) }.unwrap();
    host.run(|command_buffer| {
        // SAFETY: the command buffer is recording and submitted once right after.
        let encoder = gpu.encoder_on_host("frame", unsafe { HostCommands::recording(command_buffer) });
        assert!(matches!(encoder.submit(), Err(GpuError::HostSubmits { .. })));
    });
    drop(gpu);
    let mut lacking = host.lend();
    lacking.features = Features::default();
    // SAFETY: as above.
    let error = unsafe { Gpu::from_host(lacking) }.err().unwrap();
    assert!(error.to_string().contains("dynamic_rendering"), "{error}");
    end(host, &handles);
}

#[test]
fn a_host_pass_draws_into_the_hosts_targets() {
    let host = Host::new();
    let handles = image(&host);
    // SAFETY: the handles belong together and outlive every object made from them below.
    let gpu = unsafe { Gpu::from_host(host.lend()) }.unwrap_or_else(|error| panic!("{error}"));
    let formats = TargetFormats::new([FORMAT], None, 1);
    let pipeline = gpu
        .graphics_pipeline(&GraphicsDesc {
            name: "colored",
            vertex: &COLORED_VERT,
            fragment: Some(&COLORED_FRAG),
            constants: &[],
            topology: vk::PrimitiveTopology::TRIANGLE_LIST,
            samples: 1,
            color: &[ColorState::replace(FORMAT)],
            depth: None,
        })
        .unwrap();
    let stream = |name: &str, values: &[f32]| {
        let bytes = size_of_val(values) as u64;
        let buffer = gpu.buffer(name, bytes, vk::BufferUsageFlags::VERTEX_BUFFER, Memory::Upload).unwrap();
        buffer.write(0, values).unwrap();
        buffer
    };
    // All of the area, and only the upper half of it where up is up.
    let covering = stream("position", &[-1.0, -1.0, 3.0, -1.0, -1.0, 3.0]);
    let upper = stream("upper", &[-1.0, 0.0, 7.0, 0.0, -1.0, 8.0]);
    let color = stream("color", &COLOR.repeat(3));
    let draw = |origin: [u32; 2], size: [u32; 2], is_y_down: bool, position: &Buffer, formats: TargetFormats| {
        let mut frame = None;
        host.run(|command_buffer| {
            // SAFETY: the command buffer is recording, outside of a pass, and submitted once right after.
            let mut encoder = gpu.encoder_on_host("frame", unsafe { HostCommands::recording(command_buffer) });
            draw_into(&host, command_buffer, &handles, |command_buffer| {
                // SAFETY: the pass's one target has this format and size; the command buffer is that of the encoder.
                let rendering = unsafe { HostRendering::begun(command_buffer, formats) };
                let desc = HostPass { name: "host pass", rendering, origin, size, is_y_down };
                let record = |pass: &mut RenderPass<'_>| {
                    pass.pipeline(&pipeline);
                    pass.vertices(0, position, 0, 8);
                    pass.vertices(1, &color, 0, 16);
                    pass.draw(3, 1);
                };
                encoder.host_pass(&desc, record);
            });
            frame = Some(encoder.finish_on_host());
        });
        let (token, result) = frame.unwrap();
        // SAFETY: the host has just waited for its queue.
        unsafe { gpu.frame_passed(token) }.unwrap();
        // SAFETY: image and view are alive, of this format and size, and were left in this layout.
        let image = unsafe { Image::from_host(&gpu, &host_image(&handles, vk::ImageLayout::GENERAL)) };
        result.map(|()| gpu.read_image(&image).unwrap())
    };
    // Columns and rows that are covered, from the top left corner.
    let covered = |columns: std::ops::Range<u32>, rows: std::ops::Range<u32>| -> Vec<u8> {
        let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
        pixels.flat_map(|(x, y)| if columns.contains(&x) && rows.contains(&y) { COLOR_BYTES } else { [0; 4] }).collect()
    };
    assert_eq!(draw([0, 0], SIZE, false, &covering, formats).unwrap(), covered(0..4, 0..2));
    assert_eq!(draw([1, 1], [2, 1], false, &covering, formats).unwrap(), covered(1..3, 1..2), "a part of the target");
    assert_eq!(draw([0, 0], SIZE, false, &upper, formats).unwrap(), covered(0..4, 0..1), "up is up");
    assert_eq!(draw([0, 0], SIZE, true, &upper, formats).unwrap(), covered(0..4, 1..2), "clip space points down");
    let others = TargetFormats::new([vk::Format::R16G16B16A16_SFLOAT], None, 1);
    let error = draw([0, 0], SIZE, false, &covering, others).unwrap_err();
    assert!(matches!(error, GpuError::Interface { .. }), "{error}");
    drop((covering, upper, color, pipeline));
    assert_eq!(gpu.host_frames_in_flight(), 0);
    drop(gpu);
    end(host, &handles);
    assert_eq!(messages(), Vec::<String>::new());
}

#[test]
fn a_token_frees_its_own_frame_and_no_other() {
    let host = Host::new();
    let handles = image(&host);
    // SAFETY: the handles belong together and outlive every object made from them below.
    let gpu = unsafe { Gpu::from_host(host.lend()) }.unwrap_or_else(|error| panic!("{error}"));
    let [first, second, third] = ["first", "second", "third"].map(|name| frame_with(&gpu, &host, name));
    assert_eq!((gpu.host_frames_in_flight(), owners(&gpu)), (3, vec!["first".into(), "second".into(), "third".into()]));
    // SAFETY: the host has waited for its queue after each.
    unsafe { gpu.frame_passed(second) }.unwrap();
    assert_eq!((gpu.host_frames_in_flight(), owners(&gpu)), (2, vec!["first".into(), "third".into()]));

    // On a timeline nothing happens before the host says where that is.
    gpu.frame_on_timeline(first, 5).unwrap();
    gpu.frame_on_timeline(third, 7).unwrap();
    // SAFETY: as above.
    unsafe { gpu.timeline_passed(4) };
    assert_eq!(owners(&gpu), ["first", "third"]);
    // SAFETY: as above.
    unsafe { gpu.timeline_passed(6) };
    assert_eq!(owners(&gpu), ["third"]);
    // SAFETY: as above.
    unsafe { gpu.timeline_passed(7) };
    assert_eq!((gpu.host_frames_in_flight(), owners(&gpu)), (0, Vec::new()));
    drop(gpu);
    end(host, &handles);
    assert_eq!(messages(), Vec::<String>::new());
}

#[test]
fn a_token_of_another_device_is_refused_and_a_lost_one_goes_with_its_device() {
    let [host, other] = [Host::new(), Host::new()];
    let [handles, other_handles] = [&host, &other].map(image);
    // SAFETY: the handles belong together and outlive every object made from them below.
    let gpu = unsafe { Gpu::from_host(host.lend()) }.unwrap_or_else(|error| panic!("{error}"));
    // SAFETY: as above.
    let other_gpu = unsafe { Gpu::from_host(other.lend()) }.unwrap_or_else(|error| panic!("{error}"));
    let [first, second] = ["first", "second"].map(|name| frame_with(&gpu, &host, name));
    // SAFETY: the host has waited for its queue after each.
    let refused = unsafe { other_gpu.frame_passed(first) };
    for refused in [refused, other_gpu.frame_on_timeline(second, 1)] {
        let error = refused.unwrap_err().to_string();
        assert!(error.contains("frame token") && error.contains("another device"), "{error}");
    }
    assert_eq!((gpu.host_frames_in_flight(), other_gpu.host_frames_in_flight()), (2, 0));
    assert_eq!(owners(&gpu), ["first", "second"], "nobody has said that they have passed");
    drop((gpu, other_gpu));
    end(host, &handles);
    end(other, &other_handles);
    assert_eq!(messages(), Vec::<String>::new());
}
