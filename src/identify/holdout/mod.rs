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
use super::session::Session;
use super::silence::Silence;
use super::weights::Answers;
use crate::case::catalogue;
use blocks::about_blocks;
use early::about_the_end;
use kinds::{CORE, MAKES, Make, NEGATIVE, WALL, What};
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
    /// Of which no ray was asked yet.
    pub(super) fn of(name: String) -> Self {
        Kind {
            name,
            rays: 0,
            agree: 0,
            unanswered: 0,
            digits: 17.0,
        }
    }

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
    /// A case under whose name a ray has another answer than under one of its own.
    pub by_case: Option<String>,
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
    /// Whether it holds on every kind of rays that there are: light is not negative, and what a kernel makes of light that is
    /// changes no name.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        let mut there = self.kinds.iter().filter(|kind| kind.name != NEGATIVE);
        !self.drifts && self.kinds.len() >= FEWEST && there.all(Kind::holds)
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
    /// A ray of the name of another has another answer, as is said beside the rule.
    pub(super) by_name: bool,
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
    let mut held: Vec<(Ray, Vec<f64>)> = Vec::new();
    // Of those that a kernel is given elsewhere: one that does something of its own on a case it knows shows.
    let mut names = catalogue::names().skip(1).step_by(2);
    for make in MAKES {
        if (session.is_short() && !CORE.contains(&make.name)) || !is_asked(make, rule, terms) {
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
            let mut kind = make.kind(partial);
            for turn in 0..rays {
                let ray = ray(session, &mut random, make, (partial, turn), terms);
                let name = names.next().filter(|_| make.what != What::OneName);
                kind.rays += 1;
                match named(session, rule, terms, ray, name, &mut out.by_case) {
                    Ok((ray, got)) => {
                        answers.extend_from_slice(&got);
                        told.hear(rule, terms, &ray, &got, make.has_gaps());
                        let mut misses = Vec::new();
                        judge(rule, terms, &ray, &got, &mut kind, &mut misses);
                        let is_there = make.what != What::Negative;
                        out.misses.extend(misses.into_iter().filter(|_| is_there));
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
                        held.extend(is_there.then_some((ray, got)));
                    }
                    // What was asked until then counts.
                    Err(Silence::Budget(_)) if out.kinds.len() >= FEWEST => return Ok(out),
                    Err(Silence::Budget(spent)) => return Err(Silence::Budget(spent)),
                    Err(_) => kind.unanswered += 1,
                }
            }
            out.kinds.extend((kind.rays > 0).then_some(kind));
        }
    }
    if rule.stop.is_some() {
        match about_the_end(session, rule, terms, &mut random, &mut out.misses) {
            Ok(kind) => out.kinds.extend((kind.rays > 0).then_some(kind)),
            Err(Silence::Budget(_)) if out.kinds.len() >= FEWEST => return Ok(out),
            Err(silence) => return Err(silence),
        }
    }
    if let Some(seam) = &rule.sequence.seam {
        let of = (rule, seam);
        let kind = about_blocks(session, of, terms, &mut random, &mut out.misses)?;
        out.kinds.push(kind);
    }
    let precision = Precision::of(&answers);
    if 2.0 * precision.unit() < terms.answers.unit {
        out.kinds
            .push(again(rule, terms, precision, &held, &mut out.misses));
    }
    out.precision = Some(precision);
    out.drifts = terms.answers.noise == 0.0 && told.changes(session);
    Ok(out)
}

/// Whether a kernel that has this rule can be asked rays of that kind.
fn is_asked(make: Make, rule: &Rule, terms: &Terms<'_>) -> bool {
    match make.what {
        What::Negative => terms.negative,
        What::OneName if terms.by_name => false,
        // Quadratures inside segments have their own end; between nodes a wall is a slope.
        What::Opaque(WALL) => {
            rule.lattice.is_none() && matches!(rule.scheme, Scheme::Sample { .. })
        }
        _ => !(make.has_gaps() && terms.no_vacuum),
    }
}

/// All rays once more, where answers to these have more digits than the few had that told how they are rounded.
fn again(
    rule: &Rule,
    terms: &Terms<'_>,
    precision: Precision,
    held: &[(Ray, Vec<f64>)],
    misses: &mut Vec<Miss>,
) -> Kind {
    let answers = Answers {
        unit: precision.unit(),
        ..terms.answers.clone()
    };
    let terms = Terms {
        answers: &answers,
        ..*terms
    };
    let mut kind = Kind {
        rays: held.len(),
        ..Kind::of("any of these, to all their digits".into())
    };
    for (ray, got) in held {
        judge(rule, &terms, ray, got, &mut kind, misses);
    }
    kind
}

/// The answer to a ray under the name of a case; where the rule has another one, and this one's under a name of its own, that
/// one, and the case is kept.
fn named(
    session: &mut Session<'_>,
    rule: &Rule,
    terms: &Terms<'_>,
    ray: Ray,
    name: Option<&str>,
    by_case: &mut Option<String>,
) -> Result<(Ray, Vec<f64>), Silence> {
    let Some(name) = name else {
        let got = session.ask_any(&ray)?;
        return Ok((ray, got));
    };
    let known = Ray {
        name: name.into(),
        ..ray.clone()
    };
    let got = session.ask_any(&known)?;
    if !agrees(rule, terms, &known, &got)
        && let Ok(own) = session.ask_any(&ray)
        && agrees(rule, terms, &ray, &own)
    {
        by_case.get_or_insert(known.name);
        return Ok((ray, own));
    }
    Ok((known, got))
}

fn agrees(rule: &Rule, terms: &Terms<'_>, ray: &Ray, got: &[f64]) -> bool {
    let (segments, step) = rule.cut(ray);
    let all = compare(rule, &of_places(rule, terms.answers), &segments, step, got);
    all.iter().all(|compared| compared.agrees)
}

/// Asks one ray of a kind and compares its answers with the rule's.
fn ask_one(
    session: &mut Session<'_>,
    (rule, terms): (&Rule, &Terms<'_>),
    ray: &Ray,
    kind: &mut Kind,
    misses: &mut Vec<Miss>,
) -> Result<(), Silence> {
    kind.rays += 1;
    match session.ask_any(ray) {
        Ok(got) => judge(rule, terms, ray, &got, kind, misses),
        Err(Silence::Budget(spent)) => return Err(Silence::Budget(spent)),
        Err(_) => kind.unanswered += 1,
    }
    Ok(())
}

/// Compares the answers to a ray with the rule's; one that decides nothing is not counted.
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
    let all = compare(rule, &rounded, &segments, step, got);
    if all.iter().all(|one| one.agrees && !one.decides) {
        kind.rays -= 1;
        return;
    }
    for (channel, compared) in all.into_iter().enumerate() {
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
