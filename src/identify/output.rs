//! The map from radiance to answer, by emissions of many sizes that are the same everywhere.

use super::channels::{constants, even, sizes};
use super::number::simplest_near;
use super::precision::Precision;
use super::ray::{Emission, Layers};
use super::rule::{Curve, Output};
use super::session::Session;
use super::state::State;
use super::weights::Answers;
use super::{Bracket, NotIdentified, Parameter};

/// What the answers to constant emissions say.
#[derive(Clone, Debug)]
pub(super) struct Mapped {
    pub(super) answers: Answers,
    /// The largest emission that counts as it is.
    pub(super) emission_max: Option<f64>,
    /// The smallest one.
    pub(super) emission_min: Option<f64>,
    /// Between what the parameters of curve and cut lie.
    pub(super) brackets: Vec<Bracket>,
    /// Negative emissions have answers.
    pub(super) takes_negative: bool,
    /// The even medium, and its answer without emission.
    pub(super) dark: (Layers, f64),
}

/// The size of the one emission that tells a cut of the answer from one of the emission.
const ONE_LARGE: f64 = 1e4;
/// Residuals that change sign so often have no trend.
const CHANGES: f64 = 0.25;
/// Some hundred times the least number of binary16.
const SUBNORMAL: f64 = 2e-5;
/// Scatter without a trend up to this is noise.
const MOST_SCATTER: f64 = 1e-3;

/// (C, y) in ascending order, clipped ones left out.
struct Curved {
    c: Vec<f64>,
    y: Vec<f64>,
}

/// Reads off curve, cuts, quantum, format; the answers to all sizes may have been `asked` before.
pub(super) fn output(
    session: &mut Session<'_>,
    state: &State,
    noise: f64,
    asked: Option<Vec<f64>>,
) -> Result<Mapped, NotIdentified> {
    let mut sizes = sizes();
    if session.is_narrow() {
        // 0 is the first before they are mixed.
        sizes.sort_by(f64::total_cmp);
        sizes = sizes.into_iter().step_by(3).collect();
    }
    let many = match asked {
        Some(answers) => answers,
        None => constants(session, &sizes)?,
    };
    let mut pairs: Vec<(f64, f64)> = sizes.iter().copied().zip(many).collect();
    pairs.sort_by(|u, v| u.0.total_cmp(&v.0));
    let (c, y): (Vec<f64>, Vec<f64>) = pairs.into_iter().unzip();
    if y.windows(2)
        .any(|w| w[1] - w[0] < -2.0 * noise * w[1].abs())
    {
        let reason = if noise > 0.0 {
            "answers scatter too much to tell how they rise with the emission"
        } else {
            "answers do not rise with the emission"
        };
        return Err(NotIdentified::new(reason).with_curve(&c, &y));
    }
    let negative = if session.positive {
        None
    } else {
        constants(session, &[-0.5, -0.25, -0.125]).ok()
    };
    let mut answers = Answers {
        noise,
        ..Answers::default()
    };
    let every: Vec<f64> = y.iter().chain(negative.iter().flatten()).copied().collect();
    let quantum = quantum(&every);
    answers.output.quantum = quantum;
    if quantum.is_none() {
        answers.unit = Precision::of(&every).unit();
    }
    let mut mapped = Mapped {
        answers,
        emission_max: None,
        emission_min: None,
        brackets: Vec::new(),
        takes_negative: negative.is_some(),
        // 0 is the smallest size.
        dark: (even(session), y[0]),
    };
    let mut curved = Curved { c, y };
    let top = cut_above(session, &mut mapped, &mut curved)?;
    cut_below(session, &mut mapped, &curved, negative.as_deref())?;
    curve(&mut mapped, &curved, state)?;
    if let Some(top) = top {
        emission_cut(&mut mapped, &curved, top);
    }
    if mapped.answers.output.curve != Curve::Linear && mapped.answers.output.low == Some(0.0) {
        // A root of what is negative has no value to begin with.
        mapped.answers.output.low = None;
    }
    Ok(mapped)
}

/// Where the line of the radiances reaches that of the largest answer.
fn emission_cut(mapped: &mut Mapped, curved: &Curved, top: f64) {
    let answers = &mut mapped.answers;
    let last = curved.c.len() - 1;
    let (zero, far) = (
        answers.radiance(curved.y[0]),
        answers.radiance(curved.y[last]),
    );
    let most = answers.radiance(top);
    let gain = (far.value - zero.value) / curved.c[last];
    let part = far.error / far.value.abs() + most.error / most.value.abs();
    let within = part + 64.0 * answers.unit + 2.0 * answers.noise;
    let cut = (most.value - zero.value) / gain;
    let bracket = (cut * (1.0 - within), cut * (1.0 + within));
    mapped
        .brackets
        .push(Bracket::of(Parameter::EmissionHigh, bracket));
    let cut = simplest_near(cut, within);
    mapped.emission_max = Some(cut);
    answers.emission_max = cut;
}

/// Answers that no emission raises: a cut of the answer, or the largest answer where it is one of the emission.
fn cut_above(
    session: &mut Session<'_>,
    mapped: &mut Mapped,
    curved: &mut Curved,
) -> Result<Option<f64>, NotIdentified> {
    let count = curved.y.len();
    let (top, before) = (curved.y[count - 1], curved.y[count - 4]);
    if top.to_bits() != before.to_bits() || top <= curved.y[0] {
        return Ok(None);
    }
    let layers = even(session);
    let n = layers.count();
    // Near the eye, in the middle, and far from it: little may shine through.
    let mut large = Vec::new();
    for at in [1, n / 2, n - 2] {
        let (mut edge, mut middle) = (Emission::even(n, 0.0), Emission::even(n, 0.0));
        edge.edges[at] = ONE_LARGE;
        middle.middles[at] = ONE_LARGE;
        large.extend([edge, middle]);
    }
    let ray = session.ray(&layers, &large);
    let lit = session.ask(&ray)?;
    let keep = curved.y.iter().filter(|y| **y < top).count();
    let reached = lit.iter().fold(f64::NEG_INFINITY, |m, y| m.max(*y));
    let of_emission = reached < 0.9 * top;
    if !of_emission {
        mapped.answers.output.high = Some(top);
    }
    curved.c.truncate(keep);
    curved.y.truncate(keep);
    if keep < 4 {
        return Err(NotIdentified::new("nearly every emission has one answer"));
    }
    Ok(of_emission.then_some(top))
}

/// Negative emissions that have one answer: a cut of the answer or of the emission.
fn cut_below(
    session: &mut Session<'_>,
    mapped: &mut Mapped,
    curved: &Curved,
    negative: Option<&[f64]>,
) -> Result<(), NotIdentified> {
    let Some(negative) = negative else {
        return Ok(());
    };
    let low = negative[0];
    let alike = negative.iter().all(|y| y.to_bits() == low.to_bits());
    if !alike || low > curved.y[0] {
        return Ok(());
    }
    // One negative emission among positive ones: a sum that stays positive is cut nowhere.
    let layers = even(session);
    let n = layers.count();
    // Near the eye, in the middle, and far from it: in one of them it shows.
    let mut pairs = Vec::new();
    for at in [1, n / 2, n - 2] {
        for c in [-0.25, 0.0] {
            let mut mixed = Emission::even(n, 0.5);
            (mixed.edges[at], mixed.middles[at]) = (c, c);
            pairs.push(mixed);
        }
    }
    let ray = session.ray(&layers, &pairs);
    let y = session.ask(&ray)?;
    if y.chunks(2)
        .all(|pair| pair[0].to_bits() == pair[1].to_bits())
    {
        mapped.emission_min = Some(0.0);
    } else {
        mapped.answers.output.low = Some(low);
    }
    Ok(())
}

/// The simplest curve that makes answers affine in C.
fn curve(mapped: &mut Mapped, curved: &Curved, state: &State) -> Result<(), NotIdentified> {
    let answers = &mut mapped.answers;
    let allowed = 1.0;
    let straight = bent(answers, Curve::Linear, curved);
    if straight.worst <= allowed {
        return Ok(());
    }
    if straight.relative < MOST_SCATTER
        && straight.changes > CHANGES
        && answers.output.quantum.is_none()
        && !state.seed
    {
        answers.noise = answers.noise.max(2.0 * straight.relative);
        return Ok(());
    }
    for curve in [Curve::Srgb, Curve::Reinhard, Curve::Exposure] {
        if bent(answers, curve, curved).worst <= allowed {
            answers.output.curve = curve;
            let flattens = matches!(curve, Curve::Reinhard | Curve::Exposure);
            if flattens && answers.output.high == Some(1.0) {
                // Where it rounds to 1, and no cut.
                answers.output.high = None;
            }
            return Ok(());
        }
    }
    if let Some((power, within)) = power(answers, curved) {
        answers.output.curve = Curve::Gamma(power);
        let bracket = (power * (1.0 - within), power * (1.0 + within));
        mapped.brackets.push(Bracket::of(Parameter::Gamma, bracket));
        return Ok(());
    }
    Err(NotIdentified::new(
        "the answer to emission that is the same everywhere is neither linear in it nor a known curve of it",
    )
    .with_curve(&curved.c, &curved.y))
}

/// How far answers are from affine under a curve.
struct Bent {
    /// In parts of what rounding explains.
    worst: f64,
    /// In parts of the answers.
    relative: f64,
    /// Part of neighbours whose residuals differ in sign.
    changes: f64,
}

fn bent(answers: &Answers, curve: Curve, curved: &Curved) -> Bent {
    let none = Bent {
        worst: f64::INFINITY,
        relative: f64::INFINITY,
        changes: 0.0,
    };
    let quantum = answers.output.quantum;
    let bare = Output {
        curve,
        ..Output::default()
    };
    let x: Vec<f64> = curved.y.iter().map(|y| curve.inverse(*y)).collect();
    if !x.iter().all(|x| x.is_finite()) {
        return none;
    }
    // Where a curve flattens, answers say little: the gain comes from the largest emission that is known well.
    let trial = Answers {
        output: Output {
            curve,
            ..answers.output
        },
        ..answers.clone()
    };
    let sure = |k: &usize| trial.radiance(curved.y[*k]).error <= 1e-4 * x[*k].abs();
    let last = (1..x.len()).rev().find(sure).unwrap_or(x.len() - 1);
    let gain = (x[last] - x[0]) / (curved.c[last] - curved.c[0]);
    let mut bent = Bent {
        worst: 0.0,
        relative: 0.0,
        changes: 0.0,
    };
    let mut residuals = Vec::new();
    for (c, y) in curved.c.iter().zip(&curved.y) {
        let model = bare.of(gain * c + x[0]);
        let residual = model - y;
        let known = trial.radiance(curved.y[last]).error / x[last].abs().max(1e-300);
        let steep = (bare.of((gain * c + x[0]) * (1.0 + known)) - model).abs();
        let rounding = 256.0 * answers.unit * y.abs() + answers.noise * y.abs() + 4.0 * steep;
        let rounding = rounding + 1e-300;
        let rounding = rounding + quantum.map_or(0.0, |q| 2.01 * q);
        // What is left of small terms where numbers end.
        let rounding = rounding + if answers.unit > 1e-4 { SUBNORMAL } else { 0.0 };
        bent.worst = bent.worst.max((residual / rounding).abs());
        bent.relative = bent.relative.max((residual / (y.abs() + 1e-9)).abs());
        residuals.push(residual);
    }
    let inner = &residuals[1..residuals.len().max(2) - 1];
    let changes = inner.windows(2).filter(|w| w[0] * w[1] < 0.0).count();
    bent.changes = changes as f64 / inner.len().max(1) as f64;
    bent
}

/// The exponent of a power that makes answers proportional to C, and the part of it within which it lies.
fn power(answers: &Answers, curved: &Curved) -> Option<(f64, f64)> {
    let rising: Vec<(f64, f64)> = curved
        .c
        .iter()
        .zip(&curved.y)
        .filter(|(c, y)| **c > 0.02 && **y > 0.0)
        .map(|(c, y)| (c.ln(), y.ln()))
        .collect();
    let (first, last) = (rising.first()?, rising.last()?);
    if rising.len() < 3 {
        return None;
    }
    let score = |p: f64| bent(answers, Curve::Gamma(p), curved).worst;
    let rough = (last.1 - first.1) / (last.0 - first.0);
    if !(rough > 0.05 && rough < 20.0) {
        return None;
    }
    let (mut best, mut width) = (rough, 0.02 * rough);
    for _ in 0..14 {
        let grid = (-10..=10).map(|k| best + f64::from(k) / 10.0 * width);
        best = grid.min_by(|u, v| score(*u).total_cmp(&score(*v)))?;
        width /= 5.0;
    }
    if score(best) > 100.0 {
        return None;
    }
    // The exponents that explain the answers are those between: its bracket.
    let mut within = 1e-15;
    while within < 1e-2 && score(best * (1.0 + within)).min(score(best * (1.0 - within))) <= 1.0 {
        within *= 2.0;
    }
    let inverse = 1.0 / simplest_near(1.0 / best, within);
    let candidates = [simplest_near(best, within), inverse, best];
    let fits = candidates.into_iter().find(|p| score(*p) <= 1.0)?;
    Some((fits, within))
}

/// The largest 1/(2^b − 1) or 2^(−b), 4 ≤ b ≤ 16, that all answers are multiples of.
pub(super) fn quantum(answers: &[f64]) -> Option<f64> {
    let mut sizes: Vec<f64> = answers
        .iter()
        .map(|y| y.abs())
        .filter(|y| *y > 0.0)
        .collect();
    sizes.sort_by(f64::total_cmp);
    sizes.dedup();
    if sizes.len() < 6 {
        return None;
    }
    for bits in 4..=16_u32 {
        let levels = f64::from(bits).exp2();
        for levels in [levels - 1.0, levels] {
            let multiple = |y: &f64| {
                let count = y * levels;
                (count - count.round()).abs() < 1e-6 * y.max(1.0)
            };
            if sizes.iter().all(multiple) && sizes[0] * levels < 4096.0 {
                let common = sizes.iter().fold(0.0, |g, y| gcd(g, (y * levels).round()));
                return Some(common / levels);
            }
        }
    }
    None
}

/// Of whole numbers.
fn gcd(a: f64, b: f64) -> f64 {
    if b < 0.5 { a } else { gcd(b, a % b) }
}
