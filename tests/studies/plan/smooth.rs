//! Random smooth scenes: narrow bumps, long tails, steep exponentials. Nothing is refused, and what is planned is right:
//! the truth comes from Simpson's rule on steps much shorter than anything that happens, with closures in place of
//! expressions.

use super::{error, plan, read};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use volver::study::plan::Plan;

type Function = Box<dyn Fn(f64) -> f64>;

/// A function, as an expression of lambda and as code.
struct Both {
    text: String,
    code: Function,
}

impl Both {
    fn new(text: String, code: impl Fn(f64) -> f64 + 'static) -> Both {
        let code = Box::new(code);
        Both { text, code }
    }
}

/// One medium on 0 … 1.
struct Smooth {
    extinction: Both,
    emission: Both,
}

struct Generator(Pcg64Mcg);

impl Generator {
    fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * (-53_f64).exp2()
    }

    /// With four digits, so that text and code have the same number.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        let x = low + (high - low) * self.unit();
        format!("{x:.3e}").parse().unwrap()
    }

    /// Likewise, evenly in the logarithm.
    fn of_magnitude(&mut self, low: f64, high: f64) -> f64 {
        let x = (low.ln() + (high / low).ln() * self.unit()).exp();
        format!("{x:.3e}").parse().unwrap()
    }

    fn function(&mut self, scale: f64) -> Both {
        let a = self.of_magnitude(scale / 100.0, scale);
        let m = self.between(-0.2, 1.2);
        let w = self.of_magnitude(3e-3, 1.0);
        let k = self.of_magnitude(0.3, 300.0);
        match self.0.next_u64() % 8 {
            0 | 1 => Both::new(
                format!("{a:e}*exp(-((lambda - ({m:e}))/{w:e})^2)"),
                move |x| a * (-((x - m) / w).powi(2)).exp(),
            ),
            2 => Both::new(format!("{a:e}*exp(-{k:e}*lambda)"), move |x| {
                a * (-k * x).exp()
            }),
            3 => Both::new(format!("{a:e}*exp({k:e}*(lambda - 1))"), move |x| {
                a * (k * (x - 1.0)).exp()
            }),
            4 => Both::new(
                format!("{a:e}/(1 + ((lambda - ({m:e}))/{w:e})^2)"),
                move |x| a / (1.0 + ((x - m) / w).powi(2)),
            ),
            5 => {
                let k = k.min(50.0);
                Both::new(format!("{a:e}*(1 + sin({k:e}*lambda))"), move |x| {
                    a * (1.0 + (k * x).sin())
                })
            }
            6 => Both::new(
                format!("{a:e}*(1 + tanh((lambda - ({m:e}))/{w:e}))"),
                move |x| a * (1.0 + ((x - m) / w).tanh()),
            ),
            _ => Both::new(
                format!("{a:e}/(1 + exp(-(lambda - ({m:e}))/{w:e}))"),
                move |x| a / (1.0 + (-(x - m) / w).exp()),
            ),
        }
    }
}

impl Smooth {
    fn new(seed: u64) -> Smooth {
        let mut random = Generator(Pcg64Mcg::seed_from_u64(seed));
        let thickness = random.of_magnitude(0.1, 30.0);
        Smooth {
            extinction: random.function(thickness),
            emission: random.function(1.0),
        }
    }

    fn text(&self) -> String {
        format!(
            "[[media]]\nfrom = 0\nto = 1\nkind = \"expression\"\nextinction = \"{}\"\nemission = \"{}\"\n",
            self.extinction.text, self.emission.text
        )
    }

    /// ∫ C τ e^(−t), t being the integral of the same parabolas.
    fn radiance(&self) -> f64 {
        const STEPS: u32 = 60_000;
        let h = 1.0 / f64::from(STEPS);
        let (mut depth, mut light) = (0.0_f64, 0.0_f64);
        // τ and C at both ends and in the middle of a step: all that it asks for.
        let at = |x: f64| ((self.extinction.code)(x), (self.emission.code)(x));
        let mut front = at(0.0);
        for step in 0..STEPS {
            let x = f64::from(step) * h;
            let (middle, back) = (at(x + h / 2.0), at(x + h));
            // Simpson's rule for t, and for I with t by the same parabola.
            let half = h / 24.0 * (5.0 * front.0 + 8.0 * middle.0 - back.0);
            let whole = h / 6.0 * (front.0 + 4.0 * middle.0 + back.0);
            let seen = |(tau, c): (f64, f64), more: f64| c * tau * (-(depth + more)).exp();
            light += h / 6.0 * (seen(front, 0.0) + 4.0 * seen(middle, half) + seen(back, whole));
            depth += whole;
            front = back;
        }
        light
    }
}

/// The largest error of what the steps above give for the scenes below.
const OF_THE_TRUTH: f64 = 1e-8;

fn right(seeds: std::ops::Range<u64>) {
    let wrong: Vec<String> = seeds
        .into_par_iter()
        .filter_map(|seed| {
            let scene = Smooth::new(seed);
            let text = scene.text();
            let read = read(&text);
            let exact = scene.radiance();
            let wrong = [1e-2, 1e-5].into_iter().find_map(|tolerance| {
                let plan = match Plan::for_scene(&read, tolerance) {
                    Ok(plan) => plan,
                    Err(error) => return Some(error.to_string()),
                };
                let found = match plan.run::<f64>() {
                    Ok(rendered) => rendered.radiance[0],
                    Err(error) => return Some(error.to_string()),
                };
                let off = (found - exact).abs();
                (off.is_nan() || off > tolerance + OF_THE_TRUTH)
                    .then(|| format!("{found} for {exact} at {tolerance:e}"))
            });
            wrong.map(|wrong| format!("seed {seed}: {wrong}\n{text}"))
        })
        .collect();
    assert!(
        wrong.is_empty(),
        "{} scenes:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}

#[test]
fn no_smooth_scene_is_refused_and_all_are_right() {
    right(0..400);
}

/// Its emission is below the least binary64 number on most of the ray.
#[test]
fn a_bump_much_narrower_than_the_ray_is_planned() {
    let text = "[[media]]\nfrom = 0\nto = 1\nkind = 'expression'\nextinction = 'exp(-lambda)'\n\
                emission = 'exp(-((lambda-0.3)/1e-2)^2)'\n";
    let scene = read(text);
    // ∫ C τ T with T = exp(e^(−λ) − 1), by mpmath 1.3 at 30 digits.
    for tolerance in [1e-2, 1e-4, 1e-8] {
        let mut plan = plan(&scene, tolerance, text);
        assert!(error(&mut plan) <= tolerance);
    }
}
