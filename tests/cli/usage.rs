//! A command line that cannot be right: status 2, one line, nothing written.

use crate::program::{Folder, with_quad};
use std::process::Stdio;

#[test]
fn mistakes_are_status_2_and_one_line() {
    let folder = with_quad();
    let cases: [(&[&str], &[&str]); 31] = [
        (&["frobnicate"], &["frobnicate"]),
        (&["render", "--nonsense"], &["--nonsense"]),
        (&["render", "a.glb", "b.glb"], &["b.glb"]),
        (&["render", "--env-strength=-1"], &["--env-strength"]),
        (&["render", "--env-rotation", "nan"], &["--env-rotation"]),
        (&["render", "--shadows", "maybe"], &["--shadows", "on, off"]),
        (&["render", "--prest", "fox"], &["--prest", "--preset"]),
        (&["render", "--size", "garbage"], &["garbage", "--size", "1280x720"]),
        (&["render", "--size", "0x0"], &["0x0", "--size", "at least 1"]),
        (&["render", "--size", "5x-5"], &["--size"]),
        (&["render", "--size", "99999999999x1"], &["--size"]),
        (&["render", "--aov", "depth", "--out", "a.png"], &["--aov", ".exr"]),
        (&["render", "--msaa", "3"], &["--msaa", "1, 4"]),
        (&["render", "--layers", "0"], &["--layers", "1 to 256"]),
        (&["render", "--layers", "257"], &["--layers", "1 to 256"]),
        (&["render", "--quality", "best"], &["--quality"]),
        (&["render", "--fov", "180"], &["--fov", "180"]),
        (&["render", "--orbit", "0,0,-1"], &["--orbit", "greater than 0"]),
        (&["render", "--target", "1,2"], &["--target", "X,Y,Z"]),
        (&["render", "--camera", "0", "--fov", "30"], &["--camera"]),
        (&["render", "--time", "nan"], &["--time"]),
        (&["render", "--exposure", "inf"], &["--exposure"]),
        (&["render", "--background", "2,0,0"], &["--background", "[0, 1]"]),
        (&["render", "--background", "transparent", "--hdr-format", "b10g11r11"], &["b10g11r11", "rgba16f"]),
        (&["render", "--frames", "5..5"], &["--frames", "5..5"]),
        (&["render", "--frames", "0..4", "--shard", "2/2"], &["--shard"]),
        (&["render", "--shard", "0/2"], &["--frames"]),
        (&["render", "--memory-limit", "3GB"], &["--memory-limit", "GiB"]),
        (&["render", "--out", "x.jpg"], &["x.jpg", ".png", ".exr"]),
        (&["render", "--out", "-", "--json"], &["--out -", "--json"]),
        (&["render", "--bench", "0"], &["--bench"]),
    ];
    for (arguments, named) in cases {
        folder.fails(2, arguments, named);
    }
}

#[test]
fn help_goes_to_standard_output() {
    let folder = Folder::new();
    for arguments in [&[][..], &["help"], &["--help"], &["help", "render"], &["render", "--help"], &["inspect", "-h"]] {
        let outcome = folder.run(arguments).success();
        assert!(outcome.text().contains("Usage:") && outcome.stderr.is_empty(), "{arguments:?}: {}", outcome.stderr);
    }
    assert!(folder.run(["--version"]).success().text().starts_with("vair "));
    assert!(folder.names().is_empty());
}

#[test]
fn a_reader_who_leaves_is_no_failure() {
    let folder = with_quad();
    for arguments in [&["presets"][..], &["inspect", "quad.gltf", "--json"], &["help"], &["inspect", "--schema"]] {
        let mut child = folder.command().args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        // Closes the read end before the program has written.
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success(), "{arguments:?}");
        assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    }
}
