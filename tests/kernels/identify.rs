//! What a kernel computes, read off by probes.

mod command;
mod deviation;
mod witness;
