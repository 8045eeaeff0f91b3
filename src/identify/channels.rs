//! Whether channels are alike, and whose answer stands where.

use super::NotIdentified;
use super::random::Random;
use super::ray::{Emission, Layers};
use super::rule::Channels;
use super::session::Session;
use super::state::State;

/// Extinction of the even rays that ask for the output's map.
pub(super) const EXTINCTION: f64 = 0.5;
/// Their length in segments: loops unrolled by 16 or 3 take all of them.
pub(super) const SEGMENTS: usize = 48;

/// 63 sizes from 2⁻²⁰ to 2¹², more of them about 1, in a random order.
pub(super) fn sizes() -> Vec<f64> {
    let mut sizes = vec![0.0];
    sizes.extend((-20..=12).map(|k| f64::from(k).exp2()));
    sizes.extend((0..29).map(|k| 0.03 + f64::from(k) * 0.085));
    let mut random = Random::new(7);
    for k in (1..sizes.len()).rev() {
        let other = random.integer(0, k);
        sizes.swap(k, other);
    }
    sizes
}

/// An even medium.
pub(super) fn even(session: &Session<'_>) -> Layers {
    Layers::of(
        0.25,
        &vec![EXTINCTION; SEGMENTS.next_multiple_of(session.multiple)],
    )
}

/// The answers to emissions that are the same everywhere, in their order.
pub(super) fn constants(
    session: &mut Session<'_>,
    sizes: &[f64],
) -> Result<Vec<f64>, NotIdentified> {
    let layers = even(session);
    let n = layers.count();
    let emission: Vec<Emission> = sizes.iter().map(|c| Emission::even(n, *c)).collect();
    let ray = session.ray(&layers, &emission);
    Ok(session.ask(&ray)?)
}

/// The answers to the emissions that the output's map is read off, where no channel has another one's; `None` where one
/// has, or there are no such answers.
pub(super) fn in_order(session: &mut Session<'_>) -> Option<Vec<f64>> {
    let sizes = sizes();
    // Without an answer, it may be too many channels.
    let answers = constants(session, &sizes).ok()?;
    let mut pairs: Vec<(f64, f64)> = sizes.into_iter().zip(answers.iter().copied()).collect();
    pairs.sort_by(|u, v| u.0.total_cmp(&v.0));
    let rises = pairs.windows(2).all(|w| w[1].1 >= w[0].1);
    let tells = pairs[0].1 < pairs[pairs.len() - 1].1;
    (rises && tells).then_some(answers)
}

/// Equal channels, one channel alone, and three different ones.
pub(super) fn channels(
    session: &mut Session<'_>,
    state: &State,
    noise: f64,
) -> Result<(Channels, Option<NotIdentified>), NotIdentified> {
    let three = constants(session, &[0.125, 0.25, 0.5])?;
    // Few rays go to what is more likely.
    if !session.is_short() && !state.seed {
        are_alike(session, noise)?;
    }
    if three[0].to_bits() == three[1].to_bits() && three[1].to_bits() == three[2].to_bits() {
        let turned = constants(session, &[0.5, 0.25, 0.125])?;
        return Err(NotIdentified::new(if turned == three {
            "the answer does not depend on the emission"
        } else {
            "all channels have the answer of one"
        })
        .with_answers(&[three, turned]));
    }
    if !session.is_short() && noise == 0.0 && !state.seed {
        let alone = constants(session, &[0.0, 0.25, 0.0])?;
        let dark = constants(session, &[0.0, 0.0, 0.0])?;
        if alone[0].to_bits() != dark[0].to_bits() || alone[2].to_bits() != dark[2].to_bits() {
            return Err(NotIdentified::new(
                "a channel's answer depends on another channel's emission",
            )
            .with_answers(&[alone, dark]));
        }
    }
    let sizes: Vec<f64> = [5, 2, 7, 1, 6, 3, 4]
        .iter()
        .map(|k| f64::from(*k) / 8.0)
        .collect();
    let seven = constants(session, &sizes)?;
    let rises = |channels: Channels, sizes: &[f64], answers: &[f64]| {
        let count = sizes.len();
        let mut pairs: Vec<(f64, f64)> = (0..count)
            .map(|k| (sizes[k], answers[channels.place(k, count)]))
            .collect();
        pairs.sort_by(|u, v| u.0.total_cmp(&v.0));
        let slack = 2.0 * noise;
        pairs
            .windows(2)
            .all(|w| w[1].1 - w[0].1 >= -slack * w[1].1.abs())
            && pairs[0].1 < pairs[count - 1].1
    };
    let all = [
        Channels::Straight,
        Channels::ReversedByThrees,
        Channels::Reversed,
    ];
    let few = |c: &&Channels| rises(**c, &[0.125, 0.25, 0.5], &three);
    let fits = |c: &&Channels| rises(**c, &sizes, &seven) && few(c);
    if let Some(found) = all.iter().find(fits) {
        return Ok((*found, None));
    }
    let reason = "answers do not rise with the channels' emissions";
    let straight = all.iter().find(few);
    let Some(found) = straight.filter(|_| session.limit_channels(three.len())) else {
        return Err(NotIdentified::new(reason).with_answers(&[three, seven]));
    };
    // Three at a time are as they should be: the others are left alone.
    let reason = format!("with 7 channels at once {reason}, with 3 they do");
    let odd = NotIdentified::new(reason).with_answers(&[seven]);
    Ok((*found, Some(odd)))
}

/// Three channels of the same emission.
fn are_alike(session: &mut Session<'_>, noise: f64) -> Result<(), NotIdentified> {
    let mut random = Random::new(3);
    let layers = even(session);
    let one = Emission::of(layers.count(), |_| random.within(0.1, 0.4));
    let ray = session.ray(&layers, &[one.clone(), one.clone(), one]);
    let same = session.ask(&ray)?;
    // Sums in another order differ by rounding.
    let rounding = 64.0 * f64::EPSILON + noise;
    if spread(&same) > rounding * same[0].abs() {
        return Err(
            NotIdentified::new("channels of the same emission have different answers")
                .with_answers(&[same]),
        );
    }
    Ok(())
}

fn spread(values: &[f64]) -> f64 {
    let (low, high) = values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| {
            (low.min(*y), high.max(*y))
        });
    high - low
}
