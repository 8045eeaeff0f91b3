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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_finite_has_no_place() {
        let nothing = [f64::NAN, f64::INFINITY];
        assert_eq!(Scale::around(nothing.into_iter(), (0.0, 1.0)), None);
        let scale = Scale::around([f64::NAN, 1.0, 3.0].into_iter(), (100.0, 0.0)).unwrap();
        assert!((scale.pixel(2.0) - 50.0).abs() < 1e-9);
        assert!(scale.has(1.0) && scale.has(3.0) && !scale.has(3.2));
        assert!(scale.pixel(3.0) < scale.pixel(1.0));
    }

    #[test]
    fn one_place_alone_stands_in_the_middle() {
        for place in [0.0, -400.0, 1e300] {
            let scale = Scale::around([place].into_iter(), (0.0, 10.0)).unwrap();
            assert!((scale.pixel(place) - 5.0).abs() < 1e-9, "{place}");
        }
    }
}
