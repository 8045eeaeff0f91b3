//! The case of one ray as a file: what a pixel is, to be proved, enclosed and given to kernels.

use super::field::{Along, Shape};
use super::{Chord, VolumeCase};
use crate::volume::Ray;
use std::fmt::Write as _;

impl VolumeCase {
    /// The text of a case file of a ray's part in the box, from λ = 0 on; a channel each where there are several.
    ///
    /// Numbers are the shortest decimals that are read back as they are.
    #[must_use]
    pub fn ray_case(&self, name: &str, ray: &Ray, chord: Chord) -> String {
        let entered = Ray {
            origin: ray.at(chord.from),
            direction: ray.direction,
        };
        let mut text = String::new();
        let length = number(chord.to - chord.from);
        // Writing to a text cannot fail.
        let _ = writeln!(text, "name = \"{name}\"");
        let _ = writeln!(text, "title = \"A ray through {}\"", self.name);
        let _ = writeln!(text, "length = \"{length}\"");
        let _ = writeln!(text, "field = \"{}\"", self.field_text(&entered));
        let extinction = self.piecewise(|point| point.extinction);
        let _ = writeln!(text, "extinction = \"{extinction}\"");
        let emission = |channel: usize| {
            self.piecewise(|point| point.emission.get(channel).copied().unwrap_or(0.0))
        };
        if let [_] = self.transfer.channels.as_slice() {
            let _ = writeln!(text, "emission = \"{}\"", emission(0));
        } else {
            for (channel, name) in self.transfer.channels.iter().enumerate() {
                let _ = writeln!(text, "[channels.{name}]");
                let _ = writeln!(text, "emission = \"{}\"", emission(channel));
            }
        }
        text
    }

    fn field_text(&self, ray: &Ray) -> String {
        let argument = match self.field.along(ray) {
            Along::Linear { at, slope } => format!("({} + {}*lambda)", number(at), number(slope)),
            Along::Squared {
                square,
                nearest,
                apart,
            } => format!(
                "({}*(lambda - {})^2 + {})",
                number(square),
                number(nearest),
                number(apart)
            ),
        };
        let shape = match &self.field.shape {
            Shape::Ramp { .. } => argument,
            Shape::Radial { .. } => format!("sqrt{argument}"),
            Shape::Wave { .. } => format!("sin{argument}"),
            Shape::Blob { width, .. } => {
                format!("exp(-{argument}/{}^2)", number(*width))
            }
            Shape::Kink { .. } => format!("abs{argument}"),
            Shape::Jump { radius, .. } => {
                format!("piecewise({argument} < {}^2, 1, 0)", number(*radius))
            }
        };
        format!(
            "{} + {}*{shape}",
            number(self.field.offset),
            number(self.field.height)
        )
    }

    /// A value by control points, as text of s: linear between, the same beyond the outermost.
    fn piecewise(&self, of: impl Fn(&crate::volume::ControlPoint) -> f64) -> String {
        let points = &self.transfer.points;
        let Some(last) = points.last() else {
            return "0".into();
        };
        let mut text = number(of(last));
        for pair in points.windows(2).rev() {
            let [from, to] = pair else { continue };
            if to.s <= from.s {
                text = format!(
                    "piecewise(s < {}, {}, {text})",
                    number(to.s),
                    number(of(from))
                );
                continue;
            }
            let part = format!(
                "(s - {})/({} - {})",
                number(from.s),
                number(to.s),
                number(from.s)
            );
            let line = format!(
                "{} + ({} - {})*{part}",
                number(of(from)),
                number(of(to)),
                number(of(from))
            );
            text = format!("piecewise(s < {}, {line}, {text})", number(to.s));
        }
        match points.first() {
            Some(first) if points.len() > 1 => {
                format!(
                    "piecewise(s < {}, {}, {text})",
                    number(first.s),
                    number(of(first))
                )
            }
            _ => text,
        }
    }
}

/// A number as an expression has it: without an exponent, in brackets where it is negative.
fn number(x: f64) -> String {
    if x < 0.0 {
        format!("({x})")
    } else {
        format!("{x}")
    }
}
