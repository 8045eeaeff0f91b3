//! OpenEXR of one part: half, binary32 and UINT are read, binary32 in scan lines is written.

use super::single;
use crate::binary::{Memory, Trouble, product, refused};
use crate::image::Image;
use exr::error::Error;
use exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image as Exr, Layer};
use exr::meta::MetaData;
use exr::prelude::{
    LayerAttributes, ReadChannels, ReadLayers, SmallVec, Vec2, WritableImage, read as reading,
};
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufReader, Cursor};
use std::path::Path;

/// What is small in an [`Image`], and capital in a file, as other programs have it; in the order of an image.
const KNOWN: [(&str, &str); 5] = [("y", "Y"), ("r", "R"), ("g", "G"), ("b", "B"), ("a", "A")];

pub(super) fn read(path: &Path, memory: Memory) -> Result<(Image, Option<f64>), Trouble> {
    // The header alone, so that nothing is taken that does not fit.
    let meta =
        MetaData::read_from_buffered(BufReader::new(File::open(path)?), false).map_err(trouble)?;
    let [header] = meta.headers.as_slice() else {
        return Err(refused(format!("{} parts", meta.headers.len()), "one"));
    };
    if header.deep {
        return Err(refused("deep data", "one value a pixel and channel"));
    }
    let window = header.shared_attributes.display_window;
    let at = header.own_attributes.layer_position;
    if window.position != at || window.size != header.layer_size {
        let shown = |at: Vec2<i32>, size: Vec2<usize>| {
            format!("({}, {}) with {} x {}", at.x(), at.y(), size.x(), size.y())
        };
        return Err(refused(
            format!(
                "a data window from {} pixels in a display window from {}",
                shown(at, header.layer_size),
                shown(window.position, window.size),
            ),
            "the same window for both; programs crop, pad or move others",
        ));
    }
    let (width, height) = (header.layer_size.x(), header.layer_size.y());
    let channels = &header.channels.list;
    if let Some(channel) = channels
        .iter()
        .find(|channel| channel.sampling != Vec2(1, 1))
    {
        return Err(refused(
            format!("the channel {} of fewer pixels", channel.name),
            "a value a pixel",
        ));
    }
    let count = product(&[width, height, channels.len()])?;
    memory.check(count, 2 * size_of::<f64>())?;
    let mut values: Vec<f64> = memory.array(count)?;
    let image = reading()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .non_parallel()
        .from_buffered(BufReader::new(File::open(path)?))
        .map_err(trouble)?;
    let layer = image.layer_data.first();
    let mut list: Vec<(String, &FlatSamples)> = layer
        .iter()
        .flat_map(|layer| &layer.channel_data.list)
        .map(|channel| (small(&channel.name.to_string()), &channel.sample_data))
        .collect();
    list.sort_by_key(|(name, _)| (rank(name), name.clone()));
    let names: BTreeSet<_> = list.iter().map(|(name, _)| name.clone()).collect();
    if names.len() < list.len() {
        return Err(refused(
            "channels whose names differ in capitals alone",
            "r or R, not both",
        ));
    }
    if list
        .iter()
        .any(|(_, samples)| samples.len() != width * height)
    {
        return Err(refused("a channel of another size", "a value a pixel"));
    }
    for pixel in 0..width * height {
        for (_, samples) in &list {
            values.push(match samples {
                FlatSamples::F16(samples) => samples[pixel].to_f64(),
                FlatSamples::F32(samples) => f64::from(samples[pixel]),
                FlatSamples::U32(samples) => f64::from(samples[pixel]),
            });
        }
    }
    let image = Image {
        width,
        height,
        channels: list.into_iter().map(|(name, _)| name).collect(),
        values,
    };
    Ok((image, None))
}

/// Where a channel stands in an image: known ones first.
fn rank(name: &str) -> usize {
    KNOWN
        .iter()
        .position(|(small, _)| *small == name)
        .unwrap_or(KNOWN.len())
}

fn small(name: &str) -> String {
    let known = KNOWN.iter().find(|(_, capital)| *capital == name);
    known.map_or(name, |(small, _)| small).to_owned()
}

fn capital(name: &str) -> &str {
    let known = KNOWN.iter().find(|(small, _)| *small == name);
    known.map_or(name, |(_, capital)| capital)
}

/// The file, in memory: its offsets are known last and stand first.
pub(super) fn bytes(image: &Image) -> Result<Vec<u8>, Trouble> {
    let many = image.channels.len();
    let mut names = BTreeSet::new();
    let mut list = SmallVec::new();
    for (i, name) in image.channels.iter().enumerate() {
        let text = exr::meta::attribute::Text::new_or_none(capital(name));
        let text = text.filter(|_| !name.is_empty() && names.insert(capital(name)));
        let text = text.ok_or_else(|| {
            refused(
                format!("the channel '{}'", name.escape_debug()),
                "names of Latin letters, each once",
            )
        })?;
        let samples: Result<Vec<f32>, Trouble> = image
            .values
            .iter()
            .skip(i)
            .step_by(many)
            .map(|&value| single(value))
            .collect();
        list.push(AnyChannel::new(text, FlatSamples::F32(samples?)));
    }
    let layer = Layer::new(
        (image.width, image.height),
        LayerAttributes::default(),
        Encoding::SMALL_LOSSLESS,
        AnyChannels::sort(list),
    );
    let mut bytes = Cursor::new(Vec::new());
    Exr::from_layer(layer)
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .map_err(trouble)?;
    Ok(bytes.into_inner())
}

fn trouble(error: Error) -> Trouble {
    match error {
        Error::Io(error) => error.into(),
        other => refused(
            other.to_string(),
            "an OpenEXR of one part of half, float or UINT, whole",
        ),
    }
}
