//! OpenEXR pictures (.exr), a block at a time.

use super::super::AssetError;
use super::super::context::Context;
use super::Reduction;
use ::exr::block::UncompressedBlock;
use ::exr::block::reader::ChunksReader;
use ::exr::meta::attribute::SampleType;
use ::exr::meta::header::Header;
use std::io::Cursor;

/// Where the light stands in a part of the file: red, green and blue, or one channel for all three.
struct Channels {
    /// Index of the part.
    part: usize,
    /// Indices of the channels.
    rgb: [usize; 3],
}

/// Whether the file starts as OpenEXR pictures do.
pub(super) fn is_exr(bytes: &[u8]) -> bool {
    bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01])
}

/// Decodes the largest level of the first part that has colour or luminance.
pub(super) fn decode(context: &Context, bytes: &[u8]) -> Result<Reduction, AssetError> {
    let broken = |source: ::exr::error::Error| {
        context.error("EXR", format_args!("does not decode ({source}); the file is damaged or cut off, copy it again"))
    };
    let reader = ::exr::block::read(Cursor::new(bytes), false).map_err(broken)?;
    let channels = find_channels(context, reader.headers())?;
    let header = &reader.headers()[channels.part];
    if header.deep {
        return Err(context.unsupported("EXR", "deep data"));
    }
    if header.channels.list.iter().any(|channel| channel.sampling.x() != 1 || channel.sampling.y() != 1) {
        return Err(context.unsupported("channels", "subsampling"));
    }
    let [width, height] = [header.layer_size.x(), header.layer_size.y()];
    let block = header.max_block_pixel_size();
    let texels_of_block = (block.x().min(width) as u64).saturating_mul(block.y().min(height) as u64);
    // A block as the file has it, decompressed, and as floats.
    let bytes_of_block = texels_of_block.saturating_mul(2 * header.channels.bytes_per_pixel as u64 + 12);
    let mut reduction = Reduction::new(context, [width as u64, height as u64], bytes_of_block)?;

    let layout = header.channels.clone();
    let kinds = channels.rgb.map(|channel| layout.list[channel].sample_type);
    let part = channels.part;
    let chunks = reader
        .filter_chunks(false, |_, tile, block| block.layer == part && tile.is_largest_resolution_level())
        .map_err(broken)?;
    let mut decompressor = chunks.sequential_decompressor(false);
    let mut texels_read = 0u64;
    while let Some(block) = decompressor.decompress_next_block() {
        let UncompressedBlock { index, data } = block.map_err(broken)?;
        let (columns, rows) = (index.pixel_size.x(), index.pixel_size.y());
        let mut texels = vec![[0f32; 3]; columns * rows];
        let block = UncompressedBlock { index, data };
        for line in block.lines(&layout) {
            let row = line.location.position.y().wrapping_sub(index.pixel_position.y());
            let Some(texels) = texels.get_mut(row.saturating_mul(columns)..).filter(|_| row < rows) else { continue };
            for (to, _) in channels.rgb.iter().enumerate().filter(|(_, from)| **from == line.location.channel) {
                texels.iter_mut().zip(samples(kinds[to], line.value)).for_each(|(texel, sample)| texel[to] = sample);
            }
        }
        for (row, texels) in texels.chunks_exact(columns.max(1)).enumerate() {
            reduction.add(index.pixel_position.x(), index.pixel_position.y() + row, texels);
        }
        texels_read += (columns * rows) as u64;
    }
    if texels_read != width as u64 * height as u64 {
        let problem =
            format!("{texels_read} of {} texels are there; copy the file again", width as u64 * height as u64);
        return Err(context.error("EXR", problem));
    }
    Ok(reduction)
}

/// Samples as floats, in the machine's order of bytes.
fn samples(kind: SampleType, bytes: &[u8]) -> Box<dyn Iterator<Item = f32> + '_> {
    match kind {
        SampleType::F16 => {
            Box::new(bytes.chunks_exact(2).map(|two| half::f16::from_ne_bytes([two[0], two[1]]).to_f32()))
        }
        SampleType::F32 => Box::new(bytes.chunks_exact(4).map(bytemuck::pod_read_unaligned::<f32>)),
        SampleType::U32 => Box::new(bytes.chunks_exact(4).map(|four| bytemuck::pod_read_unaligned::<u32>(four) as f32)),
    }
}

/// Plain R, G and B first, then those of a layer (`View Layer.Combined.R`), then luminance (Y).
fn find_channels(context: &Context, headers: &[Header]) -> Result<Channels, AssetError> {
    let mut found: Vec<(bool, String, Channels)> = Vec::new();
    for (part, header) in headers.iter().enumerate() {
        let names: Vec<String> = header.channels.list.iter().map(|channel| channel.name.to_string()).collect();
        let layer_of = |name: &str| name.rsplit_once('.').map_or(String::new(), |(layer, _)| format!("{layer}."));
        for layer in names.iter().map(|name| layer_of(name)) {
            let index = |channel: &str| {
                let wanted = format!("{layer}{channel}");
                names.iter().position(|name| name.eq_ignore_ascii_case(&wanted))
            };
            if let [Some(r), Some(g), Some(b)] = ["R", "G", "B"].map(index) {
                found.push((false, layer, Channels { part, rgb: [r, g, b] }));
            } else if let Some(y) = index("Y") {
                found.push((true, layer, Channels { part, rgb: [y; 3] }));
            }
        }
    }
    let names = || {
        let lists = headers.iter().flat_map(|header| &header.channels.list).map(|channel| channel.name.to_string());
        lists.take(8).collect::<Vec<_>>().join(", ")
    };
    found.sort_by(|a, b| (a.0, &a.1, a.2.part).cmp(&(b.0, &b.1, b.2.part)));
    let (is_grey, layer, channels) = found.into_iter().next().ok_or_else(|| {
        context
            .error("channels", format_args!("no R, G and B and no Y among {}; export the picture in colour", names()))
    })?;
    if !layer.is_empty() {
        context.warn("channels", format_args!("the light is taken from the layer `{}`", layer.trim_end_matches('.')));
    }
    if is_grey {
        context.warn("channels", "there is luminance alone; the light is grey");
    }
    Ok(channels)
}
