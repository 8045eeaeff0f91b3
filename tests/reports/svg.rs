//! Figures and maps as SVG files.

use crate::entries::{entry, replicated};
use rug::Float;
use rug::float::Special;
use volver::convergence::{Sample, Verdict, fit};
use volver::document::{
    About, Axis, Block, Cell, Column, Document, Figure, Medium, Plot, Point, Section, Series, Table,
};
use volver::render::{html, svg};
use volver::report::groups;
use volver::report::plots::of_convergence;
use volver::report::reproduce::of_table;

/// An element, and where its places are counted from.
#[derive(Debug)]
struct Element {
    tag: String,
    text: String,
    from: (f64, f64),
}

impl Element {
    fn attribute(&self, name: &str) -> Option<&str> {
        let (_, rest) = self.tag.split_once(&format!(" {name}=\""))?;
        rest.split('"').next()
    }

    fn number(&self, name: &str) -> f64 {
        self.attribute(name).unwrap().parse().unwrap()
    }

    fn is(&self, name: &str, class: &str) -> bool {
        let classes = self.attribute("class").unwrap_or_default();
        self.tag.split(' ').next() == Some(name) && classes.split(' ').any(|own| own == class)
    }

    /// Where a path begins.
    fn start(&self) -> (f64, f64) {
        self.places()[0]
    }

    /// The corners of a path of straight lines.
    fn places(&self) -> Vec<(f64, f64)> {
        let corners = self.attribute("d").unwrap().split(['M', 'L', 'a', 'z']);
        let corners = corners.filter(|corner| !corner.is_empty());
        let place = |corner: &str| {
            let numbers: Vec<f64> = corner.split(' ').map(|x| x.parse().unwrap()).collect();
            (numbers[0] + self.from.0, numbers[1] + self.from.1)
        };
        corners.map(place).collect()
    }
}

/// The elements of a file, which has to be XML.
fn read(svg: &str) -> Vec<Element> {
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    let is_allowed = |c: char| c == '\n' || c >= ' ' && c != '\u{ffff}';
    assert!(svg.chars().all(is_allowed) && !svg.contains("<script"));
    let mut elements: Vec<Element> = Vec::new();
    let mut open: Vec<(String, (f64, f64))> = vec![(String::new(), (0.0, 0.0))];
    for piece in svg.split('<').skip(1) {
        let (tag, text) = piece.split_once('>').unwrap();
        for entity in piece.split('&').skip(1) {
            assert!(
                ["amp;", "lt;", "gt;", "quot;"]
                    .iter()
                    .any(|e| entity.starts_with(e)),
                "{piece}"
            );
        }
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop().unwrap().0, name);
            continue;
        }
        assert!(
            !tag.ends_with('/') && tag.matches('"').count() == 2 * tag.matches("=\"").count(),
            "{tag}"
        );
        let mut from = open.last().unwrap().1;
        if let Some((_, moved)) = tag.split_once("transform=\"translate(") {
            let (x, y) = moved.split_once(')').unwrap().0.split_once(' ').unwrap();
            from = (
                from.0 + x.parse::<f64>().unwrap(),
                from.1 + y.parse::<f64>().unwrap(),
            );
        }
        open.push((tag.split(' ').next().unwrap().into(), from));
        let text = text
            .trim()
            .replace("&lt;", "<")
            .replace("&gt;", ">")
            .replace("&amp;", "&");
        elements.push(Element {
            tag: tag.into(),
            text,
            from,
        });
    }
    assert_eq!(open.len(), 1);
    elements
}

fn all<'e>(elements: &'e [Element], name: &'static str, class: &'static str) -> Vec<&'e Element> {
    elements
        .iter()
        .filter(|element| element.is(name, class))
        .collect()
}

/// Left ends of the marks of a plot: unlike samples, those say their values.
fn marks(svg: &str) -> Vec<(f64, f64)> {
    let elements = read(svg);
    let says = |pair: &[Element]| pair[0].is("path", "mark") && pair[1].tag == "title";
    elements
        .windows(2)
        .filter(|pair| says(pair))
        .map(|pair| pair[0].start())
        .collect()
}

fn texts(svg: &str) -> Vec<String> {
    let elements = read(svg)
        .into_iter()
        .filter(|element| element.tag.starts_with("text"));
    elements.map(|element| element.text).collect()
}

/// The decimal logarithm of "200", "10⁻¹²" or "5·10⁻⁷".
fn log10(label: &str) -> f64 {
    let (factor, power) = label.split_once('·').unwrap_or(("1", label));
    let raised = |c: char| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|raised| raised == c);
    let digit = |c| raised(c).map_or("-".into(), |digit| digit.to_string());
    match power.strip_prefix("10").filter(|_| !power.is_ascii()) {
        Some(exponent) => {
            let exponent: String = exponent.chars().map(digit).collect();
            factor.parse::<f64>().unwrap().log10() + exponent.parse::<f64>().unwrap()
        }
        None => label.parse::<f64>().unwrap().log10(),
    }
}

/// Ticks of an axis as decimal logarithm and pixel.
fn ticks(svg: &str, axis: &'static str) -> Vec<(f64, f64)> {
    let elements = read(svg);
    let of = |element: &&Element| {
        let from = if axis == "x" {
            element.from.0
        } else {
            element.from.1
        };
        (log10(&element.text), element.number(axis) + from)
    };
    all(&elements, "text", axis).iter().map(of).collect()
}

/// |e| = 4⁻ᵏ at n = 2ᵏ, k = 3 … 8: order 2.
fn second_order(tiny: u32) -> Vec<Sample> {
    (3..=8)
        .map(|k| Sample {
            n: Some(1 << k),
            step: 1.0 / f64::from(1 << k),
            error: Float::with_val(64, 1) >> (2 * k + tiny),
            floor: Float::new(53),
        })
        .collect()
}

fn plot(samples: &[Sample]) -> String {
    let plot = of_convergence(samples, &fit(samples, None).unwrap(), "a title");
    svg::figure(&Figure::new("", "a title", [plot]))
}

fn table(entries: &[volver::study::reproduce::Entry]) -> String {
    let group = &groups(entries)[0];
    svg::figure(&Figure::new("table", group.title(), of_table(group)))
}

#[test]
fn marks_stand_where_the_errors_are() {
    let svg = plot(&second_order(0));
    let found = marks(&svg);
    assert_eq!(found.len(), 6);
    // Between the ticks, which say where powers of ten are; a mark begins 5.04 to the left of its place.
    let between = |ticks: &[(f64, f64)], log: f64| {
        let (a, b) = (ticks[0], ticks[ticks.len() - 1]);
        a.1 + (log - a.0) / (b.0 - a.0) * (b.1 - a.1)
    };
    let (x, y) = (ticks(&svg, "x"), ticks(&svg, "y"));
    for (at, k) in found.iter().zip(3_i32..) {
        let (n, error) = (2_f64.powi(k).log10(), 4_f64.powi(-k).log10());
        assert!((at.0 + 5.04 - between(&x, n)).abs() < 0.03, "{at:?}");
        assert!((at.1 - between(&y, error)).abs() < 0.03, "{at:?}");
    }
}

#[test]
fn errors_below_binary64_are_drawn_alike() {
    let (plain, tiny) = (plot(&second_order(0)), plot(&second_order(5000)));
    assert_eq!(marks(&plain).len(), 6);
    for (a, b) in marks(&plain).into_iter().zip(marks(&tiny)) {
        assert!((a.0 - b.0).abs() < 0.03 && (a.1 - b.1).abs() < 0.03);
    }
    assert!(tiny.contains("10⁻¹⁵⁰⁸"));
}

#[test]
fn the_line_of_the_order_is_as_steep_as_the_curve() {
    let svg = plot(&second_order(0));
    let marks = marks(&svg);
    let curve = (marks[5].1 - marks[0].1) / (marks[5].0 - marks[0].0);
    let elements = read(&svg);
    // The other is the key's.
    let line = all(&elements, "path", "thin")[0].places();
    assert!(((line[1].1 - line[0].1) / (line[1].0 - line[0].0) - curve).abs() < 0.01);
    assert!(
        texts(&svg).contains(&"order 2.00".into()) && texts(&svg).contains(&"fitted order".into())
    );
}

#[test]
fn the_key_says_what_occurs_and_bytes_are_the_same_again() {
    let entries = [
        entry("simpson", "boole"),
        replicated("monte-carlo", "boole"),
    ];
    let svg = table(&entries);
    assert_eq!(svg, table(&entries));
    for text in [
        "inner: monte-carlo (64 replicas, f64)",
        "|bias|",
        "level in the fit",
        "other level",
    ] {
        assert_eq!(
            texts(&svg).iter().filter(|found| *found == text).count(),
            1,
            "{text}"
        );
    }
    // No error is negative, and floors lie far below.
    assert!(!svg.contains("error below 0") && !svg.contains("roundoff floor"));
}

#[test]
fn rows_without_a_finite_error_have_no_panel() {
    let mut entries = [
        entry("simpson", "boole"),
        entry("gauss-3", "boole"),
        entry("riemann", "boole"),
    ];
    for level in &mut entries[1].levels {
        level.error = Float::new(53);
    }
    entries[1].verdict = Verdict::Exact;
    for (level, special) in entries[2]
        .levels
        .iter_mut()
        .zip([Special::Nan, Special::Infinity])
    {
        level.error = Float::with_val(53, special);
        level.floor = Float::with_val(53, special);
    }
    entries[2].verdict = Verdict::NotFinite;
    let svg = table(&entries);
    assert!(texts(&svg).contains(&"inner: gauss-3: nothing to draw (boole Exact)".into()));
    assert!(texts(&svg).contains(&"boole not finite".into()));
    assert_eq!(svg.matches("segments n").count(), 2);
}

#[test]
fn nothing_to_draw_is_said() {
    let mut samples = second_order(0);
    for sample in &mut samples {
        sample.error = Float::new(53);
    }
    assert!(plot(&samples).contains("nothing to draw (order Exact)"));
    assert!(plot(&[]).contains("TooFewLevels"));
    assert!(svg::figure(&Figure::new("", "empty", [])).contains("nothing to draw"));
}

#[test]
fn odd_steps_and_single_levels_are_drawn() {
    let mut samples = second_order(0);
    samples[1].n = None;
    let svg = plot(&samples);
    assert!(svg.contains("1/d, finer to the right"));
    assert_eq!(marks(&svg).len(), 6);
    let single = plot(&samples[..1]);
    assert_eq!(marks(&single).len(), 1);
    assert!(ticks(&single, "x").len() >= 2 && ticks(&single, "y").len() >= 2);
}

#[test]
fn a_page_and_a_file_draw_the_same() {
    let entries = [entry("simpson", "boole"), entry("gauss-3", "trapezoid")];
    let group = &groups(&entries)[0];
    let figure = Figure::new("table", "Table", of_table(group));
    let file = svg::figure(&figure);
    let mut document = Document::new("trial", "Trial", About::new(["volver"]));
    document
        .sections
        .push(Section::of("a", "A", [Block::Figure(figure)]));
    let page = html::render(&document).unwrap();
    let elements = read(&file);
    let paths: Vec<&str> = elements
        .iter()
        .filter_map(|element| element.attribute("d"))
        .collect();
    assert!(paths.len() > 20);
    for path in paths {
        assert!(page.contains(&format!("d=\"{path}\"")), "{path}");
    }
    assert!(page.contains("level in the fit"));
}

/// The labels of the y axis, and its title, where these are the values.
fn linear(values: &[f64]) -> (Vec<String>, String) {
    let mut plot = Plot::new("p", Axis::linear("λ"), Axis::linear("C"));
    let points = values
        .iter()
        .zip(0_u8..)
        .map(|(y, x)| Point::new(f64::from(x), *y, "a"));
    plot.series.push(Series::line("C", points));
    let svg = svg::figure(&Figure::new("", "f", [plot]));
    let elements = read(&svg);
    let labels = all(&elements, "text", "y")
        .iter()
        .map(|e| e.text.clone())
        .collect();
    (labels, all(&elements, "text", "title")[1].text.clone())
}

#[test]
fn linear_ticks_are_round_and_begin_at_zero_where_it_is_near() {
    assert_eq!(linear(&[0.1, 0.84]).0, ["0.0", "0.2", "0.4", "0.6", "0.8"]);
    assert_eq!(
        linear(&[-1.0, 1.0]).0,
        ["-1.0", "-0.5", "0.0", "0.5", "1.0"]
    );
    assert_eq!(
        linear(&[0.9, 1.0]).0,
        ["0.90", "0.92", "0.94", "0.96", "0.98", "1.00"]
    );
    assert_eq!(
        linear(&[3.0, 3.0]).0,
        ["0.0", "0.5", "1.0", "1.5", "2.0", "2.5", "3.0"]
    );
    assert_eq!(linear(&[0.0, 0.0]).0, ["-1.0", "-0.5", "0.0", "0.5", "1.0"]);
    assert_eq!(
        linear(&[0.0, 2e-5]),
        (
            ["0.0", "0.5", "1.0", "1.5", "2.0"].map(String::from).into(),
            "C, in 10⁻⁵".into()
        )
    );
    assert_eq!(linear(&[0.0, 3e6]).1, "C, in 10⁶");
    assert_eq!(linear(&[0.0, 1000.0]).1, "C");
}

#[test]
fn labels_do_not_touch() {
    let mut plot = Plot::new("p", Axis::log("n"), Axis::log("e"));
    let points = [-15_000.0, 15_000.0].map(|x| Point::new(x, x, "a"));
    plot.series.push(Series::line("C", points));
    let found = ticks(&svg::figure(&Figure::new("", "f", [plot])), "x");
    assert!(found.len() >= 2, "{found:?}");
    // 9 letters of 12 pixels, at equal distances.
    let distances: Vec<f64> = found.windows(2).map(|pair| pair[1].1 - pair[0].1).collect();
    assert!(
        distances
            .iter()
            .all(|d| *d > 60.0 && (d - distances[0]).abs() < 0.05),
        "{distances:?}"
    );
}

/// A drawing with so many series, and its frame, and where the names of the series begin.
fn legend(count: usize) -> (f64, (f64, f64), Vec<(f64, f64)>) {
    let mut plot = Plot::new("p", Axis::log("n"), Axis::log("e"));
    let names: Vec<String> = (0..count)
        .map(|k| format!("a method with a long name {k}"))
        .collect();
    let series = names
        .iter()
        .map(|name| Series::line(name, [Point::new(0.0, 0.0, "a")]));
    plot.series.extend(series);
    let elements = read(&svg::figure(&Figure::new("", "f", [plot])));
    let view = elements[0].attribute("viewBox").unwrap();
    let frame = all(&elements, "rect", "frame")[0];
    let place = |name: &String| {
        let text = elements
            .iter()
            .find(|element| element.text == *name)
            .unwrap();
        (text.number("x"), text.number("y"))
    };
    let right = frame.number("x") + frame.number("width") + frame.from.0;
    (
        view.split(' ').nth(2).unwrap().parse().unwrap(),
        (right, frame.number("y") + frame.from.1),
        names.iter().map(place).collect(),
    )
}

#[test]
fn legends_wrap_above_their_panel_and_long_ones_stand_beside_it() {
    for count in [8, 30] {
        let (width, (right, top), places) = legend(count);
        for (index, (x, y)) in places.iter().enumerate() {
            assert!(x + 6.0 * 27.0 <= width);
            let is_free =
                |other: &(f64, f64)| (other.1 - y).abs() > 12.0 || (other.0 - x).abs() > 160.0;
            assert!(places[..index].iter().all(is_free), "{places:?}");
            assert!(if count == 8 { *y < top } else { *x > right });
        }
    }
}

#[test]
fn letters_beside_marks_make_room_for_each_other() {
    let mut plot = Plot::new("p", Axis::log("n"), Axis::log("e"));
    let points = (0..9).map(|k| Point::new(f64::from(k) / 90.0, 0.0, "a").tagged(k.to_string()));
    plot.series.push(Series::marks("front", points));
    let elements = read(&svg::figure(&Figure::new("", "f", [plot])));
    let places: Vec<(f64, f64)> = all(&elements, "text", "tag")
        .iter()
        .map(|e| (e.number("x"), e.number("y")))
        .collect();
    assert_eq!(places.len(), 9);
    for (index, (x, y)) in places.iter().enumerate() {
        let is_free =
            |other: &(f64, f64)| (other.1 - y).abs() >= 12.0 || (other.0 - x).abs() >= 7.0;
        assert!(places[..index].iter().all(is_free), "{places:?}");
    }
}

#[test]
fn text_is_escaped_and_has_no_signs_that_xml_lacks() {
    let plot = Plot::new("x\u{1}<y>", Axis::log("n"), Axis::log("e"));
    let svg = svg::figure(&Figure::new("", "a<b & \"c\" \u{0}\u{7}", [plot]));
    assert!(svg.contains("<title>a&lt;b &amp; &quot;c&quot; </title>"));
    assert!(texts(&svg).contains(&"x<y>: nothing to draw".into()));
}

/// Rows of bits, with digits as shades.
fn map(caption: &str, most: f64, rows: &[(&str, [Option<f64>; 3])]) -> Table {
    let columns = [
        Column::number("bits"),
        Column::number("8"),
        Column::number("16"),
        Column::number("32"),
    ];
    let cell = |digits: &Option<f64>| match digits {
        Some(digits) => Cell::number(format!("{digits:.1}"), *digits).shaded(digits / most),
        None => Cell::text("–"),
    };
    let rows = rows.iter().map(|(bits, cells)| {
        std::iter::once(Cell::text(*bits))
            .chain(cells.iter().map(cell))
            .collect()
    });
    Table::new(caption, columns).with(rows).named("digits")
}

fn files(blocks: impl IntoIterator<Item = Block>) -> Vec<(String, String)> {
    let mut document = Document::new("trial", "Trial", About::new(["volver"]));
    document.sections.push(Section::of("a", "A", blocks));
    svg::files(&document)
}

const ROWS: [(&str, [Option<f64>; 3]); 2] = [
    ("11", [Some(1.0), Some(2.5), None]),
    ("24", [Some(3.0), Some(5.0), Some(8.0)]),
];

#[test]
fn maps_are_darker_where_numbers_are_larger() {
    let files = files([Block::Table(map("Digits", 8.0, &ROWS))]);
    assert_eq!(files[0].0, "digits.svg");
    let elements = read(&files[0].1);
    let shades: Vec<f64> = all(&elements, "rect", "shade")
        .iter()
        .map(|cell| cell.number("fill-opacity"))
        .collect();
    assert_eq!(shades, [0.13, 0.31, 0.38, 0.63, 1.0]);
    let texts = texts(&files[0].1);
    // The rows, a missing figure, and the scale, which ends with the darkest.
    for text in [
        "Digits", "bits", "11", "24", "8", "16", "32", "2.5", "–", "0", "2", "4", "6",
    ] {
        assert!(texts.contains(&text.into()), "{text}: {texts:?}");
    }
    assert_eq!(all(&elements, "rect", "none").len(), 1);
}

#[test]
fn figures_on_shades_can_be_read() {
    let shares: Vec<f64> = (0..=100).map(f64::from).collect();
    let columns = shares
        .iter()
        .map(|share| Column::number(format!("{share}")));
    let cells = shares
        .iter()
        .map(|share| Cell::number("1", *share).shaded(share / 100.0));
    let table = Table::new("All", columns)
        .with([cells.collect()])
        .named("all");
    let svg = &files([Block::Table(table)])[0].1;
    let color = |rule: &str| -> Vec<f64> {
        let hex = svg.split(rule).nth(1).unwrap().split('#').nth(1).unwrap();
        let byte = |k: usize| f64::from(u8::from_str_radix(&hex[2 * k..2 * k + 2], 16).unwrap());
        (0..3).map(byte).collect()
    };
    let linear = |c: f64| {
        if c <= 0.04045 {
            c / 12.92
        } else {
            ((c + 0.055) / 1.055).powf(2.4)
        }
    };
    let light = |c: &[f64]| {
        let [r, g, b] = [0, 1, 2].map(|k| linear(c[k] / 255.0));
        0.2126 * r + 0.7152 * g + 0.0722 * b
    };
    let shade = color(".shade {");
    let mut share = 0.0;
    for element in read(svg) {
        if element.is("rect", "shade") {
            share = element.number("fill-opacity");
        } else if element.is("text", "figure") {
            let ink = if element.is("text", "on-high") {
                "text.on-high {"
            } else {
                "text.on-low {"
            };
            let ground: Vec<f64> = shade.iter().map(|c| 255.0 + share * (c - 255.0)).collect();
            let mut lights = [light(&color(ink)), light(&ground)];
            lights.sort_by(f64::total_cmp);
            let contrast = (lights[1] + 0.05) / (lights[0] + 0.05);
            assert!(contrast >= 4.5, "{contrast} at {share}");
        }
    }
}

#[test]
fn maps_of_a_file_stand_together() {
    let other = [("11", [Some(4.0); 3]), ("53", [Some(4.0); 3])];
    let tables = [
        map("First", 8.0, &ROWS),
        map("Second", 8.0, &ROWS),
        map("Third", 16.0, &other),
    ];
    let files = files(tables.map(Block::Table));
    assert_eq!(files.len(), 1);
    let elements = read(&files[0].1);
    let place = |text: &str| {
        let found = elements
            .iter()
            .find(|e| e.tag.starts_with("text") && e.text == text)
            .unwrap();
        (found.number("x"), found.number("y"))
    };
    // The same rows beside each other, with their names once; others below.
    assert_eq!(elements.iter().filter(|e| e.text == "24").count(), 1);
    assert!(place("Third").1 > place("Second").1 && place("Third").0 < place("Second").0);
    // Shades mean different numbers: no bar.
    assert!(files[0].1.contains("pale: little; dark: much"));
}

#[test]
fn what_has_a_safe_name_and_readers_has_a_file() {
    let figure = |name: &str| Block::Figure(Figure::new(name, "c", []));
    let plain = Table::new("t", [Column::text("a")]).named("plain");
    let names: Vec<String> = files([
        figure("parts-a"),
        figure(""),
        figure("../../a"),
        figure("page").only(Medium::Page),
        figure("terminal").only(Medium::Terminal),
        Block::Table(plain),
    ])
    .into_iter()
    .map(|(name, _)| name)
    .collect();
    assert_eq!(names, ["parts-a.svg", "page.svg"]);
}
