//! A scene of the host's: meshes and materials, and instances that the host places, poses, hides and removes.

use super::motion::DynamicsStep;
use super::resources::SceneResources;
use crate::LoadOptions;
use crate::asset::Image;
use crate::gpu::Gpu;
use crate::material::{Look, Value};
use crate::render::RenderError;
use crate::render::light::{EnvironmentMaps, EnvironmentQuality, HostEnvironment};
use crate::render::plan::Staging;
use crate::scene::{self, EnvironmentLight, Instance, Pose, Scene};
use glam::Mat4;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// A mesh to place.
#[derive(Debug, Clone, PartialEq)]
pub struct InstanceDesc {
    /// Index into [`Asset::meshes`](crate::asset::Asset::meshes).
    pub mesh: usize,
    /// Index into [`Asset::skins`](crate::asset::Asset::skins), for a mesh that joints carry.
    pub skin: Option<usize>,
    /// Where it stands. Joints carry a skinned mesh to the world, and this does not count for it.
    pub world_from_object: Mat4,
    /// Index of the KHR_materials_variants variant that it wears.
    pub variant: Option<usize>,
}

impl Default for InstanceDesc {
    /// The first mesh at the origin.
    fn default() -> Self {
        Self { mesh: 0, skin: None, world_from_object: Mat4::IDENTITY, variant: None }
    }
}

/// An instance of one scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct InstanceId {
    scene: u64,
    index: usize,
    generation: u32,
}

/// Who stands at a place of the list.
#[derive(Debug, Clone, Copy, Default)]
struct Slot {
    generation: u32,
    is_taken: bool,
    variant: Option<usize>,
}

/// A scene on the device, edited in place: what changes is uploaded, and nothing else. Instances of one mesh share its
/// geometry, textures and pipelines; each has its own pose and strand dynamics.
///
/// Changes are seen by the next [`Frame::prepare`](crate::render::Frame::prepare). It is `Send`; one thread at a time edits
/// and draws it.
pub struct DeviceScene {
    id: u64,
    pub(in crate::render) scene: Scene,
    pub(in crate::render) staging: Staging,
    pub(in crate::render) resources: SceneResources,
    slots: Vec<Slot>,
    /// Parts must be listed again.
    is_changed: bool,
    pose: Pose,
    environment: EnvironmentLight,
    quality: EnvironmentQuality,
    host_environment: Option<Arc<EnvironmentMaps>>,
    is_reset: bool,
    /// The frame that it was prepared for last, and how many views that had.
    pub(in crate::render) prepared: Option<(u64, usize)>,
    /// The device that it lives on, once it has been drawn.
    pub(in crate::render) device: Option<usize>,
}

impl DeviceScene {
    /// Meshes and materials; nothing is placed yet.
    pub fn new(scene: Scene) -> Self {
        static NEXT_ID: AtomicU64 = AtomicU64::new(1);
        Self {
            id: NEXT_ID.fetch_add(1, Ordering::Relaxed),
            scene,
            staging: Staging::default(),
            resources: SceneResources::default(),
            slots: Vec::new(),
            is_changed: true,
            pose: Pose::default(),
            environment: EnvironmentLight::default(),
            quality: EnvironmentQuality::default(),
            host_environment: None,
            is_reset: true,
            prepared: None,
            device: None,
        }
    }

    /// Its meshes, images and materials.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Places a mesh. A skinned one stands as it was bound until it is posed.
    ///
    /// # Errors
    /// A mesh, skin or variant that there is not; a skin with fewer joints than the mesh asks for; a transform that is not
    /// finite.
    pub fn add(&mut self, desc: &InstanceDesc) -> Result<InstanceId, RenderError> {
        let asset = self.scene.asset();
        let wrong = |option, problem: String| RenderError::Option { option, problem };
        let known = |option, index: usize, count: usize| match index < count {
            true => Ok(()),
            false => Err(wrong(option, format!("there is no {index}; the scene has {count}"))),
        };
        known("instance.mesh", desc.mesh, asset.meshes.len())?;
        if let Some(skin) = desc.skin {
            known("instance.skin", skin, asset.skins.len())?;
            let joints = asset.skins[skin].joints.len();
            let primitives = &asset.meshes[desc.mesh].primitives;
            let influences = primitives.iter().flat_map(|primitive| &primitive.vertices.joints);
            let needed = influences.map(|(joint, _)| usize::from(*joint) + 1).max().unwrap_or(0);
            if needed > joints {
                let problem =
                    format!("has {joints} joints and the mesh is moved by {needed}; choose the mesh's own skin");
                return Err(wrong("instance.skin", problem));
            }
        }
        if let Some(variant) = desc.variant {
            known("instance.variant", variant, asset.variants.len())?;
        }
        finite("instance.world_from_object", &[desc.world_from_object])?;
        let skin = desc.skin.filter(|&skin| !asset.skins[skin].joints.is_empty());
        let instance = Instance::placed(asset, desc.mesh, skin, desc.world_from_object);
        Ok(self.place(instance, desc.variant))
    }

    /// Places all that a scene of the file shows, in its rest pose; [`Self::pose_nodes`] poses it by the file's own clips.
    ///
    /// # Errors
    /// A scene or variant that there is not.
    pub fn add_nodes(&mut self, scene: usize, variant: Option<usize>) -> Result<Vec<InstanceId>, RenderError> {
        let asset = self.scene.asset();
        for (option, index, count) in
            [("scene", Some(scene), asset.scenes.len()), ("variant", variant, asset.variants.len())]
        {
            if let Some(index) = index.filter(|index| *index >= count) {
                let problem = format!("there is no {option} {index}; the file has {count}");
                return Err(RenderError::Option { option, problem });
            }
        }
        self.pose.set(self.scene.asset(), None, 0.0);
        let instances = scene::instances(self.scene.asset(), scene, &self.pose);
        Ok(instances.into_iter().map(|instance| self.place(instance, variant)).collect())
    }

    /// Poses what [`Self::add_nodes`] placed: at `time_s` of a clip, or at rest. A clip holds its last pose.
    ///
    /// # Errors
    /// A clip that there is not; a time that is no number.
    pub fn pose_nodes(&mut self, animation: Option<usize>, time_s: f32) -> Result<(), RenderError> {
        let count = self.scene.asset().animations.len();
        if let Some(index) = animation.filter(|index| *index >= count) {
            let problem = format!("there is no animation {index}; the file has {count}");
            return Err(RenderError::Option { option: "animation", problem });
        }
        if !time_s.is_finite() {
            let problem = format!("{time_s} is no time; give finite seconds");
            return Err(RenderError::Option { option: "time_s", problem });
        }
        self.pose.set(self.scene.asset(), animation, time_s);
        let visible = |instances: &[Instance]| instances.iter().filter(|instance| instance.is_visible).count();
        let before = visible(&self.staging.instances);
        scene::pose_instances(&mut self.staging.instances, self.scene.asset(), &self.pose);
        self.is_changed |= visible(&self.staging.instances) != before;
        Ok(())
    }

    /// Moves an instance. Of a skinned one, only joints do.
    ///
    /// # Errors
    /// An instance that has been removed, or is of another scene; a matrix that is not finite.
    pub fn set_transform(&mut self, id: InstanceId, world_from_object: Mat4) -> Result<(), RenderError> {
        let index = self.index(id)?;
        finite("world_from_object", &[world_from_object])?;
        let instance = &mut self.staging.instances[index];
        let was_visible = instance.is_visible;
        instance.set_transform(world_from_object);
        // What has no size has no parts either.
        self.is_changed |= instance.is_visible != was_visible;
        Ok(())
    }

    /// Poses a skinned instance: for each joint of its skin, in that order, where the joint is times the inverse of where it
    /// was bound (`world_from_mesh`).
    ///
    /// # Errors
    /// An instance that has been removed, or is of another scene; another number of matrices than the skin has joints; a
    /// matrix that is not finite.
    pub fn set_joints(&mut self, id: InstanceId, world_from_mesh: &[Mat4]) -> Result<(), RenderError> {
        let index = self.index(id)?;
        let instance = &mut self.staging.instances[index];
        let (given, needed) = (world_from_mesh.len(), instance.joints.len());
        if given != needed {
            let problem = format!("{given} matrices given; the instance's skin has {needed} joints, give one for each");
            return Err(RenderError::Option { option: "world_from_mesh", problem });
        }
        finite("world_from_mesh", world_from_mesh)?;
        instance.set_joints(world_from_mesh.iter().copied());
        if let Some(first) = instance.joints.first() {
            instance.mirrored = first.determinant() < 0.0;
        }
        Ok(())
    }

    /// Sets the morph weights of an instance, one for each target of its mesh.
    ///
    /// # Errors
    /// An instance that has been removed, or is of another scene; another number of weights; a weight that is not finite.
    pub fn set_morph_weights(&mut self, id: InstanceId, weights: &[f32]) -> Result<(), RenderError> {
        let index = self.index(id)?;
        let known = &mut self.staging.instances[index].morph_weights;
        if weights.len() != known.len() || !weights.iter().all(|weight| weight.is_finite()) {
            let problem =
                format!("{} given; the mesh has {} targets, give a finite weight for each", weights.len(), known.len());
            return Err(RenderError::Option { option: "weights", problem });
        }
        known.copy_from_slice(weights);
        Ok(())
    }

    /// Shows or hides an instance. Its pose and strands stay.
    ///
    /// # Errors
    /// An instance that has been removed, or is of another scene.
    pub fn set_visible(&mut self, id: InstanceId, is_visible: bool) -> Result<(), RenderError> {
        let index = self.index(id)?;
        self.staging.hidden[index] = !is_visible;
        Ok(())
    }

    /// Takes an instance away.
    ///
    /// # Errors
    /// An instance that has been removed already, or is of another scene.
    pub fn remove(&mut self, id: InstanceId) -> Result<(), RenderError> {
        let index = self.index(id)?;
        self.slots[index].is_taken = false;
        self.slots[index].generation += 1;
        self.is_changed = true;
        Ok(())
    }

    /// Instances that stand in the scene.
    pub fn instance_count(&self) -> usize {
        self.slots.iter().filter(|slot| slot.is_taken).count()
    }

    /// [`Scene::set_parameter`]: a slider. One uniform block is uploaded.
    ///
    /// # Errors
    /// Those of [`Scene::set_parameter`].
    pub fn set_parameter(&mut self, material: usize, key: &str, value: &Value) -> Result<(), RenderError> {
        Ok(self.scene.set_parameter(material, key, value)?)
    }

    /// [`Scene::apply`]: puts a look on the materials.
    ///
    /// # Errors
    /// Those of [`Scene::apply`]. Then the scene is not to be drawn.
    pub fn apply(&mut self, look: &Look, folder: &Path, options: &LoadOptions) -> Result<(), RenderError> {
        Ok(self.scene.apply(look, folder, options)?)
    }

    /// Puts another picture in the place of an image of the scene, by its index in
    /// [`Asset::images`](crate::asset::Asset::images).
    ///
    /// # Errors
    /// An image that there is not; bytes that are not four a texel.
    pub fn set_image(&mut self, index: usize, image: Image) -> Result<(), RenderError> {
        self.scene.set_image(index, image)?;
        self.resources.content_mut().forget_image(index);
        Ok(())
    }

    /// An image of the host's stands for an image of the scene. It is in shader-read layout whenever a frame reads it, and
    /// decodes by itself where it holds colours (an sRGB format).
    ///
    /// # Errors
    /// An image that there is not.
    pub fn set_host_image(&mut self, index: usize, image: crate::gpu::Image) -> Result<(), RenderError> {
        let count = self.scene.asset().images.len();
        if index >= count {
            let problem = format!("there is no image {index}; the scene has {count}");
            return Err(RenderError::Option { option: "image", problem });
        }
        self.resources.content_mut().replace_image(index, image);
        Ok(())
    }

    /// The environment that lights the scene; vair prepares its maps, which takes seconds where no cache has them.
    ///
    /// # Errors
    /// A strength or rotation that is not finite, a quality out of its range.
    pub fn set_environment(
        &mut self,
        environment: EnvironmentLight,
        quality: EnvironmentQuality,
    ) -> Result<(), RenderError> {
        let EnvironmentLight { strength, rotation_deg, .. } = environment;
        if !(strength >= 0.0 && strength.is_finite() && rotation_deg.is_finite()) {
            let problem = "strength and rotation must be finite, the strength not negative".to_owned();
            return Err(RenderError::Option { option: "environment", problem });
        }
        if let Some(problem) = quality.problem() {
            return Err(RenderError::Option { option: "environment quality", problem });
        }
        (self.environment, self.quality, self.host_environment) = (environment, quality, None);
        Ok(())
    }

    /// The host's own prefiltered environment lights the scene, turned and scaled by `rotation_deg` and `strength`.
    ///
    /// # Errors
    /// An image that is no cube; numbers that are not finite.
    pub fn set_host_environment(
        &mut self,
        gpu: &Gpu,
        environment: HostEnvironment,
        rotation_deg: f32,
        strength: f32,
    ) -> Result<(), RenderError> {
        let turned = EnvironmentLight { rotation_deg, strength, ..self.environment.clone() };
        let maps = EnvironmentMaps::from_host(gpu, environment)?;
        self.set_environment(turned, self.quality)?;
        self.host_environment = Some(Arc::new(maps));
        Ok(())
    }

    /// Strands start from rest in the next frame, as after a cut.
    pub fn reset_dynamics(&mut self) {
        self.is_reset = true;
    }

    pub(in crate::render) fn environment(&self) -> (&EnvironmentLight, EnvironmentQuality) {
        (&self.environment, self.quality)
    }

    pub(in crate::render) fn host_environment(&self) -> Option<&Arc<EnvironmentMaps>> {
        self.host_environment.as_ref()
    }

    /// Lists the parts again where instances have come or gone.
    pub(in crate::render) fn list_parts(&mut self) {
        if !std::mem::take(&mut self.is_changed) {
            return;
        }
        let asset = self.scene.asset();
        self.staging.parts.clear();
        for (index, slot) in self.slots.iter().enumerate().filter(|(_, slot)| slot.is_taken) {
            let instance = std::slice::from_ref(&self.staging.instances[index]);
            let parts = scene::parts(asset, instance, slot.variant);
            self.staging.parts.extend(parts.into_iter().map(|part| scene::Part { instance: index, ..part }));
        }
        self.staging.replan();
    }

    /// How strands move on from the last frame.
    pub(in crate::render) fn step(&mut self, step_s: f32) -> DynamicsStep {
        DynamicsStep { is_reset: std::mem::take(&mut self.is_reset), step_s }
    }

    /// After a frame: what was now is the previous frame of the next one.
    pub(in crate::render) fn keep_previous(&mut self) {
        let Staging { instances, previous, .. } = &mut self.staging;
        if previous.len() == instances.len() {
            for (before, now) in previous.iter_mut().zip(instances) {
                before.clone_from(now);
            }
        }
    }

    fn place(&mut self, instance: Instance, variant: Option<usize>) -> InstanceId {
        let size = self.scene.size(&instance);
        let free = self.slots.iter().position(|slot| !slot.is_taken);
        let index = match free {
            Some(index) => {
                self.staging.instances[index] = instance;
                self.staging.sizes[index] = size;
                self.staging.hidden[index] = false;
                index
            }
            None => {
                self.slots.push(Slot::default());
                self.staging.instances.push(instance);
                self.staging.sizes.push(size);
                self.staging.hidden.push(false);
                self.staging.keys.push(0);
                self.slots.len() - 1
            }
        };
        let slot = &mut self.slots[index];
        (slot.is_taken, slot.variant) = (true, variant);
        // No two that ever stood here share strands.
        self.staging.keys[index] = index + (slot.generation as usize) * MOST_INSTANCES;
        // What was not there before has not moved.
        if let Some(previous) = self.staging.previous.get_mut(index) {
            previous.clone_from(&self.staging.instances[index]);
        }
        self.is_changed = true;
        InstanceId { scene: self.id, index, generation: slot.generation }
    }

    fn index(&self, id: InstanceId) -> Result<usize, RenderError> {
        let wrong = |problem: &str| RenderError::Option { option: "instance", problem: problem.to_owned() };
        if id.scene != self.id {
            return Err(wrong("is of another scene; use the ids that this one's `add` gave"));
        }
        let slot = self.slots.get(id.index).filter(|slot| slot.is_taken && slot.generation == id.generation);
        slot.map(|_| id.index).ok_or_else(|| wrong("has been removed; add it again"))
    }
}

/// Far more than a scene holds: tells apart the keys of generations.
const MOST_INSTANCES: usize = 1 << 32;

fn finite(option: &'static str, matrices: &[Mat4]) -> Result<(), RenderError> {
    match matrices.iter().position(|matrix| !matrix.is_finite()) {
        Some(index) => {
            let problem = format!("matrix {index} is not finite; give finite numbers");
            Err(RenderError::Option { option, problem })
        }
        None => Ok(()),
    }
}
