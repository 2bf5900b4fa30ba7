//! Forces on floors: closed forms of one mass, with a stop or without one; methods against one
//! another where there is none.

use std::f64::consts::PI;
use std::path::Path;

use pounding_assembly::{Assembly, assemble};
use pounding_case::Case;
use pounding_time_history::{MethodChoice, Outcome, RunOptions, run};

const MASS: f64 = 50e3;
const STIFFNESS: f64 = 2e6;
/// Of the stop (N/m).
const STOP: f64 = 80e6;

fn omega() -> f64 {
    (STIFFNESS / MASS).sqrt()
}

/// One undamped mass on ground at rest with this force, `more` after its table.
fn mass(force: &str, more: &str, duration: f64) -> Assembly {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("rest.csv"),
        "time (s),a (m/s2)\n0,0\n0.1,0\n",
    )
    .unwrap();
    let text = format!(
        r#"
[[building]]
name = "tower"
mass = ["50 t"]
stiffness = "2 MN/m"
height = "3 m"
damping = {{ modal = 0 }}

{force}

{more}

[ground_motion]
file = "rest.csv"

[analysis]
duration = {duration}
"#
    );
    assembled(&text, &folder.path().join("case.toml"))
}

fn assembled(text: &str, file: &Path) -> Assembly {
    assemble(&Case::parse(text, file).unwrap()).unwrap()
}

fn by(assembly: &Assembly, method: MethodChoice) -> Outcome {
    let options = RunOptions {
        method,
        ..assembly.options
    };
    run(&assembly.system, &options, &mut [], &mut |_| {}).unwrap()
}

fn own(assembly: &Assembly) -> Outcome {
    by(assembly, assembly.options.method)
}

const ADAPTIVE: MethodChoice = MethodChoice::Adaptive {
    relative_tolerance: 1e-11,
};

fn near(what: &str, found: f64, expected: f64, relative: f64) {
    let off = (found / expected - 1.0).abs();
    assert!(
        off < relative,
        "{what}: {found} against {expected} ({off:e})"
    );
}

const CONSTANT: &str = "[[building.force]]\nstorey = 1\nconstant = \"100 kN\"";

/// A force that is there at once moves a mass to twice where it would hold it, and does no more
/// than that to its acceleration, which is F / m at both ends: the ground is at rest.
#[test]
fn a_step_without_contact() {
    let assembly = mass(CONSTANT, "", 0.9);
    for outcome in [own(&assembly), by(&assembly, ADAPTIVE)] {
        let floor = &outcome.buildings[0].storeys[0];
        near(
            "peak",
            floor.displacement.value,
            2.0 * 100e3 / STIFFNESS,
            1e-10,
        );
        near("time", floor.displacement.time, PI / omega(), 1e-5);
        near("shear", floor.storey_shear.value, 200e3, 1e-10);
        near(
            "acceleration",
            floor.acceleration_absolute.value,
            100e3 / MASS,
            1e-10,
        );
        let at_end = 100e3 / STIFFNESS * (1.0 - (omega() * 0.9).cos());
        near(
            "work of the force",
            outcome.energy.end.input,
            100e3 * at_end,
            1e-9,
        );
        assert!(outcome.energy.residual_ratio < 1e-10);
    }
}

/// The same against a stop: free flight to the gap, then the mass on both springs. By hand from
/// the two closed forms; it goes on with the period of both.
#[test]
fn a_step_against_a_stop() {
    let wall = "[[gap]]\nbetween = [\"tower\", \"wall\"]\nwidth = \"60 mm\"\nmodel = \"linear_elastic\"\nstiffness = \"80 MN/m\"";
    let (force, gap, duration) = (100e3, 0.06, 6.0);
    let held = force / STIFFNESS;
    let first = (1.0 - gap / held).acos() / omega();
    let speed = held * omega() * (omega() * first).sin();
    let stiff = ((STIFFNESS + STOP) / MASS).sqrt();
    let middle = (force + STOP * gap) / (STIFFNESS + STOP);
    let amplitude = (gap - middle).hypot(speed / stiff);
    let contact = 2.0 * (speed / stiff).atan2(gap - middle) / stiff;
    let period = 2.0 * first + contact;
    let count = ((duration - first) / period).floor() as usize + 1;
    assert_eq!(count, 9);
    let assembly = mass(CONSTANT, wall, duration);
    for outcome in [own(&assembly), by(&assembly, ADAPTIVE)] {
        let level = &outcome.gaps[0].levels[0];
        assert_eq!(level.impacts, count);
        let reached = middle + amplitude - gap;
        near("force", level.peak_force.value, STOP * reached, 1e-9);
        near("speed", level.approach_velocity_max, speed, 1e-9);
        for (k, impact) in outcome.impacts.iter().enumerate() {
            let closed = first + k as f64 * period;
            assert!((impact.time_closed - closed).abs() < 1e-9, "{k}");
            let whole = closed + contact <= duration;
            assert!(
                !whole || (impact.time_opened - closed - contact).abs() < 1e-9,
                "{k}"
            );
        }
        assert!(outcome.energy.residual_ratio < 1e-9);
    }
}

/// A force presses the mass against a stop that returns nothing: the mass arrives with the speed
/// of the free flight, loses all of it and stays.
#[test]
fn a_force_presses_a_mass_against_a_rigid_stop() {
    let wall = "[[gap]]\nbetween = [\"tower\", \"wall\"]\nwidth = \"20 mm\"\nmodel = \"stereomechanical\"\nrestitution = 0";
    let assembly = mass(CONSTANT, wall, 4.0);
    let held = 100e3 / STIFFNESS;
    let first = (1.0 - 0.02 / held).acos() / omega();
    let speed = held * omega() * (omega() * first).sin();
    let moreau_jean = MethodChoice::MoreauJean {
        step: 1e-4,
        theta: 0.5,
    };
    for (method, allowed) in [
        (assembly.options.method, 1e-9),
        (ADAPTIVE, 1e-9),
        (moreau_jean, 1e-3),
    ] {
        let outcome = by(&assembly, method);
        let floor = &outcome.buildings[0].storeys[0];
        near("stopped", floor.displacement.value, 0.02, allowed);
        let lost = 0.5 * MASS * speed * speed;
        near("lost", outcome.energy.end.impact, lost, allowed);
        near("work", outcome.energy.end.input, 100e3 * 0.02, allowed);
        assert!(outcome.energy.residual_ratio < 1e-3 * allowed.sqrt());
    }
}

/// A ramp that ends in a jump: at its end the mass has `c / k (T - sin(w T) / w)` and the speed
/// `c / k (1 - cos(w T))`, with which it swings freely.
#[test]
fn a_ramp_that_stops() {
    let force = "[[building.force]]\nstorey = 1\npoints = [[\"0 s\", \"0 kN\"], [\"0.8 s\", \"160 kN\"]]\ndelay = \"0.25 s\"\nscale = -0.5";
    let assembly = mass(force, "", 4.0);
    let (slope, end) = (0.5 * 160e3 / 0.8 / STIFFNESS, 0.8);
    let x = slope * (end - (omega() * end).sin() / omega());
    let v = slope * (1.0 - (omega() * end).cos());
    for outcome in [own(&assembly), by(&assembly, ADAPTIVE)] {
        let peak = outcome.buildings[0].storeys[0].displacement;
        near("swing", peak.value, x.hypot(v / omega()), 1e-9);
        assert!(peak.time > 1.05, "{peak:?}");
        assert!(outcome.energy.residual_ratio < 1e-9);
    }
    // A mass that hangs on the force: it stays, and the mass swings about where it is held.
    let stays = mass(&force.replace("delay", "stays = true\ndelay"), "", 4.0);
    let held = 0.5 * 160e3 / STIFFNESS;
    let peak = own(&stays).buildings[0].storeys[0].displacement;
    near(
        "swing",
        peak.value,
        held + (x - held).hypot(v / omega()),
        1e-9,
    );
}

/// At half the own frequency the undamped mass follows `4/3 (sin(w t / 2) - sin(w t) / 2)`, whose
/// peak is the square root of three over the static displacement. By default straight lines
/// stand for the sine to 3.1e-5 of its amplitude.
#[test]
fn a_sine() {
    let frequency = omega() / (4.0 * PI);
    let force = |step: &str| {
        format!(
            "[[building.force]]\nstorey = 1\nharmonic = {{ amplitude = \"40 kN\", frequency = {frequency}, duration = \"8 s\"{step} }}"
        )
    };
    let expected = 3.0_f64.sqrt() * 40e3 / STIFFNESS;
    let peak = |assembly: &Assembly| own(assembly).buildings[0].storeys[0].displacement.value;
    near("default", peak(&mass(&force(""), "", 8.0)), expected, 1e-4);
    let fine = format!(", step = {}", 1.0 / (40_000.0 * frequency));
    near("fine", peak(&mass(&force(&fine), "", 8.0)), expected, 1e-8);
    let cosine = force(", phase = 90");
    let first = mass(&cosine, "", 8.0).system.forces()[0].history.at(0.0);
    near("phase", first, 40e3, 1e-12);
}

/// A file of points with names of its columns, and the same forces at equal steps without times:
/// the numbers of points in the case.
#[test]
fn forces_from_files() {
    let folder = tempfile::tempdir().unwrap();
    let times = "# blast\ntime (s),roof,first floor\n0,0,0\n0.02,900,300\n0.1,-90,20\n0.2,0,0\n";
    std::fs::write(folder.path().join("blast.csv"), times).unwrap();
    std::fs::write(folder.path().join("steps.csv"), "0\n300\n20\n0\n").unwrap();
    std::fs::write(
        folder.path().join("rest.csv"),
        "time (s),a (m/s2)\n0,0\n0.1,0\n",
    )
    .unwrap();
    let case = |forces: &str| {
        let text = format!(
            "[[building]]\nname = \"B\"\nmass = [\"50 t\", \"50 t\"]\nstiffness = \"30 MN/m\"\nheight = 3\ndamping = {{ modal = 0.02 }}\n{forces}\n[ground_motion]\nfile = \"rest.csv\"\n[analysis]\nduration = 1\n"
        );
        assembled(&text, &folder.path().join("case.toml"))
    };
    let of_file = case(
        "[[building.force]]\nstorey = 2\nfile = \"blast.csv\"\nunit = \"kN\"\n[[building.force]]\nstorey = 1\nfile = \"blast.csv\"\nunit = \"kN\"\ncolumn = 3\nscale = 2\n",
    );
    let of_points = case(
        "[[building.force]]\nstorey = 2\npoints = [[0, 0], [\"20 ms\", \"900 kN\"], [0.1, -90000], [0.2, 0]]\n[[building.force]]\nstorey = 1\npoints = [[0, 0], [\"20 ms\", \"600 kN\"], [0.1, \"40 kN\"], [0.2, 0]]\n",
    );
    let [read, written] = [&of_file, &of_points].map(|a| a.system.forces());
    assert_eq!((read.len(), written.len()), (2, 2));
    for (read, written) in read.iter().zip(written) {
        assert_eq!(
            (read.storey, &read.history),
            (written.storey, &written.history)
        );
    }
    assert_eq!(own(&of_file).buildings, own(&of_points).buildings);
    let steps =
        case("[[building.force]]\nstorey = 1\nfile = \"steps.csv\"\ntime_step = \"50 ms\"\n");
    let history = &steps.system.forces()[0].history;
    let expected = [
        (0.0, 0.0),
        (0.05, 300.0),
        (0.1, 20.0),
        (0.15000000000000002, 0.0),
    ];
    assert_eq!(history.points(), expected);
    near("between", history.at(0.075), 160.0, 1e-14);
}

/// Two storeys beside three, an earthquake that comes later under the second building, wind and
/// a blow on the one, a machine on the other.
fn windy_pair(more: &str) -> Assembly {
    let text = format!(
        r#"
[[building]]
name = "A"
mass = [25000.0, 25000.0]
stiffness = 13840000.0
height = "3 m"
damping = {{ ratio = 0.05, modes = [1, 2] }}
{more}
[[building.force]]
storey = 2
constant = "60 kN"
[[building.force]]
storey = 1
points = [[1.003, 0], [1.003, "400 kN"], [1.2, "-50 kN"], [1.31, 0]]
[[building.force]]
storey = 1
constant = "20 kN"

[[building]]
name = "B"
mass = [60000.0, 60000.0, 60000.0]
stiffness = 80000000.0
height = "3 m"
damping = {{ ratio = 0.05, modes = [1, 3] }}
ground = {{ delay = "0.13 s" }}
[[building.force]]
storey = 3
harmonic = {{ amplitude = "300 kN", frequency = 3, duration = 9, step = "10 ms" }}

[[gap]]
between = ["A", "B"]
width = 0.03
model = "anagnostopoulos_2004"
stiffness = 93500000.0
restitution = 0.65

[ground_motion]
file = "../ground_motions/el_centro_1940_ns.csv"

[analysis]
duration = 10
"#
    );
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("pair.toml");
    assembled(&text, &file)
}

fn agree(one: &Outcome, other: &Outcome, allowed: f64) {
    for (a, b) in one.buildings.iter().zip(&other.buildings) {
        for (k, (a, b)) in a.storeys.iter().zip(&b.storeys).enumerate() {
            let place = |what: &str| format!("{what} {}", k + 1);
            let displacement = (b.displacement.value, a.displacement.value);
            near(
                &place("displacement"),
                displacement.0,
                displacement.1,
                allowed,
            );
            let shear = (b.storey_shear.value, a.storey_shear.value);
            near(&place("shear"), shear.0, shear.1, allowed);
            let acceleration = (b.acceleration_absolute.value, a.acceleration_absolute.value);
            near(
                &place("acceleration"),
                acceleration.0,
                acceleration.1,
                allowed,
            );
        }
    }
    for (a, b) in one.gaps[0].levels.iter().zip(&other.gaps[0].levels) {
        assert_eq!(a.impacts, b.impacts);
        if a.impacts > 0 {
            near("force", b.peak_force.value, a.peak_force.value, allowed);
            let (x, y) = (a.first_contact.unwrap(), b.first_contact.unwrap());
            assert!((x - y).abs() < allowed, "{x} {y}");
        }
    }
    let (a, b) = (one.energy.end, other.energy.end);
    for (x, y) in [
        (a.input, b.input),
        (a.impact, b.impact),
        (a.viscous, b.viscous),
    ] {
        assert!((x - y).abs() < allowed * a.input, "{x} {y}");
    }
}

#[test]
fn methods_agree_on_forces_beside_an_earthquake() {
    let foundation = "[building.foundation]\nmass = \"20 t\"\nrotational_inertia = \"5e5 kg m2\"\nsway = { stiffness = \"200 MN/m\", dashpot = \"2 MN s/m\" }\nrocking = { stiffness = \"4 GN m/rad\", dashpot = \"30 MN m s/rad\" }";
    for more in ["", foundation] {
        let assembly = windy_pair(more);
        let exact = own(&assembly);
        let impacts: usize = exact.gaps[0].levels.iter().map(|l| l.impacts).sum();
        assert!(impacts > 5, "{impacts}");
        assert!(exact.energy.residual_ratio < 1e-9);
        agree(&exact, &by(&assembly, ADAPTIVE), 1e-8);
        let fourth = MethodChoice::RungeKutta4 { step: 5e-5 };
        agree(&exact, &by(&assembly, fourth), 1e-6);
        let newmark = MethodChoice::Newmark {
            step: 2e-5,
            beta: 0.25,
            gamma: 0.5,
        };
        let implicit = by(&assembly, newmark);
        let roof = |o: &Outcome| o.buildings[0].storeys[1].displacement.value;
        near("newmark", roof(&implicit), roof(&exact), 1e-5);
    }
}

/// A force of zero changes nothing but the way of computing.
#[test]
fn no_force_is_no_force() {
    let text = |force: &str| {
        format!(
            "[[building]]\nname = \"A\"\nmass = [25000.0, 25000.0]\nstiffness = 13840000.0\nheight = 3\ndamping = {{ ratio = 0.05, modes = [1, 2] }}\n{force}\n[[gap]]\nbetween = [\"A\", \"wall\"]\nwidth = 0.02\nmodel = \"anagnostopoulos_2004\"\nstiffness = 93500000.0\nrestitution = 0.65\n[ground_motion]\nfile = \"../ground_motions/el_centro_1940_ns.csv\"\n[analysis]\nduration = 10\n"
        )
    };
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("pair.toml");
    let plain = own(&assembled(&text(""), &file));
    let zero = "[[building.force]]\nstorey = 2\nconstant = 0\n";
    agree(&plain, &own(&assembled(&text(zero), &file)), 1e-9);
}

/// The struck frame of the examples, by hand: sines between impacts, of which each begins with a part
/// of the velocity that the last one ended with.
#[test]
fn a_struck_frame_meets_the_wall_when_sines_do() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/snap_back/struck.toml");
    let assembly = assemble(&Case::read(&file).unwrap()).unwrap();
    let outcome = run(&assembly.system, &assembly.options, &mut [], &mut |_| {}).unwrap();
    let (rate, gap, struck, restitution) = (40.0_f64.sqrt(), 0.02, 0.4_f64, 0.6);
    let mut approach = (struck * struck - (rate * gap).powi(2)).sqrt();
    let mut time = (rate * gap / struck).asin() / rate;
    assert_eq!(outcome.impacts.len(), 4);
    for impact in &outcome.impacts {
        assert!((impact.time_closed - time).abs() < 1e-9, "{time}");
        assert!((impact.approach_velocity - approach).abs() < 1e-9);
        approach *= restitution;
        let amplitude = gap.hypot(approach / rate);
        time += (PI + 2.0 * (gap / amplitude).asin()) / rate;
    }
}
