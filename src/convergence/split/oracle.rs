//! The same code with enough bits: what every format's run is compared with.

use super::Cell;
use super::parts::{self, Followed, Inputs, Measured};
use super::ran::{follow, may_stop, run};
use crate::case::{Case, Nodes, Number, Recorded, Replayed, Shared};
use crate::method::{Level, Method, MethodError, Stop};
use crate::real::{Format, Mpfr, MpfrReal, Real};
use crate::reference::{self, ReferenceError};
use rug::{Float, Rational};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

/// The fewest bits the oracle starts with.
const LEAST_BITS: u32 = 128;
/// Beyond the format's own: 2⁻²⁰ of a part that is itself some bits below u.
const GUARD_BITS: u32 = 64;
/// The most bits the oracle is raised to.
const MOST_BITS: u32 = 8192;

/// What some methods give on a case without rounding, at as many bits as it takes; computed once for all
/// formats that are compared with it.
#[derive(Debug)]
pub struct Oracle<'c, C: Case> {
    case: &'c C,
    methods: Vec<Method>,
    /// Formats with a jump between neighbours may see another medium than MPFR does.
    has_jumps: bool,
    radiances: Kept<u32, Result<Float, ReferenceError>>,
    nodes: Kept<u32, Shared<'c, C, Mpfr>>,
    rows: Kept<(u32, u64), Vec<Result<Exact, MethodError>>>,
}

/// Values that are made once, by whoever asks first.
type Kept<K, V> = Mutex<BTreeMap<K, Arc<OnceLock<V>>>>;

/// A method without rounding.
#[derive(Clone, Debug)]
pub(super) struct Exact {
    /// The radiance, stopped where the method stops.
    pub(super) declared: Float,
    /// Where that is, if before the end.
    pub(super) stopped: Option<u64>,
    /// The radiance of the whole ray.
    pub(super) whole: Float,
}

impl<'c, C: Case> Oracle<'c, C> {
    /// Nothing computed yet.
    pub fn new(case: &'c C, methods: &[Method]) -> Self {
        let jumps = |power: &Option<Rational>| power.as_ref().is_some_and(|power| *power == 0);
        let breaks = case.structure().breaks;
        Oracle {
            case,
            methods: methods.to_vec(),
            has_jumps: breaks
                .iter()
                .any(|b| jumps(&b.extinction) || jumps(&b.source)),
            radiances: Mutex::default(),
            nodes: Mutex::default(),
            rows: Mutex::default(),
        }
    }

    /// The methods, in the order of all results.
    #[must_use]
    pub fn methods(&self) -> &[Method] {
        &self.methods
    }

    /// The case.
    #[must_use]
    pub fn case(&self) -> &'c C {
        self.case
    }

    /// How often the medium was evaluated in MPFR so far.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        let nodes = lock(&self.nodes);
        nodes
            .values()
            .filter_map(|n| n.get())
            .map(Shared::evaluations)
            .sum()
    }

    /// I to at least `bits` significant bits.
    ///
    /// # Errors
    /// [`ReferenceError`] where there is no reference.
    pub fn radiance(&self, bits: u32) -> Result<Float, ReferenceError> {
        let slot = slot(&self.radiances, bits);
        slot.get_or_init(|| reference::radiance(self.case, bits).map(|r| r.value))
            .clone()
    }

    /// The error of every method at n segments in the format of `nodes`, which must be of the same case, and
    /// its parts.
    ///
    /// # Errors
    /// [`ReferenceError`] where the case's radiance cannot be known; of each method [`MethodError`] where n
    /// does not suit it or the case lacks what it needs.
    pub fn split<N: Nodes>(
        &self,
        nodes: &N,
        n: u64,
    ) -> Result<Vec<Result<Cell, MethodError>>, ReferenceError> {
        let all: Vec<usize> = (0..self.methods.len()).collect();
        if !self.has_jumps
            && let Some(cells) = self.split_together(nodes, n, &all)?
        {
            return Ok(cells);
        }
        // One by one: where one method goes another way, those beside it need not.
        let mut cells = Vec::with_capacity(all.len());
        for method in all {
            match self.split_together(nodes, n, &[method])? {
                Some(cell) => cells.extend(cell),
                None => cells.push(Ok(Cell::BranchDiverged {
                    total: self.total(nodes, n, method)?,
                })),
            }
        }
        Ok(cells)
    }

    /// The methods of these indices; `None` where a replay asked for something else than was recorded, or the
    /// run stood on another side of a jump.
    fn split_together<N: Nodes>(
        &self,
        nodes: &N,
        n: u64,
        methods: &[usize],
    ) -> Result<Option<Vec<Result<Cell, MethodError>>>, ReferenceError> {
        let recorded = Recorded::new(nodes);
        let mut level = Level::new(&recorded, n);
        let runs: Vec<_> = methods
            .iter()
            .map(|&m| run(&mut level, &self.methods[m], Stop::AsDeclared))
            .collect();
        // What is asked for from here on is no part of the run.
        let recording = recorded.recording();
        let measured: Vec<Result<Measured, MethodError>> = methods
            .iter()
            .zip(runs)
            .map(|(&m, ran)| {
                let ran = ran?;
                let rows = level.transmittances(&self.methods[m])?;
                Ok(Measured {
                    radiance: ran.radiance.to_float(),
                    stopped: ran.stopped,
                    transmittances: rows.iter().map(|row| floats::<N>(row)).collect(),
                })
            })
            .collect();
        let replayed = |bits| -> Option<Vec<Result<Followed, MethodError>>> {
            let inputs = recording.replay(bits);
            let followed = self.follow(&inputs, n, methods, &measured);
            let same = !self.has_jumps || recorded.took_the_sides_of(self.case, &inputs);
            (inputs.is_complete() && same).then_some(followed)
        };
        let mut bits = first_bits(nodes.format().bits());
        let Some(mut coarse) = replayed(bits) else {
            return Ok(None);
        };
        loop {
            let double = 2 * bits;
            let Some(fine) = replayed(double) else {
                return Ok(None);
            };
            let inputs = |bits, followed| -> Result<Inputs<'_>, ReferenceError> {
                Ok(Inputs {
                    bits,
                    n,
                    radiance: self.radiance(bits)?,
                    rows: self.rows(bits, n),
                    followed,
                })
            };
            let (low, high) = (inputs(bits, &coarse)?, inputs(double, &fine)?);
            let cells: Vec<Result<Cell, MethodError>> = measured
                .iter()
                .enumerate()
                .map(|(i, measured)| {
                    let measured = measured.as_ref().map_err(Clone::clone)?;
                    parts::cell(measured, methods[i], i, &low, &high)
                })
                .collect();
            let settled =
                |cell: &Result<Cell, MethodError>| !matches!(cell, Ok(Cell::Unsettled { .. }));
            if double >= MOST_BITS || cells.iter().all(settled) {
                return Ok(Some(cells));
            }
            (bits, coarse) = (double, fine);
        }
    }

    /// The methods on the recorded inputs, stopped where the run stopped.
    fn follow(
        &self,
        inputs: &Replayed<'_>,
        n: u64,
        methods: &[usize],
        measured: &[Result<Measured, MethodError>],
    ) -> Vec<Result<Followed, MethodError>> {
        let mut level = Level::new(inputs, n);
        let radiances: Vec<_> = methods
            .iter()
            .zip(measured)
            .map(|(&m, measured)| {
                let measured = measured.as_ref().map_err(Clone::clone)?;
                run(&mut level, &self.methods[m], follow(measured.stopped))
            })
            .collect();
        methods
            .iter()
            .zip(measured)
            .zip(radiances)
            .map(|((&m, measured), ran)| {
                let measured = measured.as_ref().map_err(Clone::clone)?;
                let rows: Vec<Cow<'_, [MpfrReal]>> = measured
                    .transmittances
                    .iter()
                    .map(|row| Cow::Owned(numbers(row, inputs.format())))
                    .collect();
                let under = if rows.is_empty() {
                    None
                } else {
                    Some(level.radiance_under(&self.methods[m], &rows)?.into())
                };
                Ok(Followed {
                    radiance: ran?.radiance.into(),
                    under,
                })
            })
            .collect()
    }

    /// All methods without rounding, in order.
    fn rows(&self, bits: u32, n: u64) -> Arc<OnceLock<Vec<Result<Exact, MethodError>>>> {
        let row = slot(&self.rows, (bits, n));
        row.get_or_init(|| {
            let nodes = slot(&self.nodes, bits);
            let nodes = nodes.get_or_init(|| Shared::new(self.case, Mpfr { bits }));
            let mut level = Level::new(nodes, n);
            let methods = self.methods.iter();
            methods.map(|method| exact(&mut level, method)).collect()
        });
        row
    }

    /// `Q_f` − I alone.
    fn total<N: Nodes>(&self, nodes: &N, n: u64, method: usize) -> Result<Float, ReferenceError> {
        let bits = first_bits(nodes.format().bits());
        let radiance = self.radiance(bits)?;
        let ran = run(
            &mut Level::new(nodes, n),
            &self.methods[method],
            Stop::AsDeclared,
        );
        Ok(match ran {
            Ok(ran) => parts::difference(&ran.radiance.to_float(), &radiance, bits),
            Err(_) => Float::with_val(bits, rug::float::Special::Nan),
        })
    }
}

/// A method without rounding on one level.
fn exact<N: Nodes<Format = Mpfr>>(
    level: &mut Level<'_, N>,
    method: &Method,
) -> Result<Exact, MethodError> {
    let declared = run(level, method, Stop::AsDeclared)?;
    let whole = if may_stop(method) && declared.stopped.is_some() {
        run(level, method, Stop::Never)?.radiance.into()
    } else {
        declared.radiance.clone().into()
    };
    Ok(Exact {
        declared: declared.radiance.into(),
        stopped: declared.stopped,
        whole,
    })
}

/// The oracle's first precision for a format of `bits` bits: a power of two, so that formats share it.
fn first_bits(bits: u32) -> u32 {
    let wanted = bits.saturating_add(GUARD_BITS);
    wanted
        .max(LEAST_BITS)
        .checked_next_power_of_two()
        .unwrap_or(wanted)
}

fn floats<N: Nodes>(row: &[Number<N>]) -> Vec<Float> {
    row.iter().map(Real::to_float).collect()
}

fn numbers(row: &[Float], format: Mpfr) -> Vec<MpfrReal> {
    row.iter()
        .map(|x| Float::with_val(format.bits, x).into())
        .collect()
}

fn slot<K: Ord, V>(kept: &Kept<K, V>, key: K) -> Arc<OnceLock<V>> {
    Arc::clone(lock(kept).entry(key).or_default())
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // Entries go in whole, so a poisoned map is still sound.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
