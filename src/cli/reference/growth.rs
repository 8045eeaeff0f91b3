//! What many digits would take, by how what few take grows.

use crate::cli::budget::size;
use std::fmt;
use std::time::Instant;

/// The fewest digits that are tried; each time twice as many.
const FIRST: u32 = 100;
/// A run of so many seconds is long enough to tell.
const ENOUGH: f64 = 1.0;
/// Under so many the clock and the work that is always the same show, and the power is that over all that was run.
const SHORT: f64 = 0.01;
/// What is measured grows as fast as the digits at least, and no algorithm in use grows faster than this.
const POWERS: (f64, f64) = (1.0, 4.0);
/// Points come in powers of two: one of so many doublings of the digits shows whether they grow.
const DOUBLINGS: usize = 3;

/// What so many digits take.
#[derive(Clone, Copy)]
struct Taken {
    digits: u32,
    seconds: f64,
    bytes: f64,
}

/// What was measured last, and with which powers of the digits it grows.
pub(super) struct Growth {
    last: Taken,
    of_seconds: f64,
    of_bytes: f64,
}

/// Runs `bytes`, which says what it takes of memory, with more and more digits, up to as many as are allowed or until it takes
/// long enough to be measured.
pub(super) fn measured<E>(
    most: u32,
    mut bytes: impl FnMut(u32) -> Result<f64, E>,
) -> Result<Growth, E> {
    let mut taken: Vec<Taken> = Vec::new();
    let mut digits = FIRST;
    loop {
        let start = Instant::now();
        let bytes = bytes(digits)?;
        let seconds = start.elapsed().as_secs_f64();
        let last = Taken {
            digits,
            seconds,
            bytes,
        };
        taken.push(last);
        digits = digits.saturating_mul(2);
        if seconds >= ENOUGH || digits > most {
            return Ok(Growth {
                last,
                of_seconds: of_seconds(&taken),
                of_bytes: of_bytes(&taken),
            });
        }
    }
}

fn of_seconds(taken: &[Taken]) -> f64 {
    let power = match taken {
        [.., before, last] if before.seconds >= SHORT => (last.seconds / before.seconds).log2(),
        [first, .., last] => {
            let more = f64::from(last.digits) / f64::from(first.digits);
            (last.seconds / first.seconds).ln() / more.ln()
        }
        _ => POWERS.0,
    };
    power.clamp(POWERS.0, POWERS.1)
}

/// The largest of the last doublings.
fn of_bytes(taken: &[Taken]) -> f64 {
    let pairs = taken.windows(2).rev().take(DOUBLINGS);
    let powers = pairs.map(|pair| (pair[1].bytes / pair[0].bytes).log2());
    let power = powers.fold(POWERS.0, f64::max);
    power.clamp(POWERS.0, POWERS.1)
}

impl Growth {
    /// Bytes and seconds of so many digits.
    pub(super) fn at(&self, digits: u32) -> (f64, f64) {
        let more = f64::from(digits) / f64::from(self.last.digits);
        (
            self.last.bytes * more.powf(self.of_bytes),
            self.last.seconds * more.powf(self.of_seconds),
        )
    }
}

/// What was measured, and how it grows.
impl fmt::Display for Growth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Taken {
            digits,
            seconds,
            bytes,
        } = self.last;
        write!(
            f,
            "{digits} digits, which take {} and {:.1} ms here, growing as digits^{:.1} and digits^{:.1}",
            size(bytes),
            1e3 * seconds,
            self.of_bytes,
            self.of_seconds
        )
    }
}
