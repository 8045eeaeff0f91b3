//! Widths: what is there, what is refused, and lanes that leave others alone.

use super::{FUNCTIONS, results};
use volver::real::lanes::{LaneFormat, LaneReal, Width, WidthError};
use volver::real::{AnyReal, Format, FormatName, Real};

#[test]
fn what_is_no_number_in_one_lane_leaves_the_others_alone() {
    for function in FUNCTIONS {
        for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
            for lane in 0..16 {
                let mut row: Vec<f64> = (0..16).map(|i| 0.3 * f64::from(i) - 2.0).collect();
                let right = results(Width::One, function, &row);
                row[lane] = wrong;
                let alone = results(Width::One, function, &row);
                for width in Width::there() {
                    let found = results(width, function, &row);
                    for (i, (found, right)) in found.iter().zip(&right).enumerate() {
                        if i == lane {
                            assert_eq!(
                                found.is_nan(),
                                alone[lane].is_nan(),
                                "{function:?} of {wrong}"
                            );
                            assert!(found.is_nan() || *found == alone[lane]);
                        } else {
                            assert_eq!(found.to_bits(), right.to_bits(), "{function:?} in {width}");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn infinities_and_nan_go_as_in_the_c_library() {
    for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for function in FUNCTIONS {
            let found = f64::from(results(Width::current(), function, &[x; 16])[3]);
            let truth = function.of_f64(f64::from(x));
            assert!(
                found == truth || (found.is_nan() && truth.is_nan()),
                "{function:?} of {x}"
            );
        }
    }
}

#[test]
fn rows_are_their_numbers_one_by_one() {
    let format = LaneFormat::<f32>::new();
    let any: FormatName = "f64-lanes".parse().unwrap();
    for count in [0_u32, 1, 3, 15, 16, 17, 130, 300] {
        let row: Vec<LaneReal<f32>> = (0..count)
            .map(|i| format.fraction(u64::from(i) * 7, 11))
            .collect();
        let mut found = row.clone();
        LaneReal::exp_row(&row, &mut found);
        assert!(found.iter().zip(&row).all(|(a, x)| *a == x.exp()));
        let mut cosines = row.clone();
        LaneReal::sin_cos_row(&row, &mut found, &mut cosines);
        let both = found.iter().zip(&cosines).zip(&row);
        assert!(
            both.into_iter()
                .all(|((sin, cos), x)| (*sin, *cos) == x.sin_cos())
        );

        let row: Vec<AnyReal> = (0..count)
            .map(|i| any.fraction(u64::from(i) * 7, 11))
            .collect();
        let mut found = row.clone();
        AnyReal::exp_m1_row(&row, &mut found);
        assert!(
            found
                .iter()
                .zip(&row)
                .all(|(a, x)| *a == x.clone().exp_m1())
        );
        let mut cosines = row.clone();
        AnyReal::sin_cos_row(&row, &mut found, &mut cosines);
        let both = found.iter().zip(&cosines).zip(&row);
        assert!(
            both.into_iter()
                .all(|((sin, cos), x)| (sin.clone(), cos.clone()) == x.clone().sin_cos())
        );
    }
}

#[test]
fn a_width_that_is_not_there_is_refused_in_one_line() {
    assert!(Width::One.is_there(), "every processor has it");
    assert_eq!("8".parse(), Ok(Width::Eight));
    for text in ["0", "2", "08", "+8", "eight", ""] {
        let error = text.parse::<Width>().unwrap_err();
        assert_eq!(
            error.to_string(),
            format!("'{text}' lanes (allowed: 1, 4, 8, 16)")
        );
    }
    let missing = WidthError::Missing {
        width: Width::Sixteen,
        instructions: Width::Sixteen.instructions(),
        allowed: "1, 4, 8".into(),
    };
    assert_eq!(
        missing.to_string(),
        "16 lanes need AVX-512, which this processor lacks (allowed: 1, 4, 8)"
    );
    for width in Width::ALL {
        assert_eq!(width.choose().is_ok(), width.is_there());
        assert!(!width.is_there() || Width::current() == width);
    }
}
