//! A renderer along the axes of a plan.

use super::classes::{Class, classes};
use super::ladder::Ladder;
use super::measured::{Measured, Pictures};
use super::norms::norms;
use super::orders::is_settled;
use super::plan::{Axis, PixelIs, Plan};
use super::renderer::{Asked, RenderError, Renderer};
use crate::case::volume::VolumeCase;
use crate::image::Image;
use crate::reference::ExactPicture;
use crate::study::Progress;

/// A renderer with what it is asked.
pub(super) struct Run<'a, P> {
    pub(super) case: &'a VolumeCase,
    renderer: &'a mut dyn Renderer,
    pub(super) plan: &'a Plan,
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
    let wanted = plan.pixel.exact(&exact, size);
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
        measured.push(of_steps_or_segments(ladder, &equal, has_equal));
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
        left: of_step + of_grid + floor,
        not_finite,
        quantum: run.quantum,
        classes: of_pixels,
    })
}

pub(super) fn last(counts: &[usize]) -> usize {
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

/// The ladder of steps, in the sizes of steps or of equal segments: what nobody knows shows in how steadily errors fall.
fn of_steps_or_segments(ladder: Ladder<'_>, equal: &[f64], has_equal: Option<bool>) -> Measured {
    let own = ladder.measured();
    let is_open = has_equal.is_none() && !own.changes_nothing && !is_settled(own.fit.as_ref());
    let of_segments = || {
        Ladder {
            sizes: equal,
            ..ladder
        }
        .measured()
    };
    let other = is_open.then(of_segments);
    match other.filter(|other| is_settled(other.fit.as_ref())) {
        Some(other) => Measured {
            equal_segments: true,
            ..other
        },
        None => Measured {
            equal_segments: has_equal == Some(true),
            ..own
        },
    }
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
    pub(super) fn render(
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
}
