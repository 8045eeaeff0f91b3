//! What is asked of a kernel, as it takes it.

use super::asked::Asked;
use super::{Axis, Identify, Settings, VerifyError, background, left_out};
use crate::kernel::{Declaration, Quantity, Subject};

/// Settings and cases as the declaration lets them be.
pub(super) struct Prepared {
    pub(super) declaration: Declaration,
    pub(super) settings: Settings,
    pub(super) subjects: Vec<Subject>,
    /// Cases that it does not take.
    pub(super) left_out: Vec<String>,
}

impl Prepared {
    pub(super) fn new(
        declaration: &Declaration,
        subjects: &[Subject],
        settings: &Settings,
    ) -> Result<Prepared, VerifyError> {
        declaration.check()?;
        let settings = settings.suited(declaration)?;
        if let (Some(count), Some(most)) = (settings.batch, declaration.batch)
            && count > most.get()
        {
            return Err(VerifyError::Batch { count, most });
        }
        let subjects = background::before(subjects, declaration, &settings)?;
        let (subjects, left_out) = left_out::sorted(subjects, declaration, &settings);
        Ok(Prepared {
            declaration: declaration.clone(),
            settings,
            subjects,
            left_out,
        })
    }

    /// Whether it is read off what it computes: rules are those of radiances.
    pub(super) fn identifies(&self) -> bool {
        self.settings.identify != Identify::Off
            && self.settings.axis == Axis::Step
            && self.declaration.has(Quantity::Radiance)
    }

    pub(super) fn asked<'a>(&'a self, subject: &'a Subject) -> Result<Asked<'a>, VerifyError> {
        Asked::new(subject, &self.settings, &self.declaration)
    }
}
