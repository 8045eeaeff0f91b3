//! FLINT's elementary functions, rounded once to nearest as MPFR rounds them.
//!
//! FLINT encloses a value in a ball with a few bits more than are asked for. Where all of the ball rounds to one number, that is
//! what MPFR gives too; elsewhere MPFR is asked. So no bit depends on whether FLINT is there.

// The C boundary.
#![allow(unsafe_code)]

use flint3_sys::{
    arb_atan, arb_clear, arb_cosh, arb_exp, arb_expm1, arb_init, arb_log, arb_log1p, arb_sin_cos,
    arb_sinh, arb_struct, arb_tan, arb_tanh, arf_struct, flint_cleanup, slong,
};
use gmp_mpfr_sys::mpfr::{mpfr_t, rnd_t};
use rug::Float;
use std::cell::RefCell;
use std::mem::MaybeUninit;
use std::ops::RangeInclusive;

// Not in the bindings, which know nothing of MPFR.
unsafe extern "C" {
    fn arf_set_mpfr(into: *mut arf_struct, from: *const mpfr_t);
    fn arf_get_mpfr(into: *mut mpfr_t, from: *const arf_struct, round: rnd_t) -> i32;
    fn arb_can_round_mpfr(ball: *const arb_struct, bits: slong, round: rnd_t) -> i32;
}

/// Bits beyond those of the result: of 2¹⁵ results one is not settled by its ball.
const GUARD_BITS: slong = 20;
/// Exponents of arguments that are FLINT's: what comes out is far from where MPFR's exponents end.
const EXPONENTS: RangeInclusive<i32> = -65_536..=24;

/// A function of one ball.
type Function = unsafe extern "C" fn(*mut arb_struct, *const arb_struct, slong);

/// The argument and two values, which keep their memory from one call to the next.
struct Balls {
    argument: arb_struct,
    value: arb_struct,
    second: arb_struct,
}

thread_local! {
    static BALLS: RefCell<Balls> = RefCell::new(Balls::new());
}

impl Balls {
    fn new() -> Self {
        let ball = || {
            let mut ball = MaybeUninit::uninit();
            // SAFETY: it is initialized there.
            unsafe {
                arb_init(ball.as_mut_ptr());
                ball.assume_init()
            }
        };
        Balls {
            argument: ball(),
            value: ball(),
            second: ball(),
        }
    }

    /// Takes x, exactly.
    fn take(&mut self, x: &Float) {
        // SAFETY: both are initialized; x is a number, as all callers have seen.
        unsafe { arf_set_mpfr(&raw mut self.argument.mid, x.as_raw()) }
    }
}

impl Drop for Balls {
    fn drop(&mut self) {
        for ball in [&mut self.argument, &mut self.value, &mut self.second] {
            // SAFETY: each was initialized, and is not used again.
            unsafe { arb_clear(ball) }
        }
        // SAFETY: nothing of FLINT's is left on this thread.
        unsafe { flint_cleanup() }
    }
}

/// Writes the number of `into`'s bits to which all of the ball rounds; `false` and nothing where there are several.
fn round(ball: &arb_struct, into: &mut Float) -> bool {
    // SAFETY: both are initialized.
    unsafe {
        let settled = arb_can_round_mpfr(ball, slong::from(into.prec()), rnd_t::RNDN) != 0;
        if settled {
            arf_get_mpfr(into.as_raw_mut(), &raw const ball.mid, rnd_t::RNDN);
        }
        settled
    }
}

/// Whether x is an argument for FLINT.
fn suits(x: &Float) -> bool {
    // Of 0, ∞ and NaN there is no exponent.
    x.get_exp()
        .is_some_and(|exponent| EXPONENTS.contains(&exponent))
}

/// f(x) in place of x; `false` and x where FLINT does not settle it.
fn settle(x: &mut Float, function: Function) -> bool {
    if !suits(x) {
        return false;
    }
    let settled = BALLS.try_with(|balls| {
        let balls = &mut *balls.try_borrow_mut().ok()?;
        balls.take(x);
        let bits = slong::from(x.prec()) + GUARD_BITS;
        // SAFETY: both are initialized.
        unsafe { function(&raw mut balls.value, &raw const balls.argument, bits) };
        round(&balls.value, x).then_some(())
    });
    matches!(settled, Ok(Some(())))
}

/// sin x in place of x and cos x; `None` and x where FLINT does not settle both.
pub(super) fn sin_cos(x: &mut Float) -> Option<Float> {
    if !suits(x) {
        return None;
    }
    let settled = BALLS.try_with(|balls| {
        let balls = &mut *balls.try_borrow_mut().ok()?;
        balls.take(x);
        let bits = slong::from(x.prec()) + GUARD_BITS;
        // SAFETY: all are initialized, and are three.
        unsafe {
            let (sin, cos) = (&raw mut balls.value, &raw mut balls.second);
            arb_sin_cos(sin, cos, &raw const balls.argument, bits);
        }
        let mut cos = Float::new(x.prec());
        (round(&balls.second, &mut cos) && round(&balls.value, x)).then_some(cos)
    });
    settled.ok().flatten()
}

macro_rules! functions {
    ($($name:ident: $flint:ident),*) => {
        $(
            /// In place; `false` and the argument where FLINT does not settle it.
            pub(super) fn $name(x: &mut Float) -> bool {
                settle(x, $flint)
            }
        )*
    };
}
functions!(
    exp: arb_exp,
    exp_m1: arb_expm1,
    ln: arb_log,
    ln_1p: arb_log1p,
    tan: arb_tan,
    sinh: arb_sinh,
    cosh: arb_cosh,
    tanh: arb_tanh,
    atan: arb_atan
);
