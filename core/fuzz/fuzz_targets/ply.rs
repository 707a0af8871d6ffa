#![no_main]

use boxwright_core::cloud::Format;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| boxwright_fuzz::check_reader(bytes, Format::Ply));
