//! A gradient beside the kernel's own values.

use super::Own;
use crate::document::{Block, Fact, Finding, Tone};
use crate::identify::{Deviation, GradientFound};
use serde::Serialize;

/// How many derivatives are those of the values, what is wrong, and the one that is farthest off.
pub(super) fn blocks(own: &Own) -> Vec<Block> {
    let found = match own {
        Ok(found) => found,
        Err(why) => {
            let open = Finding::new("not compared", &why.reason).toned(Tone::Open);
            return vec![Block::Finding(open)];
        }
    };
    let tone = if found.is_right() {
        Tone::Good
    } else {
        Tone::Bad
    };
    let agree = format!("{} of {}", found.agree, found.compared);
    let mut facts = vec![Fact::new("are those of the values", agree).toned(tone)];
    if found.left_out > 0 {
        facts.push(Fact::new("left out, at kinks", found.left_out.to_string()));
    }
    if let Some(shared) = found.shared {
        let alone = shared.rays - shared.differ;
        let words = format!(
            "{alone} of {} rays have the gradient that they have alone",
            shared.rays
        );
        let tone = if shared.differ == 0 {
            Tone::Good
        } else {
            Tone::Bad
        };
        facts.push(Fact::new("several in one request", words).toned(tone));
    }
    facts.push(Fact::new("rays", found.spent.rays.to_string()));
    let mut blocks = vec![Block::Facts(facts)];
    let named = found.deviations.iter().map(|deviation| {
        Block::Finding(Finding::new(deviation.name, said(deviation)).toned(Tone::Bad))
    });
    blocks.extend(named);
    blocks.extend(found.worst.iter().map(|worst| {
        Block::Finding(Finding::new("farthest off", worst.to_string()).toned(Tone::Bad))
    }));
    blocks
}

fn said(deviation: &Deviation) -> String {
    match deviation.bracket {
        Some((low, high)) => format!("{} (between {low:?} and {high:?})", deviation.does),
        None => deviation.does.clone(),
    }
}

/// The same as JSON.
#[derive(Serialize)]
pub(super) struct OwnValues<'a> {
    compared: usize,
    agree: usize,
    left_out: usize,
    deviations: Vec<Named<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    farthest: Option<String>,
    /// Several rays in one request; none where the kernel takes fewer.
    #[serde(skip_serializing_if = "Option::is_none")]
    together: Option<Together>,
    rays: u64,
    /// Why nothing was compared.
    #[serde(skip_serializing_if = "Option::is_none")]
    not_compared: Option<&'a str>,
}

#[derive(Serialize)]
struct Together {
    rays: usize,
    differ: usize,
}

#[derive(Serialize)]
struct Named<'a> {
    name: &'a str,
    value: Option<f64>,
    bracket: Option<(f64, f64)>,
    /// Rays that it was not found with, and holds on.
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    validated: &'a [String],
    does: &'a str,
}

impl<'a> OwnValues<'a> {
    pub(super) fn of(own: &'a Own) -> Self {
        let found = own.as_ref().ok();
        let count = |of: fn(&GradientFound) -> usize| found.map_or(0, of);
        let named = found.into_iter().flat_map(|found| &found.deviations);
        OwnValues {
            compared: count(|found| found.compared),
            agree: count(|found| found.agree),
            left_out: count(|found| found.left_out),
            deviations: named
                .map(|deviation| Named {
                    name: deviation.name,
                    value: deviation.value,
                    bracket: deviation.bracket,
                    validated: &deviation.validated,
                    does: &deviation.does,
                })
                .collect(),
            farthest: found.and_then(|found| found.worst.as_ref().map(ToString::to_string)),
            together: found.and_then(|found| found.shared).map(|shared| Together {
                rays: shared.rays,
                differ: shared.differ,
            }),
            rays: found.map_or(0, |found| found.spent.rays),
            not_compared: own.as_ref().err().map(|why| why.reason.as_str()),
        }
    }
}
