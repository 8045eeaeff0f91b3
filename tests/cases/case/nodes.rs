//! Places, and what it costs to look at them.

use rug::Rational;
use volver::case::{Case, Fresh, HomogeneousSlab, Nodes, Reciprocal, Shared, Structure, Transfer};
use volver::inside::case::Grid;
use volver::quadrature::Rule;
use volver::real::{Format, Mpfr, Native, Real};

/// Shows the places it is asked for: s = λ, τ = s, C = s².
#[derive(Debug)]
struct Identity {
    length: Rational,
}

impl Case for Identity {
    fn name(&self) -> &'static str {
        "identity"
    }
    fn length(&self) -> Rational {
        self.length.clone()
    }
    fn field<R: Real>(&self, lambda: &R) -> R {
        lambda.clone()
    }
    fn transfer<R: Real>(&self, s: &R) -> Transfer<R> {
        Transfer {
            emission: s.clone() * s,
            extinction: s.clone(),
        }
    }
    fn optical_depth<R: Real>(&self, lambda: &R) -> Option<R> {
        Some(lambda.clone() * lambda / &lambda.format().int(2))
    }
    fn radiance<R: Real>(&self, lambda: &R) -> Option<R> {
        Some(lambda.clone())
    }
    fn structure(&self) -> Structure {
        Structure::default()
    }
}

fn ray(numerator: u64, denominator: u64) -> Identity {
    Identity {
        length: Rational::from((numerator, denominator)),
    }
}

/// A length that no machine integer holds, and an offset that stands for an irrational number.
fn long_rational() -> Rational {
    (Rational::from(1) << 100_u32) / ((Rational::from(1) << 101_u32) + 1_u32)
}

/// D (j + offset)/n in rationals, rounded by MPFR alone.
fn assert_places<N: Nodes<Format = Mpfr>>(nodes: &N, length: &Rational, n: u64, bits: u32) {
    let exact = |j: u64, offset: &Rational| {
        let place = Rational::from(offset + j) * length / n;
        rug::Float::with_val(bits, place).to_rational().unwrap()
    };
    let zero = Rational::new();
    let boundaries = nodes.boundaries(n);
    let places: Vec<_> = boundaries
        .field
        .iter()
        .map(|s| s.to_rational().unwrap())
        .collect();
    let expected: Vec<_> = (0..=n).map(|i| exact(i, &zero)).collect();
    assert_eq!(places, expected);
    for offset in [
        Rational::from((1, 2)),
        Rational::from((2, 3)),
        long_rational(),
    ] {
        let interior = nodes.interior(n, &offset);
        let places: Vec<_> = interior
            .field
            .iter()
            .map(|s| s.to_rational().unwrap())
            .collect();
        let expected: Vec<_> = (0..n).map(|j| exact(j, &offset)).collect();
        assert_eq!(places, expected);
    }
    for offset in [zero.clone(), (1, 2).into(), long_rational(), 1.into()] {
        let column = nodes.interior(n, &offset);
        assert_eq!(nodes.march_inside(n, offset.clone()).count() as u64, n);
        for (j, transfer) in nodes.march_inside(n, offset.clone()).enumerate() {
            assert_eq!(transfer.extinction, column.extinction[j]);
            assert_eq!(transfer.emission, column.emission[j]);
        }
    }
    assert_eq!(nodes.beyond(n).to_rational().unwrap(), exact(n + 1, &zero));
    for (i, transfer) in nodes.march(n).enumerate() {
        assert_eq!(transfer.extinction, boundaries.extinction[i]);
        assert_eq!(transfer.emission, boundaries.emission[i]);
    }
    assert_eq!(nodes.march(n).count() as u64, n + 1);
}

#[test]
fn places_are_rounded_once() {
    for length in [(1, 1).into(), (3, 7).into(), long_rational()] {
        let case = Identity {
            length: Rational::clone(&length),
        };
        for bits in [10, 53, 200] {
            for n in [1, 3, 10] {
                let format = Mpfr { bits };
                assert_places(&Fresh::new(&case, format), &length, n, bits);
                assert_places(&Shared::new(&case, format), &length, n, bits);
            }
        }
    }
}

/// The columns carry C and τ of the very field value beside them.
#[test]
fn columns_hold_the_transfer_functions_of_their_field() {
    let case = ray(5, 3);
    let format = Native::<f32>::new();
    let (fresh, shared) = (Fresh::new(&case, format), Shared::new(&case, format));
    for column in [
        fresh.boundaries(9),
        shared.boundaries(9),
        shared.interior(9, &(1, 4).into()),
    ] {
        for ((s, c), tau) in column
            .field
            .iter()
            .zip(&column.emission)
            .zip(&column.extinction)
        {
            assert_eq!(c.to_bits(), (s * s).to_bits());
            assert_eq!(tau.to_bits(), s.to_bits());
        }
    }
}

#[test]
fn fresh_nodes_count_every_look() {
    let nodes = Fresh::new(&Reciprocal, Native::<f64>::new());
    let counted = |look: &dyn Fn()| {
        let before = nodes.evaluations();
        look();
        nodes.evaluations() - before
    };
    assert_eq!(counted(&|| drop(nodes.boundaries(8))), 9);
    assert_eq!(counted(&|| drop(nodes.boundaries(8))), 9);
    assert_eq!(counted(&|| drop(nodes.interior(8, &(1, 3).into()))), 8);
    assert_eq!(counted(&|| assert_eq!(nodes.march(8).count(), 9)), 9);
    let inside = || nodes.march_inside(8, (1, 2).into()).count();
    assert_eq!(counted(&|| assert_eq!(inside(), 8)), 8);
    assert_eq!(counted(&|| assert!(nodes.beyond(8) > 0.0)), 1);
    assert_eq!(counted(&|| assert!(nodes.extinction_at(&0.5) > 0.0)), 1);
    assert_eq!(counted(&|| assert!(nodes.transfer(&0.5).emission > 0.0)), 1);
}

#[test]
fn shared_nodes_count_every_place_once() {
    let nodes = Shared::new(&Reciprocal, Native::<f64>::new());
    let half = Rational::from((1, 2));
    let places = |look: &dyn Fn()| {
        look();
        nodes.evaluations()
    };
    assert_eq!(places(&|| drop(nodes.boundaries(4))), 5);
    assert_eq!(places(&|| drop(nodes.boundaries(4))), 5);
    // Coarser levels are among them; the midpoints of 4 segments are every other boundary of 8.
    assert_eq!(places(&|| drop(nodes.boundaries(2))), 5);
    assert_eq!(places(&|| drop(nodes.interior(4, &half))), 9);
    assert_eq!(places(&|| drop(nodes.boundaries(8))), 9);
    // Of 6 segments the boundaries 0, ⅓ … 1: four new ones at odd sixths and thirds.
    assert_eq!(places(&|| drop(nodes.boundaries(6))), 13);
    // An irrational offset is a level's own, and kept there.
    let irrational = long_rational();
    assert_eq!(places(&|| drop(nodes.interior(4, &irrational))), 17);
    assert_eq!(places(&|| drop(nodes.interior(4, &irrational))), 17);
}

/// The length of a ray is no machine integer: every column is evaluated anew, once.
#[test]
fn shared_nodes_of_a_long_length_are_kept_by_level() {
    let case = Identity {
        length: long_rational(),
    };
    let nodes = Shared::new(&case, Mpfr { bits: 64 });
    drop(nodes.boundaries(4));
    drop(nodes.boundaries(4));
    assert_eq!(nodes.evaluations(), 5);
    drop(nodes.interior(4, &(1, 2).into()));
    drop(nodes.interior(4, &(1, 2).into()));
    assert_eq!(nodes.evaluations(), 9);
}

#[test]
fn nodes_say_what_they_belong_to() {
    let slab = HomogeneousSlab {
        length: (7, 2).into(),
        extinction: 1.into(),
        emission: 2.into(),
    };
    let format = Mpfr { bits: 77 };
    let (fresh, shared) = (Fresh::new(&slab, format), Shared::new(&slab, format));
    assert_eq!((fresh.format(), shared.format()), (format, format));
    assert_eq!(fresh.length(), &slab.length);
    assert_eq!(shared.length(), &slab.length);
    assert_eq!(
        fresh.polynomial_transfer(),
        slab.structure().transfer.as_ref()
    );
    assert_eq!(
        shared.polynomial_transfer(),
        slab.structure().transfer.as_ref()
    );
    assert_eq!(shared.extinction_at(&format.int(1)), format.int(1));
    assert_eq!(shared.transfer(&format.int(1)).emission, format.int(2));
}

/// Everything up to place n + 1 must fit 64 bits, or the grid is refused rather than wrapped.
#[test]
fn a_grid_that_would_overflow_is_refused() {
    let one = Rational::from(1);
    let zero = Rational::new();
    assert!(Grid::new(&one, u64::MAX, &zero).is_none());
    assert!(Grid::new(&one, u64::MAX - 1, &zero).is_some());
    let large = Rational::from(1_u64 << 62);
    assert!(Grid::new(&large, 2, &zero).is_some());
    assert!(Grid::new(&large, 3, &zero).is_none());
    // Halves make the stride 2⁶³: three of them are too many.
    assert!(Grid::new(&large, 2, &(1, 2).into()).is_none());
    let grid = Grid::new(&one, 5, &(1, 3).into()).unwrap();
    assert_eq!(grid.place(6), (19, 15));
}

/// Gauss's nodes are no fractions of machine integers: in native formats they are rounded from two numbers of binary64.
#[test]
fn irrational_places_are_rounded_once_in_native_formats() {
    fn assert_rounded<F: Format>(format: F) {
        let table = Rule::GaussLegendre(5).table(format.bits()).unwrap();
        for length in [(1, 1), (5, 2), (1, 3), (10_000, 1), (1, 1000), (157, 50)] {
            let case = ray(length.0, length.1);
            let nodes = Fresh::new(&case, format);
            for offset in &table.nodes {
                for n in [1, 7, 1 << 10, 9_973] {
                    let column = nodes.interior(n, offset);
                    for (j, place) in (0_u64..).zip(&column.field) {
                        let exact = Rational::from(offset + j) / n * &case.length;
                        assert_eq!(*place, format.ratio(&exact), "{n} {j} {offset}");
                    }
                }
            }
        }
    }
    assert_rounded(Native::<f64>::new());
    assert_rounded(Native::<f32>::new());
}

/// Rows have the values of places one after the other, the first of boundaries one more.
#[test]
fn rows_have_the_same_values() {
    let case = ray(5, 3);
    let nodes = Fresh::new(&case, Native::<f64>::new());
    let half = Rational::from((1, 2));
    for n in [1, 511, 512, 513, 2_000] {
        let rows: Vec<_> = nodes.rows(n).collect();
        let values: Vec<f64> = rows.iter().flat_map(|row| row.extinction.clone()).collect();
        let march: Vec<f64> = nodes.march(n).map(|one| one.extinction).collect();
        assert_eq!(values, march);
        let inside: Vec<_> = nodes.rows_inside(n, half.clone()).collect();
        let counts = |rows: &[Transfer<Vec<f64>>]| -> Vec<usize> {
            rows.iter().map(|row| row.emission.len()).collect()
        };
        let mut backs = counts(&rows);
        backs[0] -= 1;
        assert_eq!(backs, counts(&inside));
        assert_eq!(counts(&inside).iter().sum::<usize>() as u64, n);
    }
}
