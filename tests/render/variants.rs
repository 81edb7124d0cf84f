//! Every compiled shader serves some draw, and every pipeline that draws ask for can be made.

use crate::headless::headless;
use crate::skinning::bent_tube;
use crate::stage::{Stage, at, options as unshadowed, plain, quad};
use glam::{Vec2, Vec3, Vec4};
use std::collections::BTreeSet;
use vair::asset::{AlphaMode, Animation, Material, Primitive, TextureRef, Topology};
use vair::material::{Blend, Family, Form, Fur, ImageName, Layered, Shape, TextureSource, Value};
use vair::measure::{count_fragments, counting_pipeline};
use vair::render::{Aovs, Eye, FrameOptions, FrameSetup, Plan, ScreenOcclusion, Shadows, Transparency};
use vair::scene::{Light, Scene};
use vair::shader::{ShaderKey, table};

fn options(size: [u32; 2], msaa: u32) -> FrameOptions {
    FrameOptions { shadows: Shadows::default(), ..unshadowed(size, msaa) }
}

fn colored(has_color: bool) -> Primitive {
    let mut primitive = quad(0.5, 0.5);
    if has_color {
        primitive.vertices.colors = vec![Vec4::ONE; 4];
    }
    primitive
}

/// One quad for each thing that a surface may have.
fn surfaces() -> Scene {
    let mut stage = Stage::front(0.5);
    let map = stage.texel([128, 128, 255, 255]);
    let mut detailed = Vec::new();
    for has_color in [false, true] {
        for alpha_mode in [AlphaMode::Opaque, AlphaMode::Mask(0.5), AlphaMode::Blend] {
            for double_sided in [false, true] {
                let base = Material { alpha_mode, double_sided, ..plain() };
                let base_color_texture = Some(map);
                let normal_texture = Some(map);
                let every_map = Material {
                    base_color_texture,
                    normal_texture,
                    metallic_roughness_texture: Some(map),
                    occlusion_texture: Some(map),
                    emissive_texture: Some(map),
                    ..base.clone()
                };
                for material in [
                    base.clone(),
                    Material { base_color_texture, ..base.clone() },
                    Material { normal_texture, ..base.clone() },
                    every_map.clone(),
                    Material { unlit: true, ..base.clone() },
                    Material { unlit: true, base_color_texture, ..base },
                ] {
                    let material = stage.material(material);
                    stage.object(colored(has_color), material, at(Vec3::ZERO));
                }
                detailed.push(stage.material(every_map));
                stage.object(colored(has_color), stage.asset.materials.len() - 1, at(Vec3::ZERO));
            }
        }
        for topology in [Topology::Points, Topology::Lines] {
            let material = stage.material(plain());
            let mut loose = colored(has_color);
            loose.vertices.normals.clear();
            stage.object(Primitive { topology, ..loose }, material, at(Vec3::ZERO));
        }
    }
    let mut scene = stage.scene();
    for material in detailed {
        scene.materials_mut()[material].standard.detail_albedo_texture = Some(map);
        scene.materials_mut()[material].standard.detail_normal_texture = Some(map);
    }
    scene
}

/// One quad for each thing that a cloth's shader may have, of every family.
fn cloths(alpha_mode: AlphaMode) -> Scene {
    let mut stage = Stage::front(0.5);
    let map = stage.texel([128, 128, 255, 255]);
    let mut dressed = Vec::new();
    let fuzzy = Family::Layered(Layered { sheen_color: Vec3::ONE, ..Layered::default() });
    for cloth in Family::KINDS.iter().filter_map(|kind| Family::of_kind(kind)).chain([fuzzy]) {
        for has_color in [false, true] {
            for (textured, detailed, own_maps) in [
                (false, false, false),
                (true, false, false),
                (true, true, false),
                (false, false, true),
                (false, true, true),
            ] {
                let base_color_texture = textured.then_some(map);
                let material = stage.material(Material { base_color_texture, alpha_mode, ..plain() });
                stage.object(colored(has_color), material, at(Vec3::ZERO));
                dressed.push((material, cloth.clone(), detailed, own_maps));
            }
        }
    }
    let mut scene = stage.scene();
    for (material, cloth, detailed, own_maps) in dressed {
        let material = &mut scene.materials_mut()[material];
        material.standard.detail_normal_texture = detailed.then_some(map);
        material.family = Some(if own_maps { with_every_map(cloth, map) } else { cloth });
    }
    scene
}

/// The cloth with that texture for every map that it declares.
pub fn with_every_map(mut cloth: Family, map: TextureRef) -> Family {
    struct One(usize);
    impl TextureSource for One {
        fn texture(&mut self, _: &ImageName) -> Result<usize, String> {
            Ok(self.0)
        }
    }
    for parameter in cloth.parameters().iter().filter(|parameter| parameter.form == Form::Map) {
        let value = Value::Text("any.png".to_owned());
        cloth.set(parameter.name, &value, &mut One(map.texture)).unwrap_or_else(|error| panic!("{error}"));
    }
    cloth
}

/// One coat for each thing that a coat may have.
fn coats() -> Scene {
    let mut stage = Stage::front(0.5);
    let map = stage.texel([128, 128, 255, 255]);
    let mut coats = Vec::new();
    for has_color in [false, true] {
        for blend in [Blend::Cutout, Blend::Coverage, Blend::Blend] {
            let base = Fur { blend, layers: 2, ..Fur::default() };
            let maps = Fur {
                height_map: Some(map),
                distribution_map: Some(map),
                base_color_texture: Some(map),
                spot_map: Some(map),
                comb_map: Some(map),
                shape: Shape::Paraboloid,
                ..base.clone()
            };
            let uncombed = Fur { comb_map: None, ..maps.clone() };
            let locks = Fur { clump: 0.5, curl: 0.5, ..base.clone() };
            let combed = Fur { comb: Vec2::X, ..base.clone() };
            for fur in [locks, combed, base, Fur { clump: 0.5, ..maps.clone() }, uncombed, maps] {
                // To sway changes vertices alone: one way to blend stands for all.
                let swaying = (blend == Blend::Cutout).then(|| Fur { inertia: 0.5, ..fur.clone() });
                for fur in [Some(fur), swaying].into_iter().flatten() {
                    let material = stage.material(plain());
                    stage.object(colored(has_color), material, at(Vec3::ZERO));
                    coats.push((material, fur));
                }
            }
        }
    }
    stage.asset.animations.push(Animation::default());
    let mut scene = stage.scene();
    for (material, fur) in coats {
        scene.materials_mut()[material].fur = Some(fur);
    }
    scene
}

/// The frame as it is, with depth alone, and with all layers and occlusion.
fn guided(frame: &FrameOptions) -> [FrameOptions; 3] {
    let depth = Aovs { depth: true, ..Aovs::default() };
    let (all, screen_occlusion) = (Aovs { motion: true, ..depth }, Some(ScreenOcclusion::default()));
    [
        frame.clone(),
        FrameOptions { aovs: depth, ..frame.clone() },
        FrameOptions { aovs: all, screen_occlusion, ..frame.clone() },
    ]
}

#[test]
fn every_shader_is_used_and_every_pipeline_can_be_made() {
    let mut skin_alone = bent_tube(true).asset().clone();
    skin_alone.meshes[0].primitives[0].morph_targets.clear();
    skin_alone.meshes[0].weights.clear();
    skin_alone.nodes.iter_mut().for_each(|node| node.weights.clear());
    let skin_alone = Scene::from_asset(skin_alone).unwrap();
    let scenes = [surfaces(), coats(), bent_tube(true), bent_tube(false), skin_alone];
    // The tone mapping depends on what the picture's background is, and what prepares an environment runs once.
    let is_unplanned = |key: &ShaderKey| {
        let name = key.file.name();
        name == "tone_mapping.frag" || name.starts_with("environment_")
    };
    let compiled: BTreeSet<ShaderKey> = table::ALL.iter().map(|(key, _)| *key).collect();
    let mut used: BTreeSet<ShaderKey> = compiled.iter().copied().filter(is_unplanned).collect();
    // Their pipelines are made below, beside these.
    for scene in [AlphaMode::Opaque, AlphaMode::Blend].map(cloths) {
        for transparency in [Transparency::PerPixel, Transparency::Sorted] {
            for lights in [vec![Light::key()], Vec::new()] {
                for frame in guided(&FrameOptions { transparency, lights: lights.clone(), ..options([4, 4], 4) }) {
                    let plan = FrameSetup::new(&scene, &frame).unwrap_or_else(|error| panic!("{error}")).staging.plan;
                    used.extend(plan.pipelines.into_iter().flat_map(|spec| [spec.vertex, spec.fragment]));
                }
            }
        }
    }
    headless(|device| {
        // A light casts shadows, and without one nothing is occluded.
        for (msaa, lights) in [(1, vec![Light::key()]), (4, Vec::new())] {
            for scene in &scenes {
                let animation = (!scene.asset().animations.is_empty()).then_some(0);
                let frame = FrameOptions { animation, lights: lights.clone(), ..options([4, 4], msaa) };
                for frame in guided(&frame) {
                    let plan = FrameSetup::new(scene, &frame).unwrap_or_else(|error| panic!("{error}")).staging.plan;
                    used.extend(plan.pipelines.iter().flat_map(|spec| [spec.vertex, spec.fragment]));
                    if !frame.aovs.any() {
                        let drawn =
                            plan.pipelines.iter().filter(|spec| spec.eye == Eye::Camera && spec.variants.is_some());
                        used.extend(drawn.filter_map(counting_pipeline).map(|spec| spec.fragment));
                    }
                    used.extend(
                        plan.full_screen(&frame.plan_options()).iter().flat_map(|spec| [spec.vertex, spec.fragment]),
                    );
                    used.extend(plan.compute_pipelines.iter().map(|spec| spec.shader));
                    device.picture(scene, &frame);
                }
                count_fragments(&mut device.renderer, scene, &frame).unwrap_or_else(|error| panic!("{error}"));
            }
        }
        let difference: Vec<_> = used.symmetric_difference(&compiled).map(ShaderKey::to_string).collect();
        assert!(difference.is_empty(), "used and not compiled, or compiled and not used: {difference:?}");
        assert!(device.renderer.pipeline_descriptions().len() > 60, "most combinations make a pipeline of their own");
    });
}

fn plan_of(scene: &Scene, transparency: Transparency, lights: Vec<Light>) -> Plan {
    let frame = FrameOptions { transparency, lights, ..options([4, 4], 4) };
    FrameSetup::new(scene, &frame).unwrap_or_else(|error| panic!("{error}")).staging.plan
}

#[test]
fn every_pipeline_of_cloth_can_be_made() {
    let scenes = [AlphaMode::Opaque, AlphaMode::Blend].map(cloths);
    headless(|device| {
        for scene in &scenes {
            for lights in [vec![Light::key()], Vec::new()] {
                device.picture(scene, &FrameOptions { lights: lights.clone(), ..options([4, 4], 4) });
                let made = device.renderer.pipeline_descriptions().len();
                let planned = plan_of(scene, Transparency::PerPixel, lights).pipelines.len();
                assert!(made >= planned && made > 5 * Family::KINDS.len(), "{made}");
            }
        }
    });
}
