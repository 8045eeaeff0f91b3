//! Defects by name.

use super::line::Measured;
use super::{Line, Standing};
use crate::convergence::{Sample, Verdict};
use crate::diagnosis::{Fingerprint, Watched, jittered, likeness};
use crate::kernel::Declaration;
use std::collections::BTreeMap;
use std::ops::RangeInclusive;

/// A defect, and where it shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// What is wrong, in words.
    pub defect: String,
    /// The channels that show it.
    pub channels: Vec<String>,
    /// Whether it speaks against the kernel: that answers scatter does not where it says that they do.
    pub wrong: bool,
}

/// All defects that show, those of the whole kernel first.
pub(super) fn findings(
    declaration: &Declaration,
    lines: &[Line],
    watched: &[Watched],
    fingerprint: Option<&Fingerprint>,
) -> Vec<Finding> {
    let mut findings = Vec::new();
    let unsteady: Vec<String> = names(lines.iter().filter(|line| !line.steady));
    if !unsteady.is_empty() {
        findings.push(Finding {
            defect: if declaration.stochastic {
                "the same seed has two answers".into()
            } else {
                "answers differ from run to run, and the kernel is said to be deterministic".into()
            },
            channels: unsteady,
            wrong: true,
        });
    }
    if declaration.stochastic || lines.iter().any(|line| !line.steady) {
        findings.extend(jittered(watched).map(|found| {
            Finding {
                defect: format!("{found}"),
                channels: found
                    .agrees
                    .iter()
                    .map(|&i| lines[i].name.clone())
                    .collect(),
                wrong: !declaration.stochastic,
            }
        }));
        return findings;
    }
    findings.extend(growth(declaration, lines));
    let mut by_defect: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let explained = |index: usize| {
        let best = fingerprint.and_then(|found| found.best.as_ref());
        best.is_some_and(|best| best.agrees.contains(&index))
    };
    for (index, (line, watched)) in lines.iter().zip(watched).enumerate() {
        let suspicious = matches!(line.standing, Standing::Contradicted)
            || !matches!(
                line.measured.verdict(),
                Verdict::Confirmed | Verdict::Exact | Verdict::Blind | Verdict::FloorLimited
            );
        if explained(index) || !suspicious || !line.is_complete() {
            continue;
        }
        if let Some(alike) = likeness(watched, line.exact.to_f64()) {
            let defect = alike.recipe.defect();
            by_defect.entry(defect).or_default().push(line.name.clone());
        }
    }
    let mut ordered: Vec<(String, Vec<String>)> = by_defect.into_iter().collect();
    ordered.sort_by_key(|(_, channels)| std::cmp::Reverse(channels.len()));
    findings.extend(ordered.into_iter().map(|(defect, channels)| Finding {
        defect,
        channels,
        wrong: true,
    }));
    findings
}

fn names<'a>(lines: impl Iterator<Item = &'a Line>) -> Vec<String> {
    lines.map(|line| line.name.clone()).collect()
}

/// Errors that grow in proportion to the number of segments by a small part of the radiance a segment: every
/// segment's rounding adds up. The bits of a fixed point that rounds so; `None` where they do not.
fn bits_lost(line: &Line, unit: f64) -> Option<f64> {
    let Measured::Fitted { samples, .. } = &line.measured else {
        return None;
    };
    let size = |sample: &Sample| sample.error.to_f64().abs();
    let growing = samples.get(samples.len().checked_sub(GROWING)?..)?;
    let [first, .., last] = growing else {
        return None;
    };
    let falls = growing.windows(2).filter(|pair| match pair {
        [coarse, fine] => size(fine) < size(coarse),
        _ => false,
    });
    let order = (size(last) / size(first)).log2() / (first.step / last.step).log2();
    let radiance = line.exact.to_f64().abs();
    // Beyond what as many roundings add up to by chance.
    let segments = last.n.unwrap_or(1) as f64;
    let is_far = size(last) > FAR * unit * segments.sqrt() * radiance;
    let bits = (segments * radiance / size(last)).log2();
    let is_fixed = FIXED_BITS.contains(&bits);
    (falls.count() <= 1 && order > GROWS && is_far && is_fixed).then_some(bits)
}

/// The finest levels, over which errors must grow.
const GROWING: usize = 4;
/// Errors that grow by a higher power of n than this are no walk.
const GROWS: f64 = 0.6;
/// A walk does not come so many times as far as it does on average.
const FAR: f64 = 8.0;
/// Accumulators of renderers: coarser ones show nothing, finer ones are binary32.
const FIXED_BITS: RangeInclusive<f64> = 6.0..=20.0;
/// So many channels, or all there are, must show it.
const FEWEST_CHANNELS: usize = 3;

/// The finding that errors grow, where that shows in several channels.
fn growth(declaration: &Declaration, lines: &[Line]) -> Option<Finding> {
    let unit = super::nominal::unit(declaration);
    let growing: Vec<(&Line, f64)> = lines
        .iter()
        .filter_map(|line| Some((line, bits_lost(line, unit)?)))
        .collect();
    if growing.len() < FEWEST_CHANNELS.min(lines.len()).max(1) {
        return None;
    }
    let mut bits: Vec<f64> = growing.iter().map(|(_, bits)| *bits).collect();
    bits.sort_by(f64::total_cmp);
    let middle = bits.get(bits.len() / 2).map_or(0.0, |bits| bits.round());
    Some(Finding {
        defect: format!(
            "errors grow with the number of segments: a fixed-point accumulator, of about {middle} bits, rounds at every segment, always the same way"
        ),
        channels: names(growing.into_iter().map(|(line, _)| line)),
        wrong: true,
    })
}
