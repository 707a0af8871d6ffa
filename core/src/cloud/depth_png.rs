//! 16-bit grey PNG images, to raw depth values.

use std::io::Cursor;

use png::{BitDepth, ColorType, Decoder, DecodingError, Limits, Reader, Transformations};

use crate::error::{InputError, Result};

/// Deflate cannot pack tighter than this, so a small file that promises a larger image lies.
const MOST_BYTES_PER_PACKED_BYTE: usize = 1032;
/// Pixels of the largest image: the finest depth cameras have a quarter of it.
const MOST_PIXELS: usize = 1 << 24;
/// What the decoder may set aside for rows and chunks of its own: far more than the rows of any sensor need.
const DECODER_BYTES: usize = 64 << 20;

/// Raw values as they are in the file; pixel (u, v) is `values[v * width + u]`.
pub(super) struct DepthImage {
    pub values: Vec<u16>,
    pub width: usize,
    pub height: usize,
}

/// Decodes a 16-bit grey PNG; columns and rows must be those of `wanted`, if it says any.
pub(super) fn decode(bytes: &[u8], wanted: Option<(usize, usize)>) -> Result<DepthImage> {
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: DECODER_BYTES });
    decoder.set_transformations(Transformations::IDENTITY);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let mut reader = decoder.read_info().map_err(broken)?;
    check_type(&reader)?;
    check_pixels(&reader, wanted)?;
    let size = checked_size(&reader, bytes.len())?;
    let mut raw = vec![0u8; size];
    let info = reader.next_frame(&mut raw).map_err(broken)?;
    let values = raw.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect();
    Ok(DepthImage { values, width: info.width as usize, height: info.height as usize })
}

fn check_type(reader: &Reader<Cursor<&[u8]>>) -> Result<()> {
    match reader.output_color_type() {
        (ColorType::Grayscale, BitDepth::Sixteen) => Ok(()),
        (color, depth) => Err(InputError::new(format!("the image is {color:?} of {} bits", depth as u8))
            .mend("a depth image must be grey of 16 bits (is this the colour image?)")),
    }
}

fn check_pixels(reader: &Reader<Cursor<&[u8]>>, wanted: Option<(usize, usize)>) -> Result<()> {
    let (width, height) = reader.info().size();
    let (width, height) = (width as usize, height as usize);
    let is_other = |(w, h): &(usize, usize)| (*w, *h) != (width, height);
    let mend = match wanted.filter(is_other) {
        Some((w, h)) => format!("the intrinsics are for {w} x {h}"),
        None if width.saturating_mul(height) > MOST_PIXELS => format!("must be at most {MOST_PIXELS} pixels"),
        None => return Ok(()),
    };
    Err(InputError::new(format!("the image is {width} x {height} pixels")).at("byte 16").mend(mend))
}

fn checked_size(reader: &Reader<Cursor<&[u8]>>, file_size: usize) -> Result<usize> {
    let (width, height) = reader.info().size();
    reader.output_buffer_size().filter(|&size| size / MOST_BYTES_PER_PACKED_BYTE <= file_size).ok_or_else(|| {
        InputError::new(format!("{file_size} bytes cannot hold the {width} x {height} pixels of the header"))
            .at("byte 16")
    })
}

fn broken(error: DecodingError) -> InputError {
    let text = error.to_string().replace(['\n', '\r'], " ");
    InputError::new(format!("the PNG cannot be decoded: {text}")).mend("is the file cut off?")
}
