//! A rule against rays that it was not found with.

use super::random::Random;
use super::ray::{Emission, Layers, Ray};
use super::rule::{Rule, Scheme, Whole};
use super::session::{Session, Silence};
use super::weights::Answers;
use crate::kernel::Segments;
use crate::real::Native;

/// A kind of rays, and how the rule did on them.
#[derive(Clone, Debug, PartialEq)]
pub struct Kind {
    /// In words.
    pub name: String,
    /// Rays asked.
    pub rays: usize,
    /// Rays on which every channel agrees.
    pub agree: usize,
    /// Rays without an answer.
    pub unanswered: usize,
    /// Correct decimal digits of the answer that agrees least.
    pub digits: f64,
}

impl Kind {
    /// Whether the rule was seen to hold on rays of this kind.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.agree > 0 && self.agree + self.unanswered == self.rays
    }
}

/// A ray on which a rule fails.
#[derive(Clone, Debug)]
pub struct Miss {
    /// The ray.
    pub ray: Ray,
    /// Which channel.
    pub channel: usize,
    /// What the kernel answers.
    pub got: f64,
    /// What the rule says.
    pub want: f64,
}

/// What came of a hold-out.
#[derive(Clone, Debug, Default)]
pub struct HoldOut {
    /// Kind by kind.
    pub kinds: Vec<Kind>,
    /// Rays on which it fails.
    pub misses: Vec<Miss>,
    /// The opacities answered beside 1 − T of the rule.
    pub opacity: OpacityCheck,
}

/// Opacities that were answered.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OpacityCheck {
    /// How many.
    pub answered: usize,
    /// How many of them are 1 − T of the whole ray.
    pub agree: usize,
    /// The largest difference.
    pub largest: f64,
}

impl HoldOut {
    /// Whether it holds on every kind.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.kinds.len() >= FEWEST && self.kinds.iter().all(Kind::holds)
    }
}

/// A rule that holds on fewer kinds than this is not known to hold.
const FEWEST: usize = 4;

/// The depth of a segment that is a wall.
const WALL: f64 = 1e5;

/// How rays of a kind are made.
#[derive(Clone, Copy)]
struct Make {
    name: &'static str,
    /// Optical depths of the whole ray.
    depth: [f64; 2],
    segments: [usize; 2],
    /// The step, by its range.
    step: [f64; 2],
    /// The largest emission.
    bright: f64,
    what: What,
    /// How many whose steps divide them.
    whole: usize,
    /// How many whose last step is shorter.
    partial: usize,
}

#[derive(Clone, Copy, PartialEq)]
enum What {
    /// Everywhere something.
    Full,
    /// Four of ten segments hold nothing.
    Gaps,
    /// The last segment holds nothing; or the first.
    EmptyEnd,
    /// One segment of that depth hides all behind it.
    Opaque(f64),
    /// The last step is a small part of the others.
    ShortLast,
    /// All but the same everywhere.
    NearlyEven,
    /// Emissions of both signs.
    Negative,
    /// Extinctions and emissions that change slowly, as those of users do.
    Smooth,
    /// The same everywhere.
    Even,
    /// As many as these, with gaps, that have one name.
    OneName,
}

const USUAL: Make = Make {
    name: "",
    depth: [0.02, 3.0],
    segments: [9, 40],
    step: [0.03, 0.9],
    bright: 1.0,
    what: What::Full,
    whole: 1,
    partial: 1,
};

/// The kinds: what tells rules apart that differ on few rays has one of its own.
const MAKES: [Make; 24] = [
    Make {
        name: "smooth",
        segments: [150, 250],
        what: What::Smooth,
        whole: 0,
        partial: 1,
        ..USUAL
    },
    Make {
        name: "even",
        segments: [20, 60],
        what: What::Even,
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "nearly even",
        segments: [50, 70],
        what: What::NearlyEven,
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "thin",
        depth: [1e-3, 0.02],
        whole: 0,
        partial: 1,
        ..USUAL
    },
    Make {
        name: "nearly empty",
        depth: [1e-9, 1e-6],
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "middling",
        ..USUAL
    },
    Make {
        name: "thick",
        depth: [3.0, 14.0],
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "very thick",
        depth: [14.0, 60.0],
        whole: 0,
        partial: 1,
        ..USUAL
    },
    Make {
        name: "with gaps",
        what: What::Gaps,
        whole: 0,
        partial: 1,
        ..USUAL
    },
    Make {
        name: "empty at an end",
        // Loops unrolled by up to 16 take the last one, too.
        segments: [48, 48],
        what: What::EmptyEnd,
        ..USUAL
    },
    Make {
        name: "opaque inside",
        what: What::Opaque(36.0),
        whole: 0,
        partial: 1,
        ..USUAL
    },
    Make {
        name: "opaque as a wall inside",
        step: [1e-3, 4e-3],
        what: What::Opaque(WALL),
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "of one segment",
        segments: [1, 1],
        ..USUAL
    },
    Make {
        name: "of few segments",
        segments: [2, 4],
        whole: 0,
        partial: 1,
        ..USUAL
    },
    Make {
        name: "with next to nothing as a last step",
        what: What::ShortLast,
        whole: 0,
        partial: 2,
        ..USUAL
    },
    Make {
        name: "bright",
        bright: 20.0,
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "glaring",
        bright: 2e4,
        whole: 0,
        partial: 1,
        ..USUAL
    },
    Make {
        name: "dim",
        bright: 2e-5,
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "short",
        step: [1e-3, 4e-3],
        whole: 0,
        partial: 1,
        ..USUAL
    },
    Make {
        name: "long",
        step: [20.0, 60.0],
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "with negative emission",
        what: What::Negative,
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "of very many segments",
        segments: [1_190, 1_210],
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "of many segments",
        // After a longer ray: what is left of that one shows.
        segments: [65, 119],
        whole: 0,
        partial: 1,
        ..USUAL
    },
    // Different rays of one name and one number of segments: what is remembered by these shows.
    Make {
        name: "of one name",
        segments: [24, 24],
        step: [0.25, 0.25],
        what: What::OneName,
        whole: 3,
        partial: 0,
        ..USUAL
    },
];

/// The optical depth of thick rays.
pub(super) const SLOPE: f64 = 40.0;

/// The kinds for which there are rays where there are few.
const CORE: [&str; 7] = [
    "smooth",
    "of very many segments",
    "thick",
    "empty at an end",
    "of one segment",
    "with next to nothing as a last step",
    "glaring",
];

/// What is held out, beside the rule.
#[derive(Clone, Copy, Debug)]
pub(super) struct Terms<'a> {
    pub(super) answers: &'a Answers,
    /// The extinction of depth 1 in a segment of length 1, by this kernel's law.
    pub(super) typical: f64,
    /// Rays with empty segments have no answer.
    pub(super) no_vacuum: bool,
    /// It takes negative emissions.
    pub(super) negative: bool,
}

/// Asks rays of all kinds.
pub(super) fn hold_out(
    session: &mut Session<'_>,
    rule: &Rule,
    terms: &Terms<'_>,
) -> Result<HoldOut, Silence> {
    let mut random = Random::new(97);
    let mut out = HoldOut::default();
    for make in MAKES {
        let has_gaps = matches!(make.what, What::Gaps | What::EmptyEnd | What::OneName);
        if (has_gaps && terms.no_vacuum)
            || (make.what == What::Negative && !terms.negative)
            || (session.is_short() && !CORE.contains(&make.name))
            // Quadratures inside segments have their own end; between nodes a wall is a slope.
            || (make.what == What::Opaque(WALL)
                && (rule.lattice.is_some() || matches!(rule.scheme, Scheme::Segments { .. })))
        {
            continue;
        }
        let counts = if session.divides {
            [(false, make.whole.max(1)), (true, 0)]
        } else {
            [(false, make.whole), (true, make.partial)]
        };
        for (partial, rays) in counts {
            let rays = if session.is_short() {
                rays.min(1)
            } else {
                rays
            };
            if rays == 0 {
                continue;
            }
            let mut kind = Kind {
                name: format!(
                    "{}{}",
                    make.name,
                    if partial && make.what != What::ShortLast {
                        ", shorter last step"
                    } else {
                        ""
                    }
                ),
                rays: 0,
                agree: 0,
                unanswered: 0,
                digits: 17.0,
            };
            for _ in 0..rays {
                let ray = ray(session, &mut random, make, partial, terms);
                kind.rays += 1;
                match session.ask_any(&ray) {
                    Ok(got) => {
                        judge(rule, terms, &ray, &got, &mut kind, &mut out.misses);
                        if let Some(opacity) = session.opacity {
                            let (segments, step) = rule.cut(&ray);
                            let answers = of_places(rule, terms.answers);
                            check_opacity(
                                rule,
                                &answers,
                                (&segments, step),
                                opacity,
                                &mut out.opacity,
                            );
                        }
                    }
                    // What was asked until then counts.
                    Err(Silence::Budget(_)) if out.kinds.len() >= FEWEST => return Ok(out),
                    Err(Silence::Budget(spent)) => return Err(Silence::Budget(spent)),
                    Err(_) => kind.unanswered += 1,
                }
            }
            out.kinds.push(kind);
        }
    }
    if rule.stop.is_some() {
        let kind = about_the_end(session, rule, terms, &mut random, &mut out.misses)?;
        out.kinds.extend((kind.rays > 0).then_some(kind));
    }
    Ok(out)
}

/// How near to its early end a ray is made to come.
const NEAR: f64 = 2e-3;

/// Rays that just end early, and that just do not: elsewhere a threshold does not show.
fn about_the_end(
    session: &mut Session<'_>,
    rule: &Rule,
    terms: &Terms<'_>,
    random: &mut Random,
    misses: &mut Vec<Miss>,
) -> Result<Kind, Silence> {
    let mut kind = Kind {
        name: "about to end early".into(),
        rays: 0,
        agree: 0,
        unanswered: 0,
        digits: 17.0,
    };
    let make = Make {
        depth: [1.0, 1.0],
        segments: [16, 24],
        ..USUAL
    };
    for _ in 0..2 {
        let shape = ray(session, random, make, false, terms);
        let scaled = |scale: f64| {
            let mut ray = shape.clone();
            let all = [&mut ray.segments.edges, &mut ray.segments.middles];
            for samples in all {
                samples.extinction.iter_mut().for_each(|tau| *tau *= scale);
            }
            ray
        };
        let taken = |scale: f64| {
            let ray = scaled(scale);
            let (segments, step) = rule.cut(&ray);
            let composed = rule.composed(&segments, step, Native::<f64>::new());
            composed.terms.len()
        };
        // By a transmittance thick rays end, by a weight thin ones: where the number of samples changes.
        let scales: Vec<f64> = (0..40).map(|k| 1e-3 * 1.4_f64.powi(k)).collect();
        let change = scales.windows(2).find(|w| taken(w[0]) != taken(w[1]));
        let Some(&[mut low, mut high]) = change else {
            continue;
        };
        let before = taken(low);
        for _ in 0..60 {
            let middle = (low * high).sqrt();
            if taken(middle) == before {
                low = middle;
            } else {
                high = middle;
            }
        }
        for scale in [low * (1.0 - NEAR), high * (1.0 + NEAR)] {
            let mut ray = scaled(scale);
            ray.name = session.name();
            kind.rays += 1;
            match session.ask_any(&ray) {
                Ok(got) => judge(rule, terms, &ray, &got, &mut kind, misses),
                Err(Silence::Budget(spent)) => return Err(Silence::Budget(spent)),
                Err(_) => kind.unanswered += 1,
            }
        }
    }
    Ok(kind)
}

fn ray(
    session: &mut Session<'_>,
    random: &mut Random,
    make: Make,
    partial: bool,
    terms: &Terms<'_>,
) -> Ray {
    let [fewest, most] = make.segments;
    let n = random
        .integer(fewest, most)
        .next_multiple_of(session.multiple);
    let [low, high] = make.depth;
    let depth = random.geometric(low, high) * terms.typical;
    let [short, long] = make.step;
    let step = random.geometric(short, long);
    let last = if partial {
        match make.what {
            What::ShortLast => random.geometric(2e-3, 0.1),
            _ => random.within(0.15, 0.95),
        }
    } else {
        1.0
    };
    let has_gaps = matches!(make.what, What::Gaps | What::OneName);
    let mut taus = |count: usize| -> Vec<f64> {
        let scale = depth / (n as f64 * step);
        let one = |random: &mut Random| {
            let tau = random.uneven() * scale;
            if has_gaps && random.part() < 0.4 {
                0.0
            } else {
                tau
            }
        };
        (0..count).map(|_| one(random)).collect()
    };
    let (mut edges, mut middles) = (taus(n + 1), taus(n));
    match make.what {
        What::EmptyEnd => {
            // Every node of the segment at this end.
            (edges[n], edges[n - 1], middles[n - 1]) = (0.0, 0.0, 0.0);
            if partial {
                (edges[0], middles[0]) = (0.0, 0.0);
            }
        }
        What::Opaque(depth) => {
            let at = n / 3;
            let opaque = depth * terms.typical / step;
            (edges[at], edges[at + 1], middles[at]) = (opaque, opaque, opaque);
        }
        What::Smooth => {
            let mean = depth / (n as f64 * step);
            let wave = wave(random);
            edges = (0..=n).map(|i| mean * wave(i as f64 / n as f64)).collect();
            middles = (0..n)
                .map(|i| mean * wave((i as f64 + 0.5) / n as f64))
                .collect();
        }
        What::Even => {
            let tau = depth / (n as f64 * step);
            (edges, middles) = (vec![tau; n + 1], vec![tau; n]);
        }
        What::NearlyEven => {
            let tau = depth / (n as f64 * step);
            edges = (0..=n).map(|_| tau * random.within(0.995, 1.005)).collect();
            middles = (0..n).map(|_| tau * random.within(0.995, 1.005)).collect();
        }
        What::OneName => {
            // The same at both ends: a key made of these is no key.
            let mean = 0.5 * terms.typical / (n as f64 * step);
            (edges[0], middles[0], edges[n], middles[n - 1]) = (mean, mean, mean, mean);
        }
        What::Full | What::Gaps | What::Negative | What::ShortLast => {}
    }
    let bright = make.bright * if partial { 1.0 } else { 4.0 };
    let low = if make.what == What::Negative {
        -bright
    } else {
        0.0
    };
    let emission: Vec<Emission> = (0..3)
        .map(|_| match make.what {
            What::Smooth => {
                let wave = wave(random);
                Emission::of(n, |i| 0.5 * bright * wave(i / n as f64))
            }
            What::Even => Emission::even(n, random.within(low, bright)),
            What::NearlyEven => Emission::of(n, |_| bright * random.within(0.995, 1.005)),
            _ => Emission::of(n, |_| random.within(low, bright)),
        })
        .collect();
    let layers = Layers {
        step,
        last,
        edges,
        middles,
    };
    let mut ray = session.ray(&layers, &emission);
    // What hangs on the seed at times only.
    ray.seed = random.integer(1, 1_000_000) as u64;
    if make.what == What::OneName {
        ray.name = "probe".into();
    }
    ray
}

/// A wave about 1, with two periods or fewer along the ray.
fn wave(random: &mut Random) -> impl Fn(f64) -> f64 + use<> {
    let (phase, periods) = (random.within(0.0, 6.0), random.within(0.5, 2.0));
    move |part| 1.0 + 0.9 * (phase + std::f64::consts::TAU * periods * part).sin()
}

/// Compares the opacity that came with an answer with 1 − T, which it returns.
pub(super) fn check_opacity(
    rule: &Rule,
    answers: &Answers,
    (segments, step): (&Segments, f64),
    got: f64,
    check: &mut OpacityCheck,
) -> f64 {
    let composed = rule.composed(segments, step, Native::<f64>::new());
    let n = segments.count() as f64;
    let quantum = rule.output.quantum.unwrap_or(0.0);
    let allowed = answers.unit * (64.0 + 8.0 * n) + answers.noise + quantum;
    let want = 1.0 - composed.passes;
    let off = (got - want).abs();
    check.answered += 1;
    check.agree += usize::from(off <= allowed);
    // A difference that is no number is no small one.
    check.largest = if off.is_finite() {
        check.largest.max(off)
    } else {
        f64::INFINITY
    };
    want
}

/// Compares the answers to a ray with the rule's.
fn judge(
    rule: &Rule,
    terms: &Terms<'_>,
    ray: &Ray,
    got: &[f64],
    kind: &mut Kind,
    misses: &mut Vec<Miss>,
) {
    let mut agrees = true;
    let (segments, step) = rule.cut(ray);
    let rounded = of_places(rule, terms.answers);
    for (channel, compared) in compare(rule, &rounded, &segments, step, got)
        .into_iter()
        .enumerate()
    {
        kind.digits = kind.digits.min(compared.digits);
        if !compared.agrees {
            agrees = false;
            misses.push(Miss {
                ray: ray.clone(),
                channel,
                got: compared.got,
                want: compared.want,
            });
        }
    }
    kind.agree += usize::from(agrees);
}

/// A place that a kernel works out is off by rounding, and values there by as much times the medium's slope, which adds up
/// to a unit times the optical depth times n.
pub(super) fn of_places(rule: &Rule, answers: &Answers) -> Answers {
    Answers {
        unit: answers.unit * if rule.lattice.is_some() { SLOPE } else { 1.0 },
        ..answers.clone()
    }
}

/// An answer beside the rule's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Compared {
    pub(super) got: f64,
    pub(super) want: f64,
    /// Whether they differ by no more than rounding.
    pub(super) agrees: bool,
    pub(super) digits: f64,
}

/// Answers, in the order of the channels, beside the rule's.
pub(super) fn compare(
    rule: &Rule,
    answers: &Answers,
    segments: &Segments,
    step: f64,
    got: &[f64],
) -> Vec<Compared> {
    let format = Native::<f64>::new();
    let composed = rule.composed(segments, step, format);
    let n = segments.count() as f64;
    let cancels = rule.cancels(segments);
    let of_channel = |(channel, &got): (usize, &f64)| {
        let x = rule.radiance(&composed, segments, channel, format);
        let values = |of: &[Vec<f64>]| {
            let own = of.get(channel).into_iter().flatten();
            own.map(|c| c.abs()).fold(0.0, f64::max)
        };
        let bright = values(&segments.edges.emission).max(values(&segments.middles.emission));
        // Every segment rounds a few times, its opacity by a unit of 1; opacities above 1 make terms alternate that are
        // larger than anything given.
        let terms = composed.sizes(segments, channel);
        let largest = (bright * rule.largest_scale()).max(terms);
        let size = x.abs() + composed.factor.abs() * largest;
        let slack = answers.unit * (16.0 + 4.0 * n) * size + answers.noise * size;
        let slack = slack + answers.grain * n * size;
        let slack = slack + answers.unit * 8.0 * bright * cancels;
        let slack = if rule.whole == Whole::ByOpacity {
            // 1 − T is known to a unit of 1.
            slack + answers.unit * 16.0 * x.abs() * composed.factor.abs()
        } else {
            slack
        };
        let exact = super::rule::Output {
            quantum: None,
            ..rule.output
        };
        let (low, high) = (exact.of(x - slack), exact.of(x + slack));
        let want = rule.output.of(x);
        let quantum = rule.output.quantum.unwrap_or(0.0) * 1.01;
        let rounding = quantum + 4.0 * answers.unit * want.abs();
        let agrees =
            (got >= low - rounding && got <= high + rounding) || (got.is_nan() && want.is_nan());
        let miss = (got - want).abs() / want.abs().max(got.abs()).max(1e-300);
        Compared {
            got,
            want,
            agrees,
            digits: if !got.is_finite() && want.is_finite() {
                0.0
            } else if miss > 0.0 {
                (-miss.log10()).clamp(0.0, 17.0)
            } else {
                17.0
            },
        }
    };
    got.iter().enumerate().map(of_channel).collect()
}
