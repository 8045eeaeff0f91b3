//! Usage that is wrong is named in one line, with what is allowed.

use super::run::{METHOD, fixture, volver};
use std::fs;

fn refused(arguments: &[&str], message: &str) {
    let run = volver(&[&["verify"], arguments].concat()).with_code(2);
    assert_eq!(run.out, "", "{arguments:?}");
    let message = format!("volver: {message}");
    assert!(
        run.err.starts_with(&message),
        "{message}\ndoes not begin\n{}",
        run.err
    );
    let allowed = run.err.matches("allowed: ").count();
    assert_eq!(allowed, 1, "{}", run.err);
}

#[test]
fn bad_options_are_named() {
    for (option, value, message) in [
        (
            "--expect",
            "0",
            "invalid value '0' for '--expect <ORDER>': no order (allowed: ",
        ),
        (
            "--expect",
            "x",
            "invalid value 'x' for '--expect <ORDER>': no order (allowed: ",
        ),
        (
            "--expect",
            "-2",
            "invalid value '-2' for '--expect <ORDER>': no order (allowed: ",
        ),
        (
            "--expect",
            "1/0",
            "invalid value '1/0' for '--expect <ORDER>': no order (allowed: ",
        ),
        (
            "--replicas",
            "3",
            "invalid value '3' for '--replicas <N>': no number of seeds (allowed: 8 to ",
        ),
        (
            "--replicas",
            "x",
            "invalid value 'x' for '--replicas <N>': no number of seeds (allowed: 8 to ",
        ),
        (
            "--timeout",
            "0",
            "invalid value '0' for '--timeout <SECONDS>': no time (allowed: ",
        ),
        (
            "--start-timeout",
            "-1",
            "invalid value '-1' for '--start-timeout <SECONDS>': no time (allowed: ",
        ),
        (
            "--timeout",
            "nan",
            "invalid value 'nan' for '--timeout <SECONDS>': no time (allowed: ",
        ),
        (
            "--ladder",
            "0.1..",
            "invalid value '0.1..' for '--ladder <LADDER>': '0.1' in ladder '0.1..' is not allowed (allowed: ",
        ),
        (
            "--ladder",
            "d=0.5,0.25",
            "--ladder: a ladder of steps (allowed: numbers of segments)",
        ),
        (
            "--ladder",
            "8..1048576",
            "--ladder: 1048576 segments (allowed: 1 to 524288)",
        ),
    ] {
        refused(&[option, value, METHOD], message);
    }
    refused(
        &[],
        "the following required arguments were not provided: <KERNEL>",
    );
    refused(
        &["--json", "-", "--junit", "-", METHOD],
        "'--json -' and '--junit -' both go to standard output (allowed: one of them)",
    );
}

#[test]
fn cases_axes_and_flags_that_are_none_are_named() {
    for (option, value, message) in [
        (
            "--cases",
            "nowhere",
            "--cases: no case 'nowhere' (allowed: ",
        ),
        ("--cases", "", "--cases: no case '' (allowed: "),
        (
            "--cases",
            "@nothing",
            "--cases: no case has the tag 'nothing' (allowed: ",
        ),
        (
            "--cases",
            "rgb-transfer/pink",
            "--cases: no channel 'pink' in rgb-transfer (allowed: ",
        ),
        (
            "--cases",
            "rgb-transfer,rgb-transfer/red",
            "--cases: a case 'rgb-transfer/red' a second time (allowed: ",
        ),
        ("--cases", "no/where.toml", "no/where.toml: "),
        (
            "--axis",
            "volume",
            "invalid value 'volume' for '--axis <AXIS>' (allowed: step, grid)",
        ),
        (
            "--bogus",
            "1",
            "unexpected argument '--bogus' found (allowed: ",
        ),
    ] {
        refused(&[option, value, METHOD], message);
    }
}

#[test]
fn kernels_that_are_none_are_named() {
    for (kernel, message) in [
        (
            "method:",
            "method '': unknown inner rule or kind of method '' (allowed: ",
        ),
        (
            "method:foo/bar",
            "method 'foo/bar': unknown inner rule or kind of method 'foo' (allowed: ",
        ),
        (
            "method:tree/middle/expm1@f31",
            "unknown format 'f31' (allowed: ",
        ),
        ("./missing.so", "./missing.so: "),
    ] {
        refused(&[kernel], message);
    }
    for flag in ["--uneven", "--bogus", "-x", "--help", "more"] {
        let message = format!(
            "'{flag}' behind a method, which takes no arguments (allowed: options in front of KERNEL)"
        );
        refused(&[METHOD, flag], &message);
        let message = message.replace("a method", "a library");
        refused(&["./missing.so", flag], &message);
    }
}

#[test]
fn a_grid_is_refined_for_kernels_that_have_one() {
    let message = "the kernel takes segments (allowed with --axis grid: volume)\n";
    let run = fixture(&["--axis", "grid"], &[]).with_code(2);
    assert_eq!(
        (&run.out[..], run.err),
        ("", format!("volver: python3: {message}"))
    );
}

#[test]
fn a_case_of_a_file_may_not_be_called_as_another() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("own.toml");
    let text =
        "name = \"thick\"\nlength = 1\ndepth = \"lambda\"\nradiance = \"1 - exp(-lambda)\"\n";
    fs::write(&file, text).unwrap();
    let path = file.to_str().unwrap();
    let both = format!("thick,{path}");
    refused(
        &["--cases", &both, METHOD],
        "--cases: a case 'thick' a second time (allowed: ",
    );
    volver(&["verify", "--cases", path, METHOD]).with_code(0);
}

#[test]
fn tags_are_cases_each_once() {
    let run = volver(&[
        "verify",
        "--cases",
        "paper,sine-squared,@paper",
        "--ladder",
        "8..256",
        METHOD,
    ])
    .with_code(0);
    run.shows("2 confirmed, 0 contradicted, 0 inconclusive, 0 blind of 2 channels");
}

#[test]
fn what_no_kernel_of_the_second_version_can_be_is_refused_in_one_line() {
    for (options, declared, message) in [
        (
            &[][..],
            r#"{"protocol":3}"#,
            "the kernel's greeting: protocol 3 (allowed: 1, 2)",
        ),
        (
            &[],
            r#"{"protocol":2,"answers":["optical_depth"],"far_wall":true}"#,
            "it declares a far wall and the optical depth, which has no end there (allowed: ",
        ),
        (
            &[],
            r#"{"protocol":2,"background":true,"far_wall":true}"#,
            "it declares a far wall and a background, which is not seen behind it (allowed: ",
        ),
        (
            &["--axis", "grid"],
            r#"{"protocol":2,"answers":["opacity"],"form":"volume"}"#,
            "the kernel answers no radiance (allowed with --axis grid: ",
        ),
        // The fixture answers a radiance and nothing else.
        (
            &[],
            r#"{"protocol":2,"answers":["radiance","opacity"]}"#,
            "no 'opacity' (allowed: what the greeting declares, and all of it)",
        ),
        (
            &[],
            r#"{"protocol":2,"answers":["opacity"]}"#,
            "an undeclared 'radiance' (allowed: what the greeting declares, and all of it)",
        ),
    ] {
        let run = fixture(options, &["--declare", declared]).with_code(2);
        assert!(run.err.contains(message), "{message}\n{}", run.err);
    }
}
