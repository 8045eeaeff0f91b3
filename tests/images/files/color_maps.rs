//! Transfer functions as JSON, ours and ParaView's.

use super::Folder;
use volver::volume::file::{ColorMap, TransferFile, read_transfer, write_transfer};
use volver::volume::{ControlPoint, TransferFunction};

fn read(text: &str, map: &ColorMap) -> Result<(TransferFunction, f64), String> {
    let folder = Folder::new().with("a.json", text);
    read_transfer(&folder.path("a.json"), map).map_err(|error| error.trouble.to_string())
}

#[test]
fn ours_comes_back() {
    let point = |s, extinction, emission: [f64; 2]| ControlPoint {
        s,
        extinction,
        emission: emission.to_vec(),
    };
    let transfer = TransferFunction {
        channels: vec!["visible".into(), "infrared".into()],
        points: vec![
            point(-0.1, 0.3, [1.0 / 3.0, 5e-324]),
            // A jump.
            point(0.2, 1e300, [0.0, 1.0]),
            point(0.2, 0.0, [-1.0, 1.0]),
        ],
    };
    let folder = Folder::new();
    let path = folder.path("a.json");
    write_transfer(&path, &transfer).unwrap();
    assert_eq!(
        read_transfer(&path, &ColorMap::default()).unwrap(),
        (transfer, 0.0)
    );
    let schema = TransferFile::schema().to_string();
    assert!(
        schema.contains("extinction") && schema.contains("additionalProperties"),
        "{schema}"
    );
}

#[test]
fn ours_is_refused() {
    let right = r#"{"channels": ["r"], "points": [{"s": 0, "extinction": 1, "emission": [1]}, {"s": 1, "extinction": 1, "emission": [1]}]}"#;
    assert!(read(right, &ColorMap::default()).is_ok());
    for (from, to, word) in [
        ("\"s\": 1", "\"s\": -1", "point 1: s -1.0 behind 0.0"),
        (
            "\"extinction\": 1",
            "\"extinction\": -1",
            "an extinction of 0 or more",
        ),
        (
            "\"extinction\": 1",
            "\"opacity\": 1",
            "unknown field `opacity`",
        ),
        (
            "[1]}]",
            "[1, 2]}]",
            "point 1: 2 numbers of emission (allowed: 1",
        ),
        ("[\"r\"]", "[\"r\", \"r\"]", "each once"),
        ("[\"r\"]", "[]", "0 channels"),
        (
            "\"points\": [",
            "\"points\": [], \"more\": [",
            "unknown field `more`",
        ),
        ("\"s\": 0", "\"s\": 1e999", "number out of range"),
        ("}]}", "}]", "EOF"),
    ] {
        let said = read(&right.replacen(from, to, 1), &ColorMap::default()).unwrap_err();
        assert!(said.contains(word) && said.contains("(allowed: "), "{said}");
    }
    let three = right.replace("}]}", "}, {\"s\": 1, \"extinction\": 1, \"emission\": [1]}, {\"s\": 1, \"extinction\": 1, \"emission\": [1]}]}");
    assert!(
        read(&three, &ColorMap::default())
            .unwrap_err()
            .contains("at most two points of the same s")
    );
}

const MAP: &str = r#"[{"ColorSpace": "RGB", "Name": "a", "NanColor": [0.5, 0, 0],
    "RGBPoints": [0, 0, 0, 0.5, 2, 1, 0.25, 0.5], "Points": [0, 0.125, 0.25, 0, 1, 0.875, 0.5, 0, 4, 0.5, 0.5, 1]}]"#;

/// Opacity between the points of `MAP`: two straight pieces that meet at half the rise, a quarter of the way; then one.
fn opacity(s: f64) -> f64 {
    match s {
        s if s < 0.25 => 0.125 + s * 4.0 * 0.375,
        s if s < 1.0 => 0.5 + (s - 0.25) / 0.75 * 0.375,
        s if s < 4.0 => 0.875 - (s - 1.0) / 3.0 * 0.375,
        _ => 0.5,
    }
}

#[test]
fn opacities_become_extinctions_within_the_tolerance() {
    for tolerance in [1e-2, 1e-4, 1e-6] {
        let map = ColorMap {
            unit_length: 0.25,
            tolerance,
        };
        let (transfer, error) = read(MAP, &map).unwrap();
        let largest = -(1.0_f64 - 0.875).ln() / 0.25;
        assert!(error <= tolerance, "{error}");
        let mut worst = 0.0_f64;
        let mut emission = [0.0; 3];
        for i in 0..=100_000 {
            let s = f64::from(i) * 5e-5 - 0.1;
            let extinction = transfer.at(s, &mut emission);
            let wanted = -(1.0 - opacity(s.max(0.0))).ln() / 0.25;
            worst = worst.max((extinction - wanted).abs() / largest);
            let part = (s / 2.0).clamp(0.0, 1.0);
            for (seen, [from, to]) in emission.iter().zip([[0.0, 1.0], [0.0, 0.25], [0.5, 0.5]]) {
                assert!(
                    (seen - (from + part * (to - from))).abs() < 1e-14,
                    "{s}: {emission:?}"
                );
            }
        }
        // The error that is said holds, and is not far from what it is.
        assert!(
            worst <= error * (1.0 + 1e-6) + 1e-14 && worst > 0.3 * error,
            "{worst:e} {error:e}"
        );
        // Points grow by the root of 1/tolerance: two more digits, ten times as many.
        let expected = 3.0 / tolerance.sqrt();
        assert!(
            (transfer.points.len() as f64) < expected,
            "{} {expected}",
            transfer.points.len()
        );
    }
}

#[test]
fn color_maps_are_refused() {
    assert!(read(MAP, &ColorMap::default()).is_ok());
    for (from, to, word) in [
        (
            "0.25, 0, 1,",
            "0.25, 1, 1,",
            "VTK and vtk.js draw different curves",
        ),
        ("0.25, 0, 1,", "0.25, 0.5, 1,", "a sharpness of 0.5 at 0"),
        ("0.25, 0, 1,", "0, 0, 1,", "a midpoint of 0 at 0"),
        ("0.875", "1", "1 is an infinite extinction"),
        ("0.875", "-0.1", "an opacity of -0.1"),
        ("0, 4, 0.5", "0, 1, 0.5", "Points that do not rise"),
        ("0.5, 1]", "0.5]", "Points with 11 numbers"),
        ("\"RGB\"", "\"Lab\"", "ColorSpace 'Lab' (allowed: RGB"),
        ("\"Points\"", "\"Others\"", "Points with 0 numbers"),
        ("}]", "}, {}]", "one colour map"),
    ] {
        let text = MAP.replacen(from, to, 1);
        assert_ne!(text, MAP, "{from}");
        let said = read(&text, &ColorMap::default()).unwrap_err();
        assert!(said.contains(word), "{said}");
    }
    let map = ColorMap {
        unit_length: 0.0,
        tolerance: 1e-6,
    };
    assert!(
        read(MAP, &map)
            .unwrap_err()
            .contains("finite numbers above 0")
    );
    let map = ColorMap {
        tolerance: 1e-13,
        ..ColorMap::default()
    };
    assert!(
        read(MAP, &map)
            .unwrap_err()
            .contains("one that 65536 points reach")
    );
}
