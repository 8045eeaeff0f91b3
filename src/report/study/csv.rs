//! Every level, for tables and plots elsewhere.

use crate::report::ReportError;
use crate::study::sweep::{LevelRecord, Line, Results, State};
use rug::Float;
use std::io;

const HEAD: [&str; 15] = [
    "case",
    "method",
    "format",
    "bits",
    "n",
    "state",
    "total",
    "discretization",
    "truncation",
    "input_rounding",
    "arithmetic_rounding",
    "of_transmittances",
    "resolution",
    "oracle_bits",
    "reason",
];

/// One line a case, method, format and n behind a line of names, as RFC 4180 has it but with line feeds. A
/// part that is not known is empty; numbers have twenty digits.
///
/// # Errors
/// [`ReportError::Csv`], which no study is known to cause.
pub fn csv(results: &Results) -> Result<String, ReportError> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let broken = |error: csv::Error| ReportError::Csv(error.into());
    writer.write_record(HEAD).map_err(broken)?;
    for line in &results.lines {
        for level in &line.row.levels {
            writer.write_record(record(line, level)).map_err(broken)?;
        }
    }
    let bytes = writer
        .into_inner()
        .map_err(|error| ReportError::Csv(error.into_error()))?;
    String::from_utf8(bytes).map_err(|error| ReportError::Csv(io::Error::other(error)))
}

fn record(line: &Line, level: &LevelRecord) -> [String; HEAD.len()] {
    let number = |x: &Option<Float>| {
        x.as_ref()
            .map_or(String::new(), |x| x.to_string_radix(10, Some(20)))
    };
    let reason = match &level.state {
        State::Refused(reason) => reason.clone(),
        _ => String::new(),
    };
    [
        line.case.clone(),
        line.row.method.clone(),
        line.format.clone(),
        line.bits.to_string(),
        level.n.to_string(),
        level.state.name().into(),
        number(&level.total),
        number(&level.discretization),
        number(&level.truncation),
        number(&level.input),
        number(&level.arithmetic),
        number(&level.of_depth),
        number(&level.resolution),
        level
            .oracle_bits
            .map_or(String::new(), |bits| bits.to_string()),
        reason,
    ]
}
