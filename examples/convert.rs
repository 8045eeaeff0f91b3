//! Reads a volume, a picture, a transfer function or a camera, prints what it is as JSON, and writes it in another format.
//!
//!     cargo run --example convert -- volume scan.nrrd scan.vti
//!     cargo run --example convert -- image picture.exr picture.npy
//!     cargo run --example convert -- transfer colours.json ours.json
//!     cargo run --example convert -- camera view.gltf camera.json

use serde_json::{Value, json};
use std::path::Path;
use std::process::ExitCode;
use volver::image;
use volver::volume::file as volume;
use volver::volume::{Grid, Samples};

const USAGE: &str = "usage: convert volume|image|transfer|camera IN [OUT]";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match *arguments.as_slice() {
        [what, from] => converted(what, Path::new(from), None),
        [what, from, to] => converted(what, Path::new(from), Some(Path::new(to))),
        _ => Err(USAGE.into()),
    };
    match done {
        Ok(read) => {
            println!("{read}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

fn converted(
    what: &str,
    from: &Path,
    to: Option<&Path>,
) -> Result<Value, Box<dyn std::error::Error>> {
    Ok(match what {
        "volume" => {
            let grid = volume::read(from)?;
            if let Some(to) = to
                && volume::write(to, &grid, volume::Turned::ForItk)? == volume::Geometry::LeftOut
            {
                eprintln!("{} does not say where samples stand", to.display());
            }
            said(&grid)
        }
        "image" => {
            let read = image::file::read(from)?;
            if let Some(to) = to {
                image::file::write(to, &read.image)?;
            }
            let image = &read.image;
            json!({
                "width": image.width, "height": image.height, "channels": image.channels,
                "quantum": read.quantum, "nan": read.nan,
            })
        }
        "transfer" => {
            let (transfer, error) = volume::read_transfer(from, &volume::ColorMap::default())?;
            if let Some(to) = to {
                volume::write_transfer(to, &transfer)?;
            }
            json!({ "channels": transfer.channels, "points": transfer.points.len(), "error": error })
        }
        "camera" => {
            let is_gltf = |path: &Path| path.extension().is_some_and(|ending| ending == "gltf");
            let camera = if is_gltf(from) {
                volume::read_gltf_camera(from)?.camera
            } else {
                volume::read_camera(from)?
            };
            match to {
                // glTF asks for a width and a depth, which cameras do not have.
                Some(to) if is_gltf(to) => {
                    let view = volume::View {
                        aspect: 1.0,
                        depth: [0.01, 1000.0],
                    };
                    volume::write_gltf_camera(to, &camera, &view)?;
                }
                Some(to) => volume::write_camera(to, &camera)?,
                None => {}
            }
            json!({
                "position": camera.position, "target": camera.target, "up": camera.up,
                "lens": format!("{:?}", camera.lens),
            })
        }
        _ => return Err(USAGE.into()),
    })
}

fn said(grid: &Grid) -> Value {
    let samples = match grid.samples {
        Samples::F32(_) => "binary32",
        Samples::F64(_) => "binary64",
    };
    let values = (0..grid.samples.len()).map(|index| grid.samples.at(index));
    let (least, most) = values.fold(
        (f64::INFINITY, f64::NEG_INFINITY),
        |(least, most), value| (least.min(value), most.max(value)),
    );
    json!({
        "dimensions": grid.dimensions, "origin": grid.origin, "spacing": grid.spacing,
        "direction": grid.direction, "samples": samples, "least": least, "most": most,
    })
}
