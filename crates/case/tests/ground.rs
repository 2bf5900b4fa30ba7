//! The ground under single buildings, walls, seats, and plans: what is read, and what is refused
//! where.
use std::path::Path;

use pounding_case::{Case, CaseError, ForceSource};

/// Two buildings, `b` with these lines, and their gap with others.
fn parse(b: &str, gap: &str, motion: &str) -> Result<Case, CaseError> {
    Case::parse(&text(b, gap, motion), Path::new("case.toml"))
}

const PLAN: &str = "plan = { length = \"12 m\", width = \"10 m\", frames_along = [{ at = \"-5 m\", stiffness = [3e7, \"20 MN/m\"] }, { at = 5, stiffness = 1e7 }], frames_across = [{ at = 0, stiffness = 2e7 }] }";

#[test]
fn the_ground_of_a_building_is_read() {
    let ground = |text: &str| {
        let case = parse(text, "", "").unwrap();
        case.buildings[1].ground.clone().unwrap().value
    };
    assert_eq!(ground("ground = { delay = \"130 ms\" }").delay, 0.13);
    let wave = ground("ground = { distance = \"60 m\", wave_speed = \"500 m/s\" }");
    assert_eq!(
        (wave.delay, wave.by_wave_speed, wave.motion),
        (0.12, true, None)
    );
    let own = ground("ground = { file = \"s.csv\", scale = 1.1, component = \"ew\", delay = 2 }");
    let motion = own.motion.unwrap();
    assert_eq!((own.delay, own.by_wave_speed), (2.0, false));
    assert_eq!(motion.file.value, Path::new("s.csv"));
    assert_eq!(motion.component.as_deref(), Some("ew"));
    assert!(motion.scale.is_some());
    let case = parse("ground = { file = \"s.csv\" }", "", "").unwrap();
    let files: Vec<_> = case.files().into_iter().map(|f| f.0).collect();
    assert_eq!(files, ["record", "further record"]);
}

#[test]
fn plans_are_read() {
    let case = parse(
        PLAN,
        "points = [\"-4 m\", 0, 4]",
        "across = { file = \"s.csv\" }",
    )
    .unwrap();
    let plan = case.buildings[1].plan.clone().unwrap().value;
    assert_eq!(
        (plan.length, plan.width, plan.mass_centre),
        (12.0, 10.0, 0.0)
    );
    assert_eq!(plan.along[0].stiffness, [3e7, 2e7]);
    assert_eq!(plan.along[1].stiffness, [1e7, 1e7]);
    assert_eq!(plan.across[0].at, 0.0);
    assert_eq!(case.gaps[0].points.clone().unwrap().value, [-4.0, 0.0, 4.0]);
    let across = case.ground_motion.across.clone().unwrap().value;
    assert_eq!(across.file.value, Path::new("s.csv"));
    let by_name = parse(PLAN, "", "across = \"s.csv\"").unwrap();
    let by_name = by_name.ground_motion.across.unwrap().value;
    assert_eq!(
        (&by_name.file.value, &by_name.scale),
        (&across.file.value, &across.scale)
    );
    // Floors that turn have three modes each.
    let modes = PLAN.replace("plan", "damping = { ratio = 0.05, modes = [1, 6] }\nplan");
    let text = "[[building]]\nname = \"a\"\nmass = [1, 1]\nheight = 3\nXX\n[ground_motion]\nfile = \"r\"\n";
    let case = Case::parse(&text.replace("XX", &modes), Path::new("c.toml")).unwrap();
    assert_eq!(case.buildings.len(), 1);
}

/// Each with its message, the line's text at its place, and a word of the remedy.
#[test]
fn what_cannot_be_is_refused_at_its_place() {
    for (b, gap, motion, message, remedy) in [
        (
            "ground = { distance = 60 }",
            "",
            "",
            "`ground` has no `wave_speed`",
            "both `distance` and `wave_speed`",
        ),
        (
            "ground = { wave_speed = 600 }",
            "",
            "",
            "`ground` has no `distance`",
            "or a `delay`",
        ),
        (
            "ground = { delay = 1, distance = 60, wave_speed = 600 }",
            "",
            "",
            "either `delay` or `distance` and `wave_speed`",
            "leave one of them out",
        ),
        ("ground = { delay = -1 }", "", "", "`delay`", ""),
        ("ground = { delay = \"3 m\" }", "", "", "a time", ""),
        (
            "ground = { scale = 2 }",
            "",
            "",
            "`scale` in `ground` belongs to a record",
            "add `file = ...`",
        ),
        (
            "ground = { file = \"\" }",
            "",
            "",
            "empty",
            "relative to the folder",
        ),
        ("ground = { speed = 3 }", "", "", "speed", ""),
        (
            "",
            "wall = \"fixed\"",
            "",
            "`wall` has no meaning in a gap between two buildings",
            "name \"wall\" in `between`",
        ),
        ("", "wall = \"standing\"", "", "wall", "fixed"),
        ("", "seat = 0", "", "`seat`", ""),
        (
            "",
            "",
            "across = { delay = 1 }",
            "`across` is a record of its own, without a delay",
            "stands in `ground`",
        ),
        (
            "",
            "",
            "across = { file = \"s.csv\", delay = 1 }",
            "`across` is a record of its own, without a delay",
            "",
        ),
        (
            "",
            "",
            "across = \"\"",
            "`across` is empty",
            "relative to the folder",
        ),
        ("", "", "across = 3", "`across`", ""),
        (
            "plan = { length = 12, width = 10, frames_along = [], frames_across = [{ at = 0, stiffness = 1 }] }",
            "",
            "",
            "there is no frame",
            "at least one frame in each direction",
        ),
        (
            "plan = { length = 12, frames_along = [{ at = 0, stiffness = 1 }], frames_across = [{ at = 0, stiffness = 1 }] }",
            "",
            "",
            "width",
            "",
        ),
        (
            "plan = { length = 12, width = 10, frames_along = [{ stiffness = 1 }], frames_across = [{ at = 0, stiffness = 1 }] }",
            "",
            "",
            "at",
            "",
        ),
        (
            "plan = { length = 12, width = 10, frames_along = [{ at = 0, stiffness = [1, 2, 3] }], frames_across = [{ at = 0, stiffness = 1 }] }",
            "",
            "",
            "3 values where there are 2 storeys",
            "one value per storey",
        ),
        (
            "plan = { length = 12, width = 10, rotational_inertia = -1, frames_along = [{ at = 0, stiffness = 1 }], frames_across = [{ at = 0, stiffness = 1 }] }",
            "",
            "",
            "rotational_inertia",
            "",
        ),
    ] {
        let error = parse(b, gap, motion).unwrap_err();
        assert!(error.message.contains(message), "{b}{gap}{motion}: {error}");
        let help = error.help.clone().unwrap_or_default();
        assert!(help.contains(remedy), "{b}{gap}{motion}: {help}");
        let source = [b, gap, motion].concat();
        let line = source.lines().next().unwrap();
        let at = &text(b, gap, motion)[error.span.clone()];
        assert!(
            line.contains(at.lines().next().unwrap_or("")),
            "{line}: {at}"
        );
    }
}

#[test]
fn forces_are_read() {
    let forces = "[[building.force]]\nstorey = 2\nconstant = \"-60 kN\"\n[[building.force]]\nstorey = 1\npoints = [[0, 0], [\"20 ms\", \"0.9 MN\"]]\nstays = true\nscale = -2\ndelay = \"1 s\"\n[[building.force]]\nstorey = 1\nharmonic = { amplitude = 4e4, frequency = \"2 Hz\", duration = 3, phase = 90 }\n[[building.force]]\nstorey = 1\nfile = \"f.csv\"\nunit = \"kN\"\ntime_step = 0.1\n";
    let case = parse(forces, "", "").unwrap();
    let forces: Vec<_> = case.buildings[1].forces.iter().map(|f| &f.value).collect();
    assert_eq!(forces.len(), 4);
    assert_eq!(forces[0].source, ForceSource::Constant(-6e4));
    assert_eq!((forces[0].storey, forces[0].stays), (1, true));
    let ForceSource::Points(points) = &forces[1].source else {
        panic!("{:?}", forces[1]);
    };
    assert_eq!(points.value, [(0.0, 0.0), (0.02, 9e5)]);
    let second = forces[1];
    assert_eq!(
        (second.stays, second.scale, second.delay),
        (true, -2.0, 1.0)
    );
    let ForceSource::Harmonic { phase, step, .. } = forces[2].source else {
        panic!("{:?}", forces[2]);
    };
    assert_eq!((phase, step), (std::f64::consts::FRAC_PI_2, 1.0 / 800.0));
    let ForceSource::File {
        column,
        time_step,
        unit,
        ..
    } = forces[3].source
    else {
        panic!("{:?}", forces[3]);
    };
    assert_eq!((column, time_step, unit), (None, Some(0.1), Some(1000.0)));
    let files: Vec<_> = case.files().into_iter().map(|f| f.0).collect();
    assert_eq!(files, ["record", "force history"]);
}

/// Each with its message and a word of the remedy, in the lines of the force.
#[test]
fn forces_that_cannot_be_are_refused_at_their_place() {
    for (force, message, remedy) in [
        (
            "storey = 3\nconstant = 1",
            "no storey 3 in a building of 2 storeys",
            "from 1",
        ),
        ("storey = 0\nconstant = 1", "`storey`", "correct"),
        ("constant = 1", "storey", ""),
        (
            "storey = 1",
            "does not say what the force is",
            "add `constant`",
        ),
        (
            "storey = 1\nconstant = 1\nfile = \"f\"",
            "either `constant` or `file`",
            "are added",
        ),
        (
            "storey = 1\nconstant = 1\nunit = \"kN\"",
            "`unit` has no meaning beside `constant`",
            "`file`",
        ),
        (
            "storey = 1\nconstant = 1\nstays = true",
            "`stays` has no meaning",
            "`points` and `file`",
        ),
        (
            "storey = 1\nconstant = \"1 kg\"",
            "must be a force",
            "a mass is no force",
        ),
        (
            "storey = 1\npoints = [[-1, 5]]",
            "`points`",
            "write zero or a value above it",
        ),
        (
            "storey = 1\npoints = [[\"1 kN\", 5]]",
            "must be a time",
            "unit",
        ),
        ("storey = 1\npoints = [[1]]", "", ""),
        (
            "storey = 1\nfile = \"f\"\nunit = \"kg\"",
            "must be a force",
            "",
        ),
        (
            "storey = 1\nfile = \"f\"\ncolumn = 0",
            "`column`",
            "correct",
        ),
        (
            "storey = 1\nharmonic = { amplitude = 1, frequency = 0, duration = 1 }",
            "`frequency`",
            "",
        ),
        (
            "storey = 1\nharmonic = { amplitude = 1, frequency = 1 }",
            "duration",
            "",
        ),
        (
            "storey = 1\nharmonic = { amplitude = 1, frequency = 1e6, duration = 1 }",
            "400000000 straight lines",
            "a longer `step`",
        ),
        ("storey = 1\nconstant = 1\nfactor = 3", "factor", ""),
    ] {
        let b = format!("[[building.force]]\n{force}\n");
        let error = parse(&b, "", "").unwrap_err();
        assert!(error.message.contains(message), "{force}: {error}");
        let help = error.help.clone().unwrap_or_default();
        assert!(help.contains(remedy), "{force}: {help}");
        let text = text(&b, "", "");
        let start = text.find("[[building.force]]").unwrap();
        let within = start..start + b.len();
        assert!(
            within.contains(&error.span.start),
            "{force}: {:?}",
            error.span
        );
    }
}

fn text(b: &str, gap: &str, motion: &str) -> String {
    let common = "mass = [1e5, 1e5]\nheight = 3\ndamping = { mass_proportional = 0.05 }";
    let stiffness = if b.contains("plan") {
        ""
    } else {
        "stiffness = 1e8"
    };
    format!(
        "[[building]]\nname = \"a\"\n{common}\nstiffness = 1e8\n[[building]]\nname = \"b\"\n{common}\n{stiffness}\n{b}\n[[gap]]\nbetween = [\"a\", \"b\"]\nwidth = 0.02\nmodel = \"linear_elastic\"\nstiffness = 1e8\n{gap}\n[ground_motion]\nfile = \"r.csv\"\n{motion}\n"
    )
}
