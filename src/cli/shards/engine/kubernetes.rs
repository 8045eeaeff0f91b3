//! An indexed job of Kubernetes.

use super::Array;
use crate::cli::Failure;
use volver::render;
use volver::study::shards::Key;

/// The manifest's name in the directory.
const MANIFEST: &str = "job.yaml";

impl Array<'_> {
    /// Writes the manifest. What to do with it.
    pub(in crate::cli) fn kubernetes(&self, image: &str, claim: &str) -> Result<String, Failure> {
        let path = self.directory.join(MANIFEST);
        let here = std::env::current_dir().map_err(|error| {
            Failure::Usage(format!(
                "the working directory: {error} (allowed: one that can be read)"
            ))
        })?;
        let manifest = self.manifest(image, claim, &here.display().to_string());
        render::write_file(&path, &manifest)?;
        Ok(format!(
            "shards {} of {} in {path}\nkubectl apply -f {path} runs them, where {here} is claim {claim}'s; then volver merge {} joins them\n",
            self.list(),
            self.shards,
            self.directory.display(),
            path = path.display(),
            here = here.display(),
        ))
    }

    /// The index of a pod counts from 0, and chooses from the list: what was missing is run by a shorter one.
    fn manifest(&self, image: &str, claim: &str, here: &str) -> String {
        let shards: Vec<String> = self.only.iter().map(ToString::to_string).collect();
        let count = shards.len();
        let run = self.command("volver", "\"$1\"");
        // Of its own where other shards are run: a job that is there is not run again.
        let name = Key::of([run.as_str(), &self.list()]);
        let run = format!("set -- $SHARDS; shift \"$JOB_COMPLETION_INDEX\"; exec {run}");
        format!(
            "apiVersion: batch/v1\n\
             kind: Job\n\
             metadata:\n\
             \x20 name: {name}\n\
             \x20 labels:\n\
             \x20   app.kubernetes.io/name: volver\n\
             spec:\n\
             \x20 completionMode: Indexed\n\
             \x20 completions: {count}\n\
             \x20 parallelism: {count}\n\
             \x20 backoffLimit: {count}\n\
             \x20 template:\n\
             \x20   metadata:\n\
             \x20     labels:\n\
             \x20       app.kubernetes.io/name: volver\n\
             \x20   spec:\n\
             \x20     restartPolicy: Never\n\
             \x20     containers:\n\
             \x20       - name: volver\n\
             \x20         image: {image}\n\
             \x20         workingDir: {here}\n\
             \x20         command: [\"/bin/sh\", \"-c\", {run}]\n\
             \x20         env:\n\
             \x20           - name: SHARDS\n\
             \x20             value: {list}\n\
             \x20         resources:\n\
             \x20           requests: {{cpu: {cpu}, memory: {memory}}}\n\
             \x20           limits: {{memory: {memory}}}\n\
             \x20         volumeMounts:\n\
             \x20           - name: work\n\
             \x20             mountPath: {here}\n\
             \x20     volumes:\n\
             \x20       - name: work\n\
             \x20         persistentVolumeClaim:\n\
             \x20           claimName: {claim}\n",
            name = text(&format!("volver-{name}")),
            image = text(image),
            here = text(here),
            run = text(&run),
            list = text(&shards.join(" ")),
            cpu = text(&self.needs.threads.to_string()),
            memory = text(&format!("{}Mi", self.mebibytes())),
            claim = text(claim),
        )
    }
}

/// A string of YAML, which has JSON's.
fn text(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
