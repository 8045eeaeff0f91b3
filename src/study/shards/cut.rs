//! Units cut into shards.

/// Where each of `shards` shards ends, so that the dearest costs as little as it can where each takes units that follow one
/// another. There is a unit in each as long as there are as many units.
///
/// What follows one another shares work (the oracle of a case), so that at most one case a cut is begun anew.
#[must_use]
pub fn cut(costs: &[f64], shards: usize) -> Vec<usize> {
    let largest = costs.iter().copied().fold(0.0, f64::max);
    let (mut low, mut high) = (largest, costs.iter().sum::<f64>().max(largest));
    // Halved until binary64 has no number between.
    loop {
        let middle = low.midpoint(high);
        if middle <= low || middle >= high {
            break;
        }
        if filled(costs, middle) <= shards {
            high = middle;
        } else {
            low = middle;
        }
    }
    ends(costs, shards, high)
}

/// How many shards of at most that cost there are.
fn filled(costs: &[f64], most: f64) -> usize {
    let mut shards = 1;
    let mut sum = 0.0;
    for cost in costs {
        if sum + cost > most {
            shards += 1;
            sum = 0.0;
        }
        sum += cost;
    }
    shards
}

/// The ends of shards of at most that cost; the last ones are begun early where units would not go round.
fn ends(costs: &[f64], shards: usize, most: f64) -> Vec<usize> {
    let mut ends = Vec::with_capacity(shards);
    let mut sum = 0.0;
    for (unit, cost) in costs.iter().enumerate() {
        let begun = ends.last().copied().unwrap_or(0) < unit;
        let left = shards.saturating_sub(ends.len() + 1);
        let is_needed = costs.len() - unit <= left;
        if begun && left > 0 && (sum + cost > most || is_needed) {
            ends.push(unit);
            sum = 0.0;
        }
        sum += cost;
    }
    ends.resize(shards, costs.len());
    ends
}
