//! Which cases.

use super::asked::{Asked, Asking, split};
use crate::cli::{Failure, case};
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::path::Path;
use volver::case::{Case, SymbolicCase, catalogue};

/// One case to load.
struct Wanted {
    asked: Asked,
    /// What [`case::load`] takes.
    argument: String,
    /// A tag brings it: cases that others bring too are no mistake.
    by_tag: bool,
}

pub(in crate::cli) fn chosen(
    asking: &Asking,
    given: &[String],
) -> Result<Vec<(String, SymbolicCase)>, Failure> {
    let in_file = asking.file.cases.as_ref();
    let asked = asking.names("--cases", given, in_file, "cases", split)?;
    let asked = asked.ok_or_else(|| {
        Failure::Usage("no cases (allowed: --cases with names that 'volver cases' lists, or a study.toml with cases)".into())
    })?;
    let mut wanted = Vec::new();
    for asked in asked {
        match asked.text.strip_prefix('@') {
            Some(tag) => wanted.extend(tagged(tag, &asked)?),
            None => wanted.push(Wanted {
                argument: argument(&asked),
                asked,
                by_tag: false,
            }),
        }
    }
    let loaded: Vec<_> = wanted
        .into_par_iter()
        .map(|wanted| Ok((load(&wanted)?, wanted)))
        .collect::<Result<_, Failure>>()?;
    let mut cases: Vec<(String, SymbolicCase)> = Vec::new();
    let mut tagged: BTreeSet<String> = BTreeSet::new();
    for (of_one, wanted) in loaded {
        for case in of_one {
            let name = case.name().to_string();
            if wanted.by_tag {
                tagged.insert(name.clone());
            }
            if !cases.iter().any(|(known, _)| *known == name) {
                cases.push((name, case));
            } else if !wanted.by_tag && !tagged.contains(&name) {
                let why = format!("a case '{name}' a second time (allowed: each name once)");
                return Err(wanted.asked.refused(why));
            }
        }
    }
    Ok(cases)
}

/// Names stay names; a path in a file is relative to the file.
fn argument(asked: &Asked) -> String {
    let name = asked.text.split('/').next().unwrap_or_default();
    let is_path = asked.text.contains('/')
        || Path::new(&asked.text)
            .extension()
            .is_some_and(|e| e == "toml");
    match &asked.directory {
        Some(directory) if is_path && catalogue::text(name).is_none() => {
            directory.join(&asked.text).display().to_string()
        }
        _ => asked.text.clone(),
    }
}

fn load(wanted: &Wanted) -> Result<Vec<SymbolicCase>, Failure> {
    let loaded = case::medium(&wanted.argument).map_err(|failure| match failure {
        Failure::Usage(why) => wanted.asked.refused(why),
        other => other,
    })?;
    Ok(loaded.cases.into_iter().map(|case| case.case).collect())
}

/// All cases of the catalogue with that tag.
fn tagged(tag: &str, asked: &Asked) -> Result<Vec<Wanted>, Failure> {
    let mut tags = BTreeSet::new();
    let mut wanted = Vec::new();
    for name in catalogue::names() {
        let Some(Ok(description)) = catalogue::find(name) else {
            continue;
        };
        if description.tags.iter().any(|own| own == tag) {
            wanted.push(Wanted {
                asked: asked.clone(),
                argument: name.into(),
                by_tag: true,
            });
        }
        tags.extend(description.tags);
    }
    if wanted.is_empty() {
        let tags: Vec<&str> = tags.iter().map(String::as_str).collect();
        return Err(asked.refused(format!(
            "no case has the tag '{}' (allowed: {})",
            tag.escape_debug(),
            tags.join(", ")
        )));
    }
    Ok(wanted)
}
