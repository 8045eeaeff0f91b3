//! `ORDER/POSITION/OPACITY`, with options front to back.

use super::MethodNameError;
use super::parts::{Parts, number};
use crate::method::{
    Accumulation, Compositing, CompositingOrder, OpacityFormula, Position, Summation, Threshold,
};

const POSITIONS: [Position; 3] = [Position::Front, Position::Middle, Position::Back];
const OPACITIES: [OpacityFormula; 4] = [
    OpacityFormula::Subtraction,
    OpacityFormula::Expm1,
    OpacityFormula::Relative,
    OpacityFormula::Linear,
];
const OPTIONS: &str =
    "transmittances, depths, remainder, naive, pairwise, neumaier, stop=NUMERATOR:DENOMINATOR";
const THRESHOLDS: &str = "stop=NUMERATOR:DENOMINATOR between 0 and 1, of integers below 2³²";

pub(super) fn parse(kind: &str, parts: &mut Parts<'_>) -> Result<Compositing, MethodNameError> {
    let position = parts.one_of("position", &POSITIONS)?;
    let opacity = parts.one_of("opacity", &OPACITIES)?;
    let order = match kind {
        "back-to-front" => CompositingOrder::BackToFront,
        "tree" => CompositingOrder::Tree,
        _ => front_to_back(parts)?,
    };
    Ok(Compositing {
        position,
        opacity,
        order,
    })
}

/// The options, in any order.
fn front_to_back(parts: &mut Parts<'_>) -> Result<CompositingOrder, MethodNameError> {
    let (mut depth, mut summation, mut stop) = (None, None, None);
    while let Some(part) = parts.option() {
        let repeated = match part {
            "transmittances" => depth.replace(Accumulation::Transmittances).is_some(),
            "depths" => depth.replace(Accumulation::Depths).is_some(),
            "remainder" => depth.replace(Accumulation::Remainder).is_some(),
            "naive" => summation.replace(Summation::Naive).is_some(),
            "pairwise" => summation.replace(Summation::Pairwise).is_some(),
            "neumaier" => summation.replace(Summation::Neumaier).is_some(),
            _ => {
                let Some(text) = part.strip_prefix("stop=") else {
                    return Err(parts.unknown("option", part, OPTIONS.into()));
                };
                let threshold = threshold(text)
                    .ok_or_else(|| parts.unknown("threshold", part, THRESHOLDS.into()))?;
                stop.replace(threshold).is_some()
            }
        };
        if repeated {
            return Err(parts.repeated(part));
        }
    }
    Ok(CompositingOrder::FrontToBack {
        depth: depth.unwrap_or(Accumulation::Transmittances),
        summation: summation.unwrap_or(Summation::Naive),
        stop,
    })
}

fn threshold(text: &str) -> Option<Threshold> {
    let (numerator, denominator) = text.split_once(':')?;
    Threshold::new(number(numerator)?, number(denominator)?)
}
