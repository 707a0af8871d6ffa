#![no_main]

use boxwright_core::cloud::{read_depth_png, DepthDecode, Distortion, Intrinsics};
use boxwright_fuzz::{check, OPTIONS};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let distortion = Distortion([0.1, -0.2, 0.001, 0.002, 0.05]);
    let camera = Intrinsics { fx: 8.0, fy: 8.0, cx: 4.0, cy: 3.0, size: None, distortion, depth_unit_m: 1e-3 };
    check(read_depth_png(bytes, &camera, DepthDecode::Rotate3, &OPTIONS));
});
