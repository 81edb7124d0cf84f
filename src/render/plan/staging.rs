//! What is drawn in a frame and by which lights, as plain data: placed meshes, their parts, lights, shadow maps, and the
//! plan. A host's scene and a picture fill it in their own ways; what follows is the same for both.

use super::{Plan, PlanInput, PlanOptions};
use crate::math::{Aabb, Sphere};
use crate::scene::{self, Camera, Instance, Light, LightLists, Part, Scene, ShadowMap, ShadowMaps, Size};

/// What is drawn in a frame. Kept from frame to frame: what did not change allocates nothing.
#[derive(Debug, Default)]
pub struct Staging {
    /// Placed meshes in their pose.
    pub instances: Vec<Instance>,
    /// Where they were in the previous frame, one for each, where motion is asked for.
    pub previous: Vec<Instance>,
    /// What tells an instance from others while lists change: its node, or its place in a host's scene.
    pub keys: Vec<usize>,
    /// How large their meshes are.
    pub sizes: Vec<Size>,
    /// Instances that are not drawn for now.
    pub hidden: Vec<bool>,
    /// What is drawn of the instances.
    pub parts: Vec<Part>,
    /// Punctual lights.
    pub lights: Vec<Light>,
    /// Which lights reach which part.
    pub light_lists: LightLists,
    /// What lights see that cast shadows.
    pub shadow_maps: ShadowMaps,
    /// Bounding spheres of the parts, with their fur.
    pub spheres: Vec<Sphere>,
    /// What the frame needs.
    pub plan: Plan,
    /// Grows whenever the plan changes.
    pub plan_revision: u64,
    options: Option<PlanOptions>,
    /// Revision of the scene's materials, and shadow maps, that the plan was made for; `None` where parts have changed since.
    planned: Option<(u64, usize)>,
}

impl Staging {
    /// Takes other instances; `variant` chooses their materials.
    pub fn place(&mut self, scene: &Scene, instances: Vec<Instance>, variant: Option<usize>) {
        self.sizes = instances.iter().map(|instance| scene.size(instance)).collect();
        self.keys = instances.iter().enumerate().map(|(index, instance)| instance.node.unwrap_or(index)).collect();
        self.hidden = vec![false; instances.len()];
        self.parts = scene::parts(scene.asset(), &instances, variant);
        self.instances = instances;
        self.previous.clear();
        self.planned = None;
    }

    /// Parts have changed: the next update makes a plan.
    pub fn replan(&mut self) {
        self.planned = None;
    }

    /// How it is drawn, as the last update was told.
    pub fn options(&self) -> PlanOptions {
        self.options.unwrap_or_default()
    }

    /// Whether an instance is drawn.
    pub fn is_shown(&self, instance: usize) -> bool {
        self.instances[instance].is_visible && !self.hidden[instance]
    }

    /// What the plan is made of.
    pub fn input<'a>(&'a self, scene: &'a Scene, options: &'a PlanOptions) -> PlanInput<'a> {
        let shadow_map_count = self.shadow_maps.maps.len();
        let is_reached_by_light = !self.light_lists.lights.is_empty();
        let (instances, parts) = (&self.instances[..], &self.parts[..]);
        PlanInput { scene, instances, parts, shadow_map_count, is_reached_by_light, options }
    }

    /// Finds what lights reach and what they see, and plans anew where what is drawn, or how, has changed; `whole` is the
    /// sphere around all that a picture shows.
    pub fn update(&mut self, scene: &Scene, options: &PlanOptions, whole: Option<Sphere>, camera: &Camera) {
        self.spheres.clear();
        for &part in &self.parts {
            let (instance, size) = (&self.instances[part.instance], self.sizes[part.instance]);
            self.spheres.push(scene.bounding_sphere(part, instance, size, whole));
        }
        self.light_lists.set(&self.lights, self.spheres.iter().copied());
        self.find_shadow_maps(options, whole, camera);
        self.plan_anew(scene, options);
    }

    /// The same for a host's scene, which finds its own extent from how its instances are posed; the host may know what
    /// shadow maps show, or bring maps of its own.
    pub fn update_for_host(
        &mut self,
        scene: &Scene,
        options: &PlanOptions,
        camera: &Camera,
        shadow_bounds: Option<Sphere>,
        host_maps: Option<Vec<ShadowMap>>,
    ) {
        self.spheres.clear();
        for &part in &self.parts {
            let (instance, size) = (&self.instances[part.instance], self.sizes[part.instance]);
            self.spheres.push(scene.posed_sphere(part, instance, size));
        }
        self.light_lists.set(&self.lights, self.spheres.iter().copied());
        match host_maps {
            Some(maps) => self.shadow_maps = ShadowMaps { maps, without: Vec::new() },
            None => self.find_shadow_maps(options, shadow_bounds.or_else(|| self.shown_sphere()), camera),
        }
        self.plan_anew(scene, options);
    }

    fn find_shadow_maps(&mut self, options: &PlanOptions, whole: Option<Sphere>, camera: &Camera) {
        self.shadow_maps = match whole.filter(|_| options.shadows.are_cast) {
            Some(sphere) => {
                let casts = |light| self.light_lists.is_used(light);
                scene::shadow_maps(&self.lights, casts, sphere, camera, options.shadows.resolution_px)
            }
            None => ShadowMaps::default(),
        };
    }

    fn plan_anew(&mut self, scene: &Scene, options: &PlanOptions) {
        let map_count = self.shadow_maps.maps.len();
        let is_planned = self.planned == Some((scene.revision(), map_count)) && self.options.as_ref() == Some(options);
        if !is_planned {
            let plan = Plan::new(&self.input(scene, options));
            if plan != self.plan || self.options.as_ref() != Some(options) {
                self.plan = plan;
                self.plan_revision += 1;
            }
            (self.planned, self.options) = (Some((scene.revision(), map_count)), Some(*options));
        }
        if self.plan.shadows.map_count == 0 {
            // Nothing receives a shadow.
            self.shadow_maps.maps.clear();
        }
    }

    /// The sphere around all that is shown.
    fn shown_sphere(&self) -> Option<Sphere> {
        let shown = self.parts.iter().zip(&self.spheres).filter(|(part, _)| self.is_shown(part.instance));
        let mut bounds = Aabb::EMPTY;
        for (_, sphere) in shown.clone() {
            bounds = bounds.union(Aabb { min: sphere.center - sphere.radius, max: sphere.center + sphere.radius });
        }
        let center = bounds.center();
        let radius = shown.map(|(_, sphere)| sphere.center.distance(center) + sphere.radius).fold(0.0, f32::max);
        (radius > 0.0 && radius.is_finite() && center.is_finite()).then_some(Sphere { center, radius })
    }
}
