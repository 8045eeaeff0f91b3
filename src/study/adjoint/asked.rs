//! Asking for entries, and for both sides of the identity.

use super::rays::{Made, Projected};
use super::{Broken, OfRay, Product, ROUNDINGS, Vectors};
use crate::identify::random::Random;
use crate::kernel::{Gradient, InnerProduct, Kernel, KernelError, Quantity, Rendering};
use crate::study::gradient::Places;
use rug::Float;

/// A kernel that is asked.
pub(super) struct Asked<'k> {
    pub(super) kernel: &'k mut dyn Kernel,
    pub(super) places: Places,
    pub(super) product: InnerProduct,
    pub(super) bits: u32,
    pub(super) unit: Float,
    pub(super) broken: Vec<Broken>,
}

impl Asked<'_> {
    /// A x of each of the x, on their rays.
    fn forward(&mut self, asked: &[(&Projected, Vec<f64>)]) -> Result<Vec<Float>, KernelError> {
        let at = self.places.at;
        let made: Vec<_> = asked.iter().map(|(ray, x)| ray.with(at, x)).collect();
        let tasks: Vec<_> = made.iter().map(Made::task).collect();
        let answers = self.kernel.render_all(&tasks).into_iter();
        let depths: Result<Vec<Float>, KernelError> = answers.map(|one| depth(&one?)).collect();
        let depths = depths?;
        self.note(&depths);
        Ok(depths)
    }

    /// Aᵀ y of each of the y, and x that it should not depend on, times the weights of the inner product.
    fn back(
        &mut self,
        asked: &[(&Projected, Vec<f64>, f64)],
    ) -> Result<Vec<Vec<Float>>, KernelError> {
        let at = self.places.at;
        let made: Vec<_> = asked.iter().map(|(ray, x, _)| ray.with(at, x)).collect();
        let cotangents: Vec<[f64; 1]> = asked.iter().map(|(_, _, y)| [*y]).collect();
        let tasks: Vec<_> = made
            .iter()
            .zip(&cotangents)
            .map(|(made, y)| (made.task(), y.as_slice()))
            .collect();
        let answers = self.kernel.gradients_together(&tasks)?;
        let mut all = Vec::new();
        for (answer, (ray, ..)) in answers.into_iter().zip(asked) {
            let (_, gradient) = answer?;
            let row = checked(gradient, self.places, ray)?;
            self.note(&row);
            let weights = ray.lengths.iter();
            let weighted = row.into_iter().zip(weights).map(|(z, length)| {
                let z = Float::with_val(self.bits, z);
                match self.product {
                    InnerProduct::Plain => z,
                    InnerProduct::Lengths => z * length,
                }
            });
            all.push(weighted.collect());
        }
        let (got, wanted) = (all.len(), asked.len());
        if got != wanted {
            return Err(KernelError::Channels { got, wanted });
        }
        Ok(all)
    }

    fn note(&mut self, answers: &[Float]) {
        if !answers.iter().all(Float::is_finite) {
            self.broken.push(Broken::NotFinite);
        }
    }

    /// Whether so many roundings of terms of that size may be what two numbers differ by.
    fn is_near(&self, one: &Float, other: &Float, size: &Float) -> bool {
        let off = Float::with_val(self.bits, one - other).abs();
        off <= Float::with_val(self.bits, size * &self.unit) * ROUNDINGS
    }

    /// A eᵢ and (Aᵀ 1)ᵢ, and whether both are linear.
    pub(super) fn entries(&mut self, ray: &Projected) -> Result<OfRay, KernelError> {
        let count = ray.lengths.len();
        let unit = |i: usize| (0..count).map(|j| if i == j { 1.0 } else { 0.0 }).collect();
        let asked: Vec<(&Projected, Vec<f64>)> = (0..count).map(|i| (ray, unit(i))).collect();
        let forward = self.forward(&asked)?;
        let mut random = Random::new(ray.seed);
        let positive = random.many(count, 0.0, 1.0);
        let signed = zero_mean(&positive);
        let vectors = [vec![0.0; count], positive, signed];
        let asked: Vec<_> = vectors.iter().map(|x| (ray, x.clone())).collect();
        let answers = self.forward(&asked)?;
        for ((x, answer), broken) in
            vectors
                .iter()
                .zip(&answers)
                .zip([Broken::Forward, Broken::Forward, Broken::Signed])
        {
            let (sum, size) = self.dot(&forward, x);
            let is_known = self.broken.contains(&Broken::Forward);
            if !is_known && !self.is_near(answer, &sum, &size) {
                self.broken.push(broken);
            }
        }
        let [zeros, positive, _] = vectors;
        let asked = [(ray, zeros, 1.0), (ray, positive, -2.5)];
        let answers = self.back(&asked)?;
        let (back, other) = match &answers[..] {
            [back, other] => (back.clone(), other),
            _ => return Err(KernelError::NoGradient),
        };
        let is_linear = back.iter().zip(other).all(|(one, other)| {
            let wanted = Float::with_val(self.bits, one * -2.5_f64);
            let size = wanted.clone().abs();
            self.is_near(other, &wanted, &size)
        });
        if !is_linear && !self.broken.contains(&Broken::Back) {
            self.broken.push(Broken::Back);
        }
        let most = forward.iter().chain(&back).map(Float::clone);
        let most = most.fold(Float::new(self.bits), |most, x| most.max(&x.abs()));
        let both = forward.iter().zip(&back).enumerate();
        let differ = both.filter(|(_, (one, other))| !self.is_near(one, other, &most));
        Ok(OfRay {
            segments: ray.segments(),
            differ: differ.map(|(at, _)| at).collect(),
            held_out: ray.held_out,
            forward,
            back,
        })
    }

    /// Σ rᵢ xᵢ, and the same of their sizes.
    fn dot(&self, row: &[Float], x: &[f64]) -> (Float, Float) {
        let (mut sum, mut size) = (Float::new(self.bits), Float::new(self.bits));
        for (r, x) in row.iter().zip(x) {
            let term = Float::with_val(self.bits, r * x);
            size += Float::with_val(self.bits, term.abs_ref());
            sum += term;
        }
        (sum, size)
    }

    /// ⟨A x, y⟩ and ⟨x, Aᵀ y⟩ over all rays, which are asked in one request.
    pub(super) fn products(&mut self, rays: &[Projected]) -> Result<Vec<Product>, KernelError> {
        let mut random = Random::new(227);
        let mut products = Vec::new();
        for vectors in Vectors::ALL {
            let mut many = |low: f64| -> Vec<Vec<f64>> {
                let of = |ray: &Projected| random.many(ray.lengths.len(), low, 1.0);
                rays.iter().map(of).collect()
            };
            let x: Vec<Vec<f64>> = match vectors {
                Vectors::ZeroMean => many(0.0).iter().map(|x| zero_mean(x)).collect(),
                Vectors::Positive | Vectors::Image => many(0.0),
            };
            let others = many(0.0);
            let y: Vec<f64> = match vectors {
                Vectors::Positive => random.many(rays.len(), 0.0, 1.0),
                Vectors::ZeroMean => zero_mean(&random.many(rays.len(), 0.0, 1.0)),
                Vectors::Image => {
                    let asked: Vec<_> = rays.iter().zip(others).collect();
                    let image = self.forward(&asked)?;
                    image.iter().map(Float::to_f64).collect()
                }
            };
            let asked: Vec<_> = rays.iter().zip(x.iter().cloned()).collect();
            let forward = self.forward(&asked)?;
            let asked: Vec<_> = rays
                .iter()
                .zip(x.iter().cloned())
                .zip(&y)
                .map(|((ray, x), y)| (ray, x, *y))
                .collect();
            let back = self.back(&asked)?;
            let (forward, mut size) = self.dot(&forward, &y);
            let mut sum = Float::new(self.bits);
            for (row, x) in back.iter().zip(&x) {
                let (own, terms) = self.dot(row, x);
                sum += own;
                size += terms;
            }
            let agrees = self.is_near(&forward, &sum, &size);
            products.push(Product {
                vectors,
                forward,
                back: sum,
                agrees,
            });
        }
        Ok(products)
    }
}

/// The same numbers without their mean.
fn zero_mean(x: &[f64]) -> Vec<f64> {
    let mean = x.iter().sum::<f64>() / x.len() as f64;
    x.iter().map(|x| x - mean).collect()
}

fn depth(rendering: &Rendering) -> Result<Float, KernelError> {
    let quantity = Quantity::OpticalDepth;
    let given = false;
    let depth = rendering.optical_depth.clone();
    depth.ok_or(KernelError::Answers { quantity, given })
}

/// As many numbers as there are values.
fn checked(gradient: Gradient, places: Places, ray: &Projected) -> Result<Vec<Float>, KernelError> {
    let channels = gradient.emission.len();
    let checked = gradient.checked(places.at, &ray.plain, channels)?;
    Ok(checked.extinction)
}
