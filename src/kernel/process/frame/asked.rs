//! From tasks to a frame.

use super::message::{AskedBlock, BlockType, FrameTag, WireBlock, WireFrame};
use super::{Frame, NUMBER, text};
use crate::kernel::{Samples, Segments, Task};
use crate::real::{Format, Native};
use std::collections::HashMap;
use std::io;

/// So many bytes a frame has at most, but where one ray has more.
const MOST: usize = 1 << 28;

/// How many of the tasks, from the first on, go into one frame: up to `most`, of the same channels.
pub(in crate::kernel::process) fn fits(tasks: &[&Task<'_>], most: usize) -> usize {
    let Some(first) = tasks.first() else {
        return 0;
    };
    let channels = first.subject.channels();
    let mut bytes = 0_usize;
    let fits = tasks.iter().take(most.max(1)).take_while(|task| {
        // Two rows of places, each with λ, τ and C.
        let places = task.cut().map_or(0, |segments| 2 * segments.count() + 1);
        bytes = bytes.saturating_add(places * (2 + channels.len()) * NUMBER);
        bytes <= MOST && task.subject.channels() == channels
    });
    fits.count().max(1)
}

/// The frame of that id for tasks, all of the same channels; with backgrounds, or without. It is written as text too,
/// where there is a log.
pub(in crate::kernel::process) fn write(
    id: u64,
    tasks: &[&Task<'_>],
    background: bool,
    logged: bool,
) -> io::Result<Frame> {
    let mut rays = Vec::with_capacity(tasks.len());
    let channels = tasks
        .first()
        .map_or(&[][..], |task| task.subject.channels());
    for task in tasks {
        let cut = task.cut().filter(|cut| is_whole(cut, channels.len()));
        rays.push((
            *task,
            cut.ok_or_else(|| other("a ray that is not cut into segments"))?,
        ));
    }
    let places: usize = rays.iter().map(|(_, cut)| 2 * cut.count() + 1).sum();
    let others = 5 + if background { channels.len() } else { 0 };
    let numbers = places * (2 + channels.len()) + others * rays.len() + 1;
    let mut blocks = Blocks {
        all: Vec::new(),
        bytes: Vec::with_capacity(numbers * NUMBER),
    };
    let cases = head(&mut blocks, &rays)?;
    if background {
        blocks.begin(
            AskedBlock::Background,
            BlockType::Real,
            &[rays.len(), channels.len()],
        );
        for (task, _) in &rays {
            // Black where nothing is behind the ray.
            let behind = task.subject.background().iter().copied();
            let all = behind.chain(std::iter::repeat(0.0)).take(channels.len());
            all.for_each(|value| blocks.push(value.to_le_bytes()));
        }
    }
    let edges = |(_, cut): &(&Task<'_>, &Segments)| cut.edges.lambda.len();
    let ends = rays.iter().map(edges).sum();
    let segments: usize = rays.iter().map(|(_, cut)| cut.count()).sum();
    let cuts = || rays.iter().map(|(_, cut)| *cut);
    blocks.samples(
        [
            AskedBlock::EdgesLambda,
            AskedBlock::EdgesExtinction,
            AskedBlock::EdgesEmission,
        ],
        [ends, channels.len()],
        || cuts().map(|cut| &cut.edges),
    );
    blocks.samples(
        [
            AskedBlock::MiddlesLambda,
            AskedBlock::MiddlesExtinction,
            AskedBlock::MiddlesEmission,
        ],
        [segments, channels.len()],
        || cuts().map(|cut| &cut.middles),
    );
    let Blocks { all, bytes } = blocks;
    let frame = WireFrame {
        tag: FrameTag::Frame,
        id,
        rays: rays.len() as u64,
        channels,
        cases,
        bytes: bytes.len() as u64,
        blocks: all,
    };
    let mut line = serde_json::to_vec(&frame)?;
    line.push(b'\n');
    let text = if logged {
        text(&frame.blocks, &bytes)?
    } else {
        Vec::new()
    };
    Ok(Frame { line, bytes, text })
}

/// One number a ray, and where its segments begin; returns the names of cases.
fn head<'a>(blocks: &mut Blocks, rays: &[(&Task<'a>, &Segments)]) -> io::Result<Vec<&'a str>> {
    let count = rays.len();
    blocks.begin(AskedBlock::Offsets, BlockType::Integer, &[count + 1]);
    let mut offset = 0_i64;
    blocks.push(offset.to_le_bytes());
    for (_, cut) in rays {
        offset += i64::try_from(cut.count()).map_err(io::Error::other)?;
        blocks.push(offset.to_le_bytes());
    }
    blocks.begin(AskedBlock::Case, BlockType::Integer, &[count]);
    let mut known: HashMap<&str, i64> = HashMap::new();
    let mut cases = Vec::new();
    for (task, _) in rays {
        let name = task.subject.name();
        let next = i64::try_from(cases.len()).map_err(io::Error::other)?;
        let index = *known.entry(name).or_insert_with(|| {
            cases.push(name);
            next
        });
        blocks.push(index.to_le_bytes());
    }
    blocks.begin(AskedBlock::Seed, BlockType::Natural, &[count]);
    for (task, _) in rays {
        blocks.push(task.seed.to_le_bytes());
    }
    blocks.begin(AskedBlock::Length, BlockType::Real, &[count]);
    let format = Native::<f64>::new();
    for (task, _) in rays {
        blocks.push(format.ratio(task.subject.length()).to_le_bytes());
    }
    blocks.begin(AskedBlock::Step, BlockType::Real, &[count]);
    for (task, _) in rays {
        blocks.push(task.step.to_le_bytes());
    }
    Ok(cases)
}

/// Whether every array has as many numbers as it must: one too few would move all that stand behind it.
fn is_whole(cut: &Segments, channels: usize) -> bool {
    let fits = |samples: &Samples, count: usize| {
        let rows = samples
            .emission
            .iter()
            .chain([&samples.lambda, &samples.extinction]);
        samples.emission.len() == channels && rows.into_iter().all(|row| row.len() == count)
    };
    fits(&cut.middles, cut.count()) && fits(&cut.edges, cut.count() + 1)
}

fn other(problem: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, problem)
}

/// Blocks as they are written.
struct Blocks {
    all: Vec<WireBlock<AskedBlock>>,
    bytes: Vec<u8>,
}

impl Blocks {
    fn begin(&mut self, name: AskedBlock, kind: BlockType, shape: &[usize]) {
        let shape = shape.iter().map(|size| *size as u64).collect();
        self.all.push(WireBlock { name, kind, shape });
    }

    fn push(&mut self, number: [u8; NUMBER]) {
        self.bytes.extend_from_slice(&number);
    }

    fn row(&mut self, values: &[f64]) {
        for value in values {
            self.push(value.to_le_bytes());
        }
    }

    /// λ and τ of all rays, one behind the other, and C in the same way, channel by channel.
    fn samples<'s, I: Iterator<Item = &'s Samples>>(
        &mut self,
        [lambda, extinction, emission]: [AskedBlock; 3],
        [places, channels]: [usize; 2],
        rays: impl Fn() -> I,
    ) {
        self.begin(lambda, BlockType::Real, &[places]);
        rays().for_each(|samples| self.row(&samples.lambda));
        self.begin(extinction, BlockType::Real, &[places]);
        rays().for_each(|samples| self.row(&samples.extinction));
        self.begin(emission, BlockType::Real, &[channels, places]);
        for channel in 0..channels {
            let rows = rays().filter_map(|samples| samples.emission.get(channel));
            rows.for_each(|row| self.row(row));
        }
    }
}
