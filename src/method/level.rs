//! All methods at one level: what they have in common is computed once.

mod kept;

use super::exponential::{Alone, Exponentials};
use super::outer::GroupSums;
use super::{
    Attenuation, Color, Exponential, Inner, Method, MethodError, Nested, Opacity, Outer,
    Preintegrated, Scope, Stop, Transmittances, composite,
};
use crate::case::{AnyNodes, Nodes};
use crate::real::{Format, row, try_row};
use kept::Kept;
use std::borrow::Cow;
use std::convert::Infallible;

/// What an attenuation is made by.
type Way = (Inner, Exponential, Scope);

/// One ray of n segments, under any number of methods.
///
/// A radiance from here has the same bits as [`Method::radiance`]'s: optical depths, transmittances and
/// segments are kept for the next method that asks, not computed differently.
pub struct Level<'a, F: Format> {
    nodes: AnyNodes<'a, F>,
    n: u64,
    exponentials: &'a dyn Exponentials<F::Real>,
    /// Whether terms are summed up once for all outer rules.
    sums_are_shared: bool,
    attenuations: Kept<Way, Attenuation<F::Real>>,
    /// T inside segments, a row for each node of the outer rule.
    inside: Kept<(Way, Outer), Vec<Vec<F::Real>>>,
    /// C τ at boundaries.
    sources: Kept<(), Vec<F::Real>>,
    /// C τ T there.
    terms: Kept<Way, Vec<F::Real>>,
    /// Those, summed up.
    sums: Kept<Way, GroupSums<F::Real>>,
    colors: Kept<Color, Vec<F::Real>>,
    opacities: Kept<Opacity, Vec<F::Real>>,
}

impl<'a, F: Format> Level<'a, F> {
    /// Nothing computed yet.
    pub fn new<N: Nodes<Format = F>>(nodes: &'a N, n: u64) -> Self {
        Self::of_any(AnyNodes::new(nodes), n)
    }

    /// The same of nodes whose kind is not known.
    #[must_use]
    pub fn of_any(nodes: AnyNodes<'a, F>, n: u64) -> Self {
        Self::taking(nodes, n, &Alone)
    }

    /// The same to the last few places alone, of nested rules: exponentials are taken by somebody who knows some that are near,
    /// and terms are summed up once for all outer rules.
    #[cfg(feature = "studies")]
    pub(crate) fn nearly(
        nodes: AnyNodes<'a, F>,
        n: u64,
        exponentials: &'a dyn Exponentials<F::Real>,
    ) -> Self {
        Level {
            sums_are_shared: true,
            ..Self::taking(nodes, n, exponentials)
        }
    }

    /// The same, exponentials of nested rules being taken by somebody else.
    pub(crate) fn taking(
        nodes: AnyNodes<'a, F>,
        n: u64,
        exponentials: &'a dyn Exponentials<F::Real>,
    ) -> Self {
        Level {
            nodes,
            n,
            exponentials,
            sums_are_shared: false,
            attenuations: Kept::new(),
            inside: Kept::new(),
            sources: Kept::new(),
            terms: Kept::new(),
            sums: Kept::new(),
            colors: Kept::new(),
            opacities: Kept::new(),
        }
    }

    /// The radiance by `method`.
    ///
    /// # Errors
    /// As [`Method::radiance`].
    pub fn radiance(&mut self, method: &Method) -> Result<F::Real, MethodError> {
        match method {
            Method::Nested(nested) => self.nested(nested),
            Method::Composited(compositing) => compositing.radiance(&self.nodes, self.n),
            Method::Preintegrated(preintegrated) => self.preintegrated(preintegrated),
            Method::Layered(layers) => layers.radiance(&self.nodes, self.n),
        }
    }

    /// The nodes.
    #[must_use]
    pub fn nodes(&self) -> AnyNodes<'a, F> {
        self.nodes
    }

    /// n.
    #[must_use]
    pub fn segments(&self) -> u64 {
        self.n
    }

    /// T wherever the sum of `method` looks, in rows; no rows where it takes none.
    ///
    /// # Errors
    /// As [`Method::radiance`].
    pub fn transmittances(
        &mut self,
        method: &Method,
    ) -> Result<Transmittances<'_, F::Real>, MethodError> {
        match method {
            Method::Nested(nested) if nested.outer.0.intervals().is_some() => {
                let attenuation = self.attenuation(nested)?;
                Ok(vec![Cow::Borrowed(attenuation.at_boundaries())])
            }
            Method::Nested(nested) => Ok(borrowed(self.inside(nested)?)),
            Method::Composited(compositing) => {
                let composite = compositing.composite(&self.nodes, self.n, Stop::AsDeclared)?;
                let row = Some(composite.transmittances).filter(|row| !row.is_empty());
                Ok(row.into_iter().map(Cow::Owned).collect())
            }
            Method::Preintegrated(preintegrated) => {
                let format = self.nodes.format();
                let segments = self.opacity(preintegrated.opacity)?;
                let mut transmittance = format.int(1);
                let mut row = Vec::with_capacity(segments.len());
                for segment in segments {
                    row.push(transmittance.clone());
                    transmittance *= segment;
                }
                Ok(vec![Cow::Owned(row)])
            }
            Method::Layered(_) => Ok(Vec::new()),
        }
    }

    /// The radiance by `method` under transmittances from elsewhere: rows like those of
    /// [`Level::transmittances`], of another format for instance.
    ///
    /// # Errors
    /// As [`Method::radiance`].
    pub fn radiance_under(
        &mut self,
        method: &Method,
        transmittances: &[Cow<'_, [F::Real]>],
    ) -> Result<F::Real, MethodError> {
        match method {
            Method::Nested(nested) => {
                let outer = nested.outer;
                outer.radiance_under(&self.nodes, self.n, transmittances)
            }
            Method::Composited(compositing) => {
                let row = transmittances.first().map_or(&[][..], |row| row);
                let under = compositing.radiance_under(&self.nodes, self.n, row);
                under.unwrap_or_else(|| compositing.radiance(&self.nodes, self.n))
            }
            Method::Preintegrated(preintegrated) => {
                let mut radiance = self.nodes.format().int(0);
                let colors = self.color(preintegrated.color)?;
                let row = transmittances.iter().flat_map(|row| row.iter());
                for (color, transmittance) in colors.iter().zip(row) {
                    radiance += &(transmittance.clone() * color);
                }
                Ok(radiance)
            }
            Method::Layered(layers) => layers.radiance(&self.nodes, self.n),
        }
    }

    fn nested(&mut self, method: &Nested) -> Result<F::Real, MethodError> {
        let (nodes, n, outer) = (self.nodes, self.n, method.outer);
        match outer.0.intervals() {
            Some(intervals) if !self.sums_are_shared => {
                outer.radiance_of_terms(&nodes, n, self.terms(method)?, intervals)
            }
            Some(intervals) => {
                let sums = self.sums(method)?;
                match outer.radiance_of_sums(&nodes, n, sums) {
                    Some(radiance) => radiance,
                    None => outer.radiance_of_terms(&nodes, n, self.terms(method)?, intervals),
                }
            }
            None => outer.radiance_under(&nodes, n, &borrowed(self.inside(method)?)),
        }
    }

    /// C τ T at boundaries under transmittances from elsewhere, of no more bits than the level has, summed up: what [`Level::radiance_of_sums`] of all outer rules
    /// shares.
    #[cfg(feature = "studies")]
    pub(crate) fn sums_under(&mut self, transmittances: &[F::Real]) -> GroupSums<F::Real> {
        let sources = Self::sources(&mut self.sources, self.nodes, self.n);
        GroupSums::new(sources, transmittances, &self.nodes.format().int(0))
    }

    /// The same of the method's own.
    fn sums(&mut self, method: &Nested) -> Result<&GroupSums<F::Real>, MethodError> {
        let zero = self.nodes.format().int(0);
        self.attenuation(method)?;
        let way = way(method);
        let sources = Self::sources(&mut self.sources, self.nodes, self.n);
        let attenuations = &self.attenuations;
        self.sums.get_or_compute(way, |_| {
            let transmittances = attenuations.find(|known| *known == way);
            let transmittances = transmittances.map_or(&[][..], Attenuation::at_boundaries);
            Ok(GroupSums::new(sources, transmittances, &zero))
        })
    }

    /// The radiance of C τ T at boundaries, summed up; `None` where the outer rule has another use for them.
    #[cfg(feature = "studies")]
    pub(crate) fn radiance_of_sums(
        &self,
        outer: Outer,
        sums: &GroupSums<F::Real>,
    ) -> Option<Result<F::Real, MethodError>> {
        outer.radiance_of_sums(&self.nodes, self.n, sums)
    }

    /// C τ at boundaries.
    fn sources<'k>(
        kept: &'k mut Kept<(), Vec<F::Real>>,
        nodes: AnyNodes<'_, F>,
        n: u64,
    ) -> &'k [F::Real] {
        let sources = kept.get_or_compute((), |_| {
            let column = nodes.boundaries(n);
            let both = column.emission.iter().zip(&column.extinction);
            let sources = row(both.map(|(emission, tau)| emission.clone() * tau));
            Ok::<_, Infallible>(sources)
        });
        match sources {
            Ok(sources) => sources,
        }
    }

    /// T inside segments.
    fn inside(&mut self, method: &Nested) -> Result<&[Vec<F::Real>], MethodError> {
        let (nodes, outer, by) = (self.nodes, method.outer, self.exponentials);
        self.attenuation(method)?;
        let way = way(method);
        let attenuations = &self.attenuations;
        let rows = self.inside.get_or_compute((way, outer), |_| {
            let table = outer.0.table(nodes.format().bits())?;
            let attenuation = attenuations.find(|known| *known == way);
            let inside = attenuation.map(|attenuation| {
                let offsets = table.nodes.iter();
                try_row(offsets.map(|offset| attenuation.inside_by(&nodes, offset, by)))
            });
            inside.unwrap_or_else(|| Ok(Vec::new()))
        })?;
        Ok(rows)
    }

    /// C τ T at boundaries.
    fn terms(&mut self, method: &Nested) -> Result<&[F::Real], MethodError> {
        self.attenuation(method)?;
        let sources = Self::sources(&mut self.sources, self.nodes, self.n);
        let way = way(method);
        let attenuations = &self.attenuations;
        let terms = self.terms.get_or_compute(way, |_| {
            let transmittances = attenuations.find(|known| *known == way);
            let transmittances = transmittances.map_or(&[][..], Attenuation::at_boundaries);
            let both = sources.iter().zip(transmittances);
            Ok::<_, MethodError>(row(both.map(|(source, t)| source.clone() * t)))
        })?;
        Ok(terms)
    }

    fn attenuation(&mut self, method: &Nested) -> Result<&Attenuation<F::Real>, MethodError> {
        let key = way(method);
        let (inner, exponential, scope) = key;
        let (nodes, n, by) = (self.nodes, self.n, self.exponentials);
        self.attenuations.get_or_compute(key, |kept| {
            let same_depth = kept.find(|(other, ..)| *other == inner);
            match same_depth {
                Some(other) => Ok(other.with_exponential_by(exponential, scope, by)),
                None => Attenuation::by(inner, exponential, scope, &nodes, n, by),
            }
        })
    }

    fn color(&mut self, color: Color) -> Result<&[F::Real], MethodError> {
        let (nodes, n) = (self.nodes, self.n);
        let compute = |_: &_| color.segments(&nodes, n);
        Ok(self.colors.get_or_compute(color, compute)?)
    }

    fn opacity(&mut self, opacity: Opacity) -> Result<&[F::Real], MethodError> {
        let (nodes, n) = (self.nodes, self.n);
        let compute = |_: &_| opacity.segments(&nodes, n);
        Ok(self.opacities.get_or_compute(opacity, compute)?)
    }

    fn preintegrated(&mut self, method: &Preintegrated) -> Result<F::Real, MethodError> {
        self.color(method.color)?;
        self.opacity(method.opacity)?;
        let colors = self.colors.find(|color| *color == method.color);
        let segments = self.opacities.find(|opacity| *opacity == method.opacity);
        match (colors, segments) {
            (Some(colors), Some(segments)) => Ok(composite(self.nodes.format(), colors, segments)),
            _ => method.radiance(&self.nodes, self.n),
        }
    }
}

fn way(method: &Nested) -> Way {
    (method.inner, method.exponential, method.scope)
}

/// Rows of transmittances as outer rules take them.
fn borrowed<R: Clone>(rows: &[Vec<R>]) -> Transmittances<'_, R> {
    row(rows.iter().map(|values| Cow::Borrowed(&values[..])))
}
