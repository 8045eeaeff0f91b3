//! Studies run, in any number of threads.

use super::fixture::sweep;
use rug::Float;
use std::sync::atomic::{AtomicU64, Ordering};
use volver::study::Progress;
use volver::study::sweep::{Estimate, Header, Journal, State, Sweep, Unit, run};

#[derive(Default)]
struct Count(AtomicU64);

impl Progress for Count {
    fn advance(&self, units: u64) {
        self.0.fetch_add(units, Ordering::Relaxed);
    }
}

fn units(sweep: &Sweep, threads: usize) -> Vec<Unit> {
    let directory = tempfile::tempdir().unwrap();
    let header = Header::new(sweep);
    let mut journal = Journal::begin(&directory.path().join("j"), &header).unwrap();
    let count = Count::default();
    let statistics = run(sweep, &mut journal, threads, &count).unwrap();
    assert_eq!(statistics.units, 4);
    assert!(statistics.evaluations > 0 && statistics.oracle_evaluations > 0);
    let estimate = Estimate::new(sweep, threads);
    assert_eq!(count.0.into_inner(), estimate.work_units());
    journal.finish(&header).unwrap()
}

#[test]
fn units_do_not_depend_on_threads() {
    let sweep = sweep();
    let one = units(&sweep, 1);
    assert_eq!(one, units(&sweep, 2));
    // More threads than units: levels side by side.
    assert_eq!(one, units(&sweep, 7));
}

#[test]
fn parts_add_up_and_levels_that_do_not_suit_are_refused_with_a_reason() {
    let units = units(&sweep(), 2);
    let mut split = 0;
    for unit in &units {
        let [trapezoid, boole] = &unit.rows[..] else {
            panic!("two methods");
        };
        assert!(
            matches!(&boole.levels[0].state, State::Refused(why) if why.contains("multiples of 4"))
        );
        for level in trapezoid.levels.iter().chain(&boole.levels[1..]) {
            assert_eq!(level.state, State::Split);
            let parts = level.split().unwrap();
            let mut sum = Float::with_val(200, &parts.discretization + &parts.input);
            sum += &parts.arithmetic;
            sum += &parts.truncation;
            sum -= &parts.total;
            let all = [
                &parts.total,
                &parts.discretization,
                &parts.input,
                &parts.arithmetic,
            ];
            let largest = all
                .map(|x| x.to_f64().abs())
                .into_iter()
                .fold(0.0, f64::max);
            assert!(sum.to_f64().abs() <= 1e-18 * largest, "{level:?}");
            split += 1;
        }
    }
    assert_eq!(split, 4 * 7);
}

#[test]
fn what_the_journal_has_is_not_run_again() {
    let sweep = sweep();
    let header = Header::new(&sweep);
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("j");
    let all = units(&sweep, 1);
    let mut journal = Journal::begin(&path, &header).unwrap();
    for unit in &all[1..3] {
        journal.append(unit.clone()).unwrap();
    }
    let statistics = run(&sweep, &mut journal, 1, &Count::default()).unwrap();
    assert_eq!(statistics.units, 2);
    assert_eq!(journal.finish(&header).unwrap(), all);
}
