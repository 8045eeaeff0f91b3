//! Every method of this crate, as its own kernel: none contradicts what theory says of it, on whatever ladder.

use volver::case::catalogue;
use volver::case::manufacture::manufacture;
use volver::kernel::{BuiltIn, Subject};
use volver::method::Method;
use volver::real::FormatName;
use volver::study::Silent;
use volver::study::tradeoff::default_methods;
use volver::study::verify::{Axis, Settings, Standing, Steps, verify};

/// What runs where time is short: thin, thick, long, with a jump and with kinks, one beyond binary16's range.
const FEW: [&str; 8] = [
    "balanced-jump",
    "cloud",
    "faint-long",
    "kink-on-node",
    "rgb-transfer",
    "sine-squared",
    "spike-gaussian",
    "thick-back",
];

fn subjects(names: impl Iterator<Item = &'static str>) -> Vec<Subject> {
    let subject = |name| {
        let description = catalogue::find(name).expect("in the catalogue").unwrap();
        let channels = manufacture(&description).unwrap();
        let channels = channels.into_iter().map(|c| (c.channel, c.case)).collect();
        Subject::new(name, channels).unwrap()
    };
    names.map(subject).collect()
}

/// The default ladder, the one before it, and one whose levels are uneven.
fn ladders() -> [Settings; 3] {
    let of = |ladder: &str, steps| Settings {
        steps,
        ..Settings::new(&ladder.parse().unwrap()).unwrap()
    };
    [
        Settings::standard(Axis::Step).unwrap(),
        of("8..1024", Steps::Divide),
        of("8..1024", Steps::Uneven),
    ]
}

/// Channels of `subjects` on which a method contradicts itself.
fn contradicted(
    method: Method,
    format: FormatName,
    subjects: &[Subject],
    ladders: &[Settings],
) -> Vec<String> {
    let mut said = Vec::new();
    for settings in ladders {
        let mut kernel = BuiltIn::new(method, format);
        let found = verify(&mut kernel, subjects, settings, &Silent, &mut |_| ()).unwrap();
        let steps = settings.steps;
        if found.contradicts_declaration() {
            said.push(format!("{method}@{format}, {steps}: other values"));
        }
        if let Some(identified) = found.identification.as_ref().filter(|_| found.deviates()) {
            let deviations = &identified.examined.deviations;
            let differs = &identified.differs;
            said.push(format!(
                "{method}@{format}, {steps}: {deviations:?} {differs:?}"
            ));
        }
        // Methods for polynomials fail on other cases.
        let lines = found.lines.iter();
        let bad = lines.filter(|line| line.standing == Standing::Contradicted);
        said.extend(bad.map(|line| {
            let steps = settings.steps;
            let verdict = line.measured.verdict();
            let order = line.measured.order();
            let (name, expected) = (&line.name, line.expected);
            format!(
                "{method}@{format}, {steps}: {name} {verdict} {order:?} of {expected:?} {:?}",
                line.remarks
            )
        }));
    }
    said
}

/// Each on one ladder, in turn: on all of them it takes minutes.
#[test]
fn no_method_contradicts_itself_in_binary64() {
    let subjects = subjects(FEW.into_iter());
    let ladders = ladders();
    let mut said = Vec::new();
    for (index, method) in default_methods().into_iter().enumerate() {
        let ladder = &ladders[index % 3..=index % 3];
        said.extend(contradicted(method, FormatName::F64, &subjects, ladder));
    }
    // Terms of both signs; an order that was read as less than 6 on uneven levels.
    for method in ["back-to-front/middle/linear", "gauss-3/boole"] {
        let method = method.parse().unwrap();
        said.extend(contradicted(method, FormatName::F64, &subjects, &ladders));
    }
    assert!(said.is_empty(), "{}", said.join("\n"));
}

#[test]
fn no_method_contradicts_itself_in_short_formats() {
    let subjects = subjects(FEW.into_iter());
    let methods = [
        "front-to-back/middle/expm1",
        "front-to-back/front/subtraction",
        "back-to-front/middle/linear",
        "trapezoid/trapezoid",
        "gauss-3/boole",
    ];
    let said: Vec<String> = [FormatName::F32, FormatName::F16, FormatName::Bf16]
        .into_iter()
        .flat_map(|format| methods.map(|method| (method, format)))
        .flat_map(|(method, format)| {
            let method = method.parse().unwrap();
            contradicted(method, format, &subjects, &ladders()[..1])
        })
        .collect();
    assert!(said.is_empty(), "{}", said.join("\n"));
}

/// All of the catalogue, in all formats: some twenty minutes.
#[test]
#[ignore = "minutes: every method in every format on every case"]
fn no_method_contradicts_itself_anywhere() {
    let subjects = subjects(catalogue::names());
    let formats = [
        FormatName::F64,
        FormatName::F32,
        FormatName::F16,
        FormatName::Bf16,
        FormatName::Mpfr(113),
    ];
    let mut methods = default_methods();
    methods.push("back-to-front/middle/linear".parse().unwrap());
    let mut said = Vec::new();
    for format in formats {
        for method in &methods {
            said.extend(contradicted(*method, format, &subjects, &ladders()));
        }
    }
    assert!(said.is_empty(), "{}", said.join("\n"));
}
