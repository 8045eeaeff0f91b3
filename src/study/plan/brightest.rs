//! The brightest light that there may be.

use super::PlanError;
use super::layout::Stretch;
use super::series::series;
use crate::real::{Format, Native};
use crate::scene::{Form, Scene};
use crate::symbolic::{Program, Range, Taylor};
use rug::Rational;

/// How bright the light from behind may be at most, by channel.
pub(super) fn brightest(scene: &Scene) -> Result<Vec<f64>, PlanError> {
    let native = Native::<f64>::new();
    let mut brightest: Vec<f64> = scene
        .background()
        .iter()
        .map(|q| native.ratio(q).next_up())
        .collect();
    for (medium, of_one) in scene.media().iter().enumerate() {
        for (index, piece) in of_one.pieces.iter().enumerate() {
            let mut raise = |channel: usize, emission: f64| {
                if let Some(brightest) = brightest.get_mut(channel) {
                    *brightest = brightest.max(emission);
                }
            };
            match &piece.form {
                Form::Vacuum => {}
                Form::Constant(values) => {
                    for (channel, of_one) in values.iter().enumerate() {
                        raise(channel, Range::around(&of_one.emission).high);
                    }
                }
                Form::Linear { front, back } => {
                    for values in [front, back] {
                        for (channel, of_one) in values.iter().enumerate() {
                            raise(channel, Range::around(&of_one.emission).high);
                        }
                    }
                }
                Form::Smooth { program, .. } => {
                    let stretch = Stretch {
                        medium,
                        pieces: index..index + 1,
                        from: piece.from.clone(),
                        to: piece.to.clone(),
                    };
                    let found = bound_emission(program.program(), stretch, brightest.len());
                    let found = found.map_err(|lambda| PlanError::NotResolved {
                        medium: of_one.name.clone(),
                        lambda,
                    })?;
                    for (channel, emission) in found.into_iter().enumerate() {
                        if let Some(brightest) = brightest.get_mut(channel) {
                            *brightest = brightest.max(emission);
                        }
                    }
                }
            }
        }
    }
    Ok(brightest)
}

/// Halved until it is finite on every part; on the error near which place it is not.
fn bound_emission(program: &Program, whole: Stretch, channels: usize) -> Result<Vec<f64>, f64> {
    const MAX_PARTS: usize = 4096;
    let mut brightest = vec![0.0_f64; channels];
    let mut open = vec![whole];
    let mut parts = 0;
    while let Some(part) = open.pop() {
        parts += 1;
        let found = series(program, &part, 0);
        let is_finite = |(emission, extinction): &(Taylor, Taylor)| {
            emission.coefficient(0).magnitude().is_finite()
                && extinction.coefficient(0).magnitude().is_finite()
        };
        if found.iter().all(is_finite) {
            for (brightest, (emission, _)) in brightest.iter_mut().zip(&found) {
                *brightest = brightest.max(emission.coefficient(0).magnitude());
            }
        } else if parts > MAX_PARTS {
            return Err(part.from.to_f64());
        } else {
            let middle = Rational::from(&part.from + &part.to) / 2;
            let half = |from: &Rational, to: &Rational| Stretch {
                from: from.clone(),
                to: to.clone(),
                ..part.clone()
            };
            open.push(half(&part.from, &middle));
            open.push(half(&middle, &part.to));
        }
    }
    Ok(brightest)
}
