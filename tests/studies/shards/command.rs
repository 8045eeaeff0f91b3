//! `volver study --shard`, `--on` and `volver merge` keep their contract.

use assert_cmd::cargo::cargo_bin;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

const STUDY: &str = "study --cases sine-squared,tent,thick --methods trapezoid/trapezoid,simpson/simpson --formats f32,mpfr:70 --levels 8..64";

/// Exit code, standard output, standard error.
fn volver(folder: &Path, arguments: &str) -> (i32, String, String) {
    let mut command = Command::new(cargo_bin!("volver"));
    command.args(arguments.split(' ')).current_dir(folder);
    // No engine of this machine is asked.
    command.env("PATH", folder);
    let output = command.output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (
        output.status.code().unwrap(),
        text(output.stdout),
        text(output.stderr),
    )
}

fn study(folder: &Path, more: &str) -> (i32, String, String) {
    volver(folder, &format!("{STUDY} {more}"))
}

/// Every file of a directory, its command replaced where it is said.
fn files(directory: &Path, name: &str) -> Vec<(String, Vec<u8>)> {
    let mut files: Vec<(String, Vec<u8>)> = fs::read_dir(directory)
        .unwrap()
        .map(Result::unwrap)
        .filter(|entry| entry.file_type().unwrap().is_file())
        .map(|entry| {
            let mut bytes = fs::read(entry.path()).unwrap();
            let file = entry.file_name().into_string().unwrap();
            if ["study.md", "index.html"].contains(&file.as_str()) {
                let text = String::from_utf8(bytes).unwrap();
                bytes = text.replace(&format!("--out {name}"), "--out DIR").into();
            }
            (file, bytes)
        })
        .filter(|(file, _)| file != "shards.json")
        .collect();
    files.sort();
    files
}

#[test]
fn shards_are_joined_as_one_process_writes_them() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let (code, table, _) = study(at, "--out one");
    for shard in [3, 1] {
        let (code, said, _) = study(at, &format!("--out many --shard {shard}/3"));
        assert_eq!(
            (code, said),
            (
                0,
                format!("shard {shard} of 3: 2 units, in many/shards/{shard}-of-3.jsonl\n")
            )
        );
    }
    let missing = "2 of 6 units missing, of shard 2 of 3, the first tent in f32\n\
                   again: the command that made them, with --on ENGINE --shards 3 --only 2\n";
    assert_eq!(volver(at, "merge many"), (1, missing.into(), String::new()));
    assert!(!at.join("many/study.jsonl").exists());
    assert_eq!(study(at, "--out many --shard=2/3 --threads 1").0, 0);
    let (merged, joined, _) = volver(at, "merge many");
    assert_eq!((merged, joined.replace("many", "one")), (code, table));
    assert_eq!(
        files(&at.join("many"), "many"),
        files(&at.join("one"), "one")
    );
    // Nothing is left to do.
    let again = "shard 2 of 3: 2 units, 2 of them by earlier runs, in many/shards/2-of-3.jsonl\n";
    assert_eq!(study(at, "--out many --shard 2/3").1, again);
    assert_eq!(volver(at, "merge many --watch").0, code);
}

#[test]
fn what_cannot_be_is_named_in_one_line_and_nothing_is_lost() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let refused = |arguments: &str| {
        let (code, out, error) = study(at, arguments);
        assert_eq!((code, out), (2, String::new()), "{arguments}");
        assert_eq!(error.lines().count(), 1, "{error}");
        error
    };
    for share in ["0/0", "9/8", "0/4", "1", "1/", "-1/2", "1/x"] {
        let error = refused(&format!("--out many --shard={share}"));
        assert!(
            error.ends_with("no shard (allowed: K/N, K from 1 to N)\n"),
            "{error}"
        );
    }
    let error = refused("--out many --on shell --shards 100000");
    assert!(
        error.contains("100000 shards of 108 units (allowed: 1 to 108)"),
        "{error}"
    );
    assert!(!at.join("many").exists());
    assert_eq!(study(at, "--out many --shard 1/3 --quiet").0, 0);
    let before = files(&at.join("many/shards"), "many");
    let error = refused("--out many --shard 1/2");
    assert!(
        error.contains("many/shards.json has 3 shards, not 2 (allowed: 3, or another directory)"),
        "{error}"
    );
    let error = refused("--out many --shard 1/3 --errors total");
    assert!(
        error.contains("divides another study: its errors are split, not total"),
        "{error}"
    );
    let error = refused("--out many --on slurm --shards 3");
    assert!(
        error.contains("sbatch: it is not on the path (allowed: "),
        "{error}"
    );
    assert!(at.join("many/shards.sbatch").exists());
    let error = refused("--out many --on shell --shards 3 --only 2,4");
    assert!(
        error.contains("--only: shard 4 of 3 (allowed: 1 to 3)"),
        "{error}"
    );
    // A file of another study between them.
    assert_eq!(
        study(at, "--out other --levels 8..32 --shard 1/3 --quiet").0,
        2
    );
    let others = STUDY.replace("8..64", "8..32");
    assert_eq!(
        volver(at, &format!("{others} --out other --shard 1/3 --quiet")).0,
        0
    );
    fs::copy(
        at.join("other/shards/1-of-3.jsonl"),
        at.join("many/shards/other.jsonl"),
    )
    .unwrap();
    let (code, _, error) = volver(at, "merge many");
    assert!(
        code == 2 && error.contains("other.jsonl divides another study: its shards are "),
        "{error}"
    );
    fs::remove_file(at.join("many/shards/other.jsonl")).unwrap();
    assert_eq!(files(&at.join("many/shards"), "many"), before);
    // Another version of the program.
    let path = at.join("many/shards.json");
    let text = fs::read_to_string(&path).unwrap();
    let own = format!("\"volver\":\"{}\"", env!("CARGO_PKG_VERSION"));
    fs::write(&path, text.replacen(&own, "\"volver\":\"0.0.1\"", 1)).unwrap();
    for (code, _, error) in [
        volver(at, "merge many"),
        study(at, "--out many --shard 2/3"),
    ] {
        assert!(
            code == 2 && error.contains("those of volver 0.0.1"),
            "{error}"
        );
    }
    let (code, _, error) = volver(at, "merge nowhere");
    assert!(
        code == 2 && error.contains("nowhere/shards.json is not there"),
        "{error}"
    );
}

#[test]
fn a_shard_that_is_killed_goes_on_where_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let study = "study --cases sine-squared,tent,thick,cloud,faint --methods simpson/simpson --formats f64,mpfr:200 --levels 8..2048 --threads 1 --quiet --out many --shard 1/1";
    let mut command = Command::new(cargo_bin!("volver"));
    let running = command
        .args(study.split(' '))
        .current_dir(at)
        .stdout(Stdio::null())
        .spawn();
    let mut running = running.unwrap();
    let lines = || -> usize {
        let entries = fs::read_dir(at.join("many/shards"));
        let files = entries
            .into_iter()
            .flatten()
            .map(|entry| entry.unwrap().path());
        let texts = files.filter_map(|file| fs::read_to_string(file).ok());
        texts.map(|text| text.lines().count()).sum()
    };
    // A line is the head's.
    for _ in 0..3000 {
        if lines() >= 3 {
            break;
        }
        sleep(Duration::from_millis(2));
    }
    running.kill().unwrap();
    running.wait().unwrap();
    assert!(lines() >= 3);
    let (code, said, _) = volver(at, &study.replace(" --quiet", ""));
    let before: usize = said
        .split_once("10 units, ")
        .and_then(|(_, rest)| rest.split(' ').next()?.parse().ok())
        .unwrap_or_else(|| panic!("{said}"));
    assert!(code == 0 && (2..10).contains(&before), "{said}");
    let names = files(&at.join("many/shards"), "many")
        .into_iter()
        .map(|(name, _)| name);
    assert_eq!(names.collect::<Vec<_>>(), ["1-of-1.jsonl"]);
}

#[test]
fn a_disk_that_is_full_loses_nothing_that_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let shard = format!("{STUDY} --out many --shard 1/1");
    // Files of at most 40 blocks of 512 bytes, and no signal about it.
    let limited = format!(
        "trap '' XFSZ; ulimit -f 40; exec '{}' {shard} --quiet",
        cargo_bin!("volver").display()
    );
    let output = Command::new("sh")
        .args(["-c", &limited])
        .current_dir(at)
        .output()
        .unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(
        error.lines().count() == 1
            && error.contains(".part: ")
            && error.contains("(allowed: a file that can be read and written)"),
        "{error}"
    );
    let (code, said, _) = volver(at, &shard);
    assert_eq!(code, 0);
    assert!(
        said.contains("6 units, ") && said.contains(" of them by earlier runs"),
        "{said}"
    );
}

#[test]
fn lines_for_a_shell_run_the_shards() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let (code, lines, _) = study(at, "--out 'a --on shell --shards 2");
    assert_eq!((code, lines.lines().count()), (0, 2));
    for line in lines.lines() {
        let ran = Command::new("sh")
            .args(["-c", line])
            .current_dir(at)
            .status();
        assert!(ran.unwrap().success(), "{line}");
    }
    assert!(volver(at, "merge 'a --quiet").0 <= 1);
    assert!(at.join("'a/study.csv").exists());
}
