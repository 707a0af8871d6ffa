//! What every reader owes for any bytes: an error of one line, or a cloud whose arrays fit each other.

use boxwright_core::cloud::{read_cloud, Cloud, Format, Frame, ReadOptions, Unit};
use boxwright_core::error::Result;

pub const OPTIONS: ReadOptions = ReadOptions { unit: Unit::Metre, frame: Frame::Optical, viewpoint: None };

pub fn check_reader(bytes: &[u8], format: Format) {
    check(read_cloud(bytes, format, &OPTIONS));
}

pub fn check(result: Result<Cloud>) {
    match result {
        Err(error) => assert!(!error.to_string().contains(['\n', '\r']), "{error:?}"),
        Ok(cloud) => {
            assert_eq!(Some(cloud.points.len()), cloud.width.checked_mul(cloud.height));
            assert!(cloud.colors.is_none_or(|colors| colors.len() == cloud.points.len()));
            assert!(cloud.labels.is_none_or(|labels| labels.len() == cloud.points.len()));
        }
    }
}
