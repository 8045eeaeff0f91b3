//! Every level as a Parquet file, for databases and data frames.

use super::words::theory;
use crate::convergence::Fit;
use crate::render::ReportError;
use crate::study::shards::Key;
use crate::study::sweep::{Block, LevelRecord, Line, Part, Results, State};
use parquet::basic::{Compression, ZstdLevel};
use parquet::data_type::{
    BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int32Type, Int64Type,
};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::parser::parse_message_type;
use rug::Float;
use std::collections::HashMap;
use std::sync::Arc;

/// Rows of a group, which is written in one piece.
const ROWS: usize = 1 << 16;

/// A case, method, format and n.
struct Row<'a> {
    key: Key,
    line: &'a Line,
    level: &'a LevelRecord,
}

/// What a column takes of a row.
enum Of {
    Text(fn(&Row<'_>) -> String),
    Short(fn(&Row<'_>) -> i32),
    Long(fn(&Row<'_>) -> i64),
    Flag(fn(&Row<'_>) -> bool),
    Real(fn(&Row<'_>) -> Option<f64>),
}

/// Engines differ in what they do with NaN, so that there is none: a value that is not there, or no number of binary64, is null,
/// and the flags say why.
const COLUMNS: [(&str, Of); 24] = [
    ("key", Of::Long(|row| row.key.number().cast_signed())),
    ("case", Of::Text(|row| row.line.case.clone())),
    ("method", Of::Text(|row| row.line.row.method.clone())),
    ("format", Of::Text(|row| row.line.format.clone())),
    ("bits", Of::Short(|row| row.line.bits.cast_signed())),
    ("swept", Of::Flag(|row| row.line.swept)),
    ("n", Of::Long(|row| row.level.n.cast_signed())),
    ("state", Of::Text(|row| row.level.state.name().into())),
    ("failed", Of::Flag(|row| has_failed(&row.level.state))),
    (
        "infinite",
        Of::Flag(|row| row.level.state == State::NotFinite),
    ),
    (
        "beyond_binary64",
        Of::Flag(|row| parts(row.level).any(is_beyond)),
    ),
    ("radiance", Of::Real(|row| real(Some(&row.line.radiance)))),
    ("total", Of::Real(|row| real(row.level.total.as_ref()))),
    ("floor", Of::Real(|row| real(row.level.floor.as_ref()))),
    (
        "discretization",
        Of::Real(|row| real(row.level.discretization.as_ref())),
    ),
    (
        "truncation",
        Of::Real(|row| real(row.level.truncation.as_ref())),
    ),
    (
        "input_rounding",
        Of::Real(|row| real(row.level.input.as_ref())),
    ),
    (
        "arithmetic_rounding",
        Of::Real(|row| real(row.level.arithmetic.as_ref())),
    ),
    (
        "resolution",
        Of::Real(|row| real(row.level.resolution.as_ref())),
    ),
    // What the levels of a line say together, on each of them.
    ("theory", Of::Text(|row| theory(row.line.row.expected))),
    ("order", Of::Real(|row| finite(fit(row).order))),
    (
        "order_half_width",
        Of::Real(|row| finite(fit(row).half_width)),
    ),
    ("verdict", Of::Text(|row| fit(row).verdict.name().into())),
    (
        "against_theory",
        Of::Flag(|row| row.line.contradicts_theory()),
    ),
];

fn finite(x: Option<f64>) -> Option<f64> {
    x.filter(|x| x.is_finite())
}

/// The order that verdicts are on.
fn fit<'a>(row: &Row<'a>) -> &'a Fit {
    row.line.summary.order()
}

/// Whether the method has no answer there, or one whose error is not known.
fn has_failed(state: &State) -> bool {
    match state {
        State::Split | State::Total | State::NotFinite => false,
        State::BranchDiverged | State::Unsettled | State::Refused(_) => true,
    }
}

fn parts(level: &LevelRecord) -> impl Iterator<Item = &Float> {
    let floor = level.floor.as_ref().into_iter();
    let resolution = level.resolution.as_ref().into_iter();
    let of = |part| level.part(part).into_iter();
    let parts = [
        Part::Total,
        Part::Discretization,
        Part::Truncation,
        Part::Input,
        Part::Arithmetic,
    ];
    parts
        .into_iter()
        .flat_map(of)
        .chain(floor)
        .chain(resolution)
}

/// Whether a number is too small or too large for binary64.
fn is_beyond(x: &Float) -> bool {
    x.is_finite() && real(Some(x)).is_none()
}

/// As binary64; `None` where it is none of its normal numbers.
fn real(x: Option<&Float>) -> Option<f64> {
    let x = x?;
    let rounded = x.to_f64();
    (rounded.is_normal() || x.is_zero()).then_some(rounded)
}

/// A row a case, method, format and n: compressed by zstd, in groups of 65,536 rows, without times.
///
/// # Errors
/// [`ReportError::Parquet`] where a file cannot be made.
pub fn parquet(results: &Results) -> Result<Vec<u8>, ReportError> {
    made(results).map_err(|error| ReportError::Parquet(error.to_string()))
}

fn made(results: &Results) -> Result<Vec<u8>, ParquetError> {
    let fields: Vec<String> = COLUMNS.iter().map(field).collect();
    let schema = format!("message study {{ {} }}", fields.join(" "));
    let schema = Arc::new(parse_message_type(&schema)?);
    let properties = WriterProperties::builder()
        .set_compression(Compression::ZSTD(ZstdLevel::default()))
        .set_created_by(format!("volver {}", results.header.volver))
        .build();
    let mut writer = SerializedFileWriter::new(Vec::new(), schema, Arc::new(properties))?;
    let whole = Block::whole(&results.header);
    let keys = whole.iter().map(|unit| results.header.key(unit));
    let keys: HashMap<(&str, &str), Key> = results.header.units().zip(keys).collect();
    let rows = results.lines.iter().flat_map(|line| {
        let key = keys
            .get(&(line.case.as_str(), line.format.as_str()))
            .copied();
        let levels = line.row.levels.iter();
        levels.filter_map(move |level| key.map(|key| Row { key, line, level }))
    });
    let mut rows = rows.peekable();
    while rows.peek().is_some() {
        let group: Vec<Row<'_>> = rows.by_ref().take(ROWS).collect();
        let mut of_group = writer.next_row_group()?;
        for (_, of) in &COLUMNS {
            if let Some(mut column) = of_group.next_column()? {
                of.write(&group, &mut column)?;
                column.close()?;
            }
        }
        of_group.close()?;
    }
    writer.into_inner()
}

/// A column in the language of schemas.
fn field((name, of): &(&str, Of)) -> String {
    let kind = match of {
        Of::Text(_) => return format!("REQUIRED BYTE_ARRAY {name} (UTF8);"),
        Of::Short(_) => "REQUIRED INT32",
        Of::Long(_) => "REQUIRED INT64",
        Of::Flag(_) => "REQUIRED BOOLEAN",
        Of::Real(_) => "OPTIONAL DOUBLE",
    };
    format!("{kind} {name};")
}

impl Of {
    fn write(
        &self,
        rows: &[Row<'_>],
        column: &mut SerializedColumnWriter<'_>,
    ) -> Result<(), ParquetError> {
        match self {
            Of::Text(of) => {
                let texts = rows.iter().map(|row| ByteArray::from(of(row).as_str()));
                all::<ByteArrayType>(column, texts)
            }
            Of::Short(of) => all::<Int32Type>(column, rows.iter().map(of)),
            Of::Long(of) => all::<Int64Type>(column, rows.iter().map(of)),
            Of::Flag(of) => all::<BoolType>(column, rows.iter().map(of)),
            Of::Real(of) => {
                let values: Vec<Option<f64>> = rows.iter().map(of).collect();
                let there: Vec<i16> = values.iter().map(|x| i16::from(x.is_some())).collect();
                let values: Vec<f64> = values.into_iter().flatten().collect();
                let column = column.typed::<DoubleType>();
                column.write_batch(&values, Some(&there), None)?;
                Ok(())
            }
        }
    }
}

fn all<T: DataType>(
    column: &mut SerializedColumnWriter<'_>,
    values: impl Iterator<Item = T::T>,
) -> Result<(), ParquetError> {
    let values: Vec<T::T> = values.collect();
    column.typed::<T>().write_batch(&values, None, None)?;
    Ok(())
}
