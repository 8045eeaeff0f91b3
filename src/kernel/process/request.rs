//! From tasks to a message.

use super::files::Files;
use super::message::{Render, RenderTag, WireData, WireSamples, WireTable, WireTask};
use super::written::{Array, Numbers, Written};
use crate::kernel::{Data, Samples, Task};
use crate::real::{Format, Native};
use std::io;

/// How numbers and arrays are written.
#[derive(Debug)]
pub(super) struct Writer<'f> {
    pub(super) numbers: Numbers,
    /// Whether tasks have a background.
    pub(super) background: bool,
    /// Of every task one a channel, where gradients are wanted.
    pub(super) cotangents: Option<&'f [&'f [f64]]>,
    /// Where arrays go that do not go into the message.
    pub(super) files: Option<&'f mut Files>,
}

impl Writer<'_> {
    /// The request's line, with its end.
    pub(super) fn line(&mut self, id: u64, tasks: &[&Task<'_>]) -> io::Result<Vec<u8>> {
        let tasks = tasks.iter().enumerate();
        let tasks: io::Result<Vec<_>> = tasks.map(|(at, task)| self.task(at, task)).collect();
        let request = Render {
            tag: RenderTag::Render,
            id,
            tasks: tasks?,
        };
        let mut line = serde_json::to_vec(&request)?;
        line.push(b'\n');
        Ok(line)
    }

    fn task<'a>(&mut self, at: usize, task: &Task<'a>) -> io::Result<WireTask<'a>> {
        let length = Native::<f64>::new().ratio(task.subject.length());
        Ok(WireTask {
            case: task.subject.name(),
            channels: task.subject.channels(),
            length: self.number(length),
            step: self.number(task.step),
            segments: task.segments,
            seed: task.seed,
            background: self.background.then(|| self.behind(task)),
            cotangents: self
                .cotangents
                .and_then(|all| all.get(at))
                .map(|own| self.numbers_of(own)),
            data: self.data(task.data)?,
        })
    }

    /// Black where nothing is behind the ray.
    fn behind(&self, task: &Task<'_>) -> Vec<Written> {
        let background = task.subject.background().iter().copied();
        let black = std::iter::repeat(0.0);
        let all = background.chain(black).take(task.subject.channels().len());
        all.map(|value| self.number(value)).collect()
    }

    fn numbers_of(&self, values: &[f64]) -> Vec<Written> {
        values.iter().map(|value| self.number(*value)).collect()
    }

    fn data<'a>(&mut self, data: Data<'a>) -> io::Result<WireData<'a>> {
        Ok(match data {
            Data::Segments(segments) => WireData::Segments {
                edges: self.samples(&segments.edges)?,
                middles: self.samples(&segments.middles)?,
            },
            Data::Volume(volume) => WireData::Volume {
                field: self.array(&volume.field)?,
                table: WireTable {
                    first: self.number(volume.table.first),
                    last: self.number(volume.table.last),
                    extinction: self.array(&volume.table.extinction)?,
                    emission: self.arrays(&volume.table.emission)?,
                },
            },
            Data::Formula(formula) => WireData::Formula {
                language: formula.language.to_string(),
                code: &formula.code,
            },
            Data::Function => {
                let problem = "a function cannot be written down";
                return Err(io::Error::new(io::ErrorKind::Unsupported, problem));
            }
        })
    }

    fn samples<'a>(&mut self, samples: &'a Samples) -> io::Result<WireSamples<'a>> {
        Ok(WireSamples {
            lambda: self.array(&samples.lambda)?,
            extinction: self.array(&samples.extinction)?,
            emission: self.arrays(&samples.emission)?,
        })
    }

    fn arrays<'a>(&mut self, rows: &'a [Vec<f64>]) -> io::Result<Vec<Array<'a>>> {
        rows.iter().map(|row| self.array(row)).collect()
    }

    fn array<'a>(&mut self, values: &'a [f64]) -> io::Result<Array<'a>> {
        Ok(match &mut self.files {
            None => Array::Here(values, self.numbers),
            Some(files) => Array::File(files.write(values)?),
        })
    }

    fn number(&self, value: f64) -> Written {
        Written {
            value,
            numbers: self.numbers,
        }
    }
}
