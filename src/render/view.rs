//! A view: matrices, viewport and exposure of one camera in one frame.

use super::RenderError;
use crate::scene::Camera;
use glam::{Mat4, Vec2, Vec3, Vec4};

/// A camera in one frame: any projection, of either sense of depth and of clip space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// From world space (right-handed, metres) to the camera's axes, which looks along its -Z.
    pub view_from_world: Mat4,
    /// Projection, with the depth that [`Target::depth_order`](super::Target::depth_order) declares. Jitter comes on top.
    pub clip_from_view: Mat4,
    /// Top left corner and size of what is drawn to, pixels of the target.
    pub viewport: Viewport,
    /// Shift of the picture, pixels, x to the right, y down: of temporal anti-aliasing, in [-0.5, 0.5]. Motion does not
    /// count it.
    pub jitter_px: Vec2,
    /// Clip space points down, as Vulkan's own does; by default it points up.
    pub is_y_down: bool,
    /// `view_from_world` and `clip_from_view` of the previous frame, for motion vectors; `None`: the same as now.
    pub previous: Option<[Mat4; 2]>,
    /// Factor on all radiance that is written, > 0.
    pub pre_exposure: f32,
}

/// A part of a target, pixels from its top left corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Viewport {
    /// Top left corner.
    pub origin: [u32; 2],
    /// Width and height, each at least 1.
    pub size: [u32; 2],
}

impl View {
    /// A view of a whole target of `size` pixels, without jitter, with clip space up and radiance as it is.
    pub fn new(view_from_world: Mat4, clip_from_view: Mat4, size: [u32; 2]) -> Self {
        Self {
            view_from_world,
            clip_from_view,
            viewport: Viewport { origin: [0; 2], size },
            jitter_px: Vec2::ZERO,
            is_y_down: false,
            previous: None,
            pre_exposure: 1.0,
        }
    }

    /// What a scene's own camera sees.
    pub fn of(camera: &Camera, previous: Option<&Camera>, size: [u32; 2]) -> Self {
        let previous = previous.map(|camera| [camera.camera_from_world, camera.clip_from_camera]);
        Self { previous, ..Self::new(camera.camera_from_world, camera.clip_from_camera, size) }
    }

    /// The same as a camera, which shadow maps and sorting ask.
    pub fn camera(&self) -> Camera {
        Camera {
            world_from_camera: self.view_from_world.inverse(),
            camera_from_world: self.view_from_world,
            clip_from_camera: self.clip_from_view,
            is_orthographic: self.is_orthographic(),
        }
    }

    /// Rays are parallel: w does not depend on the place.
    pub fn is_orthographic(&self) -> bool {
        self.clip_from_view.row(3) == Vec4::W
    }

    /// Both steps at once, and the jitter.
    pub fn clip_from_world(&self) -> Mat4 {
        let clip_from_world = self.clip_from_view * self.view_from_world;
        if self.jitter_px == Vec2::ZERO {
            return clip_from_world;
        }
        let [width, height] = self.viewport.size.map(|side| side as f32);
        let down = if self.is_y_down { 2.0 } else { -2.0 };
        let shift = Vec3::new(2.0 * self.jitter_px.x / width, down * self.jitter_px.y / height, 0.0);
        Mat4::from_translation(shift) * clip_from_world
    }

    /// Says what is wrong with it.
    pub(super) fn check(&self) -> Result<(), RenderError> {
        let wrong = |option, problem: &str| Err(RenderError::Option { option, problem: problem.to_owned() });
        let usable = |matrix: &Mat4| matrix.is_finite() && matrix.determinant() != 0.0;
        let matrices = [&self.view_from_world, &self.clip_from_view];
        for (option, matrix) in ["view.view_from_world", "view.clip_from_view"].into_iter().zip(matrices) {
            if !usable(matrix) {
                return wrong(option, "is not finite or has no inverse; give a camera's matrix");
            }
        }
        if self.previous.is_some_and(|previous| !previous.iter().all(usable)) {
            return wrong("view.previous", "is not finite or has no inverse; give the last frame's matrices, or None");
        }
        if self.viewport.size.contains(&0) {
            return wrong("view.viewport", "has no pixels; both sides must be at least 1");
        }
        let ends = [0, 1].map(|axis| self.viewport.origin[axis].checked_add(self.viewport.size[axis]));
        if ends.iter().any(|end| end.is_none_or(|end| end > 1 << 15)) {
            return wrong("view.viewport", "ends beyond 32768 pixels; no target is as large");
        }
        if !self.jitter_px.is_finite() {
            return wrong("view.jitter_px", "must be finite; 0 is none");
        }
        if !(self.pre_exposure > 0.0 && self.pre_exposure.is_finite()) {
            return wrong("view.pre_exposure", "must be a finite number greater than 0; 1 leaves radiance as it is");
        }
        Ok(())
    }
}

/// The sides of what a view shows. Near and far do not count: they depend on the sense of depth.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frustum([Vec4; 4]);

impl Frustum {
    /// Of a projection (Gribb & Hartmann 2001, "Fast Extraction of Viewing Frustum Planes").
    pub(super) fn of(clip_from_world: Mat4) -> Self {
        let [x, y, w] = [0, 1, 3].map(|row| clip_from_world.row(row));
        Self([w + x, w - x, w + y, w - y].map(|plane| plane / plane.truncate().length()))
    }

    /// Whether any of a sphere may be seen. Never says no where some is.
    pub(super) fn sees(&self, sphere: crate::math::Sphere) -> bool {
        let slack = 1.0 + 1e-3;
        // Written so that what is no number is seen.
        !self.0.iter().any(|plane| plane.dot(sphere.center.extend(1.0)) < -sphere.radius * slack)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Sphere, orthographic, perspective, perspective_infinite};
    use crate::scene::{self, CameraChoice};
    use glam::{EulerRot, Quat};
    use proptest::prelude::*;

    fn view() -> View {
        View::new(Mat4::from_translation(Vec3::NEG_Z), perspective_infinite(1.0, 1.5, 0.1), [96, 64])
    }

    #[test]
    fn a_bad_view_is_named_with_what_to_do() {
        let nan = Mat4::from_cols_array(&[f32::NAN; 16]);
        let part = |origin, size| Viewport { origin, size };
        let cases = [
            ("view.view_from_world", View { view_from_world: nan, ..view() }),
            ("view.view_from_world", View { view_from_world: Mat4::ZERO, ..view() }),
            ("view.clip_from_view", View { clip_from_view: nan, ..view() }),
            ("view.clip_from_view", View { clip_from_view: Mat4::from_scale(Vec3::new(1.0, 1.0, 0.0)), ..view() }),
            ("view.previous", View { previous: Some([Mat4::IDENTITY, nan]), ..view() }),
            ("view.previous", View { previous: Some([Mat4::ZERO, Mat4::IDENTITY]), ..view() }),
            ("view.viewport", View { viewport: part([0, 0], [0, 64]), ..view() }),
            ("view.viewport", View { viewport: part([0, 0], [96, 0]), ..view() }),
            ("view.viewport", View { viewport: part([u32::MAX, 0], [1, 1]), ..view() }),
            ("view.viewport", View { viewport: part([0, 1 << 15], [1, 1]), ..view() }),
            ("view.jitter_px", View { jitter_px: Vec2::new(0.0, f32::NAN), ..view() }),
            ("view.jitter_px", View { jitter_px: Vec2::new(f32::INFINITY, 0.0), ..view() }),
            ("view.pre_exposure", View { pre_exposure: 0.0, ..view() }),
            ("view.pre_exposure", View { pre_exposure: -1.0, ..view() }),
            ("view.pre_exposure", View { pre_exposure: f32::NAN, ..view() }),
            ("view.pre_exposure", View { pre_exposure: f32::INFINITY, ..view() }),
        ];
        for (index, (expected, view)) in cases.into_iter().enumerate() {
            match view.check() {
                Err(RenderError::Option { option, problem }) => {
                    assert_eq!(option, expected, "{index}: {problem}");
                    assert!(!problem.is_empty());
                }
                other => panic!("{index}, {expected}: {other:?}"),
            }
        }
    }

    #[test]
    fn what_a_host_may_ask_for_is_no_error() {
        let viewport = Viewport { origin: [(1 << 15) - 1, 0], size: [1, 1 << 15] };
        let mirrored = Mat4::from_scale(Vec3::new(-1.0, 1.0, 1.0));
        for view in [
            view(),
            View { viewport, ..view() },
            View { view_from_world: mirrored, previous: Some([mirrored, view().clip_from_view]), ..view() },
            View { jitter_px: Vec2::new(-0.5, 0.5), is_y_down: true, pre_exposure: 1e-6, ..view() },
        ] {
            view.check().unwrap_or_else(|error| panic!("{error}"));
        }
    }

    #[test]
    fn a_view_of_a_camera_is_that_camera() {
        let gallery = crate::asset::procedural::gallery();
        let pose = scene::pose(&gallery, None, 0.0);
        let shown = scene::world_hull(&gallery, 0, &pose);
        let orbit = CameraChoice::Orbit { theta_deg: 20.0, phi_deg: 70.0, radius_m: None, target: None, fov_deg: 40.0 };
        for choice in [CameraChoice::Auto, CameraChoice::Index(0), orbit] {
            let camera = scene::camera(&gallery, 0, &pose, &choice, 1.5, &shown).unwrap();
            for camera in
                [camera, Camera { clip_from_camera: orthographic(2.0, 1.0, 0.1, 9.0), is_orthographic: true, ..camera }]
            {
                let view = View::of(&camera, Some(&camera), [96, 64]);
                view.check().unwrap_or_else(|error| panic!("{error}"));
                assert_eq!(view.previous, Some([camera.camera_from_world, camera.clip_from_camera]));
                assert_eq!(view.clip_from_world(), camera.clip_from_world());
                let same = view.camera();
                assert_eq!(same.camera_from_world, camera.camera_from_world);
                assert_eq!(same.clip_from_camera, camera.clip_from_camera);
                assert_eq!(same.is_orthographic, camera.is_orthographic);
                assert!(same.world_from_camera.abs_diff_eq(camera.world_from_camera, 1e-5), "inverted once more");
            }
        }
    }

    #[test]
    fn jitter_shifts_the_picture_by_pixels_to_the_right_and_down() {
        let place = Vec3::new(0.2, -0.1, -3.0);
        for (is_y_down, rows) in [(false, -1.0), (true, 1.0)] {
            let pixel = |jitter_px| {
                let clip = View { jitter_px, is_y_down, ..view() }.clip_from_world().project_point3(place);
                Vec2::new(0.5 * clip.x * 96.0, rows * 0.5 * clip.y * 64.0)
            };
            let jitter_px = Vec2::new(0.25, -0.5);
            assert!((pixel(jitter_px) - pixel(Vec2::ZERO)).distance(jitter_px) < 1e-4);
        }
    }

    fn projections() -> impl Strategy<Value = Mat4> {
        (0..4, 0.2f32..2.5, 0.3f32..3.0).prop_map(|(kind, fov, aspect)| match kind {
            0 => perspective_infinite(fov, aspect, 0.05),
            1 => perspective(fov, aspect, 0.05, 200.0),
            2 => orthographic(aspect * fov, fov, 0.05, 200.0),
            // The other sense of depth.
            _ => {
                Mat4::from_cols(Vec4::X, Vec4::Y, Vec4::NEG_Z, Vec4::Z + Vec4::W)
                    * perspective(fov, aspect, 0.05, 200.0)
            }
        })
    }

    proptest! {
        #[test]
        fn a_sphere_with_a_visible_point_is_never_beside_the_view(
            clip_from_view in projections(),
            angles in prop::array::uniform3(-3.1f32..3.1),
            eye in prop::array::uniform3(-50f32..50.0),
            [x, y] in prop::array::uniform2(-1f32..1.0),
            depth_m in 0.1f32..150.0,
            towards in prop::array::uniform3(-1f32..1.0),
            radius in 0f32..40.0,
            jitter_px in prop::array::uniform2(-0.5f32..0.5),
        ) {
            let rotation = Quat::from_euler(EulerRot::XYZ, angles[0], angles[1], angles[2]);
            let view_from_world = Mat4::from_rotation_translation(rotation, Vec3::from(eye));
            let jitter_px = Vec2::from(jitter_px);
            let view = View { jitter_px, ..View::new(view_from_world, clip_from_view, [64, 48]) };
            // A point that is seen, in the picture's own coordinates and at a depth, and a sphere that it lies on.
            let clip_from_world = view.clip_from_world();
            let w = if view.is_orthographic() { 1.0 } else { depth_m };
            let depth = (clip_from_view * Vec4::new(0.0, 0.0, -depth_m, 1.0)).z;
            let seen = clip_from_world.as_dmat4().inverse() * Vec4::new(x * w, y * w, depth, w).as_dvec4();
            let seen = (seen.truncate() / seen.w).as_vec3();
            let center = seen + Vec3::from(towards).normalize_or(Vec3::X) * radius;
            prop_assume!(seen.is_finite());
            // What floats of this size are off by.
            let rounding = 1e-5 * (1.0 + seen.length() + depth_m);
            let sphere = Sphere { center, radius: radius + rounding };
            prop_assert!(Frustum::of(clip_from_world).sees(sphere), "{sphere:?} with {seen}");
        }

        #[test]
        fn what_is_wholly_beside_the_view_is_not_seen(side in 0..4, depth_m in 1f32..50.0, along in -1f32..1.0) {
            let frustum = Frustum::of(view().clip_from_world());
            // A frustum of vertical angle 1 and aspect 1.5, seen from 1 m in front of the origin.
            let half = Vec2::new(1.5, 1.0) * 0.5f32.tan() * depth_m;
            let (radius, beyond) = (0.2, 2.0);
            let place = match side {
                0 => Vec2::new(half.x + beyond, along * half.y),
                1 => Vec2::new(-half.x - beyond, along * half.y),
                2 => Vec2::new(along * half.x, half.y + beyond),
                _ => Vec2::new(along * half.x, -half.y - beyond),
            };
            let center = place.extend(1.0 - depth_m);
            let sphere = Sphere { center, radius };
            prop_assert!(!frustum.sees(sphere), "{sphere:?}");
        }
    }

    #[test]
    fn what_is_no_number_is_seen() {
        let frustum = Frustum::of(view().clip_from_world());
        assert!(frustum.sees(Sphere { center: Vec3::splat(f32::NAN), radius: 1.0 }));
        assert!(frustum.sees(Sphere { center: Vec3::X * 1e3, radius: f32::NAN }));
        assert!(frustum.sees(Sphere { center: Vec3::X * 1e3, radius: f32::INFINITY }));
    }
}
