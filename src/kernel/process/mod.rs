//! Kernels in processes of their own, by JSON lines over pipes.
