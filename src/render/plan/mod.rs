//! What one frame needs, decided before anything touches the device: draws, pipelines, vertex streams, textures, passes.
//!
//! A plan is plain data made from what is drawn and how ([`PlanInput`]), so it can be printed (`vair inspect`) and tested
//! without a GPU; the device makes exactly what it lists and nothing else. It does not depend on where things stand: while
//! a scene only moves, its plan stays.

mod attachment;
mod memory;
mod options;
mod pipeline;
mod setup;
mod skipped;
mod staging;

pub use attachment::Attachment;
pub use memory::{index_name, stream_name};
pub use options::{PictureOptions, PlanOptions};
pub use pipeline::{Blending, ComputeSpec, DepthCompare, DepthUse, Eye, PipelineSpec, Variants};
pub use setup::FrameSetup;
pub use skipped::Skipped;
pub use staging::Staging;

use super::device_scene::{Stream, StreamPose, inputs};
use super::fur::{fur_maps, fur_pipeline};
use super::light::{LightingFeatures, shadow_images, shadow_size};
use super::options::ShellSubmission;
use super::pass::{Pass, skinning, strand_dynamics};
use super::surface::{Fallback, Map, Table, family_shader, surface_maps, surface_pipeline};
use crate::asset::{Asset, Primitive, Sampler, Topology};
use crate::material::{AlphaMode, Fur, Standard};
use crate::scene::{Instance, Part, Scene, Side};
use ash::vk;
use std::collections::{BTreeMap, BTreeSet};

/// What a plan is made of.
#[derive(Clone, Copy)]
pub struct PlanInput<'a> {
    /// Meshes and materials.
    pub scene: &'a Scene,
    /// What stands in the scene; a plan asks for skins alone.
    pub instances: &'a [Instance],
    /// What is drawn.
    pub parts: &'a [Part],
    /// Shadow maps of the frame's lights.
    pub shadow_map_count: usize,
    /// A light reaches something.
    pub is_reached_by_light: bool,
    /// How.
    pub options: &'a PlanOptions,
}

/// An image on the device: which one, and whether its bytes are sRGB-coded colour or data.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TextureUse {
    /// Index into the asset's images.
    pub image: usize,
    /// Colour is decoded when sampled, data never.
    pub srgb: bool,
}

/// A surface material as it is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SurfaceUse {
    /// Index into the scene's materials.
    pub material: usize,
    /// The surface is the skin under fur.
    pub under_fur: bool,
}

/// What is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum DrawKind {
    /// A surface.
    Surface(SurfaceUse),
    /// Fur: that many shells of the material.
    Fur {
        /// Index into the scene's materials; it has fur.
        material: usize,
        /// Shells.
        layers: u32,
    },
}

/// One draw call.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Draw {
    /// Index into [`Plan::parts`].
    pub part: usize,
    /// Index into [`Plan::pipelines`].
    pub pipeline: usize,
    /// What is drawn.
    pub kind: DrawKind,
    /// Faces that are drawn.
    pub faces: Faces,
}

/// Sides of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Faces {
    /// Both at once.
    Both,
    /// One; blended draws of both are parted, as what lies behind must be blended first.
    One(Side),
}

/// One stream of one part that skinning writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Deform {
    /// Index into [`Plan::parts`].
    pub part: usize,
    /// Stream.
    pub stream: Stream,
    /// In this frame's pose or in the previous one's.
    pub pose: StreamPose,
    /// Index into [`Plan::compute_pipelines`].
    pub pipeline: usize,
}

/// Fur of one part whose strands lag behind their roots.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Dynamics {
    /// Index into [`Plan::parts`].
    pub part: usize,
    /// Index into [`Plan::compute_pipelines`].
    pub pipeline: usize,
}

/// What shadows take, beside the draws that cast them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ShadowPlan {
    /// Maps, tile by tile of the atlas.
    pub map_count: u32,
    /// Texels of a map's sides.
    pub resolution_px: u32,
    /// Something lets light through in part.
    pub is_translucent: bool,
    /// Shaders read the maps, or would: one stands in where there are none.
    pub is_bound: bool,
}

/// What one frame needs.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Plan {
    /// Passes in order.
    pub passes: Vec<Pass>,
    /// Images to draw into, beside the picture itself.
    pub attachments: Vec<Attachment>,
    /// What the light of the frame takes.
    pub lighting: LightingFeatures,
    /// What shadows take.
    pub shadows: ShadowPlan,
    /// What is drawn.
    pub parts: Vec<Part>,
    /// Graphics pipelines, each once.
    pub pipelines: Vec<PipelineSpec>,
    /// Compute pipelines, each once.
    pub compute_pipelines: Vec<ComputeSpec>,
    /// Streams to move.
    pub deforms: Vec<Deform>,
    /// Fur whose strands lag behind.
    pub dynamics: Vec<Dynamics>,
    /// Draws of each pass that draws the scene; what blends is unsorted.
    pub draws: BTreeMap<Pass, Vec<Draw>>,
    /// Vertex streams to upload, by (mesh, primitive).
    pub streams: BTreeMap<(usize, usize), BTreeSet<Stream>>,
    /// Primitives, by (mesh, primitive), whose vertices and indices are uploaded once a shell, and how often that is.
    pub copies: BTreeMap<(usize, usize), u32>,
    /// A pipeline reads a stream that its primitive has not: one value stands in for all vertices.
    pub has_absent_streams: bool,
    /// Images to upload.
    pub textures: BTreeSet<TextureUse>,
    /// Fallback textures, bound where a pipeline has a map that the material has not.
    pub fallbacks: BTreeSet<Fallback>,
    /// Look-up tables to upload, by name.
    pub tables: BTreeMap<&'static str, &'static Table>,
    /// Samplers of the textures, each once.
    pub samplers: Vec<Sampler>,
}

impl Plan {
    /// Decides what a frame needs.
    pub fn new(input: &PlanInput) -> Self {
        let lighting = LightingFeatures::new(input);
        let shadows = ShadowPlan {
            map_count: input.shadow_map_count as u32,
            resolution_px: input.options.shadows.resolution_px,
            is_translucent: lighting.translucent_shadows,
            is_bound: lighting.is_occluded(),
        };
        let mut plan = Self { parts: input.parts.to_vec(), lighting, shadows, ..Self::default() };
        for index in 0..plan.parts.len() {
            plan.add_part(input, index);
        }
        if input.options.everything {
            plan.add_spare_pipelines(input);
        }
        if !plan.is_lit() {
            // Nothing receives a shadow.
            (plan.lighting, plan.shadows) = Default::default();
        }
        for pass in Pass::ALL {
            pass.add_draws(&mut plan, input);
        }
        if plan.lighting.shadows && !plan.lighting.ssao {
            plan.fallbacks.insert(Fallback::White);
        }
        plan.passes = Pass::ALL.iter().copied().filter(|pass| pass.wanted(&plan, input).is_ok()).collect();
        plan.attachments = Pass::ALL.iter().flat_map(|pass| pass.attachments(&plan, input.options)).collect();
        plan
    }

    fn add_part(&mut self, input: &PlanInput, index: usize) {
        let PlanInput { scene, options, .. } = *input;
        let Part { mesh, primitive, material, .. } = self.parts[index];
        let geometry = &scene.asset().meshes[mesh].primitives[primitive];
        let fur = scene.materials()[material].fur.as_ref().filter(|_| geometry.topology == Topology::Triangles);

        if let Some(fur) = fur.filter(|_| options.shells.submission == ShellSubmission::Duplicated) {
            self.copies.insert((mesh, primitive), options.layers_of(fur.layers));
        }

        let surface = SurfaceUse { material, under_fur: fur.is_some() };
        let standard = scene.standard(surface.material, surface.under_fur);
        let family = scene.family(surface.material, surface.under_fur).map(family_shader);
        let spec = surface_pipeline(&standard, family.as_ref(), geometry, self.lighting, options);
        self.add_textures(scene, &spec, &surface_maps(&standard, family.as_ref()));
        let tables = family.into_iter().flat_map(|family| family.tables);
        self.tables.extend(tables.filter(|table| spec.binds_table(table)).map(|table| (table.name, table)));
        self.add_draw(input, index, spec, DrawKind::Surface(surface));

        if let Some(fur) = fur {
            let standard = &scene.materials()[material].standard;
            let layers = options.layers_of(fur.layers);
            let spec = fur_pipeline(fur, standard, geometry, self.lighting, options);
            self.add_textures(scene, &spec, &fur_maps(fur, standard));
            self.add_draw(input, index, spec, DrawKind::Fur { material, layers });
            if options.has_dynamics(fur) {
                let pipeline = index_of(&mut self.compute_pipelines, strand_dynamics::pipeline());
                self.dynamics.push(Dynamics { part: index, pipeline });
            }
        }
    }

    /// A pipeline of a part, with the streams that it reads, and those of them that a pass moves.
    pub fn add_pipeline(&mut self, input: &PlanInput, part: usize, spec: PipelineSpec) -> usize {
        let Part { instance, mesh, primitive, .. } = self.parts[part];
        let geometry = &input.scene.asset().meshes[mesh].primitives[primitive];
        let skin = input.instances[instance].skin.is_some() && geometry.vertices.influences_per_vertex > 0;
        let morph = !geometry.morph_targets.is_empty();
        // Without joints and targets it moves nothing. It writes one copy of each vertex.
        let at_rest = input.options.everything && !self.copies.contains_key(&(mesh, primitive));
        let moved = skin || morph || at_rest;
        let streams = self.streams.entry((mesh, primitive)).or_default();
        for vertex_input in inputs(spec.vertex.shader()) {
            if !has_stream(geometry, vertex_input.stream) {
                self.has_absent_streams |= vertex_input.stream != Stream::Sway;
                continue;
            }
            streams.insert(vertex_input.stream);
            let is_moved = moved && vertex_input.pose != StreamPose::Rest;
            let Some(kind) = vertex_input.stream.skinning_kind().filter(|_| is_moved) else { continue };
            let (stream, pose) = (vertex_input.stream, vertex_input.pose);
            if self.deforms.iter().any(|deform| (deform.part, deform.stream, deform.pose) == (part, stream, pose)) {
                continue;
            }
            let spec = skinning::pipeline(skin, morph || !skin, kind);
            let pipeline = index_of(&mut self.compute_pipelines, spec);
            self.deforms.push(Deform { part, stream, pose, pipeline });
        }
        index_of(&mut self.pipelines, spec)
    }

    fn add_draw(&mut self, input: &PlanInput, part: usize, spec: PipelineSpec, kind: DrawKind) {
        let Part { mesh, primitive, .. } = self.parts[part];
        let topology = input.scene.asset().meshes[mesh].primitives[primitive].topology;
        let pass = match kind {
            _ if spec.builds_lists() => Pass::OitBuild,
            _ if spec.blending != Blending::Replace => Pass::Transparent,
            DrawKind::Surface(_) => Pass::Opaque,
            DrawKind::Fur { .. } => Pass::Fur,
        };
        let is_two_sided = match kind {
            DrawKind::Surface(surface) => input.scene.materials()[surface.material].standard.double_sided,
            // Shells that face away carry the strands that stand out over the outline.
            DrawKind::Fur { .. } => true,
        };
        let faces: &[Faces] = match is_two_sided {
            // Lists take both sides at once, in whatever order.
            true if pass == Pass::Transparent && topology == Topology::Triangles => {
                &[Faces::One(Side::Back), Faces::One(Side::Front)]
            }
            true => &[Faces::Both],
            false => &[Faces::One(Side::Front)],
        };
        let pipeline = self.add_pipeline(input, part, spec);
        let draws = faces.iter().map(|&faces| Draw { part, pipeline, kind, faces });
        self.draws.entry(pass).or_default().extend(draws);
    }

    /// Only what the pipeline samples: a map without UVs, tangents or light to show it stays off the device.
    fn add_textures(&mut self, scene: &Scene, spec: &PipelineSpec, maps: &[Map]) {
        for map in maps.iter().filter(|map| spec.binds_map(map)) {
            match map.texture.filter(|_| spec.samples_map(map)) {
                Some(texture) => {
                    let texture = &scene.asset().textures[texture.texture];
                    self.textures.insert(TextureUse { image: texture.image, srgb: map.srgb });
                    index_of(&mut self.samplers, texture.sampler);
                }
                None => {
                    self.fallbacks.insert(map.fallback);
                }
            }
        }
    }

    /// What a renderer without a plan has ready whatever it draws: a pipeline for fur and one that blends.
    fn add_spare_pipelines(&mut self, input: &PlanInput) {
        let scene = input.scene;
        let geometry = |part: &Part| &scene.asset().meshes[part.mesh].primitives[part.primitive];
        let is_solid = |part: &&Part| geometry(part).topology == Topology::Triangles;
        let Some(part) = self.parts.iter().find(is_solid) else { return };
        let standard = scene.standard(part.material, false);
        if !self.has_fur() {
            let spec = fur_pipeline(&Fur::default(), &standard, geometry(part), self.lighting, input.options);
            self.pipelines.push(spec);
        }
        if !self.pipelines.iter().any(|spec| spec.blending != Blending::Replace) {
            let blending = Standard { alpha_mode: AlphaMode::Blend, ..standard.into_owned() };
            let spec = surface_pipeline(&blending, None, geometry(part), self.lighting, input.options);
            self.pipelines.push(spec);
        }
    }

    /// The draws of a pass; what blends is unsorted.
    pub fn draws_of(&self, pass: Pass) -> &[Draw] {
        self.draws.get(&pass).map_or(&[], Vec::as_slice)
    }

    /// The draws that the camera sees, in the order of their passes.
    pub fn shown(&self) -> impl Iterator<Item = &Draw> {
        [Pass::Opaque, Pass::Fur, Pass::OitBuild, Pass::Transparent].into_iter().flat_map(|pass| self.draws_of(pass))
    }

    /// Draws and dispatches of a pass that the plan lists.
    pub fn draw_count(&self, pass: Pass, options: &PlanOptions) -> usize {
        match pass {
            Pass::Skinning => self.deforms.len(),
            Pass::StrandDynamics => self.dynamics.len(),
            pass => self.draws_of(pass).len() + usize::from(pass.full_screen(options).is_some()),
        }
    }

    /// Pipelines that draw one triangle over a whole target, in the order of their passes.
    pub fn full_screen(&self, options: &PlanOptions) -> Vec<PipelineSpec> {
        self.passes.iter().filter_map(|pass| pass.full_screen(options)).map(|desc| desc.spec).collect()
    }

    /// The images of the shadow maps: name, format, texels.
    pub fn shadow_images(&self) -> impl Iterator<Item = (&'static str, vk::Format, [u32; 2])> {
        let size = shadow_size(&self.shadows);
        shadow_images(&self.shadows).iter().map(move |(name, format)| (*name, *format, size))
    }

    /// Whether fur is drawn, in whatever pass.
    pub fn has_fur(&self) -> bool {
        self.shown().any(|draw| matches!(draw.kind, DrawKind::Fur { .. }))
    }

    /// Whether anything that is drawn blends.
    pub fn blends(&self) -> bool {
        !self.draws_of(Pass::OitBuild).is_empty() || !self.draws_of(Pass::Transparent).is_empty()
    }

    /// Whether any pipeline builds the pixels' linked lists, drawn with or not.
    pub fn builds_lists(&self) -> bool {
        self.pipelines.iter().any(PipelineSpec::builds_lists)
    }

    /// Whether any surface or fur is lit.
    pub fn is_lit(&self) -> bool {
        self.pipelines.iter().any(|spec| spec.variants.is_some() && spec.is_lit())
    }

    /// Whether any shader asks how lobes look into the environment.
    pub fn binds_lobes(&self) -> bool {
        self.pipelines.iter().any(|spec| spec.binds("lobe_table"))
    }

    /// How often the vertices and indices of (mesh, primitive) are on the device.
    pub fn copies_of(&self, index: (usize, usize)) -> u32 {
        self.copies.get(&index).copied().unwrap_or(1)
    }

    /// Bytes of one vertex stream of (mesh, primitive).
    pub fn bytes_of_stream(&self, asset: &Asset, index: (usize, usize), stream: Stream) -> u64 {
        let vertices = asset.meshes[index.0].primitives[index.1].vertices.positions.len() as u64;
        vertices * u64::from(stream.stride()) * u64::from(self.copies_of(index))
    }

    /// Bytes of the index list of (mesh, primitive).
    pub fn bytes_of_indices(&self, asset: &Asset, index: (usize, usize)) -> u64 {
        asset.meshes[index.0].primitives[index.1].indices.len() as u64 * 4 * u64::from(self.copies_of(index))
    }

    /// Bytes of the vertex streams.
    pub fn stream_bytes(&self, asset: &Asset) -> u64 {
        let streams =
            self.streams.iter().flat_map(|(index, streams)| streams.iter().map(move |stream| (*index, *stream)));
        streams.map(|(index, stream)| self.bytes_of_stream(asset, index, stream)).sum()
    }

    /// Bytes of the index lists.
    pub fn index_bytes(&self, asset: &Asset) -> u64 {
        self.streams.keys().map(|index| self.bytes_of_indices(asset, *index)).sum()
    }
}

/// Whether the primitive has what the stream is made from.
pub fn has_stream(primitive: &Primitive, stream: Stream) -> bool {
    let vertices = &primitive.vertices;
    match stream {
        Stream::Position | Stream::ShellDirection | Stream::ShellSide => true,
        Stream::Normal => !vertices.normals.is_empty(),
        Stream::Tangent => !vertices.tangents.is_empty(),
        Stream::Uv0 => !vertices.uv_sets.is_empty(),
        Stream::Uv1 => vertices.uv_sets.len() > 1,
        Stream::Color => !vertices.colors.is_empty(),
        Stream::Sway => false,
    }
}

fn index_of<T: PartialEq>(list: &mut Vec<T>, item: T) -> usize {
    if let Some(index) = list.iter().position(|existing| *existing == item) {
        return index;
    }
    list.push(item);
    list.len() - 1
}
