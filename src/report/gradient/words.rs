//! The words of a report on gradients.

use super::Own;
use crate::kernel::GradientAt;
use crate::method::Expected;
use crate::study::gradient::{
    Conclusion, Derivative, Gradients, Line, Norm, OfCase, Standing, Trouble,
};

/// What is differentiated by.
pub(super) fn letter(derivative: Derivative) -> &'static str {
    match derivative {
        Derivative::Extinction => "τ",
        Derivative::Emission => "C",
    }
}

/// "by τ, largest".
pub(super) fn by(line: &Line) -> String {
    let of = letter(line.derivative);
    let norm = match line.norm {
        Norm::Largest => "largest",
        Norm::MeanSquare => "mean square",
    };
    format!("by {of}, {norm}")
}

/// "2"; "-" where theory says nothing.
pub(super) fn expected(line: &Line) -> String {
    match line.expected {
        Some(Expected::Order(order)) => format!("{order}"),
        _ => "-".into(),
    }
}

/// "2.001 ± 0.004"; "-" without a window. Half-widths are rounded up: no interval becomes a point.
pub(super) fn order(line: &Line) -> String {
    line.order().map_or("-".into(), |(order, half_width)| {
        format!("{order:.3} ± {:.3}", (half_width * 1000.0).ceil() / 1000.0)
    })
}

/// What of a line is to be seen first: what is wrong whatever the order is, else the verdict on that.
pub(super) fn verdict(case: &OfCase, line: &Line) -> String {
    let mut troubles = case.troubles.iter();
    let concerns = |trouble: &&Trouble| trouble.concerns(line.derivative);
    match troubles.find(concerns) {
        _ if line.standing == Standing::Failed => "failed".into(),
        Some(trouble) => short(*trouble).into(),
        None => line.fit.verdict.name().into(),
    }
}

/// In a table.
pub(super) fn short(trouble: Trouble) -> &'static str {
    match trouble {
        Trouble::NotFinite { .. } => "NaN",
        Trouble::Zero(_) => "exactly 0",
        Trouble::Unsteady => "unsteady",
        Trouble::Unused { .. } => "unused value",
    }
}

/// A sentence without a full stop.
pub(super) fn trouble(trouble: Trouble, gradients: &Gradients) -> String {
    match trouble {
        Trouble::NotFinite {
            derivative,
            segments,
        } => format!(
            "a derivative by {} is NaN or infinite where the radiance has a value, first at n = {segments}",
            letter(derivative)
        ),
        Trouble::Zero(derivative) => format!(
            "all derivatives by {} are exactly 0: nothing of them comes back",
            letter(derivative)
        ),
        Trouble::Unsteady => {
            "the same question has another gradient the second time: something is kept or added up"
                .into()
        }
        Trouble::Unused { segments } => format!(
            "a value that samples at the {} of segments do not use has a derivative, first at n = {segments}",
            gradients.places.sampling
        ),
    }
}

/// Which values its samples are, and where that is known from.
pub(super) fn places(gradients: &Gradients) -> String {
    let places = &gradients.places;
    let stands_for = match places.sampling {
        crate::kernel::Sampling::Jittered if places.at == GradientAt::Edges => {
            "half of both segments beside it"
        }
        crate::kernel::Sampling::Ends => "half of both segments beside it",
        crate::kernel::Sampling::Front => "the segment behind it",
        crate::kernel::Sampling::Back => "the segment in front of it",
        crate::kernel::Sampling::Middle | crate::kernel::Sampling::Jittered => "its segment",
    };
    let known = if places.is_declared {
        "as declared"
    } else {
        "nothing is declared; \"sampling\" says otherwise"
    };
    format!(
        "{}, sampling {} ({known}): each stands for the length of {stands_for}",
        places.at.name(),
        places.sampling
    )
}

/// What no error was measured at; `None` where that is nothing.
pub(super) fn left_out(case: &OfCase) -> Option<String> {
    let mut parts = Vec::new();
    if case.left_out.kinks > 0 {
        let flat = match case.left_out.flat {
            0 => String::new(),
            flat => {
                format!(" (a vacuum without a slope: {flat} of them are 0, as behind a rectifier)")
            }
        };
        parts.push(format!(
            "{} by τ where τ is within 1e-6 of 0{flat}",
            case.left_out.kinks
        ));
    }
    if case.left_out.wall > 0 {
        parts.push(format!("{} at the end of a far wall", case.left_out.wall));
    }
    if case.left_out.uneven > 0 {
        parts.push(format!(
            "{} between segments of two lengths, or at an end of the ray",
            case.left_out.uneven
        ));
    }
    let said = parts.join(", ");
    (!parts.is_empty()).then(|| format!("{}, of {} samples: {said}", case.name, case.samples))
}

/// The conclusion of both comparisons.
pub(super) fn whole(gradients: &Gradients, own: &Own) -> String {
    let theory = conclusion(gradients);
    match own {
        Ok(found) if !found.is_right() => {
            let names: Vec<&str> = found.deviations.iter().map(|one| one.name).collect();
            let names = if names.is_empty() {
                "in no known way".into()
            } else {
                names.join(", ")
            };
            format!("{theory}; it is not that of the kernel's own values: {names}")
        }
        Ok(_) => format!("{theory}; it is that of the kernel's own values"),
        Err(_) => theory,
    }
}

/// Everything in a sentence, without a full stop.
fn conclusion(gradients: &Gradients) -> String {
    let count = |standing| gradients.count(standing);
    let all = gradients.lines().count() + gradients.biases().count();
    let confirmed = count(Standing::Confirmed);
    let other: Vec<String> = [
        Standing::Contradicted,
        Standing::Inconclusive,
        Standing::Failed,
    ]
    .into_iter()
    .filter(|standing| count(*standing) > 0)
    .map(|standing| format!("{} {}", count(standing), standing.name()))
    .collect();
    let other = if other.is_empty() {
        String::new()
    } else {
        format!(" ({})", other.join(", "))
    };
    let name = &gradients.declaration.name;
    let is = match gradients.conclusion() {
        Conclusion::Confirmed => "the gradient is confirmed",
        Conclusion::NotConfirmed => "the gradient is not confirmed",
        Conclusion::CouldNotRun => "no level was answered",
    };
    let what = if gradients.declaration.stochastic {
        "means have no bias, or one that falls as expected"
    } else {
        "lines show the order expected"
    };
    format!("{name}: {is}: {confirmed} of {all} {what}{other}")
}

/// What the table means.
pub(super) fn meaning() -> String {
    "Theory: δI/δC(λ) = τ T, δI/δτ(λ) = T C − R(λ), R being what comes from behind λ. A derivative by the number of a sample \
     is divided by the length that the sample stands for. docs/verdicts.md says what verdicts mean."
        .into()
}
