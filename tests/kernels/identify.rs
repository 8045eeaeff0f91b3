//! What a kernel computes: read off by probes; rules printed, run beside the kernel, and stated by methods.

mod code;
mod forms;
mod random;
mod stated;
mod words;
