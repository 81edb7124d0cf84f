//! What may go to other threads; the compiler checks it.

use vair::gpu::{FrameToken, Gpu};
use vair::render::{DeviceScene, Frame, Renderer};

fn is_send<T: Send>() {}
fn is_sync<T: Sync>() {}

#[test]
fn everything_moves_between_threads_and_the_device_is_shared() {
    is_send::<Renderer>();
    is_send::<DeviceScene>();
    is_send::<Frame<'static>>();
    is_send::<FrameToken>();
    is_send::<Gpu>();
    is_sync::<Gpu>();
    is_sync::<DeviceScene>();
}
