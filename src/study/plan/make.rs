//! Making a plan, and what it says.

use super::draft::{Draft, Lacking, working_bits};
use super::run::{Rendered, Task, run};
use super::settings::MAX_BITS;
use super::stored::{Checked, CheckedChannel, StoredPlan};
use super::truth::scene_radiance;
use super::{PlanError, Settings};
use crate::real::{Format, FormatName, Mpfr, Native, NativeFloat, Real, WithFormat, row};
use crate::scene::Scene;
use rug::Float;

/// The models of a scene that are enough for a tolerance, and a format.
#[derive(Clone, Debug)]
pub struct Plan {
    pub(super) scene: Scene,
    pub(super) stored: StoredPlan,
    pub(super) tasks: Vec<Task>,
    pub(super) background: bool,
    pub(super) format: FormatName,
}

impl Plan {
    /// The plan of fewest evaluations for a tolerance, in binary32, binary64 or as many bits as it takes.
    ///
    /// ```
    /// use volver::scene;
    /// use volver::study::plan::Plan;
    ///
    /// let text = "
    ///     [[media]]
    ///     from = 0
    ///     to = 2
    ///     kind = 'constant'
    ///     extinction = 0.5
    ///     emission = 1
    /// ";
    /// let scene = scene::read(text, std::path::Path::new("."))?;
    /// let rendered = Plan::for_scene(&scene, 1e-4)?.run::<f32>()?;
    /// assert_eq!(rendered.evaluations, 1);
    /// assert!((rendered.radiance[0] - (1.0 - (-1_f32).exp())).abs() < 1e-4);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`PlanError`] where the media cannot be bounded.
    pub fn for_scene(scene: &Scene, tolerance: f64) -> Result<Plan, PlanError> {
        Plan::new(scene, &Settings::new(tolerance))
    }

    /// The plan that is cheapest in the sense of the settings.
    ///
    /// # Errors
    /// [`PlanError`] where the media cannot be bounded, or no allowed format is good enough.
    pub fn new(scene: &Scene, settings: &Settings) -> Result<Plan, PlanError> {
        let tolerance = settings.tolerance;
        if !(tolerance.is_finite() && tolerance >= f64::MIN_POSITIVE) {
            return Err(PlanError::Tolerance { tolerance });
        }
        let mut bits = working_bits(scene, tolerance);
        loop {
            let drafted = if bits <= f64::MANTISSA_DIGITS {
                match Draft::new(scene, settings, Native::<f64>::new()) {
                    Err(error) if error.is_of_range() => Err(Lacking::Models),
                    drafted => drafted?,
                }
            } else {
                Draft::new(scene, settings, Mpfr { bits })?
            };
            match drafted {
                Ok(draft) => return draft.in_a_format(scene, settings),
                // MPFR has the range that binary64 lacks; more bits have no more of it.
                Err(Lacking::Models) if bits > f64::MANTISSA_DIGITS => {
                    return Err(PlanError::Models { tolerance });
                }
                Err(_) if bits < MAX_BITS => bits = (2 * bits).max(128),
                Err(_) => return Err(PlanError::Bits { tolerance, bits }),
            }
        }
    }

    /// The plan as it is kept.
    #[must_use]
    pub fn stored(&self) -> &StoredPlan {
        &self.stored
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The format that it is for.
    #[must_use]
    pub fn format(&self) -> FormatName {
        self.format
    }

    /// How often C and τ are evaluated.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.stored.evaluations
    }

    /// Runs it in its own format and keeps what comes out beside the radiance to many digits.
    ///
    /// # Errors
    /// [`PlanError`] where it does not run, or where the radiance cannot be had.
    pub fn check(&mut self) -> Result<&Checked, PlanError> {
        // Digits beyond the tolerance tell how far it is from being reached.
        let digits = -self.stored.tolerance.min(1.0).log10() + 6.0;
        // At most some 320.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let digits = digits.ceil() as u32;
        let bits = 4 * digits + 8;
        let exact = scene_radiance(&self.scene, bits)?;
        let found = self.format.with(Running { plan: self })?;
        let names = self.scene.channels().iter();
        let channels =
            names
                .zip(found.iter().zip(&exact))
                .map(|(name, ((value, shown), exact))| {
                    let error = Float::with_val(bits, value - exact).abs();
                    CheckedChannel {
                        channel: name.clone(),
                        radiance: shown.clone(),
                        reference: exact.to_string_radix(10, Some(digits as usize)),
                        error: error.to_f64(),
                    }
                });
        let checked = Checked {
            channels: channels.collect(),
        };
        Ok(self.stored.checked.insert(checked))
    }

    /// Runs it in a native type.
    ///
    /// # Errors
    /// [`PlanError::NotFinite`] where the type's range is too short.
    pub fn run<T: NativeFloat>(&self) -> Result<Rendered<T>, PlanError> {
        self.run_in(Native::<T>::new())
    }

    /// Runs it in a format.
    ///
    /// # Errors
    /// [`PlanError::NotFinite`] where the format's range is too short.
    pub fn run_in<F: Format>(&self, format: F) -> Result<Rendered<F::Real>, PlanError> {
        run(&self.scene, &self.tasks, self.background, format)
    }
}

/// The radiance of a plan by channel: the number, and how it prints.
struct Running<'a> {
    plan: &'a Plan,
}

impl WithFormat for Running<'_> {
    type Output = Result<Vec<(Float, String)>, PlanError>;

    fn run<F: Format>(self, format: F) -> Self::Output {
        let rendered = self.plan.run_in(format)?;
        let radiance = rendered.radiance.iter();
        Ok(row(radiance.map(|r| (r.to_float(), r.to_string()))))
    }
}
