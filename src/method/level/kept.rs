//! What is computed once and kept: so little that it is looked through from the front.

/// Values by keys.
pub(super) struct Kept<K, V>(Vec<(K, V)>);

impl<K: PartialEq, V> Kept<K, V> {
    /// Nothing yet.
    pub(super) fn new() -> Self {
        Kept(Vec::new())
    }

    /// The value of a key that suits.
    pub(super) fn find(&self, suits: impl Fn(&K) -> bool) -> Option<&V> {
        let found = self.0.iter().find(|(key, _)| suits(key));
        found.map(|(_, value)| value)
    }

    /// The value of `key`, computed from what is kept so far where it is not there.
    pub(super) fn get_or_compute<E>(
        &mut self,
        key: K,
        compute: impl FnOnce(&Self) -> Result<V, E>,
    ) -> Result<&V, E> {
        let known = self.0.iter().position(|(kept, _)| *kept == key);
        let place = known.unwrap_or(self.0.len());
        if known.is_none() {
            let value = compute(self)?;
            self.0.push((key, value));
        }
        Ok(&self.0[place].1)
    }
}
