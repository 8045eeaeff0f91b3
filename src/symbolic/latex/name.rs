//! Names of variables in LaTeX.

/// The letters that LaTeX has commands for. π is left out, it is a number.
const GREEK: [&str; 32] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa",
    "lambda", "mu", "nu", "xi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega",
    "Gamma", "Delta", "Theta", "Lambda", "Xi", "Sigma", "Upsilon", "Phi", "Psi", "Omega",
];

/// A name, with what follows an underscore, and digits at the end, as a subscript.
pub(super) fn symbol(name: &str) -> String {
    let word = |part: &str| !part.is_empty() && part.chars().all(|c| c.is_ascii_alphanumeric());
    let digits = name.len() - name.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    let (base, subscript) = match name.split_once('_') {
        Some(parts) => parts,
        None => name.split_at(name.len() - digits),
    };
    if !base.starts_with(|c: char| c.is_ascii_alphabetic()) || !word(base) {
        return upright(name);
    }
    if subscript.is_empty() && base.len() == name.len() {
        return letters(base);
    }
    let parts: Vec<&str> = subscript.split('_').collect();
    if !parts.iter().all(|part| word(part)) {
        return upright(name);
    }
    let parts: Vec<String> = parts.into_iter().map(letters).collect();
    format!("{}_{{{}}}", letters(base), parts.join(", "))
}

/// One letter, one number, a Greek letter, or a word.
fn letters(part: &str) -> String {
    if GREEK.contains(&part) {
        format!(r"\{part}")
    } else if part.chars().count() == 1 || part.chars().all(|c| c.is_ascii_digit()) {
        part.into()
    } else {
        upright(part)
    }
}

/// Any text upright, with what means something to TeX escaped.
fn upright(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '\\' => escaped += r"\backslash ",
            '^' => escaped += r"\text{\textasciicircum}",
            '~' => escaped += r"\text{\textasciitilde}",
            '{' | '}' | '$' | '&' | '#' | '%' | '_' => escaped.extend(['\\', c]),
            _ => escaped.push(c),
        }
    }
    format!(r"\mathrm{{{escaped}}}")
}
