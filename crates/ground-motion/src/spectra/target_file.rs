//! A target from a file: a table of periods and pseudo-accelerations.

use std::path::Path;

use crate::error::GroundMotionError;
use crate::regular_file::regular;
use crate::spectra::TargetSpectrum;
use crate::unit::AccelerationUnit;

const REMEDY: &str =
    "the header must be `period_s,psa_UNIT` with UNIT one of g, m_s2, cm_s2; rows are two numbers";

impl TargetSpectrum {
    /// Reads a table with the header `period_s,psa_g` (or `psa_m_s2`, `psa_cm_s2`) and
    /// a row a point, periods (s) increasing, straight lines in the logarithms of both between them;
    /// lines that start with `#` are comments.
    /// `damping` is the ratio that the values are for.
    ///
    /// # Errors
    /// A file that cannot be read, a header without unit, or a row that is not two
    /// numbers: with line and column. Else as [`TargetSpectrum::new`].
    pub fn read(path: &Path, damping: f64) -> Result<Self, GroundMotionError> {
        let file = path.display().to_string();
        regular(path, &file)?;
        let text = std::fs::read_to_string(path).map_err(|source| GroundMotionError::Io {
            file: file.clone(),
            source,
        })?;
        Self::parse(&file, &text, damping)
    }

    /// As [`TargetSpectrum::read`], from a text; `file` names it in messages.
    ///
    /// # Errors
    /// As [`TargetSpectrum::read`].
    pub fn parse(file: &str, text: &str, damping: f64) -> Result<Self, GroundMotionError> {
        let wrong = |line: usize, column: usize, message: String| GroundMotionError::Parse {
            file: file.to_owned(),
            line: line + 1,
            column: column + 1,
            message,
            remedy: REMEDY.to_owned(),
        };
        let mut unit: Option<AccelerationUnit> = None;
        let (mut periods, mut accelerations) = (Vec::new(), Vec::new());
        for (number, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
            if line.trim().is_empty() || line.starts_with('#') {
                continue;
            }
            let Some((left, right)) = line.split_once(',') else {
                return Err(wrong(number, 0, "there must be two columns".to_owned()));
            };
            let Some(unit) = unit else {
                let symbol = right.trim().strip_prefix("psa_");
                let stated = symbol.and_then(|s| s.replace("_s2", "/s2").parse().ok());
                if left.trim() != "period_s" || stated.is_none() {
                    let message = format!("\"{line}\" is not a header with units");
                    return Err(wrong(number, 0, message));
                }
                unit = stated;
                continue;
            };
            let mut values = [0.0; 2];
            for (value, (text, column)) in values
                .iter_mut()
                .zip([(left, 0), (right, left.chars().count() + 1)])
            {
                *value = match text.trim().parse() {
                    Ok(x) if f64::is_finite(x) => x,
                    _ => {
                        let message = format!("\"{}\" is not a number", text.trim());
                        return Err(wrong(number, column, message));
                    }
                };
            }
            periods.push(values[0]);
            accelerations.push(values[1] * unit.in_si());
        }
        if unit.is_none() {
            return Err(wrong(0, 0, "there is no header".to_owned()));
        }
        Ok(Self::new(periods, accelerations, damping)?.named(file))
    }
}
