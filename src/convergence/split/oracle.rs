//! The same code with enough bits: what every format's run is compared with.

use super::Cell;
use super::parts::{self, Followed, Inputs, Measured};
use super::ran::{Exact, exact, follow, run};
use super::trace::{Ray, Traced};
use crate::case::{AnyNodes, Case, Nodes, Replayed, Shared};
use crate::method::{Level, Method, MethodError};
use crate::real::{Mpfr, MpfrReal};
use crate::reference::{self, Reference, ReferenceError};
use rug::{Float, Rational};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;
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
    references: Kept<u32, Result<Reference, ReferenceError>>,
    nodes: Kept<u32, Shared<'c, C, Mpfr>>,
    rows: Kept<(u32, u64), Vec<Result<Exact, MethodError>>>,
}

/// Values that are made once, by whoever asks first.
type Kept<K, V> = Mutex<BTreeMap<K, Arc<OnceLock<V>>>>;

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
            references: Mutex::default(),
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
    pub fn reference(&self, bits: u32) -> Result<Reference, ReferenceError> {
        let slot = slot(&self.references, bits);
        slot.get_or_init(|| reference::radiance(self.case, bits))
            .clone()
    }

    /// Its value.
    fn radiance(&self, bits: u32) -> Result<Float, ReferenceError> {
        Ok(self.reference(bits)?.value)
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
        let ray = Ray {
            case: self.case,
            nodes: AnyNodes::new(nodes),
            n,
        };
        self.split_ray(&ray)
    }

    fn split_ray(
        &self,
        ray: &dyn Traced,
    ) -> Result<Vec<Result<Cell, MethodError>>, ReferenceError> {
        let all = 0..self.methods.len();
        if !self.has_jumps
            && let Some(cells) = self.split_together(ray, all.clone())?
        {
            return Ok(cells);
        }
        // One by one: where one method goes another way, those beside it need not.
        let mut cells = Vec::with_capacity(all.len());
        for method in all {
            match self.split_together(ray, method..method + 1)? {
                Some(cell) => cells.extend(cell),
                None => cells.push(Ok(Cell::BranchDiverged {
                    total: self.total(ray, &self.methods[method])?,
                })),
            }
        }
        Ok(cells)
    }

    /// The methods in this range; `None` where a replay asked for something else than was recorded, or the
    /// run stood on another side of a jump.
    fn split_together(
        &self,
        ray: &dyn Traced,
        range: Range<usize>,
    ) -> Result<Option<Vec<Result<Cell, MethodError>>>, ReferenceError> {
        let n = ray.segments();
        let methods = &self.methods[range.clone()];
        let trace = ray.trace(methods);
        let replayed = |bits| -> Option<Vec<Result<Followed, MethodError>>> {
            let inputs = trace.recording.replay(bits);
            let followed = follow_all(&inputs, n, methods, &trace.measured);
            let same = !self.has_jumps || (trace.took_the_sides_of)(&inputs);
            (inputs.is_complete() && same).then_some(followed)
        };
        let mut bits = first_bits(ray.bits());
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
            let cells: Vec<Result<Cell, MethodError>> = trace
                .measured
                .iter()
                .zip(range.clone())
                .enumerate()
                .map(|(i, (measured, method))| {
                    let measured = measured.as_ref().map_err(Clone::clone)?;
                    parts::cell(measured, method, i, &low, &high)
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
    fn total(&self, ray: &dyn Traced, method: &Method) -> Result<Float, ReferenceError> {
        let bits = first_bits(ray.bits());
        let radiance = self.radiance(bits)?;
        Ok(match ray.radiance(method) {
            Ok(ran) => parts::difference(&ran, &radiance, bits),
            Err(_) => Float::with_val(bits, rug::float::Special::Nan),
        })
    }
}

/// The methods on the recorded inputs, stopped where the run stopped.
fn follow_all(
    inputs: &Replayed<'_>,
    n: u64,
    methods: &[Method],
    measured: &[Result<Measured, MethodError>],
) -> Vec<Result<Followed, MethodError>> {
    let mut level = Level::new(inputs, n);
    let radiances: Vec<_> = methods
        .iter()
        .zip(measured)
        .map(|(method, measured)| {
            let measured = measured.as_ref().map_err(Clone::clone)?;
            run(&mut level, method, follow(measured.stopped))
        })
        .collect();
    methods
        .iter()
        .zip(measured)
        .zip(radiances)
        .map(|((method, measured), ran)| {
            let measured = measured.as_ref().map_err(Clone::clone)?;
            let rows: Vec<Cow<'_, [MpfrReal]>> = measured
                .transmittances
                .iter()
                .map(|row| Cow::Owned(numbers(row, inputs.format())))
                .collect();
            let under = if rows.is_empty() {
                None
            } else {
                Some(level.radiance_under(method, &rows)?.into())
            };
            Ok(Followed {
                radiance: ran?.radiance.into(),
                under,
            })
        })
        .collect()
}

/// The oracle's first precision for a format of `bits` bits: a power of two, so that formats share it.
fn first_bits(bits: u32) -> u32 {
    let wanted = bits.saturating_add(GUARD_BITS);
    wanted
        .max(LEAST_BITS)
        .checked_next_power_of_two()
        .unwrap_or(wanted)
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
