//! Which keys belong to which kind of medium.

use super::file::{KindName, MediumFile};
use super::{Kind, SceneProblem};

/// The keys that belong to a kind of medium, beside from, to and name.
pub(super) struct Keys {
    kind: &'static str,
    needed: &'static [&'static str],
    allowed: &'static [&'static str],
    shown: &'static str,
}

impl Keys {
    pub(super) fn of(name: KindName) -> Keys {
        let (needed, allowed, shown): (&[_], &[_], _) = match name {
            KindName::Vacuum => (&[], &[], "no more than from, to and name"),
            KindName::Constant | KindName::Linear => (
                &["extinction"],
                &["extinction", "emission"],
                "extinction and emission",
            ),
            KindName::Expression => (
                &["extinction"],
                &["extinction", "emission", "field"],
                "extinction, emission and, where these are of s, field",
            ),
            KindName::Sampled => (
                &["samples"],
                &[
                    "samples",
                    "spacing",
                    "interpolation",
                    "table",
                    "table-interpolation",
                    "extinction",
                    "emission",
                ],
                "samples and either a table or extinction and emission of s",
            ),
        };
        Keys {
            kind: kind(name).name(),
            needed,
            allowed,
            shown,
        }
    }

    pub(super) fn check(&self, file: &MediumFile) -> Result<(), SceneProblem> {
        let given = [
            ("extinction", file.extinction.is_some()),
            ("emission", file.emission.is_some()),
            ("field", file.field.is_some()),
            ("samples", file.samples.is_some()),
            ("spacing", file.spacing.is_some()),
            ("interpolation", file.interpolation.is_some()),
            ("table", file.table.is_some()),
            ("table-interpolation", file.table_interpolation.is_some()),
        ];
        let (kind, keys) = (self.kind, self.shown);
        for (key, is_given) in given {
            if is_given && !self.allowed.contains(&key) {
                return Err(SceneProblem::Superfluous { key, kind, keys });
            }
            if !is_given && self.needed.contains(&key) {
                return Err(SceneProblem::Missing { key, kind, keys });
            }
        }
        if file.kind != KindName::Sampled {
            return Ok(());
        }
        let missing = |key| Err(SceneProblem::Missing { key, kind, keys });
        let superfluous = |key| Err(SceneProblem::Superfluous { key, kind, keys });
        match (&file.table, &file.extinction) {
            (None, None) => missing("table"),
            (Some(_), Some(_)) => superfluous("extinction"),
            (Some(_), None) if file.emission.is_some() => superfluous("emission"),
            (None, Some(_)) if file.table_interpolation.is_some() => {
                superfluous("table-interpolation")
            }
            _ => Ok(()),
        }
    }
}

/// The kind that a file names.
pub(super) fn kind(name: KindName) -> Kind {
    match name {
        KindName::Vacuum => Kind::Vacuum,
        KindName::Constant => Kind::Constant,
        KindName::Linear => Kind::Linear,
        KindName::Expression => Kind::Expression,
        KindName::Sampled => Kind::Sampled,
    }
}
