//! Choices against all there are.

use volver::inside::study::plan::{Candidate, Chosen, Forest, Node, choose};
use volver::study::plan::Model;

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
                combinations.push((a.cost + b.cost + last.cost, a.error + b.error + last.error));
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
