//! Gradients of kernels inside the process: samples at the ends of segments, and faults that need no program.

mod drawn;

use crate::kernel_verify::subjects;
use rug::Float;
use volver::convergence::Verdict;
use volver::kernel::{
    Declaration, Gradient, GradientAt, Kernel, KernelError, Rendering, Sampling, Segments, Task,
};
use volver::study::Silent;
use volver::study::gradient::{
    Conclusion, Derivative, GradientError, Gradients, LevelError, Norm, Standing, Trouble,
    gradients,
};
use volver::study::verify::{Axis, Settings};

/// A gradient of a task for cotangents, and whether it is the first that is asked.
type Of = fn(&Segments, &[f64], bool) -> (Vec<f64>, Vec<Vec<f64>>);

#[derive(Debug)]
struct Inside {
    declaration: Declaration,
    of: Of,
    asked: bool,
}

impl Kernel for Inside {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, _: &Task<'_>) -> Result<Rendering, KernelError> {
        Ok(Rendering::default())
    }

    fn gradient(
        &mut self,
        task: &Task<'_>,
        cotangents: &[f64],
    ) -> Result<(Rendering, Gradient), KernelError> {
        let segments = task.cut().expect("segments");
        let (extinction, emission) = (self.of)(segments, cotangents, !self.asked);
        self.asked = true;
        let floats = |row: Vec<f64>| row.into_iter().map(|x| Float::with_val(53, x)).collect();
        let gradient = Gradient {
            extinction: floats(extinction),
            emission: emission.into_iter().map(floats).collect(),
        };
        Ok((Rendering::default(), gradient))
    }
}

fn asked(declaration: Declaration, of: Of) -> Result<Gradients, GradientError> {
    let mut kernel = Inside {
        declaration,
        of,
        asked: false,
    };
    let settings = Settings::standard(Axis::Step).unwrap();
    let cases = subjects(&["rgb-transfer", "decaying-field"]);
    gradients(&mut kernel, &cases, &settings, &Silent)
}

fn at(at: GradientAt, sampling: Option<Sampling>) -> Declaration {
    Declaration {
        gradient: Some(at),
        sampling,
        ..Declaration::new("inside")
    }
}

/// Of Σ w C τ exp(−t) with the trapezoid's weights w, and t by trapezoids too.
fn trapezoids(segments: &Segments, a: &[f64], _: bool) -> (Vec<f64>, Vec<Vec<f64>>) {
    let lengths: Vec<f64> = segments.lengths().collect();
    let edges = &segments.edges;
    let count = edges.lambda.len();
    let before = |i: usize| if i > 0 { lengths[i - 1] } else { 0.0 };
    let weight = |i: usize| f64::midpoint(before(i), lengths.get(i).copied().unwrap_or(0.0));
    let mut passes = vec![1.0];
    for i in 1..count {
        let depth = lengths[i - 1] * f64::midpoint(edges.extinction[i - 1], edges.extinction[i]);
        passes.push(passes[i - 1] * (-depth).exp());
    }
    let light = |i: usize| -> f64 {
        a.iter()
            .zip(&edges.emission)
            .map(|(a, row)| a * row[i])
            .sum()
    };
    let term = |i: usize| weight(i) * edges.extinction[i] * passes[i] * light(i);
    let mut behind = 0.0;
    let mut by_tau = vec![0.0; count];
    for i in (0..count).rev() {
        // In its own transmittance τ counts with half of the segment in front.
        let own = before(i) / 2.0 * term(i);
        by_tau[i] = weight(i) * (passes[i] * light(i) - behind) - own;
        behind += term(i);
    }
    let by_c = a.iter().map(|a| {
        let of = |i: usize| a * weight(i) * edges.extinction[i] * passes[i];
        (0..count).map(of).collect()
    });
    (by_tau, by_c.collect())
}

/// Of compositing with samples at the fronts of segments.
fn fronts(segments: &Segments, a: &[f64], _: bool) -> (Vec<f64>, Vec<Vec<f64>>) {
    let edges = &segments.edges;
    let mut passes = 1.0;
    let (mut before, mut after, mut alpha) = (Vec::new(), Vec::new(), Vec::new());
    for (length, tau) in segments.lengths().zip(&edges.extinction) {
        before.push(passes);
        alpha.push(-(-tau * length).exp_m1());
        passes *= (-tau * length).exp();
        after.push(passes);
    }
    let lengths: Vec<f64> = segments.lengths().collect();
    let light = |i: usize| -> f64 {
        a.iter()
            .zip(&edges.emission)
            .map(|(a, row)| a * row[i])
            .sum()
    };
    let mut behind = 0.0;
    let mut by_tau = vec![0.0; lengths.len()];
    for i in (0..lengths.len()).rev() {
        by_tau[i] = lengths[i] * (after[i] * light(i) - behind);
        behind += before[i] * alpha[i] * light(i);
    }
    let by_c = a.iter().map(|a| {
        let of = |i: usize| a * before[i] * alpha[i];
        (0..lengths.len()).map(of).collect()
    });
    (by_tau, by_c.collect())
}

#[test]
fn trapezoids_are_compared_where_both_segments_are_as_long() {
    // Undeclared edges are taken for ends, which is said.
    for sampling in [None, Some(Sampling::Ends)] {
        let found = asked(at(GradientAt::Edges, sampling), trapezoids).unwrap();
        assert_eq!(found.places.sampling, Sampling::Ends);
        assert_eq!(found.places.is_declared, sampling.is_some());
        assert_eq!(found.conclusion(), Conclusion::Confirmed);
        // Both ends of the ray, and where the last segment begins, which is shorter; at 8 levels.
        assert_eq!(found.cases[0].left_out.uneven, 24);
        for line in found.lines() {
            assert_eq!(line.standing, Standing::Confirmed, "{line:?}");
            assert!((line.order().unwrap().0 - 2.0).abs() < 0.05, "{line:?}");
        }
    }
    // Taken for fronts the ends have twice the length that they stand for; and the last is not used by these.
    let found = asked(at(GradientAt::Edges, Some(Sampling::Front)), trapezoids).unwrap();
    assert_eq!(found.conclusion(), Conclusion::NotConfirmed);
    let troubles = &found.cases[0].troubles;
    assert_eq!(troubles[..], [Trouble::Unused { segments: 9 }]);
    let largest = found.lines().filter(|line| line.norm == Norm::Largest);
    for line in largest {
        assert_eq!(line.fit.verdict, Verdict::Stalled, "{line:?}");
    }
}

#[test]
fn fronts_may_leave_out_the_last_of_the_ends() {
    let found = asked(at(GradientAt::Edges, Some(Sampling::Front)), fronts).unwrap();
    assert_eq!(found.conclusion(), Conclusion::Confirmed);
    assert_eq!(found.orders, [1.0, 1.0]);
    for line in found.lines() {
        assert!((line.order().unwrap().0 - 1.0).abs() < 0.05, "{line:?}");
    }
}

#[test]
fn a_lower_order_that_is_declared_is_expected() {
    let declaration = Declaration {
        order: Some(1.0),
        ..at(GradientAt::Edges, None)
    };
    let found = asked(declaration, trapezoids).unwrap();
    assert_eq!(found.orders, [1.0, 1.0]);
    let mut lines = found.lines();
    assert!(lines.all(|line| line.fit.verdict == Verdict::TooHigh));
    assert_eq!(found.conclusion(), Conclusion::NotConfirmed);
}

#[test]
fn gradients_that_add_up_from_question_to_question_are_unsteady() {
    let of: Of = |segments, a, is_first| {
        let (mut by_tau, by_c) = trapezoids(segments, a, is_first);
        if !is_first && segments.count() == 9 {
            for x in &mut by_tau {
                *x *= 2.0;
            }
        }
        (by_tau, by_c)
    };
    let found = asked(at(GradientAt::Edges, None), of).unwrap();
    assert_eq!(found.cases[0].troubles, [Trouble::Unsteady]);
    assert_eq!(found.conclusion(), Conclusion::NotConfirmed);
    let first = &found.cases[0].lines;
    assert!(
        first
            .iter()
            .all(|line| line.standing == Standing::Contradicted)
    );
}

#[test]
fn derivatives_that_are_all_0_have_a_name() {
    let of: Of = |segments, a, is_first| {
        let (by_tau, by_c) = trapezoids(segments, a, is_first);
        (
            by_tau,
            by_c.iter().map(|row| vec![0.0; row.len()]).collect(),
        )
    };
    let found = asked(at(GradientAt::Edges, None), of).unwrap();
    for case in &found.cases {
        assert_eq!(case.troubles, [Trouble::Zero(Derivative::Emission)]);
        for line in &case.lines {
            let standing = match line.derivative {
                Derivative::Emission => Standing::Contradicted,
                Derivative::Extinction => Standing::Confirmed,
            };
            assert_eq!(line.standing, standing, "{line:?}");
        }
    }
}

#[test]
fn gradients_of_another_shape_fail() {
    let of: Of = |segments, a, is_first| {
        let (mut by_tau, by_c) = trapezoids(segments, a, is_first);
        by_tau.push(0.0);
        (by_tau, by_c)
    };
    let found = asked(at(GradientAt::Edges, None), of).unwrap();
    assert_eq!(found.conclusion(), Conclusion::CouldNotRun);
    let error = &found.cases[0].failures[0].error;
    let want = KernelError::Gradient {
        what: "extinction",
        got: 11,
        wanted: 10,
    };
    assert_eq!(*error, LevelError::Kernel(want));
}

#[test]
fn samples_elsewhere_than_the_numbers_are_refused() {
    for (of, sampling) in [
        (GradientAt::Middles, Sampling::Front),
        (GradientAt::Edges, Sampling::Middle),
        // Of a kernel that draws no random numbers.
        (GradientAt::Edges, Sampling::Jittered),
    ] {
        let error = asked(at(of, Some(sampling)), trapezoids).unwrap_err();
        assert!(matches!(error, GradientError::Places(_)), "{error}");
    }
    let error = asked(Declaration::new("none"), trapezoids).unwrap_err();
    assert_eq!(error, GradientError::Kernel(KernelError::NoGradient));
}
