//! Defects by name.

use super::line::Measured;
use super::{Line, Standing};
use crate::convergence::{Sample, Verdict};
use crate::diagnosis::{Fingerprint, Watched, jittered, likeness};
use crate::kernel::Declaration;
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
        let defect = growth(line).or_else(|| {
            let alike = likeness(watched, line.exact.to_f64())?;
            Some(alike.recipe.defect())
        });
        if let Some(defect) = defect {
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
fn growth(line: &Line) -> Option<String> {
    let Measured::Fitted { samples, .. } = &line.measured else {
        return None;
    };
    let size = |sample: &Sample| sample.error.to_f64().abs();
    let least = samples
        .iter()
        .enumerate()
        .min_by(|a, b| size(a.1).total_cmp(&size(b.1)))
        .map(|(index, _)| index)?;
    let growing = samples.get(least..)?;
    let [first, .., last] = growing else {
        return None;
    };
    let falls_first = least > 0;
    let orders = growing.windows(2).filter_map(|pair| match pair {
        [coarse, fine] => {
            Some((size(fine) / size(coarse)).log2() / (coarse.step / fine.step).log2())
        }
        _ => None,
    });
    // The first step out of the minimum is steeper or flatter by chance.
    let steady = orders.skip(1).all(|order| order > GROWS);
    let whole = (size(last) / size(first)).log2() / (first.step / last.step).log2();
    if !falls_first || growing.len() < 4 || !steady || whole < GROWS {
        return None;
    }
    let segments = last.n.unwrap_or(0).max(1) as f64;
    let scale = line.exact.to_f64().abs();
    let bits = (segments * scale / size(last)).log2().round();
    Some(format!(
        "errors grow with the number of segments, as rounding in a fixed-point accumulator of about {bits} bits does"
    ))
}

/// Errors that grow by a higher power of n than this are no walk.
const GROWS: f64 = 0.6;
