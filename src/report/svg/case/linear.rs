//! Linear axes with round numbers.

use super::super::scale::{power_of_ten, whole_ticks};

/// A relative change below this is drawn as none: its ticks would be too long to read.
const FLAT: f64 = 1e-6;
/// Values between 0 and so many times the greatest: the axis begins at 0.
const FROM_ZERO: f64 = 0.7;

/// The range of an axis, the labels of its ticks, and the power of ten that all of them are times.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    pub(super) range: (f64, f64),
    pub(super) ticks: Vec<(f64, String)>,
    pub(super) exponent: Option<i32>,
}

/// The axis for values, finite ones only; `None` without any.
pub(super) fn axis(values: impl Iterator<Item = f64>, most: usize) -> Option<Axis> {
    let (low, high) = extent(values)?;
    let size = low.abs().max(high.abs());
    let (low, high) = if size == 0.0 {
        (-1.0, 1.0)
    } else if high - low <= FLAT * size {
        // A constant has 0 on the axis too.
        (low.min(0.0), high.max(0.0))
    } else if low >= 0.0 && low <= FROM_ZERO * high {
        (0.0, high)
    } else if high <= 0.0 && high >= FROM_ZERO * low {
        (low, 0.0)
    } else {
        (low, high)
    };
    let margin = 0.06 * (high - low);
    Some(ticks_between((low - margin, high + margin), most))
}

/// The axis for logarithms to base 10.
pub(super) fn logarithmic(values: impl Iterator<Item = f64>, most: usize) -> Option<Axis> {
    let (low, high) = extent(values)?;
    let margin = 0.06 * (high - low).max(1.0);
    let range = (low - margin, high + margin);
    let ticks = whole_ticks(range, most).into_iter();
    Some(Axis {
        range,
        ticks: ticks.map(|tick| (tick, power_of_ten(tick))).collect(),
        exponent: None,
    })
}

fn extent(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let values = values.filter(|value| value.is_finite());
    let ends = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
        (low.min(v), high.max(v))
    });
    (ends.0 <= ends.1).then_some(ends)
}

/// An axis of just that range, with ticks at multiples of 1, 2 or 5 times a power of ten.
#[expect(clippy::cast_possible_truncation, reason = "exponents of binary64")]
pub(super) fn ticks_between((low, high): (f64, f64), most: usize) -> Axis {
    let mut axis = Axis {
        range: (low, high),
        ticks: Vec::new(),
        exponent: None,
    };
    let width = high - low;
    if !(width > 0.0 && width.is_finite()) {
        return axis;
    }
    let fits = |step: f64| (high / step).floor() - (low / step).ceil() < most as f64;
    let finest = (width / most as f64).log10().floor() as i32;
    let steps = (finest..=finest + 2).flat_map(|e| [1.0, 2.0, 5.0].map(|m| (m, e)));
    let Some((multiple, e)) = steps.into_iter().find(|(m, e)| fits(m * ten_to(*e))) else {
        return axis;
    };
    let step = multiple * ten_to(e);
    let magnitude = low.abs().max(high.abs()).log10().floor() as i32;
    let exponent = if (-3..=4).contains(&magnitude) {
        0
    } else {
        magnitude
    };
    let decimals = usize::try_from(exponent - e).unwrap_or(0);
    let mut count = (low / step).ceil();
    while count * step <= high && axis.ticks.len() < most {
        // Adding 0 makes 0 of −0.
        let shown = count * multiple * ten_to(e - exponent) + 0.0;
        axis.ticks
            .push((count * step, format!("{shown:.decimals$}")));
        count += 1.0;
    }
    axis.exponent = Some(exponent).filter(|exponent| *exponent != 0);
    axis
}

/// 10ᵉ, as exact as binary64 holds it where e is small.
fn ten_to(e: i32) -> f64 {
    if e >= 0 {
        10_f64.powi(e)
    } else {
        10_f64.powi(-e).recip()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(values: &[f64]) -> Vec<String> {
        let axis = axis(values.iter().copied(), 4).unwrap();
        axis.ticks.into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn ticks_are_round_and_begin_at_zero() {
        assert_eq!(labels(&[0.1, 0.84]), ["0.0", "0.5"]);
        assert_eq!(labels(&[1.0, 2.0]), ["0", "1", "2"]);
        assert_eq!(labels(&[-1.0, 1.0]), ["-1", "0", "1"]);
        assert_eq!(labels(&[0.9, 1.0]), ["0.90", "0.95", "1.00"]);
    }

    #[test]
    fn constants_and_zero_have_an_axis() {
        assert_eq!(labels(&[3.0, 3.0]), ["0", "1", "2", "3"]);
        assert_eq!(labels(&[0.0, 0.0]), ["-1", "0", "1"]);
        assert!(axis([f64::NAN].into_iter(), 4).is_none());
        assert!(ticks_between((0.0, 0.0), 4).ticks.is_empty());
        assert!(ticks_between((0.0, f64::INFINITY), 4).ticks.is_empty());
    }

    #[test]
    fn small_and_large_numbers_are_times_a_power_of_ten() {
        let small = axis([0.0, 2e-5].into_iter(), 4).unwrap();
        assert_eq!(small.exponent, Some(-5));
        let labels: Vec<&str> = small.ticks.iter().map(|(_, text)| text.as_str()).collect();
        assert_eq!(labels, ["0", "1", "2"]);
        assert_eq!(axis([0.0, 3e6].into_iter(), 4).unwrap().exponent, Some(6));
        assert_eq!(axis([0.0, 1000.0].into_iter(), 4).unwrap().exponent, None);
    }
}
