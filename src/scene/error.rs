//! Errors of this room.

/// A request that the scene cannot meet. Loaded data itself is sound (checked at load), so only choices can fail.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// No such animation, scene, camera or variant.
    #[error("no {kind} \"{asked}\": {}", available_in_words(kind, available))]
    Unknown {
        /// "animation", "scene", "camera" or "variant".
        kind: &'static str,
        /// Name or index as asked.
        asked: String,
        /// What exists, as `index "name"`.
        available: Vec<String>,
    },
    /// The camera exists but no node of the scene holds it.
    #[error(
        "camera \"{camera}\" is held by no node of scene {scene}: choose another scene, another camera, or an orbit"
    )]
    CameraOutsideScene {
        /// Name or index as asked.
        camera: String,
        /// Scene index.
        scene: usize,
    },
    /// A number of the view is outside its range.
    #[error("{field} is {value}: give {allowed}")]
    View {
        /// Which number.
        field: &'static str,
        /// As asked.
        value: f32,
        /// Its range in words.
        allowed: &'static str,
    },
}

/// Names beyond this many are counted, not listed: an error is one line.
const LISTED_NAMES: usize = 24;

fn available_in_words(kind: &str, available: &[String]) -> String {
    match available {
        [] => format!("the file has no {kind}s"),
        names if names.len() <= LISTED_NAMES => format!("choose one of {}", names.join(", ")),
        names => {
            format!("choose one of {} and {} more", names[..LISTED_NAMES].join(", "), names.len() - LISTED_NAMES)
        }
    }
}
