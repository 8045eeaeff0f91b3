//! Depths of random samples, a seed for each ray: replicas side by side.

use super::{RayError, RayMedium, side_by_side};
use crate::case::{Places, Transfer};
use crate::method::outer::CompositeWeights;
use crate::method::{Exponential, Inner, Method, Nested, Outer, Scope};
use crate::quadrature::{Draws, Sampling};
use crate::real::lanes::{LaneFloat, LaneFormat, LaneReal, Lanes, MOST, WithLanes};
use crate::real::{Format, row};
use rug::Rational;

/// The radiance of ray r by `method` with the seed r of `seeds`, whatever seed the method has, of rays of that length on n
/// segments, as many side by side as [`Width::current`](crate::real::lanes::Width::current) says: bit for bit that of
/// [`Method::radiance`] with that seed in the lanes' format. Where the rays of `medium` are all the same, these are replicas.
///
/// # Errors
/// [`RayError`] where the method draws no samples or does not go in lanes, or not on n segments.
pub fn drawn_radiances<T: LaneFloat, M: RayMedium<T>>(
    method: &Method,
    medium: &M,
    length: &Rational,
    n: u64,
    seeds: &[u64],
) -> Result<Vec<T>, RayError> {
    let refused = || RayError::Undrawn {
        method: method.name(),
    };
    let (sampling, outer) = way(method).ok_or_else(refused)?;
    method.check_segments(n)?;
    // Rules that look inside segments have no such weights.
    let intervals = outer.0.intervals().ok_or_else(refused)?;
    let ray = Ray::new(sampling, length, n, |format| {
        CompositeWeights::new(outer.0, intervals, format)
    })?;
    let mut radiances = vec![T::ZERO; seeds.len()];
    side_by_side(seeds.len(), |width, from, to| {
        width.with(March {
            rays: Rays { ray: &ray, medium },
            first: from,
            seeds: &seeds[from..to],
            radiances: &mut radiances[from..to],
        });
    });
    Ok(radiances)
}

/// What samples are drawn, and under which rule; `None` where none are, or lanes do not go that way.
fn way(method: &Method) -> Option<(Sampling, Outer)> {
    match *method {
        Method::Nested(Nested {
            inner: Inner::MonteCarlo { sampling, .. },
            outer,
            exponential: Exponential::Exact,
            scope: Scope::Whole,
        }) => Some((sampling, outer)),
        _ => None,
    }
}

/// What is the same for all rays, rounded as columns of nodes have it.
struct Ray<T> {
    sampling: Sampling,
    n: u64,
    length: T,
    step: T,
    boundaries: Vec<T>,
    /// 1/n, and λ of each boundary but the first: how far independent samples reach.
    part: T,
    reaches: Vec<T>,
    /// d again for samples of strata, whose fronts these are.
    fronts: Vec<T>,
    weights: Vec<T>,
}

impl<T: LaneFloat> Ray<T> {
    fn new<E>(
        sampling: Sampling,
        length: &Rational,
        n: u64,
        weights: impl FnOnce(LaneFormat<T>) -> Result<CompositeWeights<LaneReal<T>>, E>,
    ) -> Result<Self, E> {
        let format = LaneFormat::<T>::new();
        let weights = weights(format)?;
        let places = Places::new(length, n, &Rational::new());
        let whole = format.ratio(length);
        let reach = |i| format.ratio(&(Rational::from((i, n)) * length)).0;
        let front = |j| (format.fraction(j, n) * &whole).0;
        let (reaches, fronts) = match sampling {
            Sampling::Independent => (row((1..=n).map(reach)), Vec::new()),
            Sampling::Stratified => (Vec::new(), row((0..n).map(front))),
            Sampling::Shared => (Vec::new(), Vec::new()),
        };
        Ok(Ray {
            sampling,
            n,
            length: whole.0,
            step: format.ratio(&(Rational::from(length) / n)).0,
            boundaries: row((0..=n).map(|j| places.at(format, j).0)),
            part: format.fraction(1, n).0,
            reaches,
            fronts,
            weights: row((0..=n).map(|j| weights.at(j, n).0)),
        })
    }
}

/// All rays.
struct Rays<'m, T, M> {
    ray: &'m Ray<T>,
    medium: &'m M,
}

impl<T, M> Clone for Rays<'_, T, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T, M> Copy for Rays<'_, T, M> {}

/// Rays to march along, from the `first` on: a multiple of the width.
struct March<'m, T, M> {
    rays: Rays<'m, T, M>,
    first: usize,
    seeds: &'m [u64],
    radiances: &'m mut [T],
}

impl<T: LaneFloat, M: RayMedium<T>> WithLanes<T> for March<'_, T, M> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes<Element = T>>(self, zero: L) {
        let rays = self.rays;
        let seeds = self.seeds.chunks_exact(L::WIDTH);
        let radiances = self.radiances.chunks_exact_mut(L::WIDTH);
        for (lanes, (radiances, seeds)) in radiances.zip(seeds).enumerate() {
            let first = self.first + lanes * L::WIDTH;
            let mut numbers = Numbers {
                streams: row(seeds.iter().map(|&seed| Draws::new(seed, rays.ray.n))),
                drawn: [T::ZERO; MOST],
            };
            let depths = match rays.ray.sampling {
                Sampling::Stratified => rays.stratified(first, &mut numbers, zero),
                Sampling::Shared => rays.shared(first, &mut numbers, zero),
                Sampling::Independent => rays.independent(first, &mut numbers, zero),
            };
            rays.radiance(first, &depths, zero).store(radiances);
        }
    }
}

/// The random numbers of some rays.
struct Numbers<T> {
    streams: Vec<Draws>,
    drawn: [T; MOST],
}

impl<T: LaneFloat> Numbers<T> {
    /// The next of each stream.
    fn next(&mut self) -> &[T] {
        let format = LaneFormat::<T>::new();
        for (drawn, stream) in self.drawn.iter_mut().zip(&mut self.streams) {
            *drawn = format.binary64(stream.draw().value()).0;
        }
        &self.drawn
    }

    /// The next of each stream, and in which of n segments it lies.
    fn next_in(&mut self, n: u64, segments: &mut [usize; MOST]) -> &[T] {
        let format = LaneFormat::<T>::new();
        let drawn = self.drawn.iter_mut().zip(segments);
        for ((drawn, segment), stream) in drawn.zip(&mut self.streams) {
            let draw = stream.draw();
            *drawn = format.binary64(draw.value()).0;
            *segment = draw.part(n);
        }
        &self.drawn
    }
}

impl<T: LaneFloat, M: RayMedium<T>> Rays<'_, T, M> {
    /// t at the boundaries, of one sample in each segment.
    #[inline(always)]
    fn stratified<L: Lanes<Element = T>>(
        self,
        first: usize,
        numbers: &mut Numbers<T>,
        zero: L,
    ) -> Vec<L> {
        let Rays { ray, medium } = self;
        let width = zero.all(ray.step);
        let mut depths = vec![zero];
        for &front in &ray.fronts {
            let lambda = zero.load(numbers.next()) * width + zero.all(front);
            depths.push(medium.transfer(first, lambda).extinction * width);
        }
        sum_up(&mut depths, zero);
        depths
    }

    /// t at the boundaries, of n samples on the whole ray.
    #[inline(always)]
    fn shared<L: Lanes<Element = T>>(
        self,
        first: usize,
        numbers: &mut Numbers<T>,
        zero: L,
    ) -> Vec<L> {
        let Rays { ray, medium } = self;
        let length = zero.all(ray.length);
        let mut sums = vec![[T::ZERO; MOST]; ray.boundaries.len().saturating_sub(1)];
        let mut segments = [0; MOST];
        let mut extinctions = [T::ZERO; MOST];
        for _ in 0..ray.n {
            let lambda = zero.load(numbers.next_in(ray.n, &mut segments)) * length;
            let extinction = medium.transfer(first, lambda).extinction;
            extinction.store(&mut extinctions);
            let lanes = segments.iter().zip(&extinctions).take(L::WIDTH);
            for (lane, (&segment, extinction)) in lanes.enumerate() {
                if let Some(sum) = sums.get_mut(segment) {
                    sum[lane] += extinction;
                }
            }
        }
        let step = zero.all(ray.step);
        let mut depths = vec![zero];
        for sum in &sums {
            depths.push(zero.load(sum) * step);
        }
        sum_up(&mut depths, zero);
        depths
    }

    /// t at the boundaries, of n samples in front of each.
    #[inline(always)]
    fn independent<L: Lanes<Element = T>>(
        self,
        first: usize,
        numbers: &mut Numbers<T>,
        zero: L,
    ) -> Vec<L> {
        let Rays { ray, medium } = self;
        let mut depths = Vec::with_capacity(ray.boundaries.len());
        depths.push(zero);
        for &reach in &ray.reaches {
            let reach = zero.all(reach);
            let mut sum = zero;
            for _ in 0..ray.n {
                let lambda = zero.load(numbers.next()) * reach;
                sum = sum + medium.transfer(first, lambda).extinction;
            }
            depths.push(sum * reach * zero.all(ray.part));
        }
        depths
    }

    /// Σ W C τ e^(−t) over the boundaries.
    #[inline(always)]
    fn radiance<L: Lanes<Element = T>>(self, first: usize, depths: &[L], zero: L) -> L {
        let Rays { ray, medium } = self;
        let mut sum = zero;
        for ((&lambda, &weight), &depth) in ray.boundaries.iter().zip(&ray.weights).zip(depths) {
            let Transfer {
                emission,
                extinction,
            } = medium.transfer(first, zero.all(lambda));
            sum = sum + emission * extinction * (-depth).exp() * zero.all(weight);
        }
        sum * zero.all(ray.step)
    }
}

/// Each becomes the sum of all up to it. A loop: closures are not compiled for the vectors of the processor.
#[inline(always)]
fn sum_up<L: Lanes>(depths: &mut [L], zero: L) {
    let mut sum = zero;
    for depth in depths {
        sum = sum + *depth;
        *depth = sum;
    }
}
