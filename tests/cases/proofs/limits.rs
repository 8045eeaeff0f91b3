//! Bounds from below, and what holds of every ray: the program's numbers keep to the theorems.

use super::theory;
use rug::ops::Pow;
use rug::{Float, Rational};
use volver::case::manufacture::{Manufactured, manufacture};
use volver::case::{Case, Fresh, HomogeneousSlab, catalogue};
use volver::method::Method;
use volver::real::{Format, Mpfr, Real};

const FORMAT: Mpfr = Mpfr { bits: 200 };

/// C = τ = 1 on a ray of length 2, whose radiance is 1 − e^(−2).
fn witness() -> HomogeneousSlab {
    HomogeneousSlab {
        length: Rational::from(2),
        extinction: Rational::from(1),
        emission: Rational::from(1),
    }
}

/// |approximation − exact| of the witness at n segments.
fn error(method: &str, n: u64) -> Float {
    let slab = witness();
    let method: Method = method.parse().unwrap();
    let radiance: Float = method
        .radiance(&Fresh::new(&slab, FORMAT), n)
        .unwrap()
        .into();
    (radiance - opaque()).abs()
}

/// 1 − e^(−2).
fn opaque() -> Float {
    -Float::with_val(200, -2).exp_m1()
}

/// `neglected_attenuation_error`: (1 − e^(−D))/2 · d at least.
#[test]
fn neglected_attenuation_costs_half_a_step() {
    assert!(theory("NeglectedAttenuation.v").contains("(1 - exp (- D)) / 2 * (D / INR n)"));
    for n in [1_u64, 2, 7, 64, 1000] {
        let least = opaque() / n;
        let error = error("preintegrated/linear/linear/unattenuated", n);
        assert!(error >= least, "{n}: {error:e} < {least:e}");
    }
}

/// What keeps `linear_exponential_order_at_most_one` from a bound K d²: on the witness the trapezoid rule,
/// itself of order 2, misses the radiance by ((1 − e^(−D)(1 + D))/2 + o(1)) d.
#[test]
fn a_linear_exponential_costs_all_but_one_order() {
    let constant = (1.0 - 3.0 * (-2.0_f64).exp()) / 2.0;
    for n in [256_u64, 4096] {
        let error = error("trapezoid/trapezoid/linear", n).to_f64();
        let step = 2.0 / n as f64;
        assert!(
            (error / step - constant).abs() < 2.0 * step,
            "{n}: {error:e}"
        );
    }
}

/// `preintegration_second_order` on the case rgb-transfer/green: s = 1 + 4λ(1 − λ), s″ = −8, τ = s,
/// C τ = s³/2 + 8 on [1, 2], so that the Lipschitz constants are 1 and 6, and G = 12.
#[test]
fn linear_preintegration_stays_below_its_bound() {
    assert!(
        theory("Preintegration.v")
            .contains("<= (K_source * D + G * K_extinction * D ^ 2) * M / 8 * d ^ 2.")
    );
    let description = catalogue::find("rgb-transfer").unwrap().unwrap();
    let cases = manufacture(&description).unwrap();
    let case = &cases
        .iter()
        .find(|c| c.channel.as_deref() == Some("green"))
        .unwrap()
        .case;
    assert_eq!(case.formulas().emission.to_string(), "1/2*s^2 + 8/s");
    // By 8 sub-intervals of a rule of order 16: exact but for 1e-20.
    let method: Method = "preintegrated/linear-by-8-gauss-8/linear-by-8-gauss-8"
        .parse()
        .unwrap();
    let exact: Float = case.radiance(&FORMAT.int(1)).unwrap().into();
    for n in [1_u64, 2, 4, 16, 128] {
        let radiance: Float = method
            .radiance(&Fresh::new(case, FORMAT), n)
            .unwrap()
            .into();
        let error = (radiance - &exact).abs();
        let bound = Float::with_val(200, (6 + 12) * 8 / 8) / Float::with_val(200, n).pow(2_u32);
        assert!(error <= bound, "{n}: {error:e} > {bound:e}");
        assert!(error * 1000 > bound, "{n}: the bound says nothing");
    }
}

fn smooth() -> Vec<Manufactured> {
    let descriptions = catalogue::names().map(|name| catalogue::find(name).unwrap().unwrap());
    let cases = descriptions.flat_map(|description| manufacture(&description).unwrap());
    cases
        .filter(|case| case.suits_kernels() && case.case.structure().breaks.is_empty())
        .collect()
}

/// λ = k D/16.
fn place(case: &impl Case, k: u32) -> <Mpfr as Format>::Real {
    FORMAT.ratio(&(case.length() * Rational::from((k, 16))))
}

/// `radiance_bounds` and `early_termination_bound`: 0 ≤ I(D) ≤ Cmax (1 − T(D)), and
/// I(D) − I(m) ≤ Cmax T(m).
#[test]
fn radiances_keep_their_bounds() {
    let cases = smooth();
    assert!(cases.len() > 30);
    for Manufactured { case, .. } in &cases {
        let of = |x: Option<<Mpfr as Format>::Real>| -> Float { x.unwrap().into() };
        let samples = (0..=1024_u32).map(|k| {
            let lambda = FORMAT.ratio(&(case.length() * Rational::from((k, 1024))));
            case.transfer(&case.field(&lambda)).emission.to_float()
        });
        // Between samples C may be larger, by less than a hundredth on these cases.
        let brightest = samples.fold(Float::with_val(200, 0), |a, b| a.max(&b)) * 1.01_f64;
        let whole = of(case.radiance(&place(case, 16)));
        for k in 0..=16 {
            let transmittance = (-of(case.optical_depth(&place(case, k)))).exp();
            let radiance = of(case.radiance(&place(case, k)));
            let absorbed = Float::with_val(200, 1 - &transmittance) * &brightest;
            let slack: Float = Float::with_val(200, 1) >> 150;
            assert!(radiance >= -slack.clone(), "{}", case.name());
            assert!(radiance <= absorbed + &slack, "{}", case.name());
            let behind = Float::with_val(200, &whole - &radiance);
            assert!(behind >= -slack.clone(), "{}", case.name());
            assert!(
                behind <= transmittance * &brightest + &slack,
                "{}",
                case.name()
            );
        }
    }
}

/// `radiance_split` with `over_exact_segments`: two exact segments under over are the exact ray.
#[test]
fn a_ray_cut_in_two_is_the_ray() {
    // Homogeneous media composite exactly with any number of segments.
    for n in [1_u64, 2, 3, 17, 1000] {
        let error = error("front-to-back/middle/expm1", n);
        assert!(error < 1e-55, "{n}: {error:e}");
    }
}
