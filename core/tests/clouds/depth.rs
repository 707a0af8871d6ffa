use super::cloud_samples::*;
use boxwright_core::cloud::{read_depth_png, DepthDecode, Distortion, Intrinsics};
use boxwright_core::geometry::Vec3;

#[test]
fn pixels_become_points_of_the_optical_frame() {
    let cloud = read_depth_png(&depth_png(8, 4, &depths()), &camera(), DECODING, &PLAIN).unwrap();
    assert_eq!((cloud.width, cloud.height, cloud.viewpoint), (8, 4, Some(Vec3::zeros())));
    assert!(cloud.points[5].iter().all(|c| c.is_nan()));
    let z = depths()[19] as f64 * 1e-3; // pixel (3, 2)
    let wanted = [(3.0 - 3.5) / 10.0 * z, (2.0 - 1.5) / 12.0 * z, z];
    assert!((0..3).all(|axis| (f64::from(cloud.points[19][axis]) - wanted[axis]).abs() < 1e-6));
}

#[test]
fn rotated_bits() {
    let turned: Vec<u16> = depths().iter().map(|&d| (u32::from(d) * 8 % 65536) as u16 + d / 8192).collect();
    let plain = read_depth_png(&depth_png(8, 4, &depths()), &camera(), DepthDecode::Plain, &PLAIN).unwrap();
    let rotated = read_depth_png(&depth_png(8, 4, &turned), &camera(), DepthDecode::Rotate3, &PLAIN).unwrap();
    assert_eq!(super::bits(&plain.points), super::bits(&rotated.points));
}

#[test]
fn distortion_is_undone() {
    let lens = Distortion([0.12, -0.25, 0.003, -0.002, 0.08]);
    let bent = Intrinsics { distortion: lens, ..camera() };
    let cloud = read_depth_png(&depth_png(8, 4, &depths()), &bent, DECODING, &PLAIN).unwrap();
    for (k, &[x, y, z]) in cloud.points.iter().enumerate().filter(|(k, _)| *k != 5) {
        let [u, v] = lens.apply([f64::from(x / z), f64::from(y / z)]);
        let pixel = [u * 10.0 + 3.5, v * 12.0 + 1.5];
        assert!((pixel[0] - (k % 8) as f64).abs() < 1e-5 && (pixel[1] - (k / 8) as f64).abs() < 1e-5, "{k}: {pixel:?}");
    }
}

#[test]
fn what_does_not_fit_is_named() {
    let png = depth_png(8, 4, &depths());
    let refusal = |bytes: &[u8], camera: Intrinsics| {
        read_depth_png(bytes, &camera, DECODING, &PLAIN).expect_err("must be refused").to_string()
    };
    let cases = [
        (refusal(&png, Intrinsics { size: Some((640, 480)), ..camera() }), "the intrinsics are for 640 x 480"),
        (refusal(&png, Intrinsics { fx: 0.0, ..camera() }), "fx: is 0; must be a positive number"),
        (refusal(&png, Intrinsics { cy: f64::NAN, ..camera() }), "cy: is NaN; must be finite"),
        (refusal(&png, Intrinsics { depth_unit_m: -1.0, ..camera() }), "depth_unit_m: is -1"),
        (refusal(&png, Intrinsics { depth_unit_m: 1.0, ..camera() }), "is depth_unit_m (--depth-unit-m) right?"),
        (refusal(&png, Intrinsics { depth_unit_m: 1e-9, ..camera() }), "is depth_unit_m (--depth-unit-m) right?"),
        (
            refusal(&png, Intrinsics { distortion: Distortion([-40.0, 0.0, 0.0, 0.0, 0.0]), ..camera() }),
            "cannot be undone",
        ),
        (refusal(&png[..png.len() / 2], camera()), "the PNG cannot be decoded"),
        (refusal(&pcd_ascii(), camera()), "the file is not a PNG image"),
    ];
    for (message, wanted) in cases {
        assert!(message.contains(wanted) && !message.contains('\n'), "{wanted}: {message}");
    }
}

#[test]
fn a_colour_image_and_a_huge_one() {
    let mut color = Vec::new();
    let encoder = png::Encoder::new(&mut color, 2, 2);
    encoder.write_header().unwrap().write_image_data(&[0; 4]).unwrap();
    let message = read_depth_png(&color, &camera(), DECODING, &PLAIN).unwrap_err().to_string();
    assert!(message.contains("must be grey of 16 bits"), "{message}");

    let mut huge = depth_png(8, 4, &depths());
    huge[16..24].copy_from_slice(&[0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff]);
    let any = Intrinsics { size: None, ..camera() };
    assert!(read_depth_png(&huge, &any, DECODING, &PLAIN).is_err());
}
