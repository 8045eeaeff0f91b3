//! Keys of very many parts are refused before the TOML reader makes nested tables of them.

use super::{FileError, FileProblem};
use toml_parser::Source;
use toml_parser::lexer::TokenKind;

/// The most dots of one key. The reader itself bounds arrays and inline tables, but not dotted keys, and
/// tables are dropped recursively.
pub(super) const MAX_DOTS: usize = 7;

pub(super) fn check(text: &str) -> Result<(), FileError> {
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
            return Err(FileError::new(
                text,
                token.span().start(),
                FileProblem::TooDeep,
            ));
        }
    }
    Ok(())
}
