//! The generated shader table holds every permutation and stays inside the limits that all target devices share.

#[allow(dead_code)]
#[path = "../build/permutation.rs"]
mod permutation;

use std::collections::BTreeSet;
use std::path::Path;
use vair::math::fnv1a;
use vair::shader::{Shader, Stage, table};

/// First word of every SPIR-V module.
const SPIRV_MAGIC: u32 = 0x0723_0203;
/// Descriptor sets that a target device may be limited to.
const MAX_SETS: u32 = 4;
/// Bytes of push constants that Vulkan guarantees.
const MAX_PUSH_CONSTANT_BYTES: u32 = 128;

fn shaders_glsl() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders_glsl")
}

#[test]
fn every_permutation_is_in_the_table_once() {
    let text = std::fs::read_to_string(shaders_glsl().join("permutations")).unwrap();
    let listed: Vec<_> =
        permutation::parse(&text).unwrap().permutations.iter().map(permutation::Permutation::name).collect();
    let built: Vec<_> = table::ALL.iter().map(|(_, shader)| shader.name.to_owned()).collect();
    assert_eq!(built.len(), listed.len());
    assert_eq!(BTreeSet::from_iter(built), BTreeSet::from_iter(listed));
}

/// What a build without a compiler has for host structs.
#[test]
fn the_kept_layout_is_that_of_the_shaders() {
    let [built, kept] = [Path::new(env!("OUT_DIR")), &Path::new(env!("CARGO_MANIFEST_DIR")).join("build")]
        .map(|folder| folder.join("shader_layout.rs"));
    let is_current = std::fs::read(&built).unwrap() == std::fs::read(&kept).unwrap();
    assert!(is_current, "host structs have changed: cp {} {}", built.display(), kept.display());
}

#[test]
fn every_pass_file_is_built() {
    let folder = std::fs::read_dir(shaders_glsl().join("pass")).unwrap();
    assert!(!table::ALL.is_empty());
    for entry in folder {
        let file = entry.unwrap().file_name().into_string().unwrap();
        // What entry points share is built with them.
        if file.ends_with(".glsl") {
            continue;
        }
        let is_built = table::ALL.iter().any(|(key, _)| key.file.name() == file);
        assert!(is_built, "shaders_glsl/pass/{file} has no line in shaders_glsl/permutations");
    }
}

#[test]
fn every_shader_keeps_to_the_shared_limits() {
    for (_, shader) in table::ALL {
        let Shader { name, stage, bindings, push_constant_bytes, constants, inputs, workgroup_size, .. } = shader;
        assert_eq!(shader.spirv().first(), Some(&SPIRV_MAGIC), "{name}");
        assert_eq!(fnv1a([bytemuck::cast_slice(shader.spirv())]), shader.spirv_hash, "{name}");
        assert!(*push_constant_bytes <= MAX_PUSH_CONSTANT_BYTES && push_constant_bytes % 4 == 0, "{name}");
        assert!(bindings.is_sorted_by(|a, b| (a.set, a.binding) < (b.set, b.binding)), "{name}");
        assert!(bindings.iter().all(|binding| binding.set < MAX_SETS && !binding.name.is_empty()), "{name}");
        assert!(constants.is_sorted_by(|a, b| a.id < b.id), "{name}");
        assert!(inputs.is_sorted_by(|a, b| a.location < b.location), "{name}");
        assert!(inputs.is_empty() || *stage == Stage::Vertex, "{name}");
        assert_eq!(workgroup_size.iter().all(|size| *size > 0), *stage == Stage::Compute, "{name}");
    }
}

#[test]
fn library_code_declares_no_bindings() {
    let Ok(folder) = std::fs::read_dir(shaders_glsl().join("lib")) else { return };
    for entry in folder {
        let path = entry.unwrap().path();
        let text: String = std::fs::read_to_string(&path).unwrap().split_whitespace().collect();
        for word in ["layout(set", "layout(binding", "push_constant"] {
            assert!(!text.contains(word), "{}: `{word}` belongs in host/ or pass/", path.display());
        }
    }
}
