//! Gradients by another ray's numbers.

use super::{Fault, March};
use volver::identify::{Budget, GradientFound, GradientsTogether, gradients};
use volver::kernel::{Declaration, Gradient, Gradients, Kernel, KernelError, Rendering, Task};

/// How gradients are mixed up.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Mixed {
    No,
    /// Asked singly.
    Before,
    FirstOfAll,
    Accumulated,
    CotangentsBefore,
    /// In one request.
    First,
    FirstNumbers,
    ByOne,
    Reversed,
    InPairs,
    Summed,
    Averaged,
    Divided,
    LastCotangents,
    /// In no known way: one ray of two is added to the other.
    Blended,
    /// No answer to several.
    Refused,
    /// Right in the first request of several, and not in the second.
    Later,
}
use Mixed::*;

#[derive(Debug)]
struct Rays {
    march: March,
    mixed: Mixed,
    /// What was answered before, of rays with as many segments.
    before: Vec<Gradient>,
    cotangents: Vec<f64>,
    requests: usize,
}

/// a·x + y, value by value.
fn plus(a: f64, x: &Gradient, y: &Gradient) -> Gradient {
    let row = |x: &Vec<rug::Float>, y: &Vec<rug::Float>| {
        let both = x.iter().zip(y);
        both.map(|(x, y)| rug::Float::with_val(53, a * x.to_f64() + y.to_f64()))
            .collect()
    };
    Gradient {
        extinction: row(&x.extinction, &y.extinction),
        emission: x
            .emission
            .iter()
            .zip(&y.emission)
            .map(|(x, y)| row(x, y))
            .collect(),
    }
}

fn times(a: f64, x: &Gradient) -> Gradient {
    plus(a, x, &plus(-1.0, x, x))
}

impl Rays {
    fn found(mixed: Mixed, fault: Fault) -> GradientFound {
        let mut rays = Rays {
            march: March::new(fault),
            mixed,
            before: Vec::new(),
            cotangents: Vec::new(),
            requests: 0,
        };
        gradients(&mut rays, Budget::default(), &mut |_| ()).expect("it answers")
    }
}

impl Kernel for Rays {
    fn declaration(&self) -> &Declaration {
        self.march.declaration()
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        self.march.render(task)
    }

    fn gradient(
        &mut self,
        task: &Task<'_>,
        cotangents: &[f64],
    ) -> Result<(Rendering, Gradient), KernelError> {
        let others = std::mem::replace(&mut self.cotangents, cotangents.to_vec());
        let used = match self.mixed {
            CotangentsBefore if !others.is_empty() => &others,
            _ => cotangents,
        };
        let (rendering, own) = self.march.gradient(task, used)?;
        let is_alike = |other: &&Gradient| other.extinction.len() == own.extinction.len();
        let alike: Vec<&Gradient> = self.before.iter().filter(is_alike).collect();
        let answer = match (self.mixed, &alike[..]) {
            (Before, [.., last]) => (*last).clone(),
            (FirstOfAll, [first, ..]) => (*first).clone(),
            (Accumulated, all) => all
                .iter()
                .fold(own.clone(), |sum, one| plus(1.0, one, &sum)),
            _ => own.clone(),
        };
        self.before.push(own);
        Ok((rendering, answer))
    }

    fn gradients_together(
        &mut self,
        asked: &[(Task<'_>, &[f64])],
    ) -> Result<Gradients, KernelError> {
        self.requests += 1;
        let count = asked.len();
        let one = |at: usize, cotangents: &[f64], march: &mut March| {
            march.gradient(&asked[at].0, cotangents)
        };
        let own: Vec<(Rendering, Gradient)> = asked
            .iter()
            .map(|(task, cotangents)| self.march.gradient(task, cotangents))
            .collect::<Result<_, _>>()?;
        let sum = |last: usize| {
            let first = own[0].1.clone();
            own[1..=last]
                .iter()
                .fold(first, |sum, one| plus(1.0, &one.1, &sum))
        };
        let mut all = Vec::new();
        for at in 0..count {
            let of = |other: usize| own[other].1.clone();
            let gradient = match self.mixed {
                First => of(0),
                FirstNumbers => one(0, asked[at].1, &mut self.march)?.1,
                ByOne => of((at + count - 1) % count),
                Reversed => of(count - 1 - at),
                InPairs if at ^ 1 < count => of(at ^ 1),
                Summed => sum(count - 1),
                Averaged => times(1.0 / count as f64, &sum(count - 1)),
                Divided => times(1.0 / count as f64, &of(at)),
                LastCotangents => one(at, asked[count - 1].1, &mut self.march)?.1,
                Blended if at == 1 => plus(0.5, &of(0), &of(1)),
                Later if self.requests > 1 => of(0),
                Refused => {
                    return Err(KernelError::Refused {
                        reason: "one ray at a time".into(),
                    });
                }
                _ => of(at),
            };
            all.push(Ok((own[at].0.clone(), gradient)));
        }
        Ok(all)
    }
}

fn names(found: &GradientFound) -> Vec<&'static str> {
    found.deviations.iter().map(|one| one.name).collect()
}

#[test]
fn rays_that_are_alone_are_alone_in_a_request_too() {
    let found = Rays::found(No, Fault::Nothing);
    assert!(found.is_right(), "{found:?}");
    let all = GradientsTogether { rays: 7, differ: 0 };
    assert_eq!(found.shared, Some(all));
}

#[test]
fn a_gradient_of_another_ray_has_a_name() {
    let all = [
        (
            Before,
            "gradient-of-another-ray",
            "that of the ray asked before",
        ),
        (
            FirstOfAll,
            "gradient-of-another-ray",
            "that of the ray asked first",
        ),
        (
            Accumulated,
            "gradient-accumulated",
            "all rays asked before added",
        ),
        (
            CotangentsBefore,
            "gradient-cotangents-of-another-ray",
            "of the ray asked before",
        ),
        (
            First,
            "gradient-of-another-ray",
            "the gradient of its first",
        ),
        (
            FirstNumbers,
            "gradient-of-another-ray",
            "by the numbers of its first",
        ),
        (
            ByOne,
            "gradient-of-another-ray",
            "of the ray before in its request",
        ),
        (Reversed, "gradient-swapped", "in the reverse order"),
        (InPairs, "gradient-swapped", "each have the other's"),
        (Summed, "gradient-summed", "the sum of those of all rays"),
        (
            Averaged,
            "gradient-averaged",
            "the mean of those of all rays",
        ),
        (
            Divided,
            "gradient-divided-by-rays",
            "divided by the number of rays",
        ),
        (
            LastCotangents,
            "gradient-cotangents-of-another-ray",
            "the cotangents of its last",
        ),
    ];
    for (mixed, name, words) in all {
        let found = Rays::found(mixed, Fault::Nothing);
        assert_eq!(names(&found), [name], "{mixed:?}: {found:?}");
        let deviation = &found.deviations[0];
        assert!(deviation.does.contains(words), "{mixed:?}: {deviation:?}");
        assert_eq!(deviation.validated.len(), 1, "{mixed:?}");
        assert!(!found.is_right(), "{mixed:?}");
    }
}

#[test]
fn what_depends_on_others_in_no_known_way_is_not_guessed() {
    for mixed in [Blended, Refused, Later] {
        let found = Rays::found(mixed, Fault::Nothing);
        assert_eq!(names(&found), ["gradient-batch"], "{mixed:?}: {found:?}");
        assert!(found.deviations[0].validated.is_empty());
        assert!(!found.is_right(), "{mixed:?}");
    }
    let differ = Rays::found(Blended, Fault::Nothing).shared;
    // The second of both requests.
    assert_eq!(differ, Some(GradientsTogether { rays: 7, differ: 2 }));
}

#[test]
fn a_wrong_term_and_a_mixed_request_are_two_faults() {
    let found = Rays::found(Summed, Fault::Factor(1.03));
    assert_eq!(names(&found), ["gradient-factor", "gradient-summed"]);
    let found = Rays::found(No, Fault::Factor(1.03));
    assert_eq!(names(&found), ["gradient-factor"]);
    assert_eq!(found.shared.map(|shared| shared.differ), Some(0));
}
