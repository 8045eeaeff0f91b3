//! Kernels in shared libraries, by the C interface of `include/volver.h`.
