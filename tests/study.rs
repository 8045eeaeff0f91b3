//! `volver study` keeps its contract: outputs, resuming, threads, bad input.
