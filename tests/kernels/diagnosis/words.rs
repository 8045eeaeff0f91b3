//! Recipes in words.

use volver::diagnosis::{Accumulator, End, Ends, OpacityModel, Places, Recipe};

#[test]
fn recipes_are_said_in_words() {
    let recipe = Recipe {
        ends: Ends {
            last: End::Dropped,
            ..Ends::default()
        },
        ..Recipe::default()
    };
    assert_eq!(
        recipe.to_string(),
        "front samples, 1 - exp(-τd), last sample missing"
    );
    assert_eq!(recipe.defects(), 1);
    let recipe = Recipe {
        places: Places::Middle,
        opacity: OpacityModel::Linear,
        stop: Some(1.0 / 255.0),
        accumulator: Accumulator::Binary32,
        ..Recipe::default()
    };
    assert_eq!(
        recipe.to_string(),
        "middle samples, opacity τd, ray ended at a transmittance of 1/255, in binary32"
    );
    let parts = [0.05, 1e-4, 1.0, 1.25, 0.003_921_568_6, 0.012_371_4];
    let shown = parts.map(|part| {
        let stopped = Recipe {
            stop: Some(part),
            ..Recipe::default()
        };
        let words = stopped.to_string();
        let (_, shown) = words.split_once(" at a transmittance of ").unwrap();
        shown.to_string()
    });
    assert_eq!(shown, ["0.05", "1e-4", "1", "1.25", "1/255", "0.012371"]);
}
