//! Words of headers that say another quantity, peak, rate, duration or unit than the values have, formats that the file
//! has not, and sentences that state the unit.
use std::fmt::Write as _;

use crate::common::fixtures;
use pounding_ground_motion::{
    AccelerationUnit, Format, ReadOptions, Recording, read_all_bytes, read_bytes,
};

fn told(text: &str, options: &ReadOptions) -> Result<Recording, String> {
    let found = read_all_bytes("f", text.as_bytes(), options);
    found.map_err(|e| format!("{e}; {}", e.help().unwrap_or_default()))
}

fn warnings(text: &str, options: &ReadOptions) -> Vec<String> {
    told(text, options).unwrap().series[0]
        .origin
        .warnings
        .clone()
}

fn value(i: usize) -> f64 {
    0.3 * f64::sin(0.7 * i as f64 + 0.1)
}

fn columns(header: &str, names: &str) -> String {
    let mut text = format!("{header}\n{names}\n");
    for i in 0..60 {
        writeln!(text, "{:.2} {:.5}", 0.02 * i as f64, value(i)).unwrap();
    }
    text
}

fn gal() -> ReadOptions {
    ReadOptions {
        unit: Some(AccelerationUnit::Gal),
        ..ReadOptions::default()
    }
}

#[test]
fn titles_of_velocities_and_displacements() {
    for (title, quantity) in [
        ("Velocity data in cm/s", "velocity"),
        ("Velocity record", "velocity"),
        ("Velocity record, El Centro NS", "velocity"),
        ("Velocity record, El Centro, 1940, NS", "velocity"),
        ("Velocity seismogram NS", "velocity"),
        ("Velocity (integrated)", "velocity"),
        ("corrected velocity, NS", "velocity"),
        ("velocity of ground at El Centro", "velocity"),
        ("Velocidad NS", "velocity"),
        ("displacement trace", "displacement"),
        ("Displacement record of station X", "displacement"),
        ("Desplazamiento NS", "displacement"),
        ("# Velocity record", "velocity"),
    ] {
        let said = warnings(&columns(title, "t NS"), &gal());
        let told = format!("speaks of a {quantity}, but the values");
        assert!(said.iter().any(|w| w.contains(&told)), "{title}: {said:?}");
    }
    for title in [
        "Acceleration, velocity and displacement of El Centro",
        "shear wave velocity 200 m/s",
        "Vs30 = 200 m/s, velocity of the site",
        "displacement control",
        "displacement controlled test, NS",
        "peak ground velocity: 3 cm/s",
        "velocity pulse, NS",
        "Velocity record: see file X.VT2",
        "Velocity, 200 m/s at the site",
        "Acceleration record of a velocity sensor",
        "aceleracion y velocidad NS",
        "differentiated velocity record",
        "velocity not integrated",
        "Velocity at 30 m depth 300 m/s",
        "Velocity at surface 300 m/s",
        "velocity at 3.2 s 0.1",
        "Displacement (permanent) 3 cm",
        "Displacement (static) 0.3 m",
        "Displacement at roof 3 cm",
        "Velocity (PGV) 12",
        "Velocity NS 12.3 cm/s",
        "horizontal velocity component 12 cm/s",
        "Velocity data in other file",
        "Velocity records are given in .vt2",
        "Velocity data available on request",
        "Displacement history - none",
        "Velocity signal is in column 3",
        "Velocity data processing",
        "Acceleration record\nVelocity, El Centro",
    ] {
        let said = warnings(&columns(title, "t NS"), &gal());
        assert!(
            !said.iter().any(|w| w.contains("speaks of a")),
            "{title}: {said:?}"
        );
    }
}

fn at2(more: &str) -> String {
    at2_of(
        "QUAKE, STATION, 90",
        &format!("NPTS= 400, DT= .02 SEC{more}"),
    )
}

fn at2_of(second: &str, counts: &str) -> String {
    let mut text = format!("PEER\n{second}\nACCELERATION TIME SERIES IN UNITS OF G\n{counts}\n");
    for i in 0..400 {
        write!(text, "{:10.5}", value(i)).unwrap();
        text += if i % 8 == 7 { "\n" } else { "" };
    }
    text
}

#[test]
fn words_behind_the_counts_of_at2() {
    let strict = ReadOptions::default();
    for right in [
        "",
        ", PEAK= 0.3 G",
        ", PEAK ACCELERATION= 0.3 G",
        ", MAX= 0.1 G",
        ", MIN= -0.1, MAX= 0.1",
        ", PEAK= 12.3 CM/S",
        ", PEAK= 294.2",
        ", SIGNIFICANT, DURATION 3.2 SEC",
        ", RESAMPLED FROM (200 SPS)",
        ", DIGITIZED (200 SPS)",
        ", PEAK= 0.5 G (EW COMPONENT)",
        ", INPUT (CM/S2)",
        ", ORIGINAL: (RATE 200 HZ)",
        ", DECIMATED FROM RECORD OF, 200 SPS",
        ", CONVERTED FROM (CM/S2)",
        ", 100 HZ",
        ", 50 HZ",
        " (50 SPS)",
        ", RATE 50 HZ",
        ", G",
        ", UNIT G",
        ", LP= 25 HZ",
        ", 25 HZ LOW-PASS",
    ] {
        let found = warnings(&at2(right), &strict);
        assert!(
            found.iter().all(|w| w.contains("the mean")),
            "{right}: {found:?}"
        );
    }
    for wrong in [
        ", PEAK= 0.5 G",
        ", PEAK ACCELERATION= 0.5 G",
        " (100 SPS)",
        ", RATE 100 HZ",
        ", RATE= 100 HZ",
        ", CM/S2",
        " (CM/S2)",
        ", UNIT CM/S2",
    ] {
        let said = told(&at2(wrong), &strict).unwrap_err();
        assert!(
            said.starts_with("f:4:") || said.starts_with("f:3:"),
            "{wrong}: {said}"
        );
    }
    // A title tells of more than its values.
    for title in [
        "QUAKE (PEAK ACC= 0.35 G UNCORRECTED), 90",
        "PEAK ACCELERATION= 0.5 G (TARGET), 90",
    ] {
        told(&at2_of(title, "NPTS= 400, DT= .02 SEC"), &strict).unwrap();
    }
}

#[test]
fn frequencies_and_largest_values_above_plain_columns_may_be_of_anything() {
    let head = |more: &str| {
        let mut text = format!("# unit: g\n# dt: 0.02 s\n{more}\n");
        for i in 0..60 {
            writeln!(text, "{:.5}", value(i)).unwrap();
        }
        text
    };
    let strict = ReadOptions::default();
    let filter = head("# Filter corners:\n# 0.1 Hz\n# 25 Hz").replace("# dt: 0.02 s\n", "");
    let said = told(&filter, &strict).unwrap_err();
    assert!(said.contains("time step"), "{said}");
    for right in [
        "# 100 Hz",
        "# Low pass\n# 30 Hz",
        "# Min: -0.1 g\n# Max: 0.1 g",
        "# Peak: 0.35 g (uncorrected)",
        "# Maximum = 4 g sensor",
        "# Peak: 3 cm/s",
        "# Peak factor: 0.5",
        "# 2 Hz",
    ] {
        let found = warnings(&head(right), &strict);
        assert!(
            found.iter().all(|w| w.contains("the mean")),
            "{right}: {found:?}"
        );
    }
}

#[test]
fn microseconds_are_no_seconds() {
    for unit in ["us", "\u{b5}s", "\u{3bc}s", "\u{b5}S"] {
        for blank in ["", " "] {
            let counts = format!("NPTS= 400, DT= 20000{blank}{unit}");
            let said = told(
                &at2_of("QUAKE, STATION, 90", &counts),
                &ReadOptions::default(),
            );
            let said = said.unwrap_err();
            assert!(
                said.contains("is not a unit of a time step"),
                "{unit}: {said}"
            );
        }
    }
    // As Latin-1 has it.
    let text = at2_of("QUAKE, STATION, 90", "NPTS= 400, DT= 20000 \u{b5}s");
    let bytes: Vec<u8> = text.chars().map(|c| c as u8).collect();
    read_all_bytes("f", &bytes, &ReadOptions::default()).unwrap_err();
}

#[test]
fn sampling_frequencies_of_k_net_are_in_hertz() {
    let fixture = fixtures("k_net", 0).remove(0);
    let text = String::from_utf8(fixture.bytes).unwrap();
    let right = "Sampling Freq(Hz) 100Hz";
    assert!(text.contains(right));
    for (key, unit) in [
        ("(Hz)", "100"),
        ("(Hz)", "100 Hz"),
        ("(Hz)", "100HZ"),
        ("(Hz)", "100sps"),
        ("(Hz)", "1.0E+02Hz"),
        ("(Hz)", "100Hz."),
        ("(Hz)", "100Hz(nominal)"),
        ("(sps)", "100"),
    ] {
        let text = text.replace(right, &format!("Sampling Freq{key} {unit}"));
        told(&text, &fixture.options).unwrap();
    }
    for (key, unit, named) in [
        ("(Hz)", "50ms", "ms"),
        ("(Hz)", "50s", "s"),
        ("(Hz)", "50kHz", "kHz"),
        ("(ms)", "50", "ms"),
    ] {
        let text = text.replace(right, &format!("Sampling Freq{key} {unit}"));
        let said = told(&text, &fixture.options).unwrap_err();
        assert!(
            said.contains(&format!("\"{named}\" where the format has")),
            "{said}"
        );
    }
}

#[test]
fn formats_that_the_file_has_not() {
    let table = columns("", "time_s,ns (cm/s2),ew (cm/s2)").replace(' ', ",");
    let forced = |format: &str| ReadOptions {
        format: Some(Format::find(format).unwrap()),
        time_step: Some(0.02),
        unit: Some(AccelerationUnit::StandardGravity),
        ..ReadOptions::default()
    };
    let table = table.trim_start().replace("ns,(cm/s2)", "ns (cm/s2)");
    let said = told(&table, &forced("jma_csv")).unwrap_err();
    assert!(
        said.starts_with("f:1:") && said.contains("does not look like jma_csv"),
        "{said}"
    );
    assert!(said.contains("SITE CODE"), "{said}");
    let of_exponents = at2("").replace("   0.02995", " 2.995E-02");
    for text in [at2(""), of_exponents, table] {
        let said = told(&text, &forced("nsmn")).unwrap_err();
        assert!(said.contains("does not look like nsmn"), "{said}");
    }
}

#[test]
fn a_comma_that_ends_the_second_line_of_at2() {
    for second in ["QUAKE, STATION, 180,", "QUAKE, STATION, 180 , "] {
        let text = at2_of(second, "NPTS= 400, DT= .02 SEC");
        let record = read_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap();
        assert_eq!(record.origin().unwrap().component, "180");
    }
}

#[test]
fn units_in_sentences() {
    for title in [
        "The unit of acceleration is cm/s2",
        "Units of acceleration are cm/s2.",
        "Acceleration (cm/s2) vs time",
    ] {
        let found = told(&columns(title, "t NS"), &ReadOptions::default()).unwrap();
        assert_eq!(found.series[0].unit, "cm/s2", "{title}");
    }
}

#[test]
fn counts_and_angles_of_sac_that_are_none() {
    let fixture = fixtures("sac", 0).remove(0);
    let is_big = i32::from_be_bytes(fixture.bytes[304..308].try_into().unwrap()) == 6;
    let with = |word: usize, four: u32| {
        let mut bytes = fixture.bytes.clone();
        let four = if is_big {
            four.to_be_bytes()
        } else {
            four.to_le_bytes()
        };
        bytes[4 * word..4 * word + 4].copy_from_slice(&four);
        read_all_bytes("f", &bytes, &fixture.options)
    };
    let said = with(79, (-5_i32) as u32).unwrap_err().to_string();
    assert!(said.contains("the header says -5 samples"), "{said}");
    let found = with(57, 500.0_f32.to_bits()).unwrap();
    let warnings = &found.series[0].origin.warnings;
    assert!(warnings.iter().any(|w| w.contains("500")), "{warnings:?}");
}

#[test]
fn steps_of_uneven_times_are_rounded() {
    let mut text = String::from("time (s),acceleration (g)\n");
    for i in 0..200_u32 {
        let late = if i % 7 == 0 { 0.003 } else { 0.0 };
        let time = 0.02 * f64::from(i) + late;
        writeln!(text, "{time:.3},{:.5}", value(i as usize)).unwrap();
    }
    let options = ReadOptions {
        time_step: Some(0.019_999_999_999_999_827),
        ..ReadOptions::default()
    };
    let record = read_bytes("f", text.as_bytes(), &options).unwrap();
    let warnings = &record.origin().unwrap().warnings;
    assert!(
        warnings.iter().any(|w| w.contains("resampled to 0.02 s")),
        "{warnings:?}"
    );
}
