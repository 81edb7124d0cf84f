//! Property checks of occlusion: a share of the light, all of it where nothing is in the way, and never more for less of the sky.

use super::property_check::{Input, PropertyCheck};
use crate::measure::twin::occlusion;

/// Everything that is promised of it.
pub fn checks() -> Vec<PropertyCheck> {
    let share = |name| Input::between(name, (0.0, 1.0));
    of("of a lobe", vec![share("cosine_to_eye"), share("roughness")], |x, open| occlusion::of_lobe(x[0], x[1], open))
        .into_iter()
        .chain(of("with bounces", vec![share("color")], |x, open| occlusion::bounced(open, x[0])))
        .collect()
}

/// Checks of `share`, of the inputs and the occlusion.
fn of(
    material: &'static str,
    inputs: Vec<Input>,
    share: impl Fn(&[f64], f64) -> f64 + Copy + Send + Sync + 'static,
) -> Vec<PropertyCheck> {
    let count = inputs.len();
    let check = |property, limit, more: &[Input], value| {
        PropertyCheck::ours(material, property, limit, [&inputs, more].concat(), value)
    };
    let open = Input::between("occlusion", (0.0, 1.0));
    let more_open = Input { name: "more_open_by", ..open.clone() };
    vec![
        check(
            "occlusion outside 0 to 1, by",
            0.0,
            std::slice::from_ref(&open),
            Box::new(move |x| {
                let share = share(x, x[count]);
                (-share).max(share - 1.0).max(0.0)
            }),
        ),
        check("open occlusion, short of 1 by", 1e-12, &[], Box::new(move |x| 1.0 - share(x, 1.0))),
        check("closed occlusion", 0.0, &[], Box::new(move |x| share(x, 0.0))),
        check(
            "occlusion that falls as the sky opens, by",
            1e-12,
            &[open, more_open],
            Box::new(move |x| share(x, x[count]) - share(x, x[count] + x[count + 1] * (1.0 - x[count]))),
        ),
    ]
}
