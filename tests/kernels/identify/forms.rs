//! Kernels that look wherever they like, as functions, as source code and through volumes: what is read off is what they
//! were written to do.

use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use volver::identify::rule::{Along, Count, LastStep, Lattice, Law, Place, Rule, Scheme, StopBy};
use volver::identify::{Budget, Identification, Lookup, Optics, identify};
use volver::kernel::{Closure, Data, Declaration, FormKind, Task, Volume};
use volver::symbolic::code::Language;

/// How a kernel cuts a ray: n, d and D.
#[derive(Clone, Copy)]
struct Ray {
    n: usize,
    d: f64,
    length: f64,
}

fn ray(task: &Task<'_>) -> Ray {
    Ray {
        n: usize::try_from(task.segments).unwrap(),
        d: task.step,
        length: task.subject.length().to_f64(),
    }
}

/// (λ, length) of samples.
type Samples = Vec<(f64, f64)>;

/// Front to back: `opacity` of τ and the length.
fn march(
    task: &Task<'_>,
    channel: usize,
    samples: &[(f64, f64)],
    opacity: impl Fn(f64, f64) -> f64,
) -> f64 {
    let mut emission = vec![0.0; task.subject.channels().len()];
    let (mut radiance, mut through) = (0.0, 1.0);
    for &(lambda, length) in samples {
        let tau = task.subject.at(lambda, &mut emission);
        let alpha = opacity(tau, length);
        radiance += through * alpha * emission[channel];
        through *= 1.0 - alpha;
    }
    radiance
}

fn beer(tau: f64, length: f64) -> f64 {
    -(-tau * length).exp_m1()
}

fn of_form(form: FormKind, radiance: impl FnMut(&Task<'_>, usize) -> f64 + Send) -> Identification {
    let declaration = Declaration {
        form,
        ..Declaration::new("a kernel that looks anywhere")
    };
    let mut kernel = Closure::new(declaration, radiance);
    identify(&mut kernel, Budget::default(), &mut |_| ())
}

/// What is found out of samples that follow Beer's law.
fn sampled(samples: impl Fn(Ray) -> Samples + Send) -> Identification {
    of_form(FormKind::Function, move |task, channel| {
        march(task, channel, &samples(ray(task)), beer)
    })
}

#[track_caller]
fn named(found: &Identification) -> &Rule {
    found.named().unwrap_or_else(|| {
        let failing: Vec<_> = found.hold_out.kinds.iter().filter(|k| !k.holds()).collect();
        panic!("{:?} {:?} {failing:?}", found.rule, found.not_identified)
    })
}

/// Samples by the law of Beer at these places.
#[track_caller]
fn assert_lattice(found: &Identification, lattice: Option<Lattice>) {
    let rule = named(found);
    assert_eq!(rule.lattice, lattice);
    assert_eq!(
        rule.scheme,
        Scheme::Sample {
            place: Place::Middle,
            law: Law::default()
        }
    );
}

const fn from_to(start: [f64; 2], end: [f64; 2], place: f64, count: Count) -> Lattice {
    let [part, length] = start;
    let start = Along { part, length };
    let [part, length] = end;
    let end = Along { part, length };
    Lattice::Even {
        place,
        start,
        end,
        count,
    }
}

const EACH: Count = Count { each: 1, more: 0 };

/// N samples at the part `place` of even parts from `start` to `end`.
fn even(start: f64, end: f64, count: usize, place: f64) -> Samples {
    let h = (end - start) / count as f64;
    (0..count)
        .map(|k| (start + (k as f64 + place) * h, h))
        .collect()
}

/// Segments of the step, the last one shorter, sampled at that part of their own length.
fn own(ray: Ray, place: f64) -> Samples {
    (0..ray.n)
        .map(|k| {
            let from = k as f64 * ray.d;
            let long = (ray.length - from).min(ray.d);
            (from + place * long, long)
        })
        .collect()
}

#[test]
fn functions_sampled_at_nodes_are_read_as_segments_are() {
    for (place, part) in [
        (Place::Front, 0.0),
        (Place::Middle, 0.5),
        (Place::Back, 1.0),
    ] {
        let found = sampled(move |ray| own(ray, part));
        let rule = named(&found);
        assert_eq!(rule.lattice, None);
        let law = Law::default();
        assert_eq!(rule.scheme, Scheme::Sample { place, law });
        assert_eq!(rule.sequence.last_step, LastStep::Own);
    }
}

#[test]
fn several_values_of_a_function_are_read_as_those_of_segments() {
    let found = of_form(FormKind::Function, |task, channel| {
        let ray = ray(task);
        let mut emission = vec![0.0; task.subject.channels().len()];
        let (mut radiance, mut depth) = (0.0, 0.0_f64);
        for (from, long) in own(ray, 0.0) {
            let near = task.subject.at(from, &mut emission);
            let bright = emission[channel];
            let far = task.subject.at(from + long, &mut emission);
            let x = long * (near + far) / 2.0;
            let (before, after) = ((-depth).exp(), (-depth - x).exp());
            radiance += long / 2.0 * (near * bright * before + far * emission[channel] * after);
            depth += x;
        }
        radiance
    });
    let rule = named(&found);
    assert_eq!(rule.lattice, None);
    assert!(matches!(rule.scheme, Scheme::Segments { .. }), "{rule:?}");
}

#[test]
fn a_march_from_one_place_to_another_is_read_with_both() {
    let offset = sampled(|ray| even(0.02 * ray.length, ray.length, ray.n, 0.5));
    assert_lattice(&offset, Some(from_to([0.02, 0.0], [1.0, 0.0], 0.5, EACH)));
    let clipped = sampled(|ray| even(0.0, 0.9 * ray.length, ray.n, 0.5));
    assert_lattice(&clipped, Some(from_to([0.0, 0.0], [0.9, 0.0], 0.5, EACH)));
    let both = sampled(|ray| even(0.01, ray.length - 0.025, ray.n, 0.25));
    assert_lattice(&both, Some(from_to([0.0, 0.01], [1.0, -0.025], 0.25, EACH)));
}

#[test]
fn numbers_of_samples_that_do_not_follow_the_step_are_read() {
    let count = Count { each: 0, more: 64 };
    let fixed = sampled(|ray| even(0.0, ray.length, 64, 0.5));
    assert_lattice(&fixed, Some(from_to([0.0; 2], [1.0, 0.0], 0.5, count)));
    let count = Count { each: 0, more: 20 };
    let few = sampled(|ray| even(0.1 * ray.length, ray.length, 20, 0.0));
    assert_lattice(&few, Some(from_to([0.1, 0.0], [1.0, 0.0], 0.0, count)));
    let count = Count { each: 2, more: 0 };
    let twice = sampled(|ray| even(0.0, ray.length, 2 * ray.n, 0.5));
    assert_lattice(&twice, Some(from_to([0.0; 2], [1.0, 0.0], 0.5, count)));
    let count = Count { each: 1, more: 1 };
    let more = sampled(|ray| even(0.0, ray.length, ray.n + 1, 0.5));
    assert_lattice(&more, Some(from_to([0.0; 2], [1.0, 0.0], 0.5, count)));
}

#[test]
fn places_inside_of_segments_are_read() {
    for place in [0.3, 0.125, 0.9, 1.0 / 3.0] {
        let found = sampled(move |ray| own(ray, place));
        let own_last = true;
        assert_lattice(&found, Some(Lattice::Steps { place, own_last }));
        assert_eq!(named(&found).sequence.last_step, LastStep::Own);
    }
}

#[test]
fn a_last_step_behind_the_ray_is_told_from_one_that_is_shorter_and_from_even_ones() {
    let over = sampled(|ray| {
        let at = |k: usize| (((k as f64 + 0.5) * ray.d).min(ray.length), ray.d);
        (0..ray.n).map(at).collect()
    });
    let (place, own_last) = (0.5, false);
    assert_lattice(&over, Some(Lattice::Steps { place, own_last }));
    assert_eq!(named(&over).sequence.last_step, LastStep::Whole);
    let even = sampled(|ray| even(0.0, ray.length, ray.n, 0.5));
    assert_lattice(&even, Some(Lattice::even(0.5)));
}

#[test]
fn laws_and_ends_are_read_wherever_samples_lie() {
    let found = of_form(FormKind::Function, |task, channel| {
        let samples = own(ray(task), 0.3);
        march(task, channel, &samples, |tau, length| {
            beer(1.5 * tau, length)
        })
    });
    let Scheme::Sample { law, .. } = &named(&found).scheme else {
        panic!("{:?}", found.rule)
    };
    assert_eq!(law.depth.factor, 1.5);

    let found = of_form(FormKind::Function, |task, channel| {
        let ray = ray(task);
        let mut emission = vec![0.0; task.subject.channels().len()];
        let (mut radiance, mut through) = (0.0, 1.0);
        for (lambda, length) in even(0.1 * ray.length, ray.length, ray.n, 0.5) {
            let alpha = beer(task.subject.at(lambda, &mut emission), length);
            radiance += through * alpha * emission[channel];
            through *= 1.0 - alpha;
            if through < 0.01 {
                break;
            }
        }
        radiance
    });
    let rule = named(&found);
    let stop = rule.stop.unwrap();
    assert_eq!((stop.by, stop.under), (StopBy::Transmittance, 0.01));
    assert_eq!(
        rule.lattice,
        Some(from_to([0.1, 0.0], [1.0, 0.0], 0.5, EACH))
    );
}

#[test]
fn samples_that_are_missing_are_read_wherever_they_lie() {
    let last = sampled(|ray| {
        let mut samples = own(ray, 0.3);
        samples.pop();
        samples
    });
    let rule = named(&last);
    let (place, own_last) = (0.3, true);
    assert_eq!(rule.lattice, Some(Lattice::Steps { place, own_last }));
    let order = rule.sequence.order(4, false, false);
    assert_eq!(order, [0, 1, 2]);
    let first = sampled(|ray| own(ray, 0.3).split_off(1));
    let order = named(&first).sequence.order(4, false, false);
    assert_eq!(order, [1, 2, 3]);
}

#[test]
fn places_in_binary32_are_no_other_places() {
    // λ, τ and C as a program in binary32 has them.
    let narrow = |place: f32| {
        of_form(FormKind::Function, move |task, channel| {
            let ray = ray(task);
            let mut emission = vec![0.0; task.subject.channels().len()];
            let (mut radiance, mut through) = (0.0_f32, 1.0_f32);
            let d = ray.length as f32 / ray.n as f32;
            for k in 0..ray.n {
                let lambda = (k as f32 + place) * d;
                let tau = task.subject.at(f64::from(lambda), &mut emission) as f32;
                let alpha = -(-tau * d).exp_m1();
                radiance += through * alpha * emission[channel] as f32;
                through *= 1.0 - alpha;
            }
            f64::from(radiance)
        })
    };
    assert_lattice(&narrow(0.5), Some(Lattice::even(0.5)));
    assert_lattice(&narrow(0.3), Some(Lattice::even(0.3)));
}

/// Nothing is named, and the rows hold the truth.
#[track_caller]
fn assert_table(found: &Identification, truth: impl Fn(Ray) -> Samples) {
    assert!(found.named().is_none(), "{:?}", found.rule);
    let table = found.not_identified.first().unwrap();
    assert_eq!(table.columns[3], "place", "{table:?}");
    let row = table.rows.first().unwrap();
    let ray = Ray {
        n: row[0] as usize,
        d: row[2],
        length: row[1],
    };
    let mut want: Vec<f64> = truth(ray).iter().map(|(at, _)| *at).collect();
    want.sort_by(f64::total_cmp);
    for (row, want) in table.rows.iter().zip(&want) {
        assert!((row[3] - want).abs() < 1e-12, "{row:?} {want}");
    }
    assert!(table.rows.len() > want.len());
}

#[test]
fn places_of_no_formula_are_given_as_a_table() {
    let gauss = |ray: Ray| -> Samples {
        let half = 0.5 / 3.0_f64.sqrt();
        let pair = |(from, long): (f64, f64)| {
            [0.5 - half, 0.5 + half].map(|part| (from + part * long, long / 2.0))
        };
        own(ray, 0.0).into_iter().flat_map(pair).collect()
    };
    assert_table(&sampled(gauss), gauss);
    let squares = |ray: Ray| -> Samples {
        let end = |k: usize| ray.length * (k as f64 / ray.n as f64).powi(2);
        let at = |k: usize| (f64::midpoint(end(k), end(k + 1)), end(k + 1) - end(k));
        (0..ray.n).map(at).collect()
    };
    assert_table(&sampled(squares), squares);
    let irregular = |ray: Ray| -> Samples {
        let part = |k: usize| (0.1 + k as f64 * 0.618_033_988_749_895).fract();
        let at = |k: usize| ((k as f64 + part(k)) * ray.length / ray.n as f64, ray.d);
        (0..ray.n).map(at).collect()
    };
    assert_table(&sampled(irregular), irregular);
}

#[test]
fn what_holds_on_few_segments_alone_is_not_named() {
    let odd = sampled(|ray| own(ray, if ray.n > 30 && ray.n < 60 { 0.45 } else { 0.3 }));
    assert!(odd.named().is_none());
    assert!(!odd.hold_out.misses.is_empty());
    let dense = sampled(|ray| even(0.0, ray.length, 4096, 0.5));
    assert!(dense.named().is_none() && dense.rule.is_none());
    let seen = sampled(|ray| {
        // A threshold of λ itself.
        let samples = own(ray, 0.3);
        samples.into_iter().filter(|(at, _)| *at < 3.7).collect()
    });
    assert!(seen.named().is_none());
}

/// What code says of field values, by the program that `run` makes of it.
fn of_code(language: Language, code: &str, folder: &std::path::Path, at: &[f64]) -> Vec<[f64; 2]> {
    let (name, main) = match language {
        Language::Python => (
            "probe.py",
            "\nimport sys\nfor x in sys.argv[1:]:\n    s = field(float(x))\n    print(repr(extinction(s)), repr(emission_c1(s)))\n",
        ),
        Language::C => (
            "probe.c",
            "\n#include <stdio.h>\n#include <stdlib.h>\nint main(int n, char **of) {\n    for (int i = 1; i < n; i++) {\n        double s = field(atof(of[i]));\n        printf(\"%.17g %.17g\\n\", extinction(s), emission_c1(s));\n    }\n}\n",
        ),
        Language::Rust => (
            "probe.rs",
            "\nfn main() {\n    for x in std::env::args().skip(1) {\n        let s = field(x.parse().unwrap());\n        println!(\"{:?} {:?}\", extinction(s), emission_c1(s));\n    }\n}\n",
        ),
    };
    let (source, program) = (folder.join(name), folder.join("probe"));
    std::fs::write(&source, format!("{code}{main}")).unwrap();
    let compiler = match language {
        Language::Python => None,
        Language::C => Some(vec!["cc", "-Wall", "-Werror"]),
        Language::Rust => Some(vec!["rustc", "--edition", "2021"]),
    };
    let mut run = match compiler {
        None => {
            let mut run = Command::new("python3");
            run.arg(&source);
            run
        }
        Some(words) => {
            let mut compile = Command::new(words[0]);
            compile
                .args(&words[1..])
                .arg(&source)
                .arg("-o")
                .arg(&program);
            let compiled = compile.output().unwrap();
            assert!(compiled.status.success(), "{compiled:?}");
            Command::new(&program)
        }
    };
    let said = run
        .args(at.iter().map(|x| format!("{x:?}")))
        .output()
        .unwrap();
    let said = String::from_utf8(said.stdout).unwrap();
    let number = |text: &str| text.parse::<f64>().unwrap();
    said.lines()
        .map(|line| {
            let (tau, c) = line.split_once(' ').unwrap();
            [number(tau), number(c)]
        })
        .collect()
}

#[test]
fn source_code_says_what_the_function_says_in_every_language() {
    for language in Language::ALL {
        let folder = tempfile::tempdir().unwrap();
        let compared = AtomicUsize::new(0);
        let found = of_form(FormKind::Formula(language), |task, channel| {
            let Data::Formula(formula) = task.data else {
                panic!("{:?}", task.data)
            };
            let channels = task.subject.channels().len();
            // The first rays of random media, and one of the law's.
            let turn = compared.fetch_add(usize::from(channel == 0), Ordering::Relaxed);
            if channel == 0 && channels > 1 && [0, 1, 30].contains(&turn) {
                let length = task.subject.length().to_f64();
                let at: Vec<f64> = (-2..40).map(|k| f64::from(k) * length / 37.0).collect();
                let said = of_code(language, &formula.code, folder.path(), &at);
                assert_eq!(said.len(), at.len());
                let mut emission = vec![0.0; channels];
                for (x, [tau, c]) in at.iter().zip(said) {
                    assert_eq!(tau, task.subject.at(*x, &mut emission));
                    assert_eq!(c, emission[1]);
                }
            }
            march(task, channel, &own(ray(task), 0.5), beer)
        });
        let rule = named(&found);
        let law = Law::default();
        let place = Place::Middle;
        assert_eq!(rule.scheme, Scheme::Sample { place, law });
        assert!(compared.load(Ordering::Relaxed) > 30);
    }
}

/// A renderer of volumes as it may be written.
#[derive(Clone, Copy)]
struct Renderer {
    place: f64,
    nearest_entry: bool,
    nearest_point: bool,
    /// The texture's coordinate u is taken for that of texel centres.
    texels: bool,
    /// In entries.
    shift: f64,
    /// Cells that the ray is longer at both ends.
    longer: f64,
}

const RENDERER: Renderer = Renderer {
    place: 0.5,
    nearest_entry: false,
    nearest_point: false,
    texels: false,
    shift: 0.0,
    longer: 0.0,
};

fn pick(values: &[f64], at: f64, nearest: bool) -> f64 {
    let last = values.len() - 1;
    let at = at.clamp(0.0, last as f64);
    if nearest {
        return values[((at + 0.5).floor() as usize).min(last)];
    }
    let i = (at as usize).min(last.saturating_sub(1));
    let j = (i + 1).min(last);
    values[i] * (1.0 - (at - i as f64)) + values[j] * (at - i as f64)
}

impl Renderer {
    fn of(self, task: &Task<'_>, channel: usize) -> f64 {
        let Data::Volume(Volume { field, table }) = task.data else {
            panic!("{:?}", task.data)
        };
        let ray = ray(task);
        let cells = (field.len() - 1) as f64;
        let before = self.longer * ray.length / cells;
        let d = (ray.length + 2.0 * before) / ray.n as f64;
        let (mut radiance, mut through) = (0.0, 1.0);
        for k in 0..ray.n {
            let lambda = (k as f64 + self.place) * d - before;
            let s = pick(field, lambda / ray.length * cells, self.nearest_point);
            let u = (s - table.first) / (table.last - table.first);
            let size = table.extinction.len() as f64;
            let at = if self.texels {
                u * size - 0.5
            } else {
                u * (size - 1.0) + self.shift
            };
            let alpha = beer(pick(&table.extinction, at, self.nearest_entry), d);
            radiance += through * alpha * pick(&table.emission[channel], at, self.nearest_entry);
            through *= 1.0 - alpha;
        }
        radiance
    }

    fn found(self) -> Identification {
        of_form(FormKind::Volume, move |task, channel| {
            self.of(task, channel)
        })
    }
}

#[test]
fn shifts_of_samples_grid_and_table_are_read_of_a_volume() {
    let plain = Optics {
        lattice: Lattice::even(0.5),
        ..Optics::default()
    };
    let place = |place: f64| Optics {
        lattice: Lattice::even(place),
        ..plain
    };
    let cases = [
        (RENDERER, plain),
        (
            Renderer {
                place: 0.0,
                ..RENDERER
            },
            place(0.0),
        ),
        (
            Renderer {
                place: 0.3,
                ..RENDERER
            },
            place(0.3),
        ),
        (
            Renderer {
                texels: true,
                ..RENDERER
            },
            Optics {
                intervals: 1.0,
                shift: -0.5,
                ..plain
            },
        ),
        (
            Renderer {
                shift: 0.5,
                ..RENDERER
            },
            Optics {
                shift: 0.5,
                ..plain
            },
        ),
        (
            Renderer {
                longer: 0.5,
                ..RENDERER
            },
            Optics {
                cells: [-0.5, 0.5],
                ..plain
            },
        ),
        (
            Renderer {
                nearest_entry: true,
                ..RENDERER
            },
            Optics {
                table: Lookup::Nearest,
                ..plain
            },
        ),
        (
            Renderer {
                nearest_point: true,
                place: 0.25,
                ..RENDERER
            },
            Optics {
                field: Lookup::Nearest,
                ..place(0.25)
            },
        ),
        (
            Renderer {
                nearest_point: true,
                nearest_entry: true,
                ..RENDERER
            },
            Optics {
                field: Lookup::Nearest,
                table: Lookup::Nearest,
                ..plain
            },
        ),
    ];
    for (renderer, optics) in cases {
        let found = renderer.found();
        named(&found);
        assert_eq!(found.optics, Some(optics));
    }
}

#[test]
fn laws_are_read_through_volumes() {
    let found = of_form(FormKind::Volume, |task, channel| {
        let found = RENDERER.of(task, channel);
        2.0 * found
    });
    let Scheme::Sample { law, .. } = &named(&found).scheme else {
        panic!("{:?}", found.rule)
    };
    assert_eq!(law.scale.0, 2.0);
}

#[test]
fn volumes_read_in_no_known_way_have_no_name() {
    // Cubic between entries, and a place that depends on the grid.
    let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
    let cubic = of_form(FormKind::Volume, move |task, channel| {
        let Data::Volume(Volume { field, table }) = task.data else {
            panic!("{:?}", task.data)
        };
        let ray = ray(task);
        let (mut radiance, mut through) = (0.0, 1.0);
        for k in 0..ray.n {
            let part = (k as f64 + 0.5) / ray.n as f64;
            let s = pick(field, part * (field.len() - 1) as f64, false);
            let u = (s - table.first) / (table.last - table.first);
            let at = u * (table.extinction.len() - 1) as f64;
            let at = at.floor() + smooth(at.fract());
            let alpha = beer(
                pick(&table.extinction, at, false),
                ray.length / ray.n as f64,
            );
            radiance += through * alpha * pick(&table.emission[channel], at, false);
            through *= 1.0 - alpha;
        }
        radiance
    });
    assert!(cubic.named().is_none());
    let odd = of_form(FormKind::Volume, |task, channel| {
        let Data::Volume(volume) = task.data else {
            panic!("{:?}", task.data)
        };
        let place = if volume.cells() % 5 == 3 { 0.4 } else { 0.5 };
        Renderer { place, ..RENDERER }.of(task, channel)
    });
    assert!(odd.named().is_none());
    let many = of_form(FormKind::Volume, |task, channel| {
        let place = if ray(task).n > 50 { 0.51 } else { 0.5 };
        Renderer { place, ..RENDERER }.of(task, channel)
    });
    assert!(many.named().is_none());
}

#[test]
fn places_are_said_as_formulas() {
    let text = from_to([0.02, 0.0], [1.0, -0.5], 0.5, Count { each: 2, more: -1 }).to_string();
    assert_eq!(
        text,
        "λₖ = 0.02 D + (k + 0.5) h, h = (D − 0.5 − (0.02 D))/(2 n − 1)"
    );
    assert_eq!(Lattice::even(0.0).to_string(), "λₖ = k h, h = D/n");
    let (place, own_last) = (0.3, false);
    let steps = Lattice::Steps { place, own_last };
    assert_eq!(steps.to_string(), "λₖ = (k + 0.3) d, at most D");
    let optics = Optics {
        lattice: Lattice::even(0.5),
        cells: [-0.5, 0.5],
        field: Lookup::Nearest,
        intervals: 1.0,
        shift: -0.5,
        ..Optics::default()
    };
    assert_eq!(
        optics.to_string(),
        "λₖ = (k + 0.5) h, h = D/n, from -0.5 to 0.5 cells behind these ends; grid nearest; table linear, entry (s − first)/\
         (last − first) E − 0.5"
    );
}
