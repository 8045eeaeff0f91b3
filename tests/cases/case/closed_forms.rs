//! Exact solutions: they satisfy the differential equations that define them, and brute force agrees.

use quickcheck::QuickCheck;
use rug::Rational;
use volver::case::{
    Case, HomogeneousSlab, PolynomialTransfer, Reciprocal, ReciprocalSquare, SineSquared, Structure,
};
use volver::quadrature::Rule;
use volver::real::{Format, Mpfr, MpfrReal, Real};

const FORMAT: Mpfr = Mpfr { bits: 400 };

fn slab() -> HomogeneousSlab {
    HomogeneousSlab {
        length: (3, 2).into(),
        extinction: (7, 3).into(),
        emission: (4, 5).into(),
    }
}

/// λ strictly between 0 and D.
fn place<C: Case>(case: &C, k: u32) -> Rational {
    case.length() * Rational::from((u64::from(k) + 1, (1_u64 << 32) + 1))
}

fn exp_minus(t: MpfrReal) -> MpfrReal {
    (-t).exp()
}

/// (f(λ + h) − f(λ − h)) / 2h with h = 2⁻¹⁰⁰: off by O(h²) = 2⁻²⁰⁰ and by rounding, 2⁻⁴⁰⁰/h.
fn derivative(f: impl Fn(&MpfrReal) -> MpfrReal, lambda: &Rational) -> MpfrReal {
    let h = Rational::from(1) >> 100_u32;
    let (ahead, behind) = (Rational::from(lambda + &h), Rational::from(lambda - &h));
    let difference = f(&FORMAT.ratio(&ahead)) - &f(&FORMAT.ratio(&behind));
    difference / &FORMAT.ratio(&(h * 2_u32))
}

fn satisfies_its_equations<C: Case>(case: &C) {
    for k in (0..40_u32).map(|i| i.wrapping_mul(0x9e37_79b9)) {
        let exact = place(case, k);
        let lambda = FORMAT.ratio(&exact);
        let transfer = case.transfer(&case.field(&lambda));
        let depth = case.optical_depth(&lambda).unwrap();
        // t′ = τ.
        let slope = derivative(|x| case.optical_depth(x).unwrap(), &exact);
        assert!(
            (slope - &transfer.extinction).log2_abs() < -190.0,
            "t′ at {exact}"
        );
        // I′ = C τ e⁻ᵗ.
        let slope = derivative(|x| case.radiance(x).unwrap(), &exact);
        let source = transfer.emission * &transfer.extinction * &exp_minus(depth);
        assert!((slope - &source).log2_abs() < -190.0, "I′ at {exact}");
    }
    let zero = FORMAT.int(0);
    assert_eq!(case.optical_depth(&zero).unwrap(), zero);
    assert_eq!(case.radiance(&zero).unwrap(), zero);
}

#[test]
fn exact_solutions_satisfy_their_differential_equations() {
    satisfies_its_equations(&SineSquared);
    satisfies_its_equations(&Reciprocal);
    satisfies_its_equations(&ReciprocalSquare);
    satisfies_its_equations(&slab());
}

/// ∫₀ˣ f by 60 points of Gauss–Legendre; its own error is below 10⁻⁹⁰ here, the nearest pole being
/// one ray length in front of the ray.
fn integrate(f: impl Fn(&MpfrReal) -> MpfrReal, x: &MpfrReal) -> MpfrReal {
    let table = Rule::GaussLegendre(60).table(FORMAT.bits).unwrap();
    let mut sum = FORMAT.int(0);
    for (node, weight) in table.nodes.iter().zip(&table.weights) {
        sum += &(f(&(FORMAT.ratio(node) * x)) * &FORMAT.ratio(weight));
    }
    sum * x
}

fn agrees_with_brute_force<C: Case>(case: &C) {
    let end = FORMAT.ratio(&case.length());
    let tau = |x: &MpfrReal| case.extinction(&case.field(x));
    let depth = |x: &MpfrReal| integrate(tau, x);
    let source = |x: &MpfrReal| {
        let transfer = case.transfer(&case.field(x));
        transfer.emission * &transfer.extinction * &exp_minus(depth(x))
    };
    // 60 digits are 2⁻¹⁹⁹·³.
    assert!(
        (depth(&end) - &case.optical_depth(&end).unwrap()).log2_abs() < -200.0,
        "{case:?}"
    );
    assert!(
        (integrate(source, &end) - &case.radiance(&end).unwrap()).log2_abs() < -200.0,
        "{case:?}"
    );
}

#[test]
fn exact_radiances_agree_with_nested_quadrature_to_60_digits() {
    agrees_with_brute_force(&SineSquared);
    agrees_with_brute_force(&Reciprocal);
    agrees_with_brute_force(&ReciprocalSquare);
    agrees_with_brute_force(&slab());
}

#[test]
fn extinction_alone_is_the_extinction_of_both() {
    fn check(k: u32) -> bool {
        fn alike<C: Case>(case: &C, k: u32) -> bool {
            let s = case.field(&FORMAT.ratio(&place(case, k)));
            case.extinction(&s) == case.transfer(&s).extinction
        }
        alike(&SineSquared, k) && alike(&Reciprocal, k) && alike(&slab(), k)
    }
    QuickCheck::new()
        .tests(50)
        .quickcheck(check as fn(u32) -> bool);
}

/// What a case says of its transfer functions, and they themselves.
fn polynomials_are_the_transfer_functions<C: Case>(case: &C) {
    let polynomial = case.structure().transfer.unwrap();
    let evaluate = |coefficients: &[Rational], s: &MpfrReal| {
        let mut power = FORMAT.int(1);
        let mut sum = FORMAT.int(0);
        for c in coefficients {
            sum += &(FORMAT.ratio(c) * &power);
            power *= s;
        }
        sum
    };
    for k in [0, 1 << 30, 3 << 30] {
        let s = case.field(&FORMAT.ratio(&place(case, k)));
        let transfer = case.transfer(&s);
        let extinction = evaluate(&polynomial.extinction, &s) - &transfer.extinction;
        assert!(extinction.log2_abs() < -390.0, "τ of {case:?}");
        let source = transfer.emission * &transfer.extinction;
        let source = evaluate(&polynomial.source, &s) - &source;
        assert!(source.log2_abs() < -390.0, "C τ of {case:?}");
    }
}

#[test]
fn structures_tell_the_truth() {
    polynomials_are_the_transfer_functions(&Reciprocal);
    polynomials_are_the_transfer_functions(&ReciprocalSquare);
    polynomials_are_the_transfer_functions(&slab());
    assert_eq!(SineSquared.structure().transfer, None);
    assert_eq!(SineSquared.structure().field_degree, Some(1));
    assert_eq!(Reciprocal.structure().field_degree, None);
    assert_eq!(slab().structure().field_degree, Some(0));
}

#[test]
fn degrees_follow_from_field_and_transfer() {
    // τ of degree 2 (its leading zero does not count) in a field of degree 3.
    let structure = |field_degree, extinction: &[i32], source: &[i32]| Structure {
        field_degree,
        transfer: Some(PolynomialTransfer {
            extinction: extinction.iter().map(|&c| c.into()).collect(),
            source: source.iter().map(|&c| c.into()).collect(),
        }),
        ..Structure::default()
    };
    let cubic = structure(Some(3), &[1, 0, 5, 0], &[2, 0]);
    assert_eq!(cubic.extinction_degree(), Some(6));
    assert_eq!(cubic.extinction_degree_of(2), Some(4));
    assert!(cubic.source_is_constant());
    assert!(!structure(Some(3), &[1], &[0, 1]).source_is_constant());
    // An unknown field hides the degree, unless τ is constant.
    assert_eq!(structure(None, &[0, 1], &[1]).extinction_degree(), None);
    assert_eq!(structure(None, &[4], &[1]).extinction_degree(), Some(0));
    assert_eq!(structure(None, &[], &[]).extinction_degree(), Some(0));
    // Transfer functions that are no polynomials: only a constant field says something.
    let unknown = |field_degree| Structure {
        field_degree,
        transfer: None,
        ..Structure::default()
    };
    assert_eq!(unknown(Some(0)).extinction_degree(), Some(0));
    assert_eq!(unknown(Some(1)).extinction_degree(), None);
    assert_eq!(unknown(None).extinction_degree(), None);
    assert!(unknown(Some(0)).source_is_constant());
    assert!(!unknown(Some(1)).source_is_constant());
}

#[test]
fn cases_are_called_what_the_command_line_takes() {
    assert_eq!(SineSquared.name(), "sine-squared");
    assert_eq!(Reciprocal.name(), "reciprocal");
    assert_eq!(ReciprocalSquare.name(), "reciprocal-square");
    assert_eq!(slab().name(), "homogeneous-slab");
}
