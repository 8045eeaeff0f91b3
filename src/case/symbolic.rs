//! Cases made of expressions.

use super::{Case, Structure, Transfer, Unproved};
use crate::real::Real;
use crate::symbolic::{CompileError, Expr, Interval, KeptProgram, Place, Program};
use rug::Rational;
use std::sync::Arc;

/// The formulas of a case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formulas {
    /// s(λ), of `lambda`.
    pub field: Expr,
    /// τ(s), of `s`.
    pub extinction: Expr,
    /// C(s), of `s`.
    pub emission: Expr,
    /// t(λ), of `lambda`, where a closed form is known.
    pub optical_depth: Option<Expr>,
    /// I(λ), of `lambda`, where a closed form is known.
    pub radiance: Option<Expr>,
}

/// A case made of expressions, compiled; cheap to clone.
#[derive(Clone, Debug)]
pub struct SymbolicCase {
    inner: Arc<Inner>,
    /// Of the breaks of the structure, where they are known.
    breaks: Arc<[Option<Place>]>,
    unproved: Arc<[Unproved]>,
}

#[derive(Debug)]
struct Inner {
    name: String,
    length: Rational,
    formulas: Formulas,
    structure: Structure,
    field: KeptProgram,
    /// C and τ.
    transfer: KeptProgram,
    extinction: KeptProgram,
    optical_depth: Option<KeptProgram>,
    radiance: Option<KeptProgram>,
}

impl SymbolicCase {
    /// The case of that name on a ray of that length. Nothing is checked of the formulas but their symbols.
    ///
    /// # Errors
    /// [`CompileError`] where a formula has another symbol than its own.
    pub fn new(
        name: &str,
        length: Rational,
        formulas: Formulas,
        structure: Structure,
    ) -> Result<Self, CompileError> {
        let compile = |outputs: &[&Expr], input: &str| {
            let outputs: Vec<Expr> = outputs.iter().map(|&output| output.clone()).collect();
            Program::new(&outputs, &[input]).map(KeptProgram::new)
        };
        let closed_form = |formula: &Option<Expr>| match formula {
            Some(formula) => compile(&[formula], "lambda").map(Some),
            None => Ok(None),
        };
        let breaks = structure.breaks.iter().map(|b| {
            let part = b.part.as_ref()?;
            Some(Place::rational(Rational::from(part * &length)))
        });
        let breaks = breaks.collect();
        let inner = Arc::new(Inner {
            name: name.into(),
            length,
            field: compile(&[&formulas.field], "lambda")?,
            transfer: compile(&[&formulas.emission, &formulas.extinction], "s")?,
            extinction: compile(&[&formulas.extinction], "s")?,
            optical_depth: closed_form(&formulas.optical_depth)?,
            radiance: closed_form(&formulas.radiance)?,
            formulas,
            structure,
        });
        Ok(SymbolicCase {
            inner,
            breaks,
            unproved: Arc::default(),
        })
    }

    /// The case with the places of its structure's breaks, in their order, irrational ones too.
    #[must_use]
    pub(in crate::case) fn with_break_places(self, places: Vec<Option<Place>>) -> Self {
        SymbolicCase {
            breaks: places.into(),
            ..self
        }
    }

    /// The case with what was not proved of it.
    #[must_use]
    pub(in crate::case) fn with_unproved(self, unproved: Vec<Unproved>) -> Self {
        SymbolicCase {
            unproved: unproved.into(),
            ..self
        }
    }

    /// Every statement that the case rests on and that is not proved; empty, too, where nothing was checked.
    #[must_use]
    pub fn unproved(&self) -> &[Unproved] {
        &self.unproved
    }

    /// The medium alone: what it is without the closed forms.
    ///
    /// # Errors
    /// [`CompileError`], as of [`new`](SymbolicCase::new).
    pub fn without_closed_form(&self) -> Result<Self, CompileError> {
        let formulas = Formulas {
            optical_depth: None,
            radiance: None,
            ..self.inner.formulas.clone()
        };
        let (length, structure) = (self.inner.length.clone(), self.inner.structure.clone());
        Ok(SymbolicCase {
            breaks: Arc::clone(&self.breaks),
            unproved: Arc::clone(&self.unproved),
            ..SymbolicCase::new(&self.inner.name, length, formulas, structure)?
        })
    }

    /// Its formulas.
    #[must_use]
    pub fn formulas(&self) -> &Formulas {
        &self.inner.formulas
    }
}

/// A program of λ from formulas that are known to be good.
pub(super) fn program_of(outputs: &[&str]) -> Option<Program> {
    let outputs = outputs.iter().map(|text| text.parse().ok());
    let outputs: Option<Vec<Expr>> = outputs.collect();
    Program::new(&outputs?, &["lambda"]).ok()
}

/// The only output of a program; NaN cannot come of it, since every program here has one.
fn only<R: Real>(program: &KeptProgram, input: &R) -> R {
    let mut values = program.at(input);
    values.pop().unwrap_or_else(|| input.clone())
}

impl Case for SymbolicCase {
    fn name(&self) -> &str {
        &self.inner.name
    }

    fn length(&self) -> Rational {
        self.inner.length.clone()
    }

    fn field<R: Real>(&self, lambda: &R) -> R {
        only(&self.inner.field, lambda)
    }

    fn transfer<R: Real>(&self, s: &R) -> Transfer<R> {
        let mut values = self.inner.transfer.at(s).into_iter();
        let mut next = || values.next().unwrap_or_else(|| s.clone());
        Transfer {
            emission: next(),
            extinction: next(),
        }
    }

    const IN_ROWS: bool = true;

    fn fields<R: Real>(&self, lambda: &[R]) -> Vec<R> {
        let [fields] = self.inner.field.all(lambda);
        fields
    }

    fn transfers<R: Real>(&self, s: &[R]) -> Transfer<Vec<R>> {
        let [emission, extinction] = self.inner.transfer.all(s);
        Transfer {
            emission,
            extinction,
        }
    }

    fn extinction<R: Real>(&self, s: &R) -> R {
        only(&self.inner.extinction, s)
    }

    fn branches<R: Real>(&self, lambda: &R) -> Vec<bool> {
        let mut branches = self.inner.field.branches_at(lambda);
        branches.extend(self.transfer_branches(&self.field(lambda)));
        branches
    }

    fn transfer_branches<R: Real>(&self, s: &R) -> Vec<bool> {
        self.inner.transfer.branches_at(s)
    }

    fn optical_depth<R: Real>(&self, lambda: &R) -> Option<R> {
        Some(only(self.inner.optical_depth.as_ref()?, lambda))
    }

    fn radiance<R: Real>(&self, lambda: &R) -> Option<R> {
        Some(only(self.inner.radiance.as_ref()?, lambda))
    }

    fn structure(&self) -> Structure {
        self.inner.structure.clone()
    }

    fn integrand(&self) -> Option<Program> {
        let formulas = self.formulas();
        let along = |formula: &Expr| formula.substitute("s", &formulas.field);
        Program::new(
            &[along(&formulas.emission), along(&formulas.extinction)],
            &["lambda"],
        )
        .ok()
    }

    fn closed_forms(&self) -> [Option<Program>; 2] {
        let formulas = self.formulas();
        [&formulas.optical_depth, &formulas.radiance].map(|formula| {
            let formula = formula.as_ref()?;
            Program::new(std::slice::from_ref(formula), &["lambda"]).ok()
        })
    }

    fn break_places(&self, bits: u32) -> Vec<Option<Interval>> {
        let enclosed = |place: &Option<Place>| match place.as_ref()? {
            place if place.as_rational().is_some() => {
                Some(Interval::point(bits, place.as_rational()?))
            }
            place => place.exact.as_ref()?.enclose(bits, &|_| None).ok(),
        };
        self.breaks.iter().map(enclosed).collect()
    }
}
