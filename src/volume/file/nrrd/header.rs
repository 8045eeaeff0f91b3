//! The header of NRRD: `field: value`, up to an empty line.

use crate::binary::{Bytes, NumberType, Trouble, refused};
use std::collections::HashMap;

/// The longest line of a header.
const LINE: usize = 1 << 16;
/// The most lines of one.
const LINES: usize = 1 << 12;

/// Fields that say something of the samples or their places, or nothing that matters here.
const KNOWN: [&str; 30] = [
    "type",
    "dimension",
    "sizes",
    "encoding",
    "endian",
    "space",
    "space dimension",
    "space directions",
    "space origin",
    "space units",
    "spacings",
    "axis mins",
    "axis maxs",
    "centers",
    "kinds",
    "labels",
    "units",
    "data file",
    "line skip",
    "byte skip",
    "content",
    "min",
    "max",
    "old min",
    "old max",
    "number",
    "sample units",
    "thicknesses",
    "measurement frame",
    "block size",
];
/// Kinds of an axis in space.
const DOMAIN: [&str; 4] = ["domain", "space", "none", "???"];

/// Fields by name.
pub(super) struct Header(HashMap<String, String>);

/// A value that is not taken.
pub(super) fn value(field: &str, said: &str, allowed: &str) -> Trouble {
    let shown: String = said.chars().take(80).collect();
    refused(format!("{field}: {}", shown.escape_debug()), allowed)
}

impl Header {
    pub(super) fn read(file: &mut Bytes) -> Result<Header, Trouble> {
        let magic = file.line(LINE)?.unwrap_or_default();
        if !matches!(
            magic.strip_prefix("NRRD000"),
            Some("1" | "2" | "3" | "4" | "5")
        ) {
            return Err(value("first line", &magic, "NRRD0001 to NRRD0005"));
        }
        let mut fields = HashMap::new();
        for _ in 0..LINES {
            let line = match file.line(LINE)? {
                None => return Ok(Header(fields)),
                Some(line) if line.is_empty() => return Ok(Header(fields)),
                Some(line) => line,
            };
            if line.starts_with('#') {
                continue;
            }
            // `key:=value` is of users, and says nothing of the samples.
            let pair = line
                .split_once(':')
                .filter(|(_, said)| !said.starts_with('='));
            let Some((field, said)) = pair else {
                if line.contains(":=") {
                    continue;
                }
                return Err(value("header", &line, "lines of 'field: value'"));
            };
            let field = canonical(field);
            if !KNOWN.contains(&field.as_str()) {
                return Err(value("header", &line, "fields that NRRD defines"));
            }
            let said = said.trim().to_owned();
            if fields.insert(field.clone(), said.clone()).is_some() {
                return Err(value(&field, &said, "each field once"));
            }
        }
        Err(refused(
            "no end of its header",
            "an empty line behind the fields",
        ))
    }

    pub(super) fn get(&self, field: &str) -> Option<&str> {
        self.0.get(field).map(String::as_str)
    }

    /// A number of lines or bytes.
    pub(super) fn count(&self, field: &str) -> Result<Option<u64>, Trouble> {
        let said = self.get(field);
        said.map(|said| said.parse().map_err(|_| value(field, said, "0 or more")))
            .transpose()
    }

    pub(super) fn dimensions(&self) -> Result<[usize; 3], Trouble> {
        if let Some(kinds) = self.get("kinds") {
            let is_domain = |kind: &str| DOMAIN.contains(&kind.to_ascii_lowercase().as_str());
            if let Some(other) = kinds.split_whitespace().find(|kind| !is_domain(kind)) {
                return Err(value(
                    "kinds",
                    other,
                    "domain or space: one number a sample",
                ));
            }
        }
        let many = self.get("dimension").unwrap_or_default();
        if many != "3" {
            return Err(value("dimension", many, "3"));
        }
        let said = self.get("sizes").unwrap_or_default();
        let sizes: Option<Vec<usize>> = said
            .split_whitespace()
            .map(|word| word.parse().ok())
            .collect();
        sizes
            .and_then(|sizes| sizes.try_into().ok())
            .ok_or_else(|| value("sizes", said, "three whole numbers"))
    }

    pub(super) fn number_type(&self) -> Result<NumberType, Trouble> {
        let said = self.get("type").unwrap_or_default();
        super::number_type(&said.to_ascii_lowercase()).ok_or_else(|| {
            value(
                "type",
                said,
                "uint8, int8, uint16, int16, uint32, int32, uint64, int64, float or double",
            )
        })
    }
}

/// The one of a field's names that is used here.
fn canonical(field: &str) -> String {
    let field = field.to_ascii_lowercase();
    let one = match field.as_str() {
        "datafile" => "data file",
        "centerings" => "centers",
        "axismins" => "axis mins",
        "axismaxs" => "axis maxs",
        "byteskip" => "byte skip",
        "lineskip" => "line skip",
        "oldmin" => "old min",
        "oldmax" => "old max",
        "sampleunits" => "sample units",
        "blocksize" => "block size",
        _ => return field,
    };
    one.to_owned()
}
