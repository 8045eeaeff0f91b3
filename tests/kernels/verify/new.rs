//! What volver writes to begin with is a kernel, and nothing of anybody's is lost.

use super::run::volver;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Writes one, runs its own test and puts it to the test; `test` and `kernel` are words in its directory.
fn begins(language: &str, tests: &[&[&str]], kernel: &[&str], file: &str) {
    let folder = tempfile::tempdir().unwrap();
    let directory = folder.path().join("deep/kernel");
    let shown = directory.to_str().unwrap();
    let new = ["new", language, shown];
    volver(&new).with_code(0).shows("volver verify");
    for words in tests {
        let (program, arguments) = words.split_first().unwrap();
        let mut command = Command::new(program);
        command.args(arguments).current_dir(&directory);
        let output = command.env_remove("CARGO_TARGET_DIR").output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{words:?}\n{said}");
        assert!(!said.contains("warning"), "{said}");
    }
    let paths: Vec<String> = kernel.iter().map(|word| word.replace('@', shown)).collect();
    let paths: Vec<&str> = paths.iter().map(String::as_str).collect();
    let verified = volver(&[&["verify", "--cases", "paper,thick"], &paths[..]].concat());
    verified
        .with_code(0)
        .shows("samples in the middle of segments");
    // A second time nothing of it changes, and nothing else is written.
    let kept = directory.join(file);
    fs::write(&kept, "mine").unwrap();
    let before = names(&directory);
    let refused = volver(&new).with_code(2);
    assert!(
        refused
            .err
            .contains("is there already (allowed: a directory without "),
        "{}",
        refused.err
    );
    assert_eq!(fs::read_to_string(&kept).unwrap(), "mine");
    assert_eq!(names(&directory), before);
}

fn names(directory: &Path) -> Vec<std::ffi::OsString> {
    let mut names: Vec<_> = fs::read_dir(directory)
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    names.sort();
    names
}

#[test]
fn in_python() {
    begins(
        "python",
        &[&["python3", "test_kernel.py"]],
        &["python3", "@/kernel.py"],
        "kernel.py",
    );
}

#[test]
fn in_c() {
    begins(
        "c",
        &[&["make", "kernel", "test"]],
        &["@/kernel"],
        "kernel.c",
    );
}

#[test]
fn in_rust() {
    let cargo = env!("CARGO");
    let tests: [&[&str]; 2] = [
        &[cargo, "test", "--offline", "--quiet"],
        &[cargo, "build", "--offline", "--quiet"],
    ];
    begins("rust", &tests, &["@/target/debug/kernel"], "src/main.rs");
}

#[test]
fn what_is_said_to_come_next_runs_as_it_stands() {
    let folder = tempfile::tempdir().unwrap();
    let directory = folder.path().join("my renderer's");
    let run = volver(&["new", "python", directory.to_str().unwrap()]).with_code(0);
    let line = run.out.lines().find(|line| line.contains("test_kernel.py"));
    let status = Command::new("sh").args(["-c", line.unwrap()]).output();
    let output = status.unwrap();
    assert!(output.status.success(), "{output:?}");
}

#[test]
fn a_single_file_that_is_there_is_enough_to_refuse() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("volver_kernel.py"), "mine").unwrap();
    let run = volver(&["new", "python", folder.path().to_str().unwrap()]).with_code(2);
    assert!(
        run.err.contains("volver_kernel.py' is there already"),
        "{}",
        run.err
    );
    assert_eq!(names(folder.path()), ["volver_kernel.py"]);
}

#[test]
fn what_cannot_be_written_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    let run = volver(&["new", "python", file.to_str().unwrap()]).with_code(2);
    assert!(
        run.err.contains("cannot create the directory"),
        "{}",
        run.err
    );
    let run = volver(&["new", "perl", "x"]).with_code(2);
    assert!(
        run.err.contains("(allowed: python, c, rust)"),
        "{}",
        run.err
    );
}
