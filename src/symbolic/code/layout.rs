//! What differs from language to language.

use super::callee::Callee;
use crate::symbolic::Relation;

/// A comparison that decides between two values.
pub(super) struct Choice<'t> {
    pub(super) left: &'t str,
    pub(super) relation: Relation,
    pub(super) right: &'t str,
    pub(super) then: &'t str,
    pub(super) otherwise: &'t str,
}

impl Choice<'_> {
    /// The condition for `then`, and the one for `otherwise`; neither holds where one side is NaN.
    pub(super) fn conditions(&self) -> (String, String) {
        let opposite = match self.relation {
            Relation::Less => Relation::GreaterEqual,
            Relation::LessEqual => Relation::Greater,
            Relation::Greater => Relation::LessEqual,
            Relation::GreaterEqual => Relation::Less,
        };
        let condition =
            |relation: Relation| format!("{} {} {}", self.left, relation.as_str(), self.right);
        (condition(self.relation), condition(opposite))
    }
}

/// The inside of a function.
pub(super) struct Body {
    pub(super) parameters: Vec<String>,
    /// Those of the parameters that nothing depends on.
    pub(super) unused: Vec<String>,
    /// Names and what they stand for, in order.
    pub(super) steps: Vec<(String, String)>,
    pub(super) value: String,
}

/// How a language is written.
pub(super) trait Layout {
    /// Whether no variable or function may have that name.
    fn reserved(&self, name: &str) -> bool;
    /// π.
    fn pi(&self) -> &'static str;
    /// ∞.
    fn infinity(&self) -> &'static str;
    /// NaN.
    fn nan(&self) -> &'static str;
    /// What is called.
    fn callee(&self, callee: Callee) -> &'static str;
    /// The function to define first where what is called is none of the language's own.
    fn helper(&self, callee: Callee) -> Option<&'static str>;
    /// Whether dividing by 0 is an error.
    fn division_raises(&self) -> bool {
        false
    }
    /// A value that depends on a comparison.
    fn choice(&self, choice: &Choice<'_>) -> String;
    /// What begins a line of comment.
    fn comment(&self) -> &'static str;
    /// What stands before `code`.
    fn prologue(&self, callees: &[Callee], code: &str) -> String;
    /// What stands between functions.
    fn gap(&self) -> &'static str;
    /// A named number.
    fn constant(&self, name: &str, value: &str) -> String;
    /// A function.
    fn function(&self, name: &str, doc: &[String], body: &Body) -> String;
}

/// The lines of a comment, without what would end it or what compilers refuse.
pub(super) fn lines(text: &str) -> Vec<String> {
    let harmless = |c: char| match c {
        // A carriage return ends a comment in Python, and rustc refuses what reverses text.
        '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => ' ',
        _ if c.is_control() => ' ',
        _ => c,
    };
    text.lines()
        .map(|line| {
            let mut line: String = line.chars().map(harmless).collect();
            line.truncate(line.trim_end().len());
            // In C these continue the comment on the next line.
            if line.ends_with('\\') || line.ends_with("??/") {
                line += " .";
            }
            line
        })
        .collect()
}

/// A comment of lines that begin with `mark`.
pub(super) fn comment(mark: &str, lines: &[String]) -> String {
    let mut text = String::new();
    for line in lines {
        text.extend([format!("{mark} {line}").trim_end(), "\n"]);
    }
    text
}
