//! A rule as a function in C.

use super::program::{Function, Statement, expressions, mentions, radiance};
use super::{Place, Rule, Scheme};
use std::fmt::Write as _;

/// Names of integers; all others are of doubles.
const INTEGERS: [&str; 11] = [
    "i", "k", "count", "begin", "end", "more", "wall", "ended", "size", "times", "copy",
];

/// A number rounded to so many significant bits.
const ROUNDED: &str = "\
static double rounded(double x, int bits)
{
    int e;
    double m = frexp(x, &e);
    return ldexp(rint(ldexp(m, bits)), e - bits);
}

";

/// ∫₀¹ (1 − e^(−y)) du, y = a u + (b − a) u²/2: Gauss's rule of 5 points on parts of depth ½ or less.
const LINEAR: &str = "\
static double linear(double a, double b)
{
    static const double x[5] = {0.04691007703066800, 0.23076534494715845, 0.5,
                                0.76923465505284155, 0.95308992296933200};
    static const double w[5] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                0.23931433524968324, 0.11846344252809454};
    int parts = 4 + (int)(2 * (a + b));
    double sum = 0.0;
    for (int j = 0; j < parts; j++) {
        for (int k = 0; k < 5; k++) {
            double u = (j + x[k]) / parts;
            sum -= w[k] / parts * expm1(-u * (a + (b - a) * u / 2));
        }
    }
    return sum;
}

";

/// C's source.
#[derive(Default)]
struct Source {
    text: String,
    depth: usize,
}

impl Source {
    fn line(&mut self, line: &str) {
        for _ in 0..self.depth {
            self.text.push_str("    ");
        }
        self.text.push_str(line);
        self.text.push('\n');
    }

    fn body(&mut self, body: &[Statement]) {
        self.depth += 1;
        for statement in body {
            self.statement(statement);
        }
        self.depth -= 1;
    }

    fn statement(&mut self, statement: &Statement) {
        match statement {
            Statement::Set(name, value) => self.line(&format!("{name} = {value};")),
            Statement::Change(name, op, value) => self.line(&format!("{name} {op}= {value};")),
            Statement::If(condition, then, otherwise) => {
                let condition = condition.replace(" and ", " && ").replace(" or ", " || ");
                if then.is_empty() {
                    self.line(&format!("if (!({condition})) {{"));
                    self.body(otherwise);
                } else {
                    self.line(&format!("if ({condition}) {{"));
                    self.body(then);
                }
                if !then.is_empty() && !otherwise.is_empty() {
                    self.line("} else {");
                    self.body(otherwise);
                }
                self.line("}");
            }
            Statement::For(range, body) => {
                let (name, from, to) = (range.name, &range.from, &range.to);
                self.line(&if range.backwards {
                    format!("for ({name} = {to} - 1; {name} >= {from}; {name}--) {{")
                } else {
                    format!("for ({name} = {from}; {name} < {to}; {name}++) {{")
                });
                self.body(body);
                self.line("}");
            }
            Statement::Break => self.line("break;"),
            Statement::Return(value) => self.line(&format!("return {value};")),
            Statement::Note(words) => self.line(&format!("/* {words} */")),
        }
    }

    /// A function's body, with the variables that it sets declared at its head.
    fn function(&mut self, body: &[Statement], parameter: &str) {
        // What it begins with is set where it is declared.
        let is_literal = |statement: &&Statement| match statement {
            Statement::Set(_, value) => value.parse::<f64>().is_ok(),
            _ => false,
        };
        let at_head = body.iter().take_while(is_literal).count();
        let (head, rest) = body.split_at(at_head);
        let mut names = Vec::new();
        set_names(body, &mut names);
        names.retain(|name| *name != parameter);
        let declared = |name: &str| {
            let value = head.iter().find_map(|statement| match statement {
                Statement::Set(set, value) if *set == name => Some(value),
                _ => None,
            });
            value.map_or_else(|| name.into(), |value| format!("{name} = {value}"))
        };
        let (integers, numbers): (Vec<&str>, Vec<&str>) =
            names.into_iter().partition(|name| INTEGERS.contains(name));
        for (kind, names) in [("int", integers), ("double", numbers)] {
            if !names.is_empty() {
                let names: Vec<String> = names.into_iter().map(declared).collect();
                self.line(&format!("    {kind} {};", names.join(", ")));
            }
        }
        self.body(rest);
        self.line("}");
    }
}

/// Each name once, in the order in which they are set.
fn set_names<'a>(body: &'a [Statement], names: &mut Vec<&'a str>) {
    let add = |name: &'a str, names: &mut Vec<&'a str>| {
        if !names.contains(&name) {
            names.push(name);
        }
    };
    for statement in body {
        match statement {
            Statement::Set(name, _) | Statement::Change(name, _, _) => add(name, names),
            Statement::If(_, then, otherwise) => {
                set_names(then, names);
                set_names(otherwise, names);
            }
            Statement::For(range, body) => {
                add(range.name, names);
                set_names(body, names);
            }
            Statement::Break | Statement::Return(_) | Statement::Note(_) => {}
        }
    }
}

impl Rule {
    /// A function of C99 that needs no more than `math.h`: the answer of one channel, whatever the rule with the
    /// same parameters. Where channels have changed places ([`super::Channels`]) the caller has to change them.
    #[must_use]
    pub fn c(&self) -> String {
        let (emission, body) = radiance(self);
        let mut source = Source::default();
        source.line("#include <math.h>\n");
        let uses = |name: &str| expressions(&body).iter().any(|e| mentions(e, name));
        for (name, helper) in [("rounded", ROUNDED), ("linear", LINEAR)] {
            if uses(name) {
                source.text.push_str(helper);
            }
        }
        if let Some(Function {
            name,
            parameter,
            body,
        }) = &emission
        {
            source.line(&format!("static double {name}(double {parameter})\n{{"));
            source.function(body, parameter);
            source.line("");
        }
        source.line("/* lam: the n + 1 ends of segments; tau, C: extinction and emission there and in the n middles */");
        source.line("double radiance(const double *lam, const double *tau_edges, const double *tau_middles,");
        source.line("                const double *C_edges, const double *C_middles, int n, double step)\n{");
        if let Scheme::Sample { place, .. } = self.scheme {
            let at = if place == Place::Middle {
                "middles"
            } else {
                "edges"
            };
            let mut arrays = Vec::new();
            for name in ["tau", "C"] {
                if uses(name) {
                    arrays.push(format!("*{name} = {name}_{at}"));
                }
            }
            if !arrays.is_empty() {
                let mut line = String::from("    const double ");
                let _ = write!(line, "{};", arrays.join(", "));
                source.line(&line);
            }
        }
        source.function(&body, "");
        source.text
    }
}
