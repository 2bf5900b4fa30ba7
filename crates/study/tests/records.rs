//! The motions of studies: what is done to records, and runs shown as cases of their own.
use std::path::{Path, PathBuf};

use pounding_assembly::assemble;
use pounding_case::{Case, GroundMotion};
use pounding_files::checksum::WithoutChecksum;
use pounding_ground_motion::processing::Scale;
use pounding_study::{
    ResultReader, Row, Shard, Study, StudyError, SweepOptions, case_of_run, sweep,
};
use pounding_time_history::{isolated_demand, run};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .canonicalize()
        .unwrap()
}

fn motions() -> String {
    root().join("ground_motions").display().to_string()
}

/// A study of the three-storey pair for six seconds; `motion` is put under the header
/// `[ground_motion]` of its case.
fn study(folder: &Path, motion: &str, text: &str) -> Result<Study, StudyError> {
    let case =
        std::fs::read_to_string(root().join("examples/sweep_three_storey_pair/case.toml")).unwrap();
    let case = case
        .replace("../../ground_motions", &motions())
        .replace("31 s", "6 s")
        .replace("[ground_motion]", &format!("[ground_motion]\n{motion}"));
    std::fs::write(folder.join("case.toml"), case).unwrap();
    let text = format!(
        "case = \"case.toml\"\n{}",
        text.replace("MOTIONS", &motions())
    );
    Study::parse(&text, &folder.join("study.toml"))
}

fn rows(study: &Study, folder: &Path, keep_going: bool) -> (Vec<Row>, ResultReader) {
    let output = folder.join("out.h5");
    let options = SweepOptions {
        output: output.clone(),
        csv: None,
        threads: 2,
        shard: Shard::WHOLE,
        resume: false,
        store_every: std::time::Duration::from_secs(5),
        keep_going,
        shared: None,
    };
    sweep(
        study,
        &options,
        &mut |_| std::ops::ControlFlow::Continue(()),
    )
    .unwrap();
    let reader = ResultReader::open(&output, WithoutChecksum::Refuse).unwrap();
    let rows = reader.block(0..reader.rows).unwrap();
    (rows.into_iter().map(|(row, _)| row).collect(), reader)
}

fn column(rows: &[Row], reader: &ResultReader, name: &str) -> Vec<Vec<f64>> {
    let range = reader.description.layout.range(name);
    rows.iter()
        .map(|r| r.values[range.clone()].to_vec())
        .collect()
}

/// What a case gives alone.
fn alone(text: &str, folder: &Path) -> Vec<f64> {
    let case = Case::parse(text, &folder.join("case.toml")).unwrap();
    let assembly = assemble(&case).unwrap();
    let outcome = run(&assembly.system, &assembly.options, &mut [], &mut |_| {}).unwrap();
    let storeys = outcome.buildings.iter().flat_map(|b| &b.storeys);
    storeys.map(|s| s.displacement.value).collect()
}

/// The warning of records that are one motion stands in the result of every shard, also of one that
/// reads only its own: a copy under another name, times two by its samples, and scaled by its own
/// process. One that is filtered, or of another earthquake, is another motion.
#[test]
fn records_of_one_motion_are_told_in_every_shard() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let record = std::fs::read_to_string(root().join("ground_motions/el_centro_1940_ns.csv"));
    let record = record.unwrap();
    let doubled: Vec<String> = record
        .lines()
        .map(
            |line| match line.split_once(',').map(|(t, a)| (t, a.parse::<f64>())) {
                Some((t, Ok(a))) => format!("{t},{}", 2.0 * a),
                _ => line.to_owned(),
            },
        )
        .collect();
    assert_ne!(doubled.join("\n"), record.trim_end());
    std::fs::write(path("copy.csv"), &record).unwrap();
    std::fs::write(path("doubled.csv"), doubled.join("\n") + "\n").unwrap();
    let text = "[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\", \"copy.csv\", \"doubled.csv\", \"MOTIONS/kobe_1995_jma_ns.csv\", { name = \"tripled\", file = \"copy.csv\", process = [{ scale = 3 }] }, { name = \"filtered\", file = \"copy.csv\", process = [{ filter = { high_pass = \"1 Hz\" } }] }]\n";
    let study = study(folder.path(), "", text).unwrap();
    for (index, shared) in [(1, None), (1, Some("shared")), (2, Some("shared"))] {
        let options = SweepOptions {
            output: path(&format!("out_{index}.h5")),
            csv: None,
            threads: 1,
            shard: Shard { index, count: 2 },
            resume: false,
            store_every: std::time::Duration::from_secs(5),
            keep_going: false,
            shared: shared.map(path),
        };
        let go_on = &mut |_: &_| std::ops::ControlFlow::Continue(());
        let told = sweep(&study, &options, go_on).unwrap().warnings;
        let told: Vec<_> = told.iter().filter(|w| w.contains("same motion")).collect();
        let [told] = told.as_slice() else {
            panic!("{told:?}");
        };
        let says = "el_centro_1940_ns, copy, doubled and tripled are the same motion, at most scaled, reversed, cut or at another time step: they are one record, of 3 records in all";
        assert!(told.starts_with(says), "{index} {shared:?}: {told}");
    }
}

/// The process of the case acts on every record of a study; a record's own takes its place.
#[test]
fn records_keep_the_process_of_the_case() {
    let folder = tempfile::tempdir().unwrap();
    let doubled = "process = [{ scale = 2 }, { filter = { high_pass = \"0.5 Hz\" } }]";
    let records = "[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\", { name = \"own\", file = \"MOTIONS/el_centro_1940_ns.csv\", process = [] }]\n";
    let with = study(folder.path(), doubled, records).unwrap();
    let (found, reader) = rows(&with, folder.path(), false);
    let found = column(&found, &reader, "peak_displacement");
    drop(reader);
    let case = std::fs::read_to_string(folder.path().join("case.toml")).unwrap();
    assert_eq!(found[0], alone(&case, folder.path()));
    assert_eq!(found[1], alone(&case.replace(doubled, ""), folder.path()));
    assert_ne!(found[0], found[1]);
}

/// Records take every key of `[ground_motion]` but `scale`: each here changes what is read,
/// as it does in a case.
#[test]
fn records_take_the_keys_of_a_case() {
    let folder = tempfile::tempdir().unwrap();
    let plain: String = (0..400)
        .map(|i| {
            let t = 0.01 * f64::from(i);
            let (a, b) = ((9.0 * t).sin(), 0.5 * (5.0 * t).cos());
            format!("{i:04} {a:9.6} {b:9.6}\n")
        })
        .collect();
    std::fs::write(folder.path().join("plain.txt"), plain).unwrap();
    let base = "file = \"plain.txt\", time_step = 0.01";
    for keys in [
        "layout = \"a,b\", component = \"a\", unit = \"g\", skip_columns = 5",
        "layout = \"a,b\", component = \"b\", unit = \"g\", skip_columns = 5, gravity = 9.7",
        "layout = \"a,b\", component = \"a\", second_component = \"b\", rotate = 30, unit = \"m/s2\", skip_columns = 5",
        "layout = \"a,b\", component = \"a\", unit = \"m/s2\", skip_columns = 5, offset = \"remove\"",
        "layout = \"a,b\", component = \"a\", unit = \"m/s2\", skip_columns = 5, skip_lines = 7, prepend_zero = true",
        "layout = \"a,b\", component = \"a\", unit = \"m/s2\", skip_columns = 5, process = [{ sign = \"reversed\" }]",
    ] {
        let text = format!("[[variable]]\nrecords = [{{ {base}, {keys} }}]\n");
        let study = study(folder.path(), "", &text).unwrap();
        let (found, reader) = rows(&study, folder.path(), false);
        let found = column(&found, &reader, "peak_displacement");
        drop(reader);
        let case = std::fs::read_to_string(folder.path().join("case.toml")).unwrap();
        let own = format!("\"{}/el_centro_1940_ns.csv\"", motions());
        let line = format!("file = {own}");
        assert!(case.contains(&line), "{case}");
        let named = format!("{base}, {keys}").replace(", process", "\nprocess");
        let entries = in_lines(&named);
        let case = case.replace(&line, &entries);
        assert_eq!(found[0], alone(&case, folder.path()), "{keys}");
    }
    let refused = study(
        folder.path(),
        "",
        "[[variable]]\nrecords = [{ file = \"plain.txt\", scale = 2 }]\n",
    );
    assert!(
        refused
            .unwrap_err()
            .to_string()
            .contains("unknown key `scale`")
    );
}

/// Entries of an inline table, a line each; commas inside quotes stay.
fn in_lines(entries: &str) -> String {
    let mut quoted = false;
    entries
        .chars()
        .map(|c| {
            quoted ^= c == '"';
            if c == ',' && !quoted { '\n' } else { c }
        })
        .collect()
}

/// The case that is shown of a run with an intensity has the factor as its scale, and gives
/// the numbers of the run to the last bit without a recorder.
#[test]
fn a_shown_case_has_its_factor() {
    let folder = tempfile::tempdir().unwrap();
    for motion in ["", "scale = { pga = \"0.3 g\" }", "scale = 2"] {
        let study = study(
            folder.path(),
            motion,
            "[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\", \"MOTIONS/kobe_1995_jma_ns.csv\"]\n[[variable]]\nintensity = \"spectral_acceleration\"\nvalues = [\"0.3 g\", \"0.7 g\"]\n",
        )
        .unwrap();
        let (found, reader) = rows(&study, folder.path(), false);
        let found = column(&found, &reader, "peak_displacement");
        for (run, found) in found.iter().enumerate() {
            let text = case_of_run(&study, run).unwrap();
            assert_eq!(*found, alone(&text, folder.path()), "{text}");
        }
    }
    // A table with a header of its own cannot be replaced in place: it is refused.
    let study = study(
        folder.path(),
        "",
        "[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [1]\n",
    )
    .unwrap();
    let case = folder.path().join("case.toml");
    let text = std::fs::read_to_string(&case).unwrap() + "\n[ground_motion.scale]\npga = 3\n";
    std::fs::write(&case, text).unwrap();
    let source = study.source.clone();
    let study = Study::parse(&source, &folder.path().join("study.toml")).unwrap();
    let refused = case_of_run(&study, 0);
    assert!(
        matches!(refused, Err(StudyError::NotShown { run: 0, .. })),
        "{refused:?}"
    );
}

/// Files of a record's steps are relative to the folder of the study, wherever its case lies.
#[test]
fn targets_of_records_are_relative_to_the_study() {
    let folder = tempfile::tempdir().unwrap();
    let studies = folder.path().join("studies");
    std::fs::create_dir(&studies).unwrap();
    std::fs::write(studies.join("t.csv"), "period_s,psa_g\n0.1,1\n4,0.1\n").unwrap();
    let step =
        "{ remove_offset = \"mean\" }, { scale = { target = \"t.csv\", from = 0.2, to = 1 } }";
    let record = format!(
        "[[variable]]\nrecords = [{{ file = \"MOTIONS/el_centro_1940_ns.csv\", process = [{step}] }}]\n"
    );
    study(folder.path(), "", &record).unwrap();
    let text = format!(
        "case = \"../case.toml\"\n{}",
        record.replace("MOTIONS", &motions())
    );
    let study = Study::parse(&text, &studies.join("study.toml")).unwrap();
    assert!(study.missing_records().is_none());
    let target = studies.join("t.csv");
    assert!(
        study.files().contains(&("target spectrum", target)),
        "{:?}",
        study.files()
    );
    let (found, _reader) = rows(&study, folder.path(), false);
    assert!(found.iter().all(|row| !row.ending.failed()), "{found:?}");
}

/// Runs of a record that cannot be read are still different runs.
#[test]
fn failed_runs_have_their_own_identities() {
    let folder = tempfile::tempdir().unwrap();
    let study = study(
        folder.path(),
        "",
        "[[variable]]\nrecords = [\"nowhere.csv\", \"neither.csv\", \"MOTIONS/el_centro_1940_ns.csv\"]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [1, 2, 3]\n",
    )
    .unwrap();
    let (found, _reader) = rows(&study, folder.path(), true);
    assert_eq!(found.iter().filter(|r| r.ending.failed()).count(), 6);
    let mut ids: Vec<_> = found.iter().map(|r| r.id).collect();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), 9);
}

/// The pair that turns in plan, with a short record across the row in a case of its own; `across`
/// stands at the end of the file.
fn study_that_turns(folder: &Path, across: &str, text: &str) -> Result<Study, StudyError> {
    let case = std::fs::read_to_string(root().join("examples/pair_that_turns/case.toml")).unwrap();
    let case: String = case
        .replace("../../ground_motions", &motions())
        .replace("20 s", "5 s")
        .lines()
        .filter(|line| !line.starts_with("across"))
        .fold(String::new(), |text, line| text + line + "\n");
    let across = across.replace("MOTIONS", &motions());
    let case = case.replace("[analysis]", &format!("{across}\n[analysis]"));
    std::fs::write(folder.join("case.toml"), case).unwrap();
    let text = format!(
        "case = \"case.toml\"\n{}",
        text.replace("MOTIONS", &motions())
    );
    std::fs::create_dir_all(folder.join("studies")).unwrap();
    let text = text.replace("case.toml", "../case.toml");
    Study::parse(&text, &folder.join("studies/study.toml"))
}

/// What floors do across the row in a case alone.
fn across_alone(text: &str, folder: &Path) -> Vec<f64> {
    let case = Case::parse(text, &folder.join("case.toml")).unwrap();
    let assembly = assemble(&case).unwrap();
    let outcome = run(&assembly.system, &assembly.options, &mut [], &mut |_| {}).unwrap();
    let responses = outcome.buildings.iter().flat_map(|b| &b.responses);
    let across = responses.filter(|r| r.name.starts_with("displacement_across"));
    across.map(|r| r.peak.value).collect()
}

/// The record across the row of the case stays beside every record along it that brings none of
/// its own, which is said; the cases of the runs, shown, give the numbers of the runs.
#[test]
fn records_keep_the_record_across_the_row() {
    let record = "file = \"MOTIONS/kobe_1995_jma_ns.csv\"";
    let headed = format!("[ground_motion.across]\n{record}\nscale = {{ pga = \"0.2 g\" }}\n");
    let inline = format!("across = {{ {record}, scale = {{ pga = \"0.2 g\" }} }}\n");
    let plain = "[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\", { name = \"fault\", file = \"MOTIONS/kobe_1995_jma_ns.csv\" }]\n";
    let intensity =
        "[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.2 g\", \"0.4 g\"]\n";
    let made = "[[variable]]\nsynthetic = { model = \"rezaeian_der_kiureghian_2010\", count = 1, duration = \"6 s\", significant_duration = \"3 s\", middle_time = \"2 s\", middle_frequency = \"4 Hz\" }\n";
    let said = "all 2 records along the row with the record across it of the case";
    for (across, text, warned) in [
        (&inline, plain.to_owned(), said),
        (&headed, plain.to_owned(), said),
        (&inline, format!("{plain}{intensity}[ida]\n"), said),
        (&inline, made.to_owned(), "record seed_1 along the row"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let study = study_that_turns(folder.path(), across, &text).unwrap();
        let (found, reader) = rows(&study, folder.path(), false);
        let warnings = &reader.description.warnings;
        let told = warnings.iter().any(|w| w.starts_with(warned));
        assert!(told, "{text}: {warnings:?}");
        let found = column(&found, &reader, "peak_displacement_across");
        for (number, values) in found.iter().enumerate() {
            let shown = case_of_run(&study, number).unwrap();
            assert!(shown.contains("kobe_1995"), "{shown}");
            if text.contains("synthetic") {
                assert!(values.iter().all(|x| *x > 1e-3), "{values:?}");
                continue;
            }
            let alone = across_alone(&shown, folder.path());
            assert_eq!(alone.len(), 4);
            for (a, b) in values.iter().zip(&alone) {
                assert!((a / b - 1.0).abs() < 1e-12 && *b > 1e-3, "{shown}: {a} {b}");
            }
        }
    }
}

/// A record brings its own across the row, whose file is relative to the study, and no other
/// record takes it.
#[test]
fn records_bring_their_own_across_the_row() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir_all(folder.path().join("studies")).unwrap();
    for (name, to) in [
        ("el_centro_1940_ns.csv", "own.csv"),
        ("kobe_1995_jma_ns.csv", "other.csv"),
    ] {
        let to = folder.path().join("studies").join(to);
        std::fs::copy(Path::new(&motions()).join(name), to).unwrap();
    }
    let text = "[[variable]]\nrecords = [{ name = \"a\", file = \"own.csv\", across = \"own.csv\" }, { name = \"b\", file = \"own.csv\", across = { scale = 2, file = \"other.csv\" } }, { name = \"c\", file = \"own.csv\" }]\n";
    let across = "across = \"MOTIONS/kobe_1995_jma_ns.csv\"\n";
    let study = study_that_turns(folder.path(), across, text).unwrap();
    let (found, reader) = rows(&study, folder.path(), false);
    let warnings = reader.description.warnings.join("\n");
    assert!(warnings.contains("record c along the row"), "{warnings}");
    let found = column(&found, &reader, "peak_displacement_across");
    for (number, values) in found.iter().enumerate() {
        let shown = case_of_run(&study, number).unwrap();
        assert_eq!(*values, across_alone(&shown, folder.path()), "{shown}");
    }
    for (kobe, doubled) in found[2].iter().zip(&found[1]) {
        assert!((doubled / kobe - 2.0).abs() < 0.3, "{doubled} {kobe}");
    }
    let differs = found[0].iter().zip(&found[2]);
    assert!(
        differs.clone().all(|(a, c)| (a / c - 1.0).abs() > 1e-3),
        "{found:?}"
    );
}

/// A second record that is given by its file alone gets room for its factor.
#[test]
fn a_file_across_the_row_is_shown_with_its_factor() {
    let folder = tempfile::tempdir().unwrap();
    let intensity =
        "[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.1 g\", \"0.3 g\"]\n";
    let across = "across = \"MOTIONS/kobe_1995_jma_ns.csv\"\n";
    let study = study_that_turns(folder.path(), across, intensity).unwrap();
    let (found, reader) = rows(&study, folder.path(), false);
    let found = column(&found, &reader, "peak_displacement_across");
    for (number, values) in found.iter().enumerate() {
        let shown = case_of_run(&study, number).unwrap();
        assert!(
            shown.contains("kobe_1995_jma_ns.csv\", scale = "),
            "{shown}"
        );
        for (a, b) in values.iter().zip(&across_alone(&shown, folder.path())) {
            assert!((a / b - 1.0).abs() < 1e-12 && *b > 1e-3, "{shown}: {a} {b}");
        }
    }
}

/// At an intensity a record across the row that comes with one along it keeps its proportion to that
/// one; that of the case to the record of the case.
#[test]
fn records_across_the_row_keep_their_proportions() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir_all(folder.path().join("studies")).unwrap();
    let record = std::fs::read_to_string(Path::new(&motions()).join("el_centro_1940_ns.csv"));
    let record = record.unwrap();
    std::fs::write(folder.path().join("studies/own.csv"), &record).unwrap();
    let halved: String = record
        .lines()
        .map(|line| match line.split_once(',') {
            Some((time, a)) if a.parse::<f64>().is_ok() => {
                format!("{time},{:?}\n", 0.5 * a.parse::<f64>().unwrap())
            }
            _ => format!("{line}\n"),
        })
        .collect();
    std::fs::write(folder.path().join("studies/half.csv"), halved).unwrap();
    let text = "[[variable]]\nrecords = [{ name = \"a\", file = \"own.csv\", across = { file = \"own.csv\" } }, { name = \"b\", file = \"half.csv\", across = { file = \"own.csv\" } }, { name = \"c\", file = \"half.csv\" }]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.1 g\", \"0.3 g\"]\n";
    let across = "across = { file = \"MOTIONS/kobe_1995_jma_ns.csv\", scale = 0.5 }\n";
    let study = study_that_turns(folder.path(), across, text).unwrap();
    let (found, reader) = rows(&study, folder.path(), false);
    let found = column(&found, &reader, "peak_displacement_across");
    let factor = |motion: &GroundMotion| match motion.scale.as_ref().map(|s| &s.value) {
        Some(Scale::Factor(factor)) => *factor,
        other => panic!("{other:?}"),
    };
    let scales: Vec<[f64; 2]> = (0..6)
        .map(|number| {
            let shown = case_of_run(&study, number).unwrap();
            let alone = across_alone(&shown, folder.path());
            for (a, b) in found[number].iter().zip(&alone) {
                assert!((a / b - 1.0).abs() < 1e-9, "{shown}: {a} {b}");
            }
            let case = Case::parse(&shown, &folder.path().join("case.toml")).unwrap();
            let across = &case.ground_motion.across.as_ref().unwrap().value;
            [factor(&case.ground_motion), factor(across)]
        })
        .collect();
    let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}: {scales:?}");
    for [along, across] in &scales[..4] {
        near(across / along, scales[0][1] / scales[0][0]);
    }
    near(scales[2][0] / scales[0][0], 2.0);
    near(scales[5][1] / scales[4][1], 3.0);
    // The case's own record is as strong as that of `a`: half of what `c` would have by its own.
    near(
        scales[4][1] / scales[4][0],
        0.25 * scales[0][1] / scales[0][0],
    );
}

/// What each run of a study of the pair gives beside what the shown case of that run gives alone:
/// displacements, and the demand without gaps where the study asks for it.
fn assert_each_as_shown(study: &Study, folder: &Path) -> Vec<Vec<f64>> {
    let (found, reader) = rows(study, folder, false);
    let displacements = column(&found, &reader, "peak_displacement");
    let demands = study
        .isolated_demand
        .then(|| column(&found, &reader, "isolated_demand"));
    for (row, displacements) in found.iter().zip(&displacements) {
        let shown = case_of_run(study, row.run).unwrap();
        assert_eq!(*displacements, alone(&shown, folder), "{shown}");
        if let Some(demands) = &demands {
            let case = Case::parse(&shown, &folder.join("case.toml")).unwrap();
            let assembly = assemble(&case).unwrap();
            let (_, peaks) = isolated_demand(&assembly.system, &assembly.options).unwrap();
            let peaks: Vec<f64> = peaks.iter().map(|peak| peak.value).collect();
            assert_eq!(demands[row.run], peaks, "{shown}");
        }
    }
    let mut ids: Vec<_> = found.iter().map(|row| row.id).collect();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), found.len());
    displacements
}

/// Columns of numbers that are read in many ways.
fn columns(folder: &Path) {
    let columns: String = (0..400)
        .map(|i| {
            let t = 0.01 * f64::from(i);
            let (a, b) = ((9.0 * t).sin(), 0.5 * (5.0 * t).cos());
            format!("{a:9.6} {b:9.6}\n")
        })
        .collect();
    std::fs::write(folder.join("columns.txt"), columns).unwrap();
}

/// A study of the pair whose case has this under `[ground_motion]` and nothing else.
fn study_of(folder: &Path, motion: &str, text: &str) -> Result<Study, StudyError> {
    let file = format!("file = \"{}/el_centro_1940_ns.csv\"", motions());
    let case = root().join("examples/sweep_three_storey_pair/case.toml");
    let case = std::fs::read_to_string(case).unwrap();
    let case = case
        .replace("../../ground_motions", &motions())
        .replace("31 s", "6 s");
    let motion = motion.replace("EL_CENTRO", &file);
    std::fs::write(folder.join("case.toml"), case.replace(&file, &motion)).unwrap();
    let text = text.replace("MOTIONS", &motions());
    let text = format!("case = \"case.toml\"\n{text}");
    Study::parse(&text, &folder.join("study.toml"))
}

/// A record with much to say of how it is read.
const COLUMNS: &str = "file = \"columns.txt\"\nlayout = \"a,b\"\ncomponent = \"a\"\nsecond_component = \"b\"\nrotate = 30\nunit = \"m/s2\"\ntime_step = 0.01";

/// Variables that say how the record of the case is read have it read so in each run, whatever
/// else varies: each run is, to the last bit, that of the case that is shown for it.
#[test]
fn variables_say_how_the_record_is_read() {
    let folder = tempfile::tempdir().unwrap();
    columns(folder.path());
    let kobe = root().join("ground_motions/kobe_1995_jma_ns.csv");
    std::fs::copy(kobe, folder.path().join("k.csv")).unwrap();
    let filtered = "EL_CENTRO\nprocess = [{ filter = { high_pass = \"0.5 Hz\" } }]";
    let gap = "[[variable]]\nname = \"gap\"\npath = \"gap.0.width\"\nvalues = [0.01, 0.05]\n";
    let intensity = "[[variable]]\nintensity = \"spectral_acceleration\"\nbuilding = \"light\"\nvalues = [\"0.3 g\", \"0.5 g\"]\n[output]\nisolated_demand = true\n";
    for (motion, path, values, distinct) in [
        (
            "EL_CENTRO",
            "file",
            "values = [\"k.csv\", \"MOTIONS/el_centro_1940_ns.csv\"]",
            2,
        ),
        (COLUMNS, "unit", "values = [\"g\", \"m/s2\"]", 2),
        (
            COLUMNS,
            "time_step",
            "from = 0.01\nto = \"20 ms\"\ncount = 3",
            3,
        ),
        (COLUMNS, "rotate", "values = [0, 45, 90]", 3),
        (
            filtered,
            "process.0.filter.high_pass",
            "values = [\"0.2 Hz\", 1]",
            2,
        ),
    ] {
        for more in [gap, intensity] {
            let text = format!("[[variable]]\npath = \"ground_motion.{path}\"\n{values}\n{more}");
            let study = study_of(folder.path(), motion, &text).unwrap();
            let found = assert_each_as_shown(&study, folder.path());
            assert_eq!(found.len(), 2 * distinct);
            let of_readings: Vec<_> = found.chunks(2).collect();
            for pair in of_readings.windows(2) {
                let scaled_alike = more == intensity && path == "unit";
                assert!(scaled_alike || pair[0] != pair[1], "{path}");
            }
        }
    }
}

/// The same of samples, in which each run reads the record in its own way, and of values that are
/// given to one another by a list.
#[test]
fn designs_may_say_how_the_record_is_read() {
    let folder = tempfile::tempdir().unwrap();
    columns(folder.path());
    let variables = "[[variable]]\nname = \"unit\"\npath = \"ground_motion.unit\"\nvalues = [\"g\", \"m/s2\", \"cm/s2\"]\n[[variable]]\nname = \"angle\"\npath = \"ground_motion.rotate\"\n";
    for (angles, design) in [
        (
            "from = 0\nto = 90\n",
            "[design]\nkind = \"latin_hypercube\"\nruns = 5\n",
        ),
        (
            "values = [0, 90]\n",
            "[design]\nkind = \"sobol\"\nruns = 16\n",
        ),
        ("values = [0, 90, 45]\n", "[design]\nkind = \"list\"\n"),
    ] {
        let text = format!("{variables}{angles}{design}");
        let study = study_of(folder.path(), COLUMNS, &text).unwrap();
        let (found, reader) = rows(&study, folder.path(), false);
        let found = column(&found, &reader, "peak_displacement");
        for (run, found) in found.iter().enumerate() {
            let shown = case_of_run(&study, run).unwrap();
            assert_eq!(*found, alone(&shown, folder.path()), "{shown}");
        }
    }
    let text = format!("{variables}from = 0\nto = 90\n[design]\nkind = \"sobol\"\nruns = 16384\n");
    let refused = study_of(folder.path(), COLUMNS, &text).unwrap_err();
    let said = refused.to_string();
    assert!(
        said.contains("study.toml:2") && said.contains("more than 10000 ways"),
        "{said}"
    );
}

/// Values that make no reading together are runs that fail, where others are to go on.
#[test]
fn readings_that_cannot_be_are_told_before_the_runs() {
    let folder = tempfile::tempdir().unwrap();
    let band =
        "EL_CENTRO\nprocess = [{ filter = { high_pass = \"0.5 Hz\", low_pass = \"20 Hz\" } }]";
    let text = "[[variable]]\nname = \"low\"\npath = \"ground_motion.process.0.filter.high_pass\"\nvalues = [0.5, 5]\n[[variable]]\nname = \"high\"\npath = \"ground_motion.process.0.filter.low_pass\"\nvalues = [2, 20]\n";
    let study = study_of(folder.path(), band, text).unwrap();
    let (found, reader) = rows(&study, folder.path(), true);
    let failed: Vec<bool> = found.iter().map(|row| row.ending.failed()).collect();
    assert_eq!(failed, [false, false, true, false]);
    let records = &reader.description.records;
    assert!(
        records.contains("el_centro_1940_ns (low = 5, high = 20)"),
        "{records}"
    );
    assert_eq!(records.matches("unreadable").count(), 1, "{records}");
    // A file whose content changes makes another study, whichever value names it.
    let file = folder.path().join("k.csv");
    let kobe = std::fs::read(root().join("ground_motions/kobe_1995_jma_ns.csv")).unwrap();
    let identity = |bytes: &[u8]| {
        std::fs::write(&file, bytes).unwrap();
        let text = "[[variable]]\npath = \"ground_motion.file\"\nvalues = [\"MOTIONS/el_centro_1940_ns.csv\", \"k.csv\"]\n";
        let study = study_of(folder.path(), "EL_CENTRO", text).unwrap();
        assert!(study.files().iter().any(|(_, path)| *path == file));
        let (_, reader) = rows(&study, folder.path(), false);
        reader.description.study_sha256
    };
    // Whole lines: a value that is cut off is refused.
    let half = kobe[..kobe.len() / 2].iter().rposition(|b| *b == b'\n');
    assert_ne!(identity(&kobe), identity(&kobe[..=half.unwrap()]));
}

/// All other files of a case vary as the record does: forces, matrices, target spectra, records
/// across the row and of buildings, alone and beside an intensity.
#[test]
fn files_of_the_case_vary() {
    let ground = "ground = { file = \"MOTIONS/el_centro_1940_ns.csv\", scale = 2 }\n";
    let spectrum = "scale = { target = \"t.csv\", from = 0.2, to = 1 }\n";
    let sheared = ("mass = ", format!("{ground}mass = "));
    let scaled = ("[analysis]", format!("{spectrum}[analysis]"));
    let nothing = ("", String::new());
    let both = "values = [\"MOTIONS/el_centro_1940_ns.csv\", \"MOTIONS/kobe_1995_jma_ns.csv\"]";
    let names = |a: &str, b: &str| format!("values = [\"{a}\", \"{b}\"]");
    for (example, (from, to), path, values) in [
        (
            "blast_beside_a_tower",
            &nothing,
            "building.low.force.1.file",
            names("blast.csv", "b.csv"),
        ),
        (
            "blast_beside_a_tower",
            &nothing,
            "building.low.force.1.column",
            "values = [2, 4]".to_owned(),
        ),
        (
            "wall_and_frame",
            &nothing,
            "building.frame.stiffness_matrix.file",
            names("frame.csv", "f.csv"),
        ),
        (
            "wall_and_frame",
            &nothing,
            "building.frame.stiffness_matrix.unit",
            names("kN/mm", "MN/mm"),
        ),
        (
            "wall_and_frame",
            &scaled,
            "ground_motion.scale.target",
            names("t.csv", "t2.csv"),
        ),
        (
            "wall_and_frame",
            &sheared,
            "building.frame.ground.file",
            both.to_owned(),
        ),
        (
            "wall_and_frame",
            &sheared,
            "building.frame.ground.scale",
            "values = [1, 3]".to_owned(),
        ),
        (
            "three_frame_bridge",
            &nothing,
            "building.east.ground.distance",
            "values = [10, 200]".to_owned(),
        ),
        (
            "pair_that_turns",
            &nothing,
            "ground_motion.across.file",
            both.to_owned(),
        ),
        (
            "pair_that_turns",
            &nothing,
            "ground_motion.across.scale.pga",
            "values = [1, 3]".to_owned(),
        ),
    ] {
        let folder = tempfile::tempdir().unwrap();
        for entry in std::fs::read_dir(root().join("examples").join(example)).unwrap() {
            let path = entry.unwrap().path();
            std::fs::copy(&path, folder.path().join(path.file_name().unwrap())).unwrap();
        }
        let write =
            |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
        write("b.csv", "time (s),a,b,c\n0,0,0,0\n1,0,400,0\n2,0,900,0\n");
        write("f.csv", "90,-50,10\n-50,70,-30\n10,-30,25\n");
        write("t.csv", "period_s,psa_g\n0.1,1\n4,0.1\n");
        write("t2.csv", "period_s,psa_g\n0.1,0.5\n4,0.2\n");
        let case = std::fs::read_to_string(folder.path().join("case.toml")).unwrap();
        let case = case.lines().map(|line| match line.starts_with("duration") {
            true => "duration = 4\n".to_owned(),
            false => format!("{line}\n"),
        });
        let mut case = case
            .collect::<String>()
            .replace("../../ground_motions", &motions());
        if !from.is_empty() {
            let at = case.rfind(from).unwrap();
            case.replace_range(at..at + from.len(), &to.replace("MOTIONS", &motions()));
        }
        write("case.toml", &case);
        for intensity in [false, true] {
            // Which sets the scale of the case itself, and has no use where the ground is at rest.
            if intensity && (path == "ground_motion.scale.target" || example.starts_with("blast")) {
                continue;
            }
            let more = "[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [2, 4]\n";
            let text = format!(
                "case = \"case.toml\"\n[[variable]]\nname = \"varied\"\npath = \"{path}\"\n{}\n{}",
                values.replace("MOTIONS", &motions()),
                if intensity { more } else { "" }
            );
            let study = Study::parse(&text, &folder.path().join("study.toml")).unwrap();
            let (found, reader) = rows(&study, folder.path(), false);
            let displacements = column(&found, &reader, "peak_displacement");
            let across = reader.description.layout.range("peak_displacement_across");
            for (row, displacements) in found.iter().zip(&displacements) {
                let shown = case_of_run(&study, row.run).unwrap();
                let said = format!("{path}: {:?}\n{shown}", row.ending);
                let mut found = displacements.clone();
                let mut expected = alone(&shown, folder.path());
                if example == "pair_that_turns" {
                    found.extend(&row.values[across.clone()]);
                    expected.extend(across_alone(&shown, folder.path()));
                }
                assert_eq!(found.len(), expected.len(), "{said}");
                for (a, b) in found.iter().zip(&expected) {
                    // Factors of further records are products in the shown case.
                    let near = (a / b - 1.0).abs() < 1e-12;
                    assert!(a == b || (intensity && near), "{a} {b}: {said}");
                }
            }
            let (first, last) = (&found[0].values, &found[found.len() - 1].values);
            assert_ne!(first, last, "{path}");
            assert_ne!(first, &found[found.len() / 2].values, "{path}");
        }
    }
}
