//! NaN and infinities as Python's `json` module writes them, though JSON knows no such numbers.

/// What is written, and the text that is meant.
const BARE: [(&[u8], &[u8]); 3] = [
    (b"NaN", b"\"nan\""),
    (b"-Infinity", b"\"-inf\""),
    (b"Infinity", b"\"inf\""),
];

/// The line with them as text; nothing if it has none.
#[must_use]
pub fn quoted(line: &[u8]) -> Option<Vec<u8>> {
    let mut out = Vec::with_capacity(line.len());
    let (mut rest, mut in_text, mut found) = (line, false, false);
    while let Some((byte, behind)) = rest.split_first() {
        let bare = BARE.iter().find(|(bare, _)| rest.starts_with(bare));
        match (byte, bare) {
            (_, Some((bare, text))) if !in_text => {
                out.extend_from_slice(text);
                rest = rest.get(bare.len()..).unwrap_or_default();
                found = true;
                continue;
            }
            (b'"', _) => in_text = !in_text,
            (b'\\', _) if in_text => {
                // What it escapes is no end of the text.
                out.push(*byte);
                let Some((escaped, behind)) = behind.split_first() else {
                    break;
                };
                out.push(*escaped);
                rest = behind;
                continue;
            }
            _ => {}
        }
        out.push(*byte);
        rest = behind;
    }
    found.then_some(out)
}
