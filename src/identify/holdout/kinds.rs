//! The kinds of rays that are held out.

use super::Kind;

/// The depth of a segment that is a wall.
pub(super) const WALL: f64 = 1e5;

/// The kind of emissions of both signs.
pub(super) const NEGATIVE: &str = "with negative emission";

/// How rays of a kind are made.
#[derive(Clone, Copy)]
pub(super) struct Make {
    pub(super) name: &'static str,
    /// Optical depths of the whole ray.
    pub(super) depth: [f64; 2],
    pub(super) segments: [usize; 2],
    /// The step, by its range.
    pub(super) step: [f64; 2],
    /// The largest emission.
    pub(super) bright: f64,
    pub(super) what: What,
    pub(super) values: Values,
    /// How many whose steps divide them.
    pub(super) whole: usize,
    /// How many whose last step is shorter.
    pub(super) partial: usize,
}

impl Make {
    /// Its name, of rays whose last step is shorter or not.
    pub(super) fn kind(&self, is_partial: bool) -> Kind {
        let end = if is_partial && self.what != What::ShortLast {
            ", shorter last step"
        } else {
            ""
        };
        Kind::of(format!("{}{end}", self.name))
    }

    /// Whether there are segments that hold nothing.
    pub(super) fn has_gaps(&self) -> bool {
        matches!(
            self.what,
            What::Gaps | What::EmptyEnd | What::EmptyEighths | What::OneName
        )
    }
}

/// Values beside others that a kernel may take for something else than they are.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Values {
    /// Any.
    Any,
    /// All emissions are 1.
    White,
    /// The same emission in all channels.
    Grey,
    /// Emissions are integers.
    Integers,
    /// Emissions in proportion to the extinction.
    Proportional,
    /// Extinctions are the same from both ends.
    Symmetric,
    /// One sample is a hundred times as bright as others.
    Spike,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum What {
    /// Everywhere something.
    Full,
    /// Four of ten nodes absorb nothing, and three of ten shine in no channel.
    Gaps,
    /// The last segment holds nothing; or the first.
    EmptyEnd,
    /// One segment of that depth hides all behind it.
    Opaque(f64),
    /// Every eighth end of segments holds nothing: where blocks look for what is in them.
    EmptyEighths,
    /// The last step is a small part of the others.
    ShortLast,
    /// All but the same everywhere: both, up and down, or one of extinction and emission while the other is the same to the last bit.
    NearlyEven,
    /// Emissions of both signs.
    Negative,
    /// Extinctions and emissions that change slowly, as those of users do.
    Smooth,
    /// The same everywhere.
    Even,
    /// As many as these, with gaps, that have one name: each has the same values as the first, in another order but at the
    /// ends.
    OneName,
}

pub(super) const USUAL: Make = Make {
    name: "",
    depth: [0.02, 3.0],
    segments: [9, 40],
    step: [0.03, 0.9],
    bright: 1.0,
    what: What::Full,
    values: Values::Any,
    whole: 1,
    partial: 1,
};

/// The kinds: what tells rules apart that differ on few rays has one of its own.
pub(super) const MAKES: [Make; 24] = [
    Make {
        name: "smooth",
        // Blocks of any power of two end with it.
        segments: [256, 256],
        what: What::Smooth,
        whole: 0,
        partial: 1,
        ..USUAL
    },
    Make {
        name: "even",
        segments: [20, 60],
        what: What::Even,
        values: Values::White,
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "nearly even",
        segments: [50, 70],
        what: What::NearlyEven,
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "thin",
        values: Values::Spike,
        depth: [1e-3, 0.02],
        whole: 0,
        partial: 1,
        ..USUAL
    },
    Make {
        name: "nearly empty",
        values: Values::Symmetric,
        depth: [1e-9, 1e-6],
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "grey",
        values: Values::Grey,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "thick",
        values: Values::Integers,
        depth: [3.0, 14.0],
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "very thick",
        depth: [14.0, 60.0],
        whole: 0,
        partial: 1,
        ..USUAL
    },
    Make {
        name: "with gaps",
        // Something stands behind gaps behind much.
        depth: [2.0, 5.0],
        what: What::Gaps,
        whole: 0,
        partial: 1,
        ..USUAL
    },
    Make {
        name: "empty at every eighth end",
        segments: [48, 48],
        what: What::EmptyEighths,
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "empty at an end",
        // Loops unrolled by up to 16 take the last one, too.
        segments: [48, 48],
        what: What::EmptyEnd,
        ..USUAL
    },
    Make {
        name: "opaque inside",
        what: What::Opaque(36.0),
        whole: 0,
        partial: 1,
        ..USUAL
    },
    Make {
        name: "opaque as a wall inside",
        step: [1e-3, 4e-3],
        what: What::Opaque(WALL),
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "of one segment",
        segments: [1, 1],
        ..USUAL
    },
    Make {
        name: "of few segments",
        segments: [2, 4],
        whole: 0,
        partial: 1,
        ..USUAL
    },
    Make {
        name: "with next to nothing as a last step",
        what: What::ShortLast,
        whole: 0,
        partial: 1,
        ..USUAL
    },
    Make {
        name: "glaring",
        bright: 2e4,
        whole: 0,
        partial: 1,
        ..USUAL
    },
    Make {
        name: "dim",
        bright: 2e-5,
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "short",
        step: [1e-4, 4e-4],
        whole: 0,
        partial: 1,
        ..USUAL
    },
    Make {
        name: "long",
        values: Values::Proportional,
        step: [20.0, 60.0],
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: NEGATIVE,
        what: What::Negative,
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "of very many segments",
        // What is looked at from time to time only shows behind much.
        depth: [5.0, 9.0],
        segments: [4_100, 4_300],
        whole: 1,
        partial: 0,
        ..USUAL
    },
    Make {
        name: "of many segments",
        // After a longer ray: what is left of that one shows.
        segments: [65, 119],
        whole: 0,
        partial: 1,
        ..USUAL
    },
    // Different rays of one name and one number of segments: what is remembered by these shows.
    Make {
        name: "of one name",
        segments: [24, 24],
        step: [0.25, 0.25],
        what: What::OneName,
        whole: 3,
        partial: 0,
        ..USUAL
    },
];

/// The kinds for which there are rays where there are few.
pub(super) const CORE: [&str; 7] = [
    "smooth",
    "of very many segments",
    "thick",
    "empty at an end",
    "of one segment",
    "with next to nothing as a last step",
    "glaring",
];
