//! What surfaces are made of: parameters, looks and presets.
//!
//! Every family declares its parameters once, through [`parameters!`](crate::parameters); look files, glTF extras and
//! presets all end in [`ParameterSet::set`]. Nothing here knows the GPU.

mod cotton;
mod error;
mod family;
mod fur;
mod gauze;
mod glint;
pub mod kind;
mod laser;
mod layered;
mod look;
mod nearest;
pub mod parameter;
mod preset;
pub mod procedural;
mod satin;
mod schema;
mod sheen;
mod skin;
mod standard;
mod texture;
mod threads;
mod value;
mod velvet;

pub use cotton::Cotton;
pub use error::MaterialError;
pub(crate) use family::families;
pub use family::{Family, KINDS};
pub use fur::{Blend, ForceSpace, Fur, Shape};
pub use gauze::{Gauze, Weave};
pub use glint::{Flakes, Glint};
pub use kind::{Choice, Form, Length, TextureSource};
pub use laser::{ColorMode, FilmKind, HueCurve, HueDirection, Laser};
pub use layered::Layered;
pub use look::Look;
pub use nearest::nearest;
pub use parameter::{Parameter, ParameterError, ParameterSet};
pub use preset::{Preset, presets};
pub use satin::Satin;
pub use schema::look_schema;
pub use sheen::{Sheen, SheenEntry, SheenModel, SheenTable};
pub use standard::{AlphaMode, Standard};
pub use texture::{ImageName, ReadImage};
pub use threads::Threads;
pub use value::Value;
pub use velvet::Velvet;

use crate::asset::Asset;
use texture::Appended;

/// What one surface is made of.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Material {
    /// Name in the file, or "material N".
    pub name: String,
    /// The surface.
    pub standard: Standard,
    /// What it is woven of, where that is more than the standard surface. Not seen under fur, whose skin is standard.
    pub family: Option<Family>,
    /// The fur on it, if it has one.
    pub fur: Option<Fur>,
}

impl Material {
    /// What files call it: one of [`KINDS`].
    pub fn kind(&self) -> &'static str {
        match (&self.fur, &self.family) {
            (Some(_), _) => "fur",
            (None, Some(cloth)) => cloth.kind(),
            (None, None) => "standard",
        }
    }
}

/// The materials of a file, one per [`Asset::materials`], with the look keys that the file itself carries
/// (`extensions.VAIR_material`, `extras.vair`). Images that those keys name are appended to the asset.
///
/// # Errors
/// A look key that does not fit; the message names the material and the key.
pub fn from_asset(asset: &mut Asset, read_image: ReadImage) -> Result<Vec<Material>, MaterialError> {
    let mut materials = Vec::with_capacity(asset.materials.len());
    let mut keys = Vec::new();
    for (index, source) in asset.materials.iter_mut().enumerate() {
        let name = source.name.clone().unwrap_or_else(|| format!("material {index}"));
        let cloth = Layered::of(&source.extensions).map(Family::Layered);
        materials.push(Material { name, standard: Standard::from(&*source), family: cloth, fur: None });
        if let Some(vair) = source.vair.clone() {
            keys.push((index, vair));
        }
    }
    let mut textures = Appended::new(asset, read_image);
    for (index, vair) in keys {
        if let Some(material) = materials.get_mut(index) {
            look::section_of_file(&material.name, &vair)?.apply(material, &mut textures)?;
        }
    }
    Ok(materials)
}
