//! What a kernel computes, read off by probes.

mod forms;
