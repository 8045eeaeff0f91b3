//! From coordinates to places.

/// A stretch of an axis, and the pixels it takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    pub(super) low: f64,
    pub(super) high: f64,
    /// Where `low` and `high` stand.
    pixels: (f64, f64),
}

/// What is left free at both ends, of the whole.
const MARGIN: f64 = 0.05;

impl Scale {
    /// A scale with room for all that is finite; `None` where nothing is.
    pub(super) fn around(places: impl Iterator<Item = f64>, pixels: (f64, f64)) -> Option<Self> {
        // Differences of larger numbers are no numbers.
        let finite = places.filter(|place| place.abs() <= f64::MAX / 8.0);
        let ends = finite.fold(None, |ends: Option<(f64, f64)>, place| {
            let (low, high) = ends.unwrap_or((place, place));
            Some((low.min(place), high.max(place)))
        });
        let (low, high) = ends?;
        let room = if high > low {
            (high - low) * MARGIN
        } else {
            // One place alone stands in the middle.
            0.5 * high.abs().max(1.0)
        };
        Some(Scale {
            low: low - room,
            high: high + room,
            pixels,
        })
    }

    pub(super) fn pixel(&self, place: f64) -> f64 {
        let share = (place - self.low) / (self.high - self.low);
        self.pixels.0 + share * (self.pixels.1 - self.pixels.0)
    }

    pub(super) fn has(&self, place: f64) -> bool {
        (self.low..=self.high).contains(&place)
    }
}
