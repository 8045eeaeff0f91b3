//! What volver's layers cost: `cargo bench -p volver-benches`.
