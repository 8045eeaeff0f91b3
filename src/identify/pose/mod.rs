//! How a ray is put to a kernel: in segments, as a function of λ, as source code or as a volume with tables.

mod code;
mod made;
pub(super) mod profile;
mod spread;
pub(super) mod steps;

pub(super) use made::{Made, Posed};
pub(super) use profile::{at, hats, plain};
pub(super) use spread::Spread;
pub(super) use steps::Steps;

use super::ray::Ray;
use super::rule::Lattice;
use super::silence::Silence;
use super::volume::optics::Optics;
use crate::kernel::FormKind;

/// In what form a kernel is asked, and what is known of the places where it looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pose {
    pub(super) form: FormKind,
    /// Rays are made for samples at these places: each sees the middle of one segment.
    pub(super) places: Known,
}

/// What is known of the places where a kernel looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Known {
    /// Nothing: the ends and middles of segments lie where they are said to.
    Nodes,
    /// Along λ.
    Lattice(Lattice),
    /// Through a volume's field and table.
    Volume(Optics),
    /// In segments, of which some are sampled twice or never.
    Spread(Spread),
}

impl Pose {
    pub(super) fn new(form: FormKind) -> Self {
        Pose {
            form,
            places: Known::Nodes,
        }
    }

    /// Where samples lie along λ, where that is known.
    pub(super) fn lattice(&self) -> Option<Lattice> {
        match self.places {
            Known::Lattice(lattice) => Some(lattice),
            Known::Nodes | Known::Volume(_) | Known::Spread(_) => None,
        }
    }

    /// The ray in this form.
    pub(super) fn of<'r>(&self, ray: &'r Ray) -> Result<Posed<'r>, Silence> {
        if self.form == FormKind::Segments {
            return Ok(match &self.places {
                Known::Spread(spread) => Posed::Spread(Box::new(spread.of(ray)?)),
                _ => Posed::Segments(ray),
            });
        }
        let made = match &self.places {
            Known::Volume(optics) => Made::volume(ray, optics)?,
            Known::Lattice(lattice) => Made::on_lattice(ray, self.form, lattice)?,
            Known::Nodes if self.form == FormKind::Volume => Made::tabulated(ray),
            Known::Nodes | Known::Spread(_) => Made::plain(ray, self.form),
        };
        Ok(Posed::Made(Box::new(made)))
    }
}
