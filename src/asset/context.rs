//! What every step of one load shares: the file's name, its budget, its warnings.

use super::mend::LARGEST_INDEX;
use super::{AssetError, LoadOptions};
use std::cell::{Cell, RefCell};
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// More oddities than this are only counted: nobody reads them, and a small file can have millions.
const MAX_WARNINGS: usize = 200;

/// Bytes of a warning that are kept; a file's own words may be of any length.
const MAX_WARNING_BYTES: usize = 500;

/// Cuts a text to `max_bytes` at most, at a character's boundary. Returns whether something was lost.
pub(super) fn shorten(text: &mut String, max_bytes: usize) -> bool {
    let is_long = text.len() > max_bytes;
    if is_long {
        let end = (0..=max_bytes).rev().find(|end| text.is_char_boundary(*end));
        text.truncate(end.unwrap_or(0));
        text.shrink_to_fit();
    }
    is_long
}

/// Shared by reference; the cells let steps that borrow from one another still count and warn.
pub(super) struct Context {
    file: String,
    pub(super) folder: PathBuf,
    pub(super) allow_outside: bool,
    limit_bytes: u64,
    spent_bytes: Cell<u64>,
    warnings: RefCell<Vec<String>>,
    /// Those beyond [`MAX_WARNINGS`].
    untold_warnings: Cell<u64>,
}

impl Context {
    pub(super) fn new(path: &Path, options: &LoadOptions) -> Self {
        let folder = match path.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
            _ => PathBuf::from("."),
        };
        Self {
            file: path.display().to_string(),
            folder,
            allow_outside: options.allow_outside,
            limit_bytes: options.memory_limit_bytes,
            spent_bytes: Cell::new(0),
            warnings: RefCell::default(),
            untold_warnings: Cell::new(0),
        }
    }

    /// The file breaks the format at `field`.
    pub(super) fn error(&self, field: impl Display, problem: impl Display) -> AssetError {
        AssetError::Format { file: self.file.clone(), field: field.to_string(), problem: problem.to_string() }
    }

    pub(super) fn unsupported(&self, field: impl Display, feature: impl Display) -> AssetError {
        AssetError::Unsupported { file: self.file.clone(), field: field.to_string(), feature: feature.to_string() }
    }

    pub(super) fn outside(&self, field: impl Display, uri: &str) -> AssetError {
        AssetError::Outside { file: self.file.clone(), field: field.to_string(), uri: uri.to_owned() }
    }

    /// Notes an oddity; the same line is kept once.
    pub(super) fn warn(&self, field: impl Display, problem: impl Display) {
        let mut warnings = self.warnings.borrow_mut();
        if warnings.len() == MAX_WARNINGS {
            self.untold_warnings.set(self.untold_warnings.get() + 1);
            return;
        }
        let mut line = format!("{field}: {problem}");
        if shorten(&mut line, MAX_WARNING_BYTES) {
            line.push_str("...");
        }
        if !warnings.contains(&line) {
            warnings.push(line);
        }
    }

    /// All warnings; the last one counts those that are not kept.
    pub(super) fn into_warnings(self) -> Vec<String> {
        let mut warnings = self.warnings.into_inner();
        match self.untold_warnings.get() {
            0 => {}
            more => warnings.push(format!("and {more} more")),
        }
        warnings
    }

    /// Counts bytes against the limit; call before allocating them.
    pub(super) fn spend(&self, field: impl Display, bytes: u64) -> Result<(), AssetError> {
        self.spent_bytes.set(self.check(field, bytes)?);
        Ok(())
    }

    /// Refuses bytes that would go over the limit, for what lives only a moment. Returns the sum with all before it.
    pub(super) fn check(&self, field: impl Display, bytes: u64) -> Result<u64, AssetError> {
        let needed_bytes = self.spent_bytes.get().saturating_add(bytes);
        if needed_bytes > self.limit_bytes {
            return Err(AssetError::Memory {
                file: self.file.clone(),
                field: field.to_string(),
                needed_bytes,
                limit_bytes: self.limit_bytes,
            });
        }
        Ok(needed_bytes)
    }

    /// Bytes counted so far.
    pub(super) fn spent_bytes(&self) -> u64 {
        self.spent_bytes.get()
    }

    /// Bytes that may still be allocated.
    pub(super) fn left_bytes(&self) -> u64 {
        self.limit_bytes - self.spent_bytes.get()
    }

    /// Checks a reference into the list `list` of `len` entries.
    pub(super) fn index(&self, field: impl Display, index: usize, list: &str, len: usize) -> Result<usize, AssetError> {
        if index < len {
            return Ok(index);
        }
        // Larger ones were cut to this one.
        let more = if index == LARGEST_INDEX as usize { " or more" } else { "" };
        Err(self.error(field, format_args!("index {index}{more} is out of range: {list} has {len} entries")))
    }

    /// Checks a number that JSON spelled but 32 bits cannot hold.
    pub(super) fn finite(&self, field: impl Display, numbers: &[f32]) -> Result<(), AssetError> {
        match numbers.iter().position(|number| !number.is_finite()) {
            None => Ok(()),
            Some(at) => {
                Err(self.error(field, format_args!("number {at} is {}; write a finite 32-bit number", numbers[at])))
            }
        }
    }
}
