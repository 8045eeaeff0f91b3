//! What the radiance of a scene is, panel by panel, and how certain that is.

use super::PlanError;
use super::brightest::brightest;
use super::certify::bounds;
use super::layout::{Layout, Stretch};
use super::light::{Light, attenuated, size, sums};
use super::series::{half_width, series};
use crate::quadrature::collocation;
use crate::real::{Format, Real};
use crate::scene::{BoundPiece, Form, Piece, Scene};
use crate::symbolic::Taylor;
use rug::Rational;

/// Each panel may take this part of the tolerance.
const SHARE: f64 = 1e-4;
/// More panels mean a medium that is not analytic where it is said to be.
const MAX_PANELS: usize = 1 << 14;
/// How often a piece may be halved.
const MAX_HALVINGS: u32 = 200;
/// Units in the last place that sums over a panel are taken to err by.
const ROUNDING: f64 = 64.0;

/// A panel of one piece.
pub(super) struct Panel<R> {
    pub(super) stretch: Stretch,
    /// By channel.
    pub(super) light: Vec<Light<R>>,
    /// What the radiance of the ray may be off by because of this panel.
    pub(super) uncertainty: f64,
}

/// A ray, known.
pub(super) struct Survey<'s, F: Format> {
    pub(super) scene: &'s Scene,
    pub(super) layout: Layout<'s, F>,
    pub(super) panels: Vec<Panel<F::Real>>,
    /// T in front of each panel and behind the last, by channel.
    pub(super) transmittance: Vec<Vec<F::Real>>,
    /// The radiance that comes in from there, by channel.
    pub(super) behind: Vec<Vec<F::Real>>,
    /// What the radiance may be off by, all in all.
    pub(super) uncertainty: f64,
    /// No light anywhere is brighter, in any channel.
    brightest: f64,
}

/// Coefficients of Taylor series that bounds rest on, for numbers of so many bits.
pub(super) fn order(bits: u32) -> u32 {
    (bits / 3).clamp(18, 400)
}

impl<'s, F: Format> Survey<'s, F> {
    pub(super) fn new(scene: &'s Scene, format: F, tolerance: f64) -> Result<Self, PlanError> {
        let layout = Layout::new(scene, format);
        let brightest = brightest(scene)?;
        let mut surveyor = Surveyor {
            scene,
            layout: &layout,
            order: order(format.bits()),
            share: SHARE * tolerance,
            brightest: &brightest,
            panels: Vec::new(),
            transmittance: vec![1.0; layout.channels],
        };
        for (medium, of_one) in scene.media().iter().enumerate() {
            for (index, piece) in of_one.pieces.iter().enumerate() {
                surveyor.piece(medium, index, piece)?;
            }
        }
        let panels = surveyor.panels;
        let mut survey = Survey {
            scene,
            transmittance: Vec::with_capacity(panels.len() + 1),
            behind: Vec::with_capacity(panels.len() + 1),
            uncertainty: 0.0,
            brightest: 0.0,
            panels,
            layout,
        };
        survey.accumulate();
        survey.brightest = brightest.iter().copied().fold(0.0, f64::max);
        survey.uncertainty = survey.total_uncertainty();
        Ok(survey)
    }

    /// T from the front, and the light from behind.
    fn accumulate(&mut self) {
        let format = self.layout.format;
        let one = vec![format.int(1); self.layout.channels];
        self.transmittance.push(one);
        for panel in &self.panels {
            let last = &self.transmittance[self.transmittance.len() - 1];
            let both = last.iter().zip(&panel.light);
            let next = both.map(|(t, light)| (-light.depth.clone()).exp() * t);
            let next = next.collect();
            self.transmittance.push(next);
        }
        let background = self.scene.background().iter();
        let mut light: Vec<F::Real> = background.map(|q| format.ratio(q)).collect();
        self.behind.push(light.clone());
        for panel in self.panels.iter().rev() {
            let both = light.iter().zip(&panel.light);
            light = both
                .map(|(behind, of_one)| (-of_one.depth.clone()).exp() * behind + &of_one.radiance)
                .collect();
            self.behind.push(light.clone());
        }
        self.behind.reverse();
    }

    /// Of panels, of roundings, and of breaks that are not known exactly.
    fn total_uncertainty(&self) -> f64 {
        let unit = (-f64::from(self.layout.format.bits())).exp2();
        let panels: f64 = self.panels.iter().map(|panel| panel.uncertainty).sum();
        let rounding = ROUNDING * unit * self.brightest * (1.0 + (self.panels.len() as f64).sqrt());
        panels + rounding + self.blur()
    }

    /// What it may cost that breaks are told a little beside where they are.
    pub(super) fn blur(&self) -> f64 {
        let media = self.scene.media().iter();
        let blur: f64 = media.map(|medium| medium.blur).sum();
        if blur == 0.0 {
            return 0.0;
        }
        let extinction = self.panels.iter().flat_map(|panel| {
            let length = panel.stretch.length().to_f64();
            panel
                .light
                .iter()
                .map(move |light| size(&light.depth) / length)
        });
        blur * 4.0 * self.brightest * extinction.fold(0.0, f64::max)
    }

    /// The light of a range of panels, by channel.
    pub(super) fn light(&self, range: std::ops::Range<usize>) -> Vec<Light<F::Real>> {
        let format = self.layout.format;
        let mut total: Vec<Light<F::Real>> = (0..self.layout.channels)
            .map(|_| Light::none(format))
            .collect();
        for panel in self.panels[range].iter().rev() {
            for (total, light) in total.iter_mut().zip(&panel.light) {
                total.radiance = (-light.depth.clone()).exp() * &total.radiance + &light.radiance;
                total.depth += &light.depth;
            }
        }
        total
    }
}

/// Cuts pieces into panels, from front to back.
struct Surveyor<'a, 's, F: Format> {
    scene: &'s Scene,
    layout: &'a Layout<'s, F>,
    order: u32,
    share: f64,
    brightest: &'a [f64],
    panels: Vec<Panel<F::Real>>,
    /// T so far, by channel.
    transmittance: Vec<f64>,
}

impl<F: Format> Surveyor<'_, '_, F> {
    fn piece(&mut self, medium: usize, index: usize, piece: &Piece) -> Result<(), PlanError> {
        let stretch = |from: &Rational, to: &Rational| Stretch {
            medium,
            pieces: index..index + 1,
            from: from.clone(),
            to: to.clone(),
        };
        let whole = stretch(&piece.from, &piece.to);
        let Form::Smooth { program, .. } = &piece.form else {
            let light = closed_form(self.layout, &whole, piece)?;
            self.push(whole, light, 0.0);
            return Ok(());
        };
        let mut open = vec![(whole, 0)];
        while let Some((panel, halvings)) = open.pop() {
            let instructions = program.program().instructions().len() as u64;
            self.layout
                .spend(instructions * u64::from(self.order).pow(2))?;
            let series = series(program.program(), &panel, self.order);
            if let Some(uncertainty) = self.uncertainty(&series, &panel) {
                let light = self.light(&panel)?;
                self.push(panel, light, uncertainty);
                continue;
            }
            if halvings == MAX_HALVINGS || self.panels.len() + open.len() > MAX_PANELS {
                return Err(PlanError::NotResolved {
                    medium: self.scene.media()[medium].name.clone(),
                    lambda: panel.from.to_f64(),
                });
            }
            let middle = Rational::from(&panel.from + &panel.to) / 2;
            // The first of the halves goes on top.
            open.push((stretch(&middle, &panel.to), halvings + 1));
            open.push((stretch(&panel.from, &middle), halvings + 1));
        }
        Ok(())
    }

    fn push(&mut self, stretch: Stretch, light: Vec<Light<F::Real>>, uncertainty: f64) {
        for (t, light) in self.transmittance.iter_mut().zip(&light) {
            *t *= (-size(&light.depth)).exp();
        }
        self.panels.push(Panel {
            stretch,
            light,
            uncertainty,
        });
    }

    /// What the radiance may be off by, where that is little enough.
    fn uncertainty(&self, series: &[(Taylor, Taylor)], panel: &Stretch) -> Option<f64> {
        let half = half_width(panel).next_up();
        let table = collocation(self.order, self.layout.format).ok()?;
        let mut largest = 0.0_f64;
        for (channel, (emission, extinction)) in series.iter().enumerate() {
            let found = bounds(emission, extinction, half, self.order as usize, table.reach);
            let error = found.radiance + found.depth.exp_m1() * self.brightest[channel];
            // T is known to a part in a thousand.
            let error = 1.001 * self.transmittance[channel] * error;
            // No number is no bound, and no maximum would tell.
            if error.is_nan() {
                return None;
            }
            largest = largest.max(error);
        }
        (largest <= self.share).then_some(largest)
    }

    fn light(&self, panel: &Stretch) -> Result<Vec<Light<F::Real>>, PlanError> {
        let looked = self.layout.look(panel, self.order)?;
        let both = looked
            .columns
            .emission
            .iter()
            .zip(&looked.columns.extinction);
        Ok(both
            .map(|(emission, extinction)| Light {
                radiance: attenuated(emission, extinction, &looked.table, &looked.length),
                depth: sums(emission, extinction, &looked.table, &looked.length).depth,
            })
            .collect())
    }
}

/// The light of a piece that has a closed form.
fn closed_form<F: Format>(
    layout: &Layout<'_, F>,
    stretch: &Stretch,
    piece: &Piece,
) -> Result<Vec<Light<F::Real>>, PlanError> {
    let format = layout.format;
    let length = format.ratio(&stretch.length());
    match &piece.form {
        Form::Constant(_) | Form::Vacuum | Form::Smooth { .. } => Ok(match layout.piece(stretch) {
            Some(BoundPiece::Constant(values)) => values
                .iter()
                .map(|of_one| {
                    let depth = of_one.extinction.clone() * &length;
                    Light::of_constant_emission(&of_one.emission, depth)
                })
                .collect(),
            _ => (0..layout.channels).map(|_| Light::none(format)).collect(),
        }),
        Form::Linear { front, back } => {
            let ends = front.iter().zip(back);
            ends.map(|(front, back)| {
                let near = super::run::rounded(front, format);
                let far = super::run::rounded(back, format);
                Ok(Light::linear(&near, &far, &length)?)
            })
            .collect()
        }
    }
}
