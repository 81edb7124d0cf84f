//! The shader library, on the device, gives what its twins give: over seeded numbers and over the extremes.
//!
//! Where a bound is wider than [`close`]'s, it follows from the operations: Vulkan's precision of `exp` (3 + 2 |x| units
//! in the last place), `log` (2^-21 near 1), `atan` (4096 units), and from what cancellation leaves of f32.

use crate::glsl::compile;
use crate::limit::all_hold;
use glam::{DVec2, DVec3, Vec2, Vec3};
use vair::gpu::{Gpu, GpuOptions, Memory, Resource, vk};
use vair::material::reference::{coverage, direction, hash, lock, strand, uv};
use vair::shader::{Binding, BindingKind, Shader, Stage};

const COUNT: u32 = 8192;
const IN_WORDS: usize = 48;
const OUT_WORDS: usize = 48;
const GROUP: u32 = 64;
/// One unit in the last place, relative.
const ULP: f64 = 1.0 / (1 << 23) as f64;

const LIBRARY: [&str; 7] = [
    include_str!("../../shaders_glsl/host/standard_material.glsl"),
    include_str!("../../shaders_glsl/lib/hash.glsl"),
    include_str!("../../shaders_glsl/lib/strand.glsl"),
    include_str!("../../shaders_glsl/lib/lock.glsl"),
    include_str!("../../shaders_glsl/lib/coverage.glsl"),
    include_str!("../../shaders_glsl/lib/direction.glsl"),
    include_str!("../../shaders_glsl/lib/uv.glsl"),
];

/// Words are read in the order of [`Case::words`] and written in the order of [`Found::new`].
const MAIN: &str = "
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer Given { uint at[]; } given;
layout(set = 0, binding = 1) buffer Found { uint at[]; } found;
uint in_at;
uint out_at;
uint word() { return given.at[in_at++]; }
float number() { return uintBitsToFloat(word()); }
vec2 pair() { float x = number(); return vec2(x, number()); }
vec3 triple() { vec2 xy = pair(); return vec3(xy, number()); }
void give(uint bits) { found.at[out_at++] = bits; }
void give(float x) { give(floatBitsToUint(x)); }
void give(vec2 v) { give(v.x); give(v.y); }
void give(vec3 v) { give(v.xy); give(v.z); }
void main() {
    in_at = gl_GlobalInvocationID.x * IN_WORDS;
    out_at = gl_GlobalInvocationID.x * OUT_WORDS;
    vec3 position = triple(); vec3 normal = triple(); vec3 tangent = triple(); vec3 to_eye = triple();
    vec3 to_light = triple(); vec3 force = triple(); vec3 vector = triple(); vec3 unit = triple();
    float share = number(); float profile = number(); float radius = number(); float slope = number();
    float angle = number(); float cosine = number(); float shift = number(); float roughness = number();
    float variance = number();
    uint x = word(); uint y = word(); ivec3 cell = ivec3(uvec3(x, y, word()));
    vec3 row_u = triple(); vec3 row_v = triple(); uint uv_set = word(); vec2 uv_0 = pair(); vec2 uv_1 = pair();
    TextureTransform transform = TextureTransform(row_u, uv_set, row_v, 0.0);

    StrandPath path;
    path.middle = position; path.normal = normal; path.radius = radius; path.entry = share < 0.5 ? 1.0 : -1.0;
    path.half_segment = 1.4 * unit.z * cross(normal, tangent);
    path.threshold = unit.x; path.threshold_rise = 0.3 * unit.y; path.enough = 0.25;
    StrandHit hit = strand_walk(path);
    give(hit.margin); give(hit.place); give(hit.random);
    give(strand_left(unit.x)); give(strand_cross_section(unit.x, radius)); give(strand_width(unit.x, radius));
    give(strand_slab_opacity(profile, unit.x, 4.0 * unit.y));
    give(strand_opacity(profile, slope, unit.y));
    give(strand_threshold(unit.x, unit.y, unit.z, false));
    give(strand_threshold(unit.x, unit.y, unit.z, true));
    give(strand_arc(unit.x, angle));
    give(strand_bend_angle(normal, force));
    give(strand_light_through_coat(unit.x, unit.y, cosine));
    give(strand_lobe(tangent, to_eye, to_light, shift, variance));
    give(strand_variance(roughness));
    give(strand_scattering(unit, normal, tangent, to_eye, to_light, share, variance));
    Lock lock = lock_at(position, normal);
    give(lock.from_middle); give(lock.random);
    give(lock_way_to_root(5.0 * tangent, share, normal, unit.x, unit.y, unit.z));
    give(uint(coverage_mask(unit.x, 1u, share, unit.z)));
    give(uint(coverage_mask(unit.x, 4u, share, unit.z)));
    give(hash_cell(cell));
    mat3 frame = direction_frame(normal);
    give(frame[0]); give(frame[1]);
    give(direction_or(vector, tangent));
    give(uv_transformed(transform, uv_0, uv_1));
    give(uv_gradient(transform, vec4(uv_0, uv_1)));
    give(uv_projected(position, normal));
}
";

/// One invocation's numbers.
struct Case {
    position: Vec3,
    normal: Vec3,
    tangent: Vec3,
    to_eye: Vec3,
    to_light: Vec3,
    /// At most of unit length.
    force: Vec3,
    /// Of any length.
    vector: Vec3,
    /// In [0, 1] each.
    unit: Vec3,
    /// In [0, 1).
    share: f32,
    profile: f32,
    radius: f32,
    slope: f32,
    angle: f32,
    cosine: f32,
    shift: f32,
    roughness: f32,
    variance: f32,
    cell: [i32; 3],
    offset: Vec2,
    rotation: f32,
    scale: Vec2,
    uv_set: u32,
    uv: [Vec2; 2],
}

/// Uniform numbers, now and then one of the extremes.
struct Random {
    index: u32,
    drawn: u32,
}

impl Random {
    fn bits(&mut self) -> [u32; 3] {
        self.drawn += 1;
        hash::pcg3d([self.index, self.drawn, 20_260])
    }

    fn between(&mut self, low: f32, high: f32, extremes: &[f32]) -> f32 {
        let [bits, choice, which] = self.bits();
        if choice.is_multiple_of(8) && !extremes.is_empty() {
            return extremes[which as usize % extremes.len()];
        }
        low + (high - low) * (bits >> 8) as f32 / (1 << 24) as f32
    }

    fn unit(&mut self) -> f32 {
        self.between(0.0, 1.0, &[0.0, 1.0, 0.5, 0.25, 1e-7, 1.0 - 6e-8])
    }

    fn direction(&mut self) -> Vec3 {
        let axes = [Vec3::X, Vec3::Y, Vec3::Z];
        let [axis, choice, sign] = self.bits();
        if choice.is_multiple_of(8) {
            return axes[axis as usize % 3] * if sign.is_multiple_of(2) { 1.0 } else { -1.0 };
        }
        let around = self.between(0.0, std::f32::consts::TAU, &[]);
        let z = self.between(-1.0, 1.0, &[1.0 - 1e-6, 1e-6 - 1.0, 1e-8, -1e-8]);
        let across = (1.0 - z * z).max(0.0).sqrt();
        Vec3::new(across * around.cos(), across * around.sin(), z).normalize()
    }
}

impl Case {
    fn new(index: u32) -> Self {
        let mut random = Random { index, drawn: 0 };
        let r = &mut random;
        let places = [0.0, -0.0, 0.5, -0.5, 1.0, -1.0, 31.0];
        let position = Vec3::from_array([0; 3].map(|_| r.between(-32.0, 32.0, &places)));
        let (normal, tangent, to_eye) = (r.direction(), r.direction(), r.direction());
        // Along and against what it is compared with, too.
        let to_light = match index % 16 {
            0 => to_eye,
            1 => -to_eye,
            2 => tangent,
            _ => r.direction(),
        };
        let strength = r.unit();
        let force = strength
            * match index % 16 {
                3 => normal,
                4 => -normal,
                _ => r.direction(),
            };
        Self {
            position,
            normal,
            tangent,
            to_eye,
            to_light,
            force,
            vector: r.direction() * r.between(0.1, 10.0, &[0.0, 1e-10, 1e-17, 1e12]),
            unit: Vec3::from_array([0; 3].map(|_| r.unit())),
            share: r.between(0.0, 1.0, &[0.0, 0.5]),
            profile: r.between(-2.0, 1.0, &[-1e3, 0.0, 0.5, 1.0]),
            radius: r.between(0.02, 0.5, &[0.5]),
            slope: r.between(0.0, 3.0, &[0.0, 1e-6, 0.75, 2.0, 1e3]),
            angle: r.between(0.0, 1.5, &[0.0, 1e-6, 1e-3, 2e-3, std::f32::consts::FRAC_PI_2]),
            cosine: r.between(-1.0, 1.0, &[0.05, 0.0, 1.0]),
            shift: r.between(-0.2, 0.2, &[0.0]),
            roughness: r.between(0.0, 1.2, &[0.0, 0.1, 1.0]),
            variance: r.between(0.0065, 4.0, &[0.0065]),
            cell: r.bits().map(|bits| match index % 8 {
                0 => [i32::MIN, i32::MAX, -1, 0][bits as usize % 4],
                1 => bits as i32,
                _ => bits as i32 % 1000,
            }),
            offset: Vec2::new(r.between(-2.0, 2.0, &[0.0]), r.between(-2.0, 2.0, &[0.0])),
            rotation: r.between(-7.0, 7.0, &[0.0]),
            scale: Vec2::new(r.between(-4.0, 4.0, &[1.0]), r.between(-4.0, 4.0, &[1.0, 0.0])),
            uv_set: index % 2,
            uv: [0, 1].map(|_| Vec2::new(r.between(-3.0, 3.0, &[0.0, 1.0]), r.between(-3.0, 3.0, &[0.0, 1.0]))),
        }
    }

    fn words(&self) -> [u32; IN_WORDS] {
        let (sine, cosine) = f64::from(self.rotation).sin_cos();
        let scale = self.scale.as_dvec2();
        let row = |x: f64, y: f64, offset: f32| Vec3::new((x * scale.x) as f32, (y * scale.y) as f32, offset);
        let rows = [row(cosine, sine, self.offset.x), row(-sine, cosine, self.offset.y)];
        let triples =
            [self.position, self.normal, self.tangent, self.to_eye, self.to_light, self.force, self.vector, self.unit];
        let numbers = [
            self.share,
            self.profile,
            self.radius,
            self.slope,
            self.angle,
            self.cosine,
            self.shift,
            self.roughness,
            self.variance,
        ];
        let bits = |vector: Vec3| vector.to_array().map(f32::to_bits);
        let mut words = [0; IN_WORDS];
        let given = triples
            .into_iter()
            .flat_map(bits)
            .chain(numbers.map(f32::to_bits))
            .chain(self.cell.map(|coordinate| coordinate as u32))
            .chain(rows.into_iter().flat_map(bits))
            .chain([self.uv_set])
            .chain(self.uv.into_iter().flat_map(|uv| uv.to_array().map(f32::to_bits)));
        words.iter_mut().zip(given).for_each(|(word, given)| *word = given);
        words
    }
}

/// The device's answers.
struct Found {
    hit: [f32; 3],
    left: [f32; 2],
    cross_section: f32,
    width: f32,
    slab_opacity: f32,
    opacity: f32,
    thresholds: [f32; 2],
    arc: [f32; 2],
    bend_angle: f32,
    light_through_coat: f32,
    lobe: f32,
    variance: f32,
    scattering: [f32; 3],
    lock: [f32; 4],
    way_to_root: [f32; 3],
    masks: [u32; 2],
    hash: [f32; 3],
    tangent: [f32; 3],
    bitangent: [f32; 3],
    direction: [f32; 3],
    transformed: [f32; 2],
    gradient: [f32; 2],
    projected: [f32; 2],
}

impl Found {
    fn new(words: &[u32]) -> Self {
        let mut words = words.iter().copied();
        let mut word = || words.next().unwrap();
        macro_rules! next {
            ($count:literal) => {
                [0; $count].map(|_| f32::from_bits(word()))
            };
            () => {
                f32::from_bits(word())
            };
        }
        Self {
            hit: next!(3),
            left: next!(2),
            cross_section: next!(),
            width: next!(),
            slab_opacity: next!(),
            opacity: next!(),
            thresholds: next!(2),
            arc: next!(2),
            bend_angle: next!(),
            light_through_coat: next!(),
            lobe: next!(),
            variance: next!(),
            scattering: next!(3),
            lock: next!(4),
            way_to_root: next!(3),
            masks: [0; 2].map(|_| word()),
            hash: next!(3),
            tangent: next!(3),
            bitangent: next!(3),
            direction: next!(3),
            transformed: next!(2),
            gradient: next!(2),
            projected: next!(2),
        }
    }
}

/// Runs every case in one dispatch.
fn on_device(cases: &[Case]) -> Vec<Found> {
    let head = format!("#version 450\n#define IN_WORDS {IN_WORDS}u\n#define OUT_WORDS {OUT_WORDS}u\n");
    let source = std::iter::once(head.as_str()).chain(LIBRARY).chain([MAIN]).collect::<Vec<_>>().join("\n");
    // All of the library is there already.
    let source = source.lines().filter(|line| !line.starts_with("#include")).collect::<Vec<_>>().join("\n");
    let shader = Shader {
        name: "parity.comp",
        stage: Stage::Compute,
        spirv: compile("parity.comp", Stage::Compute, &source),
        bindings: &[
            Binding { set: 0, binding: 0, name: "given", kind: BindingKind::Storage { readonly: true } },
            Binding { set: 0, binding: 1, name: "found", kind: BindingKind::Storage { readonly: false } },
        ],
        push_constant_bytes: 0,
        constants: &[],
        inputs: &[],
        workgroup_size: [GROUP, 1, 1],
    };
    let shader: &'static Shader = Box::leak(Box::new(shader));
    let gpu = Gpu::new(&GpuOptions { validate: true, ..GpuOptions::default() })
        .unwrap_or_else(|error| panic!("{error}; tools/setup installs what the tests need"));
    let words: Vec<u32> = cases.iter().flat_map(Case::words).collect();
    let bytes = (cases.len() * OUT_WORDS * 4) as u64;
    let storage = vk::BufferUsageFlags::STORAGE_BUFFER;
    let given = gpu.buffer("given", size_of_val(&words[..]) as u64, storage, Memory::Upload).unwrap();
    given.write(0, &words).unwrap();
    let found = gpu.buffer("found", bytes, storage, Memory::Device).unwrap();
    let back = gpu.buffer("back", bytes, vk::BufferUsageFlags::empty(), Memory::Readback).unwrap();
    let pipeline = gpu.compute_pipeline("parity", shader, &[]).unwrap();
    let resources = [("given", Resource::Buffer(&given)), ("found", Resource::Buffer(&found))];
    let group = gpu.bind_group(&pipeline, 0, "parity", &resources).unwrap();
    let mut encoder = gpu.encoder("parity").unwrap();
    encoder.compute_pass("parity", &[], |pass| {
        pass.pipeline(&pipeline);
        pass.bind(0, &group);
        pass.dispatch([cases.len() as u32 / GROUP, 1, 1]);
    });
    encoder.copy_buffer(&found, &back);
    encoder.submit().unwrap().wait(60_000).unwrap();
    let found = back.read::<u32>().unwrap().chunks_exact(OUT_WORDS).map(Found::new).collect();
    assert_eq!(gpu.validation_messages(), Vec::<String>::new());
    found
}

fn within(what: &str, found: f32, expected: f64, error: f64) -> Result<(), String> {
    let is_close = (f64::from(found) - expected).abs() <= error;
    if is_close { Ok(()) } else { Err(format!("{what}: {found} is farther than {error:.1e} from {expected}")) }
}

/// Within 1e-6 and 2e-5 of the number.
fn close(what: &str, found: f32, expected: f64) -> Result<(), String> {
    within(what, found, expected, 1e-6 + 2e-5 * expected.abs())
}

fn all_close<const N: usize>(what: &str, found: [f32; N], expected: [f64; N]) -> Result<(), String> {
    found.into_iter().zip(expected).try_for_each(|(found, expected)| close(what, found, expected))
}

/// Error of sqrt(x) for an error of x: the tangent's, but where x is nearly nothing.
fn sqrt_error(x: f64, error: f64) -> f64 {
    error.sqrt().min(error / x.max(1e-30).sqrt())
}

/// Error that f32 leaves in [`strand::lobe`]: of exp, whose argument's own error counts as often as it is large; and of
/// the half angle's cosine, which cancels where the eye looks into the light.
fn lobe_error(tangent: DVec3, to_eye: DVec3, to_light: DVec3, shift: f64, variance: f64) -> f64 {
    let (sine_eye, sine_light) = (tangent.dot(to_eye), tangent.dot(to_light));
    let deviation = sine_eye + sine_light - shift;
    let exponent = 0.5 * deviation * deviation / variance;
    let relative = (3.0 + 10.0 * exponent) * ULP + deviation.abs() * 3.0 * ULP / variance;
    let (eye, light) = (to_eye - sine_eye * tangent, to_light - sine_light * tangent);
    let shortest = eye.length().min(light.length());
    let cosine = if shortest > 1e-6 { eye.dot(light) / (eye.length() * light.length()) } else { 1.0 };
    let along = (-exponent).exp() / (std::f64::consts::TAU * variance).sqrt();
    let azimuth = sqrt_error(0.5 + 0.5 * cosine, 4.0 * ULP + 2.0 * ULP / shortest.max(1e-6));
    along * 0.25 * (relative + azimuth) + 1e-6
}

#[test]
fn words_are_where_the_shader_reads_them() {
    let case = Case::new(7);
    let words = case.words();
    assert_eq!(words[33..36], case.cell.map(|coordinate| coordinate as u32), "after 8 triples and 9 numbers");
    assert_eq!(words[46], case.uv[1].y.to_bits(), "the last word but one");
}

#[test]
fn the_library_on_the_device_agrees_with_its_twins() {
    let cases: Vec<Case> = (0..COUNT).map(Case::new).collect();
    let found = on_device(&cases);
    assert_eq!(found.len(), cases.len());
    all_hold(cases.iter().zip(&found).flat_map(|(case, found)| {
        [strands(case, found), light(case, found), masks(case, found), places(case, found)].concat()
    }));
}

fn strands(case: &Case, found: &Found) -> Vec<Result<(), String>> {
    let [x, y, z] = case.unit.as_dvec3().to_array();
    let (radius, angle) = (f64::from(case.radius), f64::from(case.angle));
    let (normal, force) = (case.normal.as_dvec3(), case.force.as_dvec3());
    let opacity = strand::opacity(case.profile.into(), case.slope.into(), y);
    let bend = strand::bend_angle(normal, force);
    vec![
        all_close("left of a strand", found.left, strand::left(x)),
        close("cross-section", found.cross_section, strand::cross_section(x, radius)),
        close("width", found.width, strand::width(x, radius)),
        close("opacity of a slab", found.slab_opacity, strand::slab_opacity(case.profile.into(), x, 4.0 * y)),
        close("opacity", found.opacity, opacity),
        close("threshold of a cone", found.thresholds[0], strand::threshold(x, y, z, false)),
        close("threshold of a paraboloid", found.thresholds[1], strand::threshold(x, y, z, true)),
        all_close("arc", found.arc, strand::arc(x, angle)),
        within("bend angle", found.bend_angle, bend, 1e-6 + 4096.0 * ULP * bend),
        close("variance", found.variance, strand::variance(case.roughness.into())),
    ]
}

fn light(case: &Case, found: &Found) -> Vec<Result<(), String>> {
    let [x, y, _] = case.unit.as_dvec3().to_array();
    let (normal, tangent) = (case.normal.as_dvec3(), case.tangent.as_dvec3());
    let (to_eye, to_light) = (case.to_eye.as_dvec3(), case.to_light.as_dvec3());
    let (shift, variance, specular) = (f64::from(case.shift), f64::from(case.variance), f64::from(case.share));
    let through = strand::light_through_coat(x, y, case.cosine.into());
    // log is good to 2^-21 near 1, and slanted light multiplies what it gives by up to 20.
    let through_error = through
        * ((1.0 - x) / f64::from(case.cosine).max(0.05) / f64::from(1 << 21)
            + (3.0 + 10.0 * through.max(1e-300).ln().abs()) * ULP);
    let lobe = strand::lobe(tangent, to_eye, to_light, shift, variance);
    let mut checks = vec![
        within("light through the coat", found.light_through_coat, through, 1e-30 + through_error),
        within("lobe", found.lobe, lobe, lobe_error(tangent, to_eye, to_light, shift, variance)),
    ];
    let sine_light = tangent.dot(to_light);
    let across_error = 0.35 * sqrt_error((1.0 - sine_light * sine_light).max(0.0), 4.0 * ULP);
    let white_error = 0.1 * lobe_error(tangent, to_eye, to_light, -0.08, variance);
    let colored_error = 0.3 * lobe_error(tangent, to_eye, to_light, 0.12, 4.0 * variance);
    for (channel, found) in found.scattering.into_iter().enumerate() {
        let color = f64::from(case.unit[channel]);
        let expected = strand::scattering(color, normal, tangent, to_eye, to_light, specular, variance);
        let error = 1e-6 + 2e-5 * expected + color * across_error + white_error + colored_error;
        checks.push(within("scattering", found, expected, error));
    }
    checks
}

fn masks(case: &Case, found: &Found) -> Vec<Result<(), String>> {
    let (opacity, threshold, order) = (f64::from(case.unit.x), f64::from(case.share), f64::from(case.unit.z));
    let sum = opacity * 4.0 + threshold;
    // Where f32 holds the sum, only one count is right; else the sum may have been rounded up.
    let slack = if f64::from(sum as f32) == sum { 0.0 } else { 4.0 * ULP };
    let four = [0.0, slack].map(|slack| coverage::mask(coverage::count(opacity, 4, threshold + slack), order));
    let one = coverage::count(opacity, 1, threshold);
    let check = |is_right, what: &str| {
        if is_right { Ok(()) } else { Err(format!("{what} of {opacity}, {threshold}, {order}: {:?}", found.masks)) }
    };
    let hash = hash::cell(case.cell);
    vec![
        check(found.masks[0] == one, "one sample"),
        check(four.contains(&found.masks[1]), "four samples"),
        check(found.hash.map(f64::from) == hash, &format!("hash of {:?}", case.cell)),
    ]
}

fn places(case: &Case, found: &Found) -> Vec<Result<(), String>> {
    let (position, normal) = (case.position.as_dvec3(), case.normal.as_dvec3());
    let [tangent, bitangent] = direction::frame(normal);
    let chosen = case.uv[case.uv_set as usize].as_dvec2();
    let (offset, scale, rotation) = (case.offset.as_dvec2(), case.scale.as_dvec2(), f64::from(case.rotation));
    let transformed = uv::transformed(chosen, offset, rotation, scale);
    let gradient = uv::gradient(chosen, rotation, scale);
    // Three terms, each as large as 12 and rounded twice, may cancel.
    let error = 1e-6 + 6.0 * ULP * (offset.abs().max_element() + (chosen * scale).abs().element_sum());
    let both =
        |what, found: [f32; 2], expected: DVec2| (0..2).try_for_each(|i| within(what, found[i], expected[i], error));
    vec![
        all_close("tangent", found.tangent, tangent.to_array()),
        all_close("bitangent", found.bitangent, bitangent.to_array()),
        all_close(
            "direction",
            found.direction,
            direction::or(case.vector.as_dvec3(), case.tangent.as_dvec3()).to_array(),
        ),
        both("transformed uv", found.transformed, transformed),
        both("uv gradient", found.gradient, gradient),
        all_close("projected uv", found.projected, uv::projected(position, normal).to_array()),
    ]
}

/// Fails where more than `share` of the cases do.
#[track_caller]
fn mostly(share: f64, checks: Vec<Result<(), String>>) {
    let count = checks.len();
    let wrong: Vec<String> = checks.into_iter().filter_map(Result::err).collect();
    let few = wrong.iter().take(20).cloned().collect::<Vec<_>>().join("\n");
    assert!(wrong.len() as f64 <= share * count as f64, "{} of {count} differ:\n{few}", wrong.len());
}

/// What a strand's place on the path, and its margin, may be off: offsets keep 2^-18 of a cell this far from the origin,
/// and profiles measure them in radii.
fn walk_error(radius: f32) -> f64 {
    1e-4f64.max(4.0 / f64::from(1 << 18) / f64::from(radius))
}

#[test]
fn walks_meet_the_strands_that_all_cells_hold() {
    let cases: Vec<Case> = (0..COUNT).map(Case::new).collect();
    let found = on_device(&cases);
    let mut met = 0;
    let walk = |(case, found): (&Case, &Found)| {
        let (normal, tangent) = (case.normal.as_dvec3(), case.tangent.as_dvec3());
        let [x, y, z] = case.unit.as_dvec3().to_array();
        let hit = strand::walk(&strand::Path {
            middle: case.position.as_dvec3(),
            threshold: x,
            half_segment: 1.4 * z * normal.cross(tangent),
            threshold_rise: 0.3 * y,
            normal,
            radius: case.radius.into(),
            entry: if case.share < 0.5 { 1.0 } else { -1.0 },
            enough: 0.25,
        });
        let error = walk_error(case.radius);
        within("margin", found.hit[0].max(-0.1), hit.margin.max(-0.1), error)?;
        // Of strands that hold the entry together, either is right.
        if hit.margin < 0.01 || hit.place.abs() == 1.0 {
            return Ok(());
        }
        met += 1;
        // Where a strand is touched along its side, the place of the touch is the square root of that error.
        within("place", found.hit[1], hit.place, 0.02)?;
        within("random number of a strand", found.hit[2], hit.random, 1e-4)
    };
    // Where two strands are entered at almost the same place, or the first is hardly touched, either is right, too.
    mostly(3e-3, cases.iter().zip(&found).map(walk).collect());
    assert!(met * 10 > cases.len(), "only {met} paths meet strands");
    let lock = |(case, found): (&Case, &Found)| {
        let (position, normal) = (case.position.as_dvec3(), case.normal.as_dvec3());
        let (from_middle, random) = lock::at(position, normal);
        // Offsets in locks keep 2^-21, and a lock is nine strands wide.
        let error = 2e-5 + 9.0 * 2.0 / f64::from(1 << 21);
        let [x, y, z, own] = found.lock;
        (0..3).try_for_each(|i| within("middle of a lock", [x, y, z][i], from_middle[i], error))?;
        within("random number of a lock", own, random, 1e-6)
    };
    // In a few places a ninth lock is nearer than the eight that the shader looks at; the twin's own test counts them.
    mostly(1e-2, cases.iter().zip(&found).map(lock).collect());
    all_hold(cases.iter().zip(&found).map(|(case, found)| {
        let [height, clump, curl] = case.unit.as_dvec3().to_array();
        let (normal, from_middle) = (case.normal.as_dvec3(), 5.0 * case.tangent.as_dvec3());
        let expected = lock::way_to_root(from_middle, case.share.into(), normal, height, clump, curl);
        // Turns up to 19 radians keep 2^-19.
        (0..3).try_for_each(|i| {
            within("way to the root", found.way_to_root[i], expected[i], 3e-5 + 2e-5 * expected.length())
        })
    }));
}
