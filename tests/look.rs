//! Look files and presets: what they set, and that every mistake is named with its line and the nearest valid name.

use glam::{Vec2, Vec3};
use serde_json::json;
use vair::asset::{self, Asset, Image};
use vair::material::{Fur, Length, Look, Material, ParameterSet, Shape, Standard, from_asset, presets};

fn scene(names: &[&str]) -> (Asset, Vec<Material>) {
    let mut asset = Asset::default();
    for name in names {
        asset.materials.push(asset::Material { name: Some((*name).to_owned()), ..Default::default() });
    }
    let materials = from_asset(&mut asset, &mut no_images).unwrap();
    (asset, materials)
}

fn no_images(name: &str) -> Result<Image, String> {
    Err(format!("no file `{name}`"))
}

fn applied(text: &str, names: &[&str]) -> Result<(Asset, Vec<Material>), String> {
    let (mut asset, mut materials) = scene(names);
    let look = Look::parse(text, "look.toml").map_err(|error| error.to_string())?;
    let mut read = |name: &str| match name {
        "noise.png" => Ok(Image { name: name.to_owned(), width: 1, height: 1, rgba: vec![255; 4] }),
        _ => no_images(name),
    };
    look.apply(&mut asset, &mut materials, &mut read).map_err(|error| error.to_string())?;
    Ok((asset, materials))
}

fn error(text: &str) -> String {
    let error = applied(text, &["Fur Body", "Eyes"]).unwrap_err();
    assert!(!error.contains('\n'), "more than one line: {error}");
    error
}

#[test]
fn a_look_sets_what_it_says() {
    let text = r##"
        [material."Fur Body"]
        preset = "fox"
        kind = "fur"
        length = 0.03
        shape = "paraboloid"
        distribution_map = { file = "noise.png", tiling = [20.0, 10], offset = [0.5, 0], rotation = 90, uv_set = 1 }
        height_map = "noise.png"
        root_color = "#ff8000"
        comb = [0.5, -0.5]
        roughness = 0.4
        metallic = 0.25
        surface.roughness = 0.9
    "##;
    let (asset, materials) = applied(text, &["Fur Body", "Eyes"]).unwrap();
    let fur = materials[0].fur.as_ref().unwrap();
    assert_eq!(fur.length, Length::Metres(0.03));
    assert_eq!(fur.shape, Shape::Paraboloid);
    assert_eq!(fur.layers, 8, "from the preset");
    assert_eq!(fur.roughness, 0.4);
    assert_eq!(fur.comb, Vec2::new(0.5, -0.5));
    assert!((fur.root_color - Vec3::new(1.0, 0.215_860_5, 0.0)).abs().max_element() < 1e-6, "{}", fur.root_color);
    assert_eq!((materials[0].standard.metallic, materials[0].standard.roughness), (0.25, 0.9));
    let map = fur.distribution_map.unwrap();
    assert_eq!((map.scale, map.offset, map.uv_set), (Vec2::new(20.0, 10.0), Vec2::new(0.5, 0.0), 1));
    assert!((map.rotation - std::f32::consts::FRAC_PI_2).abs() < 1e-6);
    assert_eq!(fur.height_map.unwrap().texture, map.texture, "one file, one texture");
    assert_eq!((asset.images.len(), asset.textures.len()), (1, 1));
    assert!(materials[1].fur.is_none());
}

#[test]
fn the_star_comes_first_whatever_the_order() {
    let text = "[material.A]\nlength = 0.5\n[material.\"*\"]\nkind = \"fur\"\nlength = 0.1\n";
    let (_, materials) = applied(text, &["A", "B"]).unwrap();
    let length = |index: usize| materials[index].fur.as_ref().unwrap().length;
    assert_eq!((length(0), length(1)), (Length::Metres(0.5), Length::Metres(0.1)));
    let (_, materials) = applied(&format!("{text}[material.B]\nkind = \"standard\"\n"), &["A", "B"]).unwrap();
    assert!(materials[1].fur.is_none());
}

#[test]
fn mistakes_name_the_line_and_the_nearest_name() {
    let head = "[material.\"Fur Body\"]\nkind = \"fur\"\n";
    let cases = [
        ("lenght = 1", "look.toml:3: unknown key `lenght`, did you mean `length`?"),
        ("occlusion = 2", "look.toml:3: `occlusion` is 2, but must lie in 0 to 1"),
        ("occlusion = nan", "look.toml:3: `occlusion` is NaN, but must lie in 0 to 1"),
        ("length = inf", "look.toml:3: `length` is inf, but must lie in 0 to 1000000 m"),
        ("length = \"-2%\"", "look.toml:3: `length` is -0.02, but must lie in 0 to 1000000 m"),
        ("layers = 0", "look.toml:3: `layers` is 0, but must lie in 1 to 256"),
        ("layers = 2.5", "look.toml:3: `layers` is 2.5, but takes a whole number"),
        (
            "shape = \"conne\"",
            "look.toml:3: `shape` is \"conne\", but takes one of cone, paraboloid, did you mean `cone`?",
        ),
        ("comb = [1, 2]", "look.toml:3: `comb` is 2, but must lie in -1 to 1"),
        ("comb = [1]", "look.toml:3: `comb` is a list of 1, but takes [x, y]"),
        ("height_map = \"no.png\"", "look.toml:3: `height_map`: no file `no.png`"),
        (
            "height_map = { fil = \"a.png\" }",
            "look.toml:3: `height_map`: unknown texture key `fil`, did you mean `file`?",
        ),
        (
            "height_map = { procedural = \"lepard\" }",
            "look.toml:3: `height_map`: unknown procedural image `lepard`, did you mean `leopard`?",
        ),
        ("preset = \"rabit\"", "look.toml:3: unknown preset `rabit`, did you mean `rabbit`?"),
        ("surface.rougness = 1", "look.toml:3: unknown key `rougness`, did you mean `roughness`?"),
    ];
    for (line, expected) in cases {
        assert_eq!(error(&format!("{head}{line}\n")), expected);
    }
    assert_eq!(
        error("\n[material.\"Fur Bdy\"]\n"),
        "look.toml:2: the scene has no material `Fur Bdy`, did you mean `Fur Body`?"
    );
    assert_eq!(
        error("[material.Eyes]\nlength = 1\n"),
        "look.toml:2: `length` is a key of fur, and this material is standard: choose that kind or a preset of it"
    );
    assert_eq!(error("[materials.Eyes]\n"), "look.toml:1: unknown section `materials`, write [material.\"NAME\"]");
    assert!(error("[material.Eyes]\nmetallic = \n").starts_with("look.toml:2: "));
    assert!(error("[material.Eyes]\nkind = \"furr\"\n").contains("did you mean `fur`?"));
}

#[test]
fn every_preset_applies_and_stays_in_range() {
    let names: Vec<_> = presets().iter().map(|preset| preset.name.as_str()).collect();
    for expected in "mink fox leopard sheepskin rabbit grass jersey denim linen flannel felt velvet corduroy organza \
                     chiffon charmeuse taffeta brocade lurex sequin"
        .split_whitespace()
        .chain(["plush toy", "laser vinyl"])
    {
        assert!(names.contains(&expected), "{expected}");
    }
    for preset in presets() {
        let (mut asset, mut materials) = scene(&["A", "B"]);
        let look = Look::preset(&preset.name.replace(' ', "-"), Some("B")).unwrap();
        look.apply(&mut asset, &mut materials, &mut no_images).unwrap();
        assert!(materials[0].fur.is_none());
        assert!(materials[0].family.is_none() && preset.parameters().count() >= 4, "{}", preset.name);
        assert_eq!(materials[1].kind(), preset.kind(), "{}", preset.name);
        let mut clamped = materials[1].clone();
        clamped.standard.clamp();
        if let Some(cloth) = &mut clamped.family {
            cloth.clamp();
        }
        if let Some(fur) = &mut clamped.fur {
            assert!(matches!(fur.length, Length::Relative(share) if (0.01..=0.1).contains(&share)), "{}", preset.name);
            fur.clamp();
        }
        assert_eq!(materials[1], clamped, "{}", preset.name);
    }
    assert!(Look::preset("foxx", None).unwrap_err().to_string().contains("did you mean `fox`?"));
}

#[test]
fn a_file_may_carry_its_own_look() {
    let mut asset = Asset::default();
    let keys = |value: serde_json::Value| value.as_object().cloned();
    asset.materials.push(asset::Material {
        name: Some("Coat".to_owned()),
        vair: keys(
            json!({ "preset": "leopard", "length": "5%", "spot_color": [0, 0, 0.5], "surface": { "unlit": true } }),
        ),
        ..Default::default()
    });
    let materials = from_asset(&mut asset, &mut no_images).unwrap();
    let fur = materials[0].fur.as_ref().unwrap();
    assert_eq!((fur.length, fur.spot_color), (Length::Relative(0.05), Vec3::new(0.0, 0.0, 0.5)));
    assert!(materials[0].standard.unlit);
    assert_eq!(asset.textures[fur.spot_map.unwrap().texture].image, 0);
    assert_eq!(asset.images[0].width, 512);

    asset.materials[0].vair = keys(json!({ "kind": "fur", "layer": 3 }));
    let error = from_asset(&mut asset, &mut no_images).unwrap_err().to_string();
    assert_eq!(error, "material `Coat`: unknown key `layer`, did you mean `layers`?");
    asset.materials[0].vair = keys(json!({ "roughness": null }));
    let error = from_asset(&mut asset, &mut no_images).unwrap_err().to_string();
    assert_eq!(error, "material `Coat`: `roughness` is null, but takes a number");
}

#[test]
fn gltf_values_arrive() {
    let mut asset = Asset::default();
    asset.materials.push(asset::Material { alpha_mode: asset::AlphaMode::Mask(0.3), ..Default::default() });
    let materials = from_asset(&mut asset, &mut no_images).unwrap();
    assert_eq!(materials[0].name, "material 0");
    let standard = &materials[0].standard;
    assert_eq!((standard.metallic, standard.roughness, standard.alpha_cutoff), (1.0, 1.0, 0.3));
    assert_eq!(standard.alpha_mode, vair::material::AlphaMode::Mask);
}

#[test]
fn declarations_are_consistent() {
    fn check<F: ParameterSet + Clone + PartialEq + std::fmt::Debug>(family: &str) {
        let mut names = std::collections::HashSet::new();
        for parameter in F::PARAMETERS {
            assert!(names.insert(parameter.name), "{family}: {} twice", parameter.name);
            assert!(parameter.help.ends_with('.') && !parameter.kind.is_empty(), "{family}: {}", parameter.name);
            assert!(parameter.range.0 < parameter.range.1, "{family}: {}", parameter.name);
        }
        let mut clamped = F::default();
        clamped.clamp();
        assert_eq!(clamped, F::default(), "{family}: a default lies outside its range");
    }
    check::<Standard>("standard");
    check::<Fur>("fur");
    assert_eq!((Fur::parameter("length").unwrap().default)(), "\"4%\"");
    assert_eq!((Fur::parameter("strand_spacing").unwrap().default)(), "\"1%\"");
    let mut fur = Fur { occlusion: f32::NAN, layers: 9999, force: Vec3::splat(f32::INFINITY), ..Default::default() };
    fur.clamp();
    assert_eq!((fur.occlusion, fur.layers, fur.force), (0.7, 256, Vec3::NEG_Y));
}
