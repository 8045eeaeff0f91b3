//! Studies in shards: cut, killed, doubled, corrupted, joined.

mod command;
mod costs;
mod cut;
mod scenarios;
mod verification;
