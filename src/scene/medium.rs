//! What a scene is made of.

use crate::case::Transfer;
use crate::real::{Format, Native};
use crate::symbolic::{Expr, KeptProgram};
use rug::Rational;
use std::sync::Arc;

/// C and τ, exactly.
pub type Values = Transfer<Rational>;

/// A ray through media, seen from its front; cheap to clone.
#[derive(Clone, Debug)]
pub struct Scene {
    inner: Arc<Inner>,
}

#[derive(Debug)]
struct Inner {
    name: String,
    channels: Vec<String>,
    background: Vec<Rational>,
    media: Vec<Medium>,
    fingerprint: String,
}

impl Scene {
    /// What was read; `channels` and `background` are as many.
    pub(super) fn new(
        name: String,
        channels: Vec<String>,
        background: Vec<Rational>,
        media: Vec<Medium>,
    ) -> Scene {
        let fingerprint = super::fingerprint::of(&channels, &background, &media);
        let inner = Inner {
            name,
            channels,
            background,
            media,
            fingerprint,
        };
        Scene {
            inner: Arc::new(inner),
        }
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.inner.name
    }

    /// The names of its channels: one, empty, where the file names none.
    #[must_use]
    pub fn channels(&self) -> &[String] {
        &self.inner.channels
    }

    /// The radiance that comes in at the far end, by channel.
    #[must_use]
    pub fn background(&self) -> &[Rational] {
        &self.inner.background
    }

    /// The media from front to back, each beginning where the one before ends.
    #[must_use]
    pub fn media(&self) -> &[Medium] {
        &self.inner.media
    }

    /// 16 hexadecimal digits that tell one scene from another: a plan belongs to one.
    #[must_use]
    pub fn fingerprint(&self) -> &str {
        &self.inner.fingerprint
    }
}

/// What a file calls a medium.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Nothing.
    Vacuum,
    /// The same C and τ everywhere.
    Constant,
    /// C and τ linear in λ.
    Linear,
    /// Expressions of λ, or of a field.
    Expression,
    /// Samples of a field along the ray.
    Sampled,
}

impl Kind {
    /// As a file has it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Kind::Vacuum => "vacuum",
            Kind::Constant => "constant",
            Kind::Linear => "linear",
            Kind::Expression => "expression",
            Kind::Sampled => "sampled",
        }
    }
}

/// One medium of a ray.
#[derive(Clone, Debug)]
pub struct Medium {
    /// Its name; where the file has none its number, from 1.
    pub name: String,
    /// What the file calls it.
    pub kind: Kind,
    /// From front to back, each beginning where the one before ends.
    pub pieces: Vec<Piece>,
    /// How far, all in all, the places between pieces may be from where they are told: 0 where these are rational
    /// or have a closed form.
    pub blur: f64,
    /// What could neither be proved of it nor refuted.
    pub unproved: Vec<&'static str>,
}

impl Medium {
    /// Where it begins.
    #[must_use]
    pub fn from(&self) -> Rational {
        self.pieces
            .first()
            .map_or_else(Rational::new, |p| p.from.clone())
    }

    /// Where it ends.
    #[must_use]
    pub fn to(&self) -> Rational {
        self.pieces
            .last()
            .map_or_else(Rational::new, |p| p.to.clone())
    }
}

/// A part of a medium in which C and τ are analytic.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Where it begins.
    pub from: Rational,
    /// Where it ends.
    pub to: Rational,
    /// What C and τ are there.
    pub form: Form,
}

/// What C and τ are in a piece, by channel.
#[derive(Clone, Debug)]
pub enum Form {
    /// τ = 0.
    Vacuum,
    /// The same everywhere.
    Constant(Vec<Values>),
    /// Linear between the ends.
    Linear {
        /// At the front.
        front: Vec<Values>,
        /// At the back.
        back: Vec<Values>,
    },
    /// Analytic functions of λ, without branches.
    Smooth {
        /// Of `lambda`.
        formulas: Vec<Transfer<Expr>>,
        /// C and τ of the first channel, then of the second, and so on.
        program: Arc<KeptProgram>,
    },
}

impl Form {
    /// Whether light comes of it: C·τ is not 0 everywhere.
    #[must_use]
    pub fn emits(&self) -> bool {
        let shines = |values: &[Values]| values.iter().any(|of_one| of_one.emission != 0);
        match self {
            Form::Vacuum => false,
            Form::Constant(values) => shines(values),
            Form::Linear { front, back } => shines(front) || shines(back),
            Form::Smooth { formulas, .. } => formulas.iter().any(|of_one| !of_one.emission.is(0)),
        }
    }
}

/// The nearest binary64 number, for messages: `Rational::to_f64` cuts digits off.
pub(super) fn nearest(q: &Rational) -> f64 {
    Native::<f64>::new().ratio(q)
}
