//! Blended layers lie over each other by where they are, whatever the order of the file.

use crate::headless::{Headless, headless};
use crate::scenes::three_lights;
use crate::stage::{Stage, at, options, plain};
use glam::{Quat, Vec3, Vec4};
use vair::asset::procedural::{plane, sphere};
use vair::asset::{Material, Primitive, Transform};
use vair::material::{Blend, Family, Fur, Gauze, Length};
use vair::scene::Scene;

/// An object and what it is dressed in.
#[derive(Clone)]
struct Layer {
    primitive: Primitive,
    transform: Transform,
    color: Vec3,
    dress: Dress,
}

#[derive(Clone)]
enum Dress {
    Plain,
    Gauze,
    BlendedFur,
}

fn scene(layers: &[Layer], order: [usize; 3]) -> Scene {
    let mut stage = Stage::default();
    stage.parallel_camera(1.2, Vec3::new(0.2, 0.3, 1.0), Vec3::Y);
    three_lights(&mut stage);
    let mut dresses = Vec::new();
    for index in order {
        let Layer { primitive, transform, color, dress } = layers[index].clone();
        let base_color = color.extend(1.0);
        let material = stage.material(Material { base_color, double_sided: true, roughness: 0.5, ..plain() });
        stage.object(primitive, material, transform);
        dresses.push((material, dress));
    }
    let mut scene = stage.scene();
    for (material, dress) in dresses {
        let material = &mut scene.materials_mut()[material];
        match dress {
            Dress::Plain => {}
            Dress::Gauze => material.family = Some(Family::Gauze(Gauze { weave_density: 3.0, ..Gauze::default() })),
            Dress::BlendedFur => {
                let (length, strand_spacing) = (Length::Relative(0.2), Length::Relative(0.08));
                material.fur = Some(Fur { blend: Blend::Blend, length, strand_spacing, layers: 4, ..Fur::default() });
            }
        }
    }
    scene
}

fn check(device: &mut Headless, what: &str, layers: [Layer; 3]) {
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let mut bytes = |order| {
        let picture = device.picture(&scene(&layers, order), &options([48, 48], 4));
        (0..48 * 48).map(|at| picture.radiance(at % 48, at / 48)).collect::<Vec<Vec4>>()
    };
    let first = bytes(orders[0]);
    assert!(first.iter().any(|pixel| pixel.w > 0.0), "{what} shows nothing");
    for order in &orders[1..] {
        assert!(bytes(*order) == first, "{what}: {order:?} looks otherwise");
    }
}

fn ball(radius_m: f32, place: Vec3, color: Vec3, dress: Dress) -> Layer {
    Layer { primitive: sphere(radius_m, 16), transform: at(place), color, dress }
}

/// A sheet that faces the camera.
fn sheet(depth_m: f32, color: Vec3, dress: Dress) -> Layer {
    let rotation = Quat::from_rotation_x(std::f32::consts::FRAC_PI_2);
    let transform = Transform::Trs { translation: Vec3::Z * depth_m, rotation, scale: Vec3::ONE };
    Layer { primitive: plane(1.6, 1.6, 1), transform, color, dress }
}

const RED: Vec3 = Vec3::new(0.8, 0.1, 0.1);
const GREEN: Vec3 = Vec3::new(0.1, 0.7, 0.2);
const BLUE: Vec3 = Vec3::new(0.1, 0.2, 0.9);

#[test]
fn three_layers_in_any_order_give_the_same_picture() {
    use Dress::{BlendedFur, Gauze, Plain};
    headless(|device| {
        let middle = Vec3::ZERO;
        let balls = [(0.9, RED), (0.6, GREEN), (0.3, BLUE)].map(|(radius, color)| ball(radius, middle, color, Gauze));
        check(device, "concentric balls of gauze", balls);
        let sheets = [(0.4, RED), (0.0, GREEN), (-0.4, BLUE)].map(|(depth_m, color)| sheet(depth_m, color, Gauze));
        check(device, "gauze over gauze", sheets);
        let coat = ball(0.4, middle, GREEN, BlendedFur);
        check(device, "gauze over fur over cotton", [sheet(0.8, RED, Gauze), coat.clone(), sheet(-0.8, BLUE, Plain)]);
        check(device, "fur in gauze", [ball(0.9, middle, RED, Gauze), coat, sheet(-1.0, BLUE, Gauze)]);
        // At the same place, what lies over what is a matter of taste, but of one taste.
        let same = [RED, GREEN, BLUE].map(|color| ball(0.5, middle, color, Gauze));
        check(device, "three balls in one", same);
    });
}

#[test]
fn a_ball_in_a_ball_is_seen_through_the_outer_one() {
    headless(|device| {
        let color = |layers: [Layer; 3]| {
            let picture = device.picture(&scene(&layers, [0, 1, 2]), &options([48, 48], 1));
            picture.radiance(24, 24)
        };
        let mut color = color;
        let inner = |layer_color| ball(0.3, Vec3::ZERO, layer_color, Dress::Gauze);
        let far = sheet(-3.0, Vec3::ZERO, Dress::Gauze);
        let (red_within, blue_within) = (
            color([ball(0.9, Vec3::ZERO, BLUE, Dress::Gauze), inner(RED), far.clone()]),
            color([ball(0.9, Vec3::ZERO, RED, Dress::Gauze), inner(BLUE), far]),
        );
        // The outer front is blended last and hides a share of what is within.
        assert!(red_within.z > red_within.x && blue_within.x > blue_within.z, "{red_within} {blue_within}");
    });
}
