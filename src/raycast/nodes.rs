//! Any method of the crate on one ray.

use super::bundle::Bundle;
use super::interpolate::{Along, Field};
use super::number::{Number, Sample};
use super::row::Row;
use super::span::{Span, Steps};
use super::table::{Table, Values};
use super::{RaycastError, Raycaster};
use crate::case::{AnyNodes, Column, Nodes, PolynomialTransfer, Transfer};
use crate::method::{Method, MethodError};
use crate::real::lanes::{LaneFormat, LaneReal, Width};
use crate::real::row;
use crate::volume::TransferFunction;
use rug::Rational;
use std::fmt;
use std::sync::Arc;

/// Methods take every number of segments within so many of any.
const WITHIN: u64 = 256;

/// The least number of segments, n or more, that the method takes.
pub(super) fn segments(method: &Method, n: u64) -> Result<u64, MethodError> {
    let allowed = |n: &u64| method.check_segments(*n).is_ok();
    let found = (n..n.saturating_add(WITHIN)).find(allowed);
    found.map_or_else(|| method.check_segments(n).map(|()| n), Ok)
}

/// Every pixel of a row, channel by channel.
pub(super) fn one_by_one<T: Number, S: Sample>(
    raycaster: &Raycaster<'_>,
    field: Field<'_, S>,
    transfer: &TransferFunction,
    row: &mut Row<'_>,
) -> Result<(), RaycastError> {
    for channel in 0..row.channels {
        let Some(table) = Table::<T, 1>::new(transfer, channel) else {
            continue;
        };
        let pixels = row.values.chunks_exact_mut(row.channels);
        for (span, pixel) in row.spans.iter().zip(pixels) {
            let Some(span) = span else { continue };
            let steps = span.cut(raycaster.step, raycaster.last_step);
            let n = segments(&raycaster.method, steps.count as u64)?;
            let nodes = RayNodes {
                field,
                span: *span,
                length: Rational::from_f64(span.length).unwrap_or_default(),
                table: &table,
            };
            let radiance = raycaster.method.radiance_of_any(AnyNodes::new(&nodes), n)?;
            if let Some(value) = pixel.get_mut(channel) {
                *value = radiance.0.wide();
            }
        }
    }
    Ok(())
}

/// One ray in one channel. Places are those of rays in lanes; behind the box the field is held.
struct RayNodes<'r, T, S> {
    field: Field<'r, S>,
    span: Span,
    length: Rational,
    table: &'r Table<T, 1>,
}

impl<T, S> fmt::Debug for RayNodes<'_, T, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.span.fmt(f)
    }
}

impl<T: Number, S: Sample> RayNodes<'_, T, S> {
    /// The field in the first `count` segments of such steps, at a part of each.
    fn fields(&self, steps: Steps, offset: f64, count: u64) -> Vec<T> {
        let mut values = vec![T::ZERO; usize::try_from(count).unwrap_or(0)];
        Width::One.with(Along {
            field: self.field,
            rays: &Bundle::new(&[Some((self.span, steps))]),
            first: 0,
            offset,
            values: &mut values,
        });
        values
    }

    /// The field at λ.
    fn at(&self, lambda: f64) -> T {
        let steps = Steps {
            count: 1,
            step: lambda,
            end: 1.0,
        };
        let field = self.fields(steps, 1.0, 1);
        field.first().copied().unwrap_or_else(T::nan)
    }

    fn column(&self, fields: Vec<T>) -> Arc<Column<LaneReal<T>>> {
        let transfers = row(fields.iter().map(|field| self.transfer(&LaneReal(*field))));
        Arc::new(Column {
            emission: row(transfers.iter().map(|transfer| transfer.emission)),
            extinction: row(transfers.iter().map(|transfer| transfer.extinction)),
            field: row(fields.into_iter().map(LaneReal)),
        })
    }

    fn cut(&self, n: u64) -> Steps {
        self.span.cut_evenly(usize::try_from(n).unwrap_or(1))
    }
}

impl<T: Number, S: Sample> Nodes for RayNodes<'_, T, S> {
    type Format = LaneFormat<T>;

    fn format(&self) -> LaneFormat<T> {
        LaneFormat::new()
    }

    fn length(&self) -> &Rational {
        &self.length
    }

    fn boundaries(&self, n: u64) -> Arc<Column<LaneReal<T>>> {
        self.column(self.fields(self.cut(n), 0.0, n + 1))
    }

    fn march(&self, n: u64) -> impl Iterator<Item = Transfer<LaneReal<T>>> {
        let fields = self.fields(self.cut(n), 0.0, n + 1).into_iter();
        fields.map(|field| self.transfer(&LaneReal(field)))
    }

    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<LaneReal<T>>> {
        self.column(self.fields(self.cut(n), offset.to_f64(), n))
    }

    fn beyond(&self, n: u64) -> LaneReal<T> {
        LaneReal(self.at(self.span.length * ((n + 1) as f64 / n as f64)))
    }

    fn extinction_at(&self, lambda: &LaneReal<T>) -> LaneReal<T> {
        self.transfer(&LaneReal(self.at(lambda.0.wide())))
            .extinction
    }

    fn transfer(&self, s: &LaneReal<T>) -> Transfer<LaneReal<T>> {
        let Values {
            extinction,
            emission: [emission],
        } = self.table.at(s.0);
        Transfer {
            emission: LaneReal(emission),
            extinction: LaneReal(extinction),
        }
    }

    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        None
    }
}
