//! Scenes made in memory: each broken promise of the model is refused by field, value and remedy.

use glam::{Mat4, Quat, Vec2, Vec3, Vec4};
use vair::asset::*;
use vair::scene::Scene;

/// One of everything, by hand.
fn whole() -> Asset {
    let texture = Some(TextureRef { texture: 0, uv_set: 0, offset: Vec2::ZERO, rotation: 0.0, scale: Vec2::ONE });
    let channel = |values| Channel { node: 1, times_s: vec![0.0, 1.0], interpolation: Interpolation::Linear, values };
    let vertices = Vertices {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
        normals: vec![Vec3::Z; 3],
        tangents: vec![Vec4::new(1.0, 0.0, 0.0, 1.0); 3],
        uv_sets: vec![vec![Vec2::ZERO; 3]],
        colors: vec![Vec4::ONE; 3],
        joints: [(0, 0.75), (1, 0.25), (0, 0.0), (0, 0.0)].repeat(3),
        influences_per_vertex: 4,
    };
    let target = MorphTarget { positions: vec![Vec3::Y; 3], normals: Vec::new(), tangents: Vec::new() };
    let primitive = Primitive {
        indices: vec![0, 1, 2],
        vertices,
        morph_targets: vec![target],
        variant_materials: vec![(0, 1)],
        ..Primitive::default()
    };
    let sheen = Sheen { color: Vec3::ONE, color_texture: texture, roughness: 0.5, roughness_texture: None };
    let extensions = MaterialExtensions { sheen: Some(Box::new(sheen)), ..MaterialExtensions::default() };
    let spot = LightKind::Spot { range_m: Some(2.0), inner_angle: 0.1, outer_angle: 0.2 };
    let parallel = Projection::Orthographic { half_width_m: 1.0, half_height_m: 1.0, near_m: 0.0, far_m: 1.0 };
    Asset {
        scenes: vec![AssetScene { name: None, roots: vec![0] }],
        nodes: vec![
            Node { children: vec![1, 2], mesh: Some(0), skin: Some(0), weights: vec![0.5], ..Node::default() },
            Node { mesh: Some(0), camera: Some(0), light: Some(0), ..Node::default() },
            Node { transform: Transform::Matrix(Mat4::IDENTITY), ..Node::default() },
        ],
        meshes: vec![Mesh { primitives: vec![primitive], weights: vec![0.0], ..Mesh::default() }],
        materials: vec![
            Material { base_color_texture: texture, ..Material::default() },
            Material { extensions, ..Material::default() },
        ],
        textures: vec![Texture::default()],
        images: vec![Image { name: "white".to_owned(), width: 1, height: 1, rgba: vec![255; 4] }],
        cameras: vec![Camera::default(), Camera { name: None, projection: parallel }],
        lights: vec![Light { name: None, color: Vec3::ONE, intensity: 1.0, kind: spot }],
        skins: vec![Skin { joints: vec![1, 2], inverse_bind: vec![Mat4::IDENTITY; 2] }],
        animations: vec![Animation {
            name: None,
            duration_s: 1.0,
            channels: vec![
                channel(Keys::Translation(vec![Vec3::ZERO; 2])),
                channel(Keys::Rotation(vec![Quat::IDENTITY; 2])),
                channel(Keys::Scale(vec![Vec3::ONE; 2])),
                channel(Keys::Weights { targets: 1, values: vec![0.0, 1.0] }),
            ],
        }],
        variants: vec!["other".to_owned()],
        ..Asset::default()
    }
}

fn refused(bend: impl FnOnce(&mut Asset), field: &str, words: &str) {
    let mut asset = whole();
    bend(&mut asset);
    let text = Scene::from_asset(asset).expect_err(field).to_string();
    assert!(text.starts_with(&format!("scene: {field}: ")), "{text}\nnot at {field}");
    assert!(text.contains(words) && text.contains(';') && !text.contains('\n'), "{text}\nlacks {words}");
}

#[test]
fn whole_data_passes() {
    Scene::from_asset(whole()).unwrap();
    check(&procedural::gallery()).unwrap();
    for is_hung in [false, true] {
        check(&procedural::swatch(is_hung)).unwrap();
    }
}

#[test]
fn scenes_and_nodes() {
    refused(|a| a.scenes.clear(), "scenes", "empty");
    refused(|a| a.default_scene = 3, "default_scene", "index 3 is out of range: scenes has 1");
    refused(|a| a.scenes[0].roots = vec![7], "scenes[0].roots[0]", "index 7");
    refused(|a| a.scenes[0].roots = vec![1], "scenes[0].roots[0]", "child of another");
    refused(|a| a.scenes[0].roots = vec![0, 0], "scenes[0].roots[1]", "already");
    refused(|a| a.nodes[0].children[0] = 9, "nodes[0].children[0]", "index 9");
    refused(|a| a.nodes[1].children = vec![2], "nodes[2]", "two parents");
    refused(|a| a.nodes[2].children = vec![0], "nodes[0]", "own ancestor");
    refused(|a| a.nodes[2].children = vec![2], "nodes[2]", "two parents");
    refused(|a| a.nodes[0].mesh = Some(1), "nodes[0].mesh", "index 1");
    refused(|a| a.nodes[0].skin = Some(1), "nodes[0].skin", "index 1");
    refused(|a| a.nodes[1].camera = Some(2), "nodes[1].camera", "index 2");
    refused(|a| a.nodes[1].light = Some(1), "nodes[1].light", "index 1");
    refused(|a| a.nodes[0].weights = vec![0.0; 2], "nodes[0].weights", "2 entries for 1");
    refused(|a| a.nodes[0].weights = vec![f32::NAN], "nodes[0].weights", "NaN");
    let trs = |translation, rotation, scale| Transform::Trs { translation, rotation, scale };
    let (zero, one, still) = (Vec3::ZERO, Vec3::ONE, Quat::IDENTITY);
    refused(|a| a.nodes[1].transform = trs(Vec3::INFINITY, still, one), "nodes[1].transform.translation", "inf");
    refused(|a| a.nodes[1].transform = trs(zero, still * 2.0, one), "nodes[1].transform.rotation", "length 2");
    refused(|a| a.nodes[1].transform = trs(zero, Quat::NAN, one), "nodes[1].transform.rotation", "NaN");
    refused(|a| a.nodes[1].transform = trs(zero, still, Vec3::NAN), "nodes[1].transform.scale", "NaN");
    refused(|a| a.nodes[2].transform = Transform::Matrix(Mat4::NAN), "nodes[2].transform.matrix", "NaN");
}

/// Neither takes the stack nor the day.
#[test]
fn deep_chains_pass_and_their_cycles_do_not() {
    const DEEP: usize = 200_000;
    let node = |n: usize| Node { children: vec![n + 1], ..Node::default() };
    let mut asset = Asset { nodes: (0..DEEP).map(node).collect(), ..Asset::default() };
    asset.nodes.push(Node::default());
    asset.scenes = vec![AssetScene { name: None, roots: vec![0] }];
    check(&asset).unwrap();
    asset.nodes[DEEP].children = vec![0];
    assert!(check(&asset).unwrap_err().to_string().contains("own ancestor"));
}

#[test]
fn meshes() {
    fn vertices(a: &mut Asset) -> &mut Vertices {
        &mut a.meshes[0].primitives[0].vertices
    }
    fn first(a: &mut Asset) -> &mut Primitive {
        &mut a.meshes[0].primitives[0]
    }
    let at = |name: &str| format!("meshes[0].primitives[0].{name}");
    refused(|a| first(a).material = 5, &at("material"), "index 5");
    refused(|a| first(a).variant_materials[0].0 = 1, &at("variant_materials[0]"), "variants has 1");
    refused(|a| first(a).variant_materials[0].1 = 2, &at("variant_materials[0]"), "materials has 2");
    refused(|a| first(a).indices.clear(), &at("indices"), "0 entries");
    refused(|a| first(a).indices.push(0), &at("indices"), "4 entries");
    refused(|a| first(a).indices[2] = 3, &at("indices"), "entry 2 is 3");
    refused(|a| vertices(a).positions[1].x = f32::NAN, &at("vertices.positions"), "entry 1");
    refused(|a| vertices(a).normals.truncate(2), &at("vertices.normals"), "2 entries for 3");
    refused(|a| vertices(a).normals.clear(), &at("vertices.normals"), "triangles need one");
    refused(|a| vertices(a).normals[0] = Vec3::ZERO, &at("vertices.normals"), "length 0");
    refused(|a| vertices(a).tangents.truncate(1), &at("vertices.tangents"), "1 entries");
    refused(|a| vertices(a).tangents[0].x = f32::NAN, &at("vertices.tangents"), "NaN");
    refused(|a| vertices(a).tangents[2].w = 0.0, &at("vertices.tangents"), "entry 2 has w = 0");
    refused(|a| vertices(a).uv_sets.resize(3, Vec::new()), &at("vertices.uv_sets"), "3 sets");
    refused(|a| vertices(a).uv_sets[0].truncate(1), &at("vertices.uv_sets[0]"), "1 entries");
    refused(|a| vertices(a).uv_sets[0][1].y = f32::INFINITY, &at("vertices.uv_sets[0]"), "entry 1");
    refused(|a| vertices(a).colors.truncate(1), &at("vertices.colors"), "1 entries");
    refused(|a| vertices(a).colors[1].x = 1.5, &at("vertices.colors"), "1.5");
    let per_vertex = at("vertices.joints (influences_per_vertex)");
    refused(|a| vertices(a).influences_per_vertex = 3, &per_vertex, "is 3");
    refused(|a| vertices(a).influences_per_vertex = usize::MAX - 3, &at("vertices.joints"), "12 entries");
    refused(|a| vertices(a).joints.truncate(8), &at("vertices.joints"), "8 entries");
    refused(|a| vertices(a).influences_per_vertex = 0, &at("vertices.joints"), "12 entries");
    refused(|a| vertices(a).joints[5].0 = 2, &at("vertices.joints"), "vertex 1 uses joint 2");
    refused(|a| vertices(a).joints[0].1 = 0.5, &at("vertices.joints"), "sum to 0.75");
    refused(|a| vertices(a).joints[0].1 = f32::NAN, &at("vertices.joints"), "NaN");
    refused(|a| vertices(a).joints[0].1 = -1.0, &at("vertices.joints"), "-1");
    refused(|a| first(a).morph_targets.clear(), &at("morph_targets"), "0 entries");
    refused(|a| a.meshes[0].weights.push(0.0), "nodes[0].weights", "1 entries for 2");
    refused(|a| a.meshes[0].weights[0] = f32::NAN, "meshes[0].weights", "NaN");
    refused(|a| first(a).morph_targets[0].normals = vec![Vec3::X], &at("morph_targets[0].normals"), "1 entries");
    refused(|a| first(a).morph_targets[0].positions[0] = Vec3::NAN, &at("morph_targets[0].positions"), "NaN");
}

#[test]
fn materials_and_images() {
    fn texture(a: &mut Asset) -> &mut TextureRef {
        a.materials[0].base_color_texture.as_mut().unwrap()
    }
    refused(|a| a.textures[0].image = 1, "textures[0].image", "index 1");
    refused(|a| a.images[0].width = 2, "images[0].rgba", "4 bytes");
    refused(|a| a.images[0].width = u32::MAX, "images[0].rgba", "need");
    let wide = Image { name: String::new(), width: 40_000, height: 1, rgba: vec![0; 160_000] };
    refused(|a| a.images[0] = wide, "images[0]", "40000 x 1");
    refused(|a| a.images[0] = Image::default(), "materials[0].base_color_texture", "images[0] is empty");
    refused(|a| texture(a).texture = 4, "materials[0].base_color_texture.texture", "index 4");
    refused(|a| texture(a).uv_set = 2, "materials[0].base_color_texture.uv_set", "is 2");
    refused(|a| texture(a).offset.x = f32::NAN, "materials[0].base_color_texture.offset", "NaN");
    refused(|a| texture(a).rotation = f32::NAN, "materials[0].base_color_texture.rotation", "NaN");
    refused(|a| texture(a).scale.y = f32::INFINITY, "materials[0].base_color_texture.scale", "inf");
    refused(|a| a.materials[0].base_color.x = f32::NAN, "materials[0].base_color", "NaN");
    refused(|a| a.materials[0].metallic = 1.5, "materials[0].metallic", "[0, 1]");
    refused(|a| a.materials[0].roughness = -0.5, "materials[0].roughness", "-0.5");
    refused(|a| a.materials[0].normal_scale = f32::INFINITY, "materials[0].normal_scale", "inf");
    refused(|a| a.materials[0].occlusion_strength = 2.0, "materials[0].occlusion_strength", "is 2");
    refused(|a| a.materials[0].emissive.y = -1.0, "materials[0].emissive", ">= 0");
    let nan = AlphaMode::Mask(f32::NAN);
    refused(|a| a.materials[0].alpha_mode = nan, "materials[0].alpha_mode (cutoff)", "NaN");
    fn sheen(a: &mut Asset) -> &mut Sheen {
        a.materials[1].extensions.sheen.as_mut().unwrap()
    }
    refused(|a| sheen(a).color.z = 2.0, "materials[1].extensions.sheen.color", "is 2");
    refused(
        |a| sheen(a).color_texture.as_mut().unwrap().texture = 1,
        "materials[1].extensions.sheen.color_texture.texture",
        "index 1",
    );
    refused(|a| a.materials[1].extensions.ior = Some(0.5), "materials[1].extensions.ior", ">= 1");
}

#[test]
fn cameras_and_lights() {
    let eye = |vertical_fov, aspect, near_m, far_m| Projection::Perspective { vertical_fov, aspect, near_m, far_m };
    let at = |name: &str| format!("cameras[0].projection.{name}");
    refused(|a| a.cameras[0].projection = eye(4.0, None, 0.1, None), &at("vertical_fov"), "is 4");
    refused(|a| a.cameras[0].projection = eye(f32::NAN, None, 0.1, None), &at("vertical_fov"), "NaN");
    refused(|a| a.cameras[0].projection = eye(1.0, Some(0.0), 0.1, None), &at("aspect"), "is 0");
    refused(|a| a.cameras[0].projection = eye(1.0, None, 0.0, None), &at("near_m"), "is 0");
    refused(|a| a.cameras[0].projection = eye(1.0, None, 2.0, Some(1.0)), &at("far_m"), "is 1");
    let flat = |half_width_m, near_m| Projection::Orthographic { half_width_m, half_height_m: 1.0, near_m, far_m: 9.0 };
    refused(|a| a.cameras[0].projection = flat(0.0, 0.0), &at("half_width_m"), "is 0");
    refused(|a| a.cameras[0].projection = flat(1.0, -1.0), &at("near_m"), "is -1");
    refused(|a| a.lights[0].color.x = -1.0, "lights[0].color", "is -1");
    refused(|a| a.lights[0].intensity = f32::INFINITY, "lights[0].intensity", "inf");
    let spot = |range_m, inner_angle| LightKind::Spot { range_m, inner_angle, outer_angle: 0.2 };
    refused(|a| a.lights[0].kind = spot(Some(0.0), 0.1), "lights[0].kind.range_m", "is 0");
    refused(|a| a.lights[0].kind = spot(None, 0.2), "lights[0].kind", "inner_angle is 0.2");
}

#[test]
fn skins_and_animations() {
    refused(|a| a.skins[0].joints[1] = 3, "skins[0].joints[1]", "index 3");
    refused(|a| a.skins[0].inverse_bind.truncate(1), "skins[0].inverse_bind", "1 entries for 2");
    refused(|a| a.skins[0].inverse_bind[1] = Mat4::NAN, "skins[0].inverse_bind", "entry 1");
    refused(|a| a.skins.push(Skin::default()), "skins[1].joints", "0 entries");
    fn channel(a: &mut Asset, index: usize) -> &mut Channel {
        &mut a.animations[0].channels[index]
    }
    let at = |index: usize, name: &str| format!("animations[0].channels[{index}].{name}");
    refused(|a| a.animations[0].duration_s = 9.0, "animations[0].duration_s", "is 9; write 1");
    refused(|a| a.animations[0].duration_s = f32::NAN, "animations[0].duration_s", "NaN");
    refused(|a| channel(a, 0).node = 3, &at(0, "node"), "index 3");
    refused(|a| channel(a, 0).node = 2, &at(0, "node"), "matrix");
    refused(|a| channel(a, 0).times_s.clear(), &at(0, "times_s"), "0 entries");
    refused(|a| channel(a, 0).times_s[1] = 0.0, &at(0, "times_s"), "entry 1 is 0");
    refused(|a| channel(a, 0).times_s[1] = f32::NAN, &at(0, "times_s"), "NaN");
    refused(|a| channel(a, 0).interpolation = Interpolation::CubicSpline, &at(0, "values"), "need 3 each");
    refused(|a| channel(a, 0).values = Keys::Translation(vec![Vec3::NAN; 2]), &at(0, "values"), "NaN");
    refused(|a| channel(a, 1).values = Keys::Rotation(vec![Quat::IDENTITY * 3.0; 2]), &at(1, "values"), "length 3");
    refused(|a| channel(a, 2).values = Keys::Scale(vec![Vec3::ONE]), &at(2, "values"), "1 entries");
    let weights = |targets, count| Keys::Weights { targets, values: vec![0.0; count] };
    refused(|a| channel(a, 3).values = weights(2, 4), &at(3, "values.targets"), "is 2");
    refused(|a| channel(a, 3).values = weights(1, 3), &at(3, "values"), "3 entries");
}
