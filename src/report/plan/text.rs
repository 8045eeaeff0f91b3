//! A plan for a terminal.

use super::words::{because, bound, effort, left_out, medium, place, sum};
use crate::report::text::{MIN_WIDTH, Style, paint, wrap};
use crate::study::plan::{Plan, Step};
use std::fmt::Write;

/// Steps of which no more than these are shown one by one.
const SHOWN: usize = 60;

/// The steps, what each leaves out and the bound of it, what the bounds add up to, and the radiance where the plan was
/// run; with `explain` also the arithmetic of every bound. Lines of at most `width` columns.
#[must_use]
pub fn text(plan: &Plan, explain: bool, width: usize, color: bool) -> String {
    let page = Page {
        width: width.max(MIN_WIDTH),
        color,
    };
    let stored = plan.stored();
    let mut text = String::new();
    let title = format!(
        "{}: tolerance {:e}, {}, in {}",
        plan.scene().name(),
        stored.tolerance,
        effort(stored),
        stored.format
    );
    page.put(&title, Style::Bold, &mut text);
    page.steps(plan, explain, &mut text);
    if let Some(stop) = &stored.stop {
        let line = format!(
            "the ray may end at {}: nothing behind it matters",
            place(stop)
        );
        page.put(&line, Style::Faint, &mut text);
    }
    for medium in plan.scene().media() {
        for note in &medium.unproved {
            let line = format!("medium {}: {note} could not be proved", medium.name);
            page.put(&line, Style::Open, &mut text);
        }
    }
    page.put(&format!("error <= {}", sum(stored)), Style::Bold, &mut text);
    page.checked(plan, &mut text);
    text
}

struct Page {
    width: usize,
    color: bool,
}

// Writing to a String does not fail, so that results are dropped here.
impl Page {
    fn put(&self, line: &str, style: Style, text: &mut String) {
        for line in wrap(line, self.width, "", "  ") {
            let _ = writeln!(text, "{}", paint(&line, style, self.color));
        }
    }

    fn steps(&self, plan: &Plan, explain: bool, text: &mut String) {
        let steps = &plan.stored().steps;
        let rows: Vec<[String; 4]> = steps
            .iter()
            .map(|step| {
                [
                    medium(plan, step),
                    format!("{} .. {}", place(&step.from), place(&step.to)),
                    step.model.to_string(),
                    bound(step.bound),
                ]
            })
            .collect();
        let head = ["medium", "from .. to", "model", "bound"];
        let widest = |column: usize| {
            let cells = rows
                .iter()
                .take(SHOWN)
                .map(|row| row[column].chars().count());
            cells.chain([head[column].len()]).max().unwrap_or(0)
        };
        let widths = [widest(0), widest(1), widest(2), widest(3)];
        let fits = widths.iter().sum::<usize>() + 6 <= self.width;
        if fits {
            let head = line(&head.map(String::from), &widths);
            let _ = writeln!(text, "{}", paint(&head, Style::Faint, self.color));
        }
        for (row, step) in rows.iter().zip(steps).take(SHOWN) {
            if fits {
                let _ = writeln!(text, "{}", line(row, &widths));
            } else {
                let [medium, places, model, bound] = row;
                let all = format!("{medium}, {places}: {model}, error <= {bound}");
                for line in wrap(&all, self.width, "", "    ") {
                    let _ = writeln!(text, "{line}");
                }
            }
            if explain {
                self.explain(step, text);
            }
        }
        if let Some(more) = steps.len().checked_sub(SHOWN).filter(|more| *more > 0) {
            let line = format!("... and {more} steps more: --json has them");
            self.put(&line, Style::Faint, text);
        }
    }

    fn explain(&self, step: &Step, text: &mut String) {
        let omitted = format!("left out: {}", left_out(step));
        let arithmetic = format!("T x (dE + dT x behind) = {}", because(step));
        for reason in [omitted, arithmetic] {
            for line in wrap(&reason, self.width, "    ", "      ") {
                let _ = writeln!(text, "{}", paint(&line, Style::Faint, self.color));
            }
        }
    }

    fn checked(&self, plan: &Plan, text: &mut String) {
        let stored = plan.stored();
        let Some(checked) = &stored.checked else {
            return;
        };
        for channel in &checked.channels {
            let name = if channel.channel.is_empty() {
                String::new()
            } else {
                format!("{}: ", channel.channel)
            };
            let is_within = channel.error <= stored.tolerance;
            let (verdict, style) = if is_within {
                ("within the tolerance", Style::Good)
            } else {
                ("BEYOND the tolerance", Style::Bad)
            };
            let line = format!(
                "{name}{verdict}, error {:.1e}: {}, exactly {}",
                channel.error,
                shortened(&channel.radiance, &channel.reference),
                channel.reference
            );
            self.put(&line, style, text);
        }
    }
}

/// A number of no more digits than another is told with, its exponent kept.
fn shortened(number: &str, like: &str) -> String {
    let (digits, exponent) = match number.split_once('e') {
        Some((digits, exponent)) => (digits, format!("e{exponent}")),
        None => (number, String::new()),
    };
    let most = like.chars().count() + 2;
    if digits.chars().count() <= most {
        return number.to_string();
    }
    let kept: String = digits.chars().take(most).collect();
    format!("{kept}...{exponent}")
}

fn line(cells: &[String; 4], widths: &[usize; 4]) -> String {
    let [medium, places, model, bound] = cells;
    format!(
        "{medium:<0$}  {places:<1$}  {model:<2$}  {bound:>3$}",
        widths[0], widths[1], widths[2], widths[3]
    )
}
