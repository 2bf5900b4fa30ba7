//! The scale of a record.

use std::ops::Range;
use std::path::PathBuf;

use pounding_ground_motion::processing::Scale;
use pounding_ground_motion::spectra::design::{
    Asce7Of2016, CodeSpectrum, Eurocode8Of2004, GroundType, SpectrumType,
};
use schemars::JsonSchema;
use serde::Deserialize;

use crate::document::{
    Acceleration, Fault, Kinds, Number, Positive, Ratio, Reader, TableOr, Time, Velocity,
};
use crate::located::Located;
use crate::types::{BandSource, SpectrumFile, SpectrumSource, bare_acceleration};

/// Damping ratio where none is given.
const DAMPING: f64 = 0.05;

/// A factor, or a table of one of the kinds.
pub(super) type ScaleValue = TableOr<Kinds<ScaleTable>, Positive<Number>>;

/// Scale
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(untagged)]
pub(super) enum ScaleTable {
    Factor {
        /// Factor (-)
        factor: Positive<Number>,
    },
    Pga {
        /// Peak ground acceleration (m/s2)
        pga: Located<Positive<Acceleration>>,
    },
    Pgv {
        /// Peak ground velocity (m/s)
        pgv: Positive<Velocity>,
    },
    Psa {
        /// Pseudo-acceleration (m/s2) at `period`
        psa: Located<Positive<Acceleration>>,
        /// Period of `psa` (s)
        period: Positive<Time>,
        /// Damping ratio, by default 0.05
        damping: Option<Ratio>,
    },
    Target {
        /// File of a spectrum (header period_s,psa_g) to come near to from `from` to `to`
        target: Located<FilePath>,
        /// First period of the band (s)
        from: Positive<Time>,
        /// Last period of the band (s)
        to: Positive<Time>,
        /// Damping ratio, by default 0.05
        damping: Option<Ratio>,
        /// A further factor (-), such as one that brings the mean of a suite to what a code asks
        /// for; by default 1
        times: Option<Positive<Number>>,
    },
    Code {
        /// Code to whose spectrum the record comes near: eurocode_8_2004 with ag and
        /// ground_type, or asce_7_2016 with s_ds, s_d1 and t_l
        code: CodeWord,
        /// Design ground acceleration on type A ground of Eurocode 8 (m/s2)
        ag: Option<Positive<Acceleration>>,
        /// Ground type of Eurocode 8: A, B, C, D or E
        ground_type: Option<GroundWord>,
        /// Type of the spectrum of Eurocode 8: 1 (default) or 2
        spectrum_type: Option<Positive<Number>>,
        /// S_DS of ASCE 7, at short periods (m/s2)
        s_ds: Option<Positive<Acceleration>>,
        /// S_D1 of ASCE 7, at one second (m/s2)
        s_d1: Option<Positive<Acceleration>>,
        /// T_L of ASCE 7, long-period transition (s)
        t_l: Option<Positive<Time>>,
        /// First period of the band (s), by default 0.2 times the smallest fundamental period of
        /// the buildings
        from: Option<Positive<Time>>,
        /// Last period of the band (s), by default twice the greatest fundamental period of the
        /// buildings
        to: Option<Positive<Time>>,
        /// Damping ratio, by default 0.05, the only one of ASCE 7
        damping: Option<Ratio>,
        /// A further factor (-), such as one that brings the mean of a suite to what the code asks
        /// for; by default 1
        times: Option<Positive<Number>>,
    },
}

/// A code with a spectrum.
#[derive(Clone, Copy, Deserialize, JsonSchema)]
#[serde(expecting = "a text in quotes")]
pub(super) enum CodeWord {
    #[serde(rename = "eurocode_8_2004")]
    Eurocode8Of2004,
    #[serde(rename = "asce_7_2016")]
    Asce7Of2016,
}

/// A ground type of Eurocode 8.
#[derive(Clone, Copy, Deserialize, JsonSchema)]
#[serde(expecting = "a text in quotes")]
pub(super) enum GroundWord {
    A,
    B,
    C,
    D,
    E,
}

impl From<GroundWord> for GroundType {
    fn from(word: GroundWord) -> Self {
        match word {
            GroundWord::A => Self::A,
            GroundWord::B => Self::B,
            GroundWord::C => Self::C,
            GroundWord::D => Self::D,
            GroundWord::E => Self::E,
        }
    }
}

/// The name of a file.
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(try_from = "String")]
pub(super) struct FilePath(PathBuf);

impl TryFrom<String> for FilePath {
    type Error = Fault;
    fn try_from(name: String) -> Result<Self, Fault> {
        match name.is_empty() {
            false => Ok(Self(PathBuf::from(name))),
            true => Err(Fault::new(
                " is empty",
                "name the file, relative to the folder of the case file",
            )),
        }
    }
}

impl From<Located<FilePath>> for Located<PathBuf> {
    fn from(path: Located<FilePath>) -> Self {
        Self {
            value: path.value.0,
            span: path.span,
        }
    }
}

/// Peaks (g) to which records are scaled.
const LEAST_PEAK: f64 = 0.1;

/// Asks about the acceleration (m/s2) of a key whose value stands here, if it has no unit and is less
/// than usual (g).
fn ask(reader: &Reader<'_>, (key, value): (&str, f64), place: &Range<usize>, least: f64) {
    if !reader.is_bare(place) {
        return;
    }
    let what = format!("`{key}` of `scale`");
    if let Some(question) = bare_acceleration(&what, value, least) {
        reader.errors.ask(question);
    }
}

/// The scale that a value says, which stands at `place`.
pub(super) fn scale_of(
    reader: &Reader<'_>,
    value: ScaleValue,
    place: &Range<usize>,
) -> Option<Scale<BandSource>> {
    let table = match value {
        TableOr::Value(factor) => return Some(Scale::Factor(factor.into())),
        TableOr::Table(Kinds(table)) => table,
    };
    let or_default = |damping: Option<Ratio>| damping.map_or(DAMPING, f64::from);
    let or_one = |times: Option<Positive<Number>>| times.map_or(1.0, f64::from);
    ascending(reader, place, &table)?;
    Some(match table {
        ScaleTable::Factor { factor } => Scale::Factor(factor.into()),
        ScaleTable::Pga { pga } => {
            let target = pga.value.into();
            ask(reader, ("pga", target), &pga.span, LEAST_PEAK);
            Scale::PeakAcceleration(target)
        }
        ScaleTable::Pgv { pgv } => Scale::PeakVelocity(pgv.into()),
        ScaleTable::Psa {
            psa,
            period,
            damping,
        } => {
            let (period, target) = (f64::from(period), f64::from(psa.value));
            // Spectra fall with the period, from 1 s on.
            ask(
                reader,
                ("psa", target),
                &psa.span,
                LEAST_PEAK / period.max(1.0),
            );
            Scale::SpectralAcceleration {
                period,
                damping: or_default(damping),
                target,
            }
        }
        ScaleTable::Target {
            target,
            from,
            to,
            damping,
            times,
        } => Scale::Band(BandSource {
            spectrum: SpectrumSource::File(SpectrumFile {
                file: target.into(),
                damping: or_default(damping),
            }),
            from: Some(from.into()),
            to: Some(to.into()),
            times: or_one(times),
        }),
        ScaleTable::Code {
            code,
            ag,
            ground_type,
            spectrum_type,
            s_ds,
            s_d1,
            t_l,
            from,
            to,
            damping,
            times,
        } => {
            let keys = Keys {
                reader,
                place,
                code,
            };
            let spectrum = match code {
                CodeWord::Eurocode8Of2004 => {
                    keys.none([
                        ("s_ds", s_ds.is_some()),
                        ("s_d1", s_d1.is_some()),
                        ("t_l", t_l.is_some()),
                    ])?;
                    let kind = spectrum_type.map_or(1.0, f64::from);
                    CodeSpectrum::Eurocode8Of2004(Eurocode8Of2004 {
                        ground_acceleration: keys.need("ag", ag)?.into(),
                        ground: keys.need("ground_type", ground_type)?.into(),
                        spectrum: match kind {
                            1.0 => SpectrumType::Type1,
                            2.0 => SpectrumType::Type2,
                            _ => {
                                let message = format!("`spectrum_type` cannot be {kind}");
                                return reader.refuse(place.clone(), message, "write 1 or 2");
                            }
                        },
                        damping: or_default(damping),
                    })
                }
                CodeWord::Asce7Of2016 => {
                    keys.none([
                        ("ag", ag.is_some()),
                        ("ground_type", ground_type.is_some()),
                        ("spectrum_type", spectrum_type.is_some()),
                    ])?;
                    if (or_default(damping) - Asce7Of2016::DAMPING).abs() > 1.0e-12 {
                        let message = "the spectrum of asce_7_2016 is for a damping ratio of 5 %";
                        let help = "leave `damping` out, or give a table with `target`";
                        return reader.refuse(place.clone(), message, help);
                    }
                    CodeSpectrum::Asce7Of2016(Asce7Of2016 {
                        short_period: keys.need("s_ds", s_ds)?.into(),
                        one_second: keys.need("s_d1", s_d1)?.into(),
                        long_transition: keys.need("t_l", t_l)?.into(),
                    })
                }
            };
            Scale::Band(BandSource {
                spectrum: SpectrumSource::Code(Located {
                    value: spectrum,
                    span: place.clone(),
                }),
                from: from.map(f64::from),
                to: to.map(f64::from),
                times: or_one(times),
            })
        }
    })
}

/// Refuses a band of periods that ends before it begins.
fn ascending(reader: &Reader<'_>, place: &Range<usize>, table: &ScaleTable) -> Option<()> {
    let (from, to): (f64, f64) = match *table {
        ScaleTable::Target { from, to, .. } => (from.into(), to.into()),
        ScaleTable::Code {
            from: Some(from),
            to: Some(to),
            ..
        } => (from.into(), to.into()),
        _ => return Some(()),
    };
    if from < to {
        return Some(());
    }
    let message = format!("`from` = {from} s is not below `to` = {to} s");
    reader.refuse(place.clone(), message, "give the smaller one first")
}

/// Keys of the table of a code's spectrum.
struct Keys<'r> {
    reader: &'r Reader<'r>,
    place: &'r Range<usize>,
    code: CodeWord,
}

impl Keys<'_> {
    /// Name of the code, and its keys.
    fn words(&self) -> (&'static str, &'static str) {
        match self.code {
            CodeWord::Eurocode8Of2004 => (
                "eurocode_8_2004",
                "ag and ground_type, and spectrum_type if it is 2",
            ),
            CodeWord::Asce7Of2016 => ("asce_7_2016", "s_ds, s_d1 and t_l"),
        }
    }

    /// The value of a key that the code needs.
    fn need<T>(&self, key: &str, value: Option<T>) -> Option<T> {
        let (code, keys) = self.words();
        value.or_else(|| {
            let message = format!("the spectrum of {code} needs `{key}`");
            let help = format!("give {keys}");
            self.reader.refuse(self.place.clone(), message, help)
        })
    }

    /// Refuses keys of other codes.
    fn none(&self, others: [(&str, bool); 3]) -> Option<()> {
        let (code, keys) = self.words();
        let Some((key, _)) = others.into_iter().find(|(_, given)| *given) else {
            return Some(());
        };
        let message = format!("the spectrum of {code} has no `{key}`");
        let help = format!("it takes {keys}");
        self.reader.refuse(self.place.clone(), message, help)
    }
}
