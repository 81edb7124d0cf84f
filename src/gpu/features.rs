//! The one list of device features: what is required and why, and what is used where present.

use ash::vk;

/// Core, 1.2 and 1.3 features of a device: supported ones, or those to enable.
///
/// The lists are [`Self::REQUIRED`] and [`Self::OPTIONAL`]. A host that opens its device itself enables those of
/// [`Self::wanted`]; one that has wgpu open it enables the rows that do not say "by itself" in addition:
///
/// | feature | why | without it | wgpu 30's Vulkan backend enables it |
/// |---|---|---|---|
/// | `robust_buffer_access` | an index of a file may lie outside the vertices | the device is refused | by itself |
/// | `full_draw_index_uint32` | an index of a file may have any 32 bits | the device is refused | never |
/// | `timeline_semaphore` | submissions are counted | the device is refused | by itself |
/// | `host_query_reset` | queries are reset without a command | the device is refused | never |
/// | `dynamic_rendering` | passes have no render-pass objects | the device is refused | never |
/// | `synchronization2` | barriers | the device is refused | never |
/// | `pipeline_statistics_query` | invocation counts per pass | frames report no invocation counts | with `wgpu::Features::PIPELINE_STATISTICS_QUERY` |
/// | `sampler_anisotropy` | sharper textures at grazing angles | textures are blurred at grazing angles | by itself |
/// | `fragment_stores_and_atomics` | blending pixel by pixel, and counting shaded fragments | what blends is sorted object by object, and shaded fragments are not counted | by itself |
///
/// "By itself" holds where the device has the feature; `timeline_semaphore` also wants the driver to list
/// `VK_KHR_timeline_semaphore`, as drivers do. wgpu chains the structures of single extensions into its
/// `vk::DeviceCreateInfo`, beside which Vulkan forbids the ones of whole versions that [`Self::chain`] makes:
/// `examples/wgpu` shows how to add to it.
#[derive(Debug, Clone, Copy, Default)]
pub struct Features {
    core: vk::PhysicalDeviceFeatures,
    v12: vk::PhysicalDeviceVulkan12Features<'static>,
    v13: vk::PhysicalDeviceVulkan13Features<'static>,
}

/// One feature of a device that this crate uses.
#[derive(Debug, Clone, Copy)]
pub struct Feature {
    /// Field of `vk::PhysicalDeviceFeatures`, `vk::PhysicalDeviceVulkan12Features` or `vk::PhysicalDeviceVulkan13Features`.
    pub name: &'static str,
    /// What it is used for.
    pub reason: &'static str,
    /// What a device without it does not get; `None`: it is required, and such a device is refused.
    pub without: Option<&'static str>,
    /// Whether a device that wgpu 30 opens on Vulkan has it enabled.
    pub wgpu_30: WgpuEnables,
    has: fn(&Features) -> bool,
    enable: fn(&mut Features),
}

impl Feature {
    /// Whether it is among `features`.
    pub fn is_in(&self, features: &Features) -> bool {
        (self.has)(features)
    }
}

/// When wgpu's Vulkan backend enables a feature of a device that supports it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WgpuEnables {
    /// Always.
    ByItself,
    /// When the program asks for this member of `wgpu::Features`.
    With(&'static str),
    /// Never: the host adds it when it opens the device through wgpu-hal.
    Never,
}

impl std::fmt::Display for WgpuEnables {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::ByItself => f.write_str("by itself"),
            Self::With(feature) => write!(f, "with `wgpu::Features::{feature}`"),
            Self::Never => f.write_str("never"),
        }
    }
}

macro_rules! feature {
    ($part:ident . $field:ident, $reason:literal, $without:expr, $wgpu_30:expr) => {
        Feature {
            name: stringify!($field),
            reason: $reason,
            without: $without,
            wgpu_30: $wgpu_30,
            has: |features| features.$part.$field == vk::TRUE,
            enable: |features| features.$part.$field = vk::TRUE,
        }
    };
}

impl Features {
    /// A device without one of these is refused.
    pub const REQUIRED: &'static [Feature] = {
        use WgpuEnables::{ByItself, Never};
        &[
            feature!(core.robust_buffer_access, "an index of a file may lie outside the vertices", None, ByItself),
            feature!(core.full_draw_index_uint32, "an index of a file may have any 32 bits", None, Never),
            feature!(v12.timeline_semaphore, "submissions are counted", None, ByItself),
            feature!(v12.host_query_reset, "queries are reset without a command", None, Never),
            feature!(v13.dynamic_rendering, "passes have no render-pass objects", None, Never),
            feature!(v13.synchronization2, "barriers", None, Never),
        ]
    };

    /// A device without one of these does less.
    pub const OPTIONAL: &'static [Feature] = &[
        feature!(
            core.pipeline_statistics_query,
            "invocation counts per pass",
            Some("frames report no invocation counts"),
            WgpuEnables::With("PIPELINE_STATISTICS_QUERY")
        ),
        feature!(
            core.sampler_anisotropy,
            "sharper textures at grazing angles",
            Some("textures are blurred at grazing angles"),
            WgpuEnables::ByItself
        ),
        feature!(
            core.fragment_stores_and_atomics,
            "blending pixel by pixel, and counting shaded fragments",
            Some("what blends is sorted object by object, and shaded fragments are not counted"),
            WgpuEnables::ByItself
        ),
    ];

    /// Features that a host created its device with, in Vulkan's own structures; what they chain to is not read.
    pub fn new(
        core: vk::PhysicalDeviceFeatures,
        mut v12: vk::PhysicalDeviceVulkan12Features<'static>,
        mut v13: vk::PhysicalDeviceVulkan13Features<'static>,
    ) -> Self {
        v12.p_next = std::ptr::null_mut();
        v13.p_next = std::ptr::null_mut();
        Self { core, v12, v13 }
    }

    /// Features that `physical_device` supports. A device below Vulkan 1.3 must not be asked.
    ///
    /// # Safety
    /// `physical_device` comes from `instance`, both are valid, and the device's API version is at least 1.3.
    pub unsafe fn supported(instance: &ash::Instance, physical_device: vk::PhysicalDevice) -> Self {
        let mut v12 = vk::PhysicalDeviceVulkan12Features::default();
        let mut v13 = vk::PhysicalDeviceVulkan13Features::default();
        let mut all = vk::PhysicalDeviceFeatures2::default().push_next(&mut v12).push_next(&mut v13);
        // SAFETY: the caller vouches for the handles; the chain lives on this stack frame.
        unsafe { instance.get_physical_device_features2(physical_device, &mut all) };
        let core = all.features;
        Self::new(core, v12, v13)
    }

    /// Names of required features that are not in `self`, with the reason for each; empty means usable.
    pub fn missing(&self) -> Vec<String> {
        Self::REQUIRED
            .iter()
            .filter(|feature| !feature.is_in(self))
            .map(|feature| format!("{} ({})", feature.name, feature.reason))
            .collect()
    }

    /// The required features, and those optional ones that are in `self`: what a device should be created with.
    pub fn wanted(&self) -> Self {
        let mut wanted = Self::default();
        for feature in Self::REQUIRED.iter().chain(Self::OPTIONAL.iter().filter(|feature| feature.is_in(self))) {
            (feature.enable)(&mut wanted);
        }
        wanted
    }

    /// The structure to chain into `vk::DeviceCreateInfo` with `push_next`.
    pub fn chain(&mut self) -> vk::PhysicalDeviceFeatures2<'_> {
        vk::PhysicalDeviceFeatures2::default().features(self.core).push_next(&mut self.v12).push_next(&mut self.v13)
    }

    pub(crate) fn core(&self) -> &vk::PhysicalDeviceFeatures {
        &self.core
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_supported_names_every_required_feature_with_its_reason() {
        let missing = Features::default().missing();
        assert_eq!(missing.len(), Features::REQUIRED.len());
        assert!(missing.contains(&"timeline_semaphore (submissions are counted)".to_owned()));
    }

    #[test]
    fn wanted_has_all_that_is_required_and_no_unsupported_option() {
        let wanted = Features::default().wanted();
        assert!(wanted.missing().is_empty());
        assert_eq!(wanted.core.sampler_anisotropy, vk::FALSE);
    }

    #[test]
    fn what_a_host_enabled_is_read_without_what_it_chains_to() {
        let mut robustness = vk::PhysicalDeviceImageRobustnessFeatures::default();
        let v13 = vk::PhysicalDeviceVulkan13Features {
            p_next: std::ptr::from_mut(&mut robustness).cast(),
            ..vk::PhysicalDeviceVulkan13Features::default().synchronization2(true)
        };
        let features = Features::new(Default::default(), Default::default(), v13);
        assert!(features.v13.p_next.is_null());
        assert_eq!(features.missing().len(), Features::REQUIRED.len() - 1);
    }

    #[test]
    fn a_required_feature_has_no_fallback_and_an_optional_one_names_what_is_lost() {
        assert!(Features::REQUIRED.iter().all(|feature| feature.without.is_none()));
        assert!(Features::OPTIONAL.iter().all(|feature| feature.without.is_some()));
    }

    #[test]
    fn the_documented_table_is_the_list() {
        let all = Features::REQUIRED.iter().chain(Features::OPTIONAL);
        let rows = all.map(|Feature { name, reason, without, wgpu_30, .. }| {
            format!("/// | `{name}` | {reason} | {} | {wgpu_30} |\n", without.unwrap_or("the device is refused"))
        });
        assert!(include_str!("features.rs").contains(&rows.collect::<String>()));
    }
}
