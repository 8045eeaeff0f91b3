//! Radiance of samples along rays.

use super::bundle::Bundle;
use super::number::Number;
use super::table::{Table, Values};
use super::way::Way;
use crate::method::{Accumulation, OpacityFormula};
use crate::real::lanes::{LaneFloat, Lanes, MOST, WithLanes};

/// Places whose exponentials are taken behind their media: shorter chains of operations, of which a processor does several at
/// once.
const GROUP: usize = 8;

/// How far rays are, lane by lane.
#[derive(Clone, Debug)]
pub(super) struct State<T, const C: usize> {
    pub(super) radiance: [[T; MOST]; C],
    transmittance: [T; MOST],
    depth: [T; MOST],
    /// τ at the last sample, and C τ e^(−t).
    extinction: [T; MOST],
    source: [[T; MOST]; C],
}

impl<T: LaneFloat, const C: usize> State<T, C> {
    pub(super) fn new() -> Self {
        let zeros = [T::ZERO; MOST];
        State {
            radiance: [zeros; C],
            transmittance: [T::ONE; MOST],
            depth: zeros,
            extinction: zeros,
            source: [zeros; C],
        }
    }
}

/// Goes on with rows of samples.
pub(super) struct Integrate<'a, T, const C: usize> {
    pub(super) way: Way,
    pub(super) table: &'a Table<T, C>,
    pub(super) rays: &'a Bundle<T>,
    /// The first row's segment.
    pub(super) first: usize,
    pub(super) values: &'a [T],
    pub(super) state: &'a mut State<T, C>,
}

impl<T: Number, const C: usize> WithLanes<T> for Integrate<'_, T, C> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes<Element = T>>(self, zero: L) {
        match self.way {
            Way::Composited { opacity, depth, .. } => self.composite(zero, opacity, depth),
            Way::Trapezoid => self.by_trapezoids(zero),
        }
    }
}

impl<T: Number, const C: usize> Integrate<'_, T, C> {
    /// Σ C α T from front to back.
    #[inline(always)]
    fn composite<L: Lanes<Element = T>>(
        self,
        zero: L,
        formula: OpacityFormula,
        accumulation: Accumulation,
    ) {
        let rays = self.rays.in_lanes(zero);
        let one = zero.all(T::ONE);
        let mut k = zero.all(T::rounded(self.first as f64));
        let mut radiance = [zero; C];
        for (lanes, row) in radiance.iter_mut().zip(&self.state.radiance) {
            *lanes = zero.load(row);
        }
        let mut transmittance = zero.load(&self.state.transmittance);
        let mut depth = zero.load(&self.state.depth);
        for rows in self.values.chunks(GROUP * L::WIDTH) {
            let (mut depths, mut colors) = ([zero; GROUP], [[zero; C]; GROUP]);
            for (place, row) in rows.chunks_exact(L::WIDTH).enumerate() {
                let step = rays.segment(k);
                k = k + one;
                // Behind its end a ray sees nothing, whatever the sample there.
                let s = L::select(zero.below(step), zero.load(row), zero);
                let values = self.table.at(s);
                depths[place] = values.extinction * step;
                colors[place] = values.emission;
            }
            let count = rows.len() / L::WIDTH;
            for (&segment, color) in depths.iter().zip(&colors).take(count) {
                let opacity = match formula {
                    OpacityFormula::Subtraction => one - (-segment).exp(),
                    OpacityFormula::Linear => segment,
                    // The relative opacity is a series where segments are thin, and no way of lanes.
                    OpacityFormula::Expm1 | OpacityFormula::Relative => -(-segment).exp_m1(),
                };
                for c in 0..C {
                    radiance[c] = radiance[c] + color[c] * opacity * transmittance;
                }
                transmittance = match accumulation {
                    Accumulation::Transmittances => transmittance * (one - opacity),
                    Accumulation::Remainder => transmittance - opacity * transmittance,
                    Accumulation::Depths => {
                        depth = depth + segment;
                        (-depth).exp()
                    }
                };
            }
        }
        for (lanes, row) in radiance.iter().zip(&mut self.state.radiance) {
            lanes.store(row);
        }
        transmittance.store(&mut self.state.transmittance);
        depth.store(&mut self.state.depth);
    }

    /// Σ d/2 (C τ e^(−t) at the front + the same at the back), t by the same rule.
    #[inline(always)]
    fn by_trapezoids<L: Lanes<Element = T>>(self, zero: L) {
        let rays = self.rays.in_lanes(zero);
        let (one, half) = (zero.all(T::ONE), zero.all(T::HALF));
        // Sample k ends segment k − 1; the first of all ends none.
        let mut k = zero.all(T::rounded(self.first as f64)) - one;
        let mut radiance = [zero; C];
        let mut source = [zero; C];
        for c in 0..C {
            radiance[c] = zero.load(&self.state.radiance[c]);
            source[c] = zero.load(&self.state.source[c]);
        }
        let mut depth = zero.load(&self.state.depth);
        let mut front = zero.load(&self.state.extinction);
        let mut is_first = self.first == 0;
        for row in self.values.chunks_exact(L::WIDTH) {
            let Values {
                extinction,
                emission,
            } = self.table.at(zero.load(row));
            let step = if is_first { zero } else { rays.segment(k) };
            is_first = false;
            k = k + one;
            let half_step = half * step;
            depth = depth + (front + extinction) * half_step;
            front = extinction;
            let transmittance = (-depth).exp();
            for c in 0..C {
                let back = emission[c] * extinction * transmittance;
                radiance[c] = radiance[c] + (source[c] + back) * half_step;
                source[c] = back;
            }
        }
        for c in 0..C {
            radiance[c].store(&mut self.state.radiance[c]);
            source[c].store(&mut self.state.source[c]);
        }
        depth.store(&mut self.state.depth);
        front.store(&mut self.state.extinction);
    }
}
