//! What a picture's frame draws into and reads: the images that its plan lists, by name, and the passes over whole targets
//! that are bound to them. Kept while size, samples and formats stay.

use super::skybox::SkyboxImage;
use crate::gpu::{BindGroup, Gpu, GpuError, Image, Pipeline, Resource};
use crate::render::pass::Pass;
use crate::render::pass::full_screen::FullScreen;
use crate::render::pass::oit_resolve::Lists;
use crate::render::pass::opaque::{COLOR, DEPTH, RESOLVED};
use crate::render::plan::{Attachment, Plan, PlanOptions};
use crate::render::renderer::Shared;
use std::collections::BTreeMap;

/// What a picture's frame draws into and reads.
pub(crate) struct PictureTargets {
    key: ([u32; 2], Vec<Attachment>),
    images: BTreeMap<&'static str, Image>,
    /// Linked lists of what blends, and the group by which they are built.
    pub lists: Option<(Lists, BindGroup)>,
    full_screen: BTreeMap<Pass, FullScreen>,
    /// What the passes were bound for.
    bound_for: Option<PlanOptions>,
}

impl PictureTargets {
    /// Makes the images that a plan lists.
    ///
    /// # Errors
    /// When the device is out of memory or the size is beyond its limits.
    pub fn new(gpu: &Gpu, size: [u32; 2], attachments: &[Attachment]) -> Result<Self, GpuError> {
        let mut images = BTreeMap::new();
        for attachment in attachments {
            images.insert(attachment.name, attachment.create(gpu, size)?);
        }
        let key = (size, attachments.to_vec());
        Ok(Self { key, images, lists: None, full_screen: BTreeMap::new(), bound_for: None })
    }

    /// Whether they serve such a frame, too.
    pub fn fit(&self, size: [u32; 2], attachments: &[Attachment]) -> bool {
        self.key.0 == size && self.key.1 == attachments
    }

    /// Makes linked lists of that many entries; `builds` is any pipeline that appends to them.
    ///
    /// # Errors
    /// When the device is out of memory.
    pub fn make_lists(&mut self, gpu: &Gpu, capacity: u32, builds: &Pipeline) -> Result<(), GpuError> {
        let lists = Lists::new(gpu, self.key.0, capacity)?;
        let group = lists.building_group(gpu, builds)?;
        (self.lists, self.bound_for) = (Some((lists, group)), None);
        Ok(())
    }

    /// Binds the passes over whole targets to what they read, where that has changed.
    ///
    /// # Errors
    /// When the device is out of memory.
    pub fn bind(
        &mut self,
        shared: &mut Shared,
        plan: &Plan,
        options: &PlanOptions,
        skybox: Option<&SkyboxImage>,
    ) -> Result<(), GpuError> {
        if self.bound_for.as_ref() == Some(options) {
            return Ok(());
        }
        self.full_screen.clear();
        for &pass in &plan.passes {
            let Some(desc) = pass.full_screen(options) else { continue };
            if pass == Pass::OitResolve && self.lists.is_none() {
                continue;
            }
            let bound = FullScreen::new(shared, pass, &desc, self, skybox)?;
            self.full_screen.insert(pass, bound);
        }
        self.bound_for = Some(*options);
        Ok(())
    }

    /// The passes are to be bound again.
    pub fn unbind(&mut self) {
        self.bound_for = None;
    }

    /// A pass over a whole target.
    pub fn full_screen(&self, pass: Pass) -> Option<&FullScreen> {
        self.full_screen.get(&pass)
    }

    /// An image by the name of its attachment; [`hdr`](Self::hdr) is that of the linear colour at one sample.
    pub fn image(&self, name: &str) -> Option<&Image> {
        if name == HDR { self.hdr() } else { self.images.get(name) }
    }

    /// What a pass reads by that name: an image, a buffer of the lists, the skybox and its sampler.
    pub fn resource<'a>(&'a self, name: &str, skybox: Option<&'a SkyboxImage>) -> Option<Resource<'a>> {
        let image = self.image(name).map(Resource::Texture);
        let buffer = || self.lists.as_ref().and_then(|(lists, _)| lists.buffer(name)).map(Resource::Buffer);
        let sky = || match name {
            SKYBOX => skybox.map(|skybox| Resource::Texture(&skybox.map)),
            SKYBOX_SAMPLER => skybox.map(|skybox| Resource::Sampler(&skybox.sampler)),
            _ => None,
        };
        image.or_else(buffer).or_else(sky)
    }

    /// Linear HDR colour at the samples asked for.
    pub fn color(&self) -> Option<&Image> {
        self.images.get(COLOR)
    }

    /// Reversed depth.
    pub fn depth(&self) -> Option<&Image> {
        self.images.get(DEPTH)
    }

    /// Linear HDR colour at one sample, and with all that blends; `None` where the colour is that already.
    pub fn resolved(&self) -> Option<&Image> {
        self.images.get(RESOLVED)
    }

    /// The one-sample HDR image that later passes read.
    pub fn hdr(&self) -> Option<&Image> {
        self.resolved().or(self.color())
    }
}

/// The one-sample HDR image, whichever of the attachments it is.
pub(crate) const HDR: &str = "hdr";
/// The environment as the background shows it.
pub(crate) const SKYBOX: &str = "skybox";
/// And its sampler.
pub(crate) const SKYBOX_SAMPLER: &str = "skybox sampler";
