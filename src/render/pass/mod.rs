//! The passes of a frame, one file each: whether it is wanted and why not, what it draws into, what it draws and with which
//! pipelines, and its recording. The list here is the order of a frame, and the only one.
//!
//! A pass is added by its own file, one entry of the list and its shaders. Skinning, strand dynamics, the shadow passes and
//! the draws of the opaque, fur and transparent passes serve a host's frame, too; the others make pictures.

pub mod draw;
pub mod full_screen;
pub mod order;
pub mod shadow_passes;

use super::device_scene::DrawnScene;
use super::options::FrameOptions;
use super::picture::{PictureTargets, SkyboxImage};
use super::plan::{Attachment, FrameSetup, Plan, PlanInput, PlanOptions};
use crate::gpu::{Encoder, Image};
use full_screen::FullScreenDesc;

/// What a pass says of itself.
pub(crate) struct Definition {
    /// Name in labels, timings and reports.
    pub name: &'static str,
    /// Whether a frame has it: `Err` says why not. The plan is complete but for its list of passes.
    pub wanted: fn(&Plan, &PlanInput) -> Result<(), &'static str>,
    /// Adds its draws and their pipelines to a plan that knows what the scene shows.
    pub add_draws: fn(&mut Plan, &PlanInput),
    /// The pipeline by which it draws one triangle over a whole target, if it does.
    pub full_screen: fn(&PlanOptions) -> Option<FullScreenDesc>,
    /// The images that it draws into first.
    pub attachments: fn(&Plan, &PlanOptions) -> Vec<Attachment>,
    /// Names of those that it may do without, and why.
    pub optional_attachments: &'static [(&'static str, &'static str)],
    /// Records it into a picture's frame.
    pub record: fn(&mut Encoder, &PictureFrame),
}

/// Adds no draws.
fn no_draws(_: &mut Plan, _: &PlanInput) {}

/// Draws no triangle over a whole target.
fn no_full_screen(_: &PlanOptions) -> Option<FullScreenDesc> {
    None
}

/// Draws into no image of its own.
fn no_attachments(_: &Plan, _: &PlanOptions) -> Vec<Attachment> {
    Vec::new()
}

/// What the passes of one picture share.
pub(crate) struct PictureFrame<'a> {
    /// When, from where, in which light.
    pub setup: &'a FrameSetup,
    /// How.
    pub options: &'a FrameOptions,
    /// What is drawn, on the device.
    pub drawn: DrawnScene<'a>,
    /// What it is drawn into, and the groups that read it.
    pub targets: &'a PictureTargets,
    /// The environment, where the background shows it.
    pub skybox: Option<&'a SkyboxImage>,
    /// The display colour.
    pub display: &'a Image,
}

impl PictureFrame<'_> {
    /// What it takes.
    pub fn plan(&self) -> &Plan {
        &self.setup.staging.plan
    }
}

macro_rules! passes {
    ($($(#[doc = $doc:literal])* $pass:ident = $module:ident;)*) => {
        /// A pass of the frame, in the order in which they run.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Pass {
            $($(#[doc = $doc])* $pass,)*
        }

        impl Pass {
            /// All, in their order.
            pub const ALL: &'static [Self] = &[$(Self::$pass,)*];

            fn definition(self) -> &'static Definition {
                match self {
                    $(Self::$pass => &$module::PASS,)*
                }
            }
        }
    };
}

pub mod fur;
pub mod gbuffer;
pub mod host_shadow;
pub mod oit_build;
pub mod oit_resolve;
pub mod opaque;
pub mod shadow_map;
pub mod skinning;
pub mod ssao;
pub mod ssao_blur;
pub mod strand_dynamics;
pub mod tone_mapping;
pub mod translucent_shadow_back;
pub mod translucent_shadow_front;
pub mod translucent_shadow_transmittance;
pub mod transparent;

passes! {
    /// Skinning and morphing.
    Skinning = skinning;
    /// Strands that lag behind their roots.
    StrandDynamics = strand_dynamics;
    /// Depth, normal and motion of what is nearest.
    GBuffer = gbuffer;
    /// Screen-space ambient occlusion of a few slices a pixel.
    Ssao = ssao;
    /// Their mean.
    SsaoBlur = ssao_blur;
    /// Nearest opaque surfaces, as lights see them.
    ShadowMap = shadow_map;
    /// First translucent surfaces, as lights see them.
    TranslucentShadowFront = translucent_shadow_front;
    /// Last ones.
    TranslucentShadowBack = translucent_shadow_back;
    /// How much light all of them let through.
    TranslucentShadowTransmittance = translucent_shadow_transmittance;
    /// All that casts shadows, into a map of the host's.
    HostShadow = host_shadow;
    /// Opaque and masked surfaces; always there, since it clears the targets.
    Opaque = opaque;
    /// Shells that do not blend.
    Fur = fur;
    /// What blends, into the pixels' linked lists.
    OitBuild = oit_build;
    /// What blends, over what was drawn before, sorted by objects.
    Transparent = transparent;
    /// The linked lists, sorted and composed over what is opaque.
    OitResolve = oit_resolve;
    /// Linear HDR to display colour.
    ToneMapping = tone_mapping;
}

impl Pass {
    /// Name in labels, timings and reports.
    pub fn name(self) -> &'static str {
        self.definition().name
    }

    /// Whether a frame of that plan has it: `Err` says why not.
    ///
    /// # Errors
    /// The reason, in a few words.
    pub fn wanted(self, plan: &Plan, input: &PlanInput) -> Result<(), &'static str> {
        (self.definition().wanted)(plan, input)
    }

    pub(crate) fn full_screen(self, options: &PlanOptions) -> Option<FullScreenDesc> {
        (self.definition().full_screen)(options)
    }

    /// Names of the images that it may do without, and why it then does.
    pub fn optional_attachments(self) -> &'static [(&'static str, &'static str)] {
        self.definition().optional_attachments
    }

    pub(crate) fn add_draws(self, plan: &mut Plan, input: &PlanInput) {
        (self.definition().add_draws)(plan, input);
    }

    pub(crate) fn attachments(self, plan: &Plan, options: &PlanOptions) -> Vec<Attachment> {
        (self.definition().attachments)(plan, options)
    }

    pub(crate) fn record(self, encoder: &mut Encoder, frame: &PictureFrame) {
        (self.definition().record)(encoder, frame);
    }
}
