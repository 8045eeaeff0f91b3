//! What the cases tell together.

use super::{Cost, Point, Results};
use serde::Serialize;
use std::collections::BTreeMap;

/// The model is held to this factor.
const FACTOR: f64 = 1.5;

/// How often a method in a format is on the front.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Standing {
    /// The method's name.
    pub method: String,
    /// The format's name.
    pub format: String,
    /// On the fronts of how many cases.
    pub cases: usize,
    /// With how many points in all.
    pub points: usize,
}

/// How well modelled and measured time agree.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Agreement {
    /// The format's name; `None` for all together.
    pub format: Option<String>,
    /// Points within a factor of 1.5.
    pub within: usize,
    /// Points that have both times.
    pub points: usize,
}

impl Agreement {
    /// The share within, `None` of no points.
    #[must_use]
    pub fn share(&self) -> Option<f64> {
        (self.points > 0).then(|| self.within as f64 / self.points as f64)
    }
}

/// Every method and format that is on a front, those of most cases first.
#[must_use]
pub fn standings(results: &Results, cost: Cost) -> Vec<Standing> {
    let mut found: BTreeMap<(String, String), (usize, usize)> = BTreeMap::new();
    for case in &results.cases {
        let mut here: BTreeMap<(String, String), usize> = BTreeMap::new();
        for (unit, point) in case.front(cost) {
            let key = (point.method.name(), unit.format.to_string());
            *here.entry(key).or_default() += 1;
        }
        for (key, points) in here {
            let entry = found.entry(key).or_default();
            entry.0 += 1;
            entry.1 += points;
        }
    }
    let mut standings: Vec<Standing> = found
        .into_iter()
        .map(|((method, format), (cases, points))| Standing {
            method,
            format,
            cases,
            points,
        })
        .collect();
    // The sort is stable: names decide among equals.
    standings.sort_by_key(|s| std::cmp::Reverse((s.cases, s.points)));
    standings
}

/// How well the model does in every format and in all; nothing where nothing was timed.
#[must_use]
pub fn agreement(results: &Results) -> Vec<Agreement> {
    let timed = |point: &Point| Some((point.modelled?, point.measured?.median));
    let units = || results.cases.iter().flat_map(|case| &case.units);
    let of = |format: Option<&String>| {
        let matching = units().filter(|unit| format.is_none_or(|f| unit.format.to_string() == *f));
        let times = matching.flat_map(|unit| &unit.points).filter_map(timed);
        let mut agreement = Agreement {
            format: format.cloned(),
            within: 0,
            points: 0,
        };
        for (modelled, measured) in times {
            agreement.points += 1;
            let ratio = modelled / measured;
            agreement.within += usize::from((1.0 / FACTOR..=FACTOR).contains(&ratio));
        }
        agreement
    };
    let formats = results.header.formats.iter().map(|format| of(Some(format)));
    let all = std::iter::once(of(None));
    formats.chain(all).filter(|a| a.points > 0).collect()
}
