//! What of an answer is measured: the radiance of a channel, or a quantity that a ray has one of.
//!
//! Opacity and expected depth are radiances of the same ray with another emission: ∫ τ e^(−t) = 1 − e^(−t(D)) is that with
//! C = 1, and ∫ λ τ e^(−t) that with C = λ. So their samples, errors and methods are those of radiances. The optical
//! depth has no attenuation: its rules are those of ∫ τ.
//!
//! A background B adds e^(−t(D)) B, which is B − ∫ B τ e^(−t): the radiance is B and that of the ray with C − B.

use crate::case::manufacture::lit;
use crate::case::{Case, Fresh, SymbolicCase};
use crate::identify::rule::{self as identify, Place};
use crate::identify::stated;
use crate::kernel::{
    Declaration, DepthWeights, Quantity, Rendering, Samples, Segments, Subject, radiance_in,
};
use crate::method::{Compositing, Inner, Method, MethodError, OpacityFormula, Position};
use crate::quadrature::Rule;
use crate::real::{Format, FormatName, Real, WithFormat};
use crate::study::verify::VerifyError;
use crate::study::verify::of_order;
use crate::symbolic::Expr;
use rug::{Float, Rational};

/// One number of an answer.
#[derive(Clone, Debug)]
pub(in crate::study::verify) struct Wanted {
    /// Of the channel, or of the case and the quantity.
    pub(in crate::study::verify) name: String,
    pub(in crate::study::verify) quantity: Quantity,
    /// Of a radiance.
    pub(in crate::study::verify) channel: usize,
    /// What is behind the ray, of a radiance.
    pub(in crate::study::verify) background: f64,
    /// Of an expected depth.
    pub(in crate::study::verify) weights: DepthWeights,
    /// The ray as it is, by itself.
    pub(in crate::study::verify) ray: SymbolicCase,
    /// The ray lit so that its radiance is the quantity, before anything is divided or behind it. Of an optical depth
    /// C = e^t, so that C τ e^(−t) = τ, which theory is asked about.
    pub(in crate::study::verify) case: SymbolicCase,
    /// Where it is divided by the opacity: the ray lit evenly, whose radiance that is.
    even: Option<SymbolicCase>,
}

impl Wanted {
    /// A radiance.
    ///
    /// # Errors
    /// [`VerifyError::Formula`], which cases of formulas do not cause.
    pub(in crate::study::verify) fn radiance(
        subject: &Subject,
        channel: usize,
    ) -> Result<Wanted, VerifyError> {
        let ray = &subject.cases()[channel];
        let background = subject.background().get(channel).copied().unwrap_or(0.0);
        let case = match Rational::from_f64(background) {
            Some(behind) if behind != 0 => {
                let of = ray.formulas();
                let emission = of.emission.substitute("s", &of.field) - Expr::number(behind);
                lit(ray, ray.name(), &emission).map_err(|error| VerifyError::Formula {
                    case: ray.name().into(),
                    error,
                })?
            }
            _ => ray.clone(),
        };
        Ok(Wanted {
            name: ray.name().into(),
            quantity: Quantity::Radiance,
            channel,
            background,
            weights: DepthWeights::Plain,
            ray: ray.clone(),
            case,
            even: None,
        })
    }

    /// Another quantity of a ray.
    ///
    /// # Errors
    /// [`VerifyError::Formula`], which cases of formulas do not cause.
    pub(in crate::study::verify) fn other(
        subject: &Subject,
        quantity: Quantity,
        weights: DepthWeights,
    ) -> Result<Wanted, VerifyError> {
        let name = format!("{}:{}", subject.name(), quantity.name());
        let ray = &subject.cases()[0];
        let failed = |error| VerifyError::Formula {
            case: name.clone(),
            error,
        };
        let one = Expr::number(1);
        let emission = match (quantity, &ray.formulas().optical_depth) {
            (Quantity::ExpectedDepth, _) => Expr::symbol("lambda"),
            (Quantity::OpticalDepth | Quantity::Emission, Some(depth)) => depth.exp(),
            _ => one.clone(),
        };
        let is_divided = is_divided(quantity, weights);
        let even = is_divided.then(|| lit(ray, &name, &one)).transpose();
        Ok(Wanted {
            case: lit(ray, &name, &emission).map_err(failed)?,
            even: even.map_err(failed)?,
            quantity,
            channel: 0,
            background: 0.0,
            ray: ray.clone(),
            weights,
            name,
        })
    }

    /// Whether it is Σ w λ / Σ w.
    pub(in crate::study::verify) fn is_divided(&self) -> bool {
        is_divided(self.quantity, self.weights)
    }

    /// What was answered.
    pub(in crate::study::verify) fn of<'r>(&self, rendering: &'r Rendering) -> Option<&'r Float> {
        rendering.of(self.quantity, self.channel)
    }

    /// The samples of a ray lit as this is; the channel is then the first.
    pub(in crate::study::verify) fn lit(&self, segments: Segments) -> Segments {
        if self.quantity == Quantity::Radiance && self.background == 0.0 {
            return segments;
        }
        let lit = |mut samples: Samples| {
            match self.quantity {
                Quantity::Radiance => {
                    let emission = samples.emission.iter_mut().flatten();
                    emission.for_each(|c| *c -= self.background);
                }
                Quantity::ExpectedDepth => samples.emission = vec![samples.lambda.clone()],
                Quantity::Opacity | Quantity::OpticalDepth | Quantity::Emission => {
                    samples.emission = vec![vec![1.0; samples.lambda.len()]];
                }
            }
            samples
        };
        Segments {
            edges: lit(segments.edges),
            middles: lit(segments.middles),
        }
    }

    /// Methods of that order that are rules, each run on these segments, of which no two levels have the same number.
    pub(in crate::study::verify) fn methods_between<'s>(
        &self,
        order: f64,
        levels: &'s [&'s Segments],
    ) -> Vec<Run<'s>> {
        let is_depth = matches!(self.quantity, Quantity::OpticalDepth | Quantity::Emission);
        if is_depth || self.is_divided() {
            return Vec::new();
        }
        let run = |method: Method| {
            let rule = Box::new(stated(&method)?);
            Some(Run::Between {
                rule,
                levels,
                channel: self.channel,
                behind: self.background,
            })
        };
        of_order::methods(order)
            .into_iter()
            .filter_map(run)
            .collect()
    }

    /// Methods of that order, each run on a number of segments in a format.
    pub(in crate::study::verify) fn methods(&self, order: f64) -> Vec<Run<'_>> {
        let is_of_order = |rule: &Rule| (f64::from(rule.order()) - order).abs() < f64::EPSILON;
        if matches!(self.quantity, Quantity::OpticalDepth | Quantity::Emission) {
            let rules = DEPTHS.into_iter().filter(is_of_order);
            return rules
                .map(|rule| Run::Depth(&self.case, Inner::PerSegment(rule)))
                .collect();
        }
        let methods = of_order::methods(order).into_iter();
        let run = |method| match &self.even {
            Some(even) => Run::Divided(&self.case, even, method),
            None => Run::Radiance(&self.case, method, self.background),
        };
        methods.map(run).collect()
    }
}

fn is_divided(quantity: Quantity, weights: DepthWeights) -> bool {
    quantity == Quantity::ExpectedDepth && weights == DepthWeights::ByOpacity
}

/// Rules for an optical depth.
const DEPTHS: [Rule; 8] = [
    Rule::RiemannLeft,
    Rule::RiemannRight,
    Rule::Trapezoid,
    Rule::Midpoint,
    Rule::Simpson,
    Rule::GaussLegendre(2),
    Rule::Boole,
    Rule::GaussLegendre(3),
];

/// A method on the ray of a quantity.
#[derive(Clone, Debug)]
pub(in crate::study::verify) enum Run<'a> {
    /// Its radiance, and what is behind it.
    Radiance(&'a SymbolicCase, Method, f64),
    /// That of the first ray, divided by that of the second.
    Divided(&'a SymbolicCase, &'a SymbolicCase, Method),
    /// The optical depth by a rule.
    Depth(&'a SymbolicCase, Inner),
    /// The radiance of a rule on one of these levels, and what is behind it.
    Between {
        rule: Box<identify::Rule>,
        levels: &'a [&'a Segments],
        channel: usize,
        behind: f64,
    },
}

impl Run<'_> {
    /// On n segments, in that format.
    ///
    /// # Errors
    /// [`MethodError`] where n does not suit the method.
    pub(in crate::study::verify) fn on(
        &self,
        format: FormatName,
        n: u64,
    ) -> Result<Float, MethodError> {
        match self {
            Run::Radiance(case, method, behind) => {
                Ok(radiance_in(format, method, *case, n)? + *behind)
            }
            Run::Divided(case, even, method) => {
                let weighted = radiance_in(format, method, *case, n)?;
                Ok(weighted / radiance_in(format, method, *even, n)?)
            }
            Run::Between {
                rule,
                levels,
                channel,
                behind,
            } => {
                let level = levels.iter().find(|level| level.count() as u64 == n);
                let radiance = |segments: &Segments| {
                    format.with(Ruled {
                        rule,
                        segments,
                        channel: *channel,
                    })
                };
                let radiance = level.map(|level| radiance(level));
                let nothing = || Float::with_val(f64::MANTISSA_DIGITS, f64::NAN);
                Ok(radiance.unwrap_or_else(nothing) + *behind)
            }
            Run::Depth(case, inner) => format.with(DepthIn {
                case,
                inner: *inner,
                n,
            }),
        }
    }
}

/// A rule on segments; no rule of a method looks at the step.
struct Ruled<'a> {
    rule: &'a identify::Rule,
    segments: &'a Segments,
    channel: usize,
}

impl WithFormat for Ruled<'_> {
    type Output = Float;

    fn run<F: Format>(self, format: F) -> Float {
        let composed = self.rule.composed(self.segments, f64::NAN, format);
        let radiance = self
            .rule
            .radiance(&composed, self.segments, self.channel, format);
        radiance.to_float()
    }
}

struct DepthIn<'a> {
    case: &'a SymbolicCase,
    inner: Inner,
    n: u64,
}

impl WithFormat for DepthIn<'_> {
    type Output = Result<Float, MethodError>;

    fn run<F: Format>(self, format: F) -> Self::Output {
        let depth = self.inner.depth(&Fresh::new(self.case, format), self.n)?;
        let whole = depth.boundaries.last();
        Ok(whole.map_or_else(|| format.int(0).to_float(), Real::to_float))
    }
}

/// The rule by which compositing sums its optical depth, where opacities are those of depths and no ray ends early.
pub(in crate::study::verify) fn depth_rule(compositing: &Compositing) -> Option<(Place, Rule)> {
    let is_plain =
        compositing.opacity != OpacityFormula::Linear && compositing.threshold().is_none();
    let rule = match compositing.position {
        Position::Front => (Place::Front, Rule::RiemannLeft),
        Position::Middle => (Place::Middle, Rule::Midpoint),
        Position::Back => (Place::Back, Rule::RiemannRight),
    };
    is_plain.then_some(rule)
}

/// Everything that is wanted of the answers to a case: what is declared, and an opacity that comes without a word.
///
/// # Errors
/// As [`Wanted::other`].
pub(in crate::study::verify) fn wanted<'r>(
    subject: &Subject,
    declaration: &Declaration,
    mut answers: impl Iterator<Item = &'r Rendering>,
) -> Result<Vec<Wanted>, VerifyError> {
    let mut all = Vec::new();
    if declaration.has(Quantity::Radiance) {
        let channels = 0..subject.channels().len();
        for channel in channels {
            all.push(Wanted::radiance(subject, channel)?);
        }
    }
    let came = answers.any(|rendering| rendering.opacity.is_some());
    for quantity in Quantity::MEASURED {
        let is_wanted = match quantity {
            Quantity::Radiance => false,
            Quantity::Opacity => came || declaration.has(quantity),
            Quantity::OpticalDepth | Quantity::ExpectedDepth | Quantity::Emission => {
                declaration.has(quantity)
            }
        };
        if is_wanted {
            all.push(Wanted::other(
                subject,
                quantity,
                declaration.expected_depth,
            )?);
        }
    }
    Ok(all)
}
