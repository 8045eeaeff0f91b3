//! A ray marcher, as a renderer may have it: it knows nothing of volver.

/// Emission and extinction of a stretch of the ray, and how long it is.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// C, what one unit of opacity shines.
    pub emission: f64,
    /// τ, the opacity of a short stretch per unit of length.
    pub extinction: f64,
    /// The length of the stretch.
    pub length: f64,
}

/// The radiance at the front of a ray, from samples front to back.
pub fn march(samples: impl IntoIterator<Item = Sample>) -> f64 {
    let (mut radiance, mut transmittance) = (0.0, 1.0);
    for sample in samples {
        let opacity = -(-sample.extinction * sample.length).exp_m1();
        radiance += transmittance * opacity * sample.emission;
        transmittance *= 1.0 - opacity;
    }
    radiance
}
