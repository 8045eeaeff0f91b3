//! The cheapest models whose errors add up to little enough.
//!
//! For a price μ of error each stretch has a cheapest choice by itself: of its candidates that with the least
//! cost + μ error, or the choices of its two parts. The least μ at which the errors add up to little enough is
//! found by bisection (Everett, *Generalized Lagrange multiplier method*, 1963); what is left of the tolerance then is
//! spent on stretches whose choice at a lower price still fits.

use super::candidates::Forest;
use std::ops::Range;

/// Steps of the bisection of log μ.
const STEPS: u32 = 60;

/// A candidate chosen for some panels.
#[derive(Clone, Debug, PartialEq)]
pub struct Chosen {
    /// The panels.
    pub panels: Range<usize>,
    /// Which node of the forest.
    pub node: usize,
    /// Which of its candidates.
    pub candidate: usize,
}

/// What is chosen for a tree.
#[derive(Clone, Debug, Default)]
struct Choice {
    cost: f64,
    error: f64,
    chosen: Vec<Chosen>,
}

/// The choice for every tree of the forest, from front to back; `None` where no errors are little enough.
#[must_use]
pub fn choose(forest: &Forest, allowed: f64) -> Option<Vec<Chosen>> {
    let at = |price: f64| -> Vec<Choice> { cheapest(forest, price) };
    let total = |choices: &[Choice]| choices.iter().map(|choice| choice.error).sum::<f64>();
    let free = at(0.0);
    if total(&free) <= allowed {
        return Some(all(free));
    }
    let (mut low, mut high) = ((1e-6 / allowed).ln(), (1e6 / allowed).ln());
    let mut fitting = at(high.exp());
    while total(&fitting) > allowed {
        // A thousand evaluations for a millionth of the tolerance, and more.
        high += 10.0;
        if high > 700.0 {
            return None;
        }
        fitting = at(high.exp());
    }
    for _ in 0..STEPS {
        let middle = f64::midpoint(low, high);
        let choices = at(middle.exp());
        if total(&choices) <= allowed {
            high = middle;
            fitting = choices;
        } else {
            low = middle;
        }
        if high - low < 1e-3 {
            break;
        }
    }
    spend(forest, &mut fitting, allowed, low);
    Some(all(fitting))
}

fn all(choices: Vec<Choice>) -> Vec<Chosen> {
    choices
        .into_iter()
        .flat_map(|choice| choice.chosen)
        .collect()
}

/// What the choices leave of what is allowed, spent on the best bargains at lower prices.
fn spend(forest: &Forest, fitting: &mut [Choice], allowed: f64, price: f64) {
    for lower in [0.0, 1.0, 2.0, 4.0, 8.0] {
        let bargains = cheapest(forest, (price - lower).exp());
        let mut order: Vec<usize> = (0..fitting.len()).collect();
        let saved = |i: usize, fitting: &[Choice]| {
            let (now, then) = (&fitting[i], &bargains[i]);
            (now.cost - then.cost) / (then.error - now.error).max(f64::MIN_POSITIVE)
        };
        order.sort_by(|&a, &b| saved(b, fitting).total_cmp(&saved(a, fitting)));
        for i in order {
            let used: f64 = fitting.iter().map(|choice| choice.error).sum();
            let then = &bargains[i];
            let is_cheaper = then.cost < fitting[i].cost;
            if is_cheaper && used - fitting[i].error + then.error <= allowed {
                fitting[i] = then.clone();
            }
        }
    }
}

/// The cheapest choice for every tree at a price.
fn cheapest(forest: &Forest, price: f64) -> Vec<Choice> {
    // Parts stand before what is made of them.
    let mut best: Vec<(f64, Option<usize>)> = Vec::with_capacity(forest.nodes.len());
    for node in &forest.nodes {
        let priced = node
            .candidates
            .iter()
            .enumerate()
            .map(|(i, candidate)| (candidate.cost + times(price, candidate.error), Some(i)));
        let whole = priced.min_by(|a, b| a.0.total_cmp(&b.0));
        let whole = whole.unwrap_or((f64::INFINITY, None));
        let parts = node
            .halves
            .and_then(|(first, second)| Some(best.get(first)?.0 + best.get(second)?.0));
        best.push(match parts {
            Some(parts) if parts < whole.0 => (parts, None),
            _ => whole,
        });
    }
    let roots = forest.roots.iter();
    roots
        .map(|&root| {
            let mut choice = Choice::default();
            collect(forest, &best, root, &mut choice);
            choice
        })
        .collect()
}

/// An infinite error is none that a price of 0 would buy.
fn times(price: f64, error: f64) -> f64 {
    if error.is_infinite() {
        error
    } else {
        price * error
    }
}

fn collect(forest: &Forest, best: &[(f64, Option<usize>)], node: usize, choice: &mut Choice) {
    let mut open = vec![node];
    while let Some(index) = open.pop() {
        let Some(node) = forest.nodes.get(index) else {
            continue;
        };
        match (best.get(index).and_then(|best| best.1), node.halves) {
            (Some(i), _) => {
                let candidate = &node.candidates[i];
                choice.cost += candidate.cost;
                choice.error += candidate.error;
                choice.chosen.push(Chosen {
                    panels: node.panels.clone(),
                    node: index,
                    candidate: i,
                });
            }
            (None, Some((first, second))) => {
                open.push(second);
                open.push(first);
            }
            (None, None) => choice.error = f64::INFINITY,
        }
    }
}
