//! Builds small files.

use glam::Vec3;
use serde_json::{Value, json};
use vair::asset::{Asset, AssetError, LoadOptions, load};

pub(crate) const BYTE: u32 = 5120;
pub(crate) const UNSIGNED_BYTE: u32 = 5121;
pub(crate) const UNSIGNED_SHORT: u32 = 5123;
pub(crate) const UNSIGNED_INT: u32 = 5125;
pub(crate) const FLOAT: u32 = 5126;

/// A glTF under construction: JSON and one buffer.
pub(crate) struct Builder {
    pub(crate) json: Value,
    pub(crate) binary: Vec<u8>,
}

impl Builder {
    pub(crate) fn new() -> Self {
        Self { json: json!({ "asset": { "version": "2.0" }, "bufferViews": [], "accessors": [] }), binary: Vec::new() }
    }

    pub(crate) fn push(&mut self, list: &str, value: Value) -> usize {
        let list = self.json.as_object_mut().unwrap().entry(list).or_insert(json!([])).as_array_mut().unwrap();
        list.push(value);
        list.len() - 1
    }

    pub(crate) fn view(&mut self, bytes: &[u8]) -> usize {
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        let offset = self.binary.len();
        self.binary.extend_from_slice(bytes);
        self.push("bufferViews", json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() }))
    }

    pub(crate) fn accessor(&mut self, bytes: &[u8], component: u32, shape: &str, count: usize) -> usize {
        let view = self.view(bytes);
        let value = json!({ "bufferView": view, "componentType": component, "type": shape, "count": count });
        self.push("accessors", value)
    }

    pub(crate) fn floats(&mut self, numbers: &[f32], shape: &str) -> usize {
        let size = match shape {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 16,
        };
        self.accessor(bytemuck::cast_slice(numbers), FLOAT, shape, numbers.len() / size)
    }

    pub(crate) fn shorts(&mut self, numbers: &[u16]) -> usize {
        self.accessor(bytemuck::cast_slice(numbers), UNSIGNED_SHORT, "SCALAR", numbers.len())
    }

    /// One mesh with one primitive, and a node that shows it.
    pub(crate) fn mesh(&mut self, primitive: Value) -> &mut Self {
        let mesh = self.push("meshes", json!({ "primitives": [primitive] }));
        self.push("nodes", json!({ "mesh": mesh }));
        self
    }

    pub(crate) fn set(&mut self, pointer: &str, value: Value) -> &mut Self {
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        match self.json.pointer_mut(parent).unwrap() {
            Value::Object(object) => {
                object.insert(key.to_owned(), value);
            }
            Value::Array(array) => array[key.parse::<usize>().unwrap()] = value,
            other => panic!("{pointer} lies in {other}"),
        }
        self
    }

    pub(crate) fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        if !self.binary.is_empty() && json.get("buffers").is_none() {
            json["buffers"] = json!([{ "byteLength": self.binary.len() }]);
        }
        let mut text = serde_json::to_vec(&json).unwrap();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut binary = self.binary.clone();
        binary.resize(binary.len().next_multiple_of(4), 0);
        let mut bytes = b"glTF".to_vec();
        let word = |bytes: &mut Vec<u8>, value: usize| bytes.extend((value as u32).to_le_bytes());
        word(&mut bytes, 2);
        word(&mut bytes, 28 + text.len() + binary.len());
        word(&mut bytes, text.len());
        bytes.extend(b"JSON");
        bytes.extend(text);
        word(&mut bytes, binary.len());
        bytes.extend(b"BIN\0");
        bytes.extend(binary);
        bytes
    }

    pub(crate) fn load(&self) -> Result<Asset, AssetError> {
        load_bytes(&self.glb())
    }

    pub(crate) fn error(&self) -> String {
        let text = self.load().expect_err("must be refused").to_string();
        assert!(!text.contains('\n') && text.contains("file.glb"), "{text}");
        text
    }
}

pub(crate) fn load_limited(bytes: &[u8], memory_limit_bytes: u64) -> Result<Asset, AssetError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("file.glb");
    std::fs::write(&path, bytes).unwrap();
    load(&path, &LoadOptions { memory_limit_bytes, ..LoadOptions::default() })
}

pub(crate) fn load_bytes(bytes: &[u8]) -> Result<Asset, AssetError> {
    load_limited(bytes, LoadOptions::default().memory_limit_bytes)
}

pub(crate) fn png(rgba: [u8; 4]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let picture = image::RgbaImage::from_pixel(1, 1, image::Rgba(rgba));
    picture.write_to(&mut std::io::Cursor::new(&mut bytes), image::ImageFormat::Png).unwrap();
    bytes
}

pub(crate) const CORNERS: [f32; 12] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0];
pub(crate) const QUAD: [u16; 6] = [0, 1, 2, 0, 2, 3];

/// An indexed unit square on the XY plane, normals +Z.
pub(crate) fn quad() -> Builder {
    let mut b = Builder::new();
    let positions = b.floats(&CORNERS, "VEC3");
    let normals = b.floats(&[0.0, 0.0, 1.0].repeat(4), "VEC3");
    let indices = b.shorts(&QUAD);
    b.mesh(json!({ "attributes": { "POSITION": positions, "NORMAL": normals }, "indices": indices }));
    b
}

pub(crate) fn corners() -> Vec<Vec3> {
    CORNERS.chunks(3).map(Vec3::from_slice).collect()
}

pub(crate) const ATTRIBUTES: &str = "/meshes/0/primitives/0/attributes";

/// The quad with one joint set of bytes and the given weights, drawn by a skin of two joints.
pub(crate) fn skinned(joints: &[u8], weights: &[f32]) -> Builder {
    let mut b = quad();
    let joints = b.accessor(joints, UNSIGNED_BYTE, "VEC4", 4);
    let weights = b.floats(weights, "VEC4");
    b.set(&format!("{ATTRIBUTES}/JOINTS_0"), json!(joints)).set(&format!("{ATTRIBUTES}/WEIGHTS_0"), json!(weights));
    b.push("nodes", json!({}));
    b.push("nodes", json!({}));
    b.set("/skins", json!([{ "joints": [1, 2] }])).set("/nodes/0/skin", json!(0));
    b
}
