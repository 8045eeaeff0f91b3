//! Segments that hold nothing.

use crate::identify::NotIdentified;
use crate::identify::number::simplest;
use crate::identify::opacity::measure::Measurer;
use crate::identify::ray::{Emission, Layers};
use crate::identify::session::Session;
use crate::identify::silence::Silence;
use crate::identify::weights::Measured;

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
    /// Empty segments let through other than all, and it is not known why.
    pub(in crate::identify) odd: Option<NotIdentified>,
}

/// Empty segments of the ray that shows what they let through.
const EMPTY: usize = 57;
/// The same where they let through all but a unit.
const MANY: usize = 2_000;
/// The depth of a segment that lets nothing through.
const OPAQUE: f64 = 1e3;

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
    } else if measurer.answers.noise == 0.0
        && !session.is_short()
        && session.most_samples > MANY + 6
    {
        grown(session, measurer, tau, &mut vacuum);
    }
    Ok(vacuum)
}

/// What is added by a unit or two of the format: rounding leaves nothing of a product with 1, so that what thousands of empty
/// segments let through together is all but exact. It is named where an opaque segment lets as much through.
fn grown(session: &mut Session<'_>, measurer: &Measurer<'_>, tau: f64, vacuum: &mut Vacuum) {
    let n = measurer.suitable(session, MANY + 6);
    let mut taus = vec![0.0; n];
    for k in [0, 1, 2, n - 3, n - 2, n - 1] {
        taus[k] = tau;
    }
    let tells = |k: usize| k == 1 || k == 2 || k + 2 == n;
    let Ok(w) = measurer.some_weights(session, &taus, 0.25, &tells) else {
        return;
    };
    let unit = measurer.answers.unit;
    let part = |k: usize| w[k].error / w[k].value;
    let through = w[2].value / w[1].value;
    let count = (n - 6) as f64;
    let growth = (w[n - 2].value / w[1].value / through.powi(3)).powf(1.0 / count) - 1.0;
    let error = (part(n - 2)
        + 16.0 * unit / (1.0 - through).abs().max(1e-3)
        + 4.0 * part(1)
        + 3.0 * part(2))
        / count;
    let is_grown = growth.abs() > 3.0 * error && growth.abs() < 1e-2;
    if !is_grown || through.is_nan() {
        return;
    }
    let mut taus = vec![tau; measurer.suitable(session, 8)];
    taus[2] = OPAQUE / 0.25;
    let leak = match measurer.weights(session, &taus, 0.25) {
        // Behind the reference and what is opaque.
        Ok(w) => Measured {
            value: w[3].value / w[1].value / through,
            error: w[3].error / w[1].value + 16.0 * unit * (w[3].value / w[1].value).abs(),
        },
        Err(_) => Measured {
            value: 0.0,
            error: 0.0,
        },
    };
    // 1 + eps is rounded, and every product with it.
    let rounded = 4.0 * unit + 0.5 * growth.abs();
    if leak.value > 3.0 * leak.error && (leak.value - growth).abs() <= rounded {
        vacuum.bracket = (leak.value - leak.error, leak.value + leak.error);
        vacuum.eps = simplest(vacuum.bracket.0, vacuum.bracket.1);
    } else {
        let reason = format!(
            "{count} empty segments together let through {:.6} of the light, and it is not known why",
            (count * growth.ln_1p()).exp()
        );
        vacuum.odd = Some(NotIdentified::new(reason));
    }
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
