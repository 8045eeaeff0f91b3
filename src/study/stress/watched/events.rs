//! What can befall a number.

use std::ops::{BitOr, BitOrAssign};

/// A set of events.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::study::stress) struct Events(u8);

impl Events {
    /// Nothing.
    pub(in crate::study::stress) const NONE: Events = Events(0);
    /// Finite operands gave a result beyond the format's range.
    pub(in crate::study::stress) const OVERFLOW: Events = Events(1);
    /// A product, quotient or exponential became 0 or a number with fewer bits than others.
    pub(in crate::study::stress) const UNDERFLOW: Events = Events(1 << 1);
    /// The same of a constant.
    pub(in crate::study::stress) const INPUT_UNDERFLOW: Events = Events(1 << 2);
    /// A result at the end of a fixed-point format.
    pub(in crate::study::stress) const SATURATED: Events = Events(1 << 3);
    /// 0/0.
    pub(in crate::study::stress) const INVALID: Events = Events(1 << 4);
    /// x/0.
    pub(in crate::study::stress) const INFINITE: Events = Events(1 << 5);
    /// A difference became 0 because an operand had lost what made the difference.
    pub(in crate::study::stress) const VANISHED: Events = Events(1 << 6);

    /// Whether one of `others` is among them.
    pub(in crate::study::stress) fn has(self, others: Events) -> bool {
        self.0 & others.0 != 0
    }
}

impl BitOr for Events {
    type Output = Events;
    fn bitor(self, other: Events) -> Events {
        Events(self.0 | other.0)
    }
}

impl BitOrAssign for Events {
    #[inline]
    fn bitor_assign(&mut self, other: Events) {
        self.0 |= other.0;
    }
}
