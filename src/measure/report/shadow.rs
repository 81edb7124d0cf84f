//! Shadows of lights: error and time by the resolution of the maps and the radius of their filter, against shadows that
//! are computed by rays.

use super::feature::{Clock, Feature, Point, mark_fronts};
use super::measurement::FrameMs;
use super::metric::{Radiance, picture_error};
use super::{Effort, Progress, ReportError};
use crate::asset::procedural::{plane, sphere};
use crate::asset::{Asset, AssetScene, Material, Mesh, Node, Transform};
use crate::gpu::Gpu;
use crate::render::{FrameOptions, FrameSetup, Pass, Renderer, SHADOW_FILTERS_PX, Shadows};
use crate::scene::{Camera, CameraChoice, EnvironmentLight, Light, Scene};
use glam::{DVec3, Quat, Vec3};

/// Texels of a map's sides.
const RESOLUTIONS_PX: [u32; 5] = [256, 512, 1024, 2048, 4096];
/// Middle and radius of the balls over the floor, metres.
const BALLS: [(DVec3, f64); 2] = [(DVec3::new(0.0, 0.3, 0.0), 0.25), (DVec3::new(0.42, 0.62, 0.2), 0.1)];
/// Half a side of the floor, metres.
const FLOOR_M: f32 = 1.2;
/// Names of the methods, by the radius of the filter.
const METHODS: [&str; 3] = ["filter of 1 texel", "filter of 2 texels (default)", "filter of 3 texels"];
/// Rays start so far off what they start on, metres.
const CLEARANCE_M: f64 = 1e-4;

/// The feature.
///
/// # Errors
/// When the device fails.
pub fn feature(gpu: &Gpu, effort: &Effort, clock: Clock, progress: &mut Progress) -> Result<Feature, ReportError> {
    let scene = stage()?;
    let mut renderer = Renderer::with_gpu(gpu.clone());
    let none = Shadows { are_cast: false, ..Shadows::default() };
    let lit = frame(effort, none);
    let dark = FrameOptions { lights: Vec::new(), ..lit.clone() };
    let [lit_picture, dark_picture] = [picture(&mut renderer, &scene, &lit)?, picture(&mut renderer, &scene, &dark)?];
    let camera = FrameSetup::new(&scene, &lit)?.camera;
    let to_light = Light::key().direction_to_light_in_world.as_dvec3();
    let pixels = lit_picture.pixels.iter().zip(&dark_picture.pixels).enumerate().map(|(index, (lit, dark))| {
        let pixel = [index as u32 % effort.size[0], index as u32 / effort.size[0]];
        if is_lit(&camera, effort.size, pixel, to_light) { *lit } else { *dark }
    });
    let reference = Radiance { size: effort.size, pixels: pixels.collect() };

    let mut points = Vec::new();
    for (filter_px, method) in SHADOW_FILTERS_PX.zip(METHODS) {
        for resolution_px in RESOLUTIONS_PX {
            progress("shadow", points.len(), METHODS.len() * RESOLUTIONS_PX.len());
            let options = frame(effort, Shadows { resolution_px, filter_px, ..Shadows::default() });
            let error = picture_error(&picture(&mut renderer, &scene, &options)?, &reference, DVec3::ZERO);
            let mut frames = Vec::new();
            for _ in 0..effort.rounds {
                let (_, report) = renderer.render_reported(&scene, &options, false)?;
                frames.push(FrameMs::of(&report, &[Pass::ShadowMap, Pass::Opaque]));
            }
            let knob = ("resolution_px", resolution_px);
            points.push(Point::of_frames(method, knob, "balls", (&frames, clock), error));
        }
    }
    mark_fronts(&mut points);
    Ok(Feature {
        name: "shadow",
        reference: "shadows of balls on a floor by rays in double precision, one a pixel".to_owned(),
        reference_noise: 0.0,
        points,
        notes: Vec::new(),
    })
}

/// Balls over a floor.
fn stage() -> Result<Scene, ReportError> {
    let material = Material { metallic: 0.0, roughness: 1.0, ..Material::default() };
    let mut asset = Asset { materials: vec![material], ..Asset::default() };
    let balls = BALLS.map(|(center, radius)| (sphere(radius as f32, 64), center.as_vec3()));
    for (primitive, translation) in [(plane(FLOOR_M, FLOOR_M, 1), Vec3::ZERO)].into_iter().chain(balls) {
        asset.meshes.push(Mesh { primitives: vec![primitive], ..Mesh::default() });
        let transform = Transform::Trs { translation, rotation: Quat::IDENTITY, scale: Vec3::ONE };
        asset.nodes.push(Node { mesh: Some(asset.meshes.len() - 1), transform, ..Node::default() });
    }
    asset.scenes.push(AssetScene { name: None, roots: (0..asset.nodes.len()).collect() });
    Ok(Scene::from_asset(asset)?)
}

fn frame(effort: &Effort, shadows: Shadows) -> FrameOptions {
    FrameOptions {
        size: effort.size,
        msaa: 1,
        camera: CameraChoice::Orbit { theta_deg: 20.0, phi_deg: 55.0, radius_m: None, target: None, fov_deg: 30.0 },
        environment: EnvironmentLight::constant(Vec3::splat(0.05)),
        lights: vec![Light::key()],
        shadows,
        ..FrameOptions::default()
    }
}

fn picture(renderer: &mut Renderer, scene: &Scene, options: &FrameOptions) -> Result<Radiance, ReportError> {
    let (picture, _) = renderer.render_reported(scene, options, true)?;
    Ok(Radiance::of(&picture))
}

/// Whether nothing stands between the light and what the middle of a pixel shows.
fn is_lit(camera: &Camera, size: [u32; 2], pixel: [u32; 2], to_light: DVec3) -> bool {
    let [x, y] = [0, 1].map(|axis| (f64::from(pixel[axis]) + 0.5) / f64::from(size[axis]) * 2.0 - 1.0);
    let scale = [camera.clip_from_camera.x_axis.x, camera.clip_from_camera.y_axis.y].map(f64::from);
    let axes = camera.world_from_camera.as_dmat4();
    let way = axes.transform_vector3(DVec3::new(x / scale[0], -y / scale[1], -1.0)).normalize();
    let eye = camera.eye_in_world().as_dvec3();
    let floor = (-eye.y / way.y, None);
    let balls = BALLS.iter().filter_map(|ball| Some((distance_m(eye, way, *ball)?, Some(ball.0))));
    let Some((at, ball)) =
        [floor].into_iter().chain(balls).filter(|(at, _)| *at > 0.0).min_by(|a, b| a.0.total_cmp(&b.0))
    else {
        return true;
    };
    let place = eye + way * at;
    let normal = ball.map_or(DVec3::Y, |center| (place - center).normalize());
    let start = place + normal * CLEARANCE_M;
    normal.dot(to_light) > 0.0
        && !BALLS.iter().any(|ball| distance_m(start, to_light, *ball).is_some_and(|at| at > 0.0))
}

/// Distance along a unit vector to a ball; `None` where it is missed.
fn distance_m(start: DVec3, way: DVec3, (center, radius): (DVec3, f64)) -> Option<f64> {
    let to_center = center - start;
    let along = to_center.dot(way);
    let inside = radius * radius - (to_center.length_squared() - along * along);
    (inside >= 0.0).then(|| along - inside.sqrt())
}
