//! A kernel asked all of it.

use super::cell::{Answer, Cell};
use super::judge::{Even, Judged};
use super::promised::promises;
use super::scenario::{EVEN, NoSubject, scenarios, subject};
use super::truth::truth;
use crate::kernel::{
    Cut, CutError, Data, Declaration, DeclarationError, FormKind, Kernel, KernelError,
    MAX_TASK_SEGMENTS, Quantity, Rendering, Subject, SubjectError, Task,
};
use crate::study::Progress;
use crate::study::stress::{Scenario, StressError};
use crate::symbolic::CompileError;

/// Cells of a volume's grid, and one fewer than the entries of its tables: ends of segments are among both.
const CELLS: u16 = 64;

/// What a kernel showed at the extremes.
#[derive(Clone, Debug)]
pub struct Extremes {
    /// What the kernel says of itself.
    pub declaration: Declaration,
    /// Scenario by scenario, what is answered in the order of reports.
    pub cells: Vec<Cell>,
    /// Whether its rule is exact in an even medium, or what it gives there is known.
    pub is_exact: bool,
}

impl Extremes {
    /// What speaks against the kernel.
    pub fn faults(&self) -> impl Iterator<Item = &Cell> {
        self.cells.iter().filter(|cell| cell.is_fault)
    }

    /// Why nothing was answered; `None` where anything was.
    #[must_use]
    pub fn without_answer(&self) -> Option<&str> {
        let is_there = |cell: &Cell| cell.answer != Some(Answer::Missing);
        if self.cells.iter().any(is_there) {
            return None;
        }
        let first = self.cells.first().and_then(|cell| cell.reason.as_deref());
        Some(first.unwrap_or("nothing was answered"))
    }
}

/// What the extremes cannot be asked of.
#[derive(Debug, thiserror::Error)]
pub enum ExtremesError {
    /// The kernel declares what cannot all be.
    #[error(transparent)]
    Declaration(#[from] DeclarationError),
    /// Multiples of too many segments.
    #[error("{scenario}: {error}")]
    Cut {
        /// The scenario.
        scenario: String,
        /// Why.
        error: CutError,
    },
    /// A ray without code.
    #[error("{scenario}: {error}")]
    Formula {
        /// The scenario.
        scenario: String,
        /// Why.
        error: CompileError,
    },
    /// A ray with other channels.
    #[error("{scenario}: {error}")]
    Subject {
        /// The scenario.
        scenario: String,
        /// Why.
        error: SubjectError,
    },
    /// No bound of the format's roundoff.
    #[error(transparent)]
    Promise(#[from] StressError),
}

/// The rays that a kernel is asked, the units of progress.
#[must_use]
pub fn work(declaration: &Declaration) -> u64 {
    scenarios(declaration.multiple_of.get()).len() as u64
}

/// Asks a kernel all scenarios, each once.
///
/// # Errors
/// [`ExtremesError`] where the rays cannot be cut or written as the kernel wants them. What the kernel does wrong is no
/// error but stands in the cells.
pub fn extremes(
    kernel: &mut dyn Kernel,
    progress: &dyn Progress,
) -> Result<Extremes, ExtremesError> {
    let declaration = kernel.declaration().clone();
    declaration.check()?;
    let mut asked = Vec::new();
    for scenario in scenarios(declaration.multiple_of.get()) {
        let subject =
            subject(&scenario, declaration.background).map_err(|error| failed(&scenario, error))?;
        kernel.renew();
        let answer = ask(kernel, &declaration, &scenario, &subject)?;
        asked.push((scenario, answer));
        progress.advance(1);
    }
    // What a declared method gives depends on the segments that were used.
    for (scenario, answer) in &mut asked {
        if let Ok((_, used)) = answer {
            scenario.n = *used;
        }
    }
    let used: Vec<Scenario> = asked.iter().map(|(scenario, _)| scenario.clone()).collect();
    let promises = promises(&declaration, &used)?;
    let cells = |even: Even| {
        let mut cells = Vec::new();
        for ((scenario, answer), promise) in asked.iter().zip(&promises) {
            for quantity in quantities(&declaration, scenario, answer.as_ref().ok()) {
                let judged = Judged {
                    declaration: &declaration,
                    scenario,
                    quantity,
                    promise,
                    even,
                };
                let found = match answer {
                    Ok((rendering, _)) => rendering.of(quantity, 0).ok_or_else(|| {
                        let given = false;
                        KernelError::Answers { quantity, given }.to_string()
                    }),
                    Err(error) => Err(error.to_string()),
                };
                let truth = truth(scenario, quantity, &declaration);
                cells.push(judged.cell(&truth, found));
            }
        }
        cells
    };
    let strict = cells(Even::Exact);
    let is_known = declaration.method.is_some();
    let is_off =
        |cell: &Cell| cell.scenario == EVEN && cell.quantity == Quantity::Radiance && cell.is_fault;
    let is_exact = is_known || !strict.iter().any(is_off);
    let cells = if is_exact {
        strict
    } else {
        cells(Even::OfOrder(declaration.order.unwrap_or(1.0)))
    };
    Ok(Extremes {
        declaration,
        cells,
        is_exact,
    })
}

fn failed(scenario: &Scenario, error: NoSubject) -> ExtremesError {
    let scenario = scenario.name.clone();
    match error {
        NoSubject::Formula(error) => ExtremesError::Formula { scenario, error },
        NoSubject::Subject(error) => ExtremesError::Subject { scenario, error },
    }
}

/// What is looked at: C does not matter to what is no radiance.
fn quantities(
    declaration: &Declaration,
    scenario: &Scenario,
    answer: Option<&(Rendering, u64)>,
) -> Vec<Quantity> {
    let came = |quantity: Quantity| {
        quantity == Quantity::Opacity && answer.is_some_and(|(found, _)| found.opacity.is_some())
    };
    let is_lit = scenario.group == "emission" && declaration.has(Quantity::Radiance);
    let is_wanted = |quantity: &Quantity| {
        let is_there = declaration.has(*quantity) || came(*quantity);
        is_there && (*quantity == Quantity::Radiance || !is_lit)
    };
    Quantity::ALL.into_iter().filter(is_wanted).collect()
}

/// The answer to one scenario, and how many segments were used.
fn ask(
    kernel: &mut dyn Kernel,
    declaration: &Declaration,
    scenario: &Scenario,
    subject: &Subject,
) -> Result<Result<(Rendering, u64), KernelError>, ExtremesError> {
    let cut = Cut::Segments(scenario.n);
    let no_cut = |error| ExtremesError::Cut {
        scenario: scenario.name.clone(),
        error,
    };
    let (step, segments) = cut.on(subject.length()).map_err(no_cut)?;
    let (cut, volume, formula) = match declaration.form {
        FormKind::Segments => (Some(subject.segments(cut).map_err(no_cut)?), None, None),
        FormKind::Volume => {
            let volume = subject.volume(CELLS.into(), usize::from(CELLS) + 1);
            (None, Some(volume), None)
        }
        FormKind::Formula(language) => {
            let formula = subject.formula(language);
            let formula = formula.map_err(|error| failed(scenario, error.into()))?;
            (None, None, Some(formula))
        }
        FormKind::Function => (None, None, None),
    };
    let data = match (&cut, &volume, &formula) {
        (Some(segments), ..) => Data::Segments(segments),
        (_, Some(volume), _) => Data::Volume(volume),
        (_, _, Some(formula)) => Data::Formula(formula),
        _ => Data::Function,
    };
    let task = Task {
        subject,
        step: step.to_f64(),
        segments,
        seed: 0,
        data,
    };
    Ok(kernel
        .render(&task)
        .and_then(|rendering| checked(declaration, rendering, segments)))
}

/// An answer with one radiance where one is declared, of a number of segments that can be.
fn checked(
    declaration: &Declaration,
    rendering: Rendering,
    segments: u64,
) -> Result<(Rendering, u64), KernelError> {
    let got = rendering.radiance.len();
    if declaration.has(Quantity::Radiance) && got != 1 {
        return Err(KernelError::Channels { got, wanted: 1 });
    }
    // Rays are of length 1.
    let rendering = rendering.with_edges_on(1.0)?;
    if let Some(edges) = &rendering.edges {
        let used = edges.len() as u64 - 1;
        return Ok((rendering, used));
    }
    let used = match (rendering.segments, rendering.step) {
        (Some(segments), _) if (1..=MAX_TASK_SEGMENTS).contains(&segments) => segments,
        (Some(segments), _) => {
            let value = segments as f64;
            let what = "number of segments";
            return Err(KernelError::Used { what, value });
        }
        (None, Some(step)) => {
            let count = (1.0 / step).round();
            if !(count >= 1.0 && count <= MAX_TASK_SEGMENTS as f64) {
                let (what, value) = ("step", step);
                return Err(KernelError::Used { what, value });
            }
            // In that range.
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let count = count as u64;
            count
        }
        (None, None) => segments,
    };
    Ok((rendering, used))
}
