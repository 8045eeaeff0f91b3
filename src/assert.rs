//! The order of a kernel as an assertion, for the tests of whoever wrote it.

use crate::case::catalogue;
use crate::case::manufacture::{ManufactureError, manufacture};
use crate::document::About;
use crate::kernel::{Kernel, Subject, SubjectError};
use crate::render::terminal;
use crate::report::verify::{document, heading, row};
use crate::study::Silent;
use crate::study::verify::{
    Axis, Conclusion, Settings, SettingsError, Verification, VerifyError, verify,
};
use rug::Rational;
use std::fmt;

/// Smooth cases in which nothing hides an error, thin and thick, short and long.
const CASES: [&str; 10] = [
    "cloud",
    "decaying-field",
    "emission-bump",
    "emission-cubic",
    "faint-long",
    "hyperbolic-tangent",
    "rational-radiance",
    "rgb-transfer",
    "sine-squared",
    "thick",
];
/// Columns of the report.
const WIDTH: usize = 100;

/// A kernel whose order is not confirmed; it prints as the report says why.
#[derive(Clone, Debug, thiserror::Error)]
pub enum OrderError {
    /// It was run, and something contradicts.
    Unconfirmed(Box<Verification>),
    /// The order is no positive number.
    Order {
        /// The order.
        order: f64,
    },
    /// It could not be run.
    Verify(#[from] VerifyError),
    /// A case of the catalogue cannot be had, which is a mistake of this crate.
    Case(#[from] ManufactureError),
    /// As before.
    Subject(#[from] SubjectError),
    /// As before.
    Settings(#[from] SettingsError),
}

impl fmt::Display for OrderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            OrderError::Unconfirmed(verification) => {
                let first = verification.declaration.first_answer();
                let rows = verification.lines.iter();
                let rows: String = rows.map(|line| row(line, first, WIDTH, false)).collect();
                let head = heading(WIDTH, false);
                let about = About::new(std::env::args_os());
                let closing = terminal(&document(verification, &about), WIDTH, false);
                write!(f, "the order is not confirmed\n{head}{rows}\n{closing}")
            }
            OrderError::Order { order } => {
                write!(f, "an order of {order} (allowed: finite, above 0)")
            }
            OrderError::Verify(error) => error.fmt(f),
            OrderError::Case(error) => error.fmt(f),
            OrderError::Subject(error) => error.fmt(f),
            OrderError::Settings(error) => error.fmt(f),
        }
    }
}

/// Runs a kernel on smooth cases with n = 8, 16, …, 512 and expects that order; what [`assert_order!`] does.
///
/// # Errors
/// [`OrderError`] where the order is not confirmed, and nothing else counts: not what could not be told either.
///
/// [`assert_order!`]: crate::assert_order
pub fn confirm_order(kernel: &mut dyn Kernel, order: f64) -> Result<Verification, OrderError> {
    let expect = Rational::from_f64(order).filter(|order| *order > 0);
    let expect = expect.ok_or(OrderError::Order { order })?;
    let mut subjects = Vec::new();
    for name in CASES {
        let Some(Ok(description)) = catalogue::find(name) else {
            continue;
        };
        let channels = manufacture(&description)?;
        let channels = channels.into_iter().map(|one| (one.channel, one.case));
        subjects.push(Subject::new(name, channels.collect())?);
    }
    let settings = Settings {
        expect: Some(expect),
        ..Settings::standard(Axis::Step)?
    };
    let verification = verify(kernel, &subjects, &settings, &Silent, &mut |_| ())?;
    match verification.conclusion() {
        Conclusion::Confirmed => Ok(verification),
        Conclusion::NotConfirmed | Conclusion::CouldNotRun => {
            Err(OrderError::Unconfirmed(Box::new(verification)))
        }
    }
}

/// Asserts that a [`Kernel`] has that order of accuracy; otherwise it panics with the whole report.
///
/// ```
/// use volver::kernel::Closure;
///
/// // Front to back with samples in the middle of every segment.
/// let marcher = Closure::segments("marcher", |segments, channel| {
///     let samples = &segments.middles;
///     let colors = samples.extinction.iter().zip(&samples.emission[channel]);
///     let (mut radiance, mut transmittance) = (0.0, 1.0);
///     for ((extinction, emission), length) in colors.zip(segments.lengths()) {
///         let alpha = 1.0 - (-extinction * length).exp();
///         radiance += transmittance * alpha * emission;
///         transmittance *= 1.0 - alpha;
///     }
///     radiance
/// });
/// volver::assert_order!(marcher, 2);
/// ```
#[macro_export]
macro_rules! assert_order {
    ($kernel:expr, $order:expr) => {{
        let mut kernel = $kernel;
        let order = ::std::primitive::f64::from($order);
        if let Err(error) = $crate::assert::confirm_order(&mut kernel, order) {
            ::std::panic!("{}", error);
        }
    }};
}
