//! What makes the last sample weigh more than its segment.

use super::Lone;
use crate::identify::NotIdentified;
use crate::identify::number::simplest;
use crate::identify::ray::Layers;
use crate::identify::rule::{End, Place, Wall, Whole};
use crate::identify::session::Session;
use crate::identify::weights::{Measured, nodes_of, weights};

/// Extinctions of the last segment, from one that a wall of any length is opaque at.
const EXTINCTIONS: [f64; 6] = [1.0, 1e-3, 1e-6, 1e-9, 1e-12, 0.0];
/// Those asked where there are few rays.
const FEW: [f64; 4] = [1.0, 1e-6, 1e-12, 0.0];
/// Segments.
const SEGMENTS: usize = 6;

/// What stands at the end of a ray.
#[derive(Clone, Copy, Debug)]
pub(in crate::identify) struct Walled {
    pub(in crate::identify) wall: Wall,
    /// Of its length.
    pub(in crate::identify) bracket: (f64, f64),
    /// The factor of rays that it lets through; `None` where it lets none through, or the factor is no known one.
    pub(in crate::identify) whole: Option<Whole>,
    /// Between these extinctions lies one under which samples hold nothing: where the wall is opaque it shows that.
    pub(in crate::identify) skips: Option<(f64, f64)>,
}

/// The last sample's extinction, what part of the light before it it weighs, and how far that may be off.
type Part = (f64, f64, f64);

/// Rays that end before a wall.
struct Asker<'a> {
    lone: &'a Lone<'a>,
    /// Segments.
    n: usize,
    /// The place of the last sample.
    last: usize,
    /// One sample too many stands before the wall.
    is_extra: bool,
}

/// The length of segments.
const LENGTH: f64 = 0.25;

impl Asker<'_> {
    /// What the last sample weighs; and the factor of the whole ray where it holds nothing.
    fn part(
        &self,
        session: &mut Session<'_>,
        extinction: f64,
    ) -> Result<(Part, Option<Whole>), NotIdentified> {
        let lone = self.lone;
        let tau = lone.reference(LENGTH);
        let mut taus = vec![tau; self.n + usize::from(self.is_extra)];
        taus[self.last] = extinction;
        let w = if self.is_extra {
            with_extra(session, lone, &taus, LENGTH)?
        } else {
            lone.measurer.weights(session, &taus, LENGTH)?
        };
        // The one before the last weighs T α, and T p stands before the last.
        let (weight, passes) = lone.of(tau, LENGTH, self.n as f64 * LENGTH);
        let (own, near) = (w[self.last], w[self.last - 1]);
        let before = near.value / weight * passes * lone.law.scale.0;
        let error = (own.error + near.error / weight) / before;
        let open = if extinction == 0.0 {
            whole_of(lone, &w, &taus, LENGTH)
        } else {
            None
        };
        Ok(((extinction, own.value / before, error), open))
    }

    /// Between which extinctions the last sample ceases to weigh all and weighs nothing; `None` where there is something
    /// between.
    fn border(
        &self,
        session: &mut Session<'_>,
        full: &[Part],
        is_one: impl Fn(&Part) -> bool,
        is_none: impl Fn(&Part) -> bool,
    ) -> Result<Option<(f64, f64)>, NotIdentified> {
        let ones = full.iter().take_while(|part| is_one(part)).count();
        let (all, nothing) = full.split_at(ones);
        let (Some(all), Some(first)) = (all.last(), nothing.first()) else {
            return Ok(None);
        };
        if !nothing.iter().all(&is_none) {
            return Ok(None);
        }
        let (mut low, mut high) = (first.0, all.0);
        for _ in 0..HALVINGS {
            let middle = (low * high).sqrt();
            let (part, _) = self.part(session, middle)?;
            if is_one(&part) {
                high = middle;
            } else if is_none(&part) {
                low = middle;
            } else {
                return Ok(None);
            }
        }
        Ok(Some((low, high)))
    }
}

/// Rays by which a border is found.
const HALVINGS: usize = 24;

/// The factor of the whole ray where its last segment holds nothing: behind a wall the opacity is 1 and shows none.
fn whole_of(lone: &Lone<'_>, w: &[Measured], taus: &[f64], length: f64) -> Option<Whole> {
    let ray = taus.len() as f64 * length;
    let through: f64 = taus
        .iter()
        .map(|tau| lone.of(*tau, length, ray).1)
        .product();
    let steps = 1 - i32::from(lone.measurer.samples.sequence.late);
    let (weight, passes) = lone.of(taus[1], length, ray);
    let factor = w[1].value / (weight * passes.powi(steps));
    let slack = 1e-6 + 64.0 * lone.measurer.answers.unit + 3.0 * w[1].error / w[1].value;
    let kinds = [
        (Whole::One, 1.0),
        (Whole::ByOpacity, 1.0 / (1.0 - through)),
        (Whole::TimesOpacity, 1.0 - through),
    ];
    let found = kinds
        .iter()
        .find(|(_, f)| (factor / f - 1.0).abs() <= slack);
    found.map(|(whole, _)| *whole)
}

/// Those that are asked.
fn extinctions(session: &Session<'_>) -> &'static [f64] {
    if session.is_short() {
        &FEW
    } else {
        &EXTINCTIONS
    }
}

/// Weights of samples at all ends of segments, by their extinctions.
fn with_extra(
    session: &mut Session<'_>,
    lone: &Lone<'_>,
    taus: &[f64],
    length: f64,
) -> Result<Vec<Measured>, NotIdentified> {
    let n = taus.len() - 1;
    let layers = Layers {
        edges: taus.to_vec(),
        ..Layers::of(length, &taus[..n])
    };
    let nodes = nodes_of(Place::Front, n, true);
    Ok(weights(session, lone.measurer.answers, &layers, &nodes, &[])?.of)
}

/// The kind of the wall, and its length's bracket.
pub(in crate::identify) fn wall(
    session: &mut Session<'_>,
    lone: &Lone<'_>,
) -> Result<Walled, NotIdentified> {
    let n = lone.measurer.suitable(session, SEGMENTS);
    let ray = n as f64 * LENGTH;
    let sequence = &lone.measurer.samples.sequence;
    // One sample too many at the front of segments is the one that stands before the wall.
    let is_extra = lone.measurer.samples.place == Place::Front && sequence.extra.is_some();
    if is_extra && sequence.swapped {
        return Err(NotIdentified::new(
            "the last sample of a turned ray with one too many weighs more than its segment",
        ));
    }
    let last = if is_extra {
        n
    } else {
        n - 1 - usize::from(sequence.last == End::Missing)
    };
    let asker = Asker {
        lone,
        n,
        last,
        is_extra,
    };
    let mut parts = Vec::new();
    let mut open = None;
    for &extinction in extinctions(session) {
        let (part, whole) = asker.part(session, extinction)?;
        open = open.or(whole);
        parts.push(part);
    }
    let rows = parts
        .iter()
        .map(|(tau, part, error)| vec![*tau, *part, *error])
        .collect();
    let failed =
        NotIdentified::new("the last sample weighs more than its segment, by no known law")
            .with_rows(&["its extinction", "its weight", "error"], rows);
    let slack = 1e-6 + 64.0 * lone.measurer.answers.unit;
    let is_one = |(_, part, error): &Part| (part - 1.0).abs() <= 3.0 * error + slack;
    let is_none = |(_, part, error): &Part| part.abs() <= 3.0 * error + slack;
    let none = (0.0, 0.0);
    if parts.iter().all(is_one) {
        return Ok(Walled {
            wall: Wall::LastEmission,
            bracket: none,
            whole: None,
            skips: None,
        });
    }
    // The last holds nothing.
    let Some((empty, full)) = parts.split_last() else {
        return Err(failed);
    };
    let opaque = Walled {
        wall: Wall::Opaque,
        bracket: none,
        whole: open,
        skips: None,
    };
    if full.iter().all(is_one) && is_none(empty) {
        return Ok(opaque);
    }
    if is_none(empty)
        && lone.law.range.skip_extinction.is_none()
        && let Some(border) = asker.border(session, full, is_one, is_none)?
    {
        return Ok(Walled {
            skips: Some(border),
            ..opaque
        });
    }
    // A length: the same wherever it can be told.
    let length = is_none(empty).then(|| length(lone, ray, full)).flatten();
    let Some((length, bracket)) = length else {
        return Err(failed);
    };
    Ok(Walled {
        wall: Wall::Length(length),
        bracket,
        whole: open,
        skips: None,
    })
}

/// The length of a wall by what parts of the light its sample weighs, between what it lies; `None` where no length explains
/// all.
fn length(lone: &Lone<'_>, ray: f64, full: &[Part]) -> Option<(f64, (f64, f64))> {
    let of = |tau: f64, length: f64| lone.of(tau, length, ray).0 / lone.law.scale.0;
    let mut told = full
        .iter()
        .filter(|(_, part, _)| *part > 1e-3 && *part < 0.999);
    let (tau, part, error) = told.next()?;
    let reach = |part: f64| {
        let (mut low, mut high) = (1e-6_f64, 1e18_f64);
        for _ in 0..120 {
            let middle = (low * high).sqrt();
            if of(*tau, middle) < part {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    };
    let unit = lone.measurer.answers.unit;
    let width = 3.0 * error + 1e-9 + 64.0 * unit;
    let bracket = (reach(part - width), reach(part + width));
    let length = simplest(bracket.0, bracket.1);
    let slack = 1e-6 + 64.0 * unit;
    let fits = |(tau, part, error): &Part| (of(*tau, length) - part).abs() <= 3.0 * error + slack;
    full.iter().all(fits).then_some((length, bracket))
}
