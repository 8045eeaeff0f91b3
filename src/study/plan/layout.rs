//! A scene in a format, and the places where its models look.

use super::PlanError;
use crate::quadrature::{Collocation, collocation};
use crate::real::{Format, Native, row};
use crate::scene::{BoundPiece, Columns, Medium, Piece, Scene};
use rug::Rational;
use std::cell::Cell;
use std::ops::Range;
use std::sync::Arc;

/// The most work of a plan in one format, in products of binary64: a minute or so.
const MAX_WORK: u64 = 30_000_000_000;
/// How many products a number of the medium costs, and a product of MPFR for every 64 bits.
const OF_A_POINT: u64 = 32;
const OF_MPFR: u64 = 16;

/// A scene with its constants in a format.
pub(super) struct Layout<'s, F: Format> {
    pub(super) format: F,
    pub(super) channels: usize,
    /// What was done so far, in products of binary64.
    work: Cell<u64>,
    media: Vec<Vec<Laid<'s, F>>>,
}

/// A piece, where it ends in binary64, and its numbers in the format.
struct Laid<'s, F: Format> {
    to: f64,
    piece: BoundPiece<'s, F>,
}

/// A stretch of a medium.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Stretch {
    pub(super) medium: usize,
    /// The pieces that it has parts of.
    pub(super) pieces: Range<usize>,
    pub(super) from: Rational,
    pub(super) to: Rational,
}

impl Stretch {
    pub(super) fn length(&self) -> Rational {
        Rational::from(&self.to - &self.from)
    }

    /// The piece that all of it lies in.
    pub(super) fn only_piece<'s>(&self, scene: &'s Scene) -> Option<&'s Piece> {
        let medium: &Medium = scene.media().get(self.medium)?;
        match medium.pieces.get(self.pieces.clone())? {
            [piece] => Some(piece),
            _ => None,
        }
    }
}

/// The values of a stretch at the points of a rule.
pub(super) struct Looked<R> {
    pub(super) table: Arc<Collocation<R>>,
    pub(super) columns: Columns<R>,
    pub(super) length: R,
}

impl<'s, F: Format> Layout<'s, F> {
    pub(super) fn new(scene: &'s Scene, format: F) -> Self {
        let laid = |piece: &'s Piece| Laid {
            to: Native::<f64>::new().ratio(&piece.to),
            piece: BoundPiece::new(piece, format),
        };
        let media = scene.media().iter();
        Layout {
            format,
            channels: scene.channels().len(),
            work: Cell::new(0),
            media: row(media.map(|medium| row(medium.pieces.iter().map(laid)))),
        }
    }

    /// Takes what some products of numbers of the format cost from what a plan may.
    pub(super) fn spend(&self, products: u64) -> Result<(), PlanError> {
        let weight = match self.format.bits() {
            ..=64 => 1,
            bits => OF_MPFR * u64::from(bits / 64),
        };
        let work = self
            .work
            .get()
            .saturating_add(products.saturating_mul(weight));
        self.work.set(work);
        if work > MAX_WORK {
            return Err(PlanError::Work { work: MAX_WORK });
        }
        Ok(())
    }

    /// C and τ of a stretch at that many points.
    ///
    /// To which piece a point belongs is told in binary64, so that it is the same in every format.
    pub(super) fn look(
        &self,
        stretch: &Stretch,
        points: u32,
    ) -> Result<Looked<F::Real>, PlanError> {
        // The medium at every point, and the depth at each from the values at all.
        let of_points = u64::from(points) * (u64::from(points) + OF_A_POINT);
        self.spend(of_points * self.channels as u64)?;
        let table = collocation(points, self.format)?;
        let (from, length) = (
            self.format.ratio(&stretch.from),
            self.format.ratio(&stretch.length()),
        );
        let lambda = row(table.nodes.iter().map(|x| x.clone() * &length + &from));
        let mut columns = Columns::new(self.channels);
        let pieces = self
            .media
            .get(stretch.medium)
            .and_then(|pieces| pieces.get(stretch.pieces.clone()))
            .unwrap_or_default();
        let mut begin = 0;
        if let [_, .., last] = pieces {
            let native = Native::<f64>::new();
            let places = collocation(points, native)?;
            let start: f64 = native.ratio(&stretch.from);
            let width: f64 = native.ratio(&stretch.length());
            let last: *const Laid<'_, F> = last;
            for laid in pieces {
                let inside = |x: &f64| start + x * width < laid.to;
                let end = if std::ptr::eq(laid, last) {
                    lambda.len()
                } else {
                    places.nodes.partition_point(inside).max(begin)
                };
                laid.piece.evaluate(&lambda[begin..end], &mut columns);
                begin = end;
            }
        } else if let [only] = pieces {
            only.piece.evaluate(&lambda, &mut columns);
        }
        Ok(Looked {
            table,
            columns,
            length,
        })
    }

    /// The piece, in the format.
    pub(super) fn piece(&self, stretch: &Stretch) -> Option<&BoundPiece<'s, F>> {
        let pieces = self.media.get(stretch.medium)?;
        Some(&pieces.get(stretch.pieces.start)?.piece)
    }
}
