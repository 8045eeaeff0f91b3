//! A rule against rays that it was not found with.

mod blocks;
mod compare;
mod early;
mod kinds;
mod methods;
mod ray;
mod told;

pub(super) use methods::by_method;

pub(super) use compare::{Compared, SLOPE, check_opacity, compare, of_places};

use super::precision::Precision;
use super::random::Random;
use super::ray::Ray;
use super::rule::{Rule, Scheme};
use super::session::{Session, Silence};
use super::weights::Answers;
use blocks::about_blocks;
use early::about_the_end;
use kinds::{CORE, MAKES, WALL, What};
use ray::ray;
use told::Told;

/// A kind of rays, and how the rule did on them.
#[derive(Clone, Debug, PartialEq)]
pub struct Kind {
    /// In words.
    pub name: String,
    /// Rays asked.
    pub rays: usize,
    /// Rays on which every channel agrees.
    pub agree: usize,
    /// Rays without an answer.
    pub unanswered: usize,
    /// Correct decimal digits of the answer that agrees least.
    pub digits: f64,
}

impl Kind {
    /// Whether the rule was seen to hold on rays of this kind.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.agree > 0 && self.agree + self.unanswered == self.rays
    }
}

/// A ray on which a rule fails.
#[derive(Clone, Debug)]
pub struct Miss {
    /// The ray.
    pub ray: Ray,
    /// Which channel.
    pub channel: usize,
    /// What the kernel answers.
    pub got: f64,
    /// What the rule says.
    pub want: f64,
}

/// What came of a hold-out.
#[derive(Clone, Debug, Default)]
pub struct HoldOut {
    /// Kind by kind.
    pub kinds: Vec<Kind>,
    /// Rays on which it fails.
    pub misses: Vec<Miss>,
    /// The opacities answered beside 1 − T of the rule.
    pub opacity: OpacityCheck,
    /// The digits of all answers.
    pub precision: Option<Precision>,
    /// A ray asked again at the end, or of a kernel that was started anew, had another answer.
    pub drifts: bool,
}

/// Opacities that were answered.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OpacityCheck {
    /// How many.
    pub answered: usize,
    /// How many of them are 1 − T of the whole ray.
    pub agree: usize,
    /// The largest difference.
    pub largest: f64,
}

impl HoldOut {
    /// Whether it holds on every kind.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        !self.drifts && self.kinds.len() >= FEWEST && self.kinds.iter().all(Kind::holds)
    }
}

/// A rule that holds on fewer kinds than this is not known to hold.
const FEWEST: usize = 4;

/// What is held out, beside the rule.
#[derive(Clone, Copy, Debug)]
pub(super) struct Terms<'a> {
    pub(super) answers: &'a Answers,
    /// The extinction of depth 1 in a segment of length 1, by this kernel's law.
    pub(super) typical: f64,
    /// Rays with empty segments have no answer.
    pub(super) no_vacuum: bool,
    /// It takes negative emissions.
    pub(super) negative: bool,
    /// The rule that is to be named for deviating from this one.
    pub(super) right: Option<&'a Rule>,
}

/// Asks rays of all kinds.
pub(super) fn hold_out(
    session: &mut Session<'_>,
    rule: &Rule,
    terms: &Terms<'_>,
) -> Result<HoldOut, Silence> {
    let mut random = Random::new(97);
    let mut out = HoldOut::default();
    let mut answers = Vec::new();
    let mut told = Told::default();
    for make in MAKES {
        let has_gaps = matches!(
            make.what,
            What::Gaps | What::EmptyEnd | What::EmptyEighths | What::OneName
        );
        if (has_gaps && terms.no_vacuum)
            || (make.what == What::Negative && !terms.negative)
            || (session.is_short() && !CORE.contains(&make.name))
            // Quadratures inside segments have their own end; between nodes a wall is a slope.
            || (make.what == What::Opaque(WALL)
                && (rule.lattice.is_some() || matches!(rule.scheme, Scheme::Segments { .. })))
        {
            continue;
        }
        let counts = if session.divides {
            [(false, make.whole.max(1)), (true, 0)]
        } else {
            [(false, make.whole), (true, make.partial)]
        };
        for (partial, rays) in counts {
            let rays = if session.is_short() {
                rays.min(1)
            } else {
                rays
            };
            if rays == 0 {
                continue;
            }
            let mut kind = Kind {
                name: format!(
                    "{}{}",
                    make.name,
                    if partial && make.what != What::ShortLast {
                        ", shorter last step"
                    } else {
                        ""
                    }
                ),
                rays: 0,
                agree: 0,
                unanswered: 0,
                digits: 17.0,
            };
            for turn in 0..rays {
                let ray = ray(session, &mut random, make, (partial, turn), terms);
                kind.rays += 1;
                match session.ask_any(&ray) {
                    Ok(got) => {
                        answers.extend_from_slice(&got);
                        told.hear(rule, terms, &ray, &got, has_gaps);
                        judge(rule, terms, &ray, &got, &mut kind, &mut out.misses);
                        if let Some(opacity) = session.opacity {
                            let (segments, step) = rule.cut(&ray);
                            let answers = of_places(rule, terms.answers);
                            check_opacity(
                                rule,
                                &answers,
                                (&segments, step),
                                opacity,
                                &mut out.opacity,
                            );
                        }
                    }
                    // What was asked until then counts.
                    Err(Silence::Budget(_)) if out.kinds.len() >= FEWEST => return Ok(out),
                    Err(Silence::Budget(spent)) => return Err(Silence::Budget(spent)),
                    Err(_) => kind.unanswered += 1,
                }
            }
            out.kinds.push(kind);
        }
    }
    if rule.stop.is_some() {
        let kind = about_the_end(session, rule, terms, &mut random, &mut out.misses)?;
        out.kinds.extend((kind.rays > 0).then_some(kind));
    }
    if let Some(seam) = &rule.sequence.seam {
        let of = (rule, seam);
        let kind = about_blocks(session, of, terms, &mut random, &mut out.misses)?;
        out.kinds.push(kind);
    }
    out.precision = Some(Precision::of(&answers));
    out.drifts = terms.answers.noise == 0.0 && told.changes(session);
    Ok(out)
}

/// Compares the answers to a ray with the rule's.
fn judge(
    rule: &Rule,
    terms: &Terms<'_>,
    ray: &Ray,
    got: &[f64],
    kind: &mut Kind,
    misses: &mut Vec<Miss>,
) {
    let mut agrees = true;
    let (segments, step) = rule.cut(ray);
    let rounded = of_places(rule, terms.answers);
    for (channel, compared) in compare(rule, &rounded, &segments, step, got)
        .into_iter()
        .enumerate()
    {
        kind.digits = kind.digits.min(compared.digits);
        if !compared.agrees {
            agrees = false;
            misses.push(Miss {
                ray: ray.clone(),
                channel,
                got: compared.got,
                want: compared.want,
            });
        }
    }
    kind.agree += usize::from(agrees);
}
