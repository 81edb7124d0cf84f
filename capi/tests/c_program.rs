//! A C program, compiled by the system's compiler with all warnings as errors and linked with either library, draws fur in its own
//! pass under the validation layer. What it checks is in `c/draw.c`.

use std::path::{Path, PathBuf};
use std::process::Command;

/// What Rust's own library needs where it is linked statically.
const SYSTEM_LIBRARIES: [&str; 5] = ["-lgcc_s", "-lutil", "-lpthread", "-ldl", "-lm"];

fn package() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Where cargo has put the libraries: beside this test.
fn libraries() -> PathBuf {
    std::env::current_exe().unwrap().parent().unwrap().to_owned()
}

/// Runs a command to its end and returns what it printed.
fn run(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let text = [&output.stdout[..], &output.stderr].map(String::from_utf8_lossy).concat();
    assert!(output.status.success(), "{command:?}: {}\n{text}", output.status);
    text
}

fn draw(name: &str, link: &[&str]) {
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let mut compile = Command::new("cc");
    compile.args(["-std=c11", "-O1", "-Wall", "-Wextra", "-Werror", "-I"]).arg(package().join("include"));
    compile.arg(package().join("tests/c/draw.c")).arg("-o").arg(&program);
    run(compile.arg("-L").arg(libraries()).args(link).args(["-lvulkan", "-lm"]));
    let said = run(Command::new(&program).env("LD_LIBRARY_PATH", libraries()));
    assert!(said.ends_with("drawn\n"), "{said}");
    println!("{name}: {said}");
}

#[test]
fn a_c_program_draws_with_the_shared_library() {
    draw("draw_shared", &["-lvair_c"]);
}

#[test]
fn a_c_program_draws_with_the_static_library() {
    let link = [&["-l:libvair_c.a"][..], &SYSTEM_LIBRARIES].concat();
    draw("draw_static", &link);
}

#[test]
fn the_header_is_cpp_as_well() {
    let mut compile = Command::new("c++");
    compile.args(["-std=c++17", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-x", "c++"]);
    run(compile.arg(package().join("include/vair.h")));
}
