//! A function of one symbol: its values, its ranges, its derivatives.

use crate::symbolic::enclose::{Evaluator, mean_value};
use crate::symbolic::hash::HashMap;
use crate::symbolic::{EncloseError, Expr, Interval, Kind};
use rug::Rational;
use std::cell::OnceCell;

/// The precisions at which one number is looked at until its sign is clear.
const POINT_BITS: [u32; 3] = [64, 128, 256];
/// Larger expressions are not differentiated.
const MAX_NODES: usize = 400;
/// What differentiating all products may cost: a product of n factors has n terms of n factors.
const MAX_FACTORS: usize = 10_000;

/// How many more nodes may be evaluated.
pub(super) struct Budget(usize);

impl Budget {
    pub(super) fn new(nodes: usize) -> Budget {
        Budget(nodes)
    }

    pub(super) fn spend(&mut self, nodes: usize) {
        self.0 = self.0.saturating_sub(nodes);
    }

    pub(super) fn is_spent(&self) -> bool {
        self.0 == 0
    }
}

/// What is known of one number.
pub(super) enum Point {
    Value(Interval),
    NotDefined,
    Unclear,
}

/// What is known of an interval.
#[derive(Clone)]
pub(super) struct Range {
    pub(super) values: Interval,
    /// Nothing proves that the function is continuous.
    pub(super) may_jump: bool,
    /// It is defined only where the bases of its fractional powers are ≥ 0.
    pub(super) clamped: bool,
}

/// A function, with what is known of it.
pub(super) struct Curve {
    pub(super) expr: Expr,
    symbol: String,
    points: HashMap<Rational, Point>,
    latest: Option<(Interval, Option<Range>)>,
    derivative: OnceCell<Option<Box<Curve>>>,
}

impl Curve {
    pub(super) fn new(expr: Expr, symbol: &str) -> Curve {
        Curve {
            expr,
            symbol: symbol.to_owned(),
            points: HashMap::default(),
            latest: None,
            derivative: OnceCell::new(),
        }
    }

    /// What it is at one number: numbers are put in and folded first, so that exact zeros are.
    pub(super) fn at(&mut self, at: &Rational, budget: &mut Budget) -> &Point {
        let (expr, symbol) = (&self.expr, &self.symbol);
        self.points.entry(at.clone()).or_insert_with(|| {
            let there = expr.substitute(symbol, &Expr::number(at.clone()));
            value(&there, budget)
        })
    }

    /// What it is on an interval.
    pub(super) fn over(&mut self, range: &Interval, budget: &mut Budget) -> Option<Range> {
        if let Some((latest, known)) = &self.latest
            && latest == range
        {
            return known.clone();
        }
        let value = |name: &str| (*name == *self.symbol).then(|| range.clone());
        let mut evaluator = Evaluator::new(range.bits(), &value).clamping();
        let values = evaluator.enclose(&self.expr).ok();
        budget.spend(evaluator.work());
        let result = values.map(|values| Range {
            values: values.as_ref().clone(),
            may_jump: evaluator.may_jump(),
            clamped: evaluator.is_clamped(),
        });
        self.latest = Some((range.clone(), result.clone()));
        result
    }

    /// f(m) + slope·(X − m).
    pub(super) fn mean_value(
        &self,
        range: &Interval,
        slope: &Interval,
        budget: &mut Budget,
    ) -> Option<Interval> {
        budget.spend(10);
        mean_value(&self.expr, &self.symbol, range, slope)
    }

    /// Its derivative, unless that is too large.
    pub(super) fn derivative(&mut self) -> Option<&mut Curve> {
        let (expr, symbol) = (&self.expr, &self.symbol);
        self.derivative.get_or_init(|| {
            let derivative = may_differentiate(expr).then(|| expr.differentiate(symbol))?;
            Some(Box::new(Curve::new(derivative, symbol)))
        });
        self.derivative.get_mut()?.as_deref_mut()
    }
}

/// The value of an expression without symbols.
fn value(expr: &Expr, budget: &mut Budget) -> Point {
    let mut best = Point::Unclear;
    for bits in POINT_BITS {
        let mut evaluator = Evaluator::new(bits, &|_| None);
        let result = evaluator.enclose(expr);
        // Putting the number in costs about as much as evaluating.
        budget.spend(2 * evaluator.work());
        match result {
            Ok(value) => {
                let clear = !value.contains_zero() || value.is_zero();
                best = Point::Value(value.as_ref().clone());
                if clear {
                    break;
                }
            }
            Err(fault) => match EncloseError::from(fault) {
                EncloseError::NotDefined { certain: true, .. } => return Point::NotDefined,
                EncloseError::NotDefined { certain: false, .. } => {}
                EncloseError::UnknownSymbol { .. } => return Point::Unclear,
            },
        }
    }
    best
}

/// Whether the derivative is of reasonable size.
fn may_differentiate(expr: &Expr) -> bool {
    let nodes = expr.nodes();
    let factors = nodes.iter().map(|node| match node.kind() {
        Kind::Product(factors) => factors.len().saturating_mul(factors.len()),
        _ => 0,
    });
    nodes.len() <= MAX_NODES && factors.fold(0, usize::saturating_add) <= MAX_FACTORS
}
