//! A derived case piece by piece along its ray.

use super::Manufactured;
use crate::case::Case;
use crate::symbolic::{Expr, Piece, PiecesError, Place, pieces};
use rug::{Float, Rational};

impl Manufactured {
    /// The ray cut wherever a function goes from one branch to another. The expressions of each piece are
    /// s, C, τ and, where they have a closed form, t and I along λ, in this order, and hold up to both of
    /// its ends.
    ///
    /// # Errors
    /// [`PiecesError`] where branches cannot be told apart.
    pub fn pieces(&self) -> Result<Vec<Piece>, PiecesError> {
        self.cut(&self.along())
    }

    /// s, C, τ and, where they have a closed form, t and I, of `lambda`.
    #[must_use]
    pub fn along(&self) -> Vec<Expr> {
        let formulas = self.case.formulas();
        let media = [&formulas.field, &self.emission, &self.extinction];
        let closed_forms = formulas.optical_depth.iter().chain(&formulas.radiance);
        media.into_iter().chain(closed_forms).cloned().collect()
    }

    /// Where along λ each break of the case's [`Structure`](crate::case::Structure) is, in their order;
    /// `None` where that is not known.
    #[must_use]
    pub fn break_places(&self) -> Vec<Option<f64>> {
        let structure = self.case.structure();
        let length = self.case.length();
        let source = Expr::product([self.emission.clone(), self.extinction.clone()]);
        let cut = self.cut(&[self.extinction.clone(), source]);
        let pieces = cut.unwrap_or_default();
        let irrational: Vec<f64> = pieces
            .iter()
            .skip(1)
            .filter(|piece| piece.from.as_rational().is_none())
            .map(|piece| approximately(&piece.from))
            .collect();
        let open = structure.breaks.iter().filter(|b| b.part.is_none());
        // As many places as breaks: they are the same. Otherwise it is unknown which they are.
        let known = open.count() == irrational.len();
        let mut irrational = irrational.into_iter();
        let place = |part: &Option<Rational>| match part {
            Some(part) => Some(Rational::from(part * &length).to_f64()),
            None => irrational.next().filter(|_| known),
        };
        structure
            .breaks
            .iter()
            .map(|b| &b.part)
            .map(place)
            .collect()
    }

    fn cut(&self, exprs: &[Expr]) -> Result<Vec<Piece>, PiecesError> {
        pieces(exprs, "lambda", &Rational::new(), &self.case.length())
    }
}

fn approximately(place: &Place) -> f64 {
    let (low, high) = &place.bracket;
    match place
        .exact
        .as_ref()
        .map(|exact| exact.enclose(64, &|_| None))
    {
        Some(Ok(value)) => value.midpoint().to_f64(),
        _ => Float::with_val(64, Rational::from(low + high) / 2).to_f64(),
    }
}
