//! Gradients of a kernel beside theory, on a ladder of n.
//!
//! The derivative of I by a function of λ is a function of λ: δI/δC(λ) = τ T and δI/δτ(λ) = T C − R(λ), R being what
//! comes from behind λ. A kernel's derivative by the number of one sample, divided by the length that the sample stands
//! for, tends to it with the order of its quadrature. With cotangents aₖ of channels these are aₖ τ T and Σ aₖ (T Cₖ − Rₖ).

mod along;
mod asked;
mod bias;
mod compare;
mod integrated;
mod line;
mod places;

pub use bias::{Against, Bias, Biased};
pub use line::{Line, Standing};
pub use places::{LeftOut, Places, PlacesError};

use super::Progress;
use super::verify::{Settings, SettingsError, before};
use crate::case::Unproved;
use crate::convergence::Verdict;
use crate::kernel::{
    CutError, Declaration, DeclarationError, Kernel, KernelError, Quantity, Subject, SubjectError,
};
use crate::method::Expected;
use crate::reference::ReferenceError;
use asked::Asked;

/// Smooth cases on which samples of order 1 and 2 show their orders: rays of several lengths and depths, one that
/// begins in a vacuum, and such with several channels.
pub const CASES: [&str; 7] = [
    "atmosphere",
    "decaying-field",
    "hyperbolic-tangent",
    "oscillating-field",
    "rgb-radiance",
    "rgb-transfer",
    "sine-squared",
];

/// By which numbers of a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Derivative {
    /// τ.
    Extinction,
    /// C, of all channels.
    Emission,
}

impl Derivative {
    /// Both, in the order of arrays.
    pub const ALL: [Derivative; 2] = [Derivative::Extinction, Derivative::Emission];

    /// Its name, as in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Derivative::Extinction => "extinction",
            Derivative::Emission => "emission",
        }
    }
}

/// How the errors of a level become one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Norm {
    /// The largest.
    Largest,
    /// The root of the mean of squares, each with the length that it stands for.
    MeanSquare,
}

impl Norm {
    /// Both.
    pub const ALL: [Norm; 2] = [Norm::Largest, Norm::MeanSquare];

    /// Its name, as in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Norm::Largest => "largest",
            Norm::MeanSquare => "mean-square",
        }
    }
}

/// What is wrong with a gradient whatever its order is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Trouble {
    /// A derivative is no number, though the radiance is one.
    NotFinite {
        /// By which numbers.
        derivative: Derivative,
        /// The number of segments.
        segments: u64,
    },
    /// All are exactly 0, at every level, and should not be.
    Zero(Derivative),
    /// The same question has another answer the second time.
    Unsteady,
    /// A value that is not used where the kernel samples has a derivative.
    Unused {
        /// The number of segments.
        segments: u64,
    },
}

impl Trouble {
    /// Its name, as in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Trouble::NotFinite { .. } => "not-finite",
            Trouble::Zero(_) => "zero",
            Trouble::Unsteady => "unsteady",
            Trouble::Unused { .. } => "unused",
        }
    }

    /// Whether it speaks against that derivative.
    #[must_use]
    pub fn concerns(self, derivative: Derivative) -> bool {
        match self {
            Trouble::Zero(own)
            | Trouble::NotFinite {
                derivative: own, ..
            } => own == derivative,
            Trouble::Unsteady | Trouble::Unused { .. } => true,
        }
    }
}

/// A level without an answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// The number of segments.
    pub segments: u64,
    /// Why.
    pub error: LevelError,
}

/// Why a level has no gradient that could be compared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LevelError {
    /// The kernel gave none.
    #[error(transparent)]
    Kernel(#[from] KernelError),
    /// It says that it cut the ray otherwise: its numbers are not those of the task.
    #[error(
        "it cut the ray otherwise than asked (allowed: derivatives by the numbers of the task)"
    )]
    OtherCut,
}

/// What came out on one case.
#[derive(Clone, Debug, PartialEq)]
pub struct OfCase {
    /// Its name.
    pub name: String,
    /// Its channels.
    pub channels: Vec<String>,
    /// The cotangents that were asked with, one a channel.
    pub cotangents: Vec<f64>,
    /// What theory rests on and is not proved.
    pub unproved: Vec<Unproved>,
    /// By how much T and what comes from behind may be off at most, where there are no closed forms.
    pub integrated: Option<f64>,
    /// Samples left out, of all levels together.
    pub left_out: LeftOut,
    /// How many samples there are, of all levels together.
    pub samples: usize,
    /// Levels without an answer.
    pub failures: Vec<Failure>,
    /// What is wrong whatever the order is.
    pub troubles: Vec<Trouble>,
    /// A derivative and norm each; none of a kernel that draws random numbers.
    pub lines: Vec<Line>,
    /// Means over seeds, of a kernel that draws random numbers.
    pub biases: Vec<Bias>,
}

/// What came out.
#[derive(Clone, Debug, PartialEq)]
pub struct Gradients {
    /// What the kernel says of itself.
    pub declaration: Declaration,
    /// How it was asked.
    pub settings: Settings,
    /// Which values its samples are.
    pub places: Places,
    /// The orders that its derivatives have to show on smooth cases.
    pub orders: [f64; 2],
    /// Case by case.
    pub cases: Vec<OfCase>,
}

/// What gradients say in all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Conclusion {
    /// Nothing contradicts, and of each derivative more lines are confirmed than not, but for those that rounding ends.
    Confirmed,
    /// Something contradicts or fails, or too little is confirmed.
    NotConfirmed,
    /// No level of any case was answered.
    CouldNotRun,
}

impl Conclusion {
    /// Its name, as in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Conclusion::Confirmed => "confirmed",
            Conclusion::NotConfirmed => "not confirmed",
            Conclusion::CouldNotRun => "could not run",
        }
    }
}

impl Gradients {
    /// All lines.
    pub fn lines(&self) -> impl Iterator<Item = &Line> {
        self.cases.iter().flat_map(|case| &case.lines)
    }

    /// All means over seeds.
    pub fn biases(&self) -> impl Iterator<Item = &Bias> {
        self.cases.iter().flat_map(|case| &case.biases)
    }

    /// Of all lines and means what they say of which derivative, but for those that rounding ends.
    fn standings(&self) -> impl Iterator<Item = (Derivative, Standing)> {
        // Where rounding ends the ladder no gradient shows an order.
        let shown = |line: &&Line| line.fit.verdict != Verdict::FloorLimited;
        let lines = self.lines().filter(shown);
        let lines = lines.map(|line| (line.derivative, line.standing));
        let biases = self.biases().map(|bias| (bias.derivative, bias.standing));
        lines.chain(biases)
    }

    /// How many lines and means stand so.
    #[must_use]
    pub fn count(&self, standing: Standing) -> usize {
        let lines = self.lines().map(|line| line.standing);
        let all = lines.chain(self.biases().map(|bias| bias.standing));
        all.filter(|own| *own == standing).count()
    }

    /// What they say in all.
    #[must_use]
    pub fn conclusion(&self) -> Conclusion {
        let is_without = |case: &OfCase| {
            !case.failures.is_empty()
                && case.lines.iter().all(|line| line.samples.is_empty())
                && case.biases.is_empty()
        };
        let is_shown = Derivative::ALL.into_iter().all(|derivative| {
            let of = self.standings().filter(|(own, _)| *own == derivative);
            let (confirmed, other): (Vec<_>, Vec<_>) =
                of.partition(|(_, standing)| *standing == Standing::Confirmed);
            confirmed.len() > other.len()
        });
        let is_failed = self.cases.iter().any(|case| !case.failures.is_empty());
        let is_wrong = is_failed || self.count(Standing::Contradicted) > 0;
        if self.cases.iter().all(is_without) {
            Conclusion::CouldNotRun
        } else if is_shown && !is_wrong {
            Conclusion::Confirmed
        } else {
            Conclusion::NotConfirmed
        }
    }
}

/// What no gradients can be compared with theory for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GradientError {
    /// The kernel declares what cannot all be.
    #[error(transparent)]
    Declaration(#[from] DeclarationError),
    /// It does not differentiate.
    #[error(transparent)]
    Kernel(#[from] KernelError),
    /// Its gradient is of no radiance.
    #[error("it answers no radiance (allowed: one that does; a projector has 'volver adjoint')")]
    NoRadiance,
    /// It samples elsewhere than where it differentiates.
    #[error(transparent)]
    Places(#[from] PlacesError),
    /// The kernel takes what the ladder has not enough of.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// A background that is none of the case.
    #[error(transparent)]
    Background(#[from] SubjectError),
    /// The ray of a case cannot be cut so.
    #[error("{case}: {error}")]
    Cut {
        /// The case.
        case: String,
        /// Why.
        error: CutError,
    },
    /// A case has no reference.
    #[error("{case}: {error}")]
    Reference {
        /// The case.
        case: String,
        /// Why.
        error: ReferenceError,
    },
    /// Errors over seeds that no fit can take.
    #[error("{case}: {error}")]
    Replicas {
        /// The case.
        case: String,
        /// Why.
        error: crate::convergence::ReplicasError,
    },
    /// Errors that no fit can take.
    #[error("{case}: {error}")]
    Fit {
        /// The case.
        case: String,
        /// Why.
        error: crate::convergence::FitError,
    },
}

/// Asks a kernel for its gradients on all subjects and levels; a unit of progress is a segment.
///
/// # Errors
/// [`GradientError`] where it does not differentiate, or nothing can be compared. What it does wrong is no error but
/// stands in the lines.
pub fn gradients(
    kernel: &mut dyn Kernel,
    subjects: &[Subject],
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<Gradients, GradientError> {
    let declaration = kernel.declaration().clone();
    declaration.check()?;
    let at = declaration.gradient.ok_or(KernelError::NoGradient)?;
    if !declaration.has(Quantity::Radiance) {
        return Err(GradientError::NoRadiance);
    }
    let places = Places::of(&declaration, at)?;
    let settings = settings.suited(&declaration)?;
    let lit = before(subjects, &declaration, &settings)?;
    let orders = Derivative::ALL.map(|derivative| order(&declaration, places, derivative));
    let asked = Asked {
        declaration: &declaration,
        settings: &settings,
        places,
        orders,
    };
    let mut cases = Vec::new();
    for subject in &lit {
        kernel.renew();
        cases.push(if declaration.stochastic {
            asked.drawn(kernel, subject, progress)?
        } else {
            asked.of(kernel, subject, progress)?
        });
    }
    Ok(Gradients {
        declaration,
        settings,
        places,
        orders,
        cases,
    })
}

/// That of the places, or a lower one that is declared. A sample stands for a wall up to a step in front of it: what comes
/// from behind has order 1 then, and with it the derivative by τ.
fn order(declaration: &Declaration, places: Places, derivative: Derivative) -> f64 {
    let claimed = declaration.claimed_order().unwrap_or(f64::INFINITY);
    let of_wall = match derivative {
        Derivative::Extinction if declaration.far_wall => 1.0,
        Derivative::Extinction | Derivative::Emission => f64::INFINITY,
    };
    places.order().min(claimed).min(of_wall)
}

/// What is expected on a case: theory says an order where it is smooth.
fn expected(order: f64, subject: &Subject) -> Expected {
    use crate::case::Case;
    let is_smooth = |case: &crate::case::SymbolicCase| case.structure().breaks.is_empty();
    if subject.cases().iter().all(is_smooth) {
        Expected::Order(order)
    } else {
        Expected::Unknown
    }
}
