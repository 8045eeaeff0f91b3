//! Numbers with few digits.

/// The simplest number between two: with the fewest digits, or 1 by an integer; their middle where none is simpler.
#[must_use]
pub(crate) fn simplest(low: f64, high: f64) -> f64 {
    let (low, high) = if low <= high {
        (low, high)
    } else {
        (high, low)
    };
    if low < 0.0 && high < 0.0 {
        return -simplest(-high, -low);
    }
    if low <= 0.0 && high >= 0.0 {
        return 0.0;
    }
    let middle = f64::midpoint(low, high);
    for digits in 0..=9_usize {
        if let Ok(short) = format!("{middle:.digits$e}").parse::<f64>()
            && (low..=high).contains(&short)
        {
            return short;
        }
        if digits == 2 {
            let parts = (1.0 / middle).round();
            if (2.0..=65_536.0).contains(&parts) && (low..=high).contains(&(1.0 / parts)) {
                return 1.0 / parts;
            }
            if let Some(constant) = KNOWN.iter().find(|c| (low..=high).contains(*c)) {
                return *constant;
            }
        }
    }
    middle
}

/// Constants that programs have with all their digits.
const KNOWN: [f64; 9] = [
    std::f64::consts::PI,
    std::f64::consts::TAU,
    std::f64::consts::FRAC_1_PI,
    std::f64::consts::LN_2,
    std::f64::consts::LOG2_E,
    std::f64::consts::E,
    std::f64::consts::SQRT_2,
    1.0 / 2.2,
    1.0 / 2.4,
];

/// The simplest within a part of `x`.
#[must_use]
pub(super) fn simplest_near(x: f64, relative: f64) -> f64 {
    let width = x.abs() * relative;
    simplest(x - width, x + width)
}
