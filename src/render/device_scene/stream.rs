//! Vertex streams: what a vertex shader's inputs are made from.

use crate::shader::Shader;

/// A vertex attribute of a primitive as the device stores it: one tightly packed list each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Stream {
    /// Three floats, metres.
    Position,
    /// Three floats, unit vector.
    Normal,
    /// Four floats: unit vector and sign.
    Tangent,
    /// Two floats.
    Uv0,
    /// Two floats.
    Uv1,
    /// Four floats, linear RGBA.
    Color,
    /// Three floats: unit vector along which shells are pushed; vertices that share a position share it.
    ShellDirection,
    /// Three floats: unit vector across the shell direction, around the rest pose's vertical; the comb's first axis.
    ShellSide,
    /// Three floats: bending force of the strands' own inertia, of length in [0, 1], world space; made by the sway pass.
    Sway,
}

/// What vertices have that lack a stream: zero, and white for a colour.
pub const ABSENT: [[f32; 4]; 2] = [[0.0; 4], [1.0; 4]];

/// A vertex input and where it comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Input {
    /// Location in the shader.
    pub location: u32,
    /// Source.
    pub stream: Stream,
    /// Of which pose, where the deform pass moves the stream.
    pub pose: StreamPose,
}

/// When a stream's values are wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum StreamPose {
    /// In this frame.
    Current,
    /// In the rest pose.
    Rest,
    /// In the previous frame.
    Previous,
}

impl Stream {
    /// Bytes a vertex.
    pub fn stride(self) -> u32 {
        match self {
            Self::Position | Self::Normal | Self::ShellDirection | Self::ShellSide | Self::Sway => 12,
            Self::Tangent | Self::Color => 16,
            Self::Uv0 | Self::Uv1 => 8,
        }
    }

    /// Offset in `ABSENT` of the value that stands in where a primitive lacks the stream, bytes.
    pub fn absent_offset(self) -> u64 {
        if self == Self::Color { 16 } else { 0 }
    }

    /// The deform shader's STREAM constant; `None` for streams that no pose changes.
    pub fn skinning_kind(self) -> Option<u32> {
        match self {
            Self::Position => Some(0),
            Self::Normal | Self::ShellDirection | Self::ShellSide => Some(1),
            Self::Tangent => Some(2),
            Self::Uv0 | Self::Uv1 | Self::Color | Self::Sway => None,
        }
    }
}

/// Where each input of a vertex shader comes from, by its GLSL name.
///
/// # Panics
/// On a name that no stream has; a test walks every vertex shader.
pub fn inputs(vertex: &Shader) -> Vec<Input> {
    let source = |name: &str| match name {
        "position" => (Stream::Position, StreamPose::Current),
        "normal" => (Stream::Normal, StreamPose::Current),
        "tangent" => (Stream::Tangent, StreamPose::Current),
        "uv_0" => (Stream::Uv0, StreamPose::Current),
        "uv_1" => (Stream::Uv1, StreamPose::Current),
        "color" => (Stream::Color, StreamPose::Current),
        "shell_direction" => (Stream::ShellDirection, StreamPose::Current),
        "shell_side" => (Stream::ShellSide, StreamPose::Current),
        "sway" => (Stream::Sway, StreamPose::Current),
        "rest_normal" => (Stream::Normal, StreamPose::Rest),
        "rest_position" => (Stream::Position, StreamPose::Rest),
        "rest_direction" => (Stream::ShellDirection, StreamPose::Rest),
        "previous_position" => (Stream::Position, StreamPose::Previous),
        "previous_direction" => (Stream::ShellDirection, StreamPose::Previous),
        "previous_side" => (Stream::ShellSide, StreamPose::Previous),
        other => panic!("no vertex stream is named {other}"),
    };
    vertex
        .inputs
        .iter()
        .map(|input| {
            let (stream, pose) = source(input.name);
            Input { location: input.location, stream, pose }
        })
        .collect()
}
