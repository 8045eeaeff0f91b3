//! What a kernel answers beside the first quantity: opacity and depths.

use super::words::{counts, order, theory};
use crate::document::{Block, Fact, Finding, Tone};
use crate::kernel::Quantity;
use crate::study::verify::{Line, Standing, Verification};

/// What lines are counted as.
pub(super) fn word(verification: &Verification) -> &'static str {
    if verification.quantities().len() > 1 {
        "channels and other answers"
    } else {
        "channels"
    }
}

/// A line a quantity; what is not shown to be right.
pub(super) fn others(verification: &Verification) -> Vec<Block> {
    let others: Vec<Quantity> = verification.quantities().into_iter().skip(1).collect();
    if others.is_empty() {
        return Vec::new();
    }
    let facts = others.iter().map(|quantity| fact(verification, *quantity));
    let mut blocks = vec![Block::Facts(facts.collect())];
    blocks.extend(not_shown(verification).map(Block::Finding));
    blocks
}

fn fact(verification: &Verification, quantity: Quantity) -> Fact {
    let counted = verification.counts_of(quantity);
    let of = verification.of(quantity).count();
    let mut words = counts(counted, of).replace("channels", "cases");
    if let Some(confirmed) = confirmed(verification, quantity) {
        words = format!("{words}; {confirmed}");
    }
    let fact = Fact::new(quantity.to_string(), words);
    let is_bad = counted.contradicted + counted.failed > 0;
    match (verification.is_accepted(quantity), is_bad) {
        (true, _) => Fact {
            value: format!("{} (accepted)", fact.value),
            ..fact
        },
        (false, true) => fact.toned(Tone::Bad),
        (false, false) if counted.confirmed > 0 => fact.toned(Tone::Good),
        (false, false) => fact,
    }
}

/// "order 2.000 ± 0.001 in sine-squared": the first that is confirmed with an order.
fn confirmed(verification: &Verification, quantity: Quantity) -> Option<String> {
    let has_order =
        |line: &&Line| line.standing == Standing::Confirmed && line.measured.order().is_some();
    let line = verification.of(quantity).find(has_order)?;
    let case = line.name.split(':').next().unwrap_or(&line.name);
    Some(format!("order {} in {case}", order(line)))
}

/// Quantities that nothing shows to be right.
pub(super) fn not_shown(verification: &Verification) -> impl Iterator<Item = Finding> {
    verification.not_shown().into_iter().map(|quantity| {
        let worst = verification
            .of(quantity)
            .find(|line| line.is_required && !line.is_shown());
        let such = worst.map_or_else(String::new, |line| {
            format!(
                ", such as {}: expected {}, measured {}",
                line.name,
                theory(line.expected),
                order(line)
            )
        });
        let words = format!("the {quantity} is not shown to have its order{such}");
        Finding::new("", words).toned(Tone::Bad)
    })
}
