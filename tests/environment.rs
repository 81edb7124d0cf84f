//! Environment files, good and bad: what is read, what is repaired, what is refused, and what memory it takes.

use exr::prelude::{f16, *};
use std::path::{Path, PathBuf};
use vair::asset::{AssetError, Environment, LoadOptions, MAX_RADIANCE};

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn file(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.0.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    }
}

fn load(path: &Path) -> (Environment, Vec<String>) {
    Environment::load(path, &LoadOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// One line that names the file.
fn refusal(path: &Path, limit_bytes: u64) -> String {
    let options = LoadOptions { memory_limit_bytes: limit_bytes, ..LoadOptions::default() };
    let error = Environment::load(path, &options).unwrap_err().to_string();
    assert!(error.starts_with(&path.display().to_string()) && !error.contains('\n'), "{error}");
    error
}

/// A Radiance picture of plain texels.
fn hdr(size: [usize; 2], header: &str, texels: impl IntoIterator<Item = [u8; 4]>) -> Vec<u8> {
    let mut bytes = format!("#?RADIANCE\n{header}\n-Y {} +X {}\n", size[1], size[0]).into_bytes();
    bytes.extend(texels.into_iter().flatten());
    bytes
}

const FORMAT: &str = "FORMAT=32-bit_rle_rgbe\n";

#[test]
fn radiance_pictures_are_read() {
    let folder = Folder::new();
    // Mantissa / 256 * 2^(exponent - 128).
    let plain = folder.file("plain.hdr", &hdr([2, 1], FORMAT, [[128, 64, 0, 129], [255, 0, 0, 0]]));
    let (environment, warnings) = load(&plain);
    assert_eq!((environment.size, warnings.len()), ([2, 1], 0));
    assert_eq!(environment.texels, [[1.0, 0.5, 0.0], [0.0; 3]]);
    // Run-length coded rows, runs and literals; and the exposure that was put into it taken out.
    let mut coded = hdr([8, 1], "FORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n", []);
    coded.extend([2, 2, 0, 8, 128 + 8, 128, 128 + 8, 64, 4, 1, 2, 3, 4, 128 + 4, 0, 128 + 8, 129]);
    let (environment, _) = load(&folder.file("coded.hdr", &coded));
    assert_eq!(environment.texels[0], [0.5, 0.25, 0.5 / 128.0]);
    assert_eq!(environment.texels[7], [0.5, 0.25, 0.0]);
    // The older coding: the texel before, 3 times more.
    let older = hdr([4, 2], FORMAT, [[128, 0, 0, 129], [1, 1, 1, 3], [0, 128, 0, 129], [1, 1, 1, 3]]);
    let (environment, _) = load(&folder.file("older.hdr", &older));
    assert_eq!(environment.texels, [[[1.0, 0.0, 0.0]; 4], [[0.0, 1.0, 0.0]; 4]].concat());
    let (environment, warnings) = load(&folder.file("one.hdr", &hdr([1, 1], FORMAT, [[128, 128, 128, 129]])));
    assert_eq!((environment.constant_radiance(), warnings.len()), (Some(glam::Vec3::ONE), 0));
}

#[test]
fn bad_radiance_pictures_are_refused() {
    let folder = Folder::new();
    let mut coded = hdr([8, 2], FORMAT, []);
    for _ in 0..2 {
        coded.extend([2, 2, 0, 8, 136, 128, 136, 64, 136, 0, 136, 129]);
    }
    assert!(Environment::load(&folder.file("good.hdr", &coded), &LoadOptions::default()).is_ok());
    let start = coded.len() - 24;
    for (name, bytes, words) in [
        ("nothing", vec![], "neither Radiance"),
        ("text", b"hello".to_vec(), "neither Radiance"),
        ("header", b"#?RADIANCE\nFORMAT=".to_vec(), "header: does not end"),
        ("xyze", hdr([1, 1], "FORMAT=32-bit_rle_xyze\n", [[1; 4]]), "FORMAT"),
        ("exposure", hdr([1, 1], "EXPOSURE=0\n", [[1; 4]]), "EXPOSURE"),
        ("size", b"#?RADIANCE\n\n+Y 1 +X 1\n1234".to_vec(), "size"),
        ("none", hdr([0, 0], FORMAT, []), "sides must be"),
        ("huge", hdr([4_000_000, 2_000_000], FORMAT, []), "sides must be"),
        ("cut row", coded[..coded.len() - 1].to_vec(), "row 1 of 2 is cut off"),
        ("no row", coded[..start + 12].to_vec(), "row 1 of 2 is missing"),
        ("overrun", [&coded[..start + 4], &[255, 1], &coded[start + 6..]].concat(), "row 0 of 2"),
        ("endless", [&coded[..start + 4], &[0, 0, 0, 0], &coded[start + 6..]].concat(), "row 0 of 2"),
        ("width", [&coded[..start], &[2, 2, 0, 9], &coded[start + 4..]].concat(), "another width"),
        ("repeat", hdr([4, 1], FORMAT, [[1, 1, 1, 3]]), "row 0 of 1"),
    ] {
        let error = refusal(&folder.file(name, &bytes), 1 << 30);
        assert!(error.contains(words), "{name}: {error}");
    }
    for end in 0..coded.len() {
        assert!(Environment::load(&folder.file("cut.hdr", &coded[..end]), &LoadOptions::default()).is_err(), "{end}");
    }
    let missing = Environment::load(&folder.0.path().join("missing.hdr"), &LoadOptions::default()).unwrap_err();
    assert!(matches!(missing, AssetError::Io { .. }));
}

fn write_exr(folder: &Folder, name: &str, size: [usize; 2], channels: Vec<AnyChannel<FlatSamples>>) -> PathBuf {
    let path = folder.0.path().join(name);
    Image::from_channels((size[0], size[1]), AnyChannels::sort(channels.into())).write().to_file(&path).unwrap();
    path
}

#[test]
fn open_exr_pictures_are_read() {
    let folder = Folder::new();
    let half = |value: f32| FlatSamples::F16(vec![f16::from_f32(value); 8]);
    let whole = |values: [f32; 8]| FlatSamples::F32(values.to_vec());
    let (environment, warnings) = load(&write_exr(
        &folder,
        "rgba.exr",
        [4, 2],
        vec![
            AnyChannel::new("A", half(0.0)),
            AnyChannel::new("B", half(3.0)),
            AnyChannel::new("G", whole([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0])),
            AnyChannel::new("R", FlatSamples::U32(vec![9; 8])),
        ],
    ));
    assert_eq!((environment.size, warnings.len()), ([4, 2], 0), "{warnings:?}");
    assert_eq!(environment.texels[6], [9.0, 6.0, 3.0]);
    // As Blender names its channels; luminance alone.
    let layer = ["R", "G", "B", "A"].map(|c| AnyChannel::new(format!("View Layer.Combined.{c}").as_str(), half(2.0)));
    let (environment, warnings) = load(&write_exr(&folder, "layer.exr", [4, 2], layer.into()));
    assert_eq!(environment.constant_radiance(), Some(glam::Vec3::splat(2.0)));
    assert!(warnings[0].contains("View Layer.Combined"), "{warnings:?}");
    let (environment, warnings) = load(&write_exr(&folder, "grey.exr", [4, 2], vec![AnyChannel::new("Y", half(0.5))]));
    assert_eq!(environment.constant_radiance(), Some(glam::Vec3::splat(0.5)));
    assert!(warnings[0].contains("grey"), "{warnings:?}");
    let depth = write_exr(&folder, "depth.exr", [4, 2], vec![AnyChannel::new("Z", half(0.5))]);
    assert!(refusal(&depth, 1 << 30).contains("no R, G and B and no Y among Z"));
    let bytes = std::fs::read(&depth).unwrap();
    for end in (4..bytes.len()).step_by(3) {
        refusal(&folder.file("cut.exr", &bytes[..end]), 1 << 30);
    }
    let mut odd = bytes;
    for at in 4..odd.len() {
        odd[at] ^= 0x55;
        // Whatever it says, it does not panic.
        let _ = Environment::load(&folder.file("odd.exr", &odd), &LoadOptions::default());
        odd[at] ^= 0x55;
    }
}

#[test]
fn what_is_no_light_is_repaired_and_said_once() {
    let folder = Folder::new();
    let values = [f32::NAN, -1.0, f32::INFINITY, 1e38, f32::NEG_INFINITY, 1.0, -0.0, 1e-40];
    let channels = ["R", "G", "B"].map(|name| AnyChannel::new(name, FlatSamples::F32(values.to_vec())));
    let (environment, warnings) = load(&write_exr(&folder, "odd.exr", [4, 2], channels.into()));
    let red: Vec<f32> = environment.texels.iter().map(|texel| texel[0]).collect();
    assert_eq!(red[..6], [0.0, 0.0, MAX_RADIANCE, MAX_RADIANCE, 0.0, 1.0]);
    let [warning] = &warnings[..] else { panic!("{warnings:?}") };
    assert!(warning.contains("3 channels are no number and 6 negative") && warning.contains("6 above"), "{warning}");
    // The largest number of the other format.
    let (environment, warnings) = load(&folder.file("bright.hdr", &hdr([1, 1], FORMAT, [[255, 255, 255, 255]])));
    assert_eq!((environment.texels[0], warnings.len()), ([MAX_RADIANCE; 3], 1));
}

#[test]
fn large_pictures_are_reduced_without_being_held() {
    let folder = Folder::new();
    // 16384 x 8192: the upper half 1, the lower one 2, and one texel of 1e8 (as near as the format comes).
    let row = |exponent: u8| {
        let mut row = vec![2, 2, 64, 0];
        for value in [128, 128, 128, exponent] {
            row.extend([128 + 127, value].repeat(129));
            row.extend([128 + 1, value]);
        }
        row
    };
    let mut bytes = b"#?RADIANCE\n\n-Y 8192 +X 16384\n".to_vec();
    for y in 0..8192 {
        bytes.extend(row(if y < 4096 { 129 } else { 130 }));
    }
    let path = folder.file("large.hdr", &bytes);
    // The texels that are kept, the file, and little more: the whole would be 1.6 GB.
    let limit = bytes.len() as u64 + 2048 * 1024 * 12 + (4 << 20);
    let options = LoadOptions { memory_limit_bytes: limit, ..LoadOptions::default() };
    let (environment, warnings) = Environment::load(&path, &options).unwrap();
    assert_eq!((environment.size, warnings), ([2048, 1024], vec![]));
    for (index, texel) in environment.texels.iter().enumerate() {
        let expected = if index < 2048 * 512 { 1.0 } else { 2.0 };
        assert!(texel.iter().all(|channel| (channel - expected).abs() < 1e-5), "{index}: {texel:?}");
    }
    assert!(matches!(
        Environment::load(&path, &LoadOptions { memory_limit_bytes: limit / 2, ..options }),
        Err(AssetError::Memory { .. })
    ));
    // Neither is a picture of another shape.
    let (environment, warnings) = load(&folder.file("square.hdr", &hdr([3, 3], FORMAT, [[128, 128, 128, 129]; 9])));
    assert_eq!(environment.size, [3, 3]);
    assert!(warnings[0].contains("not twice as wide"), "{warnings:?}");
}

#[test]
fn contents_are_told_apart() {
    let studio = Environment::studio();
    assert_eq!(studio.content_hash(), Environment { name: "other".to_owned(), ..studio.clone() }.content_hash());
    let mut other = studio.clone();
    other.texels[77][1] += 1e-6;
    assert_ne!(studio.content_hash(), other.content_hash());
    assert_ne!(studio.content_hash(), Environment { size: [studio.size[1], studio.size[0]], ..studio }.content_hash());
}

#[test]
fn directions_are_those_of_gltf_viewers() {
    // One bright texel a direction.
    let mut environment = Environment { name: String::new(), size: [8, 4], texels: vec![[0.0; 3]; 32] };
    for (column, row, direction) in [(4, 2, glam::Vec3::X), (6, 2, glam::Vec3::Z), (2, 2, glam::Vec3::NEG_Z)] {
        environment.texels.fill([0.0; 3]);
        for (dx, dy) in [(0, 0), (-1i32, 0), (0, -1i32), (-1, -1)] {
            environment.texels[((row + dy) * 8 + column + dx) as usize] = [1.0; 3];
        }
        assert!((environment.radiance(direction * 3.0) - 1.0).length() < 1e-5, "{direction}");
    }
    environment.texels.fill([0.0; 3]);
    environment.texels[..8].fill([1.0; 3]);
    assert_eq!(environment.radiance(glam::Vec3::Y), glam::Vec3::ONE);
    assert_eq!(environment.radiance(glam::Vec3::NEG_Y), glam::Vec3::ZERO);
}

#[test]
fn shared_files_load() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/assets/env");
    let Ok(files) = std::fs::read_dir(folder) else { return };
    for path in files.map(|file| file.unwrap().path()) {
        if path.extension().is_some_and(|ending| ending == "hdr" || ending == "exr") {
            let (environment, warnings) = load(&path);
            assert!(environment.size[0] <= 2048 && environment.size[1] <= 1024, "{}", path.display());
            assert!(environment.texels.iter().flatten().all(|channel| (0.0..=MAX_RADIANCE).contains(channel)));
            let is_white = path.ends_with("white_furnace.hdr");
            assert_eq!(environment.constant_radiance().is_some(), is_white, "{}", path.display());
            assert!(warnings.len() <= 1, "{warnings:?}");
        }
    }
}
