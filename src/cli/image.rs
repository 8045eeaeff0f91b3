//! `volver image`: a renderer of volumes along three axes of refinement.

mod files;
mod values;
mod volume;

use super::about::about;
use super::budget::{Budget, MINUTE};
use super::output::{Output, said};
use super::progress::Bar;
use super::{Color, Failure, Outcome, write_out};
use clap::{Args, ValueEnum};
use files::{compared, print_pixel, write_files, write_maps};
use std::path::PathBuf;
use std::time::Duration;
use values::{aspect, count, order, pixel, seconds};
use volume::{listed, load, shown};
use volver::case::volume::VolumeCase;
use volver::report::image::{Imaged, Standing, document, json, write};
use volver::study::picture::{
    Axis, Own, PixelIs, Plan, Program, ProgramOptions, Renderer, likeness, pictures,
};

const EXAMPLES: &str = "\
VOLUME is a name of the catalogue (ramp, radial, wave, blob, kink-plane, jump-sphere), or a
file: any path with a / in it or .toml at its end. Without RENDERER it is shown.

RENDERER is one of volver's own, raycast:INTERPOLATION/METHOD[@FORMAT], or a command line, in
whose words {volume} {transfer} {camera} {width} {height} {step} and {out} stand for files
that are written, numbers, and the file that it is to write. docs/images.md says what is in
them.

The step along rays, the grid of samples and the pixel are refined, each beside the exact
picture, and orders are fitted over pixels whose rays meet nothing but what is analytic. A
picture that is the right one mirrored, turned, moved by half a voxel or a pixel, with
channels exchanged, or with lengths or values multiplied, is said to be so where that leaves
at most a tenth of the error, on pixels that it was not found with.

The exit code is 0 where no order is contradicted and those that are expected are confirmed,
1 where one is not, or the picture is another one, 2 where it could not run.

Work: about 20 pictures; a program has --timeout for each. Volumes of 8 (cells + 1)³ bytes;
2 GiB without --yes.

JSON: renderer, volume, standing, axes with levels, fit, orders and lost, like, not_finite,
quantum.

Examples:
  volver image
  volver image wave raycast:linear/front-to-back/middle/expm1
  volver image ramp --axes step --json - raycast:linear/front-to-back/front/expm1@f32
  volver image blob --pixel 20,12
  volver image wave --write target/wave --cells 32 --side 64";

/// Refine a renderer of volumes along its step, its grid and its pixels
#[derive(Args)]
#[command(override_usage = "volver image [OPTIONS] [VOLUME] [RENDERER]...")]
#[command(after_help = EXAMPLES)]
#[allow(clippy::struct_excessive_bools)] // One an option.
pub(crate) struct Image {
    /// A volume; without one, they are listed
    #[arg(value_name = "VOLUME")]
    volume: Option<String>,
    /// A renderer
    #[arg(
        value_name = "RENDERER",
        trailing_var_arg = true,
        allow_hyphen_values = true
    )]
    renderer: Vec<String>,
    /// What is refined
    #[arg(
        long,
        value_enum,
        value_delimiter = ',',
        value_name = "AXES",
        default_value = "step,grid,pixel"
    )]
    axes: Vec<AxisName>,
    /// Steps along the diagonal of the box, rising [default: 32,64 … 2048]
    #[arg(long, value_delimiter = ',', value_name = "COUNTS", value_parser = count)]
    steps: Vec<usize>,
    /// Cells of the grid along each axis, rising [default: 8,16,32,64,128]
    #[arg(long, value_delimiter = ',', value_name = "COUNTS", value_parser = count)]
    cells: Vec<usize>,
    /// Pixels along the shorter side where pixels are refined [default: 8,16,32,64]
    #[arg(long, value_delimiter = ',', value_name = "COUNTS", value_parser = count)]
    pixels: Vec<usize>,
    /// Pixels along the shorter side where step and grid are
    #[arg(long, value_name = "COUNT", default_value_t = 24, value_parser = count)]
    side: usize,
    /// Width by height of pictures
    #[arg(long, value_name = "W:H", default_value = "1:1", value_parser = aspect)]
    aspect: [usize; 2],
    /// Pixels are means over their square, and not the radiance through their middle
    #[arg(long)]
    mean: bool,
    /// The order of the step that is expected [default: that of a renderer of volver's own]
    #[arg(long, value_name = "P", value_parser = order)]
    step_order: Option<f64>,
    /// The order of the grid that is expected [default: that of the interpolation; 2 of programs]
    #[arg(long, value_name = "P", value_parser = order)]
    grid_order: Option<f64>,
    /// The order of pixels that is expected [default: 2; none with --mean]
    #[arg(long, value_name = "P", value_parser = order)]
    pixel_order: Option<f64>,
    /// The file of the volume: vti, nrrd, mha or npy
    #[arg(long, value_enum, value_name = "FORMAT", default_value = "vti")]
    volume_format: VolumeFormat,
    /// The picture that a program writes: exr, npy, pfm, png, ppm or pgm
    #[arg(long, value_enum, value_name = "FORMAT", default_value = "exr")]
    picture_format: PictureFormat,
    /// Samples in binary32
    #[arg(long)]
    single: bool,
    /// Seconds that a program has for a picture
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0, value_parser = seconds)]
    timeout: f64,
    /// Print the case file of the ray through the middle of a pixel of the picture
    #[arg(long, value_name = "X,Y", value_parser = pixel, conflicts_with_all = ["write", "renderer"])]
    pixel: Option<[usize; 2]>,
    /// Write the volume, the transfer functions, the camera and the exact picture into a directory
    #[arg(long, value_name = "DIR", conflicts_with = "renderer")]
    write: Option<PathBuf>,
    /// Compare a picture with the exact one
    #[arg(long, value_name = "PICTURE", conflicts_with_all = ["write", "pixel", "renderer"])]
    compare: Option<PathBuf>,
    /// Run even if it takes more than 2 GiB of memory
    #[arg(long)]
    yes: bool,
    /// Write one JSON document; - is standard output, without the table
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the report, as a page, Markdown and JSON, into a directory
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print no table
    #[arg(long)]
    quiet: bool,
    /// Colour the verdicts
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    color: Color,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum AxisName {
    Step,
    Grid,
    Pixel,
}

#[derive(Clone, Copy, ValueEnum)]
enum VolumeFormat {
    Vti,
    Nrrd,
    Mha,
    Npy,
}

#[derive(Clone, Copy, ValueEnum)]
enum PictureFormat {
    Exr,
    Npy,
    Pfm,
    Png,
    Ppm,
    Pgm,
}

/// Of the step, the grid and pixels.
type Orders = [Option<f64>; 3];

fn name_of(value: &impl ValueEnum) -> String {
    let value = value.to_possible_value();
    value.map_or(String::new(), |value| value.get_name().to_string())
}

impl Image {
    pub(crate) fn run(&self) -> Result<Outcome, Failure> {
        let Some(name) = &self.volume else {
            write_out(&listed())?;
            return Ok(Outcome::Good);
        };
        let case = load(name)?;
        let plan = self.plan()?;
        if let Some(at) = self.pixel {
            return print_pixel(&case, &plan, at);
        }
        if self.write.is_some() || !self.renderer.is_empty() {
            self.budget(&plan)?;
        }
        if let Some(directory) = &self.write {
            let ending = name_of(&self.volume_format);
            return write_files(&case, &plan, &ending, directory);
        }
        if let Some(picture) = &self.compare {
            return compared(&case, &plan, picture);
        }
        if self.renderer.is_empty() {
            write_out(&shown(&case, &plan))?;
            return Ok(Outcome::Good);
        }
        self.measured(&case, plan)
    }

    fn plan(&self) -> Result<Plan, Failure> {
        let rising = |option: &str, given: &[usize], usual: &[usize]| {
            let counts = if given.is_empty() { usual } else { given };
            if counts.windows(2).all(|pair| pair[0] < pair[1]) {
                Ok(counts.to_vec())
            } else {
                Err(Failure::Usage(format!(
                    "{option} does not rise (allowed: each count above the one before)"
                )))
            }
        };
        let axes = [
            (AxisName::Step, Axis::Step),
            (AxisName::Grid, Axis::Grid),
            (AxisName::Pixel, Axis::Pixel),
        ];
        let chosen = axes.iter().filter(|(name, _)| self.axes.contains(name));
        Ok(Plan {
            steps: rising("--steps", &self.steps, &[32, 64, 128, 256, 512, 1024, 2048])?,
            cells: rising("--cells", &self.cells, &[8, 16, 32, 64, 128])?,
            pixels: rising("--pixels", &self.pixels, &[8, 16, 32, 64])?,
            side: self.side,
            aspect: self.aspect,
            axes: chosen.map(|(_, axis)| *axis).collect(),
            pixel: if self.mean {
                PixelIs::Mean
            } else {
                PixelIs::Centre
            },
            expected: [self.step_order, self.grid_order, self.pixel_order],
        })
    }

    /// A volume that does not fit is refused before it is made.
    fn budget(&self, plan: &Plan) -> Result<(), Failure> {
        let samples = plan.cells.last().map_or(1.0, |cells| *cells as f64 + 1.0);
        let largest = plan.pixels.iter().chain([&plan.side]).max();
        let [width, height] = plan.size(largest.copied().unwrap_or(1));
        // Two of a volume, as it is made and as it is written, and some dozens of pictures of a few channels.
        let pictures = 8.0 * 4.0 * 32.0 * width as f64 * height as f64;
        Budget {
            what: "the finest grid and the pictures",
            bytes: 16.0 * samples.powi(3) + pictures,
            seconds: 0.0,
            usual: MINUTE,
        }
        .check(self.yes)
    }

    fn measured(&self, case: &VolumeCase, mut plan: Plan) -> Result<Outcome, Failure> {
        let output = Output {
            out: self.out.as_deref(),
            files: vec![("--json", self.json.as_deref())],
            quiet: self.quiet,
            color: self.color,
        };
        output.check()?;
        let (mut renderer, usual) = self.renderer()?;
        for (expected, usual) in plan.expected.iter_mut().zip(usual) {
            *expected = expected.or(usual);
        }
        if self.mean && self.pixel_order.is_none() {
            plan.expected[2] = None;
        }
        let bar = Bar::new(plan.pictures() as u64);
        let found = pictures(case, renderer.as_mut(), &plan, &bar);
        bar.finish();
        let found = found.map_err(said)?;
        let cells = plan.cells.last().copied().unwrap_or(1);
        let like = likeness(case, &found, plan.pixel, cells);
        let imaged = Imaged {
            volume: case.name.clone(),
            pictures: found,
            like,
        };
        output.hand_out(
            &document(&imaged, &about()),
            |directory| {
                let mut paths = write(directory, &imaged, &about())?;
                paths.extend(write_maps(directory, &imaged.pictures)?);
                Ok(paths)
            },
            |_| json(&imaged),
        )?;
        Ok(match imaged.standing() {
            Standing::Good => Outcome::Good,
            Standing::Open | Standing::Bad => Outcome::CheckFailed,
        })
    }

    /// The renderer, and what theory gives of it.
    fn renderer(&self) -> Result<(Box<dyn Renderer>, Orders), Failure> {
        if let [name] = self.renderer.as_slice()
            && let Some(own) = name.strip_prefix("raycast:")
        {
            let own: Own = own.parse().map_err(said)?;
            let expected = own.expected();
            return Ok((Box::new(own), expected));
        }
        let program = Program::new(ProgramOptions {
            words: self.renderer.clone(),
            volume: name_of(&self.volume_format),
            picture: name_of(&self.picture_format),
            single: self.single,
            timeout: Duration::from_secs_f64(self.timeout),
        });
        Ok((
            Box::new(program.map_err(said)?),
            [None, Some(2.0), Some(2.0)],
        ))
    }
}
