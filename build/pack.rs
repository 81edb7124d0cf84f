//! Stores modules small: those of one file differ in little, so that they are compressed together.
//!
//! LZMA, because its window spans a whole pack: deflate looks back 32 KiB, less than one module, and stores three
//! times as much.

use super::parallel;
use lzma_rust2::{LzmaOptions, LzmaWriter};
use std::io::Write;
use std::path::Path;

/// Most bytes of a pack, unpacked: what the first use of one of its modules waits for and what then stays in memory.
const PACK_BYTES: usize = 1 << 20;
/// Effort, 0 to 9.
const PRESET: u32 = 6;

/// Packs, and where modules are in them.
#[derive(Debug, Default)]
pub(crate) struct Packs {
    /// Words of each pack, unpacked.
    pub(crate) packs: Vec<Vec<u32>>,
    /// Of each module.
    pub(crate) places: Vec<Place>,
}

/// Where a module is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Place {
    pub(crate) pack: usize,
    pub(crate) first_word: usize,
    pub(crate) word_count: usize,
}

impl Packs {
    /// Puts modules together that follow each other and have the same group.
    pub(crate) fn new<'a>(modules: impl Iterator<Item = (&'a str, &'a [u32])>) -> Self {
        let mut packs = Self::default();
        let mut open_group = None;
        for (group, words) in modules {
            let is_full = |pack: &Vec<u32>| 4 * (pack.len() + words.len()) > PACK_BYTES;
            if open_group.replace(group) != Some(group) || packs.packs.last().is_none_or(is_full) {
                packs.packs.push(Vec::new());
            }
            let pack = packs.packs.len() - 1;
            let first_word = packs.packs[pack].len();
            packs.packs[pack].extend(words);
            packs.places.push(Place { pack, first_word, word_count: words.len() });
        }
        packs
    }

    /// Writes the packs into `out`, anew only where words have changed, and gives the Rust text of their statics.
    pub(crate) fn write(&self, out: &Path) -> Result<String, Vec<String>> {
        let numbered: Vec<_> = (0..).zip(&self.packs).collect();
        let results = parallel::map(&numbered, |(number, words)| write_one(out, *number, words));
        let results = results.map_err(|error| vec![error])?;
        let errors: Vec<String> = results.into_iter().filter_map(Result::err).collect();
        if !errors.is_empty() {
            return Err(errors);
        }
        let text = numbered.iter().map(|(number, words)| {
            let count = words.len();
            format!(
                "static PACK_{number}: super::Pack = super::Pack::new(include_bytes!(\"{number}.lzma\"), {count});\n"
            )
        });
        Ok(text.collect())
    }
}

fn write_one(out: &Path, number: usize, words: &[u32]) -> Result<(), String> {
    let (source, target) = (out.join(format!("{number}.words")), out.join(format!("{number}.lzma")));
    let failed = |error: std::io::Error| format!("{}: {error}", target.display());
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    if target.is_file() && std::fs::read(&source).is_ok_and(|before| before == bytes) {
        return Ok(());
    }
    // What is left of a failure must not pass for these words.
    let _ = std::fs::remove_file(&source);
    std::fs::write(&target, compressed(&bytes).map_err(failed)?).map_err(failed)?;
    std::fs::write(&source, bytes).map_err(failed)
}

/// The `.lzma` format, tuned for words of 4 bytes.
pub(crate) fn compressed(bytes: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut options = LzmaOptions::with_preset(PRESET);
    (options.lc, options.lp, options.pb) = (1, 2, 2);
    options.dict_size = PACK_BYTES as u32;
    let mut writer = LzmaWriter::new_use_header(Vec::new(), &options, Some(bytes.len() as u64))?;
    writer.write_all(bytes)?;
    writer.finish()
}
