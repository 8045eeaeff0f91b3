//! Pictures of more and more pixels.

use super::classes::{Class, classes};
use super::measured::{Level, Measured, TENTH};
use super::norms::norms;
use super::orders::{ROUNDING, brightest, fitted, is_settled, orders};
use super::plan::{Axis, MEAN_POINTS};
use super::renderer::RenderError;
use super::run::{Run, last};
use crate::image::Image;
use crate::reference::ExactPicture;
use crate::study::Progress;

impl<P: Progress> Run<'_, P> {
    /// Pictures of more and more pixels beside the means over these.
    pub(super) fn pixels(
        &mut self,
        exact: &ExactPicture<'_>,
        others: f64,
    ) -> Result<Measured, RenderError> {
        let plan = self.plan;
        let (steps, cells) = (last(&plan.steps), last(&plan.cells));
        let coarsest = plan.size(plan.pixels.first().copied().unwrap_or(1));
        let region = classes(self.case, coarsest, true);
        let mut images = Vec::new();
        for &side in &plan.pixels {
            images.push(self.render(steps, cells, plan.size(side))?);
        }
        let level =
            |(k, &side): (usize, &usize), other: &dyn Fn(usize) -> Option<Image>, others: f64| {
                let size = plan.size(side);
                let (image, wanted) = (images.get(k)?, other(k)?);
                let classes = classes(self.case, size, true);
                let hit = |k: usize| classes.get(k) != Some(&Class::Outside);
                // The same part of the picture at all levels: pixels in those of the coarsest that are smooth.
                let smooth = |k: usize| is_within(&region, coarsest, size, k);
                let smooth = norms(image, &wanted, smooth);
                Some(Level {
                    count: side,
                    size: 1.0 / side as f64,
                    all: norms(image, &wanted, hit),
                    smooth,
                    others,
                    is_clean: others <= TENTH * smooth.l2,
                })
            };
        let levels = |other: &dyn Fn(usize) -> Option<Image>, others: f64| -> Vec<Level> {
            let counts = plan.pixels.iter().enumerate();
            counts
                .filter_map(|count| level(count, other, others))
                .collect()
        };
        let means = |k: usize| Some(exact.means(plan.size(*plan.pixels.get(k)?), MEAN_POINTS));
        let beside_exact = levels(&means, others);
        let expected = plan.expected[2];
        let first = fitted(&beside_exact, expected);
        // The means of the next finer picture's pixels have that picture's errors of step and grid.
        let finer = |k: usize| Some(means_of(images.get(k + 1)?, images.get(k)?));
        let differs =
            !is_settled(first.as_ref()) && plan.pixels.windows(2).all(|w| w[1] == 2 * w[0]);
        let rounding = ROUNDING * brightest(images.last());
        let second = if differs {
            levels(&finer, rounding)
        } else {
            Vec::new()
        };
        let of_second = fitted(&second, expected);
        let by_differences = differs && is_settled(of_second.as_ref());
        let (levels, fit) = if by_differences {
            (second, of_second)
        } else {
            (beside_exact, first)
        };
        Ok(Measured {
            axis: Axis::Pixel,
            fit,
            orders: orders(&levels),
            levels,
            by_differences,
            changes_nothing: false,
            equal_segments: false,
            expected,
            lost: Vec::new(),
            per_pixel: None,
            error: None,
        })
    }
}

/// Whether a pixel of a picture lies in pixels of a coarser one that are smooth.
fn is_within(region: &[Class], coarse: [usize; 2], size: [usize; 2], pixel: usize) -> bool {
    let [column, row] = [pixel % size[0], pixel / size[0]];
    let span = |place: usize, of: usize, coarse: usize| {
        let first = place * coarse / of;
        let last = ((place + 1) * coarse).div_ceil(of).saturating_sub(1);
        first..=last.min(coarse.saturating_sub(1))
    };
    span(row, size[1], coarse[1]).all(|y| {
        span(column, size[0], coarse[0])
            .all(|x| region.get(y * coarse[0] + x) == Some(&Class::Smooth))
    })
}

/// The means of squares of four pixels, in the size of the coarser picture.
fn means_of(fine: &Image, coarse: &Image) -> Image {
    let mut means = coarse.clone();
    let channels = coarse.channels.len().max(1);
    for (k, value) in means.values.iter_mut().enumerate() {
        let (pixel, channel) = (k / channels, k % channels);
        let (x, y) = (2 * (pixel % coarse.width), 2 * (pixel / coarse.width));
        let four = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
        let of = |(x, y)| fine.pixel(x, y).get(channel).copied().unwrap_or(f64::NAN);
        *value = four.into_iter().map(of).sum::<f64>() / 4.0;
    }
    means
}
