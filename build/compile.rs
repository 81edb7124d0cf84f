//! GLSL to SPIR-V 1.3 (Vulkan 1.1: the newest that naga reads whole), unoptimised: drivers optimise again.

use super::permutation::{Permutation, Stage};
use std::path::Path;

/// What glslang adds to the messages of a file that does not compile; shown only when it is all there is.
const NOISE: [&str; 4] = ["compilation errors.", "compilation terminated", "Missing entry point", "missing #endif"];

/// Keeps what a reader needs of glslang's log: `file:line: message`.
fn readable(log: &str, permutation: &Permutation) -> String {
    let messages: Vec<_> = log
        .lines()
        .filter_map(|line| line.trim().strip_prefix("ERROR: "))
        .filter(|line| !NOISE.iter().any(|noise| line.contains(noise)))
        .collect();
    if messages.is_empty() {
        format!("{}: glslang failed: {}", permutation.name(), log.trim())
    } else {
        messages.join("\n")
    }
}

#[cfg(not(feature = "bundled-glslang"))]
mod backend {
    use super::*;
    use std::ffi::OsString;
    use std::process::Command;

    /// The installed `glslangValidator`.
    pub(crate) struct Compiler {
        program: OsString,
        keeps_debug_info: bool,
        /// Of the program, and what it is asked for.
        version: String,
    }

    impl Compiler {
        /// Looks for the compiler; the error says how to get one.
        pub(crate) fn find() -> Result<Self, String> {
            let program = std::env::var_os("VAIR_GLSLANG").unwrap_or_else(|| "glslangValidator".into());
            match Command::new(&program).arg("--version").output() {
                Ok(output) => {
                    let keeps_debug_info = std::env::var_os("VAIR_SHADER_DEBUG").is_some();
                    let first = String::from_utf8_lossy(&output.stdout);
                    let version = format!("{} {keeps_debug_info}", first.lines().next().unwrap_or_default());
                    Ok(Self { program, keeps_debug_info, version })
                }
                Err(error) => Err(format!(
                    "cannot run the shader compiler `{}`: {error}; install the Debian package glslang-tools, name one \
                     in VAIR_GLSLANG, or build with --features bundled-glslang",
                    program.display()
                )),
            }
        }

        /// SPIR-V words of one permutation of the expanded `glsl`; keeps both in `out`, and compiles again only what has
        /// changed since.
        pub(crate) fn compile(&self, permutation: &Permutation, glsl: &str, out: &Path) -> Result<Vec<u32>, String> {
            let stage = match permutation.stage() {
                Some(Stage::Vertex) => "vert",
                Some(Stage::Fragment) => "frag",
                Some(Stage::Compute) => "comp",
                None => return Err(format!("{}: unknown stage", permutation.name())),
            };
            let source = out.join(format!("{}.glsl", permutation.name()));
            let target = out.join(format!("{}.spv", permutation.name()));
            let failed = |error: std::io::Error| format!("{}: {error}", permutation.name());
            let glsl = &format!("{glsl}// {}\n", self.version);
            if std::fs::read_to_string(&source).is_ok_and(|before| before == *glsl)
                && let Ok(bytes) = std::fs::read(&target)
            {
                return Ok(words(&bytes));
            }
            // What is left of a failure must not pass for what these lines give.
            let _ = std::fs::remove_file(&target);
            std::fs::write(&source, glsl).map_err(failed)?;
            let mut command = Command::new(&self.program);
            command.args(["-V", "--quiet", "--target-env", "vulkan1.1", "-S", stage]);
            if self.keeps_debug_info {
                command.arg("-gVS");
            }
            let output = command.arg("-o").arg(&target).arg(&source).output().map_err(failed)?;
            if !output.status.success() {
                let log = [output.stdout, output.stderr].concat();
                return Err(readable(&String::from_utf8_lossy(&log), permutation));
            }
            Ok(words(&std::fs::read(&target).map_err(failed)?))
        }
    }

    fn words(bytes: &[u8]) -> Vec<u32> {
        bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect()
    }
}

#[cfg(feature = "bundled-glslang")]
mod backend {
    use super::*;
    use glslang::error::GlslangError;
    use glslang::{CompilerOptions, ShaderInput, ShaderSource, ShaderStage, SpirvVersion, Target, VulkanVersion};

    /// glslang built from source, in this process; it cannot keep debug information.
    pub(crate) struct Compiler(&'static glslang::Compiler);

    impl Compiler {
        /// Starts glslang.
        pub(crate) fn find() -> Result<Self, String> {
            glslang::Compiler::acquire().map(Self).ok_or_else(|| "the bundled glslang did not start".to_owned())
        }

        /// SPIR-V words of one permutation of the expanded `glsl`, kept in `out`.
        pub(crate) fn compile(&self, permutation: &Permutation, glsl: &str, out: &Path) -> Result<Vec<u32>, String> {
            let stage = match permutation.stage() {
                Some(Stage::Vertex) => ShaderStage::Vertex,
                Some(Stage::Fragment) => ShaderStage::Fragment,
                Some(Stage::Compute) => ShaderStage::Compute,
                None => return Err(format!("{}: unknown stage", permutation.name())),
            };
            let source = ShaderSource::from(glsl.to_owned());
            let target = Target::Vulkan { version: VulkanVersion::Vulkan1_1, spirv_version: SpirvVersion::SPIRV1_3 };
            let options = CompilerOptions { target, ..Default::default() };
            let failed = |error: GlslangError| readable(&error.to_string(), permutation);
            let input = ShaderInput::new::<(&str, Option<&str>)>(&source, stage, &options, None, None);
            let shader = self.0.create_shader(input.map_err(failed)?).map_err(failed)?;
            let words = shader.compile().map_err(failed)?;
            let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
            let target = out.join(format!("{}.spv", permutation.name()));
            std::fs::write(target, bytes).map_err(|error| format!("{}: {error}", permutation.name()))?;
            Ok(words)
        }
    }
}

pub(crate) use backend::Compiler;
