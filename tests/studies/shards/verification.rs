//! A verification in shards is the one of a single machine, and the kernel is asked no ray twice.

use assert_cmd::cargo::cargo_bin;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Exit code, standard output, standard error.
fn volver(folder: &Path, arguments: &str) -> (i32, String, String) {
    let mut command = Command::new(cargo_bin!("volver"));
    command.args(arguments.split(' ')).current_dir(folder);
    let output = command.output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (
        output.status.code().unwrap(),
        text(output.stdout),
        text(output.stderr),
    )
}

/// Every file of a directory, its name replaced where a page says it.
fn files(directory: &Path, name: &str) -> Vec<(String, String)> {
    let mut files: Vec<(String, String)> = fs::read_dir(directory)
        .unwrap()
        .map(Result::unwrap)
        .filter(|entry| entry.file_type().unwrap().is_file())
        .map(|entry| {
            let text = fs::read_to_string(entry.path()).unwrap();
            let text = text.replace(&format!("--out {name}"), "--out DIR");
            (entry.file_name().into_string().unwrap(), text)
        })
        .filter(|(file, _)| file != "shards.json")
        .collect();
    files.sort();
    files
}

fn joins(folder: &Path, options: &str, kernel: &str, shards: usize, name: &str) {
    let whole = format!("one-{name}");
    let parts = format!("many-{name}");
    let code = volver(
        folder,
        &format!("verify {options} --out {whole} --quiet {kernel}"),
    )
    .0;
    assert!(code < 2);
    for shard in 1..=shards {
        let share = format!("--out {parts} --shard {shard}/{shards}");
        let (code, out, error) = volver(
            folder,
            &format!("verify {options} {share} --quiet {kernel}"),
        );
        assert_eq!((code, &*out, &*error), (0, "", ""), "{name}");
        if shard == 1 && shards > 1 {
            let (code, out, _) = volver(folder, &format!("merge {parts}"));
            assert_eq!(code, 1);
            assert!(out.contains("missing, of shard"), "{out}");
        }
    }
    let (joined, _, error) = volver(folder, &format!("merge {parts} --quiet"));
    assert_eq!((joined, &*error), (code, ""), "{name}");
    let (one, many) = (
        files(&folder.join(&whole), &whole),
        files(&folder.join(&parts), &parts),
    );
    let names = |files: &[(String, String)]| {
        files
            .iter()
            .map(|(name, _)| name.clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(names(&one), names(&many), "{name}");
    for ((file, one), (_, many)) in one.iter().zip(&many) {
        assert!(one == many, "{name}: {file}");
    }
}

#[test]
fn the_report_of_a_method_is_the_same_byte_for_byte() {
    let folder = tempfile::tempdir().unwrap();
    let cases = "--cases sine-squared,thick,rgb-transfer,jump-off-node";
    let of = |options: &str, kernel: &str, shards, name: &str| {
        joins(
            folder.path(),
            &format!("{cases} {options}"),
            kernel,
            shards,
            name,
        );
    };
    of("--uneven", "method:trapezoid/trapezoid@f32", 3, "right");
    of(
        "--expect 2 --identify full",
        "method:front-to-back/front/subtraction@f16",
        5,
        "wrong",
    );
    of(
        "--identify off --divide",
        "method:tree/front/expm1",
        2,
        "uneven",
    );
}

#[test]
fn the_report_of_a_program_is_the_same_and_it_is_not_run_to_join() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    assert_eq!(volver(at, "new python mine").0, 0);
    joins(
        at,
        "--cases sine-squared,tent --batch 8",
        "python3 mine/kernel.py --threads 2",
        4,
        "program",
    );
    joins(
        at,
        "--cases sine-squared --spacing log",
        "python3 mine/kernel.py",
        2,
        "spaced",
    );
    let before = files(&at.join("many-program"), "many-program");
    fs::remove_dir_all(at.join("mine")).unwrap();
    assert_eq!(volver(at, "merge many-program --quiet").0, 0);
    assert_eq!(files(&at.join("many-program"), "many-program"), before);
}

#[test]
fn what_is_not_that_verification_is_refused_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let verify = |options: &str, kernel: &str| {
        volver(
            at,
            &format!("verify --cases sine-squared {options} --quiet {kernel}"),
        )
    };
    let kernel = "method:trapezoid/trapezoid";
    assert_eq!(verify("--out d --shard 1/2", kernel).0, 0);
    let refused = |options: &str, kernel: &str, why: &str| {
        let (code, out, error) = verify(options, kernel);
        assert_eq!((code, &*out, error.lines().count()), (2, "", 1), "{error}");
        assert!(error.contains(why), "{error}");
    };
    refused(
        "--out d --shard 2/2",
        "method:simpson/simpson",
        "divides another verification: its kernel are",
    );
    refused(
        "--out d --shard 2/2 --divide",
        kernel,
        "divides another verification: its settings are",
    );
    refused(
        "--out d --shard 3/3",
        kernel,
        "3 shards of 2 units (allowed: 1 to 2)",
    );
    let (code, _, error) = volver(
        at,
        &format!("verify --extremes --out e --shard 1/2 {kernel}"),
    );
    assert_eq!(code, 2);
    assert!(
        error.contains("--extremes with --shard (allowed: without shards)"),
        "{error}"
    );
    let (code, _, error) = volver(at, "study --cases sine-squared --out d --shard 1/2 --quiet");
    assert_eq!(code, 2);
    assert!(
        error.contains("it divides a verification, no study"),
        "{error}"
    );
    // Answers that are there once are not asked for again, and are not altered.
    assert_eq!(verify("--out d --shard 2/2", kernel).0, 0);
    let file = fs::read_dir(at.join("d/shards"))
        .unwrap()
        .next()
        .unwrap()
        .unwrap()
        .path();
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text.replacen("53:", "54:", 1)).unwrap();
    let (code, out, _) = volver(at, "merge d");
    assert_eq!(code, 1);
    assert!(out.contains("not as it was written"), "{out}");
}
