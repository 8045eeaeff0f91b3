//! Renderers along three axes: the library's own are right, defects are contradicted, and named where the picture is
//! another picture.

use volver::case::volume::{VolumeCase, catalogue};
use volver::convergence::Verdict;
use volver::image::Image;
use volver::report::image::{Imaged, Standing};
use volver::study::Silent;
use volver::study::picture::{
    Asked, Axis, Own, Pictures, PixelIs, Plan, RenderError, Rendered, Renderer, likeness, pictures,
};

fn plan(expected: [Option<f64>; 3]) -> Plan {
    Plan {
        steps: vec![32, 64, 128, 256, 512, 1024],
        cells: vec![8, 16, 32, 64, 128],
        pixels: vec![8, 16, 32, 64],
        side: 24,
        aspect: [1, 1],
        axes: vec![Axis::Step, Axis::Grid, Axis::Pixel],
        pixel: PixelIs::Centre,
        expected,
    }
}

fn imaged(case: &VolumeCase, renderer: &mut dyn Renderer, plan: &Plan) -> Imaged {
    let pictures = pictures(case, renderer, plan, &Silent).unwrap();
    let like = likeness(case, &pictures, plan.pixel, *plan.cells.last().unwrap());
    Imaged {
        volume: case.name.clone(),
        pictures,
        like,
    }
}

fn order(pictures: &Pictures, axis: Axis) -> (Verdict, f64) {
    let measured = pictures.axes.iter().find(|one| one.axis == axis).unwrap();
    let fit = measured.fit.as_ref().unwrap();
    (fit.verdict, fit.order.unwrap())
}

/// The three orders of theory, within 0.05, in binary64.
#[test]
fn three_orders_show() {
    let case = catalogue::find("wave").unwrap();
    let (step, grid, pixel) = (Axis::Step, Axis::Grid, Axis::Pixel);
    for (name, axes) in [
        (
            "cubic/simpson/simpson",
            vec![(step, 4.0), (grid, 4.0), (pixel, 2.0)],
        ),
        (
            "cubic/front-to-back/middle/expm1",
            vec![(step, 2.0), (pixel, 2.0)],
        ),
        (
            "linear/front-to-back/middle/expm1",
            vec![(step, 2.0), (grid, 2.0)],
        ),
        ("linear/front-to-back/front/expm1", vec![(step, 1.0)]),
    ] {
        let mut own: Own = name.parse().unwrap();
        let plan = Plan {
            axes: axes.iter().map(|(axis, _)| *axis).collect(),
            ..plan(own.expected())
        };
        let found = imaged(&case, &mut own, &plan);
        for (axis, wanted) in axes {
            let (verdict, order) = order(&found.pictures, axis);
            assert_eq!(verdict, Verdict::Confirmed, "{name} {axis:?}: {order}");
            assert!((order - wanted).abs() < 0.05, "{name} {axis:?}: {order}");
        }
        assert_eq!(found.like, []);
        assert_eq!(found.standing(), Standing::Good);
    }
}

/// In binary32 rounding stands above the step's error of order 2 in the end.
#[test]
fn the_floor_of_binary32_is_seen() {
    let case = catalogue::find("ramp").unwrap();
    let finest = |format: &str| {
        let name = format!("linear/front-to-back/middle/expm1@{format}");
        let mut own: Own = name.parse().unwrap();
        let plan = Plan {
            steps: vec![64, 128, 256, 512, 1024, 2048, 4096],
            cells: vec![8, 16],
            axes: vec![Axis::Step],
            ..plan(own.expected())
        };
        let found = imaged(&case, &mut own, &plan);
        found.pictures.axes[0].levels.last().unwrap().smooth.l2
    };
    let (narrow, wide) = (finest("f32"), finest("f64"));
    assert!(narrow > 2.0 * wide && narrow > 1e-8, "{narrow:e} {wide:e}");
}

#[test]
fn no_false_word_of_right_renderers() {
    for volume in ["wave", "radial"] {
        let case = catalogue::find(volume).unwrap();
        for interpolation in ["nearest", "linear", "cubic"] {
            for method in [
                "front-to-back/front/expm1",
                "front-to-back/middle/expm1",
                "trapezoid/trapezoid",
                "simpson/simpson",
            ] {
                let name = format!("{interpolation}/{method}");
                let mut own: Own = name.parse().unwrap();
                let plan = Plan {
                    cells: vec![8, 16, 32, 64],
                    side: 16,
                    ..plan(own.expected())
                };
                let found = imaged(&case, &mut own, &plan);
                assert_eq!(found.like, [], "{volume} {name}");
                let axes = &found.pictures.axes;
                assert_ne!(
                    found.standing(),
                    Standing::Bad,
                    "{volume} {name}: {:?}",
                    axes.iter().map(|axis| &axis.fit).collect::<Vec<_>>()
                );
            }
        }
    }
}

/// What is done to what a right renderer is asked, and to its picture.
struct Faulty {
    own: Own,
    asked: Ask,
    picture: Draw,
}

impl Renderer for Faulty {
    fn name(&self) -> String {
        "faulty".into()
    }

    fn has_equal_segments(&self) -> Option<bool> {
        self.own.has_equal_segments()
    }

    fn render(&mut self, asked: &Asked<'_>) -> Result<Rendered, RenderError> {
        let mut case = asked.case.clone();
        (self.asked)(&mut case, asked);
        // Another case of as many cells has another grid.
        let mut own: Own = "linear/front-to-back/middle/expm1".parse().unwrap();
        let rendered = own.render(&Asked {
            case: &case,
            ..*asked
        })?;
        Ok(Rendered {
            image: (self.picture)(rendered.image),
            ..rendered
        })
    }
}

type Ask = Box<dyn Fn(&mut VolumeCase, &Asked<'_>)>;
type Draw = Box<dyn Fn(Image) -> Image>;

fn asks(ask: impl Fn(&mut VolumeCase, &Asked<'_>) + 'static) -> (Ask, Draw) {
    (Box::new(ask), Box::new(|image| image))
}

fn draws(draw: impl Fn(Image) -> Image + 'static) -> (Ask, Draw) {
    (Box::new(|_, _| ()), Box::new(draw))
}

/// Each pixel from another place of the same picture; black outside. The size is given, too.
fn from(place: impl Fn([usize; 2], [usize; 2]) -> [usize; 2] + 'static) -> (Ask, Draw) {
    draws(move |image| {
        let mut values = Vec::new();
        for y in 0..image.height {
            for x in 0..image.width {
                let [x, y] = place([x, y], [image.width, image.height]);
                let pixel = image.pixel(x, y);
                if pixel.is_empty() {
                    values.extend(vec![0.0; image.channels.len()]);
                } else {
                    values.extend_from_slice(pixel);
                }
            }
        }
        Image { values, ..image }
    })
}

/// Every value, by the column of its pixel.
fn each(of: impl Fn(f64, usize) -> f64 + 'static) -> (Ask, Draw) {
    draws(move |mut image| {
        let (channels, width) = (image.channels.len(), image.width);
        for (k, value) in image.values.iter_mut().enumerate() {
            *value = of(*value, k / channels % width);
        }
        image
    })
}

fn exchanged(order: [usize; 3]) -> (Ask, Draw) {
    draws(move |image| {
        let pixels = image.values.chunks(3);
        let values = pixels.flat_map(|pixel| order.map(|k| pixel[k])).collect();
        Image { values, ..image }
    })
}

/// The volume moved by parts of voxels.
fn moved(by: [f64; 3]) -> (Ask, Draw) {
    asks(move |case, asked| {
        for axis in 0..3 {
            let side = case.corners[1][axis] - case.corners[0][axis];
            let by = by[axis] * side / asked.cells as f64;
            case.camera.position[axis] -= by;
            case.camera.target[axis] -= by;
        }
    })
}

fn extinction(of: impl Fn(f64, f64) -> f64 + 'static) -> (Ask, Draw) {
    asks(move |case, _| {
        for point in &mut case.transfer.points {
            point.extinction = of(point.extinction, point.s);
        }
    })
}

type Defect = (&'static str, Option<&'static str>, (Ask, Draw));

/// Twenty defects, each with the name that it may be given, if any.
fn defects() -> Vec<Defect> {
    let symmetry = Some("symmetry");
    let (length, value) = (Some("length-factor"), Some("value-factor"));
    vec![
        ("mirrored", symmetry, from(|[x, y], [w, _]| [w - 1 - x, y])),
        (
            "upside down",
            symmetry,
            from(|[x, y], [_, h]| [x, h - 1 - y]),
        ),
        ("rows for columns", symmetry, from(|[x, y], _| [y, x])),
        (
            "half a turn",
            symmetry,
            from(|[x, y], [w, h]| [w - 1 - x, h - 1 - y]),
        ),
        ("blue first", Some("channels"), exchanged([2, 1, 0])),
        ("green first", Some("channels"), exchanged([1, 0, 2])),
        (
            "half a voxel aside",
            Some("half-voxel"),
            moved([0.5, 0.0, 0.0]),
        ),
        (
            "half a voxel along all axes",
            Some("half-voxel"),
            moved([0.5, 0.5, 0.5]),
        ),
        (
            "one pixel aside",
            Some("pixel-shift"),
            from(|[x, y], _| [x + 1, y]),
        ),
        ("another unit", length, extinction(|tau, _| 0.1 * tau)),
        ("twice as thick", length, extinction(|tau, _| 2.0 * tau)),
        ("a little thinner", length, extinction(|tau, _| 0.9 * tau)),
        ("darker", value, each(|v, _| 0.8 * v)),
        ("a little brighter", value, each(|v, _| 1.05 * v)),
        (
            "another transfer function",
            None,
            extinction(|tau, s| tau * (1.0 + 0.5 * s)),
        ),
        ("gamma", None, each(|v, _| v.max(0.0).powf(1.0 / 2.2))),
        (
            "a seam",
            None,
            each(|v, x| if x % 8 == 3 { 0.7 * v } else { v }),
        ),
        ("clipped", None, each(|v, _| v.min(0.3))),
        ("a background", None, each(|v, _| v + 0.02)),
        (
            "a slice too few",
            None,
            asks(|case, asked| {
                case.corners[1][2] -=
                    (case.corners[1][2] - case.corners[0][2]) / asked.cells as f64;
            }),
        ),
    ]
}

#[test]
fn defects_are_contradicted_and_named_only_as_what_they_are() {
    let case = catalogue::find("radial").unwrap();
    let all = defects();
    assert_eq!(all.len(), 20);
    for (what, name, (asked, picture)) in all {
        let own: Own = "linear/front-to-back/middle/expm1".parse().unwrap();
        let plan = plan(own.expected());
        let mut faulty = Faulty {
            own,
            asked,
            picture,
        };
        let found = imaged(&case, &mut faulty, &plan);
        let names: Vec<&str> = found.like.iter().map(|one| one.name).collect();
        let axes = found.pictures.axes.iter();
        let verdicts: Vec<_> = axes
            .map(|axis| axis.fit.as_ref().map(|fit| (fit.verdict, fit.order)))
            .collect();
        assert_eq!(found.standing(), Standing::Bad, "{what}: {verdicts:?}");
        match name {
            Some(name) => assert_eq!(names, [name], "{what}: {:?}", found.like),
            None => assert!(names.is_empty(), "{what}: {:?}", found.like),
        }
    }
}

/// A program that takes no notice of the step is not confirmed by differences that are 0.
#[test]
fn steps_that_change_nothing_confirm_nothing() {
    struct Deaf(Own);
    impl Renderer for Deaf {
        fn name(&self) -> String {
            "deaf".into()
        }
        fn render(&mut self, asked: &Asked<'_>) -> Result<Rendered, RenderError> {
            self.0.render(&Asked {
                step: 0.01,
                ..*asked
            })
        }
    }
    let case = catalogue::find("blob").unwrap();
    let own: Own = "linear/front-to-back/middle/expm1".parse().unwrap();
    let plan = Plan {
        cells: vec![8, 16, 32],
        axes: vec![Axis::Step],
        ..plan(own.expected())
    };
    let found = imaged(&case, &mut Deaf(own), &plan);
    assert!(found.pictures.axes[0].changes_nothing);
    assert_eq!(found.standing(), Standing::Open);
}
