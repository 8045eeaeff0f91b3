//! Roundings that differ, against the same variant in MPFR.

use super::{compositing, front_to_back};
use rug::{Float, Rational};
use std::sync::Arc;
use volver::case::{
    Case, Column, Fresh, HomogeneousSlab, Nodes, Number, PolynomialTransfer, SineSquared, Transfer,
};
use volver::method::{Accumulation, Compositing, OpacityFormula, Position, Stop, Summation};
use volver::real::{Format, Mpfr, Native};

fn thin_slab(k: u32) -> HomogeneousSlab {
    HomogeneousSlab {
        length: (1, 1).into(),
        extinction: (1, 37 + k).into(),
        emission: (4, 5).into(),
    }
}

fn in_binary32(method: Compositing, slab: &HomogeneousSlab, n: u64) -> f64 {
    let nodes = Fresh::new(slab, Native::<f32>::new());
    f64::from(method.radiance(&nodes, n).unwrap())
}

/// The variant's relative error in binary32 against the very same inputs in MPFR.
fn rounding(method: Compositing, slab: &HomogeneousSlab, n: u64) -> f64 {
    let rounded = |q: &Rational| Rational::from_f32(q.to_f32()).unwrap();
    let inputs = HomogeneousSlab {
        length: slab.length.clone(),
        extinction: rounded(&slab.extinction),
        emission: rounded(&slab.emission),
    };
    // Exact whatever the variant, since the slab is constant in each segment.
    let exact: Float = inputs.radiance(&Mpfr { bits: 200 }.int(1)).unwrap().into();
    (in_binary32(method, slab, n) / exact.to_f64() - 1.0).abs()
}

#[test]
fn compensated_and_pairwise_sums_are_closer_over_a_million_segments() {
    let n = 1 << 20;
    let by = |summation| {
        let order = front_to_back(Accumulation::Depths, summation);
        compositing(Position::Front, OpacityFormula::Expm1, order)
    };
    for k in 0..4 {
        let slab = thin_slab(k);
        let [naive, pairwise, neumaier] =
            [Summation::Naive, Summation::Pairwise, Summation::Neumaier]
                .map(|summation| rounding(by(summation), &slab, n));
        println!("slab {k}: naive {naive:e}, pairwise {pairwise:e}, neumaier {neumaier:e}");
        // A unit of binary32 is 6e-8.
        // What Neumaier's sum loses is of second order, though (n u)² is 2⁻⁸ at worst.
        assert!(neumaier < 3e-6, "{k}: {neumaier:e}");
        assert!(pairwise < 1e-6, "{k}: {pairwise:e}");
        assert!(neumaier * 300.0 < naive, "{k}: {neumaier:e} {naive:e}");
    }
}

/// The depth that T in front of the last segment stands for, in units of binary32: how far it is off, in the mean square over
/// slabs of depths from 1 to 8.
fn off_in_depth(accumulation: Accumulation, summation: Summation, n: u32) -> f64 {
    let order = front_to_back(accumulation, summation);
    let method = compositing(Position::Middle, OpacityFormula::Expm1, order);
    let squares = (0..16_u8).map(|k| {
        let extinction = 1.07 + 0.41 * f32::from(k);
        let slab = HomogeneousSlab {
            length: 1.into(),
            extinction: Rational::from_f32(extinction).unwrap(),
            emission: 1.into(),
        };
        let nodes = Fresh::new(&slab, Native::<f32>::new());
        let whole = method.composite(&nodes, n.into(), Stop::Never).unwrap();
        let depth = -f64::from(*whole.transmittances.last().unwrap()).ln();
        // n is a power of two, so that τ d is exact.
        let exact = f64::from(extinction) * f64::from(n - 1) / f64::from(n);
        (depth - exact).powi(2)
    });
    (squares.sum::<f64>() / 16.0).sqrt() * 2f64.powi(24)
}

/// What is multiplied drifts, since 1 − α has lost the same in every segment; what is taken off goes up and down by chance; and
/// a compensated remainder loses nothing.
#[test]
fn a_remainder_is_off_by_the_root_of_n_where_a_product_is_off_by_n() {
    for bits in [6, 8, 10, 12, 14, 16] {
        let n = 1 << bits;
        let of = |accumulation, summation| off_in_depth(accumulation, summation, n);
        let product = of(Accumulation::Transmittances, Summation::Naive);
        let remainder = of(Accumulation::Remainder, Summation::Naive);
        let compensated = of(Accumulation::Remainder, Summation::Neumaier);
        println!("2^{bits}: {product:.1}, {remainder:.2}, {compensated:.2} units");
        let n = f64::from(n);
        assert!((0.1 * n..0.6 * n).contains(&product), "2^{bits}: {product}");
        assert!(remainder < n.sqrt(), "2^{bits}: {remainder}");
        assert!(compensated < 6.0, "2^{bits}: {compensated}");
    }
    // Where an opacity is a few dozen units in the last place of T, its roundings repeat as well.
    let n = 1 << 20;
    let product = off_in_depth(Accumulation::Transmittances, Summation::Naive, n);
    let remainder = off_in_depth(Accumulation::Remainder, Summation::Naive, n);
    let compensated = off_in_depth(Accumulation::Remainder, Summation::Neumaier, n);
    println!("2^20: {product:.1}, {remainder:.2}, {compensated:.2} units");
    assert!(remainder * 8.0 < product, "{remainder} {product}");
    assert!(compensated < 6.0, "{compensated}");
}

/// Terms too small for the sum beside them, which compensation keeps; and the larger one behind.
#[test]
fn neumaier_keeps_what_either_summand_loses() {
    // T given from outside makes the terms: x·T with x the same in all segments.
    let slab = HomogeneousSlab {
        length: 4.into(),
        extinction: 1.into(),
        emission: 1.into(),
    };
    let nodes = Fresh::new(&slab, Native::<f64>::new());
    let sum = |summation| {
        let order = front_to_back(Accumulation::Transmittances, summation);
        let method = compositing(Position::Front, OpacityFormula::Linear, order);
        let terms = [1.0, 1e100, 1.0, -1e100];
        method.radiance_under(&nodes, 4, &terms).unwrap().unwrap()
    };
    assert_eq!(sum(Summation::Naive), 0.0);
    assert_eq!(sum(Summation::Pairwise), 0.0);
    // Kahan's own sum would be 0 as well.
    assert_eq!(sum(Summation::Neumaier), 2.0);
}

#[test]
fn a_compensated_sum_beyond_the_range_of_a_format_is_infinite() {
    let slab = HomogeneousSlab {
        length: 4.into(),
        extinction: 60000.into(),
        emission: 1.into(),
    };
    let nodes = Fresh::new(&slab, Native::<half::f16>::new());
    let order = front_to_back(Accumulation::Depths, Summation::Neumaier);
    let method = compositing(Position::Back, OpacityFormula::Expm1, order);
    let whole = method.composite(&nodes, 4, Stop::Never).unwrap();
    let one = half::f16::ONE;
    assert_eq!(whole.radiance, one);
    assert_eq!(whole.transmittances[1..], [half::f16::ZERO; 3]);
}

#[test]
fn expm1_and_the_relative_opacity_beat_subtraction_in_thin_segments() {
    // τ d = 2⁻²⁰·0.9…: where 1 − e^(−x) keeps 4 bits of 24.
    let mut lost = 0;
    for k in 0..20_u8 {
        let x = (0.9 + 0.01 * f32::from(k)) * 2_f32.powi(-20);
        let exact = -Float::with_val(200, -x).exp_m1();
        let error =
            |formula: OpacityFormula| (f64::from(formula.of(&x)) / exact.to_f64() - 1.0).abs();
        assert!(error(OpacityFormula::Expm1) < 2e-7);
        assert!(error(OpacityFormula::Relative) < 2e-7);
        lost += u32::from(error(OpacityFormula::Subtraction) > 1e-3);
    }
    // For 2⁻²⁰ itself the difference happens to be a number of binary32.
    assert_eq!(lost, 19);
    let slab = thin_slab(0);
    // 2⁻²⁰ is about 1/37 of 2⁻¹⁵: 2¹⁵ segments of a depth of 1/37.
    let by = |opacity| {
        let order = front_to_back(Accumulation::Depths, Summation::Neumaier);
        rounding(
            compositing(Position::Middle, opacity, order),
            &slab,
            1 << 15,
        )
    };
    let [subtraction, expm1, relative] = [
        OpacityFormula::Subtraction,
        OpacityFormula::Expm1,
        OpacityFormula::Relative,
    ]
    .map(by);
    println!("subtraction {subtraction:e}, expm1 {expm1:e}, relative {relative:e}");
    assert!(expm1 < 3e-7 && relative < 3e-7, "{expm1:e} {relative:e}");
    assert!(subtraction > 1e-3, "{subtraction:e}");
}

/// Nodes that keep no row of values.
#[derive(Debug)]
struct MarchOnly<'a, N>(&'a N);

impl<N: Nodes> Nodes for MarchOnly<'_, N> {
    type Format = N::Format;
    fn format(&self) -> N::Format {
        self.0.format()
    }
    fn length(&self) -> &Rational {
        self.0.length()
    }
    fn boundaries(&self, _: u64) -> Arc<Column<Number<Self>>> {
        panic!("a row of values")
    }
    fn march(&self, n: u64) -> impl Iterator<Item = Transfer<Number<Self>>> {
        self.0.march(n)
    }
    fn march_inside(
        &self,
        n: u64,
        offset: Rational,
    ) -> impl Iterator<Item = Transfer<Number<Self>>> {
        self.0.march_inside(n, offset)
    }
    fn interior(&self, _: u64, _: &Rational) -> Arc<Column<Number<Self>>> {
        panic!("a row of values")
    }
    fn beyond(&self, n: u64) -> Number<Self> {
        self.0.beyond(n)
    }
    fn extinction_at(&self, lambda: &Number<Self>) -> Number<Self> {
        self.0.extinction_at(lambda)
    }
    fn transfer(&self, s: &Number<Self>) -> Transfer<Number<Self>> {
        self.0.transfer(s)
    }
    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        self.0.polynomial_transfer()
    }
}

#[test]
fn sixteen_million_segments_in_one_pass() {
    let fresh = Fresh::new(&SineSquared, Native::<f32>::new());
    let nodes = MarchOnly(&fresh);
    let exact = SineSquared.radiance(&1.0_f64).unwrap();
    let n = 1 << 24;
    for position in [Position::Front, Position::Middle, Position::Back] {
        // T and the sum lose much here; that it comes out in one pass is what counts.
        let order = front_to_back(Accumulation::Transmittances, Summation::Naive);
        let method = compositing(position, OpacityFormula::Expm1, order);
        let radiance = f64::from(method.radiance(&nodes, n).unwrap());
        assert!((0.5..2.0).contains(&(radiance / exact)), "{radiance}");
    }
    let order = front_to_back(Accumulation::Depths, Summation::Pairwise);
    let method = compositing(Position::Middle, OpacityFormula::Expm1, order);
    let radiance = f64::from(method.radiance(&nodes, n).unwrap());
    assert!((radiance / exact - 1.0).abs() < 1e-5, "{radiance} {exact}");
}
