//! Strands lag behind what they stand on and settle: the oscillator against its twin on the device, and coats that move.

use crate::glsl::compile;
use crate::headless::headless;
use crate::limit::all_hold;
use crate::stage::{Stage, at, options, plain};
use glam::{DVec3, Mat4, Vec3, Vec4};
use vair::asset::procedural::sphere;
use vair::asset::{Animation, Channel, Interpolation, Keys, Material, Node, Skin};
use vair::gpu::{Gpu, GpuOptions, Memory, Resource, vk};
use vair::material::{Fur, Length};
use vair::measure::twin::{hash, strand_dynamics};
use vair::render::{FrameOptions, FrameSetup, Pass, Picture};
use vair::scene::Scene;
use vair::shader::{Binding, BindingKind, Defines, Shader, ShaderFile, Stage as ShaderStage};

const GROUP: usize = 64;

/// `steps` steps of one strand; a word a number.
const MAIN: &str = "
layout(local_size_x = 64) in;
struct Strand { vec3 lag; float dt; vec3 velocity; float stiffness; vec3 moved; float damping; uint steps; uint a; uint b; uint c; };
layout(set = 0, binding = 0, std430) readonly buffer Given { Strand at[]; } given;
layout(set = 0, binding = 1, std430) buffer Found { vec4 at[]; } found;
void main() {
    Strand strand = given.at[gl_GlobalInvocationID.x];
    StrandState state = StrandState(strand.lag, strand.velocity);
    for (uint step = 0u; step < strand.steps; ++step) {
        state = sway_step(state, strand.moved, strand.dt, strand.stiffness, strand.damping);
    }
    found.at[gl_GlobalInvocationID.x * 2u] = vec4(state.lag, 0.0);
    found.at[gl_GlobalInvocationID.x * 2u + 1u] = vec4(state.velocity, 0.0);
}
";

#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Strand {
    lag: [f32; 3],
    dt: f32,
    velocity: [f32; 3],
    stiffness: f32,
    moved: [f32; 3],
    damping: f32,
    steps: u32,
    _padding: [u32; 3],
}

impl Strand {
    fn new(stiffness: f32, damping: f32, dt: f32) -> Self {
        let zero = [0.0; 3];
        Self { lag: zero, dt, velocity: zero, stiffness, moved: zero, damping, steps: 1, _padding: [0; 3] }
    }

    fn state(&self) -> strand_dynamics::State {
        strand_dynamics::State { lag: wide(self.lag), velocity: wide(self.velocity) }
    }

    fn stiffness(&self) -> f64 {
        f64::from(self.stiffness)
    }

    /// What the twin makes of it.
    fn expected(&self) -> strand_dynamics::State {
        let step =
            |at, _| strand_dynamics::step(at, wide(self.moved), self.dt.into(), self.stiffness(), self.damping.into());
        (0..self.steps).fold(self.state(), step)
    }

    /// Energy norm that the step works with: of the state, of the root's velocity, and of where it ends.
    fn scale(&self) -> f64 {
        let root = wide(self.moved).length() / f64::from(self.dt);
        self.state().energy_norm(self.stiffness()) + root + self.expected().energy_norm(self.stiffness())
    }

    /// Phase, at least one radian.
    fn radians(&self) -> f64 {
        (self.stiffness().sqrt() * f64::from(self.dt)).max(1.0) * f64::from(self.steps)
    }

    fn error(&self, found: strand_dynamics::State, expected: strand_dynamics::State) -> f64 {
        let difference =
            strand_dynamics::State { lag: found.lag - expected.lag, velocity: found.velocity - expected.velocity };
        difference.energy_norm(self.stiffness())
    }
}

fn wide(v: [f32; 3]) -> DVec3 {
    Vec3::from_array(v).as_dvec3()
}

/// Every strand's state on the device.
fn on_device(strands: &[Strand]) -> Vec<strand_dynamics::State> {
    let source = format!("#version 450\n{}\n{MAIN}", include_str!("../../shaders_glsl/lib/strand_dynamics.glsl"));
    let shader: &'static Shader = Box::leak(Box::new(Shader {
        name: "strand_dynamics.comp",
        stage: ShaderStage::Compute,
        spirv: compile("strand_dynamics.comp", ShaderStage::Compute, &source),
        spirv_hash: 0,
        bindings: &[
            Binding { set: 0, binding: 0, name: "given", kind: BindingKind::Storage { readonly: true } },
            Binding { set: 0, binding: 1, name: "found", kind: BindingKind::Storage { readonly: false } },
        ],
        push_constant_bytes: 0,
        constants: &[],
        inputs: &[],
        workgroup_size: [GROUP as u32, 1, 1],
    }));
    let gpu = Gpu::new(&GpuOptions { validate: true, ..GpuOptions::default() })
        .unwrap_or_else(|error| panic!("{error}; tools/setup installs what the tests need"));
    let mut filled = strands.to_vec();
    filled.resize(strands.len().next_multiple_of(GROUP), strands[0]);
    let storage = vk::BufferUsageFlags::STORAGE_BUFFER;
    let given = gpu.buffer("given", size_of_val(&filled[..]) as u64, storage, Memory::Upload).unwrap();
    given.write(0, &filled).unwrap();
    let found = gpu.buffer("found", (filled.len() * 32) as u64, storage, Memory::Device).unwrap();
    let back = gpu.buffer("back", found.bytes(), vk::BufferUsageFlags::empty(), Memory::Readback).unwrap();
    let pipeline = gpu.compute_pipeline("sway", shader, &[]).unwrap();
    let resources = [("given", Resource::Buffer(&given)), ("found", Resource::Buffer(&found))];
    let group = gpu.bind_group(&pipeline, 0, "sway", &resources).unwrap();
    let mut encoder = gpu.encoder("sway").unwrap();
    encoder.compute_pass("sway", &[], |pass| {
        pass.pipeline(&pipeline);
        pass.bind(0, &group);
        pass.dispatch([(filled.len() / GROUP) as u32, 1, 1]);
    });
    encoder.copy_buffer(&found, &back);
    encoder.submit().unwrap().wait(60_000).unwrap();
    let found = back.read::<[[f32; 4]; 2]>().unwrap();
    assert_eq!(gpu.validation_messages(), Vec::<String>::new());
    let state = |[lag, velocity]: [[f32; 4]; 2]| strand_dynamics::State {
        lag: Vec4::from_array(lag).truncate().as_dvec3(),
        velocity: Vec4::from_array(velocity).truncate().as_dvec3(),
    };
    found[..strands.len()].iter().copied().map(state).collect()
}

/// Strands over the whole domain: stiffness 1e-2 to 1e8, damping 0 to 1e4 and close to critical, steps of 1e-4 to 0.1 s;
/// a third of the roots stand still, a third of the tips start from rest.
fn strands(count: u32) -> Vec<Strand> {
    let strand = |index: u32| {
        let bits = |salt: u32| hash::pcg3d([index, salt, 4_711]).map(|bits| (bits >> 8) as f32 / (1 << 24) as f32);
        let [a, b, c] = bits(0);
        let spread = |low: f32, high: f32, share: f32| low * (high / low).powf(share);
        let damping = match index % 8 {
            0 => 0.0,
            1 => 1.0,
            2 => 1.0 - spread(6e-8, 1e-2, b),
            3 => 1.0 + spread(1.2e-7, 1e-2, b),
            4 | 5 => b,
            _ => spread(1e-2, 1e4, b),
        };
        let mut strand = Strand::new(spread(1e-2, 1e8, a), damping, spread(1e-4, 0.1, c));
        let vector = |salt: u32, size: f32| bits(salt).map(|share| (share - 0.5) * size);
        if !index.is_multiple_of(3) {
            // Lags from nothing to as much energy as the velocities.
            let [size, ..] = bits(3);
            (strand.lag, strand.velocity) = (vector(1, size / strand.stiffness.sqrt()), vector(2, 1.0));
        }
        if index % 3 != 1 {
            strand.moved = vector(4, strand.dt);
        }
        strand
    };
    (0..count).map(strand).collect()
}

#[test]
fn ode_exact() {
    let strands = strands(1 << 16);
    let mut worst = (0.0, 0);
    for (index, (strand, found)) in strands.iter().zip(on_device(&strands)).enumerate() {
        let error = strand.error(found, strand.expected()) / (strand.scale() * strand.radians());
        if error > worst.0 || error.is_nan() {
            worst = (error, index);
        }
    }
    eprintln!("largest error {:e} a radian: {:?}", worst.0, strands[worst.1]);
    assert!(worst.0 <= 1e-6, "{:e} a radian: {:?}", worst.0, strands[worst.1]);
}

#[test]
fn ode_semigroup() {
    let whole = strands(1 << 14);
    let halves: Vec<Strand> = whole
        .iter()
        .map(|strand| Strand { steps: 2, dt: 0.5 * strand.dt, moved: strand.moved.map(|m| 0.5 * m), ..*strand })
        .collect();
    let found = on_device(&whole).into_iter().zip(on_device(&halves));
    all_hold(whole.iter().zip(found).map(|(strand, (once, twice))| {
        let error = strand.error(once, twice) / (strand.scale() * strand.radians());
        if error <= 1e-6 { Ok(()) } else { Err(format!("{error:e} for {strand:?}")) }
    }));
}

#[test]
fn ode_energy() {
    let mut strands = strands(1 << 14);
    strands.iter_mut().for_each(|strand| strand.moved = [0.0; 3]);
    let found = on_device(&strands);
    all_hold(strands.iter().zip(found).map(|(strand, found)| {
        let (before, after) = (strand.state().energy_norm(strand.stiffness()), found.energy_norm(strand.stiffness()));
        if after <= before * (1.0 + 1e-6) { Ok(()) } else { Err(format!("{before} grows to {after}: {strand:?}")) }
    }));
}

#[test]
fn ode_equilibrium() {
    // Behind an even motion a tip trails by 2 zeta s / w; ten thousand steps let even the slowest of these settle.
    let trailing: Vec<Strand> = [(400.0, 0.25), (25.0, 1.0), (900.0, 3.0), (1e4, 1e-2), (1e8, 50.0)]
        .into_iter()
        .map(|(stiffness, damping)| Strand {
            moved: [0.01, -0.02, 0.005],
            steps: 10_000,
            ..Strand::new(stiffness, damping, 1.0 / 60.0)
        })
        .collect();
    all_hold(trailing.iter().zip(on_device(&trailing)).map(|(strand, found)| {
        let root_velocity = wide(strand.moved) / f64::from(strand.dt);
        let lag = -2.0 * f64::from(strand.damping) / strand.stiffness().sqrt() * root_velocity;
        let trailing = strand_dynamics::State { lag, velocity: root_velocity };
        let error = strand.error(found, trailing) / trailing.energy_norm(strand.stiffness());
        if error <= 1e-6 { Ok(()) } else { Err(format!("{error:e} for {strand:?}")) }
    }));
}

#[test]
fn without_damping_no_energy_is_lost_in_ten_thousand_steps() {
    let swinging: Vec<Strand> = [0.01, 1.0, 25.0, 400.0, 3000.0, 35_530.0, 1e5, 1e8]
        .into_iter()
        .flat_map(|stiffness: f32| {
            [1.0 / 240.0, 1.0 / 60.0, 1.0 / 24.0, 0.1].map(|dt| Strand {
                lag: [1.0 / stiffness.sqrt(), 0.0, 0.3 / stiffness.sqrt()],
                velocity: [0.0, 1.0, -0.2],
                steps: 10_000,
                ..Strand::new(stiffness, 0.0, dt)
            })
        })
        .collect();
    all_hold(swinging.iter().zip(on_device(&swinging)).map(|(strand, found)| {
        let ratio = found.energy_norm(strand.stiffness()) / strand.state().energy_norm(strand.stiffness());
        if (ratio - 1.0).abs() <= 1e-4 { Ok(()) } else { Err(format!("amplitude times {ratio}: {strand:?}")) }
    }));
}

#[test]
fn what_is_no_number_or_took_too_long_rests() {
    let wrong = |change: fn(&mut Strand)| {
        let mut strand = Strand { lag: [0.1; 3], ..Strand::new(400.0, 0.25, 0.02) };
        change(&mut strand);
        strand
    };
    let strands = [
        wrong(|strand| strand.lag[1] = f32::NAN),
        wrong(|strand| strand.lag[0] = f32::INFINITY),
        wrong(|strand| strand.velocity[2] = f32::NAN),
        wrong(|strand| strand.velocity[2] = f32::NEG_INFINITY),
        wrong(|strand| strand.moved[0] = f32::NAN),
        wrong(|strand| strand.moved[0] = f32::INFINITY),
        wrong(|strand| strand.dt = f32::NAN),
        wrong(|strand| strand.dt = 0.11),
        wrong(|strand| strand.dt = 0.0),
        wrong(|strand| strand.dt = -0.01),
        wrong(|strand| strand.damping = f32::NAN),
    ];
    assert!(on_device(&strands).iter().all(|state| *state == strand_dynamics::State::default()));
    let sound = wrong(|_| ());
    assert!(on_device(&[sound])[0].lag != DVec3::ZERO, "a sound one does not rest");
}

/// Moves to and fro along X, a metre in a third of a second, and stands still from 0.5 s on.
fn swing(node: usize) -> Animation {
    let times_s = vec![0.0, 1.0 / 3.0, 0.5, 2.0];
    let keys = [0.0, 0.3, 0.15, 0.15].map(|x| Vec3::new(x, 0.0, 0.0)).to_vec();
    let values = Keys::Translation(keys);
    Animation {
        name: None,
        duration_s: 2.0,
        channels: vec![Channel { node, times_s, interpolation: Interpolation::Linear, values }],
    }
}

fn coat() -> Fur {
    Fur {
        length: Length::Metres(0.12),
        strand_spacing: Length::Relative(0.07),
        layers: 12,
        inertia: 0.7,
        stiffness: 300.0,
        damping: 0.3,
        ..Fur::default()
    }
}

/// A ball on a swinging node, or on a swinging joint.
fn swinging_ball(on_joint: bool, fur: Fur) -> Scene {
    let mut stage = Stage::default();
    stage.parallel_camera(0.8, Vec3::new(0.0, 0.2, 1.0), Vec3::Y);
    crate::scenes::three_lights(&mut stage);
    let material = stage.material(Material { base_color: Vec4::new(0.5, 0.3, 0.2, 1.0), ..plain() });
    let mut ball = sphere(0.4, 8);
    let carrier = if on_joint {
        ball.vertices.influences_per_vertex = 4;
        ball.vertices.joints = [(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)].repeat(ball.vertices.positions.len());
        stage.asset.nodes.push(Node { transform: at(Vec3::ZERO), ..Node::default() });
        let joint = stage.asset.nodes.len() - 1;
        stage.asset.skins.push(Skin { joints: vec![joint], inverse_bind: vec![Mat4::IDENTITY] });
        let node = stage.object(ball, material, at(Vec3::ONE));
        stage.asset.nodes[node].skin = Some(0);
        joint
    } else {
        stage.object(ball, material, at(Vec3::ZERO))
    };
    stage.asset.animations.push(swing(carrier));
    let mut scene = stage.scene();
    scene.materials_mut()[material].fur = Some(fur);
    scene
}

fn moment(time_s: f32) -> FrameOptions {
    FrameOptions { animation: Some(0), time_s, ..options([128, 128], 1) }
}

const FPS: f32 = 60.0;

/// The twin's lag after so many frames; on a moving ball it is the same everywhere.
fn expected_force(fur: &Fur, frames: u32) -> DVec3 {
    let scene = swinging_ball(false, fur.clone());
    let Length::Metres(length_m) = fur.length else { panic!("metres") };
    let force_per_m = f64::from(fur.inertia / length_m);
    let place = |frame: u32| {
        let node = scene.asset().animations[0].channels[0].node;
        let pose = vair::scene::pose(scene.asset(), Some(0), frame as f32 / FPS);
        pose.world_from_node[node].w_axis.truncate().as_dvec3()
    };
    let mut state = strand_dynamics::State::default();
    for frame in 1..=frames {
        let moved = place(frame) - place(frame - 1);
        let dt = f64::from(frame as f32 / FPS - (frame - 1) as f32 / FPS);
        state = strand_dynamics::step(state, moved, dt, fur.stiffness.into(), fur.damping.into());
        state = strand_dynamics::limited(state, moved / dt, 1.0 / force_per_m);
    }
    force_per_m * state.lag
}

fn covered(picture: &Picture) -> usize {
    picture.radiance.iter().filter(|radiance| radiance.w > 0.0).count()
}

/// Pixels that are not the same but for what f32 leaves.
fn differing(a: &Picture, b: &Picture) -> usize {
    let differ = |(a, b): &(&Vec4, &Vec4)| (**a - **b).abs().max_element() > 0.02 * b.max_element() + 1e-4;
    a.radiance.iter().zip(&b.radiance).filter(differ).count()
}

#[test]
fn a_swinging_coat_looks_as_the_twin_bends_it() {
    headless(|device| {
        let mut told_from_rest = 0;
        for on_joint in [false, true] {
            let swinging = swinging_ball(on_joint, coat());
            for frame in 0..=45 {
                let found = device.picture(&swinging, &moment(frame as f32 / FPS));
                if ![6, 15, 24, 33, 45].contains(&frame) {
                    continue;
                }
                // The same ball with a constant force in place of its inertia.
                let own = coat();
                let sway = expected_force(&own, frame);
                let total = own.force.as_dvec3() * f64::from(own.force_strength) + sway;
                let (force, force_strength) = (total.normalize().as_vec3(), total.length().min(1.0) as f32);
                let bent = swinging_ball(on_joint, Fur { inertia: 0.0, force, force_strength, ..own.clone() });
                let unbent = swinging_ball(on_joint, Fur { inertia: 0.0, ..own });
                let expected = headless_picture(&bent, frame);
                let (differs, count) = (differing(&found, &expected), covered(&expected));
                assert!(count > 3000 && differs * 100 <= count, "frame {frame}: {differs} of {count} pixels differ");
                let told = differing(&found, &headless_picture(&unbent, frame));
                told_from_rest += usize::from(told * 20 > count);
            }
        }
        assert!(told_from_rest >= 4, "only {told_from_rest} of 10 pictures tell swaying from rest");
    });
}

fn headless_picture(scene: &Scene, frame: u32) -> Picture {
    let mut picture = None;
    headless(|device| picture = Some(device.picture(scene, &moment(frame as f32 / FPS))));
    picture.unwrap_or_else(|| panic!("a picture"))
}

#[test]
fn at_rest_a_coat_with_inertia_is_the_coat_without() {
    let (with, without) = (swinging_ball(false, coat()), swinging_ball(false, Fur { inertia: 0.0, ..coat() }));
    headless(|device| {
        // The first frame of a clip, a single one within it, and a picture without a clip.
        for options in [moment(0.0), moment(0.3), FrameOptions { animation: None, ..moment(0.0) }] {
            let [found, expected] = [&with, &without].map(|scene| device.picture(scene, &options));
            assert!(found.rgba == expected.rgba && found.radiance == expected.radiance);
        }
    });
}

#[test]
fn frames_follow_or_start_from_rest() {
    let scene = swinging_ball(false, coat());
    let time = |frame: u32| moment(frame as f32 / FPS);
    headless(|device| {
        let mut sequence = |times: &[f32], drawn: bool| {
            // Another scene in between: nothing is remembered.
            device.picture(&crate::scenes::plain_cube(), &options([16, 16], 1));
            for &time_s in times {
                if drawn {
                    device.picture(&scene, &moment(time_s));
                } else {
                    device.renderer.advance(&scene, &moment(time_s)).unwrap();
                }
            }
            device.picture(&scene, &time(20)).rgba
        };
        let times: Vec<f32> = (0..20).map(|frame| frame as f32 / FPS).collect();
        let (rest, drawn, advanced) = (sequence(&[], true), sequence(&times, true), sequence(&times, false));
        assert!(rest != drawn, "a coat that moves does not look as one at rest");
        assert!(drawn == advanced, "to advance is to draw without a picture");
        let again: Vec<f32> = times.iter().copied().chain([20.0 / FPS]).collect();
        assert!(sequence(&again, true) == drawn, "the same moment once more is the same picture");
        assert!(sequence(&[0.0, 0.1, 0.2], true) == rest, "a gap of more than 0.1 s starts from rest");
        assert!(sequence(&[0.5], true) == rest, "so does going back");
    });
}

#[test]
fn a_plan_holds_what_sways_and_nothing_else() {
    let sways = |fur: Fur, options: &FrameOptions| {
        let scene = swinging_ball(false, fur);
        let setup = FrameSetup::new(&scene, options).unwrap();
        let plan = &setup.staging.plan;
        let shaders =
            plan.pipelines.iter().filter(|spec| spec.vertex.defines.contains(Defines::STRAND_DYNAMICS)).count();
        let compute =
            plan.compute_pipelines.iter().filter(|spec| spec.shader.file == ShaderFile::StrandDynamicsComp).count();
        let left_out = setup.skipped(&scene).iter().any(|skipped| skipped.what == "strand dynamics pass");
        (plan.passes.contains(&Pass::StrandDynamics), plan.dynamics.len(), shaders, compute, left_out)
    };
    assert_eq!(sways(coat(), &moment(0.0)), (true, 1, 1, 1, false));
    let nothing = (false, 0, 0, 0, true);
    assert_eq!(sways(Fur { inertia: 0.0, ..coat() }, &moment(0.0)), nothing);
    assert_eq!(sways(coat(), &FrameOptions { animation: None, ..moment(0.0) }), nothing);
}
