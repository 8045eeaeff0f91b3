//! An array of Slurm's.

use super::{Array, this_program};
use crate::cli::Failure;
use std::io::ErrorKind;
use std::process::Command;
use volver::document::quoted;
use volver::render;

/// The script's name in the directory.
pub(in crate::cli) const SCRIPT: &str = "shards.sbatch";

impl Array<'_> {
    /// Writes the script and submits it, with the words that the user has for sbatch. What was submitted.
    pub(in crate::cli) fn slurm(&self, more: Option<&str>) -> Result<String, Failure> {
        let path = self.directory.join(SCRIPT);
        render::write_file(&path, self.script())?;
        let shown = path.display();
        let more = more.unwrap_or_default().split_whitespace();
        let ran = Command::new("sbatch")
            .arg("--parsable")
            .args(more)
            .arg(&path)
            .output();
        let output = ran.map_err(|error| {
            let why = match error.kind() {
                ErrorKind::NotFound => "it is not on the path".into(),
                _ => error.to_string(),
            };
            Failure::Usage(format!(
                "sbatch: {why} (allowed: a machine of the cluster, where 'sbatch {shown}' submits what is written there; or --on shell)"
            ))
        })?;
        if !output.status.success() {
            let said = String::from_utf8_lossy(&output.stderr);
            let line = said.lines().next().unwrap_or("no reason given");
            let line = line
                .trim_start_matches("sbatch: ")
                .trim_start_matches("error: ");
            return Err(Failure::Usage(format!(
                "sbatch: {} (allowed: what this cluster takes; {shown} is written, --sbatch-args adds words)",
                line.escape_debug()
            )));
        }
        let job = String::from_utf8_lossy(&output.stdout);
        let job = job.trim().split(';').next().unwrap_or_default();
        Ok(format!(
            "job {job}: shards {} of {}, by {shown}\nvolver merge {} joins them; with --watch it shows what is done\n",
            self.list(),
            self.shards,
            self.directory.display()
        ))
    }

    /// Only the number of a task comes from Slurm: of a rerun of two tasks it would say that there are two.
    fn script(&self) -> String {
        let command = self.command(&this_program(), "\"$SLURM_ARRAY_TASK_ID\"");
        // Slurm reads % in paths.
        let directory = self.directory.display().to_string().replace('%', "%%");
        let log = format!("{directory}/shards/%a.log");
        format!(
            "#!/bin/sh\n\
             #SBATCH --job-name=volver\n\
             #SBATCH --array={}\n\
             #SBATCH --cpus-per-task={}\n\
             #SBATCH --mem={}M\n\
             #SBATCH --output={}\n\
             exec {command}\n",
            self.list(),
            self.needs.threads,
            self.mebibytes(),
            quoted(&log),
        )
    }
}
