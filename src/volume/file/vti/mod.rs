//! VTK's ImageData.

mod array;
mod document;

use super::geometry::{nine, text, three};
use super::write_samples;
use crate::binary::{ByteOrder, Memory, Trouble, product, refused};
use crate::volume::{Grid, Samples};
use document::{Document, Node};
use std::io::Write;
use std::path::Path;

pub(super) fn read(path: &Path, wanted: Option<&str>, memory: Memory) -> Result<Grid, Trouble> {
    let mut file = Document::read(path, memory)?;
    let text = file.text()?;
    let tree = document::parsed(&text)?;
    let root = tree.root_element();
    if !root.has_tag_name("VTKFile") || root.attribute("type") != Some("ImageData") {
        let kind = root.attribute("type").unwrap_or(root.tag_name().name());
        return Err(value("VTKFile", "type", kind, "ImageData"));
    }
    let image = child(root, "ImageData")?;
    let (first, dimensions) = extent(image, "WholeExtent")?;
    let mut pieces = image.children().filter(|node| node.has_tag_name("Piece"));
    let piece = match (pieces.next(), pieces.next()) {
        (Some(piece), None) if extent(piece, "Extent")? == (first, dimensions) => piece,
        _ => {
            return Err(refused(
                "pieces of the image",
                "one Piece, of the whole extent",
            ));
        }
    };
    let spacing = numbers(image, "Spacing", [1.0; 3], three)?;
    // Row by row, as VTK has it.
    let direction = numbers(image, "Direction", Grid::ALONG_AXES, nine)?;
    let origin = numbers(image, "Origin", [0.0; 3], three)?;
    super::geometry::place(origin, spacing, direction)?;
    let mut grid = Grid {
        dimensions,
        origin,
        spacing,
        direction,
        samples: Samples::F32(Vec::new()),
    };
    // VTK's origin is that of index 0, which the extent need not contain.
    if first != [0; 3] {
        #[allow(clippy::cast_precision_loss)]
        let first = first.map(|index| index as f64);
        grid.origin = grid.place(first);
    }
    let array = active(piece, wanted)?;
    grid.samples = array::samples(&mut file, root, array, product(&dimensions)?, memory)?;
    Ok(grid)
}

/// The array that is meant.
fn active<'a, 'i>(piece: Node<'a, 'i>, wanted: Option<&str>) -> Result<Node<'a, 'i>, Trouble> {
    let arrays = |of: &str| -> Vec<Node<'a, 'i>> {
        let data = piece.children().filter(|node| node.has_tag_name(of));
        data.flat_map(|data| data.children())
            .filter(|node| node.has_tag_name("DataArray"))
            .collect()
    };
    let points = arrays("PointData");
    if points.is_empty() && !arrays("CellData").is_empty() {
        return Err(refused(
            "data of cells",
            "data of points: a sample stands at a point",
        ));
    }
    let said = piece.children().find(|node| node.has_tag_name("PointData"));
    let said = said.and_then(|data| data.attribute("Scalars"));
    let name = |node: &Node<'_, '_>| node.attribute("Name").unwrap_or_default().to_owned();
    let found = match (wanted.or(said), points.as_slice()) {
        (None, [one]) => Some(*one),
        (None, _) => None,
        (Some(asked), _) => points.iter().find(|node| name(node) == asked).copied(),
    };
    let Some(array) = found else {
        let names: Vec<_> = points.iter().map(name).collect();
        return Err(refused(
            match wanted.or(said) {
                Some(asked) => format!("no array of points '{}'", asked.escape_debug()),
                None => format!("{} arrays of points, none of them active", points.len()),
            },
            if names.is_empty() {
                "a DataArray in PointData".to_owned()
            } else {
                format!("one of {}", names.join(", "))
            },
        ));
    };
    match array.attribute("NumberOfComponents") {
        None | Some("1") => Ok(array),
        Some(many) => Err(value(
            "DataArray",
            "NumberOfComponents",
            many,
            "1: one number a sample",
        )),
    }
}

/// A value that is not taken.
fn value(tag: &str, attribute: &str, said: &str, allowed: &str) -> Trouble {
    let shown: String = said.chars().take(80).collect();
    refused(
        format!("{tag}: {attribute}=\"{}\"", shown.escape_debug()),
        allowed,
    )
}

fn child<'a, 'i>(node: Node<'a, 'i>, tag: &str) -> Result<Node<'a, 'i>, Trouble> {
    let found = node.children().find(|node| node.has_tag_name(tag));
    found.ok_or_else(|| refused(format!("no {tag}"), format!("a {tag} in its place")))
}

fn numbers<T>(
    node: Node<'_, '_>,
    attribute: &str,
    missing: T,
    read: fn(&str) -> Option<T>,
) -> Result<T, Trouble> {
    let Some(said) = node.attribute(attribute) else {
        return Ok(missing);
    };
    read(said).ok_or_else(|| value("ImageData", attribute, said, "3 numbers, 9 of a Direction"))
}

/// The first index along each axis, and how many there are.
fn extent(node: Node<'_, '_>, attribute: &str) -> Result<([i64; 3], [usize; 3]), Trouble> {
    let said = node.attribute(attribute).unwrap_or_default();
    let ends: Option<Vec<i32>> = said
        .split_whitespace()
        .map(|word| word.parse().ok())
        .collect();
    let pairs = match ends.as_deref() {
        Some(&[a, b, c, d, e, f]) => [[a, b], [c, d], [e, f]],
        _ => {
            return Err(value(
                node.tag_name().name(),
                attribute,
                said,
                "six whole numbers",
            ));
        }
    };
    // An extent that ends before it begins has no samples.
    let sizes =
        pairs.map(|[from, to]| usize::try_from(i64::from(to) - i64::from(from) + 1).unwrap_or(0));
    Ok((pairs.map(|[from, _]| i64::from(from)), sizes))
}

fn byte_order(root: Node<'_, '_>) -> Result<ByteOrder, Trouble> {
    match root.attribute("byte_order") {
        None | Some("LittleEndian") => Ok(ByteOrder::Little),
        Some("BigEndian") => Ok(ByteOrder::Big),
        Some(other) => Err(value(
            "VTKFile",
            "byte_order",
            other,
            "LittleEndian or BigEndian",
        )),
    }
}

pub(super) fn write(file: &mut dyn Write, grid: &Grid) -> Result<(), Trouble> {
    let ends = grid
        .dimensions
        .map(|size| format!("0 {}", size - 1))
        .join(" ");
    let (kind, bytes) = match &grid.samples {
        Samples::F32(values) => ("Float32", 4 * values.len()),
        Samples::F64(values) => ("Float64", 8 * values.len()),
    };
    write!(
        file,
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  \
           <ImageData WholeExtent=\"{ends}\" Origin=\"{origin}\" Spacing=\"{spacing}\" Direction=\"{direction}\">\n    \
             <Piece Extent=\"{ends}\">\n      \
               <PointData Scalars=\"s\">\n        \
                 <DataArray type=\"{kind}\" Name=\"s\" format=\"appended\" offset=\"0\"/>\n      \
               </PointData>\n    \
             </Piece>\n  \
           </ImageData>\n  \
           <AppendedData encoding=\"raw\">\n_",
        origin = text(&grid.origin),
        spacing = text(&grid.spacing),
        direction = text(&grid.direction.concat()),
    )?;
    file.write_all(&(bytes as u64).to_le_bytes())?;
    write_samples(file, &grid.samples)?;
    file.write_all(b"\n  </AppendedData>\n</VTKFile>\n")?;
    Ok(())
}
