//! The stages, one after the other: each reads a part off, and knows of those before it alone.

use super::accumulation::accumulation;
use super::deviation::right_of;
use super::ends::{self, Lone, Vacuum};
use super::exponential::exponential;
use super::influence::{self, Influence};
use super::number::simplest;
use super::opacity::{self, measure::Measurer};
use super::output::Mapped;
use super::places::{self, Places, Samples};
use super::rule::{Channels, End, Lattice, Law, Rule, Scheme, StopBy, Wall, Whole};
use super::session::Session;
use super::state::Name;
use super::transmittance::transmittance;
use super::weights::Answers;
use super::{
    Bracket, Identification, NotIdentified, Parameter, VacuumFails, channels, depths, free_places,
    holdout, output, pose, scattered, seams, segment, state, volume,
};
use crate::kernel::FormKind;

/// What stages of one sample a segment have found.
struct Sampled {
    rule: Rule,
    grain: f64,
    typical: f64,
    vacuum: Vacuum,
    /// The extinction at which the length of the last segment is looked for.
    last: f64,
}

pub(super) fn run(
    session: &mut Session<'_>,
    found: &mut Identification,
) -> Result<(), NotIdentified> {
    let lean = session.is_narrow() || session.is_short();
    let (state, noise) = state::state(session, &mut found.state)?;
    found.parts.noise = noise;
    found.state = Some(state.clone());
    // In order among 63 they are in order among three: where there are few rays, the ray of the output's map says both.
    let is_one_ray = session.width() >= channels::sizes().len();
    let asked = if session.is_short() && is_one_ray && noise == 0.0 && !state.seed {
        channels::in_order(session)
    } else {
        None
    };
    let channels = if asked.is_some() {
        Channels::Straight
    } else {
        let (channels, odd) = channels::channels(session, &state, noise)?;
        found.not_identified.extend(odd);
        channels
    };
    session.channels = channels;
    found.parts.channels = Some(channels);
    let mapped = output::output(session, &state, noise, asked)?;
    let answers = mapped.answers.clone();
    found.brackets.clone_from(&mapped.brackets);
    found.parts.output = Some(answers.output);
    found.parts.unit = Some(answers.unit);
    found.parts.noise = answers.noise;
    // What the seed changes by next to nothing is no place.
    if state.seed && noise == 0.0 {
        found.scattered = Some(scattered::scattered(session, &answers)?);
        return Ok(());
    }
    let start = Start {
        mapped: &mapped,
        poses: pose::Pose::new(session.pose.form),
        divides: session.divides,
        by_name: state.name != Name::Nothing,
    };
    let lean = lean | look(session, &answers, found)?;
    let even = places::even(session, &answers, false)?;
    let before = found.clone();
    let plain = read(session, found, &start, &even, lean);
    if lean || (plain.is_ok() && found.hold_out.is_whole()) {
        return plain;
    }
    // It may be the samples between blocks of segments.
    let Ok(Some(spread)) = start.seams(session, &even) else {
        return plain;
    };
    let mut seamed = Identification {
        spent: found.spent,
        ..before
    };
    session.pose.places = pose::Known::Spread(spread);
    let even = places::even(session, &answers, false);
    let again = even.map(|even| read(session, &mut seamed, &start, &even, lean));
    (session.pose, session.divides) = (start.poses, start.divides);
    if matches!(again, Ok(Ok(()))) && seamed.hold_out.is_whole() {
        *found = seamed;
        return Ok(());
    }
    plain
}

/// What is known before any place is.
struct Start<'a> {
    mapped: &'a output::Mapped,
    /// How rays are put that know nothing.
    poses: pose::Pose,
    divides: bool,
    /// A ray of the name of another has another answer.
    by_name: bool,
}

impl Start<'_> {
    /// Samples that are left out, or taken twice, in a kernel that is given segments.
    fn seams(
        &self,
        session: &mut Session<'_>,
        even: &places::Even,
    ) -> Result<Option<pose::Spread>, NotIdentified> {
        if self.poses.form != FormKind::Segments {
            return Ok(None);
        }
        seams::seams(session, &self.mapped.answers, even)
    }
}

/// Reads the rule off behind what is known, and holds it out.
fn read(
    session: &mut Session<'_>,
    found: &mut Identification,
    start: &Start<'_>,
    even: &places::Even,
    lean: bool,
) -> Result<(), NotIdentified> {
    let mapped = start.mapped;
    let answers = mapped.answers.clone();
    let base = Rule {
        emission_max: mapped.emission_max,
        emission_min: mapped.emission_min,
        lattice: session.pose.lattice(),
        output: answers.output,
        channels: session.channels,
        ..Rule::default()
    };
    let mut sampled = match places::places(session, &answers, even)? {
        Places::Several(last) => several(session, mapped, &base, last, found)?,
        Places::Samples(samples) => {
            found.parts.place = Some(samples.place);
            match influence::influence(session, &answers, even, &samples)? {
                Influence::Several => several(session, mapped, &base, End::Once, found)?,
                Influence::Own { whole } => {
                    let measurer = Measurer {
                        answers: &answers,
                        samples: &samples,
                        whole,
                        subtracts: false,
                    };
                    one_sample(session, &measurer, (mapped, &base), found, lean)?
                }
            }
        }
    };
    if let pose::Known::Spread(spread) = session.pose.places {
        sampled.rule.sequence.seam = Some(spread.seam);
        // The last segment is that of the ray as it is.
        (session.pose, session.divides) = (start.poses, start.divides);
        let answers = Answers {
            grain: sampled.grain,
            ..answers.clone()
        };
        sampled.rule = last_step(session, &answers, sampled.rule, sampled.last, found)?;
    }
    let fails = &sampled.vacuum;
    found.parts.vacuum_fails = match (fails.part_fails, fails.whole_fails) {
        (true, _) => Some(VacuumFails::Segment),
        (false, true) => Some(VacuumFails::Ray),
        (false, false) => None,
    };
    found.parts.grain = sampled.grain;
    let answers = Answers {
        grain: sampled.grain,
        ..answers
    };
    let right = right_of(&sampled.rule);
    let terms = holdout::Terms {
        answers: &answers,
        typical: sampled.typical,
        no_vacuum: fails.part_fails,
        by_name: start.by_name,
        negative: mapped.takes_negative,
        right: (right != sampled.rule).then_some(&right),
    };
    // What was found out is tried on rays that know nothing of it.
    (session.pose, session.divides) = (start.poses, start.divides);
    found.hold_out = match &found.optics {
        Some(optics) => volume::hold_out(session, &sampled.rule, optics, &terms)?,
        None => holdout::hold_out(session, &sampled.rule, &terms)?,
    };
    if found.hold_out.is_whole()
        && !lean
        && found.optics.is_none()
        && sampled.rule.lattice.is_none()
        && sampled.rule.sequence.seam.is_none()
    {
        let thin = sampled.typical / 32.0;
        found.accumulation = accumulation(session, &sampled.rule, &answers, thin)?;
        let precision = found.hold_out.precision;
        found.exponential = exponential(session, &sampled.rule, precision, sampled.typical)?;
        // Where segments are rounded more than answers it is not T that shows, and elsewhere T is no longer a product.
        if answers.noise == 0.0 && answers.grain == 0.0 && !found.parts.subtracts {
            found.transmittance = transmittance(session, &sampled.rule, precision)?;
        }
    }
    found.rule = Some(sampled.rule);
    Ok(())
}

/// Where a kernel looks that may look anywhere; rays are made for these places from then on. Whether it takes so many
/// samples only.
fn look(
    session: &mut Session<'_>,
    answers: &Answers,
    found: &mut Identification,
) -> Result<bool, NotIdentified> {
    let lattice = match session.pose.form {
        FormKind::Segments => return Ok(false),
        FormKind::Volume => {
            let optics = volume::optics(session, answers)?;
            session.pose.places = pose::Known::Volume(optics);
            found.optics = Some(optics);
            optics.lattice
        }
        FormKind::Formula(_) | FormKind::Function => match free_places::places(session, answers)? {
            free_places::Places::Nodes => return Ok(false),
            free_places::Places::Lattice(lattice) => {
                session.pose.places = pose::Known::Lattice(lattice);
                lattice
            }
        },
    };
    let Lattice::Even { count, .. } = lattice else {
        return Ok(false);
    };
    session.divides = true;
    if count.each == 0 {
        session.most_samples = count.of(1);
    }
    Ok(count.each == 0)
}

/// The rule of segments with several values.
fn several(
    session: &mut Session<'_>,
    mapped: &Mapped,
    base: &Rule,
    last: End,
    found: &mut Identification,
) -> Result<Sampled, NotIdentified> {
    let answers = &mapped.answers;
    let (scheme, wall) = segment::segments(session, answers, last)?;
    let mut rule = Rule {
        scheme,
        wall,
        ..base.clone()
    };
    rule.sequence.last = last;
    let vacuum = ends::failures(session, 1.0 / 8.0)?;
    let known: Vec<_> = vacuum.dark.iter().chain([&mapped.dark]).collect();
    let has_vacuum = !vacuum.whole_fails;
    let behind = ends::behind(session, answers, 1.0 / 8.0, &rule, has_vacuum, &known)?;
    (rule.background, rule.offset) = (behind.background, behind.offset);
    let other = depths::other_depths(session, &rule, answers)?;
    found.not_identified.extend(other);
    Ok(Sampled {
        rule,
        grain: 0.0,
        typical: 1.0,
        vacuum,
        last: 1.0,
    })
}

/// The rule of one sample a segment.
fn one_sample(
    session: &mut Session<'_>,
    measurer: &Measurer<'_>,
    (mapped, base): (&Mapped, &Rule),
    found: &mut Identification,
    lean: bool,
) -> Result<Sampled, NotIdentified> {
    let samples: &Samples = measurer.samples;
    let measured = opacity::measure(session, measurer, lean)?;
    found.parts.subtracts = measured.subtracts;
    let measurer = &Measurer {
        subtracts: measured.subtracts,
        ..measurer.clone()
    };
    let reference = measured.reference(0.25).map_or(0.125, |r| r.extinction);
    let mut vacuum = ends::vacuum(session, measurer, reference)?;
    found.not_identified.extend(vacuum.odd.take());
    let fitted = opacity::law(session, measurer, &measured, vacuum.eps)?;
    let law: Law = fitted.law;
    let brackets = &mut found.brackets;
    let mut keep = |parameter, bracket: (f64, f64)| {
        brackets.push(Bracket::of(parameter, bracket));
    };
    keep(Parameter::Factor, fitted.factor);
    keep(Parameter::Scale, fitted.scale);
    for bracket in &fitted.brackets {
        keep(bracket.parameter, (bracket.low, bracket.high));
    }
    if vacuum.eps != 0.0 {
        keep(Parameter::Eps, vacuum.bracket);
    }
    let lone = Lone {
        measurer,
        law: &law,
        measured: &measured,
    };
    let mut rule = Rule {
        scheme: Scheme::Sample {
            place: samples.place,
            law: law.clone(),
        },
        sequence: samples.sequence,
        whole: measurer.whole,
        ..base.clone()
    };
    if samples.wall {
        let walled = ends::wall(session, &lone)?;
        rule.wall = Some(walled.wall);
        if let (Some(whole), Whole::One) = (walled.whole, rule.whole)
            && samples.sequence.first == End::Once
        {
            rule.whole = whole;
        }
        if matches!(walled.wall, Wall::Length(_)) {
            keep(Parameter::Wall, walled.bracket);
        }
        if let (Some(border), Scheme::Sample { law, .. }) = (walled.skips, &mut rule.scheme) {
            keep(Parameter::SkipExtinction, border);
            law.range.skip_extinction = Some(simplest(border.0, border.1));
        }
    }
    if let Some(early) = ends::early_end(session, &lone)? {
        keep(Parameter::Stop, early.bracket);
        rule.stop = Some(early.stop);
    }
    rule.sequence = ends::counts(session, &lone, &rule, lean)?;
    let has_vacuum = !vacuum.whole_fails && !vacuum.part_fails;
    let known: Vec<_> = vacuum.dark.iter().chain([&mapped.dark]).collect();
    let answers = measurer.answers;
    let behind = ends::behind(session, answers, reference, &rule, has_vacuum, &known)?;
    (rule.background, rule.offset) = (behind.background, behind.offset);
    if behind.background != 0.0 {
        keep(Parameter::Background, behind.of_background);
    }
    if behind.offset != 0.0 {
        keep(Parameter::Offset, behind.of_offset);
    }
    let answers = Answers {
        grain: fitted.grain,
        ..measurer.answers.clone()
    };
    let extinction = match rule.stop {
        // Thin enough that the last segment is reached.
        Some(stop) if stop.by == StopBy::Sum => {
            let thin = lone.with_weight(stop.under / 16.0, 0.25, f64::NAN);
            thin.map_or(6.1 * reference, |thin| thin.min(6.1 * reference))
        }
        _ => 6.1 * reference,
    };
    if !matches!(session.pose.places, pose::Known::Spread(_)) {
        rule = last_step(session, &answers, rule, extinction, found)?;
    }
    let typical = measured.reference(1.0).map_or(1.0, |r| 32.0 * r.extinction);
    Ok(Sampled {
        rule,
        grain: fitted.grain,
        typical,
        vacuum,
        last: extinction,
    })
}

/// The rule with what becomes of a shorter last segment.
fn last_step(
    session: &mut Session<'_>,
    answers: &Answers,
    rule: Rule,
    extinction: f64,
    found: &mut Identification,
) -> Result<Rule, NotIdentified> {
    if let Some(with_last) = ends::last_step(session, answers, &rule, extinction)? {
        return Ok(with_last);
    }
    found.not_identified.push(NotIdentified::new(
        "a shorter last segment counts in no known way",
    ));
    Ok(rule)
}
