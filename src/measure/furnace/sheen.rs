//! Property checks of the lobes of fuzz, each white and alone.

use super::ALBEDO_LIMIT;
use super::property_check::{Input, PropertyCheck};
use super::quadrature::{direction, over_cosines_finely, over_hemisphere};
use crate::material::{Cotton, Sheen, SheenModel, SheenTable};
use crate::measure::twin::sheen::{self, Lobe};
use glam::DVec3;
use std::sync::LazyLock;

pub(super) static TABLE: LazyLock<SheenTable> = LazyLock::new(SheenTable::shipped);

/// What linear interpolation between the table's nodes errs by, 0.012, and the factor of 1.017 that keeps it from ever
/// saying too little (tools/fit_sheen.rs). The transformed cosine integrates to what the table says and has no part in it.
pub(super) const TABLE_ERROR: f64 = 0.03;

/// The models that a material may choose.
const MODELS: [SheenModel; 3] = [SheenModel::Ltc, SheenModel::Charlie, SheenModel::Inverted];

/// Which model: 0 ltc, 1 charlie, 2 inverted.
pub(super) fn model_input() -> Input {
    Input { corners: vec![0.0, 1.0, 2.0], ..Input::between("sheen", (0.0, 2.999)) }
}

/// The lobe of a [`model_input`].
pub(super) fn lobe(model: f64, roughness: f64) -> Lobe<'static> {
    Lobe { table: &TABLE, sheet: MODELS[model as usize].sheet(), roughness }
}

fn roughness_input() -> Input {
    Input::of::<Cotton>("sheen_roughness")
}

/// Share of white light that the lobe sends to an eye at the cosine `mu`, by quadrature.
fn albedo(lobe: &Lobe<'_>, mu: f64) -> f64 {
    let v = direction(mu, 0.0);
    over_hemisphere(|l| lobe.times_cosine(v, l))
}

/// Everything that is checked of the lobes.
pub fn checks() -> Vec<PropertyCheck> {
    let check = |property, limit, inputs, value| PropertyCheck {
        material: "sheen",
        property,
        classic: false,
        limit,
        inputs,
        value,
    };
    let seen = || vec![model_input(), roughness_input(), Input::cosine("cosine_to_eye")];
    let both = || [seen(), vec![Input::cosine("cosine_to_light"), Input::turn("eye_to_light_deg")]].concat();
    let swapped = |x: &[f64]| {
        let (v, l) = (direction(x[2], 0.0), direction(x[3], x[4].to_radians()));
        let one = |v: DVec3, l: DVec3| lobe(x[0], x[1]).times_cosine(v, l) / l.z;
        (one(v, l), one(l, v))
    };
    let of_normals = |sheet, ndf: fn(DVec3, f64) -> f64| -> super::Measure {
        Box::new(move |x| {
            let alpha = sheen::alpha_of_roughness(sheet, x[0]);
            (over_cosines_finely(|mu| ndf(direction(mu, 0.0), alpha) * mu) - 1.0).abs()
        })
    };
    vec![
        check(
            "integral of Charlie's normals, off 1 by",
            Some(1e-4),
            vec![roughness_input()],
            of_normals(Sheen::Charlie, sheen::charlie_ndf),
        ),
        check(
            "integral of inverted normals, off 1 by",
            Some(1e-5),
            vec![roughness_input()],
            of_normals(Sheen::Inverted, sheen::inverted_ndf),
        ),
        check("directional albedo", Some(ALBEDO_LIMIT), seen(), Box::new(|x| albedo(&lobe(x[0], x[1]), x[2]))),
        check(
            "albedo, off its table by",
            Some(TABLE_ERROR),
            seen(),
            Box::new(|x| {
                let lobe = lobe(x[0], x[1]);
                (albedo(&lobe, x[2]) - lobe.entry(x[2]).albedo).abs()
            }),
        ),
        check(
            "Charlie and inverted, off reciprocal by",
            Some(1e-6),
            both(),
            Box::new(move |x| {
                let (there, back) = swapped(&[x[0].max(1.0), x[1], x[2], x[3], x[4]]);
                (there - back).abs() / there.max(back).max(f64::MIN_POSITIVE)
            }),
        ),
        // The transformed cosine follows the view only: this is how far from reciprocal it is, by design.
        check(
            "ltc over itself swapped",
            None,
            both(),
            Box::new(move |x| {
                let (there, back) = swapped(&[0.0, x[1], x[2], x[3], x[4]]);
                if there == back { 1.0 } else { there / back.max(1e-6) }
            }),
        ),
    ]
}
