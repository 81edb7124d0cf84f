//! What a frame used comes back when the host says that it has passed, and not before.

use crate::host_stage::{HostStage, host_stage, prepare};
use crate::things::{SKINNED, frame, front, furred, plain_target};
use vair::gpu::{FrameToken, GpuError, HostCommands};
use vair::render::{DeviceScene, MAX_FRAMES_IN_FLIGHT, RenderError};

const SIZE: [u32; 2] = [32, 32];

/// A frame without draws, which the device is done with and nobody has said so.
fn unsaid(stage: &mut HostStage, scene: Option<&mut DeviceScene>) -> Result<FrameToken, RenderError> {
    let HostStage { renderer, host, target, .. } = stage;
    let mut token = None;
    host.run(|commands| {
        // SAFETY: the command buffer is recording, outside of a pass, and submitted once right after.
        let frame = renderer.frame(unsafe { HostCommands::recording(commands) });
        token = Some(frame.and_then(|mut frame| {
            if let Some(scene) = scene {
                let views = [front(SIZE)];
                prepare(&mut frame, scene, &crate::things::frame(*target, &views));
            }
            frame.finish()
        }));
    });
    token.unwrap()
}

#[test]
fn memory_of_a_scene_comes_back_with_the_last_frame_that_used_it() {
    host_stage(SIZE, plain_target(), |stage| {
        let gpu = stage.gpu();
        let mut scene = furred();
        scene.add(&SKINNED).unwrap();
        let token = unsaid(stage, Some(&mut scene)).unwrap();
        let owns = |name: &str| gpu.memory().by_owner.iter().any(|(owner, _)| owner == name);
        assert!(owns("moved stream"));
        drop(scene);
        assert!(owns("moved stream"), "kept until the host says so");
        assert_eq!(gpu.host_frames_in_flight(), 1);
        // SAFETY: the host has waited.
        unsafe { gpu.frame_passed(token) }.unwrap();
        assert!(!owns("moved stream"), "{:?}", gpu.memory().by_owner);
        assert_eq!(gpu.host_frames_in_flight(), 0);
    });
}

#[test]
fn frames_pass_with_the_hosts_timeline() {
    host_stage(SIZE, plain_target(), |stage| {
        let gpu = stage.gpu();
        for value in [1, 2, 3] {
            let token = unsaid(stage, None).unwrap();
            gpu.frame_on_timeline(token, value).unwrap();
        }
        // SAFETY: the host has waited for all of them.
        unsafe { gpu.timeline_passed(2) };
        assert_eq!(gpu.host_frames_in_flight(), 1);
        // SAFETY: as above.
        unsafe { gpu.timeline_passed(3) };
        assert_eq!(gpu.host_frames_in_flight(), 0);
    });
}

#[test]
fn a_token_of_another_device_is_refused() {
    host_stage(SIZE, plain_target(), |stage| {
        host_stage(SIZE, plain_target(), |other| {
            let token = unsaid(other, None).unwrap();
            // SAFETY: the host has waited.
            let refused = unsafe { stage.gpu().frame_passed(token) };
            assert!(matches!(refused, Err(GpuError::Range { .. })), "{refused:?}");
            let refused = stage.gpu().frame_on_timeline(unsaid(other, None).unwrap(), 1);
            assert!(matches!(refused, Err(GpuError::Range { .. })), "{refused:?}");
        });
    });
}

#[test]
fn tokens_that_never_come_back_end_at_the_limit() {
    host_stage(SIZE, plain_target(), |stage| {
        let tokens: Vec<FrameToken> = (0..MAX_FRAMES_IN_FLIGHT).map(|_| unsaid(stage, None).unwrap()).collect();
        let error = unsaid(stage, None).unwrap_err().to_string();
        assert!(error.contains("frames in flight") && error.contains("frame_passed"), "{error}");
        let gpu = stage.gpu();
        for token in tokens {
            // SAFETY: the host has waited.
            unsafe { gpu.frame_passed(token) }.unwrap();
        }
        let mut scene = furred();
        let views = [front(SIZE)];
        stage.frame(&mut scene, |record, scene| prepare(record, scene, &frame(plain_target(), &views)), |_, _| {});
    });
}
