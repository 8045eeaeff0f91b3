//! Where a ray is looked at.

use std::fmt;

/// Where in its segment a kernel looks at the medium.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Places {
    /// Once, at the end nearer to the eye.
    #[default]
    Front,
    /// Once, in the middle.
    Middle,
    /// Once, at the end farther from the eye.
    Back,
    /// At both ends, by trapezoid rules for depth and radiance.
    Ends,
    /// At both ends, C and τ linear between them, without any further error.
    Linear,
}

impl Places {
    /// All of them.
    pub const ALL: [Places; 5] = [
        Places::Front,
        Places::Middle,
        Places::Back,
        Places::Ends,
        Places::Linear,
    ];

    /// Whether one sample stands for its segment.
    #[must_use]
    pub fn is_one_sample(self) -> bool {
        matches!(self, Places::Front | Places::Middle | Places::Back)
    }
}

impl fmt::Display for Places {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Places::Front => "front samples",
            Places::Middle => "middle samples",
            Places::Back => "back samples",
            Places::Ends => "trapezoid rules for depth and radiance",
            Places::Linear => "segments of linear C and τ, integrated exactly",
        })
    }
}
