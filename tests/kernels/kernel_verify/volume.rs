//! Kernels that are given a volume: refining the step leads to the radiance of the volume's own medium, refining
//! the grid to that of the case.

use super::{SMOOTH, composite, part, run, samples, settings, shown, subjects};
use rug::Float;
use volver::case::Case;
use volver::convergence::Verdict;
use volver::kernel::{
    Closure, Data, Declaration, FormKind, Kernel, KernelError, Quantity, Rendering, Subject, Task,
    Volume,
};
use volver::reference;
use volver::study::Silent;
use volver::study::verify::{
    Axis, Conclusion, GRID_SEGMENTS, Identify, Line, Settings, Standing, Verification, VerifyError,
    verify,
};

/// Pieces that every stretch between knots is cut into.
const PIECES: u32 = 16;

fn of_volume(
    declaration: Declaration,
    radiance: impl Fn(&Volume, &Task<'_>, usize) -> f64 + Send,
) -> impl Kernel {
    let declaration = Declaration {
        form: FormKind::Volume,
        ..declaration
    };
    Closure::new(declaration, move |task, channel| match task.data {
        Data::Volume(volume) => radiance(volume, task, channel),
        _ => panic!("a volume is asked for"),
    })
}

fn claimed(order: f64) -> Declaration {
    Declaration {
        order: Some(order),
        ..Declaration::new("under test")
    }
}

/// Linear between values that stand at 0, 1, 2 …
fn linear(values: &[f64], place: f64) -> f64 {
    let near = (place as usize).min(values.len() - 1);
    let far = (near + 1).min(values.len() - 1);
    values[near] + (place - near as f64) * (values[far] - values[near])
}

/// Where among the entries of the table a field value lies.
fn entry(volume: &Volume, s: f64) -> f64 {
    let table = &volume.table;
    let last = (table.extinction.len() - 1) as f64;
    if table.last > table.first {
        ((s - table.first) / (table.last - table.first) * last).clamp(0.0, last)
    } else {
        0.0
    }
}

/// (τ, C) at a place among the entries.
fn transfer(volume: &Volume, channel: usize, place: f64) -> (f64, f64) {
    let table = &volume.table;
    (
        linear(&table.extinction, place),
        linear(&table.emission[channel], place),
    )
}

/// One sample a segment, at a part of its length; the field between grid points by `interpolated`.
fn march(
    volume: &Volume,
    task: &Task<'_>,
    channel: usize,
    at: f64,
    interpolated: impl Fn(&[f64], f64) -> f64,
) -> f64 {
    let length = task.subject.length().to_f64();
    let cells = (volume.field.len() - 1) as f64;
    composite((0..task.segments).map(|j| {
        let near = j as f64 * task.step;
        let far = (near + task.step).min(length);
        let lambda = near + at * (far - near);
        let s = interpolated(&volume.field, lambda / length * cells);
        let (extinction, emission) = transfer(volume, channel, entry(volume, s));
        (extinction, emission, far - near)
    }))
}

fn middle(volume: &Volume, task: &Task<'_>, channel: usize) -> f64 {
    march(volume, task, channel, 0.5, linear)
}

/// The radiance of the medium itself: five Gauss points on small pieces in which C and τ are linear.
fn integrated(volume: &Volume, task: &Task<'_>, channel: usize) -> f64 {
    let length = task.subject.length().to_f64();
    let cell = length / (volume.field.len() - 1) as f64;
    let (mut radiance, mut depth) = (Sum::default(), Sum::default());
    for ends in volume.field.windows(2) {
        let (from, to) = (entry(volume, ends[0]), entry(volume, ends[1]));
        let (low, high) = (from.min(to), from.max(to));
        // Along the cell the place among the entries is linear: whole numbers are where it bends.
        let mut knots: Vec<f64> = (low.ceil() as u64..=high.floor() as u64)
            .map(|k| (k as f64 - from) / (to - from))
            .filter(|part| (0.0..1.0).contains(part))
            .collect();
        knots.push(0.0);
        knots.push(1.0);
        knots.sort_by(f64::total_cmp);
        for stretch in knots.windows(2) {
            let ends = [0, PIECES].map(|k| stretch[usize::from(k > 0)]);
            for piece in 0..PIECES {
                let part =
                    |k: u32| ends[0] + (ends[1] - ends[0]) * f64::from(k) / f64::from(PIECES);
                let ends = [part(piece), part(piece + 1)];
                let at = |part: f64| transfer(volume, channel, from + part * (to - from));
                let width = (ends[1] - ends[0]) * cell;
                let (light, adds) = gauss(at(ends[0]), at(ends[1]), width);
                radiance.add((-depth.value()).exp() * light);
                depth.add(adds);
            }
        }
    }
    radiance.value()
}

/// A sum that keeps what rounding takes from it.
#[derive(Default)]
struct Sum {
    sum: f64,
    lost: f64,
}

impl Sum {
    fn add(&mut self, term: f64) {
        let sum = self.sum + term;
        self.lost += if self.sum.abs() >= term.abs() {
            (self.sum - sum) + term
        } else {
            (term - sum) + self.sum
        };
        self.sum = sum;
    }

    fn value(&self) -> f64 {
        self.sum + self.lost
    }
}

/// The light and the depth of a piece between two (τ, C).
fn gauss(near: (f64, f64), far: (f64, f64), width: f64) -> (f64, f64) {
    let root = (10.0_f64 / 7.0).sqrt();
    let points = [(5.0 - 2.0 * root, 13.0), (5.0 + 2.0 * root, -13.0)];
    let mut rule = vec![(0.0, 128.0 / 225.0)];
    for (under, sign) in points {
        let (x, weight) = (under.sqrt() / 3.0, (322.0 + sign * 70_f64.sqrt()) / 900.0);
        rule.extend([(x, weight), (-x, weight)]);
    }
    let light = rule.into_iter().map(|(x, weight)| {
        let u = f64::midpoint(1.0, x);
        let extinction = near.0 + (far.0 - near.0) * u;
        let emission = near.1 + (far.1 - near.1) * u;
        let depth = width * u * f64::midpoint(near.0, extinction);
        weight / 2.0 * width * emission * extinction * (-depth).exp()
    });
    (light.sum(), width * f64::midpoint(near.0, far.0))
}

#[test]
fn along_the_ray_the_reference_is_the_radiance_of_the_volume_itself() {
    let subjects = subjects(&SMOOTH);
    let mut kernel = of_volume(claimed(2.0), integrated);
    let verification = run(&mut kernel, &subjects, &settings("8..128"));
    for line in &verification.lines {
        let exact = line.exact.to_f64();
        for sample in samples(line) {
            let error = sample.error.to_f64().abs();
            assert!(error < 1e-13 * exact.abs(), "{}: {error:e}", line.name);
        }
        let verdict = line.measured.verdict();
        let at_the_floor = matches!(verdict, Verdict::FloorLimited | Verdict::Exact);
        assert!(at_the_floor, "{}", shown(&verification));
        assert_eq!(line.standing, Standing::Inconclusive, "{}", line.name);
    }
    // A coarse volume of a field that is not linear is another medium than the case.
    let moved = |line: &&Line| {
        let mut cases = subjects.iter().flat_map(Subject::cases);
        let case = cases.find(|case| case.name() == line.name).unwrap();
        let exact = reference::radiance(case, 100).unwrap();
        (line.exact.to_f64() / exact.value.to_f64() - 1.0).abs() > 1e-4
    };
    let others = verification.lines.iter().filter(moved).count();
    assert_eq!(others, 4, "decaying-field and the channels of rgb-transfer");
}

/// With more entries than usual, and up to fewer segments: the kinks of entries show as a drift that grows at finer levels.
#[test]
fn samples_of_a_volume_have_the_order_of_their_place() {
    let subjects = subjects(&SMOOTH);
    let settings = Settings {
        entries: 4096,
        ..settings("8..256")
    };
    for (at, order, method) in [
        (0.5, 2.0, "front-to-back/middle/expm1"),
        (0.0, 1.0, "front-to-back/front/expm1"),
    ] {
        let march = move |volume: &Volume, task: &Task<'_>, channel: usize| {
            march(volume, task, channel, at, linear)
        };
        for declaration in [claimed(order), super::declared(method)] {
            let mut kernel = of_volume(declaration, march);
            let verification = run(&mut kernel, &subjects, &settings);
            let shown = shown(&verification);
            assert!(part(&verification, Standing::Confirmed) > 0.6, "{shown}");
            assert_eq!(verification.conclusion(), Conclusion::Confirmed, "{shown}");
            assert_eq!(verification.findings, [], "{shown}");
            assert!(!verification.deviates(), "{shown}");
        }
        // The other order is refused; front samples show order 2 in two cases, here as along the ray itself.
        let mut kernel = of_volume(claimed(3.0 - order), march);
        let verification = run(&mut kernel, &subjects, &settings);
        let shown = shown(&verification);
        assert!(part(&verification, Standing::Confirmed) <= 0.2, "{shown}");
        assert_eq!(verification.conclusion(), Conclusion::NotConfirmed);
    }
}

/// Cases whose field is not linear along the ray.
const CURVED: [&str; 6] = [
    "decaying-field",
    "oscillating-field",
    "reciprocal",
    "reciprocal-square",
    "rgb-transfer",
    "square-root-field",
];

fn over_grids(kernel: &mut dyn Kernel, cases: &[&str]) -> Verification {
    let settings = Settings {
        axis: Axis::Grid,
        ..settings("8..256")
    };
    run(kernel, &subjects(cases), &settings)
}

#[test]
fn over_finer_grids_linear_interpolation_has_order_2() {
    let mut kernel = of_volume(claimed(2.0), middle);
    let verification = over_grids(&mut kernel, &CURVED);
    let shown = shown(&verification);
    assert!(part(&verification, Standing::Confirmed) > 0.8, "{shown}");
    assert_eq!(verification.conclusion(), Conclusion::Confirmed, "{shown}");
    assert!(verification.identification.is_none());
    for line in &verification.lines {
        let cells = samples(line).iter().map(|sample| sample.n.unwrap());
        assert_eq!(cells.collect::<Vec<u64>>(), [8, 16, 32, 64, 128, 256]);
    }
}

/// On a straight field every grid is exact, and what tables and step leave is neither order nor fault.
#[test]
fn over_grids_that_are_exact_nothing_is_contradicted() {
    let mut kernel = of_volume(claimed(2.0), middle);
    let verification = over_grids(
        &mut kernel,
        &["cloud", "emission-bump", "sine-squared", "thick"],
    );
    let shown = shown(&verification);
    assert_eq!(part(&verification, Standing::Inconclusive), 1.0, "{shown}");
}

/// The point before, where the nearest one would do: steps of the field, of order 1.
#[test]
fn over_finer_grids_the_point_before_has_order_1() {
    let before = |values: &[f64], place: f64| values[place as usize];
    let mut kernel = of_volume(claimed(2.0), move |volume, task, channel| {
        assert_eq!(task.segments, GRID_SEGMENTS);
        march(volume, task, channel, 0.5, before)
    });
    let verification = over_grids(&mut kernel, &CURVED);
    let shown = shown(&verification);
    assert_eq!(
        verification.conclusion(),
        Conclusion::NotConfirmed,
        "{shown}"
    );
    // On a symmetric ray such steps are trapezoids again.
    let confirmed = verification
        .lines
        .iter()
        .filter(|line| line.standing == Standing::Confirmed);
    let confirmed: Vec<&str> = confirmed.map(|line| &line.name[..]).collect();
    assert_eq!(confirmed, ["rgb-transfer/red"], "{shown}");
    assert!(part(&verification, Standing::Contradicted) > 0.6, "{shown}");
}

/// Steps around the points are integrated as trapezoids are: the nearest point has order 2 as well.
#[test]
fn over_finer_grids_the_nearest_point_has_order_2() {
    let nearest = |values: &[f64], place: f64| values[place.round() as usize];
    let mut kernel = of_volume(claimed(2.0), move |volume, task, channel| {
        march(volume, task, channel, 0.5, nearest)
    });
    let verification = over_grids(&mut kernel, &CURVED);
    let shown = shown(&verification);
    assert!(part(&verification, Standing::Confirmed) > 0.6, "{shown}");
}

#[test]
fn only_volumes_have_a_grid() {
    let mut kernel = Closure::segments("segments", |segments, channel| {
        composite(super::front(segments, channel))
    });
    let settings = Settings {
        axis: Axis::Grid,
        ..settings("8..64")
    };
    let subjects = subjects(&["cloud"]);
    let refused = verify(&mut kernel, &subjects, &settings, &Silent, &mut |_| ());
    let form = FormKind::Segments;
    assert_eq!(refused.unwrap_err(), VerifyError::Axis { form });
}

/// Samples in the middles of segments of a volume, and all that they add up to before a background.
#[derive(Debug)]
struct AllOfVolume(Declaration);

impl Kernel for AllOfVolume {
    fn declaration(&self) -> &Declaration {
        &self.0
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let Data::Volume(volume) = task.data else {
            panic!("a volume is asked for");
        };
        let length = task.subject.length().to_f64();
        let channels = task.subject.channels().len();
        let mut radiance = vec![0.0; channels];
        let (mut depth, mut weighted) = (0.0_f64, 0.0);
        for i in 0..task.segments {
            let lambda = (i as f64 + 0.5) * task.step;
            let cells = (volume.field.len() - 1) as f64;
            let place = entry(volume, linear(&volume.field, lambda / length * cells));
            let (extinction, _) = transfer(volume, 0, place);
            let weight = (-depth).exp() * -(-extinction * task.step).exp_m1();
            for (channel, sum) in radiance.iter_mut().enumerate() {
                *sum += weight * transfer(volume, channel, place).1;
            }
            weighted += weight * lambda;
            depth += extinction * task.step;
        }
        for (sum, behind) in radiance.iter_mut().zip(task.subject.background()) {
            *sum += (-depth).exp() * behind;
        }
        let float = |x: f64| Float::with_val(53, x);
        Ok(Rendering {
            radiance: radiance.into_iter().map(float).collect(),
            opacity: Some(float(-(-depth).exp_m1())),
            optical_depth: Some(float(depth)),
            expected_depth: Some(float(weighted)),
            ..Rendering::default()
        })
    }
}

#[test]
fn other_quantities_are_those_of_the_volume_too() {
    let subjects = subjects(&SMOOTH);
    let settings = Settings {
        entries: 4096,
        identify: Identify::Off,
        ..settings("8..256")
    };
    for declaration in [claimed(2.0), super::declared("front-to-back/middle/expm1")] {
        let mut kernel = AllOfVolume(Declaration {
            form: FormKind::Volume,
            background: true,
            answers: Quantity::ALL.to_vec(),
            ..declaration
        });
        let verification = run(&mut kernel, &subjects, &settings);
        let shown = shown(&verification);
        assert_eq!(verification.conclusion(), Conclusion::Confirmed, "{shown}");
        for quantity in Quantity::ALL {
            let standing = |standing: Standing| {
                let lines = verification.of(quantity);
                lines.filter(|line| line.standing == standing).count()
            };
            // Where τ is linear between grid points middles have no error of the depth.
            let linear = matches!(quantity, Quantity::Opacity | Quantity::OpticalDepth);
            let least = if linear { 2 } else { 4 };
            assert!(standing(Standing::Confirmed) >= least, "{quantity} {shown}");
            assert_eq!(standing(Standing::Contradicted), 0, "{quantity} {shown}");
        }
        // The field of this case is not linear: neither its depth nor its opacity is the volume's.
        let ray = &subjects[1];
        assert_eq!(ray.name(), "decaying-field");
        let of_case = reference::optical_depth(&ray.cases()[0], 100)
            .unwrap()
            .value;
        let mut depths = verification.of(Quantity::OpticalDepth);
        let line = depths
            .find(|line| line.name.starts_with("decaying-field"))
            .unwrap();
        assert!(
            (line.exact.to_f64() / of_case.to_f64() - 1.0).abs() > 1e-4,
            "{shown}"
        );
    }
}
