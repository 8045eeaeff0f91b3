//! Cases: all of a catalogue, or one with its formulas, what was checked of it, and what a user should know.

mod code;
mod json;
mod latex;
mod list;
mod orders;
mod value;

pub use code::code;
pub use json::json;
pub(super) use json::serialize_optional;
pub use latex::latex;
pub use list::list;
pub use value::{decimal, decimal_of};

use crate::case::manufacture::{Manufactured, Outcome, Statement};
use crate::case::{Break, Case, Description};
use crate::document::{About, Block, Cell, Column, Document, Fact, Finding, Section, Table, Tone};
use crate::reference::ReferenceError;
use crate::symbolic::Expr;
use orders::orders;
use rug::{Float, Rational};

/// A case as it was described, and what became of each channel.
#[derive(Clone, Debug)]
pub struct Derived {
    /// What the file says, of the chosen channels.
    pub description: Description,
    /// At least one.
    pub cases: Vec<Manufactured>,
}

impl Derived {
    /// What a figure of the case is called: its title, where it has one.
    #[must_use]
    pub fn title(&self) -> &str {
        let description = &self.description;
        match description.title.as_str() {
            "" => &description.name,
            title => title,
        }
    }
}

/// One case: what all channels have in common, then each with what was checked and what theory expects; with its derivation
/// in the words of its file where that is wanted.
#[must_use]
pub fn document(derived: &Derived, derivation: bool, about: &About) -> Document {
    let description = &derived.description;
    let mut document = Document::new("case", heading(derived), about.clone());
    let mut facts = Vec::new();
    if !description.tags.is_empty() {
        facts.push(Fact::new("tags", description.tags.join(", ")));
    }
    facts.extend(derived.cases.first().into_iter().flat_map(shared));
    let section = |title: &str, blocks| Section::of(title, title, blocks);
    let is_alone = derived.cases.len() == 1;
    let mut sections = Vec::new();
    if !is_alone {
        let facts = Block::Facts(std::mem::take(&mut facts));
        sections.push(section(&document.title, vec![facts]));
    }
    for case in &derived.cases {
        let (title, of) = match &case.channel {
            Some(channel) if !is_alone => (format!("channel {channel}"), format!(" of {channel}")),
            _ => (document.title.clone(), String::new()),
        };
        facts.extend(of_channel(case));
        let mut blocks = vec![Block::Facts(std::mem::take(&mut facts))];
        blocks.extend(warning(case).map(Block::Finding));
        sections.extend([
            section(&title, blocks),
            section(&format!("checks{of}"), vec![Block::Table(checks(case))]),
            section(&format!("orders{of}"), vec![Block::Table(expected(case))]),
        ]);
    }
    if derivation && !description.derivation.trim().is_empty() {
        let lines = Block::Lines(description.derivation.clone());
        sections.push(section("derivation", vec![lines]));
    }
    document.sections = sections;
    document
}

/// "rgb-transfer/red: Colour transfer functions".
fn heading(derived: &Derived) -> String {
    let description = &derived.description;
    let mut heading = description.name.clone();
    if let [case] = &derived.cases[..]
        && let Some(channel) = &case.channel
    {
        heading = format!("{heading}/{channel}");
    }
    if !description.title.is_empty() {
        heading = format!("{heading}: {}", description.title);
    }
    heading
}

/// What all channels have in common: the ray and what dims it.
fn shared(case: &Manufactured) -> Vec<Fact> {
    let formulas = case.case.formulas();
    let mut facts = vec![
        Fact::new("D", value::rational(&case.case.length())),
        Fact::new("s(lambda)", formulas.field.to_string()),
        Fact::new("tau(s)", formulas.extinction.to_string()),
    ];
    if along_differs(case) && case.extinction != formulas.extinction {
        facts.push(Fact::new("tau(lambda)", case.extinction.to_string()));
    }
    let depth = formulas.optical_depth.as_ref();
    facts.extend(closed_form("t", depth, value::total_depth(case)));
    facts
}

/// A closed form, and its value at the far end.
fn closed_form(
    of: &str,
    formula: Option<&Expr>,
    at_end: Result<Float, ReferenceError>,
) -> [Fact; 2] {
    let text = formula.map_or("no closed form".into(), Expr::to_string);
    let at_end = match at_end {
        Ok(value) if formula.is_some() => decimal(&value),
        Ok(value) => format!("{} by reference", decimal(&value)),
        Err(error) => format!("unknown: {error}"),
    };
    [
        Fact::new(format!("{of}(lambda)"), text),
        Fact::new(format!("{of}(D)"), at_end),
    ]
}

/// What is said of one channel.
fn of_channel(case: &Manufactured) -> Vec<Fact> {
    let formulas = case.case.formulas();
    let mut facts = vec![Fact::new("C(s)", formulas.emission.to_string())];
    if along_differs(case) && case.emission != formulas.emission {
        facts.push(Fact::new("C(lambda)", case.emission.to_string()));
    }
    let radiance = formulas.radiance.as_ref();
    facts.extend(closed_form("I", radiance, value::radiance(case)));
    facts.extend(breaks(case));
    facts.extend(notes(case).into_iter().map(|note| Fact::new("note", note)));
    facts
}

/// What was checked, and what came of it.
fn checks(case: &Manufactured) -> Table {
    let columns = [Column::text("check"), Column::verdict("outcome")];
    let rows = case.checks.iter().map(|check| {
        let tone = match check.outcome {
            Outcome::Proved => Tone::Good,
            Outcome::Undecided { .. } | Outcome::Refuted { .. } => Tone::Open,
        };
        let outcome = check.outcome.to_string();
        vec![
            Cell::text(check.statement.to_string()),
            Cell::verdict(outcome, tone),
        ]
    });
    Table::new("What was checked on the whole ray", columns).with(rows)
}

/// What theory expects, and the theorems behind that.
fn expected(case: &Manufactured) -> Table {
    let columns = [
        Column::text("method"),
        Column::text("order"),
        Column::text("theorem"),
    ];
    let rows = orders(case).into_iter().map(|order| {
        vec![
            Cell::text(order.method),
            Cell::text(order.expected),
            Cell::text(order.theorem.unwrap_or("no theorem")),
        ]
    });
    Table::new("Orders that theory expects", columns).with(rows)
}

fn breaks(case: &Manufactured) -> Vec<Fact> {
    let length = case.case.length();
    let breaks = case.case.structure().breaks.into_iter();
    let breaks = breaks.zip(case.break_places()).map(|(found, near)| {
        let place = match (&found.part, near) {
            (Some(part), _) => {
                format!("= {}", value::rational(&Rational::from(part * &length)))
            }
            (None, Some(near)) => format!("near {near:.6}"),
            (None, None) => "at an unknown place".into(),
        };
        Fact::new("break", format!("lambda {place}: {}", roughness(&found)))
    });
    breaks.collect()
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
fn notes(case: &Manufactured) -> Vec<String> {
    let structure = case.case.structure();
    let mut notes = Vec::new();
    match structure.extinction_degree() {
        Some(0) => notes.push("tau is constant along the ray".into()),
        Some(degree) => {
            notes.push(format!("tau is a polynomial of degree {degree} in lambda"));
        }
        None => {}
    }
    if structure.source_is_zero() {
        notes.push("C tau is 0: the radiance is 0, by every method".into());
    } else if case.is_degenerate_for_preintegration() {
        notes.push("degenerate for pre-integration: C tau is constant".into());
    }
    notes
}

/// C < 0 somewhere.
fn warning(case: &Manufactured) -> Option<Finding> {
    case.checks.iter().find_map(|check| match &check.outcome {
        Outcome::Refuted { witness, .. } if check.statement == Statement::EmissionNonNegative => {
            let words = format!(
                "C >= 0 fails at lambda = {}: an analytic case may, a kernel test will refuse it",
                value::rational(witness)
            );
            Some(Finding::new("warning", words).toned(Tone::Open))
        }
        _ => None,
    })
}
