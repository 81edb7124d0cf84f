//! Promise: from a file's plain data to what a frame shows, with the right thing at the right place.

use glam::{Mat4, Quat, Vec3};
use vair::asset::procedural::{self, GALLERY_CAMERA};
use vair::asset::{
    self, Animation, Asset, AssetScene, Channel, Interpolation, Keys, Material, Mesh, Node, Skin, Transform,
};
use vair::scene::{self, Camera, CameraChoice};

fn hero(asset: &Asset, aspect: f32) -> Camera {
    let pose = scene::pose(asset, None, 0.0);
    let shown = scene::world_hull(asset, 0, &pose);
    scene::camera(asset, 0, &pose, &CameraChoice::Named(GALLERY_CAMERA.into()), aspect, &shown)
        .expect("the gallery's camera")
}

/// (name, box in clip coordinates, lowest point in the world) of every object except the backdrop.
fn gallery_objects() -> Vec<(String, [Vec3; 2], f32)> {
    let gallery = procedural::gallery();
    let pose = scene::pose(&gallery, None, 0.0);
    let clip_from_world = hero(&gallery, 16.0 / 9.0).clip_from_world();
    let objects = scene::instances(&gallery, 0, &pose).into_iter().map(|instance| {
        let [primitive] = &gallery.meshes[instance.mesh].primitives[..] else { panic!("one primitive") };
        let in_world: Vec<Vec3> =
            primitive.vertices.positions.iter().map(|&p| instance.world_from_object.transform_point3(p)).collect();
        // What the floor hides does not count.
        let in_clip = || in_world.iter().filter(|p| p.y > -1e-4).map(|&p| clip_from_world.project_point3(p));
        let low = in_clip().reduce(Vec3::min).expect("vertices");
        let high = in_clip().reduce(Vec3::max).expect("vertices");
        let bottom = in_world.iter().map(|p| p.y).fold(f32::INFINITY, f32::min);
        (gallery.nodes[instance.node.expect("a node")].name.clone().expect("a name"), [low, high], bottom)
    });
    objects.filter(|(name, ..)| name != "backdrop").collect()
}

#[test]
fn the_gallery_fills_its_picture_and_nothing_is_cut_off() {
    let objects = gallery_objects();
    assert!(objects.len() >= 8);
    for (name, [low, high], _) in &objects {
        assert!(low.x > -0.93 && high.x < 0.93 && low.y > -0.93 && high.y < 0.93, "{name}: {low} {high}");
        assert!(low.z > 0.0 && high.z < 1.0, "{name}: {low} {high}");
    }
    let reach = objects.iter().map(|(_, [low, high], _)| high.y - low.y).fold(0.0, f32::max);
    assert!(reach > 0.7, "the main object is small: {reach}");
}

#[test]
fn gallery_objects_stand_on_the_floor_or_above() {
    for (name, _, bottom) in gallery_objects() {
        assert!(name == "plinth" || bottom > -1e-4, "{name} reaches down to {bottom}");
    }
}

#[test]
fn the_gallery_is_covered_by_its_backdrop() {
    // Rays through the picture's corners meet the floor or the wall: no background shows at 16:9.
    let gallery = procedural::gallery();
    let world_from_clip = hero(&gallery, 16.0 / 9.0).clip_from_world().inverse();
    let primitive = &gallery.meshes[0].primitives[0];
    for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (0.0, 1.0), (0.0, -1.0)] {
        let near = world_from_clip.project_point3(Vec3::new(x, y, 1.0));
        let along = world_from_clip.project_point3(Vec3::new(x, y, 0.01)) - near;
        let hit = primitive.indices.chunks_exact(3).any(|triangle| {
            let [a, b, c] = [0, 1, 2].map(|i| primitive.vertices.positions[triangle[i] as usize] - near);
            let side = |p: Vec3, q: Vec3| along.dot(p.cross(q)) <= 0.0;
            side(a, b) == side(b, c) && side(b, c) == side(c, a) && along.dot(a) > 0.0
        });
        assert!(hit, "the backdrop ends before ({x}, {y})");
    }
}

#[test]
fn the_gallery_has_its_own_lights_and_finite_shells() {
    let gallery = procedural::gallery();
    let pose = scene::pose(&gallery, None, 0.0);
    let lights = scene::lights(&gallery, 0, &pose);
    assert_eq!(lights.len(), 3);
    for light in &lights {
        let incident = light.incident_at(Vec3::new(0.0, 0.4, 0.0));
        assert!(incident.irradiance.min_element() > 0.1, "{light:?} misses the main object");
    }
    for mesh in &gallery.meshes {
        for (primitive, directions) in mesh.primitives.iter().zip(scene::shell_directions_of_mesh(mesh)) {
            assert_eq!(directions.len(), primitive.vertices.positions.len());
            for (direction, normal) in directions.iter().zip(&primitive.vertices.normals) {
                assert!((direction.length() - 1.0).abs() < 1e-5 && direction.dot(*normal) > 0.9);
            }
        }
    }
}

#[test]
fn the_lit_quad_fills_the_picture_and_receives_pi() {
    let asset = procedural::lit_quad(Material::default());
    let pose = scene::pose(&asset, None, 0.0);
    let shown = scene::world_hull(&asset, 0, &pose);
    let bounds = shown.bounds();
    let camera = scene::camera(&asset, 0, &pose, &CameraChoice::Named("front".into()), 1.0, &shown).expect("front");
    assert!(camera.is_orthographic);
    let corner = camera.clip_from_world().project_point3(bounds.max);
    assert!((corner.truncate() - glam::Vec2::ONE).length() < 1e-6 && corner.z > 0.0 && corner.z < 1.0);
    let light = scene::lights(&asset, 0, &pose)[0].incident_at(Vec3::ZERO);
    assert!((light.irradiance - Vec3::splat(std::f32::consts::PI)).length() < 1e-6);
    assert!((light.direction_to_light_in_world - Vec3::Z).length() < 1e-6);
}

/// A furred box that a joint carries, turns and mirrors over a second.
fn animated_box(scale_x: f32) -> Asset {
    let mut primitive = procedural::cube(0.5);
    primitive.vertices.joints = vec![(0, 1.0); primitive.vertices.positions.len()];
    primitive.vertices.influences_per_vertex = 1;
    let channel = |values| Channel { node: 1, times_s: vec![0.0, 1.0], interpolation: Interpolation::Linear, values };
    let scale = Vec3::new(scale_x, 1.0, 1.0);
    Asset {
        scenes: vec![AssetScene { name: None, roots: vec![0, 1] }],
        nodes: vec![
            Node { mesh: Some(0), skin: Some(0), ..Node::default() },
            Node {
                transform: Transform::Trs { translation: Vec3::ZERO, rotation: Quat::IDENTITY, scale },
                ..Node::default()
            },
        ],
        materials: vec![Material::default()],
        meshes: vec![Mesh { primitives: vec![primitive], ..Mesh::default() }],
        skins: vec![Skin { joints: vec![1], inverse_bind: vec![Mat4::IDENTITY] }],
        animations: vec![Animation {
            name: Some("carry".into()),
            duration_s: 1.0,
            channels: vec![
                channel(Keys::Translation(vec![Vec3::ZERO, Vec3::X * 10.0])),
                channel(Keys::Rotation(vec![Quat::IDENTITY, Quat::from_rotation_z(std::f32::consts::FRAC_PI_2)])),
            ],
        }],
        ..Asset::default()
    }
}

#[test]
fn a_skinned_box_moves_with_its_joint_and_so_does_the_framing() {
    for scale_x in [1.0, -1.0] {
        let asset = animated_box(scale_x);
        let clip = scene::find_animation(&asset, "carry").expect("the clip");
        let pose = scene::pose(&asset, Some(clip), 0.5);
        let [instance] = &scene::instances(&asset, 0, &pose)[..] else { panic!("one instance") };
        assert_eq!(instance.mirrored, scale_x < 0.0);
        let joints = scene::joint_matrices(&asset, 0, &pose);
        let deformed = scene::deform(&asset.meshes[0].primitives[0], &joints, &instance.morph_weights);
        for (position, normal) in deformed.positions.iter().zip(&deformed.normals) {
            // The box's middle is carried to x = 5; every normal still points away from it.
            assert!((*position - Vec3::X * 5.0).dot(*normal) > 0.49);
        }
        let shown = scene::world_hull(&asset, 0, &pose);
        let bounds = shown.bounds();
        assert!((bounds.center() - Vec3::X * 5.0).length() < 1e-5);
        assert!((bounds.half_extent() - Vec3::new(0.5 * 2f32.sqrt(), 0.5 * 2f32.sqrt(), 0.5)).length() < 1e-5);
        let camera = scene::camera(&asset, 0, &pose, &CameraChoice::Auto, 16.0 / 9.0, &shown).expect("a view");
        for &corner in shown.points() {
            let shown = camera.clip_from_world().project_point3(corner);
            assert!(shown.truncate().abs().max_element() <= 0.921 && shown.z > 0.0 && shown.z < 1.0);
        }
        // The relative fur length is measured at rest: it does not grow while the box turns.
        assert!((scene::object_scale(&asset, 0) - 1.0).abs() < 1e-6);
    }
}

#[test]
fn shells_of_a_hard_box_stay_closed_when_pushed_out() {
    let mesh = Mesh { primitives: vec![procedural::cube(0.5)], ..Mesh::default() };
    let directions = &scene::shell_directions_of_mesh(&mesh)[0];
    let pushed: Vec<Vec3> =
        mesh.primitives[0].vertices.positions.iter().zip(directions).map(|(&p, &d)| p + 0.2 * d).collect();
    for corner in pushed.chunks(1).map(|p| p[0]) {
        let expected = corner.signum() * (0.5 + 0.2 / 3f32.sqrt());
        assert!((corner - expected).length() < 1e-6, "{corner}");
    }
}

#[test]
fn a_light_moves_with_its_animated_node() {
    let mut asset = animated_box(1.0);
    asset.lights = vec![asset::Light {
        color: Vec3::ONE,
        intensity: 4.0,
        kind: asset::LightKind::Point { range_m: None },
        name: None,
    }];
    asset.nodes[1].light = Some(0);
    let pose = scene::pose(&asset, Some(0), 1.0);
    let light = &scene::lights(&asset, 0, &pose)[0];
    assert_eq!(light.position_in_world, Vec3::X * 10.0);
    assert!((light.incident_at(Vec3::X * 8.0).irradiance - Vec3::ONE).length() < 1e-6);
}
