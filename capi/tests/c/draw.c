/* A C program draws a ball of fur into its own pass, through nothing but vair.h, and looks at the pixels. */
#include "host.h"

#include <math.h>
#include <stdbool.h>

#define COLUMNS 48
#define ROWS 24
#define VERTICES ((COLUMNS + 1) * (ROWS + 1))
#define INDICES (COLUMNS * ROWS * 6)
#define RADIUS_M 0.5f
#define FUR_M 0.06f
#define DISTANCE_M 2.0f

static const float PI = 3.14159265f;
static const float BACKGROUND[4] = {0.0f, 0.25f, 0.5f, 1.0f};
static const uint8_t RED[4] = {230, 120, 50, 255};
static const uint8_t BLUE[4] = {50, 120, 230, 255};

typedef struct Ball {
    float positions[VERTICES * 3];
    float normals[VERTICES * 3];
    float uvs[VERTICES * 2];
    uint32_t indices[INDICES];
} Ball;

static void make_ball(Ball *ball) {
    for (uint32_t row = 0; row <= ROWS; row++) {
        for (uint32_t column = 0; column <= COLUMNS; column++) {
            uint32_t vertex = row * (COLUMNS + 1) + column;
            float u = (float)column / COLUMNS, v = (float)row / ROWS;
            float normal[3] = {sinf(PI * v) * sinf(2 * PI * u), cosf(PI * v), sinf(PI * v) * cosf(2 * PI * u)};
            for (int axis = 0; axis < 3; axis++) {
                ball->normals[vertex * 3 + axis] = normal[axis];
                ball->positions[vertex * 3 + axis] = RADIUS_M * normal[axis];
            }
            ball->uvs[vertex * 2] = u;
            ball->uvs[vertex * 2 + 1] = v;
        }
    }
    uint32_t *next = ball->indices;
    for (uint32_t row = 0; row < ROWS; row++) {
        for (uint32_t column = 0; column < COLUMNS; column++) {
            uint32_t corner = row * (COLUMNS + 1) + column, below = corner + COLUMNS + 1;
            uint32_t cell[6] = {corner, below, corner + 1, corner + 1, below, below + 1};
            memcpy(next, cell, sizeof cell);
            next += 6;
        }
    }
}

static bool says(const char *text) {
    return strstr(vair_last_error_message(), text) != NULL;
}

static VairRenderer *make_renderer(Host *host) {
    VairRenderer *renderer = (VairRenderer *)host;
    VkPhysicalDeviceFeatures2 nothing = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    VairHostDevice lent = {.get_instance_proc_addr = vkGetInstanceProcAddr,
                           .instance = host->instance,
                           .physical_device = host->physical_device,
                           .device = host->device,
                           .queue = host->queue,
                           .queue_family = host->queue_family,
                           .enabled_features = &nothing,
                           .has_debug_utils = VK_TRUE};
    CHECK(vair_renderer_new_on_host(NULL, &renderer) == VAIR_ERROR_ARGUMENT && says("host is NULL"));
    CHECK(renderer == NULL);
    CHECK(vair_renderer_new_on_host(&lent, NULL) == VAIR_ERROR_ARGUMENT && says("renderer is NULL"));
    CHECK(vair_renderer_new_on_host(&lent, &renderer) == VAIR_ERROR_UNSUPPORTED && says("dynamic_rendering"));
    lent.enabled_features = &host->features;
    CHECK(vair_renderer_new_on_host(&lent, &renderer) == VAIR_OK && renderer);
    return renderer;
}

static VairScene *make_scene(void) {
    Ball *ball = malloc(sizeof *ball);
    CHECK(ball);
    make_ball(ball);
    VairPixels red = {.name = "red", .width = 1, .height = 1, .rgba = RED};
    VairMaterial material = {.name = "ball", .base_color = {1, 1, 1, 1}, .base_color_image = 7, .roughness = 1};
    VairMesh mesh = {.name = "ball",
                     .vertex_count = VERTICES,
                     .positions = ball->positions,
                     .uvs = ball->uvs,
                     .indices = ball->indices,
                     .index_count = INDICES};
    VairSceneDesc desc = {.meshes = &mesh,
                          .mesh_count = 1,
                          .materials = &material,
                          .material_count = 1,
                          .images = &red,
                          .image_count = 1};
    VairScene *scene;
    CHECK(vair_scene_load("no such file.glb", &scene) == VAIR_ERROR_FILE && says("no such file.glb"));
    CHECK(vair_scene_new(&desc, &scene) == VAIR_ERROR_FILE && says("normals"));
    mesh.normals = ball->normals;
    ball->indices[7] = VERTICES;
    CHECK(vair_scene_new(&desc, &scene) == VAIR_ERROR_FILE && says("indices"));
    make_ball(ball);
    CHECK(vair_scene_new(&desc, &scene) == VAIR_ERROR_FILE && says("textures"));
    material.base_color_image = 0;
    CHECK(vair_scene_new(&desc, &scene) == VAIR_OK);
    free(ball);

    VairSceneInfo info;
    CHECK(vair_scene_info(scene, &info) == VAIR_OK && info.meshes == 1 && info.materials == 1 && info.instances == 0);
    uint32_t index = VAIR_NONE;
    CHECK(vair_scene_find_material(scene, "bull", &index) == VAIR_ERROR_SCENE && says("ball"));
    CHECK(vair_scene_find_material(scene, "ball", &index) == VAIR_OK && index == 0);
    CHECK(vair_scene_apply_preset(scene, "fux", NULL) == VAIR_ERROR_MATERIAL && says("fox"));
    CHECK(vair_scene_apply_preset(scene, "fox", "bull") == VAIR_ERROR_SCENE && says("ball"));
    CHECK(vair_scene_apply_look(scene, "not a look", NULL) == VAIR_ERROR_MATERIAL && says("look"));
    CHECK(vair_scene_apply_preset(scene, "fox", "ball") == VAIR_OK);
    CHECK(vair_scene_set_number(scene, 0, "lenght", 1) == VAIR_ERROR_MATERIAL && says("length"));
    CHECK(vair_scene_set_value(scene, 0, "length", "long") == VAIR_ERROR_MATERIAL && says("quotes"));
    CHECK(vair_scene_set_value(scene, 0, "length", "\"5%\"") == VAIR_OK);
    CHECK(vair_scene_set_number(scene, 0, "length", FUR_M) == VAIR_OK);
    float radiance[3] = {0.5f, 0.5f, 0.5f}, no_light[3] = {-1, 0, 0};
    CHECK(vair_scene_set_environment_constant(scene, no_light) == VAIR_ERROR_ARGUMENT && says("radiance"));
    CHECK(vair_scene_set_environment_constant(scene, radiance) == VAIR_OK);
    return scene;
}

static uint64_t add_ball(VairScene *scene) {
    VairInstanceDesc desc = vair_instance_desc_default();
    uint64_t ball, gone;
    desc.mesh = 3;
    CHECK(vair_scene_add(scene, &desc, &gone) == VAIR_ERROR_ARGUMENT && says("mesh"));
    desc.mesh = 0;
    CHECK(vair_scene_add(scene, &desc, &gone) == VAIR_OK);
    CHECK(vair_scene_add(scene, &desc, &ball) == VAIR_OK && ball != gone);
    CHECK(vair_scene_remove(scene, gone) == VAIR_OK);
    CHECK(vair_scene_set_visible(scene, gone, VK_TRUE) == VAIR_ERROR_ARGUMENT && says("removed"));
    CHECK(vair_scene_set_transform(scene, ball, NULL) == VAIR_ERROR_ARGUMENT && says("world_from_object"));
    float joint[16] = {0};
    CHECK(vair_scene_set_joints(scene, ball, joint, 1) == VAIR_ERROR_ARGUMENT && says("joints"));
    return ball;
}

/* A mesh that joints carry and a target bends: what its pose may be. */
static void pose_a_triangle(void) {
    float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, normals[9] = {0, 0, 1, 0, 0, 1, 0, 0, 1}, offsets[9] = {0};
    uint16_t joints[12] = {0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0};
    float weights[12] = {0.5f, 0.5f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    uint32_t indices[3] = {0, 1, 2};
    VairMaterial material = {.name = "skin", .base_color = {1, 1, 1, 1}, .base_color_image = VAIR_NONE};
    VairMesh mesh = {.vertex_count = 3,
                     .positions = positions,
                     .normals = normals,
                     .joints = joints,
                     .weights = weights,
                     .joint_count = 1,
                     .indices = indices,
                     .index_count = 3,
                     .morph_target_count = 1,
                     .morph_positions = offsets};
    VairSceneDesc desc = {.meshes = &mesh, .mesh_count = 1, .materials = &material, .material_count = 1};
    VairScene *scene;
    CHECK(vair_scene_new(&desc, &scene) == VAIR_ERROR_FILE && says("joint"));
    mesh.joint_count = 2;
    CHECK(vair_scene_new(&desc, &scene) == VAIR_OK);
    uint32_t count = 0;
    CHECK(vair_scene_joint_count(scene, 1, &count) == VAIR_ERROR_SCENE);
    CHECK(vair_scene_joint_count(scene, 0, &count) == VAIR_OK && count == 2);
    VairInstanceDesc placed = vair_instance_desc_default();
    placed.skin = 0;
    uint64_t triangle, nodes[2];
    CHECK(vair_scene_add(scene, &placed, &triangle) == VAIR_OK);
    float matrices[32] = {0};
    for (int joint = 0; joint < 2; joint++) {
        for (int axis = 0; axis < 4; axis++) {
            matrices[16 * joint + 5 * axis] = 1;
        }
    }
    CHECK(vair_scene_set_joints(scene, triangle, matrices, 1) == VAIR_ERROR_ARGUMENT && says("2 joints"));
    CHECK(vair_scene_set_joints(scene, triangle, matrices, 2) == VAIR_OK);
    CHECK(vair_scene_set_morph_weights(scene, triangle, matrices, 2) == VAIR_ERROR_ARGUMENT && says("1 targets"));
    CHECK(vair_scene_set_morph_weights(scene, triangle, matrices, 1) == VAIR_OK);
    CHECK(vair_scene_add_nodes(scene, 0, VAIR_NONE, nodes, 2, &count) == VAIR_OK && count == 1);
    CHECK(vair_scene_pose_nodes(scene, VAIR_NONE, 0) == VAIR_OK);
    CHECK(vair_scene_pose_nodes(scene, 0, 0) == VAIR_ERROR_ARGUMENT && says("animation"));
    CHECK(vair_scene_remove(scene, nodes[0]) == VAIR_OK);
    VairSceneInfo info;
    CHECK(vair_scene_info(scene, &info) == VAIR_OK && info.skins == 1 && info.instances == 1);
    vair_scene_free(scene);
}

/* One frame of the host's. */
static void draw(Host *host, VairRenderer *renderer, VairScene *scene, uint16_t *halves) {
    VairView view = vair_view_default(SIZE, SIZE);
    view.view_from_world[14] = -DISTANCE_M;
    /* 60 degrees, reversed depth without a far plane. */
    memset(view.clip_from_view, 0, sizeof view.clip_from_view);
    view.clip_from_view[0] = view.clip_from_view[5] = 1 / tanf(PI / 6);
    view.clip_from_view[11] = -1;
    view.clip_from_view[14] = 0.1f;
    VairLight sun = {.kind = VAIR_LIGHT_DIRECTIONAL, .direction_to_light = {1, 2, 2}, .intensity = {2, 2, 2}};
    VairFrameDesc desc = vair_frame_desc_default();
    desc.target.color = COLOR_FORMAT;
    desc.target.depth = DEPTH_FORMAT;
    desc.target.samples = 1;
    desc.shadow_resolution_px = 256;
    desc.lights = &sun;
    desc.light_count = 1;

    VairFrame *frame, *second;
    host_begin_commands(host);
    CHECK(vair_frame_begin(renderer, NULL, &frame) == VAIR_ERROR_ARGUMENT && says("command_buffer"));
    CHECK(vair_frame_begin(renderer, host->commands, &frame) == VAIR_OK);
    CHECK(vair_frame_begin(renderer, host->commands, &second) == VAIR_ERROR_ARGUMENT && says("finish"));
    CHECK(second == NULL);
    CHECK(vair_frame_prepare(frame, scene, &desc) == VAIR_ERROR_ARGUMENT && says("views"));
    desc.views = &view;
    desc.view_count = 1;
    view.pre_exposure = 0;
    CHECK(vair_frame_prepare(frame, scene, &desc) == VAIR_ERROR_ARGUMENT && says("pre_exposure"));
    view.pre_exposure = 1;
    sun.kind = 9;
    CHECK(vair_frame_prepare(frame, scene, &desc) == VAIR_ERROR_ARGUMENT && says("lights[0]"));
    sun.kind = VAIR_LIGHT_DIRECTIONAL;
    CHECK(vair_frame_prepare(frame, scene, &desc) == VAIR_OK);

    host_begin_pass(host, BACKGROUND);
    CHECK(vair_frame_draw_opaque(frame, host->commands, scene, 0) == VAIR_OK);
    CHECK(vair_frame_draw_fur(frame, host->commands, scene, 0) == VAIR_OK);
    CHECK(vair_frame_draw_transparent(frame, host->commands, scene, 0) == VAIR_OK);
    CHECK(vair_frame_draw_fur(frame, host->commands, scene, 1) == VAIR_ERROR_ARGUMENT && says("view"));
    CHECK(vair_frame_draw_motion(frame, host->commands, scene, 0) == VAIR_ERROR_ARGUMENT && says("motion"));
    CHECK(vair_frame_cast_shadows(frame, host->commands, scene, 0) == VAIR_ERROR_ARGUMENT && says("cast_into"));
    uint64_t token;
    CHECK(vair_frame_finish(frame, NULL) == VAIR_ERROR_ARGUMENT && says("token"));
    CHECK(vair_frame_finish(frame, &token) == VAIR_OK);
    host_end(host, halves);
    /* By turns as a fence and as a timeline tell it. */
    if (token % 2) {
        CHECK(vair_renderer_frame_passed(renderer, token) == VAIR_OK);
    } else {
        CHECK(vair_renderer_frame_on_timeline(renderer, token, token) == VAIR_OK);
        CHECK(vair_renderer_timeline_passed(renderer, token) == VAIR_OK);
    }
    CHECK(vair_renderer_frame_passed(renderer, token) == VAIR_ERROR_ARGUMENT && says("given back"));
}

static float number_of_half(uint16_t half) {
    int exponent = half >> 10 & 31, mantissa = half & 1023;
    float magnitude = exponent == 31 ? (mantissa ? NAN : INFINITY)
                      : exponent     ? ldexpf((float)(1024 + mantissa), exponent - 25)
                                     : ldexpf((float)mantissa, -24);
    return half >> 15 ? -magnitude : magnitude;
}

static bool is_background(const uint16_t *pixel) {
    for (int channel = 0; channel < 4; channel++) {
        if (number_of_half(pixel[channel]) != BACKGROUND[channel]) {
            return false;
        }
    }
    return true;
}

static float coverage(const uint16_t *halves) {
    unsigned drawn = 0;
    for (unsigned pixel = 0; pixel < SIZE * SIZE; pixel++) {
        drawn += !is_background(halves + 4 * pixel);
    }
    return (float)drawn / (SIZE * SIZE);
}

/* The share of the picture that a ball of that radius covers. */
static float coverage_of_ball(float radius_m) {
    float tangent = radius_m / sqrtf(DISTANCE_M * DISTANCE_M - radius_m * radius_m);
    float in_clip = tangent / tanf(PI / 6);
    return PI * in_clip * in_clip / 4;
}

int main(void) {
    CHECK(vair_interface_version() == VAIR_INTERFACE_VERSION);
    CHECK(strlen(vair_version()) > 0 && strstr(vair_features(), "dynamic_rendering: "));
    CHECK(strcmp(vair_last_error_message(), "") == 0);
    vair_renderer_free(NULL);
    vair_scene_free(NULL);
    vair_image_free(NULL);

    Host *host = host_new();
    VairRenderer *renderer = make_renderer(host);
    VairScene *scene = make_scene();
    uint64_t ball = add_ball(scene);

    pose_a_triangle();

    static uint16_t first[SIZE * SIZE * 4], again[SIZE * SIZE * 4], dyed[SIZE * SIZE * 4], hidden[SIZE * SIZE * 4];
    draw(host, renderer, scene, first);
    draw(host, renderer, scene, again);
    VairPixels blue_dye = {.width = 1, .height = 1, .rgba = BLUE};
    CHECK(vair_scene_set_image(scene, 1, &blue_dye) == VAIR_ERROR_FILE && says("images[1]"));
    CHECK(vair_scene_set_image(scene, 0, &blue_dye) == VAIR_OK);
    draw(host, renderer, scene, dyed);
    CHECK(vair_scene_set_visible(scene, ball, VK_FALSE) == VAIR_OK);
    draw(host, renderer, scene, hidden);

    for (unsigned index = 0; index < SIZE * SIZE * 4; index++) {
        float number = number_of_half(first[index]);
        CHECK(isfinite(number) && number >= 0);
    }
    for (unsigned corner = 0; corner < 4; corner++) {
        unsigned x = corner % 2 * (SIZE - 1), y = corner / 2 * (SIZE - 1);
        CHECK(is_background(first + 4 * (y * SIZE + x)));
    }
    unsigned middle = 4 * (SIZE / 2 * SIZE + SIZE / 2);
    const uint16_t *center = first + middle;
    float red = number_of_half(center[0]), blue = number_of_half(center[2]);
    /* Strands stand between the skin and their tips; not all pixels at the rim have one. */
    float covered = coverage(first), skin = coverage_of_ball(RADIUS_M), tips = coverage_of_ball(RADIUS_M + FUR_M);
    printf("coverage %.4f, skin %.4f, tips %.4f; centre %.3f %.3f %.3f\n", covered, skin, tips, red,
           number_of_half(center[1]), blue);
    CHECK(!is_background(center) && red > 0.02f && red > 1.2f * blue);
    CHECK(covered > skin * 1.02f && covered < tips * 1.02f);
    CHECK(number_of_half(dyed[middle]) < number_of_half(dyed[middle + 2]));
    CHECK(memcmp(first, again, sizeof first) == 0);
    CHECK(coverage(hidden) == 0);

    /* The picture that the program `vair` makes: a frame of vair's own on the host's queue. */
    static uint8_t picture[32 * 32 * 4];
    CHECK(vair_renderer_picture(renderer, scene, 32, 32, picture, 7) == VAIR_ERROR_ARGUMENT && says("7 bytes"));
    CHECK(vair_renderer_picture(renderer, scene, 32, 32, picture, sizeof picture) == VAIR_OK);
    const uint8_t *pixel = picture + 4 * (16 * 32 + 16);
    CHECK(pixel[2] > pixel[0] && pixel[3] == 255);

    vair_scene_free(scene);
    vair_renderer_free(renderer);
    host_free(host);
    puts("drawn");
    return 0;
}
