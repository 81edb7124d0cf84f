//! The words of a shader, stored small in the program.

use lzma_rust2::LzmaReader;
use std::io::Read;
use std::sync::OnceLock;

/// Where the words of a shader are.
#[derive(Debug, Clone, Copy)]
pub enum Spirv {
    /// Here.
    Plain(&'static [u32]),
    /// Among those of other shaders.
    Packed {
        /// Which others.
        pack: &'static Pack,
        /// Where in it.
        first_word: usize,
        /// How many.
        word_count: usize,
    },
}

impl Spirv {
    /// The words; the first call for any shader of a pack takes some milliseconds.
    pub(super) fn words(&self) -> &'static [u32] {
        match *self {
            Self::Plain(words) => words,
            Self::Packed { pack, first_word, word_count } => &pack.words()[first_word..first_word + word_count],
        }
    }
}

/// Shaders that are compressed together. What was unpacked once stays in memory.
#[derive(Debug)]
pub struct Pack {
    compressed: &'static [u8],
    word_count: usize,
    unpacked: OnceLock<Vec<u32>>,
}

impl Pack {
    /// Of `build.rs`, which compresses `word_count` words.
    pub(super) const fn new(compressed: &'static [u8], word_count: usize) -> Self {
        Self { compressed, word_count, unpacked: OnceLock::new() }
    }

    fn words(&'static self) -> &'static [u32] {
        self.unpacked.get_or_init(|| unpack(self.compressed, self.word_count))
    }
}

/// # Panics
/// When the program's own data is damaged; a test unpacks everything.
fn unpack(compressed: &[u8], word_count: usize) -> Vec<u32> {
    let mut words = vec![0_u32; word_count];
    LzmaReader::new_mem_limit(compressed, u32::MAX, None)
        .and_then(|mut reader| reader.read_exact(bytemuck::cast_slice_mut(&mut words)))
        .unwrap_or_else(|error| panic!("the shaders in this program are damaged: {error}"));
    words.iter_mut().for_each(|word| *word = u32::from_le(*word));
    words
}
