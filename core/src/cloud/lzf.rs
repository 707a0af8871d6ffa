//! LZF decompression, as in Marc Lehmann's liblzf (the compression inside binary_compressed PCD).

use crate::error::{InputError, Result};

/// A run of three bytes stands for at most this many.
const LONGEST_MATCH: usize = 264;

/// Decompresses to exactly `size` bytes. Nothing is reserved before `size` is known to be possible: three bytes of input
/// stand for 264 of output at most.
pub(super) fn decompress(input: &[u8], size: usize) -> Result<Vec<u8>> {
    if size > input.len().saturating_mul(LONGEST_MATCH / 3) {
        return Err(InputError::new(format!("{} compressed bytes cannot hold {size}", input.len())));
    }
    let mut output = Vec::with_capacity(size);
    let mut at = 0;
    while at < input.len() {
        let control = usize::from(input[at]);
        at += 1;
        if control < 32 {
            let literal = input.get(at..at + control + 1).ok_or_else(|| broken(at, "a literal run is cut off"))?;
            reserve(&output, literal.len(), size, at)?;
            output.extend_from_slice(literal);
            at += literal.len();
        } else {
            let (length, distance, next) = read_match(input, at, control)?;
            reserve(&output, length, size, at)?;
            copy_match(&mut output, length, distance).ok_or_else(|| broken(at, "a match reaches before the start"))?;
            at = next;
        }
    }
    if output.len() == size {
        Ok(output)
    } else {
        Err(broken(at, &format!("the data end after {} of {size} bytes", output.len())))
    }
}

/// Length, distance and the place after a match whose control byte is `control`.
fn read_match(input: &[u8], mut at: usize, control: usize) -> Result<(usize, usize, usize)> {
    let cut_off = || broken(at, "a match is cut off");
    let mut length = (control >> 5) + 2;
    if control >> 5 == 7 {
        length += usize::from(*input.get(at).ok_or_else(cut_off)?);
        at += 1;
    }
    let low = usize::from(*input.get(at).ok_or_else(|| broken(at, "a match is cut off"))?);
    Ok((length, ((control & 0x1f) << 8 | low) + 1, at + 1))
}

fn reserve(output: &[u8], more: usize, size: usize, at: usize) -> Result<()> {
    if output.len() + more > size {
        return Err(broken(at, &format!("the data hold more than the {size} bytes announced")));
    }
    Ok(())
}

/// Appends `length` bytes from `distance` back; they may overlap what is being written.
fn copy_match(output: &mut Vec<u8>, length: usize, distance: usize) -> Option<()> {
    let start = output.len().checked_sub(distance)?;
    let mut left = length;
    while left > 0 {
        let piece = left.min(output.len() - start); // doubles with every turn where they overlap
        output.extend_from_within(start..start + piece);
        left -= piece;
    }
    Some(())
}

fn broken(at: usize, what: &str) -> InputError {
    InputError::new(what.to_string()).at(format!("compressed byte {at}"))
}
