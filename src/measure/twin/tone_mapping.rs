//! Twin of `tone_mapping.glsl`: scene-referred linear Rec. 709 to display-referred linear in [0, 1].

use super::Twin;
use super::domain::Domain;
use glam::{DMat3, DVec3};

/// Above this every curve is flat to single precision; inputs are limited to it so that nothing overflows.
pub const LARGEST_INPUT: f64 = 65504.0;

fn limited(color: DVec3) -> DVec3 {
    color.clamp(DVec3::ZERO, DVec3::splat(LARGEST_INPUT))
}

/// No curve: clamped to [0, 1].
pub fn none(color: DVec3) -> DVec3 {
    limited(color).min(DVec3::ONE)
}

/// Hill 2017, fit of the ACES reference rendering and output transforms (in "BakingLab"), with the usual exposure
/// of 1 / 0.6.
pub fn aces(color: DVec3) -> DVec3 {
    let input =
        DMat3::from_cols_array(&[0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777]);
    let output = DMat3::from_cols_array(&[
        1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602,
    ]);
    let x = input * (limited(color) / 0.6);
    let curve = (x * (x + 0.0245786) - 0.000090537) / (x * (0.983729 * x + 0.4329510) + 0.238081);
    (output * curve).clamp(DVec3::ZERO, DVec3::ONE)
}

/// Sobotka's AgX as Blender has it, in Wrensch's minimal form (2023, "Minimal AgX Implementation"): inset, log2
/// encoding, a sixth-degree polynomial for the sigmoid, outset; back to linear by the 2.2 power of the display.
pub fn agx(color: DVec3) -> DVec3 {
    const LEAST_EV: f64 = -12.47393;
    const MOST_EV: f64 = 4.026069;
    let inset = DMat3::from_cols_array(&[
        0.842479062253094,
        0.0423282422610123,
        0.0423756549057051,
        0.0784335999999992,
        0.878468636469772,
        0.0784336,
        0.0792237451477643,
        0.0791661274605434,
        0.879142973793104,
    ]);
    let outset = DMat3::from_cols_array(&[
        1.19687900512017,
        -0.0528968517574562,
        -0.0529716355144438,
        -0.0980208811401368,
        1.15190312990417,
        -0.0980434501171241,
        -0.0990297440797205,
        -0.0989611768448433,
        1.15107367264116,
    ]);
    let encode = |x: f64| ((x.max(1e-10).log2() - LEAST_EV) / (MOST_EV - LEAST_EV)).clamp(0.0, 1.0);
    let sigmoid = |x: f64| -> f64 {
        let c = [15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232];
        c.iter().fold(0.0, |sum, c| sum * x + c)
    };
    let inner = inset * limited(color);
    let curve = DVec3::new(sigmoid(encode(inner.x)), sigmoid(encode(inner.y)), sigmoid(encode(inner.z)));
    let shown = (outset * curve).clamp(DVec3::ZERO, DVec3::ONE);
    DVec3::new(shown.x.powf(2.2), shown.y.powf(2.2), shown.z.powf(2.2))
}

/// Khronos 2024, "PBR Neutral Tone Mapper": colours whose peak stays below 0.8 keep their hue and saturation, the
/// highlights above are compressed and desaturated.
pub fn neutral(color: DVec3) -> DVec3 {
    const START: f64 = 0.8 - 0.04;
    const DESATURATION: f64 = 0.15;
    let color = limited(color);
    let least = color.min_element();
    let offset = if least < 0.08 { least - 6.25 * least * least } else { 0.04 };
    let color = color - offset;
    let peak = color.max_element();
    if peak < START {
        return color;
    }
    let room = 1.0 - START;
    let new_peak = 1.0 - room * room / (peak + room - START);
    let grey = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    (color * (new_peak / peak)).lerp(DVec3::splat(new_peak), grey).clamp(DVec3::ZERO, DVec3::ONE)
}

/// A channel of scene-referred radiance, at the joints of the curves, and beyond what a target holds.
const RADIANCE: Domain =
    Domain::Log(1e-6, 1e6, &[-1e30, -1.0, 0.0, 1e-40, 1e-10, 0.08, 0.76, 1.0, 65504.0, 1e30, f32::MAX]);

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("tonemap_limited", &[RADIANCE], |inputs| {
        inputs.vec3().clamp(DVec3::ZERO, DVec3::splat(LARGEST_INPUT)).to_array().to_vec()
    }),
    Twin::new("tonemap_none", &[RADIANCE], |inputs| none(inputs.vec3()).to_array().to_vec()),
    Twin::new("tonemap_aces", &[RADIANCE], |inputs| aces(inputs.vec3()).to_array().to_vec()),
    Twin::new("tonemap_agx", &[RADIANCE], |inputs| agx(inputs.vec3()).to_array().to_vec()).limit(2e-5, AGX_ROUNDING),
    Twin::new("tonemap_neutral", &[RADIANCE], |inputs| neutral(inputs.vec3()).to_array().to_vec()),
];

/// The sigmoid's coefficients have magnitudes of 95 together, each rounded by half a unit of 2^-23 in its running sum;
/// the outset adds up 1.4 of it and the power of 2.2 stretches it by as much.
const AGX_ROUNDING: f64 = 95.0 * super::ULP / 2.0 * 1.4 * 2.2;
