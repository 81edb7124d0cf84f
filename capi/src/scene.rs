//! Scenes and their edits: looks, instances, parameters, images.

use crate::image::{VairHostImage, borrow};
use crate::index_or_none;
use crate::mesh::{VairPixels, image_of};
use crate::pointer::{exclusive, free, handle, matrix, optional_text, result, shared, slice, slice_mut, text};
use crate::renderer::VairRenderer;
use crate::result::{Failure, VairResult, border, border_of_free};
use glam::Mat4;
use std::collections::HashMap;
use std::ffi::c_char;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use toml::de::DeValue;
use vair::gpu::vk;
use vair::material::Value;
use vair::render::{DeviceScene, InstanceDesc, InstanceId, Target};
use vair::scene::Scene;
use vair::{LoadOptions, Look};

/// Meshes, materials and instances on a device, edited in place: what changes is uploaded, and nothing else. Changes are seen by
/// the next vair_frame_prepare(). One thread at a time edits and draws it.
pub struct VairScene {
    pub(crate) device_scene: DeviceScene,
    /// What it was prepared for last.
    pub(crate) target: Target,
    /// Depth of the host's shadow maps that it was prepared for last.
    pub(crate) cast_depth: Option<vk::Format>,
    instances: HashMap<u64, InstanceId>,
}

/// What a scene has; indices are below these.
#[repr(C)]
pub struct VairSceneInfo {
    /// Meshes.
    pub meshes: u32,
    /// Materials.
    pub materials: u32,
    /// Skins.
    pub skins: u32,
    /// Images, those of looks among them.
    pub images: u32,
    /// Animations.
    pub animations: u32,
    /// Scenes of the file.
    pub scenes: u32,
    /// Variants of materials.
    pub variants: u32,
    /// Instances that stand in it.
    pub instances: u32,
}

/// A mesh to place.
#[repr(C)]
pub struct VairInstanceDesc {
    /// Index of the mesh.
    pub mesh: u32,
    /// Index of a skin, for a mesh that joints carry, or VAIR_NONE.
    pub skin: u32,
    /// Index of the variant that it wears, or VAIR_NONE.
    pub variant: u32,
    /// Where it stands, 16 numbers, column by column. Joints carry a skinned mesh to the world, and this does not count for it.
    pub world_from_object: [f32; 16],
}

/// A scene of a .gltf or .glb file. Nothing is placed yet.
///
/// # Safety
/// `path` is text or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_load(path: *const c_char, scene: *mut *mut VairScene) -> VairResult {
    border(|| {
        // SAFETY: the caller's memory or NULL.
        let scene = unsafe { handle(scene, "scene") }?;
        // SAFETY: text of the caller's or NULL.
        let path = unsafe { text(path, "path") }?;
        *scene = VairScene::boxed(Scene::load(path, &LoadOptions::default())?);
        Ok(())
    })
}

/// Frees a scene. Frames in flight keep what they need. NULL is nothing.
///
/// # Safety
/// It is not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_free(scene: *mut VairScene) {
    // SAFETY: by this function's contract.
    border_of_free(|| unsafe { free(scene) });
}

/// What a scene has.
///
/// # Safety
/// The pointers are valid or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_info(scene: *const VairScene, info: *mut VairSceneInfo) -> VairResult {
    border(|| {
        // SAFETY: the caller's memory or NULL.
        let info = unsafe { result(info, "info") }?;
        // SAFETY: the caller's handle or NULL.
        let scene = &unsafe { shared(scene, "scene") }?.device_scene;
        let asset = scene.scene().asset();
        info.write(VairSceneInfo {
            meshes: asset.meshes.len() as u32,
            materials: asset.materials.len() as u32,
            skins: asset.skins.len() as u32,
            images: asset.images.len() as u32,
            animations: asset.animations.len() as u32,
            scenes: asset.scenes.len() as u32,
            variants: asset.variants.len() as u32,
            instances: scene.instance_count() as u32,
        });
        Ok(())
    })
}

/// The index of a material, by its name.
///
/// # Safety
/// The pointers are valid or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_find_material(
    scene: *const VairScene,
    name: *const c_char,
    material: *mut u32,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's memory or NULL.
        let material = unsafe { result(material, "material") }?;
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { shared(scene, "scene") }?.device_scene.scene();
        // SAFETY: text of the caller's or NULL.
        let name = unsafe { text(name, "name") }?;
        let found = scene.materials().iter().position(|material| material.name == name);
        let index = found.ok_or_else(|| {
            let names: Vec<&str> = scene.materials().iter().map(|material| material.name.as_str()).collect();
            Failure::scene(format!("no material {name:?}; there are {names:?}"))
        })?;
        material.write(index as u32);
        Ok(())
    })
}

/// How many joints a skin has: so many matrices vair_scene_set_joints() takes.
///
/// # Safety
/// The pointers are valid or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_joint_count(scene: *const VairScene, skin: u32, joints: *mut u32) -> VairResult {
    border(|| {
        // SAFETY: the caller's memory or NULL.
        let joints = unsafe { result(joints, "joints") }?;
        // SAFETY: the caller's handle or NULL.
        let skins = &unsafe { shared(scene, "scene") }?.device_scene.scene().asset().skins;
        let found = skins.get(skin as usize);
        let known = found.ok_or_else(|| Failure::scene(format!("no skin {skin}; the scene has {}", skins.len())))?;
        joints.write(known.joints.len() as u32);
        Ok(())
    })
}

/// Puts a look on the materials: the text of a look file (TOML). Images that it names are read from `folder`; NULL is the current
/// one. After an error the scene is not to be drawn.
///
/// # Safety
/// The pointers are valid or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_apply_look(
    scene: *mut VairScene,
    look: *const c_char,
    folder: *const c_char,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        // SAFETY: text of the caller's or NULL.
        let look = Look::parse(unsafe { text(look, "look") }?, "look")?;
        // SAFETY: text of the caller's or NULL.
        let folder = unsafe { optional_text(folder, "folder") }?.unwrap_or("");
        Ok(scene.device_scene.apply(&look, Path::new(folder), &LoadOptions::default())?)
    })
}

/// Puts a preset, for example "fox", on a material, by its name; NULL is every material. After an error the scene is not to be
/// drawn.
///
/// # Safety
/// The pointers are valid or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_apply_preset(
    scene: *mut VairScene,
    preset: *const c_char,
    material: *const c_char,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        // SAFETY: text of the caller's or NULL.
        let preset = unsafe { text(preset, "preset") }?;
        // SAFETY: text of the caller's or NULL.
        let material = unsafe { optional_text(material, "material") }?;
        let look = Look::preset(preset, material)?;
        Ok(scene.device_scene.apply(&look, Path::new(""), &LoadOptions::default())?)
    })
}

/// Sets a parameter of a material by its key in look files, for example "length". One uniform block is uploaded.
///
/// # Safety
/// The pointers are valid or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_set_number(
    scene: *mut VairScene,
    material: u32,
    key: *const c_char,
    number: f64,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        // SAFETY: text of the caller's or NULL.
        let key = unsafe { text(key, "key") }?;
        Ok(scene.device_scene.set_parameter(material as usize, key, &Value::Number(number))?)
    })
}

/// The same for a value of any kind, as look files write it (TOML): `0.03`, `"4%"`, `[0.5, 0.2, 0.1]`, `"#804020"`, `true`.
/// Textures come with vair_scene_apply_look().
///
/// # Safety
/// The pointers are valid or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_set_value(
    scene: *mut VairScene,
    material: u32,
    key: *const c_char,
    value: *const c_char,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        // SAFETY: text of the caller's or NULL.
        let key = unsafe { text(key, "key") }?;
        // SAFETY: text of the caller's or NULL.
        let written = unsafe { text(value, "value") }?;
        let value = DeValue::parse(written).map_err(|error| {
            let problem = error.message();
            Failure::material(format!("{key}: {written:?} is no TOML value ({problem}); text stands in quotes"))
        })?;
        Ok(scene.device_scene.set_parameter(material as usize, key, &Value::from(value.get_ref()))?)
    })
}

/// Places a mesh. A skinned one stands as it was bound until it is posed. `instance` becomes a number that no other instance of
/// the process has.
///
/// # Safety
/// The pointers are valid or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_add(
    scene: *mut VairScene,
    desc: *const VairInstanceDesc,
    instance: *mut u64,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's memory or NULL.
        let instance = unsafe { result(instance, "instance") }?;
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        // SAFETY: the caller's structure or NULL.
        let desc = unsafe { shared(desc, "desc") }?;
        let id = scene.device_scene.add(&InstanceDesc {
            mesh: desc.mesh as usize,
            skin: index_or_none(desc.skin),
            world_from_object: Mat4::from_cols_array(&desc.world_from_object),
            variant: index_or_none(desc.variant),
        })?;
        instance.write(scene.keep(id));
        Ok(())
    })
}

/// The first mesh at the origin.
#[unsafe(no_mangle)]
pub extern "C" fn vair_instance_desc_default() -> VairInstanceDesc {
    VairInstanceDesc {
        mesh: 0,
        skin: crate::VAIR_NONE,
        variant: crate::VAIR_NONE,
        world_from_object: Mat4::IDENTITY.to_cols_array(),
    }
}

/// Places all that a scene of the file shows, in its rest pose; vair_scene_pose_nodes() poses it. `count` becomes the number of
/// instances, and the first `capacity` of them are written to `instances`, which may be NULL where that is 0.
///
/// # Safety
/// The pointers are valid or NULL; `instances` holds `capacity` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_add_nodes(
    scene: *mut VairScene,
    scene_of_file: u32,
    variant: u32,
    instances: *mut u64,
    capacity: u32,
    count: *mut u32,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's memory or NULL.
        let count = unsafe { result(count, "count") }?;
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        // SAFETY: the caller's memory or NULL.
        let instances = unsafe { slice_mut(instances, capacity as usize, "instances") }?;
        let ids = scene.device_scene.add_nodes(scene_of_file as usize, index_or_none(variant))?;
        count.write(ids.len() as u32);
        let numbers: Vec<u64> = ids.into_iter().map(|id| scene.keep(id)).collect();
        for (slot, number) in instances.iter_mut().zip(numbers) {
            *slot = number;
        }
        Ok(())
    })
}

/// Poses what vair_scene_add_nodes() placed: at `time_s` of a clip, or at rest (VAIR_NONE). A clip holds its last pose.
///
/// # Safety
/// `scene` is valid or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_pose_nodes(scene: *mut VairScene, animation: u32, time_s: f32) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        Ok(scene.device_scene.pose_nodes(index_or_none(animation), time_s)?)
    })
}

/// Moves an instance: 16 numbers, column by column. Of a skinned one, only joints do.
///
/// # Safety
/// The pointers are valid or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_set_transform(
    scene: *mut VairScene,
    instance: u64,
    world_from_object: *const f32,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        // SAFETY: 16 numbers of the caller's or NULL.
        let world_from_object = unsafe { matrix(world_from_object, "world_from_object") }?;
        let id = scene.id(instance)?;
        Ok(scene.device_scene.set_transform(id, world_from_object)?)
    })
}

/// Poses a skinned instance: for each joint of its skin 16 numbers, column by column, where the joint is times the inverse of where it
/// was bound.
///
/// # Safety
/// The pointers are valid or NULL; `world_from_mesh` holds 16 numbers a joint.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_set_joints(
    scene: *mut VairScene,
    instance: u64,
    world_from_mesh: *const f32,
    joint_count: u32,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        // SAFETY: 16 numbers a joint, or NULL; arrays lie as their elements do.
        let given: &[[f32; 16]] = unsafe { slice(world_from_mesh.cast(), joint_count as usize, "world_from_mesh") }?;
        let id = scene.id(instance)?;
        let joints: Vec<Mat4> = given.iter().map(Mat4::from_cols_array).collect();
        Ok(scene.device_scene.set_joints(id, &joints)?)
    })
}

/// Sets the morph weights of an instance, one for each target of its mesh.
///
/// # Safety
/// The pointers are valid or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_set_morph_weights(
    scene: *mut VairScene,
    instance: u64,
    weights: *const f32,
    weight_count: u32,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        // SAFETY: as many numbers as the caller says, or NULL.
        let weights = unsafe { slice(weights, weight_count as usize, "weights") }?;
        let id = scene.id(instance)?;
        Ok(scene.device_scene.set_morph_weights(id, weights)?)
    })
}

/// Shows or hides an instance. Its pose and strands stay.
///
/// # Safety
/// `scene` is valid or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_set_visible(
    scene: *mut VairScene,
    instance: u64,
    is_visible: vk::Bool32,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        let id = scene.id(instance)?;
        Ok(scene.device_scene.set_visible(id, is_visible != vk::FALSE)?)
    })
}

/// Takes an instance away.
///
/// # Safety
/// `scene` is valid or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_remove(scene: *mut VairScene, instance: u64) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        let id = scene.id(instance)?;
        scene.device_scene.remove(id)?;
        scene.instances.remove(&instance);
        Ok(())
    })
}

/// Puts other pixels in the place of an image of the scene.
///
/// # Safety
/// The pointers are valid or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_set_image(
    scene: *mut VairScene,
    image: u32,
    pixels: *const VairPixels,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        // SAFETY: the caller's structure or NULL.
        let pixels = unsafe { shared(pixels, "pixels") }?;
        // SAFETY: by this function's contract.
        let pixels = unsafe { image_of(pixels, "pixels") }?;
        Ok(scene.device_scene.set_image(image as usize, pixels)?)
    })
}

/// An image of the host's stands for an image of the scene.
///
/// # Safety
/// The pointers are valid or NULL; the image is as for vair_image_new_on_host().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_set_host_image(
    scene: *mut VairScene,
    renderer: *mut VairRenderer,
    image: u32,
    host: *const VairHostImage,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        // SAFETY: the caller's handle or NULL.
        let gpu = &unsafe { exclusive(renderer, "renderer") }?.0.gpu;
        // SAFETY: by this function's contract.
        let lent = unsafe { borrow(gpu, host, "host") }?;
        Ok(scene.device_scene.set_host_image(image as usize, lent)?)
    })
}

/// Strands start from rest in the next frame, as after a cut.
///
/// # Safety
/// `scene` is valid or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_reset_dynamics(scene: *mut VairScene) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        unsafe { exclusive(scene, "scene") }?.device_scene.reset_dynamics();
        Ok(())
    })
}

impl VairScene {
    pub(crate) fn boxed(scene: Scene) -> *mut Self {
        let device_scene = DeviceScene::new(scene);
        Box::into_raw(Box::new(Self {
            device_scene,
            target: Target::hdr(1),
            cast_depth: None,
            instances: HashMap::new(),
        }))
    }

    /// The number by which the host knows an instance. None is ever given twice, so that no scene takes another's.
    fn keep(&mut self, id: InstanceId) -> u64 {
        static NEXT: AtomicU64 = AtomicU64::new(1);
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        self.instances.insert(number, id);
        number
    }

    fn id(&self, instance: u64) -> Result<InstanceId, Failure> {
        self.instances.get(&instance).copied().ok_or_else(|| {
            Failure::argument(format!("instance {instance} is of another scene, or has been removed: add it"))
        })
    }
}
