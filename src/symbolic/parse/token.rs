//! The words of the language.

use super::{MAX_TOKENS, ParseError, Problem, Relation};
use std::fmt;

/// A word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Token<'t> {
    Number(&'t str),
    Name(&'t str),
    Plus,
    Minus,
    Times,
    Over,
    Caret,
    Open,
    Close,
    Comma,
    Compare(Relation),
    End,
}

impl fmt::Display for Token<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Token::Number(text) | Token::Name(text) => write!(f, "'{text}'"),
            Token::Plus => f.write_str("'+'"),
            Token::Minus => f.write_str("'-'"),
            Token::Times => f.write_str("'*'"),
            Token::Over => f.write_str("'/'"),
            Token::Caret => f.write_str("'^'"),
            Token::Open => f.write_str("'('"),
            Token::Close => f.write_str("')'"),
            Token::Comma => f.write_str("','"),
            Token::Compare(relation) => write!(f, "'{}'", relation.as_str()),
            Token::End => f.write_str("the end"),
        }
    }
}

/// All words of a text with the bytes they start at, and a place among them.
pub(super) struct Tokens<'t> {
    words: Vec<(usize, Token<'t>)>,
    next: usize,
    end: usize,
}

impl<'t> Tokens<'t> {
    pub(super) fn new(text: &'t str) -> Result<Self, ParseError> {
        let mut tokens = Vec::new();
        let mut at = 0;
        while let Some(rest) = text.get(at..)
            && let Some(first) = rest.chars().next()
        {
            if first.is_ascii_whitespace() {
                at += 1;
                continue;
            }
            if tokens.len() == MAX_TOKENS {
                return Err(ParseError::new(text, at, Problem::TooManyTokens));
            }
            let (token, length) = token(rest, first).ok_or_else(|| {
                ParseError::new(text, at, Problem::UnexpectedCharacter { found: first })
            })?;
            tokens.push((at, token));
            at += length;
        }
        Ok(Tokens {
            words: tokens,
            next: 0,
            end: text.len(),
        })
    }

    pub(super) fn peek(&self) -> (usize, Token<'t>) {
        let end = (self.end, Token::End);
        self.words.get(self.next).copied().unwrap_or(end)
    }

    pub(super) fn next(&mut self) -> (usize, Token<'t>) {
        let token = self.peek();
        self.next += 1;
        token
    }
}

/// The word at the start of `rest`, with its length in bytes.
fn token(rest: &str, first: char) -> Option<(Token<'_>, usize)> {
    let one = |token| Some((token, 1));
    match first {
        '+' => one(Token::Plus),
        '-' => one(Token::Minus),
        '*' => one(Token::Times),
        '/' => one(Token::Over),
        '^' => one(Token::Caret),
        '(' => one(Token::Open),
        ')' => one(Token::Close),
        ',' => one(Token::Comma),
        '<' | '>' => {
            let equal = rest[1..].starts_with('=');
            let relation = match (first, equal) {
                ('<', false) => Relation::Less,
                ('<', true) => Relation::LessEqual,
                (_, false) => Relation::Greater,
                (_, true) => Relation::GreaterEqual,
            };
            Some((Token::Compare(relation), 1 + usize::from(equal)))
        }
        _ if first.is_ascii_digit() || first == '.' => {
            let length = number_length(rest)?;
            Some((Token::Number(&rest[..length]), length))
        }
        _ if first.is_ascii_alphabetic() || first == '_' => {
            let length = rest
                .find(|c: char| !c.is_ascii_alphanumeric() && c != '_')
                .unwrap_or(rest.len());
            Some((Token::Name(&rest[..length]), length))
        }
        _ => None,
    }
}

/// How many bytes the number at the start of `rest` has; `None` for a point alone.
fn number_length(rest: &str) -> Option<usize> {
    let digits = |from: usize| {
        let tail = rest.get(from..).unwrap_or("");
        tail.find(|c: char| !c.is_ascii_digit())
            .unwrap_or(tail.len())
    };
    let whole = digits(0);
    let mut length = whole;
    if rest[length..].starts_with('.') {
        let fraction = digits(length + 1);
        if whole + fraction == 0 {
            return None;
        }
        length += 1 + fraction;
    }
    let exponent = rest[length..].strip_prefix(['e', 'E']);
    if let Some(exponent) = exponent {
        let sign = usize::from(exponent.starts_with(['+', '-']));
        let digits = digits(length + 1 + sign);
        if digits > 0 {
            length += 1 + sign + digits;
        }
    }
    Some(length)
}
