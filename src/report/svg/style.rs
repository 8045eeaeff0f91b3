//! Colours and strokes that the parts of a figure share.

use super::canvas::{Letters, Stroke};
use plotters::prelude::RGBColor;
use plotters::style::text_anchor::HPos;

/// Okabe and Ito's palette (2008), which colour-blind people can tell apart; its yellow is too
/// light for lines on white.
pub(super) const PALETTE: [RGBColor; 7] = [
    RGBColor(0x00, 0x72, 0xB2),
    RGBColor(0xE6, 0x9F, 0x00),
    RGBColor(0x00, 0x9E, 0x73),
    RGBColor(0xCC, 0x79, 0xA7),
    RGBColor(0xD5, 0x5E, 0x00),
    RGBColor(0x56, 0xB4, 0xE9),
    RGBColor(0x00, 0x00, 0x00),
];

pub(in crate::report) const WHITE: RGBColor = RGBColor(0xFF, 0xFF, 0xFF);
pub(in crate::report) const TEXT: RGBColor = RGBColor(0x22, 0x22, 0x22);
pub(in crate::report) const MUTED: RGBColor = RGBColor(0x77, 0x77, 0x77);
pub(in crate::report) const TICK_SIZE: f64 = 10.5;

pub(in crate::report) const GRID: Stroke = Stroke {
    color: RGBColor(0xE4, 0xE4, 0xE4),
    width: 0.7,
};
pub(in crate::report) const AXIS: Stroke = Stroke {
    color: RGBColor(0x55, 0x55, 0x55),
    width: 1.0,
};
pub(in crate::report) const FLOOR: Stroke = Stroke {
    color: MUTED,
    width: 1.3,
};
pub(super) const MODEL: Stroke = Stroke {
    color: MUTED,
    width: 0.7,
};
/// Dash and gap.
pub(super) const FLOOR_DOTS: (f64, f64) = (1.3, 3.0);
pub(super) const BIAS_DASHES: (f64, f64) = (6.0, 4.0);
pub(super) const GUIDE_DASHES: (f64, f64) = (4.0, 3.0);

/// The colour of a column; they repeat after seven.
pub(in crate::report) fn color(index: usize) -> RGBColor {
    PALETTE[index % PALETTE.len()]
}

/// Level text in the colour of text.
pub(in crate::report) fn letters(size: f64, bold: bool, at: HPos) -> Letters {
    Letters {
        color: TEXT,
        size,
        bold,
        at,
        upwards: false,
    }
}
