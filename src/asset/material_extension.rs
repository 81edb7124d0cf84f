//! glTF's material extensions that add lobes to the standard surface: plain data, and how it is read.
//!
//! Source: Khronos, KHR_materials_{sheen, clearcoat, anisotropy, iridescence, specular, ior, transmission, volume,
//! diffuse_transmission}. Textures are data where nothing else is said, and multiply the factor of their name.

use super::material::Reader;
use super::{AssetError, TextureRef};
use ::gltf::json::material::NormalTexture;
use ::gltf::json::texture::Info;
use glam::Vec3;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

/// What a material has beside the standard surface. Boxed, as most materials have none of it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MaterialExtensions {
    /// KHR_materials_sheen.
    pub sheen: Option<Box<Sheen>>,
    /// KHR_materials_clearcoat.
    pub clearcoat: Option<Box<Clearcoat>>,
    /// KHR_materials_anisotropy.
    pub anisotropy: Option<Box<Anisotropy>>,
    /// KHR_materials_iridescence.
    pub iridescence: Option<Box<Iridescence>>,
    /// KHR_materials_specular.
    pub specular: Option<Box<Specular>>,
    /// KHR_materials_ior: index of refraction, at least 1; or 0, which reflects everything.
    pub ior: Option<f32>,
    /// KHR_materials_transmission.
    pub transmission: Option<Box<Transmission>>,
    /// KHR_materials_volume.
    pub volume: Option<Box<Volume>>,
    /// KHR_materials_diffuse_transmission.
    pub diffuse_transmission: Option<Box<DiffuseTransmission>>,
}

/// Fuzz on the surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheen {
    /// Linear RGB factor in [0, 1]; black has no sheen.
    pub color: Vec3,
    /// sRGB-coded.
    pub color_texture: Option<TextureRef>,
    /// Factor in [0, 1].
    pub roughness: f32,
    /// A.
    pub roughness_texture: Option<TextureRef>,
}

/// A layer of varnish over everything else.
#[derive(Debug, Clone, PartialEq)]
pub struct Clearcoat {
    /// Share of the surface under it, in [0, 1].
    pub factor: f32,
    /// R.
    pub texture: Option<TextureRef>,
    /// Factor in [0, 1].
    pub roughness: f32,
    /// G.
    pub roughness_texture: Option<TextureRef>,
    /// Tangent-space normal of the layer alone.
    pub normal_texture: Option<TextureRef>,
    /// Scale of the normal map's x and y.
    pub normal_scale: f32,
}

/// Roughness that differs by direction.
#[derive(Debug, Clone, PartialEq)]
pub struct Anisotropy {
    /// In [0, 1].
    pub strength: f32,
    /// Radians, from the tangent to the direction of more roughness, counter-clockwise.
    pub rotation: f32,
    /// RG: direction, (direction + 1) / 2; B: strength.
    pub texture: Option<TextureRef>,
}

/// A thin film on the surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Iridescence {
    /// Share of the surface under it, in [0, 1].
    pub factor: f32,
    /// R.
    pub texture: Option<TextureRef>,
    /// Index of refraction of the film, at least 1.
    pub ior: f32,
    /// Nanometres at 0 and 1 of the thickness texture; the second holds without one.
    pub thickness_nm: [f32; 2],
    /// G.
    pub thickness_texture: Option<TextureRef>,
}

/// Strength and colour of a dielectric's reflection.
#[derive(Debug, Clone, PartialEq)]
pub struct Specular {
    /// In [0, 1].
    pub factor: f32,
    /// A.
    pub texture: Option<TextureRef>,
    /// Linear RGB factor on the reflectance at normal incidence, >= 0.
    pub color: Vec3,
    /// sRGB-coded.
    pub color_texture: Option<TextureRef>,
}

/// Light that goes straight through.
#[derive(Debug, Clone, PartialEq)]
pub struct Transmission {
    /// Share of what is not reflected, in [0, 1].
    pub factor: f32,
    /// R.
    pub texture: Option<TextureRef>,
}

/// The inside of a closed body that light goes straight through.
#[derive(Debug, Clone, PartialEq)]
pub struct Volume {
    /// Of the body under its surface, in units of the mesh, >= 0; 0 is a thin wall, which has no inside.
    pub thickness: f32,
    /// G.
    pub thickness_texture: Option<TextureRef>,
    /// Linear RGB that is left of white after `attenuation_distance_m`, in [0, 1].
    pub attenuation_color: Vec3,
    /// Metres, > 0; `f32::MAX` absorbs nothing.
    pub attenuation_distance_m: f32,
}

/// Light that goes through and is scattered evenly.
#[derive(Debug, Clone, PartialEq)]
pub struct DiffuseTransmission {
    /// Share of what is not reflected, in [0, 1].
    pub factor: f32,
    /// A.
    pub texture: Option<TextureRef>,
    /// Linear RGB factor in [0, 1].
    pub color: Vec3,
    /// sRGB-coded.
    pub color_texture: Option<TextureRef>,
}

impl MaterialExtensions {
    /// Every texture that they name.
    pub fn textures(&self) -> impl Iterator<Item = TextureRef> {
        let Self {
            sheen,
            clearcoat,
            anisotropy,
            iridescence,
            specular,
            ior: _,
            transmission,
            volume,
            diffuse_transmission,
        } = self;
        let sheen = sheen.iter().flat_map(|sheen| [sheen.color_texture, sheen.roughness_texture]);
        let coat = clearcoat.iter().flat_map(|coat| [coat.texture, coat.roughness_texture, coat.normal_texture]);
        let anisotropy = anisotropy.iter().map(|anisotropy| anisotropy.texture);
        let film = iridescence.iter().flat_map(|film| [film.texture, film.thickness_texture]);
        let specular = specular.iter().flat_map(|specular| [specular.texture, specular.color_texture]);
        let through = transmission.iter().map(|through| through.texture);
        let inside = volume.iter().map(|volume| volume.thickness_texture);
        let scattered = diffuse_transmission.iter().flat_map(|through| [through.texture, through.color_texture]);
        sheen
            .chain(coat)
            .chain(anisotropy)
            .chain(film)
            .chain(specular)
            .chain(through)
            .chain(inside)
            .chain(scattered)
            .flatten()
    }
}

/// No bound but that of 32 bits.
const ANY: f32 = f32::MAX;

/// Reads the extensions that have a lobe; others are left alone.
///
/// # Errors
/// Values of the wrong type, numbers that are not finite, texture indices out of range.
pub(super) fn read(reader: &Reader, json: &Map<String, Value>) -> Result<MaterialExtensions, AssetError> {
    let mut extensions = MaterialExtensions::default();
    for (name, value) in json.iter().filter(|(_, value)| !value.is_null()) {
        let Some(stem) = name.strip_prefix("KHR_materials_") else { continue };
        let field = format!("extensions.{name}");
        let keys = match value {
            Value::Object(keys) => keys,
            _ => return Err(reader.error(&field, "is no object; export it again")),
        };
        let extension = Extension { reader, field, keys };
        match stem {
            "sheen" => extensions.sheen = Some(Box::new(extension.sheen()?)),
            "clearcoat" => extensions.clearcoat = Some(Box::new(extension.clearcoat()?)),
            "anisotropy" => extensions.anisotropy = Some(Box::new(extension.anisotropy()?)),
            "iridescence" => extensions.iridescence = Some(Box::new(extension.iridescence()?)),
            "specular" => extensions.specular = Some(Box::new(extension.specular()?)),
            "ior" => extensions.ior = Some(extension.ior()?),
            "transmission" => extensions.transmission = Some(Box::new(extension.transmission()?)),
            "volume" => extensions.volume = Some(Box::new(extension.volume()?)),
            "diffuse_transmission" => {
                extensions.diffuse_transmission = Some(Box::new(extension.diffuse_transmission()?));
            }
            _ => {}
        }
    }
    Ok(extensions)
}

/// One extension of one material.
struct Extension<'a> {
    reader: &'a Reader<'a>,
    /// Below the material.
    field: String,
    keys: &'a Map<String, Value>,
}

impl Extension<'_> {
    fn sheen(&self) -> Result<Sheen, AssetError> {
        Ok(Sheen {
            color: self.color("sheenColorFactor", 0.0, 1.0)?,
            color_texture: self.texture("sheenColorTexture")?,
            roughness: self.share("sheenRoughnessFactor", 0.0)?,
            roughness_texture: self.texture("sheenRoughnessTexture")?,
        })
    }

    fn clearcoat(&self) -> Result<Clearcoat, AssetError> {
        let normal: Option<NormalTexture> = self.typed("clearcoatNormalTexture")?;
        let scale = normal.map_or(1.0, |info| info.scale);
        let [normal_scale] = self.within("clearcoatNormalTexture.scale", [scale], (-ANY, ANY))?;
        Ok(Clearcoat {
            factor: self.share("clearcoatFactor", 0.0)?,
            texture: self.texture("clearcoatTexture")?,
            roughness: self.share("clearcoatRoughnessFactor", 0.0)?,
            roughness_texture: self.texture("clearcoatRoughnessTexture")?,
            normal_texture: self.texture("clearcoatNormalTexture")?,
            normal_scale,
        })
    }

    fn anisotropy(&self) -> Result<Anisotropy, AssetError> {
        Ok(Anisotropy {
            strength: self.share("anisotropyStrength", 0.0)?,
            rotation: self.number("anisotropyRotation", 0.0, (-ANY, ANY))?,
            texture: self.texture("anisotropyTexture")?,
        })
    }

    fn iridescence(&self) -> Result<Iridescence, AssetError> {
        Ok(Iridescence {
            factor: self.share("iridescenceFactor", 0.0)?,
            texture: self.texture("iridescenceTexture")?,
            ior: self.number("iridescenceIor", 1.3, (1.0, ANY))?,
            thickness_nm: [
                self.number("iridescenceThicknessMinimum", 100.0, (0.0, ANY))?,
                self.number("iridescenceThicknessMaximum", 400.0, (0.0, ANY))?,
            ],
            thickness_texture: self.texture("iridescenceThicknessTexture")?,
        })
    }

    fn specular(&self) -> Result<Specular, AssetError> {
        Ok(Specular {
            factor: self.share("specularFactor", 1.0)?,
            texture: self.texture("specularTexture")?,
            color: self.color("specularColorFactor", 1.0, ANY)?,
            color_texture: self.texture("specularColorTexture")?,
        })
    }

    fn ior(&self) -> Result<f32, AssetError> {
        match self.number("ior", 1.5, (0.0, ANY))? {
            0.0 => Ok(0.0),
            _ => self.number("ior", 1.5, (1.0, ANY)),
        }
    }

    fn transmission(&self) -> Result<Transmission, AssetError> {
        let factor = self.share("transmissionFactor", 0.0)?;
        if factor > 0.0 {
            self.warn(
                "transmissionFactor",
                "is shown thin: what lies behind is tinted, and neither refracted, blurred nor dispersed",
            );
        }
        Ok(Transmission { factor, texture: self.texture("transmissionTexture")? })
    }

    fn volume(&self) -> Result<Volume, AssetError> {
        let attenuation_distance_m = match self.number("attenuationDistance", ANY, (0.0, ANY))? {
            0.0 => {
                self.warn(
                    "attenuationDistance",
                    "is 0, at which nothing could be seen: absorbs nothing; make it larger",
                );
                ANY
            }
            distance_m => distance_m,
        };
        Ok(Volume {
            thickness: self.number("thicknessFactor", 0.0, (0.0, ANY))?,
            thickness_texture: self.texture("thicknessTexture")?,
            attenuation_color: self.color("attenuationColor", 1.0, 1.0)?,
            attenuation_distance_m,
        })
    }

    fn diffuse_transmission(&self) -> Result<DiffuseTransmission, AssetError> {
        Ok(DiffuseTransmission {
            factor: self.share("diffuseTransmissionFactor", 0.0)?,
            texture: self.texture("diffuseTransmissionTexture")?,
            color: self.color("diffuseTransmissionColorFactor", 1.0, 1.0)?,
            color_texture: self.texture("diffuseTransmissionColorTexture")?,
        })
    }

    /// A number in [0, 1].
    fn share(&self, key: &str, default: f32) -> Result<f32, AssetError> {
        self.number(key, default, (0.0, 1.0))
    }

    fn number(&self, key: &str, default: f32, range: (f32, f32)) -> Result<f32, AssetError> {
        let number = match self.keys.get(key) {
            None | Some(Value::Null) => default,
            Some(value) => self.finite_or_infinite(key, value)?,
        };
        Ok(self.within(key, [number], range)?[0])
    }

    fn color(&self, key: &str, default: f32, largest: f32) -> Result<Vec3, AssetError> {
        let mut color = [default; 3];
        match self.keys.get(key) {
            None | Some(Value::Null) => {}
            Some(Value::Array(channels)) if channels.len() == color.len() => {
                for (channel, value) in color.iter_mut().zip(channels) {
                    *channel = self.finite_or_infinite(key, value)?;
                }
            }
            Some(_) => return Err(self.error(key, "must be three numbers")),
        }
        Ok(Vec3::from(self.within(key, color, (0.0, largest))?))
    }

    fn texture(&self, key: &str) -> Result<Option<TextureRef>, AssetError> {
        self.reader.texture(&format!("{}.{key}", self.field), self.typed::<Info>(key)?.as_ref())
    }

    fn typed<T: DeserializeOwned>(&self, key: &str) -> Result<Option<T>, AssetError> {
        let Some(value) = self.keys.get(key) else { return Ok(None) };
        serde_json::from_value(value.clone()).map_err(|error| self.error(key, &format!("{error}; export it again")))
    }

    /// A number that 32 bits may be too few for, which [`Self::within`] refuses.
    fn finite_or_infinite(&self, key: &str, value: &Value) -> Result<f32, AssetError> {
        value.as_f64().map(|number| number as f32).ok_or_else(|| self.error(key, "must be a number"))
    }

    fn within<const N: usize>(&self, key: &str, values: [f32; N], range: (f32, f32)) -> Result<[f32; N], AssetError> {
        self.reader.within(&format!("{}.{key}", self.field), values, range)
    }

    fn warn(&self, key: &str, problem: &str) {
        self.reader.warn(&format!("{}.{key}", self.field), problem);
    }

    fn error(&self, key: &str, problem: &str) -> AssetError {
        self.reader.error(&format!("{}.{key}", self.field), problem)
    }
}
