//! Segments that hold nothing.

use crate::identify::NotIdentified;
use crate::identify::number::simplest;
use crate::identify::opacity::measure::Measurer;
use crate::identify::ray::{Emission, Layers};
use crate::identify::session::Session;
use crate::identify::silence::Silence;

/// What empty segments do.
#[derive(Clone, Debug, Default)]
pub(in crate::identify) struct Vacuum {
    /// What is added to what a segment lets through.
    pub(in crate::identify) eps: f64,
    /// Between these.
    pub(in crate::identify) bracket: (f64, f64),
    /// A ray that holds nothing has no finite answer.
    pub(in crate::identify) whole_fails: bool,
    /// A ray with an empty segment has none.
    pub(in crate::identify) part_fails: bool,
    /// A ray that holds nothing, and its answer without emission.
    pub(in crate::identify) dark: Option<(Layers, f64)>,
}

/// Empty segments of the ray that shows what they let through.
const EMPTY: usize = 57;

/// A ray of nothing, one with an empty segment, and one with 57.
pub(in crate::identify) fn vacuum(
    session: &mut Session<'_>,
    measurer: &Measurer<'_>,
    tau: f64,
) -> Result<Vacuum, NotIdentified> {
    if measurer.answers.is_coarse() {
        return failures(session, tau);
    }
    let n = measurer.suitable(session, EMPTY + 6);
    let mut taus = vec![0.0; n];
    for k in [0, 1, 2, n - 3, n - 2, n - 1] {
        taus[k] = tau;
    }
    let tells = |k: usize| k == 1 || k == 2 || k + 2 == n;
    let Ok(w) = measurer.weights_of(session, &taus, 0.25, &tells) else {
        return failures(session, tau);
    };
    let empty = Layers::of(0.25, &vec![0.0; n]);
    let dark = answered(session, &empty)?;
    let mut vacuum = Vacuum {
        whole_fails: dark.is_none(),
        dark: dark.map(|dark| (empty, dark)),
        ..Vacuum::default()
    };
    if !(w[1].value > 0.0 && w[2].value > 0.0 && w[n - 2].value > 0.0) {
        return Ok(vacuum);
    }
    // w[n−2]/w[1] = t³ q^(n−6).
    let through = w[2].value / w[1].value;
    let count = (n - 6) as f64;
    let span = w[n - 2].value / w[1].value / through.powi(3);
    let eps = span.powf(1.0 / count) - 1.0;
    let part = |k: usize| w[k].error / w[k].value;
    let unit = measurer.answers.unit;
    // The references' own opacities are by subtraction, perhaps.
    let error = (part(n - 2)
        + 16.0 * unit / (1.0 - through).abs().max(1e-3)
        + 4.0 * part(1)
        + 3.0 * part(2)
        + 8.0 * unit)
        / count
        + 2.0 * unit;
    let error = error + measurer.answers.noise / count;
    if eps.abs() > 3.0 * error && eps.abs() < 1e-2 {
        vacuum.bracket = (eps - error, eps + error);
        vacuum.eps = simplest(eps - error, eps + error);
    }
    Ok(vacuum)
}

/// The answer to no emission, where light along a medium has a finite answer.
fn answered(session: &mut Session<'_>, layers: &Layers) -> Result<Option<f64>, NotIdentified> {
    let n = layers.count();
    let ray = session.ray(layers, &[Emission::even(n, 0.5), Emission::even(n, 0.0)]);
    match session.ask_any(&ray) {
        Ok(y) => Ok(y
            .last()
            .copied()
            .filter(|_| y.iter().all(|y| y.is_finite()))),
        // A division by nothing may be an error as well.
        Err(Silence::Kernel { .. }) => Ok(None),
        Err(silence) => Err(silence.into()),
    }
}

/// Whether rays that hold nothing, or nothing in one segment, have answers.
pub(in crate::identify) fn failures(
    session: &mut Session<'_>,
    tau: f64,
) -> Result<Vacuum, NotIdentified> {
    let mut vacuum = Vacuum::default();
    let n = 8_usize.next_multiple_of(session.multiple);
    let mut gap = vec![tau; n];
    gap[2] = 0.0;
    for (taus, is_whole) in [(vec![0.0; n], true), (gap, false)] {
        // Every node of the empty segment holds nothing.
        let mut layers = Layers::of(0.25, &taus);
        if !is_whole {
            layers.edges[3] = 0.0;
        }
        let dark = answered(session, &layers)?;
        if is_whole {
            vacuum.whole_fails = dark.is_none();
            vacuum.dark = dark.map(|dark| (layers, dark));
        } else {
            vacuum.part_fails = dark.is_none();
        }
    }
    Ok(vacuum)
}
