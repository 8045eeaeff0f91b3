//! Source code of a medium that is linear between knots: its values in arrays, and a search among them.

use crate::kernel::Samples;
use crate::symbolic::code::Language;
use std::fmt::Write;

/// Defines `LENGTH`, `field(lambda)` = λ, `extinction(s)` and for every channel `emission_CHANNEL(s)`.
pub(super) fn source(
    language: Language,
    length: f64,
    knots: &Samples,
    channels: &[String],
) -> String {
    let of = match language {
        Language::Python => &PYTHON,
        Language::C => &C,
        Language::Rust => &RUST,
    };
    let count = knots.lambda.len();
    let mut code = of.head(length, count, &knots.lambda);
    code += &of.function("extinction", &knots.extinction);
    for (channel, values) in channels.iter().zip(&knots.emission) {
        code += &of.function(&format!("emission_{channel}"), values);
    }
    code
}

/// What a language says it with; `@` stands for what differs.
struct Words {
    /// Before the arrays.
    prologue: &'static str,
    length: &'static str,
    /// Of the knots, then of the values of one function.
    array: &'static str,
    search: &'static str,
    function: &'static str,
}

const PYTHON: Words = Words {
    prologue: "import bisect\n\n",
    length: "LENGTH = @\n",
    array: "_@ = [#]\n",
    search: "

def field(lambda_: float) -> float:
    return lambda_


def _between(values, s: float) -> float:
    i = bisect.bisect_right(_knots, s)
    if i == 0:
        return values[0]
    if i == len(_knots):
        return values[-1]
    near, far = values[i - 1], values[i]
    return near + (far - near) * ((s - _knots[i - 1]) / (_knots[i] - _knots[i - 1]))

",
    function: "

def @(s: float) -> float:
    return _between(_@, s)

",
};

const C: Words = Words {
    prologue: "",
    length: "const double LENGTH = @;\n",
    array: "static const double values_@[COUNT] = {#};\n",
    search: "
double field(double lambda) {
    return lambda;
}

static double between_knots(const double *values, double s) {
    int low = 0, high = COUNT;
    while (low < high) {
        int middle = (low + high) / 2;
        if (values_knots[middle] <= s)
            low = middle + 1;
        else
            high = middle;
    }
    if (low == 0)
        return values[0];
    if (low == COUNT)
        return values[COUNT - 1];
    const double from = values_knots[low - 1], to = values_knots[low];
    return values[low - 1] + (values[low] - values[low - 1]) * ((s - from) / (to - from));
}
",
    function: "
double @(double s) {
    return between_knots(values_@, s);
}
",
};

const RUST: Words = Words {
    prologue: "",
    length: "pub const LENGTH: f64 = @;\n",
    array: "#[allow(non_upper_case_globals)]\nconst values_@: [f64; COUNT] = [#];\n",
    search: "
pub fn field(lambda: f64) -> f64 {
    lambda
}

fn between_knots(values: &[f64; COUNT], s: f64) -> f64 {
    let i = values_knots.partition_point(|knot| *knot <= s);
    if i == 0 {
        return values[0];
    }
    if i == COUNT {
        return values[COUNT - 1];
    }
    let (from, to) = (values_knots[i - 1], values_knots[i]);
    values[i - 1] + (values[i] - values[i - 1]) * ((s - from) / (to - from))
}
",
    function: "
pub fn @(s: f64) -> f64 {
    between_knots(&values_@, s)
}
",
};

impl Words {
    fn head(&self, length: f64, count: usize, knots: &[f64]) -> String {
        let mut code = String::from(self.prologue);
        // Python's lists know their length.
        if self.array.contains("[COUNT]") {
            let _ = writeln!(code, "#define COUNT {count}");
        } else if self.array.contains("COUNT") {
            let _ = writeln!(code, "const COUNT: usize = {count};");
        }
        code += &self.length.replace('@', &number(length));
        code += &self.array("knots", knots);
        code += self.search;
        code
    }

    fn array(&self, name: &str, values: &[f64]) -> String {
        let values: Vec<String> = values.iter().map(|v| number(*v)).collect();
        let filled = self.array.replace('@', name);
        // The first `#` of Rust's text begins an attribute.
        match filled.rfind('#') {
            Some(at) => [&filled[..at], &values.join(", "), &filled[at + 1..]].concat(),
            None => filled,
        }
    }

    fn function(&self, name: &str, values: &[f64]) -> String {
        self.array(name, values) + &self.function.replace('@', name)
    }
}

/// The shortest decimal that is read as the same binary64.
fn number(x: f64) -> String {
    format!("{x:?}")
}
