//! Punctual lights (KHR_lights_punctual).

use super::context::Context;
use super::document::Document;
use super::{AssetError, Light, LightKind};
use ::gltf::json::extensions::scene::khr_lights_punctual as json;
use glam::Vec3;
use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};

/// All lights.
///
/// # Errors
/// A type that the extension does not have; numbers that are not finite.
pub(super) fn read(context: &Context, document: &Document) -> Result<Vec<Light>, AssetError> {
    let light = |(i, json): (usize, &json::Light)| {
        let field = format!("extensions.KHR_lights_punctual.lights[{i}]");
        let (color, intensity) = (Vec3::from(json.color), json.intensity);
        let (inner, outer) =
            json.spot.as_ref().map_or((0.0, FRAC_PI_4), |spot| (spot.inner_cone_angle, spot.outer_cone_angle));
        context.finite(&field, &[color.x, color.y, color.z, intensity, json.range.unwrap_or(1.0), inner, outer])?;
        if color.min_element() < 0.0 || intensity < 0.0 {
            context.warn(&field, "has a negative colour or intensity; it counts as 0");
        }
        let range_m = json.range.filter(|range| *range > 0.0);
        if range_m != json.range {
            context.warn(&field, "range must be > 0; it counts as infinite");
        }
        let place = format!("{field}.type");
        let kind = document.code(&place, &json.type_);
        let kind = match kind.map_err(|name| context.error(&place, format_args!("`{name}` does not exist")))? {
            json::Type::Directional => LightKind::Directional,
            json::Type::Point => LightKind::Point { range_m },
            json::Type::Spot => {
                let outer_angle = outer.clamp(f32::EPSILON, FRAC_PI_2);
                // Equal angles would divide by zero in the falloff between them.
                let inner_angle = inner.clamp(0.0, outer_angle * (1.0 - f32::EPSILON));
                if (inner_angle, outer_angle) != (inner, outer) {
                    context.warn(&field, "0 <= innerConeAngle < outerConeAngle <= pi/2 must hold; clamped");
                }
                LightKind::Spot { range_m, inner_angle, outer_angle }
            }
        };
        Ok(Light { name: json.name.clone(), color: color.max(Vec3::ZERO), intensity: intensity.max(0.0), kind })
    };
    document.lights().iter().enumerate().map(light).collect()
}
