//! From panel to panel along the ray, all that is known of t and I in intervals.

use super::super::chebyshev::log2_abs;
use super::ellipse::{Bound, Bounds};
use super::number::exp;
use super::run::{Branches, constants, hull, run};
use super::stretch::Stretch;
use super::substitution::plain;
use super::transform::Points;
use super::{Medium, NotEnclosed, Work};
use crate::symbolic::{Interval, Program};
use rug::Float;
use rug::float::Round;
use std::collections::BTreeMap;

/// The sums of half-axes that are tried.
const RHOS: [f64; 12] = [
    1.25, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 64.0,
];
/// Of these the first one tried.
const FIRST: usize = 4;
/// The least degree of a series.
const LEAST_DEGREE: usize = 8;
/// Parts of a tolerance that one panel may use, as a power of 2.
const SHARE: f64 = 8.0;
/// Points of a ray before it is given up.
const MAX_POINTS: u64 = 1 << 20;
/// Panels in a row whose like would take more points than that over the rest of the ray.
const MAX_SLOW: u32 = 1024;
/// Panels tried before it is given up.
const MAX_TRIED: u64 = 1 << 16;

/// How well a pass is to be done.
#[derive(Clone, Copy, Debug)]
pub(super) struct Settings {
    /// Significant bits of all numbers.
    pub(super) precision: u32,
    /// log₂ of what t may be off by.
    pub(super) depth: f64,
    /// log₂ of what I may be off by; `None` where I is not wanted.
    pub(super) light: Option<f64>,
    /// The highest degree of a series.
    pub(super) limit: usize,
    /// log₂ of the length below which panels are not halved: what has no bound there has none.
    pub(super) shortest: f64,
}

/// The state of a pass: all that is left of the current place.
pub(super) struct March<'m> {
    program: &'m Program,
    settings: Settings,
    constants: Vec<Interval>,
    bounds: BTreeMap<u32, Bounds<'m>>,
    points: BTreeMap<usize, Points>,
    /// Where a search for ρ begins, and the degree that the last panel took.
    guess: usize,
    last: usize,
    pub(super) work: Work,
    tried: u64,
    slow: u32,
    /// log₂ of about the most light of a panel, whatever its sign.
    pub(super) brightest: f64,
    pub(super) depth: Interval,
    pub(super) light: Interval,
}

impl<'m> March<'m> {
    pub(super) fn new(medium: &'m Medium<'_>, settings: Settings) -> Self {
        let bits = settings.precision;
        let zero = || Interval::exactly(&Float::new(bits));
        March {
            program: &medium.program,
            settings,
            constants: constants(&medium.program, bits),
            bounds: BTreeMap::new(),
            points: BTreeMap::new(),
            guess: FIRST,
            last: 0,
            work: Work::default(),
            tried: 0,
            slow: 0,
            brightest: f64::NEG_INFINITY,
            depth: zero(),
            light: zero(),
        }
    }

    /// Integrates over all stretches, front to back.
    pub(super) fn run(&mut self, stretches: &[Stretch]) -> Result<(), NotEnclosed> {
        let mut rest: Vec<Stretch> = stretches.iter().rev().cloned().collect();
        let end = stretches.last().map(|last| {
            let [_, to] = last.ends();
            to.midpoint()
        });
        let end = end.unwrap_or_else(|| Float::new(64));
        while let Some(panel) = rest.pop() {
            if self.is_dark(&panel, &rest) {
                return Ok(());
            }
            self.tried += 1;
            let is_too_much = self.tried > MAX_TRIED || self.work.points > MAX_POINTS;
            if is_too_much || self.slow > MAX_SLOW {
                return Err(NotEnclosed::TooMuchWork {
                    lambda: near(&panel),
                });
            }
            let Some(parts) = self.integrate(&panel)? else {
                self.work.panels += 1;
                self.look_ahead(&panel, &end);
                continue;
            };
            if self.enclose_roughly(&panel)? {
                self.work.panels += 1;
                continue;
            }
            let lambda = near(&panel);
            let width = Float::with_val(64, &panel.to - &panel.from);
            let is_point = log2_abs(&width) < self.settings.shortest;
            let pieces = panel.cut(parts);
            if is_point || pieces.len() < 2 {
                return Err(NotEnclosed::NotBounded { lambda });
            }
            rest.extend(pieces.into_iter().rev());
        }
        Ok(())
    }

    /// Counts panels in a row of which the rest of the ray would take too many.
    fn look_ahead(&mut self, panel: &Stretch, end: &Float) {
        let [from, to] = panel
            .ends()
            .map(|place| Float::with_val(64, place.midpoint()));
        let width = Float::with_val(64, &to - &from);
        let rest = Float::with_val(64, end - &to) / width;
        self.slow = if rest * self.last as u64 > MAX_POINTS {
            self.slow + 1
        } else {
            0
        };
    }

    /// By series; where that takes too much, how many parts the panel is to be cut in.
    fn integrate(&mut self, panel: &Stretch) -> Result<Option<u32>, NotEnclosed> {
        let Some(branches) = &panel.branches else {
            return Ok(Some(2));
        };
        let bits = self.settings.precision;
        let (bound, degree) = match self.degree(panel, branches) {
            Ok(found) => found,
            Err(parts) => return Ok(Some(parts)),
        };
        let points = self
            .points
            .entry(degree)
            .or_insert_with(|| Points::new(degree, bits));
        let (from, to) = (Interval::exactly(&panel.from), Interval::exactly(&panel.to));
        let half = Interval::exactly(&Float::with_val(bits, 0.5));
        let middle = &(&from + &to) * &half;
        let reach = &(&to - &from) * &half;
        let whole = from.union(&to);
        let (mut emitted, mut extinction) = (Vec::new(), Vec::new());
        for (k, cosine) in points.cosines().iter().enumerate() {
            let place = match k {
                0 => to.clone(),
                k if k == degree => from.clone(),
                _ => {
                    let place = &middle + &(&reach * cosine);
                    place.intersection(&whole).unwrap_or(place)
                }
            };
            let (program, constants) = (self.program, &self.constants);
            let values = match &panel.substitution {
                Some(substitution) => substitution.values(program, constants, branches, &place),
                None => plain(program, constants, branches, &place),
            };
            let Some(values) = values else {
                return Ok(Some(2));
            };
            if values.extinction.is_negative() {
                return Err(NotEnclosed::NegativeExtinction {
                    lambda: panel.lambda(&place).midpoint().to_f64(),
                });
            }
            emitted.push(values.source);
            extinction.push(values.extinction);
        }
        self.work.points += degree as u64 + 1;
        let depths = points.integrals(&extinction);
        // What the series of τ leaves out of t, anywhere on the panel.
        let missed = remainder(&bound, &bound.extinction, &reach, degree);
        let mut source = Vec::new();
        if self.settings.light.is_some() {
            for (emitted, depth) in emitted.iter().zip(&depths) {
                let depth = &(&(depth * &reach) + &missed) + &self.depth;
                source.push(emitted * &exp(&-&depth));
            }
            let light = &points.integral(&source) * &reach;
            for value in &source {
                let size = log2_abs(value.lower()).max(log2_abs(value.upper()));
                self.brightest = self.brightest.max(size + log2_abs(reach.upper()));
            }
            let missed = remainder(&bound, &bound.light, &reach, degree);
            let missed = &missed * &(-&self.depth).exp();
            self.light = &(&self.light + &light) + &missed;
        }
        if let Some(depth) = depths.first() {
            self.depth = &(&self.depth + &(depth * &reach)) + &missed;
        }
        Ok(None)
    }

    /// The ellipse that takes the least degree, and that degree; where none takes few enough, how many parts the panel is
    /// to be cut in.
    fn degree(&mut self, panel: &Stretch, branches: &Branches) -> Result<(Bound, usize), u32> {
        let bits = Bounds::bits_for(panel).next_multiple_of(64);
        let program = self.program;
        let bounds = self
            .bounds
            .entry(bits)
            .or_insert_with(|| Bounds::new(program, bits));
        let transmittance = -log2_e(self.depth.lower());
        let log2_reach = log2_abs(&Float::with_val(64, &panel.to - &panel.from)) - 1.0;
        let settings = &self.settings;
        let takes = |rho: f64| {
            let bound = bounds.on(panel, rho, branches)?;
            let scale = 3.0 + log2_reach - (rho - 1.0).log2() + SHARE;
            let depth = scale + log2_abs(&bound.extinction) - settings.depth;
            let light = settings.light.map_or(f64::NEG_INFINITY, |allowed| {
                scale + log2_abs(&bound.light) + transmittance - allowed
            });
            let degree = (depth.max(light) / rho.log2()).ceil();
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Saturates.
            let degree = degree.max(0.0) as usize;
            Some((bound, degree.max(LEAST_DEGREE)))
        };
        let first = takes(RHOS[self.guess]);
        // What takes no more than the panel before is not searched for better.
        let fits = |found: &(Bound, usize)| found.1 <= self.last.min(settings.limit);
        if let Some((bound, _)) = first.clone().filter(fits) {
            return Ok((bound, self.last));
        }
        let mut best = first.map(|(bound, degree)| (self.guess, bound, degree));
        // Down to where there is a bound, and on while it gets better; else up.
        let mut search = |places: &mut dyn Iterator<Item = usize>| {
            for place in places {
                let found = takes(RHOS[place]);
                match (&best, found) {
                    (None, None) => {}
                    (Some(so_far), Some((bound, degree))) if degree < so_far.2 => {
                        best = Some((place, bound, degree));
                    }
                    (None, Some((bound, degree))) => best = Some((place, bound, degree)),
                    (Some(_), _) => break,
                }
            }
            best.as_ref().map(|best| best.0)
        };
        if search(&mut (0..self.guess).rev()) == Some(self.guess) {
            search(&mut (self.guess + 1..RHOS.len()));
        }
        let Some((place, bound, degree)) = best else {
            return Err(2);
        };
        self.guess = place;
        let limit = self.settings.limit;
        match degree.checked_next_power_of_two() {
            Some(degree) if degree <= limit => {
                self.last = degree;
                Ok((bound, degree))
            }
            Some(degree) if degree <= 8 * limit => Err(2),
            _ => Err(4),
        }
    }

    /// From the range of the medium alone; `false` where that is too rough.
    fn enclose_roughly(&mut self, panel: &Stretch) -> Result<bool, NotEnclosed> {
        let bits = self.settings.precision;
        let Some((emission, extinction)) = self.range(panel) else {
            return if panel.branches.is_none() {
                Err(NotEnclosed::NotBounded {
                    lambda: near(panel),
                })
            } else {
                Ok(false)
            };
        };
        let [from, to] = panel.ends();
        let zero = Interval::exactly(&Float::new(bits));
        let width = (&to - &from).max(&zero);
        let step = &width * &extinction;
        let within = &self.depth + &step.union(&zero);
        let light = &(&(&emission * &extinction) * &(-&within).exp()) * &width;
        if !step.is_finite() || self.settings.light.is_some() && !light.is_finite() {
            return Ok(false);
        }
        let is_fine = log2_abs(&step.width()) <= self.settings.depth - SHARE
            && self
                .settings
                .light
                .is_none_or(|allowed| log2_abs(&light.width()) <= allowed - SHARE);
        if !is_fine && panel.branches.is_some() {
            return Ok(false);
        }
        if self.settings.light.is_some() {
            self.light = &self.light + &light;
        }
        self.depth = &self.depth + &step;
        Ok(true)
    }

    /// All values of C and τ on a part of the ray, where they have a bound.
    fn range(&self, part: &Stretch) -> Option<(Interval, Interval)> {
        let [from, to] = part.ends();
        let whole = from.union(&to);
        let outputs = match &part.branches {
            Some(branches) => run(self.program, &self.constants, &whole, branches),
            None => hull(self.program, &self.constants, &whole),
        };
        let mut outputs = outputs.into_iter();
        outputs.next()?.zip(outputs.next()?)
    }

    /// Adds what is between the last number below the far end and the end.
    pub(super) fn finish(&mut self, end: &Interval) -> Result<(), NotEnclosed> {
        if end.lower() == end.upper() {
            return Ok(());
        }
        let lambda = end.lower().to_f64();
        let outputs = hull(self.program, &self.constants, end);
        let [Some(emission), Some(extinction)] = &outputs[..] else {
            return Err(NotEnclosed::NotBounded { lambda });
        };
        let width = &Interval::exactly(end.upper()) - &Interval::exactly(end.lower());
        let zero = Interval::exactly(&Float::new(self.settings.precision));
        let step = (&width * extinction).union(&zero);
        let within = &self.depth + &step;
        let light = &(&step * emission) * &(-&within).exp();
        if !step.is_finite() || !light.is_finite() {
            return Err(NotEnclosed::NotBounded { lambda });
        }
        // Behind a dark end the depth is less than it is: light is between that and none.
        self.light = &self.light + &light.union(&zero);
        self.depth = within;
        Ok(())
    }

    /// Whether all light from here on is less than what may be missed, which is then added.
    fn is_dark(&mut self, panel: &Stretch, rest: &[Stretch]) -> bool {
        let Some(allowed) = self.settings.light else {
            return false;
        };
        // Worth looking only behind a thick medium.
        if -log2_e(self.depth.lower()) > allowed.min(-16.0) {
            return false;
        }
        let mut brightest = Float::new(64);
        for stretch in rest.iter().chain([panel]) {
            let Some((emission, extinction)) = self.range(stretch) else {
                return false;
            };
            if !extinction.is_nonnegative() {
                return false;
            }
            let magnitude = emission.abs();
            if *magnitude.upper() > brightest {
                brightest.clone_from(magnitude.upper());
            }
        }
        let left = &Interval::exactly(&brightest) * &(-&self.depth).exp();
        if !left.is_finite() || log2_abs(left.upper()) > allowed - SHARE {
            return false;
        }
        self.light = &self.light + &left.union(&-&left);
        true
    }
}

/// The λ of a panel's near end, to the nearest binary64.
fn near(panel: &Stretch) -> f64 {
    let [from, _] = panel.ends();
    // 0, too, where it was rounded down to −0.
    from.midpoint().to_f64() + 0.0
}

/// log₂ e times x.
fn log2_e(x: &Float) -> f64 {
    x.to_f64() * std::f64::consts::LOG2_E
}

/// ± 8 h M ρ^(−n)/(ρ − 1): what an integral over a panel of half-width h, or over part of it, is off by.
fn remainder(bound: &Bound, magnitude: &Float, reach: &Interval, degree: usize) -> Interval {
    let bits = 64;
    let rho = Float::with_val(bits, bound.rho);
    let mut decay = Float::with_val(bits, 1);
    #[allow(clippy::cast_possible_truncation)] // A degree that there is a table of.
    let exponent = degree as u32;
    decay /= Float::with_val_round(bits, rug::ops::Pow::pow(&rho, exponent), Round::Down).0;
    decay.next_up();
    let less = Float::with_val_round(bits, &rho - 1_u32, Round::Down).0;
    let product = Float::with_val_round(bits, magnitude * reach.upper(), Round::Up).0;
    let product = Float::with_val_round(bits, &product * 8_u32, Round::Up).0;
    let product = Float::with_val_round(bits, &product * &decay, Round::Up).0;
    let product = Float::with_val_round(bits, &product / &less, Round::Up).0;
    let above = Interval::exactly(&product);
    above.union(&-&above)
}
