//! Gradients: right ones, and what is said of wrong ones.

mod others;

use rug::Float;
use volver::identify::{Budget, GradientFound, gradients};
use volver::kernel::{
    Data, Declaration, Gradient, GradientAt, Kernel, KernelError, Rendering, Samples, Segments,
    Task,
};
use volver::real::FormatName;

/// What is wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    Nothing,
    /// Its own light counts among that from behind.
    OwnLight,
    /// The transmittance in front in place of that behind the sample.
    InFront,
    Sign,
    PerLength,
    Factor(f64),
    OpacityAlone,
    LastSample,
    /// Opacities are cut, and their derivatives are not.
    ThroughClamp(f64),
    /// The backward pass knows no derivative above an opacity.
    Clamp(f64),
    /// It ends early, and the forward one does not.
    EarlyEnd(f64),
    Half,
    Detached,
    DetachedTransmittance,
    NotFinite,
    Unattenuated,
    /// Every derivative is 0.
    Zeros,
    /// Derivatives by C of one channel alone.
    OneRow,
    Cotangents,
    /// No slope below a depth.
    Thin(f64),
    /// As `Factor`, and its own light.
    Both(f64),
    /// A part of the derivative that grows with the place.
    Drift,
}
use Fault::*;

/// Samples in the middles, front to back, differentiated by hand.
#[derive(Debug)]
struct March {
    declaration: Declaration,
    fault: Fault,
    single: bool,
    /// Samples in front, which are ends of segments.
    front: bool,
}

impl March {
    fn new(fault: Fault) -> Self {
        March {
            declaration: Declaration {
                gradient: Some(GradientAt::Middles),
                ..Declaration::new("march")
            },
            fault,
            single: false,
            front: false,
        }
    }

    fn round(&self, x: f64) -> f64 {
        if self.single { f64::from(x as f32) } else { x }
    }

    fn samples<'s>(&self, segments: &'s Segments) -> &'s Samples {
        if self.front {
            &segments.edges
        } else {
            &segments.middles
        }
    }

    /// (d, α) of every segment.
    fn layers(&self, task: &Task<'_>) -> Vec<(f64, f64)> {
        let Data::Segments(segments) = task.data else {
            panic!("segments were declared");
        };
        let lengths = segments
            .edges
            .lambda
            .windows(2)
            .map(|ends| ends[1] - ends[0]);
        let both = lengths.zip(&self.samples(segments).extinction);
        both.map(|(d, tau)| {
            let opacity = self.round(-(-tau * d).exp_m1());
            match self.fault {
                ThroughClamp(most) => (d, opacity.min(most)),
                _ => (d, opacity),
            }
        })
        .collect()
    }
}

impl Kernel for March {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let layers = self.layers(task);
        let segments = task.cut().expect("segments were declared");
        let of = |emission: &Vec<f64>| {
            let (mut sum, mut through) = (0.0, 1.0);
            for ((_, opacity), c) in layers.iter().zip(emission) {
                sum = self.round(sum + self.round(self.round(through * opacity) * c));
                through = self.round(through * (1.0 - opacity));
            }
            Float::with_val(53, sum)
        };
        Ok(Rendering {
            radiance: self.samples(segments).emission.iter().map(of).collect(),
            ..Rendering::default()
        })
    }

    fn gradient(
        &mut self,
        task: &Task<'_>,
        cotangents: &[f64],
    ) -> Result<(Rendering, Gradient), KernelError> {
        let rendering = self.render(task)?;
        let layers = self.layers(task);
        let segments = task.cut().expect("segments were declared");
        let samples = self.samples(segments);
        let (emission, taus) = (&samples.emission, &samples.extinction);
        let n = layers.len();
        let seen = |i: usize| -> f64 {
            let both = emission.iter().zip(cotangents);
            both.map(|(c, a)| a * c[i]).sum()
        };
        let mut fronts = vec![1.0];
        for (_, opacity) in &layers {
            fronts.push(fronts[fronts.len() - 1] * (1.0 - opacity));
        }
        let end = match self.fault {
            EarlyEnd(under) => (0..n).find(|i| fronts[*i] < under).unwrap_or(n),
            _ => n,
        };
        let (mut by_tau, mut by_c) = (vec![0.0; n], vec![vec![0.0; n]; emission.len()]);
        let mut behind = 0.0;
        for i in (0..end).rev() {
            let (d, opacity) = layers[i];
            let (front, left) = (fronts[i], (-taus[i] * d).exp());
            let own = front * opacity * seen(i);
            by_tau[i] = match self.fault {
                OwnLight => d * (front * left * seen(i) - behind - own),
                InFront => d * (front * seen(i) - behind),
                Sign => -d * (front * left * seen(i) - behind),
                PerLength => front * left * seen(i) - behind,
                Factor(factor) => factor * d * (front * left * seen(i) - behind),
                OpacityAlone => front * seen(i) - behind / left,
                LastSample if i == n - 1 => 0.0,
                Clamp(most) if opacity > most => 0.0,
                Detached | Zeros => 0.0,
                DetachedTransmittance => d * front * left * seen(i),
                NotFinite if taus[i] == 0.0 => f64::NAN,
                Thin(under) if taus[i] * d <= under => 0.0,
                Both(factor) => factor * d * (front * left * seen(i) - behind - own),
                Drift => d * (front * left * seen(i) - behind) * (1.0 + 1e-3 * i as f64),
                // The value's opacity is cut; the derivative knows nothing of it.
                ThroughClamp(_) => d * left * (front * seen(i) - behind / (1.0 - opacity)),
                _ => d * (front * left * seen(i) - behind),
            };
            for (channel, row) in by_c.iter_mut().enumerate() {
                row[i] = match self.fault {
                    Unattenuated => cotangents[channel] * opacity,
                    Zeros => 0.0,
                    Cotangents => front * opacity,
                    _ => cotangents[channel] * front * opacity,
                };
            }
            behind += own;
        }
        let number = |x: f64| {
            let bits = if self.fault == Half { 11 } else { 53 };
            Float::with_val(53, Float::with_val(bits, self.round(x)))
        };
        if self.fault == OneRow {
            by_c.truncate(1);
        }
        let gradient = Gradient {
            extinction: by_tau.into_iter().map(number).collect(),
            emission: by_c
                .into_iter()
                .map(|row| row.into_iter().map(number).collect())
                .collect(),
        };
        Ok((rendering, gradient))
    }
}

fn found(mut march: March) -> GradientFound {
    gradients(&mut march, Budget::default(), &mut |_| ()).expect("it answers")
}

#[test]
fn a_right_gradient_is_that_of_the_values_to_rounding() {
    for single in [false, true] {
        let mut march = March::new(Nothing);
        march.single = single;
        if single {
            march.declaration.format = FormatName::F32;
        }
        let found = found(march);
        assert!(found.is_right(), "{found:?}");
        // 47 values on seven rays, by τ and by C of two channels.
        assert_eq!(found.compared + found.left_out, 3 * 47);
        assert_eq!(found.left_out, 0);
    }
}

#[test]
fn the_wrong_term_is_named() {
    let all = [
        (OwnLight, "gradient-own-light", None),
        (InFront, "gradient-transmittance", None),
        (Sign, "gradient-sign", None),
        (PerLength, "gradient-per-depth", None),
        (Factor(1.03), "gradient-factor", Some(1.03)),
        (Factor(0.97), "gradient-factor", Some(0.97)),
        (OpacityAlone, "gradient-of-opacity", None),
        (LastSample, "gradient-last-sample", None),
        (ThroughClamp(0.95), "gradient-through-clamp", Some(0.95)),
        (Clamp(0.9), "gradient-clamp", Some(0.9)),
        (EarlyEnd(1e-2), "gradient-early-end", Some(1e-2)),
        (Half, "gradient-format", Some(11.0)),
        (Detached, "gradient-zero", None),
        (Zeros, "gradient-zero", None),
        (
            DetachedTransmittance,
            "gradient-detached-transmittance",
            None,
        ),
        (NotFinite, "gradient-not-finite", None),
        (Unattenuated, "gradient-emission-unattenuated", None),
        (Cotangents, "gradient-cotangents", None),
        (Thin(3e-3), "gradient-thin", Some(3e-3)),
    ];
    for (fault, name, value) in all {
        let found = found(March::new(fault));
        let names: Vec<_> = found.deviations.iter().map(|d| d.name).collect();
        assert_eq!(names, [name], "{fault:?}: {found:?}");
        assert!(!found.is_right(), "{fault:?}");
        let deviation = &found.deviations[0];
        match (value, deviation.bracket) {
            (Some(value), Some((low, high))) => {
                assert!(low <= value && value <= high, "{fault:?}: {deviation:?}");
            }
            (value, _) => assert_eq!(deviation.value, value, "{fault:?}"),
        }
    }
}

#[test]
fn a_rectifier_at_rest_is_left_out_and_counted() {
    let found = found(March::new(Thin(0.0)));
    assert!(found.is_right(), "{found:?}");
    assert_eq!(found.left_out, 1);
}

#[test]
fn gradients_by_the_ends_of_segments_may_leave_the_last_one_out() {
    let mut march = March::new(Nothing);
    march.front = true;
    march.declaration.gradient = Some(GradientAt::Edges);
    let found = found(march);
    assert!(found.is_right(), "{found:?}");
}

#[test]
fn what_is_wrong_in_no_known_way_has_no_name_but_is_wrong() {
    for fault in [Both(1.01), Drift] {
        let found = found(March::new(fault));
        assert!(found.deviations.is_empty(), "{fault:?}: {found:?}");
        assert!(!found.is_right(), "{fault:?}");
        assert!(found.worst.is_some(), "{fault:?}");
    }
}

#[test]
fn a_gradient_of_another_shape_is_refused_whoever_answers() {
    let error = gradients(&mut March::new(OneRow), Budget::default(), &mut |_| ());
    let reason = error.expect_err("a row is missing").reason;
    assert!(
        reason.contains("a gradient with 1 numbers of channels of emission (allowed: 2)"),
        "{reason}"
    );
}
