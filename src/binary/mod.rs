//! Numbers in the bytes of files, and why there are none: types, byte orders, sizes that are looked at before memory is taken.

mod base64;
mod error;
mod memory;
mod npy;
mod number;
mod source;

pub use error::{FileError, Trouble};

pub(crate) use base64::Base64;
pub(crate) use error::refused;
pub(crate) use memory::{Memory, product};
pub(crate) use npy::NpyHeader;
pub(crate) use number::{ByteOrder, NumberType, ascii};
pub(crate) use source::{Bytes, open};
