//! Intensity measures as rows of a table and columns of a file.

use pounding_ground_motion::measures::{IntensityMeasures, Span};

use crate::tables::G;

/// One measure: words and unit for people, name for files, value in SI, factor to the
/// unit for people, digits.
pub struct Measure {
    /// Words with unit.
    pub words: String,
    /// Name with unit, for files.
    pub name: &'static str,
    /// Value (SI); none where the record has none.
    pub value: Option<f64>,
    factor: f64,
    digits: usize,
}

impl Measure {
    /// The value for people.
    pub fn shown(&self) -> String {
        let digits = self.digits;
        self.value
            .map_or("-".to_owned(), |v| format!("{:.digits$}", v * self.factor))
    }
}

/// All measures in the order of the table.
pub fn rows(m: &IntensityMeasures) -> Vec<Measure> {
    let row = |words: &str, name, value: f64, factor, digits| Measure {
        words: words.to_owned(),
        name,
        value: Some(value),
        factor,
        digits,
    };
    let maybe = |words: String, name, value| Measure {
        words,
        name,
        value,
        factor: 1.0,
        digits: 3,
    };
    let threshold = shown(m.options.duration_threshold / G);
    let second = shown(m.options.velocity_threshold / G);
    let bracketed = m.bracketed.as_ref().map(Span::duration);
    vec![
        row(
            "peak acceleration PGA (g)",
            "pga_m_s2",
            m.peak_acceleration.value,
            1.0 / G,
            5,
        ),
        row("  at (s)", "pga_time_s", m.peak_acceleration.time, 1.0, 3),
        row(
            "peak velocity PGV (cm/s)",
            "pgv_m_s",
            m.peak_velocity.value,
            100.0,
            3,
        ),
        row("  at (s)", "pgv_time_s", m.peak_velocity.time, 1.0, 3),
        row(
            "peak displacement PGD (cm)",
            "pgd_m",
            m.peak_displacement.value,
            100.0,
            3,
        ),
        row("  at (s)", "pgd_time_s", m.peak_displacement.time, 1.0, 3),
        row(
            "velocity at the end (cm/s)",
            "end_velocity_m_s",
            m.end_velocity,
            100.0,
            3,
        ),
        row(
            "displacement at the end (cm)",
            "end_displacement_m",
            m.end_displacement,
            100.0,
            3,
        ),
        row(
            "PGV/PGA (s)",
            "pgv_over_pga_s",
            m.velocity_to_acceleration,
            1.0,
            4,
        ),
        row(
            "Arias intensity (m/s)",
            "arias_intensity_m_s",
            m.arias_intensity,
            1.0,
            4,
        ),
        row(
            "duration 5-75 % of it (s)",
            "duration_5_75_s",
            m.significant_5_75.duration(),
            1.0,
            3,
        ),
        row(
            "duration 5-95 % of it (s)",
            "duration_5_95_s",
            m.significant_5_95.duration(),
            1.0,
            3,
        ),
        row(
            "  from (s)",
            "duration_5_95_start_s",
            m.significant_5_95.start,
            1.0,
            3,
        ),
        maybe(
            format!("bracketed duration, {threshold} g (s)"),
            "bracketed_duration_s",
            bracketed,
        ),
        maybe(
            format!("uniform duration, {threshold} g (s)"),
            "uniform_duration_s",
            Some(m.uniform_duration),
        ),
        row(
            "cumulative absolute velocity (m/s)",
            "cav_m_s",
            m.cumulative_absolute_velocity,
            1.0,
            3,
        ),
        maybe(
            format!("  standardised, {second} g (m/s)"),
            "cav_standardised_m_s",
            Some(m.standardised_cumulative_absolute_velocity),
        ),
        row(
            "root mean square over 5-95 % (g)",
            "rms_acceleration_m_s2",
            m.root_mean_square_acceleration,
            1.0 / G,
            5,
        ),
        row(
            "characteristic intensity (m^1.5/s^2.5)",
            "characteristic_intensity_si",
            m.characteristic_intensity,
            1.0,
            3,
        ),
        row(
            "specific energy density (m2/s)",
            "specific_energy_density_m2_s",
            m.specific_energy_density,
            1.0,
            4,
        ),
        row(
            "Housner intensity (m)",
            "housner_intensity_m",
            m.housner_intensity,
            1.0,
            4,
        ),
        row(
            "acceleration spectrum intensity (g s)",
            "acceleration_spectrum_intensity_m_s",
            m.acceleration_spectrum_intensity,
            1.0 / G,
            4,
        ),
        maybe("mean period (s)".to_owned(), "mean_period_s", m.mean_period),
        row(
            "predominant period (s)",
            "predominant_period_s",
            m.predominant_period,
            1.0,
            3,
        ),
    ]
}

fn shown(value: f64) -> String {
    format!("{}", (value * 1.0e6).round() / 1.0e6)
}
