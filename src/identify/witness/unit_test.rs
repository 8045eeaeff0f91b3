//! A witness as a unit test of the user's own function.

use super::Witness;
use crate::symbolic::code::Language;
use std::fmt::Write as _;

impl Witness {
    /// The source of a test that calls `function` with the ray and wants the radiance, within rounding.
    ///
    /// In Python the function takes a task, as `docs/protocol.md` has it, and returns a radiance a channel. In C and Rust
    /// it takes λ at the n + 1 ends, τ there and in the n middles, C there and in the middles, in C n, and the step; it
    /// returns the radiance of the one channel that differs.
    ///
    /// # Errors
    /// [`serde_json::Error`] where a value of the ray is not finite.
    pub fn unit_test(
        &self,
        language: Language,
        function: &str,
    ) -> Result<String, serde_json::Error> {
        Ok(match language {
            Language::Python => self.python(function, &self.ray.to_json()?),
            Language::C => self.c(function),
            Language::Rust => self.rust(function),
        })
    }

    fn python(&self, function: &str, task: &str) -> String {
        let (channel, want, tolerance) = (self.channel, self.want, self.tolerance);
        let task = task.replace(",\"data\"", ",\n        \"data\"");
        let task = task.replace(",\"middles\"", ",\n        \"middles\"");
        format!(
            "def test_witness():\n    \
                 # {self}\n    \
                 task = {task}\n    \
                 radiance = {function}(task)[{channel}]\n    \
                 assert abs(radiance - {want:?}) <= {tolerance:.1e}, radiance\n"
        )
    }

    /// The rows of numbers, by name.
    fn rows(&self) -> [(&'static str, Vec<f64>); 5] {
        let segments = &self.ray.segments;
        let of = |all: &[Vec<f64>]| all.get(self.channel).cloned().unwrap_or_default();
        [
            ("lambda", segments.edges.lambda.clone()),
            ("extinction", segments.edges.extinction.clone()),
            ("extinction_middles", segments.middles.extinction.clone()),
            ("emission", of(&segments.edges.emission)),
            ("emission_middles", of(&segments.middles.emission)),
        ]
    }

    // Writing to a String does not fail.
    fn c(&self, function: &str) -> String {
        let (want, tolerance) = (self.want, self.tolerance);
        let mut text = String::from("#include <assert.h>\n#include <math.h>\n\n");
        let pointers = self.rows().map(|(name, _)| format!("const double *{name}"));
        let _ = write!(
            text,
            "double {function}({}, int n, double step);\n\n",
            pointers.join(", ")
        );
        let _ = write!(text, "int main(void)\n{{\n    /* {self} */\n");
        for (name, row) in self.rows() {
            let _ = writeln!(text, "    const double {name}[] = {{{}}};", listed(&row));
        }
        let _ = write!(
            text,
            "    double radiance = {function}({}, {}, {:?});\n    \
                 assert(fabs(radiance - {want:?}) <= {tolerance:.1e});\n    \
                 return 0;\n}}\n",
            self.rows().map(|(name, _)| name).join(", "),
            self.segments(),
            self.ray.step()
        );
        text
    }

    fn rust(&self, function: &str) -> String {
        let (want, tolerance) = (self.want, self.tolerance);
        let mut text = format!("#[test]\nfn witness() {{\n    // {self}\n");
        for (name, row) in self.rows() {
            let _ = writeln!(text, "    let {name} = [{}];", listed(&row));
        }
        let _ = write!(
            text,
            "    let radiance = {function}({}, {:?});\n    \
                 assert!((radiance - {}).abs() <= {tolerance:.1e}, \"{{radiance}}\");\n}}\n",
            self.rows().map(|(name, _)| format!("&{name}")).join(", "),
            self.ray.step(),
            typed(want)
        );
        text
    }
}

/// A literal that is a binary64 whatever stands beside it.
fn typed(x: f64) -> String {
    format!("({x:?}_f64)")
}

/// Numbers that read back as they are.
fn listed(row: &[f64]) -> String {
    let row: Vec<String> = row.iter().map(|x| format!("{x:?}")).collect();
    row.join(", ")
}
