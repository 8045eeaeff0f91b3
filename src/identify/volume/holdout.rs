//! A rule against random volumes.

use super::Optics;
use crate::identify::holdout::{HoldOut, Kind, Terms, check_opacity, compare};
use crate::identify::pose::{Made, Steps};
use crate::identify::random::Random;
use crate::identify::rule::Rule;
use crate::identify::session::Session;
use crate::identify::silence::Silence;
use crate::identify::weights::Answers;
use crate::kernel::{Table, Volume};

/// How volumes of a kind are made.
struct Make {
    name: &'static str,
    /// Optical depths of the whole ray.
    depth: [f64; 2],
    cells: [usize; 2],
    entries: [usize; 2],
    segments: [usize; 2],
}

const USUAL: Make = Make {
    name: "",
    depth: [0.1, 2.0],
    cells: [3, 24],
    entries: [3, 24],
    segments: [1, 48],
};

const MAKES: [Make; 8] = [
    Make {
        name: "volumes of many segments",
        segments: [49, 300],
        // A lookup of one value shows a shift where a border lies in it.
        cells: [150, 400],
        ..USUAL
    },
    Make {
        name: "volumes of very many segments",
        segments: [1_190, 1_210],
        cells: [150, 400],
        ..USUAL
    },
    Make {
        name: "thin volumes",
        depth: [1e-3, 0.02],
        ..USUAL
    },
    Make {
        name: "middling volumes",
        depth: [0.02, 3.0],
        ..USUAL
    },
    Make {
        name: "thick volumes",
        depth: [3.0, 20.0],
        ..USUAL
    },
    Make {
        name: "volumes of few cells",
        cells: [1, 3],
        ..USUAL
    },
    Make {
        name: "volumes of few entries",
        entries: [2, 4],
        ..USUAL
    },
    Make {
        name: "volumes of many cells and entries",
        cells: [90, 200],
        entries: [90, 300],
        ..USUAL
    },
];
/// Rays of each kind, with whole and with a shorter last segment.
const RAYS: usize = 2;

/// Asks random volumes of all kinds.
pub(in crate::identify) fn hold_out(
    session: &mut Session<'_>,
    rule: &Rule,
    optics: &Optics,
    terms: &Terms<'_>,
) -> Result<HoldOut, Silence> {
    let mut random = Random::new(131);
    let mut out = HoldOut::default();
    for Make {
        name,
        depth,
        cells,
        entries,
        segments,
    } in MAKES
    {
        for partial in [false, true] {
            if partial && session.divides {
                continue;
            }
            let shorter = if partial { ", shorter last step" } else { "" };
            let mut kind = Kind {
                name: format!("{name}{shorter}"),
                rays: 0,
                agree: 0,
                unanswered: 0,
                digits: 17.0,
            };
            for _ in 0..RAYS {
                let cells = random.integer(cells[0], cells[1]);
                let entries = random.integer(entries[0], entries[1]);
                let depth = random.geometric(depth[0], depth[1]) * terms.typical;
                let steps = steps(session, &mut random, segments, partial);
                let volume = volume(&mut random, [cells, entries], depth / steps.length);
                kind.rays += 1;
                let made = Made::of_volume(session.name(), steps, volume.clone());
                match session.ask_made(&made) {
                    Ok(got) => {
                        let (segments, step) = optics.cut(&volume, &steps);
                        // A place is off by rounding, and a value by so much times all the slopes on the way to it.
                        let slope = 1.0 + (cells * entries) as f64;
                        let answers = Answers {
                            unit: terms.answers.unit * slope,
                            ..terms.answers.clone()
                        };
                        let compared = compare(rule, &answers, &segments, step, &got);
                        kind.agree += usize::from(compared.iter().all(|c| c.agrees));
                        let digits = compared.iter().map(|c| c.digits);
                        kind.digits = digits.fold(kind.digits, f64::min);
                        if let Some(opacity) = session.opacity {
                            let cut = (&segments, step);
                            check_opacity(rule, &answers, cut, opacity, &mut out.opacity);
                        }
                    }
                    Err(Silence::Budget(spent)) => return Err(Silence::Budget(spent)),
                    Err(_) => kind.unanswered += 1,
                }
            }
            out.kinds.push(kind);
        }
    }
    Ok(out)
}

fn steps(
    session: &Session<'_>,
    random: &mut Random,
    [fewest, most]: [usize; 2],
    partial: bool,
) -> Steps {
    let segments = random
        .integer(fewest, most)
        .next_multiple_of(session.multiple);
    let step = random.geometric(0.03, 0.9);
    let last = if partial {
        random.within(0.2, 0.9)
    } else {
        1.0
    };
    Steps {
        length: (segments as f64 - 1.0 + last) * step,
        step,
        segments,
    }
}

/// A field that ends within its table and leaves part of it unused.
fn volume(random: &mut Random, [cells, entries]: [usize; 2], extinction: f64) -> Volume {
    let first = random.within(-1.0, 1.0);
    let last = first + random.within(0.5, 3.0);
    let field = random.many(cells + 1, first, last);
    let uneven = |random: &mut Random| random.uneven() * extinction;
    Volume {
        field,
        table: Table {
            first,
            last,
            extinction: (0..entries).map(|_| uneven(random)).collect(),
            emission: (0..3).map(|_| random.many(entries, 0.0, 1.0)).collect(),
        },
    }
}
