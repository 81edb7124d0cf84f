//! The plan is true: the device is asked for what it lists, call by call and byte by byte, and for nothing else; and once it
//! has what it needs, for no new object.

use crate::gbuffer::clip;
use crate::headless::headless;
use crate::plans::textured_quad;
use crate::scenes::{fur_cube, plain_cube};
use crate::skinning::bent_tube;
use crate::stage::{NEAREST, options};
use glam::{Mat4, Quat, Vec4};
use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::fmt::Write;
use vair::asset::procedural::GALLERY_CAMERA;
use vair::asset::{Keys, Sampler};
use vair::gpu::CallCounts;
use vair::material::{Fur, Length};
use vair::render::{
    Draw, DrawKind, Eye, FrameOptions, FrameReport, FrameSetup, Pass, Plan, Shadows, Staging, StreamPose, SurfaceUse,
};
use vair::scene::{CameraChoice, Scene};
use vair::shader::layout::{
    FrameUniforms, FurUniforms, LightSource, ObjectUniforms, ShadowSource, StandardUniforms, TransparencyEntries,
};

/// Four floats, as fallbacks are; two of them for absent streams.
const TEXEL_BYTES: u64 = 16;
const ABSENT_BYTES: u64 = 32;
/// Four half floats, as the picture of an environment has.
const HALF_TEXEL_BYTES: u64 = 8;
const MATRIX_BYTES: u64 = 64;
/// Descriptor sets of one layout that come together.
const SETS_PER_POOL: u64 = 16;

fn setup(scene: &Scene, frame: &FrameOptions) -> FrameSetup {
    FrameSetup::new(scene, frame).unwrap_or_else(|error| panic!("{error}"))
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

fn draws(plan: &Plan) -> impl Iterator<Item = &Draw> {
    plan.draws.values().flatten()
}

/// The same as often as they are recorded: what casts a shadow is in the map of every light that reaches it, and what lies
/// beside a view is not in it, unless everything is drawn.
fn recorded(setup: &FrameSetup) -> Vec<Draw> {
    let (staging, plan) = (&setup.staging, &setup.staging.plan);
    let shows = |clip_from_world: Mat4, draw: &Draw| {
        let sphere = staging.spheres[draw.part];
        let [x, y, w] = [0, 1, 3].map(|row| clip_from_world.row(row));
        let sides = [w + x, w - x, w + y, w - y];
        let distance = |side: Vec4| side.dot(sphere.center.extend(1.0)) / side.truncate().length();
        staging.options().everything || !sides.iter().any(|side| distance(*side) < -1.001 * sphere.radius)
    };
    let reached = |draw: &Draw, light: usize| staging.light_lists.of(draw.part).contains(&light);
    let times = |draw: &Draw| match plan.pipelines[draw.pipeline].eye {
        Eye::Camera => usize::from(shows(setup.camera.clip_from_world(), draw)),
        Eye::Light => {
            let maps = staging.shadow_maps.maps.iter();
            maps.filter(|map| reached(draw, map.light) && shows(map.clip_from_world, draw)).count()
        }
    };
    draws(plan).flat_map(|draw| std::iter::repeat_n(*draw, times(draw))).collect()
}

/// Bytes that a frame writes anew, all into one slice: values of views, lights, places, fur and poses.
fn frame_bytes(staging: &Staging) -> u64 {
    let plan = &staging.plan;
    let maps = staging.shadow_maps.maps.len();
    let is_lit = plan.pipelines.iter().any(|spec| spec.bindings().contains("LightList"));
    let lights = if is_lit { staging.light_lists.lights.len() } else { 0 };
    let sources = if plan.shadows.is_bound { maps } else { 0 };
    let shells: BTreeSet<(usize, u32)> = draws(plan)
        .filter_map(|draw| match draw.kind {
            DrawKind::Fur { layers, .. } => Some((draw.part, layers)),
            DrawKind::Surface(_) => None,
        })
        .collect();
    let bytes = staging.instances.len() * size_of::<ObjectUniforms>()
        + (1 + maps) * size_of::<FrameUniforms>()
        + lights * size_of::<LightSource>()
        + sources * size_of::<ShadowSource>()
        + shells.len() * size_of::<FurUniforms>();
    let posed: HashSet<(usize, StreamPose)> =
        plan.deforms.iter().map(|deform| (plan.parts[deform.part].instance, deform.pose)).collect();
    let instances = posed.iter().map(|(instance, _)| &staging.instances[*instance]);
    let poses = instances
        .map(|instance| instance.joints.len() as u64 * MATRIX_BYTES + instance.morph_weights.len() as u64 * 4)
        .sum::<u64>();
    bytes as u64 + poses
}

/// Surfaces, of which each has a uniform block, whatever pipelines draw it.
fn surfaces(plan: &Plan) -> BTreeSet<SurfaceUse> {
    let surface = |draw: &Draw| match draw.kind {
        DrawKind::Surface(surface) => Some(surface),
        DrawKind::Fur { .. } => None,
    };
    draws(plan).filter_map(surface).collect()
}

/// Joint indices and weights and morph offsets: buffers and bytes.
fn skinning_sources(scene: &Scene, staging: &Staging) -> (u64, u64) {
    let mut skinned = BTreeSet::new();
    let mut morphed = BTreeSet::new();
    let (mut buffers, mut bytes) = (0, 0);
    for deform in &staging.plan.deforms {
        let part = staging.plan.parts[deform.part];
        let primitive = &scene.asset().meshes[part.mesh].primitives[part.primitive];
        if staging.instances[part.instance].skin.is_some() && skinned.insert((part.mesh, part.primitive)) {
            buffers += 2;
            bytes += primitive.vertices.joints.len() as u64 * 8;
        }
        if !primitive.morph_targets.is_empty() && morphed.insert((part.mesh, part.primitive, deform.stream)) {
            buffers += 1;
            bytes += (primitive.vertices.positions.len() * primitive.morph_targets.len() * 12) as u64;
        }
    }
    (buffers, bytes)
}

/// Descriptor sets by what their layouts name.
fn groups(plan: &Plan, frame: &FrameOptions) -> BTreeMap<BTreeSet<&'static str>, u64> {
    let mut names: Vec<BTreeSet<&'static str>> = Vec::new();
    // View and lights, and places: one for all pipelines that name the same.
    for set in [0, 2] {
        let shared: BTreeSet<_> = plan.pipelines.iter().map(|spec| spec.bindings_of(set)).collect();
        names.extend(shared);
    }
    // A material and a pipeline each; of fur, however many shells.
    let material = |draw: &Draw| match draw.kind {
        DrawKind::Surface(surface) => (Some(surface), 0),
        DrawKind::Fur { material, .. } => (None, material),
    };
    let materials: BTreeSet<_> = draws(plan).map(|draw| (draw.pipeline, material(draw))).collect();
    names.extend(materials.iter().map(|(pipeline, _)| plan.pipelines[*pipeline].bindings_of(1)));
    // A dispatch each.
    let dispatches = plan.deforms.iter().map(|deform| deform.pipeline);
    for pipeline in dispatches.chain(plan.dynamics.iter().map(|dynamics| dynamics.pipeline)) {
        let shader = plan.compute_pipelines[pipeline].shader.shader();
        names.push(shader.bindings.iter().map(|binding| binding.name).collect());
    }
    // What draws over all pixels reads targets; lists are bound to be built and to be resolved.
    for spec in plan.full_screen(&frame.plan_options()) {
        names.extend([0, 3].map(|set| spec.bindings_of(set)).into_iter().filter(|names| !names.is_empty()));
    }
    names.extend(plan.pipelines.iter().find(|spec| spec.builds_lists()).map(|spec| spec.bindings_of(3)));
    let mut counts = BTreeMap::new();
    for names in names {
        *counts.entry(names).or_default() += 1;
    }
    counts
}

/// The first frame of a scene makes what the plan lists.
fn first_frame_is_planned(what: &str, scene: &Scene, frame: &FrameOptions, report: &FrameReport) {
    let setup = setup(scene, frame);
    let (staging, plan, asset) = (&setup.staging, &setup.staging.plan, scene.asset());
    let (source_buffers, source_bytes) = skinning_sources(scene, staging);
    let raster =
        plan.passes.iter().filter(|pass| !matches!(pass, Pass::Skinning | Pass::StrandDynamics)).count() as u64;
    // The environment as a picture to look at, which is uploaded by itself.
    let shows = frame.shows_environment();
    let skybox_bytes = if shows { frame.environment.map.texels.len() as u64 * HALF_TEXEL_BYTES } else { 0 };
    let sampled = plan.textures.len() + plan.fallbacks.len() + plan.tables.len();
    let images = sampled + plan.attachments.len() + plan.shadow_images().count() + 1 + usize::from(shows);
    let sides =
        plan.textures.iter().map(|texture| &asset.images[texture.image]).map(|image| image.width.max(image.height));
    let mipmapped = sides.clone().filter(|side| *side > 1).count();
    let levels: u64 = sides.map(|side| u64::from(side.ilog2()) + 1).sum();
    let streams: usize = plan.streams.values().map(BTreeSet::len).sum();
    let absent = u64::from(plan.has_absent_streams);
    let recorded = recorded(&setup);
    let inputs: usize = recorded.iter().map(|draw| plan.pipelines[draw.pipeline].inputs().len()).sum();
    let kept = streams as u64 + plan.streams.len() as u64 + absent + source_buffers;
    // What stands in is not filtered.
    let unfiltered = plan.fallbacks.iter().map(|_| NEAREST);
    let samplers: HashSet<Sampler> = plan.samplers.iter().copied().chain(unfiltered).collect();
    // Count, heads, entries, and where the count is read; the entries' header and a count of 0, which are uploaded by
    // themselves.
    let composes = u64::from(plan.passes.contains(&Pass::OitResolve));
    let header = composes * (size_of::<TransparencyEntries>() + size_of::<u32>()) as u64;
    // Fallbacks, tables and absent streams serve every scene: they, too, are uploaded by themselves.
    let has_defaults = !plan.fallbacks.is_empty() || !plan.tables.is_empty() || plan.has_absent_streams;
    let staged = 1 + composes + u64::from(has_defaults) + u64::from(shows);
    // Frame values, and the blocks of surfaces.
    let pools = 1 + u64::from(!surfaces(plan).is_empty());
    let moved = (plan.deforms.len() + plan.dynamics.len()) as u64;
    let over_pixels = plan.full_screen(&frame.plan_options()).len() as u64;
    let groups = groups(plan, frame);
    let descriptor_pools = groups.values().map(|count| count.div_ceil(SETS_PER_POOL)).sum();
    for (name, expected) in [
        ("vkCreateGraphicsPipelines", plan.pipelines.len() as u64 + over_pixels),
        ("vkCreateComputePipelines", plan.compute_pipelines.len() as u64),
        ("vkCreateImage", images as u64),
        // Level 0 has a view of its own where there are more.
        ("vkCreateImageView", (images + mipmapped) as u64),
        // What strands remember from frame to frame is a buffer each fur.
        ("vkCreateBuffer", kept + pools + moved + plan.dynamics.len() as u64 + staged + 4 * composes),
        ("vkCreateSampler", samplers.len() as u64 + u64::from(plan.shadows.is_bound) + u64::from(shows)),
        ("vkCreateDescriptorPool", descriptor_pools),
        ("vkAllocateDescriptorSets", descriptor_pools),
        ("vkUpdateDescriptorSets", groups.values().sum()),
        ("vkCmdCopyBuffer", kept + 3 * composes),
        ("vkCmdCopyBufferToImage", levels + (plan.fallbacks.len() + plan.tables.len()) as u64 + u64::from(shows)),
        ("vkCmdBeginRendering", raster),
        ("vkCmdDrawIndexed", recorded.len() as u64),
        ("vkCmdDraw", over_pixels),
        ("vkCmdDispatch", moved),
        ("vkCmdBindVertexBuffers2", inputs as u64),
        ("vkCmdBindIndexBuffer", recorded.len() as u64),
        // The frame, and what is uploaded by itself.
        ("vkQueueSubmit2", staged),
    ] {
        assert_eq!(report.calls.of(name), expected, "{what}: {name}");
    }
    assert_eq!(report.passes.first().map(|pass| pass.name.as_str()), Some("upload"), "{what}");
    let kept_bytes = plan.stream_bytes(asset)
        + plan.index_bytes(asset)
        + plan.textures.iter().map(|texture| texture.bytes(asset)).sum::<u64>()
        + plan.fallbacks.len() as u64 * TEXEL_BYTES
        + absent * ABSENT_BYTES
        + surfaces(plan).len() as u64 * size_of::<StandardUniforms>() as u64
        + source_bytes
        + skybox_bytes
        + header;
    assert_eq!(report.calls.uploaded_bytes, kept_bytes + frame_bytes(staging), "{what}: bytes");
    for (owner, bytes) in plan.memory(scene, frame) {
        let held = report.memory.by_owner.iter().find(|(name, _)| *name == owner).map_or(0, |(_, held)| *held);
        assert!(held >= bytes, "{what}: '{owner}' holds {held} bytes of {bytes}");
    }
}

/// What makes, frees or fills objects, whatever they are.
fn changes_objects(name: &str) -> bool {
    let changes =
        ["vkCreate", "vkDestroy", "vkAllocate", "vkFree", "vkBindBuffer", "vkBindImage", "vkUpdateDescriptor"];
    changes.iter().any(|start| name.starts_with(start))
}

/// Later frames of it write what changes every frame, into memory that is there.
fn later_frame_is_planned(what: &str, scene: &Scene, frame: &FrameOptions, report: &FrameReport) {
    let setup = setup(scene, frame);
    let (staging, calls) = (&setup.staging, &report.calls);
    let created: Vec<&String> = calls.by_name.keys().filter(|name| name.starts_with("vkCreate")).collect();
    assert!(created.is_empty(), "{what}, second frame: {created:?}");
    for (name, expected) in [
        ("vkCmdCopyBuffer", u64::from(staging.plan.passes.contains(&Pass::OitResolve))),
        ("vkCmdCopyBufferToImage", 0),
        ("vkAllocateDescriptorSets", 0),
        ("vkUpdateDescriptorSets", 0),
        ("vkCmdDrawIndexed", recorded(&setup).len() as u64),
        ("vkQueueSubmit2", 1),
    ] {
        assert_eq!(calls.of(name), expected, "{what}, second frame: {name}");
    }
    assert!(report.passes.iter().all(|pass| pass.name != "upload"), "{what}, second frame");
    assert_eq!(calls.uploaded_bytes, frame_bytes(staging), "{what}, second frame: bytes");
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
                device.renderer.prepare_environment(&frame).unwrap_or_else(|error| panic!("{error}"));
                let (_, first) = device.reported(&scene, &frame);
                first_frame_is_planned(&what, &scene, &frame, &first);
                let (_, second) = device.reported(&scene, &frame);
                later_frame_is_planned(&what, &scene, &frame, &second);
            });
        }
    }
}

/// A scene whose first mesh turns around the vertical.
fn turning(scene: Scene) -> Scene {
    let mut asset = scene.asset().clone();
    let node = asset.nodes.iter().position(|node| node.mesh.is_some()).unwrap();
    asset.animations = vec![clip(node, Keys::Rotation([0.0, 2.0].map(Quat::from_rotation_y).to_vec()))];
    let mut turned = Scene::from_asset(asset).unwrap();
    turned.materials_mut().clone_from_slice(scene.materials());
    turned
}

/// A skinned tube that bends, with fur whose strands lag behind.
fn bending() -> Scene {
    let mut asset = bent_tube(true).asset().clone();
    let joint = asset.skins[0].joints[1];
    asset.animations = vec![clip(joint, Keys::Rotation(vec![Quat::IDENTITY, Quat::from_rotation_z(0.8)]))];
    let mut scene = Scene::from_asset(asset).unwrap();
    let length = Length::Relative(0.1);
    scene.materials_mut()[0].fur = Some(Fur { length, layers: 8, inertia: 0.5, ..Fur::default() });
    scene
}

#[test]
fn a_frame_like_the_ones_before_makes_and_ends_no_object() {
    const FRAMES: usize = 6;
    let camera = CameraChoice::Named(GALLERY_CAMERA.to_owned());
    let gallery = FrameOptions { size: [64, 36], camera, ..FrameOptions::default() };
    let shadowed = |msaa| FrameOptions { shadows: Shadows::default(), ..options([64, 64], msaa) };
    for (what, scene, frame) in [
        ("plain cube", turning(plain_cube()), shadowed(4)),
        ("fur cube", turning(fur_cube()), shadowed(4)),
        ("skinned tube with fur", bending(), shadowed(1)),
        ("gallery", turning(Scene::gallery()), gallery),
    ] {
        headless(|device| {
            let gpu = device.renderer.gpu().clone();
            let mut before = None;
            let mut pictures = HashSet::new();
            for index in 0..FRAMES {
                let time_s = index as f32 / 24.0;
                let frame = FrameOptions { animation: Some(0), time_s, ..frame.clone() };
                let picture = device.renderer.render(&scene, &frame).unwrap_or_else(|error| panic!("{error}"));
                pictures.insert(picture.rgba);
                let (calls, blocks) = (gpu.calls(), gpu.memory().blocks);
                if let Some((earlier, had)) = before.replace((calls.clone(), blocks))
                    && index >= 2
                {
                    let added = calls.since(&earlier);
                    let changed: Vec<_> = added.by_name.iter().filter(|(name, _)| changes_objects(name)).collect();
                    assert!(changed.is_empty(), "{what}, frame {index}: {changed:?}");
                    assert_eq!(blocks, had, "{what}, frame {index}: blocks of memory");
                }
            }
            assert_eq!(pictures.len(), FRAMES, "{what}: something moves in every frame");
        });
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
            device.renderer.prepare_environment(&frame).unwrap_or_else(|error| panic!("{error}"));
            let frames = [device.reported(&scene, &frame).1, device.reported(&scene, &frame).1];
            let bytes: u64 = setup(&scene, &frame).staging.plan.memory(&scene, &frame).values().sum();
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
