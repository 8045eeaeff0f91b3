//! Colours of a map: from dark to light without a change that a colour-blind reader cannot see.

use plotters::prelude::RGBColor;

/// Cividis (Nuñez, Anderton, Renslow 2018) at equal distances: blue to yellow, its lightness even.
const CIVIDIS: [(u8, u8, u8); 10] = [
    (0x00, 0x22, 0x4E),
    (0x12, 0x35, 0x70),
    (0x3B, 0x49, 0x6C),
    (0x57, 0x5D, 0x6D),
    (0x70, 0x71, 0x73),
    (0x8A, 0x86, 0x78),
    (0xA5, 0x9C, 0x74),
    (0xC3, 0xB3, 0x69),
    (0xE1, 0xCC, 0x55),
    (0xFE, 0xE8, 0x38),
];

/// A cell without a number.
pub(super) const MISSING: RGBColor = RGBColor(0xEE, 0xEE, 0xEE);

/// The colour of a share from 0 to 1.
pub(super) fn of_share(share: f64) -> RGBColor {
    let last = CIVIDIS.len() - 1;
    let place = share.clamp(0.0, 1.0) * last as f64;
    let below = (0..last).rev().find(|i| *i as f64 <= place).unwrap_or(0);
    let (a, b) = (CIVIDIS[below], CIVIDIS[below + 1]);
    let between = place - below as f64;
    let mixed = |a: u8, b: u8| channel(f64::from(a) + between * (f64::from(b) - f64::from(a)));
    RGBColor(mixed(a.0, b.0), mixed(a.1, b.1), mixed(a.2, b.2))
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between two bytes"
)]
fn channel(value: f64) -> u8 {
    value.round() as u8
}

/// Whether white letters read better on it than dark ones.
pub(super) fn is_dark(RGBColor(r, g, b): RGBColor) -> bool {
    0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b) < 128.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_grow_lighter_with_the_share() {
        let light = |share| {
            let RGBColor(r, g, b) = of_share(share);
            0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
        };
        let all: Vec<f64> = (0..=64).map(|i| light(f64::from(i) / 64.0)).collect();
        assert!(all.windows(2).all(|pair| pair[0] < pair[1]), "{all:?}");
        assert_eq!(of_share(-1.0), RGBColor(0x00, 0x22, 0x4E));
        assert_eq!(of_share(2.0), RGBColor(0xFE, 0xE8, 0x38));
        assert!(is_dark(of_share(0.0)) && !is_dark(of_share(1.0)));
    }
}
