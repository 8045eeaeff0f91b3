//! Exponentials in binary32 that are off to one side: said with by how much, and only then.
//!
//! What looks alike: products that are rounded towards 0 (less than a unit); something small that is added to what is let
//! through (thick segments); errors to either side (their mean); depths that are summed before (one exponential a ray).

use volver::identify::{Budget, Examined, examine};
use volver::kernel::{Closure, Declaration, Segments, UlpBound};

/// A step of one segment: τ d and T to what it lets through, and T behind it.
type Step = fn(f32, f32) -> (f32, f32);

fn examined(declare: impl FnOnce(&mut Declaration), step: Step) -> Examined {
    let mut declaration = Declaration::new("binary32");
    declaration.format = "f32".parse().unwrap();
    declare(&mut declaration);
    let radiance = move |segments: &Segments, channel: usize| {
        let (edges, middles) = (&segments.edges, &segments.middles);
        let (mut sum, mut through) = (0.0_f32, 1.0_f32);
        for i in 0..segments.count() {
            let d = (edges.lambda[i + 1] - edges.lambda[i]) as f32;
            let x = middles.extinction[i] as f32 * d;
            let (passes, behind) = step(x, through);
            sum += through * (1.0 - passes) * middles.emission[channel][i] as f32;
            through = behind;
        }
        f64::from(sum)
    };
    let mut kernel = Closure::new(
        declaration,
        move |task: &volver::kernel::Task<'_>, channel| {
            task.cut()
                .map_or(f64::NAN, |segments| radiance(segments, channel))
        },
    );
    examine(&mut kernel, Budget::default(), &mut |_| ())
}

/// e^(−x), by so many units of 2^(−24) too large.
fn off(x: f32, units: f64) -> f32 {
    if x == 0.0 {
        return 1.0;
    }
    ((-f64::from(x)).exp() * (1.0 + units * (-24_f64).exp2())) as f32
}

fn by_product(passes: f32, through: f32) -> (f32, f32) {
    (passes, through * passes)
}

#[test]
fn exponentials_that_are_off_are_said_by_how_much() {
    let kernels: [(f64, Step); 3] = [
        (3.0, |x, through| by_product(off(x, 3.0), through)),
        (-3.0, |x, through| by_product(off(x, -3.0), through)),
        (2.0, |x, through| by_product(off(x, 2.0), through)),
    ];
    for (units, step) in kernels {
        let found = examined(|_| (), step);
        assert!(found.found.named().is_some(), "{units}");
        let said = found.found.exponential;
        let said = said.unwrap_or_else(|| panic!("nothing is said of {units}"));
        assert!((said.units - units).abs() <= 0.1, "{units}: {said}");
        assert!(said.error >= (said.units - units).abs(), "{units}: {said}");
        assert!(found.deviations.is_empty(), "{:?}", found.deviations);
    }
    let three: Step = |x, through| by_product(off(x, 3.0), through);
    let declared = |units| {
        let bound = UlpBound::new(units, 0.0).unwrap();
        let found = examined(|declaration| declaration.exp_ulp = Some(bound), three);
        let names: Vec<&str> = found.deviations.iter().map(|d| d.name).collect();
        names
    };
    assert_eq!(declared(2.0), ["exponential"]);
    assert!(declared(4.0).is_empty());
}

#[test]
fn of_other_exponentials_nothing_is_said() {
    let kernels: [(&str, Step); 6] = [
        ("as good as can be", |x, through| {
            by_product((-x).exp(), through)
        }),
        ("by expm1", |x, through| {
            by_product(1.0 + (-x).exp_m1(), through)
        }),
        ("products rounded towards 0", |x, through| {
            let passes = (-x).exp();
            let exact = f64::from(through) * f64::from(passes);
            let near = exact as f32;
            let behind = if f64::from(near) > exact {
                near.next_down()
            } else {
                near
            };
            (passes, behind)
        }),
        ("1e-7 is added", |x, through| {
            by_product((-x).exp() + 1.2e-7, through)
        }),
        ("off to either side", |x, through| {
            let units = if x.to_bits().count_ones() % 2 == 0 {
                3.0
            } else {
                -3.0
            };
            by_product(off(x, units), through)
        }),
        ("1 − α of the opacity so far", |x, through| {
            let passes = (-x).exp();
            let opacity = (1.0 - through) + through * (1.0 - passes);
            (passes, 1.0 - opacity)
        }),
    ];
    for (what, step) in kernels {
        let found = examined(|_| (), step);
        assert_eq!(found.found.exponential, None, "{what}");
    }
}
