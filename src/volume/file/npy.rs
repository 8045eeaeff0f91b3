//! Volumes as `.npy`: an array of (z, y, x), and no word of where its samples stand.

use super::{raw, write_samples};
use crate::binary::{Memory, NpyHeader, NumberType, Trouble, open, product, refused};
use crate::volume::{Grid, Samples};
use std::io::Write;
use std::path::Path;

pub(super) fn read(path: &Path, memory: Memory) -> Result<Grid, Trouble> {
    let mut file = open(path)?;
    let header = NpyHeader::read(&mut file)?;
    let &[depth, height, width] = header.shape.as_slice() else {
        return Err(refused(
            format!("an array of the shape {:?}", header.shape),
            "three axes: (z, y, x)",
        ));
    };
    if header.fortran {
        return Err(refused(
            "an array in Fortran's order",
            "C's order: numpy.save(name, numpy.ascontiguousarray(volume))",
        ));
    }
    let count = product(&header.shape)?;
    let samples = raw(&mut file, header.kind, header.order, count, memory)?;
    Ok(Grid {
        dimensions: [width, height, depth],
        origin: [0.0; 3],
        spacing: [1.0; 3],
        direction: Grid::ALONG_AXES,
        samples,
    })
}

pub(super) fn write(file: &mut dyn Write, grid: &Grid) -> Result<(), Trouble> {
    let [width, height, depth] = grid.dimensions;
    let header = NpyHeader {
        kind: match grid.samples {
            Samples::F32(_) => NumberType::F32,
            Samples::F64(_) => NumberType::F64,
        },
        order: crate::binary::ByteOrder::Little,
        fortran: false,
        shape: vec![depth, height, width],
    };
    file.write_all(&header.bytes())?;
    write_samples(file, &grid.samples)
}
