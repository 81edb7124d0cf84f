//! What one frame needs, decided before anything touches the device: draws, pipelines, vertex streams,
//! textures, passes, and what is left out and why.
//!
//! The plan is plain data made from scene and options alone, so it can be printed (`vair inspect`) and tested
//! without a GPU; the resources make exactly what it lists and nothing else.

use super::options::FrameOptions;
use super::pipeline::{ComputeSpec, PipelineSpec, shader};
use super::stream::{Stream, inputs};
use crate::asset::{Asset, Primitive, TextureRef, Topology};
use crate::material::{Fur, Standard};
use crate::scene::{Instance, Scene};
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
}

/// One stream of one instance that the deform pass writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Deform {
    /// Index into [`Plan::instances`].
    pub instance: usize,
    /// Stream.
    pub stream: Stream,
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
    /// Opaque and masked surfaces; always there, since it clears the targets.
    Opaque,
    /// Shells.
    Fur,
    /// Blended surfaces and coats, far to near.
    Transparent,
    /// HDR to picture.
    Tonemap,
}

impl Pass {
    /// Name in labels, timings and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Deform => "deform",
            Self::Sway => "sway",
            Self::Opaque => "opaque",
            Self::Fur => "fur",
            Self::Transparent => "transparent",
            Self::Tonemap => "tonemap",
        }
    }
}

/// Something that a frame could have and this one has not.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOut {
    /// What.
    pub what: String,
    /// Why.
    pub why: String,
}

/// What one frame needs.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    /// Passes in order.
    pub passes: Vec<Pass>,
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
    /// Draws of the opaque pass.
    pub opaque: Vec<Draw>,
    /// Draws of the fur pass.
    pub fur: Vec<Draw>,
    /// Draws of the transparent pass, unsorted.
    pub transparent: Vec<Draw>,
    /// Vertex streams to upload, by (mesh, primitive).
    pub streams: BTreeMap<(usize, usize), BTreeSet<Stream>>,
    /// Images to upload.
    pub textures: BTreeSet<TextureUse>,
    /// What this frame does without.
    pub left_out: Vec<LeftOut>,
}

impl Plan {
    /// Decides what `options` of `scene` needs; `instances` are those of the pose to be shown.
    pub fn new(scene: &Scene, instances: Vec<Instance>, options: &FrameOptions) -> Self {
        let mut plan = Self { instances, ..Self::default() };
        for index in 0..plan.instances.len() {
            plan.add_instance(scene, index, options);
        }
        plan.add_passes();
        plan.explain(scene, options);
        plan
    }

    fn add_instance(&mut self, scene: &Scene, index: usize, options: &FrameOptions) {
        let Instance { mesh, primitive, material, .. } = self.instances[index];
        let geometry = &scene.asset().meshes[mesh].primitives[primitive];
        let fur = scene.materials()[material].fur.as_ref().filter(|_| geometry.topology == Topology::Triangles);

        let surface = SurfaceUse { material, under_fur: fur.is_some() };
        let standard = scene.standard(surface.material, surface.under_fur);
        let spec = PipelineSpec::surface(&standard, geometry, options);
        self.add_textures(scene, &spec, &surface_maps(&standard));
        self.add_draw(scene, index, spec, DrawKind::Surface(surface));

        if let Some(fur) = fur {
            let layers = options.layers_of_coat(fur.layers);
            let spec = PipelineSpec::fur(fur, &scene.materials()[material].standard, geometry, options);
            self.add_textures(scene, &spec, &fur_maps(fur, &scene.materials()[material].standard));
            self.add_draw(scene, index, spec, DrawKind::Fur { material, layers });
            if options.sways(fur) {
                let pipeline = index_of(&mut self.compute_pipelines, ComputeSpec::sway());
                self.sways.push(Sway { instance: index, pipeline });
            }
        }
    }

    fn add_draw(&mut self, scene: &Scene, index: usize, spec: PipelineSpec, kind: DrawKind) {
        let instance = &self.instances[index];
        let geometry = &scene.asset().meshes[instance.mesh].primitives[instance.primitive];
        let skin = instance.skin.is_some() && geometry.vertices.influences_per_vertex > 0;
        let morph = !geometry.morph_targets.is_empty();
        let streams = self.streams.entry((instance.mesh, instance.primitive)).or_default();
        for input in inputs(shader(&spec.vertex)).into_iter().filter(|input| has_stream(geometry, input.stream)) {
            streams.insert(input.stream);
            let Some(kind) = input.stream.deform_kind().filter(|_| !input.rest && (skin || morph)) else { continue };
            if self.deforms.iter().any(|deform| deform.instance == index && deform.stream == input.stream) {
                continue;
            }
            let pipeline = index_of(&mut self.compute_pipelines, ComputeSpec::deform(skin, morph, kind));
            self.deforms.push(Deform { instance: index, stream: input.stream, pipeline });
        }
        let list = match kind {
            _ if spec.blend => &mut self.transparent,
            DrawKind::Surface(_) => &mut self.opaque,
            DrawKind::Fur { .. } => &mut self.fur,
        };
        list.push(Draw { instance: index, pipeline: index_of(&mut self.pipelines, spec), kind });
    }

    /// Only what the pipeline samples: a map without UVs, tangents or light to show it stays off the device.
    fn add_textures(&mut self, scene: &Scene, spec: &PipelineSpec, maps: &[Map]) {
        for map in maps.iter().filter(|map| spec.samples_map(map.name)) {
            if let Some(texture) = map.texture {
                self.textures
                    .insert(TextureUse { image: scene.asset().textures[texture.texture].image, srgb: map.srgb });
            }
        }
    }

    /// Bytes of the vertex streams.
    pub fn stream_bytes(&self, asset: &Asset) -> u64 {
        let bytes = |(&(mesh, primitive), streams): (&(usize, usize), &BTreeSet<Stream>)| {
            let vertices = asset.meshes[mesh].primitives[primitive].vertices.positions.len() as u64;
            streams.iter().map(|stream| vertices * u64::from(stream.stride())).sum::<u64>()
        };
        self.streams.iter().map(bytes).sum()
    }

    /// Bytes of the index lists.
    pub fn index_bytes(&self, asset: &Asset) -> u64 {
        self.streams
            .keys()
            .map(|&(mesh, primitive)| asset.meshes[mesh].primitives[primitive].indices.len() as u64 * 4)
            .sum()
    }

    fn add_passes(&mut self) {
        // One pipeline after another: state changes cost more than order saves among opaque surfaces.
        self.opaque.sort_by_key(|draw| draw.pipeline);
        for (pass, wanted) in [
            (Pass::Deform, !self.deforms.is_empty()),
            (Pass::Sway, !self.sways.is_empty()),
            (Pass::Opaque, true),
            (Pass::Fur, !self.fur.is_empty()),
            (Pass::Transparent, !self.transparent.is_empty()),
            (Pass::Tonemap, true),
        ] {
            if wanted {
                self.passes.push(pass);
            }
        }
    }

    fn explain(&mut self, scene: &Scene, options: &FrameOptions) {
        let lit = self.pipelines.iter().any(|spec| !spec.fragment.contains("UNLIT"));
        let mut reasons = vec![
            (self.deforms.is_empty(), "deform pass", "nothing in the scene is skinned or morphed"),
            (self.sways.is_empty(), "sway pass", "no animation moves a coat that has inertia"),
            (
                self.fur.is_empty(),
                "fur pass and pipeline",
                "no triangles have a material with fur that cuts out or covers",
            ),
            (self.transparent.is_empty(), "transparent pass and pipeline", "no material blends"),
            (!lit, "light list", "nothing that is drawn is lit"),
            (options.msaa == 1, "multisampled targets and resolve", "one sample a pixel was asked for"),
            (self.textures.is_empty(), "textures and samplers", "no pipeline in use samples a map"),
        ];
        reasons.push((true, "look-up tables", "the standard material's albedo is a closed fit"));
        reasons.push((true, "shadow maps", "lights cast no shadows yet"));
        reasons.push((true, "environment maps", "the surroundings are a constant radiance"));
        self.left_out = reasons
            .into_iter()
            .filter(|(left_out, ..)| *left_out)
            .map(|(_, what, why)| LeftOut { what: what.to_owned(), why: why.to_owned() })
            .collect();

        let unused = unused_streams(scene, &self.streams);
        if !unused.is_empty() {
            let what = format!("vertex streams: {}", unused.join(", "));
            self.left_out.push(LeftOut { what, why: "no pipeline in use reads them".to_owned() });
        }
        let used: BTreeSet<usize> = self.textures.iter().map(|texture| texture.image).collect();
        let images = scene.asset().images.len().saturating_sub(used.len());
        if images > 0 {
            let what = format!("{images} of {} images", scene.asset().images.len());
            self.left_out.push(LeftOut { what, why: "no pipeline in use samples them".to_owned() });
        }
    }
}

/// A map of a material: its shaders call the texture `<name>_map` and the sampler `<name>_sampler`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Map {
    /// Stem of the GLSL names.
    pub name: &'static str,
    /// What the material says.
    pub texture: Option<TextureRef>,
    /// Colour, which is decoded when sampled; everything else is data and never is.
    pub srgb: bool,
}

impl Map {
    fn color(name: &'static str, texture: Option<TextureRef>) -> Self {
        Self { name, texture, srgb: true }
    }

    fn data(name: &'static str, texture: Option<TextureRef>) -> Self {
        Self { name, texture, srgb: false }
    }
}

/// Maps of a surface.
pub fn surface_maps(standard: &Standard) -> [Map; 7] {
    [
        Map::color("base_color", standard.base_color_texture),
        Map::data("metallic_roughness", standard.metallic_roughness_texture),
        Map::data("occlusion", standard.occlusion_texture),
        Map::color("emissive", standard.emissive_texture),
        Map::data("normal", standard.normal_texture),
        Map::color("detail_albedo", standard.detail_albedo_texture),
        Map::data("detail_normal", standard.detail_normal_texture),
    ]
}

/// Maps of a coat over a surface, whose base colour texture it takes where it has none of its own.
pub fn fur_maps(fur: &Fur, standard: &Standard) -> [Map; 5] {
    [
        Map::data("height", fur.height_map),
        Map::data("distribution", fur.distribution_map),
        Map::color("base_color", fur.color_over(standard).1),
        Map::data("spot", fur.spot_map),
        Map::data("comb", fur.comb_map),
    ]
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

/// Names of streams that primitives in use have and no pipeline reads.
fn unused_streams(scene: &Scene, used: &BTreeMap<(usize, usize), BTreeSet<Stream>>) -> Vec<String> {
    let all = [Stream::Normal, Stream::Tangent, Stream::Uv0, Stream::Uv1, Stream::Color];
    all.iter()
        .filter(|stream| {
            let mut having = used.iter().filter(|((mesh, primitive), _)| {
                has_stream(&scene.asset().meshes[*mesh].primitives[*primitive], **stream)
            });
            having.clone().next().is_some() && having.all(|(_, streams)| !streams.contains(stream))
        })
        .map(|stream| format!("{stream:?}").to_lowercase())
        .collect()
}

fn index_of<T: PartialEq>(list: &mut Vec<T>, item: T) -> usize {
    if let Some(index) = list.iter().position(|existing| *existing == item) {
        return index;
    }
    list.push(item);
    list.len() - 1
}
