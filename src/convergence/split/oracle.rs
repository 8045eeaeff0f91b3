//! The same code with enough bits: what every format's run is compared with.

use super::Cell;
use super::known::{Again, Known};
use super::parts::{self, Followed, Judged, Measured, With};
use super::ran::{follow, run};
use super::trace::{Ray, Trace, Traced};
use super::without_rounding::WithoutRounding;
use crate::case::{AnyNodes, Case, Nodes, Replayed, Shared};
use crate::method::{GroupSums, Level, Method, MethodError};
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
/// Precisions are multiples of this: MPFR computes with whole words, and formats of about the same bits share one.
const STEP_BITS: u32 = 64;
/// The most bits the oracle is raised to.
const MOST_BITS: u32 = 8192;
/// Segments of the level that is run a second time, with more bits, to see what rounding does to the oracle: few, fit for every
/// rule, and no power of two, where some roundings are none.
const PROBE_SEGMENTS: u64 = 60;

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
    levels: Kept<(u32, u64), Arc<WithoutRounding>>,
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
            levels: Mutex::default(),
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
        let first = first_bits(ray.bits());
        let level = self.level(first, ray.segments(), &self.everything());
        let methods = self.methods.get(range.clone()).unwrap_or_default();
        let trace = ray.trace(methods, &level.known);
        let mut cells: Vec<Option<Result<Cell, MethodError>>> = vec![None; range.len()];
        // The bits that each method is judged at next: what one of them needs is no matter of those beside it, so that they may
        // be split apart from each other.
        let mut next: Vec<Option<u32>> = vec![Some(first); range.len()];
        while let Some(bits) = next.iter().copied().flatten().min() {
            // Values that a method asked for one after the other come back in that order, to all of them alone.
            let every = !trace.recording.is_of_columns();
            let is_asked = |place: &usize| every || next.get(*place) == Some(&Some(bits));
            let places: Vec<usize> = (0..range.len()).filter(is_asked).collect();
            let Some(judged) = self.judge(ray, &trace, range.start, &places, bits)? else {
                return Ok(None);
            };
            for (place, judged) in places.into_iter().zip(judged) {
                let (Some(cell), Some(next)) = (cells.get_mut(place), next.get_mut(place)) else {
                    continue;
                };
                if *next != Some(bits) {
                    continue;
                }
                *next = None;
                *cell = Some(match judged {
                    Ok(Judged::MoreBits { is_hidden, .. }) if bits < MOST_BITS => {
                        *next = Some(if bits == first && !is_hidden {
                            first + STEP_BITS
                        } else if bits < 2 * first {
                            2 * first
                        } else {
                            2 * bits
                        });
                        continue;
                    }
                    Ok(Judged::MoreBits { unsettled, .. }) => Ok(unsettled),
                    Ok(Judged::Settled(cell)) => Ok(cell),
                    Err(error) => Err(error),
                });
            }
        }
        Ok(Some(cells.into_iter().flatten().collect()))
    }

    /// The cells of the methods at these places of a trace, as so many bits show them; `None` as in
    /// [`Oracle::split_together`].
    fn judge(
        &self,
        ray: &dyn Traced,
        trace: &Trace<'_>,
        start: usize,
        places: &[usize],
        bits: u32,
    ) -> Result<Option<Vec<Result<Judged, MethodError>>>, ReferenceError> {
        let (n, first) = (ray.segments(), first_bits(ray.bits()));
        let level = if bits == first {
            self.level(bits, n, &self.everything())
        } else {
            let indices: Vec<usize> = places.iter().map(|place| start + place).collect();
            self.level(bits, n, &indices)
        };
        let inputs = trace.recording.replay(bits);
        let methods = self.methods.get(start..).unwrap_or_default();
        let followed = follow_all(&inputs, n, methods, places, trace, &level.known);
        let same = !self.has_jumps || (trace.took_the_sides_of)(&inputs);
        if !inputs.is_complete() || !same {
            return Ok(None);
        }
        let with = With {
            bits,
            n,
            format_bits: ray.bits(),
            reference: self.reference(bits)?,
            is_enough: bits >= 2 * first,
        };
        let judged = places
            .iter()
            .zip(followed)
            .filter_map(|(&place, followed)| {
                let measured = trace.measured.get(place)?.as_ref();
                let index = start + place;
                let exact = level.of(index)?;
                let judge = || -> Result<Judged, MethodError> {
                    let probed = self.probed(first, index) * n.max(PROBE_SEGMENTS);
                    let probed = (probed / PROBE_SEGMENTS) >> (bits - first);
                    let measured = measured.map_err(Clone::clone)?;
                    Ok(parts::judge(measured, &exact?, &followed?, &with, &probed))
                };
                Some(judge())
            });
        Ok(Some(judged.collect()))
    }

    /// A level without rounding, on which these methods were run.
    fn level(&self, bits: u32, n: u64, indices: &[usize]) -> Arc<WithoutRounding> {
        let level = slot(&self.levels, (bits, n));
        let level = level.get_or_init(|| Arc::new(WithoutRounding::new(Mpfr { bits })));
        let nodes = slot(&self.nodes, bits);
        let nodes = nodes.get_or_init(|| Shared::new(self.case, Mpfr { bits }));
        let methods = indices
            .iter()
            .filter_map(|&index| Some((index, self.methods.get(index)?)));
        level.run(nodes, n, methods);
        Arc::clone(level)
    }

    /// How far rounding to so many bits moves the radiance of a method on [`PROBE_SEGMENTS`] segments: it is run there a
    /// second time, with [`STEP_BITS`] more. 0 where such segments do not suit it, and where a jump of the medium could come to
    /// lie on another side.
    fn probed(&self, bits: u32, method: usize) -> Float {
        let nothing = Float::new(64);
        if self.has_jumps {
            return nothing;
        }
        let whole = |bits| -> Option<Float> {
            let level = self.level(bits, PROBE_SEGMENTS, &self.everything());
            Some(level.of(method)?.ok()?.whole)
        };
        let (Some(few), Some(more)) = (whole(bits), whole(bits + STEP_BITS)) else {
            return nothing;
        };
        let moved = parts::difference(&few, &more, bits + STEP_BITS).abs();
        if moved.is_finite() { moved } else { nothing }
    }

    /// The places of all methods.
    fn everything(&self) -> Vec<usize> {
        (0..self.methods.len()).collect()
    }

    /// `Q_f` − I alone.
    fn total(&self, ray: &dyn Traced, method: &Method) -> Result<Float, ReferenceError> {
        let bits = first_bits(ray.bits());
        let radiance = self.reference(bits)?.value;
        Ok(match ray.radiance(method) {
            Ok(ran) => parts::difference(&ran, &radiance, bits),
            Err(_) => Float::with_val(bits, rug::float::Special::Nan),
        })
    }
}

/// The methods at these places of a trace on the recorded inputs, stopped where the run stopped; `known` are exponentials near
/// theirs.
fn follow_all(
    inputs: &Replayed<'_>,
    n: u64,
    methods: &[Method],
    places: &[usize],
    trace: &Trace<'_>,
    known: &Known,
) -> Vec<Result<Followed, MethodError>> {
    let again = Again(known);
    let mut level = Level::nearly(AnyNodes::new(inputs), n, &again);
    let asked: Vec<(&Method, Result<&Measured, MethodError>)> = places
        .iter()
        .filter_map(|&place| {
            let measured = trace.measured.get(place)?.as_ref();
            Some((methods.get(place)?, measured.map_err(Clone::clone)))
        })
        .collect();
    // All of them first: values that they ask for one after the other come back in that order.
    let radiances: Vec<Result<MpfrReal, MethodError>> = asked
        .iter()
        .map(|(method, measured)| {
            let measured = measured.as_ref().map_err(Clone::clone)?;
            Ok(run(&mut level, method, follow(measured.stopped))?.radiance)
        })
        .collect();
    let mut under = Under {
        trace,
        format: inputs.format(),
        kept: BTreeMap::new(),
    };
    asked
        .into_iter()
        .zip(radiances)
        .map(|((method, measured), radiance)| {
            let under = match measured?.transmittances {
                Some(index) => Some(under.radiance(&mut level, method, index)?.into()),
                None => None,
            };
            Ok(Followed {
                radiance: radiance?.into(),
                under,
            })
        })
        .collect()
}

/// Radiances under the transmittances of a run.
struct Under<'a> {
    trace: &'a Trace<'a>,
    format: Mpfr,
    /// C τ T at boundaries, which outer rules share.
    kept: BTreeMap<usize, GroupSums<MpfrReal>>,
}

impl Under<'_> {
    fn radiance(
        &mut self,
        level: &mut Level<'_, Mpfr>,
        method: &Method,
        index: usize,
    ) -> Result<MpfrReal, MethodError> {
        let rows = self.trace.transmittances.get(index);
        let rows = rows.map_or(&[][..], |rows| rows);
        if let (Method::Nested(nested), [at_boundaries]) = (method, rows) {
            let sums = self
                .kept
                .entry(index)
                .or_insert_with(|| level.sums_under(at_boundaries));
            if let Some(radiance) = level.radiance_of_sums(nested.outer, sums) {
                return radiance;
            }
        }
        let rows = rows
            .iter()
            .map(|values| Cow::Owned(numbers(values, self.format)));
        let rows: Vec<Cow<'_, [MpfrReal]>> = rows.collect();
        level.radiance_under(method, &rows)
    }
}

/// The oracle's first precision for a format of `bits` bits.
fn first_bits(bits: u32) -> u32 {
    let wanted = bits.saturating_add(GUARD_BITS).max(LEAST_BITS);
    wanted.checked_next_multiple_of(STEP_BITS).unwrap_or(wanted)
}

fn numbers(row: &[MpfrReal], format: Mpfr) -> Vec<MpfrReal> {
    row.iter()
        .map(|x| Float::with_val(format.bits, x.as_float()).into())
        .collect()
}

fn slot<K: Ord, V>(kept: &Kept<K, V>, key: K) -> Arc<OnceLock<V>> {
    Arc::clone(lock(kept).entry(key).or_default())
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // Entries go in whole, so a poisoned map is still sound.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
