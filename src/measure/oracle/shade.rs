//! The light that a place sends to the eye, by the shaders' formulas in double precision.

use super::fur::{FurGeometry, mixed};
use super::ray::{Eye, Ray};
use super::stage::{Facet, Met, Stage, Tuft, geometry_of};
use super::texture::Map;
use super::walk::Hit;
use crate::asset::{Asset, Primitive};
use crate::material::{AlphaMode, Fur, Standard};
use crate::measure::twin::albedo::Fit;
use crate::measure::twin::standard::Surface;
use crate::measure::twin::{direction, fibre, light, strand, uv};
use crate::scene::{Light, LightKind, Size};
use glam::{DVec2, DVec3, DVec4};

/// A surface's material.
pub struct SurfaceDress {
    /// Clockwise triangles are its front ones.
    pub is_mirrored: bool,
    /// Its back is shown.
    pub is_double_sided: bool,
    standard: Standard,
    base_color_map: Option<Map>,
}

impl SurfaceDress {
    pub fn new(asset: &Asset, standard: &Standard, is_mirrored: bool) -> Self {
        let base_color_map = standard.base_color_texture.map(|reference| Map::new(asset, reference, true));
        Self { is_mirrored, is_double_sided: standard.double_sided, standard: standard.clone(), base_color_map }
    }

    /// Coordinates of the base colour texture, by vertex.
    pub fn coordinates<'a>(&self, primitive: &'a Primitive) -> impl Fn(usize) -> DVec2 + use<'a> {
        coordinates(self.base_color_map.as_ref(), primitive)
    }

    fn base_color(&self, facet: &Facet, barycentric: DVec3) -> DVec4 {
        let [a, b, c] = facet.colors;
        let color = self.standard.base_color.as_dvec4() * (a * barycentric.x + b * barycentric.y + c * barycentric.z);
        let map = self.base_color_map.as_ref();
        color * map.map_or(DVec4::ONE, |map| map.sample(mixed_uv(facet.uv, barycentric)))
    }

    /// Whether a mask leaves that place.
    pub fn is_there(&self, facet: &Facet, barycentric: DVec3) -> bool {
        self.standard.alpha_mode != AlphaMode::Mask
            || self.base_color(facet, barycentric).w >= f64::from(self.standard.alpha_cutoff)
    }
}

/// A material of fur.
pub struct FurDress {
    /// What decides where strands are.
    pub geometry: FurGeometry,
    /// Mean spacing of the strands, in units of the rest pose.
    pub spacing: f64,
    fur: Fur,
    base_color: DVec3,
    base_color_map: Option<Map>,
    spot_map: Option<Map>,
    /// UV units per rest unit, where the mesh has no UVs.
    projection_scale: f64,
    has_uv: bool,
    variance: f64,
}

impl FurDress {
    pub fn new(asset: &Asset, fur: &Fur, standard: &Standard, has_uv: bool, size: Size) -> Self {
        let (base_color, base_color_texture) = fur.color_over(standard);
        let spacing = fur.strand_spacing.metres(size.world_radius_m()) / size.world_from_rest;
        Self {
            geometry: geometry_of(fur),
            // A spacing of nothing would make infinitely many strands.
            spacing: spacing.max(size.rest_radius * 1e-5).into(),
            base_color: base_color.as_dvec3(),
            base_color_map: base_color_texture.map(|reference| Map::new(asset, reference, true)),
            spot_map: fur.spot_map.map(|reference| Map::new(asset, reference, false)),
            projection_scale: 1.0 / f64::from(size.rest_radius),
            has_uv,
            variance: fibre::variance(fur.roughness.into()),
            fur: fur.clone(),
        }
    }

    /// Coordinates of the base colour and spot textures, by vertex.
    pub fn coordinates<'a>(&self, primitive: &'a Primitive) -> impl Fn(usize) -> [DVec2; 2] + use<'a> {
        let [base_color, spot] = [&self.base_color_map, &self.spot_map].map(|map| coordinates(map.as_ref(), primitive));
        move |vertex| [base_color(vertex), spot(vertex)]
    }

    fn color(&self, tuft: &Tuft, Hit { height, barycentric, .. }: Hit) -> DVec3 {
        let sample = |map: &Option<Map>, corners: [DVec2; 3]| {
            let map = map.as_ref()?;
            if self.has_uv {
                return Some(map.sample(mixed_uv(corners, barycentric)));
            }
            let skin = self.geometry.skin(&tuft.triangle, barycentric);
            let projected = uv::projected(skin.place * self.spacing, skin.normal) * self.projection_scale;
            // The projection stands for the first UV set alone; the second is (0, 0).
            Some(map.sample(if map.uv_set() == 0 { projected } else { DVec2::ZERO }))
        };
        let fur = &self.fur;
        let mut color = self.base_color * mixed(barycentric, |corner| tuft.colors[corner]);
        if let Some(texel) = sample(&self.base_color_map, tuft.uv[0]) {
            color *= texel.truncate();
        }
        if let Some(texel) = sample(&self.spot_map, tuft.uv[1]) {
            color = color.lerp(fur.spot_color.as_dvec3(), texel.x);
        }
        color *= fur.root_color.as_dvec3().lerp(fur.tip_color.as_dvec3(), height);
        let (_, random) = self.geometry.profile(&tuft.triangle, barycentric, height);
        (color * (1.0 + f64::from(fur.color_variation) * (random * 2.0 - 1.0))).min(DVec3::ONE)
    }
}

fn coordinates<'a>(map: Option<&Map>, primitive: &'a Primitive) -> impl Fn(usize) -> DVec2 + use<'a> {
    let set = map.and_then(|map| primitive.vertices.uv_sets.get(map.uv_set()));
    move |vertex| set.map_or(DVec2::ZERO, |set| set[vertex].as_dvec2())
}

fn mixed_uv([a, b, c]: [DVec2; 3], barycentric: DVec3) -> DVec2 {
    a * barycentric.x + b * barycentric.y + c * barycentric.z
}

/// What shades all places of a picture.
pub struct Shading<'a> {
    /// Lights.
    pub lights: &'a [Light],
    /// Radiance of the environment, the same from everywhere.
    pub ambient_radiance: DVec3,
    /// Whose eye.
    pub eye: Eye,
    /// Directional albedo of surfaces.
    pub fit: Fit,
}

impl Shading<'_> {
    /// Linear RGB radiance from where a ray ends.
    pub fn radiance(&self, stage: &Stage, ray: &Ray, met: &Met) -> DVec3 {
        match *met {
            Met::Facet { facet, barycentric, distance_m, is_front } => {
                self.surface(&stage.surfaces[facet.surface], facet, barycentric, ray.at(distance_m), is_front)
            }
            Met::Tuft { tuft, hit } => self.strand(&stage.furs[tuft.fur], tuft, hit, ray.at(hit.distance_m)),
        }
    }

    fn surface(&self, dress: &SurfaceDress, facet: &Facet, barycentric: DVec3, place: DVec3, is_front: bool) -> DVec3 {
        let standard = &dress.standard;
        let color = dress.base_color(facet, barycentric).truncate();
        if standard.unlit {
            return color;
        }
        let normal = mixed(barycentric, |corner| facet.normals[corner].normalize_or_zero());
        let normal = direction::or(normal, self.eye.direction_to(place, DVec3::Y)) * if is_front { 1.0 } else { -1.0 };
        let [tangent, bitangent] = direction::frame(normal);
        let in_tangent = |vector: DVec3| DVec3::new(vector.dot(tangent), vector.dot(bitangent), vector.dot(normal));
        let mut to_eye = in_tangent(self.eye.direction_to(place, normal));
        // A bent normal may turn away from the eye; grazing is then the nearest view that has a meaning.
        to_eye.z = to_eye.z.max(1e-3);
        let surface = Surface {
            base_color: color.clamp(DVec3::ZERO, DVec3::ONE),
            metallic: standard.metallic.into(),
            roughness: standard.roughness.into(),
        };
        let ambient = self.ambient_radiance * surface.ambient(&self.fit, to_eye.z);
        let lit = self.lights.iter().map(|light| {
            let (to_light, irradiance) = incident(light, place);
            irradiance * surface.brdf_times_cosine(&self.fit, to_eye, in_tangent(to_light))
        });
        ambient + lit.sum::<DVec3>() + standard.emissive.as_dvec3()
    }

    fn strand(&self, dress: &FurDress, tuft: &Tuft, hit: Hit, place: DVec3) -> DVec3 {
        let (fur, height) = (&dress.fur, hit.height);
        let of_corners = |value: &dyn Fn(usize) -> DVec3| mixed(hit.barycentric, value);
        let normal = direction::or(
            of_corners(&|corner| tuft.triangle[corner].direction),
            self.eye.direction_to(place, DVec3::Y),
        );
        let tangent = direction::or(of_corners(&|corner| tuft.triangle[corner].strand_at(height)), normal);
        let to_eye = self.eye.direction_to(place, normal);
        let color = dress.color(tuft, hit);
        let occlusion = f64::from(fur.occlusion);
        let (specular, transmission) = (fur.specular.into(), fur.transmission.into());
        let fibre = fibre::Fibre::new(normal, tangent, to_eye, specular, transmission, dress.variance);
        let depth = -(1.0 - occlusion * (1.0 - height)).max(1e-3).ln();
        let ambient = self.ambient_radiance * color.map(|color| fibre.environment(color, 1.0, 1.0, 1.0, depth));
        let lit = self.lights.iter().map(|light| {
            let (to_light, irradiance) = incident(light, place);
            let depth = strand::optical_depth(height, occlusion, normal.dot(to_light));
            irradiance * color.map(|color| fibre.scattering(color, to_light, depth))
        });
        ambient + lit.sum::<DVec3>()
    }
}

/// Unit vector to a light, and its irradiance on what faces it (KHR_lights_punctual).
fn incident(source: &Light, place: DVec3) -> (DVec3, DVec3) {
    let intensity = source.intensity.as_dvec3();
    let axis = source.direction_to_light_in_world.as_dvec3();
    if source.kind == LightKind::Directional {
        return (axis, intensity);
    }
    let to_light = source.position_in_world.as_dvec3() - place;
    // A place inside the light would divide by zero; a millionth of a metre is below any scene's scale.
    let distance_squared = to_light.length_squared().max(1e-12);
    let to_light = to_light / distance_squared.sqrt();
    let window = source.range_m.map_or(1.0, |range_m| light::range_window(distance_squared, range_m.into()));
    let cone = match source.kind {
        LightKind::Spot { angle_scale, angle_offset } => {
            (axis.dot(to_light) * f64::from(angle_scale) + f64::from(angle_offset)).clamp(0.0, 1.0).powi(2)
        }
        LightKind::Directional | LightKind::Point => 1.0,
    };
    (to_light, intensity * (window * cone / distance_squared))
}
