//! Light from all around a scene.

use crate::image::{VairHostImage, borrow};
use crate::pointer::{exclusive, slice, text};
use crate::renderer::VairRenderer;
use crate::result::{Failure, VairResult, border};
use crate::scene::VairScene;
use glam::Vec3;
use std::ffi::c_char;
use std::path::Path;
use std::sync::Arc;
use vair::LoadOptions;
use vair::asset::Environment;
use vair::render::{EnvironmentQuality, HostEnvironment, SH_COEFFICIENTS};
use vair::scene::EnvironmentLight;

/// The same linear RGB radiance from everywhere: three numbers, 0 or more.
///
/// # Safety
/// `scene` is valid or NULL; `radiance` has three numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_set_environment_constant(
    scene: *mut VairScene,
    radiance: *const f32,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        // SAFETY: three numbers of the caller's or NULL.
        let radiance = Vec3::from_slice(unsafe { slice(radiance, 3, "radiance") }?);
        if !(radiance.is_finite() && radiance.min_element() >= 0.0) {
            return Err(Failure::argument(format!("radiance is {radiance}; give finite numbers, 0 or more")));
        }
        scene.set_environment(EnvironmentLight::constant(radiance))
    })
}

/// The embedded studio, which lights a scene that was told nothing else. It turns by `rotation_deg` around +Y, counter-clockwise
/// seen from above; `strength` is a factor on its radiance.
///
/// # Safety
/// `scene` is valid or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_set_environment_studio(
    scene: *mut VairScene,
    rotation_deg: f32,
    strength: f32,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        scene.set_environment(EnvironmentLight { rotation_deg, strength, ..EnvironmentLight::studio() })
    })
}

/// An equirectangular picture of linear radiance, Radiance (.hdr) or OpenEXR (.exr). The first frame with it prepares its
/// maps, which takes seconds where no cache has them.
///
/// # Safety
/// `scene` is valid or NULL; `path` is text or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_set_environment_file(
    scene: *mut VairScene,
    path: *const c_char,
    rotation_deg: f32,
    strength: f32,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        // SAFETY: text of the caller's or NULL.
        let path = unsafe { text(path, "path") }?;
        let (map, _) = Environment::load(Path::new(path), &LoadOptions::default())?;
        scene.set_environment(EnvironmentLight { map: Arc::new(map), rotation_deg, strength })
    })
}

/// The host's own prefiltered environment. `cube` holds radiance over `scale` (three numbers): level l of `last` is spread by a
/// GGX lobe that is seen from the front, of perceptual roughness l / last. `harmonics` are 27 numbers: linear RGB radiance in
/// the nine real spherical harmonics up to l = 2, coefficient l * l + l + m, z the polar axis.
///
/// # Safety
/// The handles are valid or NULL; `cube` is as for vair_image_new_on_host(); `scale` has 3 numbers, `harmonics` 27.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_scene_set_host_environment(
    scene: *mut VairScene,
    renderer: *mut VairRenderer,
    cube: *const VairHostImage,
    scale: *const f32,
    harmonics: *const f32,
    rotation_deg: f32,
    strength: f32,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        // SAFETY: the caller's handle or NULL.
        let gpu = &unsafe { exclusive(renderer, "renderer") }?.0.gpu;
        // SAFETY: three numbers of the caller's or NULL.
        let scale = Vec3::from_slice(unsafe { slice(scale, 3, "scale") }?);
        // SAFETY: as many numbers of the caller's, or NULL.
        let numbers = unsafe { slice(harmonics, 3 * SH_COEFFICIENTS, "harmonics") }?;
        if !(scale.is_finite() && numbers.iter().all(|number| number.is_finite())) {
            return Err(Failure::argument("scale and harmonics must be finite"));
        }
        let mut harmonics = [Vec3::ZERO; SH_COEFFICIENTS];
        for (coefficient, numbers) in harmonics.iter_mut().zip(numbers.chunks_exact(3)) {
            *coefficient = Vec3::from_slice(numbers);
        }
        // SAFETY: by this function's contract.
        let map = unsafe { borrow(gpu, cube, "cube") }?;
        let environment = HostEnvironment { map, scale, harmonics };
        Ok(scene.device_scene.set_host_environment(gpu, environment, rotation_deg, strength)?)
    })
}

impl VairScene {
    fn set_environment(&mut self, environment: EnvironmentLight) -> Result<(), Failure> {
        Ok(self.device_scene.set_environment(environment, EnvironmentQuality::default())?)
    }
}
