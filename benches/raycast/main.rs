//! The renderer of volumes beside a plain loop in C++ and VTK's fixed-point mapper: a picture of 512² pixels, orthographic, of
//! 128³ samples in binary32, 512 steps a ray, trilinear, four control points and three channels; no ray ends early, and no
//! space is empty.
//!
//! `cargo bench -p volver-benches --bench raycast`; VTK is there where `VOLVER_PYTHON` has it, as `make bench` installs it.
//! Processor time of all threads, rounds in turn. `raycast.cpp` is compiled here by `c++ -O3 -march=native`.

#![allow(missing_docs, unsafe_code, clippy::expect_used)]
// Counts are small, and samples are in binary32.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss
)]

use libloading::Library;
use rustix::time::{ClockId, clock_gettime};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};
use volver::image::Image;
use volver::raycast::{Interpolation, LastStep, Precision, Raycaster};
use volver::real::lanes::Width;
use volver::volume::{Camera, ControlPoint, Grid, Lens, Samples, TransferFunction};
use volver_benches::quartiles;

const SIDE: usize = 128;
const SIZE: usize = 512;
const STEPS: usize = 512;
/// Rounds that are measured, behind one that is not.
const ROUNDS: usize = 9;
/// s, τ, and C of three channels: faint enough that no ray ends early.
const POINTS: [[f32; 5]; 4] = [
    [0.0, 0.002, 0.9, 0.2, 0.1],
    [0.3, 0.01, 0.3, 0.8, 0.2],
    [0.6, 0.004, 0.2, 0.4, 0.9],
    [1.0, 0.02, 1.0, 1.0, 0.5],
];

fn main() {
    let grid = grid();
    let transfer = transfer();
    let middle = (SIDE - 1) as f64 / 2.0;
    let step = (SIDE - 1) as f64 / STEPS as f64;
    let raycaster = Raycaster {
        grid: &grid,
        transfer: &transfer,
        camera: Camera {
            position: [middle, middle, -middle],
            target: [middle; 3],
            up: [0.0, -1.0, 0.0],
            lens: Lens::Orthographic {
                height: 2.0 * middle,
            },
        },
        size: [SIZE; 2],
        step,
        last_step: LastStep::Equal,
        interpolation: Interpolation::Linear,
        method: "front-to-back/middle/subtraction"
            .parse()
            .expect("a method"),
        precision: Precision::Binary32,
        opacity: false,
    };
    let ours = || raycaster.render().expect("a picture").image;
    let folder = tempfile::tempdir().expect("a folder");
    let library = library(folder.path());
    let theirs = || in_cpp(&library, &grid, step as f32);
    let mut vtk = std::env::var_os("VOLVER_PYTHON").map(|python| {
        let file = folder.path().join("samples");
        std::fs::write(&file, bytes(&grid)).expect("a file of samples");
        Vtk::start(Path::new(&python), &file, step)
    });
    agree(&ours(), &theirs());
    let widths: Vec<Width> = Width::there().collect();
    let mut rounds: Vec<Vec<f64>> = Vec::new();
    for round in 0..=ROUNDS {
        let mut times = vec![seconds(theirs)];
        for &width in &widths {
            width.choose().expect("a width");
            times.push(seconds(ours));
        }
        if let Some(vtk) = &mut vtk {
            let (time, mean) = vtk.render();
            if round == 0 {
                // Its 15 bits round up what thin steps absorb.
                let own = mean_of(&ours());
                assert!(
                    (mean - own).abs() < 0.1 * own,
                    "VTK's mean {mean} and {own}"
                );
            }
            times.push(time);
        }
        if round > 0 {
            rounds.push(times);
        }
    }
    if let Some(vtk) = vtk {
        vtk.stop();
    }
    let mut names = vec!["C++".to_owned()];
    names.extend(widths.iter().map(|width| format!("volver, lanes {width}")));
    names.push("VTK".into());
    println!("what                  ms     part of C++'s (quartiles)   part of VTK's (quartiles)");
    for (column, name) in names.iter().enumerate().take(rounds[0].len()) {
        let part_of = |other: usize| {
            let ratios = rounds.iter().map(|times| times[column] / times[other]);
            let [low, ratio, high] = quartiles(ratios.collect());
            format!("{ratio:.3} ({low:.3} to {high:.3})")
        };
        let median = quartiles(rounds.iter().map(|times| times[column]).collect())[1];
        let of_vtk = if rounds[0].len() == names.len() {
            part_of(names.len() - 1)
        } else {
            "no VTK".into()
        };
        println!(
            "{name:18} {:7.0}     {:26}  {of_vtk}",
            median * 1e3,
            part_of(0)
        );
    }
}

/// Smooth and uneven, from 0 to 1.
fn grid() -> Grid {
    let wave = |i: usize, scale: f64| (i as f64 * scale).sin();
    let mut samples = Vec::with_capacity(SIDE.pow(3));
    for k in 0..SIDE {
        for j in 0..SIDE {
            for i in 0..SIDE {
                let value =
                    wave(i, 0.11) * wave(j + 5, 0.07) + wave(k + 9, 0.09) * wave(i + j, 0.05);
                samples.push((0.5 + 0.25 * value) as f32);
            }
        }
    }
    Grid {
        dimensions: [SIDE; 3],
        origin: [0.0; 3],
        spacing: [1.0; 3],
        direction: Grid::ALONG_AXES,
        samples: Samples::F32(samples),
    }
}

fn transfer() -> TransferFunction {
    let point = |&[s, extinction, ref emission @ ..]: &[f32; 5]| ControlPoint {
        s: s.into(),
        extinction: extinction.into(),
        emission: emission.iter().map(|&c| c.into()).collect(),
    };
    TransferFunction {
        channels: ["red", "green", "blue"].map(String::from).to_vec(),
        points: POINTS.iter().map(point).collect(),
    }
}

fn samples(grid: &Grid) -> &[f32] {
    match &grid.samples {
        Samples::F32(samples) => samples,
        Samples::F64(_) => &[],
    }
}

fn bytes(grid: &Grid) -> Vec<u8> {
    samples(grid)
        .iter()
        .flat_map(|sample| sample.to_le_bytes())
        .collect()
}

/// `raycast.cpp`, as one would compile it.
fn library(folder: &Path) -> Library {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("peers/raycast.cpp");
    let library = folder.join("raycast.so");
    let compiler = Command::new("c++")
        .args("-std=c++17 -O3 -march=native -shared -fPIC -o".split(' '))
        .args([&library, &source])
        .status();
    assert!(
        compiler.expect("a compiler, c++").success(),
        "it is compiled"
    );
    // SAFETY: nothing runs when it is loaded.
    unsafe { Library::new(&library) }.expect("a shared library")
}

type Raycast = extern "C" fn(
    *const f32,
    *const i32,
    *const [f32; 5],
    i32,
    *const f32,
    *const f32,
    *const f32,
    *const f32,
    f32,
    i32,
    i32,
    i32,
    *mut f32,
);

fn in_cpp(library: &Library, grid: &Grid, step: f32) -> Vec<f32> {
    // SAFETY: raycast.cpp has a function of this name and type, and `library` outlives the call.
    let raycast = unsafe { library.get::<Raycast>(b"raycast") }.expect("raycast");
    let pixel = (SIDE - 1) as f32 / SIZE as f32;
    let mut image = vec![0.0; 3 * SIZE * SIZE];
    let [steps, size, side] = [STEPS, SIZE, SIDE].map(|count| count as i32);
    raycast(
        samples(grid).as_ptr(),
        [side; 3].as_ptr(),
        POINTS.as_ptr(),
        POINTS.len() as i32,
        [pixel / 2.0, pixel / 2.0, 0.0].as_ptr(),
        [pixel, 0.0, 0.0].as_ptr(),
        [0.0, pixel, 0.0].as_ptr(),
        [0.0, 0.0, step].as_ptr(),
        step,
        steps,
        size,
        size,
        image.as_mut_ptr(),
    );
    image
}

/// VTK in a process of its own, which renders a picture a line.
struct Vtk {
    process: Child,
    answers: BufReader<ChildStdout>,
}

impl Vtk {
    fn start(python: &Path, samples: &Path, step: f64) -> Vtk {
        let points = POINTS.map(|[s, extinction, red, green, blue]| {
            [s, 1.0 - (-extinction).exp(), red, green, blue]
        });
        let points = serde_json::to_string(&points).expect("numbers");
        let mut process = Command::new(python)
            .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("peers/raycast_vtk.py"))
            .arg(samples)
            .args([SIDE.to_string(), SIZE.to_string(), step.to_string(), points])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("a Python");
        let answers = BufReader::new(process.stdout.take().expect("a pipe"));
        Vtk { process, answers }
    }

    /// The seconds of a picture, and its mean red.
    fn render(&mut self) -> (f64, f64) {
        let requests = self.process.stdin.as_mut().expect("a pipe");
        writeln!(requests).expect("a request");
        let mut line = String::new();
        self.answers.read_line(&mut line).expect("an answer");
        let (time, mean) = line.trim().split_once(' ').expect("VTK in that Python");
        (time.parse().expect("a time"), mean.parse().expect("a mean"))
    }

    fn stop(mut self) {
        drop(self.process.stdin.take());
        self.process.wait().expect("an end");
    }
}

fn mean_of(image: &Image) -> f64 {
    image.values.iter().step_by(3).sum::<f64>() / (SIZE * SIZE) as f64
}

fn agree(ours: &Image, theirs: &[f32]) {
    for (own, &other) in ours.values.iter().zip(theirs) {
        let other = f64::from(other);
        assert!((own - other).abs() < 2e-5, "{own} and {other}");
    }
}

/// Seconds of processor time, all threads.
fn seconds<A>(work: impl FnOnce() -> A) -> f64 {
    let now = || {
        let time = clock_gettime(ClockId::ProcessCPUTime);
        time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
    };
    let start = now();
    std::hint::black_box(work());
    now() - start
}
