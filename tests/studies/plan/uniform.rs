//! The methods that know nothing of a scene: one rule, n equal segments.

use std::any::Any;
use std::str::FromStr;
use volver::case::{Case, Fresh, Structure, Transfer};
use volver::method::Method;
use volver::real::{Native, Real};
use volver::scene::{BoundPiece, Columns, Scene};

/// Rules of every order that renderers and numerical analysts use.
const METHODS: [&str; 12] = [
    "front-to-back/front/expm1",
    "front-to-back/middle/expm1",
    "front-to-back/back/expm1",
    "riemann-left/riemann-left",
    "trapezoid/trapezoid",
    "midpoint/midpoint",
    "simpson/simpson",
    "simpson-pairs-parabola/simpson",
    "simpson/boole",
    "gauss-2/simpson",
    "gauss-3/boole",
    "gauss-2/gauss-2",
];

/// A scene of one channel, in binary64.
pub(crate) struct Uniform<'s> {
    ray: Ray<'s>,
    methods: Vec<Method>,
}

#[derive(Debug)]
struct Ray<'s> {
    /// Where each piece ends.
    pieces: Vec<(f64, BoundPiece<'s, Native<f64>>)>,
    length: rug::Rational,
}

impl<'s> Uniform<'s> {
    pub(crate) fn new(scene: &'s Scene) -> Self {
        let pieces = scene.media().iter().flat_map(|medium| &medium.pieces);
        let pieces = pieces.map(|piece| (piece.to.to_f64(), BoundPiece::new(piece, Native::new())));
        let ray = Ray {
            pieces: pieces.collect(),
            length: scene.media().last().unwrap().to(),
        };
        let methods = METHODS.iter().map(|name| Method::from_str(name).unwrap());
        Uniform {
            ray,
            methods: methods.collect(),
        }
    }

    /// The fewest evaluations, up to a limit, with which one of the methods does well enough.
    pub(crate) fn cheapest(&self, limit: u64, is_enough: impl Fn(f64) -> bool) -> Option<u64> {
        let mut best = None;
        for method in &self.methods {
            for n in 1.. {
                if method.check_segments(n).is_err() {
                    continue;
                }
                let nodes = Fresh::new(&self.ray, Native::<f64>::new());
                let radiance = method.radiance(&nodes, n).unwrap();
                let cost = nodes.evaluations();
                if cost > best.unwrap_or(limit) {
                    break;
                }
                if is_enough(radiance) {
                    best = Some(cost);
                    break;
                }
            }
        }
        best
    }
}

impl Case for Ray<'_> {
    fn name(&self) -> &'static str {
        "ray"
    }

    fn length(&self) -> rug::Rational {
        self.length.clone()
    }

    fn field<R: Real>(&self, lambda: &R) -> R {
        lambda.clone()
    }

    fn transfer<R: Real>(&self, s: &R) -> Transfer<R> {
        // Uniform methods run in binary64 alone here.
        let lambda = *(s as &dyn Any).downcast_ref::<f64>().unwrap();
        let piece = self.pieces.partition_point(|(to, _)| *to <= lambda);
        let (_, piece) = &self.pieces[piece.min(self.pieces.len() - 1)];
        let mut columns = Columns::new(1);
        piece.evaluate(&[lambda], &mut columns);
        let value = |column: &[Vec<f64>]| {
            let value: &dyn Any = &column[0][0];
            value.downcast_ref::<R>().unwrap().clone()
        };
        Transfer {
            emission: value(&columns.emission),
            extinction: value(&columns.extinction),
        }
    }

    fn optical_depth<R: Real>(&self, _: &R) -> Option<R> {
        None
    }

    fn radiance<R: Real>(&self, _: &R) -> Option<R> {
        None
    }

    fn structure(&self) -> Structure {
        Structure::default()
    }
}
