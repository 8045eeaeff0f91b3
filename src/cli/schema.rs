//! `volver schema`: what files and results look like, for editors and programs.

use super::{Failure, Outcome, write_out};
use clap::{Args, ValueEnum};
use volver::case::volume::VolumeFile;
use volver::kernel::process;
use volver::report;
use volver::scene::SceneFile;
use volver::study::plan::StoredPlan;
use volver::study::sweep::StudyFile;
use volver::volume::file::{CameraFile, TransferFile};

const EXAMPLES: &str = "\
A JSON Schema of draft 2020-12; editors that know TOML take it as well.

Work: none that grows with anything.

Examples:
  volver schema
  volver schema study
  volver schema protocol";

/// Print the JSON Schema of a file, a result or a protocol, or which there are
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Schema {
    /// Which [default: list all]
    #[arg(value_enum, value_name = "NAME")]
    name: Option<Name>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Name {
    Study,
    Scene,
    Volume,
    Transfer,
    Camera,
    Plan,
    Protocol,
    Verify,
    Identify,
    Fit,
    GradientTest,
    Reference,
    StudyResults,
}

const ALL: &str = "\
study     the file that 'volver study' takes
scene     a scene.toml, for 'volver plan' and 'volver render'
volume    a volume by formulas, for 'volver image'
transfer  the transfer functions that 'volver image' hands to renderers
camera    the camera that it hands to them
plan      what 'volver plan --json' writes and 'volver render --plan' reads
protocol  what a kernel in a process of its own and volver say to each other
verify, identify, fit, gradient-test, reference
          what these commands write with --json
study-results
          what 'volver study --json' writes
";

impl Schema {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let schema = match self.name {
            None => {
                write_out(ALL)?;
                return Ok(Outcome::Good);
            }
            Some(Name::Study) => StudyFile::schema(),
            Some(Name::Scene) => SceneFile::schema(),
            Some(Name::Volume) => VolumeFile::schema(),
            Some(Name::Transfer) => TransferFile::schema(),
            Some(Name::Camera) => CameraFile::schema(),
            Some(Name::Plan) => StoredPlan::schema(),
            Some(Name::Protocol) => process::schema(),
            Some(Name::Verify) => report::verify::schema(),
            Some(Name::Identify) => report::identify::schema(),
            Some(Name::Fit) => report::fit::schema(),
            Some(Name::GradientTest) => report::gradient_test::schema(),
            Some(Name::Reference) => report::reference::schema(),
            Some(Name::StudyResults) => report::study::schema(),
        };
        let text = serde_json::to_string_pretty(&schema);
        let text = text.map_err(|error| Failure::Output(error.into()))? + "\n";
        write_out(&text)?;
        Ok(Outcome::Good)
    }
}
