//! The one list of device features: what is required and why, and what is used where present.

use ash::vk;

/// Core, 1.2 and 1.3 features of a device: supported ones, or those to enable.
#[derive(Debug, Clone, Copy, Default)]
pub struct Features {
    core: vk::PhysicalDeviceFeatures,
    v12: vk::PhysicalDeviceVulkan12Features<'static>,
    v13: vk::PhysicalDeviceVulkan13Features<'static>,
}

struct Feature {
    name: &'static str,
    reason: &'static str,
    has: fn(&Features) -> bool,
    enable: fn(&mut Features),
}

macro_rules! feature {
    ($part:ident . $field:ident, $reason:literal) => {
        Feature {
            name: stringify!($field),
            reason: $reason,
            has: |features| features.$part.$field == vk::TRUE,
            enable: |features| features.$part.$field = vk::TRUE,
        }
    };
}

const REQUIRED: [Feature; 6] = [
    feature!(core.robust_buffer_access, "an index of a file may lie outside the vertices"),
    feature!(core.full_draw_index_uint32, "an index of a file may have any 32 bits"),
    feature!(v12.timeline_semaphore, "submissions are counted"),
    feature!(v12.host_query_reset, "queries are reset without a command"),
    feature!(v13.dynamic_rendering, "passes have no render-pass objects"),
    feature!(v13.synchronization2, "barriers"),
];

const OPTIONAL: [Feature; 3] = [
    feature!(core.pipeline_statistics_query, "invocation counts per pass"),
    feature!(core.sampler_anisotropy, "sharper textures at grazing angles"),
    feature!(core.fragment_stores_and_atomics, "counting shaded fragments"),
];

impl Features {
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
        // The chain's pointers end with this function.
        v12.p_next = std::ptr::null_mut();
        v13.p_next = std::ptr::null_mut();
        Self { core, v12, v13 }
    }

    /// Names of required features that are not in `self`, with the reason for each; empty means usable.
    pub fn missing(&self) -> Vec<String> {
        REQUIRED
            .iter()
            .filter(|feature| !(feature.has)(self))
            .map(|feature| format!("{} ({})", feature.name, feature.reason))
            .collect()
    }

    /// The required features, and those optional ones that are in `self`: what a device should be created with.
    pub fn wanted(&self) -> Self {
        let mut wanted = Self::default();
        for feature in REQUIRED.iter().chain(OPTIONAL.iter().filter(|feature| (feature.has)(self))) {
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
        assert_eq!(missing.len(), REQUIRED.len());
        assert!(missing.contains(&"timeline_semaphore (submissions are counted)".to_owned()));
    }

    #[test]
    fn wanted_has_all_that_is_required_and_no_unsupported_option() {
        let wanted = Features::default().wanted();
        assert!(wanted.missing().is_empty());
        assert_eq!(wanted.core.sampler_anisotropy, vk::FALSE);
    }
}
