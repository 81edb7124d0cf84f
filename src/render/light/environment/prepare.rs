//! Environments and the table of lobes, computed on the device once and read back, so that what comes from the cache and
//! what was just made are the same bytes.
//!
//! In: an equirectangular picture. Out: a cube of prefiltered radiance, spherical harmonics, the table. Cost: in
//! [`EnvironmentQuality`]. Twin: `measure::twin::environment`.

use super::EnvironmentQuality;
use super::prepared::{PreparedEnvironment, SH_COEFFICIENTS};
use crate::asset::Environment;
use crate::gpu::{Buffer, Encoder, Gpu, GpuError, Memory, Resource, vk};
use crate::material::SheenTable;
use crate::shader::layout::{
    EnvironmentCubeDraw, EnvironmentHalveDraw, EnvironmentIrradianceDraw, EnvironmentLobesDraw,
    EnvironmentPrefilterDraw,
};
use crate::shader::{Defines, ShaderFile, ShaderKey};
use glam::{Vec3, Vec4};
use half::f16;

/// The shaders, whose words are part of what a cached result depends on.
pub(super) const SHADERS: [ShaderFile; 5] = [
    ShaderFile::EnvironmentCubeComp,
    ShaderFile::EnvironmentHalveComp,
    ShaderFile::EnvironmentPrefilterComp,
    ShaderFile::EnvironmentIrradianceComp,
    ShaderFile::EnvironmentLobesComp,
];
/// Sides of their workgroups.
const GROUP: u32 = 8;
/// Texels of the row sums' workgroups.
const ROWS_GROUP: u32 = 64;
/// Harmonics are summed over faces of this side: they turn little within such a texel.
const IRRADIANCE_FACE_PX: u32 = 128;
/// Directions of GGX that an entry of the table adds up.
const LOBE_SAMPLES: u32 = 2048;
/// Software devices take seconds.
const TIMEOUT_MS: u64 = 600_000;
/// What the largest radiance becomes: far from the end of half floats, and the smallest ones keep their digits.
pub(in crate::render) const LARGEST_TEXEL: f32 = 32_768.0;

/// Computes cube and harmonics.
///
/// # Errors
/// When the device is out of memory or lost.
pub(super) fn environment(
    gpu: &Gpu,
    environment: &Environment,
    quality: &EnvironmentQuality,
) -> Result<PreparedEnvironment, GpuError> {
    let (face_px, last_level) = quality.cube_of(environment);
    let texels_of = |levels: u32| (0..levels).map(|level| 6 * u64::from(face_px >> level).pow(2)).sum::<u64>();
    let all_levels = face_px.ilog2() + 1;
    let storage = |name, bytes| gpu.buffer(name, bytes, vk::BufferUsageFlags::STORAGE_BUFFER, Memory::Device);
    let words = environment.texels.as_flattened();
    let equirect = storage("environment picture", size_of_val(words) as u64)?;
    let cube = storage("environment cube", texels_of(all_levels) * 16)?;
    let prefiltered = storage("environment prefiltered", texels_of(last_level + 1) * 16)?;
    let summed = all_levels.saturating_sub(IRRADIANCE_FACE_PX.ilog2() + 1);
    let rows = 6 * (face_px >> summed);
    let row_sums = storage("environment row sums", u64::from(rows) * SH_COEFFICIENTS as u64 * 16)?;
    let harmonics = storage("environment harmonics", SH_COEFFICIENTS as u64 * 16)?;
    let mut upload = gpu.upload();
    upload.buffer(&equirect, 0, bytemuck::cast_slice(words));
    upload.finish()?;

    let groups = |level: u32| [(face_px >> level).div_ceil(GROUP), (face_px >> level).div_ceil(GROUP), 6];
    let mut encoder = gpu.encoder("environment")?;
    let [columns, picture_rows] = environment.size;
    let to_cube =
        Step::new(gpu, ShaderFile::EnvironmentCubeComp, &[], &[("EquirectTexels", &equirect), ("CubeTexels", &cube)])?;
    to_cube.record(
        &mut encoder,
        groups(0),
        // At least twice as fine as the picture.
        &EnvironmentCubeDraw {
            columns,
            rows: picture_rows,
            face_px,
            directions_a_side: 2 * columns.div_ceil(2 * face_px),
        },
    );
    let halve = Step::new(gpu, ShaderFile::EnvironmentHalveComp, &[], &[("CubeTexels", &cube)])?;
    for level in 1..all_levels {
        halve.record(&mut encoder, groups(level), &EnvironmentHalveDraw { face_px, level });
    }
    let buffers = [("CubeTexels", &cube), ("PrefilteredTexels", &prefiltered)];
    let prefilter = Step::new(gpu, ShaderFile::EnvironmentPrefilterComp, &[], &buffers)?;
    for level in 0..=last_level {
        let draw = EnvironmentPrefilterDraw { face_px, level, last_level, samples: quality.samples_of(level) };
        prefilter.record(&mut encoder, groups(level), &draw);
    }
    let buffers = [("CubeTexels", &cube), ("RowSums", &row_sums), ("HarmonicSums", &harmonics)];
    for (sum_rows, groups) in [(0, rows.div_ceil(ROWS_GROUP)), (1, 1)] {
        let constants = [("SUM_ROWS", sum_rows)];
        let step = Step::new(gpu, ShaderFile::EnvironmentIrradianceComp, &constants, &buffers)?;
        let draw = EnvironmentIrradianceDraw { face_px, level: summed };
        step.record(&mut encoder, [groups, SH_COEFFICIENTS as u32, 1], &draw);
    }
    let [texels, harmonics] = read_back(gpu, encoder, [&prefiltered, &harmonics])?;
    Ok(pack(face_px, last_level, &texels, &harmonics))
}

/// Computes the texels of the table of lobes, half floats: sheet under sheet, roughness downwards, cosines to the right.
///
/// # Errors
/// When the device is out of memory or lost.
pub(super) fn lobes(gpu: &Gpu, quality: &EnvironmentQuality) -> Result<Vec<u8>, GpuError> {
    let nodes = quality.table_px;
    let storage = |name, bytes| gpu.buffer(name, bytes, vk::BufferUsageFlags::STORAGE_BUFFER, Memory::Device);
    let sheen: Vec<[f32; 4]> = SheenTable::shipped().texels().collect();
    let nodes_of_sheen = storage("sheen nodes", size_of_val(&sheen[..]) as u64)?;
    let entries = storage("lobe entries", u64::from(nodes * nodes * EnvironmentQuality::TABLE_SHEETS) * 16)?;
    let mut upload = gpu.upload();
    upload.buffer(&nodes_of_sheen, 0, bytemuck::cast_slice(&sheen));
    upload.finish()?;
    let mut encoder = gpu.encoder("lobes")?;
    let buffers = [("SheenNodes", &nodes_of_sheen), ("LobeEntries", &entries)];
    let step = Step::new(gpu, ShaderFile::EnvironmentLobesComp, &[], &buffers)?;
    let groups = nodes.div_ceil(GROUP);
    step.record(
        &mut encoder,
        [groups, groups, EnvironmentQuality::TABLE_SHEETS],
        &EnvironmentLobesDraw { nodes, samples: LOBE_SAMPLES },
    );
    let [entries] = read_back(gpu, encoder, [&entries])?;
    Ok(entries.iter().flat_map(|entry| halves(*entry)).collect())
}

/// One shader with its buffers.
struct Step {
    name: &'static str,
    pipeline: crate::gpu::Pipeline,
    group: crate::gpu::BindGroup,
}

impl Step {
    fn new(
        gpu: &Gpu,
        file: ShaderFile,
        constants: &[(&str, u32)],
        buffers: &[(&str, &Buffer)],
    ) -> Result<Self, GpuError> {
        let shader = ShaderKey::new(file, Defines::NONE).shader();
        let pipeline = gpu.compute_pipeline(shader.name, shader, constants)?;
        let resources: Vec<_> = buffers.iter().map(|(name, buffer)| (*name, Resource::Buffer(buffer))).collect();
        let group = gpu.bind_group(&pipeline, 0, shader.name, &resources)?;
        Ok(Self { name: shader.name, pipeline, group })
    }

    fn record<T: bytemuck::NoUninit>(&self, encoder: &mut Encoder, groups: [u32; 3], draw: &T) {
        encoder.compute_pass(self.name, &[], |pass| {
            pass.pipeline(&self.pipeline);
            pass.bind(0, &self.group);
            pass.push(draw);
            pass.dispatch(groups);
        });
    }
}

/// Submits, waits, and gives what the buffers then hold.
fn read_back<const N: usize>(gpu: &Gpu, mut encoder: Encoder, from: [&Buffer; N]) -> Result<[Vec<Vec4>; N], GpuError> {
    let mut backs = Vec::with_capacity(N);
    for buffer in from {
        let back = gpu.buffer(buffer.name(), buffer.bytes(), vk::BufferUsageFlags::empty(), Memory::Readback)?;
        encoder.copy_buffer(buffer, &back);
        backs.push(back);
    }
    encoder.submit()?.wait(TIMEOUT_MS)?;
    let mut read = [const { Vec::new() }; N];
    for (read, back) in read.iter_mut().zip(&backs) {
        *read = back.read::<Vec4>()?;
    }
    Ok(read)
}

/// Divides by the largest radiance of each channel, so that half floats hold it and a constant stays exact.
fn pack(face_px: u32, last_level: u32, texels: &[Vec4], harmonics: &[Vec4]) -> PreparedEnvironment {
    let largest = texels.iter().fold(Vec3::ZERO, |largest, texel| largest.max(texel.truncate()));
    let scale =
        Vec3::from_array(largest.to_array().map(|channel| if channel > 0.0 { channel / LARGEST_TEXEL } else { 1.0 }));
    let mut rest = texels;
    let levels = (0..=last_level).map(|level| {
        let (own, others) = rest.split_at(6 * (face_px as usize >> level).pow(2));
        rest = others;
        own.iter().flat_map(|texel| halves((texel.truncate() / scale).extend(1.0))).collect()
    });
    let levels = levels.collect();
    let harmonics = std::array::from_fn(|index| harmonics[index].truncate());
    PreparedEnvironment { face_px, levels, scale, harmonics }
}

/// Little-endian half floats.
pub(in crate::render) fn halves(texel: Vec4) -> [u8; 8] {
    let mut bytes = [0; 8];
    for (bytes, value) in bytes.chunks_exact_mut(2).zip(texel.to_array()) {
        bytes.copy_from_slice(&f16::from_f32(value).to_le_bytes());
    }
    bytes
}
