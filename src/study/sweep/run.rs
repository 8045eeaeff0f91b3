//! Running a study on all cores.

use super::keep::Keep;
use super::number;
use super::record::{LevelRecord, Unit};
use super::stopped::SweepError;
use super::total::{self, Truth};
use super::{Block, Errors, Estimate, Sweep};
use crate::case::{Shared, SymbolicCase};
use crate::convergence::{Cell, Oracle};
use crate::method::MethodError;
use crate::parallel;
use crate::real::{Format, FormatName, WithFormat};
use crate::reference::ReferenceError;
use crate::study::Progress;
use rug::Float;
use rug::float::Special;
use std::collections::{BTreeMap, VecDeque};
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::thread;
use std::time::Instant;

/// Bits that I is known to for a report.
const RADIANCE_BITS: u32 = 80;

/// What a run cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Blocks that were run, most of them whole units; those in the journal before not among them.
    pub units: u64,
    /// Evaluations of a medium, in the formats of the study.
    pub evaluations: u64,
    /// Evaluations of a medium for the oracle.
    pub oracle_evaluations: u64,
}

/// Oracles of one case.
type Oracles<'s> = BTreeMap<(usize, usize), Arc<Oracle<'s, SymbolicCase>>>;

/// A case whose oracle its formats share: there from the first of its units to the last. Errors as a whole need its radiance
/// alone.
struct Job<'s> {
    name: &'s str,
    case: &'s SymbolicCase,
    /// One for all blocks of the same methods, by the first and the one behind the last.
    oracles: Mutex<Oracles<'s>>,
    truth: OnceLock<Truth>,
    left: AtomicU64,
}

impl<'s> Job<'s> {
    /// What a block has of its unit, and how often the medium was evaluated in the format.
    fn unit(
        &self,
        sweep: &'s Sweep,
        block: &Block,
        format: FormatName,
        order: Order,
        progress: &dyn Progress,
    ) -> (Unit, u64) {
        let name = self.name;
        match sweep.errors {
            Errors::Split => {
                let Range { start, end } = block.methods;
                let new = || Arc::new(Oracle::new(self.case, block.methods(sweep)));
                let oracle =
                    Arc::clone(lock(&self.oracles).entry((start, end)).or_insert_with(new));
                format.with(OneUnit {
                    sweep,
                    block,
                    name,
                    format,
                    oracle: &oracle,
                    order,
                    progress,
                })
            }
            Errors::Total => format.with(total::OneUnit {
                sweep,
                block,
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

    /// Evaluations of its oracles, which go with its last block.
    fn done(&self) -> u64 {
        if self.left.fetch_sub(1, Ordering::AcqRel) > 1 {
            return 0;
        }
        let oracles = std::mem::take(&mut *lock(&self.oracles));
        oracles.values().map(|oracle| oracle.evaluations()).sum()
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
    let todo: VecDeque<Block> = kept.left(sweep).into();
    let mut blocks_of = vec![0; sweep.cases.len()];
    for block in &todo {
        if let Some(blocks) = blocks_of.get_mut(block.case(sweep)) {
            *blocks += 1;
        }
    }
    let jobs: Vec<Job<'_>> = sweep
        .cases
        .iter()
        .enumerate()
        .map(|(index, (name, case))| Job {
            name,
            case,
            oracles: Mutex::default(),
            truth: OnceLock::new(),
            left: AtomicU64::new(blocks_of.get(index).copied().unwrap_or(0)),
        })
        .collect();
    let todo = Mutex::new(Todo {
        sweep,
        threads_at: vec![0; jobs.len()],
        blocks: todo,
    });
    let kept = Mutex::new(kept);
    let statistics = Mutex::new(Statistics::default());
    let work = || -> Result<(), SweepError> {
        let mut mine = None;
        loop {
            let Some(Next {
                block,
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
            let (unit, evaluations) = job.unit(sweep, &block, format, order, progress);
            let took = begun.elapsed().as_secs_f64();
            lock(&todo).leave(case);
            let mut total = lock(&statistics);
            total.units += 1;
            total.evaluations += evaluations;
            total.oracle_evaluations += job.done();
            drop(total);
            if let Err(error) = lock(&kept).keep(&block, unit, took) {
                // Nothing more can be kept: the others stop after what they have begun.
                lock(&todo).blocks.clear();
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

/// The blocks left to do, and who is at what.
struct Todo<'s> {
    sweep: &'s Sweep,
    blocks: VecDeque<Block>,
    /// How many threads are at a case.
    threads_at: Vec<usize>,
}

/// What a thread does next.
struct Next {
    block: Block,
    case: usize,
    format: FormatName,
    /// Whether another thread is at the case.
    is_shared: bool,
    /// Whether fewer blocks are left than there are threads: its levels share them.
    is_last: bool,
}

impl Todo<'_> {
    /// A thread stays with its case as long as there is something to do, goes on to one that nobody is at, and helps with
    /// others last: threads then seldom wait for what both want, and few cases are in memory.
    fn next(&mut self, mine: Option<usize>, threads: usize) -> Option<Next> {
        let at = |case: usize| self.threads_at.get(case).copied().unwrap_or(0);
        let cases = || self.blocks.iter().map(|block| block.case(self.sweep));
        let place = cases()
            .position(|case| Some(case) == mine)
            .or_else(|| cases().position(|case| at(case) == 0))
            .or_else(|| {
                let fewest = cases().enumerate().min_by_key(|&(_, case)| at(case));
                fewest.map(|(place, _)| place)
            })?;
        let block = self.blocks.remove(place)?;
        let (case, format) = (block.case(self.sweep), block.format(self.sweep)?);
        let at_it = self.threads_at.get_mut(case)?;
        let is_shared = *at_it > 0;
        *at_it += 1;
        Some(Next {
            block,
            case,
            format,
            is_shared,
            is_last: threads > 1 && self.blocks.len() < threads,
        })
    }

    /// A thread is done with its block of that case.
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
    block: &'a Block,
    name: &'s str,
    format: FormatName,
    oracle: &'a Oracle<'s, SymbolicCase>,
    order: Order,
    progress: &'a dyn Progress,
}

impl WithFormat for OneUnit<'_, '_> {
    type Output = (Unit, u64);

    fn run<F: Format>(self, format: F) -> (Unit, u64) {
        let nodes = Shared::new(self.oracle.case(), format);
        let records = self.records(&|n| {
            let cells = self.oracle.split(&nodes, n);
            nodes.forget_columns(n);
            cells
        });
        let case = self.oracle.case();
        let reference = self.oracle.reference(RADIANCE_BITS);
        let (radiance, unproved) = match reference {
            Ok(reference) => {
                let unproved = reference.unproved(case);
                (reference.value, unproved)
            }
            // Each level says why.
            Err(_) => (Float::with_val(RADIANCE_BITS, Special::Nan), Vec::new()),
        };
        let unit = Unit {
            case: self.name.into(),
            format: self.format.to_string(),
            bits: format.bits(),
            radiance: number::rounded(&radiance),
            unproved,
            rows: self.block.rows(self.sweep, case, &records),
        };
        (unit, nodes.evaluations())
    }
}

/// All methods at one level.
type Cells = Result<Vec<Result<Cell, MethodError>>, ReferenceError>;

impl OneUnit<'_, '_> {
    /// The records of the methods at each level; `split` gives their cells.
    fn records(&self, split: &(dyn Fn(u64) -> Cells + Sync)) -> Vec<Vec<LevelRecord>> {
        let methods = self.block.methods.len();
        let at = |&n: &u64| {
            let cells = split(n);
            self.progress
                .advance(Estimate::work(self.sweep, self.format, n, methods));
            records(n, cells, methods)
        };
        let levels = self.block.levels(self.sweep);
        match self.order {
            Order::SideBySide => parallel::map(&levels, at),
            Order::FromCoarsest => levels.iter().map(at).collect(),
            Order::FromFinest => {
                let mut found: Vec<_> = levels.iter().rev().map(at).collect();
                found.reverse();
                found
            }
        }
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
