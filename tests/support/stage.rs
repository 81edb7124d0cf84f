//! Small scenes for checks: every object, light and camera is a root node.

use glam::{DVec3, Mat3, Quat, Vec2, Vec3, Vec4};
use vair::asset::{
    Asset, AssetScene, Camera, Image, Light, LightKind, Material, Mesh, Node, Primitive, Projection, Sampler, Texture,
    TextureRef, Transform, Vertices,
};
use vair::render::{FrameOptions, Shadows, Tonemap};
use vair::scene::{CameraChoice, EnvironmentLight, Scene};

/// Depth of the front camera before the XY plane, metres; it sees as far behind it.
const FRONT_M: f32 = 50.0;

/// Shows texels as they are.
pub const NEAREST: Sampler =
    Sampler { wrap: [vair::asset::Wrap::Repeat; 2], mag_linear: false, min_linear: false, mip_linear: None };

/// A scene in the making.
#[derive(Default)]
pub struct Stage {
    /// What stands there.
    pub asset: Asset,
}

impl Stage {
    /// Seen by an orthographic camera along -Z that shows `half_m` above and below the origin, and lit by its surroundings
    /// alone.
    pub fn front(half_m: f32) -> Self {
        let mut stage = Self::default();
        stage.parallel_camera(half_m, Vec3::Z, Vec3::Y);
        stage
    }

    /// An orthographic camera that looks at the origin, picture number 0.
    pub fn parallel_camera(&mut self, half_m: f32, backwards: Vec3, up: Vec3) {
        let (near_m, far_m) = (1.0, 2.0 * FRONT_M - 1.0);
        // Half the width is the least that is shown: the picture's aspect decides.
        let projection = Projection::Orthographic { half_width_m: half_m * 1e-3, half_height_m: half_m, near_m, far_m };
        self.camera(projection, backwards.normalize() * FRONT_M, backwards, up);
    }

    /// A camera whose picture shows what lies against `backwards`.
    pub fn camera(&mut self, projection: Projection, eye: Vec3, backwards: Vec3, up: Vec3) {
        let axes = camera_axes(backwards, up);
        self.asset.cameras.push(Camera { name: None, projection });
        let transform =
            Transform::Trs { translation: eye, rotation: Quat::from_mat3(&axes).normalize(), scale: Vec3::ONE };
        let camera = Some(self.asset.cameras.len() - 1);
        self.asset.nodes.push(Node { camera, transform, ..Node::default() });
    }

    /// A light; `to_light` is a unit vector against its axis.
    pub fn light(&mut self, kind: LightKind, intensity: Vec3, position: Vec3, to_light: Vec3) {
        self.asset.lights.push(Light { name: None, color: intensity, intensity: 1.0, kind });
        let rotation = Quat::from_mat3(&camera_axes(to_light, Vec3::new(0.1, 0.9, 0.3))).normalize();
        let transform = Transform::Trs { translation: position, rotation, scale: Vec3::ONE };
        let light = Some(self.asset.lights.len() - 1);
        self.asset.nodes.push(Node { light, transform, ..Node::default() });
    }

    /// A material.
    pub fn material(&mut self, material: Material) -> usize {
        self.asset.materials.push(material);
        self.asset.materials.len() - 1
    }

    /// An image and a texture of it; `rgba` row by row from the top.
    pub fn texture(&mut self, size: [u32; 2], rgba: &[[u8; 4]], sampler: Sampler) -> TextureRef {
        assert_eq!(rgba.len() as u32, size[0] * size[1], "texels of a {size:?} image");
        let name = format!("image {}", self.asset.images.len());
        self.asset.images.push(Image { name, width: size[0], height: size[1], rgba: rgba.as_flattened().to_vec() });
        self.asset.textures.push(Texture { image: self.asset.images.len() - 1, sampler });
        let texture = self.asset.textures.len() - 1;
        TextureRef { texture, uv_set: 0, offset: Vec2::ZERO, rotation: 0.0, scale: Vec2::ONE }
    }

    /// A texture of one texel.
    pub fn texel(&mut self, rgba: [u8; 4]) -> TextureRef {
        self.texture([1, 1], &[rgba], NEAREST)
    }

    /// A mesh of one primitive at a node, whose index comes back.
    pub fn object(&mut self, primitive: Primitive, material: usize, transform: Transform) -> usize {
        let weights = vec![0.0; primitive.morph_targets.len()];
        self.asset.meshes.push(Mesh { name: None, primitives: vec![Primitive { material, ..primitive }], weights });
        let mesh = Some(self.asset.meshes.len() - 1);
        self.asset.nodes.push(Node { mesh, transform, ..Node::default() });
        self.asset.nodes.len() - 1
    }

    /// The scene, all nodes without a parent being its roots.
    pub fn scene(mut self) -> Scene {
        let children: Vec<usize> = self.asset.nodes.iter().flat_map(|node| node.children.clone()).collect();
        let roots = (0..self.asset.nodes.len()).filter(|node| !children.contains(node)).collect();
        self.asset.scenes.push(AssetScene { name: None, roots });
        Scene::from_asset(self.asset).unwrap_or_else(|error| panic!("{error}"))
    }
}

/// Right, up, backwards.
pub fn camera_axes(backwards: Vec3, up: Vec3) -> Mat3 {
    let backwards = backwards.normalize();
    let right = up.cross(backwards).normalize();
    Mat3::from_cols(right, backwards.cross(right), backwards)
}

/// Radiance from everywhere on every stage.
pub const AMBIENT: f32 = 0.05;

/// A picture of the first camera, linear and unexposed, without shadows: what is computed beside it knows none, and swatches
/// stand closely.
pub fn options(size: [u32; 2], msaa: u32) -> FrameOptions {
    let environment = EnvironmentLight::constant(Vec3::splat(AMBIENT));
    let camera = CameraChoice::Index(0);
    let shadows = Shadows { are_cast: false, ..Shadows::default() };
    FrameOptions { size, msaa, camera, tonemap: Tonemap::None, environment, shadows, ..FrameOptions::default() }
}

/// A rectangle in the XY plane that faces +Z, uv (0, 0) at its top left.
pub fn quad(half_width_m: f32, half_height_m: f32) -> Primitive {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let vertices = Vertices {
        positions: corners.iter().map(|&(x, y)| Vec3::new(x * half_width_m, y * half_height_m, 0.0)).collect(),
        normals: vec![Vec3::Z; 4],
        tangents: vec![Vec4::new(1.0, 0.0, 0.0, 1.0); 4],
        uv_sets: vec![corners.iter().map(|&(x, y)| Vec2::new(0.5 + 0.5 * x, 0.5 - 0.5 * y)).collect()],
        ..Vertices::default()
    };
    Primitive { indices: vec![0, 1, 2, 0, 2, 3], vertices, ..Primitive::default() }
}

/// A transform that moves.
pub fn at(translation: Vec3) -> Transform {
    Transform::Trs { translation, rotation: Quat::IDENTITY, scale: Vec3::ONE }
}

/// A smooth white dielectric without textures.
pub fn plain() -> Material {
    Material { metallic: 0.0, ..Material::default() }
}

/// Shows its base colour without light.
pub fn unlit(color: Vec4) -> Material {
    Material { base_color: color, unlit: true, ..plain() }
}

/// World position in the XY plane of a pixel's middle, for [`Stage::front`].
pub fn front_position(pixel: [u32; 2], size: [u32; 2], half_m: f64) -> DVec3 {
    let [x, y] = [0, 1].map(|axis| (f64::from(pixel[axis]) + 0.5) / f64::from(size[axis]) * 2.0 - 1.0);
    let aspect = f64::from(size[0]) / f64::from(size[1]);
    DVec3::new(x * half_m * aspect, -y * half_m, 0.0)
}
