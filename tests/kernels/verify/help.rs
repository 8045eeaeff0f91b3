//! Help, completions and schemas know of the commands.

use super::run::{Run, volver};
use assert_cmd::Command;
use assert_cmd::cargo::cargo_bin;

#[test]
fn the_examples_of_the_help_run() {
    let binary = cargo_bin!("volver");
    let folder = binary.parent().unwrap().display();
    let path = format!("{folder}:{}", std::env::var("PATH").unwrap());
    let shell = tempfile::tempdir().unwrap();
    for (command, count) in [("verify", 3), ("check", 2), ("ask", 4)] {
        let help = volver(&[command, "--help"]).with_code(0).out;
        assert!(
            help.lines().all(|line| line.chars().count() <= 100),
            "{help}"
        );
        let usage = format!("\nUsage: volver {command} [OPTIONS] ");
        assert!(help.contains(&usage), "{help}");
        let (_, examples) = help.split_once("Examples:\n").unwrap();
        let examples: Vec<&str> = examples
            .lines()
            .map_while(|line| line.strip_prefix("  "))
            .collect();
        assert!(examples.len() >= count, "{examples:?}");
        // One after the other: what the first saves the second reads.
        for example in examples {
            let mut command = Command::new("sh");
            command
                .args(["-c", example])
                .current_dir(shell.path())
                .env("PATH", &path);
            let run = Run::of(command).with_code(0);
            assert!(!run.out.is_empty(), "{example}");
        }
    }
}

#[test]
fn completions_know_both_commands() {
    let script = volver(&["completions", "bash"]).with_code(0).out;
    for words in [
        "subcmd__verify",
        "subcmd__check",
        "--start-timeout",
        "--replicas",
    ] {
        assert!(script.contains(words), "{words}");
    }
}

#[test]
fn the_schema_of_the_protocol_is_printed() {
    let run = volver(&["schema", "protocol"]).with_code(0);
    let schema = run.json();
    assert!(schema["$schema"].as_str().unwrap().contains("2020-12"));
    assert!(run.out.contains("far_wall"));
    let kept = std::fs::read_to_string(super::run::in_repository("docs/protocol.schema.json"));
    assert_eq!(kept.unwrap(), run.out);
}
