//! What a ray is known by: all that a kernel is given of it.

use crate::kernel::{Data, Samples, Task};
use crate::study::shards::Key;
use std::fmt::Write;

/// Places of a ray that is a function, at which it is looked at.
const PLACES: u32 = 32;

/// Of one ray.
pub(super) fn of(task: &Task<'_>) -> Key {
    let subject = task.subject;
    let mut text = format!(
        "{}\n{}\n{}\n{:x}\n{}\n{}\n",
        subject.name(),
        subject.channels().join("\n"),
        subject.length(),
        task.step.to_bits(),
        task.segments,
        task.seed
    );
    let mut add = |numbers: &[f64]| {
        for number in numbers {
            // Writing to a String does not fail.
            let _ = write!(text, "{:x},", number.to_bits());
        }
        text.push('\n');
    };
    add(subject.background());
    let mut samples = |samples: &Samples| {
        add(&samples.lambda);
        add(&samples.extinction);
        samples.emission.iter().for_each(|row| add(row));
    };
    match task.data {
        Data::Segments(segments) => {
            samples(&segments.edges);
            samples(&segments.middles);
        }
        Data::Volume(volume) => {
            add(&volume.field);
            add(&[volume.table.first, volume.table.last]);
            add(&volume.table.extinction);
            volume.table.emission.iter().for_each(|row| add(row));
        }
        Data::Formula(formula) => text.push_str(&formula.code),
        Data::Function => {
            let length = subject.length().to_f64();
            let mut emission = vec![0.0; subject.channels().len()];
            for place in 0..=PLACES {
                let lambda = length * f64::from(place) / f64::from(PLACES);
                let extinction = subject.at(lambda, &mut emission);
                add(&[extinction]);
                add(&emission);
            }
        }
    }
    Key::of([text.as_str()])
}

/// Of rays in one request.
pub(super) fn of_all(tasks: &[Task<'_>]) -> Key {
    let keys: Vec<String> = tasks.iter().map(|task| of(task).to_string()).collect();
    Key::of(keys.iter().map(String::as_str))
}
