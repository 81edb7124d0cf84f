//! A scene at one moment as the triangles that rays meet: surfaces and fur in world space.

use super::OracleError;
use super::bvh::{Bounds, Bvh};
use super::fur::{self, Corner, FurGeometry, Triangle};
use super::ray::Ray;
use super::shade::{FurDress, SurfaceDress};
use super::walk::Hit;
use crate::asset::{Mesh, Primitive, Topology, Vertices};
use crate::material::{AlphaMode, Blend, ForceSpace, Fur, Shape};
use crate::math::normal_matrix;
use crate::measure::twin::{direction, strand};
use crate::scene::{Instance, Part, Pose, Scene, deform, instances, parts, shell_directions_of_mesh};
use glam::{DVec2, DVec3, DVec4, Mat4, Vec3};

/// One triangle of a surface.
pub struct Facet {
    /// Index into [`Stage::surfaces`].
    pub surface: usize,
    /// Metres, world space.
    pub corners: [DVec3; 3],
    /// World space, not normalised.
    pub normals: [DVec3; 3],
    /// Linear RGBA of the vertices.
    pub colors: [DVec4; 3],
    /// Coordinates of the base colour texture.
    pub uv: [DVec2; 3],
}

/// One triangle of fur.
pub struct Tuft {
    /// Index into [`Stage::furs`].
    pub fur: usize,
    /// Geometry.
    pub triangle: Triangle,
    /// Linear RGB of the vertices.
    pub colors: [DVec3; 3],
    /// Coordinates of the base colour and spot textures.
    pub uv: [[DVec2; 3]; 2],
}

enum Item {
    Facet(Box<Facet>),
    Tuft(Box<Tuft>),
}

/// What a ray met.
pub enum Met<'a> {
    /// A surface, and which of its faces.
    Facet { facet: &'a Facet, barycentric: DVec3, distance_m: f64, is_front: bool },
    /// A strand.
    Tuft { tuft: &'a Tuft, hit: Hit },
}

/// Everything that rays meet.
pub struct Stage {
    items: Vec<Item>,
    bvh: Bvh,
    /// Materials of the facets.
    pub surfaces: Vec<SurfaceDress>,
    /// Materials of the tufts.
    pub furs: Vec<FurDress>,
}

impl Stage {
    /// # Errors
    /// [`OracleError::Unsupported`].
    pub fn new(scene: &Scene, scene_index: usize, pose: &Pose, variant: Option<usize>) -> Result<Self, OracleError> {
        let mut stage = Self { items: Vec::new(), bvh: Bvh::new(&[]), surfaces: Vec::new(), furs: Vec::new() };
        let placed = instances(scene.asset(), scene_index, pose);
        for part in parts(scene.asset(), &placed, variant) {
            let instance = &placed[part.instance];
            let mesh = &scene.asset().meshes[part.mesh];
            let material = &scene.materials()[part.material];
            if mesh.primitives[part.primitive].topology != Topology::Triangles {
                return Err(unsupported(&material.name, "points and lines have no reference; show triangles alone"));
            }
            stage.add_surface(scene, part, instance)?;
            if let Some(fur) = &material.fur {
                has_limit(fur, &material.name)?;
                stage.add_fur(scene, part, instance, fur);
            }
        }
        let bounds: Vec<Bounds> = stage.items.iter().map(Item::bounds).collect();
        stage.bvh = Bvh::new(&bounds);
        Ok(stage)
    }

    fn add_surface(&mut self, scene: &Scene, part: Part, instance: &Instance) -> Result<(), OracleError> {
        let material = &scene.materials()[part.material];
        let standard = scene.standard(part.material, material.fur.is_some());
        if let Some(cloth) = scene.family(part.material, material.fur.is_some()) {
            return Err(unsupported(
                &material.name,
                &format!("the reference knows no {}; use kind = \"standard\"", cloth.kind()),
            ));
        }
        let unsupported_maps = [
            ("metallic_roughness_texture", standard.metallic_roughness_texture),
            ("normal_texture", standard.normal_texture),
            ("occlusion_texture", standard.occlusion_texture),
            ("emissive_texture", standard.emissive_texture),
            ("detail_albedo_texture", standard.detail_albedo_texture),
            ("detail_normal_texture", standard.detail_normal_texture),
        ];
        if let Some((map, _)) = unsupported_maps.iter().find(|(_, map)| map.is_some()) {
            return Err(unsupported(&material.name, &format!("the reference does not sample {map}; leave it out")));
        }
        if standard.alpha_mode == AlphaMode::Blend {
            return Err(unsupported(&material.name, "the reference does not blend; choose alpha_mode opaque or mask"));
        }
        let source = &scene.asset().meshes[part.mesh].primitives[part.primitive];
        let posed = deform(source, &instance.joints, &instance.morph_weights);
        let dress = SurfaceDress::new(scene.asset(), &standard, instance.mirrored);
        let uv = dress.coordinates(source);
        let [world, normals] = in_world(instance, &posed);
        let color = |vertex: usize| posed.colors.get(vertex).map_or(DVec4::ONE, |color| color.as_dvec4());
        for corners in triangles(source) {
            self.items.push(Item::Facet(Box::new(Facet {
                surface: self.surfaces.len(),
                corners: corners.map(|vertex| world[vertex]),
                normals: corners.map(|vertex| normals[vertex]),
                colors: corners.map(color),
                uv: corners.map(&uv),
            })));
        }
        self.surfaces.push(dress);
        Ok(())
    }

    fn add_fur(&mut self, scene: &Scene, part: Part, instance: &Instance, fur: &Fur) {
        let mesh = &scene.asset().meshes[part.mesh];
        let source = &mesh.primitives[part.primitive];
        let size = scene.size(instance);
        let standard = &scene.materials()[part.material].standard;
        let dress = FurDress::new(scene.asset(), fur, standard, !source.vertices.uv_sets.is_empty(), size);
        let length_m = f64::from(fur.length.metres(size.world_radius_m()));
        let force = force_in_world(fur, instance);
        let grown = with_shell_directions(mesh, part.primitive);
        let at_rest = &grown.vertices;
        let posed = deform(&grown, &instance.joints, &instance.morph_weights);
        let [world, directions] = in_world(instance, &posed);
        // The comb's first axis: around the vertical of the rest pose; a pose turns it as it turns normals.
        let sides = Vertices {
            normals: at_rest.normals.iter().map(|normal| Vec3::Y.cross(*normal).normalize_or(Vec3::X)).collect(),
            ..at_rest.clone()
        };
        let sides = deform(&Primitive { vertices: sides, ..source.clone() }, &instance.joints, &[]).normals;
        let color = |vertex: usize| source.vertices.colors.get(vertex).map_or(DVec4::ONE, |color| color.as_dvec4());
        let corner = |vertex: usize| {
            let root_direction = direction::or(directions[vertex], DVec3::Y);
            let side = instance.world_from_object.transform_vector3(sides[vertex]).as_dvec3();
            let side = direction::or(side.reject_from_normalized(root_direction), DVec3::ZERO);
            let comb = fur.comb.as_dvec2();
            let total = force + comb.x * side + comb.y * root_direction.cross(side);
            let total = total.clamp_length_max(1.0);
            Corner {
                root: world[vertex],
                direction: root_direction,
                sideways: direction::or(total.reject_from_normalized(root_direction), DVec3::ZERO),
                bend_angle: strand::bend_angle(root_direction, total),
                length_m: length_m * color(vertex).w,
                root_in_cells: at_rest.positions[vertex].as_dvec3() / dress.spacing,
                direction_in_rest: at_rest.normals[vertex].as_dvec3(),
            }
        };
        let uv = dress.coordinates(source);
        for corners in triangles(source) {
            self.items.push(Item::Tuft(Box::new(Tuft {
                fur: self.furs.len(),
                triangle: corners.map(corner),
                colors: corners.map(|vertex| color(vertex).truncate()),
                uv: [0, 1].map(|map| corners.map(|vertex| uv(vertex)[map])),
            })));
        }
        self.furs.push(dress);
    }

    /// What a ray meets first.
    pub fn first(&self, ray: &Ray) -> Option<Met<'_>> {
        let mut first = None;
        self.bvh.walk(ray, ray.length_m, |item, limit_m| {
            match &self.items[item] {
                Item::Facet(facet) => {
                    if let Some((barycentric, distance_m, is_front)) = self.meet_facet(facet, ray, limit_m) {
                        first = Some(Met::Facet { facet, barycentric, distance_m, is_front });
                        return distance_m;
                    }
                }
                Item::Tuft(tuft) => {
                    if let Some(hit) = self.furs[tuft.fur].geometry.first_hit(&tuft.triangle, ray, limit_m) {
                        first = Some(Met::Tuft { tuft, hit });
                        return hit.distance_m;
                    }
                }
            }
            limit_m
        });
        first
    }

    fn meet_facet(&self, facet: &Facet, ray: &Ray, limit_m: f64) -> Option<(DVec3, f64, bool)> {
        let [(a, a_m), (b, b_m), (c, c_m)] = facet.corners.map(|corner| ray.seen(corner));
        let edges = DVec3::new(b.perp_dot(c), c.perp_dot(a), a.perp_dot(b));
        let area = edges.element_sum();
        if area == 0.0 || (edges.min_element() < 0.0 && edges.max_element() > 0.0) {
            return None;
        }
        let barycentric = edges / area;
        let distance_m = barycentric.dot(DVec3::new(a_m, b_m, c_m));
        let surface = &self.surfaces[facet.surface];
        // The ray's frame looks along the ray: what is counter-clockwise to the eye runs the other way in it.
        let is_front = (area < 0.0) != surface.is_mirrored;
        let is_shown = (0.0..limit_m).contains(&distance_m)
            && (is_front || surface.is_double_sided)
            && surface.is_there(facet, barycentric);
        is_shown.then_some((barycentric, distance_m, is_front))
    }
}

impl Item {
    fn bounds(&self) -> Bounds {
        match self {
            Self::Facet(facet) => Bounds::around(facet.corners),
            Self::Tuft(tuft) => fur::bounds(&tuft.triangle),
        }
    }
}

fn unsupported(material: &str, problem: &str) -> OracleError {
    OracleError::Unsupported { material: material.to_owned(), problem: problem.to_owned() }
}

/// More and more shells of partial opacity hide everything: only strands that are there or not have a limit.
fn has_limit(fur: &Fur, material: &str) -> Result<(), OracleError> {
    let maps = [("height_map", fur.height_map), ("distribution_map", fur.distribution_map), ("comb_map", fur.comb_map)];
    if let Some((map, _)) = maps.iter().find(|(_, map)| map.is_some()) {
        return Err(unsupported(material, &format!("the reference does not sample {map}; leave it out")));
    }
    if fur.blend != Blend::Cutout || fur.edge_fade != 0.0 || fur.tip_fade != 0.0 {
        let problem = "only cut-out fur has a limit; set blend = \"cutout\", edge_fade = 0 and tip_fade = 0";
        return Err(unsupported(material, problem));
    }
    Ok(())
}

/// Vertex indices of the triangles.
fn triangles(primitive: &Primitive) -> impl Iterator<Item = [usize; 3]> + '_ {
    primitive.indices.chunks_exact(3).map(|corners| [0, 1, 2].map(|corner| corners[corner] as usize))
}

/// Positions and normals in world space.
fn in_world(instance: &Instance, posed: &Vertices) -> [Vec<DVec3>; 2] {
    let world_from_object = instance.world_from_object.as_dmat4();
    let normals = normal_matrix(instance.world_from_object).as_dmat3();
    [
        posed.positions.iter().map(|position| world_from_object.transform_point3(position.as_dvec3())).collect(),
        posed.normals.iter().map(|normal| normals * normal.as_dvec3()).collect(),
    ]
}

/// The primitive with shell directions for normals, and what its morph targets add to those.
fn with_shell_directions(mesh: &Mesh, primitive: usize) -> Primitive {
    let mut grown = mesh.primitives[primitive].clone();
    let at_rest = shell_directions_of_mesh(mesh).swap_remove(primitive);
    for (index, target) in grown.morph_targets.iter_mut().enumerate() {
        let mut morphed = mesh.clone();
        for part in &mut morphed.primitives {
            if let Some(target) = part.morph_targets.get(index) {
                part.vertices.positions.iter_mut().zip(&target.positions).for_each(|(place, offset)| *place += *offset);
            }
        }
        let directions = shell_directions_of_mesh(&morphed).swap_remove(primitive);
        target.normals = directions.iter().zip(&at_rest).map(|(to, from)| *to - *from).collect();
    }
    grown.vertices.normals = at_rest;
    grown
}

/// Unit direction times strength. A force of the object turns with its node, or with the first joint of its skin.
fn force_in_world(fur: &Fur, instance: &Instance) -> DVec3 {
    let carrier = match (fur.force_space, instance.skin) {
        (ForceSpace::World, _) => Mat4::IDENTITY,
        (ForceSpace::Object, None) => instance.world_from_object,
        (ForceSpace::Object, Some(_)) => instance.joints.first().copied().unwrap_or(Mat4::IDENTITY),
    };
    let force = carrier.as_dmat4().transform_vector3(fur.force.as_dvec3());
    force.normalize_or_zero() * f64::from(fur.force_strength)
}

/// What of fur's parameters is geometry; `radius` in spacings.
pub fn geometry_of(fur: &Fur) -> FurGeometry {
    FurGeometry {
        radius: 0.5 * f64::from(fur.thickness.max(1e-6)),
        cutoff_start: fur.cutoff_start.into(),
        cutoff_end: fur.cutoff_end.into(),
        is_paraboloid: fur.shape == Shape::Paraboloid,
        taper: fur.taper.into(),
        clump: fur.clump.into(),
        curl: fur.curl.into(),
    }
}
