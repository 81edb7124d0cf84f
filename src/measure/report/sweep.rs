//! Sweeps: ways to draw fur, and the knobs of each.

use super::Effort;
use super::case::{Cases, View};
use crate::render::{
    FrameOptions, Shadows, ShellAlpha, ShellOrder, ShellSampling, ShellSubmission, Shells, Transparency,
};
use crate::scene::EnvironmentLight;
use glam::Vec3;

/// A way to draw fur.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Method {
    /// Name in tables and plots.
    pub name: &'static str,
    /// How shells are drawn.
    pub shells: Shells,
    /// Samples a pixel.
    pub msaa: u32,
    /// What others do.
    pub is_classic: bool,
}

/// Shells of the classic way.
pub const CLASSIC_LAYERS: u32 = 20;

impl Method {
    /// What a frame without further options does.
    pub fn ours() -> Self {
        let FrameOptions { shells, msaa, .. } = FrameOptions::default();
        Self { name: "slab layers (default)", shells, msaa, is_classic: false }
    }

    /// One draw with its own uniform a shell, cut by a threshold at a point, blended over each other from the inside
    /// (Lengyel et al. 2001, "Real-Time Fur over Arbitrary Surfaces").
    pub fn classic_draws() -> Self {
        let (sampling, alpha) = (ShellSampling::Point, ShellAlpha::Step);
        let shells = Shells { sampling, alpha, submission: ShellSubmission::Draws, order: ShellOrder::Blended };
        Self { name: "classic: a draw a layer, blended", shells, is_classic: true, ..Self::ours() }
    }

    /// One draw of a mesh with its vertices once a shell.
    pub fn classic_duplicated() -> Self {
        let (sampling, alpha) = (ShellSampling::Point, ShellAlpha::Step);
        let shells = Shells { sampling, alpha, submission: ShellSubmission::Duplicated, order: ShellOrder::InnerFirst };
        Self { name: "classic: duplicated vertices", shells, is_classic: true, ..Self::ours() }
    }

    /// Ours with another name and one part changed.
    fn ours_but(name: &'static str, change: impl FnOnce(&mut Self)) -> Self {
        let mut method = Self { name, ..Self::ours() };
        change(&mut method);
        method
    }
}

/// One feature's sweep: every method with every number of layers, seen by every view.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// Name of the feature.
    pub name: &'static str,
    /// Ways to draw.
    pub methods: Vec<Method>,
    /// Shells of the default method.
    pub layers: Vec<u32>,
    /// Shells of the others; classic methods also get [`CLASSIC_LAYERS`].
    pub layers_of_others: Vec<u32>,
    /// Views, all with a reference.
    pub views: Vec<View>,
}

impl Sweep {
    /// Shells that a method is drawn with.
    pub(super) fn layers_of(&self, method: &Method) -> Vec<u32> {
        let ours = Method::ours();
        let is_default = (method.shells, method.msaa) == (ours.shells, ours.msaa);
        let mut layers = if is_default { &self.layers } else { &self.layers_of_others }.clone();
        if method.is_classic && !layers.contains(&CLASSIC_LAYERS) {
            layers.push(CLASSIC_LAYERS);
        }
        layers
    }

    /// All of them, with the numbers of layers that an effort affords.
    pub fn all(effort: &Effort) -> Vec<Self> {
        let ours = Method::ours();
        let sweep = |name, methods, views: &[View]| Self {
            name,
            methods,
            layers: effort.layers.clone(),
            layers_of_others: effort.layers_of_others.clone(),
            views: views.to_vec(),
        };
        vec![
            sweep(
                "fur layers",
                vec![
                    ours,
                    Method::ours_but("point layers", |m| m.shells.sampling = ShellSampling::Point),
                    Method::classic_draws(),
                    Method::classic_duplicated(),
                ],
                &View::ALL,
            ),
            sweep(
                "fur alpha",
                vec![
                    Method { name: "correlated (default)", ..ours },
                    Method::ours_but("slab layers, independent alpha", |m| m.shells.alpha = ShellAlpha::Independent),
                    Method::ours_but("slab layers, step alpha", |m| m.shells.alpha = ShellAlpha::Step),
                ],
                &[View::Far, View::Moving],
            ),
            sweep(
                "fur order",
                vec![
                    Method { name: "outermost first (default)", ..ours },
                    Method::ours_but("slab layers, innermost first", |m| m.shells.order = ShellOrder::InnerFirst),
                    Method::ours_but("slab layers, blended from the inside", |m| m.shells.order = ShellOrder::Blended),
                ],
                &[View::Gallery],
            ),
            sweep(
                "fur submission",
                vec![
                    Method { name: "one instanced draw (default)", ..ours },
                    Method::ours_but("slab layers, a draw a layer", |m| m.shells.submission = ShellSubmission::Draws),
                    Method::ours_but("slab layers, duplicated vertices", |m| {
                        m.shells.submission = ShellSubmission::Duplicated
                    }),
                ],
                &[View::Gallery],
            ),
            sweep(
                "msaa",
                vec![
                    Method { name: "4 samples (default)", ..ours },
                    Method::ours_but("slab layers, 1 sample", |m| m.msaa = 1),
                ],
                &[View::Gallery, View::Moving],
            ),
        ]
    }
}

/// One picture of a sweep: equal points are measured once, whichever sweep asks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct SweepPoint {
    /// Camera and scene.
    pub view: View,
    /// How shells are drawn.
    pub shells: Shells,
    /// Samples a pixel.
    pub msaa: u32,
    /// Shells.
    pub layers: u32,
}

impl SweepPoint {
    /// A method's point.
    pub fn new(method: &Method, layers: u32, view: View) -> Self {
        Self { view, shells: method.shells, msaa: method.msaa, layers }
    }

    /// Each frame of the view.
    pub fn frames(&self, cases: &Cases, effort: &Effort) -> Vec<FrameOptions> {
        let size = effort.size_of(self.view);
        let options = FrameOptions {
            size,
            layers: Some(self.layers),
            shells: self.shells,
            msaa: self.msaa,
            // Shells that blend are drawn in their order: lists would measure something else.
            transparency: Transparency::Sorted,
            // What the oracle knows.
            environment: EnvironmentLight::constant(Vec3::splat(0.05)),
            shadows: Shadows { are_cast: false, ..Shadows::default() },
            ..Default::default()
        };
        let cameras = cases.cameras(self.view, size[1]);
        cameras.into_iter().map(|camera| FrameOptions { camera, ..options.clone() }).collect()
    }
}
