/* A host program's own Vulkan: instance with the validation layer, device, a colour and a depth image, one command buffer. */
#ifndef HOST_H
#define HOST_H

#include "vair.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <vulkan/vulkan.h>

#define SIZE 96
#define COLOR_FORMAT VK_FORMAT_R16G16B16A16_SFLOAT
#define DEPTH_FORMAT VK_FORMAT_D32_SFLOAT

/* Ends the program where something is not as it should be, and says where. */
#define CHECK(what)                                                                                                    \
    do {                                                                                                               \
        if (!(what)) {                                                                                                 \
            fprintf(stderr, "%s:%d: not so: %s (vair says: %s)\n", __FILE__, __LINE__, #what,                          \
                    vair_last_error_message());                                                                        \
            exit(1);                                                                                                   \
        }                                                                                                              \
    } while (0)
#define CHECK_VK(call) CHECK((call) == VK_SUCCESS)

typedef struct Attachment {
    VkImage image;
    VkDeviceMemory memory;
    VkImageView view;
} Attachment;

typedef struct Host {
    VkInstance instance;
    VkDebugUtilsMessengerEXT messenger;
    VkPhysicalDevice physical_device;
    uint32_t queue_family;
    VkPhysicalDeviceFeatures2 features;
    VkPhysicalDeviceVulkan12Features features12;
    VkPhysicalDeviceVulkan13Features features13;
    VkDevice device;
    VkQueue queue;
    VkCommandPool pool;
    VkCommandBuffer commands;
    VkFence fence;
    Attachment color;
    Attachment depth;
    VkBuffer pixels;
    VkDeviceMemory pixels_memory;
} Host;

static unsigned validation_messages;

static VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                 VkDebugUtilsMessageTypeFlagsEXT types,
                                                 const VkDebugUtilsMessengerCallbackDataEXT *data, void *user) {
    (void)severity, (void)types, (void)user;
    fprintf(stderr, "validation: %s\n", data->pMessage);
    validation_messages++;
    return VK_FALSE;
}

static void make_instance(Host *host) {
    VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = VK_API_VERSION_1_3};
    const char *layer = "VK_LAYER_KHRONOS_validation";
    const char *extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    VkValidationFeatureEnableEXT enabled = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT validation = {.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                          .enabledValidationFeatureCount = 1,
                                          .pEnabledValidationFeatures = &enabled};
    VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                 .pNext = &validation,
                                 .pApplicationInfo = &application,
                                 .enabledLayerCount = 1,
                                 .ppEnabledLayerNames = &layer,
                                 .enabledExtensionCount = 2,
                                 .ppEnabledExtensionNames = extensions};
    CHECK_VK(vkCreateInstance(&info, NULL, &host->instance));
    PFN_vkCreateDebugUtilsMessengerEXT create =
        (PFN_vkCreateDebugUtilsMessengerEXT)vkGetInstanceProcAddr(host->instance, "vkCreateDebugUtilsMessengerEXT");
    VkDebugUtilsMessengerCreateInfoEXT messenger = {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity =
            VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType =
            VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
        .pfnUserCallback = on_message};
    CHECK_VK(create(host->instance, &messenger, NULL, &host->messenger));
    uint32_t count = 1;
    VkResult listed = vkEnumeratePhysicalDevices(host->instance, &count, &host->physical_device);
    CHECK((listed == VK_SUCCESS || listed == VK_INCOMPLETE) && count == 1);
}

static void make_device(Host *host) {
    VkQueueFamilyProperties families[16];
    uint32_t count = 16;
    vkGetPhysicalDeviceQueueFamilyProperties(host->physical_device, &count, families);
    VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    host->queue_family = 0;
    while (host->queue_family < count && (families[host->queue_family].queueFlags & needed) != needed) {
        host->queue_family++;
    }
    CHECK(host->queue_family < count);

    host->features13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    host->features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    host->features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    CHECK(vair_enable_features(vkGetInstanceProcAddr, host->instance, host->physical_device, &host->features) ==
          VAIR_ERROR_ARGUMENT);
    CHECK(strstr(vair_last_error_message(), "VkPhysicalDeviceVulkan12Features"));
    host->features12.pNext = &host->features13;
    host->features.pNext = &host->features12;
    CHECK(vair_enable_features(vkGetInstanceProcAddr, host->instance, host->physical_device, &host->features) == VAIR_OK);
    CHECK(host->features13.dynamicRendering && host->features.features.robustBufferAccess);

    float priority = 1;
    VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                     .queueFamilyIndex = host->queue_family,
                                     .queueCount = 1,
                                     .pQueuePriorities = &priority};
    VkDeviceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                               .pNext = &host->features,
                               .queueCreateInfoCount = 1,
                               .pQueueCreateInfos = &queue};
    CHECK_VK(vkCreateDevice(host->physical_device, &info, NULL, &host->device));
    vkGetDeviceQueue(host->device, host->queue_family, 0, &host->queue);
    VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                    .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                    .queueFamilyIndex = host->queue_family};
    CHECK_VK(vkCreateCommandPool(host->device, &pool, NULL, &host->pool));
    VkCommandBufferAllocateInfo buffers = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                           .commandPool = host->pool,
                                           .commandBufferCount = 1};
    CHECK_VK(vkAllocateCommandBuffers(host->device, &buffers, &host->commands));
    VkFenceCreateInfo fence = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    CHECK_VK(vkCreateFence(host->device, &fence, NULL, &host->fence));
}

static VkDeviceMemory allocate(Host *host, VkMemoryRequirements needs, VkMemoryPropertyFlags wanted) {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(host->physical_device, &memory);
    uint32_t type = 0;
    while (type < memory.memoryTypeCount && !((needs.memoryTypeBits >> type & 1) &&
                                              (memory.memoryTypes[type].propertyFlags & wanted) == wanted)) {
        type++;
    }
    CHECK(type < memory.memoryTypeCount);
    VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                 .allocationSize = needs.size,
                                 .memoryTypeIndex = type};
    VkDeviceMemory allocated;
    CHECK_VK(vkAllocateMemory(host->device, &info, NULL, &allocated));
    return allocated;
}

static Attachment make_attachment(Host *host, VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect) {
    Attachment made;
    VkImageCreateInfo image = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                               .imageType = VK_IMAGE_TYPE_2D,
                               .format = format,
                               .extent = {SIZE, SIZE, 1},
                               .mipLevels = 1,
                               .arrayLayers = 1,
                               .samples = VK_SAMPLE_COUNT_1_BIT,
                               .usage = usage};
    CHECK_VK(vkCreateImage(host->device, &image, NULL, &made.image));
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(host->device, made.image, &needs);
    made.memory = allocate(host, needs, 0);
    CHECK_VK(vkBindImageMemory(host->device, made.image, made.memory, 0));
    VkImageViewCreateInfo view = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                  .image = made.image,
                                  .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                  .format = format,
                                  .subresourceRange = {aspect, 0, 1, 0, 1}};
    CHECK_VK(vkCreateImageView(host->device, &view, NULL, &made.view));
    return made;
}

static void make_targets(Host *host) {
    host->color = make_attachment(host, COLOR_FORMAT,
                                  VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                                  VK_IMAGE_ASPECT_COLOR_BIT);
    host->depth = make_attachment(host, DEPTH_FORMAT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                  VK_IMAGE_ASPECT_DEPTH_BIT);
    VkBufferCreateInfo buffer = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                 .size = SIZE * SIZE * 8,
                                 .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    CHECK_VK(vkCreateBuffer(host->device, &buffer, NULL, &host->pixels));
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(host->device, host->pixels, &needs);
    host->pixels_memory = allocate(
        host, needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    CHECK_VK(vkBindBufferMemory(host->device, host->pixels, host->pixels_memory, 0));
}

static Host *host_new(void) {
    Host *host = calloc(1, sizeof *host);
    CHECK(host);
    make_instance(host);
    make_device(host);
    make_targets(host);
    return host;
}

static void transition(Host *host, VkImage image, VkImageAspectFlags aspect, VkImageLayout from, VkImageLayout to) {
    VkImageMemoryBarrier2 barrier = {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                                     .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                     .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
                                     .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                     .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
                                     .oldLayout = from,
                                     .newLayout = to,
                                     .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                     .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                     .image = image,
                                     .subresourceRange = {aspect, 0, 1, 0, 1}};
    VkDependencyInfo info = {.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                             .imageMemoryBarrierCount = 1,
                             .pImageMemoryBarriers = &barrier};
    vkCmdPipelineBarrier2(host->commands, &info);
}

static void host_begin_commands(Host *host) {
    VkCommandBufferBeginInfo info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                     .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    CHECK_VK(vkBeginCommandBuffer(host->commands, &info));
}

/* The host's own pass: clears colour and depth (reversed: far is 0). */
static void host_begin_pass(Host *host, const float background[4]) {
    transition(host, host->color.image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
               VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    transition(host, host->depth.image, VK_IMAGE_ASPECT_DEPTH_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
               VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
    VkRenderingAttachmentInfo color = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                       .imageView = host->color.view,
                                       .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                       .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                       .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    memcpy(color.clearValue.color.float32, background, 4 * sizeof *background);
    VkRenderingAttachmentInfo depth = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                       .imageView = host->depth.view,
                                       .imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
                                       .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                       .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE};
    VkRenderingInfo info = {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                            .renderArea = {{0, 0}, {SIZE, SIZE}},
                            .layerCount = 1,
                            .colorAttachmentCount = 1,
                            .pColorAttachments = &color,
                            .pDepthAttachment = &depth};
    vkCmdBeginRendering(host->commands, &info);
}

/* Ends the pass, submits, waits, and copies the colours to `halves`, four a pixel. */
static void host_end(Host *host, uint16_t *halves) {
    vkCmdEndRendering(host->commands);
    transition(host, host->color.image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    VkBufferImageCopy region = {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                .imageExtent = {SIZE, SIZE, 1}};
    vkCmdCopyImageToBuffer(host->commands, host->color.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, host->pixels, 1,
                           &region);
    VkMemoryBarrier2 barrier = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                .srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
                                .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
                                .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT};
    VkDependencyInfo info = {
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &barrier};
    vkCmdPipelineBarrier2(host->commands, &info);
    CHECK_VK(vkEndCommandBuffer(host->commands));
    VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &host->commands};
    CHECK_VK(vkQueueSubmit(host->queue, 1, &submit, host->fence));
    CHECK_VK(vkWaitForFences(host->device, 1, &host->fence, VK_TRUE, UINT64_MAX));
    CHECK_VK(vkResetFences(host->device, 1, &host->fence));
    void *mapped;
    CHECK_VK(vkMapMemory(host->device, host->pixels_memory, 0, VK_WHOLE_SIZE, 0, &mapped));
    memcpy(halves, mapped, SIZE * SIZE * 8);
    vkUnmapMemory(host->device, host->pixels_memory);
}

static void attachment_free(Host *host, Attachment *attachment) {
    vkDestroyImageView(host->device, attachment->view, NULL);
    vkDestroyImage(host->device, attachment->image, NULL);
    vkFreeMemory(host->device, attachment->memory, NULL);
}

/* Destroys all of it; a validation message, also of this, ends the program. */
static void host_free(Host *host) {
    vkDestroyBuffer(host->device, host->pixels, NULL);
    vkFreeMemory(host->device, host->pixels_memory, NULL);
    attachment_free(host, &host->color);
    attachment_free(host, &host->depth);
    vkDestroyFence(host->device, host->fence, NULL);
    vkDestroyCommandPool(host->device, host->pool, NULL);
    vkDestroyDevice(host->device, NULL);
    PFN_vkDestroyDebugUtilsMessengerEXT destroy =
        (PFN_vkDestroyDebugUtilsMessengerEXT)vkGetInstanceProcAddr(host->instance, "vkDestroyDebugUtilsMessengerEXT");
    destroy(host->instance, host->messenger, NULL);
    vkDestroyInstance(host->instance, NULL);
    free(host);
    CHECK(validation_messages == 0);
}

#endif
