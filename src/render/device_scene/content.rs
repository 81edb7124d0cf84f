//! What a scene keeps on the device whatever its pose: vertex streams, indices, what skinning reads, images. Each is made
//! when a plan first lists it and kept for the frames after.

use super::geometry::{index_bytes, morph_delta_bytes, stream_bytes};
use super::stream::Stream;
use super::texture::mip_levels;
use crate::gpu::{Buffer, Gpu, GpuError, Image, Upload};
use crate::render::plan::{Plan, TextureUse, index_name, stream_name};
use crate::render::renderer::{device_buffer, filled_buffer, filled_image, holds};
use crate::scene::{Instance, Scene};
use ash::vk;
use std::collections::HashMap;

/// Index of a primitive: mesh, primitive of the mesh.
pub type PrimitiveIndex = (usize, usize);

/// What a scene keeps on the device whatever its pose.
#[derive(Default)]
pub struct Content {
    /// Rest-pose vertex streams.
    pub streams: HashMap<(PrimitiveIndex, Stream), Buffer>,
    /// 32-bit indices.
    pub indices: HashMap<PrimitiveIndex, Buffer>,
    /// Joint indices and weights.
    pub influences: HashMap<PrimitiveIndex, (Buffer, Buffer)>,
    /// Morph offsets by stream.
    pub morph_deltas: HashMap<(PrimitiveIndex, Stream), Buffer>,
    images: HashMap<TextureUse, Image>,
    /// Images of the host's that stand for images of the scene.
    replaced: HashMap<usize, Image>,
}

impl Content {
    /// Makes what the plan lists and is not there yet.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub fn prepare(
        &mut self,
        gpu: &Gpu,
        upload: &mut Upload,
        scene: &Scene,
        instances: &[Instance],
        plan: &Plan,
    ) -> Result<(), GpuError> {
        self.prepare_geometry(gpu, upload, scene, plan)?;
        self.prepare_skinning_sources(gpu, upload, scene, instances, plan)?;
        self.prepare_images(gpu, upload, scene, plan)
    }

    /// The image of a texture that the plan lists.
    pub fn image(&self, texture: TextureUse) -> &Image {
        self.replaced.get(&texture.image).unwrap_or_else(|| &self.images[&texture])
    }

    /// The image is to be made again from what the scene now says; a host's image in its place is let go of.
    pub fn forget_image(&mut self, image: usize) {
        self.images.retain(|texture, _| texture.image != image);
        self.replaced.remove(&image);
    }

    /// An image of the host's stands for one of the scene's.
    pub fn replace_image(&mut self, image: usize, host: Image) {
        self.forget_image(image);
        self.replaced.insert(image, host);
    }

    fn prepare_geometry(&mut self, gpu: &Gpu, upload: &mut Upload, scene: &Scene, plan: &Plan) -> Result<(), GpuError> {
        for (&index, streams) in &plan.streams {
            let mesh = &scene.asset().meshes[index.0];
            for &stream in streams {
                let bytes = plan.bytes_of_stream(scene.asset(), index, stream);
                if !self.streams.get(&(index, stream)).is_some_and(|buffer| holds(buffer, bytes)) {
                    // Skinning reads what it moves.
                    let usage = vk::BufferUsageFlags::VERTEX_BUFFER | vk::BufferUsageFlags::STORAGE_BUFFER;
                    let buffer = device_buffer(gpu, &stream_name(scene.asset(), index, stream), usage, bytes)?;
                    let one = stream_bytes(mesh, index.1, stream);
                    for copy in 0..u64::from(plan.copies_of(index)) {
                        upload.buffer(&buffer, copy * one.len() as u64, &one);
                    }
                    self.streams.insert((index, stream), buffer);
                }
            }
            let bytes = plan.bytes_of_indices(scene.asset(), index);
            if !self.indices.get(&index).is_some_and(|buffer| holds(buffer, bytes)) {
                let usage = vk::BufferUsageFlags::INDEX_BUFFER;
                let buffer = device_buffer(gpu, &index_name(scene.asset(), index), usage, bytes)?;
                for copy in 0..plan.copies_of(index) {
                    let one = index_bytes(&mesh.primitives[index.1], copy);
                    upload.buffer(&buffer, u64::from(copy) * one.len() as u64, &one);
                }
                self.indices.insert(index, buffer);
            }
        }
        Ok(())
    }

    fn prepare_skinning_sources(
        &mut self,
        gpu: &Gpu,
        upload: &mut Upload,
        scene: &Scene,
        instances: &[Instance],
        plan: &Plan,
    ) -> Result<(), GpuError> {
        for deform in &plan.deforms {
            let part = plan.parts[deform.part];
            let index = (part.mesh, part.primitive);
            let mesh = &scene.asset().meshes[index.0];
            let primitive = &mesh.primitives[index.1];
            let usage = vk::BufferUsageFlags::STORAGE_BUFFER;
            let is_skinned = instances[part.instance].skin.is_some() && primitive.vertices.influences_per_vertex > 0;
            if is_skinned && !self.influences.contains_key(&index) {
                let joints: Vec<u32> = primitive.vertices.joints.iter().map(|(joint, _)| u32::from(*joint)).collect();
                let weights: Vec<f32> = primitive.vertices.joints.iter().map(|(_, weight)| *weight).collect();
                let joints = filled_buffer(gpu, upload, "joint indices", usage, bytemuck::cast_slice(&joints))?;
                let weights = filled_buffer(gpu, upload, "joint weights", usage, bytemuck::cast_slice(&weights))?;
                self.influences.insert(index, (joints, weights));
            }
            let key = (index, deform.stream);
            if !primitive.morph_targets.is_empty() && !self.morph_deltas.contains_key(&key) {
                let bytes = morph_delta_bytes(mesh, index.1, deform.stream);
                self.morph_deltas.insert(key, filled_buffer(gpu, upload, "morph deltas", usage, &bytes)?);
            }
        }
        Ok(())
    }

    fn prepare_images(&mut self, gpu: &Gpu, upload: &mut Upload, scene: &Scene, plan: &Plan) -> Result<(), GpuError> {
        for &texture in &plan.textures {
            if self.images.contains_key(&texture) || self.replaced.contains_key(&texture.image) {
                continue;
            }
            let source = &scene.asset().images[texture.image];
            let limit = gpu.info().max_image_size;
            let mut levels = mip_levels(source, texture.srgb);
            let (mut width, mut height) = (source.width.max(1), source.height.max(1));
            // A picture larger than the device can hold is shown from its first level that fits.
            while width.max(height) > limit {
                levels.remove(0);
                (width, height) = ((width / 2).max(1), (height / 2).max(1));
            }
            let format = if texture.srgb { vk::Format::R8G8B8A8_SRGB } else { vk::Format::R8G8B8A8_UNORM };
            let image = filled_image(gpu, upload, &source.name, [width, height], format, false, &levels)?;
            self.images.insert(texture, image);
        }
        Ok(())
    }
}
