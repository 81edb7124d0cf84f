//! A host's frame in its steady state: nothing is made, nothing is destroyed, and the heap is asked for next to nothing,
//! however many instances are drawn. The allocator counts for the whole binary, so it is one of its own.
#![allow(unsafe_code)]
#[path = "../examples/engine/mod.rs"]
#[allow(dead_code, reason = "the backend's tests and the example use the rest")]
mod engine;

use engine::{Commands, Engine, Pass};
use glam::{Mat4, Quat, Vec3, Vec4};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::time::Instant;
use vair::asset::{Asset, AssetScene, Material, Mesh, Node, Primitive, Skin, procedural};
use vair::gpu::{CallCounts, FrameToken, Gpu, HostCommands, HostRendering, vk};
use vair::math::perspective_infinite;
use vair::render::{DeviceScene, EnvironmentQuality, FrameDesc, InstanceDesc, InstanceId, Renderer, Target, View};
use vair::scene::{EnvironmentLight, Light, Scene};

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

/// Counts what a thread asks for.
struct Counting;

fn count() {
    // Gone at the thread's end, where nobody asks.
    let _ = ALLOCATIONS.try_with(|count| count.set(count.get() + 1));
}

// SAFETY: all is passed on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller's promise.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, new_size: usize) -> *mut u8 {
        count();
        // SAFETY: the caller's promise.
        unsafe { System.realloc(pointer, layout, new_size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

const SIZE: [u32; 2] = [32, 32];
/// Frames of a run; the first [`WARM`] make what is not there yet.
const FRAMES: usize = 10;
const WARM: usize = 2;
const IN_FLIGHT: usize = 2;

/// What frames in the steady state took.
struct Steady {
    /// Allocations of a frame, at most.
    allocations: u64,
    /// Milliseconds of preparing and recording, median.
    cpu_ms: f64,
    /// Vulkan calls of the last frame.
    calls: CallCounts,
}

/// Draws frames with two in flight and checks each after the second.
fn steady(gpu: &Gpu, engine: &Engine, renderer: &mut Renderer, scene: &mut DeviceScene, ids: &[InstanceId]) -> Steady {
    let target = Target::hdr(1);
    let color = engine.target(target.color, SIZE, 1, vk::ImageUsageFlags::COLOR_ATTACHMENT).unwrap();
    let depth = engine.target(target.depth, SIZE, 1, vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT).unwrap();
    let mut slots: Vec<(Commands, Option<FrameToken>)> =
        (0..IN_FLIGHT).map(|_| (engine.commands().unwrap(), None)).collect();
    let lights = [Light::key()];
    let world_from_view = Mat4::from_translation(Vec3::new(0.0, 0.3, 3.0));
    let mut steady = Steady { allocations: 0, cpu_ms: 0.0, calls: CallCounts::default() };
    let mut times_ms = Vec::new();
    let mut live_bytes = None;
    for number in 0..FRAMES {
        let (commands, token) = &mut slots[number % IN_FLIGHT];
        engine.wait(commands).unwrap();
        if let Some(token) = token.take() {
            // SAFETY: its fence has passed.
            unsafe { gpu.frame_passed(token) }.unwrap();
        }
        let buffer = engine.begin(commands).unwrap();
        let bent = Mat4::from_quat(Quat::from_rotation_z(0.1 * number as f32));
        let view = View::new(world_from_view.inverse(), perspective_infinite(0.6, 1.0, 0.05), SIZE);
        let before = gpu.calls();
        let (started, allocated) = (Instant::now(), ALLOCATIONS.get());

        for (index, &id) in ids.iter().enumerate() {
            let root = Mat4::from_translation(place(index));
            scene.set_joints(id, &[root, root * bent]).unwrap();
        }
        // SAFETY: the command buffer is recording, outside of a pass, and submitted once, before any later one.
        let mut frame = renderer.frame(unsafe { HostCommands::recording(buffer) }).unwrap();
        let desc = FrameDesc { views: &[view], target, lights: &lights, step_s: 0.02, ..FrameDesc::default() };
        frame.prepare(scene, &desc).unwrap();
        let (prepared, prepared_allocations) = (started.elapsed(), ALLOCATIONS.get() - allocated);

        engine.barrier(buffer, &color, vk::ImageLayout::UNDEFINED, vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL);
        engine.barrier(buffer, &depth, vk::ImageLayout::UNDEFINED, vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
        let (color, depth) = (Some(&color), Some(&depth));
        let pass = Pass { color, resolve: None, depth, clear_color: [0.0; 4], clear_depth: Some(0.0) };
        engine.begin_rendering(buffer, &pass);

        let (started, allocated) = (Instant::now(), ALLOCATIONS.get());
        // SAFETY: inside a pass of these formats and samples.
        let pass = unsafe { HostRendering::begun(buffer, target.formats()) };
        frame.draw_opaque(pass, scene, 0).unwrap();
        frame.draw_fur(pass, scene, 0).unwrap();
        frame.draw_transparent(pass, scene, 0).unwrap();
        let (recorded, recorded_allocations) = (started.elapsed(), ALLOCATIONS.get() - allocated);

        engine.end_rendering(buffer);
        *token = Some(frame.finish().unwrap());
        engine.submit(commands).unwrap();
        if number < WARM {
            continue;
        }
        steady.calls = gpu.calls().since(&before);
        let is_made =
            |name: &str| ["vkCreate", "vkDestroy", "vkAllocate", "vkFree"].iter().any(|start| name.starts_with(start));
        let made: Vec<_> = steady.calls.by_name.iter().filter(|(name, _)| is_made(name)).collect();
        assert!(made.is_empty(), "frame {number}: {made:?}");
        let bytes: u64 = gpu.memory().by_owner.iter().map(|(_, bytes)| *bytes).sum();
        assert_eq!(*live_bytes.get_or_insert(bytes), bytes, "live memory of frame {number}");
        steady.allocations = steady.allocations.max(prepared_allocations + recorded_allocations);
        times_ms.push((prepared + recorded).as_secs_f64() * 1e3);
    }
    times_ms.sort_by(f64::total_cmp);
    steady.cpu_ms = times_ms[times_ms.len() / 2];
    for (commands, token) in slots {
        engine.wait(&commands).unwrap();
        // SAFETY: its fence has passed.
        token.into_iter().for_each(|token| unsafe { gpu.frame_passed(token) }.unwrap());
        engine.destroy_commands(&commands);
    }
    [color, depth].iter().for_each(|target| engine.destroy_target(target));
    steady
}

/// Lends a host without the validation layer, whose own allocations are none of ours.
fn on_host(check: impl FnOnce(&Gpu, &Engine, &mut Renderer)) {
    let engine = Engine::new(&[], &[]).unwrap();
    let mut lent = engine.lend(false);
    lent.pipeline_cache_dir = Some(env!("CARGO_TARGET_TMPDIR").into());
    // SAFETY: the handles belong together and outlive every object made from them.
    let gpu = unsafe { Gpu::from_host(lent) }.unwrap_or_else(|error| panic!("{error}"));
    let mut renderer = Renderer::with_gpu(gpu.clone());
    check(&gpu, &engine, &mut renderer);
    drop((renderer, gpu));
    engine.destroy();
}

fn place(index: usize) -> Vec3 {
    Vec3::new((index % 10) as f32 * 0.2 - 1.0, (index / 10) as f32 * 0.1, -(index as f32) * 0.01)
}

fn dressed(asset: Asset) -> DeviceScene {
    let mut scene = DeviceScene::new(Scene::from_asset(asset).unwrap());
    scene.set_environment(EnvironmentLight::constant(Vec3::splat(0.5)), EnvironmentQuality::default()).unwrap();
    scene
}

fn material(preset: Option<&str>) -> Material {
    let base_color = Vec4::new(0.6, 0.3, 0.1, 1.0);
    let vair = preset.map(|name| [("preset".to_owned(), serde_json::Value::from(name))].into_iter().collect());
    Material { base_color, metallic: 0.0, vair, ..Material::default() }
}

/// A furred capsule of two joints.
fn furred() -> DeviceScene {
    let mut capsule = procedural::capsule(0.05, 0.06, 8, 8);
    let upper = capsule.vertices.positions.iter().map(|position| (4.0 * position.y + 0.5).clamp(0.0, 1.0));
    capsule.vertices.joints = upper.flat_map(|upper| [(0, 1.0 - upper), (1, upper), (0, 0.0), (0, 0.0)]).collect();
    capsule.vertices.influences_per_vertex = 4;
    dressed(Asset {
        nodes: vec![Node::default(), Node::default()],
        meshes: vec![Mesh { primitives: vec![Primitive { material: 0, ..capsule }], ..Mesh::default() }],
        skins: vec![Skin { joints: vec![0, 1], inverse_bind: vec![Mat4::IDENTITY; 2] }],
        materials: vec![material(Some("fox"))],
        scenes: vec![AssetScene::default()],
        ..Asset::default()
    })
}

fn herd(gpu: &Gpu, engine: &Engine, renderer: &mut Renderer, count: usize) -> Steady {
    let mut scene = furred();
    let desc = InstanceDesc { skin: Some(0), ..InstanceDesc::default() };
    let ids: Vec<InstanceId> = (0..count).map(|_| scene.add(&desc).unwrap()).collect();
    steady(gpu, engine, renderer, &mut scene, &ids)
}

#[test]
fn a_cube_and_the_gallery_make_nothing_after_the_second_frame() {
    on_host(|gpu, engine, renderer| {
        let mut cube = dressed(Asset {
            meshes: vec![Mesh { primitives: vec![procedural::cube(0.5)], ..Mesh::default() }],
            materials: vec![material(None)],
            scenes: vec![AssetScene::default()],
            ..Asset::default()
        });
        cube.add(&InstanceDesc::default()).unwrap();
        let cube = steady(gpu, engine, renderer, &mut cube, &[]);
        let mut gallery = DeviceScene::new(Scene::gallery());
        gallery.add_nodes(0, None).unwrap();
        let gallery = steady(gpu, engine, renderer, &mut gallery, &[]);
        for (name, steady) in [("cube", cube), ("gallery", gallery)] {
            let Steady { allocations, cpu_ms, calls } = steady;
            println!("{name}: {cpu_ms:.3} ms, {} calls, {allocations} allocations", calls.total());
        }
    });
}

#[test]
fn a_hundred_animated_coats_allocate_no_more_than_one() {
    on_host(|gpu, engine, renderer| {
        let one = herd(gpu, engine, renderer, 1);
        let hundred = herd(gpu, engine, renderer, 100);
        for (name, Steady { allocations, cpu_ms, calls }) in [("1", &one), ("100", &hundred)] {
            println!("{name}: {cpu_ms:.3} ms, {} calls, {allocations} allocations", calls.total());
        }
        // What is asked for is asked for a pass; a coat more asks for nothing.
        assert!(hundred.allocations <= one.allocations, "{} and {}", one.allocations, hundred.allocations);
    });
}
