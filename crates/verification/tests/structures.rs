//! Structures that others published: every number of `pounding verify structures`, against what its
//! source prints or what follows in closed form, written down here a second time.
use std::path::{Path, PathBuf};

use pounding_verification::{Entered, Line, Part, Structures, Value, Verdict, holds};

fn part(source: Structures) -> Part {
    let part = source.compare(&Entered::template().unwrap()).unwrap();
    assert!(holds(std::slice::from_ref(&part)), "{part:#?}");
    part
}

fn number(line: &Line, column: usize) -> f64 {
    match line.cells[column].value {
        Value::Number(value) => value,
        ref other => panic!("{other:?} in {:?}", line.cells),
    }
}

/// The line of a comparison that begins with these words.
fn line<'a>(part: &'a Part, comparison: usize, words: &str) -> &'a Line {
    let lines = part.comparisons[comparison].lines.iter();
    let mut of = lines.filter(|line| line.cells[0].shown == words);
    of.next().unwrap_or_else(|| panic!("no line {words}"))
}

/// Asserts ours, in the fourth column of a quantity, to a relative difference.
fn ours(part: &Part, comparison: usize, words: &str, expected: f64, tolerance: f64) {
    let found = number(line(part, comparison, words), 3);
    assert!(
        (found / expected - 1.0).abs() <= tolerance,
        "{words}: {found}, not {expected}"
    );
}

fn verdicts(part: &Part, verdict: Verdict) -> usize {
    let lines = part.comparisons.iter().flat_map(|c| &c.lines);
    lines.filter(|line| line.verdict == verdict).count()
}

/// Documentation of Code_Aster (V5.01.101, 102, 108, 122) as quoted in the case list; where it is
/// off, the closed form.
#[test]
fn code_aster() {
    let part = part(Structures::CodeAster);
    // Printed.
    ours(&part, 0, "peak force (N)", 9950.0, 3.0e-5);
    ours(&part, 0, "contact time (s)", 0.03126, 1.0e-5);
    ours(&part, 0, "time of the peak force (s)", 0.01563, 1.0e-5);
    ours(&part, 0, "time of the next peak force (s)", 0.361, 2.0e-4);
    ours(&part, 2, "opens (s)", 0.885_456_153_076_43, 1.0e-12);
    ours(
        &part,
        2,
        "position at 1.1 s (m)",
        -0.856_394_405_035,
        1.0e-12,
    );
    ours(&part, 3, "opens (s)", 0.924_038_825_42, 1.0e-9);
    ours(&part, 3, "position at 1.1 s (m)", -1.814_964_224_97, 2.0e-9);
    // Theirs is off: 2 m v K / (k + K), less the spring's k (g + mean penetration) T.
    ours(&part, 0, "impulse (N s)", 198.016_706, 1.0e-8);
    ours(
        &part,
        4,
        "frequency as computed (Hz)",
        0.646_631_040_6,
        1.0e-9,
    );
    assert_eq!(verdicts(&part, Verdict::TheirError), 4);
    assert_eq!(verdicts(&part, Verdict::AtTheirStep), 5);
    assert_eq!(verdicts(&part, Verdict::Reproduced), 4 + 3 + 3);
    // What their scheme gives at their step has their seven digits; ours does not.
    let printed = [
        -1.565203e-4,
        -5.148320e-4,
        2.812914e-4,
        -4.493425e-4,
        -3.757078e-4,
    ];
    for (line, printed) in part.comparisons[1].lines.iter().zip(printed) {
        assert!((number(line, 2) - printed).abs() <= 0.51e-10);
        assert!((number(line, 4) - printed).abs() > 2.0e-5);
        assert!((number(line, 4) - number(line, 3)).abs() < 1.0e-8);
    }
}

/// Closed forms of a bouncing ball and of a column that bounces as one.
#[test]
fn siconos() {
    let part = part(Structures::Siconos);
    let fall = (2.0_f64 / 9.81).sqrt();
    let time = |n: i32| fall * (1.0 + 2.0 * (1..n).map(|k| 0.9_f64.powi(k)).sum::<f64>());
    for n in [1, 2, 10, 20, 44] {
        ours(
            &part,
            0,
            &format!("time of impact {n} (s)"),
            time(n),
            1.0e-13,
        );
    }
    assert_eq!(number(line(&part, 0, "impacts within 8.5 s"), 3), 44.0);
    // Two tops of the bounce later: 0.49 s less four times the fall of 0.05 m. The case's storeys of
    // 1e-12 N/m, as good as none, are part of the motion from rest, -g t^2 / 2 + g w^2 t^4 / 24, by
    // 4.1e-14 m here.
    let square = 1.0e-12 / 0.004_073_598_474_154_765;
    let fallen = |t: f64| 9.81 * t * t * (0.5 - square * t * t / 24.0);
    let rest = (2.0_f64 * 0.05 / 9.81).sqrt();
    let fall = rest - (fallen(rest) - 0.05) / (9.81 * rest);
    for bead in [1, 5, 10] {
        ours(
            &part,
            1,
            &format!("bead {bead} at 0.49 s (m)"),
            -fallen(0.49 - 4.0 * fall),
            2.0e-13,
        );
    }
    assert_eq!(verdicts(&part, Verdict::Reproduced), 6 + 12);
}

fn published(name: &str) -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/reference/published");
    Some(folder.join(name)).filter(|path| path.exists())
}

/// The figures of Siconos and Modelica that stand in this crate are those of their files, where
/// these are at hand.
#[test]
fn theirs_are_the_files_of_others() {
    if let Some(path) = published("siconos/BouncingBallED.ref") {
        let text = std::fs::read_to_string(path).unwrap();
        let rows: Vec<Vec<f64>> = text
            .lines()
            .skip(1)
            .map(|l| l.split_whitespace().map(|w| w.parse().unwrap()).collect())
            .collect();
        let repeated = rows
            .windows(2)
            .filter(|w| (w[1][0] - w[0][0]).abs() < 1.0e-13);
        let impacts: Vec<f64> = repeated.map(|w| w[1][0]).collect();
        assert_eq!(impacts.len(), 44);
        let part = part(Structures::Siconos);
        for n in [1, 2, 10, 20, 44] {
            let stands = number(line(&part, 0, &format!("time of impact {n} (s)")), 1);
            assert!((impacts[n - 1] - stands).abs() < 1.0e-14);
        }
    }
    if let Some(path) = published("modelica/ElastoGap.csv") {
        let text = std::fs::read_to_string(path).unwrap();
        // Events are written twice, before and after; the first is at zero.
        let times: Vec<f64> = text
            .lines()
            .skip(1)
            .map(|l| l.split(',').next().unwrap().parse().unwrap())
            .collect();
        let events: Vec<f64> = times
            .windows(2)
            .filter(|w| w[0] == w[1])
            .map(|w| w[0])
            .collect();
        let part = part(Structures::Modelica);
        for words in [
            "impact 1 opens (s)",
            "impact 2 closes (s)",
            "impact 2 opens (s)",
        ] {
            let stands = number(line(&part, 0, words), 1);
            assert!(
                events.iter().any(|t| (t - stands).abs() < 1.0e-8),
                "{words}"
            );
        }
    }
}

/// Reference result of Dymola for the example of the Modelica Standard Library.
#[test]
fn modelica() {
    let part = part(Structures::Modelica);
    for (words, theirs) in [
        ("impact 1 opens (s)", 1.896_204_494),
        ("leaves with (m/s), impact 1", 1.969_028),
        ("impact 2 closes (s)", 2.404_069_207),
        ("impact 2 opens (s)", 3.425_110_928),
        ("leaves with (m/s), impact 2", 1.131_288),
        ("impact 3 closes (s)", 4.309_058_991),
    ] {
        ours(&part, 0, words, theirs, 5.0e-6);
    }
    assert_eq!(verdicts(&part, Verdict::Reproduced), 6);
}

/// VM65 as printed: t = 0.071982 s, 27.785 in/s, 193 in lbf, 1.5506 in; closed form of the last.
#[test]
fn ansys() {
    let part = part(Structures::Ansys);
    ours(&part, 0, "closes (s)", 0.071_982, 1.0e-5);
    ours(&part, 0, "approach velocity (in/s)", 27.785, 1.0e-5);
    ours(&part, 0, "kinetic energy (in lbf)", 193.0, 1.0e-9);
    let (k, w) = (1973.92_f64, 193.0_f64);
    let lowest = 1.0 + (w + (w * w + 2.0 * k * w).sqrt()) / k;
    ours(
        &part,
        0,
        "lowest place below the start (in)",
        lowest,
        1.0e-9,
    );
    assert_eq!(verdicts(&part, Verdict::Reproduced), 4);
}

/// Chung and Ooi 2011: peaks of 10.704 and 11.357 kN read off their figures; Hertz in closed form.
#[test]
fn chung_ooi() {
    let part = part(Structures::ChungOoi);
    ours(&part, 0, "peak force (kN)", 10.704, 7.0e-4);
    ours(&part, 1, "peak force (kN)", 11.357, 8.0e-4);
    ours(&part, 0, "peak force (kN)", 10.696_882_1, 1.0e-6);
    assert_eq!(verdicts(&part, Verdict::Reproduced), 2);
}

/// OpenSees 3.7.1 with steps of 10 us. These are the differences that an independent comparison
/// found, a script that drove both programs from outside.
#[test]
fn opensees() {
    let part = part(Structures::OpenSees);
    assert_eq!(verdicts(&part, Verdict::Reproduced), 2 * 13);
    for (case, largest) in [
        ("single_storey_linear_elastic", 4.0e-8),
        ("single_storey_kelvin_voigt", 7.0e-5),
        ("single_storey_hertzdamp", 6.0e-7),
        ("single_storey_jankowski", 1.2e-5),
        ("single_storey_bilinear", 1.0e-4),
        ("three_storey_linear_elastic", 5.0e-7),
        ("three_storey_kelvin_voigt", 8.0e-5),
        ("three_storey_hertzdamp", 5.0e-6),
        ("three_storey_jankowski", 3.0e-5),
        ("three_storey_bilinear", 2.0e-4),
        ("yielding_hertzdamp", 6.0e-6),
        ("yielding_jankowski", 2.4e-5),
    ] {
        assert!(number(line(&part, 0, case), 8) <= largest, "{case}");
    }
    // From a step of 1 ms to one of 10 us the difference falls by ten at least.
    for line in &part.comparisons[1].lines {
        let (coarse, fine) = (
            number(line, 1).max(number(line, 2)),
            number(line, 5).max(number(line, 6)),
        );
        assert!(fine < 0.1 * coarse, "{:?}", line.cells[0].shown);
    }
    let failed = number(line(&part, 1, "three_storey_kelvin_voigt"), 7);
    assert_eq!(failed, 7905.0);
}

/// Materials of OpenSees along one path: round-off, but for its rule of first order in BoucWen.
#[test]
fn laws() {
    let part = part(Structures::Laws);
    for (law, largest) in [
        ("bilinear", 1.0e-12),
        ("menegotto_pinto_1973", 1.0e-14),
        ("bouc_wen", 4.0e-5),
        ("elastoplastic_gap", 1.0e-14),
        ("gap_hook", 1.0e-14),
    ] {
        let line = line(&part, 0, law);
        assert_eq!(number(line, 2), 45.0);
        assert!(number(line, 5) <= largest, "{law}");
    }
}

/// Nothing is said of what is not at hand.
#[test]
fn entries_without_data() {
    let part = part(Structures::Entered);
    let names: Vec<_> = part
        .comparisons
        .iter()
        .map(|c| c.title.split(':').next().unwrap())
        .collect();
    assert_eq!(names, ["jankowski_2008", "nees_2008_0571"]);
    assert_eq!(verdicts(&part, Verdict::NeedsData), 6);
    for line in part.comparisons.iter().flat_map(|c| &c.lines) {
        assert_eq!(line.cells[3].value, Value::Nothing);
    }
}
