//! A change uploads what changed.

use crate::host_stage::{HostStage, host_stage, prepare};
use crate::things::{dull, frame, front, placed, plain_target, preset};
use vair::asset::procedural;
use vair::material::Value;
use vair::render::DeviceScene;

const SIZE: [u32; 2] = [32, 32];

fn uploaded_bytes(stage: &mut HostStage, scene: &mut DeviceScene) -> u64 {
    let gpu = stage.gpu();
    let before = gpu.calls();
    let views = [front(SIZE)];
    stage.frame(
        scene,
        |record, scene| prepare(record, scene, &frame(plain_target(), &views)),
        |pass, scene| pass.draw(scene, 0),
    );
    gpu.calls().since(&before).uploaded_bytes
}

#[test]
fn a_slider_uploads_its_one_block() {
    host_stage(SIZE, plain_target(), |stage| {
        let ball = || procedural::sphere(0.3, 8);
        let mut scene = placed(vec![(ball(), dull()), (ball(), preset("fox")), (ball(), preset("denim"))]);
        uploaded_bytes(stage, &mut scene);
        let still = uploaded_bytes(stage, &mut scene);
        assert_eq!(uploaded_bytes(stage, &mut scene), still);
        let mut slide = |material, key: &str, value| {
            scene.set_parameter(material, key, &Value::Number(value)).unwrap_or_else(|error| panic!("{error}"));
            uploaded_bytes(stage, &mut scene) - still
        };
        let block = slide(0, "roughness", 0.25);
        // The block of a surface: its numbers, whatever is 16 bytes and more.
        assert!((16..=1024).contains(&block), "{block} bytes");
        assert_eq!(slide(0, "roughness", 0.5), block);
        // Its skin has a block of its own, the strands' is written each frame.
        assert_eq!(slide(1, "length", 0.02), 0);
        assert_eq!(slide(1, "thickness", 0.5), 0);
    });
}
