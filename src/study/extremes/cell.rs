//! What became of one answer to one scenario.

use crate::kernel::Quantity;
use crate::study::stress::Digits;
use rug::Float;
use std::fmt;

/// What an answer is, where it is more than its digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Answer {
    /// There is none.
    Missing,
    /// NaN.
    NotANumber,
    /// An infinity.
    Infinite,
    /// 0, where the truth is not.
    Zero,
    /// Below 0, where the truth is not.
    Negative,
    /// That of max(τ, 0), where τ is below 0.
    Rectified,
    /// That of the formula, where τ is below 0: the ray becomes brighter on its way.
    Amplified,
    /// Where τ is below 0, neither of these.
    Neither,
    /// Of a rule that is not exact in an even medium, in segments too thick for it.
    Coarse,
}

impl Answer {
    /// All of them.
    pub const ALL: [Answer; 9] = [
        Answer::Missing,
        Answer::NotANumber,
        Answer::Infinite,
        Answer::Zero,
        Answer::Negative,
        Answer::Rectified,
        Answer::Amplified,
        Answer::Neither,
        Answer::Coarse,
    ];

    /// In a word, as in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Answer::Missing => "none",
            Answer::NotANumber => "nan",
            Answer::Infinite => "inf",
            Answer::Zero => "0",
            Answer::Negative => "below 0",
            Answer::Rectified => "rectified",
            Answer::Amplified => "amplified",
            Answer::Neither => "neither",
            Answer::Coarse => "coarse",
        }
    }

    /// In one line.
    #[must_use]
    pub fn meaning(self) -> &'static str {
        match self {
            Answer::Missing => "no answer",
            Answer::NotANumber => "the answer is NaN",
            Answer::Infinite => "the answer is an infinity",
            Answer::Zero => "0, where the truth is not",
            Answer::Negative => "below 0, where the truth is not",
            Answer::Rectified => "tau below 0 is taken for 0",
            Answer::Amplified => {
                "tau below 0 goes into the formula: the ray becomes brighter on its way"
            }
            Answer::Neither => {
                "tau below 0 is neither taken for 0 nor put into the formula; nothing is promised there"
            }
            Answer::Coarse => {
                "the rule is not exact in an even medium, and nothing is promised of it where tau d > 1"
            }
        }
    }

    /// Whether digits say nothing beside it.
    #[must_use]
    pub fn stands_alone(self) -> bool {
        matches!(
            self,
            Answer::Missing | Answer::NotANumber | Answer::Infinite | Answer::Zero
        )
    }
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// One quantity of one scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// The scenario's name.
    pub scenario: String,
    /// What was answered.
    pub quantity: Quantity,
    /// The number of segments.
    pub n: u64,
    /// The answer, where there is one.
    pub value: Option<Float>,
    /// The exact answer; of τ below 0 that of max(τ, 0). `None` where there is none.
    pub truth: Option<Float>,
    /// Digits of what the declared method gives without rounding, or of the truth where none is declared.
    pub digits: Option<Digits>,
    /// Digits of the truth.
    pub against_truth: Option<Digits>,
    /// Digits that format and method promise; `None` where nothing is promised.
    pub promised: Option<f64>,
    /// What the answer is, where it is more than its digits.
    pub answer: Option<Answer>,
    /// Why, where that is known.
    pub reason: Option<String>,
    /// Whether that speaks against the kernel.
    pub is_fault: bool,
}

impl Cell {
    /// "depth/1e-12", and the quantity where it is no radiance.
    #[must_use]
    pub fn name(&self) -> String {
        match self.quantity {
            Quantity::Radiance => self.scenario.clone(),
            other => format!("{}:{}", self.scenario, other.name()),
        }
    }
}
