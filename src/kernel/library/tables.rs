//! A volume as `include/volver.h` has it.

use crate::kernel::Volume;
use std::ptr;

/// `volver_volume`.
#[repr(C)]
pub(super) struct RawVolume {
    points: u64,
    field: *const f64,
    entries: u64,
    first: f64,
    last: f64,
    extinction: *const f64,
    emission: *const *const f64,
}

/// A volume, and pointers to the columns of its emission.
pub(super) struct Tables<'a> {
    volume: Option<&'a Volume>,
    emission: Vec<*const f64>,
}

impl<'a> Tables<'a> {
    pub(super) fn new(volume: Option<&'a Volume>) -> Self {
        let columns = volume.map_or(&[][..], |volume| &volume.table.emission);
        let emission = columns.iter().map(Vec::as_ptr).collect();
        Tables { volume, emission }
    }

    /// Valid as long as this and its volume.
    pub(super) fn raw(&self) -> RawVolume {
        let Some(Volume { field, table }) = self.volume else {
            return RawVolume {
                points: 0,
                field: ptr::null(),
                entries: 0,
                first: 0.0,
                last: 0.0,
                extinction: ptr::null(),
                emission: ptr::null(),
            };
        };
        RawVolume {
            points: field.len() as u64,
            field: field.as_ptr(),
            entries: table.extinction.len() as u64,
            first: table.first,
            last: table.last,
            extinction: table.extinction.as_ptr(),
            emission: self.emission.as_ptr(),
        }
    }
}
