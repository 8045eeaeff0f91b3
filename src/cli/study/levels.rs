//! Which numbers of segments.

use super::asked::{Asked, Asking};
use crate::cli::Failure;
use std::str::FromStr;
use volver::convergence::Ladder;
use volver::study::sweep::FileLevels;

const DEFAULT: &str = "8..4096";

pub(in crate::cli) fn chosen(asking: &Asking, given: Option<&str>) -> Result<Vec<u64>, Failure> {
    let asked = |text: &str, at: String| Asked {
        text: text.into(),
        at,
        directory: None,
    };
    let asked = match (given, &asking.file.levels) {
        (Some(text), _) => asked(text, "--levels".into()),
        (None, Some(levels)) => match levels.get_ref() {
            FileLevels::Ladder(text) => asked(text, asking.place(levels)),
            FileLevels::List(list) => {
                let asked = asked("", asking.place(levels));
                let ladder =
                    Ladder::segments(list.clone()).map_err(|error| asked.refused(error))?;
                return segments(&ladder, &asked);
            }
        },
        (None, None) => asked(DEFAULT, "--levels".into()),
    };
    let ladder = Ladder::from_str(&asked.text).map_err(|error| asked.refused(error))?;
    segments(&ladder, &asked)
}

fn segments(ladder: &Ladder, asked: &Asked) -> Result<Vec<u64>, Failure> {
    let segments = ladder.as_segments().ok_or_else(|| {
        asked.refused(format!(
            "'{}' is a ladder of steps (allowed: numbers of segments)",
            asked.shown()
        ))
    })?;
    Ok(segments.to_vec())
}
