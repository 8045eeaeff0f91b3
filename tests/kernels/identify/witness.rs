//! Kernels with known faults: the ray that shows one is small, and what it shows is real.

use rug::Float;
use std::num::NonZeroU64;
use volver::identify::{Budget, Examined, Ray, Verdict, examine};
use volver::kernel::{Closure, Declaration, Kernel, KernelError, Rendering, Segments, Task};
use volver::symbolic::code::Language;

/// A fault of a march with one sample in the middle of each segment.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    None,
    LinearOpacity,
    Skip(f64),
    Clamp(f64),
    EarlyEnd(f64),
    FirstMissing,
    LastTwice,
    Late,
    BackToFront,
    Background(f64),
    Offset(f64),
    Gamma(f64),
    ClipsEmission(f64),
    /// No part of any rule: every third segment is dark.
    EveryThirdDark,
    /// No part of any rule: a neighbour's extinction.
    Smoothed,
}

/// Front to back, by hand: nothing of the library.
fn march(segments: &Segments, channel: usize, fault: Fault) -> f64 {
    let tau = &segments.middles.extinction;
    let emission = &segments.middles.emission[channel];
    let edges = &segments.edges.lambda;
    let n = tau.len();
    let (mut sum, mut through, mut before) = (0.0, 1.0, 1.0);
    for step in 0..n {
        let i = if fault == Fault::BackToFront {
            n - 1 - step
        } else {
            step
        };
        if fault == Fault::FirstMissing && i == 0 {
            continue;
        }
        let d = edges[i + 1] - edges[i];
        let own = match fault {
            Fault::Smoothed if i > 0 => 0.5 * (tau[i] + tau[i - 1]),
            _ => tau[i],
        };
        let mut opacity = -(-own * d).exp_m1();
        let mut c = emission[i];
        match fault {
            Fault::LinearOpacity => opacity = own * d,
            Fault::Skip(least) if opacity < least => continue,
            Fault::Clamp(most) => opacity = opacity.min(most),
            Fault::ClipsEmission(most) => c = c.min(most),
            Fault::EveryThirdDark if i % 3 == 2 => c = 0.0,
            _ => {}
        }
        let times = if fault == Fault::LastTwice && i == n - 1 {
            2
        } else {
            1
        };
        for _ in 0..times {
            let seen = if fault == Fault::Late {
                before
            } else {
                through
            };
            sum += seen * opacity * c;
            before = through;
            through *= 1.0 - opacity;
        }
        if matches!(fault, Fault::EarlyEnd(under) if through < under) {
            break;
        }
    }
    match fault {
        Fault::Background(c) => sum + through * c,
        Fault::Offset(c) => sum + c,
        Fault::Gamma(power) => sum.max(0.0).powf(power),
        _ => sum,
    }
}

fn examined(fault: Fault) -> Examined {
    let mut kernel = Closure::segments("by hand", move |segments, channel| {
        march(segments, channel, fault)
    });
    examine(&mut kernel, Budget::default(), &mut |_| ())
}

const FAULTS: [Fault; 14] = [
    Fault::LinearOpacity,
    Fault::Skip(1e-3),
    Fault::Clamp(0.99),
    Fault::EarlyEnd(0.01),
    Fault::FirstMissing,
    Fault::LastTwice,
    Fault::Late,
    Fault::BackToFront,
    Fault::Background(0.25),
    Fault::Offset(1e-5),
    Fault::Gamma(1.0 / 2.2),
    Fault::ClipsEmission(3.0),
    Fault::EveryThirdDark,
    Fault::Smoothed,
];

#[test]
fn every_fault_has_a_small_witness_whose_difference_is_real() {
    for fault in FAULTS {
        let examined = examined(fault);
        let witness = examined.witness.as_ref();
        let witness = witness.unwrap_or_else(|| panic!("no witness of {fault:?}"));
        assert!(witness.segments() <= 4, "{fault:?}: {witness}");
        // Both sides again, by other code.
        let segments = &witness.ray.segments;
        let right = march(segments, witness.channel, Fault::None);
        let got = march(segments, witness.channel, fault);
        assert!(
            (witness.want - right).abs() <= witness.tolerance,
            "{fault:?}: {witness}"
        );
        assert_eq!(witness.got.to_bits(), got.to_bits(), "{fault:?}: {witness}");
        assert!(
            (got - right).abs() > 8.0 * witness.tolerance,
            "{fault:?}: {witness}"
        );
    }
}

#[test]
fn witnesses_are_as_small_and_round_as_they_can_be() {
    // A fault of one segment's light needs one, of what one does to another two; a third one three.
    for (fault, words) in [
        (
            Fault::LinearOpacity,
            "n = 1, d = 1, τ = 1, C = 1: 1.000 where the rule gives 0.6321",
        ),
        (
            Fault::Late,
            "n = 2, d = 1, τ = 1 1, C = 0 1: 0.6321 where the rule gives 0.2325",
        ),
        (
            Fault::Background(0.25),
            "n = 1, d = 1, τ = 0, C = 0: 0.2500 where the rule gives 0.000",
        ),
    ] {
        let witness = examined(fault).witness.unwrap();
        assert_eq!(witness.to_string(), words);
    }
    let third = examined(Fault::EveryThirdDark).witness.unwrap();
    assert_eq!(third.segments(), 3, "{third}");
}

#[test]
fn a_right_kernel_has_none_and_the_same_kernel_has_the_same() {
    let right = examined(Fault::None);
    assert_eq!(right.verdict(), Verdict::Right);
    assert!(right.witness.is_none());
    let twice = [0, 1].map(|_| examined(Fault::Smoothed).witness.unwrap().to_string());
    assert_eq!(twice[0], twice[1]);
}

#[test]
fn a_witness_is_read_back_as_it_was_written() {
    let witness = examined(Fault::EarlyEnd(0.01)).witness.unwrap();
    let text = witness.ray.to_json().unwrap();
    let back = Ray::from_json(&text).unwrap();
    assert_eq!(back.segments, witness.ray.segments);
    assert_eq!(back.to_json().unwrap(), text);
    for broken in [
        "",
        "{}",
        "[1]",
        &text.replacen("\"segments\":2", "\"segments\":3", 1),
    ] {
        assert!(Ray::from_json(broken).is_err(), "{broken}");
    }
}

/// The test is run on a function that is right and on one that is not: it has to tell them apart.
#[test]
fn a_unit_test_in_python_fails_where_the_kernel_does() {
    let witness = examined(Fault::Late).witness.unwrap();
    let test = witness.unit_test(Language::Python, "march").unwrap();
    let march = |late: &str| {
        format!(
            "import math\ndef march(task):\n    t, p, y = 1.0, 1.0, 0.0\n    m = task['data']['middles']\n    \
             e = task['data']['edges']['lambda']\n    for i in range(task['segments']):\n        \
             a = 1 - math.exp(-m['extinction'][i] * (e[i + 1] - e[i]))\n        \
             y += {late} * a * m['emission'][0][i]\n        p = t\n        t *= 1 - a\n    return [y]\n"
        )
    };
    for (seen, passes) in [("t", true), ("p", false)] {
        let script = format!("{}\n{test}\ntest_witness()\n", march(seen));
        let run = std::process::Command::new("python3")
            .args(["-c", &script])
            .output();
        let Ok(run) = run else {
            eprintln!("skipped: no python3");
            return;
        };
        let err = String::from_utf8_lossy(&run.stderr);
        assert_eq!(run.status.success(), passes, "{script}\n{err}");
        assert!(passes || err.contains("AssertionError"), "{err}");
    }
}

#[test]
fn a_unit_test_in_c_fails_where_the_kernel_does() {
    let witness = examined(Fault::Late).witness.unwrap();
    let test = witness.unit_test(Language::C, "march").unwrap();
    let folder = tempfile::tempdir().unwrap();
    for (seen, passes) in [("t", true), ("p", false)] {
        let source = format!(
            "{test}\ndouble march(const double *l, const double *te, const double *tm, const double *ce,\n    \
             const double *cm, int n, double step)\n{{\n    double t = 1, p = 1, y = 0;\n    (void)te; (void)ce; (void)step;\n    \
             for (int i = 0; i < n; i++) {{\n        double a = 1 - exp(-tm[i] * (l[i + 1] - l[i]));\n        \
             y += {seen} * a * cm[i];\n        p = t;\n        t *= 1 - a;\n    }}\n    (void)p;\n    return y;\n}}\n"
        );
        let (file, program) = (folder.path().join("test.c"), folder.path().join("test"));
        std::fs::write(&file, &source).unwrap();
        let built = std::process::Command::new("cc")
            .args([
                file.as_os_str(),
                "-o".as_ref(),
                program.as_os_str(),
                "-lm".as_ref(),
            ])
            .output();
        let Ok(built) = built else {
            eprintln!("skipped: no cc");
            return;
        };
        assert!(
            built.status.success(),
            "{source}\n{}",
            String::from_utf8_lossy(&built.stderr)
        );
        let run = std::process::Command::new(&program).output().unwrap();
        assert_eq!(run.status.success(), passes, "{source}");
    }
}

/// A march that refuses some rays.
#[derive(Debug)]
struct Picky {
    declaration: Declaration,
    fault: Fault,
    refuses: fn(usize) -> bool,
}

impl Kernel for Picky {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let segments = task.cut().expect("segments");
        if (self.refuses)(segments.count()) {
            let reason = "not that many".into();
            return Err(KernelError::Refused { reason });
        }
        let channels = 0..segments.middles.emission.len();
        let radiance =
            channels.map(|channel| Float::with_val(53, march(segments, channel, self.fault)));
        Ok(Rendering {
            radiance: radiance.collect(),
            ..Rendering::default()
        })
    }
}

#[test]
fn rays_that_a_kernel_refuses_are_no_witness() {
    let mut kernel = Picky {
        declaration: Declaration::new("picky"),
        fault: Fault::Smoothed,
        refuses: |n| n == 2,
    };
    // Smoothing shows on two segments first, which are refused.
    let witness = examine(&mut kernel, Budget::default(), &mut |_| ()).witness;
    assert_eq!(witness.expect("a witness").segments(), 3);
    kernel.refuses = |_| true;
    let nothing = examine(&mut kernel, Budget::default(), &mut |_| ());
    assert_eq!(nothing.verdict(), Verdict::NoAnswer);
    assert!(nothing.witness.is_none());
}

#[test]
fn a_witness_has_a_number_of_segments_that_the_kernel_takes() {
    let mut kernel = Picky {
        declaration: Declaration {
            multiple_of: NonZeroU64::new(4).expect("not 0"),
            step_divides: true,
            ..Declaration::new("by fours")
        },
        fault: Fault::Late,
        refuses: |n| n % 4 != 0,
    };
    let examined = examine(&mut kernel, Budget::default(), &mut |_| ());
    assert_eq!(examined.witness.expect("a witness").segments(), 4);
}
