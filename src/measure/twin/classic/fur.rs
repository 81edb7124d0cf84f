//! Classic fur: Lengyel's concentric shells as older engines drew them, and Kajiya & Kay's thin hair.
//!
//! Lengyel et al. 2001, "Real-Time Fur over Arbitrary Surfaces"; Kajiya & Kay 1989, "Rendering Fur with Three
//! Dimensional Textures".

use glam::DVec3;

/// Range of the edge fade, and of the strength of the force.
pub const SHARE: (f64, f64) = (0.0, 1.0);
/// Range of the height in the fur that layers are drawn at.
pub const HEIGHT: (f64, f64) = (0.05, 0.95);
/// Range of the exponent of thin hair's highlight.
pub const EXPONENT: (f64, f64) = (1.0, 1000.0);

/// Opacity of a layer inside a strand; `cosine_to_eye` in [-1, 1].
///
/// Defect: it lies between -1.90 and 1.9975. Negative layers brighten what they cover.
pub fn opacity(height: f64, cosine_to_eye: f64, edge_fade: f64) -> f64 {
    1.0 - height * height + cosine_to_eye - edge_fade
}

/// What the nineteen layers at .05, .10, .. .95 hide, inside a strand, of what lies behind, blended one over the other.
///
/// Defect: at the outline, with edge_fade = 1, it is -138: the blend has brightened what lies behind 139 times.
pub fn column_coverage(cosine_to_eye: f64, edge_fade: f64) -> f64 {
    let through: f64 = (1..20).map(|layer| 1.0 - opacity(f64::from(layer) / 20.0, cosine_to_eye, edge_fade)).product();
    1.0 - through
}

/// Where a strand of length 1 is at a height: `k ((1 - k s) n + k s g)`, as (along the normal, sideways), for a force of
/// strength `s` at `angle` radians from the normal.
///
/// Defects: a strand is not as long as it was (0.41 to 1.26), layers fall below inner ones for s > 0.5, and the tip ends
/// in the skin at s = 1 or a whole length under it.
pub fn place(height: f64, strength: f64, angle: f64) -> [f64; 2] {
    let bend = height * strength;
    let (sine, cosine) = angle.sin_cos();
    [height * (1.0 - bend + bend * cosine), height * bend * sine]
}

/// Thin hair's diffuse term for kd = 1: the sine between strand and light.
///
/// Defect: its integral over all lights is pi squared.
pub fn thin_diffuse(tangent: DVec3, to_light: DVec3) -> f64 {
    tangent.cross(to_light).length()
}

/// Thin hair's highlight for ks = 1: `cos(angle off the mirror cone)^exponent`, times the sine of the light, which is
/// what a strand receives.
///
/// Defect: not normalised: seen across, 8.4 times the light at exponent 1, 1.38 at 128, 0.50 at 1000.
pub fn thin_highlight(tangent: DVec3, to_eye: DVec3, to_light: DVec3, exponent: f64) -> f64 {
    let sines = tangent.cross(to_eye).length() * tangent.cross(to_light).length();
    let cosine = sines - tangent.dot(to_eye) * tangent.dot(to_light);
    cosine.max(0.0).powf(exponent) * thin_diffuse(tangent, to_light)
}
