//! Which samples are taken, in what order, as a loop.

use super::{Range, Statement, change, seam, set, when};
use crate::identify::rule::{End, Extra, LastStep, Place, Rule, Scheme, Wall};

/// A loop over samples.
pub(super) struct Path {
    /// What is worked out before.
    pub(super) before: Vec<Statement>,
    /// The loop.
    pub(super) range: Range,
    /// The sample's index i, where it has to be known before anything else.
    pub(super) index: Vec<Statement>,
    /// The sample's index i and its length d.
    pub(super) inside: Vec<Statement>,
    /// Whether it is the last sample.
    pub(super) is_last: String,
    /// Whether there is a sample, and not what stands behind all of them.
    pub(super) is_sample: Option<String>,
}

/// Where samples are one too many.
fn extra(rule: &Rule) -> Option<(Extra, Place)> {
    let Scheme::Sample { place, .. } = rule.scheme else {
        return None;
    };
    // There is no middle beyond the ends.
    let extra = rule.sequence.extra.filter(|_| place != Place::Middle)?;
    Some((extra, place))
}

/// How many segments there are to march through, and what finds it.
fn count(rule: &Rule) -> (&'static str, Vec<Statement>) {
    let sequence = &rule.sequence;
    let mut all = Vec::new();
    if sequence.unrolled > 1 {
        all.push(set("count", format!("n - n % {}", sequence.unrolled)));
    } else {
        all.push(set("count", "n"));
    }
    if let Some(most) = sequence.most {
        let most = most.to_string();
        all.push(when(format!("count > {most}"), vec![set("count", most)]));
    }
    if sequence.last_step == LastStep::Dropped {
        let partial = "lam[n] - lam[n - 1] < step * (1 - 1e-9)";
        all.push(when(
            format!("{partial} and count > n - 1"),
            vec![set("count", "n - 1")],
        ));
    }
    if all.len() == 1 && sequence.unrolled <= 1 {
        ("n", Vec::new())
    } else {
        ("count", all)
    }
}

/// The length of segment i.
fn lengths(rule: &Rule) -> Vec<Statement> {
    let own = match rule.sequence.last_step {
        LastStep::Own | LastStep::Dropped => "lam[i + 1] - lam[i]",
        LastStep::Whole => "step",
        LastStep::Even => "lam[n] / n",
    };
    let Some((extra, place)) = extra(rule) else {
        return vec![set("d", own)];
    };
    let one_more = match extra {
        Extra::Step => "step",
        Extra::Last => "lam[n] - lam[n - 1]",
    };
    let is_own = if place == Place::Back {
        "i >= 0"
    } else {
        "i < n"
    };
    if own == one_more {
        return vec![set("d", own)];
    }
    vec![Statement::If(
        is_own.into(),
        vec![set("d", own)],
        vec![set("d", one_more)],
    )]
}

/// The loop over the samples of a rule.
pub(super) fn path(rule: &Rule) -> Path {
    let (count, mut before) = count(rule);
    before.extend(rule.sequence.seam.iter().flat_map(seam::sized));
    let sequence = &rule.sequence;
    let twice = [sequence.first, sequence.last].contains(&End::Twice);
    let one_more = extra(rule);
    let has_wall = rule.wall == Some(Wall::LastEmission);
    let is_cut = count != "n" || sequence.first != End::Once || sequence.last != End::Once;
    if twice || (is_cut && (one_more.is_some() || has_wall)) || (one_more.is_some() && has_wall) {
        return by_bounds(rule, count, before);
    }
    let backwards = sequence.swapped;
    let (mut first, mut end) = (0, 0);
    if sequence.first == End::Missing {
        first += 1;
    }
    if sequence.last == End::Missing {
        end -= 1;
    }
    match one_more {
        Some((_, Place::Back)) => first -= 1,
        Some(_) => end += 1,
        None => {}
    }
    let at = |offset: i32| match offset {
        0 => count.to_string(),
        o if o > 0 => format!("{count} + {o}"),
        o => format!("{count} - {}", -o),
    };
    let last = if backwards {
        first.to_string()
    } else {
        at(end - 1)
    };
    let mut index = Vec::new();
    let name = if has_wall { "k" } else { "i" };
    let is_sample = has_wall.then(|| {
        index.push(set("i", "k"));
        if backwards {
            first -= 1;
            "k >= 0".into()
        } else {
            end += 1;
            "k < n".into()
        }
    });
    let (index, inside) = parted(rule, is_sample.as_deref(), index);
    Path {
        before,
        range: Range {
            name,
            from: first.to_string(),
            to: at(end),
            backwards,
        },
        index,
        inside,
        is_last: format!("{name} == {last}"),
        is_sample,
    }
}

/// What has to be known before anything else, and the rest: what stands behind the ray is that of the last sample.
fn parted(
    rule: &Rule,
    is_sample: Option<&str>,
    mut index: Vec<Statement>,
) -> (Vec<Statement>, Vec<Statement>) {
    let lengths = lengths(rule);
    if rule.sequence.seam.is_none() {
        index.extend(lengths);
        return (Vec::new(), index);
    }
    match is_sample {
        Some(is_sample) => (vec![when(is_sample, index)], lengths),
        None => (index, lengths),
    }
}

/// The general loop: positions k from `begin` to `end`, of which some are the same sample.
fn by_bounds(rule: &Rule, count: &'static str, mut before: Vec<Statement>) -> Path {
    let sequence = &rule.sequence;
    let mut index = vec![set("i", "k")];
    before.extend([set("begin", "0"), set("end", count)]);
    let if_any = |statement| when("begin < end", vec![statement]);
    match sequence.first {
        End::Once => {}
        End::Missing => before.push(if_any(change("begin", '+', "1"))),
        End::Twice => {
            before.push(if_any(change("begin", '-', "1")));
            index.push(when("i < 0", vec![set("i", "0")]));
        }
    }
    match sequence.last {
        End::Once => {}
        End::Missing => before.push(if_any(change("end", '-', "1"))),
        End::Twice => {
            before.push(if_any(change("end", '+', "1")));
            let last = format!("{count} - 1");
            index.push(when(format!("i > {last}"), vec![set("i", last)]));
        }
    }
    match extra(rule) {
        Some((_, Place::Back)) => {
            before.extend([change("begin", '-', "1"), set("more", "begin")]);
            index.push(when("k == more", vec![set("i", "-1")]));
        }
        Some(_) => {
            before.extend([set("more", "end"), change("end", '+', "1")]);
            index.push(when("k == more", vec![set("i", "n")]));
        }
        None => {}
    }
    let backwards = sequence.swapped;
    let is_sample = (rule.wall == Some(Wall::LastEmission)).then(|| {
        // Behind the last of them, where there is one.
        let (wall, farther) = if backwards {
            ("begin - 1", change("begin", '-', "1"))
        } else {
            ("end", change("end", '+', "1"))
        };
        before.extend([set("wall", wall), if_any(farther)]);
        "k != wall".into()
    });
    let is_last = if backwards {
        "k == begin"
    } else {
        "k == end - 1"
    };
    let (index, inside) = parted(rule, is_sample.as_deref(), index);
    Path {
        before,
        range: Range {
            name: "k",
            from: "begin".into(),
            to: "end".into(),
            backwards,
        },
        index,
        inside,
        is_last: is_last.into(),
        is_sample,
    }
}
