//! Random scenes: mixed media, kinks, jumps, empty space, thin and thick.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::fmt::Write;

/// A generator of scenes, the same for the same seed.
pub(crate) struct Generator(Pcg64Mcg);

impl Generator {
    pub(crate) fn new(seed: u64) -> Self {
        Generator(Pcg64Mcg::seed_from_u64(seed))
    }

    /// Between 0 and 1.
    fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * (-53_f64).exp2()
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn below(&mut self, n: usize) -> usize {
        usize::try_from(self.0.next_u64() % n as u64).unwrap()
    }

    /// The text of a scene, of an optical depth between 1e-6 and 50.
    pub(crate) fn scene(&mut self, channels: usize, background: bool) -> String {
        let media = 1 + self.below(12);
        let thickness = 10_f64.powf(self.between(-6.0, 50_f64.log10()));
        let shares: Vec<f64> = (0..media).map(|_| self.unit().powi(2) + 0.01).collect();
        let total: f64 = shares.iter().sum();
        let mut text = String::new();
        if channels == 3 {
            text += "channels = [\"r\", \"g\", \"b\"]\n";
        }
        if background {
            writeln!(text, "background = {:.3}", self.unit()).unwrap();
        }
        let mut from = 0;
        for share in shares {
            // Places are thousandths, so that they are exact decimals.
            let to = from + 50 + self.below(950);
            let depth = thickness * share / total;
            self.medium(&mut text, from, to, depth, channels);
            from = to;
        }
        text
    }

    fn medium(&mut self, text: &mut String, from: usize, to: usize, depth: f64, channels: usize) {
        let (a, b) = (from as f64 / 1000.0, to as f64 / 1000.0);
        let length = b - a;
        let mean = depth / length;
        writeln!(
            text,
            "[[media]]\nfrom = \"{from}/1000\"\nto = \"{to}/1000\""
        )
        .unwrap();
        match self.below(10) {
            0 | 1 => text.push_str("kind = \"vacuum\"\n"),
            2 | 3 => {
                writeln!(text, "kind = \"constant\"\nextinction = \"{mean:e}\"").unwrap();
                let emission = self.numbers(channels);
                writeln!(text, "emission = {emission}").unwrap();
            }
            4 => {
                let front = mean * self.between(0.0, 2.0);
                let back = 2.0 * mean - front;
                let (near, far) = (self.numbers(channels), self.numbers(channels));
                writeln!(text, "kind = \"linear\"").unwrap();
                writeln!(
                    text,
                    "extinction = {{front = \"{front:e}\", back = \"{back:e}\"}}"
                )
                .unwrap();
                writeln!(text, "emission = {{front = {near}, back = {far}}}").unwrap();
            }
            5..=8 => {
                let shape = self.shape(a, b);
                writeln!(text, "kind = \"expression\"").unwrap();
                writeln!(text, "extinction = \"{mean:e}*({shape})\"").unwrap();
                let emission: Vec<String> = (0..channels)
                    .map(|_| format!("\"{}\"", self.emission(a, b)))
                    .collect();
                writeln!(text, "emission = [{}]", emission.join(", ")).unwrap();
            }
            _ => {
                let count = 2 + self.below(30);
                let samples: Vec<String> =
                    (0..count).map(|_| format!("{:.3}", self.unit())).collect();
                writeln!(
                    text,
                    "kind = \"sampled\"\nsamples = [{}]",
                    samples.join(", ")
                )
                .unwrap();
                if self.below(3) == 0 {
                    text.push_str("interpolation = \"nearest\"\n");
                }
                writeln!(text, "extinction = \"{:e}*s\"", 2.0 * mean).unwrap();
                let emission: Vec<String> = (0..channels)
                    .map(|_| {
                        format!(
                            "\"{:.3} + {:.3}*(1 - s)\"",
                            self.between(0.0, 0.5),
                            self.between(0.0, 0.5)
                        )
                    })
                    .collect();
                writeln!(text, "emission = [{}]", emission.join(", ")).unwrap();
            }
        }
    }

    fn numbers(&mut self, channels: usize) -> String {
        let all: Vec<String> = (0..channels)
            .map(|_| format!("{:.3}", self.unit()))
            .collect();
        format!("[{}]", all.join(", "))
    }

    /// Of a mean of about 1, not negative.
    fn shape(&mut self, a: f64, b: f64) -> String {
        let place = self.between(a, b);
        let length = b - a;
        let waves = self.between(0.5, 15.0) / length;
        let width = length * self.between(0.03, 0.5);
        let phase = self.between(0.0, 6.0);
        let amplitude = self.between(0.1, 0.99);
        match self.below(10) {
            0 => format!("1 + {amplitude:.3}*sin({waves:.3}*lambda + {phase:.3})"),
            1 => format!("1.5*exp(-((lambda - {place:.4})/{width:.4})^2)"),
            2 => format!("1/(1 + ((lambda - {place:.4})/{width:.4})^2)"),
            3 => format!("3*((lambda - {a:.3})/{length:.4})^2"),
            4 => format!("0.1 + exp(-{waves:.3}*(lambda - {a:.3}))"),
            5 => format!("2*abs(lambda - {place:.4})/{length:.4}"),
            6 => format!("max(0.2, 1 + sin({waves:.3}*lambda + {phase:.3}))"),
            7 => format!("piecewise(lambda < {place:.4}, 0.3, 1.7)"),
            8 => format!(
                "piecewise(lambda < {place:.4}, 0, 1 + {amplitude:.3}*cos({waves:.3}*lambda))"
            ),
            _ => format!("1 + tanh((lambda - {place:.4})/{width:.4})"),
        }
    }

    fn emission(&mut self, a: f64, b: f64) -> String {
        let place = self.between(a, b);
        let length = b - a;
        let waves = self.between(0.5, 10.0) / length;
        let level = self.between(0.0, 1.0);
        match self.below(6) {
            0 => "0".into(),
            1 => format!("{level:.3}"),
            2 => format!("{level:.3}*(1 + sin({waves:.3}*lambda))/2"),
            3 => format!("{level:.3}*(lambda - {a:.3})/{length:.4}"),
            4 => format!("piecewise(lambda < {place:.4}, {level:.3}, 0.1)"),
            _ => format!("{level:.3}*exp(-lambda/5)"),
        }
    }
}
