//! From a frame to renderings.

use super::message::{AnswerBlock, BlockType, WireBlock, WireFrameAnswer};
use super::{NUMBER, described, text};
use crate::kernel::process::answer::used_step;
use crate::kernel::process::greeting::Greeting;
use crate::kernel::process::trouble::{Trouble, said};
use crate::kernel::{KernelError, Quantity, Rendering, Task};
use rug::Float;
use serde_json::error::Category;

/// One result a task.
type Results = Vec<Result<Rendering, KernelError>>;

/// Blocks that a ray may have a single number in.
const OF_A_RAY: usize = 5;
/// Blocks that it may have one a channel in.
const OF_A_CHANNEL: usize = 2;

/// The line of an answer: what stands behind it.
#[derive(Debug)]
pub(in crate::kernel::process) struct Head {
    blocks: Vec<WireBlock<AnswerBlock>>,
    /// Rays that are refused, and why.
    errors: Vec<(usize, String)>,
    /// Why all of them are.
    refusal: Option<String>,
    /// How many bytes come behind it.
    pub(in crate::kernel::process) bytes: usize,
}

/// Reads the line that answers the frame of that id with these tasks.
///
/// # Errors
/// [`Trouble`] where it is no answer to that frame, so that nobody knows what comes behind it.
pub(in crate::kernel::process) fn head(
    line: &[u8],
    id: u64,
    tasks: &[&Task<'_>],
) -> Result<Head, Trouble> {
    let wrong = |problem: String| Trouble::garbage(problem, line);
    let answer: WireFrameAnswer = serde_json::from_slice(line).map_err(|error| {
        wrong(match error.classify() {
            Category::Data => said(&error),
            _ => format!("no JSON object: {}", said(&error)),
        })
    })?;
    if answer.id.as_u64() != Some(id) {
        return Err(Trouble::WrongId {
            got: answer.id.to_string(),
            wanted: id,
        });
    }
    let rays = tasks.len();
    let channels = channels(tasks);
    let most = rays * (OF_A_RAY + OF_A_CHANNEL * channels) * NUMBER;
    let bytes = usize::try_from(answer.bytes).ok();
    let bytes = bytes.filter(|bytes| *bytes <= most).ok_or_else(|| {
        let got = answer.bytes;
        wrong(format!("a frame of {got} bytes (allowed: up to {most})"))
    })?;
    let mut sizes = answer.blocks.iter().map(WireBlock::size);
    let all = sizes.try_fold(0_usize, |sum, size| sum.checked_add(size?));
    if all != Some(bytes) {
        let all = all.map_or("too many".into(), |all| all.to_string());
        let problem = format!("blocks of {all} bytes in a frame of {bytes} (allowed: all of them)");
        return Err(wrong(problem));
    }
    for (i, block) in answer.blocks.iter().enumerate() {
        let before = answer.blocks.iter().take(i);
        if before.into_iter().any(|other| other.name == block.name) {
            let name = block.name.name();
            return Err(wrong(format!(
                "a block '{name}' twice (allowed: each once)"
            )));
        }
    }
    if answer.error.is_some() && !(answer.blocks.is_empty() && answer.errors.is_empty()) {
        return Err(wrong(
            "a frame with 'blocks' or 'errors' and 'error'".into(),
        ));
    }
    let mut errors: Vec<(usize, String)> = Vec::with_capacity(answer.errors.len());
    for refused in answer.errors {
        let ray = usize::try_from(refused.ray).ok().filter(|ray| *ray < rays);
        let Some(ray) = ray.filter(|ray| errors.last().is_none_or(|(last, _)| last < ray)) else {
            let problem = format!(
                "an error of ray {} (allowed: 0 to {}, ascending)",
                refused.ray,
                rays.saturating_sub(1)
            );
            return Err(wrong(problem));
        };
        errors.push((ray, refused.error));
    }
    Ok(Head {
        blocks: answer.blocks,
        errors,
        refusal: answer.error,
        bytes,
    })
}

fn channels(tasks: &[&Task<'_>]) -> usize {
    let first = tasks.first();
    first.map_or(0, |task| task.subject.channels().len())
}

/// What a kernel that greeted so answers: the results of the tasks, or why it refuses all of them.
pub(in crate::kernel::process) fn read(
    head: &Head,
    bytes: &[u8],
    tasks: &[&Task<'_>],
    greeting: &Greeting,
) -> Result<Results, String> {
    if let Some(reason) = &head.refusal {
        return Err(reason.clone());
    }
    let channels = channels(tasks);
    let mut answer = Answer::default();
    let mut rest = bytes;
    let mut wrong = None;
    for block in &head.blocks {
        let size = block.size().unwrap_or(usize::MAX);
        let (own, behind) = rest.split_at_checked(size).unwrap_or((rest, &[]));
        rest = behind;
        let (kind, shape) = block.name.of(tasks.len() as u64, channels as u64);
        if block.kind == kind && block.shape == shape {
            answer.keep(block.name, own.as_chunks().0);
        } else {
            wrong.get_or_insert(KernelError::Block {
                name: block.name.name(),
                got: described(block.kind, &block.shape),
                wanted: described(kind, &shape),
            });
        }
    }
    let wrong = wrong.or_else(|| answer.undeclared(greeting));
    let mut errors = head.errors.iter().peekable();
    let results = (0..tasks.len()).map(|ray| {
        let refused = errors.next_if(|(refused, _)| *refused == ray);
        match (&wrong, refused) {
            (_, Some((_, reason))) => Err(KernelError::Refused {
                reason: reason.clone(),
            }),
            (Some(error), None) => Err(error.clone()),
            (None, None) => answer.rendering(ray, channels),
        }
    });
    Ok(results.collect())
}

impl Head {
    /// What came behind it, as lines for the log.
    pub(in crate::kernel::process) fn text(&self, bytes: &[u8]) -> serde_json::Result<Vec<u8>> {
        text(&self.blocks, bytes)
    }
}

impl AnswerBlock {
    /// Of which type and shape it is.
    fn of(self, rays: u64, channels: u64) -> (BlockType, Vec<u64>) {
        match self {
            AnswerBlock::Radiance | AnswerBlock::StandardError => {
                (BlockType::Real, vec![rays, channels])
            }
            AnswerBlock::Opacity
            | AnswerBlock::OpticalDepth
            | AnswerBlock::ExpectedDepth
            | AnswerBlock::Step => (BlockType::Real, vec![rays]),
            AnswerBlock::Segments => (BlockType::Integer, vec![rays]),
        }
    }
}

/// The numbers of a block.
type Numbers<'b> = &'b [[u8; NUMBER]];

/// The blocks that are there.
#[derive(Default)]
struct Answer<'b> {
    radiance: Option<Numbers<'b>>,
    opacity: Option<Numbers<'b>>,
    optical_depth: Option<Numbers<'b>>,
    expected_depth: Option<Numbers<'b>>,
    step: Option<Numbers<'b>>,
    segments: Option<Numbers<'b>>,
    standard_error: Option<Numbers<'b>>,
}

impl<'b> Answer<'b> {
    fn keep(&mut self, name: AnswerBlock, numbers: Numbers<'b>) {
        let place = match name {
            AnswerBlock::Radiance => &mut self.radiance,
            AnswerBlock::Opacity => &mut self.opacity,
            AnswerBlock::OpticalDepth => &mut self.optical_depth,
            AnswerBlock::ExpectedDepth => &mut self.expected_depth,
            AnswerBlock::Step => &mut self.step,
            AnswerBlock::Segments => &mut self.segments,
            AnswerBlock::StandardError => &mut self.standard_error,
        };
        *place = Some(numbers);
    }

    /// A quantity that is declared and missing, or the other way round.
    fn undeclared(&self, greeting: &Greeting) -> Option<KernelError> {
        let there = [
            (Quantity::Radiance, self.radiance.is_some()),
            (Quantity::Opacity, self.opacity.is_some()),
            (Quantity::OpticalDepth, self.optical_depth.is_some()),
            (Quantity::ExpectedDepth, self.expected_depth.is_some()),
        ];
        let mut wrong = there
            .into_iter()
            .filter(|(quantity, given)| *given != greeting.declaration.has(*quantity));
        let (quantity, given) = wrong.next()?;
        Some(KernelError::Answers { quantity, given })
    }

    fn rendering(&self, ray: usize, channels: usize) -> Result<Rendering, KernelError> {
        let all = |block: Option<Numbers<'b>>| {
            let start = ray * channels;
            block.and_then(|numbers| numbers.get(start..start + channels))
        };
        let one = |block: Option<Numbers<'b>>| block.and_then(|numbers| numbers.get(ray)).copied();
        let real = f64::from_le_bytes;
        let float = |number: [u8; NUMBER]| Float::with_val(f64::MANTISSA_DIGITS, real(number));
        let radiance = all(self.radiance).unwrap_or_default().iter();
        let errors = all(self.standard_error);
        Ok(Rendering {
            radiance: radiance.copied().map(float).collect(),
            opacity: one(self.opacity).map(float),
            optical_depth: one(self.optical_depth).map(float),
            expected_depth: one(self.expected_depth).map(float),
            // Asked as a task of its own.
            emission: None,
            gradient: None,
            step: one(self.step).map(real).map(used_step).transpose()?,
            segments: one(self.segments)
                .map(i64::from_le_bytes)
                .map(used_segments)
                .transpose()?,
            // Of a kernel that takes frames its segments are those given.
            edges: None,
            standard_error: errors.map(|errors| errors.iter().copied().map(real).collect()),
        })
    }
}

fn used_segments(value: i64) -> Result<u64, KernelError> {
    let count = u64::try_from(value).ok().filter(|count| *count > 0);
    count.ok_or(KernelError::Used {
        what: "number of segments",
        value: value as f64,
    })
}
