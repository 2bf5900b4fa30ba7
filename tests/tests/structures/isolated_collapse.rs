//! Buildings by themselves, of which one collapses under gravity: those that stand have the peaks of
//! a case of their own, on a ground of their own, with forces, under an initial state.
use pounding_time_history::{IsolatedRun, Outcome, TimeHistoryError, run, run_isolated};

use super::motions::assembled;

const FALLS: &str = "[[building]]\nname = \"weak\"\nstoreys = 2\nmass = \"25 t\"\nstiffness = \"3.46 MN/m\"\nheight = \"3 m\"\n\
    damping = { modal = 0.05 }\np_delta = true\nlaw = { model = \"elastic_perfectly_plastic\", yield_force = \"15 kN\" }\n";
const STANDS: &str = "[[building]]\nname = \"sound\"\nstoreys = 3\nmass = \"300 t\"\nstiffness = \"150 MN/m\"\nheight = \"3 m\"\n\
    damping = { modal = 0.05 }\nground = { delay = 0.21 }\ninitial_displacement = [\"1 mm\", \"2 mm\", \"3 mm\"]\n\
    [[building.force]]\nstorey = 3\npoints = [[\"0 s\", \"0 kN\"], [\"0.4 s\", \"200 kN\"], [\"0.8 s\", \"0 kN\"]]\n";
const YIELDS: &str = "[[building]]\nname = \"other\"\nstoreys = 1\nmass = \"100 t\"\nstiffness = \"20 MN/m\"\nheight = \"3 m\"\n\
    damping = { modal = 0.02 }\nlaw = { model = \"bouc_wen\", yield_force = \"150 kN\", hardening_ratio = 0.05 }\n";
const END: &str = "[ground_motion]\nfile = \"../ground_motions/el_centro_1940_ns.csv\"\n[analysis]\nduration = 12\n";

fn gap(left: &str, right: &str) -> String {
    format!(
        "[[gap]]\nbetween = [\"{left}\", \"{right}\"]\nwidth = \"30 mm\"\nmodel = \"linear_elastic\"\nstiffness = \"100 MN/m\"\n"
    )
}

fn isolated(text: &str) -> Result<IsolatedRun, TimeHistoryError> {
    let assembly = assembled(&format!("{text}{END}"));
    run_isolated(&assembly.system, &assembly.options, &mut [], &mut |_| {})
}

fn alone(text: &str) -> Outcome {
    let assembly = assembled(&format!("{text}{END}"));
    run(&assembly.system, &assembly.options, &mut [], &mut |_| {}).unwrap()
}

fn same(own: &Outcome, building: usize, other: &Outcome) {
    let (own, other) = (&own.buildings[building], &other.buildings[0]);
    for (own, other) in own.storeys.iter().zip(&other.storeys) {
        for (own, other) in [
            (own.displacement, other.displacement),
            (own.storey_shear, other.storey_shear),
            (own.acceleration_absolute, other.acceleration_absolute),
        ] {
            let off = (own.value / other.value - 1.0).abs();
            assert!(off < 1e-8, "{} for {}", own.value, other.value);
        }
    }
}

#[test]
fn a_collapse_takes_no_peaks_of_others() {
    let all = [
        STANDS,
        FALLS,
        YIELDS,
        &gap("sound", "weak"),
        &gap("weak", "other"),
    ]
    .concat();
    let found = isolated(&all).unwrap();
    let [TimeHistoryError::Collapse { building, .. }] = &found.collapses[..] else {
        panic!("{:?}", found.collapses);
    };
    assert_eq!(building, "weak");
    let fallen = &found.outcome.buildings[1];
    assert!(fallen.storeys.iter().all(|s| s.displacement.value.is_nan()));
    same(&found.outcome, 0, &alone(STANDS));
    same(&found.outcome, 2, &alone(YIELDS));
    // Two of three, in the order in which they fall; none is left of one.
    let twin = FALLS.replace("weak", "weaker").replace("15 kN", "14 kN");
    let both = [FALLS, STANDS, &twin, &gap("weak", "sound")].concat();
    let found = isolated(&both).unwrap();
    assert_eq!(found.collapses.len(), 2);
    same(&found.outcome, 1, &alone(STANDS));
    let error = isolated(FALLS).unwrap_err();
    assert!(
        matches!(error, TimeHistoryError::Collapse { .. }),
        "{error}"
    );
}
