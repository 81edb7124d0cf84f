//! What belongs to an object stays with it, however its node or joint turns, scales or mirrors it: mapped normals,
//! combs, forces.

use crate::headless::headless;
use crate::limit::{all_hold, within};
use crate::shells::height_coat;
use crate::stage::{NEAREST, Stage, at, options, plain, quad};
use glam::{Mat4, Quat, Vec2, Vec3, Vec4};
use std::f32::consts::FRAC_PI_2;
use vair::asset::procedural::cube;
use vair::asset::{LightKind, Material, Node, Primitive, Sampler, Skin, Transform};
use vair::material::{ForceSpace, Fur, Length};
use vair::render::Picture;
use vair::scene::Scene;

fn scaled(scale: Vec3) -> Transform {
    Transform::Trs { translation: Vec3::ZERO, rotation: Quat::IDENTITY, scale }
}

fn turned(rotation: Quat) -> Transform {
    Transform::Trs { translation: Vec3::ZERO, rotation, scale: Vec3::ONE }
}

/// Binds every vertex to one joint, which stands as `transform` says.
fn on_joint(stage: &mut Stage, mut primitive: Primitive, material: usize, transform: Transform) {
    primitive.vertices.influences_per_vertex = 4;
    let alone = [(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)];
    primitive.vertices.joints = alone.repeat(primitive.vertices.positions.len());
    stage.asset.nodes.push(Node { transform, ..Node::default() });
    let joints = vec![stage.asset.nodes.len() - 1];
    stage.asset.skins.push(Skin { joints, inverse_bind: vec![Mat4::IDENTITY] });
    let node = stage.object(primitive, material, at(Vec3::ONE));
    stage.asset.nodes[node].skin = Some(stage.asset.skins.len() - 1);
}

/// A quad of a mapped normal that fills the picture, whatever its node scales by; the light is mirrored as the node is.
fn mapped(scale: Vec3, skinned: bool) -> Scene {
    let mut stage = Stage::front(0.5);
    let normal_texture = Some(stage.texel([190, 100, 220, 255]));
    let material = stage.material(Material { normal_texture, roughness: 0.5, ..plain() });
    let primitive = quad(0.6 / scale.x.abs(), 0.6 / scale.y.abs());
    if skinned {
        on_joint(&mut stage, primitive, material, scaled(scale));
    } else {
        stage.object(primitive, material, scaled(scale));
    }
    let to_light = Vec3::new(0.6, -0.5, 0.6).normalize() * scale.signum();
    stage.light(LightKind::Directional, Vec3::ONE, Vec3::ZERO, to_light);
    stage.scene()
}

#[test]
fn mapped_normals_hold_on_scaled_and_mirrored_objects() {
    headless(|device| {
        let frame = options([4, 4], 1);
        let expected = device.picture(&mapped(Vec3::ONE, false), &frame).radiance(1, 1).truncate().as_dvec3();
        let unmapped = device.picture(&mapped(Vec3::ONE, false).without_maps(), &frame).radiance(1, 1);
        assert!(within("plain", unmapped, expected, 0.05, 0.0).is_err(), "the map tells nothing");
        let mut checks = Vec::new();
        for skinned in [false, true] {
            for scale in [
                Vec3::ONE,
                Vec3::splat(0.01),
                Vec3::splat(100.0),
                Vec3::new(2.0, 1.0, 1.0),
                Vec3::new(-1.0, 1.0, 1.0),
                Vec3::new(1.0, -1.0, 1.0),
                Vec3::new(-0.01, 0.02, 0.01),
            ] {
                let found = device.picture(&mapped(scale, skinned), &frame).radiance(1, 1);
                // Both were read from half floats.
                checks.push(within(&format!("scale {scale}, skinned {skinned}"), found, expected, 2e-3, 1e-6));
            }
        }
        all_hold(checks);
    });
}

trait WithoutMaps {
    fn without_maps(self) -> Self;
}

impl WithoutMaps for Scene {
    fn without_maps(mut self) -> Self {
        self.materials_mut()[0].standard.normal_texture = None;
        self
    }
}

/// A coated cube that `rotation` turns together with the camera, by ambient light alone.
fn turned_with_camera(rotation: Quat, skinned: bool, fur: &Fur) -> Scene {
    let mut stage = Stage::default();
    stage.parallel_camera(1.0, rotation * Vec3::new(0.4, 0.5, 0.8), rotation * Vec3::Y);
    let white = stage.texel([255; 4]);
    let material = stage.material(plain());
    if skinned {
        on_joint(&mut stage, cube(0.4), material, turned(rotation));
    } else {
        stage.object(cube(0.4), material, turned(rotation));
    }
    let mut scene = stage.scene();
    scene.materials_mut()[material].fur = Some(Fur { distribution_map: Some(white), ..fur.clone() });
    scene
}

fn differing(found: &Picture, expected: &Picture) -> (usize, usize) {
    let covered = expected.radiance.iter().filter(|radiance| radiance.w > 0.0).count();
    let differ = |(a, b): &(&Vec4, &Vec4)| (**a - **b).abs().max_element() > 0.01 * b.max_element() + 1e-4;
    (found.radiance.iter().zip(&expected.radiance).filter(differ).count(), covered)
}

#[test]
fn combs_and_forces_of_the_object_turn_with_its_node_and_its_joint() {
    let coat = Fur { length: Length::Metres(0.3), ..height_coat() };
    let combed = Fur { comb: Vec2::new(0.5, 0.3), ..coat.clone() };
    let pulled =
        |force_space| Fur { force: Vec3::new(0.3, -1.0, 0.2), force_strength: 0.8, force_space, ..coat.clone() };
    let rotation = Quat::from_rotation_x(FRAC_PI_2);
    headless(|device| {
        let frame = options([96, 96], 1);
        let straight = device.picture(&turned_with_camera(Quat::IDENTITY, false, &coat), &frame);
        for (what, fur, turns) in [
            ("comb", combed, true),
            ("force of the object", pulled(ForceSpace::Object), true),
            ("force of the world", pulled(ForceSpace::World), false),
        ] {
            let expected = device.picture(&turned_with_camera(Quat::IDENTITY, false, &fur), &frame);
            let (moved, covered) = differing(&straight, &expected);
            assert!(covered > 2000 && moved * 10 > covered, "{what}: only {moved} of {covered} pixels tell");
            for skinned in [false, true] {
                let found = device.picture(&turned_with_camera(rotation, skinned, &fur), &frame);
                let (differ, covered) = differing(&found, &expected);
                // Rounding decides edges of shells otherwise.
                let is_same = differ * 50 <= covered;
                assert_eq!(is_same, turns, "{what}, skinned {skinned}: {differ} of {covered} pixels differ");
            }
        }
    });
}

#[test]
fn a_coat_of_its_own_colour_leaves_the_surfaces_texture() {
    let shown = |base_color: Option<Vec3>| {
        let mut stage = Stage::front(0.5);
        let (white, red) = (stage.texel([255; 4]), stage.texel([255, 0, 0, 255]));
        let material = stage.material(Material { base_color_texture: Some(red), ..plain() });
        stage.object(quad(0.5, 0.5), material, at(Vec3::ZERO));
        let mut scene = stage.scene();
        let (root_color, tip_color) = (Vec3::ONE, Vec3::ONE);
        let coat = Fur { distribution_map: Some(white), base_color, root_color, tip_color, ..height_coat() };
        scene.materials_mut()[material].fur = Some(coat);
        scene
    };
    headless(|device| {
        let frame = options([4, 4], 1);
        let own = device.picture(&shown(Some(Vec3::new(0.2, 0.8, 0.4))), &frame).radiance(1, 1);
        let taken = device.picture(&shown(None), &frame).radiance(1, 1);
        let expected = Vec3::new(0.25, 1.0, 0.5).as_dvec3() * f64::from(own.y);
        assert!(own.y > 0.0 && taken.x > 0.0);
        // Three half floats.
        all_hold([within("own colour", own, expected, 2e-3, 1e-6)]);
        all_hold([within("texture", taken, (Vec3::X * taken.x).as_dvec3(), 2e-3, 1e-6)]);
    });
}

/// Mean light of a picture; over that of a closed coat, the share of a black skin that the strands cover.
fn mean_light(picture: &Picture) -> f64 {
    let light = picture.radiance.iter().map(|radiance| f64::from(radiance.y)).sum::<f64>();
    light / picture.radiance.len() as f64
}

#[test]
fn strands_cover_as_much_from_afar_as_from_near() {
    /// Spacing of the strands, metres.
    const SPACING_M: f32 = 0.02;
    let seen = |half_m: f32, cover: bool| {
        let mut stage = Stage::front(half_m);
        let white = stage.texel([255; 4]);
        let material = stage.material(Material { base_color: Vec4::new(0.0, 0.0, 0.0, 1.0), ..plain() });
        stage.object(quad(4.0, 4.0), material, at(Vec3::ZERO));
        let mut scene = stage.scene();
        // One shell at half height, half as bright as the tips everywhere; the skin is as black as the roots.
        let fur = Fur {
            layers: 1,
            length: Length::Metres(1e-3),
            strand_spacing: Length::Metres(SPACING_M),
            cutoff_start: 0.0,
            cutoff_end: if cover { 0.0 } else { 0.6 },
            root_color: Vec3::ZERO,
            tip_color: Vec3::ONE,
            thickness: 0.9,
            distribution_map: cover.then_some(white),
            ..height_coat()
        };
        scene.materials_mut()[material].fur = Some(fur);
        scene
    };
    headless(|device| {
        for msaa in [1, 4] {
            // Spacings of 16 pixels, 1 and a quarter.
            let shares = [16.0, 1.0, 0.25].map(|spacing_px: f32| {
                let side = 128;
                let half_m = 0.5 * side as f32 * SPACING_M / spacing_px;
                let frame = options([side; 2], msaa);
                let full = mean_light(&device.picture(&seen(half_m.min(3.5), true), &frame));
                mean_light(&device.picture(&seen(half_m.min(3.5), false), &frame)) / full
            });
            let (least, most) =
                shares.iter().fold((1.0f64, 0.0f64), |(low, high), &share| (low.min(share), high.max(share)));
            assert!(least > 0.05 && most < 0.95, "{shares:?} tell nothing");
            assert!(most - least <= 0.05, "{msaa} samples: {shares:?} at 16, 1 and 1/4 pixels a strand");
        }
    });
}

#[test]
fn a_linear_minifying_filter_averages_without_mips() {
    let mut stage = Stage::front(0.5);
    let texels: Vec<[u8; 4]> =
        (0..64).map(|i| if (i % 8 + i / 8) % 2 == 0 { [255; 4] } else { [0, 0, 0, 255] }).collect();
    let sampler = Sampler { min_linear: true, ..NEAREST };
    let texture = stage.texture([8, 8], &texels, sampler);
    let material = stage.material(Material { base_color_texture: Some(texture), ..crate::stage::unlit(Vec4::ONE) });
    stage.object(quad(0.5, 0.5), material, at(Vec3::ZERO));
    let scene = stage.scene();
    headless(|device| {
        // Every pixel's middle lies between two white and two black texels.
        let picture = device.picture(&scene, &options([4, 4], 1));
        all_hold(picture.radiance.iter().map(|radiance| within("mean", *radiance, glam::DVec3::splat(0.5), 0.0, 0.01)));
        let near = device.picture(&scene, &options([32, 32], 1));
        let is_texel = |radiance: &Vec4| radiance.x < 1e-3 || radiance.x > 0.999;
        assert!(near.radiance.iter().all(is_texel), "the magnifying filter is nearest");
    });
}
