//! The exact picture of a volume by formulas.
//!
//! Between breaks C and τ are analytic along a ray. A panel is integrated by Gauss's implicit Runge–Kutta method of 12
//! points, τ to its optical depth at the points and C τ e^(−t) to the radiance, and halved until both halves say the same
//! to 10⁻¹⁴: an estimate, of whose rays some are [enclosed](crate::reference::enclosed_radiance) beside it.

use crate::case::volume::{Break, Chord, VolumeCase, breaks};
use crate::image::Image;
use crate::parallel;
use crate::quadrature::{Collocation, collocation};
use crate::real::Native;
use crate::volume::Ray;
use std::sync::Arc;

/// Points of a panel.
const POINTS: u32 = 12;
/// What both halves of a panel may differ from it by, as a part of the largest emission, or of the depth.
const TOLERANCE: f64 = 1e-14;
/// How often a panel is halved.
const HALVINGS: u32 = 24;
/// Points along a side of pixels that are moved.
const MOVED_POINTS: u32 = 4;
/// Beyond this depth nothing is seen in binary64.
const DEEPEST: f64 = 800.0;

/// What a ray is.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// The radiance by channel.
    pub radiance: Vec<f64>,
    /// ∫τ dλ.
    pub depth: f64,
    /// What it meets on its way.
    pub breaks: Vec<(f64, Break)>,
    /// The part of the ray in the box; `None` where it misses it.
    pub chord: Option<Chord>,
}

/// The rays of a volume by formulas, exactly but for rounding.
#[derive(Clone, Debug)]
pub struct ExactPicture<'c> {
    case: &'c VolumeCase,
    panel: Option<Arc<Collocation<f64>>>,
    brightest: f64,
}

/// What a panel adds.
#[derive(Clone)]
struct Panel {
    depth: f64,
    radiance: Vec<f64>,
}

impl<'c> ExactPicture<'c> {
    /// Of that volume.
    #[must_use]
    pub fn new(case: &'c VolumeCase) -> Self {
        let emissions = case
            .transfer
            .points
            .iter()
            .flat_map(|point| &point.emission);
        ExactPicture {
            case,
            panel: collocation(POINTS, Native::<f64>::new()).ok(),
            brightest: emissions.fold(f64::MIN_POSITIVE, |most, c| most.max(c.abs())),
        }
    }

    /// The radiance along a ray.
    #[must_use]
    pub fn ray(&self, ray: &Ray) -> Seen {
        let channels = self.case.transfer.channels.len();
        let mut seen = Seen {
            radiance: vec![0.0; channels],
            depth: 0.0,
            breaks: Vec::new(),
            chord: self.case.chord(ray),
        };
        let (Some(chord), Some(panel)) = (seen.chord, &self.panel) else {
            return seen;
        };
        seen.breaks = breaks(self.case, ray, chord);
        let mut ends = vec![chord.from];
        ends.extend(seen.breaks.iter().map(|(place, _)| *place));
        ends.push(chord.to);
        for pair in ends.windows(2) {
            let &[from, to] = pair else { continue };
            if to <= from || seen.depth > DEEPEST {
                continue;
            }
            let whole = self.panel(panel, ray, from, to);
            let piece = self.halved(panel, ray, (from, to), &whole, HALVINGS);
            let through = (-seen.depth).exp();
            for (sum, adds) in seen.radiance.iter_mut().zip(&piece.radiance) {
                *sum += through * adds;
            }
            seen.depth += piece.depth;
        }
        seen
    }

    /// The picture of so many pixels, of the rays through their middles, on all threads.
    #[must_use]
    pub fn centres(&self, [width, height]: [usize; 2]) -> Image {
        self.picture([width, height], |ray| ray([0.5, 0.5]))
    }

    /// The means over pixels, by Gauss's rule of so many points along each side: exact to that rule's order where the
    /// picture is smooth in a pixel.
    #[must_use]
    pub fn means(&self, size: [usize; 2], points: u32) -> Image {
        let Ok(rule) = collocation(points, Native::<f64>::new()) else {
            return self.centres(size);
        };
        let channels = self.case.transfer.channels.len();
        self.picture(size, |ray| mean(&rule, channels, ray))
    }

    /// The picture of the rays through places moved by so many pixels to the right and down; of pixels' means with
    /// `means`.
    #[must_use]
    pub fn moved(&self, size: [usize; 2], [right, down]: [f64; 2], means: bool) -> Image {
        if !means {
            return self.picture(size, |ray| ray([0.5 + right, 0.5 + down]));
        }
        let channels = self.case.transfer.channels.len();
        let Some(rule) = collocation(MOVED_POINTS, Native::<f64>::new()).ok() else {
            return self.centres(size);
        };
        self.picture(size, |ray| {
            mean(&rule, channels, |[x, y]| ray([x + right, y + down]))
        })
    }

    /// A picture by what pixels make of the rays through their places, from (0, 0) to (1, 1).
    fn picture(
        &self,
        [width, height]: [usize; 2],
        pixel: impl Fn(&dyn Fn([f64; 2]) -> Vec<f64>) -> Vec<f64> + Sync,
    ) -> Image {
        let mut image = Image::new(width, height, self.case.transfer.channels.clone());
        let rows: Vec<usize> = (0..height).collect();
        let channels = image.channels.len();
        let dark = vec![0.0; channels];
        let rows = parallel::map(&rows, |&y| {
            let mut row = Vec::with_capacity(width * channels);
            for x in 0..width {
                let at = |[across, down]: [f64; 2]| {
                    let place = [x as f64 + across, y as f64 + down];
                    let ray = self.case.camera.ray([width, height], place);
                    ray.map_or_else(|| dark.clone(), |ray| self.ray(&ray).radiance)
                };
                row.extend(pixel(&at));
            }
            row
        });
        image.values = rows.into_iter().flatten().collect();
        image
    }

    /// A panel, or its halves where these say something else.
    fn halved(
        &self,
        rule: &Collocation<f64>,
        ray: &Ray,
        (from, to): (f64, f64),
        whole: &Panel,
        halvings: u32,
    ) -> Panel {
        let middle = f64::midpoint(from, to);
        let near = self.panel(rule, ray, from, middle);
        let far = self.panel(rule, ray, middle, to);
        let both = joined(&near, &far);
        let off = whole
            .radiance
            .iter()
            .zip(&both.radiance)
            .map(|(one, other)| (one - other).abs())
            .fold(0.0, f64::max);
        let is_known = off <= TOLERANCE * self.brightest
            && (whole.depth - both.depth).abs() <= TOLERANCE * (1.0 + both.depth);
        if is_known || halvings == 0 || middle <= from || middle >= to {
            return both;
        }
        let in_front = self.halved(rule, ray, (from, middle), &near, halvings - 1);
        let behind = self.halved(rule, ray, (middle, to), &far, halvings - 1);
        joined(&in_front, &behind)
    }

    fn panel(&self, rule: &Collocation<f64>, ray: &Ray, from: f64, to: f64) -> Panel {
        let length = to - from;
        let channels = self.channels();
        let mut emission = vec![0.0; channels];
        let mut extinctions = Vec::with_capacity(rule.nodes.len());
        let mut emissions = Vec::with_capacity(rule.nodes.len() * channels);
        for node in &rule.nodes {
            let s = self.case.field.at(ray.at(from + length * node));
            extinctions.push(self.case.transfer.at(s, &mut emission));
            emissions.extend_from_slice(&emission);
        }
        let mut panel = Panel {
            depth: length * dot(&rule.weights, &extinctions),
            radiance: vec![0.0; channels],
        };
        for (j, row) in rule.integrals.iter().enumerate() {
            let depth = length * dot(row, &extinctions);
            let weight = length * rule.weights[j] * extinctions[j] * (-depth).exp();
            for (channel, sum) in panel.radiance.iter_mut().enumerate() {
                *sum += weight * emissions[j * channels + channel];
            }
        }
        panel
    }

    fn channels(&self) -> usize {
        self.case.transfer.channels.len()
    }
}

/// The mean over a pixel by the rule's points along each side.
fn mean(rule: &Collocation<f64>, channels: usize, ray: impl Fn([f64; 2]) -> Vec<f64>) -> Vec<f64> {
    let mut mean = vec![0.0; channels];
    for (x, across) in rule.nodes.iter().zip(&rule.weights) {
        for (y, down) in rule.nodes.iter().zip(&rule.weights) {
            for (sum, one) in mean.iter_mut().zip(ray([*x, *y])) {
                *sum += across * down * one;
            }
        }
    }
    mean
}

fn joined(near: &Panel, far: &Panel) -> Panel {
    let through = (-near.depth).exp();
    let both = near.radiance.iter().zip(&far.radiance);
    Panel {
        depth: near.depth + far.depth,
        radiance: both.map(|(near, far)| near + through * far).collect(),
    }
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}
