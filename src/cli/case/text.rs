//! A case as text: formulas, what was checked, and what a user should know.

use super::orders::{Order, orders};
use super::{Loaded, value};
use rug::{Float, Rational};
use std::fmt::Write;
use volver::case::manufacture::{Manufactured, Outcome, Statement};
use volver::case::{Break, Case};
use volver::reference::ReferenceError;
use volver::report::text::wrap;
use volver::symbolic::Expr;

/// Columns that labels take.
const LABEL: usize = 12;

/// The case and each of its channels, in lines of about `width` columns but for the derivation.
pub(crate) fn render(loaded: &Loaded, width: usize, derivation: bool) -> String {
    let mut page = Page {
        text: String::new(),
        width,
    };
    let description = &loaded.description;
    let channels = loaded.cases.iter().filter_map(|c| c.channel.as_deref());
    let channels: Vec<&str> = channels.collect();
    page.text += &description.name;
    if let [channel] = channels[..] {
        let _ = write!(page.text, "/{channel}");
    }
    if !description.title.is_empty() {
        let _ = write!(page.text, ": {}", description.title);
    }
    page.text.push('\n');
    if !description.tags.is_empty() {
        page.line("tags", &description.tags.join(", "));
    }
    if let Some(case) = loaded.cases.first() {
        page.shared(case);
    }
    for case in &loaded.cases {
        if let (Some(channel), [_, _, ..]) = (&case.channel, &channels[..]) {
            let _ = writeln!(page.text, "\nchannel {channel}");
        }
        page.channel(case);
    }
    if derivation && !description.derivation.trim().is_empty() {
        page.text += "\nderivation\n";
        page.lines(&description.derivation);
    }
    page.text
}

struct Page {
    text: String,
    width: usize,
}

// Writing to a String does not fail, so that results are dropped here.
impl Page {
    fn line(&mut self, label: &str, value: &str) {
        let first = format!("{label:<LABEL$}");
        for line in wrap(value, self.width, &first, &" ".repeat(LABEL)) {
            let _ = writeln!(self.text, "{line}");
        }
    }

    /// What all channels have in common: the ray and what dims it.
    fn shared(&mut self, case: &Manufactured) {
        let formulas = case.case.formulas();
        self.line("D", &value::rational(&case.case.length()));
        self.line("s(lambda)", &formulas.field.to_string());
        self.line("tau(s)", &formulas.extinction.to_string());
        if along_differs(case) && case.extinction != formulas.extinction {
            self.line("tau(lambda)", &case.extinction.to_string());
        }
        self.closed_form(
            "t",
            formulas.optical_depth.as_ref(),
            value::total_depth(case),
        );
    }

    /// A closed form, and its value at the far end.
    fn closed_form(
        &mut self,
        of: &str,
        formula: Option<&Expr>,
        at_end: Result<Float, ReferenceError>,
    ) {
        let text = formula.map_or("no closed form".into(), Expr::to_string);
        self.line(&format!("{of}(lambda)"), &text);
        let at_end = match at_end {
            Ok(value) if formula.is_some() => value::decimal(&value),
            Ok(value) => format!("{} by reference", value::decimal(&value)),
            Err(error) => format!("unknown: {error}"),
        };
        self.line(&format!("{of}(D)"), &at_end);
    }

    fn channel(&mut self, case: &Manufactured) {
        let formulas = case.case.formulas();
        self.line("C(s)", &formulas.emission.to_string());
        if along_differs(case) && case.emission != formulas.emission {
            self.line("C(lambda)", &case.emission.to_string());
        }
        self.closed_form("I", formulas.radiance.as_ref(), value::radiance(case));
        let width = case.checks.iter().map(|c| c.statement.to_string().len());
        let width = width.max().unwrap_or(0);
        for (index, check) in case.checks.iter().enumerate() {
            let label = if index == 0 { "checks" } else { "" };
            let outcome = value::outcome(&check.outcome);
            let statement = check.statement.to_string();
            let first = format!("{label:<LABEL$}{statement:<width$}  ");
            let later = " ".repeat(LABEL + width + 2);
            for line in wrap(&outcome, self.width, &first, &later) {
                let _ = writeln!(self.text, "{line}");
            }
        }
        self.breaks(case);
        for fact in facts(case) {
            self.line("note", &fact);
        }
        self.orders(case);
        if let Some(warning) = warning(case) {
            let _ = writeln!(self.text, "{warning}");
        }
    }

    /// What theory expects, and the theorems behind that.
    fn orders(&mut self, case: &Manufactured) {
        let orders = orders(case);
        let widths = |of: &dyn Fn(&Order) -> usize| orders.iter().map(of).max().unwrap_or(0);
        let (method, order) = (widths(&|o| o.method.len()), widths(&|o| o.expected.len()));
        for (index, line) in orders.iter().enumerate() {
            let label = if index == 0 { "orders" } else { "" };
            let theorem = line.theorem.unwrap_or("no theorem");
            let _ = writeln!(
                self.text,
                "{label:<LABEL$}{:<method$}  {:<order$}  {theorem}",
                line.method, line.expected
            );
        }
    }

    fn breaks(&mut self, case: &Manufactured) {
        let structure = case.case.structure();
        let length = case.case.length();
        for (b, near) in structure.breaks.iter().zip(case.break_places()) {
            let place = match (&b.part, near) {
                (Some(part), _) => {
                    format!("= {}", value::rational(&Rational::from(part * &length)))
                }
                (None, Some(near)) => format!("near {near:.6}"),
                (None, None) => "at an unknown place".into(),
            };
            self.line("break", &format!("lambda {place}: {}", roughness(b)));
        }
    }

    /// Lines as they are: formulas may stand in columns.
    fn lines(&mut self, text: &str) {
        for line in text.trim_end().lines() {
            // What a file says is shown, and does not steer the terminal.
            let shown = |c: char| if c.is_control() { ' ' } else { c };
            let line: String = line.chars().map(shown).collect();
            let _ = writeln!(self.text, "{}", format!("  {line}").trim_end());
        }
    }
}

/// Where the field is λ, functions of it and of λ are the same but for a letter.
fn along_differs(case: &Manufactured) -> bool {
    let field = &case.case.formulas().field;
    *field != Expr::symbol("lambda")
}

/// "tau jumps, C tau has a kink".
fn roughness(b: &Break) -> String {
    let of = |name: &str, power: &Option<Rational>| {
        let power = power.as_ref()?;
        Some(if *power == 0 {
            format!("{name} jumps")
        } else if *power == 1 {
            format!("{name} has a kink")
        } else {
            format!("{name} like |x|^{power}")
        })
    };
    let both = [of("tau", &b.extinction), of("C tau", &b.source)];
    let both: Vec<String> = both.into_iter().flatten().collect();
    both.join(", ")
}

/// What theory says of the case that a user may not expect.
fn facts(case: &Manufactured) -> Vec<String> {
    let structure = case.case.structure();
    let mut facts = Vec::new();
    match structure.extinction_degree() {
        Some(0) => facts.push("tau is constant along the ray".into()),
        Some(degree) => {
            facts.push(format!("tau is a polynomial of degree {degree} in lambda"));
        }
        None => {}
    }
    if structure.source_is_zero() {
        facts.push("C tau is 0: the radiance is 0, by every method".into());
    } else if case.is_degenerate_for_preintegration() {
        facts.push("degenerate for pre-integration: C tau is constant".into());
    }
    facts
}

/// C < 0 somewhere.
fn warning(case: &Manufactured) -> Option<String> {
    case.checks.iter().find_map(|check| match &check.outcome {
        Outcome::Refuted { witness, .. } if check.statement == Statement::EmissionNonNegative => {
            Some(format!(
                "warning: C >= 0 fails at lambda = {}: an analytic case may, a kernel test will refuse it",
                value::rational(witness)
            ))
        }
        _ => None,
    })
}
