//! Claims of the strands of fur.

use super::claim::{Claim, Input};
use super::quadrature::{direction, over_sphere};
use super::{ALBEDO_LIMIT, light};
use crate::material::Fur;
use crate::material::reference::strand;
use glam::DVec3;

/// A strand and the eye, from the first six inputs of most claims here.
struct Strand {
    color: f64,
    specular: f64,
    variance: f64,
    tangent: DVec3,
    to_eye: DVec3,
}

impl Strand {
    fn new(x: &[f64]) -> Self {
        Self {
            color: x[0],
            specular: x[1],
            variance: strand::variance(x[2]),
            tangent: direction(x[3].to_radians().cos(), 0.0),
            to_eye: direction(x[4], x[5].to_radians()),
        }
    }

    fn scattering(&self, to_eye: DVec3, to_light: DVec3) -> f64 {
        strand::scattering(self.color, DVec3::Z, self.tangent, to_eye, to_light, self.specular, self.variance)
    }

    /// Share of white light from everywhere that comes back, by that lobe.
    fn albedo(&self, scattering: impl Fn(&Self, DVec3, DVec3) -> f64) -> f64 {
        over_sphere(self.tangent, self.to_eye, |to_light| scattering(self, self.to_eye, to_light))
    }
}

/// Everything that is promised of fur.
pub fn claims() -> Vec<Claim> {
    let inputs = vec![
        Input::of::<Fur>("base_color"),
        Input::of::<Fur>("specular"),
        Input::of::<Fur>("roughness"),
        Input::between("strand_to_normal_deg", (0.0, 90.0)),
        Input::signed_cosine("cosine_to_eye"),
        Input::turn("strand_to_eye_deg"),
    ];
    let lit =
        [inputs.clone(), vec![Input::signed_cosine("cosine_to_light"), Input::turn("strand_to_light_deg")]].concat();
    let claim =
        |property, limit, inputs, value| Claim { material: "fur", property, classic: false, limit, inputs, value };
    let mut claims = vec![
        claim(
            "directional albedo",
            Some(ALBEDO_LIMIT),
            inputs,
            Box::new(|x| Strand::new(x).albedo(Strand::scattering)),
        ),
        claim(
            "integral of a lobe",
            Some(ALBEDO_LIMIT),
            vec![
                Input::of::<Fur>("roughness"),
                Input::signed_cosine("sine_to_eye"),
                // From the white highlight's, towards the root, to the coloured one's, towards the tip.
                Input::between("shift", (-0.08, 0.12)),
                Input::between("widening", (1.0, 4.0)),
            ],
            Box::new(|x| {
                let (eye, variance) = (direction(x[1], 0.0), x[3] * strand::variance(x[0]));
                over_sphere(DVec3::Z, eye, |light| strand::lobe(DVec3::Z, eye, light, x[2], variance))
            }),
        ),
        // Wrapped light asks the light's side only: not reciprocal, by design.
        claim(
            "scattering over itself swapped",
            None,
            lit.clone(),
            Box::new(|x| {
                let (strand, to_light) = (Strand::new(x), direction(x[6].abs(), x[7].to_radians()));
                let to_eye = DVec3::new(strand.to_eye.x, strand.to_eye.y, strand.to_eye.z.abs());
                let (there, back) = (strand.scattering(to_eye, to_light), strand.scattering(to_light, to_eye));
                if back > 0.0 { there / back } else { 1.0 }
            }),
        ),
        claim(
            "light through the coat",
            Some(1.0),
            vec![
                Input::between("height", (0.0, 1.0)),
                Input::of::<Fur>("occlusion"),
                Input::signed_cosine("cosine_to_light"),
            ],
            Box::new(|x| strand::light_through_coat(x[0], x[1], x[2])),
        ),
        claim(
            "opacity outside 0 to 1, by",
            Some(0.0),
            vec![
                Input::between("margin", (-1e3, 1.0)),
                Input::between("slope", (0.0, 4.0)),
                Input::between("threshold", (0.0, 1.0)),
                Input::of::<Fur>("thickness"),
                Input::between("length_in_cells", (0.0, 10.0)),
            ],
            Box::new(|x| {
                let radius = 0.5 * x[3];
                let (cap, width) = (strand::cross_section(x[2], radius), strand::width(x[2], radius));
                outside(strand::opacity(x[0], x[1], strand::slab_opacity(cap, width, x[4])))
            }),
        ),
    ];
    claims.extend(light::claims("fur", false, &lit, |x, irradiance| {
        let (strand, to_light) = (Strand::new(x), direction(x[6], x[7].to_radians()));
        irradiance * strand.scattering(strand.to_eye, to_light)
    }));
    claims
}

/// How far a share lies outside 0 to 1.
pub fn outside(share: f64) -> f64 {
    // Not `max(0)` alone, which NaN would pass.
    if (0.0..=1.0).contains(&share) { 0.0 } else { (share - 1.0).max(-share).abs() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_doubled_lobe_fails() {
        let mut claim = claims().remove(0);
        assert!(claim.judge(0).pass);
        claim.value = Box::new(|x| Strand::new(x).albedo(|strand, eye, light| 2.0 * strand.scattering(eye, light)));
        assert!(claim.judge(0).fails());
    }

    #[test]
    fn what_lies_outside_is_told() {
        assert_eq!([outside(0.0), outside(1.0), outside(2.0), outside(-1.5)], [0.0, 0.0, 1.0, 1.5]);
        assert!(outside(f64::NAN).is_nan());
    }
}
