//! How far our pictures are from published ones of other renderers: the scenarios of the glTF render fidelity project
//! (KhronosGroup/glTF-Render-Fidelity), same camera, size, environment and tone curve, by FLIP.
//!
//! The published pictures were drawn at twice the listed size, made 512 pixels wide, and keep their alpha; they are laid
//! over white before they are compared. Ours go the same way. Nobody is the truth there: the distance of our
//! picture to the others is to be no larger than the median distance of the others among each other.

use anyhow::{Context, Result, bail, ensure};
use clap::Parser;
use glam::Vec3;
use image::RgbImage;
use image::imageops::{self, FilterType};
use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageRgb8, FlipPool};
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use vair::asset::{Environment, LoadOptions};
use vair::gpu::GpuOptions;
use vair::render::{Background, FrameOptions, Renderer, Tonemap};
use vair::scene::{CameraChoice, EnvironmentLight, Scene};

/// Pictures are drawn this much larger than is listed.
const SCALE: u32 = 2;

#[derive(Parser)]
#[command(name = "fidelity", about = "Compares our pictures with published ones of other renderers, by FLIP")]
struct Arguments {
    /// Folder with khronos/, env/ and reference/.
    #[arg(long, value_name = "DIR", default_value = "../shared/assets")]
    assets: PathBuf,
    /// Only the scenarios whose name contains this.
    #[arg(long, value_name = "NAME")]
    scenario: Option<String>,
    /// Keeps a sheet a scenario in this folder: our picture over white, then those of the others in the order printed.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Prints one JSON object.
    #[arg(long)]
    json: bool,
}

/// A published scenario, as the configuration says; what it leaves out has its default.
struct Scenario {
    name: String,
    model: PathBuf,
    camera: CameraChoice,
    /// Pixels.
    size: [u32; 2],
    shows_environment: bool,
}

/// Display colour over white, rows from the top.
struct Picture {
    size: [u32; 2],
    rgb: Vec<u8>,
}

/// Distances of one scenario.
struct Distances {
    name: String,
    /// Of ours to each.
    per_renderer: Vec<(String, f64)>,
    ours: f64,
    /// Of each to the others.
    means_among: Vec<(String, f64)>,
    among_median: f64,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    let assets = &arguments.assets;
    let environment = assets.join("env/lightroom_14b.hdr");
    let (environment, warnings) = Environment::load(&environment, &LoadOptions::default())?;
    warnings.iter().for_each(|warning| eprintln!("warning: {warning}"));
    let environment = EnvironmentLight::new(Arc::new(environment));
    let mut renderer = Renderer::new(&GpuOptions::default())?;
    let mut all = Vec::new();
    for scenario in scenarios(assets)? {
        if arguments.scenario.as_ref().is_some_and(|part| !scenario.name.contains(part.as_str())) {
            continue;
        }
        let goldens = goldens(&assets.join("reference/fidelity_goldens_512").join(&scenario.name))?;
        let [(_, first), ..] = &goldens[..] else { continue };
        let ours = draw(&mut renderer, &scenario, &environment, first.size)?;
        if let Some(folder) = &arguments.out {
            std::fs::create_dir_all(folder)?;
            let row: Vec<&Picture> = std::iter::once(&ours).chain(goldens.iter().map(|(_, golden)| golden)).collect();
            let Picture { size: [width, height], rgb } = side_by_side(&row);
            let path = folder.join(format!("{}.png", scenario.name));
            image::save_buffer(&path, &rgb, width, height, image::ColorType::Rgb8)?;
        }
        let distances = distances(scenario.name, &ours, &goldens);
        if !arguments.json {
            print(&distances);
        }
        all.push(distances);
    }
    ensure!(!all.is_empty(), "no scenario to compare; look at --scenario and at {}", assets.display());
    if arguments.json {
        println!("{}", json!({ "scenarios": all.iter().map(in_json).collect::<Vec<_>>() }));
    }
    Ok(())
}

/// Those that have both a model and published pictures.
fn scenarios(assets: &Path) -> Result<Vec<Scenario>> {
    let read = |name: &str| -> Result<Value> {
        let path = assets.join("reference").join(name);
        let text = std::fs::read(&path).with_context(|| path.display().to_string())?;
        serde_json::from_slice(&text).with_context(|| path.display().to_string())
    };
    let configurations = [read("fidelity_config_2024.json")?, read("fidelity_scenarios_2026.json")?];
    let listed = configurations.iter().filter_map(|configuration| configuration["scenarios"].as_array()).flatten();
    let all = listed.filter_map(|scenario| {
        let name = scenario["name"].as_str()?.strip_prefix("khronos-")?.to_owned();
        let endings = ["glb", "gltf"].map(|ending| assets.join(format!("khronos/{name}/{name}.{ending}")));
        let model = endings.into_iter().find(|path| path.is_file())?;
        assets.join("reference/fidelity_goldens_512").join(&name).is_dir().then(|| Scenario {
            camera: camera(scenario),
            size: ["width", "height"]
                .map(|side| scenario["dimensions"][side].as_u64().map_or(768, |side| side as u32) * SCALE),
            shows_environment: scenario["renderSkybox"].as_bool().unwrap_or(false),
            name,
            model,
        })
    });
    Ok(all.collect())
}

fn camera(scenario: &Value) -> CameraChoice {
    let number = |group: &str, key: &str, default: f64| scenario[group][key].as_f64().unwrap_or(default) as f32;
    let (theta_deg, phi_deg) = (number("orbit", "theta", 0.0), number("orbit", "phi", 90.0));
    let mut target = Vec3::new(number("target", "x", 0.0), number("target", "y", 0.0), number("target", "z", 0.0));
    let mut radius_m = number("orbit", "radius", 1.0);
    if radius_m <= 0.0 {
        // The eye is the target itself: one a little before it looks the same way.
        let (theta, phi) = (theta_deg.to_radians(), phi_deg.to_radians());
        let backwards = Vec3::new(phi.sin() * theta.sin(), phi.cos(), phi.sin() * theta.cos());
        radius_m = 0.01 * target.length().max(1e-3);
        target -= backwards * radius_m;
    }
    let fov_deg = scenario["verticalFoV"].as_f64().unwrap_or(45.0) as f32;
    CameraChoice::Orbit { theta_deg, phi_deg, radius_m: Some(radius_m), target: Some(target), fov_deg }
}

/// The published pictures of a scenario, by renderer.
fn goldens(folder: &Path) -> Result<Vec<(String, Picture)>> {
    let entries = std::fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    let mut paths = entries.map(|entry| Ok(entry?.path())).collect::<Result<Vec<_>>>()?;
    paths.sort();
    let mut all: Vec<(String, Picture)> = Vec::new();
    for path in paths {
        let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let Some(renderer) = file.strip_suffix("-golden.thumb.webp") else { continue };
        let picture = image::open(&path).with_context(|| path.display().to_string())?.into_rgba8();
        let size = [picture.width(), picture.height()];
        if let Some((other, first)) = all.first()
            && first.size != size
        {
            bail!("{}: {size:?} pixels, and that of {other} has {:?}", path.display(), first.size);
        }
        all.push((renderer.to_owned(), Picture { size, rgb: over_white(picture.as_raw()) }));
    }
    Ok(all)
}

/// Straight alpha, composed as pictures on a page are: in display values.
fn over_white(rgba: &[u8]) -> Vec<u8> {
    let over = |channel: u8, alpha: u8| {
        let share = f64::from(alpha) / 255.0;
        (f64::from(channel) * share + 255.0 * (1.0 - share)).round() as u8
    };
    rgba.chunks_exact(4).flat_map(|texel| [0, 1, 2].map(|channel| over(texel[channel], texel[3]))).collect()
}

fn draw(
    renderer: &mut Renderer,
    scenario: &Scenario,
    environment: &EnvironmentLight,
    size: [u32; 2],
) -> Result<Picture> {
    let scene = Scene::load(&scenario.model, &LoadOptions::default())?;
    let options = FrameOptions {
        size: scenario.size,
        camera: scenario.camera.clone(),
        tonemap: Tonemap::Aces,
        environment: environment.clone(),
        background: if scenario.shows_environment { Background::Environment } else { Background::Transparent },
        ..FrameOptions::default()
    };
    let rgb = over_white(&renderer.render(&scene, &options)?.rgba);
    let [width, height] = scenario.size;
    let drawn = RgbImage::from_raw(width, height, rgb).context("a picture has three bytes a pixel")?;
    let rgb = imageops::resize(&drawn, size[0], size[1], FilterType::Lanczos3).into_raw();
    Ok(Picture { size, rgb })
}

/// Pictures of one size in rows of four.
fn side_by_side(pictures: &[&Picture]) -> Picture {
    const COLUMNS: usize = 4;
    let [width, height] = pictures.first().map_or([0; 2], |picture| picture.size.map(|side| side as usize));
    let (columns, rows) = (COLUMNS.min(pictures.len()), pictures.len().div_ceil(COLUMNS));
    let mut rgb = vec![255; columns * width * rows * height * 3];
    for (index, picture) in pictures.iter().enumerate() {
        for y in 0..height {
            let at = (((index / COLUMNS) * height + y) * columns + index % COLUMNS) * width * 3;
            rgb[at..at + width * 3].copy_from_slice(&picture.rgb[y * width * 3..(y + 1) * width * 3]);
        }
    }
    Picture { size: [(columns * width) as u32, (rows * height) as u32], rgb }
}

/// Mean FLIP (Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images").
fn flip(a: &Picture, b: &Picture) -> f64 {
    let [first, second] =
        [a, b].map(|picture| FlipImageRgb8::with_data(picture.size[0], picture.size[1], &picture.rgb));
    let errors = nv_flip::flip(first, second, DEFAULT_PIXELS_PER_DEGREE);
    f64::from(FlipPool::from_image(&errors).mean())
}

fn distances(name: String, ours: &Picture, goldens: &[(String, Picture)]) -> Distances {
    let per_renderer: Vec<_> =
        goldens.iter().map(|(renderer, golden)| (renderer.clone(), flip(ours, golden))).collect();
    let mut among = Vec::new();
    let mut sums = vec![0.0; goldens.len()];
    for (i, (_, a)) in goldens.iter().enumerate() {
        for (j, (_, b)) in goldens.iter().enumerate().skip(i + 1) {
            let distance = flip(a, b);
            among.push(distance);
            sums[i] += distance;
            sums[j] += distance;
        }
    }
    let others = goldens.len().saturating_sub(1).max(1) as f64;
    Distances {
        name,
        ours: per_renderer.iter().map(|(_, distance)| distance).sum::<f64>() / goldens.len() as f64,
        per_renderer,
        means_among: goldens.iter().zip(sums).map(|((renderer, _), sum)| (renderer.clone(), sum / others)).collect(),
        among_median: median(among),
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    match values.len() {
        0 => 0.0,
        count if count % 2 == 1 => values[count / 2],
        count => 0.5 * (values[count / 2 - 1] + values[count / 2]),
    }
}

fn print(distances: &Distances) {
    let Distances { name, per_renderer, ours, means_among, among_median } = distances;
    let verdict = if ours <= among_median { "holds" } else { "misses" };
    let closer = means_among.iter().filter(|(_, mean)| mean < ours).count();
    println!(
        "{name}: ours {ours:.4}, median among the others {among_median:.4}: {verdict}; {closer} of {} are closer",
        means_among.len()
    );
    for ((renderer, distance), (_, mean)) in per_renderer.iter().zip(means_among) {
        println!("    {renderer:24} {distance:.4} from ours, {mean:.4} from the others");
    }
}

fn in_json(distances: &Distances) -> Value {
    let rounded = |value: f64| json!((value * 1e4).round() / 1e4);
    let by_renderer: Map<String, Value> =
        distances.per_renderer.iter().map(|(renderer, distance)| (renderer.clone(), rounded(*distance))).collect();
    json!({
        "name": distances.name,
        "ours_mean_flip": rounded(distances.ours),
        "among_median_flip": rounded(distances.among_median),
        "per_renderer": by_renderer,
    })
}
