//! Transfer functions by control points.

/// τ and C at a value of the field.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlPoint {
    /// s.
    pub s: f64,
    /// τ(s) ≥ 0, per unit of length.
    pub extinction: f64,
    /// C(s), by channel.
    pub emission: Vec<f64>,
}

/// τ and C, linear between control points and held beyond the outermost.
///
/// Two points of the same s are a jump: the first holds below s, the second from s on.
#[derive(Clone, Debug, PartialEq)]
pub struct TransferFunction {
    /// The names of the channels.
    pub channels: Vec<String>,
    /// By rising s; at least one.
    pub points: Vec<ControlPoint>,
}

impl TransferFunction {
    /// τ(s), and into `emission` C(s) of every channel.
    pub fn at(&self, s: f64, emission: &mut [f64]) -> f64 {
        let above = self.points.partition_point(|point| point.s <= s);
        let (Some(from), Some(to)) = (
            self.points.get(above.saturating_sub(1)),
            self.points.get(above).or(self.points.last()),
        ) else {
            return f64::NAN;
        };
        let width = to.s - from.s;
        let part = if width > 0.0 {
            ((s - from.s) / width).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let between = |near: f64, far: f64| near * (1.0 - part) + far * part;
        for ((emission, near), far) in emission.iter_mut().zip(&from.emission).zip(&to.emission) {
            *emission = between(*near, *far);
        }
        between(from.extinction, to.extinction)
    }
}
