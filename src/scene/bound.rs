//! C and τ of a piece in a format.

use super::{Form, Piece, Values};
use crate::case::Transfer;
use crate::real::{Format, Real};
use crate::symbolic::Bound;
use rug::Rational;

/// C and τ at some places, by channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Columns<R> {
    /// C.
    pub emission: Vec<Vec<R>>,
    /// τ.
    pub extinction: Vec<Vec<R>>,
}

impl<R> Columns<R> {
    /// Of no place yet.
    #[must_use]
    pub fn new(channels: usize) -> Self {
        let none = || (0..channels).map(|_| Vec::new()).collect();
        Columns {
            emission: none(),
            extinction: none(),
        }
    }

    /// Takes all values out.
    pub fn clear(&mut self) {
        for column in self.emission.iter_mut().chain(&mut self.extinction) {
            column.clear();
        }
    }
}

/// A piece with its constants in a format.
#[derive(Debug)]
pub enum BoundPiece<'s, F: Format> {
    /// τ = 0.
    Vacuum,
    /// The same everywhere.
    Constant(Vec<Transfer<F::Real>>),
    /// Linear between the ends.
    Linear {
        /// Where it begins.
        from: F::Real,
        /// How long it is.
        length: F::Real,
        /// At the front.
        front: Vec<Transfer<F::Real>>,
        /// At the back less at the front.
        rise: Vec<Transfer<F::Real>>,
    },
    /// By formulas.
    Smooth(Bound<'s, F>),
}

impl<'s, F: Format> BoundPiece<'s, F> {
    /// The piece, its numbers rounded once.
    #[must_use]
    pub fn new(piece: &'s Piece, format: F) -> Self {
        match &piece.form {
            Form::Vacuum => BoundPiece::Vacuum,
            Form::Constant(values) => BoundPiece::Constant(all(values, format)),
            Form::Linear { front, back } => {
                let rise = front.iter().zip(back).map(|(near, far)| Transfer {
                    emission: Rational::from(&far.emission - &near.emission),
                    extinction: Rational::from(&far.extinction - &near.extinction),
                });
                let rise: Vec<Values> = rise.collect();
                BoundPiece::Linear {
                    from: format.ratio(&piece.from),
                    length: format.ratio(&Rational::from(&piece.to - &piece.from)),
                    front: all(front, format),
                    rise: all(&rise, format),
                }
            }
            Form::Smooth { program, .. } => BoundPiece::Smooth(program.bind(format)),
        }
    }

    /// Appends C and τ at each place.
    pub fn evaluate(&self, lambda: &[F::Real], columns: &mut Columns<F::Real>) {
        match self {
            BoundPiece::Vacuum => {
                let zeros = lambda.iter().map(|x| x.format().int(0));
                for column in columns.emission.iter_mut().chain(&mut columns.extinction) {
                    column.extend(zeros.clone());
                }
            }
            BoundPiece::Constant(values) => {
                for (channel, value) in values.iter().enumerate() {
                    for _ in lambda {
                        push(columns, channel, value.clone());
                    }
                }
            }
            BoundPiece::Linear {
                from,
                length,
                front,
                rise,
            } => {
                for x in lambda {
                    let part = (x.clone() - from) / length;
                    for (channel, (front, rise)) in front.iter().zip(rise).enumerate() {
                        let value = Transfer {
                            emission: rise.emission.clone() * &part + &front.emission,
                            extinction: rise.extinction.clone() * &part + &front.extinction,
                        };
                        push(columns, channel, value);
                    }
                }
            }
            BoundPiece::Smooth(program) => {
                let channels = columns.emission.len();
                let mut outputs: Vec<Vec<F::Real>> = vec![Vec::new(); 2 * channels];
                program.run(&[lambda], &mut outputs);
                let mut outputs = outputs.into_iter();
                for channel in 0..channels {
                    let both = outputs.next().zip(outputs.next());
                    let (emission, extinction) = both.unwrap_or_default();
                    columns.emission[channel].extend(emission);
                    columns.extinction[channel].extend(extinction);
                }
            }
        }
    }
}

fn push<R>(columns: &mut Columns<R>, channel: usize, value: Transfer<R>) {
    columns.emission[channel].push(value.emission);
    columns.extinction[channel].push(value.extinction);
}

fn all<F: Format>(values: &[Values], format: F) -> Vec<Transfer<F::Real>> {
    let rounded = |of_one: &Values| Transfer {
        emission: format.ratio(&of_one.emission),
        extinction: format.ratio(&of_one.extinction),
    };
    values.iter().map(rounded).collect()
}
