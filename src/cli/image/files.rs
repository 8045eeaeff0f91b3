//! What is written for renderers, and what they have written.

use crate::cli::{Failure, Outcome, write_out};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use volver::case::volume::VolumeCase;
use volver::image::{Image, file as image_file};
use volver::reference::ExactPicture;
use volver::render::ReportError;
use volver::study::picture::{Asked, Pictures, Plan, Rendered, likeness, norms};
use volver::volume::file::{FileError, Geometry, Turned, write, write_camera, write_transfer};

/// The case file of the ray of a pixel.
pub(super) fn print_pixel(
    case: &VolumeCase,
    plan: &Plan,
    [x, y]: [usize; 2],
) -> Result<Outcome, Failure> {
    let [width, height] = plan.size(plan.side);
    if x >= width || y >= height {
        return Err(Failure::Usage(format!(
            "no pixel {x},{y} (allowed: 0,0 to {},{} of the picture, whose size --side gives)",
            width - 1,
            height - 1
        )));
    }
    let ray = case
        .camera
        .ray([width, height], [x as f64 + 0.5, y as f64 + 0.5]);
    let hit = ray.and_then(|ray| Some((ray, case.chord(&ray)?)));
    let Some((ray, chord)) = hit else {
        return Err(Failure::Usage(format!(
            "the ray of pixel {x},{y} misses the volume (allowed: pixels that show it)"
        )));
    };
    let name = format!("{}-{x}-{y}", case.name);
    write_out(&case.ray_case(&name, &ray, chord))?;
    Ok(Outcome::Good)
}

/// Everything that a renderer needs, at the finest levels that are asked for.
pub(super) fn write_files(
    case: &VolumeCase,
    plan: &Plan,
    volume_ending: &str,
    directory: &Path,
) -> Result<Outcome, Failure> {
    volver::render::make_directory(directory)?;
    let cells = plan.cells.last().copied().unwrap_or(1);
    let grid = case.sampled([cells + 1; 3]);
    let file_failed = |error: FileError| Failure::Usage(error.to_string());
    let volume = directory.join(format!("volume.{volume_ending}"));
    let _: Geometry = write(&volume, &grid, Turned::Refused).map_err(file_failed)?;
    write_transfer(&directory.join("transfer.json"), &case.transfer).map_err(file_failed)?;
    write_camera(&directory.join("camera.json"), &case.camera).map_err(file_failed)?;
    let picture = exact(case, plan);
    for ending in ["exr", "npy"] {
        let path = directory.join(format!("exact.{ending}"));
        image_file::write(&path, &picture).map_err(file_failed)?;
    }
    write_out(&format!(
        "5 files in {}: {} cells, {} × {} pixels\n",
        directory.display(),
        cells,
        picture.width,
        picture.height
    ))?;
    Ok(Outcome::Good)
}

/// The picture as the plan has it.
fn exact(case: &VolumeCase, plan: &Plan) -> Image {
    let size = plan.size(plan.side);
    plan.pixel.exact(&ExactPicture::new(case), size)
}

/// The errors of pixels, and their orders along each axis, as numbers: `error.npy`, `order-step.npy`, `order-grid.npy`.
pub(super) fn write_maps(
    directory: &Path,
    pictures: &Pictures,
) -> Result<Vec<PathBuf>, ReportError> {
    let error = pictures.axes.iter().find_map(|axis| axis.error.as_ref());
    let error = error.map(|map| ("error".to_string(), map));
    let orders = pictures.axes.iter().filter_map(|axis| {
        let map = axis.per_pixel.as_ref()?;
        Some((format!("order-{}", axis.axis.name()), map))
    });
    let mut paths = Vec::new();
    for (name, map) in error.into_iter().chain(orders) {
        let path = directory.join(format!("{name}.npy"));
        let image = Image {
            width: map.width,
            height: map.height,
            channels: vec![name],
            values: map.values.clone(),
        };
        image_file::write(&path, &image).map_err(|error| ReportError::File {
            path: path.clone(),
            reason: std::io::Error::other(error.to_string()),
        })?;
        paths.push(path);
    }
    Ok(paths)
}

/// How far a picture is from the exact one of its size.
pub(super) fn compared(case: &VolumeCase, plan: &Plan, path: &Path) -> Result<Outcome, Failure> {
    let read = image_file::read(path).map_err(|error| Failure::Usage(error.to_string()))?;
    let mut plan = plan.clone();
    let size = [read.image.width, read.image.height];
    plan.side = size[0].min(size[1]);
    plan.aspect = size;
    let exact = exact(case, &plan);
    if [exact.width, exact.height] != size || exact.channels.len() > read.image.channels.len() {
        return Err(Failure::Usage(format!(
            "{}: {} × {} pixels of {} channels (allowed: {} channels, {})",
            path.display(),
            size[0],
            size[1],
            read.image.channels.len(),
            exact.channels.len(),
            exact.channels.join(", ")
        )));
    }
    let asked = Asked {
        case,
        cells: plan.cells.last().copied().unwrap_or(1),
        size,
        step: 1.0,
    };
    let rendered = Rendered {
        image: read.image,
        quantum: read.quantum,
    };
    let image = rendered
        .fitting(&asked)
        .map_err(|error| Failure::Usage(format!("{}: {error}", path.display())))?
        .image;
    let off = norms(&image, &exact, |_| true);
    let mut text = String::new();
    // Writing to a text cannot fail.
    let _ = writeln!(text, "max         {:.3e}", off.max);
    let _ = writeln!(text, "L1          {:.3e}", off.l1);
    let _ = writeln!(text, "L2          {:.3e}", off.l2);
    let _ = writeln!(text, "not finite  {}", off.not_finite);
    if let Some(quantum) = read.quantum {
        let _ = writeln!(text, "quantum     {quantum:.3e}");
    }
    let found = Pictures {
        renderer: path.display().to_string(),
        axes: Vec::new(),
        coarser: image.clone(),
        finest: image,
        left: 0.0,
        exact,
        not_finite: off.not_finite,
        quantum: read.quantum,
        classes: Vec::new(),
    };
    let like = likeness(case, &found, plan.pixel, asked.cells);
    for one in &like {
        let _ = writeln!(
            text,
            "{}: {}; {:.1e} of the error is left",
            one.name, one.words, one.left
        );
    }
    write_out(&text)?;
    Ok(if like.is_empty() && off.not_finite == 0 {
        Outcome::Good
    } else {
        Outcome::CheckFailed
    })
}
