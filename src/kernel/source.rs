//! What a kernel is given for the emission of a ray.

/// Per what an emission is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Source {
    /// C, per unit of optical depth: a radiance.
    #[default]
    Depth,
    /// The source term j = C τ, per unit of length, as of what emits and does not absorb.
    Length,
}

impl Source {
    /// Its name, as in the protocol and in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Source::Depth => "depth",
            Source::Length => "length",
        }
    }
}
