//! Spectra as tables for people and columns for programs.

use std::fmt::Write as _;

use pounding_ground_motion::spectra::design::CodeSpectrum;
use pounding_ground_motion::spectra::{ResponseSpectrum, RotatedSpectrum};

use pounding_report::pictures::motion::percent;

use crate::tables::{G, new_long_table};

/// A table a damping ratio.
///
/// `codes` are spectra of a code to stand beside, one for each damping ratio, or none.
pub fn response_text(spectra: &[ResponseSpectrum], codes: &[CodeSpectrum]) -> String {
    let mut text = String::new();
    for (number, s) in spectra.iter().enumerate() {
        let mut header = vec![
            "period (s)",
            "displacement SD (mm)",
            "pseudo-velocity PSV (m/s)",
            "pseudo-acceleration PSA (g)",
            "relative velocity SV (m/s)",
            "absolute acceleration SA (g)",
        ];
        let code = codes.get(number);
        if code.is_some() {
            header.extend(["code (g)", "PSA / code"]);
        }
        let mut table = new_long_table(header);
        for (i, period) in s.periods.iter().enumerate() {
            let mut row = vec![
                format!("{period:.4}"),
                format!("{:.4}", s.displacement[i] * 1.0e3),
                format!("{:.5}", s.pseudo_velocity[i]),
                format!("{:.5}", s.pseudo_acceleration[i] / G),
                format!("{:.5}", s.velocity[i]),
                format!("{:.5}", s.acceleration[i] / G),
            ];
            if let Some(code) = code {
                let target = code.acceleration(*period);
                row.push(format!("{:.5}", target / G));
                row.push(format!("{:.3}", s.pseudo_acceleration[i] / target));
            }
            table.add_row(row);
        }
        let _ = writeln!(text, "\n{}\n{table}", percent(s.damping));
        if let Some(code) = code {
            let _ = writeln!(text, "code: {} ({})", code.title(), code.clause());
        }
    }
    text
}

/// A row a damping ratio and period.
///
/// A last column for spectra of a code, if there are any.
pub fn response_csv(spectra: &[ResponseSpectrum], codes: &[CodeSpectrum]) -> String {
    let mut text = "damping_ratio,period_s,sd_m,psv_m_s,psa_m_s2,sv_m_s,sa_m_s2".to_owned();
    text.push_str(if codes.is_empty() {
        "\n"
    } else {
        ",code_psa_m_s2\n"
    });
    for (number, s) in spectra.iter().enumerate() {
        for (i, period) in s.periods.iter().enumerate() {
            let code = codes.get(number);
            let code = code.map_or(String::new(), |c| format!(",{}", c.acceleration(*period)));
            let _ = writeln!(
                text,
                "{},{period},{},{},{},{},{}{code}",
                s.damping,
                s.displacement[i],
                s.pseudo_velocity[i],
                s.pseudo_acceleration[i],
                s.velocity[i],
                s.acceleration[i]
            );
        }
    }
    text
}

/// A table a damping ratio.
pub fn rotated_text(spectra: &[RotatedSpectrum]) -> String {
    let mut text = String::new();
    for s in spectra {
        let mut table = new_long_table([
            "period (s)",
            "RotD50 of PSA (g)",
            "RotD100 of PSA (g)",
            "RotD100/RotD50",
            "direction of RotD100 (degrees)",
        ]);
        for (i, period) in s.periods.iter().enumerate() {
            table.add_row([
                format!("{period:.4}"),
                format!("{:.5}", s.median[i] / G),
                format!("{:.5}", s.maximum[i] / G),
                format!("{:.3}", s.maximum[i] / s.median[i]),
                format!("{:.0}", s.direction_of_maximum[i]),
            ]);
        }
        let _ = writeln!(
            text,
            "\n{}, directions from the first component towards the second\n{table}",
            percent(s.damping)
        );
    }
    text
}

/// A row a damping ratio and period.
pub fn rotated_csv(spectra: &[RotatedSpectrum]) -> String {
    let mut text =
        "damping_ratio,period_s,rotd50_psa_m_s2,rotd100_psa_m_s2,direction_degrees\n".to_owned();
    for s in spectra {
        for (i, period) in s.periods.iter().enumerate() {
            let _ = writeln!(
                text,
                "{},{period},{},{},{}",
                s.damping, s.median[i], s.maximum[i], s.direction_of_maximum[i]
            );
        }
    }
    text
}

/// A row a frequency.
pub fn fourier_csv(frequencies: &[f64], amplitudes: &[f64]) -> String {
    let mut text = "frequency_hz,amplitude_m_s\n".to_owned();
    for (f, a) in frequencies.iter().zip(amplitudes) {
        let _ = writeln!(text, "{f},{a}");
    }
    text
}

/// A table.
pub fn fourier_text(frequencies: &[f64], amplitudes: &[f64], how: &str) -> String {
    let mut table = new_long_table(["frequency (Hz)", "amplitude (m/s)"]);
    for (f, a) in frequencies.iter().zip(amplitudes) {
        table.add_row([format!("{f:.4}"), format!("{a:.6}")]);
    }
    format!("\nFourier amplitude of acceleration, {how}\n{table}\n")
}
