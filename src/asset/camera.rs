//! Cameras.

use super::context::Context;
use super::document::Document;
use super::{AssetError, Camera, Projection};
use ::gltf::json::{self, camera::Type};
use std::f32::consts::PI;

/// All cameras.
///
/// # Errors
/// Numbers that make no projection.
pub(super) fn read(context: &Context, document: &Document) -> Result<Vec<Camera>, AssetError> {
    let camera = |(i, json): (usize, &json::Camera)| {
        let place = format!("cameras[{i}].type");
        let kind = document.code(&place, &json.type_);
        let kind = kind.map_err(|name| context.error(&place, format_args!("`{name}` does not exist")))?;
        let name = if kind == Type::Perspective { "perspective" } else { "orthographic" };
        let field = format!("cameras[{i}].{name}");
        let require = |good: bool, problem: &str| if good { Ok(()) } else { Err(context.error(&field, problem)) };
        let projection = match (kind, &json.perspective, &json.orthographic) {
            (Type::Perspective, Some(p), _) => {
                context.finite(&field, &[p.yfov, p.znear, p.zfar.unwrap_or(1.0), p.aspect_ratio.unwrap_or(1.0)])?;
                require(p.yfov > 0.0 && p.yfov < PI, "yfov must lie between 0 and pi")?;
                require(p.znear > 0.0, "znear must be > 0")?;
                require(p.zfar.is_none_or(|far| far > p.znear), "zfar must be > znear")?;
                require(p.aspect_ratio.is_none_or(|aspect| aspect > 0.0), "aspectRatio must be > 0")?;
                Projection::Perspective { vertical_fov: p.yfov, aspect: p.aspect_ratio, near_m: p.znear, far_m: p.zfar }
            }
            (Type::Orthographic, _, Some(o)) => {
                context.finite(&field, &[o.xmag, o.ymag, o.znear, o.zfar])?;
                require(o.xmag != 0.0 && o.ymag != 0.0, "xmag and ymag must not be 0")?;
                require(o.znear >= 0.0 && o.zfar > o.znear, "0 <= znear < zfar must hold")?;
                if o.xmag < 0.0 || o.ymag < 0.0 {
                    context.warn(&field, "xmag or ymag is negative; its size is used");
                }
                Projection::Orthographic {
                    half_width_m: o.xmag.abs(),
                    half_height_m: o.ymag.abs(),
                    near_m: o.znear,
                    far_m: o.zfar,
                }
            }
            _ => return Err(context.error(field, "its properties are missing")),
        };
        Ok(Camera { name: json.name.clone(), projection })
    };
    document.root.cameras.iter().enumerate().map(camera).collect()
}
