//! Rows of a picture, shared out among threads.

use super::bundle::Bundle;
use super::integrate::{Integrate, State};
use super::interpolate::{Along, Field};
use super::nodes;
use super::number::{Number, Sample};
use super::row::Row;
use super::span::{Frame, Span};
use super::table::Table;
use super::way::Way;
use super::{Picture, Precision, RaycastError, Raycaster};
use crate::image::Image;
use crate::parallel;
use crate::real::lanes::{MOST, Width};
use crate::volume::{Samples, TransferFunction};
use std::sync::{Mutex, PoisonError};

/// Samples that are interpolated before they are integrated, of all lanes together: few enough for a processor's first cache.
const BLOCK: usize = 4096;

pub(super) fn render(
    raycaster: &Raycaster<'_>,
    frame: &Frame,
    transfer: &TransferFunction,
) -> Result<Picture, RaycastError> {
    match (raycaster.precision, &raycaster.grid.samples) {
        (Precision::Binary32, Samples::F32(samples)) => {
            with::<f32, f32>(raycaster, frame, transfer, samples)
        }
        (Precision::Binary32, Samples::F64(samples)) => {
            with::<f32, f64>(raycaster, frame, transfer, samples)
        }
        (Precision::Binary64, Samples::F32(samples)) => {
            with::<f64, f32>(raycaster, frame, transfer, samples)
        }
        (Precision::Binary64, Samples::F64(samples)) => {
            with::<f64, f64>(raycaster, frame, transfer, samples)
        }
    }
}

fn with<T: Number, S: Sample>(
    raycaster: &Raycaster<'_>,
    frame: &Frame,
    transfer: &TransferFunction,
    samples: &[S],
) -> Result<Picture, RaycastError> {
    let [width, height] = raycaster.size;
    let channels = transfer.channels.len();
    let field = Field {
        samples,
        dimensions: raycaster.grid.dimensions,
        interpolation: raycaster.interpolation,
    };
    let mut image = Image::new(width, height, transfer.channels.clone());
    let rows = image.values.chunks_exact_mut(width * channels);
    let rows: Vec<_> = rows
        .enumerate()
        .map(|(y, row)| (y, Mutex::new(row)))
        .collect();
    let way = Way::of(&raycaster.method);
    let hits = parallel::try_map(&rows, |(y, row)| {
        let mut values = row.lock().unwrap_or_else(PoisonError::into_inner);
        let spans: Vec<_> = (0..width).map(|x| span(raycaster, frame, x, *y)).collect();
        let mut row = Row {
            spans: &spans,
            values: &mut values,
            channels,
        };
        match way {
            Some(way) => {
                in_lanes::<T, S>(raycaster, way, field, transfer, &mut row);
                Ok(())
            }
            None => nodes::one_by_one::<T, S>(raycaster, field, transfer, &mut row),
        }
        .map(|()| spans.iter().flatten().count())
    })?;
    drop(rows);
    Ok(Picture {
        image,
        hits: hits.iter().sum(),
    })
}

fn span(raycaster: &Raycaster<'_>, frame: &Frame, x: usize, y: usize) -> Option<Span> {
    let middle = [x as f64 + 0.5, y as f64 + 0.5];
    frame.span(&raycaster.camera.ray(raycaster.size, middle)?)
}

/// All channels of a row, up to four at a time.
fn in_lanes<T: Number, S: Sample>(
    raycaster: &Raycaster<'_>,
    way: Way,
    field: Field<'_, S>,
    transfer: &TransferFunction,
    row: &mut Row<'_>,
) {
    let mut channel = 0;
    while channel < row.channels {
        match row.channels - channel {
            1 => channels::<T, S, 1>(raycaster, way, field, transfer, row, channel),
            2 | 3 => channels::<T, S, 3>(raycaster, way, field, transfer, row, channel),
            _ => channels::<T, S, 4>(raycaster, way, field, transfer, row, channel),
        }
        channel += 4;
    }
}

fn channels<T: Number, S: Sample, const C: usize>(
    raycaster: &Raycaster<'_>,
    way: Way,
    field: Field<'_, S>,
    transfer: &TransferFunction,
    row: &mut Row<'_>,
    first_channel: usize,
) {
    let Some(table) = Table::<T, C>::new(transfer, first_channel) else {
        return;
    };
    let width = Width::current();
    let lanes = usize::from(width.lanes());
    let mut block = [T::ZERO; BLOCK];
    let pixels = row.values.chunks_mut(lanes * row.channels);
    for (spans, pixels) in row.spans.chunks(lanes).zip(pixels) {
        let mut rays = [None; MOST];
        for (ray, span) in rays.iter_mut().zip(spans) {
            *ray = span.map(|span| (span, span.cut(raycaster.step, raycaster.last_step)));
        }
        let rays = Bundle::new(&rays);
        let mut state = State::new();
        let samples = if rays.segments == 0 {
            0
        } else {
            way.samples(rays.segments)
        };
        for first in (0..samples).step_by(BLOCK / lanes) {
            let count = (samples - first).min(BLOCK / lanes);
            let values = block.get_mut(..count * lanes).unwrap_or_default();
            width.with(Along {
                field,
                rays: &rays,
                first,
                offset: way.offset(),
                values: &mut *values,
            });
            width.with(Integrate {
                way,
                table: &table,
                rays: &rays,
                first,
                values,
                state: &mut state,
            });
        }
        let pixels = pixels.chunks_exact_mut(row.channels).enumerate();
        // Lanes whose rays miss the box have gone along with the others, and are black.
        for ((lane, pixel), _) in pixels.zip(spans).filter(|(_, span)| span.is_some()) {
            let channels = pixel.iter_mut().skip(first_channel);
            for (value, radiance) in channels.zip(&state.radiance) {
                *value = radiance.get(lane).map_or(0.0, |radiance| radiance.wide());
            }
        }
    }
}
