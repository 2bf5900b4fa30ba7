//! `synth` and `match`.

use super::*;

const SEEDED: [&[&str]; 4] = [
    &[
        "kanai_tajimi_1960",
        "--peak-acceleration",
        "0.3 g",
        "--duration",
        "20 s",
    ],
    &[
        "clough_penzien_1975",
        "--peak-acceleration",
        "0.3 g",
        "--ground-frequency",
        "2 Hz",
        "--duration",
        "20 s",
    ],
    &[
        "rezaeian_der_kiureghian_2010",
        "--magnitude",
        "7",
        "--distance",
        "20 km",
        "--shear-velocity",
        "760 m/s",
        "--duration",
        "40 s",
    ],
    &[
        "boore_2003",
        "--magnitude",
        "6.5",
        "--distance",
        "20 km",
        "--duration",
        "40 s",
    ],
];

#[test]
fn a_seed_fixes_a_motion() {
    let folder = Folder::new();
    for generator in SEEDED {
        let names = ["a.csv", "b.csv", "c.csv"].map(|n| folder.name(n));
        for (name, seed) in names.iter().zip(["1", "1", "2"]) {
            let told = json(&[&["synth"], generator, &["--seed", seed, "-o", name]].concat());
            assert_eq!(told["steps"][0]["step"], generator[0]);
        }
        assert_eq!(
            folder.content("a.csv"),
            folder.content("b.csv"),
            "{generator:?}"
        );
        assert_ne!(
            folder.content("a.csv"),
            folder.content("c.csv"),
            "{generator:?}"
        );
        assert!(folder.content("a.csv").contains("seed 1"));
    }
}

/// Peaks of pulses as their formulas say.
#[test]
fn pulses() {
    let folder = Folder::new();
    let out = folder.name("p.csv");
    let peak = |arguments: &[&str]| {
        let told = json(&[&["synth"], arguments, &["-o", &out]].concat());
        number(&told["peak_acceleration"]["value"])
    };
    let grid = ["--duration", "10 s", "--time-step", "0.001 s"];
    let of = |arguments: &[&str]| peak(&[arguments, &grid].concat());
    let sine = [
        "sine",
        "--amplitude",
        "2 m/s^2",
        "--frequency",
        "1.25 Hz",
        "--length",
        "8 s",
    ];
    close(of(&sine), 2.0, 1e-6);
    close(
        of(&["ricker_1953", "--amplitude", "0.3 g", "--period", "0.8 s"]),
        0.3 * 9.80665,
        1e-6,
    );
    // Type B: a = w v cos(w t) starts at w v; the first sample is half of a jump.
    let pulse = [
        "makris_roussos_2000",
        "--type",
        "b",
        "--amplitude",
        "0.5 m/s",
        "--period",
        "2 s",
    ];
    close(of(&pulse), 0.5 * std::f64::consts::PI, 1e-5);
    // gamma = 2, nu = 0: the velocity is A at the middle of the pulse.
    let near = [
        "mavroeidis_papageorgiou_2003",
        "--amplitude",
        "0.8 m/s",
        "--frequency",
        "0.5 Hz",
        "--gamma",
        "2",
    ];
    of(&near);
    let told = json(&["info", &out]);
    let velocity = &told["files"][0]["series"][0]["measures"]["peak_velocity"];
    close(number(&velocity["value"]), 0.8, 1e-5);
    close(number(&velocity["time"]), 2.0, 1e-3);
}

/// EN 1998-1:2004, type 1, ground B.
fn eurocode(ag: f64, period: f64) -> f64 {
    let ground = 1.2 * ag;
    match period {
        t if t < 0.15 => ground * (1.0 + t / 0.15 * 1.5),
        t if t <= 0.5 => ground * 2.5,
        t if t <= 2.0 => ground * 2.5 * 0.5 / t,
        t => ground * 2.5 / (t * t),
    }
}

/// The written motion is within 5 % of the code's spectrum at every period that the
/// match is held against.
#[test]
fn a_match_holds_in_the_file() {
    let folder = Folder::new();
    let (out, svg) = (folder.name("m.csv"), folder.name("m.svg"));
    let file = el_centro();
    let told = json(&[
        "match",
        &file,
        "--code",
        "eurocode_8_2004, ag=0.25 g, ground_type=B",
        "--from",
        "0.1 s",
        "--to",
        "3 s",
        "-o",
        &out,
        "--svg",
        &svg,
    ]);
    assert!(number(&told["misfit"]["worst"]) <= 0.05);
    let spectra = json(&[
        "spectrum", &out, "--from", "0.1 s", "--to", "3 s", "--count", "633",
    ]);
    let s = &spectra["spectra"][0];
    for i in 0..633 {
        let period = number(&s["periods"][i]);
        let expected = eurocode(0.25 * 9.80665, period);
        // 1e-4: the target is straight in logarithms between its points.
        close(number(&s["pseudo_acceleration"][i]), expected, 0.05 + 1e-4);
    }
    assert!(folder.content("m.svg").contains("target"));
    let header = folder.content("m.csv");
    assert!(header.contains("# Step: matching by wavelets: first period 0.1 s"));
}

/// A table gives the same target as its code.
#[test]
fn a_table_as_target() {
    let folder = Folder::new();
    let table: String = (0..=100)
        .map(|i| 0.05 * 80.0_f64.powf(f64::from(i) / 100.0))
        .map(|t| format!("{t},{}\n", eurocode(2.0, t)))
        .collect();
    std::fs::write(folder.path("t.csv"), format!("period_s,psa_m_s2\n{table}")).unwrap();
    let (target, out) = (folder.name("t.csv"), folder.name("m.csv"));
    let file = el_centro();
    let told = json(&[
        "match",
        &file,
        "--target",
        &target,
        "--method",
        "fourier_amplitudes",
        "--tolerance",
        "12 %",
        "--from",
        "0.2 s",
        "--to",
        "2 s",
        "-o",
        &out,
    ]);
    assert_eq!(told["method"], "matching by Fourier amplitudes");
    assert!(number(&told["misfit"]["worst"]) <= 0.12);
}
