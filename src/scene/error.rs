//! Errors of this room.

/// A scene that cannot be loaded or dressed, or a request that it cannot meet.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The file cannot be loaded.
    #[error(transparent)]
    Asset(#[from] crate::asset::AssetError),
    /// A material or look is wrong.
    #[error(transparent)]
    Material(#[from] crate::material::MaterialError),
    /// The look keys that a file's own materials carry are wrong.
    #[error("{}: {source}", file.display())]
    Keys {
        /// The file.
        file: std::path::PathBuf,
        /// Which key, and why.
        source: Box<crate::material::MaterialError>,
    },
    /// A parameter of a material cannot be set.
    #[error("material \"{material}\": {source}")]
    Parameter {
        /// The material's name.
        material: String,
        /// Which key, and why.
        source: Box<crate::material::ParameterError>,
    },
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
