//! What a unit of total errors keeps in memory: nodes that methods and levels share, as long as that is cheaper.

use crate::method::{Inner, Method};
use crate::quadrature::Rule;
use crate::real::FormatName;
use std::collections::BTreeSet;
use std::mem::size_of;

/// What a unit may keep of numbers that are plain memory: about a core's share of its caches. Beyond, a look-up of a kept node
/// waits for memory about as long as its evaluation takes.
const PLAIN_BYTES: f64 = (8_u64 << 20) as f64;
/// The same of MPFR's numbers: a node takes microseconds to evaluate, and memory alone is the limit.
const MPFR_BYTES: f64 = (128_u64 << 20) as f64;
/// Bytes that an MPFR number takes beside its digits: the header and the allocation.
const HEADER_BYTES: f64 = 48.0;
/// s, C and τ: by place in a table that is up to half empty, and in columns, those of coarser levels among them.
const NUMBERS_A_NODE: f64 = 12.0;
/// Depths of segments and boundaries, transmittances and terms there.
const NUMBERS_A_SEGMENT: f64 = 4.0;
/// The place of a node as a fraction, in that table.
const PLACE_BYTES: f64 = 32.0;

/// Bytes that a unit keeps of what these methods share where its finest shared level has n segments.
pub(super) fn bytes_shared(methods: &[Method], format: FormatName, n: u64) -> f64 {
    let inner: BTreeSet<String> = methods.iter().filter_map(inner).collect();
    let places = rows(methods) as f64;
    let number = number_bytes(format);
    let node = NUMBERS_A_NODE * number + PLACE_BYTES;
    n as f64 * (places * node + inner.len() as f64 * NUMBERS_A_SEGMENT * number)
}

/// Whether a level of n segments shares nodes with other methods and levels; else each method goes along the ray by itself.
pub(super) fn shares(methods: &[Method], format: FormatName, n: u64) -> bool {
    let most = match format {
        FormatName::Mpfr(_) => MPFR_BYTES,
        _ => PLAIN_BYTES,
    };
    bytes_shared(methods, format, n) <= most
}

/// Bytes of a method that keeps its ray, on n segments: nodes in columns, and depths.
pub(super) fn bytes_alone(method: &Method, format: FormatName, n: u64) -> f64 {
    if method.streams() {
        return 0.0;
    }
    let numbers = NUMBERS_A_NODE * rows(std::slice::from_ref(method)) as f64;
    n as f64 * (numbers + NUMBERS_A_SEGMENT) * number_bytes(format)
}

fn number_bytes(format: FormatName) -> f64 {
    match format {
        FormatName::Mpfr(bits) => f64::from(bits) / 8.0 + HEADER_BYTES,
        FormatName::F16
        | FormatName::Bf16
        | FormatName::F32
        | FormatName::F64
        | FormatName::F32Lanes
        | FormatName::F64Lanes => size_of::<f64>() as f64,
        // Emulated numbers are of machine integers.
        FormatName::Ieee(_) | FormatName::Fixed(_) => 2.0 * size_of::<u64>() as f64,
    }
}

fn inner(method: &Method) -> Option<String> {
    match method {
        Method::Nested(nested) => Some(nested.inner.to_string()),
        _ => None,
    }
}

/// Nodes and depths that the methods take of a segment together.
pub(super) fn looks(methods: &[Method]) -> f64 {
    let depths: BTreeSet<String> = methods.iter().filter_map(inner).collect();
    let others = methods.iter().filter(|method| inner(method).is_none());
    (rows(methods) + depths.len() + others.count()) as f64
}

/// Rows of nodes that the methods look at, a node a segment each: rules share their rows, and an open outer rule brings rows of
/// every inner one.
fn rows(methods: &[Method]) -> usize {
    let mut inner: BTreeSet<u32> = BTreeSet::new();
    let mut outer: BTreeSet<u32> = BTreeSet::new();
    let mut others = 0;
    for method in methods {
        match method {
            Method::Nested(nested) => {
                if let Inner::PerSegment(rule) = nested.inner {
                    inner.insert(inside(rule));
                }
                outer.insert(match nested.outer.0 {
                    Rule::Midpoint => 1,
                    Rule::GaussLegendre(points) => points,
                    _ => 0,
                });
            }
            Method::Composited(_) | Method::Preintegrated(_) | Method::Layered(_) => others = 1,
        }
    }
    let inner: u32 = inner.into_iter().fold(0, u32::saturating_add);
    let outer: u32 = outer.into_iter().fold(0, u32::saturating_add);
    let open = outer.saturating_mul(inner.saturating_add(1));
    let all = inner.saturating_add(open).saturating_add(1 + others);
    usize::try_from(all).unwrap_or(usize::MAX)
}

/// Nodes of a rule inside a segment.
fn inside(rule: Rule) -> u32 {
    match rule {
        Rule::RiemannLeft | Rule::RiemannRight | Rule::Trapezoid => 0,
        Rule::Midpoint | Rule::Simpson => 1,
        Rule::Boole => 3,
        Rule::GaussLegendre(points) => points,
    }
}
