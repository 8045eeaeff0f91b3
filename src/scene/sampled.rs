//! Media of sampled data, cut wherever what is interpolated has a kink or a jump.

use super::classify::form;
use super::expression;
use super::table::TransferTable;
use super::{Form, Interpolation, Piece, SceneProblem, Values};
use crate::case::Transfer;
use crate::symbolic::Expr;
use rug::Rational;

/// More pieces are no ray of a scene.
const MAX_PIECES: usize = 1 << 17;

/// C and τ of the field.
pub(super) enum OfField {
    /// By expressions of `s`, by channel.
    Formulas(Vec<Transfer<Expr>>),
    /// By a table.
    Table(TransferTable, Interpolation),
}

/// The pieces of equidistant samples, the first at the front and the last at the back of a stretch of the ray.
pub(super) fn cut(
    samples: &[Rational],
    between: Interpolation,
    of_field: &OfField,
    from: &Rational,
    to: &Rational,
) -> Result<expression::Cut, SceneProblem> {
    let mut all = expression::Cut {
        pieces: Vec::new(),
        blur: 0.0,
        unproved: Vec::new(),
    };
    let knots = match of_field {
        OfField::Table(table, lookup) => table.knots(*lookup),
        OfField::Formulas(_) => Vec::new(),
    };
    for cell in cells(samples, between, from, to) {
        match of_field {
            OfField::Table(table, lookup) => {
                all.pieces.extend(table.pieces(&cell, *lookup, &knots));
            }
            OfField::Formulas(formulas) => {
                let part = cell.by_formulas(formulas)?;
                all.blur += part.blur;
                for note in part.unproved {
                    if !all.unproved.contains(&note) {
                        all.unproved.push(note);
                    }
                }
                all.pieces.extend(part.pieces);
            }
        }
        if all.pieces.len() > MAX_PIECES {
            return Err(SceneProblem::TooManyPieces { limit: MAX_PIECES });
        }
    }
    all.pieces = joined(all.pieces);
    Ok(all)
}

/// A stretch on which the field is linear.
struct Cell {
    from: Rational,
    to: Rational,
    front: Rational,
    back: Rational,
}

/// The stretches on which the interpolated field is linear.
fn cells(
    samples: &[Rational],
    between: Interpolation,
    from: &Rational,
    to: &Rational,
) -> Vec<Cell> {
    let last = samples.len().saturating_sub(1).max(1);
    let spacing = Rational::from(to - from) / last as u64;
    let place = |halves: usize| Rational::from(&spacing * halves as u64) / 2_u32 + from;
    match between {
        Interpolation::Linear => {
            let pairs = samples.windows(2).enumerate();
            pairs
                .filter_map(|(i, pair)| match pair {
                    [front, back] => Some(Cell {
                        from: place(2 * i),
                        to: place(2 * i + 2),
                        front: front.clone(),
                        back: back.clone(),
                    }),
                    _ => None,
                })
                .collect()
        }
        Interpolation::Nearest => samples
            .iter()
            .enumerate()
            .map(|(i, sample)| Cell {
                from: place((2 * i).saturating_sub(1)),
                to: place((2 * i + 1).min(2 * last)),
                front: sample.clone(),
                back: sample.clone(),
            })
            .collect(),
    }
}

impl Cell {
    /// λ where the field has that value between its ends.
    fn place_of(&self, s: &Rational) -> Rational {
        let part = Rational::from(s - &self.front) / Rational::from(&self.back - &self.front);
        part * Rational::from(&self.to - &self.from) + &self.from
    }

    fn by_formulas(&self, formulas: &[Transfer<Expr>]) -> Result<expression::Cut, SceneProblem> {
        let slope =
            Rational::from(&self.back - &self.front) / Rational::from(&self.to - &self.from);
        let at_zero = &self.front - Rational::from(&slope * &self.from);
        let field =
            Expr::product([Expr::number(slope), Expr::symbol("lambda")]) + Expr::number(at_zero);
        let along: Vec<Transfer<Expr>> = formulas
            .iter()
            .map(|of_one| Transfer {
                emission: of_one.emission.substitute("s", &field),
                extinction: of_one.extinction.substitute("s", &field),
            })
            .collect();
        if self.front == self.back {
            // The same everywhere: its form is constant or a number that is not rational.
            let form = form(along.clone(), &self.from, &self.to);
            if let Ok(form @ (Form::Constant(_) | Form::Vacuum)) = form {
                return Ok(expression::Cut {
                    pieces: vec![Piece {
                        from: self.from.clone(),
                        to: self.to.clone(),
                        form,
                    }],
                    blur: 0.0,
                    unproved: Vec::new(),
                });
            }
        }
        expression::cut(&along, &self.from, &self.to)
    }
}

impl TransferTable {
    /// The field values at which C and τ have a kink, or a jump.
    fn knots(&self, lookup: Interpolation) -> Vec<Rational> {
        match lookup {
            Interpolation::Linear => self.s.clone(),
            Interpolation::Nearest => self
                .s
                .windows(2)
                .map(|pair| Rational::from(&pair[0] + &pair[1]) / 2)
                .collect(),
        }
    }

    /// The pieces of a cell: C and τ are linear in λ between the entries that the field passes, or jump halfway
    /// between them. Beyond its ends a table goes on as it ends.
    fn pieces(&self, cell: &Cell, lookup: Interpolation, knots: &[Rational]) -> Vec<Piece> {
        let (low, high) = if cell.front <= cell.back {
            (&cell.front, &cell.back)
        } else {
            (&cell.back, &cell.front)
        };
        let mut ends: Vec<&Rational> = vec![low];
        let first = knots.partition_point(|knot| knot <= low);
        let end = knots.partition_point(|knot| knot < high);
        ends.extend(knots.get(first..end).unwrap_or_default());
        ends.push(high);
        if cell.front > cell.back {
            ends.reverse();
        }
        let pairs: Vec<(&Rational, &Rational)> = ends
            .iter()
            .copied()
            .zip(ends.iter().copied().skip(1))
            .collect();
        let mut from = cell.from.clone();
        let count = pairs.len();
        let mut pieces = Vec::with_capacity(count);
        for (i, (front, back)) in pairs.into_iter().enumerate() {
            let to = if i + 1 == count {
                cell.to.clone()
            } else {
                cell.place_of(back)
            };
            let (front, back) = match lookup {
                Interpolation::Linear => (self.linear(front), self.linear(back)),
                Interpolation::Nearest => {
                    let middle = self.nearest(&(Rational::from(front + back) / 2));
                    (middle.clone(), middle)
                }
            };
            pieces.push(Piece {
                from,
                to: to.clone(),
                form: between(front, back),
            });
            from = to;
        }
        pieces
    }

    /// The entries on both sides of s, and how far s is from the first to the second.
    fn around(&self, s: &Rational) -> (usize, usize, Rational) {
        let after = self.s.partition_point(|entry| entry <= s);
        match (after.checked_sub(1), self.s.get(after)) {
            (Some(before), Some(next)) => {
                let width = Rational::from(next - &self.s[before]);
                (before, after, Rational::from(s - &self.s[before]) / width)
            }
            (Some(last), None) => (last, last, Rational::new()),
            (None, _) => (0, 0, Rational::new()),
        }
    }

    fn linear(&self, s: &Rational) -> Vec<Values> {
        let (near, far, part) = self.around(s);
        let mix = |a: &Rational, b: &Rational| Rational::from(b - a) * &part + a;
        let both = self.values[near].iter().zip(&self.values[far]);
        both.map(|(a, b)| Transfer {
            emission: mix(&a.emission, &b.emission),
            extinction: mix(&a.extinction, &b.extinction),
        })
        .collect()
    }

    fn nearest(&self, s: &Rational) -> Vec<Values> {
        let (near, far, part) = self.around(s);
        let nearest = if part < Rational::from((1, 2)) {
            near
        } else {
            far
        };
        self.values[nearest].clone()
    }
}

/// The least form of C and τ that are linear between two places.
pub(super) fn between(front: Vec<Values>, back: Vec<Values>) -> Form {
    let is_empty = |values: &[Values]| values.iter().all(|of_one| of_one.extinction == 0);
    if is_empty(&front) && is_empty(&back) {
        Form::Vacuum
    } else if front == back {
        Form::Constant(front)
    } else {
        Form::Linear { front, back }
    }
}

/// Neighbours of the same constant or empty form as one.
fn joined(pieces: Vec<Piece>) -> Vec<Piece> {
    let mut joined: Vec<Piece> = Vec::with_capacity(pieces.len());
    for piece in pieces {
        match joined.last_mut() {
            Some(last) if is_same(&last.form, &piece.form) => last.to = piece.to,
            _ => joined.push(piece),
        }
    }
    joined
}

fn is_same(a: &Form, b: &Form) -> bool {
    match (a, b) {
        (Form::Vacuum, Form::Vacuum) => true,
        (Form::Constant(a), Form::Constant(b)) => a == b,
        _ => false,
    }
}
