//! The band of periods over which a record comes near to a spectrum.

use std::ops::Range;

use pounding_case::{BandSource, Case, CaseError, SpectrumSource};
use pounding_catalogue::numbers;
use pounding_ground_motion::processing::BandTarget;
use pounding_ground_motion::spectra::TargetSpectrum;

use super::parts::fundamental_periods;

/// The band (s) where there are no buildings whose periods could say another.
const WITHOUT_BUILDINGS: (f64, f64) = (0.1, 3.0);

/// A period (s) to a tenth of a millisecond.
fn shown(period: f64) -> String {
    numbers::six_digits((1.0e4 * period).round() / 1.0e4)
}

/// The band of a case: what it gives, and else what the code asks for with the fundamental
/// periods of its buildings, within the range of the spectrum.
pub(super) fn band_of_case(
    case: &Case,
    band: &BandSource,
    spectrum: TargetSpectrum,
    place: Range<usize>,
) -> Result<BandTarget, CaseError> {
    let code = match (&band.spectrum, band.from, band.to) {
        (SpectrumSource::Code(code), from, to) if from.is_none() || to.is_none() => code.value,
        _ => return Ok(band_without_case(band, spectrum)),
    };
    let periods = fundamental_periods(case)?;
    let smallest = periods.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = periods.iter().copied().fold(0.0, f64::max);
    let ((low, high), clause) = code.band();
    let range = spectrum.range();
    let (first, last) = (low * smallest, high * greatest);
    let from = band.from.unwrap_or(first.max(range.0));
    let to = band.to.unwrap_or(last.min(range.1));
    if !(from < to) {
        let message = format!(
            "no band of periods is left between {} and {} s: the spectrum of {} reaches from {} to {} s, and fundamental periods of the buildings from {} to {} s",
            shown(from),
            shown(to),
            code.name(),
            shown(range.0),
            shown(range.1),
            shown(smallest),
            shown(greatest),
        );
        let help = "give `from` and `to`, or the factor".to_owned();
        return Err(case.error(place, message, Some(help)));
    }
    let periods = match smallest == greatest {
        true => format!("T1 = {} s", shown(smallest)),
        false => format!(
            "T1 of the buildings from {} to {} s",
            shown(smallest),
            shown(greatest)
        ),
    };
    let mut said = Vec::new();
    if band.from.is_none() {
        said.push(match first < range.0 {
            true => format!("from {} s, where the spectrum begins", shown(range.0)),
            false => format!("from {low} T1 = {} s", shown(from)),
        });
    }
    if band.to.is_none() {
        said.push(match last > range.1 {
            true => format!(
                "to {} s, where the spectrum ends before {high} T1",
                shown(range.1)
            ),
            false => format!("to {high} T1 = {} s", shown(to)),
        });
    }
    Ok(BandTarget {
        spectrum,
        from,
        to,
        times: band.times,
        reason: format!("{} by {clause}, {periods}", said.join(" ")),
    })
}

/// The band of a step that stands beside no case: what it gives, and else a fixed one.
pub(super) fn band_without_case(band: &BandSource, spectrum: TargetSpectrum) -> BandTarget {
    let (from, to) = WITHOUT_BUILDINGS;
    let reason = match (band.from, band.to) {
        (Some(_), Some(_)) => String::new(),
        _ => format!("{from} to {to} s where none are given: no buildings say their periods here"),
    };
    BandTarget {
        spectrum,
        from: band.from.unwrap_or(from),
        to: band.to.unwrap_or(to),
        times: band.times,
        reason,
    }
}
