//! A part of a stretch of the ray.

use rug::Float;

/// The part [left, left + width] of a stretch in its v.
#[derive(Clone, Debug)]
pub(super) struct Panel {
    /// Which stretch.
    pub(super) stretch: usize,
    pub(super) left: Float,
    /// The width is 2^(−halvings).
    pub(super) halvings: u32,
    /// Whether it begins where the stretch does.
    pub(super) is_first: bool,
    /// Whether it ends where the stretch does.
    pub(super) is_last: bool,
}

impl Panel {
    /// The whole stretch.
    pub(super) fn whole(stretch: usize, bits: u32) -> Panel {
        Panel {
            stretch,
            left: Float::new(bits),
            halvings: 0,
            is_first: true,
            is_last: true,
        }
    }

    pub(super) fn width(&self) -> Float {
        Float::with_val(self.left.prec(), 1) >> self.halvings
    }

    /// The left half and the right one.
    pub(super) fn halves(&self) -> [Panel; 2] {
        let left = Panel {
            halvings: self.halvings + 1,
            is_last: false,
            ..self.clone()
        };
        let right = Panel {
            left: Float::with_val(self.left.prec(), &self.left + &left.width()),
            is_first: false,
            is_last: self.is_last,
            ..left.clone()
        };
        [left, right]
    }
}
