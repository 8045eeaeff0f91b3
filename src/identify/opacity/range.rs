//! Where a law ends: the points that leave it, by kind, and the border by bisection.

use super::Measurements;
use super::fit::{Fitted, has};
use super::measure::{Measurer, Point};
use crate::identify::number::simplest;
use crate::identify::rule::{Formula, Law, Series, Shape};
use crate::identify::session::Session;
use crate::identify::{self, NotIdentified, Parameter};

/// Lengths at which borders are looked for: both must say the same.
const LENGTHS: [f64; 2] = [1.0, 0.25];
/// Bisections end at this part.
const FINE: f64 = 1e-8;
/// Extinctions of one ray of a bisection.
const AT_ONCE: usize = 18;
/// How near to a border that is guessed it is asked: nearer than a bisection has to come.
const NEAR: f64 = FINE / 4.0;

/// The law with what explains the points that leave it.
pub(super) fn with_range(
    session: &mut Session<'_>,
    measurer: &Measurer<'_>,
    measured: &Measurements,
    fitted: Fitted,
) -> Result<Fitted, NotIdentified> {
    let mut found = fitted;
    let mut search = Search {
        session,
        measurer,
        measured,
        brackets: Vec::new(),
    };
    for explain in [
        Search::skipped,
        Search::uncorrected,
        Search::saturated,
        Search::clamped,
        Search::series,
    ] {
        if search.wrong(&found.law).is_empty() {
            break;
        }
        if let Some(law) = explain(&mut search, &found.law)? {
            found.law = law;
        }
    }
    if search.wrong(&found.law).is_empty() {
        found.share = 1.0;
        found.brackets.append(&mut search.brackets);
        return Ok(found);
    }
    let rows = search.wrong(&found.law);
    let rows = rows.iter().map(|p| {
        let (weight, passes) = found.law.of(&p.extinction, &p.length, &p.ray);
        vec![
            p.extinction,
            p.length,
            p.weight.value,
            weight,
            p.passes.value,
            passes,
        ]
    });
    Err(
        NotIdentified::new("a law for most segments, but not for all of them").with_rows(
            &[
                "extinction",
                "length",
                "weight",
                "by the law",
                "let through",
                "by the law",
            ],
            rows.take(12).collect(),
        ),
    )
}

struct Search<'s, 'k, 'm> {
    session: &'s mut Session<'k>,
    measurer: &'m Measurer<'m>,
    measured: &'m Measurements,
    /// Of what was bisected.
    brackets: Vec<identify::Bracket>,
}

/// Two numbers between which a border lies.
type Bracket = (f64, f64);

/// Extinctions just below and just above where a border may be, of those between which it is.
type Guesses<'g> = dyn Fn(Bracket) -> Vec<Bracket> + 'g;

/// Just below and just above.
fn about(at: f64) -> Bracket {
    (at * (1.0 - NEAR), at * (1.0 + NEAR))
}

/// A little more than it.
fn around((low, high): Bracket) -> Bracket {
    (low * (1.0 - NEAR / 4.0), high * (1.0 + NEAR / 4.0))
}

/// The extinction between two at which a rising function has that value.
fn inverse(of: &dyn Fn(f64) -> f64, value: f64, (low, high): Bracket) -> f64 {
    let (mut low, mut high) = (low, high);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if of(middle) < value {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

fn overlap(one: Bracket, other: Bracket) -> Option<Bracket> {
    let low = one.0.max(other.0);
    let high = one.1.min(other.1);
    (low <= high * (1.0 + 1e-6)).then_some((low.min(high), high.max(low)))
}

impl Search<'_, '_, '_> {
    fn keep(&mut self, parameter: Parameter, bracket: Bracket) {
        self.brackets
            .push(identify::Bracket::of(parameter, bracket));
    }

    /// The points that do not have the law.
    fn wrong(&self, law: &Law) -> Vec<Point> {
        let answers = self.measurer.answers;
        let all = self.measured.points.iter();
        all.filter(|p| !has(law, p, answers)).copied().collect()
    }

    /// The border between `low` and `high` where `holds` becomes true: by bisection, and at what is guessed.
    fn border(
        &mut self,
        length: f64,
        (low, high): Bracket,
        guesses: &Guesses<'_>,
        holds: &dyn Fn(&Point) -> bool,
    ) -> Result<Option<Bracket>, NotIdentified> {
        let Some(reference) = self.measured.reference(length).copied() else {
            return Ok(None);
        };
        let (mut low, mut high) = (low, high);
        for _ in 0..12 {
            if high / low - 1.0 <= FINE {
                break;
            }
            // Thick ones would hide what is behind: ask few at once.
            let is_thick =
                high * length > 12.0 * reference.extinction * length && high * length > 0.4;
            let guessed = if is_thick {
                Vec::new()
            } else {
                guesses((low, high))
            };
            let guessed = guessed.into_iter().flat_map(|(under, over)| [under, over]);
            let mut taus: Vec<f64> = guessed.filter(|tau| *tau > low && *tau < high).collect();
            let even = if is_thick { 3 } else { AT_ONCE } - taus.len();
            let parts = (even + 1) as f64;
            taus.extend((1..=even).map(|k| low * (high / low).powf(k as f64 / parts)));
            taus.sort_by(f64::total_cmp);
            let mut held = Vec::new();
            if is_thick {
                for tau in &taus {
                    let points = self.measurer.points(self.session, &reference, &[*tau])?;
                    held.push(points.first().is_some_and(holds));
                }
            } else {
                let points = self.measurer.points(self.session, &reference, &taus)?;
                held.extend(points.iter().take(taus.len()).map(holds));
            }
            let first = held.iter().position(|held| *held);
            // Above the border all must hold: else there is no border.
            if first.is_some_and(|first| held[first..].iter().any(|held| !held)) {
                return Ok(None);
            }
            match first {
                Some(0) => high = taus[0],
                Some(k) => (low, high) = (taus[k - 1], taus[k]),
                None => low = taus.last().copied().unwrap_or(low),
            }
        }
        Ok(Some((low, high)))
    }

    /// An opacity is compared as the kernel has it: by subtraction it is off by a unit of 1.
    fn rounded(&self, (low, high): Bracket) -> Bracket {
        let off = 2.0 * self.measurer.answers.unit;
        (low - off, high + off)
    }

    /// Small opacities that count for nothing.
    fn skipped(&mut self, law: &Law) -> Result<Option<Law>, NotIdentified> {
        let nothing = |p: &Point| {
            p.weight.value.abs() <= 3.0 * p.weight.error
                && (p.passes.value - 1.0).abs() <= 3.0 * p.passes.error
        };
        let skipped: Vec<Point> = self.wrong(law).into_iter().filter(|p| nothing(p)).collect();
        let of = |tau: f64, length: f64| law.shape.of(&law.depth.of(&tau, &length, &f64::NAN)).0;
        let mut brackets: Vec<(f64, Bracket)> = Vec::new();
        for length in LENGTHS {
            let here = |p: &&Point| (p.length - length).abs() < 1e-12;
            let Some(low) = largest(skipped.iter().filter(here)) else {
                continue;
            };
            let all = self.measured.points.iter().filter(here);
            let over = all.filter(|p| !nothing(p) && p.extinction > low);
            let Some(high) = smallest(over) else { continue };
            let here = |tau: f64| of(tau, length);
            let before = brackets.first().copied();
            // The same opacity as at the other length, or the same extinction; else a simple one of either.
            let guesses = |both: Bracket| {
                if let Some((other, (low, high))) = before {
                    let same = |tau: f64| inverse(&here, of(tau, other), both);
                    vec![around((same(low), same(high))), around((low, high))]
                } else {
                    let opacity = simplest(here(both.0), here(both.1));
                    let by_opacity = inverse(&here, opacity, both);
                    vec![about(by_opacity), about(simplest(both.0, both.1))]
                }
            };
            let border = self.border(length, (low, high), &guesses, &|p| !nothing(p))?;
            brackets.extend(border.map(|border| (length, border)));
        }
        let [(one, first), (other, second)] = brackets.as_slice() else {
            return Ok(None);
        };
        let opacity =
            |length: f64, (low, high): Bracket| self.rounded((of(low, length), of(high, length)));
        let mut law = law.clone();
        if let Some(both) = overlap(opacity(*one, *first), opacity(*other, *second)) {
            law.range.skip = Some(border_of(both));
            self.keep(Parameter::Skip, both);
        } else if let Some(both) = overlap(*first, *second) {
            law.range.skip_extinction = Some(border_of(both));
            self.keep(Parameter::SkipExtinction, both);
        } else {
            return Ok(None);
        }
        Ok(Some(law))
    }

    /// Small opacities that are not corrected for the step.
    fn uncorrected(&mut self, law: &Law) -> Result<Option<Law>, NotIdentified> {
        let mut wrong = self.wrong(law);
        wrong.retain(|p| law.depth.of(&p.extinction, &p.length, &p.ray) < 0.3);
        let of = |p: &Point| {
            Shape::Exponential.depth(1.0 - p.passes.value, p.passes.value) / p.extinction
        };
        let usable = |p: &&Point| {
            p.passes.value.is_finite() && (1.0 - p.passes.value).abs() > 100.0 * p.passes.error
        };
        let mut lengths: Vec<f64> = wrong.iter().filter(usable).map(of).collect();
        lengths.sort_by(f64::total_cmp);
        let Some(&middle) = lengths.get(lengths.len() / 2) else {
            return Ok(None);
        };
        let length = simplest(middle * (1.0 - 1e-3), middle * (1.0 + 1e-3));
        let is_bare = |p: &Point| {
            let bare = Law {
                depth: crate::identify::rule::Depth {
                    factor: length,
                    length: crate::identify::rule::Power::ZERO,
                    ..law.depth
                },
                ..law.clone()
            };
            has(&bare, p, self.measurer.answers)
        };
        if !wrong.iter().filter(usable).all(&is_bare) {
            return Ok(None);
        }
        let unit = |tau: f64| -(-tau * length).exp_m1();
        let mut brackets: Vec<Bracket> = Vec::new();
        for step in [0.25, 0.0625, 0.7] {
            if (step - length).abs() < 1e-3 {
                // There both say the same.
                continue;
            }
            let here = |p: &&Point| (p.length - step).abs() < 1e-12;
            let Some(low) = largest(wrong.iter().filter(usable).filter(here)) else {
                continue;
            };
            let all = self.measured.points.iter().filter(here);
            let answers = self.measurer.answers;
            let over = all.filter(|p| has(law, p, answers) && p.extinction > low);
            let Some(high) = smallest(over) else { continue };
            let before = brackets.first().copied();
            let guesses = |both: Bracket| {
                let simple = || simplest(unit(both.0), unit(both.1));
                let by_opacity = || about(inverse(&unit, simple(), both));
                vec![before.map_or_else(by_opacity, around)]
            };
            let border = self.border(step, (low, high), &guesses, &|p| has(law, p, answers))?;
            brackets.extend(border);
        }
        let opacity = |(low, high): &Bracket| self.rounded((unit(*low), unit(*high)));
        let mut opacities = brackets.iter().map(opacity);
        let first = opacities.next();
        let both = opacities.fold(first, |both, next| overlap(both?, next));
        let Some(both) = both else {
            return Ok(None);
        };
        let mut law = law.clone();
        self.keep(Parameter::Uncorrected, both);
        law.range.uncorrected_under = Some(border_of(both));
        law.range.uncorrected_length = length;
        Ok(Some(law))
    }

    /// Thick segments that all have one opacity, or one extinction.
    #[expect(clippy::unnecessary_wraps, reason = "as those that ask")]
    fn clamped(&mut self, law: &Law) -> Result<Option<Law>, NotIdentified> {
        let wrong = self.wrong(law);
        let answers = self.measurer.answers;
        let near_one = 1e-9 + 64.0 * answers.unit;
        // α from what is let through; where nothing is, from a weight that is that of 1.
        let opacity = |p: &&Point| -> Option<(f64, f64)> {
            let deep = law.depth.of(&p.extinction, &p.length, &p.ray) > 0.3;
            if p.passes.value.is_finite() {
                let passes = p.passes.value - law.eps;
                return deep.then_some((1.0 - passes, p.passes.error));
            }
            let is_one = (p.weight.value / law.scale.0 - 1.0).abs() <= near_one;
            (deep && is_one).then_some((1.0, near_one))
        };
        // What is let through has left the law, not only the weight.
        let leaves = |p: &&Point| {
            let (_, passes) = law.of(&p.extinction, &p.length, &p.ray);
            let off = (p.passes.value - passes).abs();
            off.is_nan() || off > 3.0 * p.passes.error + 16.0 * answers.unit + answers.noise
        };
        let top: Vec<&Point> = wrong
            .iter()
            .filter(|p| opacity(p).is_some() && leaves(p))
            .collect();
        if top.len() < 2 {
            return Ok(None);
        }
        let mut best: Option<(Law, identify::Bracket)> = None;
        let opacities: Vec<(f64, f64)> = top.iter().filter_map(opacity).collect();
        let (least, most) = opacities
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), o| {
                (l.min(o.0), h.max(o.0))
            });
        let error = opacities.iter().map(|o| o.1).fold(f64::INFINITY, f64::min);
        let slack = 3.0 * error + 64.0 * answers.unit + answers.noise;
        let level = f64::midpoint(least, most);
        if most - least <= 4.0 * slack + 1e-15 {
            let mut clamped = law.clone();
            clamped.range.opacity_max = Some(simplest(level - slack, level + slack));
            let bracket = (level - slack, level + slack);
            best = Some((
                clamped,
                identify::Bracket::of(Parameter::OpacityClamp, bracket),
            ));
            // The same with the depth's own words where that is simpler.
            let depth = law.shape.depth(level, 1.0 - level);
            let steep = slack / (1.0 - level).abs().max(1e-12);
            let short = simplest(depth - steep, depth + steep);
            if digits(short) + 2 < digits(simplest(level - slack, level + slack)) {
                let mut clamped = law.clone();
                clamped.range.depth_max = Some(short);
                let bracket = (depth - steep, depth + steep);
                best = Some((
                    clamped,
                    identify::Bracket::of(Parameter::DepthClamp, bracket),
                ));
            }
        }
        if let Some((found, bracket)) = best
            && self.wrong(&found).len() < wrong.len()
        {
            self.brackets.push(bracket);
            return Ok(Some(found));
        }
        // By extinction: what is let through grows with the length alone.
        let depths = top.iter().filter(|p| p.passes.value > 0.0).map(|p| {
            let x = law.shape.depth(1.0 - p.passes.value, p.passes.value);
            x / law.depth.of(&1.0, &p.length, &p.ray)
        });
        let mut depths: Vec<f64> = depths.filter(|x| x.is_finite()).collect();
        depths.sort_by(f64::total_cmp);
        if let Some(&middle) = depths.get(depths.len() / 2) {
            let mut clamped = law.clone();
            let both = (middle * (1.0 - 1e-9), middle * (1.0 + 1e-9));
            clamped.range.extinction_max = Some(simplest(both.0, both.1));
            if self.wrong(&clamped).len() + 1 < wrong.len() {
                // In formats of fewer digits it is not known to so many.
                if answers.unit < 1e-10 {
                    self.keep(Parameter::ExtinctionClamp, both);
                }
                return Ok(Some(clamped));
            }
        }
        Ok(None)
    }

    /// 1 − (1 − α₁)^d, which ends where 1 − α₁ is all rounding.
    #[expect(clippy::unnecessary_wraps, reason = "as those that ask")]
    fn saturated(&mut self, law: &Law) -> Result<Option<Law>, NotIdentified> {
        let wrong = self.wrong(law);
        if law.shape != Shape::Exponential || !wrong.iter().all(|p| p.extinction > 4.0) {
            return Ok(None);
        }
        let mut power = law.clone();
        power.formula = Formula::Power;
        Ok((self.wrong(&power).len() < wrong.len()).then_some(power))
    }

    /// Another formula below a depth.
    fn series(&mut self, law: &Law) -> Result<Option<Law>, NotIdentified> {
        let x = |p: &Point| law.depth.of(&p.extinction, &p.length, &p.ray);
        let mut wrong = self.wrong(law);
        wrong.retain(|p| x(p) < 0.5);
        let answers = self.measurer.answers;
        let Some(deepest) = wrong
            .iter()
            .map(x)
            .fold(None, |m: Option<f64>, x| Some(m.map_or(x, |m| m.max(x))))
        else {
            return Ok(None);
        };
        let all = self.measured.points.iter();
        let over = all.filter(|p| has(law, p, answers) && x(p) > deepest);
        let Some(next) = over.map(x).min_by(f64::total_cmp) else {
            return Ok(None);
        };
        if law.shape != Shape::Exponential {
            return Ok(None);
        }
        let length = 0.25;
        let per = law.depth.of(&1.0, &length, &f64::NAN);
        let guesses = |(low, high): Bracket| vec![about(simplest(low * per, high * per) / per)];
        let both = (deepest / per, next / per);
        let border = self.border(length, both, &guesses, &|p| has(law, p, answers))?;
        let Some((low, high)) = border else {
            return Ok(None);
        };
        let below = border_of((low * per, high * per));
        for terms in 1..=8 {
            let mut series = law.clone();
            series.range.series = Some(Series { below, terms });
            let explained = self.wrong(&series);
            if !explained.iter().any(|p| x(p) < 0.5) {
                self.keep(Parameter::Series, (low * per, high * per));
                return Ok(Some(series));
            }
        }
        Ok(None)
    }
}

fn digits(x: f64) -> usize {
    format!("{x:e}").len()
}

fn largest<'p>(points: impl Iterator<Item = &'p Point>) -> Option<f64> {
    points.map(|p| p.extinction).max_by(f64::total_cmp)
}

fn smallest<'p>(points: impl Iterator<Item = &'p Point>) -> Option<f64> {
    points.map(|p| p.extinction).min_by(f64::total_cmp)
}

/// A border's simplest value.
fn border_of((low, high): Bracket) -> f64 {
    simplest(low * (1.0 - 1e-12), high * (1.0 + 1e-12))
}
