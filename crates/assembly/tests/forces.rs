//! Files of forces: what is refused where. What they do is held against closed forms in
//! `tests/tests/structures/forces.rs`.
use pounding_assembly::{Assembly, AssemblyError, assemble};
use pounding_case::Case;

fn assembled(force: &str, csv: &str) -> Result<Assembly, AssemblyError> {
    assembled_with_text(force, csv).0
}

fn assembled_with_text(force: &str, csv: &str) -> (Result<Assembly, AssemblyError>, String) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("f.csv"), csv).unwrap();
    let record = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../ground_motions/el_centro_1940_ns.csv"
    );
    let text = format!(
        "[[building]]\nname = \"a\"\nstoreys = 2\nmass = \"40 t\"\nheight = 3\nstiffness = 1e8\ndamping = {{ modal = 0.05 }}\n[[building.force]]\nstorey = 1\n{force}\n[ground_motion]\nfile = \"{record}\"\n"
    );
    let case = Case::parse(&text, &folder.path().join("case.toml")).unwrap();
    (assemble(&case), text)
}

fn refused(force: &str, csv: &str) -> (String, String, String) {
    let (assembled, text) = assembled_with_text(force, csv);
    match assembled {
        Err(AssemblyError::Case(e)) => {
            let place = text[e.span.clone()].to_owned();
            (e.message.clone(), e.help.clone().unwrap_or_default(), place)
        }
        other => panic!("{force} {csv:?}: {:?}", other.err()),
    }
}

#[test]
fn forces_that_cannot_be_read_are_refused_at_their_place() {
    let file = "file = \"f.csv\"";
    for (force, csv, says, remedy) in [
        (file, "", "it holds no numbers", "one line per point"),
        (
            file,
            "t,F\n0,1\nx,2\n",
            "line 3, column 1: \"x\" is no number",
            "the time (s) first",
        ),
        (
            file,
            "0,1\n1\n",
            "line 2 has 1 column where the first row has 2",
            "as many numbers in every row",
        ),
        (
            file,
            "0,1\n2,3\n1,4\n",
            "the time 1 s stands after 2 s",
            "in their order",
        ),
        (file, "0,1\n0,3\n0,4\n", "three points at 0 s", "a jump"),
        (file, "-1,1\n", "a point at -1 s", ""),
        (file, "0,inf\n", "\"inf\" is no number", ""),
        (
            "file = \"g.csv\"",
            "",
            "cannot read the force history",
            "relative to the folder",
        ),
        (
            "file = \".\"",
            "",
            "this is a folder",
            "relative to the folder",
        ),
        (
            file,
            "time_s,force_kg\n0,1\n1,0\n",
            "the column \"force_kg\" is in \"kg\", which is a mass",
            "column (N)",
        ),
        (
            file,
            "t,force_kilonewton\n0,1\n1,0\n",
            "\"kilonewton\" in the column \"force_kilonewton\" is no unit of a force",
            "column (N)",
        ),
        (
            file,
            "t,force_tonf\n0,1\n1,0\n",
            "\"tonf\" in the column",
            "in brackets",
        ),
        (
            file,
            "t,F/tonf\n0,1\n1,0\n",
            "\"tonf\" in the column",
            "in brackets",
        ),
        (
            file,
            "t,force_klbf\n0,1\n1,0\n",
            "\"klbf\" in the column",
            "in brackets",
        ),
        (
            file,
            "t,force_tons\n0,1\n1,0\n",
            "\"tons\" in the column",
            "in brackets",
        ),
        (
            file,
            "t,force_1000N\n0,1\n1,0\n",
            "\"1000N\" in the column",
            "in brackets",
        ),
        (
            file,
            "t,F/furlong\n0,1\n1,0\n",
            "\"furlong\" in the column",
            "in brackets",
        ),
        (
            file,
            "time_mins,force_N\n0,1\n1,0\n",
            "\"mins\" in the column",
            "in brackets",
        ),
        (
            file,
            "time/days,F/N\n0,1\n1,0\n",
            "\"days\" in the column",
            "in brackets",
        ),
        (
            file,
            "t,force_kN_total\n0,1\n1,0\n",
            "\"kN\" in the column \"force_kN_total\"",
            "column (N)",
        ),
        (
            file,
            "t,force KN\n0,1\n1,0\n",
            "\"KN\" in the column \"force KN\"",
            "column (N)",
        ),
        (
            file,
            "time (sek),force_N\n0,1\n1,0\n",
            "\"sek\" in the column \"time (sek)\" is no unit of a time",
            "column (s)",
        ),
        (
            file,
            "time_s,force_kn\n0,1\n1,0\n",
            "\"kn\" in the column \"force_kn\"",
            "column (N)",
        ),
        (
            "file = \"f.csv\"\nunit = \"N\"",
            "time_s,force_kN\n0,1\n1,0\n",
            "another one than `unit`",
            "leave `unit` out",
        ),
        (
            "file = \"f.csv\"\ntime_step = \"0.1 s\"",
            "0,0\n0.1,1000\n0.2,0\n",
            "it has 2 columns, and `time_step` is for forces without times",
            "`column`",
        ),
        (
            "file = \"f.csv\"\ntime_step = \"0.1 s\"",
            "5O00\n0\n",
            "\"5O00\" is no number",
            "",
        ),
        (file, "0 s,5000 N\n1,0\n", "\"0 s\" is no number", ""),
        (file, "0,5\n", "points at a single time", "`stays = true`"),
        (
            file,
            "time (s),force (kN)\n0,0\n0.02,1,200\n0.1,0\n",
            "line 3 has 3 columns where the names above are 2",
            "no comma stands in a number",
        ),
        (
            file,
            "\"time (s)\",\"force (kN)\"\n\"1\",0,0\n\"2\",0.02,1200\n",
            "line 2 has 3 columns where the names above are 2",
            "as many numbers",
        ),
        (
            file,
            "time (s),force (kN)\r\n0,0,0,0\r\n1,0,900,5\r\n",
            "line 2 has 4 columns",
            "as many numbers",
        ),
        (
            file,
            "0,1\n20,900,5\n",
            "line 2 has 3 columns where the first row has 2",
            "no comma",
        ),
        (
            file,
            "time (s);force (kN)\n0,0\n0.5,10\n1,0\n",
            "line 2 has 2 columns where the names above are 1",
            "as many numbers",
        ),
        (
            file,
            "t (s),F (kN)\r0,0\r0.5,10\r1,0\r# second pulse\r1.1,0\r1.2,9x0\r",
            "line 7, column 2: \"9x0\" is no number",
            "",
        ),
        (
            "file = \"f.csv\"\ntime_step = \"0.1 s\"\ncolumn = 2",
            "100,0\n,\n100,9\n",
            "line 2, column 1: \"\" is no number",
            "",
        ),
        (
            file,
            "time (s);force (kN)\n0;0\n0,5;10\n",
            "line 3, column 1: \"0,5\" is no number",
            "write decimal points",
        ),
        (
            file,
            "t\tF (kN)\n0,0\t0,0\n0,5\t10,0\n",
            "line 2, column 1: \"0,0\" is no number",
            "write decimal points",
        ),
        (
            file,
            "t,F (N)\n0,0\n0.5,\"10,000\"\n",
            "\"10,000\" is no number",
            "no separators of thousands",
        ),
        (
            file,
            "time (ms)\n0,0\n0.5,10\n",
            "line 2 has 2 columns where the names above are 1",
            "",
        ),
        (
            file,
            "time, s, force, kN\n0,0\n0.5,10\n",
            "line 2 has 2 columns where the names above are 4",
            "",
        ),
        (
            file,
            "time (s),force x 1000 (N)\n0,0\n0.5,10\n",
            "has a factor, 1000,",
            "`scale`",
        ),
        (
            file,
            "time (s),F*1e3 (N)\n0,0\n0.5,10\n",
            "has a factor, 1e3,",
            "`scale`",
        ),
        (
            file,
            "time (s),F 10^3 (N)\n0,0\n0.5,10\n",
            "has a factor, 1e3,",
            "`scale`",
        ),
        (
            file,
            "time (s),force (kN)\r\n0,0\r\n\r\n0.5,10\r\n1,zzz\r\n",
            "line 5, column 2: \"zzz\" is no number",
            "",
        ),
        (
            file,
            "t\0i\0m\0e\0,\0F\0\n\0",
            "the text is UTF-16",
            "save it as UTF-8",
        ),
        (
            "file = \"f.csv\"\ncolumn = 4",
            "0,1\n",
            "has 2 columns, and the force is in column 4",
            "`column`",
        ),
    ] {
        let (message, help, place) = refused(force, csv);
        assert!(message.contains(says), "{csv}: {message}");
        assert!(help.contains(remedy), "{csv}: {help}");
        assert!(force.contains(&place), "{place}");
    }
    let points = "points = [[2, 1], [1, 1]]";
    let (message, _, place) = refused(points, "");
    assert!(
        message.contains("the time 1 s stands after 2 s"),
        "{message}"
    );
    assert_eq!(place, "[[2, 1], [1, 1]]");
}

/// Units stand in the names of the columns, or in the case, or are those of the SI.
/// Columns between commas, semicolons or tabs, with any ends of lines and beside columns that no force is in.
#[test]
fn files_are_read_however_their_lines_are_written() {
    for csv in [
        "time (s),force (kN)\n0,0\n0.5,10\n1,0\n",
        "time (s);force (kN)\n0;0\n0.5;10\n1;0\n",
        "# made by hand, by me; twice\n\ntime (s)\tforce (kN)\n0\t0\n0.5\t10\n1\t0\n",
        "time (s),force (kN)\r\n0,0\r\n\r\n0.5,10\r\n1,0\r\n",
        "time (s),force (kN)\r0,0\r0.5,10\r1,0\r",
        "\u{feff}time (s),force (kN)\n0,0\n0.5,10\n1,0\n",
        "time (s),Fx (kN),F2 (kN)\n0,0,5\n0.5,10,6\n1,0,7\n",
        "\u{feff}# made by hand; twice\ntime (s),force (kN),\n0,0\n0.5,10\n1,0\n",
        "# c\rtime (s),force (kN)\r# d\r0,0\r0.5,10\r1,0\n",
        "time (s),\tF roof; level 3 (kN)\n0,\t0\n0.5,\t10\n1,\t0\n",
        "\"t; of run (s)\",\"F; roof (kN)\"\n0,0\n0.5,10\n1,0\n",
    ] {
        let assembly = assembled("file = \"f.csv\"", csv).unwrap();
        let points = assembly.system.forces()[0].history.points().to_vec();
        assert_eq!(points, [(0.0, 0.0), (0.5, 1e4), (1.0, 0.0)], "{csv}");
    }
}

/// Names with what is a factor, and with what is none.
#[test]
fn factors_are_told_from_directions_and_places() {
    let read = |name: &str| {
        let csv = format!("time (s),\"{name}\"\n0,0\n0.5,10\n1,0\n");
        assembled("file = \"f.csv\"", &csv).map(|_| ())
    };
    for name in [
        "F_x 2 (kN)",
        "Wind X 1 (kN)",
        "wind x 2 (kN)",
        "force-x 3 (kN)",
        "F.x 1 (kN)",
        "X1 (kN)",
        "x 1 (kN)",
        "F_X1 (kN)",
        "grid A x 3 (kN)",
        "F* 1 (kN)",
        "X10 (kN)",
        "level 100 (kN)",
        "12 x 12 column (kN)",
        "F/kN",
        "span 1/2 (kN)",
        "F1 (kN)",
        "F x 1 (kN)",
        "E3 (kN)",
        "node 10 x (kN)",
        "node 100 X (kN)",
        "Floor 100 x (kN)",
        "x 0 (kN)",
        "x 100 (kN)",
        "at x 0.5 m (kN)",
        "10 x 10 panel (kN)",
        "pressure on 3 x 100 m (kN)",
        "storey 3/100 (kN)",
        "F/100 years (kN)",
        "case 1e3 (kN)",
        "sometimes 3 (kN)",
    ] {
        assert!(read(name).is_ok(), "{name}");
    }
    for name in [
        "1000*F (N)",
        "10 x F (N)",
        "F (N) *-1",
        "F 10E3 (N)",
        "F (N)/1000",
        "F (N) times 1000",
        "F 10\u{b3} (N)",
        "F \u{d7} 10\u{b3} (N)",
        "F 10**3 (N)",
        "F x1000 (N)",
        "F\u{b7}1000 (N)",
        "F x 1e-3 (N)",
        "F X 1000 (N)",
        "F \u{22c5} 1000 (N)",
        "F 10\u{207b}\u{b3} (N)",
        "F*2 (N)",
    ] {
        let error = read(name).expect_err(name).to_string();
        assert!(error.contains("has a factor"), "{name}: {error}");
    }
    let times = "t (s) at x 2,F (kN)\n0,0\n0.5,10\n1,0\n";
    assert!(assembled("file = \"f.csv\"", times).is_ok());
    // One column has one name.
    let single = "F, roof (kN)\n0\n10\n0\n";
    let force = "file = \"f.csv\"\ntime_step = \"0.1 s\"";
    assert!(assembled(force, single).is_ok());
}

#[test]
fn units_of_columns_are_those_of_their_names() {
    for (unit, csv) in [
        ("", "time_s,force_kN\n0,0\n0.1,2\n0.2,0\n"),
        ("", "time (ms);force (kN)\n0;0\n100;2\n200;0\n"),
        ("unit = \"kN\"", "time_ms,force [kN]\n0,0\n100,2\n200,0\n"),
        ("unit = \"kN\"", "t,F\n0,0\n0.1,2\n0.2,0\n"),
        ("", "time,force_above\n0,0\n0.1,2000\n0.2,0\n"),
        ("", "0,0\n0.1,2000\n0.2,0\n"),
        ("", "t/s,F/kN\n0,0\n0.1,2\n0.2,0\n"),
        ("", "time ms;force kN\n0;0\n100;2\n200;0\n"),
        ("", "ms,kN\n0,0\n100,2\n200,0\n"),
        ("", "time in ms,force - kN\n0,0\n100,2\n200,0\n"),
        ("", "time seconds,\"force, kN\"\n0,0\n0.1,2\n0.2,0\n"),
        ("", "t,force {kN}\n0,0\n0.1,2\n0.2,0\n"),
        ("", "time [s],wind above 10 m\n0,0\n0.1,2000\n0.2,0\n"),
    ] {
        let csv = csv.replace(';', ",");
        let force = format!("file = \"f.csv\"\n{unit}");
        let system = assembled(&force, &csv).unwrap().system;
        let history = &system.forces()[0].history;
        let points = history.points();
        assert_eq!(points.len(), 3, "{csv}");
        let apart = (points[1].0 - 0.1).abs() + (points[1].1 - 2000.0).abs();
        assert!(apart < 1e-12, "{csv}: {points:?}");
    }
}

/// A program may take a building out of a case and leave the gaps that name it.
#[test]
fn gaps_of_buildings_that_are_gone_are_refused() {
    let text = include_str!("../../../examples/three_storey_pair/case.toml");
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../examples/three_storey_pair/case.toml"
    );
    let mut case = Case::parse(text, std::path::Path::new(path)).unwrap();
    case.buildings.pop();
    let said = assemble(&case).unwrap_err().to_string();
    assert!(
        said.contains("joins a building that the case does not have"),
        "{said}"
    );
}
