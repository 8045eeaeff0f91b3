//! What an examination says of kernels whose faults are known: parameters between their brackets, against what is
//! declared, and what comes beside the radiance.

use rug::Float;
use volver::identify::{Budget, Deviation, Examined, Verdict, examine};
use volver::kernel::{
    Closure, Declaration, Kernel, KernelError, Rendering, Sampling, Segments, Task,
};
use volver::method::Method;

/// One sample a segment, with a value of its own for every hook: nothing of the library.
#[derive(Clone, Copy)]
struct March {
    /// Which of front, middle, back.
    place: usize,
    opacity: fn(f64) -> f64,
    emission: fn(f64) -> f64,
    answer: fn(f64) -> f64,
    /// 1 − T is multiplied by this where it is answered.
    told: f64,
    /// A place drawn from the seed, and nothing else.
    drawn: bool,
}

const PLAIN: March = March {
    place: 1,
    opacity: |x| -(-x).exp_m1(),
    emission: |c| c,
    answer: |y| y,
    told: 1.0,
    drawn: false,
};

impl March {
    fn sampled(&self, edges: &[f64], middles: &[f64], i: usize, part: f64) -> f64 {
        if self.drawn {
            return if part < 0.5 {
                edges[i] + 2.0 * part * (middles[i] - edges[i])
            } else {
                middles[i] + (2.0 * part - 1.0) * (edges[i + 1] - middles[i])
            };
        }
        [edges[i], middles[i], edges[i + 1]][self.place]
    }

    /// Radiance and transmittance.
    fn along(&self, segments: &Segments, channel: usize, seed: u64) -> (f64, f64) {
        let (edges, middles) = (&segments.edges, &segments.middles);
        let (mut sum, mut through) = (0.0, 1.0);
        // Knuth's multiplier, and a shift that mixes.
        let mut state = seed.wrapping_mul(6_364_136_223_846_793_005) ^ 0x9E37_79B9_7F4A_7C15;
        for i in 0..segments.count() {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            let mixed = (state ^ (state >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            let part = (mixed >> 11) as f64 / (1_u64 << 53) as f64;
            let tau = self.sampled(&edges.extinction, &middles.extinction, i, part);
            let c = self.sampled(
                &edges.emission[channel],
                &middles.emission[channel],
                i,
                part,
            );
            let opacity = (self.opacity)(tau * (edges.lambda[i + 1] - edges.lambda[i]));
            sum += through * opacity * (self.emission)(c);
            through *= 1.0 - opacity;
        }
        ((self.answer)(sum), through)
    }
}

#[derive(Debug)]
struct Marching {
    declaration: Declaration,
    march: fn() -> March,
}

impl Kernel for Marching {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let segments = task.cut().expect("segments");
        let march = (self.march)();
        let channels = 0..segments.middles.emission.len();
        let all: Vec<(f64, f64)> = channels
            .map(|channel| march.along(segments, channel, task.seed))
            .collect();
        let through = all.first().map_or(1.0, |(_, through)| *through);
        let exact = |x: f64| Float::with_val(53, x);
        Ok(Rendering {
            radiance: all.iter().map(|(y, _)| exact(*y)).collect(),
            opacity: Some(exact(march.told * (1.0 - through))),
            ..Rendering::default()
        })
    }
}

fn examined(march: fn() -> March, declare: impl FnOnce(&mut Declaration)) -> Examined {
    let mut declaration = Declaration::new("by hand");
    declare(&mut declaration);
    let mut kernel = Marching { declaration, march };
    examine(&mut kernel, Budget::default(), &mut |_| ())
}

fn names(examined: &Examined) -> Vec<&'static str> {
    examined.deviations.iter().map(|d| d.name).collect()
}

#[test]
fn what_is_bisected_lies_in_a_narrow_bracket_of_the_true_value() {
    type Known = (&'static str, f64, f64, fn() -> March);
    let kernels: [Known; 5] = [
        ("skip", 2.3e-3, 1e-6, || March {
            opacity: |x| {
                if x < -(-2.3e-3_f64).ln_1p() {
                    0.0
                } else {
                    -(-x).exp_m1()
                }
            },
            ..PLAIN
        }),
        ("opacity-clamp", 0.97, 1e-9, || March {
            opacity: |x| (-(-x).exp_m1()).min(0.97),
            ..PLAIN
        }),
        ("series", 0.07, 1e-6, || March {
            opacity: |x| {
                if x < 0.07 {
                    x - x * x / 2.0
                } else {
                    -(-x).exp_m1()
                }
            },
            ..PLAIN
        }),
        ("output-curve", 1.0 / 1.8, 1e-6, || March {
            answer: |y| y.max(0.0).powf(1.0 / 1.8),
            ..PLAIN
        }),
        ("emission-high", 3.25, 1e-9, || March {
            emission: |c| c.min(3.25),
            ..PLAIN
        }),
    ];
    for (name, value, width, march) in kernels {
        let examined = examined(march, |_| ());
        assert_eq!(names(&examined), [name]);
        let Deviation {
            bracket,
            validated,
            probe,
            ..
        } = &examined.deviations[0];
        let (low, high) = bracket.unwrap_or_else(|| panic!("{name}: no bracket"));
        assert!(
            low <= value * (1.0 + 1e-12) && value * (1.0 - 1e-12) <= high,
            "{name}: {low} {high}"
        );
        assert!(high - low <= width * value, "{name}: {low} {high}");
        assert!(!probe.is_empty());
        let held = examined.found.hold_out.kinds.iter();
        let held: Vec<&String> = held.map(|kind| &kind.name).collect();
        assert_eq!(validated.iter().collect::<Vec<_>>(), held, "{name}");
    }
}

#[test]
fn a_declared_method_is_what_a_kernel_is_compared_with() {
    let method = |name: &str| -> Method { name.parse().unwrap() };
    let declared = |name, march| {
        let method = method(name);
        examined(march, |declaration| declaration.method = Some(method))
    };
    let right = declared("front-to-back/middle/expm1", || PLAIN);
    assert_eq!(right.verdict(), Verdict::Right);
    // Another place is no fault of its own, and one of a kernel that says otherwise.
    let elsewhere = declared("front-to-back/back/expm1", || PLAIN);
    assert_eq!(names(&elsewhere), ["place"]);
    let witness = elsewhere.witness.expect("a witness");
    assert!(witness.segments() <= 2, "{witness}");
    // A fault that is declared is none.
    let linear = || March {
        opacity: |x| x,
        ..PLAIN
    };
    assert_eq!(
        declared("front-to-back/middle/linear", linear).verdict(),
        Verdict::Right
    );
    assert_eq!(
        names(&declared("front-to-back/middle/expm1", linear)),
        ["opacity-law"]
    );
    let nested = declared("trapezoid/trapezoid", || PLAIN);
    assert!(
        names(&nested).contains(&"segment-weights"),
        "{:?}",
        names(&nested)
    );
    let sampling = examined(
        || PLAIN,
        |declaration| declaration.sampling = Some(Sampling::Front),
    );
    assert_eq!(names(&sampling), ["place"]);
}

#[test]
fn an_opacity_that_is_not_that_of_the_ray_is_a_deviation_with_its_ray() {
    assert_eq!(examined(|| PLAIN, |_| ()).verdict(), Verdict::Right);
    let half = || March { told: 0.5, ..PLAIN };
    let examined = examined(half, |_| ());
    assert_eq!(names(&examined), ["opacity-answered"]);
    assert!(examined.witness.is_none());
    let shown = examined.opacity.expect("a ray");
    // α of one segment of depth 1.
    let want = 1.0 - (-1.0_f64).exp();
    assert_eq!(shown.ray.segments.count(), 1);
    assert!((shown.want - want).abs() < 1e-15 && (shown.got - want / 2.0).abs() < 1e-15);
    assert_eq!(
        shown.to_string(),
        "n = 1, d = 1, τ = 1: 0.3161 where 1 − T is 0.6321"
    );
}

#[test]
fn of_samples_at_random_the_law_is_read_and_compared() {
    let declare = |declaration: &mut Declaration| declaration.stochastic = true;
    let right = || March {
        drawn: true,
        ..PLAIN
    };
    let examined_right = examined(right, declare);
    assert_eq!(examined_right.verdict(), Verdict::Right);
    let text = examined_right.found.scattered.expect("places").to_string();
    assert!(text.contains("somewhere in their segments"), "{text}");
    let bright = || March {
        drawn: true,
        answer: |y| 1.5 * y,
        ..PLAIN
    };
    let found = examined(bright, declare);
    assert_eq!(names(&found), ["scale"]);
    // Where the sample lies does not matter in a segment that is the same everywhere.
    let witness = found.witness.expect("a witness");
    assert_eq!(witness.segments(), 1);
    assert!(
        (witness.got - 1.5 * witness.want).abs() < 1e-12,
        "{witness}"
    );
    assert_eq!(names(&examined(right, |_| ())), ["seed"]);
}

#[test]
fn rare_faults_without_a_name_have_a_witness_within_the_budget() {
    // From 300 segments on every second one is left out.
    let mut sparse = Closure::segments("sparse", |segments, channel| {
        let n = segments.count();
        let (mut sum, mut through) = (0.0, 1.0);
        for i in (0..n).step_by(if n < 300 { 1 } else { 2 }) {
            let d = segments.edges.lambda[i + 1] - segments.edges.lambda[i];
            let opacity = -(-segments.middles.extinction[i] * d).exp_m1();
            sum += through * opacity * segments.middles.emission[channel][i];
            through *= 1.0 - opacity;
        }
        sum
    });
    let examined = examine(&mut sparse, Budget::default(), &mut |_| ());
    assert_eq!(examined.verdict(), Verdict::NotIdentified);
    let witness = examined.witness.expect("a witness");
    assert_eq!(witness.segments(), 300, "{witness}");
    assert!(witness.to_string().len() < 200, "{witness}");
    // The last segment is sampled in front: no one of three places explains that.
    let mut last = Closure::segments("last in front", |segments, channel| {
        let n = segments.count();
        let (mut sum, mut through) = (0.0, 1.0);
        for i in 0..n {
            let d = segments.edges.lambda[i + 1] - segments.edges.lambda[i];
            let of =
                |edges: &[f64], middles: &[f64]| if i + 1 == n { edges[i] } else { middles[i] };
            let (edges, middles) = (&segments.edges, &segments.middles);
            let opacity = -(-of(&edges.extinction, &middles.extinction) * d).exp_m1();
            sum += through * opacity * of(&edges.emission[channel], &middles.emission[channel]);
            through *= 1.0 - opacity;
        }
        sum
    });
    let examined = examine(&mut last, Budget::default(), &mut |_| ());
    if let Some(rule) = examined.found.named() {
        panic!("a false name: {rule}");
    }
    let witness = examined.witness.expect("a witness");
    assert!(witness.segments() <= 4, "{witness}");
}

/// Σ C τ d e^(−t), with t up to the front of segments: Riemann's sum inside and outside.
#[test]
fn a_riemann_sum_is_right_where_no_more_than_its_order_is_declared() {
    let deviations = |order: Option<f64>| {
        let mut declaration = Declaration::new("sum");
        declaration.order = order;
        let mut kernel = Closure::new(declaration, |task: &Task<'_>, channel| {
            let segments = task.cut().expect("segments");
            let (mut radiance, mut depth) = (0.0, 0.0);
            let ends = segments.edges.extinction.iter();
            let ends = ends.zip(&segments.edges.emission[channel]);
            for ((tau, c), d) in ends.zip(segments.lengths()) {
                radiance += c * tau * d * f64::exp(-depth);
                depth += tau * d;
            }
            radiance
        });
        names(&examine(&mut kernel, Budget::default(), &mut |_| ()))
    };
    assert!(deviations(Some(1.0)).is_empty());
    assert_eq!(deviations(Some(2.0)), ["weight"]);
    assert_eq!(deviations(None), ["weight"]);
}

/// Euler's and the midpoint's implicit steps have the orders 1 and 2; no more is promised of them.
#[test]
fn an_implicit_step_is_right_where_no_more_than_its_order_is_declared() {
    let euler = || March {
        place: 2,
        opacity: |x| x / (1.0 + x),
        ..PLAIN
    };
    let midpoint = || March {
        opacity: |x| x / (1.0 + x / 2.0),
        ..PLAIN
    };
    let all: [(fn() -> March, f64); 2] = [(euler, 1.0), (midpoint, 2.0)];
    for (march, own) in all {
        for (order, deviates) in [(Some(own), false), (Some(own + 1.0), true), (None, true)] {
            let examined = examined(march, |declaration| declaration.order = order);
            assert!(examined.found.named().is_some());
            assert_eq!(!names(&examined).is_empty(), deviates, "{own} as {order:?}");
        }
    }
}
