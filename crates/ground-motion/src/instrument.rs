//! What the second letter of a channel's code says of its instrument (SEED manual, appendix A).

use crate::error::GroundMotionError;
use crate::source::Source;

/// What an instrument with this code measures, where that is no acceleration of the ground; that of
/// seismometers, `H` and `L`, is a velocity, and their callers have more to say of it.
pub(crate) fn other_measure(code: u8) -> Option<&'static str> {
    Some(match code {
        b'A' => "tilt",
        b'B' => "creep",
        b'C' => "the calibration of an instrument",
        b'D' => "pressure",
        b'E' => "a test of the electronics",
        b'F' => "a magnetic field",
        b'I' => "humidity",
        b'J' => "rotation",
        b'K' => "temperature",
        b'M' => "the position of a seismometer's mass",
        b'O' => "a current of water",
        b'Q' => "an electric potential",
        b'R' => "rainfall",
        b'S' | b'V' => "strain",
        b'T' => "a tide",
        b'U' => "cloudiness",
        b'W' => "wind",
        _ => return None,
    })
}

/// What a channel measures beside motion, by its code: of letters that begin no name of a direction
/// such as `RAD` and `VER`.
fn of_other_instrument(code: &[u8]) -> Option<&'static str> {
    let &[band, instrument, orientation] = code else {
        return None;
    };
    let is_code = b"FGDCESHBMLVUQ".contains(&band) && b"DFIJKMQSTW".contains(&instrument);
    let known = b"ZNE123FDHIOSABCTR".contains(&orientation);
    other_measure(instrument).filter(|_| is_code && known)
}

/// Whether a channel in capitals is that of an instrument of low gain: an accelerograph in older codes, a
/// seismometer in others.
pub(crate) fn is_of_low_gain(channel: &str) -> bool {
    ["HLZ", "HLN", "HLE", "HL1", "HL2", "HL3"].contains(&channel)
}

/// Refuses a channel whose code is that of an instrument that records no acceleration, where the file
/// does not say what the values are: `unsaid` says so.
pub(crate) fn may_accelerate(
    source: &Source<'_>,
    name: &str,
    unsaid: &str,
    remedy: &'static str,
) -> Result<(), GroundMotionError> {
    let unsupported = |what: String| GroundMotionError::Unsupported {
        file: source.file.to_owned(),
        what,
        remedy,
    };
    // Codes are in capitals; some programs write them small.
    let name = name.to_ascii_uppercase();
    match name.as_bytes() {
        _ if is_of_low_gain(&name) => {
            source.warn(&format!(
                "channel {name} is that of an instrument of low gain, which is an accelerograph in older codes and a seismometer in others; {unsaid}"
            ));
            Ok(())
        }
        b"LOG" => Err(unsupported(
            "channel LOG holds messages of the recorder, no motion".to_owned(),
        )),
        [_, b'H' | b'L', _] => Err(unsupported(format!(
            "channel {name} is that of a seismometer, which records velocity"
        ))),
        code => match of_other_instrument(code) {
            Some(measured) => Err(unsupported(format!(
                "channel {name} records {measured}, no acceleration"
            ))),
            None => Ok(()),
        },
    }
}
