//! `volver stress`: digits and verdicts at the extremes.

use super::about::about;
use super::output::Output;
use super::{Bar, Color, Failure, Outcome};
use clap::Args;
use clap::builder::RangedU64ValueParser;
use std::path::PathBuf;
use std::str::FromStr;
use volver::convergence::Ladder;
use volver::method::{Method, MethodNameError};
use volver::real::{FormatError, FormatName};
use volver::report::stress::{document, json, write};
use volver::study::stress::{
    Cell, FORMATS, GROUPS, LEVELS, METHODS, Scenario, Settings, run, scenarios, work,
};

/// Media that are not the same everywhere are run in MPFR too.
const MOST_SEGMENTS: u64 = 65_536;

const EXAMPLES: &str = "\
Each scenario is a medium whose radiance each method would give is known without
rounding. A cell has the digits that are correct of it, and those of the exact
radiance beside them, or a verdict on what befell the run. A bound known beforehand
promises digits; the exit code is 1 where a cell has fewer and no verdict.

SCENARIO is a group (depth, length, segments, vacuum, step, emission, fault, spike,
flat) or one of its scenarios (spike/hit). METHOD is trapezoid/trapezoid,
simpson/simpson, any compositing without stop (front-to-back/middle/expm1/depths),
preintegrated/linear/linear or the same by N trapezoids. FORMAT is any but mpfr.
LADDER is as for 'volver reproduce'.

Work: cells of more than 16777216 segments are left out, of slow formats and of
pre-integration those of more than 65536. A bar says how much is left.

Examples:
  volver stress --scenarios depth,fault --formats f16,f32,fixed:15
  volver stress --scenarios spike --methods tree/middle/expm1 --json -
  volver stress --scenarios segments --levels 1..65536x16 --formats f32,f64
  volver stress --scenarios flat/2^-30 --formats ieee:24,-126,127,f32 -n 64";

/// Run methods at the extremes of depth, length, segments and formats
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Stress {
    /// Only these, by commas, repeatable
    #[arg(long, value_name = "SCENARIO", value_delimiter = ',')]
    scenarios: Vec<String>,
    /// Instead of the eleven methods of the default, by commas, repeatable
    #[arg(long, value_name = "METHOD", value_delimiter = ',', value_parser = method)]
    methods: Vec<Method>,
    /// Instead of f16, bf16, f32, f64, tf32, fp8-e4m3, fixed:8 and fixed:15, by commas,
    /// repeatable
    #[arg(long, value_name = "FORMAT", value_parser = Formats::from_str)]
    formats: Vec<Formats>,
    /// Numbers of segments of the group 'segments' [default: 1,2,256,65536,1048576,16777216]
    #[arg(long, value_name = "LADDER", value_parser = Ladder::from_str)]
    levels: Option<Ladder>,
    /// Segments of all other scenarios [default: 256, or 16 where there are jumps]
    #[arg(short = 'n', long, value_name = "N", value_parser = RangedU64ValueParser::<u64>::new().range(1..=MOST_SEGMENTS))]
    segments: Option<u64>,
    /// Write all of it as one JSON document; - is standard output, without tables
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the report, as a page, Markdown and JSON with an SVG heat map, into a directory
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print no tables
    #[arg(long)]
    quiet: bool,
    /// Colour the figures
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    color: Color,
}

fn method(name: &str) -> Result<Method, MethodNameError> {
    name.parse()
}

/// Formats by commas; one name has commas of its own.
#[derive(Clone)]
struct Formats(Vec<FormatName>);

impl FromStr for Formats {
    type Err = FormatError;

    fn from_str(text: &str) -> Result<Self, FormatError> {
        let mut pieces = text.split(',');
        let mut formats = Vec::new();
        while let Some(piece) = pieces.next() {
            let own = if piece.starts_with("ieee:") { 2 } else { 0 };
            let name = pieces
                .by_ref()
                .take(own)
                .fold(piece.to_string(), |name, more| format!("{name},{more}"));
            formats.push(name.parse()?);
        }
        Ok(Formats(formats))
    }
}

impl Stress {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let settings = self.settings()?;
        let output = self.output();
        output.check()?;
        let bar = Bar::new(work(&settings));
        let cells = run(&settings, &bar);
        bar.finish();
        let cells = cells.map_err(|error| Failure::Usage(error.to_string()))?;
        output.hand_out(
            &document(&cells, &about()),
            |directory| write(directory, &cells, &about()),
            |_| json(&cells),
        )?;
        Ok(if cells.iter().any(Cell::is_silently_wrong) {
            Outcome::CheckFailed
        } else {
            Outcome::Good
        })
    }

    fn settings(&self) -> Result<Settings, Failure> {
        let levels = match &self.levels {
            None => LEVELS.to_vec(),
            Some(ladder) => ladder
                .as_segments()
                .ok_or_else(|| {
                    Failure::Usage(format!(
                        "--levels: '{ladder}' is a ladder of steps (allowed: numbers of segments)"
                    ))
                })?
                .to_vec(),
        };
        let formats: Vec<FormatName> = if self.formats.is_empty() {
            FORMATS
                .iter()
                .filter_map(|name| name.parse().ok())
                .collect()
        } else {
            self.formats
                .iter()
                .flat_map(|some| some.0.clone())
                .collect()
        };
        let methods = if self.methods.is_empty() {
            METHODS
                .iter()
                .filter_map(|name| name.parse().ok())
                .collect()
        } else {
            self.methods.clone()
        };
        Ok(Settings {
            scenarios: chosen(scenarios(self.segments, &levels), &self.scenarios)?,
            methods: once(methods),
            formats: once(formats),
        })
    }

    fn output(&self) -> Output<'_> {
        Output {
            out: self.out.as_deref(),
            files: vec![("--json", self.json.as_deref())],
            quiet: self.quiet,
            color: self.color,
        }
    }
}

/// The scenarios of these groups and names; all where none is named.
fn chosen(all: Vec<Scenario>, names: &[String]) -> Result<Vec<Scenario>, Failure> {
    let fits =
        |scenario: &Scenario, name: &String| scenario.group == name || scenario.name == *name;
    for name in names {
        if !all.iter().any(|scenario| fits(scenario, name)) {
            let groups = GROUPS.map(|(group, _)| group).join(", ");
            let of_group: Vec<&str> = all
                .iter()
                .filter(|s| name.split('/').next() == Some(s.group))
                .map(|s| s.name.as_str())
                .collect();
            return Err(Failure::Usage(format!(
                "--scenarios: unknown scenario '{name}' (allowed: {})",
                if of_group.is_empty() {
                    groups
                } else {
                    of_group.join(", ")
                }
            )));
        }
    }
    let wanted =
        |scenario: &Scenario| names.is_empty() || names.iter().any(|name| fits(scenario, name));
    Ok(all.into_iter().filter(wanted).collect())
}

/// Each once, in the order of appearance.
fn once<T: PartialEq>(all: Vec<T>) -> Vec<T> {
    let mut kept = Vec::new();
    for one in all {
        if !kept.contains(&one) {
            kept.push(one);
        }
    }
    kept
}
