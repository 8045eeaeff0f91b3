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
pub(super) struct Chosen {
    pub(super) panels: Range<usize>,
    /// Which node of the forest, and which of its candidates.
    pub(super) node: usize,
    pub(super) candidate: usize,
}

/// What is chosen for a tree.
#[derive(Clone, Debug, Default)]
struct Choice {
    cost: f64,
    error: f64,
    chosen: Vec<Chosen>,
}

/// The choice for every tree of the forest, from front to back; `None` where no errors are little enough.
pub(super) fn choose(forest: &Forest, allowed: f64) -> Option<Vec<Chosen>> {
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

#[cfg(test)]
mod tests {
    use super::super::Model;
    use super::super::candidates::{Candidate, Node};
    use super::*;

    fn candidate(cost: f64, error: f64) -> Candidate {
        Candidate {
            model: Model::Nothing,
            cost,
            error,
        }
    }

    /// Two leaves under a root that is dearer than both for the same error, and a tree of one node.
    fn forest() -> Forest {
        let ladder = || {
            vec![
                candidate(0.0, 8.0),
                candidate(1.0, 2.0),
                candidate(3.0, 0.0),
            ]
        };
        let node = |panels, candidates, halves| Node {
            panels,
            candidates,
            halves,
        };
        Forest {
            nodes: vec![
                node(0..1, ladder(), None),
                node(1..2, ladder(), None),
                node(
                    0..2,
                    vec![candidate(0.0, 20.0), candidate(9.0, 0.0)],
                    Some((0, 1)),
                ),
                node(2..3, ladder(), None),
            ],
            roots: vec![2, 3],
        }
    }

    fn cost_and_error(forest: &Forest, chosen: &[Chosen]) -> (f64, f64) {
        let all = chosen
            .iter()
            .map(|c| &forest.nodes[c.node].candidates[c.candidate]);
        all.fold((0.0, 0.0), |(cost, error), c| {
            (cost + c.cost, error + c.error)
        })
    }

    #[test]
    fn the_choice_is_as_cheap_as_an_exhaustive_search_says() {
        let forest = forest();
        // Every combination: the first tree as a whole or in parts, and the second.
        let whole = &forest.nodes[2].candidates;
        let ladder = &forest.nodes[0].candidates;
        let mut combinations = Vec::new();
        for last in ladder {
            for first in whole {
                combinations.push((first.cost + last.cost, first.error + last.error));
            }
            for a in ladder {
                for b in ladder {
                    combinations
                        .push((a.cost + b.cost + last.cost, a.error + b.error + last.error));
                }
            }
        }
        for allowed in [
            0.0_f64, 1.0, 2.0, 3.9, 4.0, 6.0, 8.5, 10.0, 18.0, 24.0, 30.0,
        ] {
            let chosen = choose(&forest, allowed.max(1e-9)).unwrap();
            let (cost, error) = cost_and_error(&forest, &chosen);
            assert!(error <= allowed.max(1e-9), "{allowed}: {error}");
            let fitting = combinations.iter().filter(|(_, error)| *error <= allowed);
            let best = fitting.map(|(cost, _)| *cost).fold(f64::INFINITY, f64::min);
            // The Lagrangian leaves a gap of at most one step of one stretch.
            assert!(
                cost <= best + 2.0,
                "{allowed}: {cost}, and {best} is possible"
            );
            let mut end = 0;
            for part in &chosen {
                assert_eq!(part.panels.start, end);
                end = part.panels.end;
            }
            assert_eq!(end, 3);
        }
    }

    #[test]
    fn without_a_good_candidate_there_is_no_choice() {
        let mut forest = forest();
        forest.nodes[3].candidates = vec![candidate(0.0, f64::INFINITY)];
        assert_eq!(choose(&forest, 1.0), None);
    }
}
