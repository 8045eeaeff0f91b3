//! A name, part by part.

use super::MethodNameError;
use std::fmt::Display;
use std::str::{FromStr, Split};

/// What is left of a name whose parts stand between slashes.
pub(super) struct Parts<'a> {
    name: &'a str,
    rest: Split<'a, char>,
}

impl<'a> Parts<'a> {
    pub(super) fn new(name: &'a str) -> Self {
        let rest = name.split('/');
        Parts { name, rest }
    }

    /// The next part, which there must be.
    pub(super) fn next(
        &mut self,
        what: &'static str,
        allowed: impl FnOnce() -> String,
    ) -> Result<&'a str, MethodNameError> {
        self.rest.next().ok_or_else(|| MethodNameError::Missing {
            name: self.name.into(),
            what,
            allowed: allowed(),
        })
    }

    /// The next part, if there is one.
    pub(super) fn option(&mut self) -> Option<&'a str> {
        self.rest.next()
    }

    /// The next part, which must be the name of one of those.
    pub(super) fn one_of<T: Copy + Display>(
        &mut self,
        what: &'static str,
        all: &[T],
    ) -> Result<T, MethodNameError> {
        let part = self.next(what, || names(all))?;
        find(all, part).ok_or_else(|| self.unknown(what, part, names(all)))
    }

    pub(super) fn unknown(
        &self,
        what: &'static str,
        part: &str,
        allowed: String,
    ) -> MethodNameError {
        MethodNameError::Unknown {
            name: self.name.into(),
            what,
            part: part.into(),
            allowed,
        }
    }

    pub(super) fn repeated(&self, part: &str) -> MethodNameError {
        MethodNameError::Repeated {
            name: self.name.into(),
            part: part.into(),
        }
    }

    /// There must be no more.
    pub(super) fn end(mut self) -> Result<(), MethodNameError> {
        match self.rest.next() {
            None => Ok(()),
            Some(part) => Err(MethodNameError::Extra {
                name: self.name.into(),
                part: part.into(),
            }),
        }
    }
}

/// The one that prints as that.
pub(super) fn find<T: Copy + Display>(all: &[T], text: &str) -> Option<T> {
    all.iter().copied().find(|one| one.to_string() == text)
}

/// All, as they print.
pub(super) fn names<T: Display>(all: &[T]) -> String {
    let names: Vec<String> = all.iter().map(ToString::to_string).collect();
    names.join(", ")
}

/// A number of digits alone: Rust's integers take a sign too.
pub(super) fn number<T: FromStr>(text: &str) -> Option<T> {
    let digits = text.bytes().all(|byte| byte.is_ascii_digit());
    digits.then(|| text.parse().ok()).flatten()
}
