//! What the declared method itself gives at every level: exactly, and in the declared format.

mod marched;

use crate::case::SymbolicCase;
use crate::identify::rule::{Law, Place, Rule, Scheme, Shape, Wall};
use crate::identify::stated;
use crate::kernel::{Declaration, FormKind, Segments, radiance_in};
use crate::method::{Method, OpacityFormula};
use crate::real::{Format, FormatName, Native, Real, WithFormat};
use marched::marched;
use rug::Float;

/// Bits of the run that counts as exact, beyond those of the format.
const MORE_BITS: u32 = 75;

/// 2^(−p) of the declared format.
pub(super) fn unit(declaration: &Declaration) -> f64 {
    (-f64::from(declaration.format.bits())).exp2()
}

/// One channel of a ray, as a kernel was given it or has cut it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Given<'a> {
    pub(super) case: &'a SymbolicCase,
    pub(super) segments: &'a Segments,
    pub(super) step: f64,
    pub(super) channel: usize,
    /// n, where all segments are of the same length.
    pub(super) uniform: Option<u64>,
}

/// What the declared method gives at one level.
#[derive(Clone, Debug)]
pub(super) struct Nominal {
    /// With bits to spare, from the samples that the kernel was given.
    pub(super) exact: Float,
    /// In the declared format.
    pub(super) in_format: Float,
    /// Σ |Tⱼ αⱼ Cⱼ|, where opacities above 1 make terms alternate in sign.
    terms: Option<f64>,
    /// Of the samples that the kernel was given, and not of the case.
    is_of_samples: bool,
}

impl Nominal {
    /// With what is behind a ray whose samples are by so much darker.
    pub(super) fn before(self, background: f64) -> Nominal {
        Nominal {
            exact: self.exact + background,
            in_format: self.in_format + background,
            ..self
        }
    }

    /// Whether it comes of the samples that the kernel was given, and not of the case.
    pub(super) fn is_of_samples(&self) -> bool {
        self.is_of_samples
    }

    /// Whether an answer is the declared method's.
    ///
    /// Each of n segments rounds a few times; the bound N·2⁻²² of `docs/stress.md` is 4 n u. An opacity
    /// 1 − e^(−x) is wrong by up to u, whatever its size: n u max |C| in all. What else is declared is the `allowance`.
    pub(super) fn agrees(
        &self,
        value: f64,
        scale: f64,
        given: &Given<'_>,
        declaration: &Declaration,
        allowance: f64,
    ) -> bool {
        // Answers come in binary64.
        let unit = unit(declaration).max(f64::EPSILON / 2.0);
        let n = given.segments.count() as f64;
        let bright = largest_emission(given.segments, given.channel);
        let is_near = |model: f64| {
            let size = scale.max(model.abs()).max(self.terms.unwrap_or(0.0));
            let rounding = unit * ((32.0 + 4.0 * n) * size + 2.0 * n * bright);
            (value - model).abs() <= rounding + 1.0002 * allowance
        };
        // A place at a jump that the format rounds to its other side is another ray, there and in a kernel.
        is_near(self.exact.to_f64()) || (!self.is_of_samples && is_near(self.in_format.to_f64()))
    }
}

/// The largest |C| that was given.
fn largest_emission(segments: &Segments, channel: usize) -> f64 {
    let all = [&segments.edges, &segments.middles];
    let all = all.into_iter().filter_map(|of| of.emission.get(channel));
    all.flatten().map(|c| c.abs()).fold(0.0, f64::max)
}

/// The declared method on one level of one channel; `None` where nothing is declared, or it has no value there.
pub(super) fn at_level(declaration: &Declaration, given: &Given<'_>) -> Option<Nominal> {
    let method = declaration.method?;
    let more = FormatName::Mpfr(declaration.format.bits() + MORE_BITS);
    let Some(stated) = stated(&method) else {
        let of = |format| radiance_in(format, &method, given.case, given.uniform?).ok();
        return Some(Nominal {
            exact: of(more)?,
            in_format: of(declaration.format)?,
            terms: None,
            is_of_samples: false,
        });
    };
    let rule = Rule {
        wall: declaration.far_wall.then_some(Wall::Opaque),
        ..stated
    };
    // The opacities of a rule are right to the last bit; a method's are as its formula rounds them.
    let formula = match method {
        Method::Composited(compositing) => compositing.opacity,
        Method::Nested(_) | Method::Preintegrated(_) | Method::Layered(_) => OpacityFormula::Expm1,
    };
    let of = |format: FormatName| {
        format.with(OfRule {
            rule: &rule,
            formula,
            given,
        })
    };
    // A kernel that evaluates the medium itself does that in its own format too.
    let by_itself = || {
        let n = given.uniform.filter(|_| evaluates(declaration.form))?;
        radiance_in(declaration.format, &method, given.case, n).ok()
    };
    Some(Nominal {
        exact: of(more),
        in_format: by_itself().unwrap_or_else(|| of(declaration.format)),
        terms: alternates(&rule).then(|| terms(&rule, given.segments, given.step, given.channel)),
        is_of_samples: true,
    })
}

/// The optical depth that a method sums of one sample a segment.
pub(super) fn depth_at_level(
    declaration: &Declaration,
    given: &Given<'_>,
    place: Place,
) -> Nominal {
    let of = |format: FormatName| format.with(Summed { given, place });
    Nominal {
        exact: of(FormatName::Mpfr(declaration.format.bits() + MORE_BITS)),
        in_format: of(declaration.format),
        terms: None,
        is_of_samples: true,
    }
}

struct Summed<'a> {
    given: &'a Given<'a>,
    place: Place,
}

impl WithFormat for Summed<'_> {
    type Output = Float;

    fn run<F: Format>(self, format: F) -> Float {
        summed(self.given.segments, self.place, format).to_float()
    }
}

/// Σ τ d of one sample a segment.
pub(super) fn summed<F: Format>(segments: &Segments, place: Place, format: F) -> F::Real {
    let (samples, first) = match place {
        Place::Front => (&segments.edges, 0),
        Place::Middle => (&segments.middles, 0),
        Place::Back => (&segments.edges, 1),
    };
    let mut depth = format.int(0);
    let extinctions = samples.extinction.iter().skip(first);
    for (extinction, length) in extinctions.zip(segments.lengths()) {
        depth += &(format.binary64(*extinction) * &format.binary64(length));
    }
    depth
}

fn alternates(rule: &Rule) -> bool {
    let Scheme::Sample { law, .. } = &rule.scheme else {
        return false;
    };
    matches!(
        law,
        Law {
            shape: Shape::Linear,
            ..
        }
    )
}

/// Σ |Tⱼ wⱼ Cⱼ|: what a radiance is made of, where terms cancel.
pub(super) fn terms(rule: &Rule, segments: &Segments, step: f64, channel: usize) -> f64 {
    let composed = rule.composed(segments, step, Native::<f64>::new());
    composed.sizes(segments, channel)
}

/// Whether a kernel that is given such a form evaluates the medium itself.
fn evaluates(form: FormKind) -> bool {
    match form {
        FormKind::Function | FormKind::Formula(_) => true,
        FormKind::Segments | FormKind::Volume => false,
    }
}

struct OfRule<'a> {
    rule: &'a Rule,
    formula: OpacityFormula,
    given: &'a Given<'a>,
}

impl WithFormat for OfRule<'_> {
    type Output = Float;

    fn run<F: Format>(self, format: F) -> Float {
        let Given {
            segments,
            step,
            channel,
            ..
        } = *self.given;
        let radiance = marched(self.rule, self.formula, segments, channel, format);
        let radiance = radiance.unwrap_or_else(|| {
            let composed = self.rule.composed(segments, step, format);
            self.rule.radiance(&composed, segments, channel, format)
        });
        radiance.to_float()
    }
}
