//! A renderer that is a program: it reads files and writes a picture.

use super::renderer::{Asked, RenderError, Rendered, Renderer};
use crate::image::file as image_file;
use crate::kernel::process::{Directory, Ended, once};
use crate::volume::Samples;
use crate::volume::file as volume_file;
use crate::volume::file::Turned;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// What stands in words of a command line for what it is given.
pub const PLACEHOLDERS: [&str; 7] = [
    "{volume}",
    "{transfer}",
    "{camera}",
    "{width}",
    "{height}",
    "{step}",
    "{out}",
];

/// How a program is run.
#[derive(Clone, Debug, PartialEq)]
pub struct ProgramOptions {
    /// The program and its words, with placeholders.
    pub words: Vec<String>,
    /// The ending of the file of the volume: vti, nrrd, mha or npy.
    pub volume: String,
    /// The ending of the file that it writes: exr, npy, pfm, png, ppm or pgm.
    pub picture: String,
    /// Samples in binary32.
    pub single: bool,
    /// How long a picture may take.
    pub timeout: Duration,
}

/// A program that renders.
#[derive(Debug)]
pub struct Program {
    options: ProgramOptions,
    directory: Directory,
    /// The volume that is there already.
    volume: Option<(usize, PathBuf)>,
}

impl Program {
    /// A program, with a directory of its own for its files.
    ///
    /// # Errors
    /// [`RenderError::Given`] where there can be none, or words have no `{volume}` or no `{out}`.
    pub fn new(options: ProgramOptions) -> Result<Self, RenderError> {
        for needed in ["{volume}", "{out}"] {
            if !options.words.iter().any(|word| word.contains(needed)) {
                return Err(RenderError::Given(format!(
                    "a command line without {needed} (allowed: one with {})",
                    PLACEHOLDERS.join(", ")
                )));
            }
        }
        let directory = Directory::new()
            .map_err(|error| RenderError::Given(format!("no directory for files: {error}")))?;
        Ok(Program {
            options,
            directory,
            volume: None,
        })
    }

    /// The file of the volume of so many cells; the one before is gone.
    fn volume(&mut self, asked: &Asked<'_>) -> Result<PathBuf, RenderError> {
        if let Some((cells, path)) = &self.volume
            && *cells == asked.cells
        {
            return Ok(path.clone());
        }
        if let Some((_, path)) = self.volume.take() {
            // What cannot be removed goes with the directory.
            let _ = fs::remove_file(path);
        }
        let name = format!("volume-{}.{}", asked.cells, self.options.volume);
        let path = self.directory.path().join(name);
        let mut grid = asked.case.sampled([asked.cells + 1; 3]);
        if self.options.single {
            grid.samples = single(&grid.samples);
        }
        let _: volume_file::Geometry =
            volume_file::write(&path, &grid, Turned::Refused).map_err(given)?;
        self.volume = Some((asked.cells, path.clone()));
        Ok(path)
    }
}

/// In binary32.
fn single(samples: &Samples) -> Samples {
    match samples {
        Samples::F32(values) => Samples::F32(values.clone()),
        #[allow(clippy::cast_possible_truncation)] // As renderers read it.
        Samples::F64(values) => Samples::F32(values.iter().map(|value| *value as f32).collect()),
    }
}

#[allow(clippy::needless_pass_by_value)] // As map_err hands it out.
fn given(error: volume_file::FileError) -> RenderError {
    RenderError::Given(error.to_string())
}

impl Renderer for Program {
    fn name(&self) -> String {
        let words = self.options.words.iter();
        words.cloned().collect::<Vec<_>>().join(" ")
    }

    fn render(&mut self, asked: &Asked<'_>) -> Result<Rendered, RenderError> {
        let volume = self.volume(asked)?;
        let at = |name: &str| self.directory.path().join(name);
        let (transfer, camera) = (at("transfer.json"), at("camera.json"));
        volume_file::write_transfer(&transfer, &asked.case.transfer).map_err(given)?;
        volume_file::write_camera(&camera, &asked.case.camera).map_err(given)?;
        let out = at(&format!("picture.{}", self.options.picture));
        // An old picture is no answer.
        match fs::remove_file(&out) {
            Ok(()) => {}
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {}
            Err(error) => {
                return Err(RenderError::Given(format!("{}: {error}", out.display())));
            }
        }
        let [width, height] = asked.size;
        let shown = |path: &Path| path.display().to_string();
        let values = [
            shown(&volume),
            shown(&transfer),
            shown(&camera),
            width.to_string(),
            height.to_string(),
            asked.step.to_string(),
            shown(&out),
        ];
        let filled = |word: &String| {
            let all = PLACEHOLDERS.iter().zip(&values);
            all.fold(word.clone(), |word, (name, value)| {
                word.replace(name, value)
            })
        };
        let words: Vec<String> = self.options.words.iter().map(filled).collect();
        let Some((program, arguments)) = words.split_first() else {
            return Err(RenderError::Given(
                "no program (allowed: one with words)".into(),
            ));
        };
        let program_name = || program.clone();
        match once(program, arguments, self.options.timeout) {
            Err(error) => Err(RenderError::Start {
                program: program_name(),
                reason: error.to_string(),
            }),
            Ok(Ended::Late) => Err(RenderError::Timeout {
                program: program_name(),
                seconds: self.options.timeout.as_secs_f64(),
            }),
            Ok(Ended::Badly { how, said }) => Err(RenderError::Failed {
                program: program_name(),
                status: how,
                said,
            }),
            Ok(Ended::Well) if !out.exists() => Err(RenderError::Nothing {
                program: program_name(),
                path: format!("picture.{}", self.options.picture),
            }),
            Ok(Ended::Well) => {
                let read = image_file::read(&out)
                    .map_err(|error| RenderError::Picture(error.to_string()))?;
                Ok(Rendered {
                    image: read.image,
                    quantum: read.quantum,
                })
            }
        }
    }
}
