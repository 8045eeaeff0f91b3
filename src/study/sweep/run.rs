//! Running a study on all cores.

use super::keep::Keep;
use super::number;
use super::record::{LevelRecord, Row, Unit};
use super::stopped::SweepError;
use super::total::{self, Truth};
use super::{Errors, Estimate, Sweep};
use crate::case::{Shared, SymbolicCase};
use crate::convergence::{Cell, Oracle};
use crate::method::{MethodError, expected_on};
use crate::parallel;
use crate::real::{Format, FormatName, WithFormat};
use crate::reference::ReferenceError;
use crate::study::Progress;
use rug::Float;
use rug::float::Special;
use std::collections::VecDeque;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::thread;
use std::time::Instant;

/// Bits that I is known to for a report.
const RADIANCE_BITS: u32 = 80;

/// What a run cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Units that were run, those in the journal before not among them.
    pub units: u64,
    /// Evaluations of a medium, in the formats of the study.
    pub evaluations: u64,
    /// Evaluations of a medium for the oracle.
    pub oracle_evaluations: u64,
}

/// A case whose oracle its formats share: there from the first of its units to the last. Errors as a whole need its radiance
/// alone.
struct Job<'s> {
    name: &'s str,
    case: &'s SymbolicCase,
    oracle: Mutex<Option<Arc<Oracle<'s, SymbolicCase>>>>,
    truth: OnceLock<Truth>,
    left: AtomicU64,
}

impl<'s> Job<'s> {
    /// One of its units.
    fn unit(
        &self,
        sweep: &'s Sweep,
        format: FormatName,
        order: Order,
        progress: &dyn Progress,
    ) -> Unit {
        let name = self.name;
        match sweep.errors {
            Errors::Split => {
                let new = || Arc::new(Oracle::new(self.case, &sweep.methods));
                let oracle = Arc::clone(lock(&self.oracle).get_or_insert_with(new));
                format.with(OneUnit {
                    sweep,
                    name,
                    format,
                    oracle: &oracle,
                    order,
                    progress,
                })
            }
            Errors::Total => format.with(total::OneUnit {
                sweep,
                name,
                case: self.case,
                format,
                truth: self
                    .truth
                    .get_or_init(|| Truth::new(self.case, &sweep.formats)),
                levels_in_parallel: order == Order::SideBySide,
                progress,
            }),
        }
    }

    /// Evaluations of its oracle, which goes with its last unit.
    fn done(&self) -> u64 {
        if self.left.fetch_sub(1, Ordering::AcqRel) > 1 {
            return 0;
        }
        let oracle = lock(&self.oracle).take();
        oracle.map_or(0, |oracle| oracle.evaluations())
    }
}

/// Runs the units that are wanted, on `threads` threads. Memory is for about twice as many cases as there are threads, however
/// many the study has.
///
/// # Errors
/// [`SweepError`] where a finished unit cannot be kept.
pub fn run(
    sweep: &Sweep,
    kept: &mut dyn Keep,
    threads: usize,
    progress: &dyn Progress,
) -> Result<Statistics, SweepError> {
    let threads = threads.max(1);
    let todo = queue(sweep, kept);
    let jobs: Vec<Job<'_>> = sweep
        .cases
        .iter()
        .enumerate()
        .map(|(index, (name, case))| Job {
            name,
            case,
            oracle: Mutex::new(None),
            truth: OnceLock::new(),
            left: AtomicU64::new(todo.iter().filter(|(c, _)| *c == index).count() as u64),
        })
        .collect();
    let todo = Mutex::new(Todo {
        threads_at: vec![0; jobs.len()],
        units: todo,
    });
    let kept = Mutex::new(kept);
    let statistics = Mutex::new(Statistics::default());
    let work = || -> Result<(), SweepError> {
        let mut mine = None;
        loop {
            let Some(Next {
                case,
                format,
                is_shared,
                is_last,
            }) = lock(&todo).next(mine, threads)
            else {
                return Ok(());
            };
            mine = Some(case);
            let order = match (is_last, is_shared) {
                (true, _) => Order::SideBySide,
                (false, true) => Order::FromFinest,
                (false, false) => Order::FromCoarsest,
            };
            let job = &jobs[case];
            let begun = Instant::now();
            let unit = job.unit(sweep, format, order, progress);
            let took = begun.elapsed().as_secs_f64();
            lock(&todo).leave(case);
            let mut total = lock(&statistics);
            total.units += 1;
            total.evaluations += unit.evaluations;
            total.oracle_evaluations += job.done();
            drop(total);
            if let Err(error) = lock(&kept).keep(unit, took) {
                // Nothing more can be kept: the others stop after what they have begun.
                lock(&todo).units.clear();
                return Err(error);
            }
        }
    };
    if threads == 1 {
        // Memory comes cheaper to a program's first thread.
        work()?;
        return Ok(*lock(&statistics));
    }
    thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        let ended = workers
            .into_iter()
            .map(|worker| worker.join().unwrap_or(Err(SweepError::Thread)));
        // All are waited for, whichever failed.
        let ended: Vec<_> = ended.collect();
        ended.into_iter().collect::<Result<(), _>>()
    })?;
    Ok(*lock(&statistics))
}

/// The units left to do, case by case.
fn queue(sweep: &Sweep, kept: &dyn Keep) -> VecDeque<(usize, FormatName)> {
    let mut queue = VecDeque::new();
    for (case, (name, _)) in sweep.cases.iter().enumerate() {
        for format in &sweep.formats {
            if kept.wants(name, &format.to_string()) {
                queue.push_back((case, *format));
            }
        }
    }
    queue
}

/// The units left to do, and who is at what.
struct Todo {
    units: VecDeque<(usize, FormatName)>,
    /// How many threads are at a case.
    threads_at: Vec<usize>,
}

/// What a thread does next.
struct Next {
    case: usize,
    format: FormatName,
    /// Whether another thread is at the case.
    is_shared: bool,
    /// Whether fewer units are left than there are threads: its levels share them.
    is_last: bool,
}

impl Todo {
    /// A thread stays with its case as long as there is something to do, goes on to one that nobody is at, and helps with
    /// others last: threads then seldom wait for what both want, and few cases are in memory.
    fn next(&mut self, mine: Option<usize>, threads: usize) -> Option<Next> {
        let at = |case: usize| self.threads_at.get(case).copied().unwrap_or(0);
        let cases = || self.units.iter().map(|(case, _)| *case);
        let place = cases()
            .position(|case| Some(case) == mine)
            .or_else(|| cases().position(|case| at(case) == 0))
            .or_else(|| {
                let fewest = cases().enumerate().min_by_key(|&(_, case)| at(case));
                fewest.map(|(place, _)| place)
            })?;
        let (case, format) = self.units.remove(place)?;
        let at_it = self.threads_at.get_mut(case)?;
        let is_shared = *at_it > 0;
        *at_it += 1;
        Some(Next {
            case,
            format,
            is_shared,
            is_last: threads > 1 && self.units.len() < threads,
        })
    }

    /// A thread is done with its unit of that case.
    fn leave(&mut self, case: usize) {
        if let Some(threads) = self.threads_at.get_mut(case) {
            *threads = threads.saturating_sub(1);
        }
    }
}

/// In what order a unit goes through its levels.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Order {
    FromCoarsest,
    /// Towards the thread that is at the same case already, so that neither waits for the other's levels.
    FromFinest,
    /// On all threads at once.
    SideBySide,
}

/// One case in one format, the format still to be chosen.
struct OneUnit<'a, 's> {
    sweep: &'s Sweep,
    name: &'s str,
    format: FormatName,
    oracle: &'a Oracle<'s, SymbolicCase>,
    order: Order,
    progress: &'a dyn Progress,
}

impl WithFormat for OneUnit<'_, '_> {
    type Output = Unit;

    fn run<F: Format>(self, format: F) -> Unit {
        let nodes = Shared::new(self.oracle.case(), format);
        let rows = self.rows(&|n| {
            let cells = self.oracle.split(&nodes, n);
            nodes.forget_columns(n);
            cells
        });
        let reference = self.oracle.reference(RADIANCE_BITS);
        let (radiance, unproved) = match reference {
            Ok(reference) => {
                let unproved = reference.unproved(self.oracle.case());
                (reference.value, unproved)
            }
            // Each level says why.
            Err(_) => (Float::with_val(RADIANCE_BITS, Special::Nan), Vec::new()),
        };
        Unit {
            case: self.name.into(),
            format: self.format.to_string(),
            bits: format.bits(),
            radiance: number::rounded(&radiance),
            unproved,
            rows,
            evaluations: nodes.evaluations(),
        }
    }
}

/// All methods at one level.
type Cells = Result<Vec<Result<Cell, MethodError>>, ReferenceError>;

impl OneUnit<'_, '_> {
    /// The records of all methods; `split` gives their cells at a level.
    fn rows(&self, split: &(dyn Fn(u64) -> Cells + Sync)) -> Vec<Row> {
        let at = |&n: &u64| {
            let cells = split(n);
            self.progress
                .advance(Estimate::work(self.sweep, self.format, n));
            records(n, cells, self.sweep.methods.len())
        };
        let all = |levels: &[u64]| -> Vec<Vec<LevelRecord>> {
            match self.order {
                Order::SideBySide => parallel::map(levels, at),
                Order::FromCoarsest => levels.iter().map(at).collect(),
                Order::FromFinest => {
                    let mut found: Vec<_> = levels.iter().rev().map(at).collect();
                    found.reverse();
                    found
                }
            }
        };
        let levels = all(&self.sweep.levels);
        let between = all(&self.sweep.errors.between(&self.sweep.levels));
        let of = |levels: &[Vec<LevelRecord>], m: usize| {
            levels.iter().map(|level| level[m].clone()).collect()
        };
        let case = self.oracle.case();
        let methods = self.sweep.methods.iter().enumerate();
        let rows = methods.map(|(m, method)| Row {
            method: method.name(),
            expected: expected_on(method, case, &self.sweep.levels).into(),
            levels: of(&levels, m),
            between: of(&between, m),
        });
        rows.collect()
    }
}

/// The records of all methods at one level.
fn records(n: u64, cells: Cells, methods: usize) -> Vec<LevelRecord> {
    match cells {
        Ok(cells) => cells
            .into_iter()
            .map(|cell| match cell {
                Ok(cell) => LevelRecord::of(n, &cell),
                Err(error) => LevelRecord::refused(n, error.to_string()),
            })
            .collect(),
        Err(error) => vec![LevelRecord::refused(n, error.to_string()); methods],
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // A thread that panics leaves what stands there whole.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
