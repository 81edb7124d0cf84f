//! Choosing a part of a file by name or by index.

use super::SceneError;
use crate::asset::Asset;

/// Index of an animation from its name or its number.
///
/// # Errors
/// [`SceneError::Unknown`] with the names that exist.
pub fn find_animation(asset: &Asset, text: &str) -> Result<usize, SceneError> {
    find("animation", text, asset.animations.iter().map(|animation| animation.name.as_deref()))
}

/// Index of a scene from its name or its number.
///
/// # Errors
/// [`SceneError::Unknown`] with the names that exist.
pub fn find_scene(asset: &Asset, text: &str) -> Result<usize, SceneError> {
    find("scene", text, asset.scenes.iter().map(|scene| scene.name.as_deref()))
}

/// Index of a material variant from its name or its number.
///
/// # Errors
/// [`SceneError::Unknown`] with the names that exist.
pub fn find_variant(asset: &Asset, text: &str) -> Result<usize, SceneError> {
    find("variant", text, asset.variants.iter().map(|name| Some(name.as_str())))
}

/// Index of a camera from its name, from the name of a node that holds it (what editors show), or from its number.
///
/// # Errors
/// [`SceneError::Unknown`] with the names that exist.
pub fn find_camera(asset: &Asset, text: &str) -> Result<usize, SceneError> {
    let held_by = |camera: usize| {
        asset.nodes.iter().find(|node| node.camera == Some(camera)).and_then(|node| node.name.as_deref())
    };
    let by_node = || asset.nodes.iter().find(|node| node.name.as_deref() == Some(text) && node.camera.is_some());
    let is_camera_name = asset.cameras.iter().any(|camera| camera.name.as_deref() == Some(text));
    match by_node().filter(|_| !is_camera_name).and_then(|node| node.camera) {
        Some(camera) => Ok(camera),
        None => {
            let names =
                asset.cameras.iter().enumerate().map(|(i, camera)| camera.name.as_deref().or_else(|| held_by(i)));
            find("camera", text, names)
        }
    }
}

/// A name wins over a number, so that a part called "2" can be reached; the first of equal names is taken.
fn find<'a>(
    kind: &'static str,
    text: &str,
    names: impl ExactSizeIterator<Item = Option<&'a str>> + Clone,
) -> Result<usize, SceneError> {
    let by_name = names.clone().position(|name| name == Some(text));
    let by_index = || text.parse::<usize>().ok().filter(|&index| index < names.len());
    by_name.or_else(by_index).ok_or_else(|| SceneError::Unknown {
        kind,
        asked: text.to_owned(),
        available: names
            .clone()
            .enumerate()
            .map(|(index, name)| name.map_or_else(|| index.to_string(), |name| format!("{index} \"{name}\"")))
            .collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asset::{Animation, Camera, Node};

    fn asset() -> Asset {
        let clip = |name: Option<&str>| Animation { name: name.map(str::to_owned), ..Animation::default() };
        Asset {
            animations: vec![clip(Some("Survey")), clip(Some("0")), clip(None)],
            cameras: vec![Camera::default(), Camera { name: Some("close".into()), ..Camera::default() }],
            nodes: vec![Node { name: Some("tripod".into()), camera: Some(0), ..Node::default() }],
            ..Asset::default()
        }
    }

    #[test]
    fn names_win_over_numbers() {
        assert_eq!(find_animation(&asset(), "Survey").ok(), Some(0));
        assert_eq!(find_animation(&asset(), "0").ok(), Some(1));
        assert_eq!(find_animation(&asset(), "2").ok(), Some(2));
    }

    #[test]
    fn cameras_answer_to_their_nodes() {
        assert_eq!(find_camera(&asset(), "tripod").ok(), Some(0));
        assert_eq!(find_camera(&asset(), "close").ok(), Some(1));
        assert_eq!(find_camera(&asset(), "0").ok(), Some(0));
    }

    #[test]
    fn an_error_lists_what_exists() {
        let error = find_animation(&asset(), "Run").unwrap_err();
        assert_eq!(error.to_string(), "no animation \"Run\": choose one of 0 \"Survey\", 1 \"0\", 2");
        let error = find_variant(&asset(), "-1").unwrap_err();
        assert_eq!(error.to_string(), "no variant \"-1\": the file has no variants");
    }
}
