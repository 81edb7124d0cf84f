//! The oracle against marches, closed forms, its own noise, and the renderer's densest stack of shells.
#![cfg(feature = "measure")]

#[allow(dead_code)]
#[path = "support/headless.rs"]
mod headless;

use glam::{DVec2, DVec3, Vec3};
use vair::FrameOptions;
use vair::measure::oracle::{
    Corner, FurGeometry, Hit, OracleError, OracleOptions, OraclePicture, Ray, Triangle, render,
};
use vair::measure::twin::albedo::gauss_legendre;
use vair::measure::twin::hash;
use vair::measure::twin::strand::{Strand, cross_section, slab_opacity, width};
use vair::render::{Shadows, ShellAlpha, ShellSampling, Shells};
use vair::scene::{self, Camera, CameraChoice, EnvironmentLight, Lighting, Pose, Scene};

/// Three numbers in [0, 1).
fn random(stream: i32, index: usize) -> DVec3 {
    DVec3::from_array(hash::cell([stream, index as i32, 77]))
}

/// Fur like a preset's.
fn cone() -> FurGeometry {
    FurGeometry { radius: 0.35, cutoff_end: 1.0, ..FurGeometry::default() }
}

/// Two triangles of a flat skin in the XY plane, `side` spacings wide, one metre a spacing, with straight strands.
fn flat(side: f64, length_m: f64) -> [Triangle; 2] {
    let corner = |x: f64, y: f64| Corner {
        root: DVec3::new(x, y, 0.3),
        direction: DVec3::Z,
        length_m,
        root_in_cells: DVec3::new(x, y, 0.3),
        direction_in_rest: DVec3::Z,
        ..Corner::default()
    };
    let [a, b, c, d] = [corner(0.0, 0.0), corner(side, 0.0), corner(side, side), corner(0.0, side)];
    [[a, b, c], [a, c, d]]
}

/// A bulging patch whose strands spread and bend, in a rest pose of its own.
fn curved(bend: f64) -> Vec<Triangle> {
    let corner = |x: usize, y: usize| {
        let (u, v) = (x as f64 / 2.0 - 0.5, y as f64 / 2.0 - 0.5);
        let direction = DVec3::new(0.9 * u, 0.7 * v, 1.0).normalize();
        let sideways = DVec3::new(0.6, -0.8 + u, 0.0).reject_from_normalized(direction).normalize();
        let root = DVec3::new(u, v, -0.4 * (u * u + v * v));
        Corner {
            root,
            direction,
            sideways,
            bend_angle: bend * (1.0 + 0.4 * v),
            length_m: 0.3 + 0.1 * u,
            root_in_cells: root * 6.0 + DVec3::new(3.1, -7.7, 0.4),
            direction_in_rest: DVec3::new(0.8 * u, 0.8 * v, 1.0).normalize(),
        }
    };
    let quads = (0..4).map(|index| (index % 2, index / 2));
    quads
        .flat_map(|(x, y)| {
            let [a, b, c, d] = [corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

/// The nearest hit over all triangles, and whose it is.
fn first_hit<'a>(fur: &FurGeometry, triangles: &'a [Triangle], ray: &Ray) -> Option<(Hit, &'a Triangle)> {
    triangles.iter().fold(None, |best: Option<(Hit, &Triangle)>, triangle| {
        let limit_m = best.map_or(ray.length_m, |(hit, _)| hit.distance_m);
        fur.first_hit(triangle, ray, limit_m).map(|hit| (hit, triangle)).or(best)
    })
}

/// Distance and barycentric coordinates where a ray meets a triangle (Cramer's rule).
fn meet(ray: &Ray, corners: [DVec3; 3]) -> Option<(f64, DVec3)> {
    let [a, b, c] = corners;
    let (ab, ac, from) = (b - a, c - a, ray.origin - a);
    let normal = ab.cross(ac);
    let determinant = -ray.direction.dot(normal);
    let turned = from.cross(ray.direction);
    let (u, v) = (ac.dot(turned) / determinant, -ab.dot(turned) / determinant);
    let distance_m = from.dot(normal) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance_m >= 0.0).then_some((distance_m, DVec3::new(1.0 - u - v, u, v)))
}

/// The first hit among many shells.
fn march(fur: &FurGeometry, triangles: &[Triangle], ray: &Ray, shells: usize) -> Option<f64> {
    let mut nearest: Option<f64> = None;
    for triangle in triangles {
        for shell in 0..=shells {
            let height = shell as f64 / shells as f64;
            let met = meet(ray, triangle.each_ref().map(|corner| corner.at(height)));
            let Some((distance_m, barycentric)) = met else { continue };
            let is_nearer = nearest.is_none_or(|nearest| distance_m < nearest);
            if is_nearer && fur.profile(triangle, barycentric, height).0 >= fur.threshold(height) {
                nearest = Some(distance_m);
            }
        }
    }
    nearest
}

#[test]
fn hits_are_the_first_of_a_fine_march() {
    let shells = 1500;
    let furs = [
        ("straight", 0.0, cone()),
        ("bent", 0.9, cone()),
        (
            "paraboloid",
            0.5,
            FurGeometry { is_paraboloid: true, taper: 0.6, cutoff_start: 0.1, cutoff_end: 0.7, ..cone() },
        ),
        ("locks", 0.4, FurGeometry { clump: 0.6, curl: 0.5, ..cone() }),
    ];
    for (name, bend, fur) in furs {
        let triangles = curved(bend);
        let (mut hits, mut thin) = (0, 0);
        for index in 0..60 {
            let (from, to) = (random(1, index) - 0.5, random(2, index) - 0.5);
            let origin = DVec3::new(2.4 * from.x, 2.4 * from.y, 0.4 + from.z);
            let direction = (DVec3::new(0.9 * to.x, 0.9 * to.y, 0.2 * to.z) - origin).normalize();
            let ray = Ray::new(origin, direction, f64::INFINITY);
            let found = first_hit(&fur, &triangles, &ray);
            let marched = march(&fur, &triangles, &ray, shells);
            if let Some((hit, triangle)) = found {
                let profile = fur.profile(triangle, hit.barycentric, hit.height).0;
                assert!(profile >= fur.threshold(hit.height) - 1e-9, "{name} {index}: {hit:?} is no strand");
                let [a, b, c] = triangle.each_ref().map(|corner| corner.at(hit.height));
                let place = a * hit.barycentric.x + b * hit.barycentric.y + c * hit.barycentric.z;
                let off = (place - ray.at(hit.distance_m)).length();
                assert!(
                    off < 1e-9 && hit.barycentric.min_element() > -1e-9,
                    "{name} {index}: {hit:?} is not on its shell"
                );
            }
            match (found, marched) {
                (Some((hit, _)), Some(marched)) => {
                    hits += 1;
                    assert!(hit.distance_m <= marched + 1e-9, "{name} {index}: {hit:?} lies behind {marched}");
                    // One step of the march in height is at most so far along the ray, unless shells are seen edge-on.
                    thin += usize::from(marched - hit.distance_m > 20.0 * 0.4 / shells as f64);
                }
                (None, Some(marched)) => panic!("{name} {index}: the strand at {marched} is missed"),
                (Some(_), None) => thin += 1,
                (None, None) => {}
            }
        }
        assert!(hits >= 25, "{name}: only {hits} rays hit");
        // Strands that are touched between two shells of the march.
        assert!(thin <= 3, "{name}: {thin} hits that the march has not");
    }
}

/// Heights at which a place that moves in a straight line (`at` at height 0, by `step` to height 1, in spacings) is inside
/// a cone that stands at the origin: radius at height 0, and the height of its tip.
fn inside_cone(at: DVec2, step: DVec2, radius: f64, tip: f64) -> Option<[f64; 2]> {
    // |at + step k| = radius (1 - k / tip)
    let slope = radius / tip;
    let a = step.length_squared() - slope * slope;
    let half_b = at.dot(step) + radius * slope;
    let c = at.length_squared() - radius * radius;
    // No root, no number: the path passes by.
    let root = Some(half_b * half_b - a * c).filter(|square| *square >= 0.0)?.sqrt();
    let ends = [(-half_b - root) / a, (-half_b + root) / a];
    let ends = [ends[0].max(0.0), ends[1].min(tip).min(1.0)];
    (a > 0.0 && ends[0] <= ends[1]).then_some(ends)
}

#[test]
fn straight_cones_are_met_where_the_closed_form_says() {
    let (fur, side, length_m) = (cone(), 12.0, 4.0);
    let triangles = flat(side, length_m);
    let mut hits = 0;
    for index in 0..400 {
        let [x, y, turn] = random(3, index).to_array();
        let (sine, cosine) = (turn * std::f64::consts::TAU).sin_cos();
        let slant = DVec2::new(cosine, sine) * 0.9;
        let foot = DVec2::new(x, y) * 4.0 + 4.0;
        let ray = Ray::new((foot + 2.0 * slant).extend(10.0), -(slant * 2.0 / 9.7).extend(1.0).normalize(), 1e3);
        let at = |height: f64| {
            (ray.origin - ray.direction * ((10.0 - 0.3 - height * length_m) / ray.direction.z)).truncate()
        };
        let (start, step) = (at(0.0), at(1.0) - at(0.0));
        let mut first: Option<f64> = None;
        for cell in 0..12 * 12 * 3 {
            let cell = DVec3::new(f64::from(cell % 12), f64::from(cell / 12 % 12), f64::from(cell / 144) - 1.0);
            let strand = Strand::of_cell(cell);
            let (offset, shrink) = strand.offset(start.extend(0.3), DVec3::Z);
            if shrink > 0.0 {
                let ends = inside_cone(-offset.truncate(), step, fur.radius * shrink, strand.full_length());
                first = first.into_iter().chain(ends.map(|ends| ends[1])).reduce(f64::max);
            }
        }
        let found = first_hit(&fur, &triangles, &ray).map(|(hit, _)| hit.height);
        hits += usize::from(found.is_some());
        let agrees = match (first, found) {
            (Some(first), Some(found)) => (first - found).abs() < 1e-9,
            (first, found) => first == found,
        };
        assert!(agrees, "ray {index}: {found:?} for {first:?}");
    }
    assert!((100..390).contains(&hits), "{hits} of 400 rays hit");
}

#[test]
fn seen_from_above_the_coverage_is_the_closed_forms() {
    let triangles = flat(1000.0, 2.0);
    for (radius, cutoff_start) in [(0.15, 0.0), (0.15, 0.2), (0.2, 0.1)] {
        let fur = FurGeometry { radius, cutoff_start, ..cone() };
        let count = 30_000;
        let hits = (0..count).filter(|&index| {
            let foot = random(4, index) * 1000.0;
            let ray = Ray::new(DVec3::new(foot.x, foot.y, 9.0), DVec3::NEG_Z, f64::INFINITY);
            first_hit(&fur, &triangles, &ray).is_some()
        });
        let found = hits.count() as f64 / count as f64;
        let expected = slab_opacity(cross_section(cutoff_start, radius), 0.0, 0.0);
        // Independent places: four standard errors of a share.
        let noise = 4.0 * (expected * (1.0 - expected) / count as f64).sqrt();
        assert!((found - expected).abs() < noise, "{found} for {expected} +- {noise}, radius {radius}");
    }
}

/// Bias law of layers that know one point of a strand: it depends on `q = L tan(theta) / (N d)` alone, d the diameter of
/// the thickest strand. Strands stand apart and have dark roots (occlusion 0.8) on a black skin.
#[test]
fn point_layers_lose_light_by_the_bias_law() {
    let (radius, occlusion) = (0.025, 0.8);
    let law = [(1.0, 0.50), (0.5, 0.33), (0.25, 0.16), (0.125, 0.07), (0.06, 0.025), (0.03, 0.01)];
    for degrees in [45f64, 60.0, 75.0] {
        // Strands are 20 d long: the roots that the ray passes over.
        let path = 20.0 * 2.0 * radius * degrees.to_radians().tan();
        let (mut exact, mut layered) = (0.0, [0.0; 6]);
        for index in 0..700_000 {
            let at = random(5, index).truncate() * 200.0;
            let mut first = 0.0;
            let mut first_layers = [0.0; 6];
            for cell in 0..3 * 2 * (path.ceil() as i32 + 2) {
                let step = DVec3::new(f64::from(cell / 6), f64::from(cell % 3), f64::from(cell / 3 % 2)) - 1.0;
                let strand = Strand::of_cell(at.floor().extend(0.0) + step);
                let (offset, shrink) = strand.offset(at.extend(0.0), DVec3::Z);
                let full = strand.full_length();
                if shrink <= 0.0 {
                    continue;
                }
                let met = inside_cone(-offset.truncate(), DVec2::X * path, radius * shrink, full);
                let Some([low, high]) = met else { continue };
                first = f64::max(first, 1.0 - occlusion * (1.0 - high));
                for ((q, _), first) in law.iter().zip(&mut first_layers) {
                    // Layer i stands at the height (i + 1/2) / N.
                    let layers = (path / (q * 2.0 * radius)).round();
                    let layer = (high * layers - 0.5).floor();
                    if layer >= low * layers - 0.5 {
                        *first = f64::max(*first, 1.0 - occlusion * (1.0 - (layer + 0.5) / layers));
                    }
                }
            }
            exact += first;
            layered.iter_mut().zip(first_layers).for_each(|(sum, first)| *sum += first);
        }
        for ((q, expected), layered) in law.into_iter().zip(layered) {
            let bias = 1.0 - layered / exact;
            println!("{degrees} degrees, q = {q}: bias {bias:.4} for {expected}");
            assert!((bias / expected - 1.0).abs() < 0.3, "q = {q}, {degrees} degrees: bias {bias} for {expected}");
        }
    }
}

/// Radiance through a smooth density: light of a colour that changes with height, dimmed by what is above.
#[test]
fn smooth_density_converges_with_the_order_of_its_opacity() {
    let fur = FurGeometry { radius: 0.4, ..cone() };
    // Up to where the first strands end, and the density has a kink.
    let density = |height: f64| 4.0 * width(fur.threshold(0.7 * height), fur.radius);
    let color = |height: f64| 0.2 + 0.8 * height * height;
    let rule = gauss_legendre(48);
    let integral = |low: f64, high: f64, value: &dyn Fn(f64) -> f64| -> f64 {
        rule.iter().map(|(node, weight)| weight * (high - low) * value(low + (high - low) * node)).sum()
    };
    let exact =
        integral(0.0, 1.0, &|height| color(height) * density(height) * (-integral(height, 1.0, &density)).exp());
    let layered = |layers: usize, opacity: fn(f64) -> f64| {
        let step = 1.0 / layers as f64;
        let (radiance, _) = (0..layers).rev().fold((0.0, 1.0), |(radiance, left), layer| {
            let height = (layer as f64 + 0.5) * step;
            let alpha = opacity(density(height) * step);
            (radiance + left * alpha * color(height), left * (1.0 - alpha))
        });
        f64::abs(radiance - exact)
    };
    let slope = |opacity: fn(f64) -> f64| (layered(512, opacity) / layered(32, opacity)).log2() / 4.0;
    let (exponential, linear) = (slope(|depth| -(-depth).exp_m1()), slope(|depth| depth));
    println!("slopes {exponential:.3} and {linear:.3}");
    assert!((exponential + 2.0).abs() <= 0.15, "midpoint exponential opacity converges with order {exponential}");
    assert!((linear + 1.0).abs() <= 0.15, "linear opacity converges with order {linear}");
}

/// A view of the gallery whose fur has a limit.
struct View {
    scene: Scene,
    pose: Pose,
    lighting: Lighting,
    choice: CameraChoice,
}

impl View {
    fn knot() -> Self {
        let mut scene = Scene::gallery();
        for fur in scene.materials_mut().iter_mut().filter_map(|material| material.fur.as_mut()) {
            (fur.edge_fade, fur.tip_fade) = (0.0, 0.0);
        }
        let pose = scene::pose(scene.asset(), None, 0.0);
        let environment = EnvironmentLight::constant(Vec3::splat(0.05));
        let lighting = Lighting { lights: scene::lights(scene.asset(), 0, &pose), environment };
        let target = Some(Vec3::new(0.0, 0.36, 0.0));
        let choice = CameraChoice::Orbit { theta_deg: 20.0, phi_deg: 75.0, radius_m: Some(0.6), target, fov_deg: 24.0 };
        Self { scene, pose, lighting, choice }
    }

    fn camera(&self, size: [u32; 2]) -> Camera {
        let aspect = size[0].max(1) as f32 / size[1] as f32;
        scene::camera(self.scene.asset(), 0, &self.pose, &self.choice, aspect, &self.scene.outline(0, None)).unwrap()
    }

    fn oracle(&self, options: OracleOptions) -> Result<OraclePicture, OracleError> {
        render(&self.scene, 0, &self.pose, &self.camera(options.size), &self.lighting, None, &options)
    }
}

#[test]
fn the_noise_is_what_it_says() {
    let view = View::knot();
    let picture = |seed| view.oracle(OracleOptions { size: [12, 9], samples: 8, seed }).unwrap();
    let pictures: Vec<OraclePicture> = (0..24).map(picture).collect();
    let count = pictures.len() as f64;
    let (mut estimated, mut found) = (0.0, 0.0);
    for pixel in 0..12 * 9 {
        let radiance = || pictures.iter().map(|picture| picture.radiance[pixel].truncate());
        let mean = radiance().sum::<DVec3>() / count;
        found += radiance().map(|sample| (sample - mean).length_squared()).sum::<f64>() / (count - 1.0);
        estimated += pictures.iter().map(|picture| picture.variance[pixel].element_sum()).sum::<f64>() / count;
    }
    // 108 pixels of 24 pictures: either variance is known to a few per cent.
    assert!((estimated / found - 1.0).abs() < 0.2, "variance {estimated} estimated, {found} found");
    assert!(pictures[0].noise_relmse() > 0.0 && pictures[0] != pictures[1]);
}

#[test]
fn the_same_seed_gives_the_same_bits_on_any_number_of_threads() {
    let view = View::knot();
    let picture = || view.oracle(OracleOptions { size: [16, 9], samples: 4, seed: 3 }).unwrap();
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(picture);
    assert_eq!(alone, picture());
}

#[test]
fn what_has_no_limit_is_refused() {
    let mut view = View::knot();
    let small = OracleOptions { size: [4, 4], samples: 2, seed: 0 };
    assert!(matches!(view.oracle(OracleOptions { samples: 3, ..small }), Err(OracleError::Samples { samples: 3 })));
    assert!(matches!(
        view.oracle(OracleOptions { size: [0, 4], ..small }),
        Err(OracleError::Size { width: 0, height: 4 })
    ));
    view.oracle(small).unwrap();
    let fur = view.scene.materials_mut().iter_mut().find_map(|material| material.fur.as_mut()).unwrap();
    fur.tip_fade = 0.1;
    let error = view.oracle(small).unwrap_err().to_string();
    assert!(error.starts_with("material \"fur\": only cut-out fur has a limit"), "{error}");
}

/// A hand's breadth of the knot, strands a few pixels wide: from afar the renderer shows means instead of strands. Its own
/// edges, a pixel wide, thicken tips; shells that are strand or nothing have the oracle for their limit.
#[test]
fn the_densest_stack_of_shells_comes_near() {
    let size = [96, 72];
    let mut view = View::knot();
    let target = Some(Vec3::new(0.0, 0.4, 0.0));
    view.choice = CameraChoice::Orbit { theta_deg: 20.0, phi_deg: 75.0, radius_m: Some(0.6), target, fov_deg: 3.0 };
    let exact = view.oracle(OracleOptions { size, samples: 16, seed: 5 }).unwrap();
    let shells = Shells { sampling: ShellSampling::Slab, alpha: ShellAlpha::Step, ..Shells::default() };
    let camera = view.choice.clone();
    let environment = view.lighting.environment.clone();
    // Of which the oracle knows nothing.
    let shadows = Shadows { are_cast: false, ..Shadows::default() };
    let options = FrameOptions {
        size,
        camera,
        layers: Some(256),
        shells,
        msaa: 1,
        environment,
        shadows,
        ..FrameOptions::default()
    };
    headless::headless(|device| {
        let picture = device.picture(&view.scene, &options);
        let pixels = || exact.radiance.iter().zip(&picture.radiance).map(|(a, b)| [*a, b.as_dvec4()]);
        let count = pixels().count() as f64;
        let [of_exact, of_shells] = [0, 1].map(|of| pixels().map(|pair| pair[of].truncate()).sum::<DVec3>() / count);
        // One sample a pixel: four standard errors of the mean difference.
        let noise =
            (pixels().map(|[a, b]| ((b - a).truncate()).powf(2.0)).sum::<DVec3>() / count / count).map(f64::sqrt);
        let apart = (of_shells - of_exact).abs();
        println!("mean radiance {of_exact} of the oracle, {of_shells} of 256 shells, noise {noise}");
        assert!(apart.cmple(4.0 * noise).all(), "{of_exact} of the oracle, {of_shells} of 256 shells, noise {noise}");
        assert!(4.0 * noise.x < 0.03 * of_exact.x, "red, the strongest, is too noisy to tell: {noise}");
    });
}
