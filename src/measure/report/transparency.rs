//! Ways to lay over each other what blends: sorted a pixel, weighted, sorted by objects, against what a compositor in
//! double precision makes of the same triangles.

use super::feature::{Clock, Feature, Point, mark_fronts};
use super::measurement::FrameMs;
use super::metric::{Radiance, picture_error};
use super::{Effort, Progress, ReportError};
use crate::asset::procedural::sphere;
use crate::asset::{AlphaMode, Asset, AssetScene, Material, Mesh, Node, Primitive, Vertices};
use crate::gpu::Gpu;
use crate::measure::twin::hash;
use crate::measure::twin::transparency::{Layer, composed};
use crate::render::{FrameOptions, FrameSetup, Pass, Renderer, Transparency};
use crate::scene::{CameraChoice, Scene};
use glam::{DVec2, DVec3, DVec4, Quat, Vec2, Vec3, Vec4};

const METHODS: [(&str, Transparency, bool); 3] = [
    ("per pixel (default)", Transparency::PerPixel, false),
    ("weighted by depth", Transparency::Weighted, true),
    ("sorted by objects", Transparency::Sorted, true),
];
const SAMPLES: [u32; 2] = [1, 4];
/// Samples of the reference along each side of a pixel.
const REFERENCE_SIDE: u32 = 8;

/// Something without light: its colour, and its opacity.
struct Body {
    primitive: Primitive,
    color: Vec4,
}

/// The feature's points.
///
/// # Errors
/// When the device fails.
pub fn feature(gpu: &Gpu, effort: &Effort, clock: Clock, progress: &mut Progress) -> Result<Feature, ReportError> {
    let stages = [("crossed sheets", sheets()), ("folds over a ball", folds()), ("fringe through a sheet", fringe())];
    let mut points = Vec::new();
    for (done, (name, bodies)) in stages.iter().enumerate() {
        progress("transparency", done, stages.len());
        let scene = scene(bodies)?;
        let truth =
            truth(bodies, &FrameSetup::new(&scene, &options(effort, 1, Transparency::PerPixel))?, effort.swatch_size);
        let mut stage_points = Vec::new();
        for msaa in SAMPLES {
            for (method, transparency, is_classic) in METHODS {
                let options = options(effort, msaa, transparency);
                // A renderer of its own: what another method drew must not have grown its lists.
                let mut renderer = Renderer::with_gpu(gpu.clone());
                let (picture, _) = renderer.render_reported(&scene, &options, true)?;
                let error = picture_error(&Radiance::of(&picture), &truth, DVec3::ZERO);
                stage_points.push((method, is_classic, msaa, error, renderer, options, Vec::new()));
            }
        }
        for _ in 0..effort.rounds {
            for (.., renderer, options, frames) in &mut stage_points {
                let (_, report) = renderer.render_reported(&scene, options, false)?;
                frames.push(FrameMs::of(&report, &[Pass::Opaque, Pass::OitBuild, Pass::OitResolve]));
            }
        }
        points.extend(stage_points.into_iter().map(|(method, is_classic, msaa, error, _, _, frames)| Point {
            is_classic,
            ..Point::of_frames(method, ("samples", msaa), name, (&frames, clock), error)
        }));
    }
    mark_fronts(&mut points);
    Ok(Feature {
        name: "transparency",
        reference: format!("composed in double precision, {0} x {0} samples a pixel", REFERENCE_SIDE),
        reference_noise: 0.0,
        points,
        notes: vec![
            "weights are applied to the lists of the sorted way: what they save of its time is the sorting alone"
                .to_owned(),
        ],
    })
}

fn options(effort: &Effort, msaa: u32, transparency: Transparency) -> FrameOptions {
    let (radius_m, target) = (Some(6.0), Some(Vec3::ZERO));
    let camera = CameraChoice::Orbit { theta_deg: 25.0, phi_deg: 75.0, radius_m, target, fov_deg: 22.0 };
    FrameOptions { size: effort.swatch_size, msaa, transparency, camera, ..FrameOptions::default() }
}

fn scene(bodies: &[Body]) -> Result<Scene, ReportError> {
    let mut asset = Asset::default();
    for (index, Body { primitive, color }) in bodies.iter().enumerate() {
        let alpha_mode = if color.w < 1.0 { AlphaMode::Blend } else { AlphaMode::Opaque };
        let material =
            Material { base_color: *color, unlit: true, double_sided: true, alpha_mode, ..Material::default() };
        asset.materials.push(material);
        let mut primitive = Primitive { material: index, ..primitive.clone() };
        // No light is there to read them.
        primitive.vertices.normals = vec![Vec3::Z; primitive.vertices.positions.len()];
        let primitives = vec![primitive];
        asset.meshes.push(Mesh { name: None, primitives, weights: Vec::new() });
        asset.nodes.push(Node { mesh: Some(index), ..Node::default() });
    }
    asset.scenes.push(AssetScene { name: None, roots: (0..bodies.len()).collect() });
    Ok(Scene::from_asset(asset)?)
}

/// Vertices on a grid of `columns` by `rows` cells; `place` takes shares of both, in [-1, 1].
fn grid(columns: u32, rows: u32, place: impl Fn(Vec2) -> Vec3) -> Primitive {
    let share = |index: u32, count: u32| 2.0 * index as f32 / count as f32 - 1.0;
    let at = |index: u32| place(Vec2::new(share(index % (columns + 1), columns), share(index / (columns + 1), rows)));
    let corners = |cell: u32| {
        let first = cell / columns * (columns + 1) + cell % columns;
        [first, first + 1, first + columns + 2, first, first + columns + 2, first + columns + 1]
    };
    Primitive {
        vertices: Vertices { positions: (0..(columns + 1) * (rows + 1)).map(at).collect(), ..Vertices::default() },
        indices: (0..columns * rows).flat_map(corners).collect(),
        ..Primitive::default()
    }
}

/// Three sheets through one line.
fn sheets() -> Vec<Body> {
    let colors = [Vec4::new(0.9, 0.15, 0.1, 0.6), Vec4::new(0.1, 0.7, 0.2, 0.5), Vec4::new(0.15, 0.2, 0.9, 0.7)];
    let sheet = |(index, color): (usize, Vec4)| {
        let turn = Quat::from_rotation_y(index as f32 * std::f32::consts::FRAC_PI_3);
        Body { primitive: grid(1, 1, |share| turn * share.extend(0.0)), color }
    };
    colors.into_iter().enumerate().map(sheet).collect()
}

/// A sheet in folds deep enough to hide each other, around an opaque ball.
fn folds() -> Vec<Body> {
    let wave = |share: Vec2| Vec3::new(1.6 * share.x, share.y, 0.6 * (9.0 * share.x + share.y).sin());
    let ball = Body { primitive: sphere(0.5, 24), color: Vec4::new(0.8, 0.7, 0.3, 1.0) };
    vec![Body { primitive: grid(96, 12, wave), color: Vec4::new(0.3, 0.1, 0.6, 0.4) }, ball]
}

/// Ribbons that lean every way, and a sheet that they stand through.
fn fringe() -> Vec<Body> {
    let (mut positions, mut indices) = (Vec::new(), Vec::new());
    for ribbon in 0..160 {
        let random = |axis: i32| hash::cell([ribbon, axis, 7]).map(|share| (2.0 * share - 1.0) as f32);
        let [foot, lean] = [random(0), random(1)].map(Vec3::from_array);
        let foot = foot * Vec3::new(1.6, 0.0, 0.5);
        let (low, high) = (foot - Vec3::Y, foot + Vec3::Y + lean * 0.4);
        let first = positions.len() as u32;
        let half_width = Vec3::X * 0.03;
        positions.extend([low - half_width, low + half_width, high + half_width, high - half_width]);
        indices.extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
    }
    let vertices = Vertices { positions, ..Vertices::default() };
    let ribbons = Primitive { vertices, indices, ..Primitive::default() };
    let sheet = grid(1, 1, |share| Vec3::new(1.8 * share.x, share.y, 0.4 * share.x));
    vec![
        Body { primitive: ribbons, color: Vec4::new(0.7, 0.5, 0.25, 0.6) },
        Body { primitive: sheet, color: Vec4::new(0.1, 0.4, 0.8, 0.5) },
    ]
}

/// What the camera of a shot sees of the bodies.
fn truth(bodies: &[Body], shot: &FrameSetup, size: [u32; 2]) -> Radiance {
    let clip_from_world = shot.camera.clip_from_world().as_dmat4();
    let side = f64::from(REFERENCE_SIDE);
    let extent = DVec2::new(f64::from(size[0]), f64::from(size[1])) * side;
    let mut layers: Vec<Vec<Layer>> = vec![Vec::new(); (extent.x * extent.y) as usize];
    for Body { primitive, color } in bodies {
        let opacity = f64::from(color.w);
        let radiance = color.truncate().as_dvec3() * opacity;
        let corner = |index: u32| {
            let clip = clip_from_world * primitive.vertices.positions[index as usize].as_dvec3().extend(1.0);
            (clip.truncate() / clip.w * DVec3::new(0.5, -0.5, 1.0) + DVec3::new(0.5, 0.5, 0.0)) * extent.extend(1.0)
        };
        for triangle in primitive.indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|at| corner(triangle[at]));
            let area = (b - a).truncate().perp_dot((c - a).truncate());
            let low = a.min(b).min(c).floor().max(DVec3::ZERO);
            let high = a.max(b).max(c).ceil().truncate().min(extent);
            for y in low.y as u32..high.y.max(0.0) as u32 {
                for x in low.x as u32..high.x.max(0.0) as u32 {
                    let at = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) - a.truncate();
                    let v = at.perp_dot((c - a).truncate()) / area;
                    let w = (b - a).truncate().perp_dot(at) / area;
                    // The half-open side keeps samples on a shared edge from counting twice.
                    if v >= 0.0 && w > 0.0 && v + w <= 1.0 {
                        let depth = a.z + v * (b.z - a.z) + w * (c.z - a.z);
                        let layer = Layer { distance: -depth, radiance, transmittance: DVec3::splat(1.0 - opacity) };
                        layers[(f64::from(y) * extent.x) as usize + x as usize].push(layer);
                    }
                }
            }
        }
    }
    let sample = |x: u32, y: u32| {
        let found = &layers[(f64::from(y) * extent.x) as usize + x as usize];
        let passed: f64 = found.iter().map(|layer| layer.transmittance.x).product();
        composed(found, DVec3::ZERO).extend(1.0 - passed)
    };
    let pixel = |index: u32| {
        let (left, top) = (index % size[0] * REFERENCE_SIDE, index / size[0] * REFERENCE_SIDE);
        let samples = (0..REFERENCE_SIDE * REFERENCE_SIDE)
            .map(|index| sample(left + index % REFERENCE_SIDE, top + index / REFERENCE_SIDE));
        samples.sum::<DVec4>() / (side * side)
    };
    Radiance { size, pixels: (0..size[0] * size[1]).map(pixel).collect() }
}
