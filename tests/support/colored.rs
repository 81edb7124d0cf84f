//! A vertex and a fragment shader that pass a colour on, with their interfaces written by hand.

use crate::glsl::compile;
use std::sync::LazyLock;
use vair::shader::{Shader, Stage, VertexFormat, VertexInput};

/// A shader without an interface.
pub(crate) fn shader(name: &'static str, stage: Stage, source: &str) -> Shader {
    Shader {
        name,
        stage,
        spirv: compile(name, stage, source),
        spirv_hash: 0,
        bindings: &[],
        push_constant_bytes: 0,
        constants: &[],
        inputs: &[],
        workgroup_size: [0; 3],
    }
}

/// Position and colour as two streams.
pub(crate) static COLORED_VERT: LazyLock<Shader> = LazyLock::new(|| Shader {
    inputs: &[
        VertexInput { name: "position", location: 0, format: VertexFormat::Vec2 },
        VertexInput { name: "color", location: 1, format: VertexFormat::Vec4 },
    ],
    ..shader(
        "colored.vert",
        Stage::Vertex,
        "#version 450
        layout(location = 0) in vec2 position;
        layout(location = 1) in vec4 color;
        layout(location = 0) out vec4 v_color;
        void main() { gl_Position = vec4(position, 0.5, 1.0); v_color = color; }",
    )
});

pub(crate) static COLORED_FRAG: LazyLock<Shader> = LazyLock::new(|| {
    shader(
        "colored.frag",
        Stage::Fragment,
        "#version 450
        layout(location = 0) in vec4 v_color;
        layout(location = 0) out vec4 color;
        void main() { color = v_color; }",
    )
});
