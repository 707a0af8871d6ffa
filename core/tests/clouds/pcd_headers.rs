//! What a PCD header may and may not say.

use super::refusal;
use boxwright_core::cloud::{read_cloud, Format, ReadOptions};
use boxwright_core::geometry::Vec3;

use super::cloud_samples::PLAIN;

fn file(layout: &str, points: usize) -> Vec<u8> {
    let body: String = (0..points).map(|k| format!("{k} 1 2\n")).collect();
    format!("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n{layout}\nDATA ascii\n{body}").into_bytes()
}

#[test]
fn sizes_that_can_only_be_meant_one_way() {
    let cases = [
        ("WIDTH 3\nHEIGHT 2\nPOINTS 6", 6, (3, 2)),
        ("WIDTH 3\nHEIGHT 2", 6, (3, 2)),
        ("WIDTH 6\nPOINTS 6", 6, (6, 1)),
        ("WIDTH 6", 6, (6, 1)),
        ("POINTS 6", 6, (6, 1)),
        ("WIDTH 0\nHEIGHT 0\nPOINTS 6", 6, (6, 1)),
        ("WIDTH 0\nHEIGHT 1\nPOINTS 6", 6, (6, 1)),
        ("WIDTH 0\nHEIGHT 2\nPOINTS 6", 6, (3, 2)),
        ("WIDTH 3\nHEIGHT 0\nPOINTS 6", 6, (3, 2)),
        ("WIDTH 1\nHEIGHT 6\nPOINTS 6", 6, (6, 1)),
        ("WIDTH 0\nHEIGHT 1\nPOINTS 0", 0, (0, 1)),
        ("WIDTH 0\nHEIGHT 0\nPOINTS 0", 0, (0, 1)),
    ];
    for (layout, points, wanted) in cases {
        let cloud = read_cloud(&file(layout, points), Format::Pcd, &PLAIN).unwrap();
        assert_eq!((cloud.width, cloud.height), wanted, "{layout}");
        assert_eq!(cloud.points.len(), points);
        assert_eq!(cloud.viewpoint.is_some(), cloud.height > 1);
    }
}

#[test]
fn contradictions_and_lies() {
    let cases = [
        ("WIDTH 3\nHEIGHT 2\nPOINTS 7", "WIDTH 3, HEIGHT 2, POINTS 7; WIDTH * HEIGHT must be POINTS"),
        ("WIDTH 0\nHEIGHT 4\nPOINTS 6", "WIDTH 0, HEIGHT 4, POINTS 6"),
        ("HEIGHT 2", "neither WIDTH nor POINTS"),
        ("WIDTH 18446744073709551615\nHEIGHT 2", "WIDTH 18446744073709551615, HEIGHT 2, POINTS missing"),
        ("WIDTH 99999999999999999999999", "line 4: the value is no whole number"),
        ("WIDTH 4000000000\nHEIGHT 1000000000", "promises 4000000000000000000 points, but only 36 bytes follow"),
        ("WIDTH 6\nWIDTH 6", "line 5: the keyword is there twice"),
        ("WIDTH -6", "line 4: the value is no whole number"),
        ("WIDTH 6\nVERSION 0.8", "line 5: the version is not known; must be .5, .6 or .7"),
        ("WIDTH 6\nVIEWPOINT 0 0 0", "line 5: VIEWPOINT cannot be read; must be 7 numbers"),
        ("WIDTH 6\nVIEWPOINT nan 0 0 1 0 0 0", "line 5: VIEWPOINT cannot be read"),
        ("WIDTH 6\nCOLOUR red", "line 5: \"COLOUR red\" is no keyword"),
        ("WIDTH 6\nCOUNT 1 1", "header: 3 FIELDS but 2 values of COUNT"),
        ("WIDTH 6\nCOUNT 1 1 3", "header: field z has COUNT 3; must be 1"),
        ("WIDTH 6\nCOUNT 1 1 18446744073709551615", "field z has COUNT"),
    ];
    for (layout, wanted) in cases {
        let message = refusal(&file(layout, 6), Format::Pcd);
        assert!(message.contains(wanted), "{layout}: {message}");
    }
}

#[test]
fn fields_that_do_not_fit() {
    let cases = [
        ("x y\nSIZE 4 4\nTYPE F F", "there is no field z; a cloud needs the fields x, y and z"),
        ("x y z z\nSIZE 4 4 4 4\nTYPE F F F F", "field z is there twice"),
        ("x y z\nSIZE 4 4 2\nTYPE F F F", "field \"z\" has TYPE \"F\" SIZE \"2\""),
        ("x y z\nSIZE 4 4 4\nTYPE F F X", "TYPE must be I or U"),
        ("x y z\nTYPE F F F", "there is no SIZE line"),
        ("x y z\nSIZE 4 4 4", "there is no TYPE line"),
        ("x y z rgb\nSIZE 4 4 4 8\nTYPE F F F F", "field rgb: packed colour has 8 bytes; must have SIZE 4"),
        ("x y z n\nSIZE 4 4 4 8\nTYPE F F F F\nCOUNT 1 1 1 9223372036854775807", "more bytes than can be counted"),
    ];
    for (fields, wanted) in cases {
        let message = refusal(format!("FIELDS {fields}\nPOINTS 1\nDATA binary\n").as_bytes(), Format::Pcd);
        assert!(message.contains(wanted), "{fields}: {message}");
    }
}

#[test]
fn viewpoints() {
    let image = file("WIDTH 3\nHEIGHT 2\nVIEWPOINT 1 2 -3 0 1 0 0", 6);
    let list = file("WIDTH 6\nVIEWPOINT 1 2 -3 1 0 0 0", 6);
    let said = ReadOptions { viewpoint: Some(Vec3::new(4.0, 5.0, 6.0)), ..PLAIN };
    let viewpoint = |bytes: &[u8], options: &ReadOptions| read_cloud(bytes, Format::Pcd, options).unwrap().viewpoint;
    assert_eq!(viewpoint(&image, &PLAIN), Some(Vec3::new(1.0, 2.0, -3.0)));
    assert_eq!(viewpoint(&list, &PLAIN), None);
    assert_eq!(viewpoint(&image, &said), said.viewpoint);
    assert_eq!(viewpoint(&list, &said), said.viewpoint);
}
