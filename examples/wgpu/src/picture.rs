//! What the engine shows, and whether it is what it should be.

use crate::engine::BACKGROUND;
use crate::fur::FUR_LENGTH_M;
use crate::{BALL_BEFORE, BALL_BEHIND, BALL_RADIUS_M, Problem};
use glam::{Vec2, Vec3};
use vair::render::View;

pub struct Picture {
    /// RGBA of 8 bits, sRGB, rows from the top.
    pub rgba: Vec<u8>,
    /// 0 near, 1 far.
    pub depth: Vec<f32>,
    pub size: [u32; 2],
    pub view: View,
}

/// What can be seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Seen {
    Background,
    Box,
    Fur,
}

impl Picture {
    /// Each of these places shows what stands nearest there.
    pub fn check(&self) -> Result<(), Problem> {
        let on_box = Vec3::new(0.05, 0.0, 0.12);
        let before_box = BALL_BEFORE + Vec3::new(0.04, 0.02, 0.08);
        let beside_box = BALL_BEHIND + Vec3::new(0.04, 0.02, 0.08);
        let checks = [
            ("the box", on_box, Seen::Box),
            ("the ball before the box", before_box, Seen::Fur),
            ("its strands, outside its skin", BALL_BEFORE - Vec3::X * (BALL_RADIUS_M + 0.008), Seen::Fur),
            ("the ball behind the box, beside it", beside_box, Seen::Fur),
            ("the same, where the box hides it", BALL_BEHIND + Vec3::new(-0.07, -0.03, 0.05), Seen::Box),
            ("nothing", Vec3::new(-0.4, 0.2, 0.0), Seen::Background),
        ];
        for (name, place, expected) in checks {
            let (pixel, _) = self.project(place);
            let seen = self.seen(pixel);
            if seen != expected {
                let color = self.color(pixel);
                return Err(format!("{name}, at pixel {pixel:?}: {seen:?} of {color}, not {expected:?}").into());
            }
        }
        // The depth that fur leaves is its own, at most its length nearer than the skin: what the engine draws next is
        // hidden by strands.
        for (name, place) in [("before", before_box), ("beside", beside_box)] {
            let (pixel, skin) = self.project(place);
            let (_, tips) = self.project(place + self.towards_camera(place) * 2.0 * FUR_LENGTH_M);
            let depth = self.depth_at(pixel);
            if !(tips..=skin).contains(&depth) {
                return Err(format!("the ball {name} the box left depth {depth}, not {tips} to {skin}").into());
            }
        }
        Ok(())
    }

    fn towards_camera(&self, place_in_world: Vec3) -> Vec3 {
        let camera = self.view.view_from_world.inverse().transform_point3(Vec3::ZERO);
        (camera - place_in_world).normalize()
    }

    fn project(&self, place_in_world: Vec3) -> ([u32; 2], f32) {
        let clip = self.view.clip_from_view * self.view.view_from_world * place_in_world.extend(1.0);
        let ndc = clip.truncate() / clip.w;
        let [width, height] = self.size.map(|side| side as f32);
        let pixel = Vec2::new((0.5 + 0.5 * ndc.x) * width, (0.5 - 0.5 * ndc.y) * height);
        ([pixel.x as u32, pixel.y as u32], ndc.z)
    }

    /// Mean of 5 by 5 pixels: one may lie between two strands.
    fn color(&self, [x, y]: [u32; 2]) -> Vec3 {
        let pixels = (0..25).map(|index| self.index([x + index % 5 - 2, y + index / 5 - 2]) * 4);
        pixels.map(|at| Vec3::from([0, 1, 2].map(|channel| f32::from(self.rgba[at + channel])))).sum::<Vec3>() / 25.0
    }

    fn seen(&self, pixel: [u32; 2]) -> Seen {
        let color = self.color(pixel);
        if (color - background()).abs().max_element() <= 1.0 {
            Seen::Background
        } else if color.z > 1.5 * color.x {
            Seen::Box
        } else {
            Seen::Fur
        }
    }

    fn depth_at(&self, pixel: [u32; 2]) -> f32 {
        self.depth[self.index(pixel)]
    }

    fn index(&self, [x, y]: [u32; 2]) -> usize {
        (y * self.size[0] + x) as usize
    }
}

/// The background as it is shown: tone-mapped, sRGB-encoded (IEC 61966-2-1), 0 to 255.
fn background() -> Vec3 {
    let encode = |radiance: f64| {
        let linear = radiance / (1.0 + radiance);
        255.0 * (1.055 * linear.powf(1.0 / 2.4) - 0.055) as f32
    };
    Vec3::from(BACKGROUND.map(encode))
}
