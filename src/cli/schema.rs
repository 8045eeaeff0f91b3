//! `volver schema`: what files look like, for editors and programs.

use super::{Failure, Outcome, write_out};
use clap::{Args, ValueEnum};
use volver::study::sweep::StudyFile;

const EXAMPLES: &str = "\
A JSON Schema of draft 2020-12; editors that know TOML take it as well.

Examples:
  volver schema
  volver schema study";

/// Print the JSON Schema of a file, or which there are
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
}

impl Schema {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let text = match self.name {
            None => "study  the file that 'volver study' takes\n".to_string(),
            Some(Name::Study) => {
                let text = serde_json::to_string_pretty(&StudyFile::schema());
                text.map_err(|error| Failure::Output(error.into()))? + "\n"
            }
        };
        write_out(&text)?;
        Ok(Outcome::Good)
    }
}
