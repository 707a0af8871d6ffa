//! Any bytes in any reader: an error or a sound cloud, no panic, and no more memory than the bytes there can mean.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use boxwright_core::cloud::{read_cloud, read_depth_png, Cloud, Format, Intrinsics};
use boxwright_core::error::Result;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

mod cloud_samples;
use cloud_samples::*;

/// Counts the bytes that each thread holds.
struct Counting;

thread_local! {
    static HELD: Cell<isize> = const { Cell::new(0) };
    static PEAK: Cell<isize> = const { Cell::new(0) };
}

fn count(change: isize) {
    let held = HELD.get() + change;
    HELD.set(held);
    PEAK.set(PEAK.get().max(held));
}

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as isize);
        System.alloc(layout)
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(-(layout.size() as isize));
        System.dealloc(pointer, layout);
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// The result, and the most bytes held on the way to it.
fn measured(read: impl FnOnce() -> Result<Cloud>) -> (Result<Cloud>, usize) {
    let before = HELD.get();
    PEAK.set(before);
    let result = read();
    (result, (PEAK.get() - before) as usize)
}

/// Room for the decoder's own state, whatever the file.
const FLOOR: usize = 256 << 10;
/// A byte of text or of binary fields may become a word of a header (16 bytes, in a growing list) or a third of a point.
const PLAIN_FACTOR: usize = 64;
/// LZF packs 88 to 1; a field of one byte becomes a coordinate of four.
const LZF_FACTOR: usize = 88 * 8;
/// Deflate packs 1032 to 1; two bytes of a pixel become two of the value and twelve of the point.
const DEFLATE_FACTOR: usize = 1032 * 8;

fn check(bytes: &[u8], format: Format) -> std::result::Result<(), TestCaseError> {
    let compressed = bytes.windows(6).any(|window| window == b"binary") && format == Format::Pcd;
    let factor = if compressed { LZF_FACTOR } else { PLAIN_FACTOR };
    check_result(measured(|| read_cloud(bytes, format, &PLAIN)), bytes.len(), factor)
}

fn check_depth(bytes: &[u8]) -> std::result::Result<(), TestCaseError> {
    for camera in [camera(), Intrinsics { size: None, ..camera() }] {
        let result = measured(|| read_depth_png(bytes, &camera, DECODING, &PLAIN));
        check_result(result, bytes.len(), DEFLATE_FACTOR)?;
    }
    Ok(())
}

fn check_result(
    (result, peak): (Result<Cloud>, usize),
    size: usize,
    factor: usize,
) -> std::result::Result<(), TestCaseError> {
    prop_assert!(peak <= FLOOR + factor * size, "{peak} bytes held for a file of {size}");
    match result {
        Err(error) => prop_assert!(!error.to_string().contains('\n'), "{error}"),
        Ok(cloud) => {
            prop_assert_eq!(cloud.points.len(), cloud.width * cloud.height);
            prop_assert!(cloud.colors.is_none_or(|colors| colors.len() == cloud.points.len()));
            prop_assert!(cloud.labels.is_none_or(|labels| labels.len() == cloud.points.len()));
        }
    }
    Ok(())
}

/// One change to a file.
#[derive(Debug, Clone)]
enum Edit {
    Flip(usize, u8),
    Cut(usize),
    Remove(usize, usize),
    Repeat(usize, usize),
    Insert(usize, Vec<u8>),
    /// The n-th number of the header becomes this text.
    Number(usize, &'static str),
}

fn edit() -> impl Strategy<Value = Edit> {
    let place = 0usize..4096;
    let numbers = [
        "0",
        "1",
        "2",
        "255",
        "65536",
        "4294967295",
        "4294967296",
        "9223372036854775807",
        "18446744073709551615",
        "-1",
        "nan",
        "x",
    ];
    prop_oneof![
        (place.clone(), 1u8..).prop_map(|(at, mask)| Edit::Flip(at, mask)),
        place.clone().prop_map(Edit::Cut),
        (place.clone(), 1usize..40).prop_map(|(at, length)| Edit::Remove(at, length)),
        (place.clone(), 1usize..40).prop_map(|(at, length)| Edit::Repeat(at, length)),
        (place, prop::collection::vec(any::<u8>(), 1..9)).prop_map(|(at, bytes)| Edit::Insert(at, bytes)),
        (0usize..40, prop::sample::select(numbers.to_vec())).prop_map(|(n, text)| Edit::Number(n, text)),
    ]
}

fn apply(mut file: Vec<u8>, edits: &[Edit]) -> Vec<u8> {
    for edit in edits {
        let within = |at: usize| at % (file.len() + 1);
        match edit {
            Edit::Flip(at, mask) => file.iter_mut().skip(*at % 2048).take(1).for_each(|byte| *byte ^= mask),
            Edit::Cut(at) => file.truncate(within(*at)),
            Edit::Remove(at, length) => drop(file.drain(within(*at)..(within(*at) + length).min(file.len()))),
            Edit::Repeat(at, length) => {
                let piece = file[within(*at)..(within(*at) + length).min(file.len())].to_vec();
                file.splice(within(*at)..within(*at), piece);
            }
            Edit::Insert(at, bytes) => drop(file.splice(within(*at)..within(*at), bytes.iter().copied())),
            Edit::Number(n, text) => replace_number(&mut file, *n, text),
        }
    }
    file
}

fn replace_number(file: &mut Vec<u8>, n: usize, text: &str) {
    let starts = |k: &usize| file[*k].is_ascii_digit() && (*k == 0 || !file[*k - 1].is_ascii_digit());
    if let Some(start) = (0..file.len()).filter(starts).nth(n) {
        let length = file[start..].iter().take_while(|byte| byte.is_ascii_digit()).count();
        file.splice(start..start + length, text.bytes());
    }
}

fn samples() -> Vec<(Format, Vec<u8>)> {
    vec![
        (Format::Pcd, pcd_ascii()),
        (Format::Pcd, pcd_binary()),
        (Format::Pcd, pcd_compressed()),
        (Format::Ply, ply_ascii()),
        (Format::Ply, ply_binary(true)),
        (Format::Ply, ply_binary(false)),
        (Format::Npy, npy_image()),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, rng_seed: RngSeed::Fixed(2011), ..ProptestConfig::default() })]

    #[test]
    fn changed_clouds(sample in prop::sample::select(samples()), edits in prop::collection::vec(edit(), 1..6)) {
        check(&apply(sample.1, &edits), sample.0)?;
    }

    #[test]
    fn changed_depth_images(edits in prop::collection::vec(edit(), 1..4)) {
        check_depth(&apply(depth_png(8, 4, &depths()), &edits))?;
    }

    #[test]
    fn changed_bodies_of_compressed_clouds(edits in prop::collection::vec(edit(), 1..6)) {
        let length = pcd_header("binary_compressed").len();
        let file = pcd_compressed();
        check(&[&file[..length], &apply(file[length..].to_vec(), &edits)].concat(), Format::Pcd)?;
    }

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        for (format, start) in [(Format::Pcd, &b""[..]), (Format::Pcd, b"FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n"), (Format::Ply, b"ply\n"), (Format::Npy, b"\x93NUMPY\x01\x00")] {
            check(&[start, &bytes].concat(), format)?;
        }
        check_depth(&[b"\x89PNG\r\n\x1a\n", &bytes[..]].concat())?;
    }
}

#[test]
fn a_binary_file_called_text_is_not_taken_apart_word_by_word() {
    for (format, start) in [(Format::Pcd, "FIELDS "), (Format::Pcd, ""), (Format::Ply, "ply\nproperty ")] {
        let file = [start.as_bytes(), &b"a ".repeat(1 << 20)].concat();
        let (result, peak) = measured(|| read_cloud(&file, format, &PLAIN));
        assert!(result.is_err() && peak < FLOOR, "{peak}");
    }
}

#[test]
fn a_block_that_claims_four_gigabytes() {
    let file =
        pcd_header("binary_compressed").replace("WIDTH 3", "WIDTH 107374182").replace("POINTS 6", "POINTS 214748364");
    let mut bytes = file.into_bytes();
    bytes.extend(4u32.to_le_bytes());
    bytes.extend((214_748_364u32.wrapping_mul(20)).to_le_bytes());
    bytes.extend([0, 1, 2, 3]);
    let (result, peak) = measured(|| read_cloud(&bytes, Format::Pcd, &PLAIN));
    assert!(result.is_err() && peak < FLOOR, "{peak}");
}
