//! The medium over a panel as Taylor series, enclosed in intervals.

use super::layout::Stretch;
use crate::real::{Format, Native};
use crate::symbolic::{Program, Range, Taylor, taylor};

/// C and τ of every channel over a panel.
pub(super) fn series(program: &Program, panel: &Stretch, order: u32) -> Vec<(Taylor, Taylor)> {
    let range = Range::new(
        Range::around(&panel.from).low,
        Range::around(&panel.to).high,
    );
    let variable = Taylor::variable(range, half_width(panel).next_up());
    let outputs = taylor(program, &variable, order as usize);
    let mut outputs = outputs.into_iter();
    let mut all = Vec::new();
    while let (Some(emission), Some(extinction)) = (outputs.next(), outputs.next()) {
        all.push((emission, extinction));
    }
    all
}

/// Half its length.
pub(super) fn half_width(panel: &Stretch) -> f64 {
    Native::<f64>::new().ratio(&panel.length()) / 2.0
}
