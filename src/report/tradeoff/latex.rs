//! The tables for a paper.

use super::words::{usual, way};
use crate::report::study::latex::escape;
use crate::study::tradeoff::Results;
use std::fmt::Write;

/// A `tabular` for the package booktabs: for every case the cheapest way to each error, with what is usual beside
/// it. Names are escaped.
#[must_use]
pub fn latex(results: &Results) -> String {
    let mut text = format!(
        "% The cheapest way to an error, by {}; made by volver, needs \\usepackage{{booktabs}}.\n\
         \\begin{{tabular}}{{lrllrrrl}}\n\\toprule\n\
         case & error & method & format & $n$ & evaluations & time & usual \\\\\n",
        results.cost
    );
    // Writing to a String does not fail.
    for case in &results.cases {
        let mut name = escape(&case.name);
        text.push_str("\\midrule\n");
        for goal in case.goals(results.cost) {
            let Some(best) = goal.best else { break };
            let [method, format, n, evaluations, _, time] = way(best, results.cost);
            let cells = [
                method,
                format,
                n,
                evaluations,
                time,
                usual(&goal, results.cost),
            ];
            let cells = cells.map(|cell| escape(&cell.replace('µ', "u")));
            let name = std::mem::take(&mut name);
            let digits = goal.digits;
            let _ = writeln!(
                text,
                "{name} & $10^{{-{digits}}}$ & {} \\\\",
                cells.join(" & ")
            );
        }
    }
    text.push_str("\\bottomrule\n\\end{tabular}\n");
    text
}
