//! Frame setup: a scene at one time through one camera, and what drawing it as a picture takes.

use super::Staging;
use crate::asset::{Asset, Primitive, Topology};
use crate::material::Material;
use crate::render::options::ShellSubmission;
use crate::render::{FrameOptions, RenderError};
use crate::scene::{self, Camera, Instance, Lighting, Pose, Scene};

/// A scene at one time through one camera, and what drawing it takes. Plain data, made without a device.
pub struct FrameSetup {
    /// Where every node is.
    pub pose: Pose,
    /// Camera to render from.
    pub camera: Camera,
    /// Camera of the previous frame, where motion is asked for.
    pub previous_camera: Option<Camera>,
    /// Bounding radius of what the scene shows, metres.
    pub radius_m: f32,
    /// What is drawn, by which lights, and the plan.
    pub staging: Staging,
    previous_pose: Pose,
    /// What was placed: scene, its index, clip or none, variant.
    placed: Option<(u64, usize, bool, Option<usize>)>,
    /// Nodes that hold lights.
    light_nodes: Vec<usize>,
}

impl FrameSetup {
    /// Poses, places the camera and plans.
    ///
    /// # Errors
    /// When an option is out of range or names what the scene lacks.
    pub fn new(scene: &Scene, options: &FrameOptions) -> Result<Self, RenderError> {
        options.check(scene.asset())?;
        let mut setup = Self {
            pose: Pose::default(),
            camera: camera(scene, &scene::pose(scene.asset(), None, 0.0), options)?,
            previous_camera: None,
            radius_m: 0.0,
            staging: Staging::default(),
            previous_pose: Pose::default(),
            placed: None,
            light_nodes: Vec::new(),
        };
        setup.update(scene, options)?;
        Ok(setup)
    }

    /// Becomes [`Self::new`], in the memory that it has: while the scene only moves, the plan stays.
    ///
    /// # Errors
    /// Those of [`Self::new`]. Then it is not to be drawn before the next update.
    pub fn update(&mut self, scene: &Scene, options: &FrameOptions) -> Result<(), RenderError> {
        options.check(scene.asset())?;
        let asset = scene.asset();
        let scene_index = options.scene.unwrap_or(asset.default_scene);
        self.pose.set(asset, options.animation, clip_time_s(asset, options.animation, options.time_s));
        self.place(scene, scene_index, options);
        check_duplicated(scene, &self.staging, options)?;

        let staging = &mut self.staging;
        staging.lights.clear();
        staging
            .lights
            .extend(self.light_nodes.iter().filter_map(|&node| scene::light_of_node(asset, node, &self.pose)));
        staging.lights.extend(options.lights.iter().cloned());
        let shown = scene.outline(scene_index, options.animation);
        self.radius_m = shown.bounds().sphere().radius;
        self.camera = camera(scene, &self.pose, options)?;
        self.previous_camera = None;
        if options.aovs.motion {
            let time_s = options.previous_time_s.unwrap_or(options.time_s);
            self.previous_pose.set(asset, options.animation, clip_time_s(asset, options.animation, time_s));
            self.previous_camera = Some(camera(scene, &self.previous_pose, options)?);
            staging.previous.clone_from(&staging.instances);
            scene::pose_instances(&mut staging.previous, asset, &self.previous_pose);
        }
        staging.update(scene, &options.plan_options(), scene::bounding_sphere(&shown), &self.camera);
        Ok(())
    }

    /// Instances in their pose; others where another scene, clip or variant is shown, or something comes into view.
    fn place(&mut self, scene: &Scene, scene_index: usize, options: &FrameOptions) {
        let asset = scene.asset();
        let placed = Some((scene.id(), scene_index, options.animation.is_some(), options.variant));
        if self.placed == placed {
            let is_visible = |instances: &[Instance]| instances.iter().filter(|instance| instance.is_visible).count();
            let before = is_visible(&self.staging.instances);
            scene::pose_instances(&mut self.staging.instances, asset, &self.pose);
            if is_visible(&self.staging.instances) == before {
                return;
            }
        }
        self.placed = placed;
        self.light_nodes = scene::nodes_of_scene(asset, scene_index);
        self.light_nodes.retain(|&node| asset.nodes[node].light.is_some());
        self.staging.place(scene, scene::instances(asset, scene_index, &self.pose), options.variant);
    }

    /// All light of the frame.
    pub fn lighting(&self, options: &FrameOptions) -> Lighting {
        Lighting { lights: self.staging.lights.clone(), environment: options.environment.clone() }
    }

    /// What the frame does without, and why.
    pub fn skipped(&self, scene: &Scene) -> Vec<super::Skipped> {
        super::skipped::skipped(&self.staging, scene)
    }
}

fn camera(scene: &Scene, pose: &Pose, options: &FrameOptions) -> Result<Camera, RenderError> {
    let asset = scene.asset();
    let scene_index = options.scene.unwrap_or(asset.default_scene);
    let shown = scene.outline(scene_index, options.animation);
    let aspect = options.size[0] as f32 / options.size[1] as f32;
    Ok(scene::camera(asset, scene_index, pose, &options.camera, aspect, &shown)?)
}

/// Beyond its end a clip starts again.
fn clip_time_s(asset: &Asset, animation: Option<usize>, time_s: f32) -> f32 {
    match animation.map(|index| asset.animations[index].duration_s) {
        Some(duration_s) if duration_s > 0.0 && time_s > duration_s => time_s.rem_euclid(duration_s),
        _ => time_s,
    }
}

/// Says which fur cannot have its vertices once a shell.
fn check_duplicated(scene: &Scene, staging: &Staging, options: &FrameOptions) -> Result<(), RenderError> {
    if options.shells.submission != ShellSubmission::Duplicated {
        return Ok(());
    }
    for part in &staging.parts {
        let Material { fur: Some(fur), name, .. } = &scene.materials()[part.material] else { continue };
        let Primitive { topology, vertices, indices, morph_targets, .. } =
            &scene.asset().meshes[part.mesh].primitives[part.primitive];
        if *topology != Topology::Triangles {
            continue;
        }
        let wrong = |problem: &str| {
            let problem = format!("the fur '{name}' {problem}; submit its shells instanced or as draws");
            Err(RenderError::Option { option: "duplicated shells", problem })
        };
        if staging.instances[part.instance].skin.is_some() || !morph_targets.is_empty() {
            return wrong("is skinned or morphed, which moves one copy of its vertices");
        }
        if fur.inertia > 0.0 && options.animation.is_some() {
            return wrong("has inertia, which moves one copy of its vertices");
        }
        let layers = options.plan_options().layers_of(fur.layers) as usize;
        if vertices.positions.len().max(indices.len()).saturating_mul(layers) > u32::MAX as usize {
            return wrong("has more vertices or indices in all shells than 32 bits can count");
        }
    }
    Ok(())
}
