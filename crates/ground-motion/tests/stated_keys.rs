//! Keys before plain columns in the spellings of those who write them.
use pounding_ground_motion::{
    AccelerationUnit, GroundMotionError, ReadOptions, Series, read_all_bytes,
};

fn read_with(text: &str, options: &ReadOptions) -> Result<Vec<Series>, GroundMotionError> {
    read_all_bytes("file.txt", text.as_bytes(), options).map(|recording| recording.series)
}

/// A record of 40 values, of which the largest is 0.3, below a header.
fn read(header: &str) -> Result<Vec<Series>, GroundMotionError> {
    let values: String = (0..40)
        .map(|i| {
            format!(
                "{:.4}\n",
                0.3 * (0.5 * std::f64::consts::PI * f64::from(i) / 3.0).sin()
            )
        })
        .collect();
    read_with(&format!("{header}\n{values}"), &ReadOptions::default())
}

#[track_caller]
fn is_read(header: &str, step: f64, unit: &str) -> Vec<String> {
    let series = read(header).unwrap_or_else(|e| panic!("{header}: {e}"));
    assert_eq!((series.len(), series[0].samples.len()), (1, 40), "{header}");
    let found = series[0].sampling.median_step();
    assert!((found - step).abs() < 1e-12, "{header}: {found}");
    assert_eq!(series[0].unit, unit, "{header}");
    series[0].origin.warnings.clone()
}

#[track_caller]
fn refused(header: &str, expected: &str) {
    let said = read(header).unwrap_err().to_string();
    assert!(said.contains(expected), "{header}: {said}");
}

#[test]
fn steps_rates_and_units() {
    for (header, step, unit) in [
        ("Frequency: 200 Hz\nUnits: gal", 0.005, "cm/s2"),
        ("Frequency (Hz): 200\nunits: g", 0.005, "g"),
        ("Time-step: 0.01 s\nUnidad: gal", 0.01, "cm/s2"),
        ("# Sampling-rate = 100\n# Y unit: gal", 0.01, "cm/s2"),
        ("dt 0.01\nin gal", 0.01, "cm/s2"),
        ("dt 0.01 s\nvalues in g", 0.01, "g"),
        ("\u{394}t = 0.01 s\nunidad de medida: cm/s2", 0.01, "cm/s2"),
        (
            "\u{2206}t = 10 ms\nunit of acceleration: m/s2",
            0.01,
            "m/s2",
        ),
        ("dt=0.01, units=g, npts=40", 0.01, "g"),
        ("Units: g, dt: 0.01, samples: 40", 0.01, "g"),
        ("sampling rate 100 Hz\nUnit\u{e9}: m/s\u{b2}", 0.01, "m/s2"),
        ("Samples 40\nDT 0.02\nEinheit: g", 0.02, "g"),
    ] {
        let warnings = is_read(header, step, unit);
        assert!(warnings.is_empty(), "{header}: {warnings:?}");
    }
    // Units of times and values, of which none is said to be that of the values.
    refused("units: s, g; dt: 0.01", "does not state the unit");
    // Of a sine or a filter, not of sampling.
    for header in [
        "Frequency: 2 Hz\nunits: g",
        "corner frequency: 25 Hz\nunits: g",
    ] {
        refused(header, "does not state its time step");
    }
    let table = "TIME ACCEL (in g)\n0.0 0.1\n0.1 0.2\n0.2 -0.3\n0.3 0.1\n";
    let series = read_with(table, &ReadOptions::default()).unwrap();
    assert_eq!((series[0].unit, series[0].samples.len()), ("g", 4));
}

/// Keys of steps and rates in the languages of the agencies and the spellings of programs, commented or not.
#[test]
fn steps_in_many_spellings() {
    for line in [
        "Paso de tiempo: 0.01 s",
        "Frecuencia de muestreo: 100 Hz",
        "Intervalo de tempo: 0.01 s",
        "Zeitschritt (s): 0,01",
        "Abtastrate: 100 Hz",
        "Passo temporale: 0.01 s",
        "Intervallo di campionamento: 0.01",
        "Pas de temps: 0.01 s",
        "Fr\u{e9}quence d'\u{e9}chantillonnage: 100 Hz",
        "\u{d6}rnekleme aral\u{131}\u{11f}\u{131}: 0.01 s",
        "dt,0.01",
        "time step;0.01",
        "sampling_rate_hz,100",
        "timestep_s: 0.01",
        "Time step, s: 0.01",
        "DT(s)=0.01",
        "delta_t: 0.01",
        "Interval: 0.01 s",
        "Delta: 0.01 sec",
        "Rate = 100 Hz",
        "Sampling rate: 100 Hertz",
        "Sampling interval: 1/100 s",
        "SamplingRate=100",
        "Samples/s: 100",
    ] {
        is_read(&format!("# {line}\n# Units: g"), 0.01, "g");
        is_read(&format!("A title\n{line}\nUnits: g"), 0.01, "g");
    }
    // Of a window, of a distance, of a day.
    for line in [
        "Interval: 30 s",
        "Delta: 0.35",
        "samples: 2020/01/05",
        "Rate = 4 Hz",
    ] {
        refused(
            &format!("# {line}\n# Units: g"),
            "does not state its time step",
        );
    }
}

#[test]
fn units_in_many_spellings() {
    for (line, unit) in [
        ("Units: \"g\"", "g"),
        ("Units: g (9.81 m/s2)", "g"),
        ("Unit: 1 g", "g"),
        ("Units\tg", "g"),
        ("units,g", "g"),
        ("Units of g", "g"),
        ("Units: fraction of g", "g"),
        ("Units: milli-g", "mg"),
        ("Accelerations are in g", "g"),
        ("Acceleration time history in g", "g"),
        ("Acceleration Time Series (g)", "g"),
        ("Acceleration Data (cm/sec^2)", "cm/s2"),
        ("Units: cm/s2 (gal)", "cm/s2"),
        ("\u{130}vme (cm/sn2)", "cm/s2"),
        ("Aceleraci\u{f3}n (cm/s2)", "cm/s2"),
        ("Units: centimeters per second squared", "cm/s2"),
        ("Units: metres per second per second", "m/s2"),
    ] {
        is_read(&format!("# dt = 0.01 s\n# {line}"), 0.01, unit);
        is_read(&format!("A title\ndt = 0.01 s\n{line}"), 0.01, unit);
    }
    // Two units, and one that is that of a peak.
    refused("# dt = 0.01\n# Units: g (cm/s2)", "is not used");
    refused(
        "# dt = 0.01\n# Peak acceleration is in g",
        "does not state the unit",
    );
}

/// Steps of other stages of the record, of filters, windows and instruments state none.
#[test]
fn steps_of_something_else() {
    for line in [
        "dt = 0.005 s (original), 0.01 s (this file)",
        "Time step: 0.005 s, now 0.01 s",
        "Time step: 0.005 s, interpolated to 0.01 s",
        "Sampling rate (original): 200 Hz",
        "Resampled from fs=200 Hz",
        "Sampling rate before decimation: 200 Hz",
        "Orijinal \u{f6}rnekleme frekans\u{131}: 200 Hz",
        "Analysis time step: 0.001 s",
        "Interval: 0.05 s taper",
        "Delta: 0.05 s (clock correction)",
        "Spatial sampling interval: 0.05",
        "Low-pass filter, frequency = 25 Hz",
        "Frequency (natural): 50 Hz",
        "GPS sampling rate: 50 Hz",
        "Rate: 100",
    ] {
        refused(
            &format!("# {line}\n# Units: g"),
            "does not state its time step",
        );
    }
    for line in [
        "ZAMAN ADIMI: 0.01 s",
        "\u{d6}RNEKLEME FREKANSI: 100 Hz",
        "ORNEKLEME ARALIGI: 0.01",
        "Tasa de muestreo: 100 muestras/s",
    ] {
        is_read(&format!("# {line}\n# B\u{130}R\u{130}M: g"), 0.01, "g");
    }
    refused(
        "# Time unit: ms\n# dt: 10\n# Units: g",
        "the times are in ms here",
    );
    for line in [
        "units=g factor=0.001",
        "Units: g\n# SF = 0.001",
        "Units: g\n# Factor de escala: 0.001",
        "Units: g\n# Values multiplied by 1000",
    ] {
        let warnings = is_read(&format!("# dt = 0.01 s\n# {line}"), 0.01, "g");
        assert!(
            warnings.iter().any(|w| w.contains("factor")),
            "{line}: {warnings:?}"
        );
    }
}

/// A line of a key has as many words as there are columns, and names none of them; names have their units in
/// cells of their own, or in other languages.
#[test]
fn columns_below_keys() {
    let rows = |columns: usize| -> String {
        (0..40)
            .map(|i| {
                let t = 0.01 * f64::from(i);
                let more: String = (1..columns)
                    .map(|k| format!(",{:.4}", 0.1 * k as f64 * (50.0 * t).sin()))
                    .collect();
                format!("{t:.2}{more}\n")
            })
            .collect()
    };
    for (header, columns) in [
        ("Units: g\nTime step: 0.01 s", 4),
        ("Units: g\nTime increment: 0.01 s", 4),
        ("Units: g\nTime step: 0.01", 3),
        ("# Units: g\n# dt = 0.01 s", 4),
    ] {
        let rows = rows(columns).replace(',', " ");
        let series = read_with(&format!("{header}\n{rows}"), &ReadOptions::default()).unwrap();
        assert_eq!(series.len(), columns - 1, "{header}");
        let peak = series[0]
            .samples
            .iter()
            .fold(0.0_f64, |m, a| m.max(a.abs()));
        assert!((peak / 9.806_65 - 0.1).abs() < 2e-3, "{header}: {peak}");
    }
    let third = |header: &str, columns: usize| {
        let text = format!("{header}\n{}", rows(columns));
        let series =
            read_with(&text, &ReadOptions::default()).unwrap_or_else(|e| panic!("{header}: {e}"));
        assert_eq!(series.len(), 1, "{header}");
        let peak = series[0]
            .samples
            .iter()
            .fold(0.0_f64, |m, a| m.max(a.abs()));
        (peak / series[0].unit_in_si, series[0].unit)
    };
    for (header, unit) in [
        (
            "Units: cm/s2\nTime, s,Velocity (cm/s),Acceleration (cm/s2)",
            "cm/s2",
        ),
        ("Time, s,Velocity, cm/s,Acceleration, cm/s2", "cm/s2"),
        ("Units: g\nTempo,Velocidade,Acelera\u{e7}\u{e3}o", "g"),
        ("Units: g\nTime,Ground vel,Ground acc", "g"),
        ("Units: g\nTiempo,Velocidad,Aceleracion", "g"),
    ] {
        let (peak, found) = third(header, 3);
        assert_eq!(found, unit, "{header}");
        assert!((peak - 0.2).abs() < 4e-3, "{header}: {peak}");
    }
    let rows_of_one = "Acc (mm/s2)\ndt=0.01\n0.0\n486.1\n938.5\n-1,461.5\n-515.5\n120.0\n";
    let said = read_with(rows_of_one, &ReadOptions::default())
        .unwrap_err()
        .to_string();
    assert!(
        said.contains("file.txt:6") && said.contains("parts thousands"),
        "{said}"
    );
    for header in [
        "VELOCITY\nNPTS= 40, DT= .01 SEC, units g",
        "dt: 0.01\nThreshold acceleration in g",
        "dt: 0.01\nSpectral acceleration in g",
    ] {
        assert!(read(header).is_err(), "{header}");
    }
    for header in [
        "Units: g\nTiempo,Velocidad",
        "Units: g\nZeit,Geschwindigkeit",
        "T [s],Se [g]",
        "T (s),Sae (g)",
        "Periodo (s),Accelerazione (g)",
    ] {
        let said = read_with(&format!("{header}\n{}", rows(2)), &ReadOptions::default());
        assert!(said.is_err(), "{header}: {said:?}");
    }
}

/// NPTS and DT before text lines, names of columns or other keys are no header of AT2.
#[test]
fn keys_of_at2_before_plain_columns() {
    for header in [
        "dt = 0.01; npts = 40; units = g",
        "dt=0.01 npts=40 units=g",
        "# dt=0.01 npts=40 units=g",
        "NPTS= 40 , DT= .0100 SEC, units g",
        "dt: 0.01 s | unit: g | npts: 40",
        "# dt: 0.01 s | unit: g | npts: 40",
        "NPTS= 40, DT= .01 SEC\n# data in g",
        "NPTS 40\nDT 0.01\nUnits g\nAcceleration",
        "UNITS OF G (PGA 0.3)\nNPTS= 40, DT= .01 SEC",
        "UNITS OF G (FREQUENCY 100 HZ)\nNPTS= 40, DT= .01 SEC",
        "dt 0.01 npts 40\nUnits: g",
        "npts,40\ndt,0.01\nunit,g",
        "Origin Time: 2020/01/01 12:00:00\nSampling rate: 100 Hz\nUnits: g",
    ] {
        is_read(header, 0.01, "g");
    }
    let rows: String = (0..40)
        .map(|i| {
            format!(
                "{:.2} {:.4}\n",
                0.01 * f64::from(i),
                0.3 * (0.5 * f64::from(i)).sin()
            )
        })
        .collect();
    let text = format!("NPTS: 40\nDT: 0.01\nTime (s) Acc (g)\n{rows}");
    let series = read_with(&text, &ReadOptions::default()).unwrap();
    assert_eq!((series[0].unit, series[0].samples.len()), ("g", 40));
    let short = text.replace("NPTS: 40", "NPTS: 41");
    let said = read_with(&short, &ReadOptions::default())
        .unwrap_err()
        .to_string();
    assert!(said.contains("41"), "{said}");
}

/// Behind a key stands its own number: others on the line are of filters and recorders.
#[test]
fn one_of_several_numbers() {
    for (line, step) in [
        ("Sampling rate: 200 - anti-alias filter 80 Hz", None),
        ("Sampling rate: 200 Hz, resampled to 200 Hz", Some(0.005)),
        ("Sampling rate: 200; 50 Hz notch", Some(0.005)),
        ("Sampling rate: 200, filter 0.1 to 30 Hz", Some(0.005)),
        ("Sampling rate (Hz): 200, 50 Hz notch filter", Some(0.005)),
        (
            "Sampling rate: 200 Hz (decimated from 1000 Hz)",
            Some(0.005),
        ),
        ("Sampling rate: 200 samples per second", Some(0.005)),
        ("Sampling rate 200, cutoff 80 Hz", None),
        ("Sampling rate 200 Hz, cutoff 80 Hz", Some(0.005)),
        ("Sampling rate: 31,25 Hz", Some(0.032)),
        ("Sampling rate: 62,5 Hz", Some(0.016)),
        ("Sampling rate: 1.0E+02 Hz", Some(0.01)),
        ("Sampling rate: 200 1/s", Some(0.005)),
        // A thousand, or one.
        ("Sampling rate: 1,000 Hz", None),
        ("Sampling rate: 0.1 kHz", Some(0.01)),
        ("dt [ms]: 5", Some(0.005)),
        ("Time step: 2,5 ms", Some(0.0025)),
        ("Original sampling rate: 200 Hz", None),
        ("Frequency: 50 Hz notch", None),
        ("Filter: Butterworth, order 4, frequency = 40 Hz", None),
        ("Sampling filter corner 80 Hz", None),
        ("Filter sampling rate: 50 Hz", None),
        ("Low-pass sampling rate: 50 Hz", None),
        ("Bandpass sampling 0.1-25 Hz", None),
        ("Band-pass filter, sampling rate: 200 Hz", Some(0.005)),
        ("Bandpass 0.1-25 Hz, sampling 200 Hz", Some(0.005)),
        ("Bandpass filtered, sampling rate 200 Hz", Some(0.005)),
        ("Low pass 40 Hz, sampling anti-alias 80 Hz", None),
        ("Filtered 0.1-25 Hz, 200 Hz sampling", Some(0.005)),
        ("Filtered and resampled at 200 Hz", Some(0.005)),
        ("Unfiltered, 200 samples/sec", Some(0.005)),
        ("Anti-alias filter of sampling: 50 Hz", None),
        ("Low-pass corner before resampling: 80 Hz", None),
        ("Filtered before sampling at 200 Hz", Some(0.005)),
        ("Frequency of instrument 50 Hz, sampled digitally", None),
        ("Frequency of instrument 200 Hz", None),
        ("Filter 0.1-25 Hz", None),
        ("Low-pass corner: 50 Hz", None),
        ("Frecuencia de corte: 25 Hz", None),
        ("Natural frequency 200 Hz", None),
    ] {
        let header = format!("{line}\nUnits: g");
        match step {
            Some(step) => drop(is_read(&header, step, "g")),
            None => refused(&header, "does not state its time step"),
        }
    }
    // What else is stated goes before a frequency, which may be that of a filter.
    for line in [
        "Frequency: 25 Hz",
        "Original dt: 0.02 s",
        "Type: Velocity pulse",
    ] {
        assert!(
            is_read(&format!("{line}\ndt: 0.01 s\nunits: g"), 0.01, "g").is_empty(),
            "{line}"
        );
    }
    let given = ReadOptions {
        time_step: Some(0.01),
        ..ReadOptions::default()
    };
    let text = "Frequency: 25 Hz\nunits: g\n0.1\n0.2\n-0.3\n";
    assert_eq!(
        read_with(text, &given).unwrap()[0].sampling.median_step(),
        0.01
    );
    assert!(is_read("Duration (D5-95): 0.2 s\ndt: 0.01\nunits: g", 0.01, "g").is_empty());
}

/// Keys in comments are those of plain columns, whatever names they have.
#[test]
fn keys_in_comments() {
    for header in [
        "# npts = 40\n# dt = 0.01\n# unit = g",
        "% dt: 0.01\n% npts: 40\n% units: g",
        "# NPTS=40, DT=0.01\n# Units: g",
        "# NPTS: 40, DT: 0.01 s, unit: g\n# acc",
        "// Units: g\n// NPTS: 40\n// DT: 0.01\n// values",
    ] {
        is_read(header, 0.01, "g");
    }
    let table =
        "# NPTS: 4\n# DT: 0.01\n# Time (s) Acc (g)\n0.00 0.1\n0.01 0.2\n0.02 -0.3\n0.03 0.1\n";
    let series = read_with(table, &ReadOptions::default()).unwrap();
    assert_eq!((series[0].samples.len(), series[0].unit), (4, "g"));
}

#[test]
fn counts() {
    let of = |count: &str| format!("{count}\ndt: 0.01\nunits: g");
    for count in [
        "count: 41",
        "Samples 41",
        "sample-count: 41",
        "No. of points 41",
    ] {
        refused(&of(count), "41");
    }
    is_read(&of("count: 40"), 0.01, "g");
    for (count, right) in [
        ("Numero de muestras: 41", "Numero de muestras: 40"),
        ("NUMERO DE DATOS : 41", "NUMERO DE DATOS : 40"),
        ("N\u{fa}mero de puntos = 41", "N\u{fa}mero de puntos = 40"),
        ("No. de puntos: 41", "No. de puntos: 40"),
        ("Total de muestras: 41", "Total de muestras: 40"),
        ("Cantidad de datos: 41", "Cantidad de datos: 40"),
        ("N\u{fa}mero de amostras: 41", "N\u{fa}mero de amostras: 40"),
        ("Numero di campioni: 41", "Numero di campioni: 40"),
        ("numero dati: 41", "numero dati: 40"),
        ("Nombre de points: 41", "Nombre de points: 40"),
        (
            "Nombre d'\u{e9}chantillons : 41",
            "Nombre d'\u{e9}chantillons : 40",
        ),
        ("Anzahl der Werte: 41", "Anzahl der Werte: 40"),
        ("Anzahl Messwerte: 41", "Anzahl Messwerte: 40"),
        ("Veri say\u{131}s\u{131}: 41", "Veri say\u{131}s\u{131}: 40"),
        ("Toplam veri sayisi = 41", "Toplam veri sayisi = 40"),
        ("Nro. de puntos: 41", "Nro. de puntos: 40"),
        ("N\u{ba} de datos: 41", "N\u{ba} de datos: 40"),
        ("N.\u{ba} de amostras: 41", "N.\u{ba} de amostras: 40"),
        (
            "N\u{fa}mero de muestras del registro: 41",
            "N\u{fa}mero de muestras del registro: 40",
        ),
        ("Numero de muestras (N): 41", "Numero de muestras (N): 40"),
        ("Numero de valores: 41", "Numero de valores: 40"),
        ("N. campioni: 41", "N. campioni: 40"),
        ("Numero di valori: 41", "Numero di valori: 40"),
        ("Nb de points: 41", "Nb de points: 40"),
        ("Nombre de valeurs: 41", "Nombre de valeurs: 40"),
        (
            "Anzahl der St\u{fc}tzstellen: 41",
            "Anzahl der St\u{fc}tzstellen: 40",
        ),
        ("Datenanzahl: 41", "Datenanzahl: 40"),
        ("Total datos: 41", "Total datos: 40"),
        ("Numero dei dati: 41", "Numero dei dati: 40"),
        (
            "\u{d6}rnekleme say\u{131}s\u{131}: 41",
            "\u{d6}rnekleme say\u{131}s\u{131}: 40",
        ),
        ("Werteanzahl: 41", "Werteanzahl: 40"),
        (
            "Nombre d'\u{e9}chantillons 41",
            "Nombre d'\u{e9}chantillons 40",
        ),
        ("N\u{b0} de puntos 41", "N\u{b0} de puntos 40"),
    ] {
        refused(&of(count), "41 samples, the series ends after 40");
        is_read(&of(right), 0.01, "g");
    }
    for other in [
        "Numero de datos por linea: 8",
        "Numero de registro: 35",
        "Anzahl Kan\u{e4}le: 3",
        "Datos: 7",
        "Valori: 7",
        "N. registro: 7",
        "Nro. de registro: 35",
    ] {
        is_read(&of(other), 0.01, "g");
    }
    // Neither is a count of values.
    is_read(&of("channel count: 3"), 0.01, "g");
    is_read(&of("Record 12"), 0.01, "g");
}

#[test]
fn peaks() {
    let of = |peak: &str| format!("{peak}\ndt: 0.01\nunits: g");
    for peak in [
        "PGA: 0.300 g",
        "PGA = 294.2 gal",
        "peak acceleration (m/s2): 2.942",
        "PGA 0.3 g",
    ] {
        assert!(is_read(&of(peak), 0.01, "g").is_empty(), "{peak}");
    }
    refused(&of("PGA: 300 g"), "the header's peak is 300.00 g");
    for peak in [
        "Aceleracion maxima",
        "Aceleraci\u{f3}n m\u{e1}xima",
        "Acelera\u{e7}\u{e3}o m\u{e1}xima",
        "Accelerazione massima",
        "Acc\u{e9}l\u{e9}ration maximale",
        "Maximale Beschleunigung",
        "Maximalwert",
        "En b\u{fc}y\u{fc}k ivme",
        "Acel. m\u{e1}x.",
        "M\u{e1}x. aceleraci\u{f3}n",
        "Aceleraci\u{f3}n m\u{e1}xima absoluta",
        "Pico de acelera\u{e7}\u{e3}o",
        "Massima accelerazione",
        "Acc\u{e9}l\u{e9}ration maximum",
        "Max. Beschleunigung",
        "Gr\u{f6}\u{df}te Beschleunigung",
        "Maks. ivme",
        "Maximum acceleration",
        "Max. acceleration",
        "Maximum value",
        "Acc. massima",
    ] {
        refused(&of(&format!("{peak}: 999 gal")), "the header's peak is");
        refused(&of(&format!("{peak} (m/s2): 9.99")), "the header's peak is");
        assert!(
            is_read(&of(&format!("{peak}: 294.2 gal")), 0.01, "g").is_empty(),
            "{peak}"
        );
    }
    refused(&of("Kobe, PGA: 0.8 g"), "the header's peak is 0.80000 g");
    // One of several columns.
    let table = "PGA: 0.3 g\ntime (s),NS (g),EW (g)\n0,0.1,0.0\n1,0.3,0.1\n2,0.0,-0.2\n3,0.1,0.1\n";
    let series = read_with(table, &ReadOptions::default()).unwrap();
    assert_eq!(series.len(), 2);
    // Without a unit of its own it says nothing.
    is_read(&of("PGA: 2.94"), 0.01, "g");
}

/// What lines state above rows that begin with text is known, and no row, however many characters of them are passed over.
#[test]
fn keys_above_rows_behind_text() {
    for columns in [4, 8, 10, 12, 14, 15] {
        let prefix = "ACC ".to_owned() + &" ".repeat(columns - 4);
        let rows: String = table("", 1, " ")
            .trim_start()
            .lines()
            .map(|row| format!("{prefix}{}\n", row.split_whitespace().last().unwrap()))
            .collect();
        let text = format!("Time step (s): 0.01\nunits: gal\nNPTS 40\n{rows}");
        let options = ReadOptions {
            skip_columns: columns,
            ..ReadOptions::default()
        };
        let series = read_with(&text, &options).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert_eq!((series.len(), series[0].samples.len()), (1, 40), "{text}");
        assert_eq!(series[0].unit, "cm/s2");
        assert_eq!(series[0].sampling.median_step(), 0.01);
    }
}

#[test]
fn durations_and_factors_are_told() {
    let of = |line: &str| is_read(&format!("{line}\ndt: 0.01\nunits: g"), 0.01, "g");
    assert!(of("Duration: 0.4 s").is_empty());
    assert!(of("Duration = 12 s")[0].contains("says a duration of 12 s"));
    assert!(of("Scale factor: 1.0").is_empty());
    assert!(of("Scale factor: 9.81")[0].contains("a factor of 9.81 is stated"));
}

#[test]
fn other_quantities() {
    for line in [
        "Type: VEL",
        "data type = velocity",
        "Quantity: displacement",
    ] {
        let header = format!("{line}\ndt: 0.01\nunits: g");
        let said = read(&header).unwrap_err().to_string();
        assert!(
            said.contains("velocity") || said.contains("displacement"),
            "{said}"
        );
    }
    is_read("Type: ACC\ndt: 0.01\nunits: g", 0.01, "g");
}

/// The unit in the name of a column that is not understood against one of its own line.
#[test]
fn units_of_names_and_lines() {
    let rows = "0,0.1,5\n1,0.3,6\n2,0.0,7\n3,0.1,9\n";
    let header = "units: g\nTime (s),Acc. (cm/s2) filtered,Quality of it\n";
    let said = read_with(&format!("{header}{rows}"), &ReadOptions::default());
    let said = said.unwrap_err().to_string();
    assert!(said.contains("contradicts the column header"), "{said}");
    let options = ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        ..ReadOptions::default()
    };
    let (_, header) = header.split_once('\n').unwrap();
    assert!(read_with(&format!("{header}{rows}"), &options).is_err());
}

/// What may stand beside count and step of an AT2 file.
#[test]
fn keys_of_at2() {
    let read = |title: &str, counts: &str| {
        let text = format!(
            "PEER\nEVENT, STATION, 180\n{title}\nNPTS= 8, DT= .0050 SEC{counts}\n.1 .2 -.3 .1\n.1 .2 .1 .0\n"
        );
        read_with(&text, &ReadOptions::default())
    };
    let plain = "ACCELERATION TIME SERIES IN UNITS OF G";
    let warnings = |counts: &str| read(plain, counts).unwrap()[0].origin.warnings.clone();
    for counts in [
        "",
        ", SAMPLING RATE= 200 HZ",
        " DURATION= .04 SEC",
        ", SCALE FACTOR= 1.0",
    ] {
        assert!(warnings(counts).is_empty(), "{counts}");
    }
    let rate = read(plain, ", SAMPLING RATE= 100 HZ")
        .unwrap_err()
        .to_string();
    assert!(
        rate.contains("0.005 s (200 samples/s) here, but 0.01 s"),
        "{rate}"
    );
    assert!(warnings(" DURATION= 40.0 SEC")[0].contains("a duration of 40 s"));
    assert!(warnings(", SCALE FACTOR= 9.81")[0].contains("a factor of 9.81"));
    let series = read("ACCELERATION TIME SERIES", ", UNITS=GAL").unwrap();
    assert_eq!(series[0].unit, "cm/s2");
}

/// Rows of times and of so many values, the first of which is as of `read`.
fn table(header: &str, columns: usize, separator: &str) -> String {
    let rows: String = (0..40)
        .map(|i| {
            let t = 0.01 * f64::from(i);
            let more: String = (0..columns)
                .map(|k| format!("{separator}{:.4}", 0.3 * (52.36 * t + 0.5 * k as f64).sin()))
                .collect();
            format!("{t:.2}{more}\n")
        })
        .collect();
    format!("{header}\n{rows}")
}

/// Samples that were left out: the step is that of the header alone, or borne out by times or the user.
#[test]
fn decimations() {
    let told = "a decimation by 2 is stated";
    for line in [
        "Decimation factor: 2",
        "Decimated by 2",
        "decimation = 2",
        "Decimated by a factor of 2 from 200 Hz",
    ] {
        let header = format!("# {line}\n# dt = 0.01 s\n# Units: g");
        let warnings = is_read(&header, 0.01, "g");
        assert!(
            warnings.iter().any(|w| w.contains(told)),
            "{line}: {warnings:?}"
        );
        let text = table(&format!("# {line}\nt (s),a (g)"), 1, ",");
        let series = read_with(&text, &ReadOptions::default()).unwrap();
        assert!(series[0].origin.warnings.is_empty(), "{line}");
    }
    for line in [
        "Decimation factor: 1",
        "Decimation: none",
        "Decimated to 100 Hz",
    ] {
        let header = format!("# {line}\n# dt = 0.01 s\n# Units: g");
        assert!(is_read(&header, 0.01, "g").is_empty(), "{line}");
    }
    // On its line the step may be that before it.
    let header = "# dt = 0.005 s, decimated by 2\n# Units: g";
    refused(header, "does not state its time step");
}

/// A motion has both signs, a spectrum has one.
#[test]
fn titles_of_spectra() {
    let rows: String = (1..60)
        .map(|i| {
            format!(
                "{:.2} {:.4}\n",
                0.02 * f64::from(i),
                (0.2 * f64::from(i)).sin().abs()
            )
        })
        .collect();
    for title in [
        "Elastic response spectrum",
        "# Design spectrum EC8",
        "Fourier spectrum",
        "Espectro de respuesta el\u{e1}stico",
        "Elastic response spectrum, 5% damping",
    ] {
        let text = format!("{title}\nT(s) a(g)\n{rows}");
        let error = read_with(&text, &ReadOptions::default()).unwrap_err();
        let said = error.to_string();
        assert!(
            said.starts_with("file.txt:1:1: ") && said.contains("speaks of a spectrum"),
            "{said}"
        );
        assert!(error.help().unwrap().contains("skip_lines"), "{title}");
        let options = ReadOptions {
            skip_lines: 1,
            ..ReadOptions::default()
        };
        assert!(read_with(&text, &options).is_ok(), "{title}");
    }
    // Records that speak of one.
    for title in [
        "Record matched to the response spectrum of EC8",
        "Spectrum-compatible record",
        "Target spectrum: EC8, type 1",
        "Elastic response spectrum",
    ] {
        let text = table(&format!("{title}\nt (s) a (g)"), 1, " ");
        assert!(read_with(&text, &ReadOptions::default()).is_ok(), "{title}");
    }
    for title in [
        "# Matched to a design spectrum",
        "# Step: fitted to spectrum.csv",
    ] {
        let text = format!("{title}\nT(s) a(g)\n{rows}");
        assert!(read_with(&text, &ReadOptions::default()).is_ok(), "{title}");
    }
}

/// Counts of all numbers of rows with times, velocities and displacements.
#[test]
fn counts_of_all_numbers() {
    for header in [
        "NPTS: 160\nt (s),a (g),v (cm/s),d (cm)",
        "NPTS= 160, DT= .01\nt (s),a (g),v (cm/s),d (cm)",
        "# NPTS: 160\n# units: g\nt,a,v,d",
    ] {
        let series = read_with(&table(header, 3, ","), &ReadOptions::default()).unwrap();
        assert_eq!((series.len(), series[0].samples.len()), (1, 40), "{header}");
        let warnings = &series[0].origin.warnings;
        let told = "line 1: the header says 160 samples, which are all numbers of the rows";
        assert!(warnings.iter().any(|w| w.starts_with(told)), "{warnings:?}");
    }
    let header = "NPTS: 120\nt (s),a (g),v (cm/s),d (cm)";
    let said = read_with(&table(header, 3, ","), &ReadOptions::default());
    assert!(said.unwrap_err().to_string().contains("120 samples"));
}

/// A number of units is read where it is a known one.
#[test]
fn multiples_of_units() {
    let in_names = [
        ("0.001 g", "mg"),
        ("x 0.001 g", "mg"),
        ("\u{d7} 0.001 g", "mg"),
        ("0.001*g", "mg"),
        ("1/1000 g", "mg"),
        ("10^-3 g", "mg"),
        ("10\u{207b}\u{b3} g", "mg"),
        ("10-3 g", "mg"),
        ("10**-3 g", "mg"),
        ("1e-3 g", "mg"),
        ("x 10^-2 g", "%g"),
        ("1/10 g", "g/10"),
        ("0.01 m/s2", "cm/s2"),
        ("0.001 m/s\u{b2}", "mm/s2"),
        ("milli-g", "mg"),
        ("percent g", "%g"),
        ("micro-g", "micro-g"),
    ];
    for (words, unit) in in_names {
        is_read(&format!("# dt = 0.01 s\n# Units: {words}"), 0.01, unit);
        is_read(&format!("dt = 0.01 s\nAcceleration in {words}"), 0.01, unit);
        let names = format!("Time (s);Acc ({words})");
        let series = read_with(&table(&names, 1, ";"), &ReadOptions::default());
        let series = series.unwrap_or_else(|e| panic!("{names}: {e}"));
        assert_eq!(series[0].unit, unit, "{names}");
        let peak = series[0]
            .samples
            .iter()
            .fold(0.0_f64, |m, a| m.max(a.abs()));
        assert!(
            (peak / series[0].unit_in_si - 0.3).abs() < 1e-3,
            "{names}: {peak}"
        );
    }
    // Under a key it is no strength of a motion.
    for (words, unit) in [
        ("0.1 g", "g/10"),
        ("0.01g", "%g"),
        ("1.0 g", "g"),
        ("9.81 m/s2", "g"),
    ] {
        is_read(&format!("# dt = 0.01 s\n# Units: {words}"), 0.01, unit);
        let names = format!("Time (s);Acc ({words})");
        let said = read_with(&table(&names, 1, ";"), &ReadOptions::default()).unwrap_err();
        assert!(said.to_string().contains("is not known"), "{names}: {said}");
        refused(
            &format!("dt = 0.01 s\nAcceleration in {words}"),
            "does not state the unit",
        );
    }
    for words in [
        "1000 g",
        "g x 0.001",
        "g*0.001",
        "g * 10^-3",
        "cm/s2 x 10",
        "10 cm/s2",
        "g/981",
    ] {
        let key = format!("# dt = 0.01 s\n# Units: {words}");
        refused(&key, "that is stated here is none of acceleration");
        // `10 cm/s2` may be the strength of the motion.
        let bare = words.starts_with(|c: char| c.is_ascii_digit());
        let told = match bare {
            true => "does not state the unit",
            false => "is not known",
        };
        refused(&format!("dt = 0.01 s\nAcceleration ({words})"), told);
    }
}

#[test]
fn keys_without_blanks() {
    for (header, step, unit) in [
        ("N,40\ndt,0.01\nunits,g", 0.01, "g"),
        ("N 40\ndt 0.01\nunits g", 0.01, "g"),
        ("NPTS,40\nDT,0.01\nUNITS,G", 0.01, "g"),
        ("dt=0.01\n(UNITS: G)", 0.01, "g"),
        ("dt=0.01\n[UNITS=cm/s2]", 0.01, "cm/s2"),
        ("[dt=0.01]\n[units=g]", 0.01, "g"),
        ("{dt=0.01;units=g}", 0.01, "g"),
        ("DELTA=0.01\nNPTS=40\nunits=g", 0.01, "g"),
        ("DELTA=5.0e-03, NPTS=40, units=g", 0.005, "g"),
        ("DELTA=0.05\nNPTS=40\ndt=0.01\nunits=g", 0.01, "g"),
    ] {
        assert!(is_read(header, step, unit).is_empty(), "{header}");
    }
    let of_another = "N=41\ndt=0.01\nunits=g";
    let warnings = is_read(of_another, 0.01, "g");
    assert!(
        warnings[0].starts_with("line 1: N is 41 here"),
        "{warnings:?}"
    );
    // Storeys.
    assert!(is_read("n=5\ndt=0.01\nunits=g", 0.01, "g").is_empty());
    for header in ["DELTA=0.01\nunits=g", "delta: 0.35\nNPTS=40\nunits=g"] {
        refused(header, "under \"delta\" has no unit, and may be a distance");
    }
}

/// Factors above columns with times are told, as those above one series are.
#[test]
fn factors_above_columns() {
    for line in [
        "Values multiplied by 1000",
        "Scale factor: 0.5",
        "# record scaled by 0.5",
        "# El Centro, scale factor 0.5",
    ] {
        let text = table(&format!("{line}\nt (s),a (g)"), 1, ",");
        let series = read_with(&text, &ReadOptions::default()).unwrap();
        let warnings = &series[0].origin.warnings;
        assert!(
            warnings
                .iter()
                .any(|w| w.starts_with("line 1: a factor of")),
            "{line}: {warnings:?}"
        );
    }
}

/// Columns of something else below count and step.
#[test]
fn columns_of_something_else() {
    let rows = |columns: usize| -> String {
        let row = |i: usize| {
            let values = (0..columns).map(|k| format!("{:.4} ", (0.7 * (i + 3 * k) as f64).sin()));
            values.collect::<String>() + "\n"
        };
        (0..40).map(row).collect()
    };
    for (names, columns) in [
        ("Displacement Force", 2),
        ("Load Deflection", 2),
        ("Displacement (mm) Force (kN)", 2),
        ("Shear Moment Drift Rotation", 4),
        ("Step Force Displacement Drift", 4),
        ("Force", 1),
        ("Force (kN)", 1),
    ] {
        for counts in [
            format!("NPTS= {}, DT= .01 SEC, UNITS G", 40 * columns),
            "# npts: 40\n# dt: 0.01\n# units: g".to_owned(),
        ] {
            for layout in [None, Some("a".to_owned())] {
                let options = ReadOptions {
                    layout,
                    ..ReadOptions::default()
                };
                let text = format!("{counts}\n{names}\n{}", rows(columns));
                let said = read_with(&text, &options).unwrap_err().to_string();
                assert!(said.contains("names no acceleration"), "{text}: {said}");
            }
        }
    }
    let text = format!("# dt: 0.01\n# units: g\nVelocity Displacement\n{}", rows(2));
    let said = read_with(&text, &ReadOptions::default())
        .unwrap_err()
        .to_string();
    assert!(said.contains("\"Velocity\" is a velocity"), "{said}");
    // Titles, and names of sensors.
    for title in [
        "Kobe (1995) Takatori (0)",
        "Storey shear of the record",
        "Distance 12 km",
    ] {
        let text = format!("# dt: 0.01\n# units: g\n# {title}\n{}", rows(1));
        assert!(read_with(&text, &ReadOptions::default()).is_ok(), "{title}");
    }
}

/// A Fortran format in brackets is no unit, and hides none.
#[test]
fn formats_are_no_units() {
    for header in [
        "Acceleration (cm/s2) (8F9.6)\ndt: 0.01",
        "Acceleration in gal (5E14.7)\ndt: 0.01",
        "Acceleration data, format (1P5E14.6), in cm/s2\ndt: 0.01",
        "(8F9.6)\ndt: 0.01\nunits: gal",
        "Acceleration [8F9.6] (cm/s2)\ndt: 0.01",
        "Acceleration (8(F9.6)) (cm/s2)\ndt: 0.01",
        "Acceleration (format: 5E14.7), cm/s2\ndt: 0.01",
    ] {
        is_read(header, 0.01, "cm/s2");
    }
    refused("Acceleration (8F9.6)\ndt: 0.01", "does not state the unit");
}

/// A value of something else hides neither what is stated nor what is missing.
#[test]
fn values_of_something_else_are_no_columns() {
    for line in [
        "Altitude (m) : 130",
        "Depth (km): 12",
        "Distance (km)=35",
        "Vs30 (m/s) = 350",
        "Altitude (m),130",
        "Depth (km);12",
    ] {
        let header = format!("Acceleration (cm/s2)\n{line}");
        refused(&header, "does not state its time step");
        is_read(&format!("{header}\ndt: 0.01"), 0.01, "cm/s2");
    }
}

/// Names of several words between blanks end where their unit does.
#[test]
fn names_of_several_words_between_blanks() {
    for (header, names) in [
        (
            "Time (s)  Roof acc (g)  Base acc (g)",
            ["Roof acc", "Base acc"],
        ),
        ("Time (s) Acc X (g) Acc Y (g)", ["Acc X", "Acc Y"]),
        (
            "# Time [s] Free field acc [g] Base acc [g]",
            ["Free field acc", "Base acc"],
        ),
        (
            "time (s)\tRoof acc (g)\tBase acc (g)",
            ["Roof acc", "Base acc"],
        ),
        ("Time  Roof acc (g)  Base acc (g)", ["Roof acc", "Base acc"]),
        ("Time Acc X (g) Acc Y (g)", ["Acc X", "Acc Y"]),
        ("Time    Acc X (g)    Acc Y (g)", ["Acc X", "Acc Y"]),
        (
            "Time, s   Roof acc, g   Base acc, g",
            ["Roof acc", "Base acc"],
        ),
        (
            "Time   Roof acc   Base acc\n(s)   (g)   (g)",
            ["Roof acc", "Base acc"],
        ),
        (
            "# Time (F8.3)   Roof acc   Base acc\n# (s)   (g)   (g)",
            ["Roof acc", "Base acc"],
        ),
    ] {
        let series = read_with(&table(header, 2, " "), &ReadOptions::default());
        let series = series.unwrap_or_else(|e| panic!("{header}: {e}"));
        let found: Vec<&str> = series.iter().map(|s| s.component.as_str()).collect();
        assert_eq!(found, names, "{header}");
        assert!(
            series
                .iter()
                .all(|s| s.unit == "g" && s.samples.len() == 40)
        );
    }
    let chosen = ReadOptions {
        component: Some("Base acc".to_owned()),
        ..ReadOptions::default()
    };
    let text = table("Time (s)  Roof acc (g)  Base acc (g)", 2, " ");
    let record = pounding_ground_motion::read_bytes("f", text.as_bytes(), &chosen).unwrap();
    // The second column of the table begins with 0.3 sin 0.5.
    assert!((record.samples()[0] - 0.1438 * 9.80665).abs() < 1e-9);
}

/// Ordinates of spectra in one component or at a damping are none of a motion.
#[test]
fn ordinates_of_one_component() {
    for (header, columns, separator) in [
        ("PSA_5pct_g", 0, ","),
        ("Sa_NS_g Sa_EW_g", 1, " "),
        ("T (s),Sa_X_g", 1, ","),
        ("T,Sd_NS_ft", 1, ","),
        ("time,PSA_5%_g", 1, ","),
        ("Sa_X_ft_s2 Sd_X_ft", 1, " "),
    ] {
        let text = table(header, columns, separator);
        let given = ReadOptions {
            unit: Some(AccelerationUnit::StandardGravity),
            time_step: Some(0.01),
            ..ReadOptions::default()
        };
        let said = read_with(&text, &given).unwrap_err().to_string();
        assert!(said.contains("that of a spectrum"), "{header}: {said}");
    }
}
