//! `--batch`: many rays in one request, each beside the answer that it has alone.

use super::run::{METHOD, Run, in_repository, volver};
use serde_json::Value;

/// A short verification of the kernel that takes rays as arrays or as text.
fn verify(how: &str, mode: &str, options: &[&str]) -> (Run, Vec<String>) {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("processes");
    let file = file.to_str().unwrap();
    let script = in_repository("tests/kernels/kernel_process/framed.py");
    let head = [
        "verify",
        "--cases",
        "sine-squared",
        "--ladder",
        "8..256",
        "--expect",
        "2",
    ];
    let kernel = ["--", "python3", "-S", &script, how, mode, file];
    let run = volver(&[&head[..], options, &kernel].concat());
    let asked = std::fs::read_to_string(format!("{file}.asked")).unwrap_or_default();
    (run, asked.lines().map(Into::into).collect())
}

fn batch(how: &str, mode: &str, code: i32) -> Value {
    let options = ["--identify", "off", "--batch", "24", "--json", "-"];
    let (run, _) = verify(how, mode, &options);
    run.with_code(code).json()["batch"].clone()
}

#[test]
fn rays_that_are_not_alone_are_named_whether_they_come_as_arrays_or_as_text() {
    for how in ["frames", "json"] {
        let right = batch(how, "behaves", 0);
        assert_eq!(
            (&right["rays"], &right["differ"]),
            (&24.into(), &0.into()),
            "{right}"
        );
        assert_eq!(right["segments"][1], 64, "{right}");
        assert_eq!(right.get("name"), None);
        for (mode, name) in [
            ("step", "batch-step"),
            ("first-lengths", "batch-step"),
            ("padding", "batch-padding"),
            ("transmittance", "carried-transmittance"),
            ("sum", "batch"),
            ("last-ray", "batch"),
            ("together-dies", "batch"),
        ] {
            let found = batch(how, mode, 1);
            assert_eq!(found["name"], name, "{how} {mode}: {found}");
            let differ = found["differ"].as_u64().unwrap();
            let least = if mode == "last-ray" { 1 } else { 20 };
            assert!((least..=24).contains(&differ), "{how} {mode}: {found}");
            let first = &found["first"];
            assert_ne!(first["alone"], first["together"], "{found}");
        }
    }
}

#[test]
fn what_is_found_is_told_and_may_be_accepted() {
    let options = ["--identify", "off", "--batch", "24"];
    let (run, _) = verify("json", "padding", &options);
    let run = run.with_code(1);
    run.shows("Many rays in one request ! batch-padding: a ray that is shorter than another of its request has another answer than alone; 23 of 24 rays of ");
    run.shows("among the others radiance ");
    let (run, _) = verify(
        "json",
        "padding",
        &[&options[..], &["--accept", "batch-padding"]].concat(),
    );
    let run = run.with_code(0);
    run.shows("; this is accepted");
    let (run, _) = verify("json", "behaves", &options);
    let run = run.with_code(0);
    run.shows("* alone or together: 24 rays of ");
    run.shows(" have the same answers, to the bit");
    let (run, _) = verify(
        "json",
        "together-dies",
        &[&options[..], &["--junit", "-"]].concat(),
    );
    let run = run.with_code(1);
    run.shows(
        "rays that have answers alone have none in one request: the kernel exited with code 9",
    );
}

#[test]
fn the_levels_of_a_case_and_the_rays_of_a_batch_go_in_one_request() {
    let options = ["--identify", "off", "--batch", "24"];
    let (_, frames) = verify("frames", "behaves", &options);
    let (_, text) = verify("json", "behaves", &options);
    let rays = |asked: &[String]| -> u64 {
        let counts = asked
            .iter()
            .filter_map(|line| line.split(' ').nth(1)?.parse::<u64>().ok());
        counts.sum()
    };
    assert_eq!(
        rays(&frames),
        rays(&text),
        "as many rays: {frames:?} {text:?}"
    );
    // 8 to 256, 47 and 100 beside them, the coarsest once more; each alone, all at once.
    assert_eq!(frames[..2], ["frame 8", "frame 1"], "{frames:?}");
    assert_eq!(frames.last().unwrap(), "frame 24");
    assert_eq!(frames.len(), 2 + 24 + 1, "{frames:?}");
    assert_eq!(text.last().unwrap(), "render 24");
}

#[test]
fn a_kernel_that_takes_frames_is_identified_by_them() {
    let (run, asked) = verify("frames", "behaves", &[]);
    let run = run.with_code(0);
    run.shows("samples in the middle of segments");
    assert!(
        asked.iter().all(|line| line.starts_with("frame ")),
        "{asked:?}"
    );
}

#[test]
fn what_cannot_be_a_batch_is_refused_in_one_line() {
    for count in ["0", "1", "4097", "1000000000", "-3", "x"] {
        let run = volver(&["verify", "--batch", count, METHOD]).with_code(2);
        let words = format!(
            "volver: invalid value '{count}' for '--batch <K>': no number of rays (allowed: 2 to 4096)\n"
        );
        assert_eq!(run.err, words);
    }
    let run = volver(&["verify", "--batch", "8", METHOD]).with_code(2);
    assert_eq!(
        run.err,
        "volver: '--batch' with a method, which has no requests (allowed: with a program)\n"
    );
    let (run, asked) = verify("frames", "three", &["--batch", "4"]);
    let run = run.with_code(2);
    assert_eq!(
        run.err,
        "volver: python3: --batch 4 (allowed: 2 to 3, as the kernel declares)\n"
    );
    assert!(asked.is_empty(), "{asked:?}");
}
