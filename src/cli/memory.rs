//! Whose memory the program's numbers are in.
//!
//! Nearly every operation in MPFR takes a block of a few words and gives one back, which with the C library's allocator is a fifth
//! of a study's time.

use gmp_mpfr_sys::gmp;
use libmimalloc_sys::{mi_free, mi_malloc, mi_realloc};
use mimalloc::MiMalloc;
use std::alloc::{Layout, handle_alloc_error};
use std::ffi::c_void;

#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

/// Lets GMP and MPFR take their memory where Rust does. To be called before there is a number of theirs, which would be given
/// back to an allocator that it is not from.
pub(crate) fn share() {
    // SAFETY: the functions keep GMP's contract: blocks are theirs alone, aligned for any type, moved whole by `reallocate`, and
    // never null.
    #[allow(unsafe_code)]
    unsafe {
        gmp::set_memory_functions(Some(allocate), Some(reallocate), Some(free));
    }
}

extern "C" fn allocate(size: usize) -> *mut c_void {
    // SAFETY: any size may be asked for.
    #[allow(unsafe_code)]
    let block = unsafe { mi_malloc(size) };
    there(block, size)
}

extern "C" fn reallocate(block: *mut c_void, _: usize, size: usize) -> *mut c_void {
    // SAFETY: GMP gives blocks that came from these functions.
    #[allow(unsafe_code)]
    let block = unsafe { mi_realloc(block, size) };
    there(block, size)
}

extern "C" fn free(block: *mut c_void, _: usize) {
    // SAFETY: as in `reallocate`.
    #[allow(unsafe_code)]
    unsafe {
        mi_free(block);
    }
}

/// The block; the program ends where there is none, as Rust's own allocations do: GMP takes no answer else.
fn there(block: *mut c_void, size: usize) -> *mut c_void {
    if block.is_null() {
        let layout = Layout::from_size_align(size, align_of::<u64>());
        handle_alloc_error(layout.unwrap_or(Layout::new::<u64>()));
    }
    block
}
