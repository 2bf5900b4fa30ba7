//! Readers, one format per file, and the detection of the format by content.

use std::path::Path;

use sha2::{Digest, Sha256};

use crate::accelerogram::Accelerogram;
use crate::error::GroundMotionError;
use crate::options::ReadOptions;
use crate::recording::{Recording, Series};
use crate::select;
use crate::source::Source;

/// Declares the files of the formats, in the order of detection: one line a format.
macro_rules! formats {
    ($($(#[$doc:meta])* $variant:ident $module:ident)*) => {
        $(mod $module;)*

        /// A record format.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        #[non_exhaustive]
        pub enum Format {
            $($(#[$doc])* $variant,)*
        }

        impl Format {
            /// All formats in the order of detection.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];

            /// Name in the case file.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => stringify!($module),)*
                }
            }

            fn matches(self, source: &Source<'_>) -> bool {
                match self {
                    $(Self::$variant => $module::matches(source),)*
                }
            }

            fn read(self, source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
                match self {
                    $(Self::$variant => $module::read(source),)*
                }
            }
        }
    };
}

formats! {
    /// miniSEED 2 with integers, floats, Steim-1 or Steim-2; counts.
    MiniSeed2 mini_seed_2
    /// SAC, binary, either byte order.
    Sac sac
    /// Our CSV layout: comment header, column header, time and acceleration.
    PoundingCsv pounding_csv
    /// K-NET and KiK-net ASCII (NIED, Japan).
    KNet k_net
    /// CSV of the Japan Meteorological Agency.
    JmaCsv jma_csv
    /// DYNA 1.x (ESM, ITACA, AFAD).
    Dyna dyna
    /// Free-field text of the Central Weather Administration, Taiwan.
    Cwa cwa
    /// GeoNet Volume 1 and Volume 2 (New Zealand).
    GeoNet geo_net
    /// COSMOS 1.20.
    Cosmos cosmos
    /// California Institute of Technology Volume I; University of Southern California.
    CaltechVolume1 caltech_volume_1
    /// California Institute of Technology Volume II.
    CaltechVolume2 caltech_volume_2
    /// CSMIP (CDMG, CGS) Volume 1: pairs of time and acceleration, or even steps.
    CsmipV1 csmip_v1
    /// CSMIP (CDMG, CGS) Volume 2: acceleration, velocity and displacement.
    CsmipV2 csmip_v2
    /// SMC of the United States Geological Survey.
    UsgsSmc usgs_smc
    /// Archivo Estandar de Aceleracion (Mexico).
    Asa asa
    /// Internet Site for European Strong-motion Data.
    Isesd isesd
    /// PEER strong-motion database: AT2, VT2 and DT2.
    PeerAt2 peer_at2
    /// midas ground-motion file, sgs.
    MidasSgs midas_sgs
    /// Plain columns of numbers.
    PlainColumns plain_columns
}

impl Format {
    /// The format of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|f| f.name() == name)
    }
}

/// Reads every series of a file.
///
/// # Errors
/// A file that cannot be read, or whatever is wrong with its content, with file,
/// line and column (byte for binary formats) and remedy.
pub fn read_all(path: &Path, options: &ReadOptions) -> Result<Recording, GroundMotionError> {
    let (file, bytes) = load(path)?;
    read_all_bytes(&file, &bytes, options)
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
    let source = Source::new(file, bytes, options);
    let detected = || Format::ALL.iter().copied().find(|f| f.matches(&source));
    let format =
        options
            .format
            .or_else(detected)
            .ok_or_else(|| GroundMotionError::UnknownFormat {
                file: file.to_owned(),
            })?;
    let mut series = format.read(&source)?;
    if series.is_empty() {
        return Err(source.error(
            1,
            0,
            format!("no series of format {} in the file", format.name()),
            "check `format`, or get the record again",
        ));
    }
    let sha256: String = Sha256::digest(bytes)
        .iter()
        .map(|b| format!("{b:02x}"))
        .collect();
    for s in &mut series {
        s.origin.format = format.name();
        s.origin.sha256.clone_from(&sha256);
        s.origin.warnings.extend(source.warnings());
    }
    Ok(Recording { series })
}

/// Reads the acceleration that the options choose.
///
/// # Errors
/// As [`read_all`]; also a velocity or displacement, a choice that is ambiguous,
/// and uneven samples without a step to resample to.
pub fn read(path: &Path, options: &ReadOptions) -> Result<Accelerogram, GroundMotionError> {
    let (file, bytes) = load(path)?;
    read_bytes(&file, &bytes, options)
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

fn load(path: &Path) -> Result<(String, Vec<u8>), GroundMotionError> {
    let file = path.display().to_string();
    regular(path, &file)?;
    match std::fs::read(path) {
        Ok(bytes) => Ok((file, bytes)),
        Err(source) => Err(GroundMotionError::Io { file, source }),
    }
}

/// Refuses what is no regular file: a device or a pipe may never end.
pub(crate) fn regular(path: &Path, file: &str) -> Result<(), GroundMotionError> {
    let what = match std::fs::metadata(path) {
        Ok(found) if found.is_file() => return Ok(()),
        Ok(found) if found.is_dir() => "this is a folder, not a file",
        Ok(_) => "this is no regular file",
        Err(source) => {
            let file = file.to_owned();
            return Err(GroundMotionError::Io { file, source });
        }
    };
    Err(GroundMotionError::Unsupported {
        file: file.to_owned(),
        what: what.to_owned(),
        remedy: "give the path of a file; save what comes from a pipe or device first",
    })
}
