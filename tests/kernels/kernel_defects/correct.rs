//! Correct kernels raise no alarm.

use super::marcher::{Fault, declared, march};
use super::{run, subjects};
use volver::kernel::{BuiltIn, Closure, Kernel};
use volver::real::FormatName;
use volver::study::Silent;
use volver::study::verify::{Conclusion, Identified, Settings, verify};

const LADDERS: [(&str, bool); 3] = [("8..512", false), ("10..810x3", false), ("8..512", true)];

fn kernels() -> Vec<Box<dyn Kernel>> {
    let marcher = |method: &str, faults: &'static [Fault]| -> Box<dyn Kernel> {
        let declaration = declared(method, faults);
        Box::new(Closure::new(declaration, |task, channel| {
            march(task, channel, faults)
        }))
    };
    let built_in = |method: &str, format| -> Box<dyn Kernel> {
        Box::new(BuiltIn::new(method.parse().expect("a method"), format))
    };
    vec![
        marcher("front-to-back/front/subtraction", &[]),
        marcher("front-to-back/middle/subtraction", &[Fault::SampleMiddle]),
        marcher("front-to-back/back/subtraction", &[Fault::SampleBack]),
        marcher("front-to-back/front/linear", &[Fault::LinearOpacity]),
        marcher("front-to-back/front/linear/depths", &[Fault::Unattenuated]),
        built_in("trapezoid/trapezoid", FormatName::F64),
        built_in("simpson/simpson", FormatName::F64),
        built_in("tree/middle/expm1", FormatName::F32),
        built_in("front-to-back/middle/expm1", FormatName::F32),
        built_in("front-to-back/middle/expm1", FormatName::Mpfr(120)),
    ]
}

#[test]
fn correct_kernels_raise_no_alarm() {
    let subjects = subjects();
    for (ladder, uneven) in LADDERS {
        for kernel in &mut kernels() {
            let verification = run(kernel.as_mut(), &subjects, ladder, uneven);
            let name = &verification.declaration.method.map(|m| m.name());
            let identified = verification.identification.as_ref();
            let rule = identified
                .and_then(Identified::named)
                .map(ToString::to_string);
            let shown: Vec<String> = verification
                .lines
                .iter()
                .map(|l| {
                    format!(
                        "{} {} {:?} {:?}",
                        l.name,
                        l.measured.verdict(),
                        l.standing,
                        l.expected
                    )
                })
                .collect();
            println!(
                "{ladder} {uneven} {name:?} {:?} {rule:?} {:?}",
                verification.counts(),
                verification.as_declared()
            );
            let deviations = identified.map(|found| (&found.examined.deviations, &found.differs));
            assert!(!verification.deviates(), "{name:?} {rule:?} {deviations:?}");
            assert_eq!(
                verification.conclusion(),
                Conclusion::Confirmed,
                "{name:?} {shown:#?}"
            );
            assert_eq!(verification.findings, [], "{name:?}");
            assert!(verification.counts().confirmed >= 3, "{name:?} {shown:#?}");
        }
    }
}

/// A right kernel under a wrong claim is not confirmed, whatever it declares.
#[test]
fn an_order_that_is_not_its_own_is_not_confirmed() {
    let subjects = subjects();
    for (method, wrong) in [
        ("front-to-back/front/expm1", 2),
        ("front-to-back/middle/expm1", 1),
        ("trapezoid/trapezoid", 4),
        ("simpson/simpson", 2),
    ] {
        let mut settings = Settings::new(&"8..512".parse().unwrap()).unwrap();
        settings.expect = Some(wrong.into());
        let mut kernel = BuiltIn::new(method.parse().expect("a method"), FormatName::F64);
        let verification = verify(&mut kernel, &subjects, &settings, &Silent, &mut |_| ()).unwrap();
        let conclusion = verification.conclusion();
        assert_eq!(conclusion, Conclusion::NotConfirmed, "{method} as {wrong}");
    }
}
