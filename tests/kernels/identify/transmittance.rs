//! How a kernel keeps the transmittance, named right or not at all: kernels written here, in three formats.

use volver::identify::{Budget, Examined, Transmittance, examine};
use volver::kernel::{Closure, Declaration, Segments, Task};

/// To a format's bits.
type Round = fn(f64) -> f64;

/// What stands in front of a segment.
#[derive(Clone, Copy)]
struct State {
    /// T.
    through: f64,
    /// Σ x.
    depth: f64,
    /// What is summed beside, from 1 on, and what was lost of it.
    sum: f64,
    lost: f64,
}

/// The opacity of a depth.
type Opacity = fn(f64, Round) -> f64;
/// Passes a segment of that depth and opacity.
type Step = fn(&mut State, f64, f64, Round);

fn exactly(x: f64) -> f64 {
    x
}

fn binary32(x: f64) -> f64 {
    f64::from(x as f32)
}

fn eleven_bits(x: f64) -> f64 {
    rug::Float::with_val(11, x).to_f64()
}

const ROUNDS: [(&str, Round); 3] = [("f64", exactly), ("f32", binary32), ("f16", eleven_bits)];

fn expm1(x: f64, round: Round) -> f64 {
    round(-(-x).exp_m1())
}

fn subtraction(x: f64, round: Round) -> f64 {
    round(1.0 - round((-x).exp()))
}

fn products(state: &mut State, _: f64, alpha: f64, round: Round) {
    state.through = round(state.through * round(1.0 - alpha));
}

fn exponentials(state: &mut State, x: f64, _: f64, round: Round) {
    state.through = round(state.through * round((-x).exp()));
}

fn remainder(state: &mut State, _: f64, alpha: f64, round: Round) {
    state.through = round(state.through - round(state.through * alpha));
}

/// As a processor contracts it: rounded once.
fn fused(state: &mut State, _: f64, alpha: f64, round: Round) {
    let exact = f64::mul_add(-alpha, state.through, state.through);
    state.through = round(exact);
}

/// Neumaier's: what each addition loses is summed beside.
fn compensated(state: &mut State, _: f64, alpha: f64, round: Round) {
    let term = -round(state.through * alpha);
    let next = round(state.sum + term);
    state.lost = round(state.lost + round(round(state.sum - next) + term));
    state.sum = next;
    state.through = round(state.sum + state.lost);
}

fn depths(state: &mut State, x: f64, _: f64, round: Round) {
    state.depth = round(state.depth + x);
    state.through = round((-state.depth).exp());
}

/// Of a sum in binary64.
fn long_depths(state: &mut State, x: f64, _: f64, round: Round) {
    state.depth += x;
    state.through = round((-state.depth).exp());
}

/// Of a sum that begins with 1, whose last places are others.
fn depths_from_one(state: &mut State, x: f64, _: f64, round: Round) {
    state.sum = round(state.sum + x);
    state.through = round((1.0 - state.sum).exp());
}

fn opacity_so_far(state: &mut State, _: f64, alpha: f64, round: Round) {
    state.lost = round(state.lost + round(round(1.0 - state.lost) * alpha));
    state.through = round(1.0 - state.lost);
}

/// Rounded to 0.
fn cut_off(state: &mut State, _: f64, alpha: f64, round: Round) {
    let exact = state.through * (1.0 - alpha);
    let near = round(exact);
    let unit = round(near * (1.0 + 2e-7)) - near;
    state.through = if near > exact { near - unit } else { near };
}

/// One segment in this way, one in that.
fn by_turns(state: &mut State, x: f64, alpha: f64, round: Round) {
    state.lost = 1.0 - state.lost;
    let step = if state.lost > 0.0 {
        products
    } else {
        remainder
    };
    step(state, x, alpha, round);
}

fn examined(round: Round, opacity: Opacity, step: Step) -> Examined {
    let radiance = move |segments: &Segments, channel: usize| {
        let (edges, middles) = (&segments.edges, &segments.middles);
        let mut radiance = 0.0;
        let mut state = State {
            through: 1.0,
            depth: 0.0,
            sum: 1.0,
            lost: 0.0,
        };
        for i in 0..segments.count() {
            let d = round(edges.lambda[i + 1]) - round(edges.lambda[i]);
            let x = round(round(middles.extinction[i]) * round(d));
            let alpha = opacity(x, round);
            let weight = round(state.through * alpha);
            let light = round(weight * round(middles.emission[channel][i]));
            radiance = round(radiance + light);
            step(&mut state, x, alpha, round);
        }
        radiance
    };
    of(radiance)
}

fn of(radiance: impl Fn(&Segments, usize) -> f64 + Send) -> Examined {
    let of_task = move |task: &Task<'_>, channel| {
        task.cut()
            .map_or(f64::NAN, |segments| radiance(segments, channel))
    };
    let mut kernel = Closure::new(Declaration::new("march"), of_task);
    examine(&mut kernel, Budget::default(), &mut |_| ())
}

#[test]
fn products_and_what_remains_are_told_apart_in_every_format() {
    let kernels: [(&str, Step, Transmittance); 6] = [
        ("T (1 − α)", products, Transmittance::Products),
        ("T e^(−x)", exponentials, Transmittance::Products),
        ("T − T α", remainder, Transmittance::Remainder),
        ("T − T α, fused", fused, Transmittance::Remainder),
        ("T − T α, compensated", compensated, Transmittance::Kept),
        ("e^(−Σ x)", depths, Transmittance::Depths),
    ];
    for (format, round) in ROUNDS {
        for (what, step, name) in kernels {
            let found = examined(round, expm1, step);
            assert!(found.found.named().is_some(), "{format} {what}");
            assert_eq!(found.found.transmittance, Some(name), "{format} {what}");
        }
    }
}

#[test]
fn more_digits_than_answers_have_are_seen() {
    let found = examined(binary32, expm1, long_depths);
    assert_eq!(found.found.transmittance, Some(Transmittance::Kept));
    // All but the answer in binary64.
    let found = of(|segments, channel| {
        let (lambda, middles) = (&segments.edges.lambda, &segments.middles);
        let (mut sum, mut through) = (0.0, 1.0);
        for i in 0..segments.count() {
            let alpha = -(-middles.extinction[i] * (lambda[i + 1] - lambda[i])).exp_m1();
            sum += through * alpha * middles.emission[channel][i];
            through *= 1.0 - alpha;
        }
        binary32(sum)
    });
    assert_eq!(found.found.transmittance, Some(Transmittance::Kept));
}

#[test]
fn towards_the_eye_products_are_seen_too() {
    for (format, round) in ROUNDS {
        let found = of(move |segments, channel| {
            let (lambda, middles) = (&segments.edges.lambda, &segments.middles);
            (0..segments.count()).rev().fold(0.0, |radiance, i| {
                let d = round(round(lambda[i + 1]) - round(lambda[i]));
                let alpha = expm1(round(round(middles.extinction[i]) * d), round);
                let behind = round(radiance * round(1.0 - alpha));
                round(behind + round(round(middles.emission[channel][i]) * alpha))
            })
        });
        let name = found.found.transmittance;
        assert_eq!(name, Some(Transmittance::Products), "{format}");
    }
}

#[test]
fn where_answers_do_not_tell_nothing_is_said() {
    let kernels: [(&str, Opacity, Step); 7] = [
        // An opacity that has lost its digits is the same beside 1 and beside T.
        ("1 − e^(−x), products", subtraction, products),
        ("1 − e^(−x), what remains", subtraction, remainder),
        ("1 less the opacity so far", expm1, opacity_so_far),
        ("rounded to 0", expm1, cut_off),
        ("by turns", expm1, by_turns),
        ("depths from 1 on", expm1, depths_from_one),
        ("depths, opacities by subtraction", subtraction, depths),
    ];
    for (format, round) in ROUNDS {
        for (what, opacity, step) in kernels {
            // Of numbers of other bits it is no rounding to 0.
            if what == "rounded to 0" && format != "f32" {
                continue;
            }
            let found = examined(round, opacity, step);
            assert_eq!(found.found.transmittance, None, "{format} {what}");
        }
    }
}
