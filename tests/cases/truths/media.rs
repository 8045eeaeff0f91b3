//! Media in layers with their depth and radiance, right or with another value at a point.

use super::{Claim, Draw, Truth};

/// A function of the ray in two layers, with another value at a single point or without.
struct Function {
    symbol: &'static str,
    front: String,
    back: String,
    /// Where, and what is there instead.
    other: Option<(String, String)>,
}

impl Function {
    /// At the wall the layer behind it holds, or the one in front.
    fn text(&self, wall: &str, draw: &mut Draw) -> String {
        let Function {
            symbol: x,
            front,
            back,
            other,
        } = self;
        let relation = draw.of(&["<", "<="]);
        let layers = format!("piecewise({x} {relation} {wall}, {front}, {back})");
        match other {
            None => layers,
            Some((at, value)) => match draw.below(3) {
                0 => format!("piecewise(abs({x} - {at}) <= 0, {value}, {layers})"),
                1 => format!("piecewise(({x} - {at})^2 <= 0, {value}, {layers})"),
                _ => format!("piecewise({x} < {at}, {layers}, {x} <= {at}, {value}, {layers})"),
            },
        }
    }
}

/// A claim about a medium of two layers with constant extinction, or one that grows with λ, and emission.
pub(super) fn draw(draw: &mut Draw) -> Claim {
    let (length, wall) = ("2", *draw.of(&["1", "1/2", "4/3", "sqrt(2)"]));
    let (a, b) = (1 + draw.below(3), 1 + draw.below(3));
    let c = *draw.of(&["1", "2", "1/2"]);
    let grows = draw.below(3) == 0;
    // τ of the layers, and t of the layer behind from the wall on.
    let extinction = if grows {
        [format!("2*{a}*s"), format!("{b}")]
    } else {
        [format!("{a}"), format!("{b}")]
    };
    let depth = if grows {
        [
            format!("{a}*lambda^2"),
            format!("({a}*({wall})^2 + {b}*(lambda - {wall}))"),
        ]
    } else {
        [
            format!("{a}*lambda"),
            format!("({a}*{wall} + {b}*(lambda - {wall}))"),
        ]
    };
    let radiance = depth.each_ref().map(|t| format!("{c}*(1 - exp(-{t}))"));
    let function = |symbol, [front, back]: [String; 2]| Function {
        symbol,
        front,
        back,
        other: None,
    };
    let mut extinction = function("s", extinction);
    let mut depth = function("lambda", depth);
    let mut radiance = function("lambda", radiance);
    let mut truth = Truth::True;
    // In front of every wall.
    let inside = format!("{}/2", draw.part());
    let places = ["0", "2", wall, &inside];
    let place = (*draw.of(&places)).to_string();
    let offset = draw.offset();
    match draw.below(6) {
        0 | 1 => {}
        2 | 3 => {
            let changed = if draw.below(2) == 0 {
                &mut depth
            } else {
                &mut radiance
            };
            // The value of the layer that the place is in, and some more.
            let is_behind = place == "2" || place == wall;
            let layer = if is_behind {
                &changed.back
            } else {
                &changed.front
            };
            let value = format!("({layer} + {offset})");
            changed.other = Some((place, value));
            truth = Truth::False;
        }
        // Beyond the ray nothing matters.
        4 => {
            let beyond = (*draw.of(&["-1", "3", "2.0001"])).to_string();
            depth.other = Some((beyond, "7".into()));
        }
        // Where t has a derivative τ is that; at a kink of t it may be anything.
        _ => {
            extinction.other = Some((wall.into(), "9".into()));
            let is_smooth = match (grows, wall) {
                (false, _) | (true, "1/2") => a == b,
                (true, "1") => 2 * a == b,
                (true, "4/3") => 8 * a == 3 * b,
                (true, _) => false,
            };
            if is_smooth {
                truth = Truth::False;
            }
        }
    }
    let (tau, t, i) = (
        extinction.text(wall, draw),
        depth.text(wall, draw),
        radiance.text(wall, draw),
    );
    Claim {
        truth,
        of_inverse: false,
        text: format!(
            "name = \"medium\"\nlength = \"{length}\"\nextinction = \"{tau}\"\nemission = \"{c}\"\n\
             depth = \"{t}\"\nradiance = \"{i}\"\n"
        ),
    }
}
