//! A kernel put to the test: rows as they come, the rest behind them, and all of it in writing.

use volver::case::catalogue;
use volver::case::manufacture::manufacture;
use volver::convergence::{ErrorPart, Ladder, OrderInterval};
use volver::document::{About, Block, Document, Medium, Tone};
use volver::kernel::{Closure, Declaration, FormKind, KernelError, Quantity, Segments, Subject};
use volver::render::{markdown, terminal};
use volver::report::verify::{document, heading, json, junit, row, scattered_heading};
use volver::study::Silent;
use volver::study::verify::{
    Failure, Finding, Measured, Settings, Standing, Steps, Verification, verify,
};

/// By steps that divide the ray.
fn divided(ladder: &str) -> Settings {
    Settings {
        steps: Steps::Divide,
        ..Settings::new(&ladder.parse::<Ladder>().unwrap()).unwrap()
    }
}

fn about() -> About {
    About::new(["volver", "verify"])
}

/// Front to back, of (τ, C) at the front or in the middle of every segment.
fn composite(segments: &Segments, channel: usize, front: bool) -> f64 {
    let edges = &segments.edges;
    let samples = if front { edges } else { &segments.middles };
    let values = samples.extinction.iter().zip(&samples.emission[channel]);
    let (mut radiance, mut transmittance) = (0.0, 1.0);
    for ((extinction, emission), length) in values.zip(segments.lengths()) {
        let alpha = -(-extinction * length).exp_m1();
        radiance += transmittance * alpha * emission;
        transmittance *= 1.0 - alpha;
    }
    radiance
}

/// A kernel that declares middle samples, and takes them or those in front.
fn verification(cases: &[&str], ladder: &str, front: bool) -> Verification {
    let subjects = cases.iter().map(|name| {
        let channels = manufacture(&catalogue::find(name).unwrap().unwrap()).unwrap();
        let channels = channels.into_iter().map(|c| (c.channel, c.case)).collect();
        Subject::new(name, channels).unwrap()
    });
    let subjects: Vec<Subject> = subjects.collect();
    let declaration = Declaration {
        method: Some("front-to-back/middle/expm1".parse().unwrap()),
        ..Declaration::new("under test")
    };
    let mut kernel = Closure::new(declaration, |task, channel| {
        composite(task.cut().unwrap(), channel, front)
    });
    let settings = divided(ladder);
    verify(&mut kernel, &subjects, &settings, &Silent, &mut |_| ()).unwrap()
}

fn said(verification: &Verification, width: usize) -> String {
    terminal(&document(verification, &about()), width, false)
}

fn written(verification: &Verification) -> String {
    markdown(&document(verification, &about()))
}

/// All words in one line.
fn unwrapped(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn rows_are_set_in_columns_before_all_are_known() {
    let all = verification(&["cloud", "rgb-transfer", "vacuum"], "8..64", false);
    assert_eq!(all.lines.len(), 5);
    let head: Vec<char> = heading(80, false).trim_end().chars().collect();
    let place = |word: &str| heading(80, false).find(word).unwrap();
    for line in &all.lines {
        let row = row(line, Quantity::Radiance, 80, false);
        assert_eq!(row.lines().count(), 1, "{row}");
        let row: Vec<char> = row.trim_end().chars().collect();
        assert!(row.len() <= 80);
        assert_eq!(row[..2], ['✓', ' ']);
        for column in ["case", "order", "measured", "window", "errors", "verdict"] {
            let at = place(column);
            assert!(head[at - 1] == ' ' && row[at - 1] == ' ', "{row:?}");
        }
        let verdict: String = row[place("verdict")..].iter().collect();
        assert_eq!(verdict, line.measured.verdict().name());
        let name: String = row[place("case")..place("order")].iter().collect();
        assert_eq!(name.trim_end(), line.name);
    }
    // Colours are no columns.
    let painted = row(&all.lines[0], Quantity::Radiance, 80, true);
    assert!(
        painted.starts_with("\u{1b}[32m✓\u{1b}[0m cloud "),
        "{painted}"
    );
    assert!(painted.contains("\u{1b}[32mConfirmed\u{1b}[0m"));
    let plain = painted.replace("\u{1b}[32m", "").replace("\u{1b}[0m", "");
    assert_eq!(plain, row(&all.lines[0], Quantity::Radiance, 80, false));
    // Where they do not fit, columns go to further lines and nothing is lost.
    let narrow = row(&all.lines[0], Quantity::Radiance, 60, false);
    assert!(narrow.lines().count() == 2 && narrow.lines().all(|line| line.chars().count() <= 60));
    assert_eq!(
        unwrapped(&narrow),
        unwrapped(&row(&all.lines[0], Quantity::Radiance, 80, false))
    );
}

#[test]
fn bars_are_of_all_levels_as_far_as_there_is_room_and_of_the_finest() {
    let bars = |ladder: &str| -> Vec<char> {
        let all = verification(&["sine-squared"], ladder, false);
        let text = row(&all.lines[0], Quantity::Radiance, 80, false);
        let is_bar = |c: &char| ('▁'..='█').contains(c);
        text.chars().filter(is_bar).collect()
    };
    // One logarithm lower from level to level, in eight heights.
    assert_eq!(bars("8..64"), ['█', '▆', '▃', '▁']);
    let thirty: Vec<String> = (1..=30).map(|k| (8 * k).to_string()).collect();
    let many = bars(&thirty.join(","));
    assert!(many.len() == 8 && many[7] == '▁', "{many:?}");
    assert!(many.is_sorted_by(|coarse, fine| coarse >= fine), "{many:?}");
}

#[test]
fn what_failed_stands_below_its_row() {
    let mut all = verification(&["cloud"], "8..64", false);
    let line = &mut all.lines[0];
    let failure = |segments, how: &str| Failure {
        segments,
        error: KernelError::Exited {
            how: how.into(),
            stderr: String::new(),
        },
    };
    line.standing = Standing::Failed;
    line.failures = vec![
        failure(8, "was killed by signal 11"),
        failure(16, "was killed by signal 11"),
        failure(32, &"exited with code 3 ".repeat(6)),
        failure(64, "exited with code 4"),
        failure(128, "exited with code 5"),
    ];
    line.steady = false;
    let text = row(line, Quantity::Radiance, 80, false);
    assert!(text.starts_with("! cloud "), "{text}");
    assert!(text.lines().next().unwrap().ends_with(" failed"), "{text}");
    assert!(text.contains("\n    n = 8, 16: the kernel was killed by signal 11\n"));
    assert!(
        text.contains("\n    n = 32: the kernel exited with code 3 "),
        "{text}"
    );
    assert!(text.contains("\n    and 2 levels more\n"), "{text}");
    assert!(text.ends_with("\n    two answers to the coarsest level differ\n"));
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    assert!(row(line, Quantity::Radiance, 80, true).contains("\u{1b}[33m    n = 8, 16: "));
    // In writing there is room for all.
    let text = written(&all);
    for words in [
        "n = 8, 16: the",
        "n = 64: the kernel exited with code 4",
        "n = 128: the",
    ] {
        assert!(text.contains(&format!("- **cloud**: {words}")), "{text}");
    }
}

#[test]
fn a_terminal_that_has_shown_the_rows_is_told_the_rest() {
    let right = verification(&["cloud", "vacuum"], "8..64", false);
    let text = said(&right, 80);
    for row in ["vacuum", "Confirmed", "Exact", "measured", "window"] {
        assert!(!text.contains(row), "{row}: {text}");
    }
    assert!(
        text.contains("\n  samples in the middle of segments\n"),
        "{text}"
    );
    assert!(text.contains("\n✓ confirmed, ✗ contradicted, ? inconclusive, · blind, ! failed\n"));
    let last = "confirmed: 2 confirmed, 0 contradicted, 0 inconclusive, 0 blind of 2 channels";
    assert_eq!(text.lines().last(), Some(last));
    let painted = terminal(&document(&right, &about()), 80, true);
    assert!(
        painted.ends_with(&format!("\u{1b}[32m{last}\u{1b}[0m\n")),
        "{painted}"
    );
}

#[test]
fn values_of_another_method_are_said_to_be_so_everywhere() {
    let wrong = verification(&["cloud", "rgb-transfer", "sine-squared"], "8..128", true);
    let found = "place: samples lie at the front of segments, in place of: samples lie in the middle of \
                 segments";
    let only = "that is not what it declares: front-to-back/middle/expm1 gives these values in 0 of 5 \
                channels only";
    let text = said(&wrong, 80);
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    assert!(text.contains("\n! place: "), "{text}");
    for words in [found, only] {
        assert!(unwrapped(&text).contains(words), "{text}");
        assert!(junit(&wrong).contains(words));
        let (label, words) = words.split_once(": ").unwrap();
        let bold = format!("- **{label}**: {words}");
        assert!(written(&wrong).contains(&bold), "{}", written(&wrong));
    }
    let painted = terminal(&document(&wrong, &about()), 200, true);
    assert!(painted.contains("\u{1b}[31m! place: "), "{painted}");
    // In some channels both ends are dark, and samples in front are as good.
    let stand = |standing| {
        wrong
            .lines
            .iter()
            .filter(|l| l.standing == standing)
            .count()
    };
    let contradicted = stand(Standing::Contradicted);
    let counts = format!(
        "not confirmed: {} confirmed, {contradicted} contradicted, ",
        stand(Standing::Confirmed)
    );
    assert!(
        contradicted > 0 && unwrapped(&text).contains(&counts),
        "{text}"
    );
}

#[test]
fn many_channels_of_a_finding_are_counted_on_a_terminal_and_named_in_writing() {
    let mut all = verification(&["thick"], "8..64", false);
    let of = |count: usize| Finding {
        words: format!("seen in {count}"),
        channels: (0..count).map(|i| format!("channel-{i}")).collect(),
        wrong: true,
    };
    all.findings = vec![of(0), of(2), of(7)];
    let text = said(&all, 200);
    let written = written(&all);
    for (text, words) in [
        (&text, "! wrong: seen in 0 (-)\n"),
        (&text, "! wrong: seen in 2 (channel-0, channel-1)\n"),
        (&text, "! wrong: seen in 7 (7 channels)\n"),
        (
            &written,
            "- **wrong**: seen in 7 (channel-0, channel-1, channel-2, ",
        ),
    ] {
        assert!(text.contains(words), "{text}");
    }
    assert!(!written.contains("(7 channels)"), "{written}");
    assert!(junit(&all).contains("wrong: seen in 7 (channel-0, channel-1, "));
    // What does not speak against the kernel is not wrong.
    for finding in &mut all.findings {
        finding.wrong = false;
    }
    assert!(said(&all, 200).contains("\n! found: seen in 2 (channel-0, channel-1)\n"));
    assert!(!said(&all, 200).contains("wrong: "));
}

#[test]
fn blind_is_explained_where_it_occurs() {
    let mut all = verification(&["thick"], "8..64", false);
    let words = "blind: the case hides the leading error of what was declared\n";
    assert!(!said(&all, 80).contains(words));
    all.lines[0].standing = Standing::Blind;
    assert!(said(&all, 80).contains(words));
    // A table in writing says in every row how the channel stands.
    assert!(!written(&all).contains("· blind"));
    assert!(written(&all).contains("| thick | 2 | "));
}

fn figures(document: &Document) -> Vec<(&str, &str)> {
    let figures = document.blocks().filter_map(|block| match block {
        Block::Figure(figure) => Some((&figure.file[..], &figure.plots[0].title[..])),
        _ => None,
    });
    figures.collect()
}

#[test]
fn every_channel_with_errors_has_a_row_and_a_figure() {
    let all = verification(&["rgb-transfer", "vacuum"], "8..64", false);
    let document = document(&all, &about());
    let channels = ["red", "green", "blue"];
    let wanted = channels.map(|c| (format!("rgb-transfer-{c}"), format!("rgb-transfer/{c}")));
    let found = figures(&document);
    assert_eq!(found.len(), 3);
    for (file, title) in &wanted {
        assert!(found.contains(&(file, title)), "{found:?}");
        let text = markdown(&document);
        assert!(text.contains(&format!("![{title}]({file}.svg)")), "{text}");
        assert!(text.contains(&format!("\n| {title} | 2 | ")), "{text}");
    }
    let text = markdown(&document);
    assert!(text.contains("\n| vacuum | exact | - | - | "), "{text}");
    assert!(text.contains("| Exact | confirmed |\n"), "{text}");
    for fact in [
        "- **levels**: n = 8…64, d = D/n\n",
        "- **declared order**: none\n",
        "- **format**: f64\n",
    ] {
        assert!(text.contains(fact), "{text}");
    }
    assert_eq!(document.summary[0].value, "confirmed");
    let count = |name: &str| document.summary.iter().find(|fact| fact.name == name);
    assert_eq!(count("channels").unwrap().value, "4");
    assert_eq!(count("contradicted").unwrap().tone, None);
    assert_eq!(count("confirmed").unwrap().tone, Some(Tone::Good));
}

#[test]
fn nothing_found_has_no_section_of_its_own() {
    let mut all = verification(&["vacuum"], "8..64", false);
    (all.identification, all.findings) = (None, Vec::new());
    let document = document(&all, &about());
    let titles = |medium| {
        let shown = document.shown_in(&[medium]).into_iter();
        shown
            .map(|(section, _)| section.title.clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(titles(Medium::Written), ["Channels", "What was run"]);
    assert_eq!(titles(Medium::Terminal), ["Signs"]);
    assert!(!markdown(&document).contains("Signs"));
    assert_eq!(all.declaration.form, FormKind::Segments);
}

#[test]
fn whatever_a_kernel_says_is_text_in_junit() {
    let mut named = verification(&["vacuum"], "8..64", false);
    named.declaration.name = "a<b> & \"c\"\u{1b}[31m\u{0}".into();
    let text = junit(&named);
    assert!(
        text.contains("a&lt;b&gt; &amp; &quot;c&quot; [31m "),
        "{text}"
    );
}

/// Samples of C at one random place of every segment, from the seed: as good as any with scatter of order 3/2.
fn scattered() -> Verification {
    let subject = catalogue::find("sine-squared").unwrap().unwrap();
    let channels = manufacture(&subject).unwrap();
    let channels = channels.into_iter().map(|c| (c.channel, c.case)).collect();
    let subject = Subject::new("sine-squared", channels).unwrap();
    let declaration = Declaration {
        order: Some(1.5),
        stochastic: true,
        form: FormKind::Function,
        ..Declaration::new("under test")
    };
    let mut kernel = Closure::new(declaration, |task, channel| {
        let mut state = task.seed * 1_000_003 + task.segments;
        let mut emission = vec![0.0; task.subject.channels().len()];
        let (mut radiance, mut transmittance) = (0.0, 1.0);
        for i in 0..task.segments {
            // Knuth's MMIX generator, of which the upper half is random enough.
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let part = (state >> 32) as f64 / 32_f64.exp2();
            let extinction = task
                .subject
                .at((i as f64 + part) * task.step, &mut emission);
            let alpha = -(-extinction * task.step).exp_m1();
            radiance += transmittance * alpha * emission[channel];
            transmittance *= 1.0 - alpha;
        }
        radiance
    });
    let settings = divided("8..256");
    verify(&mut kernel, &[subject], &settings, &Silent, &mut |_| ()).unwrap()
}

#[test]
fn a_kernel_that_draws_has_two_orders_the_larger_error_first() {
    let mut all = scattered();
    let heading = scattered_heading(80, false);
    let shown = row(&all.lines[0], Quantity::Radiance, 80, false);
    let columns = |text: &str| -> Vec<String> {
        let text: Vec<char> = text.chars().collect();
        // Where the heading begins a column.
        [31, 45].map(|at| text[at..].iter().collect()).into()
    };
    assert!(
        columns(&heading)[0].starts_with("larger error  smaller "),
        "{heading}"
    );
    assert!(columns(&shown)[0].starts_with("s 1."), "{shown}");
    assert!(said(&all, 80).contains("s scatter: the standard deviation over seeds"));
    assert!(written(&all).contains("| scatter 1."), "{}", written(&all));

    let Measured::Scattered(fit) = &mut all.lines[0].measured else {
        panic!("random numbers scatter");
    };
    let interval = |order: f64, low: f64, high: f64| OrderInterval {
        order,
        low,
        high,
        log2_constant: 0.0,
        levels: 4,
    };
    fit.larger = ErrorPart::Bias;
    fit.deviation = Some(interval(1.5, 1.4, 1.6));
    fit.bias = Some(interval(0.2, f64::NEG_INFINITY, 0.875));
    let shown = row(&all.lines[0], Quantity::Radiance, 80, false);
    assert!(columns(&shown)[0].starts_with("b <0.9 "), "{shown}");
    assert!(columns(&shown)[1].starts_with("s 1.50±0.10 "), "{shown}");
    // Markdown escapes what HTML would take for a tag.
    assert!(written(&all).contains("0.9; scatter 1.500 ± 0.100 |"));
    // An end that is open has no half-width: the other part's is told.
    assert_eq!(all.lines[0].measured.order().unwrap().0, 1.5);
    assert!(json(&all).unwrap().contains("\"low\": null"));
}
