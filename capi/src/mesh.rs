//! Scenes made from a host's own arrays, which are copied.

use crate::index_or_none;
use crate::pointer::{handle, optional_text, shared, slice, text};
use crate::result::{Failure, VairResult, border};
use crate::scene::VairScene;
use glam::{Mat4, Vec2, Vec3, Vec4};
use std::ffi::c_char;
use vair::asset::{
    Asset, AssetScene, Image, Material, Mesh, MorphTarget, Node, Primitive, Skin, Texture, TextureRef, Vertices,
};
use vair::scene::Scene;

/// Joint influences a vertex.
const INFLUENCES: usize = 4;

/// Pixels in memory.
#[repr(C)]
pub struct VairPixels {
    /// Name in messages; NULL is none.
    pub name: *const c_char,
    /// Pixels, at least 1.
    pub width: u32,
    /// Pixels, at least 1.
    pub height: u32,
    /// width * height * 4 bytes, rows from the top, sRGB-coded where they are colours.
    pub rgba: *const u8,
}

/// A material before looks and presets dress it.
#[repr(C)]
pub struct VairMaterial {
    /// Name, by which looks know it.
    pub name: *const c_char,
    /// Linear RGBA.
    pub base_color: [f32; 4],
    /// Index of an image that it is multiplied with, or VAIR_NONE.
    pub base_color_image: u32,
    /// In [0, 1].
    pub metallic: f32,
    /// Perceptual, in [0, 1].
    pub roughness: f32,
}

/// A mesh of one material. Lists that are NULL are absent; others have an entry a vertex.
#[repr(C)]
pub struct VairMesh {
    /// Name in messages; NULL is none.
    pub name: *const c_char,
    /// Vertices.
    pub vertex_count: u32,
    /// Three numbers each, metres.
    pub positions: *const f32,
    /// Three numbers each, unit length.
    pub normals: *const f32,
    /// Four numbers each: unit length, and +1 or -1; bitangent = w * cross(normal, tangent). May be absent: they are made where a
    /// material needs them.
    pub tangents: *const f32,
    /// Two numbers each. Fur grows by them; it may also be absent.
    pub uvs: *const f32,
    /// Four numbers each, linear RGBA in [0, 1]. May be absent.
    pub colors: *const f32,
    /// Four each: joints of the mesh's skin. May be absent.
    pub joints: *const u16,
    /// Four each, of sum 1; present where joints are.
    pub weights: *const f32,
    /// Joints of its skin; 0 is none. Meshes with joints have a skin each, in their order.
    pub joint_count: u32,
    /// Three indices a triangle, counter-clockwise where it is seen from its front.
    pub indices: *const u32,
    /// A multiple of 3.
    pub index_count: u32,
    /// Index of its material.
    pub material: u32,
    /// Morph targets.
    pub morph_target_count: u32,
    /// Target by target, three numbers a vertex: what a weight of 1 adds to positions. Present where there are targets.
    pub morph_positions: *const f32,
    /// The same for normals. May be absent.
    pub morph_normals: *const f32,
}

/// A scene in memory. Nothing of it is used after the call.
#[repr(C)]
pub struct VairSceneDesc {
    /// Meshes.
    pub meshes: *const VairMesh,
    /// How many.
    pub mesh_count: u32,
    /// Materials.
    pub materials: *const VairMaterial,
    /// How many.
    pub material_count: u32,
    /// Images.
    pub images: *const VairPixels,
    /// How many.
    pub image_count: u32,
}

/// A scene from memory. Nothing is placed yet.
///
/// VAIR_ERROR_FILE: a list has another length than it should, an index points nowhere, a number is not finite or not in its range;
/// the message names the list and the entry.
///
/// # Safety
/// All pointers of the description are NULL or hold as many elements as it says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_new(desc: *const VairSceneDesc, scene: *mut *mut VairScene) -> VairResult {
    border(|| {
        // SAFETY: the caller's memory or NULL.
        let scene = unsafe { handle(scene, "scene") }?;
        // SAFETY: the caller's structure or NULL.
        let desc = unsafe { shared(desc, "desc") }?;
        // SAFETY: by this function's contract.
        let asset = unsafe { asset_of(desc) }?;
        *scene = VairScene::boxed(Scene::from_asset(asset)?);
        Ok(())
    })
}

/// # Safety
/// That of [`vair_scene_new`].
unsafe fn asset_of(desc: &VairSceneDesc) -> Result<Asset, Failure> {
    let mut asset = Asset { scenes: vec![AssetScene::default()], ..Asset::default() };
    // SAFETY: as many as the caller says, or NULL.
    let images = unsafe { slice(desc.images, desc.image_count as usize, "images") }?;
    for (index, pixels) in images.iter().enumerate() {
        // SAFETY: by this function's contract.
        let image = unsafe { image_of(pixels, &format!("images[{index}]")) }?;
        asset.images.push(image);
        asset.textures.push(Texture { image: index, ..Texture::default() });
    }
    // SAFETY: as many as the caller says, or NULL.
    let materials = unsafe { slice(desc.materials, desc.material_count as usize, "materials") }?;
    for (index, material) in materials.iter().enumerate() {
        // SAFETY: text of the caller's or NULL.
        let name = unsafe { text(material.name, &format!("materials[{index}].name")) }?;
        let texture_of = |texture| {
            let (offset, scale) = (Vec2::ZERO, Vec2::ONE);
            TextureRef { texture, uv_set: 0, offset, rotation: 0.0, scale }
        };
        asset.materials.push(Material {
            name: Some(name.to_owned()),
            base_color: Vec4::from_array(material.base_color),
            base_color_texture: index_or_none(material.base_color_image).map(texture_of),
            metallic: material.metallic,
            roughness: material.roughness,
            ..Material::default()
        });
    }
    // SAFETY: as many as the caller says, or NULL.
    let meshes = unsafe { slice(desc.meshes, desc.mesh_count as usize, "meshes") }?;
    for (index, mesh) in meshes.iter().enumerate() {
        // SAFETY: by this function's contract.
        unsafe { add_mesh(&mut asset, mesh, index) }?;
    }
    Ok(asset)
}

/// # Safety
/// That of [`vair_scene_new`].
pub(crate) unsafe fn image_of(pixels: &VairPixels, field: &str) -> Result<Image, Failure> {
    let bytes = (pixels.width as usize).checked_mul(pixels.height as usize).and_then(|texels| texels.checked_mul(4));
    let bytes = bytes.filter(|bytes| *bytes > 0).ok_or_else(|| {
        Failure::argument(format!("{field} has {} x {} pixels; give at least one", pixels.width, pixels.height))
    })?;
    // SAFETY: as many bytes as its size says, or NULL.
    let rgba = unsafe { slice(pixels.rgba, bytes, &format!("{field}.rgba")) }?;
    // SAFETY: text of the caller's or NULL.
    let name = unsafe { optional_text(pixels.name, &format!("{field}.name")) }?;
    Ok(Image {
        name: name.unwrap_or(field).to_owned(),
        width: pixels.width,
        height: pixels.height,
        rgba: rgba.to_vec(),
    })
}

/// Adds a mesh, its skin, and a node that shows it at the origin.
///
/// # Safety
/// That of [`vair_scene_new`].
unsafe fn add_mesh(asset: &mut Asset, mesh: &VairMesh, index: usize) -> Result<(), Failure> {
    let field = |name: &str| format!("meshes[{index}].{name}");
    let count = mesh.vertex_count as usize;
    // SAFETY: text of the caller's or NULL.
    let name = unsafe { optional_text(mesh.name, &field("name")) }?.map(str::to_owned);
    // SAFETY: as many numbers as the caller says, or NULL.
    let positions = unsafe { numbers(mesh.positions, count, &field("positions")) }?;
    // SAFETY: as above.
    let normals = unsafe { optional_numbers(mesh.normals, count, &field("normals")) }?;
    // SAFETY: as above.
    let tangents = unsafe { optional_numbers(mesh.tangents, count, &field("tangents")) }?;
    // SAFETY: as above.
    let uvs = unsafe { optional_numbers(mesh.uvs, count, &field("uvs")) }?;
    // SAFETY: as above.
    let colors = unsafe { optional_numbers(mesh.colors, count, &field("colors")) }?;
    // SAFETY: as above.
    let indices = unsafe { slice(mesh.indices, mesh.index_count as usize, &field("indices")) }?;
    let mut joints = Vec::new();
    if mesh.joint_count > 0 {
        // SAFETY: as above.
        let numbers: &[[u16; INFLUENCES]] = unsafe { slice(mesh.joints.cast(), count, &field("joints")) }?;
        // SAFETY: as above.
        let weights: &[[f32; INFLUENCES]] = unsafe { slice(mesh.weights.cast(), count, &field("weights")) }?;
        joints = numbers.iter().flatten().copied().zip(weights.iter().flatten().copied()).collect();
    }
    let targets = mesh.morph_target_count as usize;
    let offsets =
        targets.checked_mul(count).ok_or_else(|| Failure::argument(field("morph_target_count is too many")))?;
    let mut morph_targets = vec![MorphTarget::default(); if count == 0 { 0 } else { targets }];
    if !morph_targets.is_empty() {
        // SAFETY: as above.
        let positions = unsafe { numbers(mesh.morph_positions, offsets, &field("morph_positions")) }?;
        // SAFETY: as above.
        let normals = unsafe { optional_numbers(mesh.morph_normals, offsets, &field("morph_normals")) }?;
        for (target, positions) in morph_targets.iter_mut().zip(positions.chunks_exact(count)) {
            target.positions = positions.iter().copied().map(Vec3::from_array).collect();
        }
        for (target, normals) in morph_targets.iter_mut().zip(normals.chunks_exact(count)) {
            target.normals = normals.iter().copied().map(Vec3::from_array).collect();
        }
    }
    let weights = vec![0.0; morph_targets.len()];
    let vertices = Vertices {
        positions: positions.iter().copied().map(Vec3::from_array).collect(),
        normals: normals.iter().copied().map(Vec3::from_array).collect(),
        tangents: tangents.iter().copied().map(Vec4::from_array).collect(),
        uv_sets: if uvs.is_empty() { Vec::new() } else { vec![uvs.iter().copied().map(Vec2::from_array).collect()] },
        colors: colors.iter().copied().map(Vec4::from_array).collect(),
        influences_per_vertex: if joints.is_empty() { 0 } else { INFLUENCES },
        joints,
    };
    let indices = indices.to_vec();
    let primitive =
        Primitive { material: mesh.material as usize, indices, vertices, morph_targets, ..Primitive::default() };
    let mut node = Node { mesh: Some(asset.meshes.len()), ..Node::default() };
    if mesh.joint_count > 0 {
        // A host poses joints by matrices: their nodes stand where they were bound.
        let first = asset.nodes.len();
        let joints: Vec<usize> = (first..first + mesh.joint_count as usize).collect();
        asset.nodes.extend(joints.iter().map(|_| Node::default()));
        asset.scenes[0].roots.extend_from_slice(&joints);
        node.skin = Some(asset.skins.len());
        asset.skins.push(Skin { inverse_bind: vec![Mat4::IDENTITY; joints.len()], joints });
    }
    asset.scenes[0].roots.push(asset.nodes.len());
    asset.nodes.push(node);
    asset.meshes.push(Mesh { name, primitives: vec![primitive], weights });
    Ok(())
}

/// # Safety
/// NULL, or `count` times `N` numbers that nobody changes while the slice is used.
unsafe fn numbers<'a, const N: usize>(
    pointer: *const f32,
    count: usize,
    name: &str,
) -> Result<&'a [[f32; N]], Failure> {
    // SAFETY: arrays lie as their elements do.
    unsafe { slice(pointer.cast(), count, name) }
}

/// The same; none where the pointer is NULL.
///
/// # Safety
/// That of [`numbers`].
unsafe fn optional_numbers<'a, const N: usize>(
    pointer: *const f32,
    count: usize,
    name: &str,
) -> Result<&'a [[f32; N]], Failure> {
    if pointer.is_null() {
        return Ok(&[]);
    }
    // SAFETY: the contract is the same.
    unsafe { numbers(pointer, count, name) }
}
