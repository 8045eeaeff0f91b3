//! A short name for what a scene is.

use super::{Form, Medium, Values};
use rug::Rational;
use std::fmt::Write;

/// FNV-1a of 64 bits: it tells scenes apart that were mixed up, not those of somebody who wants to deceive.
pub(super) fn of(channels: &[String], background: &[Rational], media: &[Medium]) -> String {
    let mut text = String::new();
    // Writing into a text cannot fail.
    let _ = write!(text, "{channels:?}{background:?}");
    for piece in media.iter().flat_map(|medium| &medium.pieces) {
        let _ = write!(text, "|{}..{}:", piece.from, piece.to);
        match &piece.form {
            Form::Vacuum => text.push('0'),
            Form::Constant(values) => all(&mut text, values),
            Form::Linear { front, back } => {
                all(&mut text, front);
                text.push('/');
                all(&mut text, back);
            }
            Form::Smooth { formulas, .. } => {
                for of_one in formulas {
                    let _ = write!(text, "{},{};", of_one.emission, of_one.extinction);
                }
            }
        }
    }
    let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    format!("{hash:016x}")
}

fn all(text: &mut String, values: &[Values]) {
    for of_one in values {
        let _ = write!(text, "{},{};", of_one.emission, of_one.extinction);
    }
}
