//! What a kernel computes: read off by probes; rules printed, run beside the kernel, and stated by methods.

mod code;
mod command;
mod composed;
mod compositions;
mod deviation;
mod edges;
mod examined;
mod exponential;
mod forms;
mod gradients;
mod kept;
mod kinds;
mod layers;
mod linear;
mod pairs;
mod random;
mod rounding;
mod seams;
mod seldom;
mod stated;
mod steps;
mod sums;
mod transmittance;
mod witness;
mod words;
