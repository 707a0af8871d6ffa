use super::cloud_samples::*;
use super::{assert_samples, bits, refusal};
use boxwright_core::cloud::{read_cloud, Cloud, Format, ReadOptions};
use boxwright_core::geometry::Vec3;

fn read(bytes: &[u8]) -> Cloud {
    read_cloud(bytes, Format::Pcd, &PLAIN).unwrap()
}

#[test]
fn every_encoding_gives_the_same_cloud() {
    for file in [pcd_ascii(), pcd_binary(), pcd_compressed()] {
        let cloud = read(&file);
        assert_samples(&cloud);
        assert_eq!((cloud.width, cloud.height, cloud.viewpoint), (3, 2, Some(Vec3::zeros())));
    }
}

#[test]
fn every_type_in_any_order_with_padding_and_vectors() {
    let types = [("I", 1), ("U", 1), ("I", 2), ("U", 2), ("I", 4), ("U", 4), ("I", 8), ("U", 8), ("F", 4), ("F", 8)];
    for (kind, size) in types {
        let number = |value: i32| match (kind, size) {
            ("F", 4) => (value as f32).to_le_bytes().to_vec(),
            ("F", 8) => f64::from(value).to_le_bytes().to_vec(),
            _ => i64::from(value).to_le_bytes()[..size].to_vec(),
        };
        let mut file = format!(
            "VERSION .5\nFIELDS _ z normal x _ y\nSIZE 1 {size} 4 {size} 2 {size}\nTYPE U {kind} F {kind} U {kind}\n\
             COUNT 3 1 3 1 2 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA binary\n"
        )
        .into_bytes();
        for [x, y, z] in [[1, 2, 3], [100, 50, 25]] {
            file.extend([9u8; 3]);
            file.extend(number(z));
            file.extend([7u8; 12]);
            file.extend(number(x));
            file.extend([8u8; 4]);
            file.extend(number(y));
        }
        assert_eq!(read(&file).points, [[1.0, 2.0, 3.0], [100.0, 50.0, 25.0]], "{kind}{size}");
    }
}

#[test]
fn colour_packed_as_float_and_rgba_and_negative_labels() {
    let color = [12u8, 200, 255];
    let float = f32::from_bits(packed(color));
    let header = |rgb: &str, kind: &str| {
        format!("FIELDS x y z {rgb} label\nSIZE 4 4 4 4 2\nTYPE F F F {kind} I\nWIDTH 1\nHEIGHT 1\nDATA ascii\n")
    };
    for (name, kind, text) in
        [("rgb", "F", format!("{float:e}")), ("rgba", "U", (packed(color) | 0x4000_0000).to_string())]
    {
        let cloud = read(format!("{}1 2 3 {text} -1\n", header(name, kind)).as_bytes());
        assert_eq!(cloud.colors.unwrap(), [color]);
        assert_eq!(cloud.labels.unwrap(), [u32::MAX]);
    }
}

#[test]
fn text_of_windows_in_any_case_with_every_nan() {
    let file =
        "# .PCD v.5\r\nversion .5\r\nfields X Y Z\r\nsize 4 4 4\r\ntype f f f\r\nwidth 2\r\nheight 2\r\npoints 4\r\n\
                Data ASCII\r\n1 2 3\r\n\r\nnan -nan NaN\r\n-1.#IND 1.#QNAN -nan(ind)\r\ninf -inf 1e400\r\n";
    let points = read(file.as_bytes()).points;
    assert_eq!(points[0], [1.0, 2.0, 3.0]);
    assert!(points[1..].iter().flatten().all(|c| !c.is_finite()));
    assert_eq!(points.len(), 4);
}

#[test]
fn binary_after_a_windows_header() {
    let unix = pcd_binary();
    let length = pcd_header("binary").len();
    let mut file = pcd_header("binary").replace('\n', "\r\n").into_bytes();
    file.extend(&unix[length..]);
    assert_samples(&read(&file));
}

#[test]
fn compressed_block_without_the_headers_padding() {
    let header =
        "FIELDS x _ y z\nSIZE 4 1 4 4\nTYPE F U F F\nCOUNT 1 4 1 1\nWIDTH 2\nHEIGHT 1\nDATA binary_compressed\n";
    let floats = |values: &[f32]| values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>();
    let bare = floats(&[1.0, 4.0, 2.0, 5.0, 3.0, 6.0]);
    let padded = [floats(&[1.0, 4.0]), vec![0; 8], floats(&[2.0, 5.0, 3.0, 6.0])].concat();
    for arrays in [bare, padded] {
        let file = [header.as_bytes(), &lzf_block(&arrays)].concat();
        assert_eq!(read(&file).points, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    }
}

#[test]
fn long_runs_and_noise_survive_compression() {
    let count = 3000u32;
    let value = |axis: u32, i: u32| match axis {
        0 => 1.5,
        1 => (i.wrapping_mul(2_654_435_761) >> 8) as f32,
        _ => (i / 300) as f32,
    };
    let arrays: Vec<u8> = (0..3).flat_map(|axis| (0..count).flat_map(move |i| value(axis, i).to_le_bytes())).collect();
    let header = format!("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH {count}\nHEIGHT 1\nDATA binary_compressed\n");
    let options = ReadOptions { viewpoint: Some(Vec3::new(0.0, 8e6, 0.0)), ..PLAIN };
    let refused = read_cloud(&[header.as_bytes(), &lzf_block(&arrays)].concat(), Format::Pcd, &options);
    assert!(refused.unwrap_err().mend.contains("--unit mm"), "the values are far apart; only the guard may object");
    let near: Vec<u8> = arrays
        .chunks_exact(4)
        .flat_map(|raw| (f32::from_le_bytes(raw.try_into().unwrap()) * 1e-6).to_le_bytes())
        .collect();
    let cloud = read(&[header.as_bytes(), &lzf_block(&near)].concat());
    let wanted: Vec<[f32; 3]> = (0..count).map(|i| [0, 1, 2].map(|axis| value(axis, i) * 1e-6)).collect();
    assert_eq!(bits(&cloud.points), bits(&wanted));
}

#[test]
fn truncation_anywhere_is_an_error_with_its_place() {
    let mut cases = 0;
    for file in [pcd_binary(), pcd_compressed(), pcd_ascii()] {
        for length in 1..without_last_word(&file) {
            let message = refusal(&file[..length], Format::Pcd);
            assert!(["byte", "line", "header"].iter().any(|place| message.contains(place)), "{message}");
            cases += 1;
        }
    }
    assert!(cases > 800, "{cases}");
}

#[test]
fn data_left_over_are_an_error_but_padding_is_none() {
    for file in [pcd_binary(), pcd_compressed(), pcd_ascii()] {
        let with = |tail: &[u8]| [&file[..], tail].concat();
        assert!(refusal(&with(b"more"), Format::Pcd).contains("more data after the 6 points"));
        assert_samples(&read(&with(b"\n\n")));
    }
    assert_samples(&read(&[&pcd_binary()[..], &[0; 512]].concat()));
}

#[test]
fn wrong_values_are_told_with_line_and_field() {
    let file = String::from_utf8(pcd_ascii()).unwrap();
    let line = |from: &str, to: &str| refusal(file.replace(from, to).as_bytes(), Format::Pcd);
    assert_eq!(line("0.5 -0.25", "0.5 abc"), "line 14: field y is \"abc\"; must be a number");
    assert!(line("65536\n", "65536 1\n").starts_with("line 16: the line has more values"));
    assert!(line(" 65536\n", "\n").starts_with("line 16: the line has too few values"));
    assert!(line(" 65536\n", " 1.5\n").contains("line 16: label is 1.5"));
}
