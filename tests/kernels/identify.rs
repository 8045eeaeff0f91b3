//! Rules: printed, run beside the kernel, and stated by methods.

mod code;
mod random;
mod stated;
mod words;
