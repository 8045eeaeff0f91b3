//! What the reader of TOML says, as this program says things.

/// The reader's message in one line, with what is allowed: what it names itself, or `keys`.
#[cfg(feature = "studies")]
pub(crate) fn said(message: &str, keys: &str) -> String {
    let message: Vec<&str> = message.split_whitespace().collect();
    let message = message.join(" ").replace('`', "'");
    match message.split_once(", expected ") {
        Some((what, allowed)) => {
            let allowed = allowed.strip_prefix("one of ").unwrap_or(allowed);
            format!("{what} (allowed: {allowed})")
        }
        None if message.contains("(allowed: ") => message,
        None => format!("{message} (allowed: {keys})"),
    }
}
