//! What one frame needs, decided before anything touches the device: draws, pipelines, vertex streams,
//! textures, passes, and what is left out and why.
//!
//! The plan is plain data made from scene and options alone, so it can be printed (`vair inspect`) and tested
//! without a GPU; the resources make exactly what it lists and nothing else.

use super::cloth::cloth_shader;
use super::left_out::{LeftOut, left_out};
use super::lit::Lit;
use super::map::{Map, StandIn, fur_maps, surface_maps};
use super::options::{FrameOptions, ShellSubmission};
use super::pipeline::{ComputeSpec, PipelineSpec, Target, shader};
use super::shadow::{ShadowPlan, casting_layers};
use super::stream::{Moment, Stream, inputs};
use super::table::Table;
use super::targets::Attachment;
use crate::asset::{Asset, Primitive, Sampler, Topology};
use crate::material::{AlphaMode, Fur, Standard};
use crate::scene::{Instance, LightLists, Scene, ShadowMaps, Side};
use std::collections::{BTreeMap, BTreeSet};

/// An image on the device: which one, and whether its bytes are sRGB-coded colour or data.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TextureUse {
    /// Index into the asset's images.
    pub image: usize,
    /// Colour is decoded when sampled, data never.
    pub srgb: bool,
}

/// A surface material as it is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct SurfaceUse {
    /// Index into the scene's materials.
    pub material: usize,
    /// The surface is the skin under a coat.
    pub under_fur: bool,
}

/// What is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawKind {
    /// A surface.
    Surface(SurfaceUse),
    /// A coat: that many shells of the material.
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
    /// Index into [`Plan::instances`].
    pub instance: usize,
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

/// One stream of one instance that the deform pass writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Deform {
    /// Index into [`Plan::instances`].
    pub instance: usize,
    /// Stream.
    pub stream: Stream,
    /// In this frame's pose or in the previous one's.
    pub moment: Moment,
    /// Index into [`Plan::compute_pipelines`].
    pub pipeline: usize,
}

/// A coat of one instance that the sway pass moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sway {
    /// Index into [`Plan::instances`].
    pub instance: usize,
    /// Index into [`Plan::compute_pipelines`].
    pub pipeline: usize,
}

/// A pass of the frame, in the order in which they run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Pass {
    /// Skinning and morphing.
    Deform,
    /// Strands that lag behind their roots.
    Sway,
    /// Depth, normal and motion.
    Guide,
    /// Ambient occlusion of a few slices a pixel.
    ScreenOcclusion,
    /// Their mean.
    ScreenOcclusionBlur,
    /// Nearest opaque surfaces, as lights see them.
    Shadow,
    /// First translucent surfaces, as lights see them.
    ShadowFront,
    /// Last ones.
    ShadowBack,
    /// How much light all of them let through.
    ShadowLayers,
    /// Opaque and masked surfaces; always there, since it clears the targets.
    Opaque,
    /// Shells.
    Fur,
    /// Blended surfaces and coats, far to near.
    Transparent,
    /// Lists of what blends over what is opaque.
    Transparency,
    /// HDR to picture.
    Tonemap,
}

impl Pass {
    /// All, in their order.
    pub const ALL: [Self; 14] = [
        Self::Deform,
        Self::Sway,
        Self::Guide,
        Self::ScreenOcclusion,
        Self::ScreenOcclusionBlur,
        Self::Shadow,
        Self::ShadowFront,
        Self::ShadowBack,
        Self::ShadowLayers,
        Self::Opaque,
        Self::Fur,
        Self::Transparent,
        Self::Transparency,
        Self::Tonemap,
    ];

    /// Name in labels, timings and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Deform => "deform",
            Self::Sway => "sway",
            Self::Guide => "guide",
            Self::ScreenOcclusion => "screen occlusion",
            Self::ScreenOcclusionBlur => "screen occlusion blur",
            Self::Shadow => "shadow",
            Self::ShadowFront => "shadow front",
            Self::ShadowBack => "shadow back",
            Self::ShadowLayers => "shadow layers",
            Self::Opaque => "opaque",
            Self::Fur => "fur",
            Self::Transparent => "transparent",
            Self::Transparency => "transparency",
            Self::Tonemap => "tonemap",
        }
    }
}

/// What one frame needs.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    /// Passes in order.
    pub passes: Vec<Pass>,
    /// Images to draw into, beside the picture itself.
    pub attachments: Vec<Attachment>,
    /// What the light of the frame takes.
    pub lit: Lit,
    /// Which lights reach which instance.
    pub lights: LightLists,
    /// What casts shadows into which maps.
    pub shadows: ShadowPlan,
    /// What stands in the scene, in the planned pose.
    pub instances: Vec<Instance>,
    /// Graphics pipelines, each once.
    pub pipelines: Vec<PipelineSpec>,
    /// Compute pipelines, each once.
    pub compute_pipelines: Vec<ComputeSpec>,
    /// Streams to move.
    pub deforms: Vec<Deform>,
    /// Coats whose strands lag behind.
    pub sways: Vec<Sway>,
    /// Draws of the guide pass.
    pub guide: Vec<Draw>,
    /// Draws of the opaque pass.
    pub opaque: Vec<Draw>,
    /// Draws of the fur pass.
    pub fur: Vec<Draw>,
    /// Draws of the transparent pass, unsorted.
    pub transparent: Vec<Draw>,
    /// The pipeline that composes lists of what blends; `None` where nothing is listed.
    pub composition: Option<PipelineSpec>,
    /// Vertex streams to upload, by (mesh, primitive).
    pub streams: BTreeMap<(usize, usize), BTreeSet<Stream>>,
    /// Primitives, by (mesh, primitive), whose vertices and indices are uploaded once a shell, and how often that is.
    pub copies: BTreeMap<(usize, usize), u32>,
    /// A pipeline reads a stream that its primitive has not: one value stands in for all vertices.
    pub has_absent_streams: bool,
    /// Images to upload.
    pub textures: BTreeSet<TextureUse>,
    /// Texels bound where a pipeline has a map that the material has not.
    pub stand_ins: BTreeSet<StandIn>,
    /// Look-up tables to upload, by name.
    pub tables: BTreeMap<&'static str, &'static Table>,
    /// Samplers of the textures, each once.
    pub samplers: Vec<Sampler>,
    /// What this frame does without.
    pub left_out: Vec<LeftOut>,
}

impl Plan {
    /// Decides what `options` of `scene` needs; `instances` are those of the pose to be shown, and lights reach them and
    /// cast shadows like that.
    pub fn new(
        scene: &Scene,
        instances: Vec<Instance>,
        lights: LightLists,
        maps: ShadowMaps,
        options: &FrameOptions,
    ) -> Self {
        let lit = Lit::new(scene, &instances, &maps, options);
        let shadows = ShadowPlan::new(maps, lit, options);
        let mut plan = Self { instances, lit, lights, shadows, ..Self::default() };
        for index in 0..plan.instances.len() {
            plan.add_instance(scene, index, options);
        }
        if options.everything {
            plan.add_spare_pipelines(scene, options);
        }
        if options.has_guide() {
            plan.add_guide(scene, options);
        }
        if !plan.is_lit() {
            // Nothing receives a shadow.
            (plan.lit, plan.shadows) = Default::default();
        } else if lit.shadows {
            plan.add_casters();
        }
        if plan.lit.shadows && !plan.lit.screen_occlusion {
            plan.stand_ins.insert(StandIn::White);
        }
        plan.add_passes(options);
        plan.left_out = left_out(&plan, scene, options);
        plan
    }

    fn add_instance(&mut self, scene: &Scene, index: usize, options: &FrameOptions) {
        let Instance { mesh, primitive, material, .. } = self.instances[index];
        let geometry = &scene.asset().meshes[mesh].primitives[primitive];
        let fur = scene.materials()[material].fur.as_ref().filter(|_| geometry.topology == Topology::Triangles);

        if let Some(fur) = fur.filter(|_| options.shells.submission == ShellSubmission::Duplicated) {
            self.copies.insert((mesh, primitive), options.layers_of_coat(fur.layers));
        }

        let surface = SurfaceUse { material, under_fur: fur.is_some() };
        let standard = scene.standard(surface.material, surface.under_fur);
        let cloth = scene.cloth(surface.material, surface.under_fur).map(cloth_shader);
        let spec = PipelineSpec::surface(&standard, cloth.as_ref(), geometry, self.lit, options);
        self.add_textures(scene, &spec, &surface_maps(&standard, cloth.as_ref()));
        let tables = cloth.into_iter().flat_map(|cloth| cloth.tables);
        self.tables.extend(tables.filter(|table| spec.binds_table(table)).map(|table| (table.name, table)));
        self.add_draw(scene, index, spec, DrawKind::Surface(surface), options);

        if let Some(fur) = fur {
            let layers = options.layers_of_coat(fur.layers);
            let spec = PipelineSpec::fur(fur, &scene.materials()[material].standard, geometry, self.lit, options);
            self.add_textures(scene, &spec, &fur_maps(fur, &scene.materials()[material].standard));
            self.add_draw(scene, index, spec, DrawKind::Fur { material, layers }, options);
            if options.sways(fur) {
                let pipeline = index_of(&mut self.compute_pipelines, ComputeSpec::sway());
                self.sways.push(Sway { instance: index, pipeline });
            }
        }
    }

    /// The streams that a pipeline reads of an instance, and those of them that a pass moves.
    fn add_streams(&mut self, scene: &Scene, index: usize, spec: &PipelineSpec, options: &FrameOptions) {
        let instance = &self.instances[index];
        let geometry = &scene.asset().meshes[instance.mesh].primitives[instance.primitive];
        let skin = instance.skin.is_some() && geometry.vertices.influences_per_vertex > 0;
        let morph = !geometry.morph_targets.is_empty();
        // Without joints and targets it moves nothing. It writes one copy of each vertex.
        let at_rest = options.everything && !self.copies.contains_key(&(instance.mesh, instance.primitive));
        let moved = skin || morph || at_rest;
        let streams = self.streams.entry((instance.mesh, instance.primitive)).or_default();
        for input in inputs(shader(&spec.vertex)) {
            if !has_stream(geometry, input.stream) {
                self.has_absent_streams |= input.stream != Stream::Sway;
                continue;
            }
            streams.insert(input.stream);
            let is_moved = moved && input.moment != Moment::Rest;
            let Some(kind) = input.stream.deform_kind().filter(|_| is_moved) else { continue };
            let same = |deform: &Deform| {
                (deform.instance, deform.stream, deform.moment) == (index, input.stream, input.moment)
            };
            if self.deforms.iter().any(same) {
                continue;
            }
            let pipeline = index_of(&mut self.compute_pipelines, ComputeSpec::deform(skin, morph || !skin, kind));
            self.deforms.push(Deform { instance: index, stream: input.stream, moment: input.moment, pipeline });
        }
    }

    /// What is drawn, once more for its depth, normal and motion.
    fn add_guide(&mut self, scene: &Scene, options: &FrameOptions) {
        for draw in [&self.opaque[..], &self.fur, &self.transparent].concat() {
            let Some(spec) = self.pipelines[draw.pipeline].guide(options.aovs.motion) else { continue };
            self.add_streams(scene, draw.instance, &spec, options);
            let pipeline = index_of(&mut self.pipelines, spec);
            self.guide.push(Draw { pipeline, ..draw });
        }
        self.guide.sort_by_key(|draw| draw.pipeline);
    }

    fn add_draw(&mut self, scene: &Scene, index: usize, spec: PipelineSpec, kind: DrawKind, options: &FrameOptions) {
        self.add_streams(scene, index, &spec, options);
        let instance = &self.instances[index];
        let geometry = &scene.asset().meshes[instance.mesh].primitives[instance.primitive];
        let list = match kind {
            _ if spec.blend => &mut self.transparent,
            DrawKind::Surface(_) => &mut self.opaque,
            DrawKind::Fur { .. } => &mut self.fur,
        };
        let is_two_sided = match kind {
            DrawKind::Surface(surface) => scene.materials()[surface.material].standard.double_sided,
            // Shells that face away carry the strands that stand out over the outline.
            DrawKind::Fur { .. } => true,
        };
        let faces: &[Faces] = match is_two_sided {
            // Lists take both sides at once, in whatever order.
            true if spec.blend && !spec.lists() && geometry.topology == Topology::Triangles => {
                &[Faces::One(Side::Back), Faces::One(Side::Front)]
            }
            true => &[Faces::Both],
            false => &[Faces::One(Side::Front)],
        };
        let pipeline = index_of(&mut self.pipelines, spec);
        list.extend(faces.iter().map(|&faces| Draw { instance: index, pipeline, kind, faces }));
    }

    /// What is drawn casts a shadow, too; all faces of it, as a sheet has no thickness to tell its sides apart by.
    fn add_casters(&mut self) {
        let shown = [&self.opaque[..], &self.fur, &self.transparent].concat();
        for draw in shown {
            let shown = self.pipelines[draw.pipeline].clone();
            // Of two sides that blend one after the other, one stands for both.
            if shown.topology != Topology::Triangles || shown.blend && draw.faces == Faces::One(Side::Back) {
                continue;
            }
            let kind = match draw.kind {
                DrawKind::Fur { material, layers } => DrawKind::Fur { material, layers: casting_layers(layers) },
                surface => surface,
            };
            let is_translucent = shown.casts_in_part();
            let targets = match is_translucent {
                true => &[Target::ShadowFront, Target::ShadowBack, Target::ShadowLayers][..],
                false => &[Target::ShadowFront],
            };
            for &target in targets {
                let pipeline = index_of(&mut self.pipelines, shown.casting(target));
                let list = match target {
                    Target::ShadowBack => &mut self.shadows.back,
                    Target::ShadowLayers => &mut self.shadows.layers,
                    _ if is_translucent => &mut self.shadows.front,
                    _ => &mut self.shadows.opaque,
                };
                list.push(Draw { pipeline, kind, faces: Faces::Both, ..draw });
            }
        }
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
                    self.stand_ins.insert(map.stand_in);
                }
            }
        }
    }

    /// What a renderer without a plan has ready whatever it draws: a pipeline for coats and one that blends.
    fn add_spare_pipelines(&mut self, scene: &Scene, options: &FrameOptions) {
        let geometry = |instance: &Instance| &scene.asset().meshes[instance.mesh].primitives[instance.primitive];
        let is_solid = |instance: &&Instance| geometry(instance).topology == Topology::Triangles;
        let Some(instance) = self.instances.iter().find(is_solid) else { return };
        let standard = scene.standard(instance.material, false);
        if !self.has_fur() {
            let spec = PipelineSpec::fur(&Fur::default(), &standard, geometry(instance), self.lit, options);
            self.pipelines.push(spec);
        }
        if !self.pipelines.iter().any(|spec| spec.blend) {
            let blending = Standard { alpha_mode: AlphaMode::Blend, ..standard.into_owned() };
            self.pipelines.push(PipelineSpec::surface(&blending, None, geometry(instance), self.lit, options));
        }
    }

    /// Whether a coat is drawn, in whatever pass.
    pub fn has_fur(&self) -> bool {
        self.fur.iter().chain(&self.transparent).any(|draw| matches!(draw.kind, DrawKind::Fur { .. }))
    }

    /// Whether any surface or coat is lit.
    pub fn is_lit(&self) -> bool {
        let shows_light = |spec: &PipelineSpec| spec.target == Target::Color && !spec.fragment.contains("UNLIT");
        self.pipelines.iter().any(shows_light)
    }

    /// Whether any shader asks how lobes look into the environment.
    pub fn binds_lobes(&self) -> bool {
        self.pipelines.iter().any(|spec| spec.bindings().contains("lobe_table"))
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

    fn add_passes(&mut self, options: &FrameOptions) {
        let lists = self.pipelines.iter().any(PipelineSpec::lists);
        self.composition = lists.then(|| PipelineSpec::composition(options));
        self.attachments = Attachment::all(options, lists);
        // One pipeline after another: state changes cost more than order saves among opaque surfaces.
        self.opaque.sort_by_key(|draw| draw.pipeline);
        for (pass, wanted) in [
            (Pass::Deform, !self.deforms.is_empty()),
            (Pass::Sway, !self.sways.is_empty()),
            (Pass::Guide, options.has_guide()),
            (Pass::ScreenOcclusion, options.screen_occlusion.is_some()),
            (Pass::ScreenOcclusionBlur, options.screen_occlusion.is_some()),
            (Pass::Shadow, self.lit.shadows),
            (Pass::ShadowFront, self.lit.translucent_shadows),
            (Pass::ShadowBack, self.lit.translucent_shadows),
            (Pass::ShadowLayers, self.lit.translucent_shadows),
            (Pass::Opaque, true),
            (Pass::Fur, !self.fur.is_empty()),
            (Pass::Transparent, !self.transparent.is_empty()),
            (Pass::Transparency, self.composition.is_some()),
            (Pass::Tonemap, true),
        ] {
            let is_shadow = matches!(pass, Pass::Shadow | Pass::ShadowFront | Pass::ShadowBack | Pass::ShadowLayers);
            if wanted || options.everything && (!is_shadow || self.lit.shadows) {
                self.passes.push(pass);
            }
        }
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
