//! What is wrong with answers, whatever they are.

use super::Line;
use crate::kernel::Declaration;

/// What was found, and where it shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// In words.
    pub words: String,
    /// The channels that show it.
    pub channels: Vec<String>,
    /// Whether it speaks against the kernel: that seeds are too few does not.
    pub wrong: bool,
}

/// Opacities that are none.
pub(super) fn outside(lines: &[Line]) -> Option<Finding> {
    let outside = lines.iter().filter(|line| line.outside.is_some());
    let channels: Vec<String> = outside.map(|line| line.name.clone()).collect();
    let first = lines.iter().find_map(|line| line.outside)?;
    Some(Finding {
        words: format!("an opacity of {first} (allowed: 0 to 1)"),
        channels,
        wrong: true,
    })
}

/// Channels in which the same question has two answers.
pub(super) fn unsteady(declaration: &Declaration, lines: &[Line]) -> Option<Finding> {
    let unsteady = lines.iter().filter(|line| !line.steady);
    let channels: Vec<String> = unsteady.map(|line| line.name.clone()).collect();
    let words = match declaration.noise {
        _ if declaration.stochastic => "the same seed has two answers",
        Some(_) => "answers differ from run to run by more than twice the declared noise",
        None => "answers differ from run to run, and the kernel is said to be deterministic",
    };
    (!channels.is_empty()).then(|| Finding {
        words: words.into(),
        channels,
        wrong: true,
    })
}
