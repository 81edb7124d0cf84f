//! Layered: the standard surface with every lobe that glTF's material extensions add, in any combination.
//!
//! A glTF material that uses one of them becomes this. One lobe alone has more to say in the family made for it: sheen in
//! `cotton` and `velvet`, anisotropy in `satin`, iridescence in `laser`, diffuse transmission in `gauze`; but only here do
//! they meet, and mean exactly what the file says. Khronos, KHR_materials_{sheen, clearcoat, anisotropy, iridescence,
//! specular, ior, transmission, volume, diffuse_transmission}.

use super::kind::{Map, Number, Rgb};
use crate::asset::{MaterialExtensions, TextureRef};
use glam::Vec3;

const UNBOUNDED: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
const UNIT: (f64, f64) = (0.0, 1.0);

crate::parameters! {
    /// The standard surface with glTF's further lobes.
    pub struct Layered {
        ior: f32 as Number = 1.5, (0.0, 10.0), "", "Index of refraction, which sets how strongly the surface reflects what it faces: 1 not at all, 1.5 most things, 2.4 diamond; 0 everything.";
        specular: f32 as Number = 1.0, UNIT, "", "Strength of the reflection; metals keep theirs.";
        specular_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: A is the local strength of the reflection.";
        specular_color: Vec3 as Rgb = Vec3::ONE, (0.0, 1e6), "", "Colour of the reflection where the surface faces the eye; above 1 is brighter than ior alone. Metals keep theirs.";
        specular_color_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Local colour of the reflection, sRGB-decoded.";
        anisotropy: f32 as Number = 0.0, UNIT, "", "Length of the highlight: 0 round, 1 a streak across the surface.";
        anisotropy_rotation: f32 as Number = 0.0, (-36e3, 36e3), "deg", "Turns the streak counter-clockwise, from the tangent.";
        anisotropy_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: RG is the local direction of the streak, (direction + 1) / 2, B its strength.";
        iridescence: f32 as Number = 0.0, UNIT, "", "How much of the surface a thin film covers, which colours the reflection by the angle.";
        iridescence_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: R is the local share of the film.";
        iridescence_ior: f32 as Number = 1.3, (1.0, 10.0), "", "Index of refraction of the film.";
        iridescence_thickness_min: f32 as Number = 100.0, (0.0, 1e5), "nm", "Thickness of the film where its map is black.";
        iridescence_thickness_max: f32 as Number = 400.0, (0.0, 1e5), "nm", "Thickness of the film where its map is white, and without a map.";
        iridescence_thickness_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: G is the local thickness of the film, between its two limits.";
        diffuse_transmission: f32 as Number = 0.0, UNIT, "", "Share of the scattered light that leaves on the other side, as of paper or leaves.";
        diffuse_transmission_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: A is the local share.";
        diffuse_transmission_color: Vec3 as Rgb = Vec3::ONE, UNIT, "", "Linear colour of the light that comes through.";
        diffuse_transmission_color_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Local colour of the light that comes through, sRGB-decoded.";
        transmission: f32 as Number = 0.0, UNIT, "", "Share of the light that goes straight through, tinted by the base colour, as of glass; it is neither refracted nor blurred.";
        transmission_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: R is the local share.";
        thickness: f32 as Number = 0.0, (0.0, 1e6), "mesh units", "Thickness of the body behind a front side, through which what goes straight through is absorbed; 0 is a thin wall.";
        thickness_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: G is the local thickness.";
        attenuation_color: Vec3 as Rgb = Vec3::ONE, UNIT, "", "Linear colour that the body leaves of white light after attenuation_distance.";
        attenuation_distance: f32 as Number = 1.0, (1e-6, 1e6), "m", "Way after which the body has that colour.";
        sheen_color: Vec3 as Rgb = Vec3::ZERO, UNIT, "", "Linear colour of the fuzz on the surface; black has none.";
        sheen_color_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Local colour of the fuzz, sRGB-decoded.";
        sheen_roughness: f32 as Number = 0.0, UNIT, "", "How unruly the fuzz is: low shines at the rim alone, high all over.";
        sheen_roughness_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: A is the local roughness of the fuzz.";
        clearcoat: f32 as Number = 0.0, UNIT, "", "How much of the surface varnish covers, over everything else.";
        clearcoat_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: R is the local share of the varnish.";
        clearcoat_roughness: f32 as Number = 0.0, UNIT, "", "Perceptual roughness of the varnish.";
        clearcoat_roughness_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: G is its local roughness.";
        clearcoat_normal_texture: Option<TextureRef> as Map = None, UNBOUNDED, "", "Data: tangent-space normal of the varnish alone; none: smooth, whatever is under it.";
        clearcoat_normal_scale: f32 as Number = 1.0, (-10.0, 10.0), "", "Scale of that map's x and y.";
    }
}

impl Layered {
    /// What the extensions of a glTF material say; none where they leave the standard surface as it is.
    pub fn of(extensions: &MaterialExtensions) -> Option<Self> {
        let mut layered = Self { ior: extensions.ior.unwrap_or(1.5), ..Self::default() };
        if let Some(specular) = &extensions.specular {
            layered.specular = specular.factor;
            layered.specular_texture = specular.texture;
            layered.specular_color = specular.color;
            layered.specular_color_texture = specular.color_texture;
        }
        if let Some(anisotropy) = &extensions.anisotropy {
            layered.anisotropy = anisotropy.strength;
            layered.anisotropy_rotation = anisotropy.rotation.to_degrees() % 360.0;
            layered.anisotropy_texture = anisotropy.texture;
        }
        if let Some(film) = &extensions.iridescence {
            layered.iridescence = film.factor;
            layered.iridescence_texture = film.texture;
            layered.iridescence_ior = film.ior;
            [layered.iridescence_thickness_min, layered.iridescence_thickness_max] = film.thickness_nm;
            layered.iridescence_thickness_texture = film.thickness_texture;
        }
        if let Some(through) = &extensions.diffuse_transmission {
            layered.diffuse_transmission = through.factor;
            layered.diffuse_transmission_texture = through.texture;
            layered.diffuse_transmission_color = through.color;
            layered.diffuse_transmission_color_texture = through.color_texture;
        }
        if let Some(through) = &extensions.transmission {
            layered.transmission = through.factor;
            layered.transmission_texture = through.texture;
        }
        if let Some(volume) = &extensions.volume {
            layered.thickness = volume.thickness;
            layered.thickness_texture = volume.thickness_texture;
            layered.attenuation_color = volume.attenuation_color;
            layered.attenuation_distance = volume.attenuation_distance_m;
        }
        if let Some(sheen) = &extensions.sheen {
            layered.sheen_color = sheen.color;
            layered.sheen_color_texture = sheen.color_texture;
            layered.sheen_roughness = sheen.roughness;
            layered.sheen_roughness_texture = sheen.roughness_texture;
        }
        if let Some(coat) = &extensions.clearcoat {
            layered.clearcoat = coat.factor;
            layered.clearcoat_texture = coat.texture;
            layered.clearcoat_roughness = coat.roughness;
            layered.clearcoat_roughness_texture = coat.roughness_texture;
            layered.clearcoat_normal_texture = coat.normal_texture;
            layered.clearcoat_normal_scale = coat.normal_scale;
        }
        super::ParameterSet::clamp(&mut layered);
        layered.changes_something().then_some(layered)
    }

    /// Whether the highlight is a streak.
    pub fn has_anisotropy(&self) -> bool {
        self.anisotropy > 0.0
    }

    /// Whether there is a thin film.
    pub fn has_iridescence(&self) -> bool {
        self.iridescence > 0.0
    }

    /// Whether light is scattered to the other side.
    pub fn has_diffuse_transmission(&self) -> bool {
        self.diffuse_transmission > 0.0
    }

    /// Whether light goes straight through.
    pub fn has_transmission(&self) -> bool {
        self.transmission > 0.0
    }

    /// Whether light that goes straight through is absorbed on its way.
    pub fn has_volume(&self) -> bool {
        self.has_transmission() && self.thickness > 0.0 && self.attenuation_color != Vec3::ONE
    }

    /// Whether there is fuzz.
    pub fn has_sheen(&self) -> bool {
        self.sheen_color.max_element() > 0.0
    }

    /// Whether there is varnish.
    pub fn has_clearcoat(&self) -> bool {
        self.clearcoat > 0.0
    }

    fn changes_something(&self) -> bool {
        let reflection =
            (self.ior, self.specular, self.specular_color, self.specular_texture, self.specular_color_texture);
        self.has_anisotropy()
            || self.has_iridescence()
            || self.has_diffuse_transmission()
            || self.has_transmission()
            || self.has_sheen()
            || self.has_clearcoat()
            || reflection != (1.5, 1.0, Vec3::ONE, None, None)
    }
}
