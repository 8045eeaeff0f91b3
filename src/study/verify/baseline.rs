//! What a kernel showed once, to compare with what it shows now.

use super::{Axis, Line, Settings, SettingsError, Standing, Steps, Verification};
use crate::convergence::Ladder;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::fmt;

/// The version of the file.
const VERSION: u32 = 1;

/// A verification, as far as later ones are compared with it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Baseline {
    /// The version of the file, 1.
    pub volver_baseline: u32,
    /// The kernel's name.
    pub kernel: String,
    /// Which cases, as they were asked for; none for all of the catalogue.
    pub cases: Vec<String>,
    /// The levels.
    pub ladder: Vec<u64>,
    /// Whether the grid was refined, and not the step.
    pub grid: bool,
    /// Whether steps divided no ray, and the last segment was another part of the others at every level.
    pub uneven: bool,
    /// Whether steps divided the ray: so they did before they could do otherwise.
    #[serde(default = "always")]
    pub divides: bool,
    /// The order expected in place of the declared one.
    pub expect: Option<String>,
    /// Seeds a level, for kernels that draw random numbers.
    pub replicas: usize,
    /// What the values were found to be; `None` where nothing was found.
    pub fingerprint: Option<String>,
    /// One a channel.
    pub lines: Vec<BaselineLine>,
}

/// One channel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BaselineLine {
    /// The case, with its channel.
    pub name: String,
    /// The verdict on the order.
    pub verdict: String,
    /// What it said of the kernel.
    pub standing: String,
    /// The order, if there was one.
    pub order: Option<f64>,
    /// The half-width of its interval.
    pub half_width: Option<f64>,
}

/// A baseline that cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BaselineError {
    /// No JSON of a baseline.
    #[error("no baseline: {reason} (allowed: what 'volver verify --save' writes)")]
    Format {
        /// Why.
        reason: String,
    },
    /// Another version.
    #[error("a baseline of version {found} (allowed: {VERSION})")]
    Version {
        /// Its version.
        found: u64,
    },
    /// Levels, an order or a number of seeds that no kernel can be tested with.
    #[error("'{key}': {error}")]
    Settings {
        /// Where.
        key: &'static str,
        /// Why.
        error: SettingsError,
    },
    /// A channel that no kernel shows.
    #[error("'lines', '{}': {problem}", name.escape_debug())]
    Line {
        /// The channel's name.
        name: String,
        /// What is wrong, and what is allowed.
        problem: &'static str,
    },
}

fn always() -> bool {
    true
}

/// Enough of a file to know its version: another one may have other keys.
#[derive(Deserialize)]
#[serde(expecting = "a baseline")]
struct Versioned {
    volver_baseline: u64,
}

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
    /// What there is to keep of a verification of these cases, as they were asked for.
    #[must_use]
    pub fn new(verification: &Verification, cases: &[String]) -> Self {
        let settings = &verification.settings;
        let best = verification
            .fingerprint
            .as_ref()
            .filter(|found| found.is_named())
            .and_then(|found| found.best.as_ref());
        Baseline {
            volver_baseline: VERSION,
            kernel: verification.declaration.name.clone(),
            cases: cases.to_vec(),
            ladder: settings.ladder.clone(),
            grid: settings.axis == Axis::Grid,
            uneven: settings.steps == Steps::Uneven,
            divides: settings.steps == Steps::Divide,
            expect: settings.expect.as_ref().map(ToString::to_string),
            replicas: settings.replicas,
            fingerprint: best.map(|best| best.model.to_string()),
            lines: verification.lines.iter().map(BaselineLine::new).collect(),
        }
    }

    /// Reads one.
    ///
    /// # Errors
    /// [`BaselineError`] where the text is none.
    pub fn read(text: &str) -> Result<Self, BaselineError> {
        let format = |error: serde_json::Error| BaselineError::Format {
            reason: one_line(&error.to_string()),
        };
        let version: Versioned = serde_json::from_str(text).map_err(format)?;
        if version.volver_baseline != u64::from(VERSION) {
            return Err(BaselineError::Version {
                found: version.volver_baseline,
            });
        }
        let baseline: Baseline = serde_json::from_str(text).map_err(format)?;
        baseline.settings()?;
        let fingerprint = baseline.fingerprint.as_deref().unwrap_or_default();
        if fingerprint.chars().any(char::is_control) {
            return Err(BaselineError::Format {
                reason: "a control character in 'fingerprint'".into(),
            });
        }
        let mut names = BTreeSet::new();
        for line in &baseline.lines {
            let problem = line.problem().or_else(|| {
                let again = !names.insert(&line.name);
                again.then_some("a second time (allowed: each channel once)")
            });
            if let Some(problem) = problem {
                return Err(BaselineError::Line {
                    name: line.name.clone(),
                    problem,
                });
            }
        }
        Ok(baseline)
    }

    /// As it is written to a file.
    ///
    /// # Errors
    /// Those of the serializer.
    pub fn to_json(&self) -> serde_json::Result<String> {
        serde_json::to_string_pretty(self).map(|json| json + "\n")
    }

    /// The same settings once more.
    ///
    /// # Errors
    /// [`BaselineError::Settings`] where somebody has edited them.
    pub fn settings(&self) -> Result<Settings, BaselineError> {
        let wrong = |key| move |error| BaselineError::Settings { key, error };
        let ladder = Ladder::segments(self.ladder.clone()).map_err(SettingsError::from);
        let ladder = ladder.and_then(|ladder| Settings::new(&ladder));
        let expect = self.expect.as_deref().map(Settings::order).transpose();
        Ok(Settings {
            axis: if self.grid { Axis::Grid } else { Axis::Step },
            steps: match (self.uneven, self.divides) {
                (true, _) => Steps::Uneven,
                (false, true) => Steps::Divide,
                (false, false) => Steps::PartLast,
            },
            expect: expect.map_err(wrong("expect"))?,
            replicas: Settings::replicas(self.replicas).map_err(wrong("replicas"))?,
            ..ladder.map_err(wrong("ladder"))?
        })
    }

    /// What has moved since.
    ///
    /// A channel has moved where its standing is another one, or where the intervals of its order have nothing in
    /// common; an order that is a little different, or a verdict that says the same of the kernel, is noise.
    #[must_use]
    pub fn moved(&self, now: &Verification) -> Vec<Moved> {
        let now_all = Baseline::new(now, &self.cases);
        let mut moved = Vec::new();
        if self.fingerprint != now_all.fingerprint {
            let shown = |found: &Option<String>| match found {
                Some(model) => format!("computes {model}"),
                None => "computes nothing known".into(),
            };
            moved.push(Moved {
                name: "kernel".into(),
                before: shown(&self.fingerprint),
                now: shown(&now_all.fingerprint),
                better: false,
            });
        }
        for line in &now_all.lines {
            match self.lines.iter().find(|before| before.name == line.name) {
                Some(before) => moved.extend(before.moved(line)),
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
}

/// Keys of a file are repeated in messages as they are: line feeds must not be.
fn one_line(text: &str) -> String {
    let shown = |c: char| {
        if c.is_control() {
            c.escape_debug().to_string()
        } else {
            c.to_string()
        }
    };
    text.chars().map(shown).collect()
}

impl BaselineLine {
    fn new(line: &Line) -> Self {
        let order = line.measured.order();
        BaselineLine {
            name: line.name.clone(),
            verdict: line.measured.verdict().name().into(),
            standing: line.standing.name().into(),
            order: order.map(|(order, _)| order),
            half_width: order.map(|(_, half_width)| half_width),
        }
    }

    /// Why no kernel shows this.
    fn problem(&self) -> Option<&'static str> {
        let standings = [
            Standing::Confirmed,
            Standing::Contradicted,
            Standing::Inconclusive,
            Standing::Unresolved,
            Standing::Blind,
            Standing::Failed,
        ];
        if [&self.name, &self.verdict]
            .iter()
            .any(|text| text.chars().any(char::is_control))
        {
            return Some("a control character (allowed: text in one line)");
        }
        if !standings.iter().any(|one| one.name() == self.standing) {
            return Some(
                "unknown standing (allowed: confirmed, contradicted, inconclusive, unresolved, blind, failed)",
            );
        }
        let negative = self.half_width.is_some_and(|half_width| half_width < 0.0);
        negative.then_some("half_width below 0 (allowed: 0 or above)")
    }

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
