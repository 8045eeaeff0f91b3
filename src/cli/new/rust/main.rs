//! A kernel for volver: `composite`, asked over pipes.
//!
//!     cargo test                                its own test, without volver
//!     cargo build --release
//!     volver verify target/release/kernel       its order, and what it computes
//!
//! If `composite` is another rule, say so in HELLO: "order":1 in place of "method" claims no more than an order.
//! docs/protocol.md of volver lists what a kernel may declare.

mod composite;
mod json;

use composite::composite;
use json::{written, Json};
use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::os::fd::FromRawFd;

const HELLO: &str = r#"{"type":"hello","protocol":1,"name":"my kernel","form":"segments","format":"f64","method":"front-to-back/middle/subtraction"}"#;

fn main() -> std::io::Result<()> {
    if std::env::var_os("VOLVER_PROTOCOL").is_none() {
        eprintln!("no requests on descriptor 3 (allowed: to be started by volver)");
        std::process::exit(2);
    }
    // SAFETY: whoever sets the variable has opened both, and nobody else here uses them.
    let (requests, mut answers) = unsafe { (File::from_raw_fd(3), File::from_raw_fd(4)) };
    for line in BufReader::new(requests).lines() {
        let message = Json::read(&line?);
        let request = message.as_ref().and_then(request);
        let answer = request.unwrap_or_else(|| HELLO.into());
        answers.write_all((answer + "\n").as_bytes())?;
    }
    Ok(())
}

/// The answer to a request; none to a greeting.
fn request(message: &Json) -> Option<String> {
    let id = message.get("id")?.number()?;
    let result = |task: &Json| {
        let radiance = render(task).map(|all| all.into_iter().map(written).collect::<Vec<_>>());
        radiance.map_or(r#"{"error":"no segments"}"#.into(), |all| {
            format!(r#"{{"radiance":[{}]}}"#, all.join(","))
        })
    };
    let tasks = message.get("tasks")?.items()?;
    let results: Vec<String> = tasks.iter().map(result).collect();
    let results = results.join(",");
    Some(format!(r#"{{"type":"radiance","id":{id},"results":[{results}]}}"#))
}

/// The radiance of every channel of a task.
fn render(task: &Json) -> Option<Vec<f64>> {
    let data = task.get("data")?;
    let ends = data.get("edges")?.get("lambda")?.numbers()?;
    let middles = data.get("middles")?;
    let extinction = middles.get("extinction")?.numbers()?;
    let channels = middles.get("emission")?.items()?.iter();
    let radiance = |emission: &Json| Some(composite(&ends, &extinction, &emission.numbers()?));
    channels.map(radiance).collect()
}
