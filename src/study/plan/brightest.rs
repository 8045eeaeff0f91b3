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
                    let found = bound_emission(program.program(), stretch);
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

/// A part of a piece, with what its light is at most, by channel.
struct Part {
    stretch: Stretch,
    brightest: Vec<f64>,
}

impl Part {
    fn new(program: &Program, stretch: Stretch) -> Part {
        let found = series(program, &stretch, 0);
        let bound = |(emission, extinction): &(Taylor, Taylor)| {
            let emission = emission.coefficient(0).magnitude();
            if extinction.coefficient(0).magnitude().is_finite() {
                emission
            } else {
                f64::INFINITY
            }
        };
        Part {
            stretch,
            brightest: found.iter().map(bound).collect(),
        }
    }

    fn most(&self) -> f64 {
        self.brightest.iter().copied().fold(0.0, f64::max)
    }

    fn halves(&self, program: &Program) -> [Part; 2] {
        let Stretch { from, to, .. } = &self.stretch;
        let middle = Rational::from(from + to) / 2;
        let half = |from: &Rational, to: &Rational| {
            let stretch = Stretch {
                from: from.clone(),
                to: to.clone(),
                ..self.stretch.clone()
            };
            Part::new(program, stretch)
        };
        [half(from, &middle), half(&middle, to)]
    }
}

/// The brightest part is halved until that tells nothing more: an enclosure over all of a piece may be larger than its
/// values by hundreds of orders of magnitude. On the error near which place there is no bound.
fn bound_emission(program: &Program, whole: Stretch) -> Result<Vec<f64>, f64> {
    const MAX_PARTS: usize = 4096;
    /// Halves that are less than this times the whole tell something.
    const LESS: f64 = 0.75;
    let mut parts = vec![Part::new(program, whole)];
    while parts.len() < MAX_PARTS {
        parts.sort_by(|a, b| a.most().total_cmp(&b.most()));
        let Some(brightest) = parts.pop() else { break };
        let halves = brightest.halves(program);
        let most = halves.iter().map(Part::most).fold(0.0, f64::max);
        let is_told = most.is_finite() && most >= LESS * brightest.most();
        if is_told {
            parts.push(brightest);
            break;
        }
        parts.extend(halves);
    }
    let mut brightest: Vec<f64> = Vec::new();
    for part in &parts {
        if !part.most().is_finite() {
            return Err(part.stretch.from.to_f64());
        }
        brightest.resize(part.brightest.len(), 0.0);
        for (brightest, of_part) in brightest.iter_mut().zip(&part.brightest) {
            *brightest = brightest.max(*of_part);
        }
    }
    Ok(brightest)
}
