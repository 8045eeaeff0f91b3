//! What a kernel says of itself.

use super::{
    DepthWeights, FormKind, GradientAt, InnerProduct, Quantity, Quantum, Source, UlpBound,
};
use crate::method::{Expected, Method, Position};
use crate::real::FormatName;
use std::fmt;
use std::num::{NonZeroU64, NonZeroUsize};
use std::str::FromStr;

/// What a kernel claims to compute, and in what it answers. What it leaves out is found out, or taken from the
/// defaults of [`Declaration::new`].
#[derive(Clone, Debug, PartialEq)]
// Facts that do not depend on each other.
#[allow(clippy::struct_excessive_bools)]
pub struct Declaration {
    /// Its name, for reports.
    pub name: String,
    /// What it is to be given.
    pub form: FormKind,
    /// By which values it differentiates, where it does.
    pub gradient: Option<GradientAt>,
    /// In which inner product of these values its gradient of the optical depth is the adjoint Aᵀ y, where it is a
    /// projector y = A x.
    pub adjoint: Option<InnerProduct>,
    /// How many rays it takes in one request as arrays, where it is a process that does.
    pub batch: Option<NonZeroUsize>,
    /// The method of this crate that it means to be, if there is one: then the order expected on every case
    /// follows from theory, and the values themselves are compared.
    pub method: Option<Method>,
    /// The order of accuracy that it claims on smooth cases; a method says more.
    pub order: Option<f64>,
    /// The format that it computes in.
    pub format: FormatName,
    /// The format that its answers are rounded to at the end, once, where that is another one.
    pub output: Option<FormatName>,
    /// What its answers are multiples of, where that is coarser than the format: 1/255 of an 8-bit image,
    /// 2⁻¹⁵ of 15-bit fixed point; in the units of the radiance, or as a part of the ray's largest emission.
    pub quantum: Option<Quantum>,
    /// How far off its exponentials e^x are, where that is more than rounding.
    pub exp_ulp: Option<UlpBound>,
    /// The same of e^x − 1.
    pub expm1_ulp: Option<UlpBound>,
    /// The same of powers b^d, x being d log₂ b.
    pub pow_ulp: Option<UlpBound>,
    /// Numbers below the smallest normal one of the format may be 0 to it.
    pub subnormals_lost: bool,
    /// By so much its answers may be off by chance, in the units of the answer: sums in an order that nobody determines.
    pub noise: Option<f64>,
    /// So many channels a ray has to have; those of others are asked in pieces.
    pub channels: Option<NonZeroUsize>,
    /// It takes no negative emission, and is asked none.
    pub positive_emission: bool,
    /// What it is given for emission.
    pub source: Source,
    /// Monte Carlo: the answer depends on the seed, and scatters.
    pub stochastic: bool,
    /// Where it samples a segment, where the method does not say.
    pub sampling: Option<Sampling>,
    /// It works where the step divides the ray, and is asked nothing else.
    pub step_divides: bool,
    /// It works on numbers of segments that are multiples of this, and is asked nothing else.
    pub multiple_of: NonZeroU64,
    /// It takes the last segment to be opaque, as with a length of 1e10: a wall of the last sample's emission
    /// stands at the end of the ray.
    pub far_wall: bool,
    /// It takes a background, a radiance at the end of the ray, and is given one.
    pub background: bool,
    /// What it answers of every ray, at least one. An opacity beside the radiance needs no word before.
    pub answers: Vec<Quantity>,
    /// What its expected depth is divided by, where it answers one.
    pub expected_depth: DepthWeights,
}

impl Declaration {
    /// A deterministic kernel in binary64 before a black background, given segments, of which nothing else
    /// is known.
    #[must_use]
    pub fn new(name: &str) -> Self {
        Declaration {
            name: name.into(),
            form: FormKind::Segments,
            gradient: None,
            adjoint: None,
            batch: None,
            method: None,
            order: None,
            format: FormatName::F64,
            output: None,
            quantum: None,
            exp_ulp: None,
            expm1_ulp: None,
            pow_ulp: None,
            subnormals_lost: false,
            noise: None,
            channels: None,
            positive_emission: false,
            source: Source::Depth,
            stochastic: false,
            sampling: None,
            step_divides: false,
            multiple_of: NonZeroU64::MIN,
            far_wall: false,
            background: false,
            answers: vec![Quantity::Radiance],
            expected_depth: DepthWeights::Plain,
        }
    }

    /// Whether it says that it answers that; the emission is a radiance, of a source per length.
    #[must_use]
    pub fn has(&self, quantity: Quantity) -> bool {
        match quantity {
            Quantity::Emission => {
                self.source == Source::Length && self.answers.contains(&Quantity::Radiance)
            }
            _ => self.answers.contains(&quantity),
        }
    }

    /// The first in the order of reports of what it answers.
    #[must_use]
    pub fn first_answer(&self) -> Quantity {
        let first = self.answers.iter().min();
        first.copied().unwrap_or(Quantity::Radiance)
    }

    /// Whether all of it can be at once.
    ///
    /// # Errors
    /// [`DeclarationError`] where a method is declared, and beside it what is not the method's; where it answers
    /// nothing, or the optical depth of a wall.
    pub fn check(&self) -> Result<(), DeclarationError> {
        if self.answers.is_empty() {
            return Err(DeclarationError::NoAnswers);
        }
        if self.far_wall && self.background {
            return Err(DeclarationError::BackgroundOfWall);
        }
        if self.far_wall && self.has(Quantity::OpticalDepth) {
            return Err(DeclarationError::DepthOfWall);
        }
        if self.stochastic && self.noise.is_some() {
            return Err(DeclarationError::NoiseOfRandom);
        }
        if self.gradient.is_some() && self.channels.is_some() {
            return Err(DeclarationError::GradientInPieces);
        }
        if self.source == Source::Length {
            if self.form != FormKind::Segments {
                return Err(DeclarationError::SourceOfForm { form: self.form });
            }
            if self.gradient.is_some() {
                return Err(DeclarationError::GradientOfSource);
            }
            if self.far_wall {
                return Err(DeclarationError::SourceOfWall);
            }
        }
        let Some(method) = self.method else {
            return Ok(());
        };
        if let (Some(declared), Expected::Order(own) | Expected::Blind { general: own, .. }) =
            (self.order, method.order())
            && (declared - own).abs() > f64::EPSILON * own
        {
            return Err(DeclarationError::Order {
                method: method.name(),
                declared,
                own,
            });
        }
        let own = match method {
            Method::Composited(compositing) => Sampling::from(compositing.position),
            Method::Nested(_) | Method::Preintegrated(_) | Method::Layered(_) => return Ok(()),
        };
        match self.sampling {
            // What is jittered about a place is meant to be the method in the mean.
            None | Some(Sampling::Jittered) => Ok(()),
            Some(declared) if declared == own => Ok(()),
            Some(declared) => Err(DeclarationError::Sampling {
                method: method.name(),
                declared,
                own,
            }),
        }
    }

    /// The order that it claims on smooth cases: as it says, or as its method has it.
    #[must_use]
    pub fn claimed_order(&self) -> Option<f64> {
        let of_method = || match self.method?.order() {
            Expected::Order(own) | Expected::Blind { general: own, .. } => Some(own),
            Expected::Exact | Expected::Unknown => None,
        };
        self.order.or_else(of_method)
    }

    /// Where the sample of its far wall lies, if it has one.
    #[must_use]
    pub fn wall(&self) -> Option<WallAt> {
        self.far_wall.then(|| match self.claimed_sampling() {
            Some(Sampling::Back | Sampling::Ends) => WallAt::End,
            Some(Sampling::Front | Sampling::Middle | Sampling::Jittered) | None => {
                WallAt::BeforeEnd
            }
        })
    }

    /// What all its answers are multiples of, whatever the ray is: a quantum, or that of a fixed-point format.
    #[must_use]
    pub fn fixed_quantum(&self) -> Option<f64> {
        match (self.quantum, self.output) {
            (Some(Quantum::Absolute(quantum)), _) => Some(quantum),
            // A quantum is twice as much as rounding to it takes.
            (None, Some(output @ FormatName::Fixed(_))) => Some(2.0 * output.half_unit(1.0)),
            (Some(Quantum::Relative(_)) | None, _) => None,
        }
    }

    /// Where it claims to sample: as it says, or as its method does.
    #[must_use]
    pub fn claimed_sampling(&self) -> Option<Sampling> {
        let of_method = || match self.method? {
            Method::Composited(compositing) => Some(compositing.position.into()),
            Method::Nested(_) | Method::Preintegrated(_) | Method::Layered(_) => None,
        };
        self.sampling.or_else(of_method)
    }
}

/// What a kernel declares, and cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DeclarationError {
    /// Nothing is answered.
    #[error(
        "it declares no answers (allowed: one or more of radiance, opacity, optical_depth, expected_depth)"
    )]
    NoAnswers,
    /// A background behind a wall.
    #[error(
        "it declares a far wall and a background, which is not seen behind it (allowed: one of the two)"
    )]
    BackgroundOfWall,
    /// The optical depth of a ray that ends at a wall.
    #[error(
        "it declares a far wall and the optical depth, which has no end there (allowed: one of the two)"
    )]
    DepthOfWall,
    /// Noise of random numbers.
    #[error(
        "it declares noise and random numbers, whose scatter is measured (allowed: one of the two)"
    )]
    NoiseOfRandom,
    /// Gradients of rays in pieces.
    #[error(
        "it declares a gradient and how many channels a ray has to have (allowed: one of the two)"
    )]
    GradientInPieces,
    /// A source per length where no segments are given.
    #[error("it declares a source per length and the form {form} (allowed: segments)")]
    SourceOfForm {
        /// The form.
        form: FormKind,
    },
    /// Derivatives by a source per length.
    #[error("it declares a gradient and a source per length (allowed: one of the two)")]
    GradientOfSource,
    /// A wall that nothing absorbs in front of.
    #[error(
        "it declares a far wall and a source per length, which has no end there (allowed: one of the two)"
    )]
    SourceOfWall,
    /// Another order than the method's.
    #[error(
        "it declares order {declared} and method '{method}', which has order {own} (allowed: {own}, or one of the two)"
    )]
    Order {
        /// The method.
        method: String,
        /// The order declared.
        declared: f64,
        /// The method's.
        own: f64,
    },
    /// Samples elsewhere than the method's.
    #[error(
        "it declares sampling '{declared}' and method '{method}', which samples '{own}' (allowed: '{own}', or one of the two)"
    )]
    Sampling {
        /// The method.
        method: String,
        /// The sampling declared.
        declared: Sampling,
        /// The method's.
        own: Sampling,
    },
}

/// Where the sample lies that a far wall is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum WallAt {
    /// Up to a step in front of the end of the ray.
    BeforeEnd,
    /// At the end: where the medium absorbs nothing there, there is no wall.
    End,
}

/// Where a kernel samples its segments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sampling {
    /// At the end nearer to the eye.
    Front,
    /// In the middle.
    Middle,
    /// At the end farther from the eye.
    Back,
    /// At both ends.
    Ends,
    /// Somewhere in each segment, by chance.
    Jittered,
}

impl Sampling {
    /// All of them.
    pub const ALL: [Sampling; 5] = [
        Sampling::Front,
        Sampling::Middle,
        Sampling::Back,
        Sampling::Ends,
        Sampling::Jittered,
    ];
}

impl From<Position> for Sampling {
    fn from(position: Position) -> Self {
        match position {
            Position::Front => Sampling::Front,
            Position::Middle => Sampling::Middle,
            Position::Back => Sampling::Back,
        }
    }
}

impl fmt::Display for Sampling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Sampling::Front => "front",
            Sampling::Middle => "middle",
            Sampling::Back => "back",
            Sampling::Ends => "ends",
            Sampling::Jittered => "jittered",
        })
    }
}

/// Text that names no sampling.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown sampling '{}' (allowed: front, middle, back, ends, jittered)", name.escape_debug())]
pub struct SamplingError {
    /// The text given.
    pub name: String,
}

impl FromStr for Sampling {
    type Err = SamplingError;

    fn from_str(name: &str) -> Result<Self, SamplingError> {
        let mut all = Sampling::ALL.into_iter();
        all.find(|sampling| sampling.to_string() == name)
            .ok_or_else(|| SamplingError { name: name.into() })
    }
}
