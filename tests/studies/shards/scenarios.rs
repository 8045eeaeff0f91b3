//! What is joined is what one process writes, whatever happened to the files meanwhile.

use crate::sweep::fixture::{levels, unit};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use volver::study::shards::{Divisible, Division, Gathered, Shard};
use volver::study::sweep::{Block, Divided, Errors, Header, Journal, Keep, StudyShard, Unit};

const UNITS: u32 = 23;

pub(super) fn work() -> Divided {
    let header = Header {
        volver: env!("CARGO_PKG_VERSION").into(),
        cases: vec![["made-up", "1", "lambda", "1", "s"].map(String::from)],
        methods: vec!["a × b".into(), "c × d".into()],
        formats: (0..UNITS)
            .map(|bits| format!("mpfr:{}", bits + 4))
            .collect(),
        levels: levels(),
        errors: Errors::Split,
    };
    let swept = vec![false; header.formats.len()];
    Divided::new(header, None, swept)
}

fn units() -> Vec<Unit> {
    let bits = 4..UNITS + 4;
    bits.map(|bits| {
        let mut unit = unit(&format!("mpfr:{bits}"), bits);
        let mut other = unit.rows[0].clone();
        other.method = "c × d".into();
        other.levels[3].oracle_bits = Some(320);
        unit.rows.push(other);
        unit
    })
    .collect()
}

/// What a block has of them.
pub(super) fn part(units: &[Unit], block: &Block) -> Unit {
    let mut unit = units[block.unit].clone();
    let own = levels().len();
    unit.rows = unit.rows[block.methods.clone()].to_vec();
    let within = |range: &std::ops::Range<usize>, from: usize, count: usize| {
        let place = |end: usize| end.clamp(from, from + count) - from;
        place(range.start)..place(range.end)
    };
    for row in &mut unit.rows {
        let (levels, between) = (
            within(&block.levels, 0, own),
            within(&block.levels, own, row.between.len()),
        );
        row.levels = row.levels[levels].to_vec();
        row.between = row.between[between].to_vec();
    }
    unit
}

/// Seconds of each by the model: one is as dear as all others together.
fn costs() -> Vec<f64> {
    let dear = |unit| {
        if unit == 3 {
            f64::from(UNITS) - 1.0
        } else {
            1.0
        }
    };
    (0..UNITS).map(dear).collect()
}

/// It, in so many shards.
pub(super) fn division(folder: &Path, shards: usize) -> Division<Divided> {
    let work = work().cut(&costs(), shards);
    let costs = work.shares(&costs());
    let division = Division::new(work, vec!["volver".into()], costs.clone(), costs, shards);
    division.unwrap().kept_in(folder).unwrap()
}

/// A folder that need not wait for a disk, where the system has one.
fn in_memory() -> TempDir {
    tempfile::tempdir_in("/dev/shm")
        .or_else(|_| tempfile::tempdir())
        .unwrap()
}

/// What one process keeps of it.
fn journal(folder: &Path) -> Vec<u8> {
    let path = folder.join("one.jsonl");
    let header = work().header;
    let mut journal = Journal::begin(&path, &header).unwrap();
    for unit in units() {
        journal.append(unit).unwrap();
    }
    journal.finish(&header).unwrap();
    fs::read(path).unwrap()
}

/// Runs of shards in a folder, and what befalls their files.
struct Scenario {
    random: Pcg64,
    folder: PathBuf,
    division: Division<Divided>,
    units: Vec<Unit>,
}

impl Scenario {
    fn below(&mut self, end: usize) -> usize {
        usize::try_from(self.random.next_u64() % end as u64).unwrap()
    }

    fn begin(&self, shard: usize) -> StudyShard {
        let shard = Shard::begin(&self.folder, &self.division, shard).unwrap();
        StudyShard::new(shard, &self.division.work)
    }

    /// The next unit that it wants, done; whether there was one.
    fn step(&self, shard: &mut StudyShard) -> bool {
        let left = shard.wanted();
        let Some(block) = left.first() else {
            return false;
        };
        shard.keep(block, part(&self.units, block), 0.25).unwrap();
        true
    }

    fn run(&self, shard: usize) {
        let mut shard = self.begin(shard);
        while self.step(&mut shard) {}
        shard.into_shard().finish().unwrap();
    }

    /// A file of a shard, any.
    fn file(&mut self) -> Option<PathBuf> {
        let entries = fs::read_dir(self.folder.join("shards")).ok()?;
        let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
        files.sort();
        let count = files.len();
        (count > 0).then(|| files.swap_remove(self.below(count)))
    }

    fn happens(&mut self) {
        let shard = self.below(self.division.shards()) + 1;
        match self.below(8) {
            0 | 1 => self.run(shard),
            // Killed, between two units or within one.
            2 | 3 => {
                let mut killed = self.begin(shard);
                for _ in 0..self.below(6) {
                    self.step(&mut killed);
                }
            }
            // Twice at once, each as fast as it likes; either may be first, and one may be killed.
            4 => {
                let (mut first, mut second) = (self.begin(shard), self.begin(shard));
                let mut is_left = true;
                while is_left {
                    let (a, b) = (self.below(3), self.below(3));
                    let steps = (0..a).map(|_| self.step(&mut first)).collect::<Vec<_>>();
                    let more = (0..b).map(|_| self.step(&mut second)).collect::<Vec<_>>();
                    is_left = !steps.contains(&false) && !more.contains(&false);
                }
                while self.step(&mut first) {}
                first.into_shard().finish().unwrap();
                if self.below(2) == 0 {
                    while self.step(&mut second) {}
                    second.into_shard().finish().unwrap();
                }
            }
            5 => {
                if let Some(file) = self.file() {
                    let mut bytes = fs::read(&file).unwrap();
                    bytes.truncate(self.below(bytes.len() + 1));
                    fs::write(file, bytes).unwrap();
                }
            }
            6 => {
                if let Some(file) = self.file() {
                    let mut bytes = fs::read(&file).unwrap();
                    if !bytes.is_empty() {
                        let at = self.below(bytes.len());
                        bytes[at] ^= 1 << self.below(8);
                        fs::write(file, bytes).unwrap();
                    }
                }
            }
            _ => {
                if let Some(file) = self.file() {
                    let copy = format!("{shard}-of-{}.copy.part", self.division.shards());
                    fs::copy(&file, file.with_file_name(copy)).unwrap();
                }
            }
        }
    }

    fn missing(&self) -> Vec<usize> {
        let gathered = Gathered::new(&self.folder, &self.division).unwrap();
        let keys = self.division.work.keys();
        let missing = (0..keys.len()).filter(|unit| !gathered.has(keys[*unit]));
        let mut shards: Vec<usize> = missing.map(|unit| self.division.shard_of(unit)).collect();
        shards.dedup();
        shards
    }
}

#[test]
fn two_hundred_scenarios_are_joined_byte_for_byte() {
    let mut was_incomplete = 0;
    let mut was_troubled = 0;
    let wanted = journal(in_memory().path());
    for seed in 0..200 {
        let folder = in_memory();
        let shards = 1 + usize::try_from(seed % 60).unwrap();
        let mut scenario = Scenario {
            random: Pcg64::seed_from_u64(seed),
            folder: folder.path().into(),
            division: division(folder.path(), shards),
            units: units(),
        };
        for _ in 0..=scenario.below(14) {
            scenario.happens();
        }
        let missing = scenario.missing();
        was_incomplete += usize::from(!missing.is_empty());
        for shard in missing {
            scenario.run(shard);
        }
        assert_eq!(scenario.missing(), Vec::<usize>::new(), "scenario {seed}");
        let gathered = Gathered::new(folder.path(), &scenario.division).unwrap();
        was_troubled += usize::from(!gathered.troubles.is_empty());
        let units = scenario.division.work.units(&gathered).unwrap().unwrap();
        let path = folder.path().join("study.jsonl");
        scenario.division.work.write_journal(&path, &units).unwrap();
        assert!(fs::read(&path).unwrap() == wanted, "scenario {seed}");
    }
    // They are no easy ones.
    assert!(was_incomplete > 100, "{was_incomplete}");
    assert!(was_troubled > 5, "{was_troubled}");
}

#[test]
fn whole_units_are_as_even_as_the_dearest_of_them_lets_them_be() {
    let seconds = |shards| {
        Division::new(work(), Vec::new(), costs(), costs(), shards)
            .unwrap()
            .seconds()
    };
    assert_eq!(seconds(1), (44.0, 44.0));
    assert_eq!(seconds(2), (22.0, 25.0));
    assert_eq!(seconds(4), (11.0, 22.0));
}

#[test]
fn a_unit_that_came_out_differently_is_no_unit() {
    let folder = tempfile::tempdir().unwrap();
    let division = division(folder.path(), 2);
    let begin = || {
        let shard = Shard::begin(folder.path(), &division, 1).unwrap();
        StudyShard::new(shard, &division.work)
    };
    let (mut first, mut second) = (begin(), begin());
    let same = units().remove(0);
    let mut other = same.clone();
    other.bits += 1;
    let block = &division.work.blocks[0];
    first.keep(block, same, 1.0).unwrap();
    second.keep(block, other, 1.0).unwrap();
    let gathered = Gathered::new(folder.path(), &division).unwrap();
    let troubles: Vec<String> = gathered.troubles.iter().map(ToString::to_string).collect();
    assert_eq!(troubles.len(), 1);
    assert!(
        troubles[0].starts_with("made-up in mpfr:4 came out differently in "),
        "{troubles:?}"
    );
}
