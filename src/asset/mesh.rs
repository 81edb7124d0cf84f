//! Meshes: attributes, indices, normals, tangents.

use super::accessor::{Accessors, Normalize};
use super::context::Context;
use super::document::Document;
use super::{
    AssetError, MAX_UV_SETS, Material, Mesh, Primitive, Topology, Vertices, influence, morph, normal, tangent, topology,
};
use ::gltf::json;
use ::gltf::json::accessor::Type;
use ::gltf::json::mesh::{Mode, Semantic};
use ::gltf::json::validation::Checked;
use glam::{Vec2, Vec3, Vec4};

/// What primitives need of the rest of the file.
pub(super) struct Meshes<'a> {
    pub(super) context: &'a Context,
    pub(super) document: &'a Document,
    pub(super) accessors: &'a Accessors<'a>,
    /// The file's materials and, last, a default one for primitives without.
    pub(super) materials: &'a [Material],
}

/// Most morph targets of any primitive: what the mesh's weights count.
pub(super) fn target_count(mesh: &json::Mesh) -> usize {
    mesh.primitives.iter().map(|primitive| primitive.targets.as_ref().map_or(0, Vec::len)).max().unwrap_or(0)
}

/// `weights` made `count` long; missing ones are 0.
pub(super) fn fit_weights(
    context: &Context,
    field: &str,
    weights: &[f32],
    count: usize,
) -> Result<Vec<f32>, AssetError> {
    context.finite(field, weights)?;
    if !weights.is_empty() && weights.len() != count {
        let problem = format!("has {} entries for {count} morph targets; it is cut or filled with 0", weights.len());
        context.warn(field, problem);
    }
    context.spend(field, count as u64 * size_of::<f32>() as u64)?;
    let mut weights = weights.to_vec();
    weights.resize(count, 0.0);
    Ok(weights)
}

impl Meshes<'_> {
    /// All meshes of the file.
    ///
    /// # Errors
    /// Any index out of range, list of wrong length, number that is not finite.
    pub(super) fn read(&self) -> Result<Vec<Mesh>, AssetError> {
        let joint_counts = self.joint_counts();
        let mesh = |(m, json): (usize, &json::Mesh)| {
            let field = format!("meshes[{m}]");
            if json.primitives.is_empty() {
                return Err(self.context.error(&field, "has no primitives"));
            }
            let targets = target_count(json);
            let mut primitives = Vec::with_capacity(json.primitives.len());
            for (p, primitive) in json.primitives.iter().enumerate() {
                let place = format!("{field}.primitives[{p}]");
                primitives.extend(self.primitive(&field, &place, primitive, joint_counts[m], targets)?);
            }
            let weights = json.weights.as_deref().unwrap_or_default();
            let weights = fit_weights(self.context, &format!("{field}.weights"), weights, targets)?;
            Ok(Mesh { name: json.name.clone(), primitives, weights })
        };
        self.document.root.meshes.iter().enumerate().map(mesh).collect()
    }

    /// For each mesh the joints of the smallest skin that draws it.
    fn joint_counts(&self) -> Vec<Option<usize>> {
        let mut counts: Vec<Option<usize>> = vec![None; self.document.root.meshes.len()];
        for node in &self.document.root.nodes {
            let skin = node.skin.and_then(|skin| self.document.root.skins.get(skin.value()));
            if let (Some(skin), Some(count)) = (skin, node.mesh.and_then(|mesh| counts.get_mut(mesh.value()))) {
                let joints = skin.joints.len();
                *count = Some(count.map_or(joints, |smallest| smallest.min(joints)));
            }
        }
        counts
    }

    /// `None`, with a warning, where nothing can be drawn.
    fn primitive(
        &self,
        mesh: &str,
        field: &str,
        json: &json::mesh::Primitive,
        joint_count: Option<usize>,
        target_count: usize,
    ) -> Result<Option<Primitive>, AssetError> {
        let context = self.context;
        let here = format!("{field}.mode");
        let mode = self.document.code(&here, &json.mode);
        let mode = mode.map_err(|code| context.error(&here, format_args!("{code} does not exist")))?;
        let (material, variant_materials) = self.materials_of(field, json)?;
        if !json.attributes.contains_key(&Checked::Valid(Semantic::Positions)) {
            context.warn(field, "has no POSITION; it is skipped");
            return Ok(None);
        }
        let vertices = self.vertices(field, json, joint_count)?;
        let vertex_count = vertices.positions.len();
        let indices = self.indices(field, json, mode, vertex_count)?;
        if indices.is_empty() {
            context.warn(field, "has too few vertices to show anything; it is skipped");
            return Ok(None);
        }
        let morph_targets =
            morph::read(context, self.document, self.accessors, json, field, vertex_count, target_count)?;
        let topology = topology::of(mode);
        let mut primitive = Primitive { material, variant_materials, topology, indices, vertices, morph_targets };
        self.finish_normals(mesh, field, &mut primitive)?;
        self.finish_tangents(mesh, field, &mut primitive)?;
        Ok(Some(primitive))
    }

    /// The material, and the (variant, material) pairs.
    fn materials_of(
        &self,
        field: &str,
        json: &json::mesh::Primitive,
    ) -> Result<(usize, Vec<(usize, usize)>), AssetError> {
        let count = self.document.root.materials.len();
        let material = match json.material {
            Some(material) => {
                self.context.index(format_args!("{field}.material"), material.value(), "materials", count)?
            }
            None => count,
        };
        let variant_count = self.document.variants().len();
        let extension = json.extensions.as_ref().and_then(|extensions| extensions.khr_materials_variants.as_ref());
        let mut pairs = Vec::new();
        for (i, mapping) in extension.iter().flat_map(|extension| &extension.mappings).enumerate() {
            let here = format!("{field}.extensions.KHR_materials_variants.mappings[{i}]");
            let (material, context) = (mapping.material as usize, self.context);
            context.index(format_args!("{here}.material"), material, "materials", count)?;
            for &variant in &mapping.variants {
                context.index(format_args!("{here}.variants"), variant as usize, "variants", variant_count)?;
                pairs.push((variant as usize, material));
            }
        }
        Ok((material, pairs))
    }

    fn vertices(
        &self,
        field: &str,
        json: &json::mesh::Primitive,
        joint_count: Option<usize>,
    ) -> Result<Vertices, AssetError> {
        let (context, accessors) = (self.context, self.accessors);
        let field = format!("{field}.attributes");
        let mut vertices = Vertices::default();
        // In their order positions come before all that is counted against them.
        for (semantic, accessor) in &json.attributes {
            let Checked::Valid(semantic) = semantic else { continue };
            let (here, accessor) = (format!("{field}.{}", semantic.to_string()), accessor.value());
            let count = vertices.positions.len();
            let same_length = |len: usize| {
                let problem = || context.error(&here, format_args!("has {len} elements, POSITION has {count}"));
                if len == count { Ok(()) } else { Err(problem()) }
            };
            match *semantic {
                Semantic::Positions => {
                    let positions = accessors.floats::<3>(&here, accessor, Normalize::AsFlagged)?;
                    vertices.positions = positions.into_iter().map(Vec3::from).collect();
                }
                Semantic::Normals => {
                    let normals = accessors.floats::<3>(&here, accessor, Normalize::AsFlagged)?;
                    same_length(normals.len())?;
                    vertices.normals = normals.into_iter().map(Vec3::from).collect();
                }
                Semantic::Tangents => {
                    let tangents = accessors.floats::<4>(&here, accessor, Normalize::AsFlagged)?;
                    same_length(tangents.len())?;
                    vertices.tangents = tangents.into_iter().map(Vec4::from).collect();
                }
                Semantic::Colors(0) => {
                    vertices.colors = self.colors(&here, accessor)?;
                    same_length(vertices.colors.len())?;
                }
                Semantic::Colors(_) => context.warn(&here, "is not read"),
                Semantic::TexCoords(set) if (set as usize) < MAX_UV_SETS => {
                    let set = set as usize;
                    let uvs = accessors.floats::<2>(&here, accessor, Normalize::AsFlagged)?;
                    same_length(uvs.len())?;
                    if vertices.uv_sets.len() <= set {
                        vertices.uv_sets.resize(set + 1, Vec::new());
                    }
                    vertices.uv_sets[set] = uvs.into_iter().map(Vec2::from).collect();
                }
                Semantic::TexCoords(_) => {
                    context.warn(&here, format_args!("only {MAX_UV_SETS} UV sets are kept; ignored"));
                }
                Semantic::Joints(_) | Semantic::Weights(_) | Semantic::Extras(_) => {}
            }
        }
        for name in self.document.unknown_names(&field) {
            context.warn(format_args!("{field}.{name}"), "is not read");
        }
        let count = vertices.positions.len();
        if let Some(joint_count) = joint_count {
            (vertices.joints, vertices.influences_per_vertex) =
                influence::read(context, accessors, json, &field, count, joint_count)?;
        }
        Ok(vertices)
    }

    fn colors(&self, field: &str, accessor: usize) -> Result<Vec<Vec4>, AssetError> {
        let colors: Vec<Vec4> = match self.accessors.shape(field, accessor)? {
            Checked::Valid(Type::Vec3) => {
                let rgb = self.accessors.floats::<3>(field, accessor, Normalize::Always)?;
                rgb.into_iter().map(|rgb| Vec3::from(rgb).extend(1.0)).collect()
            }
            _ => {
                let rgba = self.accessors.floats::<4>(field, accessor, Normalize::Always)?;
                rgba.into_iter().map(Vec4::from).collect()
            }
        };
        let clamped: Vec<Vec4> = colors.iter().map(|color| color.clamp(Vec4::ZERO, Vec4::ONE)).collect();
        if clamped != colors {
            self.context.warn(field, "has colours outside [0, 1]; they are clamped");
        }
        Ok(clamped)
    }

    /// The index list, unrolled; each entry below `vertex_count`.
    fn indices(
        &self,
        field: &str,
        json: &json::mesh::Primitive,
        mode: Mode,
        vertex_count: usize,
    ) -> Result<Vec<u32>, AssetError> {
        let context = self.context;
        let here = format!("{field}.indices");
        let order: Vec<u32> = match json.indices {
            Some(accessor) => {
                let accessor = accessor.value();
                let order = self.accessors.unsigned::<1>(&here, accessor)?;
                for (i, &[index]) in order.iter().enumerate() {
                    if index as usize >= vertex_count {
                        let problem =
                            format!("element {i} is {index}, out of range: POSITION has {vertex_count} vertices");
                        return Err(context.error(format_args!("{here} (accessors[{accessor}])"), problem));
                    }
                }
                order.into_iter().flatten().collect()
            }
            None => {
                let count = u32::try_from(vertex_count)
                    .map_err(|_| context.error(field, format_args!("has {vertex_count} vertices, over 2^32")))?;
                (0..count).collect()
            }
        };
        context.spend(&here, order.len() as u64 * topology::growth(mode) * size_of::<u32>() as u64)?;
        let (list, rest) = topology::unroll(mode, order);
        if rest > 0 {
            context.warn(&here, format_args!("the last {rest} entries make no whole {mode:?} primitive; ignored"));
        }
        Ok(list)
    }

    fn finish_normals(&self, mesh: &str, field: &str, primitive: &mut Primitive) -> Result<(), AssetError> {
        let vertices = &mut primitive.vertices;
        if !vertices.normals.is_empty() {
            let indices: &[u32] = if primitive.topology == Topology::Triangles { &primitive.indices } else { &[] };
            if normal::normalize(&mut vertices.normals, &vertices.positions, indices) > 0 {
                self.context.warn(mesh, "has normals of length 0; the mean of their triangles is used");
            }
        } else if primitive.topology == Topology::Triangles {
            let bytes = normal::vertex_bytes(primitive) + size_of::<Vec3>() as u64;
            self.context.spend(field, bytes.saturating_mul(primitive.indices.len() as u64))?;
            if normal::flatten(primitive) > 0 {
                self.context.warn(mesh, "has triangles without area; their flat normals point up");
            }
        }
        Ok(())
    }

    fn finish_tangents(&self, mesh: &str, field: &str, primitive: &mut Primitive) -> Result<(), AssetError> {
        if primitive.vertices.normals.is_empty() {
            // Without normals a tangent means nothing (section 3.7.2.1).
            primitive.vertices.tangents.clear();
            return Ok(());
        }
        if !primitive.vertices.tangents.is_empty() {
            if tangent::normalize(&mut primitive.vertices.tangents, &primitive.vertices.normals) > 0 {
                self.context.warn(mesh, "has tangents of length 0; a perpendicular of the normal is used");
            }
            return Ok(());
        }
        let materials =
            std::iter::once(primitive.material).chain(primitive.variant_materials.iter().map(|pair| pair.1));
        let mut normal_maps = materials.filter_map(|m| self.materials.get(m)?.normal_texture);
        if primitive.topology != Topology::Triangles {
            return Ok(());
        }
        let Some(normal_map) = normal_maps.next() else { return Ok(()) };
        let (kept_bytes, scratch_bytes) = tangent::tangent_bytes(primitive);
        self.context.spend(field, kept_bytes)?;
        self.context.check(field, scratch_bytes)?;
        if let Err(reason) = tangent::generate_tangents(primitive, normal_map.uv_set as usize) {
            self.context.warn(field, reason);
        }
        Ok(())
    }
}
