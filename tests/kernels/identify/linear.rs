//! Linear segments against closed forms.

use rug::Float;
use volver::case::Transfer;
use volver::identify::rule::LinearSegments;
use volver::real::{Format, Mpfr, MpfrReal, Native, Real};

/// τ = a + b x and C = 1 on [0, h]: 1 − e^(−a h − b h²/2).
#[test]
fn constant_emission_has_a_closed_form() {
    let transfer = |extinction: f64| Transfer {
        emission: 1.0,
        extinction,
    };
    let rule = LinearSegments::new(Native::<f64>::new());
    for (near, far, length) in [
        (0.0, 1.0, 1.0),
        (3.0, 0.5, 0.25),
        (0.0, 0.0, 1.0),
        (10.0, 8.0, 1.5),
    ] {
        let (adds, passes) = rule.segment(&transfer(near), &transfer(far), &length);
        let depth: f64 = 0.5 * (near + far) * length;
        assert!((passes - (-depth).exp()).abs() < 1e-15);
        assert!(
            (adds + (-depth).exp_m1()).abs() < 2e-15,
            "{near} {far}: {adds}"
        );
    }
}

/// τ = 1, C = x on [0, 1]: 1 − 2/e.
#[test]
fn linear_emission_in_many_bits() {
    let format = Mpfr { bits: 300 };
    let transfer = |emission: i64| Transfer {
        emission: format.int(emission),
        extinction: format.int(1),
    };
    let rule = LinearSegments::new(format);
    let (adds, _) = rule.segment(&transfer(0), &transfer(1), &format.int(1));
    let exact: MpfrReal = format.int(1) - &(format.int(2) * &(-format.int(1)).exp());
    let error = (adds - &exact).to_float().abs();
    assert!(error < Float::with_val(300, 1e-85), "{error}");
}
