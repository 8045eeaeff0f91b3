//! The order of accuracy of the marcher, as one of its tests: samples in the middle of segments give 2, at their front 1.

use as_a_test::{Sample, march};
use volver::kernel::{Closure, Kernel, Samples, Segments};

/// The marcher with the samples that `chosen` takes.
fn marcher(chosen: fn(&Segments) -> &Samples) -> impl Kernel {
    Closure::segments("march", move |segments, channel| {
        let samples = chosen(segments);
        let values = samples.extinction.iter().zip(&samples.emission[channel]);
        let values = values.zip(segments.lengths());
        march(values.map(|((&extinction, &emission), length)| Sample {
            emission,
            extinction,
            length,
        }))
    })
}

#[test]
fn samples_in_the_middle_have_order_two() {
    volver::assert_order!(marcher(|segments| &segments.middles), 2);
}

#[test]
#[should_panic(expected = "TooLow")]
fn samples_at_the_front_have_not() {
    // Of n + 1 ends the first n.
    volver::assert_order!(marcher(|segments| &segments.edges), 2);
}
