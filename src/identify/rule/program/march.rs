//! The radiance of one channel, as statements.

use super::expression::{factor, number, scaled};
use super::law::{Layer, law};
use super::path::{Path, path};
use super::seam::repeated;
use super::segment::segment;
use super::used::pruned;
use super::{Function, Statement, at_least, at_most, change, curved, set, when};
use crate::identify::rule::{Output, Place, Rule, Scale, Scheme, Stop, StopBy, Wall, Whole};

/// C as it counts, where that is not C.
fn emission(rule: &Rule) -> Option<Function> {
    let mut body = Vec::new();
    body.extend(rule.emission_max.map(|most| at_most("c", most)));
    body.extend(rule.emission_min.map(|least| at_least("c", least)));
    body.extend(curved(rule.emission, "c"));
    if body.is_empty() {
        return None;
    }
    body.push(Statement::Return("c".into()));
    Some(Function {
        name: "emission",
        parameter: "c",
        body,
    })
}

/// From radiance to answer.
fn mapped(output: &Output) -> Vec<Statement> {
    let mut all = curved(output.curve, "I");
    all.extend(output.low.map(|low| at_least("I", low)));
    all.extend(output.high.map(|high| at_most("I", high)));
    all.extend(output.quantum.map(|quantum| {
        let quantum = number(quantum);
        set("I", format!("floor(I / {quantum} + 0.5) * {quantum}"))
    }));
    all
}

/// Names of what is at the samples of a rule.
struct Samples {
    /// τ of the sample, and where several make a segment of the one at the back.
    extinction: String,
    /// C of the same.
    emission: String,
    /// C in front, in the middle and at the back of a segment.
    three: [String; 3],
}

impl Samples {
    fn of(rule: &Rule, has_emission: bool) -> Samples {
        let counted = |c: &str| {
            if has_emission {
                format!("emission({c})")
            } else {
                c.into()
            }
        };
        let three = ["C_edges[i]", "C_middles[i]", "C_edges[i + 1]"].map(counted);
        let (extinction, emission) = match rule.scheme {
            Scheme::Sample {
                place: Place::Back, ..
            } => ("tau[i + 1]", "C[i + 1]"),
            Scheme::Sample { .. } => ("tau[i]", "C[i]"),
            Scheme::Segments { .. } => ("tau_edges[i + 1]", "C_edges[i + 1]"),
        };
        Samples {
            extinction: extinction.into(),
            emission: counted(emission),
            three,
        }
    }
}

/// What the segment of index i and length d does.
fn layer(rule: &Rule, samples: &Samples) -> Layer {
    match &rule.scheme {
        Scheme::Sample { law: of, .. } => {
            let (statements, weight, passes) = law(of, &samples.extinction);
            let light = match weight.as_str() {
                "1.0" => samples.emission.clone(),
                weight => format!("{} * {}", factor(weight), samples.emission),
            };
            Layer {
                statements,
                first: weight,
                light,
                passes,
            }
        }
        Scheme::Segments {
            depth,
            weights,
            scale,
        } => segment(depth, weights, *scale, &samples.three),
    }
}

/// The last segment, where it is not like the others.
fn put_wall(rule: &Rule, path: &Path, samples: &Samples, layer: Layer) -> Layer {
    let named = |mut layer: Layer| {
        layer.statements.push(set("light", layer.light));
        for (name, value) in [("w", layer.first), ("p", layer.passes)] {
            if value != name {
                layer.statements.push(set(name, value));
            }
        }
        layer.statements
    };
    let opaque = || {
        vec![
            set(
                "light",
                scaled(samples.emission.as_str(), Scale(rule.scheme.scale())),
            ),
            set("w", number(rule.scheme.scale())),
            set("p", "0.0"),
        ]
    };
    let statements = match (rule.wall, &path.is_sample) {
        (Some(Wall::Opaque), _) => {
            let mut all = path.inside.clone();
            all.extend(named(layer));
            let least = match &rule.scheme {
                Scheme::Sample { law, .. } => law.range.skip_extinction,
                Scheme::Segments { .. } => None,
            };
            let absorbs = match least {
                Some(least) => format!("{} >= {}", samples.extinction, number(least)),
                None => format!("{} > 0", samples.extinction),
            };
            all.push(when(format!("{} and {absorbs}", path.is_last), opaque()));
            all
        }
        (_, Some(is_sample)) => {
            let mut own = path.inside.clone();
            own.extend(named(layer));
            let mut behind = vec![Statement::Note("behind the ray")];
            behind.extend(opaque());
            vec![Statement::If(is_sample.clone(), own, behind)]
        }
        (wall, None) => {
            let mut all = path.inside.clone();
            if let (Some(Wall::Length(length)), Scheme::Sample { .. }) = (wall, &rule.scheme) {
                all.push(when(path.is_last.as_str(), vec![set("d", number(length))]));
            }
            all.extend(layer.statements);
            return Layer {
                statements: all,
                ..layer
            };
        }
    };
    Layer {
        statements,
        first: "w".into(),
        light: "light".into(),
        passes: "p".into(),
    }
}

/// I ← I + T L, T ← T p, and the end of the ray.
fn step(rule: &Rule, layer: &Layer) -> Vec<Statement> {
    let is_late = rule.sequence.late;
    let seen = if is_late { "before" } else { "T" };
    let added = |seen: &str| match layer.light.as_str() {
        "0.0" => change("I", '+', "0.0"),
        light => change("I", '+', format!("{seen} * {}", factor(light))),
    };
    let passes = factor(&layer.passes);
    let mut goes_on = vec![added(seen)];
    if is_late {
        goes_on.push(set("before", "T"));
    }
    goes_on.push(change("T", '*', layer.passes.as_str()));
    let Some(stop) = rule.stop else {
        return goes_on;
    };
    let under = number(stop.under);
    let scale = rule.scheme.scale();
    let own = if (scale - 1.0).abs() > 0.0 {
        format!("{} / {}", factor(&layer.first), number(scale))
    } else {
        factor(&layer.first)
    };
    if stop.by == StopBy::Sum {
        goes_on.push(change("S", '+', own.as_str()));
    }
    let ended = match stop.by {
        StopBy::Sum => format!("S + {own} >= {under}"),
        StopBy::Transmittance => format!("T * {passes} < {under}"),
        StopBy::Weight => format!("T * {} < {under}", factor(&layer.first)),
    };
    let mut ends = vec![set("ended", "1"), Statement::Break];
    let mut all = Vec::new();
    match stop {
        Stop { before: true, .. } => {
            all.push(when(ended, ends));
            all.extend(goes_on);
        }
        Stop {
            cut: true,
            by: StopBy::Sum,
            ..
        } => {
            let part = format!("{seen} * (({under} - S) / ({own}))");
            ends.insert(0, added(&part));
            all.push(when(ended, ends));
            all.extend(goes_on);
        }
        Stop { cut: true, .. } => {
            let part = added(&format!("(T - {under}) / (1 - {passes})"));
            ends.splice(0..0, [part, set("T", under)]);
            all.push(when(ended, ends));
            all.extend(goes_on);
        }
        Stop {
            by: StopBy::Transmittance,
            ..
        } => {
            all.extend(goes_on);
            all.push(when(format!("T < {under}"), ends));
        }
        Stop {
            by: StopBy::Sum, ..
        } => {
            all.extend(goes_on);
            all.push(when(format!("S >= {under}"), ends));
        }
        Stop {
            by: StopBy::Weight, ..
        } => {
            all.push(set("ended", ended));
            all.extend(goes_on);
            all.push(when("ended", vec![Statement::Break]));
        }
    }
    all
}

/// What is done with the sum.
fn finished(rule: &Rule) -> Vec<Statement> {
    let mut all = Vec::new();
    if rule.stop.is_some_and(|stop| stop.renormalised) {
        all.push(when("ended", vec![change("I", '/', "1 - T")]));
    }
    match rule.whole {
        Whole::One => {}
        Whole::ByOpacity => all.push(Statement::If(
            "T < 1".into(),
            vec![change("I", '/', "1 - T")],
            vec![set("I", "0.0")],
        )),
        Whole::TimesOpacity => all.push(change("I", '*', "1 - T")),
    }
    if rule.background.abs() > 0.0 {
        all.push(change("I", '+', format!("{} * T", number(rule.background))));
    }
    if rule.offset.abs() > 0.0 {
        all.push(change("I", '+', number(rule.offset)));
    }
    all.extend(mapped(&rule.output));
    all.push(Statement::Return("I".into()));
    all
}

/// The radiance of one channel, and the function of C that it calls.
pub(in crate::identify::rule) fn radiance(rule: &Rule) -> (Option<Function>, Vec<Statement>) {
    let emission = emission(rule);
    let samples = Samples::of(rule, emission.is_some());
    let path = path(rule);
    let layer = put_wall(rule, &path, &samples, layer(rule, &samples));
    let mut body = layer.statements.clone();
    body.extend(step(rule, &layer));
    let body = path
        .index
        .iter()
        .cloned()
        .chain(repeated(rule, path.is_sample.as_deref(), body));
    let body = body.collect();
    let mut all = vec![
        set("I", "0.0"),
        set("T", "1.0"),
        set("before", "1.0"),
        set("S", "0.0"),
        set("ended", "0"),
    ];
    all.extend(path.before);
    all.push(Statement::For(path.range, body));
    all.extend(finished(rule));
    (emission, pruned(all))
}
