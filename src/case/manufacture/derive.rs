//! From what a file gives to all formulas of a case.

use super::{ManufactureError, polynomial};
use crate::case::file::{ChannelDescription, Description};
use crate::symbolic::{
    Branch, Condition, Expr, Piece, Relation, ZeroTest, expand, pieces, quotient, zero_test,
};

/// All formulas of a case, of λ but where said.
#[derive(Clone, Debug)]
pub(super) struct Derived {
    pub(super) field: Expr,
    pub(super) inverse: Option<Expr>,
    pub(super) extinction_of_field: Expr,
    pub(super) emission_of_field: Expr,
    pub(super) extinction: Expr,
    pub(super) emission: Expr,
    /// t, where it is given.
    pub(super) depth: Option<Expr>,
    /// I, where it is given or follows.
    pub(super) radiance: Option<Expr>,
    /// C as a polynomial of the depth `t`, where it was given so.
    pub(super) emission_of_depth: Option<Expr>,
}

pub(super) fn derive(
    description: &Description,
    channel: &ChannelDescription,
) -> Result<Derived, ManufactureError> {
    // All of a claim, or nothing of it: a medium alone.
    let is_whole = description.depth.is_some() == channel.radiance.is_some();
    if let (Some(extinction), Some(emission), true) =
        (&description.extinction, &channel.emission, is_whole)
    {
        let along = |function: &Expr| shortest(&function.substitute("s", &description.field));
        return Ok(Derived {
            extinction: along(extinction),
            emission: along(emission),
            extinction_of_field: extinction.clone(),
            emission_of_field: emission.clone(),
            field: description.field.clone(),
            inverse: description.inverse.clone(),
            depth: description.depth.clone(),
            radiance: channel.radiance.clone(),
            emission_of_depth: None,
        });
    }
    let depth = description
        .depth
        .clone()
        .ok_or(ManufactureError::Incomplete)?;
    let (extinction, emission, radiance) = match (&channel.emission_of_depth, &channel.radiance) {
        (Some(emission), claimed) => of_emission(description, &depth, emission, claimed.as_ref())?,
        (None, Some(radiance)) => of_radiance(description, &depth, radiance)?,
        (None, None) => return Err(ManufactureError::Incomplete),
    };
    let of_field = |along: &Expr| of_field(description, along);
    Ok(Derived {
        extinction_of_field: of_field(&extinction)?,
        emission_of_field: of_field(&emission)?,
        field: description.field.clone(),
        inverse: description.inverse.clone(),
        extinction,
        emission,
        depth: Some(depth),
        radiance: Some(radiance),
        emission_of_depth: channel.emission_of_depth.clone(),
    })
}

/// A function of λ as a function of s.
fn of_field(description: &Description, along: &Expr) -> Result<Expr, ManufactureError> {
    let inverse = match &description.inverse {
        Some(inverse) => inverse.clone(),
        None if description.field == Expr::symbol("lambda") => Expr::symbol("s"),
        None if !along.contains("lambda") => Expr::symbol("s"),
        None => {
            return Err(ManufactureError::NoInverse {
                field: description.field.clone(),
            });
        }
    };
    Ok(shortest(&along.substitute("lambda", &inverse)))
}

fn cut(description: &Description, exprs: &[Expr]) -> Result<Vec<Piece>, ManufactureError> {
    Ok(pieces(exprs, "lambda", &0.into(), &description.length)?)
}

/// τ, C and I from the depth and the emission as a function of it.
fn of_emission(
    description: &Description,
    depth: &Expr,
    emission: &Expr,
    claimed: Option<&Expr>,
) -> Result<(Expr, Expr, Expr), ManufactureError> {
    let pieces = cut(description, std::slice::from_ref(depth))?;
    let extinction = join(&pieces, |piece| {
        Ok(shortest(&only(piece).differentiate("lambda")))
    })?;
    let radiance = match (claimed, polynomial::sum_of_derivatives(emission)) {
        (Some(claimed), _) => claimed.clone(),
        (None, Some(sum)) => polynomial::radiance(&sum, depth),
        (None, None) => {
            return Err(ManufactureError::NotPolynomial {
                emission: emission.clone(),
            });
        }
    };
    let emission = join(&pieces, |piece| {
        Ok(shortest(&emission.substitute("t", &only(piece))))
    })?;
    Ok((extinction, emission, radiance))
}

/// τ and C from depth and radiance.
fn of_radiance(
    description: &Description,
    depth: &Expr,
    radiance: &Expr,
) -> Result<(Expr, Expr, Expr), ManufactureError> {
    let pieces = cut(description, &[depth.clone(), radiance.clone()])?;
    let extinction = join(&pieces, |piece| {
        Ok(shortest(&only(piece).differentiate("lambda")))
    })?;
    let emission = join(&pieces, |piece| {
        let [depth, radiance] = &piece.exprs[..] else {
            return Err(ManufactureError::Incomplete);
        };
        let extinction = depth.differentiate("lambda");
        if zero_test(&extinction, &[]) == ZeroTest::Proved {
            return Err(ManufactureError::NoExtinction {
                from: piece.from.exact.clone().unwrap_or_else(|| Expr::number(0)),
            });
        }
        let source = radiance.differentiate("lambda");
        let weight = extinction * (-depth).exp();
        let plain = (source.clone() / weight.clone()).simplify();
        Ok(match quotient(&source, &weight) {
            Some(cancelled) => shorter(cancelled, plain),
            None => plain,
        })
    })?;
    Ok((extinction, emission, radiance.clone()))
}

fn only(piece: &Piece) -> Expr {
    piece
        .exprs
        .first()
        .cloned()
        .unwrap_or_else(|| Expr::number(0))
}

/// One expression of what `of_piece` gives of each piece; where pieces meet, the later one holds.
fn join(
    pieces: &[Piece],
    of_piece: impl Fn(&Piece) -> Result<Expr, ManufactureError>,
) -> Result<Expr, ManufactureError> {
    let mut joined: Vec<(Expr, &Piece)> = Vec::new();
    for piece in pieces {
        let expr = of_piece(piece)?;
        match joined.last_mut() {
            Some((last, until)) if *last == expr => *until = piece,
            _ => joined.push((expr, piece)),
        }
    }
    let Some((otherwise, _)) = joined.pop() else {
        return Err(ManufactureError::Incomplete);
    };
    let branches: Result<Vec<Branch>, ManufactureError> =
        joined
            .into_iter()
            .map(|(value, piece)| {
                let right = piece.to.exact.clone().ok_or_else(|| {
                    crate::symbolic::PiecesError::Undecided {
                        difference: value.clone(),
                        symbol: "lambda".into(),
                        near: piece.to.bracket.0.clone(),
                    }
                })?;
                let left = Expr::symbol("lambda");
                let relation = Relation::Less;
                Ok(Branch {
                    condition: Condition {
                        left,
                        relation,
                        right,
                    },
                    value,
                })
            })
            .collect();
    Ok(Expr::piecewise(branches?, otherwise))
}

/// The expression as it is, simplified, or multiplied out, whichever is written the shortest.
pub(super) fn shortest(expr: &Expr) -> Expr {
    let simplified = shorter(expr.simplify(), expr.clone());
    match expand(expr) {
        Some(expanded) => shorter(simplified, expanded),
        None => simplified,
    }
}

fn shorter(a: Expr, b: Expr) -> Expr {
    if b.to_string().len() < a.to_string().len() {
        b
    } else {
        a
    }
}
