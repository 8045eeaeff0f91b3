//! A rule as a program in Python, which is a kernel beside `volver_kernel.py`.

use super::program::{Function, Statement, expressions, mentions, radiance};
use super::{Channels, Place, Rule, Scheme};

/// What Python's `math` has of what programs call.
const FUNCTIONS: [&str; 8] = [
    "exp", "expm1", "floor", "frexp", "ldexp", "log", "pow", "sqrt",
];

/// A number rounded to so many significant bits.
const ROUNDED: &str = "\
def rounded(x, bits):
    m, e = frexp(x)
    return ldexp(round(ldexp(m, bits)), e - bits)
";

/// ∫₀¹ (1 − e^(−y)) du, y = a u + (b − a) u²/2: Gauss's rule of 5 points on parts of depth ½ or less.
const LINEAR: &str = "\
GAUSS = [
    (0.04691007703066800, 0.11846344252809454),
    (0.23076534494715845, 0.23931433524968324),
    (0.5, 0.28444444444444444),
    (0.76923465505284155, 0.23931433524968324),
    (0.95308992296933200, 0.11846344252809454),
]


def linear(a, b):
    parts = 4 + int(2 * (a + b))
    points = [((j + x) / parts, w / parts) for j in range(parts) for x, w in GAUSS]
    return sum(-w * expm1(-u * (a + (b - a) * u / 2)) for u, w in points)
";

/// Python's source.
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

    fn block(&mut self, head: &str, body: &[Statement]) {
        self.line(head);
        self.depth += 1;
        for statement in body {
            self.statement(statement);
        }
        self.depth -= 1;
    }

    fn statement(&mut self, statement: &Statement) {
        match statement {
            Statement::Set(name, value) => self.line(&format!("{name} = {value}")),
            Statement::Change(name, op, value) => self.line(&format!("{name} {op}= {value}")),
            Statement::If(condition, then, otherwise) if then.is_empty() => {
                self.block(&format!("if not ({condition}):"), otherwise);
            }
            Statement::If(condition, then, otherwise) => {
                self.block(&format!("if {condition}:"), then);
                if !otherwise.is_empty() {
                    self.block("else:", otherwise);
                }
            }
            Statement::For(range, body) => {
                let mut all = if range.from == "0" {
                    format!("range({})", range.to)
                } else {
                    format!("range({}, {})", range.from, range.to)
                };
                if range.backwards {
                    all = format!("reversed({all})");
                }
                self.block(&format!("for {} in {all}:", range.name), body);
            }
            Statement::Break => self.line("break"),
            Statement::Return(value) => self.line(&format!("return {value}")),
            Statement::Note(words) => self.line(&format!("# {words}")),
        }
    }

    fn function(&mut self, head: &str, body: &[Statement]) {
        self.text.push_str("\n\n");
        self.block(head, body);
    }
}

impl Rule {
    /// A module with the function `render(task)`, which takes a task of the protocol in the form `segments` and
    /// returns the radiances: with `volver_kernel.serve` a kernel.
    #[must_use]
    pub fn python(&self) -> String {
        let (emission, body) = radiance(self);
        let mut functions = String::new();
        let uses = |name: &str| expressions(&body).iter().any(|e| mentions(e, name));
        for (name, helper) in [("rounded", ROUNDED), ("linear", LINEAR)] {
            if uses(name) {
                functions.push_str("\n\n");
                functions.push_str(helper);
            }
        }
        let mut source = Source::default();
        if let Some(Function {
            name,
            parameter,
            body,
        }) = &emission
        {
            source.function(&format!("def {name}({parameter}):"), body);
        }
        let parameters = self.python_parameters(&uses);
        source.function(&format!("def radiance({}):", parameters.join(", ")), &body);
        functions.push_str(&source.text);
        functions.push_str(&self.render(&parameters));
        let imported: Vec<&str> = FUNCTIONS
            .into_iter()
            .filter(|name| mentions(&functions, name))
            .collect();
        if imported.is_empty() {
            return functions.trim_start().into();
        }
        format!("from math import {}\n{functions}", imported.join(", "))
    }

    /// What `radiance` is given.
    fn python_parameters(&self, uses: &dyn Fn(&str) -> bool) -> Vec<&'static str> {
        let arrays: &[&str] = match self.scheme {
            Scheme::Sample { .. } => &["lam", "tau", "C"],
            Scheme::Segments { .. } => &["lam", "tau_edges", "tau_middles", "C_edges", "C_middles"],
        };
        let all = arrays.iter().chain(&["n", "step"]);
        all.copied().filter(|name| uses(name)).collect()
    }

    /// `render`, of `radiance`.
    fn render(&self, parameters: &[&str]) -> String {
        let mut source = Source::default();
        source.line("\n\ndef render(task):");
        source.depth = 1;
        let (at, names) = match self.scheme {
            Scheme::Sample { place, .. } => (place, ["tau", "C"]),
            Scheme::Segments { .. } => (Place::Front, ["tau_edges", "C_edges"]),
        };
        let at = if at == Place::Middle {
            "middles"
        } else {
            "edges"
        };
        source.line("data = task[\"data\"]");
        let has = |name: &str| parameters.contains(&name);
        let mut take = |name: &str, from: &str| {
            if has(name) {
                source.line(&format!("{name} = {from}"));
            }
        };
        take("lam", "data[\"edges\"][\"lambda\"]");
        take(names[0], &format!("data[\"{at}\"][\"extinction\"]"));
        take("tau_middles", "data[\"middles\"][\"extinction\"]");
        take("n", "task[\"segments\"]");
        take("step", "task[\"step\"]");
        let call = format!("radiance({})", parameters.join(", "));
        let of = |at: &str| format!("data[\"{at}\"][\"emission\"]");
        let channels = match (has(names[1]), has("C_middles")) {
            (true, false) => format!("{} in {}", names[1], of(at)),
            (false, true) => format!("C_middles in {}", of("middles")),
            (false, false) => "_ in task[\"channels\"]".into(),
            (true, true) => format!(
                "C_edges, C_middles in zip({}, {})",
                of("edges"),
                of("middles")
            ),
        };
        let answers = format!("[{call} for {channels}]");
        match self.channels {
            Channels::Straight => source.line(&format!("return {answers}")),
            Channels::Reversed => source.line(&format!("return {answers}[::-1]")),
            Channels::ReversedByThrees => {
                source.line(&format!("all = {answers}"));
                source.line("threes = [all[k : k + 3] for k in range(0, len(all), 3)]");
                source.line("return [one for three in threes for one in reversed(three)]");
            }
        }
        source.text
    }
}
