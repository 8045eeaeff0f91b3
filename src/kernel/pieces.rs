//! Rays as a kernel takes them, of so many channels and with the source per depth or length, and their answers joined.

use super::{
    Data, Declaration, KernelError, Medium, Rendering, Samples, Segments, Source, Table, Task,
    Volume,
};
use crate::case::SymbolicCase;
use rug::Rational;
use std::num::NonZeroUsize;

/// Some channels of a ray: as many as are wanted, the last one again where there are no more.
#[derive(Debug)]
struct Piece<'a> {
    whole: &'a Task<'a>,
    /// Which.
    channels: Vec<usize>,
    /// How many of them are no repetition.
    own: usize,
    names: Vec<String>,
    cases: Vec<SymbolicCase>,
    background: Vec<f64>,
    segments: Option<Segments>,
    volume: Option<Volume>,
}

impl<'a> Piece<'a> {
    fn new(whole: &'a Task<'a>, first: usize, count: usize, source: Source) -> Self {
        let subject = whole.subject;
        let samples = |all: &Samples, channels: &[usize]| match source {
            Source::Length if !subject.is_per_length() => per_length(samples(all, channels)),
            Source::Length | Source::Depth => samples(all, channels),
        };
        let last = subject.channels().len().saturating_sub(1);
        let channels: Vec<usize> = (first..first + count).map(|k| k.min(last)).collect();
        let segments = match whole.data {
            Data::Segments(segments) => Some(Segments {
                edges: samples(&segments.edges, &channels),
                middles: samples(&segments.middles, &channels),
            }),
            _ => None,
        };
        let volume = match whole.data {
            Data::Volume(volume) => Some(Volume {
                field: volume.field.clone(),
                table: Table {
                    extinction: volume.table.extinction.clone(),
                    emission: some(&volume.table.emission, &channels),
                    ..volume.table
                },
            }),
            _ => None,
        };
        Piece {
            whole,
            own: count.min(last + 1 - first.min(last)),
            names: some(subject.channels(), &channels),
            cases: some(subject.cases(), &channels),
            background: some(subject.background(), &channels),
            channels,
            segments,
            volume,
        }
    }

    fn task(&self) -> Task<'_> {
        let data = match (&self.segments, &self.volume) {
            (Some(segments), _) => Data::Segments(segments),
            (_, Some(volume)) => Data::Volume(volume),
            // Source code may define more than is wanted of it.
            _ => self.whole.data,
        };
        Task {
            subject: self,
            data,
            ..*self.whole
        }
    }
}

/// Those of the channels, where there is one each.
fn some<T: Clone>(all: &[T], channels: &[usize]) -> Vec<T> {
    let some = channels.iter().filter_map(|channel| all.get(*channel));
    some.cloned().collect()
}

fn samples(all: &Samples, channels: &[usize]) -> Samples {
    Samples {
        lambda: all.lambda.clone(),
        extinction: all.extinction.clone(),
        emission: some(&all.emission, channels),
    }
}

/// With C τ in place of C.
fn per_length(all: Samples) -> Samples {
    let Samples {
        lambda,
        extinction,
        mut emission,
    } = all;
    for row in &mut emission {
        for (c, tau) in row.iter_mut().zip(&extinction) {
            *c *= tau;
        }
    }
    Samples {
        lambda,
        extinction,
        emission,
    }
}

impl Medium for Piece<'_> {
    fn name(&self) -> &str {
        self.whole.subject.name()
    }

    fn channels(&self) -> &[String] {
        &self.names
    }

    fn length(&self) -> &Rational {
        self.whole.subject.length()
    }

    fn at(&self, lambda: f64, emission: &mut [f64]) -> f64 {
        let subject = self.whole.subject;
        let mut all = vec![f64::NAN; subject.channels().len()];
        let extinction = subject.at(lambda, &mut all);
        for (channel, emission) in self.channels.iter().zip(emission) {
            *emission = all.get(*channel).copied().unwrap_or(f64::NAN);
        }
        extinction
    }

    fn background(&self) -> &[f64] {
        &self.background
    }

    fn cases(&self) -> &[SymbolicCase] {
        &self.cases
    }
}

/// The answers to any tasks by a kernel that takes those that it declares.
pub(super) fn in_pieces(
    declaration: &Declaration,
    tasks: &[Task<'_>],
    render: impl FnOnce(&[Task<'_>]) -> Vec<Result<Rendering, KernelError>>,
) -> Vec<Result<Rendering, KernelError>> {
    let source = declaration.source;
    let count = |task: &Task<'_>| {
        let own = task.subject.channels().len();
        declaration.channels.map_or(own, NonZeroUsize::get)
    };
    let fits = |task: &Task<'_>| task.subject.channels().len() == count(task);
    if source == Source::Depth && tasks.iter().all(fits) {
        return render(tasks);
    }
    let pieces: Vec<Vec<Piece<'_>>> = tasks
        .iter()
        .map(|task| {
            let count = count(task).max(1);
            let firsts = (0..task.subject.channels().len()).step_by(count);
            firsts
                .map(|first| Piece::new(task, first, count, source))
                .collect()
        })
        .collect();
    let asked: Vec<Task<'_>> = pieces.iter().flatten().map(Piece::task).collect();
    let mut answers = render(&asked).into_iter();
    let joined = pieces.iter().map(|pieces| {
        let answers: Vec<_> = answers.by_ref().take(pieces.len()).collect();
        joined(pieces, answers)
    });
    joined.collect()
}

/// The answer to one task.
pub(super) fn one(
    mut answers: Vec<Result<Rendering, KernelError>>,
) -> Result<Rendering, KernelError> {
    let none = KernelError::Channels { got: 0, wanted: 1 };
    answers.pop().unwrap_or(Err(none))
}

/// What is one of a ray is that of its first piece.
fn joined(
    pieces: &[Piece<'_>],
    answers: Vec<Result<Rendering, KernelError>>,
) -> Result<Rendering, KernelError> {
    let mut whole: Option<Rendering> = None;
    for (piece, answer) in pieces.iter().zip(answers) {
        let mut answer = answer?;
        answer.radiance.truncate(piece.own);
        if let Some(errors) = &mut answer.standard_error {
            errors.truncate(piece.own);
        }
        match &mut whole {
            None => whole = Some(answer),
            Some(whole) => {
                whole.radiance.extend(answer.radiance);
                whole.standard_error = whole
                    .standard_error
                    .take()
                    .zip(answer.standard_error)
                    .map(|(all, more)| [all, more].concat());
            }
        }
    }
    whole.ok_or(KernelError::Channels { got: 0, wanted: 1 })
}
