//! Twin of `transparency.glsl`, and what it is all for: the light that comes through a stack of layers.

use super::domain::{Domain, UNIT};
use super::{Limit, Rule, Twin};
use glam::DVec3;

/// Largest radiance that an entry keeps.
pub const LARGEST_RADIANCE: f64 = 64512.0;
/// Steps of a packed transmittance.
pub const TRANSMITTANCE_STEPS: f64 = 4095.0;

/// Bits of the half float nearest to `x` in [0, 65504], the even one of two (IEEE 754-2008, binary16).
pub fn half_bits(x: f64) -> u32 {
    // Numbers that share an exponent are that far apart; below the smallest exponent they stay so.
    let exponent = x.max(f64::MIN_POSITIVE).log2().floor().max(-14.0);
    let steps = (x / (exponent - 10.0).exp2()).round_ties_even();
    // The leading bit of the significand counts the exponent up.
    (steps + (exponent + 14.0) * 1024.0) as u32
}

/// The number that such bits mean.
pub fn half_value(bits: u32) -> f64 {
    let (exponent, significand) = (bits >> 10, f64::from(bits & 1023));
    match exponent {
        0 => significand * (-24f64).exp2(),
        _ => (1024.0 + significand) * (f64::from(exponent) - 25.0).exp2(),
    }
}

/// One channel of an entry.
pub fn packed(radiance: f64, transmittance: f64, rest: u32) -> u32 {
    let passed = (transmittance.clamp(0.0, 1.0) * TRANSMITTANCE_STEPS + 0.5).floor() as u32;
    (half_bits(radiance.clamp(0.0, LARGEST_RADIANCE)) << 17) | (passed << 5) | rest
}

/// Weight of what lies at a reversed depth (McGuire & Bavoil 2013, equation 10).
pub fn weight(depth: f64) -> f64 {
    (3e3 * depth.powi(3)).clamp(1e-2, 3e3)
}

/// Beer-Lambert: `color` to the power of the way.
pub fn attenuation(color: DVec3, way: f64) -> DVec3 {
    if way > 0.0 { color.powf(way) } else { DVec3::ONE }
}

/// A layer that light passes: what it adds, and the share of each channel that it lets through.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// Distance from the eye, in any unit that grows with it.
    pub distance: f64,
    /// Premultiplied, linear RGB.
    pub radiance: DVec3,
    /// Of the light behind it, [0, 1].
    pub transmittance: DVec3,
}

/// What the eye sees of layers in any order before `behind`: the truth that every method is measured against.
pub fn composed(layers: &[Layer], behind: DVec3) -> DVec3 {
    let mut far_to_near = layers.to_vec();
    far_to_near.sort_by(|a, b| b.distance.total_cmp(&a.distance));
    far_to_near.iter().fold(behind, |seen, layer| layer.radiance + layer.transmittance * seen)
}

/// What halves hold: subnormal ones, and the largest that is kept.
const RADIANCE: Domain = Domain::Log(1e-9, 64512.0, &[0.0, 1e-40, 6.1e-5, 1.0, 1.000_488_3, 2048.0, 64512.0]);
const REST: Domain = Domain::Choice(&[0, 1, 16, 31]);
/// A number below the smallest normal one is zero to some devices, and not to a small power.
const COLOR: Domain = Domain::Uniform(0.0, 1.0, &[0.0, 1e-8, 0.5, 1.0]);
/// Distances after which nothing is left, or nothing is lost.
const WAY: Domain = Domain::Log(1e-6, 1e3, &[0.0, 1e-40, 1.0, 1e3]);

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin {
        limit: Limit::EXACT,
        ..Twin::new("transparency_half", &[RADIANCE], |inputs| vec![f64::from(half_bits(inputs.number()))])
    }
    // Where two halves are equally near.
    .rule(Rule::Stepped(1)),
    Twin {
        limit: Limit::EXACT,
        ..Twin::new("transparency_packed", &[RADIANCE, UNIT, REST], |inputs| {
            vec![f64::from(packed(inputs.number(), inputs.number(), inputs.uint()))]
        })
    }
    .rule(Rule::Stepped(4)),
    Twin::new("transparency_radiance", &[Domain::Bits], |inputs| vec![half_value(inputs.uint() >> 17)]).limit(0.0, 0.0),
    Twin::new("transparency_transmittance", &[Domain::Bits], |inputs| {
        vec![f64::from(inputs.uint() >> 5 & 4095) / TRANSMITTANCE_STEPS]
    }),
    Twin::new("transparency_weight", &[UNIT], |inputs| vec![weight(inputs.number())]),
    // Vulkan has the logarithm within 2^-21 where it is near 0; the power multiplies it by the way.
    Twin::new("transparency_attenuation", &[COLOR, WAY], |inputs| {
        attenuation(inputs.vec3(), inputs.number()).to_array().to_vec()
    })
    .allowance(|inputs| {
        let (color, way) = (inputs.vec3(), inputs.number());
        (attenuation(color, way) * way * 2f64.powi(-21)).to_array().to_vec()
    }),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_are_those_of_ieee_754() {
        for bits in 0..31 * 1024 {
            assert_eq!(half_value(bits), f64::from(half::f16::from_bits(bits as u16).to_f32()), "{bits}");
            assert_eq!(half_bits(half_value(bits)), bits);
            let between = 0.5 * (half_value(bits) + half_value(bits + 1));
            let even = bits + (bits & 1);
            assert_eq!(half_bits(between), even, "{between}");
        }
    }

    /// Twelve layers, packed: what that loses is below a two-hundredth of an eight-bit step of what is seen.
    #[test]
    fn packing_a_stack_loses_less_than_can_be_seen() {
        let layer = |index: u32| Layer {
            distance: f64::from(index),
            radiance: DVec3::new(0.013, 0.21, 0.07) * f64::from(index % 3 + 1),
            transmittance: DVec3::new(0.93, 0.71, 0.999),
        };
        let layers: Vec<_> = (0..12).map(layer).collect();
        let stored = |x: f64| half_value(half_bits(x));
        let passed = |x: f64| f64::from(packed(0.0, x, 0) >> 5 & 4095) / TRANSMITTANCE_STEPS;
        let packed: Vec<_> = layers
            .iter()
            .map(|layer| Layer {
                radiance: DVec3::from_array(layer.radiance.to_array().map(stored)),
                transmittance: DVec3::from_array(layer.transmittance.to_array().map(passed)),
                ..*layer
            })
            .collect();
        let error = composed(&packed, DVec3::ONE) - composed(&layers, DVec3::ONE);
        // Each layer may be off by half a step of either, and what it passes on by no more than it was off.
        let bound = 12.0 * (0.5 / TRANSMITTANCE_STEPS * 8.0 + 0.63 * 2f64.powi(-11));
        assert!(error.abs().max_element() <= bound, "{error}");
        assert!(error.abs().max_element() < 4e-3, "{error}");
    }

    #[test]
    fn the_order_of_the_list_does_not_matter() {
        let red = Layer { distance: 2.0, radiance: DVec3::X * 0.5, transmittance: DVec3::splat(0.5) };
        let green = Layer { distance: 1.0, radiance: DVec3::Y * 0.25, transmittance: DVec3::new(0.75, 0.75, 0.0) };
        let seen = composed(&[red, green], DVec3::ONE);
        assert_eq!(seen, composed(&[green, red], DVec3::ONE));
        assert_eq!(seen, DVec3::new(0.75, 0.25 + 0.375, 0.0));
    }
}
