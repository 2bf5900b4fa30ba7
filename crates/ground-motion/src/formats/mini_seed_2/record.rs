//! One record: fixed header, blockettes, data.

use std::fmt;

use super::steim;
use crate::error::GroundMotionError;
use crate::instrument::other_measure;
use crate::source::Source;
use crate::start_times::year_and_day;
use crate::station_xml::ChannelName;
use crate::text::latin_1;

const HEADER: usize = 48;
/// A day (us).
const DAY: i64 = 86_400_000_000;

/// Start of a record for display.
pub(super) struct StartText {
    year: i64,
    day: i64,
    /// Microseconds after midnight.
    micro: i64,
}

impl fmt::Display for StartText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (whole, fraction) = (self.micro / 1_000_000, self.micro % 1_000_000);
        write!(
            f,
            "{} day {} {:02}:{:02}:{:02}.{:04} UTC",
            self.year,
            self.day,
            whole / 3600,
            whole / 60 % 60,
            whole % 60,
            fraction / 100
        )
    }
}

/// A record's header.
pub(super) struct Record {
    /// Offset of the record in the file.
    pub at: usize,
    /// Length (bytes).
    pub length: usize,
    /// Station, location, channel and network as they stand.
    pub name: [u8; 12],
    /// Start (us after the year 1900), time correction applied.
    pub start: i64,
    pub start_text: StartText,
    /// Number of samples.
    pub count: usize,
    /// Samples per second, by blockette 100 where there is one.
    pub rate: f64,
    /// The same by the fixed header; not positive where that does not say.
    pub nominal: f64,
    /// Seconds that were inserted into its minute, or left out (negative), while it lasted.
    pub leap_seconds: i64,
    data: usize,
    encoding: u8,
    big: bool,
}

/// Whether a record starts here: six digits, a quality, a blank.
pub(super) fn is_start(bytes: &[u8]) -> bool {
    bytes.len() >= HEADER
        && bytes[..6].iter().all(|b| b.is_ascii_digit() || *b == b' ')
        && matches!(bytes[6], b'D' | b'R' | b'Q' | b'M')
        && matches!(bytes[7], b' ' | 0)
}

/// Numbers of either byte order.
struct Numbers<'a> {
    bytes: &'a [u8],
    big: bool,
}

impl Numbers<'_> {
    fn unsigned(&self, at: usize) -> u16 {
        let two = match self.bytes.get(at..at + 2) {
            Some(found) => [found[0], found[1]],
            None => [0; 2],
        };
        if self.big {
            u16::from_be_bytes(two)
        } else {
            u16::from_le_bytes(two)
        }
    }

    fn signed(&self, at: usize) -> i16 {
        self.unsigned(at) as i16
    }

    fn word(&self, at: usize) -> u32 {
        let (first, second) = (self.unsigned(at), self.unsigned(at + 2));
        if self.big {
            u32::from(first) << 16 | u32::from(second)
        } else {
            u32::from(second) << 16 | u32::from(first)
        }
    }

    fn plausible(&self) -> bool {
        (1900..=2200).contains(&self.unsigned(20)) && (1..=366).contains(&self.unsigned(22))
    }
}

/// What blockettes 1000 and 100 say.
struct Blockettes {
    encoding: u8,
    big: bool,
    length: usize,
    rate: Option<f64>,
}

impl Record {
    /// Reads the header of the record at an offset.
    pub(super) fn read(source: &Source<'_>, at: usize) -> Result<Self, GroundMotionError> {
        let bytes = &source.bytes[at..];
        let error = |offset: usize, message: String| source.binary_error(at + offset, message);
        if !is_start(bytes) {
            return Err(error(0, "no miniSEED record starts here".to_owned()));
        }
        let order = [true, false]
            .into_iter()
            .map(|big| Numbers { bytes, big })
            .find(Numbers::plausible);
        let Some(numbers) = order else {
            return Err(error(
                20,
                "the record's year and day are not a date".to_owned(),
            ));
        };
        let blockettes = blockettes(source, at, &numbers)?;
        if blockettes.length > bytes.len() {
            return Err(error(
                bytes.len(),
                format!(
                    "the file ends inside a record of {} bytes",
                    blockettes.length
                ),
            ));
        }
        let nominal = rate(f64::from(numbers.signed(32)), f64::from(numbers.signed(34)));
        let rate = blockettes.rate.unwrap_or(nominal);
        let count = usize::from(numbers.unsigned(30));
        if count > 0 && !(rate.is_finite() && rate > 0.0) {
            return Err(error(32, format!("{rate} samples per second")));
        }
        let data = usize::from(numbers.unsigned(44));
        if count > 0 && !(HEADER..blockettes.length).contains(&data) {
            return Err(error(44, format!("data at byte {data} of the record")));
        }
        let mut name = [0; 12];
        name.copy_from_slice(&bytes[8..20]);
        let (start, start_text) = start(&numbers, bytes);
        Ok(Self {
            at,
            length: blockettes.length,
            name,
            start,
            start_text,
            count,
            rate,
            nominal,
            leap_seconds: leap_seconds(bytes[36]),
            data,
            encoding: blockettes.encoding,
            big: blockettes.big,
        })
    }

    /// Whether the samples are floats of 32 or 64 bits.
    pub(super) fn is_of_floats(&self) -> bool {
        matches!(self.encoding, 4 | 5)
    }

    /// Whether bytes that are no blanks stand where its samples would, in an encoding of numbers:
    /// records of logs hold text, those of detections nothing.
    pub(super) fn has_data(&self, source: &Source<'_>) -> bool {
        let end = self.at + self.length;
        let data = source.bytes.get(self.at + self.data..end);
        let is_number = matches!(self.encoding, 1..=5 | 10 | 11);
        let is_there = self.data >= HEADER && data.is_some_and(|d| d.iter().any(|b| *b != 0));
        is_number && is_there
    }

    /// Network, station, location and channel.
    pub(super) fn label(&self) -> String {
        let part = |from: usize, to: usize| latin_1(&self.name[from..to]).trim().to_owned();
        format!(
            "{}.{}.{}.{}",
            part(10, 12),
            part(0, 5),
            part(5, 7),
            part(7, 10)
        )
    }

    /// The channel and its start as the station's metadata name them.
    pub(super) fn channel_name(&self) -> ChannelName {
        let part = |from: usize, to: usize| latin_1(&self.name[from..to]).trim().to_owned();
        ChannelName {
            network: part(10, 12),
            station: part(0, 5),
            location: part(5, 7),
            channel: part(7, 10),
            start: self.start,
            end: self.end(),
            start_text: self.start_text.to_string(),
            rate: self.rate,
        }
    }

    /// Time of the last sample (us after the year 1900).
    pub(super) fn end(&self) -> i64 {
        let length = self.count.saturating_sub(1) as f64 / self.rate;
        self.start.saturating_add((1.0e6 * length).round() as i64)
    }

    /// What the channel records, where that is no motion.
    pub(super) fn other_measure(&self) -> Option<&'static str> {
        match &self.name[7..10] {
            b"LOG" => Some("a log of the recorder"),
            _ => other_measure(self.name[8]),
        }
    }

    /// Code of the instrument.
    pub(super) fn instrument(&self) -> u8 {
        self.name[8]
    }

    /// Instrument codes H and L are seismometers (SEED manual, appendix A).
    pub(super) fn is_velocity(&self) -> bool {
        matches!(self.instrument(), b'H' | b'L')
    }

    /// Appends the record's samples; whether more data stand behind them, which its header does
    /// not count.
    pub(super) fn decode(
        &self,
        source: &Source<'_>,
        samples: &mut Vec<f64>,
    ) -> Result<bool, GroundMotionError> {
        let from = self.at + self.data;
        let bytes = &source.bytes[from..self.at + self.length];
        let error = |offset: usize, message: String| source.binary_error(from + offset, message);
        let width = match self.encoding {
            1 => 2,
            2 => 3,
            3 | 4 => 4,
            5 => 8,
            10 | 11 => {
                let version = if self.encoding == 10 { 1 } else { 2 };
                return steim::decode(bytes, self.big, version, self.count, samples)
                    .map_err(|(offset, message)| error(offset, message));
            }
            other => {
                let name = encoding_name(other).map_or(String::new(), |name| format!(", {name},"));
                return Err(GroundMotionError::Unsupported {
                    file: source.file.to_owned(),
                    what: format!(
                        "the record at byte {} of {} is in encoding {other}{name} which is not read",
                        self.at,
                        self.label()
                    ),
                    remedy: "write it in integers, floats, Steim-1 or Steim-2 with a program that reads it, such as ObsPy",
                });
            }
        };
        if bytes.len() / width < self.count {
            return Err(error(
                bytes.len(),
                format!(
                    "the record holds {} of its {} samples",
                    bytes.len() / width,
                    self.count
                ),
            ));
        }
        for (i, field) in bytes.chunks_exact(width).take(self.count).enumerate() {
            let value = plain(field, self.big, self.encoding);
            if !(value.abs() < 1.0e37) {
                return Err(error(i * width, format!("sample {} is {value}", i + 1)));
            }
            samples.push(value);
        }
        Ok(bytes[self.count * width..].iter().any(|b| *b != 0))
    }
}

/// Names of encodings that are not read (SEED manual, blockette 1000, field 3).
fn encoding_name(encoding: u8) -> Option<&'static str> {
    Some(match encoding {
        0 => "text",
        12 => "GEOSCOPE of 24 bits",
        13 | 14 => "GEOSCOPE of 16 bits with steps of gain",
        15 => "U.S. National Network",
        16 => "CDSN of 16 bits with steps of gain",
        17 => "Graefenberg",
        18 => "IPG Strasbourg",
        19 => "Steim-3",
        30 => "SRO",
        31 => "HGLP",
        32 => "DWWSSN",
        33 => "RSTN",
        _ => return None,
    })
}

/// What bits 4 and 5 of the activity flags say.
fn leap_seconds(activity: u8) -> i64 {
    i64::from(activity >> 4 & 1) - i64::from(activity >> 5 & 1)
}

/// A number that is not compressed.
fn plain(field: &[u8], big: bool, encoding: u8) -> f64 {
    let mut bits = 0_u64;
    for k in 0..field.len() {
        let byte = if big {
            field[k]
        } else {
            field[field.len() - 1 - k]
        };
        bits = bits << 8 | u64::from(byte);
    }
    match encoding {
        1 => f64::from(bits as u16 as i16),
        2 => f64::from((bits as u32).wrapping_shl(8) as i32 >> 8),
        3 => f64::from(bits as u32 as i32),
        4 => f64::from(f32::from_bits(bits as u32)),
        _ => f64::from_bits(bits),
    }
}

/// Factor and multiplier; negative ones divide.
fn rate(factor: f64, multiplier: f64) -> f64 {
    let part = |x: f64| if x < 0.0 { -1.0 / x } else { x };
    part(factor) * part(multiplier)
}

/// Follows the chain of blockettes, which goes forward only.
fn blockettes(
    source: &Source<'_>,
    at: usize,
    numbers: &Numbers<'_>,
) -> Result<Blockettes, GroundMotionError> {
    let bytes = numbers.bytes;
    let mut found = None;
    let mut exact = None;
    let mut next = usize::from(numbers.unsigned(46));
    let mut before = 0;
    while next > before && next + 8 <= bytes.len() {
        match numbers.unsigned(next) {
            1000 => found = Some((bytes[next + 4], bytes[next + 5] != 0, bytes[next + 6])),
            100 => exact = Some(f64::from(f32::from_bits(numbers.word(next + 4)))),
            _ => {}
        }
        before = next;
        next = usize::from(numbers.unsigned(next + 2));
    }
    let Some((encoding, big, power)) = found else {
        return Err(source.binary_error(
            at + 46,
            "no blockette 1000: the record does not state length and encoding",
        ));
    };
    if !(7..=20).contains(&power) {
        return Err(source.binary_error(at + before, format!("a record of 2^{power} bytes")));
    }
    Ok(Blockettes {
        encoding,
        big,
        length: 1 << power,
        rate: exact.filter(|r| r.is_finite() && *r > 0.0),
    })
}

/// Start in microseconds after 1900, with the time correction unless it is in it.
fn start(numbers: &Numbers<'_>, bytes: &[u8]) -> (i64, StartText) {
    let (year, day) = (numbers.unsigned(20), numbers.unsigned(22));
    let y = i64::from(year) - 1900;
    // Leap days of the years before: 1900 itself is none.
    let before = i64::from(year) - 1;
    let leaps = before / 4 - before / 100 + before / 400 - 460;
    let days = 365 * y + leaps + i64::from(day) - 1;
    let clock = i64::from(bytes[24]) * 3600 + i64::from(bytes[25]) * 60 + i64::from(bytes[26]);
    let fraction = i64::from(numbers.unsigned(28)) * 100;
    let applied = bytes[36] & 0b10 != 0;
    let correction = if applied {
        0
    } else {
        i64::from(numbers.word(40) as i32) * 100
    };
    let micro = clock * 1_000_000 + fraction + correction;
    // A correction may lead across midnight, either way.
    let (other, within) = (micro.div_euclid(DAY), micro.rem_euclid(DAY));
    let (year, day) = year_and_day(i64::from(year), i64::from(day) + other);
    (
        days * DAY + micro,
        StartText {
            year,
            day,
            micro: within,
        },
    )
}
