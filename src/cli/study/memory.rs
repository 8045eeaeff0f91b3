//! Studies that are too large are refused before they begin.

use crate::cli::Failure;
use std::fs;
use volver::study::sweep::Estimate;

const GIB: f64 = (1_u64 << 30) as f64;
/// More needs --yes.
const USUAL: f64 = 2.0 * GIB;
/// More can no machine address, of those that exist.
const ADDRESSABLE: f64 = (1_u64 << 47) as f64;

/// Refuses more than is usual without `yes`, and more than there is with it.
pub(super) fn check(estimate: &Estimate, threads: usize, yes: bool) -> Result<(), Failure> {
    let memory = Memory::of_this_machine();
    let available = memory.available.unwrap_or(USUAL).min(USUAL);
    let total = memory.total.unwrap_or(ADDRESSABLE);
    let bytes = estimate.bytes;
    let (allowed, how) = if yes {
        (total, ", all that this machine has")
    } else {
        (available, " without --yes")
    };
    if bytes <= allowed {
        return Ok(());
    }
    Err(Failure::Usage(format!(
        "the study takes about {} of memory and {} (allowed: up to {}{how})",
        size(bytes),
        time(estimate.seconds(threads)),
        size(allowed)
    )))
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

fn size(bytes: f64) -> String {
    let units = ["bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"];
    scaled(bytes, &units, &[1024.0; 6])
}

fn time(seconds: f64) -> String {
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
