//! Images that presets make by formula, so that nothing has to be shipped. All tile, and are the same everywhere.

mod jacquard;
mod leopard;
mod noise;
mod weave;

use crate::asset::Image;
use crate::asset::procedural::strand_image;
use glam::{Vec2, Vec3};

/// An image that is made by formula.
#[derive(Debug, Clone, Copy)]
pub struct Procedural {
    /// What `procedural = ` names.
    pub name: &'static str,
    /// One line.
    pub help: &'static str,
    make: fn() -> Image,
}

/// All of them.
pub const ALL: &[Procedural] = &[
    Procedural { name: "leopard", help: "Data: broken rings of fur, 1 = spot.", make: leopard::leopard },
    Procedural {
        name: "strands",
        help: "Data: 48 x 48 strands that thin from 1 in their middle.",
        make: || strand_image(SIZE, 48, 0.7, 1),
    },
    Procedural { name: "plain_weave", help: "Normals of 24 x 24 threads, over and under.", make: weave::plain_weave },
    Procedural {
        name: "twill",
        help: "Normals of 24 x 24 threads whose floats climb in diagonals.",
        make: weave::twill,
    },
    Procedural { name: "satin_weave", help: "Normals of 25 x 25 threads with long floats.", make: weave::satin_weave },
    Procedural { name: "knit", help: "Normals of 16 x 16 stitches of jersey.", make: weave::knit },
    Procedural { name: "corduroy", help: "Normals of 16 ribs along v.", make: weave::corduroy },
    Procedural {
        name: "weft",
        help: "Data: 1 where the weft of plain_weave lies on top, 0 for the warp.",
        make: weave::weft,
    },
    Procedural { name: "mesh", help: "Data: 24 x 24 thin threads, 1, with holes between them, 0.", make: weave::mesh },
    Procedural { name: "denim", help: "Colour: indigo warp and white weft of twill.", make: weave::denim },
    Procedural {
        name: "jacquard",
        help: "Data: damask, 1 in the figure and 0 in the ground.",
        make: jacquard::jacquard,
    },
    Procedural { name: "brocade", help: "Colour: the figure of jacquard in gold on crimson.", make: jacquard::brocade },
    Procedural {
        name: "brocade_metal",
        help: "Data: roughness (G) and metal (B) of brocade.",
        make: jacquard::brocade_metal,
    },
    Procedural {
        name: "cloth_noise",
        help: "Data: soft unevenness of yarn and dye around 0.5.",
        make: noise::cloth_noise,
    },
    Procedural {
        name: "streaks",
        help: "Data: unevenness drawn out along u, as of slubbed yarn.",
        make: noise::streaks,
    },
];

/// The image of that name; `None` if there is none.
pub fn image(name: &str) -> Option<Image> {
    ALL.iter().find(|known| known.name == name).map(|known| (known.make)())
}

/// Names of all.
pub fn names() -> impl Iterator<Item = &'static str> + Clone {
    ALL.iter().map(|known| known.name)
}

/// Pixels of each side.
const SIZE: u32 = 512;

/// An image of one value in [0, 1] at each point of the unit square.
fn grey(name: &str, value: impl Fn(Vec2) -> f32) -> Image {
    color(name, |point| Vec3::splat(value(point)))
}

/// An image of three values in [0, 1] at each point of the unit square.
fn color(name: &str, value: impl Fn(Vec2) -> Vec3) -> Image {
    let mut rgba = Vec::with_capacity((SIZE * SIZE * 4) as usize);
    for y in 0..SIZE {
        for x in 0..SIZE {
            let stored = value((Vec2::new(x as f32, y as f32) + 0.5) / SIZE as f32).clamp(Vec3::ZERO, Vec3::ONE);
            rgba.extend((stored * 255.0 + 0.5).as_u8vec3().extend(255).to_array());
        }
    }
    Image { name: format!("procedural {name}"), width: SIZE, height: SIZE, rgba }
}

/// Normals of a height, in units of the square's side; OpenGL convention: green points against v.
fn normals(name: &str, height: impl Fn(Vec2) -> f32) -> Image {
    let step = 0.5 / SIZE as f32;
    color(name, |point| {
        let slope = |way: Vec2| (height(point + way * step) - height(point - way * step)) / (2.0 * step);
        let normal = Vec3::new(-slope(Vec2::X), slope(Vec2::Y), 1.0).normalize();
        normal * 0.5 + 0.5
    })
}

/// 0 to 1 across a soft rim of that width; `inside` is the distance into the spot.
fn edge(width: f32, inside: f32) -> f32 {
    let x = (inside / width + 0.5).clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_image_is_made_again_alike_and_is_not_flat() {
        for Procedural { name, .. } in ALL {
            let image = image(name).unwrap();
            assert_eq!(image.rgba.len(), (SIZE * SIZE * 4) as usize, "{name}");
            let spread = |channel: usize| {
                let values = || image.rgba.iter().skip(channel).step_by(4);
                values().max().unwrap() - values().min().unwrap()
            };
            assert!((0..3).map(spread).max().unwrap() > 60, "{name} is flat");
        }
        assert_eq!(image("knit").unwrap().rgba, image("knit").unwrap().rgba);
        assert!(image("nothing").is_none());
    }

    /// A seam would be a step larger than any inside the picture.
    #[test]
    fn every_image_tiles() {
        for Procedural { name, .. } in ALL {
            let image = image(name).unwrap();
            let at = |x: u32, y: u32| i32::from(image.rgba[((y % SIZE * SIZE + x % SIZE) * 4) as usize]);
            let (mut seam, mut within) = (0, 0);
            for i in 0..SIZE {
                seam = seam.max((at(SIZE - 1, i) - at(0, i)).abs()).max((at(i, SIZE - 1) - at(i, 0)).abs());
                for j in 0..SIZE - 1 {
                    within = within.max((at(j, i) - at(j + 1, i)).abs()).max((at(i, j) - at(i, j + 1)).abs());
                }
            }
            assert!(seam <= within, "{name}: largest step over the seam {seam}, elsewhere {within}");
        }
    }

    #[test]
    fn normals_point_out_of_the_cloth() {
        for name in ["plain_weave", "twill", "satin_weave", "knit", "corduroy"] {
            let image = image(name).unwrap();
            let mean = image.rgba.chunks(4).fold([0.0f64; 3], |sum, texel| {
                [0, 1, 2].map(|channel| sum[channel] + f64::from(texel[channel]) / 255.0 / f64::from(SIZE * SIZE))
            });
            assert!((mean[0] - 0.5).abs() < 0.02 && (mean[1] - 0.5).abs() < 0.02 && mean[2] > 0.75, "{name}: {mean:?}");
        }
    }
}
