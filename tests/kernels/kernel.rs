//! Tasks, and what becomes kernels in this program: methods and closures.

use rug::{Float, Rational};
use volver::case::{Fresh, Nodes, SineSquared, catalogue, manufacture::manufacture};
use volver::kernel::{
    BuiltIn, Closure, Cut, CutError, Data, Declaration, FormKind, Kernel, KernelError, Spacing,
    Subject, Task,
};
use volver::method::Method;
use volver::real::{FormatName, Mpfr, Native, Real};

fn subject(name: &str) -> Subject {
    let description = catalogue::find(name).unwrap().unwrap();
    let channels = manufacture(&description).unwrap();
    let channels = channels.into_iter().map(|c| (c.channel, c.case)).collect();
    Subject::new(name, channels).unwrap()
}

#[test]
fn segments_have_the_values_that_methods_see() {
    let subject = subject("sine-squared");
    let segments = subject.segments(Cut::Segments(6)).unwrap();
    let nodes = Fresh::new(&subject.cases()[0], Native::<f64>::new());
    let boundaries = nodes.boundaries(6);
    assert_eq!(segments.edges.extinction, boundaries.extinction);
    assert_eq!(segments.edges.emission[0], boundaries.emission);
    let middles = nodes.interior(6, &Rational::from((1, 2)));
    assert_eq!(segments.middles.extinction, middles.extinction);
    assert_eq!(segments.count(), 6);
    // The same medium written by hand.
    let by_hand = Fresh::new(&SineSquared, Native::<f64>::new()).boundaries(6);
    for (a, b) in segments.edges.extinction.iter().zip(&by_hand.extinction) {
        assert!((a - b).abs() < 1e-15);
    }
}

/// A spacing, and what is even in it.
type Map = (&'static str, fn(f64) -> f64);

#[test]
fn uneven_segments_lie_as_their_names_say() {
    let subject = subject("homogeneous");
    let length = 2.0;
    let edges = |n, name: &str| {
        let spacing: Spacing = name.parse().unwrap();
        assert_eq!(spacing.to_string(), name);
        let cut = Cut::Spaced(n, spacing);
        let segments = subject.segments(cut).unwrap();
        assert_eq!(
            segments,
            subject.segments_between(segments.edges.lambda.clone())
        );
        segments.edges.lambda
    };
    let maps: [Map; 3] = [
        ("square", |part| part.sqrt()),
        ("log", |part| (1.0 + 99.0 * part).ln() / 100_f64.ln()),
        ("disparity", |part| {
            10.0 / 9.0 * (1.0 - 1.0 / (1.0 + 9.0 * part))
        }),
    ];
    for (name, even) in maps {
        let edges = edges(7, name);
        assert_eq!((edges[0], edges[7]), (0.0, length));
        for (i, edge) in edges.iter().enumerate() {
            let u = even(edge / length);
            assert!((u - i as f64 / 7.0).abs() < 1e-14, "{name}: {u} at {i}");
        }
    }
    let random = edges(21, "random:5");
    let lengths: Vec<f64> = random.windows(2).map(|ends| ends[1] - ends[0]).collect();
    assert_eq!((random[0], random[21]), (0.0, length));
    for (a, b) in lengths.iter().zip(&lengths[3..]) {
        assert!((a - b).abs() < 1e-14);
    }
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    let shortest = lengths.iter().copied().fold(1.0, f64::min);
    assert!(shortest < 0.95 * longest && longest < 9.0 * shortest);
    assert_ne!(random, edges(21, "random:6"));
    for wrong in [
        "",
        "even ",
        "random",
        "random:",
        "random:-1",
        "random:1.5",
        "logs",
    ] {
        wrong.parse::<Spacing>().unwrap_err();
    }
}

#[test]
fn the_last_segment_is_shorter_where_the_step_does_not_divide_the_ray() {
    let subject = subject("homogeneous");
    let segments = subject.segments(Cut::Step(0.75)).unwrap();
    assert_eq!(segments.edges.lambda, [0.0, 0.75, 1.5, 2.0]);
    assert_eq!(segments.middles.lambda, [0.375, 1.125, 1.75]);
    assert_eq!(segments.lengths().collect::<Vec<_>>(), [0.75, 0.75, 0.5]);
    let whole = subject.segments(Cut::Step(0.5)).unwrap();
    assert_eq!(whole, subject.segments(Cut::Segments(4)).unwrap());
    for (cut, error) in [
        (Cut::Segments(0), CutError::Segments { segments: 0.0 }),
        (Cut::Step(-1.0), CutError::Step { step: -1.0 }),
        (
            Cut::Step(1e-30),
            CutError::Segments {
                segments: u64::MAX as f64,
            },
        ),
    ] {
        assert_eq!(subject.segments(cut), Err(error));
    }
}

#[test]
fn volumes_and_tables_hold_the_field_and_the_transfer_functions() {
    let subject = subject("rgb-transfer");
    let volume = subject.volume(4, 3);
    let places = [0.0, 0.25, 0.5, 0.75, 1.0];
    assert_eq!(volume.field, places.map(|lambda| subject.field(lambda)));
    let table = &volume.table;
    assert_eq!((table.extinction.len(), table.emission.len()), (3, 3));
    assert_eq!(table.emission[2].len(), 3);
    let mut emission = [0.0; 3];
    let s = table.first * 0.5 + table.last * 0.5;
    assert_eq!(table.extinction[1], subject.of_field(s, &mut emission));
    assert_eq!(table.emission[2][1], emission[2]);
    assert!(
        volume
            .field
            .iter()
            .all(|s| (table.first..=table.last).contains(s))
    );
}

#[test]
fn methods_are_kernels_in_any_format() {
    let subject = subject("rgb-transfer");
    let method: Method = "trapezoid/trapezoid".parse().unwrap();
    let mut kernel = BuiltIn::new(method, FormatName::Mpfr(200));
    let task = |step| Task {
        subject: &subject,
        step,
        segments: 8,
        seed: 0,
        data: Data::Function,
    };
    let rendering = kernel.render(&task(0.125)).unwrap();
    assert_eq!(rendering.radiance.len(), 3);
    assert_eq!(rendering.step, None);
    let nodes = Fresh::new(&subject.cases()[1], Mpfr { bits: 200 });
    let green = method.radiance(&nodes, 8).unwrap();
    assert_eq!(rendering.radiance[1], green.to_float());
    // A step that does not divide the ray is not the one used.
    assert_eq!(kernel.render(&task(0.13)).unwrap().step, Some(0.125));
}

#[test]
fn closures_are_kernels_of_the_form_they_declare() {
    let subject = subject("homogeneous");
    let segments = subject.segments(Cut::Segments(4)).unwrap();
    let mut kernel = Closure::new(Declaration::new("mine"), |task, _| {
        task.cut().map_or(f64::NAN, |s| s.lengths().sum())
    });
    let mut task = Task {
        subject: &subject,
        step: 0.5,
        segments: 4,
        seed: 0,
        data: Data::Segments(&segments),
    };
    assert_eq!(
        kernel.render(&task).unwrap().radiance,
        [Float::with_val(53, 2)]
    );
    task.data = Data::Function;
    let wanted = FormKind::Segments;
    let given = FormKind::Function;
    assert_eq!(
        kernel.render(&task),
        Err(KernelError::Form { given, wanted })
    );
}

#[test]
fn monte_carlo_draws_by_the_seed_of_the_task() {
    let subject = subject("sine-squared");
    let mut kernel = BuiltIn::new("monte-carlo@5/trapezoid".parse().unwrap(), FormatName::F64);
    assert!(kernel.declaration().stochastic);
    let mut render = |seed| {
        let task = Task {
            subject: &subject,
            step: 0.125,
            segments: 8,
            seed,
            data: Data::Function,
        };
        kernel.render(&task).unwrap().radiance
    };
    let (first, second) = (render(0), render(1));
    assert_ne!(first, second);
    assert_eq!(render(0), first);
}
