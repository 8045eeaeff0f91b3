//! Defects by name.

use super::line::Measured;
use super::{Line, Standing};
use crate::convergence::{Sample, Verdict};
use crate::diagnosis::{Fingerprint, Watched, jittered, likeness};
use crate::kernel::Declaration;
use crate::real::FormatName;
use std::collections::BTreeMap;

/// A defect, and where it shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// What is wrong, in words.
    pub defect: String,
    /// The channels that show it.
    pub channels: Vec<String>,
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
            defect: "answers differ from run to run, and the kernel is said to be deterministic"
                .into(),
            channels: unsteady,
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
    findings.extend(
        ordered
            .into_iter()
            .map(|(defect, channels)| Finding { defect, channels }),
    );
    findings
}

fn names<'a>(lines: impl Iterator<Item = &'a Line>) -> Vec<String> {
    lines.map(|line| line.name.clone()).collect()
}

/// Errors that fall first and then grow with the number of segments: every segment's rounding adds up.
fn grows(line: &Line, unit: f64) -> bool {
    let Measured::Fitted { samples, .. } = &line.measured else {
        return false;
    };
    let size = |sample: &Sample| sample.error.to_f64().abs();
    let sizes: Vec<f64> = samples.iter().map(size).collect();
    let least = sizes.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1));
    let Some((least, _)) = least else {
        return false;
    };
    let (Some(growing), Some([first, .., last])) = (sizes.get(least..), samples.get(least..))
    else {
        return false;
    };
    if least == 0 || growing.len() < FEWEST_GROWING {
        return false;
    }
    let falls = growing.windows(2).filter(|pair| pair[1] < pair[0]).count();
    let order = (size(last) / size(first)).log2() / (first.step / last.step).log2();
    // Beyond what as many roundings add up to by chance.
    let segments = last.n.unwrap_or(1) as f64;
    let walk = FAR * unit * segments.sqrt() * line.exact.to_f64().abs();
    falls <= 1 && order > GROWS && size(last) > walk
}

/// Levels from the least error on.
const FEWEST_GROWING: usize = 4;
/// Errors that grow by a higher power of n than this are no walk.
const GROWS: f64 = 0.6;
/// A walk does not come so many times as far as it does on average.
const FAR: f64 = 8.0;
/// So many channels, or all there are, must show it.
const FEWEST_CHANNELS: usize = 3;

/// The finding that errors grow, where that shows in several channels.
fn growth(declaration: &Declaration, lines: &[Line]) -> Option<Finding> {
    let unit = super::nominal::unit(declaration);
    let channels = names(lines.iter().filter(|line| grows(line, unit)));
    let enough = channels.len() >= FEWEST_CHANNELS.min(lines.len()).max(1);
    let defect = match declaration.format {
        FormatName::Fixed(_) => {
            "errors fall first and then grow with the number of segments: the fixed-point accumulator rounds at every segment, always the same way"
        }
        _ => {
            "errors fall first and then grow with the number of segments, as those of a fixed-point accumulator do, which rounds at every segment"
        }
    };
    enough.then(|| Finding {
        defect: defect.into(),
        channels,
    })
}
