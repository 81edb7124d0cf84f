//! The device layer keeps its promises on a real device, with validation and synchronization validation clean.
//!
//! Needs a Vulkan device and the validation layer; without them these tests fail and say what to install.
#[path = "support/colored.rs"]
mod colored;
#[path = "support/glsl.rs"]
mod glsl;
#[path = "support/small_shaders.rs"]
mod small_shaders;

use colored::{COLORED_FRAG, COLORED_VERT};
use small_shaders::*;
use std::sync::LazyLock;
use vair::gpu::vk;
use vair::gpu::*;
use vair::shader::Shader;

const WAIT_MS: u64 = 60_000;
const RGBA8: vk::Format = vk::Format::R8G8B8A8_UNORM;

/// A device under validation. Opened first, it is dropped after all that a test makes, and fails the test then if the
/// validation layer has said anything, up to the end of the device itself.
struct Validated {
    gpu: Option<Gpu>,
    log: ValidationLog,
}

impl std::ops::Deref for Validated {
    type Target = Gpu;
    fn deref(&self) -> &Gpu {
        self.gpu.as_ref().expect("a device until the drop")
    }
}

impl Drop for Validated {
    fn drop(&mut self) {
        self.gpu = None;
        if !std::thread::panicking() {
            assert_eq!(self.log.messages(), Vec::<String>::new());
        }
    }
}

fn open_raw() -> Gpu {
    Gpu::new(&GpuOptions { validate: true, ..GpuOptions::default() }).unwrap_or_else(|error| panic!("{error}"))
}

fn open() -> Validated {
    let gpu = open_raw();
    Validated { log: gpu.validation_log(), gpu: Some(gpu) }
}

/// A device buffer with these contents.
fn filled<T: bytemuck::NoUninit>(gpu: &Gpu, name: &str, usage: vk::BufferUsageFlags, values: &[T]) -> Buffer {
    let buffer = gpu.buffer(name, size_of_val(values) as u64, usage, Memory::Device).unwrap();
    let mut upload = gpu.upload();
    upload.buffer(&buffer, 0, bytemuck::cast_slice(values));
    upload.finish().unwrap();
    buffer
}

fn colored_pipeline(gpu: &Gpu, format: vk::Format, samples: u32) -> Pipeline {
    gpu.graphics_pipeline(&GraphicsDesc {
        name: "colored",
        vertex: &COLORED_VERT,
        fragment: Some(&COLORED_FRAG),
        constants: &[],
        topology: vk::PrimitiveTopology::TRIANGLE_LIST,
        samples,
        color: &[ColorState::replace(format)],
        depth: None,
    })
    .unwrap()
}

fn tint_desc<'a>(constants: &'a [(&'a str, u32)]) -> GraphicsDesc<'a> {
    GraphicsDesc {
        name: "tint",
        vertex: &FULL_VERT,
        fragment: Some(&TINT_FRAG),
        constants,
        topology: vk::PrimitiveTopology::TRIANGLE_LIST,
        samples: 1,
        color: const { &[ColorState::replace(RGBA8)] },
        depth: None,
    }
}

fn tint_pipeline(gpu: &Gpu, constants: &[(&str, u32)]) -> Result<Pipeline, GpuError> {
    gpu.graphics_pipeline(&tint_desc(constants))
}

fn target(gpu: &Gpu, name: &str, size: [u32; 2], format: vk::Format, samples: u32) -> Image {
    let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT;
    let usage = if samples == 1 { usage | vk::ImageUsageFlags::SAMPLED } else { usage };
    gpu.image(&ImageDesc { name, size, format, mip_levels: 1, samples, usage, is_cube: false }).unwrap()
}

fn texture(gpu: &Gpu, name: &str, size: [u32; 2], mip_levels: u32) -> Image {
    let usage = vk::ImageUsageFlags::SAMPLED;
    gpu.image(&ImageDesc { name, size, format: RGBA8, mip_levels, samples: 1, usage, is_cube: false }).unwrap()
}

fn clear(image: &Image, color: [f32; 4]) -> ColorTarget<'_> {
    ColorTarget { image, load: Load::Clear(color), store: true, resolve: None }
}

fn pass<'a>(name: &'a str, color: &'a [ColorTarget<'a>]) -> RenderPassDesc<'a> {
    RenderPassDesc { name, size: color[0].image.size(), color, depth: None, sampled: &[] }
}

const VERTEX: vk::BufferUsageFlags = vk::BufferUsageFlags::VERTEX_BUFFER;
/// A triangle that covers everything.
const COVER: [[f32; 2]; 3] = [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]];
/// 51, 102, 153 and 255 of 255.
const COLOR: [f32; 4] = [0.2, 0.4, 0.6, 1.0];
const COLOR_BYTES: [u8; 4] = [51, 102, 153, 255];

#[test]
fn every_device_is_listed_with_what_it_lacks() {
    let devices = devices().unwrap_or_else(|error| panic!("{error}"));
    assert!(devices.iter().any(|device| device.missing.is_empty()), "{devices:?}");
    for device in devices {
        assert!(!device.name.is_empty() && device.api.split('.').count() == 3, "{device:?}");
    }
}

#[test]
fn a_device_is_found_by_part_of_its_name_and_an_unknown_name_lists_what_there_is() {
    let gpu = open();
    let part = gpu.info().name.to_uppercase()[..4].to_owned();
    let options = GpuOptions { device: Some(part), ..GpuOptions::default() };
    assert!(Gpu::new(&options).is_ok());
    let options = GpuOptions { device: Some("no such card".into()), ..GpuOptions::default() };
    let error = Gpu::new(&options).err().unwrap();
    assert!(matches!(error, GpuError::NoDevice { .. }));
    assert!(error.to_string().contains(&gpu.info().name), "{error}");
}

#[test]
fn bytes_go_to_a_device_buffer_and_back() {
    let gpu = open();
    let values: Vec<u32> = (0..10_000).map(|i: u32| i.wrapping_mul(2_654_435_761)).collect();
    let buffer = filled(&gpu, "numbers", vk::BufferUsageFlags::STORAGE_BUFFER, &values);
    let back = gpu.buffer("back", buffer.bytes(), vk::BufferUsageFlags::empty(), Memory::Readback).unwrap();
    let mut encoder = gpu.encoder("copy").unwrap();
    encoder.copy_buffer(&buffer, &back);
    encoder.submit().unwrap().wait(WAIT_MS).unwrap();
    assert_eq!(back.read::<u32>().unwrap(), values);
}

#[test]
fn reads_and_writes_out_of_range_are_errors() {
    let gpu = open();
    let upload = gpu.buffer("in", 16, VERTEX, Memory::Upload).unwrap();
    upload.write(4, &[1_u32, 2, 3]).unwrap();
    for (offset, count) in [(8, 3), (17, 0), (u64::MAX, 1)] {
        let error = upload.write(offset, &vec![0_u32; count]).unwrap_err();
        assert!(matches!(error, GpuError::Range { .. }), "{error}");
    }
    assert!(upload.read::<u32>().is_err());
    let back = gpu.buffer("out", 10, vk::BufferUsageFlags::empty(), Memory::Readback).unwrap();
    assert!(back.read::<u32>().is_err());
    assert_eq!(back.read::<u8>().unwrap().len(), 10);
    assert!(back.write(0, &[0_u8]).is_err());
    assert!(gpu.buffer("none", 0, VERTEX, Memory::Device).is_err());
    let mut too_much = gpu.upload();
    too_much.buffer(&upload, 12, &[0; 8]);
    assert!(matches!(too_much.finish(), Err(GpuError::Range { .. })));
}

#[test]
fn an_image_is_uploaded_level_by_level_and_read_back() {
    let gpu = open();
    let image = texture(&gpu, "texture", [5, 3], 2);
    let level_0: Vec<u8> = (0..5 * 3 * 4).collect();
    let mut upload = gpu.upload();
    upload.image(&image, &[&level_0, &[9; 2 * 4]]);
    upload.finish().unwrap();
    assert_eq!(gpu.read_image(&image).unwrap(), level_0);

    let mut upload = gpu.upload();
    upload.image(&image, &[&level_0[1..]]);
    let error = upload.finish().unwrap_err().to_string();
    assert!(error.contains("'texture'") && error.contains("59") && error.contains("60"), "{error}");
}

#[test]
fn staging_in_many_pieces_keeps_every_byte() {
    let gpu = open();
    let pieces: Vec<Vec<u8>> = (0..5_u8).map(|piece| vec![piece + 1; 3_000_001]).collect();
    let buffer = gpu.buffer("pieces", 5 * 3_000_001, VERTEX, Memory::Device).unwrap();
    let mut upload = gpu.upload();
    for (piece, bytes) in (0..).zip(&pieces) {
        upload.buffer(&buffer, piece * 3_000_001, bytes);
    }
    upload.finish().unwrap();
    let back = gpu.buffer("back", buffer.bytes(), vk::BufferUsageFlags::empty(), Memory::Readback).unwrap();
    let mut encoder = gpu.encoder("copy").unwrap();
    encoder.copy_buffer(&buffer, &back);
    encoder.submit().unwrap().wait(WAIT_MS).unwrap();
    assert!(back.read::<u8>().unwrap() == pieces.concat());
}

#[test]
fn a_triangle_with_a_constant_colour_stream_has_exact_pixels_and_y_is_up() {
    let gpu = open();
    let pipeline = colored_pipeline(&gpu, RGBA8, 1);
    // The half of clip space with y > 0, as two triangles.
    let upper: [[f32; 2]; 6] = [[-1.0, 0.0], [1.0, 0.0], [1.0, 1.0], [-1.0, 0.0], [1.0, 1.0], [-1.0, 1.0]];
    let positions = filled(&gpu, "positions", VERTEX, &upper);
    let color = filled(&gpu, "color", VERTEX, &COLOR);
    let indices: [u32; 6] = [0, 1, 2, 3, 4, 5];
    let indices = filled(&gpu, "indices", vk::BufferUsageFlags::INDEX_BUFFER, &indices);
    let image = target(&gpu, "picture", [4, 4], RGBA8, 1);

    let mut encoder = gpu.encoder("frame").unwrap();
    encoder.render_pass(&pass("draw", &[clear(&image, [0.0; 4])]), |pass| {
        pass.pipeline(&pipeline);
        pass.vertices(0, &positions, 0, 8);
        pass.vertices(1, &color, 0, 0);
        pass.indices(&indices, 0);
        pass.cull(vk::CullModeFlags::BACK, vk::FrontFace::COUNTER_CLOCKWISE);
        pass.draw_indexed(6, 1, 0, 0);
    });
    let times = encoder.submit().unwrap().wait(WAIT_MS).unwrap();

    let pixels = gpu.read_image(&image).unwrap();
    let expected = [[COLOR_BYTES; 8], [[0; 4]; 8]].concat().concat();
    assert_eq!(pixels, expected, "counter-clockwise is front, row 0 is up");
    let draw = &times.passes[0];
    assert_eq!((draw.name.as_str(), draw.draws, draw.instances, draw.triangles), ("draw", 1, 1, 2));
    if gpu.info().timestamp_bits > 0 {
        assert!(draw.gpu_ms.unwrap() > 0.0 && times.gpu_ms.unwrap() >= draw.gpu_ms.unwrap());
    }
    if gpu.info().pipeline_statistics {
        let statistics = draw.statistics.unwrap();
        assert_eq!((statistics.input_vertices, statistics.input_primitives), (6, 2));
    }
}

#[test]
fn four_samples_resolve_to_their_average() {
    let gpu = open();
    let format = vk::Format::R16G16B16A16_SFLOAT;
    let pipeline = colored_pipeline(&gpu, format, 4);
    // Covers x < 2.5 of 4 pixels; the standard sample positions lie at 1/8, 3/8, 5/8 and 7/8 of a pixel.
    let edge = 2.5 / 2.0 - 1.0;
    let left: [[f32; 2]; 6] = [[-1.0, -1.0], [edge, -1.0], [edge, 1.0], [-1.0, -1.0], [edge, 1.0], [-1.0, 1.0]];
    let positions = filled(&gpu, "positions", VERTEX, &left);
    let color = filled(&gpu, "color", VERTEX, &[1.0_f32; 4]);
    let image = target(&gpu, "multisampled", [4, 1], format, 4);
    let resolved = target(&gpu, "resolved", [4, 1], format, 1);
    let mut encoder = gpu.encoder("frame").unwrap();
    let color_target = ColorTarget { resolve: Some(&resolved), store: false, ..clear(&image, [0.0; 4]) };
    encoder.render_pass(&pass("draw", &[color_target]), |pass| {
        pass.pipeline(&pipeline);
        pass.vertices(0, &positions, 0, 8);
        pass.vertices(1, &color, 0, 0);
        pass.draw(6, 1);
    });
    encoder.submit().unwrap();
    let bytes = gpu.read_image(&resolved).unwrap();
    let reds: Vec<u16> = bytes.chunks_exact(8).map(|texel| u16::from_le_bytes([texel[0], texel[1]])).collect();
    // Half floats 1, 1, 1/2, 0.
    assert_eq!(reds, [0x3c00, 0x3c00, 0x3800, 0]);
}

#[test]
fn what_compute_writes_is_drawn_even_with_a_copy_between() {
    let gpu = open();
    let compute = gpu.compute_pipeline("corners", &CORNERS_COMP, &[]).unwrap();
    let draw = colored_pipeline(&gpu, RGBA8, 1);
    let usage = vk::BufferUsageFlags::STORAGE_BUFFER | VERTEX;
    let corners = gpu.buffer("corners", 24, usage, Memory::Device).unwrap();
    let back = gpu.buffer("back", 24, vk::BufferUsageFlags::empty(), Memory::Readback).unwrap();
    let color = filled(&gpu, "color", VERTEX, &COLOR);
    let group = gpu.bind_group(&compute, 0, "corners", &[("corners", Resource::Buffer(&corners))]).unwrap();
    let image = target(&gpu, "picture", [2, 2], RGBA8, 1);
    // Twice: the second frame writes what the first one read.
    for _ in 0..2 {
        let mut encoder = gpu.encoder("frame").unwrap();
        // Twice: the second pass writes what the first one wrote.
        for _ in 0..2 {
            encoder.compute_pass("corners", &[], |pass| {
                pass.pipeline(&compute);
                pass.bind(0, &group);
                pass.dispatch([1, 1, 1]);
            });
        }
        encoder.copy_buffer(&corners, &back);
        encoder.render_pass(&pass("draw", &[clear(&image, [0.0; 4])]), |pass| {
            pass.pipeline(&draw);
            pass.vertices(0, &corners, 0, 8);
            pass.vertices(1, &color, 0, 0);
            pass.draw(3, 1);
        });
        encoder.submit().unwrap();
    }
    assert_eq!(gpu.read_image(&image).unwrap(), COLOR_BYTES.repeat(4));
    assert_eq!(back.read::<[f32; 2]>().unwrap(), COVER);
}

#[test]
fn a_storage_image_is_written_by_compute_and_sampled_by_a_draw() {
    let gpu = open();
    let usage = vk::ImageUsageFlags::STORAGE | vk::ImageUsageFlags::SAMPLED;
    let desc =
        ImageDesc { name: "painted", size: [4, 4], format: RGBA8, mip_levels: 1, samples: 1, usage, is_cube: false };
    let painted = gpu.image(&desc).unwrap();
    let paint = gpu.compute_pipeline("paint", &PAINT_COMP, &[]).unwrap();
    let paint_group = gpu.bind_group(&paint, 0, "paint", &[("picture", Resource::StorageImage(&painted))]).unwrap();
    let tint = tint_pipeline(&gpu, &[]).unwrap();
    let value = gpu.buffer("tint", 16, vk::BufferUsageFlags::UNIFORM_BUFFER, Memory::Upload).unwrap();
    value.write(0, &[1.0_f32; 4]).unwrap();
    let nearest = SamplerDesc { mag: vk::Filter::NEAREST, min: vk::Filter::NEAREST, ..SamplerDesc::default() };
    let sampler = gpu.sampler(&nearest).unwrap();
    let offered = [
        ("tint", Resource::Buffer(&value)),
        ("base", Resource::Texture(&painted)),
        ("base_sampler", Resource::Sampler(&sampler)),
    ];
    let tint_group = gpu.bind_group(&tint, 0, "tint", &offered).unwrap();
    let base_group = gpu.bind_group(&tint, 1, "base", &offered).unwrap();
    let image = target(&gpu, "picture", [1, 1], RGBA8, 1);
    let mut encoder = gpu.encoder("frame").unwrap();
    encoder.compute_pass("paint", &[], |pass| {
        pass.pipeline(&paint);
        pass.bind(0, &paint_group);
        pass.dispatch([1, 1, 1]);
    });
    let colors = [clear(&image, [0.0; 4])];
    encoder.render_pass(&RenderPassDesc { sampled: &[&painted], ..pass("draw", &colors) }, |pass| {
        pass.push(&[0.0_f32, 0.0, 0.6, 0.0]);
        pass.bind(0, &tint_group);
        pass.bind(1, &base_group);
        pass.pipeline(&tint);
        pass.draw(3, 1);
    });
    encoder.submit().unwrap();
    // The middle belongs to texel (2, 2): 102, 102; blue comes from the push constant.
    assert_eq!(gpu.read_image(&image).unwrap(), [102, 102, 153, 255]);
}

#[test]
fn a_hazard_is_caught() {
    let gpu = open_raw();
    let buffer = gpu.buffer("twice", 64, VERTEX, Memory::Device).unwrap();
    let mut upload = gpu.upload();
    upload.buffer(&buffer, 0, &[1; 64]);
    upload.buffer(&buffer, 0, &[2; 64]);
    upload.finish().unwrap();
    let messages = gpu.validation_messages();
    assert!(messages.iter().any(|message| message.contains("SYNC-HAZARD-WRITE-AFTER-WRITE")), "{messages:?}");
}

#[test]
fn a_wrong_shader_table_is_caught() {
    let gpu = open_raw();
    static FORGETFUL: LazyLock<Shader> = LazyLock::new(|| Shader { push_constant_bytes: 0, ..*TINT_FRAG });
    let desc = GraphicsDesc { fragment: Some(&FORGETFUL), ..tint_desc(&[]) };
    gpu.graphics_pipeline(&desc).unwrap();
    let messages = gpu.validation_messages();
    assert!(messages.iter().any(|message| message.starts_with("error: VUID-")), "{messages:?}");
}

#[test]
fn what_the_device_uses_is_freed_when_it_is_done() {
    let gpu = open();
    let holds = |name: &str| gpu.memory().by_owner.iter().any(|(owner, bytes)| owner == name && *bytes > 0);
    let source = filled(&gpu, "short-lived", VERTEX, &[1_u32; 64]);
    let back = gpu.buffer("back", 256, vk::BufferUsageFlags::empty(), Memory::Readback).unwrap();
    let mut encoder = gpu.encoder("copy").unwrap();
    encoder.copy_buffer(&source, &back);
    drop(source);
    assert!(holds("short-lived"), "the encoder keeps it");
    let submission = encoder.submit().unwrap();
    assert!(holds("short-lived"), "the submission keeps it");
    submission.wait(WAIT_MS).unwrap();
    assert!(!holds("short-lived"), "nobody keeps it");
    assert_eq!(back.read::<u32>().unwrap(), [1; 64]);
}

#[test]
fn memory_is_reported_by_owner_with_its_peak() {
    let gpu = open();
    let first = gpu.buffer("geometry", 1 << 20, VERTEX, Memory::Device).unwrap();
    let second = gpu.buffer("geometry", 1 << 20, VERTEX, Memory::Device).unwrap();
    let image = target(&gpu, "color", [64, 64], RGBA8, 1);
    let report = gpu.memory();
    let owners: Vec<&str> = report.by_owner.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(owners, ["color", "geometry"]);
    assert!(report.by_owner[1].1 >= 2 << 20);
    assert_eq!(report.device_bytes, report.by_owner.iter().map(|(_, bytes)| bytes).sum::<u64>());
    drop((first, second, image));
    let after = gpu.memory();
    assert_eq!((after.device_bytes, after.by_owner.len()), (0, 0));
    assert_eq!(after.peak_bytes, report.device_bytes);
}

#[test]
fn a_group_without_a_name_that_the_shader_has_names_pipeline_set_and_binding() {
    let gpu = open();
    let pipeline = tint_pipeline(&gpu, &[]).unwrap();
    let sampler = gpu.sampler(&SamplerDesc::default()).unwrap();
    let error = |set, resources: &[(&str, Resource<'_>)]| {
        gpu.bind_group(&pipeline, set, "group", resources).err().unwrap().to_string()
    };
    let missing = error(1, &[("base_sampler", Resource::Sampler(&sampler))]);
    assert!(missing.contains("'tint'") && missing.contains("set 1 binding 0 'base'"), "{missing}");
    let wrong = error(1, &[("base", Resource::Sampler(&sampler))]);
    assert!(wrong.contains("SAMPLED_IMAGE") && wrong.contains("a sampler"), "{wrong}");
    let small = gpu.buffer("small", 8, vk::BufferUsageFlags::UNIFORM_BUFFER, Memory::Upload).unwrap();
    let short = error(0, &[("tint", Resource::Buffer(&small))]);
    assert!(short.contains("8 bytes") && short.contains("16"), "{short}");
    let unusable = gpu.buffer("vertices", 16, VERTEX, Memory::Upload).unwrap();
    let usage = error(0, &[("tint", Resource::Buffer(&unusable))]);
    assert!(usage.contains("UNIFORM_BUFFER"), "{usage}");
    assert!(error(9, &[]).contains("set 9"));
}

#[test]
fn a_draw_that_lacks_something_fails_the_submission_and_nothing_else() {
    let gpu = open();
    let colored = colored_pipeline(&gpu, RGBA8, 1);
    let tint = tint_pipeline(&gpu, &[]).unwrap();
    let image = target(&gpu, "picture", [2, 2], RGBA8, 1);
    let other = target(&gpu, "other", [2, 2], vk::Format::R16G16B16A16_SFLOAT, 1);
    let fails = |image: &Image, record: &dyn Fn(&mut RenderPass<'_>)| {
        let mut encoder = gpu.encoder("frame").unwrap();
        encoder.render_pass(&pass("draw", &[clear(image, [0.0; 4])]), |pass| record(pass));
        encoder.submit().err().unwrap().to_string()
    };
    let no_stream = fails(&image, &|pass| {
        pass.pipeline(&colored);
        pass.draw(3, 1);
    });
    assert!(no_stream.contains("'colored'") && no_stream.contains("vertex input 0 'position'"), "{no_stream}");
    let no_group = fails(&image, &|pass| {
        pass.pipeline(&tint);
        pass.draw(3, 1);
    });
    assert!(no_group.contains("set 0 is not bound"), "{no_group}");
    assert!(fails(&image, &|pass| pass.draw(3, 1)).contains("without a pipeline"));
    let wrong_format = fails(&other, &|pass| pass.pipeline(&colored));
    assert!(wrong_format.contains("R16G16B16A16_SFLOAT"), "{wrong_format}");

    // Nothing of the above was submitted, so the image is still undefined and may be drawn.
    let mut encoder = gpu.encoder("frame").unwrap();
    encoder.render_pass(&pass("clear", &[clear(&image, COLOR)]), |_| ());
    encoder.submit().unwrap();
    assert_eq!(gpu.read_image(&image).unwrap(), COLOR_BYTES.repeat(4));
}

#[test]
fn constants_are_given_by_name_and_described() {
    let gpu = open();
    let pipeline = tint_pipeline(&gpu, &[("channel_count", 3)]).unwrap();
    let expected = "graphics 'tint'
  Vertex shader: full.vert
  Fragment shader: tint.frag
    constant 7 channel_count = 0x00000003
  set 0 binding 0: UNIFORM_BUFFER_DYNAMIC 'tint' of 16 bytes
  set 1 binding 0: SAMPLED_IMAGE 'base'
  set 1 binding 1: SAMPLER 'base_sampler'
  push constants: 16 bytes
  topology: TRIANGLE_LIST
  samples: 1
  color 0: R8G8B8A8_UNORM write R | G | B | A blend none
  depth: none
";
    assert_eq!(pipeline.description(), expected);
    assert!(pipeline.creation_ms() > 0.0);
    let error = tint_pipeline(&gpu, &[("channels", 3)]).err().unwrap().to_string();
    assert!(error.contains("'channels'") && error.contains("channel_count"), "{error}");
}

#[test]
fn an_image_beyond_the_device_is_refused_with_the_limit() {
    let gpu = open();
    let image = |size, samples, mip_levels| {
        let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT;
        gpu.image(&ImageDesc { name: "huge", size, format: RGBA8, mip_levels, samples, usage, is_cube: false })
            .err()
            .unwrap()
    };
    let error = image([100_000, 100_000], 1, 1);
    let limit = gpu.info().max_image_size.to_string();
    assert!(matches!(error, GpuError::Size { .. }) && error.to_string().contains(&limit), "{error}");
    assert!(matches!(image([0, 4], 1, 1), GpuError::Size { .. }));
    assert!(matches!(image([4, 4], 3, 1), GpuError::Unsupported { .. }));
    assert!(matches!(image([4, 4], 1, 4), GpuError::Unsupported { .. }));
    let too_much = gpu.buffer("ocean", 1 << 50, VERTEX, Memory::Device).err().unwrap();
    assert!(matches!(too_much, GpuError::OutOfMemory { .. } | GpuError::Vulkan { .. }), "{too_much}");
}

#[test]
fn a_damaged_pipeline_cache_is_rebuilt() {
    let dir = tempfile::tempdir().unwrap();
    let run = || {
        let pipeline_cache_dir = Some(dir.path().to_owned());
        let gpu = Gpu::new(&GpuOptions { validate: true, pipeline_cache_dir, ..GpuOptions::default() }).unwrap();
        let gpu = Validated { log: gpu.validation_log(), gpu: Some(gpu) };
        colored_pipeline(&gpu, RGBA8, 1);
    };
    run();
    let files: Vec<_> = std::fs::read_dir(dir.path()).unwrap().map(|entry| entry.unwrap().path()).collect();
    let [file] = files.as_slice() else { panic!("one file expected: {files:?}") };
    let whole = std::fs::read(file).unwrap();
    for damage in [Vec::new(), vec![0; 500], whole[..whole.len() - 1].to_vec()] {
        std::fs::write(file, &damage).unwrap();
        run();
        let rebuilt = std::fs::read(file).unwrap();
        assert!(rebuilt.len() >= 48 && rebuilt[..8] == whole[..8], "{} bytes", rebuilt.len());
    }
    run();
}

#[test]
fn equal_samplers_are_one_and_unequal_names_may_repeat() {
    let gpu = open();
    let anisotropic = SamplerDesc { anisotropy: 1e9, ..SamplerDesc::default() };
    for _ in 0..5_000 {
        gpu.sampler(&SamplerDesc::default()).unwrap();
        gpu.sampler(&anisotropic).unwrap();
    }
}

#[test]
fn everything_outlives_the_handle_that_made_it() {
    let gpu = open_raw();
    let log = gpu.validation_log();
    let pipeline = tint_pipeline(&gpu, &[]).unwrap();
    let sampler = gpu.sampler(&SamplerDesc::default()).unwrap();
    let base = texture(&gpu, "base", [2, 2], 1);
    let offered = [("base", Resource::Texture(&base)), ("base_sampler", Resource::Sampler(&sampler))];
    let group = gpu.bind_group(&pipeline, 1, "base", &offered).unwrap();
    let image = target(&gpu, "picture", [2, 2], RGBA8, 1);
    let buffer = gpu.buffer("buffer", 4, VERTEX, Memory::Upload).unwrap();
    let mut encoder = gpu.encoder("frame").unwrap();
    drop(gpu);
    encoder.render_pass(&pass("clear", &[clear(&image, COLOR)]), |_| ());
    let submission = encoder.submit().unwrap();
    drop(image);
    submission.wait(WAIT_MS).unwrap();
    drop(submission);
    buffer.write(0, &[1_u32]).unwrap();
    drop((pipeline, sampler, base, group, buffer));
    assert_eq!(log.messages(), Vec::<String>::new(), "up to the end of the device");
}

#[test]
fn vertices_and_indices_that_do_not_fit_are_errors() {
    let gpu = open();
    let pipeline = colored_pipeline(&gpu, RGBA8, 1);
    let image = target(&gpu, "picture", [2, 2], RGBA8, 1);
    let positions = filled(&gpu, "positions", VERTEX, &COVER);
    let color = filled(&gpu, "color", VERTEX, &COLOR);
    let indices = filled(&gpu, "indices", vk::BufferUsageFlags::INDEX_BUFFER, &[0_u32, 1, 2, u32::MAX]);
    let draw = |stride: u64, index_offset: u64, first: u32, count: u32| {
        let mut encoder = gpu.encoder("frame").unwrap();
        encoder.render_pass(&pass("draw", &[clear(&image, [0.0; 4])]), |pass| {
            pass.vertices(0, &positions, 0, stride);
            pass.vertices(1, &color, 0, 0);
            pass.indices(&indices, index_offset);
            pass.pipeline(&pipeline);
            pass.draw_indexed(count, 1, first, 0);
        });
        encoder.submit().map(|_| ()).map_err(|error| error.to_string())
    };
    assert_eq!(draw(8, 0, 0, 3), Ok(()));
    assert_eq!(gpu.read_image(&image).unwrap(), COLOR_BYTES.repeat(4));
    assert_eq!(draw(8, 0, 1, 3), Ok(()), "an index may have any 32 bits");
    for (index_offset, first, count) in [(0, 0, 5), (4, 1, 3), (0, u32::MAX, u32::MAX)] {
        let error = draw(8, index_offset, first, count).unwrap_err();
        assert!(error.contains("indices are drawn"), "{error}");
    }
    for stride in [4, 6, 2052] {
        assert!(draw(stride, 0, 0, 3).unwrap_err().contains("stride"), "{stride}");
    }
    let mut encoder = gpu.encoder("frame").unwrap();
    encoder.render_pass(&pass("draw", &[clear(&image, [0.0; 4])]), |pass| pass.vertices(0, &positions, 2, 8));
    assert!(matches!(encoder.submit(), Err(GpuError::Range { .. })));
}

#[test]
fn strides_survive_a_pipeline_without_vertex_inputs() {
    let gpu = open();
    let colored = colored_pipeline(&gpu, RGBA8, 1);
    let tint = tint_pipeline(&gpu, &[]).unwrap();
    let image = target(&gpu, "picture", [2, 2], RGBA8, 1);
    let positions = filled(&gpu, "positions", VERTEX, &COVER);
    let color = filled(&gpu, "color", VERTEX, &COLOR);
    let mut encoder = gpu.encoder("frame").unwrap();
    encoder.render_pass(&pass("draw", &[clear(&image, [0.0; 4])]), |pass| {
        pass.vertices(0, &positions, 0, 8);
        pass.vertices(1, &color, 0, 0);
        pass.pipeline(&colored);
        pass.draw(3, 1);
        pass.pipeline(&tint);
        pass.pipeline(&colored);
        pass.draw(3, 1);
    });
    encoder.submit().unwrap();
    assert_eq!(gpu.read_image(&image).unwrap(), COLOR_BYTES.repeat(4));
}

#[test]
fn an_image_is_recorded_by_one_encoder_at_a_time() {
    let gpu = open();
    let image = target(&gpu, "picture", [2, 2], RGBA8, 1);
    let record = |encoder: &mut Encoder| {
        encoder.render_pass(&pass("clear", &[clear(&image, COLOR)]), |_| ());
    };
    let mut first = gpu.encoder("first").unwrap();
    record(&mut first);
    let mut second = gpu.encoder("second").unwrap();
    record(&mut second);
    let error = second.submit().err().unwrap().to_string();
    assert!(error.contains("'picture'") && error.contains("another encoder"), "{error}");
    // The first is dropped unsubmitted: the image is free, and as undefined as before.
    drop(first);
    let mut third = gpu.encoder("third").unwrap();
    record(&mut third);
    third.submit().unwrap();
    assert_eq!(gpu.read_image(&image).unwrap(), COLOR_BYTES.repeat(4));
}

#[test]
fn an_image_that_one_dispatch_writes_and_samples_is_an_error() {
    let gpu = open();
    let usage = vk::ImageUsageFlags::STORAGE | vk::ImageUsageFlags::SAMPLED;
    let both = |name| {
        let desc = ImageDesc { name, size: [4, 4], format: RGBA8, mip_levels: 1, samples: 1, usage, is_cube: false };
        gpu.image(&desc).unwrap()
    };
    let (one, other) = (both("one"), both("other"));
    let copy = gpu.compute_pipeline("copy", &COPY_COMP, &[]).unwrap();
    let group = |set, name, resource| gpu.bind_group(&copy, set, name, &[(name, resource)]).unwrap();
    let to_one = group(0, "target", Resource::StorageImage(&one));
    let to_other = group(0, "target", Resource::StorageImage(&other));
    let from_one = group(1, "source", Resource::Texture(&one));
    let from_other = group(1, "source", Resource::Texture(&other));
    let paint = gpu.compute_pipeline("paint", &PAINT_COMP, &[]).unwrap();
    let paint_one = gpu.bind_group(&paint, 0, "paint", &[("picture", Resource::StorageImage(&one))]).unwrap();
    let record = |from: &BindGroup, to: &BindGroup| {
        let mut encoder = gpu.encoder("frame").unwrap();
        encoder.compute_pass("both", &[], |pass| {
            pass.pipeline(&paint);
            pass.bind(0, &paint_one);
            pass.dispatch([1, 1, 1]);
            pass.pipeline(&copy);
            pass.bind(0, to);
            pass.bind(1, from);
            pass.dispatch([1, 1, 1]);
        });
        encoder.submit()
    };
    for (from, to) in [(&from_one, &to_one), (&from_other, &to_other)] {
        let error = record(from, to).err().unwrap().to_string();
        assert!(error.contains("Sampled") && error.contains("Storage"), "{error}");
    }
    record(&from_one, &to_other).unwrap();
    assert_eq!(gpu.read_image(&other).unwrap(), gpu.read_image(&one).unwrap());
}

#[test]
fn many_passes_and_frames_in_flight_are_all_timed() {
    let gpu = open();
    let image = target(&gpu, "picture", [2, 2], RGBA8, 1);
    let submissions: Vec<_> = (0..4)
        .map(|frame| {
            let mut encoder = gpu.encoder("frame").unwrap();
            for index in 0..40 {
                let name = format!("pass {frame} {index}");
                encoder.render_pass(&pass(&name, &[clear(&image, COLOR)]), |_| ());
            }
            encoder.submit().unwrap()
        })
        .collect();
    for submission in submissions {
        let times = submission.wait(WAIT_MS).unwrap();
        assert_eq!(times.passes.len(), 40);
        if gpu.info().timestamp_bits > 0 {
            assert!(times.passes.iter().all(|pass| pass.gpu_ms.is_some()));
        }
    }
}
