//! A wgpu engine draws its box; vair draws balls of fur before and behind it, into the same texture and depth; the engine
//! tone-maps: `cargo run [PICTURE.png] [--validate]`.
//!
//! | file | is |
//! |---|---|
//! | `device` | how wgpu's device is opened with what vair requires, and lent |
//! | `engine` | what a wgpu engine has already |
//! | `between` | how foreign commands stand between two wgpu passes |
//! | `fur` | what vair adds |
//! | `picture` | what was drawn, and whether it is right |
//! | `validation` | what Vulkan's validation layer says |
//!
//! `--validate` fails where that layer is not installed; where it is, its messages always fail the program.

mod between;
mod device;
mod engine;
mod fur;
mod picture;
mod validation;

use device::Device;
use engine::Engine;
use fur::Fur;
use glam::Vec3;
use glam::camera::rh::{proj::directx::perspective, view::look_at_mat4};
use picture::Picture;
use std::process::ExitCode;
use std::sync::mpsc;
use vair::render::View;
use vair::scene::Light;

type Problem = Box<dyn std::error::Error>;

const SIZE: [u32; 2] = [640, 360];
/// More than are in flight, so that memory of the first ones is used again.
const FRAMES: usize = 4;
const BALL_RADIUS_M: f32 = 0.09;
const BALL_BEFORE: Vec3 = Vec3::new(-0.10, -0.04, 0.22);
const BALL_BEHIND: Vec3 = Vec3::new(0.17, 0.05, -0.25);

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("error: {problem}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Problem> {
    let mut out = "vair.png".to_owned();
    let mut must_validate = false;
    for argument in std::env::args().skip(1) {
        match argument.as_str() {
            "--validate" => must_validate = true,
            _ => out = argument,
        }
    }
    let is_validated = validation::is_present()?;
    if must_validate && !is_validated {
        return Err("VK_LAYER_KHRONOS_validation is not installed; tools/test_wgpu brings it".into());
    }
    validation::listen()?;

    let (picture, device_name) = draw()?;
    image::save_buffer(&out, &picture.rgba, SIZE[0], SIZE[1], image::ColorType::Rgba8)?;
    // All that was made is gone by now, and the layer has seen that, too.
    validation::check()?;
    picture.check()?;
    let validated = if is_validated { "under" } else { "without" };
    println!("{out}, drawn on {device_name} by wgpu and vair {validated} the validation layer");
    Ok(())
}

fn draw() -> Result<(Picture, String), Problem> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::VULKAN,
        flags: wgpu::InstanceFlags::debugging(),
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let opened = Device::open(&instance)?;
    let Device { device, queue, .. } = &opened;
    let view_from_world = look_at_mat4(Vec3::new(0.0, 0.25, 1.2), Vec3::ZERO, Vec3::Y);
    // wgpu's clip space is vair's: y up, depth 0 at the near plane and 1 at the far one, as `fur` declares it.
    let clip_from_view = perspective(0.5, SIZE[0] as f32 / SIZE[1] as f32, 0.1, 10.0);
    let view = View::new(view_from_world, clip_from_view, SIZE);
    let sun = Light {
        direction_to_light_in_world: Vec3::new(-0.5, 0.7, 0.5).normalize(),
        intensity: Vec3::splat(8.0),
        ..Light::key()
    };
    let clip_from_world = clip_from_view * view_from_world;
    let engine = Engine::new(device, queue, SIZE, clip_from_world, sun.direction_to_light_in_world);
    // SAFETY: it is dropped before the device, and after the last frame was waited for.
    let mut fur = unsafe { Fur::new(&opened, BALL_RADIUS_M, &[BALL_BEFORE, BALL_BEHIND], sun) }?;

    let (sender, passed) = mpsc::channel();
    for _ in 0..FRAMES {
        device.poll(wgpu::PollType::Poll)?;
        for token in passed.try_iter() {
            // SAFETY: wgpu has said so, below.
            unsafe { fur.passed(token) }?;
        }
        let mut first = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("first") });
        engine.draw_box(&mut first);
        between::hand_over(&mut first, &engine);
        let (coats, token) = fur.draw(device, &engine, view)?;
        let mut last = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("last") });
        engine.tone_map(&mut last);
        queue.submit([first.finish(), coats, last.finish()]);
        let sender = sender.clone();
        // wgpu calls when the device is done with what was submitted until now.
        queue.on_submitted_work_done(move || {
            // Nobody listens any more only when a later frame has failed.
            let _ = sender.send(token);
        });
    }
    let (rgba, depth) = engine.read(device, queue)?;
    let device_name = fur.device_name().to_owned();
    Ok((Picture { rgba, depth, size: SIZE, view }, device_name))
}
