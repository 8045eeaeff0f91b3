//! What a picture is that is not the right one: the right one moved, mirrored, exchanged or scaled.
//!
//! Found on the even pixels of a chessboard and held out against the odd ones, of the finest picture and of the next
//! coarser one: what a finer step takes away is no likeness.

use super::classes::Class;
use super::measured::Pictures;
use super::norms::norms;
use super::plan::PixelIs;
use crate::case::volume::VolumeCase;
use crate::image::Image;
use crate::reference::ExactPicture;
use serde::Serialize;

/// What was found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Likeness {
    /// Of the kind; it stays.
    pub name: &'static str,
    /// What the picture is, in words.
    pub words: String,
    /// A factor, or how far, where there is one.
    pub value: Option<f64>,
    /// What is left of the error on pixels that it was not found with, as a part of it.
    pub left: f64,
}

/// A picture that the one that was made may be.
struct Candidate {
    name: &'static str,
    words: String,
    value: Option<f64>,
    image: Image,
}

/// The part of the error that may be left.
const LEFT: f64 = 0.1;
/// The same of the coarser picture, whose own error is larger.
const LEFT_COARSER: f64 = 0.3;
/// Another likeness explains a picture as well where it leaves no more than so many times as much.
const AS_WELL: f64 = 2.0;
/// Half of the pixels, found with; the other half, held out.
const EVEN: usize = 0;
const ODD: usize = 1;
/// An error of no more than so many times what step and grid leave is theirs.
const EXPLAINED: f64 = 1.5;
/// Rounds of a search for a factor.
const ROUNDS: usize = 24;
/// Factors beyond are not looked for.
const FACTORS: (f64, f64) = (1.0 / 32.0, 32.0);
/// A factor agrees with that of the coarser picture within this part of what it is off 1.
const AGREE: f64 = 0.1;

/// What the finest picture is, where that leaves at most a tenth of its error; several where they cannot be told apart.
#[must_use]
pub fn likeness(
    case: &VolumeCase,
    pictures: &Pictures,
    pixel: PixelIs,
    cells: usize,
) -> Vec<Likeness> {
    let (got, exact) = (&pictures.finest, &pictures.exact);
    let error = off(got, exact, EVEN).max(off(got, exact, ODD));
    if error <= f64::EPSILON * size(exact) || error.is_nan() {
        return Vec::new();
    }
    // What is left of step and grid is no other picture.
    let smooth = |k: usize| pictures.classes.get(k) == Some(&Class::Smooth);
    let rest = norms(got, exact, smooth).l2;
    if pictures.left > 0.0 && rest <= EXPLAINED * pictures.left && !has_rim(pictures) {
        return Vec::new();
    }
    let maker = Maker {
        case,
        size: [exact.width, exact.height],
        pixel,
    };
    let left = |image: &Image, of: &Image, half: usize| off(of, image, half) / off(of, exact, half);
    let mut found: Vec<Likeness> = Vec::new();
    // One picture at a time: large ones are many megabytes.
    let mut consider = |one: Candidate| {
        let of_odd = left(&one.image, got, ODD);
        let explains = left(&one.image, got, EVEN) <= LEFT
            && of_odd <= LEFT
            && left(&one.image, &pictures.coarser, ODD) <= LEFT_COARSER;
        if explains {
            found.push(Likeness {
                left: of_odd,
                name: one.name,
                words: one.words,
                value: one.value,
            });
        }
    };
    symmetries(exact).into_iter().for_each(&mut consider);
    exchanged(exact).into_iter().for_each(&mut consider);
    maker.moved_in_space(cells, &mut consider);
    maker.moved_in_picture(&mut consider);
    maker.scaled(got, exact, &pictures.coarser, &mut consider);
    found.sort_by(|a, b| a.left.total_cmp(&b.left));
    let best = found.first().map_or(0.0, |one| one.left);
    found.retain(|one| one.left <= AS_WELL * best + 1e-12);
    found
}

/// Whether something shines where there is nothing, or nothing where there is something: no step does that.
fn has_rim(pictures: &Pictures) -> bool {
    let outside = |k: usize| pictures.classes.get(k) == Some(&Class::Outside);
    norms(&pictures.finest, &pictures.exact, outside).max > 0.0
}

/// The norm of a difference over half of the pixels.
fn off(one: &Image, other: &Image, half: usize) -> f64 {
    let channels = one.channels.len().max(1);
    let width = one.width.max(1);
    let mut sum = 0.0;
    for (k, (a, b)) in one.values.iter().zip(&other.values).enumerate() {
        let pixel = k / channels;
        let is_in = (pixel % width + pixel / width) % 2 == half;
        if is_in && (a - b).is_finite() {
            sum += (a - b) * (a - b);
        }
    }
    sum.sqrt()
}

fn size(image: &Image) -> f64 {
    let squares = image.values.iter().filter(|v| v.is_finite());
    squares.map(|v| v * v).sum::<f64>().sqrt()
}

/// The pixel at (x, y) of the picture is that of `from`.
fn mapped(image: &Image, from: impl Fn(usize, usize) -> (usize, usize)) -> Image {
    let mut values = Vec::with_capacity(image.values.len());
    for y in 0..image.height {
        for x in 0..image.width {
            let (x, y) = from(x, y);
            values.extend_from_slice(image.pixel(x, y));
        }
    }
    Image {
        values,
        ..image.clone()
    }
}

fn symmetries(exact: &Image) -> Vec<Candidate> {
    let (right, low) = (exact.width - 1, exact.height - 1);
    let candidate = |words: &str, image| Candidate {
        name: "symmetry",
        words: format!("the right picture, {words}"),
        value: None,
        image,
    };
    let mut all = vec![
        candidate(
            "mirrored left to right",
            mapped(exact, |x, y| (right - x, y)),
        ),
        candidate("upside down", mapped(exact, |x, y| (x, low - y))),
        candidate("turned by 180°", mapped(exact, |x, y| (right - x, low - y))),
    ];
    if exact.width == exact.height {
        all.push(candidate(
            "with rows for columns",
            mapped(exact, |x, y| (y, x)),
        ));
        all.push(candidate(
            "turned by 90° to the right",
            mapped(exact, |x, y| (y, right - x)),
        ));
        all.push(candidate(
            "turned by 90° to the left",
            mapped(exact, |x, y| (right - y, x)),
        ));
        all.push(candidate(
            "mirrored at the rising diagonal",
            mapped(exact, |x, y| (right - y, right - x)),
        ));
    }
    all
}

/// Channels in every other order; of more than four, every exchange of two.
fn exchanged(exact: &Image) -> Vec<Candidate> {
    let count = exact.channels.len();
    let mut orders: Vec<Vec<usize>> = Vec::new();
    let own: Vec<usize> = (0..count).collect();
    if count <= 4 {
        permutations(&mut own.clone(), 0, &mut orders);
        orders.retain(|order| *order != own);
    } else {
        for a in 0..count {
            for b in a + 1..count {
                let mut order = own.clone();
                order.swap(a, b);
                orders.push(order);
            }
        }
    }
    let with = |order: Vec<usize>| {
        let pixels = exact.values.chunks_exact(count.max(1));
        let values = pixels
            .flat_map(|pixel| order.iter().map(|&k| pixel[k]))
            .collect();
        let names: Vec<&str> = order.iter().map(|&k| exact.channels[k].as_str()).collect();
        Candidate {
            name: "channels",
            words: format!(
                "the right picture with channels in the order {} in place of {}",
                names.join(", "),
                exact.channels.join(", ")
            ),
            value: None,
            image: Image {
                values,
                ..exact.clone()
            },
        }
    };
    orders.into_iter().map(with).collect()
}

fn permutations(order: &mut Vec<usize>, from: usize, all: &mut Vec<Vec<usize>>) {
    if from == order.len() {
        all.push(order.clone());
        return;
    }
    for k in from..order.len() {
        order.swap(from, k);
        permutations(order, from + 1, all);
        order.swap(from, k);
    }
}

/// Makes exact pictures of volumes that are not the right one.
struct Maker<'c> {
    case: &'c VolumeCase,
    size: [usize; 2],
    pixel: PixelIs,
}

impl Maker<'_> {
    fn picture(&self, case: &VolumeCase) -> Image {
        self.pixel.exact(&ExactPicture::new(case), self.size)
    }

    /// The volume moved by half a voxel along one axis, or along all.
    fn moved_in_space(&self, cells: usize, consider: &mut impl FnMut(Candidate)) {
        let [low, high] = self.case.corners;
        let half = [0, 1, 2].map(|axis| (high[axis] - low[axis]) / cells.max(1) as f64 / 2.0);
        let ways = [
            ([1.0, 0.0, 0.0], "x"),
            ([0.0, 1.0, 0.0], "y"),
            ([0.0, 0.0, 1.0], "z"),
            ([1.0, 1.0, 1.0], "x, y and z"),
        ];
        for (way, axes) in ways {
            for sign in [1.0, -1.0] {
                let by = [0, 1, 2].map(|axis| sign * way[axis] * half[axis]);
                let side = if sign > 0.0 { "+" } else { "−" };
                let within = VolumeCase {
                    field: self.case.field.moved(by),
                    ..self.case.clone()
                };
                consider(Candidate {
                    name: "half-voxel",
                    words: format!(
                        "the field moved by half a voxel to {side}{axes}, in the same box"
                    ),
                    value: Some(sign * 0.5),
                    image: self.picture(&within),
                });
                // The camera moves the other way, and what it sees is the same as if all else moved.
                let mut case = self.case.clone();
                for (axis, by) in by.into_iter().enumerate() {
                    case.camera.position[axis] -= by;
                    case.camera.target[axis] -= by;
                }
                consider(Candidate {
                    name: "half-voxel",
                    words: format!("the volume moved by half a voxel to {side}{axes}"),
                    value: Some(sign * 0.5),
                    image: self.picture(&case),
                });
            }
        }
    }

    /// The picture moved by half a pixel, or one.
    fn moved_in_picture(&self, consider: &mut impl FnMut(Candidate)) {
        let steps = [-1.0, -0.5, 0.0, 0.5, 1.0];
        let exact = ExactPicture::new(self.case);
        for right in steps {
            for down in steps {
                if right == 0.0 && down == 0.0 {
                    continue;
                }
                let image = exact.moved(self.size, [right, down], self.pixel == PixelIs::Mean);
                consider(Candidate {
                    name: "pixel-shift",
                    words: format!(
                        "the picture moved by {} pixels to the right and {} down",
                        -right, -down
                    ),
                    value: None,
                    image,
                });
            }
        }
    }

    /// The picture with lengths, or values, multiplied by a factor that is found on half of the pixels.
    fn scaled(
        &self,
        got: &Image,
        exact: &Image,
        coarser: &Image,
        consider: &mut impl FnMut(Candidate),
    ) {
        let value = |of: &Image| {
            let (mut up, mut down) = (0.0, 0.0);
            let channels = of.channels.len().max(1);
            for (k, (a, b)) in of.values.iter().zip(&exact.values).enumerate() {
                let pixel = k / channels;
                if (pixel % of.width + pixel / of.width) % 2 == EVEN && a.is_finite() {
                    up += a * b;
                    down += b * b;
                }
            }
            up / down
        };
        let (factor, other) = (value(got), value(coarser));
        if agree(factor, other) {
            consider(Candidate {
                name: "value-factor",
                words: format!("the right picture times {factor:.5}"),
                value: Some(factor),
                image: Image {
                    values: exact.values.iter().map(|v| factor * v).collect(),
                    ..exact.clone()
                },
            });
        }
        let (factor, image) = self.length_factor(got);
        if agree(factor, self.length_factor(coarser).0) {
            consider(Candidate {
                name: "length-factor",
                words: format!("lengths along rays times {factor:.5}"),
                value: Some(factor),
                image,
            });
        }
    }

    /// The factor of lengths with the least error on half of the pixels, by golden sections of its logarithm.
    fn length_factor(&self, got: &Image) -> (f64, Image) {
        let with = |factor: f64| {
            let mut case = self.case.clone();
            for point in &mut case.transfer.points {
                point.extinction *= factor;
            }
            self.picture(&case)
        };
        let cost = |factor: f64| off(got, &with(factor), EVEN);
        // The best of a coarse row first: there may be several valleys.
        let (low, high) = (FACTORS.0.ln(), FACTORS.1.ln());
        let count = 20;
        let at = |k: usize| low + (high - low) * k as f64 / count as f64;
        let best = (0..=count).min_by(|a, b| cost(at(*a).exp()).total_cmp(&cost(at(*b).exp())));
        let best = best.unwrap_or(0);
        let (mut a, mut b) = (at(best.saturating_sub(1)), at((best + 1).min(count)));
        let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
        let (mut c, mut d) = (b - golden * (b - a), a + golden * (b - a));
        let (mut at_c, mut at_d) = (cost(c.exp()), cost(d.exp()));
        for _ in 0..ROUNDS {
            if at_c < at_d {
                (b, d, at_d) = (d, c, at_c);
                c = b - golden * (b - a);
                at_c = cost(c.exp());
            } else {
                (a, c, at_c) = (c, d, at_d);
                d = a + golden * (b - a);
                at_d = cost(d.exp());
            }
        }
        let factor = f64::midpoint(a, b).exp();
        (factor, with(factor))
    }
}

fn agree(one: f64, other: f64) -> bool {
    one.is_finite() && other.is_finite() && (one - other).abs() <= AGREE * (one - 1.0).abs()
}
