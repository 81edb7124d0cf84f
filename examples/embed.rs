//! vair inside an engine's own frame: `cargo run --example embed [PICTURE.png [--validate]]`.
//!
//! The engine has its own colour and depth, two frames in flight, and something that it draws itself: a box. vair draws two
//! characters of one kind of fur, posed by the engine, into the same pass: one stands before the box, one behind it. What vair
//! writes is linear radiance; the engine's own tone mapping follows.
#![allow(unsafe_code)]

#[allow(dead_code, reason = "tests use all of it")]
mod engine;

use engine::{Commands, Engine, Pass};
use glam::{Mat4, Quat, Vec3, Vec4};
use std::path::Path;
use vair::asset::{Asset, AssetScene, Material, Mesh, Node, Primitive, Skin, procedural};
use vair::gpu::{FrameToken, HostCommands, HostRendering, Image, vk};
use vair::math::perspective_infinite;
use vair::render::{DeviceScene, FrameDesc, InstanceDesc, Picture, Target, View};
use vair::scene::Light;
use vair::{Gpu, LoadOptions, Look, Renderer, Scene};

const SIZE: [u32; 2] = [640, 360];
const FRAMES_IN_FLIGHT: usize = 2;
const FRAMES: usize = 4;
const NEAR_M: f32 = 0.05;
/// Half floats, reversed 32-bit depth, 4 samples a pixel: what the engine draws with already.
const SAMPLES: u32 = 4;

/// A frame in flight: a command buffer, and what stands for vair's part of it.
struct Slot {
    commands: Commands,
    token: Option<FrameToken>,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let out = std::env::args().nth(1).unwrap_or_else(|| "vair.png".to_owned());

    // The engine's own objects.
    let is_validated = std::env::args().nth(2).is_some_and(|word| word == "--validate");
    let engine = Engine::new(if is_validated { &[c"VK_LAYER_KHRONOS_validation"] } else { &[] }, &[])?;
    let [color_use, depth_use] = [vk::ImageUsageFlags::COLOR_ATTACHMENT, vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT];
    let target = Target::hdr(SAMPLES);
    let color = engine.target(target.color, SIZE, SAMPLES, color_use)?;
    let depth = engine.target(target.depth, SIZE, SAMPLES, depth_use)?;
    let resolved = engine.target(target.color, SIZE, 1, color_use | vk::ImageUsageFlags::TRANSFER_SRC)?;
    let new_slot = || Ok::<_, Box<dyn std::error::Error>>(Slot { commands: engine.commands()?, token: None });
    let mut slots = (0..FRAMES_IN_FLIGHT).map(|_| new_slot()).collect::<Result<Vec<Slot>, _>>()?;

    // vair on the engine's device: a renderer, and a scene from memory with two characters of one mesh and fur.
    // SAFETY: the handles belong together and are destroyed after `gpu` and everything made from it.
    let gpu = unsafe { Gpu::from_host(engine.lend(false)) }?;
    let mut renderer = Renderer::with_gpu(gpu.clone());
    let mut scene = DeviceScene::new(Scene::from_asset(character())?);
    scene.apply(&Look::preset("fox", Some("fur"))?, Path::new(""), &LoadOptions::default())?;
    let skinned = InstanceDesc { mesh: 0, skin: Some(0), ..InstanceDesc::default() };
    let characters = [scene.add(&skinned)?, scene.add(&skinned)?];

    // The engine's camera and lights.
    let world_from_view = Mat4::from_translation(Vec3::new(0.0, 0.0, 2.0));
    let clip_from_view = perspective_infinite(0.5, SIZE[0] as f32 / SIZE[1] as f32, NEAR_M);
    let view = View::new(world_from_view.inverse(), clip_from_view, SIZE);
    let lights = [Light::key()];

    for number in 0..FRAMES {
        let slot = &mut slots[number % FRAMES_IN_FLIGHT];
        // This slot's last frame is done: what only that frame used may be used again.
        engine.wait(&slot.commands)?;
        if let Some(token) = slot.token.take() {
            // SAFETY: its fence has passed.
            unsafe { gpu.frame_passed(token) }?;
        }
        let commands = engine.begin(&slot.commands)?;

        // The engine's animation.
        let time_s = number as f32 / 60.0;
        for (id, (place, lean)) in characters.into_iter().zip([(-0.22, 0.5), (0.22, -0.5)]) {
            // The first stands 1.7 m before the camera, the second 2.3 m: the box is between them, at 2 m.
            let root = Mat4::from_translation(Vec3::new(place, 0.0, if place < 0.0 { 0.3 } else { -0.3 }));
            let bent = Mat4::from_quat(Quat::from_rotation_z(lean + 0.1 * (6.0 * time_s).sin()));
            scene.set_joints(id, &[root, root * bent])?;
        }

        // Outside of the pass: what changed is uploaded, characters are posed, shadow maps are drawn.
        // SAFETY: the command buffer is recording, outside of a pass, and submitted once, before any later one.
        let mut frame = renderer.frame(unsafe { HostCommands::recording(commands) })?;
        let desc = FrameDesc { views: &[view], target, lights: &lights, step_s: 1.0 / 60.0, ..FrameDesc::default() };
        frame.prepare(&mut scene, &desc)?;

        // The engine's pass, with its own box in it, into which vair draws.
        let color_layout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
        engine.barrier(commands, &color, vk::ImageLayout::UNDEFINED, color_layout);
        engine.barrier(commands, &resolved, vk::ImageLayout::UNDEFINED, color_layout);
        let depth_layout = vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
        engine.barrier(commands, &depth, vk::ImageLayout::UNDEFINED, depth_layout);
        let clear_color = [0.10, 0.13, 0.18, 1.0];
        let pass = Pass {
            color: Some(&color),
            resolve: Some(&resolved),
            depth: Some(&depth),
            clear_color,
            clear_depth: Some(0.0),
        };
        engine.begin_rendering(commands, &pass);
        engine.fill(commands, box_on_screen(), [0.02, 0.30, 0.28, 1.0], NEAR_M / 2.0);
        // SAFETY: `commands` is inside a dynamic rendering pass of these formats and samples.
        let pass = unsafe { HostRendering::begun(commands, target.formats()) };
        frame.draw_opaque(pass, &scene, 0)?;
        frame.draw_fur(pass, &scene, 0)?;
        frame.draw_transparent(pass, &scene, 0)?;
        engine.end_rendering(commands);

        slot.token = Some(frame.finish()?);
        engine.submit(&slot.commands)?;
    }

    for slot in &mut slots {
        engine.wait(&slot.commands)?;
        if let Some(token) = slot.token.take() {
            // SAFETY: its fence has passed.
            unsafe { gpu.frame_passed(token) }?;
        }
    }
    // The engine would go on with bloom and the like; here the host's processor maps tones and writes a file.
    let desc = resolved.described("engine's colour", vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL);
    // SAFETY: image and view are alive, as described, in that layout, and may be copied from.
    let image = unsafe { Image::from_host(&gpu, &desc) };
    let radiance = gpu.read_image(&image)?;
    let picture = Picture::new(SIZE, radiance.chunks_exact(8).flat_map(tone_mapped).collect());
    picture.save(&out)?;
    check(&picture)?;
    println!("{out}: {FRAMES} frames on {} by the engine's command buffers", gpu.info().name);

    drop((image, scene, renderer, gpu));
    slots.iter().for_each(|slot| engine.destroy_commands(&slot.commands));
    [color, depth, resolved].iter().for_each(|target| engine.destroy_target(target));
    engine.destroy();
    Ok(())
}

/// Both depth tests went as they should: fur before the box, the box before fur, and fur above it.
fn check(picture: &Picture) -> Result<(), String> {
    let seen = |x: usize, y: usize| {
        let first = 4 * (y * SIZE[0] as usize + x);
        let [r, g, b] = [0, 1, 2].map(|channel| i32::from(picture.rgba[first + channel]));
        if r > b + 20 {
            "fur"
        } else if g > r + 40 {
            "box"
        } else {
            "background"
        }
    };
    for (x, y, expected) in [
        (50, 50, "background"),
        (230, 200, "fur"),
        (190, 110, "fur"),
        (405, 170, "box"),
        (410, 120, "fur"),
        (450, 250, "box"),
    ] {
        let found = seen(x, y);
        if found != expected {
            return Err(format!("at ({x}, {y}) stands {found} where {expected} should"));
        }
    }
    Ok(())
}

/// A capsule that bends at its middle: one mesh, one skin of two joints, one material.
fn character() -> Asset {
    let mut capsule = procedural::capsule(0.12, 0.16, 40, 40);
    let upper = |position: &Vec3| (position.y / 0.2 + 0.5).clamp(0.0, 1.0);
    let weights = capsule.vertices.positions.iter().map(upper);
    capsule.vertices.joints = weights.flat_map(|upper| [(0, 1.0 - upper), (1, upper), (0, 0.0), (0, 0.0)]).collect();
    capsule.vertices.influences_per_vertex = 4;
    let base_color = Vec4::new(0.62, 0.27, 0.075, 1.0);
    let fur = Material { name: Some("fur".to_owned()), base_color, metallic: 0.0, ..Material::default() };
    Asset {
        nodes: vec![Node::default(), Node::default()],
        meshes: vec![Mesh { primitives: vec![Primitive { material: 0, ..capsule }], ..Mesh::default() }],
        skins: vec![Skin { joints: vec![0, 1], inverse_bind: vec![Mat4::IDENTITY; 2] }],
        materials: vec![fur],
        scenes: vec![AssetScene::default()],
        ..Asset::default()
    }
}

/// Where the engine's box is on the screen. An engine has shaders for this; a cleared rectangle needs none.
fn box_on_screen() -> vk::Rect2D {
    let [width, height] = SIZE;
    vk::Rect2D {
        offset: vk::Offset2D { x: (width / 4) as i32, y: (height * 2 / 5) as i32 },
        extent: vk::Extent2D { width: width / 2, height: height * 2 / 5 },
    }
}

/// Half-float radiance as 8-bit display colour: Reinhard's curve, and a gamma of 2.2.
fn tone_mapped(texel: &[u8]) -> [u8; 4] {
    let radiance = |channel: usize| half::f16::from_le_bytes([texel[2 * channel], texel[2 * channel + 1]]).to_f32();
    let display = |radiance: f32| ((radiance / (1.0 + radiance)).powf(1.0 / 2.2) * 255.0 + 0.5) as u8;
    [display(radiance(0)), display(radiance(1)), display(radiance(2)), 255]
}
