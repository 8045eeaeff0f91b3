//! Units cut into blocks, as few as make shards even.

use super::block::Block;
use super::record::Header;
use crate::study::shards;

/// The share of its unit that a block costs: all methods of a level cost the same, and a level by its segments.
#[derive(Debug)]
pub(super) struct Shares {
    levels: Vec<f64>,
    methods: f64,
}

impl Shares {
    pub(super) fn new(header: &Header) -> Shares {
        let levels = header.every_level();
        let all: f64 = levels.iter().map(|n| *n as f64).sum();
        Shares {
            levels: levels.iter().map(|n| *n as f64 / all).collect(),
            methods: header.methods.len().max(1) as f64,
        }
    }

    pub(super) fn of(&self, block: &Block) -> f64 {
        let levels = self.levels.get(block.levels.clone()).unwrap_or_default();
        levels.iter().sum::<f64>() * block.methods.len() as f64 / self.methods
    }
}

/// Units that cost so much each, cut where one shard ends and the next begins, and nowhere else: what methods and levels have in
/// common is computed anew in each block.
pub(super) fn cut(header: &Header, costs: &[f64], shards: usize) -> Vec<Block> {
    let most = costs.iter().sum::<f64>() / shards.max(1) as f64 / PIECES;
    let pieces = pieces(header, costs, most);
    let pieces = if pieces.len() < shards {
        self::pieces(header, costs, 0.0)
    } else {
        pieces
    };
    let shares = Shares::new(header);
    let cost = |block: &Block| {
        costs
            .get(block.unit)
            .map_or(0.0, |cost| cost * shares.of(block))
    };
    let costs: Vec<f64> = pieces.iter().map(cost).collect();
    let mut begin = 0;
    let mut blocks = Vec::new();
    for end in shards::cut(&costs, shards) {
        blocks.extend(together(pieces.get(begin..end).unwrap_or_default()));
        begin = end;
    }
    blocks
}

/// A piece is no more than such a part of a shard.
const PIECES: f64 = 8.0;

/// All units in pieces of about that cost: levels, and methods of levels that cost more.
fn pieces(header: &Header, costs: &[f64], most: f64) -> Vec<Block> {
    let shares = Shares::new(header);
    let methods = header.methods.len();
    let mut pieces = Vec::new();
    for block in Block::whole(header) {
        let cost = costs.get(block.unit).copied().unwrap_or(0.0);
        for level in block.levels.clone() {
            let one = Block {
                unit: block.unit,
                levels: level..level + 1,
                methods: block.methods.clone(),
            };
            // As many groups as it takes, at most one a method.
            let cost = cost * shares.of(&one);
            let is_enough = |groups: &usize| cost <= most * *groups as f64;
            let groups = (1..methods).find(is_enough).unwrap_or(methods);
            let bound = |group: usize| group * methods / groups.max(1);
            pieces.extend((0..groups).map(|group| Block {
                methods: bound(group)..bound(group + 1),
                ..one.clone()
            }));
        }
    }
    pieces
}

/// What follows each other in a shard, in as few blocks as it takes.
fn together(pieces: &[Block]) -> Vec<Block> {
    let joins_methods = |last: &Block, next: &Block| {
        last.levels == next.levels && last.methods.end == next.methods.start
    };
    let joins_levels = |last: &Block, next: &Block| {
        last.methods == next.methods && last.levels.end == next.levels.start
    };
    let mut of_levels: Vec<Block> = Vec::new();
    for next in pieces {
        match of_levels.last_mut() {
            Some(last) if last.unit == next.unit && joins_methods(last, next) => {
                last.methods.end = next.methods.end;
            }
            _ => of_levels.push(next.clone()),
        }
    }
    let mut blocks: Vec<Block> = Vec::new();
    for next in of_levels {
        match blocks.last_mut() {
            Some(last) if last.unit == next.unit && joins_levels(last, &next) => {
                last.levels.end = next.levels.end;
            }
            _ => blocks.push(next),
        }
    }
    blocks
}
