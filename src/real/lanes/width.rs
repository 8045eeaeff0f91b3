//! How many lanes: what the processor has, and what is asked for.

use super::vector::{Lanes, Pair, Vector};
use super::{LaneFloat, MOST};
use fearless_simd::{Level, Simd, f32x4, f32x8, f32x16, f64x4, f64x8};
use std::fmt;
use std::str::FromStr;
use std::sync::atomic::{AtomicU8, Ordering};

/// How many numbers are side by side. Nothing depends on it but the time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Width {
    /// One, on every processor.
    One,
    /// Four, with vectors of 128 bits: SSE2 or NEON.
    Four,
    /// Eight, with AVX2.
    Eight,
    /// Sixteen, with AVX-512 as Ice Lake and Zen 4 have it.
    Sixteen,
}

/// A number of lanes that is none, or that this processor lacks.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum WidthError {
    /// Not one of the widths.
    #[error("'{text}' lanes (allowed: 1, 4, 8, 16)")]
    Unknown {
        /// What was given.
        text: String,
    },
    /// The processor lacks the instructions.
    #[error("{width} lanes need {instructions}, which this processor lacks (allowed: {allowed})")]
    Missing {
        /// What was asked for.
        width: Width,
        /// What it needs.
        instructions: &'static str,
        /// The widths that are there.
        allowed: String,
    },
}

/// Something to do in lanes whose width is known only at run time: a closure generic over [`Lanes`].
pub trait WithLanes<T: LaneFloat> {
    /// What comes out.
    type Output;
    /// Does it; all lanes come of `zero`. This function and all that takes lanes must be `#[inline(always)]`, closures too:
    /// what is not inlined is right and slow.
    fn run<L: Lanes<Element = T>>(self, zero: L) -> Self::Output;
}

/// The width that is asked for; 0 where the widest will do.
static ASKED_FOR: AtomicU8 = AtomicU8::new(0);

impl Width {
    /// All widths.
    pub const ALL: [Width; 4] = [Width::One, Width::Four, Width::Eight, Width::Sixteen];

    /// How many lanes that is.
    #[must_use]
    pub fn lanes(self) -> u8 {
        match self {
            Width::One => 1,
            Width::Four => 4,
            Width::Eight => 8,
            Width::Sixteen => 16,
        }
    }

    /// What it needs.
    #[must_use]
    pub fn instructions(self) -> &'static str {
        match self {
            Width::One => "no vectors",
            Width::Four => "vectors of 128 bits",
            Width::Eight => "AVX2",
            Width::Sixteen => "AVX-512",
        }
    }

    /// Whether this processor has it.
    #[must_use]
    pub fn is_there(self) -> bool {
        match self {
            Width::One => true,
            Width::Four => four().is_some(),
            Width::Eight => eight().is_some(),
            Width::Sixteen => sixteen().is_some(),
        }
    }

    /// The widths that this processor has.
    pub fn there() -> impl Iterator<Item = Width> {
        Width::ALL.into_iter().filter(|width| width.is_there())
    }

    /// The width that is used: the widest that is there, if no other was [chosen](Width::choose).
    #[must_use]
    pub fn current() -> Width {
        let asked_for = ASKED_FOR.load(Ordering::Relaxed);
        let chosen = |width: &Width| asked_for == 0 || width.lanes() == asked_for;
        Width::there().filter(chosen).last().unwrap_or(Width::One)
    }

    /// Uses this width from now on, in the whole process: numbers stay the same.
    ///
    /// # Errors
    /// [`WidthError::Missing`] where the processor lacks it.
    pub fn choose(self) -> Result<(), WidthError> {
        if !self.is_there() {
            let allowed: Vec<_> = Width::there().map(|width| width.to_string()).collect();
            return Err(WidthError::Missing {
                width: self,
                instructions: self.instructions(),
                allowed: allowed.join(", "),
            });
        }
        ASKED_FOR.store(self.lanes(), Ordering::Relaxed);
        Ok(())
    }

    /// Does `action` in lanes of this width; one by one where the processor lacks it.
    pub fn with<T: LaneFloat, W: WithLanes<T>>(self, action: W) -> W::Output {
        T::with(self, action)
    }
}

impl FromStr for Width {
    type Err = WidthError;

    fn from_str(text: &str) -> Result<Self, WidthError> {
        let named = |width: &Width| width.to_string() == text;
        let unknown = || WidthError::Unknown { text: text.into() };
        Width::ALL.into_iter().find(named).ok_or_else(unknown)
    }
}

impl fmt::Display for Width {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.lanes().to_string())
    }
}

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
fn four() -> Option<impl Simd> {
    Level::new().as_sse2()
}

#[cfg(target_arch = "aarch64")]
fn four() -> Option<impl Simd> {
    Level::new().as_neon()
}

#[cfg(not(any(target_arch = "x86", target_arch = "x86_64", target_arch = "aarch64")))]
fn four() -> Option<impl Simd> {
    None::<fearless_simd::Fallback>
}

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
fn eight() -> Option<impl Simd> {
    Level::new().as_avx2()
}

#[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
fn eight() -> Option<impl Simd> {
    None::<fearless_simd::Fallback>
}

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
fn sixteen() -> Option<impl Simd> {
    Level::new().as_avx512()
}

#[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
fn sixteen() -> Option<impl Simd> {
    None::<fearless_simd::Fallback>
}

/// Does `action` with these instructions.
#[inline(always)]
fn vectorized<S: Simd, L: Lanes, W: WithLanes<L::Element>>(
    simd: S,
    zero: L,
    action: W,
) -> W::Output {
    simd.vectorize(
        #[inline(always)]
        || action.run(zero),
    )
}

pub(super) fn with_f64<W: WithLanes<f64>>(width: Width, action: W) -> W::Output {
    match (width, four(), eight(), sixteen()) {
        (Width::Four, Some(simd), _, _) => {
            vectorized(simd, Vector::<_, f64x4<_>>::zero(simd), action)
        }
        (Width::Eight, _, Some(simd), _) => {
            vectorized(simd, Vector::<_, f64x8<_>>::zero(simd), action)
        }
        (Width::Sixteen, _, _, Some(simd)) => {
            let zero = Vector::<_, f64x8<_>>::zero(simd);
            vectorized(simd, Pair(zero, zero), action)
        }
        _ => action.run(0_f64),
    }
}

pub(super) fn with_f32<W: WithLanes<f32>>(width: Width, action: W) -> W::Output {
    match (width, four(), eight(), sixteen()) {
        (Width::Four, Some(simd), _, _) => {
            vectorized(simd, Vector::<_, f32x4<_>>::zero(simd), action)
        }
        (Width::Eight, _, Some(simd), _) => {
            vectorized(simd, Vector::<_, f32x8<_>>::zero(simd), action)
        }
        (Width::Sixteen, _, _, Some(simd)) => {
            vectorized(simd, Vector::<_, f32x16<_>>::zero(simd), action)
        }
        _ => action.run(0_f32),
    }
}

const _: () = assert!(MOST == 16);
