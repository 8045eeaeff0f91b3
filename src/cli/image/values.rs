//! Values of options.

/// The most cells along an axis, steps along a diagonal, and pixels along a side.
const MOST: usize = 4096;

pub(super) fn count(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(count) if (1..=MOST).contains(&count) => Ok(count),
        _ => Err(format!("allowed: integers from 1 to {MOST}")),
    }
}

pub(super) fn order(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(order) if (0.25..=16.0).contains(&order) => Ok(order),
        _ => Err("allowed: numbers from 0.25 to 16".into()),
    }
}

pub(super) fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds > 0.0 && seconds <= 1e6 => Ok(seconds),
        _ => Err("allowed: numbers above 0, up to 1e6".into()),
    }
}

fn pair(text: &str, between: char) -> Option<[usize; 2]> {
    let (one, other) = text.split_once(between)?;
    Some([one.trim().parse().ok()?, other.trim().parse().ok()?])
}

pub(super) fn aspect(text: &str) -> Result<[usize; 2], String> {
    let is_good = |sides: &[usize; 2]| sides.iter().all(|side| (1..=64).contains(side));
    pair(text, ':')
        .filter(is_good)
        .ok_or_else(|| "allowed: two integers from 1 to 64, such as 4:3".into())
}

pub(super) fn pixel(text: &str) -> Result<[usize; 2], String> {
    pair(text, ',').ok_or_else(|| "allowed: two integers from 0 on, such as 12,7".into())
}
