//! What a kernel is given.

use super::Medium;
use crate::symbolic::code::Language;
use std::fmt;

/// One ray to render.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    /// The ray. As many radiances are wanted as it has channels.
    pub subject: &'a dyn Medium,
    /// The step d asked for; of uneven segments their mean length.
    pub step: f64,
    /// How many segments that makes: ⌈D/d⌉, the last one shorter where d does not divide D and they are not uneven.
    pub segments: u64,
    /// For kernels that draw random numbers: the same seed, the same answer.
    pub seed: u64,
    /// The ray in the form that the kernel asked for.
    pub data: Data<'a>,
}

impl<'a> Task<'a> {
    /// The segments, where it is these that the kernel asked for.
    #[must_use]
    pub fn cut(&self) -> Option<&'a Segments> {
        match self.data {
            Data::Segments(segments) => Some(segments),
            _ => None,
        }
    }
}

/// The form in which a kernel wants its ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FormKind {
    /// C and τ at the ends and the middle of every segment.
    Segments,
    /// A grid of field values and tables of the transfer functions.
    Volume,
    /// Source code of s, τ and C.
    Formula(Language),
    /// A function λ → (C, τ) to call, [`Medium::at`]; for kernels in this process alone.
    Function,
}

impl fmt::Display for FormKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            FormKind::Segments => "segments",
            FormKind::Volume => "volume",
            FormKind::Formula(_) => "formula",
            FormKind::Function => "function",
        })
    }
}

/// A ray in one of the forms.
#[derive(Clone, Copy, Debug)]
pub enum Data<'a> {
    /// [`FormKind::Segments`].
    Segments(&'a Segments),
    /// [`FormKind::Volume`].
    Volume(&'a Volume),
    /// [`FormKind::Formula`].
    Formula(&'a Formula),
    /// [`FormKind::Function`]: that of the subject.
    Function,
}

/// Values at a row of places.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    /// λ.
    pub lambda: Vec<f64>,
    /// τ.
    pub extinction: Vec<f64>,
    /// C, by channel and place.
    pub emission: Vec<Vec<f64>>,
}

/// A ray cut into n segments.
#[derive(Clone, Debug, PartialEq)]
pub struct Segments {
    /// The n + 1 ends, from 0 to D.
    pub edges: Samples,
    /// The n middles.
    pub middles: Samples,
}

impl Segments {
    /// n.
    #[must_use]
    pub fn count(&self) -> usize {
        self.middles.lambda.len()
    }

    /// The lengths of the segments: all the same but perhaps the last, if they are not spaced unevenly.
    #[must_use]
    pub fn lengths(&self) -> impl ExactSizeIterator<Item = f64> + '_ {
        self.edges.lambda.windows(2).map(|ends| ends[1] - ends[0])
    }
}

/// A ray through a volume: field values on a grid along it, linear between them, and tables of the transfer
/// functions over the field's range, linear between their entries.
#[derive(Clone, Debug, PartialEq)]
pub struct Volume {
    /// s at the m + 1 places D·i/m.
    pub field: Vec<f64>,
    /// The transfer functions.
    pub table: Table,
}

/// τ(s) and C(s) at evenly spaced field values.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The field value of the first entry.
    pub first: f64,
    /// The field value of the last entry.
    pub last: f64,
    /// τ.
    pub extinction: Vec<f64>,
    /// C, by channel and entry.
    pub emission: Vec<Vec<f64>>,
}

/// A case as source code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formula {
    /// The language.
    pub language: Language,
    /// Defines `LENGTH`, `field(lambda)`, `extinction(s)` and for every channel `emission_CHANNEL(s)`.
    pub code: String,
}

impl Data<'_> {
    /// Which form it is.
    #[must_use]
    pub fn kind(&self) -> FormKind {
        match self {
            Data::Segments(_) => FormKind::Segments,
            Data::Volume(_) => FormKind::Volume,
            Data::Formula(formula) => FormKind::Formula(formula.language),
            Data::Function => FormKind::Function,
        }
    }
}
