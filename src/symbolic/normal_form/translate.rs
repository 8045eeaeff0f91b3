//! From expressions to polynomials.

use super::arena::{Arena, Atom, Result, Stop};
use super::coefficient::Coefficient;
use super::polynomial::{Accumulator, Polynomial};
use super::ratio::Ratio;
use crate::symbolic::hash::{HashMap, HashSet};
use crate::symbolic::{Expr, Function, Kind};

/// The polynomials of the parts that are translated already.
type Values<'e> = HashMap<&'e Expr, Polynomial>;

/// A factor of a product, the power of it, and whether it is divided by on the way: x is in (1/x)⁻¹.
struct Operand<'e> {
    base: &'e Expr,
    power: Ratio,
    divides: bool,
}

/// The polynomial of an expression without branches, `nodes` being all in it, parts first.
///
/// # Errors
/// `Stop` where it divides by 0, or is too large for the budget.
pub fn translate(expr: &Expr, nodes: &[&Expr], arena: &mut Arena) -> Result<Polynomial> {
    let mut products: HashMap<&Expr, Vec<Operand<'_>>> = HashMap::default();
    // Products that only occur in products aren't worked out: 1/(ab) is 1/a · 1/b.
    let mut used: HashSet<&Expr> = HashSet::from_iter([expr]);
    for node in nodes.iter().rev() {
        if !used.contains(node) {
            continue;
        }
        if is_product(node) {
            let operands = operands(node, arena)?;
            used.extend(operands.iter().map(|operand| operand.base));
            products.insert(node, operands);
        } else {
            used.extend(node.parts());
        }
    }
    let mut values = Values::default();
    for node in nodes.iter().filter(|node| used.contains(*node)) {
        let value = match products.get(node) {
            Some(operands) => product(operands, &values, arena)?,
            None => of_node(node, &values, arena)?,
        };
        values.insert(node, value);
    }
    Ok(values.remove(expr).unwrap_or_default())
}

fn is_product(expr: &Expr) -> bool {
    match expr.kind() {
        Kind::Product(_) => true,
        Kind::Power(_, e) => e.is_integer(),
        _ => false,
    }
}

/// The factors of nested products and integer powers, each once: x · x⁻¹ has x⁰.
fn operands<'e>(expr: &'e Expr, arena: &mut Arena) -> Result<Vec<Operand<'e>>> {
    let mut found: Vec<Operand<'e>> = Vec::new();
    let mut places: HashMap<&Expr, usize> = HashMap::default();
    let mut open = vec![Operand {
        base: expr,
        power: Ratio::ONE,
        divides: false,
    }];
    while let Some(operand) = open.pop() {
        arena.spend(1)?;
        let Operand {
            base,
            power,
            divides,
        } = operand;
        match base.kind() {
            Kind::Product(factors) => open.extend(factors.iter().map(|base| Operand {
                base,
                power: power.clone(),
                divides,
            })),
            Kind::Power(base, e) if e.is_integer() => open.push(Operand {
                base,
                power: power.mul(&Ratio::from(e.clone())),
                divides: divides || *e < 0,
            }),
            _ => {
                if let Some(known) = places.get(base).and_then(|place| found.get_mut(*place)) {
                    known.power = known.power.add(&power);
                    known.divides |= divides;
                } else {
                    places.insert(base, found.len());
                    found.push(Operand {
                        base,
                        power,
                        divides,
                    });
                }
            }
        }
    }
    Ok(found)
}

fn product(operands: &[Operand<'_>], values: &Values<'_>, arena: &mut Arena) -> Result<Polynomial> {
    let mut result = Polynomial::one();
    for operand in operands {
        let base = value(values, operand.base);
        if operand.divides && arena.clear(&base)?.0.is_zero() {
            return Err(Stop::DivisionByZero);
        }
        let power = arena.integer_power(&base, &operand.power)?;
        result = arena.multiply(&result, &power)?;
    }
    Ok(result)
}

fn value(values: &Values<'_>, expr: &Expr) -> Polynomial {
    values.get(expr).cloned().unwrap_or_default()
}

/// The polynomial of anything but a product, its parts being translated already.
fn of_node(node: &Expr, values: &Values<'_>, arena: &mut Arena) -> Result<Polynomial> {
    match node.kind() {
        Kind::Number(q) => {
            let q = Ratio::from(q.clone());
            Ok(Polynomial::constant(Coefficient::real(q)))
        }
        Kind::Pi => arena.of_atom(Atom::Pi),
        Kind::Symbol(name) => arena.of_atom(Atom::Symbol(name.clone())),
        Kind::Sum(terms) => {
            let mut sum = Accumulator::default();
            for term in terms {
                let term = value(values, term);
                arena.spend(term.len() as u64)?;
                sum.add_scaled(&term, &Coefficient::ONE);
                Arena::check_terms(sum.len())?;
            }
            Ok(sum.finish())
        }
        Kind::Power(base, e) => arena.power(&value(values, base), &Ratio::from(e.clone())),
        Kind::Call(function, argument) => call(*function, &value(values, argument), arena),
        // Products and branches are dealt with before.
        Kind::Product(_) | Kind::Min(..) | Kind::Max(..) | Kind::Piecewise(..) => {
            Err(Stop::TooLarge)
        }
    }
}

fn call(function: Function, p: &Polynomial, arena: &mut Arena) -> Result<Polynomial> {
    match function {
        Function::Exp => arena.exp(p),
        Function::Ln => arena.ln(p),
        Function::Abs => arena.abs(p),
        Function::Atan => arena.odd(p, Atom::Atan),
        Function::Erf => arena.odd(p, Atom::Erf),
        Function::Sin
        | Function::Cos
        | Function::Tan
        | Function::Sinh
        | Function::Cosh
        | Function::Tanh => arena.euler(function, p),
    }
}
