//! Expressions as mathematics in LaTeX.

mod name;

use super::print::is_half;
use super::{Branch, Expr, Function, Kind, Relation};
use rug::Rational;

/// How tightly a piece of text holds together; looser text goes in parentheses.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Strength {
    Cases,
    Sum,
    Product,
    Power,
    Atom,
}

impl Expr {
    /// The expression in LaTeX, for mathematics mode with `amsmath` (or `KaTeX`, or `MathJax`).
    ///
    /// ```
    /// use volver::symbolic::Expr;
    ///
    /// let transmittance: Expr = "exp(-sin(lambda^2)/2)".parse()?;
    /// assert_eq!(
    ///     transmittance.to_latex(),
    ///     r"e^{-\frac{\sin\left(\lambda^{2}\right)}{2}}"
    /// );
    /// # Ok::<(), volver::symbolic::ParseError>(())
    /// ```
    #[must_use]
    pub fn to_latex(&self) -> String {
        // Beside a variable that is itself called e, e² must not stand for exp 2.
        let writer = Writer {
            exp_by_name: self.contains("e"),
        };
        writer.text(self)
    }
}

/// How things are written in one expression.
#[derive(Clone, Copy)]
struct Writer {
    exp_by_name: bool,
}

impl Writer {
    fn strength(self, expr: &Expr) -> Strength {
        match expr.kind() {
            Kind::Piecewise(..) => Strength::Cases,
            Kind::Sum(_) => Strength::Sum,
            Kind::Number(q) if *q < 0 => Strength::Sum,
            Kind::Number(q) if *q.denom() != 1 => Strength::Product,
            Kind::Product(factors) => match factors.first().and_then(Expr::as_number) {
                Some(q) if *q < 0 => Strength::Sum,
                _ => Strength::Product,
            },
            Kind::Power(_, exponent) if *exponent < 0 => Strength::Product,
            Kind::Power(_, exponent) if !is_half(exponent) => Strength::Power,
            Kind::Call(Function::Exp, _) if !self.exp_by_name => Strength::Power,
            _ => Strength::Atom,
        }
    }

    fn at(self, expr: &Expr, least: Strength) -> String {
        let text = self.text(expr);
        if self.strength(expr) < least {
            parentheses(&text)
        } else {
            text
        }
    }

    fn text(self, expr: &Expr) -> String {
        match expr.kind() {
            Kind::Number(q) => number(q),
            Kind::Pi => r"\pi".into(),
            Kind::Symbol(symbol) => name::symbol(symbol),
            Kind::Sum(terms) => self.sum(terms),
            Kind::Product(factors) => self.product(factors),
            Kind::Power(base, exponent) if *exponent < 0 => {
                let denominator = self.power(base, &Rational::from(-exponent));
                fraction("1", &denominator)
            }
            Kind::Power(base, exponent) => self.power(base, exponent),
            Kind::Call(function, argument) => self.call(*function, &self.text(argument)),
            Kind::Min(a, b) => self.pair(r"\min", a, b),
            Kind::Max(a, b) => self.pair(r"\max", a, b),
            Kind::Piecewise(branches, otherwise) => self.cases(branches, otherwise),
        }
    }

    fn sum(self, terms: &[Expr]) -> String {
        let mut text = String::new();
        for (i, term) in terms.iter().enumerate() {
            if i == 0 {
                text += &self.at(term, Strength::Sum);
            } else if self.strength(term) == Strength::Sum {
                // Only a minus sign in front makes a term so loose: sums in sums are flat.
                text += " - ";
                text += &self.at(&-term, Strength::Product);
            } else {
                text += " + ";
                text += &self.at(term, Strength::Product);
            }
        }
        text
    }

    /// A product as one fraction: what has negative exponents, and the denominator of the number, below.
    fn product(self, factors: &[Expr]) -> String {
        let (coefficient, factors) = match factors {
            [first, rest @ ..] => match first.as_number() {
                Some(q) => (q.clone(), rest),
                None => (Rational::from(1), factors),
            },
            [] => (Rational::from(1), factors),
        };
        let (mut above, mut below) = (Vec::new(), Vec::new());
        for factor in factors {
            match factor.kind() {
                Kind::Power(base, exponent) if *exponent < 0 => {
                    below.push(base.pow(Rational::from(-exponent)));
                }
                _ => above.push(factor.clone()),
            }
        }
        let (numerator, denominator) = coefficient.clone().abs().into_numer_denom();
        if numerator != 1 || above.is_empty() {
            above.insert(0, Expr::number(numerator));
        }
        if denominator != 1 {
            below.insert(0, Expr::number(denominator));
        }
        let sign = if coefficient < 0 { "-" } else { "" };
        if below.is_empty() {
            // A single factor stands alone only behind a sign.
            return format!("{sign}{}", self.factors(&above, Strength::Product));
        }
        let above = self.factors(&above, Strength::Cases);
        let below = self.factors(&below, Strength::Cases);
        format!("{sign}{}", fraction(&above, &below))
    }

    /// Factors side by side; one that is `alone` needs no parentheses from that strength on.
    fn factors(self, factors: &[Expr], alone: Strength) -> String {
        if let [factor] = factors {
            return self.at(factor, alone);
        }
        let mut text = String::new();
        for factor in factors {
            let factor = self.at(factor, Strength::Power);
            if !text.is_empty() {
                let number = factor.starts_with(|c: char| c.is_ascii_digit());
                text += if number { r" \cdot " } else { " " };
            }
            text += &factor;
        }
        text
    }

    /// A power with an exponent ≥ 0.
    fn power(self, base: &Expr, exponent: &Rational) -> String {
        if is_half(exponent) {
            return format!(r"\sqrt{{{}}}", self.text(base));
        }
        if *exponent == 1 {
            return self.text(base);
        }
        format!("{}^{{{}}}", self.at(base, Strength::Atom), number(exponent))
    }

    fn call(self, function: Function, argument: &str) -> String {
        match function {
            Function::Exp if !self.exp_by_name => format!("e^{{{argument}}}"),
            Function::Abs => format!(r"\left|{argument}\right|"),
            Function::Exp
            | Function::Ln
            | Function::Sin
            | Function::Cos
            | Function::Tan
            | Function::Sinh
            | Function::Cosh
            | Function::Tanh => format!(r"\{function}{}", parentheses(argument)),
            Function::Atan => format!(r"\arctan{}", parentheses(argument)),
            Function::Erf => format!(r"\operatorname{{erf}}{}", parentheses(argument)),
        }
    }

    fn pair(self, function: &str, a: &Expr, b: &Expr) -> String {
        let arguments = format!("{}, {}", self.text(a), self.text(b));
        format!("{function}{}", parentheses(&arguments))
    }

    fn cases(self, branches: &[Branch], otherwise: &Expr) -> String {
        let mut text = String::from(r"\begin{cases} ");
        for Branch { condition, value } in branches {
            let relation = match condition.relation {
                Relation::Less => "<",
                Relation::LessEqual => r"\le",
                Relation::Greater => ">",
                Relation::GreaterEqual => r"\ge",
            };
            let left = self.at(&condition.left, Strength::Sum);
            let right = self.at(&condition.right, Strength::Sum);
            let value = self.text(value);
            text.extend([&value, ", & ", &left, " ", relation, " ", &right, r" \\ "]);
        }
        text + &self.text(otherwise) + r", & \text{otherwise} \end{cases}"
    }
}

fn number(q: &Rational) -> String {
    if *q.denom() == 1 {
        return q.to_string();
    }
    let sign = if *q < 0 { "-" } else { "" };
    let numerator = q.numer().as_abs().to_string();
    format!("{sign}{}", fraction(&numerator, &q.denom().to_string()))
}

fn fraction(above: &str, below: &str) -> String {
    format!(r"\frac{{{above}}}{{{below}}}")
}

fn parentheses(text: &str) -> String {
    format!(r"\left({text}\right)")
}
