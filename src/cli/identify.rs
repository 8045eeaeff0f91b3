//! `volver identify`: what a kernel computes, read off by probes.

mod code;
mod replay;
mod stated;

use super::about::about;
use super::kernel::{KERNELS, KernelArguments};
use super::output::Output;
use super::{Bar, Color, Failure, Outcome};
use clap::Args;
use code::Code;
use std::path::PathBuf;
use std::str::FromStr;
use std::time::Duration;
use volver::identify::{Budget, Examined, Known, Spent, Verdict, against, examine};
use volver::kernel::{Kernel, Quantity};
use volver::report::identify::{Other, document, json, write};
use volver::study::Progress;
use volver::symbolic::code::Language;

const EXAMPLES: &str = "\
The kernel is asked rays that are made to tell, and what it computes is read off as an
explicit rule: where samples lie, what they weigh, where rays end, what becomes of the
radiance. A rule is named where it predicts the answers to rays of all kinds that it was
not found with; what could not be read off is shown as it was measured. Deviations are
those from the rule of the same places without faults. docs/identify.md says more.

The exit code is 0 where a rule is identified and does not deviate; 1 where it deviates,
nothing or not all could be named or --against finds a difference; 2 where it could not run.

Work: at most RAYS rays, as many again for a witness and three times as many with
--against, of up to 1210 segments; a program has --timeout for each answer. A bar on the
terminal says how many are left at most.

A method of volver's own is not asked: the rule that it states is printed.

JSON: verdict, rule, scattered, volume, validated, deviations, not_identified, witness,
opacity, against, cost.

Examples:
  volver identify --budget 300 python3 examples/kernels/nerf.py
  volver identify --json - python3 examples/kernels/nerf.py
  volver identify --code python python3 examples/kernels/nerf.py
  volver identify --against 'python3 examples/kernels/nerf.py' python3 examples/kernels/nerf.py";

/// Read off what a kernel computes, and how that deviates
#[derive(Args)]
#[command(override_usage = "volver identify [OPTIONS] <KERNEL> [ARGS]...")]
#[command(after_help = format!("{KERNELS}\n\n{EXAMPLES}"))]
#[allow(clippy::doc_markdown)] // Help is no Markdown.
pub(crate) struct Identify {
    #[command(flatten)]
    kernel: KernelArguments,
    /// Rays asked at most, for the rule and for the witness
    #[arg(long, value_name = "RAYS", default_value_t = 1_000, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    budget: u64,
    /// Seconds taken at most, for the rule and for the witness
    #[arg(long, value_name = "SECONDS", default_value_t = 600, value_parser = clap::value_parser!(u64).range(1..=604_800))]
    seconds: u64,
    /// Channels of a ray at most
    #[arg(long, value_name = "N", default_value_t = 66, value_parser = clap::value_parser!(u64).range(1..=1_024))]
    channels: u64,
    /// Compare with another kernel: a program with its arguments by blanks, a library or
    /// gallery:NAME, what a real package computes
    #[arg(long, value_name = "KERNEL2")]
    against: Option<String>,
    /// Ask only the ray of a witness again: a file of --json, or of one task
    #[arg(long, value_name = "FILE", conflicts_with_all = ["against", "json", "out", "test"])]
    replay: Option<String>,
    /// Print the witness as a unit test: c, python or rust
    #[arg(long, value_name = "LANGUAGE", value_parser = Language::from_str)]
    test: Option<Language>,
    /// Print the named rule as code, and nothing else: c or python
    #[arg(long, value_name = "LANGUAGE", value_enum, conflicts_with_all = ["json", "test", "replay", "quiet"])]
    code: Option<Code>,
    /// What the unit test calls
    #[arg(long, value_name = "NAME", default_value = "render", value_parser = identifier)]
    function: String,
    /// Write one JSON document; - is standard output, without the text
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the report, as a page, Markdown and JSON with SVG plots, into a directory
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print no text
    #[arg(long)]
    quiet: bool,
    /// Colour the verdict
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    color: Color,
}

/// What can be called in C, Python and Rust: names and paths of them.
fn identifier(text: &str) -> Result<String, &'static str> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | ':');
    let starts = text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    if starts && text.chars().all(is_part) {
        Ok(text.into())
    } else {
        Err("no name (allowed: letters, digits, _, . and : behind a letter or _)")
    }
}

impl Identify {
    pub(crate) fn run(self) -> Result<Outcome, Failure> {
        if let Some((name, method)) = self.kernel.method()? {
            return self.stated(name, &method);
        }
        if let Some(file) = &self.replay {
            let asked = replay::read(file)?;
            let mut kernel = self.kernel.started()?;
            return replay::run(&asked, kernel.as_mut(), &self.kernel);
        }
        let output = self.output();
        output.check()?;
        let second = self.against.as_deref();
        let second = second.map(|command| self.kernel.another(command));
        if let Some(second) = &second
            && let Some((name, _)) = second.method()?
        {
            return Err(stated::not_asked(&name, "--against"));
        }
        let mut kernel = self.kernel.started()?;
        let examined = self.examine(kernel.as_mut(), &self.kernel)?;
        let other = match &second {
            None => None,
            Some(named) => {
                let mut second = named.started()?;
                let theirs = self.examine(second.as_mut(), named)?;
                let one = Known {
                    kernel: kernel.as_mut(),
                    found: &examined.found,
                };
                let other = Known {
                    kernel: second.as_mut(),
                    found: &theirs.found,
                };
                let found = self.with_bar(|heard| against(one, other, self.limits(), heard));
                Some(Other {
                    name: theirs.declaration.name.clone(),
                    against: found.map_err(|silence| self.kernel.failed(silence))?,
                    examined: theirs,
                })
            }
        };
        // The child is gone before the last word.
        drop(kernel);
        let test = self.unit_test(&examined)?;
        let code = self.code.zip(examined.found.named());
        let code = code.map(|(code, rule)| code.of(rule));
        let output = Output {
            quiet: self.quiet || code.is_some(),
            ..output
        };
        output.hand_out(
            &document(&examined, other.as_ref(), &about()),
            |directory| write(directory, &examined, other.as_ref(), &about()),
            |_| json(&examined, other.as_ref()),
        )?;
        if let Some(test) = test
            && output.prints_text()
        {
            super::write_out(&format!("\n{test}"))?;
        }
        if let Some(code) = code {
            super::write_out(&code)?;
        }
        let differs = other.is_some_and(|other| !other.against.agree());
        Ok(if examined.verdict() == Verdict::Right && !differs {
            Outcome::Good
        } else {
            Outcome::CheckFailed
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

    fn limits(&self) -> Budget {
        Budget {
            rays: self.budget,
            time: Duration::from_secs(self.seconds),
            channels: usize::try_from(self.channels).unwrap_or(usize::MAX),
        }
    }

    fn examine(
        &self,
        kernel: &mut dyn Kernel,
        named: &KernelArguments,
    ) -> Result<Examined, Failure> {
        if !kernel.declaration().has(Quantity::Radiance) {
            let why = "it answers no radiance (allowed: a radiance among its answers)";
            return Err(named.failed(anyhow::anyhow!(why)));
        }
        let examined = self.with_bar(|heard| examine(kernel, self.limits(), heard));
        named.still_there(kernel)?;
        if examined.verdict() == Verdict::NoAnswer {
            let reasons = examined.found.not_identified.iter();
            let why = reasons.map(|reason| reason.reason.clone()).next();
            let why = why.unwrap_or_else(|| "no answer".into());
            return Err(named.failed(anyhow::anyhow!(why)));
        }
        Ok(examined)
    }

    /// Does it with a bar of rays.
    fn with_bar<T>(&self, work: impl FnOnce(&mut dyn FnMut(&Spent)) -> T) -> T {
        let bar = Bar::new(self.budget);
        let mut before = 0;
        let done = work(&mut |spent: &Spent| {
            // What begins anew has its own count.
            bar.advance(spent.rays.saturating_sub(before));
            before = spent.rays;
        });
        bar.finish();
        done
    }

    fn unit_test(&self, examined: &Examined) -> Result<Option<String>, Failure> {
        let (Some(language), Some(witness)) = (self.test, &examined.witness) else {
            return Ok(None);
        };
        let test = witness.unit_test(language, &self.function);
        test.map(Some).map_err(|error| self.kernel.failed(error))
    }
}
