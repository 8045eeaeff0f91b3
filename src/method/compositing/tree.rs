//! A row of things merged pairwise, neighbours first, as they come in.

/// A balanced binary tree over a row, of which only the roots of complete parts are kept: at most log₂ n.
///
/// Neighbours are merged in pairs, the results in pairs again, and so on; an odd one is carried up. The
/// last things come in as deep as log₂ n or less.
#[derive(Clone, Debug)]
pub(super) struct Tree<T> {
    /// The roots of ever smaller complete trees.
    roots: Vec<T>,
    count: u64,
}

impl<T> Tree<T> {
    pub(super) fn new() -> Self {
        Tree {
            roots: Vec::new(),
            count: 0,
        }
    }

    /// The merged whole of n things that are all like `item`: complete trees of as many are the same, whichever they are.
    pub(super) fn of_equal(item: T, mut n: u64, merge: impl Fn(T, T) -> T) -> Option<T>
    where
        T: Clone,
    {
        let mut complete = item;
        let mut whole = None;
        while n > 0 {
            if n & 1 == 1 {
                // The smaller trees are behind.
                whole = Some(match whole {
                    None => complete.clone(),
                    Some(behind) => merge(complete.clone(), behind),
                });
            }
            n >>= 1;
            if n > 0 {
                complete = merge(complete.clone(), complete);
            }
        }
        whole
    }

    /// Puts one more behind the others; `merge` is given what is in front first.
    pub(super) fn push(&mut self, mut item: T, merge: impl Fn(T, T) -> T) {
        self.count = self.count.wrapping_add(1);
        // Like a carry in the binary number that counts them.
        for _ in 0..self.count.trailing_zeros() {
            if let Some(front) = self.roots.pop() {
                item = merge(front, item);
            }
        }
        self.roots.push(item);
    }

    /// The merged whole so far, the odd ones carried up; `None` of nothing.
    pub(super) fn root(&self, merge: impl Fn(T, T) -> T) -> Option<T>
    where
        T: Clone,
    {
        let back_to_front = self.roots.iter().rev().cloned();
        back_to_front.reduce(|behind, front| merge(front, behind))
    }
}
