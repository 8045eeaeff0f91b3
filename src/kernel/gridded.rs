//! A case as a volume with tables shows it.

use super::{Medium, Subject, Volume};
use rug::Rational;

/// What is left of a ray when it is known by a volume alone.
#[derive(Clone, Copy, Debug)]
pub struct Gridded<'a> {
    subject: &'a Subject,
    volume: &'a Volume,
    length: f64,
}

impl<'a> Gridded<'a> {
    /// The ray of `subject` through `volume`.
    #[must_use]
    pub fn new(subject: &'a Subject, volume: &'a Volume) -> Self {
        Gridded {
            subject,
            volume,
            length: subject.length().to_f64(),
        }
    }
}

impl Medium for Gridded<'_> {
    fn name(&self) -> &str {
        self.subject.name()
    }

    fn channels(&self) -> &[String] {
        self.subject.channels()
    }

    fn length(&self) -> &Rational {
        self.subject.length()
    }

    fn at(&self, lambda: f64, emission: &mut [f64]) -> f64 {
        let s = self.volume.field_at(lambda / self.length);
        self.volume.table.at(s, emission)
    }
}
