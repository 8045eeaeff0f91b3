//! `volver ask`: what a kernel is asked, and what a method would answer.

use super::case::SOURCES;
use super::kernel::{built_in, subject};
use super::spacing::{Spaced, spacing};
use super::{Failure, Outcome, waiting, write_out};
use clap::{Args, ValueEnum};
use std::str::FromStr;
use volver::kernel::process::{Numbers, answer, greeting, request};
use volver::kernel::{
    Cut, CutError, Data, FormKind, Formula, Gridded, Kernel, MAX_TASK_SEGMENTS, Medium, Segments,
    Subject, Task, Volume,
};
use volver::study::verify::{Axis, Settings, TABLE_ENTRIES};
use volver::symbolic::code::Language;

const EXAMPLES: &str = "\
Printed are the lines of docs/protocol.md, one a message: to the bit what a program gets
on its descriptor 3, with --by also what a kernel that is that method answers. Of a
volume the method sees what the volume shows, as a kernel does. A grid and tables have
by themselves as much as 'volver verify' gives them.

Work: rays of at most 1048576 segments or cells.

Examples:
  volver ask sine-squared -n 4
  volver ask rgb-transfer -n 8 --form volume --entries 16 --by trapezoid/trapezoid
  volver ask sine-squared --step 0.3 --by front-to-back/middle/expm1@f32
  volver ask sine-squared -n 4 --spacing log
  volver ask cloud --form formula --language c";

/// The only request has no need of another.
const ID: u64 = 1;

/// Print what a kernel is asked on a case
#[derive(Args)]
#[command(after_help = format!("{SOURCES}\n\n{EXAMPLES}"))]
#[allow(clippy::doc_markdown)] // Help is no Markdown.
pub(crate) struct Ask {
    /// A name of the catalogue, a channel of it, or a file
    #[arg(value_name = "CASE")]
    case: String,
    /// Segments of the ray
    #[arg(short = 'n', long, value_name = "N", default_value_t = 8, value_parser = segments, allow_negative_numbers = true)]
    segments: u64,
    /// Length of the segments in place of their number; the last is shorter where it does
    /// not divide the ray
    #[arg(
        long,
        value_name = "D",
        conflicts_with = "segments",
        allow_negative_numbers = true
    )]
    step: Option<f64>,
    /// Where the segments end: even, square, log, disparity, random:SEED
    #[arg(long, value_name = "HOW", value_parser = spacing, conflicts_with = "step")]
    spacing: Option<Spaced>,
    /// In which form
    #[arg(long, value_enum, default_value = "segments", value_name = "FORM")]
    form: Form,
    /// Of the code of a formula: c, python or rust
    #[arg(long, value_name = "LANGUAGE", value_parser = Language::from_str)]
    language: Option<Language>,
    /// Cells of the grid of a volume
    #[arg(long, value_name = "M", value_parser = cells, allow_negative_numbers = true)]
    cells: Option<u64>,
    /// Entries of the tables of a volume
    #[arg(long, value_name = "K", default_value_t = TABLE_ENTRIES as u64, value_parser = entries, allow_negative_numbers = true)]
    entries: u64,
    /// For kernels that draw random numbers
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// How numbers are written
    #[arg(long, value_enum, default_value = "decimal", value_name = "HOW")]
    numbers: Wanted,
    /// Print volver's greeting first
    #[arg(long)]
    greeting: bool,
    /// Print also what a method answers, NAME[@FORMAT]
    #[arg(long, value_name = "METHOD")]
    by: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Form {
    Segments,
    Volume,
    Formula,
}

#[derive(Clone, Copy, ValueEnum)]
enum Wanted {
    Decimal,
    Hexadecimal,
}

/// A number of what a ray or a table is made of.
fn number(text: &str, what: &str, least: u64) -> Result<u64, String> {
    let count = text.parse().ok();
    count
        .filter(|count| (least..=MAX_TASK_SEGMENTS).contains(count))
        .ok_or_else(|| format!("no number of {what} (allowed: {least} to {MAX_TASK_SEGMENTS})"))
}

fn segments(text: &str) -> Result<u64, String> {
    number(text, "segments", 1)
}

fn cells(text: &str) -> Result<u64, String> {
    number(text, "cells", 1)
}

fn entries(text: &str) -> Result<u64, String> {
    number(text, "entries", 2)
}

/// The ray in the form asked for.
enum Ray {
    Segments(Segments),
    Volume(Volume),
    Formula(Formula),
}

impl Ask {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let form = self.form()?;
        let method = self.by.as_deref().map(built_in).transpose()?;
        let subject = waiting("deriving", || subject(&self.case))?;
        let wrong = |error: CutError| Failure::Usage(format!("{}: {error}", self.case));
        let cut = match (self.step, self.spacing) {
            (Some(step), _) => Cut::Step(step),
            (None, Some(Spaced(Some(spacing)))) => Cut::Spaced(self.segments, spacing),
            (None, _) => Cut::Segments(self.segments),
        };
        let (step, segments) = cut.on(subject.length()).map_err(wrong)?;
        let ray = match form {
            FormKind::Volume => Ray::Volume(self.volume(&subject)?),
            FormKind::Formula(language) => {
                let formula = subject.formula(language);
                Ray::Formula(formula.map_err(|error| self.failed(error))?)
            }
            FormKind::Segments | FormKind::Function => {
                Ray::Segments(subject.segments(cut).map_err(wrong)?)
            }
        };
        let task = Task {
            subject: &subject,
            step: step.to_f64(),
            segments,
            seed: self.seed,
            data: match &ray {
                Ray::Segments(segments) => Data::Segments(segments),
                Ray::Volume(volume) => Data::Volume(volume),
                Ray::Formula(formula) => Data::Formula(formula),
            },
        };
        let numbers = match self.numbers {
            Wanted::Decimal => Numbers::Decimal,
            Wanted::Hexadecimal => Numbers::Hexadecimal,
        };
        let mut lines = Vec::new();
        if self.greeting {
            lines.push(greeting().map_err(|error| self.failed(error))?);
        }
        let asked = request(ID, std::slice::from_ref(&task), numbers);
        lines.push(asked.map_err(|error| self.failed(error))?);
        if let Some(mut method) = method {
            lines.push(self.answered(method.as_mut(), &subject, &ray, task)?);
        }
        lines.push(String::new());
        write_out(&lines.join("\n"))?;
        Ok(Outcome::Good)
    }

    /// The form, as a kernel declares it.
    fn form(&self) -> Result<FormKind, Failure> {
        let problem = match (self.form, self.language) {
            (Form::Segments | Form::Formula, _) if self.cells.is_some() => {
                "--cells without need (allowed: with --form volume)"
            }
            (Form::Volume | Form::Formula, _) if self.spacing.is_some() => {
                "--spacing without need (allowed: with --form segments)"
            }
            (Form::Segments, None) => return Ok(FormKind::Segments),
            (Form::Volume, None) => return Ok(FormKind::Volume),
            (Form::Formula, Some(language)) => return Ok(FormKind::Formula(language)),
            (Form::Formula, None) => {
                "--form formula without --language (allowed: with --language c, python or rust)"
            }
            (Form::Segments | Form::Volume, Some(_)) => {
                "--language without need (allowed: with --form formula)"
            }
        };
        Err(Failure::Usage(problem.into()))
    }

    fn volume(&self, subject: &Subject) -> Result<Volume, Failure> {
        let cells = match self.cells {
            Some(cells) => cells,
            None => Settings::standard(Axis::Step)
                .map_err(|error| self.failed(error))?
                .cells(),
        };
        // At most as many as a ray has segments.
        let entries = usize::try_from(self.entries).unwrap_or(usize::MAX);
        Ok(subject.volume(cells, entries))
    }

    /// What a method answers.
    fn answered(
        &self,
        method: &mut dyn Kernel,
        subject: &Subject,
        ray: &Ray,
        task: Task<'_>,
    ) -> Result<String, Failure> {
        let gridded = match ray {
            Ray::Volume(volume) => Some(Gridded::new(subject, volume)),
            Ray::Segments(_) | Ray::Formula(_) => None,
        };
        let subject = gridded
            .as_ref()
            .map_or(task.subject, |ray| ray as &dyn Medium);
        let data = Data::Function;
        let answered = method.render(&Task {
            subject,
            data,
            ..task
        });
        let line = answered.and_then(|rendering| answer(ID, &[rendering]));
        line.map_err(|error| self.failed(error))
    }

    fn failed(&self, error: impl Into<anyhow::Error>) -> Failure {
        Failure::Content {
            path: self.case.escape_debug().to_string(),
            error: error.into(),
        }
    }
}
