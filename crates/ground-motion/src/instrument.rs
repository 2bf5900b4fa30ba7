//! What the second letter of a channel's code says of its instrument (SEED manual, appendix A).

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
