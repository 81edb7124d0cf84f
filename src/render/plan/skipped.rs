//! Skipped work: what a frame does without and why, which is everything that there is, less what the plan lists.

use super::{Blending, Plan, PlanInput, Staging, has_stream};
use crate::render::device_scene::Stream;
use crate::render::fur::fur_maps;
use crate::render::pass::{Pass, shadow_passes, ssao};
use crate::render::surface::{family_shader, surface_maps};
use crate::scene::Scene;
use crate::shader::{Defines, ShaderFile, ShaderKey, table};
use std::collections::{BTreeMap, BTreeSet};

/// Something that a frame could have and this one has not.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Skipped {
    /// What.
    pub what: String,
    /// Why.
    pub why: String,
}

/// All that the plan of `staging` does without, in the order of a frame.
pub(super) fn skipped(staging: &Staging, scene: &Scene) -> Vec<Skipped> {
    let (options, plan) = (staging.options(), &staging.plan);
    let input = &staging.input(scene, &options);
    let mut list = List::default();
    for pass in Pass::ALL {
        if let Err(why) = pass.wanted(plan, input) {
            list.add(format!("{} pass", pass.name()), why);
        }
    }
    if !plan.pipelines.iter().any(|spec| spec.fragment.file == ShaderFile::FurFrag) {
        list.add("fur pipeline", "no triangles have a material with fur");
    }
    if !plan.pipelines.iter().any(|spec| spec.variants.is_some() && spec.blending != Blending::Replace) {
        list.add("blending pipeline", "no material blends");
    }
    for (name, why) in Pass::ALL.iter().flat_map(|pass| pass.optional_attachments()) {
        if !plan.attachments.iter().any(|attachment| attachment.name == *name) {
            list.add(format!("attachment {name}"), *why);
        }
    }
    let without = staging.shadow_maps.without.len();
    if without > 0 {
        list.add(format!("shadows of {without} lights"), "the maps are taken, or it is a point light amid the scene");
    }
    list.bindings(input, plan);
    list.streams(input, plan);
    let used: BTreeSet<usize> = plan.textures.iter().map(|texture| texture.image).collect();
    let images = scene.asset().images.len();
    if images > used.len() {
        list.add(format!("{} of {images} images", images - used.len()), "no pipeline in use samples them");
    }
    if plan.textures.is_empty() && plan.fallbacks.is_empty() {
        list.add("textures and samplers", "no pipeline in use has a map");
    }
    list.0
}

#[derive(Default)]
struct List(Vec<Skipped>);

impl List {
    fn add(&mut self, what: impl Into<String>, why: impl Into<String>) {
        self.0.push(Skipped { what: what.into(), why: why.into() });
    }

    /// Descriptors that some permutation of the shaders in use has, and none of the permutations in use.
    fn bindings(&mut self, input: &PlanInput, plan: &Plan) {
        let specs = plan.pipelines.iter().flat_map(|spec| [spec.vertex, spec.fragment]);
        let used: Vec<ShaderKey> = specs.chain(plan.compute_pipelines.iter().map(|spec| spec.shader)).collect();
        let families: BTreeSet<&str> = used.iter().map(|key| key.file.stem()).collect();
        for name in families {
            let names = |keys: &mut dyn Iterator<Item = ShaderKey>| -> BTreeSet<(u32, u32, &str)> {
                let bindings = keys.filter(|key| key.file.stem() == name).flat_map(|key| key.shader().bindings);
                bindings.map(|binding| (binding.set, binding.binding, binding.name)).collect()
            };
            // No frame draws what counts, so that none can leave it out; and what no material is made of is missed by none.
            let is_used = |key: &ShaderKey| used.iter().any(|used| used.file == key.file);
            let is_drawn = |key: &ShaderKey| !key.defines.contains(Defines::COUNT) && is_used(key);
            let mut drawn = table::ALL.iter().map(|(key, _)| *key).filter(is_drawn);
            let (all, bound) = (names(&mut drawn), names(&mut used.iter().copied()));
            let mut by_reason: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
            // A map stands for its sampler, too.
            for (_, _, binding) in all.difference(&bound).filter(|(.., name)| !name.ends_with("_sampler")) {
                by_reason.entry(reason_of_binding(plan, input, name, binding)).or_default().push(binding);
            }
            for (why, bindings) in by_reason {
                self.add(format!("{name} bindings {}", bindings.join(", ")), why);
            }
        }
        // What other renderers bind to light a scene. It is left out as long as no shader in use declares it.
        for (what, word, why) in [
            ("shadow maps", "shadow", shadow_passes::why_no_shadows(plan, input)),
            ("look-up tables", "table", "nothing that is drawn is lit"),
            ("environment maps", "environment", "nothing that is drawn is lit"),
        ] {
            if !used.iter().flat_map(|key| key.shader().bindings).any(|binding| binding.name.contains(word)) {
                self.add(what, why);
            }
        }
    }

    /// Attributes that the file's meshes have and no pipeline that draws them reads.
    fn streams(&mut self, input: &PlanInput, plan: &Plan) {
        let scene = input.scene;
        for stream in [Stream::Normal, Stream::Tangent, Stream::Uv0, Stream::Uv1, Stream::Color] {
            let unread = plan.streams.iter().filter(|((mesh, primitive), read)| {
                has_stream(&scene.asset().meshes[*mesh].primitives[*primitive], stream) && !read.contains(&stream)
            });
            let (count, bytes) = unread.fold((0, 0), |(count, bytes), (index, _)| {
                (count + 1, bytes + plan.bytes_of_stream(scene.asset(), *index, stream))
            });
            if count > 0 {
                let what = format!("vertex stream {}: {bytes} bytes", format!("{stream:?}").to_lowercase());
                self.add(what, format!("no pipeline reads it of {count} of {} primitives", plan.streams.len()));
            }
        }
    }
}

fn reason_of_binding(plan: &Plan, input: &PlanInput, family: &str, binding: &str) -> &'static str {
    match (binding.strip_suffix("_map"), binding) {
        _ if binding == "screen_occlusion_map" => ssao::NOT_ASKED,
        _ if binding.starts_with("environment") || binding.starts_with("lobe") => "nothing that is drawn is lit",
        _ if binding.to_lowercase().starts_with("shadow") => match plan.lighting.shadows {
            true => "nothing that it draws lets light through in part",
            false => shadow_passes::why_no_shadows(plan, input),
        },
        (Some(stem), _) if has_map(plan, input.scene, family, stem) => {
            "the mesh has no coordinates for the map, or nothing lights it"
        }
        (Some(_), _) => "no material has such a map",
        (_, "TransparencyCount" | "TransparencyHeads" | "TransparencyEntries") => {
            "nothing that it draws blends, or what does is sorted by objects"
        }
        (_, "LightList") => "nothing that is drawn is lit",
        (_, "JointList" | "InfluenceList" | "InfluenceWeightList") => "nothing is skinned",
        (_, "MorphDeltas" | "MorphWeights") => "nothing is morphed",
        _ => "no permutation in use reads it",
    }
}

/// Whether a material in use names a texture for the map of a family of shaders.
fn has_map(plan: &Plan, scene: &Scene, family: &str, stem: &str) -> bool {
    plan.parts.iter().any(|part| {
        let material = &scene.materials()[part.material];
        let maps = match &material.fur {
            Some(fur) if family == "fur" => fur_maps(fur, &material.standard).to_vec(),
            fur => {
                let standard = scene.standard(part.material, fur.is_some());
                let family = scene.family(part.material, fur.is_some());
                surface_maps(&standard, family.map(family_shader).as_ref())
            }
        };
        maps.iter().any(|map| map.name == stem && map.texture.is_some())
    })
}
