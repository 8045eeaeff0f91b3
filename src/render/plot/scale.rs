//! From coordinates to places.

use crate::document::Scale as Kind;

/// A stretch of an axis, and the pixels it takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::render) struct Scale {
    pub(super) low: f64,
    pub(super) high: f64,
    /// Where `low` and `high` stand.
    pixels: (f64, f64),
}

/// What is left free at both ends, of the whole.
const MARGIN: f64 = 0.05;
/// A logarithmic axis has so many decades at least: less would make noise of nothing.
const DECADES: f64 = 1.0;
/// A relative change below this is drawn as none.
const FLAT: f64 = 1e-6;
/// Values between 0 and so many times the greatest: the axis begins at 0.
const FROM_ZERO: f64 = 0.7;

impl Scale {
    /// Just this stretch.
    pub(in crate::render) fn new((low, high): (f64, f64), pixels: (f64, f64)) -> Self {
        Scale { low, high, pixels }
    }

    /// A scale with room for all that is finite; `None` where nothing is.
    pub(super) fn around(
        places: impl Iterator<Item = f64>,
        kind: Kind,
        pixels: (f64, f64),
    ) -> Option<Self> {
        // Differences of larger numbers are no numbers.
        let finite = places.filter(|place| place.abs() <= f64::MAX / 8.0);
        let ends = finite.fold(None, |ends: Option<(f64, f64)>, place| {
            let (low, high) = ends.unwrap_or((place, place));
            Some((low.min(place), high.max(place)))
        });
        let (low, high) = match kind {
            Kind::Linear => with_zero(ends?),
            Kind::Log => ends?,
        };
        let room = match kind {
            Kind::Log => (MARGIN * (high - low)).max((DECADES - (high - low)) / 2.0),
            Kind::Linear => MARGIN * (high - low),
        };
        Some(Scale::new((low - room, high + room), pixels))
    }

    pub(in crate::render) fn pixel(&self, place: f64) -> f64 {
        let share = (place - self.low) / (self.high - self.low);
        self.pixels.0 + share * (self.pixels.1 - self.pixels.0)
    }

    pub(super) fn has(&self, place: f64) -> bool {
        (self.low..=self.high).contains(&place)
    }

    /// Whether anything between two places is on it.
    pub(super) fn meets(&self, from: f64, to: f64) -> bool {
        from.min(to) <= self.high && from.max(to) >= self.low
    }
}

/// Ends that have 0 between them or as one of them, where the values are near it or all the same.
fn with_zero((low, high): (f64, f64)) -> (f64, f64) {
    let size = low.abs().max(high.abs());
    if size == 0.0 {
        (-1.0, 1.0)
    } else if high - low <= FLAT * size {
        (low.min(0.0), high.max(0.0))
    } else if low >= 0.0 && low <= FROM_ZERO * high {
        (0.0, high)
    } else if high <= 0.0 && high >= FROM_ZERO * low {
        (low, 0.0)
    } else {
        (low, high)
    }
}
