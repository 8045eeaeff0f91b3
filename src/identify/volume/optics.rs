//! How a kernel looks at a volume: where its samples lie, and what it reads of the grid and of the table.

use crate::identify::pose::profile::{at, hats, plain};
use crate::identify::pose::steps::Steps;
use crate::identify::ray::Ray;
use crate::identify::rule::{Along, Lattice, plus};
use crate::kernel::{Segments, Table, Volume};
use std::fmt;

/// What is taken between two values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Lookup {
    /// The line between both.
    #[default]
    Linear,
    /// The nearer one.
    Nearest,
    /// The one before.
    Below,
}

/// Where samples lie, and what they read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Optics {
    /// Where samples lie along λ.
    pub lattice: Lattice,
    /// How many cells of the grid the march begins behind λ = 0, and ends behind λ = D.
    pub cells: [f64; 2],
    /// Between grid points.
    pub field: Lookup,
    /// Between entries.
    pub table: Lookup,
    /// Entries that a table of E has more than E − 1 intervals: the place of s is (s − first)/(last − first)
    /// (E − 1 + `intervals`) + `shift` among the entries 0, 1, …, E − 1.
    pub intervals: f64,
    /// See `intervals`.
    pub shift: f64,
}

impl Default for Optics {
    fn default() -> Self {
        Optics {
            lattice: Lattice::Steps {
                place: 0.5,
                own_last: true,
            },
            cells: [0.0; 2],
            field: Lookup::Linear,
            table: Lookup::Linear,
            intervals: 0.0,
            shift: 0.0,
        }
    }
}

/// Cells a segment, and entries a segment, of volumes made for samples to see what they are to see.
const CELLS: usize = 8;
const ENTRIES: usize = 16;

impl Lookup {
    /// The values that count at a place among them, and by how much: v[i] (1 − f) + v[j] f.
    fn between(self, place: f64, count: usize) -> (usize, usize, f64) {
        let last = count.saturating_sub(1);
        let place = place.clamp(0.0, last as f64);
        let whole = match self {
            Lookup::Linear | Lookup::Below => place.floor(),
            Lookup::Nearest => (place + 0.5).floor(),
        };
        // Clamped above.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let i = (whole as usize).min(last);
        match self {
            Lookup::Linear => (i, (i + 1).min(last), place - whole),
            Lookup::Nearest | Lookup::Below => (i, i, 0.0),
        }
    }

    pub(super) fn of(self, values: &[f64], place: f64) -> f64 {
        let (i, j, part) = self.between(place, values.len());
        match (values.get(i), values.get(j)) {
            (Some(near), Some(far)) => near + (far - near) * part,
            _ => f64::NAN,
        }
    }
}

impl Optics {
    /// What is to be read with samples at the same part of their segments: linear, from end to end.
    pub(in crate::identify) fn right(&self) -> Self {
        Optics {
            lattice: self.lattice.covering(),
            ..Optics::default()
        }
    }

    /// The lattice on a grid of m cells.
    pub(super) fn on_grid(&self, cells: usize) -> Lattice {
        match self.lattice {
            Lattice::Even {
                place,
                start,
                end,
                count,
            } => {
                let moved = |along: Along, by: f64| Along {
                    part: along.part + by / cells as f64,
                    ..along
                };
                Lattice::Even {
                    place,
                    start: moved(start, self.cells[0]),
                    end: moved(end, self.cells[1]),
                    count,
                }
            }
            steps @ Lattice::Steps { .. } => steps,
        }
    }

    /// The place of s among the entries of a table.
    fn entry(&self, table: &Table, s: f64) -> f64 {
        let intervals = table.entries() as f64 - 1.0 + self.intervals;
        let width = table.last - table.first;
        let part = if width == 0.0 {
            0.0
        } else {
            (s - table.first) / width
        };
        part * intervals + self.shift
    }

    /// τ and C at λ of a ray of that length.
    fn at(&self, volume: &Volume, length: f64, lambda: f64, emission: &mut [f64]) -> f64 {
        let place = lambda / length * volume.cells() as f64;
        let s = self.field.of(&volume.field, place);
        let entry = self.entry(&volume.table, s);
        for (values, emission) in volume.table.emission.iter().zip(emission) {
            *emission = self.table.of(values, entry);
        }
        self.table.of(&volume.table.extinction, entry)
    }

    /// The places among the entries of what the samples see, in their order.
    pub(super) fn entries(&self, volume: &Volume, steps: &Steps) -> Vec<f64> {
        let (lambda, _) = self.on_grid(volume.cells()).places(steps);
        let cells = volume.cells() as f64;
        let last = volume.table.entries() as f64 - 1.0;
        let of = |lambda: &f64| {
            let s = self.field.of(&volume.field, lambda / steps.length * cells);
            let place = self.entry(&volume.table, s).clamp(0.0, last);
            match self.table {
                Lookup::Linear => place,
                Lookup::Nearest => (place + 0.5).floor(),
                Lookup::Below => place.floor(),
            }
        };
        lambda.iter().map(of).collect()
    }

    /// The ray as such a kernel cuts it, and its step.
    pub(in crate::identify) fn cut(&self, volume: &Volume, steps: &Steps) -> (Segments, f64) {
        let at =
            |lambda: f64, emission: &mut [f64]| self.at(volume, steps.length, lambda, emission);
        let channels = volume.table.emission.len();
        self.on_grid(volume.cells()).cut(steps, at, channels)
    }

    /// A volume, and how it is cut, in which the samples see the middles of a ray's segments: the field is λ, and each
    /// entry holds what the sample next to it is to see.
    pub(in crate::identify) fn around(&self, ray: &Ray) -> Option<(Volume, Steps)> {
        let wanted = ray.segments.count();
        let cells = CELLS * wanted;
        let lattice = self.on_grid(cells);
        let steps = lattice.around(&Steps::of(ray), wanted)?;
        let (lambda, _) = lattice.places(&steps);
        let entries = ENTRIES * lambda.len() + 1;
        let field: Vec<f64> = ramp(steps.length, cells + 1);
        let mut table = Table {
            first: 0.0,
            last: steps.length,
            extinction: vec![0.0; entries],
            emission: vec![Vec::new(); ray.channels.len()],
        };
        let place = |lambda: &f64| {
            let at = lambda / steps.length * cells as f64;
            self.entry(&table, self.field.of(&field, at))
        };
        let places: Vec<f64> = lambda.iter().map(place).collect();
        let mut nearest = 0;
        let of_entry: Vec<usize> = (0..entries)
            .map(|entry| {
                let away = |k: usize| (places[k] - entry as f64).abs();
                while nearest + 1 < places.len() && away(nearest + 1) < away(nearest) {
                    nearest += 1;
                }
                nearest
            })
            .collect();
        let middles = &ray.segments.middles;
        let seen = |values: &[f64]| -> Vec<f64> {
            let value = |k: &usize| values.get(*k).copied().unwrap_or(0.0);
            of_entry.iter().map(value).collect()
        };
        table.extinction = seen(&middles.extinction);
        table.emission = middles.emission.iter().map(|c| seen(c)).collect();
        Some((Volume { field, table }, steps))
    }
}

/// The medium of a ray through a volume whose field is λ.
pub(in crate::identify) fn tabulated(ray: &Ray) -> Volume {
    let knots = plain(ray);
    let length = ray.segments.edges.lambda.last().copied().unwrap_or(0.0);
    let entries = ENTRIES * ray.segments.count() + 1;
    let field = ramp(length, CELLS * ray.segments.count() + 1);
    let mut table = Table {
        first: 0.0,
        last: length,
        extinction: Vec::with_capacity(entries),
        emission: vec![Vec::with_capacity(entries); ray.channels.len()],
    };
    let mut emission = vec![0.0; ray.channels.len()];
    for lambda in ramp(length, entries) {
        table.extinction.push(at(&knots, lambda, &mut emission));
        for (all, one) in table.emission.iter_mut().zip(&emission) {
            all.push(*one);
        }
    }
    Volume { field, table }
}

/// From 0 to D.
pub(super) fn ramp(length: f64, count: usize) -> Vec<f64> {
    let last = count.saturating_sub(1).max(1) as f64;
    (0..count).map(|i| length * (i as f64 / last)).collect()
}

/// For the samples of a volume.
pub(super) fn lit_entries(length: f64, count: usize, extinction: f64, bright: f64) -> Table {
    let knots = hats(length, count, extinction, bright);
    Table {
        first: 0.0,
        last: length,
        extinction: knots.extinction,
        emission: knots.emission,
    }
}

impl fmt::Display for Lookup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Lookup::Linear => "linear",
            Lookup::Nearest => "nearest",
            Lookup::Below => "the one before",
        })
    }
}

/// As formulas.
impl fmt::Display for Optics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [begin, end] = self.cells;
        write!(f, "{}", self.lattice)?;
        if begin.abs() > 0.0 || end.abs() > 0.0 {
            write!(f, ", from {begin} to {end} cells behind these ends")?;
        }
        write!(f, "; grid {}; table {}", self.field, self.table)?;
        f.write_str(", entry (s − first)/(last − first) ")?;
        if (self.intervals - 1.0).abs() > 0.0 {
            f.write_str("(E")?;
            plus(f, self.intervals - 1.0)?;
            f.write_str(")")?;
        } else {
            f.write_str("E")?;
        }
        plus(f, self.shift)
    }
}
