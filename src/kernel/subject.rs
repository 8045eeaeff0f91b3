//! A case as kernels see it: in binary64, with all its channels.

use super::cut::Places;
use super::{Cut, CutError, Formula, Samples, Segments, Table, Volume};
use crate::case::{Case, SymbolicCase};
use crate::real::{Format, Native};
use crate::symbolic::code::{Definition, Language, source};
use crate::symbolic::{CompileError, Program};
use rug::Rational;

/// The name of the channel of a case that has none.
const ONLY_CHANNEL: &str = "radiance";

/// A case with its channels, which share the field, the extinction and the ray.
///
/// Values are what the case's formulas give in binary64, at places rounded once: those that
/// [`Fresh`](crate::case::Fresh) gives methods.
#[derive(Clone, Debug)]
pub struct Subject {
    name: String,
    channels: Vec<String>,
    cases: Vec<SymbolicCase>,
    length: Rational,
    background: Vec<f64>,
}

/// Channels that make no case together.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SubjectError {
    /// Not a single one.
    #[error("no channel (allowed: at least one)")]
    Empty,
    /// A background of other channels.
    #[error("a background of {got} channels (allowed: {wanted}, those of the case)")]
    Background {
        /// How many came.
        got: usize,
        /// How many there are.
        wanted: usize,
    },
    /// Another ray, field or extinction than the first channel's.
    #[error(
        "channel '{channel}' has another ray than the first (allowed: the same length, field and extinction)"
    )]
    Different {
        /// Which.
        channel: String,
    },
}

impl Subject {
    /// The case of these channels.
    ///
    /// # Errors
    /// [`SubjectError`] where there is none, or they differ in more than their emission.
    pub fn new(
        name: &str,
        channels: Vec<(Option<String>, SymbolicCase)>,
    ) -> Result<Self, SubjectError> {
        let (_, first) = channels.first().ok_or(SubjectError::Empty)?;
        let length = first.length();
        for (channel, case) in &channels {
            let (own, shared) = (case.formulas(), first.formulas());
            if own.field != shared.field
                || own.extinction != shared.extinction
                || case.length() != length
            {
                let channel = channel.clone().unwrap_or_else(|| case.name().into());
                return Err(SubjectError::Different { channel });
            }
        }
        let named = |(channel, case): (Option<String>, SymbolicCase)| {
            (channel.unwrap_or_else(|| ONLY_CHANNEL.into()), case)
        };
        let (channels, cases) = channels.into_iter().map(named).unzip();
        Ok(Subject {
            name: name.into(),
            channels,
            cases,
            length,
            background: Vec::new(),
        })
    }

    /// The same ray before a background, a radiance at λ = D of every channel.
    ///
    /// # Errors
    /// [`SubjectError::Background`] where it has other channels.
    pub fn before(self, background: Vec<f64>) -> Result<Self, SubjectError> {
        let (got, wanted) = (background.len(), self.channels.len());
        if got != wanted {
            return Err(SubjectError::Background { got, wanted });
        }
        Ok(Subject { background, ..self })
    }

    /// The same ray before nothing.
    #[must_use]
    pub(crate) fn before_nothing(self) -> Self {
        Subject {
            background: Vec::new(),
            ..self
        }
    }

    /// What comes from behind the end of the ray, of every channel; empty where that is nothing.
    #[must_use]
    pub fn background(&self) -> &[f64] {
        &self.background
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The names of the channels, at least one.
    #[must_use]
    pub fn channels(&self) -> &[String] {
        &self.channels
    }

    /// The case of each channel.
    #[must_use]
    pub fn cases(&self) -> &[SymbolicCase] {
        &self.cases
    }

    /// D.
    #[must_use]
    pub fn length(&self) -> &Rational {
        &self.length
    }

    /// s(λ).
    #[must_use]
    pub fn field(&self, lambda: f64) -> f64 {
        self.cases
            .first()
            .map_or(f64::NAN, |case| case.field(&lambda))
    }

    /// τ(s(λ)), and into `emission` C(s(λ)) of every channel, in their order.
    pub fn at(&self, lambda: f64, emission: &mut [f64]) -> f64 {
        self.of_field(self.field(lambda), emission)
    }

    /// τ(s), and into `emission` C(s) of every channel, in their order.
    pub fn of_field(&self, s: f64, emission: &mut [f64]) -> f64 {
        let mut extinction = f64::NAN;
        for (case, emission) in self.cases.iter().zip(emission) {
            let transfer = case.transfer(&s);
            *emission = transfer.emission;
            extinction = transfer.extinction;
        }
        extinction
    }

    /// The ray cut into segments.
    ///
    /// # Errors
    /// [`CutError`] where that is not possible.
    pub fn segments(&self, cut: Cut) -> Result<Segments, CutError> {
        let places = cut.places(&self.length)?;
        Ok(self.at_places(places))
    }

    /// The segments with these ends.
    #[must_use]
    pub fn segments_between(&self, edges: Vec<f64>) -> Segments {
        self.at_places(Places::of(edges))
    }

    fn at_places(&self, places: Places) -> Segments {
        Segments {
            edges: self.samples(places.edges),
            middles: self.samples(places.middles),
        }
    }

    fn samples(&self, lambda: Vec<f64>) -> Samples {
        let (extinction, emission) = self.of_fields(&self.fields(&lambda));
        Samples {
            lambda,
            extinction,
            emission,
        }
    }

    /// s at many places.
    fn fields(&self, lambda: &[f64]) -> Vec<f64> {
        let first = self.cases.first();
        first.map_or_else(Vec::new, |case| case.fields(lambda))
    }

    /// τ at many field values, and C there of every channel, in their order.
    fn of_fields(&self, s: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let mut extinction = Vec::new();
        let mut emission = Vec::with_capacity(self.cases.len());
        for case in &self.cases {
            let transfers = case.transfers(s);
            emission.push(transfers.emission);
            extinction = transfers.extinction;
        }
        (extinction, emission)
    }

    /// The ray through a volume: the field at `cells` + 1 places, and tables of `entries` entries over the
    /// range that the field has there.
    #[must_use]
    pub fn volume(&self, cells: u64, entries: usize) -> Volume {
        let format = Native::<f64>::new();
        let places = (0..=cells).map(|i| format.ratio(&(Rational::from(&self.length * i) / cells)));
        let field = self.fields(&places.collect::<Vec<f64>>());
        let first = field.iter().copied().fold(f64::INFINITY, f64::min);
        let last = field.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Volume {
            table: self.table(first, last, entries),
            field,
        }
    }

    /// Tables of the transfer functions from `first` to `last`.
    #[must_use]
    pub fn table(&self, first: f64, last: f64, entries: usize) -> Table {
        let intervals = entries.saturating_sub(1).max(1) as f64;
        let values = (0..entries).map(|entry| {
            let part = entry as f64 / intervals;
            first * (1.0 - part) + last * part
        });
        let (extinction, emission) = self.of_fields(&values.collect::<Vec<f64>>());
        Table {
            first,
            last,
            extinction,
            emission,
        }
    }

    /// The case as source code.
    ///
    /// # Errors
    /// [`CompileError`] where a formula has another symbol than its own, which no case of files has.
    pub fn formula(&self, language: Language) -> Result<Formula, CompileError> {
        let mut wanted: Vec<(String, &str, Program)> = Vec::new();
        if let Some(case) = self.cases.first() {
            let formulas = case.formulas();
            for (name, doc, of, input) in [
                ("field", "Field s at lambda.", &formulas.field, "lambda"),
                (
                    "extinction",
                    "Extinction tau of the field value s, per unit of length.",
                    &formulas.extinction,
                    "s",
                ),
            ] {
                let program = Program::new(std::slice::from_ref(of), &[input])?;
                wanted.push((name.into(), doc, program));
            }
        }
        for (channel, case) in self.channels.iter().zip(&self.cases) {
            let of = &case.formulas().emission;
            let program = Program::new(std::slice::from_ref(of), &["s"])?;
            let doc = "Emission C of the field value s, per unit of optical depth.";
            wanted.push((format!("emission_{channel}"), doc, program));
        }
        let definitions: Vec<Definition<'_>> = wanted
            .iter()
            .map(|(name, doc, program)| Definition { name, doc, program })
            .collect();
        let constants = [("LENGTH", &self.length)];
        Ok(Formula {
            language,
            code: source(language, &self.name, &constants, &definitions),
        })
    }
}
