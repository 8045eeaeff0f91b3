//! Units cut into blocks where one shard ends and the next begins, and nowhere else: what methods and levels have in common is
//! computed anew in each.

use super::block::Block;
use super::kept;
use super::record::Header;
use crate::method::Method;
use std::ops::Range;

/// A level is cut between methods where it costs more than such a part of a shard.
const PART: f64 = 1.0 / 16.0;
/// Steps in which the cost of the dearest shard is looked for, each of which halves what is left.
const STEPS: u32 = 50;

/// The share of its unit that a block costs.
#[derive(Debug)]
pub(super) struct Shares {
    /// Of each level, by its segments.
    levels: Vec<f64>,
    /// Of methods from one on up to another one, by the nodes and depths that they look at together.
    methods: Vec<Vec<f64>>,
}

impl Shares {
    pub(super) fn new(header: &Header) -> Shares {
        let levels = header.every_level();
        let all: f64 = levels.iter().map(|n| *n as f64).sum();
        let count = header.methods.len();
        let methods = header.methods.iter().map(|name| name.parse().ok());
        let methods: Option<Vec<Method>> = methods.collect();
        let looks = |range: Range<usize>| match &methods {
            Some(methods) => kept::looks(methods.get(range).unwrap_or_default()),
            None => range.len() as f64,
        };
        let whole = looks(0..count);
        let from = |start| {
            (start..=count)
                .map(|end| looks(start..end) / whole)
                .collect()
        };
        Shares {
            levels: levels.iter().map(|n| *n as f64 / all).collect(),
            methods: (0..count).map(from).collect(),
        }
    }

    pub(super) fn of(&self, block: &Block) -> f64 {
        let levels = self.levels.get(block.levels.clone()).unwrap_or_default();
        levels.iter().sum::<f64>() * self.of_methods(&block.methods)
    }

    fn of_methods(&self, methods: &Range<usize>) -> f64 {
        let from = self.methods.get(methods.start);
        let share = from.and_then(|from| from.get(methods.len()));
        share.copied().unwrap_or(0.0)
    }
}

/// Units that cost so much each in blocks for so many shards, so that the dearest shard costs as little as it can.
pub(super) fn cut(header: &Header, costs: &[f64], shards: usize) -> Vec<Block> {
    let filling = Filling {
        shares: Shares::new(header),
        whole: Block::whole(header),
        costs,
    };
    let (mut low, mut high) = (0.0_f64, costs.iter().sum::<f64>());
    let mut blocks = filling.shards_of(high);
    for _ in 0..STEPS {
        let middle = low.midpoint(high);
        let filled = filling.shards_of(middle);
        if filled.len() <= shards {
            (high, blocks) = (middle, filled);
        } else {
            low = middle;
        }
    }
    let blocks: Vec<Block> = blocks.into_iter().flatten().collect();
    if blocks.len() < shards {
        return filling.one_by_one();
    }
    blocks
}

/// Units, and what they cost.
struct Filling<'a> {
    shares: Shares,
    whole: Vec<Block>,
    costs: &'a [f64],
}

impl Filling<'_> {
    /// The blocks of each shard, where none costs more than that; or no less than its dearest piece.
    fn shards_of(&self, most: f64) -> Vec<Vec<Block>> {
        let mut shards = Shards {
            most,
            blocks: vec![Vec::new()],
            sum: 0.0,
        };
        for unit in &self.whole {
            let cost = self.costs.get(unit.unit).copied().unwrap_or(0.0);
            if shards.has_room_for(cost) {
                shards.add(unit.clone(), cost);
                continue;
            }
            for level in unit.levels.clone() {
                let level = Block {
                    levels: level..level + 1,
                    ..unit.clone()
                };
                self.fill(&mut shards, level, cost);
            }
        }
        shards.blocks
    }

    /// Puts a level into the shards, cut between methods where it is dear.
    fn fill(&self, shards: &mut Shards, level: Block, cost: f64) {
        let all = level.methods.end;
        let is_dear = cost * self.shares.of(&level) > shards.most * PART;
        let mut rest = level;
        while !rest.methods.is_empty() {
            let block = |end: usize| Block {
                methods: rest.methods.start..end,
                ..rest.clone()
            };
            let cost_to = |end: usize| cost * self.shares.of(&block(end));
            let first = rest.methods.start + 1;
            let last = if shards.has_room_for(cost_to(all)) || !is_dear {
                all
            } else {
                let fitting = (first..=all).take_while(|end| shards.has_room_for(cost_to(*end)));
                fitting
                    .last()
                    .unwrap_or(if shards.is_begun() { 0 } else { first })
            };
            if last == 0 || (!shards.has_room_for(cost_to(last)) && shards.is_begun()) {
                shards.begin();
                continue;
            }
            shards.add(block(last), cost_to(last));
            rest.methods.start = last;
        }
    }

    /// Every method at every level by itself.
    fn one_by_one(&self) -> Vec<Block> {
        let units = self.whole.iter();
        let levels = units.flat_map(|unit| unit.levels.clone().map(move |level| (unit, level)));
        let blocks = levels.flat_map(|(unit, level)| {
            unit.methods.clone().map(move |method| Block {
                unit: unit.unit,
                levels: level..level + 1,
                methods: method..method + 1,
            })
        });
        blocks.collect()
    }
}

/// Shards that are being filled.
struct Shards {
    most: f64,
    blocks: Vec<Vec<Block>>,
    /// What the last one costs.
    sum: f64,
}

impl Shards {
    fn has_room_for(&self, cost: f64) -> bool {
        self.sum + cost <= self.most
    }

    /// Whether anything is in the last one.
    fn is_begun(&self) -> bool {
        self.blocks.last().is_some_and(|blocks| !blocks.is_empty())
    }

    fn begin(&mut self) {
        self.blocks.push(Vec::new());
        self.sum = 0.0;
    }

    /// To the block before, where it goes on with its levels.
    fn add(&mut self, block: Block, cost: f64) {
        self.sum += cost;
        let Some(blocks) = self.blocks.last_mut() else {
            return;
        };
        match blocks.last_mut() {
            Some(last)
                if last.unit == block.unit
                    && last.methods == block.methods
                    && last.levels.end == block.levels.start =>
            {
                last.levels.end = block.levels.end;
            }
            _ => blocks.push(block),
        }
    }
}
