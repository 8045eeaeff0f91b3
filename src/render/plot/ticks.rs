//! Where an axis has ticks, and what stands at them.

use super::scale::Scale;
use crate::document::Scale as Kind;

/// A place on an axis with its label; places between have none.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    pub(super) at: f64,
    pub(super) label: Option<String>,
}

/// About so many labels.
const MOST: f64 = 7.0;

pub(super) fn ticks(scale: &Scale, kind: Kind) -> Vec<Tick> {
    let span = scale.high - scale.low;
    match kind {
        Kind::Linear => spaced(scale, step(span / MOST), linear),
        Kind::Log if span > MOST => spaced(scale, step(span / MOST).max(1.0), power),
        Kind::Log => decades(scale, span),
    }
}

/// 1, 2 or 5 times a power of ten, and not less than `least`.
fn step(least: f64) -> f64 {
    let power = 10_f64.powf(least.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|k| k * power);
    let found = steps.into_iter().find(|step| *step >= least * (1.0 - 1e-9));
    found.unwrap_or(10.0 * power)
}

fn spaced(scale: &Scale, step: f64, label: fn(f64, f64) -> String) -> Vec<Tick> {
    let first = (scale.low / step).ceil();
    let place = |k: f64| (first + k) * step;
    (0_u8..=20)
        .map(|k| place(f64::from(k)))
        .take_while(|at| *at <= scale.high)
        .map(|at| Tick {
            at,
            label: Some(label(at, step)),
        })
        .collect()
}

/// Powers of ten; where there are few of them, twice and five times those too.
fn decades(scale: &Scale, span: f64) -> Vec<Tick> {
    let mut ticks = Vec::new();
    // At most a few decades, the first of which may begin below.
    for k in 0_u8..=9 {
        let decade = scale.low.floor() + f64::from(k);
        for (digit, factor) in (1_u8..=9).map(|digit| (digit, f64::from(digit).log10())) {
            let at = decade + factor;
            if !scale.has(at) {
                continue;
            }
            let label = match digit {
                1 => Some(power(decade, 1.0)),
                2 | 5 if span < 2.5 => Some(multiple(digit, decade)),
                _ => None,
            };
            ticks.push(Tick { at, label });
        }
    }
    let labels = ticks.iter().filter(|tick| tick.label.is_some()).count();
    if labels >= 2 {
        ticks
    } else {
        even(scale, span)
    }
}

/// Where no round numbers are: places at equal distances, with three digits.
fn even(scale: &Scale, span: f64) -> Vec<Tick> {
    let at = |share: f64| scale.low + share * span;
    [0.125, 0.375, 0.625, 0.875]
        .map(|share| Tick {
            at: at(share),
            label: Some(digits(at(share))),
        })
        .into()
}

fn linear(at: f64, step: f64) -> String {
    if at == 0.0 || at.abs() < step / 2.0 {
        return "0".into();
    }
    if !(1e-3..1e6).contains(&at.abs()) {
        return format!("{at:.1e}");
    }
    let decimals = (-step.log10()).ceil().max(0.0);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Between 0 and 9.
    let decimals = decimals.min(9.0) as usize;
    format!("{at:.decimals$}")
}

/// "1000", "10⁻¹²".
fn power(decade: f64, _step: f64) -> String {
    multiple(1, decade)
}

/// "200", "5·10⁻⁷".
fn multiple(digit: u8, decade: f64) -> String {
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

/// "316", "3.16·10⁻⁷", of a decimal logarithm.
fn digits(log10: f64) -> String {
    let decade = log10.floor();
    let mantissa = 10_f64.powf(log10 - decade);
    if (0.0..=3.0).contains(&decade) {
        let value = mantissa * 10_f64.powf(decade);
        return if decade < 2.0 {
            format!("{value:.2}")
        } else {
            format!("{value:.0}")
        };
    }
    format!("{mantissa:.2}·{}", multiple(1, decade))
}

fn raised(c: char) -> char {
    match c {
        '-' => '⁻',
        '0' => '⁰',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        other => {
            char::from_u32(u32::from(other) - u32::from('4') + u32::from('⁴')).unwrap_or(other)
        }
    }
}
