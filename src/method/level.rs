//! All methods at one level: what they have in common is computed once.

use super::{
    Attenuation, Color, Exponential, Inner, Method, MethodError, Nested, Opacity, Preintegrated,
    Scope, composite,
};
use crate::case::{Nodes, Number};
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// One ray of n segments, under any number of methods.
///
/// A radiance from here has the same bits as [`Method::radiance`]'s: optical depths, transmittances and
/// segments are kept for the next method that asks, not computed differently.
pub struct Level<'a, N: Nodes> {
    nodes: &'a N,
    n: u64,
    attenuations: HashMap<(Inner, Exponential, Scope), Attenuation<'a, N>>,
    colors: HashMap<Color, Vec<Number<N>>>,
    opacities: HashMap<Opacity, Vec<Number<N>>>,
}

impl<'a, N: Nodes> Level<'a, N> {
    /// Nothing computed yet.
    pub fn new(nodes: &'a N, n: u64) -> Self {
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
    pub fn radiance(&mut self, method: &Method) -> Result<Number<N>, MethodError> {
        match method {
            Method::Nested(nested) => self.nested(nested),
            Method::Preintegrated(preintegrated) => self.preintegrated(preintegrated),
        }
    }

    fn nested(&mut self, method: &Nested) -> Result<Number<N>, MethodError> {
        let Nested {
            inner,
            outer,
            exponential,
            scope,
        } = *method;
        let key = (inner, exponential, scope);
        if let Some(attenuation) = self.attenuations.get(&key) {
            return outer.radiance(attenuation);
        }
        let same_depth = self
            .attenuations
            .iter()
            .find(|((other, ..), _)| *other == inner)
            .map(|(_, attenuation)| attenuation.with_exponential(exponential, scope));
        let attenuation = match same_depth {
            Some(attenuation) => attenuation,
            None => Attenuation::new(inner, exponential, scope, self.nodes, self.n)?,
        };
        let radiance = outer.radiance(&attenuation);
        self.attenuations.insert(key, attenuation);
        radiance
    }

    fn preintegrated(&mut self, method: &Preintegrated) -> Result<Number<N>, MethodError> {
        let Preintegrated { color, opacity } = *method;
        let colors = match self.colors.entry(color) {
            Entry::Occupied(kept) => kept.into_mut(),
            Entry::Vacant(place) => place.insert(color.segments(self.nodes, self.n)?),
        };
        let transmittances = match self.opacities.entry(opacity) {
            Entry::Occupied(kept) => kept.into_mut(),
            Entry::Vacant(place) => place.insert(opacity.segments(self.nodes, self.n)?),
        };
        Ok(composite(self.nodes.format(), colors, transmittances))
    }
}
