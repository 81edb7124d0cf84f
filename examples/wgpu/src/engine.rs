//! What a wgpu engine has already: targets, a pass that draws its own box, and a pass that tone-maps.

use crate::Problem;
use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3};

pub const COLOR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
pub const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
const DISPLAY: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
/// Radiance where nothing is.
pub const BACKGROUND: [f64; 3] = [0.18, 0.19, 0.2];

/// What the box's shader reads, `Frame` of box.wgsl.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Frame {
    clip_from_world: Mat4,
    direction_to_light_in_world: Vec3,
    padding: u32,
}

pub struct Engine {
    pub size: [u32; 2],
    /// Linear, scene-referred radiance.
    pub color: Target,
    /// 0 is near, 1 is far.
    pub depth: Target,
    display: Target,
    box_pipeline: wgpu::RenderPipeline,
    box_bindings: wgpu::BindGroup,
    tone_mapping_pipeline: wgpu::RenderPipeline,
    tone_mapping_bindings: wgpu::BindGroup,
}

pub struct Target {
    pub texture: wgpu::Texture,
    pub view: wgpu::TextureView,
}

impl Engine {
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        size: [u32; 2],
        clip_from_world: Mat4,
        direction_to_light_in_world: Vec3,
    ) -> Self {
        use wgpu::TextureUsages as Usage;
        let color = Target::new(device, "radiance", size, COLOR, Usage::TEXTURE_BINDING);
        let depth = Target::new(device, "depth", size, DEPTH, Usage::COPY_SRC);
        let display = Target::new(device, "display", size, DISPLAY, Usage::COPY_SRC);

        let frame = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frame"),
            size: size_of::<Frame>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let values = Frame { clip_from_world, direction_to_light_in_world, padding: 0 };
        queue.write_buffer(&frame, 0, bytemuck::bytes_of(&values));

        let depth_state = wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        };
        let box_shader = device.create_shader_module(wgpu::include_wgsl!("box.wgsl"));
        let box_pipeline = pipeline(device, &box_shader, COLOR, Some(depth_state));
        let box_bindings = bind(device, &box_pipeline, frame.as_entire_binding());
        let tone_mapping_shader = device.create_shader_module(wgpu::include_wgsl!("tone_mapping.wgsl"));
        let tone_mapping_pipeline = pipeline(device, &tone_mapping_shader, DISPLAY, None);
        let radiance = wgpu::BindingResource::TextureView(&color.view);
        let tone_mapping_bindings = bind(device, &tone_mapping_pipeline, radiance);
        Self { size, color, depth, display, box_pipeline, box_bindings, tone_mapping_pipeline, tone_mapping_bindings }
    }

    /// Clears colour and depth, and draws the box.
    pub fn draw_box(&self, encoder: &mut wgpu::CommandEncoder) {
        let [r, g, b] = BACKGROUND;
        let store = wgpu::StoreOp::Store;
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("box"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.color.view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a: 1.0 }), store },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth.view,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&self.box_pipeline);
        pass.set_bind_group(0, &self.box_bindings, &[]);
        pass.draw(0..36, 0..1);
    }

    /// Maps the radiance to what is shown.
    pub fn tone_map(&self, encoder: &mut wgpu::CommandEncoder) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("tone mapping"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.display.view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        pass.set_pipeline(&self.tone_mapping_pipeline);
        pass.set_bind_group(0, &self.tone_mapping_bindings, &[]);
        pass.draw(0..3, 0..1);
    }

    /// What is shown, RGBA of 8 bits and sRGB, and the depth of each pixel, rows from the top. Waits.
    pub fn read(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> Result<(Vec<u8>, Vec<f32>), Problem> {
        let rgba = self.display.read(device, queue)?;
        let depth = self.depth.read(device, queue)?;
        Ok((rgba, bytemuck::pod_collect_to_vec(&depth)))
    }
}

impl Target {
    fn new(
        device: &wgpu::Device,
        name: &str,
        [width, height]: [u32; 2],
        format: wgpu::TextureFormat,
        usage: wgpu::TextureUsages,
    ) -> Self {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some(name),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: usage | wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Self { texture, view }
    }

    /// The bytes of a texture of 4 bytes a texel whose rows are whole multiples of wgpu's 256 bytes.
    fn read(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Vec<u8>, Problem> {
        let size = self.texture.size();
        let bytes_per_row = size.width * 4;
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read-back"),
            size: u64::from(bytes_per_row * size.height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(bytes_per_row), rows_per_image: None };
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("read-back") });
        let to = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout };
        encoder.copy_texture_to_buffer(self.texture.as_image_copy(), to, size);
        queue.submit([encoder.finish()]);
        let (sender, receiver) = std::sync::mpsc::channel();
        buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            // Nobody listens any more only when waiting has failed already.
            let _ = sender.send(result);
        });
        device.poll(wgpu::PollType::wait_indefinitely())?;
        receiver.recv()??;
        Ok(buffer.get_mapped_range(..)?.to_vec())
    }
}

/// A pipeline of the entry points `vertex` and `fragment`, which writes one target.
fn pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    format: wgpu::TextureFormat,
    depth_stencil: Option<wgpu::DepthStencilState>,
) -> wgpu::RenderPipeline {
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState { cull_mode: Some(wgpu::Face::Back), ..Default::default() },
        depth_stencil,
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some("fragment"),
            compilation_options: Default::default(),
            targets: &[Some(format.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// The pipeline's one binding.
fn bind(
    device: &wgpu::Device,
    pipeline: &wgpu::RenderPipeline,
    resource: wgpu::BindingResource<'_>,
) -> wgpu::BindGroup {
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[wgpu::BindGroupEntry { binding: 0, resource }],
    })
}
