//! `vair profile --families`.

use super::device::{DeviceArguments, check_validation};
use super::output;
use super::profile::spread;
use super::scene::SceneArguments;
use anyhow::Result;
use serde_json::{Value, json};
use std::path::Path;
use vair::asset::procedural::lit_quad;
use vair::asset::{LoadOptions, Material};
use vair::material::Look;
use vair::measure::profile::FamilyProfile;
use vair::scene::{CameraChoice, Scene};

pub fn run(scene: &SceneArguments, device: &DeviceArguments, rounds: u32, is_json: bool) -> Result<()> {
    let scenes = FamilyProfile::kinds().map(|kind| dressed(scene, kind)).collect::<Result<Vec<_>>>()?;
    let mut options = scene.frame_options(&scenes[0], false)?;
    if scene.is_embedded() {
        options.camera = CameraChoice::Index(0);
    }
    let profile = FamilyProfile::measure(&device.options(None), &scenes, &options, rounds)?;
    if is_json {
        output::print_json(&as_json(&profile, options.size, options.msaa))?;
    } else {
        output::print(&as_text(&profile, options.size, options.msaa))?;
    }
    check_validation(&profile.validation_messages)
}

/// Every surface of that family, by its defaults.
fn dressed(arguments: &SceneArguments, kind: &str) -> Result<Scene> {
    let quad = || {
        let material = Material { metallic: 0.0, ..Material::default() };
        Scene::from_asset(lit_quad(material)).unwrap_or_else(|error| unreachable!("the quad is ours: {error}"))
    };
    let mut scene = arguments.load_or(quad)?;
    let look = Look::parse(&format!("[material.\"*\"]\nkind = \"{kind}\"\n"), kind)?;
    scene.apply(&look, Path::new(""), &LoadOptions::default())?;
    Ok(scene)
}

fn as_json(profile: &FamilyProfile, [width, height]: [u32; 2], samples: u32) -> Value {
    let families = profile.families.iter().map(|family| {
        json!({
            "kind": family.kind, "surface_ms": spread(family.surface_ms), "to_standard": spread(family.to_standard),
        })
    });
    json!({
        "device": output::device(&profile.device),
        "image": { "width": width, "height": height, "samples": samples },
        "families": families.collect::<Vec<_>>(),
        "validation_messages": profile.validation_messages,
    })
}

fn as_text(profile: &FamilyProfile, [width, height]: [u32; 2], samples: u32) -> String {
    let mut text = format!("{}, {width}x{height}, samples a pixel: {samples}\n", profile.device.name);
    if profile.families.is_empty() {
        return text + "the device has no timestamps\n";
    }
    text += &format!("{:<12}{:>11}{:>11}{:>11}{:>13}\n", "family", "device ms", "min", "max", "to standard");
    for family in &profile.families {
        let (ms, ratio) = (family.surface_ms, family.to_standard.median);
        text += &format!("{:<12}{:>11.3}{:>11.3}{:>11.3}{ratio:>13.2}\n", family.kind, ms.median, ms.min, ms.max);
    }
    text + &format!("opaque and transparent pass, medians over {} rounds\n", profile.families[0].surface_ms.count)
}
