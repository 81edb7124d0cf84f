//! What a frame does without and why: everything that there is, less what the plan lists.

use super::cloth::cloth_shader;
use super::map::{fur_maps, surface_maps};
use super::occlusion::ScreenOcclusion;
use super::options::FrameOptions;
use super::pipeline::shader;
use super::plan::{Pass, Plan, has_stream};
use super::stream::Stream;
use super::targets::Attachment;
use crate::scene::Scene;
use crate::shader::{Shader, table};
use std::collections::{BTreeMap, BTreeSet};

/// Something that a frame could have and this one has not.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOut {
    /// What.
    pub what: String,
    /// Why.
    pub why: String,
}

/// All that `plan` does without, in the order of a frame.
pub fn left_out(plan: &Plan, scene: &Scene, options: &FrameOptions) -> Vec<LeftOut> {
    let mut list = List::default();
    for pass in Pass::ALL.into_iter().filter(|pass| !plan.passes.contains(pass)) {
        list.add(format!("{} pass", pass.name()), reason_of_pass(plan, pass, options));
    }
    if !plan.pipelines.iter().any(|spec| family(&spec.fragment) == "fur") {
        list.add("fur pipeline", "no triangles have a material with fur");
    }
    if !plan.pipelines.iter().any(|spec| spec.blend) {
        list.add("blending pipeline", "no material blends");
    }
    let screen_occlusion = Some(ScreenOcclusion::default());
    let most = Attachment::all(&FrameOptions { msaa: 4, screen_occlusion, ..options.clone() }, false);
    for left in most.iter().filter(|most| !plan.attachments.iter().any(|attachment| attachment.name == most.name)) {
        list.add(format!("attachment {}", left.name), reason_of_attachment(left.name));
    }
    if !plan.shadows.without.is_empty() {
        let lights = plan.shadows.without.len();
        list.add(format!("shadows of {lights} lights"), "the maps are taken, or it is a point light amid the scene");
    }
    list.bindings(plan, scene, options);
    list.streams(plan, scene);
    let used: BTreeSet<usize> = plan.textures.iter().map(|texture| texture.image).collect();
    let images = scene.asset().images.len();
    if images > used.len() {
        list.add(format!("{} of {images} images", images - used.len()), "no pipeline in use samples them");
    }
    if plan.textures.is_empty() && plan.stand_ins.is_empty() {
        list.add("textures and samplers", "no pipeline in use has a map");
    }
    list.0
}

fn reason_of_attachment(name: &str) -> &'static str {
    match name {
        "guide" | "guide depth" => "neither layers nor screen-space occlusion were asked for",
        "screen occlusion" | "screen occlusion slices" => "screen-space occlusion was not asked for",
        _ => "one sample a pixel was asked for",
    }
}

fn reason_of_pass(plan: &Plan, pass: Pass, options: &FrameOptions) -> &'static str {
    match pass {
        Pass::Deform => "nothing in the scene is skinned or morphed",
        Pass::Sway => "no animation moves a coat that has inertia",
        Pass::Guide => reason_of_attachment("guide"),
        Pass::ScreenOcclusion | Pass::ScreenOcclusionBlur => reason_of_attachment("screen occlusion"),
        Pass::Shadow | Pass::ShadowFront | Pass::ShadowBack | Pass::ShadowLayers => match () {
            () if plan.lit.shadows => "nothing lets light through in part",
            () => reason_of_no_shadows(plan, options),
        },
        Pass::Fur if plan.has_fur() => "every coat blends",
        Pass::Fur => "no triangles have a material with fur",
        Pass::Transparent => "no material blends",
        Pass::Transparency if plan.transparent.is_empty() => "no material blends",
        Pass::Transparency => "what blends is sorted by objects",
        Pass::Opaque | Pass::Tonemap => "not in this plan",
    }
}

fn reason_of_no_shadows(plan: &Plan, options: &FrameOptions) -> &'static str {
    match () {
        () if !options.shadows.are_cast => "shadows were not asked for",
        () if !plan.is_lit() => "nothing that is drawn is lit",
        () if plan.lights.lights.is_empty() => "no light reaches anything",
        () => "no light that reaches anything can have a map",
    }
}

/// `standard` of `standard.frag+UV`.
fn family(shader: &str) -> &str {
    shader.split('.').next().unwrap_or(shader)
}

/// `standard.frag` of `standard.frag+UV`.
fn file(shader: &str) -> &str {
    shader.split('+').next().unwrap_or(shader)
}

#[derive(Default)]
struct List(Vec<LeftOut>);

impl List {
    fn add(&mut self, what: impl Into<String>, why: impl Into<String>) {
        self.0.push(LeftOut { what: what.into(), why: why.into() });
    }

    /// Descriptors that some permutation of the shaders in use has, and none of the permutations in use.
    fn bindings(&mut self, plan: &Plan, scene: &Scene, options: &FrameOptions) {
        let specs = plan.pipelines.iter().flat_map(|spec| [&spec.vertex, &spec.fragment]);
        let used: Vec<&Shader> =
            specs.chain(plan.compute_pipelines.iter().map(|spec| &spec.shader)).map(|name| shader(name)).collect();
        let mut families: Vec<&str> = used.iter().map(|shader| family(shader.name)).collect();
        families.sort_unstable();
        families.dedup();
        for name in families {
            let names = |shaders: &mut dyn Iterator<Item = &Shader>| -> BTreeSet<(u32, u32, &str)> {
                let bindings = shaders.filter(|shader| family(shader.name) == name).flat_map(|shader| shader.bindings);
                bindings.map(|binding| (binding.set, binding.binding, binding.name)).collect()
            };
            // No frame draws what counts, so that none can leave it out; and what no material is made of is missed by none.
            let is_used = |shader: &Shader| used.iter().any(|used| file(used.name) == file(shader.name));
            let mut drawn =
                table::ALL.iter().copied().filter(|shader| !shader.name.contains("+COUNT") && is_used(shader));
            let (all, bound) = (names(&mut drawn), names(&mut used.iter().copied()));
            let mut by_reason: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
            // A map stands for its sampler, too.
            for (_, _, binding) in all.difference(&bound).filter(|(.., name)| !name.ends_with("_sampler")) {
                by_reason.entry(reason_of_binding(plan, scene, name, binding, options)).or_default().push(binding);
            }
            for (why, bindings) in by_reason {
                self.add(format!("{name} bindings {}", bindings.join(", ")), why);
            }
        }
        // What other renderers bind to light a scene. It is left out as long as no shader in use declares it.
        for (what, word, why) in [
            ("shadow maps", "shadow", reason_of_no_shadows(plan, options)),
            ("look-up tables", "table", "nothing that is drawn is lit"),
            ("environment maps", "environment", "nothing that is drawn is lit"),
        ] {
            if !used.iter().flat_map(|shader| shader.bindings).any(|binding| binding.name.contains(word)) {
                self.add(what, why);
            }
        }
    }

    /// Attributes that the file's meshes have and no pipeline that draws them reads.
    fn streams(&mut self, plan: &Plan, scene: &Scene) {
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

fn reason_of_binding(plan: &Plan, scene: &Scene, family: &str, binding: &str, options: &FrameOptions) -> &'static str {
    match (binding.strip_suffix("_map"), binding) {
        _ if binding == "screen_occlusion_map" => reason_of_attachment("screen occlusion"),
        _ if binding.starts_with("environment") || binding.starts_with("lobe") => "nothing that is drawn is lit",
        _ if binding.to_lowercase().starts_with("shadow") => match plan.lit.shadows {
            true => "nothing that it draws lets light through in part",
            false => reason_of_no_shadows(plan, options),
        },
        (Some(stem), _) if has_map(plan, scene, family, stem) => {
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
    plan.instances.iter().any(|instance| {
        let material = &scene.materials()[instance.material];
        let maps = match &material.fur {
            Some(fur) if family == "fur" => fur_maps(fur, &material.standard).to_vec(),
            coat => {
                let standard = scene.standard(instance.material, coat.is_some());
                let cloth = scene.cloth(instance.material, coat.is_some());
                surface_maps(&standard, cloth.map(cloth_shader).as_ref())
            }
        };
        maps.iter().any(|map| map.name == stem && map.texture.is_some())
    })
}
