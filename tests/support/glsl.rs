//! GLSL to SPIR-V at test time, for shaders that only a test needs.

use std::path::Path;
use std::process::Command;
use vair::shader::{Spirv, Stage};

/// Compiles `source` and gives its words for the rest of the test run.
pub(crate) fn compile(name: &str, stage: Stage, source: &str) -> Spirv {
    let dir = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).unwrap();
    let (input, output) = (dir.path().join(name), dir.path().join("out.spv"));
    std::fs::write(&input, source).unwrap();
    run(&input, &output, stage);
    let bytes = std::fs::read(&output).unwrap();
    Spirv::Plain(bytemuck::pod_collect_to_vec::<u8, u32>(&bytes).leak())
}

fn run(input: &Path, output: &Path, stage: Stage) {
    let stage = match stage {
        Stage::Vertex => "vert",
        Stage::Fragment => "frag",
        Stage::Compute => "comp",
    };
    let result = Command::new("glslangValidator")
        .args(["-V", "--target-env", "vulkan1.1", "-S", stage, "-o"])
        .args([output, input])
        .output()
        .expect("glslangValidator runs (Debian: glslang-tools)");
    assert!(result.status.success(), "{}", String::from_utf8_lossy(&result.stdout));
}
