//! The features that a host's device has enabled: read from the chain that it was created with, or put into it.

use crate::pointer::exclusive;
use crate::renderer::{GetInstanceProcAddr, instance_of};
use crate::result::{Failure, VairResult, border};
use std::ffi::{CString, c_char};
use std::ptr::null_mut;
use std::sync::LazyLock;
use vair::gpu::{Feature, Features, vk};

/// Enables in `features` what vair wants of this device, and leaves the rest as it is: the features that it cannot do
/// without, and of the others those that the device has. Call it before vkCreateDevice, with the chain for VkDeviceCreateInfo;
/// that holds VkPhysicalDeviceVulkan12Features and VkPhysicalDeviceVulkan13Features, or the structures of the single
/// features that Vulkan took up in them.
///
/// Required: robustBufferAccess, fullDrawIndexUint32, timelineSemaphore, hostQueryReset, dynamicRendering,
/// synchronization2. Used where present: pipelineStatisticsQuery, samplerAnisotropy, fragmentStoresAndAtomics.
///
/// VAIR_ERROR_UNSUPPORTED: the device lacks Vulkan 1.3 or a required feature; the message names each with its reason.
/// VAIR_ERROR_ARGUMENT: the chain has no place for one.
///
/// # Safety
/// The instance was created for Vulkan 1.3 or later, the physical device is one of its own.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_enable_features(
    get_instance_proc_addr: GetInstanceProcAddr,
    instance: vk::Instance,
    physical_device: vk::PhysicalDevice,
    features: *mut vk::PhysicalDeviceFeatures2<'_>,
) -> VairResult {
    border(|| {
        // SAFETY: by this function's contract.
        let instance = unsafe { instance_of(get_instance_proc_addr, instance) }?.1;
        if physical_device == vk::PhysicalDevice::null() {
            return Err(Failure::argument("physical_device is NULL"));
        }
        // SAFETY: the caller's structure or NULL.
        let features = unsafe { exclusive(features, "features") }?;
        // SAFETY: the device is the instance's.
        let properties = unsafe { instance.get_physical_device_properties(physical_device) };
        if properties.api_version < vk::API_VERSION_1_3 {
            return Err(Failure::unsupported("the device lacks Vulkan 1.3: choose another one, or update its driver"));
        }
        // SAFETY: the device is the instance's and has Vulkan 1.3.
        let supported = unsafe { Features::supported(&instance, physical_device) };
        let missing = supported.missing();
        if !missing.is_empty() {
            let problem = format!("the device lacks {}: choose another one, or update its driver", missing.join(", "));
            return Err(Failure::unsupported(problem));
        }
        // SAFETY: the chain is the caller's, of structures as their types say.
        unsafe { Chain::of(features) }.enable(supported.wanted())
    })
}

/// What a host's chain says of the features that vair knows.
///
/// # Safety
/// The chain is of valid structures, each as its type says.
pub(crate) unsafe fn enabled(features: &vk::PhysicalDeviceFeatures2<'_>) -> Features {
    let mut head = *features;
    // SAFETY: the caller's chain, which is only read.
    unsafe { Chain::of(&mut head) }.read()
}

/// Where a chain keeps the features of Vulkan 1.2 and 1.3 that vair knows; NULL where it has no place for one.
struct Chain<'a> {
    core: &'a mut vk::PhysicalDeviceFeatures,
    timeline_semaphore: *mut vk::Bool32,
    host_query_reset: *mut vk::Bool32,
    dynamic_rendering: *mut vk::Bool32,
    synchronization2: *mut vk::Bool32,
}

impl<'a> Chain<'a> {
    /// # Safety
    /// The chain is of valid structures, each as its type says, and stays so while this is used.
    unsafe fn of(head: &'a mut vk::PhysicalDeviceFeatures2<'_>) -> Self {
        let mut next = head.p_next.cast::<vk::BaseOutStructure<'_>>();
        let mut chain = Self {
            core: &mut head.features,
            timeline_semaphore: null_mut(),
            host_query_reset: null_mut(),
            dynamic_rendering: null_mut(),
            synchronization2: null_mut(),
        };
        // SAFETY: NULL, or a structure of the chain.
        while let Some(structure) = unsafe { next.as_ref() } {
            match structure.s_type {
                vk::StructureType::PHYSICAL_DEVICE_VULKAN_1_2_FEATURES => {
                    let features = next.cast::<vk::PhysicalDeviceVulkan12Features<'_>>();
                    // SAFETY: the structure is of the type that it says.
                    chain.timeline_semaphore = unsafe { &raw mut (*features).timeline_semaphore };
                    // SAFETY: as above.
                    chain.host_query_reset = unsafe { &raw mut (*features).host_query_reset };
                }
                vk::StructureType::PHYSICAL_DEVICE_VULKAN_1_3_FEATURES => {
                    let features = next.cast::<vk::PhysicalDeviceVulkan13Features<'_>>();
                    // SAFETY: the structure is of the type that it says.
                    chain.dynamic_rendering = unsafe { &raw mut (*features).dynamic_rendering };
                    // SAFETY: as above.
                    chain.synchronization2 = unsafe { &raw mut (*features).synchronization2 };
                }
                vk::StructureType::PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES => {
                    let features = next.cast::<vk::PhysicalDeviceTimelineSemaphoreFeatures<'_>>();
                    // SAFETY: the structure is of the type that it says.
                    chain.timeline_semaphore = unsafe { &raw mut (*features).timeline_semaphore };
                }
                vk::StructureType::PHYSICAL_DEVICE_HOST_QUERY_RESET_FEATURES => {
                    let features = next.cast::<vk::PhysicalDeviceHostQueryResetFeatures<'_>>();
                    // SAFETY: the structure is of the type that it says.
                    chain.host_query_reset = unsafe { &raw mut (*features).host_query_reset };
                }
                vk::StructureType::PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES => {
                    let features = next.cast::<vk::PhysicalDeviceDynamicRenderingFeatures<'_>>();
                    // SAFETY: the structure is of the type that it says.
                    chain.dynamic_rendering = unsafe { &raw mut (*features).dynamic_rendering };
                }
                vk::StructureType::PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES => {
                    let features = next.cast::<vk::PhysicalDeviceSynchronization2Features<'_>>();
                    // SAFETY: the structure is of the type that it says.
                    chain.synchronization2 = unsafe { &raw mut (*features).synchronization2 };
                }
                _ => {}
            }
            next = structure.p_next;
        }
        chain
    }

    fn read(&self) -> Features {
        let is_on = |place: *mut vk::Bool32| {
            // SAFETY: NULL, or a field of the chain, which is still valid.
            unsafe { place.as_ref() }.is_some_and(|flag| *flag != vk::FALSE)
        };
        let v12 = vk::PhysicalDeviceVulkan12Features::default()
            .timeline_semaphore(is_on(self.timeline_semaphore))
            .host_query_reset(is_on(self.host_query_reset));
        let v13 = vk::PhysicalDeviceVulkan13Features::default()
            .dynamic_rendering(is_on(self.dynamic_rendering))
            .synchronization2(is_on(self.synchronization2));
        Features::new(*self.core, v12, v13)
    }

    fn enable(self, mut wanted: Features) -> Result<(), Failure> {
        let places = [self.timeline_semaphore, self.host_query_reset, self.dynamic_rendering, self.synchronization2];
        if places.iter().any(|place| place.is_null()) {
            return Err(Failure::argument(
                "features has no place for timelineSemaphore, hostQueryReset, dynamicRendering or synchronization2: \
                 chain VkPhysicalDeviceVulkan12Features and VkPhysicalDeviceVulkan13Features to it",
            ));
        }
        for place in places {
            // SAFETY: a field of the chain, which is still valid. All four are required.
            unsafe { place.write(vk::TRUE) };
        }
        let core = wanted.chain().features;
        let or = |flag: &mut vk::Bool32, wanted: vk::Bool32| *flag |= wanted;
        or(&mut self.core.robust_buffer_access, core.robust_buffer_access);
        or(&mut self.core.full_draw_index_uint32, core.full_draw_index_uint32);
        or(&mut self.core.pipeline_statistics_query, core.pipeline_statistics_query);
        or(&mut self.core.sampler_anisotropy, core.sampler_anisotropy);
        or(&mut self.core.fragment_stores_and_atomics, core.fragment_stores_and_atomics);
        Ok(())
    }
}

/// Text of the features that vair uses, a line each: its name, why, and what a device without it loses; those that are required
/// first. It is valid for ever.
#[unsafe(no_mangle)]
pub extern "C" fn vair_features() -> *const c_char {
    static TEXT: LazyLock<CString> = LazyLock::new(|| {
        let line = |feature: &Feature| {
            let Feature { name, reason, without, .. } = feature;
            format!("{name}: {reason}; without it, {}\n", without.unwrap_or("the device is refused"))
        };
        let text: String = Features::REQUIRED.iter().chain(Features::OPTIONAL).map(line).collect();
        CString::new(text).unwrap_or_default()
    });
    TEXT.as_ptr()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All that vair knows.
    fn everything() -> Features {
        let core = vk::PhysicalDeviceFeatures::default()
            .pipeline_statistics_query(true)
            .sampler_anisotropy(true)
            .fragment_stores_and_atomics(true);
        Features::new(core, Default::default(), Default::default()).wanted()
    }

    fn assert_everything(features: &Features) {
        for feature in Features::REQUIRED.iter().chain(Features::OPTIONAL) {
            assert!(feature.is_in(features), "{}", feature.name);
        }
    }

    #[test]
    fn every_feature_of_the_list_goes_in_and_comes_out_again() {
        assert_everything(&everything());
        let mut v12 = vk::PhysicalDeviceVulkan12Features::default();
        let mut v13 = vk::PhysicalDeviceVulkan13Features::default();
        let mut head = vk::PhysicalDeviceFeatures2::default().push_next(&mut v12).push_next(&mut v13);
        // SAFETY: the chain is on this stack frame.
        unsafe { Chain::of(&mut head) }.enable(everything()).unwrap();
        // SAFETY: as above.
        assert_everything(&unsafe { enabled(&head) });
    }

    #[test]
    fn structures_of_single_features_do_as_well() {
        let mut timeline = vk::PhysicalDeviceTimelineSemaphoreFeatures::default();
        let mut reset = vk::PhysicalDeviceHostQueryResetFeatures::default();
        let mut rendering = vk::PhysicalDeviceDynamicRenderingFeatures::default();
        let mut synchronization2 = vk::PhysicalDeviceSynchronization2Features::default();
        let mut head = vk::PhysicalDeviceFeatures2::default()
            .push_next(&mut timeline)
            .push_next(&mut reset)
            .push_next(&mut rendering)
            .push_next(&mut synchronization2);
        // SAFETY: the chain is on this stack frame.
        unsafe { Chain::of(&mut head) }.enable(everything()).unwrap();
        // SAFETY: as above.
        assert_everything(&unsafe { enabled(&head) });
    }

    #[test]
    fn a_chain_without_a_place_is_refused_and_left_as_it_was() {
        let mut head = vk::PhysicalDeviceFeatures2::default();
        // SAFETY: there is no chain.
        let error = unsafe { Chain::of(&mut head) }.enable(everything()).unwrap_err();
        assert!(format!("{error:?}").contains("VkPhysicalDeviceVulkan12Features"), "{error:?}");
        assert_eq!(head.features.robust_buffer_access, vk::FALSE);
    }
}
