//! The promises of [`Asset`] for data that no file loader made: an engine's own scenes.
//!
//! The loader keeps what the doc comments of the model say; whoever fills an [`Asset`] by hand may not. Later rooms index
//! and divide by it unasked, so it is checked once, on the way in, in time linear in its size and without recursion.

use super::context::Context;
use super::node::in_cycle;
use super::{
    AlphaMode, Animation, Asset, AssetError, Camera, Channel, Interpolation, Keys, Light, LightKind, LoadOptions,
    MAX_IMAGE_SIDE_PX, MAX_UV_SETS, Material, Mesh, MorphTarget, Node, Primitive, Projection, Skin, TextureRef,
    Topology, Transform, Vertices,
};
use glam::{Quat, Vec3};
use std::f32::consts::{FRAC_PI_2, PI};
use std::fmt::Display;
use std::path::Path;

/// How far from 1 a length or a sum of weights may be; what 8-bit files round to is finer.
const UNIT_TOLERANCE: f32 = 1e-2;

/// Of rotation keys, which come in as few as 8 bits.
const KEY_UNIT_TOLERANCE: f32 = 2e-2;

/// Influences come in sets of four.
const PER_SET: usize = 4;

/// [0, 1].
const SHARE: (f32, f32) = (0.0, 1.0);
const POSITIVE: (f32, f32) = (0.0, f32::MAX);
const ANY: (f32, f32) = (f32::MIN, f32::MAX);

/// Whether an asset keeps every promise of its doc comments.
///
/// # Errors
/// [`AssetError::Format`] for the first that it breaks, with the field, its value and what to write instead.
pub fn check(asset: &Asset) -> Result<(), AssetError> {
    let context = Context::new(Path::new("scene"), &LoadOptions::default());
    Check { asset, context: &context }.all()
}

struct Check<'a> {
    asset: &'a Asset,
    context: &'a Context,
}

impl Check<'_> {
    fn all(&self) -> Result<(), AssetError> {
        let asset = self.asset;
        self.forest()?;
        self.scenes()?;
        each("nodes", &asset.nodes, |field, node| self.node(field, node))?;
        let joint_counts = self.joint_counts();
        for (m, mesh) in asset.meshes.iter().enumerate() {
            self.mesh(&format!("meshes[{m}]"), mesh, joint_counts[m])?;
        }
        for (t, texture) in asset.textures.iter().enumerate() {
            self.index(format_args!("textures[{t}].image"), texture.image, "images", asset.images.len())?;
        }
        each("images", &asset.images, |field, image| {
            let (width, height, len) = (image.width, image.height, image.rgba.len() as u64);
            let needed = u64::from(width) * u64::from(height) * 4;
            self.require(len == needed, format_args!("{field}.rgba"), || {
                format!("has {len} bytes; {width} x {height} pixels need {needed}")
            })?;
            self.require(width.max(height) <= MAX_IMAGE_SIDE_PX, field, || {
                format!("is {width} x {height} pixels; make its sides at most {MAX_IMAGE_SIDE_PX}")
            })
        })?;
        each("materials", &asset.materials, |field, material| self.material(field, material))?;
        each("cameras", &asset.cameras, |field, camera| self.camera(field, camera))?;
        each("lights", &asset.lights, |field, light| self.light(field, light))?;
        each("skins", &asset.skins, |field, skin| self.skin(field, skin))?;
        each("animations", &asset.animations, |field, animation| self.animation(field, animation))
    }

    fn require(&self, good: bool, field: impl Display, problem: impl FnOnce() -> String) -> Result<(), AssetError> {
        if good { Ok(()) } else { Err(self.context.error(field, problem())) }
    }

    fn index(&self, field: impl Display, index: usize, list: &str, len: usize) -> Result<(), AssetError> {
        self.require(index < len, field, || {
            format!("index {index} is out of range: {list} has {len} entries; name one of them, or add it")
        })
    }

    /// A list that is absent or has one entry a vertex.
    fn length(&self, field: impl Display, len: usize, vertices: usize) -> Result<(), AssetError> {
        self.require(len == 0 || len == vertices, field, || {
            format!("has {len} entries for {vertices} positions; give one each, or none")
        })
    }

    fn finite<const N: usize>(
        &self,
        field: impl Display,
        list: impl IntoIterator<Item = [f32; N]>,
    ) -> Result<(), AssetError> {
        let bad = list.into_iter().enumerate().find(|(_, entry)| entry.iter().any(|number| !number.is_finite()));
        self.require(bad.is_none(), field, || {
            let (i, entry) = bad.unwrap_or((0, [0.0; N]));
            format!("entry {i} is {entry:?}; write finite numbers")
        })
    }

    fn unit(
        &self,
        field: impl Display,
        lengths: impl IntoIterator<Item = f32>,
        tolerance: f32,
    ) -> Result<(), AssetError> {
        let is_unit = |length: f32| (length - 1.0).abs() <= tolerance;
        let bad = lengths.into_iter().enumerate().find(|(_, length)| !is_unit(*length));
        self.require(bad.is_none(), field, || {
            let (i, length) = bad.unwrap_or_default();
            format!("entry {i} is of length {length}; normalise it")
        })
    }

    fn within(&self, field: impl Display, number: f32, (least, most): (f32, f32)) -> Result<(), AssetError> {
        self.require(number >= least && number <= most, field, || {
            let range = match (least, most) {
                ANY => "a finite number".to_owned(),
                (least, f32::MAX) => format!("a finite number >= {least}"),
                _ => format!("a number in [{least}, {most}]"),
            };
            format!("is {number}; write {range}")
        })
    }

    fn forest(&self) -> Result<(), AssetError> {
        let nodes = &self.asset.nodes;
        let mut parents: Vec<Option<usize>> = vec![None; nodes.len()];
        for (n, node) in nodes.iter().enumerate() {
            for (c, &child) in node.children.iter().enumerate() {
                self.index(format_args!("nodes[{n}].children[{c}]"), child, "nodes", nodes.len())?;
                let other = parents[child].replace(n);
                self.require(other.is_none(), format_args!("nodes[{child}]"), || {
                    format!("has two parents, nodes[{}] and nodes[{n}]; give it one", other.unwrap_or(n))
                })?;
            }
        }
        let cycle = in_cycle(&parents);
        self.require(cycle.is_none(), format_args!("nodes[{}]", cycle.unwrap_or(0)), || {
            "is its own ancestor; break the cycle of children".to_owned()
        })?;
        let mut scene_of: Vec<Option<usize>> = vec![None; nodes.len()];
        for (s, scene) in self.asset.scenes.iter().enumerate() {
            for (r, &root) in scene.roots.iter().enumerate() {
                let field = format_args!("scenes[{s}].roots[{r}]").to_string();
                self.index(&field, root, "nodes", nodes.len())?;
                self.require(parents[root].is_none(), &field, || {
                    format!("nodes[{root}] is a child of another node; name the root above it")
                })?;
                self.require(scene_of[root].replace(s) != Some(s), &field, || {
                    format!("nodes[{root}] is in this scene already; name it once")
                })?;
            }
        }
        Ok(())
    }

    fn scenes(&self) -> Result<(), AssetError> {
        let count = self.asset.scenes.len();
        self.require(count > 0, "scenes", || "is empty; add a scene that names the root nodes".to_owned())?;
        self.index("default_scene", self.asset.default_scene, "scenes", count)
    }

    fn node(&self, field: &str, node: &Node) -> Result<(), AssetError> {
        let asset = self.asset;
        for (name, index, list, len) in [
            ("mesh", node.mesh, "meshes", asset.meshes.len()),
            ("skin", node.skin, "skins", asset.skins.len()),
            ("camera", node.camera, "cameras", asset.cameras.len()),
            ("light", node.light, "lights", asset.lights.len()),
        ] {
            if let Some(index) = index {
                self.index(format_args!("{field}.{name}"), index, list, len)?;
            }
        }
        match node.transform {
            Transform::Matrix(matrix) => {
                self.finite(format_args!("{field}.transform.matrix"), [matrix.to_cols_array()])?;
            }
            Transform::Trs { translation, rotation, scale } => {
                self.finite(format_args!("{field}.transform.translation"), [translation.to_array()])?;
                self.finite(format_args!("{field}.transform.scale"), [scale.to_array()])?;
                self.unit(format_args!("{field}.transform.rotation"), [rotation.length()], UNIT_TOLERANCE)?;
            }
        }
        let targets = node.mesh.map_or(0, |mesh| asset.meshes[mesh].weights.len());
        let count = node.weights.len();
        self.require(count == 0 || count == targets, format_args!("{field}.weights"), || {
            format!("has {count} entries for {targets} morph targets of its mesh; give one each, or none")
        })?;
        self.finite(format_args!("{field}.weights"), node.weights.iter().map(|weight| [*weight]))
    }

    /// For each mesh the joints of the smallest skin that draws it.
    fn joint_counts(&self) -> Vec<Option<usize>> {
        let mut counts: Vec<Option<usize>> = vec![None; self.asset.meshes.len()];
        for node in &self.asset.nodes {
            if let (Some(mesh), Some(skin)) = (node.mesh, node.skin) {
                let joints = self.asset.skins[skin].joints.len();
                counts[mesh] = Some(counts[mesh].map_or(joints, |smallest| smallest.min(joints)));
            }
        }
        counts
    }

    fn mesh(&self, field: &str, mesh: &Mesh, joint_count: Option<usize>) -> Result<(), AssetError> {
        self.finite(format_args!("{field}.weights"), mesh.weights.iter().map(|weight| [*weight]))?;
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let field = format!("{field}.primitives[{p}]");
            self.primitive(&field, primitive)?;
            self.vertices(&format!("{field}.vertices"), &primitive.vertices, primitive.topology)?;
            self.joints(&format!("{field}.vertices.joints"), &primitive.vertices, joint_count)?;
            let (targets, weights) = (&primitive.morph_targets, mesh.weights.len());
            self.require(targets.len() == weights, format_args!("{field}.morph_targets"), || {
                format!("has {} entries, the mesh {weights} weights; give one of each a target", targets.len())
            })?;
            for (t, target) in targets.iter().enumerate() {
                let MorphTarget { positions, normals, tangents } = target;
                for (name, list) in [("positions", positions), ("normals", normals), ("tangents", tangents)] {
                    let field = format!("{field}.morph_targets[{t}].{name}");
                    self.length(&field, list.len(), primitive.vertices.positions.len())?;
                    self.finite(&field, list.iter().map(Vec3::to_array))?;
                }
            }
        }
        Ok(())
    }

    fn primitive(&self, field: &str, primitive: &Primitive) -> Result<(), AssetError> {
        let materials = self.asset.materials.len();
        self.index(format_args!("{field}.material"), primitive.material, "materials", materials)?;
        for (i, &(variant, material)) in primitive.variant_materials.iter().enumerate() {
            let field = format!("{field}.variant_materials[{i}]");
            self.index(&field, variant, "variants", self.asset.variants.len())?;
            self.index(&field, material, "materials", materials)?;
        }
        let (corners, name) = match primitive.topology {
            Topology::Points => (1, "point"),
            Topology::Lines => (2, "line"),
            Topology::Triangles => (3, "triangle"),
        };
        let (indices, vertices) = (&primitive.indices, primitive.vertices.positions.len());
        self.require(!indices.is_empty() && indices.len() % corners == 0, format_args!("{field}.indices"), || {
            format!("has {} entries; give {corners} a {name}, for one {name} at least", indices.len())
        })?;
        let outside = indices.iter().position(|index| *index as usize >= vertices);
        self.require(outside.is_none(), format_args!("{field}.indices"), || {
            let at = outside.unwrap_or(0);
            format!("entry {at} is {}, out of range: there are {vertices} positions; name one of them", indices[at])
        })
    }

    fn vertices(&self, field: &str, vertices: &Vertices, topology: Topology) -> Result<(), AssetError> {
        let count = vertices.positions.len();
        self.finite(format_args!("{field}.positions"), vertices.positions.iter().map(Vec3::to_array))?;
        self.length(format_args!("{field}.normals"), vertices.normals.len(), count)?;
        let has_normals = topology != Topology::Triangles || !vertices.normals.is_empty();
        self.require(has_normals, format_args!("{field}.normals"), || {
            "has 0 entries; triangles need one for each position".to_owned()
        })?;
        let lengths = vertices.normals.iter().map(|normal| normal.length());
        self.unit(format_args!("{field}.normals"), lengths, UNIT_TOLERANCE)?;
        self.length(format_args!("{field}.tangents"), vertices.tangents.len(), count)?;
        let lengths = vertices.tangents.iter().map(|tangent| tangent.truncate().length());
        self.unit(format_args!("{field}.tangents"), lengths, UNIT_TOLERANCE)?;
        let hand = vertices.tangents.iter().position(|tangent| tangent.w.abs() != 1.0);
        self.require(hand.is_none(), format_args!("{field}.tangents"), || {
            let at = hand.unwrap_or(0);
            format!("entry {at} has w = {}; write 1 or -1, the side of the bitangent", vertices.tangents[at].w)
        })?;
        let sets = vertices.uv_sets.len();
        self.require(sets <= MAX_UV_SETS, format_args!("{field}.uv_sets"), || {
            format!("has {sets} sets; keep at most {MAX_UV_SETS}")
        })?;
        for (set, uvs) in vertices.uv_sets.iter().enumerate() {
            self.length(format_args!("{field}.uv_sets[{set}]"), uvs.len(), count)?;
            self.finite(format_args!("{field}.uv_sets[{set}]"), uvs.iter().map(|uv| uv.to_array()))?;
        }
        self.length(format_args!("{field}.colors"), vertices.colors.len(), count)?;
        let is_share = |number: f32| (0.0..=1.0).contains(&number);
        let bad = vertices.colors.iter().position(|color| !color.to_array().into_iter().all(is_share));
        self.require(bad.is_none(), format_args!("{field}.colors"), || {
            let at = bad.unwrap_or(0);
            format!("entry {at} is {}; write numbers in [0, 1]", vertices.colors[at])
        })
    }

    fn joints(&self, field: &str, vertices: &Vertices, joint_count: Option<usize>) -> Result<(), AssetError> {
        let Vertices { positions, joints, influences_per_vertex: per_vertex, .. } = vertices;
        self.require(per_vertex % PER_SET == 0, format_args!("{field} (influences_per_vertex)"), || {
            format!("is {per_vertex}; write a multiple of {PER_SET}, or 0 without a skin")
        })?;
        self.require(positions.len().checked_mul(*per_vertex) == Some(joints.len()), field, || {
            format!("has {} entries; {} positions need {per_vertex} each", joints.len(), positions.len())
        })?;
        for (vertex, influences) in joints.chunks_exact((*per_vertex).max(1)).enumerate() {
            let is_odd = |weight: f32| !(0.0..=1.0 + UNIT_TOLERANCE).contains(&weight);
            if let Some((_, weight)) = influences.iter().find(|(_, weight)| is_odd(*weight)) {
                let problem = format!("vertex {vertex} has a weight of {weight}; write numbers in [0, 1]");
                return Err(self.context.error(field, problem));
            }
            let sum: f32 = influences.iter().map(|(_, weight)| weight).sum();
            self.require((sum - 1.0).abs() <= UNIT_TOLERANCE, field, || {
                format!("the weights of vertex {vertex} sum to {sum}; make them sum to 1")
            })?;
            let last = influences.iter().map(|(joint, _)| usize::from(*joint)).max().unwrap_or(0);
            let count = joint_count.unwrap_or(usize::MAX);
            self.require(last < count, field, || {
                format!(
                    "vertex {vertex} uses joint {last}, but a skin that draws it has {count} joints; name one of them"
                )
            })?;
        }
        Ok(())
    }

    fn material(&self, field: &str, material: &Material) -> Result<(), AssetError> {
        let number =
            |name: &str, value: f32, range: (f32, f32)| self.within(format_args!("{field}.{name}"), value, range);
        let numbers = |name: &str, values: &[f32], range: (f32, f32)| {
            values.iter().try_for_each(|value| number(name, *value, range))
        };
        let texture = |name: &str, reference: &Option<TextureRef>| self.texture(&format!("{field}.{name}"), reference);
        numbers("base_color", &material.base_color.to_array(), ANY)?;
        number("metallic", material.metallic, SHARE)?;
        number("roughness", material.roughness, SHARE)?;
        number("normal_scale", material.normal_scale, ANY)?;
        number("occlusion_strength", material.occlusion_strength, SHARE)?;
        numbers("emissive", &material.emissive.to_array(), POSITIVE)?;
        if let AlphaMode::Mask(cutoff) = material.alpha_mode {
            number("alpha_mode (cutoff)", cutoff, ANY)?;
        }
        texture("base_color_texture", &material.base_color_texture)?;
        texture("metallic_roughness_texture", &material.metallic_roughness_texture)?;
        texture("normal_texture", &material.normal_texture)?;
        texture("occlusion_texture", &material.occlusion_texture)?;
        texture("emissive_texture", &material.emissive_texture)?;

        let extensions = &material.extensions;
        if let Some(sheen) = &extensions.sheen {
            numbers("extensions.sheen.color", &sheen.color.to_array(), SHARE)?;
            texture("extensions.sheen.color_texture", &sheen.color_texture)?;
            number("extensions.sheen.roughness", sheen.roughness, SHARE)?;
            texture("extensions.sheen.roughness_texture", &sheen.roughness_texture)?;
        }
        if let Some(clearcoat) = &extensions.clearcoat {
            number("extensions.clearcoat.factor", clearcoat.factor, SHARE)?;
            texture("extensions.clearcoat.texture", &clearcoat.texture)?;
            number("extensions.clearcoat.roughness", clearcoat.roughness, SHARE)?;
            texture("extensions.clearcoat.roughness_texture", &clearcoat.roughness_texture)?;
            texture("extensions.clearcoat.normal_texture", &clearcoat.normal_texture)?;
            number("extensions.clearcoat.normal_scale", clearcoat.normal_scale, ANY)?;
        }
        if let Some(anisotropy) = &extensions.anisotropy {
            number("extensions.anisotropy.strength", anisotropy.strength, SHARE)?;
            number("extensions.anisotropy.rotation", anisotropy.rotation, ANY)?;
            texture("extensions.anisotropy.texture", &anisotropy.texture)?;
        }
        if let Some(film) = &extensions.iridescence {
            number("extensions.iridescence.factor", film.factor, SHARE)?;
            texture("extensions.iridescence.texture", &film.texture)?;
            number("extensions.iridescence.ior", film.ior, (1.0, f32::MAX))?;
            numbers("extensions.iridescence.thickness_nm", &film.thickness_nm, POSITIVE)?;
            texture("extensions.iridescence.thickness_texture", &film.thickness_texture)?;
        }
        if let Some(specular) = &extensions.specular {
            number("extensions.specular.factor", specular.factor, SHARE)?;
            texture("extensions.specular.texture", &specular.texture)?;
            numbers("extensions.specular.color", &specular.color.to_array(), POSITIVE)?;
            texture("extensions.specular.color_texture", &specular.color_texture)?;
        }
        if let Some(ior) = extensions.ior.filter(|ior| *ior != 0.0) {
            number("extensions.ior", ior, (1.0, f32::MAX))?;
        }
        if let Some(transmission) = &extensions.transmission {
            number("extensions.transmission.factor", transmission.factor, SHARE)?;
            texture("extensions.transmission.texture", &transmission.texture)?;
        }
        if let Some(volume) = &extensions.volume {
            number("extensions.volume.thickness", volume.thickness, POSITIVE)?;
            texture("extensions.volume.thickness_texture", &volume.thickness_texture)?;
            numbers("extensions.volume.attenuation_color", &volume.attenuation_color.to_array(), SHARE)?;
            let least = f32::MIN_POSITIVE;
            number("extensions.volume.attenuation_distance_m", volume.attenuation_distance_m, (least, f32::MAX))?;
        }
        if let Some(scattered) = &extensions.diffuse_transmission {
            number("extensions.diffuse_transmission.factor", scattered.factor, SHARE)?;
            texture("extensions.diffuse_transmission.texture", &scattered.texture)?;
            numbers("extensions.diffuse_transmission.color", &scattered.color.to_array(), SHARE)?;
            texture("extensions.diffuse_transmission.color_texture", &scattered.color_texture)?;
        }
        Ok(())
    }

    fn texture(&self, field: &str, reference: &Option<TextureRef>) -> Result<(), AssetError> {
        let Some(reference) = reference else { return Ok(()) };
        let textures = &self.asset.textures;
        self.index(format_args!("{field}.texture"), reference.texture, "textures", textures.len())?;
        let image = textures[reference.texture].image;
        self.require(!self.asset.images[image].rgba.is_empty(), field, || {
            format!("images[{image}] is empty; give it pixels, or the material no texture")
        })?;
        let set = reference.uv_set;
        self.require((set as usize) < MAX_UV_SETS, format_args!("{field}.uv_set"), || {
            format!("is {set}; write one below {MAX_UV_SETS}")
        })?;
        self.finite(format_args!("{field}.offset"), [reference.offset.to_array()])?;
        self.finite(format_args!("{field}.rotation"), [[reference.rotation]])?;
        self.finite(format_args!("{field}.scale"), [reference.scale.to_array()])
    }

    fn camera(&self, field: &str, camera: &Camera) -> Result<(), AssetError> {
        let field = format!("{field}.projection");
        let positive = |name: &str, number: f32| {
            self.within(format_args!("{field}.{name}"), number, (f32::MIN_POSITIVE, f32::MAX))
        };
        let (near_m, far_m) = match camera.projection {
            Projection::Perspective { vertical_fov, aspect, near_m, far_m } => {
                self.require(vertical_fov > 0.0 && vertical_fov < PI, format_args!("{field}.vertical_fov"), || {
                    format!("is {vertical_fov}; write radians between 0 and pi")
                })?;
                positive("aspect", aspect.unwrap_or(1.0))?;
                positive("near_m", near_m)?;
                (near_m, far_m)
            }
            Projection::Orthographic { half_width_m, half_height_m, near_m, far_m } => {
                positive("half_width_m", half_width_m)?;
                positive("half_height_m", half_height_m)?;
                self.within(format_args!("{field}.near_m"), near_m, POSITIVE)?;
                (near_m, Some(far_m))
            }
        };
        let Some(far_m) = far_m else { return Ok(()) };
        self.require(far_m.is_finite() && far_m > near_m, format_args!("{field}.far_m"), || {
            format!("is {far_m}; write a finite number over near_m, {near_m}")
        })
    }

    fn light(&self, field: &str, light: &Light) -> Result<(), AssetError> {
        for channel in light.color.to_array() {
            self.within(format_args!("{field}.color"), channel, POSITIVE)?;
        }
        self.within(format_args!("{field}.intensity"), light.intensity, POSITIVE)?;
        let (LightKind::Point { range_m } | LightKind::Spot { range_m, .. }) = light.kind else { return Ok(()) };
        let range_m = range_m.unwrap_or(1.0);
        self.within(format_args!("{field}.kind.range_m"), range_m, (f32::MIN_POSITIVE, f32::MAX))?;
        let LightKind::Spot { inner_angle, outer_angle, .. } = light.kind else { return Ok(()) };
        let good = inner_angle >= 0.0 && inner_angle < outer_angle && outer_angle <= FRAC_PI_2;
        self.require(good, format_args!("{field}.kind"), || {
            format!("inner_angle is {inner_angle}, outer_angle {outer_angle}; 0 <= inner < outer <= pi/2 must hold")
        })
    }

    fn skin(&self, field: &str, skin: &Skin) -> Result<(), AssetError> {
        self.require(!skin.joints.is_empty(), format_args!("{field}.joints"), || {
            "has 0 entries; a skin needs at least one joint".to_owned()
        })?;
        for (j, &joint) in skin.joints.iter().enumerate() {
            self.index(format_args!("{field}.joints[{j}]"), joint, "nodes", self.asset.nodes.len())?;
        }
        let (joints, matrices) = (skin.joints.len(), skin.inverse_bind.len());
        self.require(joints == matrices, format_args!("{field}.inverse_bind"), || {
            format!("has {matrices} entries for {joints} joints; give one each")
        })?;
        self.finite(format_args!("{field}.inverse_bind"), skin.inverse_bind.iter().map(|m| m.to_cols_array()))
    }

    fn animation(&self, field: &str, animation: &Animation) -> Result<(), AssetError> {
        let mut last_key_s = 0.0f32;
        for (c, channel) in animation.channels.iter().enumerate() {
            let field = format!("{field}.channels[{c}]");
            self.channel(&field, channel)?;
            last_key_s = last_key_s.max(channel.times_s.last().copied().unwrap_or(0.0));
        }
        let duration_s = animation.duration_s;
        self.require(duration_s == last_key_s, format_args!("{field}.duration_s"), || {
            format!("is {duration_s}; write {last_key_s}, the last key of any channel")
        })
    }

    fn channel(&self, field: &str, channel: &Channel) -> Result<(), AssetError> {
        let nodes = &self.asset.nodes;
        self.index(format_args!("{field}.node"), channel.node, "nodes", nodes.len())?;
        let (node, times_s) = (&nodes[channel.node], &channel.times_s);
        self.require(!times_s.is_empty(), format_args!("{field}.times_s"), || {
            "has 0 entries; give one key at least, or leave the channel out".to_owned()
        })?;
        self.finite(format_args!("{field}.times_s"), times_s.iter().map(|time_s| [*time_s]))?;
        let late = times_s.windows(2).position(|pair| pair[0] >= pair[1]);
        self.require(late.is_none(), format_args!("{field}.times_s"), || {
            let at = late.unwrap_or(0) + 1;
            format!("entry {at} is {}, not later than the one before; sort the keys", times_s[at])
        })?;

        let per_key = if channel.interpolation == Interpolation::CubicSpline { 3 } else { 1 };
        let values = format!("{field}.values");
        let (count, per_key) = match &channel.values {
            Keys::Translation(list) | Keys::Scale(list) => {
                self.finite(&values, list.iter().map(Vec3::to_array))?;
                (list.len(), per_key)
            }
            Keys::Rotation(list) => {
                self.finite(&values, list.iter().map(|rotation| rotation.to_array()))?;
                // Of a cubic key (in-tangent, value, out-tangent) only the value is a rotation.
                let rotations = list.iter().skip(per_key / 2).step_by(per_key);
                self.unit(&values, rotations.map(|rotation: &Quat| rotation.length()), KEY_UNIT_TOLERANCE)?;
                (list.len(), per_key)
            }
            Keys::Weights { targets, values: list } => {
                self.finite(&values, list.iter().map(|weight| [*weight]))?;
                let of_mesh = node.mesh.map_or(0, |mesh| self.asset.meshes[mesh].weights.len());
                self.require(*targets == of_mesh && *targets > 0, format_args!("{values}.targets"), || {
                    format!("is {targets}, the node's mesh has {of_mesh}; give a weight to each, at least one")
                })?;
                (list.len(), per_key * targets)
            }
        };
        let keys = times_s.len();
        self.require(keys.checked_mul(per_key) == Some(count), &values, || {
            format!("has {count} entries; {keys} keys need {per_key} each")
        })?;
        let is_movable = matches!(node.transform, Transform::Trs { .. });
        self.require(is_movable || matches!(channel.values, Keys::Weights { .. }), format_args!("{field}.node"), || {
            format!("nodes[{}] has a matrix; write its transform as translation, rotation and scale", channel.node)
        })
    }
}

/// Checks each entry of a list under its field.
fn each<T>(
    list: &str,
    entries: &[T],
    mut check: impl FnMut(&str, &T) -> Result<(), AssetError>,
) -> Result<(), AssetError> {
    entries.iter().enumerate().try_for_each(|(i, entry)| check(&format!("{list}[{i}]"), entry))
}
