//! What a scene keeps on the device: streams, indices, images, materials, pipelines. Each is made when a plan
//! first lists it and kept for the frames after.

use super::geometry::{morph_delta_bytes, stream_bytes};
use super::material::standard_uniforms;
use super::pipeline::{ComputeSpec, PipelineSpec};
use super::plan::{DrawKind, Map, Plan, SurfaceUse, TextureUse, surface_maps};
use super::stream::Stream;
use super::texture::mip_levels;
use crate::asset::{self, TextureRef, Wrap};
use crate::gpu::{
    BindGroup, Buffer, Gpu, GpuError, Image, ImageDesc, Memory, Pipeline, Resource, Sampler, SamplerDesc, Upload,
};
use crate::scene::Scene;
use ash::vk;
use std::borrow::Cow;
use std::collections::HashMap;

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
    /// Zeros, bound with stride 0 where a primitive lacks a stream.
    pub absent: Buffer,
    images: HashMap<TextureUse, Image>,
    /// One white texel, bound where a permutation has a map that the material lacks.
    white: Image,
    samplers: HashMap<asset::Sampler, Sampler>,
    surfaces: HashMap<(SurfaceUse, PipelineSpec), BindGroup>,
    pipelines: HashMap<PipelineSpec, Pipeline>,
    compute_pipelines: HashMap<ComputeSpec, Pipeline>,
}

impl Resources {
    /// Nothing but the stand-in for absent streams.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let mut upload = gpu.upload();
        let absent = filled_buffer(gpu, &mut upload, "absent stream", vk::BufferUsageFlags::VERTEX_BUFFER, &[0; 16])?;
        let white =
            filled_image(gpu, &mut upload, "white", [1, 1], vk::Format::R8G8B8A8_UNORM, &[vec![255; 4].into()])?;
        upload.finish()?;
        let plain = asset::Sampler::default();
        let samplers = HashMap::from([(plain, gpu.sampler(&sampler_desc(&plain))?)]);
        Ok(Self {
            gpu: gpu.clone(),
            streams: HashMap::new(),
            indices: HashMap::new(),
            influences: HashMap::new(),
            morph_deltas: HashMap::new(),
            absent,
            images: HashMap::new(),
            white,
            samplers,
            surfaces: HashMap::new(),
            pipelines: HashMap::new(),
            compute_pipelines: HashMap::new(),
        })
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

    /// Drops what belongs to one scene; pipelines and samplers serve the next one, too.
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

    /// The texture and sampler of a map that the plan lists; for no map, the white texel.
    pub fn map(&self, scene: &Scene, map: Option<TextureRef>, srgb: bool) -> (&Image, &Sampler) {
        let Some(map) = map else { return (&self.white, &self.samplers[&asset::Sampler::default()]) };
        let texture = &scene.asset().textures[map.texture];
        (&self.images[&TextureUse { image: texture.image, srgb }], &self.samplers[&texture.sampler])
    }

    /// The material bind group (set 1) of a pipeline: its uniform block and what it declares of the maps.
    ///
    /// # Errors
    /// When the device is out of memory.
    pub fn bind_material(
        &self,
        scene: &Scene,
        spec: &PipelineSpec,
        name: &str,
        block: (&str, &Buffer),
        maps: &[Map],
    ) -> Result<BindGroup, GpuError> {
        let names: Vec<_> =
            maps.iter().map(|map| (format!("{}_map", map.name), format!("{}_sampler", map.name))).collect();
        let mut offered = vec![(block.0, Resource::Buffer(block.1))];
        for (map, (texture_name, sampler_name)) in maps.iter().zip(&names) {
            let (image, sampler) = self.map(scene, map.texture.filter(|_| spec.samples_map(map.name)), map.srgb);
            offered.push((texture_name, Resource::Texture(image)));
            offered.push((sampler_name, Resource::Sampler(sampler)));
        }
        self.gpu.bind_group(self.pipeline(spec), 1, name, &offered)
    }

    fn prepare_geometry(&mut self, upload: &mut Upload, scene: &Scene, plan: &Plan) -> Result<(), GpuError> {
        for (&index, streams) in &plan.streams {
            let mesh = &scene.asset().meshes[index.0];
            let name = |what: &str| format!("{what} of {}.{}", mesh.name.as_deref().unwrap_or("mesh"), index.1);
            for &stream in streams {
                if !self.streams.contains_key(&(index, stream)) {
                    let bytes = stream_bytes(mesh, index.1, stream);
                    // The deform pass reads what it moves.
                    let usage = vk::BufferUsageFlags::VERTEX_BUFFER | vk::BufferUsageFlags::STORAGE_BUFFER;
                    let buffer = filled_buffer(&self.gpu, upload, &name(&format!("{stream:?}")), usage, &bytes)?;
                    self.streams.insert((index, stream), buffer);
                }
            }
            if !self.indices.contains_key(&index) {
                let bytes = bytemuck::cast_slice(&mesh.primitives[index.1].indices);
                let buffer =
                    filled_buffer(&self.gpu, upload, &name("indices"), vk::BufferUsageFlags::INDEX_BUFFER, bytes)?;
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
            let image = filled_image(&self.gpu, upload, &source.name, [width, height], format, &levels)?;
            self.images.insert(texture, image);
        }
        for texture in &scene.asset().textures {
            if !self.samplers.contains_key(&texture.sampler) {
                self.samplers.insert(texture.sampler, self.gpu.sampler(&sampler_desc(&texture.sampler))?);
            }
        }
        Ok(())
    }

    fn prepare_surfaces(&mut self, upload: &mut Upload, scene: &Scene, plan: &Plan) -> Result<(), GpuError> {
        for draw in plan.opaque.iter().chain(&plan.transparent) {
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
            let group =
                self.bind_material(scene, spec, name, ("StandardBlock", &uniforms), &surface_maps(&standard))?;
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
    // Vulkan has no empty buffers.
    let size = bytes.len().max(4) as u64;
    let buffer = gpu.buffer(name, size, usage | vk::BufferUsageFlags::TRANSFER_DST, Memory::Device)?;
    if !bytes.is_empty() {
        upload.buffer(&buffer, 0, bytes);
    }
    Ok(buffer)
}

fn filled_image(
    gpu: &Gpu,
    upload: &mut Upload,
    name: &str,
    size: [u32; 2],
    format: vk::Format,
    levels: &[Cow<[u8]>],
) -> Result<Image, GpuError> {
    let image = gpu.image(&ImageDesc {
        name,
        size,
        format,
        mip_levels: levels.len() as u32,
        samples: 1,
        usage: vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST,
    })?;
    let levels: Vec<&[u8]> = levels.iter().map(|level| &level[..]).collect();
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
