//! What every report is made of.

use super::{Cost, Goal, Point, Unit, cheapest, front};
use crate::case::Unproved;
use crate::study::sweep::Header;
use rug::Float;

/// A finished comparison.
#[derive(Clone, Debug)]
pub struct Results {
    /// What was run.
    pub header: Header,
    /// By which cost points are compared.
    pub cost: Cost,
    /// Whether the measuring thread stayed on one core; `None` where nothing was timed.
    pub pinned: Option<bool>,
    /// By case.
    pub cases: Vec<CaseResults>,
}

/// All runs on one case.
#[derive(Clone, Debug)]
pub struct CaseResults {
    /// The case.
    pub name: String,
    /// I.
    pub radiance: Float,
    /// What I rests on and is not proved.
    pub unproved: Vec<Unproved>,
    /// By format.
    pub units: Vec<Unit>,
}

impl Results {
    /// Of units by case, then by format.
    #[must_use]
    pub fn new(header: Header, cost: Cost, pinned: Option<bool>, units: Vec<Unit>) -> Results {
        let mut cases: Vec<CaseResults> = Vec::new();
        for unit in units {
            match cases.last_mut().filter(|case| case.name == unit.case) {
                Some(case) => case.units.push(unit),
                None => cases.push(CaseResults {
                    name: unit.case.clone(),
                    radiance: unit.radiance.clone(),
                    unproved: unit.unproved.clone(),
                    units: vec![unit],
                }),
            }
        }
        Results {
            header,
            cost,
            pinned,
            cases,
        }
    }
}

impl CaseResults {
    /// Whether errors are relative to |I|; they are absolute where I is 0.
    #[must_use]
    pub fn is_relative(&self) -> bool {
        !self.radiance.is_zero()
    }

    /// What was asked for: all but what is there for comparison alone.
    pub fn points(&self) -> impl Iterator<Item = (&Unit, &Point)> {
        let all = self
            .units
            .iter()
            .flat_map(|unit| unit.points.iter().map(move |point| (unit, point)));
        all.filter(|(_, point)| !point.only_usual)
    }

    /// The Pareto front, from cheap to exact.
    #[must_use]
    pub fn front(&self, cost: Cost) -> Vec<(&Unit, &Point)> {
        let points: Vec<(&Unit, &Point)> = self.points().collect();
        let places: Vec<Option<(f64, Float)>> = points
            .iter()
            .map(|(_, point)| Some((cost.of(point)?, point.outcome.error()?)))
            .collect();
        let on_front = front(&places).into_iter();
        on_front
            .filter_map(|index| points.get(index).copied())
            .collect()
    }

    /// The cheapest way to each error.
    #[must_use]
    pub fn goals(&self, cost: Cost) -> Vec<Goal<'_>> {
        let units: Vec<&Unit> = self.units.iter().collect();
        cheapest(&units, cost)
    }
}
