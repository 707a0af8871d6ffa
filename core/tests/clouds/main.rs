//! Readers of clouds, by hand-made files.

#[path = "../cloud_samples/mod.rs"]
mod cloud_samples;

mod depth;
mod guards;
mod npy;
mod pcd;
mod pcd_headers;
mod ply;

use boxwright_core::cloud::{read_cloud, Cloud, Format};
use cloud_samples::{COLORS, LABELS, PLAIN, POINTS};

/// Bit for bit, so that NaN equals NaN.
fn bits(points: &[[f32; 3]]) -> Vec<u32> {
    points.as_flattened().iter().map(|c| if c.is_nan() { f32::NAN.to_bits() } else { c.to_bits() }).collect()
}

fn assert_samples(cloud: &Cloud) {
    assert_eq!(bits(&cloud.points), bits(&POINTS));
    assert_eq!(cloud.colors.as_deref(), Some(&COLORS[..]));
    assert_eq!(cloud.labels.as_deref(), Some(&LABELS[..]));
}

/// The one-line message of a file that must be refused.
fn refusal(bytes: &[u8], format: Format) -> String {
    let message = read_cloud(bytes, format, &PLAIN).expect_err("must be refused").to_string();
    assert!(!message.contains('\n'), "{message}");
    message
}

#[test]
fn another_formats_magic_is_named() {
    let ply = cloud_samples::ply_ascii();
    let png = cloud_samples::depth_png(2, 1, &[1, 2]);
    assert_eq!(
        refusal(&ply, Format::Pcd),
        "byte 0: the file is not a PCD file; it begins like a PLY file (.ply); its suffix must say so"
    );
    assert!(refusal(&png, Format::Npy).contains("a PNG image (.png)"));
    assert!(refusal(b"", Format::Pcd).contains("empty"));
    assert!(refusal(b"solid cube", Format::Ply).contains("solid"));
    assert!("stl".parse::<Format>().unwrap_err().to_string().contains("pcd ply npy"));
}
