//! The plan is true: the device is asked for what it lists, call by call and byte by byte, and for nothing else.

use crate::deform::bent_tube;
use crate::headless::headless;
use crate::plans::textured_quad;
use crate::scenes::{fur_cube, plain_cube};
use crate::stage::{NEAREST, options};
use std::collections::{BTreeSet, HashSet};
use std::fmt::Write;
use vair::asset::procedural::GALLERY_CAMERA;
use vair::asset::{Sampler, Topology};
use vair::gpu::CallCounts;
use vair::render::{Draw, DrawKind, FrameOptions, FrameReport, Pass, Plan, Shadows, Shot, Target};
use vair::scene::{CameraChoice, Scene};
use vair::shader::layout::{
    FrameUniforms, FurUniforms, LightSource, ObjectUniforms, ShadowSource, StandardUniforms, TransparencyEntries,
};

/// Four floats, as stand-ins are; two of them for absent streams.
const TEXEL_BYTES: u64 = 16;
const ABSENT_BYTES: u64 = 32;
const MATRIX_BYTES: u64 = 64;

fn plan(scene: &Scene, frame: &FrameOptions) -> Plan {
    Shot::new(scene, frame).unwrap_or_else(|error| panic!("{error}")).plan
}

fn scenes() -> Vec<(&'static str, Scene, FrameOptions)> {
    let camera = CameraChoice::Named(GALLERY_CAMERA.to_owned());
    let gallery = FrameOptions { size: [64, 36], camera, ..FrameOptions::default() };
    vec![
        ("plain cube", plain_cube(), options([64, 64], 4)),
        ("textured quad", textured_quad(), options([64, 64], 4)),
        ("fur cube", fur_cube(), options([64, 64], 4)),
        ("skinned tube", bent_tube(true), options([64, 64], 1)),
        ("morphed tube", bent_tube(false), options([64, 64], 1)),
        ("gallery", Scene::gallery(), gallery),
    ]
}

/// What a frame needs beside what its scene keeps: buffers and bytes.
struct PerFrame {
    buffers: u64,
    bytes: u64,
}

fn draws(plan: &Plan) -> Vec<Draw> {
    let casting: Vec<Draw> = plan.shadows.draws().copied().collect();
    [&plan.guide[..], &plan.opaque, &plan.fur, &plan.transparent, &casting].concat()
}

/// The same as often as they are recorded: what casts a shadow is in the map of every light that reaches it.
fn recorded(plan: &Plan) -> Vec<Draw> {
    let maps = |draw: &Draw| match plan.pipelines[draw.pipeline].target {
        Target::Color => 1,
        _ => plan.shadows.maps.iter().filter(|map| plan.lights.of(draw.instance).contains(&map.light)).count(),
    };
    draws(plan).into_iter().flat_map(|draw| std::iter::repeat_n(draw, maps(&draw))).collect()
}

fn coats(plan: &Plan) -> u64 {
    draws(plan).iter().filter(|draw| matches!(draw.kind, DrawKind::Fur { .. })).count() as u64
}

fn per_frame(scene: &Scene, shot: &Shot) -> PerFrame {
    let plan = &shot.plan;
    let is_lit = plan.pipelines.iter().any(|spec| spec.bindings().contains("LightList"));
    let mut sizes = vec![(plan.instances.len() * size_of::<ObjectUniforms>()) as u64];
    sizes.extend((0..=plan.shadows.maps.len()).map(|_| size_of::<FrameUniforms>() as u64));
    if is_lit {
        sizes.push((plan.lights.lights.len() * size_of::<LightSource>()) as u64);
    }
    if plan.shadows.is_bound {
        sizes.push((plan.shadows.maps.len() * size_of::<ShadowSource>()) as u64);
    }
    sizes.extend((0..coats(plan)).map(|_| size_of::<FurUniforms>() as u64));
    let skins: BTreeSet<usize> = plan.deforms.iter().filter_map(|d| plan.instances[d.instance].skin).collect();
    sizes.extend(skins.iter().map(|skin| scene.asset().skins[*skin].joints.len() as u64 * MATRIX_BYTES));
    let weights = plan.deforms.iter().map(|deform| plan.instances[deform.instance].morph_weights.len() as u64 * 4);
    sizes.extend(weights.filter(|bytes| *bytes > 0));
    // The deform and sway passes write their own.
    let moved = (plan.deforms.len() + plan.sways.len()) as u64;
    PerFrame { buffers: sizes.len() as u64 + moved, bytes: sizes.iter().sum() }
}

/// Uniform blocks of surfaces, one a material and pipeline.
fn surfaces(plan: &Plan) -> u64 {
    let surface = |draw: &Draw| match draw.kind {
        DrawKind::Surface(surface) => Some((surface.material, surface.under_fur, draw.pipeline)),
        DrawKind::Fur { .. } => None,
    };
    draws(plan).iter().filter_map(surface).collect::<BTreeSet<_>>().len() as u64
}

/// Joint indices and weights and morph offsets: buffers and bytes.
fn deform_sources(scene: &Scene, plan: &Plan) -> (u64, u64) {
    let mut skinned = BTreeSet::new();
    let (mut buffers, mut bytes) = (0, 0);
    for deform in &plan.deforms {
        let instance = &plan.instances[deform.instance];
        let primitive = &scene.asset().meshes[instance.mesh].primitives[instance.primitive];
        if instance.skin.is_some() && skinned.insert((instance.mesh, instance.primitive)) {
            buffers += 2;
            bytes += primitive.vertices.joints.len() as u64 * 8;
        }
        let vertices = primitive.vertices.positions.len();
        buffers += u64::from(!primitive.morph_targets.is_empty());
        bytes += (vertices * primitive.morph_targets.len() * 12) as u64;
    }
    (buffers, bytes)
}

/// Draw calls: what blends and has two sides is drawn side by side, if it is not listed.
fn draw_calls(scene: &Scene, plan: &Plan) -> u64 {
    let sides = |draw: &Draw| {
        let double_sided = match draw.kind {
            DrawKind::Surface(surface) => scene.materials()[surface.material].standard.double_sided,
            DrawKind::Fur { .. } => true,
        };
        let spec = &plan.pipelines[draw.pipeline];
        if double_sided && spec.blend && !spec.lists() && spec.topology == Topology::Triangles { 2 } else { 1 }
    };
    recorded(plan).iter().map(sides).sum()
}

/// The first frame of a scene makes what the plan lists.
fn first_frame_is_planned(what: &str, scene: &Scene, frame: &FrameOptions, report: &FrameReport) {
    let shot = Shot::new(scene, frame).unwrap_or_else(|error| panic!("{error}"));
    let (plan, asset) = (&shot.plan, scene.asset());
    let per_frame = per_frame(scene, &shot);
    let (source_buffers, source_bytes) = deform_sources(scene, plan);
    let raster = plan.passes.iter().filter(|pass| !matches!(pass, Pass::Deform | Pass::Sway)).count() as u64;
    let images = plan.textures.len() + plan.stand_ins.len() + plan.attachments.len() + plan.shadows.images().len() + 1;
    let mipmapped = plan.textures.iter().map(|texture| &asset.images[texture.image]);
    let mipmapped = mipmapped.filter(|image| image.width.max(image.height) > 1).count();
    let streams: usize = plan.streams.values().map(BTreeSet::len).sum();
    let absent = u64::from(plan.has_absent_streams);
    let inputs: usize = recorded(plan).iter().map(|draw| plan.pipelines[draw.pipeline].inputs().len()).sum();
    let kept = streams as u64 + plan.streams.len() as u64 + absent + surfaces(plan) + source_buffers;
    // What stands in is not filtered.
    let unfiltered = plan.stand_ins.iter().map(|_| NEAREST);
    let samplers: HashSet<Sampler> = plan.samplers.iter().copied().chain(unfiltered).collect();
    // Its pipeline; count, heads, entries, and where they are read; the entries' header and a count of 0, which are uploaded by themselves.
    let composes = u64::from(plan.composition.is_some());
    let staging = 1 + composes;
    let header = composes * (size_of::<TransparencyEntries>() + size_of::<u32>()) as u64;
    let occludes = |pass: &&Pass| matches!(pass, Pass::ScreenOcclusion | Pass::ScreenOcclusionBlur);
    // Draws over all pixels beside the tone mapping; their pipelines are not in the plan either.
    let over_pixels = composes + plan.passes.iter().filter(occludes).count() as u64;
    for (name, expected) in [
        // The tone mapping is always there, and never planned: it depends on the target.
        ("vkCreateGraphicsPipelines", plan.pipelines.len() as u64 + 1 + over_pixels),
        ("vkCreateComputePipelines", plan.compute_pipelines.len() as u64),
        ("vkCreateImage", images as u64),
        // Level 0 has a view of its own where there are more.
        ("vkCreateImageView", (images + mipmapped) as u64),
        // What strands remember from frame to frame is a buffer a coat.
        ("vkCreateBuffer", kept + per_frame.buffers + staging + plan.sways.len() as u64 + 4 * composes),
        ("vkCreateSampler", samplers.len() as u64 + u64::from(plan.shadows.is_bound)),
        ("vkCmdCopyBuffer", kept + 3 * composes),
        ("vkCmdBeginRendering", raster),
        ("vkCmdDrawIndexed", draw_calls(scene, plan)),
        ("vkCmdDraw", 1 + over_pixels),
        ("vkCmdDispatch", (plan.deforms.len() + plan.sways.len()) as u64),
        ("vkCmdBindVertexBuffers2", inputs as u64),
        ("vkCmdBindIndexBuffer", recorded(plan).len() as u64),
    ] {
        assert_eq!(report.calls.of(name), expected, "{what}: {name}");
    }
    let kept_bytes = plan.stream_bytes(asset)
        + plan.index_bytes(asset)
        + plan.textures.iter().map(|texture| texture.bytes(asset)).sum::<u64>()
        + plan.stand_ins.len() as u64 * TEXEL_BYTES
        + absent * ABSENT_BYTES
        + surfaces(plan) * size_of::<StandardUniforms>() as u64
        + source_bytes
        + header;
    assert_eq!(report.calls.uploaded_bytes, kept_bytes + per_frame.bytes, "{what}: bytes");
    for (owner, bytes) in plan.memory(scene, frame) {
        let held = report.memory.by_owner.iter().find(|(name, _)| *name == owner).map_or(0, |(_, held)| *held);
        assert!(held >= bytes, "{what}: '{owner}' holds {held} bytes of {bytes}");
    }
}

/// Later frames of it make only what changes every frame.
fn later_frame_is_planned(what: &str, scene: &Scene, frame: &FrameOptions, calls: &CallCounts) {
    let shot = Shot::new(scene, frame).unwrap_or_else(|error| panic!("{error}"));
    let per_frame = per_frame(scene, &shot);
    for (name, expected) in [
        ("vkCreateGraphicsPipelines", 0),
        ("vkCreateComputePipelines", 0),
        ("vkCreateImage", 0),
        ("vkCreateSampler", 0),
        ("vkCreateShaderModule", 0),
        ("vkCmdCopyBuffer", u64::from(shot.plan.composition.is_some())),
        ("vkCmdCopyBufferToImage", 0),
        ("vkCreateBuffer", per_frame.buffers),
        ("vkCmdDrawIndexed", draw_calls(scene, &shot.plan)),
        ("vkQueueSubmit2", 1),
    ] {
        assert_eq!(calls.of(name), expected, "{what}, second frame: {name}");
    }
    assert_eq!(calls.uploaded_bytes, per_frame.bytes, "{what}, second frame: bytes");
}

#[test]
fn the_device_is_asked_for_what_the_plan_lists() {
    for (what, scene, frame) in scenes() {
        for everything in [false, true] {
            let (what, frame) = (
                format!("{what}, everything {everything}"),
                FrameOptions { everything, shadows: Shadows::default(), ..frame.clone() },
            );
            headless(|device| {
                // An environment is made once, whatever scene it lights.
                device.renderer.prepare_surroundings(&frame).unwrap_or_else(|error| panic!("{error}"));
                let (_, first) = device.reported(&scene, &frame);
                first_frame_is_planned(&what, &scene, &frame, &first);
                let (_, second) = device.reported(&scene, &frame);
                later_frame_is_planned(&what, &scene, &frame, &second.calls);
            });
        }
    }
}

/// Calls of one frame but those that depend on what the device can time and count.
fn lines(text: &mut String, title: &str, left: &CallCounts, right: &CallCounts) {
    let _ = writeln!(text, "{title}: planned, everything, left out");
    let names: BTreeSet<&String> = left.by_name.keys().chain(right.by_name.keys()).collect();
    let timing = |name: &str| name.contains("Query") || name.contains("Timestamp");
    let (mut sums, counted) = ([0; 2], names.into_iter().filter(|name| !timing(name)));
    for name in counted {
        let [planned, all] = [left.of(name), right.of(name)];
        sums = [sums[0] + planned, sums[1] + all];
        let _ = writeln!(text, "  {name}: {planned}, {all}, {}", all as i64 - planned as i64);
    }
    let _ = writeln!(text, "  all calls: {}, {}, {}", sums[0], sums[1], sums[1] - sums[0]);
    let [planned, all] = [left.uploaded_bytes, right.uploaded_bytes];
    let _ = writeln!(text, "  uploaded bytes: {planned}, {all}, {}", all - planned);
}

#[test]
fn a_plain_cube_leaves_this_out() {
    let scene = plain_cube();
    let mut reports = Vec::new();
    for everything in [false, true] {
        headless(|device| {
            let frame = FrameOptions { everything, ..options([64, 64], 4) };
            device.renderer.prepare_surroundings(&frame).unwrap_or_else(|error| panic!("{error}"));
            let frames = [device.reported(&scene, &frame).1, device.reported(&scene, &frame).1];
            let bytes: u64 = plan(&scene, &frame).memory(&scene, &frame).values().sum();
            reports.push((frames, bytes));
        });
    }
    let [(planned, planned_bytes), (all, all_bytes)] = &reports[..] else { panic!("two ways") };
    let mut text = String::new();
    lines(&mut text, "first frame", &planned[0].calls, &all[0].calls);
    lines(&mut text, "second frame", &planned[1].calls, &all[1].calls);
    let _ = writeln!(text, "kept bytes: {planned_bytes}, {all_bytes}, {}", all_bytes - planned_bytes);
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!("calls-plain-cube", text));
}
