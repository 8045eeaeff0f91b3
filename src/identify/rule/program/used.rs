//! Statements that nothing depends on are left out.

use super::Statement;

/// Whether an expression has that name in it.
pub(in crate::identify::rule) fn mentions(expression: &str, name: &str) -> bool {
    expression
        .split(|c: char| !c.is_alphanumeric() && c != '_')
        .any(|word| word == name)
}

/// All expressions of statements, conditions and ends of loops among them.
pub(in crate::identify::rule) fn expressions(statements: &[Statement]) -> Vec<&str> {
    let mut all = Vec::new();
    for statement in statements {
        match statement {
            Statement::Set(_, value)
            | Statement::Change(_, _, value)
            | Statement::Return(value) => {
                all.push(value.as_str());
            }
            Statement::If(condition, then, otherwise) => {
                all.push(condition);
                all.extend(expressions(then));
                all.extend(expressions(otherwise));
            }
            Statement::For(range, body) => {
                all.extend([range.from.as_str(), &range.to]);
                all.extend(expressions(body));
            }
            Statement::Break | Statement::Note(_) => {}
        }
    }
    all
}

/// The statements whose values are used.
pub(super) fn pruned(mut statements: Vec<Statement>) -> Vec<Statement> {
    loop {
        let used = used_names(&statements);
        let kept = without(statements.clone(), &used);
        if kept == statements {
            return kept;
        }
        statements = kept;
    }
}

/// Names that some statement needs for another name than itself.
fn used_names(statements: &[Statement]) -> Vec<String> {
    let mut used = Vec::new();
    collect(statements, &mut used);
    used
}

fn collect(statements: &[Statement], used: &mut Vec<String>) {
    for statement in statements {
        match statement {
            Statement::Set(name, value) | Statement::Change(name, _, value) => {
                add(value, name, used);
            }
            Statement::Return(value) => add(value, "", used),
            Statement::If(condition, then, otherwise) => {
                // A clamp needs the name that it clamps for nothing else.
                let own = match then.as_slice() {
                    [Statement::Set(name, _)] if otherwise.is_empty() => name,
                    _ => "",
                };
                add(condition, own, used);
                collect(then, used);
                collect(otherwise, used);
            }
            Statement::For(range, body) => {
                add(&range.from, "", used);
                add(&range.to, "", used);
                collect(body, used);
            }
            Statement::Break | Statement::Note(_) => {}
        }
    }
}

/// The words of an expression but one.
fn add(expression: &str, but: &str, used: &mut Vec<String>) {
    let words = expression.split(|c: char| !c.is_alphanumeric() && c != '_');
    used.extend(words.filter(|word| *word != but).map(String::from));
}

fn without(statements: Vec<Statement>, used: &[String]) -> Vec<Statement> {
    let is_used = |name: &str| used.iter().any(|word| word == name);
    let mut kept = Vec::new();
    for statement in statements {
        match statement {
            Statement::Set(name, _) | Statement::Change(name, _, _) if !is_used(name) => {}
            Statement::If(condition, then, otherwise) => {
                let (then, otherwise) = (without(then, used), without(otherwise, used));
                if !(then.is_empty() && otherwise.is_empty()) {
                    kept.push(Statement::If(condition, then, otherwise));
                }
            }
            Statement::For(range, body) => {
                kept.push(Statement::For(range, without(body, used)));
            }
            other => kept.push(other),
        }
    }
    kept
}
