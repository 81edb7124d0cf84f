//! A scene on the device: what it keeps, and what each frame writes for it.

use super::content::Content;
use super::dynamics::strand_dynamics_draw;
use super::frame_values::{FrameInput, FrameValues};
use super::material::Materials;
use super::motion::{DynamicsStep, Motion};
use super::stream::{Input, StreamPose, inputs};
use crate::gpu::{BindGroup, Buffer, Encoder, GpuError, Image, ImageUse, Pipeline, Resource, Sampler, TransientSlice};
use crate::render::light::{EnvironmentMaps, EnvironmentQuality, LobeTable, ShadowAtlas};
use crate::render::pass::Pass;
use crate::render::pass::draw::{FRAME_SET, OBJECT_SET};
use crate::render::pass::order::FarToNear;
use crate::render::plan::{Draw, DrawKind, Plan, Staging};
use crate::render::renderer::Shared;
use crate::render::surface::Fallback;
use crate::render::view::View;
use crate::scene::{EnvironmentLight, Part, Scene};
use crate::shader::layout::{ShadowSource, StrandDynamicsDraw};
use glam::Vec3;
use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

/// What is drawn, on the device.
#[derive(Clone, Copy)]
pub(crate) struct DrawnScene<'a> {
    /// Meshes and materials.
    pub scene: &'a Scene,
    /// Where things stand, and the plan.
    pub staging: &'a Staging,
    /// What the scene keeps on the device, and what this frame wrote.
    pub resources: &'a SceneResources,
}

/// What a frame asks of a scene on the device, beside its staging.
pub(crate) struct FrameRequest<'a> {
    /// Cameras; the first one decides where shadow maps are fine.
    pub views: &'a [View],
    /// The environment.
    pub environment: &'a EnvironmentLight,
    /// How finely it is prepared.
    pub quality: EnvironmentQuality,
    /// The host's own maps of it.
    pub host_environment: Option<&'a Arc<EnvironmentMaps>>,
    /// The host's own shadow maps.
    pub host_shadows: Option<HostShadowAtlas<'a>>,
    /// Light comes from the environment's mean, too, where nothing is lit.
    pub shows_environment_mean: bool,
    /// Screen-space occlusion.
    pub ssao: Option<&'a Image>,
    /// How strands have moved on.
    pub step: DynamicsStep,
}

/// Shadow maps of the host's, in the place of the atlas.
#[derive(Clone, Copy)]
pub(crate) struct HostShadowAtlas<'a> {
    /// Reversed depth of the nearest opaque surfaces.
    pub image: &'a Image,
    /// Of it.
    pub sampler: &'a Sampler,
    /// Tiles, one a shadow map of the staging.
    pub sources: &'a [ShadowSource],
}

/// A scene on the device.
#[derive(Default)]
pub(crate) struct SceneResources {
    content: Content,
    materials: Materials,
    motion: Motion,
    values: FrameValues,
    pipelines: Vec<Arc<Pipeline>>,
    compute: Vec<Arc<Pipeline>>,
    /// Vertex inputs of each pipeline.
    inputs: Vec<Vec<Input>>,
    frame_groups: SharedGroups,
    object_groups: SharedGroups,
    environment: Option<Arc<EnvironmentMaps>>,
    lobes: Option<Arc<LobeTable>>,
    atlas: Option<ShadowAtlas>,
    absent: Option<Arc<Buffer>>,
    /// What blends, from far to near, by view.
    sorted: Vec<FarToNear>,
    step: DynamicsStep,
    views: Vec<View>,
    /// Scene, plan and materials that it was made for; `None` where a frame has failed half-way, and may have left things
    /// without their contents.
    made_for: Option<(u64, u64, u64)>,
    /// Images that the groups were bound with.
    bound: Option<BoundImages>,
}

/// Images that change now and then, by their identity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct BoundImages {
    environment: Option<usize>,
    lobes: Option<usize>,
    shadows: Option<usize>,
    ssao: Option<usize>,
}

/// Groups that all objects share, by what pipelines name; most have the same.
#[derive(Default)]
struct SharedGroups {
    groups: Vec<BindGroup>,
    /// Of each pipeline.
    of: Vec<usize>,
}

impl SharedGroups {
    fn bind(
        &mut self,
        shared: &Shared,
        plan: &Plan,
        pipelines: &[Arc<Pipeline>],
        set: u32,
        name: &str,
        offered: &[(&str, Resource<'_>)],
    ) -> Result<(), GpuError> {
        let mut known: HashMap<BTreeSet<&'static str>, usize> = HashMap::new();
        self.groups.clear();
        self.of.clear();
        for (spec, pipeline) in plan.pipelines.iter().zip(pipelines) {
            let bindings = spec.bindings_of(set);
            let index = match known.get(&bindings) {
                Some(index) => *index,
                None => {
                    self.groups.push(shared.gpu.bind_group(pipeline, set, name, offered)?);
                    known.insert(bindings, self.groups.len() - 1);
                    self.groups.len() - 1
                }
            };
            self.of.push(index);
        }
        Ok(())
    }

    fn of(&self, pipeline: usize) -> &BindGroup {
        &self.groups[self.of[pipeline]]
    }
}

impl SceneResources {
    /// Makes what the plan lists and is not there yet, and writes what the frame reads. Until [`Self::keep`], nothing counts
    /// as made.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub fn prepare(
        &mut self,
        shared: &mut Shared,
        encoder: &mut Encoder,
        scene: &Scene,
        staging: &Staging,
        request: &FrameRequest,
    ) -> Result<(), GpuError> {
        let plan = &staging.plan;
        let wanted = (scene.id(), staging.plan_revision, scene.revision());
        let made_for = self.made_for.take();
        if made_for.is_none_or(|(id, ..)| id != scene.id()) {
            self.forget();
        }
        let is_planned = made_for.is_some_and(|(id, plan, _)| (id, plan) == (wanted.0, wanted.1));
        let mut is_stale = !is_planned;
        if !is_planned {
            self.make(shared, encoder, scene, staging)?;
        }
        if made_for != Some(wanted) {
            is_stale |= self.materials.write_blocks(shared, scene, plan)?;
        }
        self.prepare_light(shared, plan, request)?;
        let input = FrameInput {
            scene,
            staging,
            views: request.views,
            environment: request.environment,
            maps: self.environment.as_deref(),
            atlas: self.atlas.as_ref(),
            host_sources: request.host_shadows.map(|shadows| shadows.sources),
        };
        is_stale |= self.values.write(shared, &input)?;
        let bound = Some(self.images(request));
        is_stale |= self.bound != bound;
        if is_stale {
            self.bind(shared, scene, staging, request)?;
            self.bound = bound;
        }
        self.sort(scene, staging, request.views);
        self.step = request.step;
        self.views.clear();
        self.views.extend_from_slice(request.views);
        let slices = self.values.slice().into_iter().chain(self.materials.slices());
        slices.for_each(|slice: &TransientSlice| encoder.keep_slice(slice));
        self.made_for = Some(wanted);
        Ok(())
    }

    /// Nothing counts as made: the next frame makes all of it again.
    pub fn forget(&mut self) {
        *self = Self { sorted: std::mem::take(&mut self.sorted), ..Self::default() };
    }

    /// The frame's commands are complete.
    pub fn keep(&mut self) {
        self.motion.keep();
    }

    /// The frame failed: what it should have made may be without its contents.
    pub fn fail(&mut self) {
        self.made_for = None;
    }

    /// The content, to be edited; groups are bound anew.
    pub fn content_mut(&mut self) -> &mut Content {
        self.bound = None;
        self.made_for = self.made_for.map(|(id, _, revision)| (id, u64::MAX, revision));
        &mut self.content
    }

    fn make(
        &mut self,
        shared: &mut Shared,
        encoder: &mut Encoder,
        scene: &Scene,
        staging: &Staging,
    ) -> Result<(), GpuError> {
        let plan = &staging.plan;
        shared.defaults.prepare(plan)?;
        self.absent = shared.defaults.absent().cloned();
        let mut upload = shared.gpu.upload();
        self.content.prepare(&shared.gpu, &mut upload, scene, &staging.instances, plan)?;
        upload.record_into(encoder)?;
        self.motion.prepare(&shared.gpu, scene, staging)?;
        self.pipelines.clear();
        self.compute.clear();
        for spec in &plan.pipelines {
            self.pipelines.push(shared.pipelines.graphics(spec)?);
        }
        for spec in &plan.compute_pipelines {
            self.compute.push(shared.pipelines.compute(spec)?);
        }
        self.inputs = plan.pipelines.iter().map(|spec| inputs(spec.vertex.shader())).collect();
        self.values.replan(plan);
        Ok(())
    }

    /// Makes what lights the frame, if the last one had others; the old ones go first, as two need not fit at once.
    fn prepare_light(&mut self, shared: &mut Shared, plan: &Plan, request: &FrameRequest) -> Result<(), GpuError> {
        let EnvironmentLight { map, .. } = request.environment;
        let is_lit = plan.is_lit() || request.shows_environment_mean;
        match request.host_environment {
            Some(host) => self.environment = Some(host.clone()),
            None if is_lit => {
                let is_made = |maps: &Arc<EnvironmentMaps>| maps.are_of(map, request.quality);
                if !self.environment.as_ref().is_some_and(is_made) {
                    self.environment = None;
                    self.environment = Some(shared.environment(map, request.quality)?);
                }
            }
            None => self.environment = None,
        }
        if plan.binds_lobes() && !self.lobes.as_ref().is_some_and(|lobes| lobes.is_of(&request.quality)) {
            self.lobes = Some(shared.lobes(&request.quality)?);
        }
        if request.host_shadows.is_some() || !plan.shadows.is_bound {
            self.atlas = None;
        } else if !self.atlas.as_ref().is_some_and(|atlas| atlas.fits(&plan.shadows)) {
            self.atlas = None;
            self.atlas = Some(ShadowAtlas::new(&shared.gpu, &plan.shadows)?);
        }
        Ok(())
    }

    fn images(&self, request: &FrameRequest) -> BoundImages {
        let shadows = match request.host_shadows {
            Some(host) => Some(host.image.place()),
            None => self.atlas.as_ref().and_then(|atlas| atlas.images.first()).map(Image::place),
        };
        BoundImages {
            environment: self.environment.as_ref().map(|maps| maps.map.place()),
            lobes: self.lobes.as_ref().map(|lobes| lobes.map.place()),
            shadows,
            ssao: request.ssao.map(Image::place),
        }
    }

    fn bind(
        &mut self,
        shared: &Shared,
        scene: &Scene,
        staging: &Staging,
        request: &FrameRequest,
    ) -> Result<(), GpuError> {
        let Some(values) = self.values.slice().map(TransientSlice::buffer) else { return Ok(()) };
        let plan = &staging.plan;
        let lists = ["FrameBlock", "PreviousFrameBlock", "LightList", "ShadowList", "ObjectList", "PreviousObjectList"];
        let mut offered: Vec<_> = lists.into_iter().map(|name| (name, Resource::Buffer(values))).collect();
        if let Some(environment) = &self.environment {
            offered.push(("environment_map", Resource::Texture(&environment.map)));
            offered.push(("environment_sampler", Resource::Sampler(&environment.sampler)));
        }
        if let Some(lobes) = &self.lobes {
            offered.push(("lobe_table", Resource::Texture(&lobes.map)));
            offered.push(("lobe_table_sampler", Resource::Sampler(&lobes.sampler)));
        }
        // Where shadows alone hide light, it is bound and not read.
        let occlusion = request.ssao.or(shared.defaults.fallback(Fallback::White));
        offered.extend(occlusion.map(|image| ("screen_occlusion_map", Resource::Texture(image))));
        match (request.host_shadows, &self.atlas) {
            (Some(host), _) => {
                let names = ShadowAtlas::NAMES.into_iter();
                offered.extend(names.map(|name| (name, Resource::Texture(host.image))));
                offered.push(("shadow_sampler", Resource::Sampler(host.sampler)));
            }
            (None, Some(atlas)) => {
                offered.extend(atlas.named().map(|(name, image)| (name, Resource::Texture(image))));
                offered.push(("shadow_sampler", Resource::Sampler(&atlas.sampler)));
            }
            (None, None) => {}
        }
        self.frame_groups.bind(shared, plan, &self.pipelines, FRAME_SET, "frame", &offered)?;
        self.object_groups.bind(shared, plan, &self.pipelines, OBJECT_SET, "objects", &offered)?;
        self.materials.bind(shared, scene, &self.content, plan, &self.pipelines, values)?;
        self.motion.bind(&shared.gpu, &self.content, staging, &self.compute, values)
    }

    /// What blends, as each view sees it.
    fn sort(&mut self, scene: &Scene, staging: &Staging, views: &[View]) {
        let plan = &staging.plan;
        let pass = if plan.draws_of(Pass::OitBuild).is_empty() { Pass::Transparent } else { Pass::OitBuild };
        self.sorted.resize_with(views.len(), FarToNear::default);
        for (sorted, view) in self.sorted.iter_mut().zip(views) {
            sorted.sort(plan.draws_of(pass), scene, staging, &view.camera());
        }
    }

    /// A pipeline of the plan.
    pub fn pipeline(&self, index: usize) -> &Pipeline {
        &self.pipelines[index]
    }

    /// A compute pipeline of the plan.
    pub fn compute_pipeline(&self, index: usize) -> &Pipeline {
        &self.compute[index]
    }

    /// Vertex inputs of a pipeline of the plan.
    pub fn inputs(&self, pipeline: usize) -> &[Input] {
        &self.inputs[pipeline]
    }

    /// View and lights, with where the blocks of that view start.
    pub fn frame_group(&self, pipeline: usize, view: usize) -> (&BindGroup, [u64; 2]) {
        (self.frame_groups.of(pipeline), self.values.view(view))
    }

    /// Where objects stand.
    pub fn object_group(&self, pipeline: usize) -> &BindGroup {
        self.object_groups.of(pipeline)
    }

    /// The material of a draw, with where its blocks start.
    pub fn material_group(&self, draw: &Draw) -> (&BindGroup, [u64; 2]) {
        let offsets = match draw.kind {
            DrawKind::Surface(surface) => self.materials.offsets(surface),
            DrawKind::Fur { layers, .. } => [self.values.fur(draw.part, layers), 0],
        };
        (self.materials.group(draw), offsets)
    }

    /// Buffer, offset and stride of a vertex input, bytes; `None` where the pipeline must do without.
    pub fn stream(&self, staging: &Staging, part: Part, input: Input) -> Option<(&Buffer, u64, u64)> {
        let moved = self.motion.moved(staging, part, input.stream, input.pose);
        let rest = || self.content.streams.get(&((part.mesh, part.primitive), input.stream));
        match (moved.or_else(rest), &self.absent) {
            (Some(stream), _) => Some((stream, 0, u64::from(input.stream.stride()))),
            (None, Some(absent)) => Some((absent, input.stream.absent_offset(), 0)),
            (None, None) => None,
        }
    }

    /// Indices of a part.
    pub fn indices(&self, part: Part) -> &Buffer {
        &self.content.indices[&(part.mesh, part.primitive)]
    }

    /// Entries of an instance, of it in the previous frame, and of a light of the lists.
    pub fn entries(&self, instance: usize, light: u32) -> [u32; 3] {
        self.values.entries(instance, light)
    }

    /// The view that sees what a shadow map shows.
    pub fn view_of_map(&self, map: usize) -> usize {
        self.values.view_of_map(map)
    }

    /// Whether a view may show any of a part.
    pub fn sees(&self, view: usize, staging: &Staging, part: usize) -> bool {
        staging.options().everything || self.values.sees(view, staging.spheres[part])
    }

    /// What blends, from far to near, as a view sees it.
    pub fn far_to_near(&self, view: usize) -> &[Draw] {
        self.sorted.get(view).map_or(&[], FarToNear::draws)
    }

    /// Shadow maps, where lights cast any.
    pub fn shadow_atlas(&self) -> Option<&ShadowAtlas> {
        self.atlas.as_ref()
    }

    /// Brings the shadow maps into the use in which a host's pass finds them: there it would be too late.
    pub fn make_shadows_readable(&self, encoder: &mut Encoder) {
        for image in self.atlas.iter().flat_map(|atlas| &atlas.images) {
            encoder.transition(image, ImageUse::Sampled);
        }
    }

    /// A view of the frame.
    pub fn view(&self, view: usize) -> Option<&View> {
        self.views.get(view)
    }

    /// Linear RGB mean of the environment's radiance; 0 where nothing is lit.
    pub fn mean_radiance(&self) -> Vec3 {
        self.values.mean_radiance()
    }

    /// The group of a dispatch of skinning, and the first joint and morph weight that it reads.
    pub fn deform(&self, index: usize, instance: usize, pose: StreamPose) -> (&BindGroup, [u32; 2]) {
        (self.motion.skinning_group(index), self.values.pose(instance, pose))
    }

    /// The group of a dispatch of strand dynamics.
    pub fn strand_dynamics_group(&self, index: usize) -> &BindGroup {
        self.motion.dynamics_group(index)
    }

    /// The values of a dispatch of strand dynamics.
    pub fn strand_dynamics_draw(&self, scene: &Scene, staging: &Staging, index: usize) -> StrandDynamicsDraw {
        let part = staging.plan.parts[staging.plan.dynamics[index].part];
        let is_reset = self.step.is_reset || self.motion.is_fresh(index);
        let instance = &staging.instances[part.instance];
        let vertices = scene.asset().meshes[part.mesh].primitives[part.primitive].vertices.positions.len();
        let fur = scene.materials()[part.material].fur.clone().unwrap_or_default();
        let step_s = if is_reset { 0.0 } else { self.step.step_s };
        strand_dynamics_draw(&fur, instance, staging.sizes[part.instance], vertices as u32, is_reset, step_s)
    }
}
