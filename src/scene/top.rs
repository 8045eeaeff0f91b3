//! What a scene's file says before its media.

use super::{SceneError, SceneFile, SceneProblem};

const MAX_CHANNELS: usize = 8;

/// The line, counted from 1, of a byte of the text.
pub(super) fn line(text: &str, at: usize) -> usize {
    text.get(..at).unwrap_or_default().matches('\n').count() + 1
}

/// The names of the channels: one, empty, where the file has none.
pub(super) fn channels(text: &str, file: &SceneFile) -> Result<Vec<String>, SceneError> {
    let Some(names) = &file.channels else {
        return Ok(vec![String::new()]);
    };
    let refused = |reason: String| SceneError {
        line: line(text, names.span().start),
        problem: SceneProblem::ChannelNames { reason },
    };
    let list = names.get_ref();
    if !(1..=MAX_CHANNELS).contains(&list.len()) {
        return Err(refused(format!("{} names", list.len())));
    }
    for (i, name) in list.iter().enumerate() {
        let is_good = !name.is_empty()
            && name.len() <= 32
            && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '-');
        if !is_good || ["s", "extinction"].contains(&name.as_str()) {
            return Err(refused(format!("'{}'", name.escape_debug())));
        }
        if list[..i].contains(name) {
            return Err(refused(format!("'{name}' a second time")));
        }
    }
    Ok(list.clone())
}

/// Why light has to be lost and gained where it is.
pub(super) const SCATTERING: &str = "light that changes its direction, from other rays into this one, is not in the integral of emission and absorption";

/// Whether the scene may emit.
pub(super) fn features(text: &str, file: &SceneFile) -> Result<bool, SceneError> {
    let Some(declared) = &file.features else {
        return Ok(true);
    };
    let refused = |feature: &str, reason| SceneError {
        line: line(text, declared.span().start),
        problem: SceneProblem::Feature {
            feature: feature.escape_debug().to_string(),
            reason,
        },
    };
    let list = declared.get_ref();
    for feature in list {
        let reason = match feature.as_str() {
            "emission" | "absorption" => continue,
            "scattering"
            | "multiple-scattering"
            | "single-scattering"
            | "phase-function"
            | "in-scattering"
            | "out-scattering" => SCATTERING,
            "shadows" | "illumination" | "lights" => {
                "light from elsewhere is known to it only as what a medium emits"
            }
            "refraction" => "rays are straight in it",
            "surfaces" | "reflection" => "it has media, and a background",
            "time" | "motion-blur" => "it knows one moment",
            _ => "it has emission and absorption alone",
        };
        return Err(refused(feature, reason));
    }
    let has = |name: &str| list.iter().any(|feature| feature == name);
    if !has("absorption") {
        return Err(refused(
            "emission without absorption",
            "light comes of C times tau, from what absorbs",
        ));
    }
    Ok(has("emission"))
}
