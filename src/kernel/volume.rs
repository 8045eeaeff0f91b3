//! The medium that a volume and its tables stand for: linear between grid points, linear between entries.

use super::cut::Places;
use super::{Cut, CutError, Samples, Segments, Table, Volume};
use crate::real::{Format, Native};
use rug::Rational;

impl Table {
    /// How many entries.
    #[must_use]
    pub fn entries(&self) -> usize {
        self.extinction.len()
    }

    /// The place of `s` among the entries, from 0 to their number less 1.
    fn place(&self, s: f64) -> f64 {
        let intervals = self.entries().saturating_sub(1) as f64;
        let width = self.last - self.first;
        let place = (s - self.first) / width * intervals;
        // Of a field that is the same everywhere all entries are the same.
        if place.is_finite() {
            place.clamp(0.0, intervals)
        } else {
            0.0
        }
    }

    /// τ(s), and into `emission` C(s) of every channel: linear between the entries.
    pub fn at(&self, s: f64, emission: &mut [f64]) -> f64 {
        let place = self.place(s);
        for (values, emission) in self.emission.iter().zip(emission) {
            *emission = between(values, place);
        }
        between(&self.extinction, place)
    }

    /// The same by the nearest entry.
    pub fn nearest(&self, s: f64, emission: &mut [f64]) -> f64 {
        let place = self.place(s).round();
        for (values, emission) in self.emission.iter().zip(emission) {
            *emission = between(values, place);
        }
        between(&self.extinction, place)
    }

    /// The table that is left of it with another number of entries.
    #[must_use]
    pub fn resampled(&self, entries: usize) -> Table {
        let mut table = Table {
            first: self.first,
            last: self.last,
            extinction: Vec::with_capacity(entries),
            emission: vec![Vec::with_capacity(entries); self.emission.len()],
        };
        let mut emission = vec![0.0; self.emission.len()];
        let intervals = entries.saturating_sub(1).max(1) as f64;
        for entry in 0..entries {
            let part = entry as f64 / intervals;
            let s = self.first * (1.0 - part) + self.last * part;
            table.extinction.push(self.at(s, &mut emission));
            for (all, one) in table.emission.iter_mut().zip(&emission) {
                all.push(*one);
            }
        }
        table
    }
}

/// Linear between values that stand at 0, 1, 2 …
fn between(values: &[f64], place: f64) -> f64 {
    let floor = place.floor();
    let part = place - floor;
    // A place lies between 0 and the number of values.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let index = floor as usize;
    let at = |index: usize| values.get(index).or(values.last()).copied();
    match (at(index), at(index + 1)) {
        (Some(near), Some(far)) => near * (1.0 - part) + far * part,
        _ => f64::NAN,
    }
}

impl Volume {
    /// How many cells there are between the grid points.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.field.len().saturating_sub(1)
    }

    /// s at a part of the ray, from 0 to 1.
    #[must_use]
    pub fn field_at(&self, part: f64) -> f64 {
        let cells = self.cells() as f64;
        between(&self.field, (part * cells).clamp(0.0, cells))
    }

    /// The medium's values where a kernel that cuts the ray so may look, C and τ by `lookup`.
    ///
    /// # Errors
    /// [`CutError`] where the ray cannot be cut so.
    pub fn segments(
        &self,
        length: &Rational,
        cut: Cut,
        lookup: impl Fn(&Table, f64, &mut [f64]) -> f64,
    ) -> Result<Segments, CutError> {
        Ok(self.at_places(cut.places(length)?, length, lookup))
    }

    /// The same of segments with these ends.
    #[must_use]
    pub fn segments_between(
        &self,
        edges: Vec<f64>,
        length: &Rational,
        lookup: impl Fn(&Table, f64, &mut [f64]) -> f64,
    ) -> Segments {
        self.at_places(Places::of(edges), length, lookup)
    }

    fn at_places(
        &self,
        places: Places,
        length: &Rational,
        lookup: impl Fn(&Table, f64, &mut [f64]) -> f64,
    ) -> Segments {
        let whole = Native::<f64>::new().ratio(length);
        let samples = |lambda: Vec<f64>| {
            let mut samples = Samples {
                emission: vec![Vec::new(); self.table.emission.len()],
                ..Samples::default()
            };
            let mut emission = vec![0.0; self.table.emission.len()];
            for at in &lambda {
                let s = self.field_at(at / whole);
                let extinction = lookup(&self.table, s, &mut emission);
                samples.extinction.push(extinction);
                for (all, one) in samples.emission.iter_mut().zip(&emission) {
                    all.push(*one);
                }
            }
            Samples { lambda, ..samples }
        };
        Segments {
            edges: samples(places.edges),
            middles: samples(places.middles),
        }
    }

    /// The ray cut wherever C or τ has a kink, as parts of its length: they are linear between.
    #[must_use]
    pub fn knots(&self) -> Vec<f64> {
        let cells = self.cells() as f64;
        let mut knots = vec![0.0];
        for (cell, ends) in self.field.windows(2).enumerate() {
            let &[near, far] = ends else { continue };
            let (from, to) = (self.table.place(near), self.table.place(far));
            let (low, high) = (from.min(to), from.max(to));
            let mut entry = low.floor() + 1.0;
            let mut inside = Vec::new();
            while entry < high {
                inside.push((entry - from) / (to - from));
                entry += 1.0;
            }
            inside.sort_by(f64::total_cmp);
            let cell = cell as f64;
            knots.extend(inside.into_iter().map(|part| (cell + part) / cells));
            knots.push((cell + 1.0) / cells);
        }
        knots.dedup();
        knots
    }
}
