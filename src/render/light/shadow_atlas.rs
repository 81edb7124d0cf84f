//! The shadow maps' images, all in one atlas, and the maps as shaders read them.

use crate::gpu::{Gpu, GpuError, Image, ImageDesc, Sampler, SamplerDesc};
use crate::render::options::DEPTH_FORMAT;
use crate::render::plan::ShadowPlan;
use crate::scene::ShadowMap;
use crate::shader::layout::ShadowSource;
use ash::vk;

/// Most tiles of the atlas side by side.
const MOST_COLUMNS: u32 = 4;
/// Of optical depths.
pub const TRANSMITTANCE_FORMAT: vk::Format = vk::Format::R16G16B16A16_SFLOAT;

/// The images that the shadow passes write, with their formats.
pub fn shadow_images(plan: &ShadowPlan) -> &'static [(&'static str, vk::Format)] {
    const IMAGES: [(&str, vk::Format); 5] = [
        ("shadow map", DEPTH_FORMAT),
        ("translucent shadow front", DEPTH_FORMAT),
        ("translucent shadow back", DEPTH_FORMAT),
        ("translucent shadow layers", TRANSMITTANCE_FORMAT),
        ("translucent shadow total", TRANSMITTANCE_FORMAT),
    ];
    match (plan.is_bound, plan.is_translucent) {
        (false, _) => &[],
        (true, false) => &IMAGES[..1],
        (true, true) => &IMAGES,
    }
}

/// Texels of the atlas.
pub fn shadow_size(plan: &ShadowPlan) -> [u32; 2] {
    let (count, columns) = (plan.map_count, columns(plan));
    if count == 0 {
        return [1, 1];
    }
    [columns * plan.resolution_px, count.div_ceil(columns) * plan.resolution_px]
}

fn columns(plan: &ShadowPlan) -> u32 {
    plan.map_count.clamp(1, MOST_COLUMNS)
}

/// The images of the maps; kept while plans ask for the same.
pub struct ShadowAtlas {
    plan: ShadowPlan,
    /// In the order of [`shadow_images`].
    pub images: Vec<Image>,
    /// Of all of them: every texel is read as it is.
    pub sampler: Sampler,
}

impl ShadowAtlas {
    /// What shaders call the images.
    pub(in crate::render) const NAMES: [&str; 5] =
        ["shadow_map", "shadow_front_map", "shadow_back_map", "shadow_layer_map", "shadow_total_map"];

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
            gpu.image(&ImageDesc {
                name,
                size: shadow_size(plan),
                format,
                mip_levels: 1,
                samples: 1,
                usage,
                is_cube: false,
            })
        };
        let sampler = gpu.sampler(&SamplerDesc {
            wrap: [vk::SamplerAddressMode::CLAMP_TO_EDGE; 2],
            mag: vk::Filter::NEAREST,
            min: vk::Filter::NEAREST,
            mip_mode: vk::SamplerMipmapMode::NEAREST,
            max_lod: 0.0,
            ..SamplerDesc::default()
        })?;
        let images = shadow_images(plan).iter().map(image).collect::<Result<_, _>>()?;
        Ok(Self { plan: *plan, images, sampler })
    }

    /// Whether they serve this plan, too.
    pub fn fits(&self, plan: &ShadowPlan) -> bool {
        self.plan == *plan
    }

    /// Texels of all images.
    pub fn size(&self) -> [u32; 2] {
        shadow_size(&self.plan)
    }

    /// Where the tile of a map starts, and its side, texels.
    pub fn tile(&self, map: usize) -> ([u32; 2], u32) {
        let (columns, side) = (columns(&self.plan), self.plan.resolution_px);
        ([map as u32 % columns * side, map as u32 / columns * side], side)
    }

    /// A map as shaders read it.
    pub fn source(&self, index: usize, map: &ShadowMap) -> ShadowSource {
        let (origin, side) = self.tile(index);
        ShadowSource {
            clip_from_world: map.clip_from_world.to_cols_array_2d(),
            origin_px: origin.map(|side| side as f32),
            size_px: side as f32,
            texel_m: map.texel_m,
        }
    }

    /// By the names that shaders give them. Where nothing is translucent, the one map stands in for those that are never
    /// read.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, &Image)> {
        Self::NAMES
            .into_iter()
            .enumerate()
            .filter_map(|(index, name)| Some((name, self.images.get(index).or(self.images.first())?)))
    }
}
