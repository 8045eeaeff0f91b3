//! The formula in LaTeX: the lines of text in another alphabet.

use super::Rule;
use super::text::{Line, lines};
use std::fmt::Write as _;

/// What a sign is in LaTeX.
fn sign(c: char) -> Option<&'static str> {
    Some(match c {
        'ⱼ' => "_j",
        'ₖ' => "_k",
        'α' => "\\alpha ",
        'β' => "\\beta ",
        'τ' => "\\tau ",
        'λ' => "\\lambda ",
        'Σ' => "\\sum ",
        'Π' => "\\prod ",
        '∫' => "\\int ",
        '−' => "-",
        '≈' => "\\approx ",
        '≤' => "\\le ",
        '≥' => "\\ge ",
        '½' => "\\tfrac12 ",
        '²' => "^2",
        '³' => "^3",
        '₀' => "_0",
        '¹' => "^1",
        '⌊' => "\\lfloor ",
        '⌋' => "\\rfloor ",
        '⌈' => "\\lceil ",
        '⌉' => "\\rceil ",
        '·' => "\\cdot ",
        '%' => "\\%",
        _ => return None,
    })
}

/// Words that are operators.
const OPERATORS: [&str; 4] = ["exp", "min", "max", "ln"];

/// A formula's signs, one after the other.
fn translated(formula: &str) -> String {
    let mut out = String::new();
    let mut rest = formula;
    let mut after_digit = false;
    while let Some(c) = rest.chars().next() {
        if let Some(operator) = OPERATORS.iter().find(|o| rest.starts_with(**o)) {
            out.push('\\');
            out.push_str(operator);
            rest = &rest[operator.len()..];
            continue;
        }
        if let Some(next) = rest.strip_prefix(",  ") {
            out.push_str(",\\quad ");
            rest = next;
            continue;
        }
        let words = phrase(rest);
        if !words.is_empty() {
            let _ = write!(out, "\\text{{ {} }}", words.trim());
            rest = &rest[words.len()..];
            continue;
        }
        let behind = &rest[c.len_utf8()..];
        match (c, inside(behind)) {
            ('√', Some((inner, behind))) => {
                let _ = write!(out, "\\sqrt{{{}}}", translated(inner));
                rest = behind;
                continue;
            }
            ('^', Some((inner, behind))) => {
                let _ = write!(out, "^{{{}}}", translated(inner));
                rest = behind;
                continue;
            }
            _ => {}
        }
        // 1e-5 is 1·10⁻⁵.
        let exponent: String = behind
            .chars()
            .take_while(|c| c.is_ascii_digit() || *c == '-')
            .collect();
        if c == 'e' && after_digit && !exponent.is_empty() {
            let _ = write!(out, "\\cdot 10^{{{exponent}}}");
            rest = &behind[exponent.len()..];
            continue;
        }
        match sign(c) {
            Some(latex) => out.push_str(latex),
            None => out.push(c),
        }
        after_digit = c.is_ascii_digit();
        rest = behind;
    }
    out
}

/// Words, with the signs among them as formulas.
fn worded(words: &str) -> String {
    let of = |c: char| match sign(c) {
        Some(latex) => format!("${}$", latex.trim()),
        None => c.to_string(),
    };
    words.chars().map(of).collect()
}

/// Words at the start; a letter alone is a name.
fn phrase(text: &str) -> &str {
    let is_letter = |c: char| c.is_ascii_lowercase();
    if text.chars().take_while(|c| is_letter(*c)).count() < 2 {
        return "";
    }
    let end = text.find(|c: char| !(is_letter(c) || c == ' '));
    &text[..end.unwrap_or(text.len())]
}

/// What stands in parentheses at the start, and what behind them.
fn inside(text: &str) -> Option<(&str, &str)> {
    let mut depth = 0;
    for (at, c) in text.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return (c == ')').then(|| (&text[1..at], &text[at + 1..]));
        }
    }
    None
}

impl Rule {
    /// The formula for amsmath, in rows of `gathered`.
    #[must_use]
    pub fn latex(&self) -> String {
        let rows: Vec<String> = lines(self)
            .into_iter()
            .map(|line| match line {
                Line::Formula(formula) => translated(&formula),
                Line::Words(words) => format!("\\text{{{}}}", worded(&words)),
            })
            .collect();
        format!(
            "\\[\\begin{{gathered}}\n{}\n\\end{{gathered}}\\]",
            rows.join(" \\\\\n")
        )
    }
}
