//! From logarithms to pixels, and where the ticks stand.

/// A linear map from values to pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    low: f64,
    high: f64,
    at_low: f64,
    at_high: f64,
}

impl Scale {
    /// `low` is drawn at pixel `at_low`, `high` at `at_high`; a single value in the middle.
    pub(super) fn new((low, high): (f64, f64), (at_low, at_high): (f64, f64)) -> Scale {
        Scale {
            low,
            high,
            at_low,
            at_high,
        }
    }

    pub(super) fn pixel(&self, value: f64) -> f64 {
        let width = self.high - self.low;
        let share = if width > 0.0 {
            (value - self.low) / width
        } else {
            0.5
        };
        self.at_low + share * (self.at_high - self.at_low)
    }

    /// Pixels a unit, negative where pixels fall as values grow.
    pub(super) fn pixels_a_unit(&self) -> f64 {
        (self.at_high - self.at_low) / (self.high - self.low).max(f64::MIN_POSITIVE)
    }
}

/// The range of values with a margin on both sides, at least `least` wide; `None` without values.
pub(super) fn range(
    values: impl IntoIterator<Item = f64>,
    margin: f64,
    least: f64,
) -> Option<(f64, f64)> {
    let (low, high) = values
        .into_iter()
        .filter(|v| v.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(v), high.max(v))
        });
    if low > high {
        return None;
    }
    let margin = margin.max((least - (high - low)) / 2.0);
    Some((low - margin, high + margin))
}

/// Whole numbers in `(low, high)` at a step of 1, 2, 5, 10 …, the finest that gives at most `most`.
pub(super) fn whole_ticks((low, high): (f64, f64), most: usize) -> Vec<f64> {
    let mut step = 1.0;
    for factor in [2.0, 2.5, 2.0].into_iter().cycle() {
        if (high / step).floor() - (low / step).ceil() < most.max(1) as f64 {
            break;
        }
        step *= factor;
    }
    let mut ticks = Vec::new();
    let mut tick = (low / step).ceil() * step;
    while tick <= high && ticks.len() < most {
        ticks.push(tick);
        tick += step;
    }
    ticks
}

/// Which of the labels, given by (center, width) in drawing order, to keep so that none touch.
/// Every second, third … is kept, so that the distances stay even.
pub(super) fn apart(labels: &[(f64, f64)], gap: f64) -> Vec<usize> {
    let fits = |stride: usize| {
        let kept: Vec<_> = labels.iter().step_by(stride).collect();
        kept.windows(2)
            .all(|pair| (pair[1].0 - pair[0].0).abs() >= f64::midpoint(pair[0].1, pair[1].1) + gap)
    };
    let stride = (1..labels.len()).find(|&s| fits(s));
    (0..labels.len())
        .step_by(stride.unwrap_or(labels.len().max(1)))
        .collect()
}

/// 10ᵏ as people write it: `10⁻⁴`.
pub(super) fn power_of_ten(exponent: f64) -> String {
    let digits = format!("{exponent:.0}");
    let raised = digits.chars().map(|c| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        '9' => '⁹',
        _ => '⁰',
    });
    "10".chars().chain(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_become_pixels() {
        let scale = Scale::new((-4.0, 0.0), (200.0, 0.0));
        assert_eq!(scale.pixel(-1.0), 50.0);
        assert_eq!(scale.pixels_a_unit(), -50.0);
        assert_eq!(Scale::new((3.0, 3.0), (0.0, 10.0)).pixel(3.0), 5.0);
    }

    #[test]
    fn ranges_ignore_what_is_not_finite() {
        let values = [f64::NAN, -3.0, f64::NEG_INFINITY, -1.0];
        assert_eq!(range(values, 0.5, 1.0), Some((-3.5, -0.5)));
        assert_eq!(range([2.0], 0.5, 4.0), Some((0.0, 4.0)));
        assert_eq!(range([f64::NAN], 0.5, 1.0), None);
    }

    #[test]
    fn ticks_are_whole_and_few() {
        assert_eq!(whole_ticks((-3.2, 0.4), 8), [-3.0, -2.0, -1.0, 0.0]);
        assert_eq!(whole_ticks((-16.3, 0.0), 6), [-15.0, -10.0, -5.0, 0.0]);
        let wide = whole_ticks((-30_000.0, 0.0), 7);
        assert!(wide.len() >= 3 && wide.len() <= 7, "{wide:?}");
        assert!(wide.iter().all(|t| *t % 5000.0 == 0.0), "{wide:?}");
    }

    #[test]
    fn labels_are_thinned_evenly() {
        let labels: Vec<(f64, f64)> = (0..10).map(|i| (10.0 * f64::from(i), 12.0)).collect();
        assert_eq!(apart(&labels, 2.0), [0, 2, 4, 6, 8]);
        assert_eq!(apart(&labels[..2], 20.0), [0]);
        assert!(apart(&[], 1.0).is_empty());
    }

    #[test]
    fn powers_are_raised() {
        assert_eq!(power_of_ten(-12.0), "10⁻¹²");
        assert_eq!(power_of_ten(0.0), "10⁰");
        assert_eq!(power_of_ten(305.0), "10³⁰⁵");
    }
}
