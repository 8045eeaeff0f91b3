//! Where an axis has ticks, and what stands at them.

use super::scale::Scale;
use crate::document::Scale as Kind;

/// A place on an axis with its label; places between have none.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::render) struct Tick {
    pub(in crate::render) at: f64,
    pub(in crate::render) label: Option<String>,
}

/// About so many labels.
const MOST: f64 = 7.0;
/// Numbers of these magnitudes are written out.
const PLAIN: std::ops::RangeInclusive<i32> = -3..=4;

/// The ticks, and the power of ten that all labels are times, where it is not 1.
pub(in crate::render) fn ticks(scale: &Scale, kind: Kind) -> (Vec<Tick>, Option<i32>) {
    let span = scale.high - scale.low;
    let ticks = match kind {
        Kind::Linear => return multiples(scale, span),
        Kind::Log if span > MOST => {
            let (multiple, e) = step((span / MOST).max(1.0));
            let places = places(scale, f64::from(multiple) * ten_to(e));
            let tick = |(_, at)| Tick {
                at,
                label: Some(power(1, at)),
            };
            places.map(tick).collect()
        }
        Kind::Log => decades(scale, span),
    };
    (ticks, None)
}

/// Round numbers at equal distances.
fn multiples(scale: &Scale, span: f64) -> (Vec<Tick>, Option<i32>) {
    let (multiple, e) = step(span / MOST);
    #[expect(clippy::cast_possible_truncation, reason = "exponents of binary64")]
    let magnitude = scale.low.abs().max(scale.high.abs()).log10().floor() as i32;
    let common = if PLAIN.contains(&magnitude) {
        0
    } else {
        magnitude
    };
    let decimals = usize::try_from(common - e).unwrap_or(0);
    let label = |count: f64| {
        // Adding 0 makes 0 of −0.
        let shown = count * f64::from(multiple) * ten_to(e - common) + 0.0;
        format!("{shown:.decimals$}")
    };
    let ticks = places(scale, f64::from(multiple) * ten_to(e)).map(|(count, at)| Tick {
        at,
        label: Some(label(count)),
    });
    (ticks.collect(), Some(common).filter(|common| *common != 0))
}

/// 1, 2 or 5 and the power of ten that it is times: not less than `least`.
fn step(least: f64) -> (u8, i32) {
    #[expect(clippy::cast_possible_truncation, reason = "exponents of binary64")]
    let e = least.log10().floor() as i32;
    let steps = [(1, e), (2, e), (5, e), (1, e + 1)];
    let is_enough =
        |(multiple, e): &(u8, i32)| f64::from(*multiple) * ten_to(*e) >= least * (1.0 - 1e-9);
    steps.into_iter().find(is_enough).unwrap_or((2, e + 1))
}

/// 10ᵉ, as exact as binary64 holds it where e is small.
fn ten_to(e: i32) -> f64 {
    if e >= 0 {
        10_f64.powi(e)
    } else {
        10_f64.powi(-e).recip()
    }
}

/// How many steps, and the place.
fn places(scale: &Scale, step: f64) -> impl Iterator<Item = (f64, f64)> {
    let (first, high) = ((scale.low / step).ceil(), scale.high);
    let counts = (0_u8..=20).map(move |k| first + f64::from(k));
    counts
        .map(move |count| (count, count * step))
        .take_while(move |(_, at)| *at <= high)
}

/// Powers of ten; where there are few of them, twice and five times those too.
fn decades(scale: &Scale, span: f64) -> Vec<Tick> {
    let mut ticks = Vec::new();
    // At most a few decades, the first of which may begin below.
    for k in 0_u8..=9 {
        let decade = scale.low.floor() + f64::from(k);
        for (digit, factor) in (1_u8..=9).map(|digit| (digit, f64::from(digit).log10())) {
            let at = decade + factor;
            if scale.has(at) {
                let is_labelled = digit == 1 || matches!(digit, 2 | 5) && span < 2.5;
                let label = is_labelled.then(|| power(digit, decade));
                ticks.push(Tick { at, label });
            }
        }
    }
    ticks
}

/// "200", "5·10⁻⁷", "10⁻¹²".
pub(in crate::render) fn power(digit: u8, decade: f64) -> String {
    let decade = decade.round();
    if (0.0..=4.0).contains(&decade) {
        return format!("{:.0}", f64::from(digit) * 10_f64.powf(decade));
    }
    let exponent: String = format!("{decade:.0}").chars().map(raised).collect();
    match digit {
        1 => format!("10{exponent}"),
        _ => format!("{digit}·10{exponent}"),
    }
}

fn raised(c: char) -> char {
    match c {
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
    }
}
