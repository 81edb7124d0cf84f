//! One declaration a parameter: [`parameters!`](crate::parameters) turns a table of names, types, defaults, ranges and
//! help lines into a struct with documented fields, its `Default`, the list that help pages and sliders are made from,
//! and `set`, which look files and glTF extras share.
//!
//! How a type reads and shows its values is said once, by a [`Kind`] in [`kind`](super::kind).

use super::kind::{Form, Kind, TextureSource};
use super::nearest::nearest;
use super::value::Value;
use crate::asset::TextureRef;

/// What is known of one parameter.
#[derive(Debug, Clone, Copy)]
pub struct Parameter {
    /// Name in files and in Rust.
    pub name: &'static str,
    /// How a file writes it, for example `number` or `[r, g, b] or "#rrggbb"`.
    pub kind: &'static str,
    /// The same for programs.
    pub form: Form,
    /// Names to choose from, for kinds that offer a choice; otherwise empty.
    pub choices: &'static [&'static str],
    /// Unit, `""` for pure numbers.
    pub unit: &'static str,
    /// Smallest and largest value of each component; unbounded where it has no meaning.
    pub range: (f64, f64),
    /// The default as a file would write it.
    pub default: fn() -> String,
    /// One line.
    pub help: &'static str,
}

/// Why a parameter could not be set.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ParameterError {
    /// No such name.
    #[error("unknown key `{key}`{}", suggestion(nearest))]
    Unknown {
        /// As written.
        key: String,
        /// The name that was probably meant.
        nearest: Option<String>,
    },
    /// A name of other kinds of material.
    #[error("`{key}` is a key of {}, and this material is {kind}: choose that kind or a preset of it", kinds.join(", "))]
    OfOtherKind {
        /// As written.
        key: String,
        /// The kinds that have it.
        kinds: Vec<&'static str>,
        /// What the material is.
        kind: &'static str,
    },
    /// The wrong type of value.
    #[error("`{key}` is {found}, but takes {expected}")]
    WrongType {
        /// Parameter.
        key: String,
        /// What it takes.
        expected: String,
        /// What it was given.
        found: String,
    },
    /// Not one of the names to choose from.
    #[error("`{key}` is \"{found}\", but takes one of {}{}", choices.join(", "), suggestion(nearest))]
    NotAChoice {
        /// Parameter.
        key: String,
        /// What it was given.
        found: String,
        /// What it takes.
        choices: Box<[&'static str]>,
        /// The name that was probably meant.
        nearest: Option<String>,
    },
    /// Outside the range; NaN and infinities are outside every range.
    #[error("`{key}` is {found}, but must lie in {smallest} to {largest}{}{unit}", if unit.is_empty() { "" } else { " " })]
    OutOfRange {
        /// Parameter.
        key: String,
        /// What it was given.
        found: f64,
        /// Smallest value.
        smallest: f64,
        /// Largest value.
        largest: f64,
        /// Unit, may be empty.
        unit: &'static str,
    },
    /// A texture that cannot be had.
    #[error("`{key}`: {reason}")]
    Texture {
        /// Parameter.
        key: String,
        /// One line.
        reason: String,
    },
}

fn suggestion(nearest: &Option<String>) -> String {
    nearest.as_ref().map(|name| format!(", did you mean `{name}`?")).unwrap_or_default()
}

/// A family of parameters, as [`parameters!`](crate::parameters) declares it.
pub trait ParameterSet: Default {
    /// Its parameters, in the order of declaration.
    const PARAMETERS: &'static [Parameter];

    /// Sets one parameter from a value of a file.
    ///
    /// # Errors
    /// An unknown key, a value of the wrong type or outside its range, a texture that cannot be read; the family is
    /// then unchanged.
    fn set(&mut self, key: &str, value: &Value, textures: &mut dyn TextureSource) -> Result<(), ParameterError>;

    /// Brings every field into its range; what is not finite becomes the default. For values that were set from Rust.
    fn clamp(&mut self);

    /// The textures that are set, by name.
    fn textures(&self) -> Vec<(&'static str, TextureRef)>;

    /// The parameter of that name.
    fn parameter(key: &str) -> Option<&'static Parameter> {
        Self::PARAMETERS.iter().find(|parameter| parameter.name == key)
    }

    /// The error for a key that the family does not have.
    fn unknown(key: &str) -> ParameterError {
        let names = Self::PARAMETERS.iter().map(|parameter| parameter.name);
        ParameterError::Unknown { key: key.to_owned(), nearest: nearest(key, names).map(str::to_owned) }
    }
}

/// The constant part of a declaration; used by [`parameters!`](crate::parameters).
pub const fn declared<K: Kind>(
    name: &'static str,
    unit: &'static str,
    range: (f64, f64),
    default: fn() -> String,
    help: &'static str,
) -> Parameter {
    Parameter { name, kind: K::SYNTAX, form: K::FORM, choices: K::CHOICES, unit, range, default, help }
}

/// Declares a family of parameters: `name: Type as Kind = default, range, "unit", "help";`.
#[macro_export]
macro_rules! parameters {
    ($(#[$doc:meta])* $visibility:vis struct $family:ident {
        $($name:ident: $stored:ty as $kind:ty = $default:expr, $range:expr, $unit:literal, $help:literal;)*
    }) => {
        $(#[$doc])*
        #[derive(Debug, Clone, PartialEq)]
        $visibility struct $family {
            $(#[doc = $help] #[doc = concat!(" Unit: `", $unit, "`; range: `", stringify!($range),
                "`; default: `", stringify!($default), "`.")] pub $name: $stored,)*
        }

        impl Default for $family {
            fn default() -> Self {
                Self { $($name: $default,)* }
            }
        }

        impl $crate::material::ParameterSet for $family {
            const PARAMETERS: &'static [$crate::material::Parameter] = &[
                $($crate::material::parameter::declared::<$kind>(
                    stringify!($name),
                    $unit,
                    $range,
                    || <$kind as $crate::material::kind::Kind>::show(&$default),
                    $help,
                ),)*
            ];

            fn set(
                &mut self,
                key: &str,
                value: &$crate::material::Value,
                textures: &mut dyn $crate::material::TextureSource,
            ) -> Result<(), $crate::material::ParameterError> {
                let Some(parameter) = Self::parameter(key) else {
                    return Err(Self::unknown(key));
                };
                match key {
                    $(stringify!($name) => {
                        self.$name = <$kind as $crate::material::kind::Kind>::read(value, parameter, textures)?;
                    })*
                    _ => return Err(Self::unknown(key)),
                }
                Ok(())
            }

            fn textures(&self) -> Vec<(&'static str, $crate::asset::TextureRef)> {
                let all = [$((stringify!($name), <$kind as $crate::material::kind::Kind>::texture(&self.$name)),)*];
                all.into_iter().filter_map(|(name, texture)| Some((name, texture?))).collect()
            }

            fn clamp(&mut self) {
                $(<$kind as $crate::material::kind::Kind>::clamp(&mut self.$name, $default, $range);)*
            }
        }
    };
}

/// Declares an enum whose variants are the names that a parameter may take.
#[macro_export]
macro_rules! choices {
    ($(#[$doc:meta])* $visibility:vis enum $choice:ident {
        $($variant:ident = $name:literal, $help:literal;)*
    }) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        $visibility enum $choice {
            $(#[doc = $help] $variant,)*
        }

        impl $crate::material::kind::Choice for $choice {
            const NAMES: &'static [&'static str] = &[$($name,)*];

            fn named(name: &str) -> Option<Self> {
                match name {
                    $($name => Some(Self::$variant),)*
                    _ => None,
                }
            }

            fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }
        }
    };
}
