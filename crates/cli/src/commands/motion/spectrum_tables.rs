//! Spectra as tables for people and columns for programs.

use std::fmt::Write as _;

use pounding_ground_motion::spectra::{ResponseSpectrum, RotatedSpectrum};

use pounding_report::pictures::motion::percent;

use crate::tables::{G, new_long_table};

/// A table a damping ratio.
pub fn response_text(spectra: &[ResponseSpectrum]) -> String {
    let mut text = String::new();
    for s in spectra {
        let mut table = new_long_table([
            "period (s)",
            "displacement SD (mm)",
            "pseudo-velocity PSV (m/s)",
            "pseudo-acceleration PSA (g)",
            "relative velocity SV (m/s)",
            "absolute acceleration SA (g)",
        ]);
        for (i, period) in s.periods.iter().enumerate() {
            table.add_row([
                format!("{period:.4}"),
                format!("{:.4}", s.displacement[i] * 1.0e3),
                format!("{:.5}", s.pseudo_velocity[i]),
                format!("{:.5}", s.pseudo_acceleration[i] / G),
                format!("{:.5}", s.velocity[i]),
                format!("{:.5}", s.acceleration[i] / G),
            ]);
        }
        let _ = writeln!(text, "\n{}\n{table}", percent(s.damping));
    }
    text
}

/// A row a damping ratio and period.
pub fn response_csv(spectra: &[ResponseSpectrum]) -> String {
    let mut text = "damping_ratio,period_s,sd_m,psv_m_s,psa_m_s2,sv_m_s,sa_m_s2\n".to_owned();
    for s in spectra {
        for (i, period) in s.periods.iter().enumerate() {
            let _ = writeln!(
                text,
                "{},{period},{},{},{},{},{}",
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
