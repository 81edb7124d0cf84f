//! Surfaces by formula, with normals, tangents and uv.
//!
//! Sizes are metres. uv (0, 0) is the top left of a texture, so v falls where the surface's second parameter grows;
//! normal, tangent and bitangent follow from that (w = +1). Seams have split uv but bit-equal positions.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3, Vec4};

use crate::asset::{Primitive, Vertices};

/// A point of a parametric surface.
pub(super) struct SurfacePoint {
    pub(super) position: Vec3,
    /// Any length.
    pub(super) normal: Vec3,
    /// Along the first parameter; any length.
    pub(super) along_u: Vec3,
}

/// A rectangle in the XZ plane that faces +Y, centred at the origin.
pub fn plane(half_width_m: f32, half_depth_m: f32, segments: u32) -> Primitive {
    grid([segments, segments], Vec2::ONE, |u, v| SurfacePoint {
        position: Vec3::new((2.0 * u - 1.0) * half_width_m, 0.0, (1.0 - 2.0 * v) * half_depth_m),
        normal: Vec3::Y,
        along_u: Vec3::X,
    })
}

/// A cube with hard edges: 24 vertices, each face one unit square of uv.
pub fn cube(half_size_m: f32) -> Primitive {
    rounded_cube(half_size_m, 0.0, 1)
}

/// A cube with rounded edges and corners; six faces, each one unit square of uv. `radius_m` is held inside
/// [0, half_size_m]; at 0 the edges are hard, at `half_size_m` the cube is a ball.
pub fn rounded_cube(half_size_m: f32, radius_m: f32, segments: u32) -> Primitive {
    let radius_m = radius_m.clamp(0.0, half_size_m);
    let inner_m = half_size_m - radius_m;
    let mut cube = Primitive::default();
    // (right, up) of each face; right x up points outwards.
    let faces = [
        (Vec3::NEG_Z, Vec3::Y),
        (Vec3::Z, Vec3::Y),
        (Vec3::X, Vec3::NEG_Z),
        (Vec3::X, Vec3::Z),
        (Vec3::X, Vec3::Y),
        (Vec3::NEG_X, Vec3::Y),
    ];
    for (right, up) in faces {
        let outward = right.cross(up);
        let segments = segments.max(1) as f32;
        // From whole numbers, so that both faces at an edge compute the same bits; the tangent spreads a ball's cells
        // evenly over its angles.
        let coordinate = |t: f32| {
            let even = (2.0 * (t * segments).round() - segments) / segments;
            let by_angle = if even.abs() == 1.0 { even } else { (even * PI / 4.0).tan() };
            (even + (by_angle - even) * radius_m / half_size_m.max(f32::MIN_POSITIVE)) * half_size_m
        };
        append(
            &mut cube,
            grid([segments as u32; 2], Vec2::ONE, |u, v| {
                let on_cube = right * coordinate(u) + up * coordinate(v) + outward * half_size_m;
                let core = on_cube.clamp(Vec3::splat(-inner_m), Vec3::splat(inner_m));
                let normal = if radius_m > 0.0 { (on_cube - core).normalize_or(outward) } else { outward };
                SurfacePoint {
                    position: if radius_m > 0.0 { core + normal * radius_m } else { on_cube },
                    normal,
                    along_u: right - normal * normal.dot(right),
                }
            }),
        );
    }
    cube
}

/// A ball made from a cube: even cells, no poles, six unit squares of uv. What fur is best grown on.
pub fn sphere(radius_m: f32, segments: u32) -> Primitive {
    rounded_cube(radius_m, radius_m, segments)
}

/// A ball with poles on Y: u once around, v from the north pole down.
pub fn uv_sphere(radius_m: f32, columns: u32, rows: u32) -> Primitive {
    revolved([columns, rows], Vec2::ONE, |v| {
        let (sin, cos) = (PI * (v - 0.5)).sin_cos();
        let (r, y) = if v == 0.0 || v == 1.0 { (0.0, sin) } else { (cos, sin) };
        (Vec2::new(r, y) * radius_m, Vec2::new(r, y))
    })
}

/// A cylinder along Y with half balls at its ends; `half_length_m` from the origin to the middle of each ball.
pub fn capsule(radius_m: f32, half_length_m: f32, columns: u32, rows: u32) -> Primitive {
    let profile_m = PI * radius_m + 2.0 * half_length_m;
    let repeat = Vec2::new((TAU * radius_m / profile_m).max(1.0).round(), 1.0);
    revolved([columns, rows], repeat, |v| {
        // Arc length from the south pole.
        let along_m = v * profile_m;
        let quarter_m = 0.5 * PI * radius_m;
        let above_m = (along_m - quarter_m).clamp(0.0, 2.0 * half_length_m);
        let angle = (along_m - above_m - quarter_m) / radius_m;
        let normal = if v == 0.0 || v == 1.0 { Vec2::new(0.0, angle.signum()) } else { Vec2::from_angle(angle) };
        (normal * radius_m + Vec2::new(0.0, above_m - half_length_m), normal)
    })
}

/// A ring around Y. uv repeats whole times around so that its cells stay nearly square; v once around the tube.
pub fn torus(ring_radius_m: f32, tube_radius_m: f32, columns: u32, rows: u32) -> Primitive {
    let repeat = Vec2::new((ring_radius_m / tube_radius_m).round().max(1.0), 1.0);
    revolved([columns, rows], repeat, |v| {
        let normal = Vec2::from_angle(TAU * v.fract());
        (normal * tube_radius_m + Vec2::new(ring_radius_m, 0.0), normal)
    })
}

/// A closed tube along a trefoil that winds twice around Z and three times through its hole. Its reach from the origin
/// is `ring_radius_m + swing_m + tube_radius_m`. uv as for [`torus`].
pub fn torus_knot(ring_radius_m: f32, swing_m: f32, tube_radius_m: f32, columns: u32, rows: u32) -> Primitive {
    let center = |t: f32| {
        let ((sin2, cos2), (sin3, cos3)) = ((2.0 * t).sin_cos(), (3.0 * t).sin_cos());
        let ring = ring_radius_m + swing_m * cos3;
        Vec3::new(ring * cos2, ring * sin2, swing_m * sin3)
    };
    // The torus that the knot lies on gives a frame that closes after one turn, unlike one carried along the curve.
    let frame = |t: f32| {
        let ((sin2, cos2), (sin3, cos3)) = ((2.0 * t).sin_cos(), (3.0 * t).sin_cos());
        let ring = ring_radius_m + swing_m * cos3;
        let outward = Vec3::new(cos2, sin2, 0.0);
        let along = Vec3::new(-sin2, cos2, 0.0) * (2.0 * ring) - outward * (3.0 * swing_m * sin3)
            + Vec3::Z * (3.0 * swing_m * cos3);
        let off_torus = outward * cos3 + Vec3::Z * sin3;
        let along = along.normalize_or(Vec3::X);
        let first = (off_torus - along * along.dot(off_torus)).normalize_or(Vec3::Z);
        (along, first, first.cross(along))
    };
    let length_m: f32 = (0..columns.max(3))
        .map(|i| {
            let step = TAU / columns.max(3) as f32;
            center(i as f32 * step).distance(center((i + 1) as f32 * step))
        })
        .sum();
    let repeat = Vec2::new((length_m / (TAU * tube_radius_m)).round().max(1.0), 1.0);
    grid([columns.max(3), rows.max(3)], repeat, |u, v| {
        let (along, first, second) = frame(TAU * u.fract());
        let around = Vec2::from_angle(TAU * v.fract());
        // second = first x along, so that u x v points outwards.
        let normal = first * around.x + second * around.y;
        SurfacePoint { position: center(TAU * u.fract()) + normal * tube_radius_m, normal, along_u: along }
    })
}

/// A photographer's backdrop: floor at y = 0 that bends up into a wall. The floor reaches from z = `front_m` back to
/// the bend of `bend_radius_m`, whose wall stands at z = `-back_m` and rises to `height_m`.
pub fn backdrop(half_width_m: f32, front_m: f32, back_m: f32, height_m: f32, bend_radius_m: f32) -> Primitive {
    let floor_m = front_m + back_m - bend_radius_m;
    let bend_m = 0.5 * PI * bend_radius_m;
    let profile_m = floor_m + bend_m + (height_m - bend_radius_m);
    grid([16, 96], Vec2::new(2.0 * half_width_m, profile_m), |u, v| {
        let along_m = v * profile_m;
        let angle = ((along_m - floor_m) / bend_radius_m).clamp(0.0, 0.5 * PI);
        let (sin, cos) = angle.sin_cos();
        let wall_m = (along_m - floor_m - bend_m).max(0.0);
        let z = front_m - along_m.min(floor_m) - bend_radius_m * sin;
        let position = Vec3::new((2.0 * u - 1.0) * half_width_m, bend_radius_m * (1.0 - cos) + wall_m, z);
        SurfacePoint { position, normal: Vec3::new(0.0, cos, sin), along_u: Vec3::X }
    })
}

/// Turns a profile (radius, y) with its outward normal, given from bottom to top, around Y.
fn revolved(cells: [u32; 2], repeat: Vec2, profile: impl Fn(f32) -> (Vec2, Vec2)) -> Primitive {
    grid([cells[0].max(3), cells[1].max(2)], repeat, |u, v| {
        let (sin, cos) = (TAU * u.fract()).sin_cos();
        let turn = |p: Vec2| Vec3::new(p.x * sin, p.y, p.x * cos);
        let (point, normal) = profile(v);
        SurfacePoint { position: turn(point), normal: turn(normal), along_u: Vec3::new(cos, 0.0, -sin) }
    })
}

/// Vertices on a regular grid of parameters in [0, 1]; front faces are on the side of du x dv.
pub(super) fn grid(
    [columns, rows]: [u32; 2],
    uv_repeat: Vec2,
    surface: impl Fn(f32, f32) -> SurfacePoint,
) -> Primitive {
    let (columns, rows) = (columns.max(1), rows.max(1));
    let mut vertices = Vertices { uv_sets: vec![Vec::new()], ..Vertices::default() };
    let mut indices = Vec::new();
    for row in 0..=rows {
        for column in 0..=columns {
            let (u, v) = (column as f32 / columns as f32, row as f32 / rows as f32);
            let SurfacePoint { position, normal, along_u } = surface(u, v);
            let normal = normal.normalize_or(Vec3::Y);
            let tangent = (along_u - normal * normal.dot(along_u)).normalize_or(normal.any_orthonormal_vector());
            vertices.positions.push(position);
            vertices.normals.push(normal);
            vertices.tangents.push(Vec4::from((tangent, 1.0)));
            vertices.uv_sets[0].push(Vec2::new(u, 1.0 - v) * uv_repeat);
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let corner = row * (columns + 1) + column;
            let above = corner + columns + 1;
            let halves = [[corner, corner + 1, above + 1], [corner, above + 1, above]];
            // The cells at a pole are triangles.
            let has_area = |triangle: &[u32; 3]| {
                let [a, b, c] = triangle.map(|index| vertices.positions[index as usize]);
                a != b && b != c && c != a
            };
            indices.extend(halves.into_iter().filter(has_area).flatten());
        }
    }
    Primitive { indices, vertices, ..Primitive::default() }
}

fn append(whole: &mut Primitive, part: Primitive) {
    let first = whole.vertices.positions.len() as u32;
    whole.indices.extend(part.indices.iter().map(|index| first + index));
    whole.vertices.positions.extend(part.vertices.positions);
    whole.vertices.normals.extend(part.vertices.normals);
    whole.vertices.tangents.extend(part.vertices.tangents);
    let uv = part.vertices.uv_sets.into_iter().flatten();
    match whole.vertices.uv_sets.first_mut() {
        Some(set) => set.extend(uv),
        None => whole.vertices.uv_sets.push(uv.collect()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;

    fn solids() -> Vec<(&'static str, Primitive)> {
        vec![
            ("cube", cube(0.5)),
            ("rounded cube", rounded_cube(0.5, 0.2, 7)),
            ("sphere", sphere(0.5, 6)),
            ("uv sphere", uv_sphere(0.5, 16, 9)),
            ("capsule", capsule(0.2, 0.3, 12, 16)),
            ("torus", torus(0.4, 0.1, 24, 12)),
            ("torus knot", torus_knot(0.4, 0.15, 0.1, 96, 12)),
        ]
    }

    /// Six times the enclosed volume, positive when front faces are outside.
    fn volume(primitive: &Primitive) -> f64 {
        let at = |index: u32| primitive.vertices.positions[index as usize].as_dvec3();
        primitive.indices.chunks_exact(3).map(|t| at(t[0]).dot(at(t[1]).cross(at(t[2])))).sum::<f64>() / 6.0
    }

    #[test]
    fn every_solid_is_closed_and_faces_outwards() {
        for (name, solid) in solids() {
            let mut edges: HashMap<[[u32; 3]; 2], i32> = HashMap::new();
            let bits =
                |index: u32| (solid.vertices.positions[index as usize] + Vec3::ZERO).to_array().map(f32::to_bits);
            for triangle in solid.indices.chunks_exact(3) {
                for i in 0..3 {
                    let (a, b) = (bits(triangle[i]), bits(triangle[(i + 1) % 3]));
                    if a < b { *edges.entry([a, b]).or_default() += 1 } else { *edges.entry([b, a]).or_default() -= 1 }
                }
            }
            assert!(edges.values().all(|&balance| balance == 0), "{name} is open");
            assert!(volume(&solid) > 0.0, "{name} is inside out");
        }
    }

    #[test]
    fn volumes_are_those_of_the_formulas() {
        assert!((volume(&cube(0.5)) - 1.0).abs() < 1e-6);
        let ball = 4.0 / 3.0 * std::f64::consts::PI * 0.125;
        assert!((volume(&sphere(0.5, 32)) / ball - 1.0).abs() < 3e-3);
        assert!((volume(&uv_sphere(0.5, 128, 64)) / ball - 1.0).abs() < 3e-3);
        let ring = 2.0 * std::f64::consts::PI.powi(2) * 0.4 * 0.01;
        assert!((volume(&torus(0.4, 0.1, 128, 64)) / ring - 1.0).abs() < 3e-3);
        let pill = std::f64::consts::PI * 0.04 * (0.6 + 4.0 / 3.0 * 0.2);
        assert!((volume(&capsule(0.2, 0.3, 128, 128)) / pill - 1.0).abs() < 3e-3);
    }

    #[test]
    fn frames_are_unit_and_normals_agree_with_the_faces() {
        for (name, solid) in
            solids().into_iter().chain([("plane", plane(1.0, 2.0, 3)), ("backdrop", backdrop(2.0, 2.0, 1.0, 2.0, 0.5))])
        {
            let vertices = &solid.vertices;
            assert_eq!(vertices.positions.len(), vertices.uv_sets[0].len());
            for (normal, tangent) in vertices.normals.iter().zip(&vertices.tangents) {
                assert!((normal.length() - 1.0).abs() < 1e-5 && (tangent.truncate().length() - 1.0).abs() < 1e-5);
                assert!(normal.dot(tangent.truncate()).abs() < 1e-5, "{name}");
            }
            for triangle in solid.indices.chunks_exact(3) {
                let [a, b, c] = [0, 1, 2].map(|i| vertices.positions[triangle[i] as usize]);
                let face = (b - a).cross(c - a).normalize();
                let shading: Vec3 = triangle.iter().map(|&i| vertices.normals[i as usize]).sum();
                assert!(face.dot(shading.normalize()) > 0.8, "{name}: {face} {shading}");
            }
        }
    }

    #[test]
    fn tangents_run_along_u_and_bitangents_up_the_texture() {
        for (name, solid) in solids() {
            let vertices = &solid.vertices;
            for triangle in solid.indices.chunks_exact(3) {
                let [a, b, c] = [0, 1, 2].map(|i| triangle[i] as usize);
                let (e1, e2) =
                    (vertices.positions[b] - vertices.positions[a], vertices.positions[c] - vertices.positions[a]);
                let (d1, d2) =
                    (vertices.uv_sets[0][b] - vertices.uv_sets[0][a], vertices.uv_sets[0][c] - vertices.uv_sets[0][a]);
                let area = d1.perp_dot(d2);
                let (du, dv) = ((e1 * d2.y - e2 * d1.y) / area, (e2 * d1.x - e1 * d2.x) / area);
                // Pole fans aside, one of three tangents stands for the face.
                let tangent: Vec3 = [a, b, c].iter().map(|&i| vertices.tangents[i].truncate()).sum();
                let bitangent: Vec3 =
                    [a, b, c].iter().map(|&i| vertices.normals[i].cross(vertices.tangents[i].truncate())).sum();
                assert!(du.dot(tangent) > 0.0 && dv.dot(bitangent) < 0.0, "{name}");
            }
        }
    }

    #[test]
    fn a_cube_has_24_vertices_and_a_knot_stays_within_its_reach() {
        assert_eq!((cube(1.0).vertices.positions.len(), cube(1.0).indices.len()), (24, 36));
        let knot = torus_knot(0.4, 0.15, 0.1, 96, 12);
        assert!(knot.vertices.positions.iter().all(|position| position.length() < 0.651));
    }

    #[test]
    fn backdrops_stand_on_the_floor_and_reach_the_top() {
        let backdrop = backdrop(2.0, 1.5, 1.0, 2.5, 0.5);
        let positions = &backdrop.vertices.positions;
        let top = positions.iter().map(|p| p.y).fold(0.0, f32::max);
        let back = positions.iter().map(|p| p.z).fold(0.0, f32::min);
        let front = positions.iter().map(|p| p.z).fold(0.0, f32::max);
        assert!((top - 2.5).abs() < 1e-5 && (back + 1.0).abs() < 1e-5 && (front - 1.5).abs() < 1e-5);
        assert!(positions.iter().all(|p| p.y >= 0.0));
    }
}
