//! A ray in one pass: nested rules that look inside segments too, in memory that does not grow with the ray.

use super::error::{MethodError, require_multiple};
use super::outer::CompositeWeights;
use super::{Exponential, Inner, Nested, Outer, Scope};
use crate::case::{AnyNodes, Nodes, Transfer};
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
    let mut segments = Segments::new(&places, nodes, n);
    if let Some(first) = &segments.front {
        sum += &(source(first) * &front.transmittance() * &weights.first);
    }
    let mut repeating = weights.repeating.iter().cycle().skip(1);
    for j in 1..=n {
        let Some(segment) = segments.next() else {
            break;
        };
        front.pass(&depth.of(segment));
        let weight = match repeating.next() {
            Some(weight) if j < n => weight,
            _ => &weights.last,
        };
        if let Some(back) = segment.get(BACK) {
            sum += &(source(back) * &front.transmittance() * weight);
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
    let mut segments = Segments::new(&places, nodes, n);
    while let Some(segment) = segments.next() {
        for (place, partial, part) in &mut looks {
            if let Some(at) = segment.get(*place) {
                *part += &(source(at) * &front.inside(partial.of(segment)));
            }
        }
        front.pass(&depth.of(segment));
    }
    let mut sum = format.int(0);
    for ((_, _, part), weight) in looks.into_iter().zip(&table.weights) {
        sum += &(part * &format.ratio(weight));
    }
    Ok(sum * &step(&nodes, n))
}

/// C τ.
fn source<R: Real>(at: &Transfer<R>) -> R {
    at.emission.clone() * &at.extinction
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
    fn of(&self, segment: &[Transfer<R>]) -> R {
        let mut terms = self.looks.iter().filter_map(|(place, weight)| {
            let at = segment.get(*place)?;
            Some(at.extinction.clone() * weight)
        });
        // A rule has a node at least.
        let mut sum = terms.next().unwrap_or_else(|| self.length.format().int(0));
        for term in terms {
            sum += &term;
        }
        sum * &self.length
    }
}

/// The segments of a ray from front to back, each with C and τ at its [`Places`].
struct Segments<'n, R> {
    /// At the front of the segment to come.
    front: Option<Transfer<R>>,
    boundaries: Option<March<'n, R>>,
    inside: Vec<March<'n, R>>,
    segment: Vec<Transfer<R>>,
}

type March<'n, R> = Box<dyn Iterator<Item = Transfer<R>> + 'n>;

impl<'n, R: Real> Segments<'n, R> {
    fn new<F: Format<Real = R>>(places: &Places, nodes: AnyNodes<'n, F>, n: u64) -> Self {
        let mut boundaries = places.boundaries.then(|| nodes.marching(n));
        let inside = places.inside.iter();
        Segments {
            front: boundaries.as_mut().and_then(Iterator::next),
            boundaries,
            inside: row(inside.map(|offset| nodes.marching_inside(n, offset.clone()))),
            segment: Vec::with_capacity(INSIDE + places.inside.len()),
        }
    }

    /// The next segment's values: front, back, inside; the ends are those of the middle where no rule looks at them.
    fn next(&mut self) -> Option<&[Transfer<R>]> {
        self.segment.clear();
        let mut inside = self.inside.iter_mut();
        if let Some(boundaries) = &mut self.boundaries {
            let back = boundaries.next()?;
            let front = self.front.replace(back.clone())?;
            self.segment.extend([front, back]);
        } else {
            let first = inside.next()?.next()?;
            self.segment.extend([first.clone(), first.clone(), first]);
        }
        for march in inside {
            self.segment.push(march.next()?);
        }
        Some(&self.segment)
    }
}
