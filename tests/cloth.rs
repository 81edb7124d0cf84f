//! Promise: every family of cloth takes its parameters from looks, refuses what does not fit with the line and the
//! nearest name, and says what it cannot show.

use vair::asset::{self, Asset, Image, procedural};
use vair::material::{Family, Form, KINDS, Look, Material, Parameter, from_asset};
use vair::{LoadOptions, Scene};

fn applied(text: &str) -> Result<Material, String> {
    let material = asset::Material { name: Some("Skirt".to_owned()), ..Default::default() };
    let mut asset = Asset { materials: vec![material], ..Asset::default() };
    let mut read = |name: &str| match name {
        "map.png" => Ok(Image { name: name.to_owned(), width: 1, height: 1, rgba: vec![255; 4] }),
        _ => Err(format!("no file `{name}`")),
    };
    let mut materials = from_asset(&mut asset, &mut read).map_err(|error| error.to_string())?;
    let look = Look::parse(text, "look.toml").map_err(|error| error.to_string())?;
    look.apply(&mut asset, &mut materials, &mut read).map_err(|error| error.to_string())?;
    Ok(materials.remove(0))
}

fn with_key(kind: &str, key: &str, value: &str) -> Result<Material, String> {
    applied(&format!("[material.Skirt]\nkind = \"{kind}\"\n\n{key} = {value}\n"))
}

/// The parameters of every family.
fn every_parameter() -> impl Iterator<Item = (&'static str, &'static Parameter)> {
    let families = KINDS.iter().filter(|(kind, _)| Family::KINDS.contains(kind));
    families.flat_map(|(kind, list)| list.iter().map(move |parameter| (*kind, parameter)))
}

#[test]
fn every_family_can_be_asked_for() {
    for kind in Family::KINDS {
        let material = applied(&format!("[material.Skirt]\nkind = \"{kind}\"\n")).unwrap();
        assert_eq!((material.kind(), material.family), (*kind, Family::of_kind(kind)));
    }
    let error = applied("[material.Skirt]\nkind = \"sattin\"\n").unwrap_err();
    assert!(error.starts_with("look.toml:2: ") && error.contains("did you mean `satin`?"), "{error}");
    assert_eq!(Family::of_kind("fur"), None, "fur is a coat");
}

#[test]
fn another_kind_starts_anew_and_the_same_kind_goes_on() {
    let text = |second: &str| {
        format!("[material.\"*\"]\nkind = \"satin\"\nanisotropy = -0.25\n[material.Skirt]\nkind = \"{second}\"\n")
    };
    let Some(Family::Satin(satin)) = applied(&text("satin")).unwrap().family else { panic!("satin") };
    assert_eq!(satin.anisotropy, -0.25);
    assert_eq!(applied(&text("standard")).unwrap().family, None);
    let fur = applied(&text("fur")).unwrap();
    assert!(fur.fur.is_some() && fur.family.is_none());
}

#[test]
fn defaults_are_in_range_and_every_key_has_one_line_of_help() {
    for kind in Family::KINDS {
        let cloth = Family::of_kind(kind).unwrap();
        let mut clamped = cloth.clone();
        clamped.clamp();
        assert_eq!(clamped, cloth, "{kind}: a default lies outside its range");
    }
    for (kind, Parameter { name, help, range, .. }) in every_parameter() {
        assert!(help.ends_with('.') && !help.contains('\n') && range.0 < range.1, "{kind}.{name}: {help}");
    }
}

#[test]
fn what_does_not_fit_is_refused_with_its_line() {
    let mut numbers = 0;
    for (kind, parameter) in every_parameter() {
        let name = parameter.name;
        let refused = |value: &str, named: &str| {
            let error = with_key(kind, name, value).expect_err(&format!("{kind}.{name} = {value}"));
            let is_clear = error.starts_with("look.toml:4: ") && error.contains(name) && error.contains(named);
            assert!(is_clear && !error.contains('\n'), "{kind}.{name} = {value}: {error}");
        };
        match parameter.form {
            Form::Number | Form::Count => {
                numbers += 1;
                let (least, most) = parameter.range;
                assert!(least.is_finite() && most.is_finite(), "{kind}.{name} needs a range");
                refused(&format!("{:?}", most + 1.0), "must lie in");
                refused(&format!("{:?}", least - 1.0), "must lie in");
                refused("nan", "");
                refused("\"much\"", "takes");
                with_key(kind, name, &format!("{most:?}")).unwrap();
                with_key(kind, name, &format!("{least:?}")).unwrap();
            }
            Form::Switch => refused("1", "true or false"),
            Form::Choice => refused("\"nothing\"", "one of"),
            Form::Map => {
                refused("\"missing.png\"", "no file `missing.png`");
                refused("{ file = \"map.png\", tilling = 2 }", "did you mean `tiling`?");
                with_key(kind, name, "{ file = \"map.png\", tiling = [2, 3] }").unwrap();
            }
            _ => refused("[0.5]", "takes"),
        }
    }
    assert!(numbers > 0, "nothing was checked");
}

#[test]
fn a_key_of_another_family_names_that_family() {
    let error = with_key("fur", "specular_noise", "\"map.png\"").unwrap_err();
    assert!(error.contains("is a key of") && error.contains("satin"), "{error}");
    let error = with_key("satin", "anisotropi", "1").unwrap_err();
    assert!(error.contains("did you mean `anisotropy`?"), "{error}");
}

#[test]
fn a_map_without_coordinates_and_a_grey_normal_map_are_warned_of() {
    let mut ball = procedural::swatch(false);
    for primitive in ball.meshes.iter_mut().flat_map(|mesh| &mut mesh.primitives) {
        primitive.vertices.uv_sets.clear();
        primitive.vertices.tangents.clear();
    }
    let look = "[material.swatch]\nkind = \"satin\"\nspecular_noise = { procedural = \"streaks\" }\n\
                normal_texture = { procedural = \"cloth_noise\" }\n";
    let mut scene = Scene::from_asset(ball).unwrap();
    scene.apply(&Look::parse(look, "look.toml").unwrap(), ".".as_ref(), &LoadOptions::default()).unwrap();
    let warnings = &scene.asset().warnings;
    let warned = |of: &[&str]| warnings.iter().filter(|text| of.iter().all(|part| text.contains(part))).count();
    assert_eq!(
        warned(&["no texture coordinates", "`normal_texture` (TEXCOORD_0), `specular_noise` (TEXCOORD_0)", "`swatch`"]),
        1,
        "{warnings:?}"
    );
    assert_eq!(warned(&["`normal_texture`", "grey image"]), 1, "{warnings:?}");
    // Threads have a direction all the same.
    let swatch =
        scene.asset().meshes.iter().flat_map(|mesh| &mesh.primitives).find(|primitive| primitive.material == 1);
    let vertices = &swatch.unwrap().vertices;
    assert_eq!(vertices.tangents.len(), vertices.positions.len());
    for (tangent, normal) in vertices.tangents.iter().zip(&vertices.normals) {
        assert!(tangent.is_finite() && tangent.truncate().dot(*normal).abs() < 1e-4, "{tangent} {normal}");
    }
}
