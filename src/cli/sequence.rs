//! The frames of a sequence and the files they go to.

use std::ffi::OsString;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Part I of N: of every N frames, the one whose number leaves I.
pub type Shard = (u32, u32);

/// Numbers of the frames that a shard holds, in order.
pub fn frames(range: Range<u32>, shard: Option<Shard>) -> impl Iterator<Item = u32> {
    let (part, parts) = shard.unwrap_or((0, 1));
    // The first number at or after the start that leaves `part`.
    let skip = (u64::from(part) + u64::from(parts) - u64::from(range.start % parts)) % u64::from(parts);
    range.skip(skip as usize).step_by(parts as usize)
}

/// Longest step of strands that lag behind, seconds: a slow sequence takes several a frame.
const LONGEST_STEP_S: f64 = 1.0 / 60.0;
/// Most steps a frame, ten seconds of them: frames farther apart find strands at rest.
const MOST_STEPS: f64 = 600.0;

/// Moments to pass through from frame `from` to frame `to` without drawing, in seconds after frame 0: always the same ones
/// between two frames, whichever of them are drawn. Frame `from` is among them, `to` is not.
pub fn steps(from: u32, to: u32, fps: f32) -> impl Iterator<Item = f64> {
    let fps = f64::from(fps);
    let pieces = (1.0 / (fps * LONGEST_STEP_S)).ceil().clamp(1.0, MOST_STEPS) as u32;
    (from..to).flat_map(move |frame| {
        (0..pieces).map(move |piece| (f64::from(frame) + f64::from(piece) / f64::from(pieces)) / fps)
    })
}

/// The file of a frame: `{frame}` in the name becomes the number; without it the number goes before the ending.
pub fn file(path: &Path, frame: u32) -> PathBuf {
    let number = format!("{frame:04}");
    let name = path.file_name().unwrap_or_default();
    if let Some(name) = name.to_str().filter(|name| name.contains("{frame}")) {
        return path.with_file_name(name.replace("{frame}", &number));
    }
    let mut numbered = OsString::from(path.file_stem().unwrap_or_default());
    numbered.push(number);
    if let Some(ending) = path.extension() {
        numbered.push(".");
        numbered.push(ending);
    }
    path.with_file_name(numbered)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_divide_a_sequence() {
        assert_eq!(frames(3..8, None).collect::<Vec<_>>(), [3, 4, 5, 6, 7]);
        assert_eq!(frames(3..8, Some((0, 2))).collect::<Vec<_>>(), [4, 6]);
        assert_eq!(frames(3..8, Some((1, 2))).collect::<Vec<_>>(), [3, 5, 7]);
        assert_eq!(frames(0..2, Some((5, 9))).count(), 0);
        let end = u32::MAX;
        assert_eq!(frames(end - 3..end, Some((3, 4))).collect::<Vec<_>>(), Vec::<u32>::new());
        assert_eq!(frames(end - 3..end, Some((1, 4))).collect::<Vec<_>>(), [end - 2]);
    }

    #[test]
    fn slow_sequences_take_small_steps() {
        assert_eq!(steps(2, 3, 24.0).collect::<Vec<_>>(), [2.0, 2.0 + 1.0 / 3.0, 2.0 + 2.0 / 3.0].map(|at| at / 24.0));
        assert_eq!(steps(2, 5, 60.0).collect::<Vec<_>>(), [2.0, 3.0, 4.0].map(|at| at / 60.0));
        assert_eq!(steps(3, 3, 1.0).count(), 0);
        let apart: Vec<_> = steps(0, 3, 7.0).chain(steps(3, 4, 7.0)).collect();
        assert_eq!(apart, steps(0, 4, 7.0).collect::<Vec<_>>());
        assert!(apart.windows(2).all(|two| two[1] - two[0] <= LONGEST_STEP_S + 1e-12));
    }

    #[test]
    fn files_are_numbered() {
        assert_eq!(file(Path::new("a/b-{frame}.png"), 7), Path::new("a/b-0007.png"));
        assert_eq!(file(Path::new("a/b.exr"), 12345), Path::new("a/b12345.exr"));
    }
}
