//! Runs the program in a folder of its own, on files that it builds.

use serde_json::{Value, json};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A program that waits for more than this hangs.
const LONGEST: Duration = Duration::from_secs(60);

/// What a run left behind.
pub(crate) struct Outcome {
    pub(crate) status: i32,
    pub(crate) stdout: Vec<u8>,
    pub(crate) stderr: String,
}

impl Outcome {
    pub(crate) fn json(&self) -> Value {
        serde_json::from_slice(&self.stdout).unwrap_or_else(|error| panic!("{error}: {}", self.text()))
    }

    pub(crate) fn text(&self) -> String {
        String::from_utf8_lossy(&self.stdout).into_owned()
    }

    #[track_caller]
    pub(crate) fn success(self) -> Self {
        assert_eq!(self.status, 0, "{}", self.stderr);
        self
    }
}

/// A folder with the files of one test.
pub(crate) struct Folder {
    folder: TempDir,
}

impl Folder {
    pub(crate) fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    pub(crate) fn path(&self) -> &Path {
        self.folder.path()
    }

    pub(crate) fn write(&self, name: impl AsRef<Path>, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    }

    /// All names in it, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.path()).unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    pub(crate) fn command(&self) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_vair"));
        let cache = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cli-cache");
        command.current_dir(self.path()).env("XDG_CACHE_HOME", cache).stdin(Stdio::null());
        command
    }

    pub(crate) fn run<S: AsRef<OsStr>>(&self, arguments: impl IntoIterator<Item = S>) -> Outcome {
        let start = Instant::now();
        let output = self.command().args(arguments).output().unwrap();
        assert!(start.elapsed() < LONGEST, "took {:?}", start.elapsed());
        Outcome {
            status: output.status.code().expect("ended by a signal"),
            stdout: output.stdout,
            stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }

    /// Runs what must fail with `status`: one line on standard error that holds all of `named`, nothing on standard
    /// output, no file that was not there.
    #[track_caller]
    pub(crate) fn fails<S: AsRef<OsStr>>(&self, status: i32, arguments: impl IntoIterator<Item = S>, named: &[&str]) {
        let before = self.names();
        let outcome = self.run(arguments);
        let line = &outcome.stderr;
        assert_eq!(outcome.status, status, "{line}");
        assert_eq!(line.lines().count(), 1, "not one line: {line}");
        assert!(line.starts_with("vair: ") && !line.contains("internal error") && !line.contains("panicked"), "{line}");
        for part in named {
            assert!(line.contains(part), "{part:?} is not in: {line}");
        }
        assert_eq!(outcome.text(), "");
        assert_eq!(self.names(), before, "something was written");
    }
}

/// A unit square of four vertices: JSON whose buffer is a data URI, so that tests can bend each part.
pub(crate) fn quad() -> Value {
    let mut bytes = Vec::new();
    for number in [[0.0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]].as_flattened() {
        bytes.extend(number.to_le_bytes());
    }
    for index in [0u16, 1, 2, 0, 2, 3] {
        bytes.extend(index.to_le_bytes());
    }
    json!({
        "asset": { "version": "2.0" },
        "buffers": [{ "byteLength": bytes.len(), "uri": data_uri(&bytes) }],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 12 },
        ],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4 },
            { "bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": 6 },
        ],
        "materials": [{ "name": "Skin" }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "material": 0 }] }],
        "nodes": [{ "mesh": 0 }],
        "scenes": [{ "nodes": [0] }],
        "scene": 0,
    })
}

pub(crate) fn data_uri(bytes: &[u8]) -> String {
    use base64::Engine;
    format!("data:application/octet-stream;base64,{}", base64::engine::general_purpose::STANDARD.encode(bytes))
}

/// The quad as GLB, its buffer in the file.
pub(crate) fn quad_glb() -> Vec<u8> {
    let mut text = serde_json::to_vec(&quad()).unwrap();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF".to_vec();
    for word in [2, 20 + text.len(), text.len()] {
        bytes.extend((word as u32).to_le_bytes());
    }
    bytes.extend(b"JSON");
    bytes.extend(text);
    bytes
}

/// The quad as `quad.gltf` with the value at `pointer` replaced.
pub(crate) fn bent(folder: &Folder, pointer: &str, value: Value) {
    let mut json = quad();
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    match json.pointer_mut(parent).unwrap() {
        Value::Object(object) => drop(object.insert(key.to_owned(), value)),
        Value::Array(array) => array[key.parse::<usize>().unwrap()] = value,
        other => panic!("{pointer} lies in {other}"),
    }
    folder.write("quad.gltf", json.to_string());
}

/// The quad in a folder.
pub(crate) fn with_quad() -> Folder {
    let folder = Folder::new();
    folder.write("quad.gltf", quad().to_string());
    folder
}

pub(crate) fn png(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    let picture = image::RgbaImage::from_pixel(width, height, image::Rgba([200, 100, 50, 255]));
    picture.write_to(&mut std::io::Cursor::new(&mut bytes), image::ImageFormat::Png).unwrap();
    bytes
}

/// Options that make a render as cheap as it gets.
pub(crate) const SMALL: [&str; 4] = ["--size", "16x9", "--msaa", "1"];
