//! A spring of the contact that the case file gives as a table: what comes of it in a run, against
//! the closed form of the law about any spring, and what is refused where.
use pounding_assembly::{AssemblyError, assemble};
use pounding_case::Case;
use pounding_time_history::run;

/// A floor of 100 kg that nothing holds flies at 2 m/s towards a wall 10 mm away.
fn case(folder: &tempfile::TempDir, gap: &str) -> (Case, String) {
    let rest = "# dt: 1 s\ntime_s,acceleration_m/s2\n0,0\n1,0\n";
    std::fs::write(folder.path().join("rest.csv"), rest).unwrap();
    let text = format!(
        "[[building]]\nname = \"body\"\nstoreys = 1\nmass = 100\nstiffness = 1e-6\nheight = 3\ndamping = {{ stiffness_proportional = 0 }}\ninitial_velocity = 2\n[[gap]]\nbetween = [\"body\", \"wall\"]\nwidth = \"10 mm\"\n{gap}\n[ground_motion]\nfile = \"rest.csv\"\n[analysis]\nduration = 0.5\n"
    );
    let case = Case::parse(&text, &folder.path().join("case.toml")).unwrap();
    (case, text)
}

/// Restitution `sqrt((1 - D) / (1 + D))` whatever the spring, here one that hardens and one that
/// softens, and the penetration at which the spring has taken `m v^2 / (2 (1 + D))`.
#[test]
fn a_table_gives_the_restitution_of_the_closed_form() {
    let folder = tempfile::tempdir().unwrap();
    let friction = 0.3_f64;
    let restitution = ((1.0 - friction) / (1.0 + friction)).sqrt();
    let energy = 0.5 * 100.0 * 4.0 / (1.0 + friction);
    for (table, points) in [
        (
            "[[\"5 mm\", \"10 kN\"], [\"10 mm\", \"50 kN\"], [\"20 mm\", \"300 kN\"]]",
            [(0.005, 1.0e4), (0.01, 5.0e4), (0.02, 3.0e5)],
        ),
        (
            "[[\"2 mm\", \"20 kN\"], [\"6 mm\", \"36 kN\"], [\"20 mm\", \"44 kN\"]]",
            [(0.002, 2.0e4), (0.006, 3.6e4), (0.02, 4.4e4)],
        ),
    ] {
        let (case, _) = case(
            &folder,
            &format!("model = \"borovin_2014\"\nfriction = {friction}\nspring = {table}"),
        );
        let assembly = assemble(&case).unwrap();
        let outcome = run(&assembly.system, &assembly.options, &mut [], &mut |_| {}).unwrap();
        let level = &outcome.gaps[0].levels[0];
        assert_eq!(level.impacts, 1);
        let velocity = outcome.final_velocity[0];
        assert!(
            (velocity / (-2.0 * restitution) - 1.0).abs() < 1e-6,
            "{velocity}"
        );
        // The penetration by the trapezia of the table.
        let (mut before, mut work) = ((0.0, 0.0), 0.0);
        let mut expected = f64::NAN;
        for point in points {
            let more = 0.5 * (point.1 + before.1) * (point.0 - before.0);
            if work + more >= energy {
                let slope = (point.1 - before.1) / (point.0 - before.0);
                let root = (before.1 * before.1 + 2.0 * slope * (energy - work)).sqrt();
                expected = before.0 + (root - before.1) / slope;
                break;
            }
            work += more;
            before = point;
        }
        let found = level.peak_penetration.value;
        assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
        let lost = 0.5 * 100.0 * 4.0 * (1.0 - restitution * restitution);
        let dissipated = outcome.energy.end.impact;
        assert!(
            (dissipated / lost - 1.0).abs() < 1e-6,
            "{dissipated} {lost}"
        );
    }
}

#[test]
fn tables_that_cannot_be_are_refused_at_their_place() {
    let folder = tempfile::tempdir().unwrap();
    for (gap, place, says) in [
        (
            "model = \"hertz_1882\"\nspring = [[\"1 mm\", \"1 kN\"]]",
            "[[\"1 mm\", \"1 kN\"]]",
            "model hertz_1882 takes none",
        ),
        (
            "model = \"borovin_2014\"\nfriction = 0.3\nspring = [[\"1 mm\", \"2 kN\"], [\"2 mm\", \"1 kN\"]]",
            "[[\"1 mm\", \"2 kN\"], [\"2 mm\", \"1 kN\"]]",
            "does not lie above",
        ),
        (
            "model = \"borovin_2014\"\nfriction = 0.3\nstiffness = 1e9\nspring = [[\"1 mm\", \"2 kN\"]]",
            "\"borovin_2014\"",
            "spring and stiffness exclude one another",
        ),
        (
            "model = \"borovin_2014\"\nspring = [[\"1 mm\", \"2 kN\"]]",
            "\"borovin_2014\"",
            "restitution or friction",
        ),
    ] {
        let (case, text) = case(&folder, gap);
        let Err(AssemblyError::Case(error)) = assemble(&case) else {
            panic!("{gap}")
        };
        assert!(error.message.contains(says), "{}", error.message);
        assert_eq!(&text[error.span.clone()], place);
        assert!(error.help.is_some());
    }
}
