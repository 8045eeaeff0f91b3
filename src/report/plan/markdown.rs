//! A plan as Markdown.

use super::words::{because, bound, effort, left_out, medium, place, sum};
use crate::report::study::markdown::escape;
use crate::study::plan::Plan;
use std::fmt::Write;

/// All steps with the arithmetic of their bounds, and the radiance.
#[must_use]
// Writing to a String does not fail, so that results are dropped here.
pub fn markdown(plan: &Plan) -> String {
    let stored = plan.stored();
    let mut text = String::new();
    let _ = writeln!(text, "# Plan of {}\n", escape(plan.scene().name()));
    let _ = writeln!(
        text,
        "Tolerance {:e}: {}, in {}.\n",
        stored.tolerance,
        effort(stored),
        stored.format
    );
    let _ = writeln!(text, "Error ≤ {}.\n", sum(stored));
    let _ = writeln!(
        text,
        "| medium | from | to | model | left out | bound | T (ΔE + ΔT R) |"
    );
    let _ = writeln!(text, "|---|---|---|---|---|---|---|");
    for step in &stored.steps {
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} |",
            escape(&medium(plan, step)),
            place(&step.from),
            place(&step.to),
            step.model,
            left_out(step),
            bound(step.bound),
            because(step)
        );
    }
    if let Some(stop) = &stored.stop {
        let _ = writeln!(
            text,
            "\nThe ray may end at {}: nothing behind it matters.",
            place(stop)
        );
    }
    if let Some(checked) = &stored.checked {
        let _ = writeln!(
            text,
            "\n| channel | radiance | exactly | error |\n|---|---|---|---|"
        );
        for channel in &checked.channels {
            let _ = writeln!(
                text,
                "| {} | {} | {} | {:.1e} |",
                escape(&channel.channel),
                channel.radiance,
                channel.reference,
                channel.error
            );
        }
    }
    text
}
