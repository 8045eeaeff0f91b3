//! Replacing symbols.

use super::Expr;
use crate::symbolic::hash::HashMap;

impl Expr {
    /// Every occurrence of `symbol` replaced by `replacement`.
    #[must_use]
    pub fn substitute(&self, symbol: &str, replacement: &Expr) -> Expr {
        self.substitute_all(|name| (name == symbol).then(|| replacement.clone()))
    }

    /// Every symbol for which `replacement` gives something replaced by it, all at once.
    #[must_use]
    pub fn substitute_all(&self, replacement: impl Fn(&str) -> Option<Expr>) -> Expr {
        // Only what was a symbol before: a sum that becomes one, x + 1 − 1, is done.
        self.rebuild_each(|old, _| match old.kind() {
            super::Kind::Symbol(name) => replacement(name),
            _ => None,
        })
    }

    /// The same expression with every node for which `replace` gives something replaced by it, from the
    /// parts up: `replace` sees a node after its parts are rebuilt.
    #[must_use]
    pub fn rebuild(&self, mut replace: impl FnMut(&Expr) -> Option<Expr>) -> Expr {
        self.rebuild_each(|_, new| replace(new))
    }

    /// The same for every node as it was and as it is with its parts rebuilt.
    fn rebuild_each(&self, mut replace: impl FnMut(&Expr, &Expr) -> Option<Expr>) -> Expr {
        let mut rebuilt: HashMap<&Expr, Expr> = HashMap::default();
        for node in self.nodes() {
            let parts: Vec<Expr> = node
                .parts()
                .into_iter()
                .map(|part| rebuilt.get(part).unwrap_or(part).clone())
                .collect();
            let same = parts.iter().eq(node.parts());
            let new = if same {
                node.clone()
            } else {
                node.with_parts(&parts)
            };
            let new = replace(node, &new).unwrap_or(new);
            rebuilt.insert(node, new);
        }
        rebuilt.remove(self).unwrap_or_else(|| self.clone())
    }
}
