//! Memory and time foreseen.

use super::fixture::sweep;
use volver::study::sweep::{Estimate, Sweep};

fn at(levels: &[u64]) -> Estimate {
    let levels = levels.to_vec();
    Estimate::new(&Sweep { levels, ..sweep() }, 1)
}

#[test]
fn memory_is_that_of_the_finest_level_and_work_that_of_all() {
    let (one, two, both) = (at(&[64]), at(&[128]), at(&[64, 128]));
    assert_eq!(two.bytes, 2.0 * one.bytes);
    assert_eq!(both.bytes, two.bytes);
    // Two levels for the model lie between, 80 and 100: work grows with n.
    let between = (80.0 + 100.0) / 64.0 * one.work;
    assert_eq!(both.work, one.work + two.work + between);
    assert_eq!(two.seconds(2), two.seconds(1) / 2.0);
}

#[test]
fn wider_formats_and_more_cases_at_once_take_more_memory() {
    let narrow = sweep();
    let wide = Sweep {
        formats: vec!["mpfr:4096".parse().unwrap()],
        ..sweep()
    };
    assert!(Estimate::new(&wide, 1).bytes > 2.0 * Estimate::new(&narrow, 1).bytes);
    let mut many = sweep();
    many.cases = many.cases.iter().cycle().take(10).cloned().collect();
    let (one, two) = (Estimate::new(&many, 1), Estimate::new(&many, 2));
    assert_eq!(two.bytes, 2.0 * one.bytes);
}

#[test]
fn levels_that_no_machine_holds_are_foreseen_without_overflow() {
    let huge = at(&[1 << 40, 1 << 48]);
    assert!(huge.bytes > 2_f64.powi(56) && huge.bytes.is_finite());
    assert!(huge.work_units() > 1 << 50);
}
