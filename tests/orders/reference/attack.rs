//! Random media with narrow layers, kinks, jumps, roots, waves and any brightness, and their radiance by another route:
//! a closed form of each term, never the program's own integration.

use super::{bits, distance, medium};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;
use rug::Float;
use rug::float::Constant;
use std::fmt::Write;
use volver::reference::radiance;

/// Bits of the truth: terms with narrow layers lose some.
const BITS: u32 = 600;
const DIGITS: u32 = 30;

struct Random(Pcg64);

impl Random {
    /// Between two numbers, to 6 digits, so that it is written as it is.
    fn between(&mut self, low: f64, high: f64) -> String {
        let part = (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        format!("{:.6}", low + part * (high - low))
    }

    /// 10 to a power between two.
    fn power(&mut self, low: f64, high: f64) -> String {
        let mantissa = self.between(1.0, 10.0);
        let exponent: f64 = self.between(low, high).parse().unwrap();
        format!("{mantissa}e{}", exponent.floor())
    }

    fn one_of(&mut self, count: u64) -> u64 {
        self.0.next_u64() % count
    }
}

fn number(text: &str) -> Float {
    // As a rational: the program reads decimal numbers exactly.
    let exact = volver::symbolic::parse_number(text).unwrap();
    Float::with_val(BITS, exact)
}

fn one() -> Float {
    Float::with_val(BITS, 1)
}

/// A term of τ on [0, 1] and its integral.
fn extinction(random: &mut Random) -> (String, Float) {
    let c = random.between(0.02, 0.98);
    let w = random.power(-9.0, -1.0);
    let height = random.power(-3.0, 5.0);
    let (place, width, top) = (number(&c), number(&w), number(&height));
    let near = Float::with_val(BITS, &place / &width);
    let far = (one() - &place) / &width;
    let weight = Float::with_val(BITS, &top * &width);
    let layer = format!("(s - {c})/({w})");
    match random.one_of(9) {
        0 => {
            let half = Float::with_val(BITS, Constant::Pi).sqrt() / 2_u32;
            let all = far.erf() + near.erf();
            (format!("({height})*exp(-({layer})^2)"), weight * half * all)
        }
        1 => {
            let all = far.atan() + near.atan();
            (format!("({height})/(1 + ({layer})^2)"), weight * all)
        }
        2 => {
            let all = far.tanh() + near.tanh();
            (format!("({height})*(1 - tanh({layer})^2)"), weight * all)
        }
        3 => {
            // ln cosh x = x + ln((1 + e^(−2x))/2).
            let ln_cosh = |x: Float| {
                let rest = Float::with_val(BITS, -2_i32 * &x).exp().ln_1p();
                x + rest - Float::with_val(BITS, Constant::Log2)
            };
            let all = one() + width * (ln_cosh(far) - ln_cosh(near));
            (format!("({height})*(1 + tanh({layer}))"), top * all)
        }
        4 => {
            let rest = one() - &place;
            let all = (place.square() + rest.square()) / 2_u32;
            (format!("({height})*abs(s - {c})"), top * all)
        }
        5 => (format!("({height})*sqrt(s)"), top * 2_u32 / 3_u32),
        6 => {
            let wave = random.power(0.0, 2.0);
            let omega = number(&wave);
            let all = one() + (1 - Float::with_val(BITS, omega.cos_ref())) / &omega;
            (format!("({height})*(1 + sin(({wave})*s))"), top * all)
        }
        7 => {
            let other = random.power(-3.0, 2.0);
            let rest = (one() - &place) * number(&other);
            (
                format!("piecewise(s < {c}, {height}, {other})"),
                top * place + rest,
            )
        }
        _ => {
            // The area under a triangle of that height and half-width, well within.
            let shape = format!("max(0, {height} - ({height})*abs(s - 1/2)/({w}))");
            let width = if width > 0.5 {
                Float::with_val(BITS, 0.5)
            } else {
                width
            };
            (shape, top * width)
        }
    }
}

/// τ of a few terms and C = a + b e^(−t) as far as t has a closed form: τ constant, C of layers.
fn thin_light(random: &mut Random) -> (String, String, Float) {
    let k = random.power(-3.0, 2.0);
    let depth = number(&k);
    let mut emission = String::from("1");
    let mut light = -Float::with_val(BITS, -&depth).exp_m1();
    for _ in 0..=random.one_of(3) {
        let (c, w) = (random.between(0.05, 0.95), random.power(-9.0, -2.0));
        let height = random.power(-2.0, 5.0);
        let (place, width) = (number(&c), number(&w));
        write!(emission, " + ({height})*exp(-((s - {c})/({w}))^2)").unwrap();
        // ∫ k e^(−ks) e^(−((s − c)/w)²) = k w √π/2 e^(k²w²/4 − kc) (erf((1 − c)/w + kw/2) + erf(c/w − kw/2)).
        let half = Float::with_val(BITS, &depth * &width) / 2_u32;
        let ends = ((one() - &place) / &width + &half).erf()
            + (Float::with_val(BITS, &place / &width) - &half).erf();
        let shift = (half.square() - Float::with_val(BITS, &depth * &place)).exp();
        let root = Float::with_val(BITS, Constant::Pi).sqrt() / 2_u32;
        light += number(&height) * &depth * width * root * shift * ends;
    }
    (k, emission, light)
}

/// τ of a few terms and C = c: I = c (1 − e^(−t)).
fn thin_extinction(random: &mut Random) -> (String, String, Float) {
    let mut formula = random.power(-6.0, 0.0);
    let mut depth = number(&formula);
    for _ in 0..=random.one_of(3) {
        let (term, integral) = extinction(random);
        write!(formula, " + {term}").unwrap();
        depth += integral;
    }
    let c = random.power(-3.0, 3.0);
    let light = number(&c) * -(-depth).exp_m1();
    (formula, c, light)
}

/// How many of `count` media are enclosed; every one has to have its digits.
fn attacked(count: u64, seed: u64) -> usize {
    let enclosed = (0..count).into_par_iter().filter(|&i| {
        let mut random = Random(Pcg64::seed_from_u64(seed + i));
        let (extinction, emission, exact) = if i % 2 == 0 {
            thin_light(&mut random)
        } else {
            thin_extinction(&mut random)
        };
        let case = medium(&extinction, &emission);
        let Ok(found) = radiance(&case, bits(DIGITS)) else {
            return false;
        };
        let error = distance(&found.value, &exact);
        let what = format!(
            "tau = {extinction}\nC = {emission}\n{} for {exact}",
            found.value
        );
        assert!(error <= found.error || !found.is_enclosed(), "{what}");
        assert!(
            found.digits().is_none_or(|digits| digits >= DIGITS),
            "{what}"
        );
        found.is_enclosed()
    });
    enclosed.count()
}

#[test]
fn no_digit_of_random_media_is_wrong() {
    let count = 40;
    assert!(attacked(count, 1) as f64 >= 0.95 * count as f64);
}

#[test]
#[ignore = "minutes; the 40 above are of the same kind"]
fn attack_2000_media() {
    let count = 2000;
    let enclosed = attacked(count, 1000);
    println!("{count} media, {enclosed} enclosed, no digit wrong");
    assert!(enclosed as f64 >= 0.95 * count as f64);
}
