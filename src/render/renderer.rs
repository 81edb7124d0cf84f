//! What belongs to a device, whatever is drawn: pipelines, samplers, look-up tables, fallback textures, environments, and the
//! memory that frames write their values into. Any number of scenes and views share one.

use super::RenderError;
use super::device_scene::ABSENT;
use super::light::{EnvironmentMaps, EnvironmentQuality, LobeTable};
use super::picture::PictureHost;
use super::plan::{ComputeSpec, PipelineSpec, Plan};
use super::surface::{Fallback, Table};
use crate::asset::{self, Environment, Wrap};
use crate::gpu::{
    Buffer, Gpu, GpuError, GpuOptions, Image, ImageDesc, Memory, Pipeline, Sampler, SamplerDesc, TransientPool, Upload,
};
use ash::vk;
use std::collections::HashMap;
use std::sync::Arc;

/// One texel needs no filter, and floats of 32 bits may have none.
pub(super) const FALLBACK_SAMPLER: asset::Sampler =
    asset::Sampler { wrap: [Wrap::Repeat; 2], mag_linear: false, min_linear: false, mip_linear: None };

/// Of every table.
pub(super) const TABLE_SAMPLER: asset::Sampler =
    asset::Sampler { wrap: [Wrap::Clamp; 2], mag_linear: true, min_linear: true, mip_linear: None };

/// Draws scenes on one device: as pictures ([`Self::render`]), or into a host's own frames ([`Self::frame`]).
///
/// It is `Send`: one thread at a time uses it, and any number of renderers share a device.
pub struct Renderer {
    pub(super) shared: Shared,
    pub(super) picture: PictureHost,
}

/// What scenes share.
pub(crate) struct Shared {
    pub(super) gpu: Gpu,
    pub(super) pipelines: Pipelines,
    pub(super) defaults: Defaults,
    /// What frames write anew.
    pub(super) frame_values: TransientPool,
    /// Uniform blocks of materials.
    pub(super) blocks: TransientPool,
    environments: Vec<Arc<EnvironmentMaps>>,
    lobes: Option<Arc<LobeTable>>,
}

impl Renderer {
    /// Opens a device.
    ///
    /// # Errors
    /// Those of [`Gpu::new`].
    pub fn new(options: &GpuOptions) -> Result<Self, RenderError> {
        Ok(Self::with_gpu(Gpu::new(options)?))
    }

    /// On a device that is open, perhaps the host's ([`Gpu::from_host`]).
    pub fn with_gpu(gpu: Gpu) -> Self {
        let shared = Shared {
            pipelines: Pipelines { gpu: gpu.clone(), graphics: HashMap::new(), compute: HashMap::new() },
            defaults: Defaults::new(&gpu),
            frame_values: gpu.transient_pool("frame values"),
            blocks: gpu.transient_pool("material blocks"),
            environments: Vec::new(),
            lobes: None,
            gpu,
        };
        Self { shared, picture: PictureHost::default() }
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.shared.gpu
    }

    /// Text of every pipeline made so far: whole state and interface, sorted.
    pub fn pipeline_descriptions(&self) -> Vec<String> {
        let mut all: Vec<String> =
            self.shared.pipelines.all().map(|pipeline| pipeline.description().to_owned()).collect();
        all.sort();
        all
    }
}

impl Shared {
    /// Maps of an environment: those of the last frames, from the device's cache folder, or computed. What nobody holds any
    /// more goes first, as two need not fit at once.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub(super) fn environment(
        &mut self,
        environment: &Arc<Environment>,
        quality: EnvironmentQuality,
    ) -> Result<Arc<EnvironmentMaps>, GpuError> {
        if let Some(known) = self.environments.iter().find(|maps| maps.are_of(environment, quality)) {
            return Ok(known.clone());
        }
        self.environments.retain(|maps| Arc::strong_count(maps) > 1);
        let maps = Arc::new(EnvironmentMaps::new(&self.gpu, environment, quality)?);
        self.environments.push(maps.clone());
        Ok(maps)
    }

    /// The table of lobes.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub(super) fn lobes(&mut self, quality: &EnvironmentQuality) -> Result<Arc<LobeTable>, GpuError> {
        if let Some(known) = self.lobes.as_ref().filter(|lobes| lobes.is_of(quality)) {
            return Ok(known.clone());
        }
        let lobes = Arc::new(LobeTable::new(&self.gpu, quality)?);
        self.lobes = Some(lobes.clone());
        Ok(lobes)
    }
}

/// Pipelines, each made when a plan first lists it.
pub(crate) struct Pipelines {
    gpu: Gpu,
    graphics: HashMap<PipelineSpec, Arc<Pipeline>>,
    compute: HashMap<ComputeSpec, Arc<Pipeline>>,
}

impl Pipelines {
    /// A graphics pipeline.
    ///
    /// # Errors
    /// Those of the device.
    pub(super) fn graphics(&mut self, spec: &PipelineSpec) -> Result<Arc<Pipeline>, GpuError> {
        if let Some(known) = self.graphics.get(spec) {
            return Ok(known.clone());
        }
        let pipeline = Arc::new(spec.create(&self.gpu)?);
        self.graphics.insert(spec.clone(), pipeline.clone());
        Ok(pipeline)
    }

    /// A compute pipeline.
    ///
    /// # Errors
    /// Those of the device.
    pub(super) fn compute(&mut self, spec: &ComputeSpec) -> Result<Arc<Pipeline>, GpuError> {
        if let Some(known) = self.compute.get(spec) {
            return Ok(known.clone());
        }
        let pipeline = Arc::new(spec.create(&self.gpu)?);
        self.compute.insert(spec.clone(), pipeline.clone());
        Ok(pipeline)
    }

    /// Milliseconds that making all of them took.
    pub(super) fn creation_ms(&self) -> f64 {
        self.all().map(|pipeline| pipeline.creation_ms()).sum()
    }

    fn all(&self) -> impl Iterator<Item = &Arc<Pipeline>> {
        self.graphics.values().chain(self.compute.values())
    }
}

/// What is bound where a scene has nothing of its own, and tables; each made when a plan first lists it.
pub(crate) struct Defaults {
    gpu: Gpu,
    /// One texel each.
    fallbacks: HashMap<Fallback, Image>,
    tables: HashMap<&'static str, Image>,
    samplers: HashMap<asset::Sampler, Sampler>,
    /// Bound with stride 0 where a primitive lacks a stream.
    absent: Option<Arc<Buffer>>,
}

impl Defaults {
    fn new(gpu: &Gpu) -> Self {
        let (fallbacks, tables, samplers) = Default::default();
        Self { gpu: gpu.clone(), fallbacks, tables, samplers, absent: None }
    }

    /// Makes what the plan lists and is not there yet. What failed is not there.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub(super) fn prepare(&mut self, plan: &Plan) -> Result<(), GpuError> {
        let samplers = plan.samplers.iter().chain([&FALLBACK_SAMPLER, &TABLE_SAMPLER]);
        for sampler in samplers {
            if !self.samplers.contains_key(sampler) {
                let is_needed = match *sampler {
                    FALLBACK_SAMPLER => !plan.fallbacks.is_empty() || plan.samplers.contains(sampler),
                    TABLE_SAMPLER => !plan.tables.is_empty() || plan.samplers.contains(sampler),
                    _ => true,
                };
                if is_needed {
                    self.samplers.insert(*sampler, self.gpu.sampler(&sampler_desc(sampler))?);
                }
            }
        }
        let fallbacks: Vec<Fallback> =
            plan.fallbacks.iter().copied().filter(|kind| !self.fallbacks.contains_key(kind)).collect();
        let tables: Vec<&'static Table> =
            plan.tables.values().copied().filter(|table| !self.tables.contains_key(table.name)).collect();
        let needs_absent = plan.has_absent_streams && self.absent.is_none();
        if fallbacks.is_empty() && tables.is_empty() && !needs_absent {
            return Ok(());
        }
        let mut upload = self.gpu.upload();
        let mut absent = None;
        if needs_absent {
            let usage = vk::BufferUsageFlags::VERTEX_BUFFER;
            let bytes = bytemuck::cast_slice(&ABSENT);
            absent = Some(filled_buffer(&self.gpu, &mut upload, "absent stream", usage, bytes)?);
        }
        let mut new_fallbacks = Vec::new();
        for fallback in fallbacks {
            let texel = fallback.texel();
            let (name, levels) = (format!("{fallback:?}"), [bytemuck::bytes_of(&texel)]);
            let format = vk::Format::R32G32B32A32_SFLOAT;
            let image = filled_image(&self.gpu, &mut upload, &name, [1, 1], format, false, &levels)?;
            new_fallbacks.push((fallback, image));
        }
        let mut new_tables = Vec::new();
        for table in tables {
            let levels = [table.texels];
            let image = filled_image(&self.gpu, &mut upload, table.name, table.size, Table::FORMAT, false, &levels)?;
            new_tables.push((table.name, image));
        }
        upload.finish()?;
        self.absent = absent.map(Arc::new).or(self.absent.take());
        self.fallbacks.extend(new_fallbacks);
        self.tables.extend(new_tables);
        Ok(())
    }

    /// What a primitive's missing streams are read from, where a plan says that one is.
    pub(super) fn absent(&self) -> Option<&Arc<Buffer>> {
        self.absent.as_ref()
    }

    /// The fallback texture of that kind, where the plan lists it.
    pub(super) fn fallback(&self, fallback: Fallback) -> Option<&Image> {
        self.fallbacks.get(&fallback)
    }

    /// A table that the plan lists.
    pub(super) fn table(&self, table: &Table) -> &Image {
        &self.tables[table.name]
    }

    /// A sampler that the plan lists, or of what it lists.
    pub(super) fn sampler(&self, sampler: &asset::Sampler) -> &Sampler {
        &self.samplers[sampler]
    }
}

/// Vulkan has no empty buffers.
const LEAST_BYTES: u64 = 4;

/// A device buffer that holds `bytes`.
pub(super) fn filled_buffer(
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

/// A device buffer for so many bytes, at least those that Vulkan wants.
pub(super) fn device_buffer(
    gpu: &Gpu,
    name: &str,
    usage: vk::BufferUsageFlags,
    bytes: u64,
) -> Result<Buffer, GpuError> {
    gpu.buffer(name, bytes.max(LEAST_BYTES), usage | vk::BufferUsageFlags::TRANSFER_DST, Memory::Device)
}

/// Whether the buffer was made for so many bytes: another number of copies needs another one.
pub(super) fn holds(buffer: &Buffer, bytes: u64) -> bool {
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
