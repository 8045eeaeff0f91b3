//! The text of a `.vti`, apart from the bytes that may be appended to it, which are no XML.

use crate::binary::{Bytes, Memory, Trouble, open, refused};
use std::io::Read;
use std::path::Path;

pub(super) type Node<'a, 'i> = roxmltree::Node<'a, 'i>;

const APPENDED: &[u8] = b"<AppendedData";
/// How much is read at once to find where the text ends.
const CHUNK: usize = 1 << 20;

/// The file as it is read: its text, and where appended data begin.
pub(super) struct Document {
    /// The rest of the file.
    pub(super) file: Bytes,
    /// Up to `<AppendedData …>`, if there is one; else all.
    head: Vec<u8>,
    /// The first byte behind the `_` of appended data.
    pub(super) appended: Option<u64>,
}

impl Document {
    pub(super) fn read(path: &Path, memory: Memory) -> Result<Document, Trouble> {
        let mut file = open(path)?;
        let mut head: Vec<u8> = Vec::new();
        // From where on the tag may begin.
        let mut from = 0;
        loop {
            let before = head.len();
            (&mut file).take(CHUNK as u64).read_to_end(&mut head)?;
            memory.check(head.len(), 1)?;
            let ended = head.len() == before;
            let Some(at) = find(&head, from, APPENDED) else {
                if ended {
                    break;
                }
                // Its first letters may be the last ones here.
                from = (head.len() + 1).saturating_sub(APPENDED.len());
                continue;
            };
            from = at;
            let tag = find(&head, at, b">").map(|end| end + 1);
            let mark = tag.and_then(|end| find(&head, end, b"_"));
            let (Some(tag), Some(mark)) = (tag, mark) else {
                if ended {
                    return Err(refused(
                        "appended data without a beginning",
                        "'_' before them",
                    ));
                }
                continue;
            };
            head.truncate(tag);
            head.extend_from_slice(b"</AppendedData></VTKFile>");
            return Ok(Document {
                file,
                head,
                appended: Some(mark as u64 + 1),
            });
        }
        Ok(Document {
            file,
            head,
            appended: None,
        })
    }

    /// The text, without what is appended.
    pub(super) fn text(&mut self) -> Result<String, Trouble> {
        String::from_utf8(std::mem::take(&mut self.head))
            .map_err(|_| refused("a header that is no text in UTF-8", "XML in UTF-8"))
    }
}

/// The tree of a text.
pub(super) fn parsed(text: &str) -> Result<roxmltree::Document<'_>, Trouble> {
    roxmltree::Document::parse(text)
        .map_err(|error| refused(format!("no XML: {error}"), "a file of VTK in XML"))
}

fn find(bytes: &[u8], from: usize, wanted: &[u8]) -> Option<usize> {
    let at = bytes
        .get(from..)?
        .windows(wanted.len())
        .position(|window| window == wanted)?;
    Some(from + at)
}
