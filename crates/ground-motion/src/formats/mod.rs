//! Readers, one format per file, and the detection of the format by content.

use std::io::Read;
use std::path::Path;

use pounding_catalogue::Registry;
use sha2::{Digest, Sha256};

use crate::accelerogram::Accelerogram;
use crate::direction::Direction;
use crate::error::GroundMotionError;
use crate::format::Format;
use crate::integrals;
use crate::options::ReadOptions;
use crate::quantity::Quantity;
use crate::recording::{Recording, Series};
use crate::regular_file::regular;
use crate::select;
use crate::source::Source;
use crate::stray_commas;

mod asa;
mod bhrc;
mod caltech_volume_1;
mod caltech_volume_2;
mod cosmos;
mod csmip_v1;
mod csmip_v2;
mod cwa;
mod dyna;
mod encodings;
mod geo_net;
mod iris_ascii;
mod isesd;
mod jma_csv;
mod k_net;
mod midas_sgs;
mod mini_seed_2;
mod nsmn;
mod peer_at2;
mod plain_columns;
mod pounding_csv;
mod rows;
mod sac;
mod usgs_smc;

/// The reader of a format.
struct Reader {
    format: &'static Format,
    /// Whether the start of a file is of the format.
    matches: fn(&Source<'_>) -> bool,
    read: fn(&Source<'_>) -> Result<Vec<Series>, GroundMotionError>,
}

impl Reader {
    const fn of(
        format: &'static Format,
        matches: fn(&Source<'_>) -> bool,
        read: fn(&Source<'_>) -> Result<Vec<Series>, GroundMotionError>,
    ) -> Self {
        Self {
            format,
            matches,
            read,
        }
    }
}

/// Readers of all formats, in the order of detection.
static READERS: [Reader; 22] = [
    Reader::of(
        &mini_seed_2::FORMAT,
        mini_seed_2::matches,
        mini_seed_2::read,
    ),
    Reader::of(&sac::FORMAT, sac::matches, sac::read),
    Reader::of(
        &pounding_csv::FORMAT,
        pounding_csv::matches,
        pounding_csv::read,
    ),
    Reader::of(&k_net::FORMAT, k_net::matches, k_net::read),
    Reader::of(&jma_csv::FORMAT, jma_csv::matches, jma_csv::read),
    Reader::of(&dyna::FORMAT, dyna::matches, dyna::read),
    Reader::of(&nsmn::FORMAT, nsmn::matches, nsmn::read),
    Reader::of(&cwa::FORMAT, cwa::matches, cwa::read),
    Reader::of(&geo_net::FORMAT, geo_net::matches, geo_net::read),
    Reader::of(&cosmos::FORMAT, cosmos::matches, cosmos::read),
    Reader::of(
        &caltech_volume_1::FORMAT,
        caltech_volume_1::matches,
        caltech_volume_1::read,
    ),
    Reader::of(
        &caltech_volume_2::FORMAT,
        caltech_volume_2::matches,
        caltech_volume_2::read,
    ),
    Reader::of(&csmip_v1::FORMAT, csmip_v1::matches, csmip_v1::read),
    Reader::of(&csmip_v2::FORMAT, csmip_v2::matches, csmip_v2::read),
    Reader::of(&usgs_smc::FORMAT, usgs_smc::matches, usgs_smc::read),
    Reader::of(&bhrc::FORMAT, bhrc::matches, bhrc::read),
    Reader::of(&asa::FORMAT, asa::matches, asa::read),
    Reader::of(&isesd::FORMAT, isesd::matches, isesd::read),
    Reader::of(&peer_at2::FORMAT, peer_at2::matches, peer_at2::read),
    Reader::of(&midas_sgs::FORMAT, midas_sgs::matches, midas_sgs::read),
    Reader::of(&iris_ascii::FORMAT, iris_ascii::matches, iris_ascii::read),
    Reader::of(
        &plain_columns::FORMAT,
        plain_columns::matches,
        plain_columns::read,
    ),
];

/// All formats, in the order of detection.
static ALL: [&Format; READERS.len()] = {
    let mut all = [&plain_columns::FORMAT; READERS.len()];
    let mut i = 0;
    while i < all.len() {
        all[i] = READERS[i].format;
        i += 1;
    }
    all
};
static FORMATS: Registry<Format> = Registry::new(&ALL, &[]);

impl Format {
    /// All formats, in the order of detection.
    #[must_use]
    pub fn all() -> &'static [&'static Self] {
        FORMATS.all()
    }

    /// The format of this name.
    ///
    /// # Errors
    /// [`GroundMotionError::UnknownFormatName`] with the nearest known name.
    pub fn find(name: &str) -> Result<&'static Self, GroundMotionError> {
        Ok(FORMATS.find(name)?)
    }

    /// Names of all formats, for messages.
    pub(crate) fn names() -> String {
        FORMATS.names().collect::<Vec<_>>().join(", ")
    }
}

/// Bytes that the recognition of a format looks at.
const START: usize = 1 << 20;
/// Bytes that a record may have: an hour of twelve channels at 500 samples a second, in columns of
/// ten characters, has less.
const MOST_BYTES: u64 = 256 << 20;

/// Reads every series of a file.
///
/// # Errors
/// A file that cannot be read or is larger than 256 MiB, or whatever is wrong with its content, with file,
/// line and column (byte for binary formats) and remedy.
pub fn read_all(path: &Path, options: &ReadOptions) -> Result<Recording, GroundMotionError> {
    let _span = tracing::info_span!("read_record", file = %path.display()).entered();
    let (file, bytes) = load(path, options)?;
    every_series(&file, &bytes, options, Some(path))
}

/// Reads every series from bytes; `file` names them in messages.
///
/// # Errors
/// As [`read_all`].
pub fn read_all_bytes(
    file: &str,
    bytes: &[u8],
    options: &ReadOptions,
) -> Result<Recording, GroundMotionError> {
    every_series(file, bytes, options, None)
}

fn every_series(
    file: &str,
    bytes: &[u8],
    options: &ReadOptions,
    path: Option<&Path>,
) -> Result<Recording, GroundMotionError> {
    not_too_large(file, bytes.len() as u64)?;
    let reader = reader_of(file, bytes, options, path)?;
    let format = reader.format;
    let filled = filling(format, bytes);
    let source = Source::new(file, &bytes[..bytes.len() - filled], options, path);
    if filled > 0 {
        let end = &bytes[bytes.len() - filled..];
        source.warn(&format!(
            "{} NUL bytes behind the last row were passed over",
            end.iter().filter(|b| **b == 0).count()
        ));
    }
    if !is_binary(format) {
        source.is_text()?;
    }
    let read = (reader.read)(&source);
    let mut series = read.map_err(|error| or_cwa(&source, format, error))?;
    if !is_binary(format) {
        stray_commas::refuse(&source)?;
    }
    // A line of NUL bytes may stand for one of values that are missing.
    let is_line = bytes[bytes.len() - filled..].contains(&b'\n');
    let lacks = |s: &Series| {
        s.origin
            .header_count
            .is_some_and(|count| count > s.samples.len())
    };
    if is_line && series.iter().any(lacks) {
        Source::new(file, bytes, options, path).is_text()?;
    }
    if series.is_empty() {
        return Err(source.error(
            1,
            0,
            format!("no series of format {} in the file", format.name),
            "check `format`, or get the record again",
        ));
    }
    if options.response.is_some() && series.iter().all(|s| s.origin.response.is_none()) {
        return Err(GroundMotionError::Unsupported {
            file: file.to_owned(),
            what: format!(
                "a file of response is given, but records of format {} state their unit themselves",
                format.name
            ),
            remedy: "do not give `response`: it is for miniSEED records",
        });
    }
    unused(&source, format)?;
    if let (Some(unit), Some(first)) = (options.unit, series.first())
        && series.iter().all(|s| s.quantity != Quantity::Acceleration)
    {
        return Err(GroundMotionError::Unsupported {
            file: file.to_owned(),
            what: format!(
                "the unit {} is given, which is of accelerations, but the values are {} in {}",
                unit.symbol(),
                first.quantity,
                first.unit
            ),
            remedy: "leave `unit` out to see what is in the file; for an excitation use the accelerations of the same record, such as AT2 beside VT2 and DT2",
        });
    }
    integrals::compare(&mut series);
    let own = Sha256::new().chain_update(bytes);
    for s in &mut series {
        s.origin.format = format.name.into();
        let response = s.origin.response.as_ref();
        let all = response.map_or(own.clone(), |r| own.clone().chain_update(&r.sha256));
        s.origin.sha256 = all.finalize().iter().map(|b| format!("{b:02x}")).collect();
        s.origin.warnings.extend(source.warnings());
        s.origin
            .warnings
            .extend(unknown_component(format, &s.component));
        tracing::debug!(format = format.name, series = %s.label(), samples = s.samples.len(), unit = %s.origin.unit, time_step = %s.origin.time_step, "read");
    }
    Ok(Recording {
        series,
        without: source.without(),
    })
}

/// The error of a file that is no plain columns, or what to give where it is one of the Central Weather Administration
/// whose first line is missing, as those of the earthquake of Chi-Chi have none.
fn or_cwa(source: &Source<'_>, format: &Format, error: GroundMotionError) -> GroundMotionError {
    let may = *format == plain_columns::FORMAT
        && source.options.format.is_none()
        && source.first_line().starts_with('#');
    if !may || cwa::read(source).is_err() {
        return error;
    }
    source.error(
        1,
        0,
        format!("the header is that of format cwa but for its first line, and as plain columns the file is not read: {error}"),
        "give `format = \"cwa\"` in [ground_motion] of a case, `--format cwa` with `pounding motion`",
    )
}

/// NUL bytes at the end of a text behind whole rows, of a format that counts its values.
fn filling(format: &Format, bytes: &[u8]) -> usize {
    // Ends of lines may stand behind them.
    let is_end = |b: &u8| matches!(b, 0 | b'\r' | b'\n');
    let ends = bytes.iter().rposition(|b| !is_end(b)).map_or(0, |n| n + 1);
    let Some(first) = bytes[ends..].iter().position(|b| *b == 0) else {
        return 0;
    };
    let end = ends + first;
    let whole = matches!(bytes[..end].last(), Some(b'\n' | b'\r'));
    match whole && *format == usgs_smc::FORMAT {
        true => bytes.len() - end,
        false => 0,
    }
}

/// What to say of a component that names no direction, where a line of the header states it.
fn unknown_component(format: &Format, name: &str) -> Option<String> {
    let of_line = [
        &caltech_volume_1::FORMAT,
        &csmip_v1::FORMAT,
        &csmip_v2::FORMAT,
        &geo_net::FORMAT,
        &usgs_smc::FORMAT,
    ];
    let known = Direction::of_name(name).is_some()
        || COMPONENTS
            .iter()
            .any(|word| word.eq_ignore_ascii_case(name));
    (of_line.contains(&format) && !name.is_empty() && !known).then(|| {
        format!(
            "the component \"{name}\" names no direction: check the line of the header that states it"
        )
    })
}

/// Components without a direction of which the agencies write.
const COMPONENTS: [&str; 14] = [
    "1",
    "2",
    "3",
    "H1",
    "H2",
    "H3",
    "L",
    "T",
    "Long",
    "Tran",
    "Radial",
    "Tangential",
    "Horizontal",
    "Other",
];

/// Refuses options that say nothing of this record: who gives them takes them for heard.
fn unused(source: &Source<'_>, format: &Format) -> Result<(), GroundMotionError> {
    let (options, used) = (source.options, source.used());
    let by_rows = format.name == plain_columns::FORMAT.name;
    let of_columns = "leave it out: the format has a layout of its own; for rows of numbers that were taken for it give `format = \"plain_columns\"` too";
    let given = [
        (
            options.layout.is_some() && !by_rows,
            "layout",
            "is of plain columns",
            of_columns,
        ),
        (
            options.skip_lines > 0 && !by_rows,
            "skip_lines",
            "is of plain columns",
            of_columns,
        ),
        (
            options.skip_columns > 0 && !by_rows,
            "skip_columns",
            "is of plain columns",
            of_columns,
        ),
        (
            options.sensitivity.is_some() && !used.sensitivity,
            "sensitivity",
            "is of values in counts whose sensitivity the user must say",
            "leave it out: the values of this record have a unit, which `unit` says where the file does not",
        ),
        (
            options.gravity.is_some() && !used.gravity,
            "gravity",
            "is the g of values in units of gravity",
            "leave it out: no value of this record is in g",
        ),
    ];
    for (is_wrong, option, is, remedy) in given {
        if is_wrong {
            let error = GroundMotionError::Unsupported {
                file: source.file.to_owned(),
                what: format!(
                    "`{option}` is given, which {is}; this record is of format {}",
                    format.name
                ),
                remedy,
            };
            return Err(error.of_option(option));
        }
    }
    Ok(())
}

/// Whether the files of a format are no texts.
fn is_binary(format: &Format) -> bool {
    [&mini_seed_2::FORMAT, &sac::FORMAT].contains(&format)
}

/// The reader of the format that the options name, or that the start of the file shows.
fn reader_of(
    file: &str,
    bytes: &[u8],
    options: &ReadOptions,
    path: Option<&Path>,
) -> Result<&'static Reader, GroundMotionError> {
    let start = &bytes[..bytes.len().min(START)];
    let source = Source::new(file, start, options, path);
    let reader = READERS.iter().find(|reader| match options.format {
        Some(format) => reader.format == format,
        None => (reader.matches)(&source),
    });
    if !reader.is_some_and(|reader| is_binary(reader.format)) {
        encodings::is_plain_text(file, start)?;
        encodings::is_no_alphanumeric_sac(file, start)?;
    }
    if reader.is_none() {
        encodings::has_hyphens(file, start)?;
    }
    reader.ok_or_else(|| match bytes.iter().all(u8::is_ascii_whitespace) {
        true => GroundMotionError::Empty {
            file: file.to_owned(),
        },
        false => GroundMotionError::UnknownFormat {
            file: file.to_owned(),
        },
    })
}

/// Reads the acceleration that the options choose.
///
/// # Errors
/// As [`read_all`]; also a velocity or displacement, a choice that is ambiguous,
/// and uneven samples without a step to resample to.
pub fn read(path: &Path, options: &ReadOptions) -> Result<Accelerogram, GroundMotionError> {
    let _span = tracing::info_span!("read_record", file = %path.display()).entered();
    let (file, bytes) = load(path, options)?;
    let recording = every_series(&file, &bytes, options, Some(path))?;
    select::excitation(&file, recording, options)
}

/// Reads the acceleration that the options choose from bytes; `file` names them
/// in messages.
///
/// # Errors
/// As [`read`].
pub fn read_bytes(
    file: &str,
    bytes: &[u8],
    options: &ReadOptions,
) -> Result<Accelerogram, GroundMotionError> {
    select::excitation(file, read_all_bytes(file, bytes, options)?, options)
}

/// The file's name and bytes. What is too large, or of no known format, is not read to its end.
fn load(path: &Path, options: &ReadOptions) -> Result<(String, Vec<u8>), GroundMotionError> {
    let file = path.display().to_string();
    regular(path, &file)?;
    let failed = |source| GroundMotionError::Io {
        file: file.clone(),
        source,
    };
    let mut reader = std::fs::File::open(path).map_err(failed)?;
    let size = reader.metadata().map_err(failed)?.len();
    not_too_large(&file, size)?;
    let mut bytes = Vec::with_capacity(START.min(size as usize));
    let mut start = reader.by_ref().take(START as u64);
    start.read_to_end(&mut bytes).map_err(failed)?;
    reader_of(&file, &bytes, options, Some(path))?;
    bytes.reserve_exact((size as usize).saturating_sub(bytes.len()));
    // It may grow meanwhile.
    let mut rest = reader.take(MOST_BYTES);
    rest.read_to_end(&mut bytes).map_err(failed)?;
    Ok((file, bytes))
}

/// Refuses what is no record by its size.
fn not_too_large(file: &str, size: u64) -> Result<(), GroundMotionError> {
    if size <= MOST_BYTES {
        return Ok(());
    }
    Err(GroundMotionError::Unsupported {
        file: file.to_owned(),
        what: format!(
            "the file has {} MiB, more than the {} of the largest records",
            size >> 20,
            MOST_BYTES >> 20
        ),
        remedy: "give the file of one record, or cut out the time and the components that are needed",
    })
}
