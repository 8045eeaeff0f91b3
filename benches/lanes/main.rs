//! Rays in lanes of every width that the processor has, beside the same in C, one ray after the other; one ray of a medium by
//! formulas; replicas of random samples beside the library's own run of each; and compositing of given samples beside C with
//! eight rays side by side.
//!
//! `lanes.c` is compiled here by `cc -O3 -march=native`. Answers are compared first; then all are timed in turn, by the
//! processor's clock of this thread.

#![allow(missing_docs, unsafe_code, clippy::expect_used, clippy::inline_always)]

use libloading::Library;
use volver::case::manufacture::manufacture;
use volver::case::{Case, Fresh, SineSquared, Transfer, catalogue};
use volver::method::{Method, RayMedium, composite_given, drawn_radiances, radiances};
use volver::real::Native;
use volver::real::lanes::{LaneFloat, LaneFormat, Lanes, Width};
use volver_benches::{Compared, compiled, seconds};

/// Rays, and segments of each.
const RAYS: usize = 256;
const SEGMENTS: usize = 512;
/// Random samples; n² of them where they are independent.
const INDEPENDENT: &str = "monte-carlo-independent";
const FEW: usize = 64;
const SAMPLINGS: [&str; 3] = ["monte-carlo", "monte-carlo-stratified", INDEPENDENT];
/// Segments of one ray.
const LONG: u64 = 1 << 18;
/// Samples of each of eight rays: in the caches, and beyond the last.
const IN_CACHE: usize = 1 << 10;
const BEYOND: usize = 1 << 23;
/// Functions of two libraries, units in the last place apart.
const SAME_64: f64 = 1e-13;
const SAME_32: f64 = 1e-4;

struct Medium<T>(Vec<T>);

impl<T: LaneFloat> RayMedium<T> for Medium<T> {
    #[inline(always)]
    fn transfer<L: Lanes<Element = T>>(&self, ray: usize, s: L) -> Transfer<L> {
        let (sin, cos) = Lanes::sin_cos(s * s);
        Transfer {
            emission: sin,
            extinction: (s + s.load(&self.0[ray..])) * cos + s.all(T::ONE),
        }
    }
}

fn main() {
    let folder = tempfile::tempdir().expect("a folder");
    let library = compiled("lanes/lanes.c", folder.path());
    println!(
        "what                                        width   ns a sample, and of its peer; ratio (quartiles)"
    );
    many_rays(&library);
    one_ray(&library);
    replicas::<f64>();
    replicas::<f32>();
    given(&library);
}

fn many_rays(library: &Library) {
    let method: Method = "trapezoid/trapezoid".parse().expect("a method");
    let samples = RAYS * (SEGMENTS + 1);
    let n = SEGMENTS as u64;
    // SAFETY: lanes.c has functions of these names and types, and `library` outlives them.
    let (in_c64, in_c32) = unsafe {
        (
            library.get::<extern "C" fn(*const f64, *mut f64, usize, usize)>(b"rays64"),
            library.get::<extern "C" fn(*const f32, *mut f32, usize, usize)>(b"rays32"),
        )
    };
    let (in_c64, in_c32) = (in_c64.expect("rays64"), in_c32.expect("rays32"));
    let wide = Medium((0..RAYS).map(|r| r as f64 / 64.0).collect::<Vec<f64>>());
    let narrow = Medium((0..RAYS).map(|r| r as f32 / 64.0).collect::<Vec<f32>>());
    for width in Width::there() {
        width.choose().expect("a width");
        let ours = || radiances(&method, &wide, &1.into(), n, RAYS).expect("radiances");
        let theirs = || {
            let mut radiances = vec![0.0; RAYS];
            in_c64(wide.0.as_ptr(), radiances.as_mut_ptr(), RAYS, SEGMENTS);
            radiances
        };
        agree(&ours(), &theirs(), SAME_64);
        compare(
            "256 rays, binary64, of C one by one",
            width,
            samples,
            ours,
            theirs,
        );
        let ours = || radiances(&method, &narrow, &1.into(), n, RAYS).expect("radiances");
        let theirs = || {
            let mut radiances = vec![0.0_f32; RAYS];
            in_c32(narrow.0.as_ptr(), radiances.as_mut_ptr(), RAYS, SEGMENTS);
            radiances
        };
        let in_binary64 = |row: Vec<f32>| row.into_iter().map(f64::from).collect::<Vec<_>>();
        agree(&in_binary64(ours()), &in_binary64(theirs()), SAME_32);
        compare(
            "256 rays, binary32, of C one by one",
            width,
            samples,
            ours,
            theirs,
        );
    }
}

fn one_ray(library: &Library) {
    let Method::Nested(method) = "trapezoid/trapezoid".parse().expect("a method") else {
        return;
    };
    let description = catalogue::find("sine-squared").expect("a case");
    let made = manufacture(&description.expect("a case")).expect("a case");
    let symbolic = &made.first().expect("a channel").case;
    // SAFETY: as above.
    let in_c = unsafe { library.get::<extern "C" fn(usize) -> f64>(b"ray64") };
    let in_c = in_c.expect("ray64");
    let samples = usize::try_from(LONG).expect("a size");
    let theirs = || in_c(samples);
    let scalar = || {
        let nodes = Fresh::new(symbolic, Native::<f64>::new());
        method.radiance(&nodes, LONG).expect("a radiance")
    };
    for width in Width::there() {
        width.choose().expect("a width");
        let ours = || {
            let nodes = Fresh::new(symbolic, LaneFormat::<f64>::new());
            method.radiance(&nodes, LONG).expect("a radiance").0
        };
        agree(&[ours()], &[theirs()], 1e-12);
        compare("one ray by formulas, of C", width, samples, ours, theirs);
        compare(
            "one ray by formulas, of f64's",
            width,
            samples,
            ours,
            scalar,
        );
    }
}

/// C = sin s², τ = s cos s², in every lane.
struct Sine;

impl<T: LaneFloat> RayMedium<T> for Sine {
    #[inline(always)]
    fn transfer<L: Lanes<Element = T>>(&self, _: usize, s: L) -> Transfer<L> {
        let (sin, cos) = Lanes::sin_cos(s * s);
        Transfer {
            emission: sin,
            extinction: s * cos,
        }
    }
}

/// Seeds 0 … [`RAYS`] − 1 side by side, of one after the other in the same format and in the native one.
fn replicas<T: LaneFloat>() {
    for sampling in SAMPLINGS {
        let method = |seed| -> Method {
            let name = format!("{sampling}@{seed}/trapezoid");
            name.parse().expect("a method")
        };
        let (n, samples) = if sampling == INDEPENDENT {
            (FEW, FEW * FEW)
        } else {
            (SEGMENTS, SEGMENTS)
        };
        let (n, samples) = (n as u64, RAYS * samples);
        let seeds: Vec<u64> = (0..RAYS as u64).collect();
        let length = SineSquared.length();
        let in_lanes = || {
            let nodes = Fresh::new(&SineSquared, LaneFormat::<T>::new());
            let alone = |&seed: &u64| method(seed).radiance(&nodes, n).expect("a radiance").0;
            seeds.iter().map(alone).collect::<Vec<T>>()
        };
        let native = || {
            let nodes = Fresh::new(&SineSquared, Native::<T>::new());
            let alone = |&seed: &u64| method(seed).radiance(&nodes, n).expect("a radiance");
            seeds.iter().map(alone).collect::<Vec<T>>()
        };
        for width in Width::there() {
            width.choose().expect("a width");
            let ours = || {
                drawn_radiances::<T, _>(&method(0), &Sine, &length, n, &seeds).expect("radiances")
            };
            assert_eq!(ours(), in_lanes(), "the same operations");
            let what = format!("{sampling}, {}, of ", Native::<T>::new());
            compare(
                &(what.clone() + "each alone"),
                width,
                samples,
                ours,
                in_lanes,
            );
            compare(&(what + "native"), width, samples, ours, native);
        }
    }
}

fn given(library: &Library) {
    // SAFETY: as above.
    let (in_c, reading) = unsafe {
        (
            library.get::<extern "C" fn(*const f64, *const f64, *mut f64, usize)>(b"given64"),
            library.get::<extern "C" fn(*const f64, *const f64, usize) -> f64>(b"reading64"),
        )
    };
    let (in_c, reading) = (in_c.expect("given64"), reading.expect("reading64"));
    for n in [IN_CACHE, BEYOND] {
        let sample = |i: usize, scale: f64| (i as f64 * 0.7).sin().abs() * scale;
        let colors: Vec<f64> = (0..8 * n).map(|i| sample(i, 1.0)).collect();
        let opacities: Vec<f64> = (0..8 * n).map(|i| sample(i + 5, 8.0 / n as f64)).collect();
        let theirs = || {
            let mut radiances = vec![0.0; 8];
            in_c(
                colors.as_ptr(),
                opacities.as_ptr(),
                radiances.as_mut_ptr(),
                n,
            );
            radiances
        };
        let only_read = || reading(colors.as_ptr(), opacities.as_ptr(), n);
        for width in Width::there() {
            width.choose().expect("a width");
            let ours = || composite_given(&colors, &opacities, 8, false).expect("radiances");
            assert_eq!(ours(), theirs(), "the same operations");
            let repeats = if n == IN_CACHE { 256 } else { 1 };
            let times = |work: &dyn Fn() -> f64| (0..repeats).map(|_| work()).sum::<f64>();
            let what = format!("8 × {n} given samples, of ");
            compare(
                &(what.clone() + "C"),
                width,
                8 * n * repeats,
                || times(&|| ours()[0]),
                || times(&|| theirs()[0]),
            );
            compare(
                &(what + "reading"),
                width,
                8 * n * repeats,
                || times(&|| ours()[0]),
                || times(&only_read),
            );
        }
    }
}

fn agree(ours: &[f64], theirs: &[f64], same: f64) {
    for (own, other) in ours.iter().zip(theirs) {
        assert!(
            (own - other).abs() <= same * other.abs(),
            "{own} and {other}"
        );
    }
}

fn compare<A, B>(
    what: &str,
    width: Width,
    samples: usize,
    ours: impl Fn() -> A,
    theirs: impl Fn() -> B,
) {
    let Compared { own, other, ratio } = Compared::new(|| seconds(&ours), || seconds(&theirs));
    let [low, ratio, high] = ratio;
    let nanoseconds = 1e9 / samples as f64;
    println!(
        "{what:44}{width:>4}   {:7.3} {:7.3}  {ratio:.3} ({low:.3} to {high:.3})",
        own * nanoseconds,
        other * nanoseconds,
    );
}
