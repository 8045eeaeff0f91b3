//! Blocks of units, done apart and joined, are the units to the last digit.

use super::fixture::{case, sweep};
use quickcheck::{QuickCheck, TestResult};
use std::sync::Mutex;
use volver::study::Silent;
use volver::study::shards::{Division, Gathered, Shard};
use volver::study::sweep::{
    Block, Divided, Errors, Header, Journal, Keep, StudyShard, Sweep, SweepError, Unit, run,
};

/// What one process keeps of it.
fn whole(sweep: &Sweep) -> Vec<Unit> {
    let mut journal = Journal::unkept();
    run(sweep, &mut journal, 2, &Silent).unwrap();
    journal.finish(&Header::new(sweep)).unwrap()
}

/// What so many shards keep of it, units costing that much by themselves.
fn apart(sweep: &Sweep, costs: &[f64], shards: usize) -> (Vec<Block>, Vec<Unit>) {
    let folder = tempfile::tempdir().unwrap();
    let swept = vec![false; sweep.formats.len()];
    let work = Divided::new(Header::new(sweep), None, swept).cut(costs, shards);
    let costs = work.shares(costs);
    let division = Division::new(work, Vec::new(), costs.clone(), costs, shards).unwrap();
    for shard in 1..=shards {
        let shard = Shard::begin(folder.path(), &division, shard).unwrap();
        let mut shard = StudyShard::new(shard, &division.work);
        run(sweep, &mut shard, 1, &Silent).unwrap();
        assert_eq!(shard.left(sweep), Vec::new());
        shard.into_shard().finish().unwrap();
    }
    let gathered = Gathered::new(folder.path(), &division).unwrap();
    let units = division.work.units(&gathered).unwrap().unwrap();
    (division.work.blocks, units)
}

fn hard(errors: Errors) -> Sweep {
    Sweep {
        // On the last one methods need different bits of the oracle.
        cases: ["sine-squared", "jump-off-node", "deep-rise"]
            .map(|name| (name.into(), case(name)))
            .into(),
        methods: [
            "trapezoid/trapezoid",
            "midpoint/gauss-2/cubic",
            "simpson/boole",
            "front-to-back/middle/expm1/neumaier",
            "front-to-back/front/subtraction",
            "front-to-back/front/subtraction/stop=1:16",
            "preintegrated/linear-by-2-midpoint/linear-by-2-midpoint",
            "back-to-front/back/relative",
        ]
        .map(|name| name.parse().unwrap())
        .into(),
        formats: ["f16", "f64", "mpfr:300"]
            .map(|name| name.parse().unwrap())
            .into(),
        levels: vec![2, 4, 8, 16, 32],
        errors,
    }
}

#[test]
fn as_many_shards_as_there_are_methods_and_levels_make_the_same_units() {
    for errors in [Errors::Split, Errors::Total] {
        let sweep = hard(errors);
        let units = sweep.cases.len() * sweep.formats.len();
        let wanted = whole(&sweep);
        for shards in [2, 7, 64] {
            let (blocks, found) = apart(&sweep, &vec![1.0; units], shards);
            assert!(blocks.len() > units, "{shards} {}", blocks.len());
            // As they are written: NaN is NaN there.
            for (found, wanted) in found.iter().zip(&wanted) {
                let text = |unit| serde_json::to_string(unit).unwrap();
                let what = format!("{errors} in {shards}: {} in {}", found.case, found.format);
                assert!(text(found) == text(wanted), "{what}");
            }
            assert_eq!(found.len(), wanted.len());
        }
    }
}

#[test]
fn every_method_at_every_level_is_in_one_block() {
    fn property(costs: [u8; 4], shards: u8) -> TestResult {
        let header = Header::new(&sweep());
        let (levels, methods) = (header.every_level().len(), header.methods.len());
        let shards = usize::from(shards) % (4 * levels * methods) + 1;
        let costs = costs.map(|cost| f64::from(cost) + 0.5);
        let work = Divided::new(header, None, Vec::new()).cut(&costs, shards);
        let mut seen = vec![0; 4 * levels * methods];
        for block in &work.blocks {
            for level in block.levels.clone() {
                for method in block.methods.clone() {
                    seen[(block.unit * levels + level) * methods + method] += 1;
                }
            }
        }
        let whole: f64 = costs.iter().sum();
        let shares: f64 = work.shares(&costs).iter().sum();
        TestResult::from_bool(
            seen.iter().all(|times| *times == 1)
                && work.blocks.len() >= shards
                && shares > whole * (1.0 - 1e-12),
        )
    }
    QuickCheck::new()
        .tests(1000)
        .quickcheck(property as fn([u8; 4], u8) -> TestResult);
}

#[test]
fn a_unit_that_costs_as_much_as_three_shards_is_no_shard_of_its_own() {
    let sweep = Sweep {
        levels: (3..=12).map(|k| 1 << k).collect(),
        ..hard(Errors::Split)
    };
    let mut costs = vec![1.0; sweep.cases.len() * sweep.formats.len()];
    costs[1] = costs.len() as f64;
    let work = Divided::new(Header::new(&sweep), None, Vec::new()).cut(&costs, 8);
    let costs = work.shares(&costs);
    let division = Division::new(work, Vec::new(), costs.clone(), costs, 8).unwrap();
    let (mean, slowest) = division.seconds();
    assert!(slowest <= 1.15 * mean, "{slowest} of {mean}");
    // Cut where shards meet, and nowhere else: two cuts of a method's row at the most, three parts each.
    let units = sweep.cases.len() * sweep.formats.len();
    assert!(division.work.blocks.len() <= units + 3 * 8);
}

/// Keeps only what it is told to do.
struct Only(Vec<Block>, Mutex<Vec<(Block, Unit)>>);

impl Keep for Only {
    fn left(&self, _: &Sweep) -> Vec<Block> {
        self.0.clone()
    }

    fn keep(&mut self, block: &Block, unit: Unit, _: f64) -> Result<(), SweepError> {
        self.1.lock().unwrap().push((block.clone(), unit));
        Ok(())
    }
}

#[test]
fn a_block_has_its_own_methods_and_levels_and_no_others() {
    let sweep = sweep();
    let block = Block {
        unit: 2,
        levels: 2..5,
        methods: 1..2,
    };
    let mut only = Only(vec![block.clone()], Mutex::default());
    run(&sweep, &mut only, 1, &Silent).unwrap();
    let found = only.1.into_inner().unwrap();
    let [(done, unit)] = &found[..] else {
        panic!("one block");
    };
    assert_eq!(*done, block);
    assert_eq!((&*unit.case, &*unit.format), ("homogeneous", "f32"));
    let [row] = &unit.rows[..] else {
        panic!("one method");
    };
    assert_eq!(row.method, "simpson/boole");
    let all = Header::new(&sweep).every_level();
    let n = |levels: &[volver::study::sweep::LevelRecord]| {
        levels.iter().map(|level| level.n).collect::<Vec<_>>()
    };
    assert_eq!(n(&row.levels), all[2..4]);
    assert_eq!(n(&row.between), all[4..5]);
}

#[test]
fn each_method_by_itself_has_the_row_that_it_has_among_others() {
    for errors in [Errors::Split, Errors::Total] {
        let sweep = hard(errors);
        let wanted = whole(&sweep);
        let header = Header::new(&sweep);
        let levels = header.every_level().len();
        let units = 0..wanted.len();
        let blocks = units.flat_map(|unit| {
            (0..sweep.methods.len()).map(move |method| Block {
                unit,
                levels: 0..levels,
                methods: method..method + 1,
            })
        });
        let mut only = Only(blocks.collect(), Mutex::default());
        run(&sweep, &mut only, 2, &Silent).unwrap();
        for (block, unit) in only.1.into_inner().unwrap() {
            let among_others = &wanted[block.unit].rows[block.methods.start];
            let text = |row| serde_json::to_string(row).unwrap();
            let what = format!(
                "{} on {} in {}",
                among_others.method, unit.case, unit.format
            );
            assert_eq!(text(&unit.rows[0]), text(among_others), "{what}");
        }
    }
}
