//! What a scene keeps on the device: streams, indices, images, materials, pipelines. Each is made when a plan
//! first lists it and kept for the frames after.

use super::cloth::{cloth_shader, cloth_uniforms};
use super::geometry::{index_bytes, morph_delta_bytes, stream_bytes};
use super::map::{Map, StandIn, surface_maps};
use super::material::standard_uniforms;
use super::memory::{index_name, stream_name};
use super::pipeline::{ComputeSpec, PipelineSpec};
use super::plan::{DrawKind, Plan, SurfaceUse, TextureUse};
use super::stream::{ABSENT, Stream};
use super::table::Table;
use super::texture::mip_levels;
use crate::asset::{self, Wrap};
use crate::gpu::{
    BindGroup, Buffer, Gpu, GpuError, Image, ImageDesc, Memory, Pipeline, Resource, Sampler, SamplerDesc, Upload,
};
use crate::scene::Scene;
use ash::vk;
use std::collections::HashMap;

/// Vulkan has no empty buffers.
const LEAST_BYTES: u64 = 4;

/// One texel needs no filter, and floats of 32 bits may have none.
const STAND_IN_SAMPLER: asset::Sampler =
    asset::Sampler { wrap: [Wrap::Repeat; 2], mag_linear: false, min_linear: false, mip_linear: None };

/// Of every table.
const TABLE_SAMPLER: asset::Sampler =
    asset::Sampler { wrap: [Wrap::Clamp; 2], mag_linear: true, min_linear: true, mip_linear: None };

/// Index of a primitive: mesh, primitive of the mesh.
pub type PrimitiveIndex = (usize, usize);

/// What a scene keeps on the device.
pub struct Resources {
    gpu: Gpu,
    /// Rest-pose vertex streams.
    pub streams: HashMap<(PrimitiveIndex, Stream), Buffer>,
    /// 32-bit indices.
    pub indices: HashMap<PrimitiveIndex, Buffer>,
    /// Joint indices and weights.
    pub influences: HashMap<PrimitiveIndex, (Buffer, Buffer)>,
    /// Morph offsets by stream.
    pub morph_deltas: HashMap<(PrimitiveIndex, Stream), Buffer>,
    /// Bound with stride 0 where a primitive lacks a stream.
    absent: Option<Buffer>,
    images: HashMap<TextureUse, Image>,
    /// One texel each.
    stand_ins: HashMap<StandIn, Image>,
    tables: HashMap<&'static str, Image>,
    samplers: HashMap<asset::Sampler, Sampler>,
    surfaces: HashMap<(SurfaceUse, PipelineSpec), BindGroup>,
    pipelines: HashMap<PipelineSpec, Pipeline>,
    compute_pipelines: HashMap<ComputeSpec, Pipeline>,
}

impl Resources {
    /// Nothing yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            gpu: gpu.clone(),
            streams: HashMap::new(),
            indices: HashMap::new(),
            influences: HashMap::new(),
            morph_deltas: HashMap::new(),
            absent: None,
            images: HashMap::new(),
            stand_ins: HashMap::new(),
            tables: HashMap::new(),
            samplers: HashMap::new(),
            surfaces: HashMap::new(),
            pipelines: HashMap::new(),
            compute_pipelines: HashMap::new(),
        }
    }

    /// Makes what the plan lists and is not there yet.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub fn prepare(&mut self, scene: &Scene, plan: &Plan) -> Result<(), GpuError> {
        let mut upload = self.gpu.upload();
        self.prepare_geometry(&mut upload, scene, plan)?;
        self.prepare_deform_sources(&mut upload, scene, plan)?;
        self.prepare_images(&mut upload, scene, plan)?;
        self.prepare_stand_ins(&mut upload, plan)?;
        self.prepare_tables(&mut upload, plan)?;
        for spec in &plan.pipelines {
            self.make_pipeline(spec)?;
        }
        for spec in &plan.compute_pipelines {
            if !self.compute_pipelines.contains_key(spec) {
                self.compute_pipelines.insert(spec.clone(), spec.create(&self.gpu)?);
            }
        }
        self.prepare_surfaces(&mut upload, scene, plan)?;
        upload.finish()
    }

    /// Drops what belongs to one scene; pipelines, samplers, stand-ins and tables serve the next one, too.
    pub fn forget_scene(&mut self) {
        self.streams.clear();
        self.indices.clear();
        self.influences.clear();
        self.morph_deltas.clear();
        self.images.clear();
        self.surfaces.clear();
    }

    /// A pipeline that [`Self::prepare`] made.
    pub fn pipeline(&self, spec: &PipelineSpec) -> &Pipeline {
        &self.pipelines[spec]
    }

    /// A compute pipeline that [`Self::prepare`] made.
    pub fn compute_pipeline(&self, spec: &ComputeSpec) -> &Pipeline {
        &self.compute_pipelines[spec]
    }

    /// All pipelines so far.
    pub fn pipelines(&self) -> impl Iterator<Item = &Pipeline> {
        self.pipelines.values().chain(self.compute_pipelines.values())
    }

    /// Makes a pipeline outside a plan: the tone mapping depends on the target.
    ///
    /// # Errors
    /// Those of the device.
    pub fn make_pipeline(&mut self, spec: &PipelineSpec) -> Result<(), GpuError> {
        if !self.pipelines.contains_key(spec) {
            self.pipelines.insert(spec.clone(), spec.create(&self.gpu)?);
        }
        Ok(())
    }

    /// The bind group of a surface with a pipeline.
    pub fn surface(&self, surface: SurfaceUse, spec: &PipelineSpec) -> &BindGroup {
        &self.surfaces[&(surface, spec.clone())]
    }

    /// What a primitive's missing streams are read from, where a plan says that one is.
    pub fn absent(&self) -> Option<&Buffer> {
        self.absent.as_ref()
    }

    /// The texel of that kind, where the plan lists it.
    pub fn stand_in(&self, stand_in: StandIn) -> Option<&Image> {
        self.stand_ins.get(&stand_in)
    }

    /// The texture and sampler of a map that a pipeline of the plan binds, or what stands in for it.
    fn map(&self, scene: &Scene, spec: &PipelineSpec, map: &Map) -> (&Image, &Sampler) {
        let Some(used) = map.texture.filter(|_| spec.samples_map(map)) else {
            return (&self.stand_ins[&map.stand_in], &self.samplers[&STAND_IN_SAMPLER]);
        };
        let texture = &scene.asset().textures[used.texture];
        (&self.images[&TextureUse { image: texture.image, srgb: map.srgb }], &self.samplers[&texture.sampler])
    }

    /// The material bind group (set 1) of a pipeline: its uniform blocks and what it declares of maps and tables.
    ///
    /// # Errors
    /// When the device is out of memory.
    pub fn bind_material(
        &self,
        scene: &Scene,
        spec: &PipelineSpec,
        name: &str,
        blocks: &[(&str, &Buffer)],
        maps: &[Map],
        tables: &[&Table],
    ) -> Result<BindGroup, GpuError> {
        let names: Vec<_> =
            maps.iter().map(|map| (format!("{}_map", map.name), format!("{}_sampler", map.name))).collect();
        let mut offered: Vec<_> = blocks.iter().map(|(name, buffer)| (*name, Resource::Buffer(buffer))).collect();
        for (map, (texture_name, sampler_name)) in maps.iter().zip(&names).filter(|(map, _)| spec.binds_map(map)) {
            let (image, sampler) = self.map(scene, spec, map);
            offered.push((texture_name, Resource::Texture(image)));
            offered.push((sampler_name, Resource::Sampler(sampler)));
        }
        let names: Vec<_> = tables
            .iter()
            .map(|table| (format!("{}_table", table.name), format!("{}_table_sampler", table.name)))
            .collect();
        for (table, (texture_name, sampler_name)) in
            tables.iter().zip(&names).filter(|(table, _)| spec.binds_table(table))
        {
            offered.push((texture_name, Resource::Texture(&self.tables[table.name])));
            offered.push((sampler_name, Resource::Sampler(&self.samplers[&TABLE_SAMPLER])));
        }
        self.gpu.bind_group(self.pipeline(spec), 1, name, &offered)
    }

    fn prepare_geometry(&mut self, upload: &mut Upload, scene: &Scene, plan: &Plan) -> Result<(), GpuError> {
        for (&index, streams) in &plan.streams {
            let mesh = &scene.asset().meshes[index.0];
            for &stream in streams {
                let bytes = plan.bytes_of_stream(scene.asset(), index, stream);
                if !self.streams.get(&(index, stream)).is_some_and(|buffer| holds(buffer, bytes)) {
                    // The deform pass reads what it moves.
                    let usage = vk::BufferUsageFlags::VERTEX_BUFFER | vk::BufferUsageFlags::STORAGE_BUFFER;
                    let buffer = device_buffer(&self.gpu, &stream_name(scene.asset(), index, stream), usage, bytes)?;
                    let one = stream_bytes(mesh, index.1, stream);
                    for copy in 0..u64::from(plan.copies_of(index)) {
                        upload.buffer(&buffer, copy * one.len() as u64, &one);
                    }
                    self.streams.insert((index, stream), buffer);
                }
            }
            let bytes = plan.bytes_of_indices(scene.asset(), index);
            if !self.indices.get(&index).is_some_and(|buffer| holds(buffer, bytes)) {
                let buffer = device_buffer(
                    &self.gpu,
                    &index_name(scene.asset(), index),
                    vk::BufferUsageFlags::INDEX_BUFFER,
                    bytes,
                )?;
                for copy in 0..plan.copies_of(index) {
                    let one = index_bytes(&mesh.primitives[index.1], copy);
                    upload.buffer(&buffer, u64::from(copy) * one.len() as u64, &one);
                }
                self.indices.insert(index, buffer);
            }
        }
        Ok(())
    }

    fn prepare_deform_sources(&mut self, upload: &mut Upload, scene: &Scene, plan: &Plan) -> Result<(), GpuError> {
        for deform in &plan.deforms {
            let instance = &plan.instances[deform.instance];
            let index = (instance.mesh, instance.primitive);
            let mesh = &scene.asset().meshes[index.0];
            let primitive = &mesh.primitives[index.1];
            let usage = vk::BufferUsageFlags::STORAGE_BUFFER;
            if instance.skin.is_some()
                && primitive.vertices.influences_per_vertex > 0
                && !self.influences.contains_key(&index)
            {
                let joints: Vec<u32> = primitive.vertices.joints.iter().map(|(joint, _)| u32::from(*joint)).collect();
                let weights: Vec<f32> = primitive.vertices.joints.iter().map(|(_, weight)| *weight).collect();
                let joints = filled_buffer(&self.gpu, upload, "joint indices", usage, bytemuck::cast_slice(&joints))?;
                let weights = filled_buffer(&self.gpu, upload, "joint weights", usage, bytemuck::cast_slice(&weights))?;
                self.influences.insert(index, (joints, weights));
            }
            let key = (index, deform.stream);
            if !primitive.morph_targets.is_empty() && !self.morph_deltas.contains_key(&key) {
                let bytes = morph_delta_bytes(mesh, index.1, deform.stream);
                self.morph_deltas.insert(key, filled_buffer(&self.gpu, upload, "morph deltas", usage, &bytes)?);
            }
        }
        Ok(())
    }

    fn prepare_images(&mut self, upload: &mut Upload, scene: &Scene, plan: &Plan) -> Result<(), GpuError> {
        for &texture in &plan.textures {
            if self.images.contains_key(&texture) {
                continue;
            }
            let source = &scene.asset().images[texture.image];
            let limit = self.gpu.info().max_image_size;
            let mut levels = mip_levels(source, texture.srgb);
            let (mut width, mut height) = (source.width.max(1), source.height.max(1));
            // A picture larger than the device can hold is shown from its first level that fits.
            while width.max(height) > limit {
                levels.remove(0);
                (width, height) = ((width / 2).max(1), (height / 2).max(1));
            }
            let format = if texture.srgb { vk::Format::R8G8B8A8_SRGB } else { vk::Format::R8G8B8A8_UNORM };
            let image = filled_image(&self.gpu, upload, &source.name, [width, height], format, false, &levels)?;
            self.images.insert(texture, image);
        }
        for sampler in &plan.samplers {
            self.make_sampler(sampler)?;
        }
        Ok(())
    }

    fn prepare_stand_ins(&mut self, upload: &mut Upload, plan: &Plan) -> Result<(), GpuError> {
        if plan.has_absent_streams && self.absent.is_none() {
            let usage = vk::BufferUsageFlags::VERTEX_BUFFER;
            let buffer = filled_buffer(&self.gpu, upload, "absent stream", usage, bytemuck::cast_slice(&ABSENT))?;
            self.absent = Some(buffer);
        }
        for &stand_in in &plan.stand_ins {
            if !self.stand_ins.contains_key(&stand_in) {
                let texel = stand_in.texel();
                let (name, levels) = (format!("{stand_in:?}"), [bytemuck::bytes_of(&texel)]);
                let format = vk::Format::R32G32B32A32_SFLOAT;
                let image = filled_image(&self.gpu, upload, &name, [1, 1], format, false, &levels)?;
                self.stand_ins.insert(stand_in, image);
            }
            self.make_sampler(&STAND_IN_SAMPLER)?;
        }
        Ok(())
    }

    fn prepare_tables(&mut self, upload: &mut Upload, plan: &Plan) -> Result<(), GpuError> {
        for (name, table) in &plan.tables {
            if !self.tables.contains_key(name) {
                let image = filled_image(&self.gpu, upload, name, table.size, Table::FORMAT, false, &[table.texels])?;
                self.tables.insert(name, image);
            }
            self.make_sampler(&TABLE_SAMPLER)?;
        }
        Ok(())
    }

    fn make_sampler(&mut self, sampler: &asset::Sampler) -> Result<(), GpuError> {
        if !self.samplers.contains_key(sampler) {
            self.samplers.insert(*sampler, self.gpu.sampler(&sampler_desc(sampler))?);
        }
        Ok(())
    }

    fn prepare_surfaces(&mut self, upload: &mut Upload, scene: &Scene, plan: &Plan) -> Result<(), GpuError> {
        let drawn = plan.opaque.iter().chain(&plan.transparent).chain(&plan.guide).chain(plan.shadows.draws());
        for draw in drawn {
            let DrawKind::Surface(surface) = draw.kind else { continue };
            let spec = &plan.pipelines[draw.pipeline];
            let key = (surface, spec.clone());
            if self.surfaces.contains_key(&key) {
                continue;
            }
            let standard = scene.standard(surface.material, surface.under_fur);
            let name = &scene.materials()[surface.material].name;
            let usage = vk::BufferUsageFlags::UNIFORM_BUFFER;
            let bytes = standard_uniforms(&standard);
            let uniforms = filled_buffer(&self.gpu, upload, name, usage, bytemuck::bytes_of(&bytes))?;
            let mut blocks = vec![("StandardBlock", &uniforms)];
            let cloth = scene.cloth(surface.material, surface.under_fur).map(|cloth| (cloth_shader(cloth), cloth));
            let cloth = cloth.filter(|(shader, _)| spec.bindings().contains(shader.block));
            let own = match &cloth {
                Some((_, cloth)) => Some(filled_buffer(&self.gpu, upload, name, usage, &cloth_uniforms(cloth))?),
                None => None,
            };
            let cloth = cloth.map(|(shader, _)| shader);
            blocks.extend(cloth.as_ref().zip(own.as_ref()).map(|(shader, own)| (shader.block, own)));
            let tables = cloth.as_ref().map_or(&[][..], |cloth| &cloth.tables);
            let group =
                self.bind_material(scene, spec, name, &blocks, &surface_maps(&standard, cloth.as_ref()), tables)?;
            self.surfaces.insert(key, group);
        }
        Ok(())
    }
}

/// A device buffer that holds `bytes`.
fn filled_buffer(
    gpu: &Gpu,
    upload: &mut Upload,
    name: &str,
    usage: vk::BufferUsageFlags,
    bytes: &[u8],
) -> Result<Buffer, GpuError> {
    let buffer = device_buffer(gpu, name, usage, bytes.len() as u64)?;
    upload.buffer(&buffer, 0, bytes);
    Ok(buffer)
}

fn device_buffer(gpu: &Gpu, name: &str, usage: vk::BufferUsageFlags, bytes: u64) -> Result<Buffer, GpuError> {
    gpu.buffer(name, bytes.max(LEAST_BYTES), usage | vk::BufferUsageFlags::TRANSFER_DST, Memory::Device)
}

/// Whether the buffer was made for so many bytes: another number of copies needs another one.
fn holds(buffer: &Buffer, bytes: u64) -> bool {
    buffer.bytes() == bytes.max(LEAST_BYTES)
}

/// An image for sampling, of as many levels as are given; of a cube each has its six faces.
pub(super) fn filled_image(
    gpu: &Gpu,
    upload: &mut Upload,
    name: &str,
    size: [u32; 2],
    format: vk::Format,
    is_cube: bool,
    levels: &[impl AsRef<[u8]>],
) -> Result<Image, GpuError> {
    let image = gpu.image(&ImageDesc {
        name,
        size,
        format,
        mip_levels: levels.len() as u32,
        samples: 1,
        usage: vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST,
        is_cube,
    })?;
    let levels: Vec<&[u8]> = levels.iter().map(AsRef::as_ref).collect();
    upload.image(&image, &levels);
    Ok(image)
}

fn sampler_desc(sampler: &asset::Sampler) -> SamplerDesc {
    let filter = |linear: bool| if linear { vk::Filter::LINEAR } else { vk::Filter::NEAREST };
    let mode = |wrap: Wrap| match wrap {
        Wrap::Repeat => vk::SamplerAddressMode::REPEAT,
        Wrap::Mirror => vk::SamplerAddressMode::MIRRORED_REPEAT,
        Wrap::Clamp => vk::SamplerAddressMode::CLAMP_TO_EDGE,
    };
    SamplerDesc {
        wrap: sampler.wrap.map(mode),
        mag: filter(sampler.mag_linear),
        min: filter(sampler.min_linear),
        mip_mode: match sampler.mip_linear {
            Some(true) => vk::SamplerMipmapMode::LINEAR,
            _ => vk::SamplerMipmapMode::NEAREST,
        },
        // A quarter, not 0: with 0 every texel counts as magnified and the minification filter is never used (Vulkan 1.3,
        // VkSamplerCreateInfo).
        max_lod: if sampler.mip_linear.is_some() { vk::LOD_CLAMP_NONE } else { 0.25 },
        ..SamplerDesc::default()
    }
}
