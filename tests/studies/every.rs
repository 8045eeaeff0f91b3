//! Every command once, for what all of them keep to.

use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// A directory with what the commands read.
pub(crate) struct Place(TempDir);

const SCENE: &str =
    "[[media]]\nfrom = 0\nto = 1\nkind = \"constant\"\nextinction = 1\nemission = 1\n";

impl Place {
    pub(crate) fn new() -> Place {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
        let place = Place(folder);
        for made in [
            "plan scene.toml --tolerance 1e-3 --no-check --quiet --json plan.json",
            "study --cases vacuum --methods midpoint/midpoint --formats f32 --levels 8,16 --quiet --out study",
            "study --cases vacuum --methods midpoint/midpoint --formats f32 --levels 8,16 --quiet --out sharded --shard 1/1",
            "verify --cases sine-squared --ladder 8..64 --quiet --save base.json method:tree/middle/expm1",
        ] {
            assert_cmd::cargo::cargo_bin_cmd!("volver")
                .args(made.split(' '))
                .current_dir(place.path())
                .assert()
                .code(0);
        }
        place
    }

    pub(crate) fn path(&self) -> &Path {
        self.0.path()
    }
}

/// Arguments that make every command print something, and what it reads from standard input.
pub(crate) fn commands() -> Vec<(&'static str, &'static str)> {
    vec![
        (
            "verify --cases sine-squared --ladder 8..64 method:tree/middle/expm1",
            "",
        ),
        ("check base.json method:tree/middle/expm1", ""),
        ("identify method:tree/middle/expm1", ""),
        (
            "image ramp --axes step --cells 4 --steps 8,16,32,64 --side 8 raycast:linear/trapezoid/trapezoid",
            "",
        ),
        ("ask vacuum -n 2", ""),
        ("new python kernel", ""),
        ("reproduce --table 2 --levels 8..64", ""),
        ("reproduce --table 2 --levels 8..64 --json -", ""),
        ("stress --scenarios vacuum --formats f32", ""),
        ("fit -", "0.4,8e-2\n0.2,2e-2\n0.1,5e-3\n0.05,1.25e-3\n"),
        (
            concat!(
                "gradient --cases sine-squared --levels 8..64 python3 ",
                env!("CARGO_MANIFEST_DIR"),
                "/examples/kernels/gradient.py"
            ),
            "",
        ),
        (
            concat!(
                "adjoint python3 ",
                env!("CARGO_MANIFEST_DIR"),
                "/examples/kernels/projector.py"
            ),
            "",
        ),
        (
            "gradient-test -",
            "0.4,8e-2\n0.2,2e-2\n0.1,5e-3\n0.05,1.25e-3\n",
        ),
        ("merge sharded", ""),
        ("gallery", ""),
        ("cases vacuum", ""),
        ("manufacture vacuum --code c", ""),
        ("prove sine-squared --no-check", ""),
        ("reference vacuum", ""),
        (
            "study --cases vacuum --methods midpoint/midpoint --formats f32 --levels 8,16",
            "",
        ),
        (
            "study --cases vacuum --methods midpoint/midpoint --formats f32 --levels 8,16 --csv -",
            "",
        ),
        ("report study", ""),
        ("plan scene.toml --tolerance 1e-3", ""),
        ("render scene.toml --plan plan.json", ""),
        (
            "tradeoff --cases vacuum --methods midpoint/midpoint --formats f32 --levels 1,2 --cost evaluations",
            "",
        ),
        ("schema scene", ""),
        ("completions bash", ""),
    ]
}

/// The names of all commands.
pub(crate) fn names() -> Vec<String> {
    let help = assert_cmd::cargo::cargo_bin_cmd!("volver")
        .arg("--help")
        .output()
        .unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    let (_, list) = help.split_once("Commands:\n").unwrap();
    let lines = list.lines().take_while(|line| line.starts_with("  "));
    // What is wrapped stands farther in.
    let lines = lines.filter(|line| !line.starts_with("   "));
    let names = lines.filter_map(|line| line.split_whitespace().next());
    names
        .filter(|name| *name != "help")
        .map(Into::into)
        .collect()
}
