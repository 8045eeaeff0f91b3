//! `preintegrated/COLOR/OPACITY[/unattenuated]`.

use super::MethodNameError;
use super::nested::rule_names;
use super::parts::{Parts, find, names, number};
use crate::method::{Color, Integration, Interpolant, LastSegment, Opacity, Preintegrated};

const INTERPOLANTS: [Interpolant; 4] = [
    Interpolant::Linear,
    Interpolant::Quadratic(LastSegment::Beyond),
    Interpolant::Quadratic(LastSegment::Backward),
    Interpolant::QuadraticMidpoint,
];
const UNATTENUATED: &str = "unattenuated";

pub(super) fn name(method: &Preintegrated) -> String {
    let Preintegrated { color, opacity } = method;
    let mut name = format!(
        "preintegrated/{}/{}",
        integral(color.interpolant, color.integration),
        integral(opacity.interpolant, opacity.integration),
    );
    if !color.attenuated {
        name.push('/');
        name.push_str(UNATTENUATED);
    }
    name
}

fn integral(interpolant: Interpolant, integration: Integration) -> String {
    match integration {
        Integration::Closed => interpolant.to_string(),
        Integration::SubIntervals { count, rule } => format!("{interpolant}-by-{count}-{rule}"),
    }
}

pub(super) fn parse(parts: &mut Parts<'_>) -> Result<Preintegrated, MethodNameError> {
    let color = parse_integral("color", parts)?;
    let opacity = parse_integral("opacity", parts)?;
    let attenuated = match parts.option() {
        None => true,
        Some(UNATTENUATED) => false,
        Some(part) => return Err(parts.unknown("option", part, UNATTENUATED.into())),
    };
    Ok(Preintegrated {
        color: Color {
            interpolant: color.0,
            attenuated,
            integration: color.1,
        },
        opacity: Opacity {
            interpolant: opacity.0,
            integration: opacity.1,
        },
    })
}

fn parse_integral(
    what: &'static str,
    parts: &mut Parts<'_>,
) -> Result<(Interpolant, Integration), MethodNameError> {
    let part = parts.next(what, integral_names)?;
    split(part).ok_or_else(|| parts.unknown(what, part, integral_names()))
}

fn split(text: &str) -> Option<(Interpolant, Integration)> {
    let Some((interpolant, sub_intervals)) = text.split_once("-by-") else {
        return Some((find(&INTERPOLANTS, text)?, Integration::Closed));
    };
    let (count, rule) = sub_intervals.split_once('-')?;
    let count = number(count).filter(|count| *count > 0)?;
    let rule = rule.parse().ok()?;
    let integration = Integration::SubIntervals { count, rule };
    Some((find(&INTERPOLANTS, interpolant)?, integration))
}

fn integral_names() -> String {
    format!(
        "INTERPOLANT or INTERPOLANT-by-COUNT-RULE with {}; 1 … {}; {}",
        names(&INTERPOLANTS),
        u32::MAX,
        rule_names(),
    )
}
