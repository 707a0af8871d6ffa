//! Wrong units and wrong frames are refused; what may be meant is read.

use super::cloud_samples::{npy, PLAIN};
use boxwright_core::cloud::{read_cloud, Cloud, Format, Frame, ReadOptions, Unit};
use boxwright_core::error::Result;
use boxwright_core::geometry::Vec3;

/// A slanted patch `size` wide, `z` in front of the origin, 8 x 6 points.
fn patch(shape: &str, size: f32, z: f32) -> Vec<u8> {
    let point =
        |k: usize| [(k % 8) as f32 / 8.0 * size, (k / 8) as f32 / 8.0 * size, z * (1.0 + (k % 8) as f32 / 100.0)];
    npy("<f4", "False", shape, &(0..48).flat_map(point).flat_map(f32::to_le_bytes).collect::<Vec<u8>>())
}

fn image(size: f32, z: f32, options: &ReadOptions) -> Result<Cloud> {
    read_cloud(&patch("(6, 8, 3)", size, z), Format::Npy, options)
}

fn list(size: f32, z: f32, options: &ReadOptions) -> Result<Cloud> {
    read_cloud(&patch("(48, 3)", size, z), Format::Npy, options)
}

const MILLI: ReadOptions = ReadOptions { unit: Unit::Millimetre, ..PLAIN };
const OPENGL: ReadOptions = ReadOptions { frame: Frame::OpenGl, ..PLAIN };

#[test]
fn units() {
    for z in [0.07, 0.3, 1.0, 10.0, 40.0] {
        assert!(image(0.05, z, &PLAIN).is_ok(), "{z} m");
        assert!(image(50.0, z * 1e3, &MILLI).is_ok(), "{z} m in mm");
        assert!(image(50.0, z * 1e3, &PLAIN).unwrap_err().mend.contains("--unit mm"), "{z} m in mm");
    }
    for z in [0.07, 0.3, 1.0, 10.0] {
        assert!(image(0.05, z, &MILLI).unwrap_err().mend.contains("leave out --unit mm"), "{z} m called mm");
    }
    for size in [0.1, 1.0, 20.0] {
        assert!(list(size, -0.2, &PLAIN).is_ok());
        assert!(list(size * 1e3, -200.0, &MILLI).is_ok());
        assert!(list(size * 1e3, 200.0, &PLAIN).unwrap_err().mend.contains("--unit mm"));
        assert!(list(size, 0.2, &MILLI).unwrap_err().mend.contains("leave out"));
    }
}

#[test]
fn millimetres_become_metres_with_their_viewpoint() {
    let file = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 2\nVIEWPOINT 1000 0 0 1 0 0 0\nDATA ascii\n\
                100 200 900\nnan nan nan\n1 2 1500\n3 4 800\n";
    let cloud = read_cloud(file.as_bytes(), Format::Pcd, &MILLI).unwrap();
    assert_eq!(cloud.points[0], [0.1, 0.2, 0.9]);
    assert_eq!(cloud.viewpoint, Some(Vec3::new(1.0, 0.0, 0.0)));
}

#[test]
fn clouds_without_a_verdict_are_read() {
    let repeated = |value: f32, count: usize| {
        npy("<f4", "False", &format!("({count}, 3)"), &value.to_le_bytes().repeat(3 * count))
    };
    for options in [&PLAIN, &MILLI, &OPENGL] {
        for bytes in [repeated(f32::NAN, 100), repeated(1.0, 100), repeated(500.0, 3), repeated(0.0, 0)] {
            assert!(read_cloud(&bytes, Format::Npy, options).is_ok());
        }
    }
    let blank = npy("<f4", "False", "(2, 2, 3)", &f32::INFINITY.to_le_bytes().repeat(12));
    assert!(read_cloud(&blank, Format::Npy, &PLAIN).is_ok());
}

#[test]
fn frames() {
    assert!(image(0.5, 1.0, &PLAIN).is_ok());
    assert!(image(0.5, -1.0, &PLAIN).unwrap_err().mend.contains("--frame opengl"));
    assert_eq!(image(0.5, -1.0, &OPENGL).unwrap().points[0], [0.0, 0.0, -1.0], "coordinates stay");
    assert!(image(0.5, 1.0, &OPENGL).unwrap_err().mend.contains("leave out --frame opengl"));
    assert!(list(0.5, -1.0, &PLAIN).is_ok(), "an unorganized cloud may be in any frame");
}

/// A floor seen by a pinhole camera, 32 x 24 points, with x, y and z as told.
fn seen(told: impl Fn([f32; 3]) -> [f32; 3], options: &ReadOptions) -> Result<Cloud> {
    let point = |k: usize| {
        let (u, v) = ((k % 32) as f32 - 15.5, (k / 32) as f32 - 11.5);
        let z = 1.0 - 0.01 * v;
        told([u / 30.0 * z, v / 30.0 * z, z])
    };
    let bytes: Vec<u8> = (0..768).flat_map(point).flat_map(f32::to_le_bytes).collect();
    read_cloud(&npy("<f4", "False", "(24, 32, 3)", &bytes), Format::Npy, options)
}

#[test]
fn mirrored_images_are_refused_and_turned_ones_are_not() {
    let mirrored = |read: Result<Cloud>| read.is_err_and(|error| error.to_string().contains("is mirrored"));
    let mut cases = 0;
    for sign in [[1.0, 1.0], [-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0]] {
        let is_mirrored = sign[0] * sign[1] < 0.0;
        assert_eq!(mirrored(seen(|[x, y, z]| [sign[0] * x, sign[1] * y, z], &PLAIN)), is_mirrored, "{sign:?}");
        // OpenGL's camera looks along -z, with y upwards.
        assert_eq!(mirrored(seen(|[x, y, z]| [sign[0] * x, -sign[1] * y, -z], &OPENGL)), is_mirrored, "{sign:?}");
        // Turned by a quarter turn.
        assert_eq!(mirrored(seen(|[x, y, z]| [-sign[1] * y, sign[0] * x, z], &PLAIN)), is_mirrored, "{sign:?}");
        cases += 3;
    }
    assert_eq!(cases, 12);
    // A line of readings, or few, tell nothing.
    let nothing = [f32::NAN; 3];
    assert!(seen(|[x, y, z]| if (-0.02..0.0).contains(&y) { [x, -y, z] } else { nothing }, &PLAIN).is_ok());
}

#[test]
fn readings_nearer_or_farther_than_any_unit_puts_them_say_so() {
    let mend = |read: Result<Cloud>| read.unwrap_err().mend;
    assert!(mend(seen(|p| p.map(|c| 90.0 * c), &PLAIN)).contains("if they are millimetres"));
    assert!(mend(seen(|p| p.map(|c| 900.0 * c), &PLAIN)).contains("--unit mm"));
    assert!(mend(seen(|p| p.map(|c| 0.001 * c), &PLAIN)).contains("neither metres nor millimetres"));
}

#[test]
fn a_frame_that_is_not_the_cameras_may_have_any_z() {
    let header =
        |pose: &str| format!("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 2\nVIEWPOINT {pose}\nDATA ascii\n");
    let read =
        |pose: &str| read_cloud(format!("{}{}", header(pose), "1 1 -1\n".repeat(4)).as_bytes(), Format::Pcd, &PLAIN);
    assert!(read("0 0 0 1 0 0 0").is_err());
    assert!(read("0 0 2 1 0 0 0").is_ok());
    assert!(read("0 0 0 0 1 0 0").is_ok());
    let said = ReadOptions { viewpoint: Some(Vec3::new(0.0, 0.0, 3.0)), ..PLAIN };
    assert!(image(0.5, -1.0, &said).is_ok());
}
