//! Materials on the device: their uniform blocks, each in a slice of its own, so that an edit writes that block and nothing
//! else, and the groups that bind blocks, maps and tables.

use super::content::Content;
use crate::gpu::{BindGroup, Buffer, GpuError, Pipeline, Resource, TransientSlice};
use crate::render::fur::fur_maps;
use crate::render::pass::draw::MATERIAL_SET;
use crate::render::plan::{Draw, DrawKind, PipelineSpec, Plan, SurfaceUse, TextureUse};
use crate::render::renderer::{Defaults, FALLBACK_SAMPLER, Shared, TABLE_SAMPLER};
use crate::render::surface::{Map, Table, family_shader, family_uniforms, standard_uniforms, surface_maps};
use crate::scene::Scene;
use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

/// A material as a group binds it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum MaterialUse {
    /// A surface.
    Surface(SurfaceUse),
    /// Fur of the material, however many shells.
    Fur(usize),
}

impl MaterialUse {
    /// That of a draw.
    pub fn of(draw: &Draw) -> Self {
        match draw.kind {
            DrawKind::Surface(surface) => Self::Surface(surface),
            DrawKind::Fur { material, .. } => Self::Fur(material),
        }
    }
}

/// The blocks of a surface: the standard one and that of its family.
struct Blocks {
    standard: Block,
    family: Option<Block>,
}

struct Block {
    bytes: Vec<u8>,
    slice: TransientSlice,
}

impl Block {
    fn new(shared: &Shared, bytes: Vec<u8>) -> Result<Self, GpuError> {
        let slice = shared.blocks.slice(bytes.len() as u64, shared.gpu.info().uniform_alignment)?;
        slice.write(0, &bytes)?;
        Ok(Self { bytes, slice })
    }

    /// Writes other bytes, elsewhere: frames in flight read the old ones.
    fn set(&mut self, shared: &Shared, bytes: Vec<u8>) -> Result<(), GpuError> {
        if self.bytes != bytes {
            *self = Self::new(shared, bytes)?;
        }
        Ok(())
    }
}

/// The materials of a scene on the device.
#[derive(Default)]
pub struct Materials {
    blocks: HashMap<SurfaceUse, Blocks>,
    groups: HashMap<(MaterialUse, usize), BindGroup>,
}

impl Materials {
    /// Writes the blocks that have changed. Whether groups must be made again, as a block now lies in another buffer or has
    /// come anew.
    ///
    /// # Errors
    /// When the device is out of memory.
    pub fn write_blocks(&mut self, shared: &Shared, scene: &Scene, plan: &Plan) -> Result<bool, GpuError> {
        let mut is_stale = false;
        let draws = plan.draws.values().flatten();
        let uses: BTreeSet<SurfaceUse> = draws
            .filter_map(|draw| match draw.kind {
                DrawKind::Surface(surface) => Some(surface),
                DrawKind::Fur { .. } => None,
            })
            .collect();
        self.blocks.retain(|known, _| uses.contains(known));
        for surface in uses {
            let standard = standard_uniforms(&scene.standard(surface.material, surface.under_fur));
            let standard = bytemuck::bytes_of(&standard).to_vec();
            let family = scene.family(surface.material, surface.under_fur).map(|family| family_uniforms(family).1);
            match self.blocks.get_mut(&surface) {
                Some(known) if known.family.is_some() == family.is_some() => {
                    let buffers = known.buffers();
                    known.standard.set(shared, standard)?;
                    if let (Some(known), Some(bytes)) = (&mut known.family, family) {
                        known.set(shared, bytes)?;
                    }
                    is_stale |= buffers != known.buffers();
                }
                _ => {
                    let standard = Block::new(shared, standard)?;
                    let family = family.map(|bytes| Block::new(shared, bytes)).transpose()?;
                    self.blocks.insert(surface, Blocks { standard, family });
                    is_stale = true;
                }
            }
        }
        Ok(is_stale)
    }

    /// Binds every material to every pipeline that draws it; `values` is where the blocks of fur are read from.
    ///
    /// # Errors
    /// When the device is out of memory.
    pub fn bind(
        &mut self,
        shared: &Shared,
        scene: &Scene,
        content: &Content,
        plan: &Plan,
        pipelines: &[Arc<Pipeline>],
        values: &Buffer,
    ) -> Result<(), GpuError> {
        self.groups.clear();
        for draw in plan.draws.values().flatten() {
            let key = (MaterialUse::of(draw), draw.pipeline);
            if self.groups.contains_key(&key) {
                continue;
            }
            let (spec, pipeline) = (&plan.pipelines[draw.pipeline], &pipelines[draw.pipeline]);
            let bind = Bind { shared, scene, content, spec, pipeline };
            let group = match key.0 {
                MaterialUse::Surface(surface) => {
                    let Some(blocks) = self.blocks.get(&surface) else { continue };
                    bind.surface(surface, blocks)?
                }
                MaterialUse::Fur(material) => bind.fur(material, values)?,
            };
            self.groups.extend(group.map(|group| (key, group)));
        }
        Ok(())
    }

    /// The group of a draw with its pipeline.
    pub fn group(&self, draw: &Draw) -> &BindGroup {
        &self.groups[&(MaterialUse::of(draw), draw.pipeline)]
    }

    /// Where the blocks of a surface start in their buffers, bytes.
    pub fn offsets(&self, surface: SurfaceUse) -> [u64; 2] {
        self.blocks.get(&surface).map_or([0; 2], |blocks| {
            let family = blocks.family.as_ref().map_or(0, |block| block.slice.offset());
            [blocks.standard.slice.offset(), family]
        })
    }

    /// The slices of a surface's blocks, which frames in flight must keep.
    pub fn slices(&self) -> impl Iterator<Item = &TransientSlice> {
        self.blocks.values().flat_map(|blocks| {
            std::iter::once(&blocks.standard.slice).chain(blocks.family.as_ref().map(|block| &block.slice))
        })
    }
}

impl Blocks {
    /// The buffers that the blocks lie in, to tell whether they have moved.
    fn buffers(&self) -> [Option<usize>; 2] {
        let place = |block: &Block| block.slice.buffer().place();
        [Some(place(&self.standard)), self.family.as_ref().map(place)]
    }
}

/// What a group of one material and one pipeline is made of.
struct Bind<'a> {
    shared: &'a Shared,
    scene: &'a Scene,
    content: &'a Content,
    spec: &'a PipelineSpec,
    pipeline: &'a Pipeline,
}

impl Bind<'_> {
    fn surface(&self, surface: SurfaceUse, blocks: &Blocks) -> Result<Option<BindGroup>, GpuError> {
        let standard = self.scene.standard(surface.material, surface.under_fur);
        let family = self.scene.family(surface.material, surface.under_fur);
        let name = &self.scene.materials()[surface.material].name;
        let mut bound = vec![("StandardBlock", blocks.standard.slice.buffer())];
        let mut shader = None;
        if let (Some(family), Some(block)) = (family, &blocks.family) {
            let block_name = family_uniforms(family).0;
            if self.spec.binds(block_name) {
                bound.push((block_name, block.slice.buffer()));
                shader = Some(family_shader(family));
            }
        }
        let tables = shader.as_ref().map_or(&[][..], |family| &family.tables);
        self.group(name, &bound, &surface_maps(&standard, shader.as_ref()), tables).map(Some)
    }

    fn fur(&self, material: usize, values: &Buffer) -> Result<Option<BindGroup>, GpuError> {
        let material = &self.scene.materials()[material];
        let Some(fur) = &material.fur else { return Ok(None) };
        let maps = fur_maps(fur, &material.standard);
        self.group(&material.name, &[("FurBlock", values)], &maps, &[]).map(Some)
    }

    fn group(
        &self,
        name: &str,
        blocks: &[(&str, &Buffer)],
        maps: &[Map],
        tables: &[&Table],
    ) -> Result<BindGroup, GpuError> {
        let Self { shared, spec, pipeline, .. } = self;
        let defaults = &shared.defaults;
        let maps = maps.iter().filter(|map| spec.binds_map(map));
        let maps: Vec<_> = maps.map(|map| (map.texture_name(), map.sampler_name(), map)).collect();
        let tables = tables.iter().filter(|table| spec.binds_table(table));
        let tables: Vec<_> = tables.map(|table| (table.texture_name(), table.sampler_name(), table)).collect();
        let mut offered: Vec<_> = blocks.iter().map(|(name, buffer)| (*name, Resource::Buffer(buffer))).collect();
        for (texture, sampler, map) in &maps {
            let Some([image, used]) = self.map(defaults, map) else { continue };
            offered.push((texture, image));
            offered.push((sampler, used));
        }
        for (texture, sampler, table) in &tables {
            offered.push((texture, Resource::Texture(defaults.table(table))));
            offered.push((sampler, Resource::Sampler(defaults.sampler(&TABLE_SAMPLER))));
        }
        shared.gpu.bind_group(pipeline, MATERIAL_SET, name, &offered)
    }

    /// The texture and sampler of a map that the pipeline binds, or the fallback, which the plan lists.
    fn map<'a>(&'a self, defaults: &'a Defaults, map: &Map) -> Option<[Resource<'a>; 2]> {
        let (image, sampler) = match map.texture.filter(|_| self.spec.samples_map(map)) {
            Some(used) => {
                let texture = &self.scene.asset().textures[used.texture];
                (self.content.image(TextureUse { image: texture.image, srgb: map.srgb }), &texture.sampler)
            }
            None => (defaults.fallback(map.fallback)?, &FALLBACK_SAMPLER),
        };
        Some([Resource::Texture(image), Resource::Sampler(defaults.sampler(sampler))])
    }
}
