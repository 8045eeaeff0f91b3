//! `volver render`: a plan, run.

use super::about::about;
use super::input::read;
use super::scene::load;
use super::{Failure, Outcome, waiting, width, write_out};
use clap::Args;
use std::str::FromStr;
use volver::input::COMPUTED;
use volver::real::{Format, FormatName, WithFormat};
use volver::render::terminal;
use volver::report::plan::Rendering;
use volver::study::plan::{Plan, PlanError, StoredPlan};

const EXAMPLES: &str = "\
PLAN is what 'volver plan --json FILE' wrote for the same scene. Nothing is planned
anew: as many evaluations are made as it says, in its format or in another.

Work: the evaluations of the plan, whose file has at most 64 MiB.

Examples:
  volver render examples/scenes/smoke.toml --plan examples/scenes/plan.json
  volver render examples/scenes/smoke.toml --plan examples/scenes/plan.json --format f64";

/// Run a stored plan on its scene
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Render {
    /// A scene.toml; - for standard input
    #[arg(value_name = "SCENE")]
    scene: String,
    /// What 'volver plan --json' wrote; - for standard input
    #[arg(long, value_name = "PLAN")]
    plan: String,
    /// Instead of the plan's own format
    #[arg(long, value_name = "FORMAT", value_parser = FormatName::from_str)]
    format: Option<FormatName>,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

impl Render {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        if self.scene == "-" && self.plan == "-" {
            return Err(Failure::Usage(
                "SCENE and --plan both come from standard input (allowed: one of them)".into(),
            ));
        }
        let rendering = waiting("rendering", || self.rendering())?;
        let text = if self.json {
            rendering.json()?
        } else {
            terminal(&rendering.document(&about()), width(), false)
        };
        write_out(&text)?;
        Ok(Outcome::Good)
    }

    fn rendering(&self) -> Result<Rendering, Failure> {
        let scene = load(&self.scene)?;
        let text = read(&self.plan, COMPUTED)?;
        let wrong = |error: anyhow::Error| Failure::Content {
            path: self.plan.clone(),
            error,
        };
        let stored: StoredPlan = serde_json::from_str(&text).map_err(|error| {
            wrong(anyhow::anyhow!(
                "{error} (allowed: a plan as 'volver plan --json' writes it)"
            ))
        })?;
        let plan = Plan::from_stored(&scene, stored).map_err(|error| wrong(error.into()))?;
        let format = self.format.unwrap_or_else(|| plan.format());
        format
            .with(Running { plan: &plan })
            .map_err(|error| wrong(error.into()))
    }
}

struct Running<'a> {
    plan: &'a Plan,
}

impl WithFormat for Running<'_> {
    type Output = Result<Rendering, PlanError>;

    fn run<F: Format>(self, format: F) -> Self::Output {
        let rendered = self.plan.run_in(format)?;
        Ok(Rendering::new(self.plan, format, &rendered))
    }
}
