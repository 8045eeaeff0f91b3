//! Volumes by formulas: the fast picture against enclosures, chords at odd angles, files that are refused.

use rug::Float;
use volver::case::Description;
use volver::case::manufacture::manufacture;
use volver::case::volume::{Break, Chord, VolumeCase, catalogue, chord, read};
use volver::reference::{ExactPicture, enclosed_radiance};
use volver::volume::Ray;

const SIZE: [usize; 2] = [24, 18];

fn all() -> Vec<VolumeCase> {
    catalogue::names()
        .map(|name| catalogue::find(name).unwrap())
        .collect()
}

/// Rays through the middles of some pixels.
fn rays(case: &VolumeCase) -> Vec<Ray> {
    let [width, height] = SIZE;
    let places = (0..width * height)
        .step_by(37)
        .map(|k| [k % width, k / width]);
    let middle = |[x, y]: [usize; 2]| [x as f64 + 0.5, y as f64 + 0.5];
    places
        .filter_map(|at| case.camera.ray(SIZE, middle(at)))
        .collect()
}

#[test]
fn every_volume_of_the_catalogue_reads() {
    assert_eq!(all().len(), catalogue::names().count());
    assert!(
        all()
            .iter()
            .zip(catalogue::names())
            .all(|(case, name)| case.name == name)
    );
}

/// Two routes: Gauss's points in binary64, and a ball that is proved to contain the integral of the ray's own case file.
fn agrees_with_enclosures(case: &VolumeCase, rays: &[Ray], allowed: f64) -> usize {
    let picture = ExactPicture::new(case);
    let mut met = 0;
    for ray in rays {
        let seen = picture.ray(ray);
        let Some(chord) = seen.chord else { continue };
        let text = case.ray_case("ray", ray, chord);
        let description = Description::read(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        let channels = manufacture(&description).unwrap_or_else(|e| panic!("{e}\n{text}"));
        assert_eq!(channels.len(), seen.radiance.len());
        for (channel, got) in channels.iter().zip(&seen.radiance) {
            let truth =
                enclosed_radiance(&channel.case, 80).unwrap_or_else(|e| panic!("{e}\n{text}"));
            let off = Float::with_val(80, &truth.value - *got).abs().to_f64();
            let name = &case.name;
            assert!(
                off < allowed + truth.error.to_f64(),
                "{name}: {off:e}\n{text}"
            );
            met += 1;
        }
    }
    met
}

#[test]
fn pictures_are_what_is_enclosed() {
    for case in all() {
        let met = agrees_with_enclosures(&case, &rays(&case), 2e-14);
        assert!(met >= 15, "{}: {met}", case.name);
    }
}

/// What is narrow beside a ray, and crosses control points, a jump of the transfer functions among them.
#[test]
fn narrow_things_and_control_points_are_what_is_enclosed() {
    let text = catalogue::text("blob").unwrap();
    let narrow = text.replace("width = 0.9", "width = 0.03").replace(
        "  { s = 1, extinction = 3, emission = [1, 0.7, 0.2] },",
        "  { s = 0.3, extinction = 9, emission = [1, 0.7, 0.2] },
  { s = 0.6, extinction = 2, emission = [0.1, 0.2, 0.9] },
  { s = 0.6, extinction = 5, emission = [1, 1, 0] },
  { s = 1, extinction = 40, emission = [1, 0.7, 0.2] },",
    );
    let case = read(&narrow).unwrap();
    let centre = [0.2, -0.1, 0.15];
    // Through the middle of the blob, and beside it.
    let rays: Vec<Ray> = [0.0, 0.004, 0.011, 0.02, 0.05]
        .map(|aside| Ray {
            origin: [centre[0] + aside, centre[1], -3.0],
            direction: [0.0, 0.0, 1.0],
        })
        .to_vec();
    // A place is rounded by 4e-16: s by 1.3e-14 where it is steepest, τ by 88 times as much, along a tenth of a unit.
    assert_eq!(agrees_with_enclosures(&case, &rays, 1.2e-13), 15);
    let met = ExactPicture::new(&case).ray(&rays[0]).breaks;
    let kinds: Vec<Break> = met.iter().map(|(_, kind)| *kind).collect();
    let crossed = kinds
        .iter()
        .filter(|kind| **kind == Break::ControlPoint)
        .count();
    // s = 0.3 and, twice in one place, 0.6, on the way in and on the way out; and the middle, where the field turns.
    assert_eq!((crossed, kinds.len()), (6, 7), "{kinds:?}");
}

#[test]
fn rays_along_faces_edges_and_diagonals_are_in_the_box() {
    let corners = [[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]];
    let of = |origin: [f64; 3], direction: [f64; 3]| chord(corners, &Ray { origin, direction });
    let through = |from: f64, to: f64| Some(Chord { from, to });
    let x = [1.0, 0.0, 0.0];
    assert_eq!(of([-3.0, 0.0, 0.0], x), through(2.0, 4.0));
    // Along a face, an edge, and beside both.
    assert_eq!(of([-3.0, 1.0, 0.0], x), through(2.0, 4.0));
    assert_eq!(of([-3.0, 1.0, -1.0], x), through(2.0, 4.0));
    assert_eq!(of([-3.0, 1.0 + f64::EPSILON, 0.0], x), None);
    // −0 is a direction along the slab, too.
    assert_eq!(of([-3.0, 1.0, 0.0], [1.0, -0.0, -0.0]), through(2.0, 4.0));
    // From inside, from behind, away from it.
    assert_eq!(of([0.5, 0.0, 0.0], x), through(0.0, 0.5));
    assert_eq!(of([3.0, 0.0, 0.0], x), None);
    assert_eq!(of([1.0, 0.0, 0.0], x), None);
    let third = 1.0 / 3.0_f64.sqrt();
    let diagonal = of([-2.0; 3], [third; 3]).unwrap();
    assert!((diagonal.to - diagonal.from - 12.0_f64.sqrt()).abs() < 1e-15 * 8.0);
    // A corner alone is no part.
    assert_eq!(of([-1.0, 1.0, -3.0], [third, third, third]), None);
}

/// Means of pixels are the centre's with the second derivative: 4 where pixels are twice as large.
#[test]
fn means_of_pixels_differ_from_centres_by_the_square_of_their_size() {
    let case = catalogue::find("wave").unwrap();
    let picture = ExactPicture::new(&case);
    let off = |size: usize| {
        let (centre, mean) = (picture.centres([size; 2]), picture.means([size; 2], 4));
        let at = |x: usize, y: usize| (centre.pixel(x, y)[0] - mean.pixel(x, y)[0]).abs();
        // Of the middle quarter, where no pixel sees the edge of the box.
        let mut sum = 0.0;
        for y in 3 * size / 8..5 * size / 8 {
            for x in 3 * size / 8..5 * size / 8 {
                sum += at(x, y) / (size * size / 16) as f64;
            }
        }
        sum
    };
    let ratio = off(16) / off(32);
    assert!((ratio.log2() - 2.0).abs() < 0.05, "{ratio}");
}

#[test]
fn breaks_are_where_something_is_not_analytic() {
    let case = catalogue::find("jump-sphere").unwrap();
    let ray = Ray {
        origin: [0.1, 0.05, -4.0],
        direction: [0.0, 0.0, 1.0],
    };
    let seen = ExactPicture::new(&case).ray(&ray);
    let kinds: Vec<Break> = seen.breaks.iter().map(|(_, kind)| *kind).collect();
    assert_eq!(kinds, [Break::FieldJump, Break::FieldJump]);
    // −0.1 ± 0.7, from −4 on.
    assert!(
        (seen.breaks[0].0 - 3.2).abs() < 1e-15 * 16.0
            && (seen.breaks[1].0 - 4.6).abs() < 1e-15 * 16.0
    );
    // e^(−τL) of three stretches, whose emissions are constant.
    let (thin, ball) = ((-0.1 * 0.2_f64).exp(), (-1.5 * 1.4_f64).exp());
    let last = -(-0.1 * 0.4_f64).exp_m1();
    let want = 0.1 * (1.0 - thin) + thin * (1.0 - ball) + 0.1 * thin * ball * last;
    assert!((seen.radiance[0] - want).abs() < 1e-15);
}

#[test]
fn files_that_are_no_volumes_are_refused_in_one_line() {
    let good = catalogue::text("ramp").unwrap();
    assert!(read(good).is_ok());
    for (change, to, says) in [
        (
            "name = \"ramp\"",
            "name = \"a b\"",
            "line 1: 'a b' is no name",
        ),
        (
            "from = [-1, -1, -1]",
            "from = [1, -1, -1]",
            "line 4: a side of the box is 0",
        ),
        (
            "kind = \"ramp\"",
            "kind = \"slope\"",
            "line 5: unknown variant",
        ),
        ("offset = 0.5", "shift = 0.5", "unknown field 'shift'"),
        (
            "slope = [0.2,",
            "slope = [inf,",
            "line 5: a number of the field is inf",
        ),
        (
            "extinction = 0.2",
            "extinction = -0.2",
            "line 6: an extinction is -0.2",
        ),
        (
            "emission = [1, 0.2, 0.1]",
            "emission = [1, 0.2]",
            "line 6: 2 emissions of a control point (allowed: 3",
        ),
        (
            "{ s = 1,",
            "{ s = -1,",
            "line 6: s is -1 (allowed: not below",
        ),
        (
            "orthographic = { height = 3 }",
            "orthographic = { height = 0 }",
            "line 10: height is 0",
        ),
        (
            "orthographic = { height = 3 }",
            "perspective = { angle_degrees = 180 }",
            "angle_degrees is 180",
        ),
        (
            ", orthographic = { height = 3 }",
            "",
            "a camera with neither",
        ),
        ("up = [0, 0, 1]", "up = [3, 2, 1.5]", "along 'up'"),
        (
            "[\"r\", \"g\", \"b\"]",
            "[\"r\", \"g\", \"r\"]",
            "line 3: 'r' is no name of its own",
        ),
        (
            "[\"r\", \"g\", \"b\"]",
            "[]",
            "line 3: 0 channels (allowed: 1 to 8)",
        ),
    ] {
        assert!(good.contains(change), "{change}");
        let said = read(&good.replace(change, to)).unwrap_err().to_string();
        assert!(
            said.contains(says) && !said.contains('\n'),
            "{says}: {said}"
        );
    }
}
