//! The machine, in one line.

use crate::real::lanes::Width;
use std::fs;
use std::thread;

/// "Linux, `x86_64`, the processor's name, 16 lanes, 8 cores".
pub(super) fn machine() -> String {
    let os = match std::env::consts::OS {
        "linux" => "Linux",
        "macos" => "macOS",
        "windows" => "Windows",
        other => other,
    };
    let mut parts = vec![os.to_string(), std::env::consts::ARCH.to_string()];
    let told = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    parts.extend(processor(&told));
    let lanes = Width::current();
    let noun = if lanes == Width::One { "lane" } else { "lanes" };
    parts.push(format!("{lanes} {noun}"));
    if let Ok(cores) = thread::available_parallelism() {
        let noun = if cores.get() == 1 { "core" } else { "cores" };
        parts.push(format!("{cores} {noun}"));
    }
    parts.join(", ")
}

/// What `/proc/cpuinfo` calls the first processor.
fn processor(told: &str) -> Option<String> {
    let named = |key: &str| {
        told.lines()
            .filter_map(|line| line.split_once(':'))
            .find(|(name, _)| name.trim() == key)
    };
    let (_, name) = named("model name")
        .or_else(|| named("Model"))
        .or_else(|| named("cpu model"))?;
    let name = name.split_whitespace().collect::<Vec<_>>().join(" ");
    (!name.is_empty()).then_some(name)
}
