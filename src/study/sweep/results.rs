//! A finished study: what every report is made of.

use super::record::{Header, LevelRecord, Row, Theory, Unit};
use super::summary::{Summary, summarize};
use crate::case::Unproved;
use crate::convergence::{FitError, Verdict};
use crate::real::{FormatName, MpfrReal, Real};
use rug::{Float, Rational};
use std::collections::HashMap;
use std::f64::consts::LOG10_2;
use std::ops::RangeInclusive;

/// A finished study, in the order of its header.
#[derive(Clone, Debug)]
pub struct Results {
    /// What was run.
    pub header: Header,
    /// The bits of the formats that were swept for a map of digits; those are no formats of their own.
    pub sweep_bits: Option<RangeInclusive<u32>>,
    /// One line a case, method and format; by case, then by format, then by method.
    pub lines: Vec<Line>,
    /// What is not proved of the cases, each by its name.
    pub unproved: Vec<(String, Unproved)>,
}

/// One method on one case in one format.
#[derive(Clone, Debug)]
pub struct Line {
    /// The case.
    pub case: String,
    /// The format.
    pub format: String,
    /// Significant bits of the format.
    pub bits: u32,
    /// Only there for a map of digits.
    pub swept: bool,
    /// I.
    pub radiance: Float,
    /// Method and levels.
    pub row: Row,
    /// What the levels tell together.
    pub summary: Summary,
}

impl Results {
    /// Of the units of a study; `swept` tells of each format whether it is there for a map of digits alone.
    ///
    /// # Errors
    /// [`FitError`], which levels that ascend do not cause.
    pub fn new(
        header: Header,
        sweep_bits: Option<RangeInclusive<u32>>,
        units: Vec<Unit>,
        swept: &[bool],
    ) -> Result<Results, FitError> {
        let mut lines = Vec::new();
        let lengths = header.cases.iter().filter_map(|[name, length, ..]| {
            let length: Rational = length.parse().ok()?;
            Some((name.as_str(), length.to_f64()))
        });
        let lengths: HashMap<&str, f64> = lengths.collect();
        let mut unproved: Vec<(String, Unproved)> = Vec::new();
        for unit in units {
            for open in &unit.unproved {
                // Every format of a case has the same.
                let open = (unit.case.clone(), open.clone());
                if !unproved.contains(&open) {
                    unproved.push(open);
                }
            }
            let length = lengths.get(unit.case.as_str()).copied().unwrap_or(1.0);
            let format = header.formats.iter().position(|name| *name == unit.format);
            let swept = format.and_then(|i| swept.get(i)).copied().unwrap_or(false);
            for row in &unit.rows {
                lines.push(Line {
                    case: unit.case.clone(),
                    format: unit.format.clone(),
                    bits: unit.bits,
                    swept,
                    radiance: unit.radiance.clone(),
                    summary: summarize(&unit, row, length, header.errors)?,
                    row: row.clone(),
                });
            }
        }
        Ok(Results {
            header,
            sweep_bits,
            lines,
            unproved,
        })
    }

    /// Every case with every method, with the lines of all formats but those of the sweep.
    pub fn groups(&self) -> impl Iterator<Item = (&str, &str, Vec<&Line>)> {
        self.pairs(|line| !line.swept)
    }

    /// Every case with every method, with the lines of the sweep over bits, few to many.
    pub fn maps(&self) -> impl Iterator<Item = (&str, &str, Vec<&Line>)> {
        let pairs = self.pairs(|line| {
            self.sweep_bits.is_some() && line.format == format!("mpfr:{}", line.bits)
        });
        pairs.map(|(case, method, mut lines)| {
            let bits = self.sweep_bits.clone();
            lines.retain(|line| bits.as_ref().is_some_and(|bits| bits.contains(&line.bits)));
            lines.sort_by_key(|line| line.bits);
            (case, method, lines)
        })
    }

    fn pairs<'r>(
        &'r self,
        keep: impl Fn(&Line) -> bool + Copy + 'r,
    ) -> impl Iterator<Item = (&'r str, &'r str, Vec<&'r Line>)> {
        let mut lines: HashMap<(&str, &str), Vec<&Line>> = HashMap::new();
        for line in self.lines.iter().filter(|line| keep(line)) {
            let of = lines.entry((&line.case, &line.row.method)).or_default();
            of.push(line);
        }
        let cases = self.header.cases.iter();
        let pairs = cases.flat_map(|[case, ..]| {
            let methods = self.header.methods.iter();
            methods.map(move |method| (case.as_str(), method.as_str()))
        });
        pairs.map(move |pair| (pair.0, pair.1, lines.remove(&pair).unwrap_or_default()))
    }
}

impl Line {
    /// −log₁₀|total/I| at a level, at least 0: how many decimal digits are correct. No more than the format
    /// has; `None` where the error is unknown or not finite, or I is 0.
    #[must_use]
    pub fn digits(&self, level: &LevelRecord) -> Option<f64> {
        let log2 = |x: &Float| MpfrReal::from(x.clone()).log2_abs();
        let total = level.total.as_ref().filter(|total| total.is_finite())?;
        let size = log2(&self.radiance);
        let most = f64::from(self.bits) * LOG10_2;
        let digits = (size - log2(total)) * LOG10_2;
        size.is_finite().then(|| digits.min(most).max(0.0))
    }

    /// Whether the discretization, or the total error where that is all there is, says something else than theory, which no
    /// lack of levels, precision or sensitivity excuses. Of NaN and ∞ in a format it tells nothing: they are warnings.
    ///
    /// Of total errors neither do those in fixed point, whose numbers saturate without a sign, nor do signs that change
    /// before rounding ends the ladder: finer levels might have shown an order.
    #[must_use]
    pub fn contradicts_theory(&self) -> bool {
        let expected = self.row.expected;
        let found = self.summary.order();
        if self.summary.split.is_none() {
            let is_fixed = matches!(self.format.parse(), Ok(FormatName::Fixed(_)));
            let ended = found.verdict == Verdict::Oscillatory && found.cut.is_some();
            if is_fixed || ended || found.verdict == Verdict::NotFinite {
                return false;
            }
        }
        match found.verdict {
            Verdict::Diverged | Verdict::NotFinite => true,
            _ if expected == Theory::Unknown => false,
            Verdict::TooLow | Verdict::TooHigh | Verdict::Oscillatory => true,
            Verdict::Stalled => expected != Theory::Order(0.0),
            Verdict::Exact => expected != Theory::Exact,
            Verdict::Confirmed
            | Verdict::PreAsymptotic
            | Verdict::FloorLimited
            | Verdict::TooFewLevels
            | Verdict::Blind
            | Verdict::Fitted => false,
        }
    }
}
