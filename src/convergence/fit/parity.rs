//! Two sequences in one ladder: levels of odd n follow another constant than those of even n.

/// Fewest levels of either parity.
const LEVELS: usize = 3;
/// The two constants differ by this factor at least.
const FACTOR: f64 = 1.1;
/// Two constants have to leave this share of what one leaves, or less.
const EXPLAINED: f64 = 1.0 / 3.0;

/// By which factor the errors of odd n exceed those of even n, at one order of both; `None` for one sequence.
///
/// Of (n, log₂ d, log₂|e|).
pub(super) fn odd_over_even(levels: &[(u64, f64, f64)]) -> Option<f64> {
    let (odd, even): (Vec<_>, Vec<_>) = levels.iter().partition(|(n, ..)| n % 2 == 1);
    if odd.len() < LEVELS || even.len() < LEVELS {
        return None;
    }
    let mean = |group: &[&(u64, f64, f64)]| {
        let count = group.len() as f64;
        let sum = |part: fn(&(u64, f64, f64)) -> f64| group.iter().map(|l| part(l)).sum::<f64>();
        (sum(|l| l.1) / count, sum(|l| l.2) / count)
    };
    let all: Vec<&(u64, f64, f64)> = levels.iter().collect();
    // Σ of squares about the means of the groups, and the order that explains most of them.
    let squares = |groups: &[&[&(u64, f64, f64)]]| {
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for group in groups {
            let (x, y) = mean(group);
            for level in *group {
                xx += (level.1 - x).powi(2);
                xy += (level.1 - x) * (level.2 - y);
                yy += (level.2 - y).powi(2);
            }
        }
        (xy / xx, yy - xy * xy / xx)
    };
    let (_, one) = squares(&[&all]);
    let (order, two) = squares(&[&odd, &even]);
    let ((x_odd, y_odd), (x_even, y_even)) = (mean(&odd), mean(&even));
    let factor = (y_odd - y_even - order * (x_odd - x_even)).exp2();
    let apart = factor.max(1.0 / factor) >= FACTOR;
    // Squares: a third of the deviation is a ninth of them.
    (apart && two <= EXPLAINED * EXPLAINED * one).then_some(factor)
}
