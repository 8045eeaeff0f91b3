//! The three axes: the step along rays, the grid of the samples, the pixel.

use super::classes::{Class, classes};
use super::norms::{Norms, norms};
use super::renderer::{Asked, RenderError, Renderer};
use crate::case::volume::VolumeCase;
use crate::convergence::{Fit, Sample, Verdict, fit};
use crate::image::Image;
use crate::method::Expected;
use crate::reference::ExactPicture;
use crate::study::Progress;
use rug::Float;
use serde::Serialize;

/// What is refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// The length of steps along rays.
    Step,
    /// The distance of samples of the grid.
    Grid,
    /// The size of pixels.
    Pixel,
}

impl Axis {
    /// As options have it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Axis::Step => "step",
            Axis::Grid => "grid",
            Axis::Pixel => "pixel",
        }
    }
}

/// What a pixel is to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum PixelIs {
    /// The radiance through its middle.
    Centre,
    /// The mean over it.
    Mean,
}

/// The levels of all axes, and what is expected of each.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Steps along the diagonal of the box, by rising number.
    pub steps: Vec<usize>,
    /// Cells of the grid along each axis, by rising number.
    pub cells: Vec<usize>,
    /// Pixels along the shorter side, by rising number.
    pub pixels: Vec<usize>,
    /// Pixels along the shorter side where step and grid are refined.
    pub side: usize,
    /// Width by height of pictures, as a ratio.
    pub aspect: [usize; 2],
    /// Axes that are measured.
    pub axes: Vec<Axis>,
    /// What a pixel is to be where step and grid are refined.
    pub pixel: PixelIs,
    /// Orders that theory gives, where it is known.
    pub expected: [Option<f64>; 3],
}

impl Plan {
    /// The size of pictures of so many pixels along the shorter side.
    #[must_use]
    pub fn size(&self, side: usize) -> [usize; 2] {
        let [width, height] = self.aspect;
        let shorter = width.min(height).max(1);
        [side * width / shorter, side * height / shorter]
    }

    /// Pictures that are made.
    #[must_use]
    pub fn pictures(&self) -> usize {
        let of = |axis: Axis| match axis {
            Axis::Step => self.steps.len(),
            Axis::Grid => self.cells.len(),
            Axis::Pixel => self.pixels.len(),
        };
        self.axes.iter().map(|axis| of(*axis)).sum::<usize>() + 1
    }
}

/// One picture of an axis beside the exact one.
#[derive(Clone, Debug, Serialize)]
pub struct Level {
    /// Cells, steps along the diagonal, or pixels along the shorter side.
    pub count: usize,
    /// The length of a step, the distance of samples, or the size of a pixel, in units of length at the target.
    pub size: f64,
    /// Of all pixels whose rays hit the volume.
    pub all: Norms,
    /// Of those where everything is analytic.
    pub smooth: Norms,
    /// What the errors of the other two axes may be, by the same norm (L2).
    pub others: f64,
    /// Whether these are under a tenth.
    pub is_clean: bool,
}

/// What is known of an axis.
#[derive(Clone, Debug, Serialize)]
pub struct Measured {
    /// Which.
    pub axis: Axis,
    /// From coarse to fine.
    pub levels: Vec<Level>,
    /// The order of L2 over smooth pixels.
    pub fit: Option<Fit>,
    /// Orders of max, L1 and L2 over all pixels.
    pub orders: [Option<f64>; 3],
    /// Whether errors are differences of levels one behind the other: those of the other axes, which stay, take no part.
    pub by_differences: bool,
    /// What was expected.
    pub expected: Option<f64>,
    /// The size of steps is that of equal segments: known, or because errors fall more steadily in it.
    pub equal_segments: bool,
    /// Refining it changes nothing beyond rounding: it has no error here.
    pub changes_nothing: bool,
    /// Where the order is lost.
    pub lost: Vec<Lost>,
    /// The order of every pixel, by its two finest levels; NaN where there is none.
    #[serde(skip)]
    pub per_pixel: Option<Map>,
    /// The error of every pixel at the finest level, the largest of its channels.
    #[serde(skip)]
    pub error: Option<Map>,
}

impl Measured {
    /// Orders of the last three refinements, coarse to fine, where they do not go to what is expected, though there is no
    /// window and the errors of the other axes are small: more than a half below, they fall, go up and down, or rise by less and less
    /// to a limit that is below as well (Aitken's).
    #[must_use]
    pub fn falls_short(&self) -> Option<[f64; 3]> {
        let [.., a, b, c, d] = self.levels.as_slice() else {
            return None;
        };
        let least = self.expected? - HALF;
        let order = |coarse: &Level, fine: &Level| {
            let error = (coarse.smooth.l2 / fine.smooth.l2).ln();
            error / (coarse.size / fine.size).ln()
        };
        let orders = [order(a, b), order(b, c), order(c, d)];
        let [first, second, third] = orders;
        let (before, now) = (second - first, third - second);
        let limit = if now <= 0.0 && before <= 0.0 {
            third
        } else if now > 0.0 && before > 0.0 {
            if now < before {
                third + now * now / (before - now)
            } else {
                f64::INFINITY
            }
        } else {
            first.max(second).max(third)
        };
        let is_clean = [a, b, c, d].iter().all(|level| level.is_clean);
        (is_clean && limit < least).then_some(orders)
    }
}

/// A number for every pixel.
#[derive(Clone, Debug)]
pub struct Map {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// From the upper left corner.
    pub values: Vec<f64>,
}

/// Pixels of a class, and how many of them lose order.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Lost {
    /// What their rays meet.
    pub class: Class,
    /// How many there are.
    pub pixels: usize,
    /// Of how many an order shows.
    pub shown: usize,
    /// How many of these are more than a half below what is expected, or seen on smooth pixels.
    pub lower: usize,
    /// The part of the squared error at the finest level.
    pub share: f64,
}

/// Everything that was measured of a renderer on a volume.
#[derive(Debug)]
pub struct Pictures {
    /// The renderer.
    pub renderer: String,
    /// By axis.
    pub axes: Vec<Measured>,
    /// The finest picture, with the exact one.
    pub finest: Image,
    /// The exact one.
    pub exact: Image,
    /// The next coarser one in all of step and grid, at the same size.
    pub coarser: Image,
    /// Pixels whose values are no finite numbers.
    pub not_finite: usize,
    /// The quantum of values.
    pub quantum: Option<f64>,
    /// The classes of pixels.
    pub classes: Vec<Class>,
}

/// The part of an error that others may be.
const TENTH: f64 = 0.1;
/// Of the errors of the others a fit takes this part for the floor, which cuts at 30 floors.
const FLOOR: f64 = 1.0 / (30.0 * TENTH);
/// Points along a pixel's side for its mean.
const MEAN_POINTS: u32 = 4;
/// What rounding in binary64 leaves of a difference, relative to the brightest pixel.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// An order this much lower is lost.
const HALF: f64 = 0.5;

struct Run<'a, P> {
    case: &'a VolumeCase,
    renderer: &'a mut dyn Renderer,
    plan: &'a Plan,
    progress: &'a P,
    quantum: Option<f64>,
}

/// Refines a renderer along the axes of the plan.
///
/// # Errors
/// The first [`RenderError`].
pub fn pictures<P: Progress>(
    case: &VolumeCase,
    renderer: &mut dyn Renderer,
    plan: &Plan,
    progress: &P,
) -> Result<Pictures, RenderError> {
    let exact = ExactPicture::new(case);
    let size = plan.size(plan.side);
    let of_pixels = classes(case, size, plan.pixel == PixelIs::Mean);
    let name = renderer.name();
    let mut run = Run {
        case,
        renderer,
        plan,
        progress,
        quantum: None,
    };
    let (steps, cells) = (last(&plan.steps), last(&plan.cells));
    let wanted = match plan.pixel {
        PixelIs::Centre => exact.centres(size),
        PixelIs::Mean => exact.means(size, MEAN_POINTS),
    };
    if of_pixels.iter().all(|class| *class == Class::Outside) {
        return Err(RenderError::Unseen);
    }
    let mut by_step = Vec::new();
    for &count in &plan.steps {
        by_step.push(run.render(count, cells, size)?);
    }
    let mut by_grid = Vec::new();
    for &count in plan.cells.iter().filter(|count| **count != cells) {
        by_grid.push(run.render(steps, count, size)?);
    }
    let finest = by_step.last().cloned().unwrap_or_else(|| wanted.clone());
    by_grid.push(finest.clone());
    let smooth = |k: usize| of_pixels.get(k) == Some(&Class::Smooth);
    // What is left of each axis at its finest level.
    let left = |ladder: &[Image], counts: &[usize], expected: Option<f64>| {
        remaining(ladder, counts, expected, smooth)
    };
    let of_step = left(&by_step, &plan.steps, plan.expected[0]);
    let of_grid = left(&by_grid, &plan.cells, plan.expected[1]);
    let steps_of = |count: &usize| diagonal(case) / *count as f64;
    let of_steps: Vec<f64> = plan.steps.iter().map(steps_of).collect();
    let equal = of_steps.iter();
    let equal: Vec<f64> = equal
        .map(|step| equal_segments(case, size, &of_pixels, *step))
        .collect();
    let has_equal = run.renderer.has_equal_segments();
    let of_cells = plan.cells.iter().map(|cells| longest(case) / *cells as f64);
    let of_cells: Vec<f64> = of_cells.collect();
    let floor = run.quantum.map_or(0.0, |quantum| quantum / 2.0);
    let mut measured = Vec::new();
    let shown = |axis: Axis| plan.axes.contains(&axis);
    if shown(Axis::Step) {
        let ladder = Ladder {
            axis: Axis::Step,
            counts: &plan.steps,
            images: &by_step,
            wanted: &wanted,
            classes: &of_pixels,
            others: of_grid + floor,
            sizes: if has_equal == Some(true) {
                &equal
            } else {
                &of_steps
            },
            expected: plan.expected[0],
        };
        let own = ladder.measured();
        // What nobody knows shows in how steadily errors fall.
        let is_open = has_equal.is_none() && !own.changes_nothing && !is_settled(own.fit.as_ref());
        let other = is_open.then(|| {
            Ladder {
                sizes: &equal,
                ..ladder
            }
            .measured()
        });
        let other = other.filter(|other| is_settled(other.fit.as_ref()));
        measured.push(match other {
            Some(other) => Measured {
                equal_segments: true,
                ..other
            },
            None => Measured {
                equal_segments: has_equal == Some(true),
                ..own
            },
        });
    }
    if shown(Axis::Grid) {
        let ladder = Ladder {
            axis: Axis::Grid,
            counts: &plan.cells,
            images: &by_grid,
            wanted: &wanted,
            classes: &of_pixels,
            others: of_step + floor,
            sizes: &of_cells,
            expected: plan.expected[1],
        };
        measured.push(ladder.measured());
    }
    if shown(Axis::Pixel) {
        measured.push(run.pixels(&exact, of_step + of_grid + floor)?);
    }
    let next = plan.steps.len().saturating_sub(2);
    let coarser = by_step.get(next).cloned().unwrap_or_else(|| finest.clone());
    let not_finite = norms(&finest, &wanted, |_| true).not_finite;
    Ok(Pictures {
        renderer: name,
        axes: measured,
        finest,
        exact: wanted,
        coarser,
        not_finite,
        quantum: run.quantum,
        classes: of_pixels,
    })
}

fn last(counts: &[usize]) -> usize {
    counts.last().copied().unwrap_or(1)
}

fn diagonal(case: &VolumeCase) -> f64 {
    let [low, high] = case.corners;
    let [x, y, z] = [0, 1, 2].map(|axis| high[axis] - low[axis]);
    x.hypot(y).hypot(z)
}

fn longest(case: &VolumeCase) -> f64 {
    let [low, high] = case.corners;
    let sides = [0, 1, 2].map(|axis| high[axis] - low[axis]);
    sides.into_iter().fold(0.0, f64::max)
}

/// The root of the mean square, over smooth rays, of segments that cut them evenly.
fn equal_segments(case: &VolumeCase, size: [usize; 2], classes: &[Class], step: f64) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    let smooth = classes.iter().enumerate();
    for (k, _) in smooth.filter(|(_, class)| **class == Class::Smooth) {
        let place = [(k % size[0]) as f64 + 0.5, (k / size[0]) as f64 + 0.5];
        let ray = case.camera.ray(size, place);
        if let Some(chord) = ray.and_then(|ray| case.chord(&ray)) {
            let length = chord.to - chord.from;
            sum += (length / (length / step).ceil().max(1.0)).powi(2);
            count += 1.0;
        }
    }
    if count > 0.0 {
        (sum / count).sqrt()
    } else {
        step
    }
}

/// What the finest picture of a ladder is off, by what the last refinement changed: e ≈ |Qₖ₋₁ − Qₖ|/(rᵖ − 1).
fn remaining(
    ladder: &[Image],
    counts: &[usize],
    expected: Option<f64>,
    smooth: impl Fn(usize) -> bool,
) -> f64 {
    let ([.., before, last], [.., few, many]) = (ladder, counts) else {
        return 0.0;
    };
    let ratio = *many as f64 / *few as f64;
    let order = expected.unwrap_or(1.0).max(0.5);
    norms(before, last, smooth).l2 / (ratio.powf(order) - 1.0).max(0.1)
}

impl<P: Progress> Run<'_, P> {
    fn render(
        &mut self,
        steps: usize,
        cells: usize,
        size: [usize; 2],
    ) -> Result<Image, RenderError> {
        let asked = Asked {
            case: self.case,
            cells,
            size,
            step: diagonal(self.case) / steps as f64,
        };
        let rendered = self.renderer.render(&asked)?.fitting(&asked)?;
        self.progress.advance(1);
        self.quantum = self.quantum.or(rendered.quantum);
        Ok(rendered.image)
    }

    /// Pictures of more and more pixels beside the means over these.
    fn pixels(&mut self, exact: &ExactPicture<'_>, others: f64) -> Result<Measured, RenderError> {
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

/// Pictures of one axis, all of one size.
#[derive(Clone, Copy)]
struct Ladder<'a> {
    axis: Axis,
    counts: &'a [usize],
    images: &'a [Image],
    wanted: &'a Image,
    classes: &'a [Class],
    others: f64,
    /// The length of a step, or the distance of samples, level by level.
    sizes: &'a [f64],
    expected: Option<f64>,
}

impl Ladder<'_> {
    fn measured(&self) -> Measured {
        let beside_exact = self.levels(|k| Some((self.images.get(k)?, self.wanted)), self.others);
        let clean = beside_exact.iter().filter(|level| level.is_clean).count();
        let first = fitted(&beside_exact, self.expected);
        // Of differences those of the other axes, which stay as they are, are no part.
        let differs = clean < 4 && !is_settled(first.as_ref()) && self.others > 0.0;
        let levels = if differs {
            {
                let rounding = ROUNDING * brightest(Some(self.wanted));
                self.levels(
                    |k| Some((self.images.get(k)?, self.images.get(k + 1)?)),
                    rounding,
                )
            }
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

/// Whether an order was found, or that there is nothing left to be one of.
fn is_settled(fit: Option<&Fit>) -> bool {
    fit.is_some_and(|fit| fit.verdict.is_of_an_order() || fit.verdict == Verdict::Exact)
}

/// Whether there are differences, and all of them are rounding.
fn changes_nothing(differences: &[Level]) -> bool {
    !differences.is_empty()
        && differences
            .iter()
            .all(|level| level.all.max <= level.others)
}

fn brightest(image: Option<&Image>) -> f64 {
    let values = image.into_iter().flat_map(|image| &image.values);
    values.fold(0.0, |most: f64, value| most.max(value.abs()))
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

/// The order of L2 over smooth pixels.
fn fitted(levels: &[Level], expected: Option<f64>) -> Option<Fit> {
    let samples: Vec<Sample> = levels
        .iter()
        .map(|level| Sample {
            n: Some(level.count as u64),
            step: level.size,
            error: Float::with_val(53, level.smooth.l2),
            floor: Float::with_val(53, FLOOR * level.others),
        })
        .collect();
    fit(&samples, expected.map(Expected::Order)).ok()
}

/// Orders of max, L1 and L2 over all pixels, between the two finest levels.
fn orders(levels: &[Level]) -> [Option<f64>; 3] {
    let [.., before, last] = levels else {
        return [None; 3];
    };
    let ratio = (last.count as f64 / before.count as f64).ln();
    let order = |of: fn(&Norms) -> f64| {
        let order = (of(&before.all) / of(&last.all)).ln() / ratio;
        order.is_finite().then_some(order)
    };
    [order(|n| n.max), order(|n| n.l1), order(|n| n.l2)]
}
