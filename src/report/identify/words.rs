//! Sentences of the report.

use crate::document::Fact;
use crate::identify::{Deviation, Examined, Identification, Scattered, Verdict};
use crate::method::Method;

pub(super) fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Right | Verdict::Deviates => "identified",
        Verdict::NotIdentified => "not identified",
        Verdict::NoAnswer => "not identified: no answer",
    }
}

pub(super) fn conclusion(examined: &Examined) -> String {
    let found = &examined.found;
    let named = found.named().is_some() || found.method.is_some() || found.scattered.is_some();
    match examined.verdict() {
        Verdict::Right => match &found.method {
            Some(method) => format!("The method is identified: {}", method.name()),
            None => "The rule is identified, and does not deviate".into(),
        },
        Verdict::Deviates => {
            let all = examined.deviations.iter().map(|deviation| {
                let value = known(deviation).map(|value| format!(" {}", number(value)));
                format!("{}{}", deviation.name, value.unwrap_or_default())
            });
            let all = all.collect::<Vec<_>>().join(", ");
            if named && found.not_identified.is_empty() {
                format!("The rule is identified, and deviates: {all}")
            } else if named {
                format!("The rule is identified but for a part; what is known deviates: {all}")
            } else {
                format!("The rule is not identified; what is known deviates: {all}")
            }
        }
        Verdict::NotIdentified if named => "The rule is identified but for a part".into(),
        Verdict::NotIdentified => "The rule is not identified".into(),
        Verdict::NoAnswer => "The kernel does not answer".into(),
    }
}

/// That answers are a method's.
pub(in crate::report) fn of_method(method: &Method) -> String {
    format!(
        "It answers as the method {} does, which states no rule.",
        method.name()
    )
}

/// How answers are rounded, as far as that was seen.
pub(super) fn rounding(found: &Identification) -> String {
    let mut words = Vec::new();
    if let Some(precision) = found.hold_out.precision {
        words.push(format!("Answers have {precision}."));
    }
    if let Some(order) = found.accumulation {
        words.push(format!("Contributions are added {order}."));
    }
    if let Some(kept) = found.transmittance {
        words.push(format!("Transmittances are {kept}."));
    }
    if let Some(off) = found.exponential {
        words.push(format!(
            "All {off}, seen by what thousands of thin segments let through."
        ));
    }
    if found.parts.subtracts {
        words.push(
            "Transmittances are 1 less the opacity so far, and lose their digits behind thick segments."
                .into(),
        );
    }
    words.join(" ")
}

/// How far means over seeds are from those of the places that were read off.
pub(super) fn means(scattered: &Scattered) -> String {
    let (seeds, farthest) = (scattered.seeds, scattered.farthest);
    format!(
        "Means over {seeds} seeds differ from its own by at most {farthest:.1} standard errors."
    )
}

/// In which kinds of rays it holds, and in which not.
pub(in crate::report) fn kinds(examined: &Examined) -> String {
    let kinds = &examined.found.hold_out.kinds;
    let of = |holds: bool| -> Vec<&str> {
        let kinds = kinds.iter().filter(|kind| kind.holds() == holds);
        kinds.map(|kind| kind.name.as_str()).collect()
    };
    let (good, bad) = (of(true), of(false));
    let mut words = format!("It holds on rays that are {}.", list(&good));
    if bad.is_empty() {
        let parted = good.iter().filter(|name| name.ends_with(PARTED)).count();
        if parted > 0 {
            // One word for all, where all kinds hold.
            let whole: Vec<&str> = good
                .into_iter()
                .filter(|name| !name.ends_with(PARTED))
                .collect();
            words = format!("It holds on rays that are {}", list(&whole));
            words = format!("{words}; with a last step that is whole, and one that is shorter.");
        }
    } else {
        words = format!("{words} It does not on rays that are {}.", list(&bad));
    }
    words
}

/// What names of kinds end with whose last step is shorter.
const PARTED: &str = ", shorter last step";

fn list(words: &[&str]) -> String {
    if words.is_empty() {
        "of no kind".into()
    } else {
        words.join("; ")
    }
}

/// A parameter that was bisected, counted, or read as it came: of no other a number is named.
pub(super) fn known(deviation: &Deviation) -> Option<f64> {
    let is_known = deviation.exact || deviation.bracket.is_some();
    deviation.value.filter(|_| is_known)
}

/// What a kernel does, between what its parameter lies, in place of what, and the probe that shows it.
pub(in crate::report) fn sentence(deviation: &Deviation) -> String {
    let mut words = deviation.does.clone();
    if let Some((low, high)) = deviation.bracket {
        words = format!("{words} (between {low:?} and {high:?})");
    }
    if let Some(other) = &deviation.instead_of {
        words = format!("{words}, in place of: {other}");
    }
    format!("{words}; seen by {}", deviation.probe)
}

/// What was asked.
pub(super) fn spent(examined: &Examined) -> Vec<Fact> {
    let found = examined.found.spent;
    let mut facts = vec![
        Fact::new("rays", found.rays.to_string()),
        Fact::new("segments", found.segments.to_string()),
        Fact::new("the longest", format!("{} segments", found.longest)),
    ];
    if found.unanswered > 0 {
        facts.push(Fact::new("unanswered", found.unanswered.to_string()));
    }
    if examined.searched.rays > 0 {
        let rays = examined.searched.rays.to_string();
        facts.push(Fact::new("rays for the witness", rays));
    }
    facts
}

/// A number that is neither long nor wrong.
pub(in crate::report) fn number(x: f64) -> String {
    let size = x.abs();
    if x.is_finite() && size > 0.0 && !(1e-4..1e6).contains(&size) {
        format!("{x:e}")
    } else {
        x.to_string()
    }
}
