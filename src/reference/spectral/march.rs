//! From panel to panel along the ray.

use super::super::ReferenceError;
use super::super::chebyshev::{Circle, Series, log2_abs};
use super::super::medium::Medium;
use super::grid::Grid;
use super::light::{Light, Resolved, light};
use super::panel::Panel;
use super::stretch::Stretch;
use super::verdict::{Verdict, verdict};
use super::{Quantity, Settings, Work};
use rug::Float;
use std::f64::consts::LOG2_E;

/// The degree that sampling starts with.
const FIRST: usize = 16;
/// Evaluations before it is given up.
const MAX_EVALUATIONS: u64 = 1 << 18;

/// The state of an integration: all that is left of the current place.
pub(super) struct March<'m> {
    case: &'m dyn Medium,
    settings: Settings,
    work: &'m mut Work,
    circle: Circle,
    stretches: Vec<Stretch>,
    /// t up to the current place, and what it is off by at most.
    depth: Float,
    depth_error: Float,
    /// I up to there.
    light: Float,
    light_error: Float,
    /// log₂ of the light that tolerances are measured by.
    scale: f64,
    /// log₂ of the largest C·τ whose light vanished in e^(−t).
    lost: f64,
}

impl<'m> March<'m> {
    pub(super) fn new(case: &'m dyn Medium, settings: Settings, work: &'m mut Work) -> Self {
        let bits = settings.precision;
        March {
            case,
            settings,
            work,
            circle: Circle::new(bits),
            stretches: Stretch::all(case, bits),
            depth: Float::new(bits),
            depth_error: Float::new(64),
            light: Float::new(bits),
            light_error: Float::new(64),
            scale: f64::NEG_INFINITY,
            lost: f64::NEG_INFINITY,
        }
    }

    /// The value and what it is off by at most.
    pub(super) fn run(mut self) -> Result<(Float, Float), ReferenceError> {
        self.work.panels = 0;
        self.work.points = 0;
        let bits = self.settings.precision;
        let mut open: Vec<Panel> = (0..self.stretches.len())
            .map(|s| Panel::whole(s, bits))
            .rev()
            .collect();
        while let Some(panel) = open.pop() {
            if self.integrate(&panel)? {
                continue;
            }
            let too_deep = panel.halvings >= self.settings.target + 64;
            if too_deep || self.work.evaluations > MAX_EVALUATIONS {
                let lambda = self
                    .stretches
                    .get(panel.stretch)
                    .map(|s| s.place(&panel.left).to_f64());
                return Err(ReferenceError::NotResolved {
                    wanted: self.settings.wanted,
                    believed: 0,
                    lambda,
                    evaluations: self.work.evaluations,
                });
            }
            let [left, right] = panel.halves();
            open.extend([right, left]);
        }
        if self.settings.quantity == Quantity::Depth {
            return Ok((self.depth, self.depth_error));
        }
        if self.light.is_zero() && self.lost > f64::NEG_INFINITY {
            return Err(ReferenceError::OracleUnderflow {
                depth: self.depth.to_f64(),
            });
        }
        Ok((self.light, self.light_error))
    }

    /// Adds a panel; `false` where it is to be halved.
    fn integrate(&mut self, panel: &Panel) -> Result<bool, ReferenceError> {
        let Some(stretch) = self.stretches.get(panel.stretch).cloned() else {
            return Ok(true);
        };
        let width = panel.width();
        let log2_width = -f64::from(panel.halvings);
        let transmittance = -self.depth.to_f64() * LOG2_E;
        let target = f64::from(self.settings.target);
        let mut grid = Grid::new(&stretch, panel);
        let mut n = FIRST;
        let ([extinction, source], tails) = loop {
            grid.refine(self.case, n, &mut self.circle, self.work)?;
            grid.check_signs(&self.circle, &self.settings)?;
            let scale = self.scale.max(transmittance + grid.log2_light());
            let series = grid.series(&self.circle);
            let allowances = [
                -target - log2_width,
                scale - target - log2_width - transmittance,
            ];
            let mut tails = [f64::NEG_INFINITY; 2];
            let mut is_open = false;
            for ((series, allowance), tail) in series.iter().zip(allowances).zip(&mut tails) {
                match verdict(
                    series,
                    allowance.max(self.floor(series)),
                    self.settings.limit,
                ) {
                    Verdict::Resolved { tail: own } => *tail = own,
                    Verdict::Open => is_open = true,
                    Verdict::Hopeless => {
                        self.scale = scale;
                        return Ok(false);
                    }
                }
            }
            if !is_open {
                self.scale = scale;
                break (series, tails);
            }
            n *= 2;
        };
        let allowance = self.scale - target - log2_width - transmittance;
        let resolved = Resolved {
            depth: extinction.integral(&width),
            source,
            values: grid.source(),
            width: width.clone(),
            transmittance,
            allowance,
        };
        let light = match self.settings.quantity {
            Quantity::Depth => Some(Light::none()),
            Quantity::Radiance => light(&resolved, &mut self.circle, &self.settings, self.work),
        };
        let Some(light) = light else { return Ok(false) };
        self.add(&resolved, &extinction, &light, tails);
        self.work.panels += 1;
        self.work.points += grid.degree() as u64 + 1;
        Ok(true)
    }

    /// log₂ of what rounding leaves of a series' last coefficients, with room for a medium that is
    /// evaluated less well.
    fn floor(&self, series: &Series) -> f64 {
        let largest = series.log2_largest(0..=series.degree());
        largest - f64::from(self.settings.precision) + 40.0
    }

    fn add(
        &mut self,
        resolved: &Resolved<'_>,
        extinction: &Series,
        light: &Light,
        tails: [f64; 2],
    ) {
        let bits = self.settings.precision;
        let n = extinction.degree();
        let log2_width = log2_abs(&resolved.width);
        // Of n + 1 values each is off by a unit or two, and so are the sums of the transforms.
        let rounding = 2.0 * (n as f64).log2() + 3.0 - f64::from(bits);
        let largest = |series: &Series| series.log2_largest(0..=series.degree());

        let change = resolved.depth.at_right();
        self.depth_error += exp2(log2_width + tails[0] + 4.0);
        self.depth_error += exp2(log2_width + largest(extinction) + rounding);
        self.depth_error += exp2(log2_abs(&self.depth) - f64::from(bits) + 1.0);

        let off = [
            tails[1] + 4.0,
            light.tail + 4.0,
            largest(&resolved.source) + rounding,
            light.largest + rounding,
        ];
        for part in off {
            self.light_error += exp2(resolved.transmittance + log2_width + part);
        }
        // e^(−t) is off by as much of itself as t is off.
        let shown = exp2(resolved.transmittance + log2_width + light.largest + 2.0);
        self.light_error += shown * &self.depth_error;

        if !light.total.is_zero() {
            let mut transmittance = Float::with_val(bits, -&self.depth).exp();
            if !self.depth.is_zero() {
                self.work.transcendental_calls += 1;
            }
            if transmittance.is_zero() {
                self.lost = self.lost.max(largest(&resolved.source));
            }
            transmittance *= &light.total;
            self.light += transmittance;
        }
        self.depth += change;
    }
}

/// 2ˣ in 64 bits, 0 for −∞.
fn exp2(x: f64) -> Float {
    let whole = x.floor().clamp(-1e9, 1e9);
    if x == f64::NEG_INFINITY {
        return Float::new(64);
    }
    #[allow(clippy::cast_possible_truncation)] // Within ±10⁹.
    let exponent = whole as i32;
    Float::with_val(64, (x - whole).min(1.0).exp2()) << exponent
}
