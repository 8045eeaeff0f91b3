//! Two powers in one ladder: e = a·d^P + b·d^Q with P > Q, where one order gives way to the other.

/// Fewest levels that show it.
const LEVELS: usize = 6;
/// Pairwise orders that agree within this show one order.
const SPREAD: f64 = 0.3;
/// The largest relative error of the two powers at a level.
const RESIDUAL: f64 = 0.01;
/// Orders are looked for up to this: whole ones first, then halves.
const HIGHEST: u32 = 8;

/// One order gives way to another, lower one as the step shrinks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Changeover {
    pub(super) from: f64,
    pub(super) to: f64,
    /// The step where both terms are as large, between the coarsest and the finest.
    pub(super) step: f64,
}

/// A level: log₂ of step and |error|, and whether the error lies below 0.
pub(super) type Level = (f64, f64, bool);

/// The two orders that explain all levels, coarse to fine.
pub(super) fn changeover(levels: &[Level]) -> Option<Changeover> {
    let ([coarsest, .., finest], LEVELS..) = (levels, levels.len()) else {
        return None;
    };
    let orders = levels
        .windows(2)
        .map(|pair| (pair[0].1 - pair[1].1) / (pair[0].0 - pair[1].0));
    let (low, high) = orders.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), order| {
        (low.min(order), high.max(order))
    });
    if !low.is_finite() || high - low < SPREAD {
        return None;
    }
    let whole: Vec<f64> = (1..=HIGHEST).map(f64::from).collect();
    let halves: Vec<f64> = (1..=2 * HIGHEST).map(|k| f64::from(k) / 2.0).collect();
    [whole, halves].iter().find_map(|orders| {
        let pairs = orders
            .iter()
            .flat_map(|to| orders.iter().map(move |from| (*from, *to)))
            .filter(|(from, to)| from > to);
        let fits = pairs.filter_map(|(from, to)| two_powers(levels, from, to));
        let best = fits.min_by(|a, b| a.residual.total_cmp(&b.residual))?;
        let inside = finest.0 < best.log2_step && best.log2_step < coarsest.0;
        (inside && best.residual <= RESIDUAL).then_some(Changeover {
            from: best.from,
            to: best.to,
            step: best.log2_step.exp2(),
        })
    })
}

struct TwoPowers {
    from: f64,
    to: f64,
    log2_step: f64,
    residual: f64,
}

/// Least squares of (a·d^P + b·d^Q)/e − 1; `None` where the two powers cannot be told apart.
fn two_powers(levels: &[Level], from: f64, to: f64) -> Option<TwoPowers> {
    let finest = levels.last()?;
    // In units of the error at the finest level, so that any magnitude will do.
    let unit = |order: f64| order * finest.0 - finest.1;
    let column = |order: f64| -> Vec<f64> {
        let over_error = |(x, y, negative): &Level| {
            let size = (order * x - y - unit(order)).exp2();
            if *negative { -size } else { size }
        };
        levels.iter().map(over_error).collect()
    };
    let (u, v) = (column(from), column(to));
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (uu, uv, vv) = (dot(&u, &u), dot(&u, &v), dot(&v, &v));
    let determinant = uu * vv - uv * uv;
    let (su, sv) = (u.iter().sum::<f64>(), v.iter().sum::<f64>());
    let (a, b) = (
        (su * vv - sv * uv) / determinant,
        (sv * uu - su * uv) / determinant,
    );
    let misses = u.iter().zip(&v).map(|(u, v)| (a * u + b * v - 1.0).abs());
    let residual = misses.fold(0.0, f64::max);
    let log2 = |coefficient: f64, order: f64| coefficient.abs().log2() - unit(order);
    let log2_step = (log2(b, to) - log2(a, from)) / (from - to);
    (residual.is_finite() && log2_step.is_finite()).then_some(TwoPowers {
        from,
        to,
        log2_step,
        residual,
    })
}
