//! Lanes: numbers side by side, 4, 8 or 16 rays or channels at once, as the processor has vectors for.
//!
//! A format of its own ([`LaneFormat`], by name `f32-lanes` and `f64-lanes`): + − × ÷ and √ are those of binary32 and
//! binary64, without fused multiply-add, which not every processor has; [`exp`](Lanes::exp) and
//! [`exp_m1`](Lanes::exp_m1) are within 1 unit in the last place, [`sin_cos`](Lanes::sin_cos) within 2, and all other
//! functions are those of the native formats. Numbers do not depend on the [`Width`], nor on the processor.

// What lanes do must be inlined into the function that has the instructions.
#![allow(clippy::inline_always)]

mod circle;
mod constants;
mod elementary;
mod number;
mod vector;
mod width;

pub use number::{LaneFormat, LaneReal};
pub use vector::Lanes;
pub use width::{Width, WidthError, WithLanes};

use super::NativeFloat;
use constants::Constants;
use fearless_simd::SimdFloatElement;

/// The most lanes there are.
pub(crate) const MOST: usize = 16;

/// A type that lanes are made of: `f32` and `f64`.
pub trait LaneFloat: NativeFloat + Constants + SimdFloatElement + Lanes<Element = Self> {
    /// 0.
    const ZERO: Self;
    /// ½.
    const HALF: Self;
    /// 1.
    const ONE: Self;

    /// [`Width::with`].
    fn with<W: WithLanes<Self>>(width: Width, action: W) -> W::Output;
}

impl LaneFloat for f32 {
    const ZERO: f32 = 0.0;
    const HALF: f32 = 0.5;
    const ONE: f32 = 1.0;

    fn with<W: WithLanes<f32>>(width: Width, action: W) -> W::Output {
        width::with_f32(width, action)
    }
}

impl LaneFloat for f64 {
    const ZERO: f64 = 0.0;
    const HALF: f64 = 0.5;
    const ONE: f64 = 1.0;

    fn with<W: WithLanes<f64>>(width: Width, action: W) -> W::Output {
        width::with_f64(width, action)
    }
}
