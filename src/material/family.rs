//! The families of cloth: each takes the place of the standard surface's lobes and keeps its maps and parameters.

use super::cotton::Cotton;
use super::gauze::Gauze;
use super::glint::Glint;
use super::kind::TextureSource;
use super::laser::Laser;
use super::layered::Layered;
use super::parameter::{Parameter, ParameterError, ParameterSet};
use super::satin::Satin;
use super::value::Value;
use super::velvet::Velvet;
use super::{Fur, Standard};
use crate::asset::TextureRef;

/// Declares the families as an enum.
macro_rules! family_enum {
    ($($(#[doc = $doc:literal])* $family:ident = $kind:literal;)*) => {
        /// What a surface is woven of, in the place of the standard surface's lobes.
        #[derive(Debug, Clone, PartialEq)]
        #[allow(clippy::large_enum_variant, reason = "a scene has few materials, and their parameters are set by name")]
        pub enum Family {
            $($(#[doc = $doc])* $family($family),)*
        }

        impl Family {
            /// What files call the families.
            pub const KINDS: &'static [&'static str] = &[$($kind,)*];

            /// The family of that kind as it is by default.
            pub fn of_kind(kind: &str) -> Option<Self> {
                match kind {
                    $($kind => Some(Self::$family($family::default())),)*
                    _ => None,
                }
            }

            /// What files call it.
            pub fn kind(&self) -> &'static str {
                match self {
                    $(Self::$family(_) => $kind,)*
                }
            }

            /// Its parameters, in the order of declaration.
            pub fn parameters(&self) -> &'static [Parameter] {
                match self {
                    $(Self::$family(_) => $family::PARAMETERS,)*
                }
            }

            /// [`ParameterSet::set`] of the family that it is.
            ///
            /// # Errors
            /// Those of [`ParameterSet::set`].
            pub fn set(
                &mut self,
                key: &str,
                value: &Value,
                textures: &mut dyn TextureSource,
            ) -> Result<(), ParameterError> {
                match self {
                    $(Self::$family(family) => family.set(key, value, textures),)*
                }
            }

            /// [`ParameterSet::textures`] of the family that it is.
            pub fn textures(&self) -> Vec<(&'static str, TextureRef)> {
                match self {
                    $(Self::$family(family) => family.textures(),)*
                }
            }

            /// [`ParameterSet::clamp`] of the family that it is.
            pub fn clamp(&mut self) {
                match self {
                    $(Self::$family(family) => family.clamp(),)*
                }
            }
        }

        /// Every kind of material and its parameters; the keys of `standard` are those of all.
        pub const KINDS: &[(&str, &[Parameter])] =
            &[("standard", Standard::PARAMETERS), ("fur", Fur::PARAMETERS), $(($kind, $family::PARAMETERS),)*];
    };
}

/// Gives the list of families to a macro: `Variant = "kind"`, with the parameters of the struct of that name. It stands
/// here alone.
macro_rules! families {
    ($callback:ident) => {
        $callback! {
            /// Organza, chiffon, tulle: sheer face on, dense at its edges.
            Gauze = "gauze";
            /// Iridescent film on cloth or metal.
            Laser = "laser";
            /// Sequins, lurex, glitter yarn: flakes that flash one by one.
            Glint = "glint";
            /// Jersey, denim, flannel, felt: cloth with fuzz.
            Cotton = "cotton";
            /// Silk, charmeuse, taffeta: an anisotropic highlight.
            Satin = "satin";
            /// Velvet, corduroy: a dense pile, dark from the front and bright at its folds.
            Velvet = "velvet";
            /// Whatever glTF's material extensions put on top of each other.
            Layered = "layered";
        }
    };
}
pub(crate) use families;

families!(family_enum);
