//! Ladders as text, and their bounds.

use volver::convergence::{Ladder, LadderError, MAX_SEGMENTS};

fn parse(text: &str) -> Result<Ladder, LadderError> {
    text.parse()
}

#[test]
fn every_form_of_text_gives_its_levels_and_prints_back() {
    for (text, levels, printed) in [
        ("16", &[16][..], "16"),
        ("1", &[1], "1"),
        ("8..70", &[8, 16, 32, 64], "8..64"),
        ("8..5000x3", &[8, 24, 72, 216, 648, 1944], "8..1944x3"),
        ("9,18,37", &[9, 18, 37], "9,18,37"),
        ("9, 27, 81", &[9, 27, 81], "9..81x3"),
        ("5..5", &[5], "5"),
        (
            "1,281474976710656",
            &[1, 1 << 48],
            "1..281474976710656x281474976710656",
        ),
    ] {
        let ladder = parse(text).unwrap();
        assert_eq!(ladder.as_segments(), Some(levels), "{text}");
        assert_eq!(ladder.len(), levels.len());
        assert_eq!(ladder.to_string(), printed);
        assert_eq!(parse(printed), Ok(ladder));
    }
}

#[test]
fn steps_need_not_divide_the_ray() {
    let ladder = parse("d=0.3,0.11,1e-3").unwrap();
    assert_eq!(ladder.as_segments(), None);
    assert_eq!(
        ladder.steps_on(7.0),
        [(None, 0.3), (None, 0.11), (None, 1e-3)]
    );
    assert_eq!(ladder.to_string(), "d=0.3,0.11,0.001");
    assert_eq!(ladder.len(), 3);
    let segments = parse("2,5").unwrap();
    assert_eq!(segments.steps_on(2.0), [(Some(2), 1.0), (Some(5), 0.4)]);
}

#[test]
fn errors_name_the_value_and_what_is_allowed() {
    for (text, message) in [
        (
            "",
            "ladder '' has no known form (allowed: 16, 8..4096, 8..5000x3, 9,18,37 or d=0.3,0.11)",
        ),
        (
            "ten",
            "ladder 'ten' has no known form (allowed: 16, 8..4096, 8..5000x3, 9,18,37 or d=0.3,0.11)",
        ),
        (
            "-3",
            "ladder '-3' has no known form (allowed: 16, 8..4096, 8..5000x3, 9,18,37 or d=0.3,0.11)",
        ),
        (
            "d=0.3,x",
            "ladder 'd=0.3,x' has no known form (allowed: 16, 8..4096, 8..5000x3, 9,18,37 or d=0.3,0.11)",
        ),
        (
            "0",
            "0 segments are not allowed (allowed: 1 to 281474976710656)",
        ),
        (
            "281474976710657",
            "281474976710657 segments are not allowed (allowed: 1 to 281474976710656)",
        ),
        (
            "0..8",
            "0 segments are not allowed (allowed: 1 to 281474976710656)",
        ),
        (
            "8..281474976710657",
            "281474976710657 segments are not allowed (allowed: 1 to 281474976710656)",
        ),
        (
            "8..4",
            "4 segments after 8 are not allowed (allowed: strictly increasing)",
        ),
        (
            "8..64x1",
            "ratio 1 is not allowed (allowed: 2 to 281474976710656)",
        ),
        (
            "8..6 4",
            "'6 4' in ladder '8..6 4' is not allowed (allowed: 1 to 281474976710656 segments)",
        ),
        (
            "8..+64",
            "'+64' in ladder '8..+64' is not allowed (allowed: 1 to 281474976710656 segments)",
        ),
        (
            "8,16,16",
            "16 segments after 16 are not allowed (allowed: strictly increasing)",
        ),
        (
            "8,,16",
            "'' in ladder '8,,16' is not allowed (allowed: 1 to 281474976710656 segments)",
        ),
        (
            "0,1",
            "0 segments are not allowed (allowed: 1 to 281474976710656)",
        ),
        (
            "d=0.1,0.1",
            "step 0.1 is not allowed (allowed: finite, above 0, strictly decreasing)",
        ),
        (
            "d=0",
            "step 0 is not allowed (allowed: finite, above 0, strictly decreasing)",
        ),
        (
            "d=nan",
            "step NaN is not allowed (allowed: finite, above 0, strictly decreasing)",
        ),
        (
            "d=inf",
            "step inf is not allowed (allowed: finite, above 0, strictly decreasing)",
        ),
    ] {
        assert_eq!(parse(text).unwrap_err().to_string(), message, "{text}");
    }
}

#[test]
fn ladders_stop_at_their_bounds() {
    let finest = Ladder::geometric(8, 2, 46).unwrap();
    assert_eq!(finest.as_segments().unwrap().last(), Some(&(1 << 48)));
    for levels in [47, 64] {
        assert_eq!(
            Ladder::geometric(8, 2, levels),
            Err(LadderError::TooFine { levels })
        );
    }
    assert_eq!(
        Ladder::geometric(8, 2, 65),
        Err(LadderError::Count { levels: 65 })
    );
    assert_eq!(
        Ladder::geometric(0, 2, 3),
        Err(LadderError::Segments { n: 0 })
    );
    assert_eq!(
        Ladder::geometric(3, 1, 3),
        Err(LadderError::Ratio { ratio: 1 })
    );
    assert_eq!(
        Ladder::geometric(u64::MAX, 2, 1),
        Err(LadderError::Segments { n: u64::MAX })
    );
    assert_eq!(
        Ladder::geometric(3, MAX_SEGMENTS, 64),
        Err(LadderError::TooFine { levels: 64 })
    );
    assert!(Ladder::segments((1..=64).collect()).is_ok());
    assert_eq!(
        Ladder::segments((1..=65).collect()),
        Err(LadderError::Count { levels: 65 })
    );
    assert_eq!(Ladder::steps(vec![]), Err(LadderError::Count { levels: 0 }));
}
