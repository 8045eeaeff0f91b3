//! Chebyshev series of enclosed values.

use crate::symbolic::Interval;
use rug::Float;

/// cos(πk/n) and the weights of Clenshaw and Curtis for one n = 2ᵐ ≥ 8.
#[derive(Debug)]
pub struct Points {
    bits: u32,
    cosines: Vec<Interval>,
    weights: Vec<Interval>,
}

type Complex = (Interval, Interval);

impl Points {
    /// For n = 2ᵐ ≥ 8 in so many bits.
    #[must_use]
    pub fn new(n: usize, bits: u32) -> Points {
        let integer = |k: usize| Interval::exactly(&Float::with_val(bits.max(64), k));
        let pi = Interval::pi(bits);
        let divisor = integer(n);
        let mut cosines: Vec<Interval> = Vec::with_capacity(n + 1);
        for k in 0..=n {
            let known = match 2 * k {
                0 => Interval::exactly(&Float::with_val(bits, 1)),
                twice if twice == n => Interval::exactly(&Float::new(bits)),
                twice if twice > n => -&cosines[n - k],
                // n is not 0.
                _ => match (&pi * &integer(k)).divide(&divisor) {
                    Ok(angle) => angle.cos().to_bits(bits),
                    Err(_) => Interval::entire(bits),
                },
            };
            cosines.push(known);
        }
        let mut points = Points {
            bits,
            cosines,
            weights: Vec::new(),
        };
        let moments: Vec<Interval> = (0..=n)
            .map(|j| {
                if j % 2 == 1 {
                    return Interval::exactly(&Float::new(bits));
                }
                // 1 − j² is not 0 for any even j.
                let divisor = &integer(1) - &integer(j * j);
                let moment = integer(2).divide(&divisor);
                moment.unwrap_or_else(|_| Interval::entire(bits))
            })
            .collect();
        let scale = Float::with_val(bits, 2) / n as u64;
        let scale = Interval::exactly(&scale);
        let half = Interval::exactly(&Float::with_val(bits, 0.5));
        let sums = points.cosine_sums(&moments);
        let weights = sums.iter().enumerate().map(|(k, sum)| {
            let weight = sum * &scale;
            if k == 0 || k == n {
                &weight * &half
            } else {
                weight
            }
        });
        points.weights = weights.collect();
        points
    }

    fn degree(&self) -> usize {
        self.cosines.len() - 1
    }

    /// cos(πk/n), k = 0 … n, falling from 1 to −1.
    #[must_use]
    pub fn cosines(&self) -> &[Interval] {
        &self.cosines
    }

    /// The integral over [−1, 1] of the polynomial that has these values at the points.
    #[must_use]
    pub fn integral(&self, values: &[Interval]) -> Interval {
        let mut sum = Interval::exactly(&Float::new(self.bits));
        for (weight, value) in self.weights.iter().zip(values) {
            sum = &sum + &(weight * value);
        }
        sum
    }

    /// The integral from −1 to each of the points of the polynomial that has these values there.
    #[must_use]
    pub fn integrals(&self, values: &[Interval]) -> Vec<Interval> {
        let n = self.degree();
        let bits = self.bits;
        let scale = Float::with_val(bits, 2) / n as u64;
        let scale = Interval::exactly(&scale);
        let half = Interval::exactly(&Float::with_val(bits, 0.5));
        let mut series: Vec<Interval> = self.cosine_sums(values);
        for (j, coefficient) in series.iter_mut().enumerate() {
            *coefficient = &*coefficient * &scale;
            if j == n {
                *coefficient = &*coefficient * &half;
            }
        }
        // With a₀ twice what the series has: bⱼ = (aⱼ₋₁ − aⱼ₊₁)/2j.
        let zero = Interval::exactly(&Float::new(bits));
        let mut integral = vec![zero.clone()];
        for j in 1..=n + 1 {
            let below = &series[j - 1];
            let above = series.get(j + 1).unwrap_or(&zero);
            let divisor = Interval::exactly(&Float::with_val(bits.max(64), 2 * j));
            let quotient = (below - above).divide(&divisor);
            integral.push(quotient.unwrap_or_else(|_| Interval::entire(bits)));
        }
        // At the points T of n + 1 is that of n − 1.
        if let Some(last) = integral.pop() {
            integral[n - 1] = &integral[n - 1] + &last;
        }
        // The sums take the last by half.
        integral[n] = &integral[n] + &integral[n];
        let values = self.cosine_sums(&integral);
        let start = values[n].clone();
        values.iter().map(|value| value - &start).collect()
    }

    /// Sⱼ = v₀/2 + Σ vₖ cos(πjk/n) + (−1)ʲ vₙ/2, as the estimate has it.
    fn cosine_sums(&self, values: &[Interval]) -> Vec<Interval> {
        let n = self.degree();
        let half = Interval::exactly(&Float::with_val(self.bits, 0.5));
        let mut odd = &(&values[0] - &values[n]) * &half;
        let (mut real, mut imaginary) = (Vec::with_capacity(n / 2), Vec::with_capacity(n / 2));
        for k in 0..n {
            let (value, mirrored) = (&values[k], &values[n - k]);
            let mut folded = &(value + mirrored) * &half;
            if k > 0 {
                let difference = value - mirrored;
                folded = &folded - &(self.sine(k, n) * &difference);
                if 2 * k < n {
                    odd = &odd + &(self.cosine(k, n) * &difference);
                }
            }
            if k % 2 == 0 {
                real.push(folded);
            } else {
                imaginary.push(folded);
            }
        }
        let mut parts: Vec<Complex> = real.into_iter().zip(imaginary).collect();
        self.fourier(&mut parts);
        let mut sums = Vec::with_capacity(n + 1);
        for k in 0..=n / 2 {
            let (re, im) = self.of_real_numbers(&parts, k);
            if k > 0 {
                odd = &odd + &im;
            }
            sums.push(re);
            if 2 * k < n {
                sums.push(odd.clone());
            }
        }
        sums
    }

    fn cosine(&self, k: usize, n: usize) -> &Interval {
        &self.cosines[k * (self.degree() / n)]
    }

    fn sine(&self, k: usize, n: usize) -> &Interval {
        let quarter = self.degree() / 2;
        &self.cosines[(k * (self.degree() / n)).abs_diff(quarter)]
    }

    fn fourier(&self, parts: &mut [Complex]) {
        let count = parts.len();
        let digits = count.trailing_zeros();
        for k in 0..count {
            let mirrored = k.reverse_bits() >> (usize::BITS - digits);
            if k < mirrored {
                parts.swap(k, mirrored);
            }
        }
        let mut half = 1;
        while half < count {
            for start in (0..count).step_by(2 * half) {
                for k in 0..half {
                    let turned = self.turned(&parts[start + k + half], k, half);
                    let low = &parts[start + k];
                    let sum = (&low.0 + &turned.0, &low.1 + &turned.1);
                    let difference = (&low.0 - &turned.0, &low.1 - &turned.1);
                    parts[start + k] = sum;
                    parts[start + k + half] = difference;
                }
            }
            half *= 2;
        }
    }

    /// x e^(iπk/half).
    fn turned(&self, (re, im): &Complex, k: usize, half: usize) -> Complex {
        if k == 0 {
            return (re.clone(), im.clone());
        }
        if 2 * k == half {
            return (-im, re.clone());
        }
        let (cos, sin) = (self.cosine(k, half), self.sine(k, half));
        (&(re * cos) - &(im * sin), &(im * cos) + &(re * sin))
    }

    /// Aₖ of n real numbers from the transform of f₂ⱼ + i f₂ⱼ₊₁.
    fn of_real_numbers(&self, parts: &[Complex], k: usize) -> Complex {
        let m = parts.len();
        let (a, b) = (&parts[k % m], &parts[(m - k) % m]);
        let half = Interval::exactly(&Float::with_val(self.bits, 0.5));
        let by_half = |x: Interval| &x * &half;
        let even = (by_half(&a.0 + &b.0), by_half(&a.1 - &b.1));
        let odd = (by_half(&a.1 + &b.1), by_half(&b.0 - &a.0));
        let (cos, sin) = (self.cosine(k, m), self.sine(k, m));
        (
            &even.0 + &(&(&odd.0 * cos) - &(&odd.1 * sin)),
            &even.1 + &(&(&odd.0 * sin) + &(&odd.1 * cos)),
        )
    }
}
