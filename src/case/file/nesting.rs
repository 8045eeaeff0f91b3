//! Keys of very many parts are refused before the TOML reader makes nested tables of them.

use super::{FileError, FileProblem};
use toml_parser::Source;
use toml_parser::lexer::TokenKind;

/// The most dots of one key. The reader itself bounds arrays and inline tables, but not dotted keys, and
/// tables are dropped recursively.
pub(crate) const MAX_DOTS: usize = 7;

pub(super) fn check(text: &str) -> Result<(), FileError> {
    match deepest_dot(text) {
        Some(at) => Err(FileError::new(text, at, FileProblem::TooDeep)),
        None => Ok(()),
    }
}

/// The first dot of a key that is one too many, as a place in `text`.
pub(crate) fn deepest_dot(text: &str) -> Option<usize> {
    let mut dots = 0;
    for token in Source::new(text).lex() {
        match token.kind() {
            TokenKind::Dot => dots += 1,
            TokenKind::Whitespace
            | TokenKind::Atom
            | TokenKind::BasicString
            | TokenKind::LiteralString
            | TokenKind::MlBasicString
            | TokenKind::MlLiteralString => {}
            _ => dots = 0,
        }
        if dots > MAX_DOTS {
            return Some(token.span().start());
        }
    }
    None
}
