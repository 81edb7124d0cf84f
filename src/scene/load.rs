//! A scene: a file's plain data, dressed with materials.

use super::SceneError;
use super::animation::pose;
use super::bounds::{JointBoxes, object_scale, world_hull, world_scale};
use super::facing::Clusters;
use super::lint;
use crate::asset::procedural::{SWATCH_MATERIAL, swatch};
use crate::asset::{
    self, Asset, AssetError, Image, LoadOptions, generate_tangents, generate_tangents_around_vertical, tangent_bytes,
};
use crate::material::{self, Family, ImageName, Look, Material, Standard, TextureSource, Value, presets};
use crate::math::{Aabb, Hull, Sphere};
use crate::scene::{Instance, Part, instances, parts};
use glam::Vec3;
use std::borrow::Cow;
use std::collections::HashMap;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// How large a mesh is in its rest pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Size {
    /// Radius of its positions' box, in their units, > 0.
    pub rest_radius: f32,
    /// World metres per unit of its positions, > 0.
    pub world_from_rest: f32,
}

impl Size {
    /// Its radius in the world: what relative lengths of fur are shares of.
    pub fn world_radius_m(self) -> f32 {
        self.rest_radius * self.world_from_rest
    }
}

/// Poses of a clip that its outline is taken from.
const OUTLINE_POSES: usize = 16;

type Outlines = HashMap<(usize, Option<usize>), Arc<Hull>>;

/// A file's plain data, dressed with materials.
#[derive(Debug)]
pub struct Scene {
    id: u64,
    revision: u64,
    asset: Asset,
    materials: Vec<Material>,
    /// Sizes of meshes by node: they need a rest pose, and every frame asks.
    sizes: Mutex<HashMap<usize, Size>>,
    /// Outlines by scene and clip, for the same reason.
    outlines: Mutex<Outlines>,
    /// Boxes around the positions by mesh and primitive.
    boxes: Mutex<HashMap<(usize, usize), Aabb>>,
    /// Boxes around what each joint moves, by mesh and primitive.
    joint_boxes: Mutex<HashMap<(usize, usize), JointBoxes>>,
    /// Depth-sorting clusters by mesh and primitive, of what blends.
    clusters: Mutex<HashMap<(usize, usize), Arc<Clusters>>>,
}

impl Scene {
    /// Loads a .gltf or .glb file. Images that its materials' `vair` keys name are read from its folder.
    ///
    /// # Errors
    /// When the file is not there, not glTF, not supported or not to be trusted; the error says where and what to do.
    pub fn load(path: impl AsRef<Path>, options: &LoadOptions) -> Result<Self, SceneError> {
        let path = path.as_ref();
        let mut asset = asset::load(path, options)?;
        let mut budget = Budget::of(&asset, path.display().to_string(), options);
        budget.spend("materials", (asset.materials.len() * size_of::<Material>()) as u64)?;
        let materials = material::from_asset(&mut asset, &mut images_of(folder_of(path), options, &mut budget))
            .map_err(|source| SceneError::Keys { file: path.to_owned(), source: Box::new(source) })?;
        complete(&mut asset, &materials, &mut budget)?;
        asset.loaded_bytes = budget.spent_bytes;
        Ok(Self::new(asset, materials))
    }

    /// The embedded gallery: what the program is for, by formulas alone.
    pub fn gallery() -> Self {
        Self::from_asset(asset::procedural::gallery())
            .unwrap_or_else(|error| unreachable!("the gallery is ours and tested: {error}"))
    }

    /// A sample of a preset: cloth hangs over a ball of stone, fur grows on a ball.
    ///
    /// # Errors
    /// No preset of that name.
    pub fn swatch(preset: &str) -> Result<Self, SceneError> {
        let look = Look::preset(preset, Some(SWATCH_MATERIAL))?;
        let is_fur = presets().iter().any(|known| known.is_named(preset) && known.kind() == "fur");
        let mut scene = Self::from_asset(swatch(!is_fur))?;
        scene.apply(&look, Path::new(""), &LoadOptions::default())?;
        Ok(scene)
    }

    /// Dresses plain data with the materials that it names.
    ///
    /// # Errors
    /// When the data breaks a promise of [`Asset`], or a material's `vair` keys are wrong.
    pub fn from_asset(mut asset: Asset) -> Result<Self, SceneError> {
        asset::check(&asset)?;
        let materials = material::from_asset(&mut asset, &mut |file| {
            Err(format!("{file}: a scene made in memory has no folder; use a procedural texture"))
        })?;
        let unlimited = LoadOptions { memory_limit_bytes: u64::MAX, ..LoadOptions::default() };
        let mut budget = Budget::of(&asset, "scene".to_owned(), &unlimited);
        complete(&mut asset, &materials, &mut budget)?;
        Ok(Self::new(asset, materials))
    }

    /// Puts a look on the materials; its images are read from `folder`. After an error the scene is not to be shown.
    ///
    /// # Errors
    /// When a key, a value, a file or a material name is wrong; the error names the line.
    pub fn apply(&mut self, look: &Look, folder: &Path, options: &LoadOptions) -> Result<(), SceneError> {
        let mut budget = Budget::of(&self.asset, "look".to_owned(), options);
        let asset = &mut self.asset;
        look.apply(asset, &mut self.materials, &mut images_of(folder, options, &mut budget))?;
        complete(asset, &self.materials, &mut budget)?;
        asset.loaded_bytes = budget.spent_bytes;
        // Lengths of fur may have changed, and with them the outline.
        *self.outlines.get_mut().unwrap_or_else(PoisonError::into_inner) = HashMap::new();
        self.revision += 1;
        Ok(())
    }

    /// Reads a look file and puts it on the materials; its images are read from its folder.
    ///
    /// # Errors
    /// Those of [`Scene::apply`], and when the file cannot be read or is not text.
    pub fn apply_file(&mut self, path: impl AsRef<Path>, options: &LoadOptions) -> Result<(), SceneError> {
        let path = path.as_ref();
        let file = path.display().to_string();
        let bytes = asset::read_file(path, options.memory_limit_bytes.min(MAX_LOOK_BYTES))?;
        let text = String::from_utf8(bytes).map_err(|error| {
            let at = error.utf8_error().valid_up_to();
            let problem = format!("byte {at} is not UTF-8 text; save the look as UTF-8");
            SceneError::from(AssetError::Format { file: file.clone(), field: "text".to_owned(), problem })
        })?;
        self.apply(&Look::parse(&text, &file)?, folder_of(path), options)
    }

    fn new(asset: Asset, materials: Vec<Material>) -> Self {
        let (sizes, outlines, boxes, joint_boxes, clusters) = Default::default();
        Self { id: new_id(), revision: 0, asset, materials, sizes, outlines, boxes, joint_boxes, clusters }
    }

    /// What the file says, and the pictures that looks brought along.
    pub fn asset(&self) -> &Asset {
        &self.asset
    }

    /// One per material of the asset, in its order.
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// The same, to change parameters: the next frame shows them. A normal map on a mesh without tangents needs
    /// [`Self::apply`], which makes them.
    pub fn materials_mut(&mut self) -> &mut [Material] {
        self.revision += 1;
        *self.outlines.get_mut().unwrap_or_else(PoisonError::into_inner) = HashMap::new();
        &mut self.materials
    }

    /// Sets a parameter of a material by its key in look files; the next frame shows it, and nothing but its uniform block is
    /// uploaded. Textures come with [`Self::apply`].
    ///
    /// # Errors
    /// A material that there is not, a key that it has not, a value of the wrong type or outside its range.
    pub fn set_parameter(&mut self, material: usize, key: &str, value: &Value) -> Result<(), SceneError> {
        let available = || {
            let names = self.materials.iter().enumerate();
            names.map(|(index, material)| format!("{index} {:?}", material.name)).collect()
        };
        let Some(known) = self.materials.get(material) else {
            return Err(SceneError::Unknown { kind: "material", asked: material.to_string(), available: available() });
        };
        let mut changed = known.clone();
        changed
            .set(key, value, &mut NoTextures)
            .map_err(|source| SceneError::Parameter { material: changed.name.clone(), source: Box::new(source) })?;
        self.materials_mut()[material] = changed;
        Ok(())
    }

    /// Puts another picture in the place of an image.
    ///
    /// # Errors
    /// An image that there is not; bytes that are not four a texel.
    pub fn set_image(&mut self, index: usize, image: Image) -> Result<(), SceneError> {
        let count = self.asset.images.len();
        let wrong = |problem: String| {
            let (file, field) = ("scene".to_owned(), format!("images[{index}]"));
            SceneError::from(AssetError::Format { file, field, problem })
        };
        if index >= count {
            return Err(wrong(format!("does not exist; the scene has {count} images")));
        }
        let texels = u64::from(image.width) * u64::from(image.height);
        if texels == 0 || texels.saturating_mul(4) != image.rgba.len() as u64 {
            let (width, height, bytes) = (image.width, image.height, image.rgba.len());
            return Err(wrong(format!(
                "{bytes} bytes given for {width} x {height} texels; give four a texel, at least one"
            )));
        }
        self.asset.images[index] = image;
        self.revision += 1;
        Ok(())
    }

    /// No two scenes that were loaded or made have the same. What a device keeps of meshes and images goes by it: changes
    /// to a scene add to them and take nothing back.
    pub fn id(&self) -> u64 {
        self.id
    }

    /// Grows whenever materials change.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// The surface of a material; under fur it is the skin, which continues the fur's roots.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn standard(&self, material: usize, under_fur: bool) -> Cow<'_, Standard> {
        let Material { standard, fur, .. } = &self.materials[material];
        match fur {
            Some(fur) if under_fur => Cow::Owned(fur.skin(standard)),
            _ => Cow::Borrowed(standard),
        }
    }

    /// What the surface of a material is woven of; the skin under fur is standard.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn family(&self, material: usize, under_fur: bool) -> Option<&Family> {
        self.materials[material].family.as_ref().filter(|_| !under_fur)
    }

    /// Outline of a scene and its fur over a whole clip, so that a sequence is framed once and every frame of it alike;
    /// of the rest pose without a clip.
    pub fn outline(&self, scene: usize, animation: Option<usize>) -> Arc<Hull> {
        let mut outlines = self.outlines.lock().unwrap_or_else(PoisonError::into_inner);
        let make = || {
            let duration_s = animation.map_or(0.0, |index| self.asset.animations[index].duration_s);
            let poses = if duration_s > 0.0 { OUTLINE_POSES } else { 1 };
            let mut hull = Hull::default();
            for index in 0..poses {
                let time_s = duration_s * index as f32 / poses as f32;
                hull.extend(world_hull(&self.asset, scene, &pose(&self.asset, animation, time_s)).points());
            }
            Arc::new(hull.grown(self.longest_fur_m(scene)))
        };
        outlines.entry((scene, animation)).or_insert_with(make).clone()
    }

    /// Length of the longest strands in a scene, metres.
    fn longest_fur_m(&self, scene: usize) -> f32 {
        let rest = pose(&self.asset, None, 0.0);
        let instances = instances(&self.asset, scene, &rest);
        let all = parts(&self.asset, &instances, None).into_iter();
        all.map(|part| self.fur_m(part.material, self.size(&instances[part.instance]))).fold(0.0, f32::max)
    }

    /// Length of a material's strands on a mesh of that size, metres; 0 without fur.
    fn fur_m(&self, material: usize, size: Size) -> f32 {
        self.materials[material].fur.as_ref().map_or(0.0, |fur| fur.length.metres(size.world_radius_m()))
    }

    /// A sphere around a part of an instance of that size, and its fur; one of what bends is around all that there is,
    /// `whole`. Too large rather than too small, and endless where that is not known.
    pub fn bounding_sphere(&self, part: Part, instance: &Instance, size: Size, whole: Option<Sphere>) -> Sphere {
        let primitive = &self.asset.meshes[part.mesh].primitives[part.primitive];
        if instance.skin.is_some() || !primitive.morph_targets.is_empty() {
            return whole.unwrap_or(Sphere { center: Vec3::ZERO, radius: f32::INFINITY });
        }
        let mut boxes = self.boxes.lock().unwrap_or_else(PoisonError::into_inner);
        let make = || Aabb::around(primitive.vertices.positions.iter().copied());
        let bounds = *boxes.entry((part.mesh, part.primitive)).or_insert_with(make);
        let Sphere { center, radius } = bounds.transformed(instance.world_from_object).sphere();
        Sphere { center, radius: radius + self.fur_m(part.material, size) }
    }

    /// A sphere around a part of an instance of that size, as it is posed, and its fur. Too large rather than too small.
    pub fn posed_sphere(&self, part: Part, instance: &Instance, size: Size) -> Sphere {
        let primitive = &self.asset.meshes[part.mesh].primitives[part.primitive];
        let mut boxes = self.joint_boxes.lock().unwrap_or_else(PoisonError::into_inner);
        let boxes = boxes.entry((part.mesh, part.primitive)).or_insert_with(|| JointBoxes::of(primitive));
        let bounds = boxes.posed(&instance.joints, &instance.morph_weights);
        let Sphere { center, radius } = bounds.transformed(instance.world_from_object).sphere();
        Sphere { center, radius: radius + self.fur_m(part.material, size) }
    }

    /// How large an instance's mesh is: in the rest pose of its node, or as it stands where a host has placed it.
    pub fn size(&self, instance: &Instance) -> Size {
        let measure = |world_from_rest| {
            let primitives = &self.asset.meshes[instance.mesh].primitives;
            let positions = primitives.iter().flat_map(|primitive| &primitive.vertices.positions);
            let rest_radius = Aabb::around(positions.copied()).half_extent().length().max(f32::MIN_POSITIVE);
            Size { rest_radius, world_from_rest }
        };
        let Some(node) = instance.node else {
            let Instance { mesh, world_from_object, joints, morph_weights, .. } = instance;
            return measure(world_scale(&self.asset, *mesh, *world_from_object, joints, morph_weights));
        };
        let mut sizes = self.sizes.lock().unwrap_or_else(PoisonError::into_inner);
        *sizes.entry(node).or_insert_with(|| measure(object_scale(&self.asset, node)))
    }

    /// The depth-sorting clusters of a primitive's triangles.
    pub fn clusters(&self, mesh: usize, primitive: usize) -> Arc<Clusters> {
        let mut clusters = self.clusters.lock().unwrap_or_else(PoisonError::into_inner);
        let make = || Arc::new(Clusters::of(&self.asset.meshes[mesh].primitives[primitive]));
        clusters.entry((mesh, primitive)).or_insert_with(make).clone()
    }
}

/// Of parameters that are set one by one.
struct NoTextures;

impl TextureSource for NoTextures {
    fn texture(&mut self, _: &ImageName) -> Result<usize, String> {
        Err("textures are not set one by one; put them on with a look".to_owned())
    }
}

/// A look is written by hand: what is larger is another file.
const MAX_LOOK_BYTES: u64 = 16 << 20;

/// The folder that a file's own references start from.
fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// What a load and all looks after it may take together.
struct Budget {
    file: String,
    spent_bytes: u64,
    limit_bytes: u64,
}

impl Budget {
    /// Goes on where the asset's load ended; `file` is who errors name.
    fn of(asset: &Asset, file: String, options: &LoadOptions) -> Self {
        Self { file, spent_bytes: asset.loaded_bytes, limit_bytes: options.memory_limit_bytes }
    }

    fn left_bytes(&self) -> u64 {
        self.limit_bytes.saturating_sub(self.spent_bytes)
    }

    /// Refuses bytes that would go over the limit, for what lives only a moment. Returns the sum with all before it.
    fn check(&self, field: &str, bytes: u64) -> Result<u64, AssetError> {
        let (needed_bytes, limit_bytes) = (self.spent_bytes.saturating_add(bytes), self.limit_bytes);
        if needed_bytes > limit_bytes {
            let (file, field) = (self.file.clone(), field.to_owned());
            return Err(AssetError::Memory { file, field, needed_bytes, limit_bytes });
        }
        Ok(needed_bytes)
    }

    /// Counts bytes; call before they are allocated.
    fn spend(&mut self, field: &str, bytes: u64) -> Result<(), AssetError> {
        self.spent_bytes = self.check(field, bytes)?;
        Ok(())
    }
}

/// Reads the images that looks name.
fn images_of(folder: &Path, options: &LoadOptions, budget: &mut Budget) -> impl FnMut(&str) -> Result<Image, String> {
    move |file| {
        let left = LoadOptions { memory_limit_bytes: budget.left_bytes(), ..options.clone() };
        let image = asset::read_inside(folder, file, &left)
            .and_then(|bytes| {
                let left_bytes = left.memory_limit_bytes.saturating_sub(bytes.len() as u64);
                asset::decode_image(&bytes, file, left_bytes)
            })
            .map_err(|error| error.to_string())?;
        // With the smaller levels that the device gets.
        let bytes = image.rgba.len() as u64;
        budget.spend(file, bytes + bytes / 3).map_err(|error| error.to_string())?;
        Ok(image)
    }
}

fn new_id() -> u64 {
    static NEXT_ID: AtomicU64 = AtomicU64::new(1);
    NEXT_ID.fetch_add(1, Ordering::Relaxed)
}

/// What the materials need of the meshes, and warnings for what they cannot have.
fn complete(asset: &mut Asset, materials: &[Material], budget: &mut Budget) -> Result<(), AssetError> {
    add_missing_tangents(asset, materials, budget)?;
    lint::maps(asset, materials);
    Ok(())
}

/// A look may put a normal map, or cloth, where the file had none. Threads run along u, or around the vertical where there
/// are no texture coordinates; a normal map needs them, and a warning says where they lack.
fn add_missing_tangents(asset: &mut Asset, materials: &[Material], budget: &mut Budget) -> Result<(), AssetError> {
    for (m, mesh) in asset.meshes.iter_mut().enumerate() {
        for (p, primitive) in mesh.primitives.iter_mut().enumerate() {
            let variants = primitive.variant_materials.iter().map(|&(_, material)| material);
            let used = || std::iter::once(primitive.material).chain(variants.clone()).map(|index| &materials[index]);
            let map = used().find_map(|Material { standard, .. }| {
                standard.normal_texture.or(standard.detail_normal_texture).or(standard.detail_albedo_texture)
            });
            let is_woven = used().any(|material| material.family.is_some());
            if !primitive.vertices.tangents.is_empty() || map.is_none() && !is_woven {
                continue;
            }
            let field = format!("meshes[{m}].primitives[{p}]");
            let (kept_bytes, scratch_bytes) = tangent_bytes(primitive);
            budget.check(&field, kept_bytes.saturating_add(scratch_bytes))?;
            match generate_tangents(primitive, map.map_or(0, |map| map.uv_set as usize)) {
                Ok(()) => budget.spend(&field, kept_bytes)?,
                Err(_) if map.is_none() => {
                    generate_tangents_around_vertical(primitive);
                    budget.spend(&field, size_of_val(primitive.vertices.tangents.as_slice()) as u64)?;
                }
                Err(reason) => {
                    if is_woven {
                        generate_tangents_around_vertical(primitive);
                        budget.spend(&field, size_of_val(primitive.vertices.tangents.as_slice()) as u64)?;
                    }
                    let warning = format!("{field}: {reason}");
                    if !asset.warnings.contains(&warning) {
                        asset.warnings.push(warning);
                    }
                }
            }
        }
    }
    Ok(())
}
