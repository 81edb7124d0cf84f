//! Where the picture is taken from: a camera of the file, an orbit, or a view that frames the scene.

use glam::{Mat3, Mat4, Vec2, Vec3};

use super::{Pose, SceneError, find_camera, nodes_of_scene};
use crate::asset::{Asset, Projection};
use crate::math::{Aabb, Hull, orthographic, perspective, perspective_infinite};

/// Horizontal angle of the framing view: three quarters from the front.
pub const DEFAULT_THETA_DEG: f32 = 35.0;
/// Angle from the zenith of the framing view: a little from above.
pub const DEFAULT_PHI_DEG: f32 = 75.0;
/// Vertical field of view of the framing view and of an orbit.
pub const DEFAULT_FOV_DEG: f32 = 35.0;

/// Share of the picture's half size that a framed box may reach: 8 % stay free on each side.
const FRAMED_SHARE: f32 = 0.92;
/// The framing distance of something without size, metres.
const DISTANCE_TO_A_POINT_M: f32 = 1.0;
/// The framing view keeps this share of the bounding radius between the eye and the nearest corner.
const CLEARANCE_RADII: f32 = 0.1;
/// Fur and displacement reach beyond the bounds: the near plane keeps this many bounding radii away from their middle.
const KEPT_RADII: f32 = 1.5;
/// Nearest near plane, as a share of the scene's radius or distance: float depth reversed has precision to spare.
const NEAR_SHARE: f32 = 1e-3;

/// Which view to take.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum CameraChoice {
    /// Frames the scene; a file's own cameras are only used when asked for.
    #[default]
    Auto,
    /// A camera of the file by its name, by the name of its node, or by its number in text.
    Named(String),
    /// A camera of the file.
    Index(usize),
    /// eye = target + radius (sin phi sin theta, cos phi, sin phi cos theta), Y up.
    Orbit {
        /// Degrees around Y; 0 looks from +Z.
        theta_deg: f32,
        /// Degrees from +Y; 0 looks straight down, -Z then is the picture's top where theta is 0.
        phi_deg: f32,
        /// Metres, > 0; `None` = far enough to show the whole scene.
        radius_m: Option<f32>,
        /// World space; `None` = the middle of the scene.
        target: Option<Vec3>,
        /// Vertical field of view, in (0, 180).
        fov_deg: f32,
    },
}

/// A view: where, and how it projects. Clip space as in [`math`](crate::math): Y up, depth 1 near, 0 far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Columns: right, up, backwards (unit length), eye.
    pub world_from_camera: Mat4,
    /// Inverse of `world_from_camera`.
    pub camera_from_world: Mat4,
    /// Projection.
    pub clip_from_camera: Mat4,
    /// Rays are parallel: the direction to the eye is the same everywhere.
    pub is_orthographic: bool,
}

impl Camera {
    fn new(axes: Mat3, eye_in_world: Vec3, clip_from_camera: Mat4, is_orthographic: bool) -> Self {
        let world_from_camera = Mat4::from_mat3_translation(axes, eye_in_world);
        let inverse_axes = axes.transpose();
        let camera_from_world = Mat4::from_mat3_translation(inverse_axes, -(inverse_axes * eye_in_world));
        Self { world_from_camera, camera_from_world, clip_from_camera, is_orthographic }
    }

    /// Both steps at once.
    pub fn clip_from_world(&self) -> Mat4 {
        self.clip_from_camera * self.camera_from_world
    }

    /// Position of the eye.
    pub fn eye_in_world(&self) -> Vec3 {
        self.world_from_camera.w_axis.truncate()
    }

    /// Unit length, from the picture towards the viewer.
    pub fn backwards_in_world(&self) -> Vec3 {
        self.world_from_camera.z_axis.truncate()
    }

    /// Pixels that one metre covers at a distance (facing the camera), for a picture `height_px` high. An orthographic
    /// camera ignores the distance.
    pub fn pixels_per_metre(&self, distance_m: f32, height_px: f32) -> f32 {
        let scale = 0.5 * height_px * self.clip_from_camera.y_axis.y;
        if self.is_orthographic { scale } else { scale / distance_m.max(f32::MIN_POSITIVE) }
    }
}

/// The chosen view of a scene.
///
/// `aspect` is the picture's width / height; `shown` is the outline of what should be framed ([`world_hull`](super::world_hull)).
/// Scenes of any size, points and empty scenes give a usable camera. A file camera whose aspect differs from the
/// picture's shows at least all that the file frames; the scale of its node is ignored.
///
/// # Errors
/// [`SceneError::Unknown`] and [`SceneError::CameraOutsideScene`] for file cameras, [`SceneError::View`] for numbers
/// out of range.
pub fn camera(
    asset: &Asset,
    scene: usize,
    pose: &Pose,
    choice: &CameraChoice,
    aspect: f32,
    shown: &Hull,
) -> Result<Camera, SceneError> {
    check("the picture's width / height", aspect, aspect > 0.0, "a number above 0")?;
    match choice {
        CameraChoice::Auto => orbit(DEFAULT_THETA_DEG, DEFAULT_PHI_DEG, None, None, DEFAULT_FOV_DEG, aspect, shown),
        &CameraChoice::Orbit { theta_deg, phi_deg, radius_m, target, fov_deg } => {
            orbit(theta_deg, phi_deg, radius_m, target, fov_deg, aspect, shown)
        }
        CameraChoice::Index(index) => of_file(asset, scene, pose, &index.to_string(), Some(*index), aspect),
        CameraChoice::Named(name) => of_file(asset, scene, pose, name, None, aspect),
    }
}

fn orbit(
    theta_deg: f32,
    phi_deg: f32,
    radius_m: Option<f32>,
    target: Option<Vec3>,
    fov_deg: f32,
    aspect: f32,
    shown: &Hull,
) -> Result<Camera, SceneError> {
    check("the orbit's theta", theta_deg, true, "degrees")?;
    check("the orbit's phi", phi_deg, true, "degrees")?;
    check("the field of view", fov_deg, fov_deg > 0.0 && fov_deg < 180.0, "degrees between 0 and 180")?;
    if let Some(radius_m) = radius_m {
        check("the orbit's radius", radius_m, radius_m > 0.0, "metres above 0")?;
    }
    if let Some(target) = target {
        check("the target", target.length(), true, "three finite coordinates")?;
    }
    let fov = fov_deg.to_radians();
    let axes = orbit_axes(theta_deg, phi_deg);
    let bounds = shown.bounds();
    let target = target.unwrap_or_else(|| match radius_m {
        Some(_) => bounds.center(),
        None => framing_target(axes, fov, aspect, shown),
    });
    let radius_m = radius_m.unwrap_or_else(|| framing_distance_m(axes, target, fov, aspect, shown));
    let eye = target + axes.z_axis * radius_m;
    Ok(Camera::new(axes, eye, perspective_infinite(fov, aspect, near_m(eye, target, bounds)), false))
}

/// Right, up, backwards. Written out instead of by cross products with Y, so that straight up and down are no
/// exception.
fn orbit_axes(theta_deg: f32, phi_deg: f32) -> Mat3 {
    let (sin_theta, cos_theta) = sin_cos_deg(theta_deg);
    let (sin_phi, cos_phi) = sin_cos_deg(phi_deg);
    let right = Vec3::new(cos_theta, 0.0, -sin_theta);
    let backwards = Vec3::new(sin_phi * sin_theta, cos_phi, sin_phi * cos_theta);
    Mat3::from_cols(right, backwards.cross(right), backwards)
}

/// In f64: the sine of 180 degrees is then zero to within f32.
fn sin_cos_deg(angle_deg: f32) -> (f32, f32) {
    let (sin, cos) = f64::from(angle_deg).to_radians().sin_cos();
    (sin as f32, cos as f32)
}

/// The point to look at so that the outline sits in the middle of the picture: the near side of a thing shows larger
/// than its far side, so the middle of its box would not do.
fn framing_target(axes: Mat3, fov: f32, aspect: f32, shown: &Hull) -> Vec3 {
    let mut target = shown.bounds().center();
    // Each round leaves a small share of the offset; three leave none that a pixel shows.
    for _ in 0..3 {
        let distance_m = framing_distance_m(axes, target, fov, aspect, shown);
        let camera_from_world = axes.transpose();
        let (mut least, mut most) = (Vec2::MAX, Vec2::MIN);
        for &point in shown.points() {
            let point = camera_from_world * (point - target);
            let seen = point.truncate() / (distance_m - point.z).max(f32::MIN_POSITIVE);
            (least, most) = (least.min(seen), most.max(seen));
        }
        let offset = (least + most) * (0.5 * distance_m);
        if offset.is_finite() {
            target += axes.x_axis * offset.x + axes.y_axis * offset.y;
        }
    }
    target
}

/// Nearest eye from which the whole outline falls inside the picture: a point at (x, y, z) in camera axes around the
/// target needs `|x| / (distance - z) <= tan(half fov)`, the same for y.
fn framing_distance_m(axes: Mat3, target: Vec3, fov: f32, aspect: f32, shown: &Hull) -> f32 {
    let half_height = (0.5 * fov).tan() * FRAMED_SHARE;
    let camera_from_world = axes.transpose();
    // A line seen along itself needs no width at all: the eye still stays outside.
    let clearance_m = shown.bounds().sphere().radius * CLEARANCE_RADII;
    let distance_m =
        shown.points().iter().map(|&point| camera_from_world * (point - target)).fold(0.0, |distance, point| {
            let half_size_m = (point.y.abs() / half_height).max(point.x.abs() / (half_height * aspect));
            f32::max(distance, point.z + half_size_m.max(clearance_m))
        });
    // Something without size, as seen by f32 at its place, would put the eye inside it.
    let resolution_m = target.length() * 1e-6;
    if distance_m > resolution_m { distance_m } else { DISTANCE_TO_A_POINT_M.max(resolution_m * 1e3) }
}

/// Just before everything, or close to the eye when it stands inside.
fn near_m(eye: Vec3, target: Vec3, bounds: Aabb) -> f32 {
    let sphere = bounds.sphere();
    let distance_m = if bounds.is_empty() { eye.distance(target) } else { eye.distance(sphere.center) };
    let least_m = (sphere.radius.max(distance_m) * NEAR_SHARE).max(f32::MIN_POSITIVE);
    if sphere.radius > 0.0 { (distance_m - KEPT_RADII * sphere.radius).max(least_m) } else { least_m }
}

fn of_file(
    asset: &Asset,
    scene: usize,
    pose: &Pose,
    asked: &str,
    index: Option<usize>,
    aspect: f32,
) -> Result<Camera, SceneError> {
    let index = match index.filter(|&index| index < asset.cameras.len()) {
        Some(index) => index,
        None => find_camera(asset, asked)?,
    };
    let held_by = |node: &usize| asset.nodes[*node].camera == Some(index);
    let nodes = nodes_of_scene(asset, scene);
    // Two nodes may hold one camera: a node asked for by its name goes first.
    let node = nodes
        .iter()
        .find(|node| held_by(node) && asset.nodes[**node].name.as_deref() == Some(asked))
        .or_else(|| nodes.iter().find(|node| held_by(node)))
        .ok_or_else(|| SceneError::CameraOutsideScene { camera: asked.to_owned(), scene })?;
    let world_from_node = pose.world_from_node[*node];
    let (clip_from_camera, is_orthographic) = projection(asset.cameras[index].projection, aspect);
    Ok(Camera::new(
        unscaled_axes(world_from_node),
        world_from_node.w_axis.truncate(),
        clip_from_camera,
        is_orthographic,
    ))
}

fn projection(projection: Projection, aspect: f32) -> (Mat4, bool) {
    match projection {
        Projection::Perspective { vertical_fov, aspect: file_aspect, near_m, far_m } => {
            // A picture narrower than the file's keeps the width and gains height.
            let widen = file_aspect.map_or(1.0, |file_aspect| (file_aspect / aspect).max(1.0));
            let fov = if widen > 1.0 { 2.0 * ((0.5 * vertical_fov).tan() * widen).atan() } else { vertical_fov };
            (
                far_m.map_or_else(
                    || perspective_infinite(fov, aspect, near_m),
                    |far_m| perspective(fov, aspect, near_m, far_m),
                ),
                false,
            )
        }
        Projection::Orthographic { half_width_m, half_height_m, near_m, far_m } => {
            let (half_width_m, half_height_m) = (half_width_m.abs(), half_height_m.abs());
            let half_height_m = half_height_m.max(half_width_m / aspect).max(f32::MIN_POSITIVE);
            (orthographic(half_height_m * aspect, half_height_m, near_m, far_m), true)
        }
    }
}

/// The node's rotation: it looks along its -Z with its Y upwards, whatever its scale or shear; a mirrored node's
/// picture is not mirrored.
fn unscaled_axes(world_from_node: Mat4) -> Mat3 {
    let backwards = world_from_node.z_axis.truncate().normalize_or(Vec3::Z);
    let up = world_from_node.y_axis.truncate();
    let right = up.cross(backwards).normalize_or(backwards.any_orthonormal_vector());
    Mat3::from_cols(right, backwards.cross(right), backwards)
}

fn check(field: &'static str, value: f32, in_range: bool, allowed: &'static str) -> Result<(), SceneError> {
    if value.is_finite() && in_range { Ok(()) } else { Err(SceneError::View { field, value, allowed }) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asset::{self, AssetScene, Node, Transform};
    use crate::scene::pose;
    use glam::{Quat, Vec2};

    fn view(choice: CameraChoice, aspect: f32, bounds: Aabb) -> Result<Camera, SceneError> {
        camera(&Asset::default(), 0, &Pose::default(), &choice, aspect, &Hull::of_box(bounds))
    }

    fn orbit_at(theta_deg: f32, phi_deg: f32, radius_m: f32) -> CameraChoice {
        CameraChoice::Orbit { theta_deg, phi_deg, radius_m: Some(radius_m), target: Some(Vec3::ONE), fov_deg: 40.0 }
    }

    #[test]
    fn an_orbit_stands_where_the_formula_says() {
        for (theta, phi) in [(0.0, 90.0), (35.0, 75.0), (-120.0, 10.0), (250.0, 170.0), (90.0, 0.0), (10.0, 180.0)] {
            let camera = view(orbit_at(theta, phi, 4.0), 1.5, Aabb::EMPTY).unwrap();
            let (theta, phi) = (theta.to_radians(), phi.to_radians());
            let direction = Vec3::new(phi.sin() * theta.sin(), phi.cos(), phi.sin() * theta.cos());
            assert!((camera.eye_in_world() - (Vec3::ONE + 4.0 * direction)).length() < 1e-5);
            // The target is in the middle of the picture, the frame is right-handed and the top is up.
            assert!(camera.clip_from_world().project_point3(Vec3::ONE).truncate().length() < 1e-5);
            assert!((camera.world_from_camera.determinant() - 1.0).abs() < 1e-5);
            assert!(camera.world_from_camera.y_axis.y >= -1e-6);
            let there_and_back = camera.camera_from_world * camera.world_from_camera;
            assert!(there_and_back.abs_diff_eq(Mat4::IDENTITY, 1e-5));
        }
    }

    #[test]
    fn seen_from_the_front_x_is_right_and_y_is_up() {
        let camera = view(orbit_at(0.0, 90.0, 4.0), 1.0, Aabb::EMPTY).unwrap();
        let shown = camera.clip_from_world().project_point3(Vec3::ONE + Vec3::new(0.1, 0.2, 0.0)).truncate();
        assert!(shown.x > 0.0 && shown.y > shown.x, "{shown}");
    }

    #[test]
    fn straight_down_has_minus_z_on_top() {
        let camera = view(orbit_at(0.0, 0.0, 4.0), 1.0, Aabb::EMPTY).unwrap();
        assert!((camera.world_from_camera.y_axis.truncate() - Vec3::NEG_Z).length() < 1e-6);
    }

    #[test]
    fn framing_shows_every_corner_at_every_scale_and_wastes_little() {
        let shapes = [Vec3::ONE, Vec3::new(1.0, 0.0, 1.0), Vec3::new(10.0, 1.0, 0.1), Vec3::new(0.0, 3.0, 0.0)];
        for scale in [1e-3, 1.0, 500.0] {
            for (half, aspect) in shapes.into_iter().zip([1.78, 0.5, 1.0, 3.0]) {
                let center = Vec3::new(3.0, -2.0, 1.0) * scale;
                let bounds = Aabb { min: center - half * scale, max: center + half * scale };
                for phi_deg in [0.0, DEFAULT_PHI_DEG, 180.0] {
                    let choice = CameraChoice::Orbit {
                        theta_deg: DEFAULT_THETA_DEG,
                        phi_deg,
                        radius_m: None,
                        target: None,
                        fov_deg: DEFAULT_FOV_DEG,
                    };
                    let clip_from_world = view(choice, aspect, bounds).unwrap().clip_from_world();
                    let corners = bounds.corners().map(|corner| clip_from_world.project_point3(corner));
                    let reach = corners.iter().map(|c| c.truncate().abs().max_element()).fold(0.0, f32::max);
                    let seen_from_the_end = half.x == 0.0 && phi_deg != DEFAULT_PHI_DEG;
                    assert!(reach < 0.921, "{scale} {half} {phi_deg}: {reach}");
                    assert!(reach > 0.919 || seen_from_the_end, "{scale} {half} {phi_deg}: {reach}");
                    assert!(corners.iter().all(|c| c.z > 0.0 && c.z < 1.0), "{corners:?}");
                }
            }
        }
    }

    #[test]
    fn points_and_empty_scenes_give_a_usable_camera() {
        for bounds in [Aabb::EMPTY, Aabb::around([Vec3::splat(2.0)]), Aabb::around([Vec3::splat(1e5)])] {
            let camera = view(CameraChoice::Auto, 1.6, bounds).unwrap();
            let middle = camera.clip_from_world().project_point3(bounds.center());
            assert!(middle.is_finite() && middle.truncate().length() < 0.1, "{middle}");
            assert!(middle.z > 0.0 && middle.z < 1.0);
        }
    }

    #[test]
    fn an_eye_inside_the_scene_keeps_a_near_plane() {
        let bounds = Aabb { min: Vec3::splat(-100.0), max: Vec3::splat(100.0) };
        let camera = view(orbit_at(0.0, 90.0, 2.0), 1.0, bounds).unwrap();
        let near_m = camera.clip_from_camera.w_axis.z;
        assert!(near_m > 0.0 && near_m < 1.0, "{near_m}");
    }

    #[test]
    fn numbers_out_of_range_are_named() {
        let fov = CameraChoice::Orbit { theta_deg: 0.0, phi_deg: 90.0, radius_m: None, target: None, fov_deg: 180.0 };
        for (choice, aspect, field) in [
            (fov, 1.0, "the field of view"),
            (orbit_at(0.0, 0.0, 0.0), 1.0, "the orbit's radius"),
            (orbit_at(f32::NAN, 0.0, 1.0), 1.0, "the orbit's theta"),
            (CameraChoice::Auto, 0.0, "the picture's width / height"),
        ] {
            let error = view(choice, aspect, Aabb::EMPTY).unwrap_err();
            assert!(matches!(error, SceneError::View { field: named, .. } if named == field), "{error}");
        }
    }

    fn tripod(projection: Projection) -> Asset {
        let transform = Transform::Trs {
            translation: Vec3::new(5.0, 0.0, 0.0),
            // -Z turns to -X.
            rotation: Quat::from_rotation_y(std::f32::consts::FRAC_PI_2),
            scale: Vec3::new(-3.0, 0.5, 2.0),
        };
        Asset {
            scenes: vec![AssetScene { name: None, roots: vec![0] }, AssetScene::default()],
            nodes: vec![Node { name: Some("tripod".into()), camera: Some(0), transform, ..Node::default() }],
            cameras: vec![asset::Camera { name: None, projection }],
            ..Asset::default()
        }
    }

    #[test]
    fn a_file_camera_is_found_by_node_and_ignores_scale() {
        let asset = tripod(Projection::Perspective { vertical_fov: 1.0, aspect: None, near_m: 0.1, far_m: Some(10.0) });
        let pose = pose(&asset, None, 0.0);
        let at = |choice: CameraChoice, scene| camera(&asset, scene, &pose, &choice, 1.0, &Hull::default());
        let camera = at(CameraChoice::Named("tripod".into()), 0).unwrap();
        assert_eq!(at(CameraChoice::Index(0), 0).unwrap(), camera);
        assert!((camera.eye_in_world() - Vec3::X * 5.0).length() < 1e-6);
        assert!((camera.backwards_in_world() - Vec3::X).length() < 1e-6);
        assert!((camera.world_from_camera.determinant() - 1.0).abs() < 1e-6);
        assert!(!camera.is_orthographic);
        assert!(matches!(at(CameraChoice::Index(0), 1), Err(SceneError::CameraOutsideScene { scene: 1, .. })));
        assert!(matches!(at(CameraChoice::Index(3), 0), Err(SceneError::Unknown { kind: "camera", .. })));
        assert!(matches!(at(CameraChoice::Named("x".into()), 0), Err(SceneError::Unknown { kind: "camera", .. })));
    }

    #[test]
    fn a_picture_of_another_aspect_still_shows_what_the_file_frames() {
        let file_aspect = 2.0;
        let wide = Projection::Perspective { vertical_fov: 1.0, aspect: Some(file_aspect), near_m: 0.1, far_m: None };
        let parallel = Projection::Orthographic { half_width_m: 2.0, half_height_m: 1.0, near_m: 0.0, far_m: 10.0 };
        let edge = 0.5f32.tan();
        for (projected, corner) in
            [(wide, Vec3::new(file_aspect * edge, edge, -1.0)), (parallel, Vec3::new(2.0, 1.0, -1.0))]
        {
            for (aspect, expected) in [(1.0, Vec2::new(1.0, 0.5)), (2.0, Vec2::ONE), (4.0, Vec2::new(0.5, 1.0))] {
                let (clip_from_camera, _) = projection(projected, aspect);
                let shown = clip_from_camera.project_point3(corner).truncate();
                assert!((shown - expected).length() < 1e-5, "{projected:?} at {aspect}: {shown}");
            }
        }
    }

    #[test]
    fn a_metre_covers_the_pixels_that_the_projection_says() {
        let camera = view(orbit_at(0.0, 90.0, 2.0), 1.0, Aabb::EMPTY).unwrap();
        let shown = camera.clip_from_world().project_point3(Vec3::new(1.0, 2.0, 1.0));
        assert!((camera.pixels_per_metre(2.0, 100.0) - shown.y * 50.0).abs() < 1e-3);
    }
}
