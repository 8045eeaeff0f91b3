//! A ray that is the same everywhere has the bits of one that is looked at segment by segment.

use half::f16;
use rug::Rational;
use std::sync::Arc;
use volver::case::{
    Case, Column, Fresh, HomogeneousSlab, Nodes, Number, PolynomialTransfer, Transfer,
};
use volver::method::Method;
use volver::real::lanes::LaneFormat;
use volver::real::{Fixed, Format, Ieee, Mpfr, Native, Real};

/// Nodes of a slab that say what is the same everywhere.
#[derive(Debug)]
struct Even<'s, F> {
    slab: &'s HomogeneousSlab,
    nodes: Fresh<'s, HomogeneousSlab, F>,
}

impl<F: Format> Nodes for Even<'_, F> {
    type Format = F;

    fn format(&self) -> F {
        self.nodes.format()
    }
    fn length(&self) -> &Rational {
        self.nodes.length()
    }
    fn everywhere(&self) -> Option<Transfer<F::Real>> {
        let field = self.slab.field(&self.format().int(0));
        Some(self.slab.transfer(&field))
    }
    fn boundaries(&self, n: u64) -> Arc<Column<F::Real>> {
        self.nodes.boundaries(n)
    }
    fn march(&self, n: u64) -> impl Iterator<Item = Transfer<F::Real>> {
        self.nodes.march(n)
    }
    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<F::Real>> {
        self.nodes.interior(n, offset)
    }
    fn beyond(&self, n: u64) -> F::Real {
        self.nodes.beyond(n)
    }
    fn extinction_at(&self, lambda: &F::Real) -> F::Real {
        self.nodes.extinction_at(lambda)
    }
    fn transfer(&self, s: &F::Real) -> Transfer<F::Real> {
        self.nodes.transfer(s)
    }
    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        self.nodes.polynomial_transfer()
    }
}

const METHODS: [&str; 24] = [
    "trapezoid/trapezoid",
    "trapezoid/simpson",
    "riemann-left/boole",
    "riemann-right/trapezoid/linear",
    "simpson/simpson",
    "front-to-back/front/subtraction",
    "front-to-back/middle/expm1",
    "front-to-back/middle/expm1/depths",
    "front-to-back/middle/expm1/depths/neumaier",
    "front-to-back/middle/expm1/depths/pairwise",
    "front-to-back/middle/relative/remainder",
    "front-to-back/back/linear/remainder/neumaier",
    "front-to-back/middle/linear/pairwise",
    "front-to-back/middle/expm1/stop=1:2",
    "back-to-front/middle/expm1",
    "back-to-front/back/linear",
    "tree/middle/expm1",
    "tree/front/subtraction",
    "preintegrated/linear/linear",
    "preintegrated/linear-by-8-trapezoid/linear-by-8-trapezoid",
    "preintegrated/linear-by-3-simpson/linear",
    "preintegrated/quadratic/linear",
    "preintegrated/quadratic-backward/quadratic-midpoint",
    "preintegrated/linear/linear/unattenuated",
];

/// The bits of a number: of 0 with its sign, of whatever is no number that it is none.
fn bits<R: Real>(x: &R) -> String {
    let float = x.to_float();
    format!(
        "{} {:?}",
        float.is_sign_negative() && !float.is_nan(),
        float.to_string_radix(16, None)
    )
}

fn is_the_same<F: Format>(format: F) {
    for (length, extinction, emission) in [
        ((1, 1), (3, 8), (1, 1)),
        ((7, 5), (1, 3), (5, 3)),
        ((3, 1), (1, 100_000), (1, 1)),
        ((1, 1), (0, 1), (1, 1)),
        // Rounding makes 1 − τ d negative, and results overflow in short formats.
        ((1, 1), (600, 1), (40_000, 1)),
    ] {
        let slab = HomogeneousSlab {
            length: Rational::from(length),
            extinction: Rational::from(extinction),
            emission: Rational::from(emission),
        };
        let nodes = Fresh::new(&slab, format);
        let even = Even {
            slab: &slab,
            nodes: Fresh::new(&slab, format),
        };
        for name in METHODS {
            let method: Method = name.parse().unwrap_or_else(|e| panic!("{name}: {e}"));
            for n in [1_u64, 2, 3, 7, 12, 40] {
                let run = |r: Result<Number<Fresh<'_, HomogeneousSlab, F>>, _>| match r {
                    Ok(radiance) => bits(&radiance),
                    Err(error) => format!("{error}"),
                };
                let alone = run(method.radiance(&nodes, n));
                assert_eq!(
                    run(method.radiance(&even, n)),
                    alone,
                    "{name} {format} {n} {slab:?}"
                );
            }
        }
    }
}

#[test]
fn rays_that_are_the_same_everywhere_keep_every_bit() {
    is_the_same(Native::<f32>::new());
    is_the_same(Native::<f64>::new());
    is_the_same(Native::<f16>::new());
    is_the_same(LaneFormat::<f32>::new());
    is_the_same(LaneFormat::<f64>::new());
    is_the_same(Ieee::TF32);
    is_the_same(Ieee::E4M3);
    is_the_same(Fixed::new(16, 8).unwrap());
    is_the_same(Mpfr { bits: 100 });
}

/// What a ray records on its way, and where it stops.
#[test]
fn transmittances_on_the_way_are_the_same() {
    let slab = HomogeneousSlab {
        length: 1.into(),
        extinction: 5.into(),
        emission: 1.into(),
    };
    let nodes = Fresh::new(&slab, Native::<f64>::new());
    let even = Even {
        slab: &slab,
        nodes: Fresh::new(&slab, Native::<f64>::new()),
    };
    let method: Method = "front-to-back/middle/expm1/stop=1:20".parse().unwrap();
    let Method::Composited(compositing) = method else {
        panic!("compositing");
    };
    for stop in [
        volver::method::Stop::AsDeclared,
        volver::method::Stop::Never,
        volver::method::Stop::After(5),
    ] {
        let alone = compositing.composite(&nodes, 40, stop).unwrap();
        let found = compositing.composite(&even, 40, stop).unwrap();
        assert_eq!(found, alone);
        assert!(found.transmittances.len() > 4 && found.transmittances.len() <= 40);
    }
}

/// Or else the other tests would compare a method with itself.
#[test]
fn what_is_the_same_everywhere_is_what_methods_take() {
    let slab = |extinction: (u32, u32)| HomogeneousSlab {
        length: 1.into(),
        extinction: Rational::from(extinction),
        emission: 1.into(),
    };
    let (there, said) = (slab((1, 2)), slab((5, 1)));
    let format = Native::<f64>::new();
    let liar = Even {
        slab: &said,
        nodes: Fresh::new(&there, format),
    };
    let nodes = Fresh::new(&said, format);
    for name in METHODS {
        if name.starts_with("preintegrated") || name == "simpson/simpson" {
            continue;
        }
        let method: Method = name.parse().unwrap();
        let radiance = method.radiance(&liar, 12).unwrap();
        assert_eq!(radiance, method.radiance(&nodes, 12).unwrap(), "{name}");
        assert_eq!(liar.nodes.evaluations(), 0, "{name}");
    }
}
