//! Small shaders with their interfaces written by hand, each for one promise of the device layer.

use crate::colored::shader;
use std::sync::LazyLock;
use vair::shader::{Binding, BindingKind, Shader, SpecConstant, Stage};

/// Covers the target without vertex inputs; reads a texture, a uniform block, a constant and a push constant.
pub(crate) static FULL_VERT: LazyLock<Shader> = LazyLock::new(|| {
    shader(
        "full.vert",
        Stage::Vertex,
        "#version 450
        void main() { gl_Position = vec4(vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 4.0 - 1.0, 0.5, 1.0); }",
    )
});

pub(crate) static TINT_FRAG: LazyLock<Shader> = LazyLock::new(|| Shader {
    bindings: &[
        Binding { set: 0, binding: 0, name: "tint", kind: BindingKind::Uniform { bytes: 16 } },
        Binding { set: 1, binding: 0, name: "base", kind: BindingKind::Texture },
        Binding { set: 1, binding: 1, name: "base_sampler", kind: BindingKind::Sampler },
    ],
    push_constant_bytes: 16,
    constants: &[SpecConstant { name: "channel_count", id: 7, default_bits: 4 }],
    ..shader(
        "tint.frag",
        Stage::Fragment,
        "#version 450
        layout(constant_id = 7) const int channel_count = 4;
        layout(set = 0, binding = 0) uniform Tint { vec4 value; } tint;
        layout(set = 1, binding = 0) uniform texture2D base;
        layout(set = 1, binding = 1) uniform sampler base_sampler;
        layout(push_constant) uniform Push { vec4 offset; };
        layout(location = 0) out vec4 color;
        void main() {
            vec4 texel = texture(sampler2D(base, base_sampler), vec2(0.5));
            color = texel * tint.value + offset;
            if (channel_count < 4) color.a = 1.0;
        }",
    )
});

pub(crate) static CORNERS_COMP: LazyLock<Shader> = LazyLock::new(|| Shader {
    bindings: &[Binding { set: 0, binding: 0, name: "corners", kind: BindingKind::Storage { readonly: false } }],
    workgroup_size: [3, 1, 1],
    ..shader(
        "corners.comp",
        Stage::Compute,
        "#version 450
        layout(local_size_x = 3) in;
        layout(set = 0, binding = 0) buffer Corners { vec2 at[]; } corners;
        void main() {
            uint i = gl_LocalInvocationIndex;
            corners.at[i] = vec2(i & 1u, i >> 1) * 4.0 - 1.0;
        }",
    )
});

pub(crate) static PAINT_COMP: LazyLock<Shader> = LazyLock::new(|| Shader {
    bindings: &[Binding { set: 0, binding: 0, name: "picture", kind: BindingKind::StorageImage }],
    workgroup_size: [4, 4, 1],
    ..shader(
        "paint.comp",
        Stage::Compute,
        "#version 450
        layout(local_size_x = 4, local_size_y = 4) in;
        layout(set = 0, binding = 0, rgba8) writeonly uniform image2D picture;
        void main() {
            ivec2 texel = ivec2(gl_LocalInvocationID.xy);
            imageStore(picture, texel, vec4(texel.x * 51.0 / 255.0, texel.y * 51.0 / 255.0, 0.0, 1.0));
        }",
    )
});

/// Copies 4x4 texels from one image to another.
pub(crate) static COPY_COMP: LazyLock<Shader> = LazyLock::new(|| Shader {
    bindings: &[
        Binding { set: 0, binding: 0, name: "target", kind: BindingKind::StorageImage },
        Binding { set: 1, binding: 0, name: "source", kind: BindingKind::Texture },
    ],
    workgroup_size: [4, 4, 1],
    ..shader(
        "copy.comp",
        Stage::Compute,
        "#version 450
        #extension GL_EXT_samplerless_texture_functions : require
        layout(local_size_x = 4, local_size_y = 4) in;
        layout(set = 0, binding = 0, rgba8) uniform writeonly image2D target;
        layout(set = 1, binding = 0) uniform texture2D source;
        void main() {
            ivec2 at = ivec2(gl_GlobalInvocationID.xy);
            imageStore(target, at, texelFetch(source, at, 0));
        }",
    )
});
