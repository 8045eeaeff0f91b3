//! Models that may stand for stretches of the ray, and what they do to the radiance.

use super::layout::Stretch;
use super::light::{Light, by_points, size};
use super::survey::{Panel, Survey, order};
use super::weights::Weights;
use super::{Cost, Model, PlanError};
use crate::real::{Format, Real};
use crate::scene::Form;
use std::ops::Range;

/// The numbers of points that are tried.
const POINTS: [u32; 20] = [
    1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 18, 20, 24, 28, 32, 40, 48,
];
/// Errors of so little of the tolerance need no more points.
const ENOUGH: f64 = 1e-3;
/// A stretch for which so few points are enough is not divided.
const FEW: u32 = 3;

/// A model for a stretch.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// The model.
    pub model: Model,
    /// What it costs.
    pub cost: f64,
    /// What the radiance of a channel errs by at most, T in front included.
    pub error: f64,
}

/// A stretch, its candidates, and the two parts of it.
pub struct Node {
    /// The panels that it consists of.
    pub panels: Range<usize>,
    /// What may stand for it as a whole.
    pub candidates: Vec<Candidate>,
    /// The nodes of its parts, where it is divided.
    pub halves: Option<(usize, usize)>,
}

/// All stretches that a choice may be made of.
pub struct Forest {
    /// Parts stand before what is made of them.
    pub nodes: Vec<Node>,
    /// One for each medium.
    pub roots: Vec<usize>,
}

impl Forest {
    pub(super) fn new<F: Format>(
        survey: &Survey<'_, F>,
        cost: Cost,
        tolerance: f64,
    ) -> Result<Forest, PlanError> {
        let mut forest = Forest {
            nodes: Vec::new(),
            roots: Vec::new(),
        };
        let mut begin = 0;
        while let Some(first) = survey.panels.get(begin) {
            let medium = first.stretch.medium;
            let rest = survey.panels[begin..].iter();
            let count = rest
                .take_while(|panel| panel.stretch.medium == medium)
                .count();
            let explorer = Explorer {
                survey,
                cost,
                tolerance,
            };
            let root = forest.explore(&explorer, begin..begin + count)?;
            forest.roots.push(root);
            begin += count;
        }
        Ok(forest)
    }

    /// The stretch of these panels with all that it may be divided into; its index.
    fn explore<F: Format>(
        &mut self,
        explorer: &Explorer<'_, '_, F>,
        panels: Range<usize>,
    ) -> Result<usize, PlanError> {
        let (candidates, is_done) = explorer.candidates(&panels)?;
        let halves = match explorer.middle(&panels) {
            Some(middle) if !is_done => {
                let first = self.explore(explorer, panels.start..middle)?;
                let second = self.explore(explorer, middle..panels.end)?;
                Some((first, second))
            }
            _ => None,
        };
        self.nodes.push(Node {
            panels,
            candidates,
            halves,
        });
        Ok(self.nodes.len() - 1)
    }
}

/// The stretch that some panels make up.
pub(super) fn stretch<F: Format>(survey: &Survey<'_, F>, panels: &Range<usize>) -> Option<Stretch> {
    let first = survey.panels.get(panels.start)?;
    let last = survey.panels.get(panels.end.checked_sub(1)?)?;
    Some(Stretch {
        medium: first.stretch.medium,
        pieces: first.stretch.pieces.start..last.stretch.pieces.end,
        from: first.stretch.from.clone(),
        to: last.stretch.to.clone(),
    })
}

struct Explorer<'a, 's, F: Format> {
    survey: &'a Survey<'s, F>,
    cost: Cost,
    tolerance: f64,
}

impl<F: Format> Explorer<'_, '_, F> {
    /// Where to divide: between pieces if there are several, else halfway.
    fn middle(&self, panels: &Range<usize>) -> Option<usize> {
        let count = panels.len();
        if count < 2 {
            return None;
        }
        let piece = |i: usize| self.survey.panels[i].stretch.pieces.start;
        let is_border = |i: &usize| piece(i - 1) != piece(*i);
        let halfway = panels.start + count / 2;
        let borders = (panels.start + 1..panels.end).filter(is_border);
        let border = borders.min_by_key(|i| i.abs_diff(halfway));
        if border.is_some() {
            return border;
        }
        // Panels are halves of halves of a piece: the middle of the stretch is between two of them, unless the
        // stretch is no such half.
        let whole = stretch(self.survey, panels)?;
        let middle = rug::Rational::from(&whole.from + &whole.to) / 2;
        let inside = panels.start + 1..panels.end;
        let found = inside
            .clone()
            .find(|i| self.survey.panels[*i].stretch.from == middle);
        found.or(Some(halfway))
    }

    /// What may stand for these panels, and whether there is no use in dividing them.
    fn candidates(&self, panels: &Range<usize>) -> Result<(Vec<Candidate>, bool), PlanError> {
        let survey = self.survey;
        let Some(stretch) = stretch(survey, panels) else {
            return Ok((Vec::new(), true));
        };
        let exact = survey.light(panels.clone());
        let weights = Weights {
            front: &survey.transmittance[panels.start],
            behind: &survey.behind[panels.end],
            exact: &exact,
        };
        let format = survey.layout.format;
        let depth = deepest(&exact);
        let mut found = vec![self.candidate(Model::Nothing, depth, {
            let none: Vec<_> = exact.iter().map(|_| Light::none(format)).collect();
            weights.because(&none).error()
        })];
        let piece = stretch.only_piece(survey.scene);
        let form = piece.map(|piece| &piece.form);
        let is_whole_piece =
            piece.is_some_and(|piece| piece.from == stretch.from && piece.to == stretch.to);
        match form {
            Some(Form::Vacuum) => return Ok((found, true)),
            Some(Form::Constant(_)) => found.push(self.candidate(Model::Constant, depth, 0.0)),
            Some(Form::Linear { .. }) if is_whole_piece => {
                found.push(self.candidate(Model::Linear, depth, 0.0));
            }
            _ => {}
        }
        let nothing_is_enough = found[0].error <= ENOUGH * self.tolerance;
        if nothing_is_enough {
            return Ok((found, true));
        }
        let constant_emission = has_constant_emission(form);
        let enough = self.by_points(&stretch, &weights, panels, constant_emission, &mut found)?;
        Ok((found, enough.is_some_and(|points| points <= FEW)))
    }

    /// Adds models of more and more points, until more are of no use; how many are enough.
    fn by_points(
        &self,
        stretch: &Stretch,
        weights: &Weights<'_, F::Real>,
        panels: &Range<usize>,
        constant_emission: bool,
        found: &mut Vec<Candidate>,
    ) -> Result<Option<u32>, PlanError> {
        let layout = &self.survey.layout;
        // Without points, what is exact costs so much.
        let closed = self.closed_cost(panels);
        let depth = deepest(weights.exact);
        let begin = found.len();
        let mut enough: Option<u32> = None;
        // So many points are certain to be enough on one panel.
        let certain = (panels.len() == 1).then(|| order(layout.format.bits()));
        for points in POINTS.into_iter().chain(certain) {
            let mut models = vec![Model::Quadrature { points }];
            if constant_emission {
                models = vec![Model::ConstantEmission { points }];
            }
            models.push(Model::EmissionOnly { points });
            models.push(Model::AbsorptionOnly { points });
            if self.cost.of(models[0], layout.channels, depth) >= closed {
                break;
            }
            let looked = layout.look(stretch, points)?;
            let mut best = f64::INFINITY;
            for model in models {
                let columns = looked
                    .columns
                    .emission
                    .iter()
                    .zip(&looked.columns.extinction);
                let light: Vec<_> = columns
                    .map(|(c, tau)| by_points(model, c, tau, &looked.table, &looked.length))
                    .collect();
                let error = weights.because(&light).error();
                best = best.min(error);
                found.push(self.candidate(model, depth, error));
            }
            if best > ENOUGH * self.tolerance {
                enough = None;
            } else if enough.is_some() {
                // Twice in a row: that is no luck.
                break;
            } else {
                enough = Some(points);
            }
        }
        without_luck(&mut found[begin..]);
        Ok(enough)
    }

    /// What the panels cost by closed forms, which they are pieces of where they have some.
    fn closed_cost(&self, panels: &Range<usize>) -> f64 {
        let survey = self.survey;
        let panels = survey.panels.get(panels.clone()).unwrap_or_default();
        let cost = |panel: &Panel<F::Real>| {
            let piece = panel.stretch.only_piece(survey.scene);
            let model = match piece.map(|piece| &piece.form) {
                Some(Form::Vacuum) => Model::Nothing,
                Some(Form::Constant(_)) => Model::Constant,
                Some(Form::Linear { .. }) => Model::Linear,
                Some(Form::Smooth { .. }) | None => return f64::INFINITY,
            };
            let depth = deepest(&panel.light);
            self.cost.of(model, survey.layout.channels, depth)
        };
        panels.iter().map(cost).sum()
    }

    fn candidate(&self, model: Model, depth: f64, error: f64) -> Candidate {
        let channels = self.survey.layout.channels;
        Candidate {
            model,
            cost: self.cost.of(model, channels, depth),
            error,
        }
    }
}

/// The optical depth in the channel where that is most.
fn deepest<R: Real>(light: &[Light<R>]) -> f64 {
    let depths = light.iter().map(|of_one| size(&of_one.depth));
    depths.fold(0.0, f64::max)
}

/// A model of few points counts with the largest error of it and of all of its kind with more.
fn without_luck(candidates: &mut [Candidate]) {
    let mut largest: Vec<(std::mem::Discriminant<Model>, f64)> = Vec::new();
    for candidate in candidates.iter_mut().rev() {
        let kind = std::mem::discriminant(&candidate.model);
        match largest.iter_mut().find(|(of, _)| *of == kind) {
            Some((_, largest)) => {
                *largest = largest.max(candidate.error);
                candidate.error = *largest;
            }
            None => largest.push((kind, candidate.error)),
        }
    }
}

fn has_constant_emission(form: Option<&Form>) -> bool {
    match form {
        Some(Form::Linear { front, back }) => front
            .iter()
            .zip(back)
            .all(|(near, far)| near.emission == far.emission),
        Some(Form::Smooth { formulas, .. }) => formulas
            .iter()
            .all(|of_one| of_one.emission.as_number().is_some()),
        Some(Form::Constant(_)) => true,
        Some(Form::Vacuum) | None => false,
    }
}
