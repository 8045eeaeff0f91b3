//! Segments with weights at both ends and in the middle: read off rays of one segment and of two.

use super::NotIdentified;
use super::least_squares::solve;
use super::number::simplest;
use super::random::Random;
use super::ray::{Emission, Layers};
use super::rule::{End, Node, Scale, Scheme, Segment, Three, Wall};
use super::session::Session;
use super::weights::{Answers, all_nodes, impulse};
use crate::real::Native;
use rug::Rational;

/// One segment.
#[derive(Clone, Copy, Debug)]
struct One {
    /// In front, in the middle, at the back.
    extinction: [f64; 3],
    length: f64,
    weights: [f64; 3],
    passes: f64,
    /// The emission of its far end shines behind it, too.
    walled: bool,
}

/// How segments are asked.
#[derive(Clone, Copy)]
struct Asker<'a> {
    answers: &'a Answers,
    /// Of the last segment: where it is missing, one more is asked.
    last: End,
}

/// Triples of rays; and where there are few, of three weights each for no more than six unknowns.
const TRIPLES: usize = 10;
const FEW_TRIPLES: usize = 4;
/// Lengths of segments.
const LENGTHS: [f64; 3] = [0.25, 1.0, 0.6];

/// What was read off: the scheme, and whether the emission of the far end shines behind the ray.
pub(super) fn segments(
    session: &mut Session<'_>,
    answers: &Answers,
    last: End,
) -> Result<(Scheme, Option<Wall>), NotIdentified> {
    let tolerance = 1e-10 + 512.0 * answers.unit + 8.0 * answers.noise;
    let mut random = Random::new(61);
    let mut all: Vec<One> = Vec::new();
    let asker = Asker { answers, last };
    let triples = if session.is_short() {
        FEW_TRIPLES
    } else {
        TRIPLES
    };
    for k in 0..triples {
        let length = LENGTHS[k % LENGTHS.len()];
        let edges = random.many(3, 0.05, 2.5);
        let middles = random.many(2, 0.05, 2.5);
        all.push(triple(session, asker, tolerance, length, &edges, &middles)?);
    }
    let wall = all
        .iter()
        .all(|one| one.walled)
        .then_some(Wall::LastEmission);
    if wall.is_none() && all.iter().any(|one| one.walled) {
        return Err(NotIdentified::new(
            "the far end's emission shines behind some rays and not behind others",
        ));
    }
    let depth = depth(&all, tolerance)?;
    forms(&all, &depth, tolerance)
        .map(|(weights, scale)| {
            let scheme = Scheme::Segments {
                depth,
                weights,
                scale: Scale(scale),
            };
            (scheme, wall)
        })
        .ok_or_else(|| {
            let rows = all.iter().take(4).map(|one| {
                let [f, m, b] = one.extinction;
                let [wf, wm, wb] = one.weights;
                vec![f, m, b, one.length, wf, wm, wb, one.passes]
            });
            NotIdentified::new("the weights within a segment follow no rule known").with_rows(
                &[
                    "τ in front",
                    "in the middle",
                    "at the back",
                    "length",
                    "weight in front",
                    "in the middle",
                    "at the back",
                    "let through",
                ],
                rows.collect(),
            )
        })
}

/// Weights of all nodes of a ray of one segment or two.
fn weights(
    session: &mut Session<'_>,
    Asker { answers, last }: Asker<'_>,
    length: f64,
    edges: &[f64],
    middles: &[f64],
) -> Result<Vec<f64>, NotIdentified> {
    let nodes: Vec<Node> = all_nodes(middles.len());
    let (mut edges, mut middles) = (edges.to_vec(), middles.to_vec());
    if last == End::Missing {
        edges.push(1.0);
        middles.push(1.0);
    }
    let n = middles.len();
    let layers = Layers {
        step: length,
        last: 1.0,
        edges,
        middles,
    };
    let size = answers.emission_max.min(1.0);
    let size = size.min(answers.output.high.map_or(1.0, |high| high / 8.0));
    let mut emission = vec![Emission::even(n, 0.0)];
    emission.extend(nodes.iter().map(|node| impulse(n, *node, size)));
    let ray = session.ray(&layers, &emission);
    let y = session.ask(&ray)?;
    let x: Vec<f64> = y.iter().map(|y| answers.radiance(*y).value).collect();
    Ok(x[1..].iter().map(|x_k| (x_k - x[0]) / size).collect())
}

/// The first segment of two: its weights from a ray of its own, what it lets through from the second's.
fn triple(
    session: &mut Session<'_>,
    asker: Asker<'_>,
    tolerance: f64,
    length: f64,
    edges: &[f64],
    middles: &[f64],
) -> Result<One, NotIdentified> {
    let mut first = weights(session, asker, length, &edges[..2], &middles[..1])?;
    let second = weights(session, asker, length, &edges[1..], &middles[1..])?;
    let both = weights(session, asker, length, edges, middles)?;
    // Ends come first: of one segment 0, 1 and the middle, of two 0, 1, 2 and the middles.
    let passes = if second[2].abs() > 0.1 * second[1].abs() {
        both[4] / second[2]
    } else {
        both[2] / second[1]
    };
    let scale = both.iter().map(|w| w.abs()).fold(0.0, f64::max).max(1.0);
    // Between segments nothing shines that is seen behind the first alone.
    let behind = first[1] + passes * second[0] - both[1];
    let walled = (behind - passes).abs() <= tolerance * scale && passes > 8.0 * tolerance * scale;
    if walled {
        first[1] -= passes;
    }
    let joint = first[1] + passes * second[0];
    let follows = (joint - both[1]).abs() <= tolerance * scale
        && (first[0] - both[0]).abs() <= tolerance * scale
        && (first[2] - both[3]).abs() <= tolerance * scale;
    if !follows || passes.is_nan() || passes <= 0.0 {
        return Err(
            NotIdentified::new("two segments do not follow one another as two factors").with_rows(
                &["in front", "between", "at the back"],
                vec![
                    vec![first[0], first[1], 0.0],
                    vec![0.0, second[0], second[1]],
                    vec![both[0], both[1], both[2]],
                ],
            ),
        );
    }
    Ok(One {
        extinction: [edges[0], middles[0], edges[1]],
        length,
        weights: [first[0], first[2], first[1]],
        passes,
        walled,
    })
}

/// Parts c with −ln p = d·(c₀ f + c₁ m + c₂ b).
fn depth(all: &[One], tolerance: f64) -> Result<[Rational; 3], NotIdentified> {
    let rows: Vec<([f64; 3], f64)> = all
        .iter()
        .map(|one| (one.extinction, -one.passes.ln() / one.length))
        .collect();
    let failed = || {
        let rows = all.iter().map(|one| {
            let [f, m, b] = one.extinction;
            vec![f, m, b, one.length, -one.passes.ln()]
        });
        NotIdentified::new("−ln of what a segment lets through is not linear in its extinctions")
            .with_rows(
                &[
                    "τ in front",
                    "in the middle",
                    "at the back",
                    "length",
                    "−ln p",
                ],
                rows.collect(),
            )
    };
    let found = linear(&rows).ok_or_else(failed)?;
    let worst = rows.iter().map(|(x, y)| (dot(&found, x) - y).abs());
    if worst.fold(0.0, f64::max) > 8.0 * tolerance {
        return Err(failed());
    }
    Ok(found.map(|c| fraction(c, 4.0 * tolerance.max(1e-9))))
}

fn dot(c: &[f64; 3], x: &[f64; 3]) -> f64 {
    c.iter().zip(x).map(|(c, x)| c * x).sum()
}

/// Three unknowns, by least squares.
fn linear(rows: &[([f64; 3], f64)]) -> Option<[f64; 3]> {
    solve(rows, [true; 3], &|(x, _)| *x, &|(_, y)| *y)
}

/// The fraction with the smallest denominator within a tolerance; the simplest decimal where that is large.
fn fraction(x: f64, tolerance: f64) -> Rational {
    for denominator in 1..=180_u32 {
        let numerator = (x * f64::from(denominator)).round();
        if (numerator / f64::from(denominator) - x).abs() <= tolerance {
            let numerator = Rational::from_f64(numerator).unwrap_or_default();
            return numerator / denominator;
        }
    }
    Rational::from_f64(simplest(x - tolerance, x + tolerance)).unwrap_or_default()
}

/// The form of the weights, and their scale.
fn forms(all: &[One], depth: &[Rational; 3], tolerance: f64) -> Option<(Segment, f64)> {
    let fits = |form: &Segment, scale: f64| {
        let linear = form.linear(Native::<f64>::new());
        all.iter().all(|one| {
            let three = Three {
                extinction: one.extinction,
                length: one.length,
            };
            let want = form.of(&three, &three.depth(depth), linear.as_ref());
            let mut both = want.iter().zip(&one.weights);
            both.all(|(want, got)| (scale * want - got).abs() <= tolerance * scale.abs().max(1.0))
        })
    };
    let parts_of = |shape: &dyn Fn(&One, usize) -> f64| -> [Rational; 3] {
        [0, 1, 2].map(|k| {
            let mut parts: Vec<f64> = all
                .iter()
                .map(|one| one.weights[k] / shape(one, k))
                .collect();
            parts.sort_by(f64::total_cmp);
            fraction(parts[parts.len() / 2], 16.0 * tolerance.max(1e-10))
        })
    };
    let opacity = Segment::Opacity {
        parts: parts_of(&|one, _| 1.0 - one.passes),
    };
    let sum = Segment::Sum {
        parts: parts_of(&|one, k| one.extinction[k] * one.length),
    };
    for form in [opacity, sum] {
        if fits(&form, 1.0) {
            return Some((form, 1.0));
        }
    }
    for form in [
        Segment::LinearInDepth { swapped: false },
        Segment::Linear,
        Segment::Halves,
        Segment::LinearInDepth { swapped: true },
    ] {
        let linear = form.linear(Native::<f64>::new());
        let first = all.first()?;
        let three = Three {
            extinction: first.extinction,
            length: first.length,
        };
        let want = form.of(&three, &three.depth(depth), linear.as_ref());
        let scale = first.weights[0] / want[0];
        let scale = simplest(
            scale * (1.0 - 4.0 * tolerance),
            scale * (1.0 + 4.0 * tolerance),
        );
        if fits(&form, scale) {
            return Some((form, scale));
        }
    }
    let form = quadrature(all, tolerance)?;
    fits(&form, 1.0).then_some((form, 1.0))
}

/// d f cf, d m cm e^(−y), d b cb e^(−x).
fn quadrature(all: &[One], tolerance: f64) -> Option<Segment> {
    let median = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    let near = |one: &One| one.weights[0] / (one.extinction[0] * one.length);
    let far = |one: &One| one.weights[2] / (one.extinction[2] * one.length * one.passes);
    let slack = 16.0 * tolerance.max(1e-10);
    let front = fraction(median(all.iter().map(near).collect()), slack);
    let back = fraction(median(all.iter().map(far).collect()), slack);
    let middle = Rational::from(1) - Rational::from(&front + &back);
    let zero = || [Rational::new(), Rational::new(), Rational::new()];
    if middle.to_f64().abs() < 1e-9 {
        return Some(Segment::Quadrature {
            parts: [front, Rational::new(), back],
            half: zero(),
        });
    }
    // −ln(w/(d m cm)) is the depth to the middle.
    let rows: Vec<([f64; 3], f64)> = all
        .iter()
        .map(|one| {
            let light = one.weights[1] / (one.extinction[1] * one.length * middle.to_f64());
            (one.extinction, -light.ln() / one.length)
        })
        .collect();
    let half = linear(&rows)?;
    if !half.iter().all(|c| c.is_finite()) {
        return None;
    }
    Some(Segment::Quadrature {
        parts: [front, middle, back],
        half: half.map(|c| fraction(c, slack.max(1e-8))),
    })
}
