//! What changes every frame: camera, lights, places, coats; and the bind groups over it.

use super::Shot;
use super::environment::{EnvironmentMaps, HARMONICS, LobeTable};
use super::map::{StandIn, fur_maps};
use super::material::fur_uniforms;
use super::pipeline::{PipelineSpec, Target};
use super::plan::{Draw, DrawKind, Plan};
use super::previous::Previous;
use super::resources::Resources;
use super::shadow::{ShadowAtlas, ShadowPlan};
use crate::gpu::{BindGroup, Buffer, Gpu, GpuError, Image, Memory, Resource};
use crate::material::{ForceSpace, Fur, Material};
use crate::math::normal_matrix;
use crate::scene::{Camera, Instance, LightKind, Lighting, Pose, Scene, ShadowMap, Surroundings, joint_matrices};
use crate::shader::layout::{FrameUniforms, LightSource, ObjectUniforms, PreviousFrame};
use ash::vk;
use bytemuck::NoUninit;
use glam::{Mat4, Vec3};
use std::collections::hash_map::Entry;
use std::collections::{BTreeSet, HashMap};

/// Descriptor set of camera and lights.
pub const FRAME_SET: u32 = 0;
/// Descriptor set of where objects stand.
pub const OBJECT_SET: u32 = 2;

/// What light is on the device, as far as the frame asks for it.
#[derive(Clone, Copy, Default)]
pub struct LightMaps<'a> {
    /// Cube and harmonics.
    pub environment: Option<&'a EnvironmentMaps>,
    /// How lobes look into the cube.
    pub lobes: Option<&'a LobeTable>,
    /// Screen-space occlusion.
    pub occlusion: Option<&'a Image>,
    /// Shadow maps.
    pub atlas: Option<&'a ShadowAtlas>,
}

/// What one frame reads and no other.
pub struct FrameData {
    /// Linear RGB mean of the environment's radiance; 0 where nothing is lit.
    pub mean_radiance: Vec3,
    /// What a view shares: the camera's, then each shadow map's.
    views: Vec<Buffer>,
    lights: Option<Buffer>,
    shadows: Option<Buffer>,
    objects: Buffer,
    /// Camera and places of the previous frame, where motion is asked for.
    previous: Option<[Buffer; 2]>,
    /// Bind groups of all objects by view, set and names: most pipelines have the same.
    shared_groups: HashMap<(usize, u32, BTreeSet<&'static str>), BindGroup>,
    /// Coat bind groups by (instance, pipeline).
    pub coat_groups: HashMap<(usize, usize), BindGroup>,
}

impl FrameData {
    /// Uploads this frame's values and binds them to the plan's pipelines.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub fn new(
        gpu: &Gpu,
        resources: &Resources,
        maps: LightMaps,
        scene: &Scene,
        shot: &Shot,
        size: [u32; 2],
    ) -> Result<Self, GpuError> {
        let Shot { plan, camera, lighting, .. } = shot;
        let lights: Vec<LightSource> =
            plan.lights.lights.iter().map(|&light| light_source(light, lighting, &plan.shadows)).collect();
        let eye = frame_uniforms(camera, lighting, maps.environment);
        let views = std::iter::once(eye).chain(plan.shadows.maps.iter().map(light_view));
        let objects: Vec<ObjectUniforms> =
            plan.instances.iter().map(|instance| object_uniforms(scene, instance)).collect();
        let mean_radiance = maps.environment.map_or(Vec3::ZERO, EnvironmentMaps::mean_radiance);
        let mut data = Self {
            mean_radiance: mean_radiance * lighting.surroundings.strength,
            views: views
                .map(|view| filled(gpu, "frame", vk::BufferUsageFlags::UNIFORM_BUFFER, &[view]))
                .collect::<Result<_, _>>()?,
            lights: if plan.is_lit() {
                Some(filled(gpu, "lights", vk::BufferUsageFlags::STORAGE_BUFFER, &lights)?)
            } else {
                None
            },
            shadows: if plan.lit.is_occluded() {
                let sources = plan.shadows.sources();
                Some(filled(gpu, "shadows", vk::BufferUsageFlags::STORAGE_BUFFER, &sources)?)
            } else {
                None
            },
            objects: filled(gpu, "objects", vk::BufferUsageFlags::STORAGE_BUFFER, &objects)?,
            previous: shot
                .previous
                .as_ref()
                .map(|previous| previous_buffers(gpu, scene, previous, size))
                .transpose()?,
            shared_groups: HashMap::new(),
            coat_groups: HashMap::new(),
        };
        data.bind_shared(gpu, resources, maps, plan)?;
        for draw in plan.fur.iter().chain(&plan.transparent).chain(&plan.guide).chain(plan.shadows.draws()) {
            data.bind_coat(gpu, resources, scene, shot, draw)?;
        }
        Ok(data)
    }

    fn bind_shared(&mut self, gpu: &Gpu, resources: &Resources, maps: LightMaps, plan: &Plan) -> Result<(), GpuError> {
        let mut offered = vec![("ObjectList", Resource::Buffer(&self.objects))];
        if let Some(environment) = maps.environment {
            offered.push(("environment_map", Resource::Texture(&environment.map)));
            offered.push(("environment_sampler", Resource::Sampler(&environment.sampler)));
        }
        if let Some(lobes) = maps.lobes {
            offered.push(("lobe_table", Resource::Texture(&lobes.map)));
            offered.push(("lobe_table_sampler", Resource::Sampler(&lobes.sampler)));
        }
        if let Some([frame, objects]) = &self.previous {
            offered.push(("PreviousFrameBlock", Resource::Buffer(frame)));
            offered.push(("PreviousObjectList", Resource::Buffer(objects)));
        }
        // Where shadows alone hide light, it is bound and not read.
        let occlusion = maps.occlusion.or(resources.stand_in(StandIn::White));
        offered.extend(occlusion.map(|image| ("screen_occlusion_map", Resource::Texture(image))));
        if let Some(lights) = &self.lights {
            offered.push(("LightList", Resource::Buffer(lights)));
        }
        if let Some(shadows) = &self.shadows {
            offered.push(("ShadowList", Resource::Buffer(shadows)));
        }
        if let Some(atlas) = maps.atlas {
            offered.extend(atlas.named().map(|(name, image)| (name, Resource::Texture(image))));
            offered.push(("shadow_sampler", Resource::Sampler(&atlas.sampler)));
        }
        for spec in &plan.pipelines {
            // The camera sees what has a colour, lights see what casts shadows.
            let views = if spec.target == Target::Color { 0..1 } else { 1..self.views.len() };
            for view in views {
                let mut offered = offered.clone();
                offered.push(("FrameBlock", Resource::Buffer(&self.views[view])));
                for (set, name) in [(FRAME_SET, "frame"), (OBJECT_SET, "objects")] {
                    if let Entry::Vacant(new) = self.shared_groups.entry((view, set, spec.bindings_of(set))) {
                        new.insert(gpu.bind_group(resources.pipeline(spec), set, name, &offered)?);
                    }
                }
            }
        }
        Ok(())
    }

    /// The bind group of a set, [`FRAME_SET`] or [`OBJECT_SET`], that all objects in a view share: 0 is the camera's,
    /// others are those of shadow maps from 1.
    pub fn shared_group(&self, view: usize, set: u32, spec: &PipelineSpec) -> &BindGroup {
        &self.shared_groups[&(view, set, spec.bindings_of(set))]
    }

    fn bind_coat(
        &mut self,
        gpu: &Gpu,
        resources: &Resources,
        scene: &Scene,
        Shot { plan, pose, .. }: &Shot,
        draw: &Draw,
    ) -> Result<(), GpuError> {
        let DrawKind::Fur { material, layers } = draw.kind else { return Ok(()) };
        let Material { standard, fur: Some(fur), name, .. } = &scene.materials()[material] else { return Ok(()) };
        let instance = &plan.instances[draw.instance];
        let force = force_in_world(fur, scene, instance, pose);
        let values = fur_uniforms(fur, standard, scene.size(instance), layers, force);
        let uniforms = filled(gpu, "fur", vk::BufferUsageFlags::UNIFORM_BUFFER, &[values])?;
        let spec = &plan.pipelines[draw.pipeline];
        let group =
            resources.bind_material(scene, spec, name, &[("FurBlock", &uniforms)], &fur_maps(fur, standard), &[])?;
        self.coat_groups.insert((draw.instance, draw.pipeline), group);
        Ok(())
    }
}

/// A host-visible buffer with these values; one zero word when there are none, since Vulkan has no empty buffers.
pub(super) fn filled<T: NoUninit>(
    gpu: &Gpu,
    name: &str,
    usage: vk::BufferUsageFlags,
    values: &[T],
) -> Result<Buffer, GpuError> {
    let bytes = (std::mem::size_of_val(values)).max(size_of::<T>()) as u64;
    let buffer = gpu.buffer(name, bytes, usage, Memory::Upload)?;
    buffer.write(0, values)?;
    Ok(buffer)
}

/// Camera and places of the previous frame, for a picture of `size`.
fn previous_buffers(gpu: &Gpu, scene: &Scene, previous: &Previous, size: [u32; 2]) -> Result<[Buffer; 2], GpuError> {
    let [width, height] = size.map(|side| side as f32);
    let frame = PreviousFrame {
        clip_from_world: previous.camera.clip_from_world().to_cols_array_2d(),
        pixels_from_clip: [0.5 * width, -0.5 * height],
        ..Default::default()
    };
    let objects: Vec<_> = previous.instances.iter().map(|instance| object_uniforms(scene, instance)).collect();
    Ok([
        filled(gpu, "previous frame", vk::BufferUsageFlags::UNIFORM_BUFFER, &[frame])?,
        filled(gpu, "previous objects", vk::BufferUsageFlags::STORAGE_BUFFER, &objects)?,
    ])
}

fn frame_uniforms(camera: &Camera, lighting: &Lighting, environment: Option<&EnvironmentMaps>) -> FrameUniforms {
    let Surroundings { strength, rotation_deg, .. } = lighting.surroundings;
    let turn = rotation_deg.to_radians();
    // A frame without light to ask for has none.
    let mut environment_harmonics = [[0.0; 4]; HARMONICS];
    for (harmonic, radiance) in environment_harmonics.iter_mut().zip(environment.iter().flat_map(|maps| maps.harmonics))
    {
        *harmonic = (radiance * strength).extend(0.0).to_array();
    }
    FrameUniforms {
        clip_from_world: camera.clip_from_world().to_cols_array_2d(),
        eye_in_world: camera.eye_in_world().to_array(),
        view_in_world: camera.backwards_in_world().to_array(),
        orthographic: if camera.is_orthographic { 1.0 } else { 0.0 },
        environment_scale: environment.map_or(Vec3::ZERO, |maps| maps.scale * strength).to_array(),
        environment_levels: environment.map_or(0, |maps| maps.last_level) as f32,
        environment_turn: [turn.cos(), turn.sin()],
        environment_harmonics,
        ..Default::default()
    }
}

/// What a light sees, without light.
fn light_view(map: &ShadowMap) -> FrameUniforms {
    FrameUniforms {
        clip_from_world: map.clip_from_world.to_cols_array_2d(),
        eye_in_world: map.eye_in_world.to_array(),
        view_in_world: map.direction_to_light.to_array(),
        orthographic: if map.is_orthographic { 1.0 } else { 0.0 },
        ..Default::default()
    }
}

/// Unit direction times strength. A force of the object turns with its node, or with the first joint of its skin: a rig
/// turns as a whole.
fn force_in_world(fur: &Fur, scene: &Scene, instance: &Instance, pose: &Pose) -> Vec3 {
    let carrier = match (fur.force_space, instance.skin) {
        (ForceSpace::World, _) => Mat4::IDENTITY,
        (ForceSpace::Object, None) => instance.world_from_object,
        (ForceSpace::Object, Some(skin)) => {
            joint_matrices(scene.asset(), skin, pose).first().copied().unwrap_or(Mat4::IDENTITY)
        }
    };
    carrier.transform_vector3(fur.force).normalize_or(Vec3::ZERO) * fur.force_strength
}

fn object_uniforms(scene: &Scene, instance: &Instance) -> ObjectUniforms {
    let world_from_object = instance.world_from_object;
    ObjectUniforms {
        world_from_object: world_from_object.to_cols_array_2d(),
        normal_from_object: Mat4::from_mat3(normal_matrix(world_from_object)).to_cols_array_2d(),
        handedness: if world_from_object.determinant() < 0.0 { -1.0 } else { 1.0 },
        world_from_rest: scene.size(instance).world_from_rest,
        ..Default::default()
    }
}

fn light_source(index: usize, lighting: &Lighting, shadows: &ShadowPlan) -> LightSource {
    let light = &lighting.lights[index];
    let (first_shadow, shadow_count) = shadows.maps_of(index);
    let (kind, spot_scale, spot_offset) = match light.kind {
        LightKind::Directional => (0, 0.0, 0.0),
        LightKind::Point => (1, 0.0, 0.0),
        LightKind::Spot { angle_scale, angle_offset } => (2, angle_scale, angle_offset),
    };
    LightSource {
        position_in_world: light.position_in_world.to_array(),
        range_m: light.range_m.unwrap_or(0.0),
        direction_to_light: light.direction_to_light_in_world.to_array(),
        kind,
        intensity: light.intensity.to_array(),
        spot_scale,
        spot_offset,
        first_shadow,
        shadow_count,
        ..Default::default()
    }
}
