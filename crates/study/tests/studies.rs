//! Studies as a library: sharing changes nothing, designs sample what they say, runs keep
//! their identity.
use std::path::{Path, PathBuf};

use pounding_assembly::assemble;
use pounding_case::Case;
use pounding_files::checksum::WithoutChecksum;
use pounding_ground_motion::processing::Scale;
use pounding_study::{
    Axis, Ending, IntensityMeasure, IsolatedRun, ResultReader, Row, Shard, Study, StudyError,
    SweepOptions, Value, case_of_run, sweep,
};
use pounding_time_history::{LinkLevelOutcome, isolated_demand, run};

pub(super) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .canonicalize()
        .unwrap()
}

/// A study of the three-storey pair for six seconds, in a folder of its own.
pub(super) fn study(folder: &Path, text: &str) -> Result<Study, StudyError> {
    let motions = root().join("ground_motions");
    let motions = motions.to_str().unwrap();
    let case =
        std::fs::read_to_string(root().join("examples/sweep_three_storey_pair/case.toml")).unwrap();
    let case = case
        .replace("../../ground_motions", motions)
        .replace("31 s", "6 s");
    std::fs::write(folder.join("case.toml"), case).unwrap();
    let text = format!("case = \"case.toml\"\n{}", text.replace("MOTIONS", motions));
    Study::parse(&text, &folder.join("study.toml"))
}

fn options(folder: &Path) -> SweepOptions {
    SweepOptions {
        output: folder.join("out.h5"),
        csv: None,
        threads: 2,
        shard: Shard::WHOLE,
        resume: false,
        store_every: std::time::Duration::from_secs(5),
        keep_going: false,
        shared: None,
    }
}

/// A shard that cannot be, as its numbers are public, is an error and leaves nothing behind.
#[test]
fn shards_that_cannot_be_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let gaps = "[[variable]]\npath = \"gap.0.width\"\nvalues = [\"15 mm\", \"20 mm\"]\n";
    let study = study(folder.path(), gaps).unwrap();
    for (index, count) in [(1, 0), (0, 0), (0, 2), (3, 2)] {
        let asked = SweepOptions {
            shard: Shard { index, count },
            ..options(folder.path())
        };
        let error = sweep(&study, &asked, &mut |_| std::ops::ControlFlow::Continue(()));
        let error = error.unwrap_err().to_string();
        assert!(error.contains("is no shard"), "{error}");
        assert!(!asked.output.exists());
    }
}

pub(super) fn rows(study: &Study, folder: &Path) -> Vec<(Row, Vec<Value>)> {
    let options = options(folder);
    let output = options.output.clone();
    sweep(
        study,
        &options,
        &mut |_| std::ops::ControlFlow::Continue(()),
    )
    .unwrap();
    let reader = ResultReader::open(&output, WithoutChecksum::Refuse).unwrap();
    reader.block(0..reader.rows).unwrap()
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|x| x.to_bits()).collect()
}

/// Runs that share buildings, records and exact steps give, to the last bit, what their
/// cases give alone, whatever varies: gaps, buildings, records, scales, methods.
#[test]
fn sharing_changes_no_bit() {
    let folder = tempfile::tempdir().unwrap();
    let study = study(
        folder.path(),
        r#"
[[variable]]
name = "gap"
path = "gap.light-heavy.width"
values = ["15 mm", 0.04]
[[variable]]
name = "stiffness"
path = "building.light.stiffness"
values = ["3 MN/m", "4 MN/m"]
[[variable]]
records = ["MOTIONS/el_centro_1940_ns.csv", { name = "kobe", file = "MOTIONS/kobe_1995_jma_ns.csv" }]
[[variable]]
name = "scale"
path = "ground_motion.scale"
values = [0.5, 1.25]
[[variable]]
name = "method"
path = "analysis.method"
values = ["event_driven", "adaptive"]
[[variable]]
path = "building.light.p_delta"
values = [false, true]
"#,
    )
    .unwrap();
    assert_eq!(study.runs(), 64);
    let rows = rows(&study, folder.path());
    assert_eq!(rows.len(), 64);
    let mut touched = 0;
    for (row, point) in &rows {
        assert_eq!(
            (&row.ending, point),
            (&Ending::Complete, &study.point(row.run))
        );
        let text = case_of_run(&study, row.run).unwrap();
        let case = Case::parse(&text, &folder.path().join("case.toml")).unwrap();
        let assembly = assemble(&case).unwrap();
        let alone = run(&assembly.system, &assembly.options, &mut [], &mut |_| {}).unwrap();
        let displacement = alone
            .buildings
            .iter()
            .flat_map(|b| &b.storeys)
            .map(|s| s.displacement.value);
        let force = alone
            .gaps
            .iter()
            .flat_map(|g| &g.levels)
            .map(|l| l.peak_force.value);
        let reader =
            ResultReader::open(&folder.path().join("out.h5"), WithoutChecksum::Refuse).unwrap();
        let layout = &reader.description.layout;
        assert_eq!(layout.width(Axis::Storey), 6);
        assert_eq!(
            row.values[layout.range("peak_displacement")],
            displacement.collect::<Vec<_>>()
        );
        assert_eq!(
            row.values[layout.range("peak_force")],
            force.collect::<Vec<_>>()
        );
        assert_eq!(
            row.values[layout.range("energy_input")],
            [alone.energy.end.input]
        );
        touched += usize::from(!alone.impacts.is_empty());
    }
    assert!((40..=64).contains(&touched), "{touched}");
    let mut ids: Vec<_> = rows.iter().map(|(r, _)| r.id).collect();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), 64, "every run has its own identity");
}

/// A run is the same run in any study: its identity depends on values and bytes only.
#[test]
fn identity_is_that_of_the_content() {
    let folder = tempfile::tempdir().unwrap();
    let ids = |text: &str| -> Vec<[u8; 16]> {
        let study = study(folder.path(), text).unwrap();
        let rows = rows(&study, folder.path());
        std::fs::remove_file(folder.path().join("out.h5")).unwrap();
        rows.iter().map(|(r, _)| r.id).collect()
    };
    let listed = ids("[[variable]]\npath = \"gap.0.width\"\nvalues = [\"20 mm\", \"40 mm\"]\n");
    let ranged = ids(
        "[[variable]]\nname = \"x\" # the gap\npath = \"gap[0].width\"\nfrom = 0.02\nto = 0.04\ncount = 2\n",
    );
    assert_eq!(listed, ranged);
    let copy = folder.path().join("another name.csv");
    std::fs::copy(root().join("ground_motions/el_centro_1940_ns.csv"), &copy).unwrap();
    let with = |record: &str| {
        ids(&format!(
            "[[variable]]\npath = \"gap.0.width\"\nvalues = [0.02, 0.04]\n[[variable]]\nrecords = [\"{record}\"]\n"
        ))
    };
    assert_eq!(with("another name.csv"), listed);
    // One sample more is another record.
    let longer = std::fs::read_to_string(&copy).unwrap() + "31.18,0.00001\n";
    std::fs::write(&copy, longer).unwrap();
    assert!(
        with("another name.csv")
            .iter()
            .zip(&listed)
            .all(|(a, b)| a != b)
    );
}

/// A run made in the tree of its case has the identity, and the values, of the text that shows
/// it: whatever varies, also what the case leaves out, words and whole models.
#[test]
fn identity_is_that_of_the_shown_text() {
    let folder = tempfile::tempdir().unwrap();
    let varied = study(
        folder.path(),
        r#"
[[variable]]
name = "height"
path = "building.light.height"
values = ["3 m", 3.003]
[[variable]]
name = "tolerance"
path = "gap.0.elevation_tolerance"
values = [0.02, "1 cm"]
[[variable]]
name = "ratio"
path = "building.1.damping.stiffness_proportional"
values = [0.05, "2 %"]
[[variable]]
name = "model"
path = "gap.light-heavy.model"
values = [{ model = "jankowski_2005", stiffness = "2.75e9 N/m^1.5", restitution = 0.7 }, { model = "anagnostopoulos_2004", restitution = 0.6, stiffness = "93.5 MN/m", separation = "no_tension" }]
[[variable]]
name = "method"
path = "analysis.method"
values = ["event_driven", "adaptive"]
[[variable]]
records = ["MOTIONS/el_centro_1940_ns.csv", { file = "MOTIONS/kobe_1995_jma_ns.csv", prepend_zero = false, process = [{ sign = "reversed" }] }]
[design]
kind = "latin_hypercube"
runs = 12
"#,
    )
    .unwrap();
    let found = rows(&varied, folder.path());
    for (row, _) in &found {
        assert_eq!(row.ending, Ending::Complete);
        let alone = tempfile::tempdir().unwrap();
        let text = case_of_run(&varied, row.run).unwrap();
        std::fs::write(alone.path().join("case.toml"), text).unwrap();
        let duration =
            "case = \"case.toml\"\n[[variable]]\npath = \"analysis.duration\"\nvalues = [6]\n";
        let alone_study = Study::parse(duration, &alone.path().join("study.toml")).unwrap();
        let (same, _) = rows(&alone_study, alone.path()).remove(0);
        assert_eq!(same.id, row.id, "run {}", row.run);
        assert_eq!(same.values, row.values, "run {}", row.run);
    }
}

/// Values that the case bears alone and not together are failures of their runs, whose
/// messages have their places in the text of the run, be it the case or a model that refuses.
#[test]
fn failures_have_their_place_in_the_text_of_the_run() {
    let folder = tempfile::tempdir().unwrap();
    study(folder.path(), "").unwrap_err();
    let case = std::fs::read_to_string(folder.path().join("case.toml")).unwrap();
    let case = case.replace("jankowski_2005", "anagnostopoulos_2004");
    let case = case.replace("2.75e9 N/m^1.5", "93.5 MN/m");
    std::fs::write(folder.path().join("case.toml"), &case).unwrap();
    let text = r#"
case = "case.toml"
[[variable]]
name = "tolerance"
path = "gap.0.elevation_tolerance"
values = [0.02, 0.002]
[[variable]]
name = "height"
path = "building.light.height"
values = [3, 3.003]
[[variable]]
name = "model"
path = "gap.0.model"
values = [{ model = "anagnostopoulos_2004", stiffness = 93.5e6, restitution = 0.65 }, { model = "hertz_1882", stiffness = 2.75e9 }]
[[variable]]
name = "rule"
path = "gap.0.separation"
values = ["no_tension", "zero_penetration"]
"#;
    let varied = Study::parse(text, &folder.path().join("study.toml")).unwrap();
    let (mut by_case, mut by_model) = (0, 0);
    for (row, _) in rows(&varied, folder.path()) {
        let file = folder.path().join("case.toml");
        let shown = case_of_run(&varied, row.run);
        let Ending::Failed(reason) = row.ending else {
            shown.unwrap();
            continue;
        };
        match shown {
            // It cannot be shown for the same reason.
            Err(e) => {
                by_case += 1;
                assert!(reason.contains("case.toml:"), "{reason}");
                assert!(e.to_string().contains(&reason), "{e}");
            }
            Ok(text) => {
                by_model += 1;
                let case = Case::parse(&text, &file).unwrap();
                assert_eq!(reason, assemble(&case).unwrap_err().to_string());
                let line = text.lines().position(|l| l.starts_with("separation"));
                let line = format!("case.toml:{}:", line.unwrap() + 1);
                assert!(reason.contains(&line), "{reason}");
            }
        }
    }
    assert_eq!((by_case, by_model), (4, 3));
}

/// Variables of which one lies within the other cannot be written together.
#[test]
fn variables_within_one_another_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    study(folder.path(), "").unwrap_err();
    let case = std::fs::read_to_string(folder.path().join("case.toml")).unwrap();
    let case = case.replace(
        "[analysis]",
        "scale = { psa = 2, period = 1 }\n\n[analysis]",
    );
    std::fs::write(folder.path().join("case.toml"), &case).unwrap();
    let of = |second: &str| {
        let text = format!(
            "case = \"case.toml\"\n[[variable]]\nname = \"a\"\npath = \"ground_motion.scale\"\nvalues = [1, 2]\n[[variable]]\nname = \"b\"\npath = \"ground_motion.scale.{second}\"\nvalues = [0.5]\n"
        );
        Study::parse(&text, &folder.path().join("study.toml"))
    };
    for second in ["period", "damping"] {
        let wrong = of(second).unwrap_err().to_string();
        assert!(
            wrong.contains("\"a\" and \"b\" vary the same entry"),
            "{wrong}"
        );
    }
}

/// Scaled to a measure, a record has it; and the isolated demand grows in proportion, for
/// the buildings are elastic.
/// Which periods an intensity takes: its title and their number.
#[test]
fn intensities_say_their_periods() {
    let folder = tempfile::tempdir().unwrap();
    let title = |intensity: &str| {
        let text = format!(
            "[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\"]\n[[variable]]\nintensity = {intensity}\nvalues = [2, 4]\n"
        );
        let study = study(folder.path(), &text).map_err(|e| format!("{e}"));
        study.map(|study| study.variables[1].long_name.clone())
    };
    for (intensity, expected) in [
        (
            "\"spectral_acceleration\"\nperiod = \"1 s\"",
            "PSA(1.0000 s), 5 % damping",
        ),
        (
            "\"spectral_acceleration\"\nperiod = [0.5, 1]",
            "geometric mean of PSA(0.5000 s) and PSA(1.0000 s), 5 % damping",
        ),
        (
            "\"spectral_acceleration\"\nperiod = [0.5, 0.2, 1]",
            "geometric mean of PSA at 3 periods from 0.2000 to 1.0000 s, 5 % damping",
        ),
        (
            "\"average_spectral_acceleration\"\nperiod = \"1 s\"",
            "average PSA over 30 periods from 0.2000 to 3.0000 s, 5 % damping",
        ),
        (
            "\"average_spectral_acceleration\"\nperiod = [\"1 s\"]",
            "average PSA over 30 periods from 0.2000 to 3.0000 s, 5 % damping",
        ),
    ] {
        assert_eq!(title(intensity).unwrap(), expected);
    }
    let refused = title("\"average_spectral_acceleration\"\nperiod = [0.5, 1]").unwrap_err();
    assert!(refused.contains("not over a list"), "{refused}");
}

#[test]
fn intensities_are_reached() {
    let folder = tempfile::tempdir().unwrap();
    for (measure, unit) in [
        (
            "intensity = \"peak_ground_acceleration\"\nvalues = [\"0.2 g\", \"0.4 g\"]",
            "m s-2",
        ),
        (
            "intensity = \"peak_ground_velocity\"\nvalues = [0.2, 0.4]",
            "m s-1",
        ),
        (
            "intensity = \"spectral_acceleration\"\nbuilding = \"light\"\nvalues = [2, 4]",
            "m s-2",
        ),
        (
            "intensity = \"spectral_acceleration\"\nvalues = [2, 4]",
            "m s-2",
        ),
        (
            "intensity = \"average_spectral_acceleration\"\nvalues = [2, 4]",
            "m s-2",
        ),
    ] {
        let text = format!(
            "[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\", \"MOTIONS/kobe_1995_jma_ns.csv\"]\n[[variable]]\n{measure}\n[output]\nisolated_demand = true\n"
        );
        let study = study(folder.path(), &text).unwrap();
        assert_eq!(study.variables[1].unit, unit);
        let rows = rows(&study, folder.path());
        let reader =
            ResultReader::open(&folder.path().join("out.h5"), WithoutChecksum::Refuse).unwrap();
        let demand = reader.description.layout.range("isolated_demand");
        for pair in rows.chunks(2) {
            for column in demand.clone() {
                let ratio = pair[1].0.values[column] / pair[0].0.values[column];
                assert!((ratio - 2.0).abs() < 1e-7, "{measure}: {ratio}");
            }
        }
    }
}

/// Measures of a motion that has them in closed form: a sine of amplitude A and frequency
/// w has PGA A, and from rest its velocity reaches 2 A / w.
#[test]
fn measures_have_their_closed_forms() {
    use pounding_ground_motion::{AccelerationUnit, Accelerogram};
    let (step, w, a) = (1.0e-3, 5.0_f64, 2.5);
    let samples: Vec<f64> = (0..20_000)
        .map(|i| a * (w * step * f64::from(i)).sin())
        .collect();
    let unit = AccelerationUnit::MetrePerSecondSquared;
    let motion = Accelerogram::new(samples, unit, step).unwrap();
    let pga = IntensityMeasure::PeakGroundAcceleration
        .of(&motion)
        .unwrap();
    assert!((pga / a - 1.0).abs() < 1e-5, "{pga}");
    let pgv = IntensityMeasure::PeakGroundVelocity.of(&motion).unwrap();
    assert!((pgv / (2.0 * a / w) - 1.0).abs() < 1e-5, "{pgv}");
    // From the velocity that a file states: 0.5, 0.2 and -0.05 m/s, where from rest it would be 0.55 m/s.
    let text = "# Initial velocity: 0.5 m/s\ntime_s,acceleration_m_s2\n0,-3\n0.1,-3\n0.2,-2\n";
    let moving = pounding_ground_motion::read_bytes(
        "moving.csv",
        text.as_bytes(),
        &pounding_ground_motion::ReadOptions::default(),
    );
    let pgv = IntensityMeasure::PeakGroundVelocity
        .of(&moving.unwrap())
        .unwrap();
    assert!((pgv - 0.5).abs() < 1e-12, "{pgv}");
    // A stiff oscillator follows the ground; two periods make a geometric mean.
    let spectral = |periods: &[f64]| {
        let periods = periods.to_vec();
        let measure = IntensityMeasure::SpectralAcceleration {
            periods,
            damping: 0.05,
        };
        measure.of(&motion).unwrap()
    };
    assert!((spectral(&[0.01]) / a - 1.0).abs() < 1e-2);
    let mean = (spectral(&[0.5]) * spectral(&[2.0])).sqrt();
    assert!((spectral(&[0.5, 2.0]) / mean - 1.0).abs() < 1e-12);
}

/// The isolated demand is the gap that just keeps the buildings apart: a thousandth of a
/// millimetre more and they do not touch, less and they do.
#[test]
fn the_isolated_demand_just_keeps_the_buildings_apart() {
    let folder = tempfile::tempdir().unwrap();
    let of = |text: &str| {
        let study = study(folder.path(), text).unwrap();
        let rows = rows(&study, folder.path());
        let reader =
            ResultReader::open(&folder.path().join("out.h5"), WithoutChecksum::Refuse).unwrap();
        let layout = reader.description.layout.clone();
        drop(reader);
        std::fs::remove_file(folder.path().join("out.h5")).unwrap();
        (rows, layout)
    };
    let (rows, layout) = of(
        "[[variable]]\npath = \"gap.0.width\"\nvalues = [0.03]\n[output]\nisolated_demand = true\n",
    );
    let demand = rows[0].0.values[layout.range("isolated_demand")]
        .iter()
        .copied()
        .fold(0.0, f64::max);
    assert!(demand > 0.05, "{demand}");
    let (below, above) = (demand - 1e-9, demand + 1e-9);
    let (rows, layout) = of(&format!(
        "[[variable]]\npath = \"gap.0.width\"\nvalues = [{below:e}, {above:e}]\n"
    ));
    let impacts = |row: usize| {
        rows[row].0.values[layout.range("impacts")]
            .iter()
            .sum::<f64>()
    };
    assert!(impacts(0) > 0.0, "{demand}");
    assert_eq!(impacts(1), 0.0, "{demand}");
}

/// Tables that the case leaves out come with their entries; what cannot stand there is refused.
#[test]
fn tables_that_the_case_leaves_out_are_put_in() {
    let folder = tempfile::tempdir().unwrap();
    let of = |path: &str, values: &str| {
        let text = format!("[[variable]]\npath = \"{path}\"\nvalues = {values}\n");
        study(folder.path(), &text)
    };
    let importance = of("separation.importance", "[1, 1.25]").unwrap();
    let text = case_of_run(&importance, 1).unwrap();
    assert!(text.contains("separation.importance = 1.25e0\n"), "{text}");
    let case = Case::parse(&text, &folder.path().join("case.toml")).unwrap();
    assert_eq!(case.separation.importance, Some(vec![1.25; 2]));
    for (path, says) in [
        ("separation.importence", "unknown key `importence`"),
        ("seperation.importance", "the case has no `seperation`"),
    ] {
        let text = format!("{:?}", of(path, "[1]").unwrap_err());
        assert!(text.contains(says), "{path}: {text}");
    }
}

/// Keys of another kind of variable, and of another design, are refused in their lines.
#[test]
fn keys_of_other_variables_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = "[[variable]]\npath = \"gap.0.width\"\n";
    let values = format!("{path}values = [0.01]\n");
    let range = format!("{path}from = 0.01\nto = 0.02\ncount = 3\n");
    let records = "[[variable]]\nrecords = [\"a.csv\"]\n";
    let intensity = "[[variable]]\nintensity = \"peak_ground_velocity\"\nvalues = [1]\n";
    for (variable, key, help) in [
        (records, "count = 3", "beside `path` or `intensity`"),
        (records, "building = \"nix\"", "beside `intensity`"),
        (records, "from = 3", "beside `path` or `intensity`"),
        (records, "values = [3]", "beside `path` or `intensity`"),
        (values.as_str(), "building = \"nix\"", "beside `intensity`"),
        (&values, "period = 1", "beside `intensity`"),
        (&values, "damping = 0.3", "beside `intensity`"),
        (intensity, "damping = 0.3", "remove it"),
        (
            &range,
            "[design]\nkind = \"latin_hypercube\"\nruns = 2",
            "`runs` in [design]",
        ),
        (
            &range,
            "[design]\nkind = \"sobol\"\nruns = 2",
            "`runs` in [design]",
        ),
    ] {
        let error = study(folder.path(), &format!("{variable}{key}\n")).unwrap_err();
        let text = format!("{error:?}");
        let name = match key.starts_with('[') {
            true => "count",
            false => key.split(' ').next().unwrap(),
        };
        assert!(
            text.contains(&format!("`{name}` has no meaning for")),
            "{key}: {text}"
        );
        assert!(text.contains(help), "{key}: {text}");
    }
    assert!(study(folder.path(), &range).is_ok());
}

/// Grid, list, Latin hypercube and Sobol designs over a list, a range and a choice.
#[test]
fn designs_sample_what_they_say() {
    let folder = tempfile::tempdir().unwrap();
    let variables = "[[variable]]\nname = \"a\"\npath = \"gap.0.width\"\nvalues = [0.01, 0.02]\n[[variable]]\nname = \"b\"\npath = \"gap.0.restitution\"\nfrom = 0.4\nto = 0.8\nCOUNT\n";
    let of = |count: &str, design: &str| {
        study(
            folder.path(),
            &format!("{}{design}", variables.replace("COUNT", count)),
        )
    };
    let numbers = |study: &Study| -> Vec<(f64, f64)> {
        let number = |v: Value| match v {
            Value::Number(x) => x,
            Value::Choice(_) => f64::NAN,
        };
        (0..study.runs())
            .map(|r| study.point(r))
            .map(|p| (number(p[0]), number(p[1])))
            .collect()
    };
    let grid = numbers(&of("count = 3", "").unwrap());
    let expected = [
        (0.01, 0.4),
        (0.01, 0.6),
        (0.01, 0.8),
        (0.02, 0.4),
        (0.02, 0.6),
        (0.02, 0.8),
    ];
    for (found, wanted) in grid.iter().zip(expected) {
        assert!(
            found.0 == wanted.0 && (found.1 - wanted.1).abs() < 1e-15,
            "{grid:?}"
        );
    }
    let list = numbers(&of("count = 2", "[design]\nkind = \"list\"\n").unwrap());
    assert_eq!(list, [(0.01, 0.4), (0.02, 0.8)]);
    assert!(of("count = 3", "[design]\nkind = \"list\"\n").is_err());
    for kind in ["latin_hypercube", "sobol"] {
        let design = format!("[design]\nkind = \"{kind}\"\nruns = 64\nseed = 5\n");
        let points = numbers(&of("", &design).unwrap());
        assert_eq!(points.iter().filter(|p| p.0 == 0.01).count(), 32, "{kind}");
        let mut shares: Vec<usize> = points
            .iter()
            .map(|p| ((p.1 - 0.4) / 0.4 * 64.0) as usize)
            .collect();
        shares.sort_unstable();
        assert_eq!(shares, (0..64).collect::<Vec<_>>(), "{kind}");
        let other = design.replace("seed = 5", "seed = 6");
        assert_ne!(numbers(&of("", &other).unwrap()), points, "{kind}");
        assert_eq!(numbers(&of("", &design).unwrap()), points, "{kind}");
    }
}

/// The same where floors hit columns, whose points are coordinates of the buildings and belong
/// to the gaps: a sweep over the width and over all that makes a column.
#[test]
fn sharing_changes_no_bit_where_columns_are_hit() {
    let folder = tempfile::tempdir().unwrap();
    let motions = root().join("ground_motions");
    let motions = motions.to_str().unwrap();
    let building = |name: &str, heights: &str, stiffness: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nmass = \"100 t\"\nheight = {heights}\nstiffness = \"{stiffness}\"\ndamping = {{ ratio = 0.05, modes = [1, 2] }}\n"
        )
    };
    let low = building("low", "[4.4, 3.6]", "40 MN/m");
    let tall = building("tall", "[3.0, 3.0, 3.0]", "300 MN/m");
    for mass in ["contact_mass = \"2 t\", ", ""] {
        let case = format!(
            "{low}{tall}[[gap]]\nbetween = [\"low\", \"tall\"]\nwidth = 0.01\nmodel = \"linear_elastic\"\nstiffness = 3e8\nelevation_tolerance = 0.02\ncolumn = {{ of = \"tall\", {mass}flexural_rigidity = 2e8, ends = \"fixed\" }}\n[ground_motion]\nfile = \"{motions}/el_centro_1940_ns.csv\"\n[analysis]\nduration = 3\n"
        );
        std::fs::write(folder.path().join("case.toml"), case).unwrap();
        let second = match mass {
            "" => {
                "[[variable]]\nname = \"ends\"\npath = \"gap.0.column.ends\"\nvalues = [\"fixed\", \"pinned\"]\n"
            }
            _ => {
                "[[variable]]\nname = \"m\"\npath = \"gap.0.column.contact_mass\"\nvalues = [1000, 4000]\n"
            }
        };
        let text = format!(
            "case = \"case.toml\"\n[output]\nisolated_demand = true\nisolated_peaks = true\n[[variable]]\nname = \"gap\"\npath = \"gap.0.width\"\nvalues = [0.008, 0.012]\n[[variable]]\nname = \"EI\"\npath = \"gap.0.column.flexural_rigidity\"\nvalues = [1e8, 2e8]\n{second}"
        );
        let study = Study::parse(&text, &folder.path().join("study.toml")).unwrap();
        let rows = rows(&study, folder.path());
        assert_eq!(rows.len(), 8);
        let reader =
            ResultReader::open(&folder.path().join("out.h5"), WithoutChecksum::Refuse).unwrap();
        let layout = &reader.description.layout;
        let mut shears = Vec::new();
        for (row, _) in &rows {
            assert_eq!(row.ending, Ending::Complete);
            let text = case_of_run(&study, row.run).unwrap();
            let case = Case::parse(&text, &folder.path().join("case.toml")).unwrap();
            let assembly = assemble(&case).unwrap();
            let alone = run(&assembly.system, &assembly.options, &mut [], &mut |_| {}).unwrap();
            let mut expected = Vec::new();
            let (isolated, demand) = isolated_demand(&assembly.system, &assembly.options).unwrap();
            let buildings = isolated.buildings.into_iter();
            let storeys = buildings.flat_map(|b| b.storeys.into_iter().zip(b.yielding));
            let isolated = IsolatedRun {
                demand: demand.iter().map(|p| p.value).collect(),
                storeys: Some(storeys.collect()),
            };
            layout.fill(&alone, &isolated, &mut expected);
            assert_eq!(bits(&row.values), bits(&expected), "{text}");
            assert!(alone.impacts.len() > 1);
            shears.push(row.values[layout.range("peak_column_shear")].to_vec());
        }
        shears.dedup();
        assert_eq!(shears.len(), 8, "every value changes the columns");
    }
}

/// Peaks without pounding are those of the run that gives the isolated demand, and of the same buildings a kilometre apart,
/// with their link, whatever the gap and its model.
#[test]
fn peaks_without_pounding_are_those_of_buildings_far_apart() {
    const PEAKS: [&str; 4] = [
        "peak_displacement",
        "peak_drift_ratio",
        "peak_storey_shear",
        "peak_acceleration_absolute",
    ];
    let folder = tempfile::tempdir().unwrap();
    let case = std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml"));
    let records = root().join("ground_motions");
    let case = case
        .unwrap()
        .replace("../../ground_motions", records.to_str().unwrap())
        + "[[link]]\nbetween = [\"light\", \"heavy\"]\nlevels = [[3, 3]]\nmodel = \"linear\"\nstiffness = \"200 kN/m\"\n";
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    for method in ["event_driven", "adaptive"] {
        let text = format!(
            "case = \"case.toml\"\n[output]\nisolated_peaks = true\n[[variable]]\nname = \"method\"\npath = \"analysis.method\"\nvalues = [\"{method}\"]\n[[variable]]\nname = \"gap\"\npath = \"gap.0.width\"\nvalues = [0.005, 0.01, 1000]\n[[variable]]\nname = \"model\"\npath = \"gap.0.model\"\nvalues = [{{ model = \"linear_elastic\", stiffness = 1e8 }}, {{ model = \"stereomechanical\", restitution = 0.6 }}]\n[[variable]]\npath = \"ground_motion.scale\"\nvalues = [1, 1.25]\n"
        );
        let study = Study::parse(&text, &folder.path().join("study.toml")).unwrap();
        let rows = rows(&study, folder.path());
        let reader =
            ResultReader::open(&folder.path().join("out.h5"), WithoutChecksum::Refuse).unwrap();
        let layout = &reader.description.layout;
        assert!(layout.range("isolated_demand").is_empty());
        let mut amplified = 0;
        for (row, _) in &rows {
            assert_eq!(row.ending, Ending::Complete);
            let text = case_of_run(&study, row.run).unwrap();
            let case = Case::parse(&text, &folder.path().join("case.toml")).unwrap();
            let assembly = assemble(&case).unwrap();
            let (alone, _) = isolated_demand(&assembly.system, &assembly.options).unwrap();
            let storeys = || alone.buildings.iter().flat_map(|b| &b.storeys);
            let of_run: [Vec<f64>; 4] = [
                storeys().map(|s| s.displacement.value).collect(),
                storeys().map(|s| s.drift_ratio.value).collect(),
                storeys().map(|s| s.storey_shear.value).collect(),
                storeys().map(|s| s.acceleration_absolute.value).collect(),
            ];
            let far = (8..12).contains(&row.run);
            for (name, of_run) in PEAKS.iter().zip(&of_run) {
                let isolated = &row.values[layout.range(&format!("isolated_{name}"))];
                assert_eq!(bits(isolated), bits(of_run), "{name}");
                let with = &row.values[layout.range(name)];
                if far {
                    assert_eq!(bits(isolated), bits(with), "{name}");
                }
                amplified += usize::from(isolated != with);
            }
        }
        assert_eq!(amplified, 8 * 4, "{method}");
        drop(reader);
        std::fs::remove_file(folder.path().join("out.h5")).unwrap();
    }
}

/// Links that a variable lets join other floors keep the levels that they have in the case: what a run does not have
/// is missing, and a warning says so.
#[test]
fn levels_of_links_are_those_of_the_case() {
    let folder = tempfile::tempdir().unwrap();
    let case = std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml"));
    let records = root().join("ground_motions");
    let case = case
        .unwrap()
        .replace("../../ground_motions", records.to_str().unwrap())
        + "[[link]]\nname = \"tie\"\nbetween = [\"light\", \"heavy\"]\nlevels = [[2, 2], [3, 3]]\nmodel = \"linear\"\nstiffness = \"200 kN/m\"\n";
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    let text = "case = \"case.toml\"\n[[variable]]\npath = \"link.tie.levels.0.0\"\nname = \"lower\"\nvalues = [2, 1]\n[[variable]]\npath = \"link.tie.levels.1.0\"\nname = \"upper\"\nvalues = [3, 2]\n";
    let study = Study::parse(text, &folder.path().join("study.toml")).unwrap();
    let rows = rows(&study, folder.path());
    let reader =
        ResultReader::open(&folder.path().join("out.h5"), WithoutChecksum::Refuse).unwrap();
    let description = &reader.description;
    let warned = description.warnings.join("\n");
    assert!(
        warned.contains("changes which floors a link joins"),
        "{warned}"
    );
    let layout = &description.layout;
    let labels: Vec<&str> = layout.link_levels.iter().map(|l| &*l.label).collect();
    assert_eq!(labels, ["tie 2-2", "tie 3-3"]);
    let (lower, upper) = (Some(0), Some(1));
    let of_runs = [[lower, upper], [lower, None], [None, upper], [None; 2]];
    for ((row, _), levels) in rows.iter().zip(of_runs) {
        assert_eq!(row.ending, Ending::Complete);
        let text = case_of_run(&study, row.run).unwrap();
        let case = Case::parse(&text, &folder.path().join("case.toml")).unwrap();
        let assembly = assemble(&case).unwrap();
        let alone = run(&assembly.system, &assembly.options, &mut [], &mut |_| {}).unwrap();
        let expected = |of: fn(&LinkLevelOutcome) -> f64| {
            levels.map(|level| level.map_or(f64::NAN, |level| of(&alone.links[0].levels[level])))
        };
        let forces = &row.values[layout.range("peak_link_force")];
        assert_eq!(bits(forces), bits(&expected(|l| l.force.value)), "{text}");
        let deformations = &row.values[layout.range("peak_link_deformation")];
        assert_eq!(bits(deformations), bits(&expected(|l| l.deformation.value)));
    }
}

/// An intensity scales all that moves the ground: a building whose own record is that of the
/// case, scaled twice as much, keeps twice the motion of its neighbour at every intensity, and so
/// does the case that stands for a run.
#[test]
fn an_intensity_scales_records_of_buildings_too() {
    let folder = tempfile::tempdir().unwrap();
    let record = root().join("ground_motions/el_centro_1940_ns.csv");
    let building = |name: &str, ground: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nmass = [\"25 t\"]\nstiffness = \"3 MN/m\"\nheight = 3\n\
             damping = {{ modal = 0.05 }}\n{ground}"
        )
    };
    let own = format!("ground = {{ file = {record:?}, scale = {{ pga = \"0.6 g\" }} }}\n");
    let case = format!(
        "{}{}[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = 9\nmodel = \"linear_elastic\"\nstiffness = 1e8\n\
         [ground_motion]\nfile = {record:?}\nscale = {{ pga = \"0.3 g\" }}\n[analysis]\nduration = 6\n",
        building("A", ""),
        building("B", &own),
    );
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    let text = "case = \"case.toml\"\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.2 g\", \"0.5 g\"]\n";
    let study = Study::parse(text, &folder.path().join("study.toml")).unwrap();
    let rows = rows(&study, folder.path());
    assert_eq!(rows.len(), 2);
    let roofs = [0, 1].map(|number| {
        let text = case_of_run(&study, number).unwrap();
        let case = Case::parse(&text, &folder.path().join("case.toml")).unwrap();
        let assembly = assemble(&case).unwrap();
        let outcome = run(&assembly.system, &assembly.options, &mut [], &mut |_| {}).unwrap();
        let roofs = [0, 1].map(|b| outcome.buildings[b].storeys[0].displacement.value);
        let values = &rows[number].0.values;
        for roof in roofs {
            let found = values.iter().any(|x| (x / roof - 1.0).abs() < 1e-12);
            assert!(found, "{roof} is not in {values:?}");
        }
        roofs
    });
    for [a, b] in roofs {
        assert!((b / a - 2.0).abs() < 1e-9, "{a} {b}");
    }
    assert!((roofs[1][0] / roofs[0][0] - 2.5).abs() < 1e-9, "{roofs:?}");
}

/// At one intensity the record of a building is as strong whatever record takes the place of that
/// of the case, however strongly that was recorded: its proportion is to the record of the case.
#[test]
fn records_of_buildings_keep_their_proportion_to_the_case() {
    let folder = tempfile::tempdir().unwrap();
    let record = |name: &str| root().join("ground_motions").join(name);
    let [first, second] = ["el_centro_1940_ns.csv", "kobe_1995_jma_ns.csv"].map(record);
    let building = |name: &str, ground: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nmass = [\"25 t\"]\nstiffness = \"3 MN/m\"\nheight = 3\n\
             damping = {{ modal = 0.05 }}\n{ground}"
        )
    };
    let own = format!("ground = {{ file = {second:?}, scale = 1.5 }}\n");
    let case = format!(
        "{}{}[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = 9\nmodel = \"linear_elastic\"\nstiffness = 1e8\n\
         [ground_motion]\nfile = {first:?}\nscale = {{ pga = \"0.2 g\" }}\n[analysis]\nduration = 6\n",
        building("A", ""),
        building("B", &own),
    );
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    let text = format!(
        "case = \"case.toml\"\n[[variable]]\nrecords = [{first:?}, {second:?}]\n\
         [[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.1 g\", \"0.4 g\"]\n"
    );
    let study = Study::parse(&text, &folder.path().join("study.toml")).unwrap();
    let rows = rows(&study, folder.path());
    assert_eq!(rows.len(), 4);
    for (row, _) in &rows {
        let text = case_of_run(&study, row.run).unwrap();
        let case = Case::parse(&text, &folder.path().join("case.toml")).unwrap();
        let ground = case.buildings[1].ground.as_ref().unwrap();
        let scale = &ground
            .value
            .motion
            .as_ref()
            .unwrap()
            .scale
            .as_ref()
            .unwrap();
        // The case has 0.2 g, of which these are a half and twice as much.
        let expected = [0.75, 3.0][row.run % 2];
        match scale.value {
            Scale::Factor(scale) => {
                assert!((scale / expected - 1.0).abs() < 1e-12, "{scale}")
            }
            ref other => panic!("{other:?}"),
        }
        let assembly = assemble(&case).unwrap();
        let outcome = run(&assembly.system, &assembly.options, &mut [], &mut |_| {}).unwrap();
        for building in &outcome.buildings {
            let roof = building.storeys[0].displacement.value;
            let found = row.values.iter().any(|x| (x / roof - 1.0).abs() < 1e-12);
            assert!(found, "{roof} is not in {:?}", row.values);
        }
    }
    std::fs::write(
        folder.path().join("zero.csv"),
        "time_s,acceleration_m/s2\n0,0\n1,0\n",
    )
    .unwrap();
    let still = std::fs::read_to_string(folder.path().join("case.toml")).unwrap();
    let still = still.replacen(
        &format!("[ground_motion]\nfile = {first:?}\nscale = {{ pga = \"0.2 g\" }}"),
        "[ground_motion]\nfile = \"zero.csv\"",
        1,
    );
    std::fs::write(folder.path().join("case.toml"), still).unwrap();
    let study = Study::parse(&text, &folder.path().join("study.toml")).unwrap();
    let refused = sweep(&study, &options(folder.path()), &mut |_| {
        std::ops::ControlFlow::Continue(())
    });
    let said = refused.unwrap_err().to_string();
    assert!(
        said.contains("keep their proportion to the record of the case"),
        "{said}"
    );
}

/// The case of an example, changed, in a folder of its own, and a study of it.
pub(super) fn study_of_example(
    folder: &Path,
    example: &str,
    change: impl Fn(String) -> String,
    text: &str,
) -> Study {
    let case = root().join("examples").join(example).join("case.toml");
    let case = std::fs::read_to_string(case).unwrap();
    let motions = root().join("ground_motions");
    let case = case.replace("../../ground_motions", motions.to_str().unwrap());
    let case = case.replace("duration = \"20 s\"", "duration = \"4 s\"");
    std::fs::write(folder.join("case.toml"), change(case)).unwrap();
    Study::parse(
        &format!("case = \"case.toml\"\n{text}"),
        &folder.join("study.toml"),
    )
    .unwrap()
}

/// A run in which other floors meet than in the case of the study has no place in its levels: it
/// fails with both, and no force stands under the name of another level.
#[test]
fn runs_in_which_other_floors_meet_fail() {
    let folder = tempfile::tempdir().unwrap();
    let text =
        "[[variable]]\nname = \"h\"\npath = \"building.0.height\"\nvalues = [3.0, 3.5, 4.5, 2.5]\n";
    let study = study_of_example(folder.path(), "slab_hits_column", |case| case, text);
    let rows = rows(&study, folder.path());
    let reader =
        ResultReader::open(&folder.path().join("out.h5"), WithoutChecksum::Refuse).unwrap();
    let layout = &reader.description.layout;
    for (row, _) in &rows {
        let shown = case_of_run(&study, row.run).unwrap();
        let case = Case::parse(&shown, &folder.path().join("case.toml")).unwrap();
        let assembly = assemble(&case).unwrap();
        let alone = run(&assembly.system, &assembly.options, &mut [], &mut |_| {}).unwrap();
        let levels = || alone.gaps.iter().flat_map(|gap| &gap.levels);
        let places = assembly.system.levels().iter().map(|level| level.place);
        let labels: Vec<String> = places
            .map(|place| format!("low-tall {}", place.label()))
            .collect();
        let of_study: Vec<&str> = layout.levels.iter().map(|l| l.label.as_str()).collect();
        if labels == of_study {
            assert_eq!(row.ending, Ending::Complete);
            let forces: Vec<f64> = levels().map(|level| level.peak_force.value).collect();
            assert_eq!(row.values[layout.range("peak_force")], forces);
            // The columns are hit where the floors are whose heights vary.
            assert!(layout.levels.iter().all(|l| l.elevations == [None; 2]));
            continue;
        }
        let said = row.ending.diagnosis().unwrap();
        let both = "low-tall 1-1, low-tall 2-2 for low-tall 1-2, low-tall 2-3";
        assert!(row.ending.failed() && said.contains(both), "{said}");
        assert!(row.values.iter().all(|x| x.is_nan()));
    }
    let failed: Vec<bool> = rows.iter().map(|(row, _)| row.ending.failed()).collect();
    assert_eq!(failed, [true, false, false, true]);
}

/// Elevations and positions of contact points that a variable changes are those of no run alone:
/// they are left out, whichever key of the building they come from.
#[test]
fn places_that_vary_are_left_out() {
    let folder = tempfile::tempdir().unwrap();
    let elevations = |case: String| {
        case.replacen("height = \"3 m\"", "elevations = [3, 6, 9]", 1)
            .replace("31 s", "2 s")
            .replace("[ground_motion]", "[ground_motion]\nscale = 0.1")
            .replace(
                "width = \"20 mm\"",
                "width = \"20 mm\"\nelevation_tolerance = 0.1",
            )
    };
    let text = "[[variable]]\nname = \"z\"\npath = \"building.light.elevations.2\"\nvalues = [9.0, 9.05]\n";
    let study = study_of_example(folder.path(), "sweep_three_storey_pair", elevations, text);
    let found = rows(&study, folder.path());
    assert!(found.iter().all(|(row, _)| row.ending == Ending::Complete));
    let reader =
        ResultReader::open(&folder.path().join("out.h5"), WithoutChecksum::Refuse).unwrap();
    let layout = &reader.description.layout;
    for storey in &layout.storeys {
        assert_eq!(
            storey.elevations == [None],
            storey.of == "light",
            "{storey:?}"
        );
    }
    for level in &layout.levels {
        assert!(level.elevations[0].is_none() && level.elevations[1].is_some());
    }
    drop(reader);
    let text =
        "[[variable]]\nname = \"w\"\npath = \"building.low.plan.width\"\nvalues = [10, 12]\n";
    let study = study_of_example(folder.path(), "pair_that_turns", |case| case, text);
    let found = rows(&study, folder.path());
    assert!(found.iter().all(|(row, _)| row.ending == Ending::Complete));
    let reader =
        ResultReader::open(&folder.path().join("out.h5"), WithoutChecksum::Refuse).unwrap();
    let levels = &reader.description.layout.levels;
    let labels: Vec<&str> = levels.iter().map(|l| l.label.as_str()).collect();
    let points = [1, 2].map(|floor| [1, 2].map(|n| format!("low-stiff {floor}-{floor} point {n}")));
    assert_eq!(labels, points.concat());
    let heads: Vec<String> = levels.iter().map(|l| l.heading()).collect();
    assert_eq!(heads, labels);
}

/// What changes no result is no variable: its values would be coordinates of equal runs.
#[test]
fn variables_without_effect_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (path, values) in [
        ("title", "[\"a\", \"b\"]"),
        ("analysis.output_step", "[0.01, 0.02]"),
    ] {
        let text = format!("[[variable]]\nname = \"x\"\npath = \"{path}\"\nvalues = {values}\n");
        let refused = study(folder.path(), &text).unwrap_err();
        let said = refused.to_string();
        assert!(
            said.contains("study.toml:4")
                && said.contains(&format!("`{path}` changes no result of a study")),
            "{said}"
        );
    }
}

/// All wrong values of a list are said at once: what is no number, and what the case refuses.
#[test]
fn all_wrong_values_are_said_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let text = "[[variable]]\npath = \"gap.0.width\"\nvalues = [0.01, \"-3 mm\", nan, \"x\"]\n";
    let refused = study(folder.path(), text).unwrap_err();
    let StudyError::Text { error, .. } = refused else {
        panic!("{refused}");
    };
    let all = std::iter::once(&*error).chain(&*error.others);
    let places: Vec<_> = all.clone().map(|e| (e.line, e.column)).collect();
    assert_eq!(places, [(4, 17), (4, 26), (4, 31)], "{error:?}");
    let all: String = all.map(ToString::to_string).collect();
    for part in [
        "-0.003 must be zero or more",
        "is not a finite number",
        "\"x\" does not start",
    ] {
        assert!(all.contains(part), "{part}: {all}");
    }
}
