//! The methods that know nothing of a scene: one rule, n equal segments.

use std::any::Any;
use std::cell::RefCell;
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
    methods: Vec<Runs>,
}

/// A method and what it gave so far, whatever the tolerance that was searched for.
struct Runs {
    method: Method,
    /// For every n that suits it, from 1 on.
    runs: RefCell<Vec<Run>>,
}

/// One number of segments.
#[derive(Clone, Copy)]
struct Run {
    n: u64,
    radiance: f64,
    /// Evaluations.
    cost: u64,
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
        let methods = METHODS.iter().map(|name| Runs {
            method: Method::from_str(name).unwrap(),
            runs: RefCell::default(),
        });
        Uniform {
            ray,
            methods: methods.collect(),
        }
    }

    /// The fewest evaluations, up to a limit, with which one of the methods does well enough.
    pub(crate) fn cheapest(&self, limit: u64, is_enough: impl Fn(f64) -> bool) -> Option<u64> {
        let mut best = None;
        for method in &self.methods {
            for index in 0.. {
                let run = method.run(index, &self.ray);
                if run.cost > best.unwrap_or(limit) {
                    break;
                }
                if is_enough(run.radiance) {
                    best = Some(run.cost);
                    break;
                }
            }
        }
        best
    }
}

impl Runs {
    /// That of the suitable number of segments with that index, asked for one after the other.
    fn run(&self, index: usize, ray: &Ray<'_>) -> Run {
        let mut runs = self.runs.borrow_mut();
        if let Some(run) = runs.get(index) {
            return *run;
        }
        let first = runs.last().map_or(1, |run| run.n + 1);
        let mut suitable = (first..).filter(|n| self.method.check_segments(*n).is_ok());
        let n = suitable.next().unwrap();
        let nodes = Fresh::new(ray, Native::<f64>::new());
        let radiance = self.method.radiance(&nodes, n).unwrap();
        let cost = nodes.evaluations();
        let run = Run { n, radiance, cost };
        runs.push(run);
        run
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
        let mut one = self.transfers(std::slice::from_ref(s));
        Transfer {
            emission: one.emission.remove(0),
            extinction: one.extinction.remove(0),
        }
    }

    const IN_ROWS: bool = true;

    fn transfers<R: Real>(&self, s: &[R]) -> Transfer<Vec<R>> {
        // Uniform methods run in binary64 alone here.
        let lambda = s
            .iter()
            .map(|s| *(s as &dyn Any).downcast_ref::<f64>().unwrap());
        let lambda: Vec<f64> = lambda.collect();
        let piece = |lambda: f64| {
            let piece = self.pieces.partition_point(|(to, _)| *to <= lambda);
            piece.min(self.pieces.len() - 1)
        };
        let mut columns = Columns::new(1);
        for row in lambda.chunk_by(|a, b| piece(*a) == piece(*b)) {
            self.pieces[piece(row[0])].1.evaluate(row, &mut columns);
        }
        let values = |column: &mut Vec<Vec<f64>>| {
            let values: Box<dyn Any> = Box::new(column.remove(0));
            *values.downcast::<Vec<R>>().unwrap()
        };
        Transfer {
            emission: values(&mut columns.emission),
            extinction: values(&mut columns.extinction),
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
