//! A ray made up in another form than segments.

use super::code::source;
use super::profile;
use super::steps::Steps;
use crate::identify::ray::Ray;
use crate::identify::rule::Lattice;
use crate::identify::silence::Silence;
use crate::identify::volume::optics::{Optics, tabulated};
use crate::kernel::{Data, FormKind, Formula, Medium, Samples, Task, Volume};
use crate::real::{Format, Native};
use rug::Rational;
use std::ops::Range;

/// A ray as it is put to a kernel.
#[derive(Debug)]
pub(in crate::identify) enum Posed<'r> {
    Segments(&'r Ray),
    Spread(Box<Ray>),
    Made(Box<Made>),
}

impl Posed<'_> {
    pub(in crate::identify) fn task(&self) -> Task<'_> {
        match self {
            Posed::Segments(ray) => ray.task(),
            Posed::Spread(ray) => ray.task(),
            Posed::Made(made) => made.task(),
        }
    }
}

/// A ray whose medium is linear between knots along λ, or one through a volume.
#[derive(Clone, Debug)]
pub(in crate::identify) struct Made {
    name: String,
    channels: Vec<String>,
    length: Rational,
    step: f64,
    pub(in crate::identify) segments: usize,
    seed: u64,
    medium: Shape,
}

#[derive(Clone, Debug)]
enum Shape {
    Function(Samples),
    Formula(Samples, Formula),
    Volume(Volume),
}

impl Made {
    /// A ray through the medium of those knots.
    pub(in crate::identify) fn of_knots(
        name: String,
        form: FormKind,
        steps: Steps,
        knots: Samples,
    ) -> Self {
        let channels = names(knots.emission.len());
        let medium = shaped(form, steps.length, knots, &channels);
        Made::new(name, channels, steps, medium)
    }

    /// A ray through a volume.
    pub(in crate::identify) fn of_volume(name: String, steps: Steps, volume: Volume) -> Self {
        let channels = names(volume.table.emission.len());
        Made::new(name, channels, steps, Shape::Volume(volume))
    }

    fn new(name: String, channels: Vec<String>, steps: Steps, medium: Shape) -> Self {
        Made {
            name,
            channels,
            length: Rational::from_f64(steps.length).unwrap_or_default(),
            step: steps.step,
            segments: steps.segments,
            seed: 0,
            medium,
        }
    }

    fn alike(self, ray: &Ray) -> Self {
        Made {
            seed: ray.seed,
            channels: ray.channels.clone(),
            ..self
        }
    }

    /// The ray's own medium.
    pub(super) fn plain(ray: &Ray, form: FormKind) -> Self {
        let made = Made::of_knots(ray.name.clone(), form, Steps::of(ray), profile::plain(ray));
        Made {
            length: ray.length.clone(),
            ..made.alike(ray)
        }
    }

    /// A ray on which the samples of a lattice see the middles of the ray's segments; what samples there are more see
    /// nothing.
    pub(super) fn on_lattice(
        ray: &Ray,
        form: FormKind,
        lattice: &Lattice,
    ) -> Result<Self, Silence> {
        let wanted = ray.segments.count();
        let steps = lattice.around(&Steps::of(ray), wanted);
        let steps = steps.ok_or(Silence::TooMany { segments: wanted })?;
        let (lambda, lengths) = lattice.places(&steps);
        let middles = &ray.segments.middles;
        let more = lambda.len().saturating_sub(wanted);
        let padded = |values: &Vec<f64>| {
            let mut values = values.clone();
            values.resize(wanted + more, 0.0);
            values
        };
        let samples = Samples {
            extinction: padded(&middles.extinction),
            emission: middles.emission.iter().map(padded).collect(),
            lambda,
        };
        let spacing = lengths.iter().copied().fold(f64::INFINITY, f64::min);
        let knots = profile::around(&samples, spacing / 4.0);
        Ok(Made::of_knots(ray.name.clone(), form, steps, knots).alike(ray))
    }

    /// A volume whose field is λ, with the ray's own medium.
    pub(super) fn tabulated(ray: &Ray) -> Self {
        Made {
            length: ray.length.clone(),
            ..Made::of_volume(ray.name.clone(), Steps::of(ray), tabulated(ray)).alike(ray)
        }
    }

    /// A volume in which the samples see the middles of the ray's segments.
    pub(super) fn volume(ray: &Ray, optics: &Optics) -> Result<Self, Silence> {
        let segments = ray.segments.count();
        let (volume, steps) = optics.around(ray).ok_or(Silence::TooMany { segments })?;
        Ok(Made::of_volume(ray.name.clone(), steps, volume).alike(ray))
    }

    /// How many channels.
    pub(in crate::identify) fn channels(&self) -> usize {
        self.channels.len()
    }

    /// The same ray with the channels of that range alone.
    pub(in crate::identify) fn part(&self, range: Range<usize>) -> Self {
        let channels = self.channels[range.clone()].to_vec();
        let cut = |samples: &Samples| Samples {
            emission: samples.emission[range.clone()].to_vec(),
            ..samples.clone()
        };
        let length = Native::<f64>::new().ratio(&self.length);
        let medium = match &self.medium {
            Shape::Function(knots) => Shape::Function(cut(knots)),
            Shape::Formula(knots, formula) => shaped(
                FormKind::Formula(formula.language),
                length,
                cut(knots),
                &channels,
            ),
            Shape::Volume(volume) => {
                let mut volume = volume.clone();
                volume.table.emission = volume.table.emission[range.clone()].to_vec();
                Shape::Volume(volume)
            }
        };
        Made {
            channels,
            medium,
            ..self.clone()
        }
    }

    pub(in crate::identify) fn task(&self) -> Task<'_> {
        Task {
            subject: self,
            step: self.step,
            segments: self.segments as u64,
            seed: self.seed,
            data: match &self.medium {
                Shape::Function(_) => Data::Function,
                Shape::Formula(_, formula) => Data::Formula(formula),
                Shape::Volume(volume) => Data::Volume(volume),
            },
        }
    }
}

fn names(count: usize) -> Vec<String> {
    (0..count).map(|k| format!("c{k}")).collect()
}

fn shaped(form: FormKind, length: f64, knots: Samples, channels: &[String]) -> Shape {
    match form {
        FormKind::Formula(language) => {
            let code = source(language, length, &knots, channels);
            Shape::Formula(knots, Formula { language, code })
        }
        FormKind::Function | FormKind::Segments | FormKind::Volume => Shape::Function(knots),
    }
}

impl Medium for Made {
    fn name(&self) -> &str {
        &self.name
    }

    fn channels(&self) -> &[String] {
        &self.channels
    }

    fn length(&self) -> &Rational {
        &self.length
    }

    fn at(&self, lambda: f64, emission: &mut [f64]) -> f64 {
        match &self.medium {
            Shape::Function(knots) | Shape::Formula(knots, _) => {
                profile::at(knots, lambda, emission)
            }
            Shape::Volume(volume) => {
                let length = Native::<f64>::new().ratio(&self.length);
                volume.table.at(volume.field_at(lambda / length), emission)
            }
        }
    }
}
