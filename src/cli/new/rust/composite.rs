//! The light of one ray through a volume: put your renderer's loop in place of [`composite`].

/// Front to back over one sample a segment, `ends` being the n + 1 ends of the segments: the radiance of one channel.
pub fn composite(ends: &[f64], extinction: &[f64], emission: &[f64]) -> f64 {
    let (mut radiance, mut transmittance) = (0.0, 1.0);
    for ((ends, tau), color) in ends.windows(2).zip(extinction).zip(emission) {
        let passes = (-tau * (ends[1] - ends[0])).exp();
        radiance += transmittance * (1.0 - passes) * color;
        transmittance *= passes;
    }
    radiance
}

#[cfg(test)]
mod tests {
    use super::composite;

    #[test]
    fn a_homogeneous_ray_is_exact() {
        let radiance = composite(&[0.0, 0.5, 1.25, 2.0], &[0.75; 3], &[3.0; 3]);
        assert!((radiance - 3.0 * (1.0 - (-1.5_f64).exp())).abs() < 1e-14);
    }

    #[test]
    fn the_error_falls_with_the_second_power_of_the_step() {
        // The depth is x², and the emission too: the integral of t e^(−t) up to 1.
        let exact = 1.0 - 2.0 / 1_f64.exp();
        let error = |n: u32| {
            let ends: Vec<f64> = (0..=n).map(|i| f64::from(i) / f64::from(n)).collect();
            let middles = (0..n).map(|i| (f64::from(i) + 0.5) / f64::from(n));
            let (extinction, emission): (Vec<f64>, Vec<f64>) =
                middles.map(|x| (2.0 * x, x * x)).unzip();
            (composite(&ends, &extinction, &emission) - exact).abs()
        };
        let order = (error(64) / error(128)).log2();
        assert!((order - 2.0).abs() < 0.05, "{order}");
    }
}
