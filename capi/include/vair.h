/*
 * vair draws fur and cloth into a Vulkan frame of your own.
 *
 *   1. Before vkCreateDevice: vair_enable_features() on the feature chain that you pass to it.
 *   2. Once: vair_renderer_new_on_host(); vair_scene_load() or vair_scene_new(); vair_scene_apply_preset() or _look();
 *      vair_scene_add() for each thing that stands in the scene.
 *   3. Every frame: vair_frame_begin() on a command buffer; vair_frame_prepare() outside of passes; then, inside your own
 *      dynamic rendering pass, vair_frame_draw_opaque(), _fur(), _transparent(); vair_frame_finish() gives a token.
 *   4. When your fence or timeline says that the frame has passed: vair_renderer_frame_passed() with that token.
 *
 * Calls return VairResult; text is UTF-8 and ends with NUL; a VkBool32 is true where it is not 0; matrices are 16 numbers, column by
 * column, and act on column vectors; lengths are metres, world space is right-handed. Nothing that a call is given is used after
 * it, but Vulkan handles. An object is used by one thread at a time; a renderer and the frame that it records are one object in
 * this. A pointer that is NULL where it should not be is an error, not a crash; one that is dangling is not found out.
 *
 * Made by cbindgen from capi/src; do not edit.
 */


#ifndef VAIR_H
#define VAIR_H

#include <stddef.h>
#include <stdint.h>
#include <vulkan/vulkan_core.h>

/**
 * Version of the interface that this header describes. A program and a library fit where theirs are equal.
 */
#define VAIR_INTERFACE_VERSION 1

/**
 * No index: an option that is left out.
 */
#define VAIR_NONE UINT32_MAX

/**
 * Infinitely far away.
 */
#define VAIR_LIGHT_DIRECTIONAL 0

/**
 * Shines in all directions.
 */
#define VAIR_LIGHT_POINT 1

/**
 * A cone.
 */
#define VAIR_LIGHT_SPOT 2

/**
 * How a call ended. All but VAIR_OK leave a message: vair_last_error_message().
 */
typedef enum VairResult {
  /**
   * It did what it says.
   */
  VAIR_OK = 0,
  /**
   * An argument is NULL, out of its range, or does not belong here. Nothing was done.
   */
  VAIR_ERROR_ARGUMENT = 1,
  /**
   * A file cannot be read, or data is not what it should be.
   */
  VAIR_ERROR_FILE = 2,
  /**
   * A look, preset or parameter is wrong.
   */
  VAIR_ERROR_MATERIAL = 3,
  /**
   * The scene lacks what was asked for.
   */
  VAIR_ERROR_SCENE = 4,
  /**
   * The device, or the way in which it was created, lacks what is needed.
   */
  VAIR_ERROR_UNSUPPORTED = 5,
  /**
   * The device is out of memory.
   */
  VAIR_ERROR_OUT_OF_MEMORY = 6,
  /**
   * The device was lost.
   */
  VAIR_ERROR_DEVICE_LOST = 7,
  /**
   * The driver failed in another way.
   */
  VAIR_ERROR_DEVICE = 8,
  /**
   * A fault of vair's own. The objects of the call are good for nothing but to be freed (frames: finished).
   */
  VAIR_ERROR_INTERNAL = 9,
} VairResult;

/**
 * A frame being recorded. vair_frame_prepare() comes first, outside of a pass; draws come inside the host's own passes, in the
 * order that it likes; vair_frame_finish() last, also where another call has failed.
 */
typedef struct VairFrame VairFrame;

/**
 * An image of the host's that vair reads: in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL whenever it does.
 */
typedef struct VairImage VairImage;

/**
 * Draws scenes on one device: pipelines, look-up tables and prepared environments. One thread at a time uses it and the
 * frame that it records.
 */
typedef struct VairRenderer VairRenderer;

/**
 * Meshes, materials and instances on a device, edited in place: what changes is uploaded, and nothing else. Changes are seen by
 * the next vair_frame_prepare(). One thread at a time edits and draws it.
 */
typedef struct VairScene VairScene;

/**
 * An image of the host's; vair does not destroy it.
 */
typedef struct VairHostImage {
  /**
   * Name in messages; NULL is none.
   */
  const char *name;
  /**
   * The image.
   */
  VkImage image;
  /**
   * View of all its levels (and faces), which is what shaders read.
   */
  VkImageView view;
  /**
   * Format; an sRGB one where it holds colours.
   */
  VkFormat format;
  /**
   * Texels.
   */
  uint32_t width;
  /**
   * Texels.
   */
  uint32_t height;
  /**
   * Mip levels of the view.
   */
  uint32_t mip_levels;
  /**
   * It is a cube of six faces.
   */
  VkBool32 is_cube;
} VairHostImage;

/**
 * A camera in one frame: any projection. Matrices are 16 numbers, column by column.
 */
typedef struct VairView {
  /**
   * From world space (right-handed, metres) to the camera's axes, which looks along its -Z.
   */
  float view_from_world[16];
  /**
   * Projection, depth in [0, 1] in the order that the target declares. Jitter comes on top.
   */
  float clip_from_view[16];
  /**
   * Left edge of what is drawn to, pixels of the target.
   */
  uint32_t viewport_x;
  /**
   * Its top edge.
   */
  uint32_t viewport_y;
  /**
   * Its width.
   */
  uint32_t viewport_width;
  /**
   * Its height.
   */
  uint32_t viewport_height;
  /**
   * Shift of the picture, pixels to the right, in [-0.5, 0.5]: of temporal anti-aliasing. Motion does not count it.
   */
  float jitter_x_px;
  /**
   * The same, down.
   */
  float jitter_y_px;
  /**
   * Clip space points down, as Vulkan's own does; otherwise it points up.
   */
  VkBool32 is_y_down;
  /**
   * The two matrices of the previous frame are given; otherwise the camera has not moved.
   */
  VkBool32 has_previous;
  /**
   * Of the previous frame, for motion vectors.
   */
  float previous_view_from_world[16];
  /**
   * Of the previous frame, for motion vectors.
   */
  float previous_clip_from_view[16];
  /**
   * Factor on all radiance that is written, greater than 0.
   */
  float pre_exposure;
} VairView;

/**
 * Formats of what is drawn into; pipelines are made for it.
 */
typedef struct VairTarget {
  /**
   * Format of the colour target: takes linear, scene-referred radiance times the view's pre-exposure, premultiplied where it
   * blends.
   */
  VkFormat color;
  /**
   * Format of the depth target.
   */
  VkFormat depth;
  /**
   * Samples a pixel of both: 1 or 4.
   */
  uint32_t samples;
  /**
   * Depth is 1 at the near plane and cleared to 0; otherwise 0 at the near plane and cleared to 1.
   */
  VkBool32 is_depth_reversed;
  /**
   * Format of a target for motion vectors, or VK_FORMAT_UNDEFINED. It takes pixels from the previous frame's place to this
   * one's, x to the right, y down, in its first two channels.
   */
  VkFormat motion;
} VairTarget;

/**
 * A light in world space.
 */
typedef struct VairLight {
  /**
   * VAIR_LIGHT_DIRECTIONAL, VAIR_LIGHT_POINT or VAIR_LIGHT_SPOT.
   */
  uint32_t kind;
  /**
   * Metres; not of directional lights.
   */
  float position[3];
  /**
   * From the scene to the light, of any length; the opposite of a spot's axis. Not of points.
   */
  float direction_to_light[3];
  /**
   * Linear RGB: lux of directional lights, candela of others. Pi lux on a white matt surface show as 1.
   */
  float intensity[3];
  /**
   * Metres beyond which nothing arrives; 0 is no end.
   */
  float range_m;
  /**
   * Of spots, radians from the axis: full intensity inside.
   */
  float inner_angle;
  /**
   * Of spots, radians from the axis: nothing outside; greater than `inner_angle`.
   */
  float outer_angle;
} VairLight;

/**
 * A shadow map of the host's.
 */
typedef struct VairShadowMap {
  /**
   * Index of the light.
   */
  uint32_t light;
  /**
   * 16 numbers, column by column: clip space up, reversed depth; w is 1 for parallel rays and otherwise the distance along
   * the axis, metres.
   */
  float clip_from_world[16];
  /**
   * Left edge of the tile, texels.
   */
  uint32_t x_px;
  /**
   * Its top edge.
   */
  uint32_t y_px;
  /**
   * Its side.
   */
  uint32_t size_px;
} VairShadowMap;

/**
 * Shadow maps that the host has made: one image, in which each map has a square tile.
 */
typedef struct VairHostShadows {
  /**
   * Depth of the nearest surfaces, reversed (1 at the light).
   */
  const struct VairImage *image;
  /**
   * Tiles; those of one light stand together, the finest first.
   */
  const struct VairShadowMap *maps;
  /**
   * How many.
   */
  uint32_t map_count;
} VairHostShadows;

/**
 * What a frame is. Start from vair_frame_desc_default().
 */
typedef struct VairFrameDesc {
  /**
   * Cameras, lights' eyes among them, at least one; draws name them by their place here. The first one decides where vair's
   * own shadow maps are fine.
   */
  const struct VairView *views;
  /**
   * How many.
   */
  uint32_t view_count;
  /**
   * What is drawn into.
   */
  struct VairTarget target;
  /**
   * Lights.
   */
  const struct VairLight *lights;
  /**
   * How many.
   */
  uint32_t light_count;
  /**
   * Lights cast shadows, in maps of vair's own.
   */
  VkBool32 casts_shadows;
  /**
   * Texels of such a map's sides: a power of two, 64 to 4096.
   */
  uint32_t shadow_resolution_px;
  /**
   * Radius of the shadows' filter, texels, 1 to 3.
   */
  uint32_t shadow_filter_px;
  /**
   * The host's own shadow maps in the place of vair's, or NULL.
   */
  const struct VairHostShadows *host_shadows;
  /**
   * Depth format for vair_frame_cast_shadows(), or VK_FORMAT_UNDEFINED.
   */
  VkFormat cast_depth;
  /**
   * That depth is 1 at the light.
   */
  VkBool32 is_cast_depth_reversed;
  /**
   * Seconds since the last frame, for strands that lag behind their roots; 0 holds them still.
   */
  float step_s;
  /**
   * Shells of fur, 1 to 256; VAIR_NONE is what each material says.
   */
  uint32_t layers;
  /**
   * Factor on the shells that each material says, greater than 0.
   */
  float layer_scale;
} VairFrameDesc;

/**
 * A mesh of one material. Lists that are NULL are absent; others have an entry a vertex.
 */
typedef struct VairMesh {
  /**
   * Name in messages; NULL is none.
   */
  const char *name;
  /**
   * Vertices.
   */
  uint32_t vertex_count;
  /**
   * Three numbers each, metres.
   */
  const float *positions;
  /**
   * Three numbers each, unit length.
   */
  const float *normals;
  /**
   * Four numbers each: unit length, and +1 or -1; bitangent = w * cross(normal, tangent). May be absent: they are made where a
   * material needs them.
   */
  const float *tangents;
  /**
   * Two numbers each. Fur grows by them; it may also be absent.
   */
  const float *uvs;
  /**
   * Four numbers each, linear RGBA in [0, 1]. May be absent.
   */
  const float *colors;
  /**
   * Four each: joints of the mesh's skin. May be absent.
   */
  const uint16_t *joints;
  /**
   * Four each, of sum 1; present where joints are.
   */
  const float *weights;
  /**
   * Joints of its skin; 0 is none. Meshes with joints have a skin each, in their order.
   */
  uint32_t joint_count;
  /**
   * Three indices a triangle, counter-clockwise where it is seen from its front.
   */
  const uint32_t *indices;
  /**
   * A multiple of 3.
   */
  uint32_t index_count;
  /**
   * Index of its material.
   */
  uint32_t material;
  /**
   * Morph targets.
   */
  uint32_t morph_target_count;
  /**
   * Target by target, three numbers a vertex: what a weight of 1 adds to positions. Present where there are targets.
   */
  const float *morph_positions;
  /**
   * The same for normals. May be absent.
   */
  const float *morph_normals;
} VairMesh;

/**
 * A material before looks and presets dress it.
 */
typedef struct VairMaterial {
  /**
   * Name, by which looks know it.
   */
  const char *name;
  /**
   * Linear RGBA.
   */
  float base_color[4];
  /**
   * Index of an image that it is multiplied with, or VAIR_NONE.
   */
  uint32_t base_color_image;
  /**
   * In [0, 1].
   */
  float metallic;
  /**
   * Perceptual, in [0, 1].
   */
  float roughness;
} VairMaterial;

/**
 * Pixels in memory.
 */
typedef struct VairPixels {
  /**
   * Name in messages; NULL is none.
   */
  const char *name;
  /**
   * Pixels, at least 1.
   */
  uint32_t width;
  /**
   * Pixels, at least 1.
   */
  uint32_t height;
  /**
   * width * height * 4 bytes, rows from the top, sRGB-coded where they are colours.
   */
  const uint8_t *rgba;
} VairPixels;

/**
 * A scene in memory. Nothing of it is used after the call.
 */
typedef struct VairSceneDesc {
  /**
   * Meshes.
   */
  const struct VairMesh *meshes;
  /**
   * How many.
   */
  uint32_t mesh_count;
  /**
   * Materials.
   */
  const struct VairMaterial *materials;
  /**
   * How many.
   */
  uint32_t material_count;
  /**
   * Images.
   */
  const struct VairPixels *images;
  /**
   * How many.
   */
  uint32_t image_count;
} VairSceneDesc;

/**
 * A device of the host's; vair destroys none of it.
 */
typedef struct VairHostDevice {
  /**
   * The loader's vkGetInstanceProcAddr.
   */
  PFN_vkGetInstanceProcAddr get_instance_proc_addr;
  /**
   * Instance, created for Vulkan 1.3 or later.
   */
  VkInstance instance;
  /**
   * The device's physical device.
   */
  VkPhysicalDevice physical_device;
  /**
   * Device.
   */
  VkDevice device;
  /**
   * Queue with graphics and compute.
   */
  VkQueue queue;
  /**
   * Family of `queue`.
   */
  uint32_t queue_family;
  /**
   * The features that the device was created with, as vair_enable_features() has completed them. Read during the call.
   */
  const VkPhysicalDeviceFeatures2 *enabled_features;
  /**
   * VK_EXT_debug_utils is enabled on the instance: objects get names and passes get labels.
   */
  VkBool32 has_debug_utils;
  /**
   * Folder for the pipeline cache and for prepared environments; NULL keeps them in memory.
   */
  const char *cache_folder;
} VairHostDevice;

/**
 * A device of vair's own.
 */
typedef struct VairDeviceOptions {
  /**
   * Part of the device's name, in any case; NULL takes the best kind.
   */
  const char *device;
  /**
   * Turns on the validation layer.
   */
  VkBool32 validates;
  /**
   * Folder for the pipeline cache and for prepared environments; NULL keeps them in memory.
   */
  const char *cache_folder;
} VairDeviceOptions;

/**
 * What a scene has; indices are below these.
 */
typedef struct VairSceneInfo {
  /**
   * Meshes.
   */
  uint32_t meshes;
  /**
   * Materials.
   */
  uint32_t materials;
  /**
   * Skins.
   */
  uint32_t skins;
  /**
   * Images, those of looks among them.
   */
  uint32_t images;
  /**
   * Animations.
   */
  uint32_t animations;
  /**
   * Scenes of the file.
   */
  uint32_t scenes;
  /**
   * Variants of materials.
   */
  uint32_t variants;
  /**
   * Instances that stand in it.
   */
  uint32_t instances;
} VairSceneInfo;

/**
 * A mesh to place.
 */
typedef struct VairInstanceDesc {
  /**
   * Index of the mesh.
   */
  uint32_t mesh;
  /**
   * Index of a skin, for a mesh that joints carry, or VAIR_NONE.
   */
  uint32_t skin;
  /**
   * Index of the variant that it wears, or VAIR_NONE.
   */
  uint32_t variant;
  /**
   * Where it stands, 16 numbers, column by column. Joints carry a skinned mesh to the world, and this does not count for it.
   */
  float world_from_object[16];
} VairInstanceDesc;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * VAIR_INTERFACE_VERSION of the library that is linked.
 */
uint32_t vair_interface_version(void);

/**
 * Version of the library, for example "0.1.0".
 */
const char *vair_version(void);

/**
 * The same linear RGB radiance from everywhere: three numbers, 0 or more.
 *
 * # Safety
 * `scene` is valid or NULL; `radiance` has three numbers.
 */
enum VairResult vair_scene_set_environment_constant(struct VairScene *scene, const float *radiance);

/**
 * The embedded studio, which lights a scene that was told nothing else. It turns by `rotation_deg` around +Y, counter-clockwise
 * seen from above; `strength` is a factor on its radiance.
 *
 * # Safety
 * `scene` is valid or NULL.
 */
enum VairResult vair_scene_set_environment_studio(struct VairScene *scene,
                                                  float rotation_deg,
                                                  float strength);

/**
 * An equirectangular picture of linear radiance, Radiance (.hdr) or OpenEXR (.exr). The first frame with it prepares its
 * maps, which takes seconds where no cache has them.
 *
 * # Safety
 * `scene` is valid or NULL; `path` is text or NULL.
 */
enum VairResult vair_scene_set_environment_file(struct VairScene *scene,
                                                const char *path,
                                                float rotation_deg,
                                                float strength);

/**
 * The host's own prefiltered environment. `cube` holds radiance over `scale` (three numbers): level l of `last` is spread by a
 * GGX lobe that is seen from the front, of perceptual roughness l / last. `harmonics` are 27 numbers: linear RGB radiance in
 * the nine real spherical harmonics up to l = 2, coefficient l * l + l + m, z the polar axis.
 *
 * # Safety
 * The handles are valid or NULL; `cube` is as for vair_image_new_on_host(); `scale` has 3 numbers, `harmonics` 27.
 */
enum VairResult vair_scene_set_host_environment(struct VairScene *scene,
                                                struct VairRenderer *renderer,
                                                const struct VairHostImage *cube,
                                                const float *scale,
                                                const float *harmonics,
                                                float rotation_deg,
                                                float strength);

/**
 * Enables in `features` what vair wants of this device, and leaves the rest as it is: the features that it cannot do
 * without, and of the others those that the device has. Call it before vkCreateDevice, with the chain for VkDeviceCreateInfo;
 * that holds VkPhysicalDeviceVulkan12Features and VkPhysicalDeviceVulkan13Features, or the structures of the single
 * features that Vulkan took up in them.
 *
 * Required: robustBufferAccess, fullDrawIndexUint32, timelineSemaphore, hostQueryReset, dynamicRendering,
 * synchronization2. Used where present: pipelineStatisticsQuery, samplerAnisotropy, fragmentStoresAndAtomics.
 *
 * VAIR_ERROR_UNSUPPORTED: the device lacks Vulkan 1.3 or a required feature; the message names each with its reason.
 * VAIR_ERROR_ARGUMENT: the chain has no place for one.
 *
 * # Safety
 * The instance was created for Vulkan 1.3 or later, the physical device is one of its own.
 */
enum VairResult vair_enable_features(PFN_vkGetInstanceProcAddr get_instance_proc_addr,
                                     VkInstance instance,
                                     VkPhysicalDevice physical_device,
                                     VkPhysicalDeviceFeatures2 *features);

/**
 * Text of the features that vair uses, a line each: its name, why, and what a device without it loses; those that are required
 * first. It is valid for ever.
 */
const char *vair_features(void);

/**
 * No view yet and no lights; half floats and reversed 32-bit depth at 4 samples, shadows.
 */
struct VairFrameDesc vair_frame_desc_default(void);

/**
 * Starts a frame. A renderer records one at a time; up to 64 may wait for their tokens.
 *
 * # Safety
 * `renderer` is valid or NULL. The command buffer is recording, outside of a pass, belongs to the renderer's device and to a
 * family with graphics and compute; nobody else records into it during calls of the frame. It is submitted once, to the
 * renderer's queue, before anything recorded later.
 */
enum VairResult vair_frame_begin(struct VairRenderer *renderer,
                                 VkCommandBuffer command_buffer,
                                 struct VairFrame **frame);

/**
 * Uploads what has changed, poses, moves strands, casts vair's own shadow maps: all that happens outside of passes. A scene is
 * prepared once a frame, for all its views. What `desc` points to is not used after the call.
 *
 * # Safety
 * All pointers are valid or NULL and hold as many elements as the description says. The command buffer that the frame began with
 * is recording, outside of a pass.
 */
enum VairResult vair_frame_prepare(struct VairFrame *frame,
                                   struct VairScene *scene,
                                   const struct VairFrameDesc *desc);

/**
 * Draws opaque and masked surfaces, the skin under fur among them, of a view; depth is tested and written.
 *
 * # Safety
 * The handles are valid or NULL. The command buffer is recording inside a dynamic rendering pass on the target that the scene was
 * prepared for; nobody else records into it during the call. It is submitted to the renderer's queue, after the one that the
 * frame began with or as that one.
 */
enum VairResult vair_frame_draw_opaque(struct VairFrame *frame,
                                       VkCommandBuffer command_buffer,
                                       const struct VairScene *scene,
                                       uint32_t view);

/**
 * Draws shells of fur that does not blend; depth is tested and written.
 *
 * # Safety
 * That of vair_frame_draw_opaque().
 */
enum VairResult vair_frame_draw_fur(struct VairFrame *frame,
                                    VkCommandBuffer command_buffer,
                                    const struct VairScene *scene,
                                    uint32_t view);

/**
 * Draws what blends over what there is, from far to near as objects are sorted; depth is tested and not written.
 *
 * # Safety
 * That of vair_frame_draw_opaque().
 */
enum VairResult vair_frame_draw_transparent(struct VairFrame *frame,
                                            VkCommandBuffer command_buffer,
                                            const struct VairScene *scene,
                                            uint32_t view);

/**
 * Draws motion vectors of what is not farther than the depth that there is: after the opaque surfaces and the fur, in a pass on the
 * target's motion image and that depth.
 *
 * # Safety
 * That of vair_frame_draw_opaque().
 */
enum VairResult vair_frame_draw_motion(struct VairFrame *frame,
                                       VkCommandBuffer command_buffer,
                                       const struct VairScene *scene,
                                       uint32_t view);

/**
 * Draws depth alone of all that casts shadows, fur by its outermost strands, into a shadow map of the host's; `view` is the light's
 * eye.
 *
 * # Safety
 * That of vair_frame_draw_opaque(), for a pass on depth alone, of the format that the scene was prepared for.
 */
enum VairResult vair_frame_cast_shadows(struct VairFrame *frame,
                                        VkCommandBuffer command_buffer,
                                        const struct VairScene *scene,
                                        uint32_t view);

/**
 * Ends a frame and frees it, also where this fails, unless an argument is NULL. The host ends and submits its command buffers;
 * when the device is done with them, `token` goes to vair_renderer_frame_passed(), after a failure as well: what was recorded is
 * valid then, and something is missing in it.
 *
 * # Safety
 * `frame` is valid or NULL, and is not used any more.
 */
enum VairResult vair_frame_finish(struct VairFrame *frame,
                                  uint64_t *token);

/**
 * Lets vair read an image of the host's, which stays the host's.
 *
 * # Safety
 * Image and view belong to the renderer's device, are as described, were made for sampling, and live until the last frame
 * that reads them has passed. They are in shader-read layout in every such frame.
 */
enum VairResult vair_image_new_on_host(struct VairRenderer *renderer,
                                       const struct VairHostImage *host,
                                       struct VairImage **image);

/**
 * Frees what vair knows of an image; the host's image stays. NULL is nothing.
 *
 * # Safety
 * It is not used any more.
 */
void vair_image_free(struct VairImage *image);

/**
 * A scene from memory. Nothing is placed yet.
 *
 * VAIR_ERROR_FILE: a list has another length than it should, an index points nowhere, a number is not finite or not in its range;
 * the message names the list and the entry.
 *
 * # Safety
 * All pointers of the description are NULL or hold as many elements as it says.
 */
enum VairResult vair_scene_new(const struct VairSceneDesc *desc,
                               struct VairScene **scene);

/**
 * A renderer on the host's device.
 *
 * VAIR_ERROR_UNSUPPORTED: the device lacks what vair requires, or was created without it; the message names each.
 *
 * # Safety
 * The handles are valid, belong together, and stay so until the renderer, its frames and all scenes that it drew are freed.
 * While a call of vair runs, nobody else uses the queue. Before the last of them is freed, all command buffers that vair
 * recorded into have finished.
 */
enum VairResult vair_renderer_new_on_host(const struct VairHostDevice *host,
                                          struct VairRenderer **renderer);

/**
 * A renderer on a device of its own, for pictures: vair_renderer_picture(). NULL options take the best device.
 *
 * # Safety
 * `options` is NULL or valid.
 */
enum VairResult vair_renderer_new(const struct VairDeviceOptions *options, struct VairRenderer **renderer);

/**
 * Frees a renderer; a frame that it records may still be finished. NULL is nothing.
 *
 * # Safety
 * It is not used any more. On a host's device, see vair_renderer_new_on_host().
 */
void vair_renderer_free(struct VairRenderer *renderer);

/**
 * The picture that the program `vair` makes of a scene: its nodes, its own camera or one that frames all, the studio's light
 * and background, tone-mapped. What vair_scene_add() has placed is not in it. Writes width * height RGBA pixels of sRGB-coded
 * colour, rows from the top; `bytes` is how many `rgba` holds. It submits, and waits.
 *
 * # Safety
 * The handles are valid; `rgba` holds `bytes` bytes.
 */
enum VairResult vair_renderer_picture(struct VairRenderer *renderer,
                                      const struct VairScene *scene,
                                      uint32_t width,
                                      uint32_t height,
                                      uint8_t *rgba,
                                      size_t bytes);

/**
 * The host's word that the device is done with a frame: what only that frame used comes back. Each token is given back once.
 *
 * # Safety
 * It is true: the frame's command buffers have finished, or were never submitted and never will be.
 */
enum VairResult vair_renderer_frame_passed(struct VairRenderer *renderer,
                                           uint64_t token);

/**
 * Gives a token up for a value of the host's timeline semaphore: the frame will have passed when that is at `value`, which
 * vair_renderer_timeline_passed() says. One timeline serves all frames.
 *
 * # Safety
 * `renderer` is valid or NULL.
 */
enum VairResult vair_renderer_frame_on_timeline(struct VairRenderer *renderer,
                                                uint64_t token,
                                                uint64_t value);

/**
 * The host's word that its timeline is at `value`: what only the frames up to there used comes back.
 *
 * # Safety
 * It is true, and the frames' values were right.
 */
enum VairResult vair_renderer_timeline_passed(struct VairRenderer *renderer, uint64_t value);

/**
 * What the last call of this thread that failed had to say: one line of UTF-8, what, where and what to do; never NULL. It is
 * valid until the thread's next call that fails.
 */
const char *vair_last_error_message(void);

/**
 * A scene of a .gltf or .glb file. Nothing is placed yet.
 *
 * # Safety
 * `path` is text or NULL.
 */
enum VairResult vair_scene_load(const char *path, struct VairScene **scene);

/**
 * Frees a scene. Frames in flight keep what they need. NULL is nothing.
 *
 * # Safety
 * It is not used any more.
 */
void vair_scene_free(struct VairScene *scene);

/**
 * What a scene has.
 *
 * # Safety
 * The pointers are valid or NULL.
 */
enum VairResult vair_scene_info(const struct VairScene *scene, struct VairSceneInfo *info);

/**
 * The index of a material, by its name.
 *
 * # Safety
 * The pointers are valid or NULL.
 */
enum VairResult vair_scene_find_material(const struct VairScene *scene, const char *name, uint32_t *material);

/**
 * How many joints a skin has: so many matrices vair_scene_set_joints() takes.
 *
 * # Safety
 * The pointers are valid or NULL.
 */
enum VairResult vair_scene_joint_count(const struct VairScene *scene, uint32_t skin, uint32_t *joints);

/**
 * Puts a look on the materials: the text of a look file (TOML). Images that it names are read from `folder`; NULL is the current
 * one. After an error the scene is not to be drawn.
 *
 * # Safety
 * The pointers are valid or NULL.
 */
enum VairResult vair_scene_apply_look(struct VairScene *scene,
                                      const char *look,
                                      const char *folder);

/**
 * Puts a preset, for example "fox", on a material, by its name; NULL is every material. After an error the scene is not to be
 * drawn.
 *
 * # Safety
 * The pointers are valid or NULL.
 */
enum VairResult vair_scene_apply_preset(struct VairScene *scene,
                                        const char *preset,
                                        const char *material);

/**
 * Sets a parameter of a material by its key in look files, for example "length". One uniform block is uploaded.
 *
 * # Safety
 * The pointers are valid or NULL.
 */
enum VairResult vair_scene_set_number(struct VairScene *scene, uint32_t material, const char *key, double number);

/**
 * The same for a value of any kind, as look files write it (TOML): `0.03`, `"4%"`, `[0.5, 0.2, 0.1]`, `"#804020"`, `true`.
 * Textures come with vair_scene_apply_look().
 *
 * # Safety
 * The pointers are valid or NULL.
 */
enum VairResult vair_scene_set_value(struct VairScene *scene,
                                     uint32_t material,
                                     const char *key,
                                     const char *value);

/**
 * Places a mesh. A skinned one stands as it was bound until it is posed. `instance` becomes a number that no other instance of
 * the process has.
 *
 * # Safety
 * The pointers are valid or NULL.
 */
enum VairResult vair_scene_add(struct VairScene *scene,
                               const struct VairInstanceDesc *desc,
                               uint64_t *instance);

/**
 * The first mesh at the origin.
 */
struct VairInstanceDesc vair_instance_desc_default(void);

/**
 * Places all that a scene of the file shows, in its rest pose; vair_scene_pose_nodes() poses it. `count` becomes the number of
 * instances, and the first `capacity` of them are written to `instances`, which may be NULL where that is 0.
 *
 * # Safety
 * The pointers are valid or NULL; `instances` holds `capacity` numbers.
 */
enum VairResult vair_scene_add_nodes(struct VairScene *scene,
                                     uint32_t scene_of_file,
                                     uint32_t variant,
                                     uint64_t *instances,
                                     uint32_t capacity,
                                     uint32_t *count);

/**
 * Poses what vair_scene_add_nodes() placed: at `time_s` of a clip, or at rest (VAIR_NONE). A clip holds its last pose.
 *
 * # Safety
 * `scene` is valid or NULL.
 */
enum VairResult vair_scene_pose_nodes(struct VairScene *scene, uint32_t animation, float time_s);

/**
 * Moves an instance: 16 numbers, column by column. Of a skinned one, only joints do.
 *
 * # Safety
 * The pointers are valid or NULL.
 */
enum VairResult vair_scene_set_transform(struct VairScene *scene, uint64_t instance, const float *world_from_object);

/**
 * Poses a skinned instance: for each joint of its skin 16 numbers, column by column, where the joint is times the inverse of where it
 * was bound.
 *
 * # Safety
 * The pointers are valid or NULL; `world_from_mesh` holds 16 numbers a joint.
 */
enum VairResult vair_scene_set_joints(struct VairScene *scene,
                                      uint64_t instance,
                                      const float *world_from_mesh,
                                      uint32_t joint_count);

/**
 * Sets the morph weights of an instance, one for each target of its mesh.
 *
 * # Safety
 * The pointers are valid or NULL.
 */
enum VairResult vair_scene_set_morph_weights(struct VairScene *scene,
                                             uint64_t instance,
                                             const float *weights,
                                             uint32_t weight_count);

/**
 * Shows or hides an instance. Its pose and strands stay.
 *
 * # Safety
 * `scene` is valid or NULL.
 */
enum VairResult vair_scene_set_visible(struct VairScene *scene, uint64_t instance, VkBool32 is_visible);

/**
 * Takes an instance away.
 *
 * # Safety
 * `scene` is valid or NULL.
 */
enum VairResult vair_scene_remove(struct VairScene *scene, uint64_t instance);

/**
 * Puts other pixels in the place of an image of the scene.
 *
 * # Safety
 * The pointers are valid or NULL.
 */
enum VairResult vair_scene_set_image(struct VairScene *scene, uint32_t image, const struct VairPixels *pixels);

/**
 * An image of the host's stands for an image of the scene.
 *
 * # Safety
 * The pointers are valid or NULL; the image is as for vair_image_new_on_host().
 */
enum VairResult vair_scene_set_host_image(struct VairScene *scene,
                                          struct VairRenderer *renderer,
                                          uint32_t image,
                                          const struct VairHostImage *host);

/**
 * Strands start from rest in the next frame, as after a cut.
 *
 * # Safety
 * `scene` is valid or NULL.
 */
enum VairResult vair_scene_reset_dynamics(struct VairScene *scene);

/**
 * A view of a whole target, without jitter, with clip space up and radiance as it is; the matrices are identities to be
 * replaced.
 */
struct VairView vair_view_default(uint32_t width, uint32_t height);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* VAIR_H */
