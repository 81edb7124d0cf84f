//! What a frame reads and no other: views, lights, places, fur, poses, all in one slice of host-visible memory.
//!
//! Lists are read by their place in the whole buffer: the slice's parts start at multiples of their entries, and draws name
//! entries counted from the buffer's start. So the groups that bind the buffer stay while values move on in it.

use super::dynamics::force_in_world;
use super::stream::StreamPose;
use crate::gpu::{GpuError, TransientSlice};
use crate::math::normal_matrix;
use crate::render::fur::fur_uniforms;
use crate::render::light::{EnvironmentMaps, SH_COEFFICIENTS, ShadowAtlas, first_shadows, light_source};
use crate::render::plan::{DrawKind, Plan, Staging};
use crate::render::renderer::Shared;
use crate::render::view::{Frustum, View};
use crate::scene::{EnvironmentLight, Instance, Scene, ShadowMap, Size};
use crate::shader::layout::{FrameUniforms, FurUniforms, LightSource, ObjectUniforms, PreviousFrame, ShadowSource};
use bytemuck::NoUninit;
use glam::{Mat4, Vec3};
use std::collections::{BTreeSet, HashMap};

/// Where the values of a frame lie.
#[derive(Default)]
pub struct FrameValues {
    slice: Option<TransientSlice>,
    /// Offsets of the views' blocks: those of the frame, then one a shadow map.
    views: Vec<u64>,
    /// Offsets of the blocks of the views' previous frames.
    previous_views: Vec<u64>,
    frusta: Vec<Frustum>,
    view_count: usize,
    first_object: u32,
    first_previous_object: u32,
    first_light: u32,
    fur: u64,
    fur_stride: u64,
    /// First joint and first morph weight of each instance that is posed, now and in the previous frame.
    poses: HashMap<(usize, StreamPose), [u32; 2]>,
    /// Of fur by part and shells: which block.
    fur_blocks: HashMap<(usize, u32), usize>,
    /// In the order of their blocks: part, material, shells.
    furs: Vec<(usize, usize, u32)>,
    posed: Vec<(usize, StreamPose)>,
    objects: Vec<ObjectUniforms>,
    lights: Vec<LightSource>,
    sources: Vec<ShadowSource>,
    mean_radiance: Vec3,
}

/// What a frame's values are made of.
pub struct FrameInput<'a> {
    pub scene: &'a Scene,
    pub staging: &'a Staging,
    pub views: &'a [View],
    pub environment: &'a EnvironmentLight,
    pub maps: Option<&'a EnvironmentMaps>,
    pub atlas: Option<&'a ShadowAtlas>,
    /// The tiles of a host's own shadow maps, in the place of the atlas's.
    pub host_sources: Option<&'a [ShadowSource]>,
}

/// Hands out places in a slice one after another.
struct Places(u64);

impl Places {
    /// The start of `count` values, at a multiple of `alignment`, bytes.
    fn take<T>(&mut self, count: usize, alignment: u64) -> u64 {
        let start = self.0.next_multiple_of(alignment);
        self.0 = start + (count * size_of::<T>()) as u64;
        start
    }

    /// The same for a list that is read by entries.
    fn list<T>(&mut self, count: usize) -> u64 {
        self.take::<T>(count, size_of::<T>() as u64)
    }
}

impl FrameValues {
    /// What of it depends on the plan alone.
    pub fn replan(&mut self, plan: &Plan) {
        self.fur_blocks.clear();
        self.furs.clear();
        for draw in plan.draws.values().flatten() {
            let DrawKind::Fur { material, layers } = draw.kind else { continue };
            let next = self.furs.len();
            self.fur_blocks.entry((draw.part, layers)).or_insert_with(|| {
                self.furs.push((draw.part, material, layers));
                next
            });
        }
        let posed: BTreeSet<(usize, bool)> = plan
            .deforms
            .iter()
            .map(|deform| (plan.parts[deform.part].instance, deform.pose == StreamPose::Previous))
            .collect();
        let pose = |is_previous| if is_previous { StreamPose::Previous } else { StreamPose::Current };
        self.posed = posed.into_iter().map(|(instance, is_previous)| (instance, pose(is_previous))).collect();
    }

    /// Writes a frame's values into a slice of their own. Whether they lie in another buffer than the last ones.
    ///
    /// # Errors
    /// When the device is out of memory.
    pub fn write(&mut self, shared: &Shared, input: &FrameInput) -> Result<bool, GpuError> {
        let FrameInput { staging, views, .. } = *input;
        let block = shared.gpu.info().uniform_alignment;
        // Found once from zero, for the size; the slice may start anywhere.
        let mut places = Places(0);
        self.place(&mut places, block, staging, views.len());
        let lists = [size_of::<ObjectUniforms>(), size_of::<LightSource>(), size_of::<ShadowSource>(), 64, 4];
        let slack = block + 2 * lists.iter().map(|stride| *stride as u64).sum::<u64>();
        let slice = shared.frame_values.slice(places.0 + slack, block)?;
        let mut places = Places(slice.offset());
        let [first_source, ..] = self.place(&mut places, block, staging, views.len());
        let has_moved = self.slice.as_ref().is_none_or(|before| !before.is_in(slice.buffer()));
        self.fill(&slice, input, first_source)?;
        self.slice = Some(slice);
        Ok(has_moved)
    }

    /// Gives every list its place, bytes from the start of the buffer; that of the shadow sources is the result.
    fn place(&mut self, places: &mut Places, block: u64, staging: &Staging, view_count: usize) -> [u64; 1] {
        let map_count = staging.shadow_maps.maps.len();
        self.view_count = view_count;
        self.views.clear();
        self.views.extend((0..view_count + map_count).map(|_| places.take::<FrameUniforms>(1, block)));
        self.previous_views.clear();
        if staging.options().has_motion() {
            self.previous_views.extend((0..view_count).map(|_| places.take::<PreviousFrame>(1, block)));
        }
        self.fur_stride = (size_of::<FurUniforms>() as u64).next_multiple_of(block);
        self.fur = places.0.next_multiple_of(block);
        places.0 = self.fur + self.fur_stride * self.furs.len() as u64;
        let entry = |start: u64, stride: usize| (start / stride as u64) as u32;
        let count = staging.instances.len();
        self.first_object = entry(places.list::<ObjectUniforms>(count), size_of::<ObjectUniforms>());
        self.first_previous_object =
            entry(places.list::<ObjectUniforms>(staging.previous.len()), size_of::<ObjectUniforms>());
        self.first_light =
            entry(places.list::<LightSource>(staging.light_lists.lights.len()), size_of::<LightSource>());
        let sources = places.list::<ShadowSource>(map_count);
        self.poses.clear();
        for &(index, pose) in &self.posed {
            let instance = posed_instance(staging, index, pose);
            let joints = places.list::<Mat4>(instance.joints.len());
            let weights = places.list::<f32>(instance.morph_weights.len());
            self.poses.insert((index, pose), [entry(joints, size_of::<Mat4>()), entry(weights, size_of::<f32>())]);
        }
        [sources]
    }

    fn fill(&mut self, slice: &TransientSlice, input: &FrameInput, sources: u64) -> Result<(), GpuError> {
        let FrameInput { scene, staging, views, environment, maps, atlas, host_sources } = *input;
        let mean_radiance = maps.map_or(Vec3::ZERO, EnvironmentMaps::mean_radiance);
        self.mean_radiance = mean_radiance * environment.strength;
        self.frusta.clear();
        for (view, &at) in views.iter().zip(&self.views) {
            self.frusta.push(Frustum::of(view.clip_from_world()));
            write(slice, at, &[frame_uniforms(view, environment, maps)])?;
        }
        for (map, &at) in staging.shadow_maps.maps.iter().zip(&self.views[views.len()..]) {
            self.frusta.push(Frustum::of(map.clip_from_world));
            write(slice, at, &[light_view(map)])?;
        }
        for (view, &at) in views.iter().zip(&self.previous_views) {
            write(slice, at, &[previous_frame(view)])?;
        }
        for (index, &(part, material, layers)) in self.furs.iter().enumerate() {
            let material = &scene.materials()[material];
            let Some(fur) = &material.fur else { continue };
            let instance = staging.plan.parts[part].instance;
            let force = force_in_world(fur, &staging.instances[instance]);
            let values = fur_uniforms(fur, &material.standard, staging.sizes[instance], layers, force);
            write(slice, self.fur + self.fur_stride * index as u64, &[values])?;
        }
        for (instances, first) in
            [(&staging.instances, self.first_object), (&staging.previous, self.first_previous_object)]
        {
            self.objects.clear();
            self.objects.extend(instances.iter().zip(&staging.sizes).map(object_uniforms));
            write(slice, u64::from(first) * size_of::<ObjectUniforms>() as u64, &self.objects)?;
        }
        let first_source = (sources / size_of::<ShadowSource>() as u64) as u32;
        self.lights.clear();
        self.lights.extend(staging.light_lists.lights.iter().map(|&light| {
            let (first, count) = first_shadows(&staging.shadow_maps.maps, light);
            light_source(&staging.lights[light], first_source + first, count)
        }));
        write(slice, u64::from(self.first_light) * size_of::<LightSource>() as u64, &self.lights)?;
        self.sources.clear();
        match (host_sources, atlas) {
            (Some(host), _) => self.sources.extend_from_slice(host),
            (None, Some(atlas)) => {
                let maps = staging.shadow_maps.maps.iter().enumerate();
                self.sources.extend(maps.map(|(index, map)| atlas.source(index, map)));
            }
            (None, None) => {}
        }
        write(slice, sources, &self.sources)?;
        for &(index, pose) in &self.posed {
            let Some([joints, weights]) = self.poses.get(&(index, pose)) else { continue };
            let instance = posed_instance(staging, index, pose);
            write(slice, u64::from(*joints) * size_of::<Mat4>() as u64, &instance.joints)?;
            write(slice, u64::from(*weights) * size_of::<f32>() as u64, &instance.morph_weights)?;
        }
        Ok(())
    }

    /// The slice that holds them, once written.
    pub fn slice(&self) -> Option<&TransientSlice> {
        self.slice.as_ref()
    }

    /// Linear RGB mean of the environment's radiance; 0 where nothing is lit.
    pub fn mean_radiance(&self) -> Vec3 {
        self.mean_radiance
    }

    /// Where the blocks of a view, and of its previous frame, start.
    pub fn view(&self, view: usize) -> [u64; 2] {
        [self.views[view], self.previous_views.get(view).copied().unwrap_or_default()]
    }

    /// The view that sees what a shadow map shows.
    pub fn view_of_map(&self, map: usize) -> usize {
        self.view_count + map
    }

    /// Whether a view may show any of a sphere.
    pub fn sees(&self, view: usize, sphere: crate::math::Sphere) -> bool {
        self.frusta[view].sees(sphere)
    }

    /// Where the block of a part's fur starts.
    pub fn fur(&self, part: usize, layers: u32) -> u64 {
        let block = self.fur_blocks.get(&(part, layers)).copied().unwrap_or_default();
        self.fur + self.fur_stride * block as u64
    }

    /// First joint and first morph weight of an instance in a pose.
    pub fn pose(&self, instance: usize, pose: StreamPose) -> [u32; 2] {
        self.poses.get(&(instance, pose)).copied().unwrap_or_default()
    }

    /// Entries of an instance, of it in the previous frame, and of a light of the lists.
    pub fn entries(&self, instance: usize, light: u32) -> [u32; 3] {
        let instance = instance as u32;
        [self.first_object + instance, self.first_previous_object + instance, self.first_light + light]
    }
}

/// `place` is counted from the start of the buffer.
fn write<T: NoUninit>(slice: &TransientSlice, place: u64, values: &[T]) -> Result<(), GpuError> {
    if values.is_empty() {
        return Ok(());
    }
    slice.write(place - slice.offset(), values)
}

fn posed_instance(staging: &Staging, index: usize, pose: StreamPose) -> &Instance {
    let previous = staging.previous.get(index).filter(|_| pose == StreamPose::Previous);
    previous.unwrap_or(&staging.instances[index])
}

fn frame_uniforms(view: &View, light: &EnvironmentLight, maps: Option<&EnvironmentMaps>) -> FrameUniforms {
    let EnvironmentLight { strength, rotation_deg, .. } = *light;
    let turn = rotation_deg.to_radians();
    // A frame without light to ask for has none.
    let mut environment_harmonics = [[0.0; 4]; SH_COEFFICIENTS];
    for (harmonic, radiance) in environment_harmonics.iter_mut().zip(maps.iter().flat_map(|maps| maps.harmonics)) {
        *harmonic = (radiance * strength).extend(0.0).to_array();
    }
    let camera = view.camera();
    FrameUniforms {
        clip_from_world: view.clip_from_world().to_cols_array_2d(),
        eye_in_world: camera.eye_in_world().to_array(),
        pre_exposure: view.pre_exposure,
        view_in_world: camera.backwards_in_world().to_array(),
        orthographic: if camera.is_orthographic { 1.0 } else { 0.0 },
        environment_scale: maps.map_or(Vec3::ZERO, |maps| maps.scale * strength).to_array(),
        environment_levels: maps.map_or(0, |maps| maps.last_level) as f32,
        environment_turn: [turn.cos(), turn.sin()],
        _reserved_0: 0.0,
        _reserved_1: 0.0,
        environment_harmonics,
    }
}

/// What a light sees, without light.
fn light_view(map: &ShadowMap) -> FrameUniforms {
    FrameUniforms {
        clip_from_world: map.clip_from_world.to_cols_array_2d(),
        eye_in_world: map.eye_in_world.to_array(),
        pre_exposure: 1.0,
        view_in_world: map.direction_to_light.to_array(),
        orthographic: if map.is_orthographic { 1.0 } else { 0.0 },
        environment_scale: [0.0; 3],
        environment_levels: 0.0,
        environment_turn: [0.0; 2],
        _reserved_0: 0.0,
        _reserved_1: 0.0,
        environment_harmonics: [[0.0; 4]; SH_COEFFICIENTS],
    }
}

/// Where the picture was. Jitter is of this frame and moves nothing: it is on both.
fn previous_frame(view: &View) -> PreviousFrame {
    let [view_from_world, clip_from_view] = view.previous.unwrap_or([view.view_from_world, view.clip_from_view]);
    let before = View { view_from_world, clip_from_view, ..*view };
    let [width, height] = view.viewport.size.map(|side| side as f32);
    let down = if view.is_y_down { 0.5 } else { -0.5 };
    PreviousFrame {
        clip_from_world: before.clip_from_world().to_cols_array_2d(),
        pixels_from_clip: [0.5 * width, down * height],
        _reserved_0: 0.0,
        _reserved_1: 0.0,
    }
}

fn object_uniforms((instance, size): (&Instance, &Size)) -> ObjectUniforms {
    let world_from_object = instance.world_from_object;
    ObjectUniforms {
        world_from_object: world_from_object.to_cols_array_2d(),
        normal_from_object: Mat4::from_mat3(normal_matrix(world_from_object)).to_cols_array_2d(),
        handedness: if world_from_object.determinant() < 0.0 { -1.0 } else { 1.0 },
        world_from_rest: size.world_from_rest,
        _reserved_1: 0.0,
        _reserved_2: 0.0,
    }
}
