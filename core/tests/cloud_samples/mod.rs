//! Hand-made files for the readers' tests, and a small compressor.
#![allow(dead_code)] // each test binary uses some of it

use boxwright_core::cloud::{DepthDecode, Distortion, Frame, Intrinsics, ReadOptions, Unit};

pub const PLAIN: ReadOptions = ReadOptions { unit: Unit::Metre, frame: Frame::Optical, viewpoint: None };

/// Six points of a 3 x 2 image, the second no reading.
pub const POINTS: [[f32; 3]; 6] = [
    [0.0, 0.25, 1.0],
    [f32::NAN, f32::NAN, f32::NAN],
    [0.5, -0.25, 2.0],
    [1.0, 2.0, 3.0],
    [-4.0, 5.0, 6.0],
    [7.0, 8.0, 9.5],
];
pub const COLORS: [[u8; 3]; 6] = [[0, 1, 2], [255, 254, 253], [10, 20, 30], [0, 0, 0], [255, 255, 255], [1, 128, 3]];
pub const LABELS: [u32; 6] = [0, 1, 20, 30, 65536, u32::MAX];

/// 0x00RRGGBB.
pub fn packed(rgb: [u8; 3]) -> u32 {
    u32::from_be_bytes([0, rgb[0], rgb[1], rgb[2]])
}

/// x y z rgb label, 3 x 2.
pub fn pcd_header(data: &str) -> String {
    format!(
        "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb label\nSIZE 4 4 4 4 4\nTYPE F F F U U\n\
         COUNT 1 1 1 1 1\nWIDTH 3\nHEIGHT 2\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 6\nDATA {data}\n"
    )
}

pub fn pcd_binary() -> Vec<u8> {
    let mut file = pcd_header("binary").into_bytes();
    for k in 0..6 {
        POINTS[k].iter().for_each(|c| file.extend(c.to_le_bytes()));
        file.extend(packed(COLORS[k]).to_le_bytes());
        file.extend(LABELS[k].to_le_bytes());
    }
    file
}

pub fn pcd_compressed() -> Vec<u8> {
    let mut arrays = Vec::new();
    for axis in 0..3 {
        POINTS.iter().for_each(|p| arrays.extend(p[axis].to_le_bytes()));
    }
    COLORS.iter().for_each(|&rgb| arrays.extend(packed(rgb).to_le_bytes()));
    LABELS.iter().for_each(|label| arrays.extend(label.to_le_bytes()));
    let mut file = pcd_header("binary_compressed").into_bytes();
    file.extend(lzf_block(&arrays));
    file
}

/// Both sizes, then the compressed bytes.
pub fn lzf_block(data: &[u8]) -> Vec<u8> {
    let block = lzf_compress(data);
    let sizes = [block.len() as u32, data.len() as u32];
    sizes.iter().flat_map(|size| size.to_le_bytes()).chain(block.iter().copied()).collect()
}

/// Greedy LZF by exhaustive search: slow, right by the format's description, and using every kind of token.
pub fn lzf_compress(data: &[u8]) -> Vec<u8> {
    let (mut out, mut literals, mut at) = (Vec::new(), Vec::new(), 0);
    while at < data.len() {
        let (length, distance) = longest_match(data, at);
        if length < 3 {
            literals.push(data[at]);
            at += 1;
            continue;
        }
        flush(&mut out, &mut literals);
        let (code, offset) = (length - 2, distance - 1);
        out.push(((code.min(7) << 5) | (offset >> 8)) as u8);
        if code >= 7 {
            out.push((code - 7) as u8);
        }
        out.push(offset as u8);
        at += length;
    }
    flush(&mut out, &mut literals);
    out
}

fn longest_match(data: &[u8], at: usize) -> (usize, usize) {
    let length = |start: usize| (0..264.min(data.len() - at)).take_while(|&k| data[start + k] == data[at + k]).count();
    (at.saturating_sub(8192)..at).map(|start| (length(start), at - start)).max().unwrap_or((0, 0))
}

fn flush(out: &mut Vec<u8>, literals: &mut Vec<u8>) {
    for run in literals.chunks(32) {
        out.push(run.len() as u8 - 1);
        out.extend(run);
    }
    literals.clear();
}

pub fn pcd_ascii() -> Vec<u8> {
    let mut file = pcd_header("ascii");
    for k in 0..6 {
        let [x, y, z] = POINTS[k];
        file += &format!("{x} {y} {z} {} {}\n", packed(COLORS[k]), LABELS[k]);
    }
    file.into_bytes()
}

/// Vertices with a list and an uneven layout, after another element with a list.
pub fn ply_binary(little: bool) -> Vec<u8> {
    let order = if little { "little" } else { "big" };
    let mut file = format!(
        "ply\nformat binary_{order}_endian 1.0\ncomment made by hand\nelement face 2\nproperty list uchar int vertex_indices\n\
         element vertex 6\nproperty uchar red\nproperty double x\nproperty float y\nproperty list ushort short marks\n\
         property float z\nproperty uchar green\nproperty uchar blue\nproperty uint label\nend_header\n"
    )
    .into_bytes();
    let mut put = |bytes: &[u8]| match little {
        true => file.extend(bytes),
        false => file.extend(bytes.iter().rev()),
    };
    put(&[0]);
    put(&[2]);
    put(&7i32.to_le_bytes());
    put(&8i32.to_le_bytes());
    for k in 0..6 {
        put(&[COLORS[k][0]]);
        put(&f64::from(POINTS[k][0]).to_le_bytes());
        put(&POINTS[k][1].to_le_bytes());
        put(&(k as u16).to_le_bytes());
        (0..k).for_each(|mark| put(&(mark as i16).to_le_bytes()));
        put(&POINTS[k][2].to_le_bytes());
        put(&[COLORS[k][1]]);
        put(&[COLORS[k][2]]);
        put(&LABELS[k].to_le_bytes());
    }
    file
}

pub fn ply_ascii() -> Vec<u8> {
    let mut file = String::from(
        "ply\r\nformat ascii 1.0\r\nelement face 1\r\nproperty list uchar int vertex_indices\r\nelement vertex 6\r\n\
         property float x\r\nproperty list uchar int marks\r\nproperty float y\r\nproperty float z\r\nproperty uchar red\r\n\
         property uchar green\r\nproperty uchar blue\r\nproperty uint label\r\nend_header\r\n3 0 1 2\r\n",
    );
    for k in 0..6 {
        let ([x, y, z], [r, g, b]) = (POINTS[k], COLORS[k]);
        file += &format!("{x} 2 5 6 {y} {z} {r} {g} {b} {}\r\n", LABELS[k]);
    }
    file.into_bytes()
}

/// Version 1.0, padded as numpy does.
pub fn npy(descr: &str, fortran: &str, shape: &str, values: &[u8]) -> Vec<u8> {
    let literal = format!("{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape}, }}");
    let padded = (10 + literal.len() + 1).div_ceil(64) * 64 - 10;
    let mut file = b"\x93NUMPY\x01\x00".to_vec();
    file.extend((padded as u16).to_le_bytes());
    file.extend(format!("{literal:<width$}\n", width = padded - 1).bytes());
    file.extend(values);
    file
}

pub fn npy_image() -> Vec<u8> {
    let values: Vec<u8> = POINTS.as_flattened().iter().flat_map(|c| c.to_le_bytes()).collect();
    npy("<f4", "False", "(2, 3, 3)", &values)
}

/// A grey PNG of 16 bits.
pub fn depth_png(width: usize, height: usize, values: &[u16]) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width as u32, height as u32);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Sixteen);
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_be_bytes()).collect();
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&bytes).unwrap();
    writer.finish().unwrap();
    file
}

/// An 8 x 4 camera in millimetres.
pub fn camera() -> Intrinsics {
    Intrinsics {
        fx: 10.0,
        fy: 12.0,
        cx: 3.5,
        cy: 1.5,
        size: Some((8, 4)),
        distortion: Distortion::NONE,
        depth_unit_m: 1e-3,
    }
}

pub const DECODING: DepthDecode = DepthDecode::Plain;

/// Depths of `camera`'s image, one pixel without a reading.
pub fn depths() -> Vec<u16> {
    (0..32).map(|k| if k == 5 { 0 } else { 900 + 17 * k }).collect()
}

/// Length below which a file is surely cut off: a number that lost its last digits is still one.
pub fn without_last_word(file: &[u8]) -> usize {
    let text = file.is_ascii();
    if text {
        file.iter().rposition(|&byte| byte == b' ').unwrap()
    } else {
        file.len()
    }
}
