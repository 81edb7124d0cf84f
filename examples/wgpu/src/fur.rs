//! What vair adds to the engine's frame: balls of a fox's fur.

use crate::Problem;
use crate::between;
use crate::device::Device;
use crate::engine::Engine;
use glam::{Mat4, Vec3, Vec4};
use std::path::Path;
use vair::asset::{Asset, AssetScene, Material, Mesh, procedural};
use vair::gpu::{FrameToken, HostCommands, HostRendering, ash, vk};
use vair::material::Value;
use vair::render::{DepthOrder, DeviceScene, EnvironmentQuality, FrameDesc, InstanceDesc, Target, View};
use vair::scene::{EnvironmentLight, Light};
use vair::{Gpu, LoadOptions, Look, Renderer, Scene};

/// The engine's targets, as vair's pipelines are made for them.
const TARGET: Target = Target {
    color: vk::Format::R16G16B16A16_SFLOAT,
    depth: vk::Format::D32_SFLOAT,
    samples: 1,
    depth_order: DepthOrder::Standard,
    motion: None,
};

pub const FUR_LENGTH_M: f32 = 0.022;

pub struct Fur {
    renderer: Renderer,
    scene: DeviceScene,
    light: Light,
    device: ash::Device,
}

impl Fur {
    /// A ball of `radius_m` at each of `places`, in `light`.
    ///
    /// # Safety
    /// The device outlives this, and has finished all that this recorded when it goes.
    pub unsafe fn new(device: &Device, radius_m: f32, places: &[Vec3], light: Light) -> Result<Self, Problem> {
        let lent = device.lend()?;
        let raw = lent.device.clone();
        // SAFETY: the handles are those of one wgpu device, which the caller keeps; one thread uses its queue.
        let gpu = unsafe { Gpu::from_host(lent) }?;

        let base_color = Vec4::new(0.62, 0.27, 0.075, 1.0);
        let material = Material { name: Some("fur".to_owned()), base_color, ..Material::default() };
        let mesh = Mesh { primitives: vec![procedural::sphere(radius_m, 16)], ..Mesh::default() };
        let mut coat = Scene::from_asset(Asset {
            scenes: vec![AssetScene::default()],
            meshes: vec![mesh],
            materials: vec![material],
            ..Asset::default()
        })?;
        // Its images are formulas: there is no folder to read.
        coat.apply(&Look::preset("fox", Some("fur"))?, Path::new(""), &LoadOptions::default())?;
        coat.set_parameter(0, "length", &Value::Number(FUR_LENGTH_M.into()))?;

        let mut scene = DeviceScene::new(coat);
        scene.set_environment(EnvironmentLight::constant(Vec3::splat(0.2)), EnvironmentQuality::default())?;
        for place in places {
            let world_from_object = Mat4::from_translation(*place);
            scene.add(&InstanceDesc { world_from_object, ..InstanceDesc::default() })?;
        }
        Ok(Self { renderer: Renderer::with_gpu(gpu), scene, light, device: raw })
    }

    /// Commands that draw into the engine's targets, for the place between its own passes, and what to give to
    /// [`Self::passed`] when the device is done with them.
    pub fn draw(
        &mut self,
        device: &wgpu::Device,
        engine: &Engine,
        view: View,
    ) -> Result<(wgpu::CommandBuffer, FrameToken), Problem> {
        between::encode(device, |command_buffer| {
            // SAFETY: recording, outside a pass, and submitted by the engine before it records anything else.
            let commands = unsafe { HostCommands::recording(command_buffer) };
            let mut frame = self.renderer.frame(commands)?;
            let desc = FrameDesc {
                views: &[view],
                target: TARGET,
                lights: std::slice::from_ref(&self.light),
                ..FrameDesc::default()
            };
            frame.prepare(&mut self.scene, &desc)?;
            let draw = || {
                // SAFETY: inside the pass that `draw_into` has begun, whose targets are of these formats.
                let pass = unsafe { HostRendering::begun(command_buffer, TARGET.formats()) };
                frame.draw_opaque(pass, &self.scene, 0)?;
                frame.draw_fur(pass, &self.scene, 0)?;
                Ok(frame.draw_transparent(pass, &self.scene, 0)?)
            };
            // SAFETY: `prepare` leaves the command buffer recording, outside a pass; the engine has handed its targets over.
            unsafe { between::draw_into(&self.device, engine, command_buffer, draw) }?;
            Ok(frame.finish()?)
        })
    }

    /// Memory of a frame returns.
    ///
    /// # Safety
    /// The device is done with the frame's commands.
    pub unsafe fn passed(&self, token: FrameToken) -> Result<(), Problem> {
        // SAFETY: the caller says so.
        Ok(unsafe { self.renderer.gpu().frame_passed(token) }?)
    }

    /// The device's name.
    pub fn device_name(&self) -> &str {
        &self.renderer.gpu().info().name
    }
}
