use super::cloud_samples::*;
use super::{assert_samples, refusal};
use boxwright_core::cloud::{read_cloud, Format};

#[test]
fn every_encoding_gives_the_same_cloud() {
    for file in [ply_ascii(), ply_binary(true), ply_binary(false)] {
        let cloud = read_cloud(&file, Format::Ply, &PLAIN).unwrap();
        assert_samples(&cloud);
        assert_eq!((cloud.width, cloud.height, cloud.viewpoint), (6, 1, None));
    }
}

#[test]
fn other_colour_types() {
    let file = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n\
                property float red\nproperty float green\nproperty float blue\nend_header\n1 2 3 0 0.5 1\n1 2 3 1 1 0.1\n";
    let cloud = read_cloud(file.as_bytes(), Format::Ply, &PLAIN).unwrap();
    assert_eq!(cloud.colors.unwrap(), [[0, 128, 255], [255, 255, 26]]);
    let wide = file.replace("float red", "ushort red").replace("3 0 0.5 1", "3 65535 0.5 1");
    assert_eq!(read_cloud(wide.as_bytes(), Format::Ply, &PLAIN).unwrap().colors.unwrap()[0], [255, 128, 255]);
    assert!(
        refusal(file.replace("float red", "int red").as_bytes(), Format::Ply).contains("field red: colour is of type")
    );
}

#[test]
fn truncation_anywhere_is_an_error_with_its_place() {
    let mut cases = 0;
    for file in [ply_ascii(), ply_binary(true), ply_binary(false)] {
        for length in 1..without_last_word(&file) {
            let message = refusal(&file[..length], Format::Ply);
            assert!(["byte", "line", "header"].iter().any(|place| message.contains(place)), "{message}");
            cases += 1;
        }
    }
    assert!(cases > 1200, "{cases}");
}

#[test]
fn headers_that_lie_or_cannot_be_read() {
    let xyz = "property float x\nproperty float y\nproperty float z\n";
    let cases = [
        (format!("format ascii 1.0\nelement vertex 4000000000000\n{xyz}"), "promises 4000000000000 points"),
        (
            format!("format binary_little_endian 1.0\nelement vertex 4000000000000\n{xyz}"),
            "4000000000000 rows of element vertex",
        ),
        (
            format!("format binary_big_endian 1.0\nelement vertex 18446744073709551615\n{xyz}"),
            "18446744073709551615 rows",
        ),
        (
            format!("format binary_big_endian 1.0\nelement a 99999999999\nelement vertex 1\n{xyz}"),
            "1 rows of element vertex",
        ),
        (
            format!("format binary_big_endian 1.0\nelement a 9\nproperty list char int b\nelement vertex 1\n{xyz}"),
            "9 rows of element a",
        ),
        ("format ascii 1.0\nelement face 0\n".into(), "header: there is no element vertex"),
        (format!("element vertex 0\n{xyz}"), "there is no format line"),
        (format!("format ascii 1.0\nelement vertex 0\nelement vertex 0\n{xyz}"), "element vertex is there twice"),
        ("format ascii 2.0\n".into(), "line 2: \"format ascii 2.0\" is no line of a PLY header"),
        ("format ascii 1.0\nproperty float x\n".into(), "line 3: a property stands before any element"),
        ("format ascii 1.0\nelement vertex -1\n".into(), "line 3: element \"vertex\" is there \"-1\" times"),
        ("format ascii 1.0\nelement vertex 1\nproperty half x\n".into(), "line 4: \"half\" is no type of PLY"),
        ("format ascii 1.0\nelement vertex 1\nproperty list float int x\n".into(), "must be an integer type"),
        ("format ascii 1.0\nelement vertex 1\nproperty float x\n".into(), "there is no field y"),
    ];
    for (header, wanted) in cases {
        let message = refusal(format!("ply\n{header}end_header\n").as_bytes(), Format::Ply);
        assert!(message.contains(wanted), "{header}: {message}");
    }
}

#[test]
fn lists_of_negative_length() {
    let header = "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list char int i\nelement vertex 0\n\
                  property float x\nproperty float y\nproperty float z\nend_header\n";
    assert!(refusal(&[header.as_bytes(), &[0xff]].concat(), Format::Ply).contains("a list has a negative length"));
    assert!(refusal(&[header.as_bytes(), &[0x7f]].concat(), Format::Ply).contains("element face is cut off"));
}
