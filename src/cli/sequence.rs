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
    fn files_are_numbered() {
        assert_eq!(file(Path::new("a/b-{frame}.png"), 7), Path::new("a/b-0007.png"));
        assert_eq!(file(Path::new("a/b.exr"), 12345), Path::new("a/b12345.exr"));
    }
}
