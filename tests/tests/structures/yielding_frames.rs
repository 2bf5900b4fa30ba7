//! Frames with laws in buildings whose floors turn in plan.

use pounding_time_history::{FrameOutcome, MethodChoice, Outcome};

use super::torsion::{assembled, go};

/// A pair under El Centro, each building with these lines in the place of its stiffness, which hold `K` and `F`: stiffness
/// and yield force of every storey, or half of both for one of two frames.
fn pair(resists: &str, points: &str, part: f64) -> String {
    let building = |name: &str, (k, f): (f64, f64), mass: f64| {
        let resists = resists
            .replace('K', &(part * k).to_string())
            .replace('F', &(part * f).to_string());
        format!(
            "[[building]]\nname = \"{name}\"\nmass = [{mass}, {mass}]\nheight = 3\ndamping = {{ rayleigh = {{ alpha = 0.5, beta = 0.002 }} }}\n{resists}\n"
        )
    };
    format!(
        "{}{}[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = 0.01\nmodel = \"linear_elastic\"\nstiffness = {}\n{points}\n[ground_motion]\nfile = \"../ground_motions/el_centro_1940_ns.csv\"\n[analysis]\nduration = 10\n",
        building("A", (4e7, 2e5), 1e5),
        building("B", (1.2e8, 5e5), 1.4e5),
        part * 2e8,
    )
}

const LAW: &str = "law = { model = \"bilinear\", yield_force = F, hardening_ratio = 0.04 }";

/// Two equal frames at equal distances are a storey with a bilinear law of twice the stiffness and yield force: closed
/// form, against the planar building.
#[test]
fn even_frames_yield_as_a_storey_does() {
    let planar = format!("stiffness = K\n{LAW}");
    let turning = format!(
        "[building.plan]\nlength = 12\nwidth = 10\nframes_along = [{{ at = -4, stiffness = K, {LAW} }}, {{ at = 4, stiffness = K, {LAW} }}]\nframes_across = [{{ at = 0, stiffness = K, {LAW} }}]"
    );
    let adaptive = MethodChoice::Adaptive {
        relative_tolerance: 1e-11,
    };
    for method in [None, Some(adaptive)] {
        let planar = go(&assembled(&pair(&planar, "", 1.0)), method);
        let turning = go(&assembled(&pair(&turning, "points = [-5, 5]", 0.5)), method);
        assert!(planar.impacts.len() >= 5, "{}", planar.impacts.len());
        assert_eq!(turning.impacts.len(), 2 * planar.impacts.len());
        agree(&planar, &turning);
    }
}

fn agree(planar: &Outcome, turning: &Outcome) {
    let near = |x: f64, y: f64, what: &str| {
        assert!((x - y).abs() <= 1e-8 * x.abs(), "{what}: {x:e} {y:e}");
    };
    for (a, b) in planar.buildings.iter().zip(&turning.buildings) {
        for (one, other) in a.storeys.iter().zip(&b.storeys) {
            near(
                one.displacement.value,
                other.displacement.value,
                "displacement",
            );
            near(one.storey_shear.value, other.storey_shear.value, "shear");
            let [x, y] = [one, other].map(|s| s.acceleration_absolute.value);
            near(x, y, "acceleration");
        }
        for (storey, one) in a.yielding.iter().enumerate() {
            let (one, other) = (one.unwrap(), b.yielding[storey].unwrap());
            let ductility = one.ductility.unwrap().value;
            assert!(ductility > 1.2, "{ductility}");
            near(ductility, other.ductility.unwrap().value, "ductility");
            near(one.hysteretic_energy, other.hysteretic_energy, "energy");
            near(
                one.residual_drift_ratio,
                other.residual_drift_ratio,
                "residual drift",
            );
            let frames = b.frames.iter().filter(|f| f.storey == storey + 1);
            let (along, across): (Vec<&FrameOutcome>, Vec<&FrameOutcome>) =
                frames.partition(|f| f.direction == "along");
            assert_eq!((along.len(), across.len()), (2, 1));
            for frame in along {
                near(
                    ductility,
                    frame.ductility.unwrap().value,
                    "ductility of a frame",
                );
                near(
                    one.hysteretic_energy,
                    2.0 * frame.hysteretic_energy,
                    "energy of a frame",
                );
                let shear = a.storeys[storey].storey_shear.value;
                near(shear, 2.0 * frame.force.value, "force of a frame");
            }
            // Nothing moves it.
            assert!(across[0].force.value < 1e-6 * a.storeys[storey].storey_shear.value);
        }
        for response in b
            .responses
            .iter()
            .filter(|r| r.name.starts_with("rotation"))
        {
            assert!(response.peak.value < 1e-10, "{response:?}");
        }
    }
    assert!(turning.energy.residual_ratio < 1e-10);
}
