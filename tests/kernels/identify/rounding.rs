//! How a kernel rounds: the digits of its answers, the order in which it adds, what subtraction loses; and answers that
//! depend on what was asked before.

use rug::Float;
use std::collections::HashMap;
use volver::identify::{
    Accumulation, Batch, Budget, Examined, Name, Precision, Repeat, Verdict, examine,
};
use volver::kernel::{Data, Declaration, Kernel, KernelError, Rendering, Task};
use volver::real::FormatName;

/// Adds contributions in an order of its own.
type Sum = fn(&[f64], fn(f64) -> f64) -> f64;
/// Changes the answers to a ray of that name; the number says how many were asked.
type Remember = fn(&mut HashMap<String, Vec<f64>>, &str, u64, &mut [f64]);

/// Middles of segments, in a format of its own.
#[derive(Debug)]
struct March {
    declaration: Declaration,
    /// Every operation's.
    round: fn(f64) -> f64,
    sum: Sum,
    /// Transmittances are 1 less the opacity so far.
    subtracts: bool,
    /// An answer as it is printed.
    print: fn(f64) -> f64,
    remember: Remember,
    before: HashMap<String, Vec<f64>>,
    asked: u64,
}

impl March {
    fn new(format: FormatName) -> Self {
        March {
            declaration: Declaration {
                format,
                ..Declaration::new("march")
            },
            round: |x| x,
            sum: one_by_one,
            subtracts: false,
            print: |y| y,
            remember: |_, _, _, _| (),
            before: HashMap::new(),
            asked: 0,
        }
    }
}

impl Kernel for March {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let Data::Segments(segments) = task.data else {
            panic!("segments were declared");
        };
        let round = self.round;
        let lambda = segments.edges.lambda.windows(2);
        let (mut through, mut covered) = (1.0, 0.0);
        let mut weights = Vec::new();
        for (ends, tau) in lambda.zip(&segments.middles.extinction) {
            let depth = round(round(*tau) * round(round(ends[1]) - round(ends[0])));
            let opacity = round(-(-depth).exp_m1());
            let seen = if self.subtracts {
                round(1.0 - covered)
            } else {
                through
            };
            weights.push(round(seen * opacity));
            covered = round(covered + round(seen * opacity));
            through = round(through * round(1.0 - opacity));
        }
        let of_channel = |emission: &Vec<f64>| {
            let terms = weights.iter().zip(emission);
            let terms: Vec<f64> = terms.map(|(w, c)| round(w * round(*c))).collect();
            (self.print)((self.sum)(&terms, round))
        };
        let mut all: Vec<f64> = segments.middles.emission.iter().map(of_channel).collect();
        self.asked += 1;
        (self.remember)(&mut self.before, task.subject.name(), self.asked, &mut all);
        Ok(Rendering {
            radiance: all.into_iter().map(|y| Float::with_val(53, y)).collect(),
            ..Rendering::default()
        })
    }
}

fn examined(mut march: March) -> Examined {
    examine(&mut march, Budget::default(), &mut |_| ())
}

fn one_by_one(terms: &[f64], round: fn(f64) -> f64) -> f64 {
    terms.iter().fold(0.0, |sum, x| round(sum + x))
}

fn towards_the_eye(terms: &[f64], round: fn(f64) -> f64) -> f64 {
    terms.iter().rev().fold(0.0, |sum, x| round(sum + x))
}

fn halves(terms: &[f64], round: fn(f64) -> f64) -> f64 {
    match terms {
        [] => 0.0,
        [one] => *one,
        _ => {
            // As many neighbours as can be make whole subtrees.
            let half = terms.len().next_power_of_two() / 2;
            let (near, far) = terms.split_at(half);
            round(halves(near, round) + halves(far, round))
        }
    }
}

fn eight_lanes(terms: &[f64], round: fn(f64) -> f64) -> f64 {
    let whole = terms.len() / 8 * 8;
    let mut lanes = [0.0; 8];
    for (k, x) in terms[..whole].iter().enumerate() {
        lanes[k % 8] = round(lanes[k % 8] + x);
    }
    let rest = &terms[whole..];
    rest.iter()
        .fold(halves(&lanes, round), |sum, x| round(sum + x))
}

fn blocks_of_four(terms: &[f64], round: fn(f64) -> f64) -> f64 {
    let blocks = terms.chunks(4).map(|block| one_by_one(block, round));
    one_by_one(&blocks.collect::<Vec<_>>(), round)
}

/// Kahan's, as Neumaier has it.
fn compensated(terms: &[f64], round: fn(f64) -> f64) -> f64 {
    let (mut sum, mut lost) = (0.0_f64, 0.0);
    for x in terms {
        let next = round(sum + x);
        let part = if sum.abs() >= x.abs() {
            round(round(sum - next) + x)
        } else {
            round(round(x - next) + sum)
        };
        lost = round(lost + part);
        sum = next;
    }
    round(sum + lost)
}

#[test]
fn the_order_in_which_contributions_are_added_is_seen_in_every_format() {
    let orders: [(Sum, Accumulation); 6] = [
        (one_by_one, Accumulation::FrontToBack),
        (towards_the_eye, Accumulation::BackToFront),
        (halves, Accumulation::Tree),
        (eight_lanes, Accumulation::Lanes(8)),
        (blocks_of_four, Accumulation::Blocks(4)),
        (compensated, Accumulation::Wider),
    ];
    for (sum, order) in orders {
        for (format, round) in [
            (FormatName::F64, (|x| x) as fn(f64) -> f64),
            (FormatName::F32, |x| f64::from(x as f32)),
        ] {
            let found = examined(March {
                round,
                sum,
                ..March::new(format)
            });
            assert_eq!(found.verdict(), Verdict::Right, "{order} {format}");
            assert_eq!(found.found.accumulation, Some(order), "{format}");
        }
    }
}

#[test]
fn sums_of_no_known_order_have_no_name() {
    // Thirds: of a third of the terms each, one by one.
    let found = examined(March {
        sum: |terms, round| {
            let thirds = terms.chunks(terms.len().div_ceil(3));
            let thirds: Vec<f64> = thirds.map(|third| one_by_one(third, round)).collect();
            towards_the_eye(&thirds, round)
        },
        ..March::new(FormatName::F64)
    });
    assert_eq!(found.verdict(), Verdict::Right);
    assert_eq!(found.found.accumulation, None);
}

#[test]
fn fewer_digits_than_declared_are_a_deviation_with_their_number() {
    let single = |x: f64| f64::from(x as f32);
    let of = |format, round: fn(f64) -> f64, print: fn(f64) -> f64| {
        examined(March {
            round,
            print,
            ..March::new(format)
        })
    };
    let nothing = |x| x;
    let six = |y: f64| format!("{y:.5e}").parse().expect("a number");
    // Nine digits tell all numbers of binary32 apart.
    let nine = |y: f64| format!("{y:.8e}").parse().expect("a number");
    let all = [
        (
            of(FormatName::F64, single, nothing),
            Some(("format", 24.0)),
            Precision::Bits(24),
        ),
        (
            of(FormatName::F32, single, nothing),
            None,
            Precision::Bits(24),
        ),
        (
            of(FormatName::F64, nothing, nothing),
            None,
            Precision::Bits(53),
        ),
        (
            of(FormatName::F32, nothing, nothing),
            None,
            Precision::Bits(53),
        ),
        (
            of(FormatName::F64, nothing, six),
            Some(("digits", 6.0)),
            Precision::Digits(6),
        ),
        (of(FormatName::F32, single, nine), None, Precision::Bits(24)),
    ];
    for (k, (found, deviation, precision)) in all.into_iter().enumerate() {
        let named = found.deviations.iter().map(|d| (d.name, d.value));
        let expected: Vec<_> = deviation
            .map(|(name, value)| (name, Some(value)))
            .into_iter()
            .collect();
        assert_eq!(named.collect::<Vec<_>>(), expected, "{k}");
        assert_eq!(found.found.hold_out.precision, Some(precision), "{k}");
        assert!(found.found.named().is_some(), "{k}");
    }
}

#[test]
fn transmittances_by_subtraction_are_seen_and_hide_no_rule() {
    for (format, round) in [
        (FormatName::F64, (|x| x) as fn(f64) -> f64),
        (FormatName::F32, |x| f64::from(x as f32)),
    ] {
        for subtracts in [false, true] {
            let found = examined(March {
                round,
                subtracts,
                ..March::new(format)
            });
            assert_eq!(found.verdict(), Verdict::Right, "{format} {subtracts}");
            assert_eq!(found.found.parts.subtracts, subtracts, "{format}");
        }
    }
}

/// What becomes of a ray that is asked among others.
type Among = fn(&mut March, &[Task<'_>], usize) -> Result<Rendering, KernelError>;

/// A kernel that looks at the other rays of a request.
#[derive(Debug)]
struct Batched {
    march: March,
    among: Among,
}

impl Kernel for Batched {
    fn declaration(&self) -> &Declaration {
        self.march.declaration()
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        (self.among)(&mut self.march, std::slice::from_ref(task), 0)
    }

    fn render_all(&mut self, tasks: &[Task<'_>]) -> Vec<Result<Rendering, KernelError>> {
        let all = 0..tasks.len();
        all.map(|k| (self.among)(&mut self.march, tasks, k))
            .collect()
    }
}

/// Ends of segments by the step, as far as the ray goes.
fn stepped(march: &mut March, task: &Task<'_>, step: f64) -> Result<Rendering, KernelError> {
    let mut segments = task.cut().expect("segments were declared").clone();
    let length = segments.edges.lambda[segments.count()];
    for (i, lambda) in segments.edges.lambda.iter_mut().enumerate() {
        *lambda = (i as f64 * step).min(length);
    }
    march.render(&Task {
        data: Data::Segments(&segments),
        ..*task
    })
}

#[test]
fn rays_of_one_request_that_are_not_alone_are_told_apart() {
    let alone: Among = |march, tasks, k| march.render(&tasks[k]);
    let first_step: Among = |march, tasks, k| stepped(march, &tasks[k], tasks[0].step);
    let padded: Among = |march, tasks, k| {
        let mut rendering = march.render(&tasks[k])?;
        let longest = tasks.iter().map(|task| task.segments).max();
        if longest > Some(tasks[k].segments) {
            for radiance in &mut rendering.radiance {
                *radiance += 0.01;
            }
        }
        Ok(rendering)
    };
    let summed: Among = |march, tasks, k| {
        let mut rendering = march.render(&tasks[k])?;
        for radiance in &mut rendering.radiance {
            *radiance *= 1.0 + 0.1 * (tasks.len() - 1) as f64;
        }
        Ok(rendering)
    };
    for (among, batch, name) in [
        (alone, Batch::Same, None),
        (first_step, Batch::FirstStep, Some("batch-step")),
        (padded, Batch::Padding, Some("batch-padding")),
        (summed, Batch::Differs, Some("batch")),
    ] {
        let mut kernel = Batched {
            march: March::new(FormatName::F64),
            among,
        };
        let found = examine(&mut kernel, Budget::default(), &mut |_| ());
        let names: Vec<_> = found.deviations.iter().map(|d| d.name).collect();
        assert_eq!(found.found.state.map(|state| state.batch), Some(batch));
        assert_eq!(names, name.into_iter().collect::<Vec<_>>(), "{batch:?}");
    }
}

#[test]
fn answers_that_depend_on_earlier_ones_are_told_apart() {
    let state = |remember: Remember| {
        let found = examined(March {
            remember,
            ..March::new(FormatName::F64)
        });
        let names: Vec<_> = found.deviations.iter().map(|d| d.name).collect();
        (
            found.found.state.expect("asked"),
            names,
            found.found.rule.is_some() && found.found.hold_out.drifts,
        )
    };
    // A tenth of the answer before under the same name.
    let (mixed, names, _) = state(|before, name, _, all| {
        if let Some(old) = before.get(name).filter(|old| old.len() == all.len()) {
            for (y, old) in all.iter_mut().zip(old) {
                *y = 0.9 * *y + 0.1 * old;
            }
        }
        before.insert(name.into(), all.to_vec());
    });
    assert_eq!((mixed.name, mixed.repeat), (Name::Mixed, Repeat::Same));
    assert_eq!(names, ["answers-by-name"]);
    // The first answer under a name.
    let (first, names, _) = state(|before, name, _, all| {
        let kept = before.entry(name.into()).or_insert_with(|| all.to_vec());
        if kept.len() == all.len() {
            all.copy_from_slice(kept);
        }
    });
    assert_eq!(first.name, Name::First);
    assert_eq!(names, ["answers-by-name"]);
    // All rays from the seventieth on.
    let (same, names, drifts) = state(|_, _, asked, all| {
        if asked > 70 {
            for y in all.iter_mut() {
                *y *= 1.0 + 1e-15;
            }
        }
    });
    assert_eq!((same.name, same.repeat), (Name::Nothing, Repeat::Same));
    assert!(drifts);
    assert_eq!(names, ["earlier-rays"]);
}
