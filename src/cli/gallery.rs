//! `volver gallery`: what real packages compute, as `make gallery` found it.

use super::about::about;
use super::output::{Output, said};
use super::{Color, Failure, Outcome};
use clap::Args;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use volver::document::{Block, Cell, Column, Document, Fact, Section, Table};
use volver::identify::Rule;
use volver::identify::rule::RuleKernel;
use volver::kernel::{Declaration, Kernel};
use volver::real::FormatName;

/// All rows, which gallery/run writes.
const ROWS: &str = include_str!("../../gallery/gallery.json");

/// What a kernel of the gallery is called by.
pub(super) const PREFIX: &str = "gallery:";

const EXAMPLES: &str = "\
A row is what a release of a package computes of a ray: its formula, which was held out
against rays that it was not found with, and in words what one would have guessed and what
a user should know. docs/gallery.md has all rows; 'make gallery' asks the packages anew.

gallery:NAME is a kernel that computes by the formula of a row, with no package installed:
'volver identify --against gallery:nerfacc python3 mine.py' says in what another one differs.

Work: none that grows.

Examples:
  volver gallery
  volver gallery nerfacc
  volver gallery nerfacc --json -
  volver identify gallery:nerfacc";

/// Show what real packages compute
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Gallery {
    /// One row [default: a line each]
    #[arg(value_name = "NAME")]
    name: Option<String>,
    /// Write it as JSON; - is standard output, without the text
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Print no text
    #[arg(long)]
    quiet: bool,
    /// Colour it
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    color: Color,
}

/// A package as it was asked.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    name: String,
    package: String,
    version: String,
    kind: String,
    what: String,
    guess: String,
    know: String,
    source: String,
    reading: String,
    unidentified: String,
    /// Why it is not driven; empty where it is.
    why_not: String,
    /// What it computes in.
    format: String,
    /// The formula in lines; none where it is not identified.
    rule: Vec<String>,
    /// The same for programs.
    formula: Option<Rule>,
    /// Names of what deviates from the guess.
    deviations: Vec<String>,
}

impl Gallery {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let rows = rows()?;
        let shown: Vec<Row> = match &self.name {
            Some(name) => vec![row(&rows, name)?.clone()],
            None => rows,
        };
        let output = Output {
            out: None,
            files: vec![("--json", self.json.as_deref())],
            quiet: self.quiet,
            color: self.color,
        };
        output.check()?;
        let document = match (&self.name, &shown[..]) {
            (Some(_), [row]) => one(row),
            _ => all(&shown),
        };
        let json = serde_json::to_string_pretty(&shown).map_err(said)? + "\n";
        output.show(&document, |_| Ok(json.clone()))?;
        Ok(Outcome::Good)
    }
}

fn rows() -> Result<Vec<Row>, Failure> {
    serde_json::from_str(ROWS).map_err(|error| said(format!("the rows of this program: {error}")))
}

fn row<'r>(rows: &'r [Row], name: &str) -> Result<&'r Row, Failure> {
    let mut all = rows.iter();
    all.find(|row| row.name == name).ok_or_else(|| {
        let names: Vec<&str> = rows.iter().map(|row| row.name.as_str()).collect();
        Failure::Usage(format!(
            "the gallery has no '{}' (allowed: {})",
            name.escape_debug(),
            names.join(", ")
        ))
    })
}

/// What computes by the formula of a row.
pub(super) fn kernel(name: &str) -> Result<Box<dyn Kernel>, Failure> {
    let rows = rows()?;
    let row = row(&rows, name)?;
    let rule = row.formula.clone().ok_or_else(|| {
        Failure::Usage(format!(
            "{PREFIX}{name}: its formula is not known (allowed: rows with one, as 'volver gallery' lists them)"
        ))
    })?;
    let format: FormatName = row.format.parse().map_err(said)?;
    let declaration = Declaration {
        format,
        ..Declaration::new(&format!("{PREFIX}{name}"))
    };
    Ok(Box::new(RuleKernel::new(rule, declaration)))
}

fn all(rows: &[Row]) -> Document {
    let columns = vec![
        Column::text("name"),
        Column::text("version"),
        Column::text("kind"),
        Column::text("format"),
        Column::text("formula"),
        Column::text("deviates from the guess in"),
    ];
    let table = rows.iter().map(|row| {
        let deviates = if row.why_not.is_empty() {
            row.deviations.join(", ")
        } else {
            format!("not driven: {}", row.why_not)
        };
        let formula = if row.formula.is_some() { "known" } else { "-" };
        let texts = [
            &*row.name,
            &row.version,
            &row.kind,
            &row.format,
            formula,
            &deviates,
        ];
        texts.map(Cell::text).to_vec()
    });
    let table = Table::new("What real packages compute", columns).with(table);
    let mut document = Document::new("gallery", "What real packages compute", about());
    let title = "What real packages compute";
    document
        .sections
        .push(Section::of("rows", title, [Block::Table(table)]));
    document
}

fn one(row: &Row) -> Document {
    let title = format!("{} {}", row.package, row.version);
    let mut document = Document::new("gallery", &title, about());
    let words = [
        ("drives", &row.what),
        ("not driven", &row.why_not),
        ("guess", &row.guess),
        ("know", &row.know),
        ("source", &row.source),
        ("reading", &row.reading),
        ("not identified", &row.unidentified),
    ];
    let mut facts: Vec<Fact> = Vec::new();
    for (name, text) in words.into_iter().filter(|(_, text)| !text.is_empty()) {
        facts.push(Fact::new(name, text.as_str()));
    }
    if !row.deviations.is_empty() {
        facts.push(Fact::new("deviates in", row.deviations.join(", ")));
    }
    let formula = row.rule.iter().map(|line| Block::Text(line.clone()));
    let blocks = std::iter::once(Block::Facts(facts)).chain(formula);
    document
        .sections
        .push(Section::of(row.name.clone(), title, blocks));
    document
}
