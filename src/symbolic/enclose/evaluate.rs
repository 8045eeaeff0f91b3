//! One evaluation in intervals: each different node once, and only those that are needed.

use crate::symbolic::hash::HashMap;
use crate::symbolic::interval::{Interval, Undefined};
use crate::symbolic::{Branch, Condition, Expr, Function, Kind, Relation};
use std::rc::Rc;

/// Where and why an evaluation stops.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Fault<'e> {
    Unknown(&'e str),
    NotDefined { part: &'e Expr, certain: bool },
}

impl Fault<'_> {
    /// Whether the expression is defined nowhere.
    pub(crate) fn is_certain(self) -> bool {
        matches!(self, Fault::NotDefined { certain: true, .. })
    }
}

type Outcome<'e> = Result<Rc<Interval>, Fault<'e>>;

/// Encloses expressions over one box.
pub(crate) struct Evaluator<'e, 'v> {
    bits: u32,
    value: &'v dyn Fn(&str) -> Option<Interval>,
    /// Failures too: a part that fails may occur exponentially often.
    known: HashMap<&'e Expr, Outcome<'e>>,
    united: bool,
    /// Whether roots may ignore what is below 0, and whether one did.
    clamps: bool,
    clamped: bool,
}

impl<'e, 'v> Evaluator<'e, 'v> {
    pub(crate) fn new(bits: u32, value: &'v dyn Fn(&str) -> Option<Interval>) -> Self {
        Evaluator {
            bits,
            value,
            known: HashMap::default(),
            united: false,
            clamps: false,
            clamped: false,
        }
    }

    /// Takes positive fractional powers of the part of a base that is ≥ 0, for callers who then prove
    /// that there is nothing else.
    pub(crate) fn clamping(mut self) -> Self {
        self.clamps = true;
        self
    }

    /// Whether the result only holds where all bases of fractional powers are ≥ 0.
    pub(crate) fn is_clamped(&self) -> bool {
        self.clamped
    }

    /// Whether branches had to be united, so that the expression may jump inside the box. Otherwise an
    /// expression with an enclosure is continuous on the box, being made of continuous functions.
    pub(crate) fn may_jump(&self) -> bool {
        self.united
    }

    /// How many different nodes have been evaluated.
    pub(crate) fn work(&self) -> usize {
        self.known.len()
    }

    pub(crate) fn enclose(&mut self, expr: &'e Expr) -> Outcome<'e> {
        if let Some(outcome) = self.known.get(expr) {
            return outcome.clone();
        }
        let outcome = self.node(expr);
        self.known.insert(expr, outcome.clone());
        outcome
    }

    fn node(&mut self, expr: &'e Expr) -> Outcome<'e> {
        let defined = |result: Result<Interval, Undefined>| match result {
            Ok(interval) => Ok(Rc::new(interval)),
            Err(undefined) => Err(Fault::NotDefined {
                part: expr,
                certain: undefined == Undefined::Certainly,
            }),
        };
        match expr.kind() {
            Kind::Number(q) => Ok(Rc::new(Interval::point(self.bits, q))),
            Kind::Pi => Ok(Rc::new(Interval::pi(self.bits))),
            Kind::Symbol(name) => match (self.value)(name) {
                Some(interval) => Ok(Rc::new(interval)),
                None => Err(Fault::Unknown(name)),
            },
            Kind::Sum(terms) => self.fold(terms, |a, b| a + b),
            Kind::Product(factors) => self.fold(factors, |a, b| a * b),
            Kind::Power(base, exponent) => {
                let base = self.enclose(base)?;
                let power = base.pow(exponent);
                if self.clamps && power == Err(Undefined::Possibly) && *exponent > 0 {
                    self.clamped = true;
                    return defined(
                        base.nonnegative_part()
                            .unwrap_or(base.as_ref().clone())
                            .pow(exponent),
                    );
                }
                defined(power)
            }
            Kind::Call(function, argument) => {
                let x = self.enclose(argument)?;
                defined(call(*function, &x))
            }
            Kind::Min(a, b) => self.fold([a, b], Interval::min),
            Kind::Max(a, b) => self.fold([a, b], Interval::max),
            Kind::Piecewise(branches, otherwise) => self.piecewise(branches, otherwise),
        }
    }

    /// Combines parts that are all needed. A part that is certainly not defined counts for more than
    /// one that may not be.
    fn fold(
        &mut self,
        parts: impl IntoIterator<Item = &'e Expr>,
        combine: impl Fn(&Interval, &Interval) -> Interval,
    ) -> Outcome<'e> {
        let mut result: Option<Rc<Interval>> = None;
        let mut doubt = None;
        for part in parts {
            match self.enclose(part) {
                Ok(value) => {
                    result = Some(match result {
                        Some(so_far) => Rc::new(combine(&so_far, &value)),
                        None => value,
                    });
                }
                Err(fault @ Fault::NotDefined { certain: false, .. }) => {
                    doubt.get_or_insert(fault);
                }
                Err(fault) => return Err(fault),
            }
        }
        match (doubt, result) {
            (Some(fault), _) => Err(fault),
            (None, Some(result)) => Ok(result),
            // Sums and products have parts.
            (None, None) => Ok(Rc::new(Interval::entire(self.bits))),
        }
    }

    fn piecewise(&mut self, branches: &'e [Branch], otherwise: &'e Expr) -> Outcome<'e> {
        let mut possible: Vec<&'e Expr> = Vec::new();
        let mut last = Some(otherwise);
        for branch in branches {
            match self.holds(&branch.condition) {
                Ok(Some(false)) => {}
                Ok(Some(true)) => {
                    last = Some(&branch.value);
                    break;
                }
                Ok(None) => possible.push(&branch.value),
                // An earlier branch may be taken, so that this condition is not needed.
                Err(fault) => return Err(self.unless_taken(fault, &possible)),
            }
        }
        possible.extend(last.take());
        possible.dedup();
        if let [taken] = possible[..] {
            return self.enclose(taken);
        }
        self.united = true;
        let mut union: Option<Interval> = None;
        for (place, branch) in possible.iter().enumerate() {
            match self.enclose(branch) {
                Ok(value) => {
                    union = Some(match union {
                        Some(so_far) => so_far.union(&value),
                        None => value.as_ref().clone(),
                    });
                }
                Err(fault) => {
                    let others: Vec<&Expr> = [&possible[..place], &possible[place + 1..]].concat();
                    return Err(self.unless_taken(fault, &others));
                }
            }
        }
        Ok(Rc::new(
            union.unwrap_or_else(|| Interval::entire(self.bits)),
        ))
    }

    /// The fault of one branch, certain only where each of the `others` that may be taken certainly has
    /// one too.
    fn unless_taken(&mut self, fault: Fault<'e>, others: &[&'e Expr]) -> Fault<'e> {
        match fault {
            Fault::NotDefined {
                part,
                certain: true,
            } => {
                let certain = others
                    .iter()
                    .all(|other| matches!(self.enclose(other), Err(fault) if fault.is_certain()));
                Fault::NotDefined { part, certain }
            }
            fault => fault,
        }
    }

    /// Whether the condition holds on the whole box or nowhere on it.
    fn holds(&mut self, condition: &'e Condition) -> Result<Option<bool>, Fault<'e>> {
        let Condition {
            left,
            relation,
            right,
        } = condition;
        let (a, b) = (self.enclose(left)?, self.enclose(right)?);
        if let (Some(p), Some(q)) = (left.as_number(), right.as_number()) {
            return Ok(Some(relation.holds(p, q)));
        }
        if left == right {
            return Ok(Some(relation.holds(&0, &0)));
        }
        let (always, never) = match relation {
            Relation::Less => (a.upper() < b.lower(), a.lower() >= b.upper()),
            Relation::LessEqual => (a.upper() <= b.lower(), a.lower() > b.upper()),
            Relation::Greater => (a.lower() > b.upper(), a.upper() <= b.lower()),
            Relation::GreaterEqual => (a.lower() >= b.upper(), a.upper() < b.lower()),
        };
        Ok((always || never).then_some(always))
    }
}

/// A function of an interval.
fn call(function: Function, x: &Interval) -> Result<Interval, Undefined> {
    Ok(match function {
        Function::Exp => x.exp(),
        Function::Ln => x.ln()?,
        Function::Sin => x.sin(),
        Function::Cos => x.cos(),
        Function::Tan => x.tan()?,
        Function::Sinh => x.sinh(),
        Function::Cosh => x.cosh(),
        Function::Tanh => x.tanh(),
        Function::Atan => x.atan(),
        Function::Erf => x.erf(),
        Function::Abs => x.abs(),
    })
}
