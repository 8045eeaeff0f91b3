//! What is refused, and rounding of quotients of integers.

use super::{Fixed, nearest};
use crate::real::{Format, FormatError};

#[test]
fn quotients_round_to_nearest_and_ties_to_even() {
    // By hand: −2.5, −1.5, −0.5, 0.5, 1.5, 2.5 and beside them.
    let halves = [(-5, -2), (-3, -2), (-1, 0), (1, 0), (3, 2), (5, 2)];
    for (numerator, expected) in halves {
        assert_eq!(nearest(numerator, 2), expected, "{numerator}/2");
    }
    for (numerator, expected) in [(-8, -3), (-7, -2), (-4, -1), (4, 1), (7, 2), (8, 3), (9, 3)] {
        assert_eq!(nearest(numerator, 3), expected, "{numerator}/3");
    }
}

#[test]
fn what_is_out_of_range_is_refused_with_what_is_allowed() {
    for (integer, fraction) in [(17, 15), (16, 0), (16, 31), (u32::MAX, u32::MAX)] {
        let error = Fixed::new(integer, fraction).unwrap_err();
        assert_eq!(error, FormatError::FixedRange { integer, fraction });
        assert_eq!(
            error.to_string(),
            format!(
                "format 'fixed:{integer}.{fraction}' is out of range (allowed: fixed:INTEGER.FRACTION with 0 ≤ INTEGER ≤ 16, 1 ≤ FRACTION ≤ 30)"
            )
        );
    }
}

#[test]
fn the_bits_are_those_after_the_point() {
    let format = Fixed::new(8, 24).unwrap();
    assert_eq!(
        (format.bits(), format.integer_bits(), format.fraction_bits()),
        (24, 8, 24)
    );
}
