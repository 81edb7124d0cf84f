//! Shadow maps: which lights have one, and what each looks at.
//!
//! A directional light looks at the sphere around what the camera can see of the scene, along parallel rays; where the
//! camera stands so close that near things would be coarse, up to three spheres ahead of it, each four times the one before
//! (Engel 2006, "Cascaded Shadow Maps"). A sphere looks the same from everywhere, and its middle moves by whole texels, so
//! that a turning or moving camera does not make shadows swim (Valient 2007, "Stable Rendering of Cascaded Shadow Maps").
//! A light with a place looks at the scene's sphere or along its cone, whichever is narrower.

use super::{Camera, Light, LightKind};
use crate::math::{Hull, Sphere, orthographic, orthonormal_frame, perspective};
use glam::{DVec3, Mat4, Vec3};

/// Most maps of one frame. Lights beyond cast no shadow.
pub const MAX_SHADOW_MAPS: usize = 8;
/// Texels at the edge of a map that only its filter reads.
pub const SHADOW_BORDER_PX: u32 = 4;

/// Most maps of one directional light.
const MOST_CASCADES: i32 = 3;
/// Each cascade reaches so many times as far as the one before.
const CASCADE_RATIO: f32 = 4.0;
/// Outlines are short by up to 1.3 %, and a clip's may be passed between the poses that they are taken from.
const OUTLINE_MARGIN: f32 = 1.03;
/// Widest half angle of a map with perspective: beyond it the middle of the map would be coarse.
const WIDEST_HALF_ANGLE: f32 = 1.2;
/// The near plane of such a map, as a share of how far it looks: a light inside the scene does not see what touches it.
const NEAR_SHARE: f32 = 1e-3;

/// What one map shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShadowMap {
    /// Index of the light.
    pub light: usize,
    /// Reversed depth, Y up; w is 1 for parallel rays and otherwise the distance along the axis, metres.
    pub clip_from_world: Mat4,
    /// Where perspective rays start.
    pub eye_in_world: Vec3,
    /// Unit length, from the scene to the light.
    pub direction_to_light: Vec3,
    /// Rays are parallel.
    pub is_orthographic: bool,
    /// Width of a texel, metres; with perspective, at a distance of a metre.
    pub texel_m: f32,
}

/// The maps of a frame.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ShadowMaps {
    /// Those of one light stand together, the finest first.
    pub maps: Vec<ShadowMap>,
    /// Lights that would cast a shadow and have no map: too many lights, or a point light amid the scene.
    pub without: Vec<usize>,
}

/// The sphere around an outline; `None` where it has no size.
pub fn bounding_sphere(outline: &Hull) -> Option<Sphere> {
    let center = outline.bounds().center();
    let radius = outline.points().iter().map(|point| point.distance(center)).fold(0.0, f32::max) * OUTLINE_MARGIN;
    (radius > 0.0 && radius.is_finite() && center.is_finite()).then_some(Sphere { center, radius })
}

/// Maps of `resolution_px` texels a side for the lights for which `casts` holds, as long as there are maps left; `scene` is
/// the sphere around all that casts or receives a shadow.
pub fn shadow_maps(
    lights: &[Light],
    casts: impl Fn(usize) -> bool,
    scene: Sphere,
    camera: &Camera,
    resolution_px: u32,
) -> ShadowMaps {
    let mut found = ShadowMaps::default();
    for (index, light) in lights.iter().enumerate().filter(|(index, _)| casts(*index)) {
        let maps: Vec<ShadowMap> = match light.kind {
            LightKind::Directional => {
                let spheres = cascades(scene, camera);
                spheres.into_iter().filter_map(|shown| parallel(index, light, shown, scene, resolution_px)).collect()
            }
            LightKind::Point | LightKind::Spot { .. } => {
                in_perspective(index, light, scene, resolution_px).into_iter().collect()
            }
        };
        if maps.is_empty() || found.maps.len() + maps.len() > MAX_SHADOW_MAPS {
            found.without.push(index);
        } else {
            found.maps.extend(maps);
        }
    }
    found
}

/// Balls around what a camera sees of the scene, from near to far; the last holds all of it.
fn cascades(scene: Sphere, camera: &Camera) -> Vec<Sphere> {
    let depth_m = (camera.eye_in_world() - scene.center).dot(camera.backwards_in_world());
    let (nearest_m, farthest_m) = (depth_m - scene.radius, depth_m + scene.radius);
    let slopes = [camera.clip_from_camera.x_axis.x, camera.clip_from_camera.y_axis.y].map(f32::recip);
    let slope = slopes[0].hypot(slopes[1]);
    if camera.is_orthographic || !slope.is_finite() || farthest_m <= 0.0 {
        return vec![scene];
    }
    // Powers of two: how far cascades reach must not follow every move of the camera.
    let reach_m = farthest_m.log2().ceil().exp2();
    let mut spheres = Vec::new();
    for step in (0..MOST_CASCADES).rev() {
        let far_m = reach_m * CASCADE_RATIO.powi(-step);
        let near_m = if step == MOST_CASCADES - 1 { 0.0 } else { far_m / CASCADE_RATIO };
        // The farthest cascade takes all that lies before the next one, too, so that nothing falls between.
        if far_m <= nearest_m {
            continue;
        }
        let shown = slice(camera, if near_m < nearest_m { floor_to_power(nearest_m) } else { near_m }, far_m, slope);
        let is_last = step == 0;
        let smaller = if shown.radius < scene.radius { shown } else { scene };
        // A cascade that is hardly finer than the whole is not worth its map.
        if is_last || smaller.radius < 0.5 * scene.radius {
            spheres.push(smaller);
        }
    }
    spheres
}

/// The largest power of two up to a length; 0 for none.
fn floor_to_power(length_m: f32) -> f32 {
    if length_m > 0.0 { length_m.log2().floor().exp2() } else { 0.0 }
}

/// The sphere around the part of a camera's view between two depths; `slope` is that of the view's corners.
fn slice(camera: &Camera, near_m: f32, far_m: f32, slope: f32) -> Sphere {
    // As far from the near corners as from the far ones, unless the far ones alone decide.
    let middle_m = (0.5 * (near_m + far_m) * (1.0 + slope * slope)).min(far_m);
    Sphere {
        center: camera.eye_in_world() - camera.backwards_in_world() * middle_m,
        radius: (far_m - middle_m).hypot(far_m * slope),
    }
}

/// The map of a directional light that shows a sphere and all that stands before it.
fn parallel(index: usize, light: &Light, shown: Sphere, scene: Sphere, resolution_px: u32) -> Option<ShadowMap> {
    let direction = light.direction_to_light_in_world;
    let frame = orthonormal_frame(direction);
    let texel_m = 2.0 * shown.radius / (resolution_px.saturating_sub(2 * SHADOW_BORDER_PX).max(1) as f32);
    // In double precision: far from the origin a single one could not tell texels apart.
    let (right, up) = (frame.x_axis.as_dvec3(), frame.y_axis.as_dvec3());
    let snapped = |axis: DVec3| {
        let texel = f64::from(texel_m);
        (shown.center.as_dvec3().dot(axis) / texel).round() * texel
    };
    // The scene's depth, whatever part of it is shown: what is not seen casts shadows all the same.
    let depth_m = scene.center.as_dvec3().dot(direction.as_dvec3()) + f64::from(scene.radius);
    let eye = (right * snapped(right) + up * snapped(up) + direction.as_dvec3() * depth_m).as_vec3();
    let world_from_light = Mat4::from_translation(eye) * Mat4::from_mat3(frame);
    let half_m = 0.5 * texel_m * resolution_px as f32;
    let clip_from_light = orthographic(half_m, half_m, 0.0, 2.0 * scene.radius);
    finite(ShadowMap {
        light: index,
        clip_from_world: clip_from_light * world_from_light.inverse(),
        eye_in_world: eye,
        direction_to_light: direction,
        is_orthographic: true,
        texel_m,
    })
}

/// The map of a light with a place: the scene from outside, or what lies in the cone of a spot.
fn in_perspective(index: usize, light: &Light, scene: Sphere, resolution_px: u32) -> Option<ShadowMap> {
    let to_light = light.position_in_world - scene.center;
    let distance_m = to_light.length();
    let around_scene = (distance_m > scene.radius).then(|| (scene.radius / distance_m).asin());
    let cone = match light.kind {
        LightKind::Spot { angle_scale, angle_offset } => {
            Some((-angle_offset / angle_scale).clamp(-1.0, 1.0).acos().min(WIDEST_HALF_ANGLE))
        }
        _ => None,
    };
    let (backwards, half_angle) = match (around_scene, cone) {
        (Some(around), Some(cone)) if cone <= around => (light.direction_to_light_in_world, cone),
        (Some(around), _) if around <= WIDEST_HALF_ANGLE => (to_light / distance_m, around),
        (_, Some(cone)) => (light.direction_to_light_in_world, cone),
        _ => return None,
    };
    let far_m = (distance_m + scene.radius).min(light.range_m.unwrap_or(f32::INFINITY));
    // Along the axis of a cone that points aside, what lies at its rim is nearer than straight ahead.
    let near_m = ((distance_m - scene.radius) * half_angle.cos()).max(far_m * NEAR_SHARE);
    let slope =
        half_angle.tan() * resolution_px as f32 / (resolution_px.saturating_sub(2 * SHADOW_BORDER_PX).max(1) as f32);
    let world_from_light =
        Mat4::from_translation(light.position_in_world) * Mat4::from_mat3(orthonormal_frame(backwards));
    finite(ShadowMap {
        light: index,
        clip_from_world: perspective(2.0 * slope.atan(), 1.0, near_m, far_m) * world_from_light.inverse(),
        eye_in_world: light.position_in_world,
        direction_to_light: backwards,
        is_orthographic: false,
        texel_m: 2.0 * slope / resolution_px as f32,
    })
    .filter(|_| near_m < far_m)
}

/// A map that the device can compute with.
fn finite(map: ShadowMap) -> Option<ShadowMap> {
    let is_sound = map.clip_from_world.is_finite() && map.eye_in_world.is_finite() && map.texel_m > 0.0;
    is_sound.then_some(map)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asset::Asset;
    use crate::math::Aabb;
    use crate::scene::{CameraChoice, Pose, camera};

    const RESOLUTION_PX: u32 = 1024;

    fn view(scene: Sphere, radius_m: f32, theta_deg: f32) -> Camera {
        let (phi_deg, fov_deg) = (60.0, 40.0);
        let choice =
            CameraChoice::Orbit { theta_deg, phi_deg, radius_m: Some(radius_m), target: Some(scene.center), fov_deg };
        let half = Vec3::splat(scene.radius / 3f32.sqrt());
        let hull = Hull::of_box(Aabb { min: scene.center - half, max: scene.center + half });
        camera(&Asset::default(), 0, &Pose::default(), &choice, 1.5, &hull).unwrap()
    }

    fn spot(position_in_world: Vec3, outer: f32) -> Light {
        let angle_scale = 1.0 / (1.0 - outer.cos()).max(1e-3);
        let kind = LightKind::Spot { angle_scale, angle_offset: -outer.cos() * angle_scale };
        Light { kind, position_in_world, direction_to_light_in_world: Vec3::Y, ..Light::key() }
    }

    fn maps(light: Light, scene: Sphere, camera: &Camera) -> ShadowMaps {
        shadow_maps(&[light], |_| true, scene, camera, RESOLUTION_PX)
    }

    /// Inside the map and before its far plane.
    fn shows(map: &ShadowMap, point: Vec3) -> bool {
        let clip = map.clip_from_world * point.extend(1.0);
        let seen = clip.truncate() / clip.w;
        clip.w > 0.0 && seen.truncate().abs().max_element() <= 1.0 && (0.0..=1.0).contains(&seen.z)
    }

    fn around(scene: Sphere) -> Vec<Vec3> {
        let axes = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::new(0.6, -0.48, 0.64), Vec3::new(-0.48, 0.6, 0.64)];
        axes.iter()
            .flat_map(|axis| [1.0, -1.0].map(|sign| scene.center + *axis * (sign * 0.999 * scene.radius)))
            .collect()
    }

    #[test]
    fn scenes_of_every_size_are_shown_whole_by_every_kind_of_light() {
        for (center, radius) in [
            (Vec3::ZERO, 1.0),
            (Vec3::new(3.0, -2.0, 5.0), 1e-3),
            (Vec3::new(1e3, 0.0, -1e3), 400.0),
            (Vec3::ZERO, 1e-6),
            (Vec3::ZERO, 1e5),
        ] {
            let scene = Sphere { center, radius };
            let camera = view(scene, 3.0 * radius, 20.0);
            let above = center + Vec3::Y * (4.0 * radius);
            let point = Light { kind: LightKind::Point, position_in_world: above, ..Light::key() };
            for light in [Light::key(), spot(above, 1.5), point] {
                let found = maps(light, scene, &camera);
                assert_eq!((found.maps.len(), found.without.len()), (1, 0), "{center} {radius}");
                for place in around(scene) {
                    assert!(shows(&found.maps[0], place), "{center} {radius}: {place}");
                }
            }
        }
    }

    #[test]
    fn a_near_camera_gets_finer_maps_of_what_is_near() {
        let scene = Sphere { center: Vec3::ZERO, radius: 50.0 };
        let camera = view(scene, 1.0, 0.0);
        let found = maps(Light::key(), scene, &camera).maps;
        assert_eq!(found.len(), 3);
        assert!(found.windows(2).all(|pair| pair[0].texel_m < 0.5 * pair[1].texel_m));
        let ahead = camera.eye_in_world() - camera.backwards_in_world();
        assert!(found.iter().all(|map| shows(map, ahead)));
        // What is seen far away is in the last.
        assert!(shows(&found[2], camera.eye_in_world() - camera.backwards_in_world() * 45.0));
        // Every depth that the camera sees within the scene is in some map.
        for step in 1..100 {
            let place = camera.eye_in_world() - camera.backwards_in_world() * (0.49 * step as f32);
            assert!(found.iter().any(|map| shows(map, place)), "{place}");
        }
    }

    #[test]
    fn moving_and_turning_cameras_move_maps_by_whole_texels() {
        let scene = Sphere { center: Vec3::new(0.3, 0.1, -0.2), radius: 50.0 };
        let reference = maps(Light::key(), scene, &view(scene, 1.0, 0.0)).maps;
        for theta_deg in [0.01, 0.3, 40.0] {
            let moved = maps(Light::key(), scene, &view(scene, 1.0 + 1e-3 * theta_deg, theta_deg)).maps;
            assert_eq!(moved.len(), reference.len());
            for (a, b) in reference.iter().zip(&moved) {
                assert_eq!(a.texel_m, b.texel_m);
                let shift = (a.clip_from_world.w_axis - b.clip_from_world.w_axis) * (0.5 * RESOLUTION_PX as f32);
                assert!((shift.x - shift.x.round()).abs() < 0.02, "{shift}");
                assert!((shift.y - shift.y.round()).abs() < 0.02, "{shift}");
            }
        }
    }

    #[test]
    fn nothing_without_size_and_no_light_amid_the_scene_has_a_map() {
        assert_eq!(bounding_sphere(&Hull::default()), None);
        assert_eq!(bounding_sphere(&Hull::of_box(Aabb::around([Vec3::ONE]))), None);
        let scene = Sphere { center: Vec3::ZERO, radius: 1.0 };
        let camera = view(scene, 3.0, 0.0);
        let amid = Light { kind: LightKind::Point, position_in_world: Vec3::ZERO, ..Light::key() };
        assert_eq!(maps(amid, scene, &camera).without, [0]);
        // A spot amid the scene lights what lies in its cone.
        let found = maps(spot(Vec3::Y * 0.5, 0.5), scene, &camera).maps;
        assert!(shows(&found[0], Vec3::ZERO) && !shows(&found[0], Vec3::Y * 0.9));
    }

    #[test]
    fn lights_beyond_the_maps_there_are_cast_none() {
        let scene = Sphere { center: Vec3::ZERO, radius: 1.0 };
        let lights = vec![Light::key(); MAX_SHADOW_MAPS + 2];
        let found = shadow_maps(&lights, |index| index != 3, scene, &view(scene, 3.0, 0.0), RESOLUTION_PX);
        assert_eq!(found.maps.len(), MAX_SHADOW_MAPS);
        assert_eq!(found.without, [MAX_SHADOW_MAPS + 1]);
        assert!(found.maps.iter().all(|map| map.light != 3));
    }
}
