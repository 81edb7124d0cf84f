//! Samplers, each kind created once per device.

use super::calls::Device;
use super::device::{Context, Gpu, lock};
use super::error::GpuError;
use ash::vk;
use std::collections::HashMap;
use std::sync::Arc;

/// How to sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SamplerDesc {
    /// Beyond the edge, in u and v.
    pub wrap: [vk::SamplerAddressMode; 2],
    /// Filter when a texel covers more than a pixel.
    pub mag: vk::Filter,
    /// Filter when a pixel covers more than a texel.
    pub min: vk::Filter,
    /// Between mip levels.
    pub mip_mode: vk::SamplerMipmapMode,
    /// Smallest level that is read is 0, largest is this; [`vk::LOD_CLAMP_NONE`] for all.
    pub max_lod: f32,
    /// 1 is off; clamped to what the device has.
    pub anisotropy: f32,
    /// Compares with depth instead of filtering values.
    pub compare: Option<vk::CompareOp>,
}

impl Default for SamplerDesc {
    /// Repeating, trilinear.
    fn default() -> Self {
        Self {
            wrap: [vk::SamplerAddressMode::REPEAT; 2],
            mag: vk::Filter::LINEAR,
            min: vk::Filter::LINEAR,
            mip_mode: vk::SamplerMipmapMode::LINEAR,
            max_lod: vk::LOD_CLAMP_NONE,
            anisotropy: 1.0,
            compare: None,
        }
    }
}

/// A sampler.
pub struct Sampler(pub(crate) Arc<SamplerInner>);

pub(crate) struct SamplerInner {
    pub(crate) raw: vk::Sampler,
    // The device owns the handle; this keeps the device.
    _context: Arc<Context>,
}

type Key = [i32; 8];

/// All samplers of a device; few, so they live as long as it does.
#[derive(Default)]
pub(crate) struct Samplers(HashMap<Key, vk::Sampler>);

impl Samplers {
    pub(crate) fn destroy(&mut self, device: &Device) {
        for (_, sampler) in self.0.drain() {
            // SAFETY: bind groups hold the context, so none refers to it any more.
            unsafe { device.destroy_sampler(sampler, None) };
        }
    }
}

impl Gpu {
    /// The sampler for `desc`; equal descriptions share one.
    ///
    /// # Errors
    /// [`GpuError::OutOfMemory`], or the driver's answer.
    pub fn sampler(&self, desc: &SamplerDesc) -> Result<Sampler, GpuError> {
        let context = self.context();
        let mut samplers = lock(&context.samplers);
        let anisotropy = desc.anisotropy.clamp(1.0, context.info.max_anisotropy.max(1.0));
        let key: Key = [
            desc.wrap[0].as_raw(),
            desc.wrap[1].as_raw(),
            desc.mag.as_raw(),
            desc.min.as_raw(),
            desc.mip_mode.as_raw(),
            desc.max_lod.to_bits().cast_signed(),
            anisotropy.to_bits().cast_signed(),
            desc.compare.map_or(-1, vk::CompareOp::as_raw),
        ];
        let sampler = |raw| Sampler(Arc::new(SamplerInner { raw, _context: context.clone() }));
        if let Some(raw) = samplers.0.get(&key) {
            return Ok(sampler(*raw));
        }
        let name = format!("{:?} {:?} {:?} {:?}", desc.wrap[0], desc.wrap[1], desc.mag, desc.min);
        let info = vk::SamplerCreateInfo::default()
            .address_mode_u(desc.wrap[0])
            .address_mode_v(desc.wrap[1])
            .address_mode_w(vk::SamplerAddressMode::CLAMP_TO_EDGE)
            .mag_filter(desc.mag)
            .min_filter(desc.min)
            .mipmap_mode(desc.mip_mode)
            .max_lod(desc.max_lod.max(0.0))
            .anisotropy_enable(anisotropy > 1.0)
            .max_anisotropy(anisotropy)
            .compare_enable(desc.compare.is_some())
            .compare_op(desc.compare.unwrap_or(vk::CompareOp::NEVER))
            .border_color(vk::BorderColor::FLOAT_OPAQUE_WHITE);
        // SAFETY: anisotropy is above 1 only where the feature is enabled, and within its limit.
        let raw = unsafe { context.device.create_sampler(&info, None) }
            .map_err(|result| GpuError::from_vk("creating sampler", &name, result))?;
        context.set_name(raw, &name);
        samplers.0.insert(key, raw);
        Ok(sampler(raw))
    }
}
