//! All methods at one level: what they have in common is computed once.

use super::{
    Attenuation, Color, Exponential, Inner, Method, MethodError, Nested, Opacity, Preintegrated,
    Scope, Stop, Transmittances, composite,
};
use crate::case::{AnyNodes, Nodes};
use crate::real::Format;
use std::borrow::Cow;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// One ray of n segments, under any number of methods.
///
/// A radiance from here has the same bits as [`Method::radiance`]'s: optical depths, transmittances and
/// segments are kept for the next method that asks, not computed differently.
pub struct Level<'a, F: Format> {
    nodes: AnyNodes<'a, F>,
    n: u64,
    attenuations: HashMap<(Inner, Exponential, Scope), Attenuation<F::Real>>,
    colors: HashMap<Color, Vec<F::Real>>,
    opacities: HashMap<Opacity, Vec<F::Real>>,
}

impl<'a, F: Format> Level<'a, F> {
    /// Nothing computed yet.
    pub fn new<N: Nodes<Format = F>>(nodes: &'a N, n: u64) -> Self {
        Self::of_any(AnyNodes::new(nodes), n)
    }

    /// The same of nodes whose kind is not known.
    #[must_use]
    pub fn of_any(nodes: AnyNodes<'a, F>, n: u64) -> Self {
        Level {
            nodes,
            n,
            attenuations: HashMap::new(),
            colors: HashMap::new(),
            opacities: HashMap::new(),
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
            Method::Nested(nested) => {
                let nodes = self.nodes;
                nested
                    .outer
                    .transmittances(&nodes, self.attenuation(nested)?)
            }
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
        }
    }

    fn nested(&mut self, method: &Nested) -> Result<F::Real, MethodError> {
        let nodes = self.nodes;
        let attenuation = self.attenuation(method)?;
        method.outer.radiance(&nodes, attenuation)
    }

    fn attenuation(&mut self, method: &Nested) -> Result<&Attenuation<F::Real>, MethodError> {
        let Nested {
            inner,
            exponential,
            scope,
            ..
        } = *method;
        let key = (inner, exponential, scope);
        let mut kept = self.attenuations.iter();
        let same_depth = if self.attenuations.contains_key(&key) {
            None
        } else {
            kept.find(|((other, ..), _)| *other == inner)
                .map(|(_, attenuation)| attenuation.with_exponential(exponential, scope))
        };
        Ok(match self.attenuations.entry(key) {
            Entry::Occupied(kept) => kept.into_mut(),
            Entry::Vacant(place) => place.insert(match same_depth {
                Some(attenuation) => attenuation,
                None => Attenuation::new(inner, exponential, scope, &self.nodes, self.n)?,
            }),
        })
    }

    fn color(&mut self, color: Color) -> Result<&[F::Real], MethodError> {
        Ok(match self.colors.entry(color) {
            Entry::Occupied(kept) => kept.into_mut(),
            Entry::Vacant(place) => place.insert(color.segments(&self.nodes, self.n)?),
        })
    }

    fn opacity(&mut self, opacity: Opacity) -> Result<&[F::Real], MethodError> {
        Ok(match self.opacities.entry(opacity) {
            Entry::Occupied(kept) => kept.into_mut(),
            Entry::Vacant(place) => place.insert(opacity.segments(&self.nodes, self.n)?),
        })
    }

    fn preintegrated(&mut self, method: &Preintegrated) -> Result<F::Real, MethodError> {
        self.color(method.color)?;
        self.opacity(method.opacity)?;
        let (colors, opacities) = (&self.colors, &self.opacities);
        match (colors.get(&method.color), opacities.get(&method.opacity)) {
            (Some(colors), Some(segments)) => Ok(composite(self.nodes.format(), colors, segments)),
            _ => method.radiance(&self.nodes, self.n),
        }
    }
}
