//! A ray in one pass: nested rules that look inside segments too, in memory that does not grow with the ray.

use super::error::{MethodError, require_multiple};
use super::outer::CompositeWeights;
use super::{Exponential, Inner, Nested, Outer, Scope};
use crate::case::{AnyNodes, Nodes, Rows, Transfer};
use crate::quadrature::{Rule, RuleError};
use crate::real::{Format, Real, row, try_row};
use rug::Rational;

/// Whether [`radiance`] knows the method: not where the depth comes of pairs of segments, or of random places that lie
/// anywhere.
pub(super) fn knows(nested: &Nested) -> bool {
    matches!(nested.inner, Inner::PerSegment(_))
}

/// The radiance with the same bits as from columns of nodes, every node evaluated once; `None` where a method is not
/// [known](knows).
pub(super) fn radiance<F: Format>(
    nested: &Nested,
    nodes: AnyNodes<'_, F>,
    n: u64,
) -> Option<Result<F::Real, MethodError>> {
    let Inner::PerSegment(inner) = nested.inner else {
        return None;
    };
    let Nested {
        outer, exponential, ..
    } = *nested;
    let multiple = require_multiple(&outer.0, n, outer.segments_multiple());
    Some(multiple.and_then(|()| {
        let front = Front::new(nodes.format(), exponential, nested.scope);
        match outer.0.intervals() {
            Some(intervals) => over_boundaries(inner, outer, intervals, nodes, n, front),
            None => inside_segments(inner, outer, nodes, n, front),
        }
    }))
}

/// ∑ W C τ T over boundaries.
fn over_boundaries<F: Format>(
    inner: Rule,
    outer: Outer,
    intervals: u32,
    nodes: AnyNodes<'_, F>,
    n: u64,
    mut front: Front<F::Real>,
) -> Result<F::Real, MethodError> {
    let format = nodes.format();
    let weights = CompositeWeights::new(outer.0, intervals, format)?;
    let mut places = Places {
        boundaries: true,
        inside: Vec::new(),
    };
    let depth = places.partial_depth(inner, &Rational::from(1), &nodes, n)?;
    let mut sum = format.int(0);
    let mut blocks = Blocks::new(&places, nodes, n);
    if let Some(source) = blocks.front().and_then(|first| first.source(FRONT)) {
        sum += &(source * &front.transmittance() * &weights.first);
    }
    let mut repeating = weights.repeating.iter().cycle().skip(1);
    let mut j = 0;
    while let Some(block) = blocks.next() {
        for segment in block.segments() {
            j += 1;
            front.pass(&depth.of(segment));
            let weight = match repeating.next() {
                Some(weight) if j < n => weight,
                _ => &weights.last,
            };
            if let Some(source) = segment.source(BACK) {
                sum += &(source * &front.transmittance() * weight);
            }
        }
    }
    Ok(sum * &step(&nodes, n))
}

/// ∑ₖ wₖ ∑ⱼ C τ T at the nodes inside the segments.
fn inside_segments<F: Format>(
    inner: Rule,
    outer: Outer,
    nodes: AnyNodes<'_, F>,
    n: u64,
    mut front: Front<F::Real>,
) -> Result<F::Real, MethodError> {
    let format = nodes.format();
    let table = outer.0.table(format.bits())?;
    let mut places = Places {
        boundaries: false,
        inside: Vec::new(),
    };
    let depth = places.partial_depth(inner, &Rational::from(1), &nodes, n)?;
    let mut looks = try_row(table.nodes.iter().map(|offset| {
        let partial = places.partial_depth(inner, offset, &nodes, n)?;
        let place = places.at(offset);
        Ok::<_, RuleError>((place, partial, format.int(0)))
    }))?;
    let mut blocks = Blocks::new(&places, nodes, n);
    while let Some(block) = blocks.next() {
        for segment in block.segments() {
            for (place, partial, part) in &mut looks {
                if let Some(source) = segment.source(*place) {
                    *part += &(source * &front.inside(partial.of(segment)));
                }
            }
            front.pass(&depth.of(segment));
        }
    }
    let mut sum = format.int(0);
    for ((_, _, part), weight) in looks.into_iter().zip(&table.weights) {
        sum += &(part * &format.ratio(weight));
    }
    Ok(sum * &step(&nodes, n))
}

/// d.
fn step<F: Format>(nodes: &AnyNodes<'_, F>, n: u64) -> F::Real {
    nodes.format().ratio(&(Rational::from(nodes.length()) / n))
}

/// What lies in front of a segment.
struct Front<R> {
    exponential: Exponential,
    scope: Scope,
    /// The depth where the exponential is taken of the whole, else the transmittance.
    passed: R,
}

impl<R: Real> Front<R> {
    fn new(format: R::Format, exponential: Exponential, scope: Scope) -> Self {
        let passed = match scope {
            Scope::Whole => format.int(0),
            Scope::PerSegment => format.int(1),
        };
        Front {
            exponential,
            scope,
            passed,
        }
    }

    /// Goes on behind a segment of that depth.
    fn pass(&mut self, depth: &R) {
        match self.scope {
            Scope::Whole => self.passed += depth,
            Scope::PerSegment => self.passed *= &self.exponential.of_negative(depth),
        }
    }

    /// T here.
    fn transmittance(&self) -> R {
        match self.scope {
            Scope::Whole => self.exponential.of_negative(&self.passed),
            Scope::PerSegment => self.passed.clone(),
        }
    }

    /// T that much deeper.
    fn inside(&self, depth: R) -> R {
        match self.scope {
            Scope::Whole => self.exponential.of_negative(&(depth + &self.passed)),
            Scope::PerSegment => self.exponential.of_negative(&depth) * &self.passed,
        }
    }
}

/// Where in [`Places`] the front of a segment is, its back, and the first place inside.
const FRONT: usize = 0;
const BACK: usize = 1;
const INSIDE: usize = 2;

/// Where rules look in every segment, each place once.
struct Places {
    /// Whether they look at its ends.
    boundaries: bool,
    /// 0 < offset < 1.
    inside: Vec<Rational>,
}

/// x·d Σ wₖ τ over the places of a segment.
struct Depth<R> {
    looks: Vec<(usize, R)>,
    length: R,
}

impl Places {
    /// The index of the place there, which is looked at from now on.
    fn at(&mut self, offset: &Rational) -> usize {
        let end = if *offset == 0 {
            Some(FRONT)
        } else {
            (*offset == 1).then_some(BACK)
        };
        if let Some(end) = end {
            self.boundaries = true;
            return end;
        }
        let known = self.inside.iter().position(|known| known == offset);
        INSIDE
            + known.unwrap_or_else(|| {
                self.inside.push(offset.clone());
                self.inside.len() - 1
            })
    }

    /// The depth from a segment's front to `offset` of its length.
    fn partial_depth<F: Format>(
        &mut self,
        rule: Rule,
        offset: &Rational,
        nodes: &AnyNodes<'_, F>,
        n: u64,
    ) -> Result<Depth<F::Real>, RuleError> {
        let format = nodes.format();
        let table = rule.table(format.bits())?;
        let both = table.nodes.iter().zip(&table.weights);
        let looks = both.map(|(node, weight)| {
            let place = self.at(&Rational::from(node * offset));
            (place, format.ratio(weight))
        });
        Ok(Depth {
            looks: row(looks),
            length: format.ratio(&(Rational::from(offset * nodes.length()) / n)),
        })
    }
}

impl<R: Real> Depth<R> {
    fn of(&self, segment: Segment<'_, R>) -> R {
        let mut terms = self.looks.iter().filter_map(|(place, weight)| {
            let (_, extinction) = segment.at(*place)?;
            Some(extinction.clone() * weight)
        });
        // A rule has a node at least.
        let mut sum = terms.next().unwrap_or_else(|| self.length.format().int(0));
        for term in terms {
            sum += &term;
        }
        sum * &self.length
    }
}

/// C and τ at the [`Places`] of a ray, some segments at a time.
struct Blocks<'n, R> {
    boundaries: Option<Rows<'n, R>>,
    inside: Vec<Rows<'n, R>>,
    block: Block<R>,
    /// The first block's ends were asked for already.
    is_begun: bool,
}

/// Some segments.
struct Block<R> {
    count: usize,
    /// At their ends, one more than there are segments; none where no rule looks at them.
    ends: Transfer<Vec<R>>,
    /// At every place inside.
    inside: Vec<Transfer<Vec<R>>>,
}

/// One of them.
struct Segment<'b, R> {
    block: &'b Block<R>,
    index: usize,
}

impl<R> Clone for Segment<'_, R> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<R> Copy for Segment<'_, R> {}

impl<'n, R: Real> Blocks<'n, R> {
    fn new<F: Format<Real = R>>(places: &Places, nodes: AnyNodes<'n, F>, n: u64) -> Self {
        let mut boundaries = places.boundaries.then(|| nodes.all_rows(n));
        let first = boundaries.as_mut().and_then(Iterator::next);
        let inside = places.inside.iter();
        Blocks {
            is_begun: first.is_some(),
            boundaries,
            inside: row(inside.map(|offset| nodes.all_rows_inside(n, offset.clone()))),
            block: Block {
                count: 0,
                ends: first.unwrap_or_else(|| Transfer {
                    emission: Vec::new(),
                    extinction: Vec::new(),
                }),
                inside: Vec::with_capacity(places.inside.len()),
            },
        }
    }

    /// The front of the ray, where a rule looks at boundaries.
    fn front(&self) -> Option<Segment<'_, R>> {
        let block = &self.block;
        let is_there = self.is_begun && !block.ends.extinction.is_empty();
        is_there.then_some(Segment { block, index: 0 })
    }

    fn next(&mut self) -> Option<&Block<R>> {
        let block = &mut self.block;
        if let Some(rows) = self.boundaries.as_mut().filter(|_| !self.is_begun) {
            let next = rows.next()?;
            // The back of the last segment is the front of the next.
            let carried = |ends: &mut Vec<R>, next: Vec<R>| {
                ends.drain(..ends.len().saturating_sub(1));
                ends.extend(next);
            };
            carried(&mut block.ends.emission, next.emission);
            carried(&mut block.ends.extinction, next.extinction);
        }
        self.is_begun = false;
        block.inside.clear();
        for rows in &mut self.inside {
            block.inside.push(rows.next()?);
        }
        let of_inside = block.inside.first();
        block.count = match of_inside {
            Some(inside) => inside.extinction.len(),
            None => block.ends.extinction.len().saturating_sub(1),
        };
        (block.count > 0).then_some(block)
    }
}

impl<R> Block<R> {
    /// From front to back.
    fn segments(&self) -> impl Iterator<Item = Segment<'_, R>> {
        (0..self.count).map(|index| Segment { block: self, index })
    }
}

impl<'b, R: Real> Segment<'b, R> {
    /// C and τ at a place.
    fn at(self, place: usize) -> Option<(&'b R, &'b R)> {
        let (transfers, index) = match place {
            FRONT => (&self.block.ends, self.index),
            BACK => (&self.block.ends, self.index + 1),
            _ => (self.block.inside.get(place - INSIDE)?, self.index),
        };
        Some((
            transfers.emission.get(index)?,
            transfers.extinction.get(index)?,
        ))
    }

    /// C τ at a place.
    fn source(self, place: usize) -> Option<R> {
        let (emission, extinction) = self.at(place)?;
        Some(emission.clone() * extinction)
    }
}
