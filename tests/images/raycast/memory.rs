//! What a picture takes beside the volume and itself.

use volver::case::volume::catalogue;
use volver::raycast::{Interpolation, LastStep, Precision, Raycaster};
use volver::volume::Samples;

/// A figure of this process in KiB, where the system tells it.
fn kibibytes(name: &str) -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with(name))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

#[test]
#[ignore = "has to be alone in its process, and takes a picture of 512² pixels"]
fn a_picture_takes_itself_and_less_than_64_mebibytes() {
    let Some(before) = kibibytes("VmRSS") else {
        return;
    };
    let case = catalogue::find("wave").unwrap();
    let mut grid = case.sampled([128; 3]);
    let Samples::F64(values) = &grid.samples else {
        panic!("samples are sampled in binary64")
    };
    let narrow: Vec<f32> = values.iter().map(|value| *value as f32).collect();
    grid.samples = Samples::F32(narrow);
    // The peak of what was done until now is no picture's.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
    let picture = Raycaster {
        grid: &grid,
        transfer: &case.transfer,
        camera: case.camera,
        size: [512, 512],
        step: 2.0 * 3.0_f64.sqrt() / 512.0,
        last_step: LastStep::Equal,
        interpolation: Interpolation::Linear,
        method: "front-to-back/middle/subtraction".parse().unwrap(),
        precision: Precision::Binary32,
        opacity: false,
    }
    .render()
    .unwrap();
    let after = kibibytes("VmHWM").unwrap();
    let volume = 128 * 128 * 128 * 4 / 1024;
    let own = picture.image.values.len() as u64 * 8 / 1024;
    println!(
        "{} KiB, of which the volume {volume} and the picture {own}",
        after - before
    );
    assert!(
        after - before < volume + own + 64 * 1024,
        "{before} {after} {own}"
    );
}
