//! What shadows of lights take: maps in one atlas, the draws that cast, and the images that they write.

use super::lit::Lit;
use super::options::FrameOptions;
use super::pipeline::DEPTH_FORMAT;
use super::plan::{Draw, Pass};
use crate::gpu::{Gpu, GpuError, Image, ImageDesc, Sampler, SamplerDesc, format_bytes};
use crate::scene::{ShadowMap, ShadowMaps};
use crate::shader::layout::ShadowSource;
use ash::vk;

/// Most tiles of the atlas side by side.
const MOST_COLUMNS: u32 = 4;
/// A coat casts its shadow with this share of its shells, by density: single strands are finer than texels.
const CASTING_SHARE: u32 = 4;
/// And with no fewer than these.
const LEAST_CASTING_LAYERS: u32 = 4;
/// Of optical depths.
pub const LAYER_FORMAT: vk::Format = vk::Format::R16G16B16A16_SFLOAT;

/// What the shadows of one frame take; nothing where no light casts any.
#[derive(Debug, Clone, Default)]
pub struct ShadowPlan {
    /// Maps, tile by tile of the atlas.
    pub maps: Vec<ShadowMap>,
    /// Lights that reach something and have no map.
    pub without: Vec<usize>,
    /// Texels of a map's sides.
    pub resolution_px: u32,
    /// Something lets light through in part.
    pub is_translucent: bool,
    /// Shaders read the maps, or would: one stands in where there are none.
    pub is_bound: bool,
    /// Draws that write the nearest opaque surface.
    pub opaque: Vec<Draw>,
    /// Draws that write the first translucent surface.
    pub front: Vec<Draw>,
    /// Draws that write the last translucent surface.
    pub back: Vec<Draw>,
    /// Draws that sum up what lies between.
    pub layers: Vec<Draw>,
}

impl ShadowPlan {
    /// These maps, without draws, for a frame lit like that.
    pub fn new(ShadowMaps { maps, without }: ShadowMaps, lit: Lit, options: &FrameOptions) -> Self {
        let resolution_px = options.shadows.resolution_px;
        let (is_translucent, is_bound) = (lit.translucent_shadows, lit.is_occluded());
        Self { maps, without, resolution_px, is_translucent, is_bound, ..Self::default() }
    }

    /// Its passes and what they draw, in order.
    pub fn lists(&self) -> [(Pass, &[Draw]); 4] {
        [
            (Pass::Shadow, &self.opaque),
            (Pass::ShadowFront, &self.front),
            (Pass::ShadowBack, &self.back),
            (Pass::ShadowLayers, &self.layers),
        ]
    }

    /// All its draws.
    pub fn draws(&self) -> impl Iterator<Item = &Draw> {
        self.lists().into_iter().flat_map(|(_, draws)| draws)
    }

    /// The images that its passes write, with their formats.
    pub fn images(&self) -> &'static [(&'static str, vk::Format)] {
        const IMAGES: [(&str, vk::Format); 5] = [
            ("shadow map", DEPTH_FORMAT),
            ("shadow front map", DEPTH_FORMAT),
            ("shadow back map", DEPTH_FORMAT),
            ("shadow layer map", LAYER_FORMAT),
            ("shadow total map", LAYER_FORMAT),
        ];
        match (self.is_bound, self.is_translucent) {
            (false, _) => &[],
            (true, false) => &IMAGES[..1],
            (true, true) => &IMAGES,
        }
    }

    /// Texels of the atlas.
    pub fn size(&self) -> [u32; 2] {
        let (count, columns) = (self.maps.len() as u32, self.columns());
        if count == 0 {
            return [1, 1];
        }
        [columns * self.resolution_px, count.div_ceil(columns) * self.resolution_px]
    }

    /// Where the tile of a map starts in the atlas, texels.
    pub fn origin(&self, map: usize) -> [u32; 2] {
        let columns = self.columns();
        [map as u32 % columns * self.resolution_px, map as u32 / columns * self.resolution_px]
    }

    fn columns(&self) -> u32 {
        (self.maps.len() as u32).clamp(1, MOST_COLUMNS)
    }

    /// Bytes of one of the images.
    pub fn bytes(&self, format: vk::Format) -> u64 {
        format_bytes(format, self.size()).unwrap_or(0)
    }

    /// The first map of a light, and how many it has.
    pub fn maps_of(&self, light: usize) -> (u32, u32) {
        let first = self.maps.iter().position(|map| map.light == light).unwrap_or(0);
        (first as u32, self.maps.iter().filter(|map| map.light == light).count() as u32)
    }

    /// The maps as shaders read them.
    pub fn sources(&self) -> Vec<ShadowSource> {
        let source = |(index, map): (usize, &ShadowMap)| ShadowSource {
            clip_from_world: map.clip_from_world.to_cols_array_2d(),
            origin_px: self.origin(index).map(|side| side as f32),
            size_px: self.resolution_px as f32,
            texel_m: map.texel_m,
        };
        self.maps.iter().enumerate().map(source).collect()
    }
}

/// Shells with which a coat of `layers` casts its shadow.
pub fn casting_layers(layers: u32) -> u32 {
    (layers / CASTING_SHARE).max(LEAST_CASTING_LAYERS).min(layers)
}

/// The images of the maps; kept while plans ask for the same.
pub struct ShadowAtlas {
    /// In the order of [`ShadowPlan::images`].
    pub images: Vec<Image>,
    /// Of all of them: every texel is read as it is.
    pub sampler: Sampler,
}

impl ShadowAtlas {
    /// Makes them.
    ///
    /// # Errors
    /// When the device is out of memory or the atlas is beyond its limits.
    pub fn new(gpu: &Gpu, plan: &ShadowPlan) -> Result<Self, GpuError> {
        let image = |&(name, format): &(&'static str, vk::Format)| {
            let target = if format == DEPTH_FORMAT {
                vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT
            } else {
                vk::ImageUsageFlags::COLOR_ATTACHMENT
            };
            let usage = target | vk::ImageUsageFlags::SAMPLED;
            gpu.image(&ImageDesc { name, size: plan.size(), format, mip_levels: 1, samples: 1, usage, is_cube: false })
        };
        let sampler = gpu.sampler(&SamplerDesc {
            wrap: [vk::SamplerAddressMode::CLAMP_TO_EDGE; 2],
            mag: vk::Filter::NEAREST,
            min: vk::Filter::NEAREST,
            mip_mode: vk::SamplerMipmapMode::NEAREST,
            max_lod: 0.0,
            ..SamplerDesc::default()
        })?;
        Ok(Self { images: plan.images().iter().map(image).collect::<Result<_, _>>()?, sampler })
    }

    /// Whether they serve this plan, too.
    pub fn fits(&self, plan: &ShadowPlan) -> bool {
        let is_same =
            |image: &Image, (_, format): &(_, vk::Format)| image.size() == plan.size() && image.format() == *format;
        self.images.len() == plan.images().len()
            && self.images.iter().zip(plan.images()).all(|(image, wanted)| is_same(image, wanted))
    }

    /// By the names that shaders give them. Where nothing is translucent, the one map stands in for those that are never
    /// read.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, &Image)> {
        const NAMES: [&str; 5] =
            ["shadow_map", "shadow_front_map", "shadow_back_map", "shadow_layer_map", "shadow_total_map"];
        NAMES
            .into_iter()
            .enumerate()
            .filter_map(|(index, name)| Some((name, self.images.get(index).or(self.images.first())?)))
    }
}
