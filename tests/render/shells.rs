//! Shell k of N lies at (k + 1/2) / N of a strand, wherever the strand bends to: pictures against rays cast through
//! closed shells.
//!
//! The coats here have no gaps, and their colour runs from red at the root to green at the tip, so that a pixel's share
//! of green says which shell it shows.

use crate::headless::{Headless, headless};
use crate::limit::all_hold;
use crate::stage::{Stage, camera_axes, options, plain, quad};
use glam::{DVec2, DVec3, Quat, Vec3, Vec4};
use std::f64::consts::FRAC_PI_2;
use vair::asset::{Primitive, Transform};
use vair::material::{ForceSpace, Fur, Length};
use vair::measure::twin::strand::{arc, bend_angle};
use vair::render::{FrameOptions, Picture, ShellSampling, Shells as ShellOptions};

const LAYERS: u32 = 6;
const HALF_M: f32 = 0.4;

/// Steps to the eight pixels around one: where all agree, no edge is near.
pub const AROUND: [DVec2; 8] = [
    DVec2::X,
    DVec2::NEG_X,
    DVec2::Y,
    DVec2::NEG_Y,
    DVec2::ONE,
    DVec2::NEG_ONE,
    DVec2::new(1.0, -1.0),
    DVec2::new(-1.0, 1.0),
];

/// A coat that shows heights: red root, green tip, no light of its own, nothing that bends.
pub fn height_coat() -> Fur {
    Fur {
        length: Length::Metres(0.5),
        layers: LAYERS,
        cutoff_start: 0.0,
        cutoff_end: 0.0,
        occlusion: 0.0,
        base_color: Some(Vec3::ONE),
        root_color: Vec3::X,
        tip_color: Vec3::Y,
        color_variation: 0.0,
        force_strength: 0.0,
        specular: 0.0,
        transmission: 0.0,
        ..Fur::default()
    }
}

/// Height that a pixel shows: `None` = background, less than half a shell = skin.
pub fn shown_height(radiance: Vec4) -> Option<f64> {
    (radiance.w > 0.0).then(|| f64::from(radiance.y) / f64::from(radiance.x + radiance.y))
}

/// Compares shown heights: shells exactly but for half floats, skin as what is lower than any shell.
pub fn same_height(what: &str, found: Option<f64>, expected: Option<f64>, layers: u32) -> Result<(), String> {
    let lowest = 0.5 / f64::from(layers);
    let agree = match (found, expected) {
        (Some(found), Some(0.0)) => found < 0.75 * lowest,
        (Some(found), Some(expected)) => (found - expected).abs() < 3e-3,
        (found, expected) => found.is_none() && expected.is_none(),
    };
    if agree { Ok(()) } else { Err(format!("{what} shows {found:?} instead of {expected:?}")) }
}

/// Shells of a rectangle in the XY plane: where each is, by its height.
struct Shells<'a> {
    half_m: f64,
    layers: u32,
    /// From the root, metres.
    displacement: &'a dyn Fn(f64) -> DVec3,
}

impl Shells<'_> {
    /// What a ray against `backwards` through `origin` meets first.
    fn height_along(&self, origin: DVec3, backwards: DVec3) -> Option<f64> {
        let shells = (0..self.layers).map(|k| (f64::from(k) + 0.5) / f64::from(self.layers));
        std::iter::once(0.0)
            .chain(shells)
            .filter_map(|height| {
                let middle = if height == 0.0 { DVec3::ZERO } else { (self.displacement)(height) };
                let distance = (middle.z - origin.z) / backwards.z;
                let hit = origin + distance * backwards - middle;
                (hit.truncate().abs().max_element() < self.half_m).then_some((distance, height))
            })
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, height)| height)
    }

    /// Compares all pixels that are not within one pixel of an edge.
    fn compare(
        &self,
        what: &str,
        picture: &Picture,
        half_m: f64,
        backwards: Vec3,
        up: Vec3,
    ) -> Vec<Result<(), String>> {
        let axes = camera_axes(backwards, up).as_dmat3();
        let size = DVec2::new(picture.size[0].into(), picture.size[1].into());
        let expected_at = |pixel: DVec2| {
            let clip = pixel / size * 2.0 - 1.0;
            let origin = axes.x_axis * clip.x * half_m * size.x / size.y - axes.y_axis * clip.y * half_m;
            self.height_along(origin, axes.z_axis)
        };
        let mut checks = Vec::new();
        for y in 0..picture.size[1] {
            for x in 0..picture.size[0] {
                let middle = DVec2::new(x.into(), y.into()) + 0.5;
                let expected = expected_at(middle);
                if AROUND.iter().all(|&step| expected_at(middle + step) == expected) {
                    let found = shown_height(picture.radiance(x, y));
                    checks.push(same_height(&format!("{what}: pixel {x}, {y}"), found, expected, self.layers));
                }
            }
        }
        assert!(checks.len() * 2 > picture.radiance.len(), "{what}: only {} pixels can be compared", checks.len());
        let heights = (0..picture.radiance.len()).filter_map(|i| shown_height(picture.radiance[i]));
        assert!(
            heights.clone().any(|h| h > 0.9) || self.layers < 5,
            "{what}: the outermost shell is not in the picture"
        );
        checks
    }
}

/// A coat on a square in the XY plane.
struct Coat {
    fur: Fur,
    transform: Transform,
    primitive: Primitive,
    /// Red of the height map, if there is one.
    height_texel: Option<u8>,
    /// Half a side in the world.
    half_m: f32,
}

impl Coat {
    fn new(fur: Fur, transform: Transform) -> Self {
        let Transform::Trs { scale, .. } = transform else { panic!("placed by translation, rotation and scale") };
        Self { fur, transform, primitive: quad(HALF_M, HALF_M), height_texel: None, half_m: HALF_M * scale.x }
    }
}

/// Shows a coat and compares it with shells displaced by a function of their height.
fn check(
    device: &mut Headless,
    what: &str,
    coat: Coat,
    displacement: &dyn Fn(f64) -> DVec3,
) -> Vec<Result<(), String>> {
    let Coat { fur, transform, primitive, height_texel, half_m } = coat;
    let (backwards, up, view_half_m) = (Vec3::new(0.5, -0.6, 0.8), Vec3::Y, 1.3);
    let mut stage = Stage::default();
    stage.parallel_camera(view_half_m, backwards, up);
    let white = stage.texel([255; 4]);
    let height_map = height_texel.map(|texel| stage.texel([texel, 0, 255, 255]));
    let material = stage.material(plain());
    stage.object(primitive, material, transform);
    let mut scene = stage.scene();
    let layers = fur.layers;
    scene.materials_mut()[material].fur = Some(Fur { distribution_map: Some(white), height_map, ..fur });
    [1, 4]
        .into_iter()
        .flat_map(|msaa| {
            let shells = ShellOptions { sampling: ShellSampling::Point, ..ShellOptions::default() };
            let picture = device.picture(&scene, &FrameOptions { shells, ..options([96, 96], msaa) });
            let shells = Shells { half_m: half_m.into(), layers, displacement };
            shells.compare(&format!("{what}, {msaa} samples"), &picture, view_half_m.into(), backwards, up)
        })
        .collect()
}

fn still(scale: f32) -> Transform {
    Transform::Trs { translation: Vec3::ZERO, rotation: Quat::IDENTITY, scale: Vec3::splat(scale) }
}

#[test]
fn straight_shells_lie_in_the_middle_of_their_slabs() {
    let relative = |share| Fur { length: Length::Relative(share), ..height_coat() };
    let radius_m = f64::from(HALF_M) * 2f64.sqrt();
    headless(|device| {
        let mut along_z = |what, fur, scale: f32, length_m: f64| {
            let displacement = move |height: f64| DVec3::Z * height * length_m;
            all_hold(check(device, what, Coat::new(fur, still(scale)), &displacement));
        };
        along_z("metres", height_coat(), 1.0, 0.5);
        along_z("metres on a scaled node", height_coat(), 2.0, 0.5);
        along_z("relative", relative(0.7), 1.0, 0.7 * radius_m);
        along_z("relative on a scaled node", relative(0.7), 1.5, 1.5 * 0.7 * radius_m);
        along_z("two shells", Fur { layers: 2, ..height_coat() }, 1.0, 0.5);
    });
}

#[test]
fn vertex_opacity_and_height_map_shorten() {
    headless(|device| {
        let half = f64::from(128u8) / 255.0;
        let mut faded = quad(HALF_M, HALF_M);
        faded.vertices.colors = vec![Vec4::new(1.0, 1.0, 1.0, 0.5); 4];
        let displacement = |height: f64| DVec3::Z * height * 0.25;
        let coat = Coat { primitive: faded, ..Coat::new(height_coat(), still(1.0)) };
        all_hold(check(device, "vertex opacity", coat, &displacement));
        for strength in [1.0, 0.5] {
            let fur = Fur { height_strength: strength, ..height_coat() };
            let length_m = 0.5 * (1.0 + f64::from(strength) * (half - 1.0));
            let displacement = move |height: f64| DVec3::Z * height * length_m;
            let coat = Coat { height_texel: Some(128), ..Coat::new(fur, still(1.0)) };
            all_hold(check(device, "height map", coat, &displacement));
        }
    });
}

#[test]
fn a_force_bends_strands_to_arcs_of_the_same_length() {
    headless(|device| {
        for (force, strength, space, turn) in [
            (Vec3::X, 0.5, ForceSpace::World, 0.0),
            (Vec3::NEG_Y, 1.0, ForceSpace::World, 0.0),
            (Vec3::new(-1.0, 1.0, -2.0), 0.8, ForceSpace::World, 0.0),
            // The square looks the same after a quarter turn; its own X is the world's Y then.
            (Vec3::X, 0.7, ForceSpace::World, FRAC_PI_2),
            (Vec3::X, 0.7, ForceSpace::Object, FRAC_PI_2),
            // A force straight down the strand has no direction to bend to.
            (Vec3::NEG_Z, 1.0, ForceSpace::World, 0.0),
        ] {
            let fur = Fur { force, force_strength: strength, force_space: space, ..height_coat() };
            let rotation = Quat::from_rotation_z(turn as f32);
            let in_world = if space == ForceSpace::Object { rotation * force } else { force };
            let in_world = in_world.as_dvec3().normalize() * f64::from(strength);
            let angle = bend_angle(DVec3::Z, in_world);
            let sideways = in_world.with_z(0.0).normalize_or_zero();
            let displacement = move |height: f64| {
                let [aside, up] = arc(height, angle);
                0.5 * (sideways * aside + DVec3::Z * up)
            };
            let transform = Transform::Trs { translation: Vec3::ZERO, rotation, scale: Vec3::ONE };
            let what = format!("force {force} {strength} {space:?}");
            all_hold(check(device, &what, Coat::new(fur, transform), &displacement));
        }
    });
}
