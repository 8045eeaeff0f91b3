//! Work that is too much is refused before it begins, with what it would take.

use super::Failure;
use std::fmt;
use std::fs;
use std::io::{self, IsTerminal, Write};

const GIB: f64 = (1_u64 << 30) as f64;
/// More memory needs --yes.
const USUAL_BYTES: f64 = 2.0 * GIB;
/// More time needs --yes, of what people wait for beside other things, and of a single number.
pub(super) const HOUR: f64 = 3600.0;
pub(super) const MINUTE: f64 = 60.0;
/// Seconds that are worth a word beforehand.
const A_WHILE: f64 = 10.0;
/// More can no machine address, of those that exist.
const ADDRESSABLE: f64 = (1_u64 << 47) as f64;

/// What the help of commands says that take --yes.
pub(super) const WORK: &str = "\
Work: what would take more than 2 GiB of memory or 1 h is refused with an estimate of
both, unless you say --yes; more memory than there is is refused always.";

/// What a command would take, within a factor of a few.
pub(super) struct Budget<'a> {
    /// The work, for a message.
    pub(super) what: &'a str,
    pub(super) bytes: f64,
    pub(super) seconds: f64,
    /// How long it may take without --yes.
    pub(super) usual: f64,
}

impl Budget<'_> {
    /// Refuses more than is usual without `yes`, and more memory than there is with it.
    pub(super) fn check(&self, yes: bool) -> Result<(), Failure> {
        let memory = Memory::of_this_machine();
        let (most, allowed) = if yes {
            let total = memory.total.unwrap_or(ADDRESSABLE);
            let all = format!("{}, all that this machine has", size(total));
            ((total, f64::INFINITY), all)
        } else {
            let available = memory.available.unwrap_or(USUAL_BYTES).min(USUAL_BYTES);
            let usual = format!("{} and {}", size(available), time(self.usual));
            ((available, self.usual), format!("{usual} without --yes"))
        };
        if self.bytes <= most.0 && self.seconds <= most.1 {
            return Ok(());
        }
        Err(Failure::Usage(format!("{self} (allowed: up to {allowed})")))
    }

    /// Says it on the terminal, where there is one, before work that takes a while.
    pub(super) fn announce(&self) {
        if self.seconds >= A_WHILE && io::stderr().is_terminal() {
            // Who does not hear it has lost nothing.
            let _ = writeln!(io::stderr(), "{self}");
        }
    }
}

impl fmt::Display for Budget<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (bytes, seconds) = (size(self.bytes), time(self.seconds));
        write!(
            f,
            "{} takes about {bytes} of memory and {seconds}",
            self.what
        )
    }
}

/// Bytes, where the system tells.
struct Memory {
    available: Option<f64>,
    total: Option<f64>,
}

impl Memory {
    fn of_this_machine() -> Memory {
        let text = fs::read_to_string("/proc/meminfo").unwrap_or_default();
        let kib = |key: &str| -> Option<f64> {
            let line = text.lines().find_map(|line| line.strip_prefix(key))?;
            line.split_whitespace().next()?.parse().ok()
        };
        let bytes = |key| kib(key).map(|kib| 1024.0 * kib);
        Memory {
            available: bytes("MemAvailable:"),
            total: bytes("MemTotal:"),
        }
    }
}

pub(super) fn size(bytes: f64) -> String {
    let units = ["bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"];
    scaled(bytes, &units, &[1024.0; 6])
}

/// Seconds in a unit that suits them.
pub(super) fn time(seconds: f64) -> String {
    scaled(
        seconds,
        &["s", "min", "h", "days", "years"],
        &[60.0, 60.0, 24.0, 365.0],
    )
}

/// In the largest unit that there is one of.
fn scaled(mut value: f64, units: &[&str], factors: &[f64]) -> String {
    let mut unit = 0;
    while let Some(factor) = factors.get(unit)
        && value >= *factor
    {
        value /= factor;
        unit += 1;
    }
    let digits = usize::from(value < 10.0 && unit > 0);
    format!("{value:.digits$} {}", units[unit])
}
