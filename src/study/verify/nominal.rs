//! What the declared method itself gives at every level: exactly, and in the declared format.

use crate::case::SymbolicCase;
use crate::diagnosis::{Model, Ray, Recipe, radiance_by};
use crate::kernel::{Declaration, FormKind, Segments, radiance_in};
use crate::method::{Method, OpacityFormula};
use crate::real::{Format, FormatName, Real, WithFormat};
use rug::Float;

/// Bits of the run that counts as exact, beyond those of the format.
const MORE_BITS: u32 = 75;

/// 2^(−p) of the declared format.
pub(super) fn unit(declaration: &Declaration) -> f64 {
    (-f64::from(declaration.format.bits())).exp2()
}

/// The declared method's radiance at one level.
#[derive(Clone, Debug)]
pub(super) struct Nominal {
    /// With bits to spare, from the samples that the kernel was given.
    pub(super) exact: Float,
    /// In the declared format.
    pub(super) in_format: Float,
}

/// The declared method on one level of one channel; `None` where nothing is declared, or it has no value there.
pub(super) fn at_level(
    declaration: &Declaration,
    case: &SymbolicCase,
    segments: &Segments,
    channel: usize,
    uniform: Option<u64>,
) -> Option<Nominal> {
    let more = FormatName::Mpfr(declaration.format.bits() + MORE_BITS);
    match Model::of_method(declaration.method?) {
        Model::Recipe(recipe) => {
            let recipe = Recipe {
                wall: declaration.far_wall,
                ..recipe
            };
            // Linear opacities are those of the recipe; the others differ by their rounding.
            let formula = match declaration.method? {
                Method::Composited(compositing) => compositing.opacity,
                Method::Nested(_) | Method::Preintegrated(_) => OpacityFormula::Expm1,
            };
            let of = |format: FormatName| {
                format.with(OfRecipe {
                    recipe,
                    formula,
                    segments,
                    channel,
                })
            };
            // A kernel that evaluates the medium itself does that in its own format too.
            let by_itself = || {
                let n = uniform.filter(|_| evaluates(declaration.form))?;
                radiance_in(declaration.format, &declaration.method?, case, n).ok()
            };
            Some(Nominal {
                exact: of(more),
                in_format: by_itself().unwrap_or_else(|| of(declaration.format)),
            })
        }
        Model::Method(method) => {
            let of = |format: FormatName| radiance_in(format, &method, case, uniform?).ok();
            Some(Nominal {
                exact: of(more)?,
                in_format: of(declaration.format)?,
            })
        }
    }
}

/// Whether a kernel that is given such a form evaluates the medium itself.
fn evaluates(form: FormKind) -> bool {
    match form {
        FormKind::Function | FormKind::Formula(_) => true,
        FormKind::Segments | FormKind::Volume => false,
    }
}

struct OfRecipe<'a> {
    recipe: Recipe,
    formula: OpacityFormula,
    segments: &'a Segments,
    channel: usize,
}

impl WithFormat for OfRecipe<'_> {
    type Output = Float;

    fn run<F: Format>(self, format: F) -> Float {
        let ray: Ray<F::Real> = Ray::new(self.segments, self.channel, format);
        radiance_by(&self.recipe, &ray, format, self.formula).to_float()
    }
}
