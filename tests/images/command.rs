//! `volver image`: what renderers do wrong, in one line each.

use std::fs;
use std::path::Path;
use volver::image::{Image, file};

fn volver(arguments: &[&str]) -> (i32, String, String) {
    let done = assert_cmd::cargo::cargo_bin_cmd!("volver")
        .args(arguments)
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (
        done.status.code().unwrap(),
        text(done.stdout),
        text(done.stderr),
    )
}

/// One picture of a renderer that is a line of the shell; `$1` is the file to write.
fn shell(line: &str, options: &[&str]) -> (i32, String, String) {
    shell_at("4", line, options)
}

/// The same at these numbers of steps.
fn shell_at(steps: &str, line: &str, options: &[&str]) -> (i32, String, String) {
    let few = [
        "image", "ramp", "--axes", "step", "--steps", steps, "--cells", "4", "--side", "4",
    ];
    let program = ["--", "sh", "-c", line, "sh", "{out}", "{volume}"];
    volver(&[&few[..], options, &program[..]].concat())
}

fn refused(line: &str, options: &[&str], says: &str) {
    let (code, printed, said) = shell(line, options);
    assert_eq!((code, printed.as_str()), (2, ""), "{line}: {said}");
    assert!(
        said.contains(says) && said.lines().count() == 1,
        "{line}: {said}"
    );
}

fn picture(path: &Path, size: [usize; 2], value: f64) {
    let names = ["r", "g", "b"].map(String::from).to_vec();
    let mut image = Image::new(size[0], size[1], names);
    image.values.fill(value);
    file::write(path, &image).unwrap();
}

#[test]
fn what_is_no_picture_is_said_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    picture(&at("small.exr"), [3, 4], 0.5);
    picture(&at("right.exr"), [4, 4], 0.5);
    let whole = fs::read(at("right.exr")).unwrap();
    fs::write(at("cut.exr"), &whole[..whole.len() / 2]).unwrap();
    let copy = |name: &str| format!("cp '{}' \"$1\"", at(name).display());
    refused("true", &[], "'sh' ended well and wrote no picture.exr");
    refused(
        "echo no light >&2; exit 3",
        &[],
        "'sh' exited with code 3; the last that it said: no light",
    );
    refused("kill -9 $$", &[], "'sh' was killed by signal 9");
    refused(
        "sleep 100 & sleep 100",
        &["--timeout", "0.3"],
        "'sh' took more than 0.3 s (allowed: --timeout)",
    );
    refused(&copy("small.exr"), &[], "3 × 4 pixels (allowed: 4 × 4");
    refused(&copy("cut.exr"), &[], "picture.exr");
    refused(
        "echo hello > \"$1\"",
        &["--picture-format", "ppm"],
        "picture.ppm",
    );
    // No files are left behind by any.
    let (code, printed, said) = shell(&copy("right.exr"), &[]);
    assert_eq!(code, 1, "{said}");
    assert!(printed.contains("inconclusive"), "{printed}");
}

/// A picture of an earlier step is no answer to the next.
#[test]
fn an_old_picture_is_no_answer() {
    let folder = tempfile::tempdir().unwrap();
    let right = folder.path().join("right.exr");
    picture(&right, [4, 4], 0.5);
    let line = format!(
        "[ -e '{0}' ] && cp '{0}' \"$1\" && rm '{0}'; true",
        right.display()
    );
    let (code, _, said) = shell_at("4,8", &line, &[]);
    assert_eq!(code, 2);
    assert!(said.contains("wrote no picture.exr"), "{said}");
}

#[test]
fn pixels_that_are_no_numbers_are_counted_and_contradicted() {
    let folder = tempfile::tempdir().unwrap();
    let nan = folder.path().join("nan.npy");
    picture(&nan, [4, 4], f64::NAN);
    let (code, printed, _) = shell(
        &format!("cp '{}' \"$1\"", nan.display()),
        &["--picture-format", "npy"],
    );
    assert_eq!(code, 1);
    assert!(
        printed.contains("48 values of the finest picture are NaN"),
        "{printed}"
    );
}

#[test]
fn wrong_usage_is_said_with_what_is_allowed() {
    for (arguments, says) in [
        (
            &["image", "cube"][..],
            "no volume 'cube' (allowed: blob, jump-sphere",
        ),
        (&["image", "./missing.toml"], "missing.toml"),
        (
            &["image", "ramp", "raycast:quintic/trapezoid/trapezoid"],
            "no renderer of volver's own",
        ),
        (
            &["image", "ramp", "raycast:linear/nothing"],
            "no renderer of volver's own",
        ),
        (
            &["image", "ramp", "--", "render", "{volume}"],
            "a command line without {out}",
        ),
        (
            &[
                "image",
                "ramp",
                "--",
                "./no-such-program",
                "{volume}",
                "{out}",
            ],
            "could not be started",
        ),
        (
            &[
                "image",
                "ramp",
                "--steps",
                "8,4",
                "raycast:linear/trapezoid/trapezoid",
            ],
            "--steps does not rise",
        ),
        (
            &["image", "ramp", "--steps", "0"],
            "allowed: integers from 1 to 4096",
        ),
        (
            &["image", "ramp", "--pixel", "24,0"],
            "no pixel 24,0 (allowed: 0,0 to 23,23",
        ),
        (&["image", "ramp", "--pixel", "0,0"], "misses the volume"),
        (
            &[
                "image",
                "ramp",
                "--cells",
                "8,4096",
                "raycast:linear/trapezoid/trapezoid",
            ],
            "GiB",
        ),
        (
            &["image", "ramp", "--aspect", "1:0"],
            "two integers from 1 to 64",
        ),
        (
            &["image", "ramp", "--compare", "missing.exr"],
            "missing.exr",
        ),
    ] {
        let (code, printed, said) = volver(arguments);
        assert_eq!((code, printed.as_str()), (2, ""), "{arguments:?}: {said}");
        assert!(said.contains(says), "{arguments:?}: {said}");
    }
}

#[test]
fn a_volume_out_of_sight_is_wrong_input() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("aside.toml");
    let text = volver::case::volume::catalogue::text("ramp").unwrap();
    let aside = text.replace("target = [0, 0, 0]", "target = [90, 80, 0]");
    fs::write(&path, aside).unwrap();
    let path = path.to_str().unwrap();
    let (code, printed, said) = volver(&["image", path, "raycast:linear/trapezoid/trapezoid"]);
    assert_eq!((code, printed.as_str()), (2, ""));
    assert!(
        said.contains("no ray of the picture meets the volume"),
        "{said}"
    );
}

/// A camera inside sees what is in front of it.
#[test]
fn a_camera_inside_the_volume_is_right() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("inside.toml");
    let text = volver::case::volume::catalogue::text("radial").unwrap();
    let inside = text.replace("[0.6, -4, 0.8]", "[0.6, -0.4, 0.1]");
    fs::write(&path, inside).unwrap();
    let path = path.to_str().unwrap();
    let axes = ["--axes", "step,pixel"];
    let renderer = ["raycast:cubic/front-to-back/middle/expm1"];
    let all = [&["image", path][..], &axes, &renderer].concat();
    let (code, printed, _) = volver(&all);
    assert_eq!(code, 0, "{printed}");
}

/// What is written for renderers, what is compared, and the case of a pixel, are one and the same volume.
#[test]
fn what_is_written_is_what_is_compared() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("wave");
    let (code, ..) = volver(&[
        "image",
        "wave",
        "--write",
        place.to_str().unwrap(),
        "--side",
        "12",
    ]);
    assert_eq!(code, 0);
    let exact = place.join("exact.npy");
    let (code, printed, _) = volver(&["image", "wave", "--compare", exact.to_str().unwrap()]);
    assert_eq!(
        (code, printed.contains("max         0.000e0")),
        (0, true),
        "{printed}"
    );
    // A ray's own case file has the same radiance.
    let (_, text, _) = volver(&["image", "wave", "--side", "12", "--pixel", "6,6"]);
    let case = folder.path().join("ray.toml");
    fs::write(&case, text).unwrap();
    let (code, printed, _) = volver(&[
        "reference",
        &format!("{}/r", case.display()),
        "--digits",
        "15",
        "--json",
    ]);
    let (code, printed) = if code == 0 {
        (code, printed)
    } else {
        let (code, printed, _) = volver(&[
            "reference",
            case.to_str().unwrap(),
            "--digits",
            "15",
            "--json",
        ]);
        (code, printed)
    };
    assert_eq!(code, 0);
    let red = file::read(&exact).unwrap().image.pixel(6, 6)[0];
    assert!(
        printed.contains(&format!("{red:.12}")[..12]),
        "{red}: {printed}"
    );
}

/// Errors and orders of every pixel are written as numbers, with the page.
#[test]
fn orders_of_pixels_are_a_picture() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("report");
    let out = place.to_str().unwrap();
    let (code, ..) = volver(&[
        "image",
        "ramp",
        "--axes",
        "step",
        "--cells",
        "4,8",
        "--out",
        out,
        "raycast:linear/front-to-back/middle/expm1",
    ]);
    assert_eq!(code, 0);
    for name in [
        "index.html",
        "image.json",
        "image.md",
        "map-errors.svg",
        "map-step.svg",
    ] {
        assert!(place.join(name).exists(), "{name}");
    }
    let image = file::read(&place.join("order-step.npy")).unwrap().image;
    assert_eq!(
        (image.width, image.height, image.channels.len()),
        (24, 24, 1)
    );
    let seen: Vec<f64> = image
        .values
        .iter()
        .copied()
        .filter(|v| v.is_finite())
        .collect();
    assert!(seen.len() > 300);
    assert!(
        seen.iter().all(|order| (order - 2.0).abs() < 0.2),
        "{seen:?}"
    );
    let errors = file::read(&place.join("error.npy")).unwrap().image;
    assert!(errors.values.iter().all(|error| *error < 1e-5));
}
