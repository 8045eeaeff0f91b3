//! What hides below rounding or beyond the depths that a rule is read off: it is named, or said not to be known.

use volver::identify::rule::{Law, Scheme};
use volver::identify::{Budget, Examined, Identification, Verdict, examine};
use volver::kernel::{Closure, Declaration, Segments, Task};

fn examined(
    format: &str,
    declare: impl FnOnce(&mut Declaration),
    radiance: impl Fn(&Segments, usize) -> f64 + Send + 'static,
) -> Examined {
    let mut declaration = Declaration::new("edges");
    declaration.format = format.parse().unwrap();
    declare(&mut declaration);
    let of_task = move |task: &Task<'_>, channel| {
        task.cut()
            .map_or(f64::NAN, |segments| radiance(segments, channel))
    };
    let mut kernel = Closure::new(declaration, of_task);
    examine(&mut kernel, Budget::default(), &mut |_| ())
}

/// The law of a rule of one sample a segment.
fn law(found: &Identification) -> Option<Law> {
    match &found.rule.as_ref()?.scheme {
        Scheme::Sample { law, .. } => Some(law.clone()),
        Scheme::Segments { .. } => None,
    }
}

fn said(found: &Identification) -> Vec<&str> {
    found
        .not_identified
        .iter()
        .map(|one| one.reason.as_str())
        .collect()
}

/// The source linear in optical depth; its functions of the depth by series of two terms below `border`.
fn linear(border: f64) -> impl Fn(&Segments, usize) -> f64 {
    move |segments, channel| {
        let edges = &segments.edges;
        let (mut radiance, mut passes) = (0.0, 1.0);
        for (i, d) in segments.lengths().enumerate() {
            let x = 0.5 * d * (edges.extinction[i] + edges.extinction[i + 1]);
            let (whole, slope) = if x < border {
                (x - x * x / 2.0, x / 2.0 - x * x / 3.0)
            } else if x == 0.0 {
                (0.0, 0.0)
            } else {
                let whole = -(-x).exp_m1();
                (whole, whole / x - (-x).exp())
            };
            let (near, far) = (edges.emission[channel][i], edges.emission[channel][i + 1]);
            radiance += passes * (whole * near + slope * (far - near));
            passes *= 1.0 - whole;
        }
        radiance
    }
}

#[test]
fn a_series_of_thin_layers_is_seen_and_its_border_told() {
    let plain = examined("f64", |_| (), linear(0.0));
    assert!(
        plain.found.not_identified.is_empty(),
        "{:?}",
        plain.found.not_identified
    );
    assert!(plain.found.named().is_some());
    for border in [5e-4, 1e-2] {
        let examined = examined("f64", |_| (), linear(border));
        assert_eq!(examined.verdict(), Verdict::NotIdentified);
        let found = examined.found;
        let said = said(&found);
        let [said] = said.as_slice() else {
            panic!("{border}: {said:?}")
        };
        // "segments of a depth of 4.999e-4 and less …"
        let told = said
            .split(' ')
            .find_map(|word| word.parse::<f64>().ok())
            .unwrap();
        assert!((told / border - 1.0).abs() < 2e-3, "{border}: {said}");
    }
}

/// What a segment lets through, of its opacity.
fn by_product(passes: fn(f32) -> f32) -> impl Fn(&Segments, usize) -> f64 {
    move |segments, channel| {
        let middles = &segments.middles;
        let (mut radiance, mut through) = (0.0_f32, 1.0_f32);
        for (i, d) in segments.lengths().enumerate() {
            let opacity = -(-(middles.extinction[i] as f32) * d as f32).exp_m1();
            radiance += through * opacity * middles.emission[channel][i] as f32;
            through *= passes(opacity);
        }
        f64::from(radiance)
    }
}

#[test]
fn what_is_added_by_a_unit_of_the_format_is_named() {
    let plain = examined("f32", |_| (), by_product(|a| 1.0 - a)).found;
    assert!(plain.not_identified.is_empty() && plain.named().is_some());
    assert!(law(&plain).is_some_and(|law| law.eps.abs() == 0.0));
    let examined = examined("f32", |_| (), by_product(|a| 1.0 - a + 1e-7));
    let found = &examined.found;
    assert!(found.named().is_some() && found.not_identified.is_empty());
    assert!(law(found).is_some_and(|law| (law.eps - 1e-7).abs() < 1e-12));
    let names: Vec<&str> = examined.deviations.iter().map(|one| one.name).collect();
    assert_eq!(names, ["eps"]);
}

/// As much growth in empty space, and nothing behind what is opaque: nothing is added, and no such name is given.
#[test]
fn what_grows_otherwise_has_no_name() {
    let grows = |a: f32| (1.0 - a) * (1.0 + f32::EPSILON);
    let found = examined("f32", |_| (), by_product(grows)).found;
    let said = said(&found);
    assert!(
        matches!(said.as_slice(), [one] if one.contains("empty segments")),
        "{said:?}"
    );
    assert!(law(&found).is_some_and(|law| law.eps.abs() == 0.0));
}

/// Faint samples are taken for empty, and the last reaches so far that it is opaque if it counts.
#[test]
fn a_mask_of_faint_samples_shows_by_the_wall_behind_them() {
    let mask = 1e-6;
    let radiance = move |segments: &Segments, channel: usize| {
        let edges = &segments.edges;
        let n = segments.count();
        let (mut radiance, mut through) = (0.0_f32, 1.0_f32);
        for (i, d) in segments.lengths().enumerate() {
            let d = if i + 1 == n { 1e10 } else { d as f32 };
            let tau = edges.extinction[i] as f32;
            let x = if tau > mask { tau * d } else { 0.0 };
            let opacity = 1.0 - (-x).exp();
            radiance += through * opacity * edges.emission[channel][i] as f32;
            through *= 1.0 - opacity;
        }
        f64::from(radiance)
    };
    let found = examined("f32", |declaration| declaration.far_wall = true, radiance);
    assert!(
        found.found.named().is_some(),
        "{:?}",
        found.found.not_identified
    );
    let least = law(&found.found).unwrap().range.skip_extinction;
    assert!(
        least.is_some_and(|least| (least / 1e-6 - 1.0).abs() < 1e-5),
        "{least:?}"
    );
    let names: Vec<&str> = found.deviations.iter().map(|one| one.name).collect();
    assert_eq!(names, ["skip-extinction"]);
}
