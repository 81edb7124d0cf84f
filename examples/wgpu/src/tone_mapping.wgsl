// From scene-referred radiance to what a display shows (Reinhard et al. 2002); the target encodes sRGB.

@group(0) @binding(0) var radiance: texture_2d<f32>;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    // One triangle that covers the target.
    let corner = vec2f(f32(index & 1) * 4 - 1, f32(index >> 1) * 4 - 1);
    return vec4f(corner, 0, 1);
}

@fragment
fn fragment(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let color = textureLoad(radiance, vec2u(pixel.xy), 0).rgb;
    return vec4f(color / (1 + color), 1);
}
