//! Frames and projections.
//!
//! Space is right-handed with Y up; a camera looks along its -Z. Projections give Vulkan clip space
//! with **Y up** (the viewport has a negative height, core since Vulkan 1.1) and **reversed depth**:
//! 1 at the near plane, 0 at the far one, which spreads the precision of a float depth buffer evenly
//! (Reed 2015, "Depth Precision Visualized").

use glam::{Mat3, Mat4, Vec3, Vec4};

/// A right-handed orthonormal frame whose third column is the unit `normal`; columns are tangent,
/// bitangent, normal.
///
/// Duff et al. 2017, "Building an Orthonormal Basis, Revisited": no branch, no singular direction.
pub fn orthonormal_frame(normal: Vec3) -> Mat3 {
    let sign = 1f32.copysign(normal.z);
    let a = -1.0 / (sign + normal.z);
    let b = normal.x * normal.y * a;
    Mat3::from_cols(
        Vec3::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x),
        Vec3::new(b, sign + normal.y * normal.y * a, -normal.y),
        normal,
    )
}

/// What carries normals when `matrix` carries positions: a positive multiple of the inverse transpose
/// of its 3x3 part. Results need normalising.
///
/// The cofactor matrix is det * inverse transpose, so it also exists for singular matrices; its sign is
/// restored for mirrored ones, where normals must keep pointing outwards.
pub fn normal_matrix(matrix: Mat4) -> Mat3 {
    let (x, y, z) = (matrix.x_axis.truncate(), matrix.y_axis.truncate(), matrix.z_axis.truncate());
    let yz = y.cross(z);
    let sign = if x.dot(yz) < 0.0 { -1.0 } else { 1.0 };
    Mat3::from_cols(yz * sign, z.cross(x) * sign, x.cross(y) * sign)
}

/// `clip_from_camera` of a perspective camera without a far plane: depth = near / distance.
///
/// `vertical_fov` in radians, in (0, pi); `aspect` = width / height; `near_m` > 0.
pub fn perspective_infinite(vertical_fov: f32, aspect: f32, near_m: f32) -> Mat4 {
    let focal = 1.0 / (0.5 * vertical_fov).tan();
    Mat4::from_cols(
        Vec4::new(focal / aspect, 0.0, 0.0, 0.0),
        Vec4::new(0.0, focal, 0.0, 0.0),
        Vec4::new(0.0, 0.0, 0.0, -1.0),
        Vec4::new(0.0, 0.0, near_m, 0.0),
    )
}

/// `clip_from_camera` of a perspective camera: depth 1 at `near_m`, 0 at `far_m` > `near_m`.
///
/// `vertical_fov` in radians, in (0, pi); `aspect` = width / height; `near_m` > 0.
pub fn perspective(vertical_fov: f32, aspect: f32, near_m: f32, far_m: f32) -> Mat4 {
    let focal = 1.0 / (0.5 * vertical_fov).tan();
    let slope = near_m / (far_m - near_m);
    Mat4::from_cols(
        Vec4::new(focal / aspect, 0.0, 0.0, 0.0),
        Vec4::new(0.0, focal, 0.0, 0.0),
        Vec4::new(0.0, 0.0, slope, -1.0),
        Vec4::new(0.0, 0.0, slope * far_m, 0.0),
    )
}

/// `clip_from_camera` of a parallel camera: depth 1 at `near_m`, 0 at `far_m` > `near_m`.
///
/// Half extents in metres, > 0.
pub fn orthographic(half_width_m: f32, half_height_m: f32, near_m: f32, far_m: f32) -> Mat4 {
    let inverse_depth = 1.0 / (far_m - near_m);
    Mat4::from_cols(
        Vec4::new(1.0 / half_width_m, 0.0, 0.0, 0.0),
        Vec4::new(0.0, 1.0 / half_height_m, 0.0, 0.0),
        Vec4::new(0.0, 0.0, inverse_depth, 0.0),
        Vec4::new(0.0, 0.0, far_m * inverse_depth, 1.0),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn direction() -> impl Strategy<Value = Vec3> {
        (-1f32..1.0, -1f32..1.0, -1f32..1.0)
            .prop_map(|(x, y, z)| Vec3::new(x, y, z))
            .prop_filter("a direction", |v| v.length() > 0.1)
            .prop_map(Vec3::normalize)
    }

    proptest! {
        #[test]
        fn frames_are_orthonormal_and_right_handed(normal in direction()) {
            let frame = orthonormal_frame(normal);
            prop_assert!((frame.determinant() - 1.0).abs() < 1e-5);
            prop_assert!((frame * frame.transpose()).abs_diff_eq(Mat3::IDENTITY, 1e-5));
            prop_assert_eq!(frame.z_axis, normal);
        }

        #[test]
        fn normals_stay_perpendicular_and_outward(
            x in direction(), y in direction(), z in direction(), normal in direction(),
        ) {
            let matrix = Mat4::from_mat3(Mat3::from_cols(x, y, z));
            let frame = orthonormal_frame(normal);
            let carried = normal_matrix(matrix) * normal;
            for tangent in [frame.x_axis, frame.y_axis] {
                prop_assert!(carried.dot(matrix.transform_vector3(tangent)).abs() < 1e-4);
            }
            // A point on the outer side stays on the outer side, mirrored or not.
            prop_assert!(carried.dot(matrix.transform_vector3(normal)) >= -1e-4);
        }
    }

    #[test]
    fn frames_exist_at_both_poles() {
        for normal in [Vec3::Z, Vec3::NEG_Z, Vec3::new(0.0, 0.0, -1.0)] {
            assert!((orthonormal_frame(normal).determinant() - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn depth_is_one_at_near_and_zero_at_far() {
        let at = |projection: Mat4, distance_m: f32| projection.project_point3(Vec3::new(0.0, 0.0, -distance_m)).z;
        let finite = perspective(1.0, 1.5, 0.25, 64.0);
        assert!((at(finite, 0.25) - 1.0).abs() < 1e-6);
        assert!(at(finite, 64.0).abs() < 1e-6);
        let infinite = perspective_infinite(1.0, 1.5, 0.25);
        assert_eq!(at(infinite, 0.25), 1.0);
        assert_eq!(at(infinite, 0.5), 0.5);
        assert!(at(infinite, 1e9) < 1e-9);
        let parallel = orthographic(2.0, 1.0, 0.5, 8.5);
        assert_eq!(at(parallel, 0.5), 1.0);
        assert_eq!(at(parallel, 4.5), 0.5);
        assert_eq!(at(parallel, 8.5), 0.0);
    }

    #[test]
    fn clip_space_has_y_up_and_the_fov_is_vertical() {
        let half = 0.5f32;
        let top = Vec3::new(0.0, half.tan(), -1.0) * 3.0;
        let right = Vec3::new(2.0 * half.tan(), 0.0, -1.0) * 3.0;
        for projection in [perspective(1.0, 2.0, 0.1, 10.0), perspective_infinite(1.0, 2.0, 0.1)] {
            assert!((projection.project_point3(top).y - 1.0).abs() < 1e-6);
            assert!((projection.project_point3(right).x - 1.0).abs() < 1e-6);
        }
        assert_eq!(
            orthographic(2.0, 1.0, 0.0, 1.0).project_point3(Vec3::new(2.0, 1.0, 0.0)).truncate(),
            glam::Vec2::ONE
        );
    }
}
