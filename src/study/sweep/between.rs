//! Levels between the levels of a ladder, for models alone.

/// Beyond this many segments nothing is added.
const FINEST: u64 = 4096;
/// Suits every rule but those for longer groups of segments.
const MULTIPLE: f64 = 4.0;

/// Two numbers of segments between each level and the next, evenly by their logarithm, none of them a power of
/// two: there some roundings are special, d being a number of every format, and so are the places of some
/// breaks in their segments. What a model says of all n has to come of others too.
#[must_use]
pub fn between(levels: &[u64]) -> Vec<u64> {
    let mut all: Vec<u64> = Vec::new();
    for pair in levels.windows(2).filter(|pair| pair[1] <= FINEST) {
        let (low, ratio) = (pair[0] as f64, pair[1] as f64 / pair[0] as f64);
        for share in [1.0 / 3.0, 2.0 / 3.0] {
            let wanted = (low * ratio.powf(share) / MULTIPLE).round() * MULTIPLE;
            // A whole number up to 4096.
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let n = wanted as u64;
            let is_new = n > pair[0] && n < pair[1] && all.last() != Some(&n);
            if is_new && !n.is_power_of_two() {
                all.push(n);
            }
        }
    }
    all
}
