use super::cloud_samples::*;
use super::{bits, refusal};
use boxwright_core::cloud::{read_cloud, Cloud, Format};
use boxwright_core::geometry::Vec3;

fn read(bytes: &[u8]) -> Cloud {
    read_cloud(bytes, Format::Npy, &PLAIN).unwrap()
}

/// Indices of the values of an array (rows, columns, 3) as Fortran order writes them.
fn fortran(rows: usize, columns: usize) -> Vec<usize> {
    (0..3)
        .flat_map(|axis| (0..columns).flat_map(move |u| (0..rows).map(move |v| (v * columns + u) * 3 + axis)))
        .collect()
}

#[test]
fn every_type_order_and_shape() {
    let flat = POINTS.as_flattened();
    let mut cases = 0;
    for (rows, columns, shape) in [(6, 1, "(6, 3)"), (2, 3, "(2, 3, 3)"), (6, 1, "(6, 1, 3)"), (1, 6, "(1, 6, 3)")] {
        for (order, indices) in [("False", (0..18).collect()), ("True", fortran(rows, columns))] {
            let values = || indices.iter().map(|&k| flat[k]);
            let files = [
                npy("<f4", order, shape, &values().flat_map(f32::to_le_bytes).collect::<Vec<u8>>()),
                npy(">f4", order, shape, &values().flat_map(f32::to_be_bytes).collect::<Vec<u8>>()),
                npy("<f8", order, shape, &values().flat_map(|v| f64::from(v).to_le_bytes()).collect::<Vec<u8>>()),
                npy(">f8", order, shape, &values().flat_map(|v| f64::from(v).to_be_bytes()).collect::<Vec<u8>>()),
            ];
            for file in files {
                let cloud = read(&file);
                assert_eq!(bits(&cloud.points), bits(&POINTS), "{shape} {order}");
                let organized = shape == "(2, 3, 3)";
                assert_eq!((cloud.width, cloud.height), if organized { (3, 2) } else { (6, 1) });
                assert_eq!(cloud.viewpoint, organized.then(Vec3::zeros));
                cases += 1;
            }
        }
    }
    assert_eq!(cases, 32);
}

#[test]
fn an_empty_array() {
    assert_eq!(read(&npy("<f4", "False", "(0, 3)", &[])).points.len(), 0);
}

#[test]
fn what_does_not_fit() {
    let zeros = [0u8; 72];
    let cases = [
        (npy("<f4", "False", "(7, 3)", &zeros), "the shape [7, 3] does not fit the 72 bytes"),
        (npy("<f4", "False", "(5, 3)", &zeros), "does not fit"),
        (npy("<f4", "False", "(9223372036854775807, 9223372036854775807, 3)", &zeros), "does not fit"),
        (npy("<f4", "False", "(99999999999999999999, 3)", &zeros), "shape holds what is no whole number"),
        (npy("<f4", "False", "(18,)", &zeros), "must be (points, 3) or (rows, columns, 3)"),
        (npy("<f4", "False", "()", &zeros), "shape has 0 axes"),
        (npy("<f4", "Maybe", "(6, 3)", &zeros), "neither True nor False"),
        (npy("|O", "False", "(6, 3)", &zeros), "the values are of type \"|O\"; must be float32 or float64"),
        (npy("<f4', 'x': '", "False", "(6, 3)", &zeros), "unknown key \"x\""),
    ];
    for (file, wanted) in cases {
        let message = refusal(&file, Format::Npy);
        assert!(message.contains(wanted), "{wanted}: {message}");
    }
}

#[test]
fn truncation_anywhere_is_an_error_with_its_place() {
    let file = npy_image();
    for length in 1..file.len() {
        let message = refusal(&file[..length], Format::Npy);
        assert!(message.contains("byte"), "{message}");
    }
}
