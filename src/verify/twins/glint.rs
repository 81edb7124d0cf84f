//! Judges `glint.glsl`.

use super::super::domain::{ALMOST_ONE, ALPHA, Domain, UNIT};
use super::super::twin::{Given, Limit, Rule, Twin};
use super::ULP;
use crate::material::Flakes;
use crate::material::reference::glint::{self, Disc, Footprint, Tiles};
use glam::{DMat2, DVec2, DVec3, IVec2};

/// A place or tile next to another one.
const NEAR: Domain = Domain::Choice(&[0, 1, u32::MAX]);
const FINENESS: Domain = Domain::Choice(&[2, 3, 5, 8]);
const LEVEL: Domain = Domain::Choice(&[0, 1, 2, 9]);
const CHART: Domain = Domain::Choice(&[0, 1, 2]);
/// Component of a vector, in rhombi.
const VECTOR: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1e-40, 0.4]);
const RADIUS: Domain = Domain::Uniform(0.0, 0.498, &[0.0, 0.433, 0.498]);
/// As a pixel sees it.
const WIDE_LOBE: Domain = Domain::Log(0.25, 10.0, &[0.25, 0.5, 10.0]);
const LOBE: Domain = Domain::Uniform(0.25, 0.5, &[0.25, 0.5]);
/// In the square of normals.
const SQUARE: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1e-7, 1.0]);
const SPREAD: Domain = Domain::Log(1e-8, 10.0, &[0.0, 1e-4, 10.0]);
const SHARE: Domain = Domain::Uniform(0.0, 0.5, &[0.0, 0.5]);

// In the order of the shader's structs.
const FLAKES: [Domain; 5] = [RADIUS, UNIT, LOBE, UNIT, Domain::Choice(&[2, 3])];
const FOOTPRINT: [Domain; 9] = [
    NEAR,
    Domain::Uniform(0.0, ALMOST_ONE, &[0.0, 0.5, ALMOST_ONE]),
    VECTOR,
    VECTOR,
    Domain::Uniform(0.0, 0.4, &[0.0, 0.2]),
    Domain::Log(1.0, 5e3, &[1.0, 5e3]),
    Domain::Log(0.05, 100.0, &[0.05, 1.0]),
    Domain::Uniform(0.0, 4.0, &[0.0, 4.0]),
    Domain::Uniform(0.0, 1.0, &[0.0, 0.2, 0.3, 0.45]),
];
const TINTED: Domain = Domain::Uniform(0.0, 4.0, &[0.0, 1.0]);
const DISC: [Domain; 2] = [TINTED, SQUARE];
const TILES: [Domain; 7] =
    [NEAR, CHART, Domain::Choice(&[0, 1]), Domain::Bits, Domain::Bits, Domain::Bits, Domain::Bits];

/// The domains of several arguments, one after the other.
const fn join<const N: usize>(lists: &[&[Domain]]) -> [Domain; N] {
    let mut all = [UNIT; N];
    let (mut list, mut count) = (0, 0);
    while list < lists.len() {
        let mut at = 0;
        while at < lists[list].len() {
            all[count] = lists[list][at];
            (at, count) = (at + 1, count + 1);
        }
        list += 1;
    }
    assert!(count == N, "one domain a member");
    all
}

fn flakes(given: &mut Given<'_>) -> Flakes {
    let [radius, jitter, lobe, variation] = [(); 4].map(|()| given.number() as f32);
    // Where flakes are and how they lean is no part of the shader's struct.
    Flakes { radius, jitter, lobe, variation, fineness: given.uint(), cells_per_metre: 1.0, alpha: 1.0 }
}

fn ivec2(given: &mut Given<'_>) -> IVec2 {
    IVec2::new(given.int(), given.int())
}

fn uvec2(given: &mut Given<'_>) -> [u32; 2] {
    [given.uint(), given.uint()]
}

fn footprint(given: &mut Given<'_>) -> Footprint {
    Footprint {
        cell: ivec2(given),
        within: given.vec2(),
        pixel: DMat2::from_cols(given.vec2(), given.vec2()),
        disc: given.number(),
        sharpness: given.number(),
        inverse_squared: given.number(),
        reach: given.number(),
        blur: given.number(),
    }
}

fn tiles(given: &mut Given<'_>) -> Tiles {
    Tiles {
        first: ivec2(given),
        stream: given.uint(),
        level: given.uint(),
        seeds: [uvec2(given), uvec2(given), uvec2(given), uvec2(given)],
    }
}

fn disc(given: &mut Given<'_>) -> Disc {
    Disc { tinted: given.vec3(), weight: given.number(), square: given.vec2() }
}

fn discs(given: &mut Given<'_>) -> [Disc; 4] {
    [disc(given), disc(given), disc(given), disc(given)]
}

fn disc_words(disc: &Disc) -> Vec<f64> {
    [words3(disc.tinted), vec![disc.weight], words2(disc.square)].concat()
}

fn words2(vector: DVec2) -> Vec<f64> {
    vector.to_array().to_vec()
}

fn words3(vector: DVec3) -> Vec<f64> {
    vector.to_array().to_vec()
}

fn tinted((tint, weight): (DVec3, f64)) -> Vec<f64> {
    (tint * weight).extend(weight).to_array().to_vec()
}

/// A kernel falls from its peak to nothing over a part of a rhombus in proportion to its sharpness: rounding of offsets, and
/// of the distance made of them, counts by that.
const KERNEL: Rule = Rule::Conditioned(4);

pub(super) const TWINS: &[Twin] = &[
    // Small chances keep every digit; what a naive formula loses is all of them.
    Twin::new(
        "glint_chance",
        &[
            Domain::Log(1e-12, 1.0, &[0.0, 1e-30, 1e-8, 0.499_999_97, 0.5, ALMOST_ONE, 1.0]),
            Domain::Log(1.0, 1e7, &[0.0, 0.5, 1.0, 1e3, 1e7]),
        ],
        |given| {
            let (p, n) = (given.number(), given.number());
            vec![glint::chance(p, n)]
        },
    )
    .limit(1e-5, 0.0),
    Twin::new("glint_square", &[Domain::Hemisphere, ALPHA], |given| {
        let (normal, alpha) = (given.vec3(), given.number());
        words2(glint::square(normal, alpha))
    }),
    Twin {
        limit: Limit::EXACT,
        ..Twin::new("glint_shuffle", &[Domain::Bits, FINENESS, Domain::Bits], |given| {
            vec![f64::from(glint::shuffle(given.uint(), given.uint(), given.uint()))]
        })
    },
    Twin {
        limit: Limit::EXACT,
        ..Twin::new("glint_unshuffle", &[Domain::Bits, FINENESS, Domain::Bits], |given| {
            vec![f64::from(glint::unshuffle(given.uint(), given.uint(), given.uint()))]
        })
    },
    Twin {
        limit: Limit::EXACT,
        ..Twin::new("glint_chart", &[Domain::Direction], |given| vec![f64::from(glint::chart(given.vec3()))])
    },
    Twin {
        limit: Limit::EXACT,
        ..Twin::new("glint_in_chart", &[VECTOR, CHART], |given| {
            let (vector, chart) = (given.vec3(), given.uint());
            words2(glint::in_chart(vector, chart))
        })
    },
    Twin::new("glint_length_squared", &[VECTOR], |given| vec![(glint::edges() * given.vec2()).length_squared()]),
    Twin::new("glint_cross", &[VECTOR, VECTOR], |given| vec![given.vec2().perp_dot(given.vec2())]),
    Twin::new(
        "glint_footprint",
        &join::<8>(&[
            &FLAKES,
            &[
                Domain::Uniform(-8.0, 8.0, &[-8.0, 0.0, 1e-40, 8.0]),
                Domain::Uniform(-2.0, 2.0, &[-1e30, 0.0, 1e-40, 2.0]),
                Domain::Uniform(-2.0, 2.0, &[0.0, 1e-3, 1e30]),
            ],
        ]),
        |given| {
            let flakes = flakes(given);
            let f = Footprint::new(&flakes, given.vec2(), given.vec2(), given.vec2());
            let (cell, within, across, down) = (f.cell.as_dvec2(), f.within, f.pixel.x_axis, f.pixel.y_axis);
            let mut words = [cell, within, across, down].map(words2).concat();
            words.extend([f.disc, f.sharpness, f.inverse_squared, f.reach, f.blur]);
            words
        },
    )
    .allowance(|given| {
        let flakes = flakes(given);
        let f = Footprint::new(&flakes, given.vec2(), given.vec2(), given.vec2());
        // Where a grazing view stretches the pixel to nearly a line, its area is the difference of two products, each of
        // six roundings; the kernel's is at least that.
        let (x, y) = (f.pixel.x_axis, f.pixel.y_axis);
        let rounding = 6.0 * ULP * ((x.x * y.y).abs() + (x.y * y.x).abs());
        let mut allowed = vec![0.0; 13];
        allowed[10] = 2.0 * rounding * f.inverse_squared.powf(1.5);
        allowed
    })
    .rule(Rule::Stepped(4)),
    Twin::new(
        "glint_flake",
        &join::<17>(&[&FLAKES, &FOOTPRINT, &[NEAR, Domain::Choice(&[0, 1, 2]), Domain::Bits]]),
        |given| {
            let (flakes, footprint) = (flakes(given), footprint(given));
            let (place, level, stream) = (ivec2(given), given.uint(), given.uint());
            tinted(glint::flake(&flakes, &footprint, place, level, stream))
        },
    )
    .rule(KERNEL),
    // At a step the next level takes over with the share that it had, so that sums over levels know no step. The
    // logarithm is rounded at 2^-20, which is 2^-20 ln 2 / 2^-24 = 11 units of the reach; three more for log2 itself.
    Twin::new("glint_levels", &[Domain::Log(1e-3, 1e6, &[0.0, 1.0, 2.0, 128.0, 1e6, 1e12]), FINENESS], |given| {
        let (reach, fineness) = (given.number(), given.uint());
        let (first, near, far) = glint::levels(reach, fineness);
        vec![f64::from(first), near, far]
    })
    .used(|words| {
        if let [first, near, far] = *words {
            words.copy_from_slice(&[near + far, near * first + far * (first + 1.0), near * near + far * far]);
        }
    })
    .rule(Rule::Conditioned(14)),
    Twin {
        limit: Limit::EXACT,
        ..Twin::new("glint_seed", &[Domain::Bits, Domain::Choice(&[0, 1, 16, 41])], |given| {
            let (tile, stream) = (ivec2(given), given.uint());
            glint::seed(tile, stream).map(f64::from).to_vec()
        })
    },
    Twin {
        limit: Limit::EXACT,
        ..Twin::new(
            "glint_tiles",
            &join::<12>(&[
                &[Domain::Choice(&[0, 1, 7, u32::MAX, 100_000_000, 0xfa0a_1f00])],
                FOOTPRINT.split_at(1).1,
                &[FINENESS, LEVEL, CHART],
            ]),
            |given| {
                let footprint = footprint(given);
                let t = Tiles::new(footprint.cell, given.uint(), given.uint(), given.uint());
                let mut words = words2(t.first.as_dvec2());
                words.extend([t.stream, t.level].map(f64::from));
                words.extend(t.seeds.concat().into_iter().map(f64::from));
                words
            },
        )
    },
    Twin::new(
        "glint_tile",
        &join::<20>(&[&FLAKES, &FOOTPRINT, &[NEAR, Domain::Choice(&[0, 1]), CHART, Domain::Bits, SQUARE, LOBE]]),
        |given| {
            let (flakes, footprint) = (flakes(given), footprint(given));
            let (at, streams, seed) = (ivec2(given), (given.uint(), given.uint()), uvec2(given));
            words3(glint::tile(&flakes, &footprint, at, streams, seed, given.vec2(), given.number()))
        },
    )
    .rule(KERNEL),
    Twin::new("glint_level", &join::<23>(&[&FLAKES, &FOOTPRINT, &TILES, &[SQUARE, LOBE]]), |given| {
        let (flakes, footprint, tiles) = (flakes(given), footprint(given), tiles(given));
        words3(glint::level(&flakes, &footprint, &tiles, given.vec2(), given.number()))
    })
    .rule(KERNEL),
    Twin::new("glint_mean_tint", &FLAKES, |given| vec![glint::mean_tint(&flakes(given))]),
    Twin::new("glint_lobe", &join::<6>(&[&FLAKES, &[SPREAD]]), |given| {
        vec![glint::lobe(&flakes(given), given.number())]
    }),
    // Log2 is off by 2^-21 between 1/2 and 2, and the lobe that just fits is where it steps.
    Twin::new("glint_fineness", &join::<6>(&[&FLAKES, &[WIDE_LOBE]]), |given| {
        vec![f64::from(glint::fineness(&flakes(given), given.number()))]
    })
    .limit(0.0, 0.0)
    .rule(Rule::Stepped(8)),
    // A normal on the rim of the square may lie on the opposite one just as well.
    Twin::new("glint_disc", &join::<16>(&[&FLAKES, &FOOTPRINT, &[NEAR, CHART]]), |given| {
        let (flakes, footprint) = (flakes(given), footprint(given));
        let place = ivec2(given);
        disc_words(&glint::disc(&flakes, &footprint, place, given.uint()))
    })
    .rule(KERNEL),
    Twin::new("glint_discs", &join::<15>(&[&FLAKES, &FOOTPRINT, &[CHART]]), |given| {
        let (flakes, footprint) = (flakes(given), footprint(given));
        let discs = glint::discs(&flakes, &footprint, given.uint());
        let mut words = discs.iter().map(disc_words).collect::<Vec<_>>().concat();
        words.push(glint::apart(&footprint));
        words
    })
    .rule(KERNEL),
    Twin::new("glint_cover", &join::<14>(&[&FLAKES, &DISC, &DISC, &DISC, &DISC, &[UNIT]]), |given| {
        let (flakes, discs) = (flakes(given), discs(given));
        let (tinted, share) = glint::cover(&flakes, &discs, given.number());
        tinted.extend(share).to_array().to_vec()
    }),
    Twin::new("glint_disc_flash", &join::<9>(&[&FLAKES, &DISC, &[SQUARE, WIDE_LOBE]]), |given| {
        let (flakes, disc) = (flakes(given), disc(given));
        words3(glint::disc_flash(&flakes, &disc, given.vec2(), given.number()))
    })
    .rule(KERNEL),
    Twin::new(
        "glint_discs_flash",
        &join::<16>(&[&FLAKES, &DISC, &DISC, &DISC, &DISC, &[UNIT, SQUARE, WIDE_LOBE]]),
        |given| {
            let (flakes, discs) = (flakes(given), discs(given));
            let _apart = given.number();
            words3(glint::discs_flash(&flakes, &discs, given.vec2(), given.number()))
        },
    )
    .rule(KERNEL),
    Twin::new(
        "glint_tiles_flash",
        &join::<33>(&[&FLAKES, &FOOTPRINT, &[NEAR, SHARE, SHARE], &TILES, &TILES, &[SQUARE, WIDE_LOBE]]),
        |given| {
            let (flakes, footprint) = (flakes(given), footprint(given));
            let (_, near, far) = (given.uint(), given.number(), given.number());
            let levels = [(near, tiles(given)), (far, tiles(given))];
            words3(glint::tiles_flash(&flakes, &footprint, &levels, given.vec2(), given.number()))
        },
    )
    .rule(KERNEL),
    Twin::new(
        "glint_smooth_times_cosine",
        &[UNIT, Domain::Uniform(1.0, 3.3, &[1.0, 3.3]), ALPHA, Domain::Hemisphere, Domain::Hemisphere],
        |given| {
            let (color, compensation, alpha) = (given.vec3(), given.vec3(), given.number());
            words3(glint::smooth_times_cosine(color, compensation, alpha, given.vec3(), given.vec3()))
        },
    ),
];
