//! One token of a formula, replaced by another.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use volver::symbolic::{Expr, Function};

pub(super) struct Random(Pcg64);

impl Random {
    pub(super) fn new(seed: u64) -> Random {
        Random(Pcg64::seed_from_u64(seed))
    }

    pub(super) fn of<'t, T>(&mut self, all: &'t [T]) -> &'t T {
        let place = self.0.next_u64() % all.len() as u64;
        &all[usize::try_from(place).unwrap()]
    }
}

/// A formula that differs in one token, where the token drawn has a mutation that can be read.
pub(super) fn mutant(text: &str, random: &mut Random) -> Option<(String, Expr)> {
    let tokens = tokens(text);
    let places: Vec<usize> = (0..tokens.len()).collect();
    let place = *random.of(&places);
    let others = others(&tokens[place]);
    if others.is_empty() {
        return None;
    }
    let mut mutated: Vec<String> = tokens;
    mutated[place].clone_from(random.of(&others));
    let text = mutated.join(" ");
    let expr: Expr = text.parse().ok()?;
    Some((text, expr))
}

/// What may stand in the place of a token.
fn others(token: &str) -> Vec<String> {
    let but = |all: &[&str]| -> Vec<String> {
        let others = all.iter().filter(|other| **other != token);
        others.map(ToString::to_string).collect()
    };
    if let Ok(number) = token.parse::<i64>() {
        return vec![
            format!("{}", number + 1),
            format!("({})", number - 1),
            format!("{}", 2 * number),
            format!("(-{number})"),
        ];
    }
    if Function::from_name(token).is_some() || token == "sqrt" {
        let names = Function::ALL.map(Function::name);
        return but(&[&names[..], &["sqrt"]].concat());
    }
    match token {
        "+" | "-" | "*" | "/" | "^" => but(&["+", "-", "*", "/", "^"]),
        "<" | "<=" | ">" | ">=" => but(&["<", "<=", ">", ">="]),
        "min" | "max" => but(&["min", "max"]),
        "lambda" | "pi" => but(&["lambda", "pi", "1", "2"]),
        _ => Vec::new(),
    }
}

/// The tokens of a text that the program printed.
fn tokens(text: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let of_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    for c in text.chars() {
        match tokens.last_mut() {
            Some(last)
                if (of_word(c) && last.chars().all(of_word))
                    || (c == '=' && (last == "<" || last == ">")) =>
            {
                last.push(c);
            }
            // A space ends a word.
            _ if c == ' ' => tokens.push(String::new()),
            _ => tokens.push(c.to_string()),
        }
    }
    tokens.retain(|token| !token.is_empty());
    tokens
}
