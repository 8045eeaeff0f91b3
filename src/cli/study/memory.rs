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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn magnitudes_are_told_in_fitting_units() {
        assert_eq!(size(3.0 * GIB), "3.0 GiB");
        assert_eq!(size(1e30), "867361737988 EiB");
        assert_eq!(time(0.4), "0 s");
        assert_eq!(time(90.0), "1.5 min");
        assert_eq!(time(86_400.0 * 365.0 * 2.0), "2.0 years");
    }

    #[test]
    fn what_is_too_large_is_refused_with_its_size() {
        let huge = Estimate {
            bytes: 1e15,
            work: 1e15,
        };
        for yes in [false, true] {
            let said = check(&huge, 2, yes).unwrap_err().to_string();
            assert!(
                said.starts_with("the study takes about 909 TiB of memory and "),
                "{said}"
            );
        }
        check(
            &Estimate {
                bytes: 1e6,
                work: 1e15,
            },
            1,
            false,
        )
        .unwrap();
    }
}
