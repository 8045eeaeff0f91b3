//! Methods of volver's own: what they state.

use super::super::about::about;
use super::super::output::Output;
use super::super::{Failure, Outcome, write_out};
use super::Identify;
use volver::identify::stated;
use volver::method::Method;
use volver::report::identify::Stated;

/// A method has no kernel that takes rays.
pub(super) fn not_asked(name: &str, option: &str) -> Failure {
    Failure::Usage(format!(
        "{option}: {name} computes cases, and cannot be asked rays (allowed: a program or a library; without {option}, the rule of a method is printed)"
    ))
}

impl Identify {
    /// Prints what a method states.
    pub(super) fn stated(&self, name: String, method: &Method) -> Result<Outcome, Failure> {
        let asks = [
            ("--against", self.against.is_some()),
            ("--replay", self.replay.is_some()),
            ("--test", self.test.is_some()),
        ];
        if let Some((option, _)) = asks.iter().find(|(_, is_given)| *is_given) {
            return Err(not_asked(&name, option));
        }
        let Some(rule) = stated(method) else {
            return Err(Failure::Usage(format!(
                "{name} states no rule of single segments (allowed: compositing, and nested rules that look at the ends and the middle of one segment)"
            )));
        };
        let stated = Stated { name, rule };
        let code = self.code.map(|code| code.of(&stated.rule));
        let output = Output {
            quiet: self.quiet || code.is_some(),
            ..self.output()
        };
        output.check()?;
        output.hand_out(
            &stated.document(&about()),
            |directory| stated.write(directory, &about()),
            |_| stated.json(),
        )?;
        if let Some(code) = code {
            write_out(&code)?;
        }
        Ok(Outcome::Good)
    }
}
