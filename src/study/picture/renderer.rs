//! What makes pictures: a program, or the library's own.

use crate::case::volume::VolumeCase;
use crate::image::Image;

/// One picture of a volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asked<'a> {
    /// The volume, its transfer functions and its camera.
    pub case: &'a VolumeCase,
    /// Cells of the grid along each axis: one less than samples.
    pub cells: usize,
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// The length of steps along rays.
    pub step: f64,
}

/// A picture, and the quantum of its values where they are multiples of one.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendered {
    /// The picture.
    pub image: Image,
    /// 1/255 of 8 bits, say.
    pub quantum: Option<f64>,
}

/// What makes pictures.
pub trait Renderer {
    /// What it is called.
    fn name(&self) -> String;

    /// Whether rays are cut into as many equal segments as are no longer than the step; `None` where nobody knows.
    fn has_equal_segments(&self) -> Option<bool> {
        None
    }

    /// Makes a picture.
    ///
    /// # Errors
    /// What went wrong, in one line, with what is allowed.
    fn render(&mut self, asked: &Asked<'_>) -> Result<Rendered, RenderError>;
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// It could not be started.
    #[error("'{program}' could not be started: {reason}")]
    Start {
        /// The program.
        program: String,
        /// The system's reason.
        reason: String,
    },
    /// It took too long.
    #[error("'{program}' took more than {seconds} s (allowed: --timeout)")]
    Timeout {
        /// The program.
        program: String,
        /// How long it was waited for.
        seconds: f64,
    },
    /// It failed.
    #[error("'{program}' {status}; the last that it said: {said}")]
    Failed {
        /// The program.
        program: String,
        /// How it ended.
        status: String,
        /// The last line that it wrote to standard error, or output.
        said: String,
    },
    /// It wrote nothing.
    #[error("'{program}' ended well and wrote no {path}")]
    Nothing {
        /// The program.
        program: String,
        /// What it should have written.
        path: String,
    },
    /// What it wrote is no picture, or not the one that was asked for.
    #[error("{0}")]
    Picture(String),
    /// Nobody sees the volume.
    #[error("no ray of the picture meets the volume (allowed: a camera that sees it)")]
    Unseen,
    /// A file that it is given could not be written.
    #[error("{0}")]
    Given(String),
}

impl Rendered {
    /// The same, where it has the size and the channels that were asked for; more channels than asked for (opacity) are
    /// left out.
    ///
    /// # Errors
    /// [`RenderError::Picture`].
    pub fn fitting(self, asked: &Asked<'_>) -> Result<Rendered, RenderError> {
        let [width, height] = asked.size;
        let image = self.image;
        if [image.width, image.height] != asked.size {
            return Err(RenderError::Picture(format!(
                "a picture of {} × {} pixels (allowed: {width} × {height}, as asked for)",
                image.width, image.height
            )));
        }
        let wanted = &asked.case.transfer.channels;
        let has = image.channels.len();
        if has < wanted.len() {
            return Err(RenderError::Picture(format!(
                "a picture of {has} channels (allowed: {}, {})",
                wanted.len(),
                wanted.join(", ")
            )));
        }
        if has == wanted.len() && image.channels == *wanted {
            return Ok(Rendered { image, ..self });
        }
        // By name where all names are there, else in their order.
        let named: Option<Vec<usize>> = wanted
            .iter()
            .map(|name| {
                let is_it = |channel: &String| channel.eq_ignore_ascii_case(name);
                image.channels.iter().position(is_it)
            })
            .collect();
        let places = named.unwrap_or_else(|| (0..wanted.len()).collect());
        let mut fitting = Image::new(width, height, wanted.clone());
        let pixels = image.values.chunks_exact(has.max(1));
        let all = pixels.flat_map(|pixel| places.iter().map(|&k| pixel[k]));
        fitting.values = all.collect();
        Ok(Rendered {
            image: fitting,
            quantum: self.quantum,
        })
    }
}
