//! `volver adjoint`: whether a projector and its backprojector are adjoint to each other.

use super::about::about;
use super::kernel::{KERNELS, KernelArguments};
use super::output::Output;
use super::{Color, Failure, Outcome};
use clap::Args;
use std::path::PathBuf;
use volver::report::adjoint::{document, json, write};
use volver::study::adjoint::adjoint;

const EXAMPLES: &str = "\
A projector answers line integrals t = A x, x being the extinctions of a ray, and its
backprojector x = Aᵀ y where a task has cotangents, here y. The kernel declares
\"adjoint\": \"plain\" or \"lengths\", the inner product of x, beside \"gradient\" and
\"answers\": [\"optical_depth\"] (docs/protocol.md).

Every entry of A, asked by one value of 1 alone, is compared with that of Aᵀ, on five rays, and
⟨A x, y⟩ with ⟨x, Aᵀ y⟩ for positive vectors, vectors of zero mean, and y = A x. What explains
all entries is named: a factor, a sign, weights other than those declared.
docs/gradient.md says more.

The exit code is 0 where the pair is matched, 1 where it is not, 2 where it could not run.

Work: some hundred rays of 5 to 9 segments, or as many as the kernel takes; a program has
--timeout for each answer.

JSON: matched, inner_product, entries, differ, fault, broken, rays and products with vectors,
forward, back and mismatch.

Examples:
  volver adjoint python3 examples/kernels/projector.py
  volver adjoint --json - python3 examples/kernels/projector.py --fault factor";

/// Compare a projector with its backprojector
#[derive(Args)]
#[command(override_usage = "volver adjoint [OPTIONS] <KERNEL> [ARGS]...")]
#[command(after_help = format!("{KERNELS}\n\n{EXAMPLES}"))]
pub(crate) struct Adjoint {
    #[command(flatten)]
    kernel: KernelArguments,
    /// Write one JSON document; - is standard output, without the table
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the report, as a page, Markdown and JSON, into a directory
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print no table
    #[arg(long)]
    quiet: bool,
    /// Colour the verdicts
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    color: Color,
}

impl Adjoint {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        let output = Output {
            out: self.out.as_deref(),
            files: vec![("--json", self.json.as_deref())],
            quiet: self.quiet,
            color: self.color,
        };
        let at_once = self.kernel.at_once()?;
        output.check()?;
        let mut kernel = at_once.map_or_else(|| self.kernel.program(), Ok)?;
        let found = adjoint(kernel.as_mut());
        self.kernel.still_there(kernel.as_ref())?;
        // The child is gone before the last word.
        drop(kernel);
        let found = found.map_err(|error| self.kernel.failed(error))?;
        output.hand_out(
            &document(&found, &about()),
            |directory| write(directory, &found, &about()),
            |_| json(&found),
        )?;
        Ok(if found.is_matched() {
            Outcome::Good
        } else {
            Outcome::CheckFailed
        })
    }
}
