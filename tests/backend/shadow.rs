//! Shadows into the host's own maps, and from them.

use crate::host::Pass;
use crate::host_stage::{floats, host_stage, prepare, read};
use crate::things::{dull, frame, front, placed, quad};
use glam::{Mat4, Vec2, Vec3};
use vair::gpu::{HostRendering, Image, TargetFormats, vk};
use vair::math::orthographic;
use vair::render::{CastTarget, DepthOrder, FrameDesc, HostShadowMap, HostShadows, Shadows, Target, View};
use vair::scene::Light;

const SIZE: [u32; 2] = [32, 32];
const MAP: [u32; 2] = [64, 64];

/// A light that shines along -Z, and its eye: a metre before the XY plane, 2 m wide, 2 m deep.
fn light() -> (Light, View) {
    let light = Light { direction_to_light_in_world: Vec3::Z, ..Light::key() };
    (light, View::new(Mat4::from_translation(Vec3::Z).inverse(), orthographic(1.0, 1.0, 0.0, 2.0), MAP))
}

#[test]
fn what_is_drawn_casts_into_the_hosts_map_and_receives_from_it() {
    host_stage(SIZE, Target::hdr(1), |stage| {
        let usage = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT
            | vk::ImageUsageFlags::TRANSFER_SRC
            | vk::ImageUsageFlags::SAMPLED;
        let map = stage.host.engine.target(vk::Format::D32_SFLOAT, MAP, 1, usage).unwrap();
        // A caster of half a metre before a wall; the eye sees both, the caster before the upper right of the wall.
        let caster = quad(Vec2::new(0.25, 0.25), Vec2::new(0.75, 0.75), 0.5);
        let wall = quad(Vec2::splat(-0.9), Vec2::splat(0.9), -0.5);
        let mut scene = placed(vec![(caster, dull()), (wall, dull())]);
        let (light, eye) = light();
        let lights = [light];
        let views = [front(SIZE), eye];
        let cast_into = Some(CastTarget { format: vk::Format::D32_SFLOAT, depth_order: DepthOrder::Reversed });
        let desc = FrameDesc { lights: &lights, cast_into, ..frame(stage.target, &views) };
        let depth_layout = vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
        let read_layout = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
        stage.frame_with(
            &mut scene,
            |frame, scene| prepare(frame, scene, &desc),
            |pass, scene| pass.draw(scene, 0),
            |after, scene| {
                let engine = &after.host.engine;
                engine.barrier(after.commands, &map, vk::ImageLayout::UNDEFINED, depth_layout);
                let pass = Pass {
                    color: None,
                    resolve: None,
                    depth: Some(&map),
                    clear_color: [0.0; 4],
                    clear_depth: Some(0.0),
                };
                engine.begin_rendering(after.commands, &pass);
                let formats = TargetFormats::new([], Some(vk::Format::D32_SFLOAT), 1);
                // SAFETY: inside a pass of these formats.
                let pass = unsafe { HostRendering::begun(after.commands, formats) };
                after.frame.cast_shadows(pass, scene, 1).unwrap_or_else(|error| panic!("{error}"));
                engine.end_rendering(after.commands);
                engine.barrier(after.commands, &map, depth_layout, read_layout);
            },
        );
        let lit = stage.pixels();
        let depths = floats(&read(&stage.gpu(), &map, read_layout));
        let at = |x: usize, y: usize| depths[y * 64 + x];
        // The caster is 0.5 m before the light's eye, the wall 1.5 m; beside both nothing was drawn.
        assert!((at(48, 16) - 0.75).abs() < 1e-6 && (at(16, 48) - 0.25).abs() < 1e-6, "{} {}", at(48, 16), at(16, 48));
        assert_eq!(at(1, 1), 0.0);

        // The map lights the next frame, from a camera that sees the wall beside the caster. Reading has left it as a source.
        let source_layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        stage.host.run(|commands| stage.host.engine.barrier(commands, &map, source_layout, read_layout));
        // SAFETY: image and view are alive, as described, and in that layout.
        let image = unsafe { Image::from_host(&stage.gpu(), &map.described("host's map", read_layout)) };
        let clip_from_world = eye.clip_from_world();
        let maps = [HostShadowMap { light: 0, clip_from_world, origin_px: [0; 2], size_px: MAP[0] }];
        let shifted = View {
            clip_from_view: orthographic(1.0, 1.0, 1.0, 3.0)
                * Mat4::from_cols(
                    glam::Vec4::X,
                    glam::Vec4::Y,
                    // Oblique: what is nearer shows farther to the right.
                    glam::Vec4::new(0.8, 0.0, 1.0, 0.0),
                    glam::Vec4::new(2.0, 0.0, 0.0, 1.0),
                ),
            ..front(SIZE)
        };
        let mut draw = |host_shadows: Option<HostShadows>| {
            let views = [shifted];
            let shadows = Shadows { are_cast: host_shadows.is_some(), ..Shadows::default() };
            let desc = FrameDesc { lights: &lights, host_shadows, shadows, ..frame(Target::hdr(1), &views) };
            stage.draw(&mut scene, &desc)
        };
        let (bare, shadowed) = (draw(None), draw(Some(HostShadows { image: &image, maps: &maps })));
        let darker = bare.iter().zip(&shadowed).filter(|(bare, dark)| dark.x < 0.8 * bare.x).count();
        let brighter = bare.iter().zip(&shadowed).filter(|(bare, dark)| dark.x > bare.x).count();
        // The shadow is half a metre square: 64 pixels, of which the caster hides none or some.
        assert!((20..=70).contains(&darker) && brighter == 0, "{darker} darker, {brighter} brighter");
        assert!(lit.iter().any(|pixel| pixel.w > 0.0));
        drop(image);
        stage.host.engine.destroy_target(&map);
    });
}
