//! `Roundoff.v` and `Compositing.v`: the loop does the theorem's operations, and rounds no worse than proved.

use super::theory;
use quickcheck::{Arbitrary, Gen, quickcheck};
use rug::float::Round;
use rug::{Float, Rational};
use volver::case::{Along, Case, Fresh, Structure, Transfer};
use volver::method::{
    Accumulation, Compositing, CompositingOrder, OpacityFormula, Position, Stop, Summation,
};
use volver::real::{Format, Mpfr, Native, Real};

/// C and α of each segment, numbers of binary32 in [0, 1]. With segments of length 1 and the opacity taken
/// to be the depth, α is τ itself.
#[derive(Clone, Debug)]
struct Samples(Vec<(f32, f32)>);

impl Arbitrary for Samples {
    fn arbitrary(g: &mut Gen) -> Self {
        // Of every size down to 2⁻³⁰, 0 and 1 among them.
        let unit = |g: &mut Gen| {
            let mantissa = u32::arbitrary(g) >> 8;
            let size = i32::from(u8::arbitrary(g) % 8);
            match u8::arbitrary(g) % 16 {
                0 => 0.0,
                1 => 1.0,
                _ => mantissa as f32 * 2_f32.powi(-24 - size),
            }
        };
        let count = 1 + usize::arbitrary(g) % 200;
        Samples((0..count).map(|_| (unit(g), unit(g))).collect())
    }

    fn shrink(&self) -> Box<dyn Iterator<Item = Self>> {
        let shorter = self.0.shrink().filter(|samples| !samples.is_empty());
        Box::new(shorter.map(Samples))
    }
}

impl Case for Samples {
    fn name(&self) -> &'static str {
        "samples"
    }

    fn length(&self) -> Rational {
        Rational::from(self.0.len())
    }

    fn field<R: Real>(&self, lambda: &R) -> R {
        lambda.clone()
    }

    fn transfer<R: Real>(&self, s: &R) -> Transfer<R> {
        // Segments are sampled in their middles.
        let index = s.to_float().to_u32_saturating_round(Round::Down).unwrap() as usize;
        let exact = |x: f32| s.format().ratio(&Rational::from_f32(x).unwrap());
        let (emission, alpha) = self.0[index];
        Transfer {
            emission: exact(emission),
            extinction: exact(alpha),
        }
    }

    fn optical_depth<R: Real>(&self, _lambda: &R) -> Option<R> {
        None
    }

    fn radiance<R: Real>(&self, _lambda: &R) -> Option<R> {
        None
    }

    fn structure(&self) -> Structure {
        Structure {
            field_degree: Some(1),
            transfer: None,
            along: Along::default(),
            breaks: Vec::new(),
        }
    }
}

fn compositing(order: CompositingOrder) -> Compositing {
    Compositing {
        position: Position::Middle,
        opacity: OpacityFormula::Linear,
        order,
    }
}

const FRONT_TO_BACK: CompositingOrder = CompositingOrder::FrontToBack {
    depth: Accumulation::Transmittances,
    summation: Summation::Naive,
    stop: None,
};

/// I and T behind all segments, by the program.
fn composited<F: Format>(samples: &Samples, format: F) -> (F::Real, F::Real) {
    // T stands in front of each segment: one more, that emits nothing, shows the last.
    let mut longer = samples.clone();
    longer.0.push((0.0, 0.0));
    let n = longer.0.len() as u64;
    let composite = compositing(FRONT_TO_BACK)
        .composite(&Fresh::new(&longer, format), n, Stop::Never)
        .unwrap();
    let behind = composite.transmittances.last().unwrap().clone();
    (composite.radiance, behind)
}

/// I and T without any rounding, as `accumulate` in `Compositing.v` has them.
fn exact(samples: &Samples) -> (Rational, Rational) {
    let of = |x: &f32| Rational::from_f32(*x).unwrap();
    let mut radiance = Rational::new();
    let mut transmittance = Rational::from(1);
    for (emission, alpha) in &samples.0 {
        radiance += of(emission) * of(alpha) * &transmittance;
        transmittance *= Rational::from(1) - of(alpha);
    }
    (radiance, transmittance)
}

#[test]
fn the_formula_is_the_theorems() {
    let theory = theory("Roundoff.v");
    for part in [
        "(rnd (accumulated so_far + rnd (rnd (emission next * alpha next) * transmitted so_far)))",
        "(rnd (transmitted so_far * rnd (1 - alpha next))).",
        "<= INR (length samples) * / 2 ^ 22.",
        "<= INR (length samples) * / 2 ^ 51.",
    ] {
        assert!(theory.contains(part), "{part}");
    }
}

quickcheck! {
    fn the_loop_is_the_formula_of_the_theorem_bit_for_bit(samples: Samples) -> bool {
        let (mut single, mut double) = ((0.0_f32, 1.0_f32), (0.0_f64, 1.0_f64));
        for &(c, a) in &samples.0 {
            // The processor rounds each operation once, to nearest even.
            single.0 += (c * a) * single.1;
            single.1 *= 1.0 - a;
            let (c, a) = (f64::from(c), f64::from(a));
            double.0 += (c * a) * double.1;
            double.1 *= 1.0 - a;
        }
        let by_program = composited(&samples, Native::<f32>::new());
        let bits = |(i, t): (f32, f32)| (i.to_bits(), t.to_bits());
        let same = bits(by_program) == bits(single);
        let by_program = composited(&samples, Native::<f64>::new());
        let bits = |(i, t): (f64, f64)| (i.to_bits(), t.to_bits());
        same && bits(by_program) == bits(double)
    }

    fn rounding_stays_below_the_proved_bound(samples: Samples) -> bool {
        let truth = exact(&samples);
        let lost = |(i, t): (Rational, Rational)| {
            Rational::from(&i - &truth.0).abs() + Rational::from(&t - &truth.1).abs()
        };
        let rational = |x: f64| Rational::from_f64(x).unwrap();
        let (i, t) = composited(&samples, Native::<f32>::new());
        let single = lost((rational(i.into()), rational(t.into())));
        let (i, t) = composited(&samples, Native::<f64>::new());
        let double = lost((rational(i), rational(t)));
        let n = Rational::from(samples.0.len());
        single <= Rational::from(&n >> 22) && double <= n >> 51
    }

    fn front_to_back_back_to_front_and_trees_agree(samples: Samples) -> bool {
        let format = Mpfr { bits: 2000 };
        let n = samples.0.len() as u64;
        let nodes = Fresh::new(&samples, format);
        let orders = [FRONT_TO_BACK, CompositingOrder::BackToFront, CompositingOrder::Tree];
        orders.into_iter().all(|order| {
            let radiance: Float = compositing(order).radiance(&nodes, n).unwrap().into();
            // What 2,000 bits round off 200 segments is no difference of formulas.
            (radiance - &exact(&samples).0).abs() < 1e-300
        })
    }

    fn early_termination_leaves_out_no_more_than_proved(samples: Samples, kept: u8) -> bool {
        let n = samples.0.len() as u64;
        let kept = usize::from(kept) % (samples.0.len() + 1);
        let front = Samples(samples.0[..kept].to_vec());
        let nodes = Fresh::new(&samples, Mpfr { bits: 2000 });
        let stopped = compositing(FRONT_TO_BACK)
            .composite(&nodes, n, Stop::After(kept as u64))
            .unwrap();
        let stopped: Float = stopped.radiance.into();
        let brightest = samples.0.iter().fold(0.0_f32, |most, (c, _)| most.max(*c));
        let left_out = Float::with_val(2000, &exact(&samples).0) - stopped;
        let most = exact(&front).1 * Rational::from_f32(brightest).unwrap();
        left_out >= -1e-300 && left_out <= Float::with_val(2000, most) + 1e-300
    }
}

/// The bound is not idle: a thousand segments lose more than a hundredth of it.
#[test]
fn rounding_comes_near_its_bound() {
    let third = 1.0 / 3.0;
    let samples = Samples(vec![(third, 1e-3); 1000]);
    let (radiance, transmittance) = exact(&samples);
    let (i, t) = composited(&samples, Native::<f32>::new());
    let lost = |x: f32, exact: &Rational| (f64::from(x) - exact.to_f64()).abs();
    let lost = lost(i, &radiance) + lost(t, &transmittance);
    assert!(lost > 0.01 * 1000.0 / 4_194_304.0, "{lost:e}");
}
