//! Pictures of one axis, all of one size, beside the exact one.

use super::classes::Class;
use super::measured::{HALF, Level, Lost, Map, Measured, TENTH};
use super::norms::norms;
use super::orders::{ROUNDING, brightest, changes_nothing, fitted, is_settled, orders};
use super::plan::Axis;
use crate::convergence::Fit;
use crate::image::Image;

/// Pictures of one axis, all of one size.
#[derive(Clone, Copy)]
pub(super) struct Ladder<'a> {
    pub(super) axis: Axis,
    pub(super) counts: &'a [usize],
    pub(super) images: &'a [Image],
    pub(super) wanted: &'a Image,
    pub(super) classes: &'a [Class],
    pub(super) others: f64,
    /// The length of a step, or the distance of samples, level by level.
    pub(super) sizes: &'a [f64],
    pub(super) expected: Option<f64>,
}

impl Ladder<'_> {
    pub(super) fn measured(&self) -> Measured {
        let beside_exact = self.levels(|k| Some((self.images.get(k)?, self.wanted)), self.others);
        let clean = beside_exact.iter().filter(|level| level.is_clean).count();
        let first = fitted(&beside_exact, self.expected);
        // Of differences those of the other axes, which stay as they are, are no part.
        let differs = clean < 4 && !is_settled(first.as_ref()) && self.others > 0.0;
        let levels = if differs {
            let next = |k: usize| Some((self.images.get(k)?, self.images.get(k + 1)?));
            self.levels(next, ROUNDING * brightest(Some(self.wanted)))
        } else {
            Vec::new()
        };
        let second = fitted(&levels, self.expected);
        let changes_nothing = changes_nothing(&levels);
        let by_differences = differs && (changes_nothing || is_settled(second.as_ref()));
        let fit = if by_differences { second } else { first };
        let shown = if by_differences { levels } else { beside_exact };
        let per_pixel = self.per_pixel(by_differences);
        Measured {
            axis: self.axis,
            orders: orders(&shown),
            lost: self.lost(&per_pixel, fit.as_ref()),
            error: Some(self.error()),
            levels: shown,
            fit,
            by_differences,
            changes_nothing,
            equal_segments: false,
            expected: self.expected,
            per_pixel: Some(per_pixel),
        }
    }

    fn levels<'i>(
        &self,
        pair: impl Fn(usize) -> Option<(&'i Image, &'i Image)>,
        others: f64,
    ) -> Vec<Level> {
        let hit = |k: usize| self.classes.get(k) != Some(&Class::Outside);
        let smooth = |k: usize| self.classes.get(k) == Some(&Class::Smooth);
        let level = |(k, &count): (usize, &usize)| {
            let (one, other) = pair(k)?;
            let of_smooth = norms(one, other, smooth);
            Some(Level {
                count,
                size: *self.sizes.get(k)?,
                all: norms(one, other, hit),
                smooth: of_smooth,
                others,
                is_clean: others <= TENTH * of_smooth.l2,
            })
        };
        self.counts.iter().enumerate().filter_map(level).collect()
    }

    /// The error of every pixel at one level, the largest of its channels.
    fn errors(one: &Image, other: &Image) -> Vec<f64> {
        let channels = one.channels.len().max(1);
        let pairs = one
            .values
            .chunks(channels)
            .zip(other.values.chunks(channels));
        pairs
            .map(|(one, other)| {
                let off = one.iter().zip(other).map(|(a, b)| (a - b).abs());
                off.fold(0.0, |most: f64, off| {
                    if off.is_nan() {
                        f64::NAN
                    } else {
                        most.max(off)
                    }
                })
            })
            .collect()
    }

    fn map(&self, values: Vec<f64>) -> Map {
        Map {
            width: self.wanted.width,
            height: self.wanted.height,
            values,
        }
    }

    fn error(&self) -> Map {
        let finest = self.images.last().unwrap_or(self.wanted);
        self.map(Self::errors(finest, self.wanted))
    }

    /// By the finest two levels that are above what others may be, over the span of three where there are as many.
    fn per_pixel(&self, by_differences: bool) -> Map {
        let at = |k: usize| {
            let image = self.images.get(k)?;
            let other = if by_differences {
                self.images.get(k + 1)?
            } else {
                self.wanted
            };
            Some((*self.counts.get(k)?, Self::errors(image, other)))
        };
        let all: Vec<(usize, Vec<f64>)> = (0..self.images.len()).filter_map(at).collect();
        let others = if by_differences { 0.0 } else { self.others };
        let pixels = self.wanted.width * self.wanted.height;
        let order = |pixel: usize| {
            let usable: Vec<(f64, f64)> = all
                .iter()
                .filter_map(|(count, errors)| {
                    let error = *errors.get(pixel)?;
                    (error > others / TENTH && error > 1e-15).then_some((*count as f64, error))
                })
                .collect();
            let [.., _, _] = usable.as_slice() else {
                return f64::NAN;
            };
            let from = usable[usable.len().saturating_sub(3)];
            let to = usable[usable.len() - 1];
            (from.1 / to.1).ln() / (to.0 / from.0).ln()
        };
        self.map((0..pixels).map(order).collect())
    }

    fn lost(&self, orders: &Map, fit: Option<&Fit>) -> Vec<Lost> {
        let Some(order) = self.expected.or_else(|| fit.and_then(|fit| fit.order)) else {
            return Vec::new();
        };
        let error = self.error();
        let total: f64 = error
            .values
            .iter()
            .filter(|e| e.is_finite())
            .map(|e| e * e)
            .sum();
        let of = |class: Class| {
            let mut lost = Lost {
                class,
                pixels: 0,
                shown: 0,
                lower: 0,
                share: 0.0,
            };
            for (k, own) in self.classes.iter().enumerate() {
                if *own != class {
                    continue;
                }
                lost.pixels += 1;
                let seen = orders.values.get(k).copied().unwrap_or(f64::NAN);
                lost.shown += usize::from(seen.is_finite());
                lost.lower += usize::from(seen < order - HALF);
                let off = error.values.get(k).copied().unwrap_or(0.0);
                if off.is_finite() && total > 0.0 {
                    lost.share += off * off / total;
                }
            }
            lost
        };
        let all = Class::ALL.into_iter().map(of);
        all.filter(|lost| lost.pixels > 0).collect()
    }
}
