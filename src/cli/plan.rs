//! `volver plan`: the least model of a scene that is enough.

use super::about::about;
use super::output::Output;
use super::scene::load;
use super::{Color, Failure, Outcome, waiting};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use std::str::FromStr;
use volver::real::{Format, FormatName, Native};
use volver::report::plan::{document, json, write};
use volver::scene::Scene;
use volver::study::plan::{Cost, Plan, Settings, TimeCost};
use volver::symbolic::parse_number;

const EXAMPLES: &str = "\
SCENE is a scene.toml: docs/scenes.md and 'volver schema scene' say what is in it.
For every stretch of the ray the least model is chosen whose error, bounded, leaves
the radiance of every channel within the tolerance: nothing, emission or absorption
alone, a closed form, or so many points; and the shortest format that rounds little
enough. Then the plan is run and compared with the radiance to many digits.

Work: at most 16384 panels of the ray, 4096 bits, and 3e10 products of numbers in
each precision that is tried; the file has at most 1 MiB, data that it names 16 MiB.

The exit code is 1 where the radiance is not within the tolerance.

Examples:
  volver plan examples/scenes/smoke.toml --tolerance 1e-4
  volver plan examples/scenes/smoke.toml --tolerance 1e-6 --explain
  volver plan examples/scenes/chest.toml --tolerance 1e-3 --format f16,f32 --json -
  volver plan examples/scenes/smoke.toml --tolerance 1e-20";

/// Find the least model of a scene that is enough for a tolerance
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct PlanScene {
    /// A scene.toml; - for standard input
    #[arg(value_name = "SCENE")]
    scene: String,
    /// How far the radiance of each channel may be from the exact one
    #[arg(long, value_name = "E", value_parser = tolerance)]
    tolerance: f64,
    /// Formats that may be used, by commas, repeatable [default: f32, f64, and as many
    /// bits of mpfr as it takes]
    #[arg(long = "format", value_name = "FORMATS")]
    formats: Vec<String>,
    /// What is to be little
    #[arg(long, value_enum, default_value = "evaluations", value_name = "WHAT")]
    cost: CostName,
    /// Show the arithmetic of every bound
    #[arg(long)]
    explain: bool,
    /// Do not run the plan
    #[arg(long)]
    no_check: bool,
    /// Write the plan as JSON, for 'volver render'; - is standard output, without the
    /// table
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Keep plan.json, plan.md and index.html in a directory
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print no table
    #[arg(long)]
    quiet: bool,
    /// Colour the verdict
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    color: Color,
}

/// What may be little.
#[derive(Clone, Copy, ValueEnum)]
enum CostName {
    Evaluations,
    Time,
}

fn tolerance(text: &str) -> Result<f64, String> {
    let value = parse_number(text)
        .ok()
        .map(|q| Native::<f64>::new().ratio(&q));
    let value = value.filter(|x| x.is_finite() && *x >= f64::MIN_POSITIVE);
    value.ok_or_else(|| "no tolerance (allowed: a number above 0, such as 1e-4)".into())
}

impl PlanScene {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let formats = self.formats()?;
        let output = self.output();
        output.check()?;
        let (plan, outcome) = waiting("planning", || self.plan(formats))?;
        output.hand_out(
            &document(&plan, self.explain, &about()),
            |directory| write(directory, &plan, &about()),
            |_| json(&plan),
        )?;
        Ok(outcome)
    }

    /// The plan, and whether it is as good as it says.
    fn plan(&self, formats: Vec<FormatName>) -> Result<(Plan, Outcome), Failure> {
        let scene = load(&self.scene)?;
        let settings = Settings {
            tolerance: self.tolerance,
            formats,
            cost: self.cost(&scene),
        };
        let wrong = |error: volver::study::plan::PlanError| Failure::Content {
            path: self.scene.clone(),
            error: error.into(),
        };
        let mut plan = Plan::new(&scene, &settings).map_err(wrong)?;
        let mut outcome = Outcome::Good;
        if !self.no_check {
            let checked = plan.check().map_err(wrong)?;
            let is_beyond = checked
                .channels
                .iter()
                .any(|c| c.error.is_nan() || c.error > self.tolerance);
            if is_beyond {
                outcome = Outcome::CheckFailed;
            }
        }
        Ok((plan, outcome))
    }

    fn formats(&self) -> Result<Vec<FormatName>, Failure> {
        let mut formats = Vec::new();
        for name in self
            .formats
            .iter()
            .flat_map(|text| super::study::format_names(text))
        {
            let format = FormatName::from_str(&name)
                .map_err(|error| Failure::Usage(format!("--format: {error}")))?;
            if matches!(format, FormatName::Fixed(_)) {
                return Err(Failure::Usage(format!(
                    "--format: '{format}' holds no optical depths (allowed: floating-point formats)"
                )));
            }
            if formats.contains(&format) {
                return Err(Failure::Usage(format!(
                    "--format: '{format}' a second time (allowed: each format once)"
                )));
            }
            formats.push(format);
        }
        if formats.is_empty() && !self.formats.is_empty() {
            return Err(Failure::Usage(
                "--format: no formats (allowed: one or more)".into(),
            ));
        }
        Ok(formats)
    }

    fn cost(&self, scene: &Scene) -> Cost {
        match self.cost {
            CostName::Evaluations => Cost::Evaluations,
            CostName::Time => Cost::Time(TimeCost::of(scene)),
        }
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
