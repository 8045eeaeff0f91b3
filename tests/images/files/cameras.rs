//! Cameras as JSON and as glTF.

use super::Folder;
use volver::volume::file::{
    ReadCamera, View, read_camera, read_gltf_camera, write_camera, write_gltf_camera,
};
use volver::volume::{Camera, Lens};

fn camera(lens: Lens) -> Camera {
    Camera {
        position: [1.5, -2.0, 3.0],
        target: [0.25, 0.5, -1.0],
        up: [0.0, 1.0, 0.5],
        lens,
    }
}

/// Whether two cameras have the same rays, within a few units.
fn see_the_same(a: &Camera, b: &Camera) {
    for place in [[0.0, 0.0], [32.0, 24.0], [64.0, 48.0], [3.0, 40.0]] {
        let [a, b] = [a, b].map(|camera| camera.ray([64, 48], place).unwrap());
        for axis in 0..3 {
            let scale = 1.0 + b.origin[axis].abs();
            assert!(
                (a.origin[axis] - b.origin[axis]).abs() < 1e-15 * scale,
                "{a:?} {b:?}"
            );
            assert!(
                (a.direction[axis] - b.direction[axis]).abs() < 1e-15,
                "{a:?} {b:?}"
            );
        }
    }
}

#[test]
fn cameras_come_back() {
    let folder = Folder::new();
    let view = View {
        aspect: 4.0 / 3.0,
        depth: [0.5, 20.0],
    };
    for lens in [
        Lens::Orthographic { height: 2.5 },
        Lens::Perspective { angle: 0.7 },
    ] {
        let camera = camera(lens);
        write_camera(&folder.path("a.json"), &camera).unwrap();
        see_the_same(&read_camera(&folder.path("a.json")).unwrap(), &camera);
        write_gltf_camera(&folder.path("a.gltf"), &camera, &view).unwrap();
        let again = read_gltf_camera(&folder.path("a.gltf")).unwrap();
        see_the_same(&again.camera, &camera);
        assert!((again.aspect.unwrap() - view.aspect).abs() < 1e-15);
    }
    let none = View {
        aspect: 1.0,
        depth: [0.0, 1.0],
    };
    assert!(
        write_gltf_camera(
            &folder.path("b.gltf"),
            &camera(Lens::Orthographic { height: 1.0 }),
            &none
        )
        .is_ok()
    );
    let error = write_gltf_camera(
        &folder.path("c.gltf"),
        &camera(Lens::Perspective { angle: 1.0 }),
        &none,
    )
    .unwrap_err();
    assert!(error.to_string().contains("a depth above 0"), "{error}");
}

fn gltf(text: &str) -> Result<ReadCamera, String> {
    let folder = Folder::new().with("a.gltf", text);
    read_gltf_camera(&folder.path("a.gltf")).map_err(|error| error.trouble.to_string())
}

/// A camera below a node that turns by a right angle about z, makes all ten times as large, and moves it.
const BELOW: &str = r#"{"asset": {"version": "2.0"}, "nodes": [
    {"mesh": 0}, {"children": [2], "translation": [100000001, 0, 0], "scale": [10, 10, 10], "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476]},
    {"camera": 0, "translation": [0, 1, 2]}],
  "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}]}"#;

#[test]
fn nodes_above_move_a_camera() {
    let read = gltf(BELOW).unwrap();
    // (0, 1, 2) goes to (0, 10, 20), then to (−10, 0, 20), then on by 1e8 + 1, which binary32 has not.
    let [x, y, z] = read.camera.position;
    assert!(
        (x - 99_999_991.0).abs() < 1e-7 && y.abs() < 1e-14 && (z - 20.0).abs() < 1e-14,
        "{read:?}"
    );
    let [right, up, forward] = read.camera.axes().unwrap();
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15);
    assert!(
        near(right, [0.0, 1.0, 0.0]) && near(up, [-1.0, 0.0, 0.0]),
        "{right:?} {up:?}"
    );
    assert!(near(forward, [0.0, 0.0, -1.0]), "{forward:?}");
    assert_eq!(
        (read.camera.lens, read.aspect),
        (Lens::Perspective { angle: 0.5 }, None)
    );
    let wide = BELOW.replace(
        "perspective\": {\"yfov\": 0.5",
        "orthographic\": {\"xmag\": 3, \"ymag\": 2, \"zfar\": 9",
    );
    let read = gltf(&wide).unwrap();
    assert_eq!(
        (read.camera.lens, read.aspect),
        (Lens::Orthographic { height: 4.0 }, Some(1.5))
    );
}

#[test]
fn cameras_are_refused() {
    for (from, to, word) in [
        (
            "\"camera\": 0",
            "\"mesh\": 1",
            "0 nodes with a camera (allowed: one)",
        ),
        ("\"mesh\": 0", "\"camera\": 0", "2 nodes with a camera"),
        ("\"camera\": 0", "\"camera\": 1", "an index into cameras"),
        ("\"mesh\": 0", "\"children\": [2]", "nodes that are a tree"),
        (
            "\"camera\": 0",
            "\"camera\": 0, \"children\": [1]",
            "nodes that are a tree",
        ),
        ("[10, 10, 10]", "[10, 10, -10]", "right-handed"),
        ("[10, 10, 10]", "[10, 10, 0]", "right-handed"),
        ("0.7071067811865476]", "1]", "a quaternion of length 1"),
        ("\"yfov\": 0.5", "\"yfov\": 4", "below 180 degrees"),
        (
            "\"translation\": [0, 1, 2]",
            "\"matrix\": [1,0,0,0, 0.5,1,0,0, 0,0,1,0, 0,0,0,1]",
            "orthogonal, right-handed",
        ),
        (
            "\"translation\": [0, 1, 2]",
            "\"matrix\": [1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]",
            "as its last row",
        ),
    ] {
        let text = BELOW.replacen(from, to, 1);
        assert_ne!(text, BELOW, "{from}");
        let said = gltf(&text).unwrap_err();
        assert!(said.contains(word) && said.contains("(allowed: "), "{said}");
    }
    // Scale along the axes of a rotation leaves them orthogonal; the camera's own axes are what matter.
    let squeezed = BELOW.replace("[10, 10, 10]", "[10, 20, 5]");
    assert!(gltf(&squeezed).is_ok());
    let right = r#"{"position": [0, 0, 5], "target": [0, 0, 0], "up": [0, 1, 0], "orthographic": {"height": 2}}"#;
    let ours = |text: &str| {
        let folder = Folder::new().with("a.json", text);
        read_camera(&folder.path("a.json")).map_err(|error| error.trouble.to_string())
    };
    assert!(ours(right).is_ok());
    for (from, to, word) in [
        ("[0, 1, 0]", "[0, 0, 1]", "up across the line of sight"),
        ("[0, 0, 5]", "[0, 0, 0]", "a target that is not its place"),
        ("\"height\": 2", "\"height\": 0", "a height above 0"),
        ("\"height\": 2", "\"width\": 2", "unknown field `width`"),
        (
            "}}",
            "}, \"perspective\": {\"angle_degrees\": 30}}",
            "one of orthographic and perspective",
        ),
        (
            "orthographic\": {\"height\": 2",
            "perspective\": {\"angle_degrees\": 180",
            "below 180 degrees",
        ),
    ] {
        let said = ours(&right.replacen(from, to, 1)).unwrap_err();
        assert!(said.contains(word) && said.contains("(allowed: "), "{said}");
    }
}
