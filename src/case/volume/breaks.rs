//! Where s, τ or C is not analytic along a ray, or turns.

use super::field::{Along, Shape};
use super::{Chord, VolumeCase};
use crate::volume::Ray;

/// What there is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Break {
    /// The field turns: it is analytic there.
    Turn,
    /// The field has a kink.
    FieldKink,
    /// The field jumps.
    FieldJump,
    /// A control point of the transfer functions is crossed.
    ControlPoint,
}

/// More turns are not looked for: a wave of that many periods is no case.
const MOST_TURNS: f64 = 10_000.0;

/// The places of a chord where something is not analytic, or the field turns, from front to back.
#[must_use]
pub fn breaks(case: &VolumeCase, ray: &Ray, chord: Chord) -> Vec<(f64, Break)> {
    let along = case.field.along(ray);
    let mut all = of_field(case, along, chord);
    all.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let mut ends: Vec<f64> = vec![chord.from];
    ends.extend(all.iter().map(|(place, _)| *place));
    ends.push(chord.to);
    let s = |lambda: f64| case.field.of(along.at(lambda));
    let jumps = matches!(case.field.shape, Shape::Jump { .. });
    // The field is monotone between.
    if !jumps {
        for pair in ends.windows(2) {
            let &[from, to] = pair else { continue };
            let (near, far) = (s(from), s(to));
            for point in &case.transfer.points {
                let (below, above) = (near.min(far), near.max(far));
                if point.s > below && point.s < above {
                    all.push((crossing(&s, point.s, from, to), Break::ControlPoint));
                }
            }
        }
    }
    all.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    all
}

/// Kinks, jumps and turns of the field inside a chord.
fn of_field(case: &VolumeCase, along: Along, chord: Chord) -> Vec<(f64, Break)> {
    let inside = |lambda: &f64| *lambda > chord.from && *lambda < chord.to;
    let places: Vec<(f64, Break)> = match (&case.field.shape, along) {
        (Shape::Kink { .. }, Along::Linear { at, slope }) if slope != 0.0 => {
            vec![(-at / slope, Break::FieldKink)]
        }
        (Shape::Wave { .. }, Along::Linear { at, slope }) if slope != 0.0 => {
            let quarter = std::f64::consts::FRAC_PI_2;
            let half = std::f64::consts::PI;
            let turn = |m: f64| (quarter + m * half - at) / slope;
            let order = |lambda: f64| (at + slope * lambda - quarter) / half;
            let (one, other) = (order(chord.from), order(chord.to));
            let (first, last) = (one.min(other).ceil(), one.max(other).floor());
            let mut all = Vec::new();
            let mut m = first;
            while m <= last && m - first < MOST_TURNS {
                all.push((turn(m), Break::Turn));
                m += 1.0;
            }
            all
        }
        (
            Shape::Jump { radius, .. },
            Along::Squared {
                square,
                nearest,
                apart,
            },
        ) => {
            // a (λ − λ₀)² + ρ² = r².
            let under = (radius * radius - apart) / square;
            if under > 0.0 {
                let root = under.sqrt();
                let jump = |sign: f64| (nearest + sign * root, Break::FieldJump);
                vec![jump(-1.0), jump(1.0)]
            } else {
                Vec::new()
            }
        }
        (_, Along::Squared { nearest, .. }) => vec![(nearest, Break::Turn)],
        _ => Vec::new(),
    };
    places
        .into_iter()
        .filter(|(place, _)| inside(place))
        .collect()
}

/// Where a monotone function is `value`, to the last bits.
fn crossing(s: &impl Fn(f64) -> f64, value: f64, from: f64, to: f64) -> f64 {
    let rises = s(to) > s(from);
    let (mut near, mut far) = (from, to);
    for _ in 0..80 {
        let middle = f64::midpoint(near, far);
        if (s(middle) < value) == rises {
            near = middle;
        } else {
            far = middle;
        }
    }
    f64::midpoint(near, far)
}
