//! What a kernel shows now that it did not show then.

use super::{Baseline, BaselineDeviation, BaselineLine, BaselinePart, FIRST};
use crate::study::verify::accept::is_same;
use crate::study::verify::{Acceptance, Accepted, Standing, Verification};
use std::collections::BTreeSet;
use std::fmt;

/// What has moved.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    /// The channel, or `kernel` for what concerns all of it.
    pub name: String,
    /// What it was.
    pub before: String,
    /// What it is.
    pub now: String,
    /// Only for the better: what was not confirmed is.
    pub better: bool,
}

impl fmt::Display for Moved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Moved {
            name, before, now, ..
        } = self;
        write!(f, "{name}: {before} → {now}")
    }
}

impl Baseline {
    /// What has moved since.
    ///
    /// A channel has moved where its standing is another one, or where the intervals of its order have nothing in
    /// common; an order that is a little different, or a verdict that says the same of the kernel, is noise.
    #[must_use]
    pub fn moved(&self, now: &Verification) -> Vec<Moved> {
        let now_all = Baseline::new(now, &self.cases);
        let mut moved = Vec::new();
        // What was not looked for then has not moved.
        if self.volver_baseline != FIRST && self.identify != "off" {
            moved.extend(self.rule_moved(&now_all));
            moved.extend(self.deviations_moved(now, &now_all));
        }
        for line in &now_all.lines {
            match self.lines.iter().find(|before| before.name == line.name) {
                Some(before) => moved.extend(before.moved(line)),
                // What was not measured then has not moved.
                None if self.is_older_than(line) => {}
                None => moved.push(Moved {
                    name: line.name.clone(),
                    before: "not there".into(),
                    now: line.shown(),
                    better: line.standing == "confirmed",
                }),
            }
        }
        for before in &self.lines {
            if !now_all.lines.iter().any(|line| line.name == before.name) {
                moved.push(Moved {
                    name: before.name.clone(),
                    before: before.shown(),
                    now: "not there".into(),
                    better: false,
                });
            }
        }
        moved
    }

    /// Parts of the rule that are not what they were.
    fn rule_moved(&self, now: &Baseline) -> Option<Moved> {
        let moved = |before: String, now: String, better| Moved {
            name: "kernel".into(),
            before,
            now,
            better,
        };
        let none = || "no rule is named".into();
        let (before, now) = match (&self.rule, &now.rule) {
            (None, None) => return None,
            (None, Some(now)) => return Some(moved(none(), words(now), true)),
            (Some(before), None) => return Some(moved(words(before), none(), false)),
            (Some(before), Some(now)) => (before, now),
        };
        let only = |all: &[BaselinePart], others: &[BaselinePart]| -> Vec<BaselinePart> {
            let is_new = |one: &&BaselinePart| !others.iter().any(|other| one.is_same(other));
            all.iter().filter(is_new).cloned().collect()
        };
        let (gone, came) = (only(before, now), only(now, before));
        if gone.is_empty() && came.is_empty() {
            return None;
        }
        let was_wrong =
            |part: &BaselinePart| self.deviations.iter().any(|one| one.name == part.part);
        let better = came.is_empty() && gone.iter().all(was_wrong);
        Some(moved(words(&gone), words(&came), better))
    }

    /// Deviations that came, went or have another value, but for parts of rules that are known both.
    fn deviations_moved(&self, now: &Verification, now_all: &Baseline) -> Vec<Moved> {
        let shown = |name: &str, value: Option<f64>| match value {
            Some(value) => format!("{name}={value}"),
            None => name.into(),
        };
        let mut moved = Vec::new();
        let accepted: Vec<Accepted> = self
            .deviations
            .iter()
            .map(BaselineDeviation::accepted)
            .collect();
        let found = now.identification.as_ref();
        let both = self.rule.iter().zip(&now_all.rule);
        let parts: BTreeSet<&str> = both
            .flat_map(|(before, now)| before.iter().chain(now))
            .map(|part| &part.part[..])
            .collect();
        let mut names = BTreeSet::new();
        for (deviation, how) in found.iter().flat_map(|found| found.deviations(&accepted)) {
            names.insert(deviation.name);
            if parts.contains(deviation.name) {
                continue;
            }
            let before = match how {
                Acceptance::Accepted => continue,
                Acceptance::Moved { from } => shown(deviation.name, Some(from)),
                Acceptance::Unknown => "does not deviate".into(),
            };
            moved.push(Moved {
                name: "kernel".into(),
                before,
                now: shown(deviation.name, deviation.value),
                better: false,
            });
        }
        let is_gone = |name: &str| !names.contains(name) && !parts.contains(name);
        let gone = self.deviations.iter().filter(|one| is_gone(&one.name));
        // Of a kernel that is not known any more nobody knows that.
        let is_known = found.is_some_and(|found| found.named().is_some());
        moved.extend(gone.filter(|_| is_known).map(|one| Moved {
            name: "kernel".into(),
            before: shown(&one.name, one.value),
            now: "does not deviate".into(),
            better: true,
        }));
        moved
    }

    /// Whether it has no line of the quantity of this one: it is from before that was measured.
    fn is_older_than(&self, line: &BaselineLine) -> bool {
        let quantity = |line: &BaselineLine| {
            let name = line.name.split_once(':');
            name.map(|(_, quantity)| quantity.to_string())
        };
        let of_line = quantity(line);
        of_line.is_some() && !self.lines.iter().any(|before| quantity(before) == of_line)
    }

    /// Lines of quantities that it is older than and that contradict now.
    #[must_use]
    pub fn not_measured(&self, now: &Verification) -> Vec<String> {
        let lines = now.lines.iter().filter(|line| {
            let contradicts = matches!(line.standing, Standing::Contradicted | Standing::Failed);
            contradicts && self.is_older_than(&BaselineLine::new(line))
        });
        lines
            .map(|line| format!("{}: {}", line.name, line.standing))
            .collect()
    }

    /// What an older baseline says nothing of: deviations that are there now.
    #[must_use]
    pub fn unrecorded(&self, now: &Verification) -> Vec<String> {
        if self.volver_baseline != FIRST {
            return Vec::new();
        }
        let found = now.identification.iter();
        let deviations = found.flat_map(|found| &found.examined.deviations);
        let said = deviations.map(|deviation| format!("{}: {}", deviation.name, deviation.does));
        said.collect()
    }
}

/// All parts, in words.
fn words(parts: &[BaselinePart]) -> String {
    if parts.is_empty() {
        return "plain".into();
    }
    let words: Vec<&str> = parts.iter().map(|part| &part.words[..]).collect();
    words.join("; ")
}

impl BaselinePart {
    /// Whether it is the same but for a hundredth of its value.
    fn is_same(&self, other: &BaselinePart) -> bool {
        self.part == other.part
            && match self.value {
                Some(value) => is_same(value, other.value),
                None => other.value.is_none() && self.words == other.words,
            }
    }
}

impl BaselineLine {
    fn shown(&self) -> String {
        let order = match self.order.zip(self.half_width) {
            Some((order, half_width)) => format!(", order {order:.3} ± {half_width:.3}"),
            None => String::new(),
        };
        format!("{} ({}{order})", self.standing, self.verdict)
    }

    fn moved(&self, now: &BaselineLine) -> Option<Moved> {
        let apart = match (
            self.order.zip(self.half_width),
            now.order.zip(now.half_width),
        ) {
            (Some((before, wide)), Some((now, narrow))) => (before - now).abs() > wide + narrow,
            _ => false,
        };
        // What methods show too was not asked at first: neither says anything of the kernel.
        let nothing = ["inconclusive", "unresolved"];
        let says_nothing = |line: &BaselineLine| nothing.contains(&line.standing.as_str());
        let other = self.standing != now.standing && !(says_nothing(self) && says_nothing(now));
        (other || apart).then(|| Moved {
            name: self.name.clone(),
            before: self.shown(),
            now: now.shown(),
            better: other && now.standing == "confirmed",
        })
    }
}
