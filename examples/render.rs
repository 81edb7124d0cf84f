//! A scene to a picture: `cargo run --example render [MODEL.glb [PICTURE.png]]`. Without a model, the gallery.

use vair::{Error, FrameOptions, GpuOptions, LoadOptions, Look, Renderer, Scene};

fn main() -> Result<(), Error> {
    let mut arguments = std::env::args().skip(1);
    let mut options = FrameOptions { size: [640, 360], ..FrameOptions::default() };
    let scene = match arguments.next() {
        Some(model) => {
            let mut scene = Scene::load(model, &LoadOptions::default())?;
            scene.apply(&Look::preset("fox", None)?, ".".as_ref(), &LoadOptions::default())?;
            scene
        }
        None => {
            let camera = vair::asset::procedural::GALLERY_CAMERA.to_owned();
            options.camera = vair::scene::CameraChoice::Named(camera);
            Scene::gallery()
        }
    };
    let out = arguments.next().unwrap_or_else(|| "vair.png".to_owned());

    let mut renderer = Renderer::new(&GpuOptions::default())?;
    let (picture, report) = renderer.render_reported(&scene, &options, false)?;
    picture.save(&out)?;
    println!("{out} in {:.1} ms on {}", report.frame_ms, renderer.gpu().info().name);
    Ok(())
}
