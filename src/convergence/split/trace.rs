//! A run in some format, with all that it used.

use super::known::{Known, Rounded};
use super::parts::Measured;
use super::ran::{Ran, run};
use crate::case::{AnyNodes, Case, Nodes, Recorded, Recording, Replayed};
use crate::method::{Alone, Exponentials, Level, Method, MethodError, Nested, Stop};
use crate::real::{Format, MpfrReal, Real, row};
use rug::Float;

/// What methods gave, and the inputs they used.
pub(super) struct Trace<'a> {
    pub(super) measured: Vec<Result<Measured, MethodError>>,
    /// T wherever sums look, in rows, each once for all methods that look there.
    pub(super) transmittances: Vec<Vec<Vec<MpfrReal>>>,
    pub(super) recording: Recording<'a>,
    /// Whether a replay stood on the same side of every jump and kink.
    pub(super) took_the_sides_of: Box<dyn Fn(&Replayed<'_>) -> bool + 'a>,
}

/// One ray of a case in a format: apart from it, no code of an oracle depends on the format.
pub(super) trait Traced {
    /// Significant bits of the format.
    fn bits(&self) -> u32;
    /// n.
    fn segments(&self) -> u64;
    /// The methods, run one after the other, beside what is known of the level without rounding.
    fn trace(&self, methods: &[Method], known: &Known) -> Trace<'_>;
    /// The radiance by one of them.
    fn radiance(&self, method: &Method) -> Result<Float, MethodError>;
}

/// A ray of n segments.
pub(super) struct Ray<'a, C, F: Format> {
    pub(super) case: &'a C,
    pub(super) nodes: AnyNodes<'a, F>,
    pub(super) n: u64,
}

impl<C: Case, F: Format> Traced for Ray<'_, C, F> {
    fn bits(&self) -> u32 {
        self.nodes.format().bits()
    }

    fn segments(&self) -> u64 {
        self.n
    }

    fn trace(&self, methods: &[Method], known: &Known) -> Trace<'_> {
        let recorded = Recorded::new(self.nodes);
        let rounded = Rounded(known);
        let by: &dyn Exponentials<F::Real> = if F::ROUNDS_FUNCTIONS {
            &rounded
        } else {
            &Alone
        };
        let mut level = Level::taking(AnyNodes::new(&recorded), self.n, by);
        let runs = row(methods
            .iter()
            .map(|method| run(&mut level, method, Stop::AsDeclared)));
        // What is asked for from here on is no part of the run.
        let recording = recorded.recording();
        let mut transmittances: Vec<Vec<Vec<MpfrReal>>> = Vec::new();
        let mut shared: Vec<(Method, usize)> = Vec::new();
        let mut measure = |method: &Method, ran: Result<Ran<F::Real>, MethodError>| {
            let ran = ran?;
            let same = shared.iter().find(|(other, _)| looks_alike(other, method));
            let index = if let Some((_, index)) = same {
                Some(*index)
            } else {
                let rows = level.transmittances(method)?;
                (!rows.is_empty()).then(|| {
                    transmittances.push(row(rows.iter().map(|values| floats(values))));
                    shared.push((*method, transmittances.len() - 1));
                    transmittances.len() - 1
                })
            };
            Ok(Measured {
                radiance: ran.radiance.to_float(),
                stopped: ran.stopped,
                transmittances: index,
            })
        };
        let both = methods.iter().zip(runs);
        let measured = row(both.map(|(method, ran)| measure(method, ran)));
        drop(level);
        let case = self.case;
        Trace {
            measured,
            transmittances,
            recording,
            took_the_sides_of: Box::new(move |replayed| recorded.took_the_sides_of(case, replayed)),
        }
    }

    fn radiance(&self, method: &Method) -> Result<Float, MethodError> {
        let mut level = Level::of_any(self.nodes, self.n);
        let ran = run(&mut level, method, Stop::AsDeclared)?;
        Ok(ran.radiance.to_float())
    }
}

/// Whether the sums of both look at the same transmittances: those at boundaries, by the same inner rule and exponential.
fn looks_alike(a: &Method, b: &Method) -> bool {
    match (a, b) {
        (Method::Nested(a), Method::Nested(b)) => {
            let closed = a.outer.0.intervals().is_some() && b.outer.0.intervals().is_some();
            let of = |nested: &Nested| (nested.inner, nested.exponential, nested.scope);
            closed && of(a) == of(b)
        }
        _ => false,
    }
}

fn floats<R: Real>(values: &[R]) -> Vec<MpfrReal> {
    row(values.iter().map(|x| MpfrReal::from(x.to_float())))
}
