//! Steim-1 and Steim-2 (SEED manual, version 2.4, appendix B): differences in
//! frames of sixteen words, of which the first says how the others are packed.

const FRAME: usize = 64;

/// Bits and number of the differences in a word.
fn packing(version: u8, code: u32, word: u32) -> Option<(u32, u32)> {
    match (version, code, word >> 30) {
        (_, 0, _) => Some((0, 0)),
        (_, 1, _) => Some((8, 4)),
        (1, 2, _) => Some((16, 2)),
        (1, 3, _) => Some((32, 1)),
        (2, 2, 1) => Some((30, 1)),
        (2, 2, 2) => Some((15, 2)),
        (2, 2, 3) => Some((10, 3)),
        (2, 3, 0) => Some((6, 5)),
        (2, 3, 1) => Some((5, 6)),
        (2, 3, 2) => Some((4, 7)),
        _ => None,
    }
}

/// The word with its first difference highest: bytes and halves stand in the order
/// of the file, in little-endian words too; smaller parts only in whole words.
fn in_file_order(word: u32, bits: u32, big: bool) -> u32 {
    match bits {
        8 if !big => word.swap_bytes(),
        16 if !big => word.rotate_left(16),
        _ => word,
    }
}

/// Appends `count` samples; whether words behind them hold more. The error is the offset in
/// `bytes` and what is wrong.
pub(super) fn decode(
    bytes: &[u8],
    big: bool,
    version: u8,
    count: usize,
    samples: &mut Vec<f64>,
) -> Result<bool, (usize, String)> {
    let word = |at: usize| -> u32 {
        let mut four = [0; 4];
        four.copy_from_slice(&bytes[at..at + 4]);
        if big {
            u32::from_be_bytes(four)
        } else {
            u32::from_le_bytes(four)
        }
    };
    if bytes.len() < FRAME {
        return Err((0, "the record has no frame of 64 bytes".to_owned()));
    }
    let (first, last) = (word(4) as i32, word(8) as i32);
    let mut value = first;
    let mut done = 0;
    let mut more = false;
    'frames: for frame in 0..bytes.len() / FRAME {
        let codes = word(frame * FRAME);
        for k in 1..16 {
            // Words 1 and 2 of the first frame are the first and the last sample.
            let code = codes >> (2 * (15 - k)) & 3;
            if code == 0 || frame == 0 && k < 3 {
                continue;
            }
            if done == count {
                more = true;
                break 'frames;
            }
            let at = frame * FRAME + 4 * k;
            let packed = word(at);
            let Some((bits, number)) = packing(version, code, packed) else {
                return Err((
                    at,
                    format!("Steim-{version} has no packing of code {code} here"),
                ));
            };
            let packed = in_file_order(packed, bits, big);
            for i in (0..number).rev() {
                // The first difference leads to the record before this one.
                if done > 0 {
                    let raised = (packed >> (bits * i)) << (32 - bits);
                    value = value.wrapping_add(raised as i32 >> (32 - bits));
                }
                samples.push(f64::from(value));
                done += 1;
                if done == count {
                    break;
                }
            }
        }
    }
    if done < count {
        return Err((
            bytes.len() / FRAME * FRAME,
            format!("the frames hold {done} of {count} samples"),
        ));
    }
    if value != last {
        return Err((
            8,
            format!("the last sample is {value}, the record says {last}: its data are damaged"),
        ));
    }
    Ok(more)
}
