//! Rays that blocks of segments fit, or just do not.

use super::kinds::{Make, USUAL};
use super::ray::ray;
use super::{Kind, Miss, Terms, ask_one};
use crate::identify::random::Random;
use crate::identify::rule::{Blocks, Rule, Seam};
use crate::identify::session::Session;
use crate::identify::silence::Silence;

/// The longest ray, and one of the many whose lengths were not counted.
const LONGEST: u64 = 2_000;
const OTHERS: [u64; 4] = [25, 37, 89, 321];

/// One ray of each length about which a seam appears, moves or vanishes.
pub(super) fn about_blocks(
    session: &mut Session<'_>,
    (rule, seam): (&Rule, &Seam),
    terms: &Terms<'_>,
    random: &mut Random,
    misses: &mut Vec<Miss>,
) -> Result<Kind, Silence> {
    let mut kind = Kind::of("of so many segments as blocks, and a few more or fewer".into());
    let count = seam.blocks.count();
    let times: &[u64] = match seam.blocks {
        Blocks::Segments(_) => &[1, 2, 3],
        // Of blocks of a part of the ray every rest is another case.
        _ => &[1, 2, 5, 11],
    };
    let about = times
        .iter()
        .flat_map(|times| [times * count - 1, times * count, times * count + 1]);
    let mut lengths: Vec<u64> = about
        .chain([seam.fewest.saturating_sub(1), seam.fewest])
        .chain(OTHERS)
        .filter(|n| (1..=LONGEST).contains(n))
        .collect();
    lengths.sort_unstable();
    lengths.dedup();
    for n in lengths {
        let Ok(n) = usize::try_from(n) else { continue };
        let make = Make {
            segments: [n, n],
            ..USUAL
        };
        let ray = ray(session, random, make, (false, 0), terms);
        ask_one(session, (rule, terms), &ray, &mut kind, misses)?;
    }
    Ok(kind)
}
